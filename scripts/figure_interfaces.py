"""Errors of the rules of contact over the processor time of the whole run (scripts/interfaces): a panel for each scene."""
import figure
from runs import ROOT

PATH = ROOT / "docs/figures/interface_rules.svg"


def interfaces_figure(scenes, lines):
    """`lines` has the results of each mesh, by scene and rule. Meshes of a rule are joined, from coarse to fine."""
    drawn, row = figure.new_row(len(lines), height=76.0)
    for letter, axes, (name, rules) in zip("abc", row, lines.items()):
        for number, (rule, results) in enumerate(rules.items()):
            good = [(one.seconds, abs(one.found[scenes[name].main])) for one in results if not one.ended]
            figure.draw_points(axes, *zip(*good), number, rule)
        axes.set(xscale="log", yscale="log", xlabel="processor time [s]", ylabel=scenes[name].main)
        axes.set_title(f"({letter}) {name}, {', '.join(scenes[name].meshes)}", loc="left")
        figure.plain_ticks(axes.xaxis)
    drawn.get_layout_engine().set(rect=(0, 0, 1, 0.88), w_pad=0.06)
    drawn.legend(*row[0].get_legend_handles_labels(), loc="upper center", ncol=4, columnspacing=1.2)
    return drawn


def write(scenes, lines):
    figure.save(interfaces_figure(scenes, lines), PATH, png=False)
