"""A mass let go on a spring beside a dashpot: m u'' + c u' + k u = m g from rest at u = 0, with less than critical damping.

It swings about its static sag, each swing smaller than the one before by the factor exp(-delta). The logarithmic decrement delta
and its example are those of W. T. Thomson, Theory of Vibration with Applications, sections 2.6 and 2.7; the rest follows from the
solution of this equation, which the section on viscous damping there derives.
"""
from math import cos, exp, pi, sin, sqrt


def damping_factor(mass, stiffness, damping):
    """Damping over critical damping [-].

    Thomson's example 2.7-1: 10 lb on 30 lb/in with 0.12 lb s/in, g = 386 in/s2.

    >>> round(damping_factor(10 / 386, 30, 0.12), 4)
    0.0681
    """
    return damping / (2 * sqrt(stiffness * mass))


def decrement(mass, stiffness, damping):
    """Logarithm of the ratio of two amplitudes one period apart [-].

    >>> round(decrement(10 / 386, 30, 0.12), 3)
    0.429
    >>> round(exp(decrement(10 / 386, 30, 0.12)), 2)
    1.54
    """
    factor = damping_factor(mass, stiffness, damping)
    return 2 * pi * factor / sqrt(1 - factor**2)


def period(mass, stiffness, damping):
    """From one swing to the next [s].

    >>> round(2 * pi / period(10 / 386, 30, 0) , 1)
    34.0
    """
    return 2 * pi / (sqrt(stiffness / mass) * sqrt(1 - damping_factor(mass, stiffness, damping) ** 2))


def static_sag(gravity, mass, stiffness, damping):
    """Where it comes to rest [m]."""
    return mass * gravity / stiffness


def sag(t, gravity, mass, stiffness, damping):
    """How far it is below its start at the time t [m].

    Without a dashpot the lowest place is twice the static sag, and with one it is passed by less, by exp(-delta/2).

    >>> round(sag(period(2, 50, 0) / 2, 9.81, 2, 50, 0) / static_sag(9.81, 2, 50, 0), 12)
    2.0
    >>> round(sag(period(2, 50, 3) / 2, 9.81, 2, 50, 3) / static_sag(9.81, 2, 50, 3) - 1 - exp(-decrement(2, 50, 3) / 2), 12)
    0.0
    """
    decay = damping / (2 * mass)
    turning = 2 * pi / period(mass, stiffness, damping)
    return static_sag(gravity, mass, stiffness, damping) * (1 - exp(-decay * t) * (cos(turning * t) + decay / turning * sin(turning * t)))


def speed(t, gravity, mass, stiffness, damping):
    """How fast it goes down [m/s]: the derivative of the sag.

    >>> step, case = 1e-5, (9.81, 2, 50, 3)
    >>> round((sag(0.7 + step, *case) - sag(0.7 - step, *case)) / (2 * step) - speed(0.7, *case), 8)
    0.0
    """
    turning = 2 * pi / period(mass, stiffness, damping)
    return gravity / turning * exp(-damping / (2 * mass) * t) * sin(turning * t)


def heat(t, gravity, mass, stiffness, damping):
    """What the dashpot has turned into heat by the time t [J]: the work of gravity less what spring and motion hold.

    At last half of what gravity gave is heat, whatever the dashpot.

    >>> round(heat(1000, 9.81, 2, 50, 3) / (2 * 9.81 * static_sag(9.81, 2, 50, 3)), 12)
    0.5
    """
    case = (gravity, mass, stiffness, damping)
    down, fast = sag(t, *case), speed(t, *case)
    return mass * gravity * down - stiffness * down**2 / 2 - mass * fast**2 / 2
