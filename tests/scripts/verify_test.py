"""scripts/verify.py tells right from wrong: rows, studies and breaks on runs that are made up here."""
import contextlib
import doctest
import io
import math
import re
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
import verify  # noqa: E402  (after the path)
from verify import Breaks, Check, Falls, Figure, Miss, Pair, Report, Table, Waiver  # noqa: E402


class MadeUp:
    """A run whose answer is off by `error`, and depends on the keys that are set."""

    driver = "made_up"

    def __init__(self, error=0.001, ending="reached_end"):
        self.keys, self.error, self.ending = {}, error, ending
        self.summary = {"ending": {"reason": "made up"}, "ledger": {}, "cost": {}, "provenance": {"resolved": {}}}

    def other(self, driver, case, change):
        return self.again({"mistake": "made"} if "wrong" in case else change)

    def again(self, change):
        keys = {**self.keys, **change}
        error = 0.001 if "size" not in keys else float(keys["size"]) ** 2
        made = MadeUp(0.5 if keys.get("mistake") == "made" else error, keys.get("ending", "reached_end"))
        made.keys = keys
        return made


class GatedRun:
    """What a row of a gate tells of a run."""

    def __init__(self, name):
        self.overrides, self.folder, self.case_file = {"name": name}, Path(name), "case.yaml"


def answer(run):
    return Pair(2 * (1 + run.error), 2, "m")


CHECK = Check("answer", answer, 0.01, "made up")
CHECKS = {"answer": CHECK}


class PairTest(unittest.TestCase):
    def test_the_error_is_relative_to_what_is_expected(self):
        self.assertAlmostEqual(Pair(2.02, 2).error(), 0.01)
        self.assertAlmostEqual(Pair(-1.98, -2).error(), 0.01)

    def test_a_scale_of_its_own_serves_where_zero_is_expected(self):
        self.assertAlmostEqual(Pair(0.5, 0, "J", scale=50).error(), 0.01)
        self.assertEqual(Pair(0.5, 0).error(), math.inf)
        self.assertEqual(Pair(0, 0).error(), 0)


