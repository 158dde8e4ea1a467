"""Runs of drivers, kept and found again: what verification, refinement and anyone else asks of a run.

A run is found again if program, values of the case, settings and threads are the same, if every file that the program read is what it was,
and if every file that it wrote still lies there unchanged, byte by byte. Comments, layout and order of keys of a case file do not count
(case_values.py). No dry run gives the case with the defaults filled in, so these count as part of the program. What a run read is what it
says itself: the paths in the resolved case of summary.json. A study that was interrupted goes on where it stopped, and one that is repeated
makes only what changed. Needs nothing but Python; without its yaml a case file counts byte by byte.
"""
import base64
import csv
import fcntl
import hashlib
import json
import math
import os
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
import zlib
from pathlib import Path

import case_values
import processes

ROOT = Path(__file__).resolve().parent.parent
PROGRAMS = ("scene", "modes", "two_blocks", "patch_test", "sliding", "cask_drop", "plug_juncture", "shield_plates", "slug_impact",
            "material_point", "contact_elements", "penalty_oscillator")  # the drivers, in the order of docs/keys.md
BAD_CASE = 2  # exit status of a driver that refuses its case
STOPPED = 3  # exit status of a driver whose physics stopped: a result, not a fault
UNFINISHED = "unfinished_"  # begins the name of the folder of a run that goes on; the number of its process follows
RECORD = "asked.json"  # in the folder of a run; written last, so a folder with it is whole
USED_BY = "used_by_"  # begins the name of a file in the folder of a run: another tree than that which made it uses it too
LOCK = ".lock"  # in a folder of runs; every process that uses runs there holds it until it ends, and one that removes runs holds it alone
HELD = {}  # {folder of runs: its open lock}


class CannotRun(Exception):
    """A program is missing or refuses its case; says which and what it said."""


class Refused(CannotRun):
    """A program refuses its case, `said` in one line."""

    def __init__(self, words, stderr):
        super().__init__(f"status {BAD_CASE} of {' '.join(words)}\n{stderr}")
        lines = [line.strip() for line in stderr.splitlines() if line.strip()]
        self.said = f"{Path(words[0]).name} refuses {words[1]}" + (f": {lines[0]}" if lines else "")


class BadArgument(CannotRun):
    """What a script is asked for is not there; says what, and what is."""


def is_of_a_living_run(folder):
    """Whether a folder is that of a run that goes on now."""
    found = re.match(UNFINISHED + r"(\d+)_", folder.name)
    return found is not None and processes.is_alive(int(found.group(1)))


def remove_abandoned(folder):
    """Removes what runs have left whose process was killed."""
    for left in folder.glob(UNFINISHED + "*"):
        if not is_of_a_living_run(left):
            shutil.rmtree(left, ignore_errors=True)


def hold(folder):
    """Keeps others from removing runs of a folder as long as this process lasts."""
    if folder not in HELD:
        folder.mkdir(parents=True, exist_ok=True)
        HELD[folder] = (folder / LOCK).open("a", encoding="utf-8")
        lock(folder, fcntl.LOCK_SH)


def lock(folder, how):
    """Whether the lock of a folder was to be had so; a file system may have none."""
    try:
        fcntl.flock(HELD[folder], how)
    except OSError:
        return False
    return True


def remove_unused(folder, used):
    """Removes the runs of this tree's suite that are not among `used`. False: nothing was removed, another process uses the folder.

    Runs that another tree's suite made or found stay, and so do those that go on.
    """
    folder = Path(folder).resolve()
    hold(folder)
    alone = lock(folder, fcntl.LOCK_EX | fcntl.LOCK_NB)
    for run in folder.iterdir() if alone else ():
        if run.is_dir() and run.name not in used and not is_of_a_living_run(run) and not is_of_others(run):
            shutil.rmtree(run, ignore_errors=True)
    lock(folder, fcntl.LOCK_SH)
    return alone


def mark_of(tree):
    return USED_BY + digest(str(tree).encode())[:16]


def is_of_others(run):
    """Whether the suite of another tree made a run or uses it; takes this tree's mark away."""
    (run / mark_of(ROOT)).unlink(missing_ok=True)
    try:
        made_by = json.loads((run / RECORD).read_text(encoding="utf-8")).get("suite", str(ROOT))
    except (OSError, ValueError, AttributeError):
        made_by = str(ROOT)
    return made_by != str(ROOT) or any(run.glob(USED_BY + "*"))


