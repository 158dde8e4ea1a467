"""How close is close enough, why, and what must break."""
from reference import FINEST, LINES, MESHES, STEP
from verify import Breaks, Check, Figure, Pair, Table

CATALOGUE = ()
CLAIM = ("A ring that is shrunk onto a longer hollow shaft widens, and presses the shaft in, as in CalculiX, also where the shaft is "
         "longer than the ring.")
EVIDENCE = "benchmark"
DRIVER = "scene"

PLACES = {"outer_middle": "ring outside, in the middle", "outer_end": "ring outside, at its end", "bore_middle": "bore, in the middle",
          "bore_20": "bore, below the end of the ring", "shaft_30": "shaft, 10 mm beyond the ring"}
PUSH = "resultant of the pressure on 5 degrees"
REFERENCE = MESHES[FINEST]


def moved(name):
    return lambda run: Pair(run.column(name)[-1], REFERENCE[name], "m")


def push(run):
    return Pair(run.column("push")[-1], REFERENCE["push"], "N")


def meshes(run):
    rows = []
    for factor, said in ((0.5, "6 x 20, 10 x 8"), (1, "12 x 40, 20 x 16"), (2, "24 x 80, 40 x 32")):
        one = run.again({f"bodies[{body}].mesh.cells_{way}": round(factor * run.case(f"bodies[{body}].mesh.cells_{way}"))
                         for body in range(2) for way in ("radial", "along")})
        rows.append([f"Nereid, {said}", *row_of({name: one.column(name)[-1] for name in REFERENCE})])
    narrow = run.again({f"bodies[{body}].mesh.cells_around": 2 for body in range(2)})
    rows.append(["Nereid, 12 x 40, 20 x 16, chords of 2.5 degrees", *row_of({name: narrow.column(name)[-1] for name in REFERENCE})])
    return rows + [[f"CalculiX, {6 * n} x {20 * n}, {10 * n} x {8 * n}", *row_of(MESHES[n])] for n in MESHES]


def row_of(numbers):
    return [f"{100 * (numbers[name] / REFERENCE[name] - 1):+.3f} %" for name in REFERENCE]


DEPARTURES = {}

OF_MESH = ("hexahedra of 1.25 mm leave a quarter of what those of 2.5 mm do, 0.1 % by the table; chords of 5 degrees have 0.13 % less "
           "volume than arcs")
CHECKS = [
    *(Check(PLACES[name], moved(name), 0.003, OF_MESH) for name in ("outer_middle", "outer_end", "bore_middle", "bore_20")),
    Check(PLACES["shaft_30"], moved("shaft_30"), 0.01, "a seventh of the displacement of the bore, and an error of 0.15 % of that"),
    Check(PUSH, push, 0.004, "chords of 5 degrees: their volume, sin a/a, is 0.13 % less than that of arcs, and forces on their two sides "
          "lean by half the angle, 0.10 %, where those of the deck lean by 0.01 %; mesh 0.1 %"),
]

STUDIES = [Table("Displacements and resultant over those of the finest deck, by cells of shaft and ring.",
                 ["program and cells", *PLACES.values(), PUSH], meshes, full=True)]

DIAMETER = {"bodies[1].mesh.inner_radius": "24.995 mm"}
SOFT = {"contacts[0].method": "penalty", "contacts[0].penalty_scale": 0.2}
BREAKS = [
    *(Breaks(check.name, "interference taken for that of the diameter", DIAMETER) for check in CHECKS),
    Breaks(PUSH, "a contact a hundred times too soft", SOFT, full=True),
]


def lines(run):
    """Radial displacements [um] along the bore, the outside of the shaft and the outside of the ring, where the reference has them."""
    fields = run.frame("body")[1]
    rows = sorted((p[0], p[2], u[0]) for p, u in zip(fields["points"], fields["displacement"]) if abs(p[1]) < 1e-9)
    found = []
    for name, radius in (("bore", 0.010), ("shaft", 0.025), ("ring", 0.050)):
        some = [(z, u) for x, z, u in rows if abs(x - radius) < 1e-6][::2]
        found.append((f"Nereid, {NAMES[name]}", [1e3 * z for z, _ in some], [1e6 * u for _, u in some]))
    return found


NAMES = {"bore": "bore", "shaft": "outside of the shaft", "ring": "outside of the ring"}


def reference_lines(run):
    return [(f"CalculiX, {NAMES[name]}", [1e3 * STEP * i for i in range(len(line))], [1e6 * u for u in line])
            for name, line in LINES.items()]


FIGURES = [Figure("radial", "distance from the middle [mm]", "radial displacement [um]", lines, exact=reference_lines,
                  caption="Radial displacements of a hollow shaft and a ring of 40 mm that is shrunk onto it, over those of CalculiX.")]
