"""Runs that are right and start from rest, or from round-off, reach their end without a message, with the right value; the same runs with
a defect stop, and a scene that is wrong is refused with the key that accepts it.

    python3 tests/drivers/right_runs.py DRIVERS                     DRIVERS: the folder with the programs
    python3 tests/drivers/right_runs.py DRIVERS Stacks

A scene is a dict, written as JSON, which is YAML, but for quantities, which have no quotation marks.
"""
import itertools
import json
import re
import subprocess
import sys
import tempfile
import unittest
from math import cos, radians, sin
from pathlib import Path

PATIENCE = 120  # [s] each run takes seconds at most
G = 9.81
DOWN = [f"{a} m/s^2" for a in (0, 0, -G)]


def lengths(values):
    return [f"{value!r} m" for value in values]


def box(name, low, high, cells, young="10 MPa", rigid=False):
    body = {"name": name, "mesh": {"kind": "box", "low": lengths(low), "high": lengths(high), "cells": list(cells)},
            "material": {"kind": "elastic", "density": "1000 kg/m^3", "young": young, "poisson": 0.3}}
    return {**body, "rigid": True} if rigid else body


def written(scene, folder):
    """The path of a case file in a folder that has a scene."""
    case = Path(folder) / "case.yaml"
    case.write_text(re.sub(r'"(-?[0-9.e+-]+ [a-zA-Z][^" ]*)"', r"\1", json.dumps(scene)), encoding="utf-8")
    return case


class Run:
    drivers = None  # folder of the programs, from the command line

    def __init__(self, scene, *values):
        with tempfile.TemporaryDirectory() as folder:
            case, out = written(scene, folder), Path(folder) / "out"
            words = [Run.drivers / "scene", case, "--out", out, "--quiet"]
            for value in values:
                words += ["--set", value]
            done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE)
            self.status, self.stderr = done.returncode, done.stderr
            summary = out / "summary.json"
            self.summary = json.loads(summary.read_text(encoding="utf-8")) if summary.is_file() else None

    def result(self, name):
        return self.summary["results"][name]["value"]

    def ledger(self, name):
        return self.summary["ledger"][name]["value"]

    def created(self):
        """The most that any source made or lost at the end, over the energy floor."""
        return max(abs(one["created"]["value"]) for one in self.summary["ledger"]["accounts"].values()) / self.ledger("energy_floor")


class Case(unittest.TestCase):
    def good(self, scene, ending="reached_end"):
        """A run without a message, but for that on the size of elements: some beds here are coarse beside what stands on them."""
        run = Run(scene)
        said = [line for line in run.stderr.splitlines() if ": hourglass energy reached " not in line]
        self.assertEqual((run.status, said), (0, []))
        self.assertEqual(run.summary["ending"]["word"], ending)
        return run


# ------------------------------------------------------------------------------------------------

def pressed_block(friction, on):
    """A block of 0.5 kg on a rigid plane, or on a bed by a declared or automatic contact."""
    scene = {"bodies": [box("b", (0, 0, 0), (0.1, 0.1, 0.05), (3, 3, 2))], "contacts": [], "planes": [], "gravity": DOWN,
             "probes": [{"name": "carried", "quantity": "force", "of": "ground", "component": "z"}],
             "time": {"end": "0.5 s"}, "relaxation": {"residual": 1e-4, "after": "0.02 s"}}
    if on == "plane":
        scene["planes"] = [{"name": "ground", "kind": "rigid", "surface": "b.z_low", "point": lengths((0, 0, 0)), "normal": [0, 0, 1],
                            "friction": friction}]
        return scene
    scene["bodies"].append(box("bed", (-0.05, -0.05, -0.05), (0.15, 0.15, 0), (4, 4, 2)))
    scene["planes"] = [{"name": "ground", "kind": "fixed", "nodes": ["bed.z_low"]}]
    sides = {"kind": "automatic"} if on == "automatic" else {"apexes": "b.z_low", "base": "bed.z_high"}
    scene["contacts"] = [{"name": "touch", "friction": friction, **sides}]
    return scene


