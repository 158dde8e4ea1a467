"""The judge of verification/extremes can tell right from wrong: made-up runs whose overlap, energy and momenta are known."""
import base64
import json
import re
import struct
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import made_up

try:
    import numpy as np
    import yaml  # noqa: F401  (the command needs it)
except ImportError:
    sys.exit(77)

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "verification/extremes"), str(ROOT / "scripts")]
import axes  # noqa: E402  (after the path)
import finer  # noqa: E402
import judge  # noqa: E402
import measure  # noqa: E402
import meshes  # noqa: E402
import scenes  # noqa: E402

DENSITY = 1000.0
FOLDER = tempfile.TemporaryDirectory()  # of all runs that are made up


# ------------------------------------------------------------------------------------------------
# Made-up runs

def packed(array):
    """An array as the drivers write it."""
    data = np.ascontiguousarray(array).tobytes()
    block = zlib.compress(data)
    head = struct.pack("<4Q", 1, 32768, len(data), len(block))
    return (base64.b64encode(head) + base64.b64encode(block)).decode()


def data_array(name, array, kind):
    width = array.shape[1] if array.ndim > 1 else 1
    array = array.astype(measure.TYPES[kind])
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{width}" format="binary">{packed(array)}</DataArray>'


class Folder:
    """A run that is made up: bodies that move as a function of time says, and columns of the history."""

    def __init__(self, bodies, motion, times=(0.0, 1.0), columns=None, case=None, thickness=0.0):
        self.path = Path(tempfile.mkdtemp(dir=FOLDER.name))
        self.case = {"bodies": [], "contacts": [], **(case or {})}
        X = np.concatenate([mesh.points for _, mesh in bodies])
        cells, parts, first = [], [], 0
        for n, (name, mesh) in enumerate(bodies):
            entry = {"name": name, "mesh": {"kind": "file", "path": f"{name}.vtu"}, "material": {"density": f"{DENSITY} kg/m^3"}}
            if mesh.cells.shape[1] == 3:
                entry["element"] = {"thickness": f"{thickness} m"}
            self.case["bodies"].append(entry)
            cells += list(mesh.cells + first)
            parts += [n] * len(mesh.cells)
            first += len(mesh.points)
        (self.path / "body").mkdir()
        listed = []
        for number, time in enumerate(times):
            x, v = motion(X, time)
            self.write(f"body/{number}.vtu", X, x, v, cells, parts)
            listed.append(f'<DataSet timestep="{time!r}" part="0" file="body/{number}.vtu"/>')
        (self.path / "body.pvd").write_text("<Collection>" + "\n".join(listed) + "</Collection>", encoding="utf-8")
        self.write_history(times, columns, bodies, motion, X)
        (self.path / "summary.json").write_text('{"cost": {"steps": 7}}', encoding="utf-8")

    def write(self, name, X, x, v, cells, parts):
        arrays = [data_array(measure.DEFORMED, np.array([1]), "Int32"), data_array("points", x, "Float64"),
                  data_array("displacement", x - X, "Float64"), data_array("velocity", v, "Float64"),
                  data_array("part_id", np.array(parts), "Int32"), data_array("connectivity", np.concatenate(cells), "Int64"),
                  data_array("offsets", np.cumsum([len(cell) for cell in cells]), "Int64")]
        (self.path / name).write_text("\n".join(arrays), encoding="utf-8")

    def write_history(self, times, columns, bodies, motion, X):
        columns = dict(columns or {})
        if "energy_kinetic" not in columns:
            made = [measure.Body(cells, X, DENSITY, 0.0) for cells in self.cells_of(bodies) if cells.shape[1] == 8]
            mass = sum((body.mass for body in made), np.zeros(len(X)))
            columns["energy_kinetic"] = [judge.kinetic(mass, motion(X, time)[1]) for time in times]
        head = ",".join(["time [s]"] + [f"{name} [J]" for name in columns])
        rows = [",".join(repr(float(entry)) for entry in row) for row in zip(times, *columns.values())]
        (self.path / "history.csv").write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")

    @staticmethod
    def cells_of(bodies):
        first, found = 0, []
        for _, mesh in bodies:
            found.append(mesh.cells + first)
            first += len(mesh.points)
        return found

    def finished(self, status=0, said=""):
        return judge.Finished(status, said, self.case, self.path)


def cube(low=(0, 0, 0), size=1.0, cells=(2, 2, 2)):
    return meshes.brick(low, [c + size for c in low], cells)


def still(X, time):
    return X, np.zeros_like(X)


def moved(first, velocity):
    """Nodes from number `first` on go with a velocity, the others stand."""
    def motion(X, time):
        v = np.zeros_like(X)
        v[first:] = velocity
        return X + v * time, v
    return motion


TOUCH = {"contacts": [{"name": "t", "apexes": "a.skin", "base": "b.skin"}]}


def pair(way, contacts=TOUCH, **more):
    """Two cubes, the second over the first; it goes up by `way` in a second."""
    one, other = cube(), cube((0.3, 0.2, 1.0))
    return Folder([("a", one), ("b", other)], moved(len(one.points), (0, 0, way)), case=contacts, **more)


def slid(way, up=0.0):
    """Two cubes side by side, the second of which goes aside by `way` and up by `up` in a second."""
    one, other = cube(), cube((3.0, 0.2, 0.0))
    return Folder([("a", one), ("b", other)], moved(len(one.points), (way, 0, up)), case=TOUCH)


def verdict(folder, expected=None, status=0, said="", **more):
    return judge.verdict_of(folder.finished(status, said), expected or judge.Expected(), **more)


def kinds(folder, expected=None):
    return {fault.kind for fault in judge.faults_of(judge.look(folder.finished(), None), expected or judge.Expected())}


# ------------------------------------------------------------------------------------------------
# Geometry

