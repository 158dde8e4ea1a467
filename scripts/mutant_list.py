"""Seeded faults of tests/mutants/*.yaml, and the copy of a source in which each of them can be switched on.

An entry has

    id, class, effect   its name, what kind of mistake it is, and what a user would see
    file                path in the tree
    kind                expression or statement
    before, after       text of the file, which occurs once, and what a mistaken programmer would have written; empty: nothing
    left, right         text that stands directly before and after it, to find the place; may be left out

In the copy an expression becomes `nereid::mutant(N) ? (after) : (before)`, a statement `if (nereid::mutant(N)) { after } else { before }`,
and in Python `((after) if mutant(N) else (before))`. N counts the entries from 1. The environment variable NEREID_MUTANT is the number of
the fault that is switched on. The tree itself has none of this.
"""
import dataclasses
import hashlib
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent
LISTS = ROOT / "tests/mutants"
KINDS = ("expression", "statement")
NEEDED = ("id", "file", "class", "kind", "before", "after", "effect")

# Compiled before each source of the copy. A place that is reached tells it once, in a file that a signal cannot take back.
HEADER = """#pragma once
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
namespace nereid {
struct Mutants {
  int active = std::getenv("NEREID_MUTANT") ? std::atoi(std::getenv("NEREID_MUTANT")) : 0;
  const char* told_in = std::getenv("NEREID_MUTANTS_REACHED");
  std::array<std::atomic<bool>, 1024> reached{};
};
inline bool mutant(int number) {
  static Mutants mutants;
  if (mutants.told_in && !mutants.reached[number].load(std::memory_order_relaxed) && !mutants.reached[number].exchange(true)) {
    if (std::FILE* file = std::fopen(mutants.told_in, "a")) std::fprintf(file, "%d\\n", number), std::fclose(file);
  }
  return mutants.active == number;
}
}  // namespace nereid
"""
MODULE = """import os
TOLD = set()


def mutant(number):
    told_in = os.environ.get("NEREID_MUTANTS_REACHED")
    if told_in and number not in TOLD:
        TOLD.add(number)
        with open(told_in, "a", encoding="utf-8") as out:
            out.write(f"{number}\\n")
    return os.environ.get("NEREID_MUTANT") == str(number)
"""


@dataclasses.dataclass(frozen=True)
class Fault:
    number: int
    list: str
    id: str
    file: str
    cls: str
    kind: str
    before: str
    after: str
    effect: str
    left: str = ""
    right: str = ""

    def key(self):
        """Changes with what the fault does; results of another key are of another fault."""
        return hashlib.sha256("\0".join((self.file, self.left, self.before, self.right, self.after)).encode()).hexdigest()[:12]

    def module(self):
        """`contact` of lib/contact/search/near.cpp, `scripts` of scripts/gates.py."""
        parts = Path(self.file).parts
        return parts[1] if parts[0] == "lib" else parts[0]

    def text(self):
        """What stands in its place in the copy."""
        if self.file.endswith((".cpp", ".hpp")):
            if self.kind == "statement":
                return f"if (nereid::mutant({self.number})) {{ {self.after} }} else {{ {self.before} }}"
            return f"(nereid::mutant({self.number}) ? ({self.after}) : ({self.before}))"
        return f'(({self.after}) if __import__("mutants").mutant({self.number}) else ({self.before}))'


def read_lists(folder=LISTS):
    """Faults of all lists, and what is wrong with them."""
    found, faults = [], []
    for path in sorted(folder.glob("*.yaml")):
        for place, entry in enumerate(yaml.safe_load(path.read_text(encoding="utf-8")) or []):
            missing = [name for name in NEEDED if name not in entry]
            if missing or entry["kind"] not in KINDS:
                faults.append(f"{path.name}, entry {place + 1}: expected are {', '.join(NEEDED)}, and a kind of {', '.join(KINDS)}")
                continue
            words = {name: entry[name] for name in ("id", "file", "kind", "before", "after", "effect")}
            around = {name: entry.get(name, "") for name in ("left", "right")}
            found.append(Fault(len(found) + 1, path.stem, cls=entry["class"], **words, **around))
    ids = [fault.id for fault in found]
    faults += [f"'{name}' is there twice" for name in sorted(set(ids)) if ids.count(name) > 1]
    return found, faults


def place_of(fault, text):
    """(begin, end) of its `before` in a text, or a sentence that says why not."""
    around = fault.left + fault.before + fault.right
    if text.count(around) != 1:
        return f"{fault.id}: its text occurs {text.count(around)} times in {fault.file}: expected is once"
    if fault.before == fault.after:
        return f"{fault.id}: before and after are the same"
    begin = text.index(around) + len(fault.left)
    return begin, begin + len(fault.before)


def switchable(text, some):
    """The text with these faults of one file in it, and what is wrong.

    >>> one = Fault(7, "", "a", "lib/a/b.cpp", "sign", "expression", "x + y", "x - y", "")
    >>> switchable("return x + y;", [one])
    ('return (nereid::mutant(7) ? (x - y) : (x + y));', [])
    >>> switchable("return y;", [one])[1]
    ['a: its text occurs 0 times in lib/a/b.cpp: expected is once']
    """
    faults, places = [], []
    for fault in some:
        place = place_of(fault, text)
        if isinstance(place, str):
            faults.append(place)
        else:
            places.append((*place, fault))
    places.sort(key=lambda one: one[0])
    for (_, end, one), (begin, _, other) in zip(places, places[1:]):
        if begin < end:
            faults.append(f"{other.id}: overlaps {one.id}")
    if faults:
        return text, faults
    for begin, end, fault in reversed(places):
        text = text[:begin] + fault.text() + text[end:]
    return text, []


def by_file(found):
    """{file: its faults}."""
    return {file: [fault for fault in found if fault.file == file] for file in dict.fromkeys(fault.file for fault in found)}


def what_is_wrong(found, root=ROOT):
    """Sentences about faults whose place is not there."""
    wrong = []
    for file, some in by_file(found).items():
        if not (root / file).is_file():
            wrong += [f"{fault.id}: there is no {file}" for fault in some]
        else:
            wrong += switchable((root / file).read_text(encoding="utf-8"), some)[1]
    return wrong
