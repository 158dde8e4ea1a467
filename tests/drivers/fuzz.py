"""Damaged cases, meshes, tables and command lines end as they should: with a status that says whose fault it is, and with few words.

    python3 tests/drivers/fuzz.py DRIVERS --seconds 60 --seed 1            DRIVERS: the folder with the programs
    python3 tests/drivers/fuzz.py DRIVERS --seed 1 --only 137              input 137 of that seed again, with what was said
    python3 tests/drivers/fuzz.py DRIVERS --seconds 3600 --seed 7 --jobs 2 --kinds mesh table
    python3 tests/drivers/fuzz.py DRIVERS --list                           the seeds as they stand, and which of them may run

Seeds are all cases of cases/, verification/ and tests/drivers/cases/, with the meshes and tables that they name, and small meshes in every
form in which a .vtu may be written. An input depends on seed and number alone: no clock and no answer of a program has a say in it. Where a
file belongs there may be a folder, a pipe or a device.

Each input is tried by `--dry-run`. What is sound is run: for twenty steps, or with small counts where a program takes no steps. What is too
large to run is judged by the number of its elements. What is judged:

    the status is 0, 2, 3, 5 or 6; 4 would be a fault of ours, a signal a crash
    two minutes of processor time, 4 GB and 100 kB of words suffice
    the words of status 2 name a place: file, line and column, a word of the command line, or a file that cannot be read
    status 5 is the machine and nothing else: that so many elements take more memory than is left, or that the system does not take a
        file. That memory ran out on the way is no such sentence: nobody could tell whose fault that was
    what the dry run accepts, the run accepts, and it does not stop at its start

A failing input is kept below --keep, with its command line and what it said.
"""
import argparse
import base64
import collections
import os
import random
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROCESSOR = 120         # [s] of processor time, whatever else the machine does; what fits into MEMORY takes half of it
PATIENCE = 300          # [s] of a program that waits
MEMORY = 4 << 30        # [bytes]
MOST_FILE = 100 << 20   # [bytes] of a file that a run writes
MOST_WORDS = 100_000    # [bytes] on stderr
MOST_ELEMENTS = 10_000  # of what is run
STEPS = 20              # of a run
STATUSES = {0, 2, 3, 5, 6}
KINDS = {"case": 3, "mesh": 3, "table": 1, "line": 2}   # and how often each is tried

WHOLE = ["0", "1", "2", "3", "-1", "7", "2147483647", "2147483648", "4294967296", "1000000000", "9" * 20, "9" * 400, "010", "+5"]
REAL = ["0", "-0", "-1", "1e-300", "1e-320", "1e300", "1e308", "1e309", "1e200", "1e100", "1e30", "1e-30", "1e-12", "0.1", "1000", "1e6",
        "nan", ".nan", "inf", "-.inf", "1e", "0x10", "1_000", "1,5", "--1", "1e99999999999"]
UNITS = ["m", "mm", "km", "s", "us", "1/s", "kg", "t", "Pa", "GPa", "N", "kN*m", "m/s", "kg/m^3", "m^2^3", "m^99", "(m", "m)", "m//s", "",
         "rad", "deg", "K", "J", "psi", "m^-9999999999", "N/m^2", "kg m"]
EXPRESSIONS = ["1/0", "0/0", "sqrt(-1)", "t > 1e-6 ? sqrt(-1) : 0", "1e308*1e308", "exp(1e9)", "(" * 3000 + "1" + ")" * 3000,
               "-" * 3000 + "1", "1" + "+1" * 20000, "x = 3", "t ? t : t : t", "sum()", "min(1", "rnd()", "1e400", "", " ", "x,y", "\u00e9",
               "t < 1e-9 ? 0 : 1e200", "1?1:" * 2000 + "1", "1e200*t", "_x", "\"", "avg(1,2,3)"]
BLOCKS = ["[" * 10000, "{" * 10000, "&a [*a, *a]", "*nowhere", "<<: *a", "!!float 3", "---", "...", "? a", "- " * 3000, "'", '"', "|", ">",
          "\t", "\0", "\x7f", "\ufeff", "\u2028", "%YAML 9", "#" * 5000, "k" * 20000, "a: " * 3000, "[]", "{}", "null", "~", "yes", "\\"]

WITHOUT_STEPS = {"contact_elements", "material_point", "modes", "penalty_oscillator"}

# What stands in a file's place: a folder, a pipe, or a link to what is named.
ODD = ["folder", "pipe", "/dev/zero", "/dev/null", "/dev/full", "/proc/self/mem", "/proc/self/exe", "nowhere", "itself"]


