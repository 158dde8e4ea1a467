"""How close is close enough, why, and what must break."""
from reference import PAIR, ROW, speeds_after
from verify import Breaks, Check, Figure, Pair

CATALOGUE = ()
CLAIM = "Rigid balls that meet pole on pole part as masses do, and contact holds no energy when they have parted."
EVIDENCE = "exact"
DRIVER = "scene"

CHAIN = "chain.yaml"
HALF = {"contacts[0].restitution": 0.5}


def of(case, change, run):
    """The run of a case of this folder with these keys, and with those of a break."""
    if case == CHAIN:
        return run.other("scene", f"verification/rigid_balls/{case}", {**change, **run.overrides})
    return run.again({**change, **run.overrides})


def velocities(case, balls, change, restitution=1.0):
    """The largest error of all velocities. [m/s]"""
    exact = speeds_after(**balls, restitution=restitution)

    def measure(run):
        got = [of(case, change, run).column(f"speed_{i}")[-1] for i in range(1, len(exact) + 1)]
        return Pair(max(abs(a - b) for a, b in zip(got, exact)), 0, "m/s", scale=1)
    return measure


def held(case, change):
    """What contact holds at the end over the kinetic energy."""
    def measure(run):
        run = of(case, change, run)
        stored = run.column("energy_touch_restitution")[-1]
        return Pair(stored / run.ledger("kinetic"), 0, "", scale=1)
    return measure


POLES = "ten times what six blows leave; one blow leaves 3e-9 m/s"

DEPARTURES = {"restitution": "one check is of a blow that takes energy"}

CHECKS = [
    Check("two equal balls: velocities", velocities("case.yaml", PAIR, {}), 1e-6, "round-off of positions over the size of a face"),
    Check("two equal balls: energy held at the end", held("case.yaml", {}), 1e-9, "a blow gives back all but 1e-9 of what it took"),
    Check("two equal balls, restitution 0.5: velocities", velocities("case.yaml", PAIR, HALF, 0.5), 1e-6, "as with restitution 1"),
    Check("four unequal balls: velocities", velocities(CHAIN, ROW, {}), 1e-4, POLES),
    Check("four unequal balls: energy held at the end", held(CHAIN, {}), 1e-9, "as of two balls"),
]

STUDIES = []

ASIDE = {"bodies[1].move": "[20.10026 mm, 0.1 mm, 0 mm]"}
HEAVY = {"bodies[1].material.density": "8100 kg/m^3"}
LOSS = {"contacts[0].restitution": 0.99}
EARLY = {"time.end": "0.201 ms"}  # while the balls are being stopped
BREAKS = [
    Breaks("two equal balls: velocities", "the second ball a tenth of a millimetre aside", ASIDE),
    Breaks("two equal balls: velocities", "restitution 0.99", LOSS),
    Breaks("two equal balls: energy held at the end", "the run ends while the balls are being stopped", EARLY),
    Breaks("two equal balls, restitution 0.5: velocities", "a second ball that is too heavy", HEAVY),
    Breaks("four unequal balls: velocities", "a second ball that is too heavy", HEAVY),
    Breaks("four unequal balls: energy held at the end", "the run ends while the first two balls are being stopped",
           {"time.end": "0.101 ms"}),
]


# ------------------------------------------------------------------------------------------------

def over_time(run):
    other = of(CHAIN, {}, run)
    return [(f"ball {i}", [1e3 * t for t in other.column("time")], other.column(f"speed_{i}")) for i in range(1, 5)]


def at_the_end(_):
    return [(f"exact, {i}", [1.75, 2.0], [v, v]) for i, v in enumerate(speeds_after(**ROW), 1)]


FIGURES = [
    Figure("row", "time [ms]", "velocity [m/s]", over_time, exact=at_the_end, error=False,
           caption="Velocities of four balls of masses 4, 8, 2 and 10 in a row; the first strikes with 1 m/s."),
]
