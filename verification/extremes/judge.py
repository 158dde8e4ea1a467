"""Judges one finished run from its files alone: good, refused, warned or broken. It shares no code with lib/.

    good      nothing is wrong, and nothing is warned of
    refused   before or during the run, with a message that names the key or the place and the bound; the last state is kept
    warned    something may be wrong, and the warning says so truly
    broken    all else: wrong in silence, a false warning, a stop without cause, a message without a reason, a crash

Lines that begin with `note:` say what the run cannot tell. They do not change the verdict.

A fault is what the judge finds wrong: energy from nowhere, momentum that changes by itself, a known answer that is missed, bodies in each
other, a body in itself, elements inside out, numbers that are not finite.
"""
import dataclasses
import functools
import json
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

import measure

ENERGY = 0.01        # [-] of the energy of the bodies that touch, that may come from nowhere
SWING = 0.05         # [-] the same with what the kinetic energy of a single instant has too much, as `energy_integration` tells
MOMENTUM = 1e-10     # [-] of the scale of the momenta
KINETIC = 1e-6       # [-] between our kinetic energy and that of the history
OVERLAP = 0.5        # [-] of the flatter element there, and of how deep a point can be in a body
ITSELF = 0.25        # [-] of the flattest element: how far a body may go behind its own face
TRUE_DEPTH = 2.0     # [-] between a depth that is warned of and ours
FULL = 0.7           # [-] of how deep a point can be: what is deeper below the face it came through is nearer to another
SEEN = 0.01          # [-] of the flattest element: what is less deep is not seen
NUDGED = ("nudged 1", "nudged 2", "nudged 3")
LOOKS = 12           # frames in which a body is held against itself
GOOD, REFUSED, WARNED, BROKEN = "good", "refused", "warned", "broken"
NOTED, STOPPED = "good with a note", "stopped"  # classes of good and of refused cells
CLASSES = (GOOD, NOTED, WARNED, REFUSED, STOPPED, BROKEN)

DONE, BAD_CASE, ENDED_EARLY = 0, 2, 3


@dataclasses.dataclass
class Expected:
    """What is known of a scene before it runs.

    pairs       bodies that must not be in each other: (name, name); none: those of all contacts
    answers     what must come out: see ANSWERS
    scale       [J] of energies, where those of the run do not say it; 0: they do
    nudge       [m] aside of bodies that decides nothing: places that it decides are not known: see `decided`; 0: all are
    """
    pairs: list = None
    answers: list = dataclasses.field(default_factory=list)
    scale: float = 0.0
    nudge: float = 0.0


@dataclasses.dataclass
class Finished:
    """What a run left: exit status (None: cut by the clock), what it said on the error stream, its case, its folder."""
    status: int
    said: str
    case: dict
    folder: Path
    seconds: float = 0.0


@dataclasses.dataclass
class Fault:
    """Something wrong: its kind, how much, and a sentence."""
    kind: str
    amount: float
    text: str


class Verdict(NamedTuple):
    """What a run is, why, what is wrong with it, and its warnings with whether each is true: of runs that came to their end."""
    word: str
    reason: str
    faults: list
    warnings: tuple = ()


# ------------------------------------------------------------------------------------------------
# A run and its bodies

def number(quantity):
    """A value of a case in SI: '3 mm' is 0.003."""
    if isinstance(quantity, (int, float)):
        return float(quantity)
    value, _, unit = quantity.partition(" ")
    return float(value) * {"mm": 1e-3, "um": 1e-6, "ms": 1e-3, "us": 1e-6, "MPa": 1e6, "GPa": 1e9, "deg": math.pi / 180}.get(unit, 1.0)


def declared(case):
    """The contacts of a case, an automatic one as a pair of skins for each two of its bodies."""
    found = []
    for contact in case.get("contacts", []):
        if contact.get("kind") != "automatic":
            found.append(contact)
            continue
        names = contact.get("bodies") or [entry["name"] for entry in case["bodies"]]
        found += [{**contact, "apexes": f"{one}.skin", "base": f"{other}.skin"} for n, one in enumerate(names) for other in names[:n]]
    return found

class Seen:
    """A finished run as the judge sees it."""

    def __init__(self, run):
        self.case = run.case
        self.frames, parts, self.X = measure.read_frames(run.folder)
        self.history = measure.read_history(run.folder)
        self.bodies = {}
        for part, entry in enumerate(self.case["bodies"]):
            thickness = number(entry.get("element", {}).get("thickness", 0))
            self.bodies[entry["name"]] = measure.Body(parts[part], self.X, number(entry["material"]["density"]), thickness)
        self.mass = sum(body.mass for body in self.bodies.values())
        self.solid = not any(body.is_plate for body in self.bodies.values())
        self.cache = {}

    def touching(self):
        """Names of bodies in any contact or at any rigid plane; of all bodies if there is none."""
        surfaces = [contact[key] for contact in declared(self.case) for key in ("apexes", "base")]
        surfaces += [plane["surface"] for plane in self.case.get("planes", []) if "surface" in plane]
        return {surface.partition(".")[0] for surface in surfaces} or set(self.bodies)

    def pairs(self, expected):
        """Bodies that must not be in each other."""
        if expected.pairs is not None:
            return [tuple(pair) for pair in expected.pairs]
        found = [tuple(contact[key].partition(".")[0] for key in ("apexes", "base")) for contact in declared(self.case)]
        return sorted({tuple(sorted(pair)) for pair in found})

    def accepts(self, pair):
        """Whether the case accepts that two bodies start in each other."""
        return any({contact[key].partition(".")[0] for key in ("apexes", "base")} == set(pair)
                   for contact in declared(self.case) if contact.get("initial_penetration") == "accept")

    def is_free(self):
        """Whether nothing from outside acts, gravity apart."""
        return not any(self.case.get(key) for key in ("planes", "loads", "springs", "relaxation"))

    def gravity(self):
        return np.array([number(g) for g in self.case.get("gravity", [0, 0, 0])])

    def centre(self, name, frame):
        mass = self.bodies[name].mass
        return (mass[:, None] * frame.x).sum(axis=0) / mass.sum()

    def velocity(self, name, frame):
        mass = self.bodies[name].mass
        return (mass[:, None] * frame.v).sum(axis=0) / mass.sum()

    def named_faces(self, surface):
        """Outer faces of a body that belong to a surface of its mesh; None where the surface is all of it or not known."""
        name, _, side = surface.partition(".")
        body = self.bodies[name]
        if body.is_plate or side in ("skin", ""):
            return None
        entry = next(entry for entry in self.case["bodies"] if entry["name"] == name)
        if entry["mesh"]["kind"] != "box" or "map" in entry["mesh"]:
            return None
        mesh, back = entry["mesh"], placed_back(entry, self.X[body.faces].reshape(-1, 3)).reshape(-1, 4, 3)
        axis, end = "xyz".index(side[0]), "low" if side.endswith("low") else "high"
        size = max(abs(number(h) - number(low)) for h, low in zip(mesh["high"], mesh["low"]))
        return body.faces[np.all(np.abs(back[:, :, axis] - number(mesh[end][axis])) < 1e-6 * size, axis=1)]


