"""Whose a folder of results is, seen from outside: no run deletes what it reads, leaves the results of an older run as
if they were its own, or writes beside another run.

    python3 tests/drivers/run_folder.py DRIVERS                    DRIVERS: the folder with the programs
    python3 tests/drivers/run_folder.py DRIVERS Inputs
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

CASES = Path(__file__).resolve().parent / "cases"
PATIENCE = 60  # [s] each run takes less than a second


class InAFolder(unittest.TestCase):
    drivers = None  # folder of the programs, from the command line

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"

    def words(self, case, *flags, driver="scene"):
        return [self.drivers / driver, case, "--out", self.out, "--quiet", *flags]

    def run_case(self, case, *flags, driver="scene"):
        return subprocess.run(self.words(case, *flags, driver=driver), cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)

    def run_to_end(self, case, *flags):
        done = self.run_case(case, *flags)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def copy(self, name, to=None):
        to = self.folder / (to or name)
        to.parent.mkdir(parents=True, exist_ok=True)
        return Path(shutil.copy(CASES / name, to))

    def files(self):
        return {path.relative_to(self.folder).as_posix(): path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}

    def ending(self):
        return json.loads((self.out / "summary.json").read_text(encoding="utf-8"))["ending"]


class Threads(InAFolder):
    """How many there are."""

    def threads(self, variable, *flags):
        done = subprocess.run(self.words(CASES / "block.yaml", *flags), cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE,
                              env={**os.environ, "NEREID_THREADS": variable})
        if done.returncode:
            return done.returncode, done.stderr
        return json.loads((self.out / "summary.json").read_text(encoding="utf-8"))["cost"]["threads"]

    def test_the_variable_is_the_default_of_the_option(self):
        self.assertEqual(self.threads("3"), 3)
        self.assertEqual(self.threads("3", "--threads", "2"), 2)
        self.assertEqual(self.threads("x", "--threads", "2"), 2)

    def test_a_bad_variable_is_named(self):
        for text in ("0", "-1", "nan", "1e9", "two"):
            status, said = self.threads(text)
            self.assertEqual(status, 2)
            self.assertIn(f"'{text}' is no number of threads: expected is 1 to 1024, also in NEREID_THREADS", said)


class Inputs(InAFolder):
    """What a run reads is there after it."""

    def test_a_mesh_among_the_frames_that_would_be_cleared(self):
        self.run_to_end(CASES / "block.yaml")
        case = self.copy("block_from_file.yaml")
        values = ["--set", "bodies[0].mesh.path=out/body/body_000003.vtu"]
        before = self.files()
        for flags in ([], ["--dry-run"]):
            done = self.run_case(case, *values, *flags)
            self.assertEqual(done.returncode, 2)
            self.assertIn("would overwrite or clear its own input", done.stderr)
            self.assertIn("out/body/body_000003.vtu", done.stderr)
            self.assertIn("--set bodies[0].mesh.path=", done.stderr.splitlines()[0])
        self.assertEqual(self.files(), before)

    def test_the_place_of_the_path_is_told(self):
        self.run_to_end(CASES / "block.yaml")
        case = self.copy("block_from_file.yaml")
        (self.folder / "mesh.vtu").symlink_to("out/body/body_000000.vtu")
        done = self.run_case(case)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr.splitlines()[0], r"^\S*block_from_file.yaml:3:\d+: this run would overwrite or clear its own input ")
        self.assertTrue((self.out / "body/body_000000.vtu").is_file())

    def test_a_mesh_of_another_name_beside_the_frames(self):
        self.run_to_end(CASES / "block.yaml")
        case = self.copy("block_from_file.yaml", "out/body/case.yaml")
        mesh = (self.out / "body/body_000000.vtu").rename(self.out / "body/mesh.vtu")
        before = mesh.read_bytes(), case.read_bytes()
        for _ in range(2):
            self.run_to_end(case)
            self.assertEqual((mesh.read_bytes(), case.read_bytes()), before)
        self.assertEqual(self.ending()["word"], "reached_end")

    def test_a_case_in_the_folder(self):
        case = self.copy("block.yaml", "out/case.yaml")
        before = case.read_bytes()
        self.run_to_end(case)
        self.assertEqual(case.read_bytes(), before)

    def test_a_table_among_the_old_results(self):
        self.copy("pushed.csv")
        case = self.copy("pushed.yaml")
        self.run_to_end(case)
        for name in ("history.csv", "summary.json"):
            for where, flags in (("pushed.yaml", []), ("out/case.yaml", []), ("pushed.yaml", ["--dry-run"])):
                with self.subTest(name, where=where, flags=flags):
                    case = self.folder / where
                    case.write_text((CASES / "pushed.yaml").read_text(encoding="utf-8").replace("pushed.csv", f"{self.out}/{name}"))
                    self.assertIn(f"{self.out}/{name}", case.read_text(encoding="utf-8"))
                    shutil.copy(self.folder / "pushed.csv", self.out / name)
                    before = self.files()
                    done = self.run_case(case, *flags)
                    self.assertEqual(done.returncode, 2)
                    self.assertIn("would overwrite or clear its own input", done.stderr)
                    self.assertEqual(self.files(), before)

    def test_a_case_called_as_a_result(self):
        for name in ("summary.json", "history.csv", "body.pvd", "body/body_000000.vtu", "run.lock"):
            with self.subTest(name):
                case = self.copy("block.yaml", f"out/{name}")
                before = self.files()
                done = self.run_case(case)
                self.assertEqual(done.returncode, 2)
                self.assertIn("would overwrite or clear its own input", done.stderr)
                self.assertEqual(self.files(), before)
                case.unlink()


class Offenders(InAFolder):
    """Elements of a mesh at fault are results of the run that found them."""

    SHOWN = ["out/offenders.pvd", "out/offenders/offenders_000000.vtu"]

    def setUp(self):
        super().setUp()
        self.case = self.copy("block_from_file.yaml")
        shutil.copy(CASES.parent / "bad_cases/meshes/mesh_twisted.vtu", self.folder / "mesh.vtu")

    def shown(self):
        return sorted(name for name in self.files() if "offenders" in name)

    def test_a_refused_mesh_is_shown_until_the_next_run(self):
        self.assertEqual(self.run_case(self.case).returncode, 2)
        self.assertEqual(self.shown(), self.SHOWN)
        self.run_to_end(CASES / "block.yaml")
        self.assertEqual(self.shown(), [])

    def test_a_dry_run_writes_nothing(self):
        self.assertEqual(self.run_case(self.case, "--dry-run").returncode, 2)
        self.assertFalse(self.out.exists())

    def test_a_mesh_of_offenders_is_not_overwritten(self):
        self.assertEqual(self.run_case(self.case).returncode, 2)
        before = self.files()
        done = self.run_case(self.case, "--set", "bodies[0].mesh.path=out/offenders/offenders_000000.vtu")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(self.files(), before)

    def test_what_is_warned_of_is_shown_beside_the_results(self):
        ring = ("{kind: box, low: [1 m, 0 m, 0 m], high: [2 m, 6.283185307179586 m, 1 m], cells: [1, 12, 1], "
                "map: [x*cos(y), x*sin(y), z]}")
        self.case.write_text(self.case.read_text(encoding="utf-8").replace("{kind: file, path: mesh.vtu}", ring), encoding="utf-8")
        done = self.run_case(self.case)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("warning: a: 2 elements with a node at the place of another node", done.stderr)
        self.assertEqual(self.shown(), self.SHOWN)
        notes = json.loads((self.out / "summary.json").read_text(encoding="utf-8"))["notes"]
        self.assertTrue(any("at the place of another node" in note for note in notes), notes)


class Stale(InAFolder):
    """Results of an older run are never there as those of this one."""

    def setUp(self):
        super().setUp()
        self.run_to_end(CASES / "block.yaml")
        self.assertTrue((self.out / "summary.json").is_file())

    def check_gone(self, status, done):
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertFalse((self.out / "summary.json").exists())
        self.assertFalse((self.out / "history.csv").exists())
        self.assertEqual([*self.out.glob("*.stale")], [])

    def test_a_bad_case(self):
        self.check_gone(2, self.run_case(CASES / "block.yaml", "--set", "time.end=-1 s"))

    def test_no_case(self):
        self.check_gone(2, self.run_case("none.yaml"))

    def test_a_bad_case_of_a_driver_without_a_run(self):
        self.check_gone(2, self.run_case(CASES / "block.yaml", driver="material_point"))

    def test_a_disk_that_takes_nothing(self):
        shutil.rmtree(self.out / "body")
        (self.out / "body").write_text("no folder")
        done = self.run_case(CASES / "block.yaml")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertFalse((self.out / "summary.json").exists())

    def test_a_folder_that_can_be_gone_on_from_stays_so(self):
        (self.out / "checkpoint").write_text("of a run that was stopped")
        before = self.files()
        for flags, status in ((["--set", "time.end=-1 s"], 2), (["--set", "bodies[0].mesh.cells=[4000, 100, 100]"], 5)):
            done = subprocess.run(["bash", "-c", 'ulimit -v 4000000; "$@"', "", *self.words(CASES / "block.yaml", *flags)], check=False,
                                  cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertEqual(self.files(), before)

    def test_what_a_killed_run_had_set_aside_is_taken_back_to_go_on(self):
        before = self.files()
        for name in ("summary.json", "history.csv"):
            (self.out / name).rename(self.out / f"{name}.stale")
        done = self.run_case(CASES / "block.yaml", "--resume")
        self.assertEqual((done.returncode, "there is nothing to resume" in done.stderr), (0, True), done.stderr)
        self.assertEqual(self.files(), before)

    def test_a_folder_of_frames_that_is_a_link_stays_one(self):
        shutil.move(self.out / "body", self.folder / "elsewhere")
        (self.out / "body").symlink_to(self.folder / "elsewhere")
        self.run_to_end(CASES / "block.yaml")
        self.assertTrue((self.out / "body").is_symlink())
        self.assertTrue([*(self.folder / "elsewhere").glob("body_*.vtu")])

    def test_frames_of_another_driver_go_too(self):
        (self.out / "contact").mkdir(exist_ok=True)
        (self.out / "contact/contact_000099.vtp").write_text("old")
        done = self.run_case(CASES / "block.yaml", driver="modes")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse((self.out / "contact/contact_000099.vtp").exists())
        self.assertFalse((self.out / "contact.pvd").exists())

    def test_a_dry_run_touches_nothing(self):
        before = self.files()
        self.assertEqual(self.run_case(CASES / "block.yaml", "--dry-run").returncode, 0)
        self.assertEqual(self.run_case(CASES / "block.yaml", "--dry-run", "--set", "time.end=-1 s").returncode, 2)
        self.assertEqual(self.files(), before)

    def test_a_command_line_that_is_not_understood_touches_nothing(self):
        before = self.files()
        self.assertEqual(self.run_case(CASES / "block.yaml", "--dryrun").returncode, 2)
        self.assertEqual(self.files(), before)


class Shared(InAFolder):
    """One folder, one run."""

    def test_two_runs(self):
        long = ["--set", "time.end=1e6 s", "--set", "output.history_every=100 s"]
        first = subprocess.Popen(self.words(CASES / "block.yaml", *long), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self.addCleanup(lambda: (first.kill(), first.communicate()))
        patient_until = time.monotonic() + PATIENCE
        while not (self.out / "body.pvd").is_file() and time.monotonic() < patient_until:
            time.sleep(0.01)
        for flags in ([], ["--set", "time.end=-1 s"]):
            second = self.run_case(CASES / "block.yaml", *flags)
            self.assertEqual(second.returncode, 5)
            self.assertEqual(second.stderr, f"scene: another run writes to the folder {self.out}; wait for its end or choose another one\n")
            self.assertTrue((self.out / "history.csv").is_file())
        self.assertEqual(self.run_case(CASES / "block.yaml", "--dry-run").returncode, 0)
        self.assertIsNone(first.poll(), "the first run goes on")
        first.kill()
        first.wait()
        self.run_to_end(CASES / "block.yaml")  # what was killed does not block
        self.assertFalse((self.out / "run.lock").exists())


class BeyondNumbers(InAFolder):
    """Positions that no number holds end a run by a word, with its histories, and never by a signal."""

    def check_stopped(self, name, words, *flags):
        done = self.run_case(CASES / name, *flags)
        self.assertEqual(done.returncode, 3, done.stderr)
        ending = self.ending()
        self.assertIn(ending["word"], words)
        self.assertTrue(ending["reason"])
        self.assertGreater(len((self.out / "history.csv").read_text(encoding="utf-8").splitlines()), 1)
        for collection in ("body", "contact"):
            self.assertTrue((self.out / f"{collection}.pvd").is_file())

    def test_a_load_that_becomes_no_number(self):
        self.check_stopped("load_without_root.yaml", ["not_finite"])

    def test_a_tug_beyond_numbers(self):
        # volumes of places at 1e288 m may be 0 as well as NaN
        self.check_stopped("tug_beyond_numbers.yaml", ["not_finite", "inverted_element"])

    def test_a_rigid_body_that_is_pushed_by_no_number(self):
        self.check_stopped("load_without_root.yaml", ["not_finite"], "--set", "bodies[1].rigid=true")

    def test_plates_that_are_pushed_by_no_number(self):
        self.check_stopped("plates_without_root.yaml", ["not_finite"])

    def test_an_energy_beyond_numbers(self):
        self.check_stopped("block.yaml", ["not_finite"], "--set", "bodies[0].material.density=1e300 kg/m^3", "--set",
                           "gravity=[0 m/s^2, 0 m/s^2, -9.81 m/s^2]")

    def test_a_box_beyond_numbers(self):
        for flags in ([], ["--dry-run"]):
            done = self.run_case(CASES / "box_beyond_numbers.yaml", *flags)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("a node stands 1e+300 m from the origin", done.stderr)


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    InAFolder.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
