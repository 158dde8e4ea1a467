"""What studies of runs share: starting a driver or finding what it left, and what a sequence of meshes tends to."""
import hashlib
import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STOPPED_EARLY = 3       # exit status of a driver whose physics stopped: a result, not a fault
FORMAL_ORDER = 2.0      # linear elements cannot do better, so no estimate of error may assume it
LEAST_ORDER, MOST_ORDER = 0.5, 3.0  # an order outside is no order: these meshes are not fine enough to tell
SAFETY_FACTOR = 1.25    # of the grid convergence index on three meshes (Roache 1994)
NO_ORDER_FACTOR = 3.0   # his factor where no order is shown; here on the spread of the three


# ------------------------------------------------------------------------------------------------
# Running

def digest(path):
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def provenance_of(folder):
    return json.loads((Path(folder) / "summary.json").read_text(encoding="utf-8"))["provenance"]


class Study:
    """Runs a driver, or finds the run that has been made already by the same driver, case and settings."""

    def __init__(self, driver, out, threads, run, result):
        """result(name, folder) makes of a run what the study needs of it."""
        self.driver, self.out, self.threads, self.may_run, self.result = driver, out, threads, run, result
        self.made_with = digest(driver) if run else None
        self.known = {}

    def run(self, name, case, settings):
        """The results of one run; settings are {key.path: value}."""
        if name in self.known:
            return self.known[name]
        folder = self.out / name
        asked = {"settings": settings}
        if self.may_run:
            asked.update(driver=self.made_with, case=digest(case))
        if not self.is_there(folder, asked):
            if not self.may_run:
                sys.exit(f"{folder} holds no such run; leave --no-runs away")
            self.start(name, case, folder, settings, asked)
        result = self.result(name, folder)
        print(f"  {name:<32} {result.sentence()}", flush=True)
        self.known[name] = result
        return result

    def is_there(self, folder, asked):
        try:
            record = json.loads((folder / "study.json").read_text(encoding="utf-8"))
            provenance = provenance_of(folder)
        except (OSError, ValueError, KeyError):
            return False
        same = all(record.get(key) == value for key, value in asked.items())
        return same and all(provenance[key] == record.get(key) for key in ("case_hash", "commit"))

    def start(self, name, case, folder, settings, asked):
        if folder.exists():
            shutil.rmtree(folder)
        folder.mkdir(parents=True)
        command = [str(self.driver), str(case.relative_to(ROOT)), "--out", str(folder), "--threads", str(self.threads), "--quiet"]
        for key, value in settings.items():
            command += ["--set", f"{key}={value}"]
        if sys.stdout.isatty():
            print(f"  {name:<32} running", end="\r", flush=True)
        done = subprocess.run(command, cwd=ROOT, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode not in (0, STOPPED_EARLY):
            sys.exit(f"{name} ended with status {done.returncode}\n{done.stderr.strip()}")
        if digest(self.driver) != self.made_with:
            sys.exit("the driver was built anew meanwhile; start the study again")
        provenance = provenance_of(folder)
        record = {**asked, "case_hash": provenance["case_hash"], "commit": provenance["commit"]}
        (folder / "study.json").write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


# ------------------------------------------------------------------------------------------------
# What a sequence of meshes tends to

def observed_order(sizes, values):
    """Order p of f(h) = f0 + C h^p through three meshes of sizes h, finest first; (None, why) where they show none.

    The ratios of h need not be equal: p solves  (f3 - f2)/(f2 - f1) = (h3^p - h2^p)/(h2^p - h1^p).
    """
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    if f2 == f1:
        return None, "the finest two agree to the last digit, so no order can be told"
    ratio = (f3 - f2) / (f2 - f1)
    if ratio <= 0:
        return None, "not monotone on the finest three"

    def right(p):
        return (h3 ** p - h2 ** p) / (h2 ** p - h1 ** p)

    low, high = LEAST_ORDER, MOST_ORDER
    if not right(low) <= ratio <= right(high):
        side = f"below {LEAST_ORDER:g}" if ratio < right(low) else f"above {MOST_ORDER:g}"
        return None, f"monotone, but of an order {side} on the finest three, which is none"
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if right(middle) < ratio else (low, middle)
    return 0.5 * (low + high), ""


def tendency(levels, values):
    """What a sequence of meshes h = 1/level tends to: Richardson's extrapolation through the three finest.

    Returns (sentence, f0 or None, uncertainty of the finest value or None).
    """
    if len(levels) < 3:
        return "fewer than three meshes: no statement", None, None
    (h1, f1), (h2, f2), (h3, f3) = sorted((1 / level, value) for level, value in zip(levels, values))[:3]
    order, why = observed_order((h1, h2, h3), (f1, f2, f3))
    if order is None:
        spread = NO_ORDER_FACTOR * (max(f1, f2, f3) - min(f1, f2, f3))
        return f"{why}; the uncertainty is {NO_ORDER_FACTOR:g} times their spread", None, spread
    used = min(order, FORMAL_ORDER)
    limit = f1 - (f2 - f1) / ((h2 / h1) ** order - 1)
    uncertainty = SAFETY_FACTOR * abs(f2 - f1) / ((h2 / h1) ** used - 1)
    note = f"observed order {order:.2f}" + (f", taken as {FORMAL_ORDER:g} for the uncertainty" if order > FORMAL_ORDER else "")
    return note, limit, uncertainty


# ------------------------------------------------------------------------------------------------
# Tables

def table(head, rows):
    """The lines of a table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]
