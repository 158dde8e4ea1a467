"""A bar of two parts is one bar: d'Alembert's solution, u = (a/2)(g(x - ct) + g(x + ct)), as long as no pulse is at an end.

A rigid layer without mass between the parts, as thick as the gap over which they are tied, only moves what is behind it by its thickness.
"""
from math import exp, sqrt

INPUTS = {"young": 1e9, "density": 1000.0, "height": 1e-8, "width": 0.02}  # SI
TIME, TIE = 2e-4, 0.1  # [s] [m]


def pulse(x, t, young, density, height, width):
    """Displacement and velocity [m, m/s].

    >>> [f"{value:.6g}" for value in pulse(0.18, TIME, **INPUTS)]
    ['3.03265e-09', '-0.000151633']
    """
    c = sqrt(young / density)
    u = v = 0.0
    for sign in (-1, 1):
        s = (x + sign * c * t) / width
        g = height / 2 * exp(-s * s / 2)
        u += g
        v += -sign * c / width * s * g
    return u, v


def largest_velocity(young, density, height, width):
    """Of one pulse. [m/s]

    >>> f"{largest_velocity(**INPUTS):.6g}"
    '0.000151633'
    """
    return height / 2 * sqrt(young / density) / width * exp(-0.5)


def largest_stress(young, density, height, width):
    """Of one pulse: rho c times its velocity. [Pa]

    >>> f"{largest_stress(**INPUTS):.6g}"
    '151.633'
    """
    return sqrt(young * density) * largest_velocity(young, density, height, width)
