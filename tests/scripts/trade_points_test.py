"""scripts/trade_points.py on made-up points: fronts, what finer meshes confirm, uncertainty of a reference, tables."""
import csv
import io
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import trade_points as points  # noqa: E402  (after the path)


def point(updates, error, mesh=1.0, ending="good", seconds=None, **named):
    more = {} if mesh == 1 else {"mesh": f"x{mesh:g}"}
    return points.Point({**more, **named}, {f"of.{name}": label for name, label in {**more, **named}.items()}, ending, mesh,
                        {"depth": error}, updates=updates, seconds=updates if seconds is None else seconds)


EXACT = {"depth": points.exact_reference()}


def front(found, references=None):
    return points.front_of(found, "depth", references or EXACT, points.updates_of)


class FrontTest(unittest.TestCase):
    def test_only_points_that_none_beats(self):
        a, b, c, d = point(1, 0.3, k="a"), point(2, 0.4, k="b"), point(3, 0.1, k="c"), point(4, 0.1, k="d")
        self.assertEqual(front([d, c, b, a]), [a, c])

    def test_a_dearer_run_that_is_hardly_better_is_not_on_the_front(self):
        a, b = point(1, 0.100, k="a"), point(2, 0.097, k="b")
        self.assertEqual(front([a, b]), [a])

    def test_runs_without_a_number_are_on_no_front(self):
        stopped = point(1, 0.0, ending="stopped: energy_created", k="a")
        self.assertEqual(front([stopped, point(2, 0.1)]), [point(2, 0.1)])
        self.assertEqual(points.front([point(1, math.nan)], points.updates_of, lambda one: one.errors["depth"]), [])

    def test_an_error_below_the_uncertainty_counts_as_it(self):
        cheap, dear = point(1, 0.02, k="a"), point(2, 0.001, k="b")
        self.assertEqual(front([cheap, dear]), [cheap, dear])
        self.assertEqual(front([cheap, dear], {"depth": points.Reference(1.0, "m", 0.03, "")}), [cheap])

    def test_luck_of_a_coarse_mesh_does_not_count(self):
        lucky, finer, finest = point(1, 0.001, 0.5), point(4, 0.2), point(16, 0.1, 2)
        found = [lucky, finer, finest]
        self.assertEqual(points.counted(lucky, "depth", found, EXACT), 0.2)
        self.assertEqual(points.counted(finer, "depth", found, EXACT), 0.2)
        self.assertEqual(front(found), [lucky, finest])

    def test_a_point_without_two_finer_meshes_is_on_no_sure_front(self):
        found = [point(1, 0.4, 0.5), point(4, 0.3), point(16, 0.2, 2), point(2, 0.01, k="a")]
        self.assertEqual(front(found), [found[0], found[3]])
        self.assertEqual(points.front_of(found, "depth", EXACT, points.updates_of, surely=True), [found[0]])
        self.assertEqual(points.confirmed(found[3:]), found[3:])  # a sweep of one mesh asks for none

    def test_only_the_next_two_meshes_of_the_same_settings_confirm(self):
        found = [point(1, 0.1, 0.5), point(2, 0.05), point(4, 0.04, 2), point(8, 0.9, 4), point(3, 0.8, 1, k="a"),
                 point(2, 0.7, 1.5, ending="stopped: energy_created")]
        self.assertEqual([one.mesh for one in points.finer_of(found[0], found)], [1, 2])
        self.assertEqual(points.counted(found[0], "depth", found, EXACT), 0.1)


class PairsTest(unittest.TestCase):
    def test_values_that_pay_are_paired_and_those_of_one_knob_are_not(self):
        base = point(100, 0.1)
        coarse, fine, step, useless = point(25, 0.3, 0.5), point(400, 0.05, 2), point(90, 0.09, step="1"), point(200, 0.2, k="a")
        fine.settings, step.settings, coarse.settings = {"c": "2"}, {"s": "1"}, {"c": "0.5"}
        step.updates, step.seconds = 80, 80
        names = [one.name() for _, one in points.pairs([coarse, fine, step, useless], base, EXACT)]
        self.assertEqual(names, ["mesh x0.5, step 1", "mesh x2, step 1"])

    def test_a_point_of_the_front_gets_its_two_finer_meshes(self):
        base, fine, finest = point(100, 0.1), point(400, 0.05, 2), point(1600, 0.02, 4)
        lucky = point(90, 0.001, step="1")
        found = points.unproved([base, fine, finest, lucky], {1.0: base, 2: fine, 4: finest}, EXACT)
        self.assertEqual([(expected, one.name(), one.mesh) for expected, one in found],
                         [(360, "mesh x2, step 1", 2), (1440, "mesh x4, step 1", 4)])
        self.assertEqual(found[0][1].settings, {"of.mesh": "x2", "of.step": "1"})