class Geometry(unittest.TestCase):
    def test_reads_what_is_packed(self):
        values = np.arange(12.0).reshape(4, 3)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "one.vtu"
            path.write_text(data_array("points", values, "Float64"), encoding="utf-8")
            self.assertTrue(np.array_equal(measure.read_arrays(path, {"points"})["points"], values))

    def test_frames_of_today_and_older_ones_give_the_same_positions(self):
        made = Folder([("a", cube())], moved(0, (0.25, 0, 0)))
        frames, parts, X = measure.read_frames(made.path)
        self.assertTrue(np.array_equal(X, cube().points))
        self.assertTrue(np.array_equal(frames[-1].x, X + (0.25, 0, 0)))
        for number, frame in enumerate(frames):
            arrays = [data_array("points", X, "Float64"), data_array("displacement", frame.x - X, "Float64"),
                      data_array("velocity", frame.v, "Float64"), data_array("part_id", np.zeros(len(parts[0])), "Int32"),
                      data_array("connectivity", parts[0].ravel(), "Int64"),
                      data_array("offsets", 8 * np.arange(1, 1 + len(parts[0])), "Int64")]
            (made.path / f"body/{number}.vtu").write_text("\n".join(arrays), encoding="utf-8")
        older, older_parts, older_X = measure.read_frames(made.path)
        self.assertTrue(np.array_equal(older_X, X) and np.array_equal(older_parts[0], parts[0]))
        self.assertTrue(all(np.array_equal(one.x, other.x) for one, other in zip(frames, older)))

    def test_mass_and_depth_of_an_element(self):
        mesh = meshes.brick((0, 0, 0), (2, 3, 1), (2, 3, 4))
        body = measure.Body(mesh.cells, mesh.points, DENSITY)
        self.assertAlmostEqual(body.mass.sum(), 6 * DENSITY)
        self.assertAlmostEqual(body.depth, 0.25)

    def test_the_closest_triangle_is_that_of_all_also_where_distances_are_round_off(self):
        chance = np.random.default_rng(1)
        triangles = 0.03 + chance.random((300, 1, 3)) + 0.1 * chance.standard_normal((300, 3, 3))
        on = triangles[:, 0] + 0.3 * (triangles[:, 1] - triangles[:, 0]) + 0.3 * (triangles[:, 2] - triangles[:, 0])
        flat = np.array([[(x, y, 0.03), (x + 0.1, y, 0.03), (x, y + 0.1, 0.03)] for x in (0, 0.1, 0.2) for y in (0, 0.1, 0.2)])
        level = np.array([(0.1 * i / 7, 0.03, 0.03 + 1e-18 * i) for i in range(20)])
        for points, those in ((chance.random((200, 3)), triangles), (on, triangles), (level, flat)):
            found, away = measure.closest(points, those), measure.all_distances(points, those)
            self.assertTrue(np.array_equal(found[:, 0], away.min(axis=1)))

    def test_overlap_of_two_cubes(self):
        for depth in (1e-9, 0.01, 0.2):
            one, other = cube(), cube((0.3, 0.2, 1.0 - depth))
            x = np.concatenate([one.points, other.points])
            bodies = [measure.Body(cells, x, 1.0) for cells in Folder.cells_of([("a", one), ("b", other)])]
            self.assertAlmostEqual(measure.overlap(*bodies, x)[0] / depth, 1, places=5)

    def test_an_overlap_is_held_against_the_element_there_and_not_a_flat_one_elsewhere(self):
        upper = meshes.brick((0, 0, 0), (1, 1, 1), (1, 1, 1))
        lower = meshes.grid(np.array([-3.0, -2.999, -1.0, 2.0]), np.array([-1.0, 2.0]), np.array([-1.0, 0.0]))
        for at, expected in ((0.0, 0.01), (-3.5, 10.0)):  # over the wide element, and over the narrow one
            x = np.concatenate([upper.points + (at, 0, -0.01), lower.points])
            bodies = [measure.Body(cells, x, 1.0) for cells in Folder.cells_of([("a", upper), ("b", lower)])]
            deep, _, part = measure.overlap(*bodies, x)
            self.assertAlmostEqual(deep, 0.01, places=9)
            self.assertAlmostEqual(part / expected, 1, places=6)
            self.assertAlmostEqual(measure.overlap(*bodies, x, allowed=0.004)[2] / expected, 0.6, places=6)

    def test_no_overlap_at_a_distance_however_small(self):
        one, other = cube(), cube((0.3, 0.2, 1.0 + 1e-12))
        x = np.concatenate([one.points, other.points])
        bodies = [measure.Body(cells, x, 1.0) for cells in Folder.cells_of([("a", one), ("b", other)])]
        self.assertEqual(measure.overlap(*bodies, x)[0], 0)

    def test_edges_that_cross_are_seen_though_no_node_is_inside(self):
        made = scenes.crossing(angle=90.0).meshes
        a, b = made["a.vtu"], made["b.vtu"]
        w = scenes.SIZE / 2 * 2 ** 0.5
        upper, lower = a.points + (0, 0, w - 5e-4), b.points @ judge.rotation((0, 0, 1), np.pi / 2).T - (0, 0, w - 5e-4)
        x = np.concatenate([upper, lower])
        bodies = [measure.Body(cells, x, 1.0) for cells in Folder.cells_of([("a", a), ("b", b)])]
        nodes_inside = measure.points_inside(upper, measure.closed_surface(bodies[1], x))
        self.assertEqual(len(nodes_inside[np.abs(nodes_inside[:, 0]) > 1e-6]), 0)
        self.assertAlmostEqual(measure.overlap(*bodies, x)[0], 1e-3 / 2 ** 0.5, delta=1e-4)

    def test_plates_have_their_thickness(self):
        plate, block = meshes.sheet((-1, -1), (2, 2), (3, 3)), cube((0, 0, 0.03))
        x = np.concatenate([plate.points, block.points])
        thin, solid = Folder.cells_of([("p", plate), ("b", block)])
        bodies = [measure.Body(thin, x, 1.0, 0.1), measure.Body(solid, x, 1.0)]
        self.assertAlmostEqual(measure.overlap(*bodies, x)[0], 0.02, places=9)

    def test_a_rim_is_round_where_a_contact_says_how_deep_it_went(self):
        plate, block = meshes.sheet((0, 0), (1, 1), (2, 2)), cube((1.02, 0, -0.5))
        x = np.concatenate([plate.points, block.points])
        thin, solid = Folder.cells_of([("p", plate), ("b", block)])
        plate, block = measure.Body(thin, x, 1.0, 0.1), measure.Body(solid, x, 1.0)
        self.assertEqual(measure.overlap(plate, block, x)[0], 0)
        self.assertAlmostEqual(measure.depth_of_rounded(plate, block, x), 0.03, places=9)
        x[plate.nodes, 0] += 0.05
        self.assertAlmostEqual(measure.depth_of_rounded(plate, block, x), 0.08, places=9)

    def test_a_corner_that_came_through_a_plate_is_seen_between_its_nodes(self):
        plate, block = meshes.sheet((-1, -1), (2, 2), (1, 1)), cube((0.1, 0.2, -0.001))
        x = np.concatenate([plate.points, block.points])
        thin, solid = Folder.cells_of([("p", plate), ("b", block)])
        plate, block = measure.Body(thin, x, 1.0, 1e-3), measure.Body(solid, x, 1.0)
        self.assertAlmostEqual(measure.through_plate(block, plate, x), 1.5e-3, places=12)
        self.assertEqual(measure.through_plate(plate, block, x), 0)
        up = x + np.where(np.isin(np.arange(len(x)), block.nodes), 0.0011, 0.0)[:, None] * (0, 0, 1)
        self.assertEqual(measure.through_plate(block, plate, up), 0)

    def test_a_crease_of_a_plate_is_as_deep_as_an_edge_is_behind_it_and_not_as_its_ends_stand_out(self):
        plate, block = meshes.sheet((-2, -2), (2, 2), (8, 8)), meshes.brick((-0.99, -0.98, 0.03), (1.01, 1.02, 1.03), (1, 1, 1))
        plate = plate.mapped(lambda x, y, z: (x, y, 0.05 if abs(x) < 1e-9 else 0.0))
        x = np.concatenate([plate.points, block.points])
        thin, solid = Folder.cells_of([("p", plate), ("b", block)])
        deep = measure.through_plate(measure.Body(solid, x, 1.0), measure.Body(thin, x, 1.0, 1e-3), x)
        self.assertAlmostEqual(deep, 0.02 + 0.5e-3, delta=2e-3)

    def test_an_edge_through_a_foil_is_seen_between_its_samples(self):
        foil, block = meshes.brick((-1, -1, 0), (2, 2, 1e-6), (1, 1, 1)), cube((1.1, 1.2, -0.33), 0.5, (1, 1, 1))
        x = np.concatenate([foil.points, block.points])
        bodies = [measure.Body(cells, x, 1.0) for cells in Folder.cells_of([("f", foil), ("b", block)])]
        self.assertAlmostEqual(measure.overlap(*bodies, x)[0], 0.5e-6, places=12)

    def test_rotated_bodies_of_any_kind(self):
        turn = judge.rotation((1, 2, 3), 1.1)
        mesh = meshes.prism([(0, 0), (1, 0), (0, 1)], 1.0, 2)
        body = measure.Body(mesh.cells, mesh.points, 1.0)
        self.assertAlmostEqual(body.volumes.sum(), 0.5)
        inside = np.array([[0.2, 0.5, 0.2], [0.9, 0.5, 0.9]]) @ turn.T
        self.assertEqual(len(measure.points_inside(inside, measure.closed_surface(body, mesh.points @ turn.T))), 1)

    def test_a_body_in_itself(self):
        mesh = meshes.brick((0, 0, 0), (8, 1, 1), (8, 1, 1))
        body = measure.Body(mesh.cells, mesh.points, 1.0)
        self.assertEqual(measure.self_overlap(body, mesh.points), 0)
        folded = mesh.points.copy()
        angle = folded[:, 0] / 8 * 2 * np.pi * 1.05
        radius = 2.0 + folded[:, 2]
        folded = np.stack([radius * np.sin(angle), folded[:, 1] + 0.2 * folded[:, 0] / 8, radius * np.cos(angle)], axis=1)
        self.assertGreater(measure.self_overlap(body, folded), 0.1)

    def test_strain_energy_is_that_of_a_bar_a_bend_and_a_twist(self):
        young, poisson, s = 1e6, 0.3, 1e-3
        mesh = cube(cells=(1, 1, 1))
        turn = judge.rotation((1, 2, 3), 0.7)

        def energy(move):
            x = np.array([point + s * np.array(move(*(point - 0.5))) for point in mesh.points])
            body = measure.Body(mesh.cells, mesh.points, 1.0)
            return float(measure.strain_energies(body, x @ turn.T, mesh.points, young, poisson)[0])

        shear = young / 2 / (1 + poisson)
        for move, known in ((lambda x, y, z: (x, -poisson * y, -poisson * z), young / 2),  # a bar
                            (lambda x, y, z: (y, 0, 0), shear / 2),
                            (lambda x, y, z: (x * y, 0, 0), young / 24),                   # bent
                            (lambda x, y, z: (0, -x * z, x * y), 2 * shear / 24),          # twisted: two shear strains of a half
                            (lambda x, y, z: (0, 0, 0), 0.0)):
            self.assertAlmostEqual(energy(move) / s**2 / young, known / young, delta=2e-3)

    def test_energy_above_that_of_the_neighbours(self):
        mesh = meshes.brick((0, 0, 0), (3, 1, 1), (3, 1, 1))
        body = measure.Body(mesh.cells, mesh.points, 1.0)
        self.assertAlmostEqual(measure.above_neighbours(body, np.array([2.0, 2.0, 2.0])), 0)
        self.assertAlmostEqual(measure.above_neighbours(body, np.array([0.0, 1.0, 0.0])), 0.5)

    def test_an_element_inside_out(self):
        mesh = cube()
        body = measure.Body(mesh.cells, mesh.points, 1.0)
        self.assertAlmostEqual(measure.inside_out(body, mesh.points, mesh.points), 1)
        x = mesh.points.copy()
        x[0] += 0.6
        self.assertLess(measure.inside_out(body, x, mesh.points), 0)


