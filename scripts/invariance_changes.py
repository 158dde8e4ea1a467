"""The changes of scripts/invariance: each makes twins of a case that must have the same results, or says why it cannot.

What a case cannot express is skipped with its reason (CannotChange) and never guessed. Results that a change does not carry over, as the
extent of a body along x when it is turned, are skipped by name.
"""
import copy
import dataclasses
import json
import math
import os
import random
import re
import shutil
import signal
import subprocess
import time

import compare_runs
import mesh_files
import processes
import twins
from compare_runs import Carry
from runs import STOPPED, Refused
from twins import Quantity, Texts, word_of

ROUND_OFF, BITS, MODEL = "round-off", "bits", "model"
AXIS, ANGLE = (1.0, -2.0, 0.7), 2.1   # [-], [rad] of the rotation: parallel to nothing, and no part of a circle
NORMAL = (math.cos(0.6), math.sin(0.6), 0.3)  # [-] of the mirror
DISTURBANCE = 1e-12  # [-] of the largest speed; and of the largest coordinate a tenth of it
WAVES = 40           # [-] of the disturbance, over the size of the scene, as the angle of a sine
POLAR = ("displacement", "velocity", "acceleration", "position", "momentum", "force", "impulse", "current_force")
AXIAL = ("angular_velocity", "angular_momentum", "section_moment")  # their sense goes the other way round in a mirror
TENSORS = ("stress", "strain")
STRESSES = ("xx", "yy", "zz", "xy", "yz", "xz")
TURNED_AWAY = ("extent", "radius")                      # along fixed axes: a turned body has others
FOLLOWS = {"velocity": "1", "displacement": "t", "position": "t"}  # what the velocity of a frame of reference adds to them, times this
IN_A_FRAME = ("momentum", "kinetic_energy", "angular_momentum", "radius")  # of a moving observer they are others
INTERRUPTED = 6                                         # exit status of a driver that a signal has stopped
BUILDS_ITSELF = "the program builds its bodies itself; only a case of `scene` has them"


class CannotChange(Exception):
    """A change cannot be made to this case; says why."""


@dataclasses.dataclass
class Twin:
    """A run beside the base that it is compared with.

    probes   {column of the base: (columns of the twin, what makes the value of the base of time and those)}
    skipped  names of columns that are not compared
    field    what is done to a field of the twin, of (time, name, value)
    moves    {unit: the largest value that the motion of the frame of reference makes}: results of the twin are rounded by these
    farther  [-] by how much positions of the twin are larger, and their round-off with them
    """
    base: object
    run: object
    carry: Carry = dataclasses.field(default_factory=Carry)
    probes: dict = dataclasses.field(default_factory=dict)
    skipped: dict = dataclasses.field(default_factory=dict)
    field: object = None
    frame_moves: bool = False
    moves: dict = dataclasses.field(default_factory=dict)
    farther: float = 1.0


@dataclasses.dataclass
class Change:
    name: str
    kind: str
    says: str
    make: object  # of a Scene: gives a Twin; of BITS, the names of what differs


# ------------------------------------------------------------------------------------------------
# A case and its bases

def label_of(case):
    """The name of a case in tables, of its folder and its file."""
    return f"{case.parent.name}_{case.stem}"


