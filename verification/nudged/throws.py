"""Random scenes of few elements, each a throw of some kind, and their twins: nudged, in a mirror, with other numbers, in another order."""
import dataclasses
import math

import mesh_files
from mesh_files import Mesh
from reference import NUDGE, Chance

KINDS = ("box on a floor", "boxes", "ball on a floor", "edge on an edge", "corner on a floor", "slide", "plate on a floor",
         "box on a plate", "plates", "stack")
SEEDS = range(1, 31)
END, FRAMES = 0.006, 30    # [s], [-]
THICK = 0.002              # [m]


@dataclasses.dataclass
class Body:
    name: str
    mesh: Mesh
    at: list        # [m] about which it turns
    velocity: list  # [m/s]
    spin: list      # [rad/s]
    plate: bool = False
    fixed: bool = False


@dataclasses.dataclass
class Throw:
    kind: str
    bodies: list
    friction: float
    declared: tuple = ()  # the bodies of the apexes and of the base; without any, contact is automatic


# ------------------------------------------------------------------------------------------------
# Meshes

def box(size, cells):
    """A box about the origin, its lowest nodes as the set `low`."""
    places = [[i - 0.5 * n for i in range(n + 1)] for n in cells]
    corners = ((x, y, z) for z in places[2] for y in places[1] for x in places[0])
    points = [[length * at / count for length, at, count in zip(size, corner, cells)] for corner in corners]
    row, layer = cells[0] + 1, (cells[0] + 1) * (cells[1] + 1)
    around = [0, 1, row + 1, row]
    firsts = [i + row * j + layer * k for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])]
    return Mesh(points, [[first + a + up for up in (0, layer) for a in around] for first in firsts],
                {"low": [int(n < layer) for n in range(len(points))]})


def sheet(length, width, cells):
    row = cells[0] + 1
    points = [[length * (i / cells[0] - 0.5), width * (j / cells[1] - 0.5), 0.0] for j in range(cells[1] + 1) for i in range(row)]
    triangles = []
    for j in range(cells[1]):
        for i in range(cells[0]):
            a, b, c, d = (i + row * j + n for n in (0, 1, row + 1, row))
            triangles += [[a, b, c], [a, c, d]] if (i + j) % 2 == 0 else [[a, b, d], [b, c, d]]
    return Mesh(points, triangles, {})


def ball(radius, cells):
    """A cube of cells laid onto a ball."""
    def onto(a, b, c):
        return radius * a * math.sqrt(1 - b * b / 2 - c * c / 2 + b * b * c * c / 3)

    cube = box([2, 2, 2], [cells] * 3)
    return dataclasses.replace(cube, points=[[onto(x, y, z), onto(y, z, x), onto(z, x, y)] for x, y, z in cube.points], sets={})


def turned(p, axis, angle):
    """Rodrigues' formula; the axis is a unit vector."""
    c, s, along = math.cos(angle), math.sin(angle), sum(a * b for a, b in zip(axis, p))
    across = [axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2], axis[0] * p[1] - axis[1] * p[0]]
    return [c * p[i] + s * across[i] + (1 - c) * along * axis[i] for i in range(3)]


# ------------------------------------------------------------------------------------------------
# Throws