# ------------------------------------------------------------------------------------------------
# Faults

class Faults(unittest.TestCase):
    def test_nothing_is_wrong_with_bodies_that_part(self):
        self.assertEqual(verdict(pair(0.5))[0], judge.GOOD)

    def test_overlap_beyond_half_an_element(self):
        self.assertEqual(kinds(pair(-0.2)), set())
        self.assertEqual(kinds(pair(-0.3)), {"overlap"})
        self.assertEqual(kinds(pair(-0.3, contacts={})), set())
        self.assertEqual(kinds(pair(-0.3, contacts={}), judge.Expected(pairs=[("a", "b")])), {"overlap"})

    def test_an_overlap_that_is_accepted_counts_after_the_bodies_have_parted(self):
        accepts = {"contacts": [{**TOUCH["contacts"][0], "initial_penetration": "accept"}]}

        def path(*heights):
            one, other = cube(), cube((0.3, 0.2, 1.0))

            def motion(X, t):
                x = X.copy()
                x[len(one.points):, 2] += heights[int(t)]
                return x, np.zeros_like(X)
            return Folder([("a", one), ("b", other)], motion, [float(t) for t in range(len(heights))], case=accepts)
        self.assertEqual(kinds(path(-0.3, -0.35)), set())
        self.assertEqual(kinds(path(-0.3, 0.1, -0.2)), set())
        self.assertEqual(kinds(path(-0.3, 0.1, -0.3)), {"overlap"})

    def test_energy_that_grows(self):
        free = Folder([("a", cube())], lambda X, t: (X, np.full_like(X, 1.0 + 0.01 * t)))
        self.assertIn("energy", kinds(free))
        little = Folder([("a", cube())], lambda X, t: (X, np.full_like(X, 1.0 + 1e-12 * t)))
        self.assertEqual(kinds(little, judge.Expected(scale=1500.0)), set())

    def test_energy_is_held_against_the_bodies_that_touch(self):
        one, other, ship = cube(), cube((0.3, 0.2, 1.1)), cube((10, 10, 10), 5.0)
        first, last = len(one.points), len(one.points) + len(other.points)

        def motion(X, t):
            v = np.zeros_like(X)
            v[first:last, 2], v[last:, 0] = 1.0 + 0.1 * t, 100.0
            return X + np.array([[0, 0, 0.0]]), v
        held = {**TOUCH, "planes": [{"name": "h", "kind": "fixed", "nodes": ["a"]}]}
        self.assertIn("energy", kinds(Folder([("a", one), ("b", other), ("ship", ship)], motion, case=held)))

    def test_kinetic_energy_is_our_own(self):
        lying = Folder([("a", cube())], moved(0, (1, 0, 0)), columns={"energy_kinetic": [400.0, 400.0]})
        self.assertIn("energy", kinds(lying))

    def test_stores_and_work_from_outside_count(self):
        def motion(X, t):
            return X, np.full_like(X, 0.0) + (0, 0, 1.0 + t)
        gained = {"energy_kinetic": [500.0, 2000.0]}
        held = {"planes": [{"name": "h", "kind": "fixed", "nodes": ["a"]}]}
        for columns, wrong in (({}, True), ({"energy_gravity_potential": [0.0, -1500.0]}, False),
                               ({"energy_a_elastic": [1500.0, 0.0]}, False), ({"energy_a_elastic": [0.0, -1500.0]}, True)):
            with self.subTest(columns=columns):
                self.assertEqual("energy" in kinds(Folder([("a", cube())], motion, columns={**gained, **columns}, case=held)), wrong)

    def test_energy_that_one_source_creates_and_another_loses(self):
        columns = {"energy_created_t": [0.0, 20.0], "energy_created_a": [0.0, -20.0]}
        self.assertIn("energy", kinds(Folder([("a", cube())], moved(0, (1, 0, 0)), columns=columns), judge.Expected(scale=500.0)))

    def test_momenta(self):
        self.assertEqual(kinds(Folder([("a", cube())], moved(0, (1, 0, 0))), judge.Expected(scale=500.0)), set())
        slower = Folder([("a", cube())], lambda X, t: (X, np.full_like(X, 1.0 - 1e-9 * t)))
        self.assertEqual(kinds(slower, judge.Expected(scale=1500.0)), {"momentum"})

        def spins_less(X, t):
            return X, (1 - 1e-9 * t) * np.stack([0.5 - X[:, 1], X[:, 0] - 0.5, 0 * X[:, 2]], axis=1)
        self.assertEqual(kinds(Folder([("a", cube())], spins_less), judge.Expected(scale=300.0)), {"momentum"})
        held = {"planes": [{"name": "h", "kind": "fixed", "nodes": ["a"]}]}
        self.assertEqual(kinds(Folder([("a", cube())], spins_less, case=held), judge.Expected(scale=300.0)), set())

    def test_numbers_that_are_not_finite(self):
        bad = Folder([("a", cube())], lambda X, t: (X * (np.nan if t else 1), np.zeros_like(X)), columns={"energy_kinetic": [0, 0]})
        self.assertEqual(kinds(bad), {"finite"})

    def test_answers(self):
        def expect(*answer):
            return judge.Expected(answers=[answer], scale=1e6)
        up = pair(0.5)
        for answer, wrong in ((("moves", "b", (0, 0, 1), 0.5, 0.01), False), (("moves", "b", (0, 0, 1), -0.5, 0.01), True),
                              (("stands", "b", (0, 0, 1), 0.5, 0.01), False), (("stands", "b", (0, 0, 1), 0.0, 0.01), True),
                              (("untouched", "b"), False), (("returns", "b", (0, 0, 1), -0.5, 0.9, 1.1), False),
                              (("returns", "b", (0, 0, 1), 0.5, 0.9, 1.1), True), (("stays", "b", (0, 0, 1), 1.0, 0.0), False),
                              (("stays", "b", (0, 0, -1), -2.0, 0.1), True), (("side", "b", "a"), False),
                              (("no_lower", "b", (0, 0, -1), -0.2), True), (("no_faster", "b", (0, 0, 1), 0.4), True),
                              (("keeps_shape", "b", 1e-9), False), (("cheap", 7), False), (("cheap", 6), True),
                              (("separates", "a", "b", (0, 0, 1), -2.0, -0.5), False), (("separates", "a", "b", (0, 0, 1)), True)):
            with self.subTest(answer=answer):
                self.assertEqual("answer" in kinds(up, expect(*answer)), wrong)
        through = pair(-3.0, times=(0.0, 0.5, 1.0))
        self.assertIn("answer", kinds(through, expect("side", "b", "a")))
        self.assertIn("answer", kinds(through, expect("order", "b", "a", (0, 0, 1))))
        self.assertNotIn("answer", kinds(up, expect("order", "b", "a", (0, 0, 1))))


    def test_a_body_that_slides_is_held_against_the_normal_impulse(self):
        def slid_by(friction, lands=0.0, right=True):
            one, floor = cube(), cube((0.0, 0.0, -1.0))
            case = {**TOUCH, "gravity": ["0 m/s^2", "0 m/s^2", "-2 m/s^2"],
                    "initial": [{"body": "a", "velocity": ["3", "0", "0"], "unit": "m/s"}]}

            def motion(X, time):
                v = np.zeros_like(X)
                v[:len(one.points)] = (3 - friction * (2 * time + lands * time) + (0 if right else 0.1 * time), 0, lands * time)
                return X, v
            return Folder([("a", one), ("b", floor)], motion, times=(0.0, 0.5, 1.0), case=case)

        def said(folder, friction=0.25):
            return judge.slides(judge.look(folder.finished(), None), "a", friction, 0.03)
        self.assertIsNone(said(slid_by(0.25)))
        self.assertIsNone(said(slid_by(0.25, lands=-0.4)))  # it is not yet carried by the floor alone
        self.assertIn("expected", said(slid_by(0.25, right=False)))
        self.assertIn("expected", said(slid_by(0.25), friction=0.3))

    def test_what_drags_a_body_is_held_against_its_friction(self):
        def said(drive, friction=0.5):
            columns = {"drive": [0.0, drive / 2, drive], "load": [0.0, -10.0, -20.0]}
            still = Folder([("a", cube())], lambda X, t: (X, np.zeros_like(X)), times=(0.0, 0.5, 1.0), columns=columns)
            return judge.drags(judge.look(still.finished(), None), "a", friction, 0.03, "drive", "load")
        self.assertIsNone(said(10.0))
        self.assertIsNone(said(10.25))
        self.assertIn("0.55 of the normal force", said(11.0))
        self.assertIsNone(said(0.05, friction=0.0))
        self.assertIn("is dragged", said(0.1, friction=0.0))

    def test_what_is_left_of_a_spin(self):
        mesh = cube()

        def motion(X, time):
            away = X - X.mean(axis=0)
            return X, (1 - 0.1 * time) * np.cross((0, 0, 2.0), away)
        spun = judge.look(Folder([("a", mesh)], motion).finished(), None)
        self.assertIsNone(judge.spins(spun, "a", (0, 0, 1), 0.89, 0.91))
        self.assertIn("0.9 of its spin", judge.spins(spun, "a", (0, 0, 1), 0.95, 1.05))


