#!/usr/bin/env python3
"""Runs verification cases, holds them against their references, and writes tables and the report.

    scripts/verify [NAME ...] [--quick | --full] [--jobs N]     installs and builds what is missing, then this
    scripts/verify.py [NAME ...] [--quick | --full] [--jobs N] [--drivers FOLDER] [--out FOLDER] [--write]
    scripts/verify.py --stale [--out FOLDER]

NAME is a folder of verification/; without one, all. `--quick` (the default) leaves out what a case marks as long, tries the first of
its breaks that is not, and makes no second run on the defaults; `--full` runs everything. Runs are kept in FOLDER (out/verify) and made
anew only when program, values of the case or settings change, so an interrupted suite goes on where it stopped. The report is
FOLDER/report.html, for each level (quick, full) the newest outcome of every case is in FOLDER/quick or FOLDER/full. `--write` puts table
and figures into the folders of the cases and the table of all into docs/verified.md; `--stale` runs nothing and says where these differ
from the quick outcomes in FOLDER.
The exit status is 1 if a check fails, if a break breaks nothing, if a known miss misses no more, or if something is stale.

A case is a folder with `accept.py`, which has

    CLAIM, EVIDENCE    one sentence; exact, order, invariant, benchmark or experiment
    CATALOGUE          numbers of the catalogue that it answers; may be empty
    DRIVER, CASE       the program, and its case file seen from the root of the tree (default: case.yaml beside it)
    CHANGE             keys that are set in every run of that file; optional
    CHECKS             Check, Report and Miss: a function of the run that gives a Pair, and the limit of its error
    STUDIES            Falls: the error of a check along one key; Table: rows of a function of the run
    BREAKS             Breaks: a plausible mistake and the check that must notice it; at least one, the cheapest first
    FIGURES            Figure: curves of the run over the exact ones; at least one
    WAIVERS            Waiver: runs that need not keep a gate that holds for every run, and why; optional
    DEPARTURES         {numerics that checks set away from the program's defaults: why}; several words have a comma between them

and imports what it needs from `reference.py` beside it, which imports nothing of ours. Needs nothing but Python;
figures need matplotlib.
"""
import argparse
import concurrent.futures
import concurrent.futures.process
import dataclasses
import importlib
import math
import multiprocessing
import os
import re
import sys
import time
import traceback
from pathlib import Path

import break_size
import command_line
import defaults
import gates
import processes
import runs
from convergence import order_between
from runs import ROOT, CannotRun, Run, Store, crossings, interpolate, mean_over, read_fields, straight_line  # noqa: F401  (for cases)
from verification_outcome import EVIDENCE, Outcome, Row

GOOD_ENDINGS = ("reached_end", "relaxed", "stopped_by_condition")


# ------------------------------------------------------------------------------------------------
# What accept.py is made of

@dataclasses.dataclass
class Pair:
    """What came out beside what should; the error is their difference over `scale`, or over what should."""
    got: float
    expected: float
    unit: str = ""
    scale: float | None = None

    def error(self):
        scale = abs(self.expected) if self.scale is None else abs(self.scale)
        difference = abs(self.got - self.expected)
        return difference / scale if scale > 0 else (0.0 if difference == 0 else math.inf)


@dataclasses.dataclass
class Check:
    """A number that must be right: measure(run) gives a Pair whose error stays within the limit.

    chaotic   another processor or build gives another error within the limit: `because` says how far they spread
    evidence  what kind of number it is held against, where that is not what the case says
    like      a check with the same measure of fewer or cheaper runs, whose break stands for both
    """
    name: str
    measure: object
    within: float
    because: str
    full: bool = False
    chaotic: bool = False
    evidence: str | None = None
    like: str | None = None


@dataclasses.dataclass
class Report:
    """A number that is shown and gates nothing."""
    name: str
    measure: object
    because: str
    full: bool = False


@dataclasses.dataclass
class Miss:
    """A check that fails and is known to: `why` says the reason. When it passes, it must become a Check."""
    name: str
    measure: object
    within: float
    because: str
    why: str
    full: bool = False
    evidence: str | None = None


