"""How close is close enough, why, and what must break."""
from reference import bending_stiffness, clamped, simply_supported
from verify import Breaks, Check, Falls, Figure, Pair, Table

CATALOGUE = ("P-4",)
CLAIM = "Deflections of a thin square plate under uniform pressure agree with Navier on simple supports and with Ritz where clamped."
EVIDENCE = "exact"
DRIVER = "scene"

SIDE, PRESSURE = 1.0, 1000.0  # [m] [Pa]
MIDDLE = {"simply supported": simply_supported(0.5, 0.5), "clamped": clamped([0.5])[0]}  # w D / (q a^4)


def scale(run):
    """q a^4 / D of the run's plate, with the exact material of the case. [m]"""
    return PRESSURE * SIDE**4 / bending_stiffness(young=210e9, poisson=0.3, thickness=0.01)


def mesh(cells, cuts="crossed"):
    """Of a quarter: half as many cells along a side."""
    return {"bodies[0].mesh.cells_along": cells // 2, "bodies[0].mesh.cells_across": cells // 2, "bodies[0].mesh.cuts": cuts}


def held(rim):
    return {"planes[0].kind": "fixed"} if rim == "clamped" else {}


def middle(rim, cells, cuts="crossed"):
    def measure(run):
        there = run.again({**mesh(cells, cuts), **held(rim)})
        return Pair(there.column("middle")[-1], MIDDLE[rim] * scale(run), "m")
    return measure


def clamped_and_meshed(run):
    """The clamped plate, as many cells across as along: a study sets one number."""
    return middle("clamped", 2 * run.overrides.get("bodies[0].mesh.cells_along", 12))(run)


def meshes(run):
    rows = []
    for cuts in ("crossed", "columns"):
        for rim in MIDDLE:
            values = [middle(rim, n, cuts)(run) for n in (8, 16, 32)]
            rows.append([f"{rim}, {cuts}", *(f"{100 * (pair.got / pair.expected - 1):+.2f} %" for pair in values)])
    return rows


def thicknesses(run):
    """Thicker plates shear as well, which Kirchhoff's do not; thinner ones would show locking."""
    rows = []
    for rim in MIDDLE:
        row = [rim]
        for thickness in (0.002, 0.01, 0.05):
            there = run.again({**mesh(16), **held(rim), "bodies[0].element.thickness": f"{thickness} m",
                               "relaxation.after": f"{0.5e-3 / thickness} s",
                               "loads[0].value": repr(1e9 * thickness**3), "time.end": "4 s"})
            exact = MIDDLE[rim] * 1e9 * thickness**3 * SIDE**4 / bending_stiffness(210e9, 0.3, thickness)
            row.append(f"{100 * (there.column('middle')[-1] / exact - 1):+.2f} %")
        rows.append(row)
    return rows


def deflected(run):
    """Along the middle line y = a/2, by distance from the rim. [m] [mm]"""
    curves = []
    for rim in MIDDLE:
        _, fields = run.again(held(rim)).frame("body")
        places = sorted((x, 1e3 * u[2]) for (x, y, _), u in zip(fields["points"], fields["displacement"]) if abs(y - SIDE / 2) < 1e-9)
        curves.append((f"{rim}, 16 x 16", [x for x, _ in places], [w for _, w in places]))
    return curves


def exact_line(run):
    places = [i / 100 * SIDE / 2 for i in range(101)]
    supported = [1e3 * scale(run) * simply_supported(x / SIDE, 0.5) for x in places]
    held_fast = [1e3 * scale(run) * w for w in clamped([x / SIDE for x in places])]
    return [("Navier", places, supported), ("Ritz", places, held_fast)]


BOUND = "the catalogue's bound"
CHECKS = [
    Check("simply supported, crossed", middle("simply supported", 16), 0.02, BOUND + " at 16 x 16"),
    Check("simply supported, columns", middle("simply supported", 16, "columns"), 0.02, BOUND + " at 16 x 16"),
    Check("clamped, crossed", middle("clamped", 16), 0.02, BOUND + " at 16 x 16"),
    Check("clamped, columns", middle("clamped", 16, "columns"), 0.02, BOUND + " at 16 x 16"),
    Check("clamped, 24 x 24", clamped_and_meshed, 0.02, BOUND),
]

STUDIES = [
    Falls("clamped, 24 x 24", "bodies[0].mesh.cells_along", [4, 8, 16], order=1.5, full=True),
    Table("Deflection in the middle less the exact one, by cells along a whole side.", ["rim, cuts", "8", "16", "32"], meshes, full=True),
    Table("The same with 16 cells, by thickness over side.", ["rim", "0.002", "0.01", "0.05"], thicknesses, full=True),
]

BREAKS = [
    Breaks("simply supported, crossed", "a strip's bending, E t^3/12 without 1 - nu^2", {"bodies[0].material.poisson": 0}),
    Breaks("simply supported, columns", "a plate a tenth as thick as wide held against a thin one, which does not shear",
           {"bodies[0].element.thickness": "100 mm", "loads[0].value": "1e6"}),
    *(Breaks(f"clamped, {cuts}", "a thickness off by a hundredth", {"bodies[0].element.thickness": "10.1 mm"}, full=True)
      for cuts in ("crossed", "columns")),
    Breaks("clamped, 24 x 24", "a thickness off by a hundredth", {"bodies[0].element.thickness": "10.1 mm"}),
]

FIGURES = [Figure("deflection", "distance from the rim along the middle line [m]", "deflection [mm]", deflected, exact=exact_line,
                  caption="Deflection of a quarter plate, 16 x 16 cells of the whole, beside Navier's series and Ritz's polynomials.")]
