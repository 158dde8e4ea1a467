"""Scenes in which flat faces of two bodies with unlike meshes meet, and what is wrong in each. scripts/interfaces runs them by every rule
of contact; interface_round.py has curved faces, interface_blows.py impacts and slides.

A scene makes a case of bodies with so many cells each along a side. What it measures is known: a uniform stress, a wave that passes, a
deflection over that of like meshes; or it is the same by all rules that are right, as a blow.
"""
import math

STEEL = {"kind": "elastic", "density": "7850 kg/m^3", "young": "210 GPa", "poisson": 0.3}
EVEN = {**STEEL, "poisson": 0}  # nothing swells aside
RULES = {  # of a contact by multipliers: who has the apexes, and further keys
    "nodes of the finer side": ("finer", {"heights": "nodes"}),
    "nodes of the coarser side": ("coarser", {"heights": "nodes"}),
    "two passes": ("finer", {"passes": "two"}),
    "automatic, nodes": ("automatic", {"heights": "nodes"}),
    "points, finer side": ("finer", {"heights": "points"}),
    "points, coarser side": ("coarser", {"heights": "points"}),
    "automatic, points": ("automatic", {"heights": "points"}),
}


def contacts_of(rule, *pairs, **more):
    """The contacts of a case by a rule. A pair has two surfaces and the sizes of their faces; of like faces the first one is the finer."""
    who, keys = RULES[rule]
    if who == "automatic":
        return [{"name": "contact", "kind": "automatic", **keys, **more}]
    found = []
    for number, (one, size, other, size_of_other) in enumerate(pairs):
        apexes, base = (one, other) if (size <= size_of_other) == (who == "finer") else (other, one)
        found.append({"name": f"contact_{number}", "apexes": apexes, "base": base, **keys, **more})
    return found


def box(name, low, high, cells, material=None, **more):
    return {"name": name, "mesh": {"kind": "box", "low": metres(low), "high": metres(high), "cells": list(cells)},
            "material": material or STEEL, **more}


def metres(values):
    return [f"{value:.12g} m" for value in values]


def pulse(duration):
    """A smooth pulse over that time from t = 0, whose integral is 1 [1/s]; in the terms of a case.

    >>> pulse(2.0)
    '(t < 2.0 ? 30*(t/2.0)^2*(1 - t/2.0)^2/2.0 : 0)'
    """
    return f"(t < {duration!r} ? 30*(t/{duration!r})^2*(1 - t/{duration!r})^2/{duration!r} : 0)"


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


def output(end, every):
    return {"time": {"end": f"{end} s"}, "output": {"history_every": f"{every} s", "frames_every": f"{end} s", "precision": "double"}}


# ------------------------------------------------------------------------------------------------
# Scenes: each gives a case, and a function that measures its run

def patch(rule, upper, lower, pressure=21e6):
    """Two blocks under a uniform pressure. The error of the stress in the elements beside the interface, root of the mean square."""
    height, layers = 0.05, 3
    case = {
        "bodies": [box("lower", [0, 0, -height], [0.1, 0.1, 0], [lower, lower, layers]),
                   box("upper", [0, 0, 0], [0.1, 0.1, height], [upper, upper, layers])],
        "contacts": contacts_of(rule, ("upper.z_low", 1 / upper, "lower.z_high", 1 / lower)),
        "planes": [{"name": "ground", "kind": "constrained", "nodes": ["lower.z_low"], "normal": [0, 0, 1]},
                   {"name": "side_x", "kind": "constrained", "nodes": ["lower.x_low", "upper.x_low"], "normal": [1, 0, 0]},
                   {"name": "side_y", "kind": "constrained", "nodes": ["lower.y_low", "upper.y_low"], "normal": [0, 1, 0]}],
        "loads": [{"name": "load", "kind": "pressure", "surface": "upper.z_high", "value": f"{pressure}*min(1, t/1e-4)", "unit": "Pa"}],
        "relaxation": {"residual": 1e-6, "after": "0.1 ms"}, **output(0.01, 1e-4)}

    def measure(run):
        return {"stress [%]": 100 * rms([s[2] / -pressure - 1 for centre, s in centres(run) if abs(centre[2]) < 0.6 * height / layers])}
    return case, measure