# ------------------------------------------------------------------------------------------------
# Verdicts

WARNING = ("warning: t: node 7 had a penetration of {:.3g} m, 0.6 of the depth of an element, at 0.001 s: the penalty is too soft or "
           "the approach is too fast\n")
STOP = "scene: stopped at 0.1 s: energy_created in t: created 6 % of the initial kinetic energy (30 J of 500 J); the limit is 5 %\n"
REFUSAL = ("case.yaml:3:1: 3 of 9 apexes start penetrated, by 0.1 m at most: move the bodies apart, or say "
           "'initial_penetration: accept'\n")


class Verdicts(unittest.TestCase):
    def test_wrong_in_silence_is_broken(self):
        self.assertEqual(verdict(pair(-0.3))[0], judge.BROKEN)

    def test_a_true_warning(self):
        for depth in (0.3, 0.2, 0.55):
            self.assertEqual(verdict(pair(-0.3), said=WARNING.format(depth))[0], judge.WARNED)

    def test_a_false_warning(self):
        for depth in (0.1, 0.7):
            found, reason, *_ = verdict(pair(-0.3), said=WARNING.format(depth))
            self.assertEqual(found, judge.BROKEN)
            self.assertIn("false warning", reason)
        self.assertEqual(verdict(pair(0.5), said=WARNING.format(0.3))[0], judge.BROKEN)

    def test_what_is_deeper_than_a_body_is_thick_has_no_other_bound(self):
        for depth, found in ((0.55, judge.WARNED), (3.0, judge.WARNED), (0.1, judge.BROKEN)):
            self.assertEqual(verdict(pair(-0.5), said=WARNING.format(depth))[0], found)

    def test_a_warning_is_looked_at_more_closely(self):
        closer = pair(-0.3)
        self.assertEqual(verdict(pair(-0.1), said=WARNING.format(0.3), again=lambda change: closer.finished())[0], judge.WARNED)

    def test_a_warning_that_names_a_time_is_looked_at_then(self):
        asked, at_time = [], pair(-0.3)

        def again(change):
            asked.append(change)
            return (pair(-0.1) if change == "frames" else at_time).finished()
        self.assertEqual(verdict(pair(-0.1), said=WARNING.format(0.3), again=again)[0], judge.WARNED)
        self.assertEqual(asked, ["frames", 0.001])

    def test_a_swing_of_the_kinetic_energy_is_held_against_the_history_and_covers_no_more_than_it_names(self):
        said = ("warning: time integration: the staggering error of the kinetic energy reached 6 % of the energy of the scene, 500 J; "
                "it goes with the square of the step\n")
        for swing, rise, found in ((0.06, 0.065, judge.WARNED), (0.001, 0.065, judge.BROKEN), (0.06, 0.3, judge.BROKEN)):
            with self.subTest(swing=swing, rise=rise):
                columns = {"energy_a_elastic": [500.0, 500.0 * (1 + rise)], "energy_integration": [0.0, 500.0 * swing]}
                still = Folder([("a", cube())], lambda X, t: (X, np.zeros_like(X)), columns=columns)
                self.assertEqual(verdict(still, judge.Expected(scale=500.0), said=said)[0], found)

    def test_a_swing_that_the_history_tells_is_no_fault_up_to_its_own_limit(self):
        for swing, rise, found in ((0.04, 0.045, judge.GOOD), (0.0, 0.045, judge.BROKEN), (0.06, 0.065, judge.BROKEN)):
            with self.subTest(swing=swing, rise=rise):
                columns = {"energy_a_elastic": [500.0, 500.0 * (1 + rise)], "energy_integration": [0.0, 500.0 * swing]}
                still = Folder([("a", cube())], lambda X, t: (X, np.zeros_like(X)), columns=columns)
                self.assertEqual(verdict(still, judge.Expected(scale=500.0))[0], found)

    def test_round_off_is_measured_and_covers_a_small_difference_from_a_twin_only(self):
        one, other = cube((1000, 0, 0)), cube((1000.3, 0.2, 1.0))
        places = [("a", one), ("b", other)]
        motion = moved(len(one.points), (0, 0, 0.5))
        said = "warning: a: this far from the origin, positions are rounded by {:.2g} m, 1e-12 of an element, and contact magnifies that\n"
        for claimed, way, found in ((1.1e-13, 0.505, judge.WARNED), (1.1e-12, 0.505, judge.BROKEN), (1.1e-13, 0.6, judge.BROKEN)):
            with self.subTest(claimed=claimed, way=way):
                far = Folder(places, motion, case=TOUCH)
                self.assertEqual(verdict(far, said=said.format(claimed), twin=(pair(way).finished(), 1.0, 1e-6))[0], found)

    def test_coarse_apexes_are_warned_of_and_excuse_nothing(self):
        said = "warning: touch: its apexes are 1.33 times as far apart as the nodes of its base, so that: exchange, or take 'passes: two'\n"
        one, other, deep = cube(), cube((0, 0, 1.0)), cube((0, 0, 0.7))
        for second, found in ((other, judge.GOOD), (deep, judge.BROKEN)):
            rests = Folder([("a", one), ("b", second)], lambda X, t: (X, np.zeros_like(X)), case=TOUCH)
            self.assertEqual(verdict(rests, said=said)[0], found)

    def test_a_warning_does_not_cover_momentum(self):
        one, other = cube(), cube((0.3, 0.2, 1.0))

        def slows(X, t):
            v = np.zeros_like(X)
            v[len(one.points):, 2] = -0.3 * (1 - 1e-8 * t)
            return X + v * t, v
        folder = Folder([("a", one), ("b", other)], slows, case=TOUCH)
        found, reason, *_ = verdict(folder, said=WARNING.format(0.3))
        self.assertEqual(found, judge.BROKEN)
        self.assertIn("momentum", reason)

    def test_refusals(self):
        folder = pair(0.5)
        self.assertEqual(verdict(folder, status=2, said=REFUSAL, initial=0.1)[0], judge.REFUSED)
        self.assertEqual(verdict(folder, status=2, said=REFUSAL, initial=0.0)[0], judge.BROKEN)
        self.assertEqual(verdict(folder, status=2, said="something is wrong\n")[0], judge.BROKEN)

    def test_stops(self):
        folder, wrong = pair(0.5), pair(-0.3)
        self.assertEqual(verdict(folder, status=3, said=STOP, again=lambda change: wrong.finished())[0], judge.REFUSED)
        for passes, expected in ((("half", "quarter"), judge.BROKEN), (("mesh",), judge.BROKEN), (("half",), judge.REFUSED),
                                 (("quarter",), judge.REFUSED)):
            found, reason, *_ = verdict(folder, status=3, said=STOP, again=lambda asked: (folder if asked in passes else wrong).finished())
            self.assertEqual(found, expected, passes)
            self.assertEqual("without cause" in reason, expected == judge.BROKEN)
        self.assertEqual(verdict(folder, status=3, said="scene: stopped\n", again=lambda change: wrong.finished())[0], judge.BROKEN)

    def test_a_stop_for_an_overlap_that_is_there_has_a_cause_whatever_a_finer_mesh_does(self):
        said = "scene: stopped at 1 s: bodies_overlap in a: a and b overlap by {} m, 0.6 of an element; the limit is 0.5 of an element\n"
        fine = pair(0.5)
        for way, claimed, found in ((-0.3, 0.3, judge.REFUSED), (-0.3, 0.14, judge.BROKEN), (-0.2, 0.2, judge.REFUSED),
                                    (-0.1, 0.1, judge.BROKEN)):
            with self.subTest(way=way, claimed=claimed):
                stopped = verdict(pair(way), status=3, said=said.format(claimed), again=lambda change: fine.finished())
                self.assertEqual(stopped[0], found)

    def test_a_stop_for_an_inversion_has_a_cause_if_shorter_steps_come_to_it_too(self):
        said = ("scene: stopped at 1 s: inverted_element in a, element 0: the Jacobian of a corner is -0.05 of the reference; the limit "
                "is 0\n")

        def bent(left):  # a corner of the unit cube that goes in by s has 1 - 3 s of its Jacobian left
            def motion(X, t):
                v = np.zeros_like(X)
                v[0] = (1 - left) / 3
                return X + v * t, v
            return Folder([("a", cube(cells=(1, 1, 1)))], motion)

        stops, near, far = bent(-0.05), bent(0.05), bent(0.2)
        inverts = stops.finished(3, said)
        comes_near, passes = near.finished(), far.finished()
        for half, quarter, seen, found in ((comes_near, comes_near, stops, judge.REFUSED), (inverts, inverts, stops, judge.REFUSED),
                                           (comes_near, inverts, stops, judge.REFUSED), (comes_near, passes, stops, judge.BROKEN),
                                           (comes_near, comes_near, near, judge.BROKEN)):
            again = {"half": half, "quarter": quarter, "mesh": passes}.get
            self.assertEqual(verdict(seen, status=3, said=said, again=again)[0], found)

    def test_a_warning_of_a_thickness_is_held_against_the_areas(self):
        said = "warning: p: plates keep their thickness, but with the strain of element 0 it would be {:.3g} of the initial one at 1 s\n"
        grown = Folder([("p", meshes.sheet((0, 0), (1, 1), (2, 2)))], lambda X, t: (X * (1 + 0.05 * t), 0 * X), thickness=0.1,
                       columns={"energy_kinetic": [0, 0]})
        grown.case["bodies"][0]["material"]["poisson"] = 0.3
        asks = 1.05 ** (-2 * 0.3 / 0.7)
        for claimed, found in ((asks, judge.WARNED), (asks**1.5, judge.BROKEN), (1 / asks, judge.BROKEN)):
            with self.subTest(claimed=claimed):
                self.assertEqual(verdict(grown, said=said.format(claimed))[0], found)

    def test_a_warning_of_distortion_control_is_held_against_its_energy(self):
        said = "warning: a: the energy of distortion control reached {:.3g} of the internal energy (limit 0.01): the shape depends on it\n"
        one = Folder([("a", cube())], still, columns={"energy_a_elastic": [0, 0.9], "energy_a_distortion": [0, 0.1],
                                                      "energy_integration": [0, 0]})
        for claimed, found in ((0.1, judge.WARNED), (0.2, judge.BROKEN), (0.03, judge.BROKEN)):
            with self.subTest(claimed=claimed):
                self.assertEqual(verdict(one, said=said.format(claimed))[0], found)

    def test_a_warning_of_concentrated_energy_is_held_against_the_strains(self):
        said = "warning: {}: {:.3g} of the strain energy of all solids is concentrated in single elements, most of it in this body\n"
        one, other = cube(cells=(5, 5, 5)), cube((3, 0, 0))

        def dented(X, t):  # the elements at one corner of `a` have nearly all of the strain energy
            x = X.copy()
            x[0] += 0.02 * t
            return x, 0 * X
        folder = Folder([("a", one), ("b", other)], dented, columns={"energy_kinetic": [0, 0]})
        for body in folder.case["bodies"]:
            body["material"].update(kind="elastic", young="1e6 Pa", poisson=0.3)
        ours = judge.concentrated_in(judge.look(folder.finished(), None), "a")
        self.assertGreater(ours, 0.17)
        for name, claimed, found in (("a", ours, judge.WARNED), ("a", 1.6 * ours, judge.BROKEN), ("a", ours / 1.6, judge.BROKEN),
                                     ("b", ours, judge.BROKEN)):
            with self.subTest(name=name, claimed=claimed):
                self.assertEqual(verdict(folder, said=said.format(name, claimed))[0], found)

    def test_words_are_those_of_the_program(self):
        source = (ROOT / "lib/model/notes.cpp").read_text(encoding="utf-8")
        source = re.sub(r'"\s*\n\s*"', "", source)  # literals that follow each other are one
        fragments = [*judge.KINDS_OF_NOTES.values(), "of the strain energy of all solids is concentrated in single elements",
                     "bodies of the scene deform plastically, and ", "hourglass energy reached %.3g of the internal energy",
                     "the energy of distortion control reached %.3g of the internal energy", "was pressed by %.3g of Young's modulus"]
        read = {"had a penetration of %.3g m": judge.OF_NODE, "the staggering error of the kinetic energy reached ": judge.OF_SWING,
                "this far from the origin, positions are rounded by": judge.OF_ROUNDING,
                "plates keep their thickness, but with the strain of element": judge.OF_THICKNESS, "a corner of element": judge.OF_CORNER}
        self.assertEqual([one for one in [*fragments, *read] if one not in source], [])
        self.assertEqual([one for one, pattern in read.items() if one.partition("%")[0] not in pattern.pattern], [])

    def test_a_note_changes_no_verdict_and_is_counted(self):
        note = "note: a: hourglass energy above that of the neighbours is 0.09 of the strain energy of all solids; a warning: of nothing\n"
        rests = Folder([("a", cube())], still)
        self.assertEqual(verdict(rests, said=note)[0], judge.GOOD)
        kinds = judge.kinds_of_notes(rests.finished(said=note + note.replace("a:", "b:") + "note: b: other words\n"))
        self.assertEqual(kinds, "2 hourglass, 1 other")
        self.assertEqual(judge.kinds_of_notes(rests.finished(said="warning: a: b\nscene: note: c\n")), "")
        noted = {"cost": {"steps": 7}, "notes": [note.strip(), "a: a warning", "note: touch: 'restitution' gives back"]}
        (rests.path / "summary.json").write_text(json.dumps(noted), encoding="utf-8")
        self.assertEqual(judge.kinds_of_notes(rests.finished(said=note)), "1 hourglass, 1 restitution")
        self.assertEqual(verdict(pair(-0.3), said=note)[0], judge.BROKEN)  # it excuses nothing

    def test_warnings_have_kinds_and_are_true_or_not(self):
        found = verdict(pair(-0.3), said=WARNING.format(0.3) + WARNING.format(0.1))
        self.assertEqual(found.word, judge.BROKEN)
        self.assertEqual([(judge.kind_of(warning), true) for warning, true in found.warnings],
                         [("depth of a node", True), ("depth of a node", False)])
        self.assertEqual(judge.kind_of("a: hourglass energy reached 0.4 of the internal energy, and"), "hourglass")
        for flow in ("", "bodies of the scene deform plastically, and "):
            self.assertEqual(judge.kind_of(f"a: {flow}0.43 of the strain energy of all solids is concentrated in single elements, most"),
                             "concentrated strain energy")
        self.assertEqual(judge.kind_of("something else"), "other")

    def test_a_warning_of_a_hypoelastic_body_is_held_against_its_strains(self):
        said = "warning: a: element 3 was pressed by {:.3g} of Young's modulus at 1 s; beyond 0.5 a hypoelastic law is unstable\n"
        for height, even, claimed, found in ((0.5, False, 0.69, judge.WARNED), (0.9, False, 0.69, judge.BROKEN),
                                             (0.5, False, 0.4, judge.BROKEN), (0.5, False, 2, judge.BROKEN),
                                             (0.6, True, 0.69, judge.BROKEN)):
            side = height if even else height**-0.3  # free sides
            pressed = Folder([("a", cube())], lambda X, t: (X * (1 + t * (np.array([side, side, height]) - 1)), 0 * X),
                             columns={"energy_kinetic": [0, 0]})
            pressed.case["bodies"][0]["material"].update(kind="elastic", poisson=0.3)
            with self.subTest(height=height, even=even, claimed=claimed):
                self.assertEqual(verdict(pressed, said=said.format(claimed))[0], found)

    def test_a_stop_where_nothing_touches(self):
        expected = judge.Expected(answers=[("untouched", "a")])
        self.assertEqual(verdict(pair(0.5), expected, status=3, said=STOP, again=lambda change: pair(-0.3).finished())[0], judge.BROKEN)

    def test_a_stop_that_loses_its_state(self):
        folder = pair(0.5)
        (folder.path / "summary.json").unlink()
        self.assertEqual(verdict(folder, status=3, said=STOP, again=lambda change: None)[0], judge.BROKEN)

    def test_crashes_and_the_clock(self):
        for status in (None, 1, 4, 5, -11):
            self.assertEqual(verdict(pair(0.5), status=status)[0], judge.BROKEN)

    def test_a_twin_that_goes_another_way(self):
        self.assertEqual(verdict(pair(0.5), twin=(pair(0.5).finished(), 1.0, 1e-6))[0], judge.GOOD)
        self.assertEqual(verdict(pair(0.5), twin=(pair(0.6).finished(), 1.0, 1e-6))[0], judge.BROKEN)
        self.assertEqual(verdict(pair(0.5), twin=(pair(0.25).finished(), 2.0, 1e-6))[0], judge.GOOD)

    def test_a_place_that_a_nudge_decides_is_no_fault(self):
        def of(nudged, nudge=1e-9, within=0.1, axis=(1, 0, 0), up=0.0):
            answers = [("stands", "b", axis, 0.0, within), ("stands", "b", (0, 0, 1), 0.0, 0.1)]
            known = judge.Expected(answers=answers, scale=1e6, nudge=nudge)
            return verdict(slid(0.5, up), known, again=lambda change: nudged[judge.NUDGED.index(change)])[0]

        def run(way, up=0.0, status=0):
            return slid(way, up).finished(status)

        self.assertEqual(of([run(0.5), run(0.5), run(0.2)]), judge.GOOD)      # one of three lies elsewhere by half of what it is off
        self.assertEqual(of([run(0.5), run(0.4), run(0.3)]), judge.BROKEN)    # the nudge does not decide it
        self.assertEqual(of([run(0.1), run(0.9), run(0.2)], nudge=0.0), judge.BROKEN)
        self.assertEqual(of([], within=0.6), judge.GOOD)                      # nothing is missed, nothing is run again
        self.assertEqual(of([run(0.1, 0.5), run(0.9), run(0.2)]), judge.BROKEN)            # a nudged run misses a height
        self.assertEqual(of([run(0.1), run(0.9), run(0.2, status=3)]), judge.BROKEN)       # one does not come to its end
        self.assertEqual(of([run(0.1), run(0.9), run(0.2)], axis=(0, 0, 1), up=0.5), judge.BROKEN)  # a height is no place aside

    def test_depth_before_a_run(self):
        made = scenes.drop(gap=-0.001, skins=False)
        self.assertAlmostEqual(judge.initial_depth(made.case, "."), 0.001, places=9)
        self.assertEqual(judge.initial_depth(scenes.drop(gap=0.001, skins=False).case, "."), 0)


