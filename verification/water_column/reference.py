"""A column of fluid strikes a rigid wall.

*Linear fluid*, p = K (1 - V/V0). In the coordinates of the reference its equation of motion is d'Alembert's, rho0 x_tt = K x_XX, at any
strength. A front leaves the wall with c = sqrt(K/rho0) through the reference and stops the fluid: p = rho c v. At L/c it meets the free
end, which returns it as a release, and at 2L/c the whole column has no pressure and the velocity v away from the wall. So it leaves,
and the wall has had the momentum 2 rho L A v. N. Zhukovsky (Joukowsky), 1898.

*Shock velocity* Us = c + s u. The jump conditions of mass and momentum over a shock into fluid at rest are rho (Us - u) = rho0 Us and
p = rho0 Us u, whatever the energy. A fluid that comes with v and stops has u = v.

*SL-1.* In the excursion of the reactor SL-1 in 1961 a slug of water rose with about 160 ft/s and struck the head of the vessel; the
recovery report gives a pressure of about 10,000 psi (status S in the catalogue: read on public pages about the report). It is an order
of magnitude and no measurement of this wave.
"""

PSI, FOOT = 6894.757293168, 0.3048        # [Pa] [m]
SL1_SPEED, SL1_PRESSURE = 160 * FOOT, 10e3 * PSI


def front(density, sound_speed, speed):
    """Pressure behind the front in a linear fluid [Pa].

    >>> front(1000, 1480, 10)
    14800000
    >>> round(front(1000, 1480, SL1_SPEED) / 1e6, 1), round(front(1000, 1480, SL1_SPEED) / PSI)
    (72.2, 10468)
    """
    return density * sound_speed * speed


def duration(length, sound_speed):
    """How long the column presses [s].

    >>> round(1e3 * duration(1, 1480), 5)
    1.35135
    """
    return 2 * length / sound_speed


def shock(density, sound_speed, slope, speed):
    """Pressure behind a shock that stops the fluid [Pa].

    >>> [round(shock(1000, 1480, 1.75, v) / 1e6, 3) for v in (1, 10, 49, 100)]
    [1.482, 14.975, 76.722, 165.5]
    """
    return density * (sound_speed + slope * speed) * speed


def void(speed, t, cell):
    """Part of the first cell that is void when the column has flown from a wall that holds its end [-].

    >>> void(10, 0.002, 0.01)
    0.6666666666666667
    """
    return 1 - 1 / (1 + speed * t / cell)
