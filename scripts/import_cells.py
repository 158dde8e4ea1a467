"""A mesh of another code as cells, regions and sets that the program reads, with the sentences that say what became of it."""
import dataclasses
import itertools
import math
import re

import import_deck
import mesh_files
from import_deck import counted

MOST_NAMED = 8          # elements or nodes in a sentence
NEAR = 1e-8             # [-] of the largest coordinate: nodes that are no farther apart along x, y and z are at one place
BIN = 1e-5              # [-] of the largest coordinate: size of the bins in which nodes at one place are sought
NO_NUMBER = -1.0        # in place of the number of an element: cells of boundaries have none
SUFFIXES = {"node set": "_nodes", "element set": "_elements", "surface": "_surface", "region": ""}
KIND_WORDS = {8: ("hexahedron", "hexahedra"), 6: ("wedge", "wedges"), 5: ("pyramid", "pyramids"), 4: ("tetrahedron", "tetrahedra")}
PLATE_WORDS = {4: ("quadrilateral", "quadrilaterals"), 3: ("triangle", "triangles")}


@dataclasses.dataclass
class Result:
    """The mesh, and what is said of it under each heading."""
    mesh: mesh_files.Mesh
    said: dict


def listed(things):
    """Numbers, or nodes of instances as (instance, number).

    >>> listed([1, ("I-1", 2)]), listed(range(20))
    ('1, I-1.2', '0, 1, 2, 3, 4, 5, 6, 7, ...')
    """
    first = list(itertools.islice(things, MOST_NAMED + 1))
    words = [f"{one[0]}.{one[1]}" if isinstance(one, tuple) else str(one) for one in first[:MOST_NAMED]]
    return ", ".join(words) + (", ..." if len(first) > MOST_NAMED else "")


def valid(name):
    """A name of letters, digits and _ that begins with a letter or _, and not as arrays of VTK do.

    >>> valid("Set-1"), valid("1 floor (left)"), valid("a__b"), valid("é"), valid("vtk")
    ('Set_1', 'n_1_floor_left', 'a__b', 'n', 'n_vtk')
    """
    made = re.sub(r"[^A-Za-z0-9_]+", "_", name)
    made = made if made == name else made.strip("_")
    return made if re.match(r"(?!vtk)[A-Za-z_]", made) else f"n_{made}".rstrip("_")


# ------------------------------------------------------------------------------------------------
# What is refused

def is_tetrahedron(element):
    return len(element.corners) == 8 and len(set(element.corners)) == 4


def check_elements(deck, without_others, tetrahedra):
    """Faults of elements: nodes that are not there, and types that the program does not have, unless they are to be left out."""
    for element in deck.elements:
        missing = [node for node in dict.fromkeys(element.corners) if node not in deck.points]
        if missing:
            deck.fault(element.at, f"element {element.number} has the node {listed(missing)}, which is not there")
        elif len(set(element.corners)) < (4 if len(element.corners) == 8 else len(element.corners)):
            deck.fault(element.at, f"element {element.number} has coincident corners that make no element of it")
    for word, found in by_word([] if tetrahedra else [element for element in deck.elements if is_tetrahedron(element)]).items():
        deck.fault(found[0].at, f"{counted(len(found), KIND_WORDS[4])} ({word}: {listed(one.number for one in found)}), which the program "
                                "does not have. Mesh with hexahedra; --tetrahedra makes hexahedra with coincident corners of them, which "
                                "are too stiff where they are many")
    for word, found in by_word([] if without_others else deck.others).items():
        deck.fault(found[0].at, f"{counted(len(found), ('element', 'elements'))} of the type {word} "
                                f"({listed(one.number for one in found)}), which the program does not have; --without-others leaves them "
                                "out")
    if not deck.elements and not deck.faults:
        deck.fault(deck.name, "it has no elements that the program has; expected are hexahedra, wedges, triangles and quadrilaterals")


def by_word(elements):
    found = {}
    for element in elements:
        found.setdefault(element.word, []).append(element)
    return found


def check_groups(deck):
    """Faults of faces with nodes that are not there."""
    for group in deck.groups:
        of_faces = group.kind == "surface"
        missing = list(dict.fromkeys(node for one in group.of for node in (one if of_faces else (one,)) if node not in deck.points))
        if missing:
            deck.fault(group.at, f"the {group.kind} '{group.name}' has the node {listed(missing)}, which is not there")


def choose_parts(deck, only):
    """Keeps only the parts of these names, and lists the others as left out; a name that is not there is a fault."""
    names = {deck.parts[element.part].name for element in deck.elements}
    for name in only:
        if name not in names | {valid(one) for one in names}:
            deck.fault(f"--only {name}", f"there is no such part; there are: {', '.join(sorted(names))}")
    if only:
        chosen = {key for key, part in deck.parts.items() if part.name in only or valid(part.name) in only}
        for part, found in by_part(element for element in deck.elements if element.part not in chosen).items():
            deck.leave_out(f"the part '{deck.parts[part].name}' ({kinds(found)})", found[0].at)
        deck.elements = [element for element in deck.elements if element.part in chosen]


