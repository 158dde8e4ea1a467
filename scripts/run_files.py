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


def read_table(path):
    """([(name, unit, whether it is a mean since the row before)], numbers [rows x columns]) of a file of columns."""
    lines = text_of(path).splitlines() or [""]
    heads = [head(entry, path) for entry in lines[0].split(",")]
    rows = []
    for number, line in enumerate(lines[1:], start=2):
        if not line.strip():
            continue
        try:
            rows.append([float(entry) for entry in line.split(",")])
        except ValueError as error:
            raise Unreadable(f"{path}:{number}: {len(heads)} numbers expected") from error
        if len(rows[-1]) != len(heads):
            raise Unreadable(f"{path}:{number}: {len(rows[-1])} numbers, expected are {len(heads)}")
    if not rows:
        raise Unreadable(f"{path}: holds no rows yet")
    return heads, np.array(rows)


def text_of(path):
    try:
        return Path(path).read_text(encoding="utf-8")
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise Unreadable(f"{path}: byte {error.start + 1} is no text in UTF-8") from error


def read_history(folder):
    """The columns of history.csv as {name: values} and their units as {name: unit}."""
    heads, values = read_table(Path(folder) / "history.csv")
    return dict(zip((name for name, _, _ in heads), values.T)), {name: unit for name, unit, _ in heads}


def read_summary(folder):
    """summary.json as it stands; all quantities are in SI."""
    path = Path(folder) / "summary.json"
    try:
        found = json.loads(text_of(path))
    except json.JSONDecodeError as error:
        raise Unreadable(f"{path}:{error.lineno}: {error.msg}") from error
    if not isinstance(found, dict):
        raise Unreadable(f"{path}: is no summary of a run: expected is an object")
    return found


def member(summary, folder, *names):
    """What a summary has below some names, one in the other."""
    for count, name in enumerate(names, start=1):
        if not isinstance(summary, dict) or name not in summary:
            raise Unreadable(f"{folder}/summary.json: has no '{'.'.join(names[:count])}'")
        summary = summary[name]
    return summary


def column(history, name, unit, folder):
    """One column, whose unit must be the one the figure converts from."""
    columns, units = history
    if name not in columns:
        raise Unreadable(f"{folder}/history.csv: has no column '{name}'; there are {', '.join(columns)}")
    if units[name] != unit:
        raise Unreadable(f"{folder}/history.csv: '{name}' is in {units[name]}, expected is {unit}")
    return columns[name]
