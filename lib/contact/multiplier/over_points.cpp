#include "contact/multiplier/over_points.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/multiplier/over_facet.hpp"
#include "contact/surface/foot.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

constexpr double just_on = 1e-9;       // of a face: so near a ridge an apex stands on it
constexpr double same_part = 0.9063;   // cosine of 25 degrees between normals of a base whose points are found together
constexpr double turned_height = 0.2;  // of a depth: by so much it is deeper along a normal that has gone evenly over an edge
constexpr double farther_than_points = 0.1;  // of the side of a base: a node that is farther is no nearer by its points

/// Whether a stencil before this one is of the same part of the base, whose points both would have.
bool has_same_points(const BaseSurface& base, const Vectors& x, const ElementForces& element, int s) {
  const Vec3 normal = facet_normal(base, x, element.stencil[s].facet);
  return any_of(element.stencil, s, [&](const Stencil& before) {
    return before.over_points && before.push.dot(normal) > same_part;
  });
}

/// Of an apex from the closest point of a facet. [m]
double distance_to(const Interface& interface, const Vectors& x, Index apex, Index facet) {
  const std::array<double, 3> weight = weights_of(interface, x, apex, facet);
  Vec3 arm = x.col(interface.apexes[apex]);
  for (int I = 0; I < 3; ++I) arm -= weight[I] * x.col(interface.base.facets(I, facet));
  return arm.norm();
}

/// Gives a stencil the facet on which friction has its foot.
void lay_on(const Interface& interface, const Vectors& x, Index apex, Index facet, Stencil& stencil) {
  stencil.facet = facet, stencil.kind = geometry::Kind::facet, stencil.local = 0;
  stencil.weight = weights_of(interface, x, apex, facet), stencil.fourth = 0;
}

/// Sums the points of the faces around an apex over the side of the base that a stencil is on. If none lies there, but some lie on another
/// side that meets this one at a node of the facet, and no other stencil is there, moves the stencil to that side: an apex on the rim of a
/// flush face is on all sides of the rim, and which one its track names is a chance. The same is true of an apex that is beside the base,
/// nearest to an edge or a vertex: it belongs to the side on which most of its faces lies.
OverPoints sum_where_faces_lie(const Interface& interface, const Vectors& x, Index apex, int s, const PointWork& work, PointSum& range,
                               ElementForces& element) {
  const BaseSurface& base = interface.base;
  Stencil& stencil = element.stencil[s];
  const OverPoints here = sum_points(interface, x, apex, stencil.facet, work, range);
  const bool is_beside = stencil.kind != geometry::Kind::facet && stencil.push.isZero(0);
  if (!is_beside && (here.area > 0 || here.of_node > 0 || here.covered_elsewhere)) return here;
  const auto is_taken = [&](const Vec3& side) {
    for (int one = 0; one < element.count; ++one)
      if (facet_normal(base, x, element.stencil[one].facet).dot(side) > same_part) return true;  // of this one too
    return false;
  };
  Index best = -1;
  double most = here.area, nearest = here.area > 0 ? distance_to(interface, x, apex, stencil.facet) : infinite;
  for (const Index node : base.facets.col(stencil.facet))
    for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
      const Index other = base.ring[static_cast<std::size_t>(r)];
      if (is_taken(facet_normal(base, x, other))) continue;
      const double area = sum_points(interface, x, apex, other, work, range).area, apart = distance_to(interface, x, apex, other);
      const bool same_side = std::abs(area - most) < just_on * area;
      if (same_side ? apart < nearest : area > most) best = other, most = area, nearest = apart;
    }
  if (best >= 0) lay_on(interface, x, apex, best, stencil);
  return sum_points(interface, x, apex, stencil.facet, work, range);
}

