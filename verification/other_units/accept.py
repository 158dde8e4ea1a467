"""How close is close enough, why, and what must break."""
import sys
from pathlib import Path

import twins
from compare_runs import Carry
from mesh_files import Mesh
from reference import ANY, INCH, POUND_FORCE, STANDARD_GRAVITY, TWOS
from verify import Breaks, Check, Figure, Pair, Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "invariance_scenes"))
import scenes  # noqa: E402

CLAIM = "A scene in other units or at another scale gives the same results in its own units."
EVIDENCE = "invariant"
CATALOGUE = ()
DRIVER = "scene"
CASE = f"{scenes.FOLDER}/ball.yaml"

TECHNICAL = twins.System(("mm", 1e-3), ("kgf", STANDARD_GRAVITY), ("s", 1))
INCHES = twins.System(("in", INCH), ("lbf", POUND_FORCE), ("s", 1))


def written_in(name, system):
    def make(run, base, scene):
        return scenes.put_down(run, twins.tree_of(base), f"{name}_{scene}", system=system), Carry()
    return make


def grown(name, scale):
    def make(run, base, scene):
        def larger(mesh, _):
            return Mesh([[scale[0] * x for x in point] for point in mesh.points], mesh.cells, mesh.sets)
        tree = twins.scaled(twins.tree_of(base), scale)
        return scenes.put_down(run, tree, f"{name}_{scene}", change=larger), Carry(scale=scale)
    return make


MAKE = {"kgf": written_in("kgf", TECHNICAL), "lbf": written_in("lbf", INCHES), "twos": grown("twos", TWOS), "any": grown("any", ANY)}


def same(scene, which):
    return lambda run: Pair(scenes.difference(run, scene, MAKE[which]), 0, "", scale=1)


DEPARTURES = {
    "area, damping_ratio, hourglass, hourglass_kind, integration, layers, method, passes, penalty, "
    "penalty_scale, rotary_inertia, tangential_penalty, viscosity, weights":
        "invariances must hold for every option, so these scenes use many at once"}

CHECKS = [
    *(Check(f"{scene}: sizes, masses and times by powers of two", same(scene, "twos"), 0,
            "the same bits: such factors are exact, so any length, mass or time that is written into the code shows")
      for scene in scenes.SCENES),
    *(Check(f"{scene}: in kgf, mm, s", same(scene, "kgf"), scenes.ROUND_OFF[scene], scenes.because(scene), full=full)
      for scene, full in (("strike", False), ("plates", True))),
    *(Check(f"{scene}: in lbf, in, s", same(scene, "lbf"), scenes.ROUND_OFF[scene], scenes.because(scene), full=full)
      for scene, full in (("stack", False), ("ball", True))),
    Check("press: 0.137 as large, 31.7 as heavy, 2.71 as slow", same("press", "any"), scenes.ROUND_OFF["press"], scenes.because("press")),
]

STUDIES = [
    Table(f"All scenes {title}: the largest relative differences.", scenes.COLUMNS,
          lambda run, which=which: [scenes.summary_rows(run, scene, MAKE[which]) for scene in scenes.SCENES], full=True)
    for which, title in (("kgf", "in kgf, mm, s"), ("lbf", "in lbf, in, s"), ("any", "0.137 as large, 31.7 as heavy, 2.71 as slow"))
]

BREAKS = [
    Breaks("strike: in kgf, mm, s", "a gravity of mm/s² taken for m/s²", {"gravity": "[1200 mm/s^2, 500 mm/s^2, -20000 mm/s^2]"}),
    Breaks("plates: in kgf, mm, s", "a penalty in kgf/mm³ taken for N/mm³", {"contacts[0].penalty": "2039.432426 N/mm^3"},
           full=True),
    Breaks("stack: in lbf, in, s", "a density in pounds mass where force over gravity is meant, 386 times too large",
           {"bodies[0].material.density": "0.0975437 lbf*s^2*in^-4"}),
    Breaks("ball: in lbf, in, s", "a speed in in/s that is divided by twelve once more",
           {"initial[0].velocity": '["5/0.0254/12", "2/0.0254/12", "-20/0.0254/12"]'}, full=True),
    Breaks("press: 0.137 as large, 31.7 as heavy, 2.71 as slow", "a clearance that keeps its size",
           {"contacts[0].clearance": "0.02 mm"}),
    Breaks("strike: sizes, masses and times by powers of two", "a yield stress that keeps its number",
           {"bodies[1].material.yield": "60 MPa"}),
    Breaks("plates: sizes, masses and times by powers of two", "a penalty that keeps its number",
           {"contacts[0].penalty": "2e13 Pa/m"}),
    Breaks("stack: sizes, masses and times by powers of two", "a gravity that keeps its number",
           {"gravity": "[0 m/s^2, 0 m/s^2, -30000 m/s^2]"}),
    Breaks("press: sizes, masses and times by powers of two", "a clearance that keeps its size",
           {"contacts[0].clearance": "0.02 mm"}),
    Breaks("splash: sizes, masses and times by powers of two", "a gravity that keeps its number",
           {"gravity": "[1200 m/s^2, 500 m/s^2, -20000 m/s^2]"}),
    Breaks("ball: sizes, masses and times by powers of two", "a gravity that keeps its number",
           {"gravity": "[0 m/s^2, 0 m/s^2, -9.81 m/s^2]"}),
]


def forces(ours):
    """By the base or by the twin."""
    return lambda run: [("the scene itself" if ours else "carried back", *scenes.curve(run, "press", MAKE["any"], "force", ours))]


FIGURES = [Figure("force", "time [us]", "contact force [N]", forces(ours=False), exact=forces(ours=True),
                  caption="The contact force of a scene 0.137 as large, 31.7 as heavy and 2.71 as slow, carried back, "
                          "over that of the scene itself.")]
