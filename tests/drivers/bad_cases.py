"""Every bad case is refused with exactly the words and the exit status that stand beside it.

    python3 tests/drivers/bad_cases.py DRIVERS             DRIVERS: the folder with the programs
    python3 tests/drivers/bad_cases.py DRIVERS key unit    only cases whose name, as in scene/stages_none, has one of the words
    python3 tests/drivers/bad_cases.py DRIVERS --update    writes down what the programs say now; read it!

bad_cases/PROGRAM.yaml lists what a program refuses, by topic, and command_line.yaml what all programs refuse on their command lines. To add
a case, write an entry with an empty `says:` and run with --update:

    - name: kind_misspelt
      wrong: A misspelt kind.
      change: |
        -  kind: j2_bilinear
        +  kind: j2_bilinaer
      says:

Most entries change a sound case, and some are a whole case. The case is written as case.yaml into a new folder, beside copies of
bad_cases/meshes/, and is run there as `PROGRAM case.yaml --dry-run`. Nothing may stand on stdout. Keys of an entry:

    name        a word that no other entry of the list has
    wrong       what is wrong: the first line of case.yaml, behind a '#', in place of the first line of the base
    base        a sound case: bad_cases/base/BASE.yaml, by default PROGRAM.yaml; the name begins with that of the program
    change      lines of the base, with '-' in front of a line that is removed and '=' in front of one that stays, and below them the
                lines that are inserted there, with '+' in front; a blank line separates two places
    add         lines that are inserted above the section `time` of the base, or at its end if it has none
    case        the whole case without its first line, in place of a base
    encoding    that of case.yaml, by default utf-8
    files       more files in the folder, as `file: text`
    command     the command line, if it is another one
    status      the exit status, by default 2
    says        the whole text on stderr
"""
import argparse
import dataclasses
import difflib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml

LISTS = Path(__file__).resolve().parent / "bad_cases"
BASES, MESHES = LISTS / "base", LISTS / "meshes"
KEYS = {"name", "wrong", "base", "change", "add", "case", "encoding", "files", "command", "status", "says"}
NEEDED = {"name", "wrong", "says"}
OF_A_BASE = {"base", "change", "add"}
WITHOUT_VTK = "this program was built without VTK"  # then all meshes of files are refused, whatever else is wrong with them
SKIPPED = "is not checked without VTK"
PATIENCE = 20  # [s] a case that is refused takes some milliseconds
LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


@dataclasses.dataclass(frozen=True)
class Case:
    """An entry of a list, and the line of the list in which its `says` is."""
    path: Path
    entry: dict
    line: int

    @property
    def name(self):
        return f"{self.path.stem}/{self.entry['name']}"

    @property
    def words(self):
        """The command line, as words."""
        return shlex.split(self.entry.get("command", f"{self.path.stem} case.yaml --dry-run"))

    @property
    def base(self):
        """The name of the sound case, or nothing."""
        return None if "case" in self.entry else self.entry.get("base", self.words[0])

    @property
    def expected(self):
        return with_status(self.entry["says"] or "", self.entry.get("status", 2))


def with_status(stderr, status):
    return f"{stderr}exit status {status}\n"


def read(path):
    """(cases of a list, faults of the list)"""
    text = path.read_text(encoding="utf-8")
    cases, faults, names = [], [], set()
    for entry, node in zip(yaml.load(text, LOADER), yaml.compose(text, LOADER).value):
        keys = [key.value for key, _ in node.value]
        said = [f"has no key '{key}'" for key in sorted(NEEDED - set(keys))]
        said += [f"has the key '{key}', which is none of {', '.join(sorted(KEYS))}" for key in keys if key not in KEYS]
        said += [f"has the key '{key}' twice" for key in sorted(set(keys)) if keys.count(key) > 1]
        said += [f"has the keys 'case' and '{key}'" for key in keys if "case" in keys and key in OF_A_BASE]
        said += ["has the name of another entry"] if entry.get("name") in names else []
        faults += [(f"{path.name}:{node.start_mark.line + 1}", fault) for fault in said]
        names.add(entry.get("name"))
        if not said:
            cases.append(Case(path, entry, next(key.start_mark.line for key, _ in node.value if key.value == "says")))
    return cases, faults


def lists():
    """(all cases, faults of the lists)"""
    cases, faults = zip(*(read(path) for path in sorted(LISTS.glob("*.yaml"))))
    return sum(cases, []), sum(faults, [])


def changed(text, change):
    """The text with each change made; the lines that a change names must be in one place."""
    for place in re.findall(r"(?:[-=].*\n)+(?:\+.*\n)*|.+\n?", change):
        old, new = ("".join(line[1:] + "\n" for line in place.split("\n") if line[:1] in signs) for signs in ({"-", "="}, {"=", "+"}))
        if not old or text.count("\n" + old) != 1:
            raise ValueError(f"needs these lines of 'change' in one place of the base:\n{old or place}")
        text = text.replace("\n" + old, "\n" + new)
    return text