def say_used(run):
    """Marks a run that another tree's suite made, so that it stays when that one needs it no more."""
    if record_of(run).get("suite", str(ROOT)) != str(ROOT):
        try:
            (run / mark_of(ROOT)).write_text(f"{ROOT}\n", encoding="utf-8")
        except OSError:  # a folder of somebody else's
            pass


def driver_of(case, drivers):
    """The program of a case file: `scene` if it has bodies, `modes` if it has neither time nor stages beside them, `material_point` if it
    has the kind of an element and a material; else the folder of cases/ in which it lies, or what accept.py beside it says."""
    keys = set(re.findall(r"(?m)^(\w+):", case.read_text(encoding="utf-8", errors="replace")))
    folder, accept = case.parent.name, case.parent / "accept.py"
    if "bodies" in keys and folder != "modes":
        return "scene" if keys & {"time", "stages"} else "modes"
    if {"kind", "material"} <= keys and not keys & {"bodies", "time"}:
        return "material_point"
    said = re.search(r'(?m)^DRIVER = "(\w+)"', accept.read_text(encoding="utf-8")) if accept.is_file() else None
    return folder if (Path(drivers) / folder).is_file() else said[1] if said else "scene"


# ------------------------------------------------------------------------------------------------
# Where runs are kept

class Store:
    """Runs each combination of program, case, settings and threads once, and finds it again later.

    drivers     the folder of the programs
    folder      where the runs lie, one folder each
    scratch     where a case may write case files of its own
    threads     of each run where none are asked for; results do not depend on them, so they do not tell runs apart
    may_run     False: only finds runs, those of another build of the program too

    `done` holds each run once, `given` every answer in turn.
    """

    def __init__(self, drivers, folder, scratch=None, threads=1, patience=3600, may_run=True):
        self.drivers, self.folder = Path(drivers).resolve(), Path(folder).resolve()
        self.scratch = Path(scratch or self.folder / "scratch").resolve()
        self.threads, self.patience, self.may_run = threads, patience, may_run
        self.digests, self.done, self.given = {}, {}, []
        self.folder.mkdir(parents=True, exist_ok=True)
        hold(self.folder)
        remove_abandoned(self.folder)
        self.scratch.mkdir(parents=True, exist_ok=True)

    def run(self, driver, case, overrides, threads=None):
        """The run of `driver` on the case file, seen from the root of the tree, with these keys set."""
        case = ROOT / case
        settings = {k: str(v) for k, v in sorted(overrides.items())}
        asked = {"driver": driver, "case": digest_of_case(case), "settings": settings, "named": digests_of_named(case, settings),
                 "threads": threads}
        # the folder counts too: a path in a case is seen from where the case lies
        key = json.dumps([asked, str(case.parent)])
        known = self.done.get(key)
        if known is None or not same_inputs(known.asked, case.parent):
            known = self.done[key] = self.find_or_make(driver, case, dict(overrides), threads, asked)
        self.given.append(known)
        return known

    def find_or_make(self, driver, case, overrides, threads, asked):
        if not self.may_run:
            return Run(self, driver, case, overrides, self.newest(asked, case), False)
        asked = {**asked, "program": self.digest_of_program(driver)}
        name = digest(json.dumps(asked, sort_keys=True).encode())[:16]
        folder = self.folder / f"{driver}_{name}"
        made = not self.is_whole(folder, case.parent, asked)
        if made:
            self.make(driver, case, overrides, threads or self.threads, folder, asked)
        else:
            say_used(folder)
        return Run(self, driver, case, overrides, folder, made)

    def newest(self, asked, case):
        """The folder of the newest whole run of this case and these settings, whatever build of the program made it."""
        found = [folder for folder in self.folder.glob(f"{asked['driver']}_*")
                 if self.is_whole(folder, case.parent, asked)]
        if not found:
            settings = ", ".join(f"{key}={value}" for key, value in asked["settings"].items())
            raise CannotRun(f"{self.folder} holds no run of {asked['driver']} {case.name} {settings}")
        return max(found, key=lambda folder: (folder / RECORD).stat().st_mtime_ns)

    def is_whole(self, folder, beside, asked):
        """Whether a folder holds a finished run of what is asked, whose inputs are what they were and whose files are as written."""
        record = record_of(folder)
        return (record is not None and all(record.get(key) == value for key, value in asked.items()) and same_inputs(record, beside)
                and record["files"] == files_of(folder))

    def make(self, driver, case, overrides, threads, folder, asked):
        """Runs in a folder beside `folder` and renames it when all is there, so that an interruption leaves nothing."""
        unfinished = Path(tempfile.mkdtemp(prefix=f"{UNFINISHED}{os.getpid()}_", dir=self.folder))
        program = self.drivers / driver
        words = [str(program), str(case), "--out", str(unfinished), "--quiet", "--threads", str(threads)]
        for key, value in overrides.items():
            words += ["--set", f"{key}={value}"]
        started, began, processor = time.perf_counter(), time.time_ns(), processor_seconds()
        try:
            done = processes.run(words, capture_output=True, text=True, timeout=self.patience)
            if done.returncode == BAD_CASE:
                raise Refused(words, done.stderr)
            if done.returncode not in (0, STOPPED):
                raise CannotRun(f"status {done.returncode} of {' '.join(words)}\n{done.stderr}")
            seconds, processor = time.perf_counter() - started, processor_seconds() - processor
            inputs = inputs_of(unfinished, case.parent)
            for path in [program, case, *(case.parent / one for one in inputs)]:
                if path.stat().st_mtime_ns > began:
                    raise CannotRun(f"{path} changed while {driver} ran; start again")
            if digest_of_case(case) != asked["case"]:
                raise CannotRun(f"{case} changed before {driver} ran; start again")
            record = {**asked, "suite": str(ROOT), "seconds": seconds, "processor_seconds": processor,
                      "warnings": [line for line in done.stderr.splitlines() if line.startswith("warning: ")],
                      "inputs": {path: digest_of_file(case.parent / path) for path in inputs},
                      "files": files_of(unfinished)}
            write_record(unfinished, record)
            try:
                unfinished.rename(folder)
            except OSError:  # another process made the same run meanwhile
                if not self.is_whole(folder, case.parent, asked):  # or something that is not this run is in the way
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
        path = self.drivers / driver
        try:
            state = path.stat()
            key = (driver, state.st_size, state.st_mtime_ns, state.st_ino)
            if key not in self.digests:  # some 10 MB: read again only when built again
                self.digests[key] = digest_of_program(path)
        except OSError as error:
            raise CannotRun(f"{path} is not built") from error
        return self.digests[key]

    def seconds(self):
        """Of the processor, what all runs that were asked for took when they were made. [s]"""
        return sum(run.seconds if run.processor_seconds is None else run.processor_seconds for run in self.done.values())


