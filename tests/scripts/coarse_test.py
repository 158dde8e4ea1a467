"""Tests of scripts/coarse: which scenes are drawn, what is measured, how limits are chosen, and a whole command with a made-up driver."""
import contextlib
import doctest
import io
import math
import re
import sys
import types
import unittest
from pathlib import Path
from unittest import mock

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
try:
    import numpy as np
    import yaml  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

coarse = made_up.script("coarse")
scenes = coarse.scenes

# A program whose results of every third scene, which it warns of, change by a tenth and more from one mesh to the next.
DRIVER = """#!{python}
import json, re, sys
from pathlib import Path
open("{count}", "a").write("+")
text, out, refine = open(sys.argv[1]).read(), Path(sys.argv[sys.argv.index("--out") + 1]), float(sys.argv[-1].split("=")[1])
number = int(re.search(r"# Scene (\\d+)", text)[1])
bad = number % 3 == 0
value = 1 + (1.0 if bad else 0.01) / refine
results, columns = {{}}, {{"time": [0, 1e-3, 2e-3]}}
for name in re.findall(r"- name: (\\w+)\\n  quantity:", text):
    columns[name] = [-1.0, 0.0, value] if name.startswith("momentum") else [0.5, 0.0, 0.25 / value]
    results |= {{name + "_largest": value, name + "_smallest": 0.0}}
results |= {{"hourglass_above_neighbours": 0.1 if bad else 0.001 * (number + 1), "strain_energy_concentration": 0.5 if bad else 0.1,
            "viscous_share": 0.01, "contact_effective_nodes": 2.0 if bad else 9.0, "a_hourglass_fraction": 0.1}}
out.mkdir()
rows = [[name + " [-]" for name in columns], *zip(*columns.values())]
(out / "history.csv").write_text("".join(",".join(map(str, row)) + "\\n" for row in rows))
(out / "summary.json").write_text(json.dumps({{"ending": {{"word": "inverted_element" if number == 5 else "reached_end"}},
    "results": {{name: {{"value": value, "unit": "1"}} for name, value in results.items()}}, "cost": {{"elements": 64, "steps": 9}},
    "notes": ["note: a: hourglass energy above that of the neighbours is 0.1 of the strain energy of all solids"] if number == 1 else []}}))
if bad:
    print("warning: a: 0.5 of the strain energy of all solids is concentrated in single elements", file=sys.stderr)
sys.exit(3 if number == 5 else 0)
"""


class Scenes(unittest.TestCase):
    def test_examples(self):
        self.assertEqual(doctest.testmod(scenes).failed, 0)
        self.assertEqual(doctest.testmod(coarse).failed, 0)

    def test_keep_to_their_rules(self):
        for number in range(130):
            scene = scenes.draw(1, number)
            self.assertEqual(scene.family, scenes.SOLIDS[number % 13])
            self.assertIn(scene.main, scenes.RESULTS)
            for body in scene.case["bodies"]:
                counts = body["mesh"].get("cells", [body["mesh"].get("cells_core", 2)])
                self.assertTrue(min(counts) >= 2 or body.get("rigid"), "one cell stays one")
                self.assertNotIn("element", body, "numerics are the defaults")
            self.assertTrue({"time", "bodies", "probes"} <= set(scene.case))
            self.assertEqual(set(scene.case["time"]), {"end"})
            self.assertNotIn("output", scene.case)

    def test_strikers_begin_above_what_they_strike(self):
        for number in range(100):
            scene = scenes.draw(3, number, ("corner", "edge", "flat"))
            body = scene.case["bodies"][0]
            sides = [2 * float(text.split()[0]) for text in body["mesh"]["high"]]
            turned = (body["rotate"]["axis"], float(body["rotate"]["angle"].split()[0])) if "rotate" in body else None
            lowest = float(body["move"][2].split()[0]) - scenes.reach(sides, turned, (0, 0, -1))
            self.assertAlmostEqual(lowest / max(sides), scenes.GAP, places=6)

    def test_leaning_cells_keep_their_faces(self):
        body = scenes.block("a", (0.2, 0.1, 0.1), (2, 2, 2), scenes.STEEL, lean=(0.3, 0))
        expression = body["mesh"]["map"][0].replace("^", "**")
        for x, z, moved in ((0.1, 0.05, 0.1), (-0.1, 0.05, -0.1), (0, 0.05, 0.03), (0, -0.05, -0.03)):
            self.assertAlmostEqual(eval(expression, {"x": x, "z": z}), moved)


