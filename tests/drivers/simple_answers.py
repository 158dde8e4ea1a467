"""Small scenes whose answer mechanics gives at once, each for a part of contact or of rigid bodies that no case of verification/ needs.

    python3 tests/drivers/simple_answers.py DRIVERS                 DRIVERS: the folder with the programs
    python3 tests/drivers/simple_answers.py DRIVERS arm rod         scenes of these names alone

A scene is a function that returns a dict, as in right_runs.py, and a row of SCENES with its answers, as in known_answers.py. A run must
reach its end and print nothing but what the row allows. Each run takes a tenth of a second.
"""
import sys
import unittest
from math import cos, radians, sin, sqrt
from pathlib import Path

import known_answers
from known_answers import Answer, Scene, automatic, fixed, material, momenta, plate, thrown
from right_runs import DOWN, G, Run, box, lengths

DENSITY = 1000.0  # [kg/m3] that of material() and of box()


# ------------------------------------------------------------------------------------------------ parts of scenes and of answers

def declared(apexes, base, **more):
    return [{"name": "touch", "apexes": apexes, "base": base, **more}]


def rod(name, along, radius, half, centre):
    """A rigid rod with its exact shape, of length 2 `half` [m]; `along` is 'x', 'y', or 'xz' for 45 degrees between x and z."""
    mesh = {"kind": "cylinder", "radius": f"{radius!r} m", "length": f"{2 * half!r} m", "turn": "full", "cells_core": 1, "cells_ring": 1,
            "cells_along": 4}
    axis, angle = {"x": ([0, 1, 0], 90), "y": ([1, 0, 0], -90), "xz": ([0, 1, 0], 45)}[along]
    direction = {"x": (1, 0, 0), "y": (0, 1, 0), "xz": (sqrt(0.5), 0, sqrt(0.5))}[along]
    return {"name": name, "mesh": mesh, "material": material(), "rigid": True, "rotate": {"axis": axis, "angle": f"{angle} deg"},
            "move": lengths(at - half * way for at, way in zip(centre, direction))}


def probes(quantity, body, axes="xyz"):
    """Components of a vector of a body, named by its first letter and the axis."""
    return [{"name": f"{quantity[0]}{axis}", "quantity": quantity, "of": body, "component": axis} for axis in axes]


def last(probe):
    return lambda run: run.result(f"{probe}_last")


def impulse_of_pair(run):
    """That of the one pair under 'touched', along z. [N s]"""
    pair, = run.summary["touched"]
    return pair["impulse"]["value"][2]


def pairs_that_touched(run):
    return len(run.summary["touched"])


def no_overlap(limit, reason, of="touch_deepest"):
    return known_answers.deepest(limit, reason, of)


def keeps_energy(within, reason):
    return Answer("kinetic energy over that of the start", lambda run: run.ledger("kinetic") / run.ledger("initial_kinetic"), 1, within,
                  reason)


# ------------------------------------------------------------------------------------------------ an arm that turns

ARM = {"half": 0.1, "side": 0.02, "spin": 20.0, "reach": 0.08, "ball": 0.002, "radius": 0.008}  # [m, rad/s, kg] `ball`: its mass


def arm():
    """A rigid bar turns about its middle and strikes a ball at rest with its side, the base of the contact: after a turn of 40 degrees."""
    half, side, radius, angle = ARM["half"], ARM["side"], ARM["radius"], radians(40)
    bar = box("bar", (-half, -side / 2, -side / 2), (half, side / 2, side / 2), (8, 1, 1), rigid=True)
    off = side / 2 + radius  # the middle of the ball, from the axis of the bar as they meet
    mesh = {"kind": "sphere", "radius": f"{radius!r} m", "turn": "full", "cells_core": 1, "cells_ring": 1}
    at = (ARM["reach"] * cos(angle) - off * sin(angle), ARM["reach"] * sin(angle) + off * cos(angle), 0)
    ball = {"name": "ball", "mesh": mesh, "material": material(), "rigid": True, "move": lengths(at),
            "mass_properties": {"mass": f"{ARM['ball']!r} kg"}}
    return {"bodies": [bar, ball], "contacts": declared("ball.skin", "bar.y_high"), "time": {"end": "60 ms"},
            "initial": [thrown("bar", (0, 0, 0), (0, 0, ARM["spin"]))], "probes": momenta("bar", "ball")
            + [{"name": "spin", "quantity": "angular_velocity", "of": "bar", "component": "z"}]}


