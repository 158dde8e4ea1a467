"""JSON schemas of cases, from what programs say of themselves: editors complete from them."""
import json
import re

DIALECT = "http://json-schema.org/draft-07/schema#"
NUMBER = r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?"
QUANTITY = rf"^{NUMBER} ?[A-Za-z(1][-A-Za-z0-9()*/^ ]*$"
WORTH = 300  # characters of a part that is written once if it comes several times


def path(program):
    return "docs/nereid.schema.json" if program == "scene" else f"docs/schemas/{program}.schema.json"


def range_of(text, name):
    """(low, its sign, sign, high) of the range of a key, as of "0 m < length <= 10 m"; None of other words.

    >>> range_of("0 m < length <= 10 m", "length"), range_of("n >= 2", "n"), range_of("three", "normal")
    (('0', '<', '<=', '10'), (None, None, '>=', '2'), None)
    """
    found = re.fullmatch(r"(?:(\S+)(?: \S+)? (<=?) )?(\w+)(?: (<=?|>=?) (\S+)(?: \S+)?)?", text)
    return (*found.groups()[:2], *found.groups()[3:]) if found is not None and found[3] == name else None


def bounds(range_text, name):
    """{minimum and so on} of "0 < safety <= 10"; nothing of several ranges."""
    found = range_of(range_text, name)
    if found is None:
        return {}
    low, low_sign, sign, value = found
    ends = {"minimum" if low_sign == "<=" else "exclusiveMinimum": float(low)} if low else {}
    words = {"<": "exclusiveMaximum", "<=": "maximum", ">": "exclusiveMinimum", ">=": "minimum"}
    return {**ends, words[sign]: float(value)} if sign else ends


def is_whole(value):
    return isinstance(value, float) and value == int(value) and abs(value) < 1e15


def tidy(limits):
    return {word: int(value) if is_whole(value) else value for word, value in limits.items()}


LENGTHS = {"two": 2, "three": 3, "six": 6}


def size(range_text):
    """Lengths of a list: "three", "at least 2"."""
    if range_text in LENGTHS:
        return {"minItems": LENGTHS[range_text], "maxItems": LENGTHS[range_text]}
    least = re.fullmatch(r"at least (\d+)", range_text)
    return {"minItems": int(least[1])} if least else {}


def number(limits=None):
    """Also as a text: YAML 1.1 takes 1e-3 for one."""
    return {"type": ["number", "string"], "pattern": f"^{NUMBER}$", **tidy(limits or {})}


ITEMS = {"quantities": {"type": "string", "pattern": QUANTITY}, "numbers": number(), "counts": {"type": "integer"},
         "words": {"type": "string"}, "expressions": {"type": ["string", "number"]}}


def of_type(kind, key, range_text):
    name = key["path"].rsplit(".", 1)[-1]
    if kind in ITEMS:
        return {"type": "array", "items": ITEMS[kind], **size(range_text)}
    if kind == "quantity":
        plain = {"type": "string", "pattern": QUANTITY}
        return {"anyOf": [plain, number()]} if key.get("unit", "").startswith("that") else plain
    return {"number": lambda: number(bounds(range_text, name)), "count": lambda: {"type": "integer", **tidy(bounds(range_text, name))},
            "flag": lambda: {"type": "boolean"}, "word": lambda: {"type": "string"}, "choice": lambda: {"enum": key["options"]},
            "expression": lambda: {"type": ["string", "number"]}}[kind]()


def value(key):
    """The schema of what stands behind a key that is no section."""
    kinds, ranges = key["type"].split(" | "), key.get("range", "").split(" | ")
    if len(kinds) == 1:
        found = of_type(kinds[0], key, ranges[0] if len(ranges) == 1 else "")
    else:
        found = {"anyOf": [of_type(kind, key, next((one for one in ranges if kind in ITEMS and size(one)), "")) for kind in kinds]}
    return {"description": described(key), **found, **default(key)}


def default(key):
    text = key.get("default", "")
    if key["type"] == "flag":
        return {"default": text == "true"} if text else {}
    if key["type"] == "choice":
        return {"default": text} if text in key["options"] else {}
    plain = key["type"] in ("number", "count") and re.fullmatch(NUMBER, text)
    return {"default": json.loads(text)} if plain else {}


