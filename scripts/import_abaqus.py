"""The mesh of an input file of Abaqus or CalculiX. What is read stands in docs/meshes.md."""
import dataclasses
import math
import re
import typing
from pathlib import Path

import import_deck

SOLID = re.compile(r"(C3D|SC|F3D)(8|6|5|4)(R|I|H|T|S|P|RH|RT|RS|IH|HT|RHT|RP|HP|RPH|E|RE|X|RI)*$")
PLATE = re.compile(r"((DS|S|M3D|R3D|SFM3D|US)(3|4)|STRI3|S4R5)(R|RS|RT|RSW|T|S)?$")
# Nodes around the faces S1, S2, ... by the number of nodes of a solid.
FACES = {8: ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
         6: ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
         5: ((0, 1, 2, 3), (0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)),
         4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))}
EDGES = {**{f"E{i + 1}": i for i in range(4)}, **{f"S{i + 3}": i for i in range(4)}}  # of plates, by Abaqus and by CalculiX
SECTIONS = {"SOLID SECTION", "SHELL SECTION", "SHELL GENERAL SECTION", "MEMBRANE SECTION", "SURFACE SECTION", "RIGID BODY"}
SILENT = {"HEADING", "PREPRINT", "END PART", "END INSTANCE", "ASSEMBLY", "END ASSEMBLY"}
MAKE_NODES = {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "IMPORT", "SUBMODEL", "SUBSTRUCTURE GENERATE"}


class Raw(typing.NamedTuple):
    """An element before its instance is known."""
    nodes: tuple
    word: str
    elset: str
    at: import_deck.Place


class Member(typing.NamedTuple):
    """A part of a set or surface: a number, (first, last, step) or a name; where it is looked up; the face of a surface."""
    of: object
    instance: str
    at: import_deck.Place
    face: str = ""


@dataclasses.dataclass
class Named:
    """A set or surface: its name as it was first written, and its members."""
    label: str
    at: import_deck.Place
    internal: bool = False
    members: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Scope:
    """What a part, an instance or the assembly holds; names in capitals. others: numbers of elements that the program does not have;
    place(x) moves a point of an instance."""
    name: str = ""
    nodes: dict = dataclasses.field(default_factory=dict)
    elements: dict = dataclasses.field(default_factory=dict)
    nsets: dict = dataclasses.field(default_factory=dict)
    elsets: dict = dataclasses.field(default_factory=dict)
    surfaces: dict = dataclasses.field(default_factory=dict)
    sections: list = dataclasses.field(default_factory=list)
    others: set = dataclasses.field(default_factory=set)
    place: object = None

    def key(self, number):
        return (self.name, number) if self.name else number

    def copy(self, name):
        made = dataclasses.replace(self, name=name, nodes=dict(self.nodes), elements=dict(self.elements), sections=list(self.sections))
        for kind in ("nsets", "elsets", "surfaces"):
            setattr(made, kind, {key: dataclasses.replace(one, members=list(one.members)) for key, one in getattr(self, kind).items()})
        return made


class Block(typing.NamedTuple):
    """A keyword in capitals, its parameters {NAME: value}, and its lines of data."""
    keyword: str
    parameters: dict
    at: import_deck.Place
    data: list


# ------------------------------------------------------------------------------------------------
# Text

def parameters_of(text):
    """{NAME: value} behind a keyword.

    >>> parameters_of(' NSET="a b", generate')
    {'NSET': 'a b', 'GENERATE': ''}
    """
    found = {}
    for part in text.split(","):
        name, _, value = part.partition("=")
        if name.strip():
            found[re.sub(r"\s+", " ", name.strip()).upper()] = value.strip().strip('"')
    return found


