"""A bilinear metal that is stretched in its plane by plastic flow, which keeps volume.

Stress is Cauchy's, strain logarithmic. In uniaxial stress s the strain e has s = yield + tangent (e - yield/young), in equal stresses s
both ways the plane strains e have the plastic strain p = 2 (e - (1 - nu) s/young) of von Mises and s = yield + H p with H = E Et/(E - Et).
The volume changes with the mean stress only, by exp(tr s / 3K), with 1/3K = (1 - 2 nu)/E.
"""
from math import exp, log, sqrt

YOUNG, POISSON, YIELD, TANGENT = 200e9, 0.3, 300e6, 1e9  # [Pa] [-] [Pa] [Pa]
LENGTH, WIDTH, THICKNESS = 0.1, 0.05, 1e-3  # [m]


def stress(stretch):
    """Uniaxial, at a stretch beyond yield. [Pa]

    >>> round(stress(2) / 1e6, 3)
    991.647
    """
    return YIELD + TANGENT * (log(stretch) - YIELD / YOUNG)


def stress_both_ways(stretch):
    """Of equal stretches along and across. [Pa]

    >>> e, s = log(sqrt(2)), stress_both_ways(sqrt(2))
    >>> hardening = YOUNG * TANGENT / (YOUNG - TANGENT)
    >>> abs(s - YIELD - hardening * 2 * (e - (1 - POISSON) * s / YOUNG)) < 1e-3
    True
    """
    hardening = YOUNG * TANGENT / (YOUNG - TANGENT)
    return (YIELD + 2 * hardening * log(stretch)) / (1 + 2 * hardening * (1 - POISSON) / YOUNG)


def volume(trace):
    """Over that of the start, at a trace of stress. [-]

    >>> volume(0)
    1.0
    """
    return exp((1 - 2 * POISSON) / YOUNG * trace)


def thickness(stretch):
    """In uniaxial stress both sides come in alike. [m]

    >>> round(thickness(2) / THICKNESS, 4)
    0.7078
    """
    return THICKNESS * sqrt(volume(stress(stretch)) / stretch)


def thickness_both_ways(stretch):
    """
    >>> round(thickness_both_ways(sqrt(2)) / THICKNESS, 4)
    0.502
    """
    return THICKNESS * volume(2 * stress_both_ways(stretch)) / stretch**2


def force(stretch):
    """Stress times the area that is left. [N]

    >>> abs(force(2) - stress(2) * WIDTH / THICKNESS * thickness(2)**2) < 1e-9
    True
    """
    return stress(stretch) * WIDTH * THICKNESS * volume(stress(stretch)) / stretch
