"""Uniaxial compression of a block without friction, by the law."""
from math import log

YOUNG, POISSON, AREA, HEIGHT = 1e9, 0.3, 9e-4, 0.02  # [Pa], [-], [m2], [m]


def in_rates(height):
    """Force [N] at a part of the height: Hooke's law of the logarithmic strain, s = E ln(height) on the area height^(-2 nu).

    >>> round(in_rates(0.5))
    945553
    """
    return -YOUNG * log(height) * AREA * height ** (-2 * POISSON)


def neo_hookean(height):
    """Force [N] of W = mu/2 (tr b - 3 - 2 ln J) + lambda/2 (ln J)^2 at a part of the height, with the sides free.

    Side a: mu (a^2 - 1) + lambda ln(a^2 h) = 0, by Newton; nominal stress (mu (h^2 - 1) + lambda ln(a^2 h)) / h.

    >>> round(neo_hookean(0.999) / in_rates(0.999), 3)
    1.0
    """
    lame, mu = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
    square = height ** (-2 * POISSON)
    for _ in range(50):
        square -= (mu * (square - 1) + lame * log(square * height)) / (mu + lame / square)
    return -AREA * (mu * (height ** 2 - 1) + lame * log(square * height)) / height
