"""What a penalty trades and a multiplier does not (scripts/contact_trade)."""
import figure


def contact_figure(exact, stresses, families):
    """Stress of the interface over time; error of the plateau, and penetration, over the number of steps.

    exact     (first time, last time) [us] of the exact plateau
    stresses  [(name, times [us], stress over the exact plateau)]: that of the penalty, which rings, then that of the multiplier
    families  {name: [(steps, error of the plateau [%], deepest penetration [um], name of the point), ...]}
    """
    drawn, (stress, error, depth) = figure.new_row(3, height=72, ratios=[1.25, 1, 1])
    for draw, number, (name, times, values) in zip((figure.draw_band, figure.draw_curve), (1, 0), stresses):
        draw(stress, times, values, number, name)
    first, last = exact
    figure.draw_reference(stress, [0, first, first, last, last, 50], [0, 0, 1, 1, 0, 0], 1, "exact")
    stress.set(xlabel="time [µs]", ylabel="interface stress over the exact plateau [-]", xlim=(0, 50), ylim=(-0.1, 3.0))
    stress.legend(loc="upper right")

    for number, (name, points) in enumerate(families.items()):
        steps = [point[0] for point in points]
        for axes, place, aside in ((error, 1, (5, -9)), (depth, 2, (5, 2))):
            values = [point[place] for point in points]
            figure.draw_points(axes, steps, values, number, name)
            for at, (x, y) in enumerate(zip(steps, values)):
                if points[at][3]:
                    axes.annotate(points[at][3], (x, y), xytext=aside if at > 0 else (-15, -3), textcoords="offset points", fontsize=7)
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
