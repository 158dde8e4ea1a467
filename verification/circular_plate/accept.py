"""How close is close enough, why, and what must break."""
from math import hypot

from reference import deflection, frequency, numbers
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("P-5",)
CLAIM = "Deflection and frequencies of a thin circular plate with clamped rim agree with the closed forms."
EVIDENCE = "exact"
DRIVER = "scene"

PLATE = {"radius": 1, "thickness": 0.01, "young": 210e9, "poisson": 0.3}
PRESSURE, DENSITY = 100, 7850  # [Pa] [kg/m3]
EXACT = [frequency(number, density=DENSITY, **PLATE) for number in numbers(6)]
MODES = "verification/circular_plate/modes.yaml"


def middle(run):
    return Pair(run.column("middle")[-1], deflection(0, PRESSURE, **PLATE), "m")


def modes(run):
    """The whole plate, with what a break or a study has set of its body."""
    return run.other("modes", MODES, {key: value for key, value in run.overrides.items() if key.startswith("bodies")})


def mode(number):
    return lambda run: Pair(modes(run).column("frequency")[number], EXACT[number], "Hz")


def cells(n):
    return {"bodies[0].mesh.cells_core": 3 * n, "bodies[0].mesh.cells_ring": 4 * n}


def meshes(run):
    rows = []
    for n in (1, 2, 4):
        finer = run.again(cells(n))
        found = modes(finer).column("frequency")
        pairs = [middle(finer), *(Pair(found[i], EXACT[i]) for i in (0, 1, 3, 5))]
        rows.append([f"{3 * n} + {4 * n}", *(f"{100 * (pair.got / pair.expected - 1):+.2f} %" for pair in pairs)])
    return rows


def lying(run):
    """Nodes of the quarter by their distance from the middle. [m] [um]"""
    _, fields = run.frame("body")
    places = sorted((hypot(x, y), 1e6 * u[2]) for (x, y, _), u in zip(fields["points"], fields["displacement"]))
    return [("nodes", [r for r, _ in places], [w for _, w in places])]


def exact_line(_run):
    places = [i / 100 for i in range(101)]
    return [("closed form", places, [1e6 * deflection(r, PRESSURE, **PLATE) for r in places])]


DEPARTURES = {
    "residual": "the default moves the deflection by 0.4 % in ten times the steps"}

CHECKS = [
    Check("deflection of the middle", middle, 0.02, "the catalogue's bound"),
    Check("frequency without nodal lines", mode(0), 0.02, "the catalogue's bound"),
    Check("frequency with one nodal diameter", mode(1), 0.02, "the catalogue's bound"),
    Check("frequency with one nodal circle", mode(5), 0.02, "the catalogue's bound"),
    Report("frequency with two nodal diameters", mode(3), "not named by the catalogue"),
    Report("deflection of the middle by default", lambda run: middle(run.again({"relaxation.residual": 1e-6})), "ten times the steps",
           full=True),
]

STUDIES = [Table("Less the exact ones, by cells in core and ring of a quarter.", ["cells", "middle", "(0, 0)", "(1, 0)", "(2, 0)",
    "(0, 1)"], meshes, full=True)]

BREAKS = [
    Breaks("deflection of the middle", "a rim that is supported and not clamped", {"planes[0].kind": "constrained",
        "planes[0].normal": "[0, 0, 1]"}),
    Breaks("frequency without nodal lines", "a beam's bending, E t^3/12 without 1 - nu^2", {"bodies[0].material.poisson": 0}),
    Breaks("frequency with one nodal circle", "the thickness in place of its half", {"bodies[0].element.thickness": "20 mm"}),
    Breaks("frequency with one nodal diameter", "a beam's bending, E t^3/12 without 1 - nu^2", {"bodies[0].material.poisson": 0},
           full=True),
]

FIGURES = [Figure("deflection", "distance from the middle [m]", "deflection [um]", lying, exact=exact_line,
                  caption="Every node of a quarter of the clamped circular plate, beside the closed form.")]
