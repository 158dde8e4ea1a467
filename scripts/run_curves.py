"""What the figures of runs draw, read from the folders that the drivers wrote: plain curves in the units of the axes."""
from pathlib import Path

from run_files import Unreadable, column, member, read_history, read_summary

PLUGS = ("small", "intermediate", "large")
CREATED = ("energy_created", "energy_integration", "energy_residual")


def names_of(folders):
    """What each run is called: its case, or its folder where runs share a case."""
    folder_names = [Path(folder).resolve().name for folder in folders]
    cases = [Path(read_summary(folder).get("provenance", {}).get("case_path") or name).stem
             for folder, name in zip(folders, folder_names)]
    return cases if len(set(cases)) == len(cases) else folder_names


def settlements(folders):
    """[(name of the run, settlement [mm] of the cask's head over `time` [ms], with the maximum of all steps)] of runs of cask_drop."""
    found = []
    for folder, name in zip(folders, names_of(folders)):
        history, summary = read_history(folder), read_summary(folder)  # of every step; the history has some of them
        found.append((name, {"time": column(history, "time", "s", folder) * 1e3,
                             "mean of the head": column(history, "settlement_mean", "m", folder) * 1e3,
                             "centre of the head": column(history, "settlement_centre", "m", folder) * 1e3,
                             "largest": tuple(1e3 * member(summary, folder, "results", key, "value")
                                              for key in ("settlement_mean", "time_of_settlement_mean"))}))
    return found


def energies(folder):
    """(time [ms], what holds energy, what was created), the last two as {column: per cent of the initial kinetic energy}."""
    history = read_history(folder)
    initial = member(read_summary(folder), folder, "ledger", "initial_kinetic", "value")  # [J]
    if not initial > 0:
        raise Unreadable(f"{folder}/summary.json: the initial kinetic energy is {initial} J; nothing to compare with")
    time = column(history, "time", "s", folder) * 1e3
    per_cent = {name: 100 * column(history, name, "J", folder) / initial for name in history[0] if name.startswith("energy_")}
    made = {name: values for name, values in per_cent.items() if name.startswith(CREATED)}
    held = {name: values for name, values in per_cent.items() if name not in made}
    if not held:
        raise Unreadable(f"{folder}/history.csv: has no column that starts with 'energy_'")
    return time, held, made


def plugs(folder):
    """(time [ms], groups) of a run of plug_juncture: shield plates first, where it has them, then the plugs.

    A group is a list of (name of the body, name of what strikes it, force of that [MN], velocity [m/s]).
    """
    history = read_history(folder)
    plates = [name.removeprefix("velocity_") for name in history[0] if name.startswith("velocity_plate_")]
    shown = [(plates, plates, [f"gap {i + 1}" for i in range(len(plates))])] if plates else []
    shown.append((PLUGS, [str(i + 1) for i in range(len(PLUGS))], [f"juncture {i + 1}" for i in range(len(PLUGS))]))
    groups = [[(body.replace("_", " "), strike, -column(history, f"force_{force}", "N", folder) * 1e-6,
                column(history, f"velocity_{body}", "m/s", folder)) for body, force, strike in zip(*names)] for names in shown]
    return column(history, "time", "s", folder) * 1e3, groups


def plates(folders):
    """[(name of the run, time [ms], {name of the plate: velocity [m/s]})] of runs of shield_plates."""
    found = []
    for folder in folders:
        history = read_history(folder)
        found.append((Path(folder).name, column(history, "time", "s", folder) * 1e3,
                      {name.replace("velocity_", "plate "): column(history, name, "m/s", folder)
                       for name in history[0] if name.startswith("velocity_")}))
    return found
