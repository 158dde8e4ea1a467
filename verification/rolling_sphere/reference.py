"""A sphere that slides with friction begins to roll.

Friction mu m g slows it down and turns it: v = v0 - mu g t and w R = mu g t/k with k = I/(m R^2), 2/5 for a solid sphere. It rolls once v =
w R:

    t = v0 k/((1 + k) mu g),   v = v0/(1 + k),   d = (v0^2 - v^2)/(2 mu g)

whatever mass and radius are. Friction then has nothing to do.
"""


def rolling(speed, friction, gravity, k=0.4):
    """(time [s], speed [m/s], way [m]) at which it begins to roll.

    >>> [round(x, 5) for x in rolling(3, 0.2, 9.81)]
    [0.43687, 2.14286, 1.12339]
    """
    later = speed / (1 + k)
    return (speed - later) / (friction * gravity), later, (speed**2 - later**2) / (2 * friction * gravity)


def speed_at(t, speed, friction, gravity, k=0.4):
    """[m/s]

    >>> speed_at(0.1, 3, 0.2, 10), round(speed_at(5, 3, 0.2, 10), 6)
    (2.8, 2.142857)
    """
    begins, later, _ = rolling(speed, friction, gravity, k)
    return speed - friction * gravity * t if t < begins else later
