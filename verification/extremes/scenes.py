"""Scenes at the extremes: each function returns a Scene, a plain case with its meshes and what the judge should know of it.

All is soft, so that a run takes a second: 1 MPa, 1000 kg/m3, waves of about 37 m/s. Lengths are in metres, SIZE is that of a cube.
A scene is made for a fineness: 1, or 2 for a mesh twice as fine.
"""
import dataclasses
import math
import random

import numpy as np
from judge import Expected, rotation
from meshes import Mesh, brick, grid, prism, ridge, sheet, valley

YOUNG, DENSITY, POISSON = 1e6, 1000.0, 0.3
SIZE = 0.01                               # [m]
SOUND = math.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY)  # [m/s] of waves in a wide body
X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


@dataclasses.dataclass
class Scene:
    """A case, its mesh files by name, and what is known of it; `twin` is the same scene elsewhere: (Scene, speeds, within)."""
    case: dict
    meshes: dict
    expected: Expected
    twin: tuple = None


# ------------------------------------------------------------------------------------------------
# Words of a case

def length(value):
    return f"{float(value)!r} m"


def vector(values, unit="m"):
    return [f"{float(v)!r} {unit}" for v in values]


def material(young=YOUNG, density=DENSITY, poisson=POISSON):
    return {"kind": "elastic", "density": f"{float(density)!r} kg/m^3", "young": f"{float(young)!r} Pa", "poisson": float(poisson)}


def box(low, high, cells, fine=1):
    """The mesh of a case: a box."""
    return {"kind": "box", "low": vector(low), "high": vector(high), "cells": [max(1, round(c * fine)) for c in cells]}


def body(name, mesh, move=(0, 0, 0), rotate=None, of=None, element=None):
    """An entry of `bodies`; a Mesh goes into a file."""
    entry = {"name": name, "mesh": {"kind": "file", "path": f"{name}.vtu"} if isinstance(mesh, Mesh) else mesh}
    if rotate is not None:
        entry["rotate"] = {"axis": [float(a) for a in rotate[0]], "angle": f"{float(rotate[1])!r} deg"}
    entry["move"] = vector(move)
    entry["material"] = of or material()
    if element:
        entry["element"] = element
    return entry, mesh


def contact(apexes, base, name="t", **keys):
    return {"name": name, "apexes": apexes, "base": base, **keys}


def scene(bodies, contacts, velocities, end, frames=60, answers=(), pairs=None, scale=0.0, planes=(), **more):
    """Puts a scene together; velocities are {body: three numbers or expressions}."""
    case = {"bodies": [entry for entry, _ in bodies]}
    if contacts:
        case["contacts"] = list(contacts)
    if planes:
        case["planes"] = list(planes)
    case.update(more)
    case["initial"] = [{"body": name, "velocity": [v if isinstance(v, str) else repr(float(v)) for v in value], "unit": "m/s"}
                       for name, value in velocities.items()]
    case["time"] = {"end": f"{float(end)!r} s", **case.get("time", {})}
    case["output"] = {"frames_every": f"{float(end) / frames!r} s", "history_every": f"{float(end) / 400!r} s", "precision": "double"}
    meshes = {f"{entry['name']}.vtu": mesh for entry, mesh in bodies if isinstance(mesh, Mesh)}
    return Scene(case, meshes, Expected(pairs, list(answers), scale))


def fixed(*sets, name="hold"):
    return {"name": name, "kind": "fixed", "nodes": list(sets)}


def wall(surface, point, normal, name="wall", **keys):
    return {"name": name, "kind": "rigid", "surface": surface, "point": vector(point), "normal": list(normal), **keys}


def enough(path, least=60, most=400, depth=SIZE / 4):
    """Frames so that a body goes no farther than half of an element between two of them."""
    return int(min(most, max(least, 2 * path / depth)))


# ------------------------------------------------------------------------------------------------
# Bars and blocks that meet

def bars(fine=1, speed=0.05 * SOUND, left=None, right=None, cells=(8, 2, 2), other=None, skins=False, offset=(0, 0), gap=SIZE / 100,
         element=None, size=SIZE, at=(0, 0, 0), least=0.3, most=1.001, step=None, bars_long=4, **keys):
    """Two bars end to end: the left one runs into the right one, and they part."""
    left, right = left or material(), right or material()
    long = bars_long * size
    meshes = [brick((-long, -size / 2, -size / 2), (0, size / 2, size / 2), [c * fine for c in cells]),
              brick((0, -size / 2, -size / 2), (long, size / 2, size / 2), [c * fine for c in other or cells])]
    if not skins:
        meshes = [box((-long, -size / 2, -size / 2), (0, size / 2, size / 2), cells, fine),
                  box((0, -size / 2, -size / 2), (long, size / 2, size / 2), other or cells, fine)]
    sides = ("skin", "skin") if skins else ("x_high", "x_low")
    slow = [math.sqrt(number(m["density"]) / number(m["young"])) for m in (left, right)]
    end = gap / speed + 2.5 * long * sum(slow)
    path = speed * end
    return scene([body("a", meshes[0], np.add(at, (-gap, offset[0], offset[1])), of=left, element=element),
                  body("b", meshes[1], at, of=right, element=element)],
                 [contact(f"a.{sides[0]}", f"b.{sides[1]}", **keys)], {"a": (speed, 0, 0)}, end, enough(path, depth=size / 4),
                 [("separates", "a", "b", X, least, most)], **({"time": {"safety": step}} if step else {}))


