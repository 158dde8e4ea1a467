#!/usr/bin/python3
"""Draws one moment of a run, or every frame: body.pvd, contact.pvd and walls.pvd of an output folder, as PNG.

    scripts/view.py out/cask_drop --field von_mises --time 4.3e-3 --cut --out cask.png
    scripts/view.py out/cask_drop --cut --frames out/cask_drop/frames     # frame_0000.png, frame_0001.png ...

Frames have one camera and one range of colours: that of all frames together, unless --range gives it.
Needs Debian's python3-vtk9 and, where there is no screen, xvfb; ParaView is not needed.  The
bodies are moved by `displacement`; contact elements are coloured by status, or by a field of their
own, and open ones are thin grey lines.  The view is that of an upright cylinder: z is up.
"""

import argparse
import os
import shutil
import sys
import xml.etree.ElementTree as xml
from math import cos, radians, sin

import command_line

STATUS = [("unpaired", (0.75, 0.55, 0.10)), ("open", (0.55, 0.55, 0.55)), ("closed", (0.85, 0.10, 0.10))]
DATA_SETS = ("body", "contact", "walls")
PREFERRED = {"body": ("von_mises", "von_mises_top", "displacement"), "contact": ("contact_status", "gap")}
MOST_PIXELS = 16384  # of a picture, either way
DARK = (0.1, 0.1, 0.1)


def arguments():
    parser = command_line.Parser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folder", type=command_line.folder_to_read, help="where body.pvd and contact.pvd stand")
    add("--field", help="what colours the body (default: von_mises, of plates von_mises_top, else displacement)")
    add("--component", help="its component, such as ZZ (default: the magnitude of a vector)")
    add("--contact-field", help="what colours contact (default: contact_status, else gap)")
    add("--time", type=command_line.finite, help="[s]; the nearest frame is drawn (default: the last)")
    add("--out", type=command_line.file_to_write, help="PNG to write (default: view.png in the folder)")
    add("--frames", type=command_line.folder_to_write, metavar="DIR", help="write every frame into this folder, for an animation")
    add("--cut", action="store_true", help="take away the half y < 0, to look inside")
    add("--show", type=data_sets, default="body,contact,walls", help="which data sets, with commas between")
    add("--warp", type=command_line.finite, default=1.0, help="factor on the displacement (default: 1)")
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
    asked.contact_range = None
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
        there = fields_of(asked.folder / chosen_file(asked.folder, name, asked.time)[1])
        if field and field not in there:
            command_line.refuse(command_line.unknown("field", field, there))
        field = field or next((one for one in PREFERRED[name] if one in there), None)
        components = there.get(field, [])
        if component and len(components) > 1 and component not in components:
            command_line.refuse(f"'{field}' has the components {', '.join(components)}")
        if not component and len(components) not in (1, 3):
            command_line.refuse(f"say which component of '{field}' is meant; there are: {', '.join(components)}")


def fields_of(path):
    """{name: names of its components} of the fields of a ParaView file."""
    found = {}
    for part_of_file in xml.parse(path).getroot().iter():
        for array in part_of_file if part_of_file.tag in ("PointData", "CellData") else ():
            number = int(array.get("NumberOfComponents", "1"))
            found[array.get("Name")] = [array.get(f"ComponentName{i}", str(i)) for i in range(number)]
    return found


def give_a_screen():
    """Starts this script again under xvfb-run where there is no screen to draw on."""
    if os.environ.get("DISPLAY"):
        return
    xvfb = shutil.which("xvfb-run")
    if xvfb is None:
        sys.exit("view.py: no screen and no xvfb-run; apt-get install xvfb")
    # -a takes a free screen number, so that several pictures can be drawn at the same time.
    os.execv(xvfb, [xvfb, "-a", "-s", "-screen 0 1600x1200x24", sys.executable, *sys.argv])


def listed(folder, name):
    """[(time [s], file)] of the frames of a data set."""
    index = os.path.join(folder, name + ".pvd")
    if not os.path.exists(index):
        return []
    try:
        return [(float(one.get("timestep")), one.get("file"))
                for one in xml.parse(index).getroot().iter("DataSet")]
    except (xml.ParseError, TypeError, ValueError):
        command_line.refuse(f"{index} is no collection of ParaView")


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
    surface = file.endswith(".vtp")
    reader = vtk.vtkXMLPolyDataReader() if surface else vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(os.path.join(folder, file))
    reader.Update()
    return at, reader.GetOutput()


