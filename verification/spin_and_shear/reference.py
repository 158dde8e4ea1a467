"""Simple shear of a hypoelastic body under three objective rates.

The rate of Jaumann turns the stress with the spin, half the shear rate: sigma_12 = mu sin(g), sigma_11 = mu (1 - cos(g)).
Green and Naghdi's turns it with the rotation of the polar decomposition (Dienes, Acta Mech. 32 (1979) 217), tan(b) = g/2.
Both are confirmed by integrating the rate equations, `integrated`.
"""
from math import asinh, atan, cos, log, sin, sqrt, tan


def jaumann(shear):
    """(sigma_12, sigma_11) over mu.

    >>> [round(s, 6) for s in jaumann(1.0)]
    [0.841471, 0.459698]
    """
    return sin(shear), 1 - cos(shear)


def green_naghdi(shear):
    """(sigma_12, sigma_11) over mu.

    >>> [round(s, 6) for s in green_naghdi(1.0)]
    [0.869784, 0.4159]
    """
    b = atan(shear / 2)
    s12 = 2 * cos(2 * b) * (2 * b - 2 * tan(2 * b) * log(cos(b)) - tan(b))
    s11 = 4 * (cos(2 * b) * log(cos(b)) + b * sin(2 * b) - sin(b)**2)
    return s12, s11


def logarithmic(shear):
    """(sigma_12, sigma_11) over mu of Hooke's law of the logarithmic strain: principal values +-asinh(g/2), turned by atan(2/g)/2.

    >>> [round(s, 6) for s in logarithmic(1.0)]
    [0.860818, 0.430409]
    """
    return 4 * asinh(shear / 2) / sqrt(4 + shear * shear), 2 * asinh(shear / 2) * shear / sqrt(4 + shear * shear)


def integrated(shear, spin, steps=20000):
    """(sigma_12, sigma_11) over mu by Runge and Kutta's method, for d sigma/dg = 2 mu d + w sigma - sigma w; `spin(g)` is w_12.

    >>> [abs(a - b) < 1e-9 for a, b in zip(integrated(4.0, lambda g: 0.5), jaumann(4.0))]
    [True, True]
    >>> [abs(a - b) < 1e-9 for a, b in zip(integrated(4.0, lambda g: 1 / (2 + g * g / 2)), green_naghdi(4.0))]
    [True, True]
    """
    def rate(g, s):
        w = spin(g)
        return 1 - 2 * w * s[1], 2 * w * s[0]

    s, h = (0.0, 0.0), shear / steps
    for i in range(steps):
        g = i * h
        k1 = rate(g, s)
        k2 = rate(g + h / 2, tuple(a + h / 2 * k for a, k in zip(s, k1)))
        k3 = rate(g + h / 2, tuple(a + h / 2 * k for a, k in zip(s, k2)))
        k4 = rate(g + h, tuple(a + h * k for a, k in zip(s, k3)))
        s = tuple(a + h / 6 * (p + 2 * q + 2 * r + t) for a, p, q, r, t in zip(s, k1, k2, k3, k4))
    return s
