"""Scenes in which two bodies with unlike meshes meet, and what is wrong in each. scripts/interfaces runs them by every rule of contact.

A scene makes the case of two bodies, `upper` over `lower`, with so many cells each along a side. What it measures is known: a uniform
stress, a wave that passes, a deflection over that of like meshes; or it is the same by all rules that are right, as a blow.
"""
import math

STEEL = {"kind": "elastic", "density": "7850 kg/m^3", "young": "210 GPa", "poisson": 0.3}
RULES = {  # of a contact by multipliers: who has the apexes, and further keys
    "nodes of the finer side": ("finer", {"heights": "nodes"}),
    "nodes of the coarser side": ("coarser", {"heights": "nodes"}),
    "two passes": ("finer", {"passes": "two"}),
    "automatic, nodes": ("automatic", {"heights": "nodes"}),
    "points, finer side": ("finer", {"heights": "points"}),
    "points, coarser side": ("coarser", {"heights": "points"}),
    "automatic, points": ("automatic", {"heights": "points"}),
}


def contact_of(rule, upper_cells, lower_cells, upper="upper.z_low", lower="lower.z_high", friction=0.0):
    """The contact of a case by a rule; of like cells the upper body is the finer one."""
    who, keys = RULES[rule]
    keys = {**keys, **({"friction": friction} if friction else {})}
    if who == "automatic":
        return {"name": "contact", "kind": "automatic", **keys}
    upper_is_finer = upper_cells >= lower_cells
    apexes, base = (upper, lower) if upper_is_finer == (who == "finer") else (lower, upper)
    return {"name": "contact", "apexes": apexes, "base": base, **keys}


def box(name, low, high, cells, material=None, **more):
    return {"name": name, "mesh": {"kind": "box", "low": metres(low), "high": metres(high), "cells": list(cells)},
            "material": material or STEEL, **more}


def metres(values):
    return [f"{value:.12g} m" for value in values]


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def centres(run):
    """(centre, stress) of each hexahedron in the last frame, where it began. [m] [Pa]"""
    fields = run.frame("body")[1]
    points, nodes, kinds = fields["points"], fields["connectivity"], fields["types"]
    at, out = 0, []
    for offset, kind, stress in zip(fields["offsets"], kinds, fields["stress"]):
        own = nodes[int(at):int(offset)]
        at = offset
        if kind == 12:
            out.append(([sum(points[int(n)][axis] for n in own) / 8 for axis in range(3)], stress))
    return out


# ------------------------------------------------------------------------------------------------
# Scenes: each gives a case, and a function that measures its run

def patch(rule, upper, lower, pressure=21e6):
    """Two blocks under a uniform pressure. The error of the stress in the elements beside the interface, root of the mean square."""
    height, layers = 0.05, 3
    case = {
        "bodies": [box("lower", [0, 0, -height], [0.1, 0.1, 0], [lower, lower, layers]),
                   box("upper", [0, 0, 0], [0.1, 0.1, height], [upper, upper, layers])],
        "contacts": [contact_of(rule, upper, lower)],
        "planes": [{"name": "ground", "kind": "constrained", "nodes": ["lower.z_low"], "normal": [0, 0, 1]},
                   {"name": "side_x", "kind": "constrained", "nodes": ["lower.x_low", "upper.x_low"], "normal": [1, 0, 0]},
                   {"name": "side_y", "kind": "constrained", "nodes": ["lower.y_low", "upper.y_low"], "normal": [0, 1, 0]}],
        "loads": [{"name": "load", "kind": "pressure", "surface": "upper.z_high", "value": f"{pressure}*min(1, t/1e-4)", "unit": "Pa"}],
        "relaxation": {"residual": 1e-6, "after": "0.1 ms"},
        "probes": [{"name": "force", "quantity": "force", "of": "ground", "component": "z"}],
        "time": {"end": "10 ms"}, "output": {"history_every": "0.1 ms", "frames_every": "10 ms", "precision": "double"}}

    def measure(run):
        beside = [s[2] / -pressure - 1 for centre, s in centres(run) if abs(centre[2]) < 0.6 * height / layers]
        return {"patch stress [%]": 100 * rms(beside)}
    return case, measure


def wave(rule, upper, lower, stress=10e6):
    """A step of stress runs along a bar of two: the error of what passes, and of the stress beside the interface, over the step."""
    side, length, layers = 0.02, 0.2, 40
    material = {**STEEL, "poisson": 0}
    speed = math.sqrt(210e9 / 7850)
    rise, end = 10e-6, 1.55 * length / speed
    case = {
        "bodies": [box("lower", [0, 0, -length], [side, side, 0], [lower, lower, layers], material),
                   box("upper", [0, 0, 0], [side, side, length], [upper, upper, layers], material)],
        "contacts": [contact_of(rule, upper, lower)],
        "loads": [{"name": "load", "kind": "pressure", "surface": "upper.z_high",
                   "value": f"{stress}*(t < {rise} ? t/{rise}*t/{rise}*(3 - 2*t/{rise}) : 1)", "unit": "Pa"}],
        "probes": [{"name": "behind", "quantity": "stress", "of": "lower", "component": "zz"}],
        "time": {"end": f"{end} s"}, "output": {"history_every": "1 us", "frames_every": f"{end} s", "precision": "double"}}

    def measure(run):
        found = centres(run)
        plateau = [s[2] / -stress for c, s in found if -0.2 * length < c[2] < -0.1 * length]
        beside = [s[2] / -stress - 1 for c, s in found if abs(c[2]) < length / layers]
        return {"wave passed [%]": 100 * (sum(plateau) / len(plateau) - 1), "wave beside [%]": 100 * rms(beside)}
    return case, measure


