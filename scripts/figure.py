#!/usr/bin/python3
"""The one door to matplotlib: how every figure of Nereid looks, and the figures drawn from a run.

    scripts/figure.py settlement RUN [RUN ...] --out figure5.svg
    scripts/figure.py energy RUN --out energy.svg

RUN is the folder a driver wrote (history.csv, summary.json). Besides the SVG a PNG of the same name
is written. The same data give the same bytes.
"""
import argparse
import functools
import io
import json
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of backend)
import numpy as np  # noqa: E402
from matplotlib import font_manager, mathtext  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.patches import Rectangle  # noqa: E402

# Maximum head settlement of the cask: three of the four codes of the round robin, and NEPTUNE; both
# as Kulak & Fiala report them with their Fig. 5. Millimetres and milliseconds.
ROUND_ROBIN = {"settlement": (58.0, 72.5), "time": (4.3, 6.25)}
NEPTUNE = {"settlement": 65.0, "time": 5.5}

SINGLE_COLUMN, DOUBLE_COLUMN = 88.0, 180.0  # [mm]

# A curve is known by its dashes and its marker; its colour only helps. The colours are those of Okabe
# and Ito, of which readers who see colours differently can tell any two apart.
CURVES = [
    {"color": "#000000", "linestyle": "-", "marker": "o"},
    {"color": "#0072B2", "linestyle": (0, (6, 2)), "marker": "s"},
    {"color": "#D55E00", "linestyle": (0, (6, 1.5, 1, 1.5)), "marker": "^"},
    {"color": "#009E73", "linestyle": (0, (2, 1.5)), "marker": "D"},
    {"color": "#CC79A7", "linestyle": (0, (6, 1.5, 1, 1.5, 1, 1.5)), "marker": "v"},
    {"color": "#56B4E9", "linestyle": (0, (3, 3)), "marker": "X"},
    {"color": "#E69F00", "linestyle": (0, (1, 1.2)), "marker": "P"},
    {"color": "#666666", "linestyle": (0, (4, 1, 1, 1)), "marker": "*"},
]

STYLE = {
    "font.family": "STIXGeneral", "mathtext.fontset": "stix", "font.size": 9,
    "axes.labelsize": 9, "axes.titlesize": 9, "legend.fontsize": 8,
    "xtick.labelsize": 8, "ytick.labelsize": 8,
    "axes.linewidth": 0.6, "xtick.direction": "in", "ytick.direction": "in",
    "xtick.top": True, "ytick.right": True, "xtick.minor.visible": True, "ytick.minor.visible": True,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.minor.width": 0.4, "ytick.minor.width": 0.4,
    "xtick.major.size": 3.5, "ytick.major.size": 3.5, "xtick.minor.size": 2, "ytick.minor.size": 2,
    "lines.linewidth": 1.1, "lines.markersize": 4, "hatch.linewidth": 0.4,
    "legend.frameon": False, "legend.handlelength": 3.2, "legend.borderaxespad": 0.8,
    "axes.unicode_minus": True, "savefig.dpi": 300, "figure.dpi": 100,
    "svg.hashsalt": "nereid",  # else the names inside an SVG differ from run to run
}


class Unreadable(Exception):
    """A run's file is missing or is not what a driver writes; says which and what was expected."""


# ------------------------------------------------------------------------------------------------
# Reading a run

def read_history(folder):
    """The columns of history.csv as {name: values} and their units as {name: unit}."""
    path = Path(folder) / "history.csv"
    try:
        with path.open(encoding="utf-8") as file:
            header = file.readline().rstrip("\n").split(",")
            rows = [line.split(",") for line in file if line.strip()]
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    names, units = [], {}
    for entry in header:
        found = re.fullmatch(r"\s*(\w+)\s*\[([^\]]*)\]\s*", entry)
        if not found:
            raise Unreadable(f"{path}:1: '{entry}' is no column header; expected is 'name [unit]'")
        names.append(found.group(1))
        units[found.group(1)] = found.group(2)
    values = np.empty((len(rows), len(names)))
    for i, row in enumerate(rows):
        try:
            values[i] = [float(entry) for entry in row]
        except ValueError as error:
            raise Unreadable(f"{path}:{i + 2}: {len(names)} numbers expected") from error
    if not rows:
        raise Unreadable(f"{path}: holds no rows yet")
    return dict(zip(names, values.T)), units


