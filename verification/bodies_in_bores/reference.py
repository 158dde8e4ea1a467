"""A ball that swings in a bore, and a shaft that turns in one.

Without friction the centre of a ball in a bore of the radius R moves on a circle of the radius R - r under its weight: a pendulum, whose
energy m g (R - r)(1 - cos q) + m (R - r)^2 q'^2/2 is constant. Its amplitude stays, and its period is 4 sqrt((R - r)/g) K(sin(q0/2)) with
the complete elliptic integral K, which is pi/2 over the arithmetic-geometric mean of 1 and cos(q0/2). If it rolls, I w^2/2 adds the part k
= I/(m r^2) to its mass, and the period grows by sqrt(1 + k). A shaft without friction has no moment about its axis: normals lead through
it.
"""
from math import cos, pi, sqrt


def mean(a, b):
    """The arithmetic-geometric mean.

    >>> round(mean(1, sqrt(2)), 10)
    1.1981402347
    """
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, sqrt(a * b)
    return a


def period(amplitude, radius, gravity, k=0):
    """Of a swing with an amplitude [rad] on a circle of a radius [m] [s].

    >>> round(period(pi / 2, 1, 9.81) / (2 * pi * sqrt(1 / 9.81)), 6)
    1.180341
    """
    return 2 * pi * sqrt((1 + k) * radius / gravity) / mean(1, cos(amplitude / 2))