class Matrix(unittest.TestCase):
    def test_cells_have_names_of_their_own_and_are_many(self):
        cells = axes.cells()
        self.assertGreaterEqual(len(cells), 500)
        self.assertEqual(len({cell.name() for cell in cells}), len(cells))

    def test_scenes_that_slide_are_many_and_their_meshes_have_volume(self):
        cells = axes.cells("sliding")
        self.assertGreaterEqual(len(cells), 100)
        self.assertTrue(all(cell.make().expected.answers for cell in cells))
        for cell in {cell.scene: cell for cell in cells}.values():
            for mesh in cell.make(2).meshes.values():
                if mesh.cells.shape[1] == 8:
                    self.assertGreater(float(np.min(measure.least_corner(mesh.points[mesh.cells]))), 0)
        self.assertTrue(all(len(mesh.points) > len(small.points) for cell in cells[::20]
                            for mesh, small in zip(cell.make(2).meshes.values(), cell.make().meshes.values())))

    def test_a_seed_makes_one_scene(self):
        for seed in range(5):
            one, other, finer = scenes.thrown(seed=seed), scenes.thrown(seed=seed), scenes.thrown(2, seed=seed)
            self.assertEqual(one.case, other.case)
            self.assertEqual(one.case, finer.case)
            self.assertTrue(all(len(finer.meshes[name].points) > len(mesh.points) for name, mesh in one.meshes.items()))

    def test_meshes_of_all_kinds_have_volume(self):
        for mesh in (meshes.ridge(1, 1, 1, 2), meshes.ridge(179, 1, 1, 2, 2), meshes.valley(90, 1, 1, 2),
                     meshes.prism([(0, 0), (0, 1), (1, 0)], 1, 2), cube()):
            self.assertGreater(float(np.min(measure.least_corner(mesh.points[mesh.cells]))), 0)

    def test_half_the_step_is_half_for_contact_too(self):
        for change, safety, gain in (("half", 0.45, 0.00125), ("quarter", 0.225, 0.0003125)):
            made = command().changed(scenes.drop().case, change)
            self.assertEqual(made["time"]["safety"], safety)
            self.assertEqual(made["contacts"][0]["energy_gain_limit"], gain)
        moved = [[[judge.number(part) for part in body["move"]] for body in case["bodies"]]
                 for case in (scenes.drop().case, *(command().changed(scenes.drop().case, change, 1e-3) for change in judge.NUDGED))]
        self.assertEqual(len({tuple(map(tuple, places)) for places in moved}), 4)
        self.assertTrue(np.allclose(moved[1:], moved[:1], atol=1e-3))
        self.assertTrue(all(place[2] == start[2] for places in moved for place, start in zip(places, moved[0])))


