"""What the decks for CalculiX of several cases share: the command, lines of a deck, and the tables of a .dat file.

CalculiX CrunchiX (Dhondt & Wittig, www.calculix.de) is free software under the GPL and used as a program: nothing of it is in this tree.
Debian has it as the package calculix-ccx.
"""
import argparse
import re


def main(doc, deck, numbers):
    """The command of every deck.py: prints deck(cells), or what numbers(cells, tables) says about the .dat file of that deck."""
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cells", type=count, help="how fine the mesh is, 1 to 64")
    parser.add_argument("dat", nargs="?", help="what ccx wrote about the same deck")
    options = parser.parse_args()
    if not options.dat:
        print("\n".join(deck(options.cells)))
        return
    try:
        with open(options.dat, encoding="ascii") as file:
            print("\n".join(numbers(options.cells, tables(file.read()))))
    except (OSError, UnicodeDecodeError, LookupError) as error:
        parser.error(f"{options.dat}: expected is the .dat file of `ccx` with the deck of {options.cells} cells; {error!r}")


def count(text):
    """
    >>> count("8")
    8
    """
    if not text.isdecimal() or not 1 <= int(text) <= 64:
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number from 1 to 64")
    return int(text)


def members(kind, name, numbers):
    """A set of nodes (NSET) or of elements (ELSET).

    >>> members("NSET", "RIM", [3, 7])
    ['*NSET, NSET=RIM', '3,', '7,']
    """
    return [f"*{kind}, {kind}={name}", *(f"{number}," for number in numbers)]


def elements(kind, name, cells):
    """
    >>> elements("CAX4", "RING", [(1, 2, 4, 3)])
    ['*ELEMENT, TYPE=CAX4, ELSET=RING', '1, 1, 2, 4, 3']
    """
    return [f"*ELEMENT, TYPE={kind}, ELSET={name}", *(f"{i}, " + ", ".join(map(str, nodes)) for i, nodes in enumerate(cells, 1))]


def tables(text):
    '''Of a .dat file the tables whose titles name a set and a time, in order: [(title, set, rows of numbers)].

    >>> tables("""
    ...  displacements (vx,vy,vz) for set POINTS and time  0.1000000E+01
    ...
    ...       17  1.000000E-03 -2.500000E-01  0.000000E+00
    ... """)
    [('displacements', 'POINTS', [[17.0, 0.001, -0.25, 0.0]])]
    '''
    found = []
    for line in text.splitlines():
        title = re.match(r" *([a-z ]+?) (?:\(.*\) )?for .*?set (\w+).* and time", line)
        words = line.split()
        if title:
            found.append((title[1], title[2], []))
        elif found and words and all(re.fullmatch(r"[-+]?[0-9.]+(E[-+][0-9]+)?", word) for word in words):
            found[-1][2].append([float(word) for word in words])
    return found


def last(found, title, of):
    """The rows of the last table with this title about this set."""
    rows = [rows for said, name, rows in found if said == title and name == of]
    if not rows:
        raise LookupError(f"no '{title} for set {of}'")
    return rows[-1]


def eight_nodes(across, up, first, place):
    """({(i, k): number}, lines, cells) of across x up quadrilaterals of eight nodes; place(s, t) of the unit square gives two coordinates.

    >>> number, lines, cells = eight_nodes(1, 1, 5, lambda s, t: (2 * s, 3 * t))
    >>> lines[0], lines[-1], cells
    ('5, 0, 0, 0', '12, 2, 3, 0', [[5, 10, 12, 7, 8, 11, 9, 6]])
    """
    used = [(i, k) for i in range(2 * across + 1) for k in range(2 * up + 1) if not (i % 2 and k % 2)]
    number = {place: first + j for j, place in enumerate(used)}
    lines = [f"{n}, " + ", ".join(f"{x:.10g}" for x in place(i / (2 * across), k / (2 * up))) + ", 0" for (i, k), n in number.items()]
    ring = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    return number, lines, [[number[2 * i + a, 2 * k + b] for a, b in ring] for i in range(across) for k in range(up)]
