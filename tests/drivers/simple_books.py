"""Small scenes whose books and results are known at once, each for a part of the program other than contact that no case of verification/
depends on.

    python3 tests/drivers/simple_books.py DRIVERS                   DRIVERS: the folder with the programs
    python3 tests/drivers/simple_books.py DRIVERS Springs           tests of these names alone

Scenes are dicts, as in right_runs.py. Unless a test says otherwise, a run must reach its end and print no warning. Some tests read frames
and a mesh from a file: the programs must be built with VTK.
"""
import importlib.util
import os
import pty
import re
import select
import signal
import subprocess
import sys
import time
import unittest
from math import hypot, pi, sqrt
from pathlib import Path

import runs
from known_answers import automatic, fixed, material, momenta, plate
from right_runs import DOWN, G, PATIENCE, box, lengths, written


def script(name):
    """The module of this name in scripts/, where one of the same name in this folder is loaded already."""
    sys.path.append(str(runs.ROOT / "scripts"))
    spec = importlib.util.spec_from_file_location(f"scripts_{name}", runs.ROOT / f"scripts/{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


read_fields = script("runs").read_fields

ROUND_OFF = 1e-9  # [-] of what a result is compared with: sums of some hundred steps


class Run(runs.Run):
    """A run of a scene: what it said, and its folder."""

    def __init__(self, scene, folder, *flags, program="scene"):
        Path(folder).mkdir(exist_ok=True)
        words = [Run.drivers / program, written(scene, folder), "--out", Path(folder) / "out", *flags]
        done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE)
        self.status, self.stdout, self.stderr, self.out = done.returncode, done.stdout, done.stderr, Path(folder) / "out"

    def result(self, name):
        return self.summary()["results"][name]["value"]

    def ledger(self, name):
        return self.summary()["ledger"][name]["value"]

    def account(self, name):
        return self.summary()["ledger"]["accounts"][name]


class Books(runs.InATemporaryFolder):
    def run_scene(self, scene, flags=("--quiet",), name="a", program="scene"):
        """A run that reaches its end without a message."""
        run = Run(scene, self.folder / name, *flags, program=program)
        self.assertEqual((run.status, run.stderr), (0, ""))
        return run


def probe(name, quantity, of, component=None, **more):
    return {"name": name, "quantity": quantity, "of": of, **({"component": component} if component else {}), **more}


def moving(body, *velocity):
    return {"body": body, "velocity": [str(one) for one in velocity], "unit": "m/s"}


def sheet(length, width, along, across, **more):
    return {"kind": "sheet", "length": f"{length!r} m", "width": f"{width!r} m", "cells_along": along, "cells_across": across, **more}


def point(name, near):
    return {"name": name, "near": lengths(near)}


def wait_for(condition):
    """Until a condition holds, or patience is over."""
    until = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > until:
            raise TimeoutError
        time.sleep(1e-3)


def seconds(words):
    """Of hours, minutes and seconds as the line of progress has them."""
    return sum(float(number) * {"h": 3600, "min": 60, "s": 1}[unit] for number, unit in re.findall(r"(\d+) (h|min|s)", words))


def cube(name="b", size=0.1, cells=1, low=(0, 0, 0), **more):
    return {**box(name, low, [one + size for one in low], (cells,) * 3), **more}


# ------------------------------------------------------------------------------------------------

STIFFNESS, DAMPING = 1e3, 5.0  # [N/m], [N s/m]


