"""How close is close enough, why, and what must break."""
from math import atan2, degrees, pi

from reference import period
from verify import Breaks, Check, Figure, Pair, crossings

CATALOGUE = ()
CLAIM = ("A ball swings in a tube for twenty periods as a pendulum does, with and without friction, and a shaft keeps its spin in a tube: "
         "rigid bodies in each other touch as round bodies.")
EVIDENCE = "exact"
DRIVER = "scene"

GRAVITY, BORE, BALL, AMPLITUDE, SWINGS, OFFSET = 9.81, 0.06, 0.01, pi / 6, 20, 0.01
INERTIA = 2 / 5
HERE = "verification/bodies_in_bores/"
SWING = HERE + "swing.yaml"
ROLLS = {"contacts[0].friction": 0.8, "bodies[0].mass_properties.mass": "0.03 kg", "bodies[0].mass_properties.inertia":
         "[1.2e-6 kg*m^2, 1.2e-6 kg*m^2, 1.2e-6 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]", "time.end": "11 s"}
FACETS = {"bodies[0].surface": "facets", "bodies[1].surface": "facets", "contacts[0].initial_penetration": "accept"}


def swings(run, change=None):
    if str(run.case_file).endswith(SWING):
        return run.again({**(change or {}), **run.overrides})
    return run.other("scene", SWING, change or {})


def angles(run):
    return [degrees(atan2(x, -z)) for x, z in zip(run.column("x"), run.column("height"))]


def last_amplitude(run):
    """The largest angle in the last of the swings."""
    times, all_angles = run.column("time"), angles(run)
    end, one = times[-1], period(AMPLITUDE, BORE - BALL, GRAVITY)
    return Pair(max(a for t, a in zip(times, all_angles) if t > end - 1.2 * one), degrees(AMPLITUDE), "degrees")


def mean_period(run, k=0):
    ups = crossings(run.column("time"), angles(run), 0)[::2]  # it passes the lowest place twice in a period
    return Pair((ups[-1] - ups[0]) / (len(ups) - 1), period(AMPLITUDE, BORE - BALL, GRAVITY, k), "s")


def keeps_spin(run):
    """Spin at the end over that at the start."""
    spin = run.column("spin")
    return Pair(spin[-1] / spin[0], 1, "")


DEPARTURES = {}

CHECKS = [
    Check("amplitude of a ball without friction after 20 periods", lambda run: last_amplitude(swings(run)), 2.5e-5,
          "a row of the history is up to 0.5 ms from the largest angle: 2.4e-5 of it"),
    Check("period of a ball without friction", lambda run: mean_period(swings(run)), 4e-6,
          "central differences with 900 steps a period make it shorter by 2e-6: twice that"),
    Check("amplitude of a ball that rolls after 20 periods", lambda run: last_amplitude(swings(run, ROLLS)), 2.5e-5,
          "1.7e-5 by the rows, and iterations of friction end at 1e-6 of what it does"),
    Check("period of a ball that rolls", lambda run: mean_period(swings(run, ROLLS), INERTIA), 1e-5,
          "1.4e-6 by the steps, and iterations of friction end at 1e-6 of what it does, in each of them"),
    Check("spin of a shaft in a tube", keeps_spin, 1e-9, "without friction nothing turns it but round-off"),
]

BREAKS = [
    Breaks("amplitude of a ball without friction after 20 periods", "the facets of both meshes", FACETS, case=SWING),
    Breaks("period of a ball without friction", "friction with which it rolls", {"contacts[0].friction": 0.8}, case=SWING),
    Breaks("amplitude of a ball that rolls after 20 periods", "the facets of both meshes", FACETS, case=SWING),
    Breaks("period of a ball that rolls", "too little friction to roll", {"contacts[0].friction": 0.02}, case=SWING),
    Breaks("spin of a shaft in a tube", "the facets of both meshes", FACETS),
]


def swing(run):
    one = swings(run)
    return [("without friction", one.column("time"), angles(one))]


def envelope(run):
    end = swings(run).column("time")[-1]
    return [("amplitude", [0, end], [degrees(AMPLITUDE)] * 2)]


FIGURES = [Figure("angle", "time [s]", "angle [degrees]", swing, envelope, error=False, caption="A ball that swings in a tube.")]