class Seed:
    """A case of the tree, its program, and the files that it names: bytes, or a word of ODD."""

    def __init__(self, name, driver, text, files):
        self.name, self.driver, self.text, self.files = name, driver, text, files


def program_of(case, text):
    """The program that a case is for: it shows by its keys, by its folder, or by what accepts it."""
    keys = set(re.findall(r"^([a-z_]+):", text, re.M))
    if "bodies" in keys:
        return "modes" if "modes" in keys else "scene"
    if "path" in keys:
        return "material_point"
    if case.parent.parent == ROOT / "cases":
        return case.parent.name
    accept = (case.parent / "accept.py").read_text(encoding="utf-8")
    return re.search(r'^DRIVER = "(\w+)"', accept, re.M).group(1)


def seeds():
    """All cases of the tree, in a fixed order."""
    found = []
    for case in sorted(case for folder in ("cases", "verification", "tests/drivers/cases") for case in (ROOT / folder).rglob("*.yaml")):
        text = case.read_text(encoding="utf-8")
        beside = [path for path in sorted(case.parent.iterdir()) if path.suffix in (".vtu", ".csv") and path.name in text]
        files = {path.name: path.read_bytes() for path in beside}
        if "path: mesh.vtu" in text and not files:   # a test of another script makes it
            files["mesh.vtu"] = mesh("ascii", "UInt32", False)
        found.append(Seed(case.relative_to(ROOT).as_posix(), program_of(case, text), text, files))
    return found


# ------------------------------------------------------------------------------------------------
# Meshes in all forms

CELLS = (2, 2, 1)


def arrays():
    """Arrays of a block of hexahedra: (section, name, type, components, values)."""
    nx, ny, nz = CELLS
    number = {(i, j, k): i + (nx + 1) * (j + (ny + 1) * k) for i in range(nx + 1) for j in range(ny + 1) for k in range(nz + 1)}
    places = sorted(number, key=number.get)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [[number[i + a, j + b, k + c] for a, b, c in corners] for k in range(nz) for j in range(ny) for i in range(nx)]
    return len(places), len(cells), [
        ("PointData", "low", "Int32", 1, [int(p[2] == 0) for p in places]),
        ("CellData", "region", "Int32", 1, [1] * len(cells)),
        ("CellData", "stress", "Float32", 6, [0.5] * (6 * len(cells))),
        ("Points", "Points", "Float64", 3, [float(c) for p in places for c in p]),
        ("Cells", "connectivity", "Int64", 1, [n for cell in cells for n in cell]),
        ("Cells", "offsets", "Int64", 1, [8 * (c + 1) for c in range(len(cells))]),
        ("Cells", "types", "UInt8", 1, [12] * len(cells)),
    ]


def packed(values, kind, word, compressed, encode):
    """Bytes of an array as VTK lays them out, in base64 where `encode` says so."""
    raw = struct.pack("<" + {"Int32": "i", "Int64": "q", "UInt8": "B", "Float32": "f", "Float64": "d"}[kind] * len(values), *values)
    if not compressed:
        whole = struct.pack("<" + word, len(raw)) + raw
        return base64.b64encode(whole) if encode else whole
    size = 64
    blocks = [raw[b:b + size] for b in range(0, len(raw), size)]
    small = [zlib.compress(block) for block in blocks]
    last = len(blocks[-1]) if len(blocks[-1]) < size else 0
    head = struct.pack(f"<{3 + len(small)}{word}", len(small), size, last, *map(len, small))
    return base64.b64encode(head) + base64.b64encode(b"".join(small)) if encode else head + b"".join(small)


def mesh(form, header, compressed):
    """A .vtu file; form: ascii, binary, raw or base64, the last two appended."""
    points, cells, all_arrays = arrays()
    word = "I" if header == "UInt32" else "Q"
    compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    text = (f'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
            f'header_type="{header}"{compressor}>\n  <UnstructuredGrid>\n'
            f'    <Piece NumberOfPoints="{points}" NumberOfCells="{cells}">\n').encode()
    tail, section = b"", None
    for place, name, kind, components, values in all_arrays:
        if place != section:
            text += (f"      </{section}>\n" if section else "").encode() + f"      <{place}>\n".encode()
            section = place
        text += f'        <DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" '.encode()
        if form == "ascii":
            text += b'format="ascii">\n' + " ".join(map(repr, values)).encode()
        elif form == "binary":
            text += b'format="binary">\n' + packed(values, kind, word, compressed, True)
        else:
            text += f'format="appended" offset="{len(tail)}">'.encode()
            tail += packed(values, kind, word, compressed, form == "base64")
        text += b"\n        </DataArray>\n"
    text += f"      </{section}>\n    </Piece>\n  </UnstructuredGrid>\n".encode()
    if tail:
        text += f'  <AppendedData encoding="{form}">\n_'.encode() + tail + b"\n  </AppendedData>\n"
    return text + b"</VTKFile>\n"


