#!/usr/bin/env python3
"""A ring shrunk onto a longer hollow shaft, without friction: a deck for CalculiX.

    python3 deck.py 4 > fit.inp; ccx fit; python3 deck.py 4 fit.dat

Half of both: shaft 10 to 25 mm, 50 mm long; ring 24.99 to 50 mm, 20 mm long, so 0.01 mm of interference. 210 GPa, 0.3. CAX8R,
6 x 20 and 10 x 8 cells, times CELLS. CalculiX computes a wedge of 2 degrees; forces are printed for 5 degrees.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "calculix"))
from deck import eight_nodes, elements, last, main, members  # noqa: E402

STIFFNESS = 1e17  # [Pa/m] of the contact: a pressure of 30 MPa overlaps by 0.3 nm


def tube(inside, outside, length, across, along, first):
    """As of eight_nodes, from z = 0 up; lengths in mm."""
    return eight_nodes(across, along, first, lambda s, t: ((inside + (outside - inside) * s) * 1e-3, length * t * 1e-3))


def mesh(cells):
    shaft = tube(10, 25, 50, 6 * cells, 20 * cells, 1)
    return shaft, tube(24.99, 50, 20, 10 * cells, 8 * cells, 1 + len(shaft[0]))


def points(cells):
    """{name: node} of the printed results."""
    (shaft, _, _), (ring, _, _) = mesh(cells)
    return {"outer_middle": ring[20 * cells, 0], "outer_end": ring[20 * cells, 16 * cells], "bore_middle": shaft[0, 0],
            "bore_20": shaft[0, 16 * cells], "shaft_30": shaft[12 * cells, 24 * cells]}


def deck(cells):
    (shaft, first, of_shaft), (ring, second, of_ring) = mesh(cells)
    along, of_one = 8 * cells, len(of_shaft)
    inside = [of_one + 1 + k for k in range(along)]
    outside = [of_one - 20 * cells + 1 + k for k in range(20 * cells)]
    return ["*NODE, NSET=ALL", *first, *second, *elements("CAX8R", "BODIES", of_shaft + of_ring),
            *members("NSET", "MIDDLE", [n for one in (shaft, ring) for (_, k), n in one.items() if k == 0]),
            *members("ELSET", "RING_IN", inside), *members("ELSET", "SHAFT_OUT", outside),
            *members("NSET", "BORE", [shaft[0, k] for k in range(0, 40 * cells + 1, 2 * cells)]),
            *members("NSET", "SKIN", [shaft[12 * cells, k] for k in range(0, 40 * cells + 1, 2 * cells)]),
            *members("NSET", "OUTER", [ring[20 * cells, k] for k in range(0, 16 * cells + 1, 2 * cells)]),
            "*SURFACE, NAME=APEXES", "RING_IN, S4", "*SURFACE, NAME=BASE", "SHAFT_OUT, S2",
            "*MATERIAL, NAME=STEEL", "*ELASTIC", "210e9, 0.3", "*SOLID SECTION, ELSET=BODIES, MATERIAL=STEEL",
            "*SURFACE INTERACTION, NAME=TOUCH", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS:g}",
            "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE", "APEXES, BASE",
            "*BOUNDARY", "MIDDLE, 2, 2", "*STEP, INC=100", "*STATIC",
            "*NODE PRINT, NSET=BORE", "U", "*NODE PRINT, NSET=SKIN", "U", "*NODE PRINT, NSET=OUTER", "U",
            "*CONTACT PRINT, SLAVE=APEXES, MASTER=BASE", "CF",  # the words of CalculiX for the secondary and primary surface
            "*END STEP"]


def numbers(cells, found):
    moved = {int(row[0]): row[1] for name in ("BORE", "SKIN", "OUTER") for row in last(found, "displacements", name)}
    said = [f"{name} [m]: {moved[node]:.6e}" for name, node in points(cells).items()]
    said.append(f"push on 5 degrees [N]: {2.5 * last(found, 'statistics', 'APEXES')[0][0]:.6e}")
    for name in ("BORE", "SKIN", "OUTER"):
        said += [f"{name}, every 2.5 mm from the middle [m]:", ", ".join(f"{row[1]:.6e}" for row in last(found, "displacements", name))]
    return said


if __name__ == "__main__":
    main(__doc__, deck, numbers)
