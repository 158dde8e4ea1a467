"""A fluid that turns as a rigid body, in a rigid vessel and in an elastic one.

Each ring of the fluid is carried inward by the pressure: dp/dr = density omega^2 r. So p(r) = p0 + density omega^2 r^2/2. In a rigid vessel
the volume stays, so the mean pressure stays what it was before the vessel turned.

A long elastic tube that turns is in plane strain, with radial displacement

    u = A r + B/r - (1 - n^2) d omega^2 r^3/(8 Y),     Y = E/(1 - v^2),  n = v/(1 - v),

with the density d, Young's modulus E and Poisson's ratio v of the tube; radial stress sigma = Y/(1 - n^2) (u' + n u/r)
(Timoshenko & Goodier, Theory of Elasticity, arts. 28 and 32).
"""
from math import sin

OMEGA, START = 400.0, 2e6                    # [rad/s] [Pa]
WATER, SOUND = 1000.0, 1482.0                # [kg/m3] [m/s]
HOLE, SPINDLE, RADIUS, OUTSIDE = 0.02, 0.03, 0.1, 0.12  # [m]
STEEL, YOUNG, POISSON = 7850.0, 200e9, 0.3   # [kg/m3] [Pa] [-]
HEAD = WATER * (OMEGA * RADIUS)**2 / 2       # [Pa] between the axis and the wall
SOUND_PERIOD = 2 * 3.141592653589793 * RADIUS / (3.8317 * SOUND)  # [s] of the first radial oscillation of a full cylinder

DRIVEN_RATE, DRIVEN_STEP, DRIVEN_START = 335.2973, 2.92626774e-05, 1e6  # [rad/s] [s] [Pa]


def pressure(square, inner=0.0, mean=START):
    """Where the square of the radius is `square` [m2], in a rigid vessel whose water begins at `inner` [m]. [Pa]

    On the axis of a full cylinder, a quarter of density omega^2 R^2 is missing:

    >>> round(pressure(0) - (START - WATER * OMEGA**2 * RADIUS**2 / 4), 6), round(pressure(RADIUS**2) - START, 1)
    (0.0, 400000.0)

    The mean over the area stays:

    >>> n = 1000
    >>> rings = [0.03**2 + (i + 0.5) / n * (0.1**2 - 0.03**2) for i in range(n)]
    >>> round(sum(pressure(square, 0.03) for square in rings) / n, 3)
    2000000.0
    """
    return mean + WATER * OMEGA**2 / 2 * (square - (RADIUS**2 + inner**2) / 2)


def growth(inner, outer, within, without, at):
    """Radial displacement at a radius of a steel tube that turns, with pressures within and without [Pa]. [m]

    A thin ring that turns has the stress density (omega r)^2, and one under pressure p r/thickness, of plane strain:

    >>> thin = growth(1, 1.0001, 0, 0, 1) / (STEEL * OMEGA**2 * (1 - POISSON**2) / YOUNG)
    >>> pressed = growth(1, 1.001, 1e6, 0, 1) - growth(1, 1.001, 0, 0, 1)
    >>> round(thin, 3), round(pressed / (1e6 / 0.001 * (1 - POISSON**2) / YOUNG), 2)
    (1.0, 1.0)
    """
    Y, n = YOUNG / (1 - POISSON**2), POISSON / (1 - POISSON)
    turn = (1 - n * n) * STEEL * OMEGA**2 / (8 * Y)
    stiff = Y / (1 - n * n)
    # radial stress of A r + B/r - turn r^3:  stiff ((1 + n) A - (1 - n) B/r^2 - (3 + n) turn r^2)
    right = [-p / stiff + (3 + n) * turn * r * r for p, r in ((within, inner), (without, outer))]
    B = (right[1] - right[0]) / ((1 - n) * (1 / inner**2 - 1 / outer**2))
    A = (right[0] + (1 - n) * B / inner**2) / (1 + n)
    return A * at + B / at - turn * at**3


def steel_pressure(square):
    """As `pressure` with a spindle, in the vessel of steel. [Pa]

    Steel that does not give way is the rigid vessel; the one of steel loses a part of the pressure:

    >>> round((pressure(0.1**2, SPINDLE) - steel_pressure(0.1**2)) / 1e6, 3) > 0.1
    True
    """
    def excess(mean):
        """Of the mean pressure over what the volume of the vessel leaves of it."""
        wall, core = pressure(RADIUS**2, SPINDLE, mean), pressure(SPINDLE**2, SPINDLE, mean)
        grown = 2 * RADIUS * growth(RADIUS, OUTSIDE, wall, 0, RADIUS) - 2 * SPINDLE * growth(HOLE, SPINDLE, 0, core, SPINDLE)
        bulk = WATER * SOUND**2
        return mean - (START - (bulk - START) * grown / (RADIUS**2 - SPINDLE**2))
    first, second = excess(0.0), excess(START)
    return pressure(square, SPINDLE, -first * START / (second - first))


def chord_factor(angle):
    """Chord over arc of the angle of a step [rad]. [-]

    >>> round(1 - chord_factor(0.01), 9)
    4.167e-06
    """
    return sin(angle / 2) / (angle / 2)