class SeriesTest(unittest.TestCase):
    def test_a_line_has_its_meshes_and_what_the_case_has_anyway_is_no_difference(self):
        base, fine, other = point(4, 0.3), point(16, 0.2, 2), point(1, 0.3, 1, kind="sector")
        wanted = points.Series("depth", {"quarter": {"kind": "quarter"}, "sector": {"kind": "sector"}, "full": {"kind": "full"}})
        found = points.series(wanted, [fine, other, base, point(2, 0.1, 1, kind="full", ending="left out"), point(1, 0.1, 1, step="1")])
        self.assertEqual(found["quarter"], [base, fine])
        self.assertEqual(found["sector"], [other])
        self.assertEqual(found["full"], [])


class ReferenceTest(unittest.TestCase):
    def test_three_meshes_of_an_order_have_the_index_of_the_finest(self):
        one = points.converged_reference([1, 2, 4], [7 + 0.3 / n**2 for n in (1, 2, 4)], "m")
        self.assertAlmostEqual(one.value, 7 + 0.3 / 16)
        self.assertAlmostEqual(one.uncertainty, 1.25 * 0.3 / 16 / one.value)

    def test_meshes_without_an_order_have_three_times_their_spread(self):
        self.assertAlmostEqual(points.converged_reference([1, 2, 4], [1.0, 1.2, 1.1], "m").uncertainty, 3 * 0.2 / 1.1)

    def test_settings_beside_the_meshes_add_how_far_they_lie_apart(self):
        alone = points.converged_reference([1, 2, 4], [7 + 0.3 / n**2 for n in (1, 2, 4)], "m")
        one = points.converged_reference([1, 2, 4], [7 + 0.3 / n**2 for n in (1, 2, 4)], "m", {"two": 6.9, "three": 7.0, "four": 6.95})
        self.assertAlmostEqual((one.uncertainty - alone.uncertainty) * one.value, 0.1)
        self.assertIn("between two, three, four", one.known)

    def test_two_meshes_are_no_reference(self):
        self.assertEqual(points.converged_reference([1, 2], [1.0, 1.1], "m").uncertainty, math.inf)


class TableTest(unittest.TestCase):
    def setUp(self):
        self.base, self.stopped = point(1000, 0.1, seconds=2.0), point(1, 0.0, ending="stopped: energy_created", step="2")
        self.sharp, self.below = point(4000, 0.05, 2, seconds=8.0), point(2000, 0.001, element="full", seconds=3.0)
        self.found = [self.base, self.sharp, self.below, self.stopped]
        self.references = {"depth": points.Reference(1.0, "m", 0.004, "observed order 2.00")}

    def test_costs_and_errors_stand_beside_those_of_the_case(self):
        lines = points.alone_table(self.found, self.base, self.references).splitlines()
        self.assertEqual(lines[2], "| as the case has it | 1,000 | 2.00 s | 10 % |  |")
        self.assertEqual(lines[3], "| mesh x2 | x4 | x4 | 5 % (x0.5) |  |")
        self.assertEqual(lines[4], "| element full | x2 | x1.5 | below the reference's 0.4 % |  |")
        self.assertEqual(lines[5], "| step 2 |  |  | stopped: energy_created |  |")

    def test_the_front_has_what_the_finer_mesh_confirms(self):
        lines = points.front_table([one for one in self.found if one.good()], "depth", self.references).splitlines()
        self.assertEqual(lines[2:], ["| 1 | as the case has it | 1,000 | 2.00 s | 10 % | 10 % | both |"])

    def test_every_line_of_the_points_has_all_columns(self):
        rows = list(csv.reader(io.StringIO(points.as_csv(self.found, self.references))))
        self.assertEqual({len(row) for row in rows}, {len(rows[0])})
        self.assertEqual(rows[3][-2], "below the reference's uncertainty")
        self.assertEqual(rows[4][1], "stopped: energy_created")

    def test_a_reference_that_says_nothing_judges_nothing(self):
        self.assertFalse(points.judged(0.5, math.inf))
        self.assertEqual(points.error_text(0.5, math.inf), "not judged: no reference")


if __name__ == "__main__":
    unittest.main()
