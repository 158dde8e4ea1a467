"""What a verification case ran, for the report: program, case file, bodies, contacts and loads, and a picture of the bodies at the start.

All comes from the folder of a kept run: summary.json, asked.json and the first frame. Tables, colours and camera are those of
scripts/report. The picture is SVG: facets of the skins in parallel projection, the farthest first. It needs VTK to read the frame, and no
screen.
"""
import importlib.util
import math

import numpy as np

import frames
import report_pictures as pictures
from report_run import Run
from report_scene import LISTS, body_table, parts_table, rgb, triad
from report_text import engineering, esc, folded, missing, picture, quantity, table
from runs import record_of

WIDTH = 640          # [pixels] of a picture
MOST_ROWS = 12       # of the legend and of open tables
BETWEEN_MARKS = 100  # [tenths of a pixel] between nodes of a support that are drawn
MOST_ARROWS = 12     # of a body whose nodes have unlike velocities
ALIKE = 0.8          # part of the nodes of a body with one velocity, for which one arrow stands
TOO_SMALL = 40       # [tenths of a pixel]
MOST_PIECES = 6000   # into which large facets are cut
LONGEST_ARROW = 0.2  # of the width
SHADES = 8
NOTHING = 1e-6       # [-] of a size
AT_REST = 1e-9       # [m/s] and slower: round-off of a start
NO_BODIES = {"material_point": "the program computes one point of a material, which has no shape",
             "contact_elements": "the program computes contact elements with random positions, and no bodies",
             "penalty_oscillator": "the program computes the masses of one contact element, and no bodies"}
KINDS = {"check": ("check", "checks"), "report": ("report", "reports"), "miss": ("known miss", "known misses"),
         "falls": ("study", "studies"), "table": ("table", "tables"), "breaks": ("break", "breaks")}
CELLS = {12: ("hexahedron", "hexahedra"), 5: ("triangle of plates", "triangles of plates"), 9: ("quadrilateral", "quadrilaterals"),
         10: ("tetrahedron", "tetrahedra"), 13: ("wedge", "wedges"), 14: ("pyramid", "pyramids")}  # as VTK numbers kinds of cells
MARKS = {"fixed": ("#7a0f14", "fixed"), "driven": ("#7b2fa0", "driven"), "symmetry": ("#0b4f8a", "on a plane of symmetry"),
         "constrained": ("#0b4f8a", "held along a direction"), "floor": ("#555555", "that a floor may stop")}


class BaseRun(Run):
    """A kept run without its histories."""

    def read_history(self):
        return "", {}, {}, set()


def what_ran(folder, out):
    """The block of a case, as HTML.

    folder  of the runs; the names in out.folders are of folders in it, the first is the base run
    """
    said = [f"<p>{program_and_case(folder, out)}</p>"]
    base = folder / out.folders[0] if out.folders else None
    if base is None and not out.runs:
        said.append(missing("No run was finished, so nothing is known of bodies, contacts and loads."))
    elif base is None or not (base / "summary.json").is_file():
        lost = f"The run {esc(base.name)} is no longer kept." if base else "The outcome does not name its runs."
        said.append(missing(f"{lost} <code>scripts/verify {out.name}</code> makes them again."))
    else:
        run = BaseRun(base, out.name, out.name)
        said += [f"<p>{extent_of(run)}</p>", *set_up(run)]
    return "\n".join(["<h3>What was run</h3>", *said, not_run(out)])


def program_and_case(folder, out):
    """Program and case file, keys that are set in the base run, and the number of runs."""
    settings = (record_of(folder / out.folders[0]) or {}).get("settings", {}) if out.folders else {}
    changed = ", ".join(f"<code>{esc(key)}={esc(value)}</code>" for key, value in settings.items())
    said = f"Program <code>{esc(out.program or 'unknown')}</code>, case <code>{esc(out.case or 'unknown')}</code>"
    said += f", with {changed} set." if changed else "."
    if out.runs > 1:
        said += f" This base run is one of {out.runs} runs of the {out.level} level; the others set other keys or have other case files."
    return said


