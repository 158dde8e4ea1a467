"""The worst error that each setting makes without a warning, and where it pays: from the points of all sweeps, verification/*/trade.csv.

A run counts if it differs from its case in one setting, ends well, and warns no more often than the case itself. What the setting makes
is the error of the run less that of the case. An error within the reference's uncertainty is not judged and does not count; where that of
the case is not judged, the uncertainty is taken off. A change by less than a tenth is none.

A setting pays for a result if a run with it, alone or with others, is on a front of that result: none that costs less is as accurate.
"""
import csv
import dataclasses

import trade_points as points


@dataclasses.dataclass
class Row:
    """One line of trade.csv.

    knobs   {name: label} of what differs from the case
    errors  {result: error [-], or None where the reference cannot judge it}
    counted {result: error that counts [-]}
    finer   how many finer meshes confirm it
    """
    case: str
    knobs: dict
    ending: str
    updates: int = 0
    seconds: float = 0.0
    warnings: int = 0
    errors: dict = dataclasses.field(default_factory=dict)
    counted: dict = dataclasses.field(default_factory=dict)
    finer: int = 0

    def good(self):
        return self.ending == "good"


@dataclasses.dataclass
class Worst:
    """What a setting does over all cases.

    made      [-] the largest error that it makes without a warning; 0 where it makes none
    row, result, base   where: the run, the result, and the error of the case itself [-], or the reference's uncertainty
    tried, warned, stopped  runs with this setting alone, those that warn, those that stop or are refused
    results, pays  results of the cases that have the setting, and those for which it pays
    """
    made: float = 0.0
    row: Row | None = None
    result: str = ""
    base: float = 0.0
    judged: bool = True      # whether the error of the case itself is
    cost: float = 0.0        # [-] element updates over those of the case
    tried: int = 0
    warned: int = 0
    stopped: int = 0
    results: int = 0
    pays: int = 0


# ------------------------------------------------------------------------------------------------
# Points that were written

def rows_of(stream, case, known):
    """The lines of a trade.csv; `known` are the names of the case's knobs."""
    found = []
    for line in csv.DictReader(stream):
        row = Row(case, knobs_of(line["settings"], known), line["ending"])
        if row.good():
            row.updates, row.seconds = int(line["element updates"]), float(line["processor seconds [s]"])
            row.warnings, row.finer = int(line["warnings"]), int(line["finer meshes"])
            row.errors = {name: error_of(line, name) for name in results_of(line)}
            row.counted = {name: float(line[f"error that counts of {name} [-]"]) for name in row.errors}
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
            if error is None:
                continue
            least = base.errors[result] or least_of(rows, row.case, result)
            if error - least > one.made and points.ENOUGH * error > least:
                one.made, one.row, one.result, one.cost = error - least, row, result, row.updates / base.updates
                one.base, one.judged = least, base.errors[result] is not None
    for case, base in bases.items():
        good = [row for row in rows if row.case == case and row.good()]
        for name, one in found.items():
            if any(name in row.knobs for row in good):
                one.results += len(base.errors)
                one.pays += sum(any(name in row.knobs for row in front_of(good, result)) for result in base.errors)
    return dict(sorted(found.items(), key=lambda pair: -pair[1].made))


def least_of(rows, case, result):
    """The least error that counts: the reference's uncertainty, where an error is not judged."""
    return min(row.counted[result] for row in rows if row.case == case and row.good())


def front_of(rows, result):
    """The rows of one case on the front of a result, by either cost, that finer meshes confirm."""
    enough = min(points.FINER, max(row.finer for row in rows))
    sure = [row for row in rows if row.finer >= enough]
    return [row for cost in (points.updates_of, points.seconds_of) for row in points.front(sure, cost, lambda row: row.counted[result])]


def worst_table(rows, titles):
    """The table as Markdown; titles are those of the cases."""
    lines = []
    for name, one in worst_of(rows).items():
        counts = [one.tried, one.warned or "", one.stopped or "", f"{one.pays} of {one.results}" if one.results else ""]
        if one.row is None:
            lines.append([name, "none", "", "", "", "", *counts])
            continue
        as_it_is = points.share(one.base) if one.judged else f"below {points.share(one.base)}"
        lines.append([name, points.share(one.made + one.base), as_it_is, one.row.knobs[name],
                      f"{one.result}: {titles[one.row.case]}", f"x{one.cost:.2g}", *counts])
    return points.table(["setting", "worst error", "the case has", "value", "where", "updates", "tried", "warn", "stop", "pays"], lines)


def said_of(rows, titles):
    """How much was run, and which cases warn by themselves."""
    good, own = [row for row in rows if row.good()], [row for row in rows if not row.knobs and row.warnings]
    said = f"{len(rows)} runs of {len(titles)} cases, {len(good)} of them with a result, in {sum(row.seconds for row in good) / 60:.0f} " \
           f"minutes of one processor, references apart."
    return said + (f"\nWarnings of the case itself are not counted: {', '.join(titles[row.case] for row in own)}." if own else "")
