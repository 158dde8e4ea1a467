"""The mesh of a starter file of Radioss, NAME_0000.rad, of version 5.1 or later. What is read stands in docs/meshes.md."""
import re
import typing
from pathlib import Path

import import_deck

OLDEST = 51           # version from which on fields have 10 and 20 columns
SOLIDS = {"BRICK": 8, "PENTA6": 6, "TETRA4": 4}
PLATES = {"SHELL": 4, "SH3N": 3}
# Other elements, with how many lines each has.
OTHERS = {"BRIC20": 3, "TETRA10": 2, "SHEL16": 2,
          **dict.fromkeys(("QUAD", "TRIA", "BEAM", "TRUSS", "SPRING", "SPHCEL", "XELEM", "RIVET"), 1)}
# Groups of elements: which types they hold, and what the word behind them is where they are given by number.
OF_GROUP = {"GRBRIC": ("BRICK", "PENTA6", "TETRA4"), "GRSHEL": ("SHELL",), "GRSH3N": ("SH3N",)}
BY_NUMBER = {"GRBRIC": "BRIC", "GRSHEL": "SHEL", "GRSH3N": "SH3N", "GRNOD": "NODE", "GRPART": "PART"}
GROUPS = {"GRNOD", "GRPART", "SURF", *OF_GROUP}
CHANGE_MESH = {"TRANSFORM", "/SUBMODEL", "MERGE"}
SILENT = {"TITLE", "/ENDSUB"}


class Block(typing.NamedTuple):
    """The words of a keyword in capitals and its lines without comments."""
    words: list
    at: import_deck.Place
    cards: list


class Group(typing.NamedTuple):
    """A group or surface as it is given: by which word, and its numbers with their places."""
    name: str
    by: str
    numbers: list
    at: import_deck.Place


class Reader:
    """What is read of the blocks until all of them are there."""

    def __init__(self, deck):
        self.deck = deck
        self.elements = {}  # {(type, number): Element}
        self.by_part = {}   # {part: its elements}
        self.titles = {}    # {part: Part}
        self.groups = {}    # {(kind, number): Group}
        self.open = []      # groups that are being looked up


# ------------------------------------------------------------------------------------------------
# Text

def lines_of(deck, path, top, at=None, depth=0):
    """[(place, text)] of a file without comments, with the files that it includes in their places; ends at /END."""
    for place, text in import_deck.read_lines(deck, path, at):
        found = re.match(r"#include\s+(.*)", text, re.IGNORECASE)
        if found:
            file = import_deck.included(deck, found[1].strip().strip('"'), (path.parent, top), place, depth)
            if file:
                yield from lines_of(deck, file, top, place, depth + 1)
        elif text.upper().startswith("#ENDDATA") or text.upper().strip() == "/END":
            return
        elif not text.startswith(("#", "$")):
            yield place, text


def blocks(deck, path):
    block = None
    for place, text in lines_of(deck, path, path.parent):
        if text.startswith("/"):
            if block:
                yield block
            block = Block([word.strip().upper() for word in text.strip()[1:].split("/")], place, [])
        elif block:
            block.cards.append((place, text))
        elif text.strip():
            deck.fault(place, "data without a keyword before them; expected is a line that begins with '/'")
    if block:
        yield block


def wholes(deck, words, at, what):
    return import_deck.wholes(deck, words, at, f"{what} in 10 columns")


# ------------------------------------------------------------------------------------------------
# Blocks

def read(path):
    """The deck of a file."""
    deck = import_deck.Deck(Path(path).name)
    reader = Reader(deck)
    for block in blocks(deck, Path(path)):
        take_block(reader, block)
    for part, elements in reader.by_part.items():
        deck.parts[part] = reader.titles.get(part, import_deck.Part(f"part_{part}", "without /PART"))
        deck.elements += elements
    add_groups(reader)
    return deck


def take_block(reader, block):
    deck, word = reader.deck, block.words[0] or "/".join(block.words[:2])
    keyword = "/" + "/".join(one for one in block.words[:2] if not one.isdecimal())
    if word == "BEGIN":
        begin(deck, block)
    elif word in CHANGE_MESH:
        deck.fault(block.at, f"{keyword} changes the mesh and is not read; write the mesh out in full")
    elif word == "NODE":
        if len(block.words) > 1 and block.words[1]:
            deck.fault(block.at, "/NODE with units of its own is not read; write it in the units of /BEGIN")
            return
        for at, text in block.cards:
            add_node(deck, at, text)
    elif word in SOLIDS or word in PLATES:
        add_elements(reader, block)
    elif word in OTHERS:
        for at, text in [card for card in block.cards if card[1].strip()][::OTHERS[word]]:
            deck.others.append(import_deck.Other(import_deck.fields(text, [10])[0], f"/{word}", at))
    elif word == "PART":
        add_part(reader, block)
    elif word in GROUPS:
        add_group(reader, block)
    elif word not in SILENT:
        deck.leave_out(keyword, block.at)


