"""scripts/runs.py keeps runs and finds them again, with a driver that is made up here."""
import base64
import stat
import struct
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import runs  # noqa: E402  (after the path)

DRIVER = """#!{python}
import sys
from pathlib import Path
out = Path(sys.argv[sys.argv.index("--out") + 1])
if "mistake=1" in sys.argv:
    print("case.yaml:1:1: there is a mistake", file=sys.stderr)
    sys.exit(2)
count = Path({count!r})
count.write_text(str(int(count.read_text()) + 1))
(out / "history.csv").write_text("time [s],depth [m]\\n0,0\\n1,2\\n")
(out / "summary.json").write_text('{{"ending": {{"word": "reached_end"}}, "results": {{"depth": {{"value": 2}}}}}}')
"""


class StoreTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)
        self.count = self.root / "count"
        self.count.write_text("0")
        self.case = self.root / "case.yaml"
        self.case.write_text("mesh: {kind: file, path: mesh.vtu}\n")
        (self.root / "mesh.vtu").write_text("one mesh")
        self.build("")

    def build(self, comment):
        (self.root / "drivers").mkdir(exist_ok=True)
        program = self.root / "drivers" / "made_up"
        program.write_text(DRIVER.format(python=sys.executable, count=str(self.count)) + comment)
        program.chmod(program.stat().st_mode | stat.S_IXUSR)

    def run_it(self, settings=None, threads=None):
        return runs.Store(self.root / "drivers", self.root / "runs").run("made_up", self.case, settings or {}, threads)

    def test_a_run_is_made_once_and_found_again(self):
        self.assertTrue(self.run_it().made)
        again = self.run_it()
        self.assertFalse(again.made)
        self.assertEqual(self.count.read_text(), "1")
        self.assertEqual(again.at("depth", 0.5), 1.0)
        self.assertEqual(again.result("depth"), 2)

    def test_whatever_may_change_it_makes_it_anew(self):
        self.run_it()
        for number, change in enumerate([lambda: self.case.write_text("other: 1\n"), lambda: self.build("# other"),
                                         lambda: self.case.write_text("mesh: {kind: file, path: mesh.vtu}\n"),
                                         lambda: (self.root / "mesh.vtu").write_text("another mesh")], start=2):
            change()
            with self.subTest(number):
                self.assertTrue(self.run_it().made)
        self.assertTrue(self.run_it({"key": 1}).made)
        self.assertTrue(self.run_it(threads=2).made)

    def test_the_commit_in_a_program_does_not(self):
        self.build("# " + "a" * 40 + "\0")
        self.run_it()
        self.build("# " + "b" * 40 + "\0")
        self.assertFalse(self.run_it().made)

    def test_a_refused_case_leaves_nothing_and_tells_what_the_driver_said(self):
        with self.assertRaisesRegex(runs.CannotRun, "there is a mistake"):
            self.run_it({"mistake": 1})
        self.assertEqual([path.name for path in (self.root / "runs").iterdir()], ["scratch"])

    def test_an_unfinished_run_is_not_found(self):
        folder = self.run_it().folder
        (folder / runs.RECORD).unlink()
        self.assertTrue(self.run_it().made)
        self.assertTrue((folder / runs.RECORD).is_file())

    def test_a_program_that_is_not_built_is_told(self):
        with self.assertRaisesRegex(runs.CannotRun, "is not built"):
            runs.Store(self.root, self.root / "runs").run("made_up", self.case, {})


class HistoryTest(unittest.TestCase):
    def test_means_are_over_the_span_and_not_over_the_samples(self):
        self.assertAlmostEqual(runs.mean_over([0, 1, 1.5, 4], [0, 1, 1.5, 4], 0.5, 3.5), 2.0)

    def test_crossings_are_found_between_samples(self):
        self.assertEqual(runs.crossings([0, 1, 2, 3], [-1, 1, 1, -3]), [0.5, 2.25])
        self.assertEqual(runs.crossings([0, 1, 2, 3], [-1, 1, 1, -3], rising=True), [0.5])

    def test_packed_arrays_are_read_back(self):
        data = struct.pack("<6d", *range(6))
        packed = [zlib.compress(data[:32]), zlib.compress(data[32:])]
        head = struct.pack("<5Q", 2, 32, 16, *(len(block) for block in packed))
        text = base64.b64encode(head).decode() + base64.b64encode(b"".join(packed)).decode()
        self.assertEqual(runs.unpacked(text), data)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "one.vtu"
            file.write_text(f'<VTKFile><DataArray type="Float64" Name="x" NumberOfComponents="3" format="binary">{text}'
                            "</DataArray></VTKFile>")
            self.assertEqual(runs.read_fields(file), {"x": [(0.0, 1.0, 2.0), (3.0, 4.0, 5.0)]})


if __name__ == "__main__":
    unittest.main()
