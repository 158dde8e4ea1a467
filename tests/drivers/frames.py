"""Frames that a run writes beside its steps: how many there are by default, the same bytes in any run, and what meshio reads of them.

    python3 tests/drivers/frames.py DRIVERS               DRIVERS: the folder with the programs
"""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from runs import read_fields  # noqa: E402

CASE = Path(__file__).resolve().parent / "cases/block.yaml"
# 8,000 elements that move apart, in about a hundred steps: 41 frames would take more than a tenth of them
LARGE = ["bodies[0].mesh.cells=[20, 20, 20]", "time.end=0.1 s"]
PATIENCE = 120  # [s]


class Frames(unittest.TestCase):
    drivers = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_case(self, name, *flags, settings=LARGE):
        """(what it said, its folder, its summary)"""
        out = self.folder / name
        sets = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([self.drivers / "scene", CASE, "--out", out, *flags, *sets], capture_output=True, text=True,
                              timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, out, json.loads((out / "summary.json").read_text(encoding="utf-8"))

    def written(self, out):
        return {path.relative_to(out).as_posix(): path.read_bytes() for path in sorted(out.rglob("*.v??"))}

    def test_as_many_as_a_tenth_of_the_steps_pays_for(self):
        said, out, summary = self.run_case("told")
        count = summary["cost"]["frames"]
        self.assertEqual(count, len([*out.glob("body/*.vtu")]))
        self.assertGreater(count, 1)
        self.assertLess(count, 41)
        self.assertIn(f"{count} frames in place of 41, so that they take no more than a tenth of the run", said)
        self.assertRegex(said, f"forecast until time.end: .*, {count} frames, ")
        self.assertAlmostEqual(summary["cost"]["frames_every"]["value"], 0.1 / (count - 1))

    def test_as_many_as_the_case_says(self):
        _, _, summary = self.run_case("asked", "--quiet", settings=[*LARGE, "output.frames_every=2.5 ms"])
        self.assertEqual(summary["cost"]["frames"], 41)

    def test_forty_one_where_they_are_cheap(self):
        said, _, summary = self.run_case("small", settings=["time.end=1 s"])
        self.assertEqual(summary["cost"]["frames"], 41)
        self.assertNotIn("and not 41", said)

    def test_the_same_bytes_with_any_threads_and_after_a_checkpoint(self):
        _, out, _ = self.run_case("whole", "--quiet", "--threads", "1")
        whole = self.written(out)
        _, out, _ = self.run_case("shared", "--quiet", "--threads", "3")
        self.assertEqual(self.written(out), whole)
        process = subprocess.Popen([self.drivers / "scene", CASE, "--out", self.folder / "parts", "--quiet", "--checkpoint-every", "10 ms",
                                    *(word for setting in LARGE for word in ("--set", setting))])
        while process.poll() is None and not (self.folder / "parts/checkpoint").exists():
            pass
        process.kill()
        process.wait()
        _, out, _ = self.run_case("parts", "--quiet", "--resume")
        self.assertEqual(self.written(out), whole)

    def test_meshio_reads_them(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("Python has no meshio")
        _, out, _ = self.run_case("read", "--quiet")
        for file in sorted(out.glob("body/*.vtu"))[:2]:
            found, ours = meshio.read(file), read_fields(file)
            self.assertEqual([(block.type, len(block.data)) for block in found.cells], [("hexahedron", 8000)])
            for name, values in {**found.point_data, **{name: blocks[0] for name, blocks in found.cell_data.items()}}.items():
                self.assertEqual([tuple(one) if values.ndim > 1 else one for one in values.tolist()], ours[name], name)
            self.assertEqual(found.points.tolist(), [list(x) for x in ours["positions"]])  # the deformed shape
            for name, unit in (("displacement", "m"), ("velocity", "m/s"), ("contact_force", "N"), ("stress", "Pa"), ("body", "1")):
                self.assertIn(f"{name} [{unit}]", found.field_data)
            self.assertEqual([list(found.field_data[name]) for name in ("points_are_deformed", "a")], [[1], [0, 3]])


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    Frames.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
