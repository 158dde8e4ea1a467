"""A history before and behind a filter (scripts/cfc): a panel for each column."""
import figure


def filters_figure(times, panels):
    """panels: [(name, unit, times of the rows [s], values there, values behind the filter at `times`), ...]."""
    drawn, rows = figure.new_grid(len(panels), 1, height=22.0 + 48.0 * len(panels))
    for (axes,), (name, unit, rows_at, values, smooth) in zip(rows, panels):
        figure.draw_band(axes, rows_at, values, 1, "as written by the run")
        figure.draw_curve(axes, times, smooth, 0, name)
        axes.set(ylabel=f"[{unit}]", xlim=(times[0], times[-1]))
        axes.legend(loc="best")
    rows[-1][0].set_xlabel("time [s]")
    return drawn
