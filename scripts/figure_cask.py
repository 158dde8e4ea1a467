"""Figures of the cask: its settlement beside the round robin and NEPTUNE, studies of it, its mesh and its section."""
import numpy as np

from figure import CURVES, LineCollection, Rectangle, draw_curve, draw_faces, draw_range, new_figure, plt, use_style

# Maximum head settlement of the cask: three of the four codes of the round robin, and NEPTUNE; both
# as Kulak & Fiala report them with their Fig. 5. Millimetres and milliseconds.
ROUND_ROBIN = {"settlement": (58.0, 72.5), "time": (4.3, 6.25)}
NEPTUNE = {"settlement": 65.0, "time": 5.5}


def round_robin(axes):
    """The range of the round robin and NEPTUNE's point, in axes of ms and mm."""
    draw_range(axes, *ROUND_ROBIN["time"], *ROUND_ROBIN["settlement"], "round robin, three of four codes")
    axes.plot(NEPTUNE["time"], NEPTUNE["settlement"], linestyle="none", marker="*", markersize=11, color="white",
              markeredgecolor="black", markeredgewidth=0.8, zorder=5,
              label=f"NEPTUNE, {NEPTUNE['settlement']:g} mm at {NEPTUNE['time']:g} ms")


def reference_range(axes, quantity, neptune=True):
    """The range of the round robin and NEPTUNE's value of one quantity, across all abscissae."""
    low, high = ROUND_ROBIN[quantity]
    axes.axhspan(low, high, facecolor="#f0f0f0", edgecolor="#8c8c8c", hatch="////", linewidth=0.7, zorder=0,
                 label="round robin, three of four codes")
    if neptune:
        axes.axhline(NEPTUNE[quantity], color="black", linewidth=0.7, linestyle=(0, (1, 2)), zorder=1, label="NEPTUNE")


def settlement_figure(runs):
    """Fig. 5 of Kulak & Fiala: settlement of the lead's head over time after impact; runs are those of run_curves.settlements."""
    figure, axes = new_figure(width=120, height=84)
    round_robin(axes)
    number, last, highest = 0, ROUND_ROBIN["time"][1] + 0.25, ROUND_ROBIN["settlement"][1]
    for name, run in runs:
        who = "Nereid" if len(runs) == 1 else f"Nereid ({name})"
        for where in ("mean of the head", "centre of the head"):
            draw_curve(axes, run["time"], run[where], number, f"{who}, {where}")
            if where == "mean of the head":
                most, at = run["largest"]
                axes.plot(at, most, color=CURVES[number % len(CURVES)]["color"], marker="o", markersize=4.5, linestyle="none",
                          zorder=6, label=f"its maximum, {most:.1f} mm at {at:.2f} ms")
            number, last, highest = number + 1, max(last, run["time"][-1]), max(highest, np.nanmax(run[where]))
    axes.set_xlim(0, last)
    axes.set_ylim(0, 1.08 * highest)
    axes.set_xlabel("time after impact [ms]")
    axes.set_ylabel("head settlement, downwards [mm]")
    axes.legend(loc="lower right")
    return figure


