#!/usr/bin/env python3
"""Words of case files that changed: the one table that scripts/update_case, scripts/house.py and docs/notation.md go by.

    scripts/words.py    prints the table in Markdown

A reader of case files that knows the same table can be tested against RENAMED: each entry says an old word, its new one, whether it is
a key or the value of a key, and in which sections of a case it stands.
"""
import dataclasses
import re

# Sections in which a contact is described: of a scene, of the drivers, and the rigid planes of a scene.
CONTACTS = ("contacts[]", "contact", "interface", "base")
PLANES = ("planes[]",)


@dataclasses.dataclass(frozen=True)
class Renamed:
    """A word of case files with a new name.

    where    sections of the case in which it stands, with [] for any place in a list
    key      "" if the word is itself a key; else the key whose value it is
    means    what it stands for, for the table of words
    refuse   what gives the old word away in any text of the tree; "" where it is an English word as well, so that only its place does
    """
    old: str
    new: str
    where: tuple
    means: str
    key: str = ""
    refuse: str = ""


RENAMED = (
    Renamed("hardness", "penalty_scale", (*CONTACTS, *PLANES),
            "penalty scale factor: penalty stiffness over that of the elements beside it", refuse=r"\bhardness\b"),
    Renamed("stick", "tangential_penalty", (*CONTACTS, *PLANES), "tangential penalty over the normal one"),
    Renamed("damping", "damping_ratio", CONTACTS, "damping ratio of the normal penalty"),
    Renamed("created_in_a_bounce", "energy_gain_limit", (*CONTACTS, *PLANES), "energy that one impact may create, over that of the impact",
            refuse=r"\bcreated_in_a_bounce\b"),
    Renamed("turn", "rotate", ("bodies[]",), "rotation of a body before the start: axis, angle and centre"),
    Renamed("turning", "angular_velocity", PLANES, "angular velocity of driven nodes of plates"),
    Renamed("bonded", "tied", CONTACTS, "bodies whose surfaces are joined", key="kind"),
    Renamed("held", "constrained", PLANES, "nodes constrained along a normal", key="kind"),
)

# Whether the old words are refused in this tree: False until code, cases and pages have the new ones.
RETIRED = True


def places(one):
    """Patterns of text with the old word as their group `word`: contacts[0].hardness, planes[{i}].kind=held."""
    found = []
    for section in one.where:
        name, brackets = re.escape(section.removesuffix("[]")), r"\[[^\]\n]*\]" if section.endswith("[]") else ""
        start = rf"(?<![\w.]){name}{brackets}\."
        found.append(rf"{start}{one.key}\b[\"'`]?\s*[:=]\s*[\"']?(?P<word>{one.old})\b" if one.key else rf"{start}(?P<word>{one.old})\b")
    return found


def table():
    """The lines of the table in Markdown."""
    lines = ["| word | was | in | meaning |", "|---|---|---|---|"]
    for one in RENAMED:
        new, old = (f"`{one.key}: {word}`" if one.key else f"`{word}`" for word in (one.new, one.old))
        lines.append(f"| {new} | {old} | {', '.join(f'`{section}`' for section in one.where)} | {one.means} |")
    return lines


if __name__ == "__main__":
    print("\n".join(table()))