def blow_of_arm():
    """The impulse of two elastic bodies without friction, J = 2 w r / (1/m + 1/M + r^2/I), and I. [N s, kg m2]"""
    mass = DENSITY * 2 * ARM["half"] * ARM["side"]**2
    inertia = mass * ((2 * ARM["half"])**2 + ARM["side"]**2) / 12
    return 2 * ARM["spin"] * ARM["reach"] / (1 / ARM["ball"] + 1 / mass + ARM["reach"]**2 / inertia), inertia


def momentum_of_ball(run):
    return sqrt(sum(run.result(f"ball_{axis}_last")**2 for axis in "xyz"))


# ------------------------------------------------------------------------------------------------ contact from the start

def meets(rigid):
    """A cube touches a free slab at the start and moves into it."""
    slab = box("slab", (-0.1, -0.1, -0.1), (0.1, 0.1, 0), (2, 2, 1), rigid=rigid)
    cube = box("cube", (-0.05, -0.05, 0), (0.05, 0.05, 0.1), (1, 1, 1), rigid=rigid)
    return {"bodies": [slab, cube], "contacts": declared("cube.z_low", "slab.z_high"), "initial": [thrown("cube", (0, 0, -1))],
            "time": {"end": "5 ms"},
            "probes": momenta("slab", "cube") + [{"name": "impulse", "quantity": "impulse", "of": "touch", "component": "z"}]}


def of_first_touch(measure):
    """An impulse on the cube over the change of its momentum, which was -1 kg m/s."""
    return lambda run: measure(run) / (run.result("cube_z_last") + 1)


IMPULSES = (
    Answer("the probe over the change of momentum", of_first_touch(last("impulse")), 1, 1e-9, "nothing else acts on the cube: round-off"),
    Answer("that under 'touched' over it", of_first_touch(impulse_of_pair), 1, 1e-9, "the same"),
    Answer("first touch [s]", lambda run: run.result("touch_first_touch"), 0, 0, "they touch at the start"))


def bounces(overlap, contact):
    """An elastic block bounces off a slab, of which it starts `overlap` [m] deep inside."""
    slab = box("slab", (-0.1, -0.1, -0.1), (0.1, 0.1, 0), (2, 2, 1))
    block = box("block", (-0.05, -0.05, 0), (0.05, 0.05, 0.1), (2, 2, 1))
    block["move"] = lengths((0, 0, -overlap))
    contacts = automatic(0.0) if contact == "automatic" else declared("block.z_low", "slab.z_high")
    contacts[0]["initial_penetration"] = "accept"
    return {"bodies": [slab, block], "contacts": contacts, "planes": [fixed("slab.z_low")], "initial": [thrown("block", (0, 0, -1))],
            "probes": momenta("block"), "time": {"end": "20 ms"}}


def over_that_without_overlap(contact):
    """The momentum of the block over that of one which touches at the start."""
    return lambda run: run.result("block_z_last") / Run(bounces(0, contact)).result("block_z_last")


def of_overlap(contact):
    return (Answer("momentum over that of a block that only touches", over_that_without_overlap(contact), 1, 0.01,
                   "an accepted overlap makes no force; on the coarse mesh the end of contact shifts a little with it, 3e-3"),
            no_overlap(4e-4, "a fifth of the accepted overlap, which is no penetration; the blow leaves 1.1e-4 m"))


def falls_on_light():
    """A cube strikes the nodes of a slab that has a hundredth of its density, so that the solver needs many iterations."""
    cube = box("cube", (-0.0039, -0.0043, 0.0002), (0.0061, 0.0057, 0.0102), (2, 2, 2), "1 MPa")
    slab = box("slab", (-0.012, -0.012, -0.01), (0.012, 0.012, 0), (3, 3, 1), "1 MPa")
    slab["material"]["density"] = f"{DENSITY / 100!r} kg/m^3"
    return {"bodies": [cube, slab], "contacts": declared("cube.z_low", "slab.z_high"), "planes": [fixed("slab.z_low")],
            "initial": [thrown("cube", (0, 0, -1.5))], "probes": momenta("cube"), "time": {"end": "1.2 ms"}}


# ------------------------------------------------------------------------------------------------ friction of two bodies on one

