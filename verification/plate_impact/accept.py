"""How close is close enough, why, and what must break."""
from functools import cache

from reference import ALUMINIUM, Metal, Plates, mean_of_steps, mean_stress, surface_velocity
from verify import Breaks, Check, Falls, Figure, Pair, Report, Table, created, crossings, mean_over

CATALOGUE = ()
CLAIM = ("After the impact of a plate on another, in uniaxial strain, an elastic precursor of the Hugoniot elastic limit runs before the "
         "plastic wave, the free surface moves in steps, and the release overtakes and removes the plastic wave: velocities, stresses and "
         "times are those of the exact jumps.")
EVIDENCE = "exact"
DRIVER = "scene"

METAL, SPEED, FLYER, TARGET = Metal(**ALUMINIUM), 200.0, 2e-3, 5e-3  # [m/s] [m] [m]
THIN, LONG = 0.5e-3, 8e-3                                           # [m] a flyer whose release overtakes, and its target
INSIDE = 2.5e-3                                                     # [m] place of the probe
END, LOOK, LATE = 1.54e-6, 0.6e-6, 0.75e-6                           # [s] of the run; when stresses are read
BESIDE = 0.25e-3                                                    # [m] to both sides of a front is no plateau
FIRST, SECOND = (0.83e-6, 0.94e-6), (1.02e-6, 1.13e-6)              # [s] plateaus of the free surface


def by_hand(metal):
    """(place of the precursor, place of the plastic wave, states behind both) at the time LOOK."""
    plates = Plates(metal, FLYER, TARGET, SPEED)
    plates.advance(LOOK)
    return plates.fronts[-2].place, plates.fronts[-3].place, plates.states[-3], plates.states[-4]


PRECURSOR, PLASTIC, ELASTIC_STATE, PLASTIC_STATE = by_hand(METAL)
SURFACE = surface_velocity(METAL, FLYER, TARGET, SPEED, END)
STEPS = [velocity for _, velocity in SURFACE]


def cells(run, frame_time):
    """[(middle in the reference, half of the width, stress along)] of the target at a time, along the axis. [m] [m] [Pa]"""
    count = run.frames("body")
    number = min(range(count), key=lambda i: abs(run.frame("body", i)[0] - frame_time))
    fields = run.frame("body", number)[1]
    nodes, points, found = fields["connectivity"], fields["points"], []
    for i, stress in enumerate(fields["stress"]):
        places = [points[n][0] for n in nodes[8 * i:8 * i + 8]]
        if min(places) > -1e-9:
            found.append((sum(places) / 8, (max(places) - min(places)) / 2, stress[0]))
    return sorted(found)


def plateau(low, high):
    """Mean stress of the cells between two places. [Pa]"""
    def measure(run):
        inside = [stress for x, _, stress in cells(run, LOOK) if low < x < high]
        return sum(inside) / len(inside)
    return measure


def between_the_fronts(run):
    return Pair(plateau(PLASTIC + BESIDE, PRECURSOR - BESIDE)(run), -METAL.limit(), "Pa")


def behind_the_plastic(run):
    return Pair(plateau(BESIDE, PLASTIC - BESIDE)(run), PLASTIC_STATE.stress, "Pa")


def velocity_behind(run):
    late = INSIDE / 4500, INSIDE / 4500 + 0.1e-6
    return Pair(mean_over(run.column("time"), run.column("inside"), *late), PLASTIC_STATE.velocity, "m/s")


def passes(name, level, expected):
    """When a velocity passes a level for the first time."""
    return lambda run: Pair(crossings(run.column("time"), run.column(name), level, rising=True)[0], expected, "s")


def of_the_surface(span, expected):
    return lambda run: Pair(mean_over(run.column("time"), run.column("surface"), *span), expected, "m/s")


