"""scripts/limits.py notices a limit that grew, and the limits of this tree are those of its table and its page."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import limits  # noqa: E402  (after the path)
import verify  # noqa: E402

KEY = ("bar", "speed")
PAGE = (f"# Page\n\n{limits.HEADING}\n\n| case | check | was | is | in | reason |\n|---|---|---|---|---|---|\n| bar | speed | 1 "
        "% | 2 % | abc | made up |\n\n## Next\n")


class LimitsTest(unittest.TestCase):
    def faults(self, tightest, before, limit, lines, kind="check"):
        return limits.faults({KEY: (kind, tightest, before)}, {KEY: (kind, limit)}, lines)

    def test_a_limit_that_grew_needs_a_line_of_the_page(self):
        self.assertIn("says why", self.faults(0.01, 0.02, 0.02, {})[0])
        self.assertEqual(self.faults(0.01, 0.02, 0.02, limits.lines_of(PAGE)), [])
        self.assertIn("the line says", self.faults(0.01, 0.03, 0.03, limits.lines_of(PAGE))[0])

    def test_a_line_of_a_limit_that_is_tight_again_is_a_fault(self):
        self.assertIn("no looser", self.faults(0.01, 0.01, 0.01, limits.lines_of(PAGE))[0])

    def test_a_table_that_is_old_is_a_fault(self):
        self.assertIn("--write", self.faults(0.02, 0.02, 0.01, {})[0])
        self.assertIn("--write", limits.faults({}, {KEY: ("check", 1)}, {})[0])
        self.assertIn("no check", limits.faults({KEY: ("check", 1, 1)}, {}, {})[0])
        self.assertIn("no check", limits.faults({}, {}, {KEY: (1, 2)})[0])

    def test_writing_does_not_hide_a_limit_that_grew(self):
        known = {KEY: ("check", 0.01, 0.01)}
        self.assertEqual(limits.read(limits.written(known, {KEY: ("check", 0.02)})), {KEY: ("check", 0.01, 0.02)})
        self.assertEqual(limits.read(limits.written(known, {KEY: ("check", 0.005)})), {KEY: ("check", 0.005, 0.005)})

    def test_an_order_is_looser_when_it_is_smaller(self):
        self.assertIn("says why", self.faults(1.9, 1.5, 1.5, {}, "order")[0])
        self.assertEqual(self.faults(1.5, 1.9, 1.9, {}, "order"), [])

    def test_no_limit_of_this_tree_grew_without_a_word(self):
        known = limits.read((verify.ROOT / limits.TABLE).read_text(encoding="utf-8"))
        lines = limits.lines_of((verify.ROOT / limits.PAGE).read_text(encoding="utf-8"))
        self.assertEqual(limits.faults(known, limits.limits_of(verify.names_of_all()), lines), [])


if __name__ == "__main__":
    unittest.main()