def read_summary(folder):
    """summary.json as it stands; all quantities are in SI."""
    path = Path(folder) / "summary.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise Unreadable(f"{path}:{error.lineno}: {error.msg}") from error


def column(history, name, unit, folder):
    """One column, whose unit must be the one the figure converts from."""
    columns, units = history
    if name not in columns:
        raise Unreadable(f"{folder}/history.csv: has no column '{name}'; there are {', '.join(columns)}")
    if units[name] != unit:
        raise Unreadable(f"{folder}/history.csv: '{name}' is in {units[name]}, expected is {unit}")
    return columns[name]


# ------------------------------------------------------------------------------------------------
# Primitives

def use_style():
    """Every figure starts from the same settings, whatever was drawn before."""
    plt.rcParams.update(plt.rcParamsDefault)
    plt.rcParams.update(STYLE)


def new_figure(width=SINGLE_COLUMN, height=66.0, rows=1, ratios=None):
    """A figure of width x height [mm] and its axes, one above the other, sharing the lowest abscissa."""
    use_style()
    figure, axes = plt.subplots(rows, 1, sharex=True, squeeze=False, figsize=(width / 25.4, height / 25.4),
                                gridspec_kw={"height_ratios": ratios or [1] * rows}, constrained_layout=True)
    figure.get_layout_engine().set(hspace=0.02, h_pad=0.03, w_pad=0.03)
    return figure, (axes[0, 0] if rows == 1 else axes[:, 0])


def save(figure, path, png=True):
    """Writes the figure as SVG and, if wanted, as PNG, `path` with either ending; no date, so the same bytes."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path.with_suffix(".svg"), metadata={"Date": None, "Creator": None})
    if png:
        figure.savefig(path.with_suffix(".png"), metadata={"Software": None})
    plt.close(figure)


def write_svg(figure, stream):
    """Writes the figure to an open text, without a date, and forgets it."""
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    plt.close(figure)


@functools.lru_cache(maxsize=None)
def formula_svg(tex):
    """A formula as (SVG, height, depth below the line), both in em; none where mathtext does not know it."""
    use_style()
    size = 10.0  # [pt], one em
    try:
        width, height, depth, *_ = mathtext.MathTextParser("path").parse(f"${tex}$", dpi=72, prop=font_manager.FontProperties(size=size))
    except ValueError:
        return None
    figure = plt.figure(figsize=(max(width, 1) / 72, max(height + depth, 1) / 72))
    figure.text(0, depth / max(height + depth, 1), f"${tex}$", fontsize=size)
    stream = io.StringIO()
    figure.savefig(stream, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    return stream.getvalue(), (height + depth) / size, depth / size


def draw_reference(axes, x, y, number, label=None):
    """An exact curve: thin, black, without markers, broken where there are several."""
    dashes = ["-", (0, (8, 2)), (0, (8, 2, 1, 2)), (0, (1, 1.5))]
    return axes.plot(x, y, label=label, color="black", linewidth=0.8, linestyle=dashes[number % len(dashes)], zorder=2)[0]


def draw_range(axes, left, right, low, high, label=None):
    """What others found: a hatched box."""
    axes.add_patch(Rectangle((left, low), right - left, high - low, facecolor="#f0f0f0", edgecolor="#8c8c8c", hatch="////",
                             linewidth=0.7, zorder=1, label=label))
    axes.autoscale_view()


def draw_orders(axes, sizes, errors):
    """Slopes of first and second order through the finest point of a study, on logarithmic axes where it can have them."""
    positive = all(size > 0 for size in sizes) and all(error > 0 for error in errors)
    if not positive:
        return
    axes.set_xscale("log")
    axes.set_yscale("log")
    grows = -1.0 if (errors[-1] < errors[0]) == (sizes[-1] > sizes[0]) else 1.0
    ends = [min(sizes), max(sizes)]
    for order, dashes in ((1, (0, (1, 1.5))), (2, (0, (4, 2)))):
        axes.plot(ends, [errors[-1] * (size / sizes[-1]) ** (grows * order) for size in ends], color="#8c8c8c", linewidth=0.7,
                  linestyle=dashes, label=f"order {order}", zorder=1)


def interpolated(x, xs, ys):
    """The values at x of the straight lines through (xs, ys)."""
    return np.interp(x, xs, ys)


def draw_curve(axes, x, y, number, label=None, marks=9):
    """A curve in the style of its number, with markers spread along it, shifted from curve to curve."""
    style = CURVES[number % len(CURVES)]
    every = max(1, len(x) // marks)
    return axes.plot(x, y, label=label, **style, markevery=((number * every) // 3 % every, every), markersize=3.2,
                     markerfacecolor="white", markeredgewidth=0.7, zorder=3)[0]


def draw_band(axes, x, y, number, label=None):
    """A curve that rings, in the colour of its number: thin, without dashes and markers, below the others."""
    return axes.plot(x, y, label=label, color=CURVES[number % len(CURVES)]["color"], linewidth=0.4, alpha=0.8, zorder=1)[0]


def round_robin(axes):
    """The range of the round robin and NEPTUNE's point, in axes of ms and mm."""
    draw_range(axes, *ROUND_ROBIN["time"], *ROUND_ROBIN["settlement"], "round robin, three of four codes")
    axes.plot(NEPTUNE["time"], NEPTUNE["settlement"], linestyle="none", marker="*", markersize=11, color="white",
              markeredgecolor="black", markeredgewidth=0.8, zorder=5,
              label=f"NEPTUNE, {NEPTUNE['settlement']:g} mm at {NEPTUNE['time']:g} ms")


