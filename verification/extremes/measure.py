"""What the judge sees of a run: its frames, and the geometry of the bodies in them. It shares no code with lib/.

A body is a closed set of triangles: the outer faces of its hexahedra, each cut in four around its centre; or the two sides and the rim of
its plates, half a thickness from the middle surface. A point is inside where the winding number exceeds a half. Its depth is the distance
to the closest triangle.
"""
import base64
import re
import struct
import zlib
from pathlib import Path

import numpy as np

SIDES = np.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])  # of a hexahedron, from outside
CORNERS = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)])
TYPES = {"Float64": "<f8", "Float32": "<f4", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}
ALONG = np.linspace(0, 1, 9)[1:-1]  # where edges are sampled
INSIDE = 0.5                        # [-] winding number
MOST_AT_ONCE = 400_000              # pairs of points and triangles in one piece of work
GROUPS, MOST_TOGETHER = 6, 200      # parts of a length, and points in a group of such as lie beside each other
UNSEEN = 1e-4                       # [-] of an element: a point that is less deep counts as outside, where depths need not be exact
FEW = 12                            # triangles that are tried first
DEFORMED = "points_are_deformed"    # array of a whole file: its points stand where they are at its time


class Unreadable(Exception):
    """A file of a run is missing or is not what a driver writes; says which."""


# ------------------------------------------------------------------------------------------------
# Files

