"""How close is close enough, why, and what must break."""
from math import log

from reference import HARDENING, PERFECT, STEEL, history, largest_strain, small, top
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("P-8",)
CLAIM = ("The largest strain of a ring with an initial radial velocity, its time and the permanent strain follow from the energy, for "
         "plates and for hexahedra.")
EVIDENCE = "exact"
DRIVER = "scene"

SOLID = "verification/breathing_ring/solid.yaml"
SPEED, SLOW = 50, 10  # [m/s]
HARDENS = {"bodies[0].material.tangent": "2 GPa"}
SLOWLY = {"initial[0].velocity": f'["{SLOW} * x / sqrt(x^2 + y^2)", "{SLOW} * y / sqrt(x^2 + y^2)", "0"]', "time.end": "0.6 ms"}
BOUND = "the catalogue's bound"


def strains(run):
    """[(t, e, 0)] with the logarithmic strain of the hoop from the radius, as the reference gives it."""
    radius = run.column("radius")
    return [(t, log(r / radius[0]), 0) for t, r in zip(run.column("time"), radius)]


def solid(run, change=None):
    return run.other("scene", SOLID, {**run.overrides, **(change or {})})


def stays(path):
    """The middle of the first elastic swing after the largest strain."""
    after = top(path)[0]
    return (top(path)[1] + min(e for t, e, _ in path if t > after)) / 2


def largest(run, tangent=PERFECT, speed=SPEED):
    return Pair(top(strains(run))[1], largest_strain(speed, tangent=tangent, **STEEL))


def time_of_largest(run, tangent=PERFECT, thickening=0.0):
    return Pair(top(strains(run))[0], top(history(SPEED, tangent=tangent, thickening=thickening, **STEEL))[0], "s")


def permanent(run, tangent=PERFECT):
    return Pair(stays(strains(run)), small(SPEED, tangent=tangent, **STEEL)[2])


def small_time(run):
    return Pair(top(strains(run))[0], small(SLOW, tangent=PERFECT, **STEEL)[1], "s")


def of_plate(run):
    """Over the path of a ring that keeps its thickness: the largest difference of strains, over the largest strain."""
    run = run.again({"bodies[0].element.thinning": "constant"})
    exact = history(SPEED, tangent=PERFECT, thickening=1.0, **STEEL)
    step = exact[1][0]
    off = max(abs(e - exact[round(t / step)][1]) for t, e, _ in strains(run) if round(t / step) < len(exact))
    return Pair(off / top(exact)[1], 0, scale=1)


def rings(run):
    rows = []
    for name, one, tangent in (("plates", run, PERFECT), ("plates", run.again(HARDENS), HARDENING),
                               ("plates that keep their thickness", run.again({"bodies[0].element.thinning": "constant"}), PERFECT),
                               ("hexahedra, eight points", solid(run), PERFECT), ("hexahedra, eight points", solid(run, HARDENS),
                                   HARDENING),
                               ("hexahedra, one point", solid(run, {"bodies[0].element.kind": "one_point"}), PERFECT),
                               ("plates, a cell each 10 degrees", run.again({"bodies[0].mesh.cells_around": 3}), PERFECT),
                               ("plates, ten cells long", run.again({"bodies[0].mesh.length": "300 mm", "bodies[0].mesh.cells_along": 10}),
                                PERFECT)):
        at, strain = top(strains(one))
        exact_at, exact = top(history(SPEED, tangent=tangent, **STEEL))
        rows.append([name, f"{tangent / 1e9:g}", f"{strain:.6f}", f"{100 * (strain / exact - 1):+.2f} %", f"{1e3 * at:.4f}",
                     f"{100 * (at / exact_at - 1):+.2f} %"])
    return rows


DEPARTURES = {
    "thinning": "one check is of plates that keep their thickness",
    "integration": "the claim is of both kinds of hexahedra; one check compares them"}