def reference_range(axes, quantity, neptune=True):
    """The range of the round robin and NEPTUNE's value of one quantity, across all abscissae."""
    low, high = ROUND_ROBIN[quantity]
    axes.axhspan(low, high, facecolor="#f0f0f0", edgecolor="#8c8c8c", hatch="////", linewidth=0.7, zorder=0,
                 label="round robin, three of four codes")
    if neptune:
        axes.axhline(NEPTUNE[quantity], color="black", linewidth=0.7, linestyle=(0, (1, 2)), zorder=1, label="NEPTUNE")


def draw_faces(axes, polygons, face, edge="#333333", width=0.35):
    """Polygons [[(across, up), ...], ...] in mm with their edges."""
    axes.add_collection(PolyCollection(polygons, facecolor=face, edgecolor=edge, linewidth=width, zorder=2))


# ------------------------------------------------------------------------------------------------
# Figures

def names_of(folders):
    """What each run is called: its case, or its folder where runs share a case."""
    folder_names = [Path(folder).resolve().name for folder in folders]
    cases = [Path(read_summary(folder).get("provenance", {}).get("case_path") or name).stem
             for folder, name in zip(folders, folder_names)]
    return cases if len(set(cases)) == len(cases) else folder_names


def settlement_figure(folders):
    """Fig. 5 of Kulak & Fiala: settlement of the lead's head over time after impact."""
    figure, axes = new_figure(width=120, height=84)
    round_robin(axes)
    number, last, largest = 0, ROUND_ROBIN["time"][1] + 0.25, ROUND_ROBIN["settlement"][1]
    for folder, name in zip(folders, names_of(folders)):
        history = read_history(folder)
        who = "Nereid" if len(folders) == 1 else f"Nereid ({name})"
        time = column(history, "time", "s", folder) * 1e3
        for quantity, where in [("settlement_mean", "mean of the head"), ("settlement_centre", "centre of the head")]:
            settlement = column(history, quantity, "m", folder) * 1e3
            draw_curve(axes, time, settlement, number, f"{who}, {where}")
            if quantity == "settlement_mean":
                results = read_summary(folder)["results"]  # of every step; the history has some of them
                most, at = (1e3 * results[key]["value"] for key in ("settlement_mean", "time_of_settlement_mean"))
                axes.plot(at, most, color=CURVES[number % len(CURVES)]["color"], marker="o", markersize=4.5, linestyle="none",
                          zorder=6, label=f"its maximum, {most:.1f} mm at {at:.2f} ms")
            number, last, largest = number + 1, max(last, time[-1]), max(largest, np.nanmax(settlement))
    axes.set_xlim(0, last)
    axes.set_ylim(0, 1.08 * largest)
    axes.set_xlabel("time after impact [ms]")
    axes.set_ylabel("head settlement, downwards [mm]")
    axes.legend(loc="lower right")
    return figure


