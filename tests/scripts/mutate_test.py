"""The lists of seeded faults fit the tree; a place is found, replaced and told; a test that fails ends those beside it."""
import doctest
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import mutant_list  # noqa: E402  (after the path)
import mutant_tests  # noqa: E402
from mutant_list import Fault  # noqa: E402
from mutant_tests import Test  # noqa: E402


def shell(name, text, group="unit"):
    return Test(name, group, ("sh", "-c", text))


class Lists(unittest.TestCase):
    def test_each_fault_has_one_place_in_the_tree(self):
        found, wrong = mutant_list.read_lists()
        self.assertEqual(wrong + mutant_list.what_is_wrong(found), [])
        self.assertGreaterEqual(len(found), 120)
        self.assertGreaterEqual(sum(fault.list == "stranger" for fault in found), len(found) / 3)

    def test_a_place_that_is_twice_there_or_in_another_is_told(self):
        def fault(number, before, after="z"):
            return Fault(number, "", f"f{number}", "a.cpp", "", "expression", before, after, "")
        self.assertIn("occurs 2 times", mutant_list.switchable("x x", [fault(1, "x")])[1][0])
        self.assertIn("overlaps f1", mutant_list.switchable("a + b + c", [fault(1, "a + b"), fault(2, "b + c")])[1][0])
        self.assertIn("are the same", mutant_list.switchable("x", [fault(1, "x", "x")])[1][0])

    def test_a_fault_of_python_acts_by_its_number_and_tells_that_it_was_reached(self):
        fault = Fault(3, "", "f", "scripts/a.py", "", "expression", "1 + 1", "5", "")
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "mutants.py").write_text(mutant_list.MODULE)
            Path(folder, "a.py").write_text(mutant_list.switchable("print(1 + 1)", [fault])[0])
            told = Path(folder, "told")

            def said(number):
                return subprocess.run([sys.executable, "a.py"], cwd=folder, capture_output=True, text=True, check=True,
                                      env={**os.environ, "NEREID_MUTANT": number, "NEREID_MUTANTS_REACHED": str(told)}).stdout
            self.assertEqual((said("0"), said("3"), said("4")), ("2\n", "5\n", "2\n"))
            self.assertEqual(told.read_text(), "3\n" * 3)


class Asking(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.scratch = Path(self.folder.name)

    def first(self, tests):
        return mutant_tests.first_to_notice(tests, 1, self.scratch, {test.name: 1.0 for test in tests}, 2)

    def test_the_one_that_fails_is_named_and_the_others_end(self):
        started = time.monotonic()
        self.assertEqual(self.first([shell("slow", "sleep 60"), shell("bad", "exit 1"), shell("never", "sleep 60")]), "bad")
        self.assertLess(time.monotonic() - started, 30)

    def test_none_is_named_where_all_pass_or_are_left_out(self):
        self.assertEqual(self.first([shell("good", "exit 0"), shell("without", "exit 77")]), "")

    def test_a_test_that_hangs_has_noticed(self):
        self.assertEqual(mutant_tests.run_test(shell("hangs", "sleep 60"), self.scratch / "a", 1, limit=0.2)[0], "fail")

    def test_the_number_is_that_of_the_fault(self):
        self.assertEqual(mutant_tests.run_test(shell("asks", 'test "$NEREID_MUTANT" = 12'), self.scratch / "a", 12)[0], "pass")


def load_tests(_, tests, __):
    for module in (mutant_list, mutant_tests):
        tests.addTests(doctest.DocTestSuite(module))
    return tests


if __name__ == "__main__":
    unittest.main()
