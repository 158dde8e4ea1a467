"""The filters of SAE J211-1 for channel frequency classes (CFC), and records with even spacing that they need.

The standard (Appendix C, MAR95) has a Butterworth filter of two poles,

    Y[t] = a0 X[t] + a1 X[t-1] + a2 X[t-2] + b1 Y[t-1] + b2 Y[t-2]

which passes a record forward and then backward, so that no phase is left. The gain of both passes together is, in closed form,

    1 / (1 + (tan(pi f T) / wa)^4),    wa = tan(pi 2.0775 CFC T)

with the time T between samples: 1 for a constant, 0.5 at 2.0775 CFC, 3 dB less at CFC/0.6.
"""
import math

import numpy as np

CLASSES = (60, 180, 600, 1000)
LEAST_RATE = 10.0    # [-] smallest number of samples in a period of the class frequency, by the standard
CONTINUED = 10e-3    # [s] or twice the time of SETTLED, whichever is longer: by so much a record is continued, if it is long enough
SETTLED = 1.0        # [-] of a period of the class frequency: farther from a blow, the filtered record is below 1e-3 of its largest value
ROUND_OFF = 1e-9     # [-] of times as histories have them, with 10 digits and more


class NoRecord(Exception):
    """Rows that cannot be filtered; says why and what would help."""


def coefficients(cfc, spacing):
    """(a0, a1, a2, b1, b2) of a class at a spacing [s] of the samples."""
    wd = 2 * math.pi * cfc * 2.0775
    wa = math.tan(wd * spacing / 2)
    below = 1 + math.sqrt(2) * wa + wa ** 2
    a0 = wa ** 2 / below
    return a0, 2 * a0, a0, -2 * (wa ** 2 - 1) / below, (-1 + math.sqrt(2) * wa - wa ** 2) / below


def gain(frequency, cfc, spacing):
    """The closed form of the gain of both passes at a frequency [Hz] below half the sample rate."""
    return 1 / (1 + (math.tan(math.pi * frequency * spacing) / math.tan(math.pi * 2.0775 * cfc * spacing)) ** 4)


def one_pass(values, found):
    """One pass forward, from the state of a record that has always had its first value."""
    a0, a1, a2, b1, b2 = found
    out, (x1, x2, y1, y2) = np.empty(len(values)), (values[0],) * 4
    for i, x in enumerate(values):
        y = a0 * x + a1 * x1 + a2 * x2 + b1 * y1 + b2 * y2
        out[i] = y
        x1, x2, y1, y2 = x, x1, y, y1
    return out


def continued(values, count):
    """The record with `count` more values at either end: reflected in the point of the end, so that value and slope go on."""
    count = min(count, len(values) - 1)
    before, behind = 2 * values[0] - values[count:0:-1], 2 * values[-1] - values[-2:-count - 2:-1]
    return np.concatenate([before, values, behind]), count


def filtered(values, cfc, spacing):
    """The values of evenly spaced samples by the filter of a class."""
    long, added = continued(np.asarray(values, dtype=float), math.ceil(max(CONTINUED, 2 * SETTLED / cfc) / spacing))
    found = coefficients(cfc, spacing)
    both = one_pass(one_pass(long, found)[::-1], found)[::-1]
    return both[added:added + len(values)]


def even_times(times, cfc):
    """(times of an even grid, how far a row but the last is off it over the spacing) of rows [s] that are dense enough for a class.

    The grid begins with the first row, has the mean spacing of all rows but the last, which the end of a run may set, and ends at or
    before that one.
    """
    apart = np.diff(times)
    if not np.all(np.isfinite(times)):
        raise NoRecord(f"the time of row {int(np.argmin(np.isfinite(times))) + 1} is no finite number")
    if len(times) < 3:
        raise NoRecord(f"{len(times)} rows are no record: expected are 3 or more")
    if not np.all(apart > 0):
        raise NoRecord(f"the time of row {int(np.argmin(apart > 0)) + 2} is not above that of the row before: expected are times that rise")
    largest, needed = apart.max(), 1 / (LEAST_RATE * cfc)
    if largest > needed * (1 + ROUND_OFF):
        at = times[int(apart.argmax())]
        raise NoRecord(f"rows are up to {largest:.4g} s apart (behind {at:.4g} s), which is too far for CFC {cfc}: expected are at most "
                       f"{needed:.4g} s ({LEAST_RATE:g} rows in a period of {cfc} Hz); 'output.history_every' of the case sets it")
    if times[-1] - times[0] < 1 / cfc:
        raise NoRecord(f"the rows reach over {times[-1] - times[0]:.4g} s, less than a period of {cfc} Hz: every value behind the filter "
                       "would depend on the ends")
    spacing = float(np.mean(apart[:-1]))
    grid = times[0] + spacing * np.arange(int((times[-1] - times[0]) / spacing * (1 + ROUND_OFF)) + 1)
    off = np.abs(times - times[0] - spacing * np.round((times - times[0]) / spacing))
    return grid, float(off[:-1].max() / spacing)
