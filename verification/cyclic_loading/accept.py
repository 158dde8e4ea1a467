"""How close is close enough, why, and what must break."""
from math import log1p

from reference import LEAD, SHARES, STEEL, accumulated, dissipated, segments
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ("M-3", "M-7")
CLAIM = ("After tension to three times the yield strain, reverse yielding begins at minus the largest stress with isotropic hardening, "
         "at the largest stress minus twice the yield stress with kinematic hardening, and between with mixed; the whole cycle is "
         "exact.")
EVIDENCE = "exact"
DRIVER = "scene"

KGF = 9.80665e6  # [Pa] of one kgf/mm2
HERE = "verification/cyclic_loading/"
MATERIAL = "bodies[0].material."
HARDENING = MATERIAL + "hardening"
FULL = {"bodies[0].element.kind": "full"}
WORDS = {"isotropic": {"hardening": "isotropic"}, "kinematic": {"hardening": "kinematic"}, "mixed": {"hardening": "mixed",
    "isotropic_share": 0.5}}
TOP, DEPTH, LAST = 0.5914, 0.5914 - 0.963, 720.0  # [m] [m] [s] of the case
TURNS = [log1p(TOP), log1p(DEPTH), log1p(TOP)]
IN_STEEL = {"density": "8.0e-10 kgf*s^2/mm^4", "young": "1.96e4 kgf/mm^2", "poisson": 0.33, "yield": "31.6 kgf/mm^2",
            "tangent": "195 kgf/mm^2"}


def turns_of(metal):
    e = 3 * metal["yield"] / metal["young"]
    return [e, -e, e]


def broken(run):
    """What a break has changed in the material."""
    return {key: value for key, value in run.overrides.items() if key.startswith(MATERIAL)}


def law(run, metal, kind, case="law.yaml"):
    changes = {**(IN_STEEL if metal is STEEL else {}), **WORDS[kind], **{key[len(MATERIAL):]: value for key, value in broken(run).items()}}
    path = {f"path[{i}].strain.xx": e for i, e in enumerate(turns_of(metal))} if metal is STEEL else {}
    return run.other("material_point", HERE + case, {**{"material." + key: value for key, value in changes.items()}, **path})


def element(run, kind, change=(), case="case.yaml"):
    """One element; what a break says of the hardening holds for every kind."""
    words = {MATERIAL + key: value for key, value in WORDS[kind].items()}
    return run.other("scene", HERE + case, {**words, **run.overrides, **dict(change)})


def worst(rows, metal):
    got, exact = max(rows, key=lambda row: abs(row[0] - row[1]))
    return Pair(got, exact, "kgf/mm2", scale=metal["yield"])


def cycle_of_law(metal, kind, case="law.yaml"):
    def measure(run):
        here, exact = law(run, metal, kind, case), segments(metal, SHARES[kind], turns_of(metal))
        rows = zip(here.column("time"), here.column("strain_xx"), here.column("stress_xx"))
        return worst([(s / KGF, exact[min(int(t - 1e-9), 2)].at(e)) for t, e, s in rows if t > 0], metal)
    return measure


def reverse_yield(metal, kind, case="law.yaml"):
    """Where the plastic line of the way back, through its last two rows, meets the elastic line from the turning point."""
    def measure(run):
        here = law(run, metal, kind, case)
        e, s = here.column("strain_xx"), [x / KGF for x in here.column("stress_xx")]
        top, low = here.column("time").index(1.0), here.column("time").index(2.0)
        slope, young = (s[low] - s[low - 1]) / (e[low] - e[low - 1]), (s[top + 1] - s[top]) / (e[top + 1] - e[top])
        strain = (s[top] - young * e[top] - s[low] + slope * e[low]) / (slope - young)
        exact = segments(metal, SHARES[kind], turns_of(metal))[1].yield_stress
        return Pair(s[top] + young * (strain - e[top]), exact, "kgf/mm2", scale=metal["yield"])
    return measure


def plastic_strain_of_law(kind):
    return lambda run: Pair(law(run, LEAD, kind).result("plastic_strain"), accumulated(LEAD, SHARES[kind], turns_of(LEAD)), "")


