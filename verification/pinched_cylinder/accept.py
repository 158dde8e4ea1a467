"""How close is close enough, why, and what must break."""
from reference import PUBLISHED, ring
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table

CATALOGUE = ()
CLAIM = ("A thin cylinder with end diaphragms, pinched by two opposite forces, deflects under them as published and converges with the "
         "mesh.")
EVIDENCE = "benchmark"
DRIVER = "scene"


def mesh(cells, cuts="crossed"):
    """As many cells along half the length as along a quarter of the circumference."""
    return {"bodies[0].mesh.cells_along": cells, "bodies[0].mesh.cells_across": cells, "bodies[0].mesh.cuts": cuts}


def deflection(run):
    return Pair(run.column("deflection")[-1], -PUBLISHED, "m")


def meshed(run):
    """As fine along as around: a study sets one number."""
    return deflection(run.again(mesh(run.overrides.get("bodies[0].mesh.cells_along", 32))))


def part(run):
    return f"{run.column('deflection')[-1] / -PUBLISHED:.3f}"


def meshes(run):
    return [[cuts, *(part(run.again(mesh(n, cuts))) for n in (8, 16, 32))] for cuts in ("crossed", "columns")]


def stiffnesses(run):
    return [[f"{drilling:g}", *(part(run.again({**mesh(n), "bodies[0].element.drilling": drilling})) for n in (8, 16, 32))]
            for drilling in (0, 0.01, 0.1, 1)]


def around(run):
    """Radial displacement around the middle section, by the angle from the force. [deg] [um]"""
    from math import atan2, degrees, hypot
    curves = []
    for n in (16, 32):
        _, fields = run.again(mesh(n)).frame("body")
        places = []
        for (x, y, z), u in zip(fields["points"], fields["displacement"]):
            if abs(y - 300) < 1e-6:
                places.append((degrees(atan2(x, z)), 1e6 * (u[0] * x + u[2] * z) / hypot(x, z)))
        places.sort()
        curves.append((f"{n} x {n}", [a for a, _ in places], [w for _, w in places]))
    return curves


def published(_run):
    return [("published, under the force", [0, 1], [-1e6 * PUBLISHED] * 2)]


CHECKS = [
    Check("deflection under the force, 32 x 32", meshed, 0.05, "flat triangles on a curved shell: this mesh is usually asked for 5 %"),
    Check("32 x 32, columns", lambda run: deflection(run.again(mesh(32, "columns"))), 0.05, "as above"),
    Report("a ring that bends without stretching", lambda run: Pair(ring(), PUBLISHED, "m"),
           "what the diaphragms prevent: it would give way 25 times as much"),
]

STUDIES = [
    Falls("deflection under the force, 32 x 32", "bodies[0].mesh.cells_along", [8, 16, 32], order=1),
    Table("Deflection over the published one, by cells along and around.", ["cuts", "8", "16", "32"], meshes),
    Table("The same by drilling stiffness.", ["drilling", "8", "16", "32"], stiffnesses, full=True),
]

BREAKS = [
    Breaks("deflection under the force, 32 x 32", "ends free to go out of round",
           {"planes[1].nodes": "[shell.pinch]", "planes[1].normal": "[0, 1, 0]", "planes[0].nodes": "[shell.pinch]"}, full=True),
    Breaks("deflection under the force, 32 x 32", "a thickness off by a thirtieth", {"bodies[0].element.thickness": "3.1 m"}),
    Breaks("32 x 32, columns", "half of the force", {"loads[0].value": '["0", "0", "-0.125"]'}),
]

FIGURES = [Figure("around", "angle from the force [deg]", "radial displacement [um]", around, exact=published, error=False,
                  caption="Radial displacement around the middle section, beside the published value under the force.")]