class Scene:
    """A case, its run as it stands, and the same case as the program resolved it, of which twins are made."""

    def __init__(self, store, driver, case, overrides, label=""):
        self.store, self.driver, self.case = store, driver, case
        self.original = store.run(driver, case, overrides)
        self.label = label_of(case) + label
        self.resolved = self.original.summary["provenance"]["resolved"]
        self.tree = twins.tree_of(self.original)
        self.stopped = self.original.ending == "stopped_by_condition"
        if self.stopped:  # a condition may ask for a probe that the change renames, so that all runs go to where it was met
            del self.tree["stop"]
            if "stages" not in self.tree:
                self.tree["time"]["end"] = Quantity(self.original.summary["ending"]["time"]["value"], "s")
        if "output" in self.resolved:
            self.tree.setdefault("output", {})
            for key in ("history_every", "frames_every"):  # which follow from the run where the case does not say them
                one = self.resolved["output"].get(key) or self.original.summary["cost"][key]
                self.tree["output"][key] = Quantity(one["value"], one["unit"])
            self.tree["output"]["precision"] = Quantity("double")
        self.files = None
        self.base = self.run("base", self.tree)

    def run(self, label, tree, threads=None, system=twins.SI):
        """The run of a changed tree."""
        path = twins.put_down(copy.deepcopy(tree), self.case.parent, self.store.scratch / self.label, label, system)
        return self.store.run(self.driver, path, {}, threads)

    def refine(self):
        """The factor on all counts of cells that the case has."""
        return self.resolved.get("refine", {}).get("value", 1.0)

    def bodies(self):
        if "bodies" not in self.tree:
            raise CannotChange(BUILDS_ITSELF)
        return self.tree["bodies"]

    def contacts(self, tree):
        """The sections of contacts of a tree: a list in scenes, one section in other programs."""
        if "bodies" in tree:
            return tree.get("contacts", [])
        return [tree.setdefault(key, {}) for key in ("contact", "interface") if key in self.resolved]

    def needs_steps(self):
        if "output" not in self.resolved:
            raise CannotChange("the program makes no time steps")

    def relaxes(self):
        return "relaxation" in self.tree or any("relaxation" in stage for stage in self.tree.get("stages", []))

    def frames(self):
        """Fields of the first and the last frame."""
        return [self.base.frame("body", number)[1] for number in (0, -1)]

    def size(self):
        """The largest distance of a node from the origin. [m]"""
        return max(max(map(abs, p)) for p in self.frames()[0]["points"])

    def speed(self):
        """The largest of a node in the first and last frame, or what gravity makes; without any, size over time of the run. [m/s]"""
        found = max(max(map(abs, v)) for frame in self.frames() for v in frame["velocity"])
        end = self.base.column("time")[-1]
        return max(found, compare_runs.size(compare_runs.gravity_of(self.base)) * end) or self.size() / end

    def from_files(self):
        """(tree, meshes by body) of the case with all shapes in files."""
        if self.files is None:
            tree, meshes = copy.deepcopy(self.tree), {}
            self.bodies()
            for number, body in enumerate(tree["bodies"]):
                name = body["name"].value
                if "path" in body["mesh"]:
                    try:
                        meshes[name] = mesh_files.read(self.case.parent / body["mesh"]["path"].value)
                        for _ in range(round(math.log2(self.refine()))):  # a case with a file has no other factors than 1, 2 and 4
                            meshes[name] = mesh_files.split(meshes[name])
                    except mesh_files.Unreadable as error:
                        raise CannotChange(str(error)) from error
                    body["mesh"]["path"] = Quantity(f"files_{name}.vtu")
                else:
                    meshes[name] = self.mesh_of_shape(number, body, tree)
            tree.pop("refine", None)
            folder = self.store.scratch / self.label
            for name, mesh in meshes.items():
                mesh_files.write(folder / f"files_{name}.vtu", mesh)
            self.files = tree, meshes
        return self.files

    def mesh_of_shape(self, number, body, tree):
        """The mesh of a shape as the program builds it, from a run of the body alone; the body then has it in a file."""
        shape = body["mesh"]
        alone = {key: one for key, one in body.items() if key in ("name", "material", "element", "start")}
        alone["mesh"] = {key: one for key, one in shape.items() if key not in ("map", "scale")}
        bare = {"bodies": [alone], "time": {"end": Quantity(1e-12, "s")}}
        if "refine" in tree:
            bare["refine"] = tree["refine"]
        made = self.run(f"shape_{number}", bare).frame("body", 0)[1]
        try:
            sets = mesh_files.sets_of_shape({key: one.value for key, one in shape.items()}, made["points"])
        except mesh_files.Unreadable as error:
            raise CannotChange(str(error)) from error
        if (exact := exact_shape(body)) is not None:
            body["shape"] = exact
        ends = made["offsets"]
        cells = [list(made["connectivity"][begin:end]) for begin, end in zip([0, *ends], ends)]
        body["mesh"] = {"kind": Quantity("file"), "path": Quantity(f"files_{body['name'].value}.vtu"),
                        **{key: one for key, one in shape.items() if key in ("map", "scale")}}
        if shape["kind"].value == "tube":
            rename(tree, {f"{body['name'].value}.{old}": f"{body['name'].value}.{new}"
                          for old, new in mesh_files.SURFACES_OF_FILES.items()})
            rename(body.get("sets", []), mesh_files.SURFACES_OF_FILES)
        return mesh_files.Mesh([list(p) for p in made["points"]], cells, sets)

    def base_from_files(self):
        """The run of the case with all shapes in files, as fine as `refine` makes them; the base itself where they are."""
        tree, _ = self.from_files()
        shapes = self.refine() != 1 or any("path" not in body["mesh"] for body in self.tree["bodies"])
        return self.run_files("files", tree) if shapes else self.base

    def run_files(self, label, tree, change=None):
        tree = copy.deepcopy(tree)
        folder = self.store.scratch / self.label
        path = twins.put_down(tree, folder, folder, label, change=change)
        return self.store.run(self.driver, path, {})


