#!/usr/bin/python3
"""Reads back through VTK itself what grid/grid.cpp wrote.

    read_back.py GRID_TEST_PROGRAM

The program writes its example into a temporary folder; every number is then checked by name and
component; the body by meshio as well, where Python has it.  Ends with 77, "skipped", where Python
has no VTK or the program was built without it.
"""

import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

SKIPPED = 77
OF_FILE = ["TimeValue", "points_are_deformed", "displacement [m]", "velocity [m/s]", "node_id [1]", "stress [Pa]", "von_mises [Pa]"]


def frames(folder, name):
    """Times and files of one collection."""
    sets = xml.parse(os.path.join(folder, name + ".pvd")).getroot().find("Collection")
    return [(float(one.get("timestep")), os.path.join(folder, one.get("file"))) for one in sets]


def read(vtk, file):
    """The data set of one file."""
    volume = file.endswith(".vtu")
    reader = vtk.vtkXMLUnstructuredGridReader() if volume else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    assert reader.GetErrorCode() == 0, file
    return reader.GetOutput()


def check_body(vtk, folder):
    """Six distinct tensor values come back under their own names, and so does the rest."""
    found = frames(folder, "body")
    assert [time for time, _ in found] == [0.0, 1e-3, 2e-3], found
    for time, file in found:
        data = read(vtk, file)
        assert (data.GetNumberOfPoints(), data.GetNumberOfCells()) == (504, 288)
        assert data.GetCellType(0) == vtk.VTK_HEXAHEDRON
        assert data.GetCell(0).GetPointIds().GetId(1) == 1
        assert data.GetFieldData().GetArray("TimeValue").GetValue(0) == time
        whole = data.GetFieldData()
        names = [whole.GetArrayName(i) for i in range(whole.GetNumberOfArrays())]
        assert names == OF_FILE, names

        stress = data.GetCellData().GetArray("stress")
        assert stress.GetDataTypeAsString() == "float"
        expected = {"XX": 11, "YY": 22, "ZZ": 33, "XY": 12, "YZ": 23, "XZ": 13}
        names = [stress.GetComponentName(c) for c in range(6)]
        assert names == ["XX", "YY", "ZZ", "XY", "YZ", "XZ"], names
        for cell in (0, 100, 287):
            for c, component in enumerate(names):
                value = expected[component] * 1e6 * (cell + 1)
                assert abs(stress.GetComponent(cell, c) - value) < 1e-6 * value, (cell, component)

        points = data.GetPointData()
        assert points.GetVectors().GetName() == "displacement"
        displacement = points.GetArray("displacement")
        assert displacement.GetDataTypeAsString() == "double"
        shift = displacement.GetTuple3(503)
        x, y, z = (now - moved for now, moved in zip(data.GetPoint(503), shift))  # at the start
        assert max(abs(a - b) for a, b in zip(shift, (0.0, 0.0, -40 * time * z))) < 1e-15
        speed = points.GetArray("velocity").GetTuple3(503)
        assert max(abs(a + 40 * b) for a, b in zip(speed, (x, y, z))) < 1e-5
        number = points.GetArray("node_id")
        assert number.GetDataTypeAsString() == "int" and number.GetValue(503) == 503


def check_contact(vtk, folder):
    """Cell values stay with their cells: vertices, lines, triangles."""
    for time, file in frames(folder, "contact"):
        data = read(vtk, file)
        kinds = [data.GetCellType(cell) for cell in range(data.GetNumberOfCells())]
        assert kinds == [vtk.VTK_VERTEX] * 4 + [vtk.VTK_LINE] * 4 + [vtk.VTK_TRIANGLE] * 46
        gap = data.GetCellData().GetArray("gap")
        for cell in range(54):
            assert abs(gap.GetValue(cell) - (1e-3 * cell - time)) < 1e-8
            if time > 0:
                assert data.GetCellData().GetArray("contact_status").GetValue(cell) == cell % 3


def check_meshio(folder):
    """meshio reads what we write; says whether it is there."""
    try:
        import meshio
    except ImportError:
        return "without meshio, which Python does not have"
    for _, file in frames(folder, "body"):
        found = meshio.read(file)
        assert [(block.type, len(block.data)) for block in found.cells] == [("hexahedron", 288)], found
        assert found.points.shape == (504, 3) and found.cell_data["stress"][0].shape == (288, 6), found
        assert list(found.field_data) == OF_FILE, found  # it keeps names of arrays, and so units, but no names of components
    return "with meshio too"


def main(program):
    try:
        import vtk
    except ImportError:
        print("Python has no VTK")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "--gtest_filter=Fields.WriteTheExampleThatReadBackReads"],
                       env={**os.environ, "NEREID_READ_BACK": folder}, check=True,
                       stdout=subprocess.DEVNULL)
        if not os.path.exists(os.path.join(folder, "body.pvd")):
            print("built without VTK")
            return SKIPPED
        check_body(vtk, folder)
        check_contact(vtk, folder)
        assert [time for time, _ in frames(folder, "walls")] == [0.0]
        assert read(vtk, frames(folder, "walls")[0][1]).GetNumberOfCells() == 2
        meshio = check_meshio(folder)
    print("read back: body, contact, walls,", meshio)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
