"""Histories and energy balance of a report."""
import numpy as np

import figure_report as figures
import report_energy as energy
from report_run import dict_of, number_of
from report_text import (ROUND_OFF, anchor, axis_scale, esc, folded, missing, named, number, picture, plain_quantity, run_heading, scale_of,
                         share, table, tag)

MOST_POINTS = 60     # of a run without times: more are joined by a curve
MOST_CURVES = 6      # of one run in a diagram
LONGEST_LEGEND = 44  # letters of all names above a diagram: beyond them runs are told by their letters
ALIKE = 20.0         # curves whose largest values differ by more have diagrams of their own
NOTHING = 1e-9       # of the largest column of the unit: less is round-off
WORDS_OF_UNITS = {"m": "length", "Pa": "stress", "N": "force", "m/s": "velocity", "J": "energy", "J/m^3": "energy density",
                  "N*s": "impulse"}


# ------------------------------------------------------------------------------------------------
# Histories

def histories(runs, wanted, times):
    shown = [run for run in runs if run.first]
    if not shown:
        return missing("There are no histories.")
    names = list(dict.fromkeys(name for run in shown for name in run.probes()))
    if wanted.probes:
        names = [name for name in names if name in wanted.probes]
    if not names:
        return "<p>The run has no probes, so the histories hold the energies alone.</p>"
    empty = [name for name in names if not any(has_numbers(run, name) for run in shown)]
    names = [name for name in names if name not in empty]
    zero = zero_columns(shown, names)
    parts = []
    if empty:
        parts.append(f"<p class=quiet>Without a finite number in any row, and not drawn: {esc(', '.join(empty))}.</p>")
    if zero:
        parts.append(f"<p class=quiet>Zero but for round-off in every row, and not drawn: {esc(', '.join(zero))}.</p>")
    drawn = [name for name in names if name not in zero]
    means = [name for name in drawn if any(name in run.means for run in shown)]
    if means:
        parts.append("<p class=quiet>Forces drawn as steps are means over the time since the row before, so that force times time adds up "
                     f"to the impulse: {esc(', '.join(means))}.</p>")
    bundles = [[name] for name in drawn] if len(shown) > 1 else bundled(shown[0], drawn)
    boxes = [history_box(shown, bundle, times) for bundle in bundles]
    parts.append(f"<div class='row curves {'three' if len(boxes) > 2 else 'two'}'>" + "".join(boxes) + "</div>")
    if times.marks(1.0) and boxes:
        parts.append("<p class=quiet>Dotted lines are the times of the pictures.</p>")
    for run in runs:
        if len(runs) > 1 and run.first:
            lacking = [name for name in names if name not in run.columns]
            if lacking:
                parts.append(f"<p class=quiet>{named(run)} has no {esc(', '.join(lacking))}.</p>")
            unknown = [name for name in names if name in run.columns and not has_numbers(run, name)]
            if unknown:
                parts.append(f"<p class=quiet>{named(run)} has no finite number in any row of {esc(', '.join(unknown))}.</p>")
    return "".join(parts)


def has_numbers(run, name):
    """Whether a column of a run has a finite number."""
    return name in run.columns and bool(np.any(np.isfinite(run.columns[name])))


def largest(values):
    """The largest magnitude of the finite numbers."""
    return float(np.max(np.abs(values[np.isfinite(values)])))


def zero_columns(runs, names):
    """Columns that are zero, or no more than round-off of the largest column of their unit, in all runs."""
    sizes = [(run.units[name], name, largest(run.columns[name])) for run in runs for name in names if has_numbers(run, name)]
    most = {unit: max(size for one, _, size in sizes if one == unit) for unit, _, _ in sizes}
    some = {name for unit, name, size in sizes if size > (NOTHING * most[unit] if unit != "1" else 0)}
    return [name for name in names if name not in some]


def bundled(run, names):
    """Lists of columns of one quantity, unit and size, which one diagram has."""
    quantities, found = run.quantities(), []
    for name in names:
        kind = quantities.get(name, ""), run.units[name]
        size = largest(run.columns[name])
        for bundle in found:
            of_kind, of_size, members = bundle
            if kind == of_kind and len(members) < MOST_CURVES and size < ALIKE * of_size and of_size < ALIKE * size:
                members.append(name)
                break
        else:
            found.append((kind, size, [name]))
    return [members for _, _, members in found]


def history_box(runs, names, times):
    having = [run for run in runs if any(has_numbers(run, name) for name in names)]
    run = having[0]
    quantity_of, unit = run.quantities().get(names[0], ""), run.units[names[0]]
    across_factor, across = axis_of(having)
    size = max(largest(one.columns[name]) for one in having for name in names if has_numbers(one, name))
    factor, shown = axis_scale(size, unit)
    curves = [(label_of(one, name, names, runs), one.columns[one.first] / across_factor, one.columns[name] / factor, name in one.means)
              for one in having for name in names if has_numbers(one, name)]
    title = names[0] if len(names) == 1 else quantity_of or WORDS_OF_UNITS.get(unit, "value")
    mean = ", mean" if any(one[3] for one in curves) else ""
    up = f"{title.replace('_', ' ')}{mean} [{shown or '–'}]"
    few = not run.over_time and len(curves[0][1]) <= MOST_POINTS
    svg = figures.history_figure(curves, across, up, times.marks(across_factor), few, above=len(runs) > 1)
    said = names[0] if len(names) == 1 else ", ".join(names)
    more = f": {quantity_of.replace('_', ' ')}" if quantity_of not in ("", said) else ""
    return picture(svg, "svg+xml", f"history of {said}", esc(said + more))


