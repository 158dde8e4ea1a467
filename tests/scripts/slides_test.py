"""Tests of scripts/slides: which slides are drawn, what the judge says of exact histories and wrong ones, and a whole command with a
made-up driver."""
import contextlib
import dataclasses
import doctest
import io
import math
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
slides = made_up.script("slides")
import slide_judge as judge  # noqa: E402
import slide_scenes as scenes  # noqa: E402

SEED = 3

# A program that writes the exact history of a slide whose number is in its case; by the contact `two` the friction is twice as large.
DRIVER = """#!{python}
import csv, re, sys
sys.path[:0] = ["{scripts}", "{tests}"]
sys.dont_write_bytecode = True
import slides_test as test
open("{count}", "a").write("+")
text, out = open(sys.argv[1]).read(), test.Path(sys.argv[sys.argv.index("--out") + 1])
number, moves, contact = re.match(r"# Slide (\\d+)(f?) of scripts/slides, (\\w+)", text).groups()
slide = test.scenes.draw(test.SEED, int(number))
slide = slide if slide.moves == ("floor" if moves else "block") else slide.other()
out.mkdir()
with (out / "history.csv").open("w", newline="") as stream:
    columns = test.exact(slide, 2.0 if contact == "two" else 1.0)
    csv.writer(stream).writerows([[name + " [-]" for name in columns], *zip(*columns.values())])
"""


def exact(slide, more=1.0, thrown=0.0, aside=0.0):
    """The history of a slide whose friction is so many times the right one, which is thrown up at so many metres a second, or drifts aside
    at that part of its speed."""
    times = [slide.end * i / 200 for i in range(201)]
    mass, (hx, hy) = judge.mass_of(slide), slide.heading()
    weight = slide.load * (mass if slide.drive == "free" else slide.length[0] * slide.length[1])
    grown = [(u**3 - u**4 / 2 if u < 1 else u - 0.5) * slide.ramp for u in (t / slide.ramp for t in times)]
    normal = [weight * g for g in grown]
    lost = [more * slide.friction * n for n in normal]
    ground = 0.0 if slide.moves == "block" else -slide.speed
    speeds = [ground + slide.speed - (f / mass if slide.drive == "free" else 0) for f in lost]
    ways = [0.0]
    for i in range(1, len(times)):
        ways.append(ways[-1] + (speeds[i - 1] + speeds[i]) / 2 * (times[i] - times[i - 1]))
    columns = {"time": times, "momentum_z": [0.0] * 201, "weight_x": [0.0] * 201, "weight_y": [0.0] * 201,
               "weight_z": [-n for n in normal], "rise": [thrown * t for t in times]}
    for c, h, across in (("x", hx, -hy), ("y", hy, hx)):
        columns[f"momentum_{c}"] = [mass * v * h for v in speeds]
        columns[f"sole_{c}"] = [w * h + aside * slide.speed * t * across for w, t in zip(ways, times)]
        columns[f"floor_{c}"] = [ground * t * h for t in times]
        if slide.drive != "free":
            columns[f"drive_{c}"] = [f * h for f in lost]
    return columns


def some(drive, kind="rigid"):
    """A slide with friction of this drive and kind."""
    drawn = (scenes.draw(SEED, number) for number in range(1000))
    return next(slide for slide in drawn if (slide.drive, slide.kind) == (drive, kind) and slide.friction > 0.1)


class Scenes(unittest.TestCase):
    def test_examples(self):
        self.assertEqual(doctest.testmod(scenes).failed, 0)

    def test_keep_to_their_rules(self):
        for number in range(300):
            slide = scenes.draw(SEED, number)
            arm = slide.length[2] * (1 if slide.drive == "top" else 0.5)
            self.assertLessEqual(slide.friction * arm, 1.01 * scenes.LEAN * min(slide.length[:2]))
            self.assertLessEqual(slide.gap, 1e-3 * slide.cell())
            self.assertGreater(slide.speed * (slide.end - slide.settled), 2 * slide.floor_cell)
            self.assertLessEqual(max(n for _, _, n in scenes.floor_extent(slide)), scenes.MOST_CELLS)
            if slide.drive == "free":
                lost = slide.friction * scenes.GRAVITY * (slide.end - slide.ramp / 2)
                self.assertLessEqual(lost, (1 - scenes.KEPT + 1e-3) * slide.speed)

    def test_the_block_stays_over_its_floor(self):
        for number in range(100):
            slide = scenes.draw(SEED, number)
            c, s = scenes.exact_direction(slide.yaw)
            (a, b), way = slide.length[:2], scenes.travelled(slide)
            for part in (0, way):
                for u in (-a / 2, a / 2):
                    for v in (-b / 2, b / 2):
                        corner = (a / 2 + c * u - s * v + part * slide.heading()[0], b / 2 + s * u + c * v + part * slide.heading()[1])
                        for place, (low, high, _) in zip(corner, scenes.floor_extent(slide)):
                            self.assertTrue(low + 0.9 * slide.floor_cell <= place <= high - 0.9 * slide.floor_cell)

    def test_corners_lie_on_mesh_lines_where_there_is_no_shift(self):
        drawn = [slide for slide in (scenes.draw(SEED, number) for number in range(200)) if slide.shift == (0, 0) and slide.yaw == 0]
        self.assertGreater(len(drawn), 20)
        for slide in drawn:
            for low, _, _ in scenes.floor_extent(slide):
                self.assertAlmostEqual(low / slide.floor_cell, round(low / slide.floor_cell), places=12)

    def test_a_driven_face_is_named_by_where_it_goes(self):
        slide = dataclasses.replace(scenes.draw(SEED, 0), yaw=0.0, direction=180.0)
        self.assertEqual(scenes.faces(slide), {"trailing": "x_high", "leading": "x_low"})


