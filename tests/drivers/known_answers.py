"""Scenes that users found to end wrong, with the answer that mechanics gives.

    python3 tests/drivers/known_answers.py DRIVERS                  DRIVERS: the folder with the programs
    python3 tests/drivers/known_answers.py DRIVERS rim pipes        scenes of these names alone
    python3 tests/drivers/known_answers.py DRIVERS --open           scenes that still end wrong, with what is wrong about them

A scene is a function that returns a dict, as in right_runs.py, and a row of SCENES. The row has the answers, each with a tolerance and its
reason. A run must reach its end and print nothing but what the row allows. A scene that ends wrong is a row of OPEN until it ends right.
Other such scenes: friction, ties and a press fit that relax, and stacks at rest in right_runs.py; bodies that slide, pass each other, or
slide from floor to floor in verification/automatic_sliding; mirror images in right_runs.py and in verification/mirrored.
"""
import sys
import unittest
from dataclasses import dataclass
from math import cos, hypot, pi
from pathlib import Path
from typing import Callable

import right_runs
from right_runs import DOWN, Run, box, lengths

SWING = "time integration: the staggering error of the kinetic energy reached "  # undamped bodies of few elements


# ------------------------------------------------------------------------------------------------ parts of scenes

def material(density=1000.0, young="10 MPa", **plastic):
    kind = "j2_bilinear" if plastic else "elastic"
    return {"kind": kind, "density": f"{density!r} kg/m^3", "young": young, "poisson": 0.3, **plastic}


def steel():
    return material(7850.0, "210 GPa", **{"yield": "300 MPa", "tangent": "1 GPa"})


def plate(name, mesh, thickness, stuff, thinning="by_law", **more):
    return {"name": name, "mesh": mesh, "material": stuff, "element": {"thickness": f"{thickness!r} m", "thinning": thinning}, **more}


def automatic(friction, **more):
    return [{"name": "touch", "kind": "automatic", "friction": friction, **more}]


def fixed(*nodes):
    return {"name": "hold", "kind": "fixed", "nodes": list(nodes)}


def thrown(body, velocity, spin=(0, 0, 0), about=(0, 0, 0)):
    """The velocity of a rigid motion: `velocity` [m/s] at the place `about` [m], and `spin` [rad/s]."""
    (u, v, w), (p, q, r), (x, y, z) = velocity, spin, (f"({axis}-{at!r})" for axis, at in zip("xyz", about))
    terms = [f"{u!r}+{q!r}*{z}-{r!r}*{y}", f"{v!r}+{r!r}*{x}-{p!r}*{z}", f"{w!r}+{p!r}*{y}-{q!r}*{x}"]
    return {"body": body, "velocity": [term.replace("--", "+").replace("+-", "-") for term in terms], "unit": "m/s"}


def momenta(*bodies):
    return [{"name": f"{body}_{axis}", "quantity": "momentum", "of": body, "component": axis} for body in bodies for axis in "xyz"]


# ------------------------------------------------------------------------------------------------ scenes

def rim():
    """A sheet falls on the rim of a sheet that stands: both as heavy, and as fast."""
    sheet = {"kind": "sheet", "length": "100 mm", "width": "50 mm", "cells_along": 2, "cells_across": 1}
    stuff = material(young="100 MPa")
    lying = plate("lying", {**sheet, "map": ["x-0.05", "0", "y"]}, 0.0005, stuff, move=lengths((0, 0, 0.0015)))
    standing = plate("standing", {**sheet, "map": ["0", "x-0.05", "y-0.05"]}, 0.0005, stuff)
    return {"bodies": [lying, standing], "contacts": automatic(0.0),
            "initial": [thrown("lying", (0, 0, -3)), thrown("standing", (0, 0, 3))],
            "probes": momenta("lying", "standing"), "time": {"end": "2 ms"}}


def rests():
    """A rigid box of 32 g on a rigid floor that is held, in a thousand steps."""
    return right_runs.stack(1, 0, True, True, False, "0.5 s")


def thin():
    """The ridge of a spinning box strikes a free tube of 0.8 mm, and its rim."""
    mesh = {"kind": "tube", "radius": "17.5 mm", "length": "40 mm", "turn": "full", "cells_core": 3, "cells_along": 4}
    high, at = (0.01665, 0.01587, 0.01952), (-0.04441, -0.05593, 0.12617)
    turned = {"axis": [-1.32169, -1.46791, 0.838], "angle": "292.43453 deg"}
    tube = plate("tube", mesh, 0.0008, material(), "follows_strain", rotate=turned, move=lengths((0.09489, 0.05836, -0.01948)))
    block = box("block", [-side for side in high], high, (3, 3, 3))
    block.update(rotate={"axis": [1.2353, 2.0288, -0.18058], "angle": "291.93924 deg"}, move=lengths(at))
    return {"bodies": [tube, block], "contacts": automatic(0.3), "initial": [
        thrown("tube", (-5.50095, -2.41534, 1.57125)), thrown("block", (1.52793, 3.62344, -5.43417), (11.39102, 56.36792, 1.36375), at)],
            "probes": momenta("tube", "block"), "time": {"end": "22 ms"}, "output": {"frames_every": "0.1 ms", "history_every": "0.1 ms"}}


