#!/usr/bin/env pvbatch
"""Opens a run in ParaView: an entry of the pipeline for each body, with its name, and one for the contact elements that act.

    NEREID_RUN=out/balls paraview --script=scripts/paraview_run.py      # without NEREID_RUN: the run in the current folder
    pvbatch scripts/paraview_run.py out/balls --picture balls.png       # writes a picture; --time 0.6e-3 for a moment
    xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" pvbatch scripts/paraview_run.py out/balls --picture balls.png     # without a screen

Bodies have edges and are coloured by the von Mises stress, plates by that of their top; both have one range, which is that of the moment
that is shown first, the last one. Contact elements that act are red lines. Eyes of the pipeline show and hide entries by name. Frames of
older runs, whose points stand where they were at the start, are moved by their displacement, and their bodies are numbers.

It needs ParaView and its Python: docs/results.md, "In ParaView". Without `-noreset` the server of the screen begins anew when ParaView has
tried it, and ParaView may not find it then.
"""
import argparse
import os
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

SOLIDS, PLATES = 3, 2  # dimensions of bodies
COLOURED_BY = {SOLIDS: "von_mises", PLATES: "von_mises_top"}
TRIANGLE = 5  # as VTK numbers kinds of cells
CLOSED = 1  # status of a contact element that acts
RED, DARK, GREY = (0.85, 0.1, 0.1), (0.1, 0.1, 0.1), (0.75, 0.75, 0.75)
PICTURE = (1400, 1000)  # [pixels]
ABOVE = (0.25, -1.0, 0.45)  # direction from the bodies to the eye; z is up


def arguments():
    """Folder, picture and time that are asked for; within ParaView's window a script has no words and no file."""
    folder = Path(os.environ.get("NEREID_RUN", "."))
    if "__file__" not in globals():
        return argparse.Namespace(folder=folder, picture=None, time=None)
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    import command_line
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=command_line.folder_to_read, nargs="?", default=folder,
                        help="where body.pvd stands (default: NEREID_RUN, or the current folder)")
    parser.add_argument("--picture", type=command_line.file_to_write, metavar="FILE", help="PNG to write")
    parser.add_argument("--time", type=command_line.finite, help="[s]; the nearest frame is shown (default: the last)")
    return parser.parse_args()


def refuse(said):
    print(f"paraview_run.py: {said}", file=sys.stderr)
    sys.exit(2)


def times_of(index):
    """[s] of the frames that a collection lists; none where there is no such file.

    scripts/frames.py does the same, but in ParaView's window this script has no path by which it could import others.
    """
    try:
        return [float(one.get("timestep")) for one in xml.parse(index).getroot().iter("DataSet")] if index.is_file() else []
    except (xml.ParseError, TypeError, ValueError):
        refuse(f"{index} is no collection of ParaView")


# ------------------------------------------------------------------------------------------------
# What a frame says of itself

class Frame:
    """Arrays of the first frame: {name: unit}; [(name, number, dimension)] of its bodies; and whether its points are deformed."""

    def __init__(self, data):
        whole = data.GetFieldData()
        arrays = [whole.GetArray(i) for i in range(whole.GetNumberOfArrays())]
        arrays = {array.GetName(): array for array in arrays if array is not None}
        old = arrays.get("units")  # the names of its components, in older frames
        said = [*arrays, *(old.GetComponentName(i) for i in range(old.GetNumberOfComponents() if old else 0))]
        self.units = dict(one.rstrip("]").split(" [") for one in said if one and " [" in one)
        self.deformed = "points_are_deformed" in arrays
        self.of_cells = {data.GetCellData().GetArrayName(i) for i in range(data.GetCellData().GetNumberOfArrays())}
        self.of_body = "body" if "body" in self.of_cells else "part_id"
        self.bodies = [(name, *(int(array.GetValue(i)) for i in (0, 1))) for name, array in arrays.items()
                       if array.GetNumberOfValues() == 2 and array.GetDataTypeAsString() == "int"]
        if not self.bodies:
            parts, kinds = data.GetCellData().GetArray(self.of_body), {}
            for cell in range(parts.GetNumberOfTuples() if parts else 0):
                kinds.setdefault(int(parts.GetValue(cell)), data.GetCellType(cell))
            self.bodies = [(str(number), number, PLATES if kind == TRIANGLE else SOLIDS) for number, kind in sorted(kinds.items())]


