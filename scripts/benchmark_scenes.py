"""Scenes in which bodies touch, for scripts/benchmark contact: each with its contact, and without.

A scene is a case as users have them: a case of the tree, or one that is made here. A small version has fewer elements or ends earlier.
Frames are off: only start and end have one.
"""
import copy
import dataclasses
import itertools
import math
import random
from collections.abc import Callable
from pathlib import Path

import yaml
from interface_scenes import STEEL, box, metres

ROOT = Path(__file__).resolve().parents[1]
FLOWING = {**STEEL, "kind": "j2_bilinear", "yield": "300 MPa", "tangent": "995.260664 MPa"}
ALL = [{"name": "all", "kind": "automatic"}]
FRICTION = [{"name": "all", "kind": "automatic", "friction": 0.3}]
SEED = 20261127


@dataclasses.dataclass(frozen=True)
class Pair:
    """A case with contact, and the case without: `scene` runs the latter."""
    touching: dict
    free: dict
    program: str = "scene"  # that runs the case with contact

    def is_rigid(self):
        """Whether all bodies are rigid: elements cost nothing."""
        return all(body.get("rigid") for body in self.free["bodies"])


@dataclasses.dataclass(frozen=True)
class Scene:
    title: str
    make: Callable  # (whether the small version is meant): a pair


def read(path):
    return yaml.safe_load((ROOT / path).read_text(encoding="utf-8"))


def text_of(case):
    return yaml.safe_dump(case, sort_keys=False)


def without_frames(case, end):
    """
    >>> without_frames({"output": {"frames_every": "10 ms"}}, "2 ms")
    {'output': {'history_every': '2 ms', 'frames_every': '2 ms'}, 'time': {'end': '2 ms'}}
    """
    return {**case, "output": {"history_every": end, "frames_every": end}, "time": {**case.get("time", {}), "end": end}}


def without_contact(case):
    """The case without its contacts and without probes of them.

    >>> without_contact({"contacts": [{"name": "all"}], "probes": [{"name": "a", "of": "all"}, {"name": "b", "of": "ram"}]})
    {'probes': [{'name': 'b', 'of': 'ram'}]}
    """
    gone = {contact["name"] for contact in case["contacts"]}
    left = {key: copy.deepcopy(value) for key, value in case.items() if key != "contacts"}
    if "probes" in left:
        left["probes"] = [probe for probe in left["probes"] if probe["of"] not in gone]
    return left


def pair(case, end):
    case = without_frames(case, end)
    return Pair(case, without_contact(case))


# ------------------------------------------------------------------------------------------------
# Scenes

def cask(level, end):
    """A quarter of the cask. cask_drop always has contact between lead and cladding; so the case without contact is a scene with the same
    bodies and planes."""
    case = without_frames(read("cases/cask_drop/neptune.yaml"), end)
    case |= {"model": {"kind": "quarter"}, "mesh": {"level": level}}
    length, cladding = case["cylinder"]["length"], case["cladding"]
    radius, thickness = (float(text.removesuffix("mm")) for text in (case["cylinder"]["radius"], cladding["thickness"]))
    mesh = {"length": length, "turn": "quarter", "cells_core": level, "cells_along": 12 * level}
    names = ("lead", "cladding")
    free = {
        "bodies": [{"name": "lead", "mesh": {"kind": "cylinder", "radius": f"{radius} mm", "cells_ring": level, **mesh},
                    "material": case["lead"], "element": {"kind": case["element"]["lead"]}},
                   {"name": "cladding", "mesh": {"kind": "tube", "radius": f"{radius + thickness / 2} mm", **mesh},
                    "material": case["steel"], "element": {key: cladding[key] for key in ("thickness", "layers")}}],
        "planes": [{"name": "floor", "kind": "floor", "nodes": [f"{name}.bottom" for name in names], "point": metres([0, 0, 0]),
                    "normal": [0, 0, 1]},
                   *({"name": f"{axis}_plane", "kind": "symmetry", "nodes": [f"{name}.{axis}_plane" for name in names],
                      "normal": [int(axis == "x"), int(axis == "y"), 0]} for axis in "xy")],
        "initial": [{"body": name, "velocity": ["0", "0", f"-{case['initial']['speed'].removesuffix('mm/s')}"], "unit": "mm/s"}
                    for name in names],
        "time": case["time"], "output": case["output"]}
    return Pair(case, free, "cask_drop")


def flat_blocks(cells, layers, end):
    """Two blocks, an element of 1 mm each way, meet at 100 m/s with flat faces whose nodes are not opposite."""
    side, height, aside = 1e-3 * cells, 1e-3 * layers, 0.37e-3
    blocks = [box("lower", [0, 0, -height], [side, side, 0], [cells, cells, layers], FLOWING),
              box("upper", [aside, aside, 0.11e-3], [side + aside, side + aside, height + 0.11e-3], [cells, cells, layers], FLOWING)]
    return pair({"bodies": blocks, "contacts": ALL, "initial": [{"body": "upper", "velocity": ["0", "0", "-100"], "unit": "m/s"}]}, end)