def lands(size=0.01, width=0.024, height=0.01):
    """A soft cube lands on a soft block at a slant, so that a leading corner and friction come together."""
    cube = box("cube", (-size / 2, -size / 2, 0), (size / 2, size / 2, size), (9, 9, 9), "1 MPa")
    block = box("block", (-width / 2, -width / 2, -height), (width / 2, width / 2, 0), (15, 15, 6), "1 MPa")
    cube["move"] = lengths((-0.00095, -0.00079, 0.0002))
    return {"bodies": [cube, block], "contacts": automatic(0.3), "planes": [fixed("block.z_low")],
            "initial": [thrown("cube", (3.669, -0.9172, -1.8345))], "probes": momenta("cube"), "time": {"end": "2 ms"}}


def pipes():
    """Two steel pipes strike each other crosswise."""
    pipe = {"kind": "tube", "radius": "20 mm", "length": "120 mm", "turn": "full", "cells_core": 4, "cells_along": 24}
    lower = plate("lower", pipe, 0.0015, steel(), rotate={"axis": [0, 1, 0], "angle": "90 deg"}, move=lengths((-0.06, 0, 0)))
    upper = plate("upper", pipe, 0.0015, steel(), rotate={"axis": [1, 0, 0], "angle": "90 deg"}, move=lengths((0, 0.06, 0.042)))
    return {"bodies": [lower, upper], "contacts": automatic(0.2), "planes": [fixed("lower.bottom", "lower.top")],
            "initial": [thrown("upper", (0, 0, -40))], "probes": momenta("lower", "upper") + [
                {"name": "held", "quantity": "impulse", "of": "hold", "component": "z"}], "time": {"end": "0.5 ms"}}


def tube():
    """A square steel tube, a round one with a map, is crushed between its foot and a rigid platen, and folds on itself."""
    def side(this, other, sign):
        dent = "0.02*exp(-((z-0.05)/0.01)^2)"
        return f"(abs({this})>=abs({other}) ? 0.025*sign({this}) : 0.025*4/pi*atan({this}/abs({other})))*(1{sign}{dent})"
    mesh = {"kind": "tube", "radius": "25 mm", "length": "75 mm", "turn": "full", "cells_core": 3, "cells_along": 12,
            "map": [side("x", "y", "+"), side("y", "x", "-"), "z"]}
    down = {"value": ["0", "0", "-20*min(1, t/0.2e-3)"], "unit": "m/s"}
    platen = box("platen", (-0.05, -0.05, 0.076), (0.05, 0.05, 0.086), (4, 4, 1), rigid=True)
    return {"bodies": [plate("tube", mesh, 0.0015, steel()), platen],
            "contacts": automatic(0.2), "planes": [{"name": "foot", "kind": "fixed", "nodes": ["tube.bottom"]},
                                                   {"name": "ram", "kind": "driven", "nodes": ["platen"], "velocity": down}],
            "time": {"end": "2.4 ms"}}


def pushed(friction=0.2):
    """Two rigid boxes in a row, side by side, are pushed over a flat rigid floor."""
    boxes = [box("floor", (0, 0, -0.05), (1, 0.2, 0), (20, 4, 1), rigid=True),
             box("first", (0.05, 0.05, 0), (0.15, 0.15, 0.1), (3, 3, 3), rigid=True),
             box("second", (0.15, 0.05, 0), (0.25, 0.15, 0.1), (4, 4, 4), rigid=True)]
    return {"bodies": boxes, "contacts": automatic(friction), "planes": [fixed("floor")], "gravity": DOWN,
            "loads": [{"name": "push", "kind": "pressure", "surface": "first.x_low", "value": "800", "unit": "Pa"}],
            "probes": [{"name": f"{body}_{axis}", "quantity": quantity, "of": body, "component": axis} for body in ("first", "second")
                       for quantity, axis in (("velocity", "x"), ("displacement", "z"))], "time": {"end": "0.4 s"}}


