"""scripts/gates.py: what is unexplained or created is told in any run, whatever its case asks."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
import gates  # noqa: E402  (after the path)


def number(value):
    return {"value": value}


class MadeUp:
    """A run of one body that loses 2 J to a wall; momentum turns round."""

    def __init__(self, energy=0.0, momentum=0.0, angular=0.0, momenta=True, frames=True, made=()):
        axis = 1.0 if momenta else 0.0
        self.summary = {"ledger": {
            "initial_kinetic": number(4.0), "initial_available": number(4.0), "initial_stored": number(0.0), "kinetic": number(2.0),
            "external_work": number(0.0), "energy_residual": number(energy),
            "initial_momentum": number([axis, 0, 0]), "momentum": number([-axis, 0, 0]), "momentum_residual": number([0, momentum, 0]),
            "initial_angular_momentum": number([0, axis, 0]), "angular_momentum": number([0, -axis, 0]),
            "angular_momentum_residual": number([0, 0, angular]),
            "accounts": {"wall": {"work": number(-2.0), "impulse": number([-2 * axis, 0, 0]), "angular_impulse": number([0, -2 * axis, 0]),
                                  "created": number(0.0), "created_relative": number(0.0)}}}}
        self.columns = {"time": [0, 1], "energy_kinetic": [4.0, 2.0], "energy_created_wall": list(made or (0.0, 0.0))}
        self.folder = Path(__file__).parent if not frames else self
        self.has_frames, self.driver, self.ending = frames, "scene", "reached_end"

    def __truediv__(self, name):  # stands for the folder
        return self

    def is_file(self):
        return self.has_frames

    def frames(self, collection):
        return 2

    def at(self, name, time):
        return self.columns[name][int(time)]

    def frame(self, collection, count):
        return count, {"velocity": [(0, 0, 2.0), (0, 0, -2.0)], "points": [(0, 0, 3.0), (0, 4.0, 0)]}


class GatesTest(unittest.TestCase):
    def passes(self, gate, run):
        error = gates.errors(run)[gate]
        return None if error is None else error <= gates.LIMITS[gate]

    def test_a_run_that_says_that_an_element_is_inverted_needs_no_finite_ledger(self):
        run = MadeUp(energy=float("inf"))
        self.assertFalse(self.passes(gates.ENERGY, run))
        run.ending = "inverted_element"
        self.assertIsNone(self.passes(gates.ENERGY, run))
        run = MadeUp(energy=1.0)
        run.ending = "inverted_element"
        self.assertFalse(self.passes(gates.ENERGY, run))

    def test_a_run_that_explains_all_passes_every_gate(self):
        self.assertEqual({self.passes(gate, MadeUp()) for gate in gates.LIMITS}, {True})

    def test_what_is_unexplained_fails_its_gate_and_no_other(self):
        for gate, lost in ((gates.ENERGY, {"energy": -1e-8}), (gates.MOMENTUM, {"momentum": 1e-8}), (gates.ANGULAR, {"angular": -1e-8}),
                           (gates.MADE, {"made": (0.1, 0.0)})):
            with self.subTest(gate):
                self.assertEqual([one for one in gates.LIMITS if not self.passes(one, MadeUp(**lost))], [gate])

    def test_what_is_no_number_fails(self):
        for lost in ({"energy": None}, {"momentum": None}, {"angular": None}, {"made": (0.0, float("nan"))}):
            with self.subTest(lost):
                self.assertIn(False, [self.passes(gate, MadeUp(**lost)) for gate in gates.LIMITS])

    def test_energy_created_on_the_way_counts_though_it_is_gone_at_the_end(self):
        self.assertFalse(self.passes(gates.MADE, MadeUp(made=(-0.05, 0.0))))
        self.assertTrue(self.passes(gates.MADE, MadeUp(made=(-0.03, 0.0))))  # of 4 J

    def test_momenta_that_vanish_by_symmetry_are_held_against_those_of_the_nodes(self):
        run = MadeUp(momentum=1e-12, angular=1e-12, momenta=False)
        self.assertAlmostEqual(gates.momentum_of_nodes(run), 2 * 4 / 2)
        self.assertAlmostEqual(gates.moment_of_nodes(run), 2 * 4 / 2 * 4)
        self.assertTrue(self.passes(gates.MOMENTUM, run))
        self.assertTrue(self.passes(gates.ANGULAR, run))
        self.assertFalse(self.passes(gates.MOMENTUM, MadeUp(momentum=1e-8, momenta=False)))
        self.assertFalse(self.passes(gates.ANGULAR, MadeUp(angular=1e-8, momenta=False)))

    def test_without_frames_moments_have_no_scale_and_fail_but_for_the_program_that_draws_none(self):
        run = MadeUp(momentum=1e-12, angular=1e-12, momenta=False, frames=False)
        self.assertFalse(self.passes(gates.ANGULAR, run))
        run.driver = "penalty_oscillator"
        self.assertIsNone(self.passes(gates.ANGULAR, run))
        self.assertFalse(self.passes(gates.MOMENTUM, run))

    def test_a_program_without_accounts_is_not_judged(self):
        run = MadeUp()
        run.summary["ledger"]["accounts"] = {}
        self.assertEqual(gates.errors(run), {})


if __name__ == "__main__":
    unittest.main()
