#!/usr/bin/python3
"""Draws one moment of a run, or every frame: body.pvd, contact.pvd and walls.pvd of an output folder, as PNG.

    scripts/view.py out/cask_drop --field von_mises --time 4.3e-3 --cut --out cask.png
    scripts/view.py out/cask_drop --cut --frames out/cask_drop/frames     # frame_0000.png, frame_0001.png ...
    scripts/view.py out/balls --field body --hide lower --cut ball         # bodies by their names in the case

The picture is filled by the bodies that are shown. Frames have one camera and one range of colours: that of all frames together, unless
--range gives it. Needs Debian's python3-vtk9 and, where there is no screen, xvfb; ParaView is not needed. Bodies stand where they are at
the time of the frame. Contact elements that act are coloured by status, or by a field of their own; open ones, which frames have by
`output: {fields: all}`, are thin grey lines and are drawn by --open only. Of bodies that are hidden no contact is drawn, unless the other
body is shown. Bodies of frames that are older than their names have the numbers 0, 1 ... as names. The view is that of an upright
cylinder: z is up.
"""

import argparse
import colorsys
import sys
import xml.etree.ElementTree as xml
from math import cos, radians, sin

import command_line
import frames
import runs
import screen

STATUS = [("unpaired", (0.75, 0.55, 0.10)), ("open", (0.55, 0.55, 0.55)), ("closed", (0.85, 0.10, 0.10))]
STATUS_WORDS = [word for word, _ in STATUS]
UPPER = 0.50, 0.40  # bottom and height of the bar of bodies, of the picture
CLOSED = 1  # status of an element that acts
DATA_SETS = ("body", "contact", "walls")
PREFERRED = {"body": ("von_mises", "von_mises_top", "displacement"), "contact": ("contact_status", "gap")}
GOLDEN = 0.618  # of a turn of the hue: no two of some bodies are near
MOST_PIXELS = 16384  # of a picture, either way
DARK = (0.1, 0.1, 0.1)
VIEW_ANGLE = 12  # [degrees] from far away: parallel edges look parallel
FREE = (-0.95, 0.95), (-0.93, 0.87)  # of the picture, from -1 to 1 each way: below the time; right of it are the bars
MOST_ROOM = 0.6  # of the width of the picture, for bars
TITLE, LABEL = 22, 20  # [pixels] letters of bars
BAR, BESIDE, MARGIN = 34, 14, 24  # [pixels] width of a bar, between it and its words, and to the border and the bodies
WIDEST_NUMBER = "-4.44e+07"
OUTLINE = 64  # directions in which the points that bound a picture are sought


def arguments():
    parser = command_line.Parser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folder", type=command_line.folder_to_read, help="where body.pvd and contact.pvd stand")
    add("--field", help="what colours the bodies (default: von_mises, of plates von_mises_top, else displacement); 'body': each its own")
    add("--component", help="its component, such as ZZ (default: the magnitude of a vector)")
    add("--contact-field", help="what colours contact (default: contact_status, else gap)")
    add("--time", type=command_line.finite, help="[s]; the nearest frame is drawn (default: the last)")
    add("--out", type=command_line.file_to_write, help="PNG to write (default: view.png in the folder)")
    add("--frames", type=command_line.folder_to_write, metavar="DIR", help="write every frame into this folder, for an animation")
    add("--cut", nargs="*", metavar="BODY", help="take away the half y < 0, to look inside; of these bodies (default: of all)")
    add("--cut-at", type=command_line.finite, default=0.0, metavar="Y", help="[m]; where the cut is (default: 0)")
    shown = parser.add_mutually_exclusive_group()
    shown.add_argument("--hide", nargs="+", default=[], metavar="BODY", help="bodies that are not drawn")
    shown.add_argument("--only", nargs="+", default=[], metavar="BODY", help="bodies that are drawn, and no other ones")
    add("--open", action="store_true", help="draw contact elements that are open, too")
    add("--show", type=data_sets, default="body,contact,walls", help="which data sets, with commas between")
    add("--warp", type=command_line.finite, default=1.0, help="factor on the displacement (default: 1, the deformed shape)")
    add("--range", type=command_line.finite, nargs=2, metavar=("LOW", "HIGH"), help="of the body's colours")
    add("--opacity", type=part, default=1.0, help="of the body")
    add("--edges", action="store_true", help="draw the edges of the body's elements")
    add("--elevation", type=command_line.finite, default=12.0, help="[degrees] of the eye above ground")
    add("--azimuth", type=command_line.finite, default=0.0, help="[degrees] of the eye about z, from -y")
    add("--size", type=pixels, nargs=2, default=(1400, 1000), metavar=("WIDTH", "HEIGHT"))
    asked = parser.parse_args()
    if asked.range and not asked.range[0] < asked.range[1]:
        parser.error("argument --range: LOW is not below HIGH")
    if asked.frames and (asked.out or asked.time is not None):
        parser.error("argument --frames: draws every frame; leave --time and --out away")
    asked.out = asked.out or asked.folder / "view.png"
    asked.contact_range, asked.room = None, 0.0
    check_names(asked)
    command_line.need_writable(asked.frames or asked.out.parent)
    return asked


