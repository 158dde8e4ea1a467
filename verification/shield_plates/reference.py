"""Elastic plates with gaps of which the first is struck, as waves in one dimension; and a thin disc on a simple support that is struck.

Waves. The compressive stress of a plate is f + g, its impedance z = rho c times its velocity is f - g; f runs up and g down, unchanged,
with the speed c of uniaxial strain, M = E (1 - nu)/((1 + nu)(1 - 2 nu)). A free face has no stress, so a wave comes back with the other
sign. Faces that touch and would approach, f + g > 0, have one velocity, and waves pass, since all impedances are equal. Else they part.
Waves are constant between fronts, and gaps are linear between events: a front that reaches a face, or a gap that closes. So each event is
found exactly, whatever the transit times are. (K. F. Graff, Wave Motion in Elastic Solids, 1975, chapter 2.)

Disc. Mindlin's plate, w and the rotation psi of normals, without nodal diameters, on a simple support: w = 0 and no moment at the rim.

    5/6 mu t (w'' + w'/r + psi' + psi/r) = -rho t omega^2 w
    D (psi' + psi/r)' - 5/6 mu t (w' + psi) = -rho t^3/12 omega^2 psi

J0(k r) and I0(q r) solve them, with D k^4 - (D s + rho t^3/12 omega^2) k^2 = rho omega^2 (t - s t^3/12) and s = 6 rho omega^2/(5 mu);
the other root is k^2 = -q^2. Modes are orthogonal with rho t w w + rho t^3/12 psi psi, and an initial velocity is a sum of them.
(R. D. Mindlin & H. Deresiewicz, J. Appl. Phys. 25, 1954, 1329; thin plates: Leissa, Vibration of Plates, NASA SP-160, 1969, section 2.1.)
"""
from collections import deque
from functools import lru_cache
from math import cos, exp, pi, sin, sqrt

STEEL = {"density": 7850, "young": 190e9, "poisson": 0.3}                                          # SI
STACK = {"thicknesses": (0.05, 0.05, 0.075, 0.05, 0.05, 0.1), "gaps": (5e-3,) * 5, "speed": 20.0}  # [m] [m] [m/s]
DISC = {"radius": 0.9, "thickness": 0.05}                                                          # [m]
SLOW = 0.1                                                                                         # [m/s] of the disc


def wave_speed(density, young, poisson):
    """Of uniaxial strain. [m/s]

    >>> round(wave_speed(**STEEL))
    5708
    """
    return sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / density)


# ------------------------------------------------------------------------------------------------
# Waves in a row of plates