def meshes():
    made = [mesh(form, header, packs) for form in ("ascii", "binary", "raw", "base64") for header in ("UInt32", "UInt64")
            for packs in ((False,) if form == "ascii" else (False, True))]
    return made + [path.read_bytes() for path in sorted((ROOT / "verification").glob("*/*.vtu")) if path.stat().st_size < 100_000]


CASE_OF_MESH = """bodies:
  - name: block
    mesh: {kind: file, path: mesh.vtu}
    material: {kind: elastic, density: 7850 kg/m^3, young: 210 GPa, poisson: 0.3}
    element: {thickness: 1 mm}
time: {end: 1 us}
"""

CASE_OF_TABLES = """bodies:
  - name: bar
    mesh: {kind: box, low: [0 m, 0 m, 0 m], high: [100 mm, 20 mm, 20 mm], cells: [4, 2, 2]}
    material: {kind: elastic, density: 7850 kg/m^3, young: 210 GPa, poisson: 0.3}
initial: [{body: bar, velocity: ['table("place.csv", x)', "0", "0"], unit: m/s}]
loads:
  - {name: push, kind: pressure, surface: bar.x_low, value: 'table("time.csv:push", t)', unit: Pa}
  - {name: pull, kind: force, nodes: bar.x_high, value: ["0", "0", '2 - table("time.csv:pull", 2*t)'], unit: kN}
time: {end: 50 us}
"""

TABLES = {"place.csv": b"x [mm], speed [m/s]\n0, -1\n50, 0.5\n100, 2e0\n",
          "time.csv": b"# of a test\ntime [us], push [MPa], pull [N]\n\n0, 0, 0\n5, 1.5e2, -20\n10, 100, 30\n40, 0, 0\n"}


# ------------------------------------------------------------------------------------------------
# Damage

def numbers(text):
    return list(re.finditer(r"(?<![\w.])[-+]?\d+(\.\d*)?([eE][-+]?\d+)?", text))


def with_number(rng, text):
    found = numbers(text)
    if not found:
        return text
    one = rng.choice(found)
    new = rng.choice(WHOLE) if one.group().isdigit() and rng.random() < 0.7 else rng.choice(REAL)
    return text[:one.start()] + new + text[one.end():]


def with_unit(rng, text):
    found = list(re.finditer(r"(?<=\d )[A-Za-z][\w/*^]*", text))
    if not found:
        return text
    one = rng.choice(found)
    return text[:one.start()] + rng.choice(UNITS) + text[one.end():]


def with_word(rng, text):
    found = list(re.finditer(r"[A-Za-z_][\w.]*", text))
    if len(found) < 2:
        return text
    one, other = rng.choice(found), rng.choice(found)
    return text[:one.start()] + rng.choice([other.group(), other.group() + "x", other.group()[:-1]]) + text[one.end():]


def with_lines(rng, text):
    lines = text.split("\n")
    one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    what = rng.randrange(4)
    if what == 0:
        del lines[one]
    elif what == 1:
        lines.insert(other, lines[one])
    elif what == 2:
        lines[one], lines[other] = lines[other], lines[one]
    else:
        lines[one:one] = [lines[one]] * rng.choice([2, 50, 2000])
    return "\n".join(lines)


def with_expression(rng, text):
    found = list(re.finditer(r'"[^"\n]*"', text))
    if not found:
        return text
    one = rng.choice(found)
    return text[:one.start()] + '"' + rng.choice(EXPRESSIONS) + '"' + text[one.end():]


def with_characters(rng, text):
    at = rng.randrange(len(text) + 1)
    what = rng.randrange(4)
    if what == 0:
        return text[:at]
    if what == 1:
        return text[:at] + text[at + rng.choice([1, 1, 5, 50]):]
    if what == 2:
        return text[:at] + rng.choice(BLOCKS) + text[at:]
    return text[:at] + rng.choice("[]{}:,#'\"&*!|>%@`-? \n0123456789.eE") + text[at:]


