"""Figures of a contact element, in space: Figs. 1 and 2 of Kulak & Fiala."""
import numpy as np

from figure import PolyCollection, plt, use_style


def unit(vector):
    return vector / np.linalg.norm(vector)


def seen_from(azimuth, elevation):
    """The plane of projection of an eye far away, angles in degrees: points [... x 3] to across, up and depth towards the eye."""
    a, e = np.radians(azimuth), np.radians(elevation)
    across, towards = np.array([np.cos(a), np.sin(a), 0]), np.array([np.sin(a) * np.cos(e), -np.cos(a) * np.cos(e), np.sin(e)])
    return np.array([across, np.cross(towards, across), towards])


class Drawing:
    """A line drawing in space: everything is projected, and lies on paper in the order in which it is drawn."""

    def __init__(self, width, height, azimuth, elevation):
        use_style()
        self.figure, self.axes = plt.subplots(figsize=(width / 25.4, height / 25.4), constrained_layout=True)
        self.axes.set_aspect("equal")
        self.axes.axis("off")
        self.plane = seen_from(azimuth, elevation)

    def flat(self, points):
        return np.asarray(points) @ self.plane[:2].T

    def faces(self, faces, face, edge="#8c8c8c", width=0.5, alpha=1.0):
        """Polygons [faces x corners x 3] that look to the eye, the farthest first."""
        normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        order = np.argsort(faces.mean(axis=1) @ self.plane[2])
        seen = [self.flat(faces[f]) for f in order if normals[f] @ self.plane[2] > 0]
        self.axes.add_collection(PolyCollection(seen, facecolor=face, edgecolor=edge, linewidth=width, alpha=alpha))
        self.axes.autoscale_view()

    def line(self, points, **style):
        flat = self.flat(points)
        self.axes.plot(flat[:, 0], flat[:, 1], **{"color": "black", "linewidth": 1.0, "solid_capstyle": "round", **style})

    def point(self, at, **style):
        self.line([at], **{"marker": "o", "markersize": 4.5, "linestyle": "none", **style})

    def arrow(self, start, end, color="black", width=1.1):
        self.axes.annotate("", self.flat(end), self.flat(start), zorder=5,
                           arrowprops={"arrowstyle": "-|>,head_width=0.16,head_length=0.4", "color": color, "linewidth": width,
                                       "shrinkA": 0, "shrinkB": 0})

    def text(self, at, words, dx=0.0, dy=0.0, **style):
        """Words beside a point, by an offset in points of type."""
        self.axes.annotate(words, self.flat(at), xytext=(dx, dy), textcoords="offset points",
                           **{"ha": "center", "va": "center", "fontsize": 11, "zorder": 6, **style})


BASE, NORMAL, EDGE = "#0072B2", "#D55E00", "#009E73"


def element_figure(element, skins):
    """Fig. 1 of Kulak & Fiala: a contact element between two bodies, its base 1-2-3, its apex 4 and its height.

    element  corners [3 x 3], apex and foot [mm] as the program wrote them
    skins    faces [faces x 4 x 3] of the body of the base and of that of the apex [mm]
    """
    corner, apex, foot = element["corners"], element["apex"], element["foot"]
    normal = unit(np.cross(corner[1] - corner[0], corner[2] - corner[0]))
    drawing = Drawing(120, 96, azimuth=-40, elevation=24)
    drawing.faces(skins[0], "#f2f2f2")
    drawing.faces(corner[None], "#cfe3f1", edge=BASE, width=1.4)
    drawing.line([foot, apex], color=NORMAL, linestyle=(0, (4, 2)), linewidth=1.2)
    drawing.faces(skins[1], "#fbf3e2", alpha=0.72)
    for at in corner:
        drawing.line([at, apex], color=BASE, linewidth=1.0)
    size = np.linalg.norm(corner[1] - corner[0])
    drawing.arrow(foot, foot + 0.24 * size * normal, NORMAL, 1.4)
    for number, at in enumerate(corner):
        drawing.point(at, color=BASE)
        out = unit(drawing.flat(at) - drawing.flat(corner.mean(axis=0)))
        drawing.text(at, str(number + 1), 9 * out[0], 9 * out[1])
    drawing.point(apex, color="black")
    drawing.text(apex, "4", -9, 3)
    drawing.point(foot, color=NORMAL, markersize=3)
    drawing.text(foot + 0.52 * (apex - foot), "$h$", -7, 0, color=NORMAL)
    drawing.text(foot + 0.12 * size * normal, "$n$", -7, -6, color=NORMAL)
    return drawing.figure


def edge_normals(element):
    """The vectors of Eqs. (13), (14): sides L_12, L_23, L_31, ways L_14, L_24, L_34 to the apex, N = n x L, and L . N."""
    corner = element["corners"]
    sides = np.array([corner[(I + 1) % 3] - corner[I] for I in range(3)])
    ways = element["apex"] - corner
    normal = unit(np.cross(sides[0], -sides[2]))
    edge = np.cross(normal, sides)
    return normal, sides, ways, edge, np.einsum("ij,ij->i", ways, edge)


def connectivity_figure(element):
    """Fig. 2 of Kulak & Fiala: the vectors that tell whether the apex projects within its base, Eqs. (13) and (14)."""
    corner, apex, foot = element["corners"], element["apex"], element["foot"]
    normal, sides, ways, edge, _ = edge_normals(element)
    middle = corner.mean(axis=0)
    drawing = Drawing(120, 92, azimuth=-9, elevation=36)
    drawing.faces(corner[None], "#eef5fa", edge="none")
    for I in range(3):
        drawing.arrow(corner[I], corner[I] + sides[I], BASE, 1.4)
        drawing.arrow(corner[I], apex, "#555555", 0.9)
        # N is as long as its side; a third of it is drawn
        start = corner[I] + 0.5 * sides[I]
        drawing.arrow(start, start + edge[I] / 3, EDGE, 1.4)
    drawing.line([foot, apex], color=NORMAL, linestyle=(0, (4, 2)), linewidth=0.9)
    size = np.linalg.norm(sides[0])
    drawing.arrow(middle, middle + 0.25 * size * normal, NORMAL, 1.4)
    drawing.text(middle + 0.17 * size * normal, "$n$", 7, 0, color=NORMAL)
    for I in range(3):
        J = (I + 1) % 3
        out = unit(drawing.flat(corner[I]) - drawing.flat(middle))
        drawing.point(corner[I], color="black")
        drawing.text(corner[I], str(I + 1), 11 * out[0], 11 * out[1])
        aside = unit(drawing.flat(corner[I] + 0.5 * sides[I]) - drawing.flat(middle))
        drawing.text(corner[I] + 0.3 * sides[I], f"$L_{{{I + 1}{J + 1}}}$", 13 * aside[0], 13 * aside[1], color=BASE)
        drawing.text(corner[I] + 0.5 * sides[I] + edge[I] / 3, f"$N_{{{I + 1}{J + 1}}}$", -10 * aside[0], -10 * aside[1], color=EDGE)
        along = unit(drawing.flat(ways[I]))
        beside = np.array([along[1], -along[0]])
        beside *= np.sign(beside @ drawing.flat(corner[I] - foot))  # on the side away from the height
        drawing.text(corner[I] + 0.65 * ways[I], f"$L_{{{I + 1}4}}$", 13 * beside[0], 13 * beside[1], color="#333333")
    drawing.point(apex, color="black")
    drawing.text(apex, "4", 0, 9)
    drawing.point(foot, color=NORMAL, markersize=3)
    return drawing.figure