def data_sets(text):
    found = text.split(",")
    for name in found:
        if name not in DATA_SETS:
            raise argparse.ArgumentTypeError(f"'{name}' is no data set: expected are some of {','.join(DATA_SETS)}")
    return found


def part(text):
    found = command_line.number(text)
    if not 0 <= found <= 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no number from 0 to 1")
    return found


def pixels(text):
    found = command_line.count(text)
    if found > MOST_PIXELS:
        raise argparse.ArgumentTypeError(f"'{text}' is too many: expected are {MOST_PIXELS} pixels at most")
    return found


def check_names(asked):
    """Refuses a folder with nothing to draw, and a field or component that its files do not have, before there is a screen."""
    drawn = [name for name in asked.show if chosen_file(asked.folder, name, asked.time)[1]]
    if not drawn:
        wanted = " or ".join(f"{name}.pvd" for name in asked.show)
        command_line.refuse(f"nothing to draw in {asked.folder}: there is no {wanted} with a frame")
    for name, field, component in (("body", asked.field, asked.component), ("contact", asked.contact_field, None)):
        if name not in drawn or not (field or component):
            continue
        there = fields_of(chosen_file(asked.folder, name, asked.time)[1])
        if "part_id" in there:
            there.setdefault("body", there["part_id"])  # of older frames
        if field and field not in there:
            command_line.refuse(command_line.unknown("field", field, there))
        field = field or next((one for one in PREFERRED[name] if one in there), None)
        components = there.get(field, [])
        if component and len(components) > 1 and component not in components:
            command_line.refuse(f"'{field}' has the components {', '.join(components)}")
        if not component and len(components) not in (1, 3):
            command_line.refuse(f"say which component of '{field}' is meant; there are: {', '.join(components)}")
    by_name = [*asked.hide, *asked.only, *(asked.cut or [])]
    there = names_of_bodies(chosen_file(asked.folder, "body", asked.time)[1]) if by_name and "body" in drawn else []
    wrong = [command_line.unknown("body", name, there) for name in by_name if name not in there]
    if wrong:
        command_line.refuse("; ".join(wrong))
    if there and set(asked.hide) >= set(there):
        command_line.refuse("argument --hide: there is no other body")


def names_of_bodies(path):
    """Names of the bodies of a frame; the numbers of its parts where it has no names."""
    whole = [array for part_of_file in xml.parse(path).getroot().iter("FieldData") for array in part_of_file]
    found = [array.get("Name") for array in whole if array.get("NumberOfTuples") == "2"]
    return found or [str(part) for part in sorted(set(runs.read_fields(path).get("part_id", [])))]


def fields_of(path):
    """{name: names of its components} of the fields of a ParaView file."""
    found = {}
    for part_of_file in xml.parse(path).getroot().iter():
        for array in part_of_file if part_of_file.tag in ("PointData", "CellData") else ():
            number = int(array.get("NumberOfComponents", "1"))
            found[array.get("Name")] = [array.get(f"ComponentName{i}", str(i)) for i in range(number)]
    return found