def lines_of(deck, path, top, at=None, depth=0):
    """[(place, text)] of a file without comments, with the files that it includes in their places."""
    for place, text in import_deck.read_lines(deck, path, at):
        if text.startswith("**") or not text.strip():
            continue
        found = re.match(r"\s*\*\s*INCLUDE\s*,(.*)", text, re.IGNORECASE)
        if not found:
            yield place, text
            continue
        file = import_deck.included(deck, parameters_of(found[1]).get("INPUT", ""), (path.parent, top), place, depth)
        if file:
            yield from lines_of(deck, file, top, place, depth + 1)


def blocks(deck, path):
    """The blocks of a file and of those that it includes."""
    block, head, start = None, "", None
    for place, text in lines_of(deck, path, path.parent):
        if head.endswith(",") or text.lstrip().startswith("*"):  # a keyword that goes on, or a new one
            if not head.endswith(","):
                head, start = "", place
                if block:
                    yield block
            head += text.strip()
            word, _, behind = head[1:].partition(",")
            block = Block(re.sub(r"\s+", " ", word.strip()).upper(), parameters_of(behind), start, [])
            continue
        head = ""
        if block:
            block.data.append((place, text))
        else:
            deck.fault(place, "data without a keyword before them; expected is a line that begins with '*'")
    if block:
        yield block


def words(text):
    return [word.strip().strip('"') for word in text.rstrip().rstrip(",").split(",")]


# ------------------------------------------------------------------------------------------------
# Blocks

def read(path):
    """The deck of a file."""
    deck, assembly, parts, instances = import_deck.Deck(Path(path).name), Scope(), {}, {}
    scope = assembly
    for block in blocks(deck, Path(path)):
        keyword, given = block.keyword, block.parameters
        if "INPUT" in given and keyword in ("NODE", "ELEMENT", "NSET", "ELSET"):
            deck.fault(block.at, f"*{keyword} with INPUT is not read; put *INCLUDE, INPUT={given['INPUT']} below it")
        elif keyword in ("PART", "INSTANCE") and not given.get("NAME"):
            deck.fault(block.at, f"*{keyword} has no NAME")
        elif keyword == "PART":
            scope = parts.setdefault(given["NAME"].upper(), Scope())
        elif keyword == "INSTANCE":
            scope = instance(deck, block, parts, instances)
        elif keyword in ("END PART", "END INSTANCE", "ASSEMBLY", "END ASSEMBLY"):
            scope = assembly
        elif keyword == "NODE":
            add_nodes(deck, block, scope)
        elif keyword == "ELEMENT":
            add_elements(deck, block, scope)
        elif keyword in ("NSET", "ELSET"):
            add_set(deck, block, scope)
        elif keyword == "SURFACE":
            add_surface(deck, block, scope)
        elif keyword in MAKE_NODES:
            deck.fault(block.at, f"*{keyword} changes the mesh and is not read; write the mesh out in full")
        else:
            if keyword in SECTIONS and given.get("ELSET"):
                scope.sections.append((given["ELSET"], given.get("MATERIAL", ""), keyword == "RIGID BODY", block.at))
            if keyword not in SILENT:
                deck.leave_out(f"*{keyword}", block.at)
    scopes = {"": assembly, **instances}
    if not instances and parts:
        deck.fault(deck.name, "there are parts and no *INSTANCE of them; expected is an assembly")
    gather(deck, scopes)
    return deck


def instance(deck, block, parts, instances):
    """The scope of an instance: a copy of its part, moved by the lines of data."""
    name, part = block.parameters["NAME"], block.parameters.get("PART", "").upper()
    if part not in parts:
        deck.fault(block.at, f"*INSTANCE {name} is of the part '{block.parameters.get('PART', '')}', which is not there")
    made = parts.get(part, Scope()).copy(name)
    rows = [[import_deck.real(deck, word, at, "a coordinate of *INSTANCE") for word in words(text)] for at, text in block.data]
    if any(None in row for row in rows) or [len(row) for row in rows] not in ([], [3], [3, 7]):
        deck.fault(block.at, "*INSTANCE has lines that are no shift of 3 numbers and no turn of 7")
        rows = []
    elif len(rows) == 2 and rows[1][:3] == rows[1][3:6]:
        deck.fault(block.data[1][0], "the two points of the axis of *INSTANCE coincide; expected are two places")
        rows = []
    made.place = mover(rows)
    if name.upper() in instances:
        deck.fault(block.at, f"the instance '{name}' is given twice")
    instances[name.upper()] = made
    return made


