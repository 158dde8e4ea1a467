"""scripts/trade with a driver that is made up here: its depth is 1 + 0.4/cells^2, exact at a step of 0.5, and some settings fail."""
import contextlib
import io
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
trade = made_up.script("trade")

DRIVER = """#!{python}
import json
import sys
from pathlib import Path
out = Path(sys.argv[sys.argv.index("--out") + 1])
set_to = dict(sys.argv[i + 1].split("=", 1) for i, word in enumerate(sys.argv) if word == "--set")
cells, safety, kind = int(set_to.get("mesh.cells", 4)), float(set_to.get("time.safety", 0.9)), set_to.get("element.kind", "one_point")
count = Path({count!r})
count.write_text(str(int(count.read_text()) + 1))
if kind == "full":
    print("case.yaml:2:1: 'kind' is not there", file=sys.stderr)
    sys.exit(2)
if safety < 0.5:
    print("warning: it takes long", file=sys.stderr)
depth = 1 + 0.4 / cells**2 * (safety - 0.5)
(out / "history.csv").write_text("time [s],depth [m]\\n0,0\\n1,1\\n")
resolved = {{"mesh": {{"cells": {{"value": cells, "unit": "1", "default": False}}}},
            "time": {{"safety": {{"value": safety, "unit": "1", "default": True}}}},
            "element": {{"kind": {{"value": kind, "unit": None, "default": True}}}}}}
word = "energy_created" if safety > 1.5 else "reached_end"
cost = {{"elements": cells, "steps": int(cells / safety), "element_updates": int(cells**2 / safety), "wall_seconds": 0.1, "threads": 1}}
(out / "summary.json").write_text(json.dumps({{"ending": {{"word": word}}, "results": {{"depth": {{"value": depth, "unit": "m"}}}},
    "cost": cost, "ledger": {{"accounts": {{"body": {{"created_relative": {{"value": 0.0}}}}}}}},
    "provenance": {{"resolved": resolved}}, "not_used": ["element.kind (--set:19)"] if kind == "spare" else []}}))
"""