class FrictionUnderRelaxation(Case):
    def test_carries_the_weight_and_creates_nothing(self):
        for on, friction in (("plane", 0.1), ("plane", 0.3), ("declared", 0.3), ("automatic", 0.3), ("plane", 0.9)):
            with self.subTest(f"{on} {friction}"):
                run = self.good(pressed_block(friction, on), "relaxed")
                weight = 0.5 * G if on == "plane" else 2.5 * G
                self.assertAlmostEqual(run.result("carried_last") / weight, 1, delta=1e-3)
                self.assertLess(run.created(), 1e-6)  # 7e-8 by automatic contact, 1e-15 else

    def test_of_a_pressure_that_acts_at_once(self):
        for on in ("plane", "declared"):
            scene = pressed_block(0.3, on)
            del scene["gravity"]
            scene["loads"] = [{"name": "push", "kind": "pressure", "surface": "b.z_high", "value": "1e4", "unit": "Pa"}]
            run = self.good(scene, "relaxed")
            self.assertAlmostEqual(run.result("carried_last") / 100, 1, delta=5e-3)  # the pressure follows an area that grows


def tied(method, size, weight):
    """A cube that is tied to the top of another one; the weight acts at once, or grows with the time."""
    scene = {"bodies": [box("a", (0, 0, 0), (size, size, size), (4, 4, 4)), box("b", (0, 0, size), (size, size, 2 * size), (4, 4, 4))],
             "contacts": [{"name": "tie", "kind": "tied", "apexes": "b.z_low", "base": "a.z_high", "method": method}],
             "planes": [{"name": "ground", "kind": "fixed", "nodes": ["a.z_low"]}],
             "probes": [{"name": "carried", "quantity": "force", "of": "tie", "component": "z"}], "time": {"end": "0.5 s"},
             "relaxation": {"residual": 1e-5, "after": "0.02 s"}}
    if weight == "at once":
        return {**scene, "gravity": DOWN}
    value = ["0", "0", f"t < 0.01 ? -{G}*t/0.01 : -{G}"]
    scene["loads"] = [{"name": f"weight_{body}", "kind": "body_force", "body": body, "value": value, "unit": "m/s^2"} for body in "ab"]
    return scene


class TiesFromRest(Case):
    def test_carry_the_weight(self):
        for method, size, weight in (("penalty", 0.1, "at once"), ("penalty", 0.125, "slowly"), ("multiplier", 0.1, "slowly")):
            with self.subTest(f"{method} {size} {weight}"):
                run = self.good(tied(method, size, weight), "relaxed")
                self.assertAlmostEqual(run.result("carried_last") / (1000 * size**3 * G), 1, delta=1e-3)


INNER, FIT, OUTER, ANGLE = 0.005, 0.02, 0.04, 15  # [m], [deg] of the shaft and of the hub in the press fit


def press_fit(over, around=2, in_shaft=6, in_hub=8):
    """A shaft that is too large for its hub by `over` [m], in plane strain: its initial displacement takes it out of the hub."""
    steel = {"kind": "elastic", "density": "7850 kg/m^3", "young": "200 GPa", "poisson": 0.3}
    ring = {"kind": "sector", "length": "0.005 m", "angle": f"{ANGLE} deg", "cells_around": around, "cells_along": 1}
    shaft = {**ring, "radius": f"{FIT + over!r} m", "cells_radial": in_shaft, "inner_radius": f"{INNER} m"}
    hub = {**ring, "radius": f"{OUTER} m", "cells_radial": in_hub, "inner_radius": f"{FIT} m"}
    planes = [{"name": name, "kind": "symmetry", "nodes": [f"shaft.{side}", f"hub.{side}"], "normal": normal} for name, side, normal in
              (("z0", "bottom", [0, 0, 1]), ("z1", "top", [0, 0, 1]), ("p1", "first_plane", [0, 1, 0]),
               ("p2", "second_plane", [-sin(radians(ANGLE)), cos(radians(ANGLE)), 0]))]
    return {"bodies": [{"name": "shaft", "mesh": shaft, "material": steel}, {"name": "hub", "mesh": hub, "material": steel}],
            "planes": planes, "contacts": [{"name": "c", "apexes": "shaft.side", "base": "hub.inside"}],
            "probes": [{"name": "pressure", "quantity": "contact_pressure", "of": "c"},
                       {"name": "bore", "quantity": "radius", "of": "hub.inside", "component": "z"}],
            "time": {"end": "1 ms"}, "relaxation": {"residual": 1e-6, "after": "20 us"},
            "initial": [{"body": "shaft", "displacement": [f"{-100 * over!r}*x", f"{-100 * over!r}*y", "0"], "unit": "m"}]}


