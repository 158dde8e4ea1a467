#!/usr/bin/env python3
"""Runs verification cases, compares them with their references, and writes their tables.

    scripts/verify.py DRIVERS CASE [CASE ...] [--full] [--write] [--keep FOLDER]

DRIVERS is the folder of the programs, CASE the name of a folder of verification/, or `all`. `--full` runs the
long studies too, `--write` does so and puts the table into the README of the case, `--keep` leaves the runs in FOLDER.
The exit status is 1 if a check fails, if a break breaks nothing, or if a known miss misses no more.

A case is a folder with `accept.py`, which has

    CLAIM, EVIDENCE    one sentence; exact, order, invariant or benchmark
    DRIVER, CASE       the program, and its case file seen from the root of the tree (default: case.yaml beside it)
    CHECKS             Check, Report and Miss: a function of the run that gives a Pair, and the limit of its error
    STUDIES            Falls: the error of a check along one key; Table: rows of a function of the run
    BREAKS             Breaks: a plausible mistake and the check that must notice it; at least one
    FIGURES            Figure: curves of the run over the exact ones; optional

and imports what it needs from `reference.py` beside it, which imports nothing of ours. Needs nothing but Python.
"""
import argparse
import base64
import csv
import dataclasses
import importlib
import json
import math
import re
import struct
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
EVIDENCE = ("exact", "order", "invariant", "benchmark")
BEGIN, END = "<!-- written by scripts/verify.py -->", "<!-- end of what scripts/verify.py writes -->"


class CannotRun(Exception):
    """A program is missing or refuses its case; says which and what it said."""


# ------------------------------------------------------------------------------------------------
# One run of a driver

class Run:
    """What one run of a driver left behind."""

    def __init__(self, runner, driver, case, overrides):
        self.runner, self.driver, self.case_file, self.overrides = runner, driver, case, dict(overrides)
        self.folder = runner.folder(driver)
        words = [str(runner.drivers / driver), str(ROOT / case), "--out", str(self.folder), "--quiet", "--threads", str(runner.threads)]
        for key, value in self.overrides.items():
            words += ["--set", f"{key}={value}"]
        started = time.perf_counter()
        try:
            done = subprocess.run(words, capture_output=True, text=True, timeout=runner.patience)
        except FileNotFoundError as error:
            raise CannotRun(f"{words[0]} is not built") from error
        except subprocess.TimeoutExpired as error:
            raise CannotRun(f"took longer than {runner.patience} s: {' '.join(words)}") from error
        self.seconds = time.perf_counter() - started
        if done.returncode not in (0, 3):  # 3: the physics stopped the run, which summary.json tells
            raise CannotRun(f"status {done.returncode} of {' '.join(words)}\n{done.stderr}")
        self.summary = json.loads((self.folder / "summary.json").read_text(encoding="utf-8"))
        self.ending = self.summary["ending"]["word"]
        with (self.folder / "history.csv").open(newline="", encoding="utf-8") as stream:
            head, *rows = csv.reader(stream)
        self.columns = {name.split(" [")[0]: [float(row[i]) for row in rows] for i, name in enumerate(head)}

    def again(self, overrides):
        """The same case with these keys set as well; each combination runs once."""
        return self.runner.run(self.driver, self.case_file, {**self.overrides, **overrides})

    def other(self, driver, case, overrides=None):
        """Another case, seen from the root of the tree."""
        return self.runner.run(driver, case, overrides or {})

    def result(self, name):
        """A number of summary.json."""
        return self.summary["results"][name]["value"]

    def case(self, path):
        """A value of the case as the driver resolved it, in SI: case("bodies[0].material.young")."""
        at = self.summary["provenance"]["resolved"]
        for name in re.findall(r"[^.\[\]]+", path):
            at = at[int(name)] if isinstance(at, list) else at[name]
        return at["value"] if isinstance(at, dict) and "value" in at else at

    def ledger(self, name):
        """A number or vector of the ledger."""
        return self.summary["ledger"][name]["value"]

    def account(self, source):
        """The account of one source in the ledger."""
        return self.summary["ledger"]["accounts"][source]

    def created(self):
        """The largest created energy of any source over the scale of the ledger. [-]"""
        return max(abs(account["created_relative"]["value"]) for account in self.summary["ledger"]["accounts"].values())

    def column(self, name):
        """A column of history.csv."""
        if name not in self.columns:
            raise CannotRun(f"history.csv has no column '{name}'; there are {', '.join(self.columns)}")
        return self.columns[name]

    def at(self, name, t):
        """A column at a time, between the samples around it."""
        return interpolate(self.column("time"), self.column(name), t)

    def mean(self, name, first, last):
        """The mean of a column over a span of time, by the trapezoid rule."""
        return mean_over(self.column("time"), self.column(name), first, last)

    def frame(self, collection, number=-1):
        """Time and fields of one ParaView file: {name: [tuple or number per point or cell]}."""
        listed = list(xml.parse(self.folder / f"{collection}.pvd").getroot().iter("DataSet"))
        one = listed[number]
        return float(one.get("timestep")), read_fields(self.folder / one.get("file"))


