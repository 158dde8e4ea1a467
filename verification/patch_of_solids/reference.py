"""Constant strain in a patch of solids, at rest and in motion.

At rest: Irons' patch test on the cube of R. H. MacNeal and R. L. Harder (Finite Elements in Analysis and Design 1 (1985) 3),
u = strain (x + (y + z)/2, (x + z)/2 + y, (x + y)/2 + z), E = 1 MPa, Poisson's ratio 1/4.

In motion: x = (1 + s G) X with a symmetric G and s = t + 10 t^2. The deformation is the same everywhere, so the stress is, and no
force is left inside: the body force per mass is the acceleration, 20 G X. Central differences integrate a constant acceleration
exactly. The axes of stretch stand still, so the stress of a hypoelastic body is Hooke's of the strain ln(1 + s G).
"""

YOUNG, POISSON = 1e6, 0.25  # [Pa] [-]
G = ((1, 0.5, 0.5), (0.5, -1, 0.25), (0.5, 0.25, 0.5))


def hooke(strain):
    """Stress of a strain tensor: xx, yy, zz, xy, yz, xz. [Pa]

    >>> hooke(((1e-3, 5e-4, 5e-4), (5e-4, 1e-3, 5e-4), (5e-4, 5e-4, 1e-3)))
    (2000.0, 2000.0, 2000.0, 400.0, 400.0, 400.0)
    """
    shear = YOUNG / (2 * (1 + POISSON))
    volume = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)) * (strain[0][0] + strain[1][1] + strain[2][2])
    return tuple(volume + 2 * shear * strain[i][i] for i in range(3)) + tuple(2 * shear * strain[i][j] for i, j in ((0, 1), (1, 2), (0, 2)))


def at_rest(strain):
    """Stress of the patch at rest [Pa]; MacNeal and Harder have strain = 1e-3.

    >>> at_rest(1e-3)
    (2000.0, 2000.0, 2000.0, 400.0, 400.0, 400.0)
    """
    half = strain / 2
    return hooke(((strain, half, half), (half, strain, half), (half, half, strain)))


def way(t):
    """s(t). [-]"""
    return t + 10 * t * t


def displacement(X, t):
    """[m]

    >>> displacement((1, 0, 0), 0.1)
    (0.2, 0.1, 0.1)
    """
    return tuple(way(t) * sum(g * x for g, x in zip(row, X)) for row in G)


def product(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))


def logarithm(s):
    """ln(1 + s G), by its series; |s G| < 1. [-]

    The exponential takes it back:

    >>> L, power, back = logarithm(0.2), ((1, 0, 0), (0, 1, 0), (0, 0, 1)), [[0.0] * 3 for _ in range(3)]
    >>> for n in range(1, 30):
    ...     back = [[x + y for x, y in zip(*rows)] for rows in zip(back, power)]
    ...     power = tuple(tuple(x / n for x in row) for row in product(power, L))
    >>> max(abs(back[i][j] - (i == j) - 0.2 * G[i][j]) for i in range(3) for j in range(3)) < 1e-15
    True
    """
    step = tuple(tuple(s * g for g in row) for row in G)
    power, total = step, [[0.0] * 3 for _ in range(3)]
    for n in range(1, 200):
        for i in range(3):
            for j in range(3):
                total[i][j] += (-1)**(n + 1) * power[i][j] / n
        power = product(power, step)
    return tuple(tuple(row) for row in total)


def in_motion(t):
    """Stress of the patch in motion. [Pa]

    The rate of the strain is the symmetric part of G ds/dt (1 + s G)^-1; its sum over two hundred steps says the same:

    >>> one = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    >>> total = [[0.0] * 3 for _ in range(3)]
    >>> for n in range(200):
    ...     s = (n + 0.5) * 0.2 / 200
    ...     inverse, power = [[0.0] * 3 for _ in range(3)], one
    ...     for k in range(25):  # (1 + s G)^-1 by its series
    ...         inverse = [[a + (-s)**k * b for a, b in zip(*rows)] for rows in zip(inverse, power)]
    ...         power = product(power, G)
    ...     L = product(G, inverse)
    ...     total = [[a + 0.2 / 200 * b for a, b in zip(*rows)] for rows in zip(total, L)]
    >>> max(abs(a - b) for a, b in zip(hooke(total), in_motion(0.1))) < 1e-6 * max(abs(a) for a in in_motion(0.1))
    True
    """
    return hooke(logarithm(way(t)))