def mover(rows):
    """Shifts a point, then turns it about an axis through two points, as the lines of *INSTANCE say.

    >>> [round(x, 9) for x in mover([[1, 0, 0], [0, 0, 0, 0, 0, 2, 90]])((1, 0, 5))]
    [0.0, 2.0, 5.0]
    """
    shift = rows[0] if rows else (0.0, 0.0, 0.0)
    if len(rows) < 2:
        return (lambda p: tuple(a + b for a, b in zip(p, shift))) if any(shift) else (lambda p: p)
    start, end, angle = rows[1][:3], rows[1][3:6], math.radians(rows[1][6])
    axis = [b - a for a, b in zip(start, end)]
    length = math.hypot(*axis)
    u = [a / length for a in axis]

    def moved(p):
        r = [a + s - o for a, s, o in zip(p, shift, start)]
        along = sum(a * b for a, b in zip(u, r))
        across = [u[1] * r[2] - u[2] * r[1], u[2] * r[0] - u[0] * r[2], u[0] * r[1] - u[1] * r[0]]
        c, s = math.cos(angle), math.sin(angle)
        return tuple(o + c * a + s * x + (1 - c) * along * w for o, a, x, w in zip(start, r, across, u))
    return moved


def named(table, label, at):
    return table.setdefault(label.upper(), Named(label, at))


def add_nodes(deck, block, scope):
    if block.parameters.get("SYSTEM", "R").upper() != "R":
        deck.fault(block.at, "*NODE in cylindrical or spherical coordinates is not read; write it in rectangular ones")
        return
    nset = named(scope.nsets, block.parameters["NSET"], block.at) if block.parameters.get("NSET") else None
    for at, text in block.data:
        row = words(text)
        number = import_deck.whole(deck, row[0], at, "the number of a node")
        position = [import_deck.real(deck, word, at, "a coordinate") for word in (row[1:4] + ["", "", ""])[:3]]
        if number is None or None in position:
            continue
        if scope.nodes.get(number, position) != position:
            deck.fault(at, f"node {number} is given twice, at two places")
        scope.nodes[number] = position
        if nset:
            nset.members.append(Member(number, "", at))


def add_elements(deck, block, scope):
    word, label = block.parameters.get("TYPE", "").upper(), block.parameters.get("ELSET", "")
    solid, is_plate = SOLID.match(word), PLATE.match(word)
    count = int(solid[2]) if solid else 0 if not is_plate else 4 if "4" in word else 3
    elset = named(scope.elsets, label, block.at) if label else None
    row, start = [], None
    for at, text in block.data:
        start = start or at
        row += words(text)
        if text.rstrip().endswith(",") and (not count or len(row) <= count):
            continue
        add_element(deck, scope, row, (word, count, label, elset, bool(solid or is_plate)), start)
        row, start = [], None
    if row:
        add_element(deck, scope, row, (word, count, label, elset, bool(solid or is_plate)), start)


def add_element(deck, scope, row, how, at):
    word, count, label, elset, known = how
    if not known:
        deck.others.append(import_deck.Other(row[0], word or "*ELEMENT without TYPE", at))
        scope.others.add(int(row[0]) if row[0].isdecimal() else row[0])
        if elset and row[0].isdecimal():
            elset.members.append(Member(int(row[0]), "", at))
        return
    numbers = [import_deck.whole(deck, text, at, "the number of an element or a node") for text in row]
    if None in numbers:
        return
    if len(numbers) != count + 1:
        nodes = import_deck.counted(len(numbers) - 1, ("node", "nodes"))
        deck.fault(at, f"element {numbers[0]} has {nodes}; expected are {count} of {word}")
        return
    if numbers[0] in scope.elements:
        deck.fault(at, f"element {numbers[0]} is given twice, before at {scope.elements[numbers[0]].at}")
        return
    scope.elements[numbers[0]] = Raw(tuple(numbers[1:]), word, label, at)
    if elset:
        elset.members.append(Member(numbers[0], "", at))


