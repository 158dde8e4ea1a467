"""What scripts/validation.py, verification/taylor_shots and scripts/experiments make of numbers that are known."""
import contextlib
import doctest
import io
import math
import random
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "verification/taylor_shots")]
import shots  # noqa: E402  (after the path)
import validation  # noqa: E402

experiments = SourceFileLoader("experiments", str(ROOT / "scripts/experiments")).load_module()


def point(measured, computed, u=0.01, family="taylor_6061", group="T6"):
    return validation.Point(family, "length", group, "made up", 100.0, measured, computed, 0.002, u, u)


class Examples(unittest.TestCase):
    def test_examples_in_the_sources(self):
        for module in (validation, shots):
            self.assertEqual(doctest.testmod(module).failed, 0)


class Statistics(unittest.TestCase):
    def test_bias_and_scatter_are_those_of_a_drawn_sample(self):
        drawn, pairs = random.Random(7), []
        for _ in range(20000):
            truth = drawn.uniform(1, 2)
            pairs.append((truth * math.exp(drawn.gauss(0, 0.03)), truth * 1.1 * math.exp(drawn.gauss(0, 0.05))))
        bias, scatter, number = validation.bias_and_scatter(pairs, 0.03)
        self.assertEqual(number, 20000)
        self.assertAlmostEqual(bias, 1.1, delta=0.003)
        self.assertAlmostEqual(scatter, 0.05, delta=0.001)

    def test_a_scatter_below_that_of_the_measurements_is_none(self):
        self.assertEqual(validation.bias_and_scatter([(1, 1.01), (1, 0.99)], 0.1)[1], 0.0)

    def test_a_point_without_result_is_counted_and_in_no_mean(self):
        row = validation.summary([point(1, 1.02), point(1, math.nan), point(1, 0.98)])[0]
        self.assertEqual(row[3], "2 of 3")


class Points(unittest.TestCase):
    def test_a_file_of_points_is_read_as_it_was_written(self):
        points = [point(0.8, 0.82), point(0.7, 0.71, family="taylor_copper", group="House")]
        with tempfile.TemporaryDirectory() as there:
            path = Path(there) / "points.csv"
            experiments.write_points(path, points)
            self.assertEqual(experiments.read_points(path), points)

    def test_every_fault_of_a_file_is_told_at_once(self):
        with tempfile.TemporaryDirectory() as there:
            path, said = Path(there) / "points.csv", io.StringIO()
            experiments.write_points(path, [point(0.8, 0.82), point(0.7, 0.71)])
            path.write_text(path.read_text().replace("0.82", "nosuch").replace("0.71", ""))
            with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as ended:
                experiments.read_points(path)
            self.assertEqual(ended.exception.code, 2)
            self.assertIn("points.csv:2:", said.getvalue())
            self.assertIn("points.csv:3:", said.getvalue())

    def test_each_family_has_a_batch_that_counts(self):
        for name in experiments.families():
            self.assertIn(name, [family for family, _ in experiments.COUNTS])


if __name__ == "__main__":
    unittest.main()
