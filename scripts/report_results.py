"""Results, overlaps and cost of a report, side by side where there are several runs."""
import math
from pathlib import Path

from report_run import dict_of, list_of, number_of, vector_of
from report_text import anchor, duration, esc, missing, named, number, quantity, scale_of, table, tag

MORE_THAN = 0.05  # differences of results that are printed bold
NOTHING = 1e-9    # of the largest value of the unit: less is round-off, and no per cent of it is given
NOTHING_OF_PROBE = 1e-7  # the same, of the largest value of its own probe
ROUND_OFF = "<span class=quiet>round-off</span>"


# ------------------------------------------------------------------------------------------------
# Results

ENDS_OF_PROBES = ("last", "largest", "largest_at", "smallest", "smallest_at")


def results(runs):
    having = [run for run in runs if run.results()]
    if not having:
        return missing("There are no results, since they are in summary.json.") + touched(runs) + overlaps(runs)
    parts = [*(missing(f"{tag(run)}There are no results, since they are in summary.json.") for run in runs if run not in having)]
    if len(having) == 1:
        probes, others = sorted_out(having)
        parts += [probe_table(having[0], probes), value_table(having[0], others)]
    else:
        for title, names in compared(having):
            parts.append(comparison(having, names, title))
    return "".join([*parts, touched(runs), overlaps(runs)])


def sorted_out(runs):
    """(names of probes, names of the results that are of no probe) of some runs."""
    names = list(dict.fromkeys(name for run in runs for name in run.results()))
    probes = [name.removesuffix("_largest_at") for name in names if name.endswith("_largest_at") and f"{name[:-11]}_last" in names]
    taken = {f"{probe}_{end}" for probe in probes for end in ENDS_OF_PROBES}
    return probes, [name for name in names if name not in taken]


def compared(runs):
    """[(title, names of results)] that are side by side."""
    probes, others = sorted_out(runs)
    there = {name for run in runs for name in run.results()}
    ends = [f"{probe}_{end}" for probe in probes for end in ENDS_OF_PROBES if not end.endswith("_at")]
    return [("Probes.", [name for name in ends if name in there]), ("Other results.", others)]


def probe_table(run, probes):
    if not probes:
        return ""
    time_factor, time_unit = scale_of(run.end, "s")
    found, quantities, rows = run.results(), run.quantities(), []
    for probe in probes:
        unit = found[f"{probe}_last"][1]
        value = {end: found.get(f"{probe}_{end}", (math.nan, ""))[0] for end in ENDS_OF_PROBES}
        size = max((abs(value[end]) for end in ("last", "largest", "smallest") if math.isfinite(value[end])), default=0)
        factor, shown = scale_of(size, unit)
        rows.append((anchor(run, f"probe-{probe}"), [esc(probe), esc(quantities.get(probe, "").replace("_", " ")), esc(shown or "–"),
                     *(number(value[end] / (time_factor if end.endswith("_at") else factor)) for end in ENDS_OF_PROBES)]))
    columns = ["probe", "quantity", "unit", "last", "largest", f"at [{time_unit}]", "smallest", f"at [{time_unit}]"]
    return table(columns, rows, "tttnnnnn", "Probes: the largest and the smallest value are those of all steps.")


def value_table(run, names):
    if not names:
        return ""
    found = run.results()
    rows = [(anchor(run, f"result-{name}"), [esc(name), quantity(*found[name])]) for name in names]
    half = (len(rows) + 1) // 2
    if len(rows) < 12:
        return table(["result", ""], rows, "tn", "Other results." if len(names) < len(found) else "")
    columns = "".join(f"<div>{table(['result', ''], some, 'tn')}</div>" for some in (rows[:half], rows[half:]))
    return f"<p class=quiet>Other results.</p><div class='row two'>{columns}</div>"


