"""How close is close enough, why, and what must break."""
from reference import SLOW, YOUNG, area_under, between, cowper_symonds, ludwik, measured, swift, uniaxial, voce
from verify import Breaks, Check, Figure, Pair

CLAIM = "Metals follow their curves of flow stress, measured or by formula, and their effects of rate and heat, in space and in plates."
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "material_point"

HERE = "verification/hardening_curves/"
YIELD = SLOW[0][1]
CURVE = "material.curve."
FORMULAS = {"voce": (voce, {CURVE + "exponent": 10}), "ludwik": (ludwik, {}),
            "swift": (swift, {CURVE + "growth": "700 MPa", CURVE + "exponent": 0.2})}
PULL = 1800  # increments of the first segment of case.yaml


def of(case):
    """The run of another case of this folder; in a break of that case the run itself."""
    return lambda run: run if str(run.case_file).endswith("/" + case) else run.other("material_point", HERE + case)


def farthest(pairs, unit="Pa", scale=YIELD):
    return Pair(*max(pairs, key=lambda pair: abs(pair[0] - pair[1])), unit, scale=scale)


def rows(run, *names):
    return list(zip(*(run.column(name) for name in names)))


def flowing(run):
    """Rows of stress, plastic strain and rate of plastic strain that flow; `run.column("time")` counts segments, of equal increments."""
    stress, flow, segment = run.column("stress_xx"), run.column("plastic_strain"), run.column("time")
    found = []
    for i in range(1, len(flow)):
        number = max(int(segment[i] - 1e-9), 0)
        step = run.case(f"path[{number}].duration") / run.case(f"path[{number}].increments")
        if flow[i] > flow[i - 1]:
            found.append((stress[i], flow[i], (flow[i] - flow[i - 1]) / step))
    return found


def on_curve(curve, change=None):
    """Every row that flows against the curve at its plastic strain."""
    return lambda run: farthest([(s, curve(p)) for s, p, _ in flowing(run.again(change) if change else run)])


def strains(run):
    """Every row: elastic and plastic strain make the strain up."""
    return farthest([(e, p + s / YOUNG) for e, s, p in rows(run, "strain_xx", "stress_xx", "plastic_strain")], "1", YIELD / YOUNG)


def unloading(run):
    strain, stress = run.column("strain_xx"), run.column("stress_xx")
    return Pair((stress[-1] - stress[PULL]) / (strain[-1] - strain[PULL]), YOUNG, "Pa")


def work(run):
    """At the end; unloading is elastic."""
    return Pair(run.column("work_dissipated")[-1], area_under(SLOW, run.column("plastic_strain")[-1]), "J/m3")


def at_rates(run):
    return farthest([(s, between(p, rate)) for s, p, rate in flowing(of("rates.yaml")(run))])


def jump(run):
    """By how much the stress rises within an increment as the rate grows from 1/s to 10/s, less hardening on the slow curve."""
    there = of("rates.yaml")(run)
    (before, p, _), (after, q, rate) = [row for row in flowing(there) if row[1] >= there.column("plastic_strain")[600]][:2]
    return Pair(after - before, between(q, rate) - between(p, 1), "Pa")


def at_rate_of_cowper(end, rate):
    return lambda run: Pair(of("cowper.yaml")(run).column("stress_xx")[end], YIELD * cowper_symonds(rate), "Pa")


def plane_and_space(plane, space, names):
    def measure(run):
        one, other = of(plane)(run), of(space)(run)
        pairs = [pair for name in names for pair in zip(one.column(name), other.column(name))]
        return farthest(pairs)
    return measure


def heat(run):
    there = of("hot_plate.yaml")(run)
    rise = there.column("temperature")[-1] - there.case("material.reference_temperature")
    return Pair(rise, 0.9 * there.column("work_dissipated")[-1] / (7830 * 477), "K")


def same_temperature(run):
    return Pair(of("hot_plate.yaml")(run).column("temperature")[-1], of("hot_space.yaml")(run).column("temperature")[-1], "K", scale=1)


