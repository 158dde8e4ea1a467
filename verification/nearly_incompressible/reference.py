"""Thick walls under pressure inside, elastic (Lame): how far the bore widens.

A wall that keeps its volume can only widen as 1/r^2 (sphere) or 1/r (cylinder); elements whose shapes cannot do this at all of their points
lock, and hold the wall back by bulk stress. Timoshenko & Goodier, Theory of Elasticity, chapters 4 and 13.

A bar in plane strain, 0 <= x <= L, |z| <= h/2, under the force k z per mass along x has exactly

    sigma_x = rho k z (L - x),     u = c z (L x - x^2/2) - d z^3/6,     w = -d z^2 (L - x)/2 - c (L x^2/2 - x^3/6),

c = rho k (1 - nu^2)/E, d = rho k nu (1 + nu)/E, and no other stress in its plane. Its section at x = 0 is a cubic; a wall that keeps it
plane turns it by d h^2/40, which makes the rest orthogonal to bending (Saint-Venant).
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


def bent(length, height, young, poisson, density, slope, couple=1.0):
    """Deflection of the end of the bar, c L^3/3 + d h^2 L/40, with a factor on the couple [m].

    >>> round(bent(1, 0.2, 1, 0, 1, 1), 6), round(bent(1, 0.2, 1, 0.5, 1, 1), 6)
    (0.333333, 0.25075)
    """
    c, d = density * slope * (1 - poisson**2) / young, density * slope * poisson * (1 + poisson) / young
    return couple * c * length**3 / 3 + d * height**2 * length / 40


def lumped_couple(layers):
    """What masses at n + 1 levels make of a force in proportion to the height, over h^3/12: the trapezoid rule of z^2.

    >>> sum(z * z * (0.5 if abs(z) == 2 else 1) for z in (-2, -1, 0, 1, 2)) / (4**3 / 12) == lumped_couple(4)
    True
    """
    return 1 + 2 / layers**2
