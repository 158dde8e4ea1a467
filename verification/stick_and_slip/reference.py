"""A block that sticks, slides and sticks again under a load that changes, by Coulomb's law and Newton's.

Let p be the load over the limit of friction mu m g. The block sticks until p exceeds one. Then m v' = mu m g (p - 1) until v is zero
again, and it sticks if p is below one. Heat is mu m g s. All integrals are of polynomials; the time of the stop is found by bisection.
"""
from math import pi

FRICTION, PRESS, MASS = 0.1, 2e4, 7850 * 0.04 * 0.04 * 0.01   # [-] [m/s2] [kg]
LIMIT = FRICTION * MASS * PRESS                               # [N]
PARTS = ((0.8, 1e-3, 2e-3), (0.4, 5e-3, 1.5e-3), (-0.9, 7e-3, 1.5e-3))  # height [-], beginning [s], duration [s]


def eased(u, order=0):
    """3 u^2 - 2 u^3 from 0 to 1, then 1; or its first or second integral from 0.

    >>> eased(0.5), eased(2), eased(1, 1), eased(3, 1), eased(1, 2), round(eased(2, 2), 12)
    (0.5, 1, 0.5, 2.5, 0.15, 1.15)
    """
    if u <= 0:
        return 0
    w = min(u, 1)
    if order == 0:
        return 3 * w**2 - 2 * w**3
    if order == 1:
        return w**3 - w**4 / 2 + (u - w)
    return w**4 / 4 - w**5 / 10 + 0.5 * (u - w) + (u - w)**2 / 2


def load(t, order=0):
    """p at the time t, or its first [s] or second [s2] integral.

    >>> round(load(4e-3), 12), round(load(5.75e-3), 12), round(load(7e-3), 12), round(load(11e-3), 12)
    (0.8, 1.0, 1.2, 0.3)
    """
    return sum(height * length**order * eased((t - begin) / length, order) for height, begin, length in PARTS)


SLIPS = 5.75e-3  # [s] where p is one, by the symmetry of the second part


def speed(t):
    """[m/s] while it slides."""
    return LIMIT / MASS * (load(t, 1) - load(SLIPS, 1) - (t - SLIPS))


def stops():
    """[s]

    >>> round(1e3 * stops(), 4), abs(speed(stops())) < 1e-9
    (8.2309, True)
    """
    low, high = 7e-3, 11e-3
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if speed(middle) > 0 else (low, middle)
    return low


def way(t):
    """Slip at the time t [m].

    >>> round(1e3 * way(stops()), 4)
    0.666
    """
    if t <= SLIPS:
        return 0.0
    end = min(t, stops())
    return LIMIT / MASS * (load(end, 2) - load(SLIPS, 2) - load(SLIPS, 1) * (end - SLIPS) - (end - SLIPS)**2 / 2)


def friction(t):
    """What friction must hold at the time t over its limit.

    >>> friction(4e-3) == load(4e-3), friction(7e-3)
    (True, 1.0)
    """
    return 1.0 if SLIPS < t < stops() else load(t)


def heat():
    """[J]

    >>> abs(heat() / (LIMIT * way(stops())) - 1) < 1e-12
    True
    """
    return LIMIT * way(stops())


def swing(curvature, frequency):
    """How far a body of this lowest frequency [Hz] swings about a load whose curvature sets in at once, over the load: curvature [1/s2]
    over the squared angular frequency.

    >>> f"{swing(0.8 * 6 / 2e-3**2, 30e3):.1e}"
    '3.4e-05'
    """
    return curvature / (2 * pi * frequency)**2
