"""How close is close enough, why, and what must break."""
from math import log1p

from reference import (LEAD, STEEL, plastic_modulus_in_uniaxial_strain, pure_shear, tangent_in_shear, uniaxial_strain,
                       yield_stress_in_shear)
from verify import Breaks, Check, Falls, Figure, Pair

CATALOGUE = ("M-2", "M-7")
CLAIM = ("In uniaxial strain and in pure shear, alone and in every element, a law yields at 2 G e = sy and at sy/sqrt(3), and continues"
         " with the slopes K + (4 G/3) H/(H + 3 G) and 1/(1/G + 3/H).")
EVIDENCE = "exact"
DRIVER = "scene"

KGF = 9.80665e6  # [Pa] of one kgf/mm2
HERE = "verification/uniaxial_strain_and_shear/"
MATERIAL = "bodies[0].material."
FULL = {"bodies[0].element.kind": "full"}
IN_STEEL = {"density": "8.0e-10 kgf*s^2/mm^4", "young": "1.96e4 kgf/mm^2", "poisson": 0.33, "yield": "31.6 kgf/mm^2",
            "tangent": "195 kgf/mm^2"}


def material(run):
    """What a break has changed in the material."""
    return {key: value for key, value in run.overrides.items() if key.startswith(MATERIAL)}


def law(run, case, metal=LEAD, change=()):
    steel = {"material." + key: value for key, value in IN_STEEL.items()} if metal is STEEL else {}
    broken = {key[len("bodies[0]."):]: value for key, value in material(run).items()}
    return run.other("material_point", HERE + case, {**steel, **broken, **dict(change)})


def farthest(got, expected, metal):
    worst = max(zip(got, expected), key=lambda pair: abs(pair[0] - pair[1]))
    return Pair(*(x / KGF for x in worst), "kgf/mm2", scale=metal["yield"])


def of_law(metal, which):
    """0 along, 1 across."""
    def measure(run):
        here = law(run, "law.yaml", metal, {"path[0].strain.xx": 0.01} if metal is STEEL else ())
        exact = [KGF * uniaxial_strain(metal, e)[which] for e in here.column("strain_xx")]
        return farthest(here.column(("stress_xx", "stress_yy")[which]), exact, metal)
    return measure


def shear_of_law(metal, case="law_in_shear.yaml"):
    def measure(run):
        here = law(run, case, metal, {"path[0].strain.xy": 0.005} if metal is STEEL else ())
        return farthest(here.column("stress_xy"), [KGF * pure_shear(metal, 2 * e) for e in here.column("strain_xy")], metal)
    return measure


def last_slope(column, over, case, exact, factor=1, metal=LEAD, change=()):
    """From the last two rows, where the law flows."""
    def measure(run):
        here = law(run, case, metal, change)
        s, e = here.column(column), here.column(over)
        return Pair((s[-1] - s[-2]) / (factor * (e[-1] - e[-2])) / KGF, exact(metal), "kgf/mm2")
    return measure


def yield_in_shear(metal, change=()):
    """Where the last slope, drawn back, meets the first one."""
    def measure(run):
        here = law(run, "law_in_shear.yaml", metal, change)
        s, g = [x / KGF for x in here.column("stress_xy")], [2 * e for e in here.column("strain_xy")]
        first, last = s[1] / g[1], (s[-1] - s[-2]) / (g[-1] - g[-2])
        return Pair(first * (s[-1] - last * g[-1]) / (first - last), yield_stress_in_shear(metal), "kgf/mm2")
    return measure


def of_element(which, change=()):
    def measure(run):
        here = run.again(dict(change)) if change else run
        exact = [KGF * uniaxial_strain(LEAD, log1p(u))[which] for u in here.column("stretch")]
        return farthest(here.column(("stress_xx", "stress_yy")[which]), exact, LEAD)
    return measure


def plastic_strain_of_element(run):
    return Pair(run.column("plastic_strain")[-1], uniaxial_strain(LEAD, log1p(run.column("stretch")[-1]))[2], "")