CREATED = ("energy_created", "energy_integration", "energy_residual")


def energy_figure(folder, curves=7):
    """Where the energy of a run is, and what was created out of nothing, over time."""
    history = read_history(folder)
    columns, _ = history
    initial = read_summary(folder)["ledger"]["initial_kinetic"]["value"]  # [J]
    if not initial > 0:
        raise Unreadable(f"{folder}/summary.json: the initial kinetic energy is {initial} J; nothing to compare with")
    time = column(history, "time", "s", folder) * 1e3
    per_cent = {name: 100 * column(history, name, "J", folder) / initial
                for name in columns if name.startswith("energy_")}
    made = {name: values for name, values in per_cent.items() if name.startswith(CREATED)}
    held = {name: values for name, values in per_cent.items() if name not in made}
    if not held:
        raise Unreadable(f"{folder}/history.csv: has no column that starts with 'energy_'")

    figure, (upper, lower) = new_figure(width=DOUBLE_COLUMN, height=120, rows=2, ratios=[2, 1])
    plain = {name: re.sub("^energy_(created_)?", "", name).replace("_", " ") for name in per_cent}

    # The largest shares are drawn one by one; the others, and those under 1 %, as their sum.
    size = {name: np.nanmax(np.abs(values)) for name, values in held.items()}
    order = sorted(held, key=lambda name: -size[name])
    shown = [name for name in order[:curves - 1] if size[name] >= 1]
    if len(order) == len(shown) + 1:
        shown = order  # one alone is not worth calling "others"
    for number, name in enumerate(shown):
        draw_curve(upper, time, held[name], number, plain[name], marks=12)
    if len(shown) < len(order):
        rest = order[len(shown):]
        draw_curve(upper, time, sum(held[name] for name in rest), len(shown), f"{len(rest)} others together", marks=12)
    upper.plot(time, sum(held.values()), color="black", linewidth=0.6, label="sum of all", zorder=2)
    upper.set_ylabel("energy [% of initial kinetic]")
    upper.set_ylim(bottom=min(0.0, 1.05 * min(np.nanmin(values) for values in held.values())))
    upper.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))

    if any(np.any(values) for values in made.values()):
        for number, name in enumerate(made):
            draw_curve(lower, time, np.where(made[name] == 0, np.nan, np.abs(made[name])), number,
                       plain[name] if np.any(made[name]) else f"{plain[name]} (none)", marks=12)
        lower.set_yscale("log")
        lower.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    else:
        lower.text(0.5, 0.5, "none", transform=lower.transAxes, ha="center", va="center")
        lower.set_yticks([])
    lower.set_ylabel("created, magnitude [%]")
    lower.set_xlabel("time [ms]")
    lower.set_xlim(time[0], time[-1])
    figure.align_ylabels()
    return figure