def heat_of_law(kind):
    return lambda run: Pair(law(run, LEAD, kind).result("work_dissipated"), KGF * dissipated(LEAD, SHARES[kind], turns_of(LEAD)), "J/m3")


def rows_of_element(here, kind):
    exact = segments(LEAD, SHARES[kind], TURNS)
    rows = zip(here.column("time"), here.column("stretch"), here.column("stress_xx"))
    return [(t, s / KGF, exact[min(int(3 * t / LAST), 2)].at(log1p(u))) for t, u, s in rows]


def turns_of_element(kind, change=(), case="case.yaml"):
    """The worst of the three turning points, where nothing moves."""
    def measure(run):
        rows = rows_of_element(element(run, kind, change, case), kind)
        near = [min(rows, key=lambda row: abs(row[0] - turn * LAST / 3)) for turn in (1, 2, 3)]
        return worst([row[1:] for row in near], LEAD)
    return measure


def cycle_of_element(run):
    return worst([row[1:] for row in rows_of_element(element(run, "kinematic"), "kinematic")], LEAD)


def plastic_strain_of_element(run):
    return Pair(element(run, "kinematic").column("plastic_strain")[-1], accumulated(LEAD, 0.0, TURNS), "")


ALONE = "a straight path: the return is exact for any increment, and round-off is left; the catalogue's bound of a law alone"
AT_REST = "the catalogue's bound; at a turning point nothing moves"
DEPARTURES = {"integration": "the law is checked in every kind of element; one of the checks is of eight points"}

CHECKS = [
    *[Check(f"law, {name}, {kind}: the cycle", cycle_of_law(metal, kind), 1e-12, ALONE)
      for name, metal in (("lead", LEAD), ("steel", STEEL)) for kind in SHARES],
    *[Check(f"law of a plate, lead, {kind}: the cycle", cycle_of_law(LEAD, kind, "law_in_a_plate.yaml"), 1e-12, ALONE) for kind in SHARES],
    *[Check(f"law, {name}, {kind}: reverse yield", reverse_yield(metal, kind), 1e-8, "the catalogue's bound")
      for name, metal in (("lead", LEAD), ("steel", STEEL)) for kind in SHARES],
    *[Check(f"law, lead, {kind}: plastic strain", plastic_strain_of_law(kind), 1e-12, ALONE) for kind in SHARES],
    Check("law, lead, kinematic: dissipated work", heat_of_law("kinematic"), 1e-12,
          "flow begins after a third of each segment, where an increment ends; the trapezoid rule is exact on lines"),
    *[Check(f"law, lead, {kind}: dissipated work", heat_of_law(kind), 1e-4,
            "where flow begins inside an increment the trapezoid rule cuts the corner of the curve; the table has how that goes with the "
            "increments")
      for kind in ("isotropic", "mixed")],
    *[Check(f"hexahedron of one point, {kind}: turning points", turns_of_element(kind), 1e-8, AT_REST) for kind in SHARES],
    Check("hexahedron of eight points, kinematic: turning points", turns_of_element("kinematic", FULL), 1e-8, AT_REST),
    *[Check(f"plate, {kind}: turning points", turns_of_element(kind, case="plate.yaml"), 1e-8, AT_REST) for kind in SHARES],
    Check("hexahedron of one point, kinematic: plastic strain", plastic_strain_of_element, 1e-8,
          "as the stress; what the ringing of the sides adds is of second order"),
    Check("hexahedron of one point, kinematic: the cycle on the way", cycle_of_element, 3e-5,
          "sides have mass and swing where flow begins; uniaxial_stress has how that goes with the mass"),
]


def heat(run):
    rows = []
    for n in (20, 200, 2000):
        here = [run.other("material_point", HERE + "law.yaml",
                          {"material.hardening": kind, "path[0].increments": n, "path[1].increments": 2 * n, "path[2].increments": 2 * n})
                for kind in ("isotropic", "kinematic")]
        exact = [KGF * dissipated(LEAD, share, turns_of(LEAD)) for share in (1.0, 0.0)]
        rows.append([str(n), *(f"{r.result('work_dissipated') / e - 1:.2e}" for r, e in zip(here, exact))])
    return rows


STUDIES = [Table("Error of the dissipated work over the increments of the first pull.", ["increments", "isotropic", "kinematic"], heat)]

