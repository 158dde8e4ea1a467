"""How close is close enough, why, and what must break."""
from reference import VM65, height, reference
from verify import Breaks, Check, Falls, Figure, Pair, crossings, interpolate

CATALOGUE = ("I-7",)
CLAIM = ("A mass that falls on a spring reaches it after the time of free fall, and its largest compression and the time of it are "
         "those of a harmonic oscillator.")
EVIDENCE = "exact"
DRIVER = "scene"

EXACT = reference(**VM65)  # of the source, not of the case: a slip in the case shows
COLUMN = "verification/mass_on_a_spring/column.yaml"


def touch(run):
    """Time at which the foot of the mass passes the end of the spring at rest. [s]"""
    times = crossings(run.column("time"), run.column("height"), rising=False)
    return times[0] if times else float("nan")


def turn(run):
    """Time of the lowest place: the velocity passes zero. [s]"""
    times = crossings(run.column("time"), run.column("speed"), rising=True)
    return times[0] if times else float("nan")


def impact_time(run):
    return Pair(touch(run), EXACT["impact"], "s")


def impact_speed(run):
    return Pair(-interpolate(run.column("time"), run.column("speed"), touch(run)), EXACT["speed"], "m/s")


def kinetic(run):
    return Pair(interpolate(run.column("time"), run.column("kinetic"), touch(run)), EXACT["kinetic"], "J")


def drop(run):
    return Pair(VM65["height"] - min(run.column("height")), EXACT["drop"], "m")


def lowest(run):
    return Pair(turn(run), EXACT["lowest"], "s")


def largest_force(run):
    return Pair(max(run.column("force")), VM65["stiffness"] * (EXACT["drop"] - VM65["height"]), "N")


def next_top(run):
    """Height to which the mass returns."""
    after = [z for t, z in zip(run.column("time"), run.column("height")) if t > EXACT["release"]]
    return Pair(max(after), VM65["height"], "m")


def by_column(measure):
    return lambda run: measure(run.other("scene", COLUMN, {k: v for k, v in run.overrides.items() if k == "gravity"}))


DEPARTURES = {
    "method, penalty": "the spring of the oscillator is the penalty of the plane: its stiffness belongs to the scene"}

CHECKS = [
    Check("impact time", impact_time, 1e-6,
          "central differences fall exactly, and a straight line between two steps of 0.13 ms is g dt^2/(8 v) beside the fall: 5e-7"),
    Check("impact speed", impact_speed, 4e-5,
          "the spring acts at the end of the step in which it is touched: by up to (w dt)^2/2 of the speed, 3.4e-5"),
    Check("kinetic energy at impact", kinetic, 8e-5, "twice the speed"),
    Check("drop from the start to the lowest place", drop, 2e-5,
          "the block is ten thousand times stiffer than the spring, and half of its mass is at its top: an eighth of 1e-4"),
    Check("time of the lowest place", lowest, 1e-5, "as the drop, in the quarter of the time in which the spring acts"),
    Check("largest force", largest_force, 6e-5, "the block rings: a block ten times softer has ten times the error, 1.8e-4"),
    Check("height of the next top", next_top, 6e-5, "of the order of the speed; half the step leaves a seventh of 1.7e-5"),
    Check("on a column: drop from the start to the lowest place", by_column(drop), 2e-4,
          "the block is five thousand times stiffer than the column, and the column has a ten thousandth of its mass"),
    Check("on a column: time of the lowest place", by_column(lowest), 1e-4, "as the drop"),
]

STUDIES = [
    Falls("time of the lowest place", along="bodies[0].material.young", values=["1e3 psi", "1e4 psi", "1e5 psi"]),
]

TEN = {"gravity": "[0 m/s^2, 0 m/s^2, -10 m/s^2]"}
BREAKS = [
    Breaks("impact time", "a decimal point in the wrong place: 38.6 in/s^2", {"gravity": "[0 in/s^2, 0 in/s^2, -38.6 in/s^2]"}),
    Breaks("impact speed", "386 in/s^2 rounded to 10 m/s^2", TEN),
    Breaks("kinetic energy at impact", "400 in/s^2 in turning the weight into a mass",
           {"bodies[0].material.density": "0.965e-3 lbf*s^2/in^4"}),
    Breaks("drop from the start to the lowest place", "the stiffness per node and not per area: a node too few",
           {"planes[0].penalty": "14.8044 lbf/in^3"}),
    Breaks("time of the lowest place", "the stiffness per node and not per area: a node too few",
           {"planes[0].penalty": "14.8044 lbf/in^3"}),
    Breaks("largest force", "half the mass", {"bodies[0].material.density": "0.5e-3 lbf*s^2/in^4"}),
    Breaks("height of the next top", "a block as soft as the spring, which keeps some energy", {"bodies[0].material.young": "200 psi"}),
    Breaks("on a column: drop from the start to the lowest place", "386 in/s^2 rounded to 10 m/s^2", TEN),
    Breaks("on a column: time of the lowest place", "386 in/s^2 rounded to 10 m/s^2", TEN),
]


def height_over_time(run):
    column = run.other("scene", COLUMN)
    return [(label, [1e3 * t for t in one.column("time")], [1e3 * z for z in one.column("height")])
            for label, one in (("penalty as spring", run), ("column as spring", column))]


def exact_height(run):
    times = [i / 1000 * run.column("time")[-1] for i in range(1001)]
    return [("exact", [1e3 * t for t in times], [1e3 * height(EXACT, VM65["height"], VM65["gravity"], t) for t in times])]


FIGURES = [Figure("height", "time [ms]", "height over the spring [mm]", height_over_time, exact=exact_height,
                  caption="Height of the mass over the end of the spring at rest.")]