class Springs(Books):
    def test_two_free_bodies_on_a_spring(self):
        """They have one frequency, of the reduced mass, far below those of the bodies; eleven rigid motions meet no stiffness."""
        bodies = [cube("a", cells=2, points=[point("middle", (0.05, 0.05, 0.05))]),
                  cube("b", cells=2, low=(0.3, 0, 0), points=[point("middle", (0.35, 0.05, 0.05))])]
        spring = {"name": "k", "from": "a.middle", "to": "b.middle", "stiffness": f"{STIFFNESS!r} N/m"}
        run = self.run_scene({"bodies": bodies, "springs": [spring], "time": {"end": "1 s"}, "modes": {"lowest": 12}}, program="modes")
        self.assertEqual(run.result("without_stiffness"), 11)
        right = sqrt(STIFFNESS / 0.5) / (2 * pi)  # bodies of 1 kg
        self.assertAlmostEqual(run.result("frequency_12") / right, 1, delta=0.01)  # the bodies give way a little

    def test_dashpot_of_a_spring_that_turns(self):
        """The end of a spring moves around the other end: the dashpot dissipates energy of the motion along the spring, not across it."""
        bodies = [cube("hub", rigid=True, points=[point("tip", (0.1, 0, 0))]),
                  cube("b", cells=2, low=(0.2, -0.05, -0.05), rigid=True, points=[point("middle", (0.2, 0, 0))])]
        spring = {"name": "k", "from": "hub.tip", "to": "b.middle", "stiffness": f"{STIFFNESS!r} N/m", "damping": f"{DAMPING!r} N*s/m"}
        run = self.run_scene({"bodies": bodies, "springs": [spring], "planes": [fixed("hub")], "initial": [moving("b", 0, 1, 0)],
                              "time": {"end": "80 ms"}})
        created = run.account("k")["created"]["value"]
        self.assertLess(abs(created), 2e-3 * run.ledger("initial_kinetic"))  # of a thousand steps


class Plates(Books):
    def test_turns_in_its_plane_without_drilling(self):
        """The spin of nodes is that of the plate: nothing is to be warned of."""
        body = plate("p", sheet(0.05, 0.05, 2, 2), 0.02, material())
        body["element"]["drilling"] = 0
        self.run_scene({"bodies": [body], "initial": [moving("p", "-10*y", "10*x", 0)], "time": {"end": "2 ms"}})

    def test_plastic_strain_at_the_surfaces_of_a_bent_and_stretched_plate(self):
        """Its top hardly changes its length, its middle and its bottom yield; no place has a plastic strain below zero."""
        body = plate("p", sheet(0.02, 0.01, 4, 2), 0.002, material(7850.0, "210 GPa", **{"yield": "300 MPa", "tangent": "1 GPa"}))
        stretch, bend = 5.0, 5000.0  # [1/s], [1/(m s)]: at the top, stretch - bend * 1 mm = 0
        drive = {"name": "drive", "kind": "driven", "nodes": ["p.skin"],
                 "velocity": {"value": [f"{stretch!r}*x", "0", f"{bend / 2!r}*x^2"], "unit": "m/s"},
                 "angular_velocity": {"value": ["0", f"-{bend!r}*x", "0"], "unit": "rad/s"}}
        probes = [probe(place, "plastic_strain", "p", place=place) for place in ("top", "middle", "bottom")]
        run = self.run_scene({"bodies": [body], "planes": [drive], "probes": probes, "time": {"end": "1 ms"}})
        self.assertGreater(run.result("middle_last"), 0.002)
        self.assertGreater(run.result("bottom_last"), run.result("middle_last"))
        self.assertEqual(min(run.result(f"{place}_smallest") for place in ("top", "middle", "bottom")), 0)

    def test_declared_contact_below_the_thickness(self):
        """Plates that touch at a tenth of a millimetre overlap by the rest of their thickness, which is declared, in either order."""
        for first, second in ((0.001, 0.003), (0.003, 0.001)):
            with self.subTest(first):
                low = plate("low", sheet(0.01, 0.01, 4, 4), first, material())
                high = plate("high", sheet(0.01, 0.01, 4, 4), second, material(), move=lengths((0, 0, 0.003)))
                contact = {"name": "c", "apexes": "high.bottom", "base": "low.top", "contact_height": "given", "height": "0.1 mm"}
                run = self.run_scene({"bodies": [low, high], "contacts": [contact], "planes": [fixed("low.skin")],
                                      "initial": [moving("high", 0, 0, -3)], "time": {"end": "1.2 ms"}}, name=str(first))
                self.assertGreater(run.result("audit_deepest_overlap"), 1e-3)
                self.assertLess(run.result("audit_overlap_elements"), 0.01)