def extent_of(run):
    """Time simulated and steps of a run; how it ended where that is not its end."""
    cost, parts = run.cost(), []
    if run.over_time and cost.get("steps"):
        parts.append(f"simulated time {quantity(run.end, 's')}, {cost['steps']:,} steps")
    if cost.get("elements"):
        parts.append(f"{cost['elements']:,} elements")
    if cost.get("threads"):
        parts.append(f"{cost['threads']} thread{'s' if cost['threads'] != 1 else ''}")
    ended = "" if run.good else f" It ended as <code>{esc(run.word or 'unknown')}</code>: {esc(run.reason())}."
    return f"Base run: {', '.join(parts)}.{ended}" if parts else f"Base run: no steps in time.{ended}"


def not_run(out):
    """What the case has and the level leaves out."""
    lines = []
    for kind, words in KINDS.items():
        names = [name for one, name in out.left_out if one == kind]
        lines += [f"<li>{len(names)} {words[len(names) != 1]}: {'; '.join(map(esc, names))}.</li>"] if names else []
    return folded(f"Left out at the {out.level} level", f"<ul class=quiet>{''.join(lines)}</ul>") if lines else ""


# ------------------------------------------------------------------------------------------------
# Set-up

def set_up(run):
    """Picture, and tables of what the case says."""
    driver = run.summary.get("driver", "")
    try:
        if driver in NO_BODIES:
            raise pictures.CannotDraw(NO_BODIES[driver])
        parts = [drawing(run, first_shot(run))]
    except (pictures.CannotDraw, frames.CannotRead) as error:
        parts = [missing(f"There is no picture of the set-up: {esc(error)}.")]
    except Exception as error:  # a frame may hold anything, and the page has other cases
        parts = [missing(f"The picture of the set-up could not be drawn: {esc(type(error).__name__)}: {esc(error)}.")]
    if run.items("bodies"):
        parts.append(shortened("Bodies", body_table(run, None)))
    if driver not in NO_BODIES:
        parts.append(shortened("Contacts, planes and loads", parts_table(run)))
    if not any(run.items(section) for section in ("bodies", *LISTS)):
        parts.append(shortened("Values of the case", value_table(run)))
    return parts


def shortened(title, rows):
    """A table, folded if it is long."""
    count = rows.count("<tr") - rows.count("<thead>")
    return folded(f"{title}: {count} rows", rows) if count > MOST_ROWS else rows


def value_table(run):
    """What the case of a program without lists of bodies says, a line for each section; defaults are left out."""
    sections = {}
    for path, (value, default) in run.values().items():
        if not default:
            section, _, key = path.partition(".")
            sections.setdefault(section, []).append(f"{key} {engineering(value)}".strip())
    rows = [[f"<code>{esc(section)}</code>", esc(", ".join(words))] for section, words in sections.items()]
    return table(["", "what the case says, defaults left out"], rows, "tt", "Values of the case.") if rows else ""


def first_shot(run):
    """The first frame with its points where they were at the start."""
    if importlib.util.find_spec("vtk") is None:
        raise pictures.CannotDraw("this Python has no VTK (Debian's python3-vtk9)")
    if not run.frames:
        raise pictures.CannotDraw("the run has no frames of bodies")
    one = pictures.shot(run, run.frames[0][0], at_start=True)
    one.names = one.names or dict(enumerate(item["name"][0] for item in run.items("bodies") if "name" in item))
    return one


def drawing(run, one):
    """The figure: picture, axes, and a legend with the size of each mesh."""
    moves = moving_bodies(one) if run.over_time else []
    camera = camera_of(one, moves)
    marks, unmarked = marks_of(run, one)
    svg = svg_of(one, camera, moves, marks)
    shown = picture(svg.encode(), "svg+xml", f"set-up of {run.name}")
    return f"<div class=shot>{shown}{triad(camera)}</div><p class=legend>{legend(one)}{notes(one, camera, moves, marks, unmarked)}</p>"


def legend(one):
    """A swatch for each body, with its numbers of nodes and elements; if there are many, bodies with the same numbers share a line."""
    bodies = np.unique(one.body)
    groups = [[body] for body in bodies]
    if len(bodies) > MOST_ROWS:
        alike = {}
        for body in bodies:
            alike.setdefault(mesh_words(one, body), []).append(body)
        groups = list(alike.values())
    said = []
    for group in groups:
        swatches = "".join(f"<span class=swatch style='background:{rgb(colour_of(body))}'></span>" for body in group[:MOST_ROWS])
        names = esc(frames.name_of(group[0], one.names)) + (f" … {esc(frames.name_of(group[-1], one.names))}" if len(group) > 1 else "")
        each = f" each, {len(group)} bodies" if len(group) > 1 else ""
        said.append(f"<span class=whole>{swatches}{names}:</span> {mesh_words(one, group[0])}{each}")
    return "; ".join(said) + "."


