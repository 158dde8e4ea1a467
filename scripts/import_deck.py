"""A mesh as the file of another code has it: what the readers of scripts/import_mesh fill, and import_cells.py makes a .vtu file of."""
import dataclasses
import math
import re
import typing
from pathlib import Path

# Corners around each face of a hexahedron, counter-clockwise seen from outside; as in lib/mesh/skin.hpp.
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
# A solid of fewer nodes as a hexahedron with coincident corners, by the number of its nodes: tetrahedron, pyramid, wedge.
COLLAPSED = {4: (0, 1, 2, 2, 3, 3, 3, 3), 5: (0, 1, 2, 3, 4, 4, 4, 4), 6: (0, 1, 2, 2, 3, 4, 5, 5), 8: tuple(range(8))}
DEEPEST = 20       # of files that include files
LONGEST_RANGE = 10 ** 8  # of numbers that are given by their first and last


class Place(typing.NamedTuple):
    """A line of a file."""
    file: str
    line: int

    def __str__(self):
        return f"{self.file}:{self.line}"


class Element(typing.NamedTuple):
    """corners: nodes, 8 of a solid, 3 or 4 of a plate; part: its key in Deck.parts; word: its type in the file."""
    number: int
    corners: tuple
    part: object
    word: str
    at: Place


class Part(typing.NamedTuple):
    name: str
    remark: str = ""


class Group(typing.NamedTuple):
    """Nodes, or faces as tuples of 3 or 4 nodes, that have a name; kind: node set, element set or surface."""
    name: str
    kind: str
    of: list
    at: Place


class Other(typing.NamedTuple):
    """An element of a type that the program does not have."""
    number: object
    word: str
    at: Place


@dataclasses.dataclass
class Deck:
    """What a file says of its mesh, and what is wrong with it. Nodes have any key, mostly their number.

    name                  of the file
    plates_or_boundaries  triangles and quadrilaterals on faces of solids are boundaries, as of mesh generators
    left_out              {keyword: [how often, where first]} of what is not taken over
    """
    name: str
    points: dict = dataclasses.field(default_factory=dict)
    elements: list = dataclasses.field(default_factory=list)
    parts: dict = dataclasses.field(default_factory=dict)
    groups: list = dataclasses.field(default_factory=list)
    others: list = dataclasses.field(default_factory=list)
    left_out: dict = dataclasses.field(default_factory=dict)
    notes: list = dataclasses.field(default_factory=list)
    faults: list = dataclasses.field(default_factory=list)
    plates_or_boundaries: bool = False

    def fault(self, at, said):
        """at: a place, or the name of a file or an option."""
        self.faults.append((at, said))

    def sentences(self):
        """All faults, each once, file by file and there in the order of the lines."""
        first = {}
        for at, _ in self.faults:
            first.setdefault(at[0] if isinstance(at, tuple) else str(at), len(first))
        order = sorted(self.faults, key=lambda one: (first[one[0][0]], one[0][1]) if isinstance(one[0], tuple) else (first[str(one[0])], 0))
        return list(dict.fromkeys(f"{at}: {said}" for at, said in order))

    def leave_out(self, keyword, at):
        self.left_out.setdefault(keyword, [0, at])[0] += 1

    def add_point(self, key, position, at, number=None):
        if key in self.points and self.points[key] != position:
            self.fault(at, f"node {key if number is None else number} is given twice, at two places")
        self.points[key] = position

    def add_group(self, name, kind, of, at):
        self.groups.append(Group(name, kind, list(dict.fromkeys(of)), at))


def counted(count, words):
    """
    >>> counted(1, ("node", "nodes")), counted(2, ("node", "nodes"))
    ('1 node', '2 nodes')
    """
    return f"{count} {words[count != 1]}"


# ------------------------------------------------------------------------------------------------
# Text

