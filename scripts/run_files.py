"""What a driver wrote into the folder of a run, as arrays: history.csv and summary.json."""
import json
import re
from pathlib import Path

import numpy as np


class Unreadable(Exception):
    """A run's file is missing or is not what a driver writes; says which and what was expected."""


def head(entry, path):
    """(name, unit, whether it is a mean since the row before) of an entry of the first line of a history."""
    found = re.fullmatch(r"\s*([\w.]+)\s*\[([^\]]*)\]( mean)?\s*", entry)
    if not found:
        raise Unreadable(f"{path}:1: '{entry}' is no column header; expected is 'name [unit]' or 'name [unit] mean'")
    return found.group(1), found.group(2), found.group(3) is not None


def read_history(folder):
    """The columns of history.csv as {name: values} and their units as {name: unit}."""
    path = Path(folder) / "history.csv"
    try:
        with path.open(encoding="utf-8") as file:
            header = file.readline().rstrip("\n").split(",")
            rows = [line.split(",") for line in file if line.strip()]
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    heads = [head(entry, path) for entry in header]
    names, units = [name for name, _, _ in heads], {name: unit for name, unit, _ in heads}
    values = np.empty((len(rows), len(names)))
    for i, row in enumerate(rows):
        try:
            values[i] = [float(entry) for entry in row]
        except ValueError as error:
            raise Unreadable(f"{path}:{i + 2}: {len(names)} numbers expected") from error
    if not rows:
        raise Unreadable(f"{path}: holds no rows yet")
    return dict(zip(names, values.T)), units


def read_summary(folder):
    """summary.json as it stands; all quantities are in SI."""
    path = Path(folder) / "summary.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    except json.JSONDecodeError as error:
        raise Unreadable(f"{path}:{error.lineno}: {error.msg}") from error


def column(history, name, unit, folder):
    """One column, whose unit must be the one the figure converts from."""
    columns, units = history
    if name not in columns:
        raise Unreadable(f"{folder}/history.csv: has no column '{name}'; there are {', '.join(columns)}")
    if units[name] != unit:
        raise Unreadable(f"{folder}/history.csv: '{name}' is in {units[name]}, expected is {unit}")
    return columns[name]
