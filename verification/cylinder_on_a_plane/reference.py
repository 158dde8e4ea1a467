"""Hertz's contact of a cylinder on a plane, in plane strain.

Hertz (1882), in Johnson, Contact Mechanics, section 4.2(c): under the force P per length, with 1/E* = 2 (1 - nu^2)/E of two bodies of one
material and the radius R,

    a = sqrt(4 P R/(pi E*)),   p0 = sqrt(P E*/(pi R)) = 2 P/(pi a),   p = p0 sqrt(1 - x^2/a^2)

for half-spaces and a parabola in the place of the circle. Unlike the approach, neither of them needs a distance at which something is held.
A body of the size W changes them by a share of (a/W)^2, and the circle and finite strain by shares of (a/R)^2 and p0/E.
"""
from math import asin, pi, sqrt


def hertz(force, radius, young, poisson):
    """Values in SI units, of the force per length.

    >>> line = hertz(863073.0, 0.1, 200e9, 0.3)
    >>> round(1e3 * line["half_width"], 5), round(line["pressure"] / 1e6, 2)
    (1.0, 549.45)
    >>> abs(pi / 2 * line["half_width"] * line["pressure"] / 863073.0 - 1) < 1e-12
    True
    """
    modulus = young / (2 * (1 - poisson**2))
    half_width = sqrt(4 * force * radius / (pi * modulus))
    return {"half_width": half_width, "pressure": 2 * force / (pi * half_width)}


def pressure_at(x, half_width, pressure):
    """[Pa]

    >>> pressure_at(0.6, 1.0, 10.0), pressure_at(-1.1, 1.0, 10.0)
    (8.0, 0.0)
    """
    return pressure * sqrt(max(0.0, 1 - (x / half_width)**2))


def integrals(x):
    """Of sqrt(1 - x^2) and of x sqrt(1 - x^2) from 0 to x; x beyond 1 counts as 1."""
    x = min(1.0, x)
    root = sqrt(1 - x * x)
    return 0.5 * (x * root + asin(x)), (1 - root**3) / 3


def weighted_mean(x, left, right, half_width, pressure):
    """The mean of Hertz's pressure with the shape function of the node x as weight: 1 at x, 0 at both neighbours. The node 0 has the left
    neighbour 0: it is on the axis of symmetry.

    >>> round(weighted_mean(0.5, 0.4, 0.7, 1.0, 1.0), 6)   # by the midpoint rule with a million points
    0.842613
    >>> round(weighted_mean(0.0, 0.0, 1e-3, 1.0, 1.0), 6), weighted_mean(1.2, 1.1, 1.3, 1.0, 1.0)
    (1.0, 0.0)
    """
    total = 0.0
    for end in (left, right):
        low, high = min(x, end) / half_width, max(x, end) / half_width
        if high > low:
            (plain_low, first_low), (plain_high, first_high) = integrals(low), integrals(high)
            plain, first = plain_high - plain_low, first_high - first_low
            total += abs(first - end / half_width * plain) / (high - low)
    return pressure * total * half_width / (0.5 * (right - left))
