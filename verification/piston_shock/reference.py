"""A piston drives a shock into a fluid at rest.

The jump conditions of mass, momentum and energy over a shock with the velocity U into fluid at rest with rho0, p0, e0 that moves with u
behind it (Rankine 1870, Hugoniot 1889):

    rho (U - u) = rho0 U,     p - p0 = rho0 U u,     e - e0 = 1/2 (p + p0) (1/rho0 - 1/rho)

A law of the shock velocity, U = c + s u, closes them for water. For an ideal gas e = p/((gamma - 1) rho) closes them:
U = (gamma + 1)/4 u + sqrt(((gamma + 1)/4 u)^2 + c0^2), c0^2 = gamma p0/rho0.
"""
from collections import namedtuple
from math import sqrt

State = namedtuple("State", "pressure density energy")  # [Pa] [kg/m3] [J/kg]


def behind(velocity, piston, density, pressure=0.0, energy=0.0):
    """The state behind a shock of this velocity.

    >>> state = behind(water_shock(100, 1480, 1.75), 100, 1000)
    >>> round(state.pressure / 1e6, 3), round(state.density / 1000, 6), round(state.energy, 9)
    (165.5, 1.064309, 5000.0)
    """
    p, rho = pressure + density * velocity * piston, density * velocity / (velocity - piston)
    return State(p, rho, energy + 0.5 * (p + pressure) * (1 / density - 1 / rho))


def water_shock(piston, sound_speed, slope):
    """Velocity of the shock [m/s].

    >>> water_shock(100, 1480, 1.75)
    1655.0
    """
    return sound_speed + slope * piston


def gas_shock(piston, density, pressure, gamma):
    """Velocity of the shock [m/s]; a strong one compresses by (gamma + 1)/(gamma - 1) and goes with (gamma + 1)/2 times the piston.

    >>> round(gas_shock(1, 1, 0, 1.4), 12), round(behind(gas_shock(1, 1, 0, 1.4), 1, 1).density, 12)
    (1.2, 6.0)

    Behind any shock the energy is that of the gas:

    >>> state = behind(gas_shock(1, 1, 0.1, 1.4), 1, 1, 0.1, gas_energy(1, 0.1, 1.4))
    >>> round(state.energy / gas_energy(state.density, state.pressure, 1.4), 12)
    1.0
    """
    half = (gamma + 1) / 4 * piston
    return half + sqrt(half**2 + gamma * pressure / density)


def gas_energy(density, pressure, gamma):
    """Internal energy of the ideal gas [J/kg].

    >>> round(gas_energy(1, 0.4, 1.4), 12)
    1.0
    """
    return pressure / ((gamma - 1) * density)