def flat(rows):
    """The text of a VTK file of a unit square of triangles: `rows` times `rows` cells, each cut from its low to its high corner.

    The nodes of its rim are a set.
    """
    points = [(i / rows, j / rows, 0) for j in range(rows + 1) for i in range(rows + 1)]
    rim = [int(any(one in (0, 1) for one in point[:2])) for point in points]
    lows = [i + (rows + 1) * j for j in range(rows) for i in range(rows)]
    cells = [cell for a in lows for cell in ((a, a + 1, a + rows + 2), (a, a + rows + 2, a + rows + 1))]

    def array(name, kind, values, width=1):
        words = " ".join(str(one) for one in values)
        return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="ascii">{words}</DataArray>'
    return "\n".join(['<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>',
                      f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">',
                      "<PointData>", array("rim", "Int64", rim), "</PointData>",
                      "<Points>", array("Points", "Float64", sum(points, ()), 3), "</Points>", "<Cells>",
                      array("connectivity", "Int64", sum(cells, ())), array("offsets", "Int64", range(3, 3 * len(cells) + 3, 3)),
                      array("types", "UInt8", [5] * len(cells)), "</Cells></Piece></UnstructuredGrid></VTKFile>"])


class Sets(Books):
    def test_rim_of_a_plate_from_a_file_that_is_split(self):
        """Of the split plate nine nodes of twenty-five lie inside, each with a sixteenth of the mass; all others are the rim."""
        (self.folder / "a").mkdir()
        (self.folder / "a/flat.vtu").write_text(flat(2), encoding="utf-8")
        body = plate("p", {"kind": "file", "path": "flat.vtu"}, 0.01, material())
        run = self.run_scene({"refine": 2, "bodies": [body], "initial": [moving("p", 0, 0, 1)], "time": {"end": "1 us"},
                              "probes": momenta("p") + [probe("rim", "momentum", "p.rim", "z")]})
        self.assertAlmostEqual(run.result("p_z_last") / 10, 1, delta=ROUND_OFF)  # 1 m by 1 m by 10 mm
        self.assertAlmostEqual(run.result("rim_last") / run.result("p_z_last"), 7 / 16, delta=ROUND_OFF)

    def test_by_a_cylinder(self):
        """A set by a cylinder within a bar reaches from one end of its axis to the other."""
        body = {**box("b", (0, 0, 0), (0.1, 0.1, 0.4), (2, 2, 8)), "sets": [
            {"name": "part", "cylinder": {"from": lengths((0.05, 0.05, 0.1)), "to": lengths((0.05, 0.05, 0.25)), "radius": "0.2 m"}}]}
        run = self.run_scene({"bodies": [body], "initial": [moving("b", 0, 0, 1)], "time": {"end": "1 us"}, "probes": [
            probe("long", "extent", "b.part", "z"), probe("middle", "position", "b.part", "z")]})
        self.assertAlmostEqual(run.result("long_last"), 0.15, delta=ROUND_OFF)
        self.assertAlmostEqual(run.result("middle_smallest"), 0.175, delta=2e-6)  # and the way of a microsecond