def waves(thicknesses, gaps, speed, c, end):
    """First closures [s] (None: never), and corners of the mean velocities over time, [(s, [m/s, ...])], straight in between.

    Two plates of one thickness exchange their velocities within two transit times.

    >>> pair = waves([1, 1], [0.5], 10, c=1000, end=0.1)
    >>> pair["closures"], [round(v, 12) + 0.0 for v in pair["speeds"]]
    ([0.05], [0.0, 10.0])

    A short plate comes to rest on a long one, of three times the thickness: that has a third of the speed.

    >>> [round(v, 12) + 0.0 for v in waves([1, 3], [0.5], 9, c=1000, end=0.1)["speeds"]]
    [0.0, 3.0]

    A long plate on a short one: this leaves with the whole velocity, after two of its own transit times; the long one keeps the rest.

    >>> [round(v, 12) for v in waves([3, 1], [0.5], 9, c=1000, end=0.1)["speeds"]]
    [6.0, 9.0]

    The part of the momentum that the last shield plate keeps changes with a fiftieth of the gaps.

    >>> def last(gap):
    ...     return waves(STACK["thicknesses"], [gap] * 5, STACK["speed"], wave_speed(**STEEL), 4e-3)["speeds"][-1] * 0.1 / (0.05 * 20)
    >>> [round(last(gap), 3) for gap in (4.9e-3, 5e-3, 5.1e-3)]
    [0.985, 0.73, 0.556]

    Momentum is kept, also by transit times without a common measure.

    >>> odd = waves([1, sqrt(2), 0.3, pi], [0.01, 0.02, 0.01], 10, c=1000, end=0.05)
    >>> round(sum(h * v for h, v in zip((1, sqrt(2), 0.3, pi), odd["speeds"])), 9)
    10.0
    """
    plates, transit = range(len(thicknesses)), [h / c for h in thicknesses]
    together, touching, small = 1e-9 * min(transit), 1e-12 * min(thicknesses), 1e-9 * speed  # [s] [m] [m/s] less is round-off
    up, down = [[v / 2, *[0.0] * (len(plates) - 1)] for v in (speed, -speed)]  # f/z, g/z that arrive at upper and lower faces
    sent_up, sent_down = list(up), list(down)                                  # that leave lower and upper faces
    coming_up, coming_down = [deque() for _ in plates], [deque() for _ in plates]  # (time of arrival, value)
    means, gaps = [speed, *[0.0] * (len(plates) - 1)], list(gaps)
    t, closures, corners = 0.0, [None] * len(gaps), [(0.0, tuple(means))]
    while True:
        for now, coming in ((up, coming_up), (down, coming_down)):
            for i in plates:
                while coming[i] and coming[i][0][0] <= t + together:
                    now[i] = coming[i].popleft()[1]
        pressed = [gaps[j] <= touching and up[j] + down[j + 1] > small for j in range(len(gaps))]
        closures = [t if press and known is None else known for press, known in zip(pressed, closures)]
        stress = [0.0, *(up[j] + down[j + 1] if pressed[j] else 0.0 for j in range(len(gaps))), 0.0]  # over z, of faces from below [m/s]
        for i in plates:
            leave(coming_up[i], sent_up, i, stress[i] - down[i], t + transit[i])
            leave(coming_down[i], sent_down, i, stress[i + 1] - up[i], t + transit[i])
        opening = [0.0 if pressed[j] else -2 * (up[j] + down[j + 1]) for j in range(len(gaps))]
        events = [line[0][0] for line in (*coming_up, *coming_down) if line]
        events += [t + gap / -rate for gap, rate in zip(gaps, opening) if rate < -small]
        until = min([end, *events])
        gaps = [max(0.0, gap + rate * (until - t)) for gap, rate in zip(gaps, opening)]
        means = [v + (stress[i] - stress[i + 1]) * (until - t) / transit[i] for i, v in enumerate(means)]
        t = until
        corners.append((t, tuple(means)))
        if t >= end:
            return {"closures": closures, "speeds": means, "corners": corners}


def leave(line, sent, i, value, arrival):
    """A wave of another value than the one before leaves a face."""
    if value != sent[i]:
        line.append((arrival, value))
        sent[i] = value


# ------------------------------------------------------------------------------------------------
# A disc

@lru_cache(None)
def bessel(order, z):
    """J_n(z) and exp(-z) I_n(z), means of periodic functions over a turn: equidistant points are exact to round-off.

    >>> [round(v, 12) + 0.0 for v in (bessel(0, 2.404825557695773)[0], bessel(1, 3.831705970207512)[0], exp(1) * bessel(1, 1.0)[1])]
    [0.0, 0.0, 0.565159103992]
    """
    points = 60 + 2 * int(z)
    turn = [2 * pi * i / points for i in range(points)]
    return (sum(cos(order * a - z * sin(a)) for a in turn) / points, sum(exp(z * (cos(a) - 1)) * cos(order * a) for a in turn) / points)


def stiffnesses(young, poisson, thickness):
    """In bending, D [N m], and in shear, 5/6 mu t [N/m]."""
    return young * thickness**3 / (12 * (1 - poisson**2)), 5 / 6 * young / (2 * (1 + poisson)) * thickness


