"""What differs between some runs: values of their cases, results and energy balance; as tables of a page and as text."""
import html
import re

import report_energy
import report_results
from report_run import ENDINGS
from report_text import cells, esc, named

NOT_THERE = "<span class=quiet>not there</span>"


def settings(runs):
    """(columns, rows, how many values are the same) of the values of cases."""
    values = [run.values() for run in runs]
    names = list(dict.fromkeys(name for some in values for name in some))
    differ = [name for name in names if len({some.get(name, (None,))[0] for some in values}) > 1]
    rows = [[f"<code>{esc(name)}</code>", *(esc(some[name][0]) if name in some else NOT_THERE for some in values)] for name in differ]
    if len({run.provenance().get("commit") for run in runs}) > 1:
        rows.insert(0, ["commit of the program", *(f"<code>{esc(str(run.provenance().get('commit'))[:12])}</code>" for run in runs)])
    if len({run.summary.get("driver") for run in runs}) > 1:
        rows.insert(0, ["program", *(esc(run.summary.get("driver")) for run in runs)])
    return ["key", *(named(run) for run in runs)], rows, len(names) - len(differ)


# ------------------------------------------------------------------------------------------------
# As text

def text(runs):
    """The differences of some runs as lines."""
    parts = [f"{run.key} {run.folder}: {ENDINGS.get(run.word, run.word or 'it is unknown how it ended')}" for run in runs]
    parts += [f"{run.key}: {one}" for run in runs for one in run.missing]
    having = [run for run in runs if run.resolved()]
    if len(having) > 1:
        columns, rows, alike = settings(having)
        parts += ["", f"Values of the cases that differ; {alike} are the same.", *(lines_of(columns, rows) if rows else ["none"])]
    having = [run for run in runs if run.results()]
    if len(having) > 1:
        parts += ["", f"Results. {plain(report_results.meaning(having))}"]
        for title, names in report_results.compared(having):
            columns, rows, zero = report_results.side_by_side(having, names)
            if rows:
                parts += ["", title, *lines_of(columns, rows)]
            parts += [f"Zero in all runs: {', '.join(zero)}."] if zero else []
    having = [run for run in runs if run.accounts()]
    if having:
        parts += ["", "Energy balance at the end.", *lines_of(*report_energy.balance(having))]
    return "\n".join(parts) + "\n"


def lines_of(columns, rows):
    """A table with columns of equal width; the first is to the left, the others to the right."""
    table = [[plain(cell) for cell in cells(row)] for row in (columns, *rows)]
    widths = [max(len(row[i]) for row in table) for i in range(len(columns))]
    return ["  ".join(cell.rjust(width) if i else cell.ljust(width) for i, (cell, width) in enumerate(zip(row, widths))).rstrip()
            for row in table]


def plain(cell):
    """A cell without tags.

    >>> plain("−3·10<sup>−7</sup>&nbsp;<b>m</b>"), plain("<span class=key>A</span>coarse")
    ('−3·10^−7 m', 'A coarse')
    """
    cell = re.sub(r"<sup>(.*?)</sup>", r"^\1", cell.replace("</span>", "</span> "))
    return " ".join(html.unescape(re.sub(r"<[^>]*>", "", cell)).split())
