#include "contact/surface/stand.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/height.hpp"

namespace nereid::contact {

namespace {

using geometry::Closest;
using geometry::Kind;

constexpr int most_facets = 48;       // that one walk looks at from one facet
constexpr int most_hops = 100;        // from facet to facet
constexpr double closer = 1 - 1e-12;  // a walk goes on only downhill, so that it ends
constexpr double farther = 2;         // times the distance: what lies behind a nearer edge may be closer, in sharp valleys from farther
constexpr double near_plane = 0.3;    // of the longest edge: higher or deeper, farther facets may be closer
constexpr double middle = 0.45;       // of the thickness: from deeper no walk leaves a facet
constexpr double on_an_edge = 1e-9;   // of the longest edge, and of a weight: over a common edge of a plain a facet has the apex

Vec3 foot_of(const BaseSurface& base, const Vectors& x, Index facet, const std::array<double, 3>& weight) {
  return weight[0] * x.col(base.facets(0, facet)) + weight[1] * x.col(base.facets(1, facet)) + weight[2] * x.col(base.facets(2, facet));
}

/// The closest feature of the patch from a facet on, among facets near the foot; changes facet and closest.
///
/// returns  whether a closer facet was found
bool walk_on(const BaseSurface& base, const Vectors& x, const Vector<double>& p, Index self, Index& facet, Closest& closest) {
  const Index from = facet;
  const Closest here = closest;
  const Vec3 foot = foot_of(base, x, from, here.weight);
  const double times = std::max({farther, base.sharpest, lean(base, x, from)});
  const double reach = times * std::sqrt(here.distance_squared) + on_an_edge * base.longest(from);
  const double deepest = middle * base.thickness(from);
  if (here.kind == Kind::facet && here.distance_squared > deepest * deepest) return false;
  std::array<Index, most_facets> queue;
  int count = 1;
  queue[0] = from;
  for (int i = 0; i < count; ++i) {
    for (int e = 0; e < 3; ++e) {
      const Index next = base.neighbour(e, queue[i]);
      if (next < 0 || base.wall[queue[i]][e] || count == most_facets) continue;
      if (std::find(queue.begin(), queue.begin() + count, next) != queue.begin() + count || is_beside(base, self, next)) continue;
      const Vec3 a = x.col(base.facets(e, queue[i])), along = Vec3(x.col(base.facets((e + 1) % 3, queue[i]))) - a;
      const double u = std::clamp((foot - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
      if ((a + u * along - foot).squaredNorm() > reach * reach) continue;
      queue[count++] = next;
      const Closest there = geometry::closest_on_triangle(corners(base, x, next), p);
      if (there.distance_squared < closer * closest.distance_squared) closest = there, facet = next;
    }
  }
  return facet != from;
}

/// Past a border at a vertex: of the facets of the patch that are as close there, the one on whose side of the plane that halves the angle
/// between two neighbours the point stands. There both have it at the same height, so that the height has no jump where the facet changes.
void turn_around_vertex(const BaseSurface& base, const Vectors& x, const Vec3& point, Index self, Index& facet, Closest& closest) {
  const Vector<double> p{point.x(), point.y(), point.z()};
  const Index vertex = base.facets(closest.local, facet);
  for (Index here = -1, hop = 0; here != facet && hop < most_hops; ++hop) {
    here = facet;
    for (const int e : {closest.local, (closest.local + 2) % 3}) {  // the edges that end there
      const Index next = base.neighbour(e, here);
      if (next < 0 || base.wall[here][e] || is_beside(base, self, next)) continue;
      const Closest there = geometry::closest_on_triangle(corners(base, x, next), p);
      if (there.kind != Kind::vertex || base.facets(there.local, next) != vertex) continue;
      const Vec3 along = x.col(base.facets((e + 1) % 3, here)) - x.col(base.facets(e, here));
      const Vec3 to_here = (facet_normal(base, x, here) + facet_normal(base, x, next)).cross(along);
      if (!((point - x.col(vertex)).dot(to_here) < 0)) continue;
      facet = next, closest = there;
      break;
    }
  }
}

}  // namespace

Ownership ownership(const BaseSurface& base, const Vectors& x, Index facet, const FeatureHeight& over, double height) {
  const double longest = base.longest(facet), least = std::min({over.weight[0], over.weight[1], over.weight[2]});
  if (!(height < near_plane * longest) || least < -on_an_edge) return {};
  const double altitude = area_vector(base, x, facet).norm() / longest;
  const auto room_with = [&](double leans) { return least * altitude - height * leans; };
  if (!(room_with(lean_at_edges(base, x, facet)) >= -on_an_edge * altitude)) return {};
  const double leans = lean(base, x, facet), room = room_with(leans);
  if (!(room >= -on_an_edge * altitude)) return {};
  const double rate = 2 * (1 + leans + 4 * height / altitude * (1 + leans * leans));  // twice what the first order of a small way gives
  return {true, std::min(room / rate, near_plane * longest - height)};
}

Stand stand(const BaseSurface& base, const Vectors& x, const Vec3& point, Index from, Index self) {
  const Vector<double> p{point.x(), point.y(), point.z()};
  Index facet = from;
  const FeatureHeight over = height_over(base, x, {facet, Kind::facet, 0}, point);
  if (ownership(base, x, facet, over, std::abs(over.height)).whole) return {.feature = {facet, Kind::facet, 0}, .over = over};

  Closest closest = geometry::closest_on_triangle(corners(base, x, facet), p);
  for (int hop = 0; hop < most_hops && walk_on(base, x, p, self, facet, closest); ++hop) continue;

  Stand found{.feature = {facet, closest.kind, closest.local}, .over = {}};
  const bool wall = closest.kind == Kind::edge     ? base.wall[facet][closest.local]
                    : closest.kind == Kind::vertex ? at_wall(base, base.facets(closest.local, facet))
                                                   : false;
  if (!wall) {
    found.over = height_over(base, x, found.feature, point);
    return found;
  }
  if (closest.kind == Kind::vertex) turn_around_vertex(base, x, point, self, facet, closest);
  found.feature = {facet, Kind::facet, 0};
  found.over = height_over(base, x, found.feature, point);
  const Vec3 way = point - foot_of(base, x, facet, closest.weight) - found.over.height * found.over.normal;
  found.past = way.norm();
  if (found.past > on_an_edge * base.longest(facet)) {
    found.outward = way / found.past;
    found.wall = {facet, closest.kind, closest.local};
    found.wall_weight = closest.weight;
  } else {
    found.past = 0;
  }
  return found;
}

Stand stand_whole(const BaseSurface& base, const Vectors& x, const Vec3& point, Index from, Index self) {
  Stand at = stand(base, x, point, from, self);
  if (at.past > 0 && at.past <= whole_past_wall * base.size(at.feature.facet) && ends_at(base, at.wall)) at.past = 0;
  return at;
}

}  // namespace nereid::contact
