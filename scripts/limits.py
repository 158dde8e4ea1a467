#!/usr/bin/env python3
"""No limit of the verification suite grows without a word: limits of today beside the smallest that each check ever had.

    scripts/limits.py            says where verification/limits.csv and docs/verification.md differ from the cases; exit status 1 if so
    scripts/limits.py --write    brings verification/limits.csv up to date; the smallest limit in it never grows

A check whose limit (or a study whose least order) is looser than it was needs a line in the table "Limits that were widened" of
docs/verification.md, with the old and the new one and the reason. The line stays as long as the limit is looser than it was.
"""
import argparse
import csv
import io
import re
import sys

import command_line
import verify

TABLE, PAGE, HEADING = "verification/limits.csv", "docs/verification.md", "## Limits that were widened"
HEAD = ["case", "check", "kind", "tightest", "today"]


def limits_of(names, root=verify.ROOT):
    """{(case, check): (kind, limit)} of all that gates: checks and misses by their limits, studies by their least order."""
    found = {}
    for name in names:
        accept = verify.Case(name, root).accept
        for one in accept.CHECKS:
            if isinstance(one, (verify.Check, verify.Miss)):
                found[name, one.name] = (type(one).__name__.lower(), one.within)
        for one in getattr(accept, "STUDIES", []):
            if isinstance(one, verify.Falls):
                found[name, f"{one.check} along {one.along}"] = ("order", one.order or 0.0)
    return found


def looser(kind, new, old):
    """Whether a limit lets more pass than another; rounding of decimals aside."""
    return new < old * (1 - 1e-9) if kind == "order" else new > old * (1 + 1e-9)


def read(text):
    """{(case, check): (kind, tightest, today)} of the table."""
    rows = list(csv.reader(io.StringIO(text)))
    return {(case, check): (kind, float(tightest), float(today)) for case, check, kind, tightest, today in rows[1:]}


def written(known, today):
    """The table brought up to date; the tightest of each check stays what it was or becomes tighter."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(HEAD)
    for key in sorted(today):
        kind, limit = today[key]
        tightest = known[key][1] if key in known and looser(kind, limit, known[key][1]) else limit
        writer.writerow([*key, kind, f"{tightest:.10g}", f"{limit:.10g}"])
    return out.getvalue()


def lines_of(page):
    """{(case, check): (old, new)} of the table of widened limits on the page."""
    part = page.partition(HEADING)[2].partition("\n## ")[0]
    found = {}
    for line in part.splitlines():
        cells = [cell.strip().strip("`") for cell in line.strip().strip("|").split("|")]
        if len(cells) == 6 and re.match(r"[0-9]", cells[2]):
            found[cells[0], cells[1]] = (number(cells[2]), number(cells[3]))
    return found


def number(text):
    return float(text.rstrip(" %")) * (0.01 if text.endswith("%") else 1)


def faults(known, today, lines):
    """What is wrong, a sentence each: known of the table, today of the cases, lines of the page."""
    found = []
    for (case, check), (kind, limit) in sorted(today.items()):
        _, tightest, before = known.get((case, check), (kind, limit, None))
        if before is None or abs(limit - before) > 1e-9 * abs(before):
            found.append(f"{TABLE}: {case}, '{check}': the table says {before}, the case {limit:g}; scripts/limits.py --write")
        line = lines.get((case, check))
        if looser(kind, limit, tightest):
            if line is None:
                found.append(f"{PAGE}: {case}, '{check}': the limit was {tightest:g} and is {limit:g}, and no line under '{HEADING[3:]}' "
                             "says why")
            elif abs(line[0] - tightest) > 1e-6 * tightest or abs(line[1] - limit) > 1e-6 * limit:
                found.append(f"{PAGE}: {case}, '{check}': the line says {line[0]:g} and {line[1]:g}, the table {tightest:g} and {limit:g}")
        elif line is not None:
            found.append(f"{PAGE}: {case}, '{check}': has a line, but its limit is no looser than it ever was")
    found += [f"{TABLE}: {case} has no check '{check}'; scripts/limits.py --write" for case, check in known if (case, check) not in today]
    found += [f"{PAGE}: {case} has no check '{check}'" for case, check in lines if (case, check) not in today]
    return found


def main(arguments=None):
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help=f"bring {TABLE} up to date")
    options = parser.parse_args(arguments)
    table = verify.ROOT / TABLE
    known = read(table.read_text(encoding="utf-8")) if table.is_file() else {}
    today = limits_of(verify.names_of_all())
    if options.write:
        table.write_text(written(known, today), encoding="utf-8")
        known = read(table.read_text(encoding="utf-8"))
    found = faults(known, today, lines_of((verify.ROOT / PAGE).read_text(encoding="utf-8")))
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
