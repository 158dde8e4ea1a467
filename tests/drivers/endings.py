"""Every run ends with a status that says whose fault it is, and one sentence: never by a signal, a hang or all memory of the machine.

    python3 tests/drivers/endings.py DRIVERS              DRIVERS: the folder with the programs
    python3 tests/drivers/endings.py DRIVERS Machine

tests/drivers/fuzz.py looks for endings that nobody has thought of; what it finds is kept here or in bad_cases/.
"""
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree
from pathlib import Path

CASES = Path(__file__).resolve().parent / "cases"
PATIENCE = 60  # [s] each run takes less than a second
LITTLE_MEMORY = [(resource.RLIMIT_AS, 1 << 30)]


class InAFolder(unittest.TestCase):
    drivers = None  # folder of the programs, from the command line

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out"

    def run_words(self, *words, limits=(), **options):
        """A run of `scene`, with limits as in (resource.RLIMIT_AS, bytes)."""
        def limit():
            for what, most in limits:
                resource.setrlimit(what, (most, most))
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        return subprocess.run([self.drivers / "scene", *words], cwd=self.folder, text=True, timeout=PATIENCE, preexec_fn=limit, **options)

    def run_case(self, case, *words, **options):
        return self.run_words(case, "--out", self.out, "--quiet", *words, **options)

    def ends(self, done, status, words):
        """With a status and one sentence."""
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertRegex(done.stderr, words)
        self.assertLess(len(done.stderr), 100_000)

    def results(self):
        return sorted(path.relative_to(self.out).as_posix() for path in self.out.rglob("*") if path.is_file())

    def check_whole(self):
        """What an index lists is there and can be read; a history ends behind a whole row."""
        for index in self.out.glob("*.pvd"):
            for frame in re.findall(r'file="(.*?)"', index.read_text(encoding="utf-8")):
                xml.etree.ElementTree.parse(self.out / frame)
        text = (self.out / "history.csv").read_text(encoding="utf-8")
        self.assertTrue(text.endswith("\n"))
        self.assertEqual({line.count(",") for line in text.splitlines()}, {text.splitlines()[0].count(",")})
        self.assertEqual([*self.out.rglob("*.tmp")], [])


class Inputs(InAFolder):
    """What is no file of ours is refused at once."""

    def sparse(self, name):
        """A file of 15 GB, in a hole of which there is nothing."""
        with open(self.folder / name, "wb") as file:
            file.truncate(14 << 30)
        return name

    def pipe(self, name):
        os.mkfifo(self.folder / name)
        return name

    def noise(self, name):
        (self.folder / name).write_bytes(bytes(range(256)) * 100)
        return name

    def test_cases(self):
        inputs = {"/dev/zero": "a device or a pipe", self.pipe("pipe"): "a device or a pipe", "/dev": "a folder",
                  self.sparse("hole"): "larger than", self.noise("noise"): "neither UTF-8 text nor printable", "none": "No such file"}
        for case, words in inputs.items():
            for run in (self.run_case, lambda case: self.run_words(case, "--dry-run")):
                with self.subTest(case):
                    self.ends(run(case), 2, words)

    def test_meshes(self):
        inputs = {"/dev/zero": "a device, a pipe", self.pipe("pipe"): "a device, a pipe", "/dev": "a device, a pipe",
                  self.sparse("hole"): "no .vtu file", self.noise("noise"): "no .vtu file", "none": "no such file"}
        shutil.copy(CASES / "block_from_file.yaml", self.folder)
        for mesh, words in inputs.items():
            with self.subTest(mesh):
                self.ends(self.run_case("block_from_file.yaml", "--set", f"bodies[0].mesh.path={mesh}", limits=LITTLE_MEMORY), 2, words)

    def test_tables(self):
        inputs = {"/dev/zero": "a device or a pipe", self.pipe("pipe"): "a device or a pipe", "/dev": "a folder",
                  self.sparse("hole"): "larger than", "none": "No such file"}
        text = (CASES / "pushed.yaml").read_text(encoding="utf-8")
        for table, words in inputs.items():
            with self.subTest(table):
                (self.folder / "case.yaml").write_text(text.replace("pushed.csv", table), encoding="utf-8")
                self.ends(self.run_case("case.yaml", limits=LITTLE_MEMORY), 2, words)

    def test_checkpoints(self):
        self.out.mkdir()
        self.sparse("out/checkpoint")
        self.ends(self.run_case(CASES / "block.yaml", "--resume", limits=LITTLE_MEMORY), 2, "no checkpoint")

    def test_thousands_of_faults(self):
        text = (CASES / "block.yaml").read_text(encoding="utf-8")
        texts = {"keys": text + "".join(f"k{key}: 1\n" for key in range(40_000)),
                 "one line": text + "probes: [" + "{a: 1}, " * 2000 + "{}]\n",
                 "brackets": text + "a: " + "[" * 10_000,
                 "aliases": "a: &a [" + "1, " * 1000 + "1]\n" + "".join(f"b{n}: *a\n" for n in range(5000))}
        for name, one in texts.items():
            with self.subTest(name):
                (self.folder / "case.yaml").write_text(one, encoding="utf-8")
                self.ends(self.run_case("case.yaml"), 2, r"case\.yaml:\d+:\d+: ")


