"""scripts/trade --snakemake with the driver of trade_test.py: the parts of a workflow give the tables that the sweep gives without one."""
import contextlib
import io
import shutil
import subprocess
import unittest
import made_up
from trade_test import DRIVER, trade
import trade_workflow as workflow


class WorkflowTest(unittest.TestCase):
    def setUp(self):
        self.root = made_up.folder(self, "mesh: {cells: 4}\n")
        self.count, self.flow = self.root / "count", self.root / "flow"
        made_up.driver(self.root, "scene", DRIVER)
        self.words = [str(self.root / "case.yaml"), "--result", "depth", "--drivers", str(self.root / "drivers"), "--jobs", "1",
                      "--finest", "4,8,16", "--knobs", "mesh=0.5,2", "step=1.2,2", "element=full"]

    def trade(self, *words):
        """The command with these words; no figure is drawn."""
        options = trade.options_of([*self.words, *words])
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            trade.act(trade.of_file(options), options, [*self.words, *words])
        return said.getvalue()

    def part(self, part, out="out"):
        self.trade("--out", str(self.root / out), "--snakemake", str(self.flow), "--part", part)

    def run_stages(self):
        """What Snakemake does: each stage lists its runs, which are made one by one; how many each had."""
        had = []
        for stage in range(workflow.MANY):
            self.part(f"next-{stage}")
            keys = (self.flow / f"next/{stage}.txt").read_text().split()
            for key in keys:
                self.part(f"run-{key}")
            had.append(len(keys))
        return had

    def sweep(self, *words):
        """{name: (ending, errors, updates)} of the points of the sweep, as the tables have them."""
        options = trade.options_of([*self.words, *words])
        with contextlib.redirect_stdout(io.StringIO()):
            found, _, _ = trade.sweep(trade.of_file(options), options)
        return {one.name(): (one.ending, one.errors, one.updates) for one in found}

    def test_the_parts_make_what_the_sweep_makes_without_a_workflow(self):
        self.trade("--out", str(self.root / "out"), "--snakemake", str(self.flow))
        self.assertEqual(self.count.read_text(), "0")  # written without a run
        had = self.run_stages()
        self.assertEqual((had[0], had[-1]), (1, 0))
        self.assertGreater(had[3], 0)  # pairs
        before = self.count.read_text()
        parts = self.sweep("--out", str(self.root / "out"), "--snakemake", str(self.flow), "--part", "tables")
        self.assertEqual(self.count.read_text(), before)
        self.assertEqual(parts, self.sweep("--out", str(self.root / "other")))
        self.assertEqual(parts["element full"][0], "refused: 'kind' is not there")

    def test_it_goes_on_where_it_stopped_and_makes_no_tables_before(self):
        self.trade("--out", str(self.root / "out"), "--snakemake", str(self.flow))
        self.part("next-0")
        with self.assertRaisesRegex(workflow.Wanted, "has not made 1 runs that the tables need"):
            self.sweep("--out", str(self.root / "out"), "--snakemake", str(self.flow), "--part", "tables")
        self.run_stages()
        before = self.count.read_text()
        self.assertEqual(sum(self.run_stages()), 0)
        self.assertEqual(self.count.read_text(), before)

    def test_what_is_no_part_and_no_workflow_is_told(self):
        self.trade("--out", str(self.root / "out"), "--snakemake", str(self.flow))
        for part in ("next", "run-0", "all"):
            with self.subTest(part), self.assertRaisesRegex(trade.CannotRun, "is no part of the workflow"):
                self.part(part)
        for words in (["--part", "next-0"], ["--snakemake", "x", "--budget", "1"]):
            with self.subTest(words), self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()):
                trade.options_of([*self.words, *words])

    @unittest.skipUnless(shutil.which("snakemake"), "no Snakemake")
    def test_snakemake_reads_it(self):
        self.trade("--out", str(self.root / "out"), "--snakemake", str(self.flow))
        done = subprocess.run(["snakemake", "--cores", "1", "--dry-run"], cwd=self.flow, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("checkpoint next_0", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
