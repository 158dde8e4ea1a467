"""Runs of drivers, kept and found again: what verification, refinement and anyone else asks of a run.

A run is found again if program, case file, the meshes it names, settings and threads are the same, so that a study
that was interrupted goes on where it stopped and one that is repeated makes what changed. Needs nothing but Python.
"""
import base64
import csv
import hashlib
import json
import math
import os
import re
import shutil
import struct
import subprocess
import tempfile
import time
import xml.etree.ElementTree as xml
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STOPPED = 3  # exit status of a driver whose physics stopped: a result, not a fault
RECORD = "asked.json"  # in the folder of a run; written last, so a folder with it is whole


class CannotRun(Exception):
    """A program is missing or refuses its case; says which and what it said."""


# ------------------------------------------------------------------------------------------------
# Where runs are kept

class Store:
    """Runs each combination of program, case, settings and threads once, and finds it again later.

    drivers  the folder of the programs
    folder   where the runs lie, one folder each
    scratch  where a case may write case files of its own
    threads  of each run where none are asked for; results do not depend on them, so they do not tell runs apart
    """

    def __init__(self, drivers, folder, scratch=None, threads=1, patience=3600):
        self.drivers, self.folder = Path(drivers).resolve(), Path(folder).resolve()
        self.scratch = Path(scratch or self.folder / "scratch").resolve()
        self.threads, self.patience = threads, patience
        self.digests, self.done = {}, {}
        self.folder.mkdir(parents=True, exist_ok=True)
        self.scratch.mkdir(parents=True, exist_ok=True)

    def run(self, driver, case, overrides, threads=None):
        """The run of `driver` on the case file, seen from the root of the tree, with these keys set."""
        key = (driver, str(case), tuple(sorted((k, str(v)) for k, v in overrides.items())), threads)
        if key not in self.done:
            self.done[key] = self.find_or_make(driver, ROOT / case, dict(overrides), threads)
        return self.done[key]

    def find_or_make(self, driver, case, overrides, threads):
        asked = {"driver": driver, "program": self.digest_of_program(driver), "case": digest_of_case(case),
                 "settings": {k: str(v) for k, v in sorted(overrides.items())}, "threads": threads}
        name = hashlib.sha256(json.dumps(asked, sort_keys=True).encode()).hexdigest()[:16]
        folder = self.folder / f"{driver}_{name}"
        made = not (folder / RECORD).is_file()
        if made:
            self.make(driver, case, overrides, threads or self.threads, folder, asked)
        return Run(self, driver, case, overrides, folder, made)

    def make(self, driver, case, overrides, threads, folder, asked):
        """Runs in a folder beside `folder` and renames it when all is there, so that an interruption leaves nothing."""
        unfinished = Path(tempfile.mkdtemp(prefix="unfinished_", dir=self.folder))
        words = [str(self.drivers / driver), str(case), "--out", str(unfinished), "--quiet", "--threads", str(threads)]
        for key, value in overrides.items():
            words += ["--set", f"{key}={value}"]
        started = time.perf_counter()
        try:
            done = subprocess.run(words, capture_output=True, text=True, timeout=self.patience)
            if done.returncode not in (0, STOPPED):
                raise CannotRun(f"status {done.returncode} of {' '.join(words)}\n{done.stderr}")
            record = {**asked, "seconds": time.perf_counter() - started}
            (unfinished / RECORD).write_text(json.dumps(record, indent=1), encoding="utf-8")
            try:
                unfinished.rename(folder)
            except OSError:  # another process made the same run meanwhile
                if not (folder / RECORD).is_file():  # or something that is no run is in the way
                    shutil.rmtree(folder)
                    unfinished.rename(folder)
        except FileNotFoundError as error:
            raise CannotRun(f"{words[0]} is not built") from error
        except subprocess.TimeoutExpired as error:
            raise CannotRun(f"took longer than {self.patience} s: {' '.join(words)}") from error
        finally:
            shutil.rmtree(unfinished, ignore_errors=True)

    def digest_of_program(self, driver):
        """What tells one program from another; the commit written into it does not, or documents would change it."""
        if driver not in self.digests:
            try:
                code = (self.drivers / driver).read_bytes()
            except FileNotFoundError as error:
                raise CannotRun(f"{self.drivers / driver} is not built") from error
            self.digests[driver] = hashlib.sha256(re.sub(rb"[0-9a-f]{40}(-dirty)?\0", b"", code)).hexdigest()
        return self.digests[driver]

    def seconds(self):
        """What all runs that were asked for took when they were made. [s]"""
        return sum(run.seconds for run in self.done.values())


def digest_of_case(case):
    """Of the text of a case file and of the files it names."""
    try:
        text = Path(case).read_bytes()
    except OSError as error:
        raise CannotRun(f"{case}: {error.strerror}") from error
    together = hashlib.sha256(text)
    for named in re.findall(rb"\bpath\s*:\s*['\"]?([^\s'\",}]+)", text):
        beside = Path(case).parent / os.fsdecode(named)
        if beside.is_file():
            together.update(beside.read_bytes())
    return together.hexdigest()


# ------------------------------------------------------------------------------------------------
# One run

class Run:
    """What one run of a driver left behind."""

    def __init__(self, runner, driver, case, overrides, folder, made):
        self.runner, self.driver, self.case_file, self.overrides = runner, driver, case, dict(overrides)
        self.folder, self.made = folder, made
        self.asked = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        self.seconds = self.asked["seconds"]
        self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        self.ending = self.summary["ending"]["word"]
        with (folder / "history.csv").open(newline="", encoding="utf-8") as stream:
            head, *rows = csv.reader(stream)
        self.columns = {name.split(" [")[0]: [float(row[i]) for row in rows] for i, name in enumerate(head)}

    def again(self, overrides, threads=None):
        """The same case with these keys set as well."""
        return self.runner.run(self.driver, self.case_file, {**self.overrides, **overrides}, threads)

    def other(self, driver, case, overrides=None, threads=None):
        """Another case, seen from the root of the tree."""
        return self.runner.run(driver, case, overrides or {}, threads)

    def result(self, name):
        """A number of summary.json."""
        return named(self.summary["results"], name, "the results of summary.json")["value"]

    def case(self, path):
        """A value of the case as the driver resolved it, in SI: case("bodies[0].material.young")."""
        at = self.summary["provenance"]["resolved"]
        for name in re.findall(r"[^.\[\]]+", path):
            at = at[int(name)] if isinstance(at, list) else at[name]
        return at["value"] if isinstance(at, dict) and "value" in at else at

    def ledger(self, name):
        """A number or vector of the ledger."""
        return named(self.summary["ledger"], name, "the ledger")["value"]

    def account(self, source):
        """The account of one source in the ledger."""
        return named(self.summary["ledger"]["accounts"], source, "the ledger's accounts")

    def created(self):
        """The largest created energy of any source over the scale of the ledger; 0 in a run without any energy. [-]"""
        return max(abs(account["created_relative"]["value"] or 0.0) for account in self.summary["ledger"]["accounts"].values())

    def column(self, name):
        """A column of history.csv."""
        return named(self.columns, name, "the columns of history.csv")

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


def named(entries, name, where):
    """The entry of this name; CannotRun with what there is instead where there is none."""
    if name not in entries:
        raise CannotRun(f"'{name}' is not among {where}: {', '.join(entries)}")
    return entries[name]


# ------------------------------------------------------------------------------------------------
# Reading samples

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


# ------------------------------------------------------------------------------------------------
# Reading ParaView files

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