def listed(folder, name):
    """[(time [s], file)] of the frames of a data set; the script ends where its collection is damaged."""
    try:
        return frames.listed(folder, name)
    except frames.CannotRead as error:
        command_line.refuse(error)


def chosen_file(folder, name, time):
    """Time and file of the frame nearest to a time; (None, None) if there is none."""
    found = listed(folder, name)
    if not found:
        return None, None
    return found[-1] if time is None else min(found, key=lambda one: abs(one[0] - time))


def frame(folder, name, time):
    """Time and data of the frame nearest to a time; (None, None) if there is none."""
    at, file = chosen_file(folder, name, time)
    if file is None:
        return None, None
    return at, frames.load(file)


def moved(data, factor):
    """The same data with its displacement times a factor; points of older files stand where they were at the start."""
    data.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(data)
    warp.SetScaleFactor(factor - 1 if frames.is_deformed(data) else factor)
    warp.Update()
    return warp.GetOutput()


def named(data):
    """The number of each cell's body, put into the frame where it has none, and {name: number}."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    of_cells, names = frames.bodies(data)
    if data.GetCellData().GetArray("body") is None:
        numbers = numpy_to_vtk(of_cells.astype("i4"), deep=True)
        numbers.SetName("body")
        data.GetCellData().AddArray(numbers)
    return of_cells, {frames.name_of(one, names): int(one) for one in sorted(set(of_cells))}


def with_cells(data, which):
    """The cells of a frame for which an array is true, with the points that they use."""
    import numpy as np
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    node = vtk.vtkSelectionNode()
    node.SetFieldType(vtk.vtkSelectionNode.CELL)
    node.SetContentType(vtk.vtkSelectionNode.INDICES)
    node.SetSelectionList(numpy_to_vtkIdTypeArray(np.flatnonzero(which).astype("i8"), deep=True))
    selection = vtk.vtkSelection()
    selection.AddNode(node)
    extract = vtk.vtkExtractSelection()
    extract.SetInputData(0, data)
    extract.SetInputData(1, selection)
    extract.Update()
    found = extract.GetOutput()
    found.SetFieldData(data.GetFieldData())
    return found


def places_of(data, which):
    """The points of the cells for which an array is true, as bytes that can be compared: contact elements stand on them."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    points, cells = vtk_to_numpy(data.GetPoints().GetData()), data.GetCells()
    ends, nodes = (vtk_to_numpy(one) for one in (cells.GetOffsetsArray(), cells.GetConnectivityArray()))
    return {points[node].tobytes() for node in set(nodes[np.repeat(which, np.diff(ends))].tolist())}


POINTS_OF_ELEMENT = 5  # of a contact element: foot, apex and the corners of the facet


def touching(data, places):
    """For each element of a frame of contact, whether one of its points is at one of the places."""
    import numpy as np
    return np.array([any(point.tobytes() in places for point in points) for points in elements_of(data)], bool)