COMMAND = None


def command():
    """scripts/extremes as a module."""
    global COMMAND
    if COMMAND is None:
        COMMAND = made_up.script("extremes")
    return COMMAND


def row(axis, verdict, reason="", note="", warnings=""):
    return {"axis": axis, "verdict": verdict, "reason": reason, "note": note, "warnings": warnings}


ROWS = [row("speed", "good"), row("speed", "good", note="1 hourglass"), row("speed", "warned", warnings="hourglass 2/2; overlap 1/1"),
        row("gap", "refused", "a: 'move' overlaps by 1 m"), row("gap", "refused", "scene: stopped at 0.1 s: bodies_overlap in a: b"),
        row("sliding", "broken", warnings="overlap 0/1"), row("sliding", "good")]


class Tables(unittest.TestCase):
    def test_good_cells_with_a_note_and_runs_that_stopped_are_classes_of_their_own(self):
        self.assertEqual([command().class_of(one) for one in ROWS],
                         ["good", "good with a note", "warned", "refused", "stopped", "broken", "good"])
        self.assertEqual(command().class_of({"axis": "gap", "verdict": "good"}), "good")  # of an older table

    def test_the_table_has_axes_and_both_matrices(self):
        lines = command().table_of(ROWS)
        self.assertEqual(lines[0], "| axis | cells | good | good with a note | warned | refused | stopped | broken |")
        self.assertEqual(lines[2], "| speed | 3 | 1 | 1 | 1 |  |  |  |")
        self.assertEqual(lines[-2], "| **all but sliding** | 5 | 1 (20.0 %) | 1 (20.0 %) | 1 (20.0 %) | 1 (20.0 %) | 1 (20.0 %) |  |")
        self.assertEqual(lines[-1], "| **sliding** | 2 | 1 (50.0 %) |  |  |  |  | 1 (50.0 %) |")
        self.assertIn("good 42.9 % (2 without and 1 with a note), warned 14.3 % (1)", command().shares_of(ROWS))

    def test_true_warnings_are_counted_by_kind(self):
        self.assertEqual(command().warnings_of(ROWS), ["4 warnings, 3 of them true", "    hourglass: 2, true 2", "    overlap: 2, true 1"])
        told = judge.Verdict("broken", "so", [], (("a and b overlap by 1 m", True), ("a and b overlap by 2 m", False)))
        made = command().row_of(axes.cells("shift")[0], told, "1 other")
        self.assertEqual((made["warnings"], made["note"], made["axis"]), ("overlap 1/2", "1 other", "shift"))

    def test_a_page_keeps_what_is_outside_of_the_marks(self):
        self.assertEqual(command().replaced("a\n<b>\nold\n<e>\nc\n", "<b>", "<e>", ["new"]), "a\n<b>\n\nnew\n\n<e>\nc\n")
        self.assertEqual(command().replaced("no marks\n", "<b>", "<e>", ["new"]), "no marks\n")
        page = (ROOT / "verification/extremes/README.md").read_text(encoding="utf-8")
        for mark in (command().BEGIN, command().END, command().BEGIN_FINER, command().END_FINER):
            self.assertEqual(page.count(mark), 1, mark)

    def test_random_scenes_by_automatic_contact_have_defaults(self):
        for cell in axes.at_random(0, 12, (), axes.BY_AUTOMATIC):
            case = cell.make().case
            self.assertEqual([set(contact) - {"friction"} for contact in case["contacts"]], [{"name", "kind"}])
            self.assertEqual(set(case["time"]), {"end"})
            self.assertTrue(all(set(body.get("element", {})) <= {"thickness"} for body in case["bodies"]))
            self.assertEqual(command().of_name(json.dumps(command().key_of(cell))).name(), cell.name())


