"""How close is close enough, why, and what must break."""
import math

from reference import crossed, silent, sound
from verify import GOOD_ENDINGS, Breaks, CannotRun, Check, Figure, Pair, Report, Table, Waiver

CATALOGUE = ("C-16",)
CLAIM = "At any impact speed, with any initial overlap and where nodes coincide, a wrong result is refused, stopped or warned of."
EVIDENCE = "invariant"
DRIVER = "scene"

PLATE = "verification/fast_approach/plate.yaml"
SOUND, DEPTH, THICKNESS = sound(1e6, 1000), 0.25, 0.005  # [m/s] [m] of an element, of the plate
WEIGHT = 1000 * 0.5 * 9.81  # [N] of the upper block


def at(speed):
    """Keys of an approach with this many times the speed of sound."""
    return {"initial[0].velocity": f'["0", "0", "-{speed * SOUND:.8g}"]'}


def moved(by):
    return {"bodies[1].move": f"[0 m, 0 m, {by}]"}


MATCHING = {"bodies[1].mesh.cells": "[4, 4, 2]"}
OVERLAP, STILL = moved("-10 mm"), {"initial[0].velocity": '["0", "0", "0"]'}
SPEEDS = (0.1, 0.3, 0.4, 0.5, 1, 10, 100)
ROWS = [*((f"{v:g} c", "case", at(v), DEPTH) for v in SPEEDS),
        *((f"{v:g} c, a penalty of {h:g} of the stiffness", "case",
           {**at(v), "contacts[0].method": "penalty", "contacts[0].penalty_scale": h}, DEPTH)
          for v, h in ((0.1, 0.1), (0.1, 0.01), (0.3, 0.1))),
        *((f"{v:g} c, plate of 5 mm", "plate", at(v), THICKNESS) for v in (0.1, 1, 3)),
        ("overlap of 9 mm", "case", OVERLAP, DEPTH), ("overlap of 9 mm, accepted", "case",
                                                      {**OVERLAP, "contacts[0].initial_penetration": "accept"}, DEPTH),
        ("nodes on nodes", "case", {**moved("-1 mm"), **MATCHING}, DEPTH)]


def tell(run, case, keys, depth):
    """(word, part of an element crossed in the first step, created, deepest over depth, silent) of one row."""
    try:
        one = run.again(keys) if case == "case" else run.other("scene", PLATE, {**carried(run), **keys})
    except CannotRun as refusal:
        said = "start penetrated" in str(refusal)
        return "refused" if said else "refused, without a reason", None, None, None, not said
    created = [account["created_relative"]["value"] for account in one.summary["ledger"]["accounts"].values()]
    created = max((abs(c) for c in created if c is not None), default=float("nan"))
    deepest = -min(one.column("gap"))
    warned = any("had a penetration of" in note for note in one.summary["notes"])
    quiet = silent(one.ending in GOOD_ENDINGS, warned, created, deepest, depth)
    step = crossed(speed_of(one), one.result("largest_step"), depth)
    return one.ending + (", warned" if warned else ""), step, created, deepest / depth, quiet


def carried(run):
    """Keys of a break that hold for the plate as well."""
    return {key: value for key, value in run.overrides.items() if key.startswith("time")}


def speed_of(run):
    return -float(run.case("initial[0].velocity")[2])


def told(run):
    """Approaches at ten times the speed of sound and more that are stopped or warned of, less rows that end as if all were well and are
    not."""
    fast = [v for v in SPEEDS if v >= 10]
    silent = sum(1 for _, *row in ROWS if tell(run, *row)[-1])
    return Pair(sum(1 for v in fast if loud(run.again(at(v)))) - silent, len(fast))


def loud(one):
    return one.ending not in GOOD_ENDINGS or any("had a penetration of" in note for note in one.summary["notes"])


def refused(run):
    return Pair(float(tell(run, "case", OVERLAP, DEPTH)[0] == "refused"), 1)


def accepted_force(run):
    """The largest force between blocks that stand still in an accepted overlap, over the weight of the upper one."""
    force = run.again({**OVERLAP, "contacts[0].initial_penetration": "accept", **STILL, **run.overrides}).column("force")
    return Pair(max(map(abs, force)), 0, "N", scale=WEIGHT)


