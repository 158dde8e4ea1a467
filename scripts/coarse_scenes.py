"""Scenes with coarse meshes at random, for scripts/coarse: bodies of 2 to 4 cells a side that strike each other, a wall or a plate.

A scene is drawn from a seed and its number alone; its family follows from the number. All numerics are the defaults of the program, all
meshes are made of counts of cells, so `refine` makes each of them finer. Durations come from mechanics: the time of approach, and then
some passages of a wave, or half a period of bending, or the time in which a plastic body stops.

Each scene has one main result, fixed by its family before anything was run, and further ones:

- speed: the momentum of the body `a` at the end over its mass and over the speed of impact, a vector
- spin: the angular velocity of `a` at the end, times its size over the speed of impact, a vector
- impulse: the largest change of the momentum of `a`, over that at the start
- peak force: the largest mean of the force on `a` over one passage of a wave through it
- deflection: the largest displacement of a point of a beam or plate, or how far a ball goes on after the first touch
- shortening: the length at the start minus that at the end
- plastic strain: the largest of any element at any time
- plastic energy: what all bodies have dissipated at the end
"""
import dataclasses
import math
import random

import numpy as np

SOLIDS = ("flat", "corner", "edge", "sphere", "bar end", "beam hit", "cantilever", "taylor", "dent", "plastic corner", "skewed cells",
          "plate of solids hit", "thrown")
PLATES = ("strip hit", "plate hit by a ball", "tube crushed")
RESULTS = ("speed", "spin", "impulse", "peak force", "deflection", "shortening", "plastic strain", "plastic energy")
ELASTIC = {  # density [kg/m3], Young's modulus [Pa], Poisson's ratio [-]
    "steel": (7850, 210e9, 0.3), "aluminium": (2700, 70e9, 0.33), "lead": (11340, 16e9, 0.42), "polymer": (1200, 3e9, 0.38),
    "foam": (500, 500e6, 0.2), "rubber": (1000, 1e6, 0.45)}
PLASTIC = {  # and the yield stress and the tangent modulus [Pa]
    "steel": (7850, 210e9, 0.3, 300e6, 1e9), "aluminium": (2700, 70e9, 0.33, 280e6, 0.7e9), "copper": (8930, 117e9, 0.35, 400e6, 100e6),
    "lead": (11340, 16e9, 0.42, 20e6, 80e6), "hardening steel": (7850, 210e9, 0.3, 250e6, 8e9)}
GAP = 0.03              # [-] between bodies at the start, over the size of the striker: a step is shorter, so the first row is before it
SMALL_SPIN = 0.05       # [-] a spin below is compared with this
NEGLIGIBLE = {"impulse": 0, "peak force": 0, "deflection": 0, "shortening": 0, "plastic strain": 1e-4, "plastic energy": 0}


@dataclasses.dataclass
class Scene:
    """One scene, in SI units.

    main      name of the main result
    speed     of impact
    own       speed of the body `a` at the start
    size      of the body `a`
    transit   of a wave through it [s]
    axes      in which the momentum of `a` counts: a quarter of a body has only one
    approach  way of `a` before the first touch, which is no deflection [m]
    length    that the probe `length` has at the start [m]
    """
    family: str
    case: dict
    main: str
    speed: float = 0.0
    own: float = 0.0
    size: float = 0.0
    transit: float = 0.0
    axes: str = "xyz"
    approach: float = 0.0
    length: float = 0.0
    seed: int = 0
    number: int = 0


@dataclasses.dataclass(frozen=True)
class Stuff:
    density: float
    young: float
    poisson: float
    yields: float = 0.0
    tangent: float = 0.0

    def wave(self):
        """Speed of waves in a bar [m/s]."""
        return math.sqrt(self.young / self.density)

    def entry(self):
        found = {"kind": "elastic", "density": f"{self.density:g} kg/m^3", "young": f"{self.young:g} Pa", "poisson": self.poisson}
        return {**found, "kind": "j2_bilinear", "yield": f"{self.yields:g} Pa", "tangent": f"{self.tangent:g} Pa"} if self.yields else found


STEEL = Stuff(*ELASTIC["steel"])


# ------------------------------------------------------------------------------------------------
# Words of a case

def metres(values):
    return [f"{value:.9g} m" for value in values]


def seconds(value):
    return f"{value:.6g} s"


def block(name, sides, cells, stuff, move=(0, 0, 0), turned=None, lean=(0, 0), **more):
    """A box about the origin before it is turned and moved. `lean` shifts its inner layers along x and y, its faces stay plane."""
    mesh = {"kind": "box", "low": metres(-s / 2 for s in sides), "high": metres(s / 2 for s in sides), "cells": list(cells)}
    if any(lean):
        mesh["map"] = [f"{c} + {shift * side:.6g}*(z/{sides[2]:.6g})*(1 - 4*({c}/{side:.6g})^2)"
                       for c, side, shift in zip("xy", sides, lean)] + ["z"]
    found = {"name": name, "mesh": mesh, "material": stuff.entry(), **more}
    if turned:
        found["rotate"] = {"axis": [round(float(a), 9) for a in turned[0]], "angle": f"{turned[1]:.9g} rad"}
    found["move"] = metres(move)
    return found


