"""Meshes of other codes reach a run by the command that docs/meshes.md names, with their names, and by meshio alone with what it keeps.

    python3 tests/drivers/gmsh.py DRIVERS          DRIVERS: the folder with the programs

Ends with 77, "skipped", where Python has no meshio or the programs were built without VTK.
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
DECKS = ROOT / "tests/scripts/decks"
SKIPPED = 77
PATIENCE = 60  # [s]

# What gmsh writes of two cubes of 1000 in a row, in its format 2.2: a physical volume 1, on its end a physical surface 2 called "end", and
# a physical curve 2 called "edge" at the other one.
BAR = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 2 "edge"
2 2 "end"
$EndPhysicalNames
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
4
1 1 2 2 9 3 6
2 3 2 2 7 1 7 10 4
3 5 2 1 1 1 2 5 4 7 8 11 10
4 5 2 1 1 2 3 6 5 8 9 12 11
$EndElements
"""

CASE = """bodies:
  - name: bar
    mesh: {kind: file, path: bar.vtu, scale: 1 mm}
    material: {kind: elastic, density: 1000 kg/m^3, young: 1 MPa, poisson: 0}
planes: [{name: held, kind: fixed, nodes: [bar.end, bar.edge]}]
gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]
time: {end: 10 ms}
"""


# A sheet whose short side is a physical curve with a name, and a block with a set of nodes.
SHEET = """Point(1)={0,0,0}; Point(2)={20,0,0}; Point(3)={20,10,0}; Point(4)={0,10,0};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1,2,3,4}; Plane Surface(1)={1}; Recombine Surface{1};
Mesh.MeshSizeMax=2; Physical Surface("s",1)={1}; Physical Curve("edge",2)={4};
"""
BLOCK = """*HEADING
*NODE
1, 0,0,0
2, 10,0,0
3, 10,10,0
4, 0,10,0
5, 0,0,10
6, 10,0,10
7, 10,10,10
8, 0,10,10
*ELEMENT, TYPE=C3D8R, ELSET=BLOCK
1, 1,2,3,4,5,6,7,8
*NSET, NSET=FOOT
1,2,3,4
*NSET, NSET=SIDE
1,4,5,8
"""

# What the decks of tests/scripts/decks/ have: regions, node sets, and surfaces of solids and of plates.
DECK = """bodies:
  - name: b
    mesh: {kind: file, path: block.vtu, scale: 1 mm}
    material: {kind: elastic, density: 7850 kg/m^3, young: 210 GPa, poisson: 0.3}
    element: {thickness: 1.5 mm}
planes: [{name: held, kind: fixed, nodes: [b.FOOT]}]
loads:
  - {name: push, kind: pressure, surface: b.LOAD, value: 1, unit: Pa}
  - {name: blow, kind: pressure, surface: b.SHEET_top, value: 1, unit: Pa}
  - {name: tug, kind: force, nodes: b.EDGE, value: ["0", "0", "1"], unit: N}
probes:
  - {name: block, quantity: displacement, of: b.BLOCK, component: z}
  - {name: sheet, quantity: displacement, of: b.SHEET, component: z}
time: {end: 10 us}
"""

# The same body flies freely: the sheet of aluminium is pressed from both sides.
FLIES = """bodies:
  - name: b
    mesh: {kind: file, path: block.vtu, scale: 1 mm}
    material: {kind: elastic, density: 7850 kg/m^3, young: 210 GPa, poisson: 0.3}
    materials: [{of: SHEET, material: {kind: elastic, density: 2700 kg/m^3, young: 70 GPa, poisson: 0.3}}]
    element: {thickness: 1.5 mm}
initial: [{body: b, velocity: ["1", "0", "0"], unit: m/s}]
loads:
  - {name: top, kind: pressure, surface: b.SHEET_top, value: 3, unit: kPa}
  - {name: bottom, kind: pressure, surface: b.SHEET_bottom, value: 1, unit: kPa}
probes: [{name: momentum, quantity: momentum, of: b, component: x}]
time: {end: 10 us}
"""
AREA = 3e-4  # [m2] of the sheet, 30 mm by 10 mm across z; its normal is z
MASS = 7850 * 2.5e-6 + 2700 * AREA * 1.5e-3  # [kg]


