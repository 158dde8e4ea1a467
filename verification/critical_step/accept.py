"""How close is close enough, why, and what must break."""
import math
from math import pi, sqrt

from defaults import NUMERICS
from reference import flanagan_belytschko, growth, highest_frequency, lame
from verify import Breaks, Check, Figure, Pair, Report, Table, Waiver

CATALOGUE = ("E-4",)
CLAIM = ("The highest frequency of a free brick is that of the closed form; at 0.99 of an assembly's exact step a run is stable, at "
         "1.02 its amplitude grows at the rate of central differences.")
EVIDENCE = "exact"
DRIVER = "modes"

STEEL = {"young": 210e9, "density": 7850}
SHAPES = [(0.1, 0.1, 0.1), (0.1, 0.1, 0.4), (0.1, 0.3, 0.3), (0.05, 0.1, 0.3)]  # [m]
POISSON = (0.3, 0.42, 0.49)
BALL, BALL_MODES = "verification/critical_step/ball.yaml", "verification/critical_step/ball_modes.yaml"
INVISCID = {"bodies[0].element.viscosity.linear": 0, "bodies[0].element.viscosity.quadratic": 0}
WITH_VISCOSITY = {f"bodies[0].element.viscosity.{key}": value for key, value in NUMERICS["viscosity"].items()}
GROWING = 80  # steps beyond the limit: amplitudes grow 1e14 times


def brick(shape, poisson, kind):
    return {"bodies[0].mesh.high": "[{} m, {} m, {} m]".format(*shape), "bodies[0].material.poisson": poisson,
            "bodies[0].element.kind": kind}


def exact(shape, poisson):
    return highest_frequency(shape, poisson=poisson, **STEEL) / (2 * pi)


def worst_brick(kind):
    """The brick that is farthest off, of all shapes and Poisson's ratios."""
    def measure(run):
        pairs = [Pair(run.again(brick(shape, nu, kind)).result("highest_frequency_1"), exact(shape, nu), "Hz")
                 for shape in SHAPES for nu in POISSON]
        return max(pairs, key=Pair.error)
    return measure


def vote(run):
    """Of a cube: the elements' own bound is the exact step there."""
    return Pair(run.result("voted_step"), 2 / (2 * pi * exact(SHAPES[0], run.case("bodies[0].material.poisson"))), "s")


def vote_without_viscosity(run):
    return vote(run.again({**INVISCID, **run.overrides}))


def votes(run):
    """The largest vote over its exact step, both without viscosity: above 1 a run may be unstable."""
    ratios = [there.result("voted_step") / there.result("exact_step")
              for there in (run.again({**INVISCID, **brick(shape, nu, kind)})
                            for shape in SHAPES for nu in POISSON for kind in ("one_point", "full"))]
    return Pair(max(ratios), 1)


def rigid(run):
    return Pair(run.result("without_stiffness"), 6)


def ratio(run):
    """Exact step of the ball over what its elements vote for."""
    modes = run.other("modes", BALL_MODES, bodies(run))
    return modes.result("exact_step") / modes.result("voted_step")


def bodies(run):
    """What a break has set of the element and its material, for the ball as well."""
    return {key: value for key, value in run.overrides.items() if key.startswith("bodies") and "mesh" not in key}


def ball_at(run, part, steps):
    """A run of the ball with steps of `part` times its exact one; `time.safety` of the case is a factor on that, for a break."""
    part *= float(run.overrides.get("time.safety", 1))
    modes = run.other("modes", BALL_MODES, bodies(run))
    return run.other("scene", BALL, {**bodies(run), "time.safety": repr(part * ratio(run)),
                                     "time.end": f"{part * modes.result('exact_step') * (steps - 0.5)!r} s"})


def stays(run):
    """Largest kinetic energy over that at the start, at 0.99. A mode keeps v^2 + omega^2 (1 - (omega dt/2)^2) x^2, and x is zero at the
    start."""
    energy = ball_at(run, 0.99, 4000).column("kinetic")
    return Pair(max(energy) / energy[0], 1)


def grows(run):
    """Amplitude over that of a step before, in steps 41 to 50: the highest mode has left all others behind, and strains are still tiny."""
    energy = ball_at(run, 1.02, GROWING).column("kinetic")
    return Pair((energy[50] / energy[40])**(1 / 20), growth(1.02))


