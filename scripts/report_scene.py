"""Set-up and pictures of a report: bodies and what the case says of them, and a field on the bodies at some times."""
import math
import sys

import numpy as np

import frames
import report_pictures as pictures
from report_text import (anchor, engineering, esc, folded, missing, named, picture, plain_quantity, quantity, run_heading, scale_of,
                         table, tag)

MOST_PICTURES = 6  # of a run that has no times
NOTHING = 1e-9     # of the largest length: less is round-off


class Wanted:
    """What of the runs is on the page."""

    def __init__(self, title="", times=(), field="", probes=(), with_pictures=True):
        self.title, self.times, self.field, self.probes, self.with_pictures = title, list(times), field, list(probes), with_pictures


# ------------------------------------------------------------------------------------------------
# Set-up

def set_up(runs, wanted):
    parts, starts = [], {}
    for run in runs:
        try:
            starts[run.key] = first_shot(run, wanted)
        except pictures.CannotDraw as error:
            parts.append(missing(f"{tag(run)}There is no picture of the set-up: {esc(error)}."))
    drawn = [run for run in runs if run.key in starts]
    if len(runs) == 1:
        parts += [views_of(run, starts[run.key]) for run in drawn]
        return "".join([*parts, said_of(runs[0], starts.get(runs[0].key))])
    boxes = [box_of_start(starts[run.key], pictures.VIEWS[0], f"set-up of {run.name}", f"{named(run)}: {size_of(starts[run.key])}")
             for run in drawn]
    parts.append(f"<div class='row {'two' if len(boxes) in (2, 4) else 'three'}'>" + "".join(boxes) + "</div>")
    first = {}
    for run in runs:
        text = said_of(run, starts.get(run.key))
        same = first.setdefault((text.replace(f"id='{run.key}-", "id='"), values_of_set_up(run)), run)
        parts.append(folded(f"Bodies, contacts and loads of {named(run)}" + ("" if same is run else f", the same as of {same.key}"), text,
                            same is run))
    return "".join(parts)


def values_of_set_up(run):
    """All values of a case that are about its bodies, contacts and loads, also those that the tables leave out."""
    return tuple((path, value) for path, (value, _) in run.values().items() if not path.startswith(NOT_OF_SET_UP))


def views_of(run, start):
    shape = max(pictures.Camera(view, start.box()).shape for view in pictures.VIEWS)
    boxes = [box_of_start(start, view, f"set-up of {run.name}, view {i + 1}", shape=shape) for i, view in enumerate(pictures.VIEWS)]
    what = "first frame" if run.over_time else "state at rest"
    return f"<div class='row two'>{''.join(boxes)}</div><p class=quiet>The {what} from two directions; {size_of(start)}.</p>"


def box_of_start(start, view, alt, caption="", shape=None):
    camera = pictures.Camera(view, start.box(), shape)
    return framed(lambda: pictures.of_bodies(start, camera), camera, alt, caption)


def size_of(start):
    lengths = np.ptp(start.box(), axis=1)
    none = f"0 {scale_of(float(lengths.max()), 'm')[1]}"
    size = " × ".join(plain_quantity(float(one), "m", 4) if one > NOTHING * lengths.max() else none for one in lengths)
    return f"the bodies extend over {size} along x, y and z"


def said_of(run, start):
    """What the case says, in tables."""
    text = body_table(run, start) + parts_table(run)
    if run.resolved() and not any(run.items(section) for section in ("bodies", *LISTS)):
        text += f"<p>What the case says is in <a href='#{esc(anchor(run, 'case'))}'>the table of its values</a>.</p>"
    return text


def first_shot(run, wanted):
    if not wanted.with_pictures:
        raise pictures.CannotDraw("pictures were not asked for (--quick)")
    if not run.frames:
        raise pictures.CannotDraw("the run has no frames of bodies")
    pictures.need_vtk()
    return pictures.shot(run, run.frames[0][0], at_start=not run.over_time)


def framed(draw, camera, alt, caption=""):
    """A picture with the axes in its corner; if it cannot be drawn, the page and stderr say why."""
    said = f"<figcaption>{caption}</figcaption>" if caption else ""
    try:
        inner = picture(draw(), "png", alt)
    except pictures.CannotDraw as error:
        print(f"report: no picture '{alt}': {error}", file=sys.stderr)
        return f"<div>{missing(f'This picture could not be drawn: {esc(error)}.')}{said}</div>"
    return f"<div><div class=shot>{inner}{triad(camera)}</div>{said}</div>"