def moved(data, factor):
    """The same data where it stands now; points in the files stand where they were at the start."""
    data.GetPointData().SetActiveVectors("displacement")
    warp = vtk.vtkWarpVector()
    warp.SetInputData(data)
    warp.SetScaleFactor(factor)
    warp.Update()
    return warp.GetOutput()


def half(data):
    """What lies at y >= 0; contact elements stay whole, since a clipped list of lines and triangles loses which is which."""
    plane = vtk.vtkPlane()
    plane.SetNormal(0, 1, 0)
    if data.IsA("vtkPolyData"):
        clip = vtk.vtkExtractPolyDataGeometry()
        clip.SetImplicitFunction(plane)
        clip.ExtractInsideOff()
    else:
        clip = vtk.vtkTableBasedClipDataSet()
        clip.SetClipFunction(plane)
    clip.SetInputData(data)
    clip.Update()
    return clip.GetOutput()


def unit_of(data, field):
    """The unit of a field, from the names "stress [Pa]" of the components of an array that every file carries."""
    units = data.GetFieldData().GetArray("units")
    for i in range(units.GetNumberOfComponents() if units else 0):
        name, _, unit = units.GetComponentName(i).partition(" ")
        if name == field:
            return unit.strip("[]")
    return ""


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


def bar(title, colours, place, labels=5):
    """A scalar bar with black text; place is left, bottom, width, height of the picture."""
    actor = vtk.vtkScalarBarActor()
    actor.SetLookupTable(colours)
    actor.SetTitle(title)
    actor.SetNumberOfLabels(labels)
    actor.SetLabelFormat("%.3g")
    actor.SetUnconstrainedFontSize(True)
    black(actor.GetTitleTextProperty(), 22)
    black(actor.GetLabelTextProperty(), 20)
    black(actor.GetAnnotationTextProperty(), 20)
    actor.GetTitleTextProperty().SetJustificationToLeft()
    actor.SetVerticalTitleSeparation(12)
    actor.SetBarRatio(0.25)
    actor.GetPositionCoordinate().SetValue(*place[:2])
    actor.SetWidth(place[2])
    actor.SetHeight(place[3])
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
    """The number of a component of a field, -1 for the magnitude, and the title of its scalar bar."""
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
    """Lets a mapper colour by a field; returns the title of its scalar bar and the colours."""
    array, of_cells = array_of(data, field)
    if of_cells:
        mapper.SetScalarModeToUseCellFieldData()
    else:
        mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    table = cool_to_warm()
    which, title = component_of(data, field, component)
    if which >= 0:
        table.SetVectorModeToComponent()
        table.SetVectorComponent(which)
    else:
        table.SetVectorModeToMagnitude()
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    table.SetRange(*(limits or array.GetRange(which)))
    return f"{title} [{unit_of(data, field)}]", table


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
    actor.GetProperty().SetAmbient(0.55)
    actor.GetProperty().SetDiffuse(0.45)
    return actor


def add_body(renderer, data, asked):
    mapper = surface_mapper(half(data) if asked.cut else data)
    actor = actor_of(mapper)
    actor.GetProperty().SetColor(0.75, 0.75, 0.75)
    actor.GetProperty().SetOpacity(asked.opacity)
    actor.GetProperty().SetEdgeVisibility(asked.edges)
    actor.GetProperty().SetEdgeColor(0.35, 0.35, 0.35)
    field = chosen(data, asked.field, PREFERRED["body"])
    if field:
        mapper.ScalarVisibilityOn()
        # The range is that of the whole body: a cut must not change what a colour means.
        title, table = colour(mapper, data, field, asked.component, asked.range)
        renderer.AddActor2D(bar(title, table, (0.86, 0.50, 0.10, 0.40)))
    renderer.AddActor(actor)


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


def status_colours():
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(len(STATUS))
    table.SetRange(-1.5, len(STATUS) - 1.5)
    table.IndexedLookupOn()  # a bar of words, not of numbers
    for i, (word, rgb) in enumerate(STATUS):
        table.SetTableValue(i, *rgb, 1)
        table.SetAnnotation(i - 1, word)  # statuses count from -1, lost
    return table