def rotation(axis, angle):
    """The matrix of a rotation."""
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def reach(sides, turned, direction):
    """How far a box about the origin reaches in a direction once it is turned.

    >>> round(reach((1, 1, 1), ((1, -1, 0), math.atan(math.sqrt(2))), (0, 0, -1)), 6)
    0.866025
    """
    matrix = rotation(*turned) if turned else np.eye(3)
    return float(np.abs(np.asarray(direction) @ matrix) @ np.asarray(sides) / 2)


def probes_of_striker(axes="xyz", spins=True):
    found = [{"name": f"momentum_{c}", "quantity": "momentum", "of": "a", "component": c} for c in axes]
    return found + [{"name": f"spin_{c}", "quantity": "angular_velocity", "of": "a", "component": c} for c in "xyz" if spins]


def probes_of_flow(*bodies):
    return [{"name": f"plastic_strain_{body}", "quantity": "plastic_strain", "of": body, "take": "largest"} for body in bodies]


def contact(friction):
    return [{"name": "contact", "kind": "automatic", "friction": friction}]


def initial(**velocities):
    return [{"body": body, "velocity": [v if isinstance(v, str) else f"{v:.9g}" for v in value], "unit": "m/s"}
            for body, value in velocities.items()]


# ------------------------------------------------------------------------------------------------
# What is drawn

def log_uniform(rng, low, high):
    return low * (high / low) ** rng.random()


def elastic(rng):
    return Stuff(*ELASTIC[rng.choice(list(ELASTIC))])


def plastic(rng):
    return Stuff(*PLASTIC[rng.choice(list(PLASTIC))])


def any_stuff(rng, share_plastic=0.3):
    return plastic(rng) if rng.random() < share_plastic else elastic(rng)


def metal(rng):
    """Elastic or plastic, for plates that a ball of steel strikes."""
    return plastic(rng) if rng.random() < 0.5 else Stuff(*ELASTIC[rng.choice(["steel", "aluminium", "polymer"])])


def beside(rng, stuff, maker=elastic):
    """Stuff of another body, whose waves are at most four times as fast or as slow: steps are those of the stiffer body."""
    while True:
        other = maker(rng)
        if stuff.wave() / 4 <= other.wave() <= 4 * stuff.wave():
            return other


def bearable(speed, stuff, other):
    """A speed of impact, or the largest by which an elastic body strains by some hundredths where a heavier one strikes. [m/s]"""
    return min(speed, 0.03 * other.wave() * math.sqrt(min(1, other.density / stuff.density)))


def friction(rng):
    return rng.choice([0.0, 0.0, 0.2, 0.5])


def sides_of(rng, size, spread=1.6):
    return tuple(size * log_uniform(rng, 1 / spread, spread) for _ in range(3))


def cells_of(rng, low=2, high=4):
    return tuple(rng.randint(low, high) for _ in range(3))


def speed_of(rng, stuff, low=1e-3, high=3e-2, most=8.0):
    """Of waves a part; of plastic bodies times the speed at which a plane wave begins to flow. [m/s]"""
    if stuff.yields:
        return log_uniform(rng, 0.5, most) * stuff.yields / (stuff.density * stuff.wave())
    return log_uniform(rng, low, high) * stuff.wave()


def pointed_time(sides, stuff, speed, other):
    """How long a corner or an edge is pressed and comes back: its force is E x^2 of the softer body, less where the striker flows. [s]"""
    energy, young = stuff.density * math.prod(sides) * speed**2 / 2, min(stuff.young, other.young)
    depth = (energy / min(young / 3, 2.6 * stuff.yields if stuff.yields else math.inf)) ** (1 / 3)
    return 4 * depth / speed


def strike(rng, stuff, sides, cells, turned, held_for, lean=(0, 0), soft_target=True, main="speed", target=None):
    """A box falls on a wall, or on a block that is held or free, straight or askew.

    held_for     [s] how long they touch, a function of the speed and of what the other body is of
    soft_target  whether the other body may be of the same stuff or of any that is elastic; else it is of steel
    """
    target, like = target or rng.choice(["wall", "held", "free"]), rng.random() < 0.5
    other = stuff if target == "wall" or soft_target and like else beside(rng, stuff) if soft_target else STEEL
    size, speed, mu = max(sides), speed_of(rng, stuff), friction(rng)
    speed = bearable(speed, stuff, other) if target != "wall" else speed
    aside = rng.choice([0, 0, 0.3]) * speed * rng.random()
    at = (rng.uniform(-0.2, 0.2) * size, rng.uniform(-0.2, 0.2) * size, reach(sides, turned, (0, 0, -1)) + GAP * size)
    bodies, planes = [block("a", sides, cells, stuff, at, turned, lean)], []
    flows = ["a"] if stuff.yields else []
    more, wave = {"planes": planes}, min(stuff.wave(), other.wave())
    if target == "wall":
        planes.append({"name": "wall", "kind": "rigid", "surface": "a.skin", "point": metres((0, 0, 0)), "normal": [0, 0, 1],
                       "friction": mu})
    else:
        base = tuple(size * rng.uniform(low, high) for low, high in ((1, 2.5), (1, 2.5), (0.6, 1.5)))
        bodies.append(block("b", base, cells_of(rng), other, (0, 0, -base[2] / 2), None, lean))
        flows += ["b"] if other.yields else []
        more["contacts"] = contact(mu)
        if target == "held":
            planes.append({"name": "hold", "kind": "fixed", "nodes": ["b.z_low"]})
    if not planes:
        del more["planes"]
    end = GAP * size / speed + held_for(speed, other) + 12 * size / wave
    case = {"bodies": bodies, **more, "initial": initial(a=(aside, 0, -speed)), "probes": probes_of_striker() + probes_of_flow(*flows),
            "time": {"end": seconds(end)}}
    return Scene("", case, main, speed, math.hypot(speed, aside), size, size / stuff.wave())


