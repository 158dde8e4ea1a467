"""The scenes of this folder, run beside their twins: scripts/twins.py makes the twins, scripts/compare_runs.py compares."""
import math
from pathlib import Path

import compare_runs
import twins

FOLDER = "verification/invariance_scenes"
FROM_FILES = ("strike", "plates", "stack", "press", "splash")  # scenes whose meshes come from files
SCENES = (*FROM_FILES, "ball")


def base_of(run, scene):
    """The run of a scene as it stands in this folder."""
    return run.other("scene", f"{FOLDER}/{scene}.yaml")


def put_down(run, tree, label, **options):
    """Writes a twin and its meshes; returns the path of its case."""
    return twins.put_down(tree, Path(__file__).resolve().parent, run.runner.scratch, label, **options)


def twin_of(run, path):
    """The run of a twin; a break is set in the twin alone, so that it differs from the base by one mistake."""
    return run.other("scene", str(path), run.overrides)


# ------------------------------------------------------------------------------------------------
# Checks

# What a difference of 1e-12 in the first velocities has grown to at the end of each scene, and the limit of round-off, ten
# times what any twin has shown.
GROWN = {"strike": 4e-12, "plates": 7e-11, "stack": 1.4e-10, "press": 6e-11, "splash": 4.3e-10, "ball": 6e-11}
ROUND_OFF = {"strike": 5e-11, "plates": 1e-10, "stack": 1e-9, "press": 2e-9, "splash": 1e-10, "ball": 3e-10}


def because(scene):
    return (f"round-off alone; a disturbance of 1e-12 at the start of this scene grows to {GROWN[scene]:.2g}, "
            "and no twin has shown more than a tenth of the limit")


def both(run, scene, make):
    """Base, twin and carry; `make(run, base, scene)` gives the path of the twin's case and the Carry of its results."""
    base = base_of(run, scene)
    path, carry = make(run, base, scene)
    return base, twin_of(run, path), carry


def difference(run, scene, make):
    """The largest relative difference of all that is compared; infinite where one of both has stopped early."""
    base, twin, carry = both(run, scene, make)
    return compare_runs.largest(compare_runs.differences(base, twin, carry)) if base.ending == twin.ending else math.inf


def summary_rows(run, scene, make):
    """For a table: scene, steps, largest difference of histories, fields and impulses, and where the largest stands."""
    base, twin, carry = both(run, scene, make)
    parts = [one(base, twin, carry) for one in (compare_runs.histories, compare_runs.fields, compare_runs.ledgers)]
    together = {name: v for part in parts for name, v in part.items()}
    return [scene, base.summary["cost"]["steps"], *(f"{compare_runs.largest(part):.1e}" for part in parts), max(together, key=together.get)]


COLUMNS = ["scene", "steps", "histories", "last frame", "impulses", "most in"]


def curve(run, scene, make, name, ours):
    """A column of the twin, or of the base, over the time of the base [us], carried back where it was scaled."""
    base, twin, carry = both(run, scene, make)
    one = base if ours else twin
    columns = compare_runs.history(one)
    factors = (1, 1) if ours else (carry.factor(columns["time"][0]), carry.factor(columns[name][0]))
    return [1e6 * t / factors[0] for t in columns["time"][1]], [v / factors[1] for v in columns[name][1]]
