"""The cells of the matrix: for each axis its values, and for each value scenes and options. Defaults come first."""
import dataclasses
import math
from typing import Callable

import scenes
import sliding
from scenes import DENSITY, SIZE, SOUND, YOUNG, material

TWO, PENALTY = {"passes": "two"}, {"method": "penalty"}
ALL = {"faces": {"skins": False}, "skins": {}, "skins, two passes": TWO}
OFFSET = (0.0013, 0.0007)  # [m]


@dataclasses.dataclass(frozen=True)
class Cell:
    """One place of the matrix; `make` gives its scene for a fineness, `clock` is the time it may take [s], if it is a long one."""
    axis: str
    value: str
    scene: str
    option: str
    make: Callable
    clock: float = 0.0

    def name(self):
        words = "_".join(part for part in (self.axis, self.value, self.scene, self.option) if part)
        return "".join(c if c.isalnum() or c in "_.-+" else "_" for c in words)


def cell(axis, value, scene, option, function, clock=0.0, **keys):
    text = value if isinstance(value, str) else f"{value:g}"
    return Cell(axis, text, scene, option, lambda fine=1: function(fine, **keys), clock)


def with_options(axis, value, scene, function, options, clock=0.0, **keys):
    """A cell for each of the options: {name: keys}."""
    return [cell(axis, value, scene, name, function, clock, **{**keys, **more}) for name, more in options.items()]


PASSES = {"": {}, "two passes": TWO}


# ------------------------------------------------------------------------------------------------
# The axes, one function each

def time_step():
    """Step over the limit of the elements."""
    found = []
    for v in (0.1, 0.25, 0.5, 0.75, 0.9, 1.0, 1.05, 1.1):
        found += with_options("time step", v, "bars", scenes.bars, {"faces": {}, "eight points": {"element": {"kind": "full"}},
                                                                   "penalty": PENALTY}, step=v)
        found += with_options("time step", v, "drop", scenes.drop, {"skins": {}, "skins, two passes": TWO}, step=v)
        found += [cell("time step", v, "plate", "", scenes.plate_hit, step=v)]
    return found


def penalty():
    """Penalty over the stiffness of the softer side."""
    found = []
    for v in (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4):
        found += with_options("penalty", v, "bars", scenes.bars, {"faces": {}, "faces, two passes": TWO}, method="penalty", penalty_scale=v)
        found += with_options("penalty", v, "drop", scenes.drop, {"skins": {}, "skins, two passes": TWO}, method="penalty", penalty_scale=v)
        found += [cell("penalty", v, "plate", "", scenes.plate_hit, method="penalty", penalty_scale=v)]
    return found


RATIOS = (1e-6, 1e-4, 1e-2, 0.1, 10.0, 1e2, 1e4, 1e6)
PENALTIES = {"": {}, "two passes": TWO, "penalty": PENALTY}


def stiffness():
    """Young's modulus of the body that falls over that of the other."""
    found = []
    for v in RATIOS:
        of = {"of": material(young=YOUNG * v)} if v < 1 else {"base_of": material(young=YOUNG / v)}
        speed = 0.02 * SOUND * min(1, math.sqrt(v), math.sqrt(1 / v))
        found += with_options("stiffness ratio", v, "drop", scenes.drop, PENALTIES, cells=(2, 2, 2), base_cells=(3, 3, 1), speed=speed,
                              least=-0.5, **of)
    return found


def density():
    """Density of the body that falls over that of the other."""
    found = []
    for v in RATIOS:
        of = {"of": material(density=DENSITY * v)} if v < 1 else {"base_of": material(density=DENSITY / v)}
        found += with_options("density ratio", v, "drop", scenes.drop, PENALTIES, cells=(2, 2, 2), base_cells=(3, 3, 1),
                              speed=0.02 * SOUND, least=-0.5, **of)
    return found


