"""Bodies that slide on flat faces by Coulomb's law, and bodies that do not touch."""
from math import cos, radians, sin


def sliding_speed(t, speed, friction, gravity):
    """Speed of a free block on a level floor [m/s], as long as it slides.

    >>> round(sliding_speed(0.3, 1, 0.2, 9.81), 4)
    0.4114
    """
    return speed - friction * gravity * t


def drive(friction, pressure, area):
    """Force that keeps a pressed block sliding [N].

    >>> round(drive(0.2, 20e6, 0.01), 6)
    40000.0
    """
    return friction * pressure * area


def acceleration(angle, friction, gravity):
    """Down an incline [m/s2]; angle in degrees.

    >>> round(acceleration(30, 0.2, 9.81), 5)
    3.20586
    """
    return gravity * (sin(radians(angle)) - friction * cos(radians(angle)))
