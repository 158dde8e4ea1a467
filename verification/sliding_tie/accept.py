"""How close is close enough, why, and what must break."""
from reference import accelerations
from verify import Breaks, Check, Figure, Pair

CATALOGUE = ()
CLAIM = ("A tie along the normal lets its body slide over a moving base without friction, and holds it where it would fall off: a block on "
         "a free wedge has the accelerations of Newton's laws, from above and hanging below.")
EVIDENCE = "exact"
DRIVER = "scene"

END, GRAVITY = 0.1, 9.81
UP = {"gravity": "[0 m/s^2, 0 m/s^2, 9.81 m/s^2]"}


def way(run, which, g=GRAVITY):
    """The displacement at the end against that of the constant acceleration."""
    one = run if g > 0 else run.again(UP)
    place = {"wedge": 0, "block": 1, "down": 2}[which]
    return Pair(one.at(which, END), 0.5 * accelerations(g)[place] * END**2, "m")


SAG = "bodies are elastic: gravity acts at once, so they swing about their sag, 2 um of 11 to 17 mm"
CHECKS = [
    Check("pressed: displacement of the block along the floor", lambda run: way(run, "block"), 0.0003, SAG),
    Check("pressed: displacement of the block downwards", lambda run: way(run, "down"), 0.0003, SAG),
    Check("pressed: displacement of the wedge", lambda run: way(run, "wedge"), 0.0003, SAG),
    Check("hanging: displacement of the block along the floor", lambda run: way(run, "block", -GRAVITY), 0.0003, SAG),
    Check("hanging: displacement of the wedge", lambda run: way(run, "wedge", -GRAVITY), 0.0003, SAG),
]

BREAKS = [
    Breaks("pressed: displacement of the block along the floor", "a tie that does not slide", {"contacts[0].slides": "false"}),
    Breaks("pressed: displacement of the block downwards", "a tie that does not slide", {"contacts[0].slides": "false"}),
    Breaks("pressed: displacement of the wedge", "a tie that does not slide", {"contacts[0].slides": "false"}),
    Breaks("hanging: displacement of the block along the floor", "contact, from which it falls", {"contacts[0].kind": "contact"}),
    Breaks("hanging: displacement of the wedge", "contact, from which it falls", {"contacts[0].kind": "contact"}),
]


def ways(run):
    hanging = run.again(UP)
    return [(f"{name}, {state}", [1e3 * t for t in one.column("time")], [1e3 * u for u in one.column(name)])
            for state, one in (("pressed", run), ("hanging", hanging)) for name in ("block", "wedge")]


def exact(_):
    times = [i * END / 100 for i in range(101)]
    return [("Newton's laws", [1e3 * t for t in times], [500 * accelerations(sign * GRAVITY)[place] * t**2 for t in times])
            for sign in (1, -1) for place in (1, 0)]


FIGURES = [
    Figure("way", "time [ms]", "displacement along x [mm]", ways, exact,
           caption="A block on a free wedge, tied along the normal of the slope."),
]