def number(quantity):
    return float(str(quantity).split(" ")[0])


def drop(fine=1, speed=0.05 * SOUND, skins=True, cells=(3, 3, 3), base_cells=(5, 5, 2), of=None, base_of=None, gap=SIZE / 50,
         shift=(0.0011, 0.0007), turned=None, size=SIZE, at=(0, 0, 0), element=None, step=None, side=1.0, least=0.1, most=1.001, time=3.0,
         accept=None, **keys):
    """A cube falls on a block that stands on the ground, and comes back. `side` is that of the cube over SIZE."""
    s, w = size * side, 2.4 * size
    low, high = (-s / 2, -s / 2, 0), (s / 2, s / 2, s)
    base_low, base_high = (-w / 2, -w / 2, -size), (w / 2, w / 2, 0)
    cube = brick(low, high, [c * fine for c in cells]) if skins else box(low, high, cells, fine)
    base = brick(base_low, base_high, [c * fine for c in base_cells]) if skins else box(base_low, base_high, base_cells, fine)
    of, base_of = of or material(), base_of or material()
    wave = sum(d * math.sqrt(number(m["density"]) / number(m["young"])) for d, m in ((s, of), (size, base_of)))
    turned_up = 0.0
    if turned:
        corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
        turned_up = -float(np.min((corners @ rotation(turned[0], math.radians(turned[1])).T)[:, 2]))
    names = ("a.skin", "b.skin") if skins else ("a.z_low", "b.z_high")
    if accept:
        keys["initial_penetration"] = "accept"
    end = abs(gap) / speed + time * wave
    return scene([body("a", cube, np.add(at, (shift[0], shift[1], gap + turned_up)), turned, of, element),
                  body("b", base, at, None, base_of, element)],
                 [contact(*names, **keys)], {"a": (0, 0, -speed)}, end, enough(speed * end, depth=size / 4),
                 [] if least is None else [("returns", "a", Z, -speed, least, most)],
                 planes=[fixed("b.z_low")], **({"time": {"safety": step}} if step else {}))


def plate_hit(fine=1, speed=0.02 * SOUND, thickness=1e-3, span=6 * SIZE, cells=6, gap=SIZE / 50, passes=None, step=None, of=None,
              plate_of=None, side="top", block_cells=(2, 2, 2), end=None, most=1.0, at=(0, 0, 0), size=SIZE, **keys):
    """A block falls on the middle of a plate that is clamped at its rim, and does not go through."""
    h = size / 2
    plate = sheet((-span / 2, -span / 2), (span / 2, span / 2), (cells * fine, cells * fine))
    end = end or abs(gap) / speed + 12 * size / SOUND
    if passes:
        keys["passes"] = passes
    block = box((-h, -h, 0), (h, h, 2 * h), block_cells, fine)
    return scene([body("block", block, np.add(at, (0.0013, 0.0007, thickness / 2 + gap)), of=of),
                  body("plate", plate, at, of=plate_of, element={"thickness": length(thickness)})],
                 [contact("block.z_low", f"plate.{side}", **keys)], {"block": (0, 0, -speed)}, end,
                 enough(speed * end, depth=max(thickness, size / 8)), [("side", "block", "plate")], planes=[fixed("plate.rim")],
                 **({"time": {"safety": step}} if step else {}))


def planes_of(one):
    """Planes between elements: themselves, or (low, high, number of elements)."""
    return np.linspace(one[0], one[1], one[2] + 1) if isinstance(one, tuple) else np.array(one, dtype=float)


def grid_of(xs, ys, zs):
    return grid(*(planes_of(one) for one in (xs, ys, zs)))


def two(cells, base, skins=True, element=None, speed=0.02 * SOUND, time=7, least=-0.2, **keys):
    """A cube of some cells falls on a given base that stands on the ground, and comes back."""
    cube = brick((-SIZE / 2, -SIZE / 2, 0), (SIZE / 2, SIZE / 2, SIZE), cells)
    end = SIZE / 50 / speed + time * SIZE / SOUND
    names = ("a.skin", "b.skin") if skins else ("a.z_low", "b.z_high")
    return scene([body("a", cube, (0.0011, 0.0007, SIZE / 50), element=element), body("b", base, element=element)],
                 [contact(*names, **keys)], {"a": (0, 0, -speed)}, end, 100, [("returns", "a", Z, -speed, least, 1.001)],
                 planes=[fixed("b.z_low")])


# ------------------------------------------------------------------------------------------------
# Edges, ridges and valleys

def crossing(fine=1, angle=90.0, corner=True, speed=0.02 * SOUND, cells=(10, 1, 1), passes="one", **keys):
    """Two bars cross: edge on edge (`corner`), or face on face."""
    long, w = 5 * SIZE, SIZE / 2
    up = w * math.sqrt(2) if corner else w
    mesh = brick((-long, -w, -w), (long, w, w), [c * fine for c in cells])
    if corner:
        mesh = mesh.mapped(lambda x, y, z: (x, (y - z) / math.sqrt(2), (y + z) / math.sqrt(2)))
    end = 0.001 / speed + 60 * SIZE / SOUND
    other = Mesh(mesh.points, mesh.cells, mesh.sets)
    return scene([body("a", mesh, (0, 0, up + 0.00025)), body("b", other, (0, 0, -up - 0.00025), (Z, angle))],
                 [contact("a.skin", "b.skin", passes=passes, **keys)], {"a": (0, 0, -speed), "b": (0, 0, speed)}, end,
                 enough(2 * speed * end, depth=SIZE / 4),
                 [("order", "a", "b", Z)] if corner else [])  # flat bars of one layer bend past each other's centres