def released(run):
    """When the velocity of the free surface has fallen by half of the first step that the release of the flyer takes from it."""
    at = next(i for i, v in enumerate(STEPS) if i > 3 and v < STEPS[i - 1])
    level = 0.5 * (STEPS[at - 1] + STEPS[at])
    return Pair(crossings(run.column("time"), run.column("surface"), level, rising=False)[-1], SURFACE[at][0], "s")


def history(run):
    """The integral of the difference from the exact velocity of the free surface over that of the exact one."""
    times, got = run.column("time"), run.column("surface")
    wrong = right = 0.0
    for t0, t1, v0, v1 in zip(times, times[1:], got, got[1:]):
        exact = mean_of_steps(SURFACE, t0, t1)
        wrong, right = wrong + abs((v0 + v1) / 2 - exact) * (t1 - t0), right + exact * (t1 - t0)
    return Pair(wrong / right, 0, "", scale=1)


@cache
def exact_along(time, flyer=THIN, target=LONG):
    plates = Plates(METAL, flyer, target, SPEED)
    plates.advance(time)
    return plates.profile()


def meshed(flyer, target, cell):
    """Keys of plates of these thicknesses, of cubes. [m]"""
    mm = [1e3 * x for x in (flyer, target, cell)]
    return {"bodies[0].mesh.low": f"[{-mm[0]:g} mm, 0 mm, 0 mm]", "bodies[0].mesh.high": f"[0 mm, {mm[2]:g} mm, {mm[2]:g} mm]",
            "bodies[1].mesh.high": f"[{mm[1]:g} mm, {mm[2]:g} mm, {mm[2]:g} mm]",
            "bodies[0].mesh.cells": f"[{round(flyer / cell)}, 1, 1]", "bodies[1].mesh.cells": f"[{round(target / cell)}, 1, 1]",
            "output.history_every": f"{cell / 25e-3:g} us"}


def thin(run):
    """The run of the thin flyer."""
    return run.again({**meshed(THIN, LONG, 0.0125e-3), "time.end": "1.2 us", **run.overrides})


def stress_along(time):
    """The integral of the difference of the stress along the target from the exact one, over that of the exact one."""
    def measure(run):
        wrong = right = 0.0
        for x, half, stress in cells(thin(run), time):
            exact = mean_stress(exact_along(time), x - half, x + half)
            wrong, right = wrong + abs(stress - exact), right + abs(exact)
        return Pair(wrong / right, 0, "", scale=1)
    return measure


def crest(time):
    """The largest pressure along the axis in the target."""
    return lambda run: Pair(min(cells(thin(run), time), key=lambda row: row[2])[2], min(s.stress for _, s in exact_along(time)), "Pa")


def decay(run):
    """Rows: time, how far the plastic wave and the release have come, largest stress, exact and by cell."""
    rows = []
    for time in (0.3e-6, 0.45e-6, 0.6e-6, 0.75e-6, 0.9e-6, 1.05e-6, 1.2e-6):
        exact = [(x, s.stress) for x, s in exact_along(time) if x >= 0]
        lowest = min(stress for _, stress in exact)
        places = [x for x, stress in exact if stress < lowest + 1e3]
        rows.append([f"{1e6 * time:.2f}", f"{1e3 * min(places):.2f} to {1e3 * max(places):.2f}", f"{-lowest / 1e9:.3f}",
                     *(f"{-min(stress for *_, stress in cells(one, time)) / 1e9:.3f}" for one in
                       (thin(run), thin(run.again({"refine": 2}))))])
    return rows


def viscosity(linear, quadratic):
    return {f"bodies[{b}].element.viscosity.{term}": value for b in (0, 1) for term, value in
            (("linear", linear), ("quadratic", quadratic))}


NONE = viscosity(0, 0)


def ripple(run, span=SECOND):
    """Largest less smallest velocity of the free surface on its second plateau. [m/s]"""
    inside = [v for t, v in zip(run.column("time"), run.column("surface")) if span[0] < t < span[1]]
    return max(inside) - min(inside)


