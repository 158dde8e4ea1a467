"""The exact solution of Riemann's problem of an ideal gas at rest on both sides, and Sod's shock tube.

G. A. Sod, J. Comput. Phys. 27 (1978) 1; the solution as in E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics,
chapter 4. The contact between both gases has the pressure p and the velocity u on both of its sides. A wave goes into each side: a shock
where p is above the pressure of that side, else a rarefaction. The velocity that the wave gives to its gas is

    f(p) = (p - p0) sqrt(2/((g + 1) rho0)/(p + (g - 1)/(g + 1) p0))           behind a shock,
    f(p) = 2 c0/(g - 1) ((p/p0)^((g - 1)/2g) - 1)                            behind a rarefaction,

towards the side from which the gas comes; f of the left and f of the right together are zero.
"""
from collections import namedtuple
from math import sqrt

Side = namedtuple("Side", "density pressure")  # [kg/m3] [Pa] of a gas at rest
LEFT, RIGHT, GAMMA = Side(1.0, 1.0), Side(0.125, 0.1), 1.4
Star = namedtuple("Star", "pressure velocity left right head tail contact shock")  # [Pa] [m/s] [kg/m3] and velocities [m/s]


def sound(side, gamma):
    """Speed of sound [m/s].

    >>> round(sound(LEFT, 1.4), 4)
    1.1832
    """
    return sqrt(gamma * side.pressure / side.density)


def drive(p, side, gamma):
    """f of this side [m/s].

    >>> drive(1.0, LEFT, 1.4)
    0.0
    """
    if p > side.pressure:
        return (p - side.pressure) * sqrt(2 / ((gamma + 1) * side.density) / (p + (gamma - 1) / (gamma + 1) * side.pressure))
    return 2 * sound(side, gamma) / (gamma - 1) * ((p / side.pressure) ** ((gamma - 1) / (2 * gamma)) - 1)


def behind(p, side, gamma):
    """Density behind the wave into this side [kg/m3]."""
    if p > side.pressure:
        part, over = (gamma - 1) / (gamma + 1), p / side.pressure
        return side.density * (over + part) / (part * over + 1)
    return side.density * (p / side.pressure) ** (1 / gamma)


def solve(left=LEFT, right=RIGHT, gamma=GAMMA):
    """The waves, where the left has the higher pressure: a rarefaction to the left and a shock to the right.

    >>> star = solve()
    >>> [round(number, 5) for number in star[:4]]
    [0.30313, 0.92745, 0.42632, 0.26557]
    >>> [round(0.5 + 0.2 * velocity, 4) for velocity in star[4:]]
    [0.2634, 0.4859, 0.6855, 0.8504]
    """
    low, high = right.pressure, left.pressure
    for _ in range(200):  # bisection: both f grow with the pressure
        p = (low + high) / 2
        low, high = (p, high) if drive(p, left, gamma) + drive(p, right, gamma) < 0 else (low, p)
    u, rho = drive(p, right, gamma), behind(p, left, gamma)
    return Star(p, u, rho, behind(p, right, gamma), -sound(left, gamma), u - sqrt(gamma * p / rho), u,
                behind(p, right, gamma) * u / (behind(p, right, gamma) - right.density))


def density(way, star=solve(), left=LEFT, right=RIGHT, gamma=GAMMA):
    """At the place `way` [m/s] over the time from the contact of the start [kg/m3].

    >>> density(-2), round(density(-0.5), 4), round(density(0.9), 5), round(density(1), 5), density(2)
    (1.0, 0.6029, 0.42632, 0.26557, 0.125)
    """
    if way <= star.head:
        return left.density
    if way < star.tail:  # inside the rarefaction u - c is the way
        c0 = sound(left, gamma)
        c = c0 - (gamma - 1) / (gamma + 1) * (c0 + way)
        return left.density * (c / c0) ** (2 / (gamma - 1))
    return star.left if way < star.contact else star.right if way < star.shock else right.density