/// The height over points at which a contact closes: that of the track where the apex came in deep, as an overlap that is accepted; else
/// that of the contact, since an apex that comes in beside a rim or onto a flush surface does so alone. [m]
double level_of_points(const Interface& interface, const Memory& memory, Index apex, const Stencil& stencil) {
  const double height = contact_height(interface, memory, apex), of_track = stencil.level - stand_off(interface.base, stencil.facet);
  return height - of_track > level_by * interface.base.longest(stencil.facet) ? of_track : height;
}

/// Whether the gap of an apex is known from points without its own: all faces that press it lie on the base, and no guard would be deeper.
/// Its stencil then has its foot.
bool is_by_points_alone(const Interface& interface, const Vectors& x, const Near& near, const OverPoints& sum, double level,
                        Stencil& stencil) {
  if (!(sum.area > 0) || sum.of_node > 0 || near.element.count != 1) return false;
  if (stencil.kind != geometry::Kind::facet || stencil.on_ridge) return false;
  OverPlane plane = over_plane(interface, x, near.apex, stencil.facet, stencil.level);
  const double by_points = (sum.gap - sum.area * level) / sum.normal.norm();
  if (!(plane.least_gap + least_allowance(interface, near.apex, stencil.facet) >= by_points)) return false;
  double fourth = 0;
  if (interface.friction.coefficient > 0)
    stand_on_face(interface.base, x, x.col(interface.apexes[near.apex]), {stencil.facet, geometry::Kind::facet, 0}, 0, nullptr,
                  plane.over, fourth);
  stencil.weight = plane.over.weight, stencil.fourth = fourth;
  return true;
}

}  // namespace

OverPlane over_plane(const Interface& interface, const Vectors& x, Index apex, Index facet, double level) {
  const BaseSurface& base = interface.base;
  OverPlane plane{facet, height_over(base, x, {facet, geometry::Kind::facet, 0}, x.col(interface.apexes[apex])), 0};
  const Index fourth = base.half[facet].fourth;
  const double height = plane.over.height;
  const double warp = fourth < 0 ? 0 : plane.over.normal.dot(x.col(fourth) - x.col(base.facets(0, facet)));
  plane.least_gap = (height < 0 ? 1 + turned_height : 1) * height - std::abs(warp) - level;
  return plane;
}

double least_allowance(const Interface& interface, Index apex, Index facet) {
  const double depth = between(interface, apex, facet).depth, sag = always_allowed * interface.base.size(facet);
  return depth > 0 ? std::min(sag, most_allowed * depth) : sag;
}

void move_to(const OverPlane& plane, Near& near) {
  Stencil& stencil = near.element.stencil[0];
  Tracks& tracks = near.tracks;
  if (plane.facet != stencil.facet) tracks.owned = -infinite;
  stencil.facet = tracks.track[0].facet = plane.facet;
  stencil.weight = plane.over.weight, stencil.fourth = 0;
  tracks.out = {plane.facet, plane.over.weight, std::max(plane.over.height, tracks.track[0].height)};
}

bool guard_acts(const Interface& interface, const Motion& m, const Near& near, Index facet, const Multipliers& all,
                const ConditionList& list, Condition& c) {
  const double closing = steps_to_touch * m.next * std::min(0.0, relative(c, list, all.velocity));
  if (!(near.pressed > 0) && !(c.gap + closing < 0)) return false;  // what it is allowed would only add to this
  c.gap += allowance(interface, m.x, near.apex, facet);
  return near.pressed > 0 || c.gap + closing < 0;
}

void follow_facet(const Interface& interface, const Vectors& x, Memory& memory, Near& near) {
  const Index before = near.element.stencil[0].facet;
  near.element.stencil[0].apex = 1;
  FeatureHeight over;
  const Index facet = facet_below(interface.base, x, x.col(interface.apexes[near.apex]), before, over);
  if (facet < 0) return;
  move_to(over_plane(interface, x, near.apex, facet, near.element.stencil[0].level), near);
  memory.feature[near.apex] = {facet, geometry::Kind::facet, 0};
  near.element.moved = facet != before;
}

