"""Three equal bars in a row with gaps: each impact exchanges velocities, by d'Alembert's solution.

Two equal bars, one at rest: both ends move at V/2 under rho c V/2 for 2L/c, then the striking bar is at rest, the other moves at V as a
whole, both free of stress. The far end of the struck bar moves at V from L/c after the impact on, so it meets the third bar a time gap/V
later, long after the first impact is over, and all repeats. The first bar comes to rest as far from the second as it started.
"""
from math import sqrt

BARS = {"density": 1000, "young": 1e9, "length": 1.0, "area": 1e-4, "gap": 0.05, "speed": 10.0}  # SI


def reference(density, young, length, area, gap, speed):
    """Exact values in SI units.

    >>> bars = reference(**BARS)
    >>> [round(1e3 * t, 9) for t in bars["impacts"]], round(1e3 * bars["duration"], 9), bars["force"]
    ([5.0, 11.0], 2.0, 500.0)
    """
    c = sqrt(young / density)
    first = gap / speed
    return {
        "impacts": [first, first + length / c + gap / speed],  # [s]
        "duration": 2 * length / c,                            # [s] of each
        "force": density * c * speed / 2 * area,               # [N]
        "momentum": density * area * length * speed,           # [N s]
        "speeds": {"first": 0.0, "second": 0.0, "third": speed},  # [m/s] at the end
        "gap": gap,                                            # [m] between first and second, at the end
    }


def speeds(exact, speed, t):
    """Mean velocities of the three bars [m/s].

    >>> speeds(reference(**BARS), 10.0, 0.008), speeds(reference(**BARS), 10.0, 0.020)
    ((0.0, 10.0, 0.0), (0.0, 0.0, 10.0))
    """
    one, two = (min(1.0, max(0.0, (t - start) / exact["duration"])) for start in exact["impacts"])
    return speed * (1 - one), speed * (one - two), speed * two
