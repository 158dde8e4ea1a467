"""Weights of a stack, a squeezed bar that is let go, and a block that is pulled off.

Stack. In equilibrium the column below the height s under the top of a block carries W + w s/h, with the weight w of the block, its
height h, and the weight W of all above. Without lateral strain it stores h (W^2 + W w + w^2/3)/(2 E A).

Bars. The free bar, of length L, and the held one, of length l, are under the pressure p. When p goes, an unloading wave runs from the far
end with the velocity c. Behind it the material is free of stress and moves outwards at v = p/(rho c). It comes to the contact after L/c,
so the force of the contact goes then. The held bar has no stress behind the wave either, so the bars go on together and do not press. At
its end the wave returns as tension, and when that comes to the contact, after (L + 2 l)/c, the held bar has the velocity -v there. So the
gap opens at 2 v. The free bar keeps v, and all of its energy: p^2 A L/(2 E) = rho A L v^2/2.

Block. While it is pressed its contact carries the load, but for its inertia. Pulled by k (t - t0), it has the momentum
k (t - t0)^2/2 and the way k (t - t0)^3/(6 m).
"""
from math import pi, sqrt

GRAVITY = 9.81                                                                    # SI
AREA, HEIGHT = 0.01, 0.05
STACK = {"low": (2700, 70e9), "middle": (2400, 30e9), "high": (7850, 210e9)}      # density, Young's modulus


def weights():
    """What the ground, the lowest block and the next carry [N].

    >>> [round(w, 3) for w in weights()]
    [63.52, 50.276, 38.504]
    """
    each = [density * AREA * HEIGHT * GRAVITY for density, _ in STACK.values()]
    return [sum(each[i:]) for i in range(len(each))]


def masses():
    """[kg]

    >>> round(masses(), 3)
    6.475
    """
    return sum(density * AREA * HEIGHT for density, _ in STACK.values())


def slowest():
    """The slowest of the speeds of sound [m/s].

    >>> round(slowest(), 1)
    3535.5
    """
    return min(sqrt(young / density) for density, young in STACK.values())


def stored():
    """Strain energy of the stack [J].

    >>> round(1e9 * stored(), 1)
    287.2
    """
    total = 0
    carried = [*weights()[1:], 0]
    for (density, young), above in zip(STACK.values(), carried):
        own = density * AREA * HEIGHT * GRAVITY
        total += HEIGHT * (above**2 + above * own + own**2 / 3) / (2 * young * AREA)
    return total


BARS = {"density": 7850, "young": 210e9, "free": 0.1, "held": 0.05, "area": 1e-4, "pressure": 210e6, "until": 10e-6}  # SI


def bars(density, young, free, held, area, pressure, until):
    """Times [s], velocity [m/s], force [N], impulse [N s] and energy [J] of the bars.

    >>> e = bars(**BARS)
    >>> round(1e6 * e["released"], 3), round(1e6 * e["opens"], 3), round(e["speed"], 3), round(e["energy"], 3)
    (29.334, 48.668, 5.172, 1.05)
    """
    c = sqrt(young / density)
    return {"transit": free / c, "released": until + free / c, "opens": until + (free + 2 * held) / c, "speed": pressure / (density * c),
            "force": pressure * area, "impulse": pressure * area * (until + free / c), "energy": pressure**2 * area * free / (2 * young)}


PULLED = {"mass": 7850 * 0.03**3, "rate": 1e8, "from": 1e-3, "largest": 1e4}  # [kg] [N/s] [s] [N]


def pulled(t):
    """Momentum [N s] and way [m] at the time t.

    >>> momentum, way = pulled(1.2e-3)
    >>> round(momentum, 6), round(1e3 * way, 5)
    (2.0, 0.62908)
    """
    since = max(0.0, t - PULLED["from"])
    return PULLED["rate"] * since**2 / 2, PULLED["rate"] * since**3 / (6 * PULLED["mass"])


def inertia(force, height, young, area, mass, period):
    """What the inertia of a block takes from a force that goes up and down once in the period, over the force: half of the block moves by
    half of its own compression, with the acceleration of a sine.

    >>> round(inertia(1e4, 0.03, 210e9, 9e-4, 0.212, 1e-3), 6)
    0.000332
    """
    moved = force * height / (2 * young * area)
    return mass * moved * (2 * pi / period)**2 / 2 / force
