"""scripts/mesh_files.py: meshes of files split apart from the program."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
sys.dont_write_bytecode = True
import mesh_files  # noqa: E402  (after the path)

CUBE = mesh_files.Mesh([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], [[0, 1, 3, 2, 4, 5, 7, 6]],
                       {"low": [1, 1, 1, 1, 0, 0, 0, 0]}, {"region": [7]})


class SplitTest(unittest.TestCase):
    def test_a_cube_becomes_eight_whose_sets_and_arrays_follow(self):
        fine = mesh_files.split(mesh_files.split(CUBE))
        self.assertEqual((len(fine.cells), len(fine.points)), (64, 125))
        self.assertEqual(sum(fine.sets["low"]), 25)
        self.assertTrue(all(fine.points[n][2] == 0 for n, flag in enumerate(fine.sets["low"]) if flag))
        self.assertEqual(fine.cell_arrays["region"], [7] * 64)
        for cell in fine.cells:
            low, high = fine.points[cell[0]], fine.points[cell[6]]
            self.assertEqual([b - a for a, b in zip(low, high)], [0.25] * 3)

    def test_triangles_and_quadrilaterals_keep_their_area(self):
        flat = mesh_files.Mesh([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], [[0, 1, 2, 3], [0, 1, 2]], {})
        fine = mesh_files.split(flat)
        self.assertEqual(sorted(map(len, fine.cells)), [3] * 4 + [4] * 4)
        self.assertEqual(len(fine.points), 4 + 5 + 1)  # with the diagonal, which is the side of the triangle

    def test_names_of_groups_survive_writing_splitting_and_other_numbers(self):
        named = mesh_files.Mesh(CUBE.points, CUBE.cells, {}, {"region": [7], "number": [1.0]}, {"steel": (7, 3)})
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "named.vtu"
            mesh_files.write(path, named)
            read = mesh_files.read(path)
        self.assertEqual((read.groups, read.cell_arrays), ({"steel": (7, 3)}, {"region": [7]}))  # arrays of reals are not read
        self.assertEqual(mesh_files.split(read).groups, read.groups)
        self.assertEqual(mesh_files.mirrored(read).groups, read.groups)
        self.assertEqual(mesh_files.renumbered(read, lambda n: list(range(n)))[0].groups, read.groups)

    def test_collapsed_cells_are_none_of_its(self):
        with self.assertRaises(mesh_files.Unreadable):
            mesh_files.split(mesh_files.Mesh(CUBE.points, [[0, 1, 2, 2, 4, 5, 6, 6]], {}))


if __name__ == "__main__":
    unittest.main()
