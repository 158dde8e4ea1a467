"""A plate between two columns of linear fluid, in a step wave.

In the coordinates of the reference the fluid obeys d'Alembert's equation at any strength. A wave of the pressure p comes from one side. A
plate of the mass m per area that moves with v radiates rho c v to both sides, and the wall behind a wave has twice its pressure, so

    m v' = 2 p - 2 rho c v,        v = p/(rho c) (1 - exp(-2 rho c t/m)).

The wave that goes on has the velocity of the plate.
"""
from math import exp


def speed(t, pressure, impedance, mass):
    """Of the plate [m/s], a time after the front has reached it [s]; mass per area [kg/m2].

    >>> round(speed(1.0, 1e6, 1.48e6, 78.5), 6), speed(-1e-6, 1e6, 1.48e6, 78.5)
    (0.675676, 0.0)
    >>> round(speed(78.5 / 2.96e6, 1e6, 1.48e6, 78.5) / 0.675676, 4)
    0.6321
    """
    return pressure / impedance * (1 - exp(-2 * impedance * max(t, 0.0) / mass))
