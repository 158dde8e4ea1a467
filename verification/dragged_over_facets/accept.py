"""How close is close enough, why, and what must break."""
from math import hypot

from reference import reference
from verify import Breaks, Check, Figure, Pair, Report, Table, beyond, side_by_side

CATALOGUE = ("C-8",)
CLAIM = "A block dragged over irregular facets of a flat plane has a constant contact force and friction, and so has every base node."
EVIDENCE = "exact"
DRIVER = "scene"

PENALTY, FRICTION, AREA = 1e-5, 0.25, 0.04           # [Pa/m] [-] [m2]
CLEARANCE, SINKING, ACROSS, ASIDE = 1e-4, 1e-3, 0.5, 0.1  # [m] [m/s]
SLIDES, END = 0.2, 0.6   # [s] when the block has sunk by its clearance and slides; when the run ends
FRAMES = 2.5e-3          # [s]
NODES_OF_BLOCK = 32      # behind those of the disc
PRESSED, PRESS = "verification/dragged_over_facets/pressed.yaml", 1e3 * AREA   # the case by default; its load in [N]
ELASTIC = {"planes[0].nodes": "[disc.bottom]"}


def per_force(run, name):
    """A force over the push that the depth asks for, at each sample while the block slides."""
    ratios = []
    for t, force in zip(run.column("time"), run.column(name)):
        if t >= SLIDES:
            ratios.append(force / reference(PENALTY, SINKING * t - CLEARANCE, AREA, FRICTION)[0])
    return ratios


def normal(run):
    ratios = per_force(run, "normal")
    return Pair(max(ratios, key=lambda r: abs(r - 1)), 1)


def ripple(run):
    ratios = per_force(run, "normal")
    return Pair(max(ratios) - min(ratios), 0, "", scale=1)


def friction(run):
    """Friction over push, at the sample where it is farthest from the coefficient."""
    ratios = [hypot(a, b) / n for a, b, n in zip(per_force(run, "across"), per_force(run, "aside"), per_force(run, "normal"))]
    return Pair(max(ratios, key=lambda r: abs(r - FRICTION)), FRICTION)


def direction(run):
    """Friction across the way over friction along it: it opposes the motion."""
    length = hypot(ACROSS, ASIDE)
    sideways = [(a * ASIDE - b * ACROSS) / length for a, b in zip(per_force(run, "across"), per_force(run, "aside"))]
    against = [-(a * ACROSS + b * ASIDE) / length for a, b in zip(per_force(run, "across"), per_force(run, "aside"))]
    return Pair(max(abs(s / a) for s, a in zip(sideways, against)), 0, "", scale=1)


def jump(component):
    """Measures the largest change of a base node's force between two frames, over the mean force of an inner apex then."""
    def measure(run):
        worst, before = 0.0, None
        for number in range(round(SLIDES / FRAMES), round(END / FRAMES)):
            t, fields = run.frame("body", number)
            push, rub = reference(PENALTY, SINKING * t - CLEARANCE, AREA, FRICTION)
            scale = (push if component == 2 else rub) / 9  # nine cells: an inner apex carries a ninth
            now = [force[component] / scale for force in fields["contact_force"][:-NODES_OF_BLOCK]]
            if before is not None:
                worst = max(worst, max(abs(a - b) for a, b in zip(now, before)))
            before = now
        return Pair(worst, 0, "", scale=1)
    return measure


# ------------------------------------------------------------------------------------------------
# Pressed by a load

def pressed(run, change=None):
    """The block that is pressed: a break's own run, one by a penalty, or another case of this one."""
    return run.again(change or {}) if str(run.case_file).endswith(PRESSED) else run.other(DRIVER, PRESSED, change or {})


def sliding(run, name):
    """A force over the load, at each sample from the time on when the load is whole."""
    return [force / PRESS for t, force in zip(run.column("time"), run.column(name)) if t >= SLIDES]


def pressed_normal(run):
    return Pair(max((abs(n) for n in sliding(pressed(run), "normal")), key=lambda n: abs(n - 1)), 1)


def ripple_of(run):
    return Pair(max(sliding(run, "normal")) - min(sliding(run, "normal")), 0, "", scale=1)


def pressed_friction(run):
    one = pressed(run)
    ratios = [hypot(a, b) / abs(n) for a, b, n in zip(*(sliding(one, name) for name in ("across", "aside", "normal")))]
    return Pair(max(ratios, key=lambda r: abs(r - FRICTION)), FRICTION)


