"""How close is close enough, why, and what must break."""
import sys
from pathlib import Path

import twins
from compare_runs import Carry
from reference import SHIFT, turn
from verify import Breaks, Check, Figure, Pair, Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "invariance_scenes"))
import scenes  # noqa: E402

CLAIM = "A scene that is rotated and translated as a whole gives the same results, rotated and translated."
EVIDENCE = "invariant"
CATALOGUE = ()
DRIVER = "scene"
CASE = f"{scenes.FOLDER}/press.yaml"

Q = turn()


def turned(run, base, scene):
    tree = twins.moved(twins.tree_of(base), Q, SHIFT)
    return scenes.put_down(run, tree, f"turned_{scene}"), Carry(matrix=Q)


def same(scene):
    return lambda run: Pair(scenes.difference(run, scene, turned), 0, "", scale=1)


def disturbed(run, base, scene):
    """The scene itself with first velocities that are larger by 1e-12."""
    tree = twins.tree_of(base)
    for one in tree["initial"]:
        if "velocity" in one:
            one["velocity"] = twins.Texts([twins.times(text, 1 + 1e-12) for text in one["velocity"]], one["velocity"].dimension)
    return scenes.put_down(run, tree, f"disturbed_{scene}"), Carry()


DEPARTURES = {
    "area, damping_ratio, hourglass, hourglass_kind, integration, layers, method, passes, penalty, "
    "penalty_scale, rotary_inertia, tangential_penalty, viscosity, weights":
        "invariances must hold for every option, so these scenes use many at once"}

CHECKS = [Check(f"{scene}: turned and moved", same(scene), scenes.ROUND_OFF[scene], scenes.because(scene)) for scene in scenes.SCENES]

STUDIES = [
    Table("Turned and moved: the largest relative differences.", scenes.COLUMNS,
          lambda run: [scenes.summary_rows(run, scene, turned) for scene in scenes.SCENES], full=True),
    Table("How round-off grows: to what a change of the first velocities by 1e-12 comes, without any turn.", scenes.COLUMNS,
          lambda run: [scenes.summary_rows(run, scene, disturbed) for scene in scenes.SCENES], full=True),
]

BREAKS = [
    Breaks("strike: turned and moved", "a velocity that is not turned", {"initial[0].velocity": '["25", "4", "-30"]'}),
    Breaks("plates: turned and moved", "a gravity that is not turned", {"gravity": "[0 m/s^2, 3000 m/s^2, -9000 m/s^2]"}),
    Breaks("stack: turned and moved", "a gravity that is not turned", {"gravity": "[0 m/s^2, 0 m/s^2, -30000 m/s^2]"}),
    Breaks("press: turned and moved", "the normal of a moving plane that is not turned", {"planes[2].normal": "[0, 0, 1]"}),
    Breaks("splash: turned and moved", "a gravity that is not turned", {"gravity": "[1200 m/s^2, 500 m/s^2, -20000 m/s^2]"}),
    Breaks("ball: turned and moved", "a velocity turned the other way round: Q transposed",
           {"initial[0].velocity": '["{:.17g}", "{:.17g}", "{:.17g}"]'.format(*twins.product(twins.transposed(Q), (5, 2, -20)))}),
]


LABELS = (("strike", "block on slab"), ("plates", "sheet on dish"), ("stack", "hammer on stack"))


def plastic(ours):
    """The largest plastic strain over time, by the base or by the twin."""
    return lambda run: [(label if ours else "turned: " + label, *scenes.curve(run, scene, turned, "plastic_strain", ours))
                        for scene, label in LABELS]


FIGURES = [Figure("plastic_strain", "time [us]", "largest plastic strain [-]", plastic(ours=False), exact=plastic(ours=True),
                  caption="The largest plastic strain in three scenes turned and moved as a whole, over that of the scenes as they stand.")]