def study_figure(points, abscissa, logarithmic=False, near=False, beyond=None):
    """Settlement and its time over one parameter of a study, with the references of both.

    points  (parameter, settlement [mm], time [ms]) by name of the quantity: {name: [...]}
    near    shows the curves large, and of the references only the edge of the range beside them
    beyond  {name: (settlement [mm], uncertainty [mm])} at parameter zero: what a sequence tends to
    """
    figure, (upper, lower) = new_figure(width=120, height=110, rows=2, ratios=[3, 2])
    reference_range(upper, "settlement", neptune=not near)
    reference_range(lower, "time", neptune=not near)
    for number, (name, rows) in enumerate(points.items()):
        rows = sorted(rows)
        style = {**CURVES[number % len(CURVES)], "markersize": 4, "markerfacecolor": "white", "markeredgewidth": 0.8}
        upper.plot([row[0] for row in rows], [row[1] for row in rows], label=name, zorder=3, **style)
        lower.plot([row[0] for row in rows], [row[2] for row in rows], zorder=3, **style)
        if beyond and name in beyond:
            value, uncertainty = beyond[name]
            upper.errorbar(0, value, yerr=uncertainty, color=style["color"], marker=style["marker"], markersize=4,
                           capsize=3, linewidth=0.9, clip_on=False, zorder=4, label="what it tends to, and its uncertainty")
    if logarithmic:
        upper.set_xscale("log")
    else:
        upper.set_xlim(left=0)
    if near:
        for axes, place, quantity in ((upper, 1, "settlement"), (lower, 2, "time")):
            seen = [row[place] for rows in points.values() for row in rows]
            if axes is upper and beyond:
                seen += [value + sign * uncertainty for value, uncertainty in beyond.values() for sign in (-1, 1)]
            edge = min(ROUND_ROBIN[quantity], key=lambda value: min(abs(value - one) for one in seen))
            low, high = min([*seen, edge]), max([*seen, edge])
            axes.set_ylim(low - 0.15 * (high - low), high + 0.4 * (high - low))  # room for the legend
    upper.set_ylabel("head settlement [mm]")
    lower.set_ylabel("its time [ms]")
    lower.set_xlabel(abscissa)
    upper.legend(loc="upper right", frameon=True, facecolor="white", edgecolor="none", framealpha=0.9)
    figure.align_ylabels()
    return figure


def elevation_figure(panels, floor=0.0):
    """The mesh in elevation: skin from outside on the left of the axis, section on the right.

    panels  (title, skin, section, plates): polygons [mm] of the skin's and of the section's faces,
            and the line [mm] of the skin's mid-surface in the section
    """
    use_style()
    figure, all_axes = plt.subplots(1, len(panels), sharey=True, squeeze=False, figsize=(120 / 25.4, 136 / 25.4),
                                    constrained_layout=True)
    corners = [corner for _, skin, section, _ in panels for polygon in skin + section for corner in polygon]
    most, top = (max(abs(corner[axis]) for corner in corners) for axis in (0, 1))
    for axes, (title, skin, section, plates) in zip(all_axes[0], panels):
        draw_faces(axes, skin, "#dce6ee")
        draw_faces(axes, section, "#e9e9e9")
        axes.add_collection(LineCollection([plates], colors="#0072B2", linewidths=1.6, zorder=4))
        axes.axvline(0, color="black", linewidth=0.6, linestyle=(0, (8, 2, 1, 2)), zorder=5)
        axes.plot([-1.3 * most, 1.3 * most], [floor, floor], color="black", linewidth=1.2, zorder=5)
        axes.add_patch(Rectangle((-1.3 * most, floor - 0.03 * top), 2.6 * most, 0.03 * top, facecolor="none",
                                 edgecolor="black", hatch="/////", linewidth=0, zorder=1))
        axes.set_xlim(-1.35 * most, 1.35 * most)
        axes.set_ylim(floor - 0.035 * top, 1.03 * top)
        axes.set_aspect("equal")
        axes.set_title(title)
        axes.set_xlabel("x [mm]")
    all_axes[0, 0].set_ylabel("z above the floor [mm]")
    return figure


def unit(vector):
    return vector / np.linalg.norm(vector)


def seen_from(azimuth, elevation):
    """The plane of projection of an eye far away, angles in degrees: points [... x 3] to across, up and depth towards the eye."""
    a, e = np.radians(azimuth), np.radians(elevation)
    across, towards = np.array([np.cos(a), np.sin(a), 0]), np.array([np.sin(a) * np.cos(e), -np.cos(a) * np.cos(e), np.sin(e)])
    return np.array([across, np.cross(towards, across), towards])