CHECKS = [
    Check("largest strain", largest, 0.01, BOUND),
    Check("largest strain, hardening", lambda run: largest(run.again(HARDENS), HARDENING), 0.01, BOUND),
    Check("strain that stays", permanent, 0.01, BOUND),
    Check("strain that stays, hardening", lambda run: permanent(run.again(HARDENS), HARDENING), 0.01, BOUND),
    Check("time of the largest strain", time_of_largest, 0.01, BOUND),
    Check("path of a ring that keeps its thickness", of_plate, 1e-3,
          "the exact path of what a plate is: its steps and chords are all that is left"),
    Check("largest strain at a fifth of the speed", lambda run: largest(run.again(SLOWLY), speed=SLOW), 0.01, BOUND),
    Check("its time", lambda run: small_time(run.again(SLOWLY)), 0.01,
          f"{BOUND}, with the catalogue's closed form, which is that of small strains"),
    Check("largest strain, hexahedra", lambda run: largest(solid(run)), 0.01, BOUND),
    Check("time of the largest strain, hexahedra", lambda run: time_of_largest(solid(run)), 0.01, BOUND),
    Check("strain that stays, hexahedra", lambda run: permanent(solid(run)), 0.01, BOUND),
    Check("largest strain, hexahedra, hardening", lambda run: largest(solid(run, HARDENS), HARDENING), 0.01, BOUND),
    Check("time of the largest strain, hexahedra, hardening", lambda run: time_of_largest(solid(run, HARDENS), HARDENING), 0.01, BOUND),
    Report("time of the largest strain beside the closed form of small strains",
           lambda run: Pair(time_of_largest(run).got, small(SPEED, tangent=PERFECT, **STEEL)[1], "s"),
           "the catalogue's number; it takes the radius as constant, which is 2.2 % off at this strain"),
]

STUDIES = [
    Table("Rings against the exact one of finite strain. Times in milliseconds.",
          ["ring", "tangent modulus [GPa]", "largest strain", "", "at", ""], rings, full=True),
]

BREAKS = [
    Breaks("time of the largest strain", "plates that keep their thickness", {"bodies[0].element.thinning": "constant"}),
    Breaks("largest strain", "edges that may not draw in: plane strain", {"planes[2].nodes": "[ring.bottom, ring.top]"}),
    Breaks("largest strain", "a yield stress of 285 MPa", {"bodies[0].material.yield": "285 MPa"}),
    Breaks("largest strain, hexahedra", "edges that may not draw in: plane strain", {"planes[2].nodes": "[ring.bottom, ring.top]"}),
    Breaks("time of the largest strain, hexahedra", "a density of 8000 kg/m^3", {"bodies[0].material.density": "8000 kg/m^3"}),
    Breaks("strain that stays", "a yield stress of 310 MPa", {"bodies[0].material.yield": "310 MPa"}),
    Breaks("strain that stays, hexahedra", "hardening where there is none", {"bodies[0].material.tangent": "200 MPa"}),
    Breaks("path of a ring that keeps its thickness", "edges that may not draw in: plane strain",
           {"planes[2].nodes": "[ring.bottom, ring.top]"}),
    Breaks("path of a ring that keeps its thickness", "hardening where there is none", {"bodies[0].material.tangent": "200 MPa"}),
    Breaks("largest strain, hardening", "a yield stress of 285 MPa", {"bodies[0].material.yield": "285 MPa"}, full=True),
    Breaks("strain that stays, hardening", "a yield stress of 310 MPa", {"bodies[0].material.yield": "310 MPa"}, full=True),
    Breaks("largest strain at a fifth of the speed", "a yield stress of 285 MPa", {"bodies[0].material.yield": "285 MPa"}, full=True),
    Breaks("its time", "a density of 8200 kg/m^3", {"bodies[0].material.density": "8200 kg/m^3"}, full=True),
    Breaks("largest strain, hexahedra, hardening", "a yield stress of 285 MPa", {"bodies[0].material.yield": "285 MPa"}, full=True),
    Breaks("time of the largest strain, hexahedra, hardening", "a density of 8200 kg/m^3", {"bodies[0].material.density": "8200 kg/m^3"},
           full=True),
]


def strain_over_time(run):
    return [(label, [1e3 * t for t, _, _ in path], [100 * e for _, e, _ in path])
            for label, path in (("plates", strains(run)), ("hexahedra", strains(solid(run))), ("hexahedra, hardening",
                strains(solid(run, HARDENS))))]


def exact_strain(_):
    return [(label, [1e3 * t for t, _, _ in path[::10]], [100 * e for _, e, _ in path[::10]])
            for label, path in (("exact, plates", history(SPEED, tangent=PERFECT, **STEEL)),
                                ("exact, hexahedra", history(SPEED, tangent=PERFECT, **STEEL)),
                                ("exact, hardening", history(SPEED, tangent=HARDENING, **STEEL)))]


FIGURES = [Figure("strain", "time [ms]", "strain of the hoop [%]", strain_over_time, exact=exact_strain,
                  caption="Logarithmic strain of the hoop over time, without hardening and with a tangent modulus of 2 GPa")]
