"""A column of linear fluid strikes a free rigid plate, and a half-space.

In the coordinates of the reference the fluid obeys d'Alembert's equation at any strength, so its end has the pressure rho c (V - v)
until the wave from the free end is back at 2L/c: V is the velocity with which it comes, v that of the end.

*A free plate* of the mass m per area: m v' = rho c (V - v), v = V (1 - exp(-rho c t/m)). G. I. Taylor, The pressure and impulse of
submarine explosion waves on plates (1941), in a wave of constant pressure.

*A half-space* of the impedance Z: Z v = rho c (V - v), so the pressure is rho c V Z/(rho c + Z). In a bar whose sides are held, as in a
half-space, Z = sqrt(rho (lambda + 2 mu)); in a bar with free sides Z = sqrt(rho E), which is the same without Poisson's ratio.
"""
from math import exp, sqrt


def speed(t, coming, impedance, mass):
    """Of the plate [m/s], which has this mass per area [kg/m2].

    >>> round(speed(0.2e-3, 10, 1.48e6, 200), 4), round(speed(0.5e-3, 10, 1.48e6, 200), 4)
    (7.7236, 9.7528)
    """
    return coming * (1 - exp(-impedance * t / mass))


def held_impedance(density, young, poisson):
    """Of a solid whose sides are held [kg/(m2 s)].

    >>> round(held_impedance(7850, 210e9, 0.3) / 1e6, 2), round(held_impedance(7850, 210e9, 0) / 1e6, 2)
    (47.11, 40.6)
    """
    return sqrt(density * young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)))


def pressure(coming, impedance, other):
    """Between a column of fluid and a half-space [Pa].

    >>> round(pressure(10, 1.48e6, held_impedance(7850, 210e9, 0.3)) / 1e6, 3)
    14.349
    >>> round(pressure(10, 1.48e6, held_impedance(7850, 210e9, 0)) / 1e6, 2), pressure(10, 1.48e6, 1e99) / 1e6
    (14.28, 14.8)
    """
    return impedance * coming / (1 + impedance / other)
