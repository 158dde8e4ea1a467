"""How close is close enough, why, and what must break."""
from functools import lru_cache

from reference import STEEL, impact
from verify import Breaks, Check, Figure, Pair, crossings

CATALOGUE = ()
CLAIM = "A plate of Johnson and Cook's metal that strikes a wall has the fronts, the plastic strain and the heat of one-dimensional waves."
EVIDENCE = "benchmark"
DRIVER = "scene"

THICKNESS, SPEED, END = 0.01, 200.0, 2.6e-6  # [m] [m/s] [s]
IN_PLATE = 1.6e-6   # [s] before the elastic front reaches the back
BETWEEN = (1.78e-6, 1.88e-6)  # [s] the elastic front has left the back; the foot of the plastic one, as wide as the cells, has not come


@lru_cache
def exact():
    return impact(STEEL, THICKNESS, SPEED, END)


def expected(place, t):
    table = exact()
    after = next(i for i, row in enumerate(table) if row[0] >= t)
    (t0, a), (t1, b) = ((table[i][0], table[i][place]) for i in (after - 1, after))
    return a + (b - a) * (t - t0) / (t1 - t0)


def mean_of_reference(place, t0, t1):
    rows = [row[place] for row in exact() if t0 <= row[0] <= t1]
    return sum(rows) / len(rows)


def precursor(run):
    """By how much the elastic front slows the back."""
    return Pair(run.mean("back", *BETWEEN) + SPEED, mean_of_reference(1, *BETWEEN) + SPEED, "m/s")


def arrival(level):
    def measure(run):
        table = exact()
        got = crossings(run.column("time"), run.column("back"), level)[0]
        return Pair(got, crossings([row[0] for row in table], [row[1] for row in table], level)[0], "s")
    return measure


def strain(run):
    return Pair(run.at("plastic_strain", IN_PLATE), expected(2, IN_PLATE), "1")


def rise(run):
    return Pair(run.at("temperature", IN_PLATE) - STEEL["cold"], expected(3, IN_PLATE) - STEEL["cold"], "K")


def last_speed(run):
    return Pair(run.column("back")[-1], exact()[-1][1], "m/s", scale=SPEED)


CHECKS = [
    Check("velocity the elastic front gives the back", precursor, 0.02, "the plateau rings by a percent on either grid"),
    Check("arrival of the elastic front", arrival(-SPEED + 25), 0.01, "a front is two cells wide, of a hundred"),
    Check("arrival of the plastic front", arrival(20.0), 0.01, "as that of the elastic front"),
    Check("mean plastic strain", strain, 0.02, "the first cells at the wall flow too far in any scheme: start-up heating"),
    Check("mean rise of the temperature", rise, 0.03, "as the plastic strain, and viscosity leaves its heat out of the metal"),
]
STUDIES = []

BREAKS = [
    Breaks("velocity the elastic front gives the back", "no effect of the rate", {"bodies[0].material.rate_coefficient": 0}),
    Breaks("arrival of the elastic front", "Poisson's ratio of lead", {"bodies[0].material.poisson": 0.42}),
    Breaks("arrival of the plastic front", "the density of titanium", {"bodies[0].material.density": "4430 kg/m^3"}),
    Breaks("mean plastic strain", "no effect of the rate", {"bodies[0].material.rate_coefficient": 0}),
    Breaks("mean rise of the temperature", "all work becomes heat", {"bodies[0].material.taylor_quinney": 1}),
]


def back(run):
    return [("Nereid", [1e6 * t for t in run.column("time")], run.column("back"))]


def exact_back(_run):
    table = exact()
    return [("finite differences", [1e6 * row[0] for row in table], [row[1] for row in table])]


FIGURES = [Figure("back", "time [us]", "velocity of the back [m/s]", back, exact_back,
                  caption="The back of the plate: an elastic front slows it, the plastic one turns it round.")]
