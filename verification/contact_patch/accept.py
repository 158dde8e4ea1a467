"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import reference
from verify import Breaks, Check, Pair, Report, Table

CLAIM = "How uniformly a uniform pressure passes through two meshes that do not match, for every formulation of contact."
EVIDENCE = "exact"
DRIVER = "scene"

PRESSURE, PENALTY = 1.0, 2e7  # [Pa] [Pa/m]
EXACT = reference(PRESSURE, 1e6, 0.5, PENALTY)
CYLINDERS = "verification/contact_patch/cylinders.yaml"
MATCHING = {"bodies[1].mesh.cells": "[4, 4, 2]"}
EXCHANGED = {"contacts[0].apexes": "lower.z_high", "contacts[0].base": "upper.z_low"}
EXCHANGED_CYLINDERS = {"contacts[0].apexes": "lower.top", "contacts[0].base": "upper.bottom"}


def norms(values, exact):
    """(root of the mean square, largest) error over what is exact."""
    errors = [abs(v / exact - 1) for v in values]
    return sqrt(sum(e * e for e in errors) / len(errors)), max(errors)


def stresses(run):
    """Axial stress of every solid element. [Pa]"""
    fields = run.frame("body")[1]
    return [s[2] for s, kind in zip(fields["stress"], fields["types"]) if kind == 12]


def pressures(run):
    """Of every apex; ParaView files have each element twice, as facet and as line. [Pa]"""
    fields = run.frame("contact")[1]
    return [p for p, part in zip(fields["contact_pressure"], fields["part"]) if part == 0]


def overlap(run):
    """The apex whose overlap is farthest from exact."""
    fields = run.frame("contact")[1]
    return Pair(-max(fields["gap"], key=lambda gap: abs(-gap - EXACT["overlap"])), EXACT["overlap"], "m")


def resultant(run):
    return Pair(abs(run.column("resultant")[-1]), PRESSURE, "N")


def stress_error(which):
    return lambda run: Pair(norms(stresses(run), EXACT["stress"])[which], 0, "", scale=1)


def matching(measure):
    return lambda run: measure(run.again(MATCHING))


FORMULATIONS = [
    ("as it is: consistent weights, area of the apex", {}), ("sides exchanged", EXCHANGED), ("two passes", {"contacts[0].passes": "two"}),
    ("area of the base", {"contacts[0].area": "base"}), ("weights of the paper", {"contacts[0].weights": "paper"}),
    ("area and weights of the paper", {"contacts[0].area": "base", "contacts[0].weights": "paper"}),
    ("friction 0.3", {"contacts[0].friction": 0.3}), ("bonded", {"contacts[0].kind": "bonded"}),
    ("penalty ten times harder", {"contacts[0].penalty": "2e8 Pa/m"}), ("penalty ten times softer", {"contacts[0].penalty": "2e6 Pa/m"}),
]


def row(name, run):
    """Errors against the pressure that the resultant stands for, so that a harder penalty is compared with itself."""
    return [name, *(f"{100 * n:.2g} %" for n in (*norms(stresses(run), -mean_pressure(run)), *norms(closed(run), mean_pressure(run)))),
            f"{len(closed(run))} of {len(pressures(run))}"]


def mean_pressure(run):
    return -0.5 * (run.column("stress_lower")[-1] + run.column("stress_upper")[-1])


def closed(run):
    return [p for p in pressures(run) if p > 0]


def grids(run):
    rows = [row("4 x 4 on 4 x 4, matching", run.again(MATCHING)), row("3 x 3 on 4 x 4", run), row("3 x 3 on 4 x 4, sides exchanged", run.again(EXCHANGED))]
    turned = {"bodies[1].turn": "{axis: [0, 0, 1], angle: 90 deg, about: [0.5 m, 0.5 m, 0 m]}"}
    rows.append(row("6 x 6 on 8 x 8", run.again({"bodies[0].mesh.cells": "[8, 8, 4]", "bodies[1].mesh.cells": "[6, 6, 4]"})))
    cylinders = run.other("scene", CYLINDERS)
    rows.append(row("cylinders turned by 45 degrees", cylinders))
    rows.append(row("the same, sides exchanged", cylinders.again(EXCHANGED_CYLINDERS)))
    return rows


def formulations(run):
    return [row(name, run.again(change)) for name, change in FORMULATIONS]


COLUMNS = ["", "stress, root mean square", "stress, largest", "pressure, root mean square", "pressure, largest", "apexes closed"]

CHECKS = [
    Check("resultant, matching grids", matching(resultant), 1e-3, "equilibrium under the held ends"),
    Check("overlap of every apex, matching grids", matching(overlap), 1e-3, "pressure over penalty at each apex"),
    Check("stress of every element, matching grids", matching(stress_error(1)), 1e-3, "uniform"),
    Check("resultant, 3 x 3 on 4 x 4", resultant, 0.02, "equilibrium; an uneven interface is a little more compliant"),
    Report("stress of every element, 3 x 3 on 4 x 4", stress_error(1), "an apex pushes one facet: no one-pass contact on nodes passes"),
]

STUDIES = [
    Table("Errors of axial stress and contact pressure over their mean, by grid.", ["grid", *COLUMNS[1:]], grids),
    Table("The same on 3 x 3 on 4 x 4, by formulation.", ["formulation", *COLUMNS[1:]], formulations),
]

BREAKS = [
    Breaks("overlap of every apex, matching grids", "a penalty twice as hard", {"contacts[0].penalty": "4e7 Pa/m"}),
    Breaks("stress of every element, matching grids", "the area of the base in place of the apex's own", {"contacts[0].area": "base"}),
    Breaks("resultant, 3 x 3 on 4 x 4", "a penalty ten times too soft", {"contacts[0].penalty": "2e6 Pa/m"}),
]