def pressed_direction(run):
    one = pressed(run)
    forces = zip(sliding(one, "across"), sliding(one, "aside"))
    return Pair(max(abs((a * ASIDE - b * ACROSS) / (a * ACROSS + b * ASIDE)) for a, b in forces), 0, "", scale=1)


def pressed_jump(component):
    """The largest change of a base node's force between two frames, over the mean force of an inner apex."""
    def measure(run):
        one, scale = pressed(run), PRESS / 9 * (1 if component == 2 else FRICTION)
        frames = [[force[component] / scale for force in one.frame("body", number)[1]["contact_force"][:-NODES_OF_BLOCK]]
                  for number in range(round(SLIDES / FRAMES), round(END / FRAMES))]
        return Pair(max(abs(a - b) for before, now in zip(frames, frames[1:]) for a, b in zip(before, now)), 0, "", scale=1)
    return measure


BY_DEFAULT = [
    Check("pressed: push over the load", pressed_normal, 2e-3,
          "friction tilts the block about its upper face, which is drawn along, and it sways by 1e-3 of the load"),
    Check("pressed: ripple of the push", lambda run: ripple_of(pressed(run)), 4e-3, "twice the push; the catalogue allows 1 %"),
    Check("pressed: friction over push", pressed_friction, 1e-6, "Coulomb's law holds at each apex, so it holds in the sum"),
    Check("pressed: friction across the way", pressed_direction, 1e-3,
          "each apex is rubbed against its own slip, and they sway at 1e-4 of the speed"),
    Check("pressed: jump of a base node's push", pressed_jump(2), 0.08,
          "between two frames an apex moves by 4 % of a facet's side, and inner ones in front carry a quarter more than the mean"),
    Check("pressed: jump of a base node's friction", pressed_jump(0), 0.08, "as above"),
]

ON_ELASTIC = [Check("ripple of the push", lambda run: ripple_of(pressed(run, ELASTIC)), 0.1, "as it comes"),
              Check("jump of a base node's push", lambda run: pressed_jump(2)(pressed(run, ELASTIC)), 0.1, "as it comes"),
              Check("jump of a base node's friction", lambda run: pressed_jump(0)(pressed(run, ELASTIC)), 0.1, "as it comes")]

# ------------------------------------------------------------------------------------------------

OPTIONS = [("as it is", {}), ("weights of the paper", {"contacts[0].weights": "paper"}), ("area of the base", {"contacts[0].area": "base"}),
           ("both", {"contacts[0].weights": "paper", "contacts[0].area": "base"}), ("two passes", {"contacts[0].passes": "two"})]


def options(run):
    return [[name, f"{ripple(one).got:.1e}", f"{friction(one).error():.1e}", f"{jump(2)(one).got:.3f}", f"{jump(0)(one).got:.3f}"]
            for name, one in ((name, run.again(change)) for name, change in OPTIONS)]


USUAL = {"contacts[0].method": "penalty"}
THROUGHOUT = {"planes[1].nodes": "[block]", "planes[2].nodes": "[block]"}
DEPARTURES = {"method, penalty": "checks of a push at a given depth have a penalty so soft that it moves nothing: force over depth is then "
                                 "known exactly. A block that is pressed is by default, and one check compares it with a penalty"}

CHECKS = [
    Check("push over what the depth asks for", normal, 1e-6, "the block turns by some 1e-8 of its depth under its own weak push"),
    Check("ripple of the push", ripple, 1e-6, "as the push; the catalogue allows 1 %, a flat plane with areas of the apexes has none"),
    Check("friction over push", friction, 1e-6, "Coulomb's law holds at each apex, so it holds in the sum"),
    Check("friction across the way", direction, 1e-6, "as friction"),
    Check("jump of a base node's push", jump(2), 0.06, "between two frames an apex moves by 4 % of a facet's side"),
    Check("jump of a base node's friction", jump(0), 0.06, "as above"),
    *BY_DEFAULT,
    Check("pressed: errors beyond those by a penalty, over the limits", beyond(BY_DEFAULT, USUAL, PRESSED), 0.05,
          "no worse than by the usual penalty; what both leave is the block's sway and the way between two frames", evidence="invariant"),
    Check("pressed on an elastic disc: ripple and jumps beyond those by a penalty, over a tenth of the push",
          beyond(ON_ELASTIC, USUAL, PRESSED), 0.05, "no worse than by the usual penalty", full=True, evidence="invariant"),
    Check("driven throughout: friction over push", lambda run: pressed_friction(pressed(run, THROUGHOUT)), 1e-6,
          "no impulse changes the slip of a block whose nodes are all driven along; Coulomb's law holds all the same"),
    Report("pressed on an elastic disc: ripple of the push", lambda run: ripple_of(pressed(run, ELASTIC)),
           "the disc gives way in facets, so its face is not flat"),
]