def add_set(deck, block, scope):
    keyword, given = block.keyword, block.parameters
    label, inside = given.get(keyword, ""), given.get("INSTANCE", "").upper()
    if not label:
        deck.fault(block.at, f"*{keyword} has no name: expected is {keyword}=NAME")
        return
    one = named(scope.nsets if keyword == "NSET" else scope.elsets, label, block.at)
    one.internal = one.internal or "INTERNAL" in given
    if keyword == "NSET" and given.get("ELSET"):
        one.members.append(Member(("nodes of", given["ELSET"]), inside, block.at))
    for at, text in block.data:
        row = words(text)
        if "GENERATE" in given:
            numbers = [import_deck.whole(deck, word, at, "first, last and step of numbers") for word in row]
            if None in numbers:
                continue
            if len(numbers) not in (2, 3) or len(numbers) == 3 and numbers[2] < 1 or numbers[1] - numbers[0] > import_deck.LONGEST_RANGE:
                deck.fault(at, f"'{text.strip()}' is no range; expected are first, last and step of numbers")
                continue
            one.members.append(Member((numbers[0], numbers[1], numbers[2] if len(numbers) == 3 else 1), inside, at))
        else:
            one.members += [Member(int(word) if word.isdecimal() else word, inside, at) for word in row if word]


def add_surface(deck, block, scope):
    given = block.parameters
    kind = given.get("TYPE", "ELEMENT").upper()
    if kind not in ("ELEMENT", "NODE") or given.get("COMBINE", "UNION").upper() != "UNION":
        how = f"COMBINE={given['COMBINE'].upper()}" if kind in ("ELEMENT", "NODE") else f"TYPE={kind}"
        deck.leave_out(f"*SURFACE, {how}", block.at)
        return
    if not given.get("NAME"):
        deck.fault(block.at, "*SURFACE has no NAME")
        return
    one = named(scope.surfaces, given["NAME"], block.at)
    for at, text in block.data:
        row = words(text)
        word, face = row[0], row[1].upper() if len(row) > 1 else ""
        face = "surface" if "COMBINE" in given else "nodes" if kind == "NODE" else face
        one.members.append(Member(int(word) if word.isdecimal() else word, given.get("INSTANCE", "").upper(), at, face))


# ------------------------------------------------------------------------------------------------
# Numbers and names looked up

