"""How close is close enough, why, and what must break."""
from reference import TIE, INPUTS, TIME, largest_stress, largest_velocity, pulse
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ()
CLAIM = "A bar of two tied parts carries a pulse as one bar does, in the steps of its elements."
EVIDENCE = "exact"
DRIVER = "scene"

SCALE = (INPUTS["height"] / 2, largest_velocity(**INPUTS))
GAP = 1e-3
UNLIKE = {"bodies[0].mesh.cells": "[400, 3, 3]"}
COARSE = {"bodies[1].mesh.cells": "[200, 3, 3]"}
APART = {"bodies[1].move": f"[{GAP} m, 0 m, 0 m]"}
ONE_FACE = {"bodies[0].mesh.cells": "[400, 3, 3]", "bodies[1].mesh.cells": "[200, 1, 1]"}
FINER = {"bodies[0].mesh.cells": "[400, 6, 6]"}
PENALTY = {"contacts[0].method": "penalty"}
CUT = "a penalty, with the weights of the halves of a face"
BARE = {f"bodies[{body}].element.viscosity.{term}": 0 for body in (0, 1) for term in ("linear", "quadratic")}
WHOLE = "verification/tied_bar/whole.yaml"
ON_ITS_WAY = {"time.end": "120 us", "output.frames_every": "120 us"}  # the pulse's largest stress is at the tie


def line(run):
    """Means over the cross-sections along the bar at the end of the run: {m: (m, m/s)}."""
    _, fields = run.frame("body", -1)
    sums = {}
    for (x, _, _), (u, _, _), (v, _, _) in zip(fields["points"], fields["displacement"], fields["velocity"]):
        there = sums.setdefault(round(x, 7), [0, 0.0, 0.0])
        there[0] += 1
        there[1] += u
        there[2] += v
    return {x: (u / count, v / count) for x, (count, u, v) in sums.items()}


def field(which, gap=0.0):
    """The largest error over all cross-sections, over the height of a pulse or its largest velocity."""
    def measure(run):
        worst = max(abs(got[which] - pulse(x - (gap if x > TIE + gap / 2 else 0), TIME, **INPUTS)[which]) for x, got in line(run).items())
        return Pair(worst, 0, ("m", "m/s")[which], scale=SCALE[which])
    return measure


def of(change, measure):
    return lambda run: measure(run.again({**change, **run.overrides}))


def beside_whole(run):
    """The largest difference of velocity from a bar in one piece with the same viscosity."""
    whole = line(run.other("scene", WHOLE))
    return Pair(max(abs(v - whole[x][1]) for x, (_, v) in line(run).items()), 0, "m/s", scale=SCALE[1])


def steps(run):
    """Against those of the same bar without a tie, which fall apart."""
    apart = run.again({**run.overrides, "contacts": "[]"})
    return Pair(run.summary["cost"]["steps"], apart.summary["cost"]["steps"])


def uneven(run):
    """The largest difference between the axial stress of an element and the mean over its cross-section, over that of the pulse."""
    fields = run.again({**ON_ITS_WAY, **run.overrides}).frame("body", -1)[1]
    sections = {}
    for begin, end, stress, kind in zip([0, *fields["offsets"]], fields["offsets"], fields["stress"], fields["types"]):
        if kind == 12:
            x = sum(fields["points"][n][0] for n in fields["connectivity"][begin:end]) / 8
            sections.setdefault(round(x, 6), []).append(stress[0])
    worst = max(abs(stress - sum(all_) / len(all_)) for all_ in sections.values() for stress in all_)
    return Pair(worst, 0, "Pa", scale=largest_stress(**INPUTS))


def created(run):
    """Of the tie, over the energy of the pulse."""
    ledger = run.summary["ledger"]
    elastic = max(run.column("energy_kinetic"))
    return Pair(ledger["accounts"]["glue"]["created"]["value"], 0, "J", scale=elastic)


PHASE = "phase of the shortest waves: (k c t)(k h)^2/24 (1 - C^2) with C = 0.9 is 2e-4 for 1/k of the pulse's width"
NOT_ALIKE = ("the phase is 0.4 % at steps of half the limit along the bar, which its finer elements across ask for; and where grids are "
             "not nested apexes load the nodes of a face by more than their share")
FINER_STEPS = "phase as on like grids: 0.5 % at steps of half the limit along the bar, which its finer elements across ask for"
PLANE = ("sections stay plane without lateral strain: round-off of positions, 1e-17 m at 0.1 m, over the 1.5e-10 m by which an element is "
         "strained is 1e-7, and an apex has a hundred steps of it")
DEPARTURES = {"viscosity": "checks against d'Alembert's pulse are of bars without it, as the exact one is; all others are by default"}

