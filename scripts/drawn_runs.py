"""Runs of drawn scenes by the program `scene`: cut after so many seconds of a processor, measured, and kept as lines of one file."""
import json
import math
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from pathlib import Path

import processes
from runs import digest

DONE, STOPPED = 0, 3  # exit statuses of the program that are results
CUT = "cut"           # in place of the exit status of a run that took too long
LONGEST = 3600.0      # [s] by the clock on the wall


class Kept:
    """The runs of a folder: {key: what came out}, in a file to which each run appends a line."""

    def __init__(self, folder, program):
        self.path, self.program, self.lock = folder / "runs.jsonl", program, threading.Lock()
        self.runs = {}
        if self.path.is_file():
            for line in self.path.read_text(encoding="utf-8").splitlines():
                try:
                    run = json.loads(line)
                    self.runs[run["key"]] = run
                except (ValueError, KeyError, TypeError):  # the last line of a script that was killed
                    continue

    def key(self, case):
        return digest(f"{self.program}\n{case}".encode())[:20]

    def add(self, run):
        with self.lock:
            self.runs[run["key"]] = run
            with self.path.open("a", encoding="utf-8") as stream:
                stream.write(json.dumps(run) + "\n")


def run(case, options, *words, read):
    """What came out of a case, given as text, in a folder that goes afterwards.

    words  that the program gets beside the case
    read   a function of the status and of the folder of the results, whose dictionary is added; of what was cut it reads nothing
    """
    with tempfile.TemporaryDirectory(prefix="unfinished_", dir=options.out) as folder:
        path, out = Path(folder) / "case.yaml", Path(folder) / "run"
        path.write_text(case, encoding="utf-8")
        began = time.perf_counter()
        program = [str(options.drivers / "scene"), str(path), "--out", str(out), "--quiet", "--threads", "1", *words]
        try:
            done = processes.run([*cut_after(options.clock), *program], capture_output=True, text=True, errors="replace", timeout=LONGEST)
            status, said = CUT if done.returncode == -signal.SIGXCPU else done.returncode, done.stderr
        except subprocess.TimeoutExpired:
            status, said = CUT, ""
        found = {"status": status, "seconds": round(time.perf_counter() - began, 3),
                 "warnings": [line for line in said.splitlines() if line.startswith("warning: ")],
                 "said": " ".join(said.split())[:500] if status not in (DONE, CUT) else ""}
        return found | (read(status, out) if status in (DONE, STOPPED) else {})


def cut_after(seconds):
    """What goes before the words of a program so that it is cut after so many seconds of a processor, whatever else runs meanwhile."""
    prlimit = shutil.which("prlimit")  # of util-linux
    return [prlimit, f"--cpu={math.ceil(seconds)}"] if prlimit else []
