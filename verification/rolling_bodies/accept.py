"""How close is close enough, why, and what must break."""
from reference import BALL, CYLINDER, acceleration, after_sliding
from verify import Breaks, Check, Figure, Pair

CATALOGUE = ()
CLAIM = ("Rigid cylinders and balls roll and slide as the round bodies that they are, also on flat facets, a rigid plane and an elastic "
         "table: no facet gives a spin, takes a speed, or makes them hop.")
EVIDENCE = "exact"
DRIVER = "scene"

GRAVITY, SLOPE, RADIUS, THROWN = 9.81, 20, 0.1, 3.0
HERE = "verification/rolling_bodies/"
PLANE, BALL_CASE, SOFT = HERE + "on_a_plane.yaml", HERE + "ball.yaml", HERE + "on_a_soft_table.yaml"
FACETS = {"bodies[0].surface": "facets"}
ICE = {"contacts[0].friction": 0}


def case_of(case, run, change=None):
    """The run of another case; in a break of that case, the break's own."""
    return run.again({**(change or {}), **run.overrides}) if str(run.case_file).endswith(case) else run.other("scene", case, change or {})


def end_of(run):
    return run.column("time")[-1]


def rolls(run):
    """Speed of the surface over that of the centre."""
    return Pair(RADIUS * run.at("spin", end_of(run)) / run.at("speed", end_of(run)), 1, "")


def slope_of(run):
    end = end_of(run)
    return (run.at("speed", end) - run.at("speed", 0.1)) / (end - 0.1)


def runs_down(run):
    return Pair(slope_of(run), acceleration(SLOPE, CYLINDER, GRAVITY), "m/s2")


def hop(run):
    """The most by which the centre leaves its height."""
    return Pair(max(abs(z - RADIUS) for z in run.column("height")), 0, "m", scale=RADIUS)


def spin_on_ice(run):
    """The most that facets turn a body that slides: the speed of its surface over that of its centre."""
    one = run.again({**ICE, **run.overrides})
    return Pair(max(abs(w) for w in one.column("spin")) * RADIUS, 0, "m/s", scale=THROWN)


DEPARTURES = {}

CHECKS = [
    Check("speed of the surface of a cylinder that rolls over its speed", rolls, 0.001, "what users are promised; it is exact but for "
          "round-off and half a step"),
    Check("acceleration of a cylinder that rolls", runs_down, 0.001, "a constant force; friction begins half a step late"),
    Check("a cylinder that rolls stays on its height", hop, 1e-4,
          "gravity moves it by g dt^2 = 9 um in a step of 1 ms; nothing lifts it, a facet of its mesh would by 5 thousandths"),
    Check("speed of its surface over its speed on a rigid plane", lambda run: rolls(case_of(PLANE, run)), 0.001, "as on the table"),
    Check("speed of a ball once it rolls", lambda run: Pair(case_of(BALL_CASE, run).at("speed", 0.9), after_sliding(THROWN, BALL), "m/s"),
          0.001, "angular momentum about the table"),
    Check("spin of a ball on ice", lambda run: spin_on_ice(case_of(BALL_CASE, run)), 1e-9, "normals lead through the centre: round-off"),
    Check("speed of the surface over that of a ball on an elastic table", lambda run: rolls(case_of(SOFT, run)), 0.02,
          "the table gives way and rings, and its facets stay facets"),
]

BREAKS = [
    Breaks("speed of the surface of a cylinder that rolls over its speed", "the facets of its mesh", FACETS),
    Breaks("acceleration of a cylinder that rolls", "the inertia of a ring",
           {"bodies[0].mass_properties.inertia": "[0.1 kg*m^2, 0.1 kg*m^2, 0.1 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]"}),
    Breaks("a cylinder that rolls stays on its height", "the facets of its mesh", FACETS),
    Breaks("speed of its surface over its speed on a rigid plane", "the facets of its mesh", FACETS, case=PLANE),
    Breaks("speed of a ball once it rolls", "the inertia of a shell",
           {"bodies[0].mass_properties.inertia": "[0.067 kg*m^2, 0.067 kg*m^2, 0.067 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]"},
           case=BALL_CASE),
    Breaks("spin of a ball on ice", "the facets of its mesh", FACETS, case=BALL_CASE),
    Breaks("speed of the surface over that of a ball on an elastic table", "too little friction to roll before the end",
           {"contacts[0].friction": 0.05}, case=SOFT),
]


def speeds(run):
    times = run.column("time")
    return [("centre", times, run.column("speed")), ("surface", times, [RADIUS * w for w in run.column("spin")])]


def exact(run):
    times = [0, end_of(run)]
    return [("exact", times, [acceleration(SLOPE, CYLINDER, GRAVITY) * t for t in times])]


FIGURES = [Figure("speed", "time [s]", "speed [m/s]", speeds, exact, caption="A cylinder that rolls down a slope.")]
