"""How close is close enough, why, and what must break."""
from math import cos, radians, sin

from reference import BAR, inertia, speeds_after
from verify import Breaks, Check, Figure, Pair, Report, Table, created

CATALOGUE = ("C-10",)
CLAIM = ("Bars that cross ridge on ridge, at any angle down to parallel, and cubes that meet corner on corner, exchange their momenta as "
         "rigid bodies do; no node needs to come into the other body.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/crossing_bars/"
V = 1.0  # [m/s]
MASS, _ = inertia(**BAR)
CUBE = 7850 * 0.02**3
PLATE = 7850 * 0.1 * 0.04 * 0.002
ROUND_OFF = 1e-9
ANGLES = (90, 45, 5, 1, 0.1, 0)


def turned(degrees):
    """The upper bar turned from the lower one about the vertical."""
    c, s = cos(radians(degrees)), sin(radians(degrees))
    return {"bodies[1].mesh.map": f'["{c!r}*x - {s!r}*(y - z)/sqrt(2)", "{s!r}*x + {c!r}*(y - z)/sqrt(2)", "(y + z)/sqrt(2)"]'}


def speeds(run, mass=MASS):
    """Of the upper and of the lower body at the end, along the way of the upper one."""
    return -run.column("upper_z")[-1] / mass, -run.column("lower_z")[-1] / mass


def lower(degrees):
    return lambda run: Pair(speeds(run.again(turned(degrees)) if degrees != 90 else run)[1], V, "m/s")


OFF = 0.02  # [m] from the centre of the lower bar
STRUCK = {"bodies[1].move": f"[{OFF} m, 0 m, 14.3 mm]"}


def off_centre(run):
    return Pair(speeds(run.again({**STRUCK, **run.overrides}))[1], speeds_after(V, 0, OFF)[1], "m/s")


def corners(run):
    there = run.other("scene", HERE + "corners.yaml", run.overrides)
    return Pair(speeds(there, CUBE)[1], V, "m/s")


def rims(run):
    return run.other("scene", HERE + "plates.yaml", run.overrides)


def plates(run):
    return Pair(speeds(rims(run), PLATE)[1], V, "m/s")


def touch(run):
    there = rims(run)
    first = next((t for t, f in zip(there.column("time"), there.column("force")) if f != 0), float("nan"))
    return Pair(first, 0.5e-3 / V, "s")


ELASTIC = {"bodies[0].rigid": "false", "bodies[1].rigid": "false"}
EXCHANGED = {"contacts[0].apexes": "lower.skin", "contacts[0].base": "upper.skin"}


def made(run):
    """Created energy of elastic bars, of all sources at any time."""
    return created(run.again({**ELASTIC, **run.overrides}))


def elastic(run):
    return Pair(speeds(run.again(ELASTIC))[1], V, "m/s")


def sides(run):
    """A break is in the exchanged run alone."""
    one, other = speeds(run.other(DRIVER, run.case_file, ELASTIC)), speeds(run.again({**ELASTIC, **EXCHANGED}))
    return Pair(other[1], one[1], "m/s", scale=V)


def one_pass(run):
    return Pair(speeds(run.again({"contacts[0].passes": "one"}))[1], V, "m/s")


DEPARTURES = {"passes": "where ridges are parallel the nodes of both bars touch, and one pass would see those of one bar alone"}

CHECKS = [
    *(Check(f"speed of the lower bar, {angle} degrees", lower(angle), ROUND_OFF, "one pair of ridges, one impulse: exact to round-off")
      for angle in ANGLES if angle > 0),
    Check("speed of the lower bar, 0 degrees", lower(0), 3e-5,
          "many nodes share the blow; iterations end when one changes what the impulses do by less than 1e-5, and the worst is three such"),
    Check("speed of the lower bar, struck off its centre", off_centre, 2e-6,
          "bars turn by less than 1e-5 in the step of the blow, whose arm is that of its start"),
    Check("speed of the lower cube, corner on corner", corners, ROUND_OFF, "one impulse through both centres: exact to round-off"),
    Check("speed of the lower plate, rim on rim", plates, ROUND_OFF, "one impulse through both centres: exact to round-off"),
    Check("plates touch at half of both thicknesses", touch, 0.011, "a row of the history is 1 % of the time"),
    Check("speed of the lower bar, one pass", one_pass, ROUND_OFF, "edges need no second pass, so it is one impulse as with two"),
    Check("elastic bars with the sides exchanged", sides, 1e-9, "edges are the same from both sides, and two passes have all nodes",
          evidence="invariant"),
    Report("created energy of elastic bars", made, "a penalty at its longest step has the same; the gate of all runs has it"),
    Report("speed of an elastic lower bar", elastic, "part of the momentum stays, and the bars ring: no bar is rigid"),
]

BREAKS = [
    Breaks("speed of the lower bar, 90 degrees", "no edges: the bars go through each other",
           {"contacts[0].edges": "false", "time.overlap_limit": "100"}),
    Breaks("speed of the lower bar, 5 degrees", "a lower bar that is 5 % heavier", {"bodies[0].material.density": "8240 kg/m^3"}),
    Breaks("speed of the lower bar, struck off its centre", "restitution 0.9", {"contacts[0].restitution": "0.9"}),
    Breaks("speed of the lower cube, corner on corner", "restitution 0.9", {"contacts[0].restitution": "0.9"}),
    Breaks("speed of the lower plate, rim on rim", "restitution 0.9", {"contacts[0].restitution": "0.9"}),
    Breaks("plates touch at half of both thicknesses", "a lower plate a fifth thicker", {"bodies[0].element.thickness": "2.4 mm"}),
    *(Breaks(f"speed of the lower bar, {which}", "a lower bar that is 5 % heavier", {"bodies[0].material.density": "8240 kg/m^3"},
             full=True) for which in ("45 degrees", "1 degrees", "0.1 degrees", "0 degrees", "one pass")),
    Breaks("elastic bars with the sides exchanged", "restitution 0.9 where the sides are exchanged", {"contacts[0].restitution": "0.9"},
           full=True),
]


def by_angle(run):
    rows = []
    for angle in ANGLES:
        rigid, soft = run.again(turned(angle)), run.again({**turned(angle), **ELASTIC})
        a, b, c, d = *speeds(rigid), *speeds(soft)
        rows.append([f"{angle:g}", f"{abs(b - a) / V:.9f}", f"{d - c:.4f}", f"{soft.result('touch_edges_deepest') * 1e6:.3g}"])
    return rows


STUDIES = [Table("Speed apart over the speed of approach, of rigid bars (exactly 1) and of elastic ones, which keep ringing, and how deep "
                 "ridges of these went [um].", ["angle [degrees]", "rigid", "elastic", "deepest"], by_angle, full=True)]


def momenta(run):
    curves = []
    for body, one in (("rigid", run), ("elastic", run.again(ELASTIC))):
        for name in ("upper", "lower"):
            curves.append((f"{body}, {name}", [1e3 * t for t in one.column("time")], [-p / MASS for p in one.column(f"{name}_z")]))
    return curves


FIGURES = [Figure("speeds", "time [ms]", "speed down [m/s]", momenta,
                  caption="Speeds of two bars that cross at 90 degrees: the lower one takes over what the upper one brings.")]
