"""How close is close enough, why, and what must break."""
import math

from reference import TWISTED, deflection
from verify import Breaks, Check, Figure, Miss, Pair, Report, Table

CATALOGUE = ("E-3",)
CLAIM = "A cantilever of one layer of hexahedra bends as a beam, whatever their aspect ratio; of four layers within 1 %."
EVIDENCE = "exact"
DRIVER = "scene"

HEIGHT, YOUNG = 0.1, 210e9  # [m] of the beam, also its width [Pa]
SHAPES = {  # of the six cells of the slender beam: z leans by 45 degrees, in turns or all alike, but not at the ends
    "rectangles": ["x", "y", "z"],
    "trapezoids": ["x + cos(pi*x)*(z - 0.1)*(x > 0.5)*(x < 5.5)", "y", "z"],
    "parallelograms": ["x + (z - 0.1)*(x > 0.5)*(x < 5.5)", "y", "z"]}
SIDES = {"in plane": (0.1, 0.2), "out of plane": (0.2, 0.1)}  # [m] of the slender beam across and along the load


def beam(aspect, layers=1, cells=10):
    """A beam of cells that are so much longer than high."""
    length = HEIGHT / layers * aspect * cells
    return {"bodies[0].mesh.high": f"[{length} m, {HEIGHT} m, {HEIGHT} m]", "bodies[0].mesh.cells": f"[{cells}, {layers}, {layers}]"}


def tip(run):
    return -run.column("tip")[-1]


def thin(aspect, **more):
    def measure(run):
        return Pair(tip(run.again({**beam(aspect), **more})), deflection(YOUNG, 0.3, HEIGHT * aspect * 10, HEIGHT, HEIGHT, 1), "m")
    return measure


def thick(aspect, **more):
    """Four layers of forty cells."""
    def measure(run):
        return Pair(tip(run.again({**beam(aspect, 4, 40), **more})), deflection(YOUNG, 0.3, HEIGHT * aspect * 10, HEIGHT, HEIGHT, 1), "m")
    return measure


def slender(shape, load="in plane", **more):
    """MacNeal and Harder's beam of six cells."""
    def measure(run):
        y, z = SIDES[load]
        there = run.again({"bodies[0].mesh.high": f"[6 m, {y} m, {z} m]", "bodies[0].mesh.cells": "[6, 1, 1]",
                           "bodies[0].mesh.map": str(SHAPES[shape]).replace("'", '"'), "bodies[0].material.young": "1e7 Pa",
                           "bodies[0].material.density": "1 kg/m^3", "loads[0].value": '["0", "0", "-1e-3"]', **more})
        return Pair(1e3 * tip(there), deflection(1e7, 0.3, 6, y, z, 1), "m")
    return measure


def twisted(load, along=12, across=2, through=1, **more):
    """MacNeal and Harder's twisted beam; at its tip the side of 1.1 lies along z."""
    def measure(run):
        turn = "pi*x/24"
        sides = {"in plane": ("0", "0", "-1e-3"), "out of plane": ("0", "-1e-3", "0")}[load]
        there = run.again({"bodies[0].mesh.low": "[0 m, -0.55 m, -0.16 m]", "bodies[0].mesh.high": "[12 m, 0.55 m, 0.16 m]",
                           "bodies[0].mesh.cells": f"[{along}, {across}, {through}]",
                           "bodies[0].mesh.map": f'["x", "y*cos({turn}) - z*sin({turn})", "y*sin({turn}) + z*cos({turn})"]',
                           "bodies[0].material.young": "29e6 Pa", "bodies[0].material.poisson": 0.22,
                           "bodies[0].material.density": "1 kg/m^3",
                           "loads[0].value": str(list(sides)).replace("'", '"'), **more})
        return Pair(-1e3 * there.column("tip" if load == "in plane" else "aside")[-1], TWISTED[load], "m")
    return measure


