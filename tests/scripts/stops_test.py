"""Tests of scripts/stops: what it makes of a case."""
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
stops = made_up.script("stops")

CASE = "bodies: []\n\nstop:\n  - {probe: a, above: 1 m}  # why\n\ntime: {end: 1 s}\n"


class Cases(unittest.TestCase):
    def test_the_list_is_replaced_or_taken_out(self):
        self.assertEqual(stops.with_stop(CASE, ""), "bodies: []\n\ntime: {end: 1 s}\n")
        self.assertTrue(stops.with_stop(CASE, "{rest: 1}").endswith("time: {end: 1 s}\n\nstop:\n  - {rest: 1}\n"))
        self.assertEqual(stops.with_stop("time: {end: 1 s}\nstop: []\n", ""), "time: {end: 1 s}\n")

    def test_each_scene_has_a_case_without_the_stop_of_its_own(self):
        for scene in stops.SCENES:
            text = (stops.ROOT / scene.case).read_text(encoding="utf-8")
            self.assertNotIn("\nstop:", stops.with_stop(text, ""))
            self.assertIn("\ntime:", stops.with_stop(text, ""))


class Differences(unittest.TestCase):
    def test_are_the_largest_of_the_answers(self):
        class Run:
            def __init__(self, **results):
                self.summary, self.ending = {"results": results}, "stopped_by_condition"

            def result(self, name):
                return self.summary["results"][name]
        self.assertAlmostEqual(stops.difference(Run(a=2.0, b=-4.0), Run(a=2.1, b=-4.0), ("a", "b")), 0.05)
        self.assertEqual(stops.difference(Run(a=2.0), Run(), ("a",)), float("inf"))
        scene = stops.Scene("", "", "", "", "", ("a",), 0.01)
        whole, near, far = Run(a=1.0), Run(a=1.005), Run(a=1.1)
        self.assertTrue(stops.is_good(scene, whole, near, far))
        self.assertFalse(stops.is_good(scene, whole, far, far))
        self.assertFalse(stops.is_good(scene, whole, near, near))


if __name__ == "__main__":
    unittest.main()