def label_of(run, name, names, runs):
    if len(runs) == 1:
        return name
    short = sum(len(one.name) + 6 for one in runs) < LONGEST_LEGEND
    return (f"{run.key} {run.name}" if short else run.key) + ("" if len(names) == 1 else f": {name}")


def axis_of(runs):
    """(factor, words) of what the histories are over."""
    run = runs[0]
    unit = run.first_unit
    factor, shown = scale_of(max(float(np.nanmax(np.abs(one.columns[one.first]))) for one in runs), unit)
    return factor, f"{run.first.replace('_', ' ')} [{shown or '–'}]"


# ------------------------------------------------------------------------------------------------
# Energy

def energies(runs, times):
    having = [run for run in runs if run.energies() or run.accounts()]
    if not having:
        return "<p>The program keeps no energy balance, or its files are missing.</p>"
    parts = []
    for run in having:
        parts.append(run_heading(run, runs) + energy_diagrams(run, times))
    parts.append(balance_table([run for run in having if run.accounts()]))
    for run in having:
        if run.accounts():
            title = "Every source of force at the end" + (f": {named(run)}" if run.key else "")
            parts.append(folded(title, source_table(run), len(runs) == 1))
    for run in runs:
        if run not in having:
            parts.append(missing(f"{tag(run)}The run has no energy balance."))
    return "".join(parts)


def energy_diagrams(run, times):
    if not run.energies():
        return missing(f"{tag(run)}There are no histories of energies.")
    groups, outside = energy.over_time(run)
    large, small = energy.drawn(groups)
    across_factor, across = axis_of([run])
    most = max((float(np.nanmax(np.abs(values))) for values in groups.values()), default=0.0)
    if most == 0:
        return f"<p>{tag(run)}All energies are zero.</p>"
    factor, shown = scale_of(most, "J")
    start = sum(values[0] for values in groups.values()) - outside[0]
    svg = figures.energy_figure(run.columns[run.first] / across_factor, {name: values / factor for name, values in large.items()},
                                sum(groups.values()) / factor, (start + outside) / factor, across, f"energy [{shown}]",
                                times.marks(across_factor))
    said = "Energies since the start."
    if small:
        said += " Not drawn, with their largest share of the largest energy: " + ", ".join(
            f"{esc(name)} {share(part, 2)}" for name, part in small.items()) + "."
    parts = [picture(svg, "svg+xml", f"energies of {run.name}", said, "width:100%;max-width:56rem")]
    created, limit = energy.created_over_time(run)
    if created:
        few = dict(sorted(created.items(), key=lambda one: -float(np.nanmax(np.abs(one[1]))))[:6])
        svg = figures.created_figure(run.columns[run.first] / across_factor, few, across, limit, 1e-13)
        more = f" The six largest of {len(created)} sources." if len(created) > 6 else ""
        said = ("Created energy: spurious energy in the account of one source, whose work, stores and losses do not add up to zero; its "
                f"magnitude over the energy of the scene ({plain_quantity(run.ledger('energy_scale'), 'J', 4)}).{more}")
        parts.append(picture(svg, "svg+xml", f"created energy of {run.name}", said, "width:100%;max-width:56rem"))
    elif run.summary:
        parts.append("<p class=quiet>No source created or lost energy.</p>")
    else:
        parts.append(missing(f"{tag(run)}Created energy is not drawn over the energy of the scene, which is in summary.json."))
    return "".join(parts)


def balance_table(runs):
    """Where the energy is at the end, a column for each run."""
    if not runs:
        return ""
    return table(*energy.balance(runs), "t" + "nn" * len(runs), "The balance at the end.")


def source_table(run):
    accounts = run.accounts()
    most = max((abs(number_of(one.get("passed"))) for one in accounts.values()), default=0.0) or run.ledger("energy_scale")
    factor, shown = scale_of(most, "J")
    rows, idle = [], []
    for name, one in accounts.items():
        stored, lost = ({channel.replace("_", " "): number_of(value) for channel, value in dict_of(one, key).items()
                         if abs(number_of(value)) > ROUND_OFF * run.ledger("energy_scale")} for key in ("stored", "dissipated"))
        work, created = number_of(one.get("work")), number_of(one.get("created"))
        if not (work or created or stored or lost):
            idle.append(name)
            continue
        parts = ["<br>".join(f"{esc(channel)} {number(value / factor, 4)}" for channel, value in some.items()) for some in (stored, lost)]
        relative, flow = (number_of(one.get(key)) for key in ("created_relative", "created_of_passed"))
        rows.append([f"<a href='#{esc(anchor(run, f'source-{name}'))}'>{esc(name)}</a>", esc(str(one.get("kind", "")).replace("_", " ")),
                     number(work / factor, 4), *parts, number(created / factor, 3), *(share(x, 2) for x in (relative, flow))])
    columns = ["source", "kind", f"work on the nodes [{shown}]", f"stored [{shown}]", f"dissipated [{shown}]", f"created [{shown}]",
               "created, of the scene", "at worst, of what passed"]
    none = f"<p class=quiet>Without energy: {esc(', '.join(idle))}.</p>" if idle else ""
    return table(columns, rows, "ttnttnnn") + none
