#!/usr/bin/env python3
"""A block pressed on a wider one and pushed aside, unlike grids, plane strain: a deck for CalculiX.

    python3 deck.py 2 > blocks.inp; ccx blocks; python3 deck.py 2 blocks.dat

Lower 2 m x 1 m, upper 1 m x 1 m, a slice of 0.1 m, 1 GPa, 0.3, friction 0.3. The bottom is held. The top goes down by 0.5 mm, held along x,
and then by 0.1 mm along x. 20 x 10 and 7 x 7 cells C3D8I, times CELLS.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "calculix"))
from deck import elements, last, main, members  # noqa: E402

STIFFNESS, STICK = 1e13, 1e12  # [Pa/m] of the contact, across and along: the mean pressure of 0.34 MPa overlaps by 34 nm


def brick(low, high, counts, first):
    """({(i, j, k): number}, lines, cells) of a slice of one cell."""
    number = {(i, j, k): first + (i * (counts[1] + 1) + k) * 2 + j
              for i in range(counts[0] + 1) for k in range(counts[1] + 1) for j in range(2)}
    x, z = (lambda i, axis=axis: low[axis] + (high[axis] - low[axis]) * i / counts[axis] for axis in range(2))
    lines = [f"{n}, {x(i):.10g}, {0.1 * j:.10g}, {z(k):.10g}" for (i, j, k), n in number.items()]
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [[number[i + a, b, k + c] for a, b, c in corners] for i in range(counts[0]) for k in range(counts[1])]
    return number, lines, cells


def deck(cells):
    lower, first, of_lower = brick((0, 0), (2, 1), (20 * cells, 10 * cells), 1)
    upper, second, of_upper = brick((0.5, 1), (1.5, 2), (7 * cells, 7 * cells), 1 + len(lower))
    facing = {"FOOT_FACE": range(len(of_lower) + 1, len(of_lower) + len(of_upper) + 1, 7 * cells),
              "LOWER_FACE": range(10 * cells, len(of_lower) + 1, 10 * cells)}
    sets = {"BOTTOM": [n for (_, _, k), n in lower.items() if k == 0], "TOP": [n for (_, _, k), n in upper.items() if k == 7 * cells],
            "FOOT": [n for (_, j, k), n in upper.items() if j == 0 and k == 0]}
    printed = ["*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=200", "RF", "*NODE PRINT, NSET=FOOT, FREQUENCY=200", "U", "*END STEP"]
    return ["*NODE, NSET=ALL", *first, *second, *elements("C3D8I", "BODIES", of_lower + of_upper),
            *(line for name, some in sets.items() for line in members("NSET", name, some)),
            *(line for name, some in facing.items() for line in members("ELSET", name, some)),
            "*SURFACE, NAME=APEXES", "FOOT_FACE, S1", "*SURFACE, NAME=BASE", "LOWER_FACE, S2",
            "*MATERIAL, NAME=SOFT", "*ELASTIC", "1e9, 0.3", "*SOLID SECTION, ELSET=BODIES, MATERIAL=SOFT",
            "*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS:g}",
            "*FRICTION", f"0.3, {STICK:g}", "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE", "APEXES, BASE",
            "*BOUNDARY", "BOTTOM, 1, 3", "ALL, 2, 2",
            "*STEP, NLGEOM, INC=200", "*STATIC", "0.25, 1.", "*BOUNDARY", "TOP, 1, 1, 0", "TOP, 3, 3, -5e-4", *printed,
            "*STEP, NLGEOM, INC=200", "*STATIC", "0.1, 1.", "*BOUNDARY", "TOP, 1, 1, 1e-4", "TOP, 3, 3, -5e-4", *printed]


def numbers(cells, found):
    pressed, pushed = [rows[0] for title, name, rows in found if title == "total force" and name == "TOP"]
    before, after = [rows for title, name, rows in found if title == "displacements" and name == "FOOT"]
    return [f"force of the press [N]: {-pressed[2]:.6e}", f"force aside [N]: {pushed[0]:.6e}",
            "place along the foot [m], aside [m] after the press and after the push:",
            *(f"({0.5 + i / (7 * cells):.7g}, {a[1]:.6e}, {b[1]:.6e})," for i, (a, b) in enumerate(zip(before, after)))]


if __name__ == "__main__":
    main(__doc__, deck, numbers)