def interpolate(times, values, t):
    """The value at t between the samples around it."""
    for i in range(1, len(times)):
        if times[i] >= t:
            part = (t - times[i - 1]) / (times[i] - times[i - 1])
            return values[i - 1] + part * (values[i] - values[i - 1])
    return values[-1]


def mean_over(times, values, first, last):
    """The mean over [first, last] by the trapezoid rule."""
    inner = [(t, v) for t, v in zip(times, values) if first < t < last]
    points = [(first, interpolate(times, values, first)), *inner, (last, interpolate(times, values, last))]
    area = sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(points, points[1:]))
    return area / (last - first)


def crossings(times, values, level=0.0, rising=None):
    """Times at which the samples cross the level; upwards only, downwards only, or both."""
    found = []
    for (t0, v0), (t1, v1) in zip(zip(times, values), zip(times[1:], values[1:])):
        up = v0 < level <= v1
        down = v0 > level >= v1
        if (up and rising is not False) or (down and rising is not True):
            found.append(t0 + (level - v0) / (v1 - v0) * (t1 - t0))
    return found


NUMBERS = {"Float64": "d", "Float32": "f", "Int32": "i", "Int64": "q", "UInt8": "B", "UInt32": "I", "UInt64": "Q"}


def read_fields(path):
    """All numeric arrays of a ParaView file as the drivers write them: {name: list of numbers or tuples}."""
    fields = {}
    for array in xml.parse(path).getroot().iter("DataArray"):
        kind, name = NUMBERS.get(array.get("type")), array.get("Name")
        text = "".join((array.text or "").split())
        if kind is None or array.get("format") != "binary":
            continue
        data = unpacked(text)
        values = [v[0] for v in struct.iter_unpack("<" + kind, data)]
        width = int(array.get("NumberOfComponents", "1"))
        fields[name] = values if width == 1 else [tuple(values[i:i + width]) for i in range(0, len(values), width)]
    return fields


def unpacked(text):
    """The bytes of one inline array of VTK: base64 of a head of sizes, then base64 of blocks packed by zlib."""
    import zlib
    if not text:
        return b""
    (blocks,) = struct.unpack_from("<Q", base64.b64decode(text[:12]))
    if blocks == 0:
        return b""
    head_bytes = 8 * (3 + blocks)
    head_text = 4 * math.ceil(head_bytes / 3)
    sizes = struct.unpack_from(f"<{3 + blocks}Q", base64.b64decode(text[:head_text]))[3:]
    body, out, at = base64.b64decode(text[head_text:]), b"", 0
    for size in sizes:
        out += zlib.decompress(body[at:at + size])
        at += size
    return out


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
    """A number that must be right: measure(run) gives a Pair whose error stays within the limit."""
    name: str
    measure: object
    within: float
    because: str


@dataclasses.dataclass
class Report:
    """A number that is shown and gates nothing."""
    name: str
    measure: object
    because: str


@dataclasses.dataclass
class Miss:
    """A check that fails and is known to: `why` says the reason. When it passes, it must become a Check."""
    name: str
    measure: object
    within: float
    because: str
    why: str


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
    """Curves over the reference, drawn by `--write`: curves(run) gives [(label, abscissae, ordinates), ...]."""
    name: str  # of the files, without ending
    across: str
    up: str
    curves: object