def flat(rng, lean=(0, 0)):
    stuff, sides = any_stuff(rng), sides_of(rng, 0.05)

    def held_for(speed, _):  # a plastic block stops under its yield stress
        return 3 * stuff.density * sides[2] * speed / stuff.yields if stuff.yields else 0
    return strike(rng, stuff, sides, cells_of(rng), None, held_for, lean)


def corner(rng, lean=(0, 0), stuff=None, soft_target=True, target=None):
    stuff, sides = stuff or elastic(rng), sides_of(rng, 0.05, 1.25)
    turned = ((1, -1 + rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3)), math.atan(math.sqrt(2)) + rng.uniform(-0.25, 0.25))
    return strike(rng, stuff, sides, cells_of(rng), turned, lambda speed, other: pointed_time(sides, stuff, speed, other), lean,
                  soft_target, "speed", target)


def edge(rng, lean=(0, 0)):
    stuff, sides = any_stuff(rng), sides_of(rng, 0.05, 1.4)
    turned = ((rng.choice([0, 0, 0.1]) * rng.random(), 1, 0), math.pi / 4 + rng.uniform(-0.35, 0.35))
    return strike(rng, stuff, sides, cells_of(rng), turned, lambda speed, other: 0.7 * pointed_time(sides, stuff, speed, other), lean)


def plastic_corner(rng):
    return corner(rng, (0, 0), plastic(rng), False, rng.choice(["wall", "held"]))


def quarter_ball(name, radius, core, ring, stuff, move):
    mesh = {"kind": "sphere", "radius": f"{radius:.9g} m", "turn": "quarter", "cells_core": core, "cells_ring": ring}
    return {"name": name, "mesh": mesh, "material": stuff.entry(), "move": metres(move)}


def rigid_ball(name, radius, move):
    """A rigid ball of steel with its exact shape and mass, so that its mesh does not matter."""
    return {"name": name, "rigid": True, "mesh": {"kind": "sphere", "radius": f"{radius:.9g} m", "turn": "full", "cells_core": 1,
                                                  "cells_ring": 1},
            "material": STEEL.entry(), "mass_properties": {"mass": f"{mass_of_ball(radius):.9g} kg"}, "move": metres(move)}


def mass_of_ball(radius, stuff=STEEL):
    return stuff.density * 4 / 3 * math.pi * radius**3


def symmetry(*bodies):
    """The two planes of a quarter; each body gives its node sets on them."""
    return [{"name": f"plane_{c}", "kind": "symmetry", "nodes": [body[axis] for body in bodies], "normal": [1 - axis, axis, 0]}
            for axis, c in enumerate("xy")]


def hertz_time(mass, radius, young, speed):
    """How long two spheres touch: Hertz's answer. [s]"""
    stiffness = 4 / 3 * young / 1.8 * math.sqrt(radius)
    depth = (1.25 * mass * speed**2 / stiffness) ** 0.4
    return 2.94 * depth / speed


def sphere(rng):
    """A quarter of a ball falls on a wall, or on a quarter of a block that is held or free."""
    stuff, radius, target = any_stuff(rng), 0.02, rng.choice(["wall", "held", "free"])
    other = stuff if target == "wall" or rng.random() < 0.5 else beside(rng, stuff)
    speed, wave = bearable(speed_of(rng, stuff), stuff, other), min(stuff.wave(), other.wave())
    bodies = [quarter_ball("a", radius, rng.choice([2, 2, 3]), 2, stuff, (0, 0, radius * (1 + 2 * GAP)))]
    planes, flows = symmetry(("a.x_plane", "a.y_plane")), ["a"] if stuff.yields else []
    more = {}
    if target == "wall":
        planes.append({"name": "wall", "kind": "rigid", "surface": "a.surface", "point": metres((0, 0, 0)), "normal": [0, 0, 1]})
    else:
        width, height = radius * rng.uniform(1.2, 2.5), radius * rng.uniform(1, 2.5)
        place = (width / 2, width / 2, -height / 2)
        bodies.append(block("b", (width, width, height), cells_of(rng), other, place))
        planes = symmetry(("a.x_plane", "a.y_plane"), ("b.x_low", "b.y_low"))
        planes += [{"name": "hold", "kind": "fixed", "nodes": ["b.z_low"]}] if target == "held" else []
        flows += ["b"] if other.yields else []
        more["contacts"] = contact(0.0)
    mass = mass_of_ball(radius, stuff)
    touch = hertz_time(mass, radius, stuff.density * wave**2 if not stuff.yields else 100 * stuff.yields, speed)
    end = 2 * GAP * radius / speed + 2 * touch + 10 * radius / wave
    case = {"bodies": bodies, **more, "planes": planes, "initial": initial(a=(0, 0, -speed)),
            "probes": probes_of_striker("z", False) + probes_of_flow(*flows), "time": {"end": seconds(end)}}
    return Scene("", case, "speed", speed, speed, 2 * radius, 2 * radius / stuff.wave(), "z")


