"""Twins of a case: the same case turned, mirrored, moving, in other units, or otherwise changed.

A twin is made of the case as the program resolved it, in SI: nothing that the program read is left out. What has a unit is known by it;
directions, places and turns are known by their keys. Meshes of files are read and written anew (mesh_files.py).
"""
import math
import re
import shutil

import mesh_files

IDENTITY = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


# ------------------------------------------------------------------------------------------------
# Cases as trees

class Quantity:
    """A number or a list of numbers in SI, and its unit; None for a word."""

    def __init__(self, value, unit=None):
        self.value, self.unit = value, unit


class Texts(list):
    """One expression over x, y, z, t or three, in SI; `dimension` is the unit."""

    def __init__(self, texts, dimension):
        super().__init__(texts)
        self.dimension = dimension


def tree_of(run):
    """What a case says, without defaults: dictionaries and lists of Quantity and Texts. Paths of tables of curves are absolute."""
    return with_absolute_tables(taken(run.summary["provenance"]["resolved"]), run.case_file.parent)


def with_absolute_tables(node, beside):
    """A tree whose curves have their tables from everywhere.

    beside  the folder from which the paths are seen

    >>> from pathlib import Path
    >>> with_absolute_tables({"curve": {"table": Quantity("steel.csv:stress")}}, Path("/cases"))["curve"]["table"].value
    '/cases/steel.csv:stress'
    """
    if isinstance(node, list) and not isinstance(node, Texts):
        return [with_absolute_tables(one, beside) for one in node]
    if not isinstance(node, dict):
        return node
    made = {key: with_absolute_tables(one, beside) for key, one in node.items()}
    if "table" in made:
        path, colon, column = made["table"].value.partition(":")
        made["table"] = Quantity(f"{(beside / path).resolve()}{colon}{column}")
    return made


def is_formula(node):
    """Whether a probe is computed from others: its text is over their names, and its values are in SI in any system of units."""
    return "value" in node and "name" in node and "kind" not in node and not isinstance(node["value"], Texts)


def names_in(formula):
    """Names of the probes of which a formula is made, among others.

    >>> sorted(names_in("push_force * tip / max(t, 1e-9)"))
    ['max', 'push_force', 't', 'tip']
    """
    return set(re.findall(r"(?<![\w.])[A-Za-z_]\w*", formula))


def taken(node):
    if isinstance(node, list):
        return [taken(one) for one in node]
    if "default" in node:
        return None if node["default"] else Quantity(node["value"], node["unit"])
    kept = {key: taken(one) for key, one in node.items() if not re.search(r"_file(_\d+)?$", key)}  # these say what a file held
    kept = {key: one for key, one in kept.items() if one is not None and one != [] and (one != {} or key == "relaxation")}
    keys = [key for key in ("value", "velocity", "displacement", "incident") if key in kept]  # texts, with their unit beside them
    if "unit" in kept and keys and not is_formula(kept):
        unit = kept.pop("unit").value
        factor, *powers = measure(unit)
        angle = ["rad"] if re.search(r"\b(rad|deg)\b", unit) else []
        for key in keys:
            texts = kept[key].value if isinstance(kept[key].value, list) else [kept[key].value]
            kept[key] = Texts([times(text, factor) for text in texts],
                              "*".join([*angle, *(f"{n}^{p}" for n, p in zip(("m", "kg", "s"), powers) if p)]))
    return kept


def word_of(node, key, otherwise=None):
    """What a key of a tree says, or what holds where it says nothing."""
    return node[key].value if key in node else otherwise


def constant(vector, dimension):
    """Three expressions of a constant vector."""
    return Texts([repr(x) for x in vector], dimension)


