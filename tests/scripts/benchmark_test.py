"""Tests of scripts/benchmark: the examples in the texts of the program and of its scenes."""
import doctest
import sys
import unittest
from pathlib import Path

import made_up

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
benchmark = made_up.script("benchmark")
import benchmark_scenes  # noqa: E402  (after the path)


class Texts(unittest.TestCase):
    def test_examples(self):
        for module in (benchmark, benchmark_scenes):
            failed, tried = doctest.testmod(module)
            self.assertEqual(failed, 0, module.__name__)
            self.assertGreater(tried, 0, module.__name__)


if __name__ == "__main__":
    unittest.main()