class Drawing:
    """A line drawing in space: everything is projected, and lies on paper in the order in which it is drawn."""

    def __init__(self, width, height, azimuth, elevation):
        use_style()
        self.figure, self.axes = plt.subplots(figsize=(width / 25.4, height / 25.4), constrained_layout=True)
        self.axes.set_aspect("equal")
        self.axes.axis("off")
        self.plane = seen_from(azimuth, elevation)

    def flat(self, points):
        return np.asarray(points) @ self.plane[:2].T

    def faces(self, faces, face, edge="#8c8c8c", width=0.5, alpha=1.0):
        """Polygons [faces x corners x 3] that look to the eye, the farthest first."""
        normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        order = np.argsort(faces.mean(axis=1) @ self.plane[2])
        seen = [self.flat(faces[f]) for f in order if normals[f] @ self.plane[2] > 0]
        self.axes.add_collection(PolyCollection(seen, facecolor=face, edgecolor=edge, linewidth=width, alpha=alpha))
        self.axes.autoscale_view()

    def line(self, points, **style):
        flat = self.flat(points)
        self.axes.plot(flat[:, 0], flat[:, 1], **{"color": "black", "linewidth": 1.0, "solid_capstyle": "round", **style})

    def point(self, at, **style):
        self.line([at], **{"marker": "o", "markersize": 4.5, "linestyle": "none", **style})

    def arrow(self, start, end, color="black", width=1.1):
        self.axes.annotate("", self.flat(end), self.flat(start), zorder=5,
                           arrowprops={"arrowstyle": "-|>,head_width=0.16,head_length=0.4", "color": color, "linewidth": width,
                                       "shrinkA": 0, "shrinkB": 0})

    def text(self, at, words, dx=0.0, dy=0.0, **style):
        """Words beside a point, by an offset in points of type."""
        self.axes.annotate(words, self.flat(at), xytext=(dx, dy), textcoords="offset points",
                           **{"ha": "center", "va": "center", "fontsize": 11, "zorder": 6, **style})


BASE, NORMAL, EDGE = "#0072B2", "#D55E00", "#009E73"


def element_figure(element, skins):
    """Fig. 1 of Kulak & Fiala: a contact element between two bodies, its base 1-2-3, its apex 4 and its height.

    element  corners [3 x 3], apex and foot [mm] as the program wrote them
    skins    faces [faces x 4 x 3] of the body of the base and of that of the apex [mm]
    """
    corner, apex, foot = element["corners"], element["apex"], element["foot"]
    normal = unit(np.cross(corner[1] - corner[0], corner[2] - corner[0]))
    drawing = Drawing(120, 96, azimuth=-40, elevation=24)
    drawing.faces(skins[0], "#f2f2f2")
    drawing.faces(corner[None], "#cfe3f1", edge=BASE, width=1.4)
    drawing.line([foot, apex], color=NORMAL, linestyle=(0, (4, 2)), linewidth=1.2)
    drawing.faces(skins[1], "#fbf3e2", alpha=0.72)
    for at in corner:
        drawing.line([at, apex], color=BASE, linewidth=1.0)
    size = np.linalg.norm(corner[1] - corner[0])
    drawing.arrow(foot, foot + 0.24 * size * normal, NORMAL, 1.4)
    for number, at in enumerate(corner):
        drawing.point(at, color=BASE)
        out = unit(drawing.flat(at) - drawing.flat(corner.mean(axis=0)))
        drawing.text(at, str(number + 1), 9 * out[0], 9 * out[1])
    drawing.point(apex, color="black")
    drawing.text(apex, "4", -9, 3)
    drawing.point(foot, color=NORMAL, markersize=3)
    drawing.text(foot + 0.52 * (apex - foot), "$h$", -7, 0, color=NORMAL)
    drawing.text(foot + 0.12 * size * normal, "$n$", -7, -6, color=NORMAL)
    return drawing.figure


def edge_normals(element):
    """The vectors of Eqs. (13), (14): sides L_12, L_23, L_31, ways L_14, L_24, L_34 to the apex, N = n x L, and L . N."""
    corner = element["corners"]
    sides = np.array([corner[(I + 1) % 3] - corner[I] for I in range(3)])
    ways = element["apex"] - corner
    normal = unit(np.cross(sides[0], -sides[2]))
    edge = np.cross(normal, sides)
    return normal, sides, ways, edge, np.einsum("ij,ij->i", ways, edge)


