"""Mean force and length of folds of a tube that is crushed along its axis and folds like a concertina.

Abramowicz & Jones, Dynamic axial crushing of circular tubes, Int. J. Impact Engng 2 (1984) 263-281, after Alexander, Q. J. Mech. Appl.
Math. 13 (1960) 10-15; R the mean radius, h the thickness, s the flow stress:

    H = 1.76 sqrt(h R / 2)                  half of the length of a fold
    d = 2 H (0.86 - 0.568 sqrt(h / 2R))     by which the tube becomes shorter for each
    F = M (29.4 sqrt(R / h) + 11.9) / (0.86 - 0.568 sqrt(h / 2R)),   M = 2/sqrt(3) s h^2/4

Guillow, Lu & Grzebieta, Quasi-static axial compression of thin-walled circular aluminium tubes, Int. J. Mech. Sci. 43 (2001) 2103-2123, fit
to 70 tests of any mode:

    F = 72.3 (2R / h)^0.32 s h^2/4
"""
from math import sqrt

TUBE = {"radius": 0.02, "thickness": 0.001, "flow_stress": 300e6}  # SI


def crushed(radius, thickness):
    """Part of the length of a fold by which the tube becomes shorter.

    >>> round(crushed(0.02, 0.001), 4)
    0.7702
    """
    return 0.86 - 0.568 * sqrt(thickness / (2 * radius))


def force_of_theory(radius, thickness, flow_stress):
    """Abramowicz & Jones. [N]

    >>> round(force_of_theory(**TUBE))
    16122
    """
    moment = 2 / sqrt(3) * flow_stress * thickness**2 / 4
    return moment * (29.4 * sqrt(radius / thickness) + 11.9) / crushed(radius, thickness)


def force_of_tests(radius, thickness, flow_stress):
    """Guillow, Lu & Grzebieta. [N]

    >>> round(force_of_tests(**TUBE))
    17655
    """
    return 72.3 * (2 * radius / thickness) ** 0.32 * flow_stress * thickness**2 / 4


def fold(radius, thickness):
    """Length of the wall of one fold. [m]

    >>> round(fold(0.02, 0.001), 6)
    0.011131
    """
    return 2 * 1.76 * sqrt(thickness * radius / 2)