# ------------------------------------------------------------------------------------------------
# Names

class Names:
    """Names of regions, surfaces and node sets of one body, each once; every new name is a sentence of `said`."""

    def __init__(self, said, has_solids, has_plates):
        self.said = said
        self.kept = {}     # {name: (kind, nodes)}
        self.taken = {"skin"} if has_solids else set()
        if has_plates:  # surfaces of all plates, and those of a set with plates
            self.taken |= {"top", "bottom"}
        self.has_plates = has_plates

    def is_taken(self, name):
        others = [name + "_top", name + "_bottom", re.sub(r"_(top|bottom)$", "", name)] if self.has_plates else []
        return name in self.taken or any(other in self.kept for other in others if other != name)

    def give(self, name, kind, nodes):
        """The name that a group gets; None of a set where a region, surface or set of its name has the same nodes already."""
        made = valid(name)
        nodes = frozenset(nodes)
        if made in self.kept and kind in ("node set", "element set") and self.kept[made][1] == nodes:
            self.said.append(f"the {kind} '{name}' has the nodes of the {self.kept[made][0]} '{made}' and stands for both")
            return None
        if self.is_taken(made):
            made = made + SUFFIXES[kind]
        base, number = made, 1
        while self.is_taken(made):
            number += 1
            made = f"{base}_{number}"
        if made != name:
            self.said.append(f"the {kind} '{name}' is now '{made}'")
        self.taken.add(made)
        self.kept[made] = (kind, nodes)
        return made


# ------------------------------------------------------------------------------------------------
# Faces

def triples(ring):
    """The sets of three corners that a face has."""
    return [frozenset(three) for three in itertools.combinations(ring, 3)]


class Faces:
    """Faces of solids that touch any of some nodes: how many solids have each, and of which face three corners are a part."""

    def __init__(self, solids, nodes):
        self.count = {}
        self.ring_of = {}
        self.of_triple = {}
        for element in solids:
            for ring in import_deck.faces_of(element.corners):
                if sum(node in nodes for node in ring) < 3:
                    continue
                key = frozenset(ring)
                self.count[key] = self.count.get(key, 0) + 1
                if key not in self.ring_of:
                    self.ring_of[key] = ring
                    for three in triples(ring):
                        self.of_triple.setdefault(three, []).append(key)

    def has(self, corners):
        """Whether a plate lies on a face, or on a half of it."""
        key = frozenset(corners)
        return key in self.count or len(key) == 3 and key in self.of_triple


def first_at_place(points):
    """{node: the first node at its place} of nodes {node: position}."""
    size = max(abs(x) for position in points.values() for x in position) or 1.0
    bins, found = {}, {}
    for node, position in points.items():
        scaled = [x / size for x in position]
        around = [{math.floor((x - NEAR) / BIN), math.floor((x + NEAR) / BIN)} for x in scaled]  # two where the edge of a bin is near
        there = (one for key in itertools.product(*around) for one in bins.get(key, ()))
        found[node] = next((one for one, other in there if all(abs(a - b) <= NEAR for a, b in zip(scaled, other))), node)
        if found[node] == node:
            bins.setdefault(tuple(math.floor(x / BIN) for x in scaled), []).append((node, scaled))
    return found


def plates_on_faces(deck, solids, plates):
    """The plates that lie on faces of solids, with the nodes of the solids or with nodes of their own at the same places."""
    if not solids or not plates:
        return []
    place = first_at_place(deck.points)
    at_places = [tuple(place[node] for node in element.corners) for element in plates]
    faces = Faces([solid._replace(corners=tuple(place[node] for node in solid.corners)) for solid in solids],
                  {node for corners in at_places for node in corners})
    return [element for element, corners in zip(plates, at_places) if faces.has(corners)]


def sorted_faces(faces, plates, rings):
    """(faces of solids, of plates, of neither) that the faces of a surface are; two triangles may be a face with four corners."""
    on_solids, on_plates, halves, stray = [], [], {}, []
    for ring in rings:
        key = frozenset(ring)
        if key in faces.count:
            on_solids.append(key)
        elif key in plates:
            on_plates.append(ring)
        elif key in faces.of_triple:
            halves.setdefault(faces.of_triple[key][0], []).append(ring)
        else:
            stray.append(ring)
    for key, parts in halves.items():
        if len(parts) > 1 and len(frozenset().union(*parts)) == 4:
            on_solids.append(key)
        else:
            stray += parts
    return list(dict.fromkeys(on_solids)), on_plates, stray


