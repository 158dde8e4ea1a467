"""Every bad case is refused with exactly the words and the exit status that stand beside it.

    python3 tests/drivers/bad_cases.py DRIVERS             DRIVERS: the folder with the programs
    python3 tests/drivers/bad_cases.py DRIVERS key unit    only cases whose path has one of the words
    python3 tests/drivers/bad_cases.py DRIVERS --update    writes down what the programs say now; read it!

To add a case, put it below bad_cases/ and run with --update:

    cask_drop/NAME.yaml      a whole small case, run as `cask_drop cask_drop/NAME.yaml --dry-run`
    two_blocks/NAME.yaml     the same for two_blocks, and scene/NAME.yaml for scene
    command_line/NAME.args   a whole command line, as one types it within bad_cases/
    .../NAME.expected        what must stand on stderr, and the exit status

The first line of a case says, behind a '#', what is wrong with it. Nothing may stand on stdout.
"""
import argparse
import difflib
import os
import shlex
import subprocess
import sys
from pathlib import Path

CASES = Path(__file__).resolve().parent / "bad_cases"
SOUND = ["command_line/cask_drop.yaml", "command_line/scene.yaml", "command_line/two_blocks.yaml"]  # what .args files make bad
WITHOUT_VTK = "this program was built without VTK"  # and refuses meshes for that, whatever else is wrong with them
SKIPPED = "is not looked at without VTK"
PATIENCE = 20  # [s] a case that is refused takes some milliseconds


def command(case):
    """The command line of a case, as words."""
    if case.suffix == ".args":
        return shlex.split(case.read_text(encoding="utf-8"), comments=True)
    return [case.parent.name, case.relative_to(CASES).as_posix(), "--dry-run"]


def run(drivers, words):
    """(stdout, stderr and exit status) of a program of ours, run within bad_cases/."""
    done = subprocess.run([drivers / words[0], *words[1:]], cwd=CASES, capture_output=True, timeout=PATIENCE,
                          env={**os.environ, "LC_ALL": "C"})
    stdout, stderr = (stream.decode(errors="backslashreplace") for stream in (done.stdout, done.stderr))
    return stdout, f"{stderr}exit status {done.returncode}\n"


def difference(expected, got):
    lines = difflib.unified_diff(expected.splitlines(), got.splitlines(), "expected", "got", lineterm="", n=1)
    return "\n".join("    " + line for line in lines)


def look_at(drivers, case, update):
    """What is wrong with one case, or nothing."""
    stdout, got = run(drivers, command(case))
    wanted = case.with_suffix(".expected")
    if stdout:
        return f"writes to stdout:\n    {stdout.rstrip()}"
    if got.endswith("exit status 0\n"):
        return "is not refused"
    if WITHOUT_VTK in got and got.endswith("exit status 2\n"):
        return SKIPPED
    if update:
        wanted.write_text(got, encoding="utf-8")
    if not wanted.is_file():
        return f"has no {wanted.name}; --update writes it:\n{difference('', got)}"
    expected = wanted.read_text(encoding="utf-8")
    return "" if got == expected else f"says something else:\n{difference(expected, got)}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drivers", type=lambda text: Path(text).resolve())
    parser.add_argument("words", nargs="*")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args()

    cases = sorted(path for path in CASES.rglob("*")
                   if path.suffix in (".yaml", ".args") and path.relative_to(CASES).as_posix() not in SOUND)
    chosen = [case for case in cases
              if not options.words or any(word in case.relative_to(CASES).as_posix() for word in options.words)]
    faults, skipped = [], 0
    for sound in SOUND:  # else everything would be refused for a reason of no interest
        _, said = run(options.drivers, [Path(sound).stem, sound, "--dry-run"])
        if said != "exit status 0\n":
            faults.append((sound, f"must be sound:\n    {said}"))
    for case in chosen:
        fault = look_at(options.drivers, case, options.update)
        if fault == SKIPPED:
            skipped += 1
        elif fault:
            faults.append((case.relative_to(CASES), fault))
    for expected in CASES.rglob("*.expected"):
        if not any(expected.with_suffix(suffix) in cases for suffix in (".yaml", ".args")):
            faults.append((expected.relative_to(CASES), "belongs to no case"))
    for name, fault in faults:
        print(f"{name} {fault}")
    print(f"{len(chosen)} bad cases, {len(faults)} not as expected" + (f", {skipped} not looked at without VTK" if skipped else ""))
    return 1 if faults or skipped == len(chosen) else 0


if __name__ == "__main__":
    sys.exit(main())
