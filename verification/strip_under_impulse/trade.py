"""What accuracy costs on a clamped strip of plates under an impulse, with hardening, against 256 cells along and nine layers.

Without hardening the hinge at the clamp has no width: the largest deflection grows by 1.6 % from 32 to 64 cells and again to 128, which are
as long as a twelfth of the thickness, so there is no reference.
"""
from accept import permanent
from trade_points import Converged, Meshes

TITLE = "a strip under an impulse"
CHANGE = {"bodies[0].material.tangent": "2 GPa"}
RESULTS = [Converged("largest deflection", lambda run: run.result("middle_largest"), "m"),
           Converged("permanent deflection", permanent, "m")]


def mesh(factor):
    """Cells as wide as they are long."""
    return {"bodies[0].mesh.cells_along": f"{32 * factor:g}", "bodies[0].mesh.width": f"{2 / factor:g} mm"}


def layers(number):
    return {"bodies[0].element.layers": f"{number}"}


MESHES = Meshes((2, 4, 8), layers(9), mesh, {f"{number} layers": layers(number) for number in (6, 7, 8, 9)})
KNOBS = {"mesh": {f"x{factor:g}": mesh(factor) for factor in (0.25, 0.5, 2, 4)}}
