#!/usr/bin/python3
"""How close is close enough, why, and what must break.

    accept.py DRIVER_FOLDER     runs two_blocks, compares it with reference.py, and runs the breaks

A break is a plausible mistake; it must fail the very check that it names.
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

from reference import reference

HERE = pathlib.Path(__file__).resolve().parent
CASE = HERE.parents[1] / "cases/two_blocks/bars.yaml"

# check: (limit, because)
LIMITS = {
    "interface_stress": (0.01, "ringing averages out over the middle 80 % of the contact"),
    "contact_time": (0.03, "the penalty itself is compliant; the error falls with it, see 'hardness'"),
    "velocity_A": (0.01, "some energy stays behind as ringing; it falls with the mesh"),
    "velocity_B": (0.01, "as A, by symmetry"),
    "created": (0.005, "the vote for the step lets a bounce create no more"),
    "momentum": (1e-12, "contact gives what it takes: round-off"),
}

# a plausible mistake, and the check that must notice it
BREAKS = [
    ("interface_stress", ["contact.penalty=5e11 Pa/m"]),     # a hundred times too soft
    ("contact_time", ["contact.penalty=5e11 Pa/m"]),
    ("velocity_A", ["element.viscosity.linear=1"]),          # viscosity that swallows the wave
    ("velocity_B", ["element.viscosity.linear=1"]),
]


def run(drivers, overrides):
    with tempfile.TemporaryDirectory() as folder:
        command = [str(pathlib.Path(drivers) / "two_blocks"), str(CASE), "--out", folder, "--quiet"]
        for override in overrides:
            command += ["--set", override]
        subprocess.run(command, check=True)
        summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
        rows = list(csv.reader((pathlib.Path(folder) / "history.csv").open()))
    return summary, rows


def errors(summary, rows):
    case = summary["provenance"]["resolved"]
    value = lambda section, key: case[section][key]["value"]
    exact = reference(value("material", "density"), value("material", "young"), value("blocks", "length"),
                      value("blocks", "width"), value("blocks", "gap"), case["closing_speed"]["value"])
    column = {name.split(" ")[0]: i for i, name in enumerate(rows[0])}
    first, last = exact["plateau"]
    plateau = [float(row[column["interface_stress"]]) for row in rows[1:]
               if first <= float(row[column["time"]]) <= last]
    got = {name: summary["results"][name]["value"] for name in ("contact_time", "velocity_A", "velocity_B")}
    got["interface_stress"] = sum(plateau) / len(plateau)
    found = {name: abs(got[name] / exact[name] - 1) for name in got}
    ledger = summary["ledger"]
    found["created"] = max(abs(a["created_relative"]["value"]) for a in ledger["accounts"].values())
    scale = ledger["initial_kinetic"]["value"] * 2 / exact["velocity_B"]
    found["momentum"] = max(abs(p) for p in ledger["momentum"]["value"]) / scale
    return found


def main():
    drivers = sys.argv[1]
    failed = 0
    found = errors(*run(drivers, []))
    for name, (limit, because) in LIMITS.items():
        good = found[name] <= limit
        failed += not good
        print(f"{'pass' if good else 'FAIL'}  {name:18} error {found[name]:.2e}  limit {limit:.0e}  {because}")
    errors_at = [errors(*run(drivers, [f"contact.hardness={h}"]))["contact_time"] for h in ("0.25", "0.5", "1")]
    falls = errors_at[0] > errors_at[1] > errors_at[2]
    failed += not falls
    print(f"{'pass' if falls else 'FAIL'}  contact time falls with hardness 0.25, 0.5, 1: " + ", ".join(f"{e:.2e}" for e in errors_at))
    for name, overrides in BREAKS:
        error = errors(*run(drivers, overrides))[name]
        broke = error > LIMITS[name][0]
        failed += not broke
        print(f"{'pass' if broke else 'FAIL'}  must fail: {' '.join(overrides)} -> {name} error {error:.2e}")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