def exact_shape(body):
    """The section `shape` with which a rigid body touches as with the mesh that it has; None if it touches with its facets.

    >>> ball = {"kind": Quantity("sphere"), "radius": Quantity(0.1, "m"), "turn": Quantity("full")}
    >>> exact_shape({"rigid": Quantity(True), "mesh": ball})["radius"].value
    0.1
    >>> exact_shape({"mesh": ball}) is None
    True
    """
    mesh = body["mesh"]
    if not word_of(body, "rigid", False) or word_of(body, "surface", "exact") == "facets" or "map" in mesh or "shape" in body:
        return None
    kind, scale = mesh["kind"].value, mesh["scale"].value if "scale" in mesh else 1.0
    if kind not in ("sphere", "cylinder", "tube") or mesh["turn"].value != "full":
        return None
    shape = {"kind": Quantity(kind), "radius": Quantity(scale * mesh["radius"].value, "m")}
    if kind != "sphere":
        length = scale * mesh["length"].value
        shape.update(length=Quantity(length, "m"), centre=Quantity([0.0, 0.0, length / 2], "m"), axis=Quantity([0.0, 0.0, 1.0]))
    return shape


def leaves(node):
    """All values of a tree."""
    if isinstance(node, (Quantity, Texts)):
        yield node
    else:
        for one in node.values() if isinstance(node, dict) else node:
            yield from leaves(one)


def rename(tree, names):
    """Puts other words into a tree."""
    for one in leaves(tree):
        if isinstance(one, Quantity) and one.unit is None:
            one.value = [names.get(word, word) for word in one.value] if isinstance(one.value, list) else names.get(one.value, one.value)


# ------------------------------------------------------------------------------------------------
# Probes with a direction

def with_components(tree, matrix=twins.IDENTITY, velocity=None):
    """Gives probes with a direction all their components, so that they can be carried back; returns (probes, skipped) of a Twin.

    A probe that a formula needs is a formula of its components in the twin, so that the formula has there what it has in the base.

    velocity  [m/s] of the frame that moves
    """
    probes, skipped, made, images = {}, {}, [], []
    mirrors = twins.determinant(matrix) < 0
    for probe in tree.get("probes", []):
        name, quantity, component = probe["name"].value, word_of(probe, "quantity"), word_of(probe, "component")
        vector = quantity in POLAR or quantity in AXIAL
        to_split = vector and (component in ("x", "y", "z") or velocity is not None and component != "normal")
        if quantity is None:
            of = sorted(twins.names_in(probe["value"].value) & set(skipped))
            if of:
                skipped[name] = f"it is computed of '{of[0]}', which is not compared"
            made += [one for one in images if one["name"].value in twins.names_in(probe["value"].value)
                     and one["name"].value not in {other["name"].value for other in made}]
        elif velocity is not None and quantity in IN_A_FRAME or velocity is None and quantity in TURNED_AWAY:
            skipped[name] = f"{quantity} of a probe is another one in the other frame"
        elif "along" in probe:
            pass  # its direction has turned with the case
        elif velocity is None and quantity in TENSORS and word_of(probe, "take", "mean") != "mean":
            skipped[name] = f"the largest component of a {quantity} has no image"
        elif velocity is None and quantity in TENSORS:
            made += [{**probe, "name": Quantity(f"{name}__{c}"), "component": Quantity(c)} for c in STRESSES]
            probes[name] = [f"{name}__{c}" for c in STRESSES], tensor_back(matrix, STRESSES.index(component))
            images.append(image(name, tensor_text(matrix, probes[name][0], STRESSES.index(component))))
            continue
        elif to_split:
            made += [{**probe, "name": Quantity(f"{name}__{c}"), "component": Quantity(c)} for c in "xyz"]
            sign = -1 if mirrors and quantity in AXIAL else 1
            probes[name] = [f"{name}__{c}" for c in "xyz"], vector_back(matrix, sign, quantity, component, velocity)
            images.append(image(name, vector_text(matrix, probes[name][0], sign, quantity, component, velocity)))
            continue
        made.append(probe)
    if made:
        tree["probes"] = made
    return probes, skipped