@dataclasses.dataclass
class Breaks:
    """A plausible mistake that the named check must notice: keys set, or another way to measure.

    `stops`: the word of the ending, where the run rightly stops before the check is reached.
    """
    check: str
    mistake: str
    change: dict = dataclasses.field(default_factory=dict)
    measure: object = None
    stops: str | None = None
    full: bool = False


def order_between(size_0, error_0, size_1, error_1):
    """The order p of an error that goes as size^p."""
    if min(error_0, error_1) <= 0:
        return math.inf if error_1 <= error_0 else -math.inf
    return math.log(error_1 / error_0) / math.log(size_1 / size_0)


def number_in(text):
    """The first number of a value such as '5e13 Pa/m'."""
    return float(re.match(r"\s*([-+0-9.eE]+)", str(text)).group(1))


# ------------------------------------------------------------------------------------------------
# Running a case

class Runner:
    """Runs each combination of driver, case and overrides once."""

    def __init__(self, drivers, out, threads=1, patience=3600):
        self.drivers, self.out, self.threads, self.patience = Path(drivers).resolve(), Path(out).resolve(), threads, patience
        self.done, self.seconds = {}, 0.0

    def folder(self, driver):
        return self.out / f"{driver}_{len(self.done):03d}"

    def run(self, driver, case, overrides):
        key = (driver, case, tuple(sorted((k, str(v)) for k, v in overrides.items())))
        if key not in self.done:
            self.done[key] = Run(self, driver, case, overrides)
            self.seconds += self.done[key].seconds
        return self.done[key]


@dataclasses.dataclass
class Row:
    """One line of the table, and whether all is as it should be."""
    name: str
    expected: str
    got: str
    error: str
    limit: str
    word: str
    good: bool
    because: str = ""


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


def check_row(one, run):
    """The line of a Check, Report or Miss."""
    pair = one.measure(run)
    error = pair.error()
    said = (shown(pair.expected, pair.unit), shown(pair.got, pair.unit), share(error))
    if isinstance(one, Report):
        return Row(one.name, *said, "", "report", True, one.because)
    inside = error <= one.within  # false for a NaN
    if isinstance(one, Miss):
        return Row(one.name, *said, share(one.within), "passes, is no miss" if inside else "MISS", not inside,
                   f"{one.because}; misses: {one.why}")
    return Row(one.name, *said, share(one.within), "pass" if inside else "FAIL", inside, one.because)


def break_row(one, checks, run):
    """The line of a break: the run with the mistake in it, and the check that must notice."""
    check, broken = checks[one.check], run.again(one.change) if one.change else run
    name = f"*must fail:* {one.mistake} → {one.check}"
    if broken.ending not in GOOD_ENDINGS:
        good = one.stops is not None and broken.ending == one.stops
        return Row(name, "", f"stops: {broken.ending}", "", "", "stops, as it must" if good else "FAIL", good)
    if one.stops is not None:
        return Row(name, "", "does not stop", "", "", "FAIL", False)
    pair = (one.measure or check.measure)(broken)
    noticed = not pair.error() <= check.within
    return Row(name, shown(pair.expected, pair.unit), shown(pair.got, pair.unit), share(pair.error()), share(check.within),
               "fails, as it must" if noticed else "FAIL: not noticed", noticed)


def study_row(one, checks, run):
    """The line of a study: errors along a key."""
    check = checks[one.check]
    errors = [check.measure(run.again({**one.fixed, one.along: value})).error() for value in one.values]
    sizes = one.sizes or [number_in(value) for value in one.values]
    order = order_between(sizes[-2], errors[-2], sizes[-1], errors[-1])
    falls = all(b < a for a, b in zip(errors, errors[1:]))
    enough = one.order is None or abs(order) >= one.order
    values = ", ".join(str(v) for v in one.values)
    return Row(f"*study:* {one.check} along `{one.along}` {values}", "falls" + (f", order ≥ {one.order:g}" if one.order else ""),
               ", ".join(share(e) for e in errors), f"order {abs(order):.2f}", "", "pass" if falls and enough else "FAIL",
               falls and enough)