def comparison(runs, names, title):
    if not names:
        return ""
    columns, rows, zero = side_by_side(runs, names)
    none = f"<p class=quiet>Zero in all runs: {esc(', '.join(zero))}.</p>" if zero else ""
    return table(columns, rows, "tt" + "n" * (2 * len(runs) - 1), f"{title} {meaning(runs)}") + none


def meaning(runs):
    """What the differences are."""
    first, others = runs[0].key, " or ".join(run.key for run in runs[1:])
    return (f"Differences are in per cent of the magnitude of {first}; positive: {others} is larger. Round-off: all values are below "
            f"{number(NOTHING_OF_PROBE)} of the largest of their probe, or below {number(NOTHING)} of the largest of their unit.")


def side_by_side(runs, names):
    """(columns, rows, names of results that are zero in all runs) of results, with the difference from the first run."""
    found = [run.results() for run in runs]
    units = {name: unit for some in found for name, (_, unit) in some.items()}
    nothing = sizes_of_nothing(found, sorted_out(runs)[0])
    rows, zero = [], []
    for name in names:
        unit, values = units[name], [some.get(name, (None, ""))[0] for some in found]
        size = max((abs(value) for value in values if value is not None and math.isfinite(value)), default=0.0)
        factor, shown = scale_of(size, unit)
        if size == 0 and all(value == 0 for value in values if value is not None):
            zero.append(name)
            continue
        row = [esc(name), esc(shown or "–"), *("–" if value is None else number(value / factor) for value in values)]
        rows.append(row + [difference(values[0], value, nothing[name]) for value in values[1:]])
    return ["result", "unit", *(named(run) for run in runs), *(f"{run.key} − {runs[0].key}" for run in runs[1:])], rows, zero


def sizes_of_nothing(found, probes):
    """{result: values up to which it is round-off} of the results of some runs."""
    largest = {}
    of_probe = {f"{probe}_{end}": probe for probe in probes for end in ENDS_OF_PROBES if not end.endswith("_at")}
    for some in found:
        for name, (value, unit) in some.items():
            for key in ((unit,), of_probe.get(name)) if math.isfinite(value) else ():
                largest[key] = max(largest.get(key, 0.0), abs(value))
    return {name: max(NOTHING * largest.get((unit,), 0.0), NOTHING_OF_PROBE * largest.get(of_probe[name], 0.0) if name in of_probe else 0.0)
            for some in found for name, (_, unit) in some.items()}


def difference(ours, theirs, nothing):
    if ours is None or theirs is None or not (math.isfinite(ours) and math.isfinite(theirs)):
        return "–"
    if ours == theirs:
        return "0"
    if max(abs(ours), abs(theirs)) <= nothing:
        return ROUND_OFF
    if abs(ours) <= nothing:
        return "from 0"
    part = (theirs - ours) / abs(ours)
    said = f"{'+' if part > 0 else '−'}{number(100 * abs(part), 3)} %"
    return f"<b>{said}</b>" if abs(part) > MORE_THAN else said


def touched(runs):
    parts = []
    for run in runs:
        rows = []
        for one in run.listed_in("touched"):
            impulse = vector_of(one.get("impulse"))
            size = math.hypot(*impulse) if impulse else math.nan
            rows.append([esc(one.get("contact", "")), esc(" and ".join(map(str, list_of(one, "sides")))),
                         *(quantity(number_of(one.get(key)), "s") for key in ("first_touch", "last_touch")), quantity(size, "N*s")])
        if rows:
            parts.append(table(["contact", "sides", "first touch", "last touch", "impulse"], rows, "ttnnn",
                               f"{tag(run)}Contacts that were closed."))
    return "".join(parts)


