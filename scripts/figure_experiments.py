"""All points of the comparison with experiments: computed over measured values, and below their ratio, with bands of bias and scatter."""
import figure

FAMILIES = [("taylor_copper", "Taylor bars, copper"), ("taylor_6061", "Taylor bars, 6061-T6"), ("taylor_4340", "Taylor bars, 4340"),
            ("oblique_sphere", "oblique spheres"), ("impulsive_plates", "plates under impulse"), ("square_tubes", "square tubes")]


def draw(points, bias, scatter, u_measured, others):
    """The figure.

    points      [(family, measured, computed)], all without a unit and positive
    bias, scatter, u_measured   of the points that count [-]
    others      [(family, measured, computed)] of batches whose metal is not that of the constants: open marks, in no band
    """
    made, (upper, lower) = figure.new_figure(figure.DOUBLE_COLUMN, 120.0, rows=2, ratios=(2, 1))
    values = [x for one in points for x in one[1:3]] + [x for one in others for x in one[1:3]]
    low, high = 0.8 * min(values), 1.25 * max(values)
    ends = [low, high]
    upper.plot(ends, ends, color="#000000", linewidth=0.8)
    lower.axhline(1, color="#000000", linewidth=0.8)
    for part, style in ((2 * u_measured, (0, (2, 2))), (None, "-"), (2 * scatter, (0, (6, 2)))):
        levels = [1 - part, 1 + part] if style == (0, (2, 2)) else [bias] if part is None else [bias * (1 - part), bias * (1 + part)]
        colour = "#000000" if style == (0, (2, 2)) else "#D55E00"
        for level in levels:
            upper.plot(ends, [level * x for x in ends], color=colour, linestyle=style, linewidth=0.6)
            lower.axhline(level, color=colour, linestyle=style, linewidth=0.6)
    for number, (family, title) in enumerate(FAMILIES):
        look = figure.CURVES[number]
        for some, filled in (([one for one in points if one[0] == family], True), ([one for one in others if one[0] == family], False)):
            if not some:
                continue
            measured, computed = [one[1] for one in some], [one[2] for one in some]
            marks = {"linestyle": "", "marker": look["marker"], "color": look["color"], "markersize": 3,
                     "markerfacecolor": look["color"] if filled else "none", "markeredgewidth": 0.5}
            upper.plot(measured, computed, label=f"{title} ({len(some)})" if filled else f"{title}, not counted ({len(some)})", **marks)
            lower.plot(measured, [c / m for m, c in zip(measured, computed)], **marks)
    upper.set_xscale("log")
    upper.set_yscale("log")
    lower.set_xscale("log")
    upper.set_ylabel("computed")
    lower.set_xlabel("measured (ratios of lengths, tangents, spins and forces)")
    lower.set_ylabel("computed / measured")
    upper.legend(loc="upper left", ncols=2)
    return made