def ridges():
    """The ridge of a box strikes the ridge of a cylinder at 24 m/s; both are free."""
    one, other = (0.001086, -0.022446, -0.060992), (0.059508, 0.031365, 0.094760)
    high, centre = (0.022537, 0.01951, 0.023646), (0.044161, 0.044186, 0.09506)
    block = box("block", [-half for half in high], high, (3, 3, 3))
    block.update(rotate={"axis": [0.809887, 0.363244, 0.815133], "angle": "270.969618 deg"}, move=lengths(one))
    mesh = {"kind": "cylinder", "radius": "17.5 mm", "length": "40 mm", "turn": "full", "cells_core": 2, "cells_ring": 1, "cells_along": 3}
    cylinder = {"name": "cylinder", "mesh": mesh, "material": material(), "move": lengths(other),
                "rotate": {"axis": [-0.218032, -0.609131, -0.226562], "angle": "96.072937 deg"}}
    return {"bodies": [block, cylinder], "contacts": automatic(0.3), "time": {"end": "8 ms"},
            "initial": [thrown("block", (-0.707549, 3.724295, 10.01245), (-33.35714, -48.847751, -11.166164), one),
                        thrown("cylinder", (-3.138605, -3.849019, -11.275117), (49.224357, 9.133635, -124.735676), centre)],
            "probes": momenta("block", "cylinder"), "output": {"frames_every": "20 us", "history_every": "20 us"}}


def bounces(rows):
    """A block strikes another one for a millisecond of a second; `rows` are the keys of the output."""
    lower, upper = (box(name, (0, 0, low), (0.1, 0.1, low + 0.1), (2, 2, 2), "1 GPa") for name, low in (("lower", 0), ("upper", 0.1)))
    return {"bodies": [lower, {**upper, "move": lengths((0, 0, 0.00123))}], "planes": [fixed("lower.z_low")],
            "contacts": [{"name": "c", "apexes": "upper.z_low", "base": "lower.z_high"}], "initial": [thrown("upper", (0, 0, -1))],
            "time": {"end": "1 s"}, "output": rows,
            "probes": [{"name": "pressure", "quantity": "contact_pressure", "of": "c"},
                       {"name": "force", "quantity": "force", "of": "c", "component": "z"},
                       {"name": "stress", "quantity": "von_mises", "of": "lower", "take": "largest"},
                       {"name": "mean_stress", "quantity": "stress", "of": "lower", "component": "zz"},
                       {"name": "gap", "quantity": "gap", "of": "c"},
                       {"name": "speed", "quantity": "velocity", "of": "upper", "component": "z"}]}


# ------------------------------------------------------------------------------------------------ answers

@dataclass(frozen=True)
class Answer:
    """What a result must be, and how far it may be off, and why."""
    word: str
    of: Callable[[Run], float]
    right: float
    within: float
    reason: str


@dataclass(frozen=True)
class Scene:
    name: str
    scene: Callable[[], dict]
    answers: tuple[Answer, ...]
    says: tuple[str, ...] = ()  # parts of lines that it may print
    wrong: str = ""             # of a scene that is open: what happens


def change_of_momentum(axis, *bodies, by=None):
    """Of bodies since the start, less the impulse of what holds them."""
    def measure(run):
        now = sum(run.result(f"{body}_{axis}_last") for body in bodies)
        return now - run.ledger("initial_momentum")["xyz".index(axis)] - (run.result(f"{by}_last") if by else 0)
    return measure


def friction_over_push(body):
    """The change of the momentum along a floor over that away from it."""
    return lambda run: hypot(*(change_of_momentum(axis, body)(run) for axis in "xy")) / change_of_momentum("z", body)(run)


def smallest_corner(body):
    return lambda run: run.result(f"{body}_smallest_corner")


def range_of(*probes):
    return lambda run: max(run.result(f"{probe}_largest") - run.result(f"{probe}_smallest") for probe in probes)


def deepest(limit, reason, of="audit_deepest_overlap"):
    return Answer(f"{of} [m]", lambda run: run.result(of), 0, limit, reason)


def no_momentum(*bodies):
    return tuple(Answer(f"change of the momentum along {axis} [N s]", change_of_momentum(axis, *bodies), 0, 1e-12,
                        "nothing holds the bodies: round-off") for axis in "xyz")


def coulomb(corner):
    return (Answer("friction over push", friction_over_push("cube"), 0.3, 0.015,
                   "all nodes slide, but as the sole lifts the last ones turn; and the dented floor leans a little"),
            Answer("smallest corner of the cube", smallest_corner("cube"), corner, 0.05,
                   "that of a quarter of the step, within 0.01 of one pass; a corner that folds is below 0.5"))


