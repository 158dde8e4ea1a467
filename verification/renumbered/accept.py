"""How close is close enough, why, and what must break."""
import sys
from pathlib import Path

import compare_runs
import mesh_files
import twins
from compare_runs import Carry
from reference import permutation
from verify import Breaks, Check, Falls, Figure, Pair, Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "invariance_scenes"))
import scenes  # noqa: E402

CLAIM = "The numbering of nodes, elements and hexahedron corners does not change results; that of triangle corners changes them little."
EVIDENCE = "invariant"
CATALOGUE = ()
DRIVER = "scene"
CASE = f"{scenes.FOLDER}/strike.yaml"


def renumbered(other_corners):
    def make(run, base, scene):
        nodes, cells = [], []

        def change(mesh, body):
            seed = sum(map(ord, body)) + len(nodes)
            new, of_node, of_cell = mesh_files.renumbered(mesh, lambda count: permutation(count, seed), other_corners)
            first_node, first_cell = len(nodes), len(cells)
            nodes.extend(first_node + i for i in of_node)
            cells.extend(first_cell + i for i in of_cell)
            return new

        label = f"renumbered{'_corners' if other_corners else ''}_{scene}"
        path = scenes.put_down(run, twins.tree_of(base), label, change=change)
        return path, Carry(nodes=nodes, cells=cells)
    return make


ORDERS, CORNERS = renumbered(False), renumbered(True)


def same(scene):
    return lambda run: Pair(scenes.difference(run, scene, ORDERS), 0, "", scale=1)


def nearly_same(run):
    """Of plates whose triangles are counted from other corners, both with the step that is asked for."""
    step = {key: value for key, value in run.overrides.items() if key == "contacts[0].energy_gain_limit"}
    base = run.other("scene", f"{scenes.FOLDER}/plates.yaml", step)
    path, carry = CORNERS(run, base, "plates")
    twin = run.other("scene", str(path), run.overrides)
    return Pair(compare_runs.largest(compare_runs.differences(base, twin, carry)), 0, "", scale=1)


FROM_OTHER_CORNERS = "plates: triangles counted from another corner"

DEPARTURES = {
    "area, damping_ratio, hourglass, hourglass_kind, integration, layers, method, passes, penalty, "
    "penalty_scale, rotary_inertia, tangential_penalty, viscosity, weights":
        "invariances must hold for every option, so these scenes use many at once"}

CHECKS = [
    *(Check(f"{scene}: other numbers", same(scene), scenes.ROUND_OFF[scene], scenes.because(scene)) for scene in scenes.FROM_FILES),
    Check(FROM_OTHER_CORNERS, nearly_same, 1e-7,
          "an element turns its stress against side 1-2 to the second order of the step (theory/plate.md); seen: 6e-9, "
          "falling with the square of the step"),
]

STUDIES = [
    Falls(FROM_OTHER_CORNERS, along="contacts[0].energy_gain_limit", values=[0.005, 0.00125, 0.0003125], order=1.5,
          sizes=[4, 2, 1], full=True),
    Table("Other numbers: the largest relative differences.", scenes.COLUMNS,
          lambda run: [scenes.summary_rows(run, scene, ORDERS) for scene in scenes.FROM_FILES], full=True),
]

BREAKS = [
    Breaks("strike: other numbers", "another step", {"contacts[0].energy_gain_limit": 0.004}),
    Breaks("stack: other numbers", "another tangential penalty", {"contacts[0].tangential_penalty": 0.5}),
    Breaks("press: other numbers", "another step", {"contacts[0].energy_gain_limit": 0.004}),
    Breaks("splash: other numbers", "another step", {"time.safety": 0.2}),
    Breaks("plates: other numbers", "another step", {"time.safety": 0.2}),
    Breaks(FROM_OTHER_CORNERS, "another step on one side", {"time.safety": 0.2}),
]


def mises(run, make, ours):
    """The largest stress of the dish [MPa] over time [us]."""
    times, values = scenes.curve(run, "plates", make, "mises", ours)
    return times, [1e-6 * v for v in values]


FIGURES = [Figure("mises", "time [us]", "largest stress in the dish [MPa]",
                  lambda run: [("other orders", *mises(run, ORDERS, False)), ("other corners too", *mises(run, CORNERS, False))],
                  exact=lambda run: [("as numbered", *mises(run, ORDERS, True))],
                  caption="A sheet drops on a dish, with nodes and elements in another order, and with triangles counted from "
                          "another corner too.")]
