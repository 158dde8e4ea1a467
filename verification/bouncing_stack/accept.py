"""How close is close enough, why, and what must break."""
from defaults import NUMERICS
from reference import GRAVITY, ONE, bounce, energy_of_stack
from verify import Breaks, Check, Figure, Pair, Report, Table

CATALOGUE = ("I-8",)
CLAIM = ("Without viscosity, blocks that bounce on a plane and on each other keep their energy, and a stiff block returns to its initial "
         "height twenty times.")
EVIDENCE = "invariant"
DRIVER = "scene"

SINGLE = "verification/bouncing_stack/one.yaml"
EXACT = bounce(**ONE)
BOUNCES = 20
LEAVES = 1e-4  # [m] a thousandth of a block
WITH_VISCOSITY = {f"bodies[{body}].element.viscosity.{key}": value for body in range(3) for key, value in NUMERICS["viscosity"].items()}

PENALTY = {f"{one}.{key}": value for one in ("contacts[0]", "contacts[1]", "planes[0]")
           for key, value in (("method", "penalty"), ("penalty", "1e8 Pa/m"))}


def total(run):
    """Kinetic energy and all stores at each row of the history, less those at the start and what the kinetic energy of an instant has too
    much, `energy_integration`. [J]"""
    stores = [values for name, values in run.columns.items() if name == "energy_kinetic" or
              name.startswith("energy_") and name.split("_")[-1] in ("elastic", "hourglass", "distortion", "penalty", "restitution",
                                                                                    "potential")]
    sums = [sum(row) - swing for row, swing in zip(zip(*stores), run.column("energy_integration"))]
    return [value - sums[0] for value in sums]


def drift(run):
    """Largest change of the total energy over what can move."""
    return Pair(max(abs(value) for value in total(run)), 0, "J", scale=energy_of_stack())


def bounces(run):
    """How often the lowest block leaves the plane."""
    up = [foot > LEAVES for foot in run.column("foot")]
    return sum(1 for a, b in zip(up, up[1:]) if b and not a)


def alone(run):
    """The single block, with the changes of a break that hold for it as well."""
    return run.other("scene", SINGLE, {key: value for key, value in run.overrides.items()
                                       if key.startswith(("bodies[0]", "planes[0]", "gravity"))})


def tops(run):
    """Times and heights of the tops, by a parabola of gravity through the highest row: [(s, m), ...]."""
    times, heights, speeds = run.column("time"), run.column("centre"), run.column("speed")
    found = []
    for i in range(1, len(times)):
        if speeds[i - 1] > 0 >= speeds[i] and heights[i] > 0.06:
            found.append((times[i - 1] + speeds[i - 1] / GRAVITY, heights[i - 1] + speeds[i - 1]**2 / (2 * GRAVITY) - 0.05))
    return found


def worst_top(run):
    """The top farthest from the height of the fall."""
    heights = [height for _, height in tops(alone(run))[:BOUNCES]]
    return Pair(max(heights, key=lambda height: abs(height - ONE["height"])), ONE["height"], "m")


def last_top(run):
    """Time of the twentieth top."""
    found = tops(alone(run))
    return Pair(found[BOUNCES - 1][0] if len(found) >= BOUNCES else float("nan"), BOUNCES * EXACT["period"], "s")


def drift_alone(run):
    return Pair(max(abs(value) for value in total(alone(run))), 0, "J", scale=ONE["mass"] * GRAVITY * ONE["height"])


def enough(run):
    """A missing bounce of the twenty, if any."""
    return Pair(max(0, BOUNCES - bounces(run)), 0, "", scale=1)


def kept(run):
    """What time integration has made for good."""
    return Pair(run.ledger("integration_kept_relative"), 0, "", scale=1)


def methods(run):
    rows = []
    for title, change in (("multipliers", {}), ("multipliers, half the step", {"time.safety": 0.45}),
                          ("penalty 1e8 Pa/m", {**PENALTY}), ("penalty 1e9 Pa/m", {**PENALTY, **{key: "1e9 Pa/m" for key in PENALTY
                                                                                             if key.endswith("penalty")}})):
        one = run.again(change)
        rows.append([title, str(one.summary["cost"]["steps"]), str(bounces(one)), f"{100 * drift(one).error():.2f} %",
                     f"{100 * kept(one).got:.2f} %", f"{100 * one.ledger('integration_swing_relative'):.1f} %"])
    return rows