def mesh_ratio():
    """Size of the elements of the body that falls over those of the other."""
    return [one for v in RATIOS for one in with_options("mesh ratio", v, "tiny cube" if v < 1 else "tiny block",
                                                        tiny_cube if v < 1 else tiny_block, PENALTIES, ratio=v)]


def tiny_cube(fine=1, ratio=0.1, **keys):
    """A tiny cube falls on a coarse block, and comes back."""
    s, speed = SIZE * ratio, 0.02 * SOUND
    cube = scenes.brick((-s / 2, -s / 2, 0), (s / 2, s / 2, s), (2 * fine,) * 3)
    block = scenes.brick((-SIZE, -SIZE, -SIZE), (SIZE, SIZE, 0), (2 * fine, 2 * fine, fine))
    return scenes.scene([scenes.body("a", cube, (0.0011, 0.0007, s / 50)), scenes.body("b", block)],
                        [scenes.contact("a.skin", "b.skin", **keys)], {"a": (0, 0, -speed)}, s / 50 / speed + 9 * s / SOUND, 100,
                        [("returns", "a", scenes.Z, -speed, -0.3, 1.001)], planes=[scenes.fixed("b.z_low")])


def tiny_block(fine=1, ratio=10.0, **keys):
    """A coarse cube falls on a tiny block with its face."""
    tiny = SIZE / ratio
    end = tiny / 50 / (0.02 * SOUND) + 12 * tiny / SOUND
    cube = scenes.brick((-SIZE / 2, -SIZE / 2, 0), (SIZE / 2, SIZE / 2, SIZE), (2 * fine,) * 3)
    block = scenes.brick((-tiny, -tiny, -tiny), (tiny, tiny, 0), (4 * fine, 4 * fine, 2 * fine))
    return scenes.scene([scenes.body("a", cube, (0.0011, 0.0007, tiny / 50)), scenes.body("b", block)],
                        [scenes.contact("b.skin", "a.skin", **keys)], {"a": (0, 0, -0.02 * SOUND)}, end, 100,
                        [("no_lower", "a", scenes.Z, -0.5 * tiny)], planes=[scenes.fixed("b.z_low")])


def aspect():
    """Length over width of the elements."""
    found = []
    for v in (1.0, 10.0, 100.0, 1e3, 1e4):
        for name, shape in (("flat", flat), ("column", column), ("sheared", sheared)):
            found += with_options("aspect ratio", v, name, shape, PASSES, ratio=v)
        found += [cell("aspect ratio", v, "flat", "faces", flat, ratio=v, skins=False),
                  cell("aspect ratio", v, "flat", "eight points", flat, ratio=v, element={"kind": "full"})]
    return found


def flat(fine=1, ratio=10.0, skins=True, element=None, **keys):
    """A cube falls on a block whose upper layer of elements is as flat as the ratio says."""
    thin = SIZE / 2 / ratio
    w = SIZE
    base = scenes.grid_of((-w, w, 4 * fine), (-w, w, 4 * fine), [-SIZE, -SIZE / 2 if thin < SIZE / 4 else -0.75 * SIZE, -thin, 0.0])
    return scenes.two((3 * fine,) * 3, base, skins, element, **keys)


def column(fine=1, ratio=10.0, **keys):
    """A cube falls on a block of elements as tall as the ratio says."""
    w = SIZE
    thin = SIZE / 2 / ratio
    base = scenes.grid_of((-w, w, 4 * fine), [-w, -thin, 0.0, w] if thin < w else [-w, 0.0, w], [-SIZE, -SIZE / 2, 0.0])
    return scenes.two((3 * fine,) * 3, base, **keys)


def sheared(fine=1, ratio=10.0, **keys):
    """A cube falls on a block of slivers: elements sheared along x until their angles are one over the root of the ratio. From a hundred on
    the block is a slab that hangs over, as thick as a twentieth of its length: it gives way for long, and slows the cube down."""
    w = SIZE
    shear = math.sqrt(max(ratio, 1.0)) - 1
    base = scenes.brick((-w, -w, -SIZE / 2), (w, w, 0), (4 * fine, 4 * fine, 2 * fine)).mapped(lambda x, y, z: (x + shear * z, y, z))
    return scenes.two((3 * fine,) * 3, base, time=16, least=-0.2 if ratio < 50 else -0.9, **keys)


