"""The smallest part of a mistake that a check notices: the values that a break sets, moved from right to wrong.

A break sets keys of the case. With the part p, 0 < p <= 1, each of its numbers is right + p (wrong - right). The search begins where the
error would reach the limit if it grew evenly, and goes on at the geometric mean of the smallest part that was noticed and the largest that
was not. What it returns was run and noticed, so the true bound may be lower.
"""
import dataclasses
import math

from runs import CannotRun

RUNS = 5       # at most, for one break
CLOSE = 1.3    # of what is noticed over what is not: close enough
SMALLEST = 1e-9


def numbers_of(value):
    """The numbers of a value of a resolved case, or none where it is a word.

    >>> numbers_of(2.5), numbers_of(["0", "-10"]), numbers_of(True), numbers_of("10*x")
    ([2.5], [0.0, -10.0], None, None)
    """
    if isinstance(value, (list, tuple)):
        found = [numbers_of(entry) for entry in value]
        return None if any(one is None or len(one) != 1 for one in found) else [one[0] for one in found]
    if isinstance(value, bool) or value is None:
        return None
    try:
        return [float(value)]
    except (TypeError, ValueError):
        return None


def unit_of(run, key):
    """The unit of a key, with a blank before it, or nothing."""
    at = run.summary["provenance"]["resolved"]
    for name in key.replace("]", "").replace("[", ".").split("."):
        at = at[int(name)] if isinstance(at, list) else at[name]
    unit = at.get("unit") if isinstance(at, dict) else None
    return f" {unit}" if unit and unit != "1" else ""


def ends_of(one, run, broken):
    """{key: (right numbers, wrong numbers, whether it is a list, unit)} of what a break sets; none where one of them is no number."""
    found = {}
    for key in one.change:
        try:
            value = run.case(key)
            right, wrong = numbers_of(value), numbers_of(broken.case(key))
            unit = unit_of(run, key)
        except (KeyError, IndexError, TypeError, ValueError):
            return None
        if right is None or wrong is None or len(right) != len(wrong) or right == wrong:
            return None
        quoted = isinstance(value, (list, tuple)) and any(isinstance(entry, str) for entry in value) or isinstance(value, str)
        found[key] = (right, wrong, isinstance(value, (list, tuple)), unit, quoted)
    return found or None


def between(right, wrong, part):
    return [a + part * (b - a) for a, b in zip(right, wrong)]


def text_of(values, is_list, unit, quoted):
    """What --set takes.

    >>> text_of([2.5], False, " Pa", False), text_of([0.0, -1.0], True, "", True)
    ('2.5 Pa', '["0.0", "-1.0"]')
    """
    texts = [f'"{value!r}"' if quoted else f"{value!r}{unit}" for value in values]
    return f"[{', '.join(texts)}]" if is_list else texts[0]


def relative(ends, part):
    """The largest change of a number over the largest right one of its key, or over the wrong one where that is zero.

    >>> relative({"a": ([100.0], [200.0], False, "", False)}, 0.5), relative({"a": ([0.0], [3.0], False, "", False)}, 0.5)
    (0.5, 0.5)
    """
    return max(part * max(abs(b - a) for a, b in zip(right, wrong)) / (max(map(abs, right)) or max(map(abs, wrong)))
               for right, wrong, *_ in ends.values())


def search(noticed, guess):
    """The smallest part that was noticed, of at most RUNS that are asked; 1 is known to be.

    >>> round(search(lambda part: part > 0.02, 0.5), 3)
    0.031
    >>> search(lambda part: part > 0.9, 0.5)
    1.0
    """
    low, high, part = 0.0, 1.0, min(max(guess, SMALLEST), 0.9)
    for _ in range(RUNS):
        if noticed(part):
            high = part
        else:
            low = part
        if low > 0 and high <= CLOSE * low:
            break
        part = math.sqrt(low * high) if low > 0 else high / 4
    return high


def smallest(one, run, broken, error_with, error, within, error_without):
    """The smallest relative fault that is noticed, or none where the break sets words, or counts that cannot be divided.

    error_with  function of a break: the error of the check with it, NaN where its run ends early
    """
    try:
        ends = ends_of(one, run, broken)
        if ends is None:
            return None

        def noticed(part):
            change = {key: text_of(between(right, wrong, part), *how) for key, (right, wrong, *how) in ends.items()}
            return error_with(dataclasses.replace(one, change=change)) > within
        guess = 1.1 * (within - error_without) / (error - error_without) if error > error_without else 0.5
        return relative(ends, search(noticed, guess))
    except CannotRun:
        return None