def elements_of(data):
    """The points of each contact element [elements x 5 x 3]."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, POINTS_OF_ELEMENT, 3)


def half(data, at):
    """What lies at y >= at."""
    plane = vtk.vtkPlane()
    plane.SetOrigin(0, at, 0)
    plane.SetNormal(0, 1, 0)
    clip = vtk.vtkTableBasedClipDataSet()
    clip.SetClipFunction(plane)
    clip.SetInputData(data)
    clip.Update()
    return clip.GetOutput()


def array_of(data, field):
    """A field and whether it belongs to the cells."""
    for attributes, of_cells in ((data.GetCellData(), True), (data.GetPointData(), False)):
        if attributes.GetArray(field) is not None:
            return attributes.GetArray(field), of_cells
    return None, False


def names_of(data):
    return [attributes.GetArrayName(i) for attributes in (data.GetPointData(), data.GetCellData())
            for i in range(attributes.GetNumberOfArrays())]


def is_zero(data, name):
    """Whether a field is zero everywhere, as that of solids is where all solids are rigid."""
    arrays = [there for there in (data.GetPointData().GetArray(name), data.GetCellData().GetArray(name)) if there is not None]
    return all(array.GetRange(-1) == (0.0, 0.0) for array in arrays)


def chosen(data, asked, preferred):
    """The field asked for, or the first of the preferred ones that is there and not zero, or the first of them."""
    if asked and asked not in names_of(data):
        sys.exit(f"view.py: no field '{asked}'; there are: {', '.join(names_of(data))}")
    there = [name for name in preferred if name in names_of(data)]
    return asked or next((name for name in there if not is_zero(data, name)), there[0] if there else None)


def black(text, size):
    text.SetColor(*DARK)
    text.SetFontFamilyToArial()
    text.BoldOff()
    text.ItalicOff()
    text.ShadowOff()
    text.SetFontSize(size)


def wide(text, size):
    """The width of a text [pixels]."""
    style, box = vtk.vtkTextProperty(), [0, 0, 0, 0]
    black(style, size)
    vtk.vtkTextRenderer.GetInstance().GetBoundingBox(style, text, box, 72)
    return box[1] - box[0] + 1


def numbers_beside(title):
    """(width, room) of a bar with numbers on its right [pixels]: of its frame, over which the title is centred, and of all of it."""
    frame = max(wide(title, TITLE), BAR + BESIDE + wide(WIDEST_NUMBER, LABEL))
    return frame, frame


def words_beside(title, words, letters=LABEL):
    """The same of a bar with words on its left."""
    frame = max(wide(title, TITLE), BAR)
    return frame, frame + BESIDE + max(wide(word, letters) for word in words)


def bar(title, colours, up, frame, asked, labels=5, letters=LABEL):
    """A scalar bar with black text at the right border.

    up       bottom and height, of the picture
    frame    its width [pixels]
    letters  [pixels] of words beside it
    """
    actor = vtk.vtkScalarBarActor()
    actor.SetLookupTable(colours)
    actor.SetTitle(title)
    actor.SetNumberOfLabels(labels)
    actor.SetLabelFormat("%.3g")
    actor.SetUnconstrainedFontSize(True)
    black(actor.GetTitleTextProperty(), TITLE)
    black(actor.GetLabelTextProperty(), LABEL)
    black(actor.GetAnnotationTextProperty(), letters)
    actor.GetTitleTextProperty().SetJustificationToLeft()
    actor.SetVerticalTitleSeparation(12)
    actor.SetBarRatio(BAR / frame)
    actor.GetPositionCoordinate().SetValue(1 - (frame + MARGIN) / asked.size[0], up[0])
    actor.SetWidth(frame / asked.size[0])
    actor.SetHeight(up[1])
    return actor


def cool_to_warm():
    """From blue over light grey to red, light enough to see shading and contact upon it."""
    function = vtk.vtkColorTransferFunction()
    function.SetColorSpaceToDiverging()
    function.AddRGBPoint(0, 0.230, 0.299, 0.754)
    function.AddRGBPoint(1, 0.706, 0.016, 0.150)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for i in range(256):
        table.SetTableValue(i, *function.GetColor(i / 255), 1)
    table.Build()
    return table


def component_of(data, field, component):
    """The number of a component of a field, -1 for the magnitude, and its name."""
    array, _ = array_of(data, field)
    if array.GetNumberOfComponents() == 1:
        return 0, field
    if component:
        names = [array.GetComponentName(c) for c in range(array.GetNumberOfComponents())]
        if component not in names:
            sys.exit(f"view.py: '{field}' has the components {', '.join(map(str, names))}")
        return names.index(component), f"{field} {component}"
    if array.GetNumberOfComponents() == 3:
        return -1, f"|{field}|"
    sys.exit(f"view.py: say which --component of '{field}'")


def colour(mapper, data, field, component, limits):
    """Lets a mapper colour by a field; returns the colours."""
    array, of_cells = array_of(data, field)
    if of_cells:
        mapper.SetScalarModeToUseCellFieldData()
    else:
        mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    table = cool_to_warm()
    which, _ = component_of(data, field, component)
    if which >= 0:
        table.SetVectorModeToComponent()
        table.SetVectorComponent(which)
    else:
        table.SetVectorModeToMagnitude()
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    table.SetRange(*(limits or array.GetRange(which)))
    return table


def title_of(data, field, component):
    """Of a scalar bar."""
    return f"{component_of(data, field, component)[1]} [{frames.unit_of(data, field)}]"


def surface_mapper(data):
    if not data.IsA("vtkPolyData"):
        surface = vtk.vtkDataSetSurfaceFilter()
        surface.SetInputData(data)
        surface.Update()
        data = surface.GetOutput()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    return mapper


def actor_of(mapper):
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    # Enough light from everywhere that a face seen from aside keeps the colour of the scalar bar.
    actor.GetProperty().SetAmbient(0.8)
    actor.GetProperty().SetDiffuse(0.2)
    return actor


def colours_of_bodies(names):
    """A colour for each body, far from those of the bodies before it."""
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(names))
    table.IndexedLookupOn()  # a bar of words, not of numbers
    for i, (name, number) in enumerate(names.items()):
        table.SetTableValue(i, *colorsys.hsv_to_rgb((0.6 + GOLDEN * i) % 1, (0.45, 0.65)[i % 2], (0.9, 0.75)[i % 2]), 1)
        table.SetAnnotation(number, name)
    return table


def add_body(renderer, body, asked):
    if not body.pieces:  # the cut has taken all
        return
    field = chosen(body.whole, asked.field, PREFERRED["body"])
    for data in body.pieces:
        mapper = surface_mapper(data)
        actor = actor_of(mapper)
        actor.GetProperty().SetColor(0.75, 0.75, 0.75)
        actor.GetProperty().SetOpacity(asked.opacity)
        actor.GetProperty().SetEdgeVisibility(asked.edges)
        actor.GetProperty().SetEdgeColor(0.35, 0.35, 0.35)
        if field:
            mapper.ScalarVisibilityOn()
        if field == "body":
            mapper.SetScalarModeToUseCellFieldData()
            mapper.SelectColorArray(field)
            mapper.SetLookupTable(colours_of_bodies(body.names))
        elif field:
            # The range is that of all bodies that are shown, whole: a cut must not change what a colour means.
            table = colour(mapper, body.whole, field, asked.component, asked.range)
        renderer.AddActor(actor)
    if field == "body":
        frame, _ = words_beside("body", body.names, letters_of(body, asked))
        renderer.AddActor2D(bar("body", colours_of_bodies(body.names), UPPER, frame, asked, 0, letters_of(body, asked)))
    elif field:
        title = title_of(body.whole, field, asked.component)
        renderer.AddActor2D(bar(title, table, UPPER, numbers_beside(title)[0], asked))


def letters_of(body, asked):
    """[pixels] of the names of bodies beside a bar, which may be many."""
    return min(LABEL, int(0.7 * UPPER[1] * asked.size[1] / len(body.names)))


def cells_where(data, lowest, highest):
    """The contact elements whose status lies within limits."""
    pick = vtk.vtkThreshold()
    pick.SetInputData(data)
    of_cells = vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS
    pick.SetInputArrayToProcess(0, 0, 0, of_cells, "contact_status")
    pick.SetLowerThreshold(lowest)
    pick.SetUpperThreshold(highest)
    pick.SetThresholdFunction(vtk.vtkThreshold.THRESHOLD_BETWEEN)
    pick.Update()
    return pick.GetOutput()


def triangles_of(data):
    """The triangles alone: outlines drawn over lines would hide their colour."""
    triangles = vtk.vtkPolyData()
    triangles.SetPoints(data.GetPoints())
    triangles.SetPolys(data.GetPolys())
    return triangles


def status_colours(data):
    """Of the statuses that are there: a bar of words, not of numbers."""
    low, high = data.GetCellData().GetArray("contact_status").GetRange()
    there = [(number, *one) for number, one in enumerate(STATUS, start=-1) if low <= number <= high]  # statuses count from -1, lost
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(there))
    table.IndexedLookupOn()
    for i, (number, word, rgb) in enumerate(there):
        table.SetTableValue(i, *rgb, 1)
        table.SetAnnotation(number, word)
    return table


def add_contact(renderer, contact, asked):
    if not contact.pieces:
        return
    (data,) = contact.pieces
    field = chosen(data, asked.contact_field, PREFERRED["contact"])
    has_status = data.GetCellData().GetArray("contact_status") is not None
    thick = cells_where(data, 1, 255) if has_status and not asked.contact_field else data
    # Contact lies in the faces of the bodies: it is drawn a hair nearer to the eye.
    hair = [2e-3 * data.GetLength() * along for along in towards_eye(asked)]
    table = None
    for part, thin in ((cells_where(data, 0, 0) if has_status else None, True), (thick, False)):
        if part is None or part.GetNumberOfCells() == 0:
            continue
        mapper = surface_mapper(part)
        actor = actor_of(mapper)
        actor.SetPosition(*hair)
        actor.GetProperty().LightingOff()
        actor.GetProperty().SetLineWidth(1 if thin else 3)
        actor.GetProperty().SetPointSize(1 if thin else 6)
        if thin:
            actor.GetProperty().SetRepresentationToWireframe()
            actor.GetProperty().SetColor(*STATUS[1][1])
        else:
            mapper.ScalarVisibilityOn()
            if field != "contact_status":
                table = colour(mapper, data, field, None, asked.contact_range)
            else:
                mapper.SetScalarModeToUseCellFieldData()
                mapper.SelectColorArray(field)
                mapper.SetLookupTable(status_colours(data))
            outlines = actor_of(surface_mapper(triangles_of(mapper.GetInput())))
            outlines.SetPosition(*[1.5 * along for along in hair])
            outlines.GetProperty().SetRepresentationToWireframe()
            outlines.GetProperty().SetColor(*DARK)
            renderer.AddActor(outlines)
        renderer.AddActor(actor)
    if field == "contact_status":
        frame, _ = words_beside("contact", STATUS_WORDS)
        renderer.AddActor2D(bar("contact", status_colours(data), (0.12, 0.24), frame, asked, 0))
    elif table:
        title = title_of(data, field, None)
        renderer.AddActor2D(bar(title, table, (0.07, 0.34), numbers_beside(title)[0], asked))


def room_of(there, asked):
    """The room that bars take at the right [pixels]."""
    rooms = []
    for name, field_asked, component in (("body", asked.field, asked.component), ("contact", asked.contact_field, None)):
        one = there.get(name)
        field = chosen(one.whole, field_asked, PREFERRED[name]) if one and one.pieces else None
        if field == "body":
            rooms.append(words_beside(field, one.names, letters_of(one, asked))[1])
        elif field == "contact_status":
            rooms.append(words_beside("contact", STATUS_WORDS)[1])
        elif field:
            rooms.append(numbers_beside(title_of(one.whole, field, component))[1])
    return min(max(rooms, default=-MARGIN) + 2 * MARGIN, MOST_ROOM * asked.size[0])


def add_walls(renderer, walls, _):
    for data in walls.pieces:
        actor = actor_of(surface_mapper(data))
        actor.GetProperty().SetColor(0.85, 0.85, 0.82)
        renderer.AddActor(actor)


def add_time(renderer, time):
    label = vtk.vtkTextActor()
    label.SetInput(f"t = {time * 1e3:.4g} ms")
    black(label.GetTextProperty(), 26)
    label.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    label.GetPositionCoordinate().SetValue(0.02, 0.94)
    renderer.AddActor2D(label)


def towards_eye(asked):
    """The unit vector from the bodies to the eye."""
    about, above = radians(asked.azimuth), radians(asked.elevation)
    return sin(about) * cos(above), -cos(about) * cos(above), sin(above)


def axes_of_picture(asked):
    """Unit vectors to the right, upwards and towards the eye, as rows; z is up."""
    import numpy as np
    eye = np.array(towards_eye(asked))
    upwards = np.array((0, 0, 1)) if abs(eye[2]) < 1 - 1e-9 else np.array((0, 1, 0))
    right = np.cross(upwards, eye) / np.linalg.norm(np.cross(upwards, eye))
    return np.array((right, np.cross(eye, right), eye))


def outline(there, asked):
    """Those points of what is drawn that are farthest in some direction of the picture; walls count where there is nothing else."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    pieces = [piece for name, one in there.items() for piece in one.pieces if name != "walls"]
    pieces = [piece for piece in pieces or [piece for one in there.values() for piece in one.pieces] if piece.GetNumberOfPoints() > 0]
    if not pieces:
        return np.zeros((0, 3))
    points = np.concatenate([vtk_to_numpy(piece.GetPoints().GetData()) for piece in pieces])
    turns = np.linspace(0, 2 * np.pi, OUTLINE, endpoint=False)
    along = np.array((np.cos(turns), np.sin(turns))).T @ axes_of_picture(asked)[:2]
    return points[np.unique(np.argmax(along @ points.T, axis=1))]