def processor_seconds():
    """Of all programs that this process started and that have ended. [s]"""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_alone(words, patience=3600):
    """(status, what it said, the most memory that was resident [bytes]) of a program; a status of None: it took too long."""
    words = [sys.executable, "-S", str(ROOT / "scripts/alone.py"), str(patience), *map(str, words)]
    done = processes.run(words, capture_output=True, text=True)
    status, memory = done.stdout.split()
    return None if status == "None" else int(status), done.stderr, int(memory)


def digest(data):
    return hashlib.sha256(data).hexdigest()


def digest_of_program(path):
    """That of its code, without the commit that is written into it."""
    return digest(re.sub(rb"[0-9a-f]{40}(-dirty)?\0", b"", path.read_bytes()))


def read_case(case):
    try:
        return case_values.read(case.read_bytes())
    except OSError as error:
        raise CannotRun(f"{case}: {error.strerror}") from error


def digest_of_case(case):
    """The same for case files with the same values."""
    return read_case(case)[0]


def digests_of_named(case, settings):
    """{path: digest} of the files that values of the case, or what is set in it, name, seen from the folder of the case."""
    texts = {*read_case(case)[1], *settings.values()}
    return {text: digest_of_file(case.parent / text) for text in sorted(texts) if is_name_of_file(text, case.parent)}


def digest_of_file(path):
    """None for a file that is not there."""
    try:
        return digest(path.read_bytes())
    except OSError:
        return None


def same_inputs(record, beside):
    """Whether the files that a run read are what they were, seen from the folder of the case."""
    return all(digest_of_file(beside / path) == before for path, before in record["inputs"].items())


def record_of(folder):
    """What was asked of a finished run and what it read and wrote; None where there is none, or it is not as it was written."""
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
        whole = record.pop("checksum") == checksum_of(record)
    except (OSError, ValueError, AttributeError, KeyError):
        return None
    return record if whole and "inputs" in record and "files" in record else None


def write_record(folder, record):
    text = json.dumps({**record, "checksum": checksum_of(record)}, indent=1)
    (folder / RECORD).write_text(text, encoding="utf-8")