def begin(deck, block):
    """The version, and the units of the file, which are told."""
    cards = block.cards
    version = wholes(deck, import_deck.fields(cards[1][1], [10])[:1], cards[1][0], "the version") if len(cards) > 1 else None
    if version and 0 < version[0] < OLDEST:
        deck.fault(cards[1][0], f"version {version[0]}: fields of 8 and 16 columns are not read; expected is version {OLDEST} or later")
    if len(cards) > 2 and cards[2][1].strip():
        mass, length, time = import_deck.fields(cards[2][1], [20, 20, 20])[:3]
        deck.notes.append(f"the file says that lengths are in {length} (masses in {mass}, times in {time})")


def add_node(deck, at, text):
    if not text.strip():
        return
    words = import_deck.fields(text, (10, 20, 20, 20))
    number = wholes(deck, words[:1], at, "the number of a node")
    position = tuple(import_deck.real(deck, word, at, "a coordinate in 20 columns") for word in words[1:4])
    if number and number[0] < 1:
        deck.fault(at, f"'{words[0]}' is no number of a node; fields have 10 and 20 columns")
    elif number and None not in position:
        deck.add_point(number[0], position, at)


def add_elements(reader, block):
    deck, word = reader.deck, block.words[0]
    count = SOLIDS.get(word) or PLATES[word]
    part = wholes(deck, block.words[1:2] or ["x"], block.at, "the number of a part, as in /BRICK/1,")
    if part is None:
        return
    for at, text in block.cards:
        if not text.strip():
            continue
        numbers = wholes(deck, import_deck.fields(text, [10] * (count + 1))[:count + 1], at, "the number of an element or a node")
        if numbers is None:
            continue
        number, nodes = numbers[0], tuple(numbers[1:])
        corners = import_deck.solid(nodes) if word in SOLIDS else import_deck.plate(nodes)
        if number < 1:
            deck.fault(at, f"{number} is no number of an element; fields have 10 columns")
        elif 0 in corners:
            there = import_deck.counted(sum(node != 0 for node in nodes), ("node", "nodes"))
            deck.fault(at, f"element {number} has {there}; expected are {count}")
        elif (word, number) in reader.elements:
            deck.fault(at, f"element {number} is given twice, before at {reader.elements[word, number].at}")
        else:
            element = import_deck.Element(number, corners, part[0], f"/{word}", at)
            reader.elements[word, number] = element
            reader.by_part.setdefault(part[0], []).append(element)


def add_part(reader, block):
    number = wholes(reader.deck, block.words[1:2] or ["x"], block.at, "the number of a part, as in /PART/1,")
    if number is None:
        return
    title = block.cards[0][1].strip() if block.cards else ""
    material = import_deck.fields(block.cards[1][1], [10, 10])[1] if len(block.cards) > 1 else ""
    if number[0] in reader.titles:
        reader.deck.fault(block.at, f"part {number[0]} is given twice")
    reader.titles[number[0]] = import_deck.Part(title or f"part_{number[0]}", f"part {number[0]}, material {material or 0}")


