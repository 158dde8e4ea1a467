"""What accuracy costs on Taylor's bar: no exact value, so the finest of three meshes, 14 cells across and 140 along, is the reference."""
from trade_points import Converged, Meshes

TITLE = "Taylor's bar"


def last(name):
    return lambda run: run.column(name)[-1]


RESULTS = [Converged("final length", last("length"), "m"), Converged("radius of the foot", last("foot_radius"), "m")]
MESHES = Meshes((5 / 3, 2, 7 / 3))
GRADE = "0.0324*((1 - {0:g})*(z/0.0324) + {0:g}*(z/0.0324)^2)"
KNOBS = {
    "mesh": (1 / 3, 2 / 3, 4 / 3, 5 / 3),
    "grading": {f"to the foot, {part:g}": {"bodies[0].mesh.map": f'["x", "y", "{GRADE.format(part)}"]'} for part in (0.25, 0.5)},
}
