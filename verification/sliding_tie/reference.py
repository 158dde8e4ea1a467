"""A block on a wedge that slides on a floor, both without friction.

With the masses m of the block and M of the wedge, and the slope's angle a, momentum along the floor and Newton's law along the slope give

    wedge  A = m g sin a cos a / (M + m sin^2 a),    block along the slope  r = (M + m) g sin a / (M + m sin^2 a),

the block falling towards -x and the wedge going to +x. Where gravity points up and the block is held from above, all signs change.
"""
from math import atan, cos, sin

SLOPE = atan(0.5)
WEDGE = 1000 * 0.1 * (0.02 * 0.2 + 0.5 * 0.2**2 / 2)  # [kg]
BLOCK = 8000 * 0.06 * 0.06 * 0.03                      # [kg]


def accelerations(g):
    """Of the wedge along x, of the block along x and z [m/s2].

    >>> wedge, along, up = accelerations(9.81)
    >>> round(wedge, 4), round(along, 4), round(up, 4)
    (2.1556, -3.4929, -2.8242)
    >>> abs(WEDGE * wedge + BLOCK * along) < 1e-12
    True
    """
    wedge = BLOCK * g * sin(SLOPE) * cos(SLOPE) / (WEDGE + BLOCK * sin(SLOPE) ** 2)
    along = (WEDGE + BLOCK) * g * sin(SLOPE) / (WEDGE + BLOCK * sin(SLOPE) ** 2)
    return wedge, wedge - along * cos(SLOPE), -along * sin(SLOPE)
