"""Figures of a reactor's head: what junctures of plugs carry, and how plates of a stack move, over time."""
import numpy as np

from figure import DOUBLE_COLUMN, draw_curve, new_figure
from run_files import column, read_history

PLUGS = ("small", "intermediate", "large")


def plugs_figure(folder):
    """Forces that the ledges carry, and the velocities of the plugs, of a run of plug_juncture, and those of its shield plates."""
    history = read_history(folder)
    time = column(history, "time", "s", folder) * 1e3
    plates = [name.removeprefix("velocity_") for name in history[0] if name.startswith("velocity_plate_")]
    shown = [(plates, plates, [f"gap {i + 1}" for i in range(len(plates))])] if plates else []
    shown.append((PLUGS, [str(i + 1) for i in range(len(PLUGS))], [f"juncture {i + 1}" for i in range(len(PLUGS))]))
    figure, axes = new_figure(width=DOUBLE_COLUMN, height=55 * 2 * len(shown), rows=2 * len(shown), ratios=[1] * 2 * len(shown))
    for row, (bodies, forces, strikes) in enumerate(shown):
        upper, lower = axes[2 * row:2 * row + 2]
        for number, (body, force, strike) in enumerate(zip(bodies, forces, strikes)):
            draw_curve(upper, time, -column(history, f"force_{force}", "N", folder) * 1e-6, number, strike, marks=12)
            draw_curve(lower, time, column(history, f"velocity_{body}", "m/s", folder), number, body.replace("_", " "), marks=12)
        upper.set_ylabel("force of what is modelled [MN]")
        lower.set_ylabel("upward velocity [m/s]")
        finish(lower, upper, time)
    for axis in axes[:-1]:
        axis.set_xlabel("")
    return figure


def plates_figure(folders):
    """The velocities of the plates in runs of shield_plates, one below the other."""
    figure, axes = new_figure(width=DOUBLE_COLUMN, height=55 * len(folders), rows=len(folders), ratios=[1] * len(folders))
    end = np.inf
    for axis, folder in zip(np.atleast_1d(axes), folders):
        history = read_history(folder)
        time = column(history, "time", "s", folder) * 1e3
        end = min(end, time[-1])
        plates = [name for name in history[0] if name.startswith("velocity_")]
        for number, name in enumerate(plates):
            draw_curve(axis, time, column(history, name, "m/s", folder), number, name.replace("velocity_", "plate "), marks=12)
        axis.set_ylabel(f"{folder.name}: velocity [m/s]")
        axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    for axis in np.atleast_1d(axes):
        axis.set_xlim(0, end)
    np.atleast_1d(axes)[-1].set_xlabel("time [ms]")
    return figure


def finish(lower, upper, time):
    for axis in (lower, upper):
        axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        axis.set_xlim(time[0], time[-1])
    lower.set_xlabel("time [ms]")
