"""A bar in uniaxial stress on a measured curve: force and plastic work while it is stretched.

In uniaxial stress s the logarithmic strain is p + s/E, with the plastic strain p and s on the curve. A bar of the first length L and the
first volume V that is stretched to l times its length has, with Hooke's change of volume, the area V exp((1 - 2 nu) s / E) / (L l). Its
plastic work is V times the integral of the stress over the plastic strain, times that change.
"""
from math import exp, log

SLOW = ((0.0, 250e6), (0.01, 320e6), (0.05, 400e6), (0.1, 480e6), (0.2, 600e6))
YOUNG, POISSON = 200e9, 0.3


def measured(table, p):
    """Linear between points, and constant beyond the last one [Pa].

    >>> [measured(SLOW, p) / 1e6 for p in (0, 0.01, 0.15, 0.5)]
    [250.0, 320.0, 540.0, 600.0]
    """
    for (a, low), (b, high) in zip(table, table[1:]):
        if p <= b:
            return low + (high - low) * (p - a) / (b - a)
    return table[-1][1]


def uniaxial(strain):
    """Stress [Pa] and plastic strain of the slow curve at a logarithmic strain.

    >>> s, p = uniaxial(0.01 + 320e6 / YOUNG)
    >>> round(s / 1e6, 6), round(p, 9)
    (320.0, 0.01)
    """
    if YOUNG * strain <= SLOW[0][1]:
        return YOUNG * strain, 0.0
    low, high = 0.0, strain
    for _ in range(100):
        p = (low + high) / 2
        low, high = (p, high) if p + measured(SLOW, p) / YOUNG < strain else (low, p)
    return measured(SLOW, low), low


def force(stretch, area):
    """To stretch a bar of the slow curve to `stretch` times its length [N]; `area` is the first one.

    >>> force(1.0, 1.0)
    0.0
    """
    stress, _ = uniaxial(log(stretch))
    return stress * area * exp((1 - 2 * POISSON) * stress / YOUNG) / stretch


def mean_force(first, last, area, parts=20):
    """The mean of the force while the stretch grows evenly from `first` to `last` [N].

    >>> abs(mean_force(1.05, 1.05, 1.0) / force(1.05, 1.0) - 1) < 1e-12
    True
    """
    at = [force(first + (last - first) * i / parts, area) for i in range(parts + 1)]
    return sum(a + b for a, b in zip(at, at[1:])) / (2 * parts)


def plastic_work(stretch, volume, steps=2000):
    """Dissipated in a bar of the slow curve by then [J].

    >>> round(plastic_work(1.001, 1.0), 9)
    0.0
    """
    _, last = uniaxial(log(stretch))
    points = [last * i / steps for i in range(steps + 1)]
    power = [measured(SLOW, p) * exp((1 - 2 * POISSON) * measured(SLOW, p) / YOUNG) for p in points]
    return volume * sum((a + b) / 2 for a, b in zip(power, power[1:])) * last / steps
