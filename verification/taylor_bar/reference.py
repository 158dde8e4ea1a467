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


def grid_convergence(fine, middle, coarse, middle_over_fine, coarse_over_middle):
    """Order, extrapolated value and index [-] of the fine of three meshes, by Roache's method in the form of Celik et al.
    (J. Fluids Eng. 130 (2008) 078001), whose ratios of sizes may differ.

    Where the values do not run one way, or the order is out of reason (below 1/2 or above 3), there is none, and the index is
    that of two meshes with Roache's safety of 3, without an extrapolation.

    >>> order, limit, index = grid_convergence(1.01, 1.04, 1.16, 2, 2)
    >>> round(order, 6), round(limit, 6), round(index, 6)
    (2.0, 1.0, 0.012376)
    >>> order, limit, index = grid_convergence(1 + 4.0**-2, 1 + 3.0**-2, 1 + 2.0**-2, 4 / 3, 3 / 2)
    >>> round(order, 6), round(limit, 6)
    (2.0, 1.0)
    """
    first, second = middle - fine, coarse - middle
    if first == 0 or second / first <= 0:
        return float("nan"), fine, 3 * abs(first / fine)
    order = 1.0
    for _ in range(200):  # a fixed point: e32/e21 = (r32^p - 1) r21^p / (r21^p - 1)
        correction = log((middle_over_fine**order - 1) / (coarse_over_middle**order - 1))
        order = max(1e-3, 0.5 * order + 0.5 * (log(second / first) + correction) / log(middle_over_fine))
    if not 0.5 <= order <= 3:
        return float("nan"), fine, 3 * abs(first / fine)
    step = middle_over_fine**order - 1
    return order, fine - first / step, 1.25 * abs(first / fine) / step
