"""What accuracy costs on a slug that strikes a plate in a vessel that yields: a quarter at level 2, against the quarter at level 8."""
from accept import PLATE
from trade_points import Converged, Meshes

TITLE = "a slug strikes a plate"
CASE = PLATE


def rise(run):
    return run.result("largest_rise_head")


def impulse(run):
    return run.result("impulse_head")


RESULTS = [Converged("rise of the head", rise, "m"), Converged("impulse on the head", impulse, "N s")]
MESHES = Meshes((2, 3, 4))
KNOBS = {"mesh": (0.5, 1.5, 2)}
