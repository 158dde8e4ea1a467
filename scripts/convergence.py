"""Grid convergence: observed order, Richardson's extrapolation and Roache's index of a sequence of meshes."""
import math

FORMAL_ORDER = 2.0      # linear elements cannot do better, so no estimate of error may assume it
LEAST_ORDER, MOST_ORDER = 0.5, 3.0  # an order outside is no order: these meshes are not fine enough to tell
SAFETY_FACTOR = 1.25    # of the grid convergence index on three meshes (Roache 1994)
NO_ORDER_FACTOR = 3.0   # his factor where no order is shown; here on the spread of the three
SAME_ORDER = 0.5        # orders of two neighbouring triples that differ by more are not those of one power of h


def order_between(size_0, error_0, size_1, error_1):
    """The order p of a known error that goes as size^p, from two sizes."""
    if min(error_0, error_1) <= 0:
        return math.inf if error_1 <= error_0 else -math.inf
    return math.log(error_1 / error_0) / math.log(size_1 / size_0)


def observed_order(sizes, values):
    """Order p of f(h) = f0 + C h^p through three meshes of sizes h, finest first; (None, why) where they show none.

    The ratios of h need not be equal: p solves  (f3 - f2)/(f2 - f1) = (h3^p - h2^p)/(h2^p - h1^p).
    """
    (h1, h2, h3), (f1, f2, f3) = sizes, values
    if f2 == f1:
        return None, "the finest two agree to the last digit, so no order can be told"
    ratio = (f3 - f2) / (f2 - f1)
    if ratio <= 0:
        return None, "not monotone on the finest three"

    def right(p):
        return (h3 ** p - h2 ** p) / (h2 ** p - h1 ** p)

    low, high = LEAST_ORDER, MOST_ORDER
    if not right(low) <= ratio <= right(high):
        side = f"below {LEAST_ORDER:g}" if ratio < right(low) else f"above {MOST_ORDER:g}"
        return None, f"monotone, but of an order {side} on the finest three, which is none"
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if right(middle) < ratio else (low, middle)
    return 0.5 * (low + high), ""


def tendency(levels, values):
    """What a sequence of meshes h = 1/level tends to: Richardson's extrapolation through the three finest.

    Returns (sentence, f0 or None, uncertainty of the finest value or None).
    """
    if len(levels) < 3:
        return "fewer than three meshes: no statement", None, None
    (h1, f1), (h2, f2), (h3, f3) = sorted((1 / level, value) for level, value in zip(levels, values))[:3]
    order, why = observed_order((h1, h2, h3), (f1, f2, f3))
    if order is None:
        spread = NO_ORDER_FACTOR * (max(f1, f2, f3) - min(f1, f2, f3))
        return f"{why}; the uncertainty is {NO_ORDER_FACTOR:g} times their spread", None, spread
    used = min(order, FORMAL_ORDER)
    limit = f1 - (f2 - f1) / ((h2 / h1) ** order - 1)
    uncertainty = SAFETY_FACTOR * abs(f2 - f1) / ((h2 / h1) ** used - 1)
    note = f"observed order {order:.2f}" + (f", taken as {FORMAL_ORDER:g} for the uncertainty" if order > FORMAL_ORDER else "")
    return note, limit, uncertainty


def verdict(levels, values):
    """(order, whether the sequence is asymptotic, or why there is no order) through the three finest meshes h = 1/level."""
    if len(values) < 3:
        return None, "fewer than three meshes: no statement"
    if max(values) == min(values):
        return None, "does not depend on the mesh"
    pairs = sorted(zip((1 / level for level in levels), values))
    order, why = observed_order(*zip(*pairs[:3]))
    if order is None:
        return None, f"NOT asymptotic: {why}"
    if len(pairs) == 3:
        return order, "monotone; three meshes cannot show that the order stays"
    before, why = observed_order(*zip(*pairs[1:4]))
    if before is None:
        return order, f"NOT asymptotic: the next coarser three are {why.replace(' on the finest three', '')}"
    if abs(order - before) > SAME_ORDER:
        return order, f"NOT asymptotic: the order was {before:.2f} on the next coarser three"
    return order, f"asymptotic: the order was {before:.2f} on the next coarser three"
