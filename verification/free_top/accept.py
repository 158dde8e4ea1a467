"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import brick, edge_of_symmetric, turnings
from verify import Breaks, Check, Falls, Figure, Pair, crossings

CATALOGUE = ()
CLAIM = ("A free asymmetric top keeps energy and angular momentum over a hundred turns and turns over when the exact one does; a symmetric "
         "one ends as the exact one does.")
EVIDENCE = "exact"
DRIVER = "scene"

EDGES = (0.1, 0.2, 0.05)                       # [m]
MASS = 7850 * EDGES[0] * EDGES[1] * EDGES[2]   # [kg]
INERTIA = brick(MASS, *EDGES)
SPIN, FLIGHT, END = (100.0, 1.0, 2.0), (0.1, 0.2, 0.3), 6.2832  # [rad/s] [m/s] [s]
ENERGY = 0.5 * sum(J * w * w for J, w in zip(INERTIA, SPIN)) + 0.5 * MASS * sum(v * v for v in FLIGHT)
MOMENTUM = [J * w for J, w in zip(INERTIA, SPIN)]  # about the origin, from which its centre starts
TIMES = turnings(INERTIA, SPIN, END)
SYMMETRIC = {"bodies[0].mesh.low": "[-50 mm, -50 mm, -25 mm]", "bodies[0].mesh.high": "[50 mm, 50 mm, 25 mm]",
             "bodies[0].points[0].near": "[50 mm, 50 mm, 25 mm]", "bodies[0].points[1].near": "[-50 mm, 50 mm, 25 mm]"}


def energy(run):
    """The farthest from that of the start, at any row."""
    return Pair(max(run.column("kinetic"), key=lambda K: abs(K - ENERGY)), ENERGY, "J")


def momentum(run):
    """The largest change of a component, over the size."""
    size = sqrt(sum(L * L for L in MOMENTUM))
    off = max(abs(L - exact) for axis, exact in zip("xyz", MOMENTUM) for L in run.column(f"momentum_{axis}"))
    return Pair(off, 0, "N m s", scale=size)


def edge(run):
    """The vector from one corner to the next over its length, which is the first axis of the body, at each row."""
    rows = zip(*(run.column(f"{node}_{axis}") for node in ("corner", "left") for axis in "xyz"))
    return [[(row[i] - row[i + 3]) / EDGES[0] for i in range(3)] for row in rows]


def length(run):
    """Of an edge over the exact one, the farthest from one."""
    found = (sqrt(sum(e * e for e in one)) for one in edge(run))
    return Pair(max(found, key=lambda d: abs(d - 1)), 1, "1")


def flight(run):
    return Pair(run.column("flight")[-1], FLIGHT[2] * run.column("time")[-1], "m")


def own_spin(run):
    """Spin about the first axis of the body."""
    spins = zip(*(run.column(f"spin_{axis}") for axis in "xyz"))
    return [sum(w * e for w, e in zip(spin, one)) for spin, one in zip(spins, edge(run))]


def turning(run):
    """When it turns over for the last time."""
    times, spin = run.column("time"), own_spin(run)
    return Pair(max([t for rising in (True, False) for t in crossings(times, spin, rising=rising)], default=float("nan")), TIMES[-1], "s")


def number(run):
    times, spin = run.column("time"), own_spin(run)
    return Pair(sum(len(crossings(times, spin, rising=rising)) for rising in (True, False)), len(TIMES), "")


def pointing(run):
    """Where the edge of a symmetric brick points in the end, less where it should."""
    one = run.again({**SYMMETRIC, **run.overrides})
    exact = edge_of_symmetric(brick(MASS / 2, 0.1, 0.1, 0.05), SPIN, one.column("time")[-1])
    return Pair(sqrt(sum((a - b) ** 2 for a, b in zip(edge(one)[-1], exact))), 0, "", scale=1)


CHECKS = [
    Check("kinetic energy over a hundred turns, the farthest", energy, 1e-6, "a millionth is asked; the method keeps it to round-off"),
    Check("angular momentum about the origin, the largest change", momentum, 1e-10, "nothing changes it; the flight's moment is rounded"),
    Check("length of an edge, the farthest", length, 1e-10, "positions follow from one rotation, so this is round-off"),
    Check("flight along z", flight, 1e-10, "no force acts"),
    Check("how often it turns over", number, 1e-9, "a number of events"),
    Check("when it turns over for the last time", turning, 1e-4,
          "fourth order: 1e-8 of an angle with 0.02 rad in a step, which each turn-over magnifies; a hundredth is asked"),
    Check("where an edge of a symmetric brick points after a hundred turns", pointing, 1e-5,
          "1e-8 of 628 rad; a midpoint rule alone, of second order, would be off by 0.02"),
]

STUDIES = [
    Falls("where an edge of a symmetric brick points after a hundred turns", along="time.largest_step",
          values=["0.2 ms", "0.141 ms", "0.1 ms"], order=3.8, full=True),
]

ELASTIC = {"bodies[0].rigid": "false", "bodies[0].material.young": "1 GPa"}
ROUNDED = {"bodies[0].mass_properties.inertia": "[0.0278 kg*m^2, 0.0082 kg*m^2, 0.0327 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]"}
BREAKS = [
    Breaks("kinetic energy over a hundred turns, the farthest",
           "an elastic brick of one element: its lumped masses have thrice the inertia", ELASTIC),
    Breaks("angular momentum about the origin, the largest change", "moments of inertia with three digits", ROUNDED),
    Breaks("length of an edge, the farthest", "an elastic brick, which its spin stretches", ELASTIC),
    Breaks("flight along z", "gravity of a micrometre per second squared", {"gravity": "[0 m/s^2, 0 m/s^2, -1e-6 m/s^2]"}),
    Breaks("how often it turns over", "2 rad/s about y and none about z",
           {"initial[0].velocity": "['0.1 + 2*z', '0.2 - 100*z', '0.3 + 100*y - 2*x']"}),
    Breaks("when it turns over for the last time", "moments of inertia with three digits", ROUNDED),
    Breaks("where an edge of a symmetric brick points after a hundred turns", "a brick a micrometre thicker",
           {**SYMMETRIC, "bodies[0].mesh.high": "[50 mm, 50 mm, 25.001 mm]"}),
]


def spins(run):
    return [("spin", run.column("time"), own_spin(run))]


def exact_turnings(_):
    """The times of the exact turn-overs, on the axis."""
    return [("exact turn-overs", TIMES, [0.0] * len(TIMES))]


FIGURES = [Figure("spin", "time [s]", "spin about the middle axis [rad/s]", spins, exact=exact_turnings, error=False,
                  caption="Spin of a free brick about its middle axis, and the times at which the exact one turns over.")]
