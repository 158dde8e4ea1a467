"""The mesh of a keyword file of LS-DYNA. What is read stands in docs/meshes.md."""
import re
import typing
from pathlib import Path

import import_deck

CHANGE_MESH = {"*NODE_TRANSFORM", "*NODE_MERGE_SET", "*NODE_MERGE_TOLERANCE", "*NODE_MERGE", "*NODE_SCALAR", "*NODE_RIGID_SURFACE",
               "*INCLUDE_TRANSFORM", "*INCLUDE_TRANSFORM_BINARY", "*INCLUDE_STAMPED_PART", "*INCLUDE_BINARY", "*ELEMENT_GENERATE_SHELL",
               "*ELEMENT_GENERATE_SOLID", "*NODE_GENERATE"}
EXTRA_OF_SHELL = {"THICKNESS": "layer", "BETA": "layer", "MCID": "layer", "OFFSET": "offset", "DOF": "dof"}  # a line for each kind
EXTRA_OF_PART = {"CONTACT": 1, "PRINT": 1, "INERTIA": 3}
LONG = 20   # columns of a field of the long format


class Block(typing.NamedTuple):
    """A keyword in capitals, its lines without comments, and how wide its fields are: long, or numbers of 10 columns."""
    keyword: str
    at: import_deck.Place
    cards: list
    long: bool
    ten: bool


class Reader:
    """What is read of the blocks until all of them are there."""

    def __init__(self, deck):
        self.deck = deck
        self.elements = {}     # {(class, number): Element}
        self.by_part = {}      # {part: its elements}
        self.sets = []         # (name, kind, [members], place); a member is (what, number or range, place)
        self.titles = {}       # {part: Part}


# ------------------------------------------------------------------------------------------------
# Text

def lines_of(deck, path, folders, at=None, depth=0):
    """[(place, text)] of a file, with the files that it includes in their places; ends at *END."""
    mode = ""
    name = ""
    for place, text in import_deck.read_lines(deck, path, at):
        if text.startswith("$") or not text.strip() and not mode:
            if not text.startswith("$"):
                yield place, text
            continue
        if text.startswith("*"):
            word = text.split()[0].upper()
            if word == "*END":
                return
            mode = word if word in ("*INCLUDE", "*INCLUDE_PATH", "*INCLUDE_PATH_RELATIVE") else ""
            if not mode:
                yield place, text
            continue
        if not mode:
            yield place, text
            continue
        name += text.strip()
        if name.endswith(" +"):
            name = name[:-2]
            continue
        if mode == "*INCLUDE":
            file = import_deck.included(deck, name, folders, place, depth)
            if file:
                yield from lines_of(deck, file, folders, place, depth + 1)
        elif name:
            folders.append(Path(path).parent / name if mode.endswith("RELATIVE") else Path(name))
        name = ""


def blocks(deck, path):
    """The blocks of a file and of those that it includes."""
    long = ten = False
    block = None
    for place, text in lines_of(deck, path, [path.parent]):
        if not text.startswith("*"):
            if block:
                block.cards.append((place, text))
            elif text.strip():
                deck.fault(place, "data without a keyword before them; expected is a line that begins with '*'")
            continue
        if block:
            yield block
        word, *behind = text.split()
        word, behind = word.upper(), "".join(behind).upper()
        if word == "*KEYWORD":
            long = long or bool(re.search(r"LONG=[YK]", behind))
            ten = ten or "I10=Y" in behind
        sign = behind[:1] or word[-1:]
        block = Block(word.rstrip("+-%"), place, [], sign == "+" or long and sign != "-", sign == "%" or ten and sign != "-")
    if block:
        yield block


def cut(block, text, widths):
    """The fields of a card; whole numbers of 8 columns have 10 in the wide format, and all have 20 in the long one."""
    if block.long:
        widths = [LONG] * len(widths)
    elif block.ten:
        widths = [10 if width == 8 else width for width in widths]
    return import_deck.fields(text, widths)


def wholes(reader, words, at, what):
    """Whole numbers, nothing is 0; None where one is no number, which is a fault."""
    try:
        return [int(word) if word else 0 for word in words]
    except ValueError:
        pass
    found = [import_deck.whole(reader.deck, word or "0", at, f"{what}; see the widths of the fields") for word in words]
    return None if None in found else found


# ------------------------------------------------------------------------------------------------
# Blocks

def read(path):
    """The deck of a file."""
    deck = import_deck.Deck(Path(path).name)
    reader = Reader(deck)
    for block in blocks(deck, Path(path)):
        take_block(reader, block)
    for part, elements in reader.by_part.items():
        deck.parts[part] = reader.titles.get(part, import_deck.Part(f"part_{part}", "without *PART"))
        deck.elements += elements
    add_groups(reader)
    return deck


