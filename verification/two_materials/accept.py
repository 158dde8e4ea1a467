"""How close is close enough, why, and what must break."""
from reference import ALUMINIUM, STEEL, energy, in_a_row, mass_with_core_and_ball, reflected, speed, stretched, transmitted, waves
from verify import Breaks, Check, Figure, Pair

CLAIM = "In a bar of two materials waves are transmitted and reflected as their impedances say, and each part has its own modulus and mass."
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "scene"

HERE = "verification/two_materials/"
STATIC, PLATES, REGION, SETS = (HERE + name for name in ("static.yaml", "plates.yaml", "region.yaml", "sets.yaml"))
PRESSURE, PULSE, AREA, HALF = 100e6, 60e-6, 0.01, 0.5
NEAR, FAR = 0.2, 0.8
PULL, FIELD = 100e6, 1e4
FAR_PART = "bodies[0].sets[0].half_space.point"
FIRST, SECOND = "bodies[0].material", "bodies[0].materials[0].material"
EXCHANGED = {FIRST + ".density": "2700 kg/m^3", FIRST + ".young": "70 GPa",
             SECOND + ".density": "7850 kg/m^3", SECOND + ".young": "210 GPa"}
OTHER_REGION = {"bodies[0].materials[0].of": "near"}
ONE_MATERIAL = {SECOND + ".density": "7850 kg/m^3", SECOND + ".young": "210 GPa"}


def of(case):
    """The run of another case of this folder; in a break of that case the run itself."""
    return lambda run: run if str(run.case_file).endswith(case.rsplit("/", maxsplit=1)[-1]) else run.other("scene", case)


def plateau(column, arrival, exact, unit="Pa", change=None):
    """The mean over the middle two thirds of a pulse that arrives at a time."""
    def measure(run):
        there = run.again(change) if change else run
        return Pair(there.mean(column, arrival + PULSE / 6, arrival + 5 * PULSE / 6), exact, unit)
    return measure


def arrivals(first, second):
    """Times at which the pulse comes in at NEAR, returns to it, is at the joint and at FAR."""
    joint = HALF / speed(first)
    return NEAR / speed(first), joint + (HALF - NEAR) / speed(first), joint, joint + (FAR - HALF) / speed(second)


def last(name, exact, unit, case):
    return lambda run: Pair(of(case)(run).column(name)[-1], exact, unit)


def of_plates(name, exact):
    """Exact with the elongation that the driven end has got in whole steps."""
    def measure(run):
        there = of(PLATES)(run)
        strain = in_a_row(STEEL, ALUMINIUM, HALF, there.column("end")[-1])
        return Pair(there.column(name)[-1], exact(strain), "1" if "strain" in name else "Pa")
    return measure


def energies_of_plates(run):
    there = of(PLATES)(run)
    ratio = there.column("energy_bar.far_elastic")[-1] / there.column("energy_bar_elastic")[-1]
    strain = in_a_row(STEEL, ALUMINIUM, HALF, there.column("end")[-1])
    return Pair(ratio, energy(ALUMINIUM, strain * STEEL["young"] / ALUMINIUM["young"]) / energy(STEEL, strain))


def mass_of_sets(run):
    """Momentum over the velocity of 1 m/s."""
    return Pair(of(SETS)(run).column("momentum")[-1], mass_with_core_and_ball(), "kg")


IN, BACK, JOINT, ON = arrivals(STEEL, ALUMINIUM)
T, R = transmitted(STEEL, ALUMINIUM), reflected(STEEL, ALUMINIUM)
IN_2, BACK_2, JOINT_2, ON_2 = arrivals(ALUMINIUM, STEEL)
T_2, R_2 = transmitted(ALUMINIUM, STEEL), reflected(ALUMINIUM, STEEL)

OF_STEEL, OF_ALUMINIUM = STEEL["density"] * FIELD, ALUMINIUM["density"] * FIELD  # growth of the stress [Pa/m]
AT_JOINT = PULL + HALF * OF_ALUMINIUM
LENGTH_1 = stretched(AT_JOINT, OF_STEEL, STEEL["young"], HALF)
LENGTH_2 = stretched(PULL, OF_ALUMINIUM, ALUMINIUM["young"], HALF)
REACTION = PULL * AREA + HALF * AREA * (OF_STEEL + OF_ALUMINIUM)