TANGENT = {MATERIAL + "tangent": "1.68969 kgf/mm^2"}  # whose plastic modulus is the table's tangent
MISTAKEN = {"isotropic": ("kinematic for isotropic hardening", {HARDENING: "kinematic"}),
            "kinematic": ("isotropic for kinematic hardening", {HARDENING: "isotropic"}),
            "mixed": ("a share of 0.51 for 0.5", {HARDENING: "mixed", MATERIAL + "isotropic_share": 0.51})}
BREAKS = [
    Breaks("law, lead, kinematic: reverse yield", "isotropic for kinematic hardening", {HARDENING: "isotropic"}),
    Breaks("law, lead, isotropic: reverse yield", "kinematic for isotropic hardening", {HARDENING: "kinematic"}),
    Breaks("law, lead, mixed: reverse yield", "a share of 0.51 for 0.5", {HARDENING: "mixed", MATERIAL + "isotropic_share": 0.51}),
    Breaks("law, steel, kinematic: reverse yield", "isotropic for kinematic hardening", {HARDENING: "isotropic"}),
    Breaks("law, lead, kinematic: the cycle", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("law of a plate, lead, kinematic: the cycle", "isotropic for kinematic hardening", {HARDENING: "isotropic"}),
    Breaks("law of a plate, lead, mixed: the cycle", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("law, lead, kinematic: plastic strain", "isotropic for kinematic hardening", {HARDENING: "isotropic"}),
    Breaks("law, lead, isotropic: dissipated work", "kinematic for isotropic hardening", {HARDENING: "kinematic"}),
    Breaks("law, lead, kinematic: dissipated work", "isotropic for kinematic hardening", {HARDENING: "isotropic"}),
    Breaks("hexahedron of one point, kinematic: turning points", "isotropic for kinematic hardening", {HARDENING: "isotropic"}),
    Breaks("hexahedron of one point, kinematic: turning points", "turned without a rest",
           {"planes[3].velocity.value": '"(t < 240 ? 0.5914 : t < 480 ? -0.963 : 0.963)/240"'}),
    Breaks("plate, isotropic: turning points", "kinematic for isotropic hardening", {HARDENING: "kinematic"}),
    Breaks("hexahedron of one point, kinematic: plastic strain", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("hexahedron of one point, kinematic: the cycle on the way", "a hundred times the mass",
           {MATERIAL + "density": "1.13e-7 kgf*s^2/mm^4"}),
    *(Breaks(name, *MISTAKEN[kind], full=True) for kind, names in {
        "isotropic": ("law, lead, isotropic: the cycle", "law, steel, isotropic: the cycle", "law of a plate, lead, isotropic: the cycle",
                      "law, steel, isotropic: reverse yield", "law, lead, isotropic: plastic strain",
                      "hexahedron of one point, isotropic: turning points"),
        "kinematic": ("law, steel, kinematic: the cycle", "hexahedron of eight points, kinematic: turning points",
                      "plate, kinematic: turning points"),
        "mixed": ("law, lead, mixed: the cycle", "law, steel, mixed: the cycle", "law, steel, mixed: reverse yield",
                  "law, lead, mixed: plastic strain", "law, lead, mixed: dissipated work",
                  "hexahedron of one point, mixed: turning points", "plate, mixed: turning points")}.items() for name in names),
]


def curves(run):
    shown = []
    for kind in SHARES:
        here = element(run, kind)
        shown.append((kind, [log1p(u) for u in here.column("stretch")[::9]], [s / 1e6 for s in here.column("stress_xx")[::9]]))
    return shown


def exact_curves(_run):
    shown = []
    for kind, share in SHARES.items():
        points = [(0.0, 0.0)]
        for one in segments(LEAD, share, TURNS):
            points += [(e, one.at(e)) for e in (one.yield_strain, one.end)]
        shown.append((f"{kind}, exact", [e for e, _ in points], [s * KGF / 1e6 for _, s in points]))
    return shown


FIGURES = [Figure("cycle", "logarithmic strain [-]", "Cauchy stress [MPa]", curves, exact=exact_curves,
                  caption="Lead pulled, pushed and pulled again by one hexahedron: three kinds of hardening, one curve of the first pull.")]