def sheared(run, case="shear.yaml", change=()):
    return run.other("scene", HERE + case, {**material(run), **dict(change)})


def shear_strain(run):
    return [log1p(a) - log1p(b) for a, b in zip(run.column("stretch"), run.column("shortening"))]


def shear_of_element(case="shear.yaml", change=()):
    def measure(run):
        here = sheared(run, case, change)
        got = [(a - b) / 2 for a, b in zip(here.column("stress_xx"), here.column("stress_yy"))]
        return farthest(got, [KGF * pure_shear(LEAD, g) for g in shear_strain(here)], LEAD)
    return measure


STEEL_SHEAR = {"path[0].strain.xy": 0.005}
ALONE = "a straight path: the return is exact for any increment; the catalogue's bound of a law alone"
ELEMENT = "the catalogue's bound; the strain of the middle of a step is its logarithm to the second order, the study has that"
DEPARTURES = {"integration": "the law is checked in every kind of element; two of the checks are of eight points"}

CHECKS = [
    Check("law, uniaxial strain, lead: stress along", of_law(LEAD, 0), 1e-12, ALONE),
    Check("law, uniaxial strain, lead: stress across", of_law(LEAD, 1), 1e-12, ALONE),
    Check("law, uniaxial strain, steel: stress along", of_law(STEEL, 0), 1e-12, ALONE),
    Check("law, uniaxial strain, lead: plastic slope",
          last_slope("stress_xx", "strain_xx", "law.yaml", plastic_modulus_in_uniaxial_strain), 1e-8, "the catalogue's bound"),
    Check("law, shear, lead", shear_of_law(LEAD), 1e-12, ALONE),
    Check("law of a plate, shear, lead", shear_of_law(LEAD, "law_in_shear_of_a_plate.yaml"), 1e-12, ALONE),
    Check("law, shear, steel", shear_of_law(STEEL), 1e-12, ALONE),
    Check("law, shear, lead: yield stress", yield_in_shear(LEAD), 1e-8, "the catalogue's bound"),
    Check("law, shear, steel: yield stress", yield_in_shear(STEEL, STEEL_SHEAR), 1e-8, "the catalogue's bound"),
    Check("law, shear, lead: plastic slope", last_slope("stress_xy", "strain_xy", "law_in_shear.yaml", tangent_in_shear, 2), 1e-8,
          "the catalogue's bound"),
    Check("law, shear, steel: plastic slope",
          last_slope("stress_xy", "strain_xy", "law_in_shear.yaml", tangent_in_shear, 2, STEEL, STEEL_SHEAR), 1e-8,
          "the catalogue's bound"),
    Check("hexahedron of one point, uniaxial strain: stress along", of_element(0), 1e-8, ELEMENT),
    Check("hexahedron of one point, uniaxial strain: stress across", of_element(1), 1e-8, ELEMENT),
    Check("hexahedron of one point, uniaxial strain: plastic strain", plastic_strain_of_element, 1e-8, ELEMENT),
    Check("hexahedron of eight points, uniaxial strain: stress along", of_element(0, FULL), 1e-8, ELEMENT),
    Check("hexahedron of one point, shear", shear_of_element(), 1e-8, ELEMENT),
    Check("hexahedron of eight points, shear", shear_of_element(change=FULL), 1e-8, ELEMENT),
    Check("plate, shear", shear_of_element("shear_of_a_plate.yaml"), 1e-8, ELEMENT),
]

DENSITY = MATERIAL + "density"  # nothing moves freely, so that it sets the increment alone, by its root
STUDIES = [
    Falls("hexahedron of one point, uniaxial strain: stress along", along=DENSITY, order=1.9, sizes=[16, 4, 1],
          values=["2.8928e-7 kgf*s^2/mm^4", "1.808e-8 kgf*s^2/mm^4", "1.13e-9 kgf*s^2/mm^4"]),
]

