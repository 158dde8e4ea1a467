"""How close is close enough, why, and what must break."""
from reference import blow, struck_twice
from verify import Breaks, Check, Figure, Pair, Report, created

CATALOGUE = ()
CLAIM = ("One automatic contact does what declared pairs do: plates touch from above, from below and at their rims, at half their "
         "thickness; a pair that is declared beside it is left to its declaration.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/automatic_contact/"
V = 10.0                                  # [m/s]
PLATE, BLOCK = 7850 * 0.1 * 0.1 * 0.002, 7850 * 0.01**3  # [kg]
ABOVE, BELOW = 7850 * 0.012**2 * 0.01, 7850 * 0.016**2 * 0.01
WHY = ("iterations end when one changes what the impulses do by less than 1e-5, which leaves up to 3e-7 of the momentum of a blow: "
       "that over the mass of {}")
BY_ROUND_OFF = "the blow goes through both centres, so all that touches has one rate and iterations end at round-off"
AS_DECLARED = 1e-4
HELD = "the iterations of the impulses begin with other rows and stop at 1e-6 of them, in each of a few hundred steps"


EXPECTED = struck_twice(PLATE, ABOVE, BELOW, V)


def plate(run):
    return Pair(run.column("plate_z")[-1] / PLATE, EXPECTED[0], "m/s", scale=V)


def above(run):
    return Pair(run.column("above_z")[-1] / ABOVE, EXPECTED[1], "m/s", scale=V)


def below(run):
    return Pair(run.column("below_z")[-1] / BELOW, EXPECTED[2], "m/s", scale=V)


def beside(run):
    return Pair(run.column("beside_x")[-1] / BLOCK, blow(BLOCK, -V, PLATE, 0.0)[0], "m/s", scale=V)


def first(run, name):
    column = run.column(name)
    return next((t for t, p in zip(run.column("time"), column) if p != column[0]), float("nan"))


def touches(name, way):
    """When a body that starts so far from half of the thickness changes its speed."""
    return lambda run: Pair(first(run, name), way / V, "s")


def meets(run):
    """The block from below has 1.5 mm to go to the plate, which comes to meet it when it has been struck from above."""
    struck, speed = 0.5e-3 / V, -blow(ABOVE, -V, PLATE, 0.0)[1]
    return Pair(first(run, "below_z"), (1.5e-3 + speed * struck) / (V + speed), "s")


def blocks(run, keys):
    return run.other("scene", HERE + "blocks.yaml", {**keys, **run.overrides})


PAIR = {"contacts[0].kind": "contact", "contacts[0].apexes": "upper.skin", "contacts[0].base": "lower.skin"}
ALONE = {"contacts[0].bodies": "[lower, upper]"}
PENALTY = {"contacts[0].method": "penalty"}
PASSES = {"contacts[0].passes": "two"}  # as an automatic penalty has
NO_EDGES = {"contacts[0].edges": "false"}
OVERLAP = {"bodies[1].move": "[0 mm, 0 mm, -0.11 mm]", "contacts[0].initial_penetration": "accept"}  # 0.01 mm deep, 0.4 % of a cell


def as_declared(name, keys={}):
    def measure(run):
        one = blocks(run, {**ALONE, **keys})
        other = run.other("scene", HERE + "blocks.yaml", {**PAIR, **keys, **(PASSES if keys == PENALTY else {})})
        return Pair(one.column(name)[-1], other.column(name)[-1], "kg m/s", scale=abs(other.column("upper_x")[0]))
    return measure


def not_twice(run):
    """A declared pair with an automatic contact of all, against one of the others alone."""
    one = run.other("scene", HERE + "declared.yaml", run.overrides)
    other = run.other("scene", HERE + "declared.yaml", {"contacts[1].bodies": "[upper, post]"})
    return Pair(one.column("lower_z")[-1], other.column("lower_z")[-1], "kg m/s")


def made(run):
    return created(blocks(run, {}))


def made_by_penalty(run):
    return created(blocks(run, PENALTY))


def written(run):
    return {path.relative_to(run.folder).as_posix(): path.read_bytes() for path in sorted(run.folder.rglob("*"))
            if path.suffix in (".csv", ".pvd", ".vtu", ".vtp")}


def threads(run):
    one, many = (written(run.other("scene", HERE + "blocks.yaml", keys, threads=n)) for n, keys in ((1, {}), (2, run.overrides)))
    return Pair(sum(one.get(name) != many.get(name) for name in {*one, *many}), 0, "files", scale=1)


DEPARTURES = {"passes": "an automatic contact by a penalty has two passes of each pair",
              "method": "the same by a penalty"}

CHECKS = [
    Check("speed of the plate after both blocks", plate, 8e-7, WHY.format("the plate")),
    Check("speed of the block from above", above, 6e-7, WHY.format("the block")),
    Check("speed of the block from below", below, 6e-6, WHY.format("the block")),
    Check("speed of the block at the rim", beside, 1e-9, BY_ROUND_OFF),
    Check("the block from above touches at half the thickness", touches("above_z", 0.5e-3), 0.03,
          "a row of the history is 2 % of the time"),
    Check("the block from below touches at half the thickness", meets, 0.02, "a row of the history is 1 % of the time"),
    Check("the block touches the rim at half the thickness", touches("beside_x", 0.2e-3), 0.06, "a row of the history is 5 % of the time"),
    *(Check(name, as_declared(*asked), AS_DECLARED, HELD, evidence="invariant") for name, asked in {
        "upper block as with a declared pair, along the friction": ("upper_x",),
        "upper block as with a declared pair, upwards": ("upper_z",),
        "by a penalty, as with a declared pair": ("upper_z", PENALTY),
        "without edges, as with a declared pair": ("upper_z", NO_EDGES),
        "from an accepted overlap, as with a declared pair": ("upper_z", OVERLAP)}.items()),
    Check("a declared pair is not counted twice", not_twice, 1e-12, "the same forces in the same order", evidence="invariant"),
    Check("created energy of elastic blocks", made, 1e-5,
          "iterations go on while contactors gain more than 1e-4 of what the impulses exchange: a tenth of that in all",
          evidence="invariant"),
    Report("created energy of elastic blocks by a penalty", made_by_penalty,
           "half of what the longest step makes that a case can ask for; the gate of all runs has it"),
    Check("two threads: files that differ from those of one", threads, 0, "sums have one order whatever the threads",
          evidence="invariant"),
]

BREAKS = [
    Breaks("speed of the plate after both blocks", "restitution 0.9", {"contacts[0].restitution": "0.9"}),
    Breaks("speed of the block at the rim", "restitution 0.9", {"contacts[0].restitution": "0.9"}),
    Breaks("the block from above touches at half the thickness", "a plate a fifth thicker", {"bodies[0].element.thickness": "2.4 mm"}),
    Breaks("upper block as with a declared pair, along the friction", "less friction", {"contacts[0].friction": "0.1"}),
    Breaks("speed of the block from above", "restitution 0.9", {"contacts[0].restitution": "0.9"}, full=True),
    Breaks("speed of the block from below", "restitution 0.9", {"contacts[0].restitution": "0.9"}, full=True),
    Breaks("the block from below touches at half the thickness", "a plate a fifth thicker", {"bodies[0].element.thickness": "2.4 mm"},
           full=True),
    Breaks("the block touches the rim at half the thickness", "a plate a tenth thicker", {"bodies[0].element.thickness": "2.2 mm"},
           full=True),
    Breaks("upper block as with a declared pair, upwards", "nodes that give nothing back", {"contacts[0].restitution": 0}, full=True),
    Breaks("by a penalty, as with a declared pair", "half the penalty", {"contacts[0].penalty_scale": 10}, full=True),
    Breaks("without edges, as with a declared pair", "less friction", {"contacts[0].friction": "0.1"}, full=True),
    Breaks("from an accepted overlap, as with a declared pair", "nodes that give nothing back", {"contacts[0].restitution": 0}, full=True),
    Breaks("a declared pair is not counted twice", "another friction of the pair", {"contacts[0].friction": 0.29}, full=True),
    Breaks("created energy of elastic blocks", "a penalty at the longest step that a case can ask for",
           {"contacts[0].method": "penalty", "contacts[0].energy_gain_limit": 0.04}, full=True),
    Breaks("two threads: files that differ from those of one", "another friction with two threads", {"contacts[0].friction": 0.29},
           full=True),
]


def momenta(run):
    return [(name, [1e3 * t for t in run.column("time")], run.column(column))
            for name, column in (("plate, z", "plate_z"), ("block from above, z", "above_z"), ("block from below, z", "below_z"),
                                 ("block, x", "beside_x"))]


FIGURES = [Figure("momenta", "time [ms]", "momentum [kg m/s]", momenta,
                  caption="Momenta: the block at the rim strikes first, then the block from above, then that from below.")]
