"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import BASE, BLOCK, GRAVITY, mass, sound
from verify import Breaks, Check, Figure, Pair, Waiver

CATALOGUE = ()
CLAIM = "Blocks that lie on each other come to rest and stay there for a hundred thousand steps, and carry their weights."
EVIDENCE = "exact"
DRIVER = "scene"

LATE = 0.05  # [s] half of the run: fifty thousand steps are still to come


def speeds(run):
    """Root mean square velocity of both blocks over the speed of sound, row by row."""
    return [sqrt(2 * (a + b) / (mass(BLOCK) + mass(BASE))) / sound() for a, b in zip(run.column("of_block"), run.column("of_base"))]


def speed(run):
    return Pair(max(v for t, v in zip(run.column("time"), speeds(run)) if t > LATE), 0, "", scale=1)


def carried(run):
    return Pair(run.mean("force", LATE, run.column("time")[-1]), mass(BLOCK) * GRAVITY, "N")


def on_ground(run):
    return Pair(run.mean("on_ground", LATE, run.column("time")[-1]), mass(BLOCK + BASE) * GRAVITY, "N")


CHECKS = [
    Check("largest velocity over the speed of sound, last fifty thousand steps", speed, 1e-9,
          "viscosity takes what gravity began; contact must not begin it anew"),
    Check("force between the blocks", carried, 1e-6, "weight, as a mean over fifty rows"),
    Check("force of the ground", on_ground, 1e-6, "the same"),
    Check("steps", lambda run: Pair(run.summary["cost"]["steps"], 1e5), 0.01, "as many as the claim says"),
]

WAIVERS = [
    Waiver("unexplained energy over the largest that passed", lambda run: True,
           "the weights move the blocks by a tenth of a nanometre, and positions are rounded to 1e-17 m in each step", up_to=1e-6),
]

BREAKS = [
    Breaks("largest velocity over the speed of sound, last fifty thousand steps", "elements without viscosity, that go on ringing",
           {f"bodies[{body}].element.viscosity.{key}": 0 for body in (0, 1) for key in ("linear", "quadratic")}),
    Breaks("force between the blocks", "gravity of 9.8 m/s2", {"gravity": "[0 m/s^2, 0 m/s^2, -9.8 m/s^2]"}),
    Breaks("force of the ground", "gravity of 9.8 m/s2", {"gravity": "[0 m/s^2, 0 m/s^2, -9.8 m/s^2]"}),
    Breaks("steps", "stopped early", {"time.end": "60 ms"}),
]


def by_method(run):
    found = []
    for title, change in (("multipliers", {}), ("without viscosity", BREAKS[0].change)):
        one = run.again(change)
        found.append((title, [1e3 * t for t in one.column("time")][1:], speeds(one)[1:]))
    return found


def limit(run):
    return [("limit", [50, 101.5], [1e-9, 1e-9])]


FIGURES = [Figure("speed", "time [ms]", "velocity over the speed of sound [-]", by_method, exact=limit, error=False,
                  caption="Root mean square velocity of two blocks of steel that lie on each other, over the speed of sound.")]
