"""How close is close enough, why, and what must break."""
from math import hypot, pi

from reference import full_moment, point
from verify import Breaks, Check, Falls, Figure, Pair, Report

CATALOGUE = ("P-7",)
CLAIM = "A strip of plates under the end moment 2 pi E I / L rolls up to a full circle: its tip returns to the clamp."
EVIDENCE = "exact"
DRIVER = "scene"

STRIP = {"young": 210e9, "width": 0.0625, "thickness": 0.01, "length": 1.0}


def tip(run):
    """Its distance from the clamp."""
    return Pair(hypot(run.column("tip_x")[-1], run.column("tip_z")[-1]), 0, "m", scale=STRIP["length"])


def height(run):
    """The middle of the strip is the top of the circle."""
    return Pair(run.column("half_z")[-1], point(STRIP["length"] / 2, STRIP["length"])[1], "m")


def abreast(run):
    """And straight above the clamp."""
    return Pair(run.column("half_x")[-1], 0, "m", scale=STRIP["length"])


def cells(n):
    """n pairs of triangles along, as wide as long."""
    width = STRIP["length"] / n
    return {"bodies[0].mesh.cells_along": n, "bodies[0].mesh.width": f"{width!r} m",
            "loads[0].value": f'["0", "-{full_moment(**{**STRIP, "width": width})!r} * min(1, t/0.2)", "0"]'}


def finer(n):
    return lambda run: height(run.again(cells(n)))


def shape(run):
    """The strip as it lies: nodes of one side, in the order along it."""
    _, fields = run.frame("body")
    places = [(x, x + u[0], u[2]) for (x, y, _), u in zip(fields["points"], fields["displacement"]) if y == 0]
    places.sort()
    return [("16 cells", [p[1] for p in places], [p[2] for p in places])]


def circle(_run):
    places = [point(i / 200 * STRIP["length"], STRIP["length"]) for i in range(201)]
    return [("elastica", [x for x, _ in places], [z for _, z in places])]


CHECKS = [
    Check("distance of the tip from the clamp, over the length", tip, 1e-3,
          "a chain of equal cells closes as the circle does, and the square of the 3 % by which outer fibres strain is 1e-3"),
    Check("height of the circle, L/pi", height, 0.02, "the catalogue's bound; a chain of 16 straight cells is 0.6 % too high at the most"),
    Check("the middle beside the clamp, over the length", abreast, 1e-3, "as the tip"),
    Report("height with 32 cells", finer(32), "twice as fine", full=True),
]

BREAKS = [
    Breaks("distance of the tip from the clamp, over the length", "a twentieth of the moment missing",
           {"loads[0].value": '["0", "-6528.6 * min(1, t/0.2)", "0"]'}),
    Breaks("height of the circle, L/pi", "the stiffness of a plate, E/(1 - nu^2), in place of a beam's",
           {"bodies[0].material.poisson": 0.3}),
    Breaks("the middle beside the clamp, over the length", "a tenth of the moment missing",
           {"loads[0].value": '["0", "-6185.0 * min(1, t/0.2)", "0"]'}, full=True),
]

FIGURES = [Figure("circle", "x [m]", "z [m]", shape, exact=circle, error=False, equal=True,
                  caption="The rolled strip, 16 cells, on the circle of the elastica.")]
