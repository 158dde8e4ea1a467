"""What accuracy costs on Hertz's impact: force and time over his for the meshed mass, against the finest of three meshes."""
from accept import duration, exact, rebound, smoothed_peak
from trade_points import Converged, Meshes

TITLE = "a sphere strikes a plane"
CHANGE = {"output.history_every": "0.025 us"}  # a row in ten would give the contact time in steps of half a per cent
RESULTS = [Converged("largest force over Hertz's", lambda run: smoothed_peak(run) / exact(run)["force"]),
           Converged("contact time over Hertz's", lambda run: duration(run).got / exact(run)["duration"]),
           Converged("speed after over before", lambda run: rebound(run).got)]
MESHES = Meshes((5 / 3, 2, 8 / 3))
KNOBS = {"mesh": (1 / 2, 2 / 3, 4 / 3, 5 / 3, 2)}
