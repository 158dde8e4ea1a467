"""How close is close enough, why, and what must break."""
from reference import SLOW, YOUNG, area_between, area_under, between, cowper_symonds, ludwik, measured, pulled, swift, uniaxial, voce
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
STRESSES = ("stress_xx", "stress_yy", "stress_xy")
COWPER = {"material.cowper_symonds.rate": "40.4 1/s", "material.cowper_symonds.exponent": 5}
IN_PLATES = {"voce": {CURVE + "yield": "250 MPa", CURVE + "growth": "300 MPa", CURVE + "exponent": 10, **COWPER},
             "ludwik": {CURVE + "yield": "250 MPa", CURVE + "growth": "300 MPa", CURVE + "exponent": 0.5, **COWPER},
             "swift": {CURVE + "growth": "700 MPa", CURVE + "exponent": 0.2, CURVE + "offset": 0.02, **COWPER}}


def of(case, change=None):
    """The run of another case of this folder, with keys set; in a break of that case the run itself with these keys."""
    return lambda run: run.again(change or {}) if str(run.case_file).endswith("/" + case) else \
        run.other("material_point", HERE + case, change)


def farthest(pairs, unit="Pa", scale=YIELD):
    return Pair(*max(pairs, key=lambda pair: abs(pair[0] - pair[1])), unit, scale=scale)


def rows(run, *names):
    return list(zip(*(run.column(name) for name in names)))


def steps_of(run):
    """Of each increment [s]; `run.column("time")` counts segments, of equal increments."""
    numbers = [max(int(one - 1e-9), 0) for one in run.column("time")[1:]]
    return [run.case(f"path[{number}].duration") / run.case(f"path[{number}].increments") for number in numbers]


def flowing(run):
    """Rows of stress, plastic strain and rate of plastic strain that flow."""
    stress, flow = run.column("stress_xx"), run.column("plastic_strain")
    return [(s, p, (p - before) / step) for s, p, before, step in zip(stress[1:], flow[1:], flow, steps_of(run)) if p > before]


def on_curve(curve, change=None):
    """Every row that flows against the curve at its plastic strain."""
    return lambda run: farthest([(s, curve(p)) for s, p, _ in flowing(run.again(change) if change else run)])


def strains(run):
    """Every row: elastic and plastic strain make the strain up."""
    return farthest([(e, p + s / YOUNG) for e, s, p in rows(run, "strain_xx", "stress_xx", "plastic_strain")], "1", YIELD / YOUNG)


def from_strains(flow, case="case.yaml", change=None):
    """Every row that is pulled: the plastic strain against that of the law, from the strains alone."""
    def measure(run):
        there = of(case, change)(run)
        pull = PULL if case == "case.yaml" else None  # behind it the case unloads
        exact = pulled(there.column("strain_xx")[:pull], steps_of(there), flow)
        return farthest([(p, q) for p, (_, q, _) in zip(there.column("plastic_strain"), exact)], "1", YIELD / YOUNG)
    return measure


def unloading(run):
    strain, stress = run.column("strain_xx"), run.column("stress_xx")
    return Pair((stress[-1] - stress[PULL]) / (strain[-1] - strain[PULL]), YOUNG, "Pa")


def work(run):
    """At the end; unloading is elastic."""
    return Pair(run.column("work_dissipated")[-1], area_under(SLOW, run.column("plastic_strain")[-1]), "J/m3")


def at_rates(run):
    return farthest([(s, between(p, rate)) for s, p, rate in flowing(of("rates.yaml")(run))])


def work_at_rates(run):
    """At the end, against areas below the curves at the rate of each increment."""
    there = of("rates.yaml")(run)
    flow = there.column("plastic_strain")
    exact = sum(area_between(p, q, (q - p) / step) for p, q, step in zip(flow, flow[1:], steps_of(there)))
    return Pair(there.column("work_dissipated")[-1], exact, "J/m3")


