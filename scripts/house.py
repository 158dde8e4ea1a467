#!/usr/bin/env python3
"""Holds the tree against its own rules; needs nothing but Python.

    scripts/house.py floors   modules include only what they rest on (the table in CMakeLists.txt)
    scripts/house.py doors    each dependency enters through one file
    scripts/house.py words    words, paths and open ends that must not stand in the tree
    scripts/house.py mirror   tests mirror lib/ file for file
    scripts/house.py width    lines have at most 140 characters
    scripts/house.py links    pages link to files that exist
    scripts/house.py retired  words that have a new name (scripts/words.py), once they are retired there
    scripts/house.py circles  no script of scripts/ imports itself by way of others, and figures import nothing but figures
    scripts/house.py all      all of them

Every fault is one line, `file:line: what is wrong and what is expected`; the exit status is 1 if
there is one. `--root FOLDER` looks at another tree.
"""
import argparse
import ast
import fnmatch
import os
import re
import sys
from pathlib import Path

import command_line
import words as table_of_words

CODE = {".hpp", ".cpp"}

# ------------------------------------------------------------------------------------------------
# The tables

# Includes of a dependency, and the files that may have them. Folders not named are not looked at.
DOORS = [
    # dependency, what gives it away, looked for in, its doors
    ("yaml-cpp", r"#\s*include\s*<yaml-cpp/", "lib drivers tests", ["lib/input/yaml.cpp"]),
    ("muParser", r"#\s*include\s*<muParser\w*", "lib drivers tests", ["lib/input/expression.cpp"]),
    ("Spectra", r"#\s*include\s*<Spectra/", "lib drivers tests", ["lib/dynamics/modes.cpp"]),
    ("VTK", r"#\s*include\s*<vtk\w*", "lib drivers tests", ["lib/grid/grid.cpp"]),
    ("libdeflate", r"#\s*include\s*<libdeflate", "lib drivers tests", ["lib/grid/frame_text.cpp"]),
    ("nlohmann-json", r"#\s*include\s*<nlohmann/", "lib drivers tests", ["lib/output/summary.cpp", "drivers/keys.cpp"]),
    ("CLI11", r"#\s*include\s*<CLI/", "lib drivers tests", ["drivers/driver.cpp"]),
    ("a thread", r"#\s*include\s*<(thread|mutex|future|omp\.h)>|#\s*pragma\s+omp\b", "lib drivers tests",
     ["lib/base/parallel.cpp", "lib/base/beside.cpp"]),
    ("std::experimental::simd", r"#\s*include\s*<experimental/simd>", "lib drivers tests",
     ["lib/base/number.hpp", "tests/benchmark/floor.cpp"]),
    ("a test framework", r"#\s*include\s*<(gtest|gmock|catch2|doctest)/", "lib drivers", []),
    ("matplotlib", r"^\s*(import|from)\s+(matplotlib|pylab|mpl_toolkits)\b",
     "scripts verification tests drivers cases docs", ["scripts/figure.py"]),
    ("SciPy", r"^\s*(import|from)\s+scipy\b", "scripts verification tests drivers cases docs", ["scripts/trade_vary.py"]),
    ("Python-Markdown", r"^\s*(import|from)\s+markdown\b", "scripts verification tests drivers cases docs",
     ["scripts/verification_report.py"]),
]

# Eigen's names are used everywhere but come from one header; a source that needs a cross product or a
# decomposition may name that part, because it is slow to compile and nobody's vocabulary.
EIGEN_DOOR = "lib/base/types.hpp"
EIGEN_IN_SOURCES = {"Dense", "Eigenvalues", "Geometry", "LU", "Cholesky", "QR", "SVD", "SparseCore", "SparseCholesky", "BVH"}

# Headers that the build writes; they belong to no module.
GENERATED = {"nereid_commit.hpp"}

