"""Curved faces with unlike meshes that meet: two balls, and two rings. See interface_scenes.py."""
import math

import verify
import yaml
from interface_scenes import STEEL, centres, contacts_of, metres, output, rms
from runs import ROOT

BALLS = ROOT / "verification/hertz_at_rest/balls.yaml"


class FromAbove:
    """A run of the balls, seen from the other ball: that stands at the origin then, with its pole up."""

    def __init__(self, run):
        self.run = run

    def frame(self, collection):
        time, fields = self.run.frame(collection)
        turned = {name: [(x, y, -z) for x, y, z in fields[name]] for name in ("displacement", "contact_force")}
        return time, {**fields, **turned, "points": [(x, y, 0.02 - z) for x, y, z in fields["points"]]}


def hertz(rule, ball, other):
    """Two balls that are pressed together: verification/hertz_at_rest/balls.yaml. The force, and how uneven the nodal pressures of each
    ball are: root of the mean square over the circle of contact, beside Hertz's, over the peak."""
    case = yaml.safe_load(BALLS.read_text(encoding="utf-8"))
    for body, cells in zip(case["bodies"], (ball, other)):
        body["mesh"]["cells_core"] = body["mesh"]["cells_ring"] = cells
    case["contacts"] = contacts_of(rule, ("ball.surface", 1 / ball, "other.surface", 1 / other))
    uneven = verify.Case("hertz_at_rest").accept.over_the_circle

    def measure(run):
        return {"force": run.column("force")[-1], "pressures, finer ball [%]": 100 * uneven(run).got,
                "pressures, coarser ball [%]": 100 * uneven(FromAbove(run)).got}
    return case, measure


def hertz_over(found, like):
    """The force beside that of like meshes."""
    off = 100 * (found.pop("force") / like["force"] - 1)
    return {"force off like meshes [%]": off, **found}


def radial_stress(run, low, high):
    """Of the elements whose centres are that far from the axis. [Pa]"""
    found = []
    for (x, y, _), s in centres(run):
        if low < math.hypot(x, y) < high:
            found.append((s[0] * x * x + s[1] * y * y + 2 * s[3] * x * y) / (x * x + y * y))
    return found


def rings(rule, inner, outer, pressure=1e6):
    """A quarter of a ring within another one, in plane strain, pressed from inside: how far the outer surface goes, and how uneven the
    radial stress is in each layer of elements beside the interface, root of the mean square. Chords of unlike faces overlap at the start,
    which is accepted; the rings are so soft that they grow by some times that."""
    bore, joint, rim, depth, layers = 0.03, 0.05, 0.07, 0.004, 4
    rubber = {**STEEL, "young": "50 MPa", "density": "1000 kg/m^3"}

    def ring(name, radii, around):
        return {"name": name, "material": rubber,
                "mesh": {"kind": "revolved", "radii": metres(radii), "heights": metres([0, depth]), "cells_radial": [layers],
                         "cells_along": [1], "filled": ["x"], "angle": "90 deg", "cells_around": around}}
    case = {
        "bodies": [ring("inner", [bore, joint], inner), ring("outer", [joint, rim], outer)],
        "contacts": contacts_of(rule, ("inner.out_1", 1 / inner, "outer.in_0", 1 / outer), initial_penetration="accept"),
        "planes": [{"name": f"plane_{number}", "kind": "symmetry", "nodes": [f"inner.{face}", f"outer.{face}"], "normal": normal}
                   for number, (face, normal) in enumerate((("first_plane", [0, 1, 0]), ("second_plane", [1, 0, 0]),
                                                            ("down_0", [0, 0, 1]), ("up_1", [0, 0, 1])))],
        "loads": [{"name": "load", "kind": "pressure", "surface": "inner.in_0", "value": f"{pressure}*min(1, t/2e-3)", "unit": "Pa"}],
        "relaxation": {"residual": 1e-6, "after": "2 ms"}, **output(0.05, 5e-4)}

    def measure(run):
        fields = run.frame("body")[1]
        grown = [(x * u[0] + y * u[1]) / math.hypot(x, y) for (x, y, _), u in zip(fields["points"], fields["displacement"])
                 if math.hypot(x, y) > rim - 1e-6]
        layer, errors = (rim - joint) / layers, []
        for low, high in ((joint - layer, joint), (joint, joint + layer)):
            radial = radial_stress(run, low, high)
            errors += [one * len(radial) / sum(radial) - 1 for one in radial]
        return {"growth": sum(grown) / len(grown), "radial stress [%]": 100 * rms(errors)}
    return case, measure


def rings_over(found, like):
    """The growth of the outer surface beside that of like meshes."""
    off = 100 * (found.pop("growth") / like["growth"] - 1)
    return {"growth off like meshes [%]": off, **found}