def poisson():
    """Poisson's ratio of both bodies."""
    found = []
    for v in (-0.9, -0.5, 0.0, 0.3, 0.45, 0.49, 0.499, 0.4999):
        of = material(poisson=v)
        found += with_options("Poisson", v, "bars", scenes.bars,
                              {"flush": {}, "offset": {"offset": OFFSET}, "eight points": {"element": {"kind": "full"}},
                               "flush, 0.1 c": {"speed": 0.1 * SOUND},
                               "long, flush, 0.1 c": {"speed": 0.1 * SOUND, "bars_long": 10, "cells": (20, 2, 2)}}, left=of, right=of)
        found += with_options("Poisson", v, "drop", scenes.drop, {"skins": {}, "skins, two passes": TWO}, of=of, base_of=of)
    return found


def speed():
    """Speed over that of waves."""
    found = []
    for v in (1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0):
        keys = {"speed": v * SOUND, "gap": SIZE / 50 * min(1.0, 100 * v)}
        found += with_options("speed", v, "bars", scenes.bars, {"flush": {}, "offset, two passes": {"offset": OFFSET, **TWO}}, **keys)
        found += with_options("speed", v, "drop", scenes.drop, {"skins": {}, "skins, two passes": TWO, "penalty": PENALTY}, **keys)
        found += [cell("speed", v, "plate", "", scenes.plate_hit, **keys)]
        if v >= 0.01:
            found += with_options("speed", v, "walls", scenes.two_walls, {"": {}, "penalty": PENALTY}, speed=v * SOUND)
            found += [cell("speed", v, "under the table", "", scenes.table, offset=0.005, height=-0.031, speed=v * SOUND,
                           time=0.1 / (v * SOUND), answers=[("untouched", "block")])]
    return found


def thickness():
    """Thickness over length of plates and of thin solids."""
    found = []
    for v in (1e-5, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0):
        t = 6 * SIZE * v
        found += with_options("thickness", v, "plate", scenes.plate_hit, {"": {}, "penalty": PENALTY}, thickness=t, most=1.0,
                              speed=0.01 * SOUND)
        found += [cell("thickness", v, "two sides", "", scenes.sandwich, thickness=t, both=True, end=4e-3),
                  cell("thickness", v, "between plates", "", scenes.sandwich, thickness=t, end=10e-3),
                  *with_options("thickness", v, "thin wall", scenes.two_walls, PASSES, clock=120.0 if v < 1e-4 else 0.0, thickness=0.04 * v,
                                walls=1, speed=0.02 * SOUND)]
    return found


def friction():
    """Coulomb's coefficient."""
    found = []
    for v in (0.0, 0.1, 0.3, 0.577, 1.0, 3.0, 10.0, 100.0):
        found += with_options("friction", v, "slide", scenes.slide, {"": {}, "skins, two passes": {"skins": True, **TWO}}, friction=v)
        found += with_options("friction", v, "reversals", scenes.reversals, PASSES, friction=v)
        found += with_options("friction", v, "oblique", scenes.oblique, {"": {}, "two passes": TWO}, friction=v)
    return found


def gap():
    """Distance at the start over an element; less than zero is an overlap."""
    found = []
    for part in (1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 0.5):
        for v in (part, -part):
            g = v * SIZE / 3
            found += with_options("gap", v, "drop", scenes.drop, ALL,
                                  gap=g, speed=0.02 * SOUND)
            found += [cell("gap", v, "plate", "", scenes.plate_hit, gap=g)]
            if v < 0:
                found += with_options("gap", v, "drop", scenes.drop, {"faces, accepted": {"skins": False}, "skins, accepted": {}},
                                      gap=g, speed=0.02 * SOUND, accept=True)
    return found


