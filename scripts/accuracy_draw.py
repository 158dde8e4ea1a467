"""Results of all scenes of cases/ and verification/, drawn by a seed, on which `--accuracy` is judged: scripts/accuracy --drawn.

The results are the last, largest and smallest value of every probe of every scene. Four strata give the same number each: results
of scenes with a mesh from a file, with a rigid body of a built-in shape, with plates, and contact forces. A draw passes over what
is no question: a scene that is refused, stops or takes more than the patience on its own mesh, or that has no mesh to make finer,
as one of rigid bodies alone, and a value that is zero there or round-off. Nothing else is passed over, and nothing here was
chosen after a result was seen.
"""
import dataclasses
import random
import re
from pathlib import Path

import yaml

import cells
import mesh_files
from convergence import tendency
from runs import ROOT, CannotRun, driver_of

EACH = 5           # results of each stratum
SEED = 20261127
ROUND_OFF = 1e-9   # [-] of the largest result of its unit: below, a value is round-off
PLATES = ("tube", "disc", "sheet")
STRATA = ("file mesh", "rigid shape", "plates", "contact force")
PARTS = ("last", "largest", "smallest")
SIXTHS = tuple(part / 6 for part in range(1, 6 * 16 + 1))  # [-] as the program's factors
ENDED_WELL = ("reached_end", "stopped_by_condition", "relaxed")


@dataclasses.dataclass(frozen=True)
class Drawn:
    """A result of a scene, seen from the root of the tree, and the strata that it belongs to."""
    case: str
    result: str
    strata: tuple

    @property
    def name(self):
        return f"{self.case.removesuffix('.yaml').removeprefix('verification/').removeprefix('cases/')} {self.result}"


# ------------------------------------------------------------------------------------------------
# What there is, and what is drawn

def universe(drivers, root=ROOT):
    """All results of all scenes, in the order of their names."""
    found = []
    for path in sorted(path for folder in ("cases", "verification") for path in (root / folder).rglob("*.yaml")):
        if driver_of(path, drivers) == "scene":
            found += results_of(path, path.relative_to(root).as_posix())
    return found


def results_of(path, name):
    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
    except yaml.YAMLError:
        return []
    if not isinstance(tree, dict) or not isinstance(tree.get("bodies"), list):
        return []
    of_scene = [stratum for stratum in STRATA[:3] if scene_has(stratum, path.parent, tree["bodies"])]
    contacts = {one.get("name") for one in tree.get("contacts", [])}
    contacts |= {one.get("name") for one in tree.get("planes", []) if one.get("kind") in ("rigid", "floor")}
    found = []
    for probe in tree.get("probes", []):
        presses = probe.get("quantity") in ("force", "contact_pressure") and probe.get("of") in contacts
        strata = tuple(of_scene + [STRATA[3]] * presses)
        found += [Drawn(name, f"{probe['name']}_{part}", strata) for part in PARTS]
    return found


def scene_has(stratum, folder, bodies):
    kinds = [(body["mesh"].get("kind"), body.get("rigid", False), body["mesh"]) for body in bodies if isinstance(body.get("mesh"), dict)]
    if stratum == "file mesh":
        return any(kind == "file" for kind, *_ in kinds)
    if stratum == "rigid shape":
        return any(rigid and kind != "file" for kind, rigid, _ in kinds)
    return any(kind in PLATES or kind == "file" and has_plates(folder / mesh["path"], mesh) for kind, _, mesh in kinds)


def has_plates(path, mesh):
    """Whether a file has plates: cells of fewer than eight nodes that are not said to be, or found to be, faces of solids."""
    try:
        sizes = {len(cell) for cell in mesh_files.read(path).cells}
    except mesh_files.Unreadable:
        return False
    return bool(sizes & {3, 4}) and (8 not in sizes or mesh.get("boundary_cells") == "plates")


def draw(results, is_question, seed=SEED, each=EACH):
    """(stratum, result) pairs: each stratum in its turn takes the next of its results, shuffled by the seed, that is a question.

    No scene is drawn twice for a stratum before all its scenes have been, and no result twice.
    """
    chance, drawn = random.Random(seed), []
    for stratum in STRATA:
        own = [one for one in results if stratum in one.strata]
        chance.shuffle(own)
        of_case, rank = {}, {}  # the how manieth of its scene each is
        for one in own:
            rank[one] = of_case[one.case] = of_case.get(one.case, 0) + 1
        taken = 0
        for one in sorted(own, key=rank.get):  # stable: the first of each scene, then the second
            if taken == each:
                break
            if all(one != other for _, other in drawn) and is_question(one):
                drawn.append((stratum, one))
                taken += 1
    return drawn


def is_question(one, store):
    """Whether a result has a value other than zero and round-off on the mesh of its case, and there is such a mesh."""
    try:
        summary = store.run("scene", one.case, {}).summary
    except CannotRun:
        return False
    resolved = summary["provenance"]["resolved"]
    finest = max(cells.flat(cells.counts_of_cells(resolved).values()), default=1)
    if cells.all_rigid(resolved) or finest == 1 and not cells.bodies_from_files(resolved):
        return False
    mine = summary["results"].get(one.result)
    if summary["ending"]["word"] not in ENDED_WELL or mine is None or not isinstance(mine["value"], (int, float)):
        return False
    of_unit = [abs(other["value"]) for other in summary["results"].values()
               if other["unit"] == mine["unit"] and isinstance(other["value"], (int, float))]
    return abs(mine["value"]) > ROUND_OFF * max(of_unit)


# ------------------------------------------------------------------------------------------------
# What is true

