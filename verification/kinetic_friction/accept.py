"""How close is close enough, why, and what must break."""
from reference import coefficient, pulled, stop
from verify import Breaks, Check, Figure, Pair, crossings

CATALOGUE = ("C-5",)
CLAIM = ("Friction holds by its static coefficient, slides by one that falls to the kinetic one with the speed, and heats by what it "
         "takes, on rigid planes and on bodies.")
EVIDENCE = "exact"
DRIVER = "scene"

LAW = dict(static=0.4, kinetic=0.2, decay=1)
TIME, WAY = stop(5, **LAW, gravity=9.81)
MASS, PULL = 16, 5   # [kg], [m/s3]
WEAKER = dict(static=0.4, kinetic=0.2, decay=5)
SLIP, SPEED, HEAT = pulled(PULL, 1.2, **WEAKER, gravity=9.81)
PENALTY = {"planes[0].method": "penalty"}
PULLED = "verification/kinetic_friction/pulled.yaml"


def stop_time(run):
    return Pair((crossings(run.column("time"), run.column("speed"), rising=False) or [float("nan")])[0], TIME, "s")


def way(run):
    return Pair(run.column("way")[-1], WAY, "m")


def ratio(run):
    """Largest difference of friction over push from the coefficient at the speed, while it slides."""
    rows = zip(run.column("time"), run.column("speed"), run.column("friction"), run.column("normal_force"))
    return Pair(max(abs(-f / n - coefficient(v, **LAW)) for t, v, f, n in rows if 0.01 < t < 0.95 * TIME), 0, "", LAW["static"])


def heat(run):
    return Pair(run.account("ground")["dissipated"]["friction"]["value"], run.ledger("initial_kinetic"), "J")


def pull(run, change=None):
    """The block that is pulled: a break's own run, or another case of this one."""
    return run.again(change or {}) if str(run.case_file).endswith(PULLED) else run.other("scene", PULLED, change)


def held(change=None):
    """Largest friction before the block slides, over what the static coefficient allows."""
    return lambda run: Pair(-pull(run, change).result("friction_smallest"), WEAKER["static"] * MASS * 9.81, "N")


def slips(run):
    """When it has 0.1 m/s: later than it lets go by as much as the closed form has it."""
    late = next(SLIP + 1e-4 * i for i in range(1, 10000)
                if pulled(PULL, SLIP + 1e-4 * i, **WEAKER, gravity=9.81, parts=100)[1] > 0.1)
    one = pull(run)
    return Pair(next(t for t, v in zip(one.column("time"), one.column("speed")) if v > 0.1), late, "s")


def last_speed(run, change=None):
    return Pair(pull(run, change).column("speed")[-1], SPEED, "m/s")


SUDDEN = dict(WEAKER, decay=1e12)
AT_ITS_FOOT = {"loads[0].value": '["z < 0.05 ? 10*t : 0", "0", "0"]', "contacts[0].friction_decay": "1e12 s/m"}


def suddenly(run):
    """The block pulled at its lower nodes, half its mass: no moment, so all of them reach their limit at once. The law of `run` counts."""
    law = {key.replace("planes", "contacts"): value for key, value in run.overrides.items() if "friction" in key}
    return pull(run, {**AT_ITS_FOOT, **law})


def sudden_hold(run):
    return Pair(-suddenly(run).result("friction_smallest"), SUDDEN["static"] * MASS * 9.81, "N")


def sudden_speed(run):
    return Pair(suddenly(run).column("speed")[-1], pulled(PULL, 1.2, **SUDDEN, gravity=9.81)[1], "m/s")


def heat_of_pulled(run):
    return Pair(pull(run).account("touch")["dissipated"]["friction"]["value"], MASS * HEAT, "J")


DEPARTURES = {"method": "two checks are of the same law by a penalty; all others are by default"}