@dataclasses.dataclass
class Falls:
    """The error of a check falls from value to value of a key, in the last step with at least this order.

    `order` is in the ratio of `sizes` (by default the numbers in the values); None asks for a fall only.
    """
    check: str
    along: str
    values: list
    order: float | None = None
    fixed: dict = dataclasses.field(default_factory=dict)
    sizes: list | None = None
    full: bool = False


@dataclasses.dataclass
class Table:
    """Rows for the reader: rows(run) gives them, each as long as `columns`."""
    title: str
    columns: list
    rows: object
    full: bool = False


@dataclasses.dataclass
class Figure:
    """Curves of the run over exact ones: functions of the run that give [(label, abscissae, ordinates), ...].

    Below them stands the error: result less exact over the largest exact value, each result beside the exact curve of
    the same place, or all beside a single one. `ranges(run)` gives [(label, left, right, low, high), ...], drawn as
    hatched boxes. `log` takes both axes logarithmic and shows no error, `equal` draws places, as long across as up.
    """
    name: str  # of the file, without ending
    across: str
    up: str
    curves: object
    exact: object = None
    ranges: object = None
    caption: str = ""
    log: bool = False
    error: bool = True
    equal: bool = False
    full: bool = False


@dataclasses.dataclass
class Curves:
    """What a Figure shows of a run: results and references [(label, abscissae, ordinates)], ranges as boxes."""
    results: list
    exact: list
    ranges: list


@dataclasses.dataclass
class Breaks:
    """A plausible mistake in physics or numerics that the named check must notice: keys set, or another case file."""
    check: str
    mistake: str
    change: dict = dataclasses.field(default_factory=dict)
    case: str | None = None
    full: bool = False


@dataclasses.dataclass
class Waiver:
    """Runs of this case that may fail a gate of gates.LIMITS: of(run) tells them. One that excuses no run is a fault.

    up_to  [-] the largest error that is excused; infinite only where numbers are not finite, have no scale or grow without bound
    """
    gate: str
    of: object
    because: str
    up_to: float
    full: bool = False


# ------------------------------------------------------------------------------------------------
# Measures that many cases ask for

def created(run):
    """The energy that the worst source of a run created by its end, over the energy scale of the ledger."""
    return Pair(run.created(), 0, "", scale=1)


def beyond(checks, keys, case=None):
    """A measure: by how much errors of these checks are larger than those of the case with these keys, over their limits; the worst.

    The other run is of the case without what a break sets, so that a mistake is on one side only.
    """
    def measure(run):
        other = run.other(run.driver, case or run.case_file, keys)
        excess = [(one.measure(run).error() - one.measure(other).error()) / one.within for one in checks]
        return Pair(math.nan if any(math.isnan(each) for each in excess) else max(0.0, *excess), 0, "", scale=1)
    return measure


def side_by_side(checks, keys, case=None):
    """Rows of a Table: the errors of these checks as they are and with these keys, and the steps of both."""
    def rows(run):
        one, other = run.other(run.driver, case or run.case_file, {}), run.other(run.driver, case or run.case_file, keys)
        return [*([check.name, share(check.measure(one).error()), share(check.measure(other).error())] for check in checks),
                ["steps", *(str(each.summary["cost"]["steps"]) for each in (one, other))]]
    return rows


def number_in(text):
    """The first number of a value such as '5e13 Pa/m' or '[20, 1, 1]'."""
    found = re.match(r"[\s\[]*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)", str(text))
    if not found:
        raise CannotRun(f"'{text}' has no number to take as a size: give `sizes`")
    return float(found.group(1))


# ------------------------------------------------------------------------------------------------
# Numbers as texts

def shown(value, unit=""):
    if value is None:
        return ""
    if value == 0:
        return "0"
    return f"{value:.5g}" + (f" {unit}" if unit else "")


def share(value):
    """An error in per cent, or as a power of ten where it is tiny."""
    if value is None or not math.isfinite(value):
        return str(value)
    if value == 0:
        return "0"
    if value >= 1:
        return f"{100 * value:.0f} %"
    return f"{100 * value:.2g} %" if value >= 1e-5 else f"{value:.1e}"