def on_ridge(fine=1, angle=90.0, speed=0.03 * SOUND, passes="one", apex="block", shift=0.0004, across=2 * SIZE, **keys):
    """A block falls on a ridge with its face, and comes back."""
    roof = ridge(angle, SIZE, 2 * SIZE, 2 * fine, across, 6 * fine)
    block = brick((-SIZE / 2, -SIZE / 2, 0), (SIZE / 2, SIZE / 2, SIZE), (3 * fine,) * 3)
    end = SIZE / 50 / speed + 9 * SIZE / SOUND
    names = ("block.skin", "roof.skin") if apex == "block" else ("roof.skin", "block.skin")
    return scene([body("block", block, (shift, SIZE + 0.0003, SIZE / 50)), body("roof", roof)],
                 [contact(*names, passes=passes, **keys)], {"block": (0, 0, -speed)}, end, enough(speed * end),
                 [("returns", "block", Z, -speed, -0.35, 1.001)] if angle > 20 else [],  # a sharper one may give way for long
                 planes=[fixed("roof.z_low")])


def in_valley(fine=1, angle=90.0, speed=0.03 * SOUND, passes="one", body_kind="edge", shift=0.0004, **keys):
    """A prism falls with its edge, or a cube with its face, into a groove, and comes back."""
    groove = valley(angle, SIZE, 2 * SIZE, 3 * fine, 2 * SIZE)
    half = math.radians(angle / 2)
    points = groove.points
    width, height = float(points[:, 0].max()), float(points[:, 2].max())
    if body_kind == "edge":  # its edge is as sharp as the groove, less a tenth
        wide = 0.9 * min(SIZE / 2, 0.8 * width)
        high = max(wide / math.tan(half), SIZE / 4)
        falls = prism([(0, 0), (wide, high), (-wide, high)], SIZE, 2 * fine)
        place = (0.05 * wide, SIZE / 2, 0.02 * SIZE + 0.1 * wide / math.tan(half))
        down = place[2]
    else:
        w = SIZE / 2
        falls = brick((-w, -w, 0), (w, w, SIZE), (3 * fine,) * 3)
        lies = (w + abs(shift)) / math.tan(half) if w + abs(shift) < width else height  # between the flanks, or on their tops
        place, down = (shift, SIZE, lies + SIZE / 50), SIZE / 50
    end = down / speed + (3 if angle < 10 else 9 if body_kind == "edge" else 25) * SIZE / SOUND  # the edges of a face are soft
    return scene([body("block", falls, place), body("groove", groove)],
                 [contact("block.skin", "groove.skin", passes=passes, **keys)], {"block": (0, 0, -speed)}, end, enough(speed * end),
                 [("returns", "block", Z, -speed, -0.35, 1.001)] if angle > 10 else [], planes=[fixed("groove.z_low")])


# ------------------------------------------------------------------------------------------------
# Rims, tables, pits, thin bodies, closed skins

def table(fine=1, offset=0.005, height=-0.001, speed=2.0, skins=False, direction=-1, time=0.02, answers=None, ship=False, passes="one",
          gravity=None, **keys):
    """A block runs along x at a table 0.1 m long; `height` is that of its lower side over the table's top, `offset` beyond its rim."""
    low, high = (0, -0.03, -0.02), (0.1, 0.03, 0)
    block_low, block_high = (0, -0.01, 0), (0.02, 0.01, 0.01)
    cells, block_cells = (4, 2, 1), (2, 2, 1)
    meshes = [brick(low, high, [c * fine for c in cells]), brick(block_low, block_high, [c * fine for c in block_cells])] if skins else [
        box(low, high, cells, fine), box(block_low, block_high, block_cells, fine)]
    bodies = [body("table", meshes[0]), body("block", meshes[1], (0.1 + offset, 0.001, height))]
    velocities = {"block": (direction * speed, 0, 0)}
    if ship:
        bodies.append(body("ship", box((1, 1, 1), (2, 2, 2), (1, 1, 1))))
        velocities["ship"] = (30, 0, 0)
    names = ("block.skin", "table.skin") if skins else ("block.z_low", "table.z_high")
    more = {"gravity": vector((0, 0, -gravity), "m/s^2")} if gravity else {}
    return scene(bodies, [contact(*names, passes=passes, **keys)], velocities, time, enough(speed * time), answers or [],
                 planes=[fixed("table.z_low" if skins else "table")], **more)


def pit(fine=1, speed=0.03 * SOUND, passes="one", sideways=0.5, gap=0.001, **keys):
    """A cube bounces in a pit of a block, and stays in it or comes out at its mouth."""
    third = 1.2 * SIZE
    block = brick((-1.5 * third, -1.5 * third, -SIZE), (1.5 * third, 1.5 * third, SIZE), (6 * fine, 6 * fine, 4 * fine),
                  lambda x, y, z: z < 0 or max(abs(x), abs(y)) > third / 2)
    cube = brick((-SIZE / 2, -SIZE / 2, 0), (SIZE / 2, SIZE / 2, SIZE), (3 * fine,) * 3)
    end = 10 * gap / speed + 6 * SIZE / SOUND
    return scene([body("cube", cube, (0.0002, -0.0001, gap)), body("pit", block)],
                 [contact("cube.skin", "pit.skin", passes=passes, **keys)],
                 {"cube": (speed * sideways, 0.7 * speed * sideways, -speed)}, end, enough(speed * end),
                 [("stays", "cube", Z, 0.0, SIZE / 8)], planes=[fixed("pit.z_low")])


