"""How close is close enough, why, and what must break."""
from reference import PLATES, PUSHED, STRUCK, chain
from verify import Breaks, Check, Falls, Figure, Pair, Table, share

CATALOGUE = ()
CLAIM = "A row of rigid plates with gaps, the first struck or pushed, moves blow by blow as masses do that meet with the given restitution."
EVIDENCE = "exact"
DRIVER = "scene"

SLUG = "pushed.yaml"
HALF, NONE = ({f"contacts[{i}].restitution": e for i in range(5)} for e in (0.5, 0))
EXACT = {("case.yaml", e): chain(**PLATES, **STRUCK, restitution=e) for e in (1, 0.5, 0)}
EXACT.update({(SLUG, e): chain(**PLATES, **PUSHED, restitution=e) for e in (1, 0)})
MASSES, SPEED = PLATES["masses"], STRUCK["speed"]
MOMENTUM, ENERGY = MASSES[0] * SPEED, MASSES[0] * SPEED**2 / 2
FULL_SPEED = PUSHED["force"] * PUSHED["pulse"] / 2 / MASSES[0]  # [m/s] that the pulse would give to the first plate alone


# ------------------------------------------------------------------------------------------------
# Of a run

def of(case, change, run):
    """The run of a case of this folder with these keys, and with those of a break or study."""
    if case == SLUG:
        return run.other("scene", f"verification/rigid_chain/{case}", {**change, **run.overrides})
    return run.again({**change, **run.overrides})


def speeds(run):
    return [run.column(f"speed_{i}")[-1] for i in range(1, 7)]


def pushes(juncture, run):
    """Impulse of a contact in each row of the history: a force is the mean since the row before. [(middle of the row, N s)]"""
    times, forces = run.column("time"), run.column(f"force_{juncture}")
    return [((a + b) / 2, -f * (b - a)) for a, b, f in zip(times, times[1:], forces[1:])]


def impulses(run):
    return [sum(push for _, push in pushes(juncture, run)) for juncture in range(1, 6)]


def blows(run):
    """(time, juncture, impulse) as of the reference: rows with a push that follow one another are one blow, its middle is its time."""
    found = []
    for juncture in range(1, 6):
        rows = []
        for t, push in [*pushes(juncture, run), (0.0, 0.0)]:
            if push > 1e-4 * MOMENTUM:
                rows.append((t, push))
            elif rows:
                total = sum(one for _, one in rows)
                found.append((sum(at * one for at, one in rows) / total, juncture, total))
                rows = []
    return sorted(found)


def first_of_each(found):
    return [next(((t, k) for t, k, _ in found if k == juncture), (float("nan"), juncture)) for juncture in range(1, 6)]


# ------------------------------------------------------------------------------------------------
# Measures: the worst of several

def worst(got, expected, scales):
    errors = [abs(a - b) / scale for a, b, scale in zip(got, expected, scales)]
    return Pair(float("nan") if len(got) != len(expected) or any(error != error for error in errors) else max(errors), 0, "", scale=1)


def velocities(case, e, change, scale=None):
    exact = EXACT[case, e]["speeds"]
    return lambda run: worst(speeds(of(case, change, run)), exact, [scale] * 6 if scale else exact)


def handed_on(case, e, change):
    exact = EXACT[case, e]["impulses"]
    return lambda run: worst(impulses(of(case, change, run)), exact, exact)


def times(case, e, change):
    """Of all blows; no number where they come in another order."""
    exact = EXACT[case, e]["blows"]

    def measure(run):
        found = blows(of(case, change, run))
        in_order = [k for _, k, _ in found] == [k for _, k, _ in exact]
        return worst([t for t, *_ in found] if in_order else [], [t for t, *_ in exact], [t for t, *_ in exact])
    return measure


def closures(case, e, change):
    """The first blow of each juncture."""
    exact = [t for t, _ in first_of_each(EXACT[case, e]["blows"])]
    return lambda run: worst([t for t, _ in first_of_each(blows(of(case, change, run)))], exact, exact)


def share_of(plate):
    exact = MASSES[plate - 1] * EXACT["case.yaml", 1]["speeds"][plate - 1]**2 / 2
    return lambda run: Pair(run.column(f"kinetic_{plate}")[-1] / ENERGY, exact / ENERGY, "", scale=1)


def total_momentum(run):
    return Pair(run.ledger("momentum")[2], MOMENTUM, "N s")


