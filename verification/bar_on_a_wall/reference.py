"""An elastic bar strikes a rigid wall, by d'Alembert's solution.

Impact stops the struck end; a front of the stress rho c V runs to the free end and comes back as a release, one round trip
2L/c later. Then the whole bar leaves with the speed it came with.

Source of the inputs: Ansys Verification Manual, VM265 (elastic rod impacting a rigid wall). Its density is printed as 0.73;
0.73e-3 lbf s^2/in^4 is steel and gives the impact time of 0.00005 s that the page states (seen there). Force and release
follow from the formulas below and agree with an independent one-dimensional model.
"""
from math import sqrt

INCH, LBF = 0.0254, 4.4482216152605  # [m], [N]
VM265 = {"density": 0.73e-3 * LBF / INCH**4, "young": 3e7 * LBF / INCH**2, "length": 10 * INCH, "area": INCH**2,
         "gap": 0.01 * INCH, "speed": 202.2 * INCH}  # SI


def reference(density, young, length, area, gap, speed):
    """Exact values in SI units.

    >>> vm265 = reference(**VM265)
    >>> round(vm265["wave_speed"] / INCH), round(vm265["impact"] * 1e6, 3), round(vm265["force"] / LBF)
    (202721, 49.456, 29923)
    >>> round(vm265["release"] * 1e6, 3)
    148.114
    """
    c = sqrt(young / density)
    impact, round_trip = gap / speed, 2 * length / c
    return {
        "wave_speed": c,                                                      # [m/s]
        "impact": impact,                                                     # [s]
        "release": impact + round_trip,                                       # [s]
        "duration": round_trip,                                               # [s]
        "force": density * c * speed * area,                                  # [N]
        "plateau": (impact + 0.1 * round_trip, impact + 0.9 * round_trip),    # [s]
        "momentum": density * length * area * speed,                          # [kg m/s]
        "rebound": speed,                                                     # [m/s]
    }
