"""How close is close enough, why, and what must break."""
from math import hypot, sqrt

from reference import (AIR, ATMOSPHERE, GRAVITY, HEIGHT, LENGTH, SOUND_OF_AIR, SOUND_OF_WATER, WATER, WIDTH, floor_force,
                       height_of_centroid, pressure)
from verify import Breaks, Check, Figure, Pair, Table, Waiver

CATALOGUE = ()
CLAIM = ("A fluid that starts with hydrostatic pressure stays at rest for 100,000 steps on any mesh, below a free surface or a lid, and "
         "has the pressures and the weight of theory.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/still_tank/"
SKEWED, SHOCK, GAS, FALLING = "skewed.yaml", "mie_gruneisen.yaml", "gas.yaml", "falling.yaml"
CELL = 0.1  # [m]
TANKS = {"case.yaml": "in layers", SKEWED: "skewed", SHOCK: "by Mie and Grueneisen", GAS: "air below a lid"}
FIRST_STEP = {"time.end": "0.2 ms", "output.history_every": "1e-3 us", "output.frames_every": "0.2 ms"}
LEAST = 1e5  # steps


def of(run, name):
    """The run of a scene of this folder; a break may be one itself."""
    return run if run.case_file.name == name else run.other("scene", HERE + name)


def fluid(name):
    """Density, speed of sound and pressure at the top."""
    return (AIR, SOUND_OF_AIR, ATMOSPHERE) if name == GAS else (WATER, SOUND_OF_WATER, 0.0)


def mean_speed(energy, name):
    """Root mean square over the mass. [m/s]"""
    return sqrt(2 * energy / (fluid(name)[0] * LENGTH * WIDTH * HEIGHT))


def speed(name):
    """The largest of all steps, over the speed of sound."""
    def measure(run):
        return Pair(mean_speed(of(run, name).result("energy_largest"), name) / fluid(name)[1], 0, "", scale=1)
    return measure


def first_step(run, name):
    """Speed after the first step, over what gravity alone makes of it there."""
    one = run.again(FIRST_STEP)
    return Pair(mean_speed(one.column("energy")[1], name) / (GRAVITY * one.column("time")[1]), 0, "", scale=1)


def tanks_of(run):
    """All of them, but of a break only the tank that it breaks."""
    name = run.case_file.name
    return TANKS if name == "case.yaml" and not run.overrides else [name]


def worst(measure):
    """Of a measure of the run of one tank and its name."""
    return lambda run: max((measure(of(run, name), name) for name in tanks_of(run)), key=Pair.error)


def floor(run, name):
    """Force of the floor at the end, which carries the weight and the pressure at the top."""
    density, _, above = fluid(name)
    return Pair(run.column("floor")[-1], floor_force(density, above), "N", scale=floor_force(density))


def heights_and_pressures(run, frame):
    """[(height of the centroid, pressure)] of all elements where they stand. [m] [Pa]"""
    _, fields = run.frame("body", frame)
    at = [[x + u for x, u in zip(*both)] for both in zip(fields["points"], fields["displacement"])]
    nodes = fields["connectivity"]
    return [(height_of_centroid([at[node] for node in nodes[first:first + 8]]), p)
            for first, p in zip(range(0, len(nodes), 8), fields["pressure"])]


def off_hydrostatic(frame):
    """The largest difference of any element from the pressure at its centroid, over that of the whole depth."""
    def measure(run, name):
        density, _, above = fluid(name)
        off = max(abs(p - pressure(z, density, above)) for z, p in heights_and_pressures(run, frame))
        return Pair(off / pressure(0, density), 0, "", scale=1)
    return measure


def apart(run):
    """The largest displacement of a node of the falling water beside the mean of all, over the side of a cell."""
    _, fields = of(run, FALLING).frame("body")
    moved = fields["displacement"]
    mean = [sum(u) / len(moved) for u in zip(*moved)]
    return Pair(max(hypot(*(a - b for a, b in zip(u, mean))) for u in moved) / CELL, 0, "", scale=1)


def steps(run):
    """Of the tank that has the fewest, no more than are asked for: so the error is what is missing."""
    return Pair(min(LEAST, *(of(run, name).summary["cost"]["steps"] for name in TANKS)), LEAST, "steps")


REST = "the bound asked for: 1.5 um/s in water, 0.3 um/s in air. Round-off of positions over a step is 1e-14"
CHECKS = [
    Check("steps, the fewest of four tanks", steps, 1e-9, "a number of steps"),
    Check("in layers: rms velocity over the speed of sound", speed("case.yaml"), 1e-9, REST),
    Check("skewed: rms velocity over the speed of sound", speed(SKEWED), 1e-9, REST),
    Check("by Mie and Grueneisen: rms velocity over the speed of sound", speed(SHOCK), 1e-9, REST),
    Check("air below a lid: rms velocity over the speed of sound", speed(GAS), 1e-9, REST),
    Check("rms velocity after the first step over that of a free fall, worst of four tanks", worst(first_step), 1e-8,
          "round-off: forces of the pressure of air are 1e5 times its weight, and each is rounded by 1e-16"),
    Check("force of the floor, worst of four tanks, over the weight", worst(floor), 1e-5,
          "round-off: the floor carries 21,000 times the weight of the air, and its impulses are summed over 1e5 steps"),
    Check("pressure of any element at the start, worst of four tanks", worst(off_hydrostatic(0)), 1e-8,
          "round-off of the volumes: 1e-16 of the bulk modulus is 6e-11 of the pressure at the floor, of air 3e-12"),
    Check("pressure of any element at the end, worst of four tanks", worst(off_hydrostatic(-1)), 1e-6,
          "waves of round-off: density c times a thousandth of the limit of velocities is 6e-7 of the pressure at the floor"),
    Check("skewed cells in free fall: nodes apart after 12 mm, over a cell", apart, 1e-9,
          "nothing but gravity acts, so all nodes fall alike, up to round-off"),
]


def rows(run):
    found = []
    for name, words in TANKS.items():
        one = of(run, name)
        found.append([words, f"{one.summary['cost']['steps']}", f"{speed(name)(run).got:.1e}", f"{first_step(one, name).got:.1e}",
                      f"{floor(one, name).error():.1e}", f"{off_hydrostatic(-1)(one, name).got:.1e}"])
    return found


STUDIES = [Table("All tanks: steps, rms velocity over the speed of sound, rms velocity after the first step over that of a free fall, "
                 "error of the force of the floor over the weight, error of the pressure over that at the floor.",
                 ["tank", "steps", "velocity", "first step", "force", "pressure"], rows)]

SOON = {"time.end": "50 ms", "output.frames_every": "50 ms"}
EVEN = {**SOON, "bodies[0].start.hydrostatic": "false"}
TILTED = {**SOON, "gravity": "[0.001 m/s^2, 0 m/s^2, -9.81 m/s^2]"}
WAIVERS = [Waiver("unexplained energy over the largest that passed", lambda run: run.case_file.name != GAS,
                  "nothing moves: positions are rounded, and the energy that is stored in water at rest is small", 1e-8)]
BREAKS = [
    Breaks("steps, the fewest of four tanks", "a tenth of the time", {"time.end": "0.33 s"}),
    Breaks("in layers: rms velocity over the speed of sound", "an even pressure at the start", EVEN),
    Breaks("skewed: rms velocity over the speed of sound", "a surface that is not level: gravity tilted by 1e-4", TILTED,
           case=HERE + SKEWED),
    Breaks("by Mie and Grueneisen: rms velocity over the speed of sound", "an even pressure at the start", EVEN, case=HERE + SHOCK),
    Breaks("air below a lid: rms velocity over the speed of sound", "an even pressure at the start", EVEN, case=HERE + GAS),
    Breaks("rms velocity after the first step over that of a free fall, worst of four tanks", "a surface that is not level", TILTED,
           case=HERE + SKEWED),
    Breaks("force of the floor, worst of four tanks, over the weight", "the density of sea water",
           {**SOON, "bodies[0].material.density": "1025 kg/m^3"}),
    Breaks("pressure of any element at the start, worst of four tanks", "the density of sea water",
           {**SOON, "bodies[0].material.density": "1025 kg/m^3"}, case=HERE + SKEWED),
    Breaks("skewed cells in free fall: nodes apart after 12 mm, over a cell", "a start as if the tank stood",
           {"bodies[0].start.hydrostatic": "true"}, case=HERE + FALLING),
    Breaks("pressure of any element at the end, worst of four tanks", "a surface that is not level", TILTED, case=HERE + SKEWED),
]


def elements(run):
    found = []
    for name in ("case.yaml", SKEWED):
        places = sorted(heights_and_pressures(of(run, name), -1))
        found.append((TANKS[name], [z for z, _ in places], [p for _, p in places]))
    return found


def theory(run):
    return [("density g (H - z)", [0.0, HEIGHT], [pressure(0, WATER), pressure(HEIGHT, WATER)])]


FIGURES = [Figure("pressure", "height of the centroid [m]", "pressure [Pa]", elements, exact=theory,
                  caption="Pressure of the elements of both meshes after 100,000 steps, over the height of their centroids.")]
