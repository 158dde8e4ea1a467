"""How close is close enough, why, and what must break."""
from reference import OWN_CODE, OWN_CODE_UNILATERAL, PUBLISHED, grid_convergence
from verify import Breaks, Check, Figure, Miss, Pair, Report, Table, created

CATALOGUE = ("I-6",)
CLAIM = "Final length and foot radius of a copper bar that hits a wall at 227 m/s agree with the code of the catalogue."
EVIDENCE = "benchmark"
DRIVER = "scene"

LENGTH, RADIUS = OWN_CODE_UNILATERAL
LEAST_STRAIN, MOST_STRAIN = OWN_CODE["10 x 50"][2], OWN_CODE["40 x 200"][2]
LEVELS = [(2, 40), (3, 60), (4, 80)]  # cells of core and ring; along. Twice the first are across the radius


def last(column, expected, unit):
    return lambda run: Pair(run.column(column)[-1], expected, unit)


def rest(run):
    """Kinetic energy that is left, over that at the start."""
    return Pair(run.column("kinetic")[-1] / run.ledger("initial_kinetic"), 0, "", scale=1)


def hourglass(run):
    """Hourglass energy over the initial kinetic energy."""
    return Pair(run.account("bar")["stored"]["hourglass"]["value"] / run.ledger("initial_kinetic"), 0, "", scale=1)


def of_level(run, level):
    cells, along = level
    return run.again({"bodies[0].mesh.cells_core": cells, "bodies[0].mesh.cells_ring": cells, "bodies[0].mesh.cells_along": along})


def with_eight_points(run, level):
    return of_level(run, level).again({"bodies[0].element.kind": "full"})


def beside_eight_points(levels):
    """Radius of the foot over that of eight points, on the mesh where they differ most."""
    def worst(run):
        radii = [(of_level(run, level).column("foot_radius")[-1], with_eight_points(run, level).column("foot_radius")[-1])
                 for level in levels]
        return Pair(*max(radii, key=lambda pair: abs(pair[0] / pair[1] - 1)), "m")
    return worst


def meshes(run):
    rows = []
    for level in LEVELS:
        one = of_level(run, level)
        rows.append([f"{2 * level[0]} across, {level[1]} along", f"{1e3 * one.column('length')[-1]:.3f}",
                     f"{1e3 * one.column('foot_radius')[-1]:.3f}", f"{one.column('plastic_strain')[-1]:.2f}",
                     f"{100 * hourglass(one).got:.3f} %", f"{1e3 * with_eight_points(run, level).column('foot_radius')[-1]:.3f}"])
    sizes = [level[0] for level in LEVELS]
    for name, factor, digits in (("length", 1e3, 3), ("foot_radius", 1e3, 3), ("plastic_strain", 1, 2)):
        coarse, middle, fine = (of_level(run, level).column(name)[-1] * factor for level in LEVELS)
        order, limit, index = grid_convergence(fine, middle, coarse, sizes[2] / sizes[1], sizes[1] / sizes[0])
        rows.append([f"extrapolated {name.replace('_', ' ')}", f"{limit:.{digits}f}", f"order {order:.2f}" if order == order
                     else "no order",
                     f"index {100 * index:.2f} %", "", ""])
    return rows


def codes(_):
    rows = [[f"own axisymmetric code, {mesh}", f"{1e3 * length:.2f}", f"{1e3 * radius:.2f}", f"{strain:.2f}"]
            for mesh, (length, radius, strain) in OWN_CODE.items()]
    rows.append(["the same, a wall that lets go", f"{1e3 * LENGTH:.2f}", f"{1e3 * RADIUS:.2f}", ""])
    span = {name: [1e3 * v if name != "plastic_strain" else v for v in limits] for name, limits in PUBLISHED.items()}
    rows.append(["published, from memory: no gate", *("{:.2f} to {:.2f}".format(*span[name]) for name in ("length", "radius",
        "plastic_strain"))])
    return rows


CHECKS = [
    Check("final length", last("length", LENGTH, "m"), 0.01, "the catalogue's bound; its own code moves by 0.3 % over three meshes"),
    Check("final radius of the foot", last("foot_radius", RADIUS, "m"), 0.04,
          "the catalogue's bound; its own code still moves by 2 % between its finest meshes"),
    Check("kinetic energy left", rest, 1e-3, "the catalogue's bound: the bar is done at 80 us"),
    Check("hourglass energy", hourglass, 4e-5,
          "its stiffness flows with the element, so what is left is elastic, a part in 10^5; the catalogue's gate is 5 %"),
    Check("created energy", created, 2e-4, "multipliers create at touches of the foot alone; coarser meshes have up to 1.7e-4"),
    Check("radius of the foot against eight points, worst of three meshes", beside_eight_points(LEVELS), 0.01,
          "hourglass stiffness that flows with the element stiffens nothing", full=True),
    Report("largest plastic strain", last("plastic_strain", MOST_STRAIN, ""),
           f"a value of one element, {LEAST_STRAIN} to {MOST_STRAIN} in the catalogue's own code from 10 x 50 on"),
]

