#!/usr/bin/env python3
"""A ball's cap pressed on a block of few contact radii, without friction: a deck for CalculiX.

    python3 deck.py 1 > cap.inp; ccx cap; python3 deck.py 1 cap.dat

Cap of a ball of 50 mm, 8 mm wide and high; block of 12 mm by 6 mm on a base without friction; both round and 210 GPa, 0.3. The top of the
cap goes down by 0.04 mm. CAX8R, 20 x 16 and 24 x 16 cells, times CELLS, drawn to the contact. CalculiX computes a wedge of 2 degrees; the
force is printed for 5 degrees.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "calculix"))
from deck import eight_nodes, elements, last, main, members  # noqa: E402

STIFFNESS = 1e17  # [Pa/m] of the contact: a pressure of 2.2 GPa overlaps by 22 nm, of the approach of 40 um


def cap(s, t):
    """[m]; t = 0 at the contact."""
    r = 8 * (0.4 * s + 0.6 * s**3)
    low = 50 - math.sqrt(2500 - r * r)
    return 1e-3 * r, 1e-3 * (low + (8 - low) * (0.3 * t + 0.7 * t**3))


def block(s, t):
    """[m]; t = 1 at the contact."""
    return 12e-3 * (0.3 * s + 0.7 * s**3), -6e-3 * (0.3 * (1 - t) + 0.7 * (1 - t)**3)


def mesh(cells):
    upper = eight_nodes(20 * cells, 16 * cells, 1, cap)
    return upper, eight_nodes(24 * cells, 16 * cells, 1 + len(upper[0]), block)


def deck(cells):
    (upper, first, of_cap), (lower, second, of_block) = mesh(cells)
    up = 16 * cells
    facing = {"CAP_FACE": range(1, len(of_cap) + 1, up), "BLOCK_FACE": range(len(of_cap) + up, len(of_cap) + len(of_block) + 1, up)}
    return ["*NODE, NSET=ALL", *first, *second, *elements("CAX8R", "BODIES", of_cap + of_block),
            *members("NSET", "AXIS", [n for (i, _), n in [*upper.items(), *lower.items()] if i == 0]),
            *members("NSET", "TOP", [n for (_, k), n in upper.items() if k == 2 * up]),
            *members("NSET", "FLOOR", [n for (_, k), n in lower.items() if k == 0]),
            *members("NSET", "FACE", [lower[i, 2 * up] for i in range(0, 48 * cells + 1, 2 * cells)]),
            *(line for name, some in facing.items() for line in members("ELSET", name, some)),
            "*SURFACE, NAME=APEXES", "CAP_FACE, S1", "*SURFACE, NAME=BASE", "BLOCK_FACE, S3",
            "*MATERIAL, NAME=STEEL", "*ELASTIC", "210e9, 0.3", "*SOLID SECTION, ELSET=BODIES, MATERIAL=STEEL",
            "*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS:g}",
            "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE", "APEXES, BASE",
            "*BOUNDARY", "AXIS, 1, 1", "FLOOR, 2, 2", "*STEP, NLGEOM, INC=200", "*STATIC", "0.1, 1.", "*BOUNDARY", "TOP, 2, 2, -4e-5",
            "*NODE PRINT, NSET=FACE, FREQUENCY=200", "U", "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY, FREQUENCY=200", "RF", "*END STEP"]


def numbers(cells, found):
    rows = last(found, "displacements", "FACE")
    return [f"force on 5 degrees [N]: {2.5 * last(found, 'total force', 'FLOOR')[0][1]:.6e}", "distance from the axis [m], upwards [m]:",
            *(f"({block(i / 24, 1)[0]:.7g}, {row[2]:.6e})," for i, row in enumerate(rows))]


if __name__ == "__main__":
    main(__doc__, deck, numbers)