def corner():
    """A rigid block slides along a floor and a wall, which presses it five times as much as its weight."""
    wall = box("wall", (0, -0.1, -0.02), (0.02, 0.3, 0.1), (1, 4, 1), rigid=True)
    floor = box("floor", (-0.2, -0.1, -0.02), (0, 0.3, 0), (2, 4, 1), rigid=True)
    block = box("block", (-0.05, 0, 0), (0, 0.05, 0.02), (2, 2, 1), rigid=True)
    pressure = 5 * DENSITY * 0.05 * G  # [Pa] on the side of the block
    return {"bodies": [wall, floor, block], "contacts": automatic(0.3), "planes": [fixed("wall", "floor")], "gravity": DOWN,
            "loads": [{"name": "push", "kind": "pressure", "surface": "block.x_low", "value": f"{pressure!r}", "unit": "Pa"}],
            "initial": [thrown("block", (0, 2, 0))], "time": {"end": "20 ms"},
            "probes": [{"name": f"{body}_{axis}", "quantity": "impulse", "of": "touch", "between": ["block", body], "component": axis}
                       for body in ("floor", "wall") for axis in "xyz"]}


WEIGHT = DENSITY * 0.05 * 0.05 * 0.02 * G  # [N] of the block


def sheared():
    """A block strikes a free slab at a slant; friction by penalty holds it, so its springs are sheared as it leaves."""
    slab = box("slab", (-0.1, -0.1, -0.1), (0.1, 0.1, 0), (4, 4, 1))
    block = box("block", (-0.05, -0.05, 0.001), (0.05, 0.05, 0.101), (2, 2, 1))
    return {"bodies": [slab, block], "contacts": declared("block.z_low", "slab.z_high", method="penalty", friction=10),
            "initial": [thrown("block", (2, 0, -1))], "probes": momenta("slab", "block"), "time": {"end": "30 ms"}}


def account(name):
    return lambda run: run.summary["ledger"]["accounts"]["touch"][name]["value"]


# ------------------------------------------------------------------------------------------------ round shapes

RADIUS, GAP = 0.005, 0.002  # [m] of rods that cross, and between them


def crossed(first, second, at):
    """A rod of half length `first` along x flies down past another one along y, of half length `second`, at y = `at`. [m]"""
    one, two = rod("one", "x", RADIUS, first, (0, at, 2 * RADIUS + GAP)), rod("two", "y", RADIUS, second, (0, 0, 0))
    return {"bodies": [one, two], "contacts": automatic(0.0), "initial": [thrown("one", (0, 0, -1))],
            "probes": momenta("one", "two") + probes("velocity", "one", "z"), "time": {"end": "20 ms"}}


def passes_by(first, second, at):
    return Scene(f"past_{'shorter' if second < first else 'longer'}_rod", lambda: crossed(first, second, at), (
        Answer("velocity [m/s]", last("vz"), -1, 1e-12, "it passes beyond the end of the other rod: round-off"),
        Answer("pairs that touched", pairs_that_touched, 0, 0, "it passes beyond the end")))


def rebound(first, second, at):
    """The velocity of the first rod after an elastic blow on the second one at `at` from its middle, which turns that one. [m/s]"""
    mass, other = (DENSITY * chord_area() * 2 * half for half in (first, second))
    inertia = other * (second**2 / 3 + RADIUS**2 / 4)
    return 2 / mass / (1 / mass + 1 / other + at**2 / inertia) - 1


def chord_area():
    """Of the cross-section of a rod with 8 chords. [m2]"""
    return 4 * RADIUS**2 * sin(radians(45))


def strikes(first, second, at):
    return Scene(f"on_{'shorter' if second < first else 'longer'}_rod", lambda: crossed(first, second, at), (
        Answer("velocity [m/s]", last("vz"), rebound(first, second, at), 1e-3,
               "an elastic blow; the inertia is that of a cylinder, and the mesh has 8 chords"),
        Answer("pairs that touched", pairs_that_touched, 1, 0, "it falls on the other rod")))


def leans():
    """A slanted rod falls into the bore of a ring that is held, onto the upper rim there: the normal leads through its centre."""
    bore, radius, half = 0.015, 0.004, 0.02
    mesh = {"kind": "revolved", "radii": lengths((bore, 0.03)), "heights": lengths((-0.01, 0.0)), "filled": ["x"], "angle": "360 deg",
            "cells_along": [1], "cells_radial": [1], "cells_around": 12}
    ring = {"name": "ring", "mesh": mesh, "material": material(), "rigid": True}
    centre = (bore - radius * sqrt(0.5), 0, radius * sqrt(0.5) + 0.001)
    return {"bodies": [ring, rod("rod", "xz", radius, half, centre)], "contacts": automatic(0.0), "planes": [fixed("ring")],
            "initial": [thrown("rod", (0, 0, -1))], "probes": probes("velocity", "rod"), "time": {"end": "5 ms"}}


