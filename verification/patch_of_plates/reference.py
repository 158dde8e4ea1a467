"""Constant membrane strain, constant curvature and constant transverse shear in a patch of plates.

The patch is that of R. H. MacNeal and R. L. Harder (Finite Elements in Analysis and Design 1 (1985) 3), 0.24 m x 0.12 m, 1 mm thick,
E = 1 MPa, Poisson's ratio 1/4:

    membrane   u = strain (x + y/2, x/2 + y)
    bending    w = curvature (x^2 + x y + y^2)/2,  turns (dw/dy, -dw/dx)
    shear      w = shear (0.3 x - 0.8 y), normals at rest; shear correction 5/6. Each triangle keeps that share of its stiffness
               which residual bending flexibility leaves (docs/theory/plate.md): 1 / (1 + (5/6) mu t <r^2>/2 / D), r from its centroid

In motion: x = (1 + s G) X with a symmetric G and s = t/2 + 50 t^2, body force per mass 100 G X: see patch_of_solids.
"""
from math import sqrt

YOUNG, POISSON, THICKNESS, AREA = 1e6, 0.25, 1e-3, 0.24 * 0.12  # [Pa] [-] [m] [m2]
PLACES = ((0, 0), (0.24, 0), (0.24, 0.12), (0, 0.12), (0.04, 0.02), (0.18, 0.03), (0.16, 0.08), (0.08, 0.08))  # [m]
QUADRILATERALS = ((0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7), (4, 5, 6, 7))  # each cut from its first corner to its third
G = ((1, 0.5), (0.5, 0.75))  # tension in all directions


def plane_stress(xx, yy, xy):
    """Stress of strains: xx, yy, xy. [Pa]

    >>> [round(s, 2) for s in plane_stress(1e-3, 1e-3, 5e-4)]
    [1333.33, 1333.33, 400.0]
    """
    factor = YOUNG / (1 - POISSON**2)
    return factor * (xx + POISSON * yy), factor * (yy + POISSON * xx), YOUNG / (1 + POISSON) * xy


def von_mises(xx, yy, xy):
    """Of plane stress. [Pa]

    >>> von_mises(2, 0, 0), von_mises(0, 0, 1)**2
    (2.0, 2.9999999999999996)
    """
    return sqrt(xx * xx - xx * yy + yy * yy + 3 * xy * xy)


def membrane(strain):
    """Stress: xx, yy, xy. [Pa]"""
    return plane_stress(strain, strain, strain / 2)


def bending(curvature, height=1.0):
    """Stress at a height, over half the thickness; curvature [1/m]. [Pa]

    MacNeal and Harder's at the surface:

    >>> [round(s, 4) for s in bending(1e-3, -1)]
    [0.6667, 0.6667, 0.2]
    """
    z = height * THICKNESS / 2
    return plane_stress(-z * curvature, -z * curvature, -z * curvature / 2)


def bending_energy(curvature):
    """Of the patch: moments times curvatures. [J]

    >>> round(bending_energy(1e-3) * 1e12, 6)
    3.68
    """
    m_xx, m_yy, m_xy = (s * THICKNESS**2 / 6 for s in bending(curvature, -1))
    return AREA / 2 * (m_xx * curvature + m_yy * curvature + m_xy * curvature)


def shear_resultant(shear):
    """Along x and y. [N/m]"""
    factor = 5 / 6 * YOUNG / (2 * (1 + POISSON)) * THICKNESS * shear
    return 0.3 * factor, -0.8 * factor


def triangles():
    """Of the patch: corners of each. [m]"""
    return [[PLACES[n] for n in (q[0], *pair)] for q in QUADRILATERALS for pair in (q[1:3], q[2:4])]


def area_and_share(corners, thickness):
    """Area of a triangle, and the share of its shear stiffness that it keeps. [m2] [-]

    The mean square distance from the centroid is that of the middles of the sides: this rule is exact for squares.

    >>> area, share = area_and_share([(0, 0), (1, 0), (0, 1)], 0.1)
    >>> area, round(1 / share - 1, 12)
    (0.5, 20.833333333333)
    """
    (x1, y1), (x2, y2), (x3, y3) = corners
    middles = [((x1 + x2) / 2, (y1 + y2) / 2), ((x2 + x3) / 2, (y2 + y3) / 2), ((x3 + x1) / 2, (y3 + y1) / 2)]
    cx, cy = (x1 + x2 + x3) / 3, (y1 + y2 + y3) / 3
    square = sum((x - cx)**2 + (y - cy)**2 for x, y in middles) / 3
    bending = YOUNG * thickness**3 / (12 * (1 - POISSON**2))
    return abs((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1)) / 2, \
        1 / (1 + 5 / 6 * YOUNG / (2 * (1 + POISSON)) * thickness * square / 2 / bending)


def kept(thickness=THICKNESS):
    """The share of the shear stiffness that the whole patch keeps. [-]

    >>> round(sum(area_and_share(t, 1)[0] for t in triangles()) / AREA, 12)
    1.0
    """
    return sum(area * share for area, share in (area_and_share(t, thickness) for t in triangles())) / AREA


def shear_energy(shear):
    """Of the patch, if it keeps its whole stiffness. [J]"""
    q = shear_resultant(shear)
    return AREA / 2 * shear * (0.3 * q[0] - 0.8 * q[1])


def displacement(X, t):
    """In motion. [m]

    >>> displacement((1, 0), 0.01)
    (0.01, 0.005, 0)
    """
    s = 0.5 * t + 50 * t * t
    return s * (G[0][0] * X[0] + G[0][1] * X[1]), s * (G[1][0] * X[0] + G[1][1] * X[1]), 0
