"""What scripts/convergence.py says of a sequence of meshes, on sequences whose limit and order are known."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import convergence  # noqa: E402  (after the path)


def sequence(levels, limit, factor, order):
    """f(h) = limit + factor h^order at h = 1/level."""
    return [limit + factor * (1 / level) ** order for level in levels]


class Tendency(unittest.TestCase):
    def test_recovers_limit_and_order_whatever_the_ratios(self):
        for levels in ([1, 2, 4], [2, 3, 4], [3, 4, 6], [1, 3, 4], [4, 6, 7]):
            for order in (0.6, 1.0, 1.7, 2.0):
                for factor in (-3.0, 0.2):
                    with self.subTest(levels=levels, order=order, factor=factor):
                        note, limit, _ = convergence.tendency(levels, sequence(levels, 58.0, factor, order))
                        self.assertAlmostEqual(limit, 58.0, delta=1e-9)  # round-off of differences of 58
                        self.assertIn(f"observed order {order:.2f}", note)

    def test_uncertainty_is_a_quarter_more_than_the_error_of_the_finest(self):
        for levels in ([1, 2, 4], [3, 4, 6]):
            values = sequence(levels, 10.0, 1.0, 1.5)
            _, limit, uncertainty = convergence.tendency(levels, values)
            self.assertAlmostEqual(uncertainty, 1.25 * abs(values[-1] - 10.0), delta=1e-10)
            self.assertLess(abs(values[-1] - limit), uncertainty)

    def test_looks_at_the_finest_three_in_any_order(self):
        levels = [6, 1, 3, 4, 2]
        values = sequence(levels, 5.0, 1.0, 1.0)
        values[1] = -100.0  # level 1 is not asked
        _, limit, _ = convergence.tendency(levels, values)
        self.assertAlmostEqual(limit, 5.0, delta=1e-10)

    def test_an_order_above_two_extrapolates_but_claims_no_more_than_two(self):
        levels, order = [2, 3, 4], 2.8
        values = sequence(levels, 7.0, 1.0, order)
        note, limit, uncertainty = convergence.tendency(levels, values)
        self.assertAlmostEqual(limit, 7.0, delta=1e-10)
        self.assertIn("taken as 2", note)
        r = 4 / 3
        self.assertAlmostEqual(uncertainty, 1.25 * abs(values[2] - values[1]) / (r ** 2 - 1), delta=1e-12)
        self.assertGreater(uncertainty, 1.25 * abs(values[2] - 7.0))

    def test_not_monotone_gives_three_times_the_spread_and_no_limit(self):
        note, limit, uncertainty = convergence.tendency([1, 2, 4], [10.0, 12.0, 11.5])
        self.assertIn("not monotone", note)
        self.assertIsNone(limit)
        self.assertEqual(uncertainty, 3 * 2.0)

    def test_steps_that_do_not_shrink_have_no_order(self):
        # with ratios of two, equal steps are the logarithm of h: order zero; the last ones grow
        for values in ([1.0, 2.0, 3.0], [1.0, 1.9, 3.0]):
            note, limit, uncertainty = convergence.tendency([1, 2, 4], values)
            self.assertIn("below 0.5", note)
            self.assertIsNone(limit)
            self.assertEqual(uncertainty, 3 * 2.0)

    def test_an_order_below_a_half_or_above_three_is_not_extrapolated(self):
        for levels in ([1, 2, 4], [6, 8, 12]):
            for order, is_one in ((0.49, False), (0.51, True), (2.99, True), (3.01, False)):
                values = sequence(levels, 58.0, 1.0, order)
                note, limit, uncertainty = convergence.tendency(levels, values)
                if is_one:
                    self.assertAlmostEqual(limit, 58.0, delta=1e-9, msg=note)
                else:
                    self.assertIsNone(limit, note)
                    self.assertAlmostEqual(uncertainty, 3 * (values[0] - values[-1]), delta=1e-12)

    def test_unequal_ratios_count(self):
        # equal steps are of order one where h falls by equal amounts, and of none where it is halved
        self.assertAlmostEqual(convergence.tendency([2, 3, 6], [3.0, 2.0, 1.0])[1], 0.0, delta=1e-12)
        self.assertIsNone(convergence.tendency([1, 2, 4], [3.0, 2.0, 1.0])[1])

    def test_finest_two_equal_or_all_but_equal_tell_no_order(self):
        for finest, word in ((4.0, "last digit"), (4.0 - 1e-12, "above 3")):
            note, limit, uncertainty = convergence.tendency([1, 2, 4], [5.0, 4.0, finest])
            self.assertIn(word, note)
            self.assertIsNone(limit)
            self.assertAlmostEqual(uncertainty, 3.0)

    def test_two_meshes_say_nothing(self):
        self.assertEqual(convergence.tendency([1, 2], [1.0, 2.0])[1:], (None, None))


class Order(unittest.TestCase):
    def test_the_order_of_a_known_error(self):
        self.assertAlmostEqual(convergence.order_between(0.2, 0.04 * 3, 0.1, 0.01 * 3), 2)
        self.assertEqual(convergence.order_between(0.2, 0.1, 0.1, 0.0), float("inf"))


if __name__ == "__main__":
    unittest.main()
