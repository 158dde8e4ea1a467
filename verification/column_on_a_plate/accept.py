"""How close is close enough, why, and what must break."""
from reference import held_impedance, pressure, speed
from verify import Breaks, Check, Falls, Figure, Pair, Table, share

CATALOGUE = ("F-3", "F-4")
CLAIM = ("A column of water that strikes a free rigid plate takes it along as $V (1 - e^{-\\rho c t/m})$, and presses on a long bar of "
         "steel with $\\rho c V Z/(\\rho c + Z)$.")
EVIDENCE = "exact"
DRIVER = "scene"

STEEL = "verification/column_on_a_plate/steel.yaml"
COMING, WATER, MASS, AREA = 10.0, 1.48e6, 200.0, 4e-4  # [m/s] [kg/(m2 s)] [kg/m2] [m2]
SETTLED = 0.1 / 1480                                   # [s] ten cells
PLATEAU = (0.1e-3, 0.6e-3)                             # [s] on steel
NO_POISSON = {"bodies[1].material.poisson": 0}


def of(run, change=None):
    """The run on steel; a break may be one itself."""
    if str(run.case_file).endswith(STEEL):
        return run.again(change) if change else run
    return run.other("scene", STEEL, change or {})


def at(t):
    """The speed of the plate at a time."""
    return lambda run: Pair(-run.at("speed", t), speed(t, COMING, WATER, MASS), "m/s")


def course(run):
    """The farthest from the exact speed after the first cells."""
    rows = [(t, -v) for t, v in zip(run.column("time"), run.column("speed")) if t > SETTLED]
    t, v = max(rows, key=lambda row: abs(row[1] - speed(row[0], COMING, WATER, MASS)))
    return Pair(v, speed(t, COMING, WATER, MASS), "m/s", scale=COMING)


def turns(run):
    return Pair(max(run.column("spin")), 0, "rad/s", scale=COMING / 0.02)


def presses(run, change=None, poisson=0.3):
    """By the momentum that the steel got."""
    one = of(run, change)
    got = (one.at("momentum", PLATEAU[0]) - one.at("momentum", PLATEAU[1])) / (PLATEAU[1] - PLATEAU[0]) / AREA
    return Pair(got, pressure(COMING, WATER, held_impedance(7850, 210e9, poisson)), "Pa")


def gives_way(run):
    """The velocity of the end of the steel."""
    other = held_impedance(7850, 210e9, 0.3)
    return Pair(-of(run).mean("speed", *PLATEAU), pressure(COMING, WATER, other) / other, "m/s")


CHECKS = [
    Check("speed of the plate at 0.2 ms", at(0.2e-3), 0.01, "the catalogue's bound"),
    Check("speed of the plate at 0.5 ms", at(0.5e-3), 0.01, "the catalogue's bound"),
    Check("speed of the plate, the farthest after ten cells, over that of the water", course, 0.025,
          "half a cell of water moves with the plate at once and has 2.5 % of its mass; the contact gives the energy of that touch back "
          "when the force has fallen to a half"),
    Check("spin of the plate, times its width over the speed of the water", turns, 1e-9,
          "the blow is central; iterations of the contact leave round-off"),
    Check("steel with held sides: pressure", presses, 0.002, "a plateau, as on a rigid wall; a bar with free sides differs by 0.5 %"),
    Check("steel with held sides: velocity of its end", gives_way, 0.005, "the pressure over the impedance of the steel; cells of steel "
          "are twice as large, so their front rings twice as long"),
    Check("steel without Poisson's ratio: pressure", lambda run: presses(run, NO_POISSON, 0), 0.002, "as with held sides"),
]


def cells(run):
    rows = []
    for name, water, steel in (("2 x 2 on 1 x 1", 2, 1), ("1 x 1 on 2 x 2", 1, 2), ("2 x 2 on 2 x 2", 2, 2), ("3 x 3 on 2 x 2", 3, 2)):
        one = of(run, {"bodies[0].mesh.cells": f"[{water}, {water}, {50 * water}]",
                       "bodies[1].mesh.cells": f"[{steel}, {steel}, {100 * steel}]"})
        rows.append([name, share(presses(one).error()), share(gives_way(one).error())])
    return rows


STUDIES = [
    Falls("speed of the plate, the farthest after ten cells, over that of the water", along="bodies[0].mesh.cells",
          values=["[1, 1, 50]", "[2, 2, 100]", "[4, 4, 200]"], sizes=[50, 100, 200], order=0.8),
    Table("Errors on steel by the cells of the two ends, water first.", ["cells", "pressure", "velocity"], cells, full=True),
]

HEAVY = {"bodies[1].material.density": "10000 kg/m^3"}
BREAKS = [
    Breaks("speed of the plate at 0.2 ms", "a plate a quarter too heavy", HEAVY),
    Breaks("speed of the plate at 0.5 ms", "a plate a quarter too heavy", HEAVY),
    Breaks("speed of the plate, the farthest after ten cells, over that of the water", "a plate a quarter too heavy", HEAVY),
    Breaks("spin of the plate, times its width over the speed of the water", "a plate whose centre of mass is aside",
           {"bodies[1].mass_properties.centre": "[10 mm, 11 mm, -12.5 mm]"}),
    Breaks("steel with held sides: pressure", "the impedance of a bar with free sides", NO_POISSON, case=STEEL),
    Breaks("steel with held sides: velocity of its end", "the impedance of a bar with free sides", NO_POISSON, case=STEEL),
    Breaks("steel without Poisson's ratio: pressure", "steel as light as titanium",
           {"bodies[1].material.density": "4500 kg/m^3"}, case=STEEL),
]


def speeds(run):
    return [("plate", [1e3 * t for t in run.column("time")], [-v for v in run.column("speed")])]


def exact_speeds(run):
    times = [i / 300 * run.column("time")[-1] for i in range(301)]
    return [("$V (1 - e^{-\\rho c t/m})$", [1e3 * t for t in times], [speed(t, COMING, WATER, MASS) for t in times])]


def on_steel(run):
    """The mean between rows that are 12 us apart."""
    one = of(run)
    times = [12e-6 * i for i in range(55) if 12e-6 * i <= one.column("time")[-1]]
    given = [0.0, *(-one.at("momentum", t) for t in times[1:])]  # what first touch gave belongs to the first of them
    return [("on steel", [1e3 * (a + b) / 2 for a, b in zip(times, times[1:])],
             [(b - a) / 12e-6 / AREA / 1e6 for a, b in zip(given, given[1:])])]


def exact_on_steel(_):
    return [("$\\rho c V Z/(\\rho c + Z)$", [0, 0.65], [pressure(COMING, WATER, held_impedance(7850, 210e9, 0.3)) / 1e6] * 2)]


FIGURES = [
    Figure("plate", "time [ms]", "speed of the plate [m/s]", speeds, exact_speeds,
           caption="A free rigid plate of 200 kg/m² that a column of water strikes with 10 m/s."),
    Figure("steel", "time [ms]", "pressure on the steel [MPa]", on_steel, exact_on_steel,
           caption="Pressure of a column of water on a long bar of steel that it strikes with 10 m/s."),
]