def rests(fine=1, cells=(4, 4, 4), skins=True, load=500.0, poisson=0.0, passes="one", relax=True, **keys):
    """A cube rests on a like one, flush: it settles as faces do, by its weight over the stiffness."""
    of = material(poisson=poisson)
    upper = brick((0, 0, 0), (SIZE,) * 3, [c * fine for c in cells]) if skins else box((0, 0, 0), (SIZE,) * 3, cells, fine)
    lower = brick((0, 0, -SIZE), (SIZE, SIZE, 0), [c * fine for c in cells]) if skins else box((0, 0, -SIZE), (SIZE, SIZE, 0), cells, fine)
    weight = DENSITY * load * SIZE  # [Pa]
    settles = weight * SIZE / YOUNG / 3 + weight / (20 * YOUNG / (SIZE / cells[2] / fine))  # of the centre: own strain, and the penalty
    more = {"relaxation": {"residual": 1e-3}} if relax else {}
    names = ("a.skin", "b.skin") if skins else ("a.z_low", "b.z_high")
    return scene([body("a", upper, (0, 0, 1e-7), of=of), body("b", lower, of=of)], [contact(*names, passes=passes, **keys)], {}, 0.2, 40,
                 [("stands", "a", Z, -settles - 1e-7, 0.5 * settles)], planes=[fixed("b")], scale=weight * SIZE**2 * SIZE / 10,
                 gravity=vector((0, 0, -load), "m/s^2"), **more)


def two_walls(fine=1, speed=0.3 * SOUND, thickness=0.002, passes="one", walls=2, end=None, **keys):
    """A block runs into thin walls and stays on its side of the first."""
    wall_cells = (1, 4, 4)
    bodies, contacts = [], []
    block = brick((-0.02, -0.01, -0.01), (0, 0.01, 0.01), [2 * fine] * 3)
    bodies.append(body("block", block, (-0.005, 0.002, 0.001)))
    for n in range(walls):
        name = f"wall{n}"
        bodies.append(body(name, brick((0, -0.02, -0.02), (thickness, 0.02, 0.02), [c * fine for c in wall_cells]), (0.01 * n, 0, 0)))
        contacts.append(contact("block.skin", f"{name}.skin", f"t{n}", passes=passes, **keys))
    end = end or 0.005 / speed + 0.06 / SOUND
    held = fixed(*(f"wall{n}.{end_of_wall}" for n in range(walls) for end_of_wall in ("y_low", "y_high")))
    return scene(bodies, contacts, {"block": (speed, 0, 0)}, end, enough(speed * end, depth=max(thickness, 0.001)),
                 [("side", "block", "wall0")], planes=[held])


def accepted(fine=1, depth=0.003, **keys):
    """A cube starts in a block, which is accepted; it leaves, comes back elsewhere, and must not be as deep in it again."""
    cube = box((-0.005, -0.005, 0), (0.005, 0.005, 0.01), (2, 2, 2), fine)
    block = box((-0.03, -0.03, -0.02), (0.03, 0.03, 0), (3, 3, 2), fine)
    return scene([body("a", cube, (0.0003, 0.0002, -depth)), body("b", block)],
                 [contact("a.z_low", "b.z_high", initial_penetration="accept", **keys)], {"a": (0.3, 0, 1)}, 0.06, 100,
                 planes=[fixed("b")], gravity=vector((0, 0, -50), "m/s^2"))


def tied(fine=1, offset=0.0, **keys):
    """A cube is tied to a block, over its rim or past it, and pulled off by its speed: it holds, or somebody must be told."""
    cube = box((-0.005, -0.005, 0), (0.005, 0.005, 0.01), (2, 2, 2), fine)
    block = box((-0.01, -0.01, -0.01), (0.01, 0.01, 0), (2, 2, 1), fine)
    return scene([body("a", cube, (offset, 0.0002, 0)), body("b", block)], [contact("a.z_low", "b.z_high", kind="tied", **keys)],
                 {"a": (0, 0, 0.2)}, 0.01, 60, [("stands", "a", Z, 0.0, 0.001)], pairs=[], planes=[fixed("b.z_low")])


def strip(fine=1, plates=False, squeeze=1.0, rows=2, automatic=False, thickness=0.002, cells=40):
    """A strip is folded by its ends until it goes through itself: only its own contact finds that."""
    element = {"thickness": length(thickness)} if plates else None
    straight = sheet((0, 0), (0.2, 0.01), (cells * fine, 2)) if plates else brick((0, 0, 0), (0.2, 0.01, 0.004), (cells * fine, 1, rows))
    mesh = straight.mapped(lambda x, y, z: (x, y, z + 0.002 * math.sin(math.pi * x / 0.2)))
    mesh.sets = {"left": np.flatnonzero(mesh.points[:, 0] < 1e-9), "right": np.flatnonzero(mesh.points[:, 0] > 0.2 - 1e-9)}
    planes = [{"name": "left", "kind": "driven", "nodes": ["strip.left"], "velocity": {"value": ["1", "0", "0"], "unit": "m/s"}},
              {"name": "right", "kind": "driven", "nodes": ["strip.right"], "velocity": {"value": ["-1", "0", "0"], "unit": "m/s"}}]
    contacts = [{"name": "all", "kind": "automatic"}] if automatic else []
    return scene([body("strip", mesh, element=element)], contacts, {}, 0.14 * squeeze, 20, planes=planes)


