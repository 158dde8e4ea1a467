"""How close is close enough, why, and what must break."""
from defaults import NUMERICS
from reference import THICKNESS, bending, bending_energy, displacement, kept, membrane, shear_energy, shear_resultant, von_mises
from verify import Breaks, Check, Falls, Figure, Miss, Pair, Report, Table, number_in

CATALOGUE = ("E-1",)
CLAIM = ("Distorted plate triangles reproduce constant membrane strain and curvature and an affine motion; transverse shear has the "
         "stiffness that residual bending flexibility leaves, all of it where triangles are small beside the thickness.")
EVIDENCE = "exact"
DRIVER = "scene"

HERE = "verification/patch_of_plates/"
SIZE, CURVATURE = 1e-12, 1e-15  # [-] of strain and of shear, [1/m]: in the cases


def case(run, name):
    """The run of another case of this folder; in a break of that case the run itself."""
    return run if str(run.case_file).endswith(name) else run.other("scene", HERE + name)


def with_viscosity(run):
    return case(run, "moving.yaml").again(USUAL)


def norm(values):
    return sum(v * v for v in values)**0.5


def farthest(got, exact):
    return max(norm([a - b for a, b in zip(one, there)]) for one, there in zip(got, exact))


def membrane_stress(run):
    xx, yy, xy = membrane(SIZE)
    stresses = run.frame("body")[1]["stress_membrane"]
    exact = (xx, yy, 0, xy, 0, 0)
    return Pair(farthest(stresses, [exact] * len(stresses)), 0, "Pa", scale=norm(exact))


def surface_stress(run):
    exact = von_mises(*bending(CURVATURE))
    fields = case(run, "bending.yaml").frame("body")[1]
    return Pair(max(fields["von_mises_top"] + fields["von_mises_bottom"], key=lambda value: abs(value - exact)), exact, "Pa")


def membrane_of_bending(run):
    stresses = case(run, "bending.yaml").frame("body")[1]["stress_membrane"]
    return Pair(max(map(norm, stresses)), 0, "Pa", scale=norm(bending(CURVATURE)))


def stored(run, name):
    return run.account("patch")["stored"][name]["value"]


def of_shear(run):
    """Of the shear itself, and of the bending within elements that it makes."""
    return stored(run, "transverse_shear") + stored(run, "residual_bending")


def energy_of_bending(run):
    return Pair(stored(case(run, "bending.yaml"), "elastic"), bending_energy(CURVATURE), "J")


def shear_in_bending(run):
    return Pair(of_shear(case(run, "bending.yaml")), 0, "J", scale=bending_energy(CURVATURE))


def energy_of_shear(run):
    return Pair(of_shear(case(run, "shear.yaml")), kept() * shear_energy(SIZE), "J")


def whole_shear(run):
    """Beside the energy of the whole stiffness: a study sets the thickness."""
    times = number_in(run.overrides.get("bodies[0].element.thickness", THICKNESS)) / THICKNESS
    return Pair(of_shear(of_thickness(run, times)), times * shear_energy(SIZE), "J")


def force_inside(run):
    forces = [case(run, "shear.yaml").column(f"force_{n}")[-1] for n in (4, 5, 6, 7)]
    return Pair(max(forces), 0, "N", scale=0.12 * norm(shear_resultant(SIZE)))


def of_thickness(run, times):
    """The sheared patch, so many times as thick, as heavy as before."""
    return case(run, "shear.yaml").again({"bodies[0].element.thickness": f"{times * THICKNESS!r} m",
                                          "bodies[0].material.density": f"{1 / times!r} kg/m^3"})


def thicknesses(run):
    rows = []
    for times in (1, 10, 100, 1000, 10000):
        there, whole = of_thickness(run, times), times * shear_energy(SIZE)
        force = max(there.column(f"force_{n}")[-1] for n in (4, 5, 6, 7)) / (times * 0.12 * norm(shear_resultant(SIZE)))
        rows.append([f"{times * THICKNESS:g} m", f"{of_shear(there) / whole:.6f}", f"{kept(times * THICKNESS):.6f}",
                     f"{force:.1e}"])
    return rows


def frames(run):
    moving = case(run, "moving.yaml")
    return [moving.frame("body", number) for number in range(1, 11)]


def place(run):
    worst = 0
    for t, fields in frames(run):
        exact = [displacement(at, t) for at in fields["points"]]
        worst = max(worst, farthest(fields["displacement"], exact) / max(map(norm, exact)))
    return Pair(worst, 0, "", scale=1)


def unevenness(run):
    stresses = frames(run)[-1][1]["stress_membrane"]
    return Pair(farthest(stresses, [stresses[0]] * len(stresses)) / norm(stresses[0]), 0, "", scale=1)


USUAL = {f"bodies[0].element.viscosity.{term}": value for term, value in NUMERICS["viscosity"].items()}
BOUND = "the catalogue's bound; "
DEPARTURES = {
    "viscosity": "the patch in motion is exact to round-off, and viscosity takes more steps (reports); at rest it is as by default",
    "residual": "the test is to round-off, so the rest must be too"}