FRONTS = "fronts overshoot by 0.15 % in a bar of one material (smooth_and_shock), and the pulse begins and ends within a step of 1 us of 60"
REST = "linear in each half; at rest to 1e-6 of all forces, and elements of 50 mm have the stress of their middle: 1e-8"
EVEN = "one strain in each half; at rest to 1e-6 of all forces"
CHECKS = [
    Check("incident stress", plateau("near_stress", IN, -PRESSURE), 2e-3, FRONTS),
    Check("transmitted stress", plateau("far_stress", ON, -T * PRESSURE), 2e-3, FRONTS),
    Check("reflected stress", plateau("near_stress", BACK, -R * PRESSURE), 2e-3, FRONTS),
    Check("force at the joint", plateau("joint_force", JOINT, T * PRESSURE * AREA, "N"), 2e-3, FRONTS),
    Check("into the stiffer part: transmitted stress", plateau("far_stress", ON_2, -T_2 * PRESSURE, change=EXCHANGED), 2e-3, FRONTS),
    Check("into the stiffer part: reflected stress", plateau("near_stress", BACK_2, -R_2 * PRESSURE, change=EXCHANGED), 2e-3,
          FRONTS),
    Check("into the stiffer part: force at the joint", plateau("joint_force", JOINT_2, T_2 * PRESSURE * AREA, "N", EXCHANGED), 2e-3,
          FRONTS),
    Check("at rest: elongation of the near half", last("joint", LENGTH_1 - HALF, "m", STATIC), 3e-6, REST),
    Check("at rest: elongation of both", last("end", LENGTH_1 + LENGTH_2 - 2 * HALF, "m", STATIC), 3e-6, REST),
    Check("at rest: reaction to the pull and to both masses", last("reaction", -REACTION, "N", STATIC), 3e-6, REST),
    Check("at rest: mean stress of the far half", last("far_stress", PULL + HALF * OF_ALUMINIUM / 2, "Pa", STATIC), 3e-6, REST),
    Check("plates at rest: stress of the near half", of_plates("near_stress", lambda e: STEEL["young"] * e), 3e-6, EVEN),
    Check("plates at rest: stress of the far half", of_plates("far_stress", lambda e: STEEL["young"] * e), 3e-6, EVEN),
    Check("plates at rest: strain of the near half", of_plates("near_strain", lambda e: e), 3e-6, EVEN),
    Check("plates at rest: energy of the far half over that of the near one", energies_of_plates, 1e-5,
          "the rest moves by 1e-6 of the energies, and the work of each step is a trapezoid"),
    Check("a region of a file: elongation of the near half", last("joint", LENGTH_1 - HALF, "m", REGION), 3e-6, REST),
    Check("a region of a file: elongation of both", last("end", LENGTH_1 + LENGTH_2 - 2 * HALF, "m", REGION), 3e-6, REST),
    Check("a region of a file: reaction to the pull and to both masses", last("reaction", -REACTION, "N", REGION), 3e-6, REST),
    Check("a region of a file: mean stress of the far half", last("far_stress", PULL + HALF * OF_ALUMINIUM / 2, "Pa", REGION), 3e-6, REST),
    Check("a core and a ball of aluminium: mass", mass_of_sets, 1e-12, "a sum of masses of elements"),
]

BREAKS = [
    Breaks("incident stress", "a pressure off by a hundredth", {"loads[0].value": '"t < 60e-6 ? 101 : 0"'}),
    Breaks("transmitted stress", "one material", ONE_MATERIAL),
    Breaks("reflected stress", "one material", ONE_MATERIAL),
    Breaks("force at the joint", "materials exchanged", EXCHANGED),
    Breaks("into the stiffer part: transmitted stress", "the normal of the half space the other way",
           {"bodies[0].sets[0].half_space.normal": "[-1, 0, 0]", "probes[1].of": "bar"}),
    Breaks("into the stiffer part: reflected stress", "the joint elsewhere", {FAR_PART: "[0.75 m, 0 m, 0 m]"}),
    Breaks("into the stiffer part: force at the joint", "the joint elsewhere", {FAR_PART: "[0.75 m, 0 m, 0 m]"}),
    Breaks("at rest: elongation of the near half", "materials exchanged", EXCHANGED, case=STATIC),
    Breaks("at rest: elongation of both", "one material", ONE_MATERIAL, case=STATIC),
    Breaks("at rest: reaction to the pull and to both masses", "the density of the other part", {SECOND + ".density": "7850 kg/m^3"},
           case=STATIC),
    Breaks("at rest: mean stress of the far half", "the set without its last cells",
           {"bodies[0].sets[2].box.high": "[0.55 m, 0.1 m, 0.1 m]"}, case=STATIC),
    Breaks("plates at rest: stress of the near half", "one material", ONE_MATERIAL, case=PLATES),
    Breaks("plates at rest: stress of the far half", "the joint elsewhere",
           {FAR_PART: "[0.55 m, 0 m, 0 m]"}, case=PLATES),
    Breaks("plates at rest: strain of the near half", "materials exchanged", EXCHANGED, case=PLATES),
    Breaks("plates at rest: energy of the far half over that of the near one", "one material", ONE_MATERIAL, case=PLATES),
    Breaks("a region of a file: elongation of the near half", "the other region", OTHER_REGION, case=REGION),
    Breaks("a region of a file: elongation of both", "one material", ONE_MATERIAL, case=REGION),
    Breaks("a region of a file: reaction to the pull and to both masses", "the density of the other part",
           {SECOND + ".density": "7850 kg/m^3"}, case=REGION),
    Breaks("a region of a file: mean stress of the far half", "the other region", OTHER_REGION, case=REGION),
    Breaks("a core and a ball of aluminium: mass", "the radius of the core off by 3 mm",
           {"bodies[0].sets[0].cylinder.radius": "17 mm"}, case=SETS),
    Breaks("a core and a ball of aluminium: mass", "the end of the core off by an element",
           {"bodies[0].sets[0].cylinder.to": "[0.85 m, 0.05 m, 0.05 m]"}, case=SETS),
    Breaks("a core and a ball of aluminium: mass", "the radius of the ball off by 11 mm",
           {"bodies[0].sets[1].sphere.radius": "39 mm"}, case=SETS),
    Breaks("a core and a ball of aluminium: mass", "the ball left out", {"bodies[0].sets[2].any_of": "[core]"}, case=SETS),
]


def stresses(run):
    times = [1e6 * t for t in run.column("time")]
    return [(where, times, [s / 1e6 for s in run.column(name)])
            for where, name in (("in steel", "near_stress"), ("in aluminium", "far_stress"))]


def exact_stresses(run):
    times = [1e-7 * i for i in range(2301)]
    return [(f"d'Alembert, {where}", [1e6 * t for t in times],
             [-waves(STEEL, ALUMINIUM, HALF, PULSE, x, t) * PRESSURE / 1e6 for t in times])
            for where, x in (("in steel", NEAR), ("in aluminium", FAR))]


FIGURES = [Figure("stress", "time [µs]", "axial stress [MPa]", stresses, exact_stresses,
                  caption="A pulse of 100 MPa in steel meets aluminium: stresses 0.3 m from the joint, on both sides.")]