def vector_back(matrix, sign, quantity, component, velocity):
    """What makes the component of the base of the time and the three of the twin."""
    def back(at, v):
        v = [sign * x for x in twins.product(twins.transposed(matrix), v)]
        if velocity is not None:
            v = moved_with(quantity, at, v, velocity)
        return v["xyz".index(component)] if component in ("x", "y", "z") else math.hypot(*v)
    return back


def tensor_back(matrix, index):
    return lambda _, s: twins.tensor(twins.transposed(matrix), s)[index]


def image(name, text):
    """The formula that has in the twin what the probe of this name has in the base."""
    return {"name": Quantity(name), "value": Quantity(text)}


def vector_text(matrix, names, sign, quantity, component, velocity):
    """vector_back as an expression of the names of the components and of t."""
    texts = [" + ".join(f"({sign * m!r})*{name}" for m, name in zip(row, names)) for row in twins.transposed(matrix)]
    if velocity is not None and quantity in FOLLOWS:
        texts = [f"{text} - ({v!r})*({FOLLOWS[quantity]})" for text, v in zip(texts, velocity)]
    return texts["xyz".index(component)] if component in ("x", "y", "z") else "sqrt(" + " + ".join(f"({text})^2" for text in texts) + ")"


def tensor_text(matrix, names, index):
    """tensor_back as an expression of the names of the components."""
    back = tensor_back(matrix, index)
    parts = [back(None, [float(i == j) for j in range(len(names))]) for i in range(len(names))]
    return " + ".join(f"({part!r})*{name}" for part, name in zip(parts, names))


def moved_with(quantity, at, v, velocity):
    """A vector as an observer who moves with the frame has it."""
    part = {"1": 1.0, "t": at}.get(FOLLOWS.get(quantity), 0.0)
    return [a - part * b for a, b in zip(v, velocity)]


# ------------------------------------------------------------------------------------------------
# Round-off

def rotated(scene):
    scene.bodies()
    matrix = twins.rotation(AXIS, ANGLE)
    tree = twins.moved(scene.tree, matrix)
    probes, skipped = with_components(tree, matrix)
    return Twin(scene.base, scene.run("rotated", tree), Carry(matrix=matrix), probes, skipped)


def mirrored(scene):
    base, (tree, _) = scene.base_from_files(), scene.from_files()
    matrix = twins.reflection(NORMAL)
    tree = twins.moved(tree, matrix, mirror="xy")
    probes, skipped = with_components(tree, matrix)
    run = scene.run_files("mirrored", tree, change=lambda mesh, _: mesh_files.mirrored(mesh, "xy"))
    return Twin(base, run, Carry(matrix=matrix), probes, skipped)


def numbers(scene):
    base, (tree, _) = scene.base_from_files(), scene.from_files()
    chance, nodes = random.Random(7), []

    def shuffled(count):
        order = list(range(count))
        chance.shuffle(order)
        return order

    def change(mesh, _):
        new, of_node, _ = mesh_files.renumbered(mesh, shuffled)
        first = len(nodes)
        nodes.extend(first + i for i in of_node)
        return new

    run = scene.run_files("numbers", tree, change=change)
    return Twin(base, run, Carry(nodes=nodes, cells=cells_of(base, run, nodes)))


def cells_of(base, run, nodes):
    """The number of each cell of the base in the run whose nodes have other numbers."""
    def cells(one):
        fields = one.frame("body", 0)[1]
        ends = fields["offsets"]
        return [fields["connectivity"][begin:end] for begin, end in zip([0, *ends], ends)]

    at = {frozenset(cell): number for number, cell in enumerate(cells(run))}
    return [at[frozenset(nodes[i] for i in cell)] for cell in cells(base)]


def units(scene):
    try:
        return Twin(scene.base, scene.run("units", scene.tree, system=twins.TECHNICAL))
    except twins.UnknownUnit as error:
        raise CannotChange(str(error)) from error


