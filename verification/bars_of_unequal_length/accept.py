"""How close is close enough, why, and what must break."""
from reference import BARS, momentum_of_short, reference
from verify import Breaks, Check, Falls, Figure, Pair, Report, crossings

CATALOGUE = ("I-4",)
CLAIM = "A bar that hits a longer one exerts rho c V/2 per area for 2 L1/c and stops; the longer one leaves with V L1/L2."
EVIDENCE = "exact"
DRIVER = "scene"

EXACT = reference(**BARS)
INVISCID = {f"bodies[{i}].element.viscosity.{kind}": 0 for i in (0, 1) for kind in ("linear", "quadratic")}
MASS = {"short": EXACT["momentum"] / BARS["speed"], "long": EXACT["momentum"] / BARS["speed"] * BARS["long"] / BARS["short"]}  # [kg]


def force(run):
    """Of the contact, positive when it pushes. [N]"""
    return [-f for f in run.column("force")]


def plateau(run):
    first, length = EXACT["start"], EXACT["duration"]
    return Pair(-run.mean("force", first + 0.1 * length, first + 0.9 * length), EXACT["force"], "N")


def largest_error(run):
    """Of the force, from 5 to 90 % of the time of contact, over the exact one."""
    first, length = EXACT["start"], EXACT["duration"]
    inside = [f for t, f in zip(run.column("time"), force(run)) if first + 0.05 * length < t < first + 0.9 * length]
    return Pair(max(abs(f / EXACT["force"] - 1) for f in inside), 0, "", 1)


def duration(run):
    """From the first rise through half of the exact force to the last fall through it."""
    times = crossings(run.column("time"), force(run), level=EXACT["force"] / 2)
    return Pair(times[-1] - times[0], EXACT["duration"], "s")


def touching(run):
    """From the first touch to the last."""
    touched = [t for t, f in zip(run.column("time"), force(run)) if f > 0]
    return Pair(touched[-1] - touched[0], EXACT["duration"], "s")


def speed(bar, run):
    return run.column(f"{bar}_momentum")[-1] / MASS[bar]


def speed_of(bar):
    return lambda run: Pair(speed(bar, run), EXACT[f"{bar}_speed"], "m/s", scale=BARS["speed"])


def bare_speed_of(bar):
    """Without viscosity."""
    return lambda run: speed_of(bar)(run.again(INVISCID))


def restitution(run):
    return Pair((speed("long", run) - speed("short", run)) / BARS["speed"], EXACT["restitution"], "1")


def momentum(run):
    return Pair(run.ledger("momentum")[0], EXACT["momentum"], "N s")


DEPARTURES = {"viscosity": "two checks are of the bars without it, as in the exact solution; all others are by default"}

CHECKS = [
    Check("plateau force", plateau, 0.01, "the catalogue's bound; ringing averages out over the middle 80 % of the contact"),
    Check("largest error of the force, from 5 to 90 % of the contact", largest_error, 0.03, "the front is some cells wide"),
    Check("duration at half height", duration, 0.01,
          "the catalogue's bound; rise and fall are some elements wide, and their middles count"),
    Report("first to last touch", touching, "the tail of the fall pushes on with less than a tenth of the force"),
    Check("velocity of the short bar over V", speed_of("short"), 0.01, "the catalogue's bound; exact: at rest"),
    Check("velocity of the long bar over V", speed_of("long"), 0.01, "the catalogue's bound"),
    Check("without viscosity: velocity of the short bar over V", bare_speed_of("short"), 0.01,
          "the catalogue's bound; ringing makes the ends push and part in turns"),
    Check("without viscosity: velocity of the long bar over V", bare_speed_of("long"), 0.01, "as of the short bar"),
    Check("restitution", restitution, 0.01, "the catalogue's bound: e = L1/L2; both velocities err the same way, three times the long "
                                            "bar's error over V, twice that over e"),
    Check("momentum", momentum, 1e-12, "contact gives what it takes: round-off"),
]

STUDIES = [
    Falls("duration at half height", along="bodies[0].mesh.cells[0]", values=[25, 50, 100]),
]

BREAKS = [
    Breaks("plateau force", "a penalty a hundred times too soft", {"contacts[0].method": "penalty", "contacts[0].penalty_scale": 0.02}),
    Breaks("largest error of the force, from 5 to 90 % of the contact", "a penalty", {"contacts[0].method": "penalty"}),
    Breaks("duration at half height", "both bars of one length", {"bodies[0].mesh.low": "[-1 m, 0 m, 0 m]",
                                                                  "bodies[0].mesh.cells": "[200, 1, 1]"}),
    Breaks("velocity of the short bar over V", "ends that do not let go: tied", {"contacts[0].kind": "tied"}),
    Breaks("velocity of the long bar over V", "a long bar of half the density", {"bodies[1].material.density": "3925 kg/m^3"}),
    Breaks("without viscosity: velocity of the short bar over V", "ends that do not let go: tied", {"contacts[0].kind": "tied"}),
    Breaks("without viscosity: velocity of the long bar over V", "a long bar of half the density",
           {"bodies[1].material.density": "3925 kg/m^3"}),
    Breaks("restitution", "ends that do not let go: tied", {"contacts[0].kind": "tied"}),
    Breaks("momentum", "gravity left on along the bars", {"gravity": "[9.81 m/s^2, 0 m/s^2, 0 m/s^2]"}),
]


def force_over_time(run):
    return [("Nereid", [1e3 * t for t in run.column("time")], [1e-3 * f for f in force(run)])]


def exact_force(run):
    start, end = EXACT["start"], EXACT["start"] + EXACT["duration"]
    times = [0, start, start, end, end, run.column("time")[-1]]
    return [("exact", [1e3 * t for t in times], [1e-3 * f for f in (0, 0, EXACT["force"], EXACT["force"], 0, 0)])]


def speeds_over_time(run):
    times = [1e3 * t for t in run.column("time")]
    return [(f"{bar} bar", times, [p / MASS[bar] for p in run.column(f"{bar}_momentum")]) for bar in ("short", "long")]


def exact_speeds(run):
    times = [0, EXACT["start"], EXACT["start"] + EXACT["duration"], run.column("time")[-1]]
    short = [momentum_of_short(EXACT, t) for t in times]
    return [("exact, short", [1e3 * t for t in times], [p / MASS["short"] for p in short]),
            ("exact, long", [1e3 * t for t in times], [(EXACT["momentum"] - p) / MASS["long"] for p in short])]


FIGURES = [
    Figure("force", "time [ms]", "force of contact [kN]", force_over_time, exact=exact_force,
           caption="Force between the bars: a rectangle as long as a wave goes up and down the short bar."),
    Figure("velocity", "time [ms]", "mean velocity [m/s]", speeds_over_time, exact=exact_speeds,
           caption="Mean velocities: the short bar comes to rest and stays."),
]
