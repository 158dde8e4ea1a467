"""Pictures of a report: bodies in colours of their own, and a field on the bodies at some times, as PNG in memory.

Frames are read by `frames` alone. One camera serves all pictures that are beside each other: parallel projection, z up.
"""
import dataclasses
import importlib.util
import math

import numpy as np

import frames
import screen

# Colours of bodies, light enough for the edges of elements upon them.
BODIES = ((0.36, 0.62, 0.82), (0.93, 0.66, 0.33), (0.45, 0.72, 0.47), (0.86, 0.48, 0.45), (0.66, 0.56, 0.80), (0.70, 0.58, 0.50),
          (0.91, 0.62, 0.80), (0.62, 0.62, 0.62), (0.80, 0.79, 0.36), (0.40, 0.78, 0.82), (0.20, 0.40, 0.62), (0.70, 0.40, 0.12))
WALL = (0.90, 0.90, 0.87)
# From light grey over yellow and red to dark red for what has one sign, so that a print in grey can be read; for what has both signs, from
# blue over grey to red.
ONE_SIDED = ((0.92, 0.92, 0.90), (1.00, 0.91, 0.60), (0.996, 0.76, 0.36), (0.99, 0.56, 0.24), (0.94, 0.30, 0.16), (0.78, 0.10, 0.14),
             (0.55, 0.02, 0.15), (0.30, 0.00, 0.13))
TWO_SIDED = ((0.230, 0.299, 0.754), (0.353, 0.470, 0.895), (0.484, 0.620, 0.975), (0.619, 0.744, 0.999), (0.754, 0.830, 0.961),
             (0.867, 0.865, 0.863), (0.947, 0.795, 0.717), (0.968, 0.674, 0.557), (0.932, 0.519, 0.406), (0.839, 0.322, 0.265),
             (0.706, 0.016, 0.150))
BANDS = 12
VIEWS = ((25.0, 20.0), (115.0, 20.0))  # [degrees] azimuth from -y about z, and elevation of the eye
AREA, NARROWEST, TALLEST = 560_000, 0.42, 0.92  # [pixels] of a picture; limits of its height over its width
MOST_EDGES = 30_000  # elements of a picture whose edges are drawn
PREFERRED = ("von_mises", "pressure", "displacement", "velocity")


class CannotDraw(Exception):
    """There can be no pictures; says why."""


def need_vtk():
    if importlib.util.find_spec("vtk") is None:
        raise CannotDraw("this Python has no VTK (Debian's python3-vtk9)")
    if screen.missing():
        raise CannotDraw(screen.missing())
    screen.use_one_thread()


# ------------------------------------------------------------------------------------------------
# Frames

@dataclasses.dataclass
class Shot:
    """A frame as it stands at its time: `grid` has current points, `body` numbers and `names` of bodies."""
    time: float
    grid: object
    body: np.ndarray
    names: dict
    walls: object = None

    def box(self):
        return np.array(self.grid.GetBounds()).reshape(3, 2)


def shot(run, time, at_start=False):
    """The frame of a run that is nearest to a time; with `at_start` its points are where they were at the start. CannotDraw if damaged."""
    at, file = min(run.frames, key=lambda one: abs(one[0] - time))
    grid = standing(file, at_start=at_start)
    body, names = frames.bodies(grid)
    add_combined(grid)
    walls = None
    if run.walls:
        walls = standing(min(run.walls, key=lambda one: abs(one[0] - at))[1], may_be_empty=True)
    return Shot(at, grid, body, names or dict(enumerate(run.body_names())), walls)


def standing(file, may_be_empty=False, at_start=False):
    """The data of a frame with its points where they are at its time, or at the start."""
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk

    vtk.vtkObject.GlobalWarningDisplayOff()
    data = frames.load(file) if file.is_file() else None
    if data is None or data.GetNumberOfPoints() == 0 or data.GetNumberOfCells() == 0:
        if may_be_empty:
            return None
        raise CannotDraw(f"the frame {file.name} is missing, empty or damaged")
    places = frames.positions(data)[0 if at_start else 1]
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(places), deep=True))
    data.SetPoints(points)
    return data