def aim(renderer, points, asked):
    """Fills the free part of the picture with the points."""
    free = (FREE[0][0], min(FREE[0][1], 1 - 2 * asked.room / asked.size[0])), FREE[1]
    import numpy as np
    axes = axes_of_picture(asked)
    right, up, near = axes @ points.T
    middle = [(one.min() + one.max()) / 2 for one in (right, up, near)]
    size = max(np.ptp(right), np.ptp(up), np.ptp(near)) or 1.0
    half_angle = np.tan(np.radians(VIEW_ANGLE / 2))
    spread = half_angle * asked.size[0] / asked.size[1], half_angle  # of the picture at a distance of one
    distance = size / half_angle
    for _ in range(20):  # nearer points look larger: each time is nearer to the camera that is sought
        depth = distance + middle[2] - near
        seen = [(one - at) / depth / width for one, at, width in zip((right, up), middle, spread)]
        for i, (one, (low, high)) in enumerate(zip(seen, free)):
            middle[i] += ((one.min() + one.max()) / 2 - (low + high) / 2) * distance * spread[i]
        filled = max(np.ptp(one) / (high - low) for one, (low, high) in zip(seen, free))
        distance = max(distance * filled, 1.05 * (near.max() - middle[2]) + 1e-3 * size)
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(VIEW_ANGLE)
    focus = np.array(middle) @ axes
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(focus + distance * axes[2]))
    camera.SetViewUp(*axes[1])
    renderer.ResetCameraClippingRange()


