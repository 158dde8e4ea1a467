"""A rigid mass strikes a bar: the bar answers as a dashpot until the wave returns from its other end.

Before 2 L/c the end of the bar moves with v and carries the stress rho c v, so M v' = -rho c A v:  v = V exp(-rho c A t/M).
A load F on the mass that begins with the touch: M v' = F - rho c A v, v = F/(rho c A) (1 - exp(-rho c A t/M)) from rest.
Saint-Venant's problem; Goldsmith, Impact (1960), par. 2.9; Timoshenko & Goodier, Theory of Elasticity, par. 171.
"""
from math import exp, sqrt


def rate(density, young, area, mass):
    """rho c A/M [1/s].

    >>> round(rate(1, 4, 3, 2), 12)
    3.0
    """
    return sqrt(density * young) * area / mass


def speed(t, velocity, decay):
    """Of the ram [m/s].

    >>> round(speed(0.5, 2, 2), 6)
    0.735759
    """
    return velocity * exp(-decay * t)


def mean_force(start, end, velocity, decay, mass):
    """Of the ram on the bar between two times [N]: what the ram lost of its momentum.

    >>> round(mean_force(0, 0.5, 2, 2, 3), 6)
    7.585447
    """
    return mass * (speed(start, velocity, decay) - speed(end, velocity, decay)) / (end - start)


def pressed_speed(t, load, decay, mass):
    """Of a ram that lies at the bar and is pressed from t = 0 on [m/s].

    >>> round(pressed_speed(1e9, 6, 1, 2), 9), round(pressed_speed(0.5, 4, 2, 2) / (1 - exp(-1)), 9)
    (3.0, 1.0)
    """
    return load / (decay * mass) * (1 - exp(-decay * t))
