"""What figures take from the files that ParaView reads: contact elements, and a mesh in elevation."""
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np

from runs import DEFORMED

ROUND_OFF = 1e-12  # [-] of a size: what points at the start are off by


class CannotRead(Exception):
    """There is nothing to draw from; says why."""


def listed(folder, name):
    """[(time [s], file)] of the frames of a data set; none if it is not there."""
    index = Path(folder) / f"{name}.pvd"
    try:
        return [(float(one.get("timestep")), Path(folder) / one.get("file")) for one in xml.parse(index).getroot().iter("DataSet")]
    except FileNotFoundError:
        return []
    except OSError as error:
        raise CannotRead(f"{index}: {error.strerror}") from error
    except (xml.ParseError, TypeError, ValueError) as error:
        raise CannotRead(f"{index} is no collection of ParaView") from error


def frames_of(folder, name):
    """(time [s], file) of each frame of a data set, of which there must be one."""
    found, index = listed(folder, name), Path(folder) / f"{name}.pvd"
    if not found:
        raise CannotRead(f"{index}: no frames; was the driver built without VTK?" if index.exists() else f"{index} is not there")
    return found


def load(file):
    """The data set of one file."""
    try:
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
    except ImportError as error:
        raise CannotRead("this Python has no VTK (Debian's python3-vtk9)") from error
    reader = vtkXMLPolyDataReader() if Path(file).suffix == ".vtp" else vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def positions(data):
    """Where the points of a frame were at the start and where they are now, [points x 3] in m.

    Points of the file are the positions now if it has `points_are_deformed`; those of older files are the positions at the start.
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy
    points, moved = vtk_to_numpy(data.GetPoints().GetData()), data.GetPointData().GetArray("displacement")
    displacement = vtk_to_numpy(moved) if moved is not None else np.zeros_like(points)
    if is_deformed(data):
        return points - displacement, points
    return points, points + displacement


def is_deformed(data):
    """Whether the points of a frame stand where they are at its time; those of older files stand where they were at the start."""
    return data.GetFieldData().GetArray(DEFORMED) is not None


def unit_of(data, field):
    """The unit of a field, from the name "stress [Pa]" of an array of the whole file, or of a component of its array `units`."""
    whole = data.GetFieldData()
    units = whole.GetArray("units")
    names = [whole.GetArrayName(i) or "" for i in range(whole.GetNumberOfArrays())]
    names += [units.GetComponentName(i) for i in range(units.GetNumberOfComponents())] if units is not None else []
    return next((unit.rstrip("]") for name, _, unit in (one.partition(" [") for one in names) if name == field and unit), "")


def bodies(data):
    """The number of the body of each cell of a frame, and {number: name}; no names if the frame has none.

    A name is that of an array of the whole file with two numbers: that of the body, and 3 of solids or 2 of plates.
    """
    if data.GetCellData().GetArray("body") is None:
        part = data.GetCellData().GetArray("part_id")
        return array(data, "part_id").astype(int) if part is not None else np.zeros(data.GetNumberOfCells(), int), {}
    whole = data.GetFieldData()
    arrays = [whole.GetArray(i) for i in range(whole.GetNumberOfArrays())]
    names = {int(one.GetValue(0)): one.GetName() for one in arrays if one is not None and one.GetNumberOfValues() == 2
             and one.GetNumberOfComponents() == 1 and one.GetDataTypeAsString() == "int"}
    return array(data, "body").astype(int), names


def name_of(number, names):
    """The name of a body; that of a body of a frame without names is its number.

    >>> name_of(1, {0: "bar"}), name_of(0, {0: "bar"})
    ('1', 'bar')
    """
    return names.get(int(number), str(int(number)))


def read(file):
    """The data set of one file and its points at the start [m] and now [mm]."""
    data = load(file)
    start, now = positions(data)
    return data, start, 1e3 * now


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
    in_front = np.abs(start[:, 1]) < ROUND_OFF * np.ptp(start[:, 1])
    hexahedron, triangle = 12, 5  # as VTK numbers kinds of cells
    skin, section, plates = [], [], set()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        nodes = [cell.GetPointId(a) for a in range(cell.GetNumberOfPoints())]
        if cell.GetCellType() == triangle:
            skin.append([(-x[n, 0], x[n, 2]) for n in nodes])
            plates.update(n for n in nodes if in_front[n])
        elif cell.GetCellType() == hexahedron:
            for side in SIDES:
                corners = [nodes[a] for a in side]
                if all(in_front[n] for n in corners):
                    section.append([(x[n, 0], x[n, 2]) for n in corners])
    line = [(x[n, 0], x[n, 2]) for n in sorted(plates, key=lambda n: start[n, 2])]
    return title, skin, section, line