class Part:
    """What is drawn of a data set: its pieces; what they are of, before a cut; and {name: number} of the bodies in it."""

    def __init__(self, pieces, whole, names=None):
        self.pieces, self.whole, self.names = [piece for piece in pieces if piece.GetNumberOfCells() > 0], whole, names


def data_at(asked, time):
    """The time of the frame nearest to a time, and {name: Part} of the data sets asked for."""
    there, body = {}, None
    for name in DATA_SETS:
        if name not in asked.show:
            continue
        at, data = frame(asked.folder, name, time)
        if data is None or data.GetNumberOfPoints() == 0:
            continue
        if name != "walls":
            time = at  # contact at the moment of the body
        if name == "body":
            body = Shown(data, asked)
            there[name] = shown_bodies(data, body, asked)
        elif name == "contact":
            there[name] = shown_contact(data, body, asked)
        else:
            there[name] = Part([moved(data, asked.warp)], data)
    return time, there


class Shown:
    """Which bodies of a frame are drawn: {name: number}; and its cells that are drawn whole and that are cut."""

    def __init__(self, data, asked):
        import numpy as np
        of_cells, names = named(data)
        self.names = {name: number for name, number in names.items() if name not in asked.hide and (not asked.only or name in asked.only)}
        cut = [number for name, number in self.names.items() if asked.cut is not None and (not asked.cut or name in asked.cut)]
        self.is_cut = np.isin(of_cells, cut)
        self.is_whole = np.isin(of_cells, list(self.names.values())) & ~self.is_cut
        self.on_whole, self.on_cut = places_of(data, self.is_whole), places_of(data, self.is_cut)


