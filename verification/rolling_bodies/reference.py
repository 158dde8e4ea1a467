"""Round bodies that roll: Newton and Euler for the centre and the spin, with Coulomb's law at the contact point.

With k = I/(m r^2), 1/2 of a cylinder and 2/5 of a ball, a body that rolls down a slope has the acceleration g sin(slope)/(1 + k), since
friction F gives the spin: I dw/dt = F r and m dv/dt = m g sin(slope) - F. A body that is thrown along a level table without spin slides
with -mu g until the speed of its contact point, v - r w, is zero. The angular momentum about a point of the table stays: m v r + I w =
m v0 r, so v = v0/(1 + k) then.
"""
from math import radians, sin

CYLINDER, BALL = 1 / 2, 2 / 5


def acceleration(slope, k, gravity):
    """Of a body that rolls down a slope [degrees] [m/s2].

    >>> round(acceleration(30, CYLINDER, 9.81), 4)
    3.27
    """
    return gravity * sin(radians(slope)) / (1 + k)


def after_sliding(speed, k):
    """Speed of a body that was thrown without spin, once it rolls [m/s].

    >>> after_sliding(7, BALL)
    5.0
    """
    return speed / (1 + k)


def time_of_sliding(speed, k, friction, gravity):
    """Until it rolls [s]: the speed falls by friction alone.

    >>> round(time_of_sliding(7, BALL, 0.2, 10), 12)
    1.0
    """
    return (speed - after_sliding(speed, k)) / (friction * gravity)