def finer_factors(resolved, last):
    """Two factors beyond the last mesh that the case can follow: 3/2 and 2 times as fine or the next above; 2 and 4 times with files."""
    if cells.bodies_from_files(resolved):
        return [2 * last, 4 * last]
    counts = cells.counts_of_cells(resolved)
    even = [factor for factor in SIXTHS if cells.settings_of(counts, factor)[1] <= cells.UNEVEN]
    first = next((factor for factor in even if factor >= 1.49 * last), None)
    second = next((factor for factor in even if first and factor >= 1.3 * first), None)
    return [factor for factor in (first, second) if factor]


def settings_for(resolved, case, factor, scratch):
    """Settings that make a case finer by a factor. Beyond 4, files are split here first, and counts are multiplied as much."""
    before = max(1, round(factor / 4)) if cells.bodies_from_files(resolved) else 1
    settings = {"refine": f"{factor / before:.10g}"}
    if before == 1:
        return settings
    settings.update(cells.settings_of(cells.counts_of_cells(resolved), before)[0])
    for number, body in enumerate(resolved["bodies"]):
        if cells.number_of(body["mesh"].get("kind")) == "file":
            path = Path(cells.number_of(body["mesh"]["path"]))
            mesh = mesh_files.read((ROOT / case).parent / path)
            for _ in range(before.bit_length() - 1):
                mesh = mesh_files.split(mesh)
            finer = scratch / f"{Path(case).parent.name}_{path.stem}_{before}.vtu"
            mesh_files.write(finer, mesh)
            settings[f"bodies[{number}].mesh.path"] = str(finer)
    return settings


def truth(one, store, scratch, told):
    """(value, its uncertainty, the factors it comes from) by two meshes beyond the last that was asked for; None where none is run."""
    resolved = store.run("scene", one.case, {}).summary["provenance"]["resolved"]
    lines = [re.match(r"refine ([\d.]+): \S+ = (\S+)", line) for line in told.lines]
    factors, values = [float(line[1]) for line in lines], [float(line[2]) for line in lines]
    made = []
    for factor in finer_factors(resolved, factors[-1]):
        try:
            summary = store.run("scene", one.case, settings_for(resolved, one.case, factor, scratch)).summary
        except (CannotRun, mesh_files.Unreadable):
            break
        if summary["ending"]["word"] not in ENDED_WELL:
            break
        made.append(factor)
        factors.append(factor)
        values.append(summary["results"][one.result]["value"])
    if not made or len(values) < 3:
        return None
    _, limit, uncertainty = tendency(factors, values)
    return (values[-1] if limit is None else limit), uncertainty, made


# ------------------------------------------------------------------------------------------------
# The table

@dataclasses.dataclass
class Row:
    """One result that was drawn; errors over the true value. `said` tells why there is no estimate, or why the target is not reached."""
    stratum: str
    name: str
    estimate: float | None = None
    true: float | None = None
    uncertainty: float | None = None
    finest: str = ""
    beyond: tuple = ()
    said: str = ""

    def within(self):
        return self.true is not None and self.true <= self.estimate + self.uncertainty


def row_of(stratum, one, store, scratch, told):
    """told  what `--accuracy` answered: scripts/accuracy"""
    row = Row(stratum, one.name, finest=re.search(r"refine ([\d.]+)", told.lines[-1])[1] if told.lines else "")
    reached = told.status == 0 and told.value is not None
    answer = (told.value, told.error) if reached else last_estimate(told.lines)
    if not reached:
        row = dataclasses.replace(row, said=told.said.partition(" is not reached: ")[2] or told.said)
    if answer is None:
        return row
    mine, error = answer
    found = truth(one, store, scratch, told)
    if found is None:
        return dataclasses.replace(row, estimate=error / abs(mine), said=row.said or "no finer mesh could be run")
    value, uncertainty, beyond = found
    scale = abs(value) or abs(mine)
    return dataclasses.replace(row, estimate=error / scale, true=abs(mine - value) / scale, uncertainty=uncertainty / scale,
                               beyond=tuple(beyond))


def last_estimate(lines):
    """(value, its estimated error) of the last mesh, as the screen shows them; None where it shows no estimate."""
    found = re.match(r"refine \S+: \S+ = (\S+) .*estimated error (\S+) %", lines[-1]) if lines else None
    return (float(found[1]), abs(float(found[1])) * float(found[2]) / 100) if found else None


def percent(part):
    return "" if part is None else f"{100 * part:.2g} %"


def text_of(rows, target, seed):
    lines = [f"Drawn by the seed {seed}, asked at {100 * target:g} %:", "",
             "| of | result | true error | estimate | true value is uncertain by | finest mesh | true value from | |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in rows:
        beyond = ", ".join(f"{factor:g}" for factor in row.beyond)
        lines.append(f"| {row.stratum} | {row.name} | {percent(row.true)} | {percent(row.estimate)} | {percent(row.uncertainty)} | "
                     f"{row.finest} | {beyond} | {row.said.replace('|', '/')} |")
    refused = [row for row in rows if row.estimate is None]
    untold = [row for row in rows if row.estimate is not None and row.true is None]
    good, most = sum(row.within() for row in rows), len(rows) // 10
    counted = len(rows) - min(len(refused), most) - len(untold)
    reached = sum(row.estimate is not None and not row.said for row in rows)
    return "\n".join([*lines, "", f"{reached} of {len(rows)} reach the target; of others the estimate is that of their last mesh.",
                      f"{len(rows) - len(refused)} of {len(rows)} have an estimate, and the true error is within it in {good}. "
                      f"{len(refused)} were refused: those beyond {most} count as missed, which makes {good} of {counted}."
                      + (f" Of {len(untold)} the true value is not known." if untold else "")])
