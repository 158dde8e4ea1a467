"""Figure of a run: where its energy is, and what was created out of nothing, over time."""
import re

import numpy as np

from figure import DOUBLE_COLUMN, draw_curve, new_figure


def energy_figure(time, held, made, curves=7):
    """Where the energy of a run is, and what was created out of nothing, over time; as run_curves.energies gives them."""
    figure, (upper, lower) = new_figure(width=DOUBLE_COLUMN, height=120, rows=2, ratios=[2, 1])
    plain = {name: re.sub("^energy_(created_)?", "", name).replace("_", " ") for name in (*held, *made)}

    # The largest shares are drawn one by one; the others, and those under 1 %, as their sum.
    size = {name: np.nanmax(np.abs(values)) for name, values in held.items()}
    order = sorted(held, key=lambda name: -size[name])
    shown = [name for name in order[:curves - 1] if size[name] >= 1]
    if len(order) == len(shown) + 1:
        shown = order  # one alone is not worth calling "others"
    for number, name in enumerate(shown):
        draw_curve(upper, time, held[name], number, plain[name], marks=12)
    if len(shown) < len(order):
        rest = order[len(shown):]
        draw_curve(upper, time, sum(held[name] for name in rest), len(shown), f"{len(rest)} others together", marks=12)
    upper.plot(time, sum(held.values()), color="black", linewidth=0.6, label="sum of all", zorder=2)
    upper.set_ylabel("energy [% of initial kinetic]")
    upper.set_ylim(bottom=min(0.0, 1.05 * min(np.nanmin(values) for values in held.values())))
    upper.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))

    if any(np.any(values) for values in made.values()):
        for number, name in enumerate(made):
            draw_curve(lower, time, np.where(made[name] == 0, np.nan, np.abs(made[name])), number,
                       plain[name] if np.any(made[name]) else f"{plain[name]} (none)", marks=12)
        lower.set_yscale("log")
        lower.set_ylim(bottom=max(lower.get_ylim()[0], 1e-18))  # what is below is round-off of nearly nothing
        lower.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    else:
        lower.text(0.5, 0.5, "none", transform=lower.transAxes, ha="center", va="center")
        lower.set_yticks([])
    lower.set_ylabel("created, magnitude [%]")
    lower.set_xlabel("time [ms]")
    lower.set_xlim(time[0], time[-1])
    figure.align_ylabels()
    return figure
