"""scripts/trade_worst.py on points that are made up: what a setting makes without a warning, where, and what is no number."""
import io
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import trade_worst as worst  # noqa: E402  (after the path)

HEAD = "settings,ending,elements,steps,element updates,processor seconds [s],created energy [-],warnings,error of depth [-]," \
       "error that counts of depth [-],judged: depth,finer meshes\n"


def line(settings, error, warnings=0, updates=100, judged="yes", ending="good"):
    return f'"{settings}",{ending},' + (f"1,1,{updates},1,0,{warnings},{error},{error},{judged},0\n" if ending == "good" else ",,,,,,,,,\n")


def rows(*lines, case="a", base=0.01, warnings=0):
    text = HEAD + line("as the case has it", base, warnings) + "".join(lines)
    return worst.rows_of(io.StringIO(text), case, {"step", "mesh", "grading", "method"})


def one(name, *found):
    return worst.worst_of([row for some in found for row in some])[name]


class RowsTest(unittest.TestCase):
    def test_a_label_may_hold_a_comma(self):
        self.assertEqual(worst.knobs_of("grading to the foot, 0.25, step 1", {"grading", "step"}),
                         {"grading": "to the foot, 0.25", "step": "1"})
        self.assertEqual(worst.knobs_of("as the case has it", {"as"}), {})

    def test_an_error_that_is_not_judged_is_none(self):
        found = rows(line("step 1", 0.002, judged="below the reference's uncertainty"), line("step 2", 0, ending="stopped: energy_created"))
        self.assertEqual([row.errors for row in found], [{"depth": 0.01}, {"depth": None}, {}])
        self.assertEqual(found[2].ending, "stopped: energy_created")


class WorstTest(unittest.TestCase):
    def test_it_is_over_all_cases_less_what_the_case_has(self):
        found = one("step", rows(line("step 1", 0.05), line("step 0.5", 0.02)), rows(line("step 1", 0.06, updates=50), case="b", base=0.04))
        self.assertAlmostEqual(found.made, 0.04)
        self.assertEqual((found.row.case, found.row.knobs, found.cost, found.tried), ("a", {"step": "1"}, 1.0, 3))

    def test_where_the_case_is_not_judged_the_uncertainty_is_taken_off(self):
        found = worst.rows_of(io.StringIO(HEAD + line("as the case has it", 0.02, judged="below the reference's uncertainty")
                                          + line("step 1", 0.05)), "a", {"step"})
        self.assertAlmostEqual(one("step", found).made, 0.03)
        self.assertIn("| step | 5 % | below 2 % | 1 |", worst.worst_table(found, {"a": "a case"}))

    def test_runs_that_warn_or_stop_are_counted_and_make_none(self):
        found = one("step", rows(line("step 1", 0.5, warnings=1), line("step 2", 0, ending="stopped: x"), line("step 0.5", 0.02)))
        self.assertAlmostEqual(found.made, 0.01)
        self.assertEqual((found.tried, found.warned, found.stopped), (3, 1, 1))

    def test_a_warning_of_the_case_itself_is_none_of_the_setting(self):
        self.assertAlmostEqual(one("step", rows(line("step 1", 0.5, warnings=1), warnings=1)).made, 0.49)

    def test_pairs_runs_left_out_and_changes_by_less_than_a_tenth_are_none(self):
        found = one("step", rows(line("mesh x2, step 1", 0.9), line("step 0.9", 0.0105), line("step 0.8", 0, ending="left out")))
        self.assertEqual((found.made, found.row, found.tried), (0.0, None, 1))

    def test_a_setting_pays_where_a_run_with_it_is_on_a_front(self):
        found = worst.worst_of(rows(line("step 1", 0.009, updates=150), line("mesh x0.5", 0.02, updates=12), line("method penalty", 0.2)))
        self.assertEqual([(name, one.pays, one.results) for name, one in sorted(found.items())],
                         [("mesh", 1, 1), ("method", 0, 1), ("step", 1, 1)])

    def test_the_table_has_the_worst_first_and_says_where(self):
        found = rows(line("step 1", 0.05), line("mesh x0.5", 0.5, updates=12), line("method penalty", 0.01))
        lines = worst.worst_table(found, {"a": "a case"}).splitlines()
        self.assertIn("4 runs of 1 cases, 4 of them with a result, in 0 minutes", worst.said_of(found, {"a": "a case"}))
        self.assertEqual(lines[2], "| mesh | 50 % | 1 % | x0.5 | depth: a case | x0.12 | 1 |  |  | 1 of 1 |")
        self.assertEqual([row.split(" | ")[0] for row in lines[2:]], ["| mesh", "| step", "| method"])
        self.assertIn("| method | none |", lines[4])


if __name__ == "__main__":
    unittest.main()
