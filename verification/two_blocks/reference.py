"""Symmetric collision of two elastic bars, by d'Alembert's solution.

Contact starts when the gap closes and lasts until the release waves return from the free ends, one
round trip later. With poisson = 0 a block is exactly a bar.
"""
from math import sqrt


def reference(density, young, length, width, gap, closing_speed):
    """Exact values in SI units.

    >>> steel = reference(7850, 210e9, 0.1, 0.01, 1e-5, 10)
    >>> round(steel["interface_stress"] / 1e6, 1), round(steel["contact_time"] * 1e6, 2)
    (203.0, 38.67)
    """
    c = sqrt(young / density)
    first, last = gap / closing_speed, gap / closing_speed + 2 * length / c
    return {
        "plateau": (first + 0.1 * (last - first), last - 0.1 * (last - first)),  # [s]
        "interface_stress": density * c * closing_speed / 2,                     # [Pa]
        "contact_time": last - first,                                            # [s]
        "velocity_A": -closing_speed / 2,                                        # [m/s] after separation
        "velocity_B": closing_speed / 2,
    }