def sandwich(fine=1, thickness=1e-3, speed=0.02 * SOUND, both=False, end=None, **keys):
    """A block between two plates, or two contacts with the two sides of one plate."""
    plate = sheet((-0.03, -0.03), (0.03, 0.03), (6 * fine, 6 * fine))
    block = box((-0.005, -0.005, 0), (0.005, 0.005, 0.01), (2, 2, 2), fine)
    bodies = [body("block", block, (0.0013, 0.0007, thickness / 2 + 0.001)),
              body("plate", plate, element={"thickness": length(thickness)})]
    contacts = [contact("block.z_low", "plate.top", "top", **keys)]
    if both:
        contacts.append(contact("block.z_low", "plate.bottom", "under", **keys))
        held, answers = [fixed("plate.rim")], [("side", "block", "plate")]
    else:
        bodies.append(body("lid", Mesh(plate.points, plate.cells, plate.sets), (0, 0, 0.01 + 2e-3 + thickness),
                           element={"thickness": length(thickness)}))
        contacts.append(contact("block.z_high", "lid.bottom", "over", **keys))
        held, answers = [fixed("plate.rim", "lid.rim")], [("side", "block", "plate"), ("side", "block", "lid")]
    end = end or 40e-3
    return scene(bodies, contacts, {"block": (0, 0, -speed)}, end, enough(speed * end), answers, planes=held)


# ------------------------------------------------------------------------------------------------
# Friction

def slide(fine=1, friction=0.3, passes="one", skins=False, speed=1.0, gravity=100.0, end=0.01, cells=(3, 3, 2), **keys):
    """A block slides on a table under gravity that is there from the start; Coulomb's law says how it slows down."""
    low, high, base_low, base_high = (0, -0.005, 0), (0.01, 0.005, 0.005), (-0.01, -0.01, -0.005), (0.05, 0.01, 0)
    meshes = [brick(low, high, [c * fine for c in cells]), brick(base_low, base_high, (12 * fine, 4 * fine, fine))] if skins else [
        box(low, high, cells, fine), box(base_low, base_high, (12, 4, 1), fine)]
    names = ("block.skin", "table.skin") if skins else ("block.z_low", "table.z_high")
    left = max(0.0, speed - friction * gravity * end)
    scale = DENSITY * 0.01 * 0.01 * 0.005 * speed**2 / 2
    return scene([body("block", meshes[0], (0, 0.0003, 1e-9)), body("table", meshes[1])],
                 [contact(*names, friction=friction, passes=passes, **keys)], {"block": (speed, 0, 0)}, end, 60,
                 [("moves", "block", X, left, 0.15 * speed)] if friction <= 1 else [("no_faster", "block", X, 1.02 * speed)],  # it trips
                 planes=[fixed("table.z_low" if skins else "table")], gravity=vector((0, 0, -gravity), "m/s^2"), scale=scale)


def reversals(fine=1, friction=0.3, passes="one", amplitude=0.5, period=4e-3, gravity=100.0, cycles=3, **keys):
    """A table goes to and fro under a block: friction dissipates and never gives."""
    low, high, base_low, base_high = (-0.005, -0.005, 0), (0.005, 0.005, 0.005), (-0.02, -0.01, -0.005), (0.02, 0.01, 0)
    velocity = {"value": [f"{amplitude!r}*cos(2*pi*t/{period!r})", "0", "0"], "unit": "m/s"}
    planes = [{"name": "shaker", "kind": "driven", "nodes": ["table.z_low"], "velocity": velocity}]
    table_mesh = box(base_low, base_high, (8, 4, 1), fine)
    return scene([body("block", box(low, high, (3, 3, 2), fine), (0, 0.0003, 1e-9)), body("table", table_mesh)],
                 [contact("block.z_low", "table.z_high", friction=friction, passes=passes, **keys)], {"table": (amplitude, 0, 0)},
                 cycles * period, 60, [("no_faster", "block", X, 1.6 * amplitude), ("stays", "block", Z, 0.0, 0.0006)], planes=planes,
                 gravity=vector((0, 0, -gravity), "m/s^2"), scale=DENSITY * 5e-7 * amplitude**2 / 2)


def oblique(fine=1, friction=0.3, passes="one", speed=0.05 * SOUND, skins=True, **keys):
    """A cube strikes a block askew: it comes back, slower along it. Where it sticks, what it had along the block comes back upwards too: a
    force through its centre would turn all of its energy, and no more."""
    made = drop(fine, speed, skins, friction=friction, passes=passes, **keys)
    came = (2.0, -0.5, -1.0)
    made.case["initial"][0]["velocity"] = [repr(c * speed) for c in came]
    made.expected.answers = [("returns", "a", Z, -speed, -0.3, math.hypot(*came)), ("no_faster", "a", X, 2.02 * speed)]
    return made


# ------------------------------------------------------------------------------------------------
# Ties, scales, long runs, far away

