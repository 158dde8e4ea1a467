"""Thick walls under pressure inside, elastic (Lame): how far the bore widens.

A wall that keeps its volume can only widen as 1/r^2 (sphere) or 1/r (cylinder); elements whose shapes cannot do this at all of their points
lock, and hold the wall back by bulk stress. Timoshenko & Goodier, Theory of Elasticity, chapters 4 and 13.
"""


def sphere(inner, outer, young, poisson, pressure):
    """Widening of the bore, u = A r + B/r^2 [m].

    >>> round(sphere(1, 2, 1, 0.5, 1), 6), round(sphere(1, 2, 1, 0.3, 1), 6)
    (0.857143, 0.8)
    """
    shell = young * (outer**3 - inner**3)
    return pressure * inner**3 * ((1 - 2 * poisson) * inner + (1 + poisson) * outer**3 / (2 * inner**2)) / shell


def cylinder(inner, outer, young, poisson, pressure):
    """Widening of the bore in plane strain, u = A r + B/r [m].

    >>> round(cylinder(1, 2, 1, 0.5, 1), 6), round(cylinder(1, 2, 1, 0.3, 1), 6)
    (2.0, 1.906667)
    """
    shell = young * (outer**2 - inner**2)
    return (1 + poisson) * pressure * inner**2 * ((1 - 2 * poisson) * inner + outer**2 / inner) / shell
