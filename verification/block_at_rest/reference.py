"""Two blocks that lie on each other: weights, and the speed of sound that velocities are held against."""
from math import sqrt

DENSITY, YOUNG, GRAVITY = 7850.0, 210e9, 9.81       # SI
BLOCK, BASE = 0.03**3, 0.06 * 0.06 * 0.03           # [m3]


def mass(volume):
    """[kg]

    >>> round(mass(BLOCK), 6)
    0.21195
    """
    return DENSITY * volume


def sound():
    """Speed of a wave in a bar. [m/s]

    >>> round(sound(), 1)
    5172.2
    """
    return sqrt(YOUNG / DENSITY)
