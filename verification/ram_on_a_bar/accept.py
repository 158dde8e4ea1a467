"""How close is close enough, why, and what must break."""
from reference import mean_force, pressed_speed, rate, speed
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table, created, share

CATALOGUE = ()
CLAIM = ("A rigid ram that strikes an elastic bar slows down as v = V exp(-rho c A t/M) until 2L/c and presses with rho c v; rigid "
         "planes that are pressed or driven move it as exactly.")
EVIDENCE = "exact"
DRIVER = "scene"

DENSITY, YOUNG, AREA, SPEED = 7850.0, 210e9, 4e-4, 1.0  # [kg/m3] [Pa] [m2] [m/s]
MASS = DENSITY * 0.5 * AREA                             # [kg]
DECAY = rate(DENSITY, YOUNG, AREA, MASS)                # [1/s]
SETTLED = 2e-5                                          # [s] twenty cells
WINDOW, SHORT = 2e-5, 4e-6                              # [s] twenty cells, and four, of means of the force
SWAPPED = {"contacts[0].apexes": "ram.x_high", "contacts[0].base": "bar.x_low"}
PENALTY = {"contacts[0].method": "penalty"}
PRESSED, DRIVEN = "verification/ram_on_a_bar/platen.yaml", "verification/ram_on_a_bar/driven.yaml"
LOAD = 16241.0                                          # [N]
DISSIPATES = {"contacts[0].restitution": 0}
BARE = {f"bodies[0].element.viscosity.{term}": 0 for term in ("linear", "quadratic")}


def course(run):
    """The farthest from the exact speed after the first cells."""
    rows = [(t, v) for t, v in zip(run.column("time"), run.column("speed")) if t > SETTLED]
    t, v = max(rows, key=lambda row: abs(row[1] - speed(row[0], SPEED, DECAY)))
    return Pair(v - speed(t, SPEED, DECAY), 0, "m/s", scale=SPEED)


def press(run, window=WINDOW):
    """The mean force over a window from any row on, the farthest from the exact one after the first cells, over rho c V A."""
    times, forces = run.column("time"), run.column("force")
    given = [0.0]  # the momentum so far: a row has the mean since the row before
    for start, end, force in zip(times, times[1:], forces[1:]):
        given.append(given[-1] + abs(force) * (end - start))
    worst, last = 0.0, 0
    for first, start in enumerate(times):
        while last < len(times) and times[last] - start < window:
            last += 1
        if last == len(times):
            break
        if start > SETTLED:
            mean = (given[last] - given[first]) / (times[last] - start)
            worst = max(worst, abs(mean - mean_force(start, times[last], SPEED, DECAY, MASS)))
    return Pair(worst, 0, "N", scale=MASS * DECAY * SPEED)


def press_shortly(run):
    return press(run, SHORT)


def spins(run):
    """It is struck in its middle and must not turn."""
    return Pair(max(abs(w) for w in run.column("spin")), 0, "rad/s", scale=SPEED / 0.02)


def by(overrides, measure):
    return lambda run: measure(run.again({**overrides, **run.overrides}))


def moved_by(case, run):
    return run if str(run.case_file).endswith(case) else run.other("scene", case, {})


def pressed(run):
    """The farthest from the exact speed of a platen with a mass and a load, from the start."""
    one = moved_by(PRESSED, run)
    t, v = max(zip(one.column("time"), one.column("speed")), key=lambda row: abs(row[1] - pressed_speed(row[0], LOAD, DECAY, MASS)))
    return Pair(v, pressed_speed(t, LOAD, DECAY, MASS), "m/s", scale=LOAD / (DECAY * MASS))


def driven(run):
    """The mean force on a platen that moves as prescribed."""
    one = moved_by(DRIVEN, run)
    return Pair(one.mean("force", SETTLED, one.column("time")[-1]), MASS * DECAY * SPEED, "N")


DEPARTURES = {"viscosity": "two checks are of the dispersion of the bar alone; all others are by default",
              "method": "one check is of the penalty; all others are by default",
              "restitution": "one check dissipates the energy of first touch; all others are by default"}

