"""Error against cost of a sweep (scripts/trade): one column for each result, above over element updates, below over processor time."""
import math

import figure
import trade_points as points

DOMINATED = "#b8b8b8"
LEAST = 1e-8    # [-] where round-off is drawn
BAND = 0.4      # [-] of the uncertainty: how far down its band is drawn
NEAR = 0.4      # [-] ratio of costs, as a logarithm, of points that get one name
COSTS = ((points.updates_of, "element updates"), (points.seconds_of, "processor time [s]"))


def trade_figure(found, base, references):
    """Every good point: grey those that another one beats, hollow those that finer meshes do not bear out; those of the front are joined
    and have the numbers of the table."""
    drawn, rows = figure.new_grid(len(COSTS), len(references), height=130.0)
    for row, (cost, across) in zip(rows, COSTS):
        for axes, name in zip(row, references):
            axes.set(xscale="log", yscale="log", xlabel=across)
            draw_panel(axes, found, base, name, references, cost)
        row[0].set_ylabel("error [%]")
    for axes, name in zip(rows[0], references):
        axes.set_title(name)
    drawn.get_layout_engine().set(rect=(0, 0, 1, 0.95), w_pad=0.05)
    said = {label: handle for axes in rows[0] for handle, label in zip(*axes.get_legend_handles_labels())}
    drawn.legend(said.values(), said.keys(), loc="upper center", ncol=len(said), columnspacing=1.0, handlelength=1.8)
    return drawn


def draw_panel(axes, found, base, name, references, cost):
    """One result over one cost."""
    uncertainty = references[name].uncertainty
    if uncertainty == math.inf:
        axes.text(0.5, 0.5, "no reference", transform=axes.transAxes, ha="center")
        return

    def error(point):
        return 100 * max(points.counted(point, name, found, references), LEAST)

    best = points.front_of(found, name, references, cost, surely=True)
    sure = points.borne_out(found)
    beaten = [one for one in sure if one not in best]
    alone = [one for one in found if one not in sure]
    for some, label, face in ((beaten, "beaten by another", DOMINATED), (alone, "without two finer meshes", "white")):
        axes.plot([cost(one) for one in some], [error(one) for one in some], linestyle="none", marker="o", markersize=3, color=DOMINATED,
                  markerfacecolor=face, markeredgewidth=0.6, label=label, zorder=1)
    figure.draw_points(axes, [cost(one) for one in best], [error(one) for one in best], 1, "front")
    axes.plot([cost(base)], [error(base)], linestyle="none", marker="*", markersize=8, color="#D55E00", markeredgecolor="black",
              markeredgewidth=0.4, label="as the case has it", zorder=4)
    if uncertainty > 0:
        axes.axhspan(100 * BAND * uncertainty, 100 * uncertainty, facecolor="#f0f0f0", edgecolor="#c8c8c8", hatch="////", linewidth=0,
                     label="below the reference's uncertainty", zorder=0)
        axes.set_ylim(bottom=100 * BAND * uncertainty)
    numbers = {id(one): number + 1 for number, (one, _) in enumerate(points.front_points(found, name, references))}
    for one in best:
        axes.annotate(str(numbers[id(one)]), (cost(one), error(one)), xytext=(3, 3), textcoords="offset points", fontsize=7)


def series_figure(lines, wanted, references):
    """The error that counts of one result over processor time, a line for each series; hollow and not joined are the finest meshes, which
    no two finer ones bear out."""
    drawn, axes = figure.new_figure(width=figure.DOUBLE_COLUMN, height=90.0)
    found = [one for some in lines.values() for one in some]
    uncertainty = references[wanted.result].uncertainty

    def place(some):
        return [one.seconds for one in some], [100 * points.counted(one, wanted.result, found, references) for one in some]

    named = []
    for number, (line, some) in enumerate(lines.items()):
        style = figure.CURVES[number % len(figure.CURVES)]
        sure = [one for one in some if len(points.finer_of(one, found)) >= points.FINER]
        axes.plot(*place(sure), label=line, **style, markersize=4.5, zorder=3)
        name_points(axes, sure, place(sure), wanted, named)
        axes.plot(*place([one for one in some if one not in sure]), linestyle="none", marker=style["marker"], color=style["color"],
                  markersize=4.5, markerfacecolor="white", markeredgewidth=0.7, zorder=2)
    axes.set(xscale="log", yscale="log", xlabel="processor time [s]", ylabel=f"error of the {wanted.result} that counts [%]")
    axes.axhspan(100 * BAND * uncertainty, 100 * uncertainty, facecolor="#f0f0f0", edgecolor="#c8c8c8", hatch="////", linewidth=0,
                 label="below the reference's uncertainty", zorder=0)
    axes.set_ylim(bottom=100 * BAND * uncertainty)
    figure.plain_ticks(axes.yaxis)
    axes.legend(loc="upper right")
    return drawn


def name_points(axes, some, places, wanted, named):
    """Writes the meshes beside their points, once where points of two lines all but coincide; `named` has what is there already."""
    for one, x, y in zip(some, *places):
        if not any(mesh == one.mesh and abs(math.log(x / other)) < NEAR for mesh, other in named):
            axes.annotate(wanted.name_of(one.mesh), (x, y), xytext=(4, 4), textcoords="offset points", fontsize=7)
            named.append((one.mesh, x))
