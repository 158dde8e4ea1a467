"""How close is close enough, why, and what must break."""
from reference import energy_given, largest_of_swing, strain_along, stress_along, surface_stress, swing, towards_the_axis
from verify import Breaks, Check, Figure, Pair

CLAIM = ("Gauges show the stress and strain of one place along any direction, accelerations are those of the centre of mass, and formulas "
         "of probes give the numbers that they stand for.")
EVIDENCE = "exact"
CATALOGUE = ()
DRIVER = "scene"

HERE = "verification/gauges/"
BAR, MOTION, SPIN = HERE + "bar.yaml", HERE + "motion.yaml", HERE + "spin.yaml"
YOUNG, POISSON = 210e9, 0.3
BENT = -surface_stress(force=5, arm=47.5e-3, width=20e-3, thickness=2e-3)  # a force upwards presses the top
PULLED = 100e6
SWING = {"stiffness": 8e6, "mass": 8, "speed": 2}
RATE, RADIUS = 100, 50e-3  # [rad/s] [m] of the point that goes round
GROWTH, MASS, END = 1.6e6, 16, 10e-3  # [N/s] [kg] [s]


def of(case):
    """The run of another case of this folder; in a break of that case the run itself."""
    return lambda run: run if str(run.case_file).endswith(case.rsplit("/", maxsplit=1)[-1]) else run.other("scene", case)


def last(name, exact, unit="Pa", case=HERE + "case.yaml", scale=None):
    return lambda run: Pair(of(case)(run).column(name)[-1], exact, unit, scale=scale)


def farthest_row_of_swing(run):
    """Each row has the mean since the row before."""
    there = of(MOTION)(run)
    t, got = there.column("time"), there.column("swing_acceleration")
    pairs = [(a, swing(**SWING, first=t0, last=t1)) for a, t0, t1 in zip(got[1:], t, t[1:])]
    return Pair(*max(pairs, key=lambda pair: abs(pair[0] - pair[1])), "m/s2", scale=largest_of_swing(**SWING))


def extreme_of_swing(name, sign):
    return lambda run: Pair(of(MOTION)(run).result(f"swing_acceleration_{name}"), sign * largest_of_swing(**SWING), "m/s2")


def farthest_row_of_bar(run):
    there = of(MOTION)(run)
    t, got = there.column("time"), there.column("bar_acceleration")
    pairs = [(a, GROWTH / MASS * (t0 + t1) / 2) for a, t0, t1 in zip(got[1:], t, t[1:])]
    return Pair(*max(pairs, key=lambda pair: abs(pair[0] - pair[1])), "m/s2", scale=GROWTH / MASS * END)


def energy_of_power(run):
    there = of(MOTION)(run)
    t, power = there.column("time"), there.column("power")
    lag = 1 - 2 * there.case("output.history_every") / (3 * END)  # the force is half a row behind: the integral of c (t - h/2) c t^2 / 2m
    given = sum((a + b) / 2 * (t1 - t0) for a, b, t0, t1 in zip(power, power[1:], t, t[1:]))
    return Pair(given, lag * energy_given(GROWTH, MASS, END), "J")


def farthest_row_of_point(run):
    """Each row has the mean since the row before."""
    there = of(SPIN)(run)
    t, got = there.column("time"), there.column("at_side")
    pairs = [(a, towards_the_axis(RATE, RADIUS, t1 - t0)) for a, t0, t1 in zip(got[1:], t, t[1:])]
    return Pair(*max(pairs, key=lambda pair: abs(pair[0] - pair[1])), "m/s2")


def farthest_row_of_centre(run):
    return Pair(max(of(SPIN)(run).column("at_centre")), 0, "m/s2", scale=RATE**2 * RADIUS)


def largest_power(run):
    return Pair(of(MOTION)(run).result("power_largest"), GROWTH**2 * END**3 / (2 * MASS), "N m/s")


BEAM = ("a beam's stress on triangles of 4 mm: single ones are off by 0.4 % in surfaces_of_a_plate, and half of that stays in the mean of "
        "two, whose errors have either sign")
EVEN = "one stress in all elements; at rest to 1e-6 of all forces"

