"""A bar in uniaxial stress on a measured curve: force and plastic work while it is stretched.

In uniaxial stress s the logarithmic strain is p + s/E, with the plastic strain p and s on the curve. A bar of the first length L and the
first volume V that is stretched to l times its length has, with Hooke's change of volume, the area V exp((1 - 2 nu) s / E) / (L l). Its
plastic work is V times the integral of the stress over the plastic strain, times that change.

The curve is an object with YOUNG, SLOW, measured(SLOW, p) and uniaxial(strain), as hardening_curves/reference.py is one.
"""
from math import exp, log

POISSON = 0.3


def force(stretch, area, curve):
    """To stretch a bar to `stretch` times its length [N]; `area` is the first one.

    >>> from types import SimpleNamespace
    >>> elastic = SimpleNamespace(YOUNG=1e9, uniaxial=lambda strain: (1e9 * strain, 0.0))
    >>> force(1.0, 1.0, elastic), round(force(1.001, 1.0, elastic) / 1e3, 3)
    (0.0, 998.901)
    """
    stress, _ = curve.uniaxial(log(stretch))
    return stress * area * exp((1 - 2 * POISSON) * stress / curve.YOUNG) / stretch


def mean_force(first, last, area, curve, parts=20):
    """The mean of the force while the stretch grows evenly from `first` to `last` [N].

    >>> from types import SimpleNamespace
    >>> elastic = SimpleNamespace(YOUNG=1e9, uniaxial=lambda strain: (1e9 * strain, 0.0))
    >>> abs(mean_force(1.05, 1.05, 1.0, elastic) / force(1.05, 1.0, elastic) - 1) < 1e-12
    True
    """
    at = [force(first + (last - first) * i / parts, area, curve) for i in range(parts + 1)]
    return sum(a + b for a, b in zip(at, at[1:])) / (2 * parts)


def plastic_work(stretch, volume, curve, steps=2000):
    """Dissipated in a bar by then [J].

    >>> from types import SimpleNamespace
    >>> rigid = SimpleNamespace(YOUNG=1e99, SLOW=(), measured=lambda table, p: 1e6, uniaxial=lambda strain: (1e6, strain))
    >>> round(plastic_work(1.5, 1.0, rigid) / (1e6 * log(1.5)), 12)
    1.0
    """
    _, last = curve.uniaxial(log(stretch))
    stresses = [curve.measured(curve.SLOW, last * i / steps) for i in range(steps + 1)]
    power = [stress * exp((1 - 2 * POISSON) * stress / curve.YOUNG) for stress in stresses]
    return volume * sum((a + b) / 2 for a, b in zip(power, power[1:])) * last / steps