CHECKS = [
    Check("speed of the ram as the base, the farthest", course, 0.005,
          "half a cell moves with the ram at once: 0.25 % of the bar's mass, a half per cent of the ram's"),
    Check("force on the ram as the base over 20 us, the farthest", press, 0.024,
          "the momentum of half a cell over that of the window: where the force has fallen to a half, the end of the bar gives back at "
          "once what its first touch took"),
    Check("the same with the apexes on the ram: speed", by(SWAPPED, course), 0.005, "as with the sides exchanged"),
    Check("the same with the apexes on the ram: force", by(SWAPPED, press), 0.024, "as with the sides exchanged"),
    Check("a first touch that dissipates: speed", by({**DISSIPATES, **BARE}, course), 5e-4,
          "nothing is given back; what is left is the dispersion of the bar, of second order"),
    Check("a first touch that dissipates: force over 4 us", by({**DISSIPATES, **BARE}, press_shortly), 1e-3, "as the speed"),
    Report("a first touch that dissipates, with the default viscosity: speed", by(DISSIPATES, course),
           "the force of the first cells after the front is a little less: the viscosity takes the ringing of the front"),
    Report("a first touch that dissipates, with the default viscosity: force over 4 us", by(DISSIPATES, press_shortly), "as the speed"),
    Check("by a penalty: speed", by(PENALTY, course), 0.01,
          "the end of the bar, half a cell, rings on its spring, for nothing damps it: first order in the cell, and the ram has a hundred"),
    Check("a rigid plane with a mass and a load: speed, the farthest", pressed, 1e-3,
          "half a cell moves with it, half a per cent of its mass, but slowly at first: a fifth of the ram's limit"),
    Check("a rigid plane that moves as prescribed: force", driven, 1e-3, "a plateau, long after its front"),
    Check("spin of the ram", spins, 1e-9, "the blow is central"),
    Check("energy that the contact created, over that of the ram", created, 1e-4, "by multipliers it is round-off"),
]


def sides(run):
    rows = []
    for name, overrides in (("bar on ram", {}), ("ram on bar", SWAPPED), ("bar on ram, a touch that dissipates", DISSIPATES),
                            ("the same without viscosity", {**DISSIPATES, **BARE}),
                            ("bar on ram, penalty", PENALTY), ("ram on bar, penalty", {**PENALTY, **SWAPPED})):
        one = run.again({**overrides, **run.overrides})
        rows.append([name, *(share(measure(one).error()) for measure in (course, press, press_shortly)), share(one.created())])
    return rows


HEAVIER = {"bodies[1].mass_properties.mass": "1.6485 kg"}
DENSER, MUCH_DENSER = {"bodies[0].material.density": "8242.5 kg/m^3"}, {"bodies[0].material.density": "9420 kg/m^3"}
BREAKS = [
    Breaks("speed of the ram as the base, the farthest", "a ram that is 5 % heavier", HEAVIER),
    Breaks("force on the ram as the base over 20 us, the farthest", "a ram that is 5 % heavier", HEAVIER),
    Breaks("the same with the apexes on the ram: speed", "a bar 5 % denser", DENSER),
    Breaks("the same with the apexes on the ram: force", "a bar that is a fifth denser", MUCH_DENSER),
    Breaks("a first touch that dissipates: speed", "a bar of 50 cells", {"bodies[0].mesh.cells": "[50, 1, 1]"}),
    Breaks("a first touch that dissipates: force over 4 us", "a bar 5 % denser", DENSER),
    Breaks("by a penalty: speed", "a penalty of a twentieth of the bar's stiffness", {"contacts[0].penalty_scale": 0.05}),
    Breaks("a rigid plane with a mass and a load: speed, the farthest", "a load that is divided among the platen's nodes on the bar's side",
           {"loads[0].value": "['8120', '0', '0']"}, PRESSED),
    Breaks("a rigid plane that moves as prescribed: force", "a platen whose velocity grows by a tenth in 0.1 ms",
           {"planes[1].velocity.value": "['1 + 1e3*t', '0', '0']"}, DRIVEN),
    Breaks("spin of the ram", "a ram whose centre is aside", {"bodies[1].mass_properties.centre": "[-250 mm, 10 mm, 11 mm]"}),
    Breaks("energy that the contact created, over that of the ram", "a penalty that samples coarsely",
           {**PENALTY, "contacts[0].step_factor": 0.5}),
]


def speeds(run):
    return [("ram", run.column("time"), run.column("speed"))]


def exact(_):
    times = [3.8e-6 * i for i in range(101)]
    return [("exact", times, [speed(t, SPEED, DECAY) for t in times])]


CELLS = ["[50, 1, 1]", "[100, 1, 1]", "[200, 1, 1]", "[400, 1, 1]"]
STUDIES = [
    Falls("speed of the ram as the base, the farthest", along="bodies[0].mesh.cells", values=CELLS, order=0.8),
    Falls("force on the ram as the base over 20 us, the farthest", along="bodies[0].mesh.cells", values=CELLS[1:], order=0.8),
    Falls("by a penalty: speed", along="bodies[0].mesh.cells", values=CELLS, order=0.8),
    Table("Errors by sides and methods, and created energy over that of the ram:",
          ["contact", "speed", "force over 20 us", "force over 4 us", "created"], sides),
]
FIGURES = [Figure("speed", "time [s]", "speed of the ram [m/s]", speeds, exact=exact, caption="A rigid ram on an elastic bar.")]
