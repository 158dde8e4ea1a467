"""How close is close enough, why, and what must break."""
from reference import reference
from verify import Breaks, Check, Figure, Pair, Table, created, crossings, interpolate

CATALOGUE = ("C-5",)
CLAIM = "A block with 5 m/s on a level plane with friction 0.3 stops after 4.247 m and 1.699 s, and friction dissipates its energy."
EVIDENCE = "exact"
DRIVER = "scene"

EXACT = reference(speed=5, friction=0.3, gravity=9.81)
LEFT = 0.01  # [-] of the speed, where the time to stop is read
WEIGHT = 0.4 * 0.4 * 0.1 * 1000 * 9.81  # [N]


def stop_time(run):
    """Where the line from the start leads through the time at which a hundredth of the speed is left: the last row with a speed is known
    to rows of the history only, and the block springs back a little."""
    left = crossings(run.column("time"), run.column("speed"), level=LEFT * run.column("speed")[0], rising=False)
    return Pair((left or [float("nan")])[0] / (1 - LEFT), EXACT["time"], "s")


def distance(run):
    return Pair(run.column("way")[-1], EXACT["distance"], "m")


def heat(run):
    return Pair(run.account("ground")["dissipated"]["friction"]["value"], run.ledger("initial_kinetic"), "J")


def half_way(run):
    """At half the time three quarters of the way are done: the deceleration is constant."""
    return Pair(interpolate(run.column("time"), run.column("way"), EXACT["time"] / 2), 0.75 * EXACT["distance"], "m")


def drift(run):
    """Way in the last 0.2 s: it stands."""
    return Pair(run.column("way")[-1] - run.at("way", run.column("time")[-1] - 0.2), 0, "m", scale=0.1)


def ratio(run):
    """Mean friction over mean push while it slides."""
    first, last = 0.1, 1.6
    return Pair(-run.mean("friction", first, last) / run.mean("normal_force", first, last), 0.3)


CHECKS = [
    Check("distance", distance, 0.01, "the catalogue's bound; the stick is elastic, the block too"),
    Check("time to stop", stop_time, 0.01, "the catalogue's bound"),
    Check("way at half the time", half_way, 0.01, "as the distance"),
    Check("heat of friction", heat, 2e-6,
          "the block keeps what it trembles with: a thousandth of the speed is left of it, whose energy is the square"),
    Check("friction over push", ratio, 1e-9, "Coulomb's law holds at every node while it slides: round-off"),
    Check("creep after the stop", drift, 1e-4, "in heights of the block; a stick holds and only the block trembles"),
    Check("created energy", created, 1e-9, "multipliers create nothing on a block that stays on its plane: round-off of many steps"),
]

# the plane that keeps the way straight becomes a wall far away
FREE = {"planes[1].kind": "rigid", "planes[1].surface": "block.y_high", "planes[1].point": "[0 m, 9 m, 0 m]",
        "planes[1].normal": "[0, -1, 0]"}


def options(run):
    rows = []
    variants = [("as it is", {}), ("free to turn about the vertical", FREE),
                ("by a penalty, stick 0.1", {"planes[0].method": "penalty", "planes[0].tangential_penalty": 0.1}),
                ("penalty 1e7 Pa/m", {"planes[0].method": "penalty", "planes[0].penalty": "1e7 Pa/m"})]
    for name, change in variants:
        one = run.again(change)
        rows.append([name, f"{distance(one).got:.5f}", f"{stop_time(one).got:.5f}", f"{heat(one).got:.3f}"])
    rows.append(["exact", f"{EXACT['distance']:.5f}", f"{EXACT['time']:.5f}", "200"])
    return rows


def lift_off(run):
    """(time of the first frame in which nodes of the lower face are above the plane, the most of them in a frame)."""
    first, most, lower = None, 0, None
    for number in range(run.frames("body")):
        time, fields = run.frame("body", number)
        lower = lower or [i for i, point in enumerate(fields["points"]) if abs(point[2]) < 1e-9]
        above = sum(fields["displacement"][i][2] > 1e-12 for i in lower)
        if above and first is None:
            first = time
        most = max(most, above)
    return first, most, len(lower)


