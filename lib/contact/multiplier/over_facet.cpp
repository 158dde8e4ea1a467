#include "contact/multiplier/over_facet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/gather.hpp"
#include "contact/surface/cone.hpp"
#include "contact/surface/face.hpp"
#include "contact/surface/foot.hpp"
#include "contact/surface/stand.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

constexpr double no_direction = 1e-3;  // of the size of a face: an edge or vertex that is nearer has no normal of its own
constexpr double takes_over = 0.5;     // cosine between a push and the normal of a facet that takes it over
constexpr double just_on = 1e-9;       // of a face: so near a ridge an apex stands on it
constexpr double came_flat = 1e-3;     // sine between a way and a side along which it leads
constexpr double along_push = 0.7;     // cosine between the way from a ridge to an apex on it and its push
constexpr double at_ridge = 0.05;      // weight of the third node of a facet: with less on both sides an apex is on the ridge between them
constexpr double uneven = 0.01;        // sine: normals that differ by less, as on a mesh of a flat face that is not quite flat, are alike
constexpr double as_much = 0.5;        // of the larger push of both sides

/// Whether the foot of a point on the plane of a facet is outside of that facet.
bool has_foot_outside(const BaseSurface& base, const Vectors& x, const Vec3& p, Index facet) {
  const auto weight = height_over(base, x, {facet, geometry::Kind::facet, 0}, p).weight;
  return *std::min_element(weight.begin(), weight.end()) < 0;
}

/// Whether a point stands on a ridge or corner of a facet but for round-off, and the normal there: the way out leads between the sides,
/// whichever of them the point has come through by round-off. Not if it came along one of them, which then pushes alone.
///
/// way  [m] of the point against the facet in the step before
bool stands_on_ridge(const BaseSurface& base, const Vectors& x, Index facet, const FeatureHeight& over, const Vec3& way, Vec3& normal) {
  const double near = just_on * base.size(facet);
  if (!(std::abs(over.height) < near)) return false;
  const double length = way.norm();
  const auto came_along = [&](const Vec3& side) { return length > near && std::abs(side.dot(way)) < came_flat * length; };
  const auto on = [&](int e) {
    const bool ridge = base.wall[facet][e] && base.neighbour(e, facet) >= 0 && !is_rim_of_sheet(base, facet, e);
    return ridge && std::abs(over.weight[(e + 2) % 3]) < just_on;
  };
  for (int e = 0; e < 3; ++e) {
    if (!on(e)) continue;
    if (came_along(over.normal) != came_along(facet_normal(base, x, base.neighbour(e, facet)))) return false;
    const int corner = std::abs(over.weight[e]) < just_on ? (e + 1) % 3 : std::abs(over.weight[(e + 1) % 3]) < just_on ? e : -1;
    normal = corner >= 0 ? node_normal(base, x, base.facets(corner, facet))
                         : Vec3((over.normal + facet_normal(base, x, base.neighbour(e, facet))).normalized());
    return true;
  }
  return false;
}

/// Whether an apex in front of a facet is below the level of the other side of a ridge of it by no more than a flush_step(), and that side
/// may push the apex: it slides onto that side, see enter(), and this one does not stop it.
///
/// level  [m] of contact over these facets
bool is_flush_beside(const Interface& interface, const Vectors& x, Index apex, Index facet, double level, const Mat3* allowed) {
  const BaseSurface& base = interface.base;
  for (int e = 0; e < 3; ++e) {
    const Index across = base.neighbour(e, facet);
    if (!base.wall[facet][e] || across < 0 || is_rim_of_sheet(base, facet, e)) continue;
    const FeatureHeight over = height_over(base, x, {across, geometry::Kind::facet, 0}, x.col(apex));
    const double below = level - over.height;  // at the level itself it passes, or meets an edge
    const bool is_level = below > just_on * base.size(across) && below < flush_step(base, x, across, facet);
    if (is_level && may_push(interface.own, x, apex, over.normal, most_behind(interface), allowed)) return true;
  }
  return false;
}

