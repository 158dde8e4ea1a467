"""scripts/trade --vary with a driver that is made up here: its depth is load / stiffness + gap + 0.4/cells^2, and `spare` is not used."""
import contextlib
import importlib.util
import io
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
try:
    import sensitivity  # noqa: F401  (needs numpy)
    import yaml  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
trade = made_up.script("trade")
import trade_vary as vary  # noqa: E402

HAS_SCIPY = importlib.util.find_spec("scipy") is not None

DRIVER = """#!{python}
import json
import sys
from pathlib import Path
KEYS = {{"load": 2.0, "bodies[0].stiffness": 20.0, "gap": 0.0, "mesh.cells": 4, "spare": 1, "speed": 1}}
for i, word in enumerate(sys.argv):
    if word == "--set":
        key, text = sys.argv[i + 1].split("=", 1)
        if key not in KEYS:
            print(f"--set {{key}}:1: unknown key '{{key}}'", file=sys.stderr)
            sys.exit(2)
        KEYS[key] = float(text.split(" ")[0])
        if key == "gap" and KEYS[key] < 0:
            print("--set gap:1: 'gap' is out of range: expected gap >= 0", file=sys.stderr)
            sys.exit(2)
        if key == "spare" and "--dry-run" in sys.argv:
            print("not used: spare (--set spare=1:3)")
if "--dry-run" in sys.argv:
    sys.exit(0)
count = Path({count!r})
count.write_text(str(int(count.read_text()) + 1))
out = Path(sys.argv[sys.argv.index("--out") + 1])
depth = KEYS["load"] / KEYS["bodies[0].stiffness"] + KEYS["gap"] + 0.4 / KEYS["mesh.cells"]**2
(out / "history.csv").write_text("time [s],depth [m]\\n0,0\\n1,1\\n")
resolved = {{"mesh": {{"cells": {{"value": int(KEYS["mesh.cells"]), "unit": "1", "default": False}}}}}}
word = "body_inverted" if KEYS["gap"] > 0.15 else "reached_end"
(out / "summary.json").write_text(json.dumps({{"ending": {{"word": word}}, "results": {{"depth": {{"value": depth, "unit": "m"}}}},
    "provenance": {{"resolved": resolved}}}}))
"""