def times(text, factor):
    """An expression, multiplied. Values of tables come in the unit of the expression, so that they are divided.

    >>> times('2*table("a.csv", max(t, 1))', 1000.0)
    '(2*(table("a.csv", max(t, 1))/(1000.0)))*(1000.0)'
    """
    if factor == 1:
        return text
    at = text.find("table(")
    divided = ""
    while at >= 0:
        end, depth = at + len("table("), 1
        while depth:
            depth += {"(": 1, ")": -1}.get(text[end], 0)
            end += 1
        divided += f"{text[:at]}({text[at:end]}/({factor!r}))"
        text = text[end:]
        at = text.find("table(")
    return f"({divided}{text})*({factor!r})"


def in_other_variables(text, of):
    """An expression with x, y, z, t, v replaced."""
    return re.sub(r"\b[xyztv]\b", lambda found: of.get(found.group(), found.group()), text)


# ------------------------------------------------------------------------------------------------
# Units

# factor to SI, powers of length, mass and time
INCH, POUND_FORCE = 0.0254, 4.4482216152605
NAMES = {"m": (1, 1, 0, 0), "cm": (1e-2, 1, 0, 0), "mm": (1e-3, 1, 0, 0), "um": (1e-6, 1, 0, 0), "km": (1e3, 1, 0, 0),
         "in": (INCH, 1, 0, 0), "ft": (12 * INCH, 1, 0, 0),
         "s": (1, 0, 0, 1), "ms": (1e-3, 0, 0, 1), "us": (1e-6, 0, 0, 1), "min": (60, 0, 0, 1),
         "kg": (1, 0, 1, 0), "g": (1e-3, 0, 1, 0), "t": (1e3, 0, 1, 0), "lb": (0.45359237, 0, 1, 0),
         "N": (1, 1, 1, -2), "kN": (1e3, 1, 1, -2), "kgf": (9.80665, 1, 1, -2), "lbf": (POUND_FORCE, 1, 1, -2),
         "Pa": (1, -1, 1, -2), "kPa": (1e3, -1, 1, -2), "MPa": (1e6, -1, 1, -2), "GPa": (1e9, -1, 1, -2),
         "psi": (POUND_FORCE / INCH**2, -1, 1, -2), "J": (1, 2, 1, -2), "kJ": (1e3, 2, 1, -2), "Hz": (1, 0, 0, -1), "1": (1, 0, 0, 0),
         "rad": (1, 0, 0, 0), "deg": (math.pi / 180, 0, 0, 0), "K": (1, 0, 0, 0)}


class UnknownUnit(Exception):
    """A unit that is not among NAMES."""


def measure(unit):
    """Factor to SI and powers of length, mass and time of a unit such as `kg/m^3`, read from left to right.

    >>> measure("kg/m^3"), measure("N*m"), measure("MPa")
    ((1.0, -3, 1, 0), (1.0, 2, 1, -2), (1000000.0, -1, 1, -2))
    """
    factor, powers = 1.0, [0, 0, 0]
    for name, over in symbols(unit):
        if name not in NAMES:
            raise UnknownUnit(f"the unit '{unit}' is not known here")
        one, *of_one = NAMES[name]
        factor *= one ** over
        powers = [a + over * b for a, b in zip(powers, of_one)]
    return (factor, *powers)


def symbols(unit):
    """[(symbol, power), ...] of a unit.

    >>> symbols("J/(kg*K)")
    [('J', 1), ('kg', -1), ('K', -1)]
    """
    flat = re.sub(r"/\(([^()]*)\)", lambda found: "/" + found[1].translate({ord("*"): "/", ord("/"): "*"}), unit)
    return [(name, int(power or 1) * (-1 if sign == "/" else 1))
            for sign, name, power in re.findall(r"([*/ ]?)(\w+)(?:\^(-?\d+))?", flat)]