def take_block(reader, block):
    keyword, deck = block.keyword, reader.deck
    if keyword in CHANGE_MESH:
        deck.fault(block.at, f"{keyword} changes the mesh and is not read; write the mesh out in full")
    elif keyword == "*NODE":
        for at, text in block.cards:
            add_node(reader, block, at, text)
    elif re.match(r"\*ELEMENT_(SOLID|TSHELL)(_ORTHO|_BETA)?$", keyword):
        add_solids(reader, block)
    elif re.match(r"\*ELEMENT_SHELL(_(THICKNESS|BETA|MCID|OFFSET|DOF))*$", keyword):
        add_shells(reader, block)
    elif keyword.startswith("*ELEMENT_"):
        for at, text in block.cards:
            deck.others.append(import_deck.Other(cut(block, text, [8])[0] or "?", keyword, at))
    elif re.match(r"\*PART(_|$)", keyword):
        add_parts(reader, block)
    elif re.match(r"\*SET_(NODE|SHELL|SOLID|TSHELL|PART|SEGMENT)(_|$)", keyword):
        add_set(reader, block)
    elif keyword not in ("*KEYWORD", "*TITLE"):
        deck.leave_out(keyword, block.at)


def add_node(reader, block, at, text):
    if not text.strip():
        return
    words = cut(block, text, (8, 16, 16, 16))
    number = wholes(reader, words[:1], at, "the number of a node")
    position = tuple(import_deck.real(reader.deck, word, at, "a coordinate; see the widths of the fields") for word in words[1:4])
    if number and number[0] < 1:
        reader.deck.fault(at, f"'{words[0]}' is no number of a node; see the widths of the fields")
    elif number and None not in position:
        reader.deck.add_point(number[0], position, at)


def add_element(reader, kind, element):
    before = reader.elements.get((kind, element.number))
    if before:
        reader.deck.fault(element.at, f"element {element.number} is given twice, before at {before.at}")
        return
    reader.elements[kind, element.number] = element
    reader.by_part.setdefault(element.part, []).append(element)


def filled(block):
    """The cards of a block that are not blank."""
    return [(at, text) for at, text in block.cards if text.strip()]


def add_solids(reader, block):
    """Cards of one line: number, part, eight nodes; or of two: number and part, then up to ten nodes."""
    kind = "tshell" if "TSHELL" in block.keyword else "solid"
    extra = 2 if "_ORTHO" in block.keyword else 1 if "_BETA" in block.keyword else 0
    cards = filled(block)
    while cards:
        at, text = cards[0]
        words = cut(block, text, [8] * 10)
        two = not any(words[2:])
        taken = cards[:1 + two + extra]
        del cards[:1 + two + extra]
        if two:
            if len(taken) < 2:
                reader.deck.fault(at, f"element {words[0]} has no nodes; expected is a line with eight of them")
                return
            words = words[:2] + cut(block, taken[1][1], [8] * 10)
        numbers = wholes(reader, words[:12], at, "the number of an element, part or node")
        if numbers is None:
            continue
        number, part, nodes = numbers[0], numbers[1], numbers[2:10]
        if number < 1:
            reader.deck.fault(at, f"'{words[0]}' is no number of an element; see the widths of the fields")
        elif any(numbers[10:12]):
            reader.deck.others.append(import_deck.Other(number, f"{block.keyword} of ten nodes", at))
        elif 0 in nodes:
            reader.deck.fault(at, f"element {number} has {sum(node != 0 for node in nodes)} nodes; expected are eight, some of them "
                                  "more than once in wedges")
        else:
            add_element(reader, kind, import_deck.Element(number, import_deck.solid(tuple(nodes)), part, block.keyword, at))


def add_shells(reader, block):
    """Cards of one line: number, part, four nodes; lines of thickness, offset and degrees of freedom behind are passed over."""
    options = block.keyword.split("_")[2:]
    extra = len({EXTRA_OF_SHELL[option] for option in options})
    if "THICKNESS" in options:
        reader.deck.leave_out(f"{block.keyword}: thickness", block.at)
    cards = filled(block)
    if len(cards) % (1 + extra):
        reader.deck.fault(block.at, f"{block.keyword} has {len(cards)} lines; expected are {1 + extra} for each element")
        return
    for at, text in cards[::1 + extra]:
        numbers = wholes(reader, cut(block, text, [8] * 10)[:10], at, "the number of an element, part or node")
        if numbers is None:
            continue
        number, part, nodes = numbers[0], numbers[1], numbers[2:6]
        if number < 1:
            reader.deck.fault(at, f"{number} is no number of an element; see the widths of the fields")
        elif any(numbers[6:10]):
            reader.deck.others.append(import_deck.Other(number, f"{block.keyword} of eight nodes", at))
        elif 0 in nodes[:3]:
            reader.deck.fault(at, f"element {number} has {sum(node != 0 for node in nodes)} nodes; expected are three or four")
        else:
            add_element(reader, "shell", import_deck.Element(number, import_deck.plate(nodes), part, block.keyword, at))