def shown_bodies(data, body, asked):
    now = moved(data, asked.warp)
    pieces = [with_cells(now, body.is_whole), half(with_cells(now, body.is_cut), asked.cut_at)]
    return Part(pieces, with_cells(now, body.is_whole | body.is_cut), body.names)


def shown_contact(data, body, asked):
    """Contact elements at bodies that are drawn; at those that are cut, in the half that stays."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    now = moved(data, asked.warp)
    if 2 * data.GetNumberOfPoints() != POINTS_OF_ELEMENT * data.GetNumberOfCells():  # of another program
        return Part([now], data)
    stays = (elements_of(now)[:, :, 1] >= asked.cut_at).all(axis=1)
    if body is None:
        kept = stays if asked.cut is not None else np.full(len(stays), True)
    else:
        kept = touching(data, body.on_whole) | stays & touching(data, body.on_cut)
    kept = np.tile(kept, 2)  # all lines come before all facets, each in the order of the elements
    status = data.GetCellData().GetArray("contact_status")
    if status is not None and not asked.open:
        kept &= vtk_to_numpy(status) == CLOSED
    return Part([with_cells(now, kept)], data)


def joined(limits, data, field, component):
    """A range of colours, or None, joined with that of a field."""
    if not field or array_of(data, field)[0] is None:
        return limits
    low, high = array_of(data, field)[0].GetRange(component_of(data, field, component)[0])
    return (min(low, limits[0]), max(high, limits[1])) if limits else (low, high)


def draw(asked, time, there, points, out):
    """Writes a picture of what is there, with the camera aimed at points."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for name, one in there.items():
        {"body": add_body, "contact": add_contact, "walls": add_walls}[name](renderer, one, asked)
    if time is not None:
        add_time(renderer, time)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*asked.size)
    window.AddRenderer(renderer)
    aim(renderer, points, asked)
    window.Render()
    shot = vtk.vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(out))
    writer.SetInputConnection(shot.GetOutputPort())
    writer.Write()


