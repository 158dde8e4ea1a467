#include "contact/tracking/tracking.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/surface/cone.hpp"
#include "contact/surface/nearer.hpp"
#include "contact/surface/stand.hpp"
#include "geometry/height.hpp"

namespace nereid::contact {

namespace {

using geometry::Closest;
using geometry::Kind;

constexpr double overlap = 1e-3;      // of a facet's weights: neighbours overlap by so much except at ridges, so that there is no hole
constexpr double round_off = 1e-9;    // of the longest edge, and of a weight
constexpr double of_places = 1e-15;   // of the coordinates
constexpr double held_open = 1e-12;   // of the longest edge: by so much an offset is more than it is
constexpr double at_once = 1e-9;      // of a step: crossings that are as early as each other
constexpr double on_ridge = 1e-3;     // of a step: sides of a ridge that are crossed as early as each other
constexpr double material = 0.9;      // of the thickness: no contact begins from deeper
constexpr double shallow = 0.2;       // of the longest edge: nor from deeper, but through the front
constexpr double far_side = -0.5;     // cosine: facets that are turned so far are not round the corner
constexpr double leads_along = 0.2;    // of the way through one side of a ridge: the way through that in whose plane it leads
constexpr double as_one_level = 1e-6;  // of the longest edge: what is flush where a surface goes on round a corner, as a curved one does
constexpr double like_neighbours = 2;  // times the deepest contact of the step before


using Corners = std::array<Vector<double>, 3>;

Corners corners_before(const ApexPath& s, Index facet) {
  Corners c = corners(s.base, s.x, facet);
  for (int a = 0; a < 3; ++a) c[a] = c[a] - s.dt * position(s.v, s.base.facets(a, facet));
  return c;
}
Vector<double> place(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vec3 now(const ApexPath& s) { return s.x.col(s.apex); }
Vec3 before(const ApexPath& s) { return s.x.col(s.apex) - s.dt * s.v.col(s.apex); }

double least(const std::array<double, 3>& weight) { return std::min({weight[0], weight[1], weight[2]}); }

bool may_push(const ApexPath& s, const Vec3& normal) { return may_push(s.own, s.x, s.apex, normal, s.most_behind, s.allowed); }

/// Whether apexes of the other surface hold what this one may not be pushed by.
bool is_held_otherwise(const ApexPath& s) { return s.most_behind < behind_in_one_direction; }

/// The distance of a point from a facet that reaches past open borders as far as a force stays whole there.
struct Reach {
  double distance, height, aside;  // [m] aside of the facet, before it reaches past a border
  Kind kind;
  bool open;                       // past an open border
};
Reach reach_of(const BaseSurface& base, Index facet, const Corners& c, const Vector<double>& p) {
  const Closest closest = geometry::closest_on_triangle(c, p);
  const double height = geometry::facet_height(c, p).height;
  const double aside = std::sqrt(std::max(0.0, closest.distance_squared - height * height));
  const Feature feature{facet, closest.kind, closest.local};
  const bool open = closest.kind != Kind::facet && ends_at(base, feature);
  const double left = open ? std::max(0.0, aside - whole_past_wall * base.size(facet)) : aside;
  return {std::sqrt(height * height + left * left), height, aside, closest.kind, open};
}

/// Whether the surface of the apex itself faces a facet and lies over an edge of it: what is just beside that edge is no way past the body.
bool lies_over(const ApexPath& s, const Corners& c, int edge) {
  if (s.own.ring_begin.empty()) return false;
  const Vec3 normal = eigen(geometry::facet_height(c, c[0]).normal);
  for (Index r = s.own.ring_begin[s.apex]; r < s.own.ring_begin[s.apex + 1]; ++r) {
    const Index mine = s.own.ring[r];
    if (!(facet_normal(s.own, s.x, mine).dot(normal) < far_side)) continue;
    Vec3 middle = Vec3::Zero();
    for (int a = 0; a < 3; ++a) middle += s.x.col(s.own.facets(a, mine)) / 3;
    if (geometry::facet_height(c, place(middle)).weight[(edge + 2) % 3] > 0) return true;
  }
  return false;
}

/// Whether a point is outside of a facet beyond one of its ridges, but for round-off, or as far as neighbours overlap if the apex's own
/// surface lies over the ridge: two ridges that meet head on must not both miss the other's facet.
bool is_beyond_a_ridge(const ApexPath& s, Index facet, const Corners& c, const std::array<double, 3>& weight) {
  for (int e = 0; e < 3; ++e) {
    const double inside = weight[(e + 2) % 3];
    if (!s.base.wall[facet][e] || s.base.neighbour(e, facet) < 0 || inside >= -round_off) continue;
    if (inside < -overlap || !lies_over(s, c, e)) return true;
  }
  return false;
}

/// Whether a point over a facet belongs to it, with room for round-off between neighbours. What passes beside a ridge is beside the body.
/// Half of what a border apex stands for lies inside, so a facet reaches past an open border as far as a force stays whole there.
///
/// corners_of(facet)  where the facet is then
template <class CornersOf>
bool reaches(const ApexPath& s, Index facet, CornersOf&& corners_of, const Vector<double>& p) {
  const Corners c = corners_of(facet);
  const auto weight = geometry::facet_height(c, p).weight;
  bool is_inside = least(weight) >= -overlap && !is_beyond_a_ridge(s, facet, c, weight);
  for (int e = 0; e < 3 && is_inside; ++e) {  // a facet that has but a node at the ridge has the ridge behind a neighbour
    const Index across = s.base.neighbour(e, facet);
    if (weight[(e + 2) % 3] >= -round_off || across < 0) continue;
    const Corners beside = corners_of(across);
    is_inside = !is_beyond_a_ridge(s, across, beside, geometry::facet_height(beside, p).weight);
  }
  if (is_inside) return true;
  const Reach at = reach_of(s.base, facet, c, p);
  return at.open && at.aside <= whole_past_wall * s.base.size(facet);
}

/// The first facet that a path crosses from its front.
struct Passage {
  Index facet = -1;
  bool may_push = true;
  double at = 0;  // [-] of the step
  // Of the near facets, if not at_surface: whether the path may go through one itself, and whether it ends in front of one below h_c.
  bool through_surface = false, in_layer = false;
};

/// The path p0 - p1 in the frame of each near facet, against its plane at h_c or, at_surface, itself.
///
/// Facets that may not push the apex count only if there is no other.
///
/// skip(facet)  true for facets that do not count
template <class Skip>
Passage crossed(const ApexPath& s, const Vec3& p0, const Vec3& p1, bool at_surface, Skip&& skip) {
  const Vector<double> from = place(p0), to = place(p1);
  Passage best;
  Index excluded = -1;
  double first = infinite, steepest = 0;
  for (const Index f : s.near) {
    const Corners c1 = corners(s.base, s.x, f);
    const double level = at_surface ? 0 : s.level(f);
    if (geometry::is_well_above(c1, to, level)) continue;  // most of them
    const auto end = geometry::facet_height(c1, to);
    if (!(end.height < level)) continue;
    best.in_layer = best.in_layer || end.height >= 0;
    const Corners c0 = corners_before(s, f);
    const double tolerance = round_off * s.base.longest(f) + of_places * p1.lpNorm<Eigen::Infinity>();
    if (geometry::is_well_below(c0, from, tolerance)) continue;
    const auto start = geometry::facet_height(c0, from);
    best.through_surface = best.through_surface || (end.height < 0 && start.height >= -tolerance);
    const double fall = start.height - end.height;
    if (start.height < level - tolerance || !(fall > 0)) continue;
    const double t = std::clamp((start.height - level) / fall, 0.0, 1.0);
    if (t > first + at_once) continue;
    const auto then = [&](Index facet) {
      Corners c = corners_before(s, facet);
      const Corners later = corners(s.base, s.x, facet);
      for (int a = 0; a < 3; ++a) c[a] = (1 - t) * c[a] + t * later[a];
      return c;
    };
    if (!reaches(s, f, then, (1 - t) * from + t * to)) continue;
    if (skip(f)) continue;
    if (!may_push(s, eigen(end.normal))) {
      excluded = f;
      continue;
    }
    if (t < first - at_once || fall > steepest) best.facet = f, steepest = fall, first = std::min(t, first);
  }
  best.at = first;
  if (best.facet < 0 && excluded >= 0) best.facet = excluded, best.may_push = false;
  return best;
}

/// The shallowest facet behind which a point stands, inside of it, that may push the apex; -1 if there is none.
///
/// deepest(facet)  [m] below the surface
template <class Deepest>
Index shallowest(const ApexPath& s, const Vec3& p, Deepest&& deepest, const Vec3* not_opposite, double& height) {
  Index best = -1;
  height = -infinite;
  for (const Index f : s.near) {
    const auto over = geometry::facet_height(corners(s.base, s.x, f), place(p));
    if (!(over.height < s.level(f)) || over.height < -deepest(f) || over.height <= height) continue;
    if (least(over.weight) < -overlap) continue;
    const Vec3 normal = eigen(over.normal);
    if (not_opposite && normal.dot(*not_opposite) < far_side) continue;
    if (!may_push(s, normal)) continue;
    best = f, height = over.height;
  }
  return best;
}

/// [m] So deep behind a facet there is its body: behind one side of a sheet there is the other.
double depth_of_body(const BaseSurface& base, Index facet) { return is_sheet(base, facet) ? 0 : material * base.thickness(facet); }

double deepest_entry(const BaseSurface& base, Index facet) {
  return std::min(depth_of_body(base, facet), shallow * base.longest(facet));
}

/// The edge or vertex nearer than h_c that a free apex has come in front of, where it was nowhere within h_c before; -1 if there is none.
Index entered_round_layer(const ApexPath& s) {
  const Vec3 p0 = before(s), p1 = now(s);
  Index best = -1;
  double deepest = 0;
  for (const Index f : s.near) {
    const Corners c1 = corners(s.base, s.x, f);
    if (geometry::is_well_above(c1, place(p1), s.level(f)) || geometry::is_well_below(c1, place(p1), 0)) continue;
    const Reach now = reach_of(s.base, f, c1, place(p1));  // which is no nearer than the plane
    if (now.kind == Kind::facet || now.height < 0 || !(s.level(f) - now.distance > deepest)) continue;
    if (now.aside < 1e-6 * s.base.longest(f)) continue;  // over an edge of a plain
    best = f, deepest = s.level(f) - now.distance;
  }
  if (best < 0) return -1;
  for (const Index f : s.near) {
    const Corners c0 = corners_before(s, f);
    const double within = s.level(f) * (1 - 1e-9);
    if (geometry::is_well_above(c0, place(p0), within)) continue;
    if (reach_of(s.base, f, c0, place(p0)).distance < within) return -1;
  }
  return best;
}

/// The shallowest facet that a free apex has come under over an open border, no deeper than its neighbours are; -1 if there is none.
Index entered_under_border(const ApexPath& s, double deepest, double& height) {
  const Vec3 p0 = before(s), p1 = now(s);
  Index best = -1;
  height = -infinite;
  for (const Index f : s.near) {
    const bool open = s.base.neighbour(0, f) == no_facet || s.base.neighbour(1, f) == no_facet || s.base.neighbour(2, f) == no_facet;
    if (!open) continue;
    const auto over = geometry::facet_height(corners(s.base, s.x, f), place(p1));
    if (!(over.height < s.level(f)) || over.height <= height || least(over.weight) < 0) continue;
    if (s.level(f) - over.height > like_neighbours * deepest) continue;
    const auto was = geometry::facet_height(corners_before(s, f), place(p0));
    bool from_outside = false;
    for (int e = 0; e < 3; ++e) from_outside = from_outside || (s.base.neighbour(e, f) == no_facet && was.weight[(e + 2) % 3] < 0);
    if (!from_outside || !may_push(s, eigen(over.normal))) continue;
    best = f, height = over.height;
  }
  return best;
}

/// Whether a point at a wall of a facet, or at a corner of it, is in front of a facet that turns away there, outside of the body.
bool is_beyond_ridge(const ApexPath& s, Index facet, const Vec3& p) {
  const auto in_front = [&](Index other) {
    return geometry::facet_height(corners(s.base, s.x, other), place(p)).height > -round_off * s.base.longest(other);
  };
  const auto weight = geometry::facet_height(corners(s.base, s.x, facet), place(p)).weight;
  for (int e = 0; e < 3; ++e) {
    const Index across = s.base.neighbour(e, facet);
    if (s.base.wall[facet][e] && across >= 0 && weight[(e + 2) % 3] <= overlap && in_front(across)) return true;
  }
  const Vec3 normal = facet_normal(s.base, s.x, facet);
  for (int a = 0; a < 3; ++a) {
    if (weight[a] < 1 - overlap) continue;
    const Index node = s.base.facets(a, facet);
    for (Index r = s.base.ring_begin[node]; r < s.base.ring_begin[node + 1]; ++r) {
      const Index other = s.base.ring[r];
      if (facet_normal(s.base, s.x, other).dot(normal) < far_turn && in_front(other)) return true;
    }
  }
  return false;
}

bool share_a_node(const BaseSurface& base, Index f, Index g) {
  for (int a = 0; a < 3; ++a)
    if ((base.facets.col(g).array() == base.facets(a, f)).any()) return true;
  return false;
}

/// The side of a ridge in whose plane an apex moves as it crosses the other side, as from one floor onto the next one, or past a bevel onto
/// the sole behind it: without a facet if there is none. Both sides may push the apex, and along this one nothing has to stop it.
Track slides_onto(const ApexPath& s, const Vec3& p0, const Vec3& p1, Index crossed, double deepest) {
  const Vec3 normal = facet_normal(s.base, s.x, crossed);
  const auto height = [](const Corners& c, const Vec3& p) { return geometry::facet_height(c, place(p)).height; };
  const double fall = height(corners_before(s, crossed), p0) - height(corners(s.base, s.x, crossed), p1);
  for (const Index f : s.near) {
    const auto end = geometry::facet_height(corners(s.base, s.x, f), place(p1));
    const double turn = eigen(end.normal).dot(normal);
    if (turn > one_plane || turn < far_side || !share_a_node(s.base, f, crossed)) continue;
    const double flush = turn > far_turn ? as_one_level * s.base.longest(f) : flush_step(s.base, s.x, f, crossed);
    const double within = std::max(like_neighbours * deepest, flush);
    if (least(end.weight) < -overlap || end.height > s.level(f) + within) continue;
    const double start = height(corners_before(s, f), p0);
    if (!(std::abs(start - s.level(f)) <= within) || !may_push(s, eigen(end.normal))) continue;
    if (std::abs(end.height - start) <= leads_along * fall) return {f, std::min(start, s.level(f))};
  }
  return {};
}

/// Begins a track where an apex is as high over a facet now: by this offset it is not in contact yet, which no round-off decides.
void begin_here(const ApexPath& s, Index facet, double height, Tracks& tracks) {
  tracks.begin(facet, height - held_open * s.base.longest(facet));
}

/// Whether a facet is looked after by a track next to it: all that share a node with it.
bool around(const ApexPath& s, const Tracks& tracks, Index facet) {
  for (int k = 0; k < tracks.count; ++k)
    if (share_a_node(s.base, tracks.track[k].facet, facet)) return true;
  return false;
}

/// Whether a facet is the other side of a ridge, or another side of a corner, of all tracks.
bool is_other_side(const ApexPath& s, const Tracks& tracks, Index facet) {
  const Vec3 normal = facet_normal(s.base, s.x, facet);
  for (int k = 0; k < tracks.count; ++k) {
    const Index tracked = tracks.track[k].facet;
    if (!share_a_node(s.base, tracked, facet) || normal.dot(facet_normal(s.base, s.x, tracked)) > far_turn) return false;
  }
  return true;
}

}  // namespace

Vec3 at(const Place& place, const BaseSurface& base, const Vectors& x, const Vectors& v, double earlier) {
  Corners c = corners(base, x, place.facet);
  for (int a = 0; a < 3; ++a) c[a] = c[a] - earlier * position(v, base.facets(a, place.facet));
  const Vec3 normal = eigen(cross(c[1] - c[0], c[2] - c[0])).normalized();
  return eigen(place.weight[0] * c[0] + place.weight[1] * c[1] + place.weight[2] * c[2]) + place.height * normal;
}

Vec3 at(const Place& place, const BaseSurface& base, const Vectors& x) {
  Vec3 sum = place.height * facet_normal(base, x, place.facet);
  for (int a = 0; a < 3; ++a) sum += place.weight[a] * x.col(base.facets(a, place.facet));
  return sum;
}

void enter(const ApexPath& s, double deepest, Tracks& tracks) {
  const auto all = [](Index) { return false; };
  const Vec3 p0 = before(s), p1 = now(s);
  Passage through = crossed(s, p0, p1, false, all);
  double height = 0;
  if (through.facet >= 0 && through.may_push) {
    const Track flush = slides_onto(s, p0, p1, through.facet, deepest);
    if (flush.facet >= 0) return tracks.begin(flush.facet, flush.height);
    tracks.begin(through.facet, s.level(through.facet));
    // just on a ridge or corner it comes through its sides at once, and all push it back
    const auto not_beside = [&](Index f) { return !is_other_side(s, tracks, f); };
    while (tracks.count < most_tracks) {
      const Passage other = crossed(s, p0, p1, false, not_beside);
      if (other.facet < 0 || !other.may_push || !(std::abs(other.at - through.at) < on_ridge)) break;
      tracks.begin(other.facet, s.level(other.facet));
    }
    return;
  }
  const bool has_layer = s.contact_height > 0 || s.base.stand_off.size() > 0;
  if (has_layer) {
    // between the layers of two facets, and through the surface itself
    const Passage surface = through.through_surface ? crossed(s, p0, p1, true, all) : Passage{};
    if (surface.facet >= 0 && surface.may_push) {
      const double was = geometry::closest_on_triangle(corners_before(s, surface.facet), place(p0)).distance_squared;
      height = geometry::facet_height(corners(s.base, s.x, surface.facet), place(p1)).height;
      const double level = s.level(surface.facet);
      return was < level * level ? begin_here(s, surface.facet, height, tracks) : tracks.begin(surface.facet, level);
    }
    through.facet = -1;  // within the layer an excluded facet is the far side of what holds it
  }
  if (through.facet >= 0) {
    const Vec3 normal = facet_normal(s.base, s.x, through.facet);
    const Index held_by = shallowest(s, p1, [&](Index f) { return deepest_entry(s.base, f); }, &normal, height);
    if (held_by >= 0) return begin_here(s, held_by, height, tracks);
    if (is_held_otherwise(s)) return;
    if (!is_beyond_ridge(s, through.facet, p1)) tracks.begin(through.facet, s.level(through.facet));
    return;
  }
  if (has_layer && through.in_layer) {
    const Index round = entered_round_layer(s);
    if (round >= 0) return tracks.begin(round, s.level(round));
  }
  const Index sideways = entered_under_border(s, deepest, height);
  if (sideways >= 0) begin_here(s, sideways, height, tracks);
}

Track other_part(const ApexPath& s, const Tracks& before_step, const Tracks& after, double deepest) {
  const Vec3 from = before_step.out.facet >= 0 ? at(before_step.out, s.base, s.x, s.v, s.dt) : before(s);
  const Vec3 to = after.count > 0 && after.out.facet >= 0 ? at(after.out, s.base, s.x) : now(s);
  const Passage through = crossed(s, from, to, false, [&](Index f) { return around(s, after, f); });
  if (through.facet < 0 || (!through.may_push && is_held_otherwise(s))) return {};
  const Track flush = slides_onto(s, from, to, through.facet, deepest);
  return flush.facet >= 0 ? flush : Track{through.facet, s.level(through.facet)};
}

Index behind(const ApexPath& s, double deepest, double& depth) {
  const auto limit = [&](Index f) { return std::min(depth_of_body(s.base, f), deepest); };
  Index nearest = -1;
  double least_distance = infinite, least_gap = infinite;
  for (const Index f : s.near) {
    const double distance = std::sqrt(geometry::closest_on_triangle(corners(s.base, s.x, f), place(now(s))).distance_squared);
    const double gap = distance - stand_off(s.base, f);
    if (is_nearer(s.base, s.x, place(now(s)), f, gap, nearest, least_gap)) nearest = f, least_gap = gap, least_distance = distance;
  }
  if (nearest >= 0) {  // also in the layer over ridges and borders, and below valleys
    const Stand there = stand(s.base, s.x, now(s), nearest, s.apex);
    const double over = there.over.height, height = there.past > 0 && over >= 0 ? least_distance : over;
    const bool is_held = may_push(s, there.over.normal);
    depth = s.level(nearest) - height;
    if (over >= 0) return depth > 0 && is_held ? there.feature.facet : -1;
    if (there.past == 0 && over >= -limit(nearest) && is_held) return there.feature.facet;
  }
  double height = 0;
  const Index facet = shallowest(s, now(s), limit, nullptr, height);
  depth = (facet < 0 ? s.contact_height : s.level(facet)) - height;
  return facet;
}

double nearest_other_part(const ApexPath& s, const Tracks& tracks) {
  const Vector<double> p = place(now(s));
  double nearest = infinite;
  for (const Index f : s.near) {
    if (around(s, tracks, f)) continue;
    const double squared = geometry::closest_on_triangle(corners(s.base, s.x, f), p).distance_squared;
    // as far as a facet can reach past a border
    nearest = std::min(nearest, std::sqrt(squared) - whole_past_wall * s.base.size(f) - stand_off(s.base, f));
  }
  return nearest;
}

}  // namespace nereid::contact
