"""How close is close enough, why, and what must break."""
from math import log

from reference import AMPLITUDE, OMEGA, displacement, stress
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ("E-8",)
CLAIM = "Displacements of elastic solids converge with the second order in mesh and step together, stresses at the middle of elements too."
EVIDENCE = "order"
DRIVER = "scene"

FULL = {"bodies[0].element.kind": "full"}
WARPED = {"bodies[0].mesh.map": '["x + 0.06*sin(2*pi*(x - 0.1))*sin(pi*(y - 0.2))", "y + 0.05*sin(2*pi*(y - 0.2))*sin(pi*(z - 0.3))", "z - 0.06*sin(2*pi*(z - 0.3))*sin(pi*(x - 0.1))"]'}


def cells(n):
    return {"bodies[0].mesh.cells": f"[{n}, {n}, {n}]"}


def rms(rows):
    rows = list(rows)
    return (sum(sum(v * v for v in row) for row in rows) / len(rows))**0.5


def difference(got, exact):
    return [[a - b for a, b in zip(one, there)] for one, there in zip(got, exact)]


def over_frames(run, error, field):
    """The largest of all frames, over the largest exact one: no frame has its cosine near zero alone."""
    pairs = [error(*run.frame("body", number)) for number in range(1, 11)]
    return max(wrong for wrong, _ in pairs) / max(size for _, size in pairs)


def displacement_error(t, fields):
    """Root mean squares over the nodes: of what is wrong, of what is right. [m]"""
    X = [[p - u for p, u in zip(point, move)] for point, move in zip(fields["Points"], fields["displacement"])]
    exact = [displacement(*at, t) for at in X]
    return rms(difference(fields["displacement"], exact)), rms(exact)


def stress_error(t, fields):
    """The same of the stress, at the middle of each element. [Pa]"""
    points, nodes = fields["Points"], fields["connectivity"]
    middles = [[sum(points[n][i] for n in nodes[e:e + 8]) / 8 for i in range(3)] for e in range(0, len(nodes), 8)]
    exact = [stress(*at, t) for at in middles]
    return rms(difference(fields["stress"], exact)), rms(exact)


def errors(run, change):
    other = run.again(change)
    return over_frames(other, displacement_error, "displacement"), over_frames(other, stress_error, "stress")


def order(change, which, coarse, fine):
    """Of the error between two meshes, less than which it must not fall."""
    def measure(run):
        a, b = (errors(run, {**change, **cells(n)})[which] for n in (coarse, fine))
        return Pair(min(log(a / b) / log(fine / coarse), 2), 2, "")
    return measure