def with_value(rng, text):
    """Another value behind a colon."""
    found = list(re.finditer(r"(?<=: )[^\s{\[][^,}\]\n]*", text))
    if not found:
        return text
    one = rng.choice(found)
    return text[:one.start()] + rng.choice(REAL + WHOLE + BLOCKS + ["[1, 2, 3]", "{a: 1}", "true", "a"]) + text[one.end():]


def with_many(rng, text):
    """Thousands of keys or of faults in one line."""
    what = rng.randrange(3)
    count = rng.choice([1000, 5000])
    if what == 0:
        return text + "\n" + "\n".join(f"k{n}: 1" for n in range(count)) + "\n"
    if what == 1:
        return text + "\nunknown: [" + ", ".join(["{a: 1}"] * count) + "]\n"
    return re.sub(r"\[([^\[\]]*)\]", lambda m: "[" + ", ".join([m.group(1)] * 300) + "]", text, count=3)


DAMAGES = [with_number] * 5 + [with_value] * 2 + [with_unit, with_word, with_word, with_lines, with_lines, with_expression, with_characters,
                                                  with_characters, with_many]


def damaged_text(rng, text):
    for _ in range(rng.choice([1, 1, 1, 2, 2, 3, 5])):
        text = rng.choice(DAMAGES)(rng, text)
    return text


def damaged_mesh(rng, data):
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        what = rng.random()
        if what < 0.35:    # a number in the head
            found = list(re.finditer(rb'"-?\d+"', data))
            if found:
                one = rng.choice(found)
                value = rng.choice(WHOLE + REAL + [str(int(one.group()[1:-1]) + rng.choice([-8, -1, 1, 8])), str(rng.randrange(10000))])
                data = data[:one.start()] + b'"' + value.encode() + b'"' + data[one.end():]
        elif what < 0.45:  # a word in the head
            found = list(re.finditer(rb'"[A-Za-z]\w*"', data))
            if found:
                one = rng.choice(found)
                new = rng.choice([rng.choice(found).group(), b'""', b'"x"', b'"Int8"', b'"Float32"', b'"String"', b'"UInt64"', b'"ascii"',
                                  b'"binary"', b'"appended"', b'"raw"', b'"base64"', b'"BigEndian"', b'"vtkLZ4DataCompressor"',
                                  b'"vtkLZMADataCompressor"', b'"PolyData"'])
                data = data[:one.start()] + new + data[one.end():]
        elif what < 0.55:  # cut
            data = data[:rng.randrange(len(data) + 1)]
        elif what < 0.75:  # bytes
            data = with_bytes(rng, data, [0, 255, 60, 62, 34, 65])
        elif what < 0.85:  # a number among values
            found = list(re.finditer(rb"(?<=[ \n])-?\d+(\.\d+)?(?=[ \n])", data))
            if found:
                one = rng.choice(found)
                data = data[:one.start()] + rng.choice(WHOLE + REAL).encode() + data[one.end():]
        elif what < 0.93:  # lines
            lines = data.split(b"\n")
            one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
            if rng.random() < 0.5:
                del lines[one]
            else:
                lines.insert(other, lines[one])
            data = b"\n".join(lines)
        else:              # the first letters of base64, which are sizes
            found = list(re.finditer(rb"(?<=[\n>_ ])[A-Za-z0-9+/]{12,}", data))
            if found:
                at = rng.choice(found).start() + rng.randrange(24)
                data = data[:at] + rng.choice([b"/", b"A", b"8", b"="]) + data[at + 1:]
    return data


def with_bytes(rng, data, likely):
    """Data with a few bytes changed, more often to what is likely to matter."""
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 3, 30])):
        if data:
            data[rng.randrange(len(data))] = rng.choice([*likely, rng.randrange(256)])
    return bytes(data)


def with_cell(rng, line):
    """A row of a table with a cell changed, taken out or added."""
    cells = line.split(b",")
    at = rng.randrange(len(cells))
    what = rng.randrange(4)
    if what == 0:
        del cells[at]
    elif what == 1:
        cells.insert(at, rng.choice([b"", b" 7", cells[at]]))
    elif what == 2:
        cells[at] = rng.choice(REAL + WHOLE + BLOCKS + EXPRESSIONS[:5]).encode("utf-8", "surrogatepass")
    else:
        text = cells[at].decode(errors="replace")
        if b"[" in line:
            cells[at] = re.sub(r"\[.*", f"[{rng.choice(UNITS)}" + rng.choice(["]", "]", "]", ""]), text).encode()
        else:
            cells[at] = with_number(rng, text).encode()
    return b",".join(cells)


