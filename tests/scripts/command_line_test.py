"""Bad arguments of scripts get one sentence on stderr and exit status 2, and nothing else."""
import argparse
import contextlib
import io
import os
import re
import runpy
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"
sys.path.insert(0, str(SCRIPTS))
import command_line  # noqa: E402  (after the path)

BARS = "cases/two_blocks/bars.yaml"

# A driver that refuses whatever `--set` gives, as a driver says it, and knows no other results than `depth`.
DRIVER = """#!/usr/bin/env python3
import json, sys
from pathlib import Path
if "--set" in sys.argv:
    print("--set nosuch=1:1: unknown key 'nosuch'\\n      | nosuch=1\\n      | ^~~~~~  known here: mesh", file=sys.stderr)
    sys.exit(2)
if "--dry-run" not in sys.argv:
    out = Path(sys.argv[sys.argv.index("--out") + 1])
    (out / "history.csv").write_text("time [s]\\n0\\n")
    (out / "summary.json").write_text(json.dumps({"ending": {"word": "reached_end"}, "results": {"depth": {"value": 1, "unit": "m"}},
                                                  "cost": {}, "provenance": {"resolved": {"mesh": {"cells": {"value": 4}}}}}))
"""

NAME = "is called 'nosuch'"
COUNT, NUMBER, FINITE = "expected is 1 or more", "is no positive number", "is no finite number"
NO_COUNTS, NO_NUMBERS, NO_FINITE, NO_SEEDS = ("0",), ("nan",), ("inf",), ("-1",)  # one of them each; the test of types has all
CHOICE, SEED = "invalid choice: 'nosuch'", "is no seed"
NEEDS, NOT_BUILT, NO_FOLDER = "arguments are required", "is not built", "is no folder"