class RigidBodies(Books):
    def test_point_mass_on_several_nodes(self):
        """A mass of 2 kg on the four nodes of a face of 1 kg makes 3 kg of them, which a force accelerates."""
        push = {"name": "push", "kind": "force", "nodes": "b.z_low", "value": ["0", "0", "3"], "unit": "N"}
        run = self.run_scene({"bodies": [cube(rigid=True)], "point_masses": [{"name": "m", "nodes": "b.z_high", "mass": "2 kg"}],
                              "loads": [push], "initial": [moving("b", 0, 0, 1)], "time": {"end": "0.1 s"},
                              "probes": momenta("b") + [probe("speed", "velocity", "b", "z")]})
        self.assertAlmostEqual(run.ledger("initial_momentum")[2] / 3, 1, delta=ROUND_OFF)
        self.assertAlmostEqual(run.result("b_z_last") / 3.3, 1, delta=ROUND_OFF)
        self.assertAlmostEqual(run.result("speed_last") / 1.1, 1, delta=ROUND_OFF)

    def spins(self, name, **properties):
        """A run of a cube about its centre with given properties of its mass, that turns about z with 10 rad/s."""
        body = cube("b", 0.1, low=(-0.05, -0.05, -0.05), rigid=True, **properties)
        return self.run_scene({"bodies": [body], "initial": [moving("b", "-10*y", "10*x", 0)], "time": {"end": "1 ms"}}, name=name)

    def test_mass_alone_scales_the_inertia(self):
        """With twice the mass a body that turns has twice the angular momentum."""
        before, after = self.spins("a"), self.spins("b", mass_properties={"mass": "2 kg"})
        self.assertAlmostEqual(after.ledger("initial_angular_momentum")[2] / before.ledger("initial_angular_momentum")[2], 2,
                               delta=ROUND_OFF)

    def test_products_of_inertia(self):
        """The angular momentum of a turn about z is the column of z of the inertia, as the order xx, yy, zz, xy, yz, xz has it."""
        inertia = [f"{one!r} kg*m^2" for one in (0.003, 0.004, 0.005, 0.0001, 0.0002, 0.0003)]
        run = self.spins("a", mass_properties={"inertia": inertia})
        for found, right in zip(run.ledger("initial_angular_momentum"), (0.003, 0.002, 0.05), strict=True):
            self.assertAlmostEqual(found, right, delta=ROUND_OFF * 0.05)

    def test_driven_about_an_axis_that_is_not_principal(self):
        """The drive gives a body all of its angular momentum, which turns with the body."""
        body = cube("b", low=(-0.05, -0.05, -0.05), rigid=True)
        body["mesh"]["high"] = lengths((0.15, 0.1, 0.05))
        drive = {"name": "drive", "kind": "driven", "nodes": ["b"], "velocity": {"value": ["0", "0", "0"], "unit": "m/s"},
                 "angular_velocity": {"value": ["30*t", "50*t", "20*t"], "unit": "rad/s"}}
        run = self.run_scene({"bodies": [body], "planes": [drive], "time": {"end": "0.1 s"}})
        given, size = run.ledger("angular_momentum_residual"), hypot(*run.ledger("angular_momentum"))
        self.assertGreater(size, 0.01)
        self.assertLess(hypot(*given), ROUND_OFF * size)
        account = run.account("drive")["angular_impulse"]
        self.assertEqual(account["unit"], "N m s")
        for found, right in zip(account["value"], run.ledger("angular_momentum"), strict=True):
            self.assertAlmostEqual(found, right, delta=ROUND_OFF)

    def test_floor_over_two_stages(self):
        """A box that lies on a floor in two stages never leaves it: no impact takes energy."""
        stages = [{"name": name, "duration": "2 ms"} for name in ("first", "second")]
        floor = {"name": "ground", "kind": "floor", "nodes": ["b.z_low"], "point": lengths((0, 0, 0)), "normal": [0, 0, 1]}
        run = self.run_scene({"bodies": [cube()], "planes": [floor], "gravity": DOWN, "stages": stages})
        self.assertEqual(run.account("ground")["dissipated"]["inelastic_impact"]["value"], 0)


