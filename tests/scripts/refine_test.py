"""scripts/refine on sequences whose limit and order are known, and on a case as a driver resolves it."""
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
refine = made_up.script("refine")


def sequence(factors, order, limit=7.0, second=0.0):
    return [limit + 0.3 * factor ** -order + second * factor ** -4 for factor in factors]


class LineTest(unittest.TestCase):
    def test_order_limit_and_index_of_a_power(self):
        line = refine.line_of("length", "m", [1, 2, 4], sequence([1, 2, 4], 1.5))
        self.assertAlmostEqual(line.order, 1.5, places=9)
        self.assertAlmostEqual(line.extrapolated, 7.0, places=9)
        self.assertAlmostEqual(line.index, 1.25 * (sequence([4], 1.5)[0] - 7.0), places=9)
        self.assertIn("three meshes cannot show", line.verdict)

    def test_four_meshes_of_one_power_are_asymptotic(self):
        self.assertTrue(refine.line_of("length", "m", [1, 2, 4, 8], sequence([1, 2, 4, 8], 2)).verdict.startswith("asymptotic"))

    def test_what_is_not_asymptotic_is_said(self):
        for values in ([1, 2, 1.5], [1, 1.5, 1.1, 1.2], sequence([1, 2, 4, 8], 1, second=2.0), [1, 2, 4, 8],
                       [1, 1 + 1e-1, 1 + 1e-1 + 1e-4]):
            with self.subTest(values):
                self.assertIn("NOT asymptotic", refine.line_of("x", "m", [1, 2, 4, 8][:len(values)], values).verdict)

    def test_what_does_not_depend_on_the_mesh_needs_no_order(self):
        self.assertEqual(refine.line_of("x", "m", [1, 2, 4], [3, 3, 3]).verdict, "does not depend on the mesh")

    def test_where_a_part_is_not_refined_no_error_is_estimated(self):
        line = refine.line_of("length", "m", [1, 2, 4], sequence([1, 2, 4], 1.5), ["b.cells"])
        self.assertAlmostEqual(line.order, 1.5, places=9)
        self.assertEqual((line.extrapolated, line.index), (None, None))
        self.assertIn("no estimate, as not all is refined", line.verdict)

    def test_a_result_without_value_is_told(self):
        self.assertIn("no value", refine.line_of("x", "m", [1, 2, 4], [3, None, 3]).verdict)


class CountsTest(unittest.TestCase):
    def test_all_counts_of_cells_are_found(self):
        resolved = {"bodies": [{"mesh": {"kind": "box", "cells": [4, 1, 2]}}, {"mesh": {"cells_core": {"value": 3}}}], "time": {"end": 1}}
        self.assertEqual(refine.counts_of_cells(resolved), {"bodies[0].mesh.cells": [4, 1, 2], "bodies[1].mesh.cells_core": 3})

    def test_a_single_cell_stays_and_rounding_is_told(self):
        settings, moved = refine.settings_of({"a.cells": [4, 1], "b": 3}, 1.5)
        self.assertEqual(settings, {"a.cells": "[6, 1]", "b": "4"})
        self.assertAlmostEqual(moved, 0.5 / 4.5)


if __name__ == "__main__":
    unittest.main()
