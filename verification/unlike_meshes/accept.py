"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import reference
from verify import Breaks, Check, Figure, Pair

CATALOGUE = ()
CLAIM = ("Where unlike meshes meet, automatic contact neither stiffens an interface that bends nor bends it without a load; a uniform "
         "pressure passes also where faces are covered in part or friction holds a slope, and edges and corners strike like those of any "
         "mesh.")
EVIDENCE = "invariant"
DRIVER = "scene"

HERE = "verification/unlike_meshes/"
JOINT, SLOPE, EDGE, CORNER = (HERE + name for name in ("joint.yaml", "slope.yaml", "edge.yaml", "corner.yaml"))
MIDDLE, CLOSE = 0.05, 0.012  # [m] where both heights are zero; of the centre of an element beside the interface
LIKE = {"bodies[0].mesh.cells": "[20, 1, 2]"}
NODES = {"contacts[0].heights": "nodes"}
FREE = {"loads[0].value": '"0"'}
HARDER, SOFTER = ({"loads[1].value": f'"{p}*min(1, t/2e-3)"', "loads[2].value": f'"{p}*min(1, t/2e-3)"'} for p in ("280e6", "14e6"))
ONE_PASS = {"contacts": "[{name: touch, heights: nodes, apexes: upper.z_low, base: lower.z_high}]"}
PAIRS = {"contacts": "[{name: one, heights: nodes, apexes: lower.z_high, base: left.z_low}, "
                     "{name: other, heights: nodes, apexes: lower.z_high, base: right.z_low}]"}
PAIRS_FROM_ABOVE = {"contacts": "[{name: one, heights: nodes, apexes: left.z_low, base: lower.z_high}, "
                                "{name: other, heights: nodes, apexes: right.z_low, base: lower.z_high}]"}
LOWER = {"contacts": "[{name: touch, heights: nodes, friction: 0.8, apexes: lower.z_high, base: upper.z_low}]"}
FLAT_SIDE = {"contacts": "[{name: touch, heights: nodes, apexes: block.z_high, base: cube.skin}]", "time.overlap_limit": 100}
FINER = {"bodies[0].mesh.cells": "[19, 19, 3]"}  # than both blocks on it
EXACT = reference(21e6)  # [Pa]


def tip(run):
    return 0.5 * (run.column("tip_upper")[-1] + run.column("tip_lower")[-1])


def bent(run, change):
    """(deflection of the tip by the load alone, what it moves without the load)  [m]"""
    free = tip(run.again({**change, **FREE}))
    return tip(run.again(change)) - free, free


def deflection(change):
    """Over that of like meshes, on which all rules are the same."""
    def measure(run):
        right = bent(run.other("scene", HERE + "case.yaml"), {**change, **LIKE, **NODES})[0]
        return Pair(bent(run, {**change, **run.overrides})[0] / right, 1)
    return measure


def without_a_load(run):
    """What pressure alone bends, over the deflection of like meshes by the load."""
    right = bent(run.other("scene", HERE + "case.yaml"), {**LIKE, **NODES})[0]
    return Pair(bent(run, run.overrides)[1] / right, 0, "", scale=1)


def stress_beside(case, slope, change=None):
    """Error of the stress of the elements beside the interface, root of the mean square of the worst component, over the pressure."""
    def measure(run):
        fields = run.other("scene", case, {**(change or {}), **run.overrides}).frame("body")[1]
        ends, errors = [0, *fields["offsets"]], []
        for begin, end, stress in zip(ends, ends[1:], fields["stress"]):
            nodes = fields["connectivity"][begin:end]
            x, _, z = (sum(fields["points"][n][axis] for n in nodes) / len(nodes) for axis in range(3))
            if abs(z - slope * (x - MIDDLE)) < CLOSE:
                errors.append([got / EXACT - right for got, right in zip(stress, (0, 0, 1, 0, 0, 0))])
        return Pair(max(sqrt(sum(e * e for e in one) / len(errors)) for one in zip(*errors)), 0, "", scale=1)
    return measure


def blow(case, name):
    """Momentum of the cube after the blow beside that by nodes of both sides, over what was exchanged."""
    def measure(run):
        one, other = run.other("scene", case, run.overrides), run.other("scene", case, NODES)
        exchanged = abs(other.column("momentum")[-1] - other.column("momentum")[0])
        return Pair(one.column(name)[-1], other.column(name)[-1], "kg m/s", scale=exchanged)
    return measure