def mode(k, density, young, poisson, radius, thickness):
    """Of the wave number k: circular frequency, moment at the rim (0 for a mode), and the part that its centre has of a uniform velocity.

    w = J0(k r) + A I0(q r) and psi = b J0(k r)' + A b_q I0(q r)', with A such that w = 0 at the rim.
    """
    bend, shear = stiffnesses(young, poisson, thickness)
    mass, inertia = density * thickness, density * thickness**3 / 12
    linear = (bend * mass / shear + inertia) * k**2 + mass
    squared = 2 * bend * k**4 / (linear + sqrt(linear**2 - 4 * inertia * mass / shear * bend * k**4))  # omega^2
    q = sqrt(squared * (mass - inertia * mass * squared / shear) / bend) / k
    b, b_q = mass * squared / (shear * k**2) - 1, -mass * squared / (shear * q**2) - 1
    x, y = k * radius, q * radius
    (j0, _), (j1, _), (_, i0), (_, i1) = bessel(0, x), bessel(1, x), bessel(0, y), bessel(1, y)  # I without exp(y)
    moment = i0 * b * (-k**2 * j0 + (1 - poisson) * k * j1 / radius) - j0 * b_q * (q**2 * i0 - (1 - poisson) * q * i1 / radius)
    part = -j0 / i0                                                                              # A exp(y)
    mean = j1 / x + part * i1 / y                                                                # of w r over the radius 1
    square = ((j0**2 + j1**2) / 2 + part**2 * (i0**2 - i1**2) / 2 + 2 * part * (x * j1 * i0 + y * j0 * i1) / (x**2 + y**2))
    turned = ((b * k)**2 * (j0**2 + j1**2 - 2 * j0 * j1 / x) / 2 + (part * b_q * q)**2 * (i1**2 - i0**2 + 2 * i0 * i1 / y) / 2
              - 2 * part * b * k * b_q * q * (y * j1 * i0 - x * j0 * i1) / (x**2 + y**2))        # of psi^2 r
    return sqrt(squared), moment, mean / (square + inertia / mass * turned) * (1 + part * exp(-y))


@lru_cache(None)
def modes(count=15, **plate):
    """[(circular frequency [1/s], part)] of the lowest modes.

    A plate without thickness has Kirchhoff's numbers z^2 = omega a^2 sqrt(rho t/D).

    >>> thin = {**STEEL, "radius": 1, "thickness": 1e-5}
    >>> number = sqrt(7850 * 1e-5 / stiffnesses(190e9, 0.3, 1e-5)[0])
    >>> [round(omega * number, 3) for omega, _ in modes(3, **thin)]
    [4.935, 29.72, 74.156]

    Shear and rotary inertia take 0.3 % of the first frequency of the shield plate, and of the fifth, 222.2 by Kirchhoff, 10 %.

    >>> thick = {**STEEL, **DISC}
    >>> number = 0.9**2 * sqrt(7850 * DISC["thickness"] / stiffnesses(190e9, 0.3, DISC["thickness"])[0])
    >>> [round(omega * number, 2) for omega, _ in modes(5, **thick)]
    [4.92, 29.24, 71.26, 128.79, 199.26]

    Parts are those of a series that is 1 at the centre; its terms alternate, and the mean of two sums is near it.

    >>> parts = [part for _, part in modes(15, **thick)]
    >>> round(sum(parts) - parts[-1] / 2, 2)
    1.0
    """
    def moment(x):
        return mode(x / plate["radius"], **plate)[1]
    found, low = [], 1.0
    while len(found) < count:
        high = low + 0.5
        if moment(low) * moment(high) < 0:
            a, b = low, high
            while (middle := (a + b) / 2) not in (a, b):
                a, b = (middle, b) if moment(middle) * moment(a) > 0 else (a, middle)
            found.append(mode(a / plate["radius"], **plate))
        low = high
    return [(omega, part) for omega, _, part in found]


def deflection(t, speed, **plate):
    """Of the centre. [m]"""
    return speed * sum(part * sin(omega * t) / omega for omega, part in modes(**plate))


def peak(speed, **plate):
    """The largest deflection of the first half period: its time and itself. [s] [m]

    Kirchhoff's plate is one of a thousandth of the thickness, which is a thousand times as slow. Its largest deflection is 0.2 % less, and
    comes at another of the tops that overtones make.

    >>> mindlin, kirchhoff = peak(1, **STEEL, **DISC), peak(1, **{**STEEL, **DISC, "thickness": DISC["thickness"] / 1000})
    >>> [round(1e3 * one, 2) for one in mindlin], [round(one, 2) for one in kirchhoff]
    ([4.08, 3.93], [3.85, 3.92])
    """
    half = pi / modes(**plate)[0][0]
    step = half / 2000
    t = max((i * step for i in range(2001)), key=lambda one: deflection(one, speed, **plate))
    for _ in range(40):
        step /= 2
        t = max((t - step, t, t + step), key=lambda one: deflection(one, speed, **plate))
    return t, deflection(t, speed, **plate)
