"""ParaView beside our packages: its installation by docs/results.md removes none of them, and scripts/paraview_run.py reads frames."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import paraview_run  # noqa: E402  (after the path)

ARRAY = '<DataArray type="{}" Name="{}" {}format="ascii">{}</DataArray>'
TODAY = (ARRAY.format("Int32", "points_are_deformed", "", 1) + ARRAY.format("Float32", "von_mises_top [Pa]", "", 1)
         + ARRAY.format("Int32", "plate", 'NumberOfTuples="2" ', "7 2"))
OLDER = ARRAY.format("Float32", "units", 'NumberOfComponents="1" ComponentName0="von_mises_top [Pa]" ', 1)
FRAME = ('<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid><FieldData>{}</FieldData>'
         '<Piece NumberOfPoints="3" NumberOfCells="1"><PointData></PointData><CellData>'
         + ARRAY.format("Int32", "{}", "", 7) + ARRAY.format("Float32", "von_mises_top", "", 5) + "</CellData><Points>"
         + ARRAY.format("Float64", "points", 'NumberOfComponents="3" ', "0 0 0 1 0 0 0 1 0") + "</Points><Cells>"
         + ARRAY.format("Int32", "connectivity", "", "0 1 2") + ARRAY.format("Int32", "offsets", "", 3)
         + ARRAY.format("UInt8", "types", "", 5) + "</Cells></Piece></UnstructuredGrid></VTKFile>")


class Installation(unittest.TestCase):
    def test_removes_no_package(self):
        if shutil.which("apt-get") is None:
            self.skipTest("needs apt-get")
        words = ["apt-get", "install", "--no-install-recommends", "paraview"]
        page = (ROOT / "docs/results.md").read_text(encoding="utf-8")
        self.assertIn(" ".join(words), page)
        done = subprocess.run([*words, "--simulate"], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
        if done.returncode != 0:
            self.skipTest(f"no list of packages has ParaView: {' '.join(done.stderr.split())}")
        self.assertEqual(re.findall(r"^Remv (\S+)", done.stdout, re.M), [])
        self.assertRegex(done.stdout, r"\b0 to remove\b")


class Frames(unittest.TestCase):
    def frame(self, whole, of_body):
        import frames
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "a.vtu"
            path.write_text(FRAME.format(whole, of_body), encoding="utf-8")
            return paraview_run.Frame(frames.load(path))

    def test_say_bodies_units_and_whether_points_are_deformed(self):
        try:
            import vtkmodules  # noqa: F401
        except ImportError:
            self.skipTest("needs python3-vtk9")
        for whole, of_body, bodies, deformed in ((TODAY, "body", [("plate", 7, paraview_run.PLATES)], True),
                                                 (OLDER, "part_id", [("7", 7, paraview_run.PLATES)], False)):
            with self.subTest(of_body):
                frame = self.frame(whole, of_body)
                self.assertEqual((frame.bodies, frame.of_body, frame.deformed), (bodies, of_body, deformed))
                self.assertEqual(frame.units, {"von_mises_top": "Pa"})


if __name__ == "__main__":
    unittest.main()
