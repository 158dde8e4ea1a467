"""Two equal cylinders pressed together and sheared: Hertz's line contact and the partial slip of Cattaneo (1938) and Mindlin (1949).

Johnson, Contact Mechanics, sections 4.2 and 7.2. With forces per length, 1/R = 1/R1 + 1/R2 and 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2,

    a = sqrt(4 P R/(pi E*)),   p0 = 2 P/(pi a),   p = p0 sqrt(1 - x^2/a^2).

A shear Q below mu P then lets the rim slip and leaves a strip of half-width c = a sqrt(1 - Q/(mu P)) in the middle that sticks:

    q = mu p0 (sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - x^2/c^2)) inside c,   q = mu p outside.

The friction that is not used, mu p - q, is in the strip an ellipse again: mu p0 (c/a) sqrt(1 - x^2/c^2).
"""
from math import pi, sqrt


def partial_slip(radius, young, poisson, normal, shear, friction):
    """Two cylinders of this radius; forces per length. Any system of units.

    Numbers of VM272 (Ansys; Yang and Laursen 2005), in mm and N:

    >>> found = partial_slip(8, 200, 0.3, 10, 0.93622, 0.2)
    >>> round(found["a"], 5), round(found["p0"], 4), round(found["c"], 4)
    (0.68078, 9.3514, 0.4965)
    >>> sum_of = lambda f, n=20000: sum(f(-0.7 + 1.4 * (i + 0.5) / n, found) for i in range(n)) * 1.4 / n
    >>> round(sum_of(pressure), 3), round(sum_of(traction), 4)   # they add up to the forces
    (10.0, 0.9362)
    """
    modulus = young / (2 * (1 - poisson**2))
    a = sqrt(4 * normal * (radius / 2) / (pi * modulus))
    return {"a": a, "p0": 2 * normal / (pi * a), "c": a * sqrt(1 - shear / (friction * normal)), "friction": friction}


def pressure(x, contact):
    """Hertz's pressure at the distance x from the middle.

    >>> pressure(0.6, {"a": 1.0, "p0": 10.0})
    8.0
    """
    return contact["p0"] * sqrt(max(0.0, 1 - (x / contact["a"])**2))


def traction(x, contact):
    """Cattaneo's and Mindlin's shear traction.

    >>> contact = {"a": 1.0, "p0": 10.0, "c": 0.5, "friction": 0.1}
    >>> traction(0.0, contact), traction(0.6, contact)   # half of mu p0; mu p where it slips
    (0.5, 0.8)
    """
    inner = sqrt(max(0.0, 1 - (x / contact["c"])**2)) * contact["c"] / contact["a"] if contact["c"] > 0 else 0.0
    return contact["friction"] * (pressure(x, contact) - contact["p0"] * inner)