def mesh_words(one, body):
    """Numbers of nodes and elements of a body, and kinds of elements."""
    cells = cells_of(one, body)
    kinds = [f"{count:,} {CELLS.get(kind, ('cell', 'cells'))[count != 1]}" for kind, count in sorted(count_of(cells.kinds).items())]
    return f"{len(cells.nodes):,} nodes, {' and '.join(kinds)}"


def count_of(values):
    return {int(value): int(count) for value, count in zip(*np.unique(values, return_counts=True))}


class Cells:
    """The cells of one body: their kinds, and the numbers of the nodes that they have."""

    def __init__(self, grid):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        self.kinds = vtk_to_numpy(grid.GetCellTypesArray())
        self.nodes = np.unique(vtk_to_numpy(grid.GetCells().GetConnectivityArray()))
        self.places = vtk_to_numpy(grid.GetPoints().GetData())[self.nodes]
        moved = grid.GetPointData().GetArray("velocity")
        self.speeds = vtk_to_numpy(moved)[self.nodes] if moved is not None else np.zeros_like(self.places)


def cells_of(one, body):
    return Cells(pictures.only(one.grid, one.body, body))


def colour_of(body):
    return pictures.BODIES[body % len(pictures.BODIES)]


def notes(one, camera, moves, marks, unmarked):
    """What arrows and dots are, and what cannot be seen."""
    said, page = [], Page(camera)
    small = [frames.name_of(body, one.names) for body in np.unique(one.body)
             if np.ptp(page.at(cells_of(one, body).places), axis=0).max() < TOO_SMALL]
    if small:
        said.append(f"Too small to be seen: {esc(', '.join(small))}.")
    if one.walls is not None:
        said.append("Light faces without cells: rigid planes and floors.")
    if moves:
        fastest = max(float(np.linalg.norm(speed)) for _, speed in moves)
        said.append(f"Arrows: velocities at the start, the longest {quantity(fastest, 'm/s', 4)}.")
    for kind in dict.fromkeys(kind for kind, _, _ in marks):
        names = ", ".join(dict.fromkeys(name for of, name, _ in marks if of == kind))
        said.append(f"<span class=dot style='background:{MARKS[kind][0]}'></span> Nodes {MARKS[kind][1]} ({esc(names)}).")
    if unmarked:
        said.append(f"Supports without a mark: {esc(', '.join(dict.fromkeys(unmarked)))}.")
    return "".join(f" {one_note}" for one_note in said)


# ------------------------------------------------------------------------------------------------
# What is marked

def moving_bodies(one):
    """[(place, velocity)] of arrows: one for a body most of whose nodes have one velocity, some for any other that moves."""
    found = []
    for body in np.unique(one.body):
        cells = cells_of(one, body)
        sizes = np.linalg.norm(cells.speeds, axis=1)
        if not np.all(np.isfinite(sizes)) or sizes.max() < AT_REST:
            continue
        usual = np.median(cells.speeds, axis=0)
        if np.mean(np.linalg.norm(cells.speeds - usual, axis=1) <= 1e-3 * sizes.max()) >= ALIKE:
            if np.any(usual):
                found.append((0.5 * (cells.places.min(axis=0) + cells.places.max(axis=0)), usual))
        else:
            moving = np.flatnonzero(sizes > 0.1 * sizes.max())
            found += [(cells.places[i], cells.speeds[i]) for i in moving[spread(cells.places[moving], MOST_ARROWS)]]
    return found


def spread(places, most):
    """Numbers of some places that are far from each other: each is the one farthest from those before it."""
    chosen, away = [0], np.linalg.norm(places - places[0], axis=1)
    while len(chosen) < min(most, len(places)):
        chosen.append(int(np.argmax(away)))
        away = np.minimum(away, np.linalg.norm(places - places[chosen[-1]], axis=1))
    return chosen