def cell(entry):
    return f"{entry:.3g}" if isinstance(entry, float) else str(entry)


# ------------------------------------------------------------------------------------------------
# Checks, studies, breaks

def check_row(one, run):
    """The line of a Check, Report or Miss."""
    pair = one.measure(run)
    error = pair.error()
    said = (one.name, shown(pair.expected, pair.unit), shown(pair.got, pair.unit), share(error))
    if isinstance(one, Report):
        return Row("report", *said, "", "report", True, one.because, error)
    inside = error <= one.within  # false for a NaN
    if isinstance(one, Miss):
        return Row("miss", *said, share(one.within), "passes, is no miss" if inside else "MISS", not inside,
                   f"{one.because}; misses: {one.why}", error, one.within)
    return Row("check", *said, share(one.within), "pass" if inside else "FAIL", inside, one.because, error, one.within)


def gate_rows(runs, waivers, whole=True):
    """What every run of a case must keep, its studies and breaks included: a line for each gate with the worst of them. Without all
    studies and breaks a case is not `whole`, and a waiver may excuse nothing."""
    judged = [(run, errors) for run in runs if (errors := gates.errors(run))]
    return [gate_row(gate, limit, [(run, errors[gate]) for run, errors in judged if errors[gate] is not None],
                     [one for one in waivers if one.gate == gate], whole) for gate, limit in gates.LIMITS.items()] if judged else []


def gate_row(gate, limit, errors, waivers, whole=True):
    """The line of one gate: the worst run, those left out that fail and that a waiver names."""
    def fails(error):
        return not error <= limit

    def excuses(one, error):
        return one.up_to == math.inf or error <= one.up_to

    excused = [[run for run, error in errors if fails(error) and excuses(one, error) and one.of(run)] for one in waivers]
    kept = [(error, run) for run, error in errors if not any(run in runs for runs in excused)]
    worst, where = max(kept, key=lambda pair: pair[0], default=(0.0, None))
    said = [f"{len(runs)} of {len(errors)} runs are excused: {one.because}" if runs else f"a waiver excuses no run: {one.because}"
            for one, runs in zip(waivers, excused)]
    good = not fails(worst) and (all(excused) or not whole)
    if fails(worst):
        settings = ", ".join(f"{key}={value}" for key, value in where.overrides.items())
        said.append(f"worst in {where.folder.name}: {where.case_file} {settings}")
    return Row("gate", gate, "0", f"{shown(worst)} in {len(kept)} runs", share(worst), share(limit), "pass" if good else "FAIL", good,
               "; ".join(said), worst, limit)


class Stopped(Exception):
    """The run of a break ended before its end. No CannotRun: a check may count those."""


class Broken:
    """The run of a break. It is made when something is asked that only a run tells: a check may want it with further keys alone."""

    def __init__(self, run, one):
        self.one, self.base, self.run, self.driver, self.others = one, run, None, run.driver, []

    @property
    def case_file(self):
        return ROOT / self.one.case if self.one.case else self.base.case_file

    @property
    def overrides(self):
        return dict(self.one.change) if self.one.case else {**self.base.overrides, **self.one.change}

    def again(self, overrides, threads=None):
        change = {**self.one.change, **overrides}
        more = {"threads": threads} if threads else {}
        made = self.base.other(self.driver, self.one.case, change, **more) if self.one.case else self.base.again(change, **more)
        self.others.append(made)
        return made

    def other(self, *asked, **more):
        self.others.append(self.base.other(*asked, **more))
        return self.others[-1]

    def need_end(self):
        """Raises Stopped where this run ends before its end. It may not have been made: then only if one of those made in its place did."""
        if self.run is None and any(one.ending not in GOOD_ENDINGS for one in self.others):
            self.run = self.again({})
        if self.run is not None and self.run.ending not in GOOD_ENDINGS:
            raise Stopped(self.run.ending)

    def __getattr__(self, name):  # of what is not above
        if self.run is None:
            self.run = self.again({})
        self.need_end()
        return getattr(self.run, name)