def damaged_table(rng, data):
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        lines = data.split(b"\n")
        one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
        what = rng.random()
        if what < 0.4:     # a cell
            lines[one] = with_cell(rng, lines[one])
            data = b"\n".join(lines)
        elif what < 0.5:   # lines
            if rng.random() < 0.5:
                del lines[one]
            else:
                lines.insert(other, lines[one])
            data = b"\n".join(lines)
        elif what < 0.6:   # cut
            data = data[:rng.randrange(len(data) + 1)]
        elif what < 0.75:  # bytes
            data = with_bytes(rng, data, [0, 10, 13, 35, 44, 91, 93, 255])
        elif what < 0.85:  # another way to write
            text = data.decode(errors="replace")
            data = rng.choice([text.encode("utf-16", "replace"), text.encode("utf-8-sig"), text.replace("\n", "\r\n").encode(),
                               text.replace("\n", "\r").encode(), text.replace(",", ";").encode(), text.replace(",", "\t").encode(),
                               text.replace(".", ",").encode(), text.upper().encode(), b"", b"\n", b"#", b"\xef\xbb\xbf", lines[0]])
        elif what < 0.95:  # very long
            long = rng.choice([b"," * 200_000, b"1" * 200_000, b"0." + b"0" * 200_000 + b"1", b" " * 200_000, b"#" * 200_000,
                               b"a [m], " * 30_000, b"[" * 100_000, b"x" * 10_000_000, b"\xff" * 100_000, b'"' * 100_000])
            lines[one] = rng.choice([lines[one] + long, long + lines[one], long])
            data = b"\n".join(lines)
        else:              # many lines
            columns = max(1, lines[0].count(b",")) + 1
            data = data.rstrip(b"\n") + b"\n" + b"".join(b"%d%s\n" % (1000 + row, b", 1" * (columns - 1)) for row in range(100_000))
    return data


def one_line_values(text):
    """(path, value) of what stands in sections of one line, as in `time: {end: 1 us}`."""
    for section in re.finditer(r"^([a-z_]+): \{(.*)\}", text, re.M):
        for entry in re.finditer(r"(\w+): ([^,{}\[\]'\"]+)", section.group(2)):
            yield f"{section.group(1)}.{entry.group(1)}", entry.group(2)


def damaged_line(rng, text):
    """Words behind a case that is sound."""
    words = []
    given = list(one_line_values(text)) or [("time.end", "1 us")]
    keys = re.findall(r"^([a-z_]+):", text, re.M) or ["time"]
    paths = [rng.choice(keys), rng.choice(keys) + "[0].name", "time.end", "time.safety", "output.frames_every", "output.history_every",
             "bodies[0].mesh.cells", "bodies[99].name", "bodies[0",
             "a" * 5000, "a." * 5000 + "b", "bodies[0].material.density",
             "refine", "accuracy", "", ".", "[0]", "time.end.x", "bodies[0].mesh.path"]
    values = REAL + WHOLE + BLOCKS + EXPRESSIONS + ["1 s", "1e-30 s", "[1, 1, 1]", "[]", "x" * 5000]
    values.append(f"{rng.choice(REAL)} {rng.choice(UNITS)}")
    for _ in range(rng.choice([1, 1, 2, 4, 40])):
        what = rng.random()
        if what < 0.35:
            path, value = rng.choice(given)
            words += ["--set", f"{path}={rng.choice([value, value, with_number(rng, value), with_unit(rng, value)])}"]
        elif what < 0.75:
            words += ["--set", rng.choice(paths) + rng.choice(["=", "=", "=", "= ", "", "=="]) + rng.choice(values)]
        elif what < 0.85:
            words += ["--threads", rng.choice(WHOLE)]
        else:
            words.append(rng.choice(["--quiet", "--dry-run", "--accuracy=1%", "--of=x", "--help", "-h", "--nonsense" * 500, "--", "-", "",
                                     "--set", "--out", "--resume", "--checkpoint-every=1 us", "--checkpoint-every=0 s", "other.yaml",
                                     "--longest=nan"]))
    return [word.replace("\0", "") for word in words]


WORDS_OF_A_RUN = [[], [], [], [], ["--threads=2"], ["--resume"], ["--checkpoint-every=1e-9 s"], ["--checkpoint-every", "1 us", "--resume"],
                  ["--accuracy=50%", "--longest=0.001"], ["--accuracy=1e-9%", "--of=nothing", "--longest=0.001"]]


# ------------------------------------------------------------------------------------------------
# Trying and judging

