"""How close is close enough, why, and what must break."""
from math import cos, radians, sin

from reference import acceleration, on_a_belt, tipping
from verify import Breaks, Check, Falls, Figure, Pair, Table, created, share

CATALOGUE = ()
CLAIM = ("A rigid block on an incline sticks, slides and tips over as Coulomb's law says: on a rigid table, a rigid plane, an elastic "
         "table and a belt.")
EVIDENCE = "exact"
DRIVER = "scene"

GRAVITY, MASS, SLOPE, FRICTION = 9.81, 16.0, 30, 0.2  # [m/s2] [kg] [degrees] [-] of a block that slides
SETTLED = 0.1                                         # [s]
HERE = "verification/rigid_slider/"
PLANE, SOFT, BELT = HERE + "on_a_plane.yaml", HERE + "on_a_soft_table.yaml", HERE + "on_a_belt.yaml"
SLIDES = {"contacts[0].friction": FRICTION}
TALL = {"bodies[0].mesh.high": "[0.4 m, 0.4 m, 0.8 m]", "contacts[0].friction": 5, "time.end": "0.2 s"}
SLOW = {"planes[0].velocity.value": "['t', '0', '0']"}


def case_of(case, run, change=None):
    """The run of another case; in a break of that case, the break's own."""
    return run.again({**(change or {}), **run.overrides}) if str(run.case_file).endswith(case) else run.other("scene", case, change or {})


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
    return Pair(slope_of(run.again({**SLIDES, **run.overrides})), acceleration(SLOPE, FRICTION, GRAVITY), "m/s2")


def slide_by_a_penalty(run):
    one = run.again({**SLIDES, "contacts[0].method": "penalty", **run.overrides})
    return Pair(slope_of(one), acceleration(SLOPE, FRICTION, GRAVITY), "m/s2")


def slide_on(case):
    return lambda run: Pair(slope_of(case_of(case, run)), acceleration(SLOPE, FRICTION, GRAVITY), "m/s2")


def slide_on_a_belt(run):
    return Pair(slope_of(case_of(BELT, run)), on_a_belt(4, FRICTION, GRAVITY), "m/s2")


def stick_on_a_belt(run):
    return Pair(slope_of(case_of(BELT, run, SLOW)), on_a_belt(1, FRICTION, GRAVITY), "m/s2")


def tip(run):
    """Angular velocity of a block of twice its length."""
    one = run.again({**TALL, **run.overrides})
    end = one.column("time")[-1]
    return Pair(one.at("spin", end), tipping(SLOPE, 0.4, 0.8, GRAVITY, end), "rad/s")


def created_while_it_slides(run):
    return created(run.again({**SLIDES, **run.overrides}))


DEPARTURES = {"method": "one check is of the penalty; all others are by default"}

CHECKS = [
    Check("speed of the block that sticks", creep, 1e-4, "one ten-thousandth of what ice would give"),
    Check("friction that holds", holding, 1e-6, "equilibrium along the incline; iterations of the contact end at a millionth"),
    Check("push of the incline", push, 1e-6, "equilibrium across the incline; the same"),
    Check("what holds the table", carried, 1e-9, "equilibrium of both, where forces of the contact cancel: round-off"),
    Check("acceleration of the block that slides", slide, 1e-4,
          "a constant force; friction is half a step late at the start, before the first tenth of a second"),
    Check("acceleration by a penalty", slide_by_a_penalty, 1e-3, "the block bounces on its springs from the start on; means remain"),
    Check("acceleration on a rigid plane", slide_on(PLANE), 1e-4, "as on the table"),
    Check("acceleration on an elastic table", slide_on(SOFT), 2e-3, "the table rings; its waves move the sole by a thousandth of its way"),
    Check("acceleration on a belt that is too fast", slide_on_a_belt, 1e-4, "as on the incline"),
    Check("acceleration on a belt that takes it along", stick_on_a_belt, 1e-4, "as the belt's own"),
    Check("angular velocity of a tall block that tips", tip, 0.01,
          "friction begins with the first whole step, so half a step of it is missing: first order in the step"),
    Check("energy that was created while it slides", created_while_it_slides, 1e-9, "forces are constant, so this is round-off"),
]

STEEPER = {"gravity": "[4.93 m/s^2, 0 m/s^2, -8.539 m/s^2]"}
BREAKS = [
    Breaks("speed of the block that sticks", "friction below the slope", {"contacts[0].friction": 0.57}),
    Breaks("friction that holds", "friction below the slope", {"contacts[0].friction": 0.57}),
    Breaks("push of the incline", "gravity of 9.86 m/s2", STEEPER),
    Breaks("what holds the table", "a lighter table", {"bodies[1].mass_properties.mass": "1000 kg"}),
    Breaks("acceleration of the block that slides", "a coefficient of 0.21", {"contacts[0].friction": 0.21}),
    Breaks("acceleration by a penalty", "a coefficient of 0.21", {"contacts[0].friction": 0.21}),
    Breaks("acceleration on a rigid plane", "gravity of 9.86 m/s2", STEEPER, PLANE),
    Breaks("acceleration on an elastic table", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, SOFT),
    Breaks("acceleration on a belt that is too fast", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, BELT),
    Breaks("acceleration on a belt that takes it along", "a coefficient of 0.1", {"contacts[0].friction": 0.1}, BELT),
    Breaks("angular velocity of a tall block that tips", "a higher centre",
           {**TALL, "bodies[0].mass_properties.centre": "[0.2 m, 0.2 m, 0.42 m]"}),
    Breaks("energy that was created while it slides", "a soft penalty that samples coarsely",
           {"contacts[0].method": "penalty", "contacts[0].penalty_scale": 2, "contacts[0].step_factor": 0.5}),
]


def by_methods(run):
    rows = []
    for name, overrides in (("multiplier", {}), ("penalty", {"contacts[0].method": "penalty"})):
        one = run.again({**SLIDES, **overrides})
        spin = max(abs(w) for w in one.column("spin"))
        rows.append([name, share(abs(slope_of(one) / acceleration(SLOPE, FRICTION, GRAVITY) - 1)), share(one.created()), f"{spin:.1e}",
                     str(one.summary["cost"]["steps"])])
    return rows


def speeds(run):
    soft, belt = (case_of(case, run) for case in (SOFT, BELT))
    return [("sticks", run.column("time"), run.column("speed")), ("slides on an elastic table", soft.column("time"), soft.column("speed")),
            ("on a belt", belt.column("time"), belt.column("speed"))]


def exact_speeds(_):
    times = [i / 100 for i in range(101)]
    return [(name, times, [rate * t for t in times]) for name, rate in
            (("exact, sticks", 0), ("exact, slides", acceleration(SLOPE, FRICTION, GRAVITY)),
             ("exact, on a belt", on_a_belt(4, FRICTION, GRAVITY)))]


STUDIES = [
    Falls("angular velocity of a tall block that tips", along="time.largest_step", values=["0.2 ms", "0.1 ms", "0.05 ms"], order=0.9),
    Table("The block that slides on the rigid table, by method:",
                 ["method", "error of the acceleration", "created energy", "largest spin [rad/s]", "steps"], by_methods),
]
FIGURES = [Figure("speed", "time [s]", "speed [m/s]", speeds, exact=exact_speeds, caption="Speed of a rigid block.")]
