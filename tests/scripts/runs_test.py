"""scripts/runs.py keeps runs and finds them again, with a driver that is made up here."""
import base64
import json
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import made_up

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import case_values  # noqa: E402  (after the path)
import runs  # noqa: E402

# A driver that reads a mesh named in its case, by the key or by --set, and says so as drivers do: in the resolved case.
DRIVER = """#!{python}
import json
import sys
from pathlib import Path
out, case = Path(sys.argv[sys.argv.index("--out") + 1]), Path(sys.argv[1])
if "mistake=1" in sys.argv:
    print("case.yaml:1:1: there is a mistake", file=sys.stderr)
    sys.exit(2)
count = Path({count!r})
count.write_text(str(int(count.read_text()) + 1))
named = [word[len("mesh.path="):] for word in sys.argv if word.startswith("mesh.path=")] or {read}
depth = len((case.parent / named[0]).read_text())
(out / "body").mkdir()
(out / "body" / "body_0.vtu").write_text("a frame")
(out / "history.csv").write_text("time [s],depth [m]\\n0,0\\n1,2\\n")
resolved = {{"mesh": {{"kind": {{"value": "file"}}, "path": {{"value": named[0]}}}}}}
(out / "summary.json").write_text(json.dumps({{"ending": {{"word": "reached_end"}}, "results": {{"depth": {{"value": depth}}}},
                                              "provenance": {{"resolved": resolved}}}}))
"""


class DriverTest(unittest.TestCase):
    def test_a_case_says_its_program(self):
        """By its keys, its folder, or accept.py beside it."""
        root = made_up.folder(self, "")
        made_up.driver(root, "two_blocks", "")
        for folder, text, program in (("two_blocks", "blocks: {}\n", "two_blocks"), ("two_blocks", "bodies: []\ntime: {}\n", "scene"),
                                      ("bars", "bodies: []\nstages: []\n", "scene"), ("bars", "bodies: []\n", "modes"),
                                      ("modes", "bodies: []\ntime: {}\n", "modes"), ("bars", "blocks: {}\n", "sliding"),
                                      ("else", "blocks: {}\n", "scene")):
            with self.subTest(folder=folder, text=text):
                case = root / folder / "case.yaml"
                case.parent.mkdir(exist_ok=True)
                case.write_text(text)
                (root / "bars").mkdir(exist_ok=True)
                (root / "bars/accept.py").write_text('DRIVER = "sliding"\n')
                (root / "drivers/modes").write_text("")
                self.assertEqual(runs.driver_of(case, root / "drivers"), program)