class Finder:
    """Sets and surfaces of scopes {NAME of an instance: scope} as keys of nodes, elements and faces."""

    def __init__(self, deck, scopes):
        self.deck, self.scopes = deck, scopes
        self.open = []  # names that are being looked up

    def seek(self, scope, kind, member):
        """(scope, set) of the name of a member, or None, which is a fault."""
        inside = self.scopes.get(member.instance) if member.instance else scope
        label = member.of[1] if isinstance(member.of, tuple) else str(member.of)
        if inside is not None:
            found = getattr(inside, kind).get(label.upper())
            if found:
                return inside, found
            before, _, behind = label.upper().rpartition(".")
            if before in self.scopes and behind in getattr(self.scopes[before], kind):
                return self.scopes[before], getattr(self.scopes[before], kind)[behind]
        what = {"nsets": "node set", "elsets": "element set", "surfaces": "surface"}[kind]
        self.deck.fault(member.at, f"there is no {what} '{label}'" if inside is not None else f"there is no instance '{member.instance}'")
        return None

    def numbers(self, scope, member, table, what):
        """[(scope, number)] of a member that is a number or a range; those of a range that are not there are passed over."""
        inside = self.scopes.get(member.instance) if member.instance else scope
        if inside is None:
            self.deck.fault(member.at, f"there is no instance '{member.instance}'")
            return []
        there = getattr(inside, table)
        if isinstance(member.of, tuple):
            return [(inside, number) for number in range(member.of[0], member.of[1] + 1, member.of[2]) if number in there]
        if member.of not in there and not (table == "elements" and member.of in inside.others):
            self.deck.fault(member.at, f"there is no {what} {member.of}")
        return [(inside, member.of)] if member.of in there else []

    def expand(self, scope, kind, one, table, what):
        """[(scope, number)] of all members of a set."""
        if any(one is other for other in self.open):
            self.deck.fault(one.at, f"the set '{one.label}' contains itself")
            return []
        self.open.append(one)
        found = []
        for member in one.members:
            if isinstance(member.of, tuple) and member.of[0] == "nodes of":
                hit = self.seek(scope, "elsets", member)
                if hit:
                    found += [(home, node) for home, element in self.elements(*hit) for node in home.elements[element].nodes]
            else:
                found += self.of_member(scope, kind, member, table, what)
        self.open.pop()
        return list({(home.name, number): (home, number) for home, number in found}.values())

    def of_member(self, scope, kind, member, table, what):
        """[(scope, number)] of a name, as SET or INSTANCE.SET, or of numbers, as 5 or INSTANCE.5."""
        if not isinstance(member.of, str):
            return self.numbers(scope, member, table, what)
        before, _, behind = member.of.upper().rpartition(".")
        if before in self.scopes and behind.isdecimal():
            return self.numbers(scope, member._replace(of=int(behind), instance=before), table, what)
        hit = self.seek(scope, kind, member)
        return self.expand(hit[0], kind, hit[1], table, what) if hit else []

    def nodes(self, scope, one):
        return [home.key(number) for home, number in self.expand(scope, "nsets", one, "nodes", "node")]

    def elements(self, scope, one):
        return self.expand(scope, "elsets", one, "elements", "element")

    def surface(self, scope, one):
        """(faces, nodes) of a surface."""
        if any(one is other for other in self.open):
            self.deck.fault(one.at, f"the surface '{one.label}' contains itself")
            return [], []
        self.open.append(one)
        faces, nodes = [], []
        for member in one.members:
            if member.face == "surface":
                hit = self.seek(scope, "surfaces", member)
                more = self.surface(*hit) if hit else ([], [])
            elif member.face == "nodes":
                more = [], [home.key(number) for home, number in self.of_member(scope, "nsets", member, "nodes", "node")]
            else:
                more = self.faces(self.of_member(scope, "elsets", member, "elements", "element"), member)
            faces += more[0]
            nodes += more[1]
        self.open.pop()
        return faces, nodes

    def faces(self, found, member):
        """(faces, nodes of edges) that a line of a surface means of its elements [(scope, number)]."""
        faces, nodes, wrong = [], [], []
        if not member.face:
            made = [import_deck.Element(number, corners_of(home, home.elements[number]), None, "", member.at) for home, number in found]
            return import_deck.outer_faces(made), []
        for home, number in found:
            raw = home.elements[number]
            keys = tuple(home.key(node) for node in raw.nodes)
            if PLATE.match(raw.word):
                if member.face in ("SPOS", "SNEG", "S1", "S2"):
                    faces.append(keys)
                elif member.face in EDGES and EDGES[member.face] < len(keys):
                    nodes += [keys[EDGES[member.face]], keys[(EDGES[member.face] + 1) % len(keys)]]
                else:
                    wrong.append(number)
            elif re.fullmatch(r"S[1-6]", member.face) and int(member.face[1]) <= len(FACES[len(keys)]):
                faces.append(tuple(keys[i] for i in FACES[len(keys)][int(member.face[1]) - 1]))
            else:
                wrong.append(number)
        if wrong:
            self.deck.fault(member.at, f"element {wrong[0]} has no face '{member.face}'")
        return faces, nodes