# Headers without a test of their own, and why.
NEEDS_NO_TEST = {
    "lib/contact/connect.hpp": "tested by tests/contact/contact_test.cpp and those of its folders, which all begin with it",
    "lib/contact/data/interface.hpp": "data only",
    "lib/contact/data/memory.hpp": "data only",
    "lib/contact/data/initial_gaps.hpp": "data only",
    "lib/contact/data/shape.hpp": "data only, of shape_points.hpp",
    "lib/contact/search/shapes.hpp": "tested by tests/contact/multiplier/shape_points_test.cpp",
    "lib/contact/data/stencil.hpp": "data only",
    "lib/contact/data/tracks.hpp": "data only, of tracking.hpp",
    "lib/contact/data/workspace.hpp": "data only",
    "lib/contact/multiplier/assemble.hpp": "tested by tests/contact/multiplier/enforce_test.cpp: a part of its step",
    "lib/contact/multiplier/book.hpp": "the same",
    "lib/contact/multiplier/motion.hpp": "data only",
    "lib/element/weight.hpp": "tested by tests/element/fluid_test.cpp",
    "lib/material/j2_search.hpp": "tested by tests/material/law_test.cpp with each flow stress that it searches",
    "lib/output/dictionary.hpp": "tested by tests/drivers/keys.py: words of what runs write",
    "lib/material/ideal_gas.hpp": "tested by tests/material/fluid_test.cpp, as every law of fluids",
    "lib/material/linear_fluid.hpp": "the same",
    "lib/material/mie_gruneisen.hpp": "the same",
    "lib/contact/multiplier/over_facet.hpp": "tested by tests/contact/multiplier/condition_test.cpp",
    "lib/contact/multiplier/over_points.hpp": "tested by tests/contact/tracking/points_test.cpp and enforce_test.cpp",
    "lib/contact/multiplier/predict.hpp": "tested by tests/contact/multiplier/enforce_test.cpp: a part of its step",
    "lib/contact/multiplier/solve.hpp": "the same, and by rows_test.cpp",
    "lib/contact/multiplier/stages.hpp": "data only",
    "lib/contact/multiplier/stick.hpp": "tested by tests/contact/multiplier/enforce_test.cpp: a part of its step",
    "lib/contact/penalty/advance.hpp": "tested by tests/contact/contact_test.cpp",
    "lib/contact/report/account.hpp": "the same",
    "lib/contact/report/forces.hpp": "the same",
    "lib/contact/report/view.hpp": "the same",
    "lib/contact/search/edge_pairs.hpp": "tested by tests/contact/multiplier/crossing_test.cpp",
    "lib/contact/tracking/depth.hpp": "tested by tests/contact/contact_test.cpp",
    "lib/contact/tracking/edge_over_edge.hpp": "tested by tests/contact/multiplier/crossing_test.cpp",
    "lib/contact/tracking/thickness.hpp": "tested by tests/dynamics/thickness_test.cpp",
    "lib/contact/data/face_points.hpp": "data only, of points.hpp",
    "lib/model/remedies.hpp": "data only, each of which has two tests in tests/drivers/remedies.py",
    "lib/contact/tracking/element.hpp": "tested through contact.hpp, whose functions it stands behind",
    "lib/contact/data/method.hpp": "data only",
    "lib/contact/surface/bodies.hpp": "data only, made by dynamics/automatic.hpp",
    "lib/base/types.hpp": "names only",
    "lib/base/one_lane.hpp": "tested by scripts/prove, whose builds compile all tests with it",
    "lib/contact/data/pair_records.hpp": "tested by tests/model/probes_test.cpp, on whole bodies",
    "lib/dynamics/section.hpp": "the same",
    "lib/dynamics/balance.hpp": "tested by tests/dynamics/step_test.cpp: a part of the step",
    "lib/dynamics/forces.hpp": "the same",
    "lib/dynamics/kick.hpp": "the same",
    "lib/dynamics/touch.hpp": "the same",
    "lib/input/text_file.hpp": "tested by tests/input/section_test.cpp",
    "lib/base/step_limit.hpp": "one struct of two numbers",
    "lib/base/check.hpp": "two exception types and one line, used by every test of a fault",
    "lib/base/field.hpp": "data only",
    "lib/base/resolved.hpp": "data only",
    "lib/element/kernels.hpp": "tested through block.hpp, whose functions it stands behind",
    "lib/element/kernels_body.hpp": "the same",
    "lib/element/report.hpp": "data only",
    "lib/load/given.hpp": "names only",
    "lib/model/scene.hpp": "data only",
    "lib/material/laws.hpp": "names only",
    "lib/input/yaml.hpp": "tested through section",
    "lib/input/document.hpp": "tested through section",
    "lib/mesh/revolution.hpp": "tested through cylinder, tube and sphere",
}

