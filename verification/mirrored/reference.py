"""The mirror of all scenes of this folder, and what it does to vectors, turns and moments.

A mirror M takes positions x to M x and vectors v to M v, as a turn does. What has a sense about an axis goes the other way
round: a moment m becomes -M m, because M a x M b = -M (a x b).
"""
from math import cos, sin

ANGLE = 0.6   # [rad] of the mirror's normal against x, in the plane of x and y


def mirror(angle=ANGLE):
    """M = 1 - 2 n n^T of a plane through the origin.

    >>> M = mirror()
    >>> [[round(sum(M[i][k] * M[k][j] for k in range(3)), 15) for j in range(3)] for i in range(3)]     # twice is nothing
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    """
    n = (cos(angle), sin(angle), 0.0)
    return [[(i == j) - 2 * n[i] * n[j] for j in range(3)] for i in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def of_moment(m, angle=ANGLE):
    """The moment in the mirror.

    >>> a, b, M = (0.3, -1.2, 0.5), (2.0, 0.1, -0.7), mirror()
    >>> Ma, Mb = ([sum(r * x for r, x in zip(row, v)) for row in M] for v in (a, b))
    >>> max(abs(p - q) for p, q in zip(of_moment(cross(a, b)), cross(Ma, Mb))) < 1e-15
    True
    """
    return [-sum(r * x for r, x in zip(row, m)) for row in mirror(angle)]
