"""How close is close enough, why, and what must break."""
from reference import INCH, VM85, reference, shortening
from verify import Breaks, Check, Falls, Figure, Pair, created

CATALOGUE = ("I-1b",)
CLAIM = "A long bar stopped by a wall is shortened by V L/c when the front reaches its free end, and all its energy is then strain energy."
EVIDENCE = "exact"
DRIVER = "scene"

EXACT = reference(**VM85)  # of the source, not of the case: a slip in the case shows


def shorter(run):
    """Shortening at each row of the history. [m]"""
    return [VM85["length"] - length for length in run.column("length")]


def impact_time(run):
    return Pair(next(t for t, force in zip(run.column("time"), run.column("wall_force")) if force > 0), EXACT["impact"], "s")


def largest(run):
    return Pair(max(shorter(run)), EXACT["shortening"], "m")


def when(run):
    """From the impact to the largest shortening."""
    times, values = run.column("time"), shorter(run)
    return Pair(times[values.index(max(values))] - impact_time(run).got, EXACT["rise"], "s")


def at_rest(run):
    """Kinetic energy that is left when the bar is shortest, over the initial one."""
    values, kinetic = shorter(run), run.column("energy_kinetic")
    return Pair(kinetic[values.index(max(values))] / kinetic[0], 0, "", scale=1)


CHECKS = [
    Check("impact time", impact_time, 0.04, "the first force acts within a step of the impact, and a step of 200 elements is 3 % of it"),
    Check("largest shortening", largest, 0.01,
          "the catalogue's bound; the front is some elements wide, and the viscosity takes the ringing behind it"),
    Check("time of the largest shortening", when, 0.01,
          "the catalogue's bound; the front is some elements wide"),
    Check("kinetic energy at the largest shortening", at_rest, 0.01,
          "exact: none; what is left is in the front, some elements wide, and falls with the mesh"),
    Check("created energy", created, 1e-9, "multipliers create nothing: round-off; a penalty has 1e-5"),
]

STUDIES = [
    Falls("largest shortening", along="bodies[0].mesh.cells[0]", values=[50, 100, 200]),
    Falls("kinetic energy at the largest shortening", along="bodies[0].mesh.cells[0]", values=[50, 100, 200]),
    Falls("time of the largest shortening", along="bodies[0].mesh.cells[0]", values=[50, 100, 200]),
]

BREAKS = [
    Breaks("impact time", "the gap in millimetres", {"planes[0].point": "[254000.64 mm, 0 mm, 0 mm]"}),
    Breaks("largest shortening", "weight per volume taken for density", {"bodies[0].material.density": "0.282 lbf*s^2/in^4"}),
    Breaks("time of the largest shortening", "29e6 psi for 30e6 psi, as some tables have it", {"bodies[0].material.young": "29e6 psi"}),
    Breaks("kinetic energy at the largest shortening", "a wall a hundred times too soft", {"planes[0].method": "penalty",
                                                                                           "planes[0].penalty_scale": 0.01}),
    Breaks("kinetic energy at the largest shortening", "five elements for the whole bar", {"bodies[0].mesh.cells": "[5, 1, 1]"}),
    Breaks("created energy", "a penalty that may create 4 % of a bounce",
           {"planes[0].method": "penalty", "planes[0].energy_gain_limit": 0.04}, full=True),
]


def over_time(run):
    return [("Nereid", [1e3 * t for t in run.column("time")], [1e3 * s for s in shorter(run)])]


def exact_over_time(run):
    times = [0.0, EXACT["impact"], EXACT["impact"] + EXACT["rise"], run.column("time")[-1]]
    return [("exact", [1e3 * t for t in times], [1e3 * shortening(EXACT, t) for t in times])]


FIGURES = [Figure("shortening", "time [ms]", "shortening of the bar [mm]", over_time, exact=exact_over_time,
                  caption="Shortening of the bar over time: it grows at the speed of impact until the front has reached the free end.")]