class Measured(unittest.TestCase):
    def test_a_bounce(self):
        scene = scenes.Scene("flat", {}, "speed", speed=2.0, own=2.0, size=0.1, transit=0.5)
        columns = {"time": [0.0, 1.0, 2.0, 3.0], "momentum_x": [0, 0, 0, 0], "momentum_y": [0, 0, 0, 0], "momentum_z": [-4, -4, 2, 2],
                   "spin_x": [0, 0, 0, 1], "spin_y": [0, 0, 0, 0], "spin_z": [0, 0, 0, 0]}
        found = scenes.measure(scene, columns, {"plastic_strain_a_largest": 0.1})
        self.assertEqual(found["speed"], [0, 0, 0.5])
        self.assertEqual((found["impulse"], found["peak force"]), (1.5, 6))
        self.assertEqual(found["spin"], [0.05, 0, 0])
        self.assertEqual(found["plastic strain"], 0.1)

    def test_changes(self):
        self.assertAlmostEqual(scenes.change("speed", {"speed": [0, 0, 0.5]}, {"speed": [0, 0, 0.4]}), 0.1)
        self.assertAlmostEqual(scenes.change("deflection", {"deflection": 1.1}, {"deflection": 1.0}), 0.1)
        self.assertAlmostEqual(scenes.change("spin", {"spin": [0.01, 0, 0]}, {"spin": [0, 0, 0]}), 0.2)
        self.assertIsNone(scenes.change("plastic strain", {"plastic strain": 0.1}, {"plastic strain": 0.0}))
        self.assertIsNone(scenes.change("length", {}, {"length": 1.0}))

    def test_words_of_the_program(self):
        def word(warnings=(), notes=()):
            return coarse.word_of_program({"warnings": warnings, "notes": notes})
        source = re.sub(r'"\s*\n\s*"', "", (SCRIPTS.parent / "lib/model/notes.cpp").read_text(encoding="utf-8"))
        spread, single, plates = ("hourglass energy above that of the neighbours is %.3g of the strain energy of all solids",
                                  "%.3g of the strain energy of all solids is concentrated in single elements",
                                  "one run cannot estimate the error of a mesh of plates")
        self.assertEqual([words for words in (spread, single, plates) if words not in source], [])
        self.assertEqual(word([f"warning: a: bodies of the scene deform plastically, and {single}"], [f"note: a: {plates}"]), "warning")
        self.assertEqual(word(["warning: contact: its apexes are 2 times as far apart"], [f"note: a: {spread}"]), "note")
        self.assertEqual(word((), [f"note: sheet: {plates}"]), "note")
        self.assertEqual(word((), ["note: plastic_strain_a: the largest plastic strain depends on the mesh"]), "nothing")
        self.assertEqual(word(), "nothing")

    def test_limits_of_the_program_are_those_of_the_page(self):
        source, page = (path.read_text(encoding="utf-8") for path in (SCRIPTS.parent / "lib/model/notes.cpp", coarse.PAGE))

        def constant(name):
            return re.search(rf"constexpr double [^;]*?\b{name} = ([0-9.]+)", source)[1]
        self.assertIn(f"*H* ≤ {constant('bending_worth_a_note')} |", page)
        self.assertIn(f"*J* where bodies flow > {constant('concentration_worth_a_warning')} |", page)
        self.assertEqual(float(constant("flow")), coarse.FLOW)
        self.assertEqual(int(constant("nodes_worth_no_note")), coarse.FEW_NODES)
        shares = {word: [float(share) for share in re.findall(rf"^\| {word} \| [^|]+ \| \w+ \| \d+ \| ([0-9.]+) \|", page, re.M)]
                  for word in ("note", "warning")}
        for word, name in (("note", "of_noted"), ("warning", "of_warned")):
            said = float(constant(name)) / 100
            self.assertTrue(min(shares[word]) - 0.03 <= said <= max(shares[word]) + 0.03, (word, said, shares[word]))

    def test_contact_nodes(self):
        nodes = coarse.MEASURES["nodes"][1]
        self.assertEqual(nodes({"wall_effective_nodes": 4.0, "contact_effective_nodes": 2.0}), 0.5)
        self.assertIsNone(nodes({"a_hourglass_fraction": 1.0}))


def made(h, j, change, viscous=0.0, number=0):
    """What a pair of runs with these measures and this change is to the choice of limits."""
    measures = {name: None for name in coarse.MEASURES} | {"H": h, "J": j, "viscous": viscous}
    return types.SimpleNamespace(measures=measures, main=change, scene=types.SimpleNamespace(family="flat", number=number))


