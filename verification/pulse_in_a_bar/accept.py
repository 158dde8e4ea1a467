"""How close is close enough, why, and what must break."""
from reference import INPUTS, NODES, PART, TIME, extremes, pulse, reflected
from verify import Breaks, Check, Falls, Figure, Pair, Report

CATALOGUE = ("E-9",)
CLAIM = "A Gaussian displacement in a clamped bar splits into two pulses; displacement, velocity and acceleration are d'Alembert's."
EVIDENCE = "exact"
DRIVER = "scene"

SMALL = {**INPUTS, "height": PART * INPUTS["height"]}
EXTREMES = extremes(TIME, **SMALL)
FIELDS = ("displacement", "velocity", "acceleration")
WAVE_SPEED = (INPUTS["young"] / INPUTS["density"])**0.5
BARE = {f"bodies[0].element.viscosity.{term}": 0 for term in ("linear", "quadratic")}
ROUND_TRIP = {"time.end": "1 ms", "time.safety": 0.9, "output.frames_every": "1 ms"}  # L/c


def line(run):
    """Node by node along the bar at the end of the run: [(m, (m, m/s, m/s2)), ...] without the ends.

    The acceleration of a node is the difference of the stresses of its two elements over density and length: without Poisson effect
    nothing else acts on it.
    """
    _, fields = run.frame("body", -1)
    nodes = {}
    for (x, _, _), (u, _, _), (v, _, _) in zip(fields["points"], fields["displacement"], fields["velocity"]):
        nodes[round(x, 9)] = (u, v)
    at, stress = sorted(nodes), [s[0] for s in fields["stress"]]
    size = at[1] - at[0]
    return [(x, (*nodes[x], (right - left) / INPUTS["density"] / size)) for x, left, right in zip(at[1:], stress, stress[1:])]


def field(which):
    """The largest error over all nodes, over the largest exact value."""
    def measure(run):
        worst = max(abs(got[which] - pulse(x, TIME, **SMALL)[which]) for x, got in line(run))
        return Pair(worst, 0, ("m", "m/s", "m/s^2")[which], scale=max(map(abs, EXTREMES[which])))
    return measure


def extreme(which, pick, place):
    """Over the nodes that the source has too."""
    def there(x):
        return abs(x / NODES - round(x / NODES)) < 1e-6
    return lambda run: Pair(pick(got[which] for x, got in line(run) if there(x)), EXTREMES[which][place], ("m", "m/s", "m/s^2")[which])


def bare(measure):
    """Without viscosity, unless a break sets it."""
    return lambda run: measure(run.again({**BARE, **run.overrides}))


def upside_down(which):
    """At L/c: the largest error over all nodes, over the height of the pulse or its largest velocity on the way."""
    def measure(run):
        back = line(run.again({**ROUND_TRIP, **run.overrides}))
        errors = [abs(got[which] - (reflected(x, **SMALL) if which == 0 else 0)) for x, got in back]
        return Pair(max(errors), 0, ("m", "m/s")[which], scale=SMALL["height"] * (1 if which == 0 else WAVE_SPEED / SMALL["width"]))
    return measure


SOURCE = "the source's bound on the extremes"
DEPARTURES = {
    "viscosity": "accelerations, and velocities after a long way, tell the little viscosity of the pulse's crests (reports)",
    "safety": "at the whole stable step a bar has no error; at half of it mesh and step both have one"}

CHECKS = [
    Check("displacement at all nodes", field(0), 8e-5, SOURCE),
    Check("velocity at all nodes", field(1), 6e-4, SOURCE),
    Check("acceleration at all nodes", bare(field(2)), 6e-4, SOURCE),
    Check("largest displacement", extreme(0, max, 0), 8e-5, SOURCE),
    Check("largest velocity", extreme(1, max, 0), 6e-4, SOURCE),
    Check("smallest velocity", extreme(1, min, 1), 5e-4, SOURCE),
    Check("largest acceleration", bare(extreme(2, max, 0)), 6e-4, SOURCE),
    Check("smallest acceleration", bare(extreme(2, min, 1)), 6e-4,
          "the catalogue's bound on accelerations; the source's own run is within 2e-6 here"),
    Check("displacement after reflection", upside_down(0), 1e-3,
          "phase: (k L)(k h)^2/24 (1 - C^2) for k of the pulse's width is 3e-4 of a radian", full=True),
    Check("velocity after reflection", bare(upside_down(1)), 1e-3, "as the displacement", full=True),
    Report("acceleration at all nodes with the default viscosity", field(2),
           "where the strain has a crest, the limiter lets a little viscosity act"),
    Report("velocity after reflection with the default viscosity", upside_down(1), "the same", full=True),
]

STUDIES = [Falls(f"{name} at all nodes", along="bodies[0].mesh.cells[0]", values=[500, 1000, 2000], order=1.9) for name in FIELDS]

WIDE = {"initial[0].displacement": '["1e-8 * exp(-x^2 / (2 * 0.0202^2))", "0", "0"]'}
BREAKS = [
    Breaks("displacement at all nodes", "a density 1 % too large", {"bodies[0].material.density": "1010 kg/m^3"}),
    Breaks("velocity at all nodes", "a density 1 % too large", {"bodies[0].material.density": "1010 kg/m^3"}),
    Breaks("acceleration at all nodes", "viscosity that was not turned off, and too large",
           {"bodies[0].element.viscosity.linear": 0.2}),
    Breaks("largest displacement", "a width that is 1 % off", WIDE),
    Breaks("largest velocity", "too few elements for the pulse", {"bodies[0].mesh.cells": "[500, 1, 1]"}),
    Breaks("smallest velocity", "too few elements for the pulse", {"bodies[0].mesh.cells": "[500, 1, 1]"}),
    Breaks("largest acceleration", "too few elements for the pulse", {"bodies[0].mesh.cells": "[500, 1, 1]"}),
    Breaks("smallest acceleration", "a width that is 1 % off", WIDE),
    Breaks("displacement after reflection", "a density 1 % too large", {"bodies[0].material.density": "1010 kg/m^3"}, full=True),
    Breaks("velocity after reflection", "a density 1 % too large", {"bodies[0].material.density": "1010 kg/m^3"}, full=True),
]


def near(run, which):
    return [(x, got[which]) for x, got in line(run) if abs(x) <= 0.1]


def curves_of(which, scale):
    def curves(run):
        points = near(run, which)[::4]
        return [("Nereid", [1e3 * x for x, _ in points], [scale * value for _, value in points])]

    def exact(run):
        places = [i * 2e-4 - 0.1 for i in range(1001)]
        return [("d'Alembert", [1e3 * x for x in places], [scale * pulse(x, TIME, **SMALL)[which] for x in places])]
    return {"curves": curves, "exact": exact}


FIGURES = [
    Figure("displacement", "position [mm]", "displacement [nm]", **curves_of(0, 1e9),
           caption="Displacement after 10 us, every fourth node."),
    Figure("velocity", "position [mm]", "velocity [um/s]", **curves_of(1, 1e6), caption="Velocity after 10 us, every fourth node."),
    Figure("acceleration", "position [mm]", "acceleration [m/s2]", **curves_of(2, 1),
           caption="Acceleration after 10 us, every fourth node."),
]
