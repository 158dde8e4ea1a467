"""A sweep as a workflow for Snakemake: `scripts/trade CASE ... --snakemake FOLDER` writes it, and `snakemake --cores N` in FOLDER runs it.

A sweep chooses later runs by what earlier ones gave, so the workflow has stages. The checkpoint of a stage repeats the sweep on the runs
that are there and lists those that it needs next; each of them is a job of its own; at the end the tables are written. All parts call
scripts/trade with the words of the command that wrote the workflow, where it was given, and `--part`:

    next-N      lists the runs of stage N in FOLDER/next/N.txt, and describes each in FOLDER/wanted/KEY.json
    run-KEY     makes one of them, and notes how it ended in FOLDER/ended/KEY.json
    tables      writes what scripts/trade writes

Runs lie where scripts/trade keeps them, so either goes on where the other stopped. On a cluster all machines must see this tree, the
programs, the runs and FOLDER.
"""
import json
import os
import shlex
import sys
from pathlib import Path

import command_line
from runs import ROOT, BadArgument, Store, digest, digest_of_case

FEW = 4    # stages of a study or of values alone: the case, its references, the rest, and one that needs nothing
MANY = 14  # with pairs and six rounds of finer meshes, and some to spare

SNAKEFILE = """# Written by scripts/trade --snakemake; in this folder: snakemake --cores N
TRADE = {trade}

localrules: all, tables, {planned}


def ended(stage):
    \"\"\"The ends of the runs of a stage, which are known when its checkpoint is through.\"\"\"
    listed = getattr(checkpoints, f"next_{{stage}}").get().output[0]
    return [f"ended/{{key}}.json" for key in open(listed).read().split()]


rule all:
    input: "tables.txt"


rule one_run:
    input: "wanted/{{key}}.json"
    output: "ended/{{key}}.json"
    threads: 1
    shell: TRADE + " --part run-{{wildcards.key}}"


{stages}
rule tables:
    input: lambda wildcards: ended({last})
    output: "tables.txt"
    shell: TRADE + " --part tables > $OLDPWD/{{output}}"
"""

STAGE = """checkpoint next_{stage}:
{before}    output: "next/{stage}.txt"
    shell: TRADE + " --part next-{stage}"


"""


TASK = ("driver", "case", "settings", "drivers", "folder")  # what describes a run


class Wanted(Exception):
    """Runs that a sweep needs and that are not there yet: {key: task}."""

    def __init__(self, tasks):
        super().__init__(f"the workflow has not made {len(tasks)} runs that the tables need")
        self.tasks = tasks


# ------------------------------------------------------------------------------------------------
# What is written

def write(folder, words, stages):
    """The Snakefile with this many stages; `words` are those of the command."""
    for name in ("next", "wanted", "ended"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    command = f"cd {shlex.quote(os.getcwd())} && {shlex.join([sys.executable, str(ROOT / 'scripts/trade'), *words])}"
    rules = "".join(STAGE.format(stage=n, before=f"    input: lambda wildcards: ended({n - 1})\n" if n else "") for n in range(stages))
    text = SNAKEFILE.format(trade=repr(command.replace("{", "{{").replace("}", "}}")), stages=rules, last=stages - 1,
                            planned=", ".join(f"next_{n}" for n in range(stages)))
    (folder / "Snakefile").write_text(text, encoding="utf-8")
    print(f"{folder / 'Snakefile'}: cd {folder} && snakemake --cores 2")


# ------------------------------------------------------------------------------------------------
# Parts

def key_of(task):
    """What tells a task from all others, the program included."""
    driver, case, settings, drivers, folder, _ = task
    asked = [driver, digest_of_case(Path(case)), sorted((key, str(value)) for key, value in settings.items())]
    return digest(json.dumps([*asked, Store(drivers, folder).digest_of_program(driver)]).encode())[:16]


def ends_of(folder, tasks):
    """How the tasks ended; Wanted where some have not."""
    paths = [folder / "ended" / f"{key_of(task)}.json" for task in tasks]
    missing = {path.stem: task for path, task in zip(paths, tasks) if not path.is_file()}
    if missing:
        raise Wanted(missing)
    return [json.loads(path.read_text(encoding="utf-8"))["end"] for path in paths]


def do_part(folder, part, sweep, make):
    """One part of the workflow but the tables. sweep() raises Wanted where runs are missing; make(task) makes one run."""
    what, _, which = part.partition("-")
    if what == "next" and which.isdigit():
        missing, before = {}, folder / "next" / f"{int(which) - 1}.txt"
        try:
            if not before.is_file() or before.read_text(encoding="utf-8"):  # nothing comes after a stage that needs nothing
                sweep()
        except Wanted as wanted:
            missing = wanted.tasks
        for key, task in missing.items():
            put(folder / "wanted" / f"{key}.json", dict(zip(TASK, map(plain, task))))
        (folder / "next" / f"{which}.txt").write_text("".join(f"{key}\n" for key in missing), encoding="utf-8")
    elif what == "run" and (folder / "wanted" / f"{which}.json").is_file():
        task = json.loads((folder / "wanted" / f"{which}.json").read_text(encoding="utf-8"))
        put(folder / "ended" / f"{which}.json", {"end": make((*(task[name] for name in TASK), float("inf")))})
    else:
        raise BadArgument(f"'{part}' is no part of the workflow in {folder}; expected is next-N, run-KEY or tables")


def plain(value):
    return value if isinstance(value, dict) else str(value)


def put(path, found):
    """Writes a file that is there as a whole or not at all, and leaves one that says the same alone."""
    text = json.dumps(found, indent=1) + "\n"
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        unfinished = path.with_suffix(f".{os.getpid()}")
        unfinished.write_text(text, encoding="utf-8")
        unfinished.rename(path)


# ------------------------------------------------------------------------------------------------
# Options

def add_options(parser):
    parser.add_argument("--snakemake", type=command_line.folder_to_write, metavar="FOLDER",
                        help="make no run, write the sweep as a workflow")
    parser.add_argument("--part", help="of a workflow: what its rules call")
