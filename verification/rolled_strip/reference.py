"""A strip that is rolled up by a moment at its end.

An elastica of bending stiffness E I, clamped at one end, under the moment M = m 2 pi E I / L at the other has the constant curvature M / (E
I): it is an arc of the radius R = L / (2 pi m), and with m = 1 a full circle. The point at s stands at

    x = R sin(s/R),   z = R (1 - cos(s/R)).

E I of a strip without Poisson's effect is E b t^3 / 12. Its length along the middle does not change.
"""
from math import cos, pi, sin


def point(s, length, part=1.0):
    """Where the point at s of the strip stands.

    >>> [round(v, 12) + 0.0 for v in point(1, 1)]
    [0.0, 0.0]
    >>> [round(v, 6) for v in point(1, 1, 0.5)]
    [0.0, 0.63662]
    """
    radius = length / (2 * pi * part)
    return radius * sin(s / radius), radius * (1 - cos(s / radius))


def full_moment(young, width, thickness, length):
    """2 pi E I / L [N m]

    >>> round(full_moment(12, 1, 1, 2 * pi), 12)
    1.0
    >>> round(full_moment(young=210e9, width=0.0625, thickness=0.01, length=1.0), 9)  # of case.yaml
    6872.233929728
    """
    return 2 * pi * young * width * thickness**3 / 12 / length
