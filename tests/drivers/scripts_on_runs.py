"""What scripts say of runs that the programs have just made: curves, filters, means, studies, gates, and meshes of other codes.

    python3 tests/drivers/scripts_on_runs.py DRIVERS              DRIVERS: the folder with the programs
    python3 tests/drivers/scripts_on_runs.py DRIVERS Suite

The scripts are started as a user starts them. The verification suite judges small cases of its own here, in a tree that has nothing but
them and the scripts. Tests are skipped where they need what is missing: of files of meshes programs with VTK, of the report matplotlib, of
filters numpy.
"""
import base64
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from math import pi
from pathlib import Path

from right_runs import G, PATIENCE
from runs import InATemporaryFolder

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
MISSING = [name for name in ("numpy", "matplotlib") if importlib.util.find_spec(name) is None]

# A cube of 1 kg without constraints: its weight, or the load, is all that acts.
CUBE = """bodies:
  - name: b
    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [0.1 m, 0.1 m, 0.1 m], cells: [1, 1, 1]}
    material: {kind: elastic, density: 1000 kg/m^3, young: 10 MPa, poisson: 0.3}
    rigid: RIGID
"""
SPEED = "{name: speed, quantity: velocity, of: b, component: z}"


def falling(time, output, more=""):
    """A rigid cube in free fall."""
    return CUBE.replace("RIGID", "true") + f"""gravity: [0 m/s^2, 0 m/s^2, -{G} m/s^2]
probes:
  - {SPEED}
{more}time: {{{time}}}
output: {{{output}, frames_every: 1 s}}
"""


def pushed(value, time, rigid="true"):
    """A cube that a force [N] along z accelerates."""
    return CUBE.replace("RIGID", rigid) + f"""loads: [{{name: push, kind: force, nodes: b, value: ["0", "0", "{value}"], unit: N}}]
probes:
  - {SPEED}
time: {{{time}}}
output: {{history_every: 1 ms, frames_every: 1 s}}
"""


class InAFolder(InATemporaryFolder):
    drivers = None  # folder of the programs, from the command line

    def script(self, name, *words):
        """The finished process of a script."""
        return subprocess.run([sys.executable, SCRIPTS / name, *words], cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE)

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def run_case(self, text):
        """The summary of a run in the folder `out`."""
        self.write("case.yaml", text)
        done = subprocess.run([self.drivers / "scene", "case.yaml", "--out", "out", "--quiet"], cwd=self.folder, capture_output=True,
                              text=True, timeout=PATIENCE)
        if "built without VTK" in done.stderr:
            self.skipTest("the programs read no files of meshes")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / "out/summary.json").read_text(encoding="utf-8"))


# ------------------------------------------------------------------------------------------------

