"""The mesh of a file of gmsh, or of another format that meshio reads. What is read stands in docs/meshes.md."""
import contextlib
import io
import math
import typing
from numbers import Integral
from pathlib import Path

import import_deck

SOLIDS = {"hexahedron": 8, "wedge": 6, "pyramid": 5, "tetra": 4}
PLATES = {"triangle", "quad"}
SETS = {"vertex", "line"}
DIMENSIONS = {**dict.fromkeys(SOLIDS, 3), **dict.fromkeys(PLATES, 2), "line": 1, "vertex": 0}
GMSH = "gmsh:"
USUAL_NAMES = {0: "points", 1: "lines", 2: "surface", 3: "region"}


class Place(typing.NamedTuple):
    """An element of a file, whose line meshio does not keep."""
    file: str
    number: int

    def __str__(self):
        return f"{self.file}, element {self.number}"


def read(path):
    """The deck of a file. meshio keeps no lines, so faults name elements by their places in the file, counted from 1."""
    name = Path(path).name
    deck = import_deck.Deck(name, plates_or_boundaries=True)
    try:
        import meshio
    except ImportError:
        deck.fault(name, "Python has no meshio: install Debian's python3-meshio")
        return deck
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):  # it has sentences of its own
            mesh = meshio.read(path)
    except SystemExit:  # which is how meshio ends where it knows no format
        deck.fault(name, "meshio does not read it as a format that it knows; expected are .inp, .k, .rad, .msh or one of these")
        return deck
    except Exception as error:  # readers of many formats fail in many ways
        deck.fault(name, f"meshio does not read it: {error or type(error).__name__}")
        return deck
    for number, point in enumerate(mesh.points.tolist()):
        deck.points[number] = tuple((point + [0.0, 0.0])[:3])
        if not all(map(math.isfinite, point)):
            deck.fault(name, f"node {number + 1} has a coordinate that is no finite number")
    groups = {group: (int(pair[0]), int(pair[1])) for group, pair in mesh.field_data.items()
              if len(pair) == 2 and all(isinstance(one, Integral) for one in pair)}
    add_cells(deck, mesh, name, groups)
    add_sets(deck, mesh, name, groups)
    for array in (*mesh.point_data, *mesh.cell_data):
        if not array.startswith(GMSH):
            deck.leave_out(f"array '{array}'", name)
    return deck


def add_cells(deck, mesh, name, groups):
    """groups: {name: (number, dimension)} of the file; other arrays of a whole file, as our frames have them, are none."""
    names = {pair: group for group, pair in groups.items()}
    physical = mesh.cell_data.get("gmsh:physical") or [None] * len(mesh.cells)
    sets, seen, again, element = {}, {}, {}, 0
    for block, numbers in zip(mesh.cells, physical):
        kind, dimension = block.type, DIMENSIONS.get(block.type)
        for i, nodes in enumerate(block.data.tolist() if dimension is not None else block.data):  # polyhedra have lists of faces
            element += 1
            at = Place(name, element)
            number = abs(int(numbers[i])) if numbers is not None else 0
            group = names.get((number, dimension)) or (f"{USUAL_NAMES.get(dimension, 'region')}_{number}" if number else "")
            if dimension is None:
                deck.others.append(import_deck.Other(element, kind, at))
            elif min(nodes) < 0:
                deck.fault(at, f"a {kind} has a node that is not there")
            elif kind in SETS:
                sets.setdefault((dimension, group or USUAL_NAMES[dimension]), []).extend(nodes)
            elif seen.setdefault((dimension, *sorted(nodes)), element) != element:  # of gmsh: in a further physical group
                sets.setdefault((dimension, group or USUAL_NAMES[dimension]), []).extend(nodes)
                again[group] = again.get(group, 0) + 1
            else:
                part = (dimension, group or ("solids" if dimension == 3 else "plates"))
                deck.parts.setdefault(part, import_deck.Part(part[1]))
                corners = import_deck.solid(nodes) if kind in SOLIDS else tuple(nodes)
                deck.elements.append(import_deck.Element(element, corners, part, kind, at))
    for group, count in again.items():
        words = import_deck.counted(count, ("element", "elements")), "is" if count == 1 else "are"
        deck.notes.append(f"{words[0]} of the group '{group}' {words[1]} in another group, too: '{group}' has the nodes, as a set")
    for (_, group), nodes in sets.items():
        deck.add_group(group, "node set", nodes, name)


def add_sets(deck, mesh, name, groups):
    """Sets of meshio. Physical groups of gmsh are there already, but for those whose elements are in another one, too."""
    physical = mesh.cell_data.get("gmsh:physical") or [None] * len(mesh.cells)
    for group, points in mesh.point_sets.items():
        deck.add_group(group, "node set", [int(point) for point in points], name)
    for group, blocks in mesh.cell_sets.items():
        if group.startswith(GMSH) or group in groups and all(
                chosen is None or not len(chosen) or numbers is not None and (abs(numbers[chosen]) == groups[group][0]).all()
                for chosen, numbers in zip(blocks, physical)):
            continue
        nodes = [node for block, chosen in zip(mesh.cells, blocks)
                 if chosen is not None and len(chosen) and not block.type.startswith("polyhedron")
                 for node in block.data[chosen].ravel().tolist()]
        deck.add_group(group, "element set", nodes, name)