/// Sets nodes, weights, normal and gap of an apex over a facet, or over the face that it is half of.
void set(const Interface& interface, Index apex, const Stencil& stencil, const Vec3& normal, double gap, ConditionList& list,
         Condition& c) {
  c.gap = gap;
  c.normal = normal;
  add_member(apex, 1, list, c);
  for (int I = 0; I < 3; ++I) add_member(interface.base.facets(I, stencil.facet), -stencil.weight[I], list, c);
  if (stencil.fourth != 0) add_member(interface.base.half[stencil.facet].fourth, -stencil.fourth, list, c);
}

/// Whether another facet turns far away from that of a stencil, outward, and shares the nodes with it that its foot is at.
bool is_other_side(const BaseSurface& base, const Vectors& x, const Stencil& one, Index other) {
  if (facet_normal(base, x, one.facet).dot(facet_normal(base, x, other)) > far_turn) return false;
  bool shares = false;
  for (int I = 0; I < 3; ++I) {
    const bool has = (base.facets.col(other).array() == base.facets(I, one.facet)).any();
    if (!has && std::abs(one.weight[I]) > at_ridge) return false;
    shares = shares || has;
    const Vec3 node = x.col(base.facets(I, other));  // above the plane of the first in a valley
    if (height_over(base, x, {one.facet, geometry::Kind::facet, 0}, node).height > just_on * base.size(one.facet)) return false;
  }
  return shares;
}

/// The height of a point over a feature; over the bilinear face that a facet is half of, so that the cut of a warped face does not count.
/// [m]
double height_over_face(const BaseSurface& base, const Vectors& x, const Feature& feature, const Vec3& point) {
  FeatureHeight over = height_over(base, x, feature, point);
  double fourth = 0;
  stand_on_face(base, x, point, feature, 0, nullptr, over, fourth);
  return over.height;
}

/// The gap of an apex over what it is nearest to, where the nodes would be after the step to come. [m]
double gap_ahead(const Interface& interface, const Vectors& ahead, const Memory& memory, const Near& near) {
  const Feature& nearest = memory.feature[near.apex];
  if (near.tracks.count > 0 || nearest.facet < 0) return memory.gap[near.apex];
  const double height = height_over_face(interface.base, ahead, nearest, ahead.col(interface.apexes[near.apex]));
  return std::abs(height) - level(interface, memory, near.apex, nearest.facet);
}

}  // namespace

double reach_of(const Between& pair, double way) { return std::max(multipliers_reach * pair.depth, steps_to_touch * way); }

bool can_touch(const Between& pair, const Motion& m, double gap, double speed) {
  return gap <= reach_of(pair, m.next * speed);
}

bool leads_farther_in(const Interface& interface, const Vectors& x, Index apex, const Vec3& normal, const Vec3& other) {
  if (interface.own.facets.cols() == 0 || other.dot(normal) > 1 - 0.5 * uneven * uneven) return false;
  return reach_behind(interface.own, x, apex, normal) > std::max(uneven, reach_behind(interface.own, x, apex, other));
}