class Words(InAFolder):
    """A run says how and why it ended, and where its energy went."""

    def said(self, *words, driver="scene"):
        done = subprocess.run([self.drivers / driver, *words], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)
        return done.returncode, done.stdout.splitlines(), done.stderr

    def test_at_the_end(self):
        status, said, errors = self.said(CASES / "block.yaml", "--out", self.out)
        self.assertEqual((status, errors), (0, ""))
        self.assertRegex(said[-2], r"^energy: .* J")
        self.assertEqual(said[-1], "ended at 0.05 s: reached_end")

    def test_where_physics_stops_it(self):
        status, said, errors = self.said(CASES / "load_without_root.yaml", "--out", self.out)
        self.assertEqual(status, 3)
        self.assertRegex(said[-1], r"^energy: ")
        self.assertRegex(errors.splitlines()[-1], r"^scene: stopped at \S+ s: not_finite.*: \S")

    def test_without_steps(self):
        status, said, errors = self.said(CASES.parents[2] / "cases/material_point/cycle.yaml", "--out", self.out, driver="material_point")
        self.assertEqual((status, errors), (0, ""))
        self.assertEqual(said[-1], "ended: reached_end")

    def test_a_dry_run_stops_where_the_run_would(self):
        for flags in (["--dry-run"], ["--dry-run", "--quiet"], ["--out", self.out]):
            with self.subTest(flags):
                status, _, errors = self.said(CASES / "block.yaml", "--set", 'initial[0].velocity=["1e200", "0", "0"]', *flags)
                self.assertEqual(status, 3, errors)
                self.assertRegex(errors, "not_finite: the kinetic energy of the given velocities is no finite number")

    def test_the_second_signal(self):
        words = [self.drivers / "scene", CASES / "block.yaml", "--out", self.out, "--quiet", "--set", "time.end=1e3 s",
                 "--set", "bodies[0].mesh.cells=[60, 60, 60]"]  # so large that it has not ended before the second one comes
        run = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (run.kill(), run.communicate()))
        patient_until = time.monotonic() + PATIENCE
        while not (self.out / "history.csv").is_file() and time.monotonic() < patient_until:
            time.sleep(0.01)
        for _ in range(2):
            run.send_signal(signal.SIGINT)
            time.sleep(0.02)
        _, said = run.communicate(timeout=PATIENCE)
        self.assertEqual(run.returncode, 6, said)
        self.assertRegex(said, "^scene: (interrupted by a second SIGINT before it could write its last results|stopped at .*)\n$")


class Bounds(InAFolder):
    """What no run could do is refused, by the dry run too, and leaves no results."""

    def check_refused(self, words, *values):
        sets = [word for value in values for word in ("--set", value)]
        for flags in (["--dry-run"], ["--dry-run", "--quiet"], ["--out", "out"], ["--out", "out", "--quiet"]):
            with self.subTest(flags):
                self.ends(self.run_words(CASES / "block.yaml", *sets, *flags), 2, words)
                self.assertEqual([] if not self.out.is_dir() else self.results(), [])

    def test_steps(self):
        self.check_refused(r"'end' = .* s takes \S+ steps .*: expected at most a billion", "time.safety=1e-20")
        self.check_refused(r"'end' = .* s takes \S+ steps .*: expected at most a billion", "time.end=1e300 s")

    def test_frames(self):
        self.check_refused("'frames_every' = 1e-30 s gives .* frames by the end at .*: expected at most a million",
                           "output.frames_every=1e-30 s")

    def test_rows(self):
        self.check_refused("'history_every' = 1e-30 s gives .* rows by the end at .*: expected at most ten million",
                           "output.history_every=1e-30 s")

    def test_elements(self):
        self.check_refused("expected at most a hundred million", "bodies[0].mesh.cells=[100000, 100000, 100000]")


