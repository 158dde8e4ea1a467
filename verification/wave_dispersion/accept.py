"""How close is close enough, why, and what must break."""
from defaults import NUMERICS
from reference import speed_ratio
from verify import Breaks, Check, Figure, Pair, Report, Table, crossings

CATALOGUE = ("E-5",)
CLAIM = "The wave speed in a column of hexahedra is that of lumped masses and central differences, at any step."
EVIDENCE = "exact"
DRIVER = "scene"

LENGTH, CELLS, WAVE_SPEED = 30, 30, 1.0  # [m] [-] [m/s]
STEPS = (0.05, 0.5, 0.9, 1.0)            # shares of the stable step: Courant numbers, as the elements are cubes without Poisson effect
USUAL = {f"bodies[0].element.viscosity.{term}": value for term, value in NUMERICS["viscosity"].items()}
WAVES = {10: 3, 6: 5}                    # elements for a wave: waves in the column


def of(elements, courant, **more):
    """Keys that ask for so many elements in a wave and this share of the stable step."""
    waves = WAVES[elements]
    return {"initial[0].velocity": f'["1e-6 * cos(2*pi*{waves}*x/30)", "0", "0"]', "time.safety": courant, **more}


def ratio(run):
    """Wave speed from zero crossings of the free end, over the exact one."""
    elements = next(n for n, waves in WAVES.items() if f"pi*{waves}*" in str(run.overrides.get("initial[0].velocity", "pi*3*")))
    times = crossings(run.column("time"), run.column("end"), rising=False)
    frequency = (len(times) - 1) / (times[-1] - times[0]) if len(times) > 1 else float("nan")
    return frequency * LENGTH / WAVES[elements] / WAVE_SPEED


def speed(elements, courant, **more):
    return lambda run: Pair(ratio(run.again(of(elements, courant, **more))), speed_ratio(elements, courant), "1")


def kinds(run):
    rows = []
    for elements in WAVES:
        for courant in STEPS:
            row = [str(elements), f"{courant:g}", f"{speed_ratio(elements, courant):.5f}"]
            for kind in ("one_point", "full"):
                row.append(f"{ratio(run.again(of(elements, courant, **{'bodies[0].element.kind': kind}))):.5f}")
            rows.append(row)
    return rows


BECAUSE = ("the formula is exact; a crossing between two steps is found by a straight line, which errs by the cube of the step. The "
           "catalogue's bound is 0.1 %")
DEPARTURES = {"viscosity": "the dispersion is that of mass and stiffness alone; one check and a report have the default viscosity",
              "safety": "the step is the subject: the Courant number"}

BY_DEFAULT = "wave speed with the default viscosity, 10 elements for a wave, Courant 0.9"
CHECKS = [Check(f"wave speed, {elements} elements for a wave, Courant {courant:g}", speed(elements, courant), 5e-4 * courant**3,
                BECAUSE) for elements in WAVES for courant in STEPS]
HALF_A_STEP = ("the force of viscosity is half a step old, which acts as less mass where few elements carry a crest; it vanishes with the "
               "step")
CHECKS += [Check(BY_DEFAULT, speed(10, 0.9, **USUAL), 0.002, HALF_A_STEP + ": 0.09 % with ten elements, 0.9 % with six"),
           Report("wave speed with the default viscosity, 6 elements for a wave, Courant 0.9", speed(6, 0.9, **USUAL), HALF_A_STEP)]

STUDIES = [Table("Numerical over exact wave speed, for hexahedra of one point and of eight.",
                 ["elements for a wave", "Courant", "exact", "one point", "eight points"], kinds, full=True)]

BREAKS = [
    Breaks("wave speed, 10 elements for a wave, Courant 0.5", "a third of the elements missing", {"bodies[0].mesh.cells": "[20, 1, 1]"}),
    Breaks("wave speed, 6 elements for a wave, Courant 0.9", "a step set by a width half as large: Courant 0.45",
           {"bodies[0].mesh.cells": "[30, 2, 2]"}),
    Breaks("wave speed, 10 elements for a wave, Courant 1", "a step set by a width half as large: Courant 0.5",
           {"bodies[0].mesh.cells": "[30, 2, 2]"}),
    Breaks("wave speed, 6 elements for a wave, Courant 0.05", "viscosity that was not turned off, and far too large",
           {"bodies[0].element.viscosity.linear": 1}),
    *(Breaks(name, "a third of the elements missing", {"bodies[0].mesh.cells": "[20, 1, 1]"}, full=True)
      for name in ("wave speed, 10 elements for a wave, Courant 0.05", "wave speed, 6 elements for a wave, Courant 0.5", BY_DEFAULT)),
    *(Breaks(f"wave speed, {elements} elements for a wave, Courant {courant:g}",
             f"a step set by a width half as large: Courant {courant / 2:g}", {"bodies[0].mesh.cells": "[30, 2, 2]"}, full=True)
      for elements, courant in ((10, 0.9), (6, 1))),
]


def measured(run):
    curves = []
    for elements in WAVES:
        curves.append((f"{elements} elements", list(STEPS), [ratio(run.again(of(elements, courant))) for courant in STEPS]))
    return curves


def exact(run):
    steps = [i / 50 for i in range(51)]
    return [(f"exact, {elements} elements", steps, [speed_ratio(elements, courant) for courant in steps]) for elements in WAVES]


FIGURES = [Figure("speed", "Courant number [-]", "numerical over exact wave speed [-]", measured, exact=exact,
                  caption="Wave speed over the Courant number, with ten and with six elements for a wave.")]