def elastic(run):
    return [[name, str(one.summary["cost"]["steps"]), f"{100 * ripple_of(one).got:.2g} %", f"{pressed_jump(2)(one).got:.3f}",
             f"{pressed_jump(0)(one).got:.3f}"]
            for name, one in ((name, run.other(DRIVER, PRESSED, {**ELASTIC, **change}))
                              for name, change in (("by default", {}), ("two passes", {"contacts[0].passes": "two"}),
                                                   ("the usual penalty", USUAL)))]


STUDIES = [
    Table("Pressed: errors by default and by the usual penalty.", ["check", "by default", "by a penalty"],
          side_by_side(BY_DEFAULT, USUAL, PRESSED), full=True),
    Table("Pressed on an elastic disc, which gives way in facets: ripple of the push, and jumps of a base node's force.",
          ["contact", "steps", "ripple", "jump of push", "jump of friction"], elastic, full=True),
    Table("What options do: ripple of the resultant push; friction over push against the coefficient; the largest jump of a base "
          "node's push and friction from frame to frame, over the force of one apex.",
          ["option", "ripple", "friction error", "jump of push", "jump of friction"], options, full=True),
]

FEW = {"output.frames_every": "1 s"}
BREAKS = [
    Breaks("pressed: push over the load", "a load that comes in at once", {"loads[0].value": '"t < 0.2 ? 0 : 1e3"', **FEW}, PRESSED),
    Breaks("pressed: ripple of the push", "a load that comes in at once", {"loads[0].value": '"t < 0.2 ? 0 : 1e3"', **FEW}, PRESSED),
    Breaks("pressed: friction over push", "a coefficient of 0.251", {"contacts[0].friction": 0.251, **FEW}, PRESSED),
    Breaks("driven throughout: friction over push", "a coefficient of 0.251", {"contacts[0].friction": 0.251, **FEW}, PRESSED),
    Breaks("pressed: friction across the way", "dragged 2 degrees aside", {"planes[2].velocity.value": '"0.1175"', **FEW}, PRESSED),
    Breaks("pressed: jump of a base node's push", "the area of the facet in place of the apex's own",
           {**USUAL, "contacts[0].area": "base"}, PRESSED),
    Breaks("pressed: jump of a base node's friction", "equal weights for friction, as the paper has them",
           {**USUAL, "contacts[0].weights": "paper"}, PRESSED, full=True),
    Breaks("pressed on an elastic disc: ripple and jumps beyond those by a penalty, over a tenth of the push",
           "a load that comes in at once", {"loads[0].value": '"t < 0.2 ? 0 : 1e3"'}, PRESSED, full=True),
    Breaks("pressed: errors beyond those by a penalty, over the limits", "a coefficient of 0.251", {"contacts[0].friction": 0.251},
           PRESSED),
    Breaks("friction across the way", "thrown a degree aside", {**FEW, "initial[0].velocity": '["0.5", "0.11", "-1e-3"]'}),
    Breaks("jump of a base node's push", "two passes: apexes of the disc come and go", {"contacts[0].passes": "two"}),
    Breaks("ripple of the push", "the area of the facet in place of the apex's own", {**FEW, "contacts[0].area": "base"}),
    Breaks("jump of a base node's friction", "equal weights for friction, as the paper has them", {"contacts[0].weights": "paper"}),
    Breaks("friction over push", "a stick a million times too soft", {**FEW, "contacts[0].tangential_penalty": 1e-6}),
    Breaks("push over what the depth asks for", "a contact height nobody asked for",
           {**FEW, "contacts[0].contact_height": "given", "contacts[0].height": "0.01 mm"}),
]


def push_over_time(run):
    base = run.again({**FEW, "contacts[0].area": "base"})
    return [("area of the apex", run.column("time"), [1e9 * f for f in run.column("normal")]),
            ("area of the base", base.column("time"), [1e9 * f for f in base.column("normal")])]


def exact_push(run):
    times = [CLEARANCE / SINKING, run.column("time")[-1]]
    return [("exact", times, [1e9 * reference(PENALTY, SINKING * t - CLEARANCE, AREA, FRICTION)[0] for t in times])]


FIGURES = [Figure("push", "time [s]", "push [nN]", push_over_time, exact=exact_push,
                  caption="Push of the disc on a block that sinks slowly while it is dragged over irregular facets. With the area of the "
                          "facet "
                          "under each apex the push follows the facets.")]