def break_row(one, checks, run, full=False):
    """The line of a break: the run with the mistake in it, and the check that must notice, by a number. On the full level also the
    smallest part of the mistake that it was seen to notice."""
    check = checks[one.check]
    name = f"*must fail:* {one.mistake} → {one.check}"
    broken = Broken(run, one)
    try:
        pair = check.measure(broken)
        broken.need_end()
    except Stopped as ending:
        return Row("break", name, "", f"stops: {ending}", "", "", "FAIL: no number to fail by", False)
    noticed = pair.error() > check.within  # false for a NaN
    word = "fails, as it must" if noticed else "FAIL: no number to fail by" if math.isnan(pair.error()) else "FAIL: not noticed"
    smallest = break_size.smallest(one, run, broken, lambda part: error_with(part, check, run), pair.error(), check.within,
                                   check.measure(run).error()) if full and noticed and not one.case else None
    error = share(pair.error()) + (f", noticed from {share(smallest)} on" if smallest is not None else "")
    return Row("break", name, shown(pair.expected, pair.unit), shown(pair.got, pair.unit), error, share(check.within), word, noticed, "",
               pair.error(), check.within)


def error_with(one, check, run):
    """The error of a check with a part of a mistake; NaN where the run ends early or the check finds no number in it."""
    broken = Broken(run, one)
    try:
        error = check.measure(broken).error()
        broken.need_end()
        return error
    except (Stopped, ArithmeticError, LookupError, ValueError):
        return math.nan


def study_row(one, checks, run):
    """The line of a study, and (sizes, errors) along its key."""
    check = checks[one.check]
    errors = [check.measure(run.again({**one.fixed, one.along: value})).error() for value in one.values]
    sizes = one.sizes or [number_in(value) for value in one.values]
    order = order_between(sizes[-2], errors[-2], sizes[-1], errors[-1])
    falls = all(b < a for a, b in zip(errors, errors[1:]))
    good = falls and (one.order is None or abs(order) >= one.order)
    values = ", ".join(str(v) for v in one.values)
    row = Row("study", f"*study:* {one.check} along `{one.along}` {values}", "falls" + (f", order ≥ {one.order:g}" if one.order else ""),
              ", ".join(share(e) for e in errors), f"order {abs(order):.2f}", "", "pass" if good else "FAIL", good)
    return row, sizes, errors


