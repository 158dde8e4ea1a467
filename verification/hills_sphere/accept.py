"""How close is close enough, why, and what must break."""
from math import sqrt

from reference import hoop_stress, motion, outer_motion, pressure, radial_stress
from verify import Breaks, Check, Falls, Figure, Pair, Table

CATALOGUE = ("M-4",)
CLAIM = ("A thick sphere under internal pressure, part of it plastic, expands at rest as in Hill's exact solution, nearly "
         "incompressible or not.")
EVIDENCE = "exact"
DRIVER = "scene"

YOUNG, YIELD = 200e9, 20e6
SLANT = 1 / sqrt(1 + 2 * 0.03**2)  # of the four corner rays against z
BOUND = "the catalogue's bound with 16 elements through the wall"


def plastic_to(c):
    return {"loads[0].value": f'"{YIELD / 1e6 * pressure(c):.9g} * (t < 0.05 ? sin(pi * t / 0.1)^2 : 1)"'}


def of(kind="full", poisson=0.3):
    return {"bodies[0].element.kind": kind, "bodies[0].material.poisson": poisson}


def cells(n):
    return {"bodies[0].mesh.cells": f"[1, 1, {n}]"}


def scaled(run, probe):
    """u E/sigma_y along the radius, for an inner radius of one. [m]"""
    return run.column(probe)[-1] / SLANT * YOUNG / YIELD


def outer(c, change):
    poisson = change["bodies[0].material.poisson"]
    return lambda run: Pair(scaled(run.again({**plastic_to(c), **change, **breaking(run)}), "outer"), outer_motion(c, poisson))


def inner(c, change):
    poisson = change["bodies[0].material.poisson"]
    return lambda run: Pair(scaled(run.again({**plastic_to(c), **change, **breaking(run)}), "inner"), motion(1, c, poisson))


def breaking(run):
    """What a break has set; it must not be set back."""
    return dict(run.overrides)


def profile(run):
    """[(r, radial, hoop stress over the yield stress)] of the elements; the patch lies about the axis z."""
    _, fields = run.frame("body")
    points, corners, stress = fields["points"], fields["connectivity"], fields["stress"]
    found = []
    for element, s in enumerate(stress):
        nodes = [points[n] for n in corners[8 * element:8 * element + 8]]
        r = sum(sqrt(sum(x * x for x in p)) for p in nodes) / 8
        found.append((r, s[2] / YIELD, (s[0] + s[1]) / 2 / YIELD))
    return found


def stresses(run):
    """The largest difference over the largest stress."""
    off = max(max(abs(radial - radial_stress(r, 1.2)), abs(hoop - hoop_stress(r, 1.2))) for r, radial, hoop in profile(run)
              if abs(r - 1.2) > 0.5 / 16)
    return Pair(off / pressure(1.2), 0, scale=1)


def all_of_them(run):
    rows = []
    for c in (1.2, 1.4):
        for poisson in (0.3, 0.49):
            for kind, name in (("full", "eight points"), ("one_point", "one point")):
                out, within = outer(c, of(kind, poisson))(run), inner(c, of(kind, poisson))(run)
                rows.append([f"{c}", f"{pressure(c):.6f}", f"{poisson}", name, f"{out.expected:.6f}", f"{out.got:.6f}",
                             f"{100 * (out.got / out.expected - 1):+.2f} %",
                             f"{100 * (within.got / within.expected - 1):+.2f} %"])
    return rows


FULL, ONE = of(), of("one_point")
DEPARTURES = {"integration": "nearly incompressible walls may lock, so both kinds of hexahedra are checked"}

CHECKS = [
    Check("outside, c = 1.2", outer(1.2, FULL), 0.01, BOUND),
    Check("outside, c = 1.2, one point", outer(1.2, ONE), 0.01, BOUND),
    Check("outside, c = 1.4", outer(1.4, FULL), 0.01, BOUND),
    Check("outside, c = 1.4, one point", outer(1.4, ONE), 0.01, BOUND),
    Check("outside, c = 1.4, Poisson 0.49", outer(1.4, of("full", 0.49)), 0.01, BOUND),
    Check("outside, c = 1.4, one point, Poisson 0.49", outer(1.4, of("one_point", 0.49)), 0.01, BOUND),
    Check("inside, c = 1.4", inner(1.4, FULL), 0.01, f"{BOUND}, which it sets for the outside"),
    Check("stresses through the wall, c = 1.2", stresses, 0.01,
          f"{BOUND}; the element in which c lies is left out, as the slope of the stress turns there"),
]

STUDIES = [
    Falls("outside, c = 1.2", "bodies[0].mesh.cells", ["[1, 1, 4]", "[1, 1, 8]", "[1, 1, 16]"], sizes=[1 / 4, 1 / 8, 1 / 16], order=1),
    Table("Motion outside (u E / yield stress, inner radius one) and error of that inside.",
          ["c", "pressure over yield stress", "Poisson", "element", "exact", "got", "error", "error inside"], all_of_them, full=True),
]

BREAKS = [
    Breaks("outside, c = 1.2", "hardening where there is none", {"bodies[0].material.tangent": "20 GPa"}),
    Breaks("outside, c = 1.4", "hardening where there is none", {"bodies[0].material.tangent": "2 GPa"}),
    Breaks("outside, c = 1.4, one point", "a yield stress of 21 MPa", {"bodies[0].material.yield": "21 MPa"}),
    Breaks("outside, c = 1.4", "8 elements through the wall", cells(8)),
    Breaks("inside, c = 1.4", "one side of the patch left free", {"planes[3].nodes": "[wall.y_low]", "planes[3].normal": "[0, -1, -0.03]"}),
    Breaks("stresses through the wall, c = 1.2", "a yield stress of 21 MPa", {"bodies[0].material.yield": "21 MPa"}),
    Breaks("outside, c = 1.2, one point", "hardening where there is none", {"bodies[0].material.tangent": "20 GPa"}, full=True),
    *(Breaks(f"outside, c = 1.4{kind}, Poisson 0.49", "a yield stress of 21 MPa", {"bodies[0].material.yield": "21 MPa"}, full=True)
      for kind in ("", ", one point")),
]


def through_the_wall(run):
    found = profile(run)
    return [("radial, elements", [r for r, _, _ in found], [s for _, s, _ in found]), ("hoop, elements", [r for r, _, _ in found],
        [s for _, _, s in found])]


def exact_stress(_):
    across = [1 + i / 200 for i in range(201)]
    return [("radial, exact", across, [radial_stress(r, 1.2) for r in across]), ("hoop, exact", across,
        [hoop_stress(r, 1.2) for r in across])]


FIGURES = [Figure("stresses", "radius over the inner one [-]", "stress over yield stress [-]", through_the_wall, exact=exact_stress,
                  caption="Stresses through the wall, which flows up to 1.2 of its inner radius: 16 elements of eight points")]
