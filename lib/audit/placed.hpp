#pragma once
// A surface where it stands now, and what can be asked of it: crossed edges, sides, distances.

#include <algorithm>
#include <array>
#include <limits>

#include "audit/surfaces.hpp"
#include "geometry/closest.hpp"

namespace nereid::audit {

/// As Eigen's, which is a header of its own.
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

struct Box {
  Vec3 low, high;  ///< [m]
};

inline bool meet(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}
inline bool holds(const Box& box, const Vec3& p) { return (box.low.array() <= p.array()).all() && (p.array() <= box.high.array()).all(); }

/// Positions of a surface and the boxes around its triangles.
struct Placed {
  Vectors at;              ///< [m] points, then centres of the faces of four corners
  Scalars half;            ///< [m] [points] half the thickness of plates, as Surface::half
  Vectors normals;         ///< [m2] of the points of a skin or shell: of the faces around each, added up
  Scalars open, open_at;   ///< [m] [faces] what a face leaves open, see left_open(); [points] the most of the faces around
  std::vector<Box> looks;  ///< [-] beside Surface::tree: around the unit normals of its triangles
  std::vector<Box> boxes;  ///< beside Surface::tree; a little larger than what they hold
  geometry::PlacedRound round;  ///< where Surface::round stands
  bool finite = false;     ///< whether all positions are numbers; if not, nothing may be asked
};

Placed make_placed(const Surface&);

/// Brings positions and boxes up to date; allocates nothing. The points of a shell stand off the mid-surface by half the thickness, along
/// the normals of the plates around them, weighted by area.
///
/// x            [m] of all nodes of the mesh
/// half_growth  [m] of all nodes too: by which half the thickness of plates has grown since the start; empty where it has not
void place(const Surface&, const Vectors& x, Placed&, const Scalars& half_growth = {});


inline Vec3 corner(const Surface& surface, const Placed& placed, Index triangle, int i) {
  return placed.at.col(surface.triangles(i, triangle));
}

/// The normal of a triangle, twice its area long. [m2]
inline Vec3 normal(const Surface& surface, const Placed& placed, Index triangle) {
  const Vec3 a = corner(surface, placed, triangle, 0);
  return cross(corner(surface, placed, triangle, 1) - a, corner(surface, placed, triangle, 2) - a);
}

/// The normal of a face, from its diagonals or sides, twice its area long. [m2]
Vec3 face_normal(const Surface&, const Placed&, Index face);

/// How far a face may be from the surface that its nodes stand for: half of what its two diagonals are apart, and the sagitta of an arc
/// over it and the face beside it, where these are at an angle t of less than 60 degrees. [m]
///
///     max(|a - b + c - d| / 4,  w |n - n'| / 8),   w the width of the face across that side,  |n - n'| = 2 sin(t/2)
double left_open(const Surface&, const Placed&, Index face);

/// How often a skin goes around a point: 1 inside, 0 outside, more where the skin overlaps itself.
///
///     sum over the triangles that a ray from p meets of +1 where it leaves and -1 where it enters
///
/// Both triangles at an edge decide by the same numbers on which side of it the ray passes, so it never slips through between them,
/// and a point is on the wrong side only if it is within round-off of the skin.
int winding(const Surface&, const Placed&, const Vec3& p);

/// What is closest to a point.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]; infinite if there is nothing
  Index triangle = -1;
  bool on_rim = false;     ///< the closest point lies on the rim of a sheet
  Vec3 foot = Vec3::Zero();  ///< [m] the closest point
};

namespace detail {

struct Stack {  // of a tree that halves its triangles: twice as deep as any Index needs
  std::array<Index, 72> node;
  int count = 0;
};

inline double distance_squared(const Box& box, const Vec3& p) {
  return (box.low - p).cwiseMax(p - box.high).cwiseMax(0).squaredNorm();
}

inline bool is_met(const Box& box, const Vec3& p, const Vec3& inverse, double most) {
  double near = 0, far = most;
  for (int i = 0; i < 3; ++i) {
    const double a = (box.low(i) - p(i)) * inverse(i), b = (box.high(i) - p(i)) * inverse(i);
    const double first = a < b ? a : b, last = a < b ? b : a;
    if (first > near) near = first;
    if (last < far) far = last;
  }
  return near <= far;
}

inline Vector<double> vector(const Vec3& a) { return {a.x(), a.y(), a.z()}; }

/// Whether a closest point lies on the rim.
inline bool is_on_rim(const Surface& surface, Index triangle, const geometry::Closest& closest) {
  if (closest.kind == geometry::Kind::edge) return surface.rim[triangle][closest.local];
  return closest.kind == geometry::Kind::vertex && surface.on_rim[surface.triangles(closest.local, triangle)] != 0;
}

}  // namespace detail

