"""A displacement field that no solid would take by itself, and the body force that makes it.

    u_i = A_i s(x) s(y) s(z) cos(w t),   s(x) = sin(pi x)

Linear elasticity asks for the body force per mass

    b_i = d2 u_i/dt2 - (1/rho) d sigma_ij/dx_j
        = (3 pi^2 mu/rho - w^2) u_i - (lambda + mu)/rho  d/dx_i sum_j du_j/dx_j,

with sigma_ij = lambda e_kk delta_ij + 2 mu e_ij, because the Laplacian of u_i is -3 pi^2 u_i. Method: P. J. Roache, J. Fluids
Eng. 124 (2002) 4; K. Salari, P. Knupp, SAND2000-1444.
"""
from math import cos, pi, sin

AMPLITUDE = (1e-6, -2e-6, 1.5e-6)  # [m]
OMEGA = 4.0                        # [rad/s]
LAMBDA, MU, DENSITY = 1.0, 1.0, 1.0  # [Pa] [Pa] [kg/m3]: Young's modulus 2.5 Pa, Poisson's ratio 1/4


def displacement(x, y, z, t):
    """[m]

    >>> [round(1e6 * u, 6) for u in displacement(0.5, 0.5, 0.5, 0)]
    [1.0, -2.0, 1.5]
    """
    shape = sin(pi * x) * sin(pi * y) * sin(pi * z) * cos(OMEGA * t)
    return tuple(a * shape for a in AMPLITUDE)


def slopes(x, y, z):
    """Of s(x) s(y) s(z): along x, y, z. [1/m]"""
    sx, sy, sz, cx, cy, cz = sin(pi * x), sin(pi * y), sin(pi * z), cos(pi * x), cos(pi * y), cos(pi * z)
    return pi * cx * sy * sz, pi * sx * cy * sz, pi * sx * sy * cz


def stress(x, y, z, t):
    """xx, yy, zz, xy, yz, xz. [Pa]

    Hooke's law with gradients taken by differences says the same.

    >>> at, h = (0.3, 0.7, 0.45, 0.2), 1e-4
    >>> def slope(i, j):
    ...     ahead, behind = list(at), list(at)
    ...     ahead[j] += h
    ...     behind[j] -= h
    ...     return (displacement(*ahead)[i] - displacement(*behind)[i]) / (2 * h)
    >>> trace = slope(0, 0) + slope(1, 1) + slope(2, 2)
    >>> by_differences = [LAMBDA * trace + 2 * MU * slope(i, i) for i in range(3)]
    >>> by_differences += [MU * (slope(i, j) + slope(j, i)) for i, j in ((0, 1), (1, 2), (0, 2))]
    >>> max(abs(a - b) for a, b in zip(stress(*at), by_differences)) < 1e-6 * max(abs(s) for s in stress(*at))
    True
    """
    g, (a, b, c), now = slopes(x, y, z), AMPLITUDE, cos(OMEGA * t)
    volume = LAMBDA * (a * g[0] + b * g[1] + c * g[2])
    return tuple(now * s for s in (volume + 2 * MU * a * g[0], volume + 2 * MU * b * g[1], volume + 2 * MU * c * g[2],
                                   MU * (a * g[1] + b * g[0]), MU * (b * g[2] + c * g[1]), MU * (a * g[2] + c * g[0])))


def body_force(x, y, z, t):
    """Per mass. [m/s2]

    It is what the acceleration and the divergence of the stress leave, both by differences:

    >>> at, h = (0.3, 0.7, 0.45, 0.2), 1e-4
    >>> def moved(axis, by):
    ...     return tuple(value + (by if i == axis else 0) for i, value in enumerate(at))
    >>> place = ((0, 3, 5), (3, 1, 4), (5, 4, 2))
    >>> worst = 0
    >>> for i in range(3):
    ...     acceleration = sum(w * displacement(*moved(3, d))[i] for w, d in ((1, h), (-2, 0), (1, -h))) / h**2
    ...     divergence = sum((stress(*moved(j, h))[place[i][j]] - stress(*moved(j, -h))[place[i][j]]) / (2 * h) for j in range(3))
    ...     worst = max(worst, abs(acceleration - divergence / DENSITY - body_force(*at)[i]))
    >>> worst < 1e-5 * max(abs(b) for b in body_force(*at))
    True
    """
    sx, sy, sz, cx, cy, cz = sin(pi * x), sin(pi * y), sin(pi * z), cos(pi * x), cos(pi * y), cos(pi * z)
    a, b, c = AMPLITUDE
    p = sx * sy * sz
    # second derivatives of p over pi^2: xx, yy and zz are -p
    xy, yz, xz = cx * cy * sz, sx * cy * cz, cx * sy * cz
    grad_div = (-a * p + b * xy + c * xz, a * xy - b * p + c * yz, a * xz + b * yz - c * p)
    inertia = 3 * pi**2 * MU / DENSITY - OMEGA**2
    return tuple((inertia * amplitude * p - (LAMBDA + MU) / DENSITY * pi**2 * g) * cos(OMEGA * t)
                 for amplitude, g in zip(AMPLITUDE, grad_div))