class Case:
    """A folder of verification/ with its accept.py loaded."""

    def __init__(self, name, root=ROOT):
        self.name, self.folder = name, root / "verification" / name
        if not (self.folder / "accept.py").is_file():
            raise CannotRun(f"verification/{name}/accept.py is missing")
        for module in [m for m, loaded in sys.modules.items()  # another case's, of the same name
                       if m in ("accept", "reference") or getattr(loaded, "__file__", None) and
                       (root / "verification") in Path(loaded.__file__).parents]:
            del sys.modules[module]
        sys.path.insert(0, str(self.folder))
        try:
            self.accept = importlib.import_module("accept")
        finally:
            sys.path.remove(str(self.folder))
        self.fault = self.what_is_wrong()

    def what_is_wrong(self):
        """The first rule of a case that this one does not keep, or nothing."""
        for needed in ("CLAIM", "EVIDENCE", "CATALOGUE", "DRIVER", "CHECKS", "BREAKS", "FIGURES"):
            if not hasattr(self.accept, needed):
                return f"accept.py has no {needed}"
        if not isinstance(self.case_file(), str) or not isinstance(getattr(self.accept, "CHANGE", {}), dict):
            return "CASE is no path, or CHANGE no dict: these names are the suite's"
        if self.accept.EVIDENCE not in EVIDENCE:
            return f"EVIDENCE is '{self.accept.EVIDENCE}', expected is one of {', '.join(EVIDENCE)}"
        if not self.accept.BREAKS:
            return "BREAKS is empty: a check that nothing breaks shows nothing"
        if not self.accept.FIGURES:
            return "FIGURES is empty"
        names = [one.name for one in self.accept.CHECKS]
        if len(set(names)) != len(names):
            return "two checks have the same name"
        for one in [*self.accept.BREAKS, *self.studies()]:
            if not isinstance(one, Table) and one.check not in names:
                return f"no check is called '{one.check}'"
        gated = {one.name for one in self.accept.CHECKS if isinstance(one, Check)}
        if not gated:
            return "CHECKS has no Check: nothing is gated"
        for one in self.accept.BREAKS:
            if one.check not in gated:
                return f"a break names '{one.check}', which gates nothing"
            if not one.change and not one.case:
                return f"the break '{one.mistake}' changes nothing"
        broken = {one.check for one in self.accept.BREAKS}
        for one in self.accept.CHECKS:
            if isinstance(one, Check) and not {one.name, one.like} & broken:
                return f"nothing breaks '{one.name}'"
        if all(one.full for one in self.accept.BREAKS):
            return "all BREAKS are full: the quick suite would show a case that nothing breaks"
        for one in self.accept.CHECKS:
            if not one.because:
                return f"'{one.name}' has no reason"
            if getattr(one, "evidence", None) not in (None, *EVIDENCE):
                return f"the evidence of '{one.name}' is '{one.evidence}', expected is one of {', '.join(EVIDENCE)}"
        for one in getattr(self.accept, "WAIVERS", []):
            if one.gate not in gates.LIMITS or not one.because:
                return f"a waiver has no reason, or names '{one.gate}', which is no gate"
        return ""

    def studies(self):
        return getattr(self.accept, "STUDIES", [])

    def breaks(self, full):
        """All, or for the quick level the first that is not long."""
        return self.accept.BREAKS if full else [one for one in self.accept.BREAKS if not one.full][:1]

    def case_file(self):
        return getattr(self.accept, "CASE", f"verification/{self.name}/case.yaml")

    def base_run(self, store):
        return store.run(self.accept.DRIVER, self.case_file(), getattr(self.accept, "CHANGE", {}))

    def outcome(self, store, full=False, with_figures=False, with_breaks=True):
        """Runs all checks, studies and breaks of the level; a fault of one of them is a row that fails."""
        out = Outcome(self.name, "full" if full else "quick", self.accept.DRIVER, self.case_file(), self.accept.CLAIM, self.accept.EVIDENCE,
                      list(self.accept.CATALOGUE))
        try:
            self.judge(out, store, full, with_figures, with_breaks)
        except CannotRun as error:
            out.rows.append(fault_row("the run", error))
        out.runs, out.made = len(store.done), sum(run.made for run in store.done.values())
        out.seconds = store.seconds()
        out.folders, out.left_out = [run.folder.name for run in store.done.values()], self.left_out(full)
        return out

    def left_out(self, full):
        """(kind, name) of what the case has and the level leaves out."""
        kept = [one for one in [*self.accept.CHECKS, *self.studies(), *self.breaks(full)] if full or not one.full]
        every = [*self.accept.CHECKS, *self.studies(), *self.accept.BREAKS]
        return [(type(one).__name__.lower(), name_of(one)) for one in every if not any(one is other for other in kept)]

    def judge(self, out, store, full, with_figures, with_breaks):
        run = self.base_run(store)
        out.ledger, out.cost = run.summary["ledger"], run.summary["cost"]
        out.provenance = {key: value for key, value in run.summary["provenance"].items() if key != "resolved"}
        if run.ending not in GOOD_ENDINGS:
            out.rows.append(Row("fault", "the run reaches its end", "", run.ending, "", "", "FAIL", False, run.summary["ending"]["reason"]))
            return
        checks = {one.name: one for one in self.accept.CHECKS}
        for one in [*self.accept.CHECKS, *([*self.studies(), *self.breaks(full)] if with_breaks else [])]:
            if one.full and not full:
                continue
            seen, asked = len(out.rows), len(run.runner.given)
            try:
                if isinstance(one, Table):
                    out.tables.append((one.title, one.columns, [[cell(entry) for entry in line] for line in one.rows(run)]))
                elif isinstance(one, Falls):
                    row, sizes, errors = study_row(one, checks, run)
                    out.rows.append(row)
                    out.studies.append((one.check, one.along, sizes, errors))
                else:
                    out.rows.append(break_row(one, checks, run, full) if isinstance(one, Breaks) else check_row(one, run))
            except Exception as error:  # whatever a case does wrong is a check that fails, and the others still run
                out.rows.append(fault_row(name_of(one), error))
            for row in out.rows[seen:]:
                row.full, row.chaotic = one.full, getattr(one, "chaotic", False)
                if row.kind in ("check", "miss"):
                    row.evidence = one.evidence or self.accept.EVIDENCE
                if row.kind in ("check", "miss", "report"):
                    used = run.runner.given[asked:] or [run]
                    row.departs = sorted({(word, value) for each in used for _, word, value, _ in defaults.departures(each)}, key=str)
        if not with_breaks:
            out.rows[:0] = gate_rows(run.runner.done.values(), getattr(self.accept, "WAIVERS", []), whole=False)
            return
        self.judge_departures(out, run, full)
        waivers = [one for one in getattr(self.accept, "WAIVERS", []) if full or not one.full]
        self.draw(out, run, full, with_figures)
        out.rows[:0] = gate_rows(run.runner.done.values(), waivers, whole=full)

    def judge_departures(self, out, run, full):
        """Every departure of a check has its reason, and no reason is left over; a case with contact shows what the defaults give."""
        reasons = {word: why for words, why in getattr(self.accept, "DEPARTURES", {}).items() for word in words.split(", ")}
        departs = dict.fromkeys(word for row in out.gated() for word, _ in row.departs)
        missing, spare = [word for word in departs if not reasons.get(word)], [word for word in reasons if full and word not in departs]
        if missing:
            out.rows.append(fault_row("departures", CannotRun(f"not the defaults, without a reason in DEPARTURES: {', '.join(missing)}")))
        if spare:
            out.rows.append(fault_row("departures", CannotRun(f"in DEPARTURES, and no check departs in it: {', '.join(spare)}")))
        out.departures = {word: reasons[word] for word in departs if word in reasons}
        lines = self.with_defaults(out, run) if full and defaults.with_contact(run) else []
        if full and not lines and all(row.departs for row in out.rows if row.kind in ("check", "miss", "report")):
            out.rows.append(fault_row("departures", CannotRun("no check runs on the defaults, and no report shows their error")))
        if lines:
            out.tables.append(("The same checks with the defaults, which gate nothing:", ["check", "error", "with the defaults"], lines))

    def with_defaults(self, out, run):
        """[check, error, error with the defaults] of each check of a contact whose case departs from them."""
        store, lines = defaults.ByDefault(run.runner), []
        checks = {one.name: one for one in self.accept.CHECKS}
        try:
            base = store.base(run)
            ending = "" if base.ending in GOOD_ENDINGS else f"ends as {base.ending}"
        except CannotRun:
            base, ending = run, "is refused"
        of_base = store.changed
        for row in out.gated():
            store.changed = of_base
            try:
                error = checks[row.name].measure(base).error() if not row.full and not ending else math.nan
            except Exception:  # a measure may divide by a force that is zero now
                error = math.nan
            if store.changed and not row.full:
                lines.append([row.name, row.error, ending or (share(error) if math.isfinite(error) else "no number")])
        return lines

    def draw(self, out, run, full, with_figures):
        """The figures of the case and of its studies; without figures their curves are computed all the same."""
        for one in self.accept.FIGURES:
            if one.full and not full:
                continue
            try:
                curves = Curves(one.curves(run), one.exact(run) if one.exact else [], one.ranges(run) if one.ranges else [])
            except Exception as error:
                out.rows.append(fault_row(f"figure {one.name}", error))
                continue
            if with_figures:
                import verification_figures as drawing  # needs matplotlib, which judging does not
                out.figures.append((one.name, one.caption, drawing.case_figure(one, curves)))
        if with_figures:
            out.figures += [("", f"The error of “{check}” along {along}.", drawing.study_figure(check, along, sizes, errors))
                            for check, along, sizes, errors in out.studies]