def throw(seed):
    """A scene of the kind that is the next one with each seed."""
    chance = Chance(seed)
    kind, bodies, between = KINDS[seed % len(KINDS)], [], chance.between
    up, any_way = [0, 0, 1], lambda: (chance.direction(), between(0, 3.1))

    def add(name, mesh, turns, place, velocity=(0, 0, 0), spin=0.0, on=None, **more):
        """Turns a mesh, one turn after the other, and places it; `on` is the height of its lowest node. [m]"""
        points = mesh.points
        for axis, angle in turns:
            points = [turned(p, axis, angle) for p in points]
        place = [*place[:2], on - min(p[2] for p in points)] if on is not None else place
        moved = dataclasses.replace(mesh, points=[[a + b for a, b in zip(p, place)] for p in points])
        bodies.append(Body(name, moved, place, list(velocity), [spin * between(-1, 1) for _ in range(3)], **more))
        return max(p[2] for p in moved.points)

    def add_floor():
        add("floor", box([0.2, 0.2, 0.03], [chance.one_of((4, 5)), chance.one_of((4, 5)), 1]), [], [0, 0, -0.015], fixed=True)

    def any_box():
        return box([between(0.02, 0.05) for _ in range(3)], [chance.one_of((1, 2, 2, 3)) for _ in range(3)])

    beside = [between(-0.03, 0.03), between(-0.03, 0.03), 0.0]
    down = [between(-2, 2), between(-2, 2), -between(2, 4)]
    friction = chance.one_of((0.0, 0.3))
    if kind in ("box on a floor", "ball on a floor", "corner on a floor", "slide", "plate on a floor", "stack"):
        add_floor()
    if kind == "box on a floor":
        add("box", any_box(), [any_way()], beside, down, 40, on=0.002)
    elif kind == "boxes":
        aside = [between(-0.01, 0.01), between(-0.01, 0.01), 0]
        add("lower", any_box(), [any_way()], aside, [between(-1, 1), between(-1, 1), between(2, 4)], 60)
        add("upper", any_box(), [any_way()], [0, 0, 0.055], [between(-1, 1), between(-1, 1), -between(2, 4)], 60)
    elif kind == "ball on a floor":
        add("ball", ball(between(0.012, 0.02), chance.one_of((2, 3, 4))), [any_way()], beside, down, 60, on=0.002)
    elif kind == "corner on a floor":
        on_corner = ([math.sqrt(0.5), -math.sqrt(0.5), 0], math.acos(math.sqrt(1 / 3)))
        add("cube", box([0.03] * 3, [2] * 3), [on_corner, (up, between(0, 3))], beside, [0, 0, -3], on=0.002)
    elif kind == "edge on an edge":
        on_edge = ([1, 0, 0], math.pi / 4)
        add("lower", box([0.05, 0.02, 0.02], [chance.one_of((2, 3, 4)), 1, 1]), [on_edge], [0, 0, 0])
        add("upper", box([0.05, 0.022, 0.022], [chance.one_of((2, 3, 4)), 1, 1]), [on_edge, (up, between(0.3, 2.8))],
            [between(-0.008, 0.008), between(-0.008, 0.008), 0.031], [between(-1, 1), between(-1, 1), -3], 20)
    elif kind == "slide":
        add("block", box([between(0.03, 0.05), between(0.03, 0.05), between(0.02, 0.03)], [2, 2, 1]), [(up, between(0, 3))], beside,
            [between(1, 5), between(-1, 1), -1], 20, on=0.0005)
        friction = 0.3
    elif kind == "plate on a floor":
        add("plate", sheet(between(0.04, 0.06), between(0.03, 0.05), (3, 2)), [any_way()], beside, down, 30, on=0.003, plate=True)
    elif kind in ("box on a plate", "plates"):
        add("sheet", sheet(0.1, 0.08, (5, 4)), [(up, between(0, 1))], [0, 0, 0], plate=True)
        if kind == "plates":
            add("plate", sheet(between(0.04, 0.06), between(0.03, 0.05), (3, 2)), [any_way()], beside, down, 30, on=0.004, plate=True)
        else:
            add("box", any_box(), [any_way()], beside, down, 40, on=0.003)
    elif kind == "stack":
        top = 0.0
        for name in ("lower", "upper"):
            sizes = [between(0.03, 0.05), between(0.03, 0.05), between(0.02, 0.03)]
            top = add(name, box(sizes, [chance.one_of((2, 3)), chance.one_of((2, 3)), 1]), [(up, between(0, 3))],
                      [between(-0.01, 0.01), between(-0.01, 0.01), 0], [between(-0.5, 0.5), between(-0.5, 0.5), -1], on=top + 0.001)
    is_declared = len(bodies) == 2 and chance.unit() < 0.25
    return Throw(kind, bodies, friction, declared=(bodies[1].name, bodies[0].name) if is_declared else ())


