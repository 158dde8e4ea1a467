"""What figures take from the files that ParaView reads: contact elements, and a mesh in elevation."""
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np


class CannotRead(Exception):
    """There is nothing to draw from; says why."""


def frames_of(folder, name):
    """(time [s], file) of each frame of a data set."""
    index = Path(folder) / f"{name}.pvd"
    try:
        sets = xml.parse(index).getroot().iter("DataSet")
        found = [(float(one.get("timestep")), Path(folder) / one.get("file")) for one in sets]
    except OSError as error:
        raise CannotRead(f"{index}: {error.strerror}") from error
    if not found:
        raise CannotRead(f"{index}: no frames; was the driver built without VTK?")
    return found


def read(file):
    """The data set of one file and its points as they stand, [points x 3] in mm."""
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
    except ImportError as error:
        raise CannotRead("this Python has no VTK (Debian's python3-vtk9)") from error
    reader = vtkXMLPolyDataReader() if Path(file).suffix == ".vtp" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    start = vtk_to_numpy(data.GetPoints().GetData())
    return data, start, 1e3 * (start + vtk_to_numpy(data.GetPointData().GetArray("displacement")))


def array(data, name):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return vtk_to_numpy(data.GetCellData().GetArray(name))


FACET = 3  # as the files number the kinds of features


def lowest_element(folder):
    """The lowest contact element over a facet in the last frame, with time [ms], apex number and positions [mm].

    The files hold five points for each potential element: foot, apex, and the corners of the facet.
    """
    at, file = frames_of(folder, "contact")[-1]
    data, _, x = read(file)
    count = data.GetNumberOfCells() // 2
    gap = array(data, "gap")[:count]
    over = [e for e in range(count) if array(data, "kind")[e] == FACET]
    if not over:
        raise CannotRead(f"{file}: no apex over a facet")
    element = min(over, key=lambda e: gap[e])
    foot, apex, *corners = x[5 * element:5 * element + 5]
    return {"time": 1e3 * at, "node": int(array(data, "apex_node")[element]), "facet": int(array(data, "base_id")[element]),
            "gap": 1e3 * gap[element], "foot": foot, "apex": apex, "corners": np.array(corners)}


SIDES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]  # of a hexahedron, from outside


def skins(folder):
    """The outer faces of each body of hexahedra in the last frame: {part: [faces x 4 x 3]} in mm."""
    _, file = frames_of(folder, "body")[-1]
    data, _, x = read(file)
    part = array(data, "part_id")
    sides = {}
    for c in range(data.GetNumberOfCells()):
        nodes = [data.GetCell(c).GetPointId(a) for a in range(8)]
        for side in SIDES:
            face = tuple(nodes[a] for a in side)
            sides.setdefault((int(part[c]), frozenset(face)), []).append(face)
    found = {}
    for (body, _), faces in sides.items():
        if len(faces) == 1:
            found.setdefault(body, []).append(x[list(faces[0])])
    return {body: np.array(faces) for body, faces in found.items()}


def elevation(file, title):
    """Polygons of a quarter model in elevation; the other quarters are its mirror images."""
    grid, start, x = read(file)
    hexahedron, triangle = 12, 5  # as VTK numbers kinds of cells
    skin, section, plates = [], [], set()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        nodes = [cell.GetPointId(a) for a in range(cell.GetNumberOfPoints())]
        if cell.GetCellType() == triangle:
            skin.append([(-x[n, 0], x[n, 2]) for n in nodes])
            plates.update(n for n in nodes if start[n, 1] == 0)
        elif cell.GetCellType() == hexahedron:
            for side in SIDES:
                corners = [nodes[a] for a in side]
                if all(start[n, 1] == 0 for n in corners):
                    section.append([(x[n, 0], x[n, 2]) for n in corners])
    line = [(x[n, 0], x[n, 2]) for n in sorted(plates, key=lambda n: start[n, 2])]
    return title, skin, section, line