/// The closest point of those triangles that `counts(triangle)` takes.
///
/// enough  [m] the search may end with any triangle that is as close as that: nobody asks for a smaller depth
template <class Counts>
Nearest nearest(const Surface& surface, const Placed& placed, const Vec3& p, double enough, Counts&& counts) {
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  if (surface.tree.nodes.empty()) return best;
  const double stop = enough * enough;
  const Vector<double> at = detail::vector(p);
  detail::Stack stack;
  stack.node[stack.count++] = 0;
  while (stack.count > 0) {
    const Index here = stack.node[--stack.count];
    if (!(detail::distance_squared(placed.boxes[here], p) < least)) continue;
    const Tree::Node& node = surface.tree.nodes[here];
    if (node.second != 0) {
      const bool second_first =
          detail::distance_squared(placed.boxes[node.second], p) < detail::distance_squared(placed.boxes[here + 1], p);
      stack.node[stack.count++] = second_first ? here + 1 : node.second;
      stack.node[stack.count++] = second_first ? node.second : here + 1;
      continue;
    }
    for (Index t = node.first; t < node.last; ++t) {
      if (!counts(t)) continue;
      const Vec3 a = corner(surface, placed, t, 0), b = corner(surface, placed, t, 1), c = corner(surface, placed, t, 2);
      const geometry::Closest closest = geometry::closest_on_triangle({detail::vector(a), detail::vector(b), detail::vector(c)}, at);
      if (!(closest.distance_squared < least)) continue;
      least = closest.distance_squared;
      best.triangle = t;
      best.on_rim = !surface.closed && detail::is_on_rim(surface, t, closest);
      best.foot = closest.weight[0] * a + closest.weight[1] * b + closest.weight[2] * c;
      if (least <= stop) return best.distance = std::sqrt(least), best;
    }
  }
  best.distance = std::sqrt(least);
  return best;
}

/// Whether all normals of a part of the tree look to one side: it does not go through itself.
inline bool is_flat(const Placed& placed, Index node) {
  const Vec3 middle = placed.looks[node].high + placed.looks[node].low, half = placed.looks[node].high - placed.looks[node].low;
  return middle.squaredNorm() > middle.cwiseAbs().dot(half);
}

/// Calls found(triangle, s) for each triangle that `counts(triangle)` takes and that the edge from a to b crosses or touches, at
/// a + s (b - a); an edge in the plane of a triangle does not cross it.
///
/// owner  a triangle that has the edge, if it is of the same surface: parts that look to one side with it are passed over; else -1
template <class Counts, class Found>
void crossings(const Surface& surface, const Placed& placed, const Vec3& a, const Vec3& b, Index owner, Counts&& counts,
               Found&& found) {
  constexpr double round_off = 1e-9;  // [-] what is as near to a border as that is on it: a crossing twice does no harm, none does
  if (surface.tree.nodes.empty()) return;
  const Vec3 way = b - a, inverse = way.cwiseInverse();
  detail::Stack stack;
  stack.node[stack.count++] = 0;
  while (stack.count > 0) {
    const Index here = stack.node[--stack.count];
    if (!detail::is_met(placed.boxes[here], a, inverse, 1)) continue;
    const Tree::Node& node = surface.tree.nodes[here];
    if (owner >= node.first && owner < node.last && is_flat(placed, here)) continue;
    if (node.second != 0) {
      stack.node[stack.count++] = node.second;
      stack.node[stack.count++] = here + 1;
      continue;
    }
    for (Index t = node.first; t < node.last; ++t) {
      if (!counts(t)) continue;
      const Vec3 p = corner(surface, placed, t, 0) - a;
      const Vec3 u = corner(surface, placed, t, 1) - a - p, v = corner(surface, placed, t, 2) - a - p, n = cross(u, v);
      const double height = p.dot(n), down = way.dot(n), square = n.squaredNorm();
      if (!(square > 0) || down == 0) continue;
      const double s = height / down;
      if (!(s >= -round_off && s <= 1 + round_off)) continue;
      const Vec3 q = s * way - p;
      const double wu = cross(q, v).dot(n) / square, wv = cross(u, q).dot(n) / square;
      if (wu >= -round_off && wv >= -round_off && wu + wv <= 1 + round_off) found(t, s);
    }
  }
}

}  // namespace nereid::audit
