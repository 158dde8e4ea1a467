"""Coulomb's friction under a rigid block: it sticks below the slope, slides above it, and tips where it is tall.

On an incline of the angle a, with gravity g: at rest for mu >= tan a, else a' = g (sin a - mu cos a). A block as long as b and as high as
h tips about its lower edge at rest where h/b > 1/tan a, mu being large: J_edge w' = m g (h/2 sin a - b/2 cos a), J_edge = m (b^2 + h^2)/3.
"""
from math import cos, radians, sin


def acceleration(slope, friction, gravity):
    """Down the incline [m/s2].

    >>> round(acceleration(30, 0.2, 9.81), 4)
    3.2059
    >>> acceleration(30, 0.6, 9.81)
    0.0
    """
    down = gravity * (sin(radians(slope)) - friction * cos(radians(slope)))
    return max(0.0, down)


def tipping(slope, length, height, gravity):
    """Angular acceleration of a tall block about its lower edge as it begins to tip [rad/s2].

    >>> round(tipping(45, 1, 2, 10), 6)
    2.12132
    """
    lever = height / 2 * sin(radians(slope)) - length / 2 * cos(radians(slope))
    return gravity * lever / ((length**2 + height**2) / 3)
