"""How close is close enough, why, and what must break."""
from reference import VM265, reference
from verify import Breaks, Check, Falls, Figure, Pair, created

CATALOGUE = ("I-1",)
CLAIM = "A bar that hits a rigid wall exerts rho c V A for 2L/c and rebounds with its initial speed."
EVIDENCE = "exact"
DRIVER = "scene"


EXACT = reference(**VM265)  # of the source, not of the case: a slip in the case shows


def touching(run):
    """First and last time at which the wall is pushed. [s]"""
    pushed = [t for t, force in zip(run.column("time"), run.column("wall_force")) if force > 0]
    return pushed[0], pushed[-1]


def impact_time(run):
    return Pair(touching(run)[0], EXACT["impact"], "s")


def plateau_force(run):
    return Pair(run.mean("wall_force", *EXACT["plateau"]), EXACT["force"], "N")


def duration(run):
    first, last = touching(run)
    return Pair(last - first, EXACT["duration"], "s")


def rebound(run):
    """Mean velocity after the impact."""
    momentum = EXACT["momentum"]
    return Pair(-run.column("momentum")[-1] / momentum * EXACT["rebound"], EXACT["rebound"], "m/s")


def impulse(run):
    """Of the wall: twice the momentum, as no force acts at the end."""
    return Pair(-run.account("wall")["impulse"]["value"][0], 2 * EXACT["momentum"], "N s")


def rebound_without_viscosity(run):
    return rebound(run.again({**INVISCID, **run.overrides}))


INVISCID = {"bodies[0].element.viscosity.linear": 0, "bodies[0].element.viscosity.quadratic": 0}

DEPARTURES = {"viscosity": "one check is of the bar without it: fronts that keep their energy"}

CHECKS = [
    Check("impact time", impact_time, 0.005, "the time between two samples is 0.2 % of it"),
    Check("plateau force", plateau_force, 0.01, "ringing averages out over the middle 80 % of the contact"),
    Check("duration", duration, 0.01, "the end of the pulse is some elements wide"),
    Check("rebound speed without viscosity", rebound_without_viscosity, 0.005,
          "what stays behind as ringing is energy of the second order in its amplitude"),
    Check("rebound speed with the default viscosity", rebound, 0.01,
          "the bound of bars on each other, bars_by_multipliers; viscosity takes 1.6 % of the energy from the fronts"),
    Check("impulse of the wall", impulse, 0.005, "half of what the rebound is off by default"),
    Check("created energy", created, 1e-9,
          "each impulse is bounded by what it found: round-off of some thousand steps, which stays far below, as in bars_by_multipliers"),
]

STUDIES = [
    Falls("rebound speed without viscosity", along="bodies[0].mesh.cells[0]", values=[100, 200, 400]),
    Falls("rebound speed with the default viscosity", along="bodies[0].mesh.cells[0]", values=[100, 200, 400]),
    Falls("duration", along="bodies[0].mesh.cells[0]", values=[100, 200, 400]),
]

BREAKS = [
    Breaks("impact time", "the gap in millimetres", {"planes[0].point": "[254.01 mm, 0 mm, 0 mm]"}),
    Breaks("plateau force", "weight per volume taken for density", {"bodies[0].material.density": "0.282 lbf*s^2/in^4"}),
    Breaks("plateau force", "a wall two hundred times too soft", {"planes[0].method": "penalty", "planes[0].penalty_scale": 0.005}),
    Breaks("duration", "a wall two hundred times too soft", {"planes[0].method": "penalty", "planes[0].penalty_scale": 0.005}),
    Breaks("rebound speed without viscosity", "viscosity that swallows the wave", {"bodies[0].element.viscosity.linear": 1}),
    Breaks("rebound speed with the default viscosity", "viscosity that swallows the wave", {"bodies[0].element.viscosity.linear": 1}),
    Breaks("impulse of the wall", "a wall that keeps what it catches",
           {"planes[0].kind": "floor", "planes[0].nodes": "[bar.x_high]"}),
    Breaks("created energy", "a penalty that may create 4 % of a bounce",
           {"planes[0].method": "penalty", "planes[0].energy_gain_limit": 0.04}, full=True),
]


def force_over_time(run):
    return [("Nereid", [1e6 * t for t in run.column("time")], [1e-3 * f for f in run.column("wall_force")])]


def exact_force(run):
    start, end, force = EXACT["impact"], EXACT["release"], 1e-3 * EXACT["force"]
    return [("exact", [1e6 * t for t in (0, start, start, end, end, run.column("time")[-1])], [0, 0, force, force, 0, 0])]


FIGURES = [Figure("force", "time [us]", "force of the wall [kN]", force_over_time, exact=exact_force,
                  caption="Force of the wall on a bar of steel at 202.2 in/s (Ansys VM265): rho c V A for 2 L/c.")]