def draw_apart(*what):
    """The same by a process of its own; the script ends if that fails."""
    try:
        screen.drawn(lambda: draw(*what))
    except screen.NotDrawn as error:
        sys.exit(f"view.py: {error}")


def draw_frames(asked):
    """A picture of each frame, with one camera and one range of colours for all."""
    import numpy as np
    names = [name for name in DATA_SETS if name in asked.show]
    times = next(times for times in ([time for time, _ in listed(asked.folder, name)] for name in names) if times)
    points, limits, of_contact = [], None, None
    for time in times:
        _, there = data_at(asked, time)
        points.append(outline(there, asked))
        asked.room = max(asked.room, room_of(there, asked))
        if "body" in there and there["body"].whole.GetNumberOfCells() > 0:
            whole = there["body"].whole
            limits = joined(limits, whole, chosen(whole, asked.field, PREFERRED["body"]), asked.component)
        if "contact" in there and asked.contact_field:
            of_contact = joined(of_contact, there["contact"].whole, asked.contact_field, None)
    points = something(np.concatenate(points), asked)
    asked.range, asked.contact_range = asked.range or limits, of_contact
    for number, time in enumerate(times):
        draw_apart(asked, *data_at(asked, time), points, asked.frames / f"frame_{number:04d}.png")
    print(f"{asked.frames}: {len(times)} frames")


def something(points, asked):
    """The same points; without any, the script ends."""
    if not len(points):
        command_line.refuse(f"nothing to draw in {asked.folder}: no part of a body lies in what is asked for")
    return points


def main():
    asked = arguments()
    if screen.missing():
        sys.exit(f"view.py: {screen.missing()}")
    global vtk  # only now: loading it takes a second
    import vtk

    screen.use_one_thread()
    if asked.frames:
        draw_frames(asked)
        return
    time, there = data_at(asked, asked.time)
    asked.room = room_of(there, asked)
    draw_apart(asked, time, there, something(outline(there, asked), asked), asked.out)
    print(asked.out)


if __name__ == "__main__":
    main()