TANGENT = {MATERIAL + "tangent": "1.68969 kgf/mm^2"}  # whose plastic modulus is the table's tangent
BREAKS = [
    Breaks("law, uniaxial strain, lead: stress along", "Poisson's ratio of real lead", {MATERIAL + "poisson": 0.44}),
    Breaks("law, uniaxial strain, lead: plastic slope", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("law, shear, lead", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("law of a plate, shear, lead", "1 kgf taken for 10 N", {MATERIAL + "yield": "30.2 MPa"}),
    Breaks("law, shear, lead: yield stress", "the yield stress of Tresca", {MATERIAL + "yield": "2.61540 kgf/mm^2"}),
    Breaks("law, shear, lead: plastic slope", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("law, shear, steel: plastic slope", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}),
    Breaks("hexahedron of one point, uniaxial strain: stress along", "increments sixteen times too large",
           {DENSITY: "2.8928e-7 kgf*s^2/mm^4"}),
    Breaks("hexahedron of one point, uniaxial strain: stress across", "a side let free: no uniaxial strain",
           {"planes[1].nodes": "[cube.y_low]"}),
    Breaks("hexahedron of eight points, uniaxial strain: stress along", "the tangent taken for the plastic modulus", TANGENT),
    Breaks("hexahedron of one point, shear", "Poisson's ratio forgotten in the shear modulus", {MATERIAL + "poisson": 0}),
    Breaks("plate, shear", "the yield stress of Tresca", {MATERIAL + "yield": "2.61540 kgf/mm^2"}),
    Breaks("law, uniaxial strain, lead: stress across", "Poisson's ratio of real lead", {MATERIAL + "poisson": 0.44}, full=True),
    Breaks("law, uniaxial strain, steel: stress along", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}, full=True),
    Breaks("law, shear, steel", "the tangent of lead", {MATERIAL + "tangent": "1.85 kgf/mm^2"}, full=True),
    Breaks("law, shear, steel: yield stress", "the yield stress of Tresca", {MATERIAL + "yield": "27.3664 kgf/mm^2"}, full=True),
    Breaks("hexahedron of one point, uniaxial strain: plastic strain", "the tangent taken for the plastic modulus", TANGENT, full=True),
    Breaks("hexahedron of eight points, shear", "Poisson's ratio forgotten in the shear modulus", {MATERIAL + "poisson": 0}, full=True),
]


def curves(run):
    sheet, cube = sheared(run, "shear_of_a_plate.yaml"), sheared(run)

    def shear(here):
        return shear_strain(here)[::8], [(a - b) / 2e6 for a, b in zip(here.column("stress_xx")[::8], here.column("stress_yy")[::8])]

    alone = law(run, "law_in_shear.yaml", change={"path[0].increments": 20})
    return [("law alone", [2 * e for e in alone.column("strain_xy")], [s / 1e6 for s in alone.column("stress_xy")]),
            ("hexahedron", *shear(cube)), ("plate", *shear(sheet))]


def exact_shear(_run):
    shears = [0, yield_stress_in_shear(LEAD) / pure_shear(LEAD, 1e-9) * 1e-9, 0.5]
    return [("exact", shears, [KGF / 1e6 * pure_shear(LEAD, g) for g in shears])]


def along(run):
    rows = slice(4, None, 8)
    strains = [log1p(u) for u in run.column("stretch")[rows]]
    return [(name, strains, [s / 1e6 for s in run.column(column)[rows]]) for name, column in (("along", "stress_xx"),
        ("across", "stress_yy"))]


def exact_along(_run):
    strains = [i / 200 for i in range(81)]
    return [(name, strains, [KGF / 1e6 * uniaxial_strain(LEAD, e)[i] for e in strains]) for i,
            name in enumerate(("along, exact", "across, exact"))]


FIGURES = [Figure("shear", "engineering shear [-]", "shear stress [MPa]", curves, exact=exact_shear,
                  caption="Lead in pure shear: the law alone, one hexahedron, two plates."),
           Figure("uniaxial_strain", "logarithmic strain [-]", "stress [MPa]", along, exact=exact_along,
                  caption="Lead in uniaxial strain: the pressure grows on, the deviator yields.")]
