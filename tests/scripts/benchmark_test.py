"""Tests of scripts/benchmark: the examples in the texts of the program and of its scenes."""
import doctest
import importlib.machinery
import importlib.util
import sys
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True  # none beside a program without ending
loader = importlib.machinery.SourceFileLoader("benchmark", str(SCRIPTS / "benchmark"))
benchmark = importlib.util.module_from_spec(importlib.util.spec_from_loader("benchmark", loader))
sys.modules["benchmark"] = benchmark
loader.exec_module(benchmark)
import benchmark_scenes  # noqa: E402  (after the path)


class Texts(unittest.TestCase):
    def test_examples(self):
        for module in (benchmark, benchmark_scenes):
            failed, tried = doctest.testmod(module)
            self.assertEqual(failed, 0, module.__name__)
            self.assertGreater(tried, 0, module.__name__)


if __name__ == "__main__":
    unittest.main()
