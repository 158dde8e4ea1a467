"""A bar strikes a longer one of the same section and material: St. Venant's impact, by d'Alembert's solution.

Both ends move at V/2 under the stress rho c V/2. In the short bar the front is released at its free end and is back after 2 L1/c: then
the short bar is at rest and free of stress, and nothing holds the long one. The long bar carries a pulse of length 2 L1
that goes up and down in it; its mean velocity is that of the momentum, V L1/L2. The pulse's reflection pulls the struck end away
later, at 2 L2/c, so the bars do not meet again. Mean velocities then part at V L1/L2: restitution is L1/L2 without any loss.
Source: St. Venant (1867), in Timoshenko & Goodier, Theory of Elasticity, the impact of bars.
"""
from math import sqrt

BARS = {"density": 7850, "young": 210e9, "short": 1.0, "long": 2.0, "area": 1e-4, "gap": 1e-5, "speed": 1.0}  # SI


def reference(density, young, short, long, area, gap, speed):
    """Exact values in SI units.

    >>> bars = reference(**BARS)
    >>> round(bars["wave_speed"], 1), round(bars["force"], 2), round(bars["duration"] * 1e3, 5), bars["restitution"]
    (5172.2, 2030.09, 0.38668, 0.5)
    """
    c = sqrt(young / density)
    return {
        "wave_speed": c,                                     # [m/s]
        "start": gap / speed,                                # [s]
        "duration": 2 * short / c,                           # [s]
        "force": density * c * speed / 2 * area,             # [N]
        "momentum": density * area * short * speed,          # [N s]
        "short_speed": 0.0, "long_speed": speed * short / long,  # [m/s] means after the impact
        "restitution": short / long,                         # [-]
    }


def momentum_of_short(exact, t):
    """Of the striking bar [N s]; the force is constant while it lasts.

    >>> bars = reference(**BARS)
    >>> momentum_of_short(bars, 0.0) == bars["momentum"], abs(momentum_of_short(bars, 1.0)) < 1e-12
    (True, True)
    """
    pushed = min(max(0.0, t - exact["start"]), exact["duration"])
    return exact["momentum"] - exact["force"] * pushed