def ridges():
    """The angle of a ridge, in the solid [deg]."""
    found = []
    for v in (1, 5, 15, 30, 60, 90, 120, 150, 170, 179):
        found += with_options("ridge", v, "face on ridge", scenes.on_ridge,
                              {"": {}, "two passes": TWO, "apexes on the ridge": {"apex": "roof"}, "exactly over": {"shift": 0.0}}, angle=v)
    return found


def valleys():
    """The angle of a valley, in the air [deg]."""
    found = []
    for v in (1, 5, 15, 30, 60, 90, 120, 150, 170, 179):
        found += with_options("valley", v, "edge in valley", scenes.in_valley, PASSES, angle=v)
        found += with_options("valley", v, "face on valley", scenes.in_valley, PASSES, angle=v, body_kind="face")
    return found


def shapes():
    """Rims, tables, pits, thin bodies, closed skins."""
    found = []
    skins = {"faces": {}, "skins": {"skins": True}, "skins, two passes": {"skins": True, **TWO}}
    alone = [("untouched", "block")]
    for v in (0.001, 0.005, 0.02):
        found += [cell("shapes", f"rim {v:g}", "block at a rim", "faces", scenes.table, offset=v),
                  cell("shapes", f"rim {v:g}", "block at a rim", "with a ship", scenes.table, offset=v, ship=True),
                  cell("shapes", f"rim {v:g}", "block at a rim", "skins", scenes.table, offset=v, skins=True),
                  cell("shapes", f"rim {v:g}", "block at a rim", "skins, two passes", scenes.table, offset=v, skins=True, **TWO)]
    for v in (0.0005, 0.002, 0.01):
        h = -0.03 - v
        found += [cell("shapes", f"under {v:g}", "block under a table", name, scenes.table, offset=0.005, height=h, answers=alone, **keys)
                  for name, keys in skins.items()]
        found += [cell("shapes", f"over {v:g}", "block over a table", name, scenes.table, offset=0.005, height=v, answers=alone, **keys)
                  for name, keys in skins.items()]
    for name, keys in skins.items():
        off = {"offset": -0.03, "height": 1e-6, "direction": 1, "gravity": 100.0, **keys}
        found += [cell("shapes", "off the rim", "block slides off", name, scenes.table, **off),
                  cell("shapes", "off the rim", "block slides off, friction", name, scenes.table, friction=0.3, **off)]
    for v in (0.0, 0.5, 1.0, 2.0):
        found += with_options("shapes", f"pit {v:g}", "cube in a pit", scenes.pit, PASSES, sideways=v)
    for n in (2, 3, 4):
        found += with_options("shapes", f"rests {n}", "closed skins", scenes.rests, ALL, cells=(n,) * 3)
    found += with_options("shapes", "accepted", "leaves and returns", scenes.accepted, PASSES)
    found += [cell("shapes", f"tie {v:g}", "over a rim", "", scenes.tied, offset=v) for v in (0.0, 0.008, 0.015, 0.025)]
    found += [cell("shapes", "folds", "strip", "solid", scenes.strip),
              cell("shapes", "folds", "strip", "plates", scenes.strip, plates=True),
              cell("shapes", "folds half", "strip", "solid", scenes.strip, squeeze=0.3)]
    for v in (5, 15, 30, 45, 60, 90):
        found += with_options("shapes", f"cross {v}", "edge on edge", scenes.crossing, PASSES, angle=v)
        found += with_options("shapes", f"cross {v}", "face on face", scenes.crossing, PASSES, angle=v, corner=False)
    return found


def ties():
    """Exact ties, coincident nodes, all conditions of Eq. (14) zero."""
    found = []
    for kind in ("vertex", "edge", "diagonal", "corner", "edge_down", "cone", "pit", "saddle", "ridge"):
        found += with_options("ties", kind.replace("_", " "), "cube", scenes.tie, PASSES, kind=kind)
    for n in (1, 2, 3):
        found += with_options("ties", f"coincident {n}", "cubes", scenes.coincident, ALL, cells=(n,) * 3)
    found += with_options("ties", "bars flush", "bars", scenes.bars, PASSES, skins=True)
    return found