def assembly(run):
    return Pair(ratio(run), 1)


def steps_of_cubes(run):
    rows = []
    for nu in POISSON:
        lam, mu = lame(STEEL["young"], nu)
        unit = SHAPES[0][0] / sqrt((lam + 2 * mu) / STEEL["density"])
        there = [run.again(brick(SHAPES[0], nu, kind)).result("exact_step") / unit for kind in ("one_point", "full")]
        rows.append([nu, *(f"{step:.4f}" for step in there), f"{1 / (pi * exact(SHAPES[0], nu)) / unit:.4f}",
                     f"{flanagan_belytschko(nu):.4f}"])
    return rows


def histories(run):
    curves = []
    for part, steps in ((0.99, 400), (1.02, GROWING)):
        energy = ball_at(run, part, 4000 if part < 1 else steps).column("kinetic")[:steps]
        curves.append((f"{part} of the exact step", list(range(1, len(energy) + 1)), [max(e / energy[0], 1e-30) for e in energy]))
    return curves


DEPARTURES = {
    "viscosity": "the exact step and the growth do not include it; frequencies of bricks do not depend on it",
    "integration": "the claim is of both kinds of hexahedra",
    "safety": "the step is the subject: 0.99 and 1.02 of the exact one",
    "created_limit": "a run beyond its stable step would be stopped before its growth can be measured"}

CHECKS = [
    Check("highest frequency of bricks of one point: worst of 12", worst_brick("one_point"), 1e-10,
          "the catalogue's bound; stiffness by differences leaves 1e-13"),
    Check("highest frequency of bricks of eight points: worst of 12", worst_brick("full"), 1e-10, "the catalogue's bound"),
    Check("step that a cube votes for", vote_without_viscosity, 1e-10, "its bound is exact for a cube"),
    Report("step that a cube votes for, with the default viscosity", vote,
           "the vote is that of all of the viscosity, also where the limiter leaves little of it: 0.92 of the elastic step"),
    Check("rigid motions of a brick", rigid, 0, "three shifts and three turns"),
    Check("kinetic energy at 0.99, largest of 4000 steps over the first", stays, 1e-6,
          "no mode may have more than it started with, and it starts without strain"),
    Check("growth per step at 1.02", grows, 1e-6, "the root of the characteristic equation; other modes have 1e-11 of the energy by then"),
    Report("largest vote over the exact step, free bricks", votes, "a vote above 1 would be unstable"),
    Report("exact step of the ball over the vote of its elements", assembly, "what the elements' bounds give away in this mesh"),
]

STUDIES = [Table("Step of a free cube [h/c]: from the stiffness, in closed form, and by the bound of Flanagan and Belytschko.",
                 ["nu", "one point", "eight points", "closed form", "bound"], steps_of_cubes)]

WAIVERS = [
    Waiver("created energy of any source at any time", lambda run: float(run.overrides.get("time.safety", 0)) > 2,
           "steps beyond the stable one are meant to create energy, without bound", up_to=math.inf),
]

BREAKS = [
    Breaks("highest frequency of bricks of one point: worst of 12", "half of the mass on the nodes",
           {"bodies[0].material.density": "3925 kg/m^3"}),
    Breaks("step that a cube votes for", "a viscous vote taken for the elastic one", WITH_VISCOSITY),
    Breaks("kinetic energy at 0.99, largest of 4000 steps over the first", "steps 3 % too long", {"time.safety": 1.03}),
    Breaks("growth per step at 1.02", "steps 1 % too long", {"time.safety": 1.01}),
    Breaks("highest frequency of bricks of eight points: worst of 12", "half of the mass on the nodes",
           {"bodies[0].material.density": "3925 kg/m^3"}, full=True),
    Breaks("rigid motions of a brick", "a face that is held", {"planes": "[{name: hold, kind: fixed, nodes: [brick.x_low]}]"}, full=True),
]

FIGURES = [Figure("growth", "step [-]", "kinetic energy over that of the start [-]", histories, log=True, error=False,
                  caption="Kinetic energy of the ball, step by step, at 0.99 and at 1.02 of its exact step.")]
