"""What accuracy costs on a ball that falls on a plate: no exact value, so the finest of three meshes is the reference."""
from trade_points import Converged, Meshes

TITLE = "a ball falls on a plate"
DRIVER, CASE = "scene", "cases/scene/ball_on_plate.yaml"
CHANGE = {"output.frames_every": "3 ms", "output.history_every": "1 us"}  # extremes are those of rows
RESULTS = [Converged("deflection", lambda run: run.result("deflection_smallest"), "m"),
           Converged("its time", lambda run: run.result("deflection_smallest_at"), "s"),
           Converged("speed of rebound", lambda run: run.result("speed_last"), "m/s")]
MESHES = Meshes((2, 8 / 3, 10 / 3))
KNOBS = {"mesh": (2 / 3, 4 / 3, 5 / 3, 2)}