FULL = {"bodies[0].element.kind": "full"}
KINDS = {"one point": {}, "one point with springs": {"bodies[0].element.hourglass_kind": "stiffness"}, "eight points": FULL}
DEPARTURES = {"integration": "the same is checked with eight points"}


def kinds(run):
    rows = []
    for name, kind in KINDS.items():
        row = [name]
        for aspect in (1, 2, 5, 10):
            row.append(f"{tip(run.again({**beam(aspect), **kind})) / thin(aspect)(run).expected:.3f}")
        for aspect in (1, 5):
            row.append(f"{tip(run.again({**beam(aspect, 4, 40), **kind})) / thick(aspect)(run).expected:.3f}")
        row += [f"{pair.got / pair.expected:.3f}" for pair in
                [slender(shape, **kind)(run) for shape in SHAPES] + [twisted(load, **kind)(run) for load in TWISTED]]
        rows.append(row)
    return rows


def leaning(shape, degrees, result=None):
    """The slender beam of cells that lean by so much: deflection over that of a beam, or a result."""
    def measure(run):
        slope = math.tan(math.radians(degrees))
        map_ = {"trapezoids": f"x + {slope}*cos(pi*x)*(z - 0.1)*(x > 0.5)*(x < 5.5)",
                "parallelograms": f"x + {slope}*(z - 0.1)*(x > 0.5)*(x < 5.5)"}[shape]
        there = run.again({"bodies[0].mesh.high": "[6 m, 0.1 m, 0.2 m]", "bodies[0].mesh.cells": "[6, 1, 1]",
                           "bodies[0].mesh.map": f'["{map_}", "y", "z"]', "bodies[0].material.young": "1e7 Pa",
                           "bodies[0].material.density": "1 kg/m^3", "loads[0].value": '["0", "0", "-1e-3"]'})
        return there.result(result) if result else 1e3 * tip(there) / deflection(1e7, 0.3, 6, *SIDES["in plane"], 1)
    return measure


UNLIKE = "hourglass_above_neighbours"


def lean(run):
    return [[shape, f"{degrees}", *(f"{leaning(shape, degrees, result)(run):.3f}" for result in (None, UNLIKE))]
            for shape in ("parallelograms", "trapezoids") for degrees in (0, 2, 5, 10, 20, 45)]


CHECKS = [
    *(Check(f"one layer, aspect ratio {aspect}", thin(aspect), 0.02,
            "ten cells, each with a constant moment, miss 0.25 %; the wall also holds the sides, which stiffens the beam by 0.6 to 0.8 %")
      for aspect in (1, 2, 5, 10)),
    *(Check(f"one layer, aspect ratio {aspect}, eight points", thin(aspect, **FULL), 0.03, "the same", full=aspect > 1)
      for aspect in (1, 5, 10, 20)),
    *(Check(f"four layers, aspect ratio {aspect}", thick(aspect), 0.01, "the wall also holds the sides, which stiffens the beam by 0.6 %",
            full=aspect >= 5)
      for aspect in (1, 2, 5)),
    Check("four layers, aspect ratio 1, eight points", thick(1, **FULL), 0.01, "the same", full=True),
    Check("six rectangles, in plane", slender("rectangles"), 0.03, "each has a constant moment: 0.7 %; the wall holds the sides"),
    Check("six rectangles, out of plane", slender("rectangles", "out of plane"), 0.03, "the same"),
    Miss("six parallelograms, in plane", slender("parallelograms"), 0.1, "MacNeal and Harder's B",
         "no element of eight nodes bends right where its sides lean and passes the patch test (MacNeal 1987)"),
    Miss("six trapezoids, in plane", slender("trapezoids"), 0.1, "MacNeal and Harder's B", "the same, and this is its worst case"),
    Check("six rectangles, in plane, eight points", slender("rectangles", **FULL), 0.03, "the same"),
    Miss("six trapezoids, in plane, eight points", slender("trapezoids", **FULL), 0.1, "MacNeal and Harder's B", "the same", full=True),
    Report("hourglass energy above the neighbours of six rectangles", lambda run: Pair(leaning("trapezoids", 0, UNLIKE)(run), 0, scale=1),
           "the moment falls along the beam, so the cell at the clamp has more of it than the one beside it"),
    Report("hourglass energy above the neighbours of six trapezoids of 20 degrees",
           lambda run: Pair(leaning("trapezoids", 20, UNLIKE)(run), 0, scale=1),
           "they deflect by a fifth of what they should; all counts of the four cells that lean, and the run notes it"),
    Check("twisted beam, in plane", twisted("in plane"), 0.02, "MacNeal and Harder's A", evidence="benchmark"),
    Check("twisted beam, out of plane", twisted("out of plane"), 0.02, "MacNeal and Harder's A", evidence="benchmark"),
]

