"""How near a folded strip comes to itself, from the places of its nodes alone."""
from math import hypot


def distance(p, q, a, b):
    """Of two segments p-q and a-b in the plane that do not cross.

    >>> distance((0, 0), (1, 0), (0, 2), (1, 3))
    2.0
    >>> round(distance((0, 0), (1, 0), (2, 1), (3, 5)), 6)
    1.414214
    """
    def to_point(point, start, end):
        along = (end[0] - start[0], end[1] - start[1])
        u = ((point[0] - start[0]) * along[0] + (point[1] - start[1]) * along[1]) / (along[0] ** 2 + along[1] ** 2)
        u = min(1.0, max(0.0, u))
        return hypot(point[0] - start[0] - u * along[0], point[1] - start[1] - u * along[1])
    return min(to_point(p, a, b), to_point(q, a, b), to_point(a, p, q), to_point(b, p, q))


def nearest(places, apart):
    """The smallest distance of a line of nodes from itself, between segments that are so many apart in their order.

    >>> nearest([(0, 0), (1, 0), (2, 0), (2, 1), (1, 1), (0, 1)], 3)
    1.0
    """
    segments = list(zip(places, places[1:]))
    return min(distance(*one, *other) for i, one in enumerate(segments) for other in segments[i + apart:])
