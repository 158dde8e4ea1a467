"""What programs say of themselves with --keys: every key, result, column and field, each described once, and pages that are up to date.

    python3 tests/drivers/keys.py DRIVERS               DRIVERS: the folder with the programs

A new key needs a line in drivers/meanings.cpp, a new result, column or field one in lib/output/dictionary.cpp; then `scripts/keys --write`.
Entries of the dictionary that no run of RUNS has stand in UNSEEN, each with its reason.
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

try:
    import yaml
except ImportError:
    print("this Python has no yaml (Debian's python3-yaml)")
    sys.exit(77)
try:
    import jsonschema
except ImportError:
    jsonschema = None

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
import keys_schema  # noqa: E402  (after the path)
from runs import PROGRAMS  # noqa: E402

PATIENCE = 300  # [s]
HERE = "tests/drivers/cases"

# (program, case, settings): short runs that together have every result, column and field.
RUNS = [
    ("scene", "cases/scene/ball_and_plates.yaml", ["time.end=0.02 ms", "output.fields=all"]),
    ("scene", "cases/scene/oblique.yaml", ["time.end=0.02 ms"]),
    ("scene", "cases/scene/taylor_bar.yaml", ["time.end=2 us"]),
    ("scene", "cases/scene/one_element.yaml", []),
    ("scene", f"{HERE}/all_results.yaml", []),
    ("two_blocks", "cases/two_blocks/bars.yaml", ["time.end=2 us"]),
    ("patch_test", "cases/patch_test/three_on_four.yaml", []),
    ("sliding", "cases/sliding/stop.yaml", ["contact.method=penalty"]),
    ("cask_drop", "cases/cask_drop/neptune.yaml", ["mesh.level=1", "time.end=0.1 ms"]),
    ("plug_juncture", "cases/plug_juncture/head.yaml", ["mesh.level=1", "time.end=1 ms"]),
    ("plug_juncture", "cases/plug_juncture/sodium.yaml", ["mesh.level=1", "time.end=0.1 ms"]),
    ("shield_plates", "cases/shield_plates/plates.yaml", ["mesh.level=1", "time.end=0.5 ms", "stack.rim=loose"]),
    ("slug_impact", "cases/slug_impact/bubble.yaml", ["mesh.level=1", "model.kind=sector", "time.end=1 ms"]),
    ("slug_impact", "cases/slug_impact/plate.yaml", ["mesh.level=1", "model.kind=sector", "time.end=0.1 ms", "gap.filled_with=gas",
                                                    "gap.gas.density=1.2 kg/m^3", "gap.gas.gamma=1.4", "gap.gas.pressure=0.1 MPa"]),
    ("modes", "cases/modes/square_plate.yaml", []),
    ("material_point", "cases/material_point/cycle.yaml", []),
    ("material_point", "cases/material_point/cycle.yaml", ["material.kind=neo_hookean"]),
    ("material_point", f"{HERE}/hot_point.yaml", []),
    ("contact_elements", "cases/contact_elements/random.yaml", []),
    ("penalty_oscillator", "cases/penalty_oscillator/bounce.yaml", []),
]
UNSEEN = {
    "FLAW": "a mesh with faults is refused: tests/drivers/bad_cases.py", "number": "the same", "mesh": "the same",
}

BY_CONTACT = {"cost.contact"}  # members of a summary that only runs with contact by multipliers have

# What capitals stand for, beside the names of a run.
WORDS = {"PLACE": "top|middle|bottom|membrane", "GAP": r"\d|head|plate_\d", "JUNCTURE": r"\d",
         "PLATE": r"\d|small|intermediate|large|plate_\d|slug|head|wall", "PART": "slug|head|wall", "COMPONENT": "xx|yy|zz|xy|yz|xz",
         "KIND": "tetrahedral|triangular|line", "N": r"\d+", "FIELD": r"\w+", "UNIT": r"[^\]]+", "FLAW": "inverted"}


class Loader(yaml.SafeLoader):
    """YAML as the programs read it: `on`, `off` and the like are words."""


Loader.yaml_implicit_resolvers = {first: [(tag, text) for tag, text in found if tag != "tag:yaml.org,2002:bool"]
                                  for first, found in yaml.SafeLoader.yaml_implicit_resolvers.items()}
Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(true|false)$"), list("tf"))


def read_yaml(text):
    return yaml.load(text, Loader)


def paths_of(value, at=""):
    """Paths of all keys of a case, as --keys names them."""
    if isinstance(value, dict):
        for key, inner in value.items():
            path = f"{at}.{key}" if at else key
            yield path
            yield from paths_of(inner, path)
    elif isinstance(value, list) and any(isinstance(item, dict) for item in value):
        for item in value:
            yield from paths_of(item, f"{at}[]")


def cases():
    """(program, file) of all cases of cases/: those in other folders than that of a program are scenes."""
    for path in sorted((ROOT / "cases").glob("*/*.yaml")):
        if path.parent.name != "cpp":
            yield path.parent.name if path.parent.name in PROGRAMS else "scene", path


def arrays_of(file):
    """(place, name) of each array of a frame."""
    places = {"PointData": "points", "CellData": "cells", "FieldData": "file"}
    for section in xml.parse(file).getroot().iter():
        if section.tag in places:
            yield from ((places[section.tag], array.get("Name")) for array in section)


def members_of(tree, known, at=()):
    """(path, the name in `known` that describes it, or None) of each member of a summary; what is described as a whole is one member."""
    for word, value in tree.items():
        path = (*at, word)
        entry = next((name for name in known if len(name.split(".")) == len(path)
                      and all(part == one or part.isupper() for part, one in zip(name.split("."), path))), None)
        if entry is None and isinstance(value, dict) and any(name.count(".") >= len(path) for name in known):
            yield from members_of(value, known, path)
        else:
            yield ".".join(path), entry


class Names:
    """Which entries describe a name of a run."""

    def __init__(self, summary, bodies):
        accounts = summary["ledger"]["accounts"]
        self.words = dict(WORDS)
        for word, kind in (("CONTACT", "interface"), ("PLANE", "rigid_plane")):
            self.words[word] = self.any_of(name for name, one in accounts.items() if one["kind"] == kind)
        for word, channels in (("SOURCE_STORE", "stored"), ("SOURCE_LOSS", "dissipated")):
            self.words[word] = self.any_of(f"{name}_{channel}" for name, one in accounts.items() for channel in one[channels])
        self.words["SOURCE"] = self.any_of(accounts)
        self.words["BODY"] = self.any_of({name for name, one in accounts.items() if one["kind"] == "block"} | bodies)
        resolved = summary["provenance"]["resolved"]
        for word, section in (("PROBE", "probes"), ("STAGE", "stages")):
            named = resolved.get(section, [])
            self.words[word] = self.any_of(one["name"]["value"] for one in named) if isinstance(named, list) else "(?!)"

    @staticmethod
    def any_of(names):
        return "|".join(sorted(map(re.escape, names), key=len, reverse=True)) or "(?!)"

    def fits(self, entry, name):
        text = entry["name"]
        parts = re.split(r"(SOURCE_STORE|SOURCE_LOSS|[A-Z]{3,}|\bN\b|(?<=_)N$)", text)
        return re.fullmatch("".join(f"({self.words[part]})" if part in self.words else re.escape(part) for part in parts), name)


class Keys(unittest.TestCase):
    drivers = None
    said = {}

    @classmethod
    def setUpClass(cls):
        cls.said = {program: json.loads(subprocess.run([cls.drivers / program, "--keys"], check=True, capture_output=True,
                                                       timeout=PATIENCE).stdout) for program in PROGRAMS}

    def every_key(self):
        for program, said in self.said.items():
            for key in said["keys"]:
                yield program, key

    def test_every_key_has_a_meaning_and_an_example(self):
        for program, key in self.every_key():
            with self.subTest(program=program, key=key["path"]):
                self.assertIn("meaning", key, "expected is a line in drivers/meanings.cpp")
                self.assertRegex(key["meaning"], r"^[A-Z].*[^.]\.$")
                example = read_yaml(key["example"])
                self.assertEqual(list(example), [key["path"].rsplit(".", 1)[-1]])
                self.assertNotRegex(key["meaning"], r"(?i)\bwho\b")

    @unittest.skipIf(jsonschema is None, "this Python has no jsonschema (Debian's python3-jsonschema)")
    def test_every_example_is_valid(self):
        schemas = {program: keys_schema.section(said["keys"], "") for program, said in self.said.items()}
        for program, key in self.every_key():
            here = schemas[program]
            for word in key["path"].replace("[]", "").split(".")[:-1]:
                here = here["properties"][word]
                here = here.get("items", here)
            example = read_yaml(key["example"])
            with self.subTest(program=program, key=key["path"]):
                name = key["path"].rsplit(".", 1)[-1]
                jsonschema.Draft7Validator(here["properties"][name]).validate(example[name])

    def test_every_meaning_is_that_of_a_key(self):
        paths = {(program, key["path"]): key["meaning"] for program, key in self.every_key()}
        text = (ROOT / "drivers/meanings.cpp").read_text(encoding="utf-8")
        entries = re.findall(r'^      \{"([^"]+)",\s*"((?:[^"\\]|\\.)*)"', text, re.MULTILINE)
        self.assertGreater(len(entries), 200)
        self.assertEqual(len({path for path, _ in entries}), len(entries), "a path stands twice")
        for entry, begin in entries:
            used = any(f"{program}:{path}" == entry or (f".{path}").endswith(f".{entry}") and meaning.startswith(begin.replace('\\"', '"'))
                       for (program, path), meaning in paths.items())
            self.assertTrue(used, f"no key has the meaning of '{entry}'")

    def test_every_key_of_a_case_is_known(self):
        known = {program: {key["path"] for key in said["keys"]} for program, said in self.said.items()}
        for program, path in cases():
            with self.subTest(case=path.relative_to(ROOT).as_posix()):
                self.assertEqual(set(paths_of(read_yaml(path.read_text(encoding="utf-8")))) - known[program], set())

    @unittest.skipIf(jsonschema is None, "this Python has no jsonschema (Debian's python3-jsonschema)")
    def test_every_case_fits_its_schema(self):
        schemas = {program: json.loads(keys_schema.text(said)) for program, said in self.said.items()}
        for schema in schemas.values():
            jsonschema.Draft7Validator.check_schema(schema)
        for program, path in cases():
            with self.subTest(case=path.relative_to(ROOT).as_posix()):
                jsonschema.Draft7Validator(schemas[program]).validate(read_yaml(path.read_text(encoding="utf-8")))

    @unittest.skipIf(jsonschema is None, "this Python has no jsonschema (Debian's python3-jsonschema)")
    def test_a_schema_refuses_what_the_reader_refuses(self):
        check = jsonschema.Draft7Validator(json.loads(keys_schema.text(self.said["scene"])))
        case = (ROOT / "cases/scene/taylor_bar.yaml").read_text(encoding="utf-8")
        self.assertTrue(check.is_valid(read_yaml(case)))
        for change in ({"bodies": None}, {"bodies": []}, {"tim": {}}, {"time": {"end": 1}}, {"time": {"end": "1 ms", "safety": 20}},
                       {"time": {"end": "1 ms", "safety": "a"}}, {"output": {"fields": "al"}}, {"gravity": ["0 m/s^2", "0 m/s^2"]},
                       {"planes": [{"name": "p", "kind": "floor", "nodes": ["bar"], "normal": [0, 0, 1]}]}):
            changed = {**read_yaml(case), **change}
            changed = {key: value for key, value in changed.items() if value is not None}
            with self.subTest(change=change):
                self.assertFalse(check.is_valid(changed))

    def test_pages_and_schemas_are_up_to_date(self):
        done = subprocess.run([sys.executable, ROOT / "scripts/keys", "--drivers", self.drivers], capture_output=True, text=True,
                              timeout=PATIENCE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def of_run(self, program, case, settings, out):
        """Checks one run; (list, entry) of what it has."""
        sets = [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run([self.drivers / program, ROOT / case, "--out", out, "--quiet", *sets], capture_output=True, text=True,
                              timeout=PATIENCE)
        self.assertIn(done.returncode, (0, 3), done.stderr)
        summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
        named = summary["provenance"]["resolved"].get("bodies", [])
        names, said = Names(summary, {one["name"]["value"] for one in named}), self.said[program]
        columns = (out / "history.csv").read_text(encoding="utf-8").splitlines()[0].split(",")
        told = [("results", name, one["unit"], None) for name, one in summary["results"].items()]
        told += [("columns", *re.fullmatch(r"(.*) \[(.*)\](?: mean)?", column).groups(), None) for column in columns]
        for file in sorted([*out.glob("*/*_000000.vtu"), *out.glob("*/*_000000.vtp")]):
            told += [("fields", name, None, f"{file.parent.name}, {place}") for place, name in set(arrays_of(file))]
        seen = set()
        for what, name, unit, of in told:
            found = [entry for entry in said[what] if names.fits(entry, name) and
                     (of is None or entry["of"] in (of, "all, " + of.split(", ")[1]))]
            if of is not None and len(found) > 1:  # an array that is called like a body is no field
                found = [entry for entry in found if entry["name"] != "BODY"]
            self.assertEqual(len(found), 1, f"{what}: {name} has the entries {[entry['name'] for entry in found]}")
            if unit is not None and found[0]["unit"]:
                self.assertEqual(found[0]["unit"], unit, name)
            seen.add((what, found[0]["name"], found[0].get("of")))
        known = {entry["name"] for entry in said["summary"]}
        there = dict(members_of(summary, known))
        self.assertEqual([path for path, entry in there.items() if entry is None], [], "members of the summary without a description")
        always = {name for name in known if not any(part.isupper() for part in name.split("."))} - BY_CONTACT
        self.assertEqual(always - set(there.values()), set(), "the summary does not have these members")
        return seen | {("summary", entry, None) for entry in there.values()}

    def test_every_result_column_and_field_is_described_once(self):
        seen = set()
        with tempfile.TemporaryDirectory() as folder:
            for number, (program, case, settings) in enumerate(RUNS):
                with self.subTest(program=program, case=case):
                    seen |= self.of_run(program, case, settings, Path(folder) / str(number))
        every = {(what, entry["name"], entry.get("of")) for said in self.said.values()
                 for what in ("results", "columns", "fields", "summary") for entry in said[what]}
        left = {name for _, name, _ in every - seen}
        self.assertEqual(left - set(UNSEEN), set(), "no run of RUNS has these")
        self.assertEqual(set(UNSEEN) - left, set(), "runs have these: they need no reason")


if __name__ == "__main__":
    Keys.drivers = Path(sys.argv.pop(1)).resolve()
    unittest.main()
