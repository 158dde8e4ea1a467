"""How close is close enough, why, and what must break."""
from math import cos, radians, sin, sqrt, tan

from reference import force, path, penetration, way_back
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("C-9",)
CLAIM = ("A node carried over a ridge, a vertex, or through a valley is never without contact and never pushed twice: its force is the "
         "penalty times its area times the way to where it may be.")
EVIDENCE = "exact"
DRIVER = "scene"

PENALTY, SIDE, DEPTH = 2e8, 0.2e-3, 1e-3  # [Pa/m]; side of the block's sole, depth to which it is carried in [m]
SPEED, ASIDE = 0.5, 0.15                  # along the path; along the ridge [m/s]
BEFORE, ABOVE, ASIDE_AT_START = 4e-3, 0.3e-3, 3e-3  # way on a flank, free way at the start, place along the ridge [m]
STIFFNESS = PENALTY * (SIDE / 2)**2       # of one apex [N/m]
CORNERS = [(x * SIDE / 2, y * SIDE / 2) for x in (-1, 1) for y in (-1, 1)]
HEIGHT = 3e-3                             # contact height, where there is one [m]


def keys(kind, turn, height):
    """The keys of a run: the shape of the base, the path of the block, and the contact height."""
    slope, convex = turn / 2, kind in ("ridge", "peak")
    steep = tan(radians(slope)) * (-1 if convex else 1)
    if kind in ("ridge", "valley"):
        shape, aside, at = f"{steep!r} * abs(x)", ASIDE, ASIDE_AT_START
        (x, z), angle, radius = path(kind, slope, height, DEPTH, BEFORE, ABOVE)
        into, straight, arc = (DEPTH + ABOVE) / SPEED, BEFORE / SPEED, 2 * abs(angle) * radius / SPEED
        part = f"max(0, min(1, (t - {into + straight!r})/{arc!r}))" if radius > 0 else f"(t < {into + straight!r} ? 0 : 1)"
        heading = f"({angle!r} - {2 * angle!r} * {part})"
        down, end = (SPEED * sin(angle), -SPEED * cos(angle)), into + 2 * straight + arc
    else:  # straight down beside the vertex, then level past it, a little aside of it
        shape, aside, at = f"{steep / sqrt(2)!r} * (abs(x) + abs(y))", 0, ABOVE
        low = height / (1 if convex else cos(radians(slope))) - DEPTH
        x, z = -BEFORE, low + DEPTH + ABOVE + (0 if convex else steep / sqrt(2) * (BEFORE + 2 * ABOVE))
        into, heading, down = (z - low) / SPEED, "0", (0.0, -SPEED)
        end = into + 2 * BEFORE / SPEED
    velocity = [f"t < {into!r} ? {down[0]!r} : {SPEED!r} * cos({heading})", f"t < {into!r} ? 0 : {aside!r}",
                f"t < {into!r} ? {down[1]!r} : {SPEED!r} * sin({heading})"]
    return {"bodies[0].mesh.map": f'["x", "y", "z + ({shape})"]', "bodies[1].move": f"[{x!r} m, {at!r} m, {z!r} m]",
            "planes[1].velocity.value": "[" + ", ".join(f'"{one}"' for one in velocity) + "]",
            "contacts[0].contact_height": "given", "contacts[0].height": f"{height!r} m", "time.end": f"{end!r} s"}


class Passage:
    """One run beside the exact forces, row by row."""

    def __init__(self, run, kind, turn, height, **more):
        one = self.run = run.again({**keys(kind, turn, height), **more})
        self.places = list(zip(one.column("x"), one.column("y"), one.column("z")))
        self.forces = list(zip(one.column("force_x"), one.column("force_y"), one.column("force_z")))
        self.touching = [area / (SIDE / 2)**2 for area in one.column("touching")]
        apexes = [[(x + a, y + b, z) for a, b in CORNERS] for x, y, z in self.places]
        self.exact = [force(kind, turn / 2, height, STIFFNESS, four) for four in apexes]
        self.back = [tuple(STIFFNESS * sum(way_back(turn / 2, x)[c] for x in four) for c in range(3)) for four in apexes]
        ways = [[penetration(kind, turn / 2, height, x) for x in four] for four in apexes]
        self.closed = [sum(way[2] / size(way) for way in four if any(way)) for four in ways]  # the sole looks down: areas across the way
        self.scale = 4 * STIFFNESS * DEPTH


