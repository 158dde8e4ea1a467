"""Tables in the tree: written, found fresh, and found stale when a number, a limit or a case is another."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import verification_tables as tables  # noqa: E402  (after the path)
import verify  # noqa: E402


def kind_of(name):
    return ["I-3"], "exact"


def outcome(error=0.005, limit=0.01, name="bar", full_error=0.3):
    rows = [verify.Row("check", "speed", "1 m/s", "0.995 m/s", verify.share(error), verify.share(limit), "pass", True, "seen", error,
                       limit),
            verify.Row("check", "fine speed", "1 m/s", "1 m/s", "30 %", "40 %", "pass", True, "seen", full_error, 0.4, full=True),
            verify.Row("break", "*must fail:* slow → speed", "1", "2", "100 %", "1 %", "fails, as it must", True)]
    rows[0].departs = [["viscosity", 0.0]]
    return verify.Outcome(name, "quick", claim="it moves", evidence="exact", catalogue=["I-3"], rows=rows,
                          departures={"viscosity": "the exact bar has none"},
                          figures=[("speed", "Speed over time.", "<svg/>")], runs=2, seconds=3.4)


class TablesTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)
        folder = self.root / "verification" / "bar"
        folder.mkdir(parents=True)
        (folder / "README.md").write_text("# A bar\n\nauthored\n")
        self.page = self.root / tables.PAGE
        self.page.parent.mkdir()
        self.page.write_text("# All\n\nauthored\n")
        tables.write(self.root, {"bar": outcome()}, ["bar"], kind_of)

    def stale(self, out):
        out.save(self.root / "quick")
        return tables.stale(self.root, ["bar"], self.root / "quick")

    def test_what_was_written_is_fresh(self):
        self.assertEqual(self.stale(outcome()), [])

    def test_only_the_block_is_written_anew(self):
        tables.write(self.root, {"bar": outcome(error=0.007)}, ["bar"], kind_of)
        for page in (self.page, self.root / "verification" / "bar" / "README.md"):
            text = page.read_text()
            self.assertIn("authored", text)
            self.assertEqual(text.count(tables.BEGIN), 1)
            self.assertIn("0.7 %", text)
            self.assertNotIn("0.5 %", text)

    def test_evidence_of_a_check_stands_beside_its_name_and_that_of_the_case(self):
        out = outcome()
        out.rows[0].evidence, out.rows[1].evidence = "invariant", "exact"
        self.assertEqual(len(self.stale(out)), 2)
        tables.write(self.root, {"bar": out}, ["bar"], kind_of)
        self.assertEqual(self.stale(out), [])
        self.assertIn("| speed (invariant) |", (self.root / "verification/bar/README.md").read_text())
        self.assertIn("| exact, invariant |", self.page.read_text())

    def test_a_quick_outcome_leaves_what_is_long_as_it_was(self):
        readme = self.root / "verification/bar/README.md"
        whole = outcome()
        whole.level = "full"
        whole.rows[1].because, whole.rows[2].error = "because", "100 %, noticed from 3 % on"
        tables.write(self.root, {"bar": whole}, ["bar"], kind_of)
        quick = outcome(error=0.007)
        quick.rows[1:2] = [verify.Row("check", "new speed", "1 m/s", "1 m/s", "2 %", "4 %", "pass", True, "newly seen", 0.02, 0.04)]
        quick.left_out = [("check", "fine speed")]
        tables.write(self.root, {"bar": quick}, ["bar"], kind_of)
        text = readme.read_text()
        names = [line.split(" | ")[0] for line in text.splitlines() if line.startswith("| ")]
        self.assertEqual(names, ["| check", "| speed", "| new speed", "| fine speed", "| *must fail:* slow → speed"])
        for part in ("| 0.7 % | 1 % |", "- fine speed: because.", "- new speed: newly seen.", "noticed from 3 % on"):
            self.assertIn(part, text)
        quick.left_out = []
        tables.write(self.root, {"bar": quick}, ["bar"], kind_of)
        self.assertNotIn("fine speed", readme.read_text())

    def test_another_error_is_stale_and_its_rounding_is_not(self):
        self.assertEqual(self.stale(outcome(error=0.0051)), [])
        self.assertEqual(len(self.stale(outcome(error=0.006))), 2)  # in the README of the case and on the page of all

    def test_of_a_chaotic_check_only_limit_and_verdict_count(self):
        other = outcome(error=0.008)
        other.rows[0].chaotic = True
        self.assertFalse([fault for fault in self.stale(other) if "README.md: is stale" in fault])
        other.rows[0].word = "FAIL"
        self.assertTrue([fault for fault in self.stale(other) if "README.md: is stale" in fault])

    def test_which_of_several_checks_is_closest_may_be_rounding(self):
        head = "| [bar](../verification/bar/README.md) | it moves | exact |"
        one, other = f"{head} one | 1.4e-16 | 1.0e-12 | yes | pass |", f"{head} other | 6.3e-08 | 0.1 % | yes | pass |"
        self.assertTrue(tables.same_line(one, other, None))
        self.assertFalse(tables.same_line(one.replace("1.4e-16", "0.5 %"), other, None))

    def test_another_limit_is_stale(self):
        self.assertEqual(len(self.stale(outcome(limit=0.02))), 2)

    def test_a_missing_row_line_figure_or_outcome_is_stale(self):
        more = outcome()
        more.rows.append(verify.Row("check", "time", "1 s", "1 s", "0", "1 %", "pass", True, "seen", 0.0, 0.01))
        self.assertIn("has no row 'time'", self.stale(more)[0])
        (self.root / "verification" / "bar" / "speed.svg").unlink()
        self.assertIn("speed.svg: is missing", self.stale(outcome())[0])
        self.page.write_text("# All\n")
        self.assertIn("has no line of bar", self.stale(outcome())[-1])
        self.assertIn("no quick outcome", tables.stale(self.root, ["bar"], self.root / "nowhere")[0])

    def test_the_page_of_all_links_to_the_folder_of_each_case(self):
        link = tables.lines_of(self.page.read_text())["bar"].split("](")[1].split(")")[0]
        self.assertTrue((self.page.parent / link).is_file())

    def test_a_page_that_is_missing_has_no_lines_and_is_written_anew(self):
        self.page.unlink()
        self.assertEqual(tables.page_lines(self.root), {})
        tables.write(self.root, {"bar": outcome()}, ["bar"], kind_of)
        self.assertEqual(self.stale(outcome()), [])

    def test_a_line_of_a_case_that_is_gone_is_stale(self):
        self.assertIn("which is no case", tables.stale(self.root, [], self.root / "quick")[0])

    def test_the_table_of_all_shows_what_the_quick_suite_can_see(self):
        line = tables.lines_of(self.page.read_text())["bar"]
        self.assertIn("| speed | 0.5 % | 1 % | no: viscosity 0 | pass |", line)

    def test_a_departure_from_the_defaults_is_told_with_its_reason(self):
        self.assertIn("- viscosity 0: the exact bar has none.\n", (self.root / "verification" / "bar" / "README.md").read_text())

    def test_another_reason_and_another_departure_are_stale(self):
        other = outcome()
        other.departures = {"viscosity": "nobody knows"}
        self.assertIn("does not say why viscosity", self.stale(other)[0])
        other = outcome()
        other.rows[0].departs = []
        self.assertIn("the line of bar is stale", self.stale(other)[-1])

    def test_errors_at_rounding_need_only_stay_within_their_limit(self):
        self.assertTrue(tables.same_error("2.0e-13", "9.0e-12", 1e-10))
        self.assertFalse(tables.same_error("2.0e-13", "9.0e-09", 1e-10))
        self.assertTrue(tables.same_error("0", "0", None))


if __name__ == "__main__":
    unittest.main()