class Console(Books):
    LINE = r"energy: (\S+) J at the start and (\S+) J of external work became (\S+) J kinetic, (\S+) J stored, (\S+) J dissipated; "

    def test_line_of_energies(self):
        """A body that falls: the start and the work of its weight are all kinetic energy, and nothing is stored."""
        run = self.run_scene({"bodies": [cube()], "gravity": DOWN, "initial": [moving("b", 0, 0, -1)], "time": {"end": "0.1 s"}},
                             flags=())
        start, outside, kinetic, stored, dissipated = (float(one) for one in re.search(self.LINE, run.stdout).groups())
        speed = 1 + 0.1 * G
        self.assertAlmostEqual(kinetic / (speed**2 / 2), 1, delta=1e-3)  # four digits
        self.assertAlmostEqual(outside / ((speed**2 - 1) / 2), 1, delta=1e-2)  # the last step is not the end
        self.assertAlmostEqual(start, 0.5, delta=1e-4)
        self.assertLess(abs(stored) + abs(dissipated), 1e-3)

    def test_how_much_a_contact_costs(self):
        """A dry run tells of each contact how much shorter it makes the step, whatever the others do."""
        def advice(*penalties):
            bodies, contacts = [], []
            for i, penalty in enumerate(penalties):
                bodies += [cube(f"low{i}", low=(i, 0, 0)), cube(f"high{i}", low=(i, 0, 0.11))]
                contacts.append({"name": f"c{i}", "apexes": f"high{i}.z_low", "base": f"low{i}.z_high", "method": "penalty",
                                 "penalty_scale": penalty})
            said = self.run_scene({"bodies": bodies, "contacts": contacts, "time": {"end": "1 ms"}}, ["--dry-run"]).stdout
            return [float(one) for one in re.findall(r"contact '\w+' limits the step: this run has (\S+) times as many steps", said)]
        soft, hard = advice(100), advice(1000)
        self.assertLess(2 * soft[0], hard[0])
        self.assertEqual(advice(100, 1000), soft + hard)


class Contacts(Books):
    def test_two_passes_have_the_same_pressure_either_way_round(self):
        """Blocks of unlike meshes come together; with two passes it makes no difference which surface has the apexes."""
        bodies = [cube("low", cells=1), cube("high", cells=3, low=(0, 0, 0.1))]
        pressures = []
        for apexes, base in (("high.z_low", "low.z_high"), ("low.z_high", "high.z_low")):
            contact = {"name": "c", "apexes": apexes, "base": base, "passes": "two", "method": "penalty"}
            run = self.run_scene({"bodies": bodies, "contacts": [contact], "initial": [moving("high", 0, 0, -1)], "time": {"end": "1 ms"},
                                  "probes": [probe("pressure", "contact_pressure", "c")]}, name=apexes)
            pressures.append(run.result("pressure_largest"))
        self.assertAlmostEqual(pressures[1] / pressures[0], 1, delta=1e-6)

    def test_plate_on_a_rigid_plane_by_a_penalty(self):
        """Each of its nodes swings by its own on a penalty times its area: as deep as its speed times the root of mass per area over it."""
        ground = {"name": "ground", "kind": "rigid", "surface": "p.skin", "point": lengths((0, 0, -1e-3)), "normal": [0, 0, 1],
                  "method": "penalty", "penalty": "1e8 Pa/m"}
        run = self.run_scene({"bodies": [plate("p", sheet(0.04, 0.04, 4, 4), 0.002, material())], "planes": [ground],
                              "initial": [moving("p", 0, 0, -1)], "time": {"end": "2 ms"}})
        self.assertAlmostEqual(run.result("ground_deepest") / sqrt(1000 * 0.002 / 1e8), 1, delta=0.01)  # steps miss the deepest point

    def test_ring_that_begins_above_height_zero(self):
        """A rigid ring from 0.1 m to 0.2 m falls with 1 m/s on a floor 10 mm below it."""
        ring = {"name": "ring", "rigid": True, "material": material(), "mesh": {
            "kind": "revolved", "radii": lengths((0.03, 0.05)), "heights": lengths((0.1, 0.2)), "cells_radial": [1], "cells_along": [1],
            "filled": ["x"], "angle": "360 deg", "cells_around": 12}}
        floor = box("floor", (-0.1, -0.1, 0.04), (0.1, 0.1, 0.09), (4, 4, 1), rigid=True)
        run = self.run_scene({"bodies": [floor, ring], "contacts": [{"name": "c", "apexes": "floor.z_high", "base": "ring.skin"}],
                              "planes": [fixed("floor")], "initial": [moving("ring", 0, 0, -1)], "time": {"end": "15 ms"},
                              "probes": [probe("way", "displacement", "ring", "z")]})
        self.assertAlmostEqual(run.result("way_smallest"), -0.01, delta=1e-4)  # a step of 15 us, and the give of the contact

    def test_times_of_touch(self):
        """A block that lies on another one touches it to the end."""
        bodies = [cube("low", cells=1), cube("high", cells=1, low=(0, 0, 0.1))]
        run = self.run_scene({"bodies": bodies, "contacts": automatic(0), "planes": [fixed("low.z_low")], "gravity": DOWN,
                              "time": {"end": "5 ms"}})
        (pair,) = run.summary()["touched"]
        self.assertLess(pair["first_touch"]["value"], 1e-3)
        self.assertGreater(pair["last_touch"]["value"], 4e-3)


