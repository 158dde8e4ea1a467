"""Errors of the rules of contact over the processor time of the whole run (scripts/interfaces): a panel for each scene."""
import figure


def interfaces_figure(panels):
    """Meshes of a rule are joined, from coarse to fine.

    panels  [(title, name of the error, {rule: [(processor time [s], error), ...]}), ...]
    """
    drawn, row = figure.new_row(len(panels), height=76.0)
    for letter, axes, (title, error, rules) in zip("abc", row, panels):
        for number, (rule, points) in enumerate(rules.items()):
            figure.draw_points(axes, *zip(*points), number, rule)
        axes.set(xscale="log", yscale="log", xlabel="processor time [s]", ylabel=error)
        axes.set_title(f"({letter}) {title}", loc="left")
        figure.plain_ticks(axes.xaxis)
    drawn.get_layout_engine().set(rect=(0, 0, 1, 0.88), w_pad=0.06)
    drawn.legend(*row[0].get_legend_handles_labels(), loc="upper center", ncol=4, columnspacing=1.2)
    return drawn
