"""How close is close enough, why, and what must break."""
from reference import HARD_PENALTY, steps_of_elements
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ()
CLAIM = ("Contact as it is by default asks for no step of its own, creates nothing and loses nothing at first touch, in scenes of solids, "
         "plates, rigid planes and friction.")
EVIDENCE = "invariant"
DRIVER = "scene"
CASE = "verification/oblique_impact/case.yaml"

QUARTER = {"model.kind": "quarter", "mesh.level": 2}
# program, case, changes, contact that is looked at, and its section in the case
OTHERS = {"two bars": ("two_blocks", "cases/two_blocks/bars.yaml", {}, "contact", "contact"),
          "Taylor's bar": ("scene", "cases/scene/taylor_bar.yaml", {}, "wall", "planes[2]"),
          "ball on a plate": ("scene", "cases/scene/ball_on_plate.yaml", {}, "touch", "contacts[0]"),
          "block that slides": ("sliding", "cases/sliding/stop.yaml", {}, "contact", "contact"),
          "cask, level 2": ("cask_drop", "cases/cask_drop/neptune.yaml", QUARTER, "interface", "interface")}
# scenes whose elements keep their step, and how their bodies never meet
APART = {"oblique impact": {"bodies[1].move": "[6 mm, -4 mm, 500 mm]"}, "two bars": {"blocks.gap": "1 m"},
         "ball on a plate": {"bodies[0].move": "[0 mm, 0 mm, 500 mm]"}}


def scene(run, name, change=None):
    """A run of the scene and the account of its contact; of the case itself with what a break changes."""
    if name == "oblique impact":
        one = run.again(change or {})
        return one, one.account("interface")
    driver, case, more, contact, section = OTHERS[name]
    one = run.other(driver, case, {**more, **{f"{section}.{key.split('.', 1)[1]}": value for key, value in (change or {}).items()}})
    return one, one.account(contact)


def steps(name):
    """Steps over those of the longest step of the same bodies where they never meet."""
    def measure(run):
        one, _ = scene(run, name)
        driver, case, *_ = OTHERS.get(name, (DRIVER, CASE))
        alone = steps_of_elements(one.column("time")[-1], run.other(driver, case, APART[name]).result("largest_step"))
        return Pair(one.summary["cost"]["steps"], alone, scale=alone)
    return measure


def made(name):
    """The most that the contact had created at any row, over the energy that the scene began with."""
    def measure(run):
        one, _ = scene(run, name)
        contact = OTHERS[name][3] if name in OTHERS else "interface"
        return Pair(max(abs(value) for value in one.column(f"energy_created_{contact}")), 0, "J", scale=one.ledger("initial_kinetic"))
    return measure


def lost(name):
    def measure(run):
        one, account = scene(run, name)
        return Pair(account["dissipated"].get("inelastic_impact", {"value": 0.0})["value"], 0, "J", scale=one.ledger("initial_kinetic"))
    return measure


ALL = ("oblique impact", *OTHERS)
DEPARTURES = {"viscosity": "the two bars are those of two_blocks, whose exact solution has none"}

CHECKS = [
    *(Check(f"{name}: steps beside those of the elements", steps(name), 0.1, "the step grows by a twentieth or more, and ends evenly")
      for name in APART),
    *(Check(f"{name}: created by the contact", made(name), 1e-6, "a thousandth of what would matter, and far above what is seen")
      for name in ALL),
    *(Check(f"{name}: lost at first touch", lost(name), 5e-3, "what is taken from nodes that are stopped is given back as they part")
      for name in ALL),
    Report("cask, level 2: settlement beside that of a penalty scale of 2000",
           lambda run: Pair(scene(run, "cask, level 2")[0].result("settlement_mean"), HARD_PENALTY, "m"),
           "a hundred times the usual penalty, on the same mesh"),
]


def beside_a_penalty(run):
    rows = []
    for name in ALL:
        one, account = scene(run, name)
        row = [name, str(one.summary["cost"]["steps"])]
        if name == "ball on a plate":
            row.append("603744")
        else:
            row.append(str(scene(run, name, {"contacts[0].method": "penalty"})[0].summary["cost"]["steps"]))
        scale = one.ledger("initial_kinetic")
        rows.append([*row, f"{account['created']['value'] / scale:.0e}",
                     f"{account['dissipated'].get('inelastic_impact', {'value': 0.0})['value'] / scale:.0e}"])
    return rows


STUDIES = [Table("Steps by default and by the usual penalty, and the energy that the contact by default created and lost over that of the "
                 "start.", ["scene", "steps", "by a penalty", "created", "lost"], beside_a_penalty, full=True)]

BREAKS = [
    Breaks("oblique impact: steps beside those of the elements", "the usual penalty", {"contacts[0].method": "penalty"}),
    Breaks("oblique impact: created by the contact", "a penalty at the longest step that a case can ask for",
           {"contacts[0].method": "penalty", "contacts[0].energy_gain_limit": 0.04}),
    Breaks("oblique impact: lost at first touch", "nodes that give nothing back", {"contacts[0].restitution": 0}),
]


def stores(run):
    scale = run.ledger("initial_kinetic")
    return [(name, [1e6 * t for t in run.column("time")], [v / scale for v in run.column(column)])
            for name, column in (("held by the contact", "energy_interface_restitution"),
                                 ("taken by friction", "energy_interface_friction"),
                                 ("created by the contact", "energy_created_interface"))]


def nothing(run):
    return [("nothing created", [0, 1e6 * run.column("time")[-1]], [0, 0])]


FIGURES = [Figure("energy", "time [us]", "energy over that of the start [-]", stores, exact=nothing, error=False,
                  caption="Oblique impact: what the contact holds of what it took as nodes were stopped, and what friction took.")]