def connectivity_figure(element):
    """Fig. 2 of Kulak & Fiala: the vectors that tell whether the apex projects within its base, Eqs. (13) and (14)."""
    corner, apex, foot = element["corners"], element["apex"], element["foot"]
    normal, sides, ways, edge, _ = edge_normals(element)
    middle = corner.mean(axis=0)
    drawing = Drawing(120, 92, azimuth=-9, elevation=36)
    drawing.faces(corner[None], "#eef5fa", edge="none")
    for I in range(3):
        drawing.arrow(corner[I], corner[I] + sides[I], BASE, 1.4)
        drawing.arrow(corner[I], apex, "#555555", 0.9)
        # N is as long as its side; a third of it is drawn
        start = corner[I] + 0.5 * sides[I]
        drawing.arrow(start, start + edge[I] / 3, EDGE, 1.4)
    drawing.line([foot, apex], color=NORMAL, linestyle=(0, (4, 2)), linewidth=0.9)
    size = np.linalg.norm(sides[0])
    drawing.arrow(middle, middle + 0.25 * size * normal, NORMAL, 1.4)
    drawing.text(middle + 0.17 * size * normal, "$n$", 7, 0, color=NORMAL)
    for I in range(3):
        J = (I + 1) % 3
        out = unit(drawing.flat(corner[I]) - drawing.flat(middle))
        drawing.point(corner[I], color="black")
        drawing.text(corner[I], str(I + 1), 11 * out[0], 11 * out[1])
        aside = unit(drawing.flat(corner[I] + 0.5 * sides[I]) - drawing.flat(middle))
        drawing.text(corner[I] + 0.3 * sides[I], f"$L_{{{I + 1}{J + 1}}}$", 13 * aside[0], 13 * aside[1], color=BASE)
        drawing.text(corner[I] + 0.5 * sides[I] + edge[I] / 3, f"$N_{{{I + 1}{J + 1}}}$", -10 * aside[0], -10 * aside[1], color=EDGE)
        along = unit(drawing.flat(ways[I]))
        beside = np.array([along[1], -along[0]])
        beside *= np.sign(beside @ drawing.flat(corner[I] - foot))  # on the side away from the height
        drawing.text(corner[I] + 0.65 * ways[I], f"$L_{{{I + 1}4}}$", 13 * beside[0], 13 * beside[1], color="#333333")
    drawing.point(apex, color="black")
    drawing.text(apex, "4", 0, 9)
    drawing.point(foot, color=NORMAL, markersize=3)
    return drawing.figure


