"""Blows of bodies with unlike meshes, and slides whose friction is known. See interface_scenes.py."""
import math

import slide_judge as judge
import slide_scenes as slides
import yaml
from interface_scenes import box, contacts_of, metres

SIDE, BLOCK = 0.05, (0.14, 0.14, 0.06)  # [m] of the cube that strikes, and of what it strikes
MASS = 7850 * SIDE**3
TURNS = {"edge": (math.pi / 4, 0.3), "corner": (math.pi / 4, math.atan(math.sqrt(0.5)))}  # about x, then about y
SEED = 20261127  # of the slides


def turned(how, point):
    (a, b), (x, y, z) = TURNS[how], point
    y, z = math.cos(a) * y - math.sin(a) * z, math.sin(a) * y + math.cos(a) * z
    return [math.cos(b) * x + math.sin(b) * z, y, -math.sin(b) * x + math.cos(b) * z]


def rotation(how):
    """Both turns as one rotation: by its matrix."""
    columns = [turned(how, axis) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
    angle = math.acos(max(-1.0, min(1.0, (columns[0][0] + columns[1][1] + columns[2][2] - 1) / 2)))
    axis = [columns[1][2] - columns[2][1], columns[2][0] - columns[0][2], columns[0][1] - columns[1][0]]
    return {"axis": axis, "angle": f"{angle:.15g} rad"}


def blow(rule, upper, lower, how, velocity, planes, friction=0.0):
    """The case of a cube that strikes a block with an edge that leans, or with a corner."""
    half = SIDE / 2
    lowest = min(turned(how, [a * half, b * half, c * half])[2] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1))
    return {
        "bodies": [box("lower", [-BLOCK[0] / 2, -BLOCK[1] / 2, -BLOCK[2]], [BLOCK[0] / 2, BLOCK[1] / 2, 0],
                       [lower, lower, max(2, lower // 2)]),
                   box("upper", [-half] * 3, [half] * 3, [upper] * 3, rotate=rotation(how), move=metres([0.002, 0.001, 1e-6 - lowest]))],
        "contacts": contacts_of(rule, ("upper.skin", SIDE / upper, "lower.skin", BLOCK[0] / lower), friction=friction),
        "planes": planes,
        "initial": [{"body": "upper", "velocity": [f"{part}" for part in velocity], "unit": "m/s"}],
        "probes": [{"name": f"momentum_{axis}", "quantity": "momentum", "of": "upper", "component": axis} for axis in "xyz"],
        "time": {"end": "0.4 ms"}, "output": {"history_every": "4 us", "frames_every": "0.4 ms"}}


def impact(rule, upper, lower, how, speed=10.0):
    """A cube falls on a held block."""
    held = [{"name": "ground", "kind": "fixed", "nodes": ["lower.z_low"]}]

    def measure(run):
        after = [run.column(f"momentum_{axis}")[-1] / MASS for axis in "xyz"]
        return {"speed [m/s]": after[2], "exchanged": after[2] + speed, "aside [%]": 100 * math.hypot(*after[:2]) / (after[2] + speed),
                "created": run.created()}
    return blow(rule, upper, lower, how, (0, 0, -speed), held), measure


def oblique(rule, upper, lower, speed=10.0, along=5.0):
    """A cube strikes a free block with a corner, with friction, as it moves along as well."""
    def measure(run):
        after = [run.column(f"momentum_{axis}")[-1] / MASS for axis in "xyz"]
        turn = math.dist(run.ledger("angular_momentum"), run.ledger("initial_angular_momentum"))
        return {"speed [m/s]": after[2], "exchanged": after[2] + speed, "along [m/s]": after[0], "aside [m/s]": after[1],
                "angular momentum": turn / (MASS * math.hypot(speed, along) * SIDE), "created": run.created()}
    return blow(rule, upper, lower, "corner", (along, 0, -speed), [], friction=0.3), measure


def blow_beside(found, two):
    """The upward momentum that the cube exchanges beside that by nodes of both sides."""
    off = 100 * (found.pop("exchanged") / two["exchanged"] - 1)
    return {"momentum off two passes [%]": off, **found}


def slide(rule, number):
    """A slide of scripts/slides on both skins: whether it is right, and the error of the tangential force."""
    drawn = slides.draw(SEED, number)
    case = yaml.safe_load(slides.scene(drawn, "two"))
    size = math.sqrt(math.prod(drawn.length[:2]) / math.prod(drawn.cells[:2]))
    case["contacts"] = contacts_of(rule, ("block.skin", size, "floor.skin", drawn.floor_cell), friction=drawn.friction)

    def measure(run):
        did = judge.measure(drawn, run.columns)
        return {"right": float(did.good(drawn.kind)), "force [%]": 100 * did.force}
    return case, measure


def slides_together(found):
    """How many are right, and the largest error."""
    return {f"right of {len(found)}": sum(one["right"] for one in found),
            "largest error of the force [%]": max(one["force [%]"] for one in found)}
