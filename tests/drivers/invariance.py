"""scripts/invariance with the program itself: a case that keeps its results, a program with a defect, and a case that does not run.

    python3 tests/drivers/invariance.py DRIVERS      DRIVERS: the folder with the programs
"""
import csv
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CASE = """# A block strikes another one askew, which stands on a fixed face: as small as a case with contact can be.
gravity: [0 m/s^2, 20 m/s^2, -30 m/s^2]
bodies:
  - name: base
    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [20 mm, 18 mm, 5 mm], cells: [3, 3, 1]}
    material: &soft {kind: elastic, density: 1000 kg/m^3, young: 10 MPa, poisson: 0.3}
  - name: block
    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [7 mm, 6 mm, 5 mm], cells: [2, 1, 1]}
    rotate: {axis: [1, 2, 3], angle: 20 deg}
    move: [6 mm, 7 mm, 6.5 mm]
    material: *soft
contacts: [{name: touch, kind: automatic, friction: 0.2}]
planes: [{name: ground, kind: fixed, nodes: [base.z_low]}]
initial: [{body: block, velocity: ["0.3", "0", "-2"], unit: m/s}]
probes:
  - {name: speed, quantity: velocity, of: block, component: x}
  - {name: push, quantity: force, of: ground, component: z}
time: {end: 1 ms}
"""
# (case of the suite, settings, columns that must be compared)
CARRIED = [
    ("gauges/motion.yaml", [], ["swing_acceleration", "power", "speed_by_time"]),        # formulas of probes with a direction
    ("gauges/bar.yaml", [], ["inclined", "across"]),                                     # gauges along a direction
    ("two_materials/static.yaml", [], ["end", "joint", "far_stress"]),                   # sets: planes, a box, a cylinder, all_of
    ("stretched_bar/strip.yaml", ["time.end=5 ms", "sections[0].point=[0.051 m, 0 m, 0 m]"],  # a table; a section beside all nodes
     ["stress", "flow", "middle_force"]),
]
# A program that forgets to turn the gravity of a case that was turned.
DEFECT = """#!/bin/sh
case "$1" in
  *rotated.yaml) exec {scene} "$@" --set "gravity=[0 m/s^2, 20 m/s^2, -30 m/s^2]" ;;
esac
exec {scene} "$@"
"""


class Invariance(unittest.TestCase):
    drivers = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.case = self.root / "case.yaml"
        self.case.write_text(CASE, encoding="utf-8")

    def ask(self, *words, drivers=None):
        """(status, what it said, {change: row of its table})"""
        out = self.root / "out"
        done = subprocess.run([sys.executable, ROOT / "scripts/invariance", self.case, "--out", out, "--drivers", drivers or self.drivers,
                               *words], capture_output=True, text=True, check=False)
        rows = {}
        if (out / "invariance.csv").is_file():
            with (out / "invariance.csv").open(newline="", encoding="utf-8") as stream:
                rows = {row["change"]: row for row in csv.DictReader(stream)}
        return done.returncode, done.stdout + done.stderr, rows

    def test_a_case_keeps_its_results(self):
        status, said, rows = self.ask()
        self.assertEqual(status, 0, said)
        verdicts = {change: row["verdict"] for change, row in rows.items()}
        same = ("rotated", "mirrored", "numbers", "units", "moving", "resolved", "threads", "rows")
        self.assertEqual({change: verdicts[change] for change in same}, dict.fromkeys(same, "same"), said)
        self.assertIn(verdicts["resumed"], ("same", "skipped"))  # where the machine is fast, it ends before it can be stopped
        self.assertEqual(verdicts["half_step"], "shown", said)
        self.assertEqual((verdicts["automatic"], rows["automatic"]["because"]), ("skipped", "it has no declared contact"))

    def test_sets_gauges_formulas_and_tables_are_carried(self):
        for name, settings, compared in CARRIED:
            with self.subTest(case=name):
                self.case = ROOT / "verification" / name
                status, said, rows = self.ask("--only", "rotated", "--only", "mirrored", *(word for one in settings
                                                                                           for word in ("--set", one)))
                self.assertEqual(status, 0, said)
                self.assertEqual({change: row["verdict"] for change, row in rows.items()}, dict.fromkeys(("rotated", "mirrored"), "same"))
                self.assertEqual({row["because"] for row in rows.values()}, {""}, said)
                told = json.loads((self.root / "out/cases" / f"{name.replace('/', '_').removesuffix('.yaml')}.json").read_text())
                for row in told:
                    self.assertLessEqual(set(compared), set(row["all"]), said)

    def test_a_case_of_stages_needs_no_time_of_its_own(self):
        self.case.write_text(CASE.replace("time: {end: 1 ms}", "stages: [{name: strike, duration: 1 ms}]"), encoding="utf-8")
        status, said, rows = self.ask("--only", "half_step", "--only", "moving")
        self.assertEqual(status, 0, said)
        self.assertEqual({change: row["verdict"] for change, row in rows.items()}, {"half_step": "shown", "moving": "same"}, said)

    def test_a_defect_is_noticed(self):
        drivers = self.root / "drivers"
        drivers.mkdir()
        (drivers / "scene").write_text(DEFECT.format(scene=self.drivers / "scene"), encoding="utf-8")
        (drivers / "scene").chmod(0o755)
        status, said, rows = self.ask("--only", "rotated", "--only", "units", drivers=drivers)
        self.assertEqual(status, 2, said)
        self.assertEqual({change: row["verdict"] for change, row in rows.items()}, {"rotated": "DIFFERS", "units": "same"}, said)

    def test_a_case_that_does_not_run_is_told(self):
        self.case.write_text(CASE.replace("poisson: 0.3", "poisson: 0.5"), encoding="utf-8")
        status, said, _ = self.ask()
        self.assertEqual(status, 3, said)
        self.assertIn("'poisson' = 0.5 is out of range", said)


if __name__ == "__main__":
    Invariance.drivers = Path(sys.argv[1]).resolve()
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
