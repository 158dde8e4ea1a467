"""The page of all keys, and the tables of results, columns and fields, from what programs say of themselves."""
import re

from keys_schema import range_of
from runs import PROGRAMS

RESULTS = "docs/results.md"
BEGIN, END = "<!-- written by scripts/keys: {} -->", "<!-- end of what scripts/keys writes -->"

# Sections of a scene in the order in which a case is written, with the words above their tables.
SECTIONS = [
    ("", "All cases", ("refine", "accuracy")),
    ("bodies[]", "Bodies", ()), ("bodies[].rotate", "", ()), ("bodies[].mass_properties", "", ()), ("bodies[].shape", "", ()),
    ("bodies[].start", "", ()), ("bodies[].points[]", "", ()), ("bodies[].sets[]", "", ()), ("bodies[].sets[].box", "", ()),
    ("bodies[].sets[].cylinder", "", ()), ("bodies[].sets[].sphere", "", ()), ("bodies[].sets[].plane", "", ()),
    ("bodies[].sets[].half_space", "", ()), ("bodies[].materials[]", "", ()),
    ("bodies[].mesh", "Meshes", ()),
    ("bodies[].material", "Materials", ()), ("bodies[].material.curve", "", ()), ("bodies[].material.curve.rates[]", "", ()),
    ("bodies[].material.cowper_symonds", "", ()),
    ("bodies[].element", "Elements", ()), ("bodies[].element.viscosity", "", ()),
    ("contacts[]", "Contacts", ()),
    ("planes[]", "Planes", ()), ("planes[].velocity", "", ()), ("planes[].angular_velocity", "", ()),
    ("loads[]", "Loads", ()), ("", "Gravity", ("gravity",)), ("springs[]", "Springs", ()), ("point_masses[]", "Point masses", ()),
    ("initial[]", "Start", ()), ("relaxation", "Relaxation", ()), ("stages[]", "Stages", ()),
    ("sections[]", "Sections", ()), ("probes[]", "Probes", ()),
    ("stop[]", "Conditions to stop", ()), ("stop[].peaked", "", ()), ("stop[].dipped", "", ()), ("stop[].steady", "", ()),
    ("stop[].rest", "", ()),
    ("time", "Time", ()), ("output", "Output", ()),
]

# Sections that other programs, and other places, have too: the last word of a path, and the section of a scene with the same keys.
SAME = {"material": "bodies[].material", "lead": "bodies[].material", "steel": "bodies[].material", "element": "bodies[].element",
        "cladding": "bodies[].element", "vessel": "bodies[].element", "head": "bodies[].element", "contact": "contacts[]",
        "interface": "contacts[]", "time": "time", "output": "output", "stop[]": "stop[]", "relaxation": "relaxation",
        "initial[]": "initial[]"}


def last(path):
    return path.rsplit(".", 1)[-1]


def section_of(path):
    return path.rpartition(".")[0]


def parts_of(path):
    """(section, rest) of each place at which a path can be cut: "lead" and "curve.kind" of lead.curve.kind."""
    words = path.split(".")
    return [(".".join(words[:i]), ".".join(words[i:])) for i in range(1, len(words))]


def shared(key, scene):
    """The section of a scene that has the same key, if a place of a case has the keys of that section; else none."""
    for section, rest in parts_of(key["path"]):
        of_scene = SAME.get(last(section))
        one = scene.get(f"{of_scene}.{rest}") if of_scene is not None and section != of_scene else None
        if one is not None and one["type"].split(" | ")[0] in key["type"] and set(key.get("options", [])) <= set(one.get("options", [])):
            if rest == "kind" and key.get("options") != one.get("options") and last(section) in ("cladding", "vessel", "head"):
                continue
            return of_scene
    return None


# ------------------------------------------------------------------------------------------------
# Words

def code(text):
    return f"`{text}`"


def anchor(title):
    return "#" + title.lower().replace(" ", "-").replace("`", "").replace(".", "").replace("[]", "")


def of_range(key):
    """What values a key may have: "> 0, ≤ 10" of "0 < safety <= 10"."""
    told = []
    for one in key.get("range", "").split(" | "):
        found = range_of(one, last(key["path"]))
        if found is None:
            told.append(one)
            continue
        low, low_sign, sign, value = found
        ends = [f"{'≥' if low_sign == '<=' else '>'} {float(low):.6g}"] if low else []
        ends += [f"{ {'<': '<', '<=': '≤', '>': '>', '>=': '≥'}[sign]} {float(value):.6g}"] if sign else []
        told.append(", ".join(ends))
    return " or ".join(dict.fromkeys(one for one in told if one))