class Frames(Books):
    def test_as_many_as_times(self):
        """A frame for each multiple of the interval, the last one too."""
        run = self.run_scene({"bodies": [cube()], "initial": [moving("b", 0, 0, 1)], "time": {"end": "40 ms"},
                              "output": {"frames_every": "10 ms"}})
        self.assertEqual(len(run.frames("body")), 5)

    def test_force_of_a_rigid_plane(self):
        """The frame of a box that lies on a rigid plane has its weight as force of the contact."""
        ground = {"name": "ground", "kind": "rigid", "surface": "b.z_low", "point": lengths((0, 0, 0)), "normal": [0, 0, 1]}
        run = self.run_scene({"bodies": [cube(rigid=True)], "planes": [ground], "gravity": DOWN, "time": {"end": "0.1 s"}})
        force = read_fields(run.frames("body")[-1][1])["contact_force"]
        self.assertAlmostEqual(sum(one[2] for one in force) / G, 1, delta=1e-3)  # a step in a thousand

    def crossing(self, push):
        """Frames of the contact of two rigid bars that cross on their ridges: the upper one lies on the lower one."""
        high, side = 0.005 * sqrt(2), (0.05, 0.005, 0.005)
        bars = [box(name, [-one for one in side], side, (11, 2, 2), rigid=True) for name in ("lower", "upper")]
        bars[0]["rotate"] = {"axis": [1, 0, 0], "angle": "45 deg"}
        bars[1]["mesh"]["map"] = ["(z-y)/sqrt(2)", "x", "(y+z)/sqrt(2)"]
        bars[1]["move"] = lengths((0, 0, 2 * high))
        contact = {"name": "c", "apexes": "upper.skin", "base": "lower.skin", "passes": "two", "friction": 0.5}
        run = self.run_scene({"bodies": bars, "planes": [fixed("lower")], "initial": [moving("upper", push, 0, 0)], "contacts": [contact],
                              "gravity": DOWN, "time": {"end": "2 ms"}, "output": {"frames_every": "0.2 ms"}}, name=str(push))
        return [read_fields(file) for time, file in run.frames("contact") if time > 0]  # friction acts from the first step on

    def test_edges_slide_or_stick(self):
        """A ridge that lies on a ridge sticks, and slides where it moves along the other one."""
        for push, right in ((0, {0}), (1, {1})):
            found = {slides for frame in self.crossing(push)
                     for kind, status, slides in zip(frame["kind"], frame["contact_status"], frame["slides"]) if (kind, status) == (4, 1)}
            self.assertEqual(found, right)

    def test_status_of_contacts(self):
        """No node of two blocks is in contact before they meet, all of a face are later."""
        bodies = [cube("low", cells=1), cube("high", cells=1, low=(0, 0, 0.101))]
        contact = {"name": "c", "apexes": "high.z_low", "base": "low.z_high", "heights": "nodes"}
        run = self.run_scene({"bodies": bodies, "contacts": [contact], "planes": [fixed("low.z_low")],
                              "initial": [moving("high", 0, 0, -1)], "time": {"end": "1.5 ms"},
                              "output": {"frames_every": "0.5 ms", "fields": "all"}})
        closed = [sum(one == 1 for one in read_fields(file)["contact_status"]) for _, file in run.frames("contact")]
        self.assertEqual(closed[0], 0)
        self.assertEqual(closed[-1], 8)  # a line and a facet of each


