"""Figures of a report: histories of some runs, where their energy is, and what was created."""
import io

import numpy as np

from figure import CURVES, DOUBLE_COLUMN, SINGLE_COLUMN, draw_curve, new_figure, place_legend, write_svg

MARKED = "#b0b0b0"


def svg_of(figure):
    stream = io.StringIO()
    write_svg(figure, stream)
    text = stream.getvalue()
    return text[text.index("<svg"):].encode()  # the lines before name an address outside


def history_figure(curves, across, up, marks=(), points=False, above=False):
    """Curves [(label, x, y, is a mean since the row before)] with the words of both axes.

    marks   values of x at which there are pictures
    points  the rows are no times, but a few numbered things
    above   the legend stands above the diagram
    """
    figure, axes = new_figure(SINGLE_COLUMN, 62)
    for number, (label, x, y, mean) in enumerate(curves):
        if points:
            axes.plot(x, y, label=label, color=CURVES[number % len(CURVES)]["color"], linestyle="",
                      marker=CURVES[number % len(CURVES)]["marker"], clip_on=False, zorder=3)
            continue
        line = draw_curve(axes, x, y, number, label)
        if mean:
            line.set_drawstyle("steps-pre")
        if rings(y):  # dashes of a curve that goes up and down all the time cannot be told
            line.set_linestyle("-"), line.set_linewidth(0.6)
    for at in marks:
        axes.axvline(at, color=MARKED, linewidth=0.7, linestyle=(0, (1, 2)), zorder=0)
    finish(axes, curves, across)
    axes.set_ylabel(up)
    if above and len(curves) > 1:
        axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.02), ncol=min(4, len(curves)), borderaxespad=0, columnspacing=1.2,
                    handlelength=2.4)
    elif len(curves) > 1:
        place_legend(axes)
    return svg_of(figure)


def rings(y):
    """Whether a curve turns more than 12 times by more than a fiftieth of its range."""
    slopes = np.diff(np.asarray(y, float))
    large = slopes[np.abs(slopes) > 0.02 * (np.nanmax(y) - np.nanmin(y))]
    return np.count_nonzero(np.diff(np.sign(large))) > 12


def finish(axes, curves, across):
    x = np.concatenate([np.asarray(one[1], float) for one in curves])
    if x.size and x.max() > x.min():
        axes.set_xlim(x.min(), x.max())
    axes.set_xlabel(across)
    axes.ticklabel_format(axis="y", useOffset=False, scilimits=(-3, 5))
    axes.margins(y=0.08)


def energy_figure(x, groups, total, supplied, across, up, marks=()):
    """Energies by group {name: values}, their sum, and what was there at the start with what came from outside."""
    figure, axes = new_figure(DOUBLE_COLUMN, 78)
    axes.plot(x, supplied, color="#9a9a9a", linewidth=2.6, solid_capstyle="butt", label="start and outside", zorder=1)
    axes.plot(x, total, color="black", linewidth=0.8, label="sum of all groups", zorder=2)
    for number, (name, values) in enumerate(groups.items()):
        draw_curve(axes, x, values, number + 1, name)
    for at in marks:
        axes.axvline(at, color=MARKED, linewidth=0.7, linestyle=(0, (1, 2)), zorder=0)
    finish(axes, [("", x, x)], across)
    axes.set_ylabel(up)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return svg_of(figure)


def created_figure(x, created, across, limit, floor):
    """Created energy by source {name: per cent of the energy of the scene}: magnitudes, with the limit at which a run stops."""
    figure, axes = new_figure(DOUBLE_COLUMN, 55)
    for number, (name, values) in enumerate(created.items()):
        size = np.abs(values)
        draw_curve(axes, x, np.where(size > floor, size, np.nan), number, name)
    axes.set_yscale("log")
    if limit:
        axes.axhline(limit, color="#a3161a", linewidth=0.9, label=f"a source stops the run: {limit:g} %")
        axes.axhline(limit / 5, color="#a3161a", linewidth=0.9, linestyle=(0, (3, 2)), label=f"the run warns: {limit / 5:g} %")
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, floor), 3 * max(high, limit or 0))
    finish_log(axes, x, across)
    axes.set_ylabel("created or lost [%]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return svg_of(figure)


def finish_log(axes, x, across):
    if len(x) and x[-1] > x[0]:
        axes.set_xlim(x[0], x[-1])
    axes.set_xlabel(across)