def joint(rule, lower, left, right, pressure=21e6):
    """Two blocks beside each other on a larger one, all under the same pressure: verification/unlike_meshes/joint.yaml. The joint lies
    within faces of the larger block, which are covered in part by each. The error of the stress beside the interface."""
    height, layers, width = 0.05, 3, 0.04
    upper = (("left", 0, width, left), ("right", width, 0.1, right))
    pairs = [(f"{name}.z_low", math.sqrt((end - begin) * 0.1 / math.prod(cells)), "lower.z_high", 0.1 / lower)
             for name, begin, end, cells in upper]
    case = {
        "bodies": [box("lower", [0, 0, -height], [0.1, 0.1, 0], [lower, lower, layers], EVEN),
                   *(box(name, [begin, 0, 0], [end, 0.1, height], [*cells, layers], EVEN) for name, begin, end, cells in upper)],
        "contacts": contacts_of(rule, *pairs),
        "planes": [{"name": "ground", "kind": "constrained", "nodes": ["lower.z_low"], "normal": [0, 0, 1]},
                   {"name": "end", "kind": "constrained", "nodes": ["lower.x_low", "left.x_low"], "normal": [1, 0, 0]},
                   {"name": "side", "kind": "constrained", "nodes": ["lower.y_low", "left.y_low", "right.y_low"], "normal": [0, 1, 0]},
                   {"name": "right_end", "kind": "constrained", "nodes": ["right.x_high"], "normal": [1, 0, 0]}],
        "loads": [{"name": f"press_{name}", "kind": "pressure", "surface": f"{name}.z_high", "value": f"{pressure}*min(1, t/1e-4)",
                   "unit": "Pa"} for name, *_ in upper],
        "relaxation": {"residual": 1e-6, "after": "0.1 ms"}, **output(0.02, 1e-4)}

    def measure(run):
        return {"stress [%]": 100 * rms([s[2] / -pressure - 1 for centre, s in centres(run) if abs(centre[2]) < 0.6 * height / layers])}
    return case, measure


def shear(rule, upper, lower, pressure=21e6, part=0.3):
    """Two blocks, pressed and then sheared by a part of the pressure, under so much friction that all sticks. The nodes of top, bottom and
    two sides are moved as a uniform compression and a uniform shear move them. Errors of both stresses beside the interface."""
    height, layers, young, ramp = 0.05, 3, 210e9, 1e-3
    shortened, slope = pressure / young, part * pressure / (young / 2)
    held = [f"{body}.{face}" for body in ("lower", "upper") for face in ("x_low", "x_high")] + ["lower.z_low", "upper.z_high"]
    case = {
        "bodies": [box("lower", [0, 0, -height], [0.1, 0.1, 0], [lower, lower, layers], EVEN),
                   box("upper", [0, 0, 0], [0.1, 0.1, height], [upper, upper, layers], EVEN)],
        "contacts": contacts_of(rule, ("upper.z_low", 1 / upper, "lower.z_high", 1 / lower), friction=0.8),
        "planes": [{"name": "press", "kind": "driven", "nodes": held,
                    "velocity": {"value": ["0", "0", f"-{shortened!r}*(z + {height})*{pulse(ramp)}"], "unit": "m/s"}},
                   {"name": "shear", "kind": "driven", "nodes": held,
                    "velocity": {"value": [f"{slope!r}*(z + {height})*{pulse(ramp)}", "0", "0"], "unit": "m/s"}}],
        "stages": [{"name": "pressed", "duration": "10 ms", "off": ["shear"], "relaxation": {"residual": 1e-6, "after": f"{ramp} s"}},
                   {"name": "sheared", "duration": "10 ms", "off": ["press"], "relaxation": {"residual": 1e-6, "after": f"{ramp} s"}}],
        "time": {"created_limit": 10},  # between driven nodes restitution is booked that nothing passed: 1e-3 of the energy of the scene
        "output": {"history_every": "0.1 ms", "frames_every": "20 ms", "precision": "double"}}

    def measure(run):
        beside = [s for centre, s in centres(run) if abs(centre[2]) < 0.6 * height / layers]
        return {"shear stress [%]": 100 * rms([s[5] / (part * pressure) - 1 for s in beside]),
                "normal stress [%]": 100 * rms([s[2] / -pressure - 1 for s in beside])}
    return case, measure