def triad(camera):
    lines = []
    for (name, (right, up)), colour in zip(camera.triad().items(), ("#b02020", "#1d7a2e", "#2040b0")):
        if math.hypot(right, up) < 0.15:
            continue
        x, y = 26 + 18 * right, 26 - 18 * up
        place = f"x='{26 + 24 * right:.1f}' y='{29 - 24 * up:.1f}'"
        lines.append(f"<line x1='26' y1='26' x2='{x:.1f}' y2='{y:.1f}' stroke='{colour}' stroke-width='2'/>"
                     f"<text {place} font-size='10' text-anchor='middle' fill='{colour}'>{name}</text>")
    return f"<svg class=triad width='56' height='54' viewBox='0 0 56 54' aria-label='axes'>{''.join(lines)}</svg>"


def rgb(colour):
    return "#" + "".join(f"{round(255 * one):02x}" for one in colour)


def body_table(run, start):
    """Bodies with their colours, and what the case says of them."""
    said = {item["name"][0]: item for item in run.items("bodies") if "name" in item}
    names = start.names if start and start.names else dict(enumerate(run.body_names() or said))
    numbers = list(np.unique(start.body)) if start else range(len(names))
    if not len(numbers):
        return ""
    rows = []
    for i in numbers:
        name = frames.name_of(i, names)
        item = said.get(name, said.get(name.partition(".")[0], {}))
        swatch = f"<span class=swatch style='background:{rgb(pictures.BODIES[i % len(pictures.BODIES)])}'></span>" if start else ""
        kind = item.get("material.kind", item.get("material", ("", True)))[0]
        settings = [f"{key.removeprefix('material.')} {engineering(value)}" for key, (value, default) in item.items()
                    if key.startswith("material.") and key != "material.kind" and not default]
        elements = str(int(np.count_nonzero(start.body == i))) if start else ""
        said_of_material = esc(kind) + (", rigid" if is_rigid(item) else "")
        rows.append((anchor(run, f"source-{name}"), [f"<span class=whole>{swatch}{esc(name)}</span>", elements, said_of_material,
                                                     esc(", ".join(settings)), esc(words_of(item, "element.")), esc(mesh_words(item)),
                                                     esc(other_words(item))]))
    more = " Colours repeat after the twelfth body." if start and len(rows) > len(pictures.BODIES) else ""
    return table(["body", "elements", "material", "", "options of elements", "mesh", "other"], rows, "tnttttt",
                 f"Bodies, with what the case says of them; defaults are left out.{more}")


def is_rigid(item):
    return item.get("rigid", ("false", True))[0] == "true"


def mesh_words(item):
    """The kind of a mesh and what else is said of it; the hash of its file is among the values of the case."""
    kind, default = item.get("mesh.kind", ("", True))
    rest = words_of({key: one for key, one in item.items() if key not in ("mesh.kind", "mesh.path_file")}, "mesh.")
    return ", ".join(filter(None, ["" if default else kind, rest]))


def other_words(item):
    """What is said of a body and is neither its material nor its elements nor its mesh."""
    return words_of({key: one for key, one in item.items() if key not in ("name", "rigid", "material")
                     and not key.startswith(("material.", "element.", "mesh."))})


def words_of(item, part=""):
    """What the case says in the values of an item whose keys begin so, as "thickness 2 mm, layers 5"; without defaults."""
    return ", ".join(f"{key.removeprefix(part)} {engineering(value)}" for key, (value, default) in item.items()
                     if key.startswith(part) and not default)


NOT_OF_SET_UP = "time.", "output.", "probes[", "modes.", "stop["
LISTS = ("contacts", "planes", "loads", "springs", "point_masses", "initial", "sections", "stages", "stop")
WORDS_OF_KINDS = {"interface": "contact", "rigid_plane": "rigid plane", "block": "body"}


def part_of(run, name):
    """What an account is that is in no list of the case."""
    if name == "gravity":
        return esc(run.values().get(name, ("", True))[0])
    if name == "relaxation":
        is_said = any(path.startswith("relaxation.") for path in run.values())
        return esc(words_of(run.values(), "relaxation.") or "defaults only") if is_said else "in a stage" if run.items("stages") else ""
    for end, words in (("_back", "the other pass of"), ("_edges", "edges on edges of")):
        if name.endswith(end):
            return f"{words} {esc(name.removesuffix(end))}"
    return ""


