"""What a report takes from the folder of a run: summary, histories, names, warnings; what is missing is said in `missing`."""
import dataclasses
import fcntl
import math
import os
import re
from datetime import datetime
from pathlib import Path

import numpy as np

import frames
import run_files

PARTS = ("summary.json", "history.csv", "body.pvd")  # a folder with none of them is no run
UNKNOWN = "Results, cost and provenance are unknown."
ROOT = Path(__file__).resolve().parents[1]
REMEDIES = ROOT / "docs" / "remedies.md"

ENDINGS = {"reached_end": "reached its end", "stopped_by_condition": "was ended by a condition of 'stop'", "relaxed": "reached equilibrium",
           "interrupted": "was interrupted by a signal", "inverted_element": "was stopped because an element inverted",
           "not_finite": "was stopped because a value was not finite",
           "step_too_small": "was stopped because the time step became too small",
           "energy_created": "was stopped because energy was created", "energy_lost": "was stopped because energy was lost",
           "bodies_overlap": "was stopped because bodies overlap", "not_relaxed": "was stopped without equilibrium"}
GOOD = ("reached_end", "stopped_by_condition", "relaxed")

STEP = "the smallest step was limited by "


@dataclasses.dataclass
class Said:
    """A sentence of a run: kind is ending, warning, note or information; where it belongs is (anchor, words)."""
    kind: str
    text: str
    remedy: str = ""
    where: tuple = ()


