"""The highest frequency of a free brick, and what a step beyond the stable one does.

A brick h1 x h2 x h3 that strains uniformly, u = diag(e1, e2, e3) x, an eighth of its mass at each corner (m = rho h1 h2 h3), stores
V/2 e C e and moves m/8 sum of e_i^2 h_i^2, so its squared frequencies are those of

    M_ij = 4 C_ij / (rho h_i h_j),    C_ii = lambda + 2 mu, C_ij = lambda.

The same follows for one point and for eight. For a cube  omega = 2 c/h sqrt((1 + nu)/(1 - nu)),  c^2 = (lambda + 2 mu)/rho.

Central differences with the step dt multiply the amplitude of a mode in each step by a root of q^2 - (2 - (omega dt)^2) q + 1 = 0:
of size 1 up to omega dt = 2, beyond it by  -q = s + sqrt(s^2 - 1),  s = (omega dt)^2 / 2 - 1.
"""
from math import acos, cos, pi, sqrt


def lame(young, poisson):
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))


def highest_frequency(sides, young, poisson, density):
    """omega [1/s], by the closed form of the eigenvalues of a symmetric matrix of order three (Smith 1961).

    >>> from math import isclose
    >>> c = sqrt(210e9 * 0.7 / (1.3 * 0.4) / 7850)
    >>> isclose(highest_frequency([0.1, 0.1, 0.1], 210e9, 0.3, 7850), 2 * c / 0.1 * sqrt(1.3 / 0.7), rel_tol=1e-14)
    True

    The catalogue's steps 2 / omega of a cube, in h/c:

    >>> def step(nu): return 2 / highest_frequency([1, 1, 1], 1, nu, (1 - nu) / ((1 + nu) * (1 - 2 * nu)))
    >>> [round(step(nu), 4) for nu in (0.3, 0.42, 0.49)]
    [0.7338, 0.6391, 0.585]
    """
    lam, mu = lame(young, poisson)
    M = [[4 * (lam + (2 * mu if i == j else 0)) / (density * sides[i] * sides[j]) for j in range(3)] for i in range(3)]
    mean = sum(M[i][i] for i in range(3)) / 3
    size = sqrt(sum((M[i][j] - (mean if i == j else 0))**2 for i in range(3) for j in range(3)) / 6)
    B = [[(M[i][j] - (mean if i == j else 0)) / size for j in range(3)] for i in range(3)]
    half_det = (B[0][0] * (B[1][1] * B[2][2] - B[1][2]**2) - B[0][1] * (B[0][1] * B[2][2] - B[1][2] * B[0][2])
                + B[0][2] * (B[0][1] * B[1][2] - B[1][1] * B[0][2])) / 2
    return sqrt(mean + 2 * size * cos(acos(max(-1, min(1, half_det))) / 3))


def growth(part):
    """Amplitude after a step over that before, for a step of `part` times the stable one.

    >>> growth(0.99), growth(1.0)
    (1.0, 1.0)
    >>> round(growth(1.02), 4)
    1.4908
    """
    s = max(2 * part * part - 1, 1)
    return s + sqrt(s * s - 1)


def flanagan_belytschko(poisson):
    """Their bound of a cube's step [h/c], which knows nothing of Poisson's ratio: 1/sqrt(3).

    >>> round(flanagan_belytschko(0.3), 4)
    0.5774
    """
    return 1 / sqrt(3)
