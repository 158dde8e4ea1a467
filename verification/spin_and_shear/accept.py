"""How close is close enough, why, and what must break."""
from reference import green_naghdi, jaumann, logarithmic
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("E-2",)
CLAIM = "Stress in simple shear up to 4 follows Jaumann's rate where a law may flow; of the elastic law, up to 2, the logarithmic strain."
EVIDENCE = "exact"
DRIVER = "scene"

SHEAR_MODULUS = 1.0  # [Pa]
SHEAR = 4.0          # [-] at the end


def elastic(run):
    return run.again({"bodies[0].material.kind": "elastic"})


def worst(component, sign, which, rate=jaumann, most=SHEAR, of=lambda run: run):
    """The sample that is farthest from the exact curve, over the shear modulus."""
    def measure(run):
        one = of(run)
        rows = [(sign * got, SHEAR_MODULUS * rate(shear)[which]) for got, shear in zip(one.column(component), one.column("shear"))
                if shear <= most]
        got, exact = max(rows, key=lambda row: abs(row[0] - row[1]))
        return Pair(got, exact, "Pa", scale=SHEAR_MODULUS)
    return measure


def shear(run):
    return Pair(run.column("shear")[-1], SHEAR, "m")


def against_green_naghdi(run):
    return Pair(run.column("stress_xz")[-1], SHEAR_MODULUS * green_naghdi(SHEAR)[0], "Pa", scale=SHEAR_MODULUS)


def curve(run):
    rows = []
    for target in (0.5, 1.0, 2.0, 3.0, 4.0):
        t = target / SHEAR * run.column("time")[-1]
        rows.append([f"{target:g}", f"{run.at('stress_xz', t):.6f}", f"{jaumann(target)[0]:.6f}", f"{green_naghdi(target)[0]:.6f}",
                     f"{run.at('stress_xx', t):.6f}", f"{jaumann(target)[1]:.6f}", f"{green_naghdi(target)[1]:.6f}"])
    return rows


CHECKS = [
    Check("shear at the end", shear, 1e-9, "held nodes move as they are told; sums of some thousand steps"),
    Check("shear stress", worst("stress_xz", 1, 0), 1e-4, "the catalogue's bound at increments of the shear of 0.001"),
    Check("normal stress along", worst("stress_xx", 1, 1), 1e-4, "as the shear stress"),
    Check("normal stress across", worst("stress_zz", -1, 1), 1e-4, "as the shear stress; its sign is the other"),
    Check("shear stress of the elastic law up to 2", worst("stress_xz", 1, 0, logarithmic, 2, elastic), 2e-3,
          "x coth x by three terms is within 0.2 % up to x = 2; here x ends at 1.76"),
    Check("normal stress of the elastic law up to 2", worst("stress_xx", 1, 1, logarithmic, 2, elastic), 2e-3, "as the shear stress"),
    Report("shear stress of the elastic law up to 4", worst("stress_xz", 1, 0, logarithmic, 4, elastic), "x ends at 2.9"),
    Report("Green and Naghdi's shear stress at the end", against_green_naghdi, "another rate, which this is not"),
]

STUDIES = [Table("Over the shear: stresses over the shear modulus.",
                 ["shear", "shear stress", "Jaumann", "Green-Naghdi", "normal stress", "Jaumann", "Green-Naghdi"], curve)]

FAST = {"planes[3].velocity.value": '"0.2"', "time.end": "20 s", "output.history_every": "0.05 s", "output.frames_every": "20 s"}
BREAKS = [
    Breaks("shear stress of the elastic law up to 2", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}),
    Breaks("normal stress of the elastic law up to 2", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}),
    Breaks("shear stress", "increments of the shear a hundred times too large", FAST),
    Breaks("shear at the end", "held nodes that lag by one part in a million", {"planes[3].velocity.value": '"0.002 * (1 - 1e-6)"'}),
    Breaks("normal stress along", "increments of the shear a hundred times too large", FAST),
    Breaks("normal stress across", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}),
    Breaks("shear stress", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}),
]


SHEARS = [i / 100 for i in range(401)]


def shear_stress(run):
    return [("Nereid", run.column("shear"), run.column("stress_xz"))]


def exact_shear_stress(_):
    return [("Jaumann", SHEARS, [jaumann(g)[0] for g in SHEARS])]


def normal_stress(run):
    return [("along", run.column("shear"), run.column("stress_xx")), ("across", run.column("shear"), run.column("stress_zz"))]


def exact_normal_stress(_):
    return [("Jaumann, along", SHEARS, [jaumann(g)[1] for g in SHEARS]), ("Jaumann, across", SHEARS, [-jaumann(g)[1] for g in SHEARS])]


FIGURES = [
    Figure("shear", "shear [-]", "shear stress over shear modulus [-]", shear_stress, exact=exact_shear_stress,
           caption="Shear stress in simple shear: with Jaumann's rate a sine."),
    Figure("normal", "shear [-]", "normal stress over shear modulus [-]", normal_stress, exact=exact_normal_stress,
           caption="Normal stresses in simple shear."),
]