class Inputs(Books):
    def test_columns_of_a_table_have_their_units(self):
        """A tenth of a second of 1 kPa on a face of 100 cm2 moves 1 kg by 1 m/s, from a table of forces and pressures."""
        (self.folder / "a").mkdir()
        (self.folder / "a/push.csv").write_text("time [ms], force [N], pressure [MPa]\n0, 7, 0.001\n1000, 7, 0.001\n", encoding="utf-8")
        push = {"name": "push", "kind": "pressure", "surface": "b.z_low", "value": 'table("push.csv:pressure", t)', "unit": "kPa"}
        run = self.run_scene({"bodies": [cube(rigid=True)], "loads": [push], "probes": momenta("b"), "time": {"end": "0.1 s"}})
        self.assertAlmostEqual(run.result("b_z_last"), 1, delta=ROUND_OFF)


class Stops(Books):
    def test_relaxation_of_a_second_stage(self):
        """Its `after` counts from its beginning."""
        stages = [{"name": "first", "duration": "0.4 s"},
                  {"name": "second", "duration": "0.5 s", "relaxation": {"residual": 1e-3, "after": "0.3 s"}}]
        run = self.run_scene({"bodies": [cube()], "planes": [fixed("b.z_low")], "gravity": DOWN, "stages": stages})
        self.assertEqual(run.summary()["ending"]["word"], "relaxed")
        self.assertGreaterEqual(run.summary()["ending"]["time"]["value"], 0.7)

    def test_relaxation_that_does_not_end(self):
        """It says the residual, and the limit of the case."""
        scene = {"bodies": [cube()], "planes": [fixed("b.z_low")], "gravity": DOWN, "time": {"end": "10 ms"},
                 "relaxation": {"residual": 1.25e-7}}
        run = Run(scene, self.folder / "a", "--quiet")
        self.assertEqual((run.status, run.summary()["ending"]["word"]), (3, "not_relaxed"))
        residual, limit = re.search(r"the residual is (\S+); the limit is (\S+)$", run.summary()["ending"]["reason"]).groups()
        self.assertEqual(float(limit), 1.25e-7)
        self.assertGreater(float(residual), 1.25e-7)

    def test_turning_points_are_no_rest(self):
        """A mass that swings on a spring is slow twice a period for a moment, which is no rest; it goes on to the end."""
        body = cube(cells=2, rigid=True, points=[point("middle", (0.05, 0.05, 0.05))])
        spring = {"name": "k", "from": "b.middle", "to": "ground", "stiffness": "1e4 N/m"}  # of 63 ms
        run = self.run_scene({"bodies": [body], "springs": [spring], "initial": [moving("b", 0, 0, 1)], "time": {"end": "0.2 s"},
                              "stop": [{"rest": {"part": 0.01, "for": "10 ms"}}], "output": {"history_every": "0.5 ms"}})
        self.assertEqual(run.summary()["ending"]["word"], "reached_end")