def tie(fine=1, kind="vertex", passes="one", speed=0.03 * SOUND, skins=True, gap=SIZE / 50, **keys):
    """A body falls so that an apex is exactly over a vertex, an edge, a diagonal or the top of a ridge."""
    w = SIZE
    if kind == "cone":  # the top of a pyramid of nodes exactly under the middle node of the block
        base = brick((-1, -1, -1), (1, 1, 0), (4 * fine, 4 * fine, 2 * fine)).mapped(
            lambda x, y, z: (w * x, w * y, w * z - (1 + z) * 0.5 * w * max(abs(x), abs(y))))
    elif kind == "pit":
        base = brick((-1, -1, -1), (1, 1, 0), (4 * fine, 4 * fine, 2 * fine)).mapped(
            lambda x, y, z: (w * x, w * y, w * z + (1 + z) * 0.3 * w * max(abs(x), abs(y))))
    elif kind == "saddle":
        base = brick((-1, -1, -1), (1, 1, 0), (4 * fine, 4 * fine, 2 * fine)).mapped(
            lambda x, y, z: (w * x, w * y, w * z + (1 + z) * 0.3 * w * (abs(x) - abs(y))))
    elif kind == "ridge":
        base = brick((-1, -1, -1), (1, 1, 0), (4 * fine, 4 * fine, 2 * fine)).mapped(
            lambda x, y, z: (w * x, w * y, w * z - (1 + z) * 0.5 * w * abs(x)))
    else:
        base = brick((-w, -w, -w), (w, w, 0), (4 * fine, 4 * fine, 2 * fine))
    cells, half = (2 * fine,) * 3, w / 2
    turned, up, shift = None, 0.0, (0.0, 0.0)
    if kind == "edge":
        shift = (w / 4, 0.0)
    elif kind == "diagonal":
        shift = (w / 4, w / 4)
    elif kind == "corner":  # a cube on its corner, over a vertex
        turned, up = ((1, -1, 0), math.degrees(math.atan(math.sqrt(2)))), None
    elif kind == "edge_down":
        turned, up = ((0, 1, 0), 45.0), None
    elif kind == "pit":
        up = 0.3 * half
    elif kind == "saddle":
        up = 0.3 * half
    cube = brick((-half, -half, -half), (half, half, half), cells)
    reach = half
    if up is None:
        corners = np.array([(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)])
        reach, up = -float(np.min((corners @ rotation(turned[0], math.radians(turned[1])).T)[:, 2])), 0.0
    end = gap / speed + (25 if turned else 9) * SIZE / SOUND  # corners and edges are soft
    return scene([body("cube", cube, (*shift, reach + up + gap), turned), body("base", base)],
                 [contact("cube.skin", "base.skin", passes=passes, **keys)], {"cube": (0, 0, -speed)}, end, enough(speed * end),
                 [("returns", "cube", Z, -speed, -0.3, 1.001)], planes=[fixed("base.z_low")])


def coincident(fine=1, passes="one", cells=(3, 3, 3), speed=0.03 * SOUND, skins=True, apart=0.0, **keys):
    """Two like cubes face to face with nodes on nodes from the start; one runs into the other."""
    low, high = (0, 0, 0), (SIZE,) * 3
    meshes = [brick(low, high, [c * fine for c in cells]) if skins else box(low, high, cells, fine) for _ in range(2)]
    names = ("a.skin", "b.skin") if skins else ("a.z_low", "b.z_high")
    end = 14 * SIZE / SOUND
    return scene([body("a", meshes[0], (0, 0, SIZE + apart)), body("b", meshes[1])], [contact(*names, passes=passes, **keys)],
                 {"a": (0, 0, -speed)}, end, 60, [("separates", "b", "a", Z, 0.0, 1.001)])


def scaled(fine=1, factor=1.0, kind="drop", **keys):
    """A scene with all lengths times a factor, and its twin of usual size: the same speeds."""
    def make(f):
        if kind == "bars":
            return bars(fine, size=SIZE * f, gap=SIZE * f / 100, **keys)
        return drop(fine, size=SIZE * f, gap=SIZE * f / 50, shift=(0.0011 * f, 0.0007 * f), **keys)
    made = make(factor)
    if factor != 1:
        made.twin = (make(1.0), 1.0, 1e-6)
    return made


def shifted(fine=1, lengths=0.0, kind="drop", along=(1, -0.7, 0.4), **keys):
    """A scene whose origin is many lengths away, and its twin at home."""
    make = {"drop": drop, "bars": bars, "plate": plate_hit}[kind]
    made = make(fine, at=np.array(along) * lengths * SIZE, **keys)
    if lengths:
        made.twin = (make(fine, **keys), 1.0, 1e-6 * max(1.0, lengths / 1e4))  # places are rounded
    return made


def far(fine=1, distance=1.0, passes="one", cells=(4, 4, 4), **keys):
    """Two cubes so far from each other [m] that nothing happens: the step is that of the elements."""
    a = brick((0, 0, 0), (SIZE,) * 3, [c * fine for c in cells])
    b = brick((-SIZE, -SIZE, -SIZE), (0, 0, 0), [c * fine for c in cells])
    end = 1e-3
    steps = end / (SIZE / cells[0] / fine / (2 * SOUND))
    return scene([body("a", a, (distance,) * 3), body("b", b)], [contact("a.skin", "b.skin", passes=passes, **keys)],
                 {"a": (1, 0, 0)}, end, 10, [("untouched", "a"), ("untouched", "b"), ("cheap", math.ceil(5 * steps))])


