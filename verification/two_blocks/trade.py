"""What accuracy costs on two bars that collide: every result has an exact value."""
from accept import contact_time, plateau_stress, velocity_of
from trade_points import Exact

TITLE = "two bars collide"
RESULTS = [Exact("plateau stress", plateau_stress), Exact("contact time", contact_time), Exact("velocity of A", velocity_of("A"))]
KNOBS = {"mesh": (0.1, 0.25, 0.5, 2, 4)}