def parts_table(run):
    """Contacts, planes, loads and the like, with what the case says of them that is no default; else the sources of the ledger."""
    rows, shown = [], set()
    for section in LISTS:
        for item in run.items(section):
            name = item.get("name", ("", True))[0]
            shown.add(name)
            words = words_of({key: one for key, one in item.items() if key != "name"})
            cells_of = [section.replace("_", " ").removesuffix("s") if section not in ("initial", "stop") else section, esc(name),
                        esc(words)]
            rows.append((anchor(run, f"source-{name}"), cells_of) if name else cells_of)
    bodies = set(run.body_names())
    for name, account in run.accounts().items():
        if name not in shown and name not in bodies:
            kind = str(account.get("kind", ""))
            rows.append((anchor(run, f"source-{name}"), [WORDS_OF_KINDS.get(kind, kind).replace("_", " "), esc(name), part_of(run, name)]))
    if not rows:
        return "" if run.summary else "<p class=quiet>Names, materials, contacts and loads are unknown, since they are in summary.json.</p>"
    return table(["", "name", "what the case says, defaults left out"], rows, "ttt", "Contacts, planes, loads and other sources of force.")


# ------------------------------------------------------------------------------------------------
# Pictures at times

class Times:
    """The times of the pictures, for all runs: [(time, why)]."""

    def __init__(self, runs, wanted):
        self.over_time = all(run.over_time for run in runs)
        with_frames = [run for run in runs if run.frames]
        self.chosen = []
        if not wanted.with_pictures or not with_frames:
            return
        if wanted.times:
            self.chosen = [(time, "asked for") for time in wanted.times]
        elif self.over_time:
            of = f" of {with_frames[0].key}" if len(runs) > 1 else ""
            self.chosen = [(time, why + of) for time, why in default_times(with_frames[0])]
        else:
            self.chosen = numbered_frames(with_frames[0])

    def marks(self, factor):
        return [time / factor for time, _ in self.chosen] if self.over_time else []


def default_times(run):
    """Start, an event between, and the end."""
    first, last = run.frames[0][0], run.frames[-1][0]
    if last <= first:
        return [(first, "the only frame")]
    event, why = event_of(run, first, last)
    return [(first, "start"), (event, why), (last, "end")]


def event_of(run, first, last):
    """The time of the largest force, of the least kinetic energy, or half of the time, whichever is known and not at an end."""
    span = last - first

    def within(time):
        return first + 0.03 * span < time < last - 0.03 * span

    for name in run.probes():
        if run.units[name] == "N":
            values = np.abs(np.nan_to_num(run.columns[name]))
            at = run.columns[run.first][int(np.argmax(values))]
            if values.max() > 0 and within(at):
                return float(at), f"largest {name} in the rows"
    if "energy_kinetic" in run.columns:
        at = run.columns[run.first][int(np.nanargmin(run.columns["energy_kinetic"]))]
        if within(at):
            return float(at), "least kinetic energy"
    for name in run.probes():
        values = run.columns[name]
        if np.all(np.isfinite(values)) and np.ptp(values) > 0:
            at = run.columns[run.first][int(np.argmax(np.abs(values - values[0])))]
            if within(at):
                return float(at), f"largest change of {name}"
    return first + 0.5 * span, "half of the time"


def numbered_frames(run):
    """Frames that stand for no times, such as modes: the first that are not nearly zero."""
    most = max(abs(time) for time, _ in run.frames) or 1.0
    return [(time, "") for time, _ in run.frames if abs(time) > 1e-3 * most][:MOST_PICTURES] or [(run.frames[0][0], "")]


def shots(runs, wanted, times):
    if not wanted.with_pictures:
        return missing("Pictures were not asked for (--quick).")
    parts, drawn = [], {}
    for run in runs:
        try:
            if not run.frames:
                raise pictures.CannotDraw("the run has no frames of bodies")
            pictures.need_vtk()
            drawn[run.key] = [pictures.shot(run, time) for time, _ in times.chosen]
        except pictures.CannotDraw as error:
            parts.append(missing(f"{tag(run)}There are no pictures at times: {esc(error)}."))
    having = [run for run in runs if run.key in drawn]
    if not having:
        return "".join(parts)
    every = [one for some in drawn.values() for one in some]
    field = wanted.field or pictures.default_field(every)
    groups = [having] if alike([drawn[run.key] for run in having], field) else [[run] for run in having]
    for group in groups:
        parts += [run_heading(group[0], runs) if len(groups) > 1 else "", shots_of(group, drawn, field, times)]
    return "".join(parts)