bool make(const Interface& interface, const Motion& m, const Memory& memory, const Near& near, Stencil& stencil, bool& has_moment,
          const Multipliers& all, ConditionList& list, Condition& c) {
  const Index apex = interface.apexes[near.apex];
  const Vec3 p = m.x.col(apex);
  const double push = stencil.push.norm();
  FeatureHeight over;
  const auto feature = [&] { return Feature{stencil.facet, stencil.kind, stencil.local}; };
  // its height over the plane of a facet is no distance for an open apex past a wall of it, and below that plane there is nothing to touch
  if (!(push > 0) && stencil.kind == geometry::Kind::facet && has_foot_outside(interface.base, m.x, p, stencil.facet)) {
    const Stand here = stand_whole(interface.base, m.x, p, stencil.facet, apex);
    if (here.past > 0 && here.over.height < 0) return false;
    if (here.past > 0) stencil.facet = here.wall.facet, stencil.kind = here.wall.kind, stencil.local = here.wall.local;
  }
  if (stencil.on_ridge) {
    over = height_over(interface.base, m.x, feature(), p);
    Vec3 foot = Vec3::Zero();
    for (int I = 0; I < 3; ++I) foot += over.weight[I] * m.x.col(interface.base.facets(I, stencil.facet));
    stencil.weight = over.weight, stencil.fourth = 0;
    const Vec3 arm = p - foot, out = stencil.push / push;
    const double distance = std::copysign(arm.norm(), arm.dot(out));
    const bool too_near = !(std::abs(distance) > just_on * interface.base.size(stencil.facet));  // for a direction
    set(interface, apex, stencil, too_near ? out : Vec3(arm / distance), distance - stencil.level, list, c);
    has_moment = has_moment || too_near;
    return true;
  }
  if (stencil.kind != geometry::Kind::facet) {  // where the apex would be; now it may be over a facet beside
    const Stand here = stand(interface.base, m.x, p, stencil.facet, apex);
    const bool pushes = push > 0 && facet_normal(interface.base, m.x, stencil.facet).dot(stencil.push) > one_plane * push;
    const bool stays = pushes && leads_farther_in(interface, m.x, apex, here.over.normal, stencil.push / push);
    if (here.past == 0 && stays) stencil.kind = geometry::Kind::facet;
    else if (here.past == 0) stencil.facet = here.feature.facet, stencil.kind = here.feature.kind, stencil.local = here.feature.local;
    over = height_over(interface.base, m.x, feature(), p);
  }
  if (stencil.kind != geometry::Kind::facet && std::abs(over.height) < no_direction * interface.base.size(stencil.facet)) {
    const Vec3 facet = facet_normal(interface.base, m.x, stencil.facet);
    if (push > 0 && facet.dot(stencil.push) < takes_over * push) {
      has_moment = true, over.normal = stencil.push / push;
    } else {
      stencil.kind = geometry::Kind::facet;
    }
  }
  const auto& wall = interface.base.wall[stencil.facet];
  if (stencil.kind == geometry::Kind::facet && (wall[0] || wall[1] || wall[2])) {
    over = height_over(interface.base, m.x, feature(), p);
    Vec3 normal;
    // between both sides only where its own surface admits that, as not at the rim of a block on a block of the same size
    Vec3 way = m.dt * m.v.col(apex);
    for (int I = 0; I < 3; ++I) way -= m.dt * over.weight[I] * m.v.col(interface.base.facets(I, stencil.facet));
    if (stands_on_ridge(interface.base, m.x, stencil.facet, over, way, normal) &&
        may_push(interface.own, m.x, apex, normal, behind_in_two_directions, allowed_of(interface, near.apex))) {
      stencil.weight = over.weight, stencil.fourth = 0;
      set(interface, apex, stencil, normal, over.height - stencil.level, list, c);
      return has_moment = true;
    }
  }
  // beside a rim, below its level: the normal from there to the apex leads along the surface, and nothing was penetrated
  if (stencil.kind != geometry::Kind::facet && near.tracks.count == 0 && over.height < 0) return false;
  if (stencil.kind == geometry::Kind::facet) over.weight = stencil.weight;
  else if (push > 0 && over.normal.dot(stencil.push) < 0) over.normal = -over.normal, over.height = -over.height;
  // over plates the foot would leave its node, and where several push each has its own
  const double band = near.element.count == 1 ? blend_band(interface.base, stencil.facet, stencil.level) : 0;
  const Mat3* allowed = allowed_of(interface, near.apex);
  const auto find_foot = [&, from = over, fourth = stencil.fourth](double within) {
    over = from, stencil.fourth = fourth;
    if (stand_on_face(interface.base, m.x, p, feature(), within, allowed, over, stencil.fourth)) return;
    stencil.fourth = 0;
    if (stencil.kind == geometry::Kind::facet) over = height_over(interface.base, m.x, feature(), p);
    if (within > 0 && stencil.kind == geometry::Kind::facet && interface.base.half[stencil.facet].cut < 0)
      blend_over_facet(interface.base, m.x, p, feature(), within, allowed, over);
  };
  find_foot(band);
  if (band > 0 && leads_farther_in(interface, m.x, apex, over.normal, facet_normal(interface.base, m.x, stencil.facet))) find_foot(0);
  stencil.weight = over.weight;
  set(interface, apex, stencil, over.normal, over.height - stencil.level, list, c);
  // The normal turns as an apex passes an edge or vertex, or comes over another facet: what counts is how the gap changes in the free step.
  // Neither gap is along a normal that has gone evenly over an edge.
  if (near.tracks.count == 0 || (near.element.count == 1 && stencil.kind != geometry::Kind::facet)) {
    const bool is_facet = stencil.kind == geometry::Kind::facet;
    const double start = is_facet ? height_over_face(interface.base, m.x, feature(), p) - stencil.level : c.gap;
    c.gap += std::max(0.0, gap_ahead(interface, all.ahead, memory, near) - start - m.next * relative(c, list, all.velocity));
  }
  if (!(push > 0)) {
    double fastest = 0;
    for (const Member& one : members_of(c, list).subspan(1))
      fastest = std::max(fastest, (all.velocity.col(apex) - all.velocity.col(one.node)).squaredNorm());
    if (!can_touch(between(interface, near.apex, stencil.facet), m, c.gap, std::sqrt(fastest))) return false;
    if (!may_push(interface.own, m.x, apex, c.normal, most_behind(interface), allowed)) return false;
    const bool over_facet = stencil.kind == geometry::Kind::facet;
    return !over_facet || !is_flush_beside(interface, m.x, apex, stencil.facet, stencil.level, allowed);
  }
  return true;
}

