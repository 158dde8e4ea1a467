"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import LENGTH, THICKNESS, WIDTH, force, stress, stress_both_ways, thickness, thickness_both_ways, volume
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ()
CLAIM = ("A plate that is stretched to twice its length, or to twice its area, keeps its volume: its thickness, its force and the height "
         "at which others touch it are those that are left.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/stretched_plate/"
KEEPS = {"bodies[0].element.thinning": "constant"}


def case(run, name):
    """The run of another case of this folder, with what a break has set."""
    return run if str(run.case_file).endswith(name) else run.other("scene", HERE + name, run.overrides)


def thicknesses(run, number=-1):
    """Of the elements; of the start where it does not change. [m]"""
    fields = run.frame("body", number)[1]
    return fields.get("thickness", [THICKNESS] * len(fields["von_mises_top"]))


def farthest(got, exact):
    return max(got, key=lambda value: abs(value - exact))


def of_length(run):
    return Pair(farthest(thicknesses(run), thickness(2)), thickness(2), "m")


def of_area(run):
    exact = thickness_both_ways(sqrt(2))
    return Pair(farthest(thicknesses(case(run, "both_ways.yaml")), exact), exact, "m")


def kept(run):
    """Mean thickness times area, over that of the start and over the elastic change."""
    area = (LENGTH + run.column("stretch")[-1]) * (WIDTH + run.column("narrowing")[-1]) / (LENGTH * WIDTH)
    values = thicknesses(run)
    return Pair(sum(values) / len(values) / THICKNESS * area / volume(stress(2)), 1)


def width(run):
    return Pair(WIDTH + run.column("narrowing")[-1], WIDTH / THICKNESS * thickness(2), "m")


def pull(run):
    return Pair(run.column("force")[-1], force(2), "N")


def pull_both_ways(run):
    there = case(run, "both_ways.yaml")
    exact = stress_both_ways(sqrt(2)) * WIDTH * sqrt(2) * thickness_both_ways(sqrt(2))
    return Pair(there.column("force")[-1], exact, "N")


def height(run):
    return Pair(case(run, "under_a_block.yaml").column("height")[-1], thickness(2) / 2, "m")


def warned(run):
    return any("plates keep their thickness" in note for note in run.summary["notes"])


def warnings(run):
    """Warnings of strips that keep their thickness and of strips that do not, which are none."""
    return Pair(warned(run.again(KEEPS)) - warned(run), 1)


def warning_below(run):
    """No warning of a strip that keeps its thickness, at a strain of a hundredth."""
    small = {"planes[3].velocity.value": '"0.001/0.06*(1 - cos(2*pi*t/0.06))"'}
    return Pair(1 - warned(run.again({**KEEPS, **small, **run.overrides})), 1)


ISSUE = "a thousandth is what the law of thinning is asked for"
EVEN = "strains are even, a step takes the logarithm to the square of its strain, 1e-6, and the pull stops smoothly"

CHECKS = [
    Check("thickness at twice the length", of_length, 1e-3, ISSUE + "; of the element that is farthest off"),
    Check("thickness at twice the area", of_area, 4e-6, EVEN + "; of the element that is farthest off"),
    Check("volume kept at twice the length", kept, 2e-6, EVEN + "; in the mean the waves cancel"),
    Check("width at twice the length", width, 4e-6, EVEN + ": both sides of a bar come in alike"),
    Check("force at twice the length", pull, 1e-5, EVEN + "; three of its errors add up"),
    Check("force at twice the area", pull_both_ways, 5e-6, EVEN),
    Check("height of a block on the strip", height, 1e-3, "half of the thickness; the mid-surface is held, and multipliers leave no gap"),
    Report("warnings of the strip that keeps its thickness, less those of the other", warnings, "one of them is wrong, and says so"),
    Report("no warning at a small strain", warning_below, "at a strain of 1 % nothing is wrong yet"),
]


def kinds(run):
    rows = []
    for word in ("follows_strain", "constant"):
        there = run.again({"bodies[0].element.thinning": word})
        rows.append([word, f"{1e3 * sum(thicknesses(there)) / len(thicknesses(there)):.4f}", f"{1e-3 * there.column('force')[-1]:.3f}",
                     f"{1e-3 * force(2):.3f}"])
    return rows


STUDIES = [
    Table("The strip at twice its length: mean thickness [mm], force [kN] and the exact one.", ["thinning", "thickness", "force", "exact"],
          kinds),
]

BREAKS = [
    Breaks("thickness at twice the length", "a thickness that stays", KEEPS),
    Breaks("thickness at twice the length", "sides that may not come in", {"planes[1].nodes": "[strip.y_low, strip.y_high]"}),
    Breaks("thickness at twice the area", "a thickness that stays", KEEPS),
    Breaks("volume kept at twice the length", "a thickness that stays", KEEPS),
    Breaks("volume kept at twice the length", "a bulk modulus of a hundredth", {"bodies[0].material.young": "2 GPa"}),
    Breaks("width at twice the length", "a stretch to 1.99", {"planes[3].velocity.value": '"0.099/0.06*(1 - cos(2*pi*t/0.06))"'}),
    Breaks("force at twice the length", "a thickness that stays", KEEPS),
    Breaks("force at twice the area", "a thickness that stays", KEEPS),
    Breaks("height of a block on the strip", "a thickness that stays", KEEPS),
]


def over_stretch(run):
    stretches, values = [], []
    for number in range(run.frames("body")):
        time, _ = run.frame("body", number)
        stretches.append(1 + run.at("stretch", time) / LENGTH)
        values.append(1e3 * thicknesses(run, number)[0])
    return [("plates", stretches, values)]


def exact_over_stretch(_run):
    stretches = [1 + i / 50 for i in range(1, 51)]
    return [("exact", stretches, [1e3 * thickness(s) for s in stretches])]


FIGURES = [Figure("thickness", "stretch [-]", "thickness [mm]", over_stretch, exact=exact_over_stretch,
                  caption="Thickness of the first element of the strip over its stretch.")]