NOUNS = {"number": "number", "count": "whole number", "flag": "`true`, `false`", "word": "text", "words": "texts", "numbers": "numbers",
         "counts": "whole numbers", "expression": "expression", "expressions": "expressions", "section": "section", "sections": "list",
         "choice": ""}


def of_value(key):
    """What stands behind a key: its type, unit and range, or its options."""
    if key.get("options"):
        return ", ".join(map(code, key["options"]))
    unit = f"[{key['unit']}]" if key.get("unit", "1") != "1" else ""
    if unit == "[that of the probe]":
        unit = "quantity with the unit of the probe"
    nouns = [unit if one in ("quantity", "quantities") else NOUNS[one] for one in key["type"].split(" | ")]
    return ", ".join(part for part in (" or ".join(nouns), of_range(key)) if part)


def of_default(key):
    if key.get("required"):
        return "required"
    text = key.get("default", "")
    return re.sub(r"(\S+) with (\S+) = ([^\s;]+)", lambda m: f"{m[1]} with `{last(m[2])}: {m[3]}`", text)


def near_name(path, section):
    """A path as it is seen from a section: `mesh.kind` of bodies[].mesh.kind in bodies[].element."""
    words, here = path.split("."), section.split(".") if section else []
    while len(words) > 1 and here and words[0] == here[0]:
        words, here = words[1:], here[1:]
    return ".".join(words)


def of_where(key, options, of_section):
    """The conditions of a key in words, without those of its section."""
    section, told = section_of(key["path"]), []
    for one in [one for one in key.get("where", []) if one not in of_section]:
        if one == "never":
            told.append("never: it is listed as not used")
        elif one.startswith(("with ", "without ")):
            word, path = one.split(" ", 1)
            told.append(f"{'with' if word == 'with' else 'no'} {code(near_name(path, section))}")
        else:
            path, _, answers = one.partition(" = ")
            answers, name = answers.split(" | "), near_name(path, section)
            others = [answer for answer in options.get(path, []) if answer not in answers]
            if answers == ["above 0"]:
                told.append(f"{code(name)} above 0")
            elif len(others) in (1, 2) and len(answers) > 2:
                told.append(f"not {code(f'{name}: ' + ' | '.join(others))}")
            else:
                told.append(code(f"{name}: " + " | ".join(answers)))
    return "; ".join(told)


def escaped(text):
    return text.replace("|", "\\|")


def table(chosen, keys):
    """The table of some keys of a program, all of one section."""
    options = {key["path"]: key["options"] for key in keys if key.get("options")}
    at = section_of(chosen[0]["path"]).removesuffix("[]")
    of_section = next((key.get("where", []) for key in keys if key["path"] == at), [])
    lines = ["| key | value | default | with | |", "|---|---|---|---|---|"]
    for key in chosen:
        cells = [code(last(key["path"])), of_value(key), of_default(key), of_where(key, options, of_section)]
        lines.append("| " + " | ".join(map(escaped, cells)) + " | " + escaped(f"{key['meaning']} {code(key['example'])}") + " |")
    return "\n".join(lines)


# ------------------------------------------------------------------------------------------------
# The page

HEAD = """# All keys

<!-- written by scripts/keys -->

This page is written by `scripts/keys` from what the programs say of themselves: `build/release/drivers/scene --keys` prints the same as
JSON. [input.md](input.md) describes the format of cases, [scene.md](scene.md) and [meshes.md](meshes.md) explain the keys with examples,
and [results.md](results.md) has what runs write. Editors complete keys and check cases by the schemas: [input.md](input.md#in-an-editor).

- *value*: the unit in brackets stands for any unit of its dimension. Quantities have a unit, numbers have none.
- *default*: *required* keys have none. Defaults of quantities are in SI. An empty field means that the key may be left out.
- *with*: conditions under which the key is used, all of them. Conditions on a key that is not used itself do not count. A key that is
  not used may stay in the file: it is checked, and listed as not used.
"""


