"""How close is close enough, why, and what must break."""
from reference import bent, cylinder, lumped_couple, sphere
from verify import Breaks, Check, Falls, Figure, Pair, Table

CATALOGUE = ("E-10",)
CLAIM = ("Nearly incompressible thick walls expand as in Lame's solution, and bars bend without locking: hexahedra of one point and of "
         "eight.")
EVIDENCE = "exact"
DRIVER = "scene"

CYLINDER = "verification/nearly_incompressible/cylinder.yaml"
BENDING = "verification/nearly_incompressible/bending.yaml"
BAR = {"length": 1, "height": 0.2, "young": 200e9, "density": 7850, "slope": 1000}
WALL = {"inner": 1, "outer": 2, "young": 200e9, "pressure": 10e6}
BOUND = "the catalogue's bound"
KINDS = (("full", "eight points"), ("one_point", "one point"))


def of(kind="full", poisson=0.4999):
    return {"bodies[0].element.kind": kind, "bodies[0].material.poisson": poisson}


def ball(run, change):
    return run.again({**change, **run.overrides})


def pipe(run, change):
    return run.other("scene", CYLINDER, {**change, **{key: value for key, value in run.overrides.items() if "cells" not in key}})


WALLS = {"sphere": (ball, sphere), "cylinder": (pipe, cylinder)}


def widening(wall, kind="full", poisson=0.4999):
    a_run, exact = WALLS[wall]
    return lambda run: Pair(a_run(run, of(kind, poisson)).column("bore")[-1], exact(poisson=poisson, **WALL), "m")


def tension(wall, poisson):
    """What of the pressure inside pulls everywhere in the wall: minus the mean stress, the same in all of it. [Pa]"""
    ratio = WALL["outer"] / WALL["inner"]
    share = 1 / (ratio**3 - 1) if wall == "sphere" else 2 * (1 + poisson) / 3 / (ratio**2 - 1)
    return -WALL["pressure"] * share


def bending(layers, kind, poisson=0.49):
    """Mean of the end's section, which stays where its middle is."""
    def measure(run):
        material = {key: value for key, value in run.overrides.items() if "material" in key}
        one = run.other("scene", BENDING, {**of(kind, poisson), "bodies[0].mesh.cells": f"[{5 * layers}, 1, {layers}]", **material})
        return Pair(-one.column("tip")[-1], bent(poisson=poisson, couple=lumped_couple(layers), **BAR), "m")
    return measure


def bars(run):
    rows = []
    for kind, name in KINDS:
        for layers in (4, 8):
            row = [name, f"{layers}"]
            for poisson in (0, 0.3, 0.49, *((0.499,) if layers == 4 else ())):
                pair = bending(layers, kind, poisson)(run)
                row.append(f"{100 * (pair.got / pair.expected - 1):+.2f} %")
            rows.append(row + [""] * (6 - len(row)))
    return rows


def unevenness(wall, kind, poisson=0.4999):
    """The largest difference of an element's pressure from the exact one, over the pressure inside."""
    def measure(run):
        _, fields = WALLS[wall][0](run, of(kind, poisson)).frame("body")
        exact = tension(wall, poisson)
        return Pair(max(abs(p - exact) for p in fields["pressure"]) / WALL["pressure"], 0, scale=1)
    return measure


def all_of_them(run):
    rows = []
    for wall in WALLS:
        for kind, name in KINDS:
            row = [wall, name]
            for poisson in (0.3, 0.49, 0.499, 0.4999):
                pair = widening(wall, kind, poisson)(run)
                row.append(f"{100 * (pair.got / pair.expected - 1):+.2f} %")
            rows.append([*row, f"{100 * unevenness(wall, kind)(run).got:.2f} %"])
    return rows


DEPARTURES = {
    "integration": "the claim is of both kinds of hexahedra",
    "residual": "bending: the default takes a quarter more steps, and the limit is 2 %"}