def marks_of(run, one):
    """([(kind, name of the plane, places of its nodes)], names of planes whose nodes have an unknown place)."""
    marks, unmarked = [], []
    said = {item["name"][0]: item for item in run.items("bodies") if "name" in item}
    places = {}
    for body in np.unique(one.body):
        name = frames.name_of(body, one.names).partition(".")[0]
        places.setdefault(name, []).append(cells_of(one, body).places)
    for plane in run.resolved().get("planes", []):
        kind, name = plane.get("kind", {}).get("value"), plane.get("name", {}).get("value", "")
        for nodes in plane.get("nodes", {}).get("value", []) if kind in MARKS else []:
            body, _, part = nodes.partition(".")
            item = next((one_body for one_body in run.resolved()["bodies"] if one_body["name"]["value"] == body), None)
            found = nodes_of(np.concatenate(places[body]), part, item) if body in places and body in said else None
            if found is None:
                unmarked.append(nodes)
            else:
                marks.append((kind, name, found))
    return marks, unmarked


def nodes_of(places, part, body):
    """Places of the nodes of a node set, by its name and the mesh of its body; None where that does not say it."""
    if not part:
        return places
    point = next((point for point in body.get("points", []) if point["name"]["value"] == part), None)
    if point:
        return places[[int(np.argmin(np.linalg.norm(places - np.array(point["near"]["value"]), axis=1)))]]
    mesh = body["mesh"]["kind"]["value"]
    if mesh == "file" or "rotate" in body or "map" in body["mesh"] or any(one["name"]["value"] == part for one in body.get("sets", [])):
        return None
    move, near = np.array(body.get("move", {}).get("value", [0.0] * 3)), NOTHING * np.ptp(places, axis=0).max()
    axis, _, end = part.partition("_")
    if mesh in ("box", "sheet") and axis in ("x", "y", "z") and end in ("low", "high"):
        along = places[:, "xyz".index(axis)]
        level = along.min() if end == "low" else along.max()
    elif axis in ("x", "y", "z") and end == "plane":
        along = places[:, "xyz".index(axis)]
        level = move["xyz".index(axis)]
    elif mesh in ("cylinder", "tube", "sector") and part in ("bottom", "top"):
        along = places[:, 2]
        level = along.min() if part == "bottom" else along.max()
    elif mesh == "disc" and part == "rim":
        along = np.hypot(*(places - move)[:, :2].T)
        level = along.max()
    else:
        return None
    return places[np.abs(along - level) <= near]


# ------------------------------------------------------------------------------------------------
# The picture

class Page:
    """Where a camera shows places on the picture, in tenths of a pixel."""

    def __init__(self, camera):
        self.camera, self.wide = camera, 10 * WIDTH
        self.high = round(self.wide * camera.shape)
        self.scale = 0.5 * self.high / camera.half_height

    def at(self, places):
        """[n x 2] of places [n x 3]."""
        away = np.asarray(places, float) - self.camera.centre
        return np.stack([0.5 * self.wide + self.scale * (away @ self.camera.right),
                         0.5 * self.high - self.scale * (away @ self.camera.up)], axis=-1)


def camera_of(one, moves):
    """A camera that shows the bodies and the arrows."""
    camera = pictures.Camera(pictures.VIEWS[0], one.box())
    longest = LONGEST_ARROW * 2 * camera.half_height / camera.shape / max((np.linalg.norm(speed) for _, speed in moves), default=1.0)
    places = np.array([*one.box().T, *(place + longest * speed for place, speed in moves)])
    return pictures.Camera(pictures.VIEWS[0], np.stack([places.min(axis=0), places.max(axis=0)], axis=1))