def written(case, folder):
    """Writes all files of a case into a folder; the path of the case."""
    for mesh in MESHES.iterdir():
        shutil.copy(mesh, folder)
    for name, text in case.entry.get("files", {}).items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    text = f"# {case.entry['wrong']}\n"
    if case.base:
        text += (BASES / f"{case.base}.yaml").read_text(encoding="utf-8").partition("\n")[2]
        text = changed(text, case.entry.get("change", ""))
        place = text.find("\ntime:") + 1 or len(text)
        text = text[:place] + case.entry.get("add", "") + text[place:]
    else:
        text += case.entry["case"]
    path = folder / "case.yaml"
    path.write_bytes(text.encode(case.entry.get("encoding", "utf-8")))
    return path


def run(drivers, words, folder):
    """(stdout, stderr, exit status) of a program of ours, run in a folder."""
    done = subprocess.run([drivers / words[0], *words[1:]], cwd=folder, capture_output=True, timeout=PATIENCE,
                          env={**os.environ, "LC_ALL": "C"})
    return *(stream.decode(errors="backslashreplace") for stream in (done.stdout, done.stderr)), done.returncode


def difference(expected, got):
    lines = difflib.unified_diff(expected.splitlines(), got.splitlines(), "expected", "got", lineterm="", n=1)
    return "\n".join("    " + line for line in lines)


def check(drivers, case, update):
    """(fault of one case or an empty text; the text on stderr that its list should have, or None)"""
    with tempfile.TemporaryDirectory() as folder:
        try:
            written(case, Path(folder))
        except (OSError, ValueError) as fault:  # no such base or encoding, or a change that does not fit
            return str(fault), None
        stdout, stderr, status = run(drivers, case.words, folder)
    if stdout:
        return f"writes to stdout:\n    {stdout.rstrip()}", None
    if status == 0:
        return "is not refused", None
    if WITHOUT_VTK in stderr and status == 2:
        return SKIPPED, None
    expected = with_status(stderr, case.entry.get("status", 2)) if update else case.expected
    got = with_status(stderr, status)
    return "" if got == expected else f"says something else:\n{difference(expected, got)}", stderr if update else None


def write_down(path, said):
    """Replaces texts of `says` in a list, given as {line of `says`: text}. All other lines stay."""
    lines = path.read_text(encoding="utf-8").split("\n")
    for start, text in sorted(said.items(), reverse=True):
        indent = lines[start].index("says")
        end = start + 1
        while end < len(lines) and (not lines[end].strip() or lines[end].startswith(" " * (indent + 1))):
            end += 1
        while not lines[end - 1].strip():
            end -= 1
        lines[start:end] = [lines[start][:indent] + "says: |"] + [" " * (indent + 2) * bool(line) + line for line in text.split("\n")[:-1]]
    wanted = [said.get(case.line, case.entry["says"]) for case in read(path)[0]]
    if [entry["says"] for entry in yaml.load("\n".join(lines), LOADER)] != wanted:
        sys.exit(f"{path.name}: a text on stderr cannot be written as a block of YAML; the list stays as it is")
    path.write_text("\n".join(lines), encoding="utf-8")


def unsound(drivers, programs):
    """Faults of base cases. A base that is not sound would be refused whatever an entry changes."""
    for base in sorted(BASES.iterdir()):
        program = next((name for name in programs if f"{base.stem}_".startswith(f"{name}_")), None)
        said = "the name does not begin with that of a list"
        if program:
            _, stderr, status = run(drivers, [program, base, "--dry-run"], MESHES)
            said = with_status(stderr, status)
        if said != "exit status 0\n":
            yield f"base/{base.name}", f"must be sound:\n    {said}"


def unused(cases):
    """Faults of files that no case uses."""
    used = {case.base for case in cases}
    text = "".join(path.read_text(encoding="utf-8") for path in LISTS.glob("*.yaml"))
    yield from ((f"base/{path.name}", "belongs to no case") for path in sorted(BASES.iterdir()) if path.stem not in used)
    yield from ((f"meshes/{path.name}", "belongs to no case") for path in sorted(MESHES.iterdir()) if path.name not in text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drivers", type=lambda text: Path(text).resolve())
    parser.add_argument("words", nargs="*")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()

    cases, faults = lists()
    if faults:
        sys.exit("\n".join(f"{place} {fault}" for place, fault in faults))
    faults = [*unsound(options.drivers, [path.stem for path in LISTS.glob("*.yaml")]), *unused(cases)]
    chosen = [case for case in cases if not options.words or any(word in case.name for word in options.words)]
    skipped, new = 0, {}
    for case in chosen:
        fault, said = check(options.drivers, case, options.update)
        if said is not None:
            new.setdefault(case.path, {})[case.line] = said
        if fault == SKIPPED:
            skipped += 1
        elif fault:
            faults.append((case.name, fault))
    for path, said in new.items():
        write_down(path, said)
    for name, fault in faults:
        print(f"{name} {fault}")
    print(f"{len(chosen)} bad cases, {len(faults)} not as expected" + (f", {skipped} not checked without VTK" if skipped else ""))
    return 1 if faults or skipped == len(chosen) else 0


if __name__ == "__main__":
    sys.exit(main())
