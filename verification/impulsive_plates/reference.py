"""Clamped circular plates under an even impulse: the line through tests of many authors.

Nurick & Martin, Deformation of thin plates subjected to impulsive loading - a review, part II, Int. J. Impact Engng 8 (1989) 171-186:

    w/t = 0.425 phi + 0.277,   phi = I/(pi R t^2 sqrt(rho s)),   90 of 100 tests within one thickness

w the deflection at the middle, t the thickness, R the radius, I the impulse on the whole face, rho the density, s the static yield
stress. An even impulse starts the plate at v = I/(rho t pi R^2), so phi = v R/t sqrt(rho/s). The summary of the paper was read, and has
no numbers; coefficients and scatter are remembered, by the catalogue of this project too. Numbers of single tests could not be had.

*Constants.* The tests are of steels and other metals whose static yield stress is known and whose rate is not in phi. A steel of 282 MPa
with D = 40.4/s, q = 5 (Cowper & Symonds 1957, mild steel) is taken: the rate is independent of the plates. Without a rate the plate is
too soft.
"""
from math import pi, sqrt

PLATE = {"radius": 0.05, "thickness": 1.6e-3, "density": 7850.0, "yield_stress": 282e6}
NUMBERS = (5, 10, 15, 20, 25)  # phi
ONE_THICKNESS = 1 / 1.645      # [thicknesses] standard deviation, if 90 of 100 lie within one


def speed(phi, radius, thickness, density, yield_stress):
    """Initial speed [m/s].

    >>> v = speed(10, **PLATE)
    >>> impulse = v * 7850 * 1.6e-3 * pi * 0.05**2
    >>> round(impulse / (pi * 0.05 * 1.6e-3**2 * sqrt(7850 * 282e6)), 9)
    10.0
    """
    return phi * thickness / radius * sqrt(yield_stress / density)


def of_tests(phi):
    """w/t.

    >>> of_tests(20)
    8.777
    """
    return 0.425 * phi + 0.277


def u_of_tests(phi):
    """Standard deviation of tests about the line, over it. [-]

    >>> round(u_of_tests(20), 3)
    0.069
    """
    return ONE_THICKNESS / of_tests(phi)