def of_scene(keys):
    """The tables of a scene; every key stands in one of them."""
    lines, left = [], [key["path"] for key in keys if shared(key, {one["path"]: one for one in keys}) is None]
    for section, title, only in SECTIONS:
        chosen = [key for key in keys if key["path"] in left and section_of(key["path"]) == section and
                  (section or last(key["path"]) in only)]
        left = [path for path in left if path not in [key["path"] for key in chosen]]
        if title:
            lines.append(f"## {title}\n")
        if not chosen:
            raise ValueError(f"no key of a scene is in the section '{section}'")
        if section:
            lines.append(f"{code(section)}\n")
        lines.append(table(chosen, keys) + "\n")
    top = [key for key in keys if key["path"] in left and section_of(key["path"]) == ""]
    left = [path for path in left if path not in [key["path"] for key in top]]
    if left:
        raise ValueError(f"keys of a scene that no section has: {', '.join(left)}")
    return lines, top


def of_program(program, said, scene):
    """The tables of a program: keys that a scene has too are linked."""
    keys = said["keys"]
    titles = {section: title for section, title, _ in SECTIONS if title}
    same_place = {path for path in scene if any(last(section) in SAME for section, _ in parts_of(path))}
    own = [key for key in keys if shared(key, scene) is None and key["path"] not in ("refine", "accuracy", *same_place)]
    if program == "modes":
        own = [key for key in keys if key["path"] not in scene]
    lines = [f"## Program {program}\n"]
    if program == "modes":
        lines.append("All keys of a scene, of which only [bodies](#bodies), [planes](#planes), [springs](#springs) and "
                     "[point masses](#point-masses) are used; and\n")
    for section in dict.fromkeys(section_of(key["path"]) for key in own):
        if section:
            lines.append(f"{code(section)}\n")
        lines.append(table([key for key in own if section_of(key["path"]) == section], keys) + "\n")
    if program == "modes":
        return lines
    links = dict.fromkeys(section for key in keys if key not in own for section, _ in parts_of(key["path"]) if last(section) in SAME)
    outer = [section for section in links if not any(section.startswith(f"{other}.") for other in links)]
    told = [f"{code(section)}: [{titles[SAME[last(section)]].lower()}]({anchor(titles[SAME[last(section)]])})" for section in outer]
    if told:
        lines.append("With the keys of a scene: " + ", ".join(told) + ".\n")
    return lines


def page(said):
    keys = said["scene"]["keys"]
    scene = {key["path"]: key for key in keys}
    lines, top = of_scene(keys)
    head = ["## A scene\n", "The sections of a case of the program `scene`:\n", table(top, keys) + "\n"]
    programs = [line for program in PROGRAMS if program != "scene" for line in of_program(program, said[program], scene)]
    return "\n".join([HEAD, *head, *lines, *programs, END]) + "\n"


# ------------------------------------------------------------------------------------------------
# Tables of results, columns, fields and members of the summary

def rows(entries, head):
    lines = [f"| {head} | unit | |", "|---|---|---|"]
    return lines + [f"| {code(one['name'])} | {one['unit']} | {escaped(one['meaning'])} |" for one in entries]


def by_program(said, what, program=None):
    """Entries of the programs that make steps, or those that a program has beside them."""
    common = [one for one in said["scene"][what] if "of" not in one]
    return common if program is None else [one for one in said[program][what] if "of" in one]


def tables(said):
    """{name: text} of the tables that pages have between marks."""
    made = {}
    for what, head in (("results", "result"), ("columns", "column")):
        made[what] = "\n".join(rows(by_program(said, what), head))
        parts = [(program, by_program(said, what, program)) for program in PROGRAMS]
        made[f"{what} of programs"] = "\n\n".join("\n".join([f"`{program}`:", "", *rows(own, head)]) for program, own in parts if own)
    fields = said["scene"]["fields"]
    for place in dict.fromkeys(one["of"] for one in fields):
        made[f"fields of {place}"] = "\n".join(rows([one for one in fields if one["of"] == place], "field"))
    made["summary"] = "\n".join(rows(said["scene"]["summary"], "member"))
    return made


def filled(text, said):
    """A page with its tables written anew."""
    for name, new in tables(said).items():
        begin = BEGIN.format(name)
        if text.count(begin) != 1:
            raise ValueError(f"{RESULTS} has no place for {name}: expected is one line '{begin}'")
        at = text.index(begin) + len(begin)
        text = f"{text[:at]}\n\n{new}\n\n{text[text.index(END, at):]}"
    return text
