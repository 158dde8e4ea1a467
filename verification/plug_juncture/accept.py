"""How close is close enough, why, and what must break."""
import importlib.util
from pathlib import Path

from reference import (GAP, HELD, PULSE, acceleration_of_lowest, closing_time, force, impulse, impulse_on_plate, mass,
                       masses)
from verify import Breaks, Check, Figure, Pair, created

CATALOGUE = ()
CLAIM = ("Three plugs in a reactor's head hand on exactly the momentum that a pressure gives the first; it closes its gap as a rigid plug "
         "does, and a sector is the quarter's part. Shield plates below it hand on what the pressure gives them.")
EVIDENCE = "invariant"
DRIVER = "plug_juncture"
CASE = "cases/plug_juncture/slug.yaml"
CELLS = 48   # around the whole turn, at level 2
HIGHER = '1.001*table("slug.csv", t)'
SLOPPY = {"mesh.level": 1, "contact.method": "penalty", "contact.penalty_scale": 0.5, "contact.step_factor": 0.5,
          "contact.energy_gain_limit": 0.04}
PLUGS = ("small", "intermediate", "large")
END = 0.02   # [s]


def closes(run):
    return Pair(run.result("closes_1"), closing_time(force(CELLS) / mass(CELLS)), "s")


def given(run):
    """What the plugs have at the end and what the flange took, over the impulse of the pressure."""
    kept = sum(run.result(f"momentum_{plug}") for plug in PLUGS)
    return Pair(kept + run.result("impulse_3"), impulse(CELLS), "N s")


def small_plug(run):
    """The small plug has what the pressure gave it less what the first juncture handed on."""
    return Pair(run.result("momentum_small"), impulse(CELLS) - run.result("impulse_1"), "N s", scale=impulse(CELLS))


def quarter(run):
    other = run.other(run.driver, CASE, {"model.kind": "quarter"})
    names = [f"{what}_{k}" for what in ("closes", "impulse", "peak_force") for k in (1, 2, 3)]
    return Pair(max(abs(other.result(name) / run.result(name) - 1) for name in names), 0, "", scale=1)


# ------------------------------------------------------------------------------------------------
# Rigid plugs

RIGID = {"model.kind": "full", "model.rigid": "true", "mesh.level": 1}
RIGID_CELLS = 24
CHAINS = Path(__file__).resolve().parent.parent / "rigid_chain/reference.py"  # by its path: this folder has a reference.py, too
FOUND = importlib.util.spec_from_file_location("rigid_chain_reference", CHAINS)
rigid_chain = importlib.util.module_from_spec(FOUND)
FOUND.loader.exec_module(rigid_chain)


def rigid_plugs(cells, end):
    """Rigid plugs below a flange that is held: a chain of blows as of masses. A dictionary as of chain()."""
    return rigid_chain.chain([*masses(cells), HELD], [GAP] * 3, end, force=force(cells), pulse=PULSE)


def of_rigid_plugs(names, exact):
    """The worst of some results of rigid plugs, each over its own exact value."""
    def measure(run):
        one, expected = run.again({**RIGID, **run.overrides}), exact(rigid_plugs(RIGID_CELLS, END))
        return Pair(max(abs(one.result(name) / value - 1) for name, value in zip(names, expected)), 0, "", scale=1)
    return measure


def first_blows(found):
    return [next(t for t, k, _ in found["blows"] if k == juncture) for juncture in (1, 2, 3)]


# ------------------------------------------------------------------------------------------------
# Shield plates below the plugs

HEAD = "cases/plug_juncture/head.yaml"
PLATES = [f"plate_{k}" for k in range(1, 7)]


def head(run):
    return run.other(DRIVER, HEAD, run.overrides)


def head_closes(run):
    return Pair(head(run).result("closes_plate_1"), closing_time(acceleration_of_lowest()), "s")


def head_given(run):
    """What plates and plugs have at the end and what the flange took, over the impulse of the pressure."""
    one = head(run)
    kept = sum(one.result(f"momentum_{body}") for body in [*PLATES, *PLUGS])
    return Pair(kept + one.result("impulse_3"), impulse_on_plate(CELLS), "N s")


BLOW = "a step is 1 % of the first time; a blow lasts two steps, in which the pressure gives 0.4 % of its impulse"

CHECKS = [
    Check("closing of the first gap", closes, 0.005,
          "a step is 0.2 % of the time, and as the plug rings its shoulder is 0.2 % of the gap behind or ahead of the mean"),
    Check("momentum of plugs and flange", given, 1e-4,
          "the pressure acts on the surface as it is, whose area changes by strains of some 1e-5; all else is round-off"),
    Check("momentum of the small plug", small_plug, 1e-4, "the same, of one body; without friction only its ledge takes anything along z"),
    Check("quarter against sector", quarter, 1e-6, "the same polygons, turned: round-off, which grows with every strike"),
    Check("rigid plugs: first closure of each juncture", of_rigid_plugs([f"closes_{k}" for k in (1, 2, 3)], first_blows), 0.01, BLOW),
    Check("rigid plugs: momentum through each juncture", of_rigid_plugs([f"impulse_{k}" for k in (1, 2, 3)], lambda one: one["impulses"]),
          0.004, BLOW),
    Check("rigid plugs: velocities at the end", of_rigid_plugs([f"velocity_{plug}" for plug in PLUGS], lambda one: one["speeds"]), 0.01,
          "what is handed on, less what was had: the same error counts two and a half times"),
    Check("with shield plates: closing of the first gap", head_closes, 0.015,
          "a step is 0.3 % of the time; the plate bends a little, as wedge-shaped cells share mass and pressure otherwise among their "
          "nodes: at levels 1, 2, 4 it is 1.5, 0.9, 0.4 % early"),
    Check("with shield plates: momentum of all", head_given, 1e-4,
          "as above: the pressure acts on the surface as it is, whose area changes by strains"),
    Check("created energy", created, 1e-6, "multipliers create nothing; their iterations end at a millionth of what is exchanged"),
]


BREAKS = [
    Breaks("closing of the first gap", "gaps a fiftieth wider", {"head.axial_gap": "5.1 mm"}),
    Breaks("momentum of plugs and flange", "a pressure a thousandth higher", {"struck_by.value": HIGHER}),
    Breaks("momentum of the small plug", "a pressure a thousandth higher", {"struck_by.value": HIGHER}),
    Breaks("quarter against sector", "a pressure a thousandth higher in one of both", {"struck_by.value": HIGHER}),
    Breaks("rigid plugs: first closure of each juncture", "gaps a fiftieth wider", {"head.axial_gap": "5.1 mm"}),
    Breaks("rigid plugs: momentum through each juncture", "a shoulder a tenth wider", {"head.ledge_width": "0.11 m"}),
    Breaks("rigid plugs: velocities at the end", "restitution 0.95", {"contact.restitution": 0.95}),
    Breaks("with shield plates: closing of the first gap", "steel a tenth denser", {"material.density": "8635 kg/m^3"}),
    Breaks("with shield plates: momentum of all", "a pressure a thousandth higher", {"struck_by.value": HIGHER}),
    Breaks("created energy", "a soft penalty that samples coarsely", SLOPPY),
]


def forces(run):
    return [(f"juncture {k}", [1e3 * t for t in run.column("time")], [-1e-6 * f for f in run.column(f"force_{k}")]) for k in (1, 2, 3)]


FIGURES = [Figure("forces", "time [ms]", "force of the sector [MN]", forces,
                  caption="Forces that the ledges of a sector carry, means over 20 us.")]