class VaryTest(unittest.TestCase):
    def setUp(self):
        self.root = made_up.folder(self, "mesh: {cells: 4}\nload: 2 kN\nbodies: [{stiffness: 20 kN/m}]\ngap: 0 m\nspare: 1\n"
                                         "speed: 1 m/s\n")
        self.count = self.root / "count"
        made_up.driver(self.root, "scene", DRIVER)

    def options(self, *words):
        return trade.options_of([str(self.root / "case.yaml"), "--result", "depth", "--drivers", str(self.root / "drivers"), "--out",
                                 str(self.root / "out"), "--jobs", "1", "--finest", "1,2,4", *words])

    def sweep(self, *words):
        options = self.options(*words)
        return trade.Sweep(trade.of_file(options), options)

    def input(self, word, *words):
        one = self.sweep("--vary", word, *words)
        return vary.inputs_of([word], one.of, one.options.drivers)[0]

    def test_words_give_ends_in_the_unit_of_the_case(self):
        for word, expected in (("load=±10%", (1.8, 2.2, "kN")), ("load=+-0.5 kN", (1.5, 2.5, "kN")),
                               ("bodies[0].stiffness=±5%", (19.0, 21.0, "kN/m")), ("gap=0..0.1 m", (0.0, 0.1, "m")),
                               ("gap = 1e-3 .. 2.5e-3 m", (1e-3, 2.5e-3, "m")), ("mesh.cells=±1", (3.0, 5.0, ""))):
            with self.subTest(word):
                one = self.input(word)
                self.assertEqual((round(one.low, 12), round(one.high, 12), one.unit), expected)

    def test_what_cannot_be_varied_is_told_before_the_first_run(self):
        for word, expected in (("load", "is no input: expected is KEY=±10%"), ("load=10%", "is no input"), ("=1..2", "is no input"),
                               ("lod=±10%", "(?s)refused.*unknown key 'lod'"), ("load=±1 N", "expected is ±A kN, or LOW..HIGH"),
                               ("gap=±10%", "are not apart"), ("gap=3..2 m", "LOW < HIGH"), ("gap=-1..1 m", "(?s)refused.*gap >= 0"),
                               ("spare=1..2", "not used by this case")):
            with self.subTest(word), self.assertRaisesRegex(vary.NoInput, expected):
                self.input(word)
        with self.assertRaisesRegex(vary.NoInput, "varied twice"):
            one = self.sweep("--vary", "load=±1%")
            vary.inputs_of(["load=±1%", "load=±2%"], one.of, one.options.drivers)
        self.assertEqual(self.count.read_text(), "0")

    def test_a_key_that_the_case_does_not_say_needs_both_ends(self):
        (self.root / "case.yaml").write_text("mesh: {cells: 4}\n")
        with self.assertRaisesRegex(vary.NoInput, "does not say 'load'.*expected is load=LOW..HIGH"):
            self.input("load=±10%")

    def test_the_middle_is_what_is_set_beside_it(self):
        options = self.options("--vary", "load=±10%", "--set", "load=4 kN")
        definition = trade.of_file(options)
        definition.change = dict(options.set)
        self.assertEqual(vary.inputs_of(options.vary, definition, options.drivers)[0].low, 3.6)

    @unittest.skipUnless(HAS_SCIPY, "no SciPy")
    def test_points_are_the_same_for_the_same_seed_and_more_have_the_first_in_them(self):
        few, more = (vary.points_of(3, number, "sobol", 1) for number in (16, 30))
        self.assertEqual((few.shape, more.shape), ((16, 3), (32, 3)))
        self.assertTrue((few == more[:16]).all() and abs(more).max() <= 1)
        self.assertFalse((vary.points_of(3, 16, "sobol", 2) == few).all())
        latin = vary.points_of(2, 10, "latin", 1)
        self.assertEqual(sorted(((latin[:, 0] + 1) * 5).astype(int)), list(range(10)))
        with self.assertRaisesRegex(vary.NoInput, "--points 3 is too few for 3 inputs: expected are 6 or more"):
            vary.points_of(3, 3, "sobol", 1)

    @unittest.skipUnless(HAS_SCIPY, "no SciPy")
    def test_mean_spread_and_shares_beside_the_error_of_the_mesh(self):
        words = ["load=±10%", "gap=0..0.01 m"]
        one = self.sweep("--points", "16", "--vary", *words)
        inputs, rows, studies = vary.study(one, words, trade.runs_of)
        found = studies[0].found
        self.assertEqual((studies[0].unit, len(rows)), ("mm", 16))
        self.assertAlmostEqual(found.mean.value, 100 + 5 + 25, delta=1e-6)
        self.assertAlmostEqual(found.change[0].value, 20, delta=1e-6)
        self.assertAlmostEqual(found.share[0].value, 0.8, delta=1e-6)  # 20^2 beside 10^2
        self.assertAlmostEqual(studies[0].numerical, 25, delta=1)  # of four cells: 0.4 / 4^2 m
        text = vary.page_of(inputs, rows, studies, "x.svg")
        for part in ("16 of 16 runs have a result.", "| `load` | 1.8 | 2.2 kN | 80.0 ± 0.0 % | 20 |", "observed order 2.00"):
            self.assertIn(part, text)

    @unittest.skipUnless(HAS_SCIPY, "no SciPy")
    def test_runs_that_stop_are_left_out_and_told_and_runs_are_found_again(self):
        page = self.root / "page.md"
        page.write_text("a\n<!-- written by scripts/trade --vary, case_vary -->\nold\n"
                        "<!-- end of what scripts/trade --vary, case_vary, writes -->\nb\n")
        (self.root / "figures").mkdir()
        words = ["gap=0.1..0.2 m", "load=±10%"]
        for _ in range(2):
            before = int(self.count.read_text())
            one = self.sweep("--points", "16", "--into", str(page), "--vary", *words)
            with contextlib.redirect_stdout(io.StringIO()):
                vary.write(one, words, trade.runs_of)
        self.assertEqual(int(self.count.read_text()), before)
        text = page.read_text()
        self.assertIn("8 of 16 runs have a result; 8 stopped: body_inverted. Those without are left out", text)
        self.assertTrue(text.startswith("a\n") and text.endswith("b\n") and "old" not in text)
        self.assertTrue((self.root / "figures/case_vary.svg").is_file())
        self.assertEqual(len((self.root / "out/case_vary.csv").read_text().splitlines()), 17)
        page.write_text("no markers")
        with self.assertRaisesRegex(trade.CannotRun, "the page has no"):
            vary.write(one, words, trade.runs_of)


if __name__ == "__main__":
    unittest.main()
