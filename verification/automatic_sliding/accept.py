"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import acceleration, drive, sliding_speed
from verify import Breaks, Check, Figure, Miss, Pair, Table, share

CATALOGUE = ()
CLAIM = ("By automatic contact, bodies slide on flat faces as Coulomb's law says, a body that passes another is not touched, and a true "
         "step stops a body.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/automatic_sliding/"
STEEL, SOFT, INCLINE = HERE + "steel.yaml", HERE + "soft.yaml", HERE + "incline.yaml"
JOINT, BEVEL, RING, SHAFT = (HERE + name + ".yaml" for name in ("steel_floors", "bevel", "ring", "shaft"))
PLATE, BOX, MISS, PLUG, FLOORS = (HERE + name + ".yaml" for name in ("plate_on_a_box", "box_on_a_plate", "near_miss", "plug", "two_floors"))
GRAVITY, CELL, BLOCK = 9.81, 0.05, 0.1      # [m/s2]; [m] of the rigid blocks
FRICTIONLESS = {"contacts[0].friction": 0}
FLUSH = {"bodies[0].mesh.low": "[0 m, 0.05 m, -0.05 m]", "bodies[0].mesh.high": "[1 m, 0.15 m, 0 m]", "bodies[0].mesh.cells": "[20, 2, 1]"}
TIED = {"contacts": "[{name: touch, kind: automatic, friction: 0.2}, "
                      "{name: joint, kind: tied, apexes: next.x_low, base: floor.x_high}]"}
STEP = {"bodies[1].mesh.high": "[1 m, 0.2 m, 2 mm]"}


def case_of(case, run, change=None):
    """The run of another case; in a break of that case, the break's own."""
    return run.again({**(change or {}), **run.overrides}) if str(run.case_file).endswith(case) else run.other("scene", case, change or {})


def keeps_speed(case=None, change=None, friction=0.0, speed=1.0):
    """The mean error of the speed of a free block over its path."""
    def measure(run):
        one = case_of(case, run, change) if case else run.again({**(change or {}), **run.overrides})
        times, speeds = one.column("time"), one.column("speed")
        off = [abs(v - sliding_speed(t, speed, friction, GRAVITY)) for t, v in zip(times, speeds)]
        return Pair(sum(off) / len(off), 0, "m/s", scale=speed)
    return measure


def lift(run):
    return Pair(max(map(abs, run.column("height"))), 0, "m", scale=CELL)


def spin(run):
    return Pair(max(run.column("spin")) * BLOCK, 0, "m/s", scale=1.0)


def steel_drive(run):
    return Pair(case_of(STEEL, run).mean("drive", 4e-3, 10e-3), drive(0.2, 20e6, 0.01), "N")


def steel_sole(run):
    """What the sole lags behind the top, over the path."""
    one = case_of(STEEL, run)
    return Pair(one.column("top")[-1] - one.column("sole")[-1], 0, "m", scale=one.column("top")[-1])


def drive_over_the_joint(change=None):
    """The mean from just before the block comes to the joint on."""
    return lambda run: Pair(case_of(JOINT, run, change).mean("drive", 4e-3, 12e-3), drive(0.2, 20e6, 0.01), "N")


def spin_of_the_shaft(run):
    return Pair(case_of(SHAFT, run).column("spin")[-1], 20, "rad/s")


def soft_drive(run):
    return Pair(case_of(SOFT, run).mean("drive", 0.06, 0.11), drive(0.3, 20e3, 0.01), "N")


def down(run):
    one = case_of(INCLINE, run)
    first, last = 0.1, one.column("time")[-1]
    return Pair((one.at("speed", last) - one.at("speed", first)) / (last - first), acceleration(30, 0.2, GRAVITY), "m/s2")


def lift_of(case):
    return lambda run: Pair(max(map(abs, case_of(case, run).column("height"))), 0, "m", scale=CELL)


CLEARANCES = ("0.0333 um", "1 um", "20 um", "100 um")  # the first is 1e-6 of a facet
WAYS = {  # place of a block that passes with a clearance c [m], and where it flies
    "falls past": (lambda c: (0.1 + c, 0.01, 0.12), (0, 0, -1)),
    "flies over": (lambda c: (-0.12, 0.01, 0.1 + c), (1, 0, 0)),
    "edge past edge": (lambda c: (0.2 + c / sqrt(2), c / sqrt(2), 0.01), (-sqrt(0.5), sqrt(0.5), 0)),
}


def change_of_velocity(one, speed):
    """The largest change of the velocity since the start, over the speed."""
    parts = [one.column(name) for name in "xyz"]
    return max(sqrt(sum((part[i] - part[0])**2 for part in parts)) for i in range(len(parts[0]))) / speed


def passing(run, way, clearance, speed, change=None):
    """The change of the velocity of a block that flies past."""
    place, heading = WAYS[way]
    number, unit = clearance.split()
    c = float(number) * {"um": 1e-6, "mm": 1e-3}[unit]
    keys = {"bodies[1].move": "[" + ", ".join(f"{part!r} m" for part in place(c)) + "]",
            "initial[0].velocity": "[" + ", ".join(f'"{part * speed!r}"' for part in heading) + "]",
            "time.end": f"{0.3 / speed!r} s", "output.history_every": f"{0.003 / speed!r} s", "output.frames_every": f"{0.3 / speed!r} s"}
    return change_of_velocity(case_of(MISS, run, {**keys, **(change or {})}), speed)


def near_misses(way):
    return lambda run: Pair(max(passing(run, way, clearance, 10.0) for clearance in CLEARANCES), 0, "", scale=1)


def at_any_speed(run):
    return Pair(max(passing(run, "falls past", CLEARANCES[0], speed) for speed in (1.0, 30.0)), 0, "", scale=1)


def with_five_steps(run):
    """By the size of the step: a block passes at another part of a step, in which it moves by a hundred times the clearance."""
    changes = [passing(run, "edge past edge", CLEARANCES[2], 10.0, {"time.safety": part}) for part in (0.88, 0.86, 0.83, 0.8, 0.7)]
    return Pair(max(changes), 0, "", scale=1)


def plug(run):
    return Pair(change_of_velocity(case_of(PLUG, run), 10.0), 0, "", scale=1)


def stops_at_the_step(run):
    """How far the front of the block goes beyond a step of 2 mm at 0.5 m; the block must get there first."""
    front = max(case_of(FLOORS, run, STEP).column("front"))
    return Pair(front, 0.5, "m", scale=CELL)


def comes_back(run):
    """A rigid block that strikes a rigid step does not go on: its speed ahead afterwards."""
    one = case_of(FLOORS, run, STEP)
    return Pair(max(0.0, one.column("speed")[-1]), 0, "m/s", scale=1.0)


SPEED = "a thousandth of the speed: forces are constant and sole and floor are flat"
KEPT = "without friction nothing pushes along a flat sole: round-off"
WHOLE = ("a rigid block on a flat floor neither leaves it nor turns; in a step it would fall by 3e-5 of a cell, of which iterations leave "
         "1e-5, in each of 1750")
UNTOUCHED = "undeformed bodies that keep apart exert no force: round-off"
DEPARTURES = {"safety": "near misses with five steps: a block must pass wherever it is at the end of a step"}

CHECKS = [
    Check("speed of a block without friction", keeps_speed(), 1e-9, KEPT),
    Check("lift of a block without friction, in cells", lift, 1e-6, WHOLE),
    Check("spin of a block without friction times its length", spin, 2e-7,
          "a rigid block on a flat floor does not turn; iterations end at 1e-5 of what the weight does to a rate in a step"),
    Check("speed of a block with friction 0.1", keeps_speed(change={"contacts[0].friction": 0.1}, friction=0.1), 1e-3, SPEED),
    Check("speed of a block as wide as its floor", keeps_speed(change=FLUSH), 1e-9, KEPT),
    Check("speed of a block with bevels", keeps_speed(BEVEL), 1e-9, KEPT),
    Check("lift of a block with bevels, in cells", lift_of(BEVEL), 1e-6, WHOLE),
    Check("bar in a ring: speed along the axis", keeps_speed(RING), 1e-6,
          "the facets of both are parallel to the axis, but for a millionth by which the bar turns where iterations end"),
    Check("steel: drive", steel_drive, 0.01, "the mean over 20 periods of the block; waves of the start remain"),
    Check("steel: the sole follows the top", steel_sole, 0.01,
          "the block shears and tilts on its elastic floor by a thousandth of its height"),
    Check("soft: drive", soft_drive, 0.03, "the mean over four periods of block and floor, which sway"),
    Check("incline: acceleration", down, 1e-6, "a constant force, to the 1e-6 at which iterations of friction end"),
    Check("incline: lift, in cells", lift_of(INCLINE), 1e-6, WHOLE),
    Check("plate on a box: speed", keeps_speed(PLATE, friction=0.2), 1e-3, SPEED),
    Check("box on a plate: speed", keeps_speed(BOX, friction=0.2), 1e-3, SPEED),
    Check("plate on a box without friction: speed", keeps_speed(PLATE, FRICTIONLESS), 1e-3, SPEED),
    Check("box on a plate without friction: speed", keeps_speed(BOX, FRICTIONLESS), 1e-3, SPEED),
    *(Check(f"near miss, {way}: change of the velocity", near_misses(way), 1e-9, UNTOUCHED) for way in WAYS),
    Check("near miss at 1 and 30 m/s: change of the velocity", at_any_speed, 1e-9, UNTOUCHED),
    Check("near miss, edge past edge, with five steps: change of the velocity", with_five_steps, 1e-9, UNTOUCHED),
    Check("plug through its bore: change of the velocity", plug, 1e-9, UNTOUCHED),
    Check("where a step of 2 mm stops the block", stops_at_the_step, 1e-9,
          "the front comes to the riser at a row of the history, and contact closes the gap at most: round-off"),
    Check("speed ahead after the step", comes_back, 1e-3, "a rigid block that strikes a rigid step does not go on"),
    Check("flush floors: speed over the joint", keeps_speed(FLOORS), 1e-9, KEPT),
    Check("flush steel floors: drive over the joint", drive_over_the_joint(), 0.01,
          "the floors give way by 5 µm, 0.02 % of an edge, and the block sways as it leaves the one that is pressed down"),
    Check("tied steel floors: drive over the joint", drive_over_the_joint(TIED), 0.01, "the same; nothing sinks beside the joint"),
    Miss("shaft in a bore: spin after a second", spin_of_the_shaft, 0.01, "nothing turns a round shaft without friction",
         "it falls by half a millimetre, and its edges strike the facets of the bore, which push along their own normals and turn the "
         "energy of the fall into spin; with half as many facets it gains 0.2 %",
         full=True),
    Check("flush floors: lift, in cells", lift_of(FLOORS), 1e-6, WHOLE),
]

ROUGH = {"contacts[0].friction": 0.01}
TILTED = {"gravity": "[0.1 m/s^2, 0 m/s^2, -9.81 m/s^2]"}
NEARER = {"bodies[1].move": "[0.099 m, 0.01 m, 0.12 m]", "initial[0].velocity": '["0", "0", "-10"]'}
BREAKS = [
    Breaks("speed of a block without friction", "a coefficient of 0.01", ROUGH),
    Breaks("lift of a block without friction, in cells", "thrown up at 0.1 m/s", {"initial[0].velocity": '["1", "0", "0.1"]'}),
    Breaks("spin of a block without friction times its length", "a centre too far ahead",
           {"bodies[1].mass_properties.centre": "[0.16 m, 0.1 m, 0.05 m]"}),
    Breaks("speed of a block with friction 0.1", "a coefficient of 0.11", {"contacts[0].friction": 0.11}),
    Breaks("speed of a block as wide as its floor", "a coefficient of 0.01", ROUGH),
    Breaks("speed of a block with bevels", "a coefficient of 0.01", ROUGH, BEVEL),
    Breaks("lift of a block with bevels, in cells", "thrown up at 0.1 m/s", {"initial[0].velocity": '["1", "0", "0.1"]'}, BEVEL),
    Breaks("bar in a ring: speed along the axis", "a coefficient of 0.01", ROUGH, RING),
    Breaks("steel: drive", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, STEEL),
    Breaks("steel: the sole follows the top", "a block as soft as rubber", {"bodies[1].material.young": "2 GPa"}, STEEL),
    Breaks("soft: drive", "a coefficient of 0.32", {"contacts[0].friction": 0.32}, SOFT),
    Breaks("incline: acceleration", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, INCLINE),
    Breaks("incline: lift, in cells", "friction that tips the block", {"contacts[0].friction": 1.5, "bodies[1].mesh.high":
                                                                       "[0.1 m, 0.1 m, 0.3 m]"}, INCLINE),
    Breaks("plate on a box: speed", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, PLATE),
    Breaks("box on a plate: speed", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, BOX),
    Breaks("plate on a box without friction: speed", "a floor that is not level", {**FRICTIONLESS, **TILTED}, PLATE),
    Breaks("box on a plate without friction: speed", "a floor that is not level", {**FRICTIONLESS, **TILTED}, BOX),
    Breaks("near miss, falls past: change of the velocity", "bodies that overlap by 1 mm", NEARER, MISS),
    Breaks("near miss, flies over: change of the velocity", "bodies that overlap by 1 mm", {"bodies[1].move": "[-0.12 m, 0.01 m, 0.099 m]"},
           MISS),
    Breaks("near miss, edge past edge: change of the velocity", "bodies that overlap by 1 mm",
           {"bodies[1].move": "[0.199 m, 0 m, 0.01 m]"}, MISS),
    Breaks("near miss at 1 and 30 m/s: change of the velocity", "bodies that overlap by 1 mm", {"bodies[1].move": NEARER["bodies[1].move"]},
           MISS),
    Breaks("near miss, edge past edge, with five steps: change of the velocity", "bodies that overlap by 1 mm",
           {"bodies[1].move": "[0.199 m, 0 m, 0.01 m]"}, MISS),
    Breaks("plug through its bore: change of the velocity", "a plug that is 0.1 mm too wide",
           {"bodies[1].mesh.radii": "[20 mm, 50.1 mm]"}, PLUG),
    Breaks("where a step of 2 mm stops the block", "no step", {"bodies[1].mesh.high": "[1 m, 0.2 m, 0 mm]"}, FLOORS),
    Breaks("speed ahead after the step", "no step", {"bodies[1].mesh.high": "[1 m, 0.2 m, 0 mm]"}, FLOORS),
    Breaks("flush floors: speed over the joint", "a step of 2 mm", STEP, FLOORS),
    Breaks("flush steel floors: drive over the joint", "a coefficient of 0.21", {"contacts[0].friction": 0.21}, JOINT),
    Breaks("tied steel floors: drive over the joint", "a coefficient of 0.21",
           {"contacts": TIED["contacts"].replace("0.2}", "0.21}")}, JOINT),
    Breaks("flush floors: lift, in cells", "a gap in which the block tips", {"bodies[1].mesh.low": "[0.56 m, 0 m, -0.05 m]",
                                                                             "bodies[1].mesh.high": "[1 m, 0.2 m, -0.01 m]"}, FLOORS),
]


def misses(run):
    """Rows of the table of near misses."""
    return [[way, *(share(passing(run, way, clearance, 10.0)) for clearance in CLEARANCES)] for way in WAYS]


STUDIES = [Table("Largest change of the velocity of a block that flies past another at 10 m/s, over its speed, by clearance.",
                 ["", *CLEARANCES], misses)]


def speeds(run):
    plate = case_of(PLATE, run)
    rough = run.again({"contacts[0].friction": 0.1})
    return [(name, one.column("time"), one.column("speed"))
            for name, one in (("box, friction 0", run), ("box, friction 0.1", rough), ("plate, friction 0.2", plate))]


def exact_speeds(_):
    return [(f"exact, friction {mu}", [0, end], [sliding_speed(t, 1, mu, GRAVITY) for t in (0, end)])
            for mu, end in ((0, 0.7), (0.1, 0.7), (0.2, 0.3))]


FIGURES = [Figure("speed", "time [s]", "speed [m/s]", speeds, exact=exact_speeds, caption="Speed of rigid blocks by automatic contact.")]