def without_boundaries(deck, faces, plates, said):
    """Makes surfaces of the triangles and quadrilaterals that a mesh generator wrote on faces of solids; returns the other ones."""
    kept = [element for element in plates if not faces.has(element.corners)]
    parts = by_part(kept)
    for part, found in by_part(element for element in plates if faces.has(element.corners)).items():
        name = deck.parts[part].name
        if part in parts:
            said.append(f"of '{name}', {kinds(found)} {'lies' if len(found) == 1 else 'lie'} on faces of solids: the surface "
                        f"'{name}_on_solids'; the others are plates")
        deck.add_group(f"{name}_on_solids" if part in parts else name, "surface", [e.corners for e in found], found[0].at)
    return kept


# ------------------------------------------------------------------------------------------------
# Cells

def is_folded(points, corners):
    """Whether a quadrilateral that is cut from its first corner to its third has halves that face away from each other."""
    a, b, c, d = (points[node] for node in corners)
    cut, to_b, to_d = ([x - o for x, o in zip(to, a)] for to in (c, b, d))
    first = (to_b[1] * cut[2] - to_b[2] * cut[1], to_b[2] * cut[0] - to_b[0] * cut[2], to_b[0] * cut[1] - to_b[1] * cut[0])
    other = (cut[1] * to_d[2] - cut[2] * to_d[1], cut[2] * to_d[0] - cut[0] * to_d[2], cut[0] * to_d[1] - cut[1] * to_d[0])
    return sum(x * y for x, y in zip(first, other)) < 0


def say_cuts(deck, plates, said):
    """Says how the program will cut quadrilaterals."""
    quads = [element for element in plates if len(element.corners) == 4]
    if not quads:
        return
    other = [e for e in quads if is_folded(deck.points, e.corners) and not is_folded(deck.points, e.corners[1:] + e.corners[:1])]
    text = f"the program cuts {counted(len(quads), PLATE_WORDS[4])} into two triangles each, from the first corner to the third"
    if other:
        text += f", but {len(other)} from the second to the fourth, since only that cut lies inside: {listed(e.number for e in other)}"
    said.append(text)


def kinds(elements):
    """How many elements of each kind there are, in words."""
    counts = {}
    for element in elements:
        words = PLATE_WORDS[len(element.corners)] if len(element.corners) < 8 else KIND_WORDS.get(len(set(element.corners)), KIND_WORDS[8])
        counts[words] = counts.get(words, 0) + 1
    return ", ".join(counted(count, words) for words, count in counts.items())


@dataclasses.dataclass
class Draft:
    """A mesh that is being made; index: the place of each node of the deck; of_plates: the corners of each plate."""
    deck: import_deck.Deck
    faces: Faces
    index: dict
    of_plates: set
    names: Names
    said: dict
    in_part: bool   # other parts are left out, so that what only they have is no loss
    as_sets: bool   # surfaces of solids are node sets, since cells on faces are plates
    cells: list = dataclasses.field(default_factory=list)
    numbers: list = dataclasses.field(default_factory=list)
    regions: list = dataclasses.field(default_factory=list)
    groups: dict = dataclasses.field(default_factory=dict)
    sets: dict = dataclasses.field(default_factory=dict)

    def add_cells(self, name, dimension, cells, numbers):
        self.groups[name] = (len(self.groups) + 1, dimension)
        self.cells += [[self.index[node] for node in cell] for cell in cells]
        self.numbers += numbers
        self.regions += [self.groups[name][0]] * len(cells)


