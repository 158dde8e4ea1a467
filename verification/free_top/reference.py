"""A free asymmetric top by Jacobi's elliptic functions, and a symmetric one by two rotations.

Landau & Lifshitz, Mechanics, par. 37: with J1 < J2 < J3, twice the energy D and L^2 > D J2 the spin about the middle axis is

    w2 = sqrt((D J3 - L^2) / (J2 (J3 - J2))) sn(s t, k),    s^2 = (J3 - J2)(L^2 - D J1) / (J1 J2 J3),
    k^2 = (J2 - J1)(D J3 - L^2) / ((J3 - J2)(L^2 - D J1)),

and for L^2 < D J2 the same with 1 and 3 exchanged. sn vanishes every 2 K(k). All differences are sums of squares here: D J3 - L^2 =
J1 (J3 - J1) w1^2 + J2 (J3 - J2) w2^2. Elliptic integrals by Carlson's duplication (B. C. Carlson, Numer. Algorithms 10 (1995) 13).

The axis of a symmetric top goes round its angular momentum L with |L|/J1; the top turns about its axis with w3 (J1 - J3)/J1 beside
(par. 35).
"""
from math import cos, pi, sin, sqrt


def brick(mass, a, b, c):
    """Moments of inertia of a brick with the edges a, b, c about its centre.

    >>> [round(J, 6) for J in brick(12, 1, 2, 3)]
    [13.0, 10.0, 5.0]
    """
    return [mass / 12 * (b * b + c * c), mass / 12 * (c * c + a * a), mass / 12 * (a * a + b * b)]


def carlson(x, y, z):
    """R_F(x, y, z).

    >>> round(carlson(1, 2, 0), 12)
    1.311028777146
    """
    while max(x, y, z) - min(x, y, z) > 1e-4 * (x + y + z):
        shift = sqrt(x * y) + sqrt(y * z) + sqrt(z * x)
        x, y, z = (x + shift) / 4, (y + shift) / 4, (z + shift) / 4
    mean = (x + y + z) / 3
    a, b = 1 - x / mean, 1 - y / mean
    e2, e3 = a * b - (a + b) ** 2, -a * b * (a + b)
    return (1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44) / sqrt(mean)


def elliptic(sine2, complement2):
    """F of the angle with this square of its sine, and of the modulus whose complement has this square: K(k) for 1, 1 - k^2.

    >>> abs(elliptic(1, 1) - pi / 2) < 1e-12
    True
    >>> round(elliptic(1, 0.5), 12)
    1.854074677301
    """
    return sqrt(sine2) * carlson(1 - sine2, 1 - (1 - complement2) * sine2, 1)


def turnings(J, spin, end):
    """Times at which the spin about the middle axis changes its sign up to `end` [s]; moments and spin in the axes of the body.

    A top that barely turns about its other axes takes the period of a small oscillation for one about its axis of least inertia:

    >>> times = turnings([1, 2, 3], [1, 1e-3, 1e-3], 60)
    >>> abs((times[1] - times[0]) / (pi / sqrt((2 - 1) * (3 - 1) / (2 * 3))) - 1) < 1e-5
    True
    """
    order = sorted(range(3), key=lambda i: J[i])
    even = order in ([0, 1, 2], [1, 2, 0], [2, 0, 1])
    (J1, J2, J3), (w1, w2, w3) = ([values[i] for i in order] for values in (J, spin))
    if not even:  # a mirror image turns the other way
        w1, w2, w3 = -w1, -w2, -w3
    rising = (J3 - J1) * w3 * w1 > 0  # J2 w2' = (J3 - J1) w3 w1
    below, above = J2 * (J2 - J1) * w2 * w2, J2 * (J3 - J2) * w2 * w2
    to_third, to_first = J1 * (J3 - J1) * w1 * w1 + above, J3 * (J3 - J1) * w3 * w3 + below  # D J3 - L^2 and L^2 - D J1
    if (J3 - J2) * to_first < (J2 - J1) * to_third:
        J1, J3, to_third, to_first, above = J3, J1, -to_first, -to_third, -below
    rate = sqrt((J3 - J2) * to_first / (J1 * J2 * J3))
    k2 = (J2 - J1) * to_third / ((J3 - J2) * to_first)
    quarter, start = elliptic(1, 1 - k2), elliptic(above / to_third, 1 - k2)
    away = rising == (w2 > 0)
    first = (2 * quarter - start if away else start) / rate
    return [first + 2 * n * quarter / rate for n in range(int((end - first) * rate / (2 * quarter)) + 1)] if first <= end else []


def rotated(vector, axis, angle):
    """By Rodrigues' formula, about an axis of any length.

    >>> [round(x, 12) for x in rotated([1, 0, 0], [0, 0, 2], pi / 2)]
    [0.0, 1.0, 0.0]
    """
    size = sqrt(sum(a * a for a in axis))
    n = [a / size for a in axis]
    along = sum(a * b for a, b in zip(n, vector))
    cross = [n[1] * vector[2] - n[2] * vector[1], n[2] * vector[0] - n[0] * vector[2], n[0] * vector[1] - n[1] * vector[0]]
    return [cos(angle) * v + sin(angle) * c + (1 - cos(angle)) * along * a for v, c, a in zip(vector, cross, n)]


def edge_of_symmetric(J, spin, time):
    """Where the first axis of a top with the moments J1, J1, J3 points at `time` [s].

    >>> [round(x, 12) for x in edge_of_symmetric([1, 1, 1], [0, 0, pi], 0.5)]
    [0.0, 1.0, 0.0]
    >>> [round(x, 12) for x in edge_of_symmetric([1, 1, 2], [0, 0, pi], 0.5)]
    [0.0, 1.0, 0.0]
    """
    momentum = [a * w for a, w in zip(J, spin)]
    own = rotated([1, 0, 0], [0, 0, 1], spin[2] * (J[0] - J[2]) / J[0] * time)
    return rotated(own, momentum, sqrt(sum(a * a for a in momentum)) / J[0] * time)