def scale():
    """Sizes in metres."""
    found = []
    for v in (1e-9, 1e-6, 1e-3, 1.0, 1e3):
        found += with_options("scale", v, "drop", scenes.scaled, PENALTIES, factor=v / SIZE)
        found += [cell("scale", v, "bars", "", scenes.scaled, factor=v / SIZE, kind="bars")]
    return found


def shift():
    """How many lengths away the origin is."""
    found = []
    for v in (1.0, 1e2, 1e4, 1e6):
        found += with_options("shift", v, "drop", scenes.shifted, PASSES, lengths=v)
        found += [cell("shift", v, kind, "", scenes.shifted, lengths=v, kind=kind) for kind in ("bars", "plate")]
    return found


def distance():
    """How far from each other bodies are that do not touch [m]."""
    return [one for v in (0.1, 1.0, 10.0, 1e3, 1e6) for one in with_options("distance", v, "cubes", scenes.far, PASSES, distance=v)]


def long_runs():
    """Bounces, rest under gravity, spin."""
    found = []
    for v in (1e2, 1e3, 1e4):
        found += [cell("long", f"bounces {v:g}", "between walls", "", scenes.bounces, number_of=v),
                  cell("long", f"bounces {v:g}", "between blocks", "", scenes.bounces, number_of=v, base="blocks")]
    for v in (1e5, 1e6):
        found += [cell("long", f"bounces {v:g}", "between walls", "", scenes.bounces, number_of=v, clock=600.0)]
    for v in (0.1, 1.0):
        found += with_options("long", f"rest {v:g}", "cube", scenes.stays_at_rest,
                              {"faces": {"skins": False}, "skins": {}, "skins, two passes": TWO, "damped": {"damping": 0.3},
                               "friction": {"friction": 0.3}, "friction, two passes": {"friction": 0.3, **TWO}}, end=v)
    for v in (1.0, 10.0, 100.0):
        found += [cell("long", f"spin {v:g}", "cube", "", scenes.spin, turns=v),
                  cell("long", f"spin {v:g}", "cube", "eight points", scenes.spin, turns=v, element={"kind": "full"}),
                  cell("long", f"spin {v:g}", "plate", "", scenes.spin, turns=v, plates=True)]
    found += [cell("long", "spin 1", "two cubes", "", scenes.spin, turns=1.0, pair=True)]
    return found


# Seeds that were broken or went through each other once, beyond those from 0 on
OF_RANDOM = (20400039, 31000028, 31000068, 31000193, 31000399, 33000125, 33000228, 33000404, 33000600, 33001407)
OF_AUTOMATIC = (1000, 1041, 1086, 1090, 1121)


BY_AUTOMATIC = "automatic, defaults"  # the option of random scenes by automatic contact in which no key of the numerics is set


def at_random(first=0, count=29, also=OF_RANDOM, option=""):
    """Bodies of random shape, thrown at one another, by their seed."""
    keys = {"automatic": True, "defaults": True} if option == BY_AUTOMATIC else {}
    return [cell("random", str(seed), "thrown", option, scenes.thrown, seed=seed, **keys) for seed in (*range(first, first + count), *also)]