bool find_over_points(const Interface& interface, const Motion& m, const Memory& memory, Near& near, int s, Moved moved,
                      const PointWork& work, FoundInRange& range, const Multipliers& all, Condition& c) {
  Stencil& stencil = near.element.stencil[s];
  const bool pushes = !stencil.push.isZero(0);
  if (!pushes && memory.gap[near.apex] > farther_than_points * interface.base.size(stencil.facet)) {
    const double speed = speed_over(interface, all.velocity, near.apex, {stencil.facet, stencil.kind, stencil.local});
    if (!can_touch(between(interface, near.apex, stencil.facet), m, 0.5 * memory.gap[near.apex], speed)) return false;
  }
  OverPoints sum = sum_where_faces_lie(interface, m.x, near.apex, s, work, range.points, near.element);
  if (has_same_points(interface.base, m.x, near.element, s)) return false;
  const Index side = stencil.facet;
  const double level = level_of_points(interface, memory, near.apex, stencil);
  const bool by_points_alone = is_by_points_alone(interface, m.x, near, sum, level, stencil);
  near.by_points = by_points_alone && s == 0;
  const bool stands = !by_points_alone && make(interface, m, memory, near, stencil, near.element.has_moment, all, range.list, c);
  if (!(sum.area > 0) && !(sum.covered_elsewhere && !(sum.of_node > 0))) return stands;
  // points may leave a node no deeper than a guard, also where nodes that are better covered have its points
  if (!(sum.area > 0)) return stands && guard_acts(interface, m, near, stencil.facet, all, range.list, c);
  sum.gap -= sum.area * level;
  Vec3 normal = sum.normal;
  if (stands && sum.of_node > 0) sum.gap += sum.of_node * c.gap, normal += sum.of_node * c.normal;
  const Mat3* allowed = allowed_of(interface, near.apex);
  const Vec3 along = allowed ? Vec3(*allowed * normal) : normal;
  const double area = along.norm();  // so that what the apex gets is a unit vector
  if (stands && c.gap * area < sum.gap) {
    const double own = c.gap + allowance(interface, m.x, near.apex, stencil.facet);
    if (own * area < sum.gap) {
      c.gap = own;
      return true;
    }
  }
  if (stands && sum.of_node > 0)
    for (const Member& one : members_of(c, range.list))
      add_to(one.node, sum.of_node * one.weight * c.normal, one.weight > 0, range.points);
  if (!by_points_alone && (!stands || stencil.facet != side)) lay_on(interface, m.x, near.apex, side, stencil);
  range.list.members.resize(static_cast<std::size_t>(c.first)), c.nodes = 0;
  if (!(area > 0)) return false;
  c.normal = along / area, c.gap = sum.gap / area;
  for (const Share& one : range.points.sum) {
    // on like meshes these are 0 or 1, and round-off beside that would set what lies still in motion
    const Vec3 push = (one.push / area).unaryExpr([](double part) {
      const double whole = std::nearbyint(part);
      return std::abs(part - whole) < no_weight ? whole : part;
    });
    if (c.nodes > 0 && push.isZero(0)) continue;
    const double weight = push.norm();
    add_member(one.node, one.of_apex_side ? weight : -weight, push, range.list, c);
  }
  stencil.over_points = true;
  if (pushes) return true;
  double fastest = 0;
  for (const Member& one : members_of(c, range.list)) {
    const Vec3 speed = all.velocity.col(interface.apexes[near.apex]) - all.velocity.col(one.node);
    fastest = std::max(fastest, speed.squaredNorm());
  }
  if (can_touch(between(interface, near.apex, stencil.facet), m, c.gap, std::sqrt(fastest))) return true;
  if (near.element.count == 1) near.no_condition_until = moved.until(c.gap);
  near.by_points = false;  // it may leave its base
  return false;
}

}  // namespace nereid::contact