def blocks_that_meet(count, end, cells=8):
    """A square of count x count cubes, 0.11 mm apart, in which neighbours approach each other at 20 m/s in both directions."""
    side, pitch = 1e-3 * cells, 1e-3 * cells + 0.11e-3
    bodies, initial = [], []
    for j in range(count):
        for i in range(count):
            name, low = f"b{count * j + i}", [i * pitch, j * pitch, 0]
            bodies.append(box(name, low, [x + side for x in low], [cells] * 3, FLOWING))
            velocity = [str(10 * (count - 1 - 2 * i)), str(10 * (count - 1 - 2 * j)), "0"]
            initial.append({"body": name, "velocity": velocity, "unit": "m/s"})
    return pair({"bodies": bodies, "contacts": ALL, "initial": initial}, end)


def direction(chance):
    """A unit vector at random.

    >>> round(math.hypot(*direction(random.Random(1))), 12)
    1.0
    """
    vector = [chance.gauss(0, 1) for _ in range(3)]
    return [x / math.hypot(*vector) for x in vector]


def turned(chance):
    return {"axis": direction(chance), "angle": f"{chance.uniform(0, 180):.6g} deg"}


def thrown(count, across, end):
    """Boxes and balls in turn, on places at random of a cubic grid with so many across, fly to its middle at 30 m/s, more or less. They
    are elastic: plastic corners can invert."""
    chance, pitch = random.Random(SEED), 0.052  # no point of a body is farther than half of that from its centre
    line = [pitch * (k - (across - 1) / 2) for k in range(across)]
    places = sorted(chance.sample(list(itertools.product(line, line, line)), count), key=lambda place: math.hypot(*place))
    bodies, initial = [], []
    for number, place in enumerate(places):
        name, here = f"b{number}", {"rotate": turned(chance), "move": metres(place)}
        if number % 2 == 0:
            half = [chance.uniform(0.011, 0.015) for _ in range(3)]
            bodies.append(box(name, [-x for x in half], half, [6, 6, 6], **here))
        else:
            mesh = {"kind": "sphere", "radius": metres([chance.uniform(0.018, 0.025)])[0], "turn": "full", "cells_core": 2, "cells_ring": 2}
            bodies.append({"name": name, "mesh": mesh, "material": STEEL, **here})
        far = max(math.hypot(*place), 1e-9)
        velocity = [-30 * x / far + chance.uniform(-6, 6) for x in place]
        initial.append({"body": name, "velocity": [f"{v:.6g}" for v in velocity], "unit": "m/s"})
    return pair({"bodies": bodies, "contacts": ALL, "initial": initial}, end)


def rigid_boxes(end):
    """A stack of six boxes on a held floor, 1 mm apart and each turned a little, at which four boxes are thrown at 4 m/s."""
    chance, half = random.Random(SEED), 0.05

    def rigid(name, low, high, **more):
        return box(name, low, high, [3, 3, 3], rigid=True, **more)
    bodies, initial = [rigid("floor", [-1, -1, -0.1], [1, 1, 0])], []
    for number in range(10):
        name, level = f"b{number}", number if number < 6 else number - 5
        at = [chance.uniform(-0.01, 0.01), chance.uniform(-0.01, 0.01), 0.051 + 0.101 * level]
        turn = {"axis": [0, 0, 1], "angle": f"{chance.uniform(-10, 10):.6g} deg"}
        if number >= 6:
            axis, side = number % 2, 1 if number < 8 else -1
            at[axis] -= 0.3 * side
            turn = turned(chance)
            velocity = [0.0, 0.0, 0.0]
            velocity[axis] = 4.0 * side
            initial.append({"body": name, "velocity": [f"{v}" for v in velocity], "unit": "m/s"})
        bodies.append(rigid(name, [-half] * 3, [half] * 3, rotate=turn, move=metres(at)))
    return pair({"bodies": bodies, "contacts": FRICTION, "initial": initial, "gravity": ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"],
                 "planes": [{"name": "ground", "kind": "fixed", "nodes": ["floor"]}], "time": {"largest_step": "0.5 ms"}}, end)


SCENES = {
    "cask_3": Scene("cask, quarter, level 3", lambda short: cask(3, "2 ms" if short else "8 ms")),
    "cask_6": Scene("cask, quarter, level 6", lambda short: cask(6, "1 ms" if short else "8 ms")),
    "flat_blocks": Scene("two blocks, 100 m/s", lambda short: flat_blocks(*((20, 10) if short else (50, 20)), "23.4 us")),
    "hundred_blocks": Scene("blocks that meet", lambda short: blocks_that_meet(4 if short else 10, "23.4 us")),
    "thrown": Scene("thrown bodies", lambda short: thrown(*((8, 2, "0.8 ms") if short else (20, 3, "1.6 ms")))),
    "crushed_tube": Scene("crushed tube", lambda short: pair(read("verification/crushed_tube/case.yaml"), "0.6 ms" if short else "3.6 ms")),
    "rigid_boxes": Scene("ten rigid boxes", lambda short: rigid_boxes("0.15 s" if short else "0.5 s")),
    "pile": Scene("pile with friction", lambda short: pair(read("cases/scene/pile.yaml"), "0.2 s" if short else "0.5 s")),
}