def add_contact(renderer, data, asked):
    if asked.cut:
        data = half(data)
    if data.GetNumberOfCells() == 0:
        return
    field = chosen(data, asked.contact_field, PREFERRED["contact"])
    has_status = data.GetCellData().GetArray("contact_status") is not None
    closed = cells_where(data, 1, 255) if has_status and not asked.contact_field else data
    # Contact lies in the faces of the bodies: it is drawn a hair nearer to the eye.
    hair = [2e-3 * data.GetLength() * along for along in towards_eye(asked)]
    table = None
    for part, thin in ((cells_where(data, 0, 0) if has_status else None, True), (closed, False)):
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
                title, table = colour(mapper, data, field, None, asked.contact_range)
            else:
                mapper.SetScalarModeToUseCellFieldData()
                mapper.SelectColorArray(field)
                mapper.SetLookupTable(status_colours())
                mapper.UseLookupTableScalarRangeOn()
            outlines = actor_of(surface_mapper(triangles_of(mapper.GetInput())))
            outlines.SetPosition(*[1.5 * along for along in hair])
            outlines.GetProperty().SetRepresentationToWireframe()
            outlines.GetProperty().SetColor(*DARK)
            renderer.AddActor(outlines)
        renderer.AddActor(actor)
    if field == "contact_status":
        renderer.AddActor2D(bar("contact", status_colours(), (0.86, 0.12, 0.10, 0.24), 0))
    elif table:
        renderer.AddActor2D(bar(title, table, (0.86, 0.07, 0.10, 0.34)))


def add_walls(renderer, data, _):
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


def aim(renderer, bounds, asked):
    """Looks along +y with z up, at the bodies and not at the walls; leaves room for the bars."""
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(12)  # [degrees] from far away: parallel edges look parallel
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*towards_eye(asked))
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera(bounds)
    camera.Zoom(1.1)
    camera.SetWindowCenter(0.14, 0)
    renderer.ResetCameraClippingRange()


def data_at(asked, time):
    """The time of the frame nearest to a time, and {name: data as it stands} of the data sets asked for."""
    there = {}
    for name in DATA_SETS:
        if name not in asked.show:
            continue
        at, data = frame(asked.folder, name, time)
        if data is None or data.GetNumberOfPoints() == 0:
            continue
        if name != "walls":
            time = at  # contact at the moment of the body
        there[name] = moved(data, asked.warp)
    return time, there


def check_bounds(bounds, asked):
    if not bounds.IsValid():
        sys.exit(f"view.py: nothing to draw in {asked.folder}")


def add_bounds(bounds, there):
    """Adds the bodies to a box, and walls only where there is nothing else."""
    for name, data in there.items():
        if name != "walls" or not bounds.IsValid():
            bounds.AddBounds(data.GetBounds())


def box_of(bounds):
    box = [0.0] * 6
    bounds.GetBounds(box)
    return box


def joined(limits, data, field, component):
    """A range of colours, or None, joined with that of a field."""
    if not field or array_of(data, field)[0] is None:
        return limits
    low, high = array_of(data, field)[0].GetRange(component_of(data, field, component)[0])
    return (min(low, limits[0]), max(high, limits[1])) if limits else (low, high)


def draw(asked, time, there, box, out):
    """Writes a picture of what is there, with the camera aimed at a box."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for name, data in there.items():
        {"body": add_body, "contact": add_contact, "walls": add_walls}[name](renderer, data, asked)
    if time is not None:
        add_time(renderer, time)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    window.SetSize(*asked.size)
    window.AddRenderer(renderer)
    aim(renderer, box, asked)
    window.Render()
    shot = vtk.vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(out))
    writer.SetInputConnection(shot.GetOutputPort())
    writer.Write()


def draw_frames(asked):
    """A picture of each frame, with one camera and one range of colours for all."""
    names = [name for name in DATA_SETS if name in asked.show]
    times = next(times for times in ([time for time, _ in listed(asked.folder, name)] for name in names) if times)
    bounds, limits, of_contact = vtk.vtkBoundingBox(), None, None
    for time in times:
        _, there = data_at(asked, time)
        add_bounds(bounds, there)
        if "body" in there:
            limits = joined(limits, there["body"], chosen(there["body"], asked.field, PREFERRED["body"]), asked.component)
        if "contact" in there and asked.contact_field:
            of_contact = joined(of_contact, there["contact"], asked.contact_field, None)
    check_bounds(bounds, asked)
    asked.range, asked.contact_range = asked.range or limits, of_contact
    for number, time in enumerate(times):
        draw(asked, *data_at(asked, time), box_of(bounds), asked.frames / f"frame_{number:04d}.png")
    print(f"{asked.frames}: {len(times)} frames")


def main():
    asked = arguments()
    give_a_screen()
    global vtk  # only now: loading it takes a second, and there may have been no screen
    import vtk

    if asked.frames:
        draw_frames(asked)
        return
    time, there = data_at(asked, asked.time)
    bounds = vtk.vtkBoundingBox()
    add_bounds(bounds, there)
    check_bounds(bounds, asked)
    draw(asked, time, there, box_of(bounds), asked.out)
    print(asked.out)


if __name__ == "__main__":
    main()