class Run:
    """A folder of a run, whatever of a run is in it."""

    def __init__(self, folder, name, key=""):
        self.folder, self.name, self.key = Path(folder), name, key
        self.missing = []
        self.summary = self.read_summary()
        self.first, self.columns, self.units, self.means = self.read_history()
        self.frames = self.listed("body")
        self.walls = self.listed("walls")

    # -- files

    def read_summary(self):
        try:
            return run_files.read_summary(self.folder)
        except run_files.Unreadable as error:
            if not (self.folder / "summary.json").exists():
                now = "another program holds the folder, so the run goes on" if self.is_held() else "it was killed, or it goes on elsewhere"
                self.missing.append(f"summary.json is missing, so the run was not finished: {now}. {UNKNOWN}")
            else:
                self.missing.append(f"summary.json cannot be read: {error}. {UNKNOWN}")
            return {}

    def is_held(self):
        """Whether another program holds the lock of the folder."""
        try:
            with (self.folder / "run.lock").open("rb") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError:
            return False
        return False

    def read_history(self):
        """Name of the first column, and {name: values}, {name: unit}, names of means; a last row that is cut is left out."""
        path = self.folder / "history.csv"
        none = "", {}, {}, set()
        try:
            top, *rows = path.read_text(encoding="utf-8").splitlines() or [""]
            heads = [run_files.head(entry, path.name) for entry in top.split(",")]
        except OSError as error:
            self.missing.append(f"history.csv cannot be read, so there are no histories: {error.strerror}.")
            return none
        except (run_files.Unreadable, UnicodeDecodeError) as error:
            self.missing.append(f"history.csv cannot be read, so there are no histories: {error}.")
            return none
        values = []
        for number, row in enumerate(rows):
            try:
                found = [float(entry) for entry in row.split(",")]
            except ValueError:
                found = []
            if len(found) != len(heads):
                self.missing.append(f"history.csv: row {number + 2} is damaged or cut, so the histories end before it.")
                break
            values.append(found)
        if not values:
            self.missing.append("history.csv holds no rows, so there are no histories.")
            return none
        table = np.array(values).T
        return (heads[0][0], {name: column for (name, _, _), column in zip(heads, table)}, {name: unit for name, unit, _ in heads},
                {name for name, _, mean in heads if mean})

    def listed(self, name):
        """[(time, file)] of the frames of a data set."""
        try:
            found = frames.listed(self.folder, name)
        except frames.CannotRead as error:
            self.missing.append(f"{error}, so its frames are not shown.")
            return []
        if name == "body" and not found and (self.folder / "body.pvd").exists():
            self.missing.append("There are no pictures: body.pvd lists no frames; was the driver built without VTK?")
        return found

    # -- how it ended

    @property
    def word(self):
        found = dict_of(self.summary, "ending").get("word")
        return found if isinstance(found, str) else ""

    @property
    def good(self):
        return self.word in GOOD

    @property
    def end(self):
        """[s], or the last value of what the history is over; NaN if unknown."""
        found = number_of(dict_of(self.summary, "ending").get("time"))
        return found if math.isfinite(found) else self.columns[self.first][-1] if self.first else math.nan

    @property
    def status(self):
        """The exit status of the program; None if unknown."""
        return 0 if self.good else 6 if self.word == "interrupted" else 3 if self.word else None

    @property
    def first_unit(self):
        return self.units.get(self.first, "s")

    @property
    def over_time(self):
        return self.first in ("", "time") and self.summary.get("driver") not in ("modes", "contact_elements")

    def written(self):
        """When the newest file of the run was written."""
        times = [os.path.getmtime(self.folder / name) for name in PARTS if (self.folder / name).exists()]
        return datetime.fromtimestamp(max(times)).strftime("%Y-%m-%d %H:%M") if times else ""

    # -- what is in it

    def results(self):
        """{name: (value, unit)}; a value that is none is NaN."""
        return {name: (number_of(one), str(dict_of(one).get("unit", ""))) for name, one in dict_of(self.summary, "results").items()}

    def accounts(self):
        return {name: dict_of(one) for name, one in dict_of(dict_of(self.summary, "ledger"), "accounts").items()}

    def ledger(self, name):
        return number_of(dict_of(self.summary, "ledger").get(name))

    def listed_in(self, key):
        """The objects of a list of the summary."""
        return [one for one in list_of(self.summary, key) if isinstance(one, dict)]

    def cost(self):
        return {name: one for name, one in dict_of(self.summary, "cost").items() if isinstance(one, (int, float)) or name == "contact"}

    def provenance(self):
        return dict_of(self.summary, "provenance")

    def resolved(self):
        return dict_of(self.provenance(), "resolved")

    def values(self):
        """{path: (text with unit, whether it is the default)} of all values of the case."""
        found = {}
        flatten("", self.resolved(), found)
        return found

    def items(self, section):
        """The items of a list of the case, such as its contacts: [{path within: (text, default)}]."""
        found = []
        for item in list_of(self.resolved(), section):
            found.append({})
            flatten("", item, found[-1])
        return found

    def body_names(self):
        """By the number of the body in frames without names: the accounts of bodies come first, in the order of the frames."""
        return [name for name, account in self.accounts().items() if account.get("kind") == "block"]

    def quantities(self):
        """{probe: quantity}."""
        return {item["name"][0]: item["quantity"][0] for item in self.items("probes") if {"name", "quantity"} <= item.keys()}

    def probes(self):
        """Columns that are no energies of the ledger, in the order of the file."""
        return [name for name in self.columns if name != self.first and not name.startswith("energy_")]

    def energies(self):
        return [name for name in self.columns if name.startswith("energy_")]

    # -- what it says

    def sentences(self):
        """The list of Said of all notes of the summary, warnings first; and the lines of the table of initial gaps."""
        gaps, found, in_table = [], [], False
        interfaces = [name for name, account in self.accounts().items() if account.get("kind") == "interface"]
        if self.word and not self.good:
            found.append(Said("ending", f"The run {ENDINGS.get(self.word, self.word)}: {self.reason()}", *self.remedy_of(self.reason())[1:],
                              where=self.where(self.reason())))
        for text in map(str, list_of(self.summary, "notes")):
            in_table = text.startswith("initial gaps ") or in_table and (text.startswith(" ") or text.split(" ")[0] in interfaces)
            if in_table:
                gaps.append(text)
            elif not text.startswith(STEP) and not (found and found[0].kind == "ending" and text in self.reason()):
                found.append(self.judged(text))
        unused = list_of(self.summary, "not_used")
        if unused:
            found.append(Said("warning", "the program did not use these keys of the case: " + ", ".join(map(str, unused)),
                              "take them out, or run the case with the program that reads them", ("case", "the values of the case")))
        order = ("ending", "warning", "note", "information")
        return sorted(found, key=lambda one: order.index(one.kind)), gaps

    def reason(self):
        ending = dict_of(self.summary, "ending")
        return str(ending.get("reason") or ending.get("word") or "")

    def limited_by(self):
        """What limited the smallest step; empty if unknown."""
        return next((str(text).removeprefix(STEP) for text in list_of(self.summary, "notes") if str(text).startswith(STEP)), "")

    def judged(self, text):
        warned = text in list_of(self.summary, "warnings")
        kind = "warning" if warned else "note" if text.startswith("note: ") else "information"
        said, remedy = self.remedy_of(text.removeprefix("note: "))
        return Said(kind, said, remedy, self.where(said))

    @staticmethod
    def remedy_of(text):
        """A sentence without its remedy, and the remedy, if it is one of those that were tried."""
        places = [text.find(words) for words in remedies() if words in text]
        if not places:
            return text, ""
        return text[:min(places)].rstrip(" :;,"), text[min(places):]

    def where(self, text):
        """(anchor, words) of what a sentence is about; empty if it names nothing of the page."""
        start = text.partition(":")[0]
        named = [word for word in re.split(r", |\s|'", re.sub(r"\([^)]*\)", "", start)) if word in self.accounts()]
        if re.search(r" overlap by |overlaps of bodies", text):
            return "overlaps", "the table of overlaps"
        if re.search(r"\b(created|lost|staggering)\b|still holds", text):
            return "energy", "the energy balance" + (f", {named[0]}" if named else "")
        probes = [name for name in self.probes() if re.search(rf"\b{name}\b", start)]
        if probes and "largest" in text:
            return "histories", f"the history of {probes[0]}"
        if named:
            return f"source-{named[0]}", f"{named[0]} in the set-up"
        return ("cost", "the cost") if "step" in start else ()


