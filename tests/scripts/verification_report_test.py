"""The report is one file that needs nothing else, says what was run, shows every case and its set-up, and hides no miss."""
import importlib.util
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
try:
    import verification_report as report  # needs matplotlib and markdown
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
import numpy as np  # noqa: E402

import runs  # noqa: E402
import verification_figures as figures  # noqa: E402
import verification_setup as setup  # noqa: E402
import verify  # noqa: E402

PROVENANCE = {"version": "1.2.3", "commit": "0123456789abcdef0123-dirty", "compiler": "GNU 12", "flags": "-O3", "build_type": "Release",
              "processor": "made up <x>"}


def outcome(good=True):
    rows = [verify.Row("check", "speed", "1 m/s", "1 m/s", "0.5 %", "1 %", "pass" if good else "FAIL", good, "seen <b>", 0.005, 0.01),
            verify.Row("miss", "rebound", "1", "0.9", "10 %", "1 %", "MISS", True, "wanted; misses: too coarse", 0.1, 0.01)]
    one = verify.Figure("speed", "time [s]", "speed [m/s]", None)
    curves = verify.Curves([("Nereid", [0, 1, 2], [0, 1.1, 2])], [("exact", [0, 1, 2], [0, 1, 2])], [])
    return verify.Outcome("two_blocks", "quick", "scene", "case.yaml", "it moves at $c = \\sqrt{E/\\rho}$", "exact", ["I-3"], rows=rows,
                          figures=[("speed", "Speed.", figures.case_figure(one, curves))], runs=1, seconds=2.0)


def written(*outcomes, asked=("two_blocks", "taylor_bar")):
    with tempfile.TemporaryDirectory() as folder:
        for out in outcomes:
            out.save(Path(folder) / "quick")
        return report.write(Path(folder), "quick", ["two_blocks", "taylor_bar", "rolling"], asked).read_text(encoding="utf-8")


class ReportTest(unittest.TestCase):
    def test_it_refers_to_nothing_outside(self):
        text = written(outcome())
        for address in re.findall(r"(?:src|href)=['\"]([^'\"]*)", text):
            self.assertTrue(address.startswith(("#", "data:")), address)

    def test_every_address_inside_leads_to_a_page(self):
        text = written(outcome())
        for name in re.findall(r"href='#(\w+)'", text):
            self.assertTrue(f"id='{name}'" in text, name)

    def test_a_case_that_has_not_run_is_named(self):
        self.assertTrue("<p class='FAIL'>Not run: taylor_bar.</p>" in written(outcome()))

    def test_cases_that_nobody_asked_for_stand_in_one_grey_line(self):
        text = written(outcome(), asked=["two_blocks"])
        self.assertTrue("<p class='quiet'>Without results at this level, since no command asked for them: taylor_bar, rolling.</p>" in text)
        self.assertFalse("Not run" in text)

    def test_a_failure_and_a_miss_are_in_the_overview(self):
        self.assertTrue("1 MISS" in written(outcome()))
        self.assertTrue("1 fail" in written(outcome(good=False)))

    def test_formulas_become_pictures_and_text_is_no_markup(self):
        text = written(outcome())
        self.assertTrue("alt='c = \\sqrt{E/\\rho}'" in text)
        self.assertFalse("seen <b>." in text)

    def test_the_error_panel_holds_result_less_exact_over_the_largest_exact(self):
        curves = verify.Curves([("Nereid", [0, 1, 2], [0, 1.1, 2])], [("exact", [0, 2], [0, 2])], [])
        ((number, across, error),) = figures.errors_of(curves.results, curves.exact)
        self.assertEqual((number, list(across)), (0, [0, 1, 2]))
        self.assertAlmostEqual(error[1], 5.0)


# ------------------------------------------------------------------------------------------------
# What was run

def said(value, unit=None):
    return {"value": value, "unit": unit, "default": False}


def body(name, low):
    return {"name": said(name), "mesh": {"kind": said("box"), "low": said(low, "m")}, "move": said([0.0, 0.0, 0.0], "m"),
            "material": {"kind": said("elastic"), "young": said(2.1e11, "Pa")}}


def summary(driver="scene"):
    return {"driver": driver, "ending": {"word": "reached_end", "reason": "", "time": {"value": 0.002, "unit": "s"}},
            "ledger": {"accounts": {}}, "results": {}, "cost": {"elements": 2, "steps": 1234, "threads": 1},
            "provenance": {**PROVENANCE, "resolved": {
                "bodies": [body("left", [0.0] * 3), body("right", [1.0, 0.0, 0.0])],
                "contacts": [{"name": said("touch"), "friction": said(0.3, "1")}],
                "planes": [{"name": said("hold"), "kind": said("fixed"), "nodes": said(["left.x_low"])},
                           {"name": said("pin"), "kind": said("symmetry"), "nodes": said(["left.skin"])}]}}}