def study_figure(points, abscissa, logarithmic=False, near=False, beyond=None):
    """Settlement and its time over one parameter of a study, with the references of both.

    points  (parameter, settlement [mm], time [ms]) by name of the quantity: {name: [...]}
    near    shows the curves large, and of the references only the edge of the range beside them
    beyond  {name: (settlement [mm], uncertainty [mm])} at parameter zero: what a sequence tends to
    """
    figure, (upper, lower) = new_figure(width=120, height=110, rows=2, ratios=[3, 2])
    reference_range(upper, "settlement", neptune=not near)
    reference_range(lower, "time", neptune=not near)
    for number, (name, rows) in enumerate(points.items()):
        rows = sorted(rows)
        style = {**CURVES[number % len(CURVES)], "markersize": 4, "markerfacecolor": "white", "markeredgewidth": 0.8}
        upper.plot([row[0] for row in rows], [row[1] for row in rows], label=name, zorder=3, **style)
        lower.plot([row[0] for row in rows], [row[2] for row in rows], zorder=3, **style)
        if beyond and name in beyond:
            value, uncertainty = beyond[name]
            upper.errorbar(0, value, yerr=uncertainty, color=style["color"], marker=style["marker"], markersize=4,
                           capsize=3, linewidth=0.9, clip_on=False, zorder=4, label="what it tends to, and its uncertainty")
    if logarithmic:
        upper.set_xscale("log")
    else:
        upper.set_xlim(left=0)
    if near:
        for axes, place, quantity in ((upper, 1, "settlement"), (lower, 2, "time")):
            seen = [row[place] for rows in points.values() for row in rows]
            if axes is upper and beyond:
                seen += [value + sign * uncertainty for value, uncertainty in beyond.values() for sign in (-1, 1)]
            edge = min(ROUND_ROBIN[quantity], key=lambda value: min(abs(value - one) for one in seen))
            low, high = min([*seen, edge]), max([*seen, edge])
            axes.set_ylim(low - 0.15 * (high - low), high + 0.4 * (high - low))  # room for the legend
    upper.set_ylabel("head settlement [mm]")
    lower.set_ylabel("its time [ms]")
    lower.set_xlabel(abscissa)
    upper.legend(loc="upper right", frameon=True, facecolor="white", edgecolor="none", framealpha=0.9)
    figure.align_ylabels()
    return figure


def elevation_figure(panels, floor=0.0):
    """The mesh in elevation: skin from outside on the left of the axis, section on the right.

    panels  (title, skin, section, plates): polygons [mm] of the skin's and of the section's faces,
            and the line [mm] of the skin's mid-surface in the section
    """
    use_style()
    figure, all_axes = plt.subplots(1, len(panels), sharey=True, squeeze=False, figsize=(120 / 25.4, 136 / 25.4),
                                    constrained_layout=True)
    corners = [corner for _, skin, section, _ in panels for polygon in skin + section for corner in polygon]
    most, top = (max(abs(corner[axis]) for corner in corners) for axis in (0, 1))
    for axes, (title, skin, section, plates) in zip(all_axes[0], panels):
        draw_faces(axes, skin, "#dce6ee")
        draw_faces(axes, section, "#e9e9e9")
        axes.add_collection(LineCollection([plates], colors="#0072B2", linewidths=1.6, zorder=4))
        axes.axvline(0, color="black", linewidth=0.6, linestyle=(0, (8, 2, 1, 2)), zorder=5)
        axes.plot([-1.3 * most, 1.3 * most], [floor, floor], color="black", linewidth=1.2, zorder=5)
        axes.add_patch(Rectangle((-1.3 * most, floor - 0.03 * top), 2.6 * most, 0.03 * top, facecolor="none",
                                 edgecolor="black", hatch="/////", linewidth=0, zorder=1))
        axes.set_xlim(-1.35 * most, 1.35 * most)
        axes.set_ylim(floor - 0.035 * top, 1.03 * top)
        axes.set_aspect("equal")
        axes.set_title(title)
        axes.set_xlabel("x [mm]")
    all_axes[0, 0].set_ylabel("z above the floor [mm]")
    return figure


