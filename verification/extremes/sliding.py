"""Scenes in which a body slides: each function returns a Scene, as those of scenes.py do, with the answer that Coulomb's law gives.

All is soft, as in scenes.py, unless a body is rigid. Meshes have 8 to 12 elements along a side of the body that slides. Contact is
automatic; `how` says which other contact there is in its place. Bodies slide along x.

Where all nodes slip the same way, the impulse of friction is the coefficient times that of the normal force, however the body bounces.
The momentum along z gives the normal impulse. So the velocity is known at every time, and no mean has to be taken:

    v(t) = v(0) + P t / m - mu (g t + v_z(t) - v_z(0))          P: a force that pulls or pushes along x
"""
import math

import numpy as np
from meshes import Mesh, brick
from scenes import DENSITY, SIZE, YOUNG, X, Y, Z, body, box, contact, drop, fixed, length, material, scene, sheet, vector

GRAVITY = 50.0                  # [m/s2]: a block weighs 250 Pa, a four-thousandth of its modulus
SPEED, PATH = 1.0, 0.008        # [m/s], [m]: some six elements of a block of eight
FRAMES = 16
LOW, FAR = -0.0075, 0.0155      # [m] of a floor; with a yaw of 45 degrees a block begins at -0.0071
HIGH = SIZE / 2                 # [m] of a block
WITHIN = {True: 0.01, False: 0.03}  # [-] of the speed, for scenes whose bodies are all rigid and for others
RISES = SIZE / 200              # [m] that a centre may rise: a hundredth of the height
DOWN = vector((0, 0, -GRAVITY), "m/s^2")


def contacts_of(how, friction, one="block", other="floor", sole="z_low", face="z_high"):
    """The contacts of a scene of two bodies: automatic, or declared with one pass or two; or automatic by a penalty."""
    if how in ("automatic", "penalty"):
        return [{"name": "all", "kind": "automatic", "friction": friction, **({"method": "penalty"} if how == "penalty" else {})}]
    if how == "one pass":
        return [contact(f"{one}.{sole}", f"{other}.{face}", friction=friction)]
    return [contact(f"{one}.skin", f"{other}.skin", passes="two", friction=friction)]


def made_rigid(entry, rigid):
    """An entry of `bodies` that moves as one, if it should."""
    if rigid:
        entry[0]["rigid"] = True
    return entry


def held(name, rigid, side="z_low"):
    return fixed(name if rigid else f"{name}.{side}")