def bar_end(rng, lean=(0, 0)):
    """A bar strikes a wall or the end of another bar, which is held at its far end or free."""
    stuff, width, target = any_stuff(rng), 0.01, rng.choice(["wall", "held", "free"])
    length, along, speed, mu = width * rng.uniform(4, 10), rng.randint(4, 10), speed_of(rng, stuff, high=1e-2, most=3.0), friction(rng)
    bodies = [block("a", (width, width, length), (2, 2, along), stuff, (0, 0, length / 2 + GAP * length), None, lean)]
    time, planes, more, flows = length / stuff.wave(), [], {}, ["a"] if stuff.yields else []
    if target == "wall":
        planes.append({"name": "wall", "kind": "rigid", "surface": "a.z_low", "point": metres((0, 0, 0)), "normal": [0, 0, 1],
                       "friction": mu})
    else:
        other, other_width, other_length = beside(rng, stuff, any_stuff), width * rng.uniform(0.8, 1.4), width * rng.uniform(4, 10)
        bodies.append(block("b", (other_width, other_width, other_length), (2, 2, rng.randint(4, 8)), other, (0, 0, -other_length / 2),
                            None, lean))
        planes += [{"name": "hold", "kind": "fixed", "nodes": ["b.z_low"]}] if target == "held" else []
        time += other_length / other.wave()
        speed = bearable(speed, stuff, other)
        more["contacts"] = contact(mu)
        flows += ["b"] if other.yields else []
    more |= {"planes": planes} if planes else {}
    case = {"bodies": bodies, **more, "initial": initial(a=(0, 0, -speed)),
            "probes": probes_of_striker(spins=False) + probes_of_flow(*flows),
            "time": {"end": seconds(GAP * length / speed + 2.6 * time)}}
    return Scene("", case, "speed", speed, speed, length, length / stuff.wave())


def sagging(rng, bodies, planes, stuff, other, speed, end):
    """The case of a body `a` that strikes a beam or plate `b`, whose point `under` sags."""
    flows = [name for name, one in (("a", other), ("b", stuff)) if one.yields]
    return {"bodies": bodies, "contacts": contact(friction(rng)), **({"planes": planes} if planes else {}),
            "initial": initial(a=(0, 0, -speed)),
            "probes": [*probes_of_striker(), *probes_of_flow(*flows),
                       {"name": "deflection", "quantity": "displacement", "of": "b.under", "component": "z"}],
            "time": {"end": seconds(end)}}


def beam_hit(rng, lean=(0, 0)):
    """A cube strikes a beam that is clamped at one end, at both, or free. The time is half a period of the cube on the beam."""
    stuff, height, support = any_stuff(rng), 0.01, rng.choice(["one end", "both ends", "free"])
    length, width, side = height * rng.uniform(7, 12), height * rng.uniform(1, 2), height * rng.uniform(0.8, 1.6)
    other = stuff if rng.random() < 0.5 else beside(rng, stuff)
    inertia = width * height**3 / 12
    stiffness = {"one end": 3, "both ends": 192, "free": 48}[support] * stuff.young * inertia / length**3
    mass, of_beam = other.density * side**3, stuff.density * length * width * height
    half = math.pi * math.sqrt((mass + 0.3 * of_beam) / stiffness)
    if support == "free":
        half = min(half, math.pi / (22.4 / length**2 * math.sqrt(stuff.young * inertia / (stuff.density * width * height))) * 2)
    bend = rng.uniform(0.01, 0.06) * length  # roughly how far the beam is bent
    speed = min(bend * math.sqrt(stiffness / mass), 0.02 * min(stuff.wave(), other.wave()))
    if stuff.yields:  # so fast that a hinge turns by some hundredths
        moment = stuff.yields * width * height**2 / 4
        arm = length if support == "one end" else length / 4
        turning = rng.uniform(0.02, 0.15) * moment * (1 if support == "one end" else 4)
        speed = math.sqrt(2 * (turning + moment**2 / (2 * stiffness * arm**2)) / mass)
        half *= 1.5
    along = {"one end": rng.randint(4, 8), "both ends": rng.choice([4, 6, 8]), "free": rng.choice([4, 6, 8])}[support]
    at = 0.5 * length - 0.6 * side if support == "one end" else rng.choice([0, 0.15]) * length
    beam = block("b", (length, width, height), (along, 2, 2), stuff, (0, 0, -height / 2), None, lean)
    gap = GAP * side
    planes = []
    if support == "one end":
        planes.append({"name": "clamp", "kind": "fixed", "nodes": ["b.x_low"]})
    elif support == "both ends":
        planes.append({"name": "clamp", "kind": "fixed", "nodes": ["b.x_low", "b.x_high"]})
    beam["points"] = [{"name": "under", "near": metres((length / 2 if support == "one end" else 0, 0, -height))}]
    bodies = [block("a", (side,) * 3, (rng.randint(2, 3),) * 3, other, (at, 0, side / 2 + gap)), beam]
    case = sagging(rng, bodies, planes, stuff, other, speed, gap / speed + 1.2 * half)
    return Scene("", case, "speed", speed, speed, side, side / other.wave())