def case_of(name, held, plate=False, region_array=""):
    """A body out of NAME.vtu that is held at node sets and falls."""
    array = f', region_array: "{region_array}"' if region_array else ""
    element = "\n    element: {thickness: 1 mm}" if plate else ""
    return f"""bodies:
  - name: {name}
    mesh: {{kind: file, path: {name}.vtu, scale: 1 mm{array}}}
    material: {{kind: elastic, density: 7850 kg/m^3, young: 210 GPa, poisson: 0.3}}{element}
planes: [{{name: held, kind: fixed, nodes: [{held}]}}]
gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]
probes: [{{name: weight, quantity: force, of: held, component: z}}]
time: {{end: 10 us}}
"""


def command(name, ending):
    """The words of docs/meshes.md, for a file NAME.ENDING."""
    text = (ROOT / "docs/meshes.md").read_text(encoding="utf-8")
    words = re.search(r"^(scripts/import_mesh) bar.msh bar.vtu$", text, re.M).group(1)
    return [sys.executable, ROOT / words, f"{name}.{ending}", f"{name}.vtu"]


class Gmsh(unittest.TestCase):
    drivers = None  # folder of the programs, from the command line

    def test_comes_through_meshio_and_goes_back(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "bar.msh").write_text(BAR, encoding="utf-8")
            (folder / "case.yaml").write_text(CASE, encoding="utf-8")
            subprocess.run(command("bar", "msh"), cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
            done = subprocess.run([self.drivers / "scene", "case.yaml", "--out", "out"], cwd=folder, capture_output=True, text=True,
                                  timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertRegex(done.stdout, r"12 nodes, 2 elements, mass 2000 kg")
            import meshio
            back = meshio.read(folder / "out/body/body_000000.vtu")
            self.assertEqual([(block.type, len(block.data)) for block in back.cells], [("hexahedron", 2)])
            self.assertEqual(back.points.max(), 2)  # [m]
            done = subprocess.run([sys.executable, ROOT / "scripts/import_mesh", "out/body/body_000000.vtu", "again.vtu"], cwd=folder,
                                  capture_output=True, text=True, timeout=PATIENCE)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertIn("again.vtu: 12 nodes, 2 hexahedra\n", done.stdout)

    def test_decks_of_four_codes_are_one_body(self):
        said = set()
        for deck in ("block.inp", "block.k", "block_0000.rad", "block.msh"):
            with self.subTest(deck), tempfile.TemporaryDirectory() as name:
                folder = Path(name)
                shutil.copy(DECKS / deck, folder / f"block{Path(deck).suffix}")
                subprocess.run(command("block", Path(deck).suffix[1:]), cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
                (folder / "case.yaml").write_text(DECK, encoding="utf-8")
                done = subprocess.run([self.drivers / "scene", "case.yaml", "--dry-run"], cwd=folder, capture_output=True, text=True,
                                      timeout=PATIENCE)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertRegex(done.stdout, r"(?s)\.BLOCK +14 +3 +0\.019625\n.*\.SHEET +8 +6 +0\.0035325\n20 nodes, 9 elements")
                said.add(re.sub(r"forecast.*", "", done.stdout))
                self.check_flight(folder)
        self.assertEqual(len(said), 1)

    def check_flight(self, folder):
        """The sheet has its own material and both its sides."""
        (folder / "case.yaml").write_text(FLIES, encoding="utf-8")
        subprocess.run([self.drivers / "scene", "case.yaml", "--out", "out", "--quiet"], cwd=folder, check=True, capture_output=True,
                       timeout=PATIENCE)
        summary = json.loads((folder / "out/summary.json").read_text(encoding="utf-8"))
        time, accounts = summary["ending"]["time"]["value"], summary["ledger"]["accounts"]
        for name, force in (("top", -3e3 * AREA), ("bottom", 1e3 * AREA)):
            impulse = accounts[name]["impulse"]["value"]
            for got, exact in zip(impulse, (0, 0, force * time)):
                self.assertAlmostEqual(got / (force * time), exact / (force * time), delta=1e-5)
        self.assertAlmostEqual(summary["results"]["momentum_last"]["value"] / MASS, 1, delta=1e-5)

    def run_case(self, folder, case):
        """(exit status, what it said on stderr, whether the nodes that are held carry something)."""
        (folder / "case.yaml").write_text(case, encoding="utf-8")
        done = subprocess.run([self.drivers / "scene", "case.yaml", "--out", "out", "--quiet"], cwd=folder, capture_output=True, text=True,
                              timeout=PATIENCE)
        results = json.loads((folder / "out/summary.json").read_text(encoding="utf-8"))["results"] if done.returncode == 0 else {}
        said = "".join(line for line in done.stderr.splitlines(True) if "hourglass" not in line)  # of one element
        return done.returncode, said, bool(results) and results["weight_last"]["value"] != 0

    @unittest.skipUnless(shutil.which("gmsh"), "there is no gmsh")
    def test_a_curve_of_gmsh_is_a_node_set_with_its_name(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "sheet.geo").write_text(SHEET, encoding="utf-8")
            for version in ("msh22", "msh41"):
                subprocess.run(["gmsh", "-2", "sheet.geo", "-format", version, "-o", "sheet.msh"], cwd=folder, check=True,
                               capture_output=True, timeout=PATIENCE)
                subprocess.run(command("sheet", "msh"), cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
                self.assertEqual(self.run_case(folder, case_of("sheet", "sheet.edge", True)), (0, "", True))
            subprocess.run(["gmsh", "-2", "sheet.geo", "-format", "msh22", "-o", "sheet.msh"], cwd=folder, check=True, capture_output=True)
            subprocess.run([sys.executable, "-c", "import meshio; meshio.read('sheet.msh').write('sheet.vtu')"], cwd=folder, check=True,
                           capture_output=True, timeout=PATIENCE)  # which loses the names
            alone = case_of("sheet", "sheet.lines_2", True, "gmsh:physical")
            self.assertEqual(self.run_case(folder, alone), (0, "", True))

    def test_sets_of_nodes_of_abaqus_are_node_sets(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "block.inp").write_text(BLOCK, encoding="utf-8")
            subprocess.run(command("block", "inp"), cwd=folder, check=True, capture_output=True, timeout=PATIENCE)
            self.assertEqual(self.run_case(folder, case_of("block", "block.FOOT, block.SIDE, block.BLOCK")), (0, "", True))
            subprocess.run([sys.executable, "-c", "import meshio; meshio.read('block.inp').write('block.vtu')"], cwd=folder, check=True,
                           capture_output=True, timeout=PATIENCE)
            status, said, held = self.run_case(folder, case_of("block", "block.FOOT, block.SIDE"))
            self.assertEqual((status, held), (0, True), said)
            self.assertRegex(said, "its point array 'F[A-Z-]*' holds the sets FOOT, SIDE in one")  # the name goes by the version of meshio
            (folder / "block.inp").write_text(BLOCK.partition("*NSET, NSET=SIDE")[0], encoding="utf-8")
            subprocess.run([sys.executable, "-c", "import meshio; meshio.read('block.inp').write('block.vtu')"], cwd=folder, check=True,
                           capture_output=True, timeout=PATIENCE)
            self.assertEqual(self.run_case(folder, case_of("block", "block.FOOT")), (0, "", True))


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