# ------------------------------------------------------------------------------------------------
# Twins: each gives the scene, for each node of the scene its number there, and the signs of x, y, z

def same_numbers(scene):
    return list(range(sum(len(body.mesh.points) for body in scene.bodies)))


def nudged(scene, seed):
    chance = Chance(1000 + seed)

    def moved(mesh):
        return dataclasses.replace(mesh, points=[[a + NUDGE * b for a, b in zip(p, chance.direction())] for p in mesh.points])

    return (dataclasses.replace(scene, bodies=[dataclasses.replace(body, mesh=moved(body.mesh)) for body in scene.bodies]),
            same_numbers(scene), (1, 1, 1))


def mirrored(scene, seed):
    """Seen in the plane x = 0, nodes, elements and corners numbered as a mesh generator might have done it there."""
    chance, numbers, bodies = Chance(2000 + seed), [], []
    for body in scene.bodies:
        mesh, new, _ = mesh_files.renumbered(mesh_files.mirrored(body.mesh, "x"), chance.shuffled)
        first = len(numbers)
        numbers += [first + n for n in new]
        bodies.append(dataclasses.replace(body, mesh=mesh, at=[-body.at[0], *body.at[1:]], velocity=[-body.velocity[0], *body.velocity[1:]],
                                          spin=[body.spin[0], -body.spin[1], -body.spin[2]]))
    return dataclasses.replace(scene, bodies=bodies), numbers, (-1, 1, 1)


def in_another_order(scene, _):
    """The bodies listed the other way round."""
    bodies, first, numbers = scene.bodies[::-1], {}, []
    for body in bodies:
        first[body.name] = sum(len(one.mesh.points) for one in bodies[:len(first)])
    for body in scene.bodies:
        numbers += [first[body.name] + n for n in range(len(body.mesh.points))]
    return dataclasses.replace(scene, bodies=bodies), numbers, (1, 1, 1)


# ------------------------------------------------------------------------------------------------
# Cases

def velocity_of(body):
    """Expressions of x, y, z. [m/s]"""
    def along(i):
        j, k = (i + 1) % 3, (i + 2) % 3
        return f"({body.velocity[i]!r})+({body.spin[j]!r})*({'xyz'[k]}-({body.at[k]!r}))-({body.spin[k]!r})*({'xyz'[j]}-({body.at[j]!r}))"

    return ", ".join(f'"{along(i)}"' for i in range(3))


def put_down(folder, label, scene):
    """Writes a scene and its meshes; returns the path of its case."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["bodies:"]
    for body in scene.bodies:
        mesh_files.write(folder / f"{label}_{body.name}.vtu", body.mesh)
        lines += [f"- name: {body.name}", f"  mesh: {{kind: file, path: {label}_{body.name}.vtu}}",
                  "  material: {kind: elastic, density: 1000 kg/m^3, young: 10 MPa, poisson: 0.3}"]
        lines += [f"  element: {{thickness: {THICK} m}}"] if body.plate else []
    sides = "kind: automatic"
    if scene.declared:
        sides = "kind: contact, apexes: {}.skin, base: {}.skin".format(*scene.declared)
    lines += ["contacts:", f"- {{name: touch, {sides}, friction: {scene.friction}}}", "gravity: [0 m/s^2, 0 m/s^2, -200 m/s^2]"]
    fixed = [body.name for body in scene.bodies if body.fixed]
    lines += ["planes:", *(f"- {{name: hold, kind: fixed, nodes: [{name}.low]}}" for name in fixed)] if fixed else []
    free = [body for body in scene.bodies if not body.fixed]
    lines += ["initial:", *(f"- {{body: {body.name}, velocity: [{velocity_of(body)}], unit: m/s}}" for body in free)]
    lines += [f"time: {{end: {END} s}}", f"output: {{precision: double, frames_every: {END / FRAMES} s}}", ""]
    path = folder / f"{label}.yaml"
    path.write_text("\n".join(lines), encoding="utf-8")
    return path