def made(deck, in_part=False):
    """The result of a deck without faults, of which some parts may be left out."""
    said = {"nodes": [], "regions": [], "surfaces": [], "node sets": [], "names": [], "notes": list(deck.notes)}
    solids, plates = ([e for e in deck.elements if (len(e.corners) == 8) == is_solid] for is_solid in (True, False))
    touched = {node for element in plates for node in element.corners}
    touched |= {node for group in deck.groups if group.kind == "surface" for ring in group.of for node in ring}
    faces = Faces(solids, touched)
    if deck.plates_or_boundaries:
        plates = without_boundaries(deck, faces, plates, said["notes"])
    on_faces = plates_on_faces(deck, solids, plates)
    if on_faces:
        said["notes"].append(
            f"{counted(len(on_faces), ('plate lies', 'plates lie'))} on faces of solids ({listed(e.number for e in on_faces)}). With "
            "'boundary_cells: plates' in the section mesh of the case they are plates; without it the program makes surfaces of plates "
            "that share the nodes, and refuses others. Surfaces of solids in this file are node sets, since that key holds for all cells")
    used = {node for element in (*solids, *plates) for node in element.corners}
    order = [node for node in deck.points if node in used]
    draft = Draft(deck, faces, {node: i for i, node in enumerate(order)}, {frozenset(element.corners) for element in plates},
                  Names(said["names"], bool(solids), bool(plates)), said, in_part, bool(on_faces))
    add_regions(draft, solids, plates)
    for group in deck.groups:  # surfaces before sets: they keep their names
        if group.kind == "surface":
            add_surface(draft, group)
    for group in deck.groups:
        if group.kind != "surface":
            add_set(draft, group.name, group.kind, group.of, group.at)
    said["nodes"].append(f"{counted(len(order), ('node', 'nodes'))}, {kinds([*solids, *plates])}")
    lonely = [] if in_part else [node for node in deck.points if node not in used]
    if lonely:
        said["notes"].append(f"{counted(len(lonely), ('node is', 'nodes are'))} left out, since no element has "
                             f"{'it' if len(lonely) == 1 else 'them'}: {listed(lonely)}")
    say_cuts(deck, plates, said["notes"])
    if any(is_tetrahedron(element) for element in solids):
        said["notes"].append("tetrahedra are hexahedra with coincident corners, which are too stiff where they are many")
    mesh = mesh_files.Mesh([list(deck.points[node]) for node in order], draft.cells, draft.sets,
                           {"region": draft.regions, "number_in_deck": draft.numbers}, draft.groups)
    return Result(mesh, said)


def by_part(elements):
    found = {}
    for element in elements:
        found.setdefault(element.part, []).append(element)
    return found


def add_regions(draft, solids, plates):
    """A region for each part: two where a part has solids and plates."""
    of_solids, of_plates = by_part(solids), by_part(plates)
    for part, found, dimension in [*((*one, 3) for one in of_solids.items()), *((*one, 2) for one in of_plates.items())]:
        title, remark = draft.deck.parts[part]
        name = draft.names.give(f"{title}_plates" if dimension == 2 and part in of_solids else title, "region",
                                (node for element in found for node in element.corners))
        draft.add_cells(name, dimension, [element.corners for element in found], [float(element.number) for element in found])
        draft.said["regions"].append(f"{name}: {kinds(found)}" + (f" ({remark})" if remark else ""))


def add_surface(draft, group):
    """Boundary cells where a surface has whole faces of solids alone; else the node set of its nodes, with a note."""
    on_solids, on_plates, stray = sorted_faces(draft.faces, draft.of_plates, group.of)
    notes, name = draft.said["notes"], group.name
    if draft.in_part:
        here = [ring for ring in stray if all(node in draft.index for node in ring)]
        if len(here) < len(stray):
            draft.deck.leave_out(f"{counted(len(stray) - len(here), ('face', 'faces'))} of the surface '{name}'", group.at)
        stray = here
    if stray:
        notes.append(f"the surface '{name}' ({group.at}) has {counted(len(stray), ('face that is', 'faces that are'))} no whole face of an "
                     "element: its nodes are a node set")
    if on_plates:
        notes.append(f"the surface '{name}' has {counted(len(on_plates), ('face', 'faces'))} of plates: their nodes are a node set, for "
                     "which the program makes the surfaces _top and _bottom")
    nodes = [node for ring in (*on_plates, *stray) for node in ring]
    rings = [draft.faces.ring_of[key] for key in on_solids]
    if stray or draft.as_sets:
        nodes += [node for ring in rings for node in ring]
        rings = []
    if rings:
        given = draft.names.give(name, "surface", (node for ring in rings for node in ring))
        draft.add_cells(given, 2, rings, [NO_NUMBER] * len(rings))
        inner = sum(draft.faces.count[key] > 1 for key in on_solids)
        draft.said["surfaces"].append(f"{given}: {counted(len(rings), ('face', 'faces'))}"
                                      + (f", {inner} of them inside the body, for its node set alone" if inner else ""))
    if nodes or not rings:
        add_set(draft, f"{name}_plates" if rings else name, "node set" if rings else "surface", nodes, group.at)


def add_set(draft, name, kind, nodes, at):
    """An array of 0 and 1 of the nodes that elements have."""
    nodes = dict.fromkeys(nodes)
    within = [node for node in nodes if node in draft.index]
    if not within:
        if draft.in_part:
            draft.deck.leave_out(f"the {kind} '{name}'", at)
        else:
            draft.said["notes"].append(f"the {kind} '{name}' is left out: it has no node of an element")
        return
    given = draft.names.give(name, kind, within)
    if given is None:
        return
    flags = [0] * len(draft.index)
    for node in within:
        flags[draft.index[node]] = 1
    draft.sets[given] = flags
    outside = len(nodes) - len(within)
    draft.said["node sets"].append(f"{given}: {counted(len(within), ('node', 'nodes'))}"
                                   + (f"; {counted(outside, ('more is', 'more are'))} of no element here" if outside else ""))
