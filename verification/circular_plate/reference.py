"""A thin circular plate clamped at its rim: deflection under uniform pressure, frequencies.

Pressure q on the radius a, bending stiffness D = E t^3 / (12 (1 - nu^2)):  w = q (a^2 - r^2)^2 / (64 D), in the middle q a^4 / (64 D).
Free vibration  W = (J_n(k r) + C I_n(k r)) cos(n phi)  with W = W' = 0 at the rim, so with z = k a

    J_n(z) I_n'(z) - J_n'(z) I_n(z) = 0,     f = z^2 / (2 pi a^2) sqrt(D / (rho t)).

(Leissa, Vibration of Plates, NASA SP-160, 1969, table 2.1; Timoshenko & Woinowsky-Krieger, 1959, art. 17.)
"""
from math import factorial, pi, sqrt


def bessel(order, z, sign):
    """J_n(z) by its power series (sign -1), or I_n(z) (sign 1).

    >>> round(bessel(0, 2.404825557695773, -1), 12) + 0.0
    0.0
    >>> round(bessel(1, 1.0, 1), 10)
    0.565159104
    """
    return sum(sign**m * (z / 2)**(2 * m + order) / (factorial(m) * factorial(m + order)) for m in range(60))


def slope(order, z, sign):
    """Derivative of J_n or I_n: half of the two beside it, J_{n-1} - J_{n+1} and I_{n-1} + I_{n+1}."""
    before = sign * bessel(1, z, sign) if order == 0 else bessel(order - 1, z, sign)
    return 0.5 * (before + sign * bessel(order + 1, z, sign))


def roots(order, count):
    """z^2 of the first modes with `order` nodal diameters.

    >>> [round(v, 4) for v in roots(0, 2)], [round(v, 4) for v in roots(1, 1)], [round(v, 4) for v in roots(2, 1)]
    ([10.2158, 39.7711], [21.2604], [34.877])
    """
    def value(z):
        return bessel(order, z, -1) * slope(order, z, 1) - slope(order, z, -1) * bessel(order, z, 1)
    found, z, step = [], 1.0, 0.25
    while len(found) < count:
        low, high = z, z + step
        if value(low) * value(high) < 0:
            for _ in range(80):
                middle = (low + high) / 2
                low, high = (middle, high) if value(middle) * value(low) > 0 else (low, middle)
            found.append(low * low)
        z += step
    return found


def numbers(count):
    """z^2 of the first modes, each as often as it occurs: twice with nodal diameters.

    >>> [round(v, 4) for v in numbers(6)]
    [10.2158, 21.2604, 21.2604, 34.877, 34.877, 39.7711]
    """
    found = roots(0, 2)
    for order in range(1, 5):
        found += 2 * roots(order, 2)
    return sorted(found)[:count]


def bending_stiffness(young, poisson, thickness):
    return young * thickness**3 / (12 * (1 - poisson * poisson))


def frequency(number, radius, thickness, young, poisson, density):
    """[Hz]

    >>> round(frequency(10.2158, 1, 0.01, 210e9, 0.3, 7850), 3)
    25.448
    """
    return number / (2 * pi * radius**2) * sqrt(bending_stiffness(young, poisson, thickness) / (density * thickness))


def deflection(r, pressure, radius, thickness, young, poisson):
    """[m]

    >>> round(deflection(0, 1000, 1, 0.01, 210e9, 0.3) * 1e6, 2)
    812.5
    """
    return pressure * (radius**2 - r**2)**2 / (64 * bending_stiffness(young, poisson, thickness))
