"""How close is close enough, why, and what must break."""
from math import cos, radians, sin

from reference import elastic_widening, first_yield, limit, path
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table

CATALOGUE = ("M-5",)
CLAIM = "First yield and limit pressure of a thick cylinder in plane strain agree with theory, nearly incompressible or not."
EVIDENCE = "exact"
DRIVER = "scene"

ELASTIC = "verification/thick_cylinder_at_its_limit/elastic.yaml"
INNER, OUTER, LENGTH, ANGLE, YOUNG, YIELD = 0.1, 0.2, 6.25e-3, radians(3.6), 200e9, 10e6
PRESSURE = 1e6  # [Pa] of the elastic case
LIMIT = limit(INNER, OUTER)
BOUND = "the catalogue's bound"


def changed(kind="full", poisson=0.3):
    return {"bodies[0].element.kind": kind, "bodies[0].material.poisson": poisson}


def pressures(run):
    """Of the bore over the yield stress, from the reaction of the two nodes of a symmetry plane.

    Virtual work: a pressure on the chord gives such a node p a l sin(angle)/4 along its radius.
    """
    return [2 * f / (INNER * LENGTH * sin(ANGLE)) / YIELD for f in run.column("push")]


def at_limit(run, change=None):
    return Pair(pressures(run.again(change) if change else run)[-1], LIMIT)


def steady(run):
    """The pressure when the bore has widened by half of its last widening."""
    half = next(i for i, u in enumerate(run.column("bore")) if u > 0.5 * run.column("bore")[-1])
    return Pair(pressures(run)[half], LIMIT)


def at_rest(run, change):
    """The elastic case with the changes of a break that it shares."""
    shared = {key: value for key, value in run.overrides.items() if key.startswith("bodies") or key.startswith("planes[3]")}
    return run.other("scene", ELASTIC, {**shared, **change})


def yields_at(run, cells, change):
    """The pressure at which the worst element would begin to flow, over the yield stress: stress is linear in pressure."""
    return PRESSURE / at_rest(run, {**change, "bodies[0].mesh.cells_radial": cells}).column("von_mises")[-1]


def extrapolated(kind, poisson):
    """To the bore: elements see the stress in their middle, half a cell inside, so one order is taken out."""
    return lambda run: Pair(2 * yields_at(run, 32, changed(kind, poisson)) - yields_at(run, 16, changed(kind, poisson)),
                            first_yield(INNER, OUTER, poisson))


def as_meshed(run):
    """Of a run of elastic.yaml or not: the first yield of the mesh that its keys say."""
    cells = int(run.overrides.get("bodies[0].mesh.cells_radial", 16))
    return Pair(yields_at(run, cells, changed("one_point")), first_yield(INNER, OUTER, 0.3))


def widening(kind, poisson):
    def measure(run):
        u = at_rest(run, changed(kind, poisson)).column("widening")[-1] / ((1 + cos(ANGLE)) / 2)  # mean of two nodes, ANGLE apart
        return Pair(u, elastic_widening(INNER, OUTER, YOUNG, poisson, PRESSURE), "m")
    return measure


def kinds(run):
    rows = []
    for kind, name in (("full", "eight points"), ("one_point", "one point")):
        for poisson in (0.3, 0.49):
            one = run.again(changed(kind, poisson))
            rows.append([name, f"{poisson}", f"{pressures(one)[-1]:.5f}", f"{100 * at_limit(one).error():.3f} %",
                         f"{extrapolated(kind, poisson)(run).got:.5f}", f"{first_yield(INNER, OUTER, poisson):.5f}"])
    return rows


DEPARTURES = {"integration": "nearly incompressible walls may lock, so both kinds of hexahedra are checked"}