def packed(text):
    """The bytes of one inline array: base64 of a head of sizes, then base64 of blocks packed by zlib."""
    text = "".join(text.split())
    (blocks,) = struct.unpack_from("<Q", base64.b64decode(text[:12])) if text else (0,)
    if blocks == 0:
        return b""
    head = 4 * -(-8 * (3 + blocks) // 3)
    sizes = struct.unpack_from(f"<{3 + blocks}Q", base64.b64decode(text[:head]))[3:]
    body, out, at = base64.b64decode(text[head:]), [], 0
    for size in sizes:
        out.append(zlib.decompress(body[at:at + size]))
        at += size
    return b"".join(out)


def attribute(head, name):
    found = re.search(rf'\b{name}="([^"]*)"', head)
    return found.group(1) if found else None


def read_arrays(path, wanted):
    """{name: array} of the wanted arrays of a .vtu file, packed or written in digits."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise Unreadable(f"{path}: {error}") from error
    found = {}
    for match in re.finditer(r"<DataArray ([^>]*)>([^<]*)", text):
        name = attribute(match.group(1), "Name")
        if name is None or name.lower() not in wanted:
            continue
        kind = TYPES[attribute(match.group(1), "type")]
        if attribute(match.group(1), "format") == "ascii":
            data = np.array(match.group(2).split(), dtype=kind)
        else:
            data = np.frombuffer(packed(match.group(2)), dtype=kind)
        width = int(attribute(match.group(1), "NumberOfComponents") or 1)
        found[name.lower()] = data.reshape(-1, width) if width > 1 else data
    return found


class Frame:
    """Time [s], positions [nodes x 3] in m and velocities in m/s of all nodes."""

    def __init__(self, time, x, v):
        self.time, self.x, self.v = time, x, v


class Body:
    """The cells of one body: hexahedra or triangles, by nodes of the whole run."""

    def __init__(self, cells, X, density, thickness=0.0):
        self.cells, self.thickness = cells, thickness
        self.is_plate = cells.shape[1] == 3
        self.nodes = np.unique(cells)
        weights = density * (thickness * areas(X[cells]) if self.is_plate else volumes(X[cells]))
        self.mass = np.zeros(len(X))
        for corner in range(cells.shape[1]):
            np.add.at(self.mass, cells[:, corner], weights / cells.shape[1])
        self.volumes = weights / density
        self.faces, owners = (cells, np.arange(len(cells))) if self.is_plate else outer_faces(cells)
        depths = np.full(len(cells), float(thickness)) if self.is_plate else element_depths(cells, X, self.volumes)
        self.depth = float(np.min(depths))  # of the flattest element
        self.face_depth = depths[owners]    # of the element behind each face
        self.node_depth = np.full(len(X), np.inf)
        for corner in range(self.faces.shape[1]):
            np.minimum.at(self.node_depth, self.faces[:, corner], self.face_depth)


def read_frames(folder):
    """(frames, cells of each part, reference positions) of a finished run."""
    index = Path(folder) / "body.pvd"
    if not index.is_file():
        raise Unreadable(f"{index} is missing")
    listed = [(float(attribute(one, "timestep")), Path(folder) / attribute(one, "file"))
              for one in re.findall(r"<DataSet ([^>]*)/>", index.read_text(encoding="utf-8"))]
    frames, parts, X = [], {}, None
    for number, (time, path) in enumerate(listed):
        wanted = {"points", "displacement", "velocity", DEFORMED} | ({"part_id", "connectivity", "offsets"} if number == 0 else set())
        arrays = read_arrays(path, wanted)
        if "points" not in arrays:
            raise Unreadable(f"{path} holds no points")
        x = arrays["points"] if DEFORMED in arrays else arrays["points"] + arrays["displacement"]
        frames.append(Frame(time, x, arrays["velocity"].astype(float)))
        if number == 0:
            X = x - arrays["displacement"] if DEFORMED in arrays else arrays["points"]
            parts = cells_of_parts(arrays)
    return frames, parts, X


def cells_of_parts(arrays):
    """{part: [cells x corners]} of one file."""
    ends = arrays["offsets"]
    starts = np.concatenate(([0], ends[:-1]))
    found = {}
    for part in np.unique(arrays["part_id"]):
        mine = np.flatnonzero(arrays["part_id"] == part)
        found[int(part)] = np.array([arrays["connectivity"][starts[c]:ends[c]] for c in mine])
    return found


def read_history(folder):
    """{column: values} of history.csv."""
    path = Path(folder) / "history.csv"
    try:
        head, *rows = path.read_text(encoding="utf-8").splitlines()
        values = np.array([[float(entry) for entry in row.split(",")] for row in rows if row])
    except (OSError, ValueError) as error:
        raise Unreadable(f"{path}: {error}") from error
    return {name.split(" [")[0]: values[:, i] for i, name in enumerate(head.split(","))}


# ------------------------------------------------------------------------------------------------
# Elements

def jacobians(corners, at):
    """Determinants of the trilinear maps of hexahedra [cells x 8 x 3] at one place in [-1, 1]^3."""
    return np.linalg.det(gradients(corners, at))


def gradients(corners, at=(0.0, 0.0, 0.0)):
    """Of the trilinear maps of hexahedra [cells x 8 x 3] at one place in [-1, 1]^3, by default in their middle [cells x 3 x 3]."""
    r, s, t = at
    a, b, c = 1 + CORNERS[:, 0] * r, 1 + CORNERS[:, 1] * s, 1 + CORNERS[:, 2] * t
    shape = np.stack([CORNERS[:, 0] * b * c, a * CORNERS[:, 1] * c, a * b * CORNERS[:, 2]]) / 8
    return np.einsum("dk,eki->eid", shape, corners)


def logarithmic_strains(body, x, X):
    """Principal ones in the middle of a body's hexahedra, ascending [cells x 3]."""
    gradient = gradients(x[body.cells]) @ np.linalg.inv(gradients(X[body.cells]))
    return np.sort(np.log(np.linalg.svd(gradient, compute_uv=False)), axis=1)


def strain_energies(body, x, X, young, poisson):
    """Of a body's hexahedra, by Hooke's law [J]: of the logarithmic strains in their middle, and of what bends and twists them.

    Bending is how much more the lines of an element along its edges are stretched at eight points than in its middle. Each direction counts
    on its own with Young's modulus, as of a beam whose sides are free. A twist is how the angle between two directions changes along the
    third one. How this angle changes along the two directions themselves is an error of the trilinear map and does not count.
    """
    mu, lame = young / 2 / (1 + poisson), young * poisson / (1 + poisson) / (1 - 2 * poisson)
    principal = logarithmic_strains(body, x, X)
    density = mu * (principal**2).sum(axis=1) + lame / 2 * principal.sum(axis=1) ** 2

    def lines(at):
        """(logarithms of the stretches along the three edges, cosines between edges i and i + 1 less those at first) [cells x 3]."""
        logs, cosines = [], []
        for along in (gradients(x[body.cells], at), gradients(X[body.cells], at)):
            lengths = np.linalg.norm(along, axis=1)
            logs.append(np.log(lengths))
            cosines.append(np.einsum("eid,eid->ed", along, np.roll(along, -1, axis=2)) / lengths / np.roll(lengths, -1, axis=1))
        return logs[0] - logs[1], cosines[0] - cosines[1]

    points, middle = CORNERS / np.sqrt(3), lines((0.0, 0.0, 0.0))[0]
    found = [lines(at) for at in points]
    bent = np.mean([(logs - middle) ** 2 for logs, _ in found], axis=0)
    twist = 3 * np.mean([np.roll(at, -2) * cosines for at, (_, cosines) in zip(points, found)], axis=0)  # over the third direction
    density += young / 2 * bent.sum(axis=1) + mu / 2 * (twist**2).sum(axis=1) / 3
    return density * body.volumes


def above_neighbours(body, energies):
    """[J] of the energies of a body's elements: what exceeds the density of the nodes around, each with all of its elements."""
    def at_nodes(values):
        return np.bincount(body.cells.ravel(), np.repeat(values, body.cells.shape[1]), minlength=int(body.cells.max()) + 1)

    volume = at_nodes(body.volumes)
    around = at_nodes(energies) / np.where(volume > 0, volume, 1)
    return float(np.sum(np.maximum(0.0, energies - body.volumes * around[body.cells].mean(axis=1))))


def volumes(corners):
    """Of hexahedra [m3], by eight points of Gauss: exact for trilinear shapes."""
    points = CORNERS / np.sqrt(3)
    return sum(jacobians(corners, at) for at in points)


def least_corner(corners):
    """The smallest Jacobian of the eight corners of each hexahedron."""
    return np.min([jacobians(corners, at) for at in CORNERS], axis=0)


def areas(corners):
    return 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)


