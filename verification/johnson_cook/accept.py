"""How close is close enough, why, and what must break."""
from functools import lru_cache

from reference import STEEL, sheared
from verify import Breaks, Check, Falls, Figure, Pair

CATALOGUE = ()
CLAIM = "Steel that is sheared at 1000/s hardens, is raised by its rate and softened by its own heat as Johnson and Cook's equation says."
EVIDENCE = "exact"
DRIVER = "material_point"

ANGLE, TIME = 1.0, 1e-3  # [-] [s]


@lru_cache
def exact():
    return sheared(STEEL, ANGLE, TIME)


def worst_stress(run):
    """The row that is farthest from the reference, beyond the knee, over the largest stress."""
    pairs = [(run.at("stress_xy", angle), tau) for angle, tau, _, _ in exact() if angle > 0.03]
    got, expected = max(pairs, key=lambda pair: abs(pair[0] - pair[1]))
    return Pair(got, expected, "Pa", scale=max(tau for _, tau in pairs))


def last(column, place, unit):
    return lambda run: Pair(run.column(column)[-1], exact()[-1][place], unit)


def rise(run):
    return Pair(run.column("temperature")[-1] - STEEL["cold"], exact()[-1][3] - STEEL["cold"], "K")


def heat(run):
    """What the metal is warmer by, against what it dissipated: bookkeeping, without the reference."""
    warm = (run.column("temperature")[-1] - STEEL["cold"]) * STEEL["density"] * STEEL["heat"]
    return Pair(warm, STEEL["share"] * run.column("work_dissipated")[-1], "J/m3")


FIRST = "first order in the increment, of 2.5e-4 of strain: half of it leaves half of"
CHECKS = [
    Check("shear stress, the worst row", worst_stress, 2e-6, f"{FIRST} 6e-7"),
    Check("plastic strain at the end", last("plastic_strain", 2, "1"), 2e-8, f"{FIRST} 6e-9"),
    Check("rise of the temperature", rise, 2e-5, f"{FIRST} 5e-6"),
    Check("heat over the share of what was dissipated", heat, 1e-10, "the same products, summed in another order", evidence="invariant"),
]

STUDIES = [Falls("rise of the temperature", along="path[0].increments", values=[125, 250, 500, 1000], order=0.8)]

BREAKS = [
    Breaks("shear stress, the worst row", "rates in 1/ms", {"material.reference_rate": "1000 1/s"}),
    Breaks("plastic strain at the end", "the modulus of aluminium", {"material.young": "70 GPa"}),
    Breaks("rise of the temperature", "all work becomes heat", {"material.taylor_quinney": 1}),
    Breaks("heat over the share of what was dissipated", "all work becomes heat", {"material.taylor_quinney": 1}),
]


def stress(run):
    return [("Nereid", run.column("time")[::20], [s * 1e-6 for s in run.column("stress_xy")[::20]])]


def exact_stress(_run):
    table = exact()
    return [("Runge and Kutta", [row[0] for row in table], [row[1] * 1e-6 for row in table])]


def temperature(run):
    return [("Nereid", run.column("time")[::20], run.column("temperature")[::20])]


def exact_temperature(_run):
    table = exact()
    return [("Runge and Kutta", [row[0] for row in table], [row[3] for row in table])]


FIGURES = [
    Figure("stress", "angle of shear [-]", "shear stress [MPa]", stress, exact_stress,
           caption="Shear stress: it hardens first, and softens when its heat outweighs that."),
    Figure("temperature", "angle of shear [-]", "temperature [K]", temperature, exact_temperature, caption="Temperature."),
]