class Limits(unittest.TestCase):
    def test_words(self):
        limits = coarse.Limits(0.03, "J", 0.4)
        self.assertEqual(limits.word(made(0.01, 0.1, 0).measures), "nothing")
        self.assertEqual(limits.word(made(0.04, 0.1, 0).measures), "note")
        self.assertEqual(limits.word(made(0.01, 0.5, 0).measures), "warning")
        self.assertEqual(limits.word(made(None, None, 0).measures), "nothing")
        self.assertEqual(coarse.Limits().word(made(0.01, 0.5, 0).measures), "note")

    def test_limits_keep_what_they_promise(self):
        pairs = [made(0.001 * n, 0.5 if n >= 80 else 0.2, 0.01 if n < 50 else 0.02 if n % 2 else 0.2) for n in range(80)]
        pairs += [made(0.2, 0.5 + 0.01 * n, 0.3) for n in range(20)]
        found = coarse.choose(pairs)
        self.assertEqual(found.measure, "H")  # the first of two that are as good
        self.assertLess(found.warned, 0.2)
        words = [found.word(pair.measures) for pair in pairs]
        warned = [pair.main for pair, word in zip(pairs, words) if word == "warning"]
        silent = [pair.main for pair, word in zip(pairs, words) if word == "nothing"]
        self.assertLessEqual(len(warned), 20)
        self.assertGreaterEqual(sum(change > 0.05 for change in warned), 0.7 * len(warned))
        self.assertGreaterEqual(sum(change <= 0.05 for change in silent), 0.9 * len(silent))
        self.assertEqual(len(silent), 40)  # those up to the median of the scenes that are not warned

    def test_no_limit_where_none_keeps_it(self):
        found = coarse.choose([made(0.01 * n, 0.01 * n, 0.2 if n % 3 == 0 else 0.01) for n in range(60)])
        self.assertEqual((found.silent, found.warned), (None, None))

    def test_ranking(self):
        self.assertEqual(coarse.auc([None, 1, 2], [True, False, True]), 1)
        self.assertIsNone(coarse.auc([1, 2], [True, True]))


class Command(unittest.TestCase):
    def run_it(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            status = coarse.main([*words, "--drivers", str(self.root / "drivers"), "--out", str(self.root / "out")])
        return status, said.getvalue()

    def setUp(self):
        self.root = made_up.folder(self, "")
        made_up.driver(self.root, "scene", DRIVER)

    def runs(self):
        return (self.root / "count").read_text().count("+")

    def test_scenes_are_run_once_and_judged(self):
        few = ["--scenes", "8", "--confirm", "3", "--plates", "3"]
        with mock.patch.multiple(coarse, FOURS=2, FEWEST=1, MOST_WARNED=0.5):
            status, said = self.run_it(*few, "--jobs", "2")
            self.assertEqual(status, 0, said)
            self.assertEqual(self.runs(), 2 * 14 + 3 + 1 + 2)
            self.assertIn("| warning | *H* > 0.00", said)
            self.assertIn("| warning |  | test | 1 | 1.00 | 1.00 |", said)
            self.assertIn("| note |  | calibration | 1 | 0.00 | 0.00 |", said)
            self.assertIn("left out", said)
            page = self.root / "page.md"
            page.write_text(f"before\n{coarse.BEGIN}\nold\n{coarse.END}\nafter\n", encoding="utf-8")
            with mock.patch.object(coarse, "PAGE", page), mock.patch.object(coarse, "ROOT", self.root):
                self.assertEqual(self.run_it(*few, "--limits", "--write")[0], 0)
            self.assertEqual(self.runs(), 2 * 14 + 3 + 1 + 2)
            written = page.read_text(encoding="utf-8")
            self.assertIn("### Families", written)
            self.assertNotIn("old", written)
            self.assertTrue(written.startswith("before") and written.endswith("after\n"))

    def test_a_program_that_fails(self):
        made_up.driver(self.root, "scene", "#!{python}\nimport sys\nsys.exit(4)\n")
        self.assertEqual(self.run_it("--scenes", "2", "--confirm", "1", "--plates", "1")[0], 3)

    def test_a_case_is_shown(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(coarse.main(["--show", "4"]), 0)
        self.assertIn("# Scene 4 of scripts/coarse: bar end", said.getvalue())


class Peak(unittest.TestCase):
    def test_is_a_mean_over_the_window(self):
        times, momentum = np.linspace(0, 1, 101), np.array([np.minimum(np.linspace(0, 1, 101) * 10, 1.0)])
        self.assertTrue(math.isclose(scenes.peak_force(times, momentum, 0.05), 10, rel_tol=1e-6))
        self.assertTrue(math.isclose(scenes.peak_force(times, momentum, 0.2), 5, rel_tol=1e-6))


if __name__ == "__main__":
    unittest.main()
