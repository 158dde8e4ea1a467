"""The knobs of scripts/trade: settings that trade accuracy for cost, with the keys and values that a sweep tries.

A *knob* is one line of KNOBS. Its path is a section and a key of it, wherever the section stands in a case: `time.safety`,
`element.kind` of every body, `viscosity.linear`. `contact.KEY` is meant of every section that is a contact, and of rigid planes. A case
has a knob if the case, as the program resolved it, has one of its keys. A new setting enters by one line.
"""
import dataclasses

import defaults
from cells import bodies_from_files, counts_of_cells, number_of, refined, settings_of

CONTACTS = tuple(name for name, table in defaults.NUMERICS.items() if table is defaults.CONTACT)
MESH = "cells"  # the path of the knob that multiplies every count of cells
PENALTY = {"method": "penalty"}


class NoKnob(Exception):
    """A word of --knobs names no knob or no value of one; says which and what there is."""


@dataclasses.dataclass(frozen=True)
class Knob:
    """One setting and the values that are tried.

    path     section.key, or several with blanks between them, of which a case has one
    values   what the key is set to; with `times` factors on what the case has. A dict is keys of the case seen from its root
    beside   keys that are set in the same section, so that the value is used at all
    where    the key that a section must have for the knob to be there; by default the knob's own
    """
    name: str
    path: str
    values: tuple
    beside: dict = dataclasses.field(default_factory=dict)
    where: str = ""
    times: bool = False


KNOBS = (
    Knob("mesh", MESH, (0.5, 1, 1.5, 2), times=True),
    Knob("element", "element.kind element.lead", ("one_point", "full")),
    Knob("hourglass", "element.hourglass_kind", ("assumed_strain", "stiffness", "viscous")),
    Knob("hourglass_coefficient", "element.hourglass", (0.1, 0.5, 1)),
    Knob("linear_viscosity", "viscosity.linear", (0, 0.06, 0.2)),
    Knob("quadratic_viscosity", "viscosity.quadratic", (0, 1, 2)),
    Knob("layers", "element.layers cladding.layers", (2, 3, 5, 7, 9)),
    Knob("rotary_inertia", "element.rotary_inertia cladding.rotary_inertia", ("scaled", "physical")),
    Knob("step", "time.safety", (1, 0.9, 0.7, 0.45, 0.2)),
    Knob("method", "contact.method", ("multiplier", "penalty")),
    Knob("restitution", "contact.restitution", (0, 1)),
    Knob("penalty_scale", "contact.penalty_scale", (0.2, 1, 4, 100), PENALTY, where="method"),
    Knob("damping", "contact.damping_ratio", (0.1, 0.5), PENALTY, where="passes"),
    Knob("energy_gain", "contact.energy_gain_limit", (0.02, 0.001), PENALTY, where="method"),
    Knob("step_factor", "contact.step_factor", (0.5,), PENALTY, where="method"),
    Knob("area", "contact.area", ("base",), PENALTY, where="passes"),
    Knob("weights", "contact.weights", ("consistent", "paper")),
    Knob("passes", "contact.passes", ("one", "two")),
    Knob("symmetry", "model.kind", ("full", "quarter", "sector")),
    Knob("residual", "relaxation.residual", (1e-3, 1e-4, 1e-5, 1e-6)),
    Knob("history", "output.history_every", (0.25, 4, 16), times=True),
)


# ------------------------------------------------------------------------------------------------
# What a value sets in a case

def places(resolved, section):
    """Paths and contents of all sections of this name; items of a list are called as the list."""
    wanted = CONTACTS if section == "contact" else (section,)
    found = []

    def look(node, path, name):
        if isinstance(node, list):
            for number, part in enumerate(node):
                look(part, f"{path}[{number}]", name)
        elif isinstance(node, dict) and "default" not in node:
            if name in wanted:
                found.append((path, node))
            for key, part in node.items():
                look(part, f"{path}.{key}".lstrip("."), key)

    look(resolved, "", "")
    return found


