"""How close is close enough, why, and what must break."""
from reference import window
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("C-11",)
CLAIM = ("A die dragged along an elastic slab has no drag without friction, and with it that of Coulomb's law; how its force oscillates is "
         "reported by formulation.")
EVIDENCE = "invariant"
DRIVER = "scene"

FRICTION = 0.3
BEGIN, END = window(1e-3, 2e-3, 2)   # the way over two cells of the slab, at the full speed [m]

CONTACT = "contacts[0]"
RUBS = {f"{CONTACT}.friction": FRICTION}
TWO = {f"{CONTACT}.passes": "two"}
DAMPED = {f"{CONTACT}.method": "penalty", f"{CONTACT}.damping_ratio": 0.1}
EXCHANGED = {f"{CONTACT}.apexes": "slab.z_high", f"{CONTACT}.base": "die.z_low"}
ROLLING = "verification/ironing/rolling.yaml"


def rows(run, *names):
    """Columns between the two ends of the way, each a list."""
    inside = [i for i, way in enumerate(run.column("way")) if BEGIN <= way <= END]
    return [[run.column(name)[i] for i in inside] for name in names]


def mean(values):
    return sum(values) / len(values)


def oscillation(run, name, over):
    """Half of what lies between the least and the largest value on the way, over the mean of another. [-]"""
    values, others = rows(run, name, over)
    return (max(values) - min(values)) / 2 / abs(mean(others))


def drag(run):
    """Mean force along over the mean force across, without friction."""
    along, down = rows(run, "along", "down")
    return Pair(mean(along) / abs(mean(down)), 0, "", 1)


def ratio(run):
    along, down = rows(run.again(RUBS), "along", "down")
    return Pair(mean(along) / abs(mean(down)), FRICTION)


def two_over_one(run):
    return Pair(mean(rows(run.again(TWO), "down")[0]) / mean(rows(run, "down")[0]), 1)


def reaches_end(run):
    exchanged = run.again(EXCHANGED)
    return Pair(exchanged.column("time")[-1], exchanged.case("time.end"), "s")


def of(change, name):
    return lambda run: Pair(oscillation(run.again(change), name, "down"), 0, "", 1)


WHY = "the catalogue has no number: half of the range over the mean push, over two cells"

CHECKS = [
    Check("drag without friction, over the push", drag, 0.01, "nothing dissipates but viscosity and the waves that the speed makes"),
    Check("drag over push with friction", ratio, 0.03, "all of the sole slides; the pressures on its two slopes differ a little"),
    Report("push of two passes over that of one", two_over_one,
           "both are as stiff; with one pass nodes of the slab between apexes are free"),
    Report("oscillation of the push", of({}, "down"), WHY),
    Report("oscillation of the drag", of({}, "along"), WHY),
    Report("oscillation of the push, two passes", of(TWO, "down"), WHY),
    Report("oscillation of the drag, two passes", of(TWO, "along"), WHY),
    Report("oscillation of the push, friction", of(RUBS, "down"), WHY),
    Report("oscillation of the drag, friction", of(RUBS, "along"), WHY),
    Report("end of the run, sides exchanged", reaches_end, "a user may exchange the sides"),
]

FORMULATIONS = [("one pass", {}), ("two passes", TWO), ("one pass, damping 0.1", DAMPED), ("one pass, friction 0.3", RUBS),
                ("two passes, friction 0.3", {**RUBS, **TWO}), ("one pass, friction 0.3, damping 0.1", {**RUBS, **DAMPED}),
                ("sides exchanged", EXCHANGED), ("sides exchanged, friction 0.3", {**EXCHANGED, **RUBS}),
                ("sides exchanged, elements of eight points in the die", {**EXCHANGED, "bodies[1].element.kind": "full"}),
                ("one pass, elements of eight points in the die", {"bodies[1].element.kind": "full"})]


def of_each(run, formulations, another=None):
    found = []
    for name, change in formulations:
        one = run.other(DRIVER, another, change) if another else run.again(change)
        if one.ending == "reached_end":
            down, along = rows(one, "down", "along")
            found.append([name, f"{-mean(down):.1f}", f"{100 * oscillation(one, 'down', 'down'):.1f} %", f"{mean(along):.2f}",
                          f"{100 * oscillation(one, 'along', 'down'):.1f} %", one.ending])
        else:
            found.append([name, "", "", "", "", f"{one.ending} at {1e3 * one.column('time')[-1]:.3g} ms"])
    return found


def growth(run):
    """Half of the range of the push over its mean, for each cell of the slab on a longer way."""
    found = []
    for name, change in (("one pass", {}), ("friction 0.1", {f"{CONTACT}.friction": 0.1}), ("friction 0.3", RUBS),
                         ("friction 0.3, damping 0.1", {**RUBS, **DAMPED}),
                         ("friction 0.3, linear viscosity of the slab 0.3", {**RUBS, "bodies[0].element.viscosity.linear": 0.3})):
        one = run.again({**change, "time.end": "3.1 ms"})
        cells = [[f for way, f in zip(one.column("way"), one.column("down")) if low <= way < low + 2e-3] for low in (1e-3, 3e-3, 5e-3)]
        found.append([name, *(f"{100 * (max(cell) - min(cell)) / 2 / abs(mean(cell)):.1f} %" for cell in cells)])
    return found


COLUMNS = ["formulation", "push [N]", "oscillation of the push", "drag [N]", "oscillation of the drag, over the push", "ended"]
STUDIES = [
    Table("The die, by formulation.", COLUMNS, lambda run: of_each(run, FORMULATIONS), full=True),
    Table("A stiff cylinder that rolls, by formulation.", COLUMNS, lambda run: of_each(run, [
        ("one pass", {}), ("two passes", TWO), ("sides exchanged", {f"{CONTACT}.apexes": "slab.z_high", f"{CONTACT}.base": "die.side"}),
        ("one pass, friction 0.3", RUBS)], ROLLING), full=True),
    Table("Oscillation of the push on the die, from cell to cell.", ["formulation", "1 to 3 mm", "3 to 5 mm", "5 to 7 mm"], growth,
          full=True),
]


BREAKS = [
    Breaks("drag without friction, over the push", "friction that nobody asked for", {f"{CONTACT}.friction": 0.02}),
    Breaks("drag over push with friction", "a stick ten thousand times too soft", {f"{CONTACT}.method": "penalty",
                                                                                   f"{CONTACT}.tangential_penalty": 1e-4}),
]


def forces(name, sign):
    """Over the way, once the die is fully pressed in and under way."""
    def measure(run):
        found = []
        for title, change in (("one pass", {}), ("two passes", TWO), ("one pass, friction 0.3", RUBS)):
            one = run.again(change)
            points = [(1e3 * way, sign * force) for way, force in zip(one.column("way"), one.column(name)) if way > 3e-4]
            found.append((title, [way for way, _ in points], [force for _, force in points]))
        return found
    return measure


FIGURES = [
    Figure("push", "way [mm]", "push on the die [N]", forces("down", -1), error=False,
           caption="Push on a die that is dragged along a slab."),
    Figure("drag", "way [mm]", "drag [N]", forces("along", 1), error=False, caption="Drag of the die."),
]
