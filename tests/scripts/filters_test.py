"""scripts/filters.py: the gain of both passes is the closed form and inside the corridor of the standard, and no phase is left."""
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
try:
    import filters  # needs numpy
    import numpy as np
except ImportError:
    sys.exit(77)

PERIODS = 40  # of the class frequency in a record


def record(cfc, rate, shape):
    """(times, values) of a shape(t), with `rate` samples in a period of the class frequency."""
    times = np.arange(PERIODS * rate) / (rate * cfc)
    return times, shape(times)


def middle(values):
    """The part that does not depend on the ends."""
    return values[len(values) // 4:-len(values) // 4]


def response(cfc, rate, frequency):
    """The complex amplitude of a filtered cosine of unit amplitude, from the middle of its record."""
    times, values = record(cfc, rate, lambda t: np.cos(2 * np.pi * frequency * t))
    smooth = middle(filters.filtered(values, cfc, 1 / (rate * cfc)))
    t = middle(times)
    shapes = np.column_stack([np.cos(2 * np.pi * frequency * t), np.sin(2 * np.pi * frequency * t)])
    (real, imaginary), *_ = np.linalg.lstsq(shapes, smooth, rcond=None)
    return complex(real, -imaginary)


def level(amplitude):
    return 20 * math.log10(amplitude)


class GainTest(unittest.TestCase):
    def test_gain_is_the_closed_form_and_no_phase_is_left(self):
        for cfc in filters.CLASSES:
            for rate in (10, 17, 64):
                for ratio in (0.1, 0.3, 0.6, 1.0, 1.37, 5 / 3, 2.0775, 3.0, 4.3):
                    with self.subTest(cfc=cfc, rate=rate, ratio=ratio):
                        found = response(cfc, rate, ratio * cfc)
                        self.assertAlmostEqual(found.real, filters.gain(ratio * cfc, cfc, 1 / (rate * cfc)), delta=1e-12)
                        self.assertAlmostEqual(found.imag, 0, delta=1e-12)

    def test_gain_of_a_dense_record_is_that_of_the_analogue_filter(self):
        for ratio in (0.5, 1.0, 5 / 3, 2.0775):
            self.assertAlmostEqual(filters.gain(ratio * 60, 60, 1e-7), 1 / (1 + (ratio / 2.0775) ** 4), delta=1e-9)

    def test_gain_is_inside_the_corridor_of_the_standard(self):
        """±0.5 dB up to the class frequency F_H, 0.5 to -4 dB at F_N = F_H/0.6, and behind it between falls of 9 and 24 dB an octave."""
        for cfc, floor in zip(filters.CLASSES, (-30, -30, -40, -40)):
            for rate in (40, 100):
                def of(ratio):
                    return level(filters.gain(ratio * cfc, cfc, 1 / (rate * cfc)))
                for ratio in np.linspace(0.01, 1, 50):
                    self.assertLess(abs(of(ratio)), 0.5)
                self.assertLess(of(1 / 0.6), 0.5)
                self.assertGreater(of(1 / 0.6), -4)
                for octaves in np.linspace(0.05, 2, 40):
                    found = of(2 ** octaves / 0.6)
                    self.assertLess(found, 0.5 - 9 * octaves)
                    self.assertGreater(found, -4 - 24 * octaves)
            self.assertLess(of(2 ** ((0.5 - floor) / 9) / 0.6), floor)  # a frequency below half the last rate

    def test_coefficients_are_those_of_a_digital_butterworth_filter(self):
        """CFC 180 at 10 kHz, beside butter(2, 2 * 2.0775 * 180 / 10e3) of SciPy 1.10."""
        expected = (0.011796271099778453, 0.023592542199556907, 0.011796271099778453, 1.6701174632678273, -0.7173025476669411)
        for got, one in zip(filters.coefficients(180, 1e-4), expected, strict=True):
            self.assertAlmostEqual(got, one, delta=1e-14)


class RecordTest(unittest.TestCase):
    def test_a_constant_and_a_straight_line_stay_up_to_their_ends(self):
        for shape in (lambda t: 3.0 + 0 * t, lambda t: 3.0 + 20.0 * t):
            _, values = record(180, 25, shape)
            self.assertLess(np.abs(filters.filtered(values, 180, 1 / (25 * 180)) - values).max(), 1e-9 * np.abs(values).max())
        _, values = record(180, 25, lambda t: 3.0 + 0 * t)
        self.assertLess(np.abs(filters.filtered(values, 180, 1 / (25 * 180)) - 3).max(), 1e-12)

    def test_the_area_of_a_blow_stays(self):
        for cfc in filters.CLASSES:
            values = np.zeros(PERIODS * 30)
            values[len(values) // 2] = 30.0 * cfc
            smooth = filters.filtered(values, cfc, 1 / (30 * cfc))
            self.assertAlmostEqual(smooth.sum() / (30 * cfc), 1, delta=1e-12)

    def test_a_blow_is_over_after_the_time_that_is_told(self):
        values = np.zeros(PERIODS * 50)
        values[len(values) // 2] = 1.0
        smooth = filters.filtered(values, 60, 1 / (50 * 60))
        self.assertTrue(np.allclose(smooth, smooth[::-1][np.r_[-1:len(smooth) - 1]], rtol=0, atol=1e-12))  # no phase
        far = np.abs(np.arange(len(values)) - len(values) // 2) > filters.SETTLED * 50
        self.assertLess(np.abs(smooth[far]).max(), 1e-3 * smooth.max())

    def test_rows_that_are_nearly_even_get_an_even_grid(self):
        times = np.arange(400) * 1e-4 + np.random.default_rng(1).uniform(0, 5e-6, 400)
        times[0], times[-1] = 0.0, times[-2] + 3e-5  # the end of a run may come early
        grid, off = filters.even_times(times, 600)
        self.assertAlmostEqual(grid[1], 1e-4, delta=1e-7)
        self.assertTrue(times[-2] - 1e-4 < grid[-1] <= times[-1])
        self.assertLess(off, 0.051)  # rows are late by up to 0.05 of their spacing
        grid, off = filters.even_times(np.r_[np.arange(400) * 1e-4, 399.4 * 1e-4], 600)
        self.assertLess(off, 1e-9)  # the last row does not count
        grid, off = filters.even_times(np.arange(400) * 1e-4, 600)
        self.assertLess(off, 1e-9)
        self.assertEqual(len(grid), 400)

    def test_rows_that_are_too_far_apart_or_too_few_are_refused(self):
        for times, cfc, says in ((np.arange(400) * 1e-4, 1000, None), (np.arange(400) * 1.01e-4, 1000, "too far for CFC 1000"),
                                 (np.r_[np.arange(100) * 1e-4, 0.05], 600, "behind 0.0099 s"),
                                 (np.arange(2) * 1e-4, 60, "2 rows are no record: .* 3 or more"),
                                 (np.array([0, 1e-4, 1e-4, 2e-4]), 60, "the time of row 3 is not above that of the row before"),
                                 (np.array([0, 1e-4, math.nan]), 60, "the time of row 3 is no finite number"),
                                 (np.array([0, 1e-4, 2e-4, math.inf]), 60, "the time of row 4 is no finite number"),
                                 (np.arange(100) * 1e-4, 60, "less than a period")):
            if says is None:
                filters.even_times(times, cfc)
            else:
                with self.assertRaisesRegex(filters.NoRecord, says):
                    filters.even_times(times, cfc)


if __name__ == "__main__":
    unittest.main()