def with_viscosities(run):
    rows = []
    for name, keys in (("the default: 0.06, 1", {}), ("none", NONE), ("0.06, 0", viscosity(0.06, 0)), ("0, 1", viscosity(0, 1)),
                       ("0.12, 1", viscosity(0.12, 1)), ("0.3, 1", viscosity(0.3, 1))):
        one = run.again(keys)
        rows.append([name, f"{100 * history(one).got:.2f} %", f"{ripple(one):.3g}", f"{max(one.column('surface')) - max(STEPS):.3g}",
                     f"{100 * (between_the_fronts(one).got / -METAL.limit() - 1):+.3f} %",
                     f"{100 * (behind_the_plastic(one).got / PLASTIC_STATE.stress - 1):+.3f} %",
                     f"{100 * (one.result('viscous_share')):.2g} %"])
    return rows


HISTORY = "velocity of the free surface over time, integral over integral"
BEFORE, AFTER = ("thin flyer: stress along the target before the release overtakes, integral over integral",
                 "thin flyer: stress along the target after it has, integral over integral")

CHECKS = [
    Check("Hugoniot elastic limit: stress between the fronts", between_the_fronts, 0.005, "the stress behind a steady front is exact but "
          "for its ring, which the viscosity takes"),
    Check("stress behind the plastic wave", behind_the_plastic, 0.005, "as before it"),
    Check("velocity behind the plastic wave", velocity_behind, 0.005, "as its stress; by symmetry half of that of the flyer"),
    Check("precursor at the free surface", passes("surface", STEPS[1] / 2, SURFACE[1][0]), 0.01, "one cell of the target"),
    Check("plastic wave at half of the target", passes("inside", (ELASTIC_STATE.velocity + PLASTIC_STATE.velocity) / 2,
                                                       INSIDE / (PLASTIC / LOOK)), 0.02, "one cell of fifty"),
    Check("velocity of the free surface behind the precursor", of_the_surface(FIRST, STEPS[1]), 0.005, "as the stress between the fronts"),
    Check("velocity of the free surface behind the plastic wave", of_the_surface(SECOND, STEPS[3]), 0.005,
          "the same, after both waves have met the reflected precursor"),
    Check("release of the flyer at the free surface", released, 0.02, "the width of the fan, which is one jump in the exact solution"),
    Check(HISTORY, history, 0.025, "four steps, each three to four cells of 200 wide"),
    Check(BEFORE, stress_along(LATE), 0.1, "five fronts and fans, each some cells wide, in 150 cells that are pressed", full=True),
    Check(AFTER, stress_along(1.05e-6), 0.1, "as before"),
    Check("thin flyer: largest stress before the release overtakes", crest(LATE), 0.02,
          "what is left of the plastic wave is eleven cells long", full=True),
    Check("created energy", created, 1e-9, "two plates that meet in one plane: multipliers create nothing", evidence="invariant"),
    Report("largest velocity of the free surface over the exact one", lambda run: Pair(max(run.column("surface")), max(STEPS), "m/s"),
           "what the viscosity leaves of the ring"),
    Report("the same without viscosity", lambda run: Pair(max(run.again(NONE).column("surface")), max(STEPS), "m/s"), "the whole ring"),
]

STUDIES = [
    Falls(HISTORY, along="refine", values=[1, 2, 4], order=0.67, full=True),
    Falls(AFTER, along="refine", values=[1, 2, 4], order=0.5, full=True),
    Table("The target behind a thin flyer: time [us], places of the largest pressure [mm], largest pressure along [GPa] exact and in the "
          "cells.", ["time", "from to", "exact", "cells of 0.0125 mm", "cells of 0.00625 mm"], decay, full=True),
    Table("What viscosity does, by its coefficients: error of the velocity of the free surface, its ripple on the second plateau and its "
          "overshoot, error of the two stresses, share of all energy that it dissipates.",
          ["linear, quadratic", "history", "ripple [m/s]", "overshoot [m/s]", "between", "behind", "dissipated"], with_viscosities,
          full=True),
]


