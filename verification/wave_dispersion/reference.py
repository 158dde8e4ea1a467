"""Standing waves in a column of equal elements with lumped masses, by central differences: the discrete frequency.

A node of the column has mass rho h and springs E/h to its neighbours (per area). For u = cos(k x) the forces are
-(4 E/h) sin^2(k h/2) u, and central differences turn the frequency of this oscillator, w_h, into sin(w dt/2) = w_h dt/2. So
w = (2/dt) asin(C sin(k h/2)) with C = c dt/h. At a free end the node has half the mass and one spring, which cos(k x) fits exactly. At C =
1 there is no dispersion at all. Standard; e.g. Hughes, The Finite Element Method (1987), chapter 9.
"""
from math import asin, pi, sin


def speed_ratio(elements, courant):
    """Numerical over exact wave speed, with `elements` for a wavelength; courant = c dt/h, 0 for the limit of small steps.

    >>> [round(speed_ratio(10, c), 5) for c in (0, 0.5, 0.9, 1)]
    [0.98363, 0.98759, 0.99677, 1.0]
    >>> [round(speed_ratio(6, c), 5) for c in (0, 0.5, 0.9)]
    [0.95493, 0.96517, 0.99051]
    """
    half = pi / elements  # k h/2
    if courant == 0:
        return sin(half) / half
    return asin(courant * sin(half)) / (courant * half)