def rocking(run):
    rows = []
    for name, change in (("as it is", {}), ("8 x 8 x 1 cells", EIGHT), ("16 x 16 x 1 cells", {"bodies[0].mesh.cells": "[16, 16, 1]"}),
                         ("8 x 8 x 2 cells", {"bodies[0].mesh.cells": "[8, 8, 2]"}),
                         ("8 x 8 x 1, of eight points", {**EIGHT, "bodies[0].element.kind": "full"}),
                         ("8 x 8 x 1, half the step", {**EIGHT, "time.safety": 0.45}),
                         ("8 x 8 x 1, by a penalty", {**EIGHT, "planes[0].method": "penalty"}),
                         ("8 x 8 x 1, restitution 0", {**EIGHT, "planes[0].restitution": 0}),
                         ("16 x 16 x 1, restitution 0", {"bodies[0].mesh.cells": "[16, 16, 1]", "planes[0].restitution": 0}),
                         ("8 x 8 x 1, linear viscosity 0.2", {**EIGHT, "bodies[0].element.viscosity.linear": 0.2}),
                         ("8 x 8 x 1, friction 0.1", {**EIGHT, "planes[0].friction": 0.1}),
                         ("8 x 8 x 1, no friction", {**EIGHT, "planes[0].friction": 0})):
        one = run.again({**change, "output.frames_every": "5 ms", "output.precision": "double"})
        first, most, nodes = lift_off(one)
        push = one.column("normal_force")[1:]
        stops = one.case("planes[0].friction") == 0.3
        rows.append([name, "never" if first is None else f"{first:.3f}", f"{most} of {nodes}", f"{min(push) / WEIGHT:.2f}",
                     f"{max(push) / WEIGHT:.2f}", *(f"{100 * of(one).error():.2g} %" if stops else "" for of in (distance, stop_time))])
    return rows


EIGHT = {"bodies[0].mesh.cells": "[8, 8, 1]"}

STUDIES = [
    Table("Distance in metres, time in seconds, heat in joules.", ["", "distance", "time", "heat"], options),
    Table("When a node first lifts off the plane [s], the most of them in a frame, the least and the largest push over the weight, and "
          "errors.", ["", "lifts off", "at most", "least push", "largest push", "distance", "time to stop"], rocking, full=True),
]

BREAKS = [
    Breaks("distance", "gravity of 9.0 m/s2", {"gravity": "[0 m/s^2, 0 m/s^2, -9.0 m/s^2]"}),
    Breaks("time to stop", "a coefficient of 0.31", {"planes[0].friction": 0.31}),
    Breaks("distance", "a stick ten thousand times too soft", {"planes[0].method": "penalty", "planes[0].penalty": "1e8 Pa/m",
                                                               "planes[0].tangential_penalty": 1e-4}),
    Breaks("creep after the stop", "looked at before the stop", {"time.end": "1.6 s"}),
    Breaks("way at half the time", "gravity of 9.0 m/s2", {"gravity": "[0 m/s^2, 0 m/s^2, -9.0 m/s^2]"}, full=True),
    Breaks("heat of friction", "looked at before the stop", {"time.end": "1.4 s"}, full=True),
    Breaks("friction over push", "a coefficient of 0.31", {"planes[0].friction": 0.31}, full=True),
    Breaks("created energy", "a penalty, on cells that lift off", {**EIGHT, "planes[0].method": "penalty"}, full=True),
]


def speed_over_time(run):
    return [("Nereid", run.column("time"), run.column("speed"))]


def exact_speed(run):
    return [("exact", [0, EXACT["time"], run.column("time")[-1]], [5, 0, 0])]


FIGURES = [Figure("speed", "time [s]", "speed [m/s]", speed_over_time, exact=exact_speed, caption="Speed of a block that slides to rest.")]
