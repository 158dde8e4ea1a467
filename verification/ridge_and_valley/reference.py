"""An apex carried over a ridge, through a valley, over a vertex: where it is, and the force that it must have.

Planes through the origin, with unit normals that point out of a solid, bound the solid. It is convex where all planes have it behind
them (ridge, peak: the solid is what lies behind every plane), or its outside is (valley, pit: outside is what lies before every plane).
An apex must not come nearer than the contact height. It is pushed the shortest way to where it may be, with the penalty times its area
times that way. A point goes the shortest way to a set bounded by planes if it goes to the foot on one plane, on the line of two, or to the
point of three: all are tried, and the shortest that ends in the set is taken.
"""
from functools import lru_cache
from itertools import combinations
from math import cos, radians, sin, sqrt


@lru_cache(maxsize=None)
def flanks(kind, slope):
    """Unit normals of the flanks of a ridge or valley along y, or of a peak or pit with four flanks, that slope by `slope` degrees.

    >>> [[round(c, 6) for c in n] for n in flanks("ridge", 45)]
    [[-0.707107, 0.0, 0.707107], [0.707107, 0.0, 0.707107]]
    """
    outward = 1 if kind in ("ridge", "peak") else -1
    a, up = outward * sin(radians(slope)), cos(radians(slope))
    if kind in ("ridge", "valley"):
        return [(-a, 0.0, up), (a, 0.0, up)]
    return [(x * a / sqrt(2), y * a / sqrt(2), up) for x in (-1, 1) for y in (-1, 1)]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def solved(matrix, right):
    """A small system of equations by Gauss's elimination; None where it is singular."""
    rows = [[*row, b] for row, b in zip(matrix, right)]
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda k: abs(rows[k][i]))
        if abs(rows[pivot][i]) < 1e-12:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(len(rows)):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [row[-1] / row[i] for i, row in enumerate(rows)]


def shortest_way(x, normals, height):
    """From x to where n.x >= height for all normals.

    >>> shortest_way((0, 0, -1.0), [(0, 0, 1.0)], 0.5)
    (0.0, 0.0, 1.5)
    >>> [round(c, 6) for c in shortest_way((0, 0, 0), flanks("valley", 45), 1)]  # to the line where both flanks are at the height 1
    [0.0, 0.0, 1.414214]
    """
    lacks = [height - dot(n, x) for n in normals]
    if max(lacks) <= 0:
        return 0.0, 0.0, 0.0
    best = None
    for count in range(1, 4):
        for active in combinations(range(len(normals)), count):
            parts = solved([[dot(normals[i], normals[j]) for j in active] for i in active], [lacks[i] for i in active])
            if parts is None:
                continue
            way = tuple(sum(p * normals[i][c] for p, i in zip(parts, active)) for c in range(3))
            if all(dot(n, way) >= lack - 1e-12 - 1e-9 * abs(lack) for n, lack in zip(normals, lacks)):
                if best is None or dot(way, way) < dot(best, best):
                    best = way
    return best


@lru_cache(maxsize=None)
def penetration(kind, slope, contact_height, x):
    """The shortest way from x to where no flank is nearer than the contact height: a vector of the length of the penetration.

    >>> [round(c, 6) for c in penetration("ridge", 45, 0, (-0.1, 0, -1))]   # behind both flanks: out through the nearer one
    [-0.45, 0.0, 0.45]
    >>> round(penetration("ridge", 45, 3, (0, 0, 2))[2], 6)                 # over the ridge: away from it
    1.0
    >>> [round(c, 6) for c in penetration("valley", 45, 0, (0, 0, -1))]     # below the valley: to its line, not by the sum of both
    [0.0, 0.0, 1.0]
    >>> penetration("valley", 45, 0, (0, 0, 1))
    (0.0, 0.0, 0.0)
    """
    normals = flanks(kind, slope)
    if kind == "valley" and contact_height > 0 and dot(*normals) < -1e-6:  # flanks that face each other push each on its own
        return tuple(sum(max(0.0, contact_height - dot(n, x)) * n[c] for n in normals) for c in range(3))
    if kind in ("valley", "pit"):
        return shortest_way(x, normals, contact_height)
    nearest = max(normals, key=lambda n: dot(n, x))
    if dot(nearest, x) <= 0:
        return tuple((contact_height - dot(nearest, x)) * c for c in nearest)
    outside = shortest_way(x, [tuple(-c for c in n) for n in normals], 0.0)  # to the solid
    distance = sqrt(dot(outside, outside))
    return tuple(-max(0.0, contact_height - distance) / distance * c for c in outside)


def way_back(slope, x):
    """Of an apex that came through the left flank of a ridge, and goes back through that flank wherever it is: straight out of its plane.

    >>> [round(c, 6) for c in way_back(45, (1, 0, -2))]   # 1.5 sqrt(2) from the left flank, the right one being nearer
    [-1.5, 0.0, 1.5]
    """
    left = flanks("ridge", slope)[0]
    return tuple(max(0.0, -dot(left, x)) * c for c in left)


def force(kind, slope, contact_height, stiffness, apexes):
    """Sum of the forces on apexes that each have this stiffness, penalty times area. [N]

    >>> [round(c, 6) for c in force("ridge", 45, 0, 100, [(-1, 0, -2), (1, 0, -2)])]
    [0.0, 0.0, 100.0]
    """
    ways = [penetration(kind, slope, contact_height, x) for x in apexes]
    return tuple(stiffness * sum(way[c] for way in ways) for c in range(3))


def path(kind, slope, contact_height, depth, before, above):
    """(start, angle at the start, radius) of a path at a constant depth over a ridge or valley, in x and z.

    The path starts `above` over where contact begins, and goes down along the normal of the left flank to the depth. Then it follows
    the flank for the length `before` up to the turn. That is an arc: about the ridge with what is left of the contact height as its radius,
    or about the line where both flanks of a valley are at the contact height, with the depth as its radius. A ridge without contact
    height turns at once: its radius is zero.

    >>> start, angle, radius = path("ridge", 45, 0, 1, 0, 0)
    >>> [round(c, 6) for c in start], round(angle, 6), radius
    ([-0.707107, -0.707107], 0.785398, 0.0)
    >>> [round(c, 6) for c in path("valley", 45, 0, 1, 0, 0)[0]], path("ridge", 45, 3, 1, 6, 0)[2]
    ([0.0, 0.0], 2)
    """
    a = radians(slope)
    if kind == "ridge":
        normal, along, radius, angle = (-sin(a), cos(a)), (cos(a), sin(a)), max(0.0, contact_height - depth), a
        turn = tuple(radius * c for c in normal) if radius > 0 else (0.0, (contact_height - depth) / cos(a))
    else:
        normal, along, radius, angle = (sin(a), cos(a)), (cos(a), -sin(a)), depth, -a
        turn = tuple(o - depth * c for o, c in zip((0.0, contact_height / cos(a)), normal))
    return tuple(p - before * t + (depth + above) * n for p, t, n in zip(turn, along, normal)), angle, radius
