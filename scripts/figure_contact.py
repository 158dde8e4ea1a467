#!/usr/bin/python3
"""What a penalty trades and a multiplier does not: writes docs/figures/contact_trade.svg, the figure of docs/contact_methods.md.

    scripts/figure_contact.py [--drivers FOLDER]

The scene is verification/bars_by_multipliers: two bars that collide, with a plateau of stress between them. Runs lie in
out/contact_methods and are made anew only when program, case or settings change; all together take half a minute.
"""
import argparse

import command_line
import figure
import verify
from runs import ROOT, Store

SCALES = (0.2, 0.5, 1, 4, 20, 100, 1000)
SAFETIES = (0.9, 0.45, 0.2, 0.1, 0.05)
DAMPED = 0.5  # of critical
NAMES = ("multiplier", "penalty", f"penalty, damping ratio {DAMPED:g}")


def penalty(scale, damping=0.0):
    return {"contact.method": "penalty", "contact.penalty_scale": scale, "contact.damping_ratio": damping}


def families(run):
    """Runs by name: of the multiplier by shorter steps, of the penalty by its scale."""
    return dict(zip(NAMES, ([run.again({"time.safety": one}) for one in SAFETIES], [run.again(penalty(one)) for one in SCALES],
                            [run.again(penalty(one, DAMPED)) for one in SCALES])))


def draw(run, bars):
    """Stress of the interface over time; error of the plateau, and penetration, over the number of steps."""
    drawn, (stress, error, depth) = figure.new_row(3, height=72, ratios=[1.25, 1, 1])
    exact = bars.exact(run)
    for name, one, number in ((NAMES[1] + ", scale 20", run.again(penalty(20)), 1), (NAMES[0], run, 0)):
        values = [value / exact["stress"] for value in one.column("interface_stress")]
        times = [1e6 * t for t in one.column("time")]
        figure.draw_band(stress, times, values, 1, name) if number else figure.draw_curve(stress, times, values, 0, name)
    first, last = 1e6 * exact["first"], 1e6 * (exact["first"] + exact["time"])
    figure.draw_reference(stress, [0, first, first, last, last, 50], [0, 0, 1, 1, 0, 0], 1, "exact")
    stress.set(xlabel="time [µs]", ylabel="interface stress over the exact plateau [-]", xlim=(0, 50), ylim=(-0.1, 3.0))
    stress.legend(loc="upper right")

    for number, (name, runs) in enumerate(families(run).items()):
        steps = [one.summary["cost"]["steps"] for one in runs]
        for axes, values, aside in ((error, [100 * bars.plateau(one) for one in runs], (5, -9)),
                                    (depth, [1e6 * one.result("contact_deepest") for one in runs], (5, 2))):
            figure.draw_points(axes, steps, values, number, name)
            for scale, x, y in zip(SCALES, steps, values) if name == NAMES[1] else ():
                axes.annotate(f"{scale:g}", (x, y), xytext=aside if scale > SCALES[0] else (-15, -3), textcoords="offset points",
                              fontsize=7)
    error.set(yscale="log", ylim=(0.03, 300), ylabel="error of the plateau [%]")
    depth.set_yscale("symlog", linthresh=0.01)  # so that none has a place
    depth.set(ylim=(-0.004, 20), ylabel="deepest penetration [µm]")
    for letter, axes in zip("abc", (stress, error, depth)):
        axes.set_title(f"({letter})", loc="left")
    for axes in (error, depth):
        axes.set(xscale="log", xlim=(150, 5e5), xlabel="steps [-]")
    drawn.get_layout_engine().set(rect=(0, 0, 1, 0.91), w_pad=0.06)
    drawn.legend(*error.get_legend_handles_labels(), loc="upper right", bbox_to_anchor=(0.995, 1.02), ncol=3)
    return drawn


def main(arguments=None):
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--drivers", type=command_line.folder_of_programs, default=ROOT / "build/release/drivers",
                        help="folder of the programs")
    options = parser.parse_args(arguments)
    case = verify.Case("bars_by_multipliers")
    command_line.need_programs(options.drivers, [case.accept.DRIVER])
    run = case.base_run(Store(options.drivers, ROOT / "out/contact_methods"))
    figure.save(draw(run, case.accept), ROOT / "docs/figures/contact_trade.svg", png=False)


if __name__ == "__main__":
    main()