def bend(rule, upper, lower, part, load=True):
    """Two strips, clamped at one end and pressed together by a part of their modulus, are bent. The deflection of the tip by the load, and
    what the tip moves without it, over the deflection of like meshes."""
    young, pressure = 70e9, part * 70e9
    material = {"kind": "elastic", "density": "2700 kg/m^3", "young": "70 GPa", "poisson": 0}
    loads = [{"name": f"press_{name}", "kind": "pressure", "surface": surface, "value": f"{pressure}*min(1, t/0.002)", "unit": "Pa"}
             for name, surface in (("upper", "upper.z_high"), ("lower", "lower.z_low"))]
    if load:
        loads.append({"name": "bend", "kind": "pressure", "surface": "upper.z_high",
                      "value": "280000*max(0, min(1, (t - 0.002)/0.002))", "unit": "Pa"})
    case = {
        "bodies": [box("lower", [0, 0, 0], [0.1, 0.02, 0.01], [lower, 1, 2], material),
                   box("upper", [0, 0, 0.01], [0.1, 0.02, 0.02], [upper, 1, 2], material)],
        "contacts": [contact_of(rule, upper, lower)],
        "planes": [{"name": "clamp", "kind": "fixed", "nodes": ["upper.x_low", "lower.x_low"]},
                   {"name": "side", "kind": "constrained", "nodes": ["upper.y_low", "lower.y_low"], "normal": [0, 1, 0]}],
        "loads": loads, "relaxation": {"residual": 1e-7, "after": "8 ms"},
        "probes": [{"name": "tip_upper", "quantity": "displacement", "of": "upper.x_high", "component": "z"},
                   {"name": "tip_lower", "quantity": "displacement", "of": "lower.x_high", "component": "z"}],
        "time": {"end": "60 ms"}, "output": {"history_every": "0.2 ms", "frames_every": "60 ms"}}

    def measure(run):
        return {"tip": 0.5 * (run.column("tip_upper")[-1] + run.column("tip_lower")[-1])}
    return case, measure


def impact(rule, upper, lower, how, friction=0.0):
    """A cube of 50 mm falls on a block with 10 m/s: with a flat side, an edge that leans, or a corner."""
    speed, size, block = 10.0, 0.05, (0.14, 0.14, 0.06)
    half = size / 2
    turns = {"flat": (0.003, 0.0), "edge": (math.pi / 4, 0.3), "corner": (math.pi / 4, math.atan(math.sqrt(0.5)))}[how]
    cx, sx, cy, sy = math.cos(turns[0]), math.sin(turns[0]), math.cos(turns[1]), math.sin(turns[1])

    def turned(p):  # about x, then about y
        x, y, z = p
        y, z = cx * y - sx * z, sx * y + cx * z
        return [cy * x + sy * z, y, -sy * x + cy * z]
    lowest = min(turned([a * half, b * half, c * half])[2] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1))
    # one rotation of both: by its matrix
    columns = [turned([1, 0, 0]), turned([0, 1, 0]), turned([0, 0, 1])]
    trace = columns[0][0] + columns[1][1] + columns[2][2]
    angle = math.acos(max(-1.0, min(1.0, (trace - 1) / 2)))
    axis = [columns[1][2] - columns[2][1], columns[2][0] - columns[0][2], columns[0][1] - columns[1][0]]
    case = {
        "bodies": [box("lower", [-block[0] / 2, -block[1] / 2, -block[2]], [block[0] / 2, block[1] / 2, 0],
                       [lower, lower, max(2, lower // 2)]),
                   box("upper", [-half] * 3, [half] * 3, [upper] * 3,
                       rotate={"axis": axis, "angle": f"{angle:.15g} rad"}, move=metres([0.002, 0.001, 1e-6 - lowest]))],
        "contacts": [contact_of(rule, upper, lower * size / block[0], "upper.skin", "lower.skin", friction)],
        "planes": [{"name": "ground", "kind": "fixed", "nodes": ["lower.z_low"]}],
        "initial": [{"body": "upper", "velocity": ["0", "0", f"{-speed}"], "unit": "m/s"}],
        "probes": [{"name": f"momentum_{axis}", "quantity": "momentum", "of": "upper", "component": axis} for axis in "xyz"],
        "time": {"end": "0.4 ms"}, "output": {"history_every": "4 us", "frames_every": "0.4 ms"}}

    def measure(run):
        mass = 7850 * size**3
        v = [run.column(f"momentum_{axis}")[-1] / mass for axis in "xyz"]
        return {f"{how} speed [m/s]": v[2], f"{how} aside [%]": 100 * math.hypot(v[0], v[1]) / (v[2] + speed),
                f"{how} overlap": run.result("audit_overlap_elements"), f"{how} created": run.created()}
    return case, measure
