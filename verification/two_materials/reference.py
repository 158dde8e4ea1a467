"""A bar of two materials in a row: d'Alembert's waves at the joint, and elongations at rest.

A wave of the stress s that meets the joint goes on with the stress T s and comes back with R s (K. F. Graff, Wave Motion in Elastic Solids,
section 2.2; equal areas, impedance Z = density times wave speed):

    T = 2 Z2 / (Z1 + Z2),     R = (Z2 - Z1) / (Z2 + Z1)

At rest a bar with the stress a at one end and a weight b for each unit of its first length has the stress a + b X in it, and, if its
logarithmic strain is stress over modulus and its area is kept, the length integral of exp((a + b X) / E).
"""
from itertools import product
from math import exp, sqrt

STEEL, ALUMINIUM = dict(density=7850, young=210e9), dict(density=2700, young=70e9)


def speed(metal):
    return sqrt(metal["young"] / metal["density"])


def impedance(metal):
    return metal["density"] * speed(metal)


def transmitted(first, second):
    """Stress that goes on over that which comes in.

    >>> transmitted(STEEL, STEEL), round(transmitted(STEEL, dict(density=1e-9, young=1e-9)), 9)  # one material, and a free end
    (1.0, 0.0)
    """
    return 2 * impedance(second) / (impedance(first) + impedance(second))


def reflected(first, second):
    """Stress that comes back over that which comes in.

    >>> reflected(STEEL, STEEL) == 0, round(reflected(STEEL, dict(density=1e9, young=1e30)), 9)  # one material, and a wall
    (True, 1.0)
    """
    return transmitted(first, second) - 1


def waves(first, second, length, pulse, x, t):
    """Stress over that of the pulse at the place x and the time t, before the first wave returns from an end.

    >>> waves(STEEL, ALUMINIUM, 0.5, 60e-6, 0.2, 60e-6)
    1.0
    """
    there, back = speed(first), speed(second)
    joint = length / there

    def acts(arrival):
        return 1.0 if arrival <= t < arrival + pulse else 0.0

    if x > length:
        return transmitted(first, second) * acts(joint + (x - length) / back)
    return acts(x / there) + reflected(first, second) * acts(joint + (length - x) / there)


def stretched(stress, growth, young, length):
    """The length of a bar with `stress` at one end [Pa] that grows by `growth` [Pa/m] along it.

    >>> round(stretched(70e9, 1, 70e9, 1), 9) == round(exp(1), 9)
    True
    """
    if growth * length < 1e-9 * young:
        return length * exp(stress / young)
    return young / growth * (exp((stress + growth * length) / young) - exp(stress / young))


def energy(metal, strain):
    """Of a unit of volume of a bar that is stretched to this logarithmic strain while its area is kept [J/m3]: the integral of E e exp(e).

    >>> round(energy(dict(young=1.0), 1.0), 9), round(energy(dict(young=2.0), 1e-3) * 1e6, 3)    # E e^2 / 2 of small strains
    (1.0, 1.001)
    """
    return metal["young"] * ((strain - 1) * exp(strain) + 1)


def mass_with_core_and_ball():
    """Of a bar of steel of 1 m by 0.1 m by 0.1 m in 20 by 4 by 4 cells [kg]; cells are of aluminium whose middles lie in a core about its
    axis, of a radius of 20 mm and as far as 0.8 m, or in a ball of a radius of 50 mm about the middle of the last cells.

    >>> mass_with_core_and_ball()    # 64 cells of the core and 12 of the ball
    66.26875
    """
    mass = 0.0
    for i, j, k in product(range(20), range(4), range(4)):
        x, across = (i + 0.5) / 20, ((j - 1.5) / 40)**2 + ((k - 1.5) / 40)**2
        inside = x <= 0.8 and across <= 0.02**2 or (x - 0.975)**2 + across <= 0.05**2
        mass += (ALUMINIUM if inside else STEEL)["density"] * 0.01 / 320
    return round(mass, 9)


def in_a_row(first, second, length, elongation):
    """Logarithmic strain of the first of two bars of equal length and area that are stretched together.

    >>> e = in_a_row(STEEL, STEEL, 1.0, 0.02)
    >>> round(2 * exp(e), 9)
    2.02
    """
    low, high = 0.0, elongation / length
    for _ in range(100):
        middle = (low + high) / 2
        whole = length * (exp(middle) + exp(middle * first["young"] / second["young"]))
        low, high = (middle, high) if whole < 2 * length + elongation else (low, middle)
    return low
