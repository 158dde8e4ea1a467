"""How close is close enough, why, and what must break."""
from reference import reference
from verify import Breaks, Check, Figure, Pair

CATALOGUE = ("C-3",)
CLAIM = "Every apex of an overlap has a gap equal to its depth and a force of penalty times depth, never tension, for any meshes."
EVIDENCE = "exact"
DRIVER = "scene"

DEPTH, PENALTY, AREA = 0.1, 1e-6, 1.0  # [m] [Pa/m] [m2]
PRESSURE, RESULTANT = reference(-DEPTH, PENALTY, AREA)
SWAPPED = {"contacts[0].apexes": "lower.z_high", "contacts[0].base": "upper.z_low"}
APART = {"initial[0].velocity": '["0", "0", "0.2"]'}


def worst(values, expected):
    """The value farthest from what is expected."""
    return max(values, key=lambda value: abs(value - expected))


def gap(run):
    return Pair(worst(run.frame("contact")[1]["gap"], -DEPTH), -DEPTH, "m")


def pressure(run):
    return Pair(worst(run.frame("contact")[1]["contact_pressure"], PRESSURE), PRESSURE, "Pa")


def resultant(run):
    return Pair(abs(run.column("resultant")[-1]), RESULTANT, "N")


def gap_at_the_start(run):
    return Pair(worst(run.frame("contact", 0)[1]["gap"], DEPTH), DEPTH, "m")


def pull(run):
    """The strongest pull on any apex of both runs, one into the other and one apart, over the push of the overlap."""
    pressures = [p for one in (run, run.again(APART)) for number in range(5) for p in one.frame("contact", number)[1]["contact_pressure"]]
    return Pair(min(0.0, min(pressures)), 0, "Pa", scale=PRESSURE)


def force_while_open(run):
    """The largest force before the faces meet, over that of the overlap."""
    early = [abs(force) for t, force in zip(run.column("time"), run.column("resultant")) if t < 0.499]
    return Pair(max(early), 0, "N", scale=RESULTANT)


def until_they_meet(measure):
    """By the program's defaults, to a time before the faces meet: by multipliers they cannot overlap."""
    return lambda run: measure(run.again({"contacts[0].method": "multiplier", "time.overlap_limit": 0.5, "time.end": "0.49 s"}))


def swapped(measure):
    return lambda run: measure(run.again(SWAPPED))


DEPARTURES = {
    "method, penalty": "depths are measured by a penalty so soft that it moves nothing: the subject is the gap",
    "overlap_limit": "the boxes overlap by more than half an element by design"}

CHECKS = [
    Check("gap of every apex", gap, 1e-8, "round-off of some hundred steps; the catalogue's bound"),
    Check("pressure of every apex", pressure, 1e-8, "as the gap"),
    Check("resultant", resultant, 1e-8, "as the gap: the areas of the apexes sum up to the face"),
    Check("gap at the start", until_they_meet(gap_at_the_start), 1e-8, "round-off"),
    Check("pull", pull, 0, "contact pushes or does nothing"),
    Check("force while open", until_they_meet(force_while_open), 0, "no gap, no force"),
    Check("gap of every apex, sides exchanged", swapped(gap), 1e-8, "as above, 4 cells over 5"),
    Check("pressure of every apex, sides exchanged", swapped(pressure), 1e-8, "as above"),
    Check("resultant, sides exchanged", swapped(resultant), 1e-8, "as above"),
]

BREAKS = [
    Breaks("gap of every apex", "a contact height nobody asked for", {"contacts[0].contact_height": "given", "contacts[0].height": "1 mm"}),
    Breaks("pressure of every apex", "half the penalty", {"contacts[0].penalty": "5e-7 Pa/m"}),
    Breaks("resultant", "the area of the base in place of the apex's own", {"contacts[0].area": "base"}),
    Breaks("pull", "a tie where contact is meant", {"contacts[0].kind": "tied"}),
    Breaks("gap of every apex", "a push that is not weak", {"contacts[0].penalty": "1e4 Pa/m"}),
    Breaks("gap at the start", "a contact height nobody asked for", {"contacts[0].contact_height": "given", "contacts[0].height": "1 mm"},
           full=True),
    Breaks("gap of every apex, sides exchanged", "a contact height nobody asked for",
           {"contacts[0].contact_height": "given", "contacts[0].height": "1 mm"}, full=True),
    Breaks("pressure of every apex, sides exchanged", "half the penalty", {"contacts[0].penalty": "5e-7 Pa/m"}, full=True),
    Breaks("resultant, sides exchanged", "half the penalty", {"contacts[0].penalty": "5e-7 Pa/m"}, full=True),
    Breaks("force while open", "a contact height of half the gap", {"contacts[0].contact_height": "given", "contacts[0].height": "50 mm"}),
]


def resultants(run):
    times = run.column("time")
    return [("5 cells over 4", times, [1e6 * abs(f) for f in run.column("resultant")]),
            ("4 cells over 5", times, [1e6 * abs(f) for f in run.again(SWAPPED).column("resultant")])]


def exact_resultant(_):
    times = [0.0, 0.5, 1.0]
    return [("exact", times, [1e6 * reference(DEPTH - 0.2 * t, PENALTY, AREA)[1] for t in times])]


FIGURES = [Figure("resultant", "time [s]", "force [uN]", resultants, exact=exact_resultant,
                  caption="Force between the boxes as one sinks into the other at 0.2 m/s: nothing until they meet, then penalty, depth "
                          "and area.")]