def described(key):
    unit, usual = key.get("unit", ""), key.get("default", "")
    told = [key["meaning"]] + [f"[{unit}]"] * (unit not in ("", "1")) + [f"Default: {usual}."] * bool(usual)
    return " ".join(told) + f" Example: {key['example']}"


def answers_of(condition, section):
    """(key, answers, whether they hold) of a condition on a key of the same section; None of others."""
    if condition.startswith(("with ", "without ")):
        word, at = condition.split(" ", 1)
        return (at.rsplit(".", 1)[-1], None, word == "with") if at.rpartition(".")[0] == section else None
    at, _, answers = condition.partition(" = ")
    if at.rpartition(".")[0] != section or answers == "above 0":
        return None
    return at.rsplit(".", 1)[-1], answers.split(" | "), True


def conditional(keys, section, usual):
    """`if` and `then` of the keys of a section that are required with some choices."""
    found = {}
    for key in keys:
        if key.get("required") and key.get("where"):
            conditions = [answers_of(one, section) for one in key["where"]]
            if all(conditions):
                found.setdefault(json.dumps(conditions), []).append(key["path"].rsplit(".", 1)[-1])
    parts = []
    for text, names in found.items():
        test = {}
        for name, answers, holds in json.loads(text):
            if answers is None:
                test.setdefault("allOf", []).append({"required": [name]} if holds else {"not": {"required": [name]}})
                continue
            test.setdefault("properties", {})[name] = {"enum": [{"true": True, "false": False}.get(one, one) for one in answers]}
            if usual.get(name, "") not in answers:
                test.setdefault("required", []).append(name)
        parts.append({"if": test, "then": {"required": names}})
    return {"allOf": parts} if parts else {}


def section(keys, at):
    """The schema of the section at a path."""
    prefix = f"{at}." if at else ""
    own = [key for key in keys if key["path"].startswith(prefix) and "." not in key["path"][len(prefix):]]
    properties = {}
    for key in own:
        inner = {"section": lambda: section(keys, key["path"]),
                 "sections": lambda: {"type": "array", "items": section(keys, key["path"] + "[]"),
                                      **({"minItems": 1} if key.get("required") else {})}}.get(key["type"])
        properties[key["path"][len(prefix):]] = {"description": described(key), **inner()} if inner else value(key)
    required = [key["path"][len(prefix):] for key in own if key.get("required") and not key.get("where")]
    usual = {key["path"][len(prefix):]: key.get("default", "") for key in own}
    return {"type": "object", "additionalProperties": False, "properties": properties, **({"required": required} if required else {}),
            **conditional(own, at, usual)}


def parts_of(node):
    """All sections of a schema, those within others first."""
    if isinstance(node, dict):
        for one in node.values():
            yield from parts_of(one)
        if node.get("type") == "object" and "properties" in node:
            yield node
    if isinstance(node, list):
        for one in node:
            yield from parts_of(one)


def shortened(schema):
    """The same with parts that come several times written once."""
    counts = {}
    for part in parts_of(schema):
        text = json.dumps({word: part[word] for word in part if word != "description"})
        counts[text] = counts.get(text, 0) + 1
    names = {}

    def short(node):
        if isinstance(node, list):
            return [short(one) for one in node]
        if not isinstance(node, dict):
            return node
        bare = {word: one for word, one in node.items() if word != "description"}
        text = json.dumps(bare)
        inner = {word: short(one) for word, one in bare.items()}
        if counts.get(text, 0) > 1 and len(text) > WORTH:
            name, _ = names.setdefault(text, (f"part_{len(names) + 1}", inner))
            inner = {"allOf": [{"$ref": f"#/definitions/{name}"}]}
        return {**({"description": node["description"]} if "description" in node else {}), **inner}

    made = short(schema)
    return {**made, **({"definitions": dict(names.values())} if names else {})}


def text(said):
    schema = shortened(section(said["keys"], ""))
    whole = {"$schema": DIALECT, "title": f"Case of the program {said['program']}", **schema}
    return json.dumps(whole, indent=1, ensure_ascii=False) + "\n"
