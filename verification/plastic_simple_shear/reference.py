"""Simple shear of a hypoelastic metal under the rate of Jaumann.

In simple shear by g the stretching is the shear 1/2 dg and the spin 1/2 dg, so shear stress s and normal stress n (-n across)
follow, per unit of g and before anything flows,

    s' = G - n,   n' = s,        s = G sin g,   n = G (1 - cos g).

The von Mises stress is sqrt(3) times r = |(s, n)|, so yielding begins where 2 G sin(g/2) = sy/sqrt(3). Beyond it, with (s, n) =
r (cos a, sin a), the flow runs along the stress: all of the stretching across (s, n) is elastic, of that along it the part
G H/(3 G + H) is left, and the spin turns,

    r' = G H/(3 G + H) cos a,      a' = 1 - G/r sin a.

Without hardening r stays, and a' = 1 - k sin a with k = G/r > 1 has the solution below: the stress stops turning where
sin a = r/G, where flow takes away as much as the spin turns. So nothing swings, unlike the elastic stress. Nagtegaal & de Jong
(1981) found that a back stress, which nothing takes away, does swing: `kinematic` integrates it too.
"""
from math import asin, atan, atanh, cos, hypot, sin, sqrt, tan, tanh

LEAD = {"young": 19.5, "poisson": 0.42, "yield": 3.02, "tangent": 1.85}  # [kgf/mm2]


def shear_modulus(metal):
    return metal["young"] / (2 * (1 + metal["poisson"]))


def plastic_modulus(metal):
    return metal["young"] * metal["tangent"] / (metal["young"] - metal["tangent"])


def first_yield(metal):
    """Shear at which flow begins.

    >>> round(first_yield(LEAD), 6)
    0.254627
    """
    return 2 * asin(metal["yield"] / sqrt(3) / (2 * shear_modulus(metal)))


def elastic(metal, shear):
    """(s, n) before anything flows: E-2's.

    >>> [round(x / shear_modulus(LEAD), 6) for x in elastic(LEAD, 1.0)]
    [0.841471, 0.459698]
    """
    G = shear_modulus(metal)
    return G * sin(shear), G * (1 - cos(shear))


def tangent_at_yield(metal):
    """ds/dg just beyond yield without spin: 1/(1/G + 3/H).

    >>> f"{tangent_at_yield(LEAD):.5f}"
    '0.61980'
    """
    return 1 / (1 / shear_modulus(metal) + 3 / plastic_modulus(metal))


def perfectly_plastic(metal, shear):
    """(s, n) without hardening: t = tan(a/2) follows 2 t' = 1 - 2 k t + t^2, so t = k - w coth(w/2 (g - g0) + c).

    >>> G, r = shear_modulus(LEAD), LEAD["yield"] / sqrt(3)
    >>> s, n = perfectly_plastic(LEAD, 50.0)
    >>> abs(n / r - r / G) < 1e-12, abs(hypot(s, n) - r) < 1e-12
    (True, True)
    >>> integrated = isotropic({**LEAD, "tangent": 0.0}, [0.5, 2.0])
    >>> max(abs(a - b) for at, g in zip(integrated, [0.5, 2.0]) for a, b in zip(at, perfectly_plastic(LEAD, g))) < 1e-9
    True
    """
    begin, r = first_yield(metal), metal["yield"] / sqrt(3)
    if shear <= begin:
        return elastic(metal, shear)
    k = shear_modulus(metal) / r
    w = sqrt(k * k - 1)
    start = atanh(w / (k - tan(begin / 4)))  # a = g/2 where the elastic curve ends
    a = 2 * atan(k - w / tanh(w / 2 * (shear - begin) + start))
    return r * cos(a), r * sin(a)


def isotropic(metal, shears, steps_per_unit=400):
    """(s, n) at ascending shears with a surface that grows.

    >>> begin = first_yield(LEAD)
    >>> (s0, _), (s1, n1) = isotropic(LEAD, [begin, begin + 1e-6])
    >>> a = begin / 2  # ds/dg = r' cos a - r a' sin a
    >>> r, G, H = LEAD["yield"] / sqrt(3), shear_modulus(LEAD), plastic_modulus(LEAD)
    >>> slope = G * H / (3 * G + H) * cos(a)**2 - r * (1 - G / r * sin(a)) * sin(a)
    >>> abs((s1 - s0) / 1e-6 - slope) < 1e-5
    True
    >>> fine, coarse = isotropic(LEAD, [4.0], 4000)[0], isotropic(LEAD, [4.0])[0]
    >>> max(abs(a - b) for a, b in zip(fine, coarse)) < 1e-9
    True
    >>> stresses = [s for s, _ in isotropic(LEAD, [g / 100 for g in range(801)])]
    >>> all(b > a for a, b in zip(stresses[:680], stresses[1:])), stresses[800] < stresses[700]
    (True, True)
    """
    G, H = shear_modulus(metal), plastic_modulus(metal)
    part = G * H / (3 * G + H)

    def rate(y):
        return part * cos(y[1]), 1 - G / y[0] * sin(y[1])

    begin = first_yield(metal)
    at, y, found = begin, (metal["yield"] / sqrt(3), begin / 2), []
    for shear in shears:
        if shear <= begin:
            found.append(elastic(metal, shear))
            continue
        y, at = integrated(rate, y, shear - at, steps_per_unit), shear
        found.append((y[0] * cos(y[1]), y[0] * sin(y[1])))
    return found


def kinematic(metal, shears, steps_per_unit=400):
    """(s, n) at ascending shears with a surface that moves and does not grow.

    With u the unit vector from the back stress (b, m) to the stress, the flow takes G p u from the stress and gives H/3 p u to
    the back stress, p = G/(G + H/3) u_s; the spin turns both.

    >>> stresses = [s for s, _ in kinematic(LEAD, [g / 10 for g in range(101)])]
    >>> turns = sum((b - a) * (c - b) < 0 for a, b, c in zip(stresses, stresses[1:], stresses[2:]))
    >>> turns  # it swings
    3
    >>> begin, small = first_yield(LEAD), 1e-4
    >>> abs(kinematic(LEAD, [begin + small])[0][0] - isotropic(LEAD, [begin + small])[0][0]) < 1e-8  # one curve at first
    True
    """
    G, H = shear_modulus(metal), plastic_modulus(metal)
    r, flow = metal["yield"] / sqrt(3), G / (G + H / 3)

    def rate(y):
        s, n, b, m = y
        us, un = (s - b) / r, (n - m) / r
        p = flow * us
        return G - n - G * p * us, s - G * p * un, H / 3 * p * us - m, H / 3 * p * un + b

    begin = first_yield(metal)
    at, y, found = begin, (*elastic(metal, begin), 0.0, 0.0), []
    for shear in shears:
        if shear <= begin:
            found.append(elastic(metal, shear))
            continue
        y, at = integrated(rate, y, shear - at, steps_per_unit), shear
        found.append(y[:2])
    return found


def integrated(rate, y, length, steps_per_unit):
    """y after `length` by Runge and Kutta's method of fourth order."""
    steps = max(1, int(length * steps_per_unit) + 1)
    h = length / steps
    for _ in range(steps):
        k1 = rate(y)
        k2 = rate([a + h / 2 * k for a, k in zip(y, k1)])
        k3 = rate([a + h / 2 * k for a, k in zip(y, k2)])
        k4 = rate([a + h * k for a, k in zip(y, k3)])
        y = [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, k1, k2, k3, k4)]
    return tuple(y)
