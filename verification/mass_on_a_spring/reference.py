"""A mass falls on a spring under gravity: free fall, then a harmonic about the place where the spring carries its weight.

Fall: t = sqrt(2 h/g), v = sqrt(2 g h). On the spring m x'' = m g - k x, x(0) = 0, x'(0) = v, so
x = x_s (1 - cos w s) + (v/w) sin w s with x_s = m g/k, w = sqrt(k/m). Lowest where x' = 0: tan w s = -v/(w x_s), and there
x = x_s + sqrt(x_s^2 + (v/w)^2). The mass leaves the spring with the speed it came with at twice that time.

Source of the inputs: Ansys Verification Manual, VM65 (a ball impacts a flexible surface), after Thomson, Vibration Theory and
Applications (1979), example 4.6-1. The manual prints the first three numbers; the largest drop follows from the formulas.
"""
from math import atan2, cos, pi, sin, sqrt

INCH, LBF = 0.0254, 4.4482216152605  # [m], [N]
VM65 = {"mass": 0.5 * LBF / INCH, "stiffness": 1973.92 * LBF / INCH, "height": 1.0 * INCH, "gravity": 386 * INCH}  # SI


def reference(mass, stiffness, height, gravity):
    """Exact values in SI units.

    >>> vm65 = reference(**VM65)
    >>> round(vm65["impact"], 6), round(vm65["speed"] / INCH, 3), round(vm65["kinetic"] / LBF / INCH, 2)
    (0.071982, 27.785, 193.0)
    >>> round(vm65["drop"] / INCH, 5), round(vm65["lowest"], 6)
    (1.55067, 0.100445)
    """
    impact, speed, omega, rest = sqrt(2 * height / gravity), sqrt(2 * gravity * height), sqrt(stiffness / mass), mass * gravity / stiffness
    turn = pi - atan2(speed / omega, rest)
    return {
        "impact": impact, "speed": speed, "kinetic": 0.5 * mass * speed**2,   # [s] [m/s] [J]
        "omega": omega, "rest": rest,                                         # [rad/s] [m]
        "drop": height + rest + sqrt(rest**2 + (speed / omega)**2),           # [m] from the start to the lowest place
        "lowest": impact + turn / omega,                                      # [s]
        "release": impact + 2 * turn / omega,                                 # [s]
        "period": 2 * (impact + turn / omega),                                # [s] from top to top
    }


def height(exact, start, gravity, t):
    """Of the mass over the spring at the time t [m]: bounces without end.

    >>> vm65 = reference(**VM65)
    >>> round((VM65["height"] - height(vm65, VM65["height"], VM65["gravity"], vm65["lowest"])) / INCH, 5)
    1.55067
    >>> abs(height(vm65, VM65["height"], VM65["gravity"], vm65["period"]) / VM65["height"] - 1) < 1e-12
    True
    """
    since_top = min(t % exact["period"], exact["period"] - t % exact["period"])
    if since_top <= exact["impact"]:
        return start - 0.5 * gravity * since_top**2
    s = exact["omega"] * (since_top - exact["impact"])
    return -exact["rest"] * (1 - cos(s)) - exact["speed"] / exact["omega"] * sin(s)