def kept(folder, name, found):
    """A kept run with this summary, as the suite leaves it."""
    (folder / "runs" / name).mkdir(parents=True)
    (folder / "runs" / name / "summary.json").write_text(json.dumps(found), encoding="utf-8")
    record = {"settings": {"contacts[0].friction": "<0.3>"}, "inputs": {}, "files": {}, "seconds": 9.0, "processor_seconds": 2.5}
    runs.write_record(folder / "runs" / name, record)
    return folder / "runs" / name


def cubes(run):
    """Writes the first frame of a run: two cubes beside each other, of which the second moves; and a wall below them."""
    import vtk
    grid, points, speeds, bodies = vtk.vtkUnstructuredGrid(), vtk.vtkPoints(), vtk.vtkDoubleArray(), vtk.vtkIntArray()
    speeds.SetName("velocity"), speeds.SetNumberOfComponents(3), bodies.SetName("body")
    for number, (name, low) in enumerate((("left", 0.0), ("right", 1.0))):
        cell = [points.InsertNextPoint(low + x, y, z) for x, y, z in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                                                                      (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]
        grid.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, cell)
        bodies.InsertNextValue(number)
        for _ in cell:
            speeds.InsertNextTuple3(0, 0, 7.0 * number)
        named = vtk.vtkIntArray()
        named.SetName(name), named.InsertNextValue(number), named.InsertNextValue(3)
        grid.GetFieldData().AddArray(named)
    grid.SetPoints(points), grid.GetPointData().AddArray(speeds), grid.GetCellData().AddArray(bodies)
    plane = vtk.vtkPlaneSource()
    plane.SetOrigin(-1, -1, 0), plane.SetPoint1(3, -1, 0), plane.SetPoint2(-1, 2, 0)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(plane.GetOutputPort())
    triangles.Update()
    walls, number = triangles.GetOutput(), vtk.vtkIntArray()
    number.SetName("wall_id")
    for _ in range(walls.GetNumberOfCells()):
        number.InsertNextValue(0)
    walls.GetCellData().AddArray(number)
    for name, data, writer in (("body", grid, vtk.vtkXMLUnstructuredGridWriter()), ("walls", walls, vtk.vtkXMLPolyDataWriter())):
        file = f"{name}.{writer.GetDefaultFileExtension()}"
        writer.SetFileName(str(run / file)), writer.SetInputData(data), writer.Write()
        listed = f"<DataSet timestep='0' file='{file}'/>"
        (run / f"{name}.pvd").write_text(f"<VTKFile type='Collection'><Collection>{listed}</Collection></VTKFile>")


class WhatWasRunTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def assertIn(self, part, whole):
        self.assertTrue(part in whole, part)  # without a page of a megabyte

    def page(self, *outcomes):
        for out in outcomes:
            out.save(self.folder / "quick")
        names = [out.name for out in outcomes]
        return report.write(self.folder, "quick", names, names).read_text(encoding="utf-8")

    def out(self, *folders, **more):
        out = outcome()
        out.provenance, out.folders, out.runs, out.made = PROVENANCE, list(folders), len(folders), 1
        for key, value in more.items():
            setattr(out, key, value)
        return out

    def test_the_first_block_says_what_was_run(self):
        kept(self.folder, "scene_0", summary()), kept(self.folder, "scene_1", summary())
        out = self.out("scene_0", "scene_1", left_out=[["breaks", "a <mistake>"], ["check", "long"], ["breaks", "another"]])
        out.rows[0].evidence = "invariant"
        out.rows.append(verify.Row("check", "mass", "1", "1", "0", "1 %", "pass", True, "", 0.0, 0.01, evidence="exact"))
        text = self.page(out)
        block = text[text.index("What was run"):text.index("</table>")]
        for part in ("quick", "2: invariant 1, exact 1", "version 1.2.3, commit 0123456789ab, with changes that are not committed",
                     "GNU 12, -O3, Release", "2 runs, 1 of them new", "processor time 5 s", "made up &lt;x&gt;", "1 check, 2 breaks",
                     "none: every check passes"):
            self.assertIn(part, block)
        self.assertLess(text.index("What was run"), text.index("closest check"))
        self.assertIn("a &lt;mistake&gt;", text)

    def test_a_case_says_what_was_run_before_its_results(self):
        kept(self.folder, "scene_0", summary())
        text = self.page(self.out("scene_0", "scene_0"))
        page = text[text.index("id='two_blocks'"):]
        block = page[page.index("What was run"):page.index("<h3>Results</h3>")]
        for part in ("Program <code>scene</code>", "<code>contacts[0].friction=&lt;0.3&gt;</code>", "1,234 steps", "young 210 GPa", "touch",
                     "kind fixed", "no picture of the set-up: the run has no frames"):
            self.assertIn(part, block)
        places = re.findall(r"id='([^']*)'", text)
        self.assertEqual(len(places), len(set(places)))

    def test_a_case_that_failed_before_any_run_has_a_page(self):
        failed = verify.Outcome("two_blocks", "quick", rows=[verify.fault_row("the case", verify.CannotRun("no <program>"))])
        text = self.page(failed)
        self.assertIn("No run was finished", text)
        self.assertIn("unknown: no run was finished", text)
        self.assertIn("1 fail", text)

    def test_a_run_that_is_not_kept_is_said_to_be_gone(self):
        self.assertIn("The run scene_0 is no longer kept", self.page(self.out("scene_0")))

    def test_a_program_without_bodies_has_a_sentence_in_place_of_the_picture(self):
        found = summary("material_point")
        found["provenance"]["resolved"] = {"kind": said("solid"), "material": {"young": said(2.1e11, "Pa")}}
        kept(self.folder, "material_point_0", found)
        text = self.page(self.out("material_point_0"))
        self.assertIn("one point of a material, which has no shape", text)
        self.assertIn("young 210 GPa", text)

    def shot(self):
        if importlib.util.find_spec("vtk") is None:
            self.skipTest("this Python has no VTK")
        folder = kept(self.folder, "scene_0", summary())
        cubes(folder)
        run = setup.BaseRun(folder, "two_blocks", "two_blocks")
        return run, setup.first_shot(run)

    def test_the_picture_has_each_body_its_wall_and_its_velocity(self):
        run, one = self.shot()
        moves = setup.moving_bodies(one)
        ((place, speed),) = moves
        self.assertEqual((list(place), list(speed)), ([1.5, 0.5, 0.5], [0, 0, 7]))
        camera = setup.camera_of(one, moves)
        svg = setup.svg_of(one, camera, moves)
        for number in (0, 1):
            red, green, blue = setup.colour_of(number)
            shades = re.findall(r"fill='#(\w\w)(\w\w)(\w\w)' stroke='#404040'", svg)
            of_body = [found for found in shades if abs(int(found[0], 16) * green - int(found[1], 16) * red) < 2
                       and abs(int(found[1], 16) * blue - int(found[2], 16) * green) < 2]
            self.assertEqual(len(of_body), 3, svg)  # faces of a cube that a camera sees
        self.assertIn(setup.rgb(setup.pictures.WALL), svg)
        self.assertIn("#b00020", svg)
        text = setup.drawing(run, one)
        for part in ("left:</span> 8 nodes, 1 hexahedron", "right:</span> 8 nodes, 1 hexahedron", "Nodes fixed (hold)",
                     "Supports without a mark: left.skin", "the longest <span title='7.0 m/s'>7&nbsp;m/s</span>"):
            self.assertIn(part, text)

    def test_what_is_nearer_is_drawn_later(self):
        _, one = self.shot()
        camera = setup.camera_of(one, [])
        depth = [np.mean(facet @ camera.towards) for number in (0, 1) for facet in setup.skin(one, number)[0]]
        self.assertEqual(len(depth), 12)
        page = setup.Page(camera)
        self.assertEqual(len(setup.facets_of(one, page)), 6)
        corners = np.array([[0.0, 0, 0], [4, 0, 0], [4, 2, 0], [0, 2, 0]])
        cut = setup.pieces(corners, 1.0)
        self.assertEqual((len(cut), sum(sum(edges) for _, edges in cut)), (8, 12))
        self.assertEqual(len(setup.pieces(corners[:3], 9.0)), 1)

    def test_nodes_of_a_support_are_known_by_its_name(self):
        places = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0, 2.0)])
        found = body("bar", [0.0] * 3)
        self.assertEqual(len(setup.nodes_of(places, "", found)), 12)
        self.assertTrue(np.all(setup.nodes_of(places, "z_high", found)[:, 2] == 2))
        self.assertIsNone(setup.nodes_of(places, "skin", found))
        tip = {**found, "points": [{"name": said("tip"), "near": said([1.1, 1.0, 2.0], "m")}]}
        self.assertEqual(setup.nodes_of(places, "tip", tip).tolist(), [[1, 1, 2]])
        bent = {**found, "mesh": {**found["mesh"], "map": said(["x", "y", "z"])}}
        self.assertIsNone(setup.nodes_of(places, "z_high", bent))


if __name__ == "__main__":
    unittest.main()
