"""A slug that strikes a head: what it must come to, and what it cannot exceed.

The front that goes back into the slug stops it, and leaves the pressure of Hugoniot, density (c + s v) v, behind it, until it comes back
as a wave of the free lower face. The momentum that the slug loses is the impulse on the head: walls that are struck along their length
have none. A rigid-plastic head that takes all of the energy as the membrane of a cone is bent the farthest.
"""
from math import pi, sqrt


def plane_pressure(density, sound_speed, slope, speed):
    """Pressure behind the front [Pa].

    >>> round(plane_pressure(1000, 1480, 1.75, 10) / 1e6, 3)
    14.975
    """
    return density * (sound_speed + slope * speed) * speed


def time_of_impact(gap, speed):
    """[s]

    >>> time_of_impact(0.2, 20)
    0.01
    """
    return gap / speed


def most_rise(energy, thickness, yield_stress):
    """Height of a cone over a clamped disc whose membrane has taken the energy [m]: 1/2 pi w^2 t yield = energy.

    The slope of the cone is small, so its area grows by 1/2 pi w^2 for any radius. Bending and hardening are left out, so the plate takes
    more, and stays below.

    >>> round(most_rise(pi / 2 * 0.01 * 1e-3 * 300e6, 1e-3, 300e6), 12)
    0.1
    """
    return sqrt(2 * energy / (pi * thickness * yield_stress))
