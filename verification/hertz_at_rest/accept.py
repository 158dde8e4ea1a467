"""How close is close enough, why, and what must break."""
from math import hypot, sqrt

from reference import hertz, pressure_at
from verify import Breaks, Check, Figure, Pair, Report, Table, straight_line

CATALOGUE = ("I-9",)
CLAIM = "A ball pressed on a rigid plane has Hertz's force and Hertz's pressure at rest."
EVIDENCE = "exact"
DRIVER = "scene"

RADIUS, APPROACH = 0.01, 25e-6   # [m]: a/R = 0.05
PART = 4                         # a quarter of the half is meshed
EXACT = hertz(RADIUS, 210e9, 0.3, APPROACH)
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def approach(run):
    return Pair(run.column("approach")[-1], APPROACH, "m")


def force(run):
    return Pair(PART * run.column("force")[-1], EXACT["force"], "N")


def balance(run):
    """Force of the plane against that which holds the equator."""
    return Pair(run.column("reaction")[-1], run.column("force")[-1], "N")


def triangle(a, b, c):
    u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return 0.5 * sqrt((u[1] * v[2] - u[2] * v[1])**2 + (u[2] * v[0] - u[0] * v[2])**2 + (u[0] * v[1] - u[1] * v[0])**2)


def pressures(run):
    """[(distance from the axis, pressure, area), ...] of the nodes on the ball that are pushed: force over a quarter of each face
    around."""
    fields = run.frame("body")[1]
    places, forces, nodes = fields["points"], fields["contact_force"], fields["connectivity"]
    on_the_ball = [abs(sqrt(x * x + y * y + z * z) / RADIUS - 1) < 1e-6 for x, y, z in places]
    area = [0.0] * len(places)
    for first in range(0, len(nodes), 8):
        cell = nodes[first:first + 8]
        for face in FACES:
            corners = [cell[i] for i in face]
            if all(on_the_ball[n] for n in corners):
                a, b, c, d = (places[n] for n in corners)
                for n in corners:
                    area[n] += 0.25 * (triangle(a, b, c) + triangle(a, c, d))
    return sorted((hypot(*place[:2]), push / tributary, tributary) for place, (_, _, push), tributary in
                  zip(places, ((-fx, -fy, -fz) for fx, fy, fz in forces), area) if push > 0 and tributary > 0)


def fit(run):
    """(largest pressure, contact radius): p^2 falls evenly with r^2, so a line through both, weighted by areas, within 0.8 a."""
    rows = [(r * r, p * p, w) for r, p, w in pressures(run) if r < 0.8 * EXACT["contact_radius"]]
    slope, top = straight_line(rows)
    return sqrt(top), sqrt(top / -slope)


def largest_pressure(run):
    return Pair(fit(run)[0], EXACT["pressure"], "Pa")


def contact_radius(run):
    return Pair(fit(run)[1], EXACT["contact_radius"], "m")


def cells(core, ring):
    return {"bodies[0].mesh.cells_core": core, "bodies[0].mesh.cells_ring": ring}


def meshes(run):
    rows = []
    for core, ring, scale in ((4, 3, 0), (5, 4, 0), (6, 5, 0), (6, 5, 8), (6, 5, 20), (8, 6, 0)):
        method = {"planes[3].method": "penalty", "planes[3].penalty_scale": scale} if scale else {}
        one = run.again({**cells(core, ring), **method})
        rows.append([f"{2 * core} around a quarter", f"penalty, scale {scale}" if scale else "multipliers",
                     f"{sum(1 for r, *_ in pressures(one))}",
                     f"{force(one).got / EXACT['force']:.4f}",
                     f"{largest_pressure(one).got / EXACT['pressure']:.4f}", f"{contact_radius(one).got / EXACT['contact_radius']:.4f}"])
    return rows


DEPARTURES = {"residual": "the default moves force and pressure by 0.1 % in a third more steps"}

CHECKS = [
    Check("approach", approach, 1e-4, "the equator moves as it is told, in some thousand steps"),
    Check("force", force, 0.04, "the catalogue's bound; a ball of finite size is a share of a/R = 0.05 away from Hertz's half-space"),
    Check("largest pressure", largest_pressure, 0.04, "the catalogue's bound"),
    Report("contact radius", contact_radius, "of the same line; the last ring of nodes has forces where the contact ends between rings"),
    Check("force on the equator over that of the plane", balance, 0.02,
          "to the residual of the relaxation, which is over all forces in the ball"),
]

STUDIES = [Table("Force, largest pressure and contact radius over Hertz's.", ["elements", "method", "nodes in contact", "force",
    "pressure", "radius"],
                 meshes, full=True)]

BREAKS = [
    Breaks("force", "Young's modulus for E*: no Poisson effect", {**cells(5, 4), "bodies[0].material.poisson": 0}),
    Breaks("largest pressure", "a plane fifty times too soft", {**cells(5, 4), "planes[3].method": "penalty",
                                                                "planes[3].penalty_scale": 0.4}),
    Breaks("force", "a plane fifty times too soft", {**cells(5, 4), "planes[3].method": "penalty", "planes[3].penalty_scale": 0.4}),
    Breaks("approach", "stopped early", {**cells(4, 3), "relaxation.residual": 0.5, "relaxation.after": "5 us"}),
]


def pressure_over_radius(run):
    rows = pressures(run)
    return [("Nereid", [1e3 * r for r, *_ in rows], [1e-9 * p for _, p, _ in rows])]


def exact_pressure(_):
    radii = [EXACT["contact_radius"] * i / 100 for i in range(131)]
    return [("Hertz", [1e3 * r for r in radii], [1e-9 * pressure_at(r, EXACT["contact_radius"], EXACT["pressure"]) for r in radii])]


FIGURES = [Figure("pressure", "distance from the axis [mm]", "pressure [GPa]", pressure_over_radius, exact=exact_pressure,
                  caption="Pressure at the nodes of a ball of 10 mm that a rigid plane presses in by 25 um, over Hertz's.")]