def moving(scene):
    """Galilei: all bodies, and what holds or drives them, have a constant velocity more."""
    tree = copy.deepcopy(scene.tree)
    scene.bodies()
    scene.needs_steps()
    if scene.relaxes():
        raise CannotChange("relaxation damps all velocities, so that it stands still")
    if any(word_of(spring, "to") == "ground" for spring in tree.get("springs", [])):
        raise CannotChange("the ground of a spring stands still")
    still = []
    for plane in tree.get("planes", []):
        kind = plane["kind"].value
        if kind == "rigid" and word_of(plane, "friction", 0):
            raise CannotChange(f"the rigid plane '{plane['name'].value}' has friction and stands still")
        if kind in ("rigid", "symmetry", "floor"):
            still.append(plane["normal"].value)
    velocity = [scene.speed() * x for x in across(still)]
    for plane in tree.get("planes", []):
        kind = plane["kind"].value
        if kind == "fixed":
            plane["kind"] = Quantity("driven")
            plane["velocity"] = {"value": twins.constant(velocity, "m/s")}
        elif kind == "driven":
            driven = plane["velocity"]["value"]
            plane["velocity"] = {"value": Texts([f"({text}) + ({v!r})" for text, v in zip(driven, velocity)], driven.dimension)}
        elif kind == "constrained":
            normal = plane["normal"].value
            along = sum(a * b for a, b in zip(normal, velocity)) / math.hypot(*normal)
            own = plane["velocity"]["value"][0] if "velocity" in plane else "0"
            plane["velocity"] = {"value": Texts([f"({own}) + ({along!r})"], "m/s")}
    tree["initial"] = [*tree.get("initial", []), *({"body": body["name"], "velocity": twins.constant(velocity, "m/s")}
                                                   for body in tree["bodies"])]
    probes, skipped = with_components(tree, velocity=velocity)
    run = run_or_skip(scene, "moving", tree)
    way = scene.speed() * scene.base.column("time")[-1]
    return Twin(scene.base, run, probes=probes, skipped=skipped, frame_moves=True, farther=1 + way / scene.size(),
                field=lambda at, name, v: moved_with(name, at, v, velocity),
                moves={"m/s": scene.speed(), "m": way,
                       "energy": compare_runs.scales(run)[1].get("energy", 0.0)})


def across(normals):
    """A unit vector along all planes of these normals, parallel to nothing else."""
    found, basis = [0.6, -0.52, 0.61], []
    for vector in (*normals, found):
        for one in basis:
            part = sum(a * b for a, b in zip(vector, one))
            vector = [a - part * b for a, b in zip(vector, one)]
        size = math.hypot(*vector)
        basis += [[a / size for a in vector]] if size > 1e-9 else []
        found = vector
    if math.hypot(*found) < 1e-6:
        raise CannotChange("its symmetry planes, floors and rigid planes stand still, and no direction is along all of them")
    size = math.hypot(*found)
    return [a / size for a in found]


def run_or_skip(scene, label, tree):
    """The run of a case that the program may refuse with good reason."""
    try:
        return scene.run(label, tree)
    except Refused as error:
        raise CannotChange("the program refuses it: " + re.sub(r"^.*?:[0-9]+:[0-9]+: ", "", error.said)) from error


def disturbed(scene, tree, sign, label, run):
    """The case with a small velocity and displacement of each body that change from place to place: the run shows how round-off grows."""
    tree = copy.deepcopy(tree)
    if "bodies" not in tree:
        return run(f"{label}_{sign}", multiplied(tree, 1 + sign * DISTURBANCE))
    chance, size, steps = random.Random(11), scene.size(), "output" in scene.resolved
    shift = sign * 0.1 * DISTURBANCE * size
    speed = sign * DISTURBANCE * scene.speed() if steps else 0

    def waves(amplitude):
        return [f"{amplitude * chance.uniform(0.5, 1)!r}*sin({chance.uniform(0, 6)!r}" +
                "".join(f" + {WAVES * chance.uniform(0.5, 1) / size!r}*{x}" for x in "xyz") + ")" for _ in "xyz"]

    def rigid_motion(amplitude):
        return [f"{amplitude * chance.uniform(0.5, 1)!r} + {amplitude / size!r}*({a} - {b})" for a, b in ("zy", "xz", "yx")]

    for body in tree["bodies"]:
        rigid, mesh = word_of(body, "rigid", False), body["mesh"]
        if not steps:
            mesh["map"] = Quantity([f"{text} + {wave}" for text, wave in zip(word_of(mesh, "map", "xyz"), waves(shift))])
            continue
        added = []
        if not scene.relaxes():
            added.append({"body": body["name"], "velocity": Texts((rigid_motion if rigid else waves)(speed), "m/s")})
        if not rigid and "stages" not in tree:
            added.append({"body": body["name"], "displacement": Texts(waves(shift), "m")})
        if added:
            tree["initial"] = [*tree.get("initial", []), *added]
    if scene.relaxes() and "stages" in tree:  # which leave no place for either
        tree = multiplied(tree, 1 + sign * DISTURBANCE)
    return run(f"{label}_{sign}", tree)


