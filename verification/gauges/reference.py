"""What gauges and accelerations must show: beams, uniaxial stress in any direction, and Newton's second law.

A cantilever with a force at its end has the moment M = F a at the distance a from the force, and at its surfaces the stress 6 M / b t^2.
Of a uniaxial stress s, at the angle w to its axis (Mohr's circle):

    stress  s cos^2 w,     strain  s/E (cos^2 w - nu sin^2 w)

A point at the distance r from an axis about which it turns with w changes its velocity within the time h by 2 w r sin(w h / 2).

A mass that starts with the velocity v at its place of rest swings as v/w sin(w t), and has the acceleration -v w sin(w t). A free body
under a force c t has the acceleration c t / m, the velocity c t^2 / 2m, and is given the power c^2 t^3 / 2m.
"""
from math import cos, radians, sin, sqrt


def surface_stress(force, arm, width, thickness):
    """Of a cantilever at its surface [Pa].

    >>> round(surface_stress(10, 0.05, 20e-3, 2e-3) / 1e6, 12)
    37.5
    """
    return 6 * force * arm / (width * thickness**2)


def stress_along(stress, degrees):
    """Of a uniaxial stress at an angle to its axis [Pa].

    >>> [round(stress_along(100, w), 9) for w in (0, 30, 45, 90)]
    [100.0, 75.0, 50.0, 0.0]
    """
    return stress * cos(radians(degrees))**2


def strain_along(stress, degrees, young, poisson):
    """Strain in a uniaxial stress at an angle to its axis.

    >>> [round(strain_along(210e9, w, 210e9, 0.3), 9) for w in (0, 45, 90)]
    [1.0, 0.35, -0.3]
    """
    return stress / young * (cos(radians(degrees))**2 - poisson * sin(radians(degrees))**2)


def swing(stiffness, mass, speed, first, last):
    """Mean acceleration of a mass on a spring over a span of time: the change of its velocity over the span [m/s2].

    >>> from math import pi
    >>> round(swing(1, 1, 1, 0, pi / 2), 9) == round(-2 / pi, 9)
    True
    """
    w = sqrt(stiffness / mass)
    return speed * (cos(w * last) - cos(w * first)) / (last - first)


def largest_of_swing(stiffness, mass, speed):
    """The largest acceleration [m/s2].

    >>> largest_of_swing(4, 1, 3)
    6.0
    """
    return speed * sqrt(stiffness / mass)


def towards_the_axis(spin, radius, span):
    """The mean acceleration of a point that goes round, over a span of time: the change of its velocity over the span [m/s2].

    >>> round(towards_the_axis(2, 3, 1e-6), 9)    # w^2 r of the moment
    12.0
    """
    return spin**2 * radius * sin(spin * span / 2) / (spin * span / 2)


def energy_given(growth, mass, t):
    """To a free body by a force that grows by `growth` [N/s] from zero [J]: the integral of c^2 t^3 / 2m.

    >>> energy_given(2, 1, 1)    # it has the velocity 1
    0.5
    """
    return (growth * t**2 / 2)**2 / (2 * mass)
