"""scripts/twins.py and scripts/mesh_files.py: trees of cases, what becomes of directions, and meshes in other forms."""
import doctest
import math
import random
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import mesh_files  # noqa: E402  (after the path)
import twins  # noqa: E402
from twins import Quantity, Texts  # noqa: E402

CUBE = mesh_files.Mesh([[float(x) for x in corner] for corner in mesh_files.CORNERS], [list(range(8))], {"low": [1, 1, 1, 1, 0, 0, 0, 0]},
                       {"region": [3]})


def volume_of_corner(mesh):
    """Of the three edges at the first corner of the first cell."""
    at = [mesh.points[i] for i in mesh.cells[0]]
    return twins.determinant([[at[to][i] - at[0][i] for i in range(3)] for to in (1, 3, 4)])


def leaf(value, unit=None, default=False):
    return {"value": value, "unit": unit, "default": default}


class TwinsTest(unittest.TestCase):
    def test_the_examples_in_the_modules(self):
        for module in (twins, mesh_files):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0)
            self.assertGreater(result.attempted, 0)

    def test_a_resolved_case_is_written_again(self):
        resolved = {"time": {"end": leaf(0.5, "s"), "safety": leaf(0.9, "1", True)}, "relaxation": {"samples": leaf(5, "1", True)},
                    "loads": [{"kind": leaf("pressure"), "surface": leaf("bar.x_high"), "value": leaf('2*table("a b.csv", t)'),
                               "unit": leaf("MPa")}],
                    "mesh": {"cells": leaf([2, 1, 1], "1"), "map": leaf(["x*cos(y)", "atan2(y, x)", "z"]), "rigid": leaf(True)}}
        lines = twins.written(twins.taken(resolved), twins.SI)
        self.assertEqual(lines[:3], ["time:", "  end: 0.5 s", "relaxation: {}"])
        self.assertIn("    value: '(2*(table(\"a b.csv\", t)/(1000000.0)))*(1000000.0)'", lines)
        self.assertIn("    unit: N*m^-2", lines)
        self.assertIn("  cells: [2, 1, 1]", lines)
        self.assertIn('  map: ["x*cos(y)", "atan2(y, x)", z]', lines)
        self.assertIn("  rigid: true", lines)

    def test_a_unit_that_is_not_known_is_told(self):
        with self.assertRaisesRegex(twins.UnknownUnit, "furlong"):
            twins.measure("furlong")

    def test_a_mirror_turns_moments_and_spins_about_and_forces_not(self):
        def vector():
            return Texts(["1", "2", "3"], "N")
        tree = {"bodies": [{"mesh": {"kind": Quantity("box")}}],
                "loads": [{"kind": Quantity("force"), "value": vector()}, {"kind": Quantity("moment"), "value": vector()}],
                "planes": [{"kind": Quantity("driven"), "velocity": {"value": vector()}, "angular_velocity": {"value": vector()}}]}
        twin = twins.moved(tree, twins.reflection((1, 0, 0)))
        values = [[eval(text) for text in one] for one in (twin["loads"][0]["value"], twin["loads"][1]["value"],
                                                          twin["planes"][0]["velocity"]["value"],
                                                          twin["planes"][0]["angular_velocity"]["value"])]
        self.assertEqual(values, [[-1, 2, 3], [1, -2, -3], [-1, 2, 3], [1, -2, -3]])

    def test_a_mirrored_body_stands_at_the_mirror_image_of_each_place(self):
        """By the mesh in a mirror, and the turn and shift that bring it there."""
        matrix = twins.reflection((0.3, -0.7, 0.5))
        for mirror, image in mesh_files.MIRRORS.items():
            body = {"mesh": {"kind": Quantity("file")}, "rotate": {"axis": Quantity([1, 2, 3], "1"), "angle": Quantity(0.7, "rad"),
                                                                  "about": Quantity([0.1, 0.2, 0.3], "m")},
                    "move": Quantity([1, 2, 3], "m")}

            def placed(body, p):
                turn = twins.rotation(body["rotate"]["axis"].value, body["rotate"]["angle"].value)
                about = body["rotate"]["about"].value if "about" in body["rotate"] else [0, 0, 0]
                there = twins.product(turn, [a - b for a, b in zip(p, about)])
                return [a + b + c for a, b, c in zip(there, about, body["move"].value)]

            twin = twins.moved({"bodies": [body]}, matrix, mirror=mirror)["bodies"][0]
            p = [0.4, -0.5, 0.6]
            expected = twins.product(matrix, placed(body, p))
            self.assertLess(max(abs(a - b) for a, b in zip(placed(twin, image(p)), expected)), 1e-14)


