"""A bar pulled suddenly: d'Alembert's waves between a held and a free end.

The force F sends a wave with the strain F/(EA) towards the wall, which returns it doubled: the tip moves out with the velocity
c F/(EA) for the time 2L/c, to twice the static elongation, and back again. After 4L/c all is as at the start.
"""
from math import sqrt


def tip(t, force, length, area, density, young):
    """Displacement of the pulled end at the time t [m].

    >>> steel = dict(force=1e6, length=1, area=0.01, density=7850, young=210e9)
    >>> round(tip(turning_time(1, 7850, 210e9), **steel) / (1e6 * 1 / (210e9 * 0.01)), 12)
    2.0
    """
    turn = turning_time(length, density, young)
    phase = (t / turn) % 2
    return 2 * force * length / (young * area) * (phase if phase < 1 else 2 - phase)


def turning_time(length, density, young):
    """When the tip turns back for the first time [s]."""
    return 2 * length / sqrt(young / density)