class Moments(Books):
    def test_section_of_a_bent_plate(self):
        """A moment at the end of a plate that is held at the other one is that of each section."""
        body = plate("p", sheet(0.03, 0.01, 6, 2), 0.005, material())
        twist = {"name": "twist", "kind": "moment", "nodes": "p.x_high", "value": ["0", "1e-4", "0"], "unit": "N*m"}
        run = self.run_scene({"bodies": [body], "planes": [fixed("p.x_low")], "loads": [twist], "time": {"end": "2 s"},
                              "sections": [{"name": "cut", "body": "p", "point": lengths((0.0125, 0.005, 0)), "normal": [1, 0, 0]}],
                              "relaxation": {"residual": 1e-5}, "probes": [probe("moment", "section_moment", "cut", "y")]})
        self.assertAlmostEqual(run.result("moment_last") / -1e-4, 1, delta=0.01)

    def test_water_that_sloshes_far_from_the_axis(self):
        """Walls and weight explain all of its angular momentum."""
        water = {"name": "w", "material": {"kind": "linear_fluid", "density": "1000 kg/m^3", "sound_speed": "30 m/s"},
                 "mesh": {"kind": "box", "low": lengths((3, 0, 0)), "high": lengths((4, 0.1, 0.5)), "cells": [6, 1, 4]},
                 "start": {"hydrostatic": True}}
        planes = [{"name": side, "kind": "symmetry", "nodes": [f"w.{side}"], "normal": normal} for side, normal in
                  (("x_low", [1, 0, 0]), ("x_high", [-1, 0, 0]), ("y_low", [0, 1, 0]), ("y_high", [0, -1, 0]), ("z_low", [0, 0, 1]))]
        run = self.run_scene({"bodies": [water], "planes": planes, "gravity": DOWN, "time": {"end": "0.2 s"},
                              "initial": [moving("w", "0.1*sin(pi*x)*cosh(pi*z)", 0, "-0.1*cos(pi*x)*sinh(pi*z)")]})
        impulse = max(hypot(*account["angular_impulse"]["value"]) for account in run.summary()["ledger"]["accounts"].values())
        self.assertLess(hypot(*run.ledger("angular_momentum_residual")), ROUND_OFF * impulse)


class Progress(Books):
    PAUSE = 0.5  # [s]

    def started(self, words, **streams):
        process = subprocess.Popen(words, **streams)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def lines_about_a_pause(self, words):
        """A run stops for a while after its first line of progress: the line on its terminal after that, and its stdout."""
        terminal, inside = pty.openpty()
        self.addCleanup(os.close, terminal)
        process = self.started(words, stdout=subprocess.PIPE, stderr=inside, text=True)
        os.close(inside)
        os.read(terminal, 1000)
        process.send_signal(signal.SIGSTOP)
        time.sleep(self.PAUSE)
        while select.select([terminal], [], [], 0)[0]:  # lines that came before it stopped
            os.read(terminal, 1000)
        process.send_signal(signal.SIGCONT)
        line = os.read(terminal, 1000).decode()
        process.terminate()
        return line, process.communicate(timeout=PATIENCE)[0]

    def test_time_to_go_of_a_run_that_goes_on(self):
        """On a terminal it is the time since the run went on, times what is left over what was done since then.

        The run stops for a while, which counts in that time: so there is a lower bound that no speed of the machine changes.
        """
        folder = self.folder / "a"
        folder.mkdir()
        case = written({"bodies": [cube()], "initial": [moving("b", 0, 0, 1)], "time": {"end": "10000 s"}}, folder)
        words = [Run.drivers / "scene", case, "--out", folder / "out"]
        first = self.started([*words, "--quiet", "--checkpoint-every", "20 s"])
        wait_for((folder / "out/checkpoint").exists)
        first.kill(), first.wait()
        line, said = self.lines_about_a_pause([*words, "--resume"])
        begin = float(re.search(r"goes on from its checkpoint at (\S+) s", said)[1])
        now, to_go = re.search(r" (\S+) of 1e\+04 s .* dt \S+ s  (.*) to go", line).groups()
        latest = float(now) * (1 + 5e-4)  # the line has four digits of it
        self.assertGreater(seconds(to_go) + 1, self.PAUSE * (1e4 - latest) / (latest - begin))


def main(words, page):
    """Runs the tests of the module that is started; without words its page."""
    if not words:
        sys.exit(page)
    runs.Run.drivers = Path(words.pop(0)).resolve()
    unittest.main(argv=[sys.argv[0], "-v", *words])


if __name__ == "__main__":
    main(sys.argv[1:], __doc__)