# (script, words, what the sentence says). In words {file} is a file, {there} a folder, {programs} one with made-up programs,
# {run} that of a run, {history} rows of a millisecond. `{one}` stands for each of what is listed behind.
TABLE = [
    ("accuracy", "--only nosuch", CHOICE), ("accuracy", "--target={one}", "is no accuracy", "2 nan% 0% 1.2.3%".split()),
    ("accuracy", "--patience={one}", NUMBER, NO_NUMBERS), ("accuracy", "--patience 1e300", "is too long"),
    ("accuracy", "--drawn --jobs={one}", COUNT, NO_COUNTS), ("accuracy", "--drawn --seed={one}", COUNT, NO_COUNTS),
    ("accuracy", "nosuch", "unrecognized"),
    ("cfc", "{run} --class 60 tip", "is no file"), ("cfc", "{file} tip", NEEDS), ("cfc", "{file} --class 61 tip", "invalid choice: 61"),
    ("cfc", "{file} --class 60 tip", "is no column header"), ("cfc", "{history} --class 60 nosuch tap", "'tap'; did you mean tip?"),
    ("cfc", "{history} --class 60 tip --out {there}", "is a folder"),
    ("cfc", "{history} --class 60 tip --out {history}", "the history itself"),
    ("cfc", "{history} --class 1000 tip", "too far for CFC 1000"), ("cfc", "{history} --class 60 time", "filtered over"),
    ("cfc", "{history} --class 60 tip --out /proc/nosuch/a.csv", "cannot be written"),
    ("coarse", "--scenes={one}", COUNT, NO_COUNTS), ("coarse", "--seed={one}", SEED, NO_SEEDS), ("coarse", "nosuch", "unrecognized"),
    ("import_mesh", "nosuch.msh nosuch.vtu", "is no file"), ("import_mesh", "{file} nosuch.txt", "is no .vtu file"),
    ("import_mesh", "{file} {there}", "is no .vtu file"), ("import_mesh", "{file} a.vtu nosuch", "unrecognized"),
    ("benchmark", "--rounds={one}", COUNT, NO_COUNTS), ("benchmark", "nosuch", "invalid choice"),
    ("head_study", "{one}", "no table is called", ("plug", "all")),
    ("cask_study", "--levels={one}", COUNT, ("0,1,2",)), ("cask_study", "--levels 1,2 --default 2", "three levels"),
    ("cask_study", "--default={one}", COUNT, NO_COUNTS), ("cask_study", "--threads={one}", COUNT, NO_COUNTS),
    ("extremes", "--axis nosuch", CHOICE),
    ("extremes", "--cell nosuch --drivers {programs} --out {there}", "no cell has 'nosuch' in its name"),
    ("extremes", "--axis speed --cell nosuch --drivers {programs} --out {there}", "on the axis speed"),
    ("extremes", "--one {one} --drivers {programs} --out {there}", "no cell is called", ("nosuch", '["random","x"]')),
    ("extremes", "--jobs={one}", COUNT, NO_COUNTS), ("extremes", "--random={one}", COUNT, NO_COUNTS),
    ("extremes", "--seed={one}", SEED, NO_SEEDS),
    ("extremes", "--clock={one}", NUMBER, NO_NUMBERS), ("extremes", "--known --out {there}", "has no verdicts"),
    ("figure", "", NEEDS), ("figure", "nosuch", CHOICE), ("figure", "energy nosuch --out {there}/a.svg", NO_FOLDER),
    ("figure", "energy {there}", NEEDS), ("figure", "energy {there} --out {there}", "is a folder: expected is a file"),
    ("figure", "energy {there} --out {file}/a.svg", "is a file: expected is a folder"),
    ("figure", "energy {there} --out /proc/nosuch/a.svg", "cannot be written"),
    ("figure", "energy {there} --out {there}/a.svg", "history.csv: No such file"),
    ("figure", "settlement {there} nosuch --out {there}/a.svg", NO_FOLDER),
    ("forecast", "nosuch --drivers {programs}", NAME), ("forecast", "{there} --drivers {programs}", "has no case"),
    ("forecast", "--patience={one}", NUMBER, NO_NUMBERS),
    ("forecast", "verification/taylor_ba --drivers {programs}", "did you mean verification/taylor_"),
    ("house.py", "", NEEDS), ("house.py", "nosuch", CHOICE), ("house.py", "all --root nosuch", NO_FOLDER),
    ("keys", "nosuch", "unrecognized"), ("keys", "--drivers nosuch", "is no folder"), ("keys", "--drivers {there}", NOT_BUILT),
    ("limits.py", "nosuch", "unrecognized"),
    ("mutate", "nosuch", "no fault is called 'nosuch'"), ("mutate", "--list --ci", "not allowed"),
    ("mutate", "--jobs={one}", COUNT, NO_COUNTS), ("mutate", "--list --seconds={one}", NUMBER, NO_NUMBERS),
    ("mutate", "--groups nosuch", CHOICE), ("mutate", "--ci --work {file}", "expected is a folder"),
    ("experiments", "nosuch", "no folder of verification/ with points is called nosuch"),
    ("experiments", "--points nosuch", "is no file"), ("experiments", "--points {history}", "the columns family"),
    ("experiments", "--drivers {there}", NOT_BUILT),
    ("pages", "--page nosuch.md", "no page is called 'nosuch.md'"), ("pages", "--page README", "did you mean README.md"),
    ("pages", "--patience={one}", NUMBER, NO_NUMBERS), ("pictures", "nosuch.svg", "no picture is called 'nosuch.svg'"),
    ("refine", "", NEEDS), ("refine", "nosuch.yaml", "is no file"), ("refine", "{case} --by={one}", NUMBER, ("1,nan",)),
    ("report", "", NEEDS), ("report", "nosuch", NO_FOLDER), ("report", "{file}", NO_FOLDER),
    ("report", "{there}", "is no run: expected is"), ("report", "{run} {there}", "is no run"),
    ("report", "{run} --at {one}", "is no time", ("x", "nan", "inf", "1km")),
    ("report", "{run} --probes nosuch", "no probe is called 'nosuch'; there are: none"),
    ("report", "{run} --quick --at 1", "leave --at and --field away"), ("report", "{run} --quick --field x", "leave --at and --field away"),
    ("report", "{run} --text", "expected are two folders or more"), ("report", "{run} {there} --text", "is no run"),
    ("report", "{run} {run} --text --quick", "leave the other options away"),
    ("report", "{run} --quick --out {there}", "expected is a file"),
    ("report", "{run} --quick --out {file}/a.html", "expected is a folder"),
    ("report", "{run} --quick --out /proc/nosuch/a.html", "cannot be written"),
    ("refine", "{case} --levels={one}", COUNT, NO_COUNTS), ("refine", "{case} --threads={one}", COUNT, NO_COUNTS),
    ("refine", "{case} --threads 2000", "1024 at most"), ("refine", "{case} --set nosuch", "is no KEY=VALUE"),
    ("prove", "nosuch", "there is no 'nosuch'"), ("prove", "address nosuch", "there is no 'nosuch'"),
    ("interfaces", "--scene nosuch", "invalid choice"), ("interfaces", "--rule nosuch", "invalid choice"),
    ("invariance", "", "no case is given"), ("invariance", "nosuch.yaml", "is no file"),
    ("invariance", "{case} --only nosuch", "no change is called 'nosuch'"),
    ("slides", "nosuch", "unrecognized"), ("slides", "--contact nosuch", "no contact is called 'nosuch'"),
    ("slides", "--count={one}", COUNT, NO_COUNTS), ("slides", "--jobs={one}", COUNT, NO_COUNTS), ("slides", "--seed={one}", SEED, NO_SEEDS),
    ("syntax", "--nosuch", "unrecognized"), ("syntax", "--jobs={one}", COUNT, NO_COUNTS),
    ("refine", "{case} --driver nosuch --drivers {programs} --out {there}", NOT_BUILT),
    ("refine", "{case} --drivers {programs} --out {there} --csv {there}", "is a folder: expected is a file"),
    ("refine", "{case} --drivers {programs} --out {there} --csv {file}/a.csv", "is a file: expected is a folder"),
    ("refine", "{case} --drivers {programs} --out {there} --csv /proc/nosuch/a.csv", "cannot be written"),
    ("refine", "{case} --drivers {programs} --out {there} --set nosuch=1", "unknown key 'nosuch'"),
    ("refine", "{case} --drivers {programs} --out {there} --along nosuch", "the case has no 'nosuch'; counts of cells are: mesh.cells"),
    ("refine", "{case} --drivers {programs} --out {there} --result nosuch", "no result is called 'nosuch'; there are: depth"),
    ("stops", "nosuch", "unrecognized"),
    ("trade", "", "expected is CASE, or --worst"), ("trade", "nosuch", NAME), ("trade", "taylor_ba", "did you mean taylor_bar?"),
    ("trade", "two_blocks --knobs nosuch --drivers {programs} --out {there}", "'nosuch' is no knob"),
    ("trade", "two_blocks --knobs step=x --drivers {programs} --out {there}", "'x' is no value of step"),
    ("trade", "two_blocks --budget={one}", NUMBER, NO_NUMBERS), ("trade", "two_blocks --jobs={one}", COUNT, NO_COUNTS),
    ("trade", "two_blocks --points={one}", COUNT, NO_COUNTS), ("trade", "two_blocks --seed={one}", SEED, NO_SEEDS),
    ("trade", "two_blocks --finest={one}", NUMBER, ("1,2,nan",)), ("trade", "two_blocks --finest=1,2", "three factors"),
    ("trade", "two_blocks --sampling nosuch", CHOICE), ("trade", "two_blocks --set nosuch", "is no KEY=VALUE"),
    ("trade", "two_blocks --into nosuch.md", "is no file"), ("trade", "two_blocks --name a/b", "is no name of a file"),
    ("trade", "two_blocks --snakemake {file}/within", "expected is a folder"),
    ("trade", "{case}", "needs --result"), ("trade", "{case} --result depth --driver nosuch --drivers {programs}", NOT_BUILT),
    ("trade", "{case} --result nosuch --drivers {programs} --out {there}", "no result is called 'nosuch'; there are: depth"),
    ("trade", "{case} --result depth --set nosuch=1 --drivers {programs} --out {there}", "unknown key 'nosuch'"),
    ("trade", "{case} --result depth --vary nosuch --drivers {programs} --out {there}", "'nosuch' is no input"),
    ("trade", "{case} --result depth --vary nosuch=1..2 --drivers {programs} --out {there}", "is refused: --set nosuch=1:1: unknown key"),
    ("tutorial_pictures", "nosuch", "unrecognized"),
    ("update_case", "", NEEDS), ("update_case", "nosuch.yaml", "nosuch.yaml: No such file or directory"),
    ("update_case", "{there}", "Is a directory"),
    ("verify.py", "nosuch", "no folder of verification/ is called nosuch"), ("verify.py", "--quick --full", "not allowed"),
    ("verify.py", "--jobs={one}", COUNT, NO_COUNTS), ("verify.py", "--threads={one}", COUNT, NO_COUNTS),
    ("verify.py", "--threads 2000", "1024 at most"),
    ("verify.py", "--write --no-figures", "leave --no-figures away"), ("verify.py", "--no-breaks", "without figures"),
    ("verify", "nosuch", "no folder of verification/ is called nosuch"), ("verify", "--jobs=0", COUNT),
    ("view.py", "", NEEDS), ("view.py", "nosuch", NO_FOLDER), ("view.py", "{there}", "nothing to draw"), ("view.py", "{file}", NO_FOLDER),
    ("view.py", "{run} --field nosuch", "no field is called 'nosuch'; there are: displacement, stress"),
    ("view.py", "{run} --field stress", "say which component"),
    ("view.py", "{run} --field stress --component Q", "has the components XX, YY"),
    ("view.py", "{run} --show nosuch", "expected are some of body,contact,walls"), ("view.py", "{run} --show contact", "nothing to draw"),
    ("view.py", "{run} --time={one}", FINITE, NO_FINITE), ("view.py", "{run} --warp={one}", FINITE, NO_FINITE),
    ("view.py", "{run} --elevation={one}", FINITE, NO_FINITE), ("view.py", "{run} --azimuth={one}", FINITE, NO_FINITE),
    ("view.py", "{run} --range {one}", "--range", ("nan 1", "2 1")), ("view.py", "{run} --opacity={one}", "from 0 to 1", ("nan",)),
    ("view.py", "{run} --cut-at {one}", FINITE, NO_FINITE), ("view.py", "{run} --hide nosuch", "no body is called 'nosuch'"),
    ("view.py", "{run} --only nosuch", "no body is called 'nosuch'"), ("view.py", "{run} --cut nosuch", "no body is called 'nosuch'"),
    ("view.py", "{run} --only a --hide a", "not allowed with"), ("view.py", "{run} --hide bar", "there is no other body"),
    ("paraview_run.py", "nosuch", NO_FOLDER), ("paraview_run.py", "{there}", "lists no frame"),
    ("paraview_run.py", "{run} --picture {there}", "expected is a file"), ("paraview_run.py", "{run} --time={one}", FINITE, NO_FINITE),
    ("view.py", "{run} --size {one}", "--size", ("0 1", "99999 1")), ("view.py", "{run} --out {there}", "expected is a file"),
    ("view.py", "{run} --frames {there} --time 1", "leave --time and --out away"),
    ("view.py", "{run} --frames {file}", "expected is a folder"), ("view.py", "{run} --frames /proc/nosuch", "cannot be written"),
    ("view.py", "{run} --out {file}/a.png", "expected is a folder"), ("view.py", "{run} --out /proc/nosuch/a.png", "cannot be written"),
]
CASE_OF = {"accuracy": "", "coarse": "", "extremes": "", "refine": "{case}", "stops": "", "trade": "two_blocks", "verify.py": "",
           "forecast": "", "contact_trade": "", "pages": "", "pictures": "", "tutorial_pictures": ""}