def row_of(one, checks, run):
    if isinstance(one, Falls):
        return study_row(one, checks, run)
    return break_row(one, checks, run) if isinstance(one, Breaks) else check_row(one, run)


GOOD_ENDINGS = ("reached_end", "relaxed", "stopped_by_condition")


class Case:
    """A folder of verification/ with its accept.py loaded."""

    def __init__(self, name, root=ROOT):
        self.name, self.folder = name, root / "verification" / name
        if not (self.folder / "accept.py").is_file():
            raise CannotRun(f"verification/{name}/accept.py is missing")
        for module in [m for m, loaded in sys.modules.items()  # another case's, of the same name
                       if m in ("accept", "reference") or getattr(loaded, "__file__", None) and
                       Path(loaded.__file__).parent.parent == root / "verification"]:
            del sys.modules[module]
        sys.path.insert(0, str(self.folder))
        try:
            self.accept = importlib.import_module("accept")
        finally:
            sys.path.remove(str(self.folder))
        self.fault = self.what_is_wrong()

    def what_is_wrong(self):
        """The first rule of a case that this one does not keep, or nothing."""
        for needed in ("CLAIM", "EVIDENCE", "DRIVER", "CHECKS", "BREAKS"):
            if not hasattr(self.accept, needed):
                return f"accept.py has no {needed}"
        if self.accept.EVIDENCE not in EVIDENCE:
            return f"EVIDENCE is '{self.accept.EVIDENCE}', expected is one of {', '.join(EVIDENCE)}"
        if not self.accept.BREAKS:
            return "BREAKS is empty: a check that nothing breaks shows nothing"
        names = [one.name for one in self.accept.CHECKS]
        if len(set(names)) != len(names):
            return "two checks have the same name"
        for one in [*self.accept.BREAKS, *getattr(self.accept, "STUDIES", [])]:
            if not isinstance(one, Table) and one.check not in names:
                return f"no check is called '{one.check}'"
        gates = {one.name for one in self.accept.CHECKS if isinstance(one, Check)}
        for one in self.accept.BREAKS:
            if one.check not in gates:
                return f"a break names '{one.check}', which gates nothing"
        for one in self.accept.CHECKS:
            if not one.because:
                return f"'{one.name}' has no reason"
        return ""

    def case_file(self):
        return getattr(self.accept, "CASE", f"verification/{self.name}/case.yaml")

    def run(self, runner, full=False):
        """Rows and tables of all checks, studies and breaks."""
        run = runner.run(self.accept.DRIVER, self.case_file(), getattr(self.accept, "CHANGE", {}))
        rows, tables = [], []
        if run.ending not in GOOD_ENDINGS:
            rows.append(Row("the run reaches its end", "", run.ending, "", "", "FAIL", False, run.summary["ending"]["reason"]))
            return rows, tables
        checks = {one.name: one for one in self.accept.CHECKS}
        for one in [*self.accept.CHECKS, *getattr(self.accept, "STUDIES", []), *self.accept.BREAKS]:
            if getattr(one, "full", False) and not full:
                continue
            try:
                if isinstance(one, Table):
                    tables.append((one, one.rows(run)))
                else:
                    rows.append(row_of(one, checks, run))
            except CannotRun as error:
                name = getattr(one, "title", None) or getattr(one, "mistake", None) or getattr(one, "name", None) or one.check
                rows.append(Row(name, "", "", "", "", "FAIL: cannot run", False, str(error)))
        return rows, tables


def draw(case, runner):
    """Writes the figures of a case into its folder; returns their names, none where matplotlib is missing."""
    wanted = getattr(case.accept, "FIGURES", [])
    if not wanted:
        return []
    try:
        import figure as drawing
    except ImportError:
        print(f"      {case.name}: no matplotlib, figures stay as they are")
        return [one.name for one in wanted]
    run = runner.run(case.accept.DRIVER, case.case_file(), {})
    for one in wanted:
        picture, axes = drawing.new_figure(width=120, height=66)
        for number, (label, across, up) in enumerate(one.curves(run)):
            drawing.draw_curve(axes, across, up, number, label)
        axes.set_xlabel(one.across)
        axes.set_ylabel(one.up)
        axes.legend(loc="best")
        drawing.save(picture, case.folder / f"{one.name}.svg", png=False)
    return [one.name for one in wanted]


