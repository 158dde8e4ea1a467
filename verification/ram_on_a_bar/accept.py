"""How close is close enough, why, and what must break."""
from reference import mean_force, rate, speed
from verify import Breaks, Check, Falls, Figure, Pair, Table

CATALOGUE = ()
CLAIM = "A rigid ram that strikes an elastic bar slows down as v = V exp(-rho c A t/M) until 2L/c, and presses with rho c v."
EVIDENCE = "exact"
DRIVER = "scene"

DENSITY, YOUNG, AREA, SPEED = 7850.0, 210e9, 4e-4, 1.0  # [kg/m3] [Pa] [m2] [m/s]
MASS = DENSITY * 0.5 * AREA                             # [kg]
DECAY = rate(DENSITY, YOUNG, AREA, MASS)                # [1/s]
SETTLED = 2e-5                                          # [s] four cells
SWAPPED = {"contacts[0].apexes": "ram.x_high", "contacts[0].base": "bar.x_low"}
PENALTY = {"contacts[0].method": "penalty"}


def course(run):
    """The farthest from the exact speed after the first cells."""
    rows = [(t, v) for t, v in zip(run.column("time"), run.column("speed")) if t > SETTLED]
    t, v = max(rows, key=lambda row: abs(row[1] - speed(row[0], SPEED, DECAY)))
    return Pair(v - speed(t, SPEED, DECAY), 0, "m/s", scale=SPEED)


def press(run):
    """The mean force between two rows, the farthest from the exact one after the first cells, over rho c V A."""
    rows = list(zip(run.column("time"), run.column("force")))
    worst = max((abs(abs(f) - mean_force(s, t, SPEED, DECAY, MASS)) for (s, _), (t, f) in zip(rows, rows[1:]) if s > SETTLED))
    return Pair(worst, 0, "N", scale=MASS * DECAY * SPEED)


def spins(run):
    """It is struck in its middle and must not turn."""
    return Pair(max(abs(w) for w in run.column("spin")), 0, "rad/s", scale=SPEED / 0.02)


def created(run):
    return Pair(abs(run.created("touch")), 0, "J", scale=0.5 * MASS * SPEED**2)


def by(overrides, measure):
    return lambda run: measure(run.again({**overrides, **run.overrides}))


DEPARTURES = {"viscosity": "the exact bar has none", "method": "one check is of the penalty; all others are by default"}

CHECKS = [
    Check("speed of the ram as the base, the farthest", course, 0.005,
          "half a cell moves with the ram at once: 0.25 % of the bar's mass, a half per cent of the ram's"),
    Check("force on the ram as the base, the farthest", press, 0.01, "the catalogue's bound for plateaus; four cells after the front"),
    Check("the same with the apexes on the ram: speed", by(SWAPPED, course), 0.005, "as with the sides exchanged"),
    Check("the same with the apexes on the ram: force", by(SWAPPED, press), 0.01, "as with the sides exchanged"),
    Check("by a penalty: speed", by(PENALTY, course), 0.005, "as by default"),
    Check("spin of the ram", spins, 1e-9, "the blow is central"),
    Check("energy that the contact created", created, 1e-3, "the bound of the task; by multipliers it is round-off"),
]


def sides(run):
    rows = []
    for name, overrides in (("bar on ram", {}), ("ram on bar", SWAPPED), ("bar on ram, penalty", PENALTY)):
        one = run.again({**overrides, **run.overrides})
        rows.append([name, f"{course(one).error:.2e}", f"{press(one).error:.2e}", f"{created(one).error:.1e}"])
    return rows


BREAKS = [
    Breaks("speed of the ram as the base, the farthest", "a ram that is 5 % heavier", {"bodies[1].mass_properties": "{mass: 1.6485 kg}"}),
    Breaks("force on the ram as the base, the farthest", "a ram that is 5 % heavier",
           {"bodies[1].mass_properties": "{mass: 1.6485 kg}"}),
    Breaks("the same with the apexes on the ram: speed", "a bar 5 % denser", {"bodies[0].material.density": "8242.5 kg/m^3"}),
    Breaks("the same with the apexes on the ram: force", "a bar 5 % denser", {"bodies[0].material.density": "8242.5 kg/m^3"}),
    Breaks("by a penalty: speed", "a bar 5 % denser", {"bodies[0].material.density": "8242.5 kg/m^3"}),
    Breaks("spin of the ram", "a ram whose centre is aside", {"bodies[1].mass_properties": "{centre: [-250 mm, 10 mm, 11 mm]}"}),
    Breaks("energy that the contact created", "a penalty that samples coarsely",
           {"contacts[0].method": "penalty", "contacts[0].penalty": "1e15 Pa/m", "contacts[0].energy_gain_limit": 0.04}),
]


def speeds(run):
    return [("ram", run.column("time"), run.column("speed"))]


def exact(_):
    times = [3.8e-6 * i for i in range(101)]
    return [("exact", times, [speed(t, SPEED, DECAY) for t in times])]


STUDIES = [Falls("speed of the ram as the base, the farthest", "bodies[0].mesh.cells[0]", [50, 100, 200, 400], order=0.8),
           Table("Errors by sides and methods; created energy over that of the ram.",
                 ["contact", "speed", "force", "created"], sides)]
FIGURES = [Figure("speed", "time [s]", "speed of the ram [m/s]", speeds, exact=exact, caption="A rigid ram on an elastic bar.")]