def multiplied(tree, factor):
    """Velocities times a factor; without any, accelerations; without these, stresses."""
    for dimension in ("m/s", "m/s^2", "Pa"):
        found = [one for one in leaves(tree) if dimension_of(one) == twins.measure(dimension)]
        for one in found:
            if isinstance(one, Texts):
                one[:] = [twins.times(text, factor) for text in one]
            else:
                one.value = [x * factor for x in one.value] if isinstance(one.value, list) else one.value * factor
        if found:
            break
    return tree


def dimension_of(leaf):
    unit = leaf.dimension if isinstance(leaf, Texts) else leaf.unit
    return twins.measure(unit) if unit else None


# ------------------------------------------------------------------------------------------------
# Modelling

def with_passes(passes):
    def make(scene):
        tree = copy.deepcopy(scene.tree)
        changed, contacts = [], []
        for one in scene.contacts(tree):
            kind = word_of(one, "kind", "contact")
            if kind == "automatic":
                pairs = declared_pairs(scene, one, passes)
                contacts += pairs
                changed += pairs
                continue
            if kind == "contact" and word_of(one, "passes", "one") != passes:
                one["passes"] = Quantity(passes)
                changed.append(one)
            contacts.append(one)
        if not changed:
            raise CannotChange(f"it has no contact that could have {passes} pass{'es' if passes == 'two' else ''} instead")
        skipped = {}
        if "bodies" in tree:
            skipped = without_probes_of(tree, {one["name"].value for one in tree["contacts"]} - {one["name"].value for one in contacts})
            tree["contacts"] = contacts
        return Twin(scene.base, run_or_skip(scene, f"passes_{passes}", tree), skipped=skipped)
    return make


def declared_pairs(scene, contact, passes):
    """The pairs that an automatic contact has found, as contacts of their own."""
    name = contact["name"].value
    sides = [one["sides"] for one in scene.base.summary.get("touched", []) if one["contact"] == name]
    if any(a == b for a, b in sides):
        raise CannotChange("a body touches itself, which declared contacts do not see")
    if not sides:
        raise CannotChange(f"by '{name}' no bodies touch, so that there is no pair to declare")
    options = {key: one for key, one in contact.items() if key not in ("name", "kind", "bodies", "self_contact")}
    return [{"name": Quantity(f"{name}_{number}"), "apexes": Quantity(f"{a}.skin"), "base": Quantity(f"{b}.skin"),
             "passes": Quantity(passes), **copy.deepcopy(options)} for number, (a, b) in enumerate(sides)]


def without_probes_of(tree, names):
    """Takes probes of contacts that are no more out of a tree, and formulas of them; returns them with the reason."""
    gone = {}
    for probe in tree.get("probes", []):
        if word_of(probe, "of") in names:
            gone[probe["name"].value] = "its contact is another one"
        elif computed_of(probe, gone):
            gone[probe["name"].value] = "the contact of a probe of which it is computed is another one"
    if "probes" in tree:
        tree["probes"] = [probe for probe in tree["probes"] if probe["name"].value not in gone]
        if not tree["probes"]:
            del tree["probes"]
    return gone


def computed_of(probe, names):
    """Whether a probe is a formula of one of these."""
    return twins.is_formula(probe) and not twins.names_in(probe["value"].value).isdisjoint(names)


OF_AUTOMATIC = ("method", "friction", "kinetic_friction", "friction_decay", "edges", "initial_penetration", "restitution", "penalty",
                "penalty_scale", "tangential_penalty", "energy_gain_limit", "step_factor")


