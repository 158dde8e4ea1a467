"""How close is close enough, why, and what must break."""
from math import hypot

from reference import hertz, rolling, speed_at
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table, beyond, side_by_side, straight_line

CATALOGUE = ("C-12",)
CLAIM = ("A soft sphere that slides at 3 m/s on a plane with friction 0.2 starts to roll when and where Coulomb's law, its inertia and "
         "Hertz's flattening say, and then has no friction.")
EVIDENCE = "exact"
DRIVER = "scene"

SPEED, FRICTION, GRAVITY, BLOW = 3.0, 0.2, 9.81, 0.11  # [m/s] [-] [m/s2] [s]
WEIGHT = 1000 * 4 / 3 * 3.141592653589793 * GRAVITY    # [N]
APPROACH, STRAIN = hertz(WEIGHT, 1.0, 20e6, 0.3)       # [m] [-]
TIME, LATER, WAY = rolling(SPEED, FRICTION, GRAVITY, height=1 - APPROACH, radius=1 - STRAIN)
RIGID = rolling(SPEED, FRICTION, GRAVITY)
PART = 2
SWINGS = 0.23  # [s] two of them


def later(run):
    """Mean speed over the last swings of the sphere on its soft foot."""
    end = run.column("time")[-1]
    return run.mean("speed", end - SWINGS, end)


def line(run):
    """(speed at the blow, deceleration) of the straight line that fits the speed while the sphere slides."""
    rows = [(t - BLOW, v) for t, v in zip(run.column("time"), run.column("speed")) if BLOW + 0.02 <= t <= BLOW + 0.42]
    slope, start = straight_line(rows)
    return start, -slope


def begins(run):
    """When it begins to roll: where the line of sliding meets the later speed. [s] after the blow"""
    start, deceleration = line(run)
    return (start - later(run)) / deceleration


def rolling_speed(run):
    return Pair(later(run), LATER, "m/s")


def rolling_time(run):
    return Pair(begins(run), TIME, "s")


def way(run):
    return Pair(run.at("way", BLOW + begins(run)), WAY, "m")


def deceleration(run):
    return Pair(line(run)[1], FRICTION * GRAVITY, "m/s2")


def spin(run):
    """Speed of the crown against the centre over its height above it: that of a sphere that rolls on what is left of its radius."""
    end = run.column("time")[-1]
    rows = [(hypot(x - v, z), v, h) for t, x, z, v, h in zip(run.column("time"), run.column("crown_x"), run.column("crown_z"),
                                                             run.column("speed"),
                                                            run.column("height")) if t > end - SWINGS]
    return Pair(sum(c for c, *_ in rows) / len(rows), sum(v for _, v, _ in rows) / len(rows), "m/s")


def push(run):
    """Mean force of the plane since the blow over the weight."""
    return Pair(PART * run.mean("normal_force", BLOW, run.column("time")[-1]), WEIGHT, "N")


def friction_when_it_rolls(run):
    end = run.column("time")[-1]
    return Pair(PART * run.mean("friction", end - SWINGS, end), 0, "N", scale=FRICTION * WEIGHT)


def cells(core, ring):
    return {"bodies[0].mesh.cells_core": core, "bodies[0].mesh.cells_ring": ring}


MESHES = [0.5, 0.75, 1, 1.5]  # of refine


def meshes(run):
    rows = []
    for refine in MESHES:
        one = run.again({"refine": refine})
        rows.append([f"{round(24 * refine)} around a half", f"{begins(one):.4f}", f"{way(one).got:.4f}", f"{later(one):.4f}",
                     f"{line(one)[1]:.4f}", f"{100 * friction_when_it_rolls(one).error():.2g} %"])
    rows.append(["exact, flattened", f"{TIME:.4f}", f"{WAY:.4f}", f"{LATER:.4f}", f"{FRICTION * GRAVITY:.4f}", "0"])
    return [*rows, ["exact, rigid", f"{RIGID[0]:.4f}", f"{RIGID[2]:.4f}", f"{RIGID[1]:.4f}", f"{FRICTION * GRAVITY:.4f}", "0"]]


PENALTY = {"planes[1].method": "penalty"}
DEPARTURES = {"method": "one check is beside a penalty; all others are by default"}

BY_DEFAULT = [
    Check("time at which it rolls", rolling_time, 0.02, "the catalogue's bound; faces as large as the contact, and the lumped mass"),
    Check("speed when it rolls", rolling_speed, 0.005, "the mean over two swings of 0.03 m/s"),
    Check("way at which it rolls", way, 0.02, "the catalogue's bound; as the time"),
    Check("deceleration while it slides", deceleration, 0.01,
          "friction is 0.2 of the push at every node, and the push is the weight in the mean of the swings"),
    Check("friction when it rolls", friction_when_it_rolls, 0.02,
          "none in the mean; the sphere swings on its elastic foot, and rumbles from node to node"),
]
CHECKS = [
    *BY_DEFAULT,
    Check("errors beyond those by a penalty, over the limits", beyond(BY_DEFAULT, PENALTY), 0.05,
          "no worse than by the usual penalty; what both leave is the mesh's", full=True, evidence="invariant"),
    Report("time at which a rigid sphere rolls", lambda run: Pair(begins(run), RIGID[0], "s"), "5/7 of the speed: the catalogue's number"),
    Report("speed of the crown about the centre", spin, "one node of a body that trembles"),
    Report("mean push since the blow", push, "the weight, but for the mass that facets lack and the swing that is cut off"),
]

STUDIES = [Falls("time at which it rolls", along="refine", values=MESHES, order=1, full=True),
           Falls("friction when it rolls", along="refine", values=MESHES, order=1, full=True),
           Table("Errors by default and by the usual penalty.", ["check", "by default", "by a penalty"], side_by_side(BY_DEFAULT, PENALTY),
                 full=True),
           Table("Time in seconds, way in metres, speed in metres a second, when it rolls; deceleration before and mean friction after, "
                 "over that of sliding.", ["elements", "time", "way", "speed", "deceleration", "friction"], meshes, full=True)]

COARSE = cells(3, 3)
BREAKS = [
    Breaks("errors beyond those by a penalty, over the limits", "a coefficient of 0.203", {"planes[1].friction": 0.203}, full=True),
    Breaks("way at which it rolls", "a coefficient of 0.21", {**COARSE, "planes[1].friction": 0.21}),
    Breaks("time at which it rolls", "a coefficient of 0.21", {**COARSE, "planes[1].friction": 0.21}),
    Breaks("speed when it rolls", "a plane without friction", {**COARSE, "planes[1].friction": 0.001}),
    Breaks("deceleration while it slides", "a coefficient of 0.18", {**COARSE, "planes[1].friction": 0.18}),
    Breaks("friction when it rolls", "looked at before it rolls", {**COARSE, "time.end": "0.5 s"}),
]


def speed_over_time(run):
    rows = [(t, v) for t, v in zip(run.column("time"), run.column("speed")) if t > BLOW]
    return [("Nereid", [t - BLOW for t, _ in rows], [v for _, v in rows])]


def exact_speed(run):
    times = [0.0, TIME, run.column("time")[-1] - BLOW]
    return [("exact", times, [speed_at(t, SPEED, FRICTION, GRAVITY, TIME, LATER) for t in times])]


FIGURES = [Figure("speed", "time after the blow [s]", "speed [m/s]", speed_over_time, exact=exact_speed,
                  caption="A soft sphere slides and begins to roll. It swings about the straight lines, as it bounces a little on its "
                          "foot.")]