class System:
    """Units in which a case is written: names and sizes in SI of length, of force or mass, and of time.

    >>> System(("mm", 1e-3), ("kgf", 9.80665), ("s", 1)).write(1.0, "kg/m^3")
    '1.0197162129779284e-13 kgf*mm^-4*s^2'
    """

    def __init__(self, length, force, time):
        self.names, self.sizes = zip(force, length, time)

    def powers(self, unit):
        _, a, b, c = measure(unit)
        return b, a - b, c + 2 * b  # mass is force times time squared over length

    def write(self, value, unit):
        if unit in ("1", None):
            return repr(value)
        if unit == "rad":
            return f"{value!r} {unit}"
        powers = self.powers(unit)
        size = math.prod(one ** power for one, power in zip(self.sizes, powers))
        kelvins = sum(power for name, power in symbols(unit) if name == "K")
        return f"{value / size!r} " + "*".join(part for part in (self.name(powers), f"K^{kelvins}" if kelvins else "") if part)

    def name_of(self, unit):
        return "*".join(part for part in ("rad" if "rad" in unit else "", self.name(self.powers(unit))) if part)

    def name(self, powers):
        return "*".join(name + (f"^{power}" if power != 1 else "") for name, power in zip(self.names, powers) if power)


SI = System(("m", 1), ("N", 1), ("s", 1))
TECHNICAL = System(("mm", 1e-3), ("kgf", 9.80665), ("s", 1))


def written(node, system, indent=0):
    """The lines of a case in YAML."""
    if isinstance(node, list) and not isinstance(node, Texts):
        lines = []
        for one in node:
            first, *rest = written(one, system, indent + 2)
            lines += [" " * indent + "- " + first.lstrip(), *rest]
        return lines
    lines = []
    for key, one in node.items():
        head = f"{' ' * indent}{key}:"
        if isinstance(one, Quantity):
            lines.append(f"{head} {leaf(one, system)}")
        elif isinstance(one, Texts):
            powers = system.powers(one.dimension)
            size = math.prod(a ** p for a, p in zip(system.sizes, powers))
            texts = ", ".join(quoted(times(text, 1 / size)) for text in one)
            unit = f"{' ' * indent}unit: {system.name_of(one.dimension)}"
            lines += [f"{head} [{texts}]" if len(one) > 1 else f"{head} {texts}", *([] if unit in lines else [unit])]
        elif one:
            lines += [head, *written(one, system, indent + 2)]
        else:
            lines.append(f"{head} {{}}")
    return lines


def quoted(text):
    """In single quotes, which an expression with the name of a table has no need of."""
    return f"'{text}'" if '"' in text else f'"{text}"'


def leaf(one, system):
    if isinstance(one.value, list):
        return "[" + ", ".join(leaf(Quantity(v, one.unit), system) for v in one.value) + "]"
    if isinstance(one.value, bool):
        return str(one.value).lower()
    if isinstance(one.value, (int, float)):
        whole = one.unit == "1" and float(one.value).is_integer()
        return str(int(one.value)) if whole else system.write(float(one.value), one.unit)
    return one.value if re.fullmatch(r"[\w.-][\w./-]*", one.value) else quoted(one.value)


def put_down(tree, beside, scratch, label, system=SI, change=None):
    """Writes a twin, its meshes and its tables; returns the path of its case.

    beside  the folder of the case: where its meshes and tables are
    change  gives the mesh to write of the mesh and the name of a body; without it the files are copied
    """
    scratch.mkdir(parents=True, exist_ok=True)
    for body in tree.get("bodies", []):
        if "path" in body["mesh"]:
            name, source = f"{label}_{body['name'].value}.vtu", beside / body["mesh"]["path"].value
            if change is None:
                copy_file(source, scratch / name)
            else:
                mesh_files.write(scratch / name, change(mesh_files.read(source), body["name"].value))
            body["mesh"] = {**body["mesh"], "path": Quantity(name)}
    text = "\n".join(written(tree, system)) + "\n"
    for table in sorted(set(re.findall(r'table\("([^":]*)', text))):
        copy_file(beside / table, scratch / table)
    path = scratch / f"{label}.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def copy_file(source, target):
    if source.resolve() != target.resolve():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)


# ------------------------------------------------------------------------------------------------
# Directions

def product(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in matrix]


def transposed(matrix):
    return [list(row) for row in zip(*matrix)]


def matrices(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))