def both(key, value):
    return {f"bodies[{b}].{key}": value for b in (0, 1)}


PLASTIC_MODULUS, KINEMATIC = both("material.tangent", "20 GPa"), both("material.hardening", "kinematic")
SOFTER, HEAVIER, STIFFER = both("material.yield", "0.28 GPa"), both("material.density", "2785 kg/m^3"), both("material.poisson", 0.35)
LIGHT = {"bodies[0].material.density": "1351.5 kg/m^3"}
BREAKS = [
    Breaks("Hugoniot elastic limit: stress between the fronts", "the yield stress taken for the elastic limit",
           both("material.yield", "0.1472 GPa")),
    Breaks("Hugoniot elastic limit: stress between the fronts", "another Poisson's ratio, 0.35", STIFFER),
    Breaks("stress behind the plastic wave", "another density", HEAVIER),
    Breaks("velocity behind the plastic wave", "a flyer of half the density", LIGHT),
    Breaks("precursor at the free surface", "another density", HEAVIER),
    Breaks("plastic wave at half of the target", "another Poisson's ratio, 0.35", STIFFER),
    Breaks("velocity of the free surface behind the precursor", "a yield stress of 0.28 GPa", SOFTER),
    Breaks("velocity of the free surface behind the plastic wave", "a flyer of half the density", LIGHT),
    Breaks("release of the flyer at the free surface", "a flyer of 1.9 mm", {"bodies[0].mesh.low": "[-1.9 mm, 0 mm, 0 mm]"}),
    Breaks(HISTORY, "viscosity five times as large", viscosity(0.3, 1)),
    Breaks(BEFORE, "kinematic hardening of a metal that hardens", {**PLASTIC_MODULUS, **KINEMATIC}, full=True),
    Breaks(AFTER, "no yielding on reversal", both("material.yield", "2 GPa")),
    Breaks("thin flyer: largest stress before the release overtakes", "half as many cells", meshed(THIN, LONG, 0.025e-3), full=True),
    Breaks("created energy", "the usual penalty", {"contacts[0].method": "penalty"}),
]


def surface_over_time(run):
    return [("by default", [1e6 * t for t in run.column("time")], run.column("surface")),
            ("without viscosity", [1e6 * t for t in run.again(NONE).column("time")], run.again(NONE).column("surface"))]


def exact_surface(_):
    corners = [(1e6 * t, v) for (since, velocity), (until, _) in zip(SURFACE, [*SURFACE[1:], (END, 0)])
               for t, v in ((since, velocity), (until, velocity))]
    return [("exact", *map(list, zip(*corners)))]


def stress_curves(run):
    curves = []
    for time in (LATE, 1.05e-6):
        rows = cells(thin(run), time)
        curves.append((f"{1e6 * time:g} us", [1e3 * x for x, *_ in rows], [-stress / 1e9 for *_, stress in rows]))
    return curves


def exact_stress_curves(_):
    return [(f"exact, {1e6 * time:g} us", [1e3 * x for x, _ in exact_along(time) if x >= 0],
             [-state.stress / 1e9 for x, state in exact_along(time) if x >= 0]) for time in (LATE, 1.05e-6)]


FIGURES = [
    Figure("surface", "time after the impact [us]", "velocity of the free surface [m/s]", surface_over_time, exact_surface, error=False,
           caption="Velocity of the free surface of the target: precursor, second precursor and plastic wave, release of the flyer."),
    Figure("overtaken", "place in the target before the impact [mm]", "pressure along the axis [GPa]", stress_curves, exact_stress_curves,
           error=False, caption="A flyer of 0.5 mm: its release behind the plastic wave, and when it has removed the plastic wave."),
]
