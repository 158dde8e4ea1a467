"""Twins of the scenes in this folder: the same scene turned, mirrored, scaled, renumbered or written in other units.

A twin is made of the case as the program resolved it, in SI: nothing that the program read is left out. What has a
unit is known by it; directions, places and turns are known by their keys. Meshes of files are read and written anew.
Two runs are compared by their histories and last frames, carried from the base to the twin by the transformation itself.
"""
import csv
import itertools
import math
import re
from pathlib import Path

import meshes

FOLDER = "verification/invariance_scenes"
FROM_FILES = ("strike", "plates", "stack", "press")  # scenes whose meshes come from files
SCENES = (*FROM_FILES, "ball")
IDENTITY = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


# ------------------------------------------------------------------------------------------------
# Cases as trees

class Quantity:
    """A number or a list of numbers in SI, and its unit; None for a word."""

    def __init__(self, value, unit):
        self.value, self.unit = value, unit


class Texts(list):
    """One expression over x, y, z, t or three, in SI; `dimension` is the unit."""

    def __init__(self, texts, dimension):
        super().__init__(texts)
        self.dimension = dimension


def tree_of(run):
    """What a case says, without defaults: dictionaries and lists of Quantity and Texts."""
    return taken(run.summary["provenance"]["resolved"])


def taken(node):
    if isinstance(node, list):
        return [taken(one) for one in node]
    if "default" in node:
        return None if node["default"] else Quantity(node["value"], node["unit"])
    kept = {key: taken(one) for key, one in node.items() if not re.search(r"_file(_\d+)?$", key)}  # these say what a file held
    kept = {key: one for key, one in kept.items() if one is not None and one != {} and one != []}
    for key in ("value", "velocity", "displacement"):  # a text, or three, with its unit beside it
        if "unit" in kept and key in kept:
            texts = kept[key].value if isinstance(kept[key].value, list) else [kept[key].value]
            factor, *powers = measure(kept.pop("unit").value)
            kept[key] = Texts([times(text, factor) for text in texts], "*".join(f"{n}^{p}" for n, p in zip(("m", "kg", "s"), powers) if p))
    return kept


def times(text, factor):
    return text if factor == 1 else f"({text})*({factor!r})"


def in_other_variables(text, of):
    """An expression with x, y, z, t replaced."""
    return re.sub(r"\b[xyzt]\b", lambda found: of.get(found.group(), found.group()), text)


# ------------------------------------------------------------------------------------------------
# Units

# factor to SI, powers of length, mass and time
NAMES = {"m": (1, 1, 0, 0), "kg": (1, 0, 1, 0), "s": (1, 0, 0, 1), "N": (1, 1, 1, -2), "Pa": (1, -1, 1, -2), "MPa": (1e6, -1, 1, -2),
         "J": (1, 2, 1, -2), "1": (1, 0, 0, 0), "rad": (1, 0, 0, 0)}


def measure(unit):
    """Factor to SI and powers of length, mass and time of a unit such as `kg/m^3`, read from left to right.

    >>> measure("kg/m^3"), measure("N*m"), measure("MPa")
    ((1.0, -3, 1, 0), (1.0, 2, 1, -2), (1000000.0, -1, 1, -2))
    """
    factor, powers = 1.0, [0, 0, 0]
    for sign, name, power in re.findall(r"([*/ ]?)(\w+)(?:\^(-?\d+))?", unit):
        over = int(power or 1) * (-1 if sign == "/" else 1)
        one, *of_one = NAMES[name]
        factor *= one ** over
        powers = [a + over * b for a, b in zip(powers, of_one)]
    return (factor, *powers)


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
            return f"{value!r} rad"
        powers = self.powers(unit)
        size = math.prod(one ** power for one, power in zip(self.sizes, powers))
        return f"{value / size!r} {self.name(powers)}"

    def name(self, powers):
        return "*".join(name + (f"^{power}" if power != 1 else "") for name, power in zip(self.names, powers) if power)


SI = System(("m", 1), ("N", 1), ("s", 1))


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
            texts = ", ".join(f'"{times(text, 1 / size)}"' for text in one)
            lines += [f"{head} [{texts}]" if len(one) > 1 else f"{head} {texts}", f"{' ' * indent}unit: {system.name(powers)}"]
        else:
            lines += [head, *written(one, system, indent + 2)]
    return lines


def leaf(one, system):
    if isinstance(one.value, list):
        return "[" + ", ".join(leaf(Quantity(v, one.unit), system) for v in one.value) + "]"
    if isinstance(one.value, (int, float)) and not isinstance(one.value, bool):
        whole = one.unit == "1" and float(one.value).is_integer()
        return str(int(one.value)) if whole else system.write(float(one.value), one.unit)
    return str(one.value).lower() if isinstance(one.value, bool) else str(one.value)