def measure(axes, start, end, words, aside=0.0, **style):
    """A line with two arrow heads and its length, in the axes' own units; aside [mm] moves the words."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "<|-|>,head_width=0.12,head_length=0.35", "color": "black",
                                              "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0})
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    upright = start[0] == end[0]
    at = (middle[0] + aside, middle[1]) if upright else (middle[0], middle[1] + aside)
    axes.text(*at, words, rotation=90 if upright else 0, ha="center", va="center", fontsize=9, **style)


def schematic_figure(radius, length, thickness, speed):
    """Fig. 3 of Kulak & Fiala: the clad cylinder above the floor, in section; lengths in mm, speed in mm/s."""
    use_style()
    figure, axes = plt.subplots(figsize=(96 / 25.4, 120 / 25.4), constrained_layout=True)
    above = 150.0  # [mm] drawn between cask and floor
    axes.add_patch(Rectangle((-radius, above), 2 * radius, length, facecolor="#e9e9e9", edgecolor="black", linewidth=0.8))
    for side in (-radius - thickness, radius):
        axes.add_patch(Rectangle((side, above), thickness, length, facecolor="#0072B2", edgecolor="black", linewidth=0.5))
    axes.add_patch(Rectangle((-2.2 * radius, -40), 4.4 * radius, 40, facecolor="none", edgecolor="black", hatch="/////", linewidth=0))
    axes.plot([-2.2 * radius, 2.2 * radius], [0, 0], color="black", linewidth=1.4)
    axes.plot([0, 0], [above - 40, above + length + 60], color="black", linewidth=0.6, linestyle=(0, (8, 2, 1, 2)))
    axes.text(0, above + 0.56 * length, "lead", ha="center", va="center", fontsize=11, bbox={"facecolor": "#e9e9e9", "edgecolor": "none",
        "pad": 2})
    axes.annotate("stainless steel", (radius + thickness / 2, above + 0.8 * length), (radius + 60, above + 0.86 * length), fontsize=9,
                  va="center",
                  arrowprops={"arrowstyle": "-", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0})
    axes.text(-2.15 * radius, 22, "rigid floor", fontsize=9, va="center")
    measure(axes, (-radius, above + length + 45), (radius, above + length + 45), f"{2 * radius:g} mm", 30,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})
    for x in (-radius, radius):
        axes.plot([x, x], [above + length + 8, above + length + 60], color="black", linewidth=0.4)
    measure(axes, (-radius - 75, above), (-radius - 75, above + length), f"{length:g} mm", -32)
    for z in (above, above + length):
        axes.plot([-radius - 90, -radius - thickness - 8], [z, z], color="black", linewidth=0.4)
    for side, sign in ((radius, -1), (radius + thickness, 1)):
        axes.annotate("", (side, above + 0.33 * length), (side + sign * 60, above + 0.33 * length),
                      arrowprops={"arrowstyle": "-|>,head_width=0.12,head_length=0.35", "color": "black", "linewidth": 0.6,
                                  "shrinkA": 0, "shrinkB": 0})
    axes.text(radius + thickness + 66, above + 0.33 * length, f"{thickness:g} mm", fontsize=9, va="center")
    axes.annotate("", (radius + 100, 15), (radius + 100, above + 60),
                  arrowprops={"arrowstyle": "-|>,head_width=0.2,head_length=0.5", "color": "#D55E00", "linewidth": 1.4})
    axes.text(radius + 115, above / 2 + 35, f"{speed:,.0f} mm/s", fontsize=9, va="center", color="#D55E00")
    axes.set_xlim(-2.25 * radius, 2.45 * radius)
    axes.set_ylim(-45, above + length + 100)
    axes.set_aspect("equal")
    axes.axis("off")
    return figure


def confinement_figure(curves, ends):
    """Settlement over its time as the confinement of the lead varies, with the round robin and NEPTUNE.

    curves  {name: (rows, labels)}: rows (settlement [mm], time [ms] and, if wanted, first and last time within 1 % of it)
            in order, labels {row: words} at some of them
    ends    {words: (settlement, time)}: single runs
    """
    figure, axes = new_figure(width=140, height=112)
    round_robin(axes)
    for number, (name, (rows, labels)) in enumerate(curves.items()):
        style = {**CURVES[number], "markersize": 4, "markerfacecolor": "white", "markeredgewidth": 0.8}
        for settlement, _, *span in rows:
            if span:
                axes.plot(span, [settlement] * 2, color=style["color"], linewidth=0.5, alpha=0.45, zorder=2)
        axes.plot([row[1] for row in rows], [row[0] for row in rows], label=name, zorder=4, **style)
        for place, words in labels.items():
            right = number == 0  # the first curve runs below the others
            axes.annotate(words, (rows[place][1], rows[place][0]), xytext=(7, -6) if right else (-7, 5), zorder=7,
                          textcoords="offset points", fontsize=7.5, color=style["color"], ha="left" if right else "right", va="center")
    for words, (settlement, time) in ends.items():
        axes.plot(time, settlement, color="black", marker="s", markersize=4.5, linestyle="none", zorder=6)
        axes.annotate(words, (time, settlement), xytext=(-7, 3), textcoords="offset points", fontsize=8, ha="right")
    axes.set_xlabel("time of the largest settlement [ms]")
    axes.set_ylabel("largest settlement of the head [mm]")
    axes.legend(loc="upper left")
    return figure


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    figures = parser.add_subparsers(dest="figure", required=True)
    settlement = figures.add_parser("settlement", help="head settlement of the cask over time, with its references")
    settlement.add_argument("runs", nargs="+", metavar="RUN")
    energy = figures.add_parser("energy", help="where the energy of a run is, and what was created")
    energy.add_argument("run", metavar="RUN")
    for figure in (settlement, energy):
        figure.add_argument("--out", required=True, metavar="FILE", help="the SVG; a PNG is written beside it")
    options = parser.parse_args(arguments)
    try:
        drawn = settlement_figure(options.runs) if options.figure == "settlement" else energy_figure(options.run)
    except Unreadable as error:
        print(error, file=sys.stderr)
        return 1
    save(drawn, options.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
