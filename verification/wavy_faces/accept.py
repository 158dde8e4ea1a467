"""How close is close enough, why, and what must break."""
from math import cos, log, pi, sqrt

from reference import amplitude, compliances, free_behind, smooth_plane_behind, squeeze_modulus, weighted_mean
from verify import Breaks, Check, Falls, Figure, Miss, Pair, Table

CATALOGUE = ()
CLAIM = ("Where two faces that differ by a cosine are pressed until they touch everywhere, pressures of like meshes converge with second "
         "order, and of unlike meshes the displacement and the amplitude of the pressure; the pressure of single nodes does not converge.")
EVIDENCE = "exact"
DRIVER = "scene"

LENGTH, HEIGHT, WIDTH, GAP, PRESSURE, YOUNG, POISSON = 0.05, 0.05, 0.005, 0.8e-6, 4e6, 200e9, 0.3  # [m] [Pa]; GAP: of the cosine
K = pi / LENGTH                                                                                # [1/m]
FREE, FLAT = (rear(*compliances(K, HEIGHT, YOUNG, POISSON)) for rear in (free_behind, smooth_plane_behind))  # [m/Pa]
WAVE = amplitude(GAP, FREE, FLAT)                                                              # [Pa]
LIKE = {"bodies[0].mesh.cells": "[10, 1, 10]"}
NODES = {"contacts": "[{name: touch, kind: automatic, heights: nodes}]"}
LOWER, UPPER = 0, 1


def gap(x):
    """Before the load. [m]"""
    return GAP * (1 - cos(K * x))


def exact_displacement(body, x):
    """Of the interface, upwards. [m]"""
    lower = -PRESSURE * HEIGHT / squeeze_modulus(YOUNG, POISSON) - WAVE * FLAT * cos(K * x)
    return lower if body == LOWER else lower - gap(x)


def interface(run, body):
    """[(place, pressure, exact mean of it over the node, displacement)] of one face, along the wave. [m] [Pa] [Pa] [m]"""
    fields = run.frame("body")[1]
    points, nodes, rows = fields["points"], fields["connectivity"], {}
    for first in range(0, len(nodes), 8):
        corners = nodes[first:first + 8]
        if (sum(points[n][2] for n in corners) > 0) == (body == UPPER):
            for n in corners:
                x, _, z = points[n]
                if abs(z - (gap(x) if body == UPPER else 0)) < 1e-9:
                    rows.setdefault(round(x, 8), set()).add(n)
    places, found = sorted(rows), []
    for left, x, right in zip([places[0], *places], places, [*places[1:], places[-1]]):
        push = abs(sum(fields["contact_force"][n][2] for n in rows[x]))
        moved = sum(fields["displacement"][n][2] for n in rows[x]) / len(rows[x])
        found.append((x, push / (WIDTH * (right - left) / 2), PRESSURE + WAVE * weighted_mean(K, x, left, right), moved))
    return found


def shares(rows):
    """Of each node in the length."""
    places = [row[0] for row in rows]
    return [(right - left) / 2 / LENGTH for left, right in zip([places[0], *places], [*places[1:], places[-1]])]


def pressures(body):
    """Of the nodes against the exact mean over each, root of the mean square, over the amplitude."""
    def measure(run):
        rows = interface(run, body)
        return Pair(sqrt(sum(part * (row[1] - row[2])**2 for part, row in zip(shares(rows), rows))) / WAVE, 0, "", scale=1)
    return measure


def displacement(run):
    """Of the lower face, root of the mean square, over the amplitude of the displacement."""
    rows = interface(run, LOWER)
    squares = sum(part * (row[3] - exact_displacement(LOWER, row[0]))**2 for part, row in zip(shares(rows), rows))
    return Pair(sqrt(squares) / (WAVE * FLAT), 0, "", scale=1)


def wave(run):
    """Amplitude of the pressure on the lower face, by the work of its nodal forces in a cosine."""
    rows = interface(run, LOWER)
    return Pair(2 * sum(part * row[1] * cos(K * row[0]) for part, row in zip(shares(rows), rows)), WAVE, "Pa")


def like(measure):
    return lambda run: measure(run.again({**LIKE, **run.overrides}))


def order(measure, change):
    """Observed between the case and one of four times as many cells each way."""
    def of(run):
        coarse, fine = (measure(run.again({**change, **run.overrides, "refine": n})).error() for n in (1, 4))
        return Pair(log(coarse / fine) / log(4), 1, "")
    return of