CHECKS = [
    Check("strip: stress at the top", last("top", BENT), 2e-3, BEAM),
    Check("strip: stress at the bottom", last("bottom", -BENT), 2e-3, BEAM),
    Check("strip: strain at the top", last("strain", BENT / YOUNG, "1"), 2e-3, BEAM),
    Check("strip: strain in the middle", last("strain_middle", 0, "1", scale=BENT / YOUNG), 1e-3,
          "of the strain at the top, 8e-5: elements of 5 mm are flat, and squares of their angles of 4e-4 are 2e-7 of a strain"),
    Check("strip: stress at 30 degrees", last("top_inclined", stress_along(BENT, 30)), 2e-3, BEAM),
    Check("strip: strain at 30 degrees", last("strain_inclined", strain_along(BENT, 30, YOUNG, POISSON), "1"), 2e-3, BEAM),
    Check("strip: the direction backwards and of another length", lambda run: Pair(of(HERE + "case.yaml")(run).column("other_way")[-1],
          of(HERE + "case.yaml")(run).column("top_inclined")[-1], "Pa"), 1e-12, "the same unit vector but for round-off",
          evidence="invariant"),
    Check("bar: stress along its axis", last("axial", PULLED, case=BAR), 1e-5, EVEN),
    Check("bar: stress at 45 degrees", last("inclined", stress_along(PULLED, 45), case=BAR), 1e-5, EVEN),
    Check("bar: stress across", last("across", 0, case=BAR, scale=PULLED), 1e-5, EVEN),
    Check("bar: strain at 45 degrees", last("strain_inclined", strain_along(PULLED, 45, YOUNG, POISSON), "1", BAR), 1e-5, EVEN),
    Check("bar: strain across", last("strain_across", strain_along(PULLED, 90, YOUNG, POISSON), "1", BAR), 1e-5, EVEN),
    Check("swing: acceleration, the worst row", farthest_row_of_swing, 1.5e-5,
          "by steps of 4 us the frequency is 7e-7 too high, (w dt)^2 / 24, and the phase after ten radians 7e-6"),
    Check("swing: largest acceleration", extreme_of_swing("largest", 1), 3e-6, "a step lies up to half of one beside the peak: 2e-6"),
    Check("swing: smallest acceleration", extreme_of_swing("smallest", -1), 3e-6, "as the largest"),
    Check("turning block: acceleration of a point of it, the worst row", farthest_row_of_point, 1e-10,
          "no force: the turn is exact, and the difference of two velocities has a hundredth of their digits less"),
    Check("turning block: acceleration of the whole, the worst row", farthest_row_of_centre, 1e-10, "as that of the point, over it"),
    Check("pushed bar: acceleration of its centre, the worst row", farthest_row_of_bar, 1e-10,
          "the steps take the force at their times, and a force that grows evenly has no error; waves do not move the centre"),
    Check("pushed bar: energy of the power", energy_of_power, 2e-4,
          "the rows are 0.02 ms apart on the mean and not each: they lie at the first step of 4 us behind"),
    Check("pushed bar: largest power of a step", largest_power, 3e-4,
          "the force of a step is that of its middle, half a step of 4 us of 10 ms before the velocity: 2e-4"),
    Check("pushed bar: velocity over time", last("speed_by_time", GROWTH / MASS * END / 2, "m/s2", MOTION), 1e-5,
          "the mean velocity of the nodes, with waves in the bar; that of the centre has none"),
]

BREAKS = [
    Breaks("strip: stress at the top", "the gauge half a square aside", {"probes[0].near": "[50 mm, 10 mm, 0 mm]"}),
    Breaks("strip: stress at the bottom", "the other surface", {"probes[1].place": "top"}),
    Breaks("strip: strain at the top", "the middle surface", {"probes[2].place": "middle"}),
    Breaks("strip: strain in the middle", "the upper surface", {"probes[3].place": "top"}),
    Breaks("strip: stress at 30 degrees", "the angle from the other axis", {"probes[4].along": "[0.5, 0.8660254037844387, 0]"}),
    Breaks("strip: strain at 30 degrees", "Poisson's ratio left out", {"bodies[0].material.poisson": "0"}),
    Breaks("strip: the direction backwards and of another length", "a degree off", {"probes[6].along": "[-0.8571673, -0.5150381, 0]"}),
    Breaks("bar: stress along its axis", "an axis of the scene", {"probes[0].along": "[1, 0, 0]"}, case=BAR),
    Breaks("bar: stress at 45 degrees", "the shear left out: an axis of the scene", {"probes[1].along": "[0, 1, 0]"}, case=BAR),
    Breaks("bar: stress across", "the axis", {"probes[2].along": "[2, 2, -1]"}, case=BAR),
    Breaks("bar: strain at 45 degrees", "Poisson's ratio left out", {"bodies[0].material.poisson": "0"}, case=BAR),
    Breaks("bar: strain across", "an axis of the scene", {"probes[4].along": "[0, 0, 1]"}, case=BAR),
    Breaks("swing: acceleration, the worst row", "a stiffness off by a hundredth", {"springs[0].stiffness": "8.08e6 N/m"}, case=MOTION),
    Breaks("swing: largest acceleration", "a stiffness off by a hundredth", {"springs[0].stiffness": "8.08e6 N/m"}, case=MOTION),
    Breaks("swing: smallest acceleration", "a damper", {"springs[0].damping": "100 N*s/m"}, case=MOTION),
    Breaks("turning block: acceleration of a point of it, the worst row", "a speed off by a hundredth",
           {"initial[0].velocity": '["-101*y", "101*x", "0"]'}, case=SPIN),
    Breaks("turning block: acceleration of the whole, the worst row", "a point in the place of the whole", {"probes[1].of": "block.side"},
           case=SPIN),
    Breaks("pushed bar: acceleration of its centre, the worst row", "the end that is pushed", {"probes[1].of": "bar.x_low"}, case=MOTION),
    Breaks("pushed bar: energy of the power", "half of it, as of a spring", {"probes[4].value": '"push_force * push_speed / 2"'},
           case=MOTION),
    Breaks("pushed bar: largest power of a step", "a force off by a hundredth", {"loads[0].value": '["16160*t/10e-3", "0", "0"]'},
           case=MOTION),
    Breaks("pushed bar: velocity over time", "time from the wrong start", {"probes[6].value": '"bar_speed / (t + 1e-3)"'}, case=MOTION),
]


def accelerations(run):
    there = of(MOTION)(run)
    t = [1e3 * one for one in there.column("time")][1:]
    return [(said, t, there.column(f"{name}_acceleration")[1:]) for name, said in (("swing", "mass on a spring"), ("bar", "pushed bar"))]


def exact_accelerations(run):
    t = of(MOTION)(run).column("time")
    spans = list(zip(t, t[1:]))
    times = [1e3 * one for one in t[1:]]
    return [("mean of −v ω sin ωt", times, [swing(**SWING, first=a, last=b) for a, b in spans]),
            ("mean of c t/m", times, [GROWTH / MASS * (a + b) / 2 for a, b in spans])]


FIGURES = [Figure("acceleration", "time [ms]", "acceleration [m/s²]", accelerations, exact_accelerations,
                  caption="Accelerations of a mass on a spring and of a bar under a force that grows: means between rows.")]