def automatic(first=0, count=24):
    """One contact of all bodies: thrown at random with plates from both sides, folds, piles."""
    found = [cell("automatic", str(seed), "thrown", "", scenes.thrown, seed=seed, automatic=True)
             for seed in (*range(first, first + count), *OF_AUTOMATIC)]
    found += [cell("automatic", "fold", "strip", "solid", scenes.strip, automatic=True),
              cell("automatic", "fold half", "strip", "solid", scenes.strip, automatic=True, squeeze=0.3)]
    found += [cell("automatic", f"fold {v:g} thick", "strip", "plates", scenes.strip, automatic=True, plates=True, thickness=v)
              for v in (0.0005, 0.001, 0.002, 0.004)]
    found += [cell("automatic", f"fold {v} cells", "strip", "plates", scenes.strip, automatic=True, plates=True, cells=v)
              for v in (20, 80)]
    found += [cell("automatic", f"pile {v:g} steps", "ten cubes", name, scenes.pile, 120.0, steps=v, friction=mu, gravity=g)
              for v in (1e4, 1e5) for name, mu, g in (("", 0.0, 1.0), ("friction", 0.3, 10.0))]
    found.append(cell("automatic", "pile 100000 steps", "ten cubes", "at rest", scenes.pile, 120.0, steps=1e5, gravity=1.0, at_rest=True))
    return found


HOWS = {"": {}, "one pass": {"how": "one pass"}}
HOWS_AND_TWO = {**HOWS, "two passes": {"how": "two passes"}}
PAIRS = {"soft": {}, "rigid": {"rigid": "block floor"}, "rigid on soft": {"rigid": "block"}, "soft on rigid": {"rigid": "floor"}}


def sliding_bodies():
    """Bodies that slide, by the kind of the scene; the option names what differs from an automatic contact with a friction of 0.3."""
    return [*flat_slides(), *extreme_slides(), *plate_slides(), *curved_slides(), *corners_that_slide()]


def slide_of(value, option, function, clock=60.0, **keys):
    return cell("sliding", value, function.__name__, option, function, clock, **keys)


