"""Cantilevers with an end load: Timoshenko's beam, and the twisted beam of MacNeal and Harder.

Deflection: P L^3/(3 E I) + P L/(k G A), k = 10 (1 + nu)/(12 + 11 nu) for a rectangle (Cowper 1966).
MacNeal & Harder, Finite Elem. Anal. Des. 1 (1985) 3: a beam of 6 x 0.2 x 0.1 (E = 1e7, nu = 0.3, six elements) under a unit end load, and
one of 12 x 1.1 x 0.32 that is twisted by 90 degrees (E = 29e6, nu = 0.22, 12 x 2 elements). Their values for the twisted one, in any
consistent units; those for the slender one are of Timoshenko's beam:
"""

TWISTED = {"in plane": 0.005424, "out of plane": 0.001754}


def deflection(young, poisson, length, width, height, load):
    """Of the tip. [m] Of the slender beam, in plane (towards the side of 0.2) and out of it, MacNeal and Harder give 0.1081 and 0.4321:

    >>> round(deflection(1e7, 0.3, 6, 0.1, 0.2, 1), 4)
    0.1081
    >>> round(deflection(1e7, 0.3, 6, 0.2, 0.1, 1), 4)
    0.4321
    """
    inertia, area, shear = width * height**3 / 12, width * height, young / (2 * (1 + poisson))
    factor = 10 * (1 + poisson) / (12 + 11 * poisson)
    return load * length**3 / (3 * young * inertia) + load * length / (factor * shear * area)
