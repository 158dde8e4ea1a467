"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import BAR, CONSISTENT, LUMPED, TIME, kinetic_energy, largest_twist_at, von_mises_at_corner
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table

CATALOGUE = ("E-11",)
CLAIM = ("The stress of a free bar released in torsion agrees with another code with lumped masses, and without viscosity its energy "
         "stays constant.")
EVIDENCE = "benchmark"
DRIVER = "scene"

OUTERMOST = 0.5 + 0.5 / sqrt(3)  # of the way from the axis to the corner: the last point of Gauss of two elements across
BARE = {f"bodies[0].element.viscosity.{term}": 0 for term in ("linear", "quadratic")}
LATEST = 0.7e-3                  # [s] no relief yet in the middle


def at_corner(run):
    """Von Mises stress at the corner over time: of the outermost point of Gauss, in proportion to the distance from the axis. [Pa]"""
    return [stress / OUTERMOST for stress in run.column("von_mises")]


def peak(run):
    return Pair(run.at("von_mises", TIME) / OUTERMOST, LUMPED, "Pa")


def peak_consistent(run):
    return Pair(peak(run).got, CONSISTENT, "Pa")


def growth(run):
    """Of the stress at the corner, where it is farthest from G a t r, between 0.2 and 0.7 ms."""
    rows = [(got, von_mises_at_corner(t, **BAR)) for t, got in zip(run.column("time"), at_corner(run)) if 0.2e-3 <= t <= LATEST]
    got, exact = max(rows, key=lambda row: abs(row[0] / row[1] - 1))
    return Pair(got, exact, "Pa")


def strain_energy(run):
    return [sum(row) for row in zip(*(values for name, values in run.columns.items() if name in ("energy_bar_elastic",
        "energy_bar_hourglass")))]


def largest_twist(run):
    """Time of the largest strain energy, by a parabola through the three rows around it."""
    times, stored = run.column("time"), strain_energy(run)
    i = stored.index(max(stored))
    (t0, t1, t2), (e0, e1, e2) = times[i - 1:i + 2], stored[i - 1:i + 2]
    left, right = (e1 - e0) / (t1 - t0), (e2 - e1) / (t2 - t1)
    return Pair((t0 + t1) / 2 + left * (t2 - t0) / 2 / (left - right), largest_twist_at(**BAR, across=2), "s")


def start(run):
    return Pair(run.column("energy_kinetic")[0], kinetic_energy(**BAR, across=2, along=40), "J")


def drift(run):
    """Of kinetic and strain energy together, the worst of 2 ms."""
    sums = [kinetic + stored for kinetic, stored in zip(run.column("energy_kinetic"), strain_energy(run))]
    return Pair(max(abs(e - sums[0]) for e in sums), 0, "J", scale=sums[0])


def bare(measure):
    """Without viscosity, unless a break sets it."""
    return lambda run: measure(run.again({**BARE, **run.overrides}))


def meshes(run):
    rows = []
    for kind in ("full", "one_point"):
        for cells in ("[2, 2, 40]", "[4, 4, 80]", "[6, 6, 120]"):
            one = run.again({"bodies[0].element.kind": kind, "bodies[0].mesh.cells": cells})
            across = int(cells[1])
            stored = strain_energy(one)
            hourglass = max(one.columns.get("energy_bar_hourglass", [0.0])) / max(stored)
            rows.append([kind.replace("full", "eight points").replace("one_point", "one point"), cells.strip("[]").replace(", ", " x "),
                         f"{1e-6 * one.at('von_mises', TIME):.1f}", f"{1e-6 * max(one.column('von_mises')):.1f}",
                         f"{1e3 * largest_twist(one).got:.3f}", f"{1e3 * largest_twist_at(**BAR, across=across):.3f}",
                         f"{100 * hourglass:.1f} %", f"{bare(drift)(one).error():.1e}"])
    return rows


