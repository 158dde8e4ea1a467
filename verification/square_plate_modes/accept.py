"""How close is close enough, why, and what must break."""
from reference import cantilever, free, frequency, simply_supported
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table

CATALOGUE = ("P-1", "P-2", "P-3")
CLAIM = "Frequencies of thin square plates are right on simple supports, free, and clamped at one side."
EVIDENCE = "exact"
DRIVER = "modes"

PLATE = {"side": 10, "thickness": 0.05, "young": 200e9, "density": 8000}
EXACT = {"simply supported": [frequency(number, **PLATE) for number in simply_supported(7)],
         "free": [frequency(number, **PLATE) for number in free(7)],
         "cantilever": [frequency(number, **PLATE) for number in cantilever(6)]}
FILES = {"simply supported": "verification/square_plate_modes/case.yaml", "free": "verification/square_plate_modes/free.yaml",
         "cantilever": "verification/square_plate_modes/cantilever.yaml"}
COUNT = {"simply supported": 7, "free": 6, "cantilever": 5}  # as many as the catalogue names
NAFEMS_FREE = [1.622, 2.360, 2.922, 4.233, 4.233, 7.416]  # [Hz] FV12


def there(run, support):
    """The plate on other supports, with what a break or a study has set; a study sets one number of cells, and means both."""
    n = run.overrides.get("bodies[0].mesh.cells_along")
    return run.other("modes", FILES[support], {**({"bodies[0].mesh.cells_across": n} if n else {}), **run.overrides})


def frequencies(run, support):
    """Those that bend, ascending. [Hz]"""
    modes = there(run, support)
    return modes.column("frequency")[round(modes.result("without_stiffness")):]


def mode(support, number):
    """The mode of this number, from 0."""
    return lambda run: Pair(frequencies(run, support)[number], EXACT[support][number], "Hz")


def worst(support):
    """The mode that is farthest off of those that the catalogue names."""
    def measure(run):
        pairs = [Pair(got, exact, "Hz") for got, exact in zip(frequencies(run, support), EXACT[support][:COUNT[support]])]
        return max(pairs, key=Pair.error)
    return measure


def first(run):
    """The first frequency, on a mesh of as many cells across as along: a study sets one number."""
    n = run.overrides.get("bodies[0].mesh.cells_along", 32)
    return mode("simply supported", 0)(run.again(cells(n, run.overrides.get("bodies[0].mesh.cuts", "crossed"))))


def repeated(run):
    """How far the second and the third mode of a square are apart."""
    got = frequencies(run, "simply supported")
    return Pair(got[2] / got[1], 1)


def rigid(run):
    return Pair(there(run, "free").result("without_stiffness"), 6)


def asymmetry(run):
    return Pair(max(there(run, support).result("asymmetry") for support in FILES), 0, scale=1)


def cells(n, cuts="crossed"):
    return {"bodies[0].mesh.cells_along": n, "bodies[0].mesh.cells_across": n, "bodies[0].mesh.cuts": cuts}


def meshes(run):
    rows = []
    for support in FILES:
        for n, cuts in ((8, "crossed"), (16, "crossed"), (32, "crossed"), (32, "columns")):
            got = frequencies(run.again(cells(n, cuts)), support)
            rows.append([support, f"{n} x {n}, {cuts}", *(f"{100 * (f / e - 1):+.2f} %" for f, e in zip(got, EXACT[support][:5]))])
    return rows


def inertias(run):
    rows = []
    for inertia in ("physical", "scaled"):
        modes = run.again({**cells(16), "bodies[0].element.rotary_inertia": inertia})
        rows.append([inertia, *(f"{f:.4f}" for f in modes.column("frequency")[:5]), f"{modes.result('highest_frequency_1'):.4g}",
                     f"{1e6 * modes.result('exact_step'):.4g}", f"{1e6 * modes.result('voted_step'):.4g}"])
    return rows


def against_nafems(run):
    return max((Pair(got, exact, "Hz") for got, exact in zip(frequencies(run, "free"), NAFEMS_FREE)), key=Pair.error)


def drawn(run):
    curves = []
    for support in FILES:
        got = frequencies(run, support)[:COUNT[support]]
        curves.append((support, list(range(1, len(got) + 1)), got))
    return curves


def exact_numbers(_run):
    return [(f"{support}, exact", list(range(1, COUNT[support] + 1)), EXACT[support][:COUNT[support]]) for support in FILES]


CHECKS = [
    Check("simply supported: worst of 7 frequencies", worst("simply supported"), 0.01, "the catalogue's bound"),
    Check("free: worst of 6 frequencies", worst("free"), 0.015, "the catalogue's bound, against Ritz's numbers, which are exact to 1e-5"),
    Check("cantilever: worst of 5 frequencies", worst("cantilever"), 0.015,
          "the catalogue's bound, against Ritz's numbers, which are exact to 5e-4"),
    Check("simply supported: first frequency", first, 0.01, "the catalogue's bound"),
    Check("second and third mode of a square are one", repeated, 1e-6,
          "crossed cuts are symmetric about both middles, so the two differ by round-off", evidence="invariant"),
    Check("rigid motions of the free plate", rigid, 0, "six of the thirteen modes asked for", evidence="invariant"),
    Report("asymmetry of the stiffness", asymmetry,
           "forces are a gradient, and displacements of 1e-7 sides leave 1e-14. No key makes them another, so this gates nothing"),
    Report("free: worst against NAFEMS' FV12", against_nafems, "4.233 and 7.416 Hz there lie above Ritz's converged 4.190 and 7.356"),
]

STUDIES = [
    Falls("free: worst of 6 frequencies", "bodies[0].mesh.cells_along", [8, 16, 32], order=1.5, full=True),
    Table("Frequencies less the exact ones.", ["support", "mesh", "1", "2", "3", "4", "5"], meshes, full=True),
    Table("Frequencies of the simply supported plate of 16 x 16 cells [Hz], and steps [us], by rotary inertia.",
          ["rotary inertia", "1", "2", "3", "4", "5", "highest", "exact step", "voted step"], inertias, full=True),
]

BREAKS = [
    Breaks("simply supported: worst of 7 frequencies", "a beam's bending, E t^3/12 without 1 - nu^2", {"bodies[0].material.poisson": 0}),
    Breaks("free: worst of 6 frequencies", "Poisson's ratio of brass for that of steel", {"bodies[0].material.poisson": 0.36}),
    Breaks("cantilever: worst of 5 frequencies", "pounds taken for kilograms", {"bodies[0].material.density": "8000 lb/m^3"}),
    Breaks("second and third mode of a square are one", "diagonals that lean one way in each column, so that x and y differ",
           {"bodies[0].mesh.cuts": "columns"}),
    Breaks("simply supported: first frequency", "a beam's bending, E t^3/12 without 1 - nu^2", {"bodies[0].material.poisson": 0},
           full=True),
    Breaks("rigid motions of the free plate", "an edge that is held", {"planes": "[{name: hold, kind: fixed, nodes: [plate.x_low]}]"},
           full=True),
]

FIGURES = [Figure("frequencies", "mode [-]", "frequency [Hz]", drawn, exact=exact_numbers,
                  caption="Frequencies of a square plate of 32 x 32 cells on three supports, beside Navier's and Ritz's.")]