class MeshTest(unittest.TestCase):
    def test_a_mesh_is_read_as_it_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "cube.vtu"
            mesh_files.write(path, CUBE)
            self.assertEqual(mesh_files.read(path), CUBE)
            path.write_text(path.read_text().replace('"ascii"', '"appended"'))
            with self.assertRaisesRegex(mesh_files.Unreadable, "cube.vtu is not written as text"):
                mesh_files.read(path)

    def test_mirrored_cells_are_not_inside_out(self):
        for mirror in mesh_files.MIRRORS:
            self.assertGreater(volume_of_corner(mesh_files.mirrored(CUBE, mirror)), 0)

    def test_other_numbers_are_the_same_mesh(self):
        def shuffled(count):
            order = list(range(count))
            random.Random(3).shuffle(order)
            return order
        new, nodes, cells = mesh_files.renumbered(CUBE, shuffled)
        self.assertEqual([new.points[nodes[i]] for i in range(8)], CUBE.points)
        self.assertEqual([new.sets["low"][nodes[i]] for i in range(8)], CUBE.sets["low"])
        self.assertEqual((cells, new.cell_arrays), ([0], {"region": [3]}))
        self.assertGreater(volume_of_corner(new), 0)
        self.assertNotEqual(new.points, CUBE.points)

    def test_sets_of_shapes(self):
        def ring(r, angle, z):
            return (r * math.cos(angle), r * math.sin(angle), z)

        def named(shape, points):
            return {name for name, flags in mesh_files.sets_of_shape(shape, [*points, (7, 7, 7)]).items() if flags[:len(points)] == [1] *
                    len(points)}

        cylinder = {"kind": "cylinder", "radius": 2, "length": 3, "turn": "quarter"}
        self.assertEqual(named(cylinder, [ring(2, 0.3, 3)]), {"side", "top"})
        self.assertEqual(named(cylinder, [(0, 1, 1)]), {"x_plane"})
        sector = {"kind": "sector", "radius": 2, "length": 3, "angle": 0.5}
        self.assertEqual(named(sector, [ring(1, 0.5, 1)]), {"second_plane"})
        self.assertEqual(named(sector, [(0, 0, 0)]), {"bottom", "axis", "first_plane", "second_plane"})
        self.assertEqual(named({"kind": "disc", "radius": 2, "turn": "full"}, [(0, 0, 0)]), {"centre"})
        self.assertEqual(named({"kind": "sphere", "radius": 2, "turn": "eighth"}, [(0, 0, 2)]), {"surface", "x_plane", "y_plane"})
        plug = {"kind": "revolved", "radii": [1, 2, 3], "heights": [0, 1, 2], "filled": ["x.", "xx"], "angle": 2 * math.pi}
        self.assertEqual(named(plug, [ring(2.5, 1, 1)]), {"up_1"})  # the shoulder
        self.assertEqual(named(plug, [ring(2, 1, 1.5)]), {"out_1"})
        self.assertEqual(named(plug, [ring(3, 1, 0)]), {"out_2", "down_0"})
        with self.assertRaises(mesh_files.Unreadable):
            mesh_files.sets_of_shape({"kind": "torus"}, [(0, 0, 0)])


if __name__ == "__main__":
    unittest.main()