# ------------------------------------------------------------------------------------------------
# Pieces

_remedies = []


def remedies():
    """The words of all remedies that a run may name, from the page that lists them."""
    if not _remedies and REMEDIES.is_file():
        for line in REMEDIES.read_text(encoding="utf-8").split("## ")[0].splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if line.startswith("|") and len(cells) == 3 and cells[0] != "cause" and set(cells[0]) != {"-"}:
                _remedies.append(cells[2])
    return _remedies


def dict_of(tree, key=None):
    found = tree if key is None else tree.get(key) if isinstance(tree, dict) else None
    return found if isinstance(found, dict) else {}


def list_of(tree, key):
    found = tree.get(key)
    return found if isinstance(found, list) else []


def number_of(one):
    """The number of {"value": ..., "unit": ...}; NaN if there is none."""
    found = dict_of(one).get("value")
    return float(found) if isinstance(found, (int, float)) and not isinstance(found, bool) else math.nan


def vector_of(one):
    """The numbers of {"value": [...], "unit": ...}; none unless all are numbers."""
    found = list_of(dict_of(one), "value")
    return found if all(isinstance(x, (int, float)) for x in found) else []


def flatten(path, tree, found):
    """Adds the leaves {"value", "unit", "default"} of a tree of case values."""
    if isinstance(tree, list):
        for i, item in enumerate(tree):
            flatten(f"{path}[{i}]", item, found)
        return
    if not isinstance(tree, dict):
        return
    if "default" in tree and "value" in tree and not isinstance(tree["value"], dict):
        found[path] = with_unit(tree["value"], tree.get("unit")), bool(tree["default"])
    for key, item in tree.items():
        if isinstance(item, (dict, list)):
            flatten(f"{path}.{key}" if path else key, item, found)


def with_unit(value, unit):
    said = ", ".join(map(plain, value)) if isinstance(value, list) else plain(value)
    said = f"[{said}]" if isinstance(value, list) else said
    return said if not unit or unit == "1" else f"{said} {unit}"


def plain(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def is_run(folder):
    return any((Path(folder) / name).is_file() for name in PARTS)


def read(folders):
    """The runs of some folders; each has a name of its own, and of several a letter as its key."""
    names = [Path(folder).resolve().name for folder in folders]
    if len(set(names)) < len(names):
        names = [str(folder) for folder in folders]
    keys = [""] if len(folders) == 1 else [letter(i) for i in range(len(folders))]
    return [Run(folder, name, key) for folder, name, key in zip(folders, names, keys)]


def letter(i):
    return chr(ord("A") + i) if i < 26 else f"R{i + 1}"