class PressFit(Case):
    """The pressure and the bore of Lame.

    Chords make no error: nodes move along radii, so the strains in the middle of a cell are those of a ring, and force and area of a node
    have the same factor. Displacements are linear along a radius, so the radial strain of u = A r + B/r is constant in a cell of width d.
    A ring from r1 to r2 then stores (lambda + 2 mu) d^2 B^2 / 24 (1/r1^4 - 1/r2^4) too much, per angle and length. Full integration is
    stiffer by this part; assumed strains have 0.73 of it. The answer of small strain is off by the strain, over/FIT.
    At a residual of 1e-4 the run ends before it is in equilibrium: its pressure is 0.2 to 0.5 % too high.
    """
    modulus, ratio = 200e9 / (1 - 0.3**2), 0.3 / 0.7  # of plane strain
    shear = 200e9 / 2.6

    def part(self, r1, r2, inside, cells):
        """Displacement of the fit over the pressure there [m/Pa], and by which part linear displacements make the ring stiffer."""
        gives = FIT / self.modulus * ((r1**2 + r2**2) / (r2**2 - r1**2) + (self.ratio if inside else -self.ratio))
        around = FIT**2 / (2 * self.shear) * (r2 if inside else r1)**2 / (r2**2 - r1**2)  # B over the pressure
        more = 3.5 * self.shear * ((r2 - r1) / cells * around)**2 / 24 * (r1**-4 - r2**-4)
        return gives, more / (FIT * gives / 2)

    def test_has_the_pressure_of_lame(self):
        for over, *cells in ((2e-5, 2, 6, 8), (2e-6, 2, 6, 8), (2e-6, 3, 6, 8), (2e-6, 2, 9, 12), (2e-6, 4, 12, 16)):
            with self.subTest(f"{over} {cells}"):
                (shaft, stiff_shaft), (hub, stiff_hub) = self.part(INNER, FIT, False, cells[1]), self.part(FIT, OUTER, True, cells[2])
                stiffer = (shaft * stiff_shaft + hub * stiff_hub) / (shaft + hub)
                pressure = over / (shaft + hub)
                run = self.good(press_fit(over, *cells), "relaxed")
                nominal = run.result("pressure_last") * (FIT + over) / FIT  # it is the force over the area of the shaft as built
                self.assertAlmostEqual(nominal / pressure, 1, delta=stiffer + over / FIT)
                self.assertAlmostEqual((run.result("bore_last") - FIT) / (pressure * hub), 1, delta=abs(stiffer - stiff_hub) + over / FIT)

    def test_is_refused_where_it_starts_in_the_hub(self):
        scene = press_fit(2e-5)
        del scene["initial"]
        run = Run(scene)
        self.assertEqual(run.status, 2)
        self.assertIn("start penetrated, by 2e-05 m at most: move the bodies apart, or say 'initial_penetration: accept'", run.stderr)


# ------------------------------------------------------------------------------------------------

def stack(count, gap, rigid, automatic, on_a_plane, end):
    """Boxes of 32 g, one on the other, with a gap [m] below each; negative: they overlap."""
    bodies, contacts, planes, z, side = [], [], [], 0.0, 0.02
    if on_a_plane:
        planes = [{"name": "ground", "kind": "rigid", "surface": "r0.z_low", "point": lengths((0, 0, 0)), "normal": [0, 0, 1],
                   "friction": 0.5}]
    else:
        bodies = [box("floor", (-0.1, -0.1, -0.02), (0.1, 0.1, 0), (2, 2, 1), "100 MPa", rigid)]
        planes = [{"name": "hold", "kind": "fixed", "nodes": ["floor" if rigid else "floor.z_low"]}]
    for i in range(count):
        z += gap if i > 0 or not on_a_plane else max(gap, 0)
        bodies.append(box(f"r{i}", (-side, -side, z), (side, side, z + side), (1, 1, 1) if rigid else (2, 2, 1), "100 MPa", rigid))
        z += side
        if i > 0 or not on_a_plane:
            contacts.append({"name": f"c{i}", "apexes": f"r{i}.z_low", "base": (f"r{i - 1}" if i > 0 else "floor") + ".z_high",
                             "friction": 0.5})
    if automatic:
        contacts = [{"name": "all", "kind": "automatic", "friction": 0.5}] if len(bodies) > 1 or not rigid else []
    probes = [{"name": f"top_{axis}", "quantity": "position", "of": f"r{count - 1}", "component": axis} for axis in "xyz"]
    return {"bodies": bodies, "contacts": contacts, "planes": planes, "gravity": DOWN, "probes": probes, "time": {"end": end}}