WORDS_IN = "lib drivers cases tests verification scripts docs cmake .ci"
WORDS = [
    # pattern, what is wrong and what is expected
    (r"master|slave", "'{}': the words are apex and facet, or base surface"),
    (r"(?<![\w./-])/(work|farm|home|root|Users|mnt|media|scratch)/[\w.-]*",
     "'{}' is a path of one machine; paths start at the root of the tree"),
    (r"\b(deb\.debian\.org|archive\.ubuntu\.com|registry\.npmjs\.org|pypi\.org)\b",
     "'{}' is the host of a registry; the system's own settings choose it"),
    (r"\b(TODO|FIXME|XXX)\b(?!\s*\(?#\d+)", "'{}' without an issue; write it as TODO(#12), or do it"),
]
SAYS_THE_WORDS = {"scripts/house.py", "docs/notation.md"}   # this table, and the table of words
SAYS_BOTH = "secondary and primary"     # a line with this names the field's words for the two sides, once for all

WIDTH = 140
HAS_WIDTH = {".py", ".cpp", ".hpp", ".md", ".yaml", ".sh", ".cmake", ".txt"}  # and programs without ending that start with #!
# Lists of bad cases have the messages of programs, which repeat whole lines of cases.
ANY_WIDTH = ["tests/drivers/bad_cases/*"]

FIGURES = "figure_"  # what modules that draw begin with

# Where retired words stand by right: the table, what is tested with them, and the page that has the table of words.
SAYS_RETIRED = {"scripts/words.py", "scripts/update_case", "tests/scripts/update_case_test.py", "tests/scripts/words_test.py",
                "tests/scripts/house_test.py", "docs/notation.md", "lib/input/retired.cpp", "tests/input/retired_test.cpp"}


# ------------------------------------------------------------------------------------------------
# Reading the tree

class Tree:
    """The files below a root, and the faults found in them."""

    def __init__(self, root):
        self.root = Path(root)
        self.faults = []

    def fault(self, path, line, what):
        self.faults.append(f"{path}:{line}: {what}")

    def files(self, folders):
        """Paths below the folders, relative to the root, in a fixed order."""
        for folder in folders.split():
            for path in sorted((self.root / folder).rglob("*")):
                if path.is_file() and "__pycache__" not in path.parts:
                    yield path.relative_to(self.root).as_posix()

    def top(self):
        """Names of the files at the root; `.git` is one in a further working tree."""
        return sorted(path.name for path in self.root.iterdir() if path.is_file() and path.name != ".git")

    def lines(self, path):
        """(number, text) of each line; none if the file is not text."""
        try:
            text = (self.root / path).read_text(encoding="utf-8")
        except UnicodeDecodeError:
            return []
        return list(enumerate(text.splitlines(), start=1))

    def has(self, path):
        return (self.root / path).is_file()


def is_code(path):
    return Path(path).suffix in CODE


def is_python(tree, path):
    first = tree.lines(path)[:1]
    return path.endswith(".py") or (Path(path).suffix == "" and bool(first) and
                                    re.match(r"#!.*python", first[0][1]) is not None)


def module_table(tree):
    """Module -> (line, modules it rests on), from the nereid_module() lines of CMakeLists.txt."""
    table = {}
    for number, text in tree.lines("CMakeLists.txt"):
        found = re.match(r"\s*nereid_module\(\s*([^)#]*)\)", text)
        if found:
            name, *rest = found.group(1).split()
            below = rest[:rest.index("PRIVATE")] if "PRIVATE" in rest else rest
            table[name] = (number, below)
    return table


def module_of(path, table):
    """The module of a file below lib/: of folders in folders the innermost; None without any."""
    folders = path.split("/")[:-1]
    names = ["/".join(folders[:count]) for count in range(len(folders), 0, -1)]
    return next((name for name in names if name in table), None)


def everything_below(module, table):
    """The modules a module rests on, directly or through others."""
    reached, open_ends = set(), [module]
    while open_ends:
        _, below = table.get(open_ends.pop(), (0, []))
        open_ends += [name for name in below if name not in reached]
        reached |= set(below)
    return reached


# ------------------------------------------------------------------------------------------------
# The checks

def floors(tree):
    """Modules include only themselves and what they rest on."""
    if not tree.has("CMakeLists.txt"):
        tree.fault("CMakeLists.txt", 1, "is missing; it holds the table of modules")
        return
    table = module_table(tree)
    if not table:
        tree.fault("CMakeLists.txt", 1, "no nereid_module(...) line was found; they are the floors")
        return
    defined = set()
    for name, (number, below) in table.items():
        for other in below:
            if other not in defined:
                tree.fault("CMakeLists.txt", number, f"'{name}' rests on '{other}', which is not defined"
                           " above it; dependencies only go down")
        defined.add(name)

    for path in tree.files("lib"):
        if not is_code(path):
            continue
        module = module_of(path[len("lib/"):], table)
        if module is None:
            tree.fault(path, 1, f"stands in no module; expected is lib/<module>/, one of {', '.join(table)}")
            continue
        allowed = everything_below(module, table) | {module}
        for number, text in tree.lines(path):
            found = re.match(r'\s*#\s*include\s*(["<])([^">]+)[">]', text)
            if not found or found.group(2) in GENERATED:
                continue
            quoted, target = found.group(1) == '"', found.group(2)
            floor = module_of(target, table)
            if floor is None:
                if quoted:
                    tree.fault(path, number, f'"{target}" names no module; expected is "<module>/<file>"')
            elif floor not in allowed:
                tree.fault(path, number, f"'{module}' includes \"{target}\" but does not rest on '{floor}'; it "
                           f"rests on {', '.join(sorted(allowed - {module})) or 'nothing'}")
            elif not tree.has(f"lib/{target}"):
                tree.fault(path, number, f'"{target}" does not exist below lib/')