def measure(axes, start, end, words, aside=0.0, **style):
    """A line with two arrow heads and its length, in the axes' own units; aside [mm] moves the words."""
    axes.annotate("", end, start, arrowprops={"arrowstyle": "<|-|>,head_width=0.12,head_length=0.35", "color": "black",
                                              "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0})
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    upright = start[0] == end[0]
    at = (middle[0] + aside, middle[1]) if upright else (middle[0], middle[1] + aside)
    axes.text(*at, words, rotation=90 if upright else 0, ha="center", va="center", fontsize=9, **style)


def schematic_figure(radius, length, thickness, speed):
    """Fig. 3 of Kulak & Fiala: the clad cylinder above the floor, in section; lengths in mm, speed in mm/s."""
    use_style()
    figure, axes = plt.subplots(figsize=(96 / 25.4, 120 / 25.4), constrained_layout=True)
    above = 150.0  # [mm] drawn between cask and floor
    axes.add_patch(Rectangle((-radius, above), 2 * radius, length, facecolor="#e9e9e9", edgecolor="black", linewidth=0.8))
    for side in (-radius - thickness, radius):
        axes.add_patch(Rectangle((side, above), thickness, length, facecolor="#0072B2", edgecolor="black", linewidth=0.5))
    axes.add_patch(Rectangle((-2.2 * radius, -40), 4.4 * radius, 40, facecolor="none", edgecolor="black", hatch="/////", linewidth=0))
    axes.plot([-2.2 * radius, 2.2 * radius], [0, 0], color="black", linewidth=1.4)
    axes.plot([0, 0], [above - 40, above + length + 60], color="black", linewidth=0.6, linestyle=(0, (8, 2, 1, 2)))
    axes.text(0, above + 0.56 * length, "lead", ha="center", va="center", fontsize=11, bbox={"facecolor": "#e9e9e9", "edgecolor": "none",
        "pad": 2})
    axes.annotate("stainless steel", (radius + thickness / 2, above + 0.8 * length), (radius + 60, above + 0.86 * length), fontsize=9,
                  va="center",
                  arrowprops={"arrowstyle": "-", "linewidth": 0.6, "shrinkA": 0, "shrinkB": 0})
    axes.text(-2.15 * radius, 22, "rigid floor", fontsize=9, va="center")
    measure(axes, (-radius, above + length + 45), (radius, above + length + 45), f"{2 * radius:g} mm", 30,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})
    for x in (-radius, radius):
        axes.plot([x, x], [above + length + 8, above + length + 60], color="black", linewidth=0.4)
    measure(axes, (-radius - 75, above), (-radius - 75, above + length), f"{length:g} mm", -32)
    for z in (above, above + length):
        axes.plot([-radius - 90, -radius - thickness - 8], [z, z], color="black", linewidth=0.4)
    for side, sign in ((radius, -1), (radius + thickness, 1)):
        axes.annotate("", (side, above + 0.33 * length), (side + sign * 60, above + 0.33 * length),
                      arrowprops={"arrowstyle": "-|>,head_width=0.12,head_length=0.35", "color": "black", "linewidth": 0.6,
                                  "shrinkA": 0, "shrinkB": 0})
    axes.text(radius + thickness + 66, above + 0.33 * length, f"{thickness:g} mm", fontsize=9, va="center")
    axes.annotate("", (radius + 100, 15), (radius + 100, above + 60),
                  arrowprops={"arrowstyle": "-|>,head_width=0.2,head_length=0.5", "color": "#D55E00", "linewidth": 1.4})
    axes.text(radius + 115, above / 2 + 35, f"{speed:,.0f} mm/s", fontsize=9, va="center", color="#D55E00")
    axes.set_xlim(-2.25 * radius, 2.45 * radius)
    axes.set_ylim(-45, above + length + 100)
    axes.set_aspect("equal")
    axes.axis("off")
    return figure


def confinement_figure(curves, ends):
    """Settlement over its time as the confinement of the lead varies, with the round robin and NEPTUNE.

    curves  {name: (rows, labels)}: rows (settlement [mm], time [ms] and, if wanted, first and last time within 1 % of it)
            in order, labels {row: words} at some of them
    ends    {words: (settlement, time)}: single runs
    """
    figure, axes = new_figure(width=140, height=112)
    round_robin(axes)
    for number, (name, (rows, labels)) in enumerate(curves.items()):
        style = {**CURVES[number], "markersize": 4, "markerfacecolor": "white", "markeredgewidth": 0.8}
        for settlement, _, *span in rows:
            if span:
                axes.plot(span, [settlement] * 2, color=style["color"], linewidth=0.5, alpha=0.45, zorder=2)
        axes.plot([row[1] for row in rows], [row[0] for row in rows], label=name, zorder=4, **style)
        for place, words in labels.items():
            right = number == 0  # the first curve runs below the others
            axes.annotate(words, (rows[place][1], rows[place][0]), xytext=(7, -6) if right else (-7, 5), zorder=7,
                          textcoords="offset points", fontsize=7.5, color=style["color"], ha="left" if right else "right", va="center")
    for words, (settlement, time) in ends.items():
        axes.plot(time, settlement, color="black", marker="s", markersize=4.5, linestyle="none", zorder=6)
        axes.annotate(words, (time, settlement), xytext=(-7, 3), textcoords="offset points", fontsize=8, ha="right")
    axes.set_xlabel("time of the largest settlement [ms]")
    axes.set_ylabel("largest settlement of the head [mm]")
    axes.legend(loc="upper left")
    return figure