class Stacks(Case):
    def rests(self, *values):
        with self.subTest(values):
            count, gap = values[0], values[1]
            run = self.good(stack(*values, "20 ms"))
            allowed = 1e-6 + 2 * count * abs(gap) + (0 if values[2] else 1e-6 * count**2)  # elastic ones give way
            for axis in "xyz":
                way = run.result(f"top_{axis}_largest") - run.result(f"top_{axis}_smallest")
                self.assertLess(way, allowed if axis == "z" else 1e-6, axis)

    def test_of_rigid_boxes(self):
        for count, gap in ((1, 0), (1, 1e-12), (1, 1e-6), (2, 1e-9), (3, 0)):
            for automatic, on_a_plane in itertools.product((False, True), (False, True)):
                self.rests(count, gap, True, automatic, on_a_plane)

    def test_of_boxes_whose_overlap_is_accepted(self):
        for gap in (-2e-3, -2e-5):  # more and less than a thousandth of an edge, from which on points keep an offset
            scene = stack(2, gap, False, True, True, "20 ms")
            scene["contacts"][0]["initial_penetration"] = "accept"
            run = self.good(scene)
            way = run.result("top_z_largest") - run.result("top_z_smallest")
            self.assertLess(way, 1e-5)

    def test_of_elastic_boxes(self):
        for count, gap in ((1, 1e-12), (2, 1e-9), (3, 1e-6), (3, 0)):
            for automatic, on_a_plane in itertools.product((False, True), (False, True)):
                self.rests(count, gap, False, automatic, on_a_plane)


class Overlaps(Case):
    def test_of_round_off_size_are_contact_and_listed(self):
        for rigid, automatic in itertools.product((False, True), (False, True)):
            with self.subTest(f"{rigid} {automatic}"):
                run = self.good(stack(2, -1e-9, rigid, automatic, False, "2 ms"))
                listed = [note for note in run.summary["notes"] if "apexes overlap at the start, by 1e-09 m at most" in note]
                at_corners_alone = rigid and automatic  # r0 and r1, which stand on edges and vertices of each other
                of_guards = 0 if rigid or automatic else 2  # of each pair, where nodes of the base stand over corners
                self.assertEqual(len(listed), 1 if at_corners_alone else 2 + of_guards, run.summary["notes"])
                self.assertTrue(all(note.endswith("of an element: taken as contact") for note in listed), listed)

    def test_that_are_larger_are_refused_with_the_key_that_accepts_them(self):
        for automatic in (False, True):
            run = Run(stack(2, -1e-7, False, automatic, False, "2 ms"))
            self.assertEqual(run.status, 2)
            self.assertIn("'initial_penetration: accept'", run.stderr)


def blocks_that_meet(method):
    """Four aligned steel blocks of 8 mm that come together at 20 m/s and yield: where all meet, sides of two of them share a plane."""
    steel = {"kind": "j2_bilinear", "density": "7850 kg/m^3", "young": "210 GPa", "poisson": 0.3, "yield": "300 MPa", "tangent": "1 GPa"}
    bodies, initial = [], []
    for i, j in itertools.product((0, 1), (0, 1)):
        name, low = f"b{i}{j}", (8.11e-3 * i, 8.11e-3 * j, 0)
        bodies.append({**box(name, low, [a + 8e-3 for a in low], (8, 8, 8)), "material": steel})
        initial.append({"body": name, "velocity": [str(10 - 20 * i), str(10 - 20 * j), "0"], "unit": "m/s"})
    return {"bodies": bodies, "initial": initial, "contacts": [{"name": "all", "kind": "automatic", "method": method}],
            "time": {"end": "20 us", **({"safety": 0.05} if method == "multiplier" else {})}}


