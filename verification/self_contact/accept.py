"""How close is close enough, why, and what must break."""
from reference import nearest
from verify import Breaks, Check, Figure, Pair, Report, created

CATALOGUE = ()
CLAIM = ("Bodies touch themselves: a tube is crushed to a third of its length, a strip of plates folds, and a ring of bricks closes, with "
         "one automatic contact and no declared pair; nothing passes through itself at any frame.")
EVIDENCE = "invariant"
DRIVER = "scene"

HERE = "verification/self_contact/"
THICKNESS = 2e-3  # [m] of the strip
APART = 10        # segments of the strip, 2.5 mm each: farther than it can bend


def of(name):
    return lambda run: run if name == "case" else run.other("scene", f"{HERE}{name}.yaml", run.overrides)


def overlap(name):
    return lambda run: Pair(of(name)(run).result("audit_overlap_elements"), 0, "", scale=1)


def made(name):
    return lambda run: created(of(name)(run))


def lines(run):
    """The nodes of the strip at the end, line by line, in the order along it."""
    _, fields = of("strip")(run).frame("body")
    rows = {}
    for (x, y, z), u in zip(fields["points"], fields["displacement"]):
        rows.setdefault(round(y, 6), []).append((x, (x + u[0], z + u[2])))
    return [[place for _, place in sorted(row)] for row in rows.values()]


def closest(run):
    return Pair(min(nearest(line, APART) for line in lines(run)), THICKNESS, "m")


def drilling(run):
    """Of the energy that the tube took, what went into turns of its nodes about the normal, which stand for nothing."""
    took = sum(run.column(f"energy_tube_{what}")[-1]
               for what in ("elastic", "plastic", "transverse_shear", "residual_bending", "drilling", "viscous"))
    return Pair(run.column("energy_tube_drilling")[-1] / took, 0, "", scale=1)


DEPARTURES = {}

CHECKS = [
    Check("deepest overlap of the crushed tube, in elements", overlap("case"), 0.07,
          "folds of plates go through each other by twice the way of a step, 3.5 % of an element, before the contact has them"),
    Check("deepest overlap of the folded strip, in elements", overlap("strip"), 0.01,
          "less than the way of a step: multipliers leave none"),
    Check("deepest overlap of the closed ring, in elements", overlap("ring"), 0.01, "the same"),
    Check("created energy, tube", made("case"), 1e-5, "multipliers create at touches alone, and plates of a fold are light"),
    Check("created energy, strip", made("strip"), 1e-6, "the same; it touches once"),
    Check("created energy, ring", made("ring"), 1e-4, "the same, of all that the ring has: it is elastic"),
    Check("distance of the strip from itself", closest, 0.02,
          "it touches at half of its thickness on both sides, and between two lines of nodes as well as on them"),
    Report("energy of drilling over all that the tube took", drilling, "a penalty of the plate that coarse folds load: theory/plate.md"),
]

GO_ON = {"contacts[0].self_contact": "false", "time.overlap_limit": "1e9"}
NONE = {"contacts": "[]", "time.overlap_limit": "1e9"}  # one body: without its own contact nothing is left to touch
BREAKS = [
    Breaks("deepest overlap of the crushed tube, in elements", "no contact with itself", GO_ON),
    Breaks("deepest overlap of the folded strip, in elements", "no contact with itself", NONE),
    Breaks("deepest overlap of the closed ring, in elements", "no contact with itself", NONE),
    Breaks("distance of the strip from itself", "no contact with itself", NONE),
    *(Breaks(f"created energy, {name}", "a penalty at the longest step that a case can ask for",
             {"contacts[0].method": "penalty", "contacts[0].energy_gain_limit": 0.04}, full=True) for name in ("tube", "strip", "ring")),
]


def folded(run):
    places = lines(run)[0]
    return [("mid-surface of one side", [1e3 * x for x, _ in places], [1e3 * z for _, z in places])]


def pushed(run):
    return [("tube", [20e3 * t for t in run.column("time")], [-4e-3 * f for f in run.column("force")])]


FIGURES = [
    Figure("strip", "x [mm]", "z [mm]", folded, caption="The strip at the end: it touches itself at its thickness."),
    Figure("tube", "way of the ram [mm]", "force on a whole tube [kN]", pushed,
           caption="Force on the ram as the tube is crushed to a third of its length: a peak for each fold."),
]
