"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import friction_force, slip_time, speed, way
from verify import Breaks, Check, Figure, Pair, Report, Table, beyond, side_by_side

CATALOGUE = ("C-7",)
CLAIM = ("A block pressed on a plane by P and pushed along it by Q stays while Q is below mu P, slips at mu P, and then has the "
         "friction mu P.")
EVIDENCE = "exact"
DRIVER = "scene"

P, MU, RATE, START, MASS = 1600.0, 0.3, 1600.0, 0.1, 16.0  # [N] [-] [N/s] [s] [kg]
SLIP = slip_time(P, MU, RATE, START)


def sliding(run):
    """The span in which all of the sole slides. [s]"""
    return SLIP + 0.05, run.column("time")[-1]


def push_at_slip(run):
    """The push when the block lets go: sqrt(v) grows evenly from there, so the line through two of its points is followed back."""
    first, last = (SLIP + 0.05, run.column("time")[-1])
    low, high = sqrt(max(0.0, run.at("speed", first))), sqrt(max(0.0, run.at("speed", last)))
    let_go = first - low * (last - first) / (high - low)
    return Pair(run.at("push", let_go), MU * P, "N")


def balance_across(run):
    """Force of the plane over the pressing force, once this is whole."""
    return Pair(run.mean("normal_force", START, run.column("time")[-1]), P, "N")


def balance_along(run):
    """Friction against the push at the sample where it is farthest from it, up to nine tenths of the slip."""
    until = START + 0.9 * (SLIP - START)
    rows = [(-f, q) for t, f, q in zip(run.column("time"), run.column("friction"), run.column("push")) if START <= t <= until]
    friction, push = max(rows, key=lambda row: abs(row[0] - row[1]))
    return Pair(friction, push, "N", scale=MU * P)


def friction_that_slides(run):
    return Pair(-run.mean("friction", *sliding(run)), MU * P, "N")


def ratio(run):
    """Friction over the force across, at the sample where it is farthest from the coefficient."""
    first, last = sliding(run)
    rows = [-f / n for t, f, n in zip(run.column("time"), run.column("friction"), run.column("normal_force")) if first <= t <= last]
    return Pair(max(rows, key=lambda r: abs(r - MU)), MU)


def final_speed(run):
    return Pair(run.column("speed")[-1], speed(run.column("time")[-1], P, MU, RATE, START, MASS), "m/s")


def final_way(run):
    return Pair(run.column("way")[-1], way(run.column("time")[-1], P, MU, RATE, START, MASS), "m")


def creep(run):
    """Way at nine tenths of the slip, over that which the push would have made on ice by then."""
    then = START + 0.9 * (SLIP - START)
    return Pair(run.at("way", then), 0, "m", scale=way(then, P, 0.0, RATE, START, MASS))


def meshes(run):
    rows = []
    for cells in ("[2, 2, 1]", "[4, 4, 1]", "[8, 8, 2]"):
        one = run.again({"bodies[0].mesh.cells": cells})
        rows.append([cells, *(f"{100 * m(one).error():.3f} %" for m in (push_at_slip, balance_along, ratio, final_speed))])
    return rows


PENALTY = {"planes[0].method": "penalty"}
BY_DEFAULT = [
    Check("push at the slip", push_at_slip, 0.01, "the catalogue's bound: Q = mu P"),
    Check("force of the plane", balance_across, 0.01, "the catalogue's bound: P"),
    Check("friction of the block that stays", balance_along, 0.01,
          "the catalogue's bound: Q; the rest accelerates the block as its rear edge slips ahead"),
    Check("friction of the block that slides", friction_that_slides, 0.01, "the catalogue's bound: mu P"),
    Check("friction over push across", ratio, 1e-9,
          "Coulomb's law holds at each node, so it holds in the sum, and the two are means over the same steps: round-off"),
    Check("speed at the end", final_speed, 0.01, "as the slip"),
    Check("way at the end", final_way, 0.01, "as the slip"),
    Check("creep before the slip", creep, 0.01,
          "the block gives way elastically and its sole slips at one edge: a thousandth of the way on ice"),
]

CHECKS = [
    *BY_DEFAULT,
    Report("errors beyond those by a penalty, over the limits", beyond(BY_DEFAULT, PENALTY),
           "the exact block is rigid, and what both leave is its compliance: a fifth with 100 MPa"),
]

STUDIES = [Table("Errors by default and by the usual penalty.", ["check", "by default", "by a penalty"], side_by_side(BY_DEFAULT, PENALTY)),
           Table("Errors over the mesh.", ["cells", "push at the slip", "friction of the block that stays", "friction over push across",
                                           "speed at the end"],
                 meshes, full=True)]

BREAKS = [
    Breaks("friction over push across", "a coefficient of 0.301", {"planes[0].friction": 0.301}),
    Breaks("way at the end", "a coefficient of 0.29", {"planes[0].friction": 0.29}),
    Breaks("push at the slip", "a coefficient of 0.31", {"planes[0].friction": 0.31}),
    Breaks("force of the plane", "gravity left on", {"gravity": "[0 m/s^2, 0 m/s^2, -9.81 m/s^2]"}),
    Breaks("friction of the block that slides", "a coefficient of 0.29", {"planes[0].friction": 0.29}),
    Breaks("friction of the block that stays", "friction below the push", {"planes[0].friction": 0.25}),
    Breaks("creep before the slip", "a stick a million times too soft", {"planes[0].method": "penalty", "planes[0].penalty": "1e9 Pa/m",
                                                                         "planes[0].tangential_penalty": 1e-6}),
    Breaks("speed at the end", "the coefficient doubled, as where both faces rub", {"planes[0].friction": 0.6}),
]


def friction_over_push(run):
    return [("Nereid", [1e-3 * q for q in run.column("push")], [-1e-3 * f for f in run.column("friction")])]


def coulomb(run):
    pushes = [8.0 * i for i in range(101)]
    return [("Q, at most μP", [1e-3 * q for q in pushes], [1e-3 * friction_force(START + q / RATE, P, MU, RATE, START) for q in pushes])]


def speed_over_time(run):
    return [("Nereid", [1e3 * t for t in run.column("time")], run.column("speed"))]


def exact_speed(run):
    times = [0.006 * i for i in range(101)]
    return [("exact", [1e3 * t for t in times], [speed(t, P, MU, RATE, START, MASS) for t in times])]


FIGURES = [
    Figure("friction", "push Q [kN]", "friction [kN]", friction_over_push, exact=coulomb,
           caption="Friction over the push, P = 1.6 kN and a coefficient of 0.3: it balances the push up to 0.48 kN."),
    Figure("speed", "time [ms]", "speed [m/s]", speed_over_time, exact=exact_speed, caption="Speed of the block: it slips at 400 ms."),
]