class Input:
    """One input: its program, its case, the files beside it, the words behind the case, and more words of a run."""

    def __init__(self, seed, driver, files, words=(), of_run=()):
        self.seed, self.driver, self.files, self.words, self.of_run = seed, driver, files, list(words), list(of_run)

    def case(self):
        return self.files["case.yaml"].decode(errors="replace") if isinstance(self.files["case.yaml"], bytes) else ""


def lay_out(folder, files):
    for name, content in files.items():
        path = folder / name
        if isinstance(content, bytes):
            path.write_bytes(content)
        elif content == "folder":
            path.mkdir()
        elif content == "pipe":
            os.mkfifo(path)
        else:
            path.symlink_to(name if content == "itself" else content)


def run(drivers, folder, words, patience=PATIENCE):
    """(status, what it said, seconds) of a program in a folder; None as status where it hangs."""
    began = time.monotonic()

    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR, PROCESSOR + 5))
        resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_FILE, MOST_FILE))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with tempfile.TemporaryFile() as said, tempfile.TemporaryFile() as shown:
        process = subprocess.Popen([drivers / words[0], *words[1:]], cwd=folder, stdin=subprocess.DEVNULL, stdout=shown, stderr=said,
                                   preexec_fn=limited, env={**os.environ, "LC_ALL": "C"})
        try:
            status = process.wait(patience)
            if status == -signal.SIGXCPU:
                status = None
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            status = None
        seconds = time.monotonic() - began
        size = said.seek(0, 2)
        said.seek(0)
        shown.seek(0)
        return status, said.read(2 * MOST_WORDS), seconds, size, shown.read(MOST_WORDS)


PLACE = re.compile(r"(:\d+:\d+: |^--set .*:\d+: |: a byte in line \d+, column \d+ |--set .*: expected one line|cannot be read: "
                   r"|would overwrite"
                   r"|lists what may be given|^\w+: there is no checkpoint|^\w+: .*checkpoint|^\w+: \S+ is not reached: )")
MEMORY_SHORT = re.compile(r"^\w+: memory does not suffice: \S+ elements take at least (\S+) GB, and (\S+) GB are left$")
FACTORS = re.compile(r"^modes: memory does not suffice: the factors of \S+ freedoms have \S+ entries, which take \S+ GB$")
FILE_REFUSED = re.compile(r"^\w+: cannot (write|make the folder|remove|rename|clear) .+: (File too large|No space left on device|"
                          r"Disk quota exceeded|Not a directory|Is a directory|File exists|File name too long|Permission denied)$")


def is_of_machine(sentence):
    """Whether a sentence of status 5 says what the machine lacks."""
    short = MEMORY_SHORT.match(sentence)
    return float(short.group(1)) >= float(short.group(2)) if short else bool(FACTORS.match(sentence) or FILE_REFUSED.match(sentence))


def judge(status, said, size):
    """What is wrong with an ending, or nothing."""
    if status is None:
        return f"hangs: more than {PROCESSOR} s of processor time, or {PATIENCE} s"
    if status not in STATUSES:
        return f"status {status}"
    if size > MOST_WORDS:
        return f"{size} bytes on stderr"
    text = said.decode(errors="backslashreplace")
    if status != 0 and not text.strip():
        return f"status {status} without a word"
    first = next((line for line in text.split("\n") if not line.startswith("warning: ")), "")
    if status == 2 and not PLACE.search(first):
        return "status 2 without a place"
    if status == 5 and not is_of_machine(first):
        return "status 5 without a sentence of the machine"
    return ""


def counts_of_cells(text):
    """All counts of cells in a case, multiplied: about as many as there are elements, or more."""
    product = 1
    for found in re.findall(r"\bcells\w*: *(\[[^\]]*\]|[^\s,}]+)", text):
        for number in re.findall(r"\d+(?:\.\d*)?(?:[eE]\+?\d+)?", found):
            product *= max(1, float(number))
    return product


def smaller(one, shown):
    """Settings that make a run of a sound input small; None where it is too large.

    shown  what its dry run told
    """
    text = one.case()
    if one.driver == "contact_elements":
        return ["elements=50"]
    if one.driver == "material_point":
        return [f"path[{segment}].increments=10" for segment in range(len(re.findall(r"\bincrements\b", text)))][:50]
    if one.driver == "penalty_oscillator":
        step = re.search(r"^step: (\d+\.?\d*)(?![\w.])", text, re.M)
        return ["phases=5"] + ([] if step and float(step.group(1)) > 0.01 else ["step=0.1"])
    if one.driver == "modes":   # which does not tell its elements
        finer = re.search(r"\b(refine|cells)", " ".join(one.words)) or re.search(r"^refine", text, re.M)
        return None if finer or counts_of_cells(text) > MOST_ELEMENTS / 5 else ["modes.lowest=3", "modes.highest=1"]
    step, elements = re.search(rb"^first step (\S+) s", shown, re.M), re.search(rb"^\d+ nodes, (\d+) elements", shown, re.M)
    if not step or not elements or int(elements.group(1)) > MOST_ELEMENTS:
        return None
    return [f"time.end={STEPS * float(step.group(1)):.3g} s"]