def total_energy(run):
    return Pair(run.ledger("kinetic"), ENERGY, "J")


def lost(e, change):
    """Energy that blows took, from what is left."""
    return lambda run: Pair(ENERGY - of("case.yaml", change, run).ledger("kinetic"), EXACT["case.yaml", e]["lost"], "J")


def impulse_of_slug(case, change):
    return lambda run: Pair(of(case, change, run).ledger("momentum")[2], PUSHED["force"] * PUSHED["pulse"] / 2, "N s")


STEP = "each blow lasts one step or two, in which both plates move together; a step is 2 % of the time of the first closure"

DEPARTURES = {"restitution": "blows that take energy are part of the claim; all other checks are of what is given back whole, by default"}

CHECKS = [
    Check("velocities of all plates over V", velocities("case.yaml", 1, {}, SPEED), 1e-6,
          "a blow gives back what it took: far below what any mistake makes"),
    Check("momentum through each juncture", handed_on("case.yaml", 1, {}), 1e-6, "as the velocities"),
    Check("energy of the first plate over that of the blow", share_of(1), 1e-6, "as the velocities"),
    Check("energy of the last plate over that of the blow", share_of(6), 1e-6, "as the velocities"),
    Check("times of all nine closures", times("case.yaml", 1, {}), 0.02, STEP),
    Check("momentum of all plates", total_momentum, 1e-12, "a contact gives what it takes: round-off"),
    Check("energy of all plates", total_energy, 1e-12, "blows give back what they took: round-off"),
    Check("restitution 0.5: velocities, each over its own", velocities("case.yaml", 0.5, HALF), 1e-6,
          "as with restitution 1"),
    Check("restitution 0.5: momentum through each juncture", handed_on("case.yaml", 0.5, HALF), 1e-6, "as the velocities"),
    Check("restitution 0.5: times of all nine closures", times("case.yaml", 0.5, HALF), 0.02, STEP),
    Check("restitution 0.5: energy that blows take", lost(0.5, HALF), 1e-6, "as the velocities"),
    Check("restitution 0: velocities, each over its own", velocities("case.yaml", 0, NONE), 1e-3,
          "plates that go on together touch in each of a thousand steps, and iterations end at a millionth of an impulse"),
    Check("restitution 0: momentum through each juncture", handed_on("case.yaml", 0, NONE), 1e-3, "as the velocities"),
    Check("restitution 0: first closure of each juncture", closures("case.yaml", 0, NONE), 1e-6,
          "they come after whole steps of 10 us, and rows on both sides have equal parts; iterations of the contact end at a millionth"),
    Check("restitution 0: energy that blows take", lost(0, NONE), 1e-9, "it is least where plates go on together, so its error is the "
          "square of that of the velocities, 3e-5"),
    Check("pushed: velocities of all plates over that of the pulse", velocities(SLUG, 1, {}, FULL_SPEED), 0.01,
          "the bound of the catalogue for impacts; the pulse lasts while the first blow does, so a step counts"),
    Check("pushed: times of all ten closures", times(SLUG, 1, {}), 0.02, STEP),
    Check("pushed: momentum of all plates", impulse_of_slug(SLUG, {}), 1e-12, "steps take the mean of a force that is linear: round-off"),
]


# ------------------------------------------------------------------------------------------------

def by_cells(run):
    rows = []
    for cells in (1, 2, 4):
        grid = {f"bodies[{i}].mesh.cells": f"[{cells}, {cells}, 1]" for i in range(6)}
        errors = [measure(run.again(grid)).error() for measure in
                  (velocities("case.yaml", 1, {}, SPEED), velocities("case.yaml", 0.5, HALF), velocities("case.yaml", 0, NONE),
                   handed_on("case.yaml", 0, NONE), closures("case.yaml", 0, NONE))]
        rows.append([f"{cells} x {cells}", *map(share, errors)])
    return rows


def by_steps(run):
    rows = []
    for step in (20, 10, 5):
        finer = {"time.largest_step": f"{step} us"}
        errors = [times("case.yaml", 1, finer)(run).error(), times("case.yaml", 0.5, {**HALF, **finer})(run).error(),
                  velocities("case.yaml", 0, {**NONE, **finer})(run).error(), velocities(SLUG, 1, finer, FULL_SPEED)(run).error()]
        rows.append([f"{step:g}", *map(share, errors)])
    return rows


