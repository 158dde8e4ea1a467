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
    Check("impact time", impact_time, 0.001, "the catalogue's bound; central differences fall exactly"),
    Check("impact speed", impact_speed, 0.001, "the catalogue's bound"),
    Check("kinetic energy at impact", kinetic, 0.001, "the catalogue's bound"),
    Check("drop from the start to the lowest place", drop, 0.001,
          "the catalogue's bound; the block is ten thousand times stiffer than the spring"),
    Check("time of the lowest place", lowest, 0.001, "the catalogue's bound"),
    Check("largest force", largest_force, 0.005, "means between rows, and the block's own ringing"),
    Check("height of the next top", next_top, 0.001, "nothing is lost"),
    Check("on a column: drop from the start to the lowest place", by_column(drop), 0.001,
          "the catalogue's bound; the contact makes the spring 0.2 % softer, the column is a ten thousandth of the mass"),
    Check("on a column: time of the lowest place", by_column(lowest), 0.001, "as the drop"),
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
