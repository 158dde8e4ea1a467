"""scripts/sensitivity.py on functions whose indices are known; the seeds are fixed, so the outcomes repeat."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
try:
    import numpy as np
    import sensitivity
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

# Ishigami's function with a = 7, b = 0.1 on [-pi, pi]^3, and its exact variances (Ishigami & Homma 1990).
A, B = 7.0, 0.1
FIRST, SECOND = 0.5 * (1 + B * np.pi**4 / 5)**2, A**2 / 8
ISHIGAMI_VARIANCE = SECOND + B * np.pi**4 / 5 + B**2 * np.pi**8 / 18 + 0.5
ISHIGAMI = [FIRST / ISHIGAMI_VARIANCE, SECOND / ISHIGAMI_VARIANCE, 0.0]


def ishigami(u):
    x = np.pi * u
    return np.sin(x[:, 0]) + A * np.sin(x[:, 1])**2 + B * x[:, 2]**4 * np.sin(x[:, 0])


def product(u):
    """Half of the variance is of a product of two inputs, whose own indices are nothing: 1/9 beside 1/12."""
    return u[:, 0] * u[:, 1] + 0.5 * u[:, 2]


PRODUCT = [0.0, 0.0, (1 / 12) / (1 / 9 + 1 / 12)]


def points(runs, inputs, seed):
    """A Latin hypercube in [-1, 1]^inputs."""
    random = np.random.default_rng(seed)
    cells = np.column_stack([random.permutation(runs) for _ in range(inputs)])
    return 2 * (cells + random.random((runs, inputs))) / runs - 1


def of(function, runs, inputs, seed=1):
    u = points(runs, inputs, seed)
    return sensitivity.estimate(u, function(u))


class KnownIndicesTest(unittest.TestCase):
    def test_a_plane_needs_no_more_runs_than_it_has_terms_and_some(self):
        slopes = np.array([1.0, -2.0, 3.0, 0.0, 0.5])
        found = of(lambda u: 7 + u @ slopes, 16, 5)
        for i, exact in enumerate(slopes**2 / np.sum(slopes**2)):
            self.assertAlmostEqual(found.share[i].value, exact, delta=1e-12)
            self.assertAlmostEqual(found.change[i].value, 2 * slopes[i], delta=1e-12)
        self.assertAlmostEqual(found.mean.value, 7, delta=1e-12)
        self.assertAlmostEqual(found.deviation.value, np.sqrt(np.sum(slopes**2) / 3), delta=1e-12)
        self.assertLess(max(one.error for one in found.share), 1e-12)
        self.assertEqual(found.degrees, [1] * 5)

    def test_ishigami(self):
        found = of(ishigami, 256, 3)
        for got, exact in zip(found.share, ISHIGAMI):
            self.assertAlmostEqual(got.value, exact, delta=0.05)
            self.assertLessEqual(abs(got.value - exact), got.error)
        self.assertAlmostEqual(found.mean.value, A / 2, delta=found.mean.error)
        self.assertAlmostEqual(found.deviation.value, np.sqrt(ISHIGAMI_VARIANCE), delta=found.deviation.error)
        self.assertAlmostEqual(found.rest.value, 1 - sum(ISHIGAMI), delta=found.rest.error)
        self.assertLess(found.predicted, 0.8)  # a quarter is of two inputs together

    def test_the_error_holds_in_nine_of_ten(self):
        for function, exact in ((ishigami, ISHIGAMI), (product, PRODUCT)):
            inside = [abs(got.value - one) <= got.error for seed in range(40) for got, one in zip(of(function, 64, 3, seed).share, exact)]
            with self.subTest(function.__name__):
                self.assertGreaterEqual(np.mean(inside), 0.9)

    def test_the_error_falls_with_the_runs(self):
        few, many = of(product, 64, 3), of(product, 1024, 3)
        self.assertAlmostEqual(many.share[2].error / few.share[2].error, 0.25, delta=0.1)

    def test_too_few_runs_for_a_curve_leave_it_in_the_rest(self):
        few = of(lambda u: np.cos(4 * np.pi * u[:, 0]) + 0.1 * u[:, 1], 12, 2)
        self.assertGreater(few.rest.value, 0.3)
        self.assertLess(few.predicted, 0.5)


class EdgeTest(unittest.TestCase):
    def test_a_result_that_depends_on_nothing(self):
        found = of(lambda u: 3.0 + 0 * u[:, 0], 16, 2)
        self.assertEqual((found.mean.value, found.deviation.value, found.share[0].value), (3.0, 0.0, 0.0))

    def test_too_few_runs_are_told(self):
        with self.assertRaisesRegex(sensitivity.TooFew, "5 runs with a result are too few for 4 inputs: 8 or more"):
            of(lambda u: u[:, 0], 5, 4)

    def test_scale_and_offset_of_the_result_do_not_matter(self):
        plain, moved = of(ishigami, 64, 3), of(lambda u: 5e-7 + 1e-9 * ishigami(u), 64, 3)
        for a, b in zip(plain.share, moved.share):
            self.assertAlmostEqual(a.value, b.value, delta=1e-9)
        self.assertAlmostEqual(moved.change[0].value, 1e-9 * plain.change[0].value, delta=1e-15)


if __name__ == "__main__":
    unittest.main()