def add_combined(grid):
    """The von Mises stress of solids and, where elements are plates, that at their top: each is zero where the elements have none."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    found = [grid.GetCellData().GetArray(name) for name in ("von_mises", "von_mises_top")]
    if any(one is None for one in found):
        return
    both = numpy_to_vtk(sum(vtk_to_numpy(one) for one in found), deep=True)
    both.SetName("von_mises")
    grid.GetCellData().AddArray(both)


def fields(grid):
    """{field: (of cells, names of its components)}; numbers of nodes, elements and bodies are none."""
    found = {}
    for attributes, of_cells in ((grid.GetPointData(), False), (grid.GetCellData(), True)):
        for i in range(attributes.GetNumberOfArrays()):
            array, name = attributes.GetArray(i), attributes.GetArrayName(i)
            if array is not None and name and not name.endswith("_id") and name not in ("body", "vtkOriginalCellIds"):
                parts = [array.GetComponentName(c) or str(c) for c in range(array.GetNumberOfComponents())]
                found[name] = of_cells, parts
    return found


def values(grid, field):
    """(values, of cells) of a field as "von_mises" or "stress:XX"; of a vector its magnitude. None if the frame does not have it."""
    from vtkmodules.util.numpy_support import vtk_to_numpy

    name, _, part = field.partition(":")
    there = fields(grid)
    if name not in there:
        return None
    of_cells, parts = there[name]
    array = vtk_to_numpy((grid.GetCellData() if of_cells else grid.GetPointData()).GetArray(name)).astype(float)
    if len(parts) == 1:
        return array, of_cells
    if part in parts:
        return array[:, parts.index(part)], of_cells
    return (np.linalg.norm(array, axis=1), of_cells) if len(parts) == 3 and not part else None


def fault_of_field(grid, field):
    """What is wrong with a field that was asked for; empty if the frame has it."""
    name, _, part = field.partition(":")
    there = fields(grid)
    if name not in there:
        return f"no field is called '{name}'; there are: {', '.join(sorted(there))}"
    if values(grid, field) is None:
        return f"say which component of '{name}' is meant, as in {name}:{there[name][1][0]}; there are: {', '.join(there[name][1])}"
    return ""


def default_field(shots):
    """The first of the preferred fields that is not zero in all of these shots."""
    for name in ("von_mises", "von_mises_top", *PREFERRED[1:]):
        found = [values(one.grid, name) for one in shots]
        if any(one is not None and np.any(np.nan_to_num(one[0]) != 0) for one in found):
            return name
    return ""


def range_of(shots, field):
    """(lowest, highest) of a field in all these shots; a field of vectors or stress of one sign begins at zero."""
    found = [values(one.grid, field)[0] for one in shots if values(one.grid, field) is not None]
    finite = np.concatenate([one[np.isfinite(one)] for one in found]) if found else np.zeros(0)
    if not finite.size:
        return 0.0, 1.0
    low, high = float(finite.min()), float(finite.max())
    if low < 0 < high and min(-low, high) > 1e-3 * max(-low, high):
        return -max(-low, high), max(-low, high)  # both signs: zero is in the middle
    low, high = (0.0, high) if low >= 0 or high > -low else (low, 0.0)
    return (low, high) if high > low else (low, low + 1.0)


# ------------------------------------------------------------------------------------------------
# The camera

class Camera:
    """Parallel projection from a direction, which shows a box [3 x 2] with a margin.

    shape  height of the picture over its width; by default that of the box, within limits
    """

    def __init__(self, view, box, shape=None):
        azimuth, elevation = map(math.radians, view)
        self.towards = np.array([math.sin(azimuth) * math.cos(elevation), -math.cos(azimuth) * math.cos(elevation), math.sin(elevation)])
        self.right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
        self.up = np.cross(self.towards, self.right)
        corners = np.array([[box[0, i], box[1, j], box[2, k]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
        across, along = corners @ self.right, corners @ self.up
        self.centre = box.mean(axis=1)
        self.centre = self.centre + self.right * ((across.min() + across.max()) / 2 - self.centre @ self.right)
        self.centre = self.centre + self.up * ((along.min() + along.max()) / 2 - self.centre @ self.up)
        width, height = np.ptp(across), np.ptp(along)
        self.depth = np.linalg.norm(np.ptp(box, axis=1)) or 1.0
        self.shape = shape = shape or min(max((1.10 * height + 0.02 * width) / (1.06 * width or 1.0), NARROWEST), TALLEST)
        self.size = int(math.sqrt(AREA / shape)), int(math.sqrt(AREA * shape))
        self.half_height = 0.5 * max(1.10 * height, 1.06 * width * shape) or 1.0

    def aim(self, renderer):
        import vtk
        camera = renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(*self.centre)
        camera.SetPosition(*(self.centre + 3 * self.depth * self.towards))
        camera.SetViewUp(*self.up)
        camera.SetParallelScale(self.half_height)
        camera.SetClippingRange(0.01 * self.depth, 12 * self.depth)
        light = vtk.vtkLight()  # from above the eye, so that faces on top are the brightest
        light.SetLightTypeToSceneLight()
        light.SetPosition(*(self.centre + 10 * self.depth * (self.towards + 1.1 * self.up - 0.35 * self.right)))
        light.SetFocalPoint(*self.centre)
        light.PositionalOff()
        renderer.RemoveAllLights()
        renderer.AddLight(light)

    def triad(self):
        """{axis: (right, up)} of the unit vectors as the picture shows them."""
        return {name: (float(self.right[i]), float(self.up[i])) for i, name in enumerate("xyz")}


def box_of(shots):
    boxes = np.array([one.box() for one in shots])
    return np.stack([boxes[:, :, 0].min(axis=0), boxes[:, :, 1].max(axis=0)], axis=1)


# ------------------------------------------------------------------------------------------------
# Pictures

def skin_of(data):
    import vtk
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    surface.Update()
    return surface.GetOutput()


def only(grid, body, wanted):
    """The cells of one body."""
    import vtk
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    picked = vtk.vtkExtractCells()
    picked.SetInputData(grid)
    ids = vtk.vtkIdList()
    array = numpy_to_vtkIdTypeArray(np.flatnonzero(body == wanted).astype(np.int64), deep=True)
    ids.SetNumberOfIds(array.GetNumberOfTuples())
    for i in range(array.GetNumberOfTuples()):
        ids.SetId(i, array.GetValue(i))
    picked.SetCellList(ids)
    picked.Update()
    return picked.GetOutput()


def actor_of(surface, colour=None, edges=False, opacity=1.0):
    import vtk
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetAmbient(0.75), look.SetDiffuse(0.25)  # enough light from everywhere that a face seen from aside keeps its colour
    look.SetOpacity(opacity)
    look.SetEdgeVisibility(edges)
    look.SetEdgeColor(0.30, 0.30, 0.30), look.SetLineWidth(0.6)
    if colour:
        look.SetColor(*colour)
    return actor


def outline_of(surface):
    """Edges of a body where its faces bend by more than 35 degrees, and its rims."""
    import vtk
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.SetFeatureAngle(35)
    edges.BoundaryEdgesOn(), edges.FeatureEdgesOn(), edges.NonManifoldEdgesOff(), edges.ManifoldEdgesOff(), edges.ColoringOff()
    edges.Update()
    actor = actor_of(edges.GetOutput(), (0.15, 0.15, 0.15))
    actor.GetProperty().LightingOff()
    actor.GetProperty().SetLineWidth(1.2)
    return actor


def colours_of(limits):
    import vtk
    low, high = limits
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(BANDS)
    for i, rgb in enumerate(bands(limits)):
        table.SetTableValue(i, *rgb, 1)
    table.SetRange(low, high)
    table.SetNanColor(1, 0, 1, 1)
    return table


def bands(limits):
    """The colours of the bands from the lowest to the highest."""
    points = TWO_SIDED if limits[0] < 0 else ONE_SIDED
    found = []
    for i in range(BANDS):
        at = i / (BANDS - 1) * (len(points) - 1)
        k = min(int(at), len(points) - 2)
        found.append(tuple(a + (at - k) * (b - a) for a, b in zip(points[k], points[k + 1])))
    return found


def drawn(draw, *what):
    """A picture as PNG, drawn in a process of its own; CannotDraw if that fails."""
    try:
        return screen.drawn(lambda: draw(*what))
    except screen.NotDrawn as error:
        raise CannotDraw(error) from error


def of_bodies(one, camera):
    """A picture of a shot with each body in its colour, and walls in light grey."""
    return drawn(draw_bodies, one, camera)


def of_field(one, field, limits, camera):
    """A picture of a shot in the colours of a field; light grey if the shot does not have it."""
    return drawn(draw_field, one, field, limits, camera)


def draw_bodies(one, camera):
    edges = one.grid.GetNumberOfCells() <= MOST_EDGES
    actors = []
    for body in np.unique(one.body):
        surface = skin_of(only(one.grid, one.body, body))
        actors += [actor_of(surface, BODIES[body % len(BODIES)], edges), outline_of(surface)]
    return render(with_walls(actors, one), camera)


def draw_field(one, field, limits, camera):
    from vtkmodules.util.numpy_support import numpy_to_vtk

    found = values(one.grid, field)
    if found is not None:
        array = numpy_to_vtk(np.ascontiguousarray(found[0]), deep=True)
        array.SetName("drawn")
        (one.grid.GetCellData() if found[1] else one.grid.GetPointData()).AddArray(array)
    actors = []
    for body in np.unique(one.body):
        surface = skin_of(only(one.grid, one.body, body))
        actor = actor_of(surface, (0.8, 0.8, 0.8))
        if found is not None:
            mapper = actor.GetMapper()
            mapper.ScalarVisibilityOn()
            mapper.SetScalarModeToUseCellFieldData() if found[1] else mapper.SetScalarModeToUsePointFieldData()
            mapper.SelectColorArray("drawn")
            mapper.SetLookupTable(colours_of(limits))
            mapper.SetInterpolateScalarsBeforeMapping(not found[1])
            mapper.UseLookupTableScalarRangeOn()
        actors += [actor, outline_of(surface)]
    return render(with_walls(actors, one), camera)


def with_walls(actors, one):
    return actors + ([actor_of(skin_of(one.walls), WALL, opacity=0.5)] if one.walls is not None else [])


def render(actors, camera):
    """The bytes of a PNG."""
    import vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy

    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*camera.size)
    window.AddRenderer(renderer)
    camera.aim(renderer)
    window.Render()
    taken = vtk.vtkWindowToImageFilter()
    taken.SetInput(window)
    taken.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.WriteToMemoryOn()
    writer.SetInputConnection(taken.GetOutputPort())
    writer.Write()
    return vtk_to_numpy(writer.GetResult()).tobytes()
