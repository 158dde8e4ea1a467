"""The mesh of a keyword file of LS-DYNA. What is read stands in docs/meshes.md."""
import re
import typing
from pathlib import Path

import import_deck

CHANGE_MESH = {"*NODE_TRANSFORM", "*NODE_MERGE_SET", "*NODE_MERGE_TOLERANCE", "*NODE_MERGE", "*NODE_SCALAR", "*NODE_RIGID_SURFACE",
               "*INCLUDE_TRANSFORM", "*INCLUDE_TRANSFORM_BINARY", "*INCLUDE_STAMPED_PART", "*INCLUDE_BINARY", "*ELEMENT_GENERATE_SHELL",
               "*ELEMENT_GENERATE_SOLID", "*NODE_GENERATE", "*PART_MOVE", "*PART_DUPLICATE", "*PART_STACKED_ELEMENTS"}
EXTRA_OF_SHELL = {"THICKNESS": "layer", "BETA": "layer", "MCID": "layer", "OFFSET": "offset", "DOF": "dof"}  # a line for each kind
EXTRA_OF_PART = {"CONTACT": 1, "PRINT": 1, "INERTIA": 3}
# Words behind *PART of keywords that give parts; with others, as in *PART_SENSOR, a keyword speaks of parts that are there.
OPTIONS_OF_PART = {*EXTRA_OF_PART, "REPOSITION", "ATTACHMENT", "NODES", "AVERAGED", "FIELD", "COMPOSITE", "TSHELL", "LONG"}
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
    mode = name = ""
    nameless = None  # the place of an *INCLUDE until its name comes
    for place, text in import_deck.read_lines(deck, path, at):
        if text.startswith("$") or mode and not text.strip():
            continue
        if text.startswith("*"):
            word = text.split()[0].upper()
            if nameless:
                deck.fault(nameless, "includes a file without a name")
            nameless = place if word == "*INCLUDE" else None
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
        nameless = None
        if mode == "*INCLUDE":
            file = import_deck.included(deck, name, folders, place, depth)
            if file:
                yield from lines_of(deck, file, folders, place, depth + 1)
        elif name:
            folders.append(Path(path).parent / name if mode.endswith("RELATIVE") else Path(name))
        name = ""
    if nameless:
        deck.fault(nameless, "includes a file without a name")


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
    return import_deck.wholes(reader.deck, words, at, f"{what}; see the widths of the fields")


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
        for at, text in filled(block):
            deck.others.append(import_deck.Other(cut(block, text, [8])[0] or "?", keyword, at))
    elif keyword.split("_")[0] == "*PART" and OPTIONS_OF_PART.issuperset(keyword.split("_")[1:]):
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


def elements_of(reader, block, extra, two=False):
    """[(place, fields)] of the elements of a block: `extra` lines behind each, which may be blank, are passed over.

    two  number and part may stand on a line of their own, before the nodes
    """
    cards, found = list(block.cards), []
    while cards:
        at, text = cards.pop(0)
        if not text.strip():
            continue
        words = cut(block, text, [8] * 10)
        if two and not any(words[2:]):
            if not cards or not cards[0][1].strip():
                reader.deck.fault(at, f"element {words[0]} has no nodes; expected is a line with eight of them")
                break
            words = words[:2] + cut(block, cards.pop(0)[1], [8] * 10)
        if len(cards) < extra:
            reader.deck.fault(at, f"behind element {words[0]} of {block.keyword} stand {len(cards)} lines; expected are {extra}")
            break
        del cards[:extra]
        found.append((at, words))
    return found


def head_of(reader, words, at):
    """(number, part, [nodes]) of the fields of an element; None is a fault."""
    numbers = wholes(reader, words, at, "the number of an element, part or node")
    if numbers is None:
        return None
    if numbers[0] < 1:
        reader.deck.fault(at, f"'{words[0]}' is no number of an element; see the widths of the fields")
        return None
    return numbers[0], numbers[1], numbers[2:]


def few_nodes(reader, number, nodes, at, expected):
    there = import_deck.counted(sum(node != 0 for node in nodes), ("node", "nodes"))
    reader.deck.fault(at, f"element {number} has {there}; expected are {expected}")


def add_solids(reader, block):
    """Cards of one line: number, part, eight nodes; or of two: number and part, then up to ten nodes."""
    kind = "tshell" if "TSHELL" in block.keyword else "solid"
    extra = 2 if "_ORTHO" in block.keyword else 1 if "_BETA" in block.keyword else 0
    for at, words in elements_of(reader, block, extra, two=True):
        head = head_of(reader, words[:12], at)
        if head is None:
            continue
        number, part, nodes = head
        if any(nodes[8:]):
            reader.deck.others.append(import_deck.Other(number, f"{block.keyword} of ten nodes", at))
        elif 0 in nodes[:8]:
            few_nodes(reader, number, nodes[:8], at, "eight, some of them more than once in wedges")
        else:
            add_element(reader, kind, import_deck.Element(number, import_deck.solid(tuple(nodes[:8])), part, block.keyword, at))


def add_shells(reader, block):
    """Cards of one line: number, part, four nodes; lines of thickness, offset and degrees of freedom behind are passed over."""
    options = block.keyword.split("_")[2:]
    if "THICKNESS" in options:
        reader.deck.leave_out(f"{block.keyword}: thickness", block.at)
    for at, words in elements_of(reader, block, len({EXTRA_OF_SHELL[option] for option in options})):
        head = head_of(reader, words[:10], at)
        if head is None:
            continue
        number, part, nodes = head
        if any(nodes[4:]):
            reader.deck.others.append(import_deck.Other(number, f"{block.keyword} of eight nodes", at))
        elif 0 in nodes[:3]:
            few_nodes(reader, number, nodes[:4], at, "three or four")
        else:
            add_element(reader, "shell", import_deck.Element(number, import_deck.plate(nodes[:4]), part, block.keyword, at))


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
        if found and found[0] < 1:
            reader.deck.fault(at, f"the part '{title}' has no number; expected are a line with its name and one with its number")
            return
        if found:
            if found[0] in reader.titles:
                reader.deck.fault(at, f"part {found[0]} is given twice")
            material = "composite" if "COMPOSITE" in options else f"material {cut(block, text, [10] * 3)[2] or 0}"
            reader.titles[found[0]] = import_deck.Part(title or f"part_{found[0]}", f"part {found[0]}, {material}")
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
        reader.deck.add_group(name, "surface", faces, block.at)
    elif "GENERAL" in options:
        add_general(reader, block, name, cards)
    else:
        members = []
        for at, text in cards:
            words = cut(block, text, [10] * 8)
            found = wholes(reader, words[:1] if options == ["COLUMN"] else words, at, "numbers")
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
        found = wholes(reader, [one for one in numbers if one], at, "numbers")
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
    left_out = {(other.word.split("_")[1].split(" ")[0], str(other.number)) for other in deck.others}
    for name, what, members, at in reader.sets:
        nodes, without, missing = [], set(), []
        for kind, number, place in members:
            found = nodes_of(reader, kind, number)
            if found is None and (kind, str(number)) not in left_out:
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