WITHOUT_OUT = ("forecast", "contact_trade", "pages", "pictures")
FOR_PROGRAMS = [one for script, case in CASE_OF.items() for one in (
    (script, f"{case} --drivers nosuch", "expected is the folder of the programs"),
    (script, f"{case} --drivers {{file}}", "expected is the folder"),
    (script, f"{case} --drivers {{there}}", NOT_BUILT))]
FOR_RESULTS = [one for script, case in CASE_OF.items() if script not in WITHOUT_OUT for one in (
    (script, f"{case} --out {{file}}/within --drivers {{programs}}", "expected is a folder"),
    (script, f"{case} --out {'x' * 300}/{{file}} --drivers {{programs}}", "is no name of a folder"),
    (script, f"{case} --out /proc/nosuch --drivers {{programs}}", "cannot be written"))]
WITHOUT_ARGUMENTS = {"words.py"}
SHELL = ("verify", "prove")
OTHERS = {"run_tests", "reproduce_cask_drop", "cask_inputs"}  # they pass their words on: to ctest, the driver and scripts/trade


def made_up_run(folder):
    """A folder with a frame of a body."""
    (folder / "body.pvd").write_text('<VTKFile><Collection><DataSet timestep="0" file="0.vtu"/></Collection></VTKFile>', encoding="utf-8")
    components = " ".join(f'ComponentName{i}="{name}"' for i, name in enumerate(("XX", "YY", "ZZ", "XY", "YZ", "XZ")))
    (folder / "0.vtu").write_text('<VTKFile><FieldData><DataArray Name="bar" NumberOfTuples="2"/></FieldData><PointData>'
                                  '<DataArray Name="displacement" NumberOfComponents="3"/></PointData><CellData>'
                                  f'<DataArray Name="stress" NumberOfComponents="6" {components}/></CellData></VTKFile>', encoding="utf-8")


