"""What accuracy costs on a block that slides to rest: way, time and heat have exact values."""
from accept import distance, heat, stop_time
from trade_points import Exact

TITLE = "a block slides to rest"
RESULTS = [Exact("distance", distance), Exact("time to stop", stop_time), Exact("heat of friction", heat)]
KNOBS = {"mesh": (0.5, 2, 4)}