# ------------------------------------------------------------------------------------------------ rigid bodies that spin

def tumbles():
    """A rigid block that spins fast strikes a rigid floor that is held."""
    block = box("block", (-0.01, -0.02, -0.015), (0.01, 0.02, 0.015), (1, 1, 1), rigid=True)
    block.update(rotate={"axis": [0.3, 1, 0.2], "angle": "50 deg"}, move=lengths((0, 0, 0.03)))
    floor = box("floor", (-0.1, -0.1, -0.02), (0.1, 0.1, 0), (1, 1, 1), rigid=True)
    return {"bodies": [floor, block], "contacts": automatic(0.0), "planes": [fixed("floor")],
            "initial": [thrown("block", (0, 0, -1), (200, 60, 40), (0, 0, 0.03))], "probes": momenta("block"), "time": {"end": "20 ms"}}


def rims():
    """Two rigid sheets, one of which spins and strikes the rim of the other one with its rim, near a corner."""
    mesh = {"kind": "sheet", "length": "20 mm", "width": "20 mm", "cells_along": 1, "cells_across": 1, "map": ["x-0.01", "y-0.01", "z"]}
    at = (0.0044, 0.0093, 0.035)
    one = plate("one", mesh, 0.001, material(), rigid=True, rotate={"axis": [-0.82, 0.9, -0.7], "angle": "133 deg"})
    two = plate("two", mesh, 0.001, material(), rigid=True, rotate={"axis": [0.68, 0.49, -0.4], "angle": "63 deg"}, move=lengths(at))
    return {"bodies": [one, two], "contacts": automatic(0.0), "initial": [thrown("two", (0, 0, -3), (33, 8, -22), at)],
            "probes": momenta("one", "two"), "time": {"end": "20 ms"}}


# ------------------------------------------------------------------------------------------------ a tie that slides, and a patch

SLIDER, SPEED, FALLS = (-0.004, -0.002), 10.0, 0.01  # [m] along x: the floor ends at 0; [m/s]; [s] end of the run


def slides():
    """A small block that a tie lets slide along a floor leaves it at its border, under gravity."""
    floor = box("floor", (-0.05, -0.02, -0.01), (0, 0.02, 0), (5, 2, 1), "100 MPa")
    slider = box("slider", (SLIDER[0], -0.005, 0), (SLIDER[1], 0.005, 0.002), (1, 2, 1), "100 MPa")
    return {"bodies": [floor, slider], "planes": [fixed("floor.z_low", "floor.z_high")], "gravity": DOWN, "time": {"end": f"{FALLS} s"},
            "contacts": [{"name": "tie", "kind": "tied", "apexes": "slider.z_low", "base": "floor.z_high", "slides": True}],
            "initial": [thrown("slider", (SPEED, 0, 0))], "probes": momenta("slider") + probes("velocity", "slider", "xz")}


def fall():
    """Speed of a block that is free as its rear edge leaves the border, and half free since its front edge has left it. [m/s]"""
    front, rear = (-x / SPEED for x in reversed(SLIDER))
    return G * (FALLS - rear), G * (rear - front)


def patch():
    """A soft block without lateral strain lies on a rigid floor with like faces, shifted by 0.4 of them, and is pressed flat."""
    cell, shift = 0.1 / 3, 0.04 / 3
    soft = box("soft", (-0.05, -0.05, 0), (0.05, 0.05, 0.06), (3, 3, 2))
    soft["material"]["poisson"] = 0.0
    low, high = -0.05 - 2 * cell - shift, 0.05 + 2 * cell - shift
    floor = box("floor", (low, low, -0.04), (high, high, 0), (7, 7, 1), rigid=True)
    return {"bodies": [floor, soft], "contacts": automatic(0.0), "planes": [fixed("floor")],
            "loads": [{"name": "push", "kind": "pressure", "surface": "soft.z_high", "value": "1e4", "unit": "Pa"}],
            "probes": [{"name": "most", "quantity": "von_mises", "of": "soft", "take": "largest"}],
            "time": {"end": "0.2 s"}, "relaxation": {"residual": 1e-5, "after": "5 ms"}}


