"""How close is close enough, why, and what must break."""
from math import cos, hypot, pi, sin

from reference import compressible_frequency, frequency, period
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table, Waiver, crossings, mean_over

CATALOGUE = ()
CLAIM = ("A wave in a tank of fluid has the frequency of linear theory within 1 % at two depths, on regular and on skewed cells, and keeps "
         "its height.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/sloshing/"
SHALLOW, SKEWED = "shallow.yaml", "skewed.yaml"
DEPTHS = {"case.yaml": 0.5, SKEWED: 0.5, SHALLOW: 0.2}  # [m]
PERIODS, HEIGHT = 6, 0.002  # [-] [m] of the wave
TRUE = {"bodies[0].material.sound_speed": "1482 m/s"}


def of(run, name):
    """The run of a scene of this folder; a break may be one itself."""
    return run if run.case_file.name == name else run.other("scene", HERE + name)


def measured(run):
    """Of all whole periods. [rad/s]"""
    ups = crossings(run.column("time"), run.column("wave"), rising=True)
    return 2 * pi * (len(ups) - 1) / (ups[-1] - ups[0])


def frequency_of(name, change=None):
    def measure(run):
        one = of(run, name)
        return Pair(measured(one.again(change) if change else one), frequency(DEPTHS[name]), "rad/s")
    return measure


def height(run, depth, number):
    """Of the wave in one period, counted from 0: the part of the displacement with the frequency of theory. [m]"""
    times, up, omega, T = run.column("time"), run.column("wave"), frequency(depth), period(depth)
    parts = [mean_over(times, [u * f(omega * t) for t, u in zip(times, up)], number * T, (number + 1) * T) for f in (cos, sin)]
    return 2 * hypot(*parts)


def kept(name):
    """Height in the sixth period beside that in the first."""
    def measure(run):
        one = of(run, name)
        return Pair(height(one, DEPTHS[name], PERIODS - 1), height(one, DEPTHS[name], 0), "m")
    return measure


def at_first(name):
    return lambda run: Pair(height(of(run, name), DEPTHS[name], 0), HEIGHT, "m")


def share_of(one):
    """What viscosity and dashpots take, over the kinetic energy at the start."""
    return sum(part["value"] for part in one.account("water")["dissipated"].values()) / one.ledger("initial_kinetic")


def dissipated(run):
    """The worst tank."""
    return Pair(max(share_of(of(run, name)) for name in DEPTHS), 0, "", scale=1)


def of_surface(name):
    """The largest energy of the wave against the kinetic energy at the start: in a standing wave each becomes the other."""
    def measure(run):
        one = of(run, name)
        return Pair(one.result("surface_largest"), one.ledger("initial_kinetic"), "J")
    return measure


SEEN = "the bound asked for; the mesh slows the wave by 0.3 %, which falls with its cells (study), and compressibility does 0.006 %"
FLAT = "dashpots and viscosity are of the third order in the height, so of a flat wave a user expects to see nothing of them in six periods"
STANDING = ("linear theory: it is the kinetic energy of the start; velocities of theory at the nodes are not quite those of a mode of the "
            "mesh, so a part of them stays motion")
CHECKS = [
    Check("deep: frequency", frequency_of("case.yaml"), 0.01, SEEN),
    Check("shallow: frequency", frequency_of(SHALLOW), 0.01, SEEN),
    Check("deep, skewed cells: frequency", frequency_of(SKEWED), 0.01, "as on regular cells"),
    Check("deep, true speed of sound: frequency", frequency_of("case.yaml", TRUE), 0.01, "as with 60 m/s", full=True),
    Check("deep: height in the sixth period beside the first", kept("case.yaml"), 0.01, FLAT),
    Check("shallow: height in the sixth period beside the first", kept(SHALLOW), 0.01, FLAT),
    Check("deep, skewed cells: height in the sixth period beside the first", kept(SKEWED), 0.01, FLAT),
    Check("deep: largest energy of the wave on the surface", of_surface("case.yaml"), 0.01, STANDING),
    Check("shallow: largest energy of the wave on the surface", of_surface(SHALLOW), 0.01, STANDING),
    Check("energy that is dissipated in six periods, worst of three tanks", dissipated, 1e-5,
          "viscosity goes with the square of the strain and dashpots with what cells shear: the height over the depth is 0.01 at most, and "
          "a tenth of its square is left"),
    Report("deep: height in the first period", at_first("case.yaml"), "velocities of theory at the nodes are not quite those of the mesh"),
    Report("shallow: height in the first period", at_first(SHALLOW), "the same"),
]


def higher(run):
    """Rows of waves that are not flat: six periods by their height."""
    rows = []
    for times in (1, 5, 10):
        row = [f"{1e3 * times * HEIGHT:.0f}"]
        for name in ("case.yaml", SHALLOW):
            one = of(run, name).again(raised(name, times))
            row += [f"{100 * (measured(one) / frequency(DEPTHS[name]) - 1):.2f} %",
                    f"{100 * (kept(name)(one).got / kept(name)(one).expected - 1):.1f} %", f"{100 * share_of(one):.2g} %"]
        rows.append(row)
    return rows


def raised(name, times):
    """Velocities at the start so many times those of the case."""
    depth = DEPTHS[name]
    speed = times * HEIGHT * frequency(depth)
    return {"initial[0].velocity": f'["-{speed:.7g}*sin(pi*x)*cosh(pi*z)/sinh({depth:g}*pi)", "0", '
                                   f'"{speed:.7g}*cos(pi*x)*sinh(pi*z)/sinh({depth:g}*pi)"]'}


def sounds(run):
    """Rows of speeds of sound: what theory says of compressible water, and what came out."""
    rows = []
    for speed in (20, 30, 60):
        row = [f"{speed}"]
        for name in ("case.yaml", SHALLOW):
            one = of(run, name).again({"bodies[0].material.sound_speed": f"{speed} m/s"})
            row += [f"{100 * (compressible_frequency(DEPTHS[name], speed) / frequency(DEPTHS[name]) - 1):.4f} %",
                    f"{100 * (measured(one) / frequency(DEPTHS[name]) - 1):.4f} %"]
        rows.append(row)
    return rows


STUDIES = [
    Falls("deep: frequency", along="bodies[0].mesh.cells", values=["[10, 1, 5]", "[20, 1, 10]", "[40, 1, 20]"], order=1.5, full=True),
    Table("Speed of sound [m/s]: frequency beside that of water that keeps its volume, by theory and as it came out.",
          ["speed", "deep: theory", "deep", "shallow: theory", "shallow"], sounds, full=True),
    Table("Height of the wave [mm]: frequency beside linear theory, height in the sixth period beside the first, and energy that is "
          "dissipated in six periods over the kinetic energy at the start.",
          ["height", "deep: frequency", "height", "dissipated", "shallow: frequency", "height", "dissipated"], higher, full=True),
]

WAIVERS = [Waiver("unexplained energy over the largest that passed", lambda run: run.case("bodies[0].material.sound_speed") > 1000,
                  "positions are rounded in 200,000 steps and more, and the energy of a flat wave is small", 1e-9, full=True)]
RADIATING = {"loads": '[{name: open, kind: radiation, surface: water.z_high, value: "0", unit: Pa, impedance: 10 kg/(m^2 s)}]'}
BREAKS = [
    Breaks("deep: largest energy of the wave on the surface", "the wall of the tank in place of the surface",
           {"probes[1].of": "water.x_high"}),
    Breaks("shallow: largest energy of the wave on the surface", "the wall of the tank in place of the surface",
           {"probes[1].of": "water.x_high"}, case=HERE + SHALLOW),
    Breaks("deep: frequency", "gravity 3 % too small", {"gravity": "[0 m/s^2, 0 m/s^2, -9.5 m/s^2]"}),
    Breaks("shallow: frequency", "a depth of 21 cm", {"bodies[0].mesh.high": "[1 m, 0.1 m, 0.21 m]"}, case=HERE + SHALLOW),
    Breaks("deep, skewed cells: frequency", "a coarser mesh", {"bodies[0].mesh.cells": "[10, 1, 5]"}, case=HERE + SKEWED),
    Breaks("deep, true speed of sound: frequency", "a coarser mesh", {"bodies[0].mesh.cells": "[10, 1, 5]"}, full=True),
    Breaks("deep: height in the sixth period beside the first", "a surface through which waves leave", RADIATING),
    Breaks("shallow: height in the sixth period beside the first", "a surface through which waves leave", RADIATING, case=HERE + SHALLOW),
    Breaks("deep, skewed cells: height in the sixth period beside the first", "a surface through which waves leave", RADIATING,
           case=HERE + SKEWED),
    Breaks("energy that is dissipated in six periods, worst of three tanks", "water that starts with an even pressure and falls",
           {"bodies[0].start.hydrostatic": "false", "time.end": "0.5 s"}),
]


def waves(run):
    return [(words, [t / period(DEPTHS[name]) for t in of(run, name).column("time")], [1e3 * u for u in of(run, name).column("wave")])
            for name, words in (("case.yaml", "0.5 m deep"), (SHALLOW, "0.2 m deep"))]


def theory(run):
    return [("linear theory", [i / 100 for i in range(611)], [1e3 * HEIGHT * sin(2 * pi * i / 100) for i in range(611)])]


FIGURES = [Figure("wave", "time over the period of theory [-]", "rise of the corner [mm]", waves, exact=theory,
                  caption="Water at the end of the tank rises and falls; the error is of the mesh and grows with time.")]