def add_parts(reader, block):
    """A line with the name, one with the numbers of part, section and material; so again for each part of a plain *PART."""
    options = block.keyword.split("_")[1:]
    cards = list(block.cards)
    while cards and any(text.strip() for _, text in cards):
        title, numbers = cards[0][1].strip(), cards[1] if len(cards) > 1 else None
        if numbers is None:
            reader.deck.fault(cards[0][0], f"the part '{title}' has no line with its number")
            return
        at, text = numbers
        found = wholes(reader, cut(block, text, [10] * 3)[:1], at, "the number of a part")
        material = cut(block, text, [10] * 3)[2]
        if found and found[0] < 1:
            reader.deck.fault(at, f"the part '{title}' has no number; expected are a line with its name and one with its number")
            return
        if found:
            if found[0] in reader.titles:
                reader.deck.fault(at, f"part {found[0]} is given twice")
            reader.titles[found[0]] = import_deck.Part(title or f"part_{found[0]}", f"part {found[0]}, material {material or 0}")
        if any(option not in EXTRA_OF_PART for option in options):
            return  # lines of other options do not all have a known number
        skip = 2 + sum(EXTRA_OF_PART[option] for option in options)
        if "INERTIA" in options and len(cards) > 2 and cut(block, cards[2][1], [10] * 5)[4] == "1":
            skip += 1
        del cards[:skip]


# ------------------------------------------------------------------------------------------------
# Sets

def add_set(reader, block):
    """A set of nodes, elements, parts or segments; members are looked up when all blocks are read."""
    _, what, *options = block.keyword[1:].split("_")
    cards = filled(block) if "TITLE" not in options else list(block.cards)
    title = cards.pop(0)[1].strip() if "TITLE" in options and cards else ""
    if not cards:
        reader.deck.fault(block.at, f"{block.keyword} has no line with its number")
        return
    at, text = cards.pop(0)
    number = wholes(reader, cut(block, text, [10])[:1], at, "the number of a set")
    options = [option for option in options if option not in ("LIST", "TITLE")]
    if number is None:
        return
    if options not in ([], ["GENERATE"], ["COLUMN"], ["GENERAL"]) or "GENERAL" in options and what != "NODE":
        reader.deck.leave_out(block.keyword, block.at)
        return
    name = title or f"{what.lower()}s_{number[0]}"
    cards = [(at, text) for at, text in cards if text.strip()]
    if what == "SEGMENT":
        segments = [(at, wholes(reader, cut(block, text, [10] * 4)[:4], at, "the number of a node")) for at, text in cards]
        faces = [import_deck.plate(nodes) for _, nodes in segments if nodes]
        reader.deck.add_group(name, "surface", faces, at if not cards else block.at)
    elif "GENERAL" in options:
        add_general(reader, block, name, cards)
    else:
        members = []
        for at, text in cards:
            words = cut(block, text, [10] * 8)
            found = wholes(reader, words[:1] if options == ["COLUMN"] else words[:8], at, "numbers")
            if found and options == ["GENERATE"]:
                members += [(what, pair, at) for pair in zip(found[::2], found[1::2]) if pair != (0, 0)]
            else:
                members += [(what, one, at) for one in found or [] if one]
        reader.sets.append((name, what, members, block.at))


def add_general(reader, block, name, cards):
    """*SET_NODE_GENERAL: lines with a word and numbers."""
    members = []
    for at, text in cards:
        word, *numbers = cut(block, text, [10] * 8)
        word = word.upper()
        found = wholes(reader, [one for one in numbers[:7] if one], at, "numbers")
        if word not in ("ALL", "NODE", "PART", "DNODE", "DPART"):
            reader.deck.leave_out(f"{block.keyword}: lines of {word}", at)
        elif word == "ALL":
            members.append(("ALL", 0, at))
        else:
            members += [(word, one, at) for one in found or []]
    reader.sets.append((name, "NODE", members, block.at))


def add_groups(reader):
    """Sets of nodes, and those of the nodes of elements and parts; sets of element types that are left out stay out, too."""
    deck = reader.deck
    left_out = {str(other.number) for other in deck.others}
    for name, what, members, at in reader.sets:
        nodes, without, missing = [], set(), []
        for kind, number, place in members:
            found = nodes_of(reader, kind, number)
            if found is None and str(number) not in left_out:
                missing.append((place, kind, number))
            elif kind.startswith("D"):
                without.update(found or [])
            else:
                nodes += found or []
        for place, kind, number in missing:
            deck.fault(place, f"there is no {kind.lower().removeprefix('d')} {number}, which a set has")
        deck.add_group(name, "node set" if what == "NODE" else "element set", [node for node in nodes if node not in without], at)


def nodes_of(reader, kind, number):
    """The nodes that a member of a set means, or None if it is not there; numbers of a range that are not there are passed over."""
    kind = kind.removeprefix("D")
    if kind == "ALL":
        return list(reader.deck.points)
    if isinstance(number, tuple):
        table = {"NODE": reader.deck.points, "PART": reader.by_part}.get(kind)
        there = table if table is not None else [one for which, one in reader.elements if which == kind.lower()]
        return [node for one in there if number[0] <= one <= number[1] for node in nodes_of(reader, kind, one) or []]
    if kind == "NODE":
        return [number] if number in reader.deck.points else None
    if kind == "PART":
        if number not in reader.by_part and number not in reader.titles:
            return None
        return [node for element in reader.by_part.get(number, []) for node in element.corners]
    element = reader.elements.get((kind.lower(), number))
    return None if element is None else list(element.corners)