def element_depths(cells, X, volume):
    """Volume over largest side of each hexahedron [m]."""
    largest = np.zeros(len(cells))
    for side in SIDES:
        p = X[cells[:, side]]
        largest = np.maximum(largest, 0.5 * np.linalg.norm(np.cross(p[:, 2] - p[:, 0], p[:, 3] - p[:, 1]), axis=1))
    return volume / largest


def outer_faces(cells):
    """(the sides of hexahedra that belong to one alone, with normals outwards; whose they are)."""
    sides = cells[:, SIDES].reshape(-1, 4)
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    outer = np.sort(first[count == 1])
    return sides[outer], outer // len(SIDES)


def edges_of(faces):
    """Each edge of the faces once."""
    pairs = np.concatenate([np.stack([faces[:, i], faces[:, (i + 1) % faces.shape[1]]], axis=1) for i in range(faces.shape[1])])
    return np.unique(np.sort(pairs, axis=1), axis=0)


# ------------------------------------------------------------------------------------------------
# Closed surfaces

def in_four(corners):
    """Triangles [4n x 3 x 3] of quadrilaterals [n x 4 x 3], around their centres."""
    centre = corners.mean(axis=1)
    return np.concatenate([np.stack([corners[:, i], corners[:, (i + 1) % 4], centre], axis=1) for i in range(4)])


def node_normals(faces, x):
    """Unit normals of the nodes of triangles, weighted by area."""
    normal = np.cross(x[faces[:, 1]] - x[faces[:, 0]], x[faces[:, 2]] - x[faces[:, 0]])
    total = np.zeros_like(x)
    for corner in range(3):
        np.add.at(total, faces[:, corner], normal)
    length = np.linalg.norm(total, axis=1)
    return total / np.where(length > 0, length, 1)[:, None]


def rim_of(faces):
    """Edges of triangles that belong to one alone, in its direction."""
    directed = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, inverse, count = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
    return directed[count[inverse] == 1]


def closed_surface(body, x):
    """Triangles [n x 3 x 3] around a body."""
    if not body.is_plate:
        return in_four(x[body.faces])
    way = node_normals(body.faces, x) * body.thickness / 2
    above, below, rim = x + way, x - way, rim_of(body.faces)
    walls = np.stack([below[rim[:, 0]], below[rim[:, 1]], above[rim[:, 1]], above[rim[:, 0]]], axis=1)
    return np.concatenate([above[body.faces], below[body.faces[:, ::-1]], in_four(walls)])


def layers(body, x):
    """Positions of the nodes of a solid; of a plate on its two sides."""
    if not body.is_plate:
        return [x]
    way = node_normals(body.faces, x) * body.thickness / 2
    return [x + way, x - way]