void join_on_ridge(const BaseSurface& base, const Vectors& x, const Vec3& p, ElementForces& element) {
  if (element.count < 2 || element.count > 3) return;
  Stencil& one = element.stencil[0];
  double least = one.push.norm(), most = least;
  for (int s = 0; s < element.count; ++s) {
    const Stencil& stencil = element.stencil[s];
    if (stencil.kind != geometry::Kind::facet || stencil.apex == 0) return;
    least = std::min(least, stencil.push.norm()), most = std::max(most, stencil.push.norm());
    for (int other = 0; other < element.count; ++other)
      if (other != s && !is_other_side(base, x, stencil, element.stencil[other].facet)) return;
  }
  if (least <= as_much * most) return;
  const auto nearest = std::max_element(one.weight.begin(), one.weight.end());
  int edge = -1;
  double likest = 0;  // the facet across the ridge is of the side of the other stencil
  for (int e = 0; e < 3; ++e) {
    const Index across = base.neighbour(e, one.facet);
    if (across < 0 || !base.wall[one.facet][e] || std::abs(one.weight[(e + 2) % 3]) > at_ridge) continue;
    const double like = facet_normal(base, x, across).dot(facet_normal(base, x, element.stencil[1].facet));
    if (like > likest) likest = like, edge = e;
  }
  if (element.count > 2 && *nearest >= 1 - 2 * at_ridge) {
    one.kind = geometry::Kind::vertex, one.local = static_cast<int>(nearest - one.weight.begin());
  } else if (element.count == 2 && edge >= 0) {
    one.kind = geometry::Kind::edge, one.local = edge;
  } else {
    return;
  }
  const Feature ridge{one.facet, one.kind, one.local};
  const auto weight = height_over(base, x, ridge, p).weight;
  Vec3 arm = p, out = Vec3::Zero();
  for (int I = 0; I < 3; ++I) arm -= weight[I] * x.col(base.facets(I, one.facet));
  for (int s = 0; s < element.count; ++s) out += element.stencil[s].push;
  if (!(out.norm() > along_push * least)) return;  // of both sides of a sheet
  if (arm.norm() > just_on * base.size(one.facet) && std::abs(arm.dot(out)) < along_push * arm.norm() * out.norm()) {
    one.kind = geometry::Kind::facet;  // it has gone off to one side
    return;
  }
  one.on_ridge = true;
  one.push = out;
  element.count = 1;
}

bool is_same_face(const BaseSurface& base, const ElementForces& element, int s) {
  const Half& half = base.half[element.stencil[s].facet];
  if (half.cut < 0) return false;
  const Index other = base.neighbour(half.cut, element.stencil[s].facet);
  for (int before = 0; before < s; ++before)
    if (element.stencil[before].apex != 0 && element.stencil[before].facet == other) return true;
  return false;
}