def overlaps(runs):
    parts = []
    for run in runs:
        rows = []
        for one in run.listed_in("overlaps"):
            at = ", ".join(f"{x:.4g}" for x in vector_of(one.get("place")))
            rows.append([esc(" and ".join(map(str, list_of(one, "bodies")))), esc(", ".join(map(str, list_of(one, "contacts"))) or "none"),
                         quantity(number_of(one.get("deepest")), "m", 4), number(number_of(one.get("elements")), 3),
                         quantity(number_of(one.get("at_start")), "m", 3), quantity(number_of(one.get("time")), "s"), esc(f"({at}) m")])
        if rows:
            parts.append(f"<div id='{esc(anchor(run, 'overlaps'))}'>" + table(
                ["bodies", "contacts between them", "deepest", "elements", "at the start", "time", "place"], rows, "ttnnnnt",
                f"{tag(run)}Overlaps of bodies that the audit found; elements: by how many elements they grew.") + "</div>")
        elif run.summary:
            parts.append(f"<p class=quiet id='{esc(anchor(run, 'overlaps'))}'>{tag(run)}The audit found no overlap of bodies.</p>")
    return "".join(parts)


# ------------------------------------------------------------------------------------------------
# Cost

def cost(runs):
    having = [run for run in runs if run.cost()]
    if not having:
        return missing("The cost is unknown, since it is in summary.json.")
    rows = []
    named_costs = (("elements", "elements"), ("steps", "steps"), ("element updates", "element_updates"),
                   ("time on the clock", "wall_seconds"),
                   ("time of an element update", "nanoseconds_per_element_update"), ("threads", "threads"), ("frames", "frames"))
    for title, key in named_costs:
        values = [run.cost().get(key) for run in having]
        if any(values):
            rows.append([title, *(cost_cell(key, value) for value in values)])
    for title, key in (("smallest time step", "smallest_step"), ("largest time step", "largest_step")):
        if any(key in run.results() for run in having):
            rows.append([title, *(quantity(*run.results()[key]) if key in run.results() else "–" for run in having)])
    if any(run.limited_by() for run in having):
        rows.append(["smallest step limited by", *(esc(run.limited_by() or "–") for run in having)])
    rows.append(["size of the folder", *(folder_size(run.folder) for run in having)])
    parts = [*(missing(f"{tag(run)}The cost is unknown, since it is in summary.json.") for run in runs if run not in having),
             table(["", *(named(run) for run in having)] if len(runs) > 1 else ["", ""], rows, "t" + "n" * len(having))]
    for run in having:
        parts.append(cost_of_contact(run))
    return "".join(parts)


def cost_cell(key, value):
    if not isinstance(value, (int, float)):
        return "–"
    if key == "wall_seconds":
        return duration(float(value))
    if key == "nanoseconds_per_element_update":
        return f"{number(float(value), 4)}&nbsp;ns" if value else "–"
    return f"{value:,}".replace(",", "\u202f")


def folder_size(folder):
    size = sum(path.stat().st_size for path in Path(folder).rglob("*") if path.is_file())
    return f"{size / 1e6:.3g}&nbsp;MB" if size >= 1e5 else f"{size / 1e3:.3g}&nbsp;kB"


def cost_of_contact(run):
    """Parts of the time on the clock."""
    contact, wall = dict_of(run.cost(), "contact"), float(run.cost().get("wall_seconds") or 0)
    if not contact or not wall:
        return ""
    stages = {name: value for name, value in dict_of(contact, "stages").items() if isinstance(value, (int, float))}
    rest = max(0.0, wall - float(contact.get("seconds", 0)))
    shares = [("elements and all that is not contact", rest), *((f"contact: {name}", float(value)) for name, value in stages.items())]
    said = float(contact.get("seconds", 0)) - sum(stages.values())
    if said > 1e-3 * wall:
        shares.append(("contact: other", said))
    rows = [[esc(name), quantity(value, "s", 3), f"{number(100 * value / wall, 2)}&nbsp;%",
             f"<span class=bar><i style='width:{min(100, 100 * value / wall):.1f}%'></i></span>"] for name, value in shares]
    counts = ", ".join(f"{value:,} {name}".replace(",", "\u202f") for name, value in contact.items() if isinstance(value, int))
    return table(["part", "time", "", ""], rows, "tnnt", f"{tag(run)}Parts of the time on the clock. Contact by multipliers: {counts}.")