def samples(body, x):
    """Points on the surface of a body: nodes, points along its edges, middles of its faces."""
    edges = edges_of(body.faces)
    found = []
    for at in layers(body, x):
        a, b = at[edges[:, 0]], at[edges[:, 1]]
        found += [at[np.unique(body.faces)], at[body.faces].mean(axis=1), *(a + s * (b - a) for s in ALONG)]
    return np.concatenate(found)


def between_crossings(body, x, triangles):
    """(points, depths of the flattest elements there [m]): the middles of those pieces of a body's edges that two crossings of a surface
    bound. What is much thinner than an edge is long lies between two samples."""
    edges = edges_of(body.faces)
    along = body.node_depth[edges].min(axis=1)
    points, sizes = [np.zeros((0, 3))], [np.zeros(0)]
    for at in layers(body, x):
        a, b = at[edges[:, 0]], at[edges[:, 1]]
        line, _, where = crossings(a, b, triangles)
        part = np.einsum("ni,ni->n", where - a[line], (b - a)[line])
        order = np.lexsort((part, line))
        line, where = line[order], where[order]
        same = line[1:] == line[:-1]
        points.append(((where[1:] + where[:-1]) / 2)[same])
        sizes.append(along[line[1:][same]])
    return np.concatenate(points), np.concatenate(sizes)


def depths_of_samples(body):
    """Beside samples(): the depth of the flattest element there [m]."""
    edges = edges_of(body.faces)
    along = body.node_depth[edges].min(axis=1)
    once = np.concatenate([body.node_depth[np.unique(body.faces)], body.face_depth, *(along for _ in ALONG)])
    return np.tile(once, 2 if body.is_plate else 1)


def depths_of_triangles(body, triangles):
    """Beside closed_surface(): the depth of the element behind [m]."""
    if body.is_plate:
        return np.full(len(triangles), body.thickness)
    return np.tile(body.face_depth, 4)


