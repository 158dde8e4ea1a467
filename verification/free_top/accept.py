"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import brick, turnings
from verify import Breaks, Check, Figure, Pair, crossings

CATALOGUE = ()
CLAIM = "A free asymmetric top keeps energy and angular momentum over a hundred turns, and turns over when the exact one does."
EVIDENCE = "exact"
DRIVER = "scene"

EDGES = (0.1, 0.2, 0.05)                       # [m]
MASS = 7850 * EDGES[0] * EDGES[1] * EDGES[2]   # [kg]
INERTIA = brick(MASS, *EDGES)
SPIN, FLIGHT = (100.0, 1.0, 1.0), (1.0, 2.0, 3.0)  # [rad/s] [m/s]
ENERGY = 0.5 * sum(J * w * w for J, w in zip(INERTIA, SPIN)) + 0.5 * MASS * sum(v * v for v in FLIGHT)
MOMENTUM = [J * w for J, w in zip(INERTIA, SPIN)]  # about the centre: it starts at the origin and flies straight
TIMES = turnings(INERTIA, SPIN, 2.0)


def energy(run):
    """The farthest from that of the start, at any row."""
    return Pair(max(run.column("kinetic"), key=lambda K: abs(K - ENERGY)), ENERGY, "J")


def momentum(run):
    """The largest change of a component, over the size."""
    size = sqrt(sum(L * L for L in MOMENTUM))
    off = max(abs(L - exact) for axis, exact in zip("xyz", MOMENTUM) for L in run.column(f"momentum_{axis}"))
    return Pair(off, 0, "N m s", scale=size)


def axis(run):
    """The first axis of the body at each row: from one corner to the next."""
    rows = zip(*(run.column(f"{node}_{axis}") for node in ("corner", "left") for axis in "xyz"))
    return [[(row[i] - row[i + 3]) / EDGES[0] for i in range(3)] for row in rows]


def length(run):
    """Of an edge over the exact one, the farthest from one."""
    found = (sqrt(sum(e * e for e in one)) for one in axis(run))
    return Pair(max(found, key=lambda d: abs(d - 1)), 1, "1")


def flight(run):
    return Pair(run.column("flight")[-1], FLIGHT[2] * run.column("time")[-1], "m")


def own_spin(run):
    """Spin about the first axis of the body."""
    spins = zip(*(run.column(f"spin_{axis}") for axis in "xyz"))
    return [sum(w * e for w, e in zip(spin, one)) for spin, one in zip(spins, axis(run))]


def turning(run):
    """When it turns over the last time before 2 s."""
    times, spin = run.column("time"), own_spin(run)
    found = [t for rising in (True, False) for t in crossings(times, spin, rising=rising) if t < 2]
    return Pair(max(found, default=float("nan")), TIMES[-1], "s")


CHECKS = [
    Check("kinetic energy over a hundred turns, the farthest", energy, 1e-6, "a millionth; the method keeps it to round-off"),
    Check("angular momentum about the origin, the largest change", momentum, 1e-10,
          "nothing changes it; the moment of the flight, positions times momenta, is rounded"),
    Check("length of an edge, the farthest", length, 1e-6, "positions follow from one rotation; the history has seven digits or more"),
    Check("flight along z", flight, 1e-9, "no force acts"),
    Check("when it turns over the last time before 2 s", turning, 0.01,
          "second order: 0.02 rad in a step make a phase error of 3e-5, which a turn-over magnifies"),
]

BREAKS = [
    Breaks("kinetic energy over a hundred turns, the farthest", "a spring to the ground", {
        "springs": "[{name: k, from: top.corner, to: ground, stiffness: 10 N/m}]"}),
    Breaks("angular momentum about the origin, the largest change", "a moment of a newton millimetre", {
        "loads": "[{name: m, kind: moment, nodes: top, value: ['0', '1e-3', '0'], unit: N*m}]"}),
    Breaks("length of an edge, the farthest", "a brick that is a micrometre longer", {
        "bodies[0].mesh.high": "[50 mm, 100.001 mm, 25 mm]"}),
    Breaks("flight along z", "gravity of a micrometre per second squared", {"gravity": "[0 m/s^2, 0 m/s^2, -1e-6 m/s^2]"}),
    Breaks("when it turns over the last time before 2 s", "a given inertia, 2 % larger about y", {
        "bodies[0].mass_properties": "{inertia: [0.0277979 kg*m^2, 0.00834e0 kg*m^2, 0.0327083 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]}"}),
]


def spins(run):
    return [("spin", run.column("time"), own_spin(run))]


FIGURES = [Figure("spin", "time [s]", "spin about the middle axis [rad/s]", spins, caption="Spin of a free brick about its middle axis.")]