def at_rate_of_cowper(end, rate):
    return lambda run: Pair(of("cowper.yaml")(run).column("stress_xx")[end], YIELD * cowper_symonds(rate), "Pa")


def plane_and_space(plane, space, names, change=None):
    def measure(run):
        one, other = of(plane, change)(run), of(space, change)(run)
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
SUMS = "of the yield strain; the increments of the strain are sums, and round-off of a sum of 0.18 is 2e-14 of the yield strain each"
TWICE = "one implicit increment, written in two ways; free stresses are zero to 1e-14"
JUMPS = "the trapezoid of the two increments in which the stress jumps: half of some 20 MPa over a ten thousandth of strain, 2e-5"
KINKS = "the trapezoid of an increment across a kink of the curve: a ten thousandth of strain"
CHECKS = [
    Check("measured: every row on the curve", on_curve(lambda p: measured(SLOW, p)), 1e-12, POINT),
    Check("measured: elastic and plastic strain, every row", strains, 1e-10, SUMS),
    Check("measured: plastic strain from the strain alone, every row", from_strains(lambda p, _: measured(SLOW, p)), 1e-10, SUMS),
    Check("measured: slope of unloading", unloading, 1e-12, "Hooke's law"),
    Check("measured: dissipated work", work, 1e-5, KINKS),
    Check("two rates: every row between the curves", at_rates, 1e-12, POINT),
    Check("two rates: plastic strain from the strain alone, every row", from_strains(between, "rates.yaml"), 1e-10, SUMS),
    Check("two rates: dissipated work", work_at_rates, 3e-5, JUMPS),
    Check("Cowper and Symonds: 1/s", at_rate_of_cowper(500, 1), 1e-12, "no hardening: the flow has the rate of the strain"),
    Check("Cowper and Symonds: 40.4/s", at_rate_of_cowper(1000, 40.4), 1e-12, "as at 1/s"),
    Check("Cowper and Symonds: plastic strain from the strain alone, every row",
          from_strains(lambda _, rate: YIELD * cowper_symonds(rate), "cowper.yaml"), 1e-10, SUMS),
    *(Check(f"{kind}: every row on the curve", on_curve(curve, {CURVE + "kind": kind, **change}), 1e-12, POINT)
      for kind, (curve, change) in FORMULAS.items()),
    *(Check(f"{kind}: plastic strain from the strain alone, every row",
            from_strains(lambda p, _, curve=curve: curve(p), change={CURVE + "kind": kind, **change}), 1e-10, SUMS)
      for kind, (curve, change) in FORMULAS.items()),
    Check("plane stress as in space, every row", plane_and_space("in_the_plane.yaml", "in_space.yaml", STRESSES), 1e-12, TWICE,
          evidence="invariant"),
    Check("two rates in a plate: as in space, every row", plane_and_space("rates_in_the_plane.yaml", "rates_in_space.yaml", STRESSES),
          1e-12, TWICE, evidence="invariant"),
    *(Check(f"{kind} by Cowper and Symonds in a plate: as in space, every row",
            plane_and_space("in_the_plane.yaml", "in_space.yaml", STRESSES, {CURVE + "kind": kind, **of_plates}), 1e-12, TWICE,
            evidence="invariant")
      for kind, of_plates in IN_PLATES.items()),
    Check("Johnson and Cook in a plate: as in space, every row", plane_and_space("hot_plate.yaml", "hot_space.yaml", STRESSES), 1e-12,
          TWICE, evidence="invariant"),
    Check("Johnson and Cook in a plate: temperature as in space", same_temperature, 1e-12, "of 1 K; as the stress", evidence="invariant"),
    Check("Johnson and Cook in a plate: heat", heat, 1e-12, "the same products, summed in another order", evidence="invariant"),
]

FAST_TABLE = {CURVE + "table": "fast.csv"}