def checksum_of(record):
    return digest(json.dumps(record, sort_keys=True).encode())


def inputs_of(folder, beside):
    """The files that a run read, as the resolved case of its summary.json names them, seen from the folder of the case.

    Every text of the resolved case that names a file counts, whatever its key: a word that happens to be a file's name does no harm.
    """
    def texts(node):
        if isinstance(node, str):
            yield node
        elif isinstance(node, (dict, list)):
            for part in node.values() if isinstance(node, dict) else node:
                yield from texts(part)

    resolved = json.loads((folder / "summary.json").read_text(encoding="utf-8")).get("provenance", {}).get("resolved", {})
    return sorted({text for text in texts(resolved) if is_name_of_file(text, beside)})


def is_name_of_file(text, beside):
    try:
        return bool(text) and len(text) < 4096 and "\0" not in text and (beside / text).is_file()
    except OSError:  # a long text is no name of a file
        return False


def files_of(folder):
    """{path in the folder: [size, digest]} of all that a run wrote."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.is_file() and name != RECORD and not name.startswith(USED_BY):
            data = path.read_bytes()
            found[name] = [len(data), digest(data)]
    return found


# ------------------------------------------------------------------------------------------------
# One run

class Run:
    """What one run of a driver left behind."""

    def __init__(self, runner, driver, case, overrides, folder, made):
        self.runner, self.driver, self.case_file, self.overrides = runner, driver, case, dict(overrides)
        self.folder, self.made = folder, made
        self.asked = record_of(folder)
        self.seconds = self.asked["seconds"]
        self.processor_seconds = self.asked.get("processor_seconds")  # [s] with start and files; None of runs made before this
        self.warnings = self.asked.get("warnings", [])
        self.summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
        self.ending = self.summary["ending"]["word"]
        with (folder / "history.csv").open(newline="", encoding="utf-8") as stream:
            head, *rows = csv.reader(stream)
        columns = zip(*rows, strict=True) if rows else [()] * len(head)
        self.columns = {name.split(" [")[0]: list(map(float, column)) for name, column in zip(head, columns, strict=True)}

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

    def frames(self, collection):
        """How many files a ParaView collection lists."""
        return len(list(xml.parse(self.folder / f"{collection}.pvd").getroot().iter("DataSet")))

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


def straight_line(points):
    """(slope, value at zero) of the line of least squares through [(x, y), ...] or [(x, y, weight), ...]."""
    points = [(x, y, *(weight or [1.0])) for x, y, *weight in points]
    total = sum(w for _, _, w in points)
    mean_x, mean_y = sum(w * x for x, _, w in points) / total, sum(w * y for _, y, w in points) / total
    slope = sum(w * (x - mean_x) * (y - mean_y) for x, y, w in points) / sum(w * (x - mean_x)**2 for x, _, w in points)
    return slope, mean_y - slope * mean_x


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
DEFORMED = "points_are_deformed"  # array of a whole file: its points stand where they are at its time




def read_fields(path):
    """All numeric arrays of points and cells of a ParaView file as the drivers write them: {name: list of numbers or tuples}.

    `points` are the positions at the start and `positions` those at the time of the file, whichever of them the file holds: older files
    hold the former. Points at the start come out of files of today with the round-off of the positions.
    """
    root, fields = xml.parse(path).getroot(), {}
    of_file = {array: array.get("Name") for whole in root.iter("FieldData") for array in whole}  # units, and names of bodies: no fields
    for array in root.iter("DataArray"):
        kind = NUMBERS.get(array.get("type"))
        if array in of_file or kind is None or array.get("format") != "binary":
            continue
        data = unpacked("".join((array.text or "").split()))
        values = struct.unpack(f"<{len(data) // struct.calcsize('<' + kind)}{kind}", data)
        width = int(array.get("NumberOfComponents", "1"))
        fields[array.get("Name")] = list(values) if width == 1 else list(zip(*[iter(values)] * width, strict=True))
    if "points" in fields and "displacement" in fields:
        pairs = list(zip(fields["points"], fields["displacement"], strict=True))
        if DEFORMED in of_file.values():
            fields["positions"] = fields["points"]
            fields["points"] = [tuple(a - b for a, b in zip(x, u)) for x, u in pairs]
        else:
            fields["positions"] = [tuple(a + b for a, b in zip(x, u)) for x, u in pairs]
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
