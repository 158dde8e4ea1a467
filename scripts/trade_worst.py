"""The worst error that each setting makes without a warning: from the points of all sweeps, verification/*/trade.csv.

A run counts if it differs from its case in one setting, ends well, and warns no more often than the case itself. What the setting makes
is the error of the run less that of the case. An error within the reference's uncertainty is not judged and does not count; where that of
the case is not judged, nothing is taken off. A change by less than a tenth is none.
"""
import csv
import dataclasses

import trade_points as points


@dataclasses.dataclass
class Row:
    """One line of trade.csv.

    knobs   {name: label} of what differs from the case
    errors  {result: error [-], or None where the reference cannot judge it}
    """
    case: str
    knobs: dict
    ending: str
    updates: int = 0
    warnings: int = 0
    errors: dict = dataclasses.field(default_factory=dict)

    def good(self):
        return self.ending == "good"


@dataclasses.dataclass
class Worst:
    """What a setting does over all cases.

    made      [-] the largest error that it makes without a warning; 0 where it makes none
    row, result, base   where: the run, the result, and the error of the case itself [-], None where it is not judged
    tried, warned, stopped  runs with this setting alone, those that warn, those that stop or are refused
    """
    made: float = 0.0
    row: Row | None = None
    result: str = ""
    base: float | None = None
    cost: float = 0.0        # [-] element updates over those of the case
    tried: int = 0
    warned: int = 0
    stopped: int = 0


# ------------------------------------------------------------------------------------------------
# Points that were written

def rows_of(stream, case, known):
    """The lines of a trade.csv; `known` are the names of the case's knobs."""
    found = []
    for line in csv.DictReader(stream):
        row = Row(case, knobs_of(line["settings"], known), line["ending"])
        if row.good():
            row.updates, row.warnings = int(line["element updates"]), int(line["warnings"])
            row.errors = {name: error_of(line, name) for name in results_of(line)}
        found.append(row)
    return found


def results_of(line):
    return [column.removeprefix("judged: ") for column in line if column.startswith("judged: ")]


def error_of(line, result):
    return float(line[f"error of {result} [-]"]) if line[f"judged: {result}"] == "yes" else None


def knobs_of(text, known):
    """{name: label} of 'mesh x2, step 1'; a label may hold a comma."""
    found = {}
    if text == points.Point({}, {}).name():
        return found
    name = ""
    for part in text.split(", "):
        word, _, label = part.partition(" ")
        if word in known and label:
            name = word
            found[name] = label
        else:
            found[name] += f", {part}"
    return found


# ------------------------------------------------------------------------------------------------
# The table

def worst_of(rows):
    """{name of a knob: Worst} over the rows of all cases; the settings that make most come first."""
    bases = {row.case: row for row in rows if not row.knobs}
    found = {}
    for row in rows:
        if len(row.knobs) != 1 or row.ending == "left out":
            continue
        (name,), base = row.knobs, bases[row.case]
        one = found.setdefault(name, Worst())
        one.tried += 1
        one.stopped += not row.good()
        if not row.good():
            continue
        if row.warnings > base.warnings:
            one.warned += 1
            continue
        for result, error in row.errors.items():
            made = error - (base.errors[result] or 0.0) if error is not None else 0.0
            if made > one.made and points.ENOUGH * error > (base.errors[result] or 0.0):
                one.made, one.row, one.result, one.base, one.cost = made, row, result, base.errors[result], row.updates / base.updates
    return dict(sorted(found.items(), key=lambda pair: -pair[1].made))


def worst_table(rows, titles):
    """The table as Markdown; titles are those of the cases."""
    lines = []
    for name, one in worst_of(rows).items():
        counts = [one.tried, one.warned or "", one.stopped or ""]
        if one.row is None:
            lines.append([name, "none", "", "", "", "", *counts])
            continue
        as_it_is = "not judged" if one.base is None else points.share(one.base)
        lines.append([name, points.share(one.made + (one.base or 0.0)), as_it_is, one.row.knobs[name],
                      f"{one.result}: {titles[one.row.case]}", f"x{one.cost:.2g}", *counts])
    return points.table(["setting", "worst error", "the case has", "value", "where", "updates", "tried", "warn", "stop"], lines)
