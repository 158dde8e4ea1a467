"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import speed
from verify import Breaks, Check, Falls, Figure, Pair, Table, share

CATALOGUE = ()
CLAIM = ("A plate that water wets on both sides moves in a step wave as $p/(\\rho c)\\,(1 - e^{-2\\rho c t/m})$ and passes the wave on, by "
         "automatic contact and tied along the normal.")
EVIDENCE = "exact"
DRIVER = "scene"

TIED = "verification/wetted_plate/tied.yaml"
WAVE, IMPEDANCE, MASS, DEPTH, SOUND = 1e6, 1.48e6, 78.5, 0.3, 1480.0  # [Pa] [kg/(m2 s)] [kg/m2] [m] [m/s]
LAST = WAVE / IMPEDANCE


def tied(run):
    return run if str(run.case_file).endswith(TIED) else run.other("scene", TIED, {})


def off(run, column, delay, sign=1.0):
    """The root of the mean square of the difference from the exact speed, over its last value, from the front to the end."""
    rows = [(t, v) for t, v in zip(run.column("time"), run.column(column)) if t >= delay]
    square = sum((sign * v - speed(t - delay, WAVE, IMPEDANCE, MASS)) ** 2 for t, v in rows) / len(rows)
    return Pair(sqrt(square), 0, "m/s", scale=LAST)


def moves(run):
    return off(run, "speed", DEPTH / SOUND)


def goes_on(run):
    return off(run, "passed", 2 * DEPTH / SOUND)


def ends(run):
    return Pair(run.mean("speed", 0.4e-3, 0.55e-3), speed(0.2e-3, WAVE, IMPEDANCE, MASS), "m/s")


FRONT = "the front is smeared over some two cells, 7 us of 350"
CHECKS = [
    Check("automatic contact: speed of the plate, root mean square over the last", moves, 0.01, FRONT),
    Check("automatic contact: speed at the far end of the water above, the same", goes_on, 0.02,
          "the same front, in the last 0.14 ms of the run"),
    Check("automatic contact: last speed", ends, 0.002, "that of the water without a plate"),
    Check("tied, a wave of tension: speed of the plate, root mean square over the last",
          lambda run: off(tied(run), "speed", DEPTH / SOUND, -1.0), 0.01, FRONT),
    Check("tied, a wave of tension: speed at the far end of the water above, the same",
          lambda run: off(tied(run), "passed", 2 * DEPTH / SOUND, -1.0), 0.02, "as by contact"),
]


def meshes(run):
    rows = []
    for water, plate in ((1, 1), (1, 3), (2, 3), (3, 2), (4, 3)):
        change = {f"bodies[{b}].mesh.cells": f"[{water}, {water}, {30 * water}]" for b in (0, 2)}
        change |= {"bodies[1].mesh.cells_along": plate, "bodies[1].mesh.cells_across": plate}
        rows.append([f"{water} x {water} x {30 * water}", f"{plate} x {plate}"]
                    + [share(off(one, "speed", DEPTH / SOUND, sign).error())
                       for one, sign in ((run.again(change), 1.0), (run.other("scene", TIED, change), -1.0))])
    return rows


STUDIES = [
    Falls("automatic contact: speed of the plate, root mean square over the last", along="refine", values=[1, 2], order=0.8),
    Table("Speed of the plate, root of the mean square error over the last speed.",
          ["cells of water", "plate", "automatic contact", "tied, tension"], meshes, full=True),
]

BREAKS = [
    Breaks("automatic contact: speed of the plate, root mean square over the last", "no water above",
           {"bodies[2].mesh.low": "[0 mm, 0 mm, 15 mm]"}),
    Breaks("automatic contact: speed at the far end of the water above, the same", "no water above",
           {"bodies[2].mesh.low": "[0 mm, 0 mm, 15 mm]"}),
    Breaks("automatic contact: last speed", "water above that is twice as dense", {"bodies[2].material.density": "2000 kg/m^3"}),
    Breaks("tied, a wave of tension: speed of the plate, root mean square over the last", "contact, which does not pull",
           {"contacts[0].kind": "contact", "contacts[1].kind": "contact"}, case=TIED),
    Breaks("tied, a wave of tension: speed at the far end of the water above, the same", "contact, which does not pull",
           {"contacts[0].kind": "contact", "contacts[1].kind": "contact"}, case=TIED),
]


def speeds(run):
    return [("by contact", [1e3 * t for t in run.column("time")], run.column("speed")),
            ("tied, tension, with its sign changed", [1e3 * t for t in tied(run).column("time")], [-v for v in tied(run).column("speed")]),
            ("at the far end", [1e3 * t for t in run.column("time")], run.column("passed"))]


def exact(_):
    times = [i * 1e-6 for i in range(551)]

    def after(delay):
        return [1e3 * t for t in times], [speed(t - delay, WAVE, IMPEDANCE, MASS) for t in times]
    plate, end = after(DEPTH / SOUND), after(2 * DEPTH / SOUND)
    return [("$p/(\\rho c)\\,(1 - e^{-2\\rho c t/m})$", *plate), ("", *plate), ("the same, 0.203 ms later", *end)]


FIGURES = [
    Figure("speed", "time [ms]", "velocity along z [m/s]", speeds, exact,
           caption="A plate of 78.5 kg/m² between two columns of water, in a step wave of 1 MPa."),
]
