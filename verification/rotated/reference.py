"""The turn of all scenes of this folder, and what it does to vectors and tensors.

A turn Q takes positions x to Q x + b, vectors v to Q v and stresses s to Q s Q^T; numbers without a direction stay. Q is
Rodrigues' matrix about an axis that is parallel to nothing in the scenes, by an angle that is no part of a circle.
"""
from math import cos, sin, sqrt

AXIS, ANGLE = (1.0, -2.0, 0.7), 2.1   # [-], [rad]
SHIFT = (0.03, -0.02, 0.05)           # [m] about the size of the scenes


def turn(axis=AXIS, angle=ANGLE):
    """Q = 1 + sin(angle) K + (1 - cos(angle)) K K, K the cross product with the unit axis.

    >>> Q = turn()
    >>> off = [sum(a * b for a, b in zip(Q[i], Q[j])) - (i == j) for i in range(3) for j in range(3)]
    >>> max(abs(x) for x in off) < 1e-15
    True
    >>> [round(x, 15) for x in (sum(q * a for q, a in zip(row, AXIS)) for row in Q)]    # the axis stays
    [1.0, -2.0, 0.7]
    """
    length = sqrt(sum(a * a for a in axis))
    a, b, c = (x / length for x in axis)
    K = ((0, -c, b), (c, 0, -a), (-b, a, 0))
    KK = [[sum(K[i][k] * K[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    return [[(i == j) + sin(angle) * K[i][j] + (1 - cos(angle)) * KK[i][j] for j in range(3)] for i in range(3)]
