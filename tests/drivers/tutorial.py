"""The numbers of docs/tutorial.md: its tables against runs of its cases. Twenty seconds, of which the crushed tube has ten.

A row of a table with the head `result | value | within | check` belongs to the last case that a command before it runs. The value is with
its unit, `within` is per cent of it. Every case of cases/tutorial must be run and have such a table, and none but the crushed tube warns.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DRIVERS = Path("build/release/drivers")
PAGE = ROOT / "docs/tutorial.md"
CASES = ROOT / "cases/tutorial"
UNITS = {"N": 1, "kN": 1e3, "N s": 1, "ms": 1e-3, "mm": 1e-3, "mm²": 1e-6, "m/s": 1, "m/s²": 1, "MPa": 1e6, "µm/m": 1e-6, "": 1}
WARNS = {"crushed_tube"}
HEAD, RULE = "| result | value | within | check |", "|---|---|---|---|"


def tables(text):
    """{case: [(result, value in SI, part of it within which a run must be)]} of the page; every row of its tables has a result."""
    found, case, in_table = {}, None, False
    for number, line in enumerate(text.splitlines(), start=1):
        run = re.match(r" {4}build/release/drivers/scene cases/tutorial/(\w+)\.yaml", line)
        row = re.match(r"\| `(\w+)` \| (-?[\d.]+) ?([^|]*) \| ([\d.]+) % \| [^|]+ \|$", line)
        if run:
            case = run.group(1)
        in_table = line == HEAD or in_table and line.startswith("|")
        if not in_table or line in (HEAD, RULE):
            continue
        if not row or row.group(3).strip() not in UNITS:
            raise AssertionError(f"{PAGE.name}:{number}: '{line}' is no row: expected is '{HEAD}', the value with one of the units "
                                 f"{', '.join(unit for unit in UNITS if unit)}")
        result, value, unit, within = row.groups()
        found.setdefault(case, []).append((result, float(value) * UNITS[unit.strip()], float(within) / 100))
    return found


def run(case, folder):
    """(results, warnings) of a case in a copy of the tree."""
    done = subprocess.run([DRIVERS / "scene", folder / f"cases/tutorial/{case}.yaml", "--quiet", "--out", folder / "out" / case],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{case}: status {done.returncode}\n{done.stderr}")
    results = json.loads((folder / "out" / case / "summary.json").read_text(encoding="utf-8"))["results"]
    return results, [line for line in done.stderr.splitlines() if line.startswith("warning: ")]


class Tutorial(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        shutil.copytree(CASES, self.folder / "cases/tutorial")
        (self.folder / "out").mkdir()
        subprocess.run([sys.executable, ROOT / "scripts/import_mesh", CASES / "bracket.inp", self.folder / "out/bracket.vtu"], check=True,
                       stdout=subprocess.DEVNULL)

    def test_a_row_that_is_none_is_a_fault(self):
        page = "    build/release/drivers/scene cases/tutorial/a.yaml\n\n" + f"{HEAD}\n{RULE}\n" + "| `x` | -1.5 ms | 2 % | none |\n"
        self.assertEqual(tables(page + "\n| other | table |\n"), {"a": [("x", -1.5e-3, 0.02)]})
        for row in ("| x | 1 ms | 2 % | none |", "| `x` | 1 ms | 2 | none |", "| `x` | 1 parsec | 2 % | none |", "| `x` | 1 ms | 2 % |"):
            with self.subTest(row=row), self.assertRaisesRegex(AssertionError, "tutorial.md:6: '.*is no row"):
                tables(page + row)

    def test_every_case_has_a_table_with_three_results_or_more(self):
        found = tables(PAGE.read_text(encoding="utf-8"))
        self.assertEqual(set(found), {path.stem for path in CASES.glob("*.yaml")})
        for case, rows in found.items():
            self.assertGreaterEqual(len(rows), 3, case)

    def test_numbers_are_those_of_the_runs(self):
        for case, rows in tables(PAGE.read_text(encoding="utf-8")).items():
            results, warnings = run(case, self.folder)
            for name, value, within in rows:
                with self.subTest(case=case, result=name):
                    got = results[name]["value"]
                    self.assertLessEqual(abs(got - value), within * abs(value), f"the page has {value:g}, the run {got:g}")
            with self.subTest(case=case, of="warnings"):
                self.assertEqual(bool(warnings), case in WARNS, warnings)


if __name__ == "__main__":
    DRIVERS = Path(sys.argv.pop(1))
    unittest.main()