class RowsTest(unittest.TestCase):
    def test_a_check_passes_within_its_limit_and_fails_outside(self):
        self.assertTrue(verify.check_row(CHECK, MadeUp(0.009)).good)
        self.assertFalse(verify.check_row(CHECK, MadeUp(0.011)).good)

    def test_what_is_no_number_fails(self):
        self.assertFalse(verify.check_row(CHECK, MadeUp(math.nan)).good)

    def test_a_report_gates_nothing(self):
        row = verify.check_row(Report("answer", answer, "made up"), MadeUp(5))
        self.assertTrue(row.good)
        self.assertEqual(row.word, "report")

    def test_a_miss_must_miss(self):
        miss = Miss("answer", answer, 0.01, "made up", "a reason")
        self.assertTrue(verify.check_row(miss, MadeUp(0.02)).good)
        self.assertEqual(verify.check_row(miss, MadeUp(0.02)).word, "MISS")
        self.assertFalse(verify.check_row(miss, MadeUp(0.001)).good)

    def test_a_break_must_be_noticed(self):
        self.assertTrue(verify.break_row(Breaks("answer", "a mistake", {"mistake": "made"}), CHECKS, MadeUp()).good)
        self.assertFalse(verify.break_row(Breaks("answer", "none", {"mistake": "not made"}), CHECKS, MadeUp()).good)

    def test_a_break_that_gives_no_number_is_not_noticed(self):
        lost = {"lost": Check("lost", lambda run: Pair(math.nan if run.keys else 2, 2), 0.01, "made up")}
        row = verify.break_row(Breaks("lost", "a mistake", {"mistake": "made"}), lost, MadeUp())
        self.assertEqual((row.good, row.word), (False, "FAIL: no number to fail by"))

    def test_the_full_level_says_from_where_on_a_break_is_noticed(self):
        class Sized(MadeUp):
            """Its error is that of `size`, 0.1 where nothing is set."""

            def case(self, key):
                return float(self.keys.get(key, 0.01))

            def again(self, change):
                made = Sized(float({**self.keys, **change}["size"]) / 10)
                made.keys = {**self.keys, **change}
                made.summary["provenance"]["resolved"] = {"size": {"value": made.case("size"), "unit": "1"}}
                return made

        run = Sized()
        run.summary["provenance"]["resolved"] = {"size": {"value": 0.01, "unit": "1"}}
        row = verify.break_row(Breaks("answer", "a mistake", {"size": "1"}), CHECKS, run, full=True)
        self.assertTrue(row.good)
        share = float(re.search("noticed from (.*) % on", row.error)[1])  # the limit of 1 % is at 0.1, ten times the right size
        self.assertTrue(900 < share < 1300, row.error)

    def test_a_break_may_be_another_case_file(self):
        self.assertTrue(verify.break_row(Breaks("answer", "a mistake", case="wrong.yaml"), CHECKS, MadeUp()).good)
        self.assertFalse(verify.break_row(Breaks("answer", "none", case="right.yaml"), CHECKS, MadeUp()).good)

    def test_a_break_runs_only_what_its_check_looks_at(self):
        made = []

        class Counted(MadeUp):
            def again(self, change):
                made.append(change)
                return super().again(change)

        finer = {"finer": Check("finer", lambda run: answer(run.again({"finer": "yes"})), 0.01, "made up")}
        self.assertTrue(verify.break_row(Breaks("finer", "a mistake", {"mistake": "made"}), finer, Counted()).good)
        self.assertEqual(made, [{"mistake": "made", "finer": "yes"}])
        self.assertTrue(verify.break_row(Breaks("answer", "a mistake", {"mistake": "made"}), CHECKS, Counted()).good)
        self.assertEqual(made[1:], [{"mistake": "made"}])
        self.assertFalse(verify.break_row(Breaks("finer", "a mistake", {"mistake": "made", "ending": "stopped"}), finer, Counted()).good)

    def test_the_worst_run_of_a_case_decides_a_gate(self):
        runs = [(GatedRun("good"), 1e-12), (GatedRun("bad"), 1e-9)]
        self.assertTrue(verify.gate_row("unexplained energy", 1e-10, runs[:1], []).good)
        row = verify.gate_row("unexplained energy", 1e-10, runs, [])
        self.assertFalse(row.good)
        self.assertIn("bad", row.because)
        self.assertFalse(verify.gate_row("unexplained energy", 1e-10, [(GatedRun("bad"), math.inf)], []).good)

    def test_a_waiver_excuses_the_runs_it_names_and_says_so(self):
        runs = [(GatedRun("good"), 1e-12), (GatedRun("bad"), 1e-9)]
        row = verify.gate_row("unexplained energy", 1e-10, runs, [Waiver("unexplained energy", lambda run: run.overrides["name"] == "bad",
            "made up", up_to=1e-8)])
        self.assertTrue(row.good)
        self.assertIn("1 of 2 runs are excused: made up", row.because)
        self.assertIn("in 1 runs", row.got)

    def test_a_waiver_excuses_no_error_beyond_its_bound(self):
        def row(up_to, error):
            return verify.gate_row("unexplained energy", 1e-10, [(GatedRun("bad"), error)],
                                   [Waiver("unexplained energy", lambda run: True, "made up", up_to=up_to)])
        self.assertTrue(row(1e-8, 1e-9).good)
        self.assertFalse(row(1e-8, 1e-7).good)
        self.assertFalse(row(1e-8, math.nan).good)
        self.assertTrue(row(math.inf, math.nan).good)

    def test_a_waiver_that_no_run_needs_is_a_fault(self):
        row = verify.gate_row("unexplained energy", 1e-10, [(GatedRun("good"), 1e-12)], [Waiver("unexplained energy", lambda run: True,
            "made up", up_to=1e-8)])
        self.assertFalse(row.good)
        self.assertIn("excuses no run", row.because)
        self.assertIn("in 1 runs", row.got)

    def test_a_break_that_stops_the_run_breaks_no_number(self):
        self.assertFalse(verify.break_row(Breaks("answer", "a mistake", {"ending": "energy_created"}), CHECKS, MadeUp()).good)

    def test_a_study_needs_the_fall_and_the_order(self):
        falling = dict(along="size", values=[0.4, 0.2, 0.1])
        self.assertTrue(verify.study_row(Falls("answer", order=1.9, **falling), CHECKS, MadeUp())[0].good)
        self.assertFalse(verify.study_row(Falls("answer", order=2.1, **falling), CHECKS, MadeUp())[0].good)
        self.assertFalse(verify.study_row(Falls("answer", along="size", values=[0.1, 0.2]), CHECKS, MadeUp())[0].good)


class WordsTest(unittest.TestCase):
    def test_errors_are_shown_in_per_cent_or_as_powers_of_ten(self):
        self.assertEqual([verify.share(e) for e in (0, 3e-9, 0.0123, 1.234)], ["0", "3.0e-09", "1.2 %", "123 %"])
        self.assertEqual(verify.share(math.nan), "nan")


GOOD = {"accept.py": "from verify import Breaks, Check, Pair\nfrom reference import truth\n"
                     "CLAIM, EVIDENCE, CATALOGUE, DRIVER = 'it holds', 'exact', ('X-1',), 'two_blocks'\n"
                     "FIGURES = ['one']\n"
                     "CHECKS = [Check('answer', lambda run: Pair(1, truth), 0.01, 'made up')]\n"
                     "BREAKS = [Breaks('answer', 'a mistake', {'key': 1})]\n",
        "reference.py": "truth = 1\n"}


