"""Small meshes for scenes, as .vtu files in digits: hexahedra with their sets of nodes, and plates of triangles."""
import math

import numpy as np

SIDES = ("x_low", "x_high", "y_low", "y_high", "z_low", "z_high")


class Mesh:
    """Points [n x 3] in m, cells [m x 8 or 3], and sets of nodes by name."""

    def __init__(self, points, cells, sets=None):
        self.points, self.cells, self.sets = np.array(points, dtype=float), np.array(cells, dtype=int), sets or {}

    def mapped(self, function):
        """The mesh with its points moved by a function of x, y, z."""
        return Mesh([function(*point) for point in self.points], self.cells, self.sets)

    def text(self):
        """What a .vtu file holds."""
        kind = 12 if self.cells.shape[1] == 8 else 5
        point_data = "".join(f'<DataArray type="Int32" Name="{name}" format="ascii">'
                             + " ".join("1" if n in set(nodes) else "0" for n in range(len(self.points))) + "</DataArray>\n"
                             for name, nodes in self.sets.items())
        return ('<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n<UnstructuredGrid>\n'
                f'<Piece NumberOfPoints="{len(self.points)}" NumberOfCells="{len(self.cells)}">\n<PointData>\n{point_data}</PointData>\n'
                '<Points>\n<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="ascii">\n'
                + "\n".join(" ".join(repr(float(c)) for c in point) for point in self.points) + "\n</DataArray>\n</Points>\n"
                '<Cells>\n<DataArray type="Int64" Name="connectivity" format="ascii">\n'
                + "\n".join(" ".join(str(n) for n in cell) for cell in self.cells) + "\n</DataArray>\n"
                '<DataArray type="Int64" Name="offsets" format="ascii">'
                + " ".join(str(self.cells.shape[1] * (i + 1)) for i in range(len(self.cells))) + "</DataArray>\n"
                '<DataArray type="UInt8" Name="types" format="ascii">' + " ".join([str(kind)] * len(self.cells)) + "</DataArray>\n"
                "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def brick(low, high, cells, keep=lambda x, y, z: True):
    """A block of hexahedra; `keep` says of the middle of each whether it is there."""
    counts = [max(1, int(c)) for c in cells]
    axes = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, counts)]
    return grid(*axes, keep)


def grid(xs, ys, zs, keep=lambda x, y, z: True):
    """Hexahedra between given planes."""
    counts = [len(xs) - 1, len(ys) - 1, len(zs) - 1]
    points = np.array([(x, y, z) for z in zs for y in ys for x in xs])

    def node(i, j, k):
        return (k * (counts[1] + 1) + j) * (counts[0] + 1) + i

    cells = []
    for k in range(counts[2]):
        for j in range(counts[1]):
            for i in range(counts[0]):
                if keep(*(0.5 * (axis[n] + axis[n + 1]) for axis, n in ((xs, i), (ys, j), (zs, k)))):
                    cells.append([node(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    used = np.unique(cells)
    number = {old: new for new, old in enumerate(used)}
    points = points[used]
    ends = {name: (axis, values[0] if name.endswith("low") else values[-1])
            for name, (axis, values) in zip(SIDES, ((0, xs), (0, xs), (1, ys), (1, ys), (2, zs), (2, zs)))}
    sets = {name: np.flatnonzero(points[:, axis] == value) for name, (axis, value) in ends.items()}
    return Mesh(points, [[number[n] for n in cell] for cell in cells], sets)


def prism(corners, length, cells):
    """A triangular prism along y from three corners (x, z), each side divided: three blocks around the middle."""
    a, b, c = (np.array(corner, dtype=float) for corner in corners)
    if (b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0] < 0:
        b, c = c, b
    middle = (a + b + c) / 3
    points, found, cells_of = [], {}, []

    def node(p, y):
        key = (round(p[0] * 1e12), round(p[1] * 1e12), round(y * 1e12))
        if key not in found:
            found[key] = len(points)
            points.append((p[0], y, p[1]))
        return found[key]

    n = max(1, cells)
    ys = np.linspace(0, length, n + 1)
    for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
        quad = (p, (p + q) / 2, middle, (p + r) / 2)
        at = [[(1 - s) * (1 - t) * quad[0] + s * (1 - t) * quad[1] + s * t * quad[2] + (1 - s) * t * quad[3]
               for s in np.linspace(0, 1, n + 1)] for t in np.linspace(0, 1, n + 1)]
        for j in range(n):
            for i in range(n):
                ring = (at[j][i], at[j][i + 1], at[j + 1][i + 1], at[j + 1][i])
                for k in range(n):
                    cells_of.append([node(p, ys[k + 1]) for p in ring] + [node(p, ys[k]) for p in ring])
    return Mesh(points, cells_of)


def sheet(low, high, cells, z=0.0):
    """A plate in the plane z: triangles with normals towards +z, and its rim."""
    xs, ys = (np.linspace(low[i], high[i], cells[i] + 1) for i in (0, 1))
    points = [(x, y, z) for y in ys for x in xs]
    triangles = []
    for j in range(cells[1]):
        for i in range(cells[0]):
            a, b, c, d = (j * len(xs) + i, j * len(xs) + i + 1, (j + 1) * len(xs) + i + 1, (j + 1) * len(xs) + i)
            triangles += [(a, b, c), (a, c, d)] if (i + j) % 2 == 0 else [(a, b, d), (b, c, d)]
    rim = [n for n, (x, y, _) in enumerate(points) if x in (xs[0], xs[-1]) or y in (ys[0], ys[-1])]
    return Mesh(points, triangles, {"rim": rim})


def ridge(angle, height, length, cells, across=None, along=None):
    """A roof along y whose flanks enclose `angle` [deg] in the solid, its top at z = 0, no wider than `across`."""
    slope = math.tan(math.radians(90 - angle / 2))
    half = height / slope
    if across is not None and half > across:
        half = across
    return brick((-1, 0, -1), (1, length, 0), (2 * cells, along or cells, cells)).mapped(
        lambda u, y, w: (u * half, y, (-abs(u) * half * slope) * (1 + w) + w * (half * slope + height)))


def valley(angle, height, length, cells, across=None):
    """A groove along y whose flanks enclose `angle` [deg] of air, its bottom at z = 0."""
    slope = math.tan(math.radians(90 - angle / 2))
    half = height / slope
    if across is not None and half > across:
        half = across
    return brick((-1, 0, -1), (1, length, 0), (2 * cells, cells, cells)).mapped(
        lambda u, y, w: (u * half, y, abs(u) * half * slope * (1 + w) + w * height))
