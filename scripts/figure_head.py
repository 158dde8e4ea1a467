"""Figures of a reactor's head: what junctures of plugs carry, and how plates of a stack move, over time."""
import numpy as np

from figure import DOUBLE_COLUMN, draw_curve, new_figure


def plugs_figure(time, groups):
    """Forces that the ledges carry, and the velocities of the bodies, a pair of panels for each group of run_curves.plugs."""
    figure, axes = new_figure(width=DOUBLE_COLUMN, height=55 * 2 * len(groups), rows=2 * len(groups), ratios=[1] * 2 * len(groups))
    for row, group in enumerate(groups):
        upper, lower = axes[2 * row:2 * row + 2]
        for number, (body, strike, force, velocity) in enumerate(group):
            draw_curve(upper, time, force, number, strike, marks=12)
            draw_curve(lower, time, velocity, number, body, marks=12)
        upper.set_ylabel("force of what is modelled [MN]")
        lower.set_ylabel("upward velocity [m/s]")
        finish(lower, upper, time)
    for axis in axes[:-1]:
        axis.set_xlabel("")
    return figure


def plates_figure(runs):
    """The velocities of the plates in the runs of run_curves.plates, one below the other."""
    figure, axes = new_figure(width=DOUBLE_COLUMN, height=55 * len(runs), rows=len(runs), ratios=[1] * len(runs))
    for axis, (name, time, velocities) in zip(np.atleast_1d(axes), runs):
        for number, (plate, velocity) in enumerate(velocities.items()):
            draw_curve(axis, time, velocity, number, plate, marks=12)
        axis.set_ylabel(f"{name}: velocity [m/s]")
        axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    for axis in np.atleast_1d(axes):
        axis.set_xlim(0, min(time[-1] for _, time, _ in runs))
    np.atleast_1d(axes)[-1].set_xlabel("time [ms]")
    return figure


def finish(lower, upper, time):
    for axis in (lower, upper):
        axis.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        axis.set_xlim(time[0], time[-1])
    lower.set_xlabel("time [ms]")
