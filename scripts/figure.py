"""The one door to matplotlib: how every figure of Nereid looks. The same data give the same bytes.

The modules figure_*.py draw data that they are given; they read no file and import nothing but this module.
"""
import functools
import io
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of backend)
import numpy as np  # noqa: E402
from matplotlib import font_manager, mathtext  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402, F401  (for the figures)
from matplotlib.patches import Rectangle  # noqa: E402
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter  # noqa: E402

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


def new_row(columns, width=DOUBLE_COLUMN, height=66.0, ratios=None):
    """A figure of width x height [mm] and its axes, one beside the other."""
    use_style()
    return plt.subplots(1, columns, figsize=(width / 25.4, height / 25.4), gridspec_kw={"width_ratios": ratios or [1] * columns},
                        constrained_layout=True)


def new_grid(rows, columns, width=DOUBLE_COLUMN, height=130.0):
    """A figure of width x height [mm] and its axes, a list for each row."""
    use_style()
    figure, axes = plt.subplots(rows, columns, squeeze=False, figsize=(width / 25.4, height / 25.4), constrained_layout=True)
    return figure, [list(row) for row in axes]


def new_overview(count, columns, width=DOUBLE_COLUMN, height=120.0, ratios=(3, 2)):
    """A figure of width x height [mm]: wide axes over rows of `columns` axes, `count` in all; those of a row share their ordinate.

    ratios  heights of the wide axes and of each row
    """
    use_style()
    figure = plt.figure(figsize=(width / 25.4, height / 25.4), constrained_layout=True)
    rows = -(-count // columns)
    grid = figure.add_gridspec(1 + rows, columns, height_ratios=[ratios[0], *[ratios[1]] * rows])
    small = []
    for place in range(count):
        first = small[place - place % columns] if place % columns else None
        small.append(figure.add_subplot(grid[1 + place // columns, place % columns], sharey=first))
        if first:
            small[-1].tick_params(labelleft=False)
    return figure, figure.add_subplot(grid[0, :]), small


def save(figure, path, png=True):
    """Writes the figure as SVG and, if wanted, as PNG, `path` with either ending; no date, so the same bytes."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path.with_suffix(".svg"), metadata={"Date": None, "Creator": None})
    if png:
        figure.savefig(path.with_suffix(".png"), metadata={"Software": None})
    plt.close(figure)


def write_svg(figure, stream):
    """Writes the figure to an open text, without a date, and closes it."""
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


def place_legend(axes):
    """The legend within the axes where it covers no curve and no box; where there is no such place, to their right if it is narrow."""
    legend = axes.legend(loc="best")
    axes.figure.canvas.draw()
    box = legend.get_window_extent().padded(1)
    drawn = [line.get_path().transformed(line.get_transform()) for line in axes.lines]
    drawn += [patch.get_path().transformed(patch.get_transform()) for patch in axes.patches]
    narrow = box.width < 0.45 * axes.figure.bbox.width
    if narrow and any(path.cleaned(remove_nans=True).intersects_bbox(box, filled=False) for path in drawn):
        legend.remove()
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


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


def draw_points(axes, x, y, number, label=None):
    """A few points of a study, joined, in the style of their number."""
    return axes.plot(x, y, label=label, **CURVES[number % len(CURVES)], markersize=4, markerfacecolor="white", markeredgewidth=0.8,
                     zorder=3, clip_on=False)[0]


def plain_ticks(axis):
    """A logarithmic axis with 1, 2 and 5 of each decade, written as they are."""
    axis.set_major_locator(LogLocator(10, (1, 2, 5)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def draw_faces(axes, polygons, face, edge="#333333", width=0.35):
    """Polygons [[(across, up), ...], ...] in mm with their edges."""
    axes.add_collection(PolyCollection(polygons, facecolor=face, edgecolor=edge, linewidth=width, zorder=2))