def bounces(fine=1, number_of=100, base="walls", speed=0.01 * SOUND, cells=(1, 1, 1), room=0.01 * SIZE, **keys):
    """A cube without viscosity flies to and fro between two walls, many times."""
    calm = {"viscosity": {"linear": 0.0, "quadratic": 0.0}}
    half = SIZE / 2
    cube = box((-half, -half, -half), (half, half, half), cells, fine)
    period = 2 * (room / speed + 2.5 * SIZE / SOUND)
    end = number_of / 2 * period
    if base == "walls":
        planes = [wall("cube.z_low", (0, 0, -half - room / 2), (0, 0, 1), "floor_below", **keys),
                  wall("cube.z_high", (0, 0, half + room / 2), (0, 0, -1), "roof", **keys)]
        return scene([body("cube", cube, element=calm)], [], {"cube": (0, 0, speed)}, end, 40,
                     [("stays", "cube", Z, -half - room / 2, SIZE / 4), ("stays", "cube", (0, 0, -1), -half - room / 2, SIZE / 4)],
                     planes=planes)
    blocks = [box((-SIZE, -SIZE, half + room / 2), (SIZE, SIZE, 2 * SIZE), (2, 2, 1), fine),
              box((-SIZE, -SIZE, -2 * SIZE), (SIZE, SIZE, -half - room / 2), (2, 2, 1), fine)]
    return scene([body("cube", cube, element=calm), body("roof", blocks[0]), body("ground", blocks[1])],
                 [contact("cube.z_high", "roof.z_low", "over", **keys), contact("cube.z_low", "ground.z_high", "under", **keys)],
                 {"cube": (0.0, 0.0, speed)}, end, 40,
                 [("stays", "cube", Z, -half - room / 2, SIZE / 4), ("stays", "cube", (0, 0, -1), -half - room / 2, SIZE / 4)],
                 planes=[fixed("roof", "ground")])


def stays_at_rest(fine=1, passes="one", skins=True, friction=0.0, gravity=10.0, end=0.1, damping=0.0, kind="cube", **keys):
    """A cube lies on a block under gravity and goes on lying there."""
    made = drop(fine, speed=1e-6, skins=skins, gap=1e-9, passes=passes, friction=friction,
                **({"method": "penalty", "damping_ratio": damping} if damping else {}), **keys)
    made.case["gravity"] = vector((0, 0, -gravity), "m/s^2")
    made.case["initial"] = []
    made.case["time"] = {"end": f"{end!r} s"}
    made.case["output"] = {"frames_every": f"{end / 40!r} s", "history_every": f"{end / 400!r} s", "precision": "double"}
    sag = DENSITY * gravity * SIZE**2 / YOUNG
    made.expected.answers = [("stands", "a", Z, 0.0, 4 * sag + SIZE / 100), ("stands", "a", X, 0.0, SIZE / 100)]
    made.expected.scale = DENSITY * SIZE**3 * gravity * SIZE / 10
    return made


def pile(fine=1, bodies=10, steps=1e5, gravity=10.0, friction=0.0, at_rest=False):
    """Cubes that lie on each other under gravity, and the lowest on a block that is held; they go on lying there.

    Gravity acts suddenly, and the pile swings; or it is brought to rest first. Without friction a tall pile is not stable: what slides
    aside tilts what is below, and the tilt lets it slide on. Ten of these cubes under g go apart by a factor e in 1.2 m/s / g (cubes as
    rigid bodies on springs of rotation E a^3 / 12): under 10 m/s^2 50 times in 1e5 steps, under 1 m/s^2 6 times. So what is at rest stays
    within some 1e-8 of a cube, which is round-off that has grown. What swings hops, and what hops goes apart by a factor e in some 5
    ms. It is held to a hundredth of a cube, and over few steps to what it swings down at first, twice the sag, times the growth of a pile
    at rest; places aside only where a nudge by 1e-9 of a cube does not decide them.
    """
    half, name = SIZE / 2, "abcdefghij"
    found = [body("base", box((-SIZE, -SIZE, -half), (SIZE, SIZE, 0), (3, 3, 1), fine))]
    for n in range(bodies):
        found.append(body(name[n], box((-half, -half, n * SIZE), (half, half, (n + 1) * SIZE), (2, 2, 2), fine)))
    end = steps * 0.5 * half / SOUND
    sag = DENSITY * gravity * (bodies * SIZE) ** 2 / (2 * YOUNG)
    down, aside = SIZE / 100, SIZE / 100
    if at_rest:
        down, aside = 2 * sag, SIZE / 1e6
    elif not friction:
        aside = min(aside, 2 * sag * math.exp(end * gravity / 1.2))
    made = scene(found, [{"name": "all", "kind": "automatic", "friction": friction}], {}, end, 40,
                 [("stands", name[n], axis, 0.0, most) for n in range(bodies) for axis, most in ((X, aside), (Y, aside), (Z, down))],
                 planes=[fixed("base")], gravity=vector((0, 0, -gravity), "m/s^2"))
    made.case["initial"] = []
    if at_rest:
        made.case["stages"] = [{"name": "settles", "duration": f"{end!r} s", "relaxation": {}},
                               {"name": "rests", "duration": f"{end!r} s"}]
        del made.case["time"]["end"]
    made.expected.nudge = 0.0 if at_rest or friction else 1e-9 * SIZE
    made.expected.scale = DENSITY * SIZE**3 * gravity * SIZE / 10
    return made


