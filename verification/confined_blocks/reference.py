"""Uniaxial strain of an elastic block of one metre under a lid that comes down in four seconds and stays."""
from math import log, pi, sin

YOUNG, POISSON = 1e6, 0.3  # [Pa], [-]
DOWN = 4.0                 # [s]


def compression(t, last):
    """The way of the lid over the height of the blocks. [-]"""
    part = min(t / DOWN, 1)
    return last * (part - sin(2 * pi * part) / (2 * pi))


def force(t, last):
    """Moduli are constant and stress follows the logarithmic strain: F = -(lambda + 2 mu) ln(1 - e) A. [N]"""
    stiffness = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
    return -stiffness * log(1 - compression(t, last))
