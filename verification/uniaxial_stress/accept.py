"""How close is close enough, why, and what must break."""
from math import log1p

from reference import LEAD, STEEL, dissipated, plastic_modulus, plastic_strain, stored, stress, yield_strain
from verify import Breaks, Check, Falls, Figure, Pair, Table

CATALOGUE = ("M-1", "M-7")
CLAIM = ("In uniaxial stress, alone and in every element, a law follows its bilinear curve of Cauchy stress over logarithmic strain, "
         "and its plastic modulus is E Et/(E - Et).")
EVIDENCE = "exact"
DRIVER = "scene"

KGF = 9.80665e6  # [Pa] of one kgf/mm2
HERE = "verification/uniaxial_stress/"
FULL = {"bodies[0].element.kind": "full"}
IN_STEEL = {"density": "8.0e-10 kgf*s^2/mm^4", "young": "1.96e4 kgf/mm^2", "poisson": 0.33, "yield": "31.6 kgf/mm^2",
            "tangent": "195 kgf/mm^2"}
MATERIAL = "bodies[0].material."
STEEL_ELEMENT = {**{MATERIAL + key: value for key, value in IN_STEEL.items()},
                 "planes[3].velocity.value": '"0.00485/20*(1 - cos(2*pi*t/20))"', "time.end": "20 s", "output.history_every": "0.2 s"}
STEEL_LAW = {**{"material." + key: value for key, value in IN_STEEL.items()}, "path[0].strain.xx": 3 * yield_strain(STEEL)}


def law(run, metal, plate=False):
    """The law alone, with the material or the path that a break has changed."""
    broken = {key.removeprefix("bodies[0]."): value for key, value in run.overrides.items() if key.startswith((MATERIAL, "path"))}
    return run.other("material_point", HERE + ("law_in_a_plate.yaml" if plate else "law.yaml"), {**(STEEL_LAW if metal is STEEL else {}),
        **broken})


def element(run, metal, change=(), case="case.yaml"):
    """One element; a break's changes of the material hold for steel too, those of the drive for lead."""
    changes = dict(run.overrides)
    if metal is STEEL:
        changes = {**STEEL_ELEMENT, **{key: value for key, value in changes.items() if key.startswith(MATERIAL)}}
    return run.other("scene", HERE + case, {**changes, **dict(change)})


def farthest(got, expected, scale, unit="Pa"):
    """The row where two columns differ most."""
    worst = max(zip(got, expected), key=lambda pair: abs(pair[0] - pair[1]))
    return Pair(*worst, unit, scale=scale)


def curve_of_law(metal, plate=False):
    def measure(run):
        here = law(run, metal, plate)
        return farthest(here.column("stress_xx"), [KGF * stress(metal, e) for e in here.column("strain_xx")], KGF * metal["yield"])
    return measure


def free_of_law(run):
    """The largest stress that should be zero."""
    here = law(run, LEAD)
    return Pair(max(abs(s) for name in ("yy", "zz", "xy", "yz", "xz") for s in here.column("stress_" + name)), 0, "Pa",
                scale=KGF * LEAD["yield"])


def modulus(metal):
    """From the last two rows of the law: the slope of stress over plastic strain."""
    def measure(run):
        here = law(run, metal)
        s, p = here.column("stress_xx"), here.column("plastic_strain")
        return Pair((s[-1] - s[-101]) / (p[-1] - p[-101]) / KGF, plastic_modulus(metal), "kgf/mm2")
    return measure


def work(name, exact):
    def measure(run):
        here = law(run, LEAD)
        return Pair(here.result(name), KGF * exact(LEAD, here.result("strain_xx")), "J/m3")
    return measure


def log_strain(run):
    return [log1p(u) for u in run.column("stretch")]


def end_of_element(metal, change=(), case="case.yaml"):
    def measure(run):
        here = element(run, metal, change, case)
        return Pair(here.column("stress_xx")[-1], KGF * stress(metal, log_strain(here)[-1]), "Pa")
    return measure


def plastic_strain_of_element(run):
    return Pair(run.column("plastic_strain")[-1], plastic_strain(LEAD, log_strain(run)[-1]), "")


def free_side(run):
    return Pair(run.column("stress_yy")[-1], 0, "Pa", scale=KGF * LEAD["yield"])


def curve_of_element(run):
    return farthest(run.column("stress_xx"), [KGF * stress(LEAD, e) for e in log_strain(run)], KGF * LEAD["yield"])


DEPARTURES = {"integration": "the law is checked in every kind of element; one of the checks is of eight points"}

CHECKS = [
    Check("law, lead", curve_of_law(LEAD), 1e-12,
          "a straight path: the return is exact for any increment; the catalogue's bound of a law alone"),
    Check("law of a plate, lead", curve_of_law(LEAD, plate=True), 1e-12, "as in space"),
    Check("law, steel", curve_of_law(STEEL), 1e-12, "as lead"),
    Check("law of a plate, steel", curve_of_law(STEEL, plate=True), 1e-12, "as lead"),
    Check("law, lead: stresses that are free", free_of_law, 1e-12, "Newton ends at 1e-14 of the trial stress"),
    Check("law, lead: plastic modulus", modulus(LEAD), 1e-8, "the catalogue's bound"),
    Check("law, steel: plastic modulus", modulus(STEEL), 1e-8, "the catalogue's bound"),
    Check("law, lead: dissipated work", work("work_dissipated", dissipated), 1e-12,
          "an increment ends where yielding begins; the trapezoid rule is exact on lines"),
    Check("law, lead: stored work", work("work_stored", stored), 1e-12, "as the dissipated work"),
    Check("hexahedron of one point, lead", end_of_element(LEAD), 1e-8, "the catalogue's bound; at the end nothing moves"),
    Check("hexahedron of eight points, lead", end_of_element(LEAD, FULL), 1e-8, "as of one point"),
    Check("plate, lead", end_of_element(LEAD, case="plate.yaml"), 1e-8,
          "as the hexahedra; a plate's stress is Cauchy's with the thickness kept"),
    Check("hexahedron of one point, steel", end_of_element(STEEL), 1e-8, "as lead"),
    Check("plate, steel", end_of_element(STEEL, case="plate.yaml"), 1e-8, "as lead"),
    Check("hexahedron, lead: plastic strain", plastic_strain_of_element, 1e-8, "as the stress"),
    Check("hexahedron, lead: stress on its free sides", free_side, 1e-8, "as the stress"),
    Check("hexahedron, lead: the curve on the way", curve_of_element, 1e-5,
          "sides have mass: where yielding begins they must come in faster, and ring, for viscosity does not act on a single element; the "
          "study has how the error goes with the mass"),
]