def text_of(value):
    return f"{value:.10g}" if isinstance(value, (int, float)) and not isinstance(value, bool) else str(value)


def settings(knob, value, resolved):
    """{key of the case: text} that sets the knob to the value; nothing where the case has no such knob or is so already."""
    if isinstance(value, dict):
        return {key: text_of(one) for key, one in value.items()}
    if knob.path == MESH:
        return mesh_settings(resolved, value)
    found, differs = {}, False
    for section, key in (path.split(".") for path in knob.path.split()):
        for path, node in places(resolved, section):
            if (knob.where or key) not in node:
                continue
            now = node.get(key)
            new = factor_on(now, value) if knob.times else value
            found[f"{path}.{key}"] = text_of(new)
            differs = differs or now is None or now["value"] != new
            for other, its in knob.beside.items():
                found[f"{path}.{other}"] = text_of(its)
                differs = differs or node.get(other, {}).get("value") != its
    return found if differs else {}


def factor_on(now, factor):
    """A quantity of a resolved case times a factor, with its unit."""
    return f"{number_of(now) * factor:.10g} {now['unit']}" if now.get("unit") else number_of(now) * factor


def mesh_settings(resolved, factor):
    """Every count of cells times the factor; of the cask its level too. Where a mesh is from a file, `refine`, if it can follow."""
    if bodies_from_files(resolved):
        return refined(resolved, factor) if factor != 1 else {}
    counts = counts_of_cells(resolved)
    texts, _ = settings_of(counts, factor)
    now, _ = settings_of(counts, 1)
    return {} if texts == now else texts


def factor_of(knob, label):
    """How much finer the mesh of this label is; its keys may be a case's own."""
    return float(label.removeprefix("x")) if knob.path == MESH else 1.0


def label(value, times=False):
    return f"x{value:.3g}" if times else text_of(value)


# ------------------------------------------------------------------------------------------------
# Which knobs a sweep has

def of_case(own):
    """[(knob, {label: value})] of the table, with what a case says itself: {name: values, {label: keys}, a Knob, or None for leave out}."""
    own = dict(own)
    found = []
    for knob in KNOBS:
        given = own.pop(knob.name, knob)
        if given is not None:
            found.append(choices(given if isinstance(given, Knob) else dataclasses.replace(knob, values=given)))
    for name, given in own.items():
        found.append(choices(given if isinstance(given, Knob) else Knob(name, "", given)))
    return found


def choices(knob):
    values = knob.values
    return knob, dict(values) if isinstance(values, dict) else {label(value, knob.times): value for value in values}


def chosen(words, known):
    """The knobs that words of --knobs ask for: `NAME`, or `NAME=VALUE,VALUE` with values of its own; all without words."""
    if not words:
        return known
    by_name = {knob.name: (knob, labels) for knob, labels in known}
    found = {}
    for word in words:
        name, equals, texts = word.partition("=")
        if name not in by_name:
            raise NoKnob(f"'{name}' is no knob of this case; there are {', '.join(by_name)}")
        knob, labels = by_name[name]
        if equals:
            labels = dict(one_value(knob, labels, text) for text in texts.split(","))
        found[name] = (knob, labels)
    return list(found.values())


def one_value(knob, labels, text):
    """(label, value) of one value on the command line: a label that the knob has, a number, or a word of a key that takes words."""
    if text in labels:
        return text, labels[text]
    try:
        value = float(text.removeprefix("x"))
        value = int(value) if value == int(value) else value
    except (ValueError, OverflowError):
        value = text
    of_words = not knob.times and all(isinstance(one, str) for one in labels.values())
    if not text or not knob.path or isinstance(value, str) != of_words:
        raise NoKnob(f"'{text}' is no value of {knob.name}; expected is one of {', '.join(labels)}"
                     + (" or another number" if knob.path and not of_words else ""))
    return label(value, knob.times), value