def read_lines(deck, path, at=None):
    """[(place, text)] of a file; none if it is no text, which is a fault. `at` is the line that includes it."""
    try:
        data = Path(path).read_bytes()
    except (OSError, ValueError) as error:
        deck.fault(at or path, f"{path} cannot be read: {getattr(error, 'strerror', None) or error}")
        return []
    if b"\0" in data:
        deck.fault(at or path, f"{path} is no text; expected is the deck as text")
        return []
    name = Path(path).name
    return [(Place(name, number), text) for number, text in enumerate(data.decode("utf-8-sig", "replace").splitlines(), start=1)]


def included(deck, name, folders, at, depth):
    """The path of a file that a line includes, or None, which is a fault."""
    if depth > DEEPEST:
        deck.fault(at, f"files include each other more than {DEEPEST} deep")
        return None
    for folder in folders:
        if name and (Path(folder) / name).is_file():
            return Path(folder) / name
    deck.fault(at, f"includes the file '{name}', which is not there" if name else "includes a file without a name")
    return None


def whole(deck, text, at, what):
    """A whole number, or None, which is a fault."""
    try:
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    deck.fault(at, f"'{text.strip()}' is no whole number; expected is {what}")
    return None


def wholes(deck, words, at, what):
    """Whole numbers, nothing is 0; None where one is no number, which is a fault."""
    try:
        return [int(word) if word else 0 for word in words]
    except ValueError:
        pass
    found = [whole(deck, word or "0", at, what) for word in words]
    return None if None in found else found


def real(deck, text, at, what):
    """A number, also as Fortran writes it: 1.5d3 and 1.5-3; nothing is 0. None is a fault."""
    text = text.strip()
    if not text:
        return 0.0
    try:
        found = float(re.sub(r"(?<=[\d.])([+-]\d+)$", r"e\1", text.lower().replace("d", "e"))) if "_" not in text else math.nan
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        deck.fault(at, f"'{text}' is no number; expected is {what}")
        return None
    return found


def fields(text, widths):
    """The parts of a line by their widths, or by commas where it has any.

    >>> fields("       1     2.5", (8, 8, 8)), fields("1,2.5", (8, 8, 8))
    (['1', '2.5', ''], ['1', '2.5', ''])
    """
    if "," in text:
        parts = [part.strip() for part in text.split(",")]
        return parts + [""] * (len(widths) - len(parts))
    found, start = [], 0
    for width in widths:
        found.append(text[start:start + width].strip())
        start += width
    return found


# ------------------------------------------------------------------------------------------------
# Elements

def solid(nodes):
    """The eight corners of a solid of 4, 5, 6 or 8 nodes; some codes write tetrahedra as 1 2 3 4 4 4 4 4, which the program refuses.

    >>> solid((1, 2, 3, 4, 5, 6)), solid((1, 2, 3, 4, 4, 4, 4, 4))
    ((1, 2, 3, 3, 4, 5, 6, 6), (1, 2, 3, 3, 4, 4, 4, 4))
    """
    if len(nodes) == 8 and len(set(nodes)) == 4 and len(set(nodes[3:])) == 1:
        nodes = nodes[:4]
    return tuple(nodes[i] for i in COLLAPSED[len(nodes)])


def plate(nodes):
    """The corners of a plate or a segment: a fourth node that is 0 or the third again makes a triangle.

    >>> plate((1, 2, 3, 3)), plate((1, 2, 3, 0)), plate((1, 2, 3, 4))
    ((1, 2, 3), (1, 2, 3), (1, 2, 3, 4))
    """
    return tuple(nodes[:3]) if len(nodes) > 3 and nodes[3] in (0, nodes[2]) else tuple(nodes)


def faces_of(corners):
    """The faces of a solid, or the one of a plate, each corner once; faces with fewer than three nodes are none."""
    if len(corners) < 8:
        return [corners]
    rings = [tuple(dict.fromkeys(corners[i] for i in face)) for face in FACES]
    return [ring for ring in rings if len(ring) > 2]


def outer_faces(elements):
    """Faces of plates, and those faces of solids that no other one of these solids has."""
    seen = {}
    for element in elements:
        for ring in faces_of(element.corners):
            seen.setdefault(frozenset(ring), []).append((ring, len(element.corners) == 8))
    return [rings[0][0] for rings in seen.values() if len(rings) == 1 or not rings[0][1]]