NOTCH = "verification/ridge_and_valley/notch.yaml"
passages = {}


def passage(run, kind, turn, height=0.0, **more):
    """The passage of this run, computed once."""
    key = (str(run.folder), kind, turn, height, str(more))
    if key not in passages:
        passages[key] = Passage(run, kind, turn, height, **more)
    return passages[key]


def size(vector):
    return sqrt(sum(c * c for c in vector))


def missed(one):
    """Rows in which an apex has no contact that it should have."""
    return sum(now < should - 0.25 for now, should in zip(one.touching, one.closed))


def error(one, exact=None):
    """Of the force, its direction included, in the worst row, over the largest force. [-]"""
    exact = exact or one.exact
    return max(size([g - e for g, e in zip(got, should)]) for got, should in zip(one.forces, exact)) / max(map(size, exact))


def excess(one):
    """The largest force in any row over the exact one of that row, where this is no less than a half of one apex's share. [-]"""
    return max(size(got) / size(should) for got, should in zip(one.forces, one.exact) if size(should) > one.scale / 8)


# What Eq. (14) is false or true for on both sides, turned by up to a right angle. A ridge without contact height ends at 84 degrees.
GROUPS = {
    "ridge": [("ridge", 45, 0.0), ("ridge", 80, 0.0)],
    "ridge with height": [("ridge", 90, HEIGHT), ("ridge", 120, HEIGHT)],
    "valley": [("valley", 45, 0.0), ("valley", 90, 0.0)],
    "valley with height": [("valley", 10, HEIGHT), ("valley", 90, HEIGHT)],
    "peak and pit": [("peak", 45, 0.0), ("peak", 45, HEIGHT), ("pit", 45, 0.0), ("pit", 45, HEIGHT)],
}
EXACTLY = 1e-6  # limit of what only rounds off [-]


def worst(measure, expected, limit, groups):
    """Measures the worst passage of the groups; one that is beyond the limit ends the search."""
    def measured(run):
        found = expected
        for of in (of for group in groups for of in GROUPS[group]):
            found = max(found, measure(passage(run, *of)))
            if found - expected > limit:
                break
        return Pair(found, expected, "", 1)
    return measured


def pushed_back(run):
    """Over a ridge that ends the surface: the force through the flank that the block came through."""
    one = passage(run, "ridge", 120)
    return Pair(error(one, one.back), 0, "", scale=1)


def thrown(run):
    one = run.other(DRIVER, NOTCH, {})
    return Pair(one.column("time")[-1], one.case("time.end"), "s")


ROUND_OFF = "the motion is prescribed and the geometry has edges only where the case puts them, so that nothing but round-off is left"
DEPARTURES = {
    "method, penalty": "the subject is the way of a penalty's force over a ridge: penalty times area times depth",
    "overlap_limit": "the node is driven through the surface by design, far deeper than an element"}

CHECKS = [
    Check("rows without contact of an apex", worst(missed, 0, 0, GROUPS), 0, "the catalogue's bound: no frame is missed"),
    Check("largest force over the exact one of its row", worst(excess, 1, EXACTLY, GROUPS), EXACTLY,
          "the catalogue's bound: penalty times gap, and not twice"),
    *(Check(f"force, {group}", worst(error, 0, EXACTLY, [group]), EXACTLY, ROUND_OFF) for group in GROUPS),
    Check("force, ridge of 120 degrees: back the way it came", pushed_back, 1e-6,
          "an edge that turns by more than 84 degrees ends a surface: what came in through a flank goes out through it, wherever it is"),
    Report("largest force, ridge of 120 degrees, over that of the shortest way", lambda run: Pair(excess(passage(run, "ridge", 120)), 1),
           "by design, as above: the flank it came through is 5 mm away by then"),
    Check("rows without contact of an apex, valley of 150 degrees with height",
          lambda run: Pair(missed(passage(run, "valley", 150, HEIGHT)), 0, "rows", 1), 0, "the catalogue's bound"),
    Check("force, valley of 120 degrees with height", lambda run: Pair(error(passage(run, "valley", 120, HEIGHT)), 0, "", 1), EXACTLY,
          ROUND_OFF + "; flanks that face each other push each on its own"),
    Check("largest force, valley of 120 degrees", lambda run: Pair(excess(passage(run, "valley", 120)), 1), EXACTLY,
          "the catalogue's bound"),
    Report("end of the run, a block thrown into a notch of 120 degrees", thrown,
           "it must come out again; that contact makes no energy is a gate of all runs"),
]


