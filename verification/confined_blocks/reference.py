"""Uniaxial strain of an elastic block of one metre under a lid that comes down in four seconds and stays."""
from math import log, pi, sin

YOUNG, POISSON = 1e6, 0.3  # [Pa], [-]
DOWN = 4.0                 # [s]


def compression(t, last):
    """The way of the lid over the height of the blocks. [-]

    >>> [round(compression(t, 0.25), 3) for t in (0, 2, 4, 6)]
    [0.0, 0.125, 0.25, 0.25]
    """
    part = min(t / DOWN, 1)
    return last * (part - sin(2 * pi * part) / (2 * pi))


def force(t, last):
    """Moduli are constant and stress follows the logarithmic strain: F = -(lambda + 2 mu) ln(1 - e) A. [N]

    >>> round(force(4, 0.25) / 1e3, 1)
    387.3
    """
    stiffness = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
    return -stiffness * log(1 - compression(t, last))