class Judge(unittest.TestCase):
    def test_exact_slides_are_right(self):
        for number in range(60):
            for slide in (scenes.draw(SEED, number), scenes.draw(SEED, number).other()):
                found = judge.measure(slide, exact(slide))
                self.assertLess(max(found.force, found.lift), 1e-9)
                self.assertLess(found.speed, 1e-4)  # rows
                self.assertAlmostEqual(found.drive, slide.friction, places=9)

    def test_more_friction_is_wrong(self):
        for drive in ("free", "top", "trailing", "leading"):
            slide = some(drive)
            self.assertFalse(judge.measure(slide, exact(slide, 1.02)).good("rigid"))
            self.assertTrue(judge.measure(slide, exact(slide, 1.005)).good("rigid") or drive == "free")

    def test_a_block_that_is_thrown_up_or_aside_is_wrong(self):
        slide = some("free")
        self.assertFalse(judge.measure(slide, exact(slide, thrown=1.0)).good("rigid"))
        self.assertFalse(judge.measure(slide, exact(slide, aside=0.002)).good("rigid"))

    def test_a_block_that_flies_away_is_wrong(self):
        slide = some("free")
        columns = exact(slide)
        columns["momentum_z"] = list(columns["weight_z"])
        self.assertFalse(judge.measure(slide, columns).good("rigid"))

    def test_only_elastic_blocks_rattle(self):
        bad = judge.Measured(0.5, 0.1, 0.0, 0.0, 0.0, 1.0)
        steady = dataclasses.replace(bad, least=0.9)
        for kind, reference, warned, word in (("rigid", bad, False, "wrong"), ("steel", bad, False, "rattling"),
                                              ("steel", steady, False, "wrong"), ("steel", None, True, "warned"),
                                              ("rigid", bad, True, "warned")):
            self.assertEqual(judge.verdict(some("top", kind), 0, warned, bad, reference), word)
        self.assertEqual(judge.verdict(some("top"), 3, False, None, None), "stopped")


class Command(unittest.TestCase):
    def run_it(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            status = slides.main([*words, "--seed", str(SEED), "--drivers", str(self.root / "drivers"), "--out", str(self.root / "out")])
        return status, said.getvalue()

    def setUp(self):
        self.root = made_up.folder(self, "")
        made_up.driver(self.root, "scene", DRIVER, scripts=SCRIPTS, tests=Path(__file__).parent)

    def runs(self):
        return (self.root / "count").read_text().count("+")

    def test_right_slides_and_their_pairs(self):
        status, said = self.run_it("--count", "3", "--contact", "automatic")
        self.assertEqual(status, 0, said)
        self.assertIn("| automatic | all | 6 | 6 |", said)  # the first three have pairs
        self.assertIn("the drives of 3 of 3 pairs", said)
        self.assertEqual(self.runs(), 6)
        self.run_it("--count", "3", "--contact", "automatic")
        self.assertEqual(self.runs(), 6)  # none is made again
        self.assertFalse((self.root / "out/cases").exists())

    def test_wrong_slides_are_listed_beside_the_reference(self):
        status, said = self.run_it("--count", "2", "--contact", "two")
        self.assertEqual(status, 2, said)
        self.assertIn("reference: T/N", said)
        self.assertEqual(self.runs(), 4)
        self.assertTrue(list((self.root / "out/cases").glob("*_two.yaml")))

    def test_a_program_that_fails(self):
        made_up.driver(self.root, "scene", "#!{python}\nimport sys\nsys.exit(4)\n")
        self.assertEqual(self.run_it("--count", "1", "--contact", "one")[0], 3)

    def test_a_case_is_shown(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(slides.main(["--show", "5", "--contact", "two"]), 0)
        self.assertIn("passes: two", said.getvalue())


class Pairs(unittest.TestCase):
    def test_differ_by_their_drives(self):
        slide = some("top")
        rows = [slides.Row(slides.Task(one, "automatic"), "right", judge.Measured(drive, 0, 0, 0, 1, 1), None, {})
                for one, drive in ((dataclasses.replace(slide, moves="block"), 0.2), (dataclasses.replace(slide, moves="floor"), 0.21))]
        (_, _, differs), = slides.pairs_of(rows)
        self.assertTrue(math.isclose(differs, 0.01 / max(slide.friction, 0.1)))


if __name__ == "__main__":
    unittest.main()
