"""What a driver says of a run before it, held against the run: steps, bytes and memory. Nothing here looks at a clock.

    python3 tests/drivers/forecast.py DRIVERS      DRIVERS: the folder with the programs
"""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from runs import run_alone  # noqa: E402

LINE = re.compile(r"^forecast until time\.end: (\d+) steps, \S+ s, (\d+) rows, (\d+) frames, (\S+) MB of files, (\S+) MB of memory$",
                  re.MULTILINE)
NEAR = 0.1  # [-] what steps, rows and memory may be off
OF_FRAMES = 0.2  # [-] what bytes may be off: frames of a scene that is shaken are longer than those of bars in a plane wave
PAGES = 4e6  # [bytes] of a program and its libraries (20 MB) that its system may map after the forecast, in pieces of its own choice


class Forecast(unittest.TestCase):
    drivers = None

    def run_driver(self, driver, case, out=None, *flags, settings=()):
        """(what it said, the most memory that it had [bytes], the files that it wrote)"""
        words = [Forecast.drivers / driver, ROOT / case, "--threads", "1", *(("--out", out) if out else ()), *flags]
        for setting in settings:
            words += ["--set", setting]
        status, said, memory = run_alone(words)
        self.assertEqual(status, 0, said)
        files = {path.relative_to(out).as_posix(): path.read_bytes() for path in Path(out).rglob("*") if path.is_file()} if out else {}
        return said, memory, files

    def look(self, driver, case, *settings):
        with tempfile.TemporaryDirectory() as folder:
            said, _, _ = self.run_driver(driver, case, None, "--dry-run", settings=settings)
            told, memory, spoken = self.run_driver(driver, case, f"{folder}/told", settings=settings)
            _, least, quiet = self.run_driver(driver, case, f"{folder}/quiet", "--quiet", settings=settings)
        found = LINE.search(said)
        self.assertIsNotNone(found, said)
        summary = json.loads(quiet["summary.json"])
        self.assertEqual(summary["ending"]["word"], "reached_end")
        steps, rows, frames, bytes_, resident = (float(number) for number in found.groups())
        self.assertAlmostEqual(steps / summary["cost"]["steps"], 1, delta=NEAR)
        self.assertAlmostEqual(rows / (quiet["history.csv"].count(b"\n") - 1), 1, delta=NEAR)
        self.assertEqual(frames, sum(name.startswith("body/") for name in quiet))
        self.assertAlmostEqual(1e6 * bytes_ / sum(len(data) for data in quiet.values()), 1, delta=OF_FRAMES)
        for most in (memory, least):
            self.assertAlmostEqual(1e6 * resident, most, delta=max(NEAR * most, PAGES))
        again = LINE.search(told)
        self.assertIsNotNone(again, told)
        self.assertEqual(found.group(1, 2, 3), again.group(1, 2, 3))
        for name, data in quiet.items():  # a forecast changes nothing of the run that follows it
            if name != "summary.json":
                self.assertEqual(spoken[name], data, name)

    def test_bars(self):
        self.look("two_blocks", "cases/two_blocks/bars.yaml")

    def test_bars_by_a_penalty_that_are_still_apart(self):
        self.look("two_blocks", "cases/two_blocks/bars.yaml", "contact.method=penalty", "blocks.cells_along=20", "time.end=20 us")

    def test_a_block_that_slides_to_rest(self):
        self.look("sliding", "cases/sliding/stop.yaml")

    def test_the_cask(self):
        self.look("cask_drop", "cases/cask_drop/neptune.yaml", "mesh.level=2", "model.kind=quarter", "time.end=4 ms")

    def test_memory_that_is_the_scene_s_and_not_the_program_s(self):
        scene = "cask_drop", "cases/cask_drop/neptune.yaml"
        settings = "mesh.level=6", "time.end=0.02 ms"
        said, _, _ = self.run_driver(*scene, None, "--dry-run", settings=settings)
        resident = 1e6 * float(LINE.search(said).group(5))
        self.assertGreater(resident, 100e6)
        with tempfile.TemporaryDirectory() as folder:
            for flags in ((), ("--quiet",)):
                _, memory, _ = self.run_driver(*scene, f"{folder}/run", *flags, settings=settings)
                self.assertAlmostEqual(resident / memory, 1, delta=NEAR)


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    Forecast.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