namespace {

constexpr std::array<int, 3> next_corner{1, 2, 0};

bool stays_over_face(const Interface& interface, const Near& near) {
  const Stencil& stencil = near.element.stencil[0];
  return near.kept == Kept::stencil && stencil.kind == geometry::Kind::facet && interface.base.half[stencil.facet].cut >= 0;
}

/// Finds where the apexes stand that come next, from a place in the list of near ones up to another.
void look_ahead(const Interface& interface, const Vectors& x, const Memory& memory, std::size_t from, std::size_t last, Ahead& ahead) {
  std::array<Index, lanes> apex;
  alignas(64) std::array<double, lanes> a, b, band;
  ahead.count = ahead.next = 0;
  for (std::size_t i = from; i < last && ahead.count < lanes; ++i) {
    const Near& near = memory.near[i];
    if (!stays_over_face(interface, near)) continue;
    const Stencil& stencil = near.element.stencil[0];
    const Half& half = interface.base.half[stencil.facet];
    const int lane = ahead.count++, first = half.cut, second = next_corner[first], third = next_corner[second];
    const auto corner = [&](int local) { return interface.base.facets(local, stencil.facet); };
    apex[lane] = interface.apexes[near.apex];
    ahead.corner[0][lane] = corner(first), ahead.corner[1][lane] = half.fourth;
    ahead.corner[2][lane] = corner(second), ahead.corner[3][lane] = corner(third);
    a[lane] = stencil.weight[second] + stencil.fourth, b[lane] = stencil.weight[second] + stencil.weight[third];
    band[lane] = blend_band(interface.base, stencil.facet, stencil.level);
  }
  for (int lane = ahead.count; lane < lanes; ++lane) {  // fillers
    apex[lane] = apex[0], a[lane] = a[0], b[lane] = b[0], band[lane] = band[0];
    for (auto& row : ahead.corner) row[lane] = row[0];
  }
  const Vector<Pack> place = gather(x.data(), apex.data());
  std::array<Vector<Pack>, 4> corner;
  for (int I = 0; I < 4; ++I) corner[I] = gather(x.data(), ahead.corner[I].data()) - place;
  OverFace<Pack> over;
  Pack width;
  read_lanes(a.data(), over.at.a), read_lanes(b.data(), over.at.b), read_lanes(band.data(), width);
  const Mask<Pack> stands = stand_over(corner, over) && !(width > Pack(0.0) && is_within(width, over));
  for (int lane = 0; lane < ahead.count; ++lane) ahead.stands[lane] = stands[lane];
  for (int I = 0; I < 4; ++I) write_lanes(over.weight[I], ahead.weight[I].data());
  for (int axis = 0; axis < 3; ++axis) write_lanes(over.normal[axis], ahead.normal[axis].data());
  write_lanes(over.height, ahead.height.data());
}

}  // namespace

bool make_ahead(const Interface& interface, const Vectors& x, const Memory& memory, Near& near, Index last, Ahead& ahead,
                ConditionList& list, Condition& c) {
  if (!stays_over_face(interface, near)) return false;
  const auto place = static_cast<std::size_t>(&near - memory.near.data());
  if (ahead.next == ahead.count) look_ahead(interface, x, memory, place, static_cast<std::size_t>(last), ahead);
  const int lane = ahead.next++;
  if (!ahead.stands[lane]) return false;
  Stencil& stencil = near.element.stencil[0];
  const int first = interface.base.half[stencil.facet].cut, second = next_corner[first], third = next_corner[second];
  c.normal = {ahead.normal[0][lane], ahead.normal[1][lane], ahead.normal[2][lane]};
  add_member(interface.apexes[near.apex], 1, list, c);
  for (int I = 0; I < 4; ++I) add_member(ahead.corner[I][lane], -ahead.weight[I][lane], list, c);
  stencil.weight[first] = ahead.weight[0][lane], stencil.fourth = ahead.weight[1][lane];
  stencil.weight[second] = ahead.weight[2][lane], stencil.weight[third] = ahead.weight[3][lane];
  c.gap = ahead.height[lane] - stencil.level;
  return true;
}

}  // namespace nereid::contact