def rows_of(run, passages_of):
    rows = []
    for kind, turn, height, *more in passages_of:
        one = passage(run, kind, turn, height, **(more[0] if more else {}))
        made = max(abs(e) for name, column in one.run.columns.items() if name.startswith("energy_created_") for e in column)
        scale = max(abs(e) for e in one.run.column("energy_sole_penalty"))
        rows.append([kind, f"{turn}°", f"{1e3 * height:g} mm", missed(one), f"{error(one):.1e}", f"{excess(one):.4f}",
                     f"{100 * made / scale:.2g} %", one.run.ending])
    return rows


COLUMNS = ["base", "turn", "contact height", "rows missed", "error of the force", "largest over exact", "created", "ended"]
STUDIES = [
    Table("Turns and heights. The force is over its largest exact value, the energy created over the largest that the penalty stored.",
          COLUMNS, lambda run: rows_of(run, [*((kind, turn, height) for kind in ("ridge", "valley", "peak", "pit")
                                               for height in (0.0, HEIGHT) for turn in (10, 45, 80, 90, 95, 120)
                                               if kind != "pit" or turn <= 90),
                                             ("valley", 150, 0.0), ("valley", 150, HEIGHT)]), full=True),
]

BREAKS = [
    Breaks("rows without contact of an apex", "the upper face of the block in place of its sole", {"contacts[0].apexes": "block.z_high"}),
    Breaks("largest force over the exact one of its row", "the full penalty in both directions", {"contacts[0].penalty": "4e8 Pa/m"}),
    Breaks("force, ridge", "a base that nobody holds", {"planes[0].kind": "constrained", "planes[0].normal": "[1, 0, 0]"}),
    Breaks("force, ridge with height", "the area of the facet in place of the apex's own", {"contacts[0].area": "base"}),
    Breaks("force, valley", "contact that is damped", {"contacts[0].damping_ratio": 0.1}),
    Breaks("force, valley with height", "friction that nobody asked for", {"contacts[0].friction": 0.1}),
    Breaks("force, peak and pit", "friction that nobody asked for", {"contacts[0].friction": 0.1}),
    Breaks("rows without contact of an apex, valley of 150 degrees with height", "the upper face of the block in place of its sole",
           {"contacts[0].apexes": "block.z_high"}),
    Breaks("force, valley of 120 degrees with height", "friction that nobody asked for", {"contacts[0].friction": 0.1}),
    Breaks("largest force, valley of 120 degrees", "the full penalty in both directions", {"contacts[0].penalty": "4e8 Pa/m"}),
    Breaks("force, ridge of 120 degrees: back the way it came", "a penalty one per cent too soft", {"contacts[0].penalty": "1.98e8 Pa/m"}),
]


def curves(passages_of, which, exact):
    """""Forces over the place across, the turn being at zero."""
    def measure(run):
        ones = [(label, passage(run, *of)) for label, *of in passages_of]
        return [(label, [1e3 * x for x, _, _ in one.places], [1e3 * which(f) for f in (one.exact if exact else one.forces)])
                for label, one in ones]
    return measure


ACROSS = [("ridge of 80°, no height", "ridge", 80, 0.0), ("ridge of 90°, 3 mm", "ridge", 90, HEIGHT),
          ("valley of 90°, no height", "valley", 90, 0.0)]
SHARP = [("valley of 120°, no height", "valley", 120, 0.0), ("valley of 120°, 3 mm", "valley", 120, HEIGHT),
             ("valley of 150°, 3 mm", "valley", 150, HEIGHT)]
PLACE = "place across the edge [mm]"

FIGURES = [
    Figure("across", PLACE, "force across the edge [mN]", curves(ACROSS, lambda f: f[0], False),
           curves([(f"{label}, exact", *of) for label, *of in ACROSS], lambda f: f[0], True), error=False,
           caption="Force on a block that is carried over a ridge and through a valley at a constant depth of 1 mm."),
    Figure("sharp", PLACE, "size of the force [mN]", curves(SHARP, size, False),
           curves([(f"{label}, exact", *of) for label, *of in SHARP], size, True), error=False,
           caption="Valleys sharper than a right angle. Without height the way out is the nearest; with height each flank pushes on its "
                   "own."),
]
