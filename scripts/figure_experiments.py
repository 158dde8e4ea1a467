"""All points of the comparison with experiments: computed over measured values, and each quantity with its bias and scatter."""
import figure

FAMILIES = [("taylor_copper", "Taylor bars, copper"), ("taylor_6061", "Taylor bars, 6061-T6"), ("taylor_4340", "Taylor bars, 4340"),
            ("oblique_sphere", "oblique spheres"), ("impulsive_plates", "plates under impulse"), ("square_tubes", "square tubes")]
PANELS = ["length", "foot", "belly", "deflection", "rebound", "spin", "length, heated", "foot, heated", "belly, heated"]  # in their order
COLUMNS = 5


def draw(points, bands):
    """The figure.

    points  [(family, quantity, measured, computed, counts)], numbers without a unit and positive; `counts` is false for batches whose metal
            is not that of the constants: open marks, in no band
    bands   {quantity: (bias, scatter, u_measured, number)} of the points that count [-]
    """
    shown = dict.fromkeys(one[1] for one in points)
    quantities = [name for name in PANELS if name in shown] + [name for name in shown if name not in PANELS]
    made, whole, panels = figure.new_overview(len(quantities), min(COLUMNS, len(quantities)), height=155.0)
    values = [x for one in points for x in one[2:4]]
    ends = [0.8 * min(values), 1.25 * max(values)]
    whole.plot(ends, ends, color="#000000", linewidth=0.8)
    for family, title in FAMILIES:
        for counts in (True, False):
            some = [one for one in points if one[0] == family and one[4] == counts]
            if some:
                put(whole, family, counts, some, False, f"{title} ({len(some)})" if counts else f"{title}, not counted ({len(some)})")
    whole.set(xscale="log", yscale="log", xlabel="measured [-]", ylabel="computed [-]")
    whole.legend(loc="upper left", ncols=2)
    for axes, quantity in zip(panels, quantities):
        band(axes, [one for one in points if one[1] == quantity], bands.get(quantity))
        axes.set_title(title_of(quantity, bands.get(quantity)), fontsize="small")
    for place in range(0, len(panels), COLUMNS):
        panels[place].set_ylabel("computed / measured [-]")
    for axes in panels[-COLUMNS:]:
        axes.set_xlabel("measured [-]")
    return made


def title_of(quantity, found):
    return f"{quantity} ({found[3]})\nbias {found[0]:.3f}, scatter {found[1]:.3f}" if found else quantity


def put(axes, family, counts, points, as_ratio, label=None):
    look = figure.CURVES[[name for name, _ in FAMILIES].index(family)]
    axes.plot([one[2] for one in points], [one[3] / one[2] if as_ratio else one[3] for one in points], linestyle="", marker=look["marker"],
              color=look["color"], markersize=3, markerfacecolor=look["color"] if counts else "none", markeredgewidth=0.5, label=label)


def band(axes, points, found):
    """The ratio of one quantity: its bias, twice the scatter of the model about it, twice the uncertainty of measurements about one."""
    axes.axhline(1, color="#000000", linewidth=0.8)
    if found:
        bias, scatter, u, _ = found
        axes.axhspan(bias * (1 - 2 * scatter), bias * (1 + 2 * scatter), color="#D55E00", alpha=0.15, linewidth=0)
        axes.axhline(bias, color="#D55E00", linewidth=0.8)
        for level in (1 - 2 * u, 1 + 2 * u):
            axes.axhline(level, color="#000000", linestyle=(0, (2, 2)), linewidth=0.6)
    for family, counts in dict.fromkeys((one[0], one[4]) for one in points):
        put(axes, family, counts, [one for one in points if (one[0], one[4]) == (family, counts)], True)
