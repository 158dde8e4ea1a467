"""Frequencies of a thin square plate: on simple supports in closed form, free or clamped on one side by Ritz's method.

Kirchhoff's plate, bending stiffness D = E t^3 / (12 (1 - nu^2)), mass rho t per area. With a dimensionless number L = omega a^2 sqrt(rho t
/ D),

    f = L / (2 pi a^2) sqrt(D / (rho t)).

On four simple supports L = pi^2 (m^2 + n^2) (Navier). Else the strain energy

    D/2 integral of w_xx^2 + w_yy^2 + 2 nu w_xx w_yy + 2 (1 - nu) w_xy^2

is made least over products of polynomials of x and of y: Legendre's on free sides, those with a double zero at a clamped one, made
orthonormal. Polynomials leave free sides free, so the numbers come down to the exact ones from above as the degree grows (Ritz 1909;
Leissa, J. Sound Vib. 31 (1973) 257, has nearly the same, from fewer functions and so a little higher).
"""
from math import pi, sqrt

NU = 0.3


def gauss(points):
    """Abscissae and weights on [-1, 1], by Newton on Legendre's polynomial.

    >>> round(sum(w * x**4 for x, w in zip(*gauss(5))), 14)
    0.4
    """
    from math import cos
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


def functions(count, low=0, high=0):
    """Orthonormal polynomials on [-1, 1] times (1 + x)^low (1 - x)^high: values, slopes and second derivatives at Gauss's points.

    Made one from the other by multiplication with x and Gram and Schmidt, twice.
    """
    abscissae, weights = gauss(count + 2 + low + high)
    # (1 + x)^low (1 - x)^high and its derivatives, by the product rule
    def power(base, sign, n):
        return [base**n, sign * n * base**(n - 1) if n > 0 else 0.0, n * (n - 1) * base**(n - 2) if n > 1 else 0.0]
    f = []
    for x in abscissae:
        a, b = power(1 + x, 1, low), power(1 - x, -1, high)
        f.append([a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2 * a[1] * b[1] + a[0] * b[2]])
    family = []
    for _ in range(count):
        for _ in range(2):
            for g in family:
                share = sum(w * u[0] * v[0] for w, u, v in zip(weights, f, g))
                f = [[u[d] - share * v[d] for d in range(3)] for u, v in zip(f, g)]
        norm = sqrt(sum(w * u[0] * u[0] for w, u in zip(weights, f)))
        f = [[value / norm for value in u] for u in f]
        family.append(f)
        f = [[x * u[0], u[0] + x * u[1], 2 * u[1] + x * u[2]] for x, u in zip(abscissae, f)]
    return family, weights


def integrals(family, weights, i, j):
    """Of the products of derivatives i and j of all functions."""
    return [[sum(w * u[i] * v[j] for w, u, v in zip(weights, f, g)) for g in family] for f in family]


def stiffness(x_ends, y_ends, count, nu=NU, parity=None):
    """Ritz's matrix for D = 1 on the square from -1 to 1; the functions are orthonormal, so the mass is the unit matrix.

    parity: of x and y, 0 even or 1 odd, where both sides are alike; the classes do not mix.
    """
    sides = [functions(count, *ends) for ends in (x_ends, y_ends)]
    (a2, c, b, one), (A2, C, B, ONE) = ([integrals(*side, 2, 2), integrals(*side, 2, 0), integrals(*side, 1, 1), integrals(*side, 0, 0)]
                                        for side in sides)
    pairs = [(i, j) for i in range(count) for j in range(count)
             if parity is None or (parity[0] in (None, i % 2) and parity[1] in (None, j % 2))]
    return [[a2[i][k] * ONE[j][l] + one[i][k] * A2[j][l] + nu * (c[i][k] * C[l][j] + c[k][i] * C[j][l]) + 2 * (1 - nu) * b[i][k] * B[j][l]
             for k, l in pairs] for i, j in pairs]


def eigenvalues(matrix):
    """Of a symmetric matrix, ascending, by Jacobi's rotations.

    >>> [round(v, 12) for v in eigenvalues([[2, 1, 0], [1, 2, 0], [0, 0, 5]])]
    [1.0, 3.0, 5.0]
    """
    a, n = [[float(v) for v in row] for row in matrix], len(matrix)
    for _ in range(30):
        if sum(a[i][j]**2 for i in range(n) for j in range(i)) <= 1e-26 * sum(a[i][i]**2 for i in range(n)):
            break
        for p in range(n):
            for q in range(p + 1, n):
                if a[p][q] == 0:
                    continue
                theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
                t = (1 if theta >= 0 else -1) / (abs(theta) + sqrt(theta * theta + 1))
                c = 1 / sqrt(t * t + 1)
                s = t * c
                for k in range(n):
                    a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
                for k in range(n):
                    a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
    return sorted(a[i][i] for i in range(n))


def simply_supported(count):
    """L of the first modes, each as often as it occurs.

    >>> [round(L / pi**2, 12) for L in simply_supported(4)]
    [2.0, 5.0, 5.0, 8.0]
    """
    return sorted(pi**2 * (m * m + n * n) for m in range(1, 12) for n in range(1, 12))[:count]


def free(count, degree=12, nu=NU):
    """L of the first modes that bend.

    Leissa's numbers for nu = 0.3 are 13.489, 19.789, 24.432, 35.024 (twice), 61.526; Gorman's, by series, 13.468, 19.596, 24.270, 34.801.

    >>> [round(L, 3) for L in free(4)]
    [13.468, 19.596, 24.27, 34.801]
    """
    found = []
    for parity in ((0, 0), (0, 1), (1, 1)):  # a square: odd and even is even and odd
        values = [4 * sqrt(max(v, 0)) for v in eigenvalues(stiffness((0, 0), (0, 0), degree, nu, parity))]
        found += values * (2 if parity == (0, 1) else 1)
    return sorted(v for v in found if v > 1e-2)[:count]


def cantilever(count, degree=9, nu=NU):
    """L of the first modes, clamped at one side.

    Leissa's numbers, upper bounds of the catalogue, are 3.4917, 8.5246, 21.429, 27.331, 31.111.

    >>> [round(L, 2) for L in cantilever(5)]
    [3.47, 8.51, 21.29, 27.2, 30.96]
    """
    found = []
    for parity in (0, 1):
        found += [4 * sqrt(v) for v in eigenvalues(stiffness((2, 0), (0, 0), degree, nu, (None, parity)))]
    return sorted(found)[:count]


def frequency(number, side, thickness, young, density, nu=NU):
    """Of a plate with this L [Hz].

    >>> [round(frequency(L, 10, 0.05, 200e9, 8000), 4) for L in simply_supported(7)]
    [2.3767, 5.9418, 5.9418, 9.5069, 11.8836, 11.8836, 15.4487]
    """
    bending = young * thickness**3 / (12 * (1 - nu * nu))
    return number / (2 * pi * side**2) * sqrt(bending / (density * thickness))