def wave(rule, upper, lower, stress=10e6):
    """A step of stress runs along a bar of two: the error of what passes, and of the stress beside the interface, over the step."""
    side, length, layers = 0.02, 0.2, 20 * max(upper, lower) // 3
    speed = math.sqrt(210e9 / 7850)
    rise, end = 10e-6, 1.55 * length / speed
    case = {
        "bodies": [box("lower", [0, 0, -length], [side, side, 0], [lower, lower, layers], EVEN),
                   box("upper", [0, 0, 0], [side, side, length], [upper, upper, layers], EVEN)],
        "contacts": contacts_of(rule, ("upper.z_low", 1 / upper, "lower.z_high", 1 / lower)),
        "loads": [{"name": "load", "kind": "pressure", "surface": "upper.z_high",
                   "value": f"{stress}*(t < {rise} ? t/{rise}*t/{rise}*(3 - 2*t/{rise}) : 1)", "unit": "Pa"}], **output(end, 1e-6)}

    def measure(run):
        found = centres(run)
        plateau = [s[2] / -stress for c, s in found if -0.2 * length < c[2] < -0.1 * length]
        beside = [s[2] / -stress - 1 for c, s in found if abs(c[2]) < length / layers]
        return {"passed [%]": 100 * (sum(plateau) / len(plateau) - 1), "beside [%]": 100 * rms(beside)}
    return case, measure


def bend(rule, upper, lower, part):
    """Two strips, clamped at one end and pressed together by a part of their modulus, are bent: what the pressure moves the tip, and then
    the load."""
    young, pressure = 70e9, part * 70e9
    material = {"kind": "elastic", "density": "2700 kg/m^3", "young": "70 GPa", "poisson": 0}
    case = {
        "bodies": [box("lower", [0, 0, 0], [0.1, 0.02, 0.01], [lower, 1, 2], material),
                   box("upper", [0, 0, 0.01], [0.1, 0.02, 0.02], [upper, 1, 2], material)],
        "contacts": contacts_of(rule, ("upper.z_low", 1 / upper, "lower.z_high", 1 / lower)),
        "planes": [{"name": "clamp", "kind": "fixed", "nodes": ["upper.x_low", "lower.x_low"]},
                   {"name": "side", "kind": "constrained", "nodes": ["upper.y_low", "lower.y_low"], "normal": [0, 1, 0]}],
        "loads": [{"name": f"press_{name}", "kind": "pressure", "surface": surface, "value": f"{pressure}*min(1, t/0.002)", "unit": "Pa"}
                  for name, surface in (("upper", "upper.z_high"), ("lower", "lower.z_low"))]
        + [{"name": "bend", "kind": "pressure", "surface": "upper.z_high", "value": "280000*min(1, t/0.002)", "unit": "Pa"}],
        "stages": [{"name": name, "duration": "60 ms", "off": off, "relaxation": {"residual": 1e-7, "after": "4 ms"}}
                   for name, off in (("pressed", ["bend"]), ("bent", []))],
        "probes": [{"name": "tip_upper", "quantity": "displacement", "of": "upper.x_high", "component": "z"},
                   {"name": "tip_lower", "quantity": "displacement", "of": "lower.x_high", "component": "z"}],
        "output": {"history_every": "0.2 ms", "frames_every": "120 ms"}}

    def measure(run):
        tip = [0.5 * (a + b) for a, b in zip(run.column("tip_upper"), run.column("tip_lower"))]
        pressed = max(row for row, t in enumerate(run.column("time")) if t <= run.result("bent_began"))
        return {"without load": tip[pressed], "by the load": tip[-1] - tip[pressed]}
    return case, measure


def bend_over(found, like):
    """The deflection beside that of like meshes."""
    right = like["by the load"]
    return {"deflection off like meshes [%]": 100 * (found["by the load"] / right - 1),
            "without load [%]": 100 * found["without load"] / right}
