"""Hertz's contact of a sphere on a rigid plane, at rest.

Hertz (1882), in Johnson, Contact Mechanics, chapter 4: with E* = E/(1 - nu^2) against a rigid plane and the approach d of distant points

    a = sqrt(R d),   F = (4/3) E* sqrt(R) d^(3/2),   p0 = (2 E*/pi) sqrt(d/R),   p = p0 sqrt(1 - r^2/a^2)

for half-spaces; a finite ball differs by a share of a/R. By symmetry the equator of a ball between two planes stays flat and comes nearer
to each by d.

The consistent nodal force of a pressure p on a mesh is the integral of p N over the faces around the node, with its shape function N. The
integral of N is its tributary area. The pressure of a node is the one over the other: a mean, weighted by N. The weak form of equilibrium
holds for exact stresses and the shape functions of any mesh, so the exact stresses put exactly these forces on the nodes.
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


def shares(corners, pressure, points=16):
    """([force of each corner], [area of each corner]): integrals of pressure(r) N and of N over a bilinear face, seen along the axis.

    The corners (x, y) go around. The midpoint rule with points x points copes with the infinite slope at the rim.

    >>> square = [(0, 0), (2, 0), (2, 2), (0, 2)]
    >>> [[round(value, 12) for value in values] for values in shares(square, lambda r: 3.0)]   # uniform: a quarter each
    [[3.0, 3.0, 3.0, 3.0], [1.0, 1.0, 1.0, 1.0]]
    >>> narrow = shares([(0, 0), (2, 0), (1, 1), (0, 1)], lambda r: 1.0, 200)[1]   # and of a trapezoid a quarter on the mean only
    >>> [round(12 * value, 3) for value in narrow]
    [5.0, 5.0, 4.0, 4.0]
    >>> grid = [(i / 20, j / 20) for i in range(20) for j in range(20)]
    >>> faces = [[(x, y), (x + 0.05, y), (x + 0.05, y + 0.05), (x, y + 0.05)] for x, y in grid]
    >>> quarter = sum(sum(shares(face, lambda r: pressure_at(r, 1.0, 1.0))[0]) for face in faces)
    >>> abs(quarter / (pi / 6) - 1) < 1e-5   # all of Hertz's force
    True
    """
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = corners
    places = [(i + 0.5) / points for i in range(points)]
    forces, areas = [0.0] * 4, [0.0] * 4
    for t in places:
        for s in places:
            weights = ((1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t)
            x = weights[0] * x0 + weights[1] * x1 + weights[2] * x2 + weights[3] * x3
            y = weights[0] * y0 + weights[1] * y1 + weights[2] * y2 + weights[3] * y3
            along = ((1 - t) * (x1 - x0) + t * (x2 - x3), (1 - t) * (y1 - y0) + t * (y2 - y3))
            up = ((1 - s) * (x3 - x0) + s * (x2 - x1), (1 - s) * (y3 - y0) + s * (y2 - y1))
            area = abs(along[0] * up[1] - along[1] * up[0]) / points**2
            push = pressure(sqrt(x * x + y * y)) * area
            for corner, weight in enumerate(weights):
                forces[corner] += weight * push
                areas[corner] += weight * area
    return forces, areas