def overlap(case):
    """Of the bodies at any time, as the audit found it."""
    return lambda run: Pair(run.other("scene", case, run.overrides).result("audit_overlap_elements"), 0, "", scale=1)


ASKED = "the bound that the rule was asked for before it was built; two passes keep 0.67 of it"
DEPTH = "a guard lets a corner in by a hundredth of a face, which delays its part of the blow"

CHECKS = [
    Check("deflection over that of like meshes", deflection({}), 0.02, ASKED),
    Check("the same under a fifth of the pressure", deflection(SOFTER), 0.02, ASKED),
    Check("the same under four times the pressure", deflection(HARDER), 0.06, "asked for as well: the coarser strip alone has 0.978"),
    Check("bent without a load, over that deflection", without_a_load, 0.04, "asked for as well; one pass bends by a fifth"),
    Check("a joint over coarse faces: stress beside the interface", stress_beside(JOINT, 0), 0.02, "as asked for of the patch test"),
    Check("a joint over fine faces: stress beside the interface", stress_beside(JOINT, 0, FINER), 0.02,
          "the same, where the faces at the joint are the apexes'"),
    Check("a slope with friction: stress beside the interface", stress_beside(SLOPE, 0.3), 0.02, "the same, with shear on the interface"),
    Check("leaning edge: upward momentum after the blow", blow(EDGE, "momentum"), 0.005, DEPTH),
    Check("leaning edge: momentum aside", blow(EDGE, "aside"), 0.005, "no face of the flat side turns the push away from its normal"),
    Check("leaning edge: overlap in elements", overlap(EDGE), 0.02, "twice what a guard allows"),
    Check("corner on a flat side: upward momentum after the blow", blow(CORNER, "momentum"), 0.005, DEPTH),
    Check("corner on a flat side: overlap in elements", overlap(CORNER), 0.02, "twice what a guard allows"),
]

BREAKS = [
    Breaks("deflection over that of like meshes", "nodes of both sides", NODES),
    Breaks("the same under a fifth of the pressure", "nodes of both sides", NODES),
    Breaks("the same under four times the pressure", "nodes of both sides", NODES),
    Breaks("bent without a load, over that deflection", "nodes of one side", ONE_PASS),
    Breaks("a joint over coarse faces: stress beside the interface", "nodes of the larger block alone", PAIRS),
    Breaks("a joint over fine faces: stress beside the interface", "nodes of the blocks above alone", {**FINER, **PAIRS_FROM_ABOVE}),
    Breaks("a slope with friction: stress beside the interface", "nodes of the lower block alone", LOWER, case=SLOPE),
    Breaks("a slope with friction: stress beside the interface", "too little friction to hold", {"contacts[0].friction": 0.2}, case=SLOPE),
    Breaks("leaning edge: upward momentum after the blow", "nodes of the flat side alone", FLAT_SIDE, case=EDGE),
    Breaks("leaning edge: momentum aside", "friction", {"contacts[0].friction": 0.3}, case=EDGE),
    Breaks("leaning edge: overlap in elements", "nodes of the flat side alone", FLAT_SIDE, case=EDGE),
    Breaks("corner on a flat side: upward momentum after the blow", "nodes of the flat side alone", FLAT_SIDE, case=CORNER),
    Breaks("corner on a flat side: overlap in elements", "nodes of the flat side alone", FLAT_SIDE, case=CORNER),
]


def shape(run):
    """Deflection of the upper face along the strip. [mm] [mm]"""
    fields = run.frame("body")[1]
    return sorted((1e3 * p[0], 1e3 * u[2]) for p, u in zip(fields["points"], fields["displacement"])
                  if abs(p[2] - 0.02) < 1e-9 and p[1] < 1e-9)


def lines(run):
    found = [("points (default)", run), ("nodes of both sides", run.again(NODES)), ("nodes of one side", run.again(ONE_PASS))]
    return [(name, *map(list, zip(*shape(one)))) for name, one in found]


def like(run):
    return [("like meshes", *map(list, zip(*shape(run.again({**LIKE, **NODES})))))]


FIGURES = [Figure("strips", "along the strip [mm]", "deflection [mm]", lines, like,
                  caption="The upper face of two strips that are pressed together and bent, by three rules.")]
