"""How close is close enough, why, and what must break."""
from math import cos, sin, sqrt

from reference import ASIDE, BESIDE, FACING, LAST, SOUND, STEP, TRANSIT, plane_wave
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ()
CLAIM = "A cylindrical shell in water that a plane wave hits from the side moves as the series of modes, and at first as a plate."
EVIDENCE = "exact"
DRIVER = "scene"

ARRIVAL = 0.2 / SOUND  # [s] from the boundary to the shell
TIMES = [number * STEP for number in range(1, 31)]  # [s] after the arrival, to 0.6 of the transit
# Cells half as long; the shell then touches the water at 1 m - 5 mm/cos(0.005)
FINE = {"refine": 2, "bodies[1].mesh.map": '["-0.9949999375*cos(x)", "0.9949999375*sin(x)", "y"]'}
EARLY = [t for t in TIMES if t < 0.1001 * TRANSIT]


def front(run, t):
    """Velocity of the line that faces the wave, this long after the arrival. [m/s]"""
    return run.at("velocity", ARRIVAL + t)


def aside(run, t):
    """Velocity inwards of the second place. [m/s]"""
    return cos(ASIDE) * run.at("aside_x", ARRIVAL + t) - sin(ASIDE) * run.at("aside_y", ARRIVAL + t)


def early(run):
    """Largest difference from the plane wave approximation, over the velocity to which that goes."""
    return Pair(max(abs(front(run, t) - plane_wave(t)) for t in EARLY) / LAST, 0, "", scale=1)


def from_modes(velocity, exact):
    """A measure: root mean square of the difference from the series of modes, over the same."""
    def measure(run):
        squares = [(velocity(run, t) - 1e-3 * true)**2 for t, true in zip(TIMES, exact)]
        return Pair(sqrt(sum(squares) / len(squares)) / LAST, 0, "", scale=1)
    return measure


CHECKS = [
    Check("facing line, to 0.6 a/c: modes", from_modes(front, FACING), 0.01,
          "root mean square over the final velocity. The front is some cells wide, a twentieth of this time, and off by some per cent"),
    Check("at 0.52 rad, to 0.6 a/c: modes", from_modes(aside, BESIDE), 0.03,
          "the same. The front crosses the cells obliquely there, and is three times as wide as at the facing line"),
    Check("facing line, to 0.6 a/c, cells half as long: modes",
          lambda run: from_modes(front, FACING)(run.again(FINE)), 0.005, "half of the limit above: the front is half as wide", full=True),
    Check("at 0.52 rad, to 0.6 a/c, cells half as long: modes",
          lambda run: from_modes(aside, BESIDE)(run.again(FINE)), 0.015, "half of the limit above", full=True),
    Report("facing line, to 0.1 a/c: plane wave approximation", early,
           "largest difference over the final velocity. The approximation is off by 1.9 % at 0.1 a/c, and the front is some cells wide"),
]


def times(run):
    rows = []
    for number in (1, 2, 3, 5, 8, 10, 15, 20, 25, 30):
        t, facing, beside = TIMES[number - 1], FACING[number - 1], BESIDE[number - 1]
        rows.append([f"{t / TRANSIT:.2f}", f"{1e3 * front(run, t):.2f}", f"{facing:.2f}", f"{1e3 * plane_wave(t):.2f}",
                     f"{100 * (1e3 * plane_wave(t) / facing - 1):.1f} %", f"{1e3 * aside(run, t):.2f}", f"{beside:.2f}"])
    return rows


STUDIES = [
    Table("Velocities inwards in mm/s, over the time after the arrival in a/c: at the facing line and at 0.52 rad.",
          ["time", "facing line", "modes", "plane wave", "its error", "at 0.52 rad", "modes"], times),
]

LEAD = {"bodies[1].material.young": "16 GPa"}
BREAKS = [
    Breaks("facing line, to 0.6 a/c: modes", "the density of aluminium", {"bodies[1].material.density": "2700 kg/m^3"}),
    Breaks("facing line, to 0.6 a/c: modes", "a boundary with the impedance of concrete", {"loads[0].impedance": "9e6 kg/(m^2 s)"}),
    Breaks("facing line, to 0.6 a/c: modes", "the modulus of lead", LEAD),
    Breaks("at 0.52 rad, to 0.6 a/c: modes", "the modulus of lead", LEAD),
    Breaks("facing line, to 0.6 a/c, cells half as long: modes", "the modulus of lead", LEAD, full=True),
    Breaks("at 0.52 rad, to 0.6 a/c, cells half as long: modes", "the modulus of lead", LEAD, full=True),
]


def curves(run):
    found = [(t - ARRIVAL) / TRANSIT for t in run.column("time")]
    return [("Nereid, facing line", found, [1e3 * v for v in run.column("velocity")]),
            ("Nereid, at 0.52 rad", found, [1e3 * (cos(ASIDE) * vx - sin(ASIDE) * vy)
                                            for vx, vy in zip(run.column("aside_x"), run.column("aside_y"))])]


def exact(run):
    found = [0.0, *(t / TRANSIT for t in TIMES)]
    return [("modes, facing line", found, [0.0, *FACING]), ("modes, at 0.52 rad", found, [0.0, *BESIDE]),
            ("plane wave approximation", found, [0.0, *(1e3 * plane_wave(t) for t in TIMES)])]


FIGURES = [
    Figure("velocity", "time after the arrival [a/c]", "velocity inwards [mm/s]", curves, exact, error=False,
           caption="Velocity of the shell where it faces the wave, and at 0.52 rad from there."),
]