# ------------------------------------------------------------------------------------------------
# The pipeline

def opened(simple, index, deformed=True):
    """The reader of a collection, and what stands deformed."""
    source = simple.PVDReader(registrationName=index.name, FileName=str(index.resolve()))
    if deformed:
        return source
    return simple.WarpByVector(registrationName=f"{index.stem}, deformed", Input=source, Vectors=["POINTS", "displacement"])


def part(simple, source, name, field, value):
    """The cells of a source whose field has a value, as an entry of that name."""
    return simple.Threshold(registrationName=name, Input=source, Scalars=["CELLS", field], LowerThreshold=value, UpperThreshold=value,
                            ThresholdMethod="Between")


def show_bodies(simple, frame, source, view):
    """Each body with edges and in its colours, which have one range for all."""
    shown, largest = [], {}
    for name, number, dimension in frame.bodies:
        entry = part(simple, source, name, frame.of_body, number)
        display = simple.Show(entry, view)
        display.SetRepresentationType("Surface With Edges")
        display.EdgeColor, display.DiffuseColor = DARK, GREY
        field = COLOURED_BY[dimension]
        if field in frame.of_cells:
            shown.append((display, field))
            entry.UpdatePipeline(view.ViewTime)
            array = entry.CellData.GetArray(field)
            largest[field] = max(largest.get(field, 0.0), array.GetRange(0)[1] if array else 0.0)
    highest = max(largest.values(), default=0.0)
    for display, field in shown:
        simple.ColorBy(display, ("CELLS", field))
        simple.GetColorTransferFunction(field).RescaleTransferFunction(0.0, highest or 1.0)
        if largest[field] < highest:  # the other bar has these colours too
            display.SetScalarBarVisibility(view, False)
            continue
        bar = simple.GetScalarBar(simple.GetColorTransferFunction(field), view)
        bar.Title, bar.ComponentTitle = f"von Mises stress [{frame.units.get(field, '')}]", ""
        bar.TitleColor = bar.LabelColor = DARK
        bar.TitleFontSize = bar.LabelFontSize = 14
        bar.HorizontalTitle, bar.ScalarBarLength = 1, 0.4
        display.SetScalarBarVisibility(view, True)


def show_contact(simple, index, frame, view):
    """Contact elements that act as lines: from the foot to the apex, and around the facet."""
    entry = part(simple, opened(simple, index, frame.deformed), "contact that acts", "contact_status", CLOSED)
    display = simple.Show(entry, view)
    display.SetRepresentationType("Wireframe")
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = RED
    display.LineWidth = 3.0
    simple.HideUnusedScalarBars(view)


def main(asked):
    times = times_of(asked.folder / "body.pvd")
    if not times:
        refuse(f"{asked.folder / 'body.pvd'} is not there or lists no frame: NEREID_RUN is to name the folder of a run")
    try:
        from paraview import servermanager, simple
    except ImportError:
        refuse("this Python has no ParaView: run it by pvbatch, or by paraview --script=scripts/paraview_run.py")
    time = times[-1] if asked.time is None else min(times, key=lambda one: abs(one - asked.time))
    view = simple.GetActiveViewOrCreate("RenderView")
    if asked.picture:
        view.ViewSize = PICTURE
    reader = simple.PVDReader(FileName=str((asked.folder / "body.pvd").resolve()))
    reader.UpdatePipeline(times[0])
    frame = Frame(servermanager.Fetch(reader))
    simple.Delete(reader)
    body = opened(simple, asked.folder / "body.pvd", frame.deformed)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = view.ViewTime = time
    show_bodies(simple, frame, body, view)
    if times_of(asked.folder / "contact.pvd"):
        show_contact(simple, asked.folder / "contact.pvd", frame, view)
    label = simple.Show(simple.AnnotateTimeFilter(registrationName="time", Input=body, Format="t = {time:g} s"), view)
    label.Color, label.FontSize = DARK, 18
    view.UseColorPaletteForBackground, view.Background, view.OrientationAxesLabelColor = 0, (1.0, 1.0, 1.0), DARK
    view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = (0, 0, 0), ABOVE, (0, 0, 1)
    simple.ResetCamera(view)
    simple.Render(view)
    if asked.picture:
        simple.SaveScreenshot(str(asked.picture), view, ImageResolution=PICTURE)
        print(asked.picture)


if __name__ == "__main__":
    main(arguments())
