"""Tests of scripts/forecast: what counts as a miss, and what the table says."""
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
forecast = made_up.script("forecast")


def one(steps=1.0, size=1.0, memory=1.0, seconds=1.0, long=1.0):
    return {"steps": (100 * steps, 100), "bytes": (1e6 * size, 1e6), "memory": (1e7 * memory, 1e7), "seconds": (long * seconds, long)}


class Misses(unittest.TestCase):
    def test_a_fifth_or_a_tenth_is_near_and_more_is_a_miss_either_way(self):
        for factor, missed in ((1.19, False), (0.84, False), (1.21, True), (0.83, True)):
            self.assertEqual(forecast.is_miss(one(steps=factor), "steps"), missed)
        for factor, missed in ((1.09, False), (0.92, False), (1.11, True), (0.9, True)):
            self.assertEqual(forecast.is_miss(one(size=factor), "bytes"), missed)
            self.assertEqual(forecast.is_miss(one(memory=factor), "memory"), missed)

    def test_seconds_may_be_off_by_two_and_count_for_long_runs_only(self):
        self.assertFalse(forecast.is_miss(one(seconds=1.9), "seconds"))
        self.assertTrue(forecast.is_miss(one(seconds=2.1), "seconds"))
        self.assertFalse(forecast.is_miss(one(seconds=2.1, long=0.4), "seconds"))

    def test_open_contacts_that_are_told_may_be_closed_for_a_part_of_the_time(self):
        told = forecast.OPEN.search("cost is not in the forecast: about 30 s more if all 99 nodes of the surfaces touched all the time")
        for true, said in ((20, 20), (5, 10), (50, 40)):
            self.assertEqual(forecast.nearest(10, told, true), said)
        self.assertEqual(forecast.nearest(10, None, 20), 10)

class Tables(unittest.TestCase):
    def test_counts_all_and_lists_the_misses(self):
        text = forecast.table({"a.yaml": one(), "b.yaml": one(steps=0.5, long=0.1)})
        self.assertIn("| steps | 20 % | 1, too few | 2 | 0.75 | 0.50 | 1.00 |", text)
        self.assertIn("| bytes | 10 % | 2 | 2 | 1.00 | 1.00 | 1.00 |", text)
        self.assertIn("| seconds | a factor of 2 | 1 | 1 |", text)
        self.assertIn("| b.yaml | **0.50** | 1.00 | 1.00 |  |", text)
        self.assertNotIn("| a.yaml", text)

class Cases(unittest.TestCase):
    def test_are_those_of_the_programs_and_of_the_suite(self):
        found = {(driver, path.relative_to(forecast.ROOT).as_posix()) for driver, path, _ in forecast.cases([])}
        self.assertIn(("two_blocks", "cases/two_blocks/bars.yaml"), found)
        self.assertIn(("scene", "verification/taylor_bar/case.yaml"), found)
        only = forecast.cases([forecast.ROOT / "cases/sliding"])
        self.assertEqual({driver for driver, _, _ in only}, {"sliding"})

if __name__ == "__main__":
    unittest.main()
