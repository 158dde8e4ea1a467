"""Taylor's bar of copper: the range in which codes end.

There is no closed form. Inputs: Ansys Technology Demonstration Guide, chapter 17 (length 32.4 mm, radius 3.2 mm, 227 m/s; seen),
with the usual elastic-plastic copper. OWN_CODE: an axisymmetric code of the catalogue's authors, 5 x 25 to 40 x 200 elements
(status N: computed for the range). PUBLISHED: from memory (Kamoulakos; Zhu & Cescotto; Camacho & Ortiz; status M), shown and
never a gate.
"""
from math import log

# elements across x along: (final length, final radius of the foot) [m], and the largest plastic strain [-]
OWN_CODE = {"5 x 25": (21.10e-3, 6.02e-3, 1.63), "10 x 50": (21.41e-3, 6.64e-3, 2.70),
            "20 x 100": (21.47e-3, 6.97e-3, 3.34), "40 x 200": (21.43e-3, 7.11e-3, 3.36)}
OWN_CODE_UNILATERAL = (21.51e-3, 7.18e-3)  # [m] of a wall that lets go; the finest mesh
PUBLISHED = {"length": (21.26e-3, 21.66e-3), "radius": (6.89e-3, 7.24e-3), "plastic_strain": (2.47, 3.25)}
LENGTH, RADIUS = OWN_CODE["40 x 200"][:2]  # [m]


def tangent(young, hardening):
    """Slope over total strain of a material with that slope over plastic strain. [Pa]

    >>> round(tangent(117e9, 100e6) / 1e6, 4)
    99.9146
    """
    return young * hardening / (young + hardening)


def grid_convergence(fine, middle, coarse, ratio):
    """Roache's index of three meshes: (order, extrapolated value, index of the fine mesh [-]).

    >>> order, limit, index = grid_convergence(1 + 0.01, 1 + 0.04, 1 + 0.16, 2)
    >>> round(order, 6), round(limit, 6), round(index, 6)
    (2.0, 1.0, 0.012376)
    """
    first, second = middle - fine, coarse - middle
    if first == 0 or second / first <= 0:  # not monotonic: two-grid index with the safety of 3
        return float("nan"), fine, 3 * abs(first / fine)
    order = log(second / first) / log(ratio)
    step = ratio**order - 1
    return order, fine - first / step, 1.25 * abs(first / fine) / abs(step)
