"""scripts/cells.py: what of a case, as a driver resolved it, a factor makes finer, and what it leaves as it is."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
sys.dont_write_bytecode = True
import cells  # noqa: E402  (after the path)


def entry(value):
    return {"value": value, "unit": "1", "default": False}


def body(name, rigid=False, **mesh):
    return {"name": entry(name), "rigid": entry(rigid), "mesh": {key: entry(value) for key, value in mesh.items()}}


FILE = body("a", kind="file", path="a.vtu")
BOX = body("b", kind="box", cells=[4, 1, 2])
BRICK = body("c", kind="box", cells=[1, 1, 1])
WALL = body("d", True, kind="box", cells=[3, 3, 1])


class CellsTest(unittest.TestCase):
    def test_a_mesh_from_a_file_follows_two_and_four(self):
        self.assertEqual(cells.bodies_from_files({"bodies": [FILE, BOX]}), ["a"])
        for factor, found in ((0.5, {}), (1, {"refine": "1"}), (1.5, {}), (2, {"refine": "2"}), (4, {"refine": "4"}), (8, {})):
            self.assertEqual(cells.refined({"bodies": [FILE, BOX]}, factor), found)
        self.assertEqual(cells.refined({"bodies": [BOX]}, 1.5), {"refine": "1.5"})

    def test_a_factor_multiplies_that_of_the_case(self):
        self.assertEqual(cells.refined({"bodies": [BOX], "refine": entry(1.5)}, 2), {"refine": "3"})
        self.assertEqual(cells.refined({"bodies": [FILE], "refine": entry(2)}, 2), {"refine": "4"})
        self.assertEqual(cells.refined({"bodies": [FILE], "refine": entry(2)}, 4), {})
        self.assertEqual(cells.refine_of({"accuracy": entry("reference")}), 2)
        self.assertEqual(cells.refine_of({"accuracy": entry("fast"), "refine": entry(3)}), 3)

    def test_deformable_bodies_of_one_cell_stay_and_rigid_ones_are_geometry(self):
        self.assertEqual(cells.bodies_that_stay({"bodies": [FILE, BOX, BRICK, body("e", True, kind="box", cells=[1, 1, 1])]}), ["c"])
        self.assertTrue(cells.all_rigid({"bodies": [WALL]}))
        self.assertFalse(cells.all_rigid({"bodies": [WALL, FILE]}))
        self.assertFalse(cells.all_rigid({"mesh": {"level": entry(3)}}), "a program that builds its bodies itself")

    def test_what_keys_leave_out_is_other_counts_and_files_but_no_geometry(self):
        resolved = {"bodies": [FILE, BOX, BRICK, WALL]}
        self.assertEqual(cells.left_out(resolved, {"bodies[1].mesh.cells": [4, 1, 2]}), ["a"])
        self.assertEqual(cells.left_out({"bodies": [BOX, BOX]}, ["bodies[0].mesh.cells"]), ["bodies[1].mesh.cells"])


if __name__ == "__main__":
    unittest.main()
