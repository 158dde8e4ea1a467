"""How close is close enough, why, and what must break."""
from reference import FACE, FINEST, MESHES
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ()
CLAIM = ("The cap of a ball pressed on a block that is four contact radii deep has the force of CalculiX, and the face of the block has "
         "its displacements, from the rim of the contact to three times its radius.")
EVIDENCE = "benchmark"
DRIVER = "scene"

FORCE = MESHES[FINEST]["force"]
PLACES = {"off_1": "rim of the contact, 1.51 mm off the axis", "off_2": "2.85 mm off the axis", "off_3": "4.89 mm off the axis"}
FINER = {"refine": 2}


def force(run):
    return Pair(-run.column("force")[-1], FORCE, "N")


def balance(run):
    """Force of the base against that which presses the cap."""
    return Pair(run.column("reaction")[-1], -run.column("force")[-1], "N")


def sunk(name):
    return lambda run: Pair(run.column(name)[-1], MESHES[FINEST][name], "m")


def finer(measure):
    return lambda run: measure(run.again({**run.overrides, **FINER}))


def meshes(run):
    rows = []
    for said, keys in (("10 x 8, 12 x 8", {}), ("20 x 16, 24 x 16", FINER)):
        one = run.again(keys)
        rows.append([f"Nereid, {said}", f"{100 * (force(one).got / FORCE - 1):+.2f} %",
                     *(f"{100 * (sunk(name)(one).got / MESHES[FINEST][name] - 1):+.2f} %" for name in PLACES)])
    return rows + [[f"CalculiX, {20 * n} x {16 * n}, {24 * n} x {16 * n}",
                    *(f"{100 * (MESHES[n][name] / MESHES[FINEST][name] - 1):+.2f} %" for name in ("force", *PLACES))] for n in MESHES]


DEPARTURES = {}

HALVED = "a quarter of the limit with half as many cells: the second order"
CHECKS = [
    Check("force", force, 0.03, "five cells of the cap over the contact radius: half a cell is a tenth of it, and acts by its square; "
          "three times that"),
    Check("force of the base", balance, 1e-3, "at rest, to the residual of the relaxation, which is over all forces inside"),
    *(Check(PLACES[name], sunk(name), 0.06, "cells of 0.5 to 0.9 mm there, and five over the contact radius: the field of the contact is "
            "as wrong as its size, twice the limit of the force") for name in ("off_2", "off_3")),
    Check("force, twice the cells", finer(force), 0.0075, HALVED, full=True),
    *(Check(f"{PLACES[name]}, twice the cells", finer(sunk(name)), 0.015, HALVED, full=True) for name in ("off_2", "off_3")),
    Check(f"{PLACES['off_1']}, twice the cells", finer(sunk("off_1")), 0.03, "the slope of the face is infinite at the rim of the contact: "
          "the first order, and so half of the limit of the other places with half as many cells", full=True),
]

STUDIES = [Table("Force and displacements over those of the finest deck, by cells of cap and block.",
                 ["program and cells", "force", *PLACES.values()], meshes, full=True)]

NO_POISSON = {f"bodies[{body}].material.poisson": 0 for body in range(2)}
GLUED = {"planes[2].kind": "fixed"}
BREAKS = [
    *(Breaks(check, "Young's modulus for E*: no Poisson effect", NO_POISSON) for check in ("force", PLACES["off_3"])),
    *(Breaks(PLACES[name], "a base that holds the block along itself", GLUED) for name in ("off_2", "off_3")),
    Breaks("force of the base", "stopped early", {"relaxation.residual": 0.1}),
    *(Breaks(f"{PLACES[name]}, twice the cells", "a base that holds the block along itself", GLUED, full=True) for name in PLACES),
    Breaks("force, twice the cells", "a base that holds the block along itself", GLUED, full=True),
]


def face(run):
    fields = run.frame("body")[1]
    rows = sorted((p[0], u[2]) for p, u in zip(fields["points"], fields["displacement"])
                  if abs(p[1]) < 1e-9 and abs(p[2]) < 1e-9 and p[0] > 1e-6)
    return [("Nereid", [1e3 * r for r, _ in rows], [1e6 * u for _, u in rows])]


def reference_face(run):
    return [("CalculiX", [1e3 * r for r, _ in FACE[1:]], [1e6 * u for _, u in FACE[1:]])]


FIGURES = [Figure("face", "distance from the axis [mm]", "displacement of the face upwards [um]", face, exact=reference_face,
                  caption="The face of a block under the cap of a ball, over that of CalculiX.")]