def svg_of(one, camera, moves=(), marks=()):
    """The text of a picture: walls, facets, marks of nodes, arrows."""
    page = Page(camera)
    behind, before = walls_of(one, camera)
    parts = [f"<rect width='{page.wide}' height='{page.high}' fill='white'/>", *(wall(page, corners, 1.0) for corners in behind),
             *facets_of(one, page), *(wall(page, corners, 0.35) for corners in before)]
    for kind, _, places in marks:
        shown = page.at(places)
        _, apart = np.unique(np.rint(shown / BETWEEN_MARKS), axis=0, return_index=True)
        dots = "".join(f"M{x:.0f} {y:.0f}h0" for x, y in shown[apart])
        parts.append(f"<path d='{dots}' stroke='white' stroke-width='62' stroke-linecap='round'/>"
                     f"<path d='{dots}' stroke='{MARKS[kind][0]}' stroke-width='44' stroke-linecap='round'/>")
    fastest = max((float(np.linalg.norm(speed)) for _, speed in moves), default=1.0)
    parts += [arrow(page, place, speed / fastest) for place, speed in moves]
    return (f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {page.wide} {page.high}' width='{WIDTH}' height='{page.high // 10}' "
            f"fill='none' stroke-linejoin='round'>" + "".join(parts) + "</svg>")


def walls_of(one, camera):
    """Corners of walls behind the bodies and of those before them."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    behind, before = [], []
    if one.walls is None:
        return behind, before
    places = vtk_to_numpy(one.walls.GetPoints().GetData())
    number = vtk_to_numpy(one.walls.GetCellData().GetArray("wall_id"))
    nodes = vtk_to_numpy(one.walls.GetPolys().GetConnectivityArray()).reshape(len(number), -1)
    middle = one.box().mean(axis=1)
    for wall_id in np.unique(number):
        corners = np.unique(places[nodes[number == wall_id].ravel()], axis=0)
        centre = corners.mean(axis=0)
        first, *_, last = places[nodes[number == wall_id][0]]
        normal = np.cross(places[nodes[number == wall_id][0]][1] - first, last - first)
        normal = normal if normal @ (middle - centre) >= 0 else -normal
        right = (corners[0] - centre) / (np.linalg.norm(corners[0] - centre) or 1.0)
        up = np.cross(normal / (np.linalg.norm(normal) or 1.0), right)
        order = np.argsort(np.arctan2((corners - centre) @ up, (corners - centre) @ right))
        (behind if normal @ camera.towards >= 0 else before).append(corners[order])
    return behind, before


def wall(page, corners, opacity):
    return f"<path d='{outline(page.at(corners))}' fill='{rgb(pictures.WALL)}' stroke='#a0a098' stroke-width='8' opacity='{opacity}'/>"


def outline(corners):
    """A closed line of SVG in whole numbers."""
    whole = np.rint(corners).astype(int)
    return f"M{whole[0][0]} {whole[0][1]}l" + " ".join(f"{x} {y}" for x, y in np.diff(whole, axis=0)) + "z"


def facets_of(one, page):
    """The facets that can be seen, the farthest first; of solids those that face the eye."""
    corners, colours = [], []
    light = page.camera.towards + 1.1 * page.camera.up - 0.35 * page.camera.right
    light /= np.linalg.norm(light)
    for body in np.unique(one.body):
        for of_body in skin(one, body):
            normal = np.cross(of_body[:, 2] - of_body[:, 0], of_body[:, -1] - of_body[:, 1])
            normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
            facing = normal @ page.camera.towards
            seen = facing > NOTHING if of_solids(one, body) else np.ones(len(facing), bool)
            bright = np.abs((normal * np.sign(facing)[:, None]) @ light)
            shade = 0.78 + 0.24 * np.rint(SHADES * np.clip(bright, 0, 1)) / SHADES
            corners += list(of_body[seen])
            colours += [rgb(min(1.0, part * one_shade) for part in colour_of(body)) for one_shade in shade[seen]]
    edges = [(True,) * 4] * len(corners)
    if len(np.unique(one.body)) > 1:
        corners, colours, edges = cut_large(corners, colours, page)
    order = np.argsort([float(np.mean(one_facet @ page.camera.towards)) for one_facet in corners], kind="stable")
    return [facet(page.at(corners[i]), colours[i], edges[i]) for i in order]


def skin(one, body):
    """The facets of the skin of a body: arrays [n x 3 x 3] of triangles and [n x 4 x 3] of quadrilaterals."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    surface = pictures.skin_of(pictures.only(one.grid, one.body, body))
    places = vtk_to_numpy(surface.GetPoints().GetData())
    nodes, starts = (vtk_to_numpy(part) for part in (surface.GetPolys().GetConnectivityArray(), surface.GetPolys().GetOffsetsArray()))
    counts = np.diff(starts)
    return [places[nodes[starts[:-1][counts == k][:, None] + np.arange(k)]] for k in (3, 4) if np.any(counts == k)]


def of_solids(one, body):
    """Whether a body has no plates: then only its outside can be seen."""
    return not set(cells_of(one, body).kinds.tolist()) & {5, 9}


def cut_large(corners, colours, page):
    """The same facets; those much larger than the small ones are cut, so that the farthest can be told piece by piece."""
    sizes = np.array([max(np.linalg.norm(np.roll(one, 1, axis=0) - one, axis=1)) for one in corners])
    longest = max(0.04 * page.wide / page.scale, 2 * float(np.quantile(sizes, 0.1)))
    while np.sum(np.ceil(sizes / longest)**2) > len(corners) + MOST_PIECES:
        longest *= 1.3
    found = [], [], []
    for one, colour, size in zip(corners, colours, sizes):
        for piece, edges in pieces(one, longest) if size > longest else [(one, (True,) * 4)]:
            for part, value in zip(found, (piece, colour, edges)):
                part.append(value)
    return found


def pieces(corners, longest):
    """[(four corners, which of their four sides are sides of the facet)]; a triangle is a facet whose last two corners are the same."""
    a, b, c, d = corners if len(corners) == 4 else (*corners, corners[2])
    across = max(1, math.ceil(max(np.linalg.norm(b - a), np.linalg.norm(c - d)) / longest))
    along = max(1, math.ceil(max(np.linalg.norm(d - a), np.linalg.norm(c - b)) / longest))
    u, v = np.meshgrid(np.linspace(0, 1, across + 1), np.linspace(0, 1, along + 1), indexing="ij")
    u, v = u[..., None], v[..., None]
    grid = (1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d
    return [(np.array([grid[i, j], grid[i + 1, j], grid[i + 1, j + 1], grid[i, j + 1]]),
             (j == 0, i == across - 1, j == along - 1, i == 0)) for i in range(across) for j in range(along)]


def facet(corners, colour, edges):
    """A facet, or a piece of one with those of its sides that are sides of the facet; the narrower it is, the thinner they are."""
    sides = np.roll(corners, -1, axis=0) - corners
    area = 0.5 * abs(float(np.sum(corners[:, 0] * np.roll(corners[:, 1], -1) - np.roll(corners[:, 0], -1) * corners[:, 1])))
    width = min(8.0, 0.12 * area / (float(np.linalg.norm(sides, axis=1).max()) or 1.0))
    if all(edges):
        return f"<path d='{outline(corners)}' fill='{colour}' stroke='#404040' stroke-width='{width:.1f}'/>"
    drawn = "".join(f"M{x0:.0f} {y0:.0f}l{x:.0f} {y:.0f}" for (x0, y0), (x, y), edge in zip(corners, sides, edges) if edge)
    return (f"<path d='{outline(corners)}' fill='{colour}' stroke='{colour}' stroke-width='6'/>"
            + (f"<path d='{drawn}' stroke='#404040' stroke-width='{width:.1f}'/>" if drawn else ""))


def arrow(page, place, speed):
    """An arrow at a place; a speed of 1 has the longest. One that points at the eye is a dot."""
    start = page.at([place])[0]
    way = np.array([speed @ page.camera.right, -(speed @ page.camera.up)]) * LONGEST_ARROW * page.wide
    length = float(np.linalg.norm(way))
    if length < 0.02 * page.wide:
        return f"<circle cx='{start[0]:.0f}' cy='{start[1]:.0f}' r='50' fill='#b00020' stroke='white' stroke-width='15'/>"
    along, aside = way / length, np.array([-way[1], way[0]]) / length
    head = min(140.0, 0.5 * length)
    neck, tip = start + (length - head) * along, start + way
    line = f"M{start[0]:.0f} {start[1]:.0f}L{neck[0]:.0f} {neck[1]:.0f}"
    point = outline(np.array([tip, neck + 0.4 * head * aside, neck - 0.4 * head * aside]))
    return (f"<path d='{line}' stroke='white' stroke-width='62'/><path d='{point}' fill='#b00020' stroke='white' stroke-width='30'/>"
            f"<path d='{line}' stroke='#b00020' stroke-width='34'/><path d='{point}' fill='#b00020'/>")
