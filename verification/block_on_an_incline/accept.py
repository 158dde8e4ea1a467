"""How close is close enough, why, and what must break."""
from math import cos, radians, sin

from reference import acceleration
from verify import Breaks, Check, Falls, Pair

CLAIM = "On an incline of 30 degrees a block with friction 0.6 stays, and one with 0.2 slides with 3.206 m/s2."
EVIDENCE = "exact"
DRIVER = "scene"

HEIGHT, MASS, GRAVITY, SETTLED = 0.1, 16.0, 9.81, 0.4  # [m] [kg] [m/s2]; [s] twice the time in which gravity comes in
SLIDES = {"planes[0].friction": 0.2}


def creep(run):
    """Way of the sole after gravity has come in, in heights of the block."""
    return Pair(run.column("way")[-1] - run.at("way", SETTLED), 0, "m", scale=HEIGHT)


def sag(run):
    """Way of the sole in all, in heights: what the elastic stick gives."""
    return Pair(max(abs(way) for way in run.column("way")), 0, "m", scale=HEIGHT)


def creep_speed(run):
    """Mean speed after gravity has come in, over what it would have on ice."""
    free = GRAVITY * sin(radians(30)) * (run.column("time")[-1] - SETTLED)
    return Pair(run.mean("speed", SETTLED, run.column("time")[-1]), 0, "m/s", scale=free)


def holding(run):
    """Friction that holds the block."""
    return Pair(-run.mean("friction", SETTLED, run.column("time")[-1]), MASS * GRAVITY * sin(radians(30)), "N")


def push(run):
    return Pair(run.mean("normal_force", SETTLED, run.column("time")[-1]), MASS * GRAVITY * cos(radians(30)), "N")


def slide(run):
    """Acceleration of the block that slides, from its speeds at the two ends."""
    one = run if run.overrides.get("planes[0].friction") else run.again(SLIDES)
    end = one.column("time")[-1]
    got = (one.at("speed", end) - one.at("speed", SETTLED)) / (end - SETTLED)
    return Pair(got, acceleration(30, 0.2, GRAVITY), "m/s2")


CHECKS = [
    Check("creep of the block that sticks", creep, 1e-4, "the catalogue's bound, in heights"),
    Check("sag of the stick", sag, 1e-4, "weight over the stiffness of the stick; falls with it, see the study"),
    Check("speed of the block that sticks", creep_speed, 1e-4, "no acceleration: one ten-thousandth of what ice would give"),
    Check("friction that holds", holding, 1e-3, "equilibrium along the incline"),
    Check("push of the incline", push, 1e-3, "equilibrium across the incline"),
    Check("acceleration of the block that slides", slide, 0.01, "the catalogue's bound"),
]

STUDIES = [Falls("sag of the stick", along="planes[0].stick", values=[0.01, 0.1, 1], order=0.9)]

BREAKS = [
    Breaks("creep of the block that sticks", "friction below the slope", {"planes[0].friction": 0.57}),
    Breaks("speed of the block that sticks", "friction below the slope", {"planes[0].friction": 0.57}),
    Breaks("sag of the stick", "a stick a thousand times too soft", {"planes[0].stick": 1e-3}),
    Breaks("acceleration of the block that slides", "a coefficient of 0.21", {"planes[0].friction": 0.21}),
]
