"""A block on an incline sticks or slides, by Coulomb's law.

It sticks if mu >= tan(angle); otherwise it slides with the acceleration g (sin(angle) - mu cos(angle)).
"""
from math import cos, radians, sin, tan


def acceleration(angle, friction, gravity):
    """Down the incline [m/s2]; angle in degrees.

    >>> round(acceleration(30, 0.2, 9.81), 5), acceleration(30, 0.6, 9.81)
    (3.20586, 0.0)
    """
    slope = radians(angle)
    if friction >= tan(slope):
        return 0.0
    return gravity * (sin(slope) - friction * cos(slope))
