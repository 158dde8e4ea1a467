"""What `--accuracy 2%` does, seen from outside: meshes that become finer, an estimate within the target, and clear refusals.

    python3 tests/drivers/accuracy.py DRIVERS      DRIVERS: the folder with the programs
"""
import json
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PATIENCE = 300  # [s]
ROOT = Path(__file__).resolve().parents[2]
BARS = ROOT / "cases/two_blocks/bars.yaml"
LINE = re.compile(r"^refine ([\d.]+): contact_time = ([\d.e-]+) s(?:, estimated error ([\d.e-]+) %)?$", re.MULTILINE)


class Accuracy(unittest.TestCase):
    drivers = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name) / "out"

    def words(self, *words):
        return [Accuracy.drivers / "two_blocks", BARS, "--out", self.out, *words]

    def ask(self, *words):
        """(status, what it said, what it complained of, results of the summary)"""
        done = subprocess.run(self.words(*words), capture_output=True, text=True, check=False)
        summary = self.out / "summary.json"
        results = json.loads(summary.read_text(encoding="utf-8"))["results"] if summary.is_file() else {}
        return done.returncode, done.stdout, done.stderr, results

    def test_meshes_become_finer_until_the_estimate_is_within_the_target(self):
        for target in (2.0, 0.3):
            status, said, _, results = self.ask("--accuracy", f"{target}%", "--of", "contact_time")
            self.assertEqual(status, 0)
            lines = LINE.findall(said)
            factors = [float(factor) for factor, *_ in lines]
            self.assertEqual(factors, sorted(set(factors)))
            self.assertEqual([bool(error) for *_, error in lines], [False] + [True] * (len(lines) - 1))
            part = results["contact_time_mesh_error"]["value"] / results["contact_time"]["value"]
            self.assertLessEqual(part, target / 100)
            self.assertAlmostEqual(100 * part, float(lines[-1][2]), delta=0.06 * target)
            for *_, error in lines[1:-1]:
                self.assertGreater(float(error), target)

    def test_the_last_run_is_that_of_its_refine(self):
        status, said, _, results = self.ask("--accuracy", "2%", "--of", "contact_time")
        self.assertEqual(status, 0)
        _, _, _, alone = self.ask("--set", f"refine={LINE.findall(said)[-1][0]}")
        self.assertAlmostEqual(results["contact_time"]["value"] / alone["contact_time"]["value"], 1, delta=1e-5)

    def test_a_target_that_takes_too_long_is_refused_before_the_run(self):
        status, _, complaint, _ = self.ask("--accuracy", "0.01%", "--of", "contact_time", "--longest", "1e-6")
        self.assertEqual(status, 3)
        self.assertRegex(complaint, r"0\.01% is not reached: the next mesh, refine [\d.]+, would take about [\d.e-]+ s\n")

    def test_results_of_an_older_run_go_where_no_mesh_is_run(self):
        self.ask()
        self.assertTrue((self.out / "summary.json").exists())
        self.assertEqual(self.ask("--accuracy", "0.01%", "--of", "contact_time", "--longest", "1e-300")[0], 3)
        self.assertEqual([*self.out.glob("*")], [])

    def test_a_signal_leaves_a_checkpoint_that_can_be_gone_on_from(self):
        for _ in range(10):  # between two meshes there is nothing to keep
            said = self.stopped_by_a_signal()
            found = re.search(r"by SIGTERM; --resume with --set (refine=\S+) and without --accuracy goes on from here\n$", said)
            if found:
                break
            self.assertRegex(said, "0.01% is not reached")
        self.assertTrue(found)
        self.assertEqual(said.count("\n"), 1, said)
        status, _, complaint, _ = self.ask("--resume", "--set", found.group(1))
        self.assertEqual((status, complaint), (0, ""))

    def stopped_by_a_signal(self):
        """What a search for accuracy says that is stopped once a mesh is run with files."""
        shutil.rmtree(self.out, ignore_errors=True)
        words = self.words("--accuracy", "0.01%", "--of", "contact_time")
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            while process.poll() is None and not (self.out / "history.csv").exists():
                time.sleep(1e-3)
            process.send_signal(signal.SIGTERM)
            said = process.communicate(timeout=PATIENCE)[1]
        self.assertEqual(process.returncode, 6, said)
        return said

    def test_what_is_no_result_or_no_target_is_a_fault(self):
        status, _, complaint, _ = self.ask("--accuracy", "2%", "--of", "velocity")
        self.assertEqual(status, 2)
        self.assertIn("velocity_A", complaint)
        for words in (("--accuracy", "two"), ("--accuracy", "200%"), ("--of", "contact_time"), ("--accuracy", "2%", "--dry-run"),
                      ("--accuracy", "2%", "--longest", "nan"), ("--accuracy", "2%", "--longest", "0"),
                      ("--accuracy", "2%", "--set", "refine=2")):
            self.assertEqual(self.ask(*words)[0], 2, words)
        self.assertIn("chooses 'refine' itself", self.ask("--accuracy", "2%", "--set", "refine=2")[2])


if __name__ == "__main__":
    Accuracy.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