def print_rows(name, rows, tables, seconds):
    for row in rows:
        numbers = f"expected {row.expected or '-'}, got {row.got or '-'}, error {row.error or '-'}, limit {row.limit or '-'}"
        print(f"{'ok  ' if row.good else 'FAIL'}  {row.word:18} {row.name}: {numbers}" + (f"  ({row.because})" if row.because else ""))
    for table, lines in tables:
        print(f"      {table.title}")
        for line in [table.columns, *lines]:
            print("      " + " | ".join(cell(entry) for entry in line))
    print(f"{'pass' if all(row.good for row in rows) else 'FAIL'}  {name}: {len(rows)} rows, {seconds:.1f} s of runs", flush=True)


def cell(entry):
    return f"{entry:.3g}" if isinstance(entry, float) else str(entry)


def markdown(rows, tables, seconds, figures=()):
    """The generated block of a README."""
    lines = [BEGIN, "", *(f"![{name.replace('_', ' ')}]({name}.svg)\n" for name in figures), "| check | expected | got | error | limit | |", "|---|---|---|---|---|---|"]
    lines += [f"| {row.name} | {row.expected} | {row.got} | {row.error} | {row.limit} | {row.word} |" for row in rows]
    reasons = [row for row in rows if row.because]
    if reasons:
        lines += ["", "Reasons of the limits:", ""]
        lines += [f"- {row.name}: {row.because}." for row in reasons]
    for table, body in tables:
        lines += ["", table.title, "", "| " + " | ".join(table.columns) + " |", "|" + "---|" * len(table.columns)]
        lines += ["| " + " | ".join(cell(entry) for entry in line) + " |" for line in body]
    lines += ["", f"All runs together took {max(1, round(seconds))} s on one core.", "", END]
    return "\n".join(lines)


def write_readme(path, block):
    """Puts the block in place of the old one, or behind the text where there is none."""
    text = path.read_text(encoding="utf-8") if path.is_file() else ""
    pattern = re.compile(re.escape(BEGIN) + ".*?" + re.escape(END), re.DOTALL)
    text = pattern.sub(lambda _: block, text) if pattern.search(text) else text.rstrip("\n") + "\n\n" + block + "\n"
    path.write_text(text, encoding="utf-8")


def names_of_all(root=ROOT):
    return sorted(path.parent.name for path in (root / "verification").glob("*/accept.py"))


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drivers", type=Path, help="folder of the programs")
    parser.add_argument("cases", nargs="+", metavar="case", help="folder of verification/, or all")
    parser.add_argument("--full", action="store_true", help="run the long studies too")
    parser.add_argument("--write", action="store_true", help="write the table into the README of the case")
    parser.add_argument("--keep", type=Path, help="leave the runs in this folder")
    parser.add_argument("--threads", type=int, default=1, help="of each run; results do not depend on them")
    options = parser.parse_args(arguments)
    names = names_of_all() if options.cases == ["all"] else options.cases
    good = True
    for name in names:
        try:
            with tempfile.TemporaryDirectory() as scratch:
                case = Case(name)
                if case.fault:
                    raise CannotRun(case.fault)
                runner = Runner(options.drivers, options.keep / name if options.keep else scratch, options.threads)
                rows, tables = case.run(runner, options.full or options.write)  # a README shows everything
                figures = draw(case, runner) if options.write else []
        except CannotRun as error:
            print(f"FAIL  {name}: {error}", flush=True)
            good = False
            continue
        print_rows(name, rows, tables, runner.seconds)
        if options.write:
            write_readme(case.folder / "README.md", markdown(rows, tables, runner.seconds, figures))
        good = good and all(row.good for row in rows)
    return 0 if good else 1


if __name__ == "__main__":
    sys.modules["verify"] = sys.modules["__main__"]  # one module, whoever imports it
    sys.exit(main())
