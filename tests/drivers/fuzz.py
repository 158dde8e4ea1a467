"""Damaged cases, meshes and command lines end as they should: with a status that says whose fault it is, and with few words.

    python3 tests/drivers/fuzz.py DRIVERS --seconds 60 --seed 1            DRIVERS: the folder with the programs
    python3 tests/drivers/fuzz.py DRIVERS --seed 1 --only 137              input 137 of that seed again, with what was said
    python3 tests/drivers/fuzz.py DRIVERS --seconds 3600 --seed 7 --jobs 2 --kinds mesh

Seeds are the cases of cases/ and verification/, with the meshes beside them, and small meshes in every form in which a .vtu may be written.
An input depends on seed and number alone. Each is tried by `--dry-run`; of those that are sound some run a few steps. What is judged:

    the status is 0, 2, 3, 5 or 6; 4 would be a fault of ours, a signal a crash
    a minute of processor time, 4 GB and 100 kB of words suffice
    the words of status 2 name a place: file, line and column, a word of the command line, or a file that cannot be read
    what the dry run accepts, the run accepts

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
PROCESSOR = 60          # [s] of processor time, whatever else the machine does; half a million elements take a third of it
PATIENCE = 300          # [s] of a program that waits
MEMORY = 4 << 30        # [bytes]
MOST_WORDS = 100_000    # [bytes] on stderr
QUICK = 1               # [s] a seed that takes longer is left out
STATUSES = {0, 2, 3, 5, 6}
KINDS = ("case", "mesh", "line")

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


def seeds():
    """(program, case) of all cases in the tree, in a fixed order."""
    found = []
    for case in sorted((ROOT / "cases").glob("*/*.yaml")):
        if case.parent.name != "cpp":
            found.append((case.parent.name, case))
    for case in sorted((ROOT / "verification").glob("*/*.yaml")):
        accept = case.parent / "accept.py"
        driver = re.search(r'^DRIVER = "(\w+)"', accept.read_text(encoding="utf-8"), re.M) if accept.is_file() else None
        if driver:
            found.append((driver.group(1), case))
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
            data = bytearray(data)
            for _ in range(rng.choice([1, 1, 3, 30])):
                if data:
                    data[rng.randrange(len(data))] = rng.choice([0, 255, 60, 62, 34, 65, rng.randrange(256)])
            data = bytes(data)
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


def damaged_line(rng, text):
    """Words behind a case that is sound."""
    words = []
    keys = re.findall(r"^([a-z_]+):", text, re.M) or ["time"]
    paths = [rng.choice(keys), rng.choice(keys) + "[0].name", "time.end", "time.safety", "output.frames_every", "output.history_every",
             "bodies[0].mesh.cells", "bodies[99].name", "bodies[0",
             "a" * 5000, "a." * 5000 + "b", "bodies[0].material.density",
             "refine", "accuracy", "", ".", "[0]", "time.end.x", "bodies[0].mesh.path"]
    values = REAL + WHOLE + BLOCKS + EXPRESSIONS + ["1 s", "1e-30 s", "[1, 1, 1]", "[]", "x" * 5000]
    values.append(f"{rng.choice(REAL)} {rng.choice(UNITS)}")
    for _ in range(rng.choice([1, 1, 2, 4, 40])):
        what = rng.random()
        if what < 0.75:
            words += ["--set", rng.choice(paths) + rng.choice(["=", "=", "=", "= ", "", "=="]) + rng.choice(values)]
        elif what < 0.85:
            words += ["--threads", rng.choice(WHOLE)]
        else:
            words.append(rng.choice(["--quiet", "--dry-run", "--accuracy=1%", "--of=x", "--help", "-h", "--nonsense" * 500, "--", "-", "",
                                     "--set", "--out", "--resume", "--checkpoint-every=1 us", "--checkpoint-every=0 s", "other.yaml",
                                     "--longest=nan"]))
    return [word.replace("\0", "") for word in words]


# ------------------------------------------------------------------------------------------------
# Trying and judging

class Input:
    """One input: its program, the files it needs and the words behind the case."""

    def __init__(self, driver, files, words=()):
        self.driver, self.files, self.words = driver, files, list(words)


def run(drivers, folder, words, patience=PATIENCE):
    """(status, what it said, seconds) of a program in a folder; None as status where it hangs."""
    began = time.monotonic()

    def limited():
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CPU, (PROCESSOR, PROCESSOR + 5))
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
                   r"|lists what may be given|^\w+: there is no checkpoint|^\w+: .*checkpoint)")


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
    return ""


class Fuzzer:
    def __init__(self, drivers, seed, kinds, keep):
        self.drivers, self.seed, self.kinds, self.keep = drivers, seed, kinds, keep
        self.seeds = [(driver, case) for driver, case in seeds() if (drivers / driver).is_file()]
        self.meshes = meshes()
        self.lock = threading.Lock()
        self.slow = {}
        self.counts = {kind: collections.Counter() for kind in (*kinds, "run")}
        self.faults = []

    def files_beside(self, case):
        return {path.name: path.read_bytes() for path in case.parent.glob("*.vtu")}

    def sound(self, number):
        """Whether a case is a seed: sound, and quick."""
        with self.lock:
            known = self.slow.get(number)
        if known is None:
            driver, case = self.seeds[number]
            status, *_ = run(self.drivers, ROOT, [driver, case.relative_to(ROOT).as_posix(), "--dry-run"], QUICK)
            known = status == 0
            with self.lock:
                self.slow[number] = known
        return known

    def choose(self, rng):
        for _ in range(100):
            number = rng.randrange(len(self.seeds))
            if self.sound(number):
                return self.seeds[number]
        raise RuntimeError("no case of the tree is sound and quick")

    def make(self, kind, rng):
        if kind == "mesh":
            return Input("scene", {"case.yaml": CASE_OF_MESH.encode(), "mesh.vtu": damaged_mesh(rng, rng.choice(self.meshes))})
        driver, case = self.choose(rng)
        text = case.read_text(encoding="utf-8")
        beside = self.files_beside(case)
        if kind == "line":
            return Input(driver, {"case.yaml": text.encode(), **beside}, damaged_line(rng, text))
        return Input(driver, {"case.yaml": damaged_text(rng, text).encode("utf-8", "surrogatepass"), **beside})

    def try_one(self, number, talk=False):
        rng = random.Random(f"{self.seed} {number}")
        kind = rng.choice(self.kinds)
        one = self.make(kind, rng)
        folder = Path(tempfile.mkdtemp(prefix="fuzz_"))
        try:
            for name, data in one.files.items():
                (folder / name).write_bytes(data)
            words = [one.driver, "case.yaml", "--dry-run", *one.words]
            status, said, seconds, size, shown = run(self.drivers, folder, words)
            wrong = judge(status, said, size)
            self.count(kind, status)
            step = re.search(rb"^first step (\S+) s", shown, re.M)
            if not wrong and status == 0 and step and not one.words and rng.random() < 0.5:
                words = [one.driver, "case.yaml", "--out", "out", "--quiet", "--set", f"time.end={20 * float(step.group(1)):.3g} s"]
                status, said, seconds, size, _ = run(self.drivers, folder, words)
                wrong = judge(status, said, size)
                if status == 2:
                    text = said.decode(errors="backslashreplace")
                    # another end has its own faults: a window that is shorter than two rows, too many rows
                    of_end = any(words in text for words in ("time.end", "rows of the history", "by the end at"))
                    wrong = "" if of_end else "the run refuses what the dry run accepts"
                self.count("run", status)
            if talk:
                print(shlex.join(map(str, words)), f"\nstatus {status} after {seconds:.2f} s, {size} bytes")
                print(said.decode(errors="backslashreplace"))
            if wrong:
                self.fault(number, kind, wrong, folder, words, said)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def count(self, kind, status):
        with self.lock:
            self.counts[kind]["hangs" if status is None else status] += 1

    def fault(self, number, kind, wrong, folder, words, said):
        kept = self.keep / f"{self.seed}_{number}"
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(folder, kept, ignore=shutil.ignore_patterns("out"))
        (kept / "command.txt").write_text(shlex.join(map(str, words)) + "\n", encoding="utf-8", errors="surrogateescape")
        (kept / "said.txt").write_bytes(said)
        with self.lock:
            self.faults.append(f"{kept}: {kind} {number} of seed {self.seed}: {wrong}")
            print(self.faults[-1], flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("drivers", type=lambda text: Path(text).resolve())
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--only", type=int, help="number of the input that is tried")
    parser.add_argument("--keep", type=Path, default=ROOT / "out/fuzz", help="folder for inputs that fail")
    options = parser.parse_args()
    fuzzer = Fuzzer(options.drivers, options.seed, tuple(options.kinds), options.keep)
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
        total += sum(counts.values())
        print(f"{kind}: " + ", ".join(f"{count} of status {status}" for status, count in sorted(counts.items(), key=str)))
    print(f"{total} inputs of seed {options.seed}, {len(fuzzer.faults)} that end wrongly")
    return 1 if fuzzer.faults or stopped or total == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