STUDIES = [
    Falls("hexahedron, lead: the curve on the way", along=MATERIAL + "density", order=0.4,
          values=["1.13e-7 kgf*s^2/mm^4", "1.13e-8 kgf*s^2/mm^4", "1.13e-9 kgf*s^2/mm^4"]),
    Table("Lead at three times the yield strain, in kgf/mm2: which strain and which stress.",
          ["strain taken as", "stress over present area", "stress over first area"],
          lambda run: [["logarithm of the stretch (this code)", f"{run.column('stress_xx')[-1] / KGF:.5f}", f"{first_area(run):.5f}"],
                       ["the same, exact", f"{stress(LEAD, log_strain(run)[-1]):.5f}", ""],
                       ["elongation over first length", f"{stress(LEAD, run.column('stretch')[-1]):.5f}", ""]]),
]


def first_area(run):
    """Force over the first area: volume over stretch, with the volume of the elastic strain."""
    e, s = log_strain(run)[-1], stress(LEAD, log_strain(run)[-1])
    volume = 2.718281828459045**((1 - 2 * 0.42) * s / LEAD["young"])
    return run.column("stress_xx")[-1] / KGF * volume / 2.718281828459045**e


TANGENT_OF_LEAD = "1.68969 kgf/mm^2"  # whose plastic modulus is the table's tangent
BREAKS = [
    Breaks("law, lead: plastic modulus", "the tangent taken for the plastic modulus", {MATERIAL + "tangent": TANGENT_OF_LEAD}),
    Breaks("law, steel: plastic modulus", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}),
    Breaks("law, lead", "the tangent taken for the plastic modulus", {MATERIAL + "tangent": TANGENT_OF_LEAD}),
    Breaks("law of a plate, lead", "a plate's stiffness E/(1 - nu^2) in uniaxial stress", {MATERIAL + "young": "23.676 kgf/mm^2"}),
    Breaks("law, steel", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}, full=True),
    Breaks("law of a plate, steel", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}, full=True),
    Breaks("law, lead: stresses that are free", "a side that is pressed", {"path[0].stress.yy": "1 MPa"}, full=True),
    Breaks("law, lead: dissipated work", "no hardening", {MATERIAL + "tangent": "0 kgf/mm^2"}),
    Breaks("law, lead: stored work", "1 kgf taken for 10 N", {MATERIAL + "yield": "30.2 MPa"}),
    Breaks("hexahedron of one point, lead", "the tangent taken for the plastic modulus", {MATERIAL + "tangent": TANGENT_OF_LEAD}),
    Breaks("hexahedron of eight points, lead", "sides held: uniaxial strain", {"planes[1].nodes": "[cube.y_low, cube.y_high]"}),
    Breaks("plate, lead", "1 kgf taken for 10 N", {MATERIAL + "yield": "30.2 MPa"}),
    Breaks("plate, steel", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}),
    Breaks("hexahedron of one point, steel", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}, full=True),
    Breaks("hexahedron, lead: plastic strain", "the tangent taken for the plastic modulus", {MATERIAL + "tangent": TANGENT_OF_LEAD},
           full=True),
    Breaks("hexahedron of one point, lead", "pulled without a smooth stop",
           {"planes[3].velocity.value": '"0.5914/1000"'}),
    Breaks("hexahedron, lead: stress on its free sides", "pulled without a smooth stop",
           {"planes[3].velocity.value": '"0.5914/1000"'}),
    Breaks("hexahedron, lead: the curve on the way", "pulled ten times as fast",
           {"planes[3].velocity.value": '"0.5914/100*(1 - cos(2*pi*t/100))"', "time.end": "100 s", "output.history_every": "1 s"}),
]


def curves(run):
    plate, alone = element(run, LEAD, case="plate.yaml"), law(run, LEAD)
    return [("law alone", alone.column("strain_xx")[::15], [s / 1e6 for s in alone.column("stress_xx")[::15]]),
            ("hexahedron", log_strain(run)[5::9], [s / 1e6 for s in run.column("stress_xx")[5::9]]),
            ("plate", log_strain(plate)[::9], [s / 1e6 for s in plate.column("stress_xx")[::9]])]


def exact_curve(run):
    first, last = yield_strain(LEAD), 3 * yield_strain(LEAD)
    strains = [0, first, last]
    return [("exact", strains, [KGF / 1e6 * stress(LEAD, e) for e in strains])]


FIGURES = [Figure("curve", "logarithmic strain", "Cauchy stress [MPa]", curves, exact=exact_curve,
                  caption="Lead of Table II in uniaxial stress: the law alone, one hexahedron and two plates on the bilinear curve.")]