NODES_UPPER, NODES_LOWER = "unlike meshes: pressures of the upper nodes", "unlike meshes: pressures of the lower nodes"
MOVED, COSINE = "unlike meshes: displacement of the interface", "unlike meshes: amplitude of the pressure"
EVEN, EVEN_MOVED = "like meshes: pressures of the nodes", "like meshes: displacement of the interface"

CHECKS = [
    Check(EVEN, like(pressures(LOWER)), 0.003, "the elements' error, of second order: ten of them for half a wave"),
    Check(EVEN_MOVED, like(displacement), 0.004, "the same"),
    Check(COSINE, wave, 0.015, "the elements' error, of second order; the lower block has eight for half a wave"),
    Check(MOVED, displacement, 0.015, "pressures that are wrong by turns move a node by a part of its face: first order"),
    Check(NODES_LOWER, pressures(LOWER), 0.04, "heights at four points of a face integrate a base with kinks below them to some per cent"),
    Check(NODES_UPPER, pressures(UPPER), 0.04, "the same"),
    Miss("unlike meshes: order of the pressures of the nodes", order(pressures(LOWER), {}), 0.5,
         "a segment-wise integration of the heights gives 1 or more",
         "weights and points are those of the faces of the apexes, and edges of the base lie anywhere between these points. So the shares "
         "of neighbouring nodes are wrong by a part that does not depend on the size of the faces, by turns up and down: the pressure of "
         "a node does not converge, its mean over some nodes does", full=True),
]


def meshes(run):
    rows = []
    for name, change in (("like", LIKE), ("unlike", {}), ("unlike, two passes of nodes", NODES)):
        for refine in (1, 2, 4):
            one = run.again({**change, "refine": refine})
            rows.append([f"{name}, {10 * refine}", *(f"{100 * measure(one).error():.3g} %" for measure in (
                pressures(LOWER), pressures(UPPER), displacement, wave))])
    return rows


STUDIES = [
    Falls(EVEN, along="refine", values=[1, 2, 4], order=1.8, full=True),
    Falls(EVEN_MOVED, along="refine", values=[1, 2, 4], order=1.8, full=True),
    Falls(MOVED, along="refine", values=[1, 2, 4], order=0.9, full=True),
    Falls(COSINE, along="refine", values=[1, 2, 4], order=1.8, full=True),
    Table("Errors of pressures and displacement, root of the mean square, over their amplitudes, and of the amplitude of the pressure, by "
          "the elements of the upper block over half a wave.",
          ["meshes", "lower nodes", "upper nodes", "displacement", "amplitude"], meshes, full=True),
]

ONE_PASS = {"contacts": "[{name: touch, heights: nodes, apexes: upper.z_low, base: lower.z_high}]"}
SOFTER = {"bodies[0].material.young": "190 GPa"}
BREAKS = [
    Breaks(NODES_LOWER, "nodes of the upper block alone", ONE_PASS),
    Breaks(NODES_UPPER, "nodes of the lower block alone",
           {"contacts": "[{name: touch, heights: nodes, apexes: lower.z_high, base: upper.z_low}]"}),
    Breaks(MOVED, "a lower block of 190 GPa", SOFTER),
    Breaks(COSINE, "a lower block of 190 GPa", SOFTER),
    Breaks(EVEN, "a lower block of 190 GPa", SOFTER),
    Breaks(EVEN_MOVED, "a lower block of 190 GPa", SOFTER),
    Breaks(EVEN, "half as many elements", {"refine": 0.5}),
]


def curves(run):
    found = []
    for name, one in (("unlike meshes, lower", run), ("like meshes, lower", run.again(LIKE))):
        rows = interface(one, LOWER)
        found.append((name, [1e3 * row[0] for row in rows], [row[1] / 1e6 for row in rows]))
    return found


def exact(_):
    places = [LENGTH * i / 100 for i in range(101)]
    return [("exact", [1e3 * x for x in places], [(PRESSURE + WAVE * cos(K * x)) / 1e6 for x in places])]


FIGURES = [Figure("pressure", "along half a wave [mm]", "pressure of the nodes [MPa]", curves, exact,
                  caption="Pressure of the nodes of the lower face, of unlike and of like meshes.")]
