"""Hertz's contact of a sphere on a rigid plane, at rest.

Hertz (1882), in Johnson, Contact Mechanics, chapter 4: with E* = E/(1 - nu^2) against a rigid plane and the approach d of distant points

    a = sqrt(R d),   F = (4/3) E* sqrt(R) d^(3/2),   p0 = (2 E*/pi) sqrt(d/R),   p = p0 sqrt(1 - r^2/a^2)

for half-spaces; a finite ball differs by a share of a/R. By symmetry the equator of a ball between two planes stays flat and comes nearer
to each by d.
"""
from math import pi, sqrt


def hertz(radius, young, poisson, approach):
    """Values in SI units.

    >>> steel = hertz(0.01, 210e9, 0.3, 25e-6)
    >>> round(steel["contact_radius"] * 1e3, 6), round(steel["force"], 2), round(steel["pressure"] / 1e9, 4)
    (0.5, 3846.15, 7.3456)
    >>> abs(1.5 * steel["force"] / (pi * steel["contact_radius"]**2) / steel["pressure"] - 1) < 1e-12   # mean pressure 2/3 of the largest
    True
    """
    modulus = young / (1 - poisson**2)
    return {"contact_radius": sqrt(radius * approach), "force": 4 / 3 * modulus * sqrt(radius) * approach**1.5,
            "pressure": 2 * modulus / pi * sqrt(approach / radius)}


def pressure_at(r, contact_radius, pressure):
    """[Pa] at the distance r from the axis.

    >>> pressure_at(0.6, 1.0, 10.0), pressure_at(1.1, 1.0, 10.0)
    (8.0, 0.0)
    """
    return pressure * sqrt(max(0.0, 1 - (r / contact_radius)**2))