CHECKS = [
    Check("membrane stress", membrane_stress, 1e-12,
          BOUND + "seen is the strain of 1e-12, which is what stresses of finite strains differ by"),
    Check("stress at the surfaces in bending", surface_stress, 1e-12, BOUND + "of the element that is farthest off"),
    Check("membrane stress in bending", membrane_of_bending, 1e-12, BOUND + "over the stress at the surface"),
    Check("energy of bending", energy_of_bending, 1e-12, BOUND + "moments times curvatures"),
    Check("energy of shear in bending", shear_in_bending, 1e-12, BOUND + "an element that locks stores here"),
    Check("energy of transverse shear", energy_of_shear, 1e-12,
          BOUND + "resultant times shear times the share that each triangle keeps, of which the study has how it goes to the whole",
          evidence="order"),
    Miss("force inside in transverse shear", force_inside, 1e-12, BOUND + "over what goes through the patch",
         "triangles of unlike size keep unlike shares of their shear stiffness, which frees clamped plates from locking. The state is one "
         "of couples on all normals; a plate that is loaded by forces has moments with gradients. It falls with the square of side over "
         "thickness, to 3e-5 where the plate is 10 m thick, and is 16 % at worst, where the thickness is a side"),
    Check("place in motion", place, 1e-12, BOUND + "sums of a thousand steps"),
    Check("unevenness of the stress in motion", unevenness, 1e-10,
          "stress turns against sides of triangles to the second order of the step (docs/theory/plate.md): 1.8e-13, 1.8e-11, 4.3e-9 at "
          "stretches of 0.001, 0.01, 0.2", evidence="invariant"),
    Report("energy of transverse shear of the whole stiffness", whole_shear, "residual bending gives way, the more the thinner the plate"),
    Report("place in motion with the default viscosity", lambda run: place(with_viscosity(run)), "more steps, and as many sums"),
    Report("unevenness of the stress in motion with the default viscosity", lambda run: unevenness(with_viscosity(run)),
           "the growth of the area is one and the same, so the limiter finds no front"),
]


def ramp(text, size=SIZE):
    return f'"t < 0.02 ? ({text}) * {50 * size} * 128/35 * sin(50*pi*t)^8 : 0"'


STUDIES = [
    Falls("energy of transverse shear of the whole stiffness", "bodies[0].element.thickness", ["0.1 m", "1 m", "10 m"], order=1.9),
    Table("Constant transverse shear, by thickness: energy over that of the whole stiffness, what residual flexibility leaves of it, and "
          "the largest force inside over what goes through the patch.", ["thickness", "energy", "left", "force inside"], thicknesses),
]

BENDING, SHEAR, MOVING = HERE + "bending.yaml", HERE + "shear.yaml", HERE + "moving.yaml"
TURNED_TOO_FAR = f"[{ramp('1.001*(x/2 + y)', CURVATURE)}, {ramp('-1.001*(x + y/2)', CURVATURE)}, 0]"
BREAKS = [
    Breaks("membrane stress", "corners that do not move affinely",
           {"planes[0].velocity.value": f"[{ramp('x + y/2 + 0.01*x*y')}, {ramp('x/2 + y')}, 0]"}),
    Breaks("membrane stress", "corners that start and stop at once, come to rest to a part in a hundred thousand only",
           {"planes[0].velocity.value": '["t < 0.02 ? (x + y/2)*5e-11 : 0", "t < 0.02 ? (x/2 + y)*5e-11 : 0", "0"]',
            "relaxation.residual": 1e-5}),
    Breaks("stress at the surfaces in bending", "a thickness off by a hundredth", {"bodies[0].element.thickness": "1.01 mm"}, case=BENDING),
    Breaks("energy of bending", "turns that follow the slope to a part in a thousand only",
           {"planes[0].angular_velocity.value": TURNED_TOO_FAR}, case=BENDING),
    Breaks("energy of shear in bending", "turns that follow the slope to a part in a thousand only",
           {"planes[0].angular_velocity.value": TURNED_TOO_FAR}, case=BENDING),
    Breaks("membrane stress in bending", "corners that are pulled a little as well",
           {"planes[0].velocity.value": f"[{ramp('1e-9*x', CURVATURE)}, 0, {ramp('(x^2 + x*y + y^2)/2', CURVATURE)}]"}, case=BENDING),
    Breaks("energy of transverse shear", "Poisson's ratio forgotten in the shear modulus", {"bodies[0].material.poisson": 0}, case=SHEAR),
    Breaks("energy of transverse shear", "one node a part in a million beside the plane",
           {"planes[1].velocity.value": f"[0, 0, {ramp('1.000001*(0.3*x - 0.8*y)')}]"}, case=SHEAR),
    Breaks("place in motion", "a body force two per mille too small", {"loads[0].value": '["99.8*(x + y/2)", "99.8*(x/2 + 0.75*y)", "0"]'},
           case=MOVING),
    Breaks("unevenness of the stress in motion", "nodes inside that start from rest", {"initial[0].velocity": '["0", "0", "0"]'},
           case=MOVING),
]


def paths(run):
    """Of the four inner nodes, along x."""
    rows = frames(run)
    return [(f"node {n}", [1e3 * t for t, _ in rows], [1e3 * fields["displacement"][n][0] for _, fields in rows]) for n in (4, 5, 6, 7)]


def exact_paths(run):
    points, times = frames(run)[0][1]["points"], [t for t, _ in frames(run)]
    return [(f"node {n}, exact", [1e3 * t for t in times], [1e3 * displacement(points[n], t)[0] for t in times]) for n in (4, 5, 6, 7)]


FIGURES = [Figure("inner_nodes", "time [ms]", "displacement along x [mm]", paths, exact=exact_paths,
                  caption="The four inner nodes of the patch in an affine motion with constant acceleration.")]
