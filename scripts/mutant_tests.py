"""Tests of a build in which faults can be switched on: which there are, what they reach, and which of them notices a fault first.

Two groups: `unit`, the label of ctest, with programs of modules and tests of scripts; and `suite`, the cases of verification/, which are
run without their breaks and studies, and the tests of programs. What judges the tree and not what it does, as house rules and tables of
earlier runs, is left out.
"""
import dataclasses
import json
import os
import re
import shutil
import signal
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import processes

# they judge texts of the tree, build it again, or need a screen
LEFT_OUT = re.compile(r"house\.|scripts\.(house|pages|syntax|benchmark|seeded_faults)$|drivers\.package$|verify\.(tables|pages)$")
SKIPPED = 77
# a shell that works in the background has its programs ignore these, and tests send them
SIGNALS = ("env", "--default-signal=INT,QUIT")
SLOWER = 5       # times as long as without a fault: a test that hangs has noticed it
AT_LEAST = 30.0  # [s]


@dataclasses.dataclass(frozen=True)
class Test:
    name: str
    group: str
    words: tuple


def list_tests(build):
    """Tests of a folder of CMake, as `ctest --show-only` lists them."""
    said = subprocess.run(["ctest", "--test-dir", str(build), "--show-only=json-v1"], capture_output=True, text=True, check=True).stdout
    found = []
    for one in json.loads(said)["tests"]:
        about = {entry["name"]: entry["value"] for entry in one.get("properties", [])}
        if "command" not in one or LEFT_OUT.match(one["name"]):
            continue
        words = ["env", *about["ENVIRONMENT"], *one["command"]] if "ENVIRONMENT" in about else one["command"]
        found.append(Test(one["name"], "unit" if "unit" in about.get("LABELS", []) else "suite", tuple(words_of(words))))
    return found


def words_of(command):
    """A case of verification/ without breaks and studies, and a place for the folder of what runs write.

    >>> words_of(["python3", "a/scripts/verify.py", "--out", "b", "--no-figures", "tied_bar"])
    ['python3', 'a/scripts/verify.py', '--out', '{scratch}', '--no-figures', 'tied_bar', '--no-breaks']
    """
    words = list(command)
    if "--out" in words:
        words[words.index("--out") + 1] = "{scratch}"
    if any(word.endswith("scripts/verify.py") for word in words):
        words.append("--no-breaks")
    return words


def run_test(test, folder, number, limit=None, reached=None, stop=None):
    """(what came out, seconds): pass, fail or stopped. `folder` is an empty one for what it writes; it is removed."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    environment = {**os.environ, "NEREID_MUTANT": str(number), "NEREID_THREADS": "1", "TMPDIR": str(folder),
                   "PYTHONDONTWRITEBYTECODE": "1"}
    if reached:
        environment["NEREID_MUTANTS_REACHED"] = str(reached)
    words = [*SIGNALS, *(word.replace("{scratch}", str(folder / "out")) for word in test.words)]
    started = time.monotonic()
    with open(folder.parent / f"{folder.name}.log", "w", encoding="utf-8") as log:
        run = processes.start(words, stdout=log, stderr=subprocess.STDOUT, stdin=processes.NOTHING, cwd=folder, env=environment,
                              start_new_session=True)
        said = "fail"
        while True:
            try:
                said = "pass" if run.wait(0.05) in (0, SKIPPED) else "fail"
                break
            except subprocess.TimeoutExpired:
                late = limit is not None and time.monotonic() - started > limit
                if late or (stop and stop.is_set()):
                    said = "fail" if late else "stopped"
                    break
        try:
            os.killpg(run.pid, signal.SIGKILL)  # what a test leaves behind
        except ProcessLookupError:
            pass
        run.wait()
    shutil.rmtree(folder, ignore_errors=True)
    return said, time.monotonic() - started


def first_to_notice(tests, number, scratch, seconds, jobs):
    """The name of a test that fails with this fault twice, as a busy machine may do it once, or nothing; what runs beside it is ended.
    Tests are asked in their order."""
    noticed, lock, stop = [], threading.Lock(), threading.Event()

    def ask(place):
        if stop.is_set():
            return
        test = tests[place]
        limit = SLOWER * seconds[test.name] + AT_LEAST
        if all(run_test(test, scratch / f"{number}_{place}", number, limit, stop=stop)[0] == "fail" for _ in range(2)):
            with lock:
                noticed.append(test.name)
            stop.set()

    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(ask, range(len(tests))))
    return noticed[0] if noticed else ""


def measure(tests, scratch, jobs, say):
    """{name: {passes, seconds, reached}} of all tests without a fault; reached are the numbers of places that a test comes to."""
    found = {}

    def one(test):
        told = scratch / f"{test.name.replace('/', '_')}.reached"
        told.unlink(missing_ok=True)
        folder = scratch / test.name.replace("/", "_")
        said, took = run_test(test, folder, 0, reached=told)
        if said != "pass":  # to tell what is reached takes memory, which a test may count
            said, took = run_test(test, folder, 0)
        numbers = sorted({int(line) for line in told.read_text().split()}) if told.is_file() else []
        found[test.name] = {"passes": said == "pass", "seconds": round(took, 2), "reached": numbers}
        say(f"{said}  {test.name}: {len(numbers)} places, {took:.1f} s")

    with ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, tests))
    return found


def within(tests, seconds, limit):
    """Those of some tests that a limit of seconds allows, in their order: one that is too long is passed over.

    >>> a, b, c = (Test(name, "unit", ()) for name in "abc")
    >>> [test.name for test in within([a, b, c], {"a": 1, "b": 9, "c": 2}, 4)]
    ['a', 'c']
    """
    some, left = [], limit
    for test in tests:
        if seconds[test.name] <= left:
            some.append(test)
            left -= seconds[test.name]
    return some


def in_order(tests, module, seconds, kills):
    """Tests of the module of the fault first, then by how many faults each has noticed in a second.

    >>> a, b, c = (Test(name, "unit", ()) for name in ("base.1", "load.1", "contact.1"))
    >>> [test.name for test in in_order([a, b, c], "contact", {"base.1": 1, "load.1": 1, "contact.1": 9}, {"load.1": 3})]
    ['contact.1', 'load.1', 'base.1']
    """
    def worth(test):
        own = test.name.split(".")[0] == module
        return (not own, -(kills.get(test.name, 0) + 0.5) / (seconds[test.name] + 0.2), test.name)
    return sorted(tests, key=worth)
