"""What accuracy costs on Taylor's bar: no exact value, so the finest of three meshes, 14 cells across and 140 along, is the reference.

The cells at the foot are 1.5 times as tall as even ones. The cell on its axis is squashed to a 25th of its height, and where it begins as
tall as it is wide, a small change of any setting folds it.
"""
from trade_points import Converged, Meshes

TITLE = "Taylor's bar"


def last(name):
    return lambda run: run.column(name)[-1]


def drawn(part):
    """Keys of a mesh whose cells at the foot are 1 - part times as tall as even ones."""
    return {"bodies[0].mesh.map": f'["x", "y", "0.0324*({1 - part:g}*(z/0.0324) + {part:g}*(z/0.0324)^2)"]'}


CHANGE = drawn(-0.5)
RESULTS = [Converged("final length", last("length"), "m"), Converged("radius of the foot", last("foot_radius"), "m")]
MESHES = Meshes((5 / 3, 2, 7 / 3))
KNOBS = {
    "mesh": (1 / 3, 2 / 3, 4 / 3, 5 / 3),
    "grading": {f"{1 - part:g} times as tall at the foot": drawn(part) for part in (-0.25, 0, 0.25, 0.5)},
}