def dissipated(run):
    accounts = run.summary["ledger"]["accounts"].values()
    return sum(part["value"] for one in accounts for part in one["dissipated"].values())


class FlushBlocks(Case):
    def test_create_nothing_by_a_penalty_and_meet_as_by_multipliers(self):
        penalty, multiplier = (self.good(blocks_that_meet(method)) for method in ("penalty", "multiplier"))
        start = 4 * 0.5 * 7850 * 8e-3**3 * (10**2 + 10**2)
        created = penalty.summary["ledger"]["accounts"]["all"]["created"]["value"]
        self.assertLess(abs(created), 2e-4 * start)  # 3e-5
        for energy in (lambda run: run.ledger("kinetic"), dissipated):  # with five cells they differ by 0.017, with six by 0.016
            self.assertAlmostEqual(energy(penalty) / start, energy(multiplier) / start, delta=0.01)  # 0.0043, 0.0010


def thrown(sign):
    """A block that is thrown on a floor, or at -1 its mirror image in the plane x = 0."""
    low, spin, at = [-0.0155, -0.0193, -0.0171], (1.3, -37.4 * sign, 7.07 * sign), (-0.035 * sign, -0.035, 0.05)
    block = box("b", low, [-a for a in low], (2, 2, 2))
    block["rotate"] = {"axis": [-0.79, -0.604 * sign, 0.106 * sign], "angle": "150.744 deg"}
    block["move"] = lengths(at)
    x, y, z = (f"({axis} - ({place!r}))" for axis, place in zip("xyz", at))
    velocity = [f"{-0.48 * sign!r} + ({spin[1]!r})*{z} - ({spin[2]!r})*{y}", f"-0.53 + ({spin[2]!r})*{x} - ({spin[0]!r})*{z}",
                f"0.99 + ({spin[0]!r})*{y} - ({spin[1]!r})*{x}"]
    return {"bodies": [box("floor", (-0.2, -0.2, -0.03), (0.2, 0.2, 0), (8, 8, 1)), block],
            "gravity": ["0 m/s^2", "0 m/s^2", "-196.2 m/s^2"], "planes": [{"name": "hold", "kind": "fixed", "nodes": ["floor.z_low"]}],
            "contacts": [{"name": "all", "kind": "automatic", "friction": 0.3}],
            "initial": [{"body": "b", "velocity": velocity, "unit": "m/s"}], "time": {"end": "0.03 s"}}


class Mirror(Case):
    def test_of_a_block_with_edges_on_a_floor_whose_faces_warp(self):
        run, image = (Run(thrown(sign)) for sign in (1, -1))
        self.assertEqual((run.status, image.status), (0, 0))
        for name in ("all_deepest", "b_smallest_corner"):
            self.assertAlmostEqual(run.result(name) / image.result(name), 1, delta=1e-8)  # 1e-11
        self.assertAlmostEqual(run.ledger("kinetic") / image.ledger("kinetic"), 1, delta=1e-9)


class Defects(Case):
    """A step beyond the stable one makes energy out of nothing: the scenes above then stop."""

    def test_stop(self):
        scenes = {"tie": tied("multiplier", 0.125, "at once"), "block": pressed_block(0.3, "plane"),
                  "stack": stack(3, 0, False, True, False, "0.1 s")}
        safeties = {"stack": (1.5, 3)}  # at others its blows ask for steps that are stable again
        for name, scene, safety in [(*one, safety) for one in scenes.items() for safety in safeties.get(one[0], (1.5, 2, 3))]:
            with self.subTest(f"{name} {safety}"):
                scene = {**scene, "time": {"end": "0.1 s", "safety": safety}}
                scene.pop("relaxation", None)
                run = Run(scene)
                self.assertEqual(run.status, 3, run.stderr)
                self.assertIn(run.summary["ending"]["word"], ("energy_created", "energy_lost", "inverted_element", "not_finite"))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    Run.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
