"""Two masses that meet on a unilateral spring, and what the leapfrog makes of it.

The relative motion is that of the reduced mass m = m1 m2/(m1 + m2) on the spring k: half a sine of length pi sqrt(m/k), peak force
v sqrt(k m), depth v sqrt(m/k), and the masses part as fast as they met. Central differences are stable up to 2 sqrt(m/k).

Sampled at steps of D sqrt(m/k), the spring is switched on and off at samples. With x in v sqrt(m/k), velocities in v, and a first
sample in contact a phase f of a step behind the touch,

    x = -f D,  v = -1;    v -= D x while x < 0,  then x += D v

`rebound` walks that recursion; `largest_rebound` takes the worst of all phases. In contact I = v^2 + x_n x_(n+1) does not change;
at touch it is at most 1, at release v^2 <= I + D^2 v^2/4, so no phase makes v^2 larger than 1/(1 - D^2/4).
"""
from math import pi, sqrt

APEX, BASE, STIFFNESS, SPEED = 1.0, 3.0, 1e6, 2.0  # [kg] [kg] [N/m] [m/s]
REDUCED = APEX * BASE / (APEX + BASE)


def contact_time():
    """[s]

    >>> f"{contact_time():.7f}"
    '0.0027207'
    """
    return pi * sqrt(REDUCED / STIFFNESS)


def peak_force():
    """[N]

    >>> f"{peak_force():.2f}"
    '1732.05'
    """
    return SPEED * sqrt(STIFFNESS * REDUCED)


def depth():
    """[m]

    >>> f"{depth():.8f}"
    '0.00173205'
    """
    return SPEED * sqrt(REDUCED / STIFFNESS)


def critical_step():
    """[s]

    >>> f"{critical_step():.7f}"
    '0.0017321'
    """
    return 2 * sqrt(REDUCED / STIFFNESS)


def rebound(step, phase):
    """Speed apart over speed of approach.

    >>> abs(rebound(1e-3, 0.5) - 1) < 1e-6
    True
    """
    x, v = -phase * step, -1.0
    while x < 0:
        v -= step * x
        x += step * v
    return v


def largest_rebound(step, phases=400):
    """
    >>> [f"{largest_rebound(step):.4f}" for step in (0.05, 0.1, 0.2, 0.5)]
    ['1.0002', '1.0012', '1.0044', '1.0221']
    >>> f"{largest_rebound(0.5, 40000):.4f}"  # the worst phase lies between the four hundred
    '1.0222'
    >>> all(largest_rebound(step) <= bound(step) for step in (0.05, 0.1, 0.2, 0.5))
    True
    """
    return max(rebound(step, (i + 0.5) / phases) for i in range(phases))


def bound(step):
    """What no phase exceeds.

    >>> [f"{bound(step):.4f}" for step in (0.05, 0.1, 0.2, 0.5)]
    ['1.0003', '1.0013', '1.0050', '1.0328']
    """
    return 1 / sqrt(1 - step * step / 4)