def cantilever(rng):
    """A clamped beam under a pressure that begins suddenly or grows; the time is three quarters of its first period."""
    stuff, height = any_stuff(rng, 0.25), 0.01
    length, width = height * rng.uniform(5, 12), height * rng.uniform(1, 2)
    inertia = width * height**3 / 12
    period = 2 * math.pi / 3.516 * length**2 * math.sqrt(stuff.density * width * height / (stuff.young * inertia))
    pressure = rng.uniform(0.003, 0.05) * 8 * stuff.young * inertia / (length**3 * width)
    if stuff.yields:
        pressure = rng.uniform(0.4, 0.6) * stuff.yields * height**2 / (3 * length**2)
    ramp = rng.choice([0, 0.3]) * period
    value = f"-{pressure:.6g}*min(1, t/{ramp:.6g})" if ramp else f"-{pressure:.6g}"
    cells = (rng.randint(3, 8), 2, rng.randint(2, 3))
    lean = (rng.choice([0, 0, 0.3]), 0)
    case = {"bodies": [block("a", (length, width, height), cells, stuff, (0, 0, 0), None, lean)],
            "planes": [{"name": "clamp", "kind": "fixed", "nodes": ["a.x_low"]}],
            "loads": [{"name": "press", "kind": "pressure", "surface": "a.z_low", "value": value, "unit": "Pa"}],
            "probes": [{"name": "deflection", "quantity": "displacement", "of": "a.x_high", "component": "z"},
                       *probes_of_flow(*(["a"] if stuff.yields else []))],
            "time": {"end": seconds(0.75 * period)}}
    return Scene("", case, "deflection", size=length, transit=length / stuff.wave())


def taylor(rng):
    """A plastic bar, a box or a quarter of a cylinder, strikes a wall."""
    stuff, width, part = plastic(rng), 0.01, rng.uniform(0.4, 1.1)
    length, round_bar = width * rng.uniform(2.5, 6), rng.random() < 0.5
    speed = part * math.sqrt(stuff.yields / stuff.density)
    gap, along = GAP * length, rng.randint(4, 10)
    wall = {"name": "wall", "kind": "rigid", "surface": "a.bottom" if round_bar else "a.z_low", "point": metres((0, 0, 0)),
            "normal": [0, 0, 1], "friction": rng.choice([0.0, 0.1])}
    if round_bar:
        bar = {"name": "a", "mesh": {"kind": "cylinder", "radius": f"{width / 2:.9g} m", "length": f"{length:.9g} m", "turn": "quarter",
                                     "cells_core": 2, "cells_ring": 2, "cells_along": along},
               "material": stuff.entry(), "move": metres((0, 0, gap))}
        planes = [*symmetry(("a.x_plane", "a.y_plane")), wall]
    else:
        bar, planes = block("a", (width, width, length), (rng.randint(2, 3),) * 2 + (along,), stuff, (0, 0, length / 2 + gap)), [wall]
    shortened = min(0.5 * part**2, 0.45) * length
    case = {"bodies": [bar], "planes": planes, "initial": initial(a=(0, 0, -speed)),
            "probes": [*probes_of_striker("z" if round_bar else "xyz", False), *probes_of_flow("a"),
                       {"name": "length", "quantity": "extent", "of": "a", "component": "z"}],
            "time": {"end": seconds(gap / speed + 2.6 * shortened / speed + 3 * length / stuff.wave())}}
    return Scene("", case, "shortening", speed, speed, length, length / stuff.wave(), "z" if round_bar else "xyz", 0.0, length)


