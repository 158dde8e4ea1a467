"""How close is close enough, why, and what must break."""
from math import cos, radians, sin

from reference import acceleration, tipping
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ()
CLAIM = ("A rigid block on a rigid incline of 30 degrees sticks with friction 0.6, slides with 0.2 at 3.206 m/s2, and tips over its lower "
         "edge if it is tall.")
EVIDENCE = "exact"
DRIVER = "scene"

GRAVITY, MASS, SLOPE = 9.81, 16.0, 30            # [m/s2] [kg] [degrees]
SLIDES = {"contacts[0].friction": 0.2}
TALL = {"bodies[0].mesh.high": "[0.4 m, 0.4 m, 0.8 m]", "contacts[0].friction": 5, "time.end": "0.05 s", "output.history_every": "1 ms"}
ON_A_PLANE = {"planes[1]": "{name: sole_plane, kind: rigid, surface: block.z_low, point: [0 m, 0 m, 0 m], normal: [0, 0, 1], "
                           "friction: 0.2}",
              "contacts": "[]", "probes": "[{name: speed, quantity: velocity, of: block, component: x}]"}
SETTLED = 0.1                                    # [s]


def creep(run):
    """Speed of the block that sticks, over what it would have on ice."""
    end = run.column("time")[-1]
    return Pair(run.mean("speed", SETTLED, end), 0, "m/s", scale=GRAVITY * sin(radians(SLOPE)) * end)


def holding(run):
    return Pair(-run.mean("friction", SETTLED, run.column("time")[-1]), MASS * GRAVITY * sin(radians(SLOPE)), "N")


def push(run):
    return Pair(run.mean("push", SETTLED, run.column("time")[-1]), MASS * GRAVITY * cos(radians(SLOPE)), "N")


def carried(run):
    """What holds the table carries both."""
    table = 1000 * 3.5 * 1.5 * 0.2
    return Pair(run.mean("held", SETTLED, run.column("time")[-1]), (MASS + table) * GRAVITY * cos(radians(SLOPE)), "N")


def slope_of(run):
    end = run.column("time")[-1]
    return (run.at("speed", end) - run.at("speed", SETTLED)) / (end - SETTLED)


def slide(run):
    one = run if run.overrides.get("contacts[0].friction") else run.again(SLIDES)
    return Pair(slope_of(one), acceleration(SLOPE, 0.2, GRAVITY), "m/s2")


def slide_on_a_plane(run):
    return Pair(slope_of(run.again({**ON_A_PLANE, **run.overrides})), acceleration(SLOPE, 0.2, GRAVITY), "m/s2")


def tip(run):
    """Angular acceleration of a block of twice its length, from rest until it has turned by a hundredth."""
    one = run.again({**TALL, **run.overrides})
    end = one.column("time")[-1]
    return Pair((one.at("spin", end) - one.at("spin", 0.01)) / (end - 0.01), tipping(SLOPE, 0.4, 0.8, GRAVITY), "rad/s2")


def created(run):
    one = run.again({**SLIDES, **run.overrides})
    return Pair(abs(one.created("sole")), 0, "J", scale=0.5 * MASS * 3.2059**2)


CHECKS = [
    Check("speed of the block that sticks", creep, 1e-4, "one ten-thousandth of what ice would give"),
    Check("friction that holds", holding, 1e-3, "equilibrium along the incline"),
    Check("push of the incline", push, 1e-3, "equilibrium across the incline"),
    Check("what holds the table", carried, 1e-3, "equilibrium of both"),
    Check("acceleration of the block that slides", slide, 1e-3, "a constant force: only the first step is not exact"),
    Check("acceleration on a rigid plane", slide_on_a_plane, 1e-3, "as on the table"),
    Check("angular acceleration of a tall block", tip, 0.02, "it changes by 1 % within the hundredth of a radian"),
    Check("energy that the sole created", created, 1e-3, "the bound of the task"),
]

BREAKS = [
    Breaks("speed of the block that sticks", "friction below the slope", {"contacts[0].friction": 0.57}),
    Breaks("friction that holds", "friction below the slope", {"contacts[0].friction": 0.57}),
    Breaks("push of the incline", "gravity of 9.86 m/s2", {"gravity": "[4.93 m/s^2, 0 m/s^2, -8.539 m/s^2]"}),
    Breaks("what holds the table", "a lighter table", {"bodies[1].mass_properties": "{mass: 1000 kg}"}),
    Breaks("acceleration of the block that slides", "a coefficient of 0.21", {"contacts[0].friction": 0.21}),
    Breaks("acceleration on a rigid plane", "gravity of 9.86 m/s2", {"gravity": "[4.93 m/s^2, 0 m/s^2, -8.539 m/s^2]"}),
    Breaks("angular acceleration of a tall block", "a higher centre", {"bodies[0].mass_properties": "{centre: [0.2 m, 0.2 m, 0.42 m]}"}),
    Breaks("energy that the sole created", "a penalty that samples coarsely",
           {"contacts[0].method": "penalty", "contacts[0].penalty": "1e6 Pa/m", "contacts[0].step_factor": 0.5,
            "time.created_limit": 10}),
]


def by_methods(run):
    rows = []
    for name, overrides in (("multiplier", {}), ("penalty", {"contacts[0].method": "penalty"})):
        one = run.again({**SLIDES, **overrides})
        error = abs(slope_of(one) / acceleration(SLOPE, 0.2, GRAVITY) - 1)
        rows.append([name, f"{error:.1e}", f"{created(one).error:.1e}", f"{max(abs(w) for w in one.column('spin')):.1e}"])
    return rows


def speeds(run):
    return [(f"friction {mu}", one.column("time"), one.column("speed")) for mu, one in ((0.2, run.again(SLIDES)), (0.6, run))]


STUDIES = [Table("The sliding block by method: a penalty lets a block that is laid on it bounce.",
                 ["method", "error of the acceleration", "created energy", "largest spin [rad/s]"], by_methods)]
FIGURES = [Figure("speed", "time [s]", "speed down the incline [m/s]", speeds,
                  caption="Speed of a rigid block on an incline of 30 degrees.")]
