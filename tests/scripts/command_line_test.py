"""Bad arguments of scripts get one sentence on stderr and exit status 2."""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class BadArguments(unittest.TestCase):
    def refused(self, *words, says):
        done = subprocess.run([sys.executable, *words], cwd=ROOT / "scripts", capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(says, done.stderr)

    def test_counts(self):
        for script, option in (("verify.py", "--jobs"), ("verify.py", "--threads"), ("trade", "--jobs"), ("refine", "--levels"),
                               ("benchmark", "--rounds")):
            for bad in ("0", "-1", "x", "1.5"):
                with self.subTest(script=script, option=option, bad=bad):
                    self.refused(script, f"{option}={bad}", says="expected is 1 or more")

    def test_numbers_above_zero(self):
        for script, option in (("trade", "--budget"), ("accuracy", "--patience"), ("forecast", "--patience")):
            for bad in ("nan", "inf", "0", "-1", "x"):
                with self.subTest(script=script, bad=bad):
                    self.refused(script, f"{option}={bad}", says="is no positive number")

    def test_folders(self):
        with tempfile.NamedTemporaryFile() as file:
            for script in ("verify.py", "trade", "refine", "accuracy", "stops"):
                with self.subTest(script):
                    self.refused(script, "--out", f"{file.name}/within", says="expected is a folder")
                    self.refused(script, "--drivers", f"{file.name}_missing", says="expected is the folder of the programs")

    def test_unknown_names(self):
        self.refused("verify.py", "no_such_case", says="no folder of verification/ is called no_such_case")
        self.refused("refine", "no_such_case.yaml", says="is no file")


if __name__ == "__main__":
    unittest.main()
