"""How close is close enough, why, and what must break."""
from defaults import NUMERICS
from reference import reference
from verify import Breaks, Check, Falls, Figure, Pair, Report, Waiver, created

CATALOGUE = ("I-3",)
CLAIM = "The interface carries the stress rho c v/2 for the time 2L/c; then the bars separate with their velocities exchanged."
EVIDENCE = "exact"
DRIVER = "two_blocks"
CASE = "cases/two_blocks/bars.yaml"
PENALTY = {"contact.method": "penalty"}
USUAL = {f"element.viscosity.{term}": value for term, value in NUMERICS["viscosity"].items()}


def exact(run):
    return reference(run.case("material.density"), run.case("material.young"), run.case("blocks.length"),
                     run.case("blocks.width"), run.case("blocks.gap"), run.case("closing_speed"))


def plateau_stress(run):
    return Pair(run.mean("interface_stress", *exact(run)["plateau"]), exact(run)["interface_stress"], "Pa")


def contact_time(run):
    return Pair(run.result("contact_time"), exact(run)["contact_time"], "s")


def velocity_of(bar):
    return lambda run: Pair(run.result(f"velocity_{bar}"), exact(run)[f"velocity_{bar}"], "m/s")


def usual(measure):
    """With the default viscosity."""
    return lambda run: measure(run.again({**USUAL, **run.overrides}))


DEPARTURES = {"viscosity": "the exact bars keep their energy; the default viscosity takes some of it (reports)"}

CHECKS = [
    Check("plateau stress", plateau_stress, 0.01, "ringing averages out over the middle 80 % of the contact"),
    Check("contact time", contact_time, 0.01, "the catalogue's bound; contact lasts some steps longer, and these fall with the mesh"),
    Check("velocity of A", velocity_of("A"), 0.01, "some energy stays behind as ringing; it falls with the mesh"),
    Check("velocity of B", velocity_of("B"), 0.01, "as A, by symmetry"),
    Check("plateau stress with the default viscosity", usual(plateau_stress), 0.01, "as without; fronts are some elements wide"),
    Check("contact time with the default viscosity", usual(contact_time), 0.01, "as without"),
    Report("velocity of A with the default viscosity", usual(velocity_of("A")),
           "the viscosity takes the ringing behind both fronts, whatever the contact is; it falls with the mesh"),
    Check("created energy", created, 1e-9, "multipliers create nothing between bars that meet evenly: round-off"),
]

STUDIES = [
    Falls("contact time", along="blocks.cells_along", values=[50, 100, 200]),
    Falls("velocity of A", along="blocks.cells_along", values=[50, 100, 200]),
]

WAIVERS = [
    Waiver("created energy of any source at any time", lambda run: float(run.overrides.get("contact.energy_gain_limit", 0)) > 0.005,
           "a bounce is allowed eight times the default energy, and the break is that it then creates it", up_to=0.02),
]

BREAKS = [
    Breaks("plateau stress", "a penalty a hundred times too soft", {**PENALTY, "contact.penalty": "5e11 Pa/m"}),
    Breaks("contact time", "a penalty a hundred times too soft", {**PENALTY, "contact.penalty": "5e11 Pa/m"}),
    Breaks("plateau stress with the default viscosity", "a penalty a hundred times too soft", {**PENALTY, "contact.penalty": "5e11 Pa/m"}),
    Breaks("contact time with the default viscosity", "a penalty a hundred times too soft", {**PENALTY, "contact.penalty": "5e11 Pa/m"}),
    Breaks("velocity of A", "viscosity that swallows the wave", {"element.viscosity.linear": 1}),
    Breaks("velocity of B", "viscosity that swallows the wave", {"element.viscosity.linear": 1}),
    Breaks("created energy", "two cells, a stiff interface, and a step beyond the bound of a bounce",
           {**PENALTY, "contact.energy_gain_limit": 0.04, "blocks.cells_along": 2, "contact.penalty_scale": 50}),
]


def stress_over_time(run):
    return [("Nereid", [1e6 * t for t in run.column("time")], [1e-6 * s for s in run.column("interface_stress")])]


def exact_stress(run):
    start, plateau = run.case("blocks.gap") / run.case("closing_speed"), 1e-6 * exact(run)["interface_stress"]
    end = start + exact(run)["contact_time"]
    return [("exact", [1e6 * t for t in (0, start, start, end, end, run.column("time")[-1])], [0, 0, plateau, plateau, 0, 0])]


FIGURES = [Figure("stress", "time [us]", "stress of the interface [MPa]", stress_over_time, exact=exact_stress,
                  caption="Stress between two bars that close at 10 m/s: the pulse of one dimension, until the waves are back from the "
                          "free ends.")]

