#!/usr/bin/env python3
"""Installs the libraries, builds the program of cases/cpp against them outside the tree, and holds it against the driver.

    package.py SOURCE BUILD COMPILER

Its numbers must be those of `scene cases/cpp/bar_on_a_wall.yaml`, to the last digit. The tree must be built.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PATIENCE = 300  # [s] for each command


def run(*words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=PATIENCE)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def main():
    source, build, compiler = Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        run("cmake", "--install", build, "--prefix", place / "prefix", "--component", "library")
        shutil.copytree(source / "cases/cpp", place / "project")
        run("cmake", "-S", place / "project", "-B", place / "build", f"-DCMAKE_PREFIX_PATH={place / 'prefix'}",
            f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", place / "build")
        said = run(place / "build/bar_on_a_wall")
        run(build / "drivers/scene", source / "cases/cpp/bar_on_a_wall.yaml", "--out", place / "out", "--quiet")
        results = json.loads((place / "out/summary.json").read_text())["results"]
    lines = re.findall(r"(\w+): at the end (\S+), largest (\S+)", said)
    if [name for name, _, _ in lines] != ["push", "speed"]:
        sys.exit(f"expected lines of the probes push and speed, got\n{said}")
    for name, last, largest in lines:
        for word, value in (("last", last), ("largest", largest)):
            wanted = results[f"{name}_{word}"]["value"]
            if float(value) != wanted:
                sys.exit(f"{name}_{word}: the program says {value}, the driver {wanted!r}")
    print(f"the same numbers:\n{said}")


if __name__ == "__main__":
    main()