class FreeFall(InAFolder):
    @unittest.skipIf("numpy" in MISSING, "no numpy")
    def test_the_filter_keeps_the_rows_and_a_speed_that_grows_evenly(self):
        """The last row comes after 0.3 of an interval, and 0.3 of 50 intervals is 0.6 %: far more than the step of 0.01 of an interval, by
        which rows come late."""
        self.run_case(falling("end: 50.3 ms, largest_step: 10 us", "history_every: 1 ms"))
        done = self.script("cfc", "out/history.csv", "--class", "60", "speed", "--out", "filtered.csv")
        self.assertEqual(done.returncode, 0, done.stderr)
        head, *rows = (self.folder / "filtered.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(head, "time [s],speed_cfc60 [m/s]")
        self.assertEqual(len(rows), 51)
        for number, row in enumerate(rows):
            time, speed = map(float, row.split(","))
            self.assertAlmostEqual(time, 1e-3 * number, delta=1e-5)
            self.assertAlmostEqual(speed, -G * time, delta=1e-6)

    @unittest.skipIf(MISSING, "no numpy or no matplotlib")
    def test_the_energy_from_outside_is_the_kinetic_energy_in_the_report(self):
        """All energy is kinetic and comes from the weight: three curves of the diagram are one, to a tenth of a point."""
        self.run_case(falling("end: 0.1 s", "history_every: 10 ms"))
        done = self.script("report", "out", "--quick", "--out", "page.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.folder / "page.html").read_text(encoding="utf-8")
        picture = re.search(r"<img alt='energies of out' src='data:image/svg\+xml;base64,([^']*)'", page)
        paths = re.findall(r'<path d="([^"]*)"', base64.b64decode(picture.group(1)).decode())
        curves = [[float(number) for number in re.findall(r"-?[\d.]+", path)] for path in paths if path.count("L") > 5]
        self.assertEqual(len(curves), 3)  # kinetic; sum of all groups; start and outside
        for curve in curves:
            self.assertGreater(curve[1] - curve[-1], 50)  # points of 1/72 inch, downwards: it rises
            for at, value in zip(curves[0], curve, strict=True):
                self.assertAlmostEqual(at, value, delta=0.1)


# ------------------------------------------------------------------------------------------------

LENGTH, SOUND = 1.0, 100.0  # [m], [m/s]
ROD = f"""bodies:
  - name: rod
    mesh: {{kind: box, low: [0 m, 0 m, 0 m], high: [{LENGTH} m, 0.1 m, 0.1 m], cells: [4, 1, 1]}}
    material: {{kind: elastic, density: 1000 kg/m^3, young: {1000 * SOUND**2 / 1e6:g} MPa, poisson: 0}}
planes:
  - {{name: held, kind: fixed, nodes: [rod.x_low]}}
  - {{name: y, kind: constrained, nodes: [rod], normal: [0, 1, 0]}}
  - {{name: z, kind: constrained, nodes: [rod], normal: [0, 0, 1]}}
modes: {{lowest: 1, highest: 1}}
"""


class Refine(InAFolder):
    def refine(self, text, *words):
        self.write("rod.yaml", text)
        return self.script("refine", "rod.yaml", "--drivers", self.drivers, "--driver", "modes", "--out", "runs", "--result", "frequency_1",
                           *words)

    def test_the_extrapolated_frequency_of_a_rod_is_nearer_than_the_finest(self):
        """Lumped masses make the frequency too low by a part (pi h / (2 L))^2 / 24, and by one of h^4, which alone is left."""
        done = self.refine(ROD)
        self.assertEqual(done.returncode, 0, done.stderr)
        exact = SOUND / (4 * LENGTH)
        finest = float(re.search(r"x4: ([\d.]+)\n", done.stdout).group(1))
        extrapolated = float(re.search(r"order 2\.00, extrapolated ([\d.]+);", done.stdout).group(1))
        self.assertAlmostEqual(finest / exact, 1 - (pi / 32)**2 / 24, delta=1e-5)
        self.assertAlmostEqual(extrapolated / exact, 1, delta=1e-5)

    def test_a_stored_run_is_none_of_a_case_that_the_program_refuses(self):
        done = self.refine(ROD, "--levels", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        quoted = self.refine(ROD.replace("highest: 1", "highest: '1'"), "--levels", "1")
        self.assertEqual(quoted.returncode, 2, quoted.stdout)
        self.assertIn("'highest' is a quoted text: write the number without quotes", quoted.stderr)


# ------------------------------------------------------------------------------------------------

ACCEPT = """import compare_runs
from verify import Breaks, Check, Falls, Figure, Pair

CLAIM = "A cube moves by what acts on it."
EVIDENCE = "exact"
CATALOGUE = []
DRIVER = "scene"
FIGURES = [Figure("speed", "time [s]", "speed [m/s]", lambda run: [("speed", run.column("time"), run.column("speed"))])]
"""
MEAN = ACCEPT + f"""
CHECKS = [Check("mean speed", lambda run: Pair(run.mean("speed", 0.01, 0.09), -{G} * 0.05, "m/s"), 1e-6, "round-off")]
BREAKS = [Breaks("mean speed", "less gravity", {{"gravity": "[0 m/s^2, 0 m/s^2, -9.8 m/s^2]"}})]
"""
# The force 1000 t^2 [N] gives 1 kg the speed 1000/3 t^3 [m/s]; a sum over steps dt is off by a part (dt/t)^2 / 2 of it.
STUDY = ACCEPT + """
CHECKS = [Check("speed", lambda run: Pair(run.result("speed_last"), 1 / 3, "m/s"), 1e-3, "steps of 1 ms")]
BREAKS = [Breaks("speed", "half of the force", {"loads[0].value": '["0", "0", "500*t^2"]'})]
STUDIES = [Falls("speed", "time.largest_step", VALUES, ORDER)]
"""
ENDS = ACCEPT + """
def end(run):
    ended = run.again({"loads[0].value": '["0", "0", "PUSH"]'})
    return Pair(ended.summary["ending"]["time"]["value"], 0.05, "s")

CHECKS = [Check("end", end, 0.05, "a step is 1 % of the time; the break ends 20 % earlier")]
BREAKS = [Breaks("end", "another end", {"time.end": "0.04 s"})]
"""
TWIN = ACCEPT + """
def apart(run):
    twin = run.again({"probes[1].value": "FORMULA"})
    return Pair(compare_runs.largest(compare_runs.histories(run, twin)), 0, scale=1)

CHECKS = [Check("twin", apart, 1e-9, "round-off")]
BREAKS = [Breaks("twin", "another formula", {"probes[1].value": "2*sqrt(abs(0.5 + speed))"})]
"""
MADE = "created energy of any source at any time"


def study(values, order):
    case = pushed("1000*t^2", "end: 0.1 s, largest_step: 1 ms")
    return STUDY.replace("VALUES", repr(values)).replace("ORDER", repr(order)), case


def ends(push, time):
    return ENDS.replace("PUSH", push), pushed("1", f"end: {time}", "false")


def twin(formula):
    """The speed is below -0.5 m/s from 0.051 s on."""
    root = '  - {name: root, value: "sqrt(abs(0.5 + speed))"}\n'
    return TWIN.replace("FORMULA", formula), falling("end: 0.1 s", "history_every: 5 ms", root)


CASES = {
    "mean": (MEAN, falling("end: 0.1 s", "history_every: 25 ms")),
    "falls": study(["1 ms", "0.5 ms"], 1.9),
    "grows": study(["0.5 ms", "1 ms"], 1.9),
    "only_grows": study(["0.5 ms", "1 ms"], None),
    "force": ends("sqrt(0.06 - t)", "0.05 s"),
    "no_force": ends("sqrt(0.05 - t)", "0.06 s"),
    "twin": twin("sqrt(abs(speed + 0.5))"),
    "no_twin": twin("sqrt(speed + 0.5)"),
}


class Suite(InAFolder):
    """scripts/verify.py judges all CASES at once: most of the time it takes is that of its start."""

    said = {}  # {case: lines of it}
    rest = ""  # lines that belong to no case

    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as name:
            tree = Path(name)
            shutil.copytree(SCRIPTS, tree / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
            for case, texts in CASES.items():
                (tree / "verification" / case).mkdir(parents=True)
                for file, text in zip(("accept.py", "case.yaml"), texts):
                    (tree / "verification" / case / file).write_text(text, encoding="utf-8")
            words = ["--drivers", cls.drivers, "--out", tree / "suite", "--no-figures", "--jobs", "1", "--verbose"]
            done = subprocess.run([sys.executable, tree / "scripts/verify.py", *words], capture_output=True, text=True, timeout=PATIENCE)
        lines = []
        for line in done.stdout.splitlines():
            lines.append(line)
            if end := re.match(r"(?:pass|FAIL)  (\w+): \d+ rows", line):
                cls.said[end.group(1)], lines = lines, []
        cls.rest = "\n".join(lines) + done.stderr

    def check(self, case, *names):
        """The rows with these names fail in a case, and no others."""
        self.assertIn(case, self.said, self.rest)
        lines = self.said[case]
        failed = [row.group(1) for line in lines[:-1] if (row := re.match(r"FAIL  (?:FAIL\s+)?(.*?): ", line))]
        self.assertEqual(failed, list(names), "\n".join(lines))
        self.assertEqual(lines[-1][:4], "FAIL" if names else "pass")

    def test_a_mean_over_coarse_rows_of_a_free_fall_is_the_speed_in_the_middle(self):
        self.check("mean")

    def test_an_error_must_fall_along_a_study(self):
        self.check("falls")
        self.check("grows", "*study:* speed along `time.largest_step` 0.5 ms, 1 ms")
        self.check("only_grows", "*study:* speed along `time.largest_step` 0.5 ms, 1 ms")

    def test_created_energy_that_is_no_number_fails(self):
        self.check("force")
        self.check("no_force", MADE)

    def test_a_column_that_is_no_number_in_one_of_two_runs_differs(self):
        self.check("twin")
        self.check("no_twin", "twin")


# ------------------------------------------------------------------------------------------------

CORNERS = [(x, y, z) for z in (0, 100) for y in (0, 100) for x in (0, 100)]  # [mm] of a cube
AROUND = (0, 1, 3, 2, 4, 5, 7, 6)  # their order in an element


def abaqus():
    """Three cubes in a row: all nodes in a set, and the first and the last cube in another one."""
    places = [(100 * i, y, z) for i in range(4) for z in (0, 100) for y in (0, 100)]
    nodes = "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in enumerate(places, start=1))
    cubes = "".join(f"{i + 1}, " + ", ".join(str(4 * i + n) for n in (1, 5, 6, 2, 3, 7, 8, 4)) + "\n" for i in range(3))
    return f"*NODE\n{nodes}*ELEMENT, TYPE=C3D8R, ELSET=BAR\n{cubes}*NSET, NSET=ALL, GENERATE\n1, 16\n" \
           "*ELSET, ELSET=ENDS, GENERATE\n1, 3, 2\n*ELSET, ELSET=MIDDLE\n2\n*SOLID SECTION, ELSET=ENDS\n*SOLID SECTION, ELSET=MIDDLE\n"


def dyna():
    """A cube in a file of the long format, whose nodes have the fields of the usual one."""
    nodes = "".join(f"{n:8d}{x:16.6f}{y:16.6f}{z:16.6f}\n" for n, (x, y, z) in enumerate(CORNERS, start=1))
    numbers = (1, 1, *(n + 1 for n in AROUND))
    return f"*KEYWORD LONG=Y\n*NODE-\n{nodes}*ELEMENT_SOLID\n" + "".join(f"{n:20d}" for n in numbers) + "\n*END\n"


STUFF = "{kind: elastic, density: 1000 kg/m^3, young: 10 MPa, poisson: 0.3}"
FROM_FILE = f"""bodies:
  - name: b
    mesh: {{kind: file, path: mesh.vtu, scale: 1 mm}}
    material: {STUFF}
"""
MOMENTUM = """probes:
  - {name: momentum, quantity: momentum, of: b, component: z}
time: {end: 1 ms}
"""


class Decks(InAFolder):
    def imported(self, name, text):
        self.write(name, text)
        done = self.script("import_mesh", name, "mesh.vtu")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_set_of_abaqus_has_its_last_number(self):
        """All nodes of the bar move at 1 m/s: its momentum is that of its mass, 2 cubes of 2 kg and one of 1 kg."""
        self.imported("bar.inp", abaqus())
        summary = self.run_case(f"""{FROM_FILE}    materials: [{{of: ENDS, material: {STUFF.replace("1000", "2000")}}}]
planes: [{{name: drive, kind: driven, nodes: [b.ALL], velocity: {{value: ["0", "0", "1"], unit: m/s}}}}]
{MOMENTUM}""")
        self.assertAlmostEqual(summary["results"]["momentum_last"]["value"], 5, delta=1e-9)

    def test_a_keyword_of_dyna_with_a_minus_has_fields_of_the_usual_width(self):
        self.imported("cube.k", dyna())
        summary = self.run_case(f"""{FROM_FILE}initial: [{{body: b, velocity: ["0", "0", "1"], unit: m/s}}]
{MOMENTUM}""")
        self.assertAlmostEqual(summary["results"]["momentum_last"]["value"], 1, delta=1e-9)


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    os.environ["NEREID_THREADS"] = "1"
    InAFolder.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