CHECKS = [
    Check("displacement of all cross-sections", of(BARE, field(0)), 1e-3, PHASE),
    Check("velocity of all cross-sections", of(BARE, field(1)), 2e-3, PHASE),
    Check("velocity, over a gap of an element", of({**BARE, **APART}, field(1, GAP)), 2e-3, PHASE),
    Check("velocity, 3 x 3 on 2 x 2", of({**BARE, **UNLIKE}, field(1)), 0.01, NOT_ALIKE),
    Check("velocity, 3 x 3 on 1 x 1", of({**BARE, **ONE_FACE}, field(1)), 6e-3, FINER_STEPS),
    Check("stress over a section, 3 x 3 on 1 x 1", of(ONE_FACE, uneven), 1e-5, PLANE),
    Check("stress over a section, 6 x 6 on 2 x 2", of(FINER, uneven), 1e-5, PLANE),
    Check("stress over a section, 3 x 3 on 1 x 1, over a gap of an element", of({**ONE_FACE, **APART}, uneven), 1e-5, PLANE),
    Check("steps over those of the parts alone", steps, 1e-9, "a tie by multipliers has no step of its own",
          evidence="invariant"),
    Check("velocity beside a bar in one piece", beside_whole, 2e-3,
          "the bound of the velocity above; elements at a tie have no neighbour beyond it, so their viscosity is that of the end of a bar",
          evidence="invariant"),
    Report("velocity of all cross-sections with the default viscosity", field(1),
           "the crests of the pulse have some viscosity, in a bar of one piece as well"),
    Report("stress over a section, 3 x 3 on 2 x 2", of(UNLIKE, uneven), "apexes do not load the nodes of a base that is not nested evenly"),
    Report("velocity, 2 x 2 on 3 x 3", of(COARSE, field(1)), "nodes of a base between its apexes lag: take the finer grid for the apexes"),
    Report("energy created by the tie", created, "round-off"),
]


def methods(run):
    rows = []
    for name, change in (("like grids", {}), ("3 x 3 on 1 x 1", ONE_FACE), ("3 x 3 on 2 x 2", UNLIKE), ("2 x 2 on 3 x 3", COARSE),
                         ("like grids, a gap", APART)):
        for method, how in (("multiplier", {}), ("penalty 20", PENALTY), ("penalty 200", {**PENALTY, "contacts[0].penalty_scale": 200})):
            one = run.again({**BARE, **change, **how})
            velocity = field(1, GAP if change == APART else 0)(one)
            rows.append([name, method, f"{100 * velocity.error():.2g} %", f"{100 * uneven(one).error():.2g} %",
                         str(one.summary["cost"]["steps"]), f"{created(one).error():.1e}"])
    return rows


STUDIES = [Table("Without viscosity: largest error of velocity over that of a pulse; largest difference of stress over a cross-section as "
                 "the pulse is at the tie, over that of the pulse; steps; and energy created by the tie over that of the pulse.",
                 ["grids", "method", "velocity", "stress over a section", "steps", "created"], methods, full=True)]

OPENS = {"contacts[0].kind": "contact"}
SOFT = {**PENALTY, "contacts[0].penalty": "5e11 Pa/m"}
AT_THE_BOND = {**PENALTY, "time.end": "80 us", "output.frames_every": "80 us"}  # the front of the pulse is there, which shows as much
BREAKS = [
    Breaks("displacement of all cross-sections", "a contact where a tie is meant", OPENS),
    Breaks("velocity of all cross-sections", "a soft layer: a penalty of half the stiffness of an element", SOFT),
    Breaks("velocity, over a gap of an element", "a contact where a tie is meant", OPENS),
    Breaks("velocity, 3 x 3 on 2 x 2", "a soft layer: a penalty of half the stiffness of an element", SOFT),
    Breaks("velocity, 3 x 3 on 1 x 1", CUT, PENALTY),
    Breaks("stress over a section, 3 x 3 on 1 x 1", CUT, AT_THE_BOND),
    Breaks("stress over a section, 6 x 6 on 2 x 2", CUT, AT_THE_BOND),
    Breaks("stress over a section, 3 x 3 on 1 x 1, over a gap of an element", CUT, AT_THE_BOND),
    Breaks("velocity beside a bar in one piece", "a soft layer: a penalty of half the stiffness of an element", SOFT),
    Breaks("steps over those of the parts alone", "a penalty", PENALTY),
]


def curves(run):
    points = sorted(line(run).items())[::3]
    return [("Nereid", [1e3 * x for x, _ in points], [1e6 * v for _, (_, v) in points])]


def exact(run):
    places = [i * 1e-3 - 0.3 for i in range(601)]
    return [("d'Alembert", [1e3 * x for x in places], [1e6 * pulse(x, TIME, **INPUTS)[1] for x in places])]


FIGURES = [Figure("velocity", "position [mm]", "velocity [um/s]", curves, exact=exact,
                  caption="Velocity after 200 us, every third node; the tie is at 100 mm, and one pulse has crossed it.")]