def flat(fine=1, how="automatic", friction=0.3, rigid="", cells=8, floor_cells=7, speed=SPEED, gap=1e-9, aside=0.0003, yaw=0.0,
         block_of=None, floor_of=None, high=HIGH, floor_high=HIGH, pull=0.0, push=0.0, floor_moves=False, joint=None, wall=False):
    """A block slides on a floor under gravity that is there from the start.

    rigid         names of the bodies that are rigid, in one text
    cells         of the block along each side; `floor_cells` of the floor along the same length
    aside         [m] along x and y of the mesh lines of the floor
    yaw           [deg] of the block about z: at 45 a corner leads
    pull, push    [m/s2] at the front or at the back, over the mass of the block
    floor_moves   the floor moves to meet the block, which is at rest
    joint         [m] by which a second floor is lower, from x = 0.007 m on
    wall          the block slides along a wall as well, which does not touch the floor
    """
    half, wide = SIZE / 2, 0.7 * SIZE
    layers = max(1, round(cells * high / SIZE)) if high >= SIZE / cells else 2
    block = box((-half, -half, 0), (half, half, high), (cells, cells, layers), fine)
    ends, cell = [LOW, FAR], SIZE / floor_cells
    if joint is not None:
        ends[1:1] = [0.007]
    names, bodies = ["floor", "next"][:len(ends) - 1], []
    for n, name in enumerate(names):
        counts = [round((ends[n + 1] - ends[n]) / cell), round(2 * wide / cell), 1]
        mesh = box((ends[n], -wide, -floor_high), (ends[n + 1], wide, 0), counts, fine)
        bodies.append(made_rigid(body(name, mesh, (0, 0, -(joint or 0.0) * n), of=floor_of), "floor" in rigid))
    bodies.append(made_rigid(body("block", block, (aside, aside, gap), (Z, yaw) if yaw else None, block_of), "block" in rigid))
    if wall:
        along = round((ends[-1] - ends[0]) / cell)
        beside = box((ends[0], 0, 0.05 * SIZE), (ends[-1], 0.3 * SIZE, high), (along, 2, 4), fine)
        bodies.append(made_rigid(body("wall", beside, (0, half + aside, 0), of=floor_of), "floor" in rigid))
        names.append("wall")
    end, mass = PATH / speed, DENSITY * SIZE**2 * high
    loads = []
    if pull or push:
        side, sign = ("x_high", -1) if pull else ("x_low", 1)
        value = sign * (pull or push) * mass / (SIZE * high)
        loads = [{"name": "force", "kind": "pressure", "surface": f"block.{side}", "value": repr(value), "unit": "Pa"}]
    if floor_moves:
        velocity = {"value": [repr(-speed), "0", "0"], "unit": "m/s"}
        planes = [{"name": "hold", "kind": "driven", "nodes": [name if "floor" in rigid else f"{name}.z_low" for name in names],
                   "velocity": velocity}]
        velocities = {name: (-speed, 0, 0) for name in names}
    else:
        planes = [fixed(*(name if "floor" in rigid else f"{name}.{'y_high' if name == 'wall' else 'z_low'}" for name in names))]
        velocities = {"block": (speed, 0, 0)}
    within = WITHIN["block" in rigid and "floor" in rigid]
    made = scene(bodies, contacts_of(how, friction), velocities, end, FRAMES,
                 [("slides", "block", friction, within * speed, pull + push),
                  *([("no_lower", "block", (0, 0, -1), -RISES)] if high >= HIGH else [])],  # how far a thin block hops is not known
                 planes=planes, gravity=DOWN, scale=mass * speed**2 / 2, **({"loads": loads} if loads else {}))
    return made