POINT = "the return is exact for any increment; Newton ends at round-off"
KINKS = "the trapezoid of an increment across a kink of the curve: a ten thousandth of strain"
CHECKS = [
    Check("measured: every row on the curve", on_curve(lambda p: measured(SLOW, p)), 1e-9, POINT),
    Check("measured: elastic and plastic strain, every row", strains, 1e-9, POINT),
    Check("measured: slope of unloading", unloading, 1e-9, "Hooke's law"),
    Check("measured: dissipated work", work, 1e-5, KINKS),
    Check("two rates: every row between the curves", at_rates, 1e-9, POINT),
    Check("two rates: jump of the stress", jump, 1e-9, POINT),
    Check("Cowper and Symonds: 1/s", at_rate_of_cowper(500, 1), 1e-9, "no hardening: the flow has the rate of the strain"),
    Check("Cowper and Symonds: 40.4/s", at_rate_of_cowper(1000, 40.4), 1e-9, "as at 1/s"),
    *(Check(f"{kind}: every row on the curve", on_curve(curve, {CURVE + "kind": kind, **change}), 1e-9, POINT)
      for kind, (curve, change) in FORMULAS.items()),
    Check("plane stress as in space, every row", plane_and_space("in_the_plane.yaml", "in_space.yaml",
          ("stress_xx", "stress_yy", "stress_xy")), 1e-9, "one implicit increment, written in two ways; free stresses are zero to 1e-14"),
    Check("Johnson and Cook in a plate: as in space, every row", plane_and_space("hot_plate.yaml", "hot_space.yaml",
          ("stress_xx", "stress_yy", "stress_xy")), 1e-9, "as the measured curve"),
    Check("Johnson and Cook in a plate: temperature as in space", same_temperature, 1e-9, "of 1 K; as the stress"),
    Check("Johnson and Cook in a plate: heat", heat, 1e-10, "the same products, summed in another order"),
]

FAST_TABLE = {CURVE + "table": "fast.csv"}

BREAKS = [
    Breaks("measured: every row on the curve", "another table", FAST_TABLE),
    Breaks("measured: elastic and plastic strain, every row", "the modulus of aluminium", {"material.young": "70 GPa"}),
    Breaks("measured: slope of unloading", "the modulus of aluminium", {"material.young": "70 GPa"}),
    Breaks("measured: dissipated work", "ten increments", {"path[0].increments": 10}),
    Breaks("two rates: every row between the curves", "rates in 1/min", {CURVE + "rates[0].rate": "1 1/min"}, case=HERE + "rates.yaml"),
    Breaks("two rates: jump of the stress", "the fast curve at ten times its rate", {CURVE + "rates[1].rate": "1000 1/s"},
           case=HERE + "rates.yaml"),
    Breaks("Cowper and Symonds: 1/s", "another exponent", {"material.cowper_symonds.exponent": 4}, case=HERE + "cowper.yaml"),
    Breaks("Cowper and Symonds: 40.4/s", "another rate", {"material.cowper_symonds.rate": "40 1/s"}, case=HERE + "cowper.yaml"),
    *(Breaks(f"{kind}: every row on the curve", "a yield stress or growth off by a hundredth",
             {CURVE + "yield": "252.5 MPa"} if kind != "swift" else {CURVE + "offset": 0.0202}) for kind in FORMULAS),
    Breaks("plane stress as in space, every row", "a stress across the plate", {"path[0].stress.zz": "50 MPa"},
           case=HERE + "in_space.yaml"),
    Breaks("Johnson and Cook in a plate: as in space, every row", "ten times as fast", {"path[0].duration": "0.1 ms"},
           case=HERE + "hot_plate.yaml"),
    Breaks("Johnson and Cook in a plate: temperature as in space", "all work becomes heat", {"material.taylor_quinney": 1},
           case=HERE + "hot_plate.yaml"),
    Breaks("Johnson and Cook in a plate: heat", "all work becomes heat", {"material.taylor_quinney": 1}, case=HERE + "hot_plate.yaml"),
]


def curves(run):
    drawn = [("measured, at no rate", [100 * e for e in run.column("strain_xx")[::20]], [s / 1e6 for s in run.column("stress_xx")[::20]])]
    there = of("rates.yaml")(run)
    drawn.append(("at 1, 10 and 1000 per second", [100 * e for e in there.column("strain_xx")[::20]],
                  [s / 1e6 for s in there.column("stress_xx")[::20]]))
    return drawn


def exact_curve(run):
    pulled = [(e, uniaxial(e)[0]) for e in run.column("strain_xx")[:PULL + 1]]
    return [("table", [100 * e for e, _ in pulled], [s / 1e6 for _, s in pulled])]


FIGURES = [
    Figure("curves", "strain [%]", "stress [MPa]", curves, exact_curve, error=False,
           caption="A measured curve in uniaxial stress at no rate, and two curves while the rate is raised twice."),
]