class CaseTest(unittest.TestCase):
    def case(self, **changes):
        with tempfile.TemporaryDirectory() as root:
            folder = Path(root) / "verification" / "made_up"
            folder.mkdir(parents=True)
            for name, text in GOOD.items():
                (folder / name).write_text(text)
            for old, new in changes.items():
                text = (folder / "accept.py").read_text()
                (folder / "accept.py").write_text(text + f"\n{old} = {new}\n")
            return verify.Case("made_up", Path(root))

    def test_a_sound_case_has_no_fault(self):
        self.assertEqual(self.case().fault, "")

    def test_every_rule_of_a_case_can_be_broken(self):
        self.assertIn("BREAKS is empty", self.case(BREAKS="[]").fault)
        self.assertIn("EVIDENCE is", self.case(EVIDENCE="'trust'").fault)
        self.assertIn("evidence of 'answer'", self.case(CHECKS="[Check('answer', None, 1, 'made up', evidence='trust')]").fault)
        self.assertIn("no check is called", self.case(BREAKS="[Breaks('other', 'a mistake')]").fault)
        self.assertIn("same name", self.case(CHECKS="CHECKS * 2").fault)
        self.assertIn("no reason", self.case(CHECKS="[Check('answer', None, 1, '')]").fault)
        two = "[*CHECKS, Check('other', None, 1, 'made up'{})]"
        self.assertIn("nothing breaks 'other'", self.case(CHECKS=two.format("")).fault)
        self.assertEqual(self.case(CHECKS=two.format(", like='answer'")).fault, "")
        self.assertIn("FIGURES is empty", self.case(FIGURES="[]").fault)
        self.assertIn("changes nothing", self.case(BREAKS="[Breaks('answer', 'a mistake')]").fault)
        self.assertIn("all BREAKS are full", self.case(BREAKS="[Breaks('answer', 'a mistake', {'key': 1}, full=True)]").fault)

    def test_every_case_of_the_tree_is_sound(self):
        for name in verify.names_of_all():
            with self.subTest(name):
                self.assertEqual(verify.Case(name).fault, "")
                readme = (verify.ROOT / "verification" / name / "README.md").read_text(encoding="utf-8")
                self.assertIn("**Claim**", readme)

    def test_tables_in_the_tree_name_the_checks_and_limits_of_today(self):
        """A README whose table is older than its accept.py is found without running anything."""
        for name in verify.names_of_all():
            readme = (verify.ROOT / "verification" / name / "README.md").read_text(encoding="utf-8")
            for check in verify.Case(name).accept.CHECKS:
                with self.subTest(f"{name}: {check.name}"):
                    evidence = getattr(check, "evidence", None)
                    name = f"{check.name} ({evidence})" if evidence else check.name
                    lines = [line for line in readme.splitlines() if line.startswith(f"| {name} |")]
                    self.assertGreaterEqual(len(lines), 1, "scripts/verify.py --write brings the table up to date")
                    if not isinstance(check, Report):
                        self.assertIn(f"| {verify.share(check.within)} |", lines[0])


class ReferencesTest(unittest.TestCase):
    def test_references_give_the_numbers_of_the_catalogue(self):
        """Each reference.py has doctests; they run here."""

        import importlib.util
        for name in verify.names_of_all():
            path = verify.ROOT / "verification" / name / "reference.py"
            spec = importlib.util.spec_from_file_location(f"reference_of_{name}", path)
            module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            with self.subTest(name), contextlib.redirect_stdout(io.StringIO()) as said:
                result = doctest.testmod(module)
                self.assertEqual(result.failed, 0, said.getvalue())
                self.assertGreater(result.attempted, 0, "no doctest")

    def test_decks_for_other_codes_can_be_written(self):
        """Examples of what they share hold, and each gives a deck with a step."""
        import importlib.util
        decks = sorted(verify.ROOT.glob("verification/*/deck.py"))
        self.assertGreater(len(decks), 1)
        for path in decks:
            spec = importlib.util.spec_from_file_location(f"deck_of_{path.parent.name}", path)
            module = importlib.util.module_from_spec(spec)
            with self.subTest(path.parent.name), contextlib.redirect_stdout(io.StringIO()) as said:
                spec.loader.exec_module(module)
                self.assertEqual(doctest.testmod(module).failed, 0, said.getvalue())
                if hasattr(module, "deck"):
                    self.assertIn("*STEP", "\n".join(module.deck(4)))

    def test_references_import_nothing_of_ours(self):
        allowed = {"math", "cmath", "collections", "fractions", "dataclasses", "functools", "itertools", "random"}
        for name in verify.names_of_all():
            text = (verify.ROOT / "verification" / name / "reference.py").read_text(encoding="utf-8")
            imported = [line.split()[1].split(".")[0] for line in text.splitlines() if line.startswith(("import ", "from "))]
            with self.subTest(name):
                self.assertLessEqual(set(imported), allowed)


def load_tests(_, tests, __):
    tests.addTests(doctest.DocTestSuite(verify.break_size))
    return tests


class AddingTest(unittest.TestCase):
    def test_files_of_the_example_are_quoted_as_they_are(self):
        page = (verify.ROOT / "docs" / "adding.md").read_text(encoding="utf-8")
        quoted = re.findall(r"^```\w+\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
        for name in ("case.yaml", "reference.py", "accept.py", "README.md"):
            with self.subTest(name):
                text = (verify.ROOT / "verification" / "suddenly_pulled_bar" / name).read_text(encoding="utf-8")
                text = text.split("<!-- written by")[0].rstrip() + "\n"
                self.assertTrue(text in quoted, f"docs/adding.md quotes another {name}")


if __name__ == "__main__":
    unittest.main()
