"""Free fall, and masses of single elements by their exact volumes.

A free body under gravity has the acceleration g, whatever its elements do; central differences integrate it exactly. So a/g = 1 only says
that gravity and inertia use one mass; that this mass is right, density times volume, is asked separately.

The volume of a distorted hexahedron is that of the trilinear map, by 2 x 2 x 2 points of Gauss: the determinant is of second degree in each
coordinate at most, so the rule is exact. The rotary inertia of a node of a triangle is a third of the plate's: of rho A t the part t^2/12.
"""
from itertools import product
from math import sqrt

DENSITY, THICKNESS = 7850.0, 0.01  # [kg/m3] [m]
BRICK = (0.3, 0.5, 0.7)            # [m]
SKEW = [(0, 0, 0), (1, 0.1, 0), (1.2, 1, 0.1), (-0.1, 0.9, 0),
        (0.1, 0, 1), (1, -0.1, 1.2), (0.9, 1.1, 1), (0.2, 1, 0.8)]  # [m] in the order of VTK
TRIANGLE = [(0, 0), (1, 0.2), (0.3, 0.8)]  # [m]
SIGNS = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]


def determinant(a, b, c):
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))


def volume(corners, points=(-1 / sqrt(3), 1 / sqrt(3))):
    """Of a hexahedron [m3]; each point of the rule has the weight (2/len(points))^3.

    >>> unit = [tuple((s + 1) / 2 for s in sign) for sign in SIGNS]
    >>> abs(volume(unit) - 1) < 1e-15, abs(volume(SKEW) - 0.94125) < 1e-15
    (True, True)
    >>> three = (-sqrt(0.6), 0.0, sqrt(0.6))  # the rule of three points agrees: the first is exact
    >>> weights = (5 / 9, 8 / 9, 5 / 9)
    >>> fine = sum(weights[i] * weights[j] * weights[k] * jacobian(SKEW, (three[i], three[j], three[k]))
    ...            for i in range(3) for j in range(3) for k in range(3))
    >>> abs(volume(SKEW) - fine) < 1e-14
    True
    >>> round(8 * jacobian(SKEW, (0, 0, 0)), 5)  # one point alone is not exact
    0.94619
    """
    weight = (2 / len(points))**3
    return sum(weight * jacobian(corners, at) for at in product(points, repeat=3))


def jacobian(corners, at):
    """Determinant of the trilinear map at a point of the cube [-1, 1]^3."""
    columns = []
    for axis in range(3):
        others = [i for i in range(3) if i != axis]
        shape = [sign[axis] / 8 * (1 + sign[others[0]] * at[others[0]]) * (1 + sign[others[1]] * at[others[1]]) for sign in SIGNS]
        columns.append([sum(n * x[i] for n, x in zip(shape, corners)) for i in range(3)])
    return determinant(*columns)


def area():
    """Of the triangle [m2].

    >>> round(area(), 12)
    0.37
    """
    (x0, y0), (x1, y1), (x2, y2) = TRIANGLE
    return 0.5 * ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0))


def masses():
    """[kg] by the name of the body."""
    brick, skew = DENSITY * BRICK[0] * BRICK[1] * BRICK[2], DENSITY * volume(SKEW)
    return {"brick_one": brick, "brick_full": brick, "skew_one": skew, "skew_full": skew, "plate": DENSITY * THICKNESS * area()}


def rotary_inertia():
    """Of one node of the triangle, about any axis [kg m2]."""
    return DENSITY * THICKNESS * area() / 3 * THICKNESS**2 / 12