CHECKS = [
    *(Check(f"widening of the {wall}, {name}, Poisson {poisson}", widening(wall, kind, poisson), 0.02, BOUND)
      for wall in WALLS for kind, name in KINDS for poisson in (0.49, 0.4999)),
    *(Check(f"pressure in the {wall}, {name}", unevenness(wall, kind), 0.02,
            f"{BOUND}, of the pressure inside; elements that lock show it first as a pressure that jumps from one to the next")
      for wall in WALLS for kind, name in KINDS),
    Check("bending, one point, Poisson 0.49", bending(4, "one_point"), 0.02, f"{BOUND}; 4 layers"),
    Check("bending, eight points, Poisson 0.49", bending(4, "full"), 0.02, f"{BOUND}; 4 layers"),
]

STUDIES = [
    Falls("widening of the sphere, eight points, Poisson 0.49", "bodies[0].mesh.cells", ["[2, 2, 4]", "[4, 4, 8]", "[8, 8, 16]"], order=1.8,
          sizes=[1 / 4, 1 / 8, 1 / 16], full=True),
    Table("Error of the widening over Poisson's ratio, and the largest error of an element's pressure at 0.4999, of the pressure inside.",
          ["wall", "element", "0.3", "0.49", "0.499", "0.4999", "pressure"], all_of_them, full=True),
    Table("Error of the bar's deflection over Poisson's ratio.",
          ["element", "layers", "0", "0.3", "0.49", "0.499"], bars, full=True),
]

STEEL = {"bodies[0].material.poisson": 0.3}
BREAKS = [
    Breaks("widening of the sphere, eight points, Poisson 0.4999", "three elements through the wall",
           {"bodies[0].mesh.cells": "[4, 4, 3]"}),
    Breaks("widening of the sphere, one point, Poisson 0.4999", "two elements through the wall", {"bodies[0].mesh.cells": "[4, 4, 2]"}),
    Breaks("widening of the sphere, one point, Poisson 0.49", "Poisson's ratio of steel", STEEL),
    Breaks("widening of the cylinder, eight points, Poisson 0.49", "a modulus of 210 GPa", {"bodies[0].material.young": "210 GPa"}),
    Breaks("widening of the cylinder, one point, Poisson 0.4999", "Poisson's ratio of steel", STEEL),
    Breaks("pressure in the sphere, eight points", "a wall that is thinner by a tenth", {"bodies[0].mesh.high": "[0.4 m, 0.4 m, 1.9 m]"}),
    Breaks("pressure in the cylinder, one point", "Poisson's ratio of steel", STEEL),
    Breaks("widening of the sphere, eight points, Poisson 0.49", "Poisson's ratio of steel", STEEL, full=True),
    Breaks("widening of the cylinder, eight points, Poisson 0.4999", "Poisson's ratio of steel", STEEL, full=True),
    Breaks("widening of the cylinder, one point, Poisson 0.49", "a modulus of 210 GPa", {"bodies[0].material.young": "210 GPa"}, full=True),
    Breaks("pressure in the sphere, one point", "a wall that is thinner by a tenth", {"bodies[0].mesh.high": "[0.4 m, 0.4 m, 1.9 m]"},
           full=True),
    Breaks("pressure in the cylinder, eight points", "Poisson's ratio of steel", STEEL, full=True),
    Breaks("bending, one point, Poisson 0.49", "Poisson's ratio of steel", STEEL),
    Breaks("bending, eight points, Poisson 0.49", "Poisson's ratio of steel", STEEL),
]

RATIOS = (0.3, 0.4, 0.45, 0.49, 0.499, 0.4999)


def over_poisson(run):
    return [(f"{wall}, {name}", [0.5 - nu for nu in RATIOS], [abs(100 * widening(wall, kind, nu)(run).error()) for nu in RATIOS])
            for wall in WALLS for kind, name in KINDS]


FIGURES = [Figure("widening", "1/2 less Poisson's ratio [-]", "error of the widening [%]", over_poisson, log=True,
                  caption="Error of the widening towards incompressibility, on one mesh each: it does not grow", full=True)]
