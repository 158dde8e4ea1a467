"""What scripts read of a run: a damaged history, summary or collection of frames is told with its place."""
import doctest
import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
try:
    import frames  # needs numpy
    import run_curves
    import run_files
except ImportError:
    sys.exit(77)
from made_up import script  # noqa: E402  (after the path)

HEADS = "time [s],force [N] mean,energy_kinetic [J]\n"


class RunFiles(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def write(self, name, text):
        (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        return self.folder / name

    def test_a_history_has_a_number_for_each_column_in_each_row(self):
        path = self.write("history.csv", HEADS + "0,1,2\n0.1,-3,nan\n")
        columns, units = run_files.read_history(self.folder)
        self.assertEqual((columns["force"].tolist(), units), ([1.0, -3.0], {"time": "s", "force": "N", "energy_kinetic": "J"}))
        self.assertEqual(script("cfc").read(path)["force"][1:], ("N", True))
        for rows, says in (("0,1,2\n7\n", r"history.csv:3: 1 numbers, expected are 3"), ("0,1,2,3\n", r":2: 4 numbers, expected are 3"),
                           ("0,1,x\n", r":2: 3 numbers expected"), ("", "holds no rows yet"), (b"0,1,\xff\n", "is no text in UTF-8")):
            self.write("history.csv", HEADS.encode() + (rows if isinstance(rows, bytes) else rows.encode()))
            for read in (lambda: run_files.read_history(self.folder), lambda: script("cfc").read(path)):
                with self.subTest(rows=rows), self.assertRaisesRegex(run_files.Unreadable, says):
                    read()

    def test_a_summary_is_an_object_with_what_a_figure_draws(self):
        self.write("history.csv", HEADS + "0,1,2\n")
        for text, says in (("[1]", "expected is an object"), ("{", "summary.json:1: "), (b"\xff", "is no text in UTF-8"),
                           ("{}", "summary.json: has no 'ledger'"), (json.dumps({"ledger": {}}), "has no 'ledger.initial_kinetic'"),
                           (json.dumps({"ledger": {"initial_kinetic": 1}}), "has no 'ledger.initial_kinetic.value'")):
            self.write("summary.json", text)
            with self.subTest(text=text), self.assertRaisesRegex(run_files.Unreadable, says):
                run_curves.energies(self.folder)
        self.write("history.csv", "time [s],settlement_mean [m],settlement_centre [m]\n0,1,2\n")
        self.write("summary.json", json.dumps({"results": {}}))
        with self.assertRaisesRegex(run_files.Unreadable, "has no 'results.settlement_mean'"):
            run_curves.settlements([self.folder])

    def test_a_collection_of_frames_may_be_missing_and_not_damaged(self):
        self.assertEqual(frames.listed(self.folder, "body"), [])
        with self.assertRaisesRegex(frames.CannotRead, "body.pvd is not there"):
            frames.frames_of(self.folder, "body")
        for text in ("<VTKFile><Coll", '<VTKFile><DataSet timestep="x" file="0.vtu"/></VTKFile>',
                     '<VTKFile><DataSet timestep="0"/></VTKFile>'):
            self.write("body.pvd", text)
            with self.subTest(text=text), self.assertRaisesRegex(frames.CannotRead, "body.pvd is no collection of ParaView"):
                frames.frames_of(self.folder, "body")
        self.write("body.pvd", "<VTKFile/>")
        with self.assertRaisesRegex(frames.CannotRead, "no frames"):
            frames.frames_of(self.folder, "body")

    def test_examples_of_the_module(self):
        done = doctest.testmod(frames)
        self.assertEqual((done.failed, done.attempted > 0), (0, True))


if __name__ == "__main__":
    unittest.main()
