"""A bar that is let go after it was pulled, and a rigid mass that strikes a bar: d'Alembert's waves. SI units."""
import math


def wave_speed(density, young):
    return math.sqrt(young / density)


def stretch(stress, length, young):
    """Static displacement of the end of a bar whose section stays, by logarithmic strain: stress = E ln(1 + u/L). [m]

    >>> round(stretch(100e6, 1, 210e9), 10)
    0.0004763039
    """
    return length * math.expm1(stress / young)


def released_tip(time, static, length, speed):
    """Displacement of an end that is let go at time 0: straight from u to -u in 2L/c, and back. [m]

    >>> [released_tip(t, 1, 2, 10) for t in (0, 0.2, 0.4, 0.6, 0.8)]
    [1.0, 0.0, -1.0, 0.0, 1.0]
    """
    part = (time * speed / length) % 4
    return static * (1 - part if part < 2 else part - 3)


def ram_speed(time, initial, density, speed, area, mass):
    """Of a rigid mass on the end of a bar, until the wave is back after 2L/c: M dv/dt = -rho c A v. [m/s]

    >>> round(ram_speed(1, 3, 1, 1, 2, 2), 6)
    1.103638
    """
    return initial * math.exp(-density * speed * area * time / mass)
