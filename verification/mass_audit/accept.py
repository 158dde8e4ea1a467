"""How close is close enough, why, and what must break."""
from reference import masses, rotary_inertia
from verify import Breaks, Check, Figure, Pair, Report

CATALOGUE = ("E-6",)
CLAIM = "Single elements fall with g, weigh density times volume, and plate nodes have one positive rotary inertia about all axes."
EVIDENCE = "exact"
DRIVER = "scene"

FULL, SPINS = "verification/mass_audit/full.yaml", {"scaled": "verification/mass_audit/spin.yaml",
                                                    "physical": "verification/mass_audit/physical.yaml"}
GRAVITY = {"x": 1.0, "y": -2.0, "z": -9.81}  # [m/s2]
MASSES = masses()
MOMENT = 1e-3  # [N m] on the three nodes of a plate together


def with_body(run, body):
    """The run in which a body falls. What a break sets holds in both."""
    return run if not body.endswith("full") else \
        run.other("scene", FULL, {key: value for key, value in run.overrides.items() if not key.startswith("bodies[2]")})


def acceleration(body):
    """Along the axis where velocity over time is farthest from g, over g."""
    def measure(run):
        one = with_body(run, body)
        t = one.column("time")[-1]
        ratios = [one.column(f"{body}_{axis}")[-1] / (g * t) for axis, g in GRAVITY.items()]
        return Pair(max(ratios, key=lambda ratio: abs(ratio - 1)), 1, "1")
    return measure


def fall(run):
    """Of the body and at the time where it is farthest from g t^2/2, over what it falls to the end."""
    whole = GRAVITY["z"] * run.column("time")[-1]**2 / 2
    worst = max(abs(u - GRAVITY["z"] * t**2 / 2) for body in MASSES for one in [with_body(run, body)]
                for t, u in zip(one.column("time"), one.column(f"{body}_fall")))
    return Pair(worst, 0, "m", scale=whole)


def mass(body):
    """Momentum over velocity."""
    def measure(run):
        one = with_body(run, body)
        return Pair(one.column(f"{body}_momentum")[-1] / one.column(f"{body}_z")[-1], MASSES[body], "kg")
    return measure


def inertia(run, kind, axis):
    """Of one node: each gets a third of the moment, turns at (M/3) t/I, and three have the kinetic energy M^2 t^2/(6 I). [kg m2]"""
    spin = run.other("scene", SPINS[kind], spun(run))
    t = spin.column("time")[-1]
    return MOMENT**2 * t**2 / (6 * spin.column(f"kinetic_{kind}_{axis}")[-1])


def spun(run):
    """Changes of the plate that falls hold for the three plates that are turned."""
    return {key.replace("bodies[2]", f"bodies[{body}]"): value for key, value in run.overrides.items() if key.startswith("bodies[2]")
            for body in range(3)}


def physical(axis):
    return lambda run: Pair(inertia(run, "physical", axis), rotary_inertia(), "kg m2")


def isotropic(axis):
    return lambda run: Pair(inertia(run, "scaled", axis), inertia(run, "scaled", "z"), "kg m2")


def scaled(run):
    return Pair(inertia(run, "scaled", "z"), rotary_inertia(), "kg m2")


def not_less(run):
    """What the scaled inertia lacks to the physical one."""
    return Pair(max(0.0, rotary_inertia() - min(inertia(run, "scaled", axis) for axis in "xyz")), 0, "kg m2", scale=rotary_inertia())


ROUND_OFF = "the catalogue's bound: round-off"
DEPARTURES = {"integration": "the claim is of every kind of element", "rotary_inertia": "the claim is of both rotary inertias"}

CHECKS = [
    *(Check(f"a/g of {body}", acceleration(body), 1e-12, ROUND_OFF) for body in MASSES),
    Check("worst fall of all", fall, 1e-12, ROUND_OFF),
    *(Check(f"mass of {body}", mass(body), 1e-12, ROUND_OFF) for body in MASSES),
    *(Check(f"physical rotary inertia about {axis}", physical(axis), 1e-12, ROUND_OFF) for axis in "xyz"),
    *(Check(f"scaled rotary inertia about {axis} over that about z", isotropic(axis), 1e-12, "isotropic: round-off") for axis in "xy"),
    Check("scaled rotary inertia, where below the physical one", not_less, 1e-12, "never below: positive"),
    Report("scaled rotary inertia over the physical one", scaled,
           "so large that turning does not set the step: a side of 1 m, 10 mm thick"),
]

STANDARD = {"gravity": "[1 m/s^2, -2 m/s^2, -9.80665 m/s^2]"}
LIGHT = {f"bodies[{body}].material.density": "7800 kg/m^3" for body in range(2)}
PAINT = {"bodies[2].element.thickness": "10.1 mm"}
STIFF = {"bodies[2].material.young": "1 Pa"}
BREAKS = [
    Breaks("a/g of brick_one", "standard gravity for 9.81 m/s^2", STANDARD),
    Breaks("a/g of plate", "standard gravity for 9.81 m/s^2", STANDARD),
    Breaks("worst fall of all", "standard gravity for 9.81 m/s^2", STANDARD),
    *(Breaks(f"mass of {body}", "another steel", LIGHT) for body in MASSES if body != "plate"),
    Breaks("mass of plate", "a plate thicker by a coat of paint", PAINT),
    Breaks("physical rotary inertia about z", "a plate thicker by a coat of paint", PAINT),
    Breaks("physical rotary inertia about x", "stiffness that was not taken out", STIFF),
    Breaks("scaled rotary inertia about x over that about z", "stiffness that was not taken out", STIFF),
    *(Breaks(f"a/g of {body}", "standard gravity for 9.81 m/s^2", STANDARD, full=True) for body in ("brick_full", "skew_one", "skew_full")),
    Breaks("physical rotary inertia about y", "a plate thicker by a coat of paint", PAINT, full=True),
    Breaks("scaled rotary inertia about y over that about z", "stiffness that was not taken out", STIFF, full=True),
    Breaks("scaled rotary inertia, where below the physical one", "a plate a tenth as thick", {"bodies[2].element.thickness": "1 mm"},
           full=True),
]


def falls(run):
    t = run.column("time")
    return [(body.replace("_", ", "), [1e3 * s for s in t], [-1e3 * u for u in with_body(run, body).column(f"{body}_fall")])
            for body in ("brick_one", "skew_full", "plate")]


def exact_falls(run):
    times = [i / 100 * run.column("time")[-1] for i in range(101)]
    return [("g t^2/2", [1e3 * t for t in times], [-1e3 * GRAVITY["z"] * t**2 / 2 for t in times])]


FIGURES = [Figure("fall", "time [ms]", "fall [mm]", falls, exact=exact_falls,
                  caption="Single elements fall: what they are made of does not matter.")]