SAGITTA = 0.02 * (1 - cos(pi / 32))  # [m] of a pipe with 32 chords
def boxes_follow(run):
    """The largest error of the speed of two boxes of 1 kg that 8 N push against friction of 0.2: it grows with (8 - 0.2 m g) t / m."""
    right = (8 - 0.2 * 2 * right_runs.G) / 2 * 0.4
    return max(abs(run.result(f"{body}_x_last") - right) for body in ("first", "second"))


def unlike_dense_rows(run):
    """How many results of the probes differ from those of other rows; all runs have the same steps."""
    dense = Run(bounces({"history_every": "0.05 ms"}))
    probes = tuple(probe["name"] + "_" for probe in bounces({})["probes"])
    of_probes = [name for name in run.summary["results"] if name.startswith(probes)]
    return sum(run.result(name) != dense.result(name) for name in of_probes)


SCENES = (
    Scene("rim", rim, (
        deepest(5e-6, "a hundredth of the thickness: sheets touch at their surfaces", "touch_deepest"),
        deepest(5e-6, "the same", "audit_deepest_overlap"),
        *no_momentum("lying", "standing"),
        Answer("they part", lambda run: run.result("lying_z_last") > 0, True, 0, "sheets as heavy and fast bounce back")), (SWING,)),
    Scene("rests", rests, (
        Answer("motion [m]", range_of("top_x", "top_y", "top_z"), 0, 1e-9, "what lies at rest stays there; rigid bodies do not give way"),
        Answer("created over the floor of energies", Run.created, 0, 1e-12, "round-off of a thousand steps"))),
    Scene("thin", thin, (
        deepest(4e-5, "a twentieth of the thickness: the audit looks at frames, and facets turn between them"),
        *no_momentum("tube", "block")), ("tube: lost ",)),
    Scene("lands", lands, coulomb(0.84)),
    Scene("pipes", pipes, (
        deepest(SAGITTA, "a chord of one pipe is so much lower than the circle, on which the nodes of the other stand"),
        Answer("momentum less impulse of the ends [N s]", change_of_momentum("z", "lower", "upper", by="held"), 0, 1e-9,
               "nothing else acts from outside: round-off of 1,200 steps"))),
    Scene("tube", tube, (
        deepest(1.5e-4, "a tenth of the thickness, from which on the audit warns of overlaps", "touch_deepest"),
        deepest(1.5e-4, "the same"))),
    Scene("bounces", lambda: bounces({}), (
        Answer("results that depend on the rows", unlike_dense_rows, 0, 0, "peaks are those of all steps, and the steps are the same"),
        Answer("a largest pressure", lambda run: run.result("pressure_largest") > 1e3, True, 0, "they touched"))),
    Scene("lands_larger", lambda: lands(0.012), coulomb(0.85)),
    Scene("lands_largest", lambda: lands(0.0144), coulomb(0.88)),
    Scene("pushed", pushed, (
        Answer("error of the speed [m/s]", boxes_follow, 0, 1e-3, "what a step of 0.4 ms adds"),
        Answer("lift [m]", range_of("first_z", "second_z"), 0, 1e-6, "flat rigid boxes on a flat rigid floor do not leave it"))),
)


OPEN = (  # also open: a tetrahedron that a file has as a hexahedron with coincident corners has half its mass
    Scene("ridges", ridges, (deepest(2e-4, "a fiftieth of an element"), *no_momentum("block", "cylinder")),
          wrong="at its worst they overlap by 0.13 of an element: ridges that are dented by more than 20 degrees are left to nodes"),
)


class Known(unittest.TestCase):
    def ends_right(self, scene):
        run = Run(scene.scene())
        said = [line for line in run.stderr.splitlines() if not any(part in line for part in scene.says)]
        with self.subTest("status and messages"):
            self.assertEqual((run.status, said), (0, []))
        self.assertIsNotNone(run.summary, run.stderr)
        for answer in scene.answers:
            with self.subTest(answer.word):
                self.assertAlmostEqual(answer.of(run), answer.right, delta=answer.within, msg=answer.reason)


def add(scene):
    setattr(Known, f"test_{scene.name}", lambda self: self.ends_right(scene))


def main(words):
    if not words:
        sys.exit(__doc__)
    Run.drivers = Path(words.pop(0)).resolve()
    scenes = OPEN if "--open" in words else SCENES
    names = [word for word in words if word != "--open"]
    unknown = set(names) - {scene.name for scene in scenes}
    if unknown:
        sys.exit(f"no such scene: {', '.join(sorted(unknown))}; there are {', '.join(scene.name for scene in scenes)}")
    for scene in scenes:
        if not names or scene.name in names:
            add(scene)
            if scene.wrong:
                print(f"{scene.name}: {scene.wrong}")
    unittest.main(argv=[sys.argv[0], "-v"])


if __name__ == "__main__":
    main(sys.argv[1:])