def kind_of(name, root=ROOT):
    """Numbers of the catalogue of a case, and its kind of evidence."""
    accept = Case(name, root).accept
    return accept.CATALOGUE, accept.EVIDENCE


def name_of(one):
    """Of a Check, Report, Miss, Falls, Table or Breaks."""
    return getattr(one, "title", None) or getattr(one, "mistake", None) or getattr(one, "name", None) or one.check


def fault_row(name, error):
    said = str(error) if isinstance(error, CannotRun) else "".join(traceback.format_exception(error)[-2:]).strip()
    return Row("fault", name, "", "", "", "", "FAIL: cannot run", False, said)


def names_of_all(root=ROOT):
    return sorted(path.parent.name for path in (root / "verification").glob("*/accept.py"))


# ------------------------------------------------------------------------------------------------
# The suite

def judge_case(name, options):
    """Runs one case and keeps its outcome; in a process of its own where several run at once."""
    level = "full" if options.full else "quick"
    try:
        case = Case(name)
        if case.fault:
            raise CannotRun(case.fault)
        store = Store(options.drivers, options.out / "runs", options.out / "scratch" / name, options.threads)
        out = case.outcome(store, options.full, options.figures, options.breaks)
        used = [run.folder.name for run in store.done.values()]
    except Exception as error:  # an accept.py may hold any mistake; the other cases go on
        out, used = Outcome(name, level, rows=[fault_row("the case", error)]), []
    out.save(options.out / level)
    return out, used