class Machine(InAFolder):
    """Status 5 with the system's words, and what was listed stays readable."""

    long = ["--set", "time.end=1e6 s", "--set", "output.history_every=10 s", "--set", "output.frames_every=500 s"]

    def test_a_disk_that_becomes_full(self):
        done = self.run_case(CASES / "block.yaml", *self.long, limits=[(resource.RLIMIT_FSIZE, 50_000)])
        self.ends(done, 5, r"^scene: cannot write \S*history.csv: File too large\n$")
        self.check_whole()
        self.assertGreater((self.out / "body.pvd").read_text(encoding="utf-8").count("file="), 1)
        self.assertFalse((self.out / "summary.json").exists())

    def test_a_disk_that_is_full(self):
        for most in (0, 100, 1000, 3000):
            with self.subTest(most):
                done = self.run_case(CASES / "block.yaml", limits=[(resource.RLIMIT_FSIZE, most)])
                self.ends(done, 5, r"^scene: cannot write \S*: File too large\n$")
                self.assertFalse((self.out / "summary.json").exists())

    def test_a_folder_that_vanishes(self):
        first = subprocess.Popen([self.drivers / "scene", CASES / "block.yaml", "--out", self.out, "--quiet", *self.long],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(lambda: (first.kill(), first.communicate()))
        patient_until = time.monotonic() + PATIENCE
        while not (self.out / "body/body_000001.vtu").is_file() and time.monotonic() < patient_until:
            time.sleep(0.01)
        self.out.rename(self.folder / "gone")
        _, said = first.communicate(timeout=PATIENCE)
        self.assertEqual(first.returncode, 5, said)
        self.assertRegex(said, r"^scene: cannot write \S*: No such file or directory\n$")
        self.assertFalse(self.out.exists())

    def test_folders_that_cannot_be(self):
        (self.folder / "file").write_text("no folder")
        for out in ("file", "file/below", "/proc/nowhere", "/dev/full", "/dev/null/x"):
            with self.subTest(out):
                self.ends(self.run_words(CASES / "block.yaml", "--out", out), 5, "^scene: cannot ")

    def test_small_memory(self):
        for most in (40, 60, 80, 100, 120):  # [MB] some end before main()
            with self.subTest(most):
                done = self.run_case(CASES / "block.yaml", "--set", "bodies[0].mesh.cells=[40, 40, 40]",
                                     limits=[(resource.RLIMIT_AS, most << 20)])
                if "error while loading shared libraries" not in done.stderr:
                    self.ends(done, 5, "^scene: memory does not suffice: ")

    def test_threads_that_cannot_be_started(self):
        done = self.run_case(CASES / "block.yaml", "--threads", "64", limits=[(resource.RLIMIT_AS, 350 << 20)])
        self.ends(done, 5, "^scene: cannot start 64 threads: Resource temporarily unavailable\n$")

    def test_more_elements_than_memory_holds(self):
        done = self.run_case(CASES / "block.yaml", "--set", "bodies[0].mesh.cells=[400, 400, 400]",
                             limits=[(resource.RLIMIT_AS, 4 << 30)])
        self.ends(done, 5, "^scene: memory does not suffice: 6.4e\\+07 elements take at least 83.2 GB, and .* GB are left\n$")

    def test_words_that_nobody_takes(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = self.run_words(CASES / "block.yaml", "--out", self.out, stdout=full)
        self.ends(done, 5, "^scene: cannot write to standard output\n$")
        self.check_whole()
        self.assertTrue((self.out / "summary.json").is_file())
        reader, writer = os.pipe()
        os.close(reader)
        with open(writer, "w", encoding="utf-8") as gone:
            self.ends(self.run_words(CASES / "block.yaml", "--out", self.out, stdout=gone), 5, "^scene: cannot write to standard output\n$")

    def test_standard_output_is_closed(self):
        words = f"'{self.drivers / 'scene'}' '{CASES / 'block.yaml'}' --out '{self.out}' >&- 2>&-"
        self.assertEqual(subprocess.run(["sh", "-c", words], check=False, timeout=PATIENCE).returncode, 0)
        self.check_whole()


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    InAFolder.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