def alike(drawn, field):
    """Whether runs can have one camera and one range of colours: their sizes, and the sizes of the field, do not differ too much."""
    extents = [float(np.max(np.ptp(pictures.box_of(some), axis=1))) for some in drawn]
    ranges = [max(map(abs, pictures.range_of(some, field))) for some in drawn] if field else []
    return max(extents) <= 3 * min(extents) and (not ranges or max(ranges) <= 100 * min(ranges))


def shots_of(runs, drawn, field, times):
    """Pictures of some runs with one camera and one range of colours, a row for each time."""
    every = [one for run in runs for one in drawn[run.key]]
    limits = pictures.range_of(every, field) if field else (0.0, 1.0)
    unit = next((found for found in (frames.unit_of(one.grid, field.partition(":")[0]) for one in every) if found), "")
    camera = pictures.Camera(pictures.VIEWS[0], pictures.box_of(every))
    grey = "<p class=quiet>All fields are zero in these frames, so the bodies are grey.</p>"
    parts = [colour_bar(field, limits, unit) if field else grey]
    for run in runs:
        if field and any(pictures.values(one.grid, field) is None for one in drawn[run.key]):
            parts.append(missing(f"{tag(run)}Its frames have no field {esc(field)}, so its bodies are grey."))
    boxes = [[shot_box(run, drawn[run.key][i], why, time, field, limits, camera, times) for run in runs]
             for i, (time, why) in enumerate(times.chosen)]
    rows = boxes if len(runs) > 1 else [[box for row in boxes for box in row]]
    for row in rows:
        parts.append(f"<div class='row {'two' if len(row) in (2, 4) else 'three'}'>" + "".join(row) + "</div>")
    scaled = " Displacements are to scale." if times.over_time else ""
    parts.append(f"<p class=quiet>These pictures have one camera and one range of colours.{scaled}</p>")
    return "".join(parts)


def shot_box(run, one, why, time, field, limits, camera, times):
    name = f"t = {quantity(one.time, 's')}" if times.over_time else f"frame of {quantity(one.time, frame_unit(run))}"
    off = abs(one.time - time)
    spacing = (run.frames[-1][0] - run.frames[0][0]) / max(1, len(run.frames) - 1)
    note = f"; the frame nearest to {quantity(time, 's')}" if off > 1e-6 * abs(time) and times.over_time else ""
    note += ", which is more than a frame away" if off > 1.01 * spacing and times.over_time else ""
    return framed(lambda: pictures.of_field(one, field, limits, camera), camera, f"{run.name}: {field} at {one.time:g}",
                  f"{tag(run)}<b>{name}</b>{f' ({esc(why)})' if why else ''}{note}")


def frame_unit(run):
    return "Hz" if run.summary.get("driver") == "modes" else "1"


def colour_bar(field, limits, unit):
    factor, shown = scale_of(max(abs(limits[0]), abs(limits[1])), unit)
    colours, wide = pictures.bands(limits), 40
    rects = "".join(f"<rect x='{20 + wide * i}' y='4' width='{wide}' height='14' fill='{rgb(one)}'/>" for i, one in enumerate(colours))
    ticks = ""
    for i in range(0, len(colours) + 1, 2):
        value = (limits[0] + (limits[1] - limits[0]) * i / len(colours)) / factor
        ticks += f"<text x='{20 + wide * i}' y='33' font-size='12' text-anchor='middle'>{esc(f'{value:.3g}'.replace('-', '−'))}</text>"
    name = field.replace("_", " ").replace(":", " ")
    name = {"von mises": "von Mises stress (plates: at the top)", "displacement": "magnitude of the displacement",
            "velocity": "magnitude of the velocity"}.get(name, name)
    width, in_unit = 40 + wide * len(colours), f" [{esc(shown)}]" if shown else ""
    return (f"<figure><svg viewBox='0 0 {width} 40' width='{width}' style='max-width:100%' role='img' aria-label='range of colours'>"
            f"{rects}{ticks}</svg><figcaption>{esc(name)}{in_unit}</figcaption></figure>")