def tensor(matrix, s):
    """Six components xx, yy, zz, xy, yz, xz in the axes to which a matrix turns or mirrors."""
    full = ((s[0], s[3], s[5]), (s[3], s[1], s[4]), (s[5], s[4], s[2]))
    turned = matrices(matrix, matrices(full, transposed(matrix)))
    return [turned[i][j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]


def rotation(axis, angle):
    """The matrix of a turn about an axis of any length, by Rodrigues' formula.

    >>> [[round(x, 12) for x in row] for row in rotation((0, 0, 2), math.pi / 2)]
    [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
    """
    length = math.sqrt(sum(a * a for a in axis))
    a, b, c = (x / length for x in axis)
    cross = ((0, -c, b), (c, 0, -a), (-b, a, 0))
    twice = matrices(cross, cross)
    return [[(i == j) + math.sin(angle) * cross[i][j] + (1 - math.cos(angle)) * twice[i][j] for j in range(3)] for i in range(3)]


def reflection(normal):
    """The matrix of a mirror through the origin.

    >>> reflection((0, 3, 0))[1]
    [0.0, -1.0, 0.0]
    """
    square = sum(a * a for a in normal)
    return [[(i == j) - 2 * a * b / square for j, b in enumerate(normal)] for i, a in enumerate(normal)]


def axis_and_angle(m):
    """The turn of a rotation matrix, by its quaternion; the largest component is computed first.

    >>> axis, angle = axis_and_angle(rotation((1, -2, 0.5), 2.5))
    >>> max(abs(a - b) for p, q in zip(rotation(axis, angle), rotation((1, -2, 0.5), 2.5)) for a, b in zip(p, q)) < 1e-15
    True
    """
    trace = m[0][0] + m[1][1] + m[2][2]
    squares = [1 + trace, *(1 + 2 * m[i][i] - trace for i in range(3))]  # 4 q^2
    most = squares.index(max(squares))
    spin = [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]]
    if most == 0:
        q = [squares[0], *spin]
    else:
        i = most - 1
        q = [spin[i], *(squares[most] if j == i else m[i][j] + m[j][i] for j in range(3))]
    length = math.sqrt(sum(x * x for x in q))
    w, *axis = (x / length for x in q)
    return (axis, 2 * math.atan2(math.sqrt(sum(x * x for x in axis)), w)) if any(axis) else ([0, 0, 1], 0.0)


# ------------------------------------------------------------------------------------------------
# Transformations