def dent(rng):
    """A rigid ball falls on a plastic block that is held."""
    stuff, width = plastic(rng), 0.04
    sides = (width * rng.uniform(0.8, 1.3), width * rng.uniform(0.8, 1.3), width * rng.uniform(0.4, 1))
    radius = width * rng.uniform(0.25, 0.6)
    mass, depth, gap = mass_of_ball(radius), rng.uniform(0.02, 0.15) * radius, GAP * radius
    speed = math.sqrt(6 * math.pi * stuff.yields * radius * depth**2 / mass)
    ball = rigid_ball("a", radius, (rng.uniform(-0.15, 0.15) * width, rng.uniform(-0.15, 0.15) * width, radius + gap))
    case = {"bodies": [ball, block("b", sides, cells_of(rng), stuff, (0, 0, -sides[2] / 2))], "contacts": contact(friction(rng)),
            "planes": [{"name": "hold", "kind": "fixed", "nodes": ["b.z_low"]}], "initial": initial(a=(0, 0, -speed)),
            "probes": [*probes_of_striker(spins=False), *probes_of_flow("b"),
                       {"name": "deflection", "quantity": "displacement", "of": "a", "component": "z"}],
            "time": {"end": seconds(gap / speed + 3.5 * depth / speed)}}
    return Scene("", case, "deflection", speed, speed, 2 * radius, max(sides) / stuff.wave(), "xyz", gap)


def skewed(rng):
    """One of the other blows, with cells whose sides lean by 10 to 35 degrees."""
    lean = tuple(rng.choice([-1, 1]) * rng.uniform(0.15, 0.4) for _ in range(2))
    return rng.choice([flat, corner, edge, bar_end, beam_hit])(rng, lean)


def plate_of_solids(rng):
    """A cube strikes a plate of two layers of solids that is clamped around."""
    stuff, height = any_stuff(rng, 0.4), 0.01
    span, side = height * rng.uniform(8, 14), height * rng.uniform(1, 2.5)
    other = stuff if rng.random() < 0.5 else beside(rng, stuff)
    bending = stuff.young * height**3 / (12 * (1 - stuff.poisson**2))
    stiffness, mass = bending / (0.0056 * span**2), other.density * side**3
    half = math.pi * math.sqrt((mass + 0.2 * stuff.density * span**2 * height) / stiffness)
    speed = min(rng.uniform(0.05, 0.5) * height * math.sqrt(stiffness / mass), 0.02 * min(stuff.wave(), other.wave()))
    if stuff.yields:
        speed = math.sqrt(2 * rng.uniform(0.1, 1) * height * 12 * stuff.yields * height**2 / 4 / mass)
    gap, cells = GAP * side, tuple(rng.choice([4, 6]) for _ in range(2)) + (2,)
    turned = rng.choice([None, None, ((1, -1, 0), 0.3 * rng.random())])
    plate = block("b", (span, span, height), cells, stuff, (0, 0, -height / 2))
    plate["points"] = [{"name": "under", "near": metres((0, 0, -height))}]
    at = (rng.uniform(-0.1, 0.1) * span, rng.uniform(-0.1, 0.1) * span, reach((side,) * 3, turned, (0, 0, -1)) + gap)
    bodies = [block("a", (side,) * 3, (rng.randint(2, 3),) * 3, other, at, turned), plate]
    planes = [{"name": "rim", "kind": "fixed", "nodes": [f"b.{c}_{way}" for c in "xy" for way in ("low", "high")]}]
    case = sagging(rng, bodies, planes, stuff, other, speed, gap / speed + 1.2 * half)
    return Scene("", case, "deflection", speed, speed, side, side / other.wave())


def thrown(rng):
    """Two or three boxes that are turned at random and spin, one thrown at the others."""
    def direction():
        found = np.array([rng.gauss(0, 1) for _ in range(3)])
        return found / np.linalg.norm(found)

    def spinning(velocity, spin, centre):
        x, y, z = (f"({c} - ({float(p):.9g}))" for c, p in zip("xyz", centre))
        return [f"{v:.9g} + ({w[0]:.9g})*{r[0]} - ({w[1]:.9g})*{r[1]}" for v, w, r in
                zip(velocity, ((spin[1], spin[2]), (spin[2], spin[0]), (spin[0], spin[1])), ((z, y), (x, z), (y, x)))]
    towards, stuff = direction(), any_stuff(rng)
    speed = speed_of(rng, stuff, 4e-3, 4e-2)
    bodies, velocities, flows, ahead, sides, wave = [], {}, [], 0.0, (), stuff.wave()
    for number, name in enumerate("abc"[:rng.choice([2, 2, 3])]):
        own = stuff if number == 0 or rng.random() < 0.5 else beside(rng, stuff, any_stuff)
        mine, turned = sides_of(rng, 0.05, 1.5), (direction(), rng.uniform(0, math.pi))
        half = reach(mine, turned, towards)
        askew = np.cross(towards, direction()) * (0 if number == 0 else 0.3 * 0.05)
        centre = towards * (ahead + half) + askew
        ahead += 2 * half + 2e-3 * 0.05
        bodies.append(block(name, mine, cells_of(rng), own, centre, turned))
        spin = direction() * rng.uniform(0, 0.4) * speed / 0.05
        own_speed = speed * towards if number == 0 else -rng.choice([0, 0, 0.5]) * speed * towards
        velocities[name] = spinning(own_speed, spin, centre)
        flows += [name] if own.yields else []
        sides, wave = sides or mine, min(wave, own.wave())
    end = pointed_time(sides, stuff, speed, stuff) * 1.5 + 0.1 * 0.05 / speed + 15 * 0.05 / wave
    case = {"bodies": bodies, "contacts": contact(friction(rng)), "initial": initial(**velocities),
            "probes": probes_of_striker() + probes_of_flow(*flows), "time": {"end": seconds(end)}}
    return Scene("", case, "speed", speed, speed, max(sides), max(sides) / stuff.wave())