def doors(tree):
    """Each dependency enters through one file."""
    for name, pattern, folders, allowed in DOORS:
        of_python = name in ("matplotlib", "Python-Markdown")
        for path in tree.files(folders):
            if path in allowed or not (is_python(tree, path) if of_python else is_code(path)):
                continue
            for number, text in tree.lines(path):
                if re.search(pattern, text):
                    expected = f"its door is {allowed[0]}" if allowed else "it belongs in tests/"
                    tree.fault(path, number, f"{name} enters here; {expected}")
    for path in tree.files("lib"):
        if path == EIGEN_DOOR or not is_code(path):
            continue
        for number, text in tree.lines(path):
            found = re.match(r'\s*#\s*include\s*[<"](?:unsupported/)?Eigen/([^>"]*)[>"]', text)
            if found and not (path.endswith(".cpp") and found.group(1) in EIGEN_IN_SOURCES):
                tree.fault(path, number, f"<Eigen/{found.group(1)}> enters here; its door is {EIGEN_DOOR}, and a "
                           f".cpp may name parts of it ({', '.join(sorted(EIGEN_IN_SOURCES))})")


def words(tree):
    """Words, paths and open ends that must not stand in the tree."""
    top = tree.top()
    for path in [*top, *tree.files(WORDS_IN)]:
        if path in SAYS_THE_WORDS:
            continue
        for number, text in tree.lines(path):
            for pattern, message in WORDS:
                found = re.search(pattern, text, flags=re.IGNORECASE if "slave" in pattern else 0)
                if found and not ("slave" in pattern and SAYS_BOTH in text):
                    tree.fault(path, number, message.format(found.group(0)))


