"""Water at rest between walls that it fills: a neutral equilibrium, and what a contact between facets makes of it.

Pressure does work on a change of the volume of the water only. Motion along the walls changes none, so no force drives it and none brings
it back: nodes of a mesh stay where they are.

A mesh has the water and the wall as polygons of sides l, with the angle l/R between neighbouring sides, R the radius of the wall. Let each
node of the water be moved by s along the wall from the vertex where it was. The corner of the wall now stands at s before the end of a side
of the water, and between this side and the wall is a triangle, of the area l/R s (l - s)/2. A contact that takes the heights of a side at
two Gauss points, both on the same face of the wall, finds heights that grow evenly along the side, with the mean of l/R s/2. It closes the
mean height, and so the water is larger than the room within the wall by

    l/R s l/2 - l/R s (l - s)/2 = l/R s^2/2

a node, per unit of depth. With the pressure p this is a spring of the negative stiffness p l/R between node and vertex. A node of the wall
has at least the mass of half a cell, density l h/2, with h the height of the cells at the wall; so s grows as exp(g t) with

    g = sqrt(2 p/(density R h)),

or a little more slowly, as more mass moves. On the other side of the wall, where the water is outside, the sign is the opposite if the
water has the apexes, and the same if the wall has them.
"""
from math import cos, sin, sqrt

DENSITY, CORE, SHELL, HEIGHT = 1000.0, 0.1, 0.2, 0.01  # [kg/m3] [m] [m] [m]
CELL = 1.5707963267948966 / 24                         # [-] angle of a cell of the water


def gained(side, angle, moved):
    """Area that the water gains at one node. [m2]

    >>> side, angle, moved = 0.01, 0.02, 1e-3
    >>> abs(gained(side, angle, moved) / (angle * moved**2 / 2) - 1) < 1e-3
    True
    """
    # the corner of the wall at (side - moved, 0), the side of the water from the origin to a point past it
    end = (side - moved + moved * cos(angle), moved * sin(angle))
    triangle = (side - moved) * end[1] / 2
    heights = [end[1] / end[0] * x for x in (end[0] * (1 - 3**-0.5) / 2, end[0] * (1 + 3**-0.5) / 2)]
    return sum(heights) / 2 * end[0] - triangle


def growth(pressure, radius, height=HEIGHT, density=DENSITY):
    """[1/s]

    >>> round(growth(20e6, SHELL)), round(growth(20e6, CORE))
    (4472, 6325)
    """
    return sqrt(2 * pressure / (density * radius * height))
