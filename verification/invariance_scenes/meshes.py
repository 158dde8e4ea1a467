#!/usr/bin/env python3
"""Meshes of the scenes in this folder: read, written, and made.

    meshes.py        writes the .vtu files of this folder anew
"""
import dataclasses
import itertools
import math
import xml.etree.ElementTree as xml
from pathlib import Path

TRIANGLE, HEXAHEDRON = 5, 12  # VTK's numbers


@dataclasses.dataclass
class Mesh:
    """Points [m], cells as lists of points (eight: hexahedra, three: triangles), node sets as lists of 0 and 1."""
    points: list
    cells: list
    sets: dict


def numbers(text, kind):
    return [kind(word) for word in text.split()]


def read(path):
    """A mesh of an ASCII .vtu file as `write` writes it."""
    root = xml.parse(path).getroot()
    arrays = {one.get("Name"): one for one in root.iter("DataArray")}
    flat = numbers(arrays["points"].text, float)
    connectivity, ends = numbers(arrays["connectivity"].text, int), numbers(arrays["offsets"].text, int)
    sets = {one.get("Name"): numbers(one.text, int) for one in root.find(".//PointData")}
    return Mesh([flat[i:i + 3] for i in range(0, len(flat), 3)],
                [connectivity[begin:end] for begin, end in zip([0, *ends], ends)], sets)


def write(path, mesh):
    """An ASCII .vtu file with all digits."""
    def array(kind, name, values, components=1):
        wide = f' NumberOfComponents="{components}"' if components > 1 else ""
        rows = [" ".join(str(v) for v in values[i:i + 12]) for i in range(0, len(values), 12)]
        return [f'<DataArray type="{kind}" Name="{name}"{wide} format="ascii">', *rows, "</DataArray>"]

    offsets = list(itertools.accumulate(len(cell) for cell in mesh.cells))
    lines = ['<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">', "<UnstructuredGrid>",
             f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.cells)}">', "<PointData>"]
    for name, flags in mesh.sets.items():
        lines += array("Int32", name, flags)
    lines += ["</PointData>", "<Points>", *array("Float64", "points", [x for p in mesh.points for x in p], 3), "</Points>", "<Cells>"]
    lines += array("Int64", "connectivity", [node for cell in mesh.cells for node in cell])
    lines += array("Int64", "offsets", offsets)
    lines += array("UInt8", "types", [HEXAHEDRON if len(cell) == 8 else TRIANGLE for cell in mesh.cells])
    lines += ["</Cells>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>", ""]
    path.write_text("\n".join(lines), encoding="utf-8")


# ------------------------------------------------------------------------------------------------
# Making

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