class StoreTest(unittest.TestCase):
    def setUp(self):
        self.root = made_up.folder(self, "mesh: {kind: file, path: mesh.vtu}\n")
        self.count, self.case = self.root / "count", self.root / "case.yaml"
        (self.root / "mesh.vtu").write_text("one mesh")
        self.build("")

    def build(self, comment, read='["mesh.vtu"]'):
        """`read` is how the made-up driver finds the mesh in the case."""
        made_up.driver(self.root, "made_up", DRIVER + comment, read=read)

    def run_it(self, settings=None, threads=None):
        return runs.Store(self.root / "drivers", self.root / "runs").run("made_up", self.case, settings or {}, threads)

    def test_a_run_is_made_once_and_found_again(self):
        self.assertTrue(self.run_it().made)
        again = self.run_it()
        self.assertFalse(again.made)
        self.assertEqual(self.count.read_text(), "1")
        self.assertEqual(again.at("depth", 0.5), 1.0)
        self.assertEqual(again.result("depth"), len("one mesh"))

    def test_what_a_killed_run_has_left_goes_and_one_that_goes_on_stays(self):
        folder = self.root / "runs"
        gone = subprocess.Popen(["true"])
        gone.wait()
        for name in (f"unfinished_{gone.pid}_a", f"unfinished_{os.getpid()}_b", "unfinished_c"):
            (folder / name).mkdir(parents=True)
        self.run_it()
        self.assertEqual([path.name for path in folder.glob("unfinished_*")], [f"unfinished_{os.getpid()}_b"])

    def test_runs_that_nobody_asked_for_go_but_for_those_of_another_tree(self):
        used, mine, other = self.run_it(), self.run_it({"a": 1}), self.run_it({"a": 2})
        runs.write_record(other.folder, {**runs.record_of(other.folder), "suite": "/elsewhere"})
        self.assertTrue(runs.remove_unused(self.root / "runs", {used.folder.name}))
        self.assertEqual([one.folder.exists() for one in (used, mine, other)], [True, False, True])

    def test_a_run_that_two_trees_use_stays_until_neither_does(self):
        folder = self.run_it().folder
        here = runs.ROOT
        self.addCleanup(setattr, runs, "ROOT", here)
        runs.ROOT = Path("/elsewhere")
        self.assertFalse(self.run_it().made)
        runs.ROOT = here
        runs.remove_unused(self.root / "runs", set())
        self.assertTrue(folder.exists())
        self.assertFalse(self.run_it().made)
        runs.ROOT = Path("/elsewhere")
        runs.remove_unused(self.root / "runs", set())  # made by the other tree
        self.assertTrue(folder.exists())
        runs.ROOT = here
        runs.remove_unused(self.root / "runs", set())
        self.assertFalse(folder.exists())

    def test_nothing_goes_while_another_process_uses_the_folder(self):
        folder = self.run_it().folder
        words = [sys.executable, "-c", "import sys, runs; runs.Store(*sys.argv[1:]); print('there', flush=True); sys.stdin.read()",
                 self.root / "drivers", self.root / "runs"]
        with subprocess.Popen(words, cwd=runs.ROOT / "scripts", stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
            self.assertEqual(other.stdout.readline(), b"there\n")
            self.assertFalse(runs.remove_unused(self.root / "runs", set()))
            self.assertTrue(folder.exists())
            other.kill()
        self.assertTrue(runs.remove_unused(self.root / "runs", set()))
        self.assertFalse(folder.exists())

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

    @unittest.skipUnless(case_values.yaml, "without yaml a case counts byte by byte")
    def test_comments_layout_and_order_do_not_count_and_values_do(self):
        self.case.write_text("mesh: {kind: file, path: mesh.vtu}\ntime: {end: 1 ms}\n")
        self.run_it()
        for same in ("# why\nmesh: {kind: file, path: mesh.vtu}\ntime: {end: 1 ms}\n",
                     "time: {end: 1 ms}\nmesh: {path: mesh.vtu, kind: file}\n",
                     "time:\n  end: 1 ms  # long enough\nmesh:\n\n  path: mesh.vtu\n  kind: file\n"):
            self.case.write_text(same)
            with self.subTest(same):
                self.assertFalse(self.run_it().made)
        for other in ("mesh: {kind: file, path: mesh.vtu}\ntime: {end: 2 ms}\n", "mesh: {kind: file, path: mesh.vtu}\n",
                      "mesh: {kind: file, path: mesh.vtu}\ntime: {end: 1e-3 s}\n",
                      "mesh: {kind: file, path: mesh.vtu}\ntime: {end: '1 ms'}\n"):
            self.case.write_text(other)
            with self.subTest(other):
                self.assertTrue(self.run_it().made)

    def test_a_run_of_an_earlier_mesh_or_value_is_found_again(self):
        self.run_it()
        (self.root / "mesh.vtu").write_text("another mesh")
        self.run_it()
        (self.root / "mesh.vtu").write_text("one mesh")
        self.assertEqual(self.run_it().result("depth"), len("one mesh"))
        self.assertEqual(self.count.read_text(), "2")

    def test_another_program_makes_it_anew(self):
        self.run_it()
        made_up.driver(self.root, "another", DRIVER, read='["mesh.vtu"]')
        self.assertTrue(runs.Store(self.root / "drivers", self.root / "runs").run("another", self.case, {}).made)

    def test_a_flipped_bit_in_any_file_makes_it_anew(self):
        folder = self.run_it().folder
        files = [path for path in folder.rglob("*") if path.is_file()]
        self.assertIn(folder / runs.RECORD, files)
        for path in files:
            data = bytearray(path.read_bytes())
            for at in {0, len(data) // 2, len(data) - 1}:
                path.write_bytes(data[:at] + bytes([data[at] ^ 1]) + data[at + 1:])
                with self.subTest(path=path.name, at=at):
                    self.assertTrue(self.run_it().made)

    def test_a_changed_mesh_makes_it_anew_however_the_case_names_it(self):
        for text, settings in (("kind: file\n", {"mesh.path": "mesh.vtu"}), ("there: &where mesh.vtu\nmesh: {path: *where}\n", {}),
                               ('mesh: {path: "mesh\\x2evtu"}\n', {}), ("mesh: {'path': 'mesh.vtu'}\n", {}),
                               ('mesh: {"path":\n  mesh.vtu}\n', {})):
            with self.subTest(text):
                self.case.write_text(text)
                (self.root / "mesh.vtu").write_text("one mesh")
                self.assertEqual(self.run_it(settings).result("depth"), len("one mesh"))
                self.assertFalse(self.run_it(settings).made)
                (self.root / "mesh.vtu").write_text("a finer mesh")
                self.assertEqual(self.run_it(settings).result("depth"), len("a finer mesh"))
                (self.root / "mesh.vtu").unlink()
                (self.root / "mesh.vtu").mkdir()  # and one that is gone is not found either
                with self.assertRaises(runs.CannotRun):
                    self.run_it(settings)
                (self.root / "mesh.vtu").rmdir()

    def test_a_mesh_that_changes_within_one_study_is_noticed(self):
        store = runs.Store(self.root / "drivers", self.root / "runs")
        self.assertEqual(store.run("made_up", self.case, {}).result("depth"), len("one mesh"))
        (self.root / "mesh.vtu").write_text("two mesh")
        self.assertTrue(store.run("made_up", self.case, {}).made)

    def test_a_run_whose_files_were_touched_is_made_anew(self):
        folder = self.run_it().folder
        whole = (folder / "history.csv").read_text()

        def cut():
            (folder / "history.csv").write_text(whole[:whole.index("\n1,")] + "\n")

        for touch in (cut, lambda: (folder / "body" / "body_0.vtu").unlink(),
                      lambda: (folder / "body" / "body_0.vtu").write_text("A frame"),
                      lambda: (folder / "summary.json").write_text("{}"), lambda: (folder / "other").write_text(""),
                      lambda: (folder / runs.RECORD).write_text(json.dumps({"driver": "made_up", "seconds": 1}))):
            touch()
            self.assertTrue(self.run_it().made)
            self.assertFalse(self.run_it().made)
            self.assertEqual((folder / "history.csv").read_text(), whole)

    def test_a_case_of_the_same_text_in_another_folder_has_another_mesh(self):
        self.run_it()
        other = self.root / "other"
        other.mkdir()
        (other / "case.yaml").write_text(self.case.read_text())
        (other / "mesh.vtu").write_text("mesh of the other")
        run = runs.Store(self.root / "drivers", self.root / "runs").run("made_up", other / "case.yaml", {})
        self.assertEqual(run.result("depth"), len("mesh of the other"))

    def test_without_leave_to_run_the_newest_whole_run_of_any_build_is_found(self):
        def find():
            return runs.Store(self.root / "drivers", self.root / "runs", may_run=False).run("made_up", self.case, {})
        with self.assertRaisesRegex(runs.CannotRun, "holds no run"):
            find()
        self.run_it()
        self.build("# other")
        self.assertEqual(find().result("depth"), len("one mesh"))
        newest = self.run_it()
        self.assertEqual(find().folder, newest.folder)

    def test_the_commit_in_a_program_does_not(self):
        self.build("# " + "a" * 40 + "\0")
        self.run_it()
        self.build("# " + "b" * 40 + "\0")
        self.assertFalse(self.run_it().made)

    def test_a_refused_case_leaves_nothing_and_tells_what_the_driver_said(self):
        with self.assertRaisesRegex(runs.CannotRun, "there is a mistake"):
            self.run_it({"mistake": 1})
        self.assertEqual({path.name for path in (self.root / "runs").iterdir()}, {"scratch", runs.LOCK})

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

    def test_a_straight_line_is_found_again_and_weights_count(self):
        slope, start = runs.straight_line([(x, 3 - 2 * x) for x in (0, 1, 2.5, 4)])
        self.assertAlmostEqual(slope, -2)
        self.assertAlmostEqual(start, 3)
        slope, start = runs.straight_line([(0, 1, 1), (1, 2, 1), (2, 100, 0)])
        self.assertAlmostEqual(slope, 1)
        self.assertAlmostEqual(start, 1)

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

    def test_points_are_those_at_the_start_in_files_of_today_and_older_ones(self):
        def array(name, kind, *values, width=1):
            data = struct.pack(f"<{len(values)}{kind}", *values)
            packed = zlib.compress(data)
            text = base64.b64encode(struct.pack("<4Q", 1, 32768, len(data), len(packed))) + base64.b64encode(packed)
            of_kind = {"d": "Float64", "i": "Int32"}[kind]
            return (f'<DataArray type="{of_kind}" Name="{name}" NumberOfComponents="{width}" format="binary">{text.decode()}</DataArray>')

        units = array("units", "i", 1)
        # arrays of the whole file have names of bodies, which may be those of fields
        now = array("points_are_deformed", "i", 1) + array("displacement [m]", "d", 1.0) + array("points", "i", 0, 3)
        for whole, points in ((units, (1.0, 2.0, 3.0)), (now, (1.5, 2.0, 3.0))):
            with self.subTest(whole), tempfile.TemporaryDirectory() as folder:
                file = Path(folder) / "one.vtu"
                file.write_text(f"<VTKFile><Grid><FieldData>{whole}</FieldData><Piece><PointData>"
                                f'{array("displacement", "d", 0.5, 0.0, 0.0, width=3)}</PointData><Points>'
                                f'{array("points", "d", *points, width=3)}</Points></Piece></Grid></VTKFile>', encoding="utf-8")
                self.assertEqual(runs.read_fields(file), {"displacement": [(0.5, 0.0, 0.0)], "points": [(1.0, 2.0, 3.0)],
                                                          "positions": [(1.5, 2.0, 3.0)]})


if __name__ == "__main__":
    unittest.main()