# ------------------------------------------------------------------------------------------------
# Plates

def strip_hit(rng):
    """A rigid ball strikes a strip of plates that is clamped at both ends."""
    stuff, length = metal(rng), 0.1
    width, thickness, radius = length * rng.uniform(0.15, 0.35), length / rng.uniform(30, 80), length * rng.uniform(0.06, 0.12)
    stiffness = 192 * stuff.young * width * thickness**3 / 12 / length**3
    mass, of_strip = mass_of_ball(radius), stuff.density * length * width * thickness
    bend = rng.uniform(0.3, 3) * thickness  # beyond a thickness membrane forces are stiffer
    stiffness *= 1 + (bend / thickness) ** 2
    speed = bend * math.sqrt(stiffness / mass)
    if stuff.yields:
        speed = min(speed, 6 * math.sqrt(stuff.yields * width * thickness**2 * bend / length / mass))
    half, gap = math.pi * math.sqrt((mass + 0.4 * of_strip) / stiffness), GAP * radius
    sheet = {"name": "b", "mesh": {"kind": "sheet", "length": f"{length:.9g} m", "width": f"{width:.9g} m",
                                   "cells_along": rng.choice([4, 6, 8]), "cells_across": 2},
             "material": stuff.entry(), "element": {"thickness": f"{thickness:.9g} m"}, "move": metres((-length / 2, -width / 2, 0)),
             "points": [{"name": "middle", "near": metres((0, 0, 0))}]}
    ball = rigid_ball("a", radius, (rng.choice([0, 0.1]) * length, 0, radius + thickness / 2 + gap))
    case = {"bodies": [ball, sheet], "contacts": contact(friction(rng)),
            "planes": [{"name": "clamp", "kind": "fixed", "nodes": ["b.x_low", "b.x_high"]}], "initial": initial(a=(0, 0, -speed)),
            "probes": [*probes_of_striker(spins=False),
                       {"name": "deflection", "quantity": "displacement", "of": "b.middle", "component": "z"}],
            "time": {"end": seconds(gap / speed + half)}}
    return Scene("", case, "deflection", speed, speed, 2 * radius, length / stuff.wave())


def plate_hit(rng):
    """A rigid ball strikes a round plate that is clamped at its rim."""
    stuff, radius = metal(rng), 0.05
    thickness, ball = radius / rng.uniform(15, 50), radius * rng.uniform(0.12, 0.25)
    stiffness = 16 * math.pi * stuff.young * thickness**3 / (12 * (1 - stuff.poisson**2)) / radius**2
    mass, of_plate = mass_of_ball(ball), stuff.density * math.pi * radius**2 * thickness
    bend = rng.uniform(0.1, 1.5) * thickness
    stiffness *= 1 + (bend / thickness) ** 2
    speed = bend * math.sqrt(stiffness / mass)
    half, gap = math.pi * math.sqrt((mass + 0.2 * of_plate) / stiffness), GAP * ball
    at = (rng.choice([0, 0.2]) * radius * rng.random(), 0, ball + thickness / 2 + gap)
    plate = {"name": "b", "mesh": {"kind": "disc", "radius": f"{radius:.9g} m", "turn": "full", "cells_core": 2,
                                   "cells_ring": rng.randint(2, 4)},
             "material": stuff.entry(), "element": {"thickness": f"{thickness:.9g} m"}}
    case = {"bodies": [rigid_ball("a", ball, at), plate], "contacts": contact(friction(rng)),
            "planes": [{"name": "rim", "kind": "fixed", "nodes": ["b.rim"]}], "initial": initial(a=(0, 0, -speed)),
            "probes": [*probes_of_striker(spins=False),
                       {"name": "deflection", "quantity": "displacement", "of": "b.centre", "component": "z"}],
            "time": {"end": seconds(gap / speed + 0.8 * half)}}
    return Scene("", case, "deflection", speed, speed, 2 * ball, radius / stuff.wave())