def add_group(reader, block):
    """/GRNOD/NODE/7: a title, then numbers; they are looked up when all blocks are read."""
    deck, kind = reader.deck, block.words[0]
    by = [word for word in block.words[1:] if not word.isdecimal()]
    numbers = [word for word in block.words[1:] if word.isdecimal()]
    if not by or not numbers:
        deck.fault(block.at, f"/{'/'.join(block.words)} has no number; expected is /{kind}/{by[0] if by else 'NODE'}/NUMBER")
        return
    of_elements = [*OF_GROUP] if kind == "GRNOD" else [kind] if kind in OF_GROUP else []
    known = {"GRNOD": {"NODE", "PART", "GRNOD", "GENE", "GEN_INCR", "SURF", "GRPART", *of_elements}, "GRPART": {"PART", "GRPART"},
             "SURF": {"SEG", "PART", "SURF", "GRSHEL", "GRSH3N"}}.get(kind, {BY_NUMBER.get(kind), "PART", "GRPART", kind})
    if by[0] not in known or by[1:] and not (kind == "SURF" and by == ["PART", "EXT"]):
        deck.leave_out(f"/{kind}/{'/'.join(by)}", block.at)
        return
    title = block.cards[0][1].strip() if block.cards else ""
    rows = []
    for at, text in block.cards[1:]:
        found = wholes(deck, import_deck.fields(text, [10] * (5 if by[0] == "SEG" else 10))[:10], at, "numbers")
        if found and any(found):
            rows.append((at, found))
    usual = {"GRNOD": "nodes", "SURF": "surface", "GRPART": "parts"}.get(kind, "elements")
    key = (kind, int(numbers[0]))
    if key in reader.groups:
        deck.fault(block.at, f"/{kind} {numbers[0]} is given twice, before at {reader.groups[key].at}")
    reader.groups[key] = Group(title or f"{usual}_{numbers[0]}", by[0], rows, block.at)


# ------------------------------------------------------------------------------------------------
# Numbers looked up

def add_groups(reader):
    for (kind, number), group in reader.groups.items():
        found = members(reader, kind, number, group.at)
        if kind == "SURF":
            reader.deck.add_group(group.name, "surface", found, group.at)
        elif kind == "GRNOD":
            reader.deck.add_group(group.name, "node set", found, group.at)
        else:
            elements = [one for part in found for one in reader.by_part.get(part, [])] if kind == "GRPART" else found
            reader.deck.add_group(group.name, "element set", [node for one in elements for node in one.corners], group.at)


def members(reader, kind, number, at):
    """Nodes of a GRNOD, faces of a SURF, numbers of parts of a GRPART, elements of the other groups; negative numbers take away."""
    group = reader.groups.get((kind, number))
    if group is None:
        reader.deck.fault(at, f"there is no /{kind} {number}")
        return []
    if (kind, number) in reader.open:
        reader.deck.fault(group.at, f"/{kind} {number} contains itself")
        return []
    reader.open.append((kind, number))
    found, without = [], set()
    for place, row in group.numbers:
        if group.by == "SEG":
            found.append(import_deck.plate(row[1:5]))
        elif group.by in ("GENE", "GEN_INCR"):
            wide = 2 if group.by == "GENE" else 3
            for i in range(0, len(row) - wide + 1, wide):
                first, last, step = (*row[i:i + wide], 1)[:3]
                found += [node for node in reader.deck.points if first <= node <= last and (node - first) % max(step, 1) == 0]
        else:
            for one in row:
                more = of_number(reader, kind, group.by, abs(one), place) if one else []
                without.update(more if one < 0 and kind != "SURF" else [])
                found += more if one > 0 or kind == "SURF" else []
    reader.open.pop()
    return [one for one in found if one not in without]


def left_out_solids(deck):
    return {int(other.number) for other in deck.others if other.word in ("/BRIC20", "/TETRA10", "/SHEL16") and other.number.isdecimal()}


def of_number(reader, kind, by, number, at):
    """What a number of a group means: see members()."""
    deck = reader.deck
    if by == "NODE":
        if number not in deck.points:
            deck.fault(at, f"there is no node {number}")
        return [number] if number in deck.points else []
    if by == "PART":
        if number not in reader.by_part and number not in reader.titles:
            deck.fault(at, f"there is no part {number}")
        if kind == "GRPART":
            return [number]
        elements = reader.by_part.get(number, [])
    elif by == "GRPART" and kind == "GRPART":
        return members(reader, by, number, at)
    elif by == "GRPART":
        elements = [one for part in members(reader, by, number, at) for one in reader.by_part.get(part, [])]
    elif by == BY_NUMBER.get(kind):
        elements = [reader.elements[word, number] for word in OF_GROUP[kind] if (word, number) in reader.elements]
        if not elements and number not in (left_out_solids(deck) if kind == "GRBRIC" else ()):
            deck.fault(at, f"there is no element {number} of /{' or /'.join(OF_GROUP[kind])}")
    elif by == "SURF":
        faces = members(reader, by, number, at)
        return [node for face in faces for node in face] if kind == "GRNOD" else faces
    else:
        elements = members(reader, by, number, at)
        if by == kind:
            return elements
    if kind == "GRNOD":
        return [node for one in elements for node in one.corners]
    if kind == "SURF":
        return import_deck.outer_faces(elements)
    return [one for one in elements if one.word[1:] in OF_GROUP[kind]]
