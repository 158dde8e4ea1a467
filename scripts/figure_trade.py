"""Error against cost of a sweep (scripts/trade): one column for each result, above over element updates, below over processor time."""
import math

import figure

DOMINATED = "#b8b8b8"
BAND = 0.4      # [-] of the uncertainty: how far down its band is drawn
NEAR = 0.4      # [-] ratio of costs, as a logarithm, of points that get one name


def trade_figure(costs, columns):
    """Every good point: grey those that another one beats, hollow those that finer meshes do not confirm; those of the front are joined
    and have the numbers of the table.

    costs    names of the costs, one for each row
    columns  {result: [trade_points.Panel, ...]}, one for each cost
    """
    drawn, rows = figure.new_grid(len(costs), len(columns), height=130.0)
    for number, (row, across) in enumerate(zip(rows, costs)):
        for axes, panels in zip(row, columns.values()):
            axes.set(xscale="log", yscale="log", xlabel=across)
            draw_panel(axes, panels[number])
        row[0].set_ylabel("error [%]")
    for axes, name in zip(rows[0], columns):
        axes.set_title(name)
    drawn.get_layout_engine().set(rect=(0, 0, 1, 0.95), w_pad=0.05)
    said = {label: handle for axes in rows[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    drawn.legend(said.values(), said.keys(), loc="upper center", ncol=max(1, len(said)), columnspacing=1.0, handlelength=1.8)
    return drawn


def draw_panel(axes, panel):
    """One result over one cost."""
    if panel.uncertainty == math.inf:
        axes.text(0.5, 0.5, "no reference", transform=axes.transAxes, ha="center")
        return
    for some, label, face in ((panel.beaten, "dominated", DOMINATED), (panel.alone, "without two finer meshes", "white")):
        axes.plot([cost for cost, _ in some], [error for _, error in some], linestyle="none", marker="o", markersize=3, color=DOMINATED,
                  markerfacecolor=face, markeredgewidth=0.6, label=label, zorder=1)
    figure.draw_points(axes, [cost for cost, _, _ in panel.front], [error for _, error, _ in panel.front], 1, "Pareto front")
    axes.plot([panel.base[0]], [panel.base[1]], linestyle="none", marker="*", markersize=8, color="#D55E00", markeredgecolor="black",
              markeredgewidth=0.4, label="settings of the case", zorder=4)
    if panel.uncertainty > 0:
        draw_uncertainty(axes, panel.uncertainty)
    for cost, error, number in panel.front:
        axes.annotate(str(number), (cost, error), xytext=(3, 3), textcoords="offset points", fontsize=7)


def draw_uncertainty(axes, uncertainty):
    """The band [%] of errors that are smaller than the uncertainty of the reference."""
    axes.axhspan(BAND * uncertainty, uncertainty, facecolor="#f0f0f0", edgecolor="#c8c8c8", hatch="////", linewidth=0,
                 label="below the reference's uncertainty", zorder=0)
    axes.set_ylim(bottom=BAND * uncertainty)


def series_figure(result, uncertainty, lines):
    """The error that counts of one result over processor time, a line for each series; hollow and not joined are the finest meshes, which
    no two finer ones confirm.

    uncertainty  [%] of the reference
    lines        {line: (points that finer meshes confirm, the others)}, points as (processor time [s], error [%], name of the mesh)
    """
    drawn, axes = figure.new_figure(width=figure.DOUBLE_COLUMN, height=90.0)
    named = []
    for number, (line, (sure, unsure)) in enumerate(lines.items()):
        style = figure.CURVES[number % len(figure.CURVES)]
        axes.plot([x for x, _, _ in sure], [y for _, y, _ in sure], label=line, **style, markersize=4.5, zorder=3)
        name_points(axes, sure, named)
        axes.plot([x for x, _, _ in unsure], [y for _, y, _ in unsure], linestyle="none", marker=style["marker"], color=style["color"],
                  markersize=4.5, markerfacecolor="white", markeredgewidth=0.7, zorder=2)
    axes.set(xscale="log", yscale="log", xlabel="processor time [s]", ylabel=f"error of the {result} that counts [%]")
    draw_uncertainty(axes, uncertainty)
    figure.plain_ticks(axes.yaxis)
    axes.legend(loc="upper right")
    return drawn


def name_points(axes, some, named):
    """Writes the meshes beside their points, once where points of two lines all but coincide; `named` has what is there already."""
    for x, y, mesh in some:
        if not any(mesh == one and abs(math.log(x / other)) < NEAR for one, other in named):
            axes.annotate(mesh, (x, y), xytext=(4, 4), textcoords="offset points", fontsize=7)
            named.append((mesh, x))
