"""scripts/accuracy_draw.py: what a scene counts as, what a seed draws, and how rows are counted."""
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True
try:
    import yaml  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
import accuracy_draw as draw  # noqa: E402  (after the path)
import mesh_files  # noqa: E402

SCENE = """
bodies:
  - {name: a, mesh: {kind: file, path: cube.vtu}}
  - {name: b, rigid: true, mesh: {kind: box, cells: [2, 2, 2]}}
contacts: [{name: touch}]
planes: [{name: hold, kind: fixed}]
probes:
  - {name: push, quantity: force, of: touch}
  - {name: pull, quantity: force, of: hold}
"""
CUBE = mesh_files.Mesh([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], [[0, 1, 3, 2, 4, 5, 7, 6]],
                       {"low": [1, 1, 1, 1, 0, 0, 0, 0]}, {"region": [7]})


class DrawTest(unittest.TestCase):
    def test_a_result_belongs_to_what_its_scene_has(self):
        with tempfile.TemporaryDirectory() as folder:
            case = Path(folder) / "case.yaml"
            case.write_text(SCENE, encoding="utf-8")
            mesh_files.write(Path(folder) / "cube.vtu", CUBE)
            found = {one.result: one.strata for one in draw.results_of(case, "verification/x/case.yaml")}
        self.assertEqual(found["push_largest"], ("file mesh", "rigid shape", "contact force"))
        self.assertEqual(found["pull_last"], ("file mesh", "rigid shape"))
        self.assertEqual(len(found), 6)

    def test_a_seed_draws_the_same_and_each_stratum_as_many(self):
        results = [draw.Drawn(f"verification/{case}/case.yaml", f"p_{part}", (stratum,))
                   for stratum in draw.STRATA for case in "abcdefgh" for part in draw.PARTS]
        one, other = (draw.draw(results, lambda _: True, seed=3) for _ in range(2))
        self.assertEqual(one, other)
        self.assertNotEqual(one, draw.draw(results, lambda _: True, seed=4))
        for stratum in draw.STRATA:
            cases = [found.case for of, found in one if of == stratum]
            self.assertEqual(len(set(cases)), draw.EACH, "no scene twice before all were drawn")
        none = draw.draw(results, lambda found: "/a/" not in found.case)
        self.assertFalse([found for _, found in none if "/a/" in found.case])

    def test_every_stratum_of_the_tree_has_enough(self):
        found = draw.universe(Path("nowhere"))
        for stratum in draw.STRATA:
            self.assertGreaterEqual(len({one.case for one in found if stratum in one.strata}), draw.EACH, stratum)


class RowsTest(unittest.TestCase):
    def test_refusals_beyond_a_tenth_count_as_missed(self):
        good, missed = draw.Row("plates", "a", 0.02, 0.01, 0.0), draw.Row("plates", "b", 0.01, 0.05, 0.01)
        refused = draw.Row("plates", "c", said="too long")
        text = draw.text_of([good] * 15 + [missed] + [refused] * 4, 0.02, 1)
        self.assertIn("16 of 20 have an estimate, and the true error is within it in 15.", text)
        self.assertIn("those beyond 2 count as missed, which makes 15 of 18.", text)
        self.assertIn("which makes 20 of 20", draw.text_of([good] * 20, 0.02, 1))

    def test_an_estimate_counts_where_the_target_is_not_reached(self):
        lines = ["refine 1: force = 2 N", "refine 2: force = 1.5 N, estimated error 40 %"]
        self.assertEqual(draw.last_estimate(lines), (1.5, 0.6))
        self.assertIsNone(draw.last_estimate(lines[:1]))
        self.assertIsNone(draw.last_estimate([]))

    def test_what_the_true_value_is_uncertain_by_counts_for_the_estimate(self):
        self.assertTrue(draw.Row("plates", "a", 0.01, 0.015, 0.006).within())
        self.assertFalse(draw.Row("plates", "a", 0.01, 0.015, 0.004).within())


if __name__ == "__main__":
    unittest.main()
