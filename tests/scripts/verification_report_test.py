"""The report is one file that needs nothing else, shows every case and hides no miss."""
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
try:
    import verification_report as report  # needs matplotlib and markdown
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
import verification_figures as figures  # noqa: E402
import verify  # noqa: E402


def outcome(good=True):
    rows = [verify.Row("check", "speed", "1 m/s", "1 m/s", "0.5 %", "1 %", "pass" if good else "FAIL", good, "seen <b>", 0.005, 0.01),
            verify.Row("miss", "rebound", "1", "0.9", "10 %", "1 %", "MISS", True, "wanted; misses: too coarse", 0.1, 0.01)]
    one = verify.Figure("speed", "time [s]", "speed [m/s]", None)
    curves = verify.Curves([("Nereid", [0, 1, 2], [0, 1.1, 2])], [("exact", [0, 1, 2], [0, 1, 2])], [])
    return verify.Outcome("two_blocks", "quick", "scene", "case.yaml", "it moves at $c = \\sqrt{E/\\rho}$", "exact", ["I-3"], rows=rows,
                          figures=[("speed", "Speed.", figures.case_figure(one, curves))], runs=1, seconds=2.0)


def written(*outcomes, asked=("two_blocks", "taylor_bar")):
    with tempfile.TemporaryDirectory() as folder:
        for out in outcomes:
            out.save(Path(folder) / "quick")
        return report.write(Path(folder), "quick", ["two_blocks", "taylor_bar", "rolling"], asked).read_text(encoding="utf-8")


class ReportTest(unittest.TestCase):
    def test_it_refers_to_nothing_outside(self):
        text = written(outcome())
        for address in re.findall(r"(?:src|href)=['\"]([^'\"]*)", text):
            self.assertTrue(address.startswith(("#", "data:")), address)

    def test_every_address_inside_leads_to_a_page(self):
        text = written(outcome())
        for name in re.findall(r"href='#(\w+)'", text):
            self.assertTrue(f"id='{name}'" in text, name)

    def test_a_case_that_has_not_run_is_named(self):
        self.assertTrue("<p class='FAIL'>Not run: taylor_bar.</p>" in written(outcome()))

    def test_cases_that_nobody_asked_for_stand_in_one_grey_line(self):
        text = written(outcome(), asked=["two_blocks"])
        self.assertTrue("<p class='quiet'>Without results at this level, since no command asked for them: taylor_bar, rolling.</p>" in text)
        self.assertFalse("Not run" in text)

    def test_a_failure_and_a_miss_are_in_the_overview(self):
        self.assertTrue("1 MISS" in written(outcome()))
        self.assertTrue("1 fail" in written(outcome(good=False)))

    def test_formulas_become_pictures_and_text_is_no_markup(self):
        text = written(outcome())
        self.assertTrue("alt='c = \\sqrt{E/\\rho}'" in text)
        self.assertFalse("seen <b>." in text)

    def test_the_error_panel_holds_result_less_exact_over_the_largest_exact(self):
        curves = verify.Curves([("Nereid", [0, 1, 2], [0, 1.1, 2])], [("exact", [0, 2], [0, 2])], [])
        ((number, across, error),) = figures.errors_of(curves.results, curves.exact)
        self.assertEqual((number, list(across)), (0, [0, 1, 2]))
        self.assertAlmostEqual(error[1], 5.0)


if __name__ == "__main__":
    unittest.main()