DEPARTURES = {
    "integration": "the other code's elements have eight points, and so has the stress that is compared",
    "viscosity": "the energy stays constant without it; all else is by default"}

CHECKS = [
    Check("largest von Mises stress at 0.79 ms", peak, 0.03, "the catalogue's bound; the law is hypoelastic and not neo-Hookean"),
    Report("the same against codes with consistent masses", peak_consistent,
           "their bars are relieved already: their waves are 22 % faster on this mesh"),
    Check("growth of the stress until 0.7 ms", growth, 0.02,
          "exact for small twist; shear of 0.18 is not small, and the first rows are a step apart; 0.6 % seen"),
    Check("time of the largest strain energy", largest_twist, 0.03,
          "exact for small twist; the bar twists by half a turn, and a step is 1.6 % of it"),
    Check("time of the largest strain energy by default",
          lambda run: largest_twist(run.again({"bodies[0].element.kind": "one_point"})), 0.03,
          "as of eight points: hourglass stiffness stands for a quarter of the energy of the twist"),
    Check("kinetic energy at the start", start, 1e-12, "lumped masses: round-off"),
    Check("drift of the energy in 2 ms", bare(drift), 1e-3,
          "central differences swing by the square of the step over the period: see the study"),
    Report("drift of the energy in 2 ms with the default viscosity", drift,
           "what the viscosity takes as waves come back from the free ends"),
]

STUDIES = [
    Falls("drift of the energy in 2 ms", along="time.safety", values=[0.9, 0.45, 0.225], order=1.8),
    Table("Meshes: largest von Mises stress of all points of Gauss [MPa] at 0.79 ms and at any time; time of the largest strain energy "
          "[ms], and that of a bar "
          "that cannot warp, with its masses lumped; hourglass energy over internal energy; drift.",
          ["element", "cells", "at 0.79 ms", "largest", "time", "lumped, plane", "hourglass", "drift"], meshes, full=True),
]

BREAKS = [
    Breaks("largest von Mises stress at 0.79 ms", "one point: the stress in the middle of the elements",
           {"bodies[0].element.kind": "one_point"}),
    Breaks("growth of the stress until 0.7 ms", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}),
    Breaks("time of the largest strain energy", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}),
    Breaks("time of the largest strain energy by default", "Poisson's ratio forgotten in the shear modulus",
           {"bodies[0].material.poisson": 0}, full=True),
    Breaks("kinetic energy at the start", "z measured from an end and not from the middle",
           {"initial[0].velocity": '["-8000*y*(z+0.5)", "8000*x*(z+0.5)", "0"]', "time.created_limit": 1e300}),
    Breaks("drift of the energy in 2 ms", "viscosity of ten times the default", {"bodies[0].element.viscosity.linear": 0.6}),
]


def stress_over_time(run):
    return [("Nereid, lumped masses", [1e3 * t for t in run.column("time")], [1e-6 * s for s in at_corner(run)]),
            ("Sierra/Adagio, lumped masses", [1e3 * TIME], [1e-6 * LUMPED]), ("Norma, consistent masses", [1e3 * TIME],
                [1e-6 * CONSISTENT])]


def exact_stress(run):
    latest = largest_twist_at(**BAR, across=2)
    return [("no relief, small twist", [0, 1e3 * latest], [0, 1e-6 * von_mises_at_corner(latest, **BAR)])]


def energies(run):
    times = [1e3 * t for t in run.column("time")]
    scale = run.column("energy_kinetic")[0]
    return [("kinetic", times, [e / scale for e in run.column("energy_kinetic")]),
            ("strain", times, [e / scale for e in strain_energy(run)])]


FIGURES = [
    Figure("stress", "time [ms]", "largest von Mises stress [MPa]", stress_over_time, exact=exact_stress, error=False,
           caption="Largest von Mises stress, carried on to the corner: it grows with the twist until relief arrives from the ends."),
    Figure("energy", "time [ms]", "energy over initial energy [-]", energies, caption="Kinetic and strain energy."),
]
