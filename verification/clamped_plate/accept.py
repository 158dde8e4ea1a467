"""How close is close enough, why, and what must break."""
from reference import HALF, MESHES, deflection
from verify import Breaks, Check, Falls, Figure, Pair, Table

CATALOGUE = ()
CLAIM = ("A clamped square plate that an even pressure bends by half its thickness deflects as in CalculiX, and has the same membrane "
         "force.")
EVIDENCE = "benchmark"
DRIVER = "scene"

W, MEMBRANE = MESHES[max(MESHES)]  # [m] [N]
FINER = {"refine": 2}


def middle(run):
    return Pair(run.column("middle")[-1], W, "m")


def membrane(run):
    return Pair(-run.column("membrane")[-1], MEMBRANE, "N")


def profile(run):
    """[(distance from the middle, deflection)] along the middle line."""
    fields = run.frame("body")[1]
    return sorted((HALF - x, u[2]) for (x, y, _), u in zip(fields["points"], fields["displacement"]) if abs(y - HALF) < 1e-9)


def worst_of_profile(run):
    return Pair(max(abs(w - deflection(x)) for x, w in profile(run)), 0, "m", scale=W)


def finer(measure):
    return lambda run: measure(run.again({**run.overrides, **FINER}))


def meshes(run):
    rows = []
    for cells in (4, 8, 16, 24):
        one = run.again({"bodies[0].mesh.cells_along": cells, "bodies[0].mesh.cells_across": cells})
        rows.append([f"{cells} x {cells}", *(f"{100 * (pair.got / pair.expected - 1):+.2f} %" for pair in (middle(one), membrane(one))),
                     f"{100 * worst_of_profile(one).error():.2f} %"])
    return rows


DEPARTURES = {}

MIDDLE, ACROSS, PROFILE = "deflection in the middle", "membrane force across the middle", "deflection along the middle line, worst"
CHECKS = [
    Check(MIDDLE, middle, 0.01, "8 x 8 cells; by the second order half as many cells have four times the error, 2 % in the table"),
    Check(ACROSS, membrane, 0.04, "8 x 8 cells; triangles are stretched by the mean slope over them, so by less: (h w''/w')^2/12 with the "
          "side h, 1.3 % for w = 1 - cos(2 pi x), and by twice the error of the deflection; twice the sum"),
    Check(PROFILE, worst_of_profile, 0.015, "8 x 8 cells; half as much again as in the middle, since the plate is bent most at the clamp"),
    Check(f"{MIDDLE}, 16 x 16", finer(middle), 0.003, "a quarter of the limit of 8 x 8, and 0.02 % for the reference", full=True),
    Check(f"{ACROSS}, 16 x 16", finer(membrane), 0.01, "a quarter of the limit of 8 x 8", full=True),
]

STUDIES = [
    Falls(ACROSS, along="refine", values=[1, 2], order=1.5, full=True),
    Table("Meshes of this program: deflection in the middle and force across the middle over those of CalculiX, worst of the line.",
          ["cells of a quarter", "deflection", "force across the middle", "deflection along the line"], meshes, full=True),
]

STRIPS, LOOSE = {"bodies[0].material.poisson": 0}, {"planes[0].kind": "constrained", "planes[0].normal": "[0, 0, 1]"}
BREAKS = [
    Breaks(MIDDLE, "a grid of beams: no Poisson effect", STRIPS),
    Breaks(PROFILE, "a grid of beams: no Poisson effect", STRIPS),
    Breaks(ACROSS, "a rim that is held against deflection alone", LOOSE),
    Breaks(PROFILE, "a rim that is held against deflection alone", LOOSE, full=True),
    Breaks(CHECKS[3].name, "a grid of beams: no Poisson effect", STRIPS, full=True),
    Breaks(CHECKS[4].name, "a grid of beams: no Poisson effect", STRIPS, full=True),
]


def line(run):
    rows = profile(run)
    return [("Nereid, 8 x 8", [x for x, _ in rows], [1e3 * w for _, w in rows])]


def reference_line(run):
    places = [i * HALF / 100 for i in range(101)]
    return [("CalculiX, 32 x 32 S8R", places, [1e3 * deflection(x) for x in places])]


FIGURES = [Figure("deflection", "distance from the middle [m]", "deflection [mm]", line, exact=reference_line,
                  caption="Deflection of a clamped square plate along its middle line, over that of CalculiX.")]
