"""Who makes the spread of a result (scripts/trade --vary): share of the variance, and change from the low end to the high one."""
import figure
import trade_vary

MOST_ROWS = 16


def vary_figure(inputs, studies):
    """One row of two panels for each result; bars have twice the standard error of the sampling, the band is the numerical error."""
    rows = min(max(len(inputs), 3), MOST_ROWS)
    drawn, panels = figure.new_grid(len(studies), 2, height=len(studies) * (18.0 + 4.6 * rows))
    for (left, right), one in zip(panels, studies):
        draw_shares(left, inputs, one)
        draw_changes(right, inputs, one)
    return drawn


def largest(one):
    """Numbers of the inputs, the largest share last, so that it is drawn on top."""
    return trade_vary.order(one)[:MOST_ROWS][::-1]


def draw_shares(axes, inputs, one):
    shown = largest(one)
    labels = ["together, or missed", *(inputs[i].key for i in shown)]
    numbers = [one.found.rest, *(one.found.share[i] for i in shown)]
    draw_bars(axes, labels, [100 * each.value for each in numbers], [100 * each.error for each in numbers],
              ["#b8b8b8", *["#0072B2"] * len(shown)])
    axes.set_xlim(left=0)
    axes.set(xlabel="share of the variance [%]", title=one.name)


def draw_changes(axes, inputs, one):
    shown = largest(one)
    draw_bars(axes, ["", *[""] * len(shown)], [0.0, *(one.found.change[i].value for i in shown)],
              [0.0, *(one.found.change[i].error for i in shown)], ["#D55E00"] * (1 + len(shown)))
    axes.axvspan(-one.numerical, one.numerical, facecolor="#e0e0e0", edgecolor="#a0a0a0", hatch="////", linewidth=0,
                 zorder=0, label="numerical error")
    axes.axvline(0, color="black", linewidth=0.6)
    axes.legend(loc="lower right")
    axes.set(xlabel="change from low to high" + (f" [{one.unit}]" if one.unit else ""))


def draw_bars(axes, labels, values, errors, colours):
    at = range(len(labels))
    axes.barh(at, values, height=0.62, color=colours, zorder=2)
    axes.errorbar(values, at, xerr=errors, fmt="none", ecolor="black", elinewidth=0.7, capsize=1.5, zorder=3)
    axes.set_yticks(list(at), labels)
    axes.tick_params(axis="y", which="both", left=False, right=False)