def in_units(tree, scratch, label, system):
    """The case in other units; meshes of files stay in metres."""
    return put_down(tree, scratch, label, system=system)


# ------------------------------------------------------------------------------------------------
# Transformations

class Carry:
    """What becomes of a result: lengths, masses and times scaled, vectors turned, nodes and cells renumbered."""

    def __init__(self, matrix=IDENTITY, scale=(1, 1, 1), nodes=None, cells=None):
        self.matrix, self.scale, self.nodes, self.cells = matrix, scale, nodes, cells

    def factor(self, unit):
        _, *powers = measure(unit)
        return math.prod(one ** power for one, power in zip(self.scale, powers))

    def vector(self, v):
        return v if self.matrix is IDENTITY else product(self.matrix, v)

    def tensor(self, s):
        """Six components xx, yy, zz, xy, yz, xz."""
        if self.matrix is IDENTITY:
            return s
        full = ((s[0], s[3], s[5]), (s[3], s[1], s[4]), (s[5], s[4], s[2]))
        turned = matrices(self.matrix, matrices(full, transposed(self.matrix)))
        return [turned[i][j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]


def product(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in matrix]


def transposed(matrix):
    return [list(row) for row in zip(*matrix)]


def matrices(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def determinant(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))


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


def moved(tree, matrix, shift):
    """x -> matrix x + shift, for a matrix that turns or mirrors. A mirrored mesh is one whose x has changed its sign."""
    mirror = determinant(matrix) < 0
    back = transposed(matrix)
    from_twin = {name: "(" + " + ".join(f"({m!r})*({old} - ({s!r}))" for m, old, s in zip(row, "xyz", shift)) + ")"
                 for name, row in zip("xyz", back)}

    def place(p):
        return [a + b for a, b in zip(product(matrix, p), shift)]

    def combined(texts, sign):
        return [" + ".join(f"({sign * m!r})*({text})" for m, text in zip(row, texts) if m) for row in matrix]

    def visit(node):
        if isinstance(node, Texts):
            texts = [in_other_variables(text, from_twin) for text in node]
            return Texts(texts, node.dimension)
        if isinstance(node, list):
            return [visit(one) for one in node]
        if not isinstance(node, dict):
            return node
        new = {key: visit(one) for key, one in node.items()}
        for key in ("value", "velocity", "displacement"):
            if isinstance(new.get(key), Texts) and len(new[key]) == 3:
                turns = "kind" in new and new["kind"].value == "moment"  # its sense is turned about by a mirror
                new[key] = Texts(combined(new[key], -1 if turns and mirror else 1), new[key].dimension)
        for key, change in (("normal", lambda v: product(matrix, v)), ("point", place), ("near", place)):
            if key in new:
                new[key] = Quantity(change(new[key].value), new[key].unit)
        return new

    twin = visit(tree)
    if "gravity" in twin:
        twin["gravity"] = Quantity(product(matrix, tree["gravity"].value), tree["gravity"].unit)
    for body in twin["bodies"]:
        turn, move = body.pop("rotate", {}), body.pop("move", None)
        old = rotation(turn["axis"].value, turn["angle"].value) if turn else IDENTITY
        about = turn["about"].value if "about" in turn else [0, 0, 0]
        at = [a - b + c for a, b, c in zip(about, product(old, about), move.value if move else [0, 0, 0])]
        new = matrices(matrix, old)
        if mirror:
            new = [[-row[0], *row[1:]] for row in new]
        axis, angle = axis_and_angle(new)
        body["rotate"] = {"axis": Quantity(axis, "1"), "angle": Quantity(angle, "rad")}
        body["move"] = Quantity(place(at), "m")
    return twin


def mirrored(mesh):
    """A mesh with the sign of x changed; cells go round the other way, so that they are not inside out."""
    order = {8: (0, 3, 2, 1, 4, 7, 6, 5), 3: (1, 0, 2)}
    return meshes.Mesh([[-x, y, z] for x, y, z in mesh.points], [[cell[i] for i in order[len(cell)]] for cell in mesh.cells], mesh.sets)


def scaled(tree, scale):
    """Lengths, masses and times multiplied; the numbers of a case change, its units do not."""
    carry = Carry(scale=scale)
    a, _, c = (repr(1 / one) for one in scale)
    arguments = {name: f"({name}*{a})" for name in "xyz"} | {"t": f"(t*{c})"}

    def visit(node):
        if isinstance(node, Texts):
            return Texts([times(in_other_variables(text, arguments), carry.factor(node.dimension)) for text in node], node.dimension)
        if isinstance(node, list):
            return [visit(one) for one in node]
        if isinstance(node, dict):
            return {key: visit(one) for key, one in node.items()}
        if node.unit in (None, "1", "rad"):
            return node
        factor = carry.factor(node.unit)
        return Quantity([v * factor for v in node.value] if isinstance(node.value, list) else node.value * factor, node.unit)

    return visit(tree)


CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def turns_of_a_cube():
    """The 24 orders in which the corners of a hexahedron may be counted.

    >>> len(turns_of_a_cube())
    24
    """
    found = []
    for axes in itertools.permutations(range(3)):
        for flips in itertools.product((0, 1), repeat=3):
            order = [tuple(corner[axes[i]] ^ flips[i] for i in range(3)) for corner in CORNERS]
            sides = [[order[to][i] - order[0][i] for i in range(3)] for to in (1, 3, 4)]
            if determinant(sides) > 0:
                found.append([CORNERS.index(corner) for corner in order])
    return found


def renumbered(mesh, shuffled, other_corners=False):
    """Nodes in another order, cells too, and the corners of hexahedra. Triangles are counted from another corner only if
    `other_corners` says so.

    shuffled(n)  the numbers 0 to n - 1 in another order
    returns      the mesh, the new number of each node, the new number of each cell
    """
    count, solid = len(mesh.points), len(mesh.cells[0]) == 8
    orders = turns_of_a_cube() if solid else [(0, 1, 2), (1, 2, 0), (2, 0, 1)] if other_corners else [(0, 1, 2)]
    old = shuffled(count)  # by new number
    new_of_node = {one: new for new, one in enumerate(old)}
    old_cells = shuffled(len(mesh.cells))
    new_of_cell = {one: new for new, one in enumerate(old_cells)}
    cells = [[new_of_node[mesh.cells[one][i]] for i in orders[one % len(orders)]] for one in old_cells]
    sets = {name: [flags[i] for i in old] for name, flags in mesh.sets.items()}
    return (meshes.Mesh([mesh.points[i] for i in old], cells, sets), [new_of_node[i] for i in range(count)],
            [new_of_cell[i] for i in range(len(mesh.cells))])


# ------------------------------------------------------------------------------------------------
# Running and comparing

def base_of(run, scene):
    """The run of a scene as it stands in this folder."""
    return run.other("scene", f"{FOLDER}/{scene}.yaml")


def scratch_of(run):
    return run.runner.scratch


def put_down(tree, scratch, label, system=SI, change=lambda mesh, body: mesh):
    """Writes a twin and its meshes; returns the path of its case."""
    root = Path(__file__).resolve().parent
    scratch.mkdir(parents=True, exist_ok=True)
    for body in tree["bodies"]:
        if "path" in body["mesh"]:
            name = f"{label}_{body['name'].value}.vtu"
            meshes.write(scratch / name, change(meshes.read(root / Path(body["mesh"]["path"].value).name), body["name"].value))
            body["mesh"] = {**body["mesh"], "path": Quantity(name, None)}
    path = scratch / f"{label}.yaml"
    path.write_text("\n".join(written(tree, system)) + "\n", encoding="utf-8")
    return path


def twin_of(run, path):
    """The run of a twin; a break is set in the twin alone, so that it differs from the base by one mistake."""
    return run.other("scene", str(path), run.overrides)


def history(run):
    """Columns of history.csv: {name: (unit, numbers)}."""
    with (run.folder / "history.csv").open(newline="", encoding="utf-8") as stream:
        head, *rows = csv.reader(stream)
    return {name.split(" [")[0]: (name.split(" [")[1].rstrip("]"), [float(row[i]) for row in rows]) for i, name in enumerate(head)}


def apart(ours, theirs):
    """The largest difference of two lists; no number beside no number differs by nothing."""
    worst = 0.0
    for a, b in zip(ours, theirs):
        if not (math.isnan(a) and math.isnan(b)):
            d = abs(a - b)
            worst = d if not d <= worst else worst
    return worst


def relative(difference, scale):
    """A difference over the largest of all values on both sides, of which all may be zero."""
    return difference / scale if scale > 0 else difference


def size(values):
    return max((abs(v) for v in values if not math.isnan(v)), default=0.0)


def histories(base, twin, carry=Carry(), only=None):
    """The largest difference of each column over its largest value; energies over the largest energy. 1 where rows are missing."""
    ours, theirs = history(base), history(twin)
    back = {name: [v / carry.factor(unit) for v in theirs[name][1]] for name, (unit, _) in ours.items()}
    most = {name: max(size(column), size(back[name])) for name, (_, column) in ours.items()}
    most_energy = max(v for name, v in most.items() if name.startswith("energy_"))
    found = {"rows": float(len(ours["time"][1]) != len(theirs["time"][1]))}
    for name, (_, column) in ours.items():
        if only is None or name in only:
            scale = most_energy if name.startswith("energy_") else most[name]
            found[name] = relative(apart(column, back[name]), scale)
    return found


UNITS = {"displacement": "m", "velocity": "m/s", "contact_force": "N", "stress": "Pa", "von_mises": "Pa", "pressure": "Pa",
         "plastic_strain": "1"}
NODAL = ("displacement", "velocity", "contact_force")


def fields(base, twin, carry=Carry()):
    """The largest difference of each field of the last frames over its largest component."""
    (_, ours), (_, theirs) = base.frame("body"), twin.frame("body")
    found = {}
    for name, unit in UNITS.items():
        if name not in ours:
            continue
        factor = carry.factor(unit)
        where = carry.nodes if name in NODAL else carry.cells
        turned = carry.vector if name in NODAL else carry.tensor
        worst, scale = 0.0, 0.0
        for i, one in enumerate(ours[name]):
            other = theirs[name][i if where is None else where[i]]
            one, other = (turned(one), other) if isinstance(one, tuple) else ((one,), (other,))
            other = [v / factor for v in other]
            d = apart(one, other)
            worst = d if not d <= worst else worst
            scale = max(scale, size(one), size(other))
        found[name] = relative(worst, scale)
    return found


def ledgers(base, twin, carry=Carry()):
    """Momentum of the whole scene and impulses of all sources, over the largest of them."""
    factor = carry.factor("kg*m/s")
    pairs = [(base.ledger("momentum"), twin.ledger("momentum"))]
    for name, account in base.summary["ledger"]["accounts"].items():
        pairs.append((account["impulse"]["value"], twin.account(name)["impulse"]["value"]))
    pairs = [(carry.vector(ours), [v / factor for v in theirs]) for ours, theirs in pairs]
    scale = max(size(v) for pair in pairs for v in pair)
    return {"impulses": relative(max(apart(*pair) for pair in pairs), scale)}


def differences(base, twin, carry=Carry()):
    """All that is compared: {name: largest relative difference}."""
    return {**histories(base, twin, carry), **fields(base, twin, carry), **ledgers(base, twin, carry)}


def largest(found):
    """The largest difference, and infinity where one is no number."""
    return max(math.inf if math.isnan(v) else v for v in found.values())


# ------------------------------------------------------------------------------------------------
# Checks

# What a difference of 1e-12 in the first velocities has grown to at the end of each scene, and the limit of round-off, ten
# times what any twin has shown.
GROWN = {"strike": 4e-12, "plates": 7e-11, "stack": 1.4e-10, "press": 6e-11, "ball": 6e-11}
ROUND_OFF = {"strike": 5e-11, "plates": 1e-10, "stack": 1e-9, "press": 2e-9, "ball": 3e-10}


def because(scene):
    return (f"round-off alone; a disturbance of 1e-12 at the start of this scene grows to {GROWN[scene]:.2g}, "
            "and no twin has shown more than a tenth of the limit")


def twins(run, scene, make):
    """Base, twin and carry; `make(run, base, scene)` gives the path of the twin's case and the Carry of its results."""
    base = base_of(run, scene)
    path, carry = make(run, base, scene)
    return base, twin_of(run, path), carry


def difference(run, scene, make):
    """The largest relative difference of all that is compared; infinite where one of both has stopped early."""
    base, twin, carry = twins(run, scene, make)
    return largest(differences(base, twin, carry)) if base.ending == twin.ending else math.inf


def summary_rows(run, scene, make):
    """For a table: scene, steps, largest difference of histories, fields and impulses, and where the largest stands."""
    base, twin, carry = twins(run, scene, make)
    parts = [histories(base, twin, carry), fields(base, twin, carry), ledgers(base, twin, carry)]
    together = {name: v for part in parts for name, v in part.items()}
    return [scene, base.summary["cost"]["steps"], *(f"{largest(part):.1e}" for part in parts), max(together, key=together.get)]


COLUMNS = ["scene", "steps", "histories", "last frame", "impulses", "most in"]


def curve(run, scene, make, name, ours):
    """A column of the twin, or of the base, over the time of the base [us], carried back where it was scaled."""
    base, twin, carry = twins(run, scene, make)
    one = base if ours else twin
    columns = history(one)
    factors = (1, 1) if ours else (carry.factor(columns["time"][0]), carry.factor(columns[name][0]))
    return [1e6 * t / factors[0] for t in columns["time"][1]], [v / factors[1] for v in columns[name][1]]