def tube_crushed(rng):
    """A rigid ram shortens a quarter of a plastic tube by some hundredths."""
    stuff, radius = plastic(rng), 0.02
    length, thickness = radius * rng.uniform(1.5, 3), radius / rng.uniform(10, 30)
    part = rng.uniform(0.02, 0.08)
    speed = rng.uniform(0.5, 2) * stuff.yields / (stuff.density * stuff.wave())
    energy = part * length * stuff.yields * math.pi / 2 * radius * thickness  # of a quarter
    wide, gap = 1.5 * radius, GAP * length
    mass = 2 * energy / speed**2

    def ram(name, low):
        return {"name": name, "rigid": True, "mesh": {"kind": "box", "low": metres((-0.2 * radius, -0.2 * radius, low)),
                                                      "high": metres((wide, wide, low + 0.25 * radius)), "cells": [1, 1, 1]},
                "material": STEEL.entry()}
    bodies = [{**ram("a", length + thickness / 2 + gap), "mass_properties": {"mass": f"{mass:.6g} kg"}},
              {"name": "b", "mesh": {"kind": "tube", "radius": f"{radius:.9g} m", "length": f"{length:.9g} m", "turn": "quarter",
                                     "cells_core": rng.randint(2, 3), "cells_along": rng.randint(4, 10)},
               "material": stuff.entry(), "element": {"thickness": f"{thickness:.9g} m"}},
              ram("c", -0.25 * radius - thickness / 2)]
    case = {"bodies": bodies, "contacts": contact(rng.choice([0.0, 0.2])),
            "planes": [*symmetry(("b.x_plane", "b.y_plane")), {"name": "ground", "kind": "fixed", "nodes": ["c"]},
                       {"name": "guide_x", "kind": "constrained", "nodes": ["a"], "normal": [1, 0, 0]},
                       {"name": "guide_y", "kind": "constrained", "nodes": ["a"], "normal": [0, 1, 0]}],
            "initial": initial(a=(0, 0, -speed)),
            "probes": [*probes_of_striker("z", False), {"name": "length", "quantity": "extent", "of": "b", "component": "z"}],
            "time": {"end": seconds(gap / speed + 2.5 * part * length / speed)}}
    return Scene("", case, "shortening", speed, speed, length, length / stuff.wave(), "z", 0.0, length)


MAKERS = {
    "flat": flat, "corner": corner, "edge": edge, "sphere": sphere, "bar end": bar_end, "beam hit": beam_hit, "cantilever": cantilever,
    "taylor": taylor, "dent": dent, "plastic corner": plastic_corner, "skewed cells": skewed, "plate of solids hit": plate_of_solids,
    "thrown": thrown, "strip hit": strip_hit, "plate hit by a ball": plate_hit, "tube crushed": tube_crushed}


def draw(seed, number, families=SOLIDS):
    """The scene of this number: the families take turns.

    >>> draw(1, 0) == draw(1, 0), draw(1, 0) == draw(2, 0), draw(1, 14).family
    (True, False, 'corner')
    """
    family = families[number % len(families)]
    found = MAKERS[family](random.Random(f"{seed} {family} {number}"))
    return dataclasses.replace(found, family=family, seed=seed, number=number)


# ------------------------------------------------------------------------------------------------
# What is measured

def measure(scene, columns, results):
    """{name of the result: number or vector} of a run, from the columns of its history and the numbers of its summary."""
    found, times = {}, np.asarray(columns["time"])
    if f"momentum_{scene.axes[0]}" in columns:
        momentum = np.array([columns[f"momentum_{c}"] for c in scene.axes])
        mass = np.linalg.norm(momentum[:, 0]) / scene.own
        found["speed"] = list(map(float, momentum[:, -1] / mass / scene.speed))
        found["impulse"] = float(np.max(np.linalg.norm(momentum - momentum[:, :1], axis=0)) / np.linalg.norm(momentum[:, 0]))
        found["peak force"] = peak_force(times, momentum, scene.transit)
    if "spin_x" in columns:
        found["spin"] = [float(columns[f"spin_{c}"][-1] * scene.size / scene.speed) for c in "xyz"]
    if "deflection_largest" in results:
        largest = max(abs(results["deflection_largest"]), abs(results["deflection_smallest"]))
        found["deflection"] = max(0.0, largest - scene.approach)
    if "length" in columns:
        found["shortening"] = scene.length - columns["length"][-1]
    strains = [value for name, value in results.items() if name.startswith("plastic_strain") and name.endswith("_largest")]
    if strains:
        found["plastic strain"] = max(strains)
        found["plastic energy"] = sum(columns[name][-1] for name in columns if name.startswith("energy_") and name.endswith("_plastic"))
    return found


def peak_force(times, momentum, window):
    """The largest mean of a force over a window of time, from the momentum that it changes. [N]"""
    later = np.minimum(times + window, times[-1])
    change = np.array([np.interp(later, times, row) - row for row in momentum])
    return float(np.max(np.linalg.norm(change, axis=0)) / min(window, times[-1]))


def change(name, coarse, fine):
    """How much a result changes from a coarse mesh to a finer one, over its value there; of a speed over that of impact.

    None where it has no value on one of them, or a negligible one on the finer.
    """
    if name not in coarse or name not in fine:
        return None
    one, other = np.atleast_1d(coarse[name]), np.atleast_1d(fine[name])
    differs, scale = float(np.linalg.norm(one - other)), float(np.linalg.norm(other))
    if name == "speed":
        return differs
    if name == "spin":
        return differs / max(scale, SMALL_SPIN)
    return differs / scale if scale > NEGLIGIBLE[name] else None