STUDIES = [Table("Six cells that lean, in plane: deflection over the exact one, and hourglass energy above the neighbours.",
                 ["shape", "degrees", "deflection", "above the neighbours"], lean, full=True),
           Table("Deflection over the exact one.",
                 ["element", "1 layer, 1", "2", "5", "10", "4 layers, 1", "5", "rectangles", "trapezoids", "parallelograms",
                  "twisted, in plane", "out of plane"], kinds, full=True)]

BREAKS = [
    Breaks("one layer, aspect ratio 1", "hourglass springs of the usual coefficient", {"bodies[0].element.hourglass_kind": "stiffness"}),
    Breaks("one layer, aspect ratio 10", "hourglass springs of the usual coefficient", {"bodies[0].element.hourglass_kind": "stiffness"}),
    Breaks("one layer, aspect ratio 1, eight points", "steel of 200 GPa", {"bodies[0].material.young": "200 GPa"}),
    Breaks("four layers, aspect ratio 1", "no hourglass stiffness to speak of", {"bodies[0].element.hourglass": 0.01}),
    Breaks("six rectangles, in plane", "hourglass springs", {"bodies[0].element.hourglass_kind": "stiffness"}),
    Breaks("twisted beam, in plane", "half the hourglass stiffness", {"bodies[0].element.hourglass": 0.5}),
    *(Breaks(f"one layer, aspect ratio {aspect}", "hourglass springs of the usual coefficient",
             {"bodies[0].element.hourglass_kind": "stiffness"}, full=True) for aspect in (2, 5)),
    *(Breaks(f"one layer, aspect ratio {aspect}, eight points", "steel of 200 GPa", {"bodies[0].material.young": "200 GPa"}, full=True)
      for aspect in (5, 10, 20)),
    *(Breaks(f"four layers, aspect ratio {aspect}", "no hourglass stiffness to speak of", {"bodies[0].element.hourglass": 0.01}, full=True)
      for aspect in (2, 5)),
    Breaks("four layers, aspect ratio 1, eight points", "steel of 200 GPa", {"bodies[0].material.young": "200 GPa"}, full=True),
    Breaks("six rectangles, out of plane", "hourglass springs", {"bodies[0].element.hourglass_kind": "stiffness"}, full=True),
    Breaks("six rectangles, in plane, eight points", "stopped before it is at rest", {"time.end": "0.1 s"}, full=True),
    Breaks("twisted beam, out of plane", "half the hourglass stiffness", {"bodies[0].element.hourglass": 0.5}, full=True),
]


def over_aspect(run):
    return [(name, list(ASPECTS), [tip(run.again({**beam(a), **kind})) / thin(a)(run).expected for a in ASPECTS])
            for name, kind in KINDS.items()]


ASPECTS = (1, 2, 3, 5, 7, 10)
FIGURES = [Figure("aspect", "length over height of a cell", "deflection over the beam's", over_aspect,
                  exact=lambda _: [("beam", [1, 10], [1, 1])],
                  caption="Deflection of a cantilever of one layer of ten cells over Timoshenko's.", full=True)]