def corners_of(scope, raw):
    keys = tuple(scope.key(node) for node in raw.nodes)
    return import_deck.plate(keys) if PLATE.match(raw.word) else import_deck.solid(keys)


def gather(deck, scopes):
    """Fills the deck from the scopes of its instances."""
    finder = Finder(deck, scopes)
    for scope in scopes.values():
        for number, position in scope.nodes.items():
            deck.points[scope.key(number)] = scope.place(position) if scope.place else tuple(position)
    regions = {}
    for home, scope in scopes.items():
        for label, material, is_rigid, at in sorted(scope.sections, key=lambda section: section[2]):
            one = scope.elsets.get(label.upper())
            if one is None and not scope.elements:
                continue
            if one is None:
                deck.fault(at, f"there is no element set '{label}'")
                continue
            deck.parts.setdefault((home, label.upper()), import_deck.Part(one.label, f"material {material}" if material else ""))
            for inside, number in finder.elements(scope, one):  # a rigid body may take elements that have a section
                if regions.setdefault((inside.name, number), (home, label.upper())) != (home, label.upper()) and not is_rigid:
                    deck.fault(at, f"element {number} of the set '{label}' has a section already, by the set "
                                   f"'{deck.parts[regions[inside.name, number]].name}'")
    for home, scope in scopes.items():
        for number, raw in scope.elements.items():
            part = regions.get((scope.name, number)) or (home, raw.elset.upper())
            label = scope.elsets[part[1]].label if part[1] in scope.elsets else raw.elset or "elements"
            deck.parts.setdefault(part, import_deck.Part(label))
            deck.elements.append(import_deck.Element(number, corners_of(scope, raw), part, raw.word, raw.at))
    name_parts(deck, scopes)
    add_groups(deck, scopes, finder)


def twice(labels):
    """Those names, in capitals, that several instances have."""
    seen = [label.upper() for label in labels]
    return {label for label in seen if seen.count(label) > 1}


def full_name(scope, label, doubles):
    return f"{scope.name}_{label}" if scope.name and label.upper() in doubles else label


def name_parts(deck, scopes):
    used = list(dict.fromkeys(element.part for element in deck.elements))
    doubles = twice([deck.parts[part].name for part in used])
    for part in used:
        name, remark = deck.parts[part]
        deck.parts[part] = import_deck.Part(full_name(scopes[part[0]], name, doubles), remark)


def add_groups(deck, scopes, finder):
    for_surfaces = {(scope.name, str(member.of).rpartition(".")[2].upper())
                    for scope in scopes.values() for one in scope.surfaces.values() for member in one.members}
    regions = {element.part for element in deck.elements}
    hidden = 0
    doubles = {kind: twice([one.label for scope in scopes.values() for one in getattr(scope, kind).values()])
               for kind in ("nsets", "elsets", "surfaces")}
    for home, scope in scopes.items():
        for one in scope.nsets.values():
            deck.add_group(full_name(scope, one.label, doubles["nsets"]), "node set", finder.nodes(scope, one), one.at)
        for upper, one in scope.elsets.items():
            if (home, upper) in regions:
                continue
            if one.internal and (scope.name, upper) in for_surfaces:
                hidden += 1
                continue
            nodes = [inside.key(node) for inside, number in finder.elements(scope, one) for node in inside.elements[number].nodes]
            deck.add_group(full_name(scope, one.label, doubles["elsets"]), "element set", nodes, one.at)
        for one in scope.surfaces.values():
            faces, nodes = finder.surface(scope, one)
            name = full_name(scope, one.label, doubles["surfaces"])
            if faces:
                deck.add_group(name, "surface", faces, one.at)
            if nodes:
                deck.add_group(f"{name}_nodes" if faces else name, "node set", nodes, one.at)
    if hidden:
        words = ("internal element set of a surface is", "internal element sets of surfaces are")
        deck.notes.append(f"{import_deck.counted(hidden, words)} not written as sets of nodes")
