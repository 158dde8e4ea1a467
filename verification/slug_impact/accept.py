"""How close is close enough, why, and what must break."""
from math import pi

from reference import most_rise, plane_pressure, time_of_impact
from verify import Breaks, Check, Figure, Pair, Report, Table

CLAIM = ("A slug of sodium that strikes a rigid head presses on it with $\\rho(c + s v)v$ and gives it the momentum that it loses; a plate "
         "rises by less than a rigid-plastic cone.")
EVIDENCE = "exact"
CATALOGUE = ("F-10",)
DRIVER = "slug_impact"
CASE = "cases/slug_impact/rigid.yaml"
PLATE = "cases/slug_impact/plate.yaml"
BUBBLE = "cases/slug_impact/bubble.yaml"
PLUGS = "cases/plug_juncture/sodium.yaml"

SODIUM = {"density": 856, "sound_speed": 2366, "slope": 1.24, "speed": 20}  # as the cases have it
RADIUS, HEIGHT, GAP = 1, 1, 0.2   # [m]
THICKNESS, YIELD = 0.08, 300e6    # [m] [Pa] of the plate
COARSE = {"mesh.level": 1}


def turns(run):
    """Sectors as wide as one cell, or quarters, in the whole vessel."""
    return 8 * run.case("mesh.level") if run.case("model.kind") == "sector" else 4


def first_wave(run):
    return Pair(run.result("pressure_of_first_wave"), plane_pressure(**SODIUM), "Pa")


def impact(run):
    return Pair(run.result("closes_head"), time_of_impact(GAP, SODIUM["speed"]), "s")


def impulse(run):
    momentum = run.column("momentum_slug")
    return Pair(run.result("impulse_head"), turns(run) * (momentum[0] - momentum[-1]), "N*s")


def quarter(run):
    return Pair(run.again({"model.kind": "quarter"}).result("pressure_of_first_wave"), run.result("pressure_of_first_wave"), "Pa")


def created(run):
    plate = run.other(DRIVER, PLATE, COARSE)
    return Pair(max(one.created() for one in (run, plate)), 0, "", scale=1)


def rise(run):
    plate = run.other(DRIVER, PLATE, COARSE)
    energy = 0.5 * SODIUM["density"] * pi * RADIUS**2 * HEIGHT * SODIUM["speed"]**2
    return Pair(plate.result("largest_rise_head"), most_rise(energy, THICKNESS, YIELD), "m")


def rise_on_a_finer_mesh(run):
    level = run.case("mesh.level")
    plate, finer = (run.other(DRIVER, PLATE, {"mesh.level": one}) for one in (level, 2 * level))
    return Pair(plate.result("largest_rise_head"), finer.result("largest_rise_head"), "m")


def last_plate(run):
    """The momentum that the sodium loses goes through all plates of the head, but for what they keep."""
    plugs = run.other("plug_juncture", PLUGS, {"mesh.level": 1, "contact.friction": run.case("contact.friction")})
    kept = sum(plugs.result(f"momentum_plate_{i}") for i in range(1, 7))
    slug = plugs.column("momentum_slug")
    return Pair(plugs.result("impulse_plate_6") + kept, 24 * plugs.case("mesh.level") * (slug[0] - slug[-1]), "N*s")


CHECKS = [
    Check("pressure of the first wave", first_wave, 0.01, "a mean over the way of the wave; half of a cell is stopped at once"),
    Check("time of impact", impact, 0.001, "a free flight, within a step"),
    Check("impulse on the head over what the slug lost", impulse, 1e-9, "walls along the slug have no friction"),
    Check("shield plates: what they kept and handed on over what the sodium gave", last_plate, 1e-6,
          "no other force acts on them along the axis"),
    Report("created energy over that of the scene", created, "with and without a plate that yields"),
    Report("quarter over sector: pressure of the first wave", quarter, "other polygons, and cells of other shapes"),
    Report("rise of a plate over that of a rigid-plastic cone that takes all the energy", rise,
           "the wall of the vessel takes nearly half of it; the plate bends and hardens"),
    Report("rise of a plate over that on a mesh twice as fine", rise_on_a_finer_mesh, "level 2 against level 4", full=True),
]

def corners(run):
    """Slugs under a bubble with the barrier of corners, and without."""
    rows = []
    for level in (2, 3, 4):
        for label, change in (("by default", {}), ("none", {"slug.element.distortion": 0})):
            one = run.other(DRIVER, BUBBLE, {"mesh.level": level, **change})
            rows.append([f"level {level}", label, one.ending, f"{1e3 * one.column('time')[-1]:.1f}",
                         f"{1e3 * one.result('largest_rise_head'):.3f}", f"{one.result('slug_distortion_fraction'):.4f}"])
    return rows


STUDIES = [
    Table("A slug under a bubble: how it ends with the barrier of corners, and without.",
          ["mesh", "`element.distortion`", "ends as", "at [ms]", "rise of the head [mm]", "energy of the barrier over internal"], corners,
          full=True),
]

BREAKS = [
    Breaks("pressure of the first wave", "the speed of sound of water", {"slug.material.sound_speed": "1482 m/s"}),
    Breaks("time of impact", "a gap that is 1 % wider", {"gap.height": "0.202 m"}),
    Breaks("impulse on the head over what the slug lost", "friction along the wall", {"contact.friction": 0.1}),
    Breaks("shield plates: what they kept and handed on over what the sodium gave", "friction along the walls", {"contact.friction": 0.1}),
]


def pressure(run):
    area = pi * RADIUS**2
    return [("Nereid", [1e3 * t for t in run.column("time")], [-1e-6 * turns(run) * f / area for f in run.column("force_head")])]


def plane(run):
    start = time_of_impact(GAP, SODIUM["speed"])
    end, p = start + 2 * HEIGHT / SODIUM["sound_speed"], 1e-6 * plane_pressure(**SODIUM)
    last = 1e3 * run.column("time")[-1]
    return [("plane wave", [0, 1e3 * start, 1e3 * start, 1e3 * end, 1e3 * end, last], [0, 0, p, p, 0, 0])]


FIGURES = [Figure("pressure", "time [ms]", "mean pressure on the head [MPa]", pressure, plane,
                  caption="Mean pressure on a rigid head, by rows of 20 µs: the first has the momentum of half a cell.")]