def started(script, words, folder):
    """(status, stdout, stderr) of a script in a process of its own."""
    start = ["bash"] if script.name in SHELL else [sys.executable]
    done = subprocess.run([*start, script, *words], cwd=folder, capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


def within(script, words, folder):
    """The same of a script of Python, in this process."""
    out, err, here, argv = io.StringIO(), io.StringIO(), os.getcwd(), sys.argv
    os.chdir(folder)
    sys.argv = [str(script), *map(str, words)]
    status = 0
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            runpy.run_path(str(script), run_name="__main__")
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else 1 if end.code else 0
        if isinstance(end.code, str):
            err.write(f"{end.code}\n")
    finally:
        os.chdir(here)
        sys.argv = argv
    return status, out.getvalue(), err.getvalue()


class BadArguments(unittest.TestCase):
    seen = set()  # scripts that have run in a process

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)
        for name in ("there", "programs", "run"):
            (self.root / name).mkdir()
        (self.root / "file").write_text("")
        for name in ("scene", "two_blocks", "cask_drop", "sliding", "contact_elements", "material_point", "modes", "patch_test",
                     "penalty_oscillator", "plug_juncture", "shield_plates", "slug_impact"):
            (self.root / "programs" / name).write_text(DRIVER)
            (self.root / "programs" / name).chmod(0o755)
        made_up_run(self.root / "run")
        self.history = self.root / "history.csv"
        self.history.write_text("time [s],tip [m]\n" + "".join(f"{i / 1000},{i % 7}\n" for i in range(50)))
        self.case = self.root / "case.yaml"
        self.case.write_text("mesh: {cells: 4}\n")

    def refused(self, script, words, says, scripts=SCRIPTS, start=started):
        names = {name: self.root / name for name in ("file", "there", "programs", "run")}
        names = {**names, "case": self.case, "history": self.history, "root": ROOT}
        words = [word.format(**names) if not word.startswith("[") else word for word in words.split()]
        status, out, err = start(scripts / script, words, self.root)
        if status == 77:
            return
        self.assertEqual((status, out), (2, ""), err)
        self.assertEqual(len(err.splitlines()), 1, err)
        self.assertIn(says, err)

    def each(self, rows):
        """The first row of a script by a process of its own, the others in this one: a process takes ten times as long."""
        for script, words, says, *values in rows:
            for one in values[0] if values else [""]:
                said = words.replace("{one}", one)
                with self.subTest(script=script, words=said):
                    self.refused(script, said, says, start=within if script in self.seen and script not in SHELL else started)
                self.seen.add(script)

    def test_every_script_tells_what_is_wrong_in_one_sentence(self):
        self.each(TABLE)

    def test_types_refuse_what_makes_no_sense(self):
        no_words = ("", "x", "nan", "1,5", "1e", "9" * 5000 + "x")
        for read, good, bad in (
                (command_line.count, ("1", "7"), ("0", "-1", "1.5", "inf")),
                (command_line.seed, ("0", "7"), ("-1", "1.5", "inf")),
                (command_line.threads, ("1", "1024"), ("0", "1025", "1.5")),
                (command_line.finite, ("-1", "0", "1e3"), ("inf", "-inf")),
                (command_line.positive, ("1e-9", "1e300"), ("0", "-1", "inf", "1e999")),
                (command_line.seconds, ("0.5", "1e6"), ("0", "-1", "inf", "1e7"))):
            for text in good:
                self.assertEqual(read(text), float(text))
            for text in (*no_words, *bad):
                with self.subTest(read=read.__name__, text=text[:9]), self.assertRaises(argparse.ArgumentTypeError):
                    read(text)
        self.assertEqual(command_line.counts("3,1,3"), [1, 3])
        self.assertEqual(command_line.positives("2,1.5"), [2.0, 1.5])
        for read in (command_line.counts, command_line.positives):
            for text in ("", "1,", "1,0", "1,-1", "1,nan", "1,x"):
                with self.subTest(read=read.__name__, text=text), self.assertRaises(argparse.ArgumentTypeError):
                    read(text)

    def test_programs_that_are_not_there_are_told(self):
        self.each(FOR_PROGRAMS)

    def test_results_that_cannot_be_written_are_told(self):
        self.each(FOR_RESULTS)

    def test_a_tree_where_nothing_is_built_is_told(self):
        tree = self.root / "tree"
        shutil.copytree(SCRIPTS, tree / "scripts", ignore=shutil.ignore_patterns("__pycache__"))
        for name in ("cases", "docs", "verification"):
            (tree / name).symlink_to(ROOT / name)
        for script, case in {**CASE_OF, "cask_study": "", "benchmark": ""}.items():
            with self.subTest(script):
                self.refused(script, case, "is no build folder" if script == "benchmark" else NOT_BUILT, tree / "scripts")

    def test_every_script_that_takes_arguments_is_in_the_table(self):
        programs = {path.name for path in SCRIPTS.iterdir() if path.is_file() and path.stat().st_mode & 0o100 and "." in path.name
                    or path.is_file() and "." not in path.name}
        programs = {name for name in programs if re.match(r"#!", (SCRIPTS / name).read_text(encoding="utf-8"))}
        self.assertEqual(programs - WITHOUT_ARGUMENTS - OTHERS, {row[0] for row in [*TABLE, *FOR_PROGRAMS]})


if __name__ == "__main__":
    unittest.main()