STUDIES = [
    Falls("times of all nine closures", along="time.largest_step", values=["20 us", "10 us", "5 us"], order=0.5),
    Table("Worst error by the cells of each face; a face has a corner more along each side.",
          ["cells", "velocities over V", "restitution 0.5: velocities", "restitution 0: velocities", "restitution 0: momentum",
                        "restitution 0: closures"], by_cells),
    Table("Worst error by the step [us].", ["step", "times", "restitution 0.5: times", "restitution 0: velocities", "pushed: velocities"],
          by_steps),
]

LIGHT = {"bodies[2].material.density": "7700 kg/m^3"}
HIGH = {"bodies[1].move": "[0 m, 0 m, 55.5 mm]"}
MISSING = {"contacts[1].base": "plate_4.z_low", "time.overlap_limit": "2"}  # plates go through each other
HARD = {"contacts[0].restitution": 0.55}
GRAVITY = {"gravity": "[0 m/s^2, 0 m/s^2, -9.81 m/s^2]"}
LOSS = {"contacts[2].restitution": 0.99}
BREAKS = [
    Breaks("velocities of all plates over V", "a third plate that is 2 % too light", LIGHT),
    Breaks("velocities of all plates over V", "the third plate has no contact below: the second strikes the fourth", MISSING),
    Breaks("momentum through each juncture", "a third plate that is 2 % too light", LIGHT),
    Breaks("momentum through each juncture", "the third plate has no contact below: the second strikes the fourth", MISSING),
    Breaks("energy of the first plate over that of the blow", "a third plate that is 2 % too light", LIGHT),
    Breaks("energy of the last plate over that of the blow", "a third plate that is 2 % too light", LIGHT),
    Breaks("times of all nine closures", "the second plate half a millimetre too high", HIGH),
    Breaks("restitution 0.5: velocities, each over its own", "a third plate that is 2 % too light", LIGHT),
    Breaks("restitution 0.5: momentum through each juncture", "restitution 0.55 in the first juncture", HARD),
    Breaks("restitution 0.5: times of all nine closures", "the second plate half a millimetre too high", HIGH),
    Breaks("restitution 0.5: energy that blows take", "the third plate has no contact below: the second strikes the fourth", MISSING),
    Breaks("restitution 0: velocities, each over its own", "a third plate that is 2 % too light", LIGHT),
    Breaks("restitution 0: momentum through each juncture", "restitution 0.55 in the first juncture", HARD),
    Breaks("restitution 0: first closure of each juncture", "the second plate half a millimetre too high", HIGH),
    Breaks("restitution 0: energy that blows take", "the third plate has no contact below: the second strikes the fourth", MISSING),
    Breaks("pushed: velocities of all plates over that of the pulse", "the third plate has no contact below: the second strikes the fourth",
           MISSING),
    Breaks("pushed: times of all ten closures", "the second plate half a millimetre too high", HIGH),
    Breaks("pushed: momentum of all plates", "gravity left on", GRAVITY),
    Breaks("momentum of all plates", "gravity left on", GRAVITY),
    Breaks("energy of all plates", "restitution 0.99 in one juncture", LOSS),
]


# ------------------------------------------------------------------------------------------------

SHOWN = (1, 2, 6)


def over_time(case, e, change):
    def curves(run):
        run = of(case, change, run)
        return [(f"plate {i}", [1e3 * t for t in run.column("time")], run.column(f"speed_{i}")) for i in SHOWN]
    return curves


def exact_over_time(case, e):
    def curves(_):
        corners = EXACT[case, e]["history"]
        return [(f"exact, {i}", [1e3 * t for t, _ in corners], [v[i - 1] for _, v in corners]) for i in SHOWN]
    return curves


FIGURES = [
    Figure("struck", "time [ms]", "velocity [m/s]", over_time("case.yaml", 1, {}), exact=exact_over_time("case.yaml", 1), error=False,
           caption="Velocities of the first, second and last plate; the first strikes at 10 m/s, and the last keeps 82 % of its energy."),
    Figure("half", "time [ms]", "velocity [m/s]", over_time("case.yaml", 0.5, HALF), exact=exact_over_time("case.yaml", 0.5), error=False,
           caption="The same with restitution 0.5."),
    Figure("none", "time [ms]", "velocity [m/s]", over_time("case.yaml", 0, NONE), exact=exact_over_time("case.yaml", 0), error=False,
           caption="The same with restitution 0: plates that have met go on together."),
]
