"""Meshes of .vtu files as text: read, written, split, mirrored, numbered otherwise; and the node sets of the program's own shapes."""
import dataclasses
import itertools
import math
import xml.etree.ElementTree as xml

KIND_OF_VTK = {3: 5, 4: 9, 8: 12}  # by the number of nodes of a cell: triangle, quadrilateral, hexahedron
MIRRORED_CELL = {3: (1, 0, 2), 4: (0, 3, 2, 1), 8: (0, 3, 2, 1, 4, 7, 6, 5)}  # the other way round, from a corner that keeps its cut
MIRRORS = {"x": lambda p: [-p[0], p[1], p[2]], "xy": lambda p: [p[1], p[0], p[2]]}  # the sign of x changed; x and y exchanged


class Unreadable(Exception):
    """A file is no mesh that this module reads; says why."""


@dataclasses.dataclass
class Mesh:
    """Points [m], cells as lists of points, node sets as lists of 0 and 1, arrays of numbers of the cells, and {name of a group of cells:
    (number, dimension)}."""
    points: list
    cells: list
    sets: dict
    cell_arrays: dict = dataclasses.field(default_factory=dict)
    groups: dict = dataclasses.field(default_factory=dict)


# ------------------------------------------------------------------------------------------------
# Files

def read(path):
    """The mesh of an ASCII .vtu file; other encodings, and cells of other kinds, are Unreadable."""
    try:
        root = xml.parse(path).getroot()
    except (OSError, xml.ParseError) as error:
        raise Unreadable(f"{path}: {error}") from error
    if any(one.get("format") != "ascii" for one in root.iter("DataArray")):
        raise Unreadable(f"{path.name} is not written as text")

    def arrays(part, kind):
        found = root.find(f".//{part}")
        return {} if found is None else {one.get("Name"): [kind(word) for word in one.text.split()] for one in found
                                         if one.get("type", "").startswith(("Int", "UInt")) or kind is float}

    (points,) = arrays("Points", float).values()
    cells = arrays("Cells", int)
    ends = cells["offsets"]
    mesh = Mesh([points[i:i + 3] for i in range(0, len(points), 3)],
                [cells["connectivity"][begin:end] for begin, end in zip([0, *ends], ends)],
                {name: flags for name, flags in arrays("PointData", int).items() if set(flags) <= {0, 1}}, arrays("CellData", int),
                {name: tuple(group) for name, group in arrays("FieldData", int).items() if len(group) == 2})
    if [KIND_OF_VTK.get(len(cell)) for cell in mesh.cells] != cells["types"]:
        raise Unreadable(f"{path.name} has cells that are neither hexahedra nor triangles nor quadrilaterals")
    return mesh


