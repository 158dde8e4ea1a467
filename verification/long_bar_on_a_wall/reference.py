"""A long elastic bar is stopped by a rigid wall: how much shorter it becomes, and when, by d'Alembert's solution.

The wall stops the struck end. A front runs to the free end at c = sqrt(E/rho); behind it the bar is at rest under the strain V/c.
When it arrives, at L/c after the impact, the whole bar is at rest, all its kinetic energy is strain energy, and it is shorter by V L/c.
Until then and after that the shortening changes at the rate V.

Source of the inputs: Ansys Verification Manual, VM85 (a moving bar is suddenly stopped), after Thomson.
"""
from math import sqrt

INCH, LBF = 0.0254, 4.4482216152605  # [m], [N]
VM85 = {"density": 0.73e-3 * LBF / INCH**4, "young": 30e6 * LBF / INCH**2, "length": 10000 * INCH, "gap": 0.64 * INCH,
        "speed": 100 * INCH}  # SI


def reference(density, young, length, gap, speed):
    """Exact values in SI units.

    >>> vm85 = reference(**VM85)
    >>> round(vm85["impact"], 6), round(vm85["shortening"] / INCH, 5), round(vm85["rise"], 7)
    (0.0064, 4.93288, 0.0493288)
    """
    c = sqrt(young / density)
    return {
        "impact": gap / speed,              # [s]
        "rise": length / c,                 # [s] from the impact to the largest shortening
        "shortening": speed * length / c,   # [m]
        "speed": speed,
        "pressure": density * c * speed,    # [Pa] behind the front
    }


def shortening(exact, t):
    """At the time t, until the end of the contact [m].

    >>> vm85 = reference(**VM85)
    >>> shortening(vm85, 0.0), round(shortening(vm85, 0.0064 + 0.0493288 / 2) / vm85["shortening"], 6)
    (0.0, 0.5)
    """
    since = max(0.0, t - exact["impact"])
    return exact["speed"] * max(0.0, exact["rise"] - abs(since - exact["rise"]))
