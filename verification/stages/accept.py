"""How close is close enough, why, and what must break."""
from defaults import NUMERICS
from reference import ram_speed, released_tip, stretch, wave_speed
from verify import Breaks, Check, Figure, Pair, Report

CLAIM = ("A run with stages finds the equilibrium under a load and goes on from there: a bar that is let go swings as the exact one, and a "
         "rigid ram that was held meanwhile strikes a pressed bar as it strikes one at rest.")
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "scene"

DENSITY, YOUNG, LENGTH = 7850.0, 210e9, 1.0             # [kg/m3] [Pa] [m]
SPEED = wave_speed(DENSITY, YOUNG)                      # [m/s]
STATIC = stretch(1e6 / 0.01, LENGTH, YOUNG)             # [m]
STRUCK = "verification/stages/struck.yaml"
PRESSURE, AREA, GAP, RAM = 50e6, 4e-4, 1e-3, 1.0        # [Pa] [m2] [m] [m/s]
PRESSED = -stretch(-PRESSURE, LENGTH, YOUNG)            # [m]
MASS = DENSITY * 0.5 * AREA                             # [kg]
SETTLED = 2e-5                                          # [s] twenty cells


def stretched(run):
    """The tip where the first stage ends."""
    return Pair(run.at("tip", run.result("release_began")), STATIC, "m")


def swing(run):
    """The lowest place of the tip after it was let go."""
    return Pair(min(run.column("tip")), -STATIC, "m", scale=2 * STATIC)


def passing(run):
    """The time at which the tip passes its place without load."""
    began = run.result("release_began")
    rows = [(t, u) for t, u in zip(run.column("time"), run.column("tip")) if t >= began]
    (t0, u0), (t1, u1) = next(pair for pair in zip(rows, rows[1:]) if pair[1][1] <= 0)
    return Pair(t0 + (t1 - t0) * u0 / (u0 - u1) - began, LENGTH / SPEED, "s")


def back(run):
    """The tip after a whole period."""
    began = run.result("release_began")
    return Pair(run.at("tip", began + 4 * LENGTH / SPEED), STATIC, "m", scale=2 * STATIC)


def struck(run):
    return run if str(run.case_file).endswith(STRUCK) else run.other("scene", STRUCK, {})


def pressed(run):
    """The end of the bar where the first stage ends."""
    one = struck(run)
    return Pair(one.at("face", one.result("impact_began")), PRESSED, "m")


def held(run):
    """What the first stage leaves of the ram's place: it strikes the face where theory has it."""
    one = struck(run)
    began = one.result("impact_began")
    first = next(t for t, f in zip(one.column("time"), one.column("force")) if t > began and abs(f) > 0)
    return Pair(first - began, (GAP + PRESSED) / RAM, "s")


def slowed(run):
    """The farthest from the exact speed of the ram after the first cells."""
    one = struck(run)
    touch = one.result("impact_began") + (GAP + PRESSED) / RAM
    rows = [(t - touch, v) for t, v in zip(one.column("time"), one.column("speed")) if SETTLED < t - touch < 1.95 * LENGTH / SPEED]
    exact = [(ram_speed(t, RAM, DENSITY, SPEED, AREA, MASS), v) for t, v in rows]
    want, got = max(exact, key=lambda row: abs(row[0] - row[1]))
    return Pair(got - want, 0, "m/s", scale=RAM)


USUAL = {f"bodies[0].element.viscosity.{term}": value for term, value in NUMERICS["viscosity"].items()}

DEPARTURES = {"viscosity": "the bar that is let go is d'Alembert's, which has none; the bar that is struck is by default"}

CHECKS = [
    Check("stretched at the end of the preload", stretched, 1e-4, "the residual of the relaxation, 1e-6 of the forces of all cells"),
    Check("lowest place after the release", swing, 0.01, "of the whole swing: the mesh rounds the peak as in suddenly_pulled_bar"),
    Check("time from the release to no load", passing, 2e-4,
          "the tip goes evenly from one end to the other, so rows are joined without error; what rings about the line are some 1e-4 of it"),
    Check("after a whole period", back, 0.02, "as the lowest place, rounded twice"),
    Check("pressed at the end of the preload", pressed, 1e-4, "the same, of four times as many cells"),
    Check("time from the release of the ram to its blow", held, 1e-3, "rows of the history: half a microsecond of 1.2 ms"),
    Check("speed of the ram, the farthest", slowed, 0.005, "half a cell moves with the ram at once, as in ram_on_a_bar"),
    Report("lowest place with the default viscosity", lambda run: swing(run.again(USUAL)),
           "the viscosity takes the ringing behind the front"),
    Report("after a whole period with the default viscosity", lambda run: back(run.again(USUAL)), "the same"),
]

BREAKS = [
    Breaks("lowest place after the release", "the load stays on", {"stages[1].off": "[]"}),
    Breaks("stretched at the end of the preload", "a preload that does not come to rest", {"stages[0].relaxation.residual": 0.01}),
    Breaks("time from the release to no load", "the density of aluminium", {"bodies[0].material.density": "2700 kg/m^3"}),
    Breaks("after a whole period", "the density of aluminium", {"bodies[0].material.density": "2700 kg/m^3"}, full=True),
    Breaks("pressed at the end of the preload", "half of the load", {"loads[0].value": "25e6*min(1, t/2e-4)"}, STRUCK),
    Breaks("time from the release of the ram to its blow", "a ram that is slower by a tenth",
           {"stages[1].initial[0].velocity": "['0.9', '0', '0']"}, STRUCK),
    Breaks("speed of the ram, the farthest", "a bar of aluminium's density", {"bodies[0].material.density": "2700 kg/m^3"}, STRUCK),
]


def moved(run):
    began = run.result("release_began")
    return [("Nereid", [1e3 * (t - began) for t in run.column("time")], [1e3 * u for u in run.column("tip")])]


def exact(run):
    times = [i / 400 * 1e-3 for i in range(401)]
    return [("d'Alembert", [1e3 * t for t in times], [1e3 * released_tip(t, STATIC, LENGTH, SPEED) for t in times])]


FIGURES = [Figure("tip", "time since the release [ms]", "displacement of the tip [mm]", moved, exact,
                  caption="The tip of a bar that is pulled to rest and then let go.")]
