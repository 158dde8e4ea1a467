#!/usr/bin/env python3
"""A clamped square plate under an even pressure that bends it by half its thickness: a deck for CalculiX.

    python3 deck.py 16 > plate.inp; ccx plate; python3 deck.py 16 plate.dat

A quarter of 1 m x 1 m x 10 mm, 210 GPa, 0.3; 0.1 MPa; shells S8R, large displacements. CELLS x CELLS, drawn to the clamp by a square:
CalculiX makes solids of the shells, and a clamp holds their thickness too, which disturbs a strip that is as wide as the plate is thick.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "calculix"))
from deck import eight_nodes, elements, last, main, members  # noqa: E402

HALF, THICKNESS, PRESSURE = 0.5, 0.01, 1e5  # [m] [m] [Pa]


def drawn(s, cells):
    """Distance from the middle [m] of the part s of the cells; nodes in the middle of an edge stay there."""
    corner = lambda i: HALF * (1 - (1 - i / cells)**2)  # noqa: E731
    i = round(2 * s * cells)
    return (corner(i // 2) + corner((i + 1) // 2)) / 2


def mesh(cells):
    return eight_nodes(cells, cells, 1, lambda s, t: (drawn(s, cells), drawn(t, cells)))


def deck(cells):
    number, nodes, shells = mesh(cells)
    nodes_where = lambda keep: [n for (i, k), n in number.items() if keep(i, k)]  # noqa: E731
    return ["*NODE, NSET=ALL", *nodes, *elements("S8R", "PLATE", shells),
            *members("NSET", "X0", nodes_where(lambda i, k: i == 0)), *members("NSET", "Y0", nodes_where(lambda i, k: k == 0)),
            *members("NSET", "RIM", nodes_where(lambda i, k: 2 * cells in (i, k))),
            "*MATERIAL, NAME=STEEL", "*ELASTIC", "210e9, 0.3", "*SHELL SECTION, ELSET=PLATE, MATERIAL=STEEL", f"{THICKNESS}",
            "*BOUNDARY", "RIM, 1, 6", "X0, 1, 1", "X0, 5, 6", "Y0, 2, 2", "Y0, 4, 4", "Y0, 6, 6",
            "*STEP, NLGEOM, INC=100", "*STATIC", "0.2, 1.", "*DLOAD", f"PLATE, P, {-PRESSURE}",
            "*NODE PRINT, NSET=Y0, FREQUENCY=100", "U", "*NODE PRINT, NSET=X0, TOTALS=ONLY, FREQUENCY=100", "RF", "*END STEP"]


def numbers(cells, found):
    number, _, _ = mesh(cells)
    moved = {int(row[0]): row for row in last(found, "displacements", "Y0")}
    profile = [-moved[number[i, 0]][3] for i in range(2 * cells + 1)]
    return [f"deflection in the middle [m]: {profile[0]:.6e}",
            f"force across the middle [N]: {-last(found, 'total force', 'X0')[0][0]:.6e}",
            "distance from the middle [m], deflection [m]:",
            *(f"({drawn(i / (2 * cells), cells):.7g}, {w:.6e})," for i, w in enumerate(profile))]


if __name__ == "__main__":
    main(__doc__, deck, numbers)