def dragged(fine=1, how="automatic", friction=0.3, cells=8, floor_cells=7, speed=SPEED, load=0.01, soft="both", aside=0.0003):
    """The top of a block is pressed down and dragged over a floor: `load` is the pressure over the modulus of the softer body; `soft` is
    the body that is not a hundred times as stiff.

    The drag is asked for up to a load of 0.02. At 0.05 the leading edge of a soft block ploughs and folds: one pass stops, and a mesh twice
    as fine inverts a corner there, so that nobody knows the right drag.
    """
    half, wide, cell = SIZE / 2, 0.7 * SIZE, SIZE / floor_cells
    stiff = material(young=100 * YOUNG)
    block = box((-half, -half, 0), (half, half, HIGH), (cells, cells, cells // 2), fine)
    floor = box((LOW, -wide, -HIGH), (FAR, wide, 0), (round((FAR - LOW) / cell), round(2 * wide / cell), 1), fine)
    end = PATH / speed
    pressure = f"{load * YOUNG!r}*min(1, t/{end / 10!r})"
    planes = [fixed("floor.z_low"), {"name": "drive", "kind": "constrained", "nodes": ["block.z_high"], "normal": [1, 0, 0],
                                     "velocity": {"value": repr(speed), "unit": "m/s"}}]
    asked = [("drags", "block", friction, 0.03, "drive", "load")] if load <= 0.02 else []
    return scene([body("block", block, (aside, aside, 1e-9), of=None if soft in ("both", "block") else stiff),
                  body("floor", floor, of=None if soft in ("both", "floor") else stiff)],
                 contacts_of(how, friction), {"block": (speed, 0, 0)}, end, FRAMES,
                 [*asked, ("no_lower", "block", (0, 0, -1), -RISES)],
                 planes=planes, scale=load * YOUNG * SIZE**2 * max(friction, 0.1) * PATH,
                 loads=[{"name": "load", "kind": "pressure", "surface": "block.z_high", "value": pressure, "unit": "Pa"}],
                 probes=[{"name": "drive", "quantity": "impulse", "of": "drive", "component": "x"},
                         {"name": "load", "quantity": "impulse", "of": "load", "component": "z"}])


def plates(fine=1, how="automatic", friction=0.3, upper="plate", lower="solid", cells=8, floor_cells=7, thickness=5e-4, speed=SPEED):
    """A plate slides on a solid, a solid on a plate whose nodes are all held, or a plate on such a plate."""
    half, wide, cell = SIZE / 2, 0.7 * SIZE, SIZE / floor_cells
    element = {"thickness": length(thickness)}
    counts = (round((FAR - LOW) / cell), round(2 * wide / cell))
    top, under, bodies = 1e-9, 0.0, []
    if lower == "plate":
        bodies.append(body("floor", sheet((LOW, -wide), (FAR, wide), [c * fine for c in counts]), element=element))
        under = thickness / 2
    else:
        bodies.append(body("floor", box((LOW, -wide, -HIGH), (FAR, wide, 0), (*counts, 1), fine)))
    if upper == "plate":
        bodies.append(body("block", sheet((-half, -half), (half, half), (cells * fine, cells * fine)), (0.0003, 0.0003,
                           top + under + thickness / 2), element=element))
    else:
        bodies.append(body("block", box((-half, -half, 0), (half, half, HIGH), (cells, cells, cells // 2), fine),
                           (0.0003, 0.0003, top + under)))
    sides = {"plate": ("bottom", "top"), "solid": ("z_low", "z_high")}
    high = thickness if upper == "plate" else HIGH
    contacts = contacts_of(how, friction, sole=sides[upper][0], face=sides[lower][1])
    return scene(bodies, contacts, {"block": (speed, 0, 0)}, PATH / speed, FRAMES,
                 [("slides", "block", friction, WITHIN[False] * speed, 0.0), ("no_lower", "block", (0, 0, -1), -RISES)],
                 planes=[fixed("floor" if lower == "plate" else "floor.z_low")], gravity=DOWN,
                 scale=DENSITY * SIZE**2 * high * speed**2 / 2)


def groove(fine=1, how="automatic", friction=0.3, half_angle=45.0, rigid="", cells=8, floor_cells=7, speed=SPEED):
    """A prism slides along a groove with flat flanks: the forces on both are their share of the weight over the sine of half the angle."""
    slope = 1 / math.tan(math.radians(half_angle))
    wide, deep = 0.6 * SIZE, 0.5 * SIZE
    keel = brick((-1, -0.5, 0), (1, 0.5, 1), (cells * fine, cells * fine, max(2, cells // 2) * fine)).mapped(
        lambda u, y, w: (y * SIZE, u * wide / 2, abs(u) * wide / 2 * slope * (1 - w) + w * (wide / 2 * slope + 0.3 * SIZE)))
    under = wide * slope + deep
    bed = brick((-0.8, -1, -1), (2, 1, 0), (round(2.8 * floor_cells) * fine, 2 * round(0.6 * floor_cells) * fine, 2 * fine)).mapped(
        lambda x, u, w: (x * SIZE, u * wide, abs(u) * wide * slope * (1 + w) + w * (under - wide * slope)))
    mass = DENSITY * SIZE * wide * (wide / 2 * slope / 2 + 0.3 * SIZE)
    both = "block" in rigid and "floor" in rigid
    return scene([made_rigid(body("block", flipped(keel), (0.0003, 0, 1e-9)), "block" in rigid),
                  made_rigid(body("floor", flipped(bed)), "floor" in rigid)],
                 contacts_of(how, friction, sole="skin", face="skin"), {"block": (speed, 0, 0)}, PATH / speed, FRAMES,
                 [("slides", "block", friction / math.sin(math.radians(half_angle)), WITHIN[both] * speed, 0.0),
                  ("no_lower", "block", (0, 0, -1), -RISES)],
                 planes=[held("floor", "floor" in rigid)], gravity=DOWN, scale=mass * speed**2 / 2)


def flipped(mesh):
    """The mesh with the corners of its elements in the other order, if they are inside out."""
    a, b, c, d = (mesh.points[mesh.cells[0]][n] for n in (0, 1, 3, 4))
    if np.dot(np.cross(b - a, c - a), d - a) > 0:
        return mesh
    return Mesh(mesh.points, mesh.cells[:, [0, 3, 2, 1, 4, 7, 6, 5]], mesh.sets)


# ------------------------------------------------------------------------------------------------
# Curved faces

def rod(radius, long, cells, along, at=0.0):
    """A cylinder along x: a square that is bent to a circle, so that each of four sides has `cells` elements."""
    def bent(x, y, z):
        most = max(abs(y), abs(z))
        if most == 0:
            return x, 0.0, 0.0
        angle = math.atan2(z, y)
        round_part = most  # a square in the middle, a circle outside
        flat_part = np.array([y, z]) * (1 - round_part)
        even = math.floor((angle + math.pi / 4) / (math.pi / 2)) * math.pi / 2
        within = angle - even
        turned = even + math.pi / 4 * math.tan(within)  # equal parts of a side are equal parts of the circle
        return x, *(flat_part * 0.7 + most * round_part * np.array([math.cos(turned), math.sin(turned)]))
    mesh = brick((at, -1, -1), (at + long, 1, 1), (along, cells, cells)).mapped(bent)
    mesh.points[:, 1:] *= radius
    return flipped(mesh)


def tube(inner, outer, low, high, cells, along):
    """A tube along x with `cells` elements in each quarter and two through its wall."""
    around = 4 * cells
    points, found = [], []
    for i, x in enumerate(np.linspace(low, high, along + 1)):
        for k in range(around):
            for r in (inner, (inner + outer) / 2, outer):
                turn = 2 * math.pi * (k + 0.5) / around
                points.append((x, r * math.cos(turn), r * math.sin(turn)))

    def node(i, k, r):
        return (i * around + k % around) * 3 + r

    for i in range(along):
        for k in range(around):
            for r in range(2):
                found.append([node(i + a, k + b, r + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    outside = [n for n in range(len(points)) if n % 3 == 2]
    return flipped(Mesh(points, found, {"outside": outside}))


def plug(fine=1, how="automatic", friction=0.3, rigid="", clearance=0.02, cells=8, gravity=GRAVITY, speed=SPEED, lies=True):
    """A rod slides along the bore of a tube, on its lowest line; or, without gravity, through its middle, and touches nothing.

    Forces are nearly vertical: the contact is as wide as a seventh of the radius for the clearance of a fiftieth of it.
    """
    r = SIZE / 2
    inner = r * (1 + clearance)
    mesh, bore = rod(r, SIZE, cells * fine, cells * fine), tube(inner, 1.5 * r, -0.005, 0.022, cells * fine, 2 * cells * fine)
    both = "block" in rigid and "floor" in rigid
    answers = [("slides", "block", friction, WITHIN[both] * speed, 0.0), ("no_lower", "block", (0, 0, -1), -RISES)]
    down = facet_gap(r, inner, cells * fine) if lies else 0.0
    return scene([made_rigid(body("block", mesh, (0.0003, 0, -down)), "block" in rigid),
                  made_rigid(body("floor", bore), "floor" in rigid)],
                 contacts_of(how, friction, sole="skin", face="skin"), {"block": (speed, 0, 0)}, PATH / speed, FRAMES,
                 answers if lies else [("untouched", "block")], planes=[held("floor", "floor" in rigid, "outside")],
                 scale=DENSITY * math.pi * r * r * SIZE * speed**2 / 2, **({"gravity": vector((0, 0, -gravity), "m/s^2")} if lies else {}))


def facet_gap(r, inner, cells):
    """How far a rod of 4 x cells sides, a node lowest, is above the flat facet of a bore below [m], less a nanometre."""
    return inner * math.cos(math.pi / (4 * cells)) - r - 1e-9


def spun(fine=1, how="automatic", rigid="", clearance=0.02, cells=12, turns=1.0, speed=SPEED):
    """A rod spins in the bore of a tube on which it lies, without friction: it keeps its spin, but for what the facets take."""
    r = SIZE / 2
    made = plug(fine, how, 0.0, rigid, clearance, cells)
    omega = speed / r
    made.case["bodies"][0]["move"] = vector((0.0003, 0, -facet_gap(r, r * (1 + clearance), cells * fine)))
    centre = -facet_gap(r, r * (1 + clearance), cells * fine)
    made.case["initial"] = [{"body": "block", "velocity": ["0", f"-{omega!r}*(z-({centre!r}))", f"{omega!r}*y"], "unit": "m/s"}]
    end = turns * 2 * math.pi / omega
    made.case["time"]["end"] = f"{end!r} s"
    made.case["output"].update(frames_every=f"{end / FRAMES!r} s", history_every=f"{end / 400!r} s")
    made.expected.answers = [("spins", "block", X, 0.85, 1.001)]
    return made


def ball(fine=1, how="automatic", rigid="", cells=8, floor_cells=7, gravity=200.0):
    """A ball slides in a dish without friction: it swings as a pendulum does, and after half a period is as far on the other side."""
    r, dish, away = SIZE / 2, 3 * SIZE, SIZE / 2
    wide = 1.2 * SIZE
    n = cells * fine
    mesh = brick((-1, -1, -1), (1, 1, 1), (n, n, n)).mapped(lambda x, y, z: rounded(x, y, z, r))
    counts = [round(2 * wide / SIZE * floor_cells) * fine] * 2
    bowl = brick((-wide, -wide, -HIGH), (wide, wide, 0), (*counts, 2 * fine)).mapped(
        lambda x, y, z: (x, y, z + (1 + z / HIGH) * (dish - math.sqrt(dish * dish - x * x - y * y))))
    swing = dish - r
    up = swing * (1 - math.sqrt(1 - (away / swing) ** 2))
    theta = math.asin(away / swing)
    end = math.pi * math.sqrt(swing / gravity) * (1 + theta**2 / 16)
    above = 2e-5  # [m] so that no corner of the ball starts in a facet of the dish
    return scene([made_rigid(body("block", mesh, (-away, 0, r + up + above)), "block" in rigid),
                  made_rigid(body("floor", bowl), "floor" in rigid)],
                 contacts_of(how, 0.0, sole="skin", face="skin"), {}, end, FRAMES,
                 [("stands", "block", X, 2 * away, 0.1 * away), ("stands", "block", Y, 0.0, 0.1 * away)],
                 planes=[held("floor", "floor" in rigid)], gravity=vector((0, 0, -gravity), "m/s^2"),
                 scale=DENSITY * 4 / 3 * math.pi * r**3 * gravity * up)


def rounded(x, y, z, radius):
    """A point of the cube from -1 to 1 in the ball of a radius."""
    most = max(abs(x), abs(y), abs(z))
    if most == 0:
        return 0.0, 0.0, 0.0
    away = np.array([math.tan(math.pi / 4 * c / most) for c in (x, y, z)]) * most
    on_ball = away / np.linalg.norm(away) * most
    return tuple(radius * (most * on_ball + (1 - most) * 0.7 * np.array([x, y, z])))


# ------------------------------------------------------------------------------------------------
# Corners

def corner(fine=1, how="automatic", friction=0.3, cells=10, base_cells=None, step=None):
    """A cube strikes a block askew, and its leading corner slides. Two passes with friction have folded it on meshes of 9 to 12 elements
    along a side."""
    made = drop(fine, skins=True, cells=(cells,) * 3, base_cells=base_cells or (round(1.2 * cells), round(1.2 * cells), cells // 2),
                friction=friction, **({"step": step} if step else {}))
    if how != "one pass":
        made.case["contacts"] = contacts_of(how, friction, "a", "b")
    came, speed = (2.0, -0.5, -1.0), 0.05 * math.sqrt(YOUNG * 0.7 / (1.3 * 0.4) / DENSITY)
    made.case["initial"][0]["velocity"] = [repr(c * speed) for c in came]
    made.expected.answers = [("returns", "a", Z, -speed, -0.3, math.hypot(*came)), ("no_faster", "a", X, 2.02 * speed)]
    return made
