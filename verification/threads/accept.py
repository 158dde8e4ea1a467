"""How close is close enough, why, and what must break."""
import sys
from pathlib import Path

from compare_runs import files_that_differ
from verify import Breaks, Check, Figure, Pair, Table

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "invariance_scenes"))
import scenes  # noqa: E402

CLAIM = "One, two and four threads write the same bits."
EVIDENCE = "invariant"
CATALOGUE = ()
DRIVER = "scene"


def different(run, case, threads):
    """Files that differ from those of one thread, or are missing on one side."""
    return files_that_differ(run.other(DRIVER, case, {}, threads=1).folder, run.other(DRIVER, case, run.overrides, threads=threads).folder)


def of_the_case(threads):
    return lambda run: Pair(len(different(run, run.case_file, threads)[0]), 0, "files", scale=1)


def of_a_scene(scene, threads):
    return lambda run: Pair(len(different(run, f"{scenes.FOLDER}/{scene}.yaml", threads)[0]), 0, "files", scale=1)


WHY = "sums are cut into parts of a fixed size and added up in a fixed order, so that not one bit may differ"
SMALL = (("plates", 2), ("splash", 2), ("ball", 4))

DEPARTURES = {
    "area, damping_ratio, hourglass_kind, integration, layers, method, passes, penalty, penalty_scale, "
    "rotary_inertia":
        "every loop must be shared out, so these scenes have all kinds of elements and contacts"}

CHECKS = [
    *(Check(f"{threads} threads: files that differ from those of one", of_the_case(threads), 0, WHY) for threads in (2, 4)),
    *(Check(f"{scene}, {threads} threads: files that differ from those of one", of_a_scene(scene, threads), 0, WHY)
      for scene, threads in SMALL),
]


def table(run):
    rows = []
    for title, case in (("this case", run.case_file), *((scene, f"{scenes.FOLDER}/{scene}.yaml") for scene in scenes.SCENES)):
        steps = run.other(DRIVER, case, {}, threads=1).summary["cost"]["steps"]
        rows.append([title, steps, different(run, case, 2)[1], *(len(different(run, case, threads)[0]) for threads in (2, 4))])
    return rows


STUDIES = [Table("Files that differ from those of one thread.", ["scene", "steps", "files", "2 threads", "4"], table, full=True)]

def longer_steps(*keys):
    return {f"{key}.energy_gain_limit": 0.0051 for key in keys}


BREAKS = [
    Breaks("2 threads: files that differ from those of one", "steps that are 1 % longer on two threads",
           longer_steps("contacts[0]", "contacts[1]", "planes[0]")),
    Breaks("4 threads: files that differ from those of one", "a penalty that is one bit larger on four threads",
           {"contacts[0].penalty": "10000000000000.002 Pa/m"}),
    Breaks("plates, 2 threads: files that differ from those of one", "steps that are 1 % longer on two threads",
           longer_steps("contacts[0]")),
    Breaks("splash, 2 threads: files that differ from those of one", "steps that are 1 % shorter on two threads", {"time.safety": 0.891}),
    Breaks("ball, 4 threads: files that differ from those of one", "steps that are 1 % longer on four threads",
           longer_steps("contacts[0]")),
]


def force(label, threads):
    def curves(run):
        one = run.other(DRIVER, run.case_file, {}, threads=threads)
        return [(label, [1e6 * t for t in one.column("time")], [1e-3 * f for f in one.column("ground_force")])]
    return curves


FIGURES = [Figure("ground_force", "time [us]", "force on the ground [kN]", force("four threads", 4), exact=force("one thread", 1),
                  caption="The force on the ground under the case by four threads, over that by one; there is no difference to show.")]
