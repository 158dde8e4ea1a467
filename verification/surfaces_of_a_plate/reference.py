"""A strip bent by a moment at its end: elementary theory of beams, elastic and perfectly plastic.

The moment M is the same in all sections, of the width b and the thickness t. Elastic the surface has the stress 6 M / b t^2. Without
hardening the stress is Y beyond the height c and Y z/c below it, so (S. Timoshenko, Strength of Materials II, chapter 9)

    M = Y b t^2/4 (1 - (c / (t/2))^2 / 3),     curvature = Y / E c
"""
from math import sqrt


def elastic_stress(moment, width, thickness):
    """At the surface [Pa].

    >>> elastic_stress(1, 20e-3, 2e-3) / 1e6
    75.0
    """
    return 6 * moment / (width * thickness**2)


def elastic_core(moment, width, thickness, yields):
    """The height c of the elastic core over half the thickness.

    >>> elastic_core(2 / 3, 1, 2, 1), elastic_core(1, 1, 2, 1)  # at first yield, and of a hinge
    (1.0, 0.0)
    """
    return sqrt(3 * (1 - moment / (yields * width * thickness**2 / 4)))


def surface_strain(moment, width, thickness, yields, young):
    """Total and plastic strain at the surface of a strip that yields.

    >>> total, plastic = surface_strain(1, 20e-3, 2e-3, 60e6, 210e9)
    >>> round(total / (60e6 / 210e9), 4), round(plastic / (60e6 / 210e9), 4)
    (1.4142, 0.4142)
    """
    total = yields / young / elastic_core(moment, width, thickness, yields)
    return total, total - yields / young
