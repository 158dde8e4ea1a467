"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import hertz, pressure_at, weighted_mean
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table, straight_line

CATALOGUE = ()
CLAIM = ("A cylinder pressed on a plane has Hertz's half width, largest pressure and pressures of the nodes, and their error falls with "
         "first order, as the contact ends inside an element.")
EVIDENCE = "exact"
DRIVER = "scene"

RADIUS, FORCE, WIDTH, ARC = 0.1, 863073.0, 0.0005, 0.004  # [m] [N/m] [m] across [m] where the circle ends
EXACT = hertz(FORCE, RADIUS, 200e9, 0.3)
HALF, PEAK = EXACT["half_width"], EXACT["pressure"]
UNLIKE = {"bodies[0].mesh.cells": "[12, 1, 12]"}
LOWER, CYLINDER = 0, 1


def face(body, x):
    """Height of a face before the load. [m]"""
    return RADIUS - sqrt(RADIUS**2 - min(ARC, x)**2) if body == CYLINDER else 0.0


def pushed(run, body):
    """[(place, half of the distance of its neighbours, force per length, exact pressure over the node)] of one face. [m] [m] [N/m] [Pa]"""
    fields = run.frame("body")[1]
    points, nodes, rows = fields["points"], fields["connectivity"], {}
    for first in range(0, len(nodes), 8):
        corners = nodes[first:first + 8]
        if (sum(points[n][2] for n in corners) > 0) == (body == CYLINDER):
            for n in corners:
                x, _, z = points[n]
                if abs(z - face(body, x)) < 1e-9:
                    rows.setdefault(round(x, 9), set()).add(n)
    places = sorted(rows)
    return [(x, (right - left) / 2, abs(sum(fields["contact_force"][n][2] for n in rows[x])) / WIDTH,
             weighted_mean(x, left, right, HALF, PEAK)) for left, x, right in zip([places[0], *places], places, [*places[1:], places[-1]])]


def pressures(body):
    """Of the nodes against the exact mean over each, root of the mean square over the contact, over the largest."""
    def measure(run):
        return Pair(sqrt(sum(size * (push / size - exact)**2 for _, size, push, exact in pushed(run, body)) / HALF) / PEAK, 0, "", scale=1)
    return measure


def largest(run):
    """p^2 falls evenly with x^2: the line through the nodes within 0.8 a."""
    rows = [(x * x, (push / size)**2, size) for x, size, push, _ in pushed(run, CYLINDER) if x < 0.8 * HALF]
    return Pair(sqrt(straight_line(rows)[1]), PEAK, "Pa")


def half_width(run):
    """The mean of x^2 under Hertz's pressure is a^2/4."""
    rows = pushed(run, CYLINDER)
    return Pair(2 * sqrt(sum(push * x * x for x, _, push, _ in rows) / sum(push for *_, push, _ in rows)), HALF, "m")


def whole(run):
    return Pair(sum(push for *_, push, _ in pushed(run, CYLINDER)), FORCE / 2, "N/m")


def meshes(run):
    rows = []
    for name, change in (("like", {}), ("unlike, 12 on 15", UNLIKE)):
        for cells, refine in zip((8, 15, 24), MIDDLE):
            one = run.again({**change, "refine": refine})
            inside = sum(1 for x, *_ in pushed(one, CYLINDER) if x < HALF)
            rows.append([f"{name}, {cells}", f"{inside}", *(f"{100 * (m.got / m.expected - 1):+.2f} %" for m in
                         (largest(one), half_width(one))),
                         *(f"{100 * pressures(body)(one).got:.2f} %" for body in (CYLINDER, LOWER))])
    return rows


NODES, WIDE, TOP = "pressures of the nodes, root of the mean square, of the largest", "half width", "largest pressure"
CHECKS = [
    Check(NODES, pressures(CYLINDER), 0.025, "the contact ends inside an element of a quarter of the half width: its two nodes share its "
          "load as one open and one closed node can"),
    Check(WIDE, half_width, 0.01, "from the second moment of the forces; the same element"),
    Check(TOP, largest, 0.01, "inner nodes; the width of the bodies is 20 half widths, which is a share of (1/20)^2"),
    Check("force of the nodes over the load", whole, 1e-5, "equilibrium, to the residual of the relaxation", evidence="invariant"),
    Report("unlike meshes: pressures of the nodes", lambda run: pressures(CYLINDER)(run.again(UNLIKE)),
           "12 on 15 elements; single nodes of unlike meshes do not converge: wavy_faces", full=True),
]

MIDDLE = [0.53334, 1, 1.6, 2.66667]  # of refine, for 8, 15, 24 and 40 elements: the contact ends in the middle of one
STUDIES = [
    Falls(NODES, along="refine", values=MIDDLE, sizes=[8, 15, 24, 40], order=0.8, full=True),
    Falls(WIDE, along="refine", values=MIDDLE[:3], sizes=[8, 15, 24], full=True),
    Falls(TOP, along="refine", values=MIDDLE[:3], sizes=[8, 15, 24], order=1, full=True),
    Table("Errors by the elements along each block.", ["meshes", "nodes inside", "largest pressure", "half width",
                                                      "pressures of the cylinder", "of the block"], meshes, full=True),
]

NO_POISSON = {f"bodies[{b}].material.poisson": 0 for b in (0, 1)}
HALF_LOAD = {"loads[0].value": '"20e6*min(1, t/5e-5)"'}
BREAKS = [
    Breaks(NODES, "eight elements along each block", {"refine": 0.53334}),
    Breaks(NODES, "nodes of a block of an unlike mesh alone",
           {**UNLIKE, "contacts": "[{name: touch, heights: nodes, apexes: lower.z_high, base: cylinder.z_low}]"}, full=True),
    Breaks(WIDE, "Young's modulus for E*: no Poisson effect", NO_POISSON, full=True),
    Breaks(TOP, "Young's modulus for E*: no Poisson effect", NO_POISSON, full=True),
    Breaks("force of the nodes over the load", "a pressure of 20 MPa", HALF_LOAD, full=True),
]


def curve(run):
    rows = [row for row in pushed(run, CYLINDER) if row[0] < 2 * HALF]
    return [("Nereid", [1e3 * x for x, *_ in rows], [push / size / 1e6 for _, size, push, _ in rows])]


def exact(run):
    rows = [row for row in pushed(run, CYLINDER) if row[0] < 2 * HALF]
    places = [2 * HALF * i / 200 for i in range(201)]
    return [("Hertz, mean over a node", [1e3 * x for x, *_ in rows], [mean / 1e6 for *_, mean in rows]),
            ("Hertz", [1e3 * x for x in places], [pressure_at(x, HALF, PEAK) / 1e6 for x in places])]


FIGURES = [Figure("pressure", "from the middle [mm]", "pressure [MPa]", curve, exact,
                  caption="Pressure of the nodes of a cylinder of 100 mm that is pressed on a block.")]
