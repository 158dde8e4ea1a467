"""Runs that are killed and go on from their checkpoints have the bytes of runs that were never stopped.

    python3 tests/drivers/restart.py DRIVERS              DRIVERS: the folder with the programs
    python3 tests/drivers/restart.py DRIVERS --all N      every case of verification/ that `scene` runs in N seconds at most: takes long
    python3 tests/drivers/restart.py DRIVERS --other OTHER Width
                                                          two builds with packs of different width go on from each other's checkpoints

A killed run ends by SIGKILL, SIGTERM, SIGINT or SIGHUP at moments drawn from a seed, also while it writes, and goes on until it is done.
All files are compared, byte by byte, but for what summary.json says of times and of the machine.
"""
import io
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 300    # [s]
CHECKPOINTS = 12  # in a run
KILLS = 4         # at most, of one run
SIGNALS = [signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
INTERRUPTED = 6   # exit status

# together: every element and law, every kind of contact, friction, bonds, floors, planes, loads, relaxation, rigid bodies, probes, stops
CASES = {
    "automatic contact with friction": ("automatic_contact/blocks.yaml", {"time.end": "40 us"}),
    "automatic contact by a penalty": ("automatic_contact/blocks.yaml", {"time.end": "40 us", "contacts[0].method": "penalty"}),
    "edges that cross": ("crossing_bars/case.yaml", {}),
    "rigid bodies on a plane, friction": ("rigid_slider/on_a_plane.yaml", {}),
    "a bond": ("bonded_bar/case.yaml", {}),
    "a floor, plates on solids, plasticity": ("cask_drop/scene.yaml", {}),
    "a rigid plane by a penalty": ("cask_drop/unilateral.yaml", {}),
    "friction that decays": ("kinetic_friction/pulled.yaml", {}),
    "a spring": ("mass_on_a_spring/column.yaml", {}),
    "a dashpot": ("block_on_a_dashpot/case.yaml", {}),
    "a driven plane": ("ram_on_a_bar/driven.yaml", {}),
    "a spin, prestressed": ("prestressed_spin/case.yaml", {}),
    "plates that thin": ("stretched_plate/under_a_block.yaml", {}),
    "plates under pressure": ("explosively_loaded_beam/case.yaml", {}),
    "strain rate and heat": ("johnson_cook_impact/case.yaml", {}),
    "mixed hardening": ("cyclic_loading/plate.yaml", {}),
    "relaxation": ("nearly_incompressible/cylinder.yaml", {}),
    "stages: a load that goes off": ("stages/case.yaml", {}),
    "stages: a rigid ram that is let go": ("stages/struck.yaml", {}),
    "a condition to stop": ("long_bar_on_a_wall/case.yaml", {}),
    "a mesh from a file": ("invariance_scenes/strike.yaml", {}),
    "a section, a table, a pair that touched": ("../tests/drivers/cases/pushed.yaml", {}),
}
# of these, all kinds of elements and of contact; none so chaotic that round-off grows
WIDTHS = {"automatic contact by a penalty": {}, "a bond": {},
          "a floor, plates on solids, plasticity": {"time.end": "0.6 ms"},  # round-off grows: 1e-9 of a force then, 1e-2 at 7 ms
          "rigid bodies on a plane, friction": {}, "plates that thin": {}, "strain rate and heat": {}, "mixed hardening": {},
          "stages: a rigid ram that is let go": {}}
CLOSE = 1e-6      # of what a column of the history goes through
ROUND_OFF = 1e-13  # of what the largest column of a unit goes through: ten times what was measured


def written(folder):
    """All results of a run, without what depends on the machine."""
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
    summary = json.loads(found.pop("summary.json"))
    for key in ("provenance", "cost"):
        summary.pop(key, None)
    found["summary.json"] = json.dumps(summary, indent=1).encode()
    return found


def end_of(driver, case, sets, patience=PATIENCE):
    """A run that nothing stops: (status, what it said, its end [s], how long it took [s], its results)."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        began = time.perf_counter()
        done = subprocess.run([driver, case, "--out", out, "--quiet", *sets], capture_output=True, text=True, timeout=patience)
        seconds = time.perf_counter() - began
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        return done.returncode, done.stderr, summary["ending"]["time"]["value"], seconds, written(out)


def killed(drivers, case, sets, out, every, seconds, rng):
    """Runs a case, kills it some times, and lets it go on to its end, by each of the drivers in turn; (status, kills)."""
    kills, resume = 0, []
    while True:
        driver = drivers[kills % len(drivers)]
        process = subprocess.Popen([driver, case, "--out", out, "--quiet", "--checkpoint-every", every, *sets, *resume],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            process.communicate(timeout=rng.uniform(0, 0.7 * seconds) if kills < KILLS else PATIENCE)
            return process.returncode, kills
        except subprocess.TimeoutExpired:
            number = rng.choice(SIGNALS)
            process.send_signal(number)
            process.communicate()
            if process.returncode not in (-number, INTERRUPTED):  # a process that has not yet begun ends by any signal
                return process.returncode, kills
            kills, resume = kills + 1, ["--resume"]


class Restart(unittest.TestCase):
    drivers = None

    def compare(self, case, values):
        driver = self.drivers / "scene"
        sets = [word for key, value in values.items() for word in ("--set", f"{key}={value}")]
        status, said, end, seconds, whole = end_of(driver, case, sets)
        self.assertIn(status, (0, 3), said)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            again, _ = killed([driver], case, sets, out, f"{end / CHECKPOINTS!r} s", seconds, random.Random(str(case)))
            self.assertEqual(again, status)
            parts = written(out)
        self.assertEqual(sorted(parts), sorted(whole))
        self.assertEqual([name for name in whole if whole[name] != parts[name]], [])

    def test_killed_runs_go_on_to_the_same_bytes(self):
        for name, (case, values) in CASES.items():
            with self.subTest(name):
                self.compare(ROOT / "verification" / case, values)


def farthest_apart(one, other):
    """Of two histories with the same rows: the largest difference in a column over what the column goes through, beyond the round-off of
    the largest column of its unit, since some hold nothing else."""
    tables = [np.genfromtxt(io.BytesIO(text), delimiter=",", skip_header=1, ndmin=2) for text in (one, other)]
    if tables[0].shape != tables[1].shape:
        return np.inf
    units = np.array([name[name.rfind("["):] for name in one.split(b"\n")[0].decode().split(",")])
    through = np.nanmax(tables[0], axis=0) - np.nanmin(tables[0], axis=0)
    round_off = ROUND_OFF * np.array([through[units == unit].max() for unit in units])
    beyond = np.maximum(np.abs(tables[0] - tables[1]) - round_off, 0)
    return np.nanmax(beyond / np.where(through > 0, through, np.inf))


class Width(unittest.TestCase):
    """Sums of wider packs have other round-off, so that results are close and not the same."""
    drivers = other = None

    def setUp(self):
        if self.other is None:
            self.skipTest("needs the programs of another build")

    def test_goes_on_from_checkpoints_of_another_width(self):
        for name, shorter in WIDTHS.items():
            case, values = CASES[name]
            sets = [word for key, value in {**values, **shorter}.items() for word in ("--set", f"{key}={value}")]
            case = ROOT / "verification" / case
            status, said, end, seconds, whole = end_of(self.drivers / "scene", case, sets)
            for drivers in ((self.drivers, self.other), (self.other, self.drivers)):
                with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                    out = Path(folder) / "out"
                    programs = [folder / "scene" for folder in drivers]
                    again, kills = killed(programs, case, sets, out, f"{end / CHECKPOINTS!r} s", seconds, random.Random(name))
                    self.assertEqual(again, status, said)
                    self.assertGreater(kills, 0)
                    self.assertLess(farthest_apart(whole["history.csv"], written(out)["history.csv"]), CLOSE)


class Words(unittest.TestCase):
    """What --resume says where it can not go on."""
    drivers = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.case = Path(shutil.copy(Path(__file__).resolve().parent / "cases/block.yaml", self.folder))
        self.out = self.folder / "out"

    def run_case(self, *flags):
        return subprocess.run([self.drivers / "scene", self.case, "--out", self.out, "--quiet", *flags], capture_output=True, text=True,
                              timeout=PATIENCE)

    def checkpoint(self):
        """A checkpoint in the folder, as a killed run leaves it."""
        process = subprocess.Popen([self.drivers / "scene", self.case, "--out", self.out, "--quiet", "--set", "time.end=1000 s",
                                    "--checkpoint-every", "100 ms"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        file = self.out / "checkpoint"
        while not file.exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        return file

    def refused(self, part, *flags):
        before = {path: path.read_bytes() for path in self.out.rglob("*") if path.is_file() and path.name != "run.lock"}
        done = self.run_case("--resume", *flags)
        self.assertEqual(done.returncode, 2)
        self.assertIn(part, done.stderr)
        self.assertEqual({path: path.read_bytes() for path in self.out.rglob("*") if path.is_file() and path.name != "run.lock"}, before)

    def test_without_a_checkpoint_it_starts_anew(self):
        done = self.run_case("--resume")
        self.assertEqual((done.returncode, done.stderr.count("there is no checkpoint in")), (0, 1))
        self.assertTrue((self.out / "summary.json").is_file())

    def test_after_the_end_nothing_is_left_to_do(self):
        self.run_case()
        before = written(self.out)
        done = self.run_case("--resume")
        self.assertEqual(done.returncode, 0)
        self.assertIn("nothing is left to do", done.stderr)
        self.assertEqual(written(self.out), before)
        self.refused("its results are of another case", "--set", "time.end=1 ms")

    def test_a_checkpoint_of_another_case(self):
        self.checkpoint()
        self.refused("the checkpoint is of another case: it says 'time.end = 1000 s', and this case 'time.end = 2 s'", "--set",
                     "time.end=2 s")

    def test_a_damaged_checkpoint(self):
        file = self.checkpoint()
        whole = file.read_bytes()
        flags = "--set", "time.end=1000 s"
        file.write_bytes(whole[:-7])
        self.refused("it is cut short", *flags)
        file.write_bytes(whole[:200] + bytes([whole[200] ^ 1]) + whole[201:])
        self.refused("it is damaged", *flags)
        file.write_bytes(whole.replace(b"checkpoint 3\n", b"checkpoint 9\n"))
        self.refused("it is of version '9', and this program reads version 3", *flags)
        file.write_bytes(b"something else")
        self.refused("it is no checkpoint", *flags)
        file.unlink()
        os.mkfifo(file)
        self.refused("it is no file", *flags)

    def test_a_run_from_the_start_clears_an_old_checkpoint(self):
        file = self.checkpoint()
        self.assertEqual(self.run_case().returncode, 0)
        self.assertFalse(file.exists())

    def test_times_that_are_none(self):
        for text in ("1", "1 m", "-1 s", "0 s", "often"):
            done = self.run_case("--checkpoint-every", text)
            self.assertEqual(done.returncode, 2, text)
            self.assertIn(f"'{text}' is no time", done.stderr)


def hears(pid, number):
    """Whether a process has said what it does at a signal."""
    caught = re.search(r"SigCgt:\s*(\w+)", Path(f"/proc/{pid}/status").read_text(encoding="utf-8"))
    return caught is not None and int(caught[1], 16) >> (number - 1) & 1 == 1


class Signals(unittest.TestCase):
    """What a run leaves that is asked to end."""
    drivers = None

    def test_results_are_whole_and_the_run_goes_on(self):
        case = ROOT / "verification/crossing_bars/case.yaml"
        for number, name in ((signal.SIGINT, "SIGINT"), (signal.SIGTERM, "SIGTERM"), (signal.SIGHUP, "SIGHUP")):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                out = Path(folder) / "out"
                process = subprocess.Popen([self.drivers / "scene", case, "--out", out, "--quiet", "--set", "time.end=1 s"],
                                           stderr=subprocess.PIPE, text=True)
                while not (out / "body/body_000001.vtu").exists():
                    time.sleep(0.01)
                process.send_signal(number)
                _, said = process.communicate(timeout=PATIENCE)
                self.assertEqual(process.returncode, INTERRUPTED)
                self.assertIn(f": interrupted: by {name}; --resume goes on from here", said)
                summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
                self.assertEqual(summary["ending"]["word"], "interrupted")
                ended = summary["ending"]["time"]["value"]
                rows = (out / "history.csv").read_text(encoding="utf-8").splitlines()
                self.assertEqual(float(rows[-1].split(",")[0]), ended)
                index = (out / "body.pvd").read_text(encoding="utf-8")
                self.assertEqual(float(index.rsplit('timestep="', 1)[1].split('"')[0]), ended)
                self.assertTrue((out / "checkpoint").is_file())

    def test_before_the_first_step(self):
        """A case whose mesh takes seconds: there is nothing to keep, and nobody waits for it."""
        case = Path(__file__).resolve().parent / "cases/block.yaml"
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            process = subprocess.Popen([self.drivers / "scene", case, "--out", out, "--quiet", "--set", "refine=40"],
                                       stderr=subprocess.PIPE, text=True)
            while process.poll() is None and not hears(process.pid, signal.SIGTERM):
                time.sleep(0.001)
            process.send_signal(signal.SIGTERM)
            _, said = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, INTERRUPTED, said)
            self.assertIn("interrupted by SIGTERM before it wrote results", said)
            again = subprocess.run([self.drivers / "scene", case, "--out", out, "--quiet"], capture_output=True, text=True)
            self.assertEqual(again.returncode, 0, again.stderr)

    def test_what_is_ignored_stays_so(self):
        case = Path(__file__).resolve().parent / "cases/block.yaml"
        with tempfile.TemporaryDirectory() as folder:
            process = subprocess.Popen([self.drivers / "scene", case, "--out", Path(folder) / "out", "--quiet"], stderr=subprocess.PIPE,
                                       text=True, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))  # as nohup does
            process.send_signal(signal.SIGHUP)
            _, said = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 0, said)


def all_cases(driver, limit):
    """Every case that `scene` runs in so many seconds; prints what differs."""
    failed = 0
    for case in sorted((ROOT / "verification").glob("*/*.yaml")):
        dry = subprocess.run([driver, case, "--dry-run", "--quiet"], capture_output=True, text=True)
        if dry.returncode != 0:
            continue
        try:
            status, _, end, seconds, whole = end_of(driver, case, [], limit)
        except subprocess.TimeoutExpired:
            continue
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            again, kills = killed([driver], case, [], out, f"{end / CHECKPOINTS!r} s", seconds, random.Random(str(case)))
            parts = written(out)
        differ = [name for name in sorted({*whole, *parts}) if whole.get(name) != parts.get(name)]
        failed += bool(differ) or again != status
        print(f"{'FAIL' if differ or again != status else 'ok'}  {case.parent.name}/{case.name}: {kills} kills, {seconds:.1f} s"
              f"{', differs: ' + ', '.join(differ[:5]) if differ else ''}", flush=True)
    return failed


if __name__ == "__main__":
    Restart.drivers = Words.drivers = Signals.drivers = Width.drivers = Path(sys.argv[1]).resolve()
    if "--other" in sys.argv:
        at = sys.argv.index("--other")
        Width.other = Path(sys.argv[at + 1]).resolve()
        del sys.argv[at:at + 2]
    if "--all" in sys.argv:
        sys.exit(all_cases(Restart.drivers / "scene", float(sys.argv[sys.argv.index("--all") + 1])) > 0)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
