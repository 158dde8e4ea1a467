"""A block pressed on a plane by P and pushed along it by Q: Coulomb's law and balance.

While Q <= mu P nothing moves and the friction is Q. Beyond, the friction is mu P and the rest accelerates the block:
    m dv/dt = Q - mu P,  which for  Q = q (t - t0)  from the slip at  ts = t0 + mu P/q  on gives  v = q (t - ts)^2/(2 m).
"""


def slip_time(pressing, friction, rate, start):
    """When the block lets go. [s]

    >>> round(slip_time(1600, 0.3, 1600, 0.1), 12)
    0.4
    """
    return start + friction * pressing / rate


def friction_force(t, pressing, friction, rate, start):
    """[N]

    >>> [round(friction_force(t, 1600, 0.3, 1600, 0.1), 9) for t in (0, 0.35, 0.6)]
    [0, 400.0, 480.0]
    """
    return max(0, min(friction * pressing, rate * (t - start)))


def speed(t, pressing, friction, rate, start, mass):
    """[m/s]

    >>> round(speed(0.6, 1600, 0.3, 1600, 0.1, 16), 12)
    2.0
    """
    return rate * max(0.0, t - slip_time(pressing, friction, rate, start))**2 / (2 * mass)


def way(t, pressing, friction, rate, start, mass):
    """[m]

    >>> round(way(0.6, 1600, 0.3, 1600, 0.1, 16), 6)
    0.133333
    """
    return rate * max(0.0, t - slip_time(pressing, friction, rate, start))**3 / (6 * mass)