def drawn(part):
    """Keys of a mesh whose cells at the foot are 1 - part times as tall as even ones."""
    return {"bodies[0].mesh.map": f'["x", "y", "0.0324*({1 - part:g}*(z/0.0324) + {part:g}*(z/0.0324)^2)"]'}


def corners(run):
    """Smallest corner of any element at any time; runs go on when one folds."""
    rows = []
    for name, change in (("the case", {}), ("a step of 0.7", {"time.safety": 0.7}),
                         ("no linear viscosity", {"bodies[0].element.viscosity.linear": 0}),
                         ("no quadratic viscosity", {"bodies[0].element.viscosity.quadratic": 0}),
                         ("a tenth of the hourglass stiffness", {"bodies[0].element.hourglass": 0.1}),
                         ("eight points", {"bodies[0].element.kind": "full"}), ("restitution 0", {"planes[2].restitution": 0})):
        rows.append([name])
        for mesh in ({}, drawn(0), {**drawn(0), "bodies[0].mesh.cells_along": 40}):
            one = run.again({**ON, **mesh, **change})
            corner = one.result("bar_smallest_corner")
            rows[-1] += [f"{corner:.2f}" if corner > 0 else "folds", f"{1e3 * one.column('foot_radius')[-1]:.3f}" if corner > 0 else ""]
    return rows


STUDIES = [
    Table("Three meshes, with Roache's index. Millimetres.",
          ["mesh", "length", "radius", "plastic strain", "hourglass energy", "radius with eight points"], meshes, full=True),
    Table("Smallest corner of an element over that at the start, and radius of the foot in millimetres, on three meshes: of the case, with "
          "even cells, with 40 even ones along.",
          ["", "of the case", "radius", "even", "radius", "40 even", "radius"], corners, full=True),
    Table("Other codes. Millimetres.", ["code", "length", "radius", "plastic strain"], codes),
]

COARSE = {"bodies[0].mesh.cells_core": 2, "bodies[0].mesh.cells_ring": 2, "bodies[0].mesh.cells_along": 40}
DEPARTURES = {"integration": "the radius of the foot is held against that of eight points"}

ON = {"time.corner_limit": -1000}  # softer bars fold and go on
BREAKS = [
    Breaks("final radius of the foot", "hardening forgotten", {**COARSE, **ON, "bodies[0].material.tangent": "0.01 MPa"}),
    Breaks("final radius of the foot", "ten times the hardening", {**COARSE, "bodies[0].material.tangent": "1 GPa"}),
    Breaks("final length", "a yield stress of 314 MPa, of another source", {**COARSE, **ON, "bodies[0].material.yield": "314 MPa"}),
    Breaks("radius of the foot against eight points, worst of three meshes", "springs, which do not flow",
           {"bodies[0].element.hourglass_kind": "stiffness"}, full=True),
    Breaks("kinetic energy left", "stopped early", {**COARSE, "time.end": "40 us"}),
    Breaks("hourglass energy", "hourglass springs, which do not flow", {**COARSE, "bodies[0].element.hourglass_kind": "stiffness"},
           full=True),
    Breaks("created energy", "a penalty at the longest step that a case can ask for",
           {**COARSE, "planes[2].method": "penalty", "planes[2].energy_gain_limit": 0.04}, full=True),
]


def length_over_time(run):
    return [("Nereid", [1e6 * t for t in run.column("time")], [1e3 * x for x in run.column("length")])]


def final_length(run):
    return [("another code, at the end", [0, 1e6 * run.column("time")[-1]], [1e3 * LENGTH] * 2)]


def radius_over_time(run):
    return [("Nereid", [1e6 * t for t in run.column("time")], [1e3 * x for x in run.column("foot_radius")])]


def final_radius(run):
    return [("another code, at the end", [0, 1e6 * run.column("time")[-1]], [1e3 * RADIUS] * 2)]


FIGURES = [
    Figure("length", "time [us]", "length [mm]", length_over_time, exact=final_length, error=False,
           caption="Length of the bar; the line is where another code ends, which has no curve to show."),
    Figure("radius", "time [us]", "radius of the foot [mm]", radius_over_time, exact=final_radius, error=False,
           caption="Radius of the foot, and where another code ends."),
]