def spin(fine=1, turns=1.0, speed=0.02 * SOUND, element=None, cells=(3, 3, 3), plates=False, pair=False):
    """A body spins freely, and keeps its energy and its shape; or two, with a contact between them that never closes."""
    omega = speed / SIZE
    end = turns * 2 * math.pi / omega
    v = (f"-{omega!r}*y", f"{omega!r}*x", "0")
    if plates:
        mesh, element = sheet((-SIZE / 2, -SIZE / 2), (SIZE / 2, SIZE / 2), (3 * fine, 3 * fine)), {"thickness": length(SIZE / 10)}
    else:
        mesh = brick((-SIZE / 2,) * 3, (SIZE / 2,) * 3, [c * fine for c in cells])
    bodies, contacts, velocities, answers = [body("top", mesh, element=element)], [], {"top": v}, [("keeps_shape", "top", 0.02)]
    if pair:
        other = brick((-SIZE / 2,) * 3, (SIZE / 2,) * 3, [c * fine for c in cells])
        bodies.append(body("mate", other, (0, 0, 1.05 * SIZE)))
        velocities["mate"] = v
        contacts = [contact("top.skin", "mate.skin")]
        answers.append(("keeps_shape", "mate", 0.02))
    return scene(bodies, contacts, velocities, end, 40, answers)


# ------------------------------------------------------------------------------------------------
# At random

def shape(rng, fine, plates):
    """A random body: a box, a prism, or a plate; (mesh, thickness)."""
    kind = rng.choice(["box", "prism", "plate"] if plates else ["box", "box", "prism"])
    if kind == "plate":
        a, b, n, t = rng.uniform(0.6, 2) * SIZE, rng.uniform(0.6, 2) * SIZE, rng.randint(2, 4), SIZE * rng.uniform(0.05, 0.3)
        return sheet((-a / 2, -b / 2), (a / 2, b / 2), (n * fine, n * fine)), t
    if kind == "prism":
        r, turns = SIZE * rng.uniform(0.5, 1), sorted((rng.uniform(0, 1.2), rng.uniform(2.0, 3.2), rng.uniform(4.0, 5.2)))
        made = prism([(r * math.cos(t), r * math.sin(t)) for t in turns], SIZE * rng.uniform(0.5, 1.5), rng.randint(1, 2) * fine)
        return made.mapped(lambda x, y, z: (x, y - SIZE / 2, z)), 0.0
    sides = [SIZE * rng.uniform(0.4, 1.5) for _ in range(3)]
    return brick([-s / 2 for s in sides], [s / 2 for s in sides], [rng.randint(1, 3) * fine for _ in range(3)]), 0.0


def thrown(fine=1, seed=0, bodies=None, plates=True, automatic=False, defaults=False):
    """Bodies of random shape, turned and thrown at one another, with contact between all of them; the first may be a plate, of apexes.
    By an automatic contact any may be a plate, and they touch from both sides. With `defaults` no scene has a penalty of its own."""
    rng = random.Random(seed)
    many = bodies or rng.choice([2, 2, 2, 3, 4])
    passes, friction = rng.choice(["one", "two"]), rng.choice([0.0, 0.0, 0.2, 0.5, 1.0])
    penalty = rng.choice([{}, {}, {"method": "penalty"}, {"method": "penalty", "penalty_scale": rng.choice([2.0, 100.0])}])
    penalty = {} if defaults else penalty
    speed = SOUND * 10 ** rng.uniform(-1.5, -0.7)
    found, contacts, velocities = [], [], {}
    radius = 0.0
    placed = []
    for n in range(many):
        state = rng.random()
        mesh, thickness = shape(random.Random(f"{seed} {n} {state}"), fine, plates and (automatic or n == 0))
        mesh.points -= (mesh.points.min(axis=0) + mesh.points.max(axis=0)) / 2
        radius = float(np.linalg.norm(mesh.points, axis=1).max()) + thickness
        axis, angle = [rng.gauss(0, 1) for _ in range(3)], rng.uniform(0, 360)
        way = np.array([rng.gauss(0, 1) for _ in range(3)])
        way /= np.linalg.norm(way)
        distance = 1.02 * radius
        while any(np.linalg.norm(distance * way - centre) < 1.02 * (radius + other) for centre, other in placed):
            distance += 0.1 * SIZE
        centre = distance * way
        placed.append((centre, radius))
        name = f"body{n}"
        found.append(body(name, mesh, centre, (axis, angle), element={"thickness": length(thickness)} if thickness else None))
        aim = [rng.gauss(0, 0.3 * SIZE) for _ in range(3)]
        v = np.array(aim) - centre
        v *= speed / np.linalg.norm(v)
        w = np.array([rng.gauss(0, 1) for _ in range(3)]) * speed / SIZE * 0.5
        x, y, z = (f"({c}-({float(p)!r}))" for c, p in zip("xyz", centre))
        velocities[name] = tuple(f"({v[i]!r})+({w[(i + 1) % 3]!r})*{(x, y, z)[(i + 2) % 3]}-({w[(i + 2) % 3]!r})*{(x, y, z)[(i + 1) % 3]}"
                                 for i in range(3)) if not thickness else tuple(float(c) for c in v)
    for i in range(many):
        for j in range(i):
            plate = found[j][1].cells.shape[1] == 3
            contacts.append(contact(f"body{j}.{'top' if plate else 'skin'}", f"body{i}.skin", f"t{j}{i}", passes="one" if plate else passes,
                                    friction=friction, **penalty))
    if automatic:
        contacts = [{"name": "all", "kind": "automatic", "friction": friction, **penalty}]
    longest = max(np.linalg.norm(centre) for centre, _ in placed)
    end = 1.2 * longest / speed + 6 * SIZE / SOUND
    return scene(found, contacts, velocities, end, enough(speed * end, most=150))
