"""What becomes of a result when its units do, or when the scene grows.

A result of dimension length^a mass^b time^c is multiplied by  l^a m^b t^c  where lengths, masses and times are multiplied by l, m, t:
equations without constants of their own know no unit. A product with a power of two is exact in binary numbers, and so
are sums, products, quotients and roots of such products; then not even round-off may differ.
"""
from math import sqrt

STANDARD_GRAVITY = 9.80665          # [m/s2] exact, 3rd CGPM 1901
POUND_FORCE = 4.4482216152605       # [N] exact
INCH = 0.0254                       # [m] exact

TWOS = (2.0**-7, 2.0**11, 2.0**-4)  # of length, mass and time
ANY = (0.137, 31.7, 2.71)


def factor(dimension, scale):
    """By what a result is multiplied.

    >>> factor((-1, 1, -2), TWOS) == 2.0**26      # a stress
    True
    >>> 0.1 * factor((1, 0, 0), TWOS) / factor((1, 0, 0), TWOS) == 0.1
    True
    >>> sqrt(0.1 * factor((2, 0, -2), TWOS)) == sqrt(0.1) * factor((1, 0, -1), TWOS)
    True
    """
    product = 1.0
    for one, power in zip(scale, dimension):
        product *= one ** power
    return product


def technical_density(density):
    """A density [kg/m3] in kgf s2/mm4, as tables of the technical system give it.

    >>> round(technical_density(11082) * 1e9, 3), round(technical_density(7845) * 1e10, 3)
    (1.13, 8.0)
    """
    return density / STANDARD_GRAVITY * 1e-12


def inch_density(density):
    """A density [kg/m3] in lbf s2/in4.

    >>> round(inch_density(7850) * 1e4, 3)
    7.345
    """
    return density / POUND_FORCE * INCH**4
