"""What accuracy costs on a block that slides to rest: way, time and heat have exact values."""
from accept import distance, heat, stop_time
from trade_points import Exact

TITLE = "a block slides to rest"
RESULTS = [Exact("distance", distance), Exact("time to stop", stop_time), Exact("heat of friction", heat)]
# one layer stays: the case starts at rest under the weight of one, and two would vibrate
KNOBS = {"mesh": {f"x{factor:g}": {"bodies[0].mesh.cells": f"[{4 * factor:g}, {4 * factor:g}, 1]"} for factor in (0.5, 2, 4)}}
