#!/usr/bin/env python3
"""Meshes of the scenes in this folder.

    meshes.py        writes the .vtu files of this folder anew
"""
import itertools
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from mesh_files import Mesh, write  # noqa: E402  (after the path)


def brick(size, cells, sway):
    """A box about the origin with plane faces, its nodes swayed along them so that no two cells are alike."""
    grid = list(itertools.product(*[range(n + 1) for n in cells]))
    number = {at: i for i, at in enumerate(grid)}

    def place(at):
        s = [i / n for i, n in zip(at, cells)]
        swayed = [s[a] + sway / cells[a] * math.sin(math.pi * s[a]) * math.cos(2.3 * s[(a + 1) % 3] + 3.1 * s[(a + 2) % 3] + a)
                  for a in range(3)]
        return [round(length * (t - 0.5), 9) for length, t in zip(size, swayed)]

    corner = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    hexahedra = [[number[tuple(a + b for a, b in zip(at, c))] for c in corner] for at in itertools.product(*[range(n) for n in cells])]
    sets = {}
    for a, axis in enumerate("xyz"):
        sets[f"{axis}_low"] = [int(at[a] == 0) for at in grid]
        sets[f"{axis}_high"] = [int(at[a] == cells[a]) for at in grid]
    sets["corner"] = [int(at == tuple(cells)) for at in grid]
    return Mesh([place(at) for at in grid], hexahedra, sets)


def shell(size, cells, rise, sway):
    """A sheet of triangles about the origin that rises in its middle; diagonals alternate."""
    grid = list(itertools.product(range(cells[0] + 1), range(cells[1] + 1)))
    number = {at: i for i, at in enumerate(grid)}

    def place(at):
        s = [i / n for i, n in zip(at, cells)]
        t = [s[a] + sway / cells[a] * math.sin(math.pi * s[a]) * math.cos(2.7 * s[1 - a] + a) for a in range(2)]
        return [round(x, 9) for x in (size[0] * (t[0] - 0.5), size[1] * (t[1] - 0.5),
                                      rise * math.sin(math.pi * t[0]) * math.sin(math.pi * t[1]))]

    triangles = []
    for i, j in itertools.product(range(cells[0]), range(cells[1])):
        a, b, c, d = (number[at] for at in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
        triangles += [[a, b, c], [a, c, d]] if (i + j) % 2 == 0 else [[a, b, d], [b, c, d]]
    edge = [int(i in (0, cells[0]) or j in (0, cells[1])) for i, j in grid]
    return Mesh([place(at) for at in grid], triangles,
                {"rim": edge, "corner": [int(at == tuple(cells)) for at in grid], "x_low": [int(at[0] == 0) for at in grid]})


if __name__ == "__main__":
    here = Path(__file__).resolve().parent
    write(here / "block.vtu", brick([0.012, 0.011, 0.010], [3, 3, 3], 0.25))
    write(here / "slab.vtu", brick([0.036, 0.030, 0.010], [6, 5, 2], 0.2))
    write(here / "dish.vtu", shell([0.040, 0.030], [8, 6], 0.003, 0.2))
    write(here / "sheet.vtu", shell([0.020, 0.016], [5, 4], -0.0005, 0.2))
