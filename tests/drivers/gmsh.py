"""A mesh of gmsh reaches a run by the command that docs/meshes.md names.

    python3 tests/drivers/gmsh.py DRIVERS          DRIVERS: the folder with the programs

Ends with 77, "skipped", where Python has no meshio or the programs were built without VTK.
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77
PATIENCE = 60  # [s]

# What gmsh writes of two cubes of 1000 in a row, in its format 2.2: a physical volume 1, and on its end a physical surface 2.
BAR = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
12
1 0 0 0
2 1000 0 0
3 2000 0 0
4 0 1000 0
5 1000 1000 0
6 2000 1000 0
7 0 0 1000
8 1000 0 1000
9 2000 0 1000
10 0 1000 1000
11 1000 1000 1000
12 2000 1000 1000
$EndNodes
$Elements
3
1 3 2 2 7 1 7 10 4
2 5 2 1 1 1 2 5 4 7 8 11 10
3 5 2 1 1 2 3 6 5 8 9 12 11
$EndElements
"""

CASE = """bodies:
  - name: bar
    mesh: {kind: file, path: bar.vtu, region_array: "gmsh:physical", scale: 1 mm}
    material: {kind: elastic, density: 1000 kg/m^3, young: 1 MPa, poisson: 0}
planes: [{name: held, kind: fixed, nodes: [bar.boundary_2]}]
gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]
time: {end: 10 ms}
"""


def command():
    """The words of docs/meshes.md."""
    text = (ROOT / "docs/meshes.md").read_text(encoding="utf-8")
    return re.search(r'^python3 -c "(import meshio; .*)"$', text, re.M).group(1)


class Gmsh(unittest.TestCase):
    drivers = None  # folder of the programs, from the command line

    def test_comes_through_meshio_and_goes_back(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "bar.msh").write_text(BAR, encoding="utf-8")
            (folder / "case.yaml").write_text(CASE, encoding="utf-8")
            subprocess.run([sys.executable, "-c", command()], cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
            done = subprocess.run([self.drivers / "scene", "case.yaml", "--out", "out"], cwd=folder, capture_output=True, text=True,
                                  timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertRegex(done.stdout, r"12 nodes, 2 elements, mass 2000 kg")
            import meshio
            back = meshio.read(folder / "out/body/body_000000.vtu")
            self.assertEqual([(block.type, len(block.data)) for block in back.cells], [("hexahedron", 2)])
            self.assertEqual(back.points.max(), 2)  # [m]


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    Gmsh.drivers = Path(sys.argv.pop(1)).resolve()
    try:
        import meshio  # noqa: F401
    except ImportError:
        print("Python has no meshio")
        sys.exit(SKIPPED)
    unittest.main()