def write(path, mesh):
    """An ASCII .vtu file with all digits."""
    def array(kind, name, values, components=1):
        wide = f' NumberOfComponents="{components}"' if components > 1 else ""
        rows = [" ".join(str(v) for v in values[i:i + 12]) for i in range(0, len(values), 12)]
        return [f'<DataArray type="{kind}" Name="{name}"{wide} format="ascii">', *rows, "</DataArray>"]

    offsets = list(itertools.accumulate(len(cell) for cell in mesh.cells))
    lines = ['<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">', "<UnstructuredGrid>"]
    if mesh.groups:
        lines += ["<FieldData>", *(f'<DataArray type="Int64" Name="{name}" NumberOfTuples="2" format="ascii">{one[0]} {one[1]}</DataArray>'
                                   for name, one in mesh.groups.items()), "</FieldData>"]
    lines += [f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{len(mesh.cells)}">', "<PointData>"]
    for name, flags in mesh.sets.items():
        lines += array("Int32", name, flags)
    lines.append("</PointData>")
    if mesh.cell_arrays:
        of_cells = [line for name, values in mesh.cell_arrays.items()
                    for line in array("Float64" if any(isinstance(v, float) for v in values[:1]) else "Int32", name, values)]
        lines += ["<CellData>", *of_cells, "</CellData>"]
    lines += ["<Points>", *array("Float64", "points", [x for p in mesh.points for x in p], 3), "</Points>", "<Cells>"]
    lines += array("Int64", "connectivity", [node for cell in mesh.cells for node in cell])
    lines += array("Int64", "offsets", offsets)
    lines += array("UInt8", "types", [KIND_OF_VTK[len(cell)] for cell in mesh.cells])
    lines += ["</Cells>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>", ""]
    path.write_text("\n".join(lines), encoding="utf-8")


def split(mesh):
    """A mesh of a file with every edge cut in two, written apart from the program's: of hexahedra, quadrilaterals and triangles."""
    points, made = [list(p) for p in mesh.points], {}
    sets = {name: list(flags) for name, flags in mesh.sets.items()}

    def middle(*nodes):
        key = tuple(sorted(nodes))
        if key not in made:
            made[key] = len(points)
            points.append([sum(mesh.points[node][axis] for node in nodes) / len(nodes) for axis in range(3)])
            for flags, coarse in zip(sets.values(), mesh.sets.values()):
                flags.append(int(all(coarse[node] for node in nodes)))
        return made[key]

    def parts(cell):
        if len(set(cell)) < len(cell):
            raise Unreadable("a cell has coincident corners")
        if len(cell) == 3:
            a, b, c = cell
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]]
        if len(cell) == 4:
            sides, whole = [middle(cell[i], cell[(i + 1) % 4]) for i in range(4)], middle(*cell)
            a, b, c, d = cell
            return [[a, sides[0], whole, sides[3]], [sides[0], b, sides[1], whole], [whole, sides[1], c, sides[2]],
                    [sides[3], whole, sides[2], d]]
        place = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
        at = {place[i]: cell[i] for i in range(8)}
        for x in range(3):
            for y in range(3):
                for z in range(3):
                    around = [cell[i] for i in range(8) if all(abs(p - q) < 2 for p, q in zip(place[i], (x, y, z)))]
                    if len(around) > 1:
                        at[x, y, z] = middle(*around)
        return [[at[tuple(o // 2 + p // 2 for o, p in zip(origin, one))] for one in place] for origin in place]

    fine, arrays = [], {name: [] for name in mesh.cell_arrays}
    for number, cell in enumerate(mesh.cells):
        new = parts(cell)
        fine += new
        for name, values in mesh.cell_arrays.items():
            arrays[name] += [values[number]] * len(new)
    return Mesh(points, fine, sets, arrays, mesh.groups)


# ------------------------------------------------------------------------------------------------
# Changes

def mirrored(mesh, mirror="x"):
    """A mesh in one of MIRRORS; cells go round the other way, so that they are not inside out."""
    return dataclasses.replace(mesh, points=[MIRRORS[mirror](p) for p in mesh.points],
                               cells=[[cell[i] for i in MIRRORED_CELL[len(cell)]] for cell in mesh.cells])


CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def turns_of_a_cube():
    """The 24 orders in which the corners of a hexahedron may be counted.

    >>> len(turns_of_a_cube())
    24
    """
    def volume(order):
        a, b, c = ([order[to][i] - order[0][i] for i in range(3)] for to in (1, 3, 4))
        return sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3))

    ways = [[tuple(corner[axes[i]] ^ flips[i] for i in range(3)) for corner in CORNERS]
            for axes in itertools.permutations(range(3)) for flips in itertools.product((0, 1), repeat=3)]
    return [[CORNERS.index(corner) for corner in order] for order in ways if volume(order) > 0]


def renumbered(mesh, shuffled, other_corners=False):
    """Nodes in another order, cells too, and the corners of hexahedra. Triangles are counted from another corner only if
    `other_corners` says so.

    shuffled(n)  the numbers 0 to n - 1 in another order
    returns      the mesh, the new number of each node, the new number of each cell
    """
    orders = {8: turns_of_a_cube(), 4: [(0, 1, 2, 3)], 3: [(0, 1, 2), (1, 2, 0), (2, 0, 1)] if other_corners else [(0, 1, 2)]}
    old, old_cells = shuffled(len(mesh.points)), shuffled(len(mesh.cells))  # by new number
    new_of_node, new_of_cell = ([new for _, new in sorted((one, new) for new, one in enumerate(order))] for order in (old, old_cells))

    def counted(one):
        cell = mesh.cells[one]
        return [new_of_node[cell[i]] for i in orders[len(cell)][one % len(orders[len(cell)])]]

    new = Mesh([mesh.points[i] for i in old], [counted(one) for one in old_cells],
               {name: [flags[i] for i in old] for name, flags in mesh.sets.items()},
               {name: [values[i] for i in old_cells] for name, values in mesh.cell_arrays.items()}, mesh.groups)
    return new, new_of_node, new_of_cell


# ------------------------------------------------------------------------------------------------
# The program's own shapes

SURFACES_OF_FILES = {"inside": "bottom", "outside": "top"}  # of tubes: plates of a file have the sides `top` and `bottom`


def sets_of_shape(shape, points):
    """{name: flags} of the node sets of a shape, whose surfaces follow from them; docs/meshes.md says where each is.

    shape   its keys and their values, in SI, as the program resolved them
    points  as the program built them

    >>> sets_of_shape({"kind": "box", "low": [0, 0, 0], "high": [1, 1, 1]}, [(0, 0, 0), (1, 0, 0.5)])["x_high"]
    [0, 1]
    """
    at = dict(shape)
    size = max(abs(x) for p in points for x in p)
    kind, turn = at["kind"], at.get("turn")

    def near(a, b):
        return abs(a - b) <= 1e-9 * size

    def radius(p):
        return math.hypot(p[0], p[1])

    rules = {}
    if kind == "box":
        for a, axis in enumerate("xyz"):
            rules[f"{axis}_low"] = lambda p, a=a: near(p[a], at["low"][a])
            rules[f"{axis}_high"] = lambda p, a=a: near(p[a], at["high"][a])
    elif kind == "sheet":
        rules = {"x_low": lambda p: near(p[0], 0), "x_high": lambda p: near(p[0], at["length"]),
                 "y_low": lambda p: near(p[1], 0), "y_high": lambda p: near(p[1], at["width"])}
    elif kind == "sphere":
        rules["surface"] = lambda p: near(math.hypot(*p), at["radius"])
    elif kind == "revolved":
        rules = rules_of_revolved(at, near, radius)
    elif kind in ("cylinder", "sector", "tube", "disc"):
        if kind != "disc":
            rules = {"bottom": lambda p: near(p[2], 0), "top": lambda p: near(p[2], at["length"])}
        inner = at.get("inner_radius", 0)
        if kind != "tube":
            rules["rim" if kind == "disc" else "side"] = lambda p: near(radius(p), at["radius"])
            inside, axis = ("inner_rim", "centre") if kind == "disc" else ("inside", "axis")
            rules[inside if inner else axis] = lambda p: near(radius(p), inner)
    else:
        raise Unreadable(f"shapes of the kind '{kind}' are not known here")
    for a, axis in enumerate("xyz"):
        if turn == "eighth" or turn == "half" and axis == "z" or turn == "quarter" and axis != "z":
            rules[f"{axis}_plane"] = lambda p, a=a: near(p[a], 0)
    if "angle" in at and at["angle"] < 2 * math.pi * (1 - 1e-9):
        sine, cosine = math.sin(at["angle"]), math.cos(at["angle"])
        rules["first_plane"] = lambda p: near(p[1], 0) and p[0] >= -1e-9 * size
        rules["second_plane"] = lambda p: near(p[1] * cosine, p[0] * sine) and p[0] * cosine + p[1] * sine >= -1e-9 * size
    return {name: [int(rule(p)) for p in points] for name, rule in rules.items()}


def rules_of_revolved(at, near, radius):
    """Faces on the lines of a section: a face looks outwards along a radius where what is inside of the line is filled and what is outside
    is not."""
    radii, heights, rows = at["radii"], at["heights"], at["filled"][::-1]  # rows from the bottom up

    def filled(i, j):
        return 0 <= i < len(radii) - 1 and 0 <= j < len(heights) - 1 and rows[j][i] == "x"

    def on_line(lines, line, at_line, others, parts, at_other):
        """Nodes on one line, within the parts of the other lines."""
        return lambda p: near(at_line(p), lines[line]) and any(
            others[k] <= at_other(p) <= others[k + 1] or near(at_other(p), others[k]) or near(at_other(p), others[k + 1]) for k in parts)

    rules = {}
    for i in range(len(radii)):
        out = [j for j in range(len(heights) - 1) if filled(i - 1, j) and not filled(i, j)]
        into = [j for j in range(len(heights) - 1) if filled(i, j) and not filled(i - 1, j)]
        rules[f"out_{i}"] = on_line(radii, i, radius, heights, out, lambda p: p[2])
        rules[f"in_{i}"] = on_line(radii, i, radius, heights, into, lambda p: p[2])
    for j in range(len(heights)):
        up = [i for i in range(len(radii) - 1) if filled(i, j - 1) and not filled(i, j)]
        down = [i for i in range(len(radii) - 1) if filled(i, j) and not filled(i, j - 1)]
        rules[f"up_{j}"] = on_line(heights, j, lambda p: p[2], radii, up, radius)
        rules[f"down_{j}"] = on_line(heights, j, lambda p: p[2], radii, down, radius)
    return rules
