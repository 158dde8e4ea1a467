"""How close is close enough, why, and what must break."""
from reference import OWN_CODE, STRIP, bracket
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("P-6",)
CLAIM = ("The permanent deflection of a clamped strip of plates under a uniform impulse agrees with another code's; where the strip is ten "
         "times as stiff, it lies between the two bounds for rigid, perfectly plastic strips.")
EVIDENCE = "benchmark"
DRIVER = "scene"

SPEED = 40  # [m/s]
SETTLED = 1e-3  # [s] after which plastic flow is over and the strip swings about where it will stay
SPEEDS = (20, 30, 40, 60, 80, 100)  # [m/s]
STIFF = {"bodies[0].material.young": "700 GPa"}


def at_speed(speed):
    return {"initial[0].velocity": f'["0", "0", "{speed}"]'}


def permanent(run):
    """The mean over the late, elastic swing: what is left when nothing but the swing is damped. [m]"""
    return run.mean("middle", SETTLED, run.column("time")[-1])


def inside(got, speed=SPEED):
    """The error is 1 on a bound and 0 half-way between the two."""
    low, high = bracket(speed, **STRIP)
    return Pair(got, (low + high) / 2, "m", scale=(high - low) / 2)


def stiff_between_bounds(run):
    """The speed at which the stiff strip is farthest from the middle of the bounds."""
    return max((inside(permanent(run.again({**STIFF, **at_speed(speed)})), speed) for speed in SPEEDS), key=Pair.error)


def late_plastic_work(run):
    """What flows after the mean begins, over all that flows. [-]"""
    work = run.column("energy_strip_plastic")
    at = run.at("energy_strip_plastic", SETTLED)
    return Pair((work[-1] - at) / work[-1], 0, "", scale=1)


def speeds(run):
    rows = []
    for speed in SPEEDS:
        low, high = bracket(speed, **STRIP)
        usual, stiff = run.again(at_speed(speed)), run.again({**at_speed(speed), **STIFF})
        rows.append([f"{speed}", f"{1e3 * low:.2f}", f"{1e3 * permanent(usual):.2f}", f"{1e3 * permanent(stiff):.2f}", f"{1e3 * high:.2f}",
                     f"{1e3 * max(usual.column('middle')):.2f}"])
    return rows


def meshes(run):
    rows = []
    for cells, layers in ((16, 7), (32, 3), (32, 5), (32, 7), (32, 9), (64, 7)):
        one = run.again({"bodies[0].mesh.cells_along": cells, "bodies[0].mesh.width": f"{64 / cells} mm",
                         "bodies[0].element.layers": layers})
        rows.append([f"{cells}", f"{layers}", f"{1e3 * permanent(one):.3f}", f"{1e3 * max(one.column('middle')):.3f}"])
    return rows


CHECKS = [
    Check("permanent deflection beside the catalogue's own model", lambda run: Pair(permanent(run), OWN_CODE["permanent"], "m"), 0.08,
          "a two-dimensional model of another code. It does not say how it took the permanent part, nor its Young's modulus; cells and "
          "layers move ours by 9 % (table)"),
    Check("ten times as stiff, between the bounds, the farthest of six speeds", stiff_between_bounds, 1,
          "1 is on a bound. The bounds are those of a rigid strip: the stiffer, the more they bind", full=True),
    Report("permanent deflection between the bounds", lambda run: inside(permanent(run)),
           "the bounds are those of a rigid strip; 1 is on a bound"),
    Report("plastic work after the mean begins", late_plastic_work, "the mean is over a swing that is all but elastic"),
    Report("largest deflection beside the catalogue's own model", lambda run: Pair(max(run.column("middle")), OWN_CODE["peak"], "m"),
           "of the same model; it lies above the upper bound, as the elastic part comes on top"),
]

STUDIES = [
    Table("Permanent deflection over the speed, in millimetres.",
          ["speed [m/s]", "lower bound", "permanent", "ten times as stiff", "upper bound", "largest"], speeds, full=True),
    Table("Cells along half the span, layers, and deflections in millimetres.", ["cells", "layers", "permanent", "largest"], meshes,
          full=True),
]

BESIDE = "permanent deflection beside the catalogue's own model"
STIFFER = "ten times as stiff, between the bounds, the farthest of six speeds"
BREAKS = [
    Breaks(BESIDE, "one layer: no moment is felt", {"bodies[0].element.layers": 1}),
    Breaks(BESIDE, "the yield stress of 7075-T6", {"bodies[0].material.yield": "503 MPa"}),
    Breaks(BESIDE, "ends that may slide inwards and turn: no membrane force",
           {"planes[3].kind": "constrained", "planes[3].normal": "[0, 0, 1]"}),
    Breaks(STIFFER, "half the span taken for the span", {"bodies[0].mesh.length": "128 mm"}, full=True),
    Breaks(STIFFER, "hardening as of a tangent modulus of 20 GPa", {"bodies[0].material.tangent": "20 GPa"}, full=True),
]


def middle_over_time(run):
    return [(label, [1e3 * t for t in one.column("time")], [1e3 * w for w in one.column("middle")])
            for label, one in (("as it is", run), ("ten times as stiff", run.again(STIFF)))]


def the_bracket(run):
    low, high = bracket(SPEED, **STRIP)
    return [("rigid, perfectly plastic", 1e3 * SETTLED, 1e3 * run.column("time")[-1], 1e3 * low, 1e3 * high)]


def over_speed(run):
    return [(label, SPEEDS, [1e3 * permanent(run.again({**change, **at_speed(v)})) for v in SPEEDS])
            for label, change in (("as it is", {}), ("ten times as stiff", STIFF))]


def bounds_over_speed(_):
    across = [20 + i for i in range(81)]
    return [(label, across, [1e3 * bracket(v, **STRIP)[side] for v in across]) for side, label in enumerate(("lower bound", "upper bound"))]


FIGURES = [
    Figure("middle", "time [ms]", "deflection at the middle [mm]", middle_over_time, ranges=the_bracket,
           caption="Deflection at the middle of the strip; the range is that of the permanent deflection by Jones's two yield squares"),
    Figure("speeds", "initial speed [m/s]", "permanent deflection [mm]", over_speed, exact=bounds_over_speed, error=False,
           caption="Permanent deflection over the speed, between the bounds of rigid, perfectly plastic strips", full=True),
]