def links(tree):
    """Links of pages to files of the tree that do not exist."""
    for page in [path for path in [*tree.top(), *tree.files(WORDS_IN)] if path.endswith(".md")]:
        fenced = False
        for number, text in tree.lines(page):
            fenced = fenced != text.startswith("```")
            for link in [] if fenced else re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", re.sub(r"`[^`]*`", "", text)):
                target = os.path.normpath(os.path.join(os.path.dirname(page), link))
                if not re.match(r"[a-z]+:", link) and not (tree.root / target).exists():
                    tree.fault(page, number, f"links to {link}, which does not exist; expected is a file or folder of the tree")


def tested_file(test):
    """What a test stands for: (folder, stem, endings it may have)."""
    folder, stem = str(Path(test).parent)[len("tests/"):], re.sub(r"_test\.(cpp|py)$", "", Path(test).name)
    if folder == "scripts":
        return "scripts", stem, [".py", ""]
    if folder == "drivers":
        return "drivers", stem, [".cpp", ".hpp"]
    return f"lib/{folder}", stem, [".hpp", ".cpp"]


def mirror(tree):
    """Tests mirror lib/ file for file."""
    for test in tree.files("tests"):
        if re.search(r"_test\.(cpp|py)$", test):
            folder, stem, endings = tested_file(test)
            if not any(tree.has(f"{folder}/{stem}{ending}") for ending in endings):
                tree.fault(test, 1, f"tests nothing; expected is {folder}/{stem} with "
                           f"{' or '.join(ending or 'no ending' for ending in endings)}")
    for header in tree.files("lib"):
        if not header.endswith(".hpp"):
            continue
        test = re.sub(r"^lib/(.*)\.hpp$", r"tests/\1_test.cpp", header)
        if not tree.has(test) and header not in NEEDS_NO_TEST:
            tree.fault(header, 1, f"has no test; expected is {test}, or a reason in NEEDS_NO_TEST of scripts/house.py")
        if tree.has(test) and header in NEEDS_NO_TEST:
            tree.fault(header, 1, f"is excused from having a test but has {test}; take it off NEEDS_NO_TEST")
    for header in NEEDS_NO_TEST:
        if not tree.has(header):
            tree.fault(header, 1, "does not exist; take it off NEEDS_NO_TEST of scripts/house.py")


def may_be_long(path, text, in_table):
    """Lines of a page that cannot be broken: tables, pictures, addresses, and what scripts write."""
    return path.endswith(".md") and (in_table or text.lstrip().startswith(("|", "![")) or "://" in text)


def width(tree):
    """Lines have at most 140 characters."""
    top = tree.top()
    for path in [*top, *tree.files(WORDS_IN)]:
        if any(fnmatch.fnmatch(path, pattern) for pattern in ANY_WIDTH):
            continue
        lines = tree.lines(path)
        if Path(path).suffix not in HAS_WIDTH and not (Path(path).suffix == "" and lines[:1] and lines[0][1].startswith("#!")):
            continue
        written = False
        for number, text in lines:
            written = (written or text.startswith("<!-- written by")) and not text.startswith("<!-- end of")
            if len(text) > WIDTH and not may_be_long(path, text, written):
                tree.fault(path, number, f"has {len(text)} characters; expected are at most {WIDTH}")


def retired(tree):
    """Words of case files that have a new name stand nowhere any more."""
    if not table_of_words.RETIRED:
        return
    top = tree.top()
    compiled = [(one, re.compile(one.refuse or "(?!)"), [re.compile(place) for place in table_of_words.places(one)])
                for one in table_of_words.RENAMED]
    for path in [*top, *tree.files(WORDS_IN)]:
        if path in SAYS_RETIRED:
            continue
        for number, text in tree.lines(path):
            for one, refused, places in compiled:
                if refused.search(text) or one.old in text and any(place.search(text) for place in places):
                    tree.fault(path, number, f"'{one.old}' has a new name, '{one.new}'; scripts/update_case renames it in case files")


def imports_of(tree, path):
    """(line, module) of every import of a file of Python, those within functions too."""
    found = []
    try:
        parsed = ast.parse("\n".join(text for _, text in tree.lines(path)), path)
    except SyntaxError as error:
        tree.fault(path, error.lineno or 1, f"is no Python: {error.msg}")
        return found
    for node in ast.walk(parsed):
        if isinstance(node, ast.Import):
            found += [(node.lineno, one.name.split(".")[0]) for one in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            found.append((node.lineno, node.module.split(".")[0]))
    return sorted(found)


def way_back(path, below):
    """The shortest chain of imports from a file to itself; empty where there is none."""
    before, open_ends = {}, [path]
    for one in open_ends:
        for _, other in below[one]:
            if other == path:
                chain = [path, one]
                while chain[-1] != path:
                    chain.append(before[chain[-1]])
                return chain[::-1]
            if other not in before:
                before[other] = one
                open_ends.append(other)
    return []


def circles(tree):
    """No script imports itself by way of others; a figure takes data and imports no study."""
    programs = [path for path in tree.files("scripts") if is_python(tree, path)]
    of_name = {Path(path).stem: path for path in programs if path.endswith(".py")}
    below = {path: [(line, of_name[name]) for line, name in imports_of(tree, path) if name in of_name] for path in programs}
    told = set()
    for path in programs:
        chain = way_back(path, below)
        if chain and path not in told:
            told.update(chain)
            line = next(number for number, other in below[path] if other == chain[1])
            names = " -> ".join(Path(one).name for one in chain)
            tree.fault(path, line, f"imports itself: {names}; what both need belongs in a third file")
        for line, other in below[path] if Path(path).name.startswith(FIGURES) else []:
            if not Path(other).name.startswith(("figure.", FIGURES)):
                tree.fault(path, line, f"imports {Path(other).name}; a figure takes data and imports nothing of scripts/ but figures")


CHECKS = {"floors": floors, "doors": doors, "words": words, "mirror": mirror, "width": width, "links": links, "retired": retired,
          "circles": circles}


def main(arguments=None):
    parser = command_line.Parser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("check", choices=[*CHECKS, "all"])
    parser.add_argument("--root", type=command_line.folder_to_read, default=Path(__file__).resolve().parent.parent)
    options = parser.parse_args(arguments)
    tree = Tree(options.root)
    for name in CHECKS if options.check == "all" else [options.check]:
        CHECKS[name](tree)
    print(*tree.faults, sep="\n", end="\n" if tree.faults else "")
    return 1 if tree.faults else 0


if __name__ == "__main__":
    sys.exit(main())
