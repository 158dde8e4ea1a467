"""A thin square plate under uniform pressure: deflections on simple supports (Navier) and clamped (Ritz).

Kirchhoff's plate, D = E t^3 / (12 (1 - nu^2)), side a, pressure q. On simple supports

    w = 16 q / (pi^6 D) sum over odd m, n of sin(m pi x/a) sin(n pi y/a) / (m n (m^2 + n^2)^2) a^4

(Navier 1823; Timoshenko & Woinowsky-Krieger, 1959, table 8: 0.00406 q a^4/D in the middle). Clamped, the energy
D/2 integral of (w_xx + w_yy)^2 - q w (the rest of the bending energy is that of the rim, which does not move) is made least over the
products of polynomials (1 - x^2)^2 x^i times the same of y, made orthonormal (table 35 there: 0.00126 q a^4/D).
"""
from math import cos, pi, sin, sqrt


def simply_supported(x, y, terms=60):
    """w D / (q a^4) at x, y from 0 to 1.

    >>> round(simply_supported(0.5, 0.5), 7)
    0.0040624
    """
    odd = range(1, terms, 2)
    return 16 / pi**6 * sum(sin(m * pi * x) * sin(n * pi * y) / (m * n * (m * m + n * n)**2) for m in odd for n in odd)


def gauss(points):
    """Abscissae and weights on [-1, 1], by Newton on Legendre's polynomial."""
    abscissae, weights = [], []
    for k in range(points):
        x = cos(pi * (k + 0.75) / (points + 0.5))
        for _ in range(50):
            p, q = 1.0, x
            for n in range(2, points + 1):
                p, q = q, ((2 * n - 1) * x * q - (n - 1) * p) / n
            slope = points * (x * q - p) / (x * x - 1)
            x -= q / slope
        abscissae.append(x)
        weights.append(2 / ((1 - x * x) * slope * slope))
    return abscissae, weights


def clamped_functions(count, at=()):
    """Even orthonormal polynomials (1 - x^2)^2 x^(2i) on [-1, 1]: (value, second derivative) at Gauss's points, then at others."""
    abscissae, weights = gauss(2 * count + 6)
    points = [*abscissae, *at]
    # (1 - x^2)^2 x^k and its second derivative
    def power(x, k):
        def second(n):
            return n * (n - 1) * x**(n - 2) if n > 1 else 0.0
        return (1 - x * x)**2 * x**k, second(k) - 2 * second(k + 2) + second(k + 4)
    family = []
    for i in range(count):
        f = [power(x, 2 * i) for x in points]
        for _ in range(2):
            for g in family:
                share = sum(w * u[0] * v[0] for w, u, v in zip(weights, f, g))
                f = [(u[0] - share * v[0], u[1] - share * v[1]) for u, v in zip(f, g)]
        norm = sqrt(sum(w * u[0]**2 for w, u in zip(weights, f)))
        family.append([(u[0] / norm, u[1] / norm) for u in f])
    return family, weights


def solve(matrix, right):
    """By elimination, largest pivot first."""
    rows = [list(row) + [b] for row, b in zip(matrix, right)]
    n = len(rows)
    for i in range(n):
        p = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[p] = rows[p], rows[i]
        for k in range(i + 1, n):
            part = rows[k][i] / rows[i][i]
            rows[k] = [a - part * b for a, b in zip(rows[k], rows[i])]
    for i in reversed(range(n)):
        rows[i][n] = (rows[i][n] - sum(rows[i][k] * rows[k][n] for k in range(i + 1, n))) / rows[i][i]
    return [row[n] for row in rows]


def clamped(places, count=6):
    """w D / (q a^4) along the middle line, at places from 0 to 1.

    >>> round(clamped([0.5])[0], 7)
    0.0012653
    """
    family, weights = clamped_functions(count, [0.0, *(2 * x - 1 for x in places)])
    def integral(i, k, a, b):
        return sum(w * u[a] * v[b] for w, u, v in zip(weights, family[i], family[k]))
    bend = [[integral(i, k, 1, 1) for k in range(count)] for i in range(count)]
    mixed = [[integral(i, k, 0, 1) for k in range(count)] for i in range(count)]
    mean = [sum(w * u[0] for w, u in zip(weights, f)) for f in family]
    pairs = [(i, j) for i in range(count) for j in range(count)]
    stiffness = [[bend[i][k] * (j == l) + (i == k) * bend[j][l] + mixed[i][k] * mixed[l][j] + mixed[k][i] * mixed[j][l] for k, l in pairs]
                 for i, j in pairs]
    shares = solve(stiffness, [mean[i] * mean[j] for i, j in pairs])
    first = len(weights)  # the middle, then the places
    return [sum(c * family[i][first + 1 + p][0] * family[j][first][0] for c, (i, j) in zip(shares, pairs)) / 16 for p in range(len(places))]


def bending_stiffness(young, poisson, thickness):
    return young * thickness**3 / (12 * (1 - poisson * poisson))
