"""Bounces without loss: how high and how often.

A block that falls from the height h on a spring (penalty times area) and is stiff beside it goes through free fall, half a
swing on the spring, and free flight, and returns to h. Fall: sqrt(2h/g). On the spring it swings about the place where the spring carries
its weight, x_s = m g/k, with w = sqrt(k/m): from touch to the lowest place (pi - atan(v/(w x_s)))/w. The period from top to top is twice
the sum. The energy of a stack of blocks is what it has at the start: the sum of m g times its heights, all of it free to move.
"""
from math import atan2, pi, sqrt

GRAVITY = 9.81                                    # [m/s2]
ONE = {"mass": 1.0, "penalty": 2e6, "area": 0.01, "height": 0.05}  # SI
FALLS = (0.05, 0.06, 0.08)                        # [m] of the three blocks until all lie on the plane
BLOCK_MASS = 1.0                                  # [kg]


def bounce(mass, penalty, area, height, gravity=GRAVITY):
    """Period from top to top [s], and how deep the plane is pushed [m].

    >>> one = bounce(**ONE)
    >>> round(one["period"], 5), round(1e3 * one["depth"], 3)
    (0.22513, 7.511)
    >>> stiff = bounce(1.0, 1e14, 0.01, 0.05)
    >>> abs(stiff["period"] / (2 * sqrt(2 * 0.05 / 9.81)) - 1) < 1e-4
    True
    """
    stiffness = penalty * area
    omega, rest, speed = sqrt(stiffness / mass), mass * gravity / stiffness, sqrt(2 * gravity * height)
    return {"period": 2 * (sqrt(2 * height / gravity) + (pi - atan2(speed / omega, rest)) / omega),
            "depth": rest + sqrt(rest**2 + (speed / omega)**2)}


def energy_of_stack():
    """What falls free until all blocks lie on each other and on the plane [J].

    >>> round(energy_of_stack(), 4)
    1.8639
    """
    return sum(BLOCK_MASS * GRAVITY * fall for fall in FALLS)