class FinerMeshes(unittest.TestCase):
    def test_a_seed_draws_the_same_cells_of_each_matrix(self):
        cells = axes.cells()
        drawn = finer.drawn(cells, 60, finer.SEED)
        self.assertEqual([cell.name() for cell in drawn], [cell.name() for cell in finer.drawn(cells, 60, finer.SEED)])
        self.assertEqual(sum(cell.axis == "sliding" for cell in drawn), 60)
        self.assertEqual(len(drawn), 120)
        self.assertNotEqual({cell.name() for cell in drawn}, {cell.name() for cell in finer.drawn(cells, 60, 1)})
        fewer = finer.drawn([cell for cell in cells if cell.axis != "gap"], 60, finer.SEED)
        self.assertTrue({cell.name() for cell in drawn if cell.axis != "gap"} <= {cell.name() for cell in fewer})
        self.assertEqual(len(finer.drawn(axes.cells("distance"), 60, 1)), len(axes.cells("distance")))

    def test_every_body_has_all_of_its_elements_split(self):
        others = [cell for cell in axes.cells() if cell.axis != "sliding"]  # whose curved meshes take seconds each
        for cell in {(cell.axis, cell.scene): cell for cell in others}.values():
            coarse, fine = cell.make(), finer.finer_scene(cell)
            before, after = finer.elements(coarse), finer.elements(fine)
            if "refine" in fine.case:
                self.assertTrue(all(entry["mesh"]["kind"] == "file" for entry in fine.case["bodies"]), cell.name())
                self.assertEqual(before, after, cell.name())  # the program splits them
                continue
            for name, mesh in ((entry["name"], entry["mesh"]) for entry in coarse.case["bodies"] if entry["name"] != "ship"):
                plate = mesh["kind"] == "file" and coarse.meshes[mesh["path"]].cells.shape[1] == 3
                self.assertGreaterEqual(after[name], (4 if plate else 8) * before[name], cell.name())
            self.assertEqual(coarse.case["time"], fine.case["time"], cell.name())

    def test_velocities_and_places_of_answers_are_compared(self):
        def of(way, *answers):
            folder = slid(way)
            return finer.results_of(judge.look(folder.finished(), None), judge.Expected(answers=list(answers)))

        known = of(0.5, ("moves", "b", (1, 0, 0), 0.5, 0.1), ("side", "a", "b"), ("cheap", 7))
        self.assertEqual(list(known), ["velocity of b"])
        self.assertTrue(np.allclose(known["velocity of b"][0], (0.5, 0, 0)))
        self.assertAlmostEqual(known["velocity of b"][1], 0.5)
        self.assertEqual(list(of(0.5, ("side", "a", "b"))), ["velocity of a", "velocity of b"])
        self.assertAlmostEqual(of(0.5, ("stands", "b", (1, 0, 0), 0.0, 0.1))["place of b"][1], 0.5)
        apart = of(0.5, ("separates", "a", "b", (1, 0, 0), 0.0, 1.0))
        self.assertTrue(np.allclose(apart["velocity of b from a"][0], (0.5, 0, 0)))
        moves = ("moves", "b", (1, 0, 0), 0.5, 0.1)
        name, off = finer.change(of(0.4, moves), of(0.5, moves))
        self.assertEqual(name, "velocity of b")
        self.assertAlmostEqual(off, 0.2)

    def test_the_result_that_changes_most_is_the_change(self):
        coarse = {"a": (np.array([1.0, 0.0]), 9.0), "b": (np.array([0.0, 1.0]), 9.0)}
        fine = {"a": (np.array([1.0, 0.1]), 1.0), "b": (np.array([0.0, 1.5]), 2.0)}
        self.assertEqual(finer.change(coarse, fine), ("b", 0.25))
        self.assertEqual(finer.change({"r": (np.zeros(3), 0.0)}, {"r": (np.zeros(3), 0.0)}), ("r", 0.0))

    def test_a_spin_and_a_drag_are_compared(self):
        def spun(X, time):
            return X, (1 - 0.1 * time) * np.cross((0, 0, 2.0), X - X.mean(axis=0))
        folder = Folder([("a", cube())], spun, columns={"energy_kinetic": [0, 0], "drive": [0.0, 10.0], "load": [0.0, -20.0]})
        found = finer.results_of(judge.look(folder.finished(), None), judge.Expected(answers=[("spins", "a", (0, 0, 1), 0.85, 1.0)]))
        self.assertAlmostEqual(found["spin of a"][0][0], 0.9)
        still_folder = Folder([("a", cube())], still, (0.0, 0.5, 1.0), {"drive": [0.0, 5.0, 10.0], "load": [0.0, -10.0, -20.0]})
        drags = judge.Expected(answers=[("drags", "a", 0.5, 0.03, "drive", "load")])
        value, of = finer.results_of(judge.look(still_folder.finished(), None), drags)["drag of a"]
        self.assertAlmostEqual(value[0], 0.5)
        self.assertAlmostEqual(of, 0.5)

    def test_a_table_of_changes(self):
        def of(matrix, verdict, change, note="", reason=""):
            return {"matrix": matrix, "verdict": verdict, "reason": reason, "note": note, "change": change}
        rows = [of("sliding", "good", "0.01"), of("sliding", "good", "0.07"), of("sliding", "good", "", reason=""),
                of("sliding", "good", "0.2", note="1 hourglass"), of("all but sliding", "refused", "", reason="scene: stopped at 1 s: a")]
        lines = finer.table_of(rows)
        self.assertEqual(lines[2:], ["| all but sliding | stopped | 1 |  |  |  |  |",
                                     "| sliding | good | 3 | 2 | 1 (50 %) | 2 (100 %) | 4 % |",
                                     "| sliding | good with a note | 1 | 1 | 0 (0 %) | 0 (0 %) | 20 % |"])


def tearDownModule():
    FOLDER.cleanup()


if __name__ == "__main__":
    unittest.main()
