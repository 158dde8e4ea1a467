"""A clamped strip that starts with one velocity everywhere, rigid and perfectly plastic: between which bounds its deflection ends.

N. Jones, Structural Impact, chapter 7. A strip of thickness H, half span L and density rho starts at V0. It yields where the bending
moment and the membrane force reach a curve, |M/M0| + (N/N0)^2 = 1 with M0 = sigma0 H^2/4 and N0 = sigma0 H, for which the problem has no
simple solution. For a square that circumscribes this curve it has:

    W/H = 1/2 (sqrt(1 + 3 lambda/4) - 1),     lambda = 4 rho V0^2 L^2 / (sigma0 H^2).

A square around the curve yields too late, so this W is too small; the square inside the curve with 0.618 of both, (sqrt(5) - 1)/2, yields
too early and its W is too large. Of slow strips W/H tends to 3 lambda/16, bending alone, of fast ones to sqrt(3 lambda)/4, a string. In
plane strain sigma0 is 2/sqrt(3) of the uniaxial yield stress (von Mises).

OWN_CODE is a two-dimensional finite-element model of the catalogue's authors (status N there: computed, not published; Young's modulus
is not given).
"""
from math import sqrt

INSCRIBED = (sqrt(5) - 1) / 2  # [-] M/M0 = N/N0 on the curve: x + x^2 = 1
OWN_CODE = {"permanent": 4.54e-3, "peak": 6.15e-3}  # [m]
STRIP = {"density": 2700, "half_span": 0.064, "thickness": 0.006, "yield_stress": 280e6}  # 6061-T6, SI


def flow_stress(yield_stress):
    """Of plane strain [Pa]; tension without strain along y has sigma_y = sigma_x/2.

    >>> s = flow_stress(1.0)
    >>> round(sqrt(s * s - s * s / 2 + s * s / 4), 12)  # von Mises stress
    1.0
    """
    return 2 / sqrt(3) * yield_stress


def deflection(speed, density, half_span, thickness, flow):
    """At the middle, for the square that circumscribes the yield curve [m].

    >>> slow, fast = (4 * V**2 for V in (1e-3, 1e3))  # lambda, with the other numbers one
    >>> abs(deflection(1e-3, 1, 1, 1, 1) / (3 * slow / 16) - 1) < 1e-6
    True
    >>> abs(deflection(1e3, 1, 1, 1, 1) / (sqrt(3 * fast) / 4) - 1) < 1e-3
    True
    """
    parameter = 4 * density * speed**2 * half_span**2 / (flow * thickness**2)
    return thickness / 2 * (sqrt(1 + 3 * parameter / 4) - 1)


def bracket(speed, density, half_span, thickness, yield_stress):
    """(lower, upper) of the permanent deflection at the middle [m].

    >>> [round(1e3 * w, 2) for w in bracket(40, **STRIP)]
    [4.07, 5.68]
    """
    flow = flow_stress(yield_stress)
    return tuple(deflection(speed, density, half_span, thickness, share * flow) for share in (1, INSCRIBED))
