"""Shares of inputs in the spread of a result (scripts/trade --vary): part of the variance, and change from the low end to the high one."""
import figure


def vary_figure(spreads):
    """One row of two panels for each of trade_vary.spreads; bars have twice the standard error of the sampling, the band is the numerical
    error."""
    rows = max(3, *(len(one.bars) for one in spreads))
    drawn, panels = figure.new_grid(len(spreads), 2, height=len(spreads) * (18.0 + 4.6 * rows))
    for (left, right), one in zip(panels, spreads):
        draw_shares(left, one)
        draw_changes(right, one)
    return drawn


def draw_shares(axes, one):
    labels = ["together, or missed", *(bar.key for bar in one.bars)]
    numbers = [one.rest, *(bar.share for bar in one.bars)]
    draw_bars(axes, labels, [100 * value for value, _ in numbers], [100 * error for _, error in numbers],
              ["#b8b8b8", *["#0072B2"] * len(one.bars)])
    axes.set_xlim(left=0)
    axes.set(xlabel="share of the variance [%]", title=one.name)


def draw_changes(axes, one):
    draw_bars(axes, ["", *[""] * len(one.bars)], [0.0, *(bar.change[0] for bar in one.bars)], [0.0, *(bar.change[1] for bar in one.bars)],
              ["#D55E00"] * (1 + len(one.bars)))
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