def moved(tree, matrix, shift=(0, 0, 0), mirror="x"):
    """x -> matrix x + shift, for a matrix that turns or mirrors. A mirrored case has meshes in one of mesh_files.MIRRORS."""
    mirrors = determinant(matrix) < 0
    in_mesh = transposed([mesh_files.MIRRORS[mirror](row) for row in IDENTITY]) if mirrors else IDENTITY
    back = transposed(matrix)
    from_twin = {name: "(" + " + ".join(f"({m!r})*({old} - ({s!r}))" for m, old, s in zip(row, "xyz", shift)) + ")"
                 for name, row in zip("xyz", back)}

    def place(p):
        return [a + b for a, b in zip(product(matrix, p), shift)]

    def combined(texts, matrix):
        return [" + ".join(f"({m!r})*({text})" for m, text in zip(row, texts) if m) for row in matrix]

    def visit(node, within=None):
        if isinstance(node, Texts):
            return Texts([in_other_variables(text, from_twin) for text in node], node.dimension)
        if isinstance(node, list):
            return [visit(one) for one in node]
        if not isinstance(node, dict):
            return node
        new = {key: visit(one, key) for key, one in node.items()}
        for key in ("value", "velocity", "displacement"):
            if isinstance(new.get(key), Texts) and len(new[key]) == 3:
                turns = word_of(new, "kind") == "moment" or within == "angular_velocity"  # a mirror turns its sense about
                with_sign = [[-m for m in row] for row in matrix] if turns and mirrors else matrix
                new[key] = Texts(combined(new[key], with_sign), new[key].dimension)
        for key, change in (("normal", lambda v: product(matrix, v)), ("along", lambda v: product(matrix, v)), ("point", place),
                            ("near", place), ("centre", place), ("inertia", lambda s: tensor(matrix, s))):
            if key in new:
                new[key] = Quantity(change(new[key].value), new[key].unit)
        if within == "cylinder":
            new.update((key, Quantity(place(new[key].value), "m")) for key in ("from", "to"))
        return new

    twin = visit(with_half_spaces(tree))
    if "gravity" in twin:
        twin["gravity"] = Quantity(product(matrix, tree["gravity"].value), tree["gravity"].unit)
    for body in twin["bodies"]:
        if mirrors and "map" in body["mesh"]:
            texts = [in_other_variables(text, dict(zip("xyz", mesh_files.MIRRORS[mirror]("xyz")))) if mirror == "xy" else
                     in_other_variables(text, {"x": "(-x)"}) for text in body["mesh"]["map"].value]
            body["mesh"] = {**body["mesh"], "map": Quantity(combined(texts, in_mesh))}
        turn, move = body.pop("rotate", {}), body.pop("move", None)
        old = rotation(turn["axis"].value, turn["angle"].value) if turn else IDENTITY
        about = turn["about"].value if "about" in turn else [0, 0, 0]
        at = [a - b + c for a, b, c in zip(about, product(old, about), move.value if move else [0, 0, 0])]
        axis, angle = axis_and_angle(matrices(matrices(matrix, old), in_mesh))
        body["rotate"] = {"axis": Quantity(axis, "1"), "angle": Quantity(angle, "rad")}
        body["move"] = Quantity(place(at), "m")
    return twin


def with_half_spaces(tree):
    """A tree whose sets have no boxes, which lie along the axes: a box is what six half spaces have in common."""
    return {**tree, "bodies": [{**body, "sets": [part for one in body["sets"] for part in without_box(one)]} if "sets" in body else body
                               for body in tree["bodies"]]}


def without_box(one):
    """The sets that take the place of one.

    >>> corners = {"low": Quantity([0.0, 0.0, 0.0], "m"), "high": Quantity([1.0, 2.0, 3.0], "m")}
    >>> made = without_box({"name": Quantity("pad"), "box": corners})
    >>> made[-1]["all_of"].value == [part["name"].value for part in made[:-1]], made[3]["half_space"]["normal"].value
    (True, [0.0, -1.0, 0.0])
    """
    if "box" not in one:
        return [one]
    name, made = one["name"].value, []
    for axis in range(3):
        for end, sign in (("low", 1.0), ("high", -1.0)):
            normal = Quantity([sign if i == axis else 0.0 for i in range(3)], "1")
            made.append({"name": Quantity(f"{name}__{'xyz'[axis]}_{end}"), "half_space": {"point": one["box"][end], "normal": normal}})
    rest = {key: value for key, value in one.items() if key != "box"}
    return [*made, {**rest, "all_of": Quantity([part["name"].value for part in made])}]


def scaled(tree, scale):
    """Lengths, masses and times multiplied; the numbers of a case change, its units do not."""
    a, _, c = (repr(1 / one) for one in scale)
    arguments = {name: f"({name}*{a})" for name in "xyz"} | {"t": f"(t*{c})", "v": f"(v*{a}^3)"}

    def factor(unit):
        _, *powers = measure(unit)
        return math.prod(one ** power for one, power in zip(scale, powers))

    def visit(node):
        if isinstance(node, Texts):
            return Texts([times(in_other_variables(text, arguments), factor(node.dimension)) for text in node], node.dimension)
        if isinstance(node, list):
            return [visit(one) for one in node]
        if isinstance(node, dict):
            return {key: visit(one) for key, one in node.items()}
        if node.unit in (None, "1", "rad"):
            return node
        return Quantity([v * factor(node.unit) for v in node.value] if isinstance(node.value, list) else node.value * factor(node.unit),
                        node.unit)

    return visit(tree)