# ------------------------------------------------------------------------------------------------ answers

SCENES = (
    Scene("arm", arm, (
        Answer("momentum of the ball over the impulse", lambda run: momentum_of_ball(run) / blow_of_arm()[0], 1, 1e-3,
               "an elastic blow; in a step the bar turns by 1.2e-3"),
        Answer("spin of the bar [rad/s]", last("spin"), ARM["spin"] - blow_of_arm()[0] * ARM["reach"] / blow_of_arm()[1], 5e-3,
               "the same"))),
    Scene("meets", lambda: meets(False), IMPULSES, ("time integration: ",)),
    Scene("meets_rigid", lambda: meets(True), IMPULSES),
    Scene("bounces", lambda: bounces(0.002, "declared"), of_overlap("declared")),
    Scene("bounces_automatic", lambda: bounces(0.002, "automatic"), of_overlap("automatic")),
    Scene("light", falls_on_light, (
        Answer("created over the energy of the scene", account("created_relative"), 0, 1e-9,
               "an elastic contact that has opened again has returned its energy: round-off"),
        Answer("the cube came back", lambda run: run.result("cube_z_last") > 1e-3, True, 0, "at 1.5e-3 kg m/s at most"))),
    Scene("corner", corner, (
        Answer("drag of the floor over the weight", lambda run: -run.result("floor_y_last") / (WEIGHT * 0.02), 0.3, 0.003,
               "Coulomb's law, of all that presses; friction is absent in the first steps, 7e-4"),
        Answer("drag of the wall over its push", lambda run: -run.result("wall_y_last") / (5 * WEIGHT * 0.02), 0.3, 0.003, "the same"))),
    Scene("sheared", sheared, (
        Answer("created of the energy that passed", account("created_of_passed"), 0, 0.005, "'energy_gain_limit', of one impact"),)),
    passes_by(0.05, 0.01, 0.018),
    strikes(0.05, 0.01, 0.002),
    passes_by(0.02, 0.05, 0.058),
    strikes(0.02, 0.05, 0.035),
    Scene("rod", leans, (
        *(Answer(f"velocity along {axis} [m/s]", last(f"v{axis}"), right, 1e-3, "reflected at 45 degrees, without a spin")
          for axis, right in zip("xyz", (-1, 0, 0))),)),
    Scene("tumbles", tumbles, (
        no_overlap(1e-8, "rigid bodies that turn by 0.004 in a step do not penetrate: what iterations leave is 1e-10 m"),
        keeps_energy(2e-3, "an elastic blow: the error of steps is of the second order, 1e-3"))),
    Scene("rims", rims, (
        no_overlap(5e-5, "a twentieth of the thickness", "audit_deepest_overlap"),
        Answer("pairs that touched", pairs_that_touched, 1, 0, "the middle of one flies at the other one"),
        keeps_energy(2e-3, "an elastic blow: the error of steps, 4e-4"))),
    Scene("slides", slides, (
        Answer("velocity along z [m/s]", last("vz"), -fall()[0], fall()[1],
               "a free fall; while the front edge is past the border and the rear is not, gravity turns the block"),
        Answer("velocity along x [m/s]", last("vx"), SPEED, 1e-3, "nothing acts along the floor; edges leave it one by one"))),
    Scene("patch", patch, (
        Answer("largest stress over the pressure", lambda run: run.result("most_last") / 1e4, 1, 1e-4,
               "uniform whatever the faces below: what is left of the motion as it relaxes, 1e-5"),
        Answer("relaxed", lambda run: run.summary["ending"]["word"] == "relaxed", True, 0, "it comes to rest"))),
)


class Simple(known_answers.Known):
    pass


def main(words):
    if not words:
        sys.exit(__doc__)
    Run.drivers = Path(words.pop(0)).resolve()
    unknown = set(words) - {scene.name for scene in SCENES}
    if unknown:
        sys.exit(f"no such scene: {', '.join(sorted(unknown))}; there are {', '.join(scene.name for scene in SCENES)}")
    for scene in SCENES:
        if not words or scene.name in words:
            setattr(Simple, f"test_{scene.name}", lambda self, scene=scene: self.ends_right(scene))
    unittest.main(argv=[sys.argv[0], "-v"])


if __name__ == "__main__":
    main(sys.argv[1:])
