"""Error against cost of a sweep (scripts/trade): one column for each result, above over element updates, below over processor time."""
import figure
import trade_points as points

DOMINATED = "#b8b8b8"
COSTS = ((points.updates_of, "element updates", "updates"), (points.seconds_of, "processor time [s]", "time"))


def trade_figure(found, base, references):
    """Every good point: grey those that another one beats, joined those of the front, with the numbers of the table."""
    drawn, rows = figure.new_grid(len(COSTS), len(references), height=130.0)
    for row, (cost, across, which) in zip(rows, COSTS):
        for number, (axes, (name, reference)) in enumerate(zip(row, references.items())):
            draw_panel(axes, found, base, name, references, cost, which)
            axes.set(xscale="log", yscale="log", xlabel=across, title=name if row is rows[0] else "")
            if number == 0:
                axes.set_ylabel("error [%]")
    rows[0][0].legend(loc="best")
    return drawn


def draw_panel(axes, found, base, name, references, cost, which):
    uncertainty = references[name].uncertainty

    def error(point):
        return 100 * max(points.counted(point, name, found, references), 1e-8)  # round-off has a place, too

    best = points.front_of(found, name, references, cost)
    axes.plot([cost(one) for one in found if one not in best], [error(one) for one in found if one not in best], linestyle="none",
              marker="o", markersize=3, color=DOMINATED, label="beaten by another", zorder=1)
    figure.draw_points(axes, [cost(one) for one in best], [error(one) for one in best], 1, "front")
    axes.plot([cost(base)], [error(base)], linestyle="none", marker="*", markersize=8, color="#D55E00", markeredgecolor="black",
              markeredgewidth=0.4, label="as the case has it", zorder=4)
    if uncertainty > 0:
        low = axes.get_ylim()[0]
        axes.axhspan(min(low, 30 * uncertainty), 100 * uncertainty, facecolor="#f0f0f0", edgecolor="#c8c8c8", hatch="////", linewidth=0,
                     label="below the reference's uncertainty", zorder=0)
    numbers = {id(one): number + 1 for number, (one, _) in enumerate(points.front_points(found, name, references))}
    for one in best:
        axes.annotate(str(numbers[id(one)]), (cost(one), error(one)), xytext=(3, 3), textcoords="offset points", fontsize=7)