DEPARTURES = {
    "integration": "in a stack of one-point elements a quarter of the energy ends in the hourglass springs after a second",
    "viscosity": "fronts of blows cross the blocks of the stack a thousand times, and each time viscosity takes some of their energy",
    "method, penalty": "the single block needs a spring of known stiffness under it, so that all its tops are equal"}

CHECKS = [
    Check("stack: drift of the total energy", drift, 0.01,
          "the catalogue's bound; the blocks are chaotic: heights of fall that differ by a micrometre give 0.08 to 0.5 %", chaotic=True),
    Check("stack: energy that time integration made for good", kept, 0.01,
          "the catalogue's bound; the blocks are chaotic: heights of fall that differ by a micrometre give 0.06 to 0.7 %", chaotic=True),
    Report("stack: drift of the total energy with the default viscosity", lambda run: drift(run.again(WITH_VISCOSITY)),
           "the stack comes to rest: fronts of blows cross blocks of eight elements a thousand times"),
    Report("stack: swing of the kinetic energy", lambda run: Pair(run.ledger("integration_swing_relative"), 0, "", scale=1),
           "undamped blocks of some elements ring at the limit of the step; it comes back, and the run warns of it"),
    Check("stack: bounces that are missing of twenty", enough, 0.5, "the lowest block leaves the plane at least twenty times"),
    Check("one block: height of the worst of twenty tops", worst_top, 0.01,
          "the block is a hundred times as stiff as the plane and takes a little to ring"),
    Check("one block: time of the twentieth top", last_top, 0.001, "as the heights: the period goes with their root"),
    Check("one block: drift of the total energy", drift_alone, 0.01, "the catalogue's bound"),
]

STUDIES = [Table("The stack by method.", ["method", "steps", "bounces", "drift", "integration, kept", "swing"], methods, full=True)]

BREAKS = [
    Breaks("stack: drift of the total energy", "a plane that gives nothing back", {"planes[0].restitution": 0}),
    Breaks("stack: energy that time integration made for good", "a step beyond the limit",
           {"time.safety": 1.103, "time.end": "0.15 s", "time.created_limit": 1e300, "time.overlap_limit": 2}),
    Breaks("stack: drift of the total energy", "viscosity that was not turned off", {"bodies[0].element.viscosity.linear": 0.06},
           full=True),
    Breaks("stack: bounces that are missing of twenty", "a floor that keeps what it catches",
           {"planes[0].kind": "floor", "planes[0].nodes": "[low.z_low]", "time.created_limit": 1e300}),
    Breaks("one block: height of the worst of twenty tops", "a block only five times stiffer than the plane",
           {"bodies[0].material.young": "1 MPa"}),
    Breaks("one block: time of the twentieth top", "a penalty three quarters as stiff",
           {"planes[0].penalty": "1.5e6 Pa/m", "time.created_limit": 1e300}),
    Breaks("one block: drift of the total energy", "ten times the viscosity, in a block only five times stiffer than the plane",
           {"bodies[0].material.young": "1 MPa", "bodies[0].element.viscosity.linear": 0.6}),
]


def heights_over_time(run):
    one = alone(run)
    return [("Nereid", one.column("time"), [1e3 * z for z in one.column("height")])]


def exact_tops(run):
    return [("height of the fall", [0, run.other("scene", SINGLE).column("time")[-1]], [1e3 * ONE["height"]] * 2)]


def stack_over_time(run):
    return [(f"{name} block", run.column("time"), [1e3 * z for z in run.column(name)]) for name in ("low", "middle", "high")]


def energy_over_time(run):
    scale = energy_of_stack()
    return [("stack", run.column("time"), [value / scale for value in total(run)])]


def no_drift(run):
    return [("conserved", [0, run.column("time")[-1]], [0, 0])]


FIGURES = [
    Figure("heights", "time [s]", "height of the block [mm]", heights_over_time, exact=exact_tops, error=False,
           caption="One block: twenty bounces."),
    Figure("stack", "time [s]", "height of the centre [mm]", stack_over_time, caption="The stack: three blocks on a plane."),
    Figure("energy", "time [s]", "drift of the energy over the initial one [-]", energy_over_time, exact=no_drift,
           caption="The stack: all energies together, less the initial ones."),
]
