"""Two elastic bars that collide, by d'Alembert's solution, and how many steps the elements alone need.

With poisson = 0 a bar is exactly one-dimensional, and the stable step of an element that is `size` long is size / c.
"""
from math import sqrt


def reference(density, young, length, gap, closing_speed):
    """Exact values in SI units.

    >>> steel = reference(7850, 210e9, 0.1, 1e-5, 10)
    >>> round(steel["stress"] / 1e6, 1), round(steel["first"] * 1e6, 2), round(steel["time"] * 1e6, 2)
    (203.0, 1.0, 38.67)
    """
    c = sqrt(young / density)
    return {"stress": density * c * closing_speed / 2, "first": gap / closing_speed, "time": 2 * length / c, "speed": closing_speed / 2,
            "c": c}