CHECKS = [
    Check("time to stop", stop_time, 2e-3,
          "friction shears the block by 4 um, and it swings by that at 170 Hz: 4e-3 m/s of 5, which is 0.05 % of the time"),
    Check("way", way, 2e-3, "as the time"),
    Check("friction over push, from the law", ratio, 3e-3,
          "the coefficient is that of the sole, which swings against the block by some 3e-3 m/s, and falls by 0.2 for 1 m/s"),
    Check("heat of friction", heat, 1e-4, "what the block keeps as vibration: the square of 4e-3 over 5, 1e-6"),
    Check("pulled: largest friction before it slides", held(), 2e-3, "rear nodes let go a little before front ones do"),
    Check("pulled: time at which it slides", slips, 2e-3, "as the largest friction"),
    Check("pulled: speed at the end", last_speed, 2e-3, "the swing of the block, as it lets go, of 1e-3 m/s"),
    Check("pulled: heat of friction", heat_of_pulled, 3e-3, "as the speed, and it goes with the way: twice as much"),
    Check("by a penalty: way", lambda run: way(run.again(PENALTY)), 2e-3, "the same law; a stick yields by micrometres"),
    Check("by a penalty, pulled: speed at the end", lambda run: last_speed(run, {"contacts[0].method": "penalty"}), 3e-3,
          "as by multipliers; nodes let go one after another, as their sticks yield"),
    Check("a sudden decay: largest friction", sudden_hold, 5e-3, "statics; what iterations leave of a stick's slip rate is no sliding"),
    Check("a sudden decay: speed at the end", sudden_speed, 5e-3, "as the largest friction"),
]

SLOWER = {"contacts[0].friction_decay": "4.9 s/m"}
BREAKS = [
    Breaks("time to stop", "the static coefficient throughout", {"planes[0].kinetic_friction": 0.4}),
    Breaks("way", "a decay of half", {"planes[0].friction_decay": "0.5 s/m"}),
    Breaks("friction over push, from the law", "a decay of half", {"planes[0].friction_decay": "0.5 s/m"}),
    Breaks("heat of friction", "stopped while it slides", {"time.end": "2 s"}),
    Breaks("pulled: largest friction before it slides", "a static coefficient of 0.398", {"contacts[0].friction": 0.398}, PULLED),
    Breaks("pulled: time at which it slides", "a static coefficient of 0.398", {"contacts[0].friction": 0.398}, PULLED),
    Breaks("pulled: speed at the end", "a decay of 4.9 s/m", SLOWER, PULLED),
    Breaks("pulled: heat of friction", "a kinetic coefficient of 0.205", {"contacts[0].kinetic_friction": 0.205}, PULLED),
    Breaks("by a penalty: way", "a decay of half", {"planes[0].friction_decay": "0.5 s/m"}),
    Breaks("by a penalty, pulled: speed at the end", "a decay of 4.8 s/m", {"contacts[0].friction_decay": "4.8 s/m"}, PULLED),
    Breaks("a sudden decay: largest friction", "a static coefficient of 0.3", {"planes[0].friction": 0.3}),
    Breaks("a sudden decay: speed at the end", "a slow decay", {"planes[0].friction_decay": "5 s/m"}),
]


def speed_over_time(run):
    return [("slides to rest", run.column("time"), run.column("speed")), ("pulled", pull(run).column("time"), pull(run).column("speed"))]


def exact_speed(_):
    times = [SLIP + (1.2 - SLIP) * i / 60 for i in range(61)]
    slides = [5 * i / 60 for i in range(60, -1, -1)]
    return [("exact", [TIME - stop(v, **LAW, gravity=9.81)[0] if v > 0 else TIME for v in slides], slides),
            ("exact, pulled", times, [pulled(PULL, t, **WEAKER, gravity=9.81, parts=400)[1] if t > SLIP else 0 for t in times])]


FIGURES = [Figure("speed", "time [s]", "speed [m/s]", speed_over_time, exact=exact_speed, error=False,
                  caption="Speed of a block that slides to rest, and of one that is pulled until it slides.")]
