"""How close is close enough, why, and what must break."""
import sys
from pathlib import Path

import mesh_files
import twins
from compare_runs import Carry
from reference import mirror
from verify import Breaks, Check, Figure, Pair, Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "invariance_scenes"))
import scenes  # noqa: E402

CLAIM = "A mirrored scene gives mirrored results."
EVIDENCE = "invariant"
CATALOGUE = ()
DRIVER = "scene"
CASE = f"{scenes.FOLDER}/plates.yaml"

M = mirror()


def mirrored(run, base, scene):
    tree = twins.moved(twins.tree_of(base), M, (0, 0, 0))
    path = scenes.put_down(run, tree, f"mirrored_{scene}", change=lambda mesh, _: mesh_files.mirrored(mesh))
    return path, Carry(matrix=M)


def same(scene):
    return lambda run: Pair(scenes.difference(run, scene, mirrored), 0, "", scale=1)


DEPARTURES = {
    "area, damping_ratio, hourglass, hourglass_kind, integration, layers, method, passes, penalty, "
    "penalty_scale, rotary_inertia, tangential_penalty, viscosity, weights":
        "invariances must hold for every option, so these scenes use many at once"}

CHECKS = [Check(f"{scene}: in the mirror", same(scene), scenes.ROUND_OFF[scene], scenes.because(scene)) for scene in scenes.FROM_FILES]

STUDIES = [Table("In the mirror: the largest relative differences.", scenes.COLUMNS,
                 lambda run: [scenes.summary_rows(run, scene, mirrored) for scene in scenes.FROM_FILES], full=True)]



BREAKS = [
    Breaks("strike: in the mirror", "a velocity that is not mirrored", {"initial[0].velocity": '["25", "4", "-30"]'}),
    Breaks("plates: in the mirror", "a moment mirrored as if it were a force",
           {"loads[1].value": '["{:.17g}", "{:.17g}", "0.05 * cos(4e4*t)"]'.format(*twins.product(M, (0.1, 0.02, 0)))}),
    Breaks("stack: in the mirror", "the normal of a rigid plane that is not mirrored", {"planes[0].normal": "[0.02, -0.01, 1]"}),
    Breaks("splash: in the mirror", "a velocity that is not mirrored", {"initial[0].velocity": '["25", "4", "-60"]'}),
    Breaks("press: in the mirror", "an initial field that is not mirrored", {"initial[0].velocity": '["40*x", "45*y", "0"]'}),
]


LABELS = (("strike", "block on slab"), ("plates", "sheet on dish"), ("stack", "hammer on stack"))


def speeds(ours):
    """Speeds of what falls, by the base or by the twin."""
    return lambda run: [(label if ours else "mirrored: " + label, *scenes.curve(run, scene, mirrored, "speed", ours))
                        for scene, label in LABELS]


FIGURES = [Figure("speed", "time [us]", "speed of what strikes [m/s]", speeds(ours=False), exact=speeds(ours=True),
                  caption="The speed of what strikes in three scenes seen in a mirror, over that of the scenes themselves.")]