def placed_back(entry, points):
    """Points of a body where they were before it was rotated and moved."""
    points = points - np.array([number(m) for m in entry.get("move", [0, 0, 0])])
    if "rotate" in entry:
        about = np.array([number(a) for a in entry["rotate"].get("about", [0, 0, 0])])
        points = (points - about) @ rotation(entry["rotate"]["axis"], number(entry["rotate"]["angle"])) + about
    return points


def rotation(axis, angle):
    """The matrix that rotates columns about an axis."""
    x, y, z = np.array(axis, dtype=float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


# ------------------------------------------------------------------------------------------------
# Energy and momentum

def kinetic(mass, v):
    return 0.5 * float(mass @ np.einsum("ni,ni->n", v, v))


def energy_scale(seen, expected):
    """The energy that the bodies that touch have to lose [J]: kinetic about their centre where they are free, stored, brought in."""
    mass = sum(seen.bodies[name].mass for name in seen.touching())
    v = seen.frames[0].v
    if seen.is_free():
        v = v - (mass[:, None] * v).sum(axis=0) / mass.sum()
    brought = sum((-values for name, values in seen.history.items() if is_outside(name)), np.zeros(1))
    stored = sum(values[0] for name, values in seen.history.items() if is_account(name) and not is_outside(name))
    held = sum(float(values[0]) for name, values in seen.history.items() if name.endswith("_restitution"))  # as bodies begin in contact
    return max(kinetic(mass, v) + held, float(stored), float(np.max(brought, initial=0.0)), expected.scale)


NO_ACCOUNT = re.compile(r"energy_(kinetic|integration|residual|created_.*)$")
PART = re.compile(r"_(back|edges)_restitution$")
OUTSIDE = re.compile(r"energy_.*(external_work|potential|relaxation.*)$")


def is_account(name):
    return name.startswith("energy_") and not NO_ACCOUNT.match(name)


def is_outside(name):
    return is_account(name) and bool(OUTSIDE.match(name))


def stores(history):
    """{name: values} of what may not be below zero. What multipliers of a contact hold is that of both passes and the edges together: one
    of them may hold what another one took.

    >>> parts = {"energy_t_restitution": np.array([-5.0]), "energy_t_edges_restitution": np.array([7.0])}
    >>> {name: float(values[0]) for name, values in stores(parts).items()}
    {'energy_t_restitution': 2.0}
    """
    found = {}
    for name, values in history.items():
        if is_account(name) and not is_outside(name):
            of_contact = PART.sub("_restitution", name)
            found[of_contact] = found.get(of_contact, 0.0) + values
    return found


def energy_faults(seen, expected):
    """Energy from nowhere: the sum of kinetic, stored and dissipated energy less the work from outside grows."""
    found, scale, history = [], energy_scale(seen, expected), seen.history
    if not scale > 0:
        return found
    accounts = [values for name, values in history.items() if is_account(name)]
    rest = sum(accounts, np.zeros_like(history["time"]))
    swing = history.get("energy_integration", 0.0 * rest)
    total = history["energy_kinetic"] + rest
    balance = total - swing
    if seen.solid:
        ours = np.array([kinetic(seen.mass, frame.v) for frame in seen.frames])
        at = np.interp([frame.time for frame in seen.frames], history["time"], np.arange(len(history["time"])))
        rows = np.round(at).astype(int)
        off = np.max(np.abs(ours - history["energy_kinetic"][rows])) / max(scale, np.max(ours))
        if off > KINETIC:
            found.append(Fault("energy", off, f"kinetic energy is off by {off:.2g}"))
        total = np.append(total, ours + rest[rows])  # ours is held against the start as well
        balance = np.append(balance, ours + rest[rows] - swing[rows])
    rise, swings = float(np.max(balance - balance[0])) / scale, float(np.max(total - total[0])) / scale
    if rise > ENERGY or swings > SWING:
        rise = rise if rise > ENERGY else swings
        found.append(Fault("energy", rise, f"energy rises by {rise:.2g}"))
    created = {name: float(np.max(values)) / scale for name, values in history.items() if name.startswith("energy_created_")}
    if created and max(created.values()) > max(ENERGY, rise):
        worst = max(created, key=created.get)
        found.append(Fault("energy", created[worst], f"{worst.removeprefix('energy_created_')} creates {created[worst]:.2g}"))
    for name, values in stores(history).items():
        least = float(np.min(values)) / scale
        if least < (-SWING if name.endswith("_restitution") else -ENERGY):  # which has the work of half a step in it that is still to come
            found.append(Fault("energy", -least, f"a store falls to {least:.2g}"))
    return found


def momentum_faults(seen):
    """Momentum or its moment about the origin that changes by itself; moments not of plates, whose spin is in no frame."""
    if not seen.is_free():
        return []
    found, g, m = [], seen.gravity(), seen.mass[:, None]
    linear, angular, scale, arm = [], [], 0.0, 0.0
    for frame in seen.frames:
        linear.append((m * frame.v).sum(axis=0) - m.sum() * g * frame.time)
        angular.append(np.cross(frame.x, m * frame.v).sum(axis=0))
        speed = np.linalg.norm(frame.v, axis=1)
        scale = max(scale, float(seen.mass @ speed))
        arm = max(arm, float(seen.mass @ (speed * np.linalg.norm(frame.x, axis=1))))
    for what, values, size in (("momentum", linear, scale), ("angular momentum", angular, arm)):
        if what == "angular momentum" and (not seen.solid or np.any(g)):
            continue
        off = max(float(np.linalg.norm(value - values[0])) for value in values) / size if size > 0 else 0.0
        if off > MOMENTUM:
            found.append(Fault("momentum", off, f"{what} changes by {off:.2g}"))
    return found


# ------------------------------------------------------------------------------------------------
# Bodies in each other and in themselves

def depths(seen, expected):
    """[(pair, deepest [m], below the named surfaces [m], part of an element, the flattest element, whether deeper cannot be)]; kept,
    since it is slow.

    An overlap that the case accepts at the start does not count until the bodies part.
    """
    if "depths" in seen.cache:
        return seen.cache["depths"]
    found = []
    for pair in seen.pairs(expected):
        one, other = (seen.bodies[name] for name in pair)
        room = min(measure.room(body, seen.X) for body in (one, other))
        size = min(one.depth, other.depth, room)
        bases = tuple(named(seen, name) for name in pair)
        worst, most, allowed = (0.0, 0.0), 0.0, None
        for frame in seen.frames:
            if allowed is None:
                allowed = measure.overlap(one, other, frame.x, bases)[0] if seen.accepts(pair) else 0.0
            deep, below, part = measure.overlap(one, other, frame.x, bases, room, allowed, exact=seen.accepts(pair))
            allowed = allowed if deep > 0 else 0.0  # once they have parted, what was accepted is past
            worst, most = max(worst, (deep - allowed, below - allowed)), max(most, part)
        found.append((pair, *worst, most, size, worst[0] > FULL * room))
    seen.cache["depths"] = found
    return found


def depth_of_pair(seen, one, other):
    """(deepest of any two bodies in each other [m], whether deeper cannot be seen); what was there at the start counts too. Through plates
    any depth is seen."""
    one, other = seen.bodies[one], seen.bodies[other]
    deepest = max(measure.overlap(one, other, frame.x)[0] for frame in seen.frames)
    room = min(measure.room(body, seen.X) for body in (one, other))
    return deepest, not (one.is_plate or other.is_plate) and deepest > FULL * room


def depth_at_rims(seen, contact):
    """How deep nodes of plates went in a contact, whose rims it rounds [m]."""
    pair = next(([entry[key].partition(".")[0] for key in ("apexes", "base")] for entry in declared(seen.case)
                 if entry["name"] == contact), [])
    bodies = [seen.bodies[name] for name in pair]
    return max((measure.depth_of_rounded(plate, other, frame.x) for plate, other in zip(bodies, bodies[::-1]) if plate.is_plate
                for frame in seen.frames), default=0.0)


def named(seen, name):
    """The faces of a body that contacts name, together; None where one contact means all of them."""
    surfaces = {contact[key] for contact in declared(seen.case) for key in ("apexes", "base")
                if contact[key].partition(".")[0] == name}
    faces = [seen.named_faces(surface) for surface in surfaces]
    return None if not faces or any(one is None for one in faces) else np.concatenate(faces)


def overlap_faults(seen, expected, limit=OVERLAP):
    """Bodies deeper in each other than a part of the flatter element there and of what can be, by default half."""
    return [Fault("overlap", part, f"{pair[0]} and {pair[1]} overlap by {deep:.3g} m, {part:.2g} of an element or body")
            for pair, deep, _, part, *_ in depths(seen, expected) if part > limit]


def looked_at(frames):
    """Some frames, the last among them."""
    return [frames[i] for i in sorted({round(i) for i in np.linspace(0, len(frames) - 1, LOOKS)})]


def shape_faults(seen):
    """Bodies in themselves, and elements that are inside out at a corner."""
    found = []
    for name, body in seen.bodies.items():
        behind = max(measure.self_overlap(body, frame.x) for frame in looked_at(seen.frames)) / body.depth
        if behind > ITSELF:
            found.append(Fault("itself", behind, f"{name} goes into itself by {behind:.2g} of an element"))
        least = min(measure.inside_out(body, frame.x, seen.X) for frame in looked_at(seen.frames))
        if least < 0:
            found.append(Fault("inside out", -least, f"a corner of {name} is inside out: {least:.2g}"))
    return found


def finite_faults(seen):
    """Numbers that are not finite."""
    bad = [frame.time for frame in seen.frames if not (np.all(np.isfinite(frame.x)) and np.all(np.isfinite(frame.v)))]
    if bad:
        return [Fault("finite", math.inf, f"positions or velocities are not finite at {bad[0]:.3g} s")]
    names = [name for name, values in seen.history.items() if not np.all(np.isfinite(values))]
    return [Fault("finite", math.inf, f"{names[0]} is not finite")] if names else []


# ------------------------------------------------------------------------------------------------
# Known answers

def came_with(seen, name):
    """The velocity of a body as the case has it, where it is a number: what begins in contact stops before the first frame."""
    for initial in seen.case.get("initial", []):
        if initial["body"] == name and "velocity" in initial:
            try:
                return np.array([number(f"{value} {initial['unit']}") for value in initial["velocity"]])
            except ValueError:
                return seen.velocity(name, seen.frames[0])
    return np.zeros(3) if seen.case.get("initial") else seen.velocity(name, seen.frames[0])


def separates(seen, one, other, axis, least=0.0, most=1.001):
    """Two bodies part along an axis, with `least` to `most` of the speed with which they came."""
    axis = np.array(axis, dtype=float)
    first = float(axis @ (came_with(seen, other) - came_with(seen, one)))
    last = float(axis @ (seen.velocity(other, seen.frames[-1]) - seen.velocity(one, seen.frames[-1])))
    part = -last / first
    return None if least <= part <= most else f"{one} and {other} part with {part:.3g} of their speed, expected {least:g} to {most:g}"


def stays(seen, body, normal, level, within):
    """No node of a body is below a level along a normal, but for `within`."""
    lowest = min(float(np.min(frame.x[seen.bodies[body].nodes] @ np.array(normal, dtype=float))) for frame in seen.frames)
    return None if lowest >= level - within else f"{body} is at {lowest:.3g} m, beyond {level:.3g} m"


def untouched(seen, body, within=1e-9):
    """Nothing happens to a body: all its nodes keep their velocity."""
    nodes, first = seen.bodies[body].nodes, seen.frames[0].v
    speed = max(float(np.max(np.linalg.norm(first, axis=1))), 1e-300)
    off = max(float(np.max(np.linalg.norm(frame.v[nodes] - first[nodes], axis=1))) for frame in seen.frames) / speed
    return None if off <= within else f"{body} touches nothing, but its velocity changes by {off:.2g}"


def moves(seen, body, axis, velocity, within):
    """The last velocity of a body's centre along an axis."""
    v = float(np.array(axis, dtype=float) @ seen.velocity(body, seen.frames[-1]))
    return None if abs(v - velocity) <= within else f"{body} moves at {v:.4g} m/s, expected {velocity:.4g} within {within:.2g}"


def way_of(seen, body, axis):
    """How far the centre of a body has gone along an axis. [m]"""
    return float(np.array(axis, dtype=float) @ (seen.centre(body, seen.frames[-1]) - seen.centre(body, seen.frames[0])))


def stands(seen, body, axis, place, within):
    """The last place of a body's centre along an axis, from where it was."""
    way = way_of(seen, body, axis)
    return None if abs(way - place) <= within else f"{body} has gone {way:.4g} m, expected {place:.4g} within {within:.2g}"


def keeps_shape(seen, body, within):
    """All distances between nodes of a body at the end are those of the start, as parts of its size."""
    nodes = seen.bodies[body].nodes
    nodes = nodes[:: max(1, len(nodes) // 60)]
    first, last = (np.linalg.norm(frame.x[nodes][:, None] - frame.x[nodes][None], axis=2) for frame in (seen.frames[0], seen.frames[-1]))
    off = float(np.max(np.abs(last - first))) / float(np.max(first))
    return None if off <= within else f"{body} changes its shape by {off:.2g}, expected at most {within:g}"


def cheap(seen, steps):
    """A run takes at most so many steps."""
    return None if seen.steps <= steps else f"{seen.steps} steps, expected at most {steps}"


def returns(seen, body, axis, velocity, least, most):
    """A body comes back with `least` to `most` of the velocity with which it came."""
    part = -float(np.array(axis, dtype=float) @ seen.velocity(body, seen.frames[-1])) / velocity
    return None if least <= part <= most else f"{body} comes back with {part:.3g} of its velocity, expected {least:g} to {most:g}"


def side(seen, one, other):
    """A body stays on its side of another: the closest face to its centre is one of those that faced it at the start."""
    first = measure.closed_surface(seen.bodies[other], seen.frames[0].x)
    normal = np.cross(first[:, 1] - first[:, 0], first[:, 2] - first[:, 0])
    faces = np.einsum("ti,ti->t", normal, seen.centre(one, seen.frames[0]) - first.mean(axis=1)) > 0
    for frame in seen.frames:
        away = measure.all_distances(seen.centre(one, frame)[None], measure.closed_surface(seen.bodies[other], frame.x))[0]
        if not np.any(faces[away <= away.min() * (1 + 1e-9)]):
            return f"{one} goes through {other}"
    return None


def order(seen, one, other, axis):
    """The centres of two bodies stay in order along an axis."""
    ways = [float(np.array(axis, dtype=float) @ (seen.centre(one, frame) - seen.centre(other, frame))) for frame in seen.frames]
    return None if min(way * ways[0] for way in ways) > 0 else f"the centres of {one} and {other} change places"


def no_lower(seen, body, axis, way):
    """The centre of a body goes no lower along an axis than `way` from where it was."""
    axis = np.array(axis, dtype=float)
    least = min(float(axis @ (seen.centre(body, frame) - seen.centre(body, seen.frames[0]))) for frame in seen.frames)
    return None if least >= way else f"{body} goes to {least:.3g} m, expected is not below {way:.3g} m"


def no_faster(seen, body, axis, speed):
    """The centre of a body is never faster along an axis."""
    most = max(abs(float(np.array(axis, dtype=float) @ seen.velocity(body, frame))) for frame in seen.frames)
    return None if most <= speed else f"{body} is at {most:.3g} m/s, expected at most {speed:.3g}"


def normal_impulse(seen, body, frame, load=""):
    """What a level floor has given a body until a frame, from its momentum along z, its weight and a load of the history [N s]."""
    mass = float(seen.bodies[body].mass.sum())
    rise = seen.velocity(body, frame)[2] - came_with(seen, body)[2]
    return mass * (rise - seen.gravity()[2] * frame.time) - (at_time(seen, load, frame.time) if load else 0.0)


def at_time(seen, column, time):
    return float(np.interp(time, seen.history["time"], seen.history[column]))


def slides(seen, body, friction, within, pull=0.0):
    """A body that slides along x slows down by what Coulomb's law takes of the normal impulse, at every time; a force pulls it on, over its
    mass [m/s2]."""
    mass = float(seen.bodies[body].mass.sum())
    known = [(frame.time, came_with(seen, body)[0] + pull * frame.time - friction * normal_impulse(seen, body, frame) / mass,
              seen.velocity(body, frame)[0]) for frame in seen.frames]
    time, right, found = max(known, key=lambda one: abs(one[2] - one[1]))
    if abs(found - right) <= within:
        return None
    return f"{body} slides at {found:.4g} m/s at {time:.4g} s, expected {right:.4g} within {within:.2g}"


def dragged_by(seen, body, drive, load):
    """The force that drags a body along x over the normal force, in the mean over the last two thirds of a run; infinite where there is no
    normal force. Both are impulses of the history."""
    mass = float(seen.bodies[body].mass.sum())
    frames = [frame for frame in seen.frames if frame.time >= seen.frames[-1].time / 3]
    first, last = frames[0], frames[-1]
    normal = normal_impulse(seen, body, last, load) - normal_impulse(seen, body, first, load)
    found = at_time(seen, drive, last.time) - at_time(seen, drive, first.time)
    found -= mass * (seen.velocity(body, last) - seen.velocity(body, first))[0]
    return found / normal if normal > 0 else math.inf


def drags(seen, body, friction, within, drive, load):
    """What drags a body along x is its friction. The error is a part of the friction, or of a tenth of the normal force where there is
    less."""
    part = dragged_by(seen, body, drive, load)
    if abs(part - friction) <= within * max(friction, 0.1):
        return None
    return f"{body} is dragged with {part:.4g} of the normal force, expected {friction:g} within {within * max(friction, 0.1):.2g}"


def spin_left(seen, body, axis):
    """The part of the angular momentum about its centre, along an axis, that a body has left."""
    left = []
    for frame in (seen.frames[0], seen.frames[-1]):
        x, v = (values - mean for values, mean in ((frame.x, seen.centre(body, frame)), (frame.v, seen.velocity(body, frame))))
        left.append(float(np.array(axis, dtype=float) @ (seen.bodies[body].mass[:, None] * np.cross(x, v)).sum(axis=0)))
    return left[1] / left[0]


def spins(seen, body, axis, least, most):
    """A body has `least` to `most` of its spin left."""
    part = spin_left(seen, body, axis)
    return None if least <= part <= most else f"{body} has {part:.4g} of its spin left, expected {least:.4g} to {most:.4g}"


ANSWERS = {"separates": separates, "stays": stays, "untouched": untouched, "moves": moves, "stands": stands, "keeps_shape": keeps_shape,
           "cheap": cheap, "returns": returns, "side": side, "order": order, "no_lower": no_lower, "no_faster": no_faster,
           "slides": slides, "drags": drags, "spins": spins}


def answer_faults(seen, expected):
    """Known answers that are missed: each is (word, arguments)."""
    said = [ANSWERS[word](seen, *arguments) for word, *arguments in expected.answers]
    return [Fault("answer", 1.0, text) for text in said if text]


def is_aside(answer):
    """Whether an answer is where a body stands along x or y, as nudges move bodies."""
    return answer[0] == "stands" and answer[2][2] == 0


def decided(seen, expected, again):
    """(what is known without the places that chance decides, what is wrong with the runs that tell).

    A body that does not stand where it should along x or y is where chance put it if it lies elsewhere by half of what it is off, or more,
    in one of three runs whose bodies start aside by a nudge, each by one of its own. What the scene does not decide is no fault. All else
    is judged, also of these runs, and so is whether they come to their end.
    """
    missed = [answer for answer in expected.answers if is_aside(answer) and stands(seen, *answer[1:])]
    if not (missed and expected.nudge and again):
        return expected, []
    without = dataclasses.replace(expected, answers=[answer for answer in expected.answers if not is_aside(answer)])
    others, faults = [], []
    for change in NUDGED:
        other = again(change)
        if other is None or other.status != DONE:
            faults.append(Fault("nudge", 1.0, f"{change}: the run does not come to its end"))
            continue
        others.append(look(other, expected))
        faults += [Fault(fault.kind, fault.amount, f"{change}: {fault.text}") for fault in faults_of(others[-1], without)]

    def by_chance(body, axis, place, _):
        way = way_of(seen, body, axis)
        return any(abs(way_of(other, body, axis) - way) >= 0.5 * abs(way - place) for other in others)

    kept = [answer for answer in expected.answers if answer not in missed or not by_chance(*answer[1:])]
    return dataclasses.replace(expected, answers=kept), faults


def likeness(seen, twin, speed, within):
    """The same scene in other units or elsewhere: velocities of all nodes at the end, those of the twin times `speed`, over their scale."""
    one, other = seen.frames[-1].v, twin.frames[-1].v * speed
    scale = max(float(np.max(np.linalg.norm(other, axis=1))), 1e-300)
    off = float(np.max(np.linalg.norm(one - other, axis=1))) / scale
    return [] if off <= within else [Fault("likeness", off, f"velocities differ by {off:.2g} from those of the same scene elsewhere")]


# ------------------------------------------------------------------------------------------------
# Verdicts

def faults_of(seen, expected):
    """All that is wrong with a run that has frames."""
    broken = finite_faults(seen)
    if broken:
        return broken
    with np.errstate(all="ignore"):
        return [*energy_faults(seen, expected), *momentum_faults(seen), *answer_faults(seen, expected), *overlap_faults(seen, expected),
                *shape_faults(seen)]


def is_note(line):
    return line.lstrip().startswith("note:")


def warnings_of(said):
    """Warnings of the run; that of coarse apexes is of the mesh alone, so it excuses nothing and is not judged."""
    found = [line.partition("warning:")[2].strip() for line in said.splitlines() if "warning:" in line and not is_note(line)]
    return [warning for warning in found if not OF_COARSE_APEXES.match(warning)]


def notes_of(run):
    """Notes of a run, each once: what it says that it cannot tell, as the error of its mesh, on the error stream or in the notes of its
    summary. They excuse nothing and are not judged."""
    try:
        summary = json.loads((Path(run.folder) / "summary.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        summary = {}
    lines = [line for line in (*run.said.splitlines(), *summary.get("notes", [])) if is_note(line)]
    return list(dict.fromkeys(line.partition("note:")[2].strip() for line in lines))


def kinds_of_notes(run):
    """The notes of a run by kind, as '2 hourglass, 1 other'; nothing where there is none."""
    kinds = [next((kind for kind, words in KINDS_OF_NOTES.items() if words in note), "other") for note in notes_of(run)]
    return ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds))


NUMBER = r"([-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?)"
OF_DEPTH = re.compile(r"deep|overlap|penetrat|inside|through|pass", re.IGNORECASE)


OF_HOURGLASS = re.compile(r"(\w+): hourglass energy reached " + NUMBER + " of the internal energy")
OF_CONCENTRATED = re.compile(r"(\w+): (?:bodies of the scene deform plastically, and )?" + NUMBER +
                             " of the strain energy of all solids is concentrated in single elements")
OF_CONTROL = re.compile(r"(\w+): the energy of distortion control reached " + NUMBER + " of the internal energy")
OF_PRESSED = re.compile(r"(\w+): element \d+ was pressed by " + NUMBER + " of Young's modulus")
OF_NODE = re.compile(r"(\w+): node \d+ had a penetration of " + NUMBER + " m")
OF_OVERLAP = re.compile(r"(\w+)[\w.]* and (\w+)[\w.]* overlap by " + NUMBER + " m")
OF_DEEPER = re.compile(r"and by " + NUMBER + " m where elements are larger")
OF_ITSELF = re.compile(r"(\w+)[\w.]* overlaps itself by " + NUMBER + " m")
OF_ENERGY = re.compile(r"(\w[\w ]*): (?:created|lost) " + NUMBER + r" % of the energy (that it transferred|of the scene)")
OF_SWING = re.compile(r"time integration: the staggering error of the kinetic energy reached " + NUMBER + " % of the energy of the scene")
OF_COARSE_APEXES = re.compile(r"\w+: its apexes are " + NUMBER + " times as far apart as the nodes of its base")
OF_ROUNDING = re.compile(r"(\w+): this far from the origin, positions are rounded by " + NUMBER + " m")
AT_TIME = re.compile(r" at " + NUMBER + r" s\b")
OF_THICKNESS = re.compile(r"(\w+): plates keep their thickness, but with the strain of element (\d+) it would be " + NUMBER)
OF_CORNER = re.compile(r"(\w+): a corner of element \d+ was inverted")
OF_STOP = re.compile(r"\w+: stopped at " + NUMBER + " s")
OF_INVERSION = re.compile(r"inverted_element in (\w+)")
AS_GOOD_AS_INVERTED = 0.1  # [-] a corner with less of its reference is at the bound, wherever chance leaves it
COARSE = 4.0        # [-] between an energy that was lost or made between two rows and what the rows show
CHATTER = 0.02      # [-] of the speeds: twice what round-off has come to in a scene whose contact chatters
PRESSED = 0.5       # [-] of Young's modulus: from here on the program warns of a hypoelastic law
TRUE_SHARE = 1.5    # [-] between a share of energies that is claimed and ours
TRUE_STRAIN = 0.2   # [-] of a strain through the thickness that is claimed: frames lie between the looks of the program
NEARLY_FLAT = 0.25  # [-] a corner that was inverted between two frames stands at no more in one of them


KINDS = {"hourglass": OF_HOURGLASS, "concentrated strain energy": OF_CONCENTRATED, "distortion control": OF_CONTROL,
         "pressed elements": OF_PRESSED, "thickness of plates": OF_THICKNESS,
         "inverted corner": OF_CORNER, "depth of a node": OF_NODE, "overlap": OF_OVERLAP, "overlap with itself": OF_ITSELF,
         "energy created": OF_ENERGY, "staggering error of the kinetic energy": OF_SWING, "rounding": OF_ROUNDING}


KINDS_OF_NOTES = {"hourglass": "hourglass energy above that of the neighbours",
                  "plates": "of a mesh of plates", "contact nodes": "the largest force of this contact acted on",
                  "plastic strain": "largest plastic strain", "restitution": "'restitution'"}


def kind_of(warning):
    return next((kind for kind, words in KINDS.items() if words.match(warning)), "other")


def of_elements(warning):
    """Whether a warning is about the shape of elements and not about contact."""
    return any(one.match(warning) is not None
               for one in (OF_HOURGLASS, OF_CONCENTRATED, OF_CONTROL, OF_PRESSED, OF_CORNER, OF_THICKNESS))


def energy_fraction(seen, expected, source, scene):
    """Energy that a source made or lost at worst, over what passed through it or over that of the scene, from the history."""
    if scene:
        column = seen.history["energy_integration" if source == "time integration" else f"energy_created_{source}"]
        return float(np.max(np.abs(column))) / max(energy_scale(seen, expected), 1e-300)
    created = seen.history[f"energy_created_{source}"]
    others = tuple(f"energy_{source}_{part}_" for part in ("back", "edges"))  # sources of their own
    own = sum(values for name, values in seen.history.items() if name.startswith(f"energy_{source}_") and not name.startswith(others))
    passed = np.cumsum(np.abs(np.diff(own, prepend=own[0])))
    seen_late = passed > 0
    return float(np.max(np.abs(created[seen_late]) / passed[seen_late])) if seen_late.any() else 0.0


def fraction_of(seen, body, *modes):
    """The largest energy of artificial modes of a body over its largest internal energy, from the history."""
    own = {name: values for name, values in seen.history.items()
           if name.startswith(f"energy_{body}_") and name != f"energy_created_{body}"}
    internal = float(np.max(sum(own.values())))
    names = [f"energy_{body}_{mode}{kind}" for mode in modes for kind in ("", "_dissipated")]  # springs store, dashpots dissipate
    return float(np.max(sum(own[name] for name in names if name in own))) / internal if internal > 0 else 0.0


def concentrations(seen):
    """{solid body: (strain energy above the density of the nodes around, strain energy)}, summed over the frames [J]. Strains are elastic,
    and of each element its bending counts: see `measure.strain_energies`."""
    found = {}
    for entry in seen.case["bodies"]:
        body = seen.bodies[entry["name"]]
        if body.is_plate or entry.get("rigid"):
            continue
        young, poisson = number(entry["material"]["young"]), float(entry["material"]["poisson"])
        energies = [measure.strain_energies(body, frame.x, seen.X, young, poisson) for frame in seen.frames]
        found[entry["name"]] = (sum(measure.above_neighbours(body, one) for one in energies), sum(float(one.sum()) for one in energies))
    return found


def concentrated_in(seen, name):
    """How much of the strain energy of all solids is above the density of the nodes around; nothing if another body has much more of it
    than the one that is named. Strains are taken as elastic: where bodies flow they tell nothing of the energy."""
    found = concentrations(seen)
    above, whole = (sum(one[part] for one in found.values()) for part in (0, 1))
    if found.get(name, (0.0, 0.0))[0] * TRUE_SHARE < max((one[0] for one in found.values()), default=0.0):
        return 0.0
    return above / whole if whole > 0 else 0.0


def thickness_asked_for(seen, body):
    """The part of its thickness that an elastic plate would have by its strain, (A0/A)^(nu/(1 - nu)), where that is farthest from one."""
    poisson = float(next(entry for entry in seen.case["bodies"] if entry["name"] == body)["material"]["poisson"])
    cells = seen.bodies[body].cells
    before = measure.areas(seen.X[cells])
    logs = [poisson / (1 - poisson) * np.log(before / measure.areas(frame.x[cells])) for frame in seen.frames]
    return math.exp(max((float(one[np.argmax(np.abs(one))]) for one in logs), key=abs))


def pressed_by(seen, body):
    """The largest compression of a body over Young's modulus, Hooke's of its logarithmic strains; beyond the least compressed axis, if that
    is less: an even pressure folds nothing."""
    poisson = float(next(entry for entry in seen.case["bodies"] if entry["name"] == body)["material"]["poisson"])
    strains = [measure.logarithmic_strains(seen.bodies[body], frame.x, seen.X) for frame in seen.frames]
    lame, twice_mu = poisson / ((1 + poisson) * (1 - 2 * poisson)), 1 / (1 + poisson)
    return max(float(np.max(np.minimum(-(lame * one.sum(axis=1) + twice_mu * one[:, 0]), twice_mu * (one[:, 2] - one[:, 0]))))
               for one in strains)


def is_true(warning, seen, expected, faults):
    """Whether the judge sees what a warning names; a depth within a factor of two."""
    if (hourglass := OF_HOURGLASS.match(warning)) is not None:
        ours = fraction_of(seen, hourglass[1], "hourglass")
        return ours / TRUE_SHARE <= float(hourglass[2]) <= ours * TRUE_SHARE
    if (concentrated := OF_CONCENTRATED.match(warning)) is not None:
        ours = concentrated_in(seen, concentrated[1])
        return ours / TRUE_SHARE <= float(concentrated[2]) <= ours * TRUE_SHARE
    if (control := OF_CONTROL.match(warning)) is not None:
        ours = fraction_of(seen, control[1], "distortion")
        return ours / TRUE_SHARE <= float(control[2]) <= ours * TRUE_SHARE
    if (pressed := OF_PRESSED.match(warning)) is not None:  # frames lie between the looks of the program
        ours = pressed_by(seen, pressed[1])
        return float(pressed[2]) > PRESSED and ours > max(PRESSED, float(pressed[2]) / TRUE_SHARE) / TRUE_SHARE
    if (corner := OF_CORNER.match(warning)) is not None:
        return min(measure.inside_out(seen.bodies[corner[1]], frame.x, seen.X) for frame in seen.frames) < NEARLY_FLAT
    if (thickness := OF_THICKNESS.match(warning)) is not None:
        claimed = math.log(float(thickness[3]))
        return abs(math.log(thickness_asked_for(seen, thickness[1])) - claimed) <= TRUE_STRAIN * abs(claimed)
    if (energy := OF_ENERGY.match(warning)) is not None:  # rows of a history are far between, so that ours is coarse
        return energy_fraction(seen, expected, energy[1], "scene" in energy[3]) > float(energy[2]) / 100 / COARSE
    if (swing := OF_SWING.match(warning)) is not None:
        return energy_fraction(seen, expected, "time integration", True) > float(swing[1]) / 100 / COARSE
    if (rounding := OF_ROUNDING.match(warning)) is not None:
        ours = 2.0 ** -53 * float(np.max(np.abs(seen.X[seen.bodies[rounding[1]].nodes])))
        return ours / TRUE_SHARE <= float(rounding[2]) <= ours * TRUE_SHARE
    if (pair := OF_OVERLAP.match(warning)) is not None:
        ours, full = depth_of_pair(seen, pair[1], pair[2])
        deeper = OF_DEEPER.search(warning)
        claimed = float(pair[3] if deeper is None else deeper[1])
        return ours / TRUE_DEPTH <= claimed and (full or claimed <= ours * TRUE_DEPTH)
    if (itself := OF_ITSELF.match(warning)) is not None:  # ours is the smaller part of an edge, theirs the way out
        body = seen.bodies[itself[1]]
        return max(measure.self_overlap(body, frame.x) for frame in seen.frames) > SEEN * body.depth
    if (node := OF_NODE.match(warning)) is not None:
        ours = depth_at_rims(seen, node[1])
        if ours > 0 and ours / TRUE_DEPTH <= float(node[2]) <= ours * TRUE_DEPTH:
            return True
    if OF_DEPTH.search(warning):
        claimed = [float(value) for value in re.findall(NUMBER + r" m\b", warning)]
        named = any(re.search(rf"\b{name}\b", warning) for name in seen.bodies)
        sizes = [(ours, full) for pair, *both, _, size, full in depths(seen, expected) for ours in both if ours > SEEN * size
                 and (not named or any(re.search(rf"\b{name}\b", warning) for name in pair))]
        return wall_is_passed(seen, claimed) or any(
            not claimed or ours / TRUE_DEPTH <= claimed[0] and (full or claimed[0] <= ours * TRUE_DEPTH) for ours, full in sizes)
    if re.search(r"energy|creat", warning, re.IGNORECASE):
        return any(fault.kind == "energy" for fault in faults)
    return bool(faults)


def wall_is_passed(seen, claimed):
    """Whether a body is as far behind a rigid plane as is claimed."""
    for plane in seen.case.get("planes", []):
        if plane["kind"] != "rigid" or not claimed:
            continue
        normal = np.array(plane["normal"], dtype=float) / np.linalg.norm(plane["normal"])
        point = np.array([number(p) for p in plane["point"]])
        nodes = seen.bodies[plane["surface"].partition(".")[0]].nodes
        ours = -min(float(np.min((frame.x[nodes] - point) @ normal)) for frame in seen.frames)
        if ours > 0 and ours / TRUE_DEPTH <= claimed[0] <= ours * TRUE_DEPTH:
            return True
    return False


def excuses(fault, warnings):
    """Whether true warnings cover a fault: of rounding a small difference, of the shape of elements what comes of it, of energy that, of
    contact all but momentum and numbers. A swing of the kinetic energy covers as much energy as it names."""
    if fault.kind == "likeness":
        return fault.amount <= CHATTER and any(OF_ROUNDING.match(warning) for warning in warnings)
    swings = [float(swing[1]) / 100 for warning in warnings if (swing := OF_SWING.match(warning)) is not None]
    if fault.kind == "energy" and swings and fault.amount <= TRUE_SHARE * max(swings):
        return True
    warnings = [warning for warning in warnings if not OF_ROUNDING.match(warning) and not OF_SWING.match(warning)]
    of_energy = [OF_ENERGY.match(warning) is not None for warning in warnings]
    if all(energy or of_elements(warning) for energy, warning in zip(of_energy, warnings)):
        return fault.kind == "inside out" and not all(of_energy) or fault.kind == "energy" and any(of_energy)
    return fault.kind not in ("momentum", "finite")


def gives_reason(run):
    """Whether a refusal names a key and a bound, or a stop names a place and a bound."""
    if run.status == BAD_CASE:
        key, bound = r"'[\w.\[\]]+(: \w+)?'|\b\w+\[\d+\]", r"expected|at most|range|by " + NUMBER
        return bool(re.search(key, run.said)) and bool(re.search(bound, run.said))
    place, bound = r"stopped at .*: \w+ in [\w.]+", r"limit is|the step fell|of the reference"
    return bool(re.search(place, run.said)) and bool(re.search(bound, run.said))


def last_state_kept(run):
    try:
        frames, _, _ = measure.read_frames(run.folder)
    except measure.Unreadable:
        return False
    return bool(frames) and (Path(run.folder) / "summary.json").is_file()


def worst(faults):
    return max(faults, key=lambda fault: fault.amount).text if len({fault.kind for fault in faults}) == 1 else "; ".join(
        {fault.kind: fault.text for fault in sorted(faults, key=lambda fault: fault.amount)}.values())


def refusal_is_true(run, initial):
    """Whether bodies that are said to start in each other do; `initial` is our depth there [m], None if not known."""
    claimed = re.search(r"start penetrated, by " + NUMBER + " m", run.said)
    if claimed is None or initial is None:
        return True
    return float(claimed.group(1)) <= TRUE_DEPTH * initial + 1e-12


def look(run, expected):
    """The run as seen, with the number of its steps."""
    seen = Seen(run)
    seen.steps = steps_of(run)
    return seen


def steps_of(run):
    text = (Path(run.folder) / "summary.json").read_text(encoding="utf-8")
    found = re.search(r'"steps": (\d+)', text)
    return int(found.group(1)) if found else 0


def verdict_of(run, expected, again=None, initial=None, twin=None):
    """The Verdict of a run.

    again     runs the same scene with half the step ("half") or a quarter ("quarter"), on a finer mesh ("mesh"), with more frames
              ("frames"), from places aside by a nudge (NUDGED), or up to a time [s]: a Finished
    initial   how deep the bodies are in each other at the start, where it is known [m]
    twin      the same scene elsewhere: (its Finished, factor of speeds, how like they are)
    """
    if run.status is None:
        return Verdict(BROKEN, f"cut after {run.seconds:.0f} s", [])
    if run.status == BAD_CASE:
        if not gives_reason(run):
            return Verdict(BROKEN, "refused without a reason: " + first_line(run.said), [])
        if not refusal_is_true(run, initial):
            ours = "not known" if initial is None else f"{initial:.3g} m"
            return Verdict(BROKEN, f"refused without cause: our depth is {ours}: " + first_line(run.said), [])
        return Verdict(REFUSED, first_line(run.said), [])
    if run.status == ENDED_EARLY:
        return verdict_of_stop(run, expected, again)
    if run.status != DONE:
        return Verdict(BROKEN, f"ended with status {run.status}: " + first_line(run.said), [])
    seen = look(run, expected)
    expected, faults = decided(seen, expected, again)
    faults += faults_of(seen, expected)
    if twin is not None:
        faults += likeness(seen, look(twin[0], expected), *twin[1:])
    return verdict_of_end(run, seen, expected, faults, again)


def names_what_is_seen(run, expected):
    """Whether a run stops for an overlap that the judge finds in what it left: within a factor of two a fault by his own limits, and as
    deep as is said."""
    pair = OF_OVERLAP.search(last_line(run.said))
    if pair is None:
        return False
    seen = look(run, expected)
    if any(name not in seen.bodies for name in pair.groups()[:2]) or not overlap_faults(seen, expected, OVERLAP / TRUE_DEPTH):
        return False
    ours, full = depth_of_pair(seen, pair[1], pair[2])
    deeper = OF_DEEPER.search(last_line(run.said))
    claimed = float(pair[3] if deeper is None else deeper[1])
    return ours / TRUE_DEPTH <= claimed and (full or claimed <= ours * TRUE_DEPTH)


def least_corner(run, expected, name):
    """The least Jacobian of a corner of a body in the frames of a run, over the mean one of its element in the reference."""
    seen = look(run, expected)
    return min(measure.inside_out(seen.bodies[name], frame.x, seen.X) for frame in seen.frames)


def is_of_the_mesh(run, expected, again):
    """Whether a run stops for an inverted corner that the judge sees, and corners come as far with half the step and with a quarter: this
    mesh then has no shape there for what acts on it, at any step."""
    stop = OF_INVERSION.search(last_line(run.said))
    if stop is None or not least_corner(run, expected, stop[1]) < 0:
        return False
    others = [again(change) if again else None for change in ("half", "quarter")]
    return all(other is not None and other.status in (DONE, ENDED_EARLY) and
               (OF_INVERSION.search(last_line(other.said)) or least_corner(other, expected, stop[1]) < AS_GOOD_AS_INVERTED)
               for other in others)


def verdict_of_stop(run, expected, again):
    """A stop is right if it gives its reason, keeps its state, and names an overlap that the judge sees too or an inversion that shorter
    steps come to as well, or neither shorter steps nor a finer mesh pass. Of the steps both half and a quarter must: a scene that passes
    with one of them by chance is not better for it."""
    said = last_line(run.said)
    if not gives_reason(run):
        return Verdict(BROKEN, "stopped without a reason: " + said, [])
    if not last_state_kept(run):
        return Verdict(BROKEN, "stopped, and the last state is lost: " + said, [])
    if any(word == "untouched" for word, *_ in expected.answers):
        return Verdict(BROKEN, "stopped without cause, nothing touches: " + said, [])
    again = functools.cache(again) if again else None
    if names_what_is_seen(run, expected) or is_of_the_mesh(run, expected, again):
        return Verdict(REFUSED, said, [])

    def passes(change):
        other = again(change) if again else None
        return other is not None and other.status == DONE and not faults_of(look(other, expected), expected)

    if passes("half") and passes("quarter"):
        return Verdict(BROKEN, f"stopped without cause, passes at half the step and at a quarter: {said}", [])
    if passes("mesh"):
        return Verdict(BROKEN, f"stopped without cause, passes on a finer mesh: {said}", [])
    return Verdict(REFUSED, said, [])


def verdict_of_end(run, seen, expected, faults, again):
    """A run that came to its end is judged by its faults and its warnings."""
    warnings = warnings_of(run.said)
    if not warnings:
        return Verdict(BROKEN, "in silence: " + worst(faults), faults) if faults else Verdict(GOOD, "", faults)
    true = [warning for warning in warnings if is_true(warning, seen, expected, faults)]
    if len(true) < len(warnings) and again is not None:  # the deepest may lie between two frames
        closer = again("frames")
        if closer is not None and closer.status == DONE:
            seen = look(closer, expected)
            faults = faults_of(seen, expected)
            true = [warning for warning in warnings if is_true(warning, seen, expected, faults)]
    for warning in [one for one in warnings if one not in true and AT_TIME.search(one)] if again is not None else []:
        until = again(float(AT_TIME.search(warning)[1]))
        if until is None or until.status not in (DONE, ENDED_EARLY):
            continue
        then = look(until, expected)
        if is_true(warning, then, expected, faults_of(then, expected)):
            true.append(warning)
    left = [fault for fault in faults if not excuses(fault, true)]
    told = tuple((warning, warning in true) for warning in warnings)
    if len(true) < len(warnings):
        false = next(warning for warning in warnings if warning not in true)
        ours = max((max(deep, below) for _, deep, below, *_ in depths(seen, expected)), default=0.0)
        said = f"false warning (our depth is {ours:.3g} m): {false}" + (f"; {worst(faults)}" if faults else "")
        return Verdict(BROKEN, said, faults, told)
    if left:
        return Verdict(BROKEN, "warned of something else: " + worst(left), faults, told)
    return Verdict(WARNED, true[0], faults, told)


def class_of(verdict, reason, note):
    """The class of a cell: good cells with a note are one, and so are refusals during the run."""
    if verdict == GOOD and note:
        return NOTED
    return STOPPED if verdict == REFUSED and OF_STOP.match(reason) else verdict


def first_line(said):
    """The first fault of a refusal, without the path of the case."""
    lines = [line for line in said.splitlines() if line.strip()]
    return re.sub(r"^\S*\.yaml:", "", lines[0]).strip() if lines else "nothing is said"


def last_line(said):
    lines = [line for line in said.splitlines() if line.strip()]
    return lines[-1].strip() if lines else "nothing is said"


# ------------------------------------------------------------------------------------------------
# Before a run

def box_of(mesh):
    """Points and cells of a box as a case describes it."""
    low, high = ([number(c) for c in mesh[end]] for end in ("low", "high"))
    nx, ny, nz = mesh["cells"]
    points = np.array([(x, y, z) for z in np.linspace(low[2], high[2], nz + 1) for y in np.linspace(low[1], high[1], ny + 1)
                       for x in np.linspace(low[0], high[0], nx + 1)])
    first = np.array([(k * (ny + 1) + j) * (nx + 1) + i for k in range(nz) for j in range(ny) for i in range(nx)])
    up, along = (nx + 1) * (ny + 1), nx + 1
    ring = np.stack([first, first + 1, first + along + 1, first + along], axis=1)
    return points, np.concatenate([ring, ring + up], axis=1)


def placed(entry, points):
    """Points of a body where the case puts them."""
    if "rotate" in entry:
        about = np.array([number(a) for a in entry["rotate"].get("about", [0, 0, 0])])
        points = (points - about) @ rotation(entry["rotate"]["axis"], number(entry["rotate"]["angle"])).T + about
    return points + np.array([number(m) for m in entry.get("move", [0, 0, 0])])


def initial_depth(case, folder):
    """How deep bodies of contacts are in each other before anything moves [m]; None where a mesh is of another kind."""
    points, bodies, count = [], {}, 0
    for entry in case["bodies"]:
        if entry["mesh"]["kind"] == "box" and "map" not in entry["mesh"]:
            here, cells = box_of(entry["mesh"])
        elif entry["mesh"]["kind"] == "file":
            arrays = measure.read_arrays(Path(folder) / entry["mesh"]["path"], {"points", "connectivity", "offsets"})
            here, cells = arrays["points"], arrays["connectivity"].reshape(len(arrays["offsets"]), -1)
        else:
            return None
        points.append(placed(entry, here))
        bodies[entry["name"]] = (cells + count, number(entry.get("element", {}).get("thickness", 0)))
        count += len(here)
    X = np.concatenate(points)
    made = {name: measure.Body(cells, X, 1.0, thickness) for name, (cells, thickness) in bodies.items()}
    pairs = {tuple(sorted(contact[key].partition(".")[0] for key in ("apexes", "base"))) for contact in declared(case)}
    return max((measure.overlap(made[one], made[other], X)[0] for one, other in pairs if one != other), default=0.0)