CHECKS = [
    Check("limit pressure", at_limit, 0.01, BOUND),
    Check("limit pressure, one point", lambda run: at_limit(run, changed("one_point")), 0.01, BOUND),
    Check("limit pressure, one point, Poisson 0.49", lambda run: at_limit(run, changed("one_point", 0.49)), 0.01, BOUND),
    Check("pressure while the bore widens twofold", steady, 0.01,
          "a limit is one if it is there at half of the widening, too; the bound is that of the limit"),
    Check("first yield", extrapolated("full", 0.3), 0.01, f"{BOUND}; of 16 and 32 cells"),
    Check("first yield, one point", extrapolated("one_point", 0.3), 0.01, f"{BOUND}; of 16 and 32 cells"),
    Check("first yield, Poisson 0.49", extrapolated("full", 0.49), 0.01, f"{BOUND}; of 16 and 32 cells"),
    Check("first yield, one point, Poisson 0.49", extrapolated("one_point", 0.49), 0.01, f"{BOUND}; of 16 and 32 cells"),
    Check("elastic widening of the bore", widening("full", 0.3), 0.01, "Lame, with the bound of the rest"),
    Report("first yield, one point, as meshed", as_meshed, "an element knows the stress in its middle, half a cell inside the bore"),
]

STUDIES = [
    Falls("first yield, one point, as meshed", "bodies[0].mesh.cells_radial", [8, 16, 32], order=0.9),
    Table("Pressures over the yield stress.", ["element", "Poisson", "limit", "error", "first yield", "exact"], kinds, full=True),
]

BREAKS = [
    Breaks("limit pressure", "hardening where there is none", {"bodies[0].material.tangent": "10 GPa"}),
    Breaks("limit pressure", "Tresca's yield stress, sqrt(3)/2 of it", {"bodies[0].material.yield": "8.66 MPa"}),
    Breaks("limit pressure", "pushed no further than half-way through the wall", {"time.end": "2.6 ms"}),
    Breaks("limit pressure, one point", "Tresca's yield stress, sqrt(3)/2 of it", {"bodies[0].material.yield": "8.66 MPa"}),
    Breaks("limit pressure, one point, Poisson 0.49", "an outer radius of 198 mm", {"bodies[0].mesh.radius": "198 mm"}),
    Breaks("pressure while the bore widens twofold", "hardening where there is none", {"bodies[0].material.tangent": "10 GPa"}),
    Breaks("first yield", "an outer radius of 180 mm", {"bodies[0].mesh.radius": "180 mm"}),
    Breaks("first yield, one point", "an outer radius of 180 mm", {"bodies[0].mesh.radius": "180 mm"}),
    Breaks("first yield, Poisson 0.49", "an outer radius of 180 mm", {"bodies[0].mesh.radius": "180 mm"}, full=True),
    Breaks("first yield, one point, Poisson 0.49", "an outer radius of 180 mm", {"bodies[0].mesh.radius": "180 mm"}, full=True),
    Breaks("elastic widening of the bore", "ends that are free: no plane strain", {"planes[3].nodes": "[wall.bottom]"}),
]


def widened(run, change):
    one = run.again(change)
    u, p = one.column("bore"), pressures(one)
    kept = [i for i in range(len(u)) if u[i] < 6 * YIELD / YOUNG * INNER]
    return [u[i] * YOUNG / YIELD / INNER for i in kept], [p[i] for i in kept]


def pressure_over_widening(run):
    return [(label, *widened(run, change)) for label, change in (("one point, Poisson 0.49", changed("one_point", 0.49)),
                                                                ("eight points, Poisson 0.3", {}))]


def exact_path(_):
    curve = path(INNER, OUTER)
    return [("exact, Poisson 1/2", [u for u, _ in curve] + [6], [p for _, p in curve] + [LIMIT])]


FIGURES = [Figure("pressure", "widening of the bore u E / (a yield stress) [-]", "pressure over yield stress [-]", pressure_over_widening,
                  exact=exact_path,
                  caption="Pressure over the widening of the bore, up to the limit; the exact curve is that of an incompressible wall")]