BREAKS = [
    Breaks("measured: every row on the curve", "another table", FAST_TABLE),
    Breaks("measured: elastic and plastic strain, every row", "the modulus of aluminium", {"material.young": "70 GPa"}),
    Breaks("measured: plastic strain from the strain alone, every row", "the modulus of aluminium", {"material.young": "70 GPa"}),
    Breaks("measured: slope of unloading", "the modulus of aluminium", {"material.young": "70 GPa"}),
    Breaks("measured: dissipated work", "ten increments", {"path[0].increments": 10}),
    Breaks("two rates: every row between the curves", "rates in 1/min", {CURVE + "rates[0].rate": "1 1/min"}, case=HERE + "rates.yaml"),
    Breaks("two rates: plastic strain from the strain alone, every row", "the fast curve at ten times its rate",
           {CURVE + "rates[1].rate": "1000 1/s"}, case=HERE + "rates.yaml"),
    Breaks("two rates: dissipated work", "ten increments at 10/s", {"path[1].increments": 10}, case=HERE + "rates.yaml"),
    Breaks("Cowper and Symonds: 1/s", "another exponent", {"material.cowper_symonds.exponent": 4}, case=HERE + "cowper.yaml"),
    Breaks("Cowper and Symonds: 40.4/s", "another rate", {"material.cowper_symonds.rate": "40 1/s"}, case=HERE + "cowper.yaml"),
    Breaks("Cowper and Symonds: plastic strain from the strain alone, every row", "another exponent",
           {"material.cowper_symonds.exponent": 4}, case=HERE + "cowper.yaml"),
    *(Breaks(f"{kind}: every row on the curve", "a yield stress or growth off by a hundredth",
             {CURVE + "yield": "252.5 MPa"} if kind != "swift" else {CURVE + "offset": 0.0202}) for kind in FORMULAS),
    *(Breaks(f"{kind}: plastic strain from the strain alone, every row", "the modulus of aluminium", {"material.young": "70 GPa"})
      for kind in FORMULAS),
    Breaks("plane stress as in space, every row", "a stress across the plate", {"path[0].stress.zz": "50 MPa"},
           case=HERE + "in_space.yaml"),
    Breaks("two rates in a plate: as in space, every row", "rates in 1/min", {CURVE + "rates[0].rate": "1 1/min"},
           case=HERE + "rates_in_the_plane.yaml"),
    *(Breaks(f"{kind} by Cowper and Symonds in a plate: as in space, every row", "twice as fast",
             {"path[0].duration": "5 ms", "path[1].duration": "0.5 ms"}, case=HERE + "in_the_plane.yaml") for kind in FORMULAS),
    Breaks("Johnson and Cook in a plate: as in space, every row", "ten times as fast", {"path[0].duration": "0.1 ms"},
           case=HERE + "hot_plate.yaml"),
    Breaks("Johnson and Cook in a plate: temperature as in space", "all work becomes heat", {"material.taylor_quinney": 1},
           case=HERE + "hot_plate.yaml"),
    Breaks("Johnson and Cook in a plate: heat", "all work becomes heat", {"material.taylor_quinney": 1}, case=HERE + "hot_plate.yaml"),
]


def curves(run):
    drawn = [("measured, without rate dependence", [100 * e for e in run.column("strain_xx")[::20]],
              [s / 1e6 for s in run.column("stress_xx")[::20]])]
    there = of("rates.yaml")(run)
    drawn.append(("at 1, 10 and 1000 per second", [100 * e for e in there.column("strain_xx")[::20]],
                  [s / 1e6 for s in there.column("stress_xx")[::20]]))
    return drawn


def exact_curve(run):
    pulled = [(e, uniaxial(e)[0]) for e in run.column("strain_xx")[:PULL + 1]]
    return [("table", [100 * e for e, _ in pulled], [s / 1e6 for _, s in pulled])]


FIGURES = [
    Figure("curves", "strain [%]", "stress [MPa]", curves, exact_curve, error=False,
           caption="A measured curve in uniaxial stress without rate dependence, and two curves while the rate is raised twice."),
]