def automatic(scene):
    tree = copy.deepcopy(scene.tree)
    scene.bodies()
    declared = [one for one in tree.get("contacts", []) if word_of(one, "kind", "contact") == "contact"]
    if not declared:
        raise CannotChange("it has no declared contact")
    if any("contact_height" in one and one["contact_height"].value != "thickness" for one in declared):
        raise CannotChange("automatic contact has no `contact_height`")
    bodies = sorted({one[side].value.split(".")[0] for one in declared for side in ("apexes", "base")})
    options = [{key: one for key, one in contact.items() if key in OF_AUTOMATIC} for contact in declared]
    if any(str(twins.written(one, twins.SI)) != str(twins.written(options[0], twins.SI)) for one in options):
        raise CannotChange("its contacts have options of their own, and automatic contact has one of each")
    names = {one["name"].value for one in declared}
    made = {"name": declared[0]["name"], "kind": Quantity("automatic"), "bodies": Quantity(bodies), "self_contact": Quantity(False),
            **options[0]}
    tree["contacts"] = [made, *(one for one in tree["contacts"] if one["name"].value not in names)]
    skipped = without_probes_of(tree, names)
    return Twin(scene.base, run_or_skip(scene, "automatic", tree), skipped=skipped)


def exchanged(scene):
    """Apexes and base exchanged; of automatic contact, the bodies listed the other way round."""
    tree = copy.deepcopy(scene.tree)
    scene.bodies()
    probes, skipped, changed = {}, {}, False
    for one in tree.get("contacts", []):
        kind = word_of(one, "kind", "contact")
        if kind == "automatic":
            tree["bodies"], changed = tree["bodies"][::-1], True
        elif kind == "contact":
            one["apexes"], one["base"], changed = one["base"], one["apexes"], True
            for probe in tree.get("probes", []):  # a force is that on the apexes
                if word_of(probe, "of") == one["name"].value and word_of(probe, "component") in ("x", "y", "z"):
                    probes[probe["name"].value] = [probe["name"].value], lambda _, v: -v[0]
    if not changed:
        raise CannotChange("it has no contact of two bodies")
    for probe in tree.get("probes", []):
        if computed_of(probe, {*probes, *skipped}):
            skipped[probe["name"].value] = "a force of which it is computed is that on the other side"
    return Twin(scene.base, run_or_skip(scene, "exchanged", tree), probes=probes, skipped=skipped)


def diagonals(scene):
    base = scene.base_from_files()
    if base is scene.base:
        raise CannotChange("the program cuts the faces of meshes of files by their shape, and no key says otherwise")
    return Twin(scene.base, base)


def half_step(scene):
    scene.needs_steps()
    tree = copy.deepcopy(scene.tree)
    time = tree.setdefault("time", {})  # a case with stages may have none
    time["safety"] = Quantity(scene.resolved["time"]["safety"]["value"] / 2, "1")
    largest = word_of(time, "largest_step")
    if largest is None and "end" in time and all(word_of(body, "rigid", False) for body in tree.get("bodies", [{}])):
        largest = time["end"].value / 1000  # the default where all bodies are rigid
    if largest is not None:
        time["largest_step"] = Quantity(largest / 2, "s")
    for one in (*scene.contacts(tree), *(plane for plane in tree.get("planes", []) if plane["kind"].value == "rigid")):
        if word_of(one, "method") == "penalty":  # its limit of the step goes with the root of this
            one["energy_gain_limit"] = Quantity(word_of(one, "energy_gain_limit", 0.005) / 4, "1")
    return Twin(scene.base, run_or_skip(scene, "half_step", tree))


# ------------------------------------------------------------------------------------------------
# Bits: each gives the names of what differs

def threads(scene):
    other = scene.run("base", scene.tree, threads=2)
    return compare_runs.files_that_differ(scene.base.folder, other.folder)[0] + parts_that_differ(scene.base, other.summary)


def parts_that_differ(run, summary):
    return [f"{part} in summary.json" for part in ("ending", "results", "ledger", "overlaps", "touched")
            if json.dumps(run.summary.get(part)) != json.dumps(summary.get(part))]


def resolved(scene):
    """Columns of the case, and of what the program says that it has read."""
    ours, theirs = scene.original.columns, scene.run("resolved", twins.tree_of(scene.original)).columns
    return [f"column {name}" for name in ours if str(ours[name]) != str(theirs.get(name))]  # as text, so that nan is nan