def judge_case_apart(name, options):
    """The same in a process of a pool, which ends without a word when it is interrupted."""
    try:
        return judge_case(name, options)
    except KeyboardInterrupt:
        os._exit(130)


def slowest_first(names, folder):
    """So that no long case is left for the end, where it would keep one core busy alone."""
    def seconds(name):
        try:
            return Outcome.load(folder / f"{name}.json").seconds
        except (OSError, ValueError, TypeError, KeyError):
            return math.inf  # never seen: may be long
    return sorted(names, key=lambda name: (-seconds(name), name))


def judge_all(names, options):
    """Outcomes by name, printed as they come."""
    outcomes, used = {}, set()
    names = slowest_first(names, options.out / ("full" if options.full else "quick"))

    def keep(out, folders):
        outcomes[out.name] = out
        used.update(folders)
        print_outcome(out, options.verbose or len(names) == 1)

    if options.jobs == 1:
        for name in names:
            keep(*judge_case(name, options))
    else:
        workers = concurrent.futures.ProcessPoolExecutor(options.jobs, multiprocessing.get_context("fork"), processes.ends_with_parent,
                                                         (os.getpid(),))
        with workers as pool:
            for done in concurrent.futures.as_completed([pool.submit(judge_case_apart, name, options) for name in names]):
                keep(*done.result())
    return outcomes, used


def print_outcome(out, whole):
    for row in out.rows:
        if row.kind == "fault":
            print(f"FAIL  {row.name}: {row.because or row.got}")
        elif whole or not row.good or row.kind == "miss":
            numbers = f"expected {row.expected or '-'}, got {row.got or '-'}, error {row.error or '-'}, limit {row.limit or '-'}"
            because = f"  ({row.because})" if row.because else ""
            print(f"{'ok  ' if row.good else 'FAIL'}  {row.word:18} {row.name}: {numbers}{because}")
    for title, columns, lines in out.tables if whole else []:
        print(f"      {title}")
        for line in [columns, *lines]:
            print("      " + " | ".join(line))
    missing = f", {len(out.misses())} MISS" if out.misses() else ""
    print(f"{'pass' if out.good() else 'FAIL'}  {out.name}: {len(out.rows)} rows{missing}, {out.runs} runs of {out.seconds:.1f} s, "
          f"{out.made} of them new", flush=True)