class Ending:
    """How a program ended, by which words, and what is wrong with that."""

    def __init__(self, words, ending):
        self.words = words
        self.status, self.said, self.seconds, self.size, self.shown = ending
        self.wrong = judge(self.status, self.said, self.size)


class Fuzzer:
    def __init__(self, drivers, seed, kinds, keep):
        self.drivers, self.seed, self.kinds, self.keep = drivers, seed, kinds, keep
        self.seeds, self.meshes = seeds(), meshes()
        self.with_tables = [one for one in self.seeds if any(name.endswith(".csv") for name in one.files)]
        self.with_tables.append(Seed("tables", "scene", CASE_OF_TABLES, TABLES))
        self.lock = threading.Lock()
        self.tried, self.large = set(), set()   # names of seeds
        self.counts = {kind: collections.Counter() for kind in (*kinds, "run")}
        self.faults = []

    def missing(self):
        return sorted({one.driver for one in self.seeds if not (self.drivers / one.driver).is_file()})

    def choose(self, rng, kind):
        """A seed; now and then of a program that has few."""
        if kind == "table":
            return rng.choice(self.with_tables)
        if rng.random() < 0.7:
            return rng.choice(self.seeds)
        driver = rng.choice(sorted({seed.driver for seed in self.seeds}))
        return rng.choice([seed for seed in self.seeds if seed.driver == driver])

    def make(self, kind, rng):
        odd = rng.choice(ODD) if rng.random() < 0.04 else None
        if kind == "mesh":
            return Input("", "scene", {"case.yaml": CASE_OF_MESH.encode(), "mesh.vtu": odd or damaged_mesh(rng, rng.choice(self.meshes))})
        seed = self.choose(rng, kind)
        files = {"case.yaml": seed.text.encode(), **seed.files}
        if kind == "table":
            name = rng.choice(sorted(name for name in files if name.endswith(".csv")))
            return Input(seed.name, seed.driver, {**files, name: odd or damaged_table(rng, files[name])})
        if kind == "line":
            return Input(seed.name, seed.driver, files, damaged_line(rng, seed.text), rng.choice(WORDS_OF_A_RUN))
        damaged = odd or damaged_text(rng, seed.text).encode("utf-8", "surrogatepass")
        return Input(seed.name, seed.driver, {**files, "case.yaml": damaged})

    def end(self, one, folder, words, kind, talk):
        given_once = [word for word in words if word not in ("--dry-run", "--quiet") or word not in one.words]
        words = [one.driver, "case.yaml", *given_once, *one.words]
        ending = Ending(words, run(self.drivers, folder, words))
        if kind:
            with self.lock:
                self.counts[kind]["hangs" if ending.status is None else ending.status] += 1
        if talk:
            print(shlex.join(map(str, words)), f"\nstatus {ending.status} after {ending.seconds:.2f} s, {ending.size} bytes")
            print(ending.said.decode(errors="backslashreplace"))
        return ending

    def run_outright(self, one, folder, settings, talk):
        """The run of an input that is sound; it gets the words of a dry run that is as short, so that nothing excuses a refusal."""
        settings = [word for setting in settings for word in ("--set", setting)]
        ending = self.end(one, folder, ["--dry-run", "--quiet", *settings], None, talk)
        if ending.wrong or ending.status != 0:
            return ending
        by_steps = one.driver not in WITHOUT_STEPS
        given = {word.split("=")[0] for word in one.words}
        of_run = one.of_run if by_steps and not any(word.split("=")[0] in given for word in one.of_run) else []
        ending = self.end(one, folder, ["--out", "out", "--quiet", *settings, *of_run], "run", talk)
        if ending.wrong or any(word.startswith("--accuracy") for word in of_run):   # a target has its own faults
            return ending
        if ending.status == 2:
            ending.wrong = "the run refuses what the dry run accepts"
        elif ending.status == 3 and b": stopped at 0 s: " in ending.said:
            ending.wrong = "the run stops at its start, which the dry run did not tell"
        return ending

    def try_one(self, number, talk=False):
        rng = random.Random(f"{self.seed} {number}")
        kind = rng.choices(list(KINDS), list(KINDS.values()))[0]
        if kind not in self.kinds:
            return
        one = self.make(kind, rng)
        folder = Path(tempfile.mkdtemp(prefix="fuzz_"))
        try:
            lay_out(folder, one.files)
            ending = self.end(one, folder, ["--dry-run"], kind, talk)
            no_run = any(re.match(r"--dry-run|--out|--help|-h|--quiet", word) for word in one.words)
            if not ending.wrong and ending.status == 0 and not no_run:
                settings = smaller(one, ending.shown)
                with self.lock:
                    self.tried.add(one.seed)
                    if settings is None:
                        self.large.add(one.seed)
                if settings is not None:
                    ending = self.run_outright(one, folder, settings, talk)
            if ending.wrong:
                self.fault(number, kind, one, ending)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def fault(self, number, kind, one, ending):
        kept = self.keep / f"{self.seed}_{number}"
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir(parents=True)
        lay_out(kept, one.files)
        limits = f"ulimit -v {MEMORY >> 10} -t {PROCESSOR} -f {MOST_FILE >> 10}"
        (kept / "command.txt").write_text(f"{limits}\n{shlex.join(map(str, ending.words))}\n", encoding="utf-8", errors="surrogateescape")
        (kept / "said.txt").write_bytes(ending.said)
        with self.lock:
            self.faults.append(f"{kept}: {kind} {number} of seed {self.seed}: {ending.wrong}")
            print(self.faults[-1], flush=True)

    def list_seeds(self):
        """The seeds as they stand: how their dry run ends, and what keeps them from running."""
        large = refused = 0
        for seed in self.seeds:
            one = Input(seed.name, seed.driver, {"case.yaml": seed.text.encode(), **seed.files})
            with tempfile.TemporaryDirectory(prefix="fuzz_") as folder:
                lay_out(Path(folder), one.files)
                ending = self.end(one, Path(folder), ["--dry-run"], None, False)
            sound = ending.status == 0
            is_large = sound and smaller(one, ending.shown) is None
            refused, large = refused + (not sound), large + is_large
            note = f"status {ending.status}: {ending.said.decode(errors='replace').strip()[:150]}" if not sound else ""
            print(f"{ending.seconds:6.2f} s  {seed.driver:18} {seed.name}  {'too large to run' if is_large else note}", flush=True)
        print(f"{len(self.seeds)} seeds; {refused} end otherwise than with 0 as they stand, {large} are left out of runs")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drivers", type=lambda text: Path(text).resolve())
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", choices=list(KINDS), default=list(KINDS))
    parser.add_argument("--only", type=int, help="number of the input that is tried")
    parser.add_argument("--list", action="store_true", help="dry runs of the seeds as they stand")
    parser.add_argument("--keep", type=Path, default=ROOT / "out/fuzz", help="folder for inputs that fail")
    options = parser.parse_args()
    fuzzer = Fuzzer(options.drivers, options.seed, tuple(options.kinds), options.keep)
    if fuzzer.missing():
        sys.exit(f"in {options.drivers} there is no program " + ", ".join(fuzzer.missing()))
    if options.list:
        fuzzer.list_seeds()
        return 0
    if options.only is not None:
        fuzzer.try_one(options.only, talk=True)
        return 1 if fuzzer.faults else 0
    until = time.monotonic() + options.seconds
    numbers_left = iter(range(10**9))
    stopped = []

    def work():
        try:
            while time.monotonic() < until:
                with fuzzer.lock:
                    number = next(numbers_left)
                fuzzer.try_one(number)
        except Exception as error:  # of this script: the others go on
            stopped.append(error)
            raise

    threads = [threading.Thread(target=work) for _ in range(options.jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    total = 0
    for kind, counts in fuzzer.counts.items():
        total += sum(counts.values()) if kind != "run" else 0
        print(f"{kind}: " + ", ".join(f"{count} of status {status}" for status, count in sorted(counts.items(), key=str)))
    sound, large = fuzzer.tried - {""}, sorted(fuzzer.large - {""})
    print(f"{len(fuzzer.seeds)} seeds, {len(sound)} with sound inputs, {len(large)} too large to run" + (": " if large else "")
          + ", ".join(large))
    print(f"{total} inputs of seed {options.seed}, {sum(fuzzer.counts['run'].values())} runs, {len(fuzzer.faults)} that end wrongly")
    return 1 if fuzzer.faults or stopped or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