def flat_slides():
    """Blocks on flat floors: friction, meshes, directions, forces."""
    found = []
    for mu in (0.0, 0.1, 0.3, 0.5, 0.9):
        for name, bodies in PAIRS.items():
            ways = HOWS_AND_TWO if name == "soft" else HOWS if name == "rigid" else {"": {}}
            for way, keys in ways.items():
                option = ", ".join(part for part in (name, way) if part)
                found.append(slide_of(f"friction {mu:g}", option, sliding.flat, friction=mu, **bodies, **keys))
    for cells in (8, 10, 12):
        for name, of_floor in (("coarse", cells // 2), ("unlike", cells - 1), ("alike", cells), ("fine", cells + cells // 3)):
            aside = 0.0 if name == "alike" else 0.0003
            found.append(slide_of(f"{cells} cells", f"{name} floor", sliding.flat, cells=cells, floor_cells=of_floor, aside=aside))
    for yaw in (5, 30, 45):
        found += [slide_of(f"yaw {yaw}", name, sliding.flat, yaw=yaw, **PAIRS[name]) for name in ("soft", "rigid")]
    for part in (1e-6, 1e-4, 1e-3):
        found.append(slide_of(f"gap {part:g}", "", sliding.flat, gap=part * SIZE / 8))
    for mu in (0.1, 0.9):
        found += [slide_of("pulled", f"friction {mu:g}", sliding.flat, friction=mu, pull=1.1 * mu * sliding.GRAVITY),
                  slide_of("pushed", f"friction {mu:g}", sliding.flat, friction=mu, push=1.1 * mu * sliding.GRAVITY)]
    for mu in (0.0, 0.5):
        found += [slide_of("floor moves", f"{name}, friction {mu:g}", sliding.flat, friction=mu, floor_moves=True, **PAIRS[name])
                  for name in ("soft", "rigid")]
        found += [slide_of(f"floor with a joint, {drop:g} lower", f"friction {mu:g}", sliding.flat, friction=mu, joint=drop)
                  for drop in (0.0, 1e-6)]
        found.append(slide_of("along a wall", f"friction {mu:g}", sliding.flat, friction=mu, wall=True))
    return found


def extreme_slides():
    """Fast, thin, of unlike stiffness, pressed hard."""
    found = []
    for part in (0.03, 0.1, 0.3):
        found += [slide_of(f"{part:g} c", f"friction {mu:g}", sliding.flat, friction=mu, speed=part * SOUND) for mu in (0.0, 0.5)]
    for part in (0.1, 0.02):
        for mu in (0.0, 0.5):
            found += [slide_of(f"thin {part:g}", f"block, friction {mu:g}", sliding.flat, friction=mu, high=part * SIZE),
                      slide_of(f"thin {part:g}", f"floor, friction {mu:g}", sliding.flat, friction=mu, floor_high=part * SIZE)]
    for ratio in (0.01, 0.1, 10.0, 100.0):
        of = {"block_of": material(young=ratio * YOUNG)} if ratio < 1 else {"floor_of": material(young=YOUNG / ratio)}
        found += [slide_of(f"stiffness {ratio:g}", f"friction {mu:g}", sliding.flat, friction=mu, **of) for mu in (0.0, 0.5)]
    for load in (0.01, 0.05):
        for mu in (0.1, 0.5, 0.9):
            found.append(slide_of(f"pressed {load:g}", f"friction {mu:g}", sliding.dragged, friction=mu, load=load))
    found += [slide_of("pressed 0.01", f"soft {soft}", sliding.dragged, soft=soft) for soft in ("block", "floor")]
    found.append(slide_of("pressed 0.01", "one pass", sliding.dragged, how="one pass"))
    return found


def plate_slides():
    """Plates on solids, solids on plates, plates on plates."""
    return [slide_of(f"{upper} on {lower}", f"friction {mu:g}", sliding.plates, friction=mu, upper=upper, lower=lower)
            for upper, lower in (("plate", "solid"), ("solid", "plate"), ("plate", "plate")) for mu in (0.0, 0.3, 0.9)]


def curved_slides():
    """Grooves, bores and dishes."""
    found = [slide_of(f"groove {2 * half}", f"friction {mu:g}", sliding.groove, friction=mu, half_angle=half)
             for half in (30, 45, 60) for mu in (0.0, 0.3)]
    found.append(slide_of("groove 90", "rigid", sliding.groove, rigid="block floor"))
    found += [slide_of("bore", f"{name}, friction {mu:g}", sliding.plug, friction=mu, **PAIRS[name])
              for name in ("soft", "rigid") for mu in (0.0, 0.3, 0.9)]
    found += [slide_of("bore", f"clearance {part:g}", sliding.plug, clearance=part, lies=False, rigid="block floor")
              for part in (0.005, 0.006, 0.02)]  # facets take half a hundredth of it
    found += [slide_of("spins in a bore", name, sliding.spun, **PAIRS[name]) for name in ("soft", "rigid")]
    found += [slide_of("dish", name, sliding.ball, **PAIRS[name]) for name in ("soft", "rigid")]
    return found


def corners_that_slide():
    """A cube that strikes askew with a corner ahead."""
    found = [slide_of(f"corner, {cells} cells", f"friction {mu:g}", sliding.corner, cells=cells, friction=mu)
             for cells in (8, 9, 10, 12) for mu in (0.2, 0.3, 0.9)]
    found += [slide_of("corner, 9 cells", name, sliding.corner, cells=9, **keys)
              for name, keys in (("one pass", {"how": "one pass"}), ("two passes", {"how": "two passes"}), ("penalty", {"how": "penalty"}))]
    return found


AXES = {"time step": time_step, "penalty": penalty, "stiffness ratio": stiffness, "density ratio": density, "mesh ratio": mesh_ratio,
        "aspect ratio": aspect, "Poisson": poisson, "speed": speed, "thickness": thickness, "friction": friction, "gap": gap,
        "ridge": ridges, "valley": valleys, "shapes": shapes, "ties": ties, "scale": scale, "shift": shift, "distance": distance,
        "long": long_runs, "random": at_random, "automatic": automatic, "sliding": sliding_bodies}


def cells(axis=None):
    """All cells, or those of one axis."""
    if axis is not None and axis not in AXES:
        raise KeyError(f"no axis '{axis}'; there are {', '.join(AXES)}")
    return [one for name, make in AXES.items() if axis in (None, name) for one in make()]