def coincident(run):
    """Momentum after an impact of nodes that stand exactly on nodes, against a gap of 1 nm."""
    on, off = (run.again({**moved(by), **MATCHING}).column("upper")[-1] for by in ("-1 mm", "-0.999999 mm"))
    return Pair(on, off, "N s")


def momentum(run):
    first, last = (run.column("upper")[i] + run.column("lower")[i] for i in (0, -1))
    return Pair(last, first, "N s")


def deepest(run):
    return Pair(-min(run.column("gap")) / DEPTH, 0, "", scale=1)


def table(run):
    def shown(value):
        return "" if value is None else f"{value:.2g}"
    return [[name, word, shown(step), shown(created), shown(depth)] for name, (word, step, created, depth, _) in
            ((name, tell(run, *row)) for name, *row in ROWS)]


DEPARTURES = {"method, penalty_scale": "one check is of the depth under penalties of many stiffnesses; multipliers let nothing in"}

TOLD = "approaches at ten times the speed of sound and more that are stopped or warned of, less runs that go wrong in silence"
CHECKS = [
    Check(TOLD, told, 0, "strains beyond one: nothing here is meant for them. Wrong is energy from nowhere, 5 % or more, or an apex deeper "
          "than half an element; the catalogue's: never silent"),
    Check("an overlap at the start is refused", refused, 0, "with the number of apexes and the depth, and what to do"),
    Check("force at the start of an accepted overlap", accepted_force, 1e-12, "the overlap becomes an offset of each apex"),
    Check("momentum after nodes met nodes", coincident, 2e-7,
          "an apex on a vertex has no direction of its own and takes that of the facets: as a nanometre above, which is 6.5e-8 of the "
          "momentum, and ten nanometres ten times that"),
    Check("momentum of both", momentum, 1e-12, "contact gives what it takes: round-off"),
    Report("deepest apex at a tenth of c, over the depth of an element", deepest,
           "the vote knows no speed: with the penalty the program chooses an apex goes about v/c over 5 deep"),
]

STUDIES = [Table("What the program does. Part of an element crossed in the largest step, energy created over the initial, deepest apex "
                 "over the depth of an element.",
                 ["approach", "ending", "crossed in a step", "created", "deepest"], table)]


def too_fast(run):
    """Three tenths of the speed of sound or more, or a penalty below a twentieth of the stiffness: the rows that go wrong loudly."""
    return speed_of(run) > 0.25 * SOUND or float(run.overrides.get("contacts[0].penalty_scale", 1)) < 0.05


WAIVERS = [
    Waiver("created energy of any source at any time", too_fast,
           "this is what the case shows, and what stops the run or is warned of", up_to=math.inf),
]

BREAKS = [
    Breaks("an overlap at the start is refused", "overlaps taken as they are", {"contacts[0].initial_penetration": "accept"}),
    Breaks("momentum of both", "gravity left on", {"gravity": "[0 m/s^2, 0 m/s^2, -9.81 m/s^2]"}),
    Breaks(TOLD, "ended too early", {"time.end": "20 us"}, full=True),
    Breaks("force at the start of an accepted overlap", "blocks that approach by a micrometre per second",
           {"initial[0].velocity": '["0", "0", "-1e-6"]'}, full=True),
    Breaks("momentum after nodes met nodes", "a velocity in cm/s: the nanometre then takes a hundred times as long",
           {"initial[0].unit": "cm/s"}, full=True),
]


def energy_over_speed(run):
    rows = [(v, tell(run, "case", at(v), DEPTH)) for v in SPEEDS if v <= 1]
    return [("deepest apex over the depth of an element", [v for v, _ in rows], [row[3] for _, row in rows]),
            ("energy created over the initial", [v for v, _ in rows], [row[2] for _, row in rows])]


def bounds(_):
    return [("half an element", [0.1, 1], [0.5, 0.5]), ("created energy that stops a run", [0.1, 1], [0.05, 0.05])]


FIGURES = [Figure("speed", "speed over that of sound [-]", "depth, created energy [-]", energy_over_speed, exact=bounds, log=True,
                  caption="How deep apexes go and what energy contact creates as two blocks meet faster; above 0.3 of the speed of sound "
                          "the run is stopped.")]
