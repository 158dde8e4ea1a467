"""A stretched body that spins: its stress turns with it.

The stretch is 1 + G with a symmetric G whose axes stand still while it grows, so the stress of a hypoelastic body is Hooke's of the
strain ln(1 + G); turned by R it is R sigma R^T, for every objective rate.

What is spun are nodes, and their velocities are sampled in the middle of each step. A point on a circle of radius r
that moves for a step h at the speed w r along the chord's direction goes w r h, and the chord is 2 r sin(w h/2) only: its polygon stands
about a larger circle, by (w h)^2/24, and off the centre. So a spin of given speed w is no rigid motion of a body that is sampled. One whose
velocity is less by sin(w h/2)/(w h/2) is: the nodes are on their circles at the end of every step. That is kinematics, and nothing of a
stress.
"""
from math import cos, log, pi, sin, sqrt

YOUNG, POISSON = 2.6, 0.3                            # [Pa] [-]
G = ((0.10, 0.04, 0), (0.04, -0.05, 0), (0, 0, 0.02))
RATE = 2 * pi                                        # [rad/s]
STEP = 0.0037552462638127098                         # [s] for which case.yaml is made


def chord_factor(step):
    """Chord over arc of a step [s]. [-]

    >>> h = 0.01
    >>> x, y, f = 1.0, 0.0, chord_factor(h)
    >>> for n in range(100):
    ...     angle = RATE * (n + 0.5) * h
    ...     x, y = x - f * RATE * h * sin(angle), y + f * RATE * h * cos(angle)
    ...     assert abs(x * x + y * y - 1) < 1e-13
    >>> abs(x - 1) < 1e-13 and abs(y) < 1e-13
    True
    """
    return sin(RATE * step / 2) / (RATE * step / 2)


def logarithm():
    """ln(1 + G), by its eigenvalues in the plane. [-]

    The exponential takes it back:

    >>> back, power, L = [[0.0] * 3 for _ in range(3)], ((1, 0, 0), (0, 1, 0), (0, 0, 1)), logarithm()
    >>> for n in range(1, 30):
    ...     back = [[x + y for x, y in zip(*rows)] for rows in zip(back, power)]
    ...     power = [[sum(power[i][k] * L[k][j] for k in range(3)) / n for j in range(3)] for i in range(3)]
    >>> max(abs(back[i][j] - (i == j) - G[i][j]) for i in range(3) for j in range(3)) < 1e-15
    True
    """
    a, b, c = 1 + G[0][0], G[0][1], 1 + G[1][1]
    middle, radius = (a + c) / 2, sqrt((a - c)**2 / 4 + b * b)
    first, second = log(middle + radius), log(middle - radius)
    # ln is linear in the matrix between two eigenvalues
    slope = (first - second) / (2 * radius)
    rest = first - slope * (middle + radius)
    return ((slope * a + rest, slope * b, 0), (slope * b, slope * c + rest, 0), (0, 0, log(1 + G[2][2])))


def prestress():
    """[Pa]"""
    strain, shear = logarithm(), YOUNG / (2 * (1 + POISSON))
    volume = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)) * sum(strain[i][i] for i in range(3))
    return tuple(tuple(2 * shear * strain[i][j] + (volume if i == j else 0) for j in range(3)) for i in range(3))


def turned_back(stress, angle):
    """R^T sigma R: the stress as the body sees it after a turn about z.

    >>> [[round(s, 12) for s in row] for row in turned_back(((0, 0, 0), (0, 3, 0), (0, 0, 1)), pi / 2)]
    [[3.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 1]]
    """
    R = ((cos(angle), -sin(angle), 0), (sin(angle), cos(angle), 0), (0, 0, 1))
    return tuple(tuple(sum(R[k][i] * stress[k][l] * R[l][j] for k in range(3) for l in range(3)) for j in range(3)) for i in range(3))
