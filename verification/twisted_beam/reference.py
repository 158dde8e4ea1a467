"""A cantilever that is twisted about its axis, under a force at its free end.

MacNeal & Harder, *Finite Elem. Anal. Des.* 1 (1985) 3, give the deflections of the end along the force, 5.424e-3 m and 1.754e-3 m, for a
force along the width of the free end and across it. A beam agrees: with the principal axes at x turned by theta = (pi/2) x/L, the force F
bends by

    w = F/E  integral of (L - x)^2 (cos^2 theta / I_a + sin^2 theta / I_b) dx  +  (6/5) F L / (G A)

with I_a and I_b of the axes about which it bends at the clamp and at the free end. Warping and the twist of curved fibres are left out.
"""
from math import cos, pi, sin

PUBLISHED = {"in plane": 5.424e-3, "out of plane": 1.754e-3}  # [m] at a force of 1 N
YOUNG, POISSON, LENGTH, WIDTH, THICKNESS = 29e6, 0.22, 12.0, 1.1, 0.32  # [Pa] [-] [m] [m] [m]


def beam(direction, points=4000):
    """The deflection of a beam at a force of 1 N, by the midpoint rule. [m]

    >>> [round(beam(d) / PUBLISHED[d], 2) for d in PUBLISHED]
    [1.0, 1.0]
    """
    weak, strong = WIDTH * THICKNESS**3 / 12, THICKNESS * WIDTH**3 / 12
    first, last = (weak, strong) if direction == "in plane" else (strong, weak)
    step = LENGTH / points
    bends = 0.0
    for i in range(points):
        x = (i + 0.5) * step
        theta = pi / 2 * x / LENGTH
        bends += (LENGTH - x)**2 * (cos(theta)**2 / first + sin(theta)**2 / last) * step
    shear = YOUNG / (2 * (1 + POISSON))
    return bends / YOUNG + 1.2 * LENGTH / (shear * WIDTH * THICKNESS)