def winding_numbers(points, triangles):
    """How often the triangles go around each point."""
    a, b, c = (triangles[None, :, k] - points[:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(one, axis=2) for one in (a, b, c))
    above = np.einsum("pti,pti->pt", a, np.cross(b, c))
    below = la * lb * lc + np.einsum("pti,pti->pt", a, b) * lc + np.einsum("pti,pti->pt", b, c) * la + np.einsum("pti,pti->pt", c, a) * lb
    return np.arctan2(above, below).sum(axis=1) / (2 * np.pi)


def distances(points, triangles):
    """From each point to the closest triangle [m]."""
    return all_distances(points, triangles).min(axis=1)


def all_distances(points, triangles):
    """From each point to each triangle [m]."""
    a, b, c = (triangles[None, :, k] for k in range(3))
    p = points[:, None]
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    square = np.einsum("ti,ti->t", normal, normal)
    solid = square > 0
    unit = normal / np.sqrt(np.where(solid, square, 1))[:, None]
    within = np.broadcast_to(solid, (len(points), len(triangles))).copy()
    best = np.full(within.shape, np.inf)
    for one, other in ((a, b), (b, c), (c, a)):
        edge = other - one
        away = p - one
        within &= np.einsum("pti,ti->pt", away, np.cross(normal, edge[0])) >= 0
        length = np.maximum(np.einsum("ti,ti->t", edge[0], edge[0]), 1e-300)
        along = np.clip(np.einsum("pti,ti->pt", away, edge[0]) / length, 0, 1)
        best = np.minimum(best, np.linalg.norm(away - along[..., None] * edge, axis=2))
    height = np.abs(np.einsum("pti,ti->pt", p - a, unit))
    return np.where(within, height, best)


def in_pieces(function, points, triangles):
    """A function of points and triangles, a piece of the points at a time."""
    size = max(1, MOST_AT_ONCE // max(1, len(triangles)))
    parts = [function(points[i:i + size], triangles) for i in range(0, len(points), size)]
    return np.concatenate(parts) if parts else np.zeros(0)


def which_inside(points, triangles, sizes=None):
    """Places of those of the points that the triangles enclose; with sizes [m], of those that are deeper than UNSEEN of theirs."""
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    near = np.flatnonzero(np.all((points > low) & (points < high), axis=1))
    if sizes is not None:
        near = near[closest(points[near], triangles)[:, 0] > UNSEEN * sizes[near]]
    return near[in_pieces(winding_numbers, points[near], triangles) > INSIDE] if len(near) else near


def points_inside(points, triangles):
    """Those of the points that the triangles enclose."""
    return points[which_inside(points, triangles)]


def closest(points, triangles):
    """For each point the distance to the closest triangle [m], and which that is. Points that lie together are held against those triangles
    alone that can be closest to one of them."""
    found = np.zeros((len(points), 2))
    first, last = triangles.min(axis=1), triangles.max(axis=1)
    rounding = 1e-12 * max(float(np.abs(triangles).max()), float(np.abs(points).max(initial=0.0)))
    for some in together(points):
        low, high = points[some].min(axis=0), points[some].max(axis=0)
        apart = np.linalg.norm(np.maximum(np.maximum(first - high, low - last), 0), axis=1)
        likely = np.argpartition(apart, min(FEW, len(apart) - 1))[:FEW]
        most = float(all_distances(points[some], triangles[likely]).min(axis=1).max())
        near = np.flatnonzero(apart <= most * (1 + 1e-9) + rounding)
        away = all_distances(points[some], triangles[near])
        found[some] = np.stack([away.min(axis=1), near[away.argmin(axis=1)]], axis=1)
    return found


def together(points):
    """The places of points in groups of such as lie beside each other."""
    if not len(points):
        return []
    size = max(float(np.ptp(points, axis=0).max()), 1e-300)
    place = np.floor((points - points.min(axis=0)) / (size / GROUPS))
    order = np.lexsort(place.T)
    groups = np.split(order, np.flatnonzero(np.any(np.diff(place[order], axis=0) != 0, axis=1)) + 1)
    return [group[i:i + MOST_TOGETHER] for group in groups for i in range(0, len(group), MOST_TOGETHER)]


def depth_in(body, other, x, triangles, base, room, allowed, exact=True):
    """(deepest below the closest triangle [m], deepest below the base triangles [m], largest part of an element) of a body's points
    in another. The element is the flatter one of those at the point and behind the triangle, or what room there is; the part is of
    what is deeper than allowed."""
    pieces, sizes = between_crossings(body, x, triangles)
    points, sizes = np.concatenate([samples(body, x), pieces]), np.concatenate([depths_of_samples(body), sizes])
    inside = which_inside(points, triangles, None if exact else np.minimum(sizes, room))
    if not len(inside):
        return 0.0, 0.0, 0.0
    found = closest(points[inside], triangles)
    depth, at = found[:, 0], found[:, 1].astype(int)
    deepest = float(depth.max())
    size = np.minimum(np.minimum(sizes[inside], depths_of_triangles(other, triangles)[at]), room)
    below = deepest if base is None or not len(base) else float(closest(points[inside], base)[:, 0].max())
    return deepest, below, float(np.max((depth - allowed) / size))


def overlap(one, other, x, bases=(None, None), room=np.inf, allowed=0.0, exact=True):
    """(deepest [m], deepest below the named surfaces [m], largest part of an element) of two bodies in each other; bases: faces of
    each, or None; room: how deep a point can be [m]; allowed: [m] what does not count for the part; exact: depths below UNSEEN count."""
    first, second = closed_surface(one, x), closed_surface(other, x)
    if np.any(first.max(axis=(0, 1)) < second.min(axis=(0, 1))) or np.any(second.max(axis=(0, 1)) < first.min(axis=(0, 1))):
        return 0.0, 0.0, 0.0
    named = [None if faces is None else in_four(x[faces]) if faces.shape[1] == 4 else x[faces] for faces in bases]
    a = depth_in(one, other, x, second, named[1], room, allowed, exact)
    b = depth_in(other, one, x, first, named[0], room, allowed, exact)
    through = max(through_plate(one, other, x), through_plate(other, one, x))
    part = (through - allowed) / min(one.depth, other.depth, room)
    return max(a[0], b[0], through), max(a[1], b[1], through), max(a[2], b[2], part, 0.0)


def through_plate(body, plate, x):
    """How far edges of a body have come through the middle of a plate and half its thickness, or from its rim [m]: of a corner no point of
    the plate need be in the body. An edge that a crease of the plate cuts twice is no farther behind it than between the two."""
    if not plate.is_plate:
        return 0.0
    edges, rim = edges_of(body.faces), rim_of(plate.faces)
    a, b = x[edges[:, 0]], x[edges[:, 1]]
    line, beyond, at = crossings(a, b, x[plate.faces])
    if not len(beyond):
        return 0.0
    for one in np.flatnonzero(np.bincount(line) % 2 == 0):
        mine = np.flatnonzero(line == one)
        if not len(mine):
            continue
        mine = mine[np.argsort((at[mine] - a[one]) @ (b[one] - a[one]))]
        for first, last in zip(mine[::2], mine[1::2]):
            points = at[first] + np.array([[0.25], [0.5], [0.75]]) * (at[last] - at[first])
            behind = float(distances(points, x[plate.faces]).max())
            beyond[[first, last]] = np.minimum(beyond[[first, last]], behind)
    from_rim = distances(at, x[rim[:, [0, 1, 1]]]) if len(rim) else np.inf
    return float(np.max(np.minimum(beyond + plate.thickness / 2, from_rim)))


def depth_of_rounded(plate, other, x):
    """How deep the nodes of a plate are in another body if each is a ball of the plate's thickness, as where a rim is round [m]."""
    triangles, points = closed_surface(other, x), x[plate.nodes]
    away = closest(points, triangles)[:, 0]
    away[which_inside(points, triangles)] *= -1
    return float(np.max(plate.thickness / 2 - away))


def room(body, x):
    """How deep a point can be inside a body [m]: the largest distance of a node or of an element's middle from its surface."""
    if body.is_plate:
        return body.thickness / 2
    points = np.concatenate([x[body.nodes], x[body.cells].mean(axis=1)])
    return float(closest(points, in_four(x[body.faces]))[:, 0].max())


# ------------------------------------------------------------------------------------------------
# A body and itself

def self_overlap(body, x):
    """How far an edge of a body goes behind one of its own faces that it has no node in common with [m]."""
    edges = edges_of(body.faces)
    if body.is_plate:
        triangles, owners = x[body.faces], body.faces
    else:
        triangles, owners = in_four(x[body.faces]), np.concatenate([body.faces] * 4)

    def apart(e, t):
        return ~np.any(edges[e][:, :, None] == owners[t][:, None, :], axis=(1, 2))

    return float(pierced(x[edges[:, 0]], x[edges[:, 1]], triangles, apart)[0].max(initial=0.0))


def pierced(a, b, triangles, counts=None):
    """Where lines from a to b cross triangles: (how far the nearer end is from the triangle's plane [m], the points).

    counts(line, triangle) says which pairs are looked at.
    """
    _, nearer, at = crossings(a, b, triangles, counts)
    return nearer, at


def crossings(a, b, triangles, counts=None):
    """The same with the lines: (which line, how far its nearer end is [m], the point)."""
    low, high = np.minimum(a, b), np.maximum(a, b)
    first, last = triangles.min(axis=1), triangles.max(axis=1)
    lines, those = [np.zeros(0, dtype=int)], [np.zeros(0, dtype=int)]
    for some in together((a + b) / 2):
        near = np.flatnonzero(np.all((low[some].min(axis=0) < last) & (high[some].max(axis=0) > first), axis=1))
        e, t = np.nonzero(np.all((low[some][:, None] < last[near][None]) & (high[some][:, None] > first[near][None]), axis=2))
        lines.append(some[e])
        those.append(near[t])
    e, t = np.concatenate(lines), np.concatenate(those)
    order = np.lexsort((t, e))
    e, t = e[order], t[order]
    if counts is not None:
        kept = counts(e, t)
        e, t = e[kept], t[kept]
    corners = triangles[t]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(normal, axis=1)
    unit = normal / np.where(size > 0, size, 1)[:, None]
    ha, hb = (np.einsum("ni,ni->n", p - corners[:, 0], unit) for p in (a[e], b[e]))
    crosses = (ha * hb < 0) & (size > 0)
    at = a[e] + (ha / np.where(crosses, ha - hb, 1))[:, None] * (b[e] - a[e])
    for k in range(3):
        side = np.cross(corners[:, (k + 1) % 3] - corners[:, k], at - corners[:, k])
        crosses &= np.einsum("ni,ni->n", side, normal) > 0
    return e[crosses], np.minimum(np.abs(ha), np.abs(hb))[crosses], at[crosses]


def inside_out(body, x, X):
    """The least Jacobian of any corner of a body's hexahedra over the mean one of its element in the reference."""
    if body.is_plate:
        return 1.0
    return float(np.min(least_corner(x[body.cells]) / (volumes(X[body.cells]) / 8)))