def options_of(arguments):
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="folder of verification/; without one, all")
    level = parser.add_mutually_exclusive_group()
    level.add_argument("--quick", action="store_true", help="leave out what is marked as long (default)")
    level.add_argument("--full", action="store_true", help="run everything")
    level.add_argument("--stale", action="store_true", help="only compare tables in the tree with the quick outcomes of FOLDER")
    parser.add_argument("--jobs", type=command_line.count, default=os.cpu_count() or 1, help="cases at once (default: all cores)")
    parser.add_argument("--threads", type=command_line.threads, default=1, help="of each run; results do not depend on them")
    parser.add_argument("--drivers", type=command_line.folder_of_programs, default=ROOT / "build/release/drivers",
                        help="folder of the programs")
    parser.add_argument("--out", type=command_line.folder_to_write, default=ROOT / "out/verify", help="folder of runs, outcomes and report")
    parser.add_argument("--write", action="store_true",
                        help="write tables and figures into the tree; on the quick level figures, rows, reasons and departures alone")
    parser.add_argument("--no-figures", dest="figures", action="store_false", help="judge only: no figures and no report")
    parser.add_argument("--no-breaks", dest="breaks", action="store_false", help="judge only: no breaks, studies and tables")
    parser.add_argument("--verbose", action="store_true", help="print every row of every case")
    parser.add_argument("--only-check", action="store_true", help="only say what is wrong with these words; run nothing")
    options = parser.parse_args(arguments)
    unknown = [name for name in options.names if name not in names_of_all()]
    if unknown:
        parser.error(f"no folder of verification/ is called {', '.join(unknown)}; there are {', '.join(names_of_all())}")
    if options.write and not options.figures:
        parser.error("--write draws figures; leave --no-figures away")
    if not options.breaks and (options.figures or options.full):
        parser.error("--no-breaks is for the quick level without figures: add --no-figures, and leave --full away")
    if options.only_check:
        sys.exit(0)
    if not options.stale:
        command_line.need_programs(options.drivers, programs_of(options.names or names_of_all()))
        command_line.need_writable(options.out)
    return options


def programs_of(names):
    """Programs of the cases; a case that cannot be read is told as one that fails."""
    found = []
    for name in names:
        try:
            found.append(Case(name).accept.DRIVER)
        except Exception:  # an accept.py may hold any mistake
            pass
    return found


def main(arguments=None):
    options = options_of(arguments)
    if options.stale:
        import verification_tables as tables
        faults = tables.stale(ROOT, names_of_all(), options.out / "quick")
        print("\n".join(faults) or "the tables in the tree are those of the runs")
        return 1 if faults else 0
    started = time.perf_counter()
    names = options.names or names_of_all()
    outcomes, used = judge_all(names, options)
    good = all(out.good() for out in outcomes.values())
    if options.write:
        import verification_tables as tables
        tables.write(ROOT, outcomes, names_of_all(), kind_of)
    if options.figures:
        import verification_report as report
        path = report.write(options.out, "full" if options.full else "quick", names_of_all(), names)
        print(f"report: {path}")
    if options.full and not options.names:
        if not runs.remove_unused(options.out / "runs", used):
            print("runs that no case asks for stay: another process uses the folder")
    checks = sum(row.kind == "check" for out in outcomes.values() for row in out.rows)
    breaks = sum(row.kind == "break" for out in outcomes.values() for row in out.rows)
    misses = sum(len(out.misses()) for out in outcomes.values())
    failed = sorted(name for name, out in outcomes.items() if not out.good())
    print(f"{len(outcomes)} cases, {checks} checks, {breaks} breaks, {misses} known misses; {time.perf_counter() - started:.0f} s; "
          + (f"FAIL: {', '.join(failed)}" if failed else "pass"))
    return 0 if good else 1


if __name__ == "__main__":
    sys.modules["verify"] = sys.modules["__main__"]  # one module, whoever imports it
    try:
        sys.exit(main())
    except (KeyboardInterrupt, concurrent.futures.process.BrokenProcessPool):
        sys.exit("interrupted: the same command goes on from here")
