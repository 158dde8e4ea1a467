"""Coulomb's friction under a rigid block: it sticks below the slope, slides above it, and tips over where it is tall.

On an incline of the angle a, with gravity g: at rest for mu >= tan a, else a' = g (sin a - mu cos a). On a level belt with the acceleration
b it goes with the belt for b <= mu g, else with mu g. A block as long as l and as high as h tips about its lower edge at rest where
h/l > 1/tan a, mu being large: with the angle q that it has turned, J = m (l^2 + h^2)/3,

    J q'' = m g (h/2 sin(a + q) - l/2 cos(a + q)).
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


def on_a_belt(belt, friction, gravity):
    """Of a block on a level belt [m/s2].

    >>> on_a_belt(1, 0.2, 10), on_a_belt(4, 0.2, 10)
    (1, 2.0)
    """
    return min(belt, friction * gravity)


def tipping(slope, length, height, gravity, time, parts=1000):
    """Angular velocity of a tall block that tips from rest [rad/s], by the method of Runge and Kutta.

    >>> round(tipping(45, 1, 2, 10, 1e-3) / 1e-3, 5)
    2.12132
    """
    def rate(q, w):
        lever = height / 2 * sin(radians(slope) + q) - length / 2 * cos(radians(slope) + q)
        return w, 3 * gravity * lever / (length**2 + height**2)

    q, w, step = 0.0, 0.0, time / parts
    for _ in range(parts):
        a = rate(q, w)
        b = rate(q + step / 2 * a[0], w + step / 2 * a[1])
        c = rate(q + step / 2 * b[0], w + step / 2 * b[1])
        d = rate(q + step * c[0], w + step * c[1])
        q += step / 6 * (a[0] + 2 * b[0] + 2 * c[0] + d[0])
        w += step / 6 * (a[1] + 2 * b[1] + 2 * c[1] + d[1])
    return w
