"""Runs that are killed and go on from their checkpoints have the bytes of runs that were never stopped.

    python3 tests/drivers/restart.py DRIVERS              DRIVERS: the folder with the programs
    python3 tests/drivers/restart.py DRIVERS --all N      every case of verification/ that `scene` runs in N seconds at most: takes long
    python3 tests/drivers/restart.py DRIVERS --other OTHER Width
                                                          two builds with packs of different width go on from each other's checkpoints

A killed run ends by SIGKILL, SIGTERM, SIGINT or SIGHUP at moments drawn from a seed, also while it writes, and goes on until it is done,
each time with another number of threads. What stands there after a kill is whole. At the end all files are compared, byte by byte, but for
what summary.json says of times and of the machine.
"""
import io
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path
from typing import NamedTuple

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
SMALL_CASES = Path(__file__).resolve().parent / "cases"
PATIENCE = 300    # [s]
CHECKPOINTS = 12  # in a run
KILLS = 4         # at most, of one run
TRIES = 20        # to kill a run before it ends
THREADS = 3       # at most
SIGNALS = [signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
INTERRUPTED = 6   # exit status
GOES_ON = "the run goes on from its checkpoint at"

STOP = ("[{probe: length, dipped: {fallen: 0.2, for: 1 ms}}, {probe: wall_force, steady: {window: 1 ms, within: 1e-6 N}, after: 8 ms}, "
        "{rest: {part: 1e-2, for: 5 ms}}]")
CASES = {
    "automatic contact with friction": ("automatic_contact/blocks.yaml", {"time.end": "40 us"}),
    "automatic contact by a penalty": ("automatic_contact/blocks.yaml", {"time.end": "15 us", "contacts[0].method": "penalty"}),
    "plates that touch themselves, and physics stops them": (
        "self_contact/strip.yaml", {"bodies[0].mesh.cells_along": 16, "bodies[0].mesh.cells_across": 1, "time.end": "6 ms"}),
    "edges that cross": ("crossing_bars/case.yaml", {}),
    "rigid bodies on a plane, friction": ("rigid_slider/on_a_plane.yaml", {}),
    "a tie": ("tied_bar/case.yaml", {}),
    "penalties of a tie and a plane, all hourglass control, springs": ("invariance_scenes/stack.yaml", {"contacts[1].method": "penalty"}),
    "plates in two passes of a penalty, moment, pressure": ("invariance_scenes/plates.yaml", {}),
    "a floor, plates on solids, plasticity": ("cask_drop/scene.yaml", {}),
    "friction that decays": ("kinetic_friction/pulled.yaml", {}),
    "a penalty with a step factor": ("mass_on_a_spring/column.yaml", {"contacts[0].method": "penalty", "contacts[0].step_factor": 0.4}),
    "springs with dashpots": ("block_on_a_dashpot/case.yaml", {}),
    "a driven plane": ("ram_on_a_bar/driven.yaml", {}),
    "a spin, prestressed": ("prestressed_spin/case.yaml", {}),
    "plates that thin": ("stretched_plate/under_a_block.yaml", {}),
    "plates that are given a velocity": ("explosively_loaded_beam/case.yaml", {}),
    "strain rate and heat": ("johnson_cook_impact/case.yaml", {}),
    "distortion control": ("fast_bar/case.yaml", {"initial[0].velocity": ["0", "0", "-478"]}),
    "a law with a potential": ("pressed_block/case.yaml", {"bodies[0].material.kind": "neo_hookean", "time.end": "1 ms"}),
    "kinematic hardening": ("cyclic_loading/plate.yaml", {}),
    "relaxation under pressure": ("nearly_incompressible/cylinder.yaml", {}),
    "stages: a load that goes off": ("stages/case.yaml", {}),
    "stages: a rigid ram that is let go": ("stages/struck.yaml", {}),
    "restitution, conditions to stop": (
        "long_bar_on_a_wall/case.yaml", {"bodies[0].mesh.cells": [500, 1, 1], "planes[0].restitution": 0.5, "stop": STOP}),
    "a mesh from a file": ("invariance_scenes/strike.yaml", {}),
    "three fluids, a wave that comes and goes, a tie that slides": ("invariance_scenes/splash.yaml", {}),
    "a section, a table, a pair that touched": ("../tests/drivers/cases/pushed.yaml", {}),
    "accelerations and a formula": ("gauges/motion.yaml", {}),
    "forces of a pair": ("pair_forces/slide.yaml", {}),
    "materials of parts": ("two_materials/case.yaml", {}),
    "a measured curve in plates": ("stretched_bar/strip.yaml", {"time.end": "5 ms"}),
}
# what some case must hold, as its summary has it: a section, and values of one item in it
KINDS = [
    "bodies material.kind=elastic", "bodies material.kind=neo_hookean", "bodies material.kind=johnson_cook",
    "bodies material.kind=linear_fluid", "bodies material.kind=mie_gruneisen", "bodies material.kind=ideal_gas",
    "bodies material.kind=j2_curve", "bodies materials", "bodies sets", "bodies material.hardening=isotropic",
    "bodies material.hardening=kinematic", "bodies material.hardening=mixed", "bodies rigid=True", "bodies mesh.kind=file",
    "bodies element.kind=full", "bodies element.hourglass_kind=assumed_strain", "bodies element.hourglass_kind=stiffness",
    "bodies element.hourglass_kind=viscous", "bodies element.rotary_inertia=scaled", "bodies element.rotary_inertia=physical",
    "contacts kind=contact method=multiplier friction=0.4", "contacts kind=contact method=multiplier passes=two",
    "contacts kind=contact method=penalty passes=two friction=0.25 damping_ratio=0.1",
    "contacts kind=contact method=penalty weights=paper area=base", "contacts method=penalty step_factor=0.4",
    "contacts kind=tied method=multiplier", "contacts kind=tied slides=True",
    "contacts kind=tied method=penalty", "contacts contact_height=initial",
    "contacts kinetic_friction=0.2", "contacts kind=automatic method=multiplier friction=0.3", "contacts kind=automatic method=penalty",
    "planes kind=symmetry", "planes kind=constrained", "planes kind=fixed", "planes kind=driven", "planes kind=floor",
    "planes kind=rigid method=multiplier restitution=0.5", "planes kind=rigid method=multiplier friction=0.2",
    "planes kind=rigid method=penalty friction=0.2",
    "loads kind=pressure", "loads kind=force", "loads kind=moment", "loads kind=body_force", "loads kind=radiation",
    "springs to=ground", "springs to=upper.corner", "point_masses", "initial", "stages", "sections",
    "probes quantity=acceleration", "probes value", "probes between", "probes near",
    "stop dipped", "stop steady", "stop rest", "touched sides=['strip', 'strip']", "ending word=stopped_by_condition",
]
# of the cases, all kinds of elements and of contact; none so chaotic that round-off grows, none with a file that needs VTK
WIDTHS = {"automatic contact by a penalty": {}, "a tie": {},
          "a floor, plates on solids, plasticity": {"time.end": "0.4 ms"},  # round-off grows: 1e-8 of a force then, 4e-6 at 0.6 ms
          "rigid bodies on a plane, friction": {}, "plates that thin": {}, "strain rate and heat": {}, "kinematic hardening": {},
          "stages: a rigid ram that is let go": {}}
CLOSE = 1e-6      # of what a column of the history goes through
ROUND_OFF = 1e-13  # of what the largest column of a unit goes through: ten times what was measured


class Whole(NamedTuple):
    """A run that nothing stops."""
    status: int
    said: str
    end: float      # [s]
    seconds: float  # that it took
    results: dict
    holds: dict     # what its case says, what touched, how it ended


class Ends(NamedTuple):
    """How a run that was killed came to its end."""
    status: int
    said: str       # by its last start
    kills: int      # at which there was a checkpoint
    damage: list    # seen after them


def written(folder):
    """All results of a run, without what depends on the machine."""
    found = {path.relative_to(folder).as_posix(): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
    summary = json.loads(found.pop("summary.json"))
    for key in ("provenance", "cost"):
        summary.pop(key, None)
    found["summary.json"] = json.dumps(summary, indent=1).encode()
    return found


def flags_of(values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def end_of(driver, case, sets, patience=PATIENCE):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        began = time.perf_counter()
        done = subprocess.run([driver, case, "--out", out, "--quiet", *sets], capture_output=True, text=True, timeout=patience)
        seconds = time.perf_counter() - began
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        holds = {**summary["provenance"]["resolved"], "touched": summary["touched"], "ending": [summary["ending"]]}
        return Whole(done.returncode, done.stderr, summary["ending"]["time"]["value"], seconds, written(out), holds)


def value_of(tree, path):
    """The value at a path as "element.kind" in an item of a case; None where it has none."""
    for key in path.split("."):
        tree = tree.get(key) if isinstance(tree, dict) else None
    return tree.get("value") if isinstance(tree, dict) and "value" in tree else tree


def has_kind(holds, kind):
    """Whether a case holds one of KINDS."""
    section, *wanted = re.split(r" (?=[a-z])", kind)
    for item in holds.get(section) or []:
        pairs = [one.partition("=") for one in wanted]
        if all(str(value_of(item, key)) == value if sign else value_of(item, key) is not None for key, sign, value in pairs):
            return True
    return False


def damage(out, by_kill):
    """What is not whole of results that a stopped run left."""
    found = []
    for index in out.glob("*.pvd"):
        try:
            listed = [one.get("file") for one in xml.parse(index).iter("DataSet")]
        except xml.ParseError as error:
            found.append(f"{index.name}: {error}")
            continue
        for name in listed:
            if not (out / name).is_file():
                found.append(f"{index.name} lists {name}, which is not there")
            elif not (out / name).read_bytes().endswith(b"</VTKFile>\n"):
                found.append(f"{name} is cut short")
    if (out / "history.csv").exists():
        *rows, last = (out / "history.csv").read_text(encoding="utf-8").split("\n")
        if len({row.count(",") for row in rows}) > 1:
            found.append("history.csv has a row that is not whole")
        if last and not by_kill:  # the system itself may end a write between two pages where it kills
            found.append("history.csv ends within a row")
    if (out / "summary.json").exists():
        try:
            json.loads((out / "summary.json").read_text(encoding="utf-8"))
        except ValueError as error:
            found.append(f"summary.json: {error}")
    return found


def kill_some_times(drivers, case, sets, out, every, latest, rng):
    """Runs a case in an empty folder, kills it some times, and lets it go on to its end, by each of the drivers in turn.

    latest  [s] of a kill, from the first checkpoint on, and later from when the run went on"""
    starts, kills, damages = 0, 0, []
    while True:
        flags = ["--resume"] if starts else ["--quiet"]  # a quiet one would not say that it goes on
        process = subprocess.Popen([drivers[starts % len(drivers)], case, "--out", out, "--checkpoint-every", every,
                                    "--threads", str(rng.randint(1, THREADS)), *flags, *sets],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not (out / "checkpoint").exists():
            time.sleep(0.001)
        last = starts == KILLS
        try:
            said = "".join(process.communicate(timeout=PATIENCE if last else rng.uniform(0, latest)))
            return Ends(process.returncode, said, kills, damages)
        except subprocess.TimeoutExpired:
            number = signal.SIGKILL if last else rng.choice(SIGNALS)
            process.send_signal(number)
            said = "".join(process.communicate())
        if last or process.returncode not in (-number, INTERRUPTED):  # a process that has not yet begun ends by any signal
            return Ends(process.returncode, said, kills, damages)
        starts += 1
        kills += (out / "checkpoint").is_file()
        damages += [f"kill {starts}, {number.name}: {one}" for one in damage(out, number == signal.SIGKILL)]


def killed(drivers, case, sets, out, every, seconds, rng):
    """Runs a case, which takes so many seconds, kills it some times, and lets it go on to its end.

    Where the start that ended had not gone on from a checkpoint, because no kill came before the end, all is done anew with earlier kills.
    So a pass always means that a run went on, however fast or busy the machine is."""
    latest = 0.7 * seconds
    for _ in range(TRIES):
        shutil.rmtree(out, ignore_errors=True)
        ends = kill_some_times(drivers, case, sets, out, every, latest, rng)
        if GOES_ON in ends.said or ends.status not in (0, 3) or ends.damage:
            break
        latest /= 2
    return ends


class Restart(unittest.TestCase):
    drivers = None

    def compare(self, name):
        """Returns what the case holds."""
        case, values = CASES[name]
        driver, case, sets = self.drivers / "scene", ROOT / "verification" / case, flags_of(values)
        whole = end_of(driver, case, sets)
        self.assertIn(whole.status, (0, 3), whole.said)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            ends = killed([driver], case, sets, out, f"{whole.end / CHECKPOINTS!r} s", whole.seconds, random.Random(name))
            self.assertEqual(ends.damage, [])
            self.assertEqual(ends.status, whole.status, ends.said)
            self.assertIn(GOES_ON, ends.said)
            self.assertGreater(ends.kills, 0)
            parts = written(out)
        self.assertEqual(sorted(parts), sorted(whole.results))
        self.assertEqual([file for file in parts if whole.results[file] != parts[file]], [])
        return whole.holds

    def test_killed_runs_go_on_to_the_same_bytes(self):
        all_hold = []
        for name in CASES:
            with self.subTest(name):
                all_hold.append(self.compare(name))
        if len(all_hold) == len(CASES):
            self.assertEqual([kind for kind in KINDS if not any(has_kind(holds, kind) for holds in all_hold)], [])


class Leftovers(unittest.TestCase):
    """What a run that stopped left half written or too much stands in nobody's way, and is gone at the end."""
    drivers = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = Path(folder.name) / "out"
        case = ROOT / "verification/crossing_bars/case.yaml"
        sets = flags_of({"bodies[0].mesh.cells": [5, 1, 1], "bodies[1].mesh.cells": [5, 1, 1], "output.history_every": "1 us"})
        self.words = [self.drivers / "scene", case, "--out", self.out, *sets]
        self.whole = end_of(self.drivers / "scene", case, sets)

    def run_on_a_disk(self, most, *flags):
        """A run whose files may not grow beyond a number of bytes."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        done = subprocess.run([*self.words, "--quiet", *flags], capture_output=True, text=True, timeout=PATIENCE, preexec_fn=limit)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("File too large", done.stderr)
        self.assertEqual([*self.out.rglob("*.tmp")], [])

    def stop(self, checkpoints):
        """A run that stops at two thirds, always at the same step, since a file has grown too large."""
        self.run_on_a_disk(2 * len(self.whole.results["history.csv"]) // 3, "--checkpoint-every", f"{self.whole.end / checkpoints!r} s")
        self.assertTrue((self.out / "checkpoint").is_file())

    def halves(self):
        """Half of each file that is written beside its place and renamed, where it is written; a frame that no index lists; half a row."""
        listed = {collection: sorted((self.out / collection).iterdir()) for collection in ("body", "contact", "walls")}
        files = [self.out / "checkpoint", *self.out.glob("*.pvd")]
        for frames in listed.values():
            files += frames[-1:]
            shutil.copy(frames[-1], frames[-1].with_stem(frames[-1].stem[:-6] + "000020"))
            files.append(frames[-1].with_stem(frames[-1].stem[:-6] + "000021"))
        for file in files:
            whole = file if file.exists() else listed["body"][0]
            file.with_name(file.name + ".tmp").write_bytes(whole.read_bytes()[:whole.stat().st_size // 2])
        (self.out / "summary.json.tmp").write_text('{"driver": "sc', encoding="utf-8")
        with open(self.out / "history.csv", "a", encoding="utf-8") as history:
            history.write("0.0005,1.25,")

    def end_alike(self, *flags):
        """The run ends as one that nothing stopped."""
        done = subprocess.run([*self.words, *flags], capture_output=True, text=True, timeout=PATIENCE)
        self.assertEqual((done.returncode, GOES_ON in done.stdout), (self.whole.status, "--resume" in flags), done.stderr)
        parts = written(self.out)
        self.assertEqual(sorted(parts), sorted(self.whole.results))
        self.assertEqual([file for file in parts if self.whole.results[file] != parts[file]], [])

    def test_halves(self):
        for flags in (("--resume", "--checkpoint-every", "100 us"), ("--resume",), ()):
            with self.subTest(flags):
                shutil.rmtree(self.out, ignore_errors=True)
                self.stop(CHECKPOINTS)
                self.halves()
                self.end_alike(*flags)

    def test_a_disk_that_is_full_as_the_run_goes_on(self):
        self.stop(2)
        self.assertEqual(damage(self.out, False), [])
        self.run_on_a_disk(50, "--resume")
        self.assertEqual(damage(self.out, False), [])
        self.end_alike("--resume")


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
            sets = flags_of({**values, **shorter})
            case = ROOT / "verification" / case
            whole = end_of(self.drivers / "scene", case, sets)
            for drivers in ((self.drivers, self.other), (self.other, self.drivers)):
                with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                    out = Path(folder) / "out"
                    programs = [folder / "scene" for folder in drivers]
                    ends = killed(programs, case, sets, out, f"{whole.end / CHECKPOINTS!r} s", whole.seconds, random.Random(name))
                    self.assertEqual(ends.damage, [])
                    self.assertEqual(ends.status, whole.status, ends.said)
                    self.assertIn(GOES_ON, ends.said)
                    self.assertLess(farthest_apart(whole.results["history.csv"], written(out)["history.csv"]), CLOSE)


class Words(unittest.TestCase):
    """What --resume says where it can not go on."""
    drivers = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.case = self.copy("block.yaml")
        self.out = self.folder / "out"

    def copy(self, name):
        return Path(shutil.copy(SMALL_CASES / name, self.folder))

    def run_case(self, *flags, driver="scene"):
        return subprocess.run([self.drivers / driver, self.case, "--out", self.out, "--quiet", *flags], capture_output=True, text=True,
                              timeout=PATIENCE)

    def checkpoint(self, end="1000 s", every="100 ms"):
        """A checkpoint in the folder, as a killed run leaves it."""
        process = subprocess.Popen([self.drivers / "scene", self.case, "--out", self.out, "--quiet", "--set", f"time.end={end}",
                                    "--checkpoint-every", every], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        file = self.out / "checkpoint"
        while process.poll() is None and not file.exists():
            time.sleep(0.01)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        self.assertTrue(file.is_file())
        return file

    def files(self):
        """What stands in the folder, and since when."""
        return {path: (path.read_bytes(), path.stat().st_mtime_ns) for path in self.out.rglob("*")
                if path.is_file() and path.name != "run.lock"}

    def refused(self, part, *flags, driver="scene"):
        before = self.files()
        done = self.run_case("--resume", *flags, driver=driver)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(part, done.stderr)
        self.assertEqual(self.files(), before)

    def test_without_a_checkpoint_it_starts_anew(self):
        done = self.run_case("--resume")
        self.assertEqual((done.returncode, done.stderr.count("there is no checkpoint in")), (0, 1))
        self.assertTrue((self.out / "summary.json").is_file())

    def test_after_the_end_nothing_is_left_to_do(self):
        self.run_case()
        before = self.files()
        done = self.run_case("--resume")
        self.assertEqual(done.returncode, 0)
        self.assertIn("there is nothing to resume", done.stderr)
        self.assertEqual(self.files(), before)
        self.refused("its results are of another case", "--set", "time.end=1 ms")

    def test_after_a_run_that_physics_stopped_neither(self):
        self.case = self.copy("load_without_root.yaml")
        first = self.run_case("--checkpoint-every", "1 ms")
        self.assertEqual(first.returncode, 3, first.stderr)
        before = self.files()
        self.assertNotIn(self.out / "checkpoint", before)
        for flags in ([], ["--checkpoint-every", "1 ms"]):
            done = self.run_case("--resume", *flags)
            self.assertEqual(done.returncode, 3)
            self.assertIn(f"there is nothing to resume: the run in {self.out} ended with not_finite", done.stderr)
            self.assertEqual(self.files(), before)

    def test_a_checkpoint_of_another_case(self):
        self.checkpoint()
        self.refused("the checkpoint is of another case: it says 'time.end = 1000 s', and this case 'time.end = 2 s'", "--set",
                     "time.end=2 s")

    def test_a_checkpoint_of_a_case_that_says_more(self):
        self.checkpoint()
        self.refused("the checkpoint is of another case: it has nothing of this, and this case 'accuracy = balanced'", "--set",
                     "time.end=1000 s", "--set", "accuracy=balanced")

    def test_a_checkpoint_of_another_driver(self):
        self.checkpoint()
        self.case = ROOT / "cases/two_blocks/bars.yaml"
        self.refused("the checkpoint is of driver 'scene'", driver="two_blocks")

    def test_a_checkpoint_of_another_mesh(self):
        mesh, meshes = self.folder / "mesh.vtu", []
        for cells in ("[2, 2, 2]", "[2, 2, 3]"):
            self.assertEqual(self.run_case("--set", f"bodies[0].mesh.cells={cells}").returncode, 0)
            meshes.append((self.out / "body/body_000000.vtu").read_bytes())
        self.case = self.copy("block_from_file.yaml")
        mesh.write_bytes(meshes[0])
        self.checkpoint()
        mesh.write_bytes(meshes[1])
        self.refused("the checkpoint is of another case: it says 'bodies[0].mesh.path_file = ", "--set", "time.end=1000 s")
        words = meshes[0].replace(b'Name="velocity"', b'Name="velocitz"')
        self.assertNotEqual(words, meshes[0])
        mesh.write_bytes(words)  # the same nodes and elements, and other names
        self.refused("the checkpoint is of another case: it says 'bodies[0].mesh.path_file = ", "--set", "time.end=1000 s")

    def test_a_checkpoint_of_another_table(self):
        table = self.copy("pushed.csv")
        self.case = self.copy("pushed.yaml")
        self.checkpoint(end="10 ms", every="1 us")
        before = table.read_text(encoding="utf-8")
        table.write_text(before.replace("50", "51"), encoding="utf-8")
        self.refused("the checkpoint is of another case: it says 'loads[0].value_file = ", "--set", "time.end=10 ms")

    def test_a_damaged_checkpoint(self):
        file = self.checkpoint()
        whole = file.read_bytes()
        flags = "--set", "time.end=1000 s"
        file.write_bytes(whole[:-7])
        self.refused("it is cut short", *flags)
        file.write_bytes(whole[:200] + bytes([whole[200] ^ 1]) + whole[201:])
        self.refused("it is damaged", *flags)
        head, rest = whole.split(b"\n", 1)
        version = head.split()[-1].decode()
        for other, said in ((b"0", "it is of version '0'"), (b"\xff", "it is of another version")):
            file.write_bytes(head.removesuffix(version.encode()) + other + b"\n" + rest)
            self.refused(f"{said}, and this program reads version {version}", *flags)
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
        case = SMALL_CASES / "block.yaml"
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
        case = SMALL_CASES / "block.yaml"
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
            whole = end_of(driver, case, [], limit)
        except subprocess.TimeoutExpired:
            continue
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "out"
            every = f"{whole.end / CHECKPOINTS!r} s"
            ends = killed([driver], case, [], out, every, whole.seconds, random.Random(f"{case.parent.name}/{case.name}"))
            parts = written(out)
        faults = ends.damage + [f"differs: {name}" for name in sorted({*whole.results, *parts})
                                if whole.results.get(name) != parts.get(name)]
        if ends.status != whole.status:
            faults.append(f"status {ends.status} and not {whole.status}")
        failed += bool(faults)
        print(f"{'FAIL' if faults else 'ok' if GOES_ON in ends.said else 'not killed: too short'}  {case.parent.name}/{case.name}: "
              f"{ends.kills} kills, {whole.seconds:.1f} s{'; '.join(['', *faults[:5]])}", flush=True)
    return failed


if __name__ == "__main__":
    Restart.drivers = Leftovers.drivers = Words.drivers = Signals.drivers = Width.drivers = Path(sys.argv[1]).resolve()
    if "--other" in sys.argv:
        at = sys.argv.index("--other")
        Width.other = Path(sys.argv[at + 1]).resolve()
        del sys.argv[at:at + 2]
    if "--all" in sys.argv:
        sys.exit(all_cases(Restart.drivers / "scene", float(sys.argv[sys.argv.index("--all") + 1])) > 0)
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