def rows(scene):
    """Columns at the same rows, but means since the row before; the last frames; on how many nodes contacts act; and impulses."""
    scene.needs_steps()
    tree = copy.deepcopy(scene.tree)
    for key in ("history_every", "frames_every"):
        tree["output"][key] = Quantity(tree["output"][key].value / 2, "s")
    other = scene.run("rows", tree)
    means = set()
    for probe in scene.tree.get("probes", []):
        if word_of(probe, "quantity") in ("force", "acceleration") or computed_of(probe, means):
            means.add(probe["name"].value)
    if "bodies" not in scene.tree:  # the program has its probes itself
        means = {name for name, (unit, _) in compare_runs.history(scene.base).items() if unit == "N"}
    first = next(iter(scene.base.columns))
    row_at = {at: row for row, at in enumerate(other.columns[first])}
    missing = [at for at in scene.base.columns[first] if at not in row_at]
    found = [f"{len(missing)} rows"] if missing else []
    for name, column in scene.base.columns.items():
        if name not in means and not missing and column != [other.columns[name][row_at[at]] for at in scene.base.columns[first]]:
            found.append(f"column {name}")
    if (scene.base.folder / "body.pvd").is_file():
        (_, ours), (_, theirs) = scene.base.frame("body"), other.frame("body")
        found += [f"field {name}" for name in ours if ours[name] != theirs.get(name)]
    ours, theirs = scene.base.summary["results"], other.summary["results"]
    found += [name for name in sorted({*ours, *theirs}) if name.endswith("_effective_nodes") and ours.get(name) != theirs.get(name)]
    return found + [name for name, d in compare_runs.impulses(Twin(scene.base, other)).items() if d]


def resumed(scene):
    """Interrupted at its first checkpoint, and gone on with on two threads."""
    scene.needs_steps()
    case, end = scene.base.case_file, scene.base.summary["ending"]["time"]["value"]
    folder = scene.store.scratch / scene.label / "resumed"
    words = [str(scene.store.drivers / scene.driver), str(case), "--out", str(folder), "--quiet"]
    shutil.rmtree(folder, ignore_errors=True)
    parent = os.getpid()
    begun = subprocess.Popen([*words, "--checkpoint-every", f"{end / 20!r} s"], stderr=subprocess.DEVNULL,
                             preexec_fn=lambda: processes.ends_with_parent(parent))
    while begun.poll() is None and not (folder / "checkpoint").exists():
        time.sleep(1e-3)
    begun.send_signal(signal.SIGTERM)
    if begun.wait() != INTERRUPTED:
        raise CannotChange("the run ends before a signal can stop it")
    done = processes.run([*words, "--resume", "--threads", "2"], capture_output=True, text=True, timeout=scene.store.patience)
    if done.returncode not in (0, STOPPED):
        return [f"it does not go on: {' '.join(done.stderr.split())}"]
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    return compare_runs.files_that_differ(scene.base.folder, folder)[0] + parts_that_differ(scene.base, summary)


CHANGES = [
    Change("rotated", ROUND_OFF, "turned by 2.1 rad about (1, -2, 0.7)", rotated),
    Change("mirrored", ROUND_OFF, "in an oblique mirror, all shapes as files", mirrored),
    Change("numbers", ROUND_OFF, "other numbers of nodes and elements, all shapes as files", numbers),
    Change("units", ROUND_OFF, "written in mm, kgf, s", units),
    Change("moving", ROUND_OFF, "seen from a frame of reference that moves at a constant velocity", moving),
    Change("resolved", BITS, "written as the program resolved it", resolved),
    Change("threads", BITS, "on two threads", threads),
    Change("rows", BITS, "rows and frames twice as often", rows),
    Change("resumed", BITS, "stopped by a signal, and gone on with from its checkpoint", resumed),
    Change("one_pass", MODEL, "contacts of one pass", with_passes("one")),
    Change("two_passes", MODEL, "contacts of two passes", with_passes("two")),
    Change("automatic", MODEL, "declared contacts as automatic ones", automatic),
    Change("exchanged", MODEL, "apexes and base, or the order of bodies, exchanged", exchanged),
    Change("diagonals", MODEL, "shapes as files, whose faces are cut along other diagonals", diagonals),
    Change("half_step", MODEL, "half the time step", half_step),
]
