"""A thick cylinder in plane strain under pressure in its bore, perfectly plastic: when it first yields and what it can bear at most.

Hill, The Mathematical Theory of Plasticity (1950), chapter V; Prager & Hodge (1951). Elastic (Lame): with A = p a^2/(b^2 - a^2)

    sigma_r, sigma_theta = A (1 -+ b^2/r^2),     sigma_z = 2 nu A,
    q^2 = A^2 (3 b^4/r^4 + (1 - 2 nu)^2),

q von Mises. It yields first in the bore; for nu = 1/2 at p = sigma_y (1 - a^2/b^2)/sqrt(3). Where all of it flows along z without
straining, sigma_theta - sigma_r = 2 sigma_y/sqrt(3), and equilibrium gives the limit, for any nu: p = (2/sqrt(3)) sigma_y ln(b/a).

Between the two, for nu = 1/2 (u r is the same everywhere), the wall flows up to the radius c:

    p = sigma_y/sqrt(3) (2 ln(c/a) + 1 - c^2/b^2),     u r = (sqrt(3)/2) sigma_y c^2/E.
"""
from math import log, sqrt


def first_yield(inner, outer, poisson):
    """p over sigma_y.

    >>> round(first_yield(1, 2, 0.5), 5)
    0.43301
    """
    ratio = outer**2 / inner**2
    return (ratio - 1) / sqrt(3 * ratio**2 + (1 - 2 * poisson)**2)


def limit(inner, outer):
    """p over sigma_y.

    >>> round(limit(1, 2), 5)
    0.80038
    """
    return 2 / sqrt(3) * log(outer / inner)


def elastic_widening(inner, outer, young, poisson, pressure):
    """Of the bore in plane strain [m].

    >>> round(elastic_widening(1, 2, 1, 0.5, 1), 6)
    2.0
    """
    return (1 + poisson) / young * pressure * inner**2 / (outer**2 - inner**2) * ((1 - 2 * poisson) * inner + outer**2 / inner)


def path(inner, outer, points=101):
    """[(u E/(sigma_y a), p/sigma_y)] of the bore for nu = 1/2, from nothing to the limit.

    >>> [round(v, 5) for v in path(1, 2)[1]]
    [0.86603, 0.43301]
    >>> [round(v, 5) for v in path(1, 2)[-1]]
    [3.4641, 0.80038]
    """
    curve = [(0.0, 0.0)]
    for i in range(points):
        c = inner + (outer - inner) * i / (points - 1)
        curve.append((sqrt(3) / 2 * c**2 / inner**2, (2 * log(c / inner) + 1 - c**2 / outer**2) / sqrt(3)))
    return curve