class SweepTest(unittest.TestCase):
    def setUp(self):
        self.root = made_up.folder(self, "mesh: {cells: 4}\n")
        self.count = self.root / "count"
        made_up.driver(self.root, "scene", DRIVER)

    def sweep(self, *words):
        options = trade.options_of([str(self.root / "case.yaml"), "--result", "depth", "--drivers", str(self.root / "drivers"), "--out",
                                    str(self.root / "out"), "--jobs", "1", "--finest", "4,8,16", *words])
        with contextlib.redirect_stdout(io.StringIO()):
            found, base, references = trade.sweep(trade.of_file(options), options)
        return {point.name(): point for point in found}, base, references

    def test_every_value_alone_and_pairs_of_those_that_pay(self):
        found, base, references = self.sweep("--knobs", "mesh=0.5,2", "step=0.9,1.2,2", "element=full,spare")
        self.assertEqual(references["depth"].known, "observed order 2.00")
        self.assertAlmostEqual(base.errors["depth"], 0.01, delta=1e-4)
        self.assertAlmostEqual(found["mesh x2"].errors["depth"], 0.0025, delta=1e-4)
        self.assertEqual(found["step 2"].ending, "stopped: energy_created")
        self.assertEqual(found["element full"].ending, "refused: 'kind' is not there")
        self.assertEqual(found["element spare"].ending, "not used: element.kind")
        self.assertIn("mesh x0.5, step 1.2", found)
        self.assertNotIn("step 0.9", found)  # as the case has it

    def test_a_point_of_the_front_has_its_finer_meshes(self):
        found, _, _ = self.sweep("--knobs", "mesh=2,4", "step=1.2", "--no-pairs")
        self.assertNotIn("mesh x2, step 1.2", found)
        found, _, _ = self.sweep("--knobs", "mesh=2,4", "step=1.2")
        self.assertIn("mesh x4, step 1.2", found)

    def test_every_combination_of_what_is_crossed_is_run_once(self):
        options = trade.options_of([str(self.root / "case.yaml"), "--result", "depth", "--drivers", str(self.root / "drivers"), "--out",
                                    str(self.root / "out"), "--jobs", "1", "--finest", "4,8,16", "--knobs", "mesh=2,4", "step=0.7,0.45"])
        definition = trade.of_file(options)
        definition.cross = [{"mesh": ("x1", "x2", "x4"), "step": ("0.9", "0.45"), "layers": ("2",)}]
        with contextlib.redirect_stdout(io.StringIO()):
            names = [point.name() for point in trade.sweep(definition, options)[0]]
        self.assertEqual(len(names), len(set(names)))
        self.assertLess({"mesh x2, step 0.45", "mesh x4, step 0.45", "step 0.45", "as the case has it"}, set(names))

    def test_runs_beside_the_meshes_count_and_meshes_may_have_keys_of_their_own(self):
        options = trade.options_of([str(self.root / "case.yaml"), "--result", "depth", "--drivers", str(self.root / "drivers"), "--out",
                                    str(self.root / "out"), "--jobs", "1", "--knobs", "step=0.7", "--no-pairs"])
        definition = trade.of_file(options)
        definition.meshes = trade.points.Meshes((1, 2, 4), of=lambda factor: {"mesh.cells": f"{4 * factor}"},
                                                beside={"0.7": {"time.safety": "0.7"}, "0.9": {"time.safety": "0.9"}})
        with contextlib.redirect_stdout(io.StringIO()):
            _, _, references = trade.sweep(definition, options)
        self.assertAlmostEqual(references["depth"].value, 1 + 0.4 / 256 * 0.4)
        self.assertGreater(references["depth"].uncertainty, 0.4 / 16 * 0.2)

    def test_runs_are_found_again(self):
        self.sweep("--knobs", "mesh", "step")
        before = self.count.read_text()
        self.sweep("--knobs", "mesh", "step")
        self.assertEqual(int(self.count.read_text()) - int(before), 0)

    def test_warnings_and_processor_time_are_those_of_the_run(self):
        found, _, _ = self.sweep("--knobs", "step=0.45")
        self.assertEqual(found["step 0.45"].warnings, 1)
        self.assertGreater(found["step 0.45"].seconds, 0)

    def test_what_the_budget_leaves_out_is_said_and_a_kept_run_costs_none(self):
        self.sweep("--knobs", "step=0.7", "--no-pairs")
        found, base, references = self.sweep("--knobs", "step=0.7,1.1", "--no-pairs", "--budget", "1e-9")
        self.assertEqual([found[name].ending for name in ("as the case has it", "step 0.7", "step 1.1")], ["good", "good", "left out"])
        definition = trade.Definition("case", "a case", "scene", "", {}, [], None, {})
        self.assertIn("2 of 3 runs have a result; the budget left out 1.",
                      trade.page_of(definition, list(found.values()), base, references, "case.svg"))


class PageTest(unittest.TestCase):
    def test_only_what_is_between_the_markers_of_the_case_is_replaced(self):
        page = "a\n<!-- written by scripts/trade x -->\nold\n<!-- end of what scripts/trade x writes -->\nb\n"
        new = trade.put(page, "x", "new\n")
        self.assertTrue(new.startswith("a\n<!-- written") and new.endswith("writes -->\nb\n") and "new" in new and "old" not in new)
        with self.assertRaises(trade.CannotRun):
            trade.put(page, "y", "new\n")

    def test_the_page_has_what_the_committed_points_say(self):
        page = trade.PAGE.read_text(encoding="utf-8")
        self.assertEqual(trade.put(page, "--worst", trade.worst()), page, "scripts/trade --worst --write brings the table up to date")
        for path in sorted((trade.ROOT / "verification").glob("*/trade.csv")):
            lines = len(path.read_text(encoding="utf-8").splitlines()) - 1
            self.assertIn(f"of {lines} runs have a result", page.split(trade.markers(path.parent.name)[0])[1][:80])

    def test_all_definitions_of_the_tree_can_be_read(self):
        for path in sorted((trade.ROOT / "verification").glob("*/trade.py")):
            with self.subTest(path.parent.name):
                one = trade.of_folder(path.parent.name)
                self.assertTrue(one.results and one.title)
                trade.knobs.of_case(one.knobs)


if __name__ == "__main__":
    unittest.main()
