#include "contact/condition.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/gather.hpp"
#include "base/parallel.hpp"
#include "contact/apex.hpp"
#include "contact/cone.hpp"
#include "contact/crossing.hpp"
#include "contact/face.hpp"
#include "contact/foot.hpp"
#include "contact/near.hpp"
#include "contact/points.hpp"
#include "contact/restitution.hpp"
#include "contact/rigid_nodes.hpp"
#include "contact/stand.hpp"

namespace nereid::contact {

namespace {

constexpr double corrected = 0.2;      // of a penetration in a step
constexpr double no_direction = 1e-3;  // of the size of a face: an edge or vertex that is nearer has no normal of its own
constexpr double takes_over = 0.5;     // cosine between a push and the normal of a facet that takes it over
constexpr double paid_back = 0.2;      // of what friction owes, in a step
constexpr double most_yield = 1e-6;    // of the depth of an element: way by which a stick yields for that in a step
constexpr double just_on = 1e-9;       // of a face: so near a ridge an apex stands on it
constexpr double came_flat = 1e-3;     // sine between a way and a side along which it leads
constexpr double along_push = 0.7;     // cosine between the way from a ridge to an apex on it and its push
constexpr double at_ridge = 0.05;      // weight of the third node of a facet: with less on both sides an apex is on the ridge between them
constexpr double uneven = 0.01;        // sine: normals that differ by less, as on a mesh of a flat face that is not quite flat, are alike
constexpr double as_much = 0.5;        // of the larger push of both sides
constexpr double same_part = 0.9063;   // cosine of 25 degrees between normals of a base whose points are found together
constexpr double turned_height = 0.2;  // of a depth: by so much it is deeper along a normal that has gone evenly over an edge
constexpr double farther_than_points = 0.1;  // of the side of a base: a node that is farther is no nearer by its points

/// How an apex stands over the plane of a facet.
struct OverPlane {
  Index facet;
  FeatureHeight over;
  double least_gap;  ///< [m] no more than the gap over the bilinear face that the facet is half of
};
OverPlane over_plane(const Interface& interface, const Vectors& x, Index apex, Index facet, double level) {
  const BaseSurface& base = interface.base;
  OverPlane plane{facet, height_over(base, x, {facet, geometry::Kind::facet, 0}, x.col(interface.apexes[apex])), 0};
  const Index fourth = base.half[facet].fourth;
  const double height = plane.over.height;
  const double warp = fourth < 0 ? 0 : plane.over.normal.dot(x.col(fourth) - x.col(base.facets(0, facet)));
  plane.least_gap = (height < 0 ? 1 + turned_height : 1) * height - std::abs(warp) - level;
  return plane;
}

/// No more than allowance(). [m]
double least_allowance(const Interface& interface, Index apex, Index facet) {
  const double depth = between(interface, apex, facet).depth, sag = always_allowed * interface.base.size(facet);
  return depth > 0 ? std::min(sag, most_allowed * depth) : sag;
}

/// By how much nodes go against each other from the start of a step to its end and back: a depth is no larger than it was by that. [m]
double in_a_step(const Moved& moved) { return moved.now - moved.from; }

/// Moves the one track and stencil of an apex to the facet that it is over now.
void move_to(const OverPlane& plane, Near& near) {
  Stencil& stencil = near.element.stencil[0];
  Tracks& tracks = near.tracks;
  if (plane.facet != stencil.facet) tracks.owned = -infinite;
  stencil.facet = tracks.track[0].facet = plane.facet;
  stencil.weight = plane.over.weight, stencil.fourth = 0;
  tracks.out = {plane.facet, plane.over.weight, std::max(plane.over.height, tracks.track[0].height)};
}

/// Whether a guard that did not act in the step before is so far from where it would that its gap need not be known: most of them, in a
/// contact that is closed. It goes on from facet to facet.
///
/// x, velocity  where the nodes would be after the step to come, and as fast
bool is_idle_guard(const Interface& interface, const Motion& m, const Vectors& x, const Vectors& velocity, const Memory& memory,
                   Moved moved, Near& near) {
  constexpr double times = 2;  // the rate over the bilinear face is another one
  const Stencil& stencil = near.element.stencil[0];
  if (near.friction.acts || memory.restitution[near.apex].held != 0 || stencil.kind != geometry::Kind::facet) return false;
  const Between& pair = between(interface, near.apex, stencil.facet);
  if (pair.heights != Heights::guards || std::isnan(stencil.level)) return false;
  FeatureHeight over;
  const Index facet = facet_below(interface.base, x, x.col(interface.apexes[near.apex]), stencil.facet, over);
  if (facet < 0) return false;
  const OverPlane plane = over_plane(interface, x, near.apex, facet, stencil.level);
  Vec3 speed = velocity.col(interface.apexes[near.apex]);
  for (int I = 0; I < 3; ++I) speed -= plane.over.weight[I] * velocity.col(interface.base.facets(I, facet));
  const double gap = plane.over.height - stencil.level, closing = times * steps_to_touch * m.next * std::abs(plane.over.normal.dot(speed));
  const bool is_idle = gap < pair.release_height && moved.now + in_a_step(moved) - gap < near.clear &&
                       plane.least_gap - closing + least_allowance(interface, near.apex, facet) > 0;
  if (!is_idle) return false;
  move_to(plane, near);
  near.element.stencil[0].apex = 0, near.element.stencil[0].push.setZero();  // without a condition
  return true;
}

/// What of an apex that is in contact with one part of its base goes on from the step before.
Kept kept_of(const Interface& interface, const Motion& m, const Vectors& x, const Vectors& velocity, const Memory& memory, Moved moved,
             Near& near) {
  const Tracks& tracks = near.tracks;
  const ElementForces& element = near.element;
  if (tracks.count != 1 || element.count != 1 || allowed_of(interface, near.apex) != nullptr) return Kept::nothing;
  if (tracks.track[0].height < level(interface, memory, near.apex, tracks.track[0].facet)) return Kept::nothing;
  const bool is_pressed = near.pressed > 0;
  if (!is_pressed && !near.by_points) return is_idle_guard(interface, m, x, velocity, memory, moved, near) ? Kept::guard : Kept::nothing;
  if (!is_pressed && !(memory.gap[near.apex] < between(interface, near.apex, tracks.track[0].facet).release_height)) return Kept::nothing;
  if (!(moved.now + in_a_step(moved) + element.depth < near.clear)) return Kept::nothing;
  if (near.by_points) return Kept::points;
  return moved.now < tracks.owned ? Kept::stencil : Kept::nothing;
}

/// Finds which apexes are in contact, or near to it, where the nodes would be.
///
/// returns  how far they can have gone against each other by the end of the step
Moved find(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const bool automatic = interface.bodies.count() > 0;  // which has been searched for
  const auto look = [&](const Vectors& x, const Vectors& way, double dt, double ahead) {
    if (!automatic) search_where_due(interface, x, way, memory, workspace);
    const Moved moved = along_way(memory.way, ahead);
    parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
      Near& near = memory.near[i];
      near.earlier = near.pressed;
      near.pressed = near.element.closed && m.dt > 0 ? near.element.apex.norm() : 0;
      if (near.rests && moved.now < near.clear) return;
      near.kept = kept_of(interface, m, x, all.velocity, memory, moved, near);
      if (near.kept != Kept::nothing) {
        near.element.moved = false;
        near.element.lost = 0;
        return;
      }
      const Feature before = memory.feature[near.apex];
      find_contact(interface, x, way, dt, moved, near, memory);
      near.element.moved = near.pressed > 0 && !same(memory.feature[near.apex], before);
      near.rests = near.tracks.count == 0 && near.element.count == 0;
    });
    return moved;
  };
  const auto apart = [&](const Vectors& v) { return speed_apart(v, {interface.apexes, interface.base_nodes}); };
  if (!automatic) memory.way += m.dt * apart(m.v);
  if (!(m.dt > 0)) look(m.x, m.v, 0, 0);  // at the start apexes may stand behind the surface
  return look(all.ahead, all.way, m.dt + m.next, automatic ? all.way_apart : m.next * apart(all.velocity));
}

/// Whether the foot of a point on the plane of a facet is outside of that facet.
bool has_foot_outside(const BaseSurface& base, const Vectors& x, const Vec3& p, Index facet) {
  const auto weight = height_over(base, x, {facet, geometry::Kind::facet, 0}, p).weight;
  return *std::min_element(weight.begin(), weight.end()) < 0;
}

}  // namespace

double reach_of(const Between& pair, double way) { return std::max(multipliers_reach * pair.depth, steps_to_touch * way); }

bool can_touch(const Between& pair, const Motion& m, double gap, double speed) {
  return gap <= reach_of(pair, m.next * speed);
}

namespace {

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

/// Whether a normal leads into the surface of the apex, and another one less: as that of a bevel where a flat surface touches the sole of a
/// body, and never its bevel.
bool leads_farther_in(const Interface& interface, const Vectors& x, Index apex, const Vec3& normal, const Vec3& other) {
  if (interface.own.facets.cols() == 0 || other.dot(normal) > 1 - 0.5 * uneven * uneven) return false;
  return reach_behind(interface.own, x, apex, normal) > std::max(uneven, reach_behind(interface.own, x, apex, other));
}

/// Sets nodes, weights, normal and gap of an apex over a facet, or over the face that it is half of.
void set(const Interface& interface, Index apex, const Stencil& stencil, const Vec3& normal, double gap, Multipliers& all, Condition& c) {
  c.gap = gap;
  c.normal = normal;
  add_member(apex, 1, all, c);
  for (int I = 0; I < 3; ++I) add_member(interface.base.facets(I, stencil.facet), -stencil.weight[I], all, c);
  if (stencil.fourth != 0) add_member(interface.base.half[stencil.facet].fourth, -stencil.fourth, all, c);
}

/// Nodes, weights, normal and gap of an apex over the feature of a stencil where the nodes are at t; false if it is out of reach.
///
/// A stencil with a push was found where the nodes would be: it counts however far the apex is now, and the push has the direction.
bool make(const Interface& interface, const Motion& m, const Memory& memory, const Near& near, Stencil& stencil, bool& has_moment,
          Multipliers& all, Condition& c) {
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
    set(interface, apex, stencil, too_near ? out : Vec3(arm / distance), distance - stencil.level, all, c);
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
      set(interface, apex, stencil, normal, over.height - stencil.level, all, c);
      return has_moment = true;
    }
  }
  // beside a rim, below its level: the normal from there to the apex leads along the surface, and nothing was penetrated
  if (stencil.kind != geometry::Kind::facet && near.tracks.count == 0 && over.height < 0) return false;
  if (stencil.kind == geometry::Kind::facet) over.weight = stencil.weight;
  else if (push > 0 && over.normal.dot(stencil.push) < 0) over.normal = -over.normal, over.height = -over.height;
  // over plates the foot would leave its node, and where several push each has its own
  const bool blends = near.element.count == 1 && stencil.level < blended * interface.base.size(stencil.facet);
  const Mat3* allowed = allowed_of(interface, near.apex);
  const auto find_foot = [&, from = over, fourth = stencil.fourth](bool blend) {
    over = from, stencil.fourth = fourth;
    if (stand_on_face(interface.base, m.x, p, feature(), blend, allowed, over, stencil.fourth)) return;
    stencil.fourth = 0;
    if (stencil.kind == geometry::Kind::facet) over = height_over(interface.base, m.x, feature(), p);
    if (blend && stencil.kind == geometry::Kind::facet && interface.base.half[stencil.facet].cut < 0)
      blend_over_facet(interface.base, m.x, p, feature(), allowed, over);
  };
  find_foot(blends);
  if (blends && leads_farther_in(interface, m.x, apex, over.normal, facet_normal(interface.base, m.x, stencil.facet))) find_foot(false);
  stencil.weight = over.weight;
  set(interface, apex, stencil, over.normal, over.height - stencil.level, all, c);
  // The normal turns as an apex passes an edge or vertex, or comes over another facet: what counts is how the gap changes in the free step.
  // Both gaps are over facets, since that over a warped face is another one.
  if (near.tracks.count == 0 || (near.element.count == 1 && stencil.kind != geometry::Kind::facet)) {
    const bool is_facet = stencil.kind == geometry::Kind::facet;
    const double start = is_facet ? height_over(interface.base, m.x, feature(), p).height - stencil.level : c.gap;
    c.gap += std::max(0.0, memory.gap[near.apex] - start - m.next * relative(c, all, all.velocity));
  }
  if (!(push > 0)) {
    double fastest = 0;
    for (const Member& one : members_of(c, all).subspan(1))
      fastest = std::max(fastest, (all.velocity.col(apex) - all.velocity.col(one.node)).squaredNorm());
    if (!can_touch(between(interface, near.apex, stencil.facet), m, c.gap, std::sqrt(fastest))) return false;
    if (!may_push(interface.own, m.x, apex, c.normal, most_behind(interface), allowed)) return false;
    const bool over_facet = stencil.kind == geometry::Kind::facet;
    return !over_facet || !is_flush_beside(interface, m.x, apex, stencil.facet, stencil.level, allowed);
  }
  return true;
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

/// Where an apex is just on a ridge or a corner and its sides push it alike, makes one stencil of theirs: to press on one side, and on
/// another, would turn a blow aside, and what was held could not be given back along the way it was taken.
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

/// Whether a stencil before this one has the other half of its face: both are one bilinear surface.
bool is_same_face(const BaseSurface& base, const ElementForces& element, int s) {
  const Half& half = base.half[element.stencil[s].facet];
  if (half.cut < 0) return false;
  const Index other = base.neighbour(half.cut, element.stencil[s].facet);
  for (int before = 0; before < s; ++before)
    if (element.stencil[before].apex != 0 && element.stencil[before].facet == other) return true;
  return false;
}

/// The rate a after a step in which a condition alone does the work E:  (a - free)/A (before + a)/2 = E.
double rate_for(double E, const Condition& c) {
  const double difference = c.before - c.free;
  return 0.5 * (std::sqrt(std::max(0.0, difference * difference + 4 * (c.before * c.free + 2 * c.per_mass * E))) - difference);
}

}  // namespace

Vec3 let_through(const Motion& m, const Member& one) {
  const Mat3* allowed = m.allowed[one.node];
  return allowed ? Vec3(*allowed * one.push) : one.push;
}

bool complete(const Motion& m, double pressed, double held, Multipliers& all, Condition& c) {
  double sum = 0;
  for (const Member& one : members_of(c, all)) sum += all.mobility(one.node) * let_through(m, one).squaredNorm();
  c.per_mass = m.rigid ? per_mass(*m.rigid, m, all, c) : sum;
  c.before = relative(c, all, m.v), c.free = relative(c, all, all.velocity);
  const double closing = (c.gap > 0 ? -c.gap : -corrected * c.gap) / m.next, impulse = 0.5 * pressed * (m.dt + m.next);
  const double from_held = impulse > 0 ? std::max(0.0, held) / impulse : 0;
  const double may = 2 * from_held - c.before;  // the work of this step; to stop again takes as much as to go apart
  c.least = std::min(closing, may > 0 ? 0.5 * may : may);
  // the last force makes a small impulse where the step has fallen, and what this rate takes alone is not
  if (from_held > 0 && (c.least - c.free) * (c.least + c.before) > 2 * c.per_mass * held) c.least = std::min(c.least, rate_for(held, c));
  return c.per_mass * m.mass(members_of(c, all)[0].node) > no_response;
}

namespace {

/// Where the apexes stand that come next in the list of near ones and stay over one bilinear face each.
struct Ahead {
  int count = 0, next = 0;
  std::array<bool, lanes> stands;                  ///< false: this is to be found alone
  std::array<std::array<Index, lanes>, 4> corner;  ///< around the face, from the first of its cut
  alignas(64) std::array<std::array<double, lanes>, 4> weight;
  alignas(64) std::array<std::array<double, lanes>, 3> normal;
  alignas(64) std::array<double, lanes> height;
};

constexpr std::array<int, 3> next_corner{1, 2, 0};

bool stays_over_face(const Interface& interface, const Near& near) {
  const Stencil& stencil = near.element.stencil[0];
  return near.kept == Kept::stencil && stencil.kind == geometry::Kind::facet && interface.base.half[stencil.facet].cut >= 0;
}

/// Finds where the apexes stand that come next, from a place in the list of near ones on.
void look_ahead(const Interface& interface, const Vectors& x, const Memory& memory, std::size_t from, Ahead& ahead) {
  std::array<Index, lanes> apex;
  alignas(64) std::array<double, lanes> a, b, band;
  ahead.count = ahead.next = 0;
  for (std::size_t i = from; i < memory.near.size() && ahead.count < lanes; ++i) {
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
    const double width = blended * interface.base.size(stencil.facet);
    band[lane] = stencil.level < width ? width : 0;
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

/// Makes the condition of a near apex as make() does, if it stays over a bilinear face. To be asked apex after apex.
bool make_ahead(const Interface& interface, const Vectors& x, const Memory& memory, Near& near, Ahead& ahead, Multipliers& all,
                Condition& c) {
  if (!stays_over_face(interface, near)) return false;
  if (ahead.next == ahead.count) look_ahead(interface, x, memory, static_cast<std::size_t>(&near - memory.near.data()), ahead);
  const int lane = ahead.next++;
  if (!ahead.stands[lane]) return false;
  Stencil& stencil = near.element.stencil[0];
  const int first = interface.base.half[stencil.facet].cut, second = next_corner[first], third = next_corner[second];
  c.normal = {ahead.normal[0][lane], ahead.normal[1][lane], ahead.normal[2][lane]};
  add_member(interface.apexes[near.apex], 1, all, c);
  for (int I = 0; I < 4; ++I) add_member(ahead.corner[I][lane], -ahead.weight[I][lane], all, c);
  stencil.weight[first] = ahead.weight[0][lane], stencil.fourth = ahead.weight[1][lane];
  stencil.weight[second] = ahead.weight[2][lane], stencil.weight[third] = ahead.weight[3][lane];
  c.gap = ahead.height[lane] - stencil.level;
  return true;
}

/// How much slip rate an impulse makes, at most: with the constraints, or as if all nodes were free. [1/kg]
double response(const Touch& touch, const Motion& m, bool constrained) {
  const Vec3 first = touch.normal.unitOrthogonal(), second = touch.normal.cross(first);
  const FrictionShares one = share_friction(touch, first), other = share_friction(touch, second);
  const auto product = [&](const FrictionShares& a, const FrictionShares& b) {
    const bool of_bodies = constrained && m.rigid;
    double sum = of_bodies ? product_of_bodies(*m.rigid, a, b, m.x) : 0;
    for (int i = 0; i < a.count; ++i) {
      const Index node = a.node[i];
      if (of_bodies && m.rigid->of_node[node] >= 0) continue;
      const Vec3 let = constrained && m.allowed[node] ? Vec3(*m.allowed[node] * b.force[i]) : b.force[i];
      sum += a.force[i].dot(let) / m.mass(node);
      if (a.turns[i] && b.turns[i]) sum += a.moment[i].dot(b.moment[i]) / m.inertia(m.rotation_of_node[node]);
    }
    return sum;
  };
  const double first_rate = product(one, one), other_rate = product(other, other);
  // the larger eigenvalue, whichever directions were taken
  return 0.5 * (first_rate + other_rate) + std::hypot(0.5 * (first_rate - other_rate), product(one, other));
}

}  // namespace

Index add_friction(const Touch& touch, const Coulomb& law, const Vec3& force, bool stuck, const Motion& m, Multipliers& all) {
  double per_mass = response(touch, m, true);
  if (!(per_mass > no_response / m.mass(touch.apex >= 0 ? touch.apex : touch.node[0]))) per_mass = response(touch, m, false);
  const Vec3 impulse = 0.5 * (m.dt + m.next) * (force - touch.normal.dot(force) * touch.normal);
  const Vec3 before = slip_rate(touch, m.v, m.omega, m.rotation_of_node);
  const Vec3 along = touch.normal.unitOrthogonal();
  all.frictions.push_back({.touch = touch, .coefficient = coefficient_at(law, stuck ? 0 : before.norm()), .per_mass = per_mass,
                           .bound = 0, .before = before, .stuck = Vec3::Zero(), .impulse = impulse, .change = Vec3::Zero(),
                           .met = impulse, .moved = Vec3::Zero(), .after = before, .along = {along, touch.normal.cross(along)}, .row = {}});
  return static_cast<Index>(all.frictions.size()) - 1;
}

namespace {

/// Lets sticks yield against their forces, so that friction takes back what it owes [J].
void let_yield(double owed, double depth, const Motion& m, std::size_t first, Multipliers& all) {
  if (!(owed > 0)) return;
  double sum = 0;
  for (std::size_t k = first; k < all.frictions.size(); ++k) sum += all.frictions[k].impulse.norm();
  if (!(sum > 0)) return;
  const double speed = std::min(paid_back * owed / sum, most_yield * depth / m.next);
  for (std::size_t k = first; k < all.frictions.size(); ++k) {
    FrictionCondition& friction = all.frictions[k];
    const double size = friction.impulse.norm();
    if (size > 0) friction.stuck = -speed / size * friction.impulse;
  }
}

/// Whether a stencil before this one is of the same part of the base, whose points both would have.
bool has_same_points(const BaseSurface& base, const Vectors& x, const ElementForces& element, int s) {
  const Vec3 normal = facet_normal(base, x, element.stencil[s].facet);
  return std::any_of(element.stencil.begin(), element.stencil.begin() + s, [&](const Stencil& before) {
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
/// flush face is on all sides of the rim, and which one its track names is a chance.
OverPoints sum_where_faces_lie(const Interface& interface, const Vectors& x, Index apex, int s, PointWork& work, ElementForces& element) {
  const BaseSurface& base = interface.base;
  Stencil& stencil = element.stencil[s];
  const OverPoints here = sum_points(interface, x, apex, stencil.facet, work);
  if (here.area > 0 || here.of_node > 0 || here.covered_elsewhere) return here;
  const auto is_taken = [&](const Vec3& side) {
    for (int one = 0; one < element.count; ++one)
      if (facet_normal(base, x, element.stencil[one].facet).dot(side) > same_part) return true;  // of this one too
    return false;
  };
  Index best = -1;
  double most = 0, nearest = infinite;
  for (const Index node : base.facets.col(stencil.facet))
    for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r) {
      const Index other = base.ring[static_cast<std::size_t>(r)];
      if (is_taken(facet_normal(base, x, other))) continue;
      const double area = sum_points(interface, x, apex, other, work).area, apart = distance_to(interface, x, apex, other);
      const bool same_side = std::abs(area - most) < just_on * area;
      if (same_side ? apart < nearest : area > most) best = other, most = area, nearest = apart;
    }
  if (best >= 0) lay_on(interface, x, apex, best, stencil);
  return sum_points(interface, x, apex, stencil.facet, work);
}

/// How fast an apex moves against the facet of a stencil in the step to come. [m/s]
double speed_over(const Interface& interface, const Multipliers& all, const Near& near, const Stencil& stencil) {
  double fastest = 0;
  for (int I = 0; I < 3; ++I) {
    const Index node = interface.base.facets(I, stencil.facet);
    fastest = std::max(fastest, (all.velocity.col(interface.apexes[near.apex]) - all.velocity.col(node)).squaredNorm());
  }
  return std::sqrt(fastest);
}

/// Whether a guard acts: where it would be deeper than it may be, in this step or soon. Others would slow the sweeps down.
bool guard_acts(const Interface& interface, const Motion& m, const Near& near, Index facet, const Multipliers& all, Condition& c) {
  const double closing = steps_to_touch * m.next * std::min(0.0, relative(c, all, all.velocity));
  if (!(near.pressed > 0) && !(c.gap + closing < 0)) return false;  // what it is allowed would only add to this
  c.gap += allowance(interface, m.x, near.apex, facet);
  return near.pressed > 0 || c.gap + closing < 0;
}

/// The height over points at which a contact closes: that of the track where the apex came in deep, as an overlap that is accepted; else
/// that of the contact, since an apex that comes in beside a rim or onto a flush surface does so alone. [m]
double level_of_points(const Interface& interface, const Memory& memory, Index apex, const Stencil& stencil) {
  const double height = contact_height(interface, memory, apex), of_track = stencil.level - stand_off(interface.base, stencil.facet);
  return height - of_track > level_by * interface.base.longest(stencil.facet) ? of_track : height;
}

/// Moves an apex whose points are known alone to the facet that it is over now.
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
    stand_on_face(interface.base, x, x.col(interface.apexes[near.apex]), {stencil.facet, geometry::Kind::facet, 0}, false, nullptr,
                  plane.over, fourth);
  stencil.weight = plane.over.weight, stencil.fourth = fourth;
  return true;
}

/// Finds the condition of a stencil over points of the faces around the apex, or by the apex itself where none of them lies on the base;
/// false if there is none. Friction has the foot of the apex in any case.
bool find_over_points(const Interface& interface, const Motion& m, const Memory& memory, Near& near, int s, Moved moved, PointWork& work,
                      Multipliers& all, Condition& c) {
  Stencil& stencil = near.element.stencil[s];
  const bool pushes = !stencil.push.isZero(0);
  if (!pushes && memory.gap[near.apex] > farther_than_points * interface.base.size(stencil.facet) &&
      !can_touch(between(interface, near.apex, stencil.facet), m, 0.5 * memory.gap[near.apex], speed_over(interface, all, near, stencil)))
    return false;
  OverPoints sum = sum_where_faces_lie(interface, m.x, near.apex, s, work, near.element);
  if (has_same_points(interface.base, m.x, near.element, s)) return false;
  const Index side = stencil.facet;
  const double level = level_of_points(interface, memory, near.apex, stencil);
  const bool by_points_alone = is_by_points_alone(interface, m.x, near, sum, level, stencil);
  near.by_points = by_points_alone && s == 0;
  const bool stands = !by_points_alone && make(interface, m, memory, near, stencil, near.element.has_moment, all, c);
  if (!(sum.area > 0) && !(sum.covered_elsewhere && !(sum.of_node > 0))) return stands;
  // points may leave a node no deeper than a guard, also where nodes that are better covered have its points
  if (!(sum.area > 0)) return stands && guard_acts(interface, m, near, stencil.facet, all, c);
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
    for (const Member& one : members_of(c, all)) add_to(one.node, sum.of_node * one.weight * c.normal, one.weight > 0, work);
  if (!by_points_alone && (!stands || stencil.facet != side)) lay_on(interface, m.x, near.apex, side, stencil);
  all.members.resize(static_cast<std::size_t>(c.first)), c.nodes = 0;
  if (!(area > 0)) return false;
  c.normal = along / area, c.gap = sum.gap / area;
  for (const Share& one : work.sum) {
    // on like meshes these are 0 or 1, and round-off beside that would set what lies still in motion
    const Vec3 push = (one.push / area).unaryExpr([](double part) {
      const double whole = std::nearbyint(part);
      return std::abs(part - whole) < no_weight ? whole : part;
    });
    if (c.nodes > 0 && push.isZero(0)) continue;
    const double weight = push.norm();
    add_member(one.node, one.of_apex_side ? weight : -weight, push, all, c);
  }
  stencil.over_points = true;
  if (pushes) return true;
  double fastest = 0;
  for (const Member& one : members_of(c, all)) {
    const Vec3 speed = all.velocity.col(interface.apexes[near.apex]) - all.velocity.col(one.node);
    fastest = std::max(fastest, speed.squaredNorm());
  }
  if (can_touch(between(interface, near.apex, stencil.facet), m, c.gap, std::sqrt(fastest))) return true;
  if (near.element.count == 1) near.no_condition_until = moved.until(c.gap);
  near.by_points = false;  // it may leave its base
  return false;
}

/// Whether an apex cannot have come so near since it was last looked at that it has a condition.
bool has_no_condition(const Interface& interface, Moved moved, const Near& near) {
  if (near.pressed > 0 || near.element.count != 1 || !(near.no_condition_until > moved.now)) return false;
  const double reach = reach_of(between(interface, near.apex, near.element.stencil[0].facet), 0.5 * (moved.now - moved.from));
  return moved.now + reach < near.no_condition_until;
}

/// Finds the condition of a stencil; false if there is none.
bool find(const Interface& interface, const Motion& m, const Memory& memory, Near& near, int s, Moved moved, Ahead& ahead,
          PointWork& work, Multipliers& all, Condition& c) {
  Stencil& stencil = near.element.stencil[s];
  stencil.over_points = false, stencil.shares = 0;
  const Heights heights = between(interface, near.apex, stencil.facet).heights;
  bool made = interface.heights == Heights::nodes && make_ahead(interface, m.x, memory, near, ahead, all, c);
  if (!made && (std::isnan(stencil.level) || is_same_face(interface.base, near.element, s))) return false;
  if (!made && heights == Heights::points) made = find_over_points(interface, m, memory, near, s, moved, work, all, c);
  else if (!made) made = make(interface, m, memory, near, stencil, near.element.has_moment, all, c);
  if (made && heights == Heights::guards) made = guard_acts(interface, m, near, stencil.facet, all, c);
  return made && complete(m, near.pressed, memory.restitution[near.apex].held, all, c);
}

}  // namespace

Condition& begin_condition(Multipliers& all) {
  Condition& c = all.conditions.emplace_back();
  c.first = static_cast<Index>(all.members.size());
  return c;
}

void take_back(Multipliers& all) {
  all.members.resize(static_cast<std::size_t>(all.conditions.back().first));
  all.conditions.pop_back();
}

void add(const Contactor& one, Multipliers& all) {
  all.contactors.push_back(one);
  for (Index i = one.first; i < one.last; ++i) {
    const Condition& c = all.conditions[i];
    for (const Member& at : members_of(c, all)) all.shared(at.node) += one.area * std::abs(at.weight);
  }
  if (one.friction < 0) return;
  const Touch& touch = all.frictions[one.friction].touch;
  if (touch.apex >= 0) all.rubbed(touch.apex) += one.area;
  for (int j = 0; j < touch.nodes; ++j) {
    all.rubbed(touch.node[j]) += one.area * std::abs(touch.weight[j]);
    if (touch.apex < 0) all.shared(touch.node[j]) += one.area * touch.lift[j].norm();
  }
}

namespace {

/// Where an apex rubs that several bodies may press: on that which pressed it most in the step before, with the pushes of this one alone.
/// Its slip against each of them is another one.
struct Rubbing {
  const Stencil* foot = nullptr;  ///< the first on that body
  Index place = 0;                ///< of its condition among those of the apex
  unsigned conditions = 0;        ///< a bit for each that is of that body
};
Rubbing rubbing_of(const Interface& interface, const Near& near) {
  const Bodies& bodies = interface.bodies;
  const auto body_of = [&](Index facet) { return bodies.names.empty() ? 0 : bodies.of_facet[static_cast<std::size_t>(facet)]; };
  const auto all_of = [&](Index body) {
    Rubbing found;
    Index place = 0;
    for (int s = 0; s < near.element.count; ++s) {
      const Stencil& stencil = near.element.stencil[s];
      if (stencil.apex == 0) continue;
      if (body < 0) body = body_of(stencil.facet);
      if (body_of(stencil.facet) == body) {
        if (found.foot == nullptr) found.foot = &stencil, found.place = place;
        found.conditions |= 1u << place;
      }
      ++place;
    }
    return found;
  };
  const Rubbing found = all_of(near.pressed_most < 0 ? -1 : body_of(near.pressed_most));
  return found.foot != nullptr ? found : all_of(-1);
}

}  // namespace

Multipliers make_multipliers(std::span<const Interface> interfaces, std::span<const RigidPlane> planes, Index nodes, Index plate_nodes) {
  constexpr std::size_t most_of_an_apex = 3;  // conditions; some may have more, but not many
  Multipliers all;
  all.ahead = all.way = all.velocity = Vectors::Zero(3, nodes);
  all.spin = Vectors::Zero(3, plate_nodes);
  all.shared = all.rubbed = all.mobility = Scalars::Zero(nodes);
  std::size_t apexes = 0;
  std::vector<char> acts(static_cast<std::size_t>(nodes), 0), always = acts;
  const auto see = [&](const Subset& some, bool is_automatic = false) {
    for (const Index node : some) acts[static_cast<std::size_t>(node)] = 1;
    for (const Index node : some)
      if (!is_automatic) always[static_cast<std::size_t>(node)] = 1;
  };
  for (const Interface& interface : interfaces) {
    if (!by_multipliers(interface)) continue;
    const bool is_automatic = interface.bodies.count() > 0;
    see(interface.apexes, is_automatic), see(interface.base_nodes, is_automatic);
    if (!bonded_by_multipliers(interface)) apexes += interface.apexes.size();
  }
  for (const RigidPlane& plane : planes) {
    if (!by_multipliers(plane)) continue;
    see(plane.nodes);
    apexes += plane.nodes.size();
  }
  for (Index node = 0; node < nodes; ++node)
    if (acts[static_cast<std::size_t>(node)] != 0) all.nodes.push_back(node);
  for (const Index node : all.nodes)
    if (always[static_cast<std::size_t>(node)] != 0) all.always.push_back(node);
  all.conditions.reserve(most_of_an_apex * apexes);
  all.members.reserve(5 * most_of_an_apex * apexes);
  for (auto* list : {&all.rows.velocity, &all.rows.given, &all.rows.push}) list->reserve(5 * most_of_an_apex * apexes);
  for (auto* list : {&all.rows.slot, &all.rows.mover_of_slot, &all.rows.copies}) list->reserve(5 * most_of_an_apex * apexes);
  all.rows.movers.reserve(all.nodes.size());
  all.frictions.reserve(apexes);
  all.contactors.reserve(apexes);
  all.unreleased.reserve(apexes);
  all.at_node.resize(static_cast<std::size_t>(nodes));
  all.first.reserve(interfaces.size() + planes.size() + 1);
  all.progress.reserve(apexes / contactors_of_a_range + 1);
  all.pools.reserve(interfaces.size() + planes.size());
  all.bonds = make_bonds(interfaces, nodes);
  return all;
}

namespace {

/// per_time  [1/s] of this step and the next one together
NEREID_HOT void see_ahead(Index node, double per_time, const Motion& m, Multipliers& all) {
  const Vec3 way = m.next * all.velocity.col(node);
  all.ahead.col(node) = m.x.col(node) + way;
  all.way.col(node) = per_time * (m.dt * m.v.col(node) + way);
}

}  // namespace

void see_ahead(const Subset& nodes, const Motion& m, Multipliers& all) {
  const double per_time = 1 / (m.dt + m.next);
  for (const Index node : nodes) see_ahead(node, per_time, m, all);
}

void look_ahead(const Subset& nodes, const Motion& m, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next), per_time = 1 / (m.dt + m.next);
  for (const Index node : nodes) {
    all.shared(node) = all.rubbed(node) = 0;
    all.mobility(node) = 1 / m.mass(node);
    Vec3 change = h * all.mobility(node) * m.force.col(node);
    if (m.allowed[node]) change = *m.allowed[node] * change;
    all.velocity.col(node) = m.v.col(node) + change;
    see_ahead(node, per_time, m, all);
    const Index turns = m.rotation_of_node[node];
    if (turns < 0) continue;
    Vec3 turn = h / m.inertia(turns) * m.moment.col(turns);
    if (m.allowed_rotation[turns]) turn = *m.allowed_rotation[turns] * turn;
    all.spin.col(turns) = m.omega.col(turns) + turn;
  }
}

void find_conditions(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  if (interface.kind == InterfaceKind::edges) return find_crossings(interface, m, memory, workspace, all), all.spent.end(Stage::edges);
  const double h = 0.5 * (m.dt + m.next);
  const std::size_t first_friction = all.frictions.size();
  const Moved moved = find(interface, m, memory, workspace, all);
  all.spent.end(Stage::track);
  if (interface.heights != Heights::nodes) begin_points(interface, m.x, workspace.points);
  Ahead ahead;
  for (Near& near : memory.near) {
    if (near.kept == Kept::guard) continue;
    const auto first = static_cast<Index>(all.conditions.size());
    if (near.kept == Kept::points) follow_facet(interface, m.x, memory, near);
    near.by_points = false;
    const bool has_none = has_no_condition(interface, moved, near);
    if (!has_none) near.no_condition_until = -infinite;
    join_on_ridge(interface.base, m.x, m.x.col(interface.apexes[near.apex]), near.element);
    for (int s = 0; s < near.element.count; ++s) {
      Stencil& stencil = near.element.stencil[s];
      Condition& c = begin_condition(all);
      if (has_none || !find(interface, m, memory, near, s, moved, ahead, workspace.points, all, c)) {
        stencil.apex = 0, stencil.over_points = false, stencil.weight = {}, stencil.fourth = 0, stencil.push.setZero();
        take_back(all);
        continue;
      }
      c.impulse = c.met = near.element.count == 1 ? (memory.has_trend ? trend(near) : near.pressed) * h : 0;
      stencil.push = c.normal;
    }
    const auto last = static_cast<Index>(all.conditions.size());
    Restitution& restitution = memory.restitution[near.apex];
    if (last == first) {
      if (near.kept == Kept::points) memory.status[near.apex] = Status::open;
      end({&interface.apexes[near.apex], 1}, interface.restitution, restitution, memory, all);
      continue;
    }
    const double area = interface.area(near.apex);
    const Rubbing rubbing = rubbing_of(interface, near);
    const Index foot = first + rubbing.place, facet = rubbing.foot->facet;
    Index friction = -1;
    if (interface.friction.coefficient > 0 && m.dt > 0) {
      const Feature on{facet, geometry::Kind::facet, 0};
      const Touch touch = touch_of(interface, m.x, near.apex, on, all.conditions[foot].normal, rubbing.foot);
      const Vec3 force = near.friction.acts ? near.friction.force : Vec3(Vec3::Zero());
      friction = add_friction(touch, interface.friction, force, near.friction.stuck, m, all);
    }
    const Between& pair = between(interface, near.apex, facet);
    const double part = pair.heights != Heights::nodes ? 1 : interface.pass_factor;
    add({.memory = &restitution, .first = first, .last = last, .friction = friction, .foot = foot, .rubs = rubbing.conditions, .area = area,
         .depth = pair.depth, .impedance = part * pair.impedance * area,
         .square = interface.restitution * interface.restitution}, all);
  }
  let_yield(memory.friction_owed, interface.depth, m, first_friction, all);
  all.spent.end(Stage::conditions);
}

void find_conditions(const RigidPlane& plane, const Motion& m, PlaneMemory& memory, Multipliers& all) {
  const std::size_t first_friction = all.frictions.size();
  for (std::size_t i = 0; i < plane.nodes.size(); ++i) {
    const Index node = plane.nodes[i];
    const auto first = static_cast<Index>(all.conditions.size());
    Condition& c = begin_condition(all);
    c.normal = plane.normal;
    add_member(node, 1, all, c);
    c.gap = (m.x.col(node) - plane.point).dot(plane.normal);
    const double way = steps_to_touch * m.next * std::abs(plane.normal.dot(all.velocity.col(node)));
    const bool far = !(memory.force[i] > 0) && c.gap > std::max(multipliers_reach * plane.depth, way);
    if (far || !complete(m, m.dt > 0 ? memory.force[i] : 0, memory.restitution[i].held, all, c)) {
      end({&node, 1}, plane.restitution, memory.restitution[i], memory, all);
      memory.next_force[i] = 0;
      if (!memory.next_friction.empty()) memory.next_friction[i].setZero(), memory.stuck[i] = 0;
      take_back(all);
      continue;
    }
    const double area = plane.area(static_cast<Eigen::Index>(i));
    c.impulse = c.met = memory.force[i] * 0.5 * (m.dt + m.next);
    Index friction = -1;
    if (plane.friction.coefficient > 0 && m.dt > 0) {
      Touch touch;
      touch.normal = plane.normal, touch.apex = node, touch.nodes = 0;
      friction = add_friction(touch, plane.friction, memory.friction[i], memory.stuck[i] != 0, m, all);
    }
    add({.memory = &memory.restitution[i], .first = first, .last = first + 1, .friction = friction, .area = area, .depth = plane.depth,
         .impedance = plane.impedance * area, .square = plane.restitution * plane.restitution}, all);
  }
  let_yield(memory.friction_owed, plane.depth, m, first_friction, all);
}

void find_change(double pressed, const Vec3& rate, FrictionCondition& friction) {
  const double limit = friction.coefficient * pressed;
  friction.change.setZero();
  if (!(limit > 0) && friction.impulse.isZero(0)) return;
  Vec3 now = friction.impulse - (rate - friction.stuck) / friction.bound;
  const double size = now.norm();
  friction.slides = size > limit;
  if (friction.slides) now *= limit / size;
  friction.change = now - friction.impulse;
}

void move_all(const Motion& m, Multipliers& all) {
  move(all.rows);
  if (!all.bonds.touched) return;
  for (const Mover& mover : all.rows.movers)
    if (mover.kind == MoverKind::node) all.velocity.col(mover.of) = velocity_of(mover, all.rows);
  hold(m, all.velocity, all.bonds);
  for (const Mover& mover : all.rows.movers)
    if (mover.kind == MoverKind::node && all.bonds.has[mover.of]) place(mover, padded(all.velocity.col(mover.of)), all.rows);
}

void apply_changes(const Motion& m, Multipliers& all) {
  for (const Contactor& one : all.contactors) {
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      if (c.change == 0) continue;
      c.impulse += c.change;
      give(c.row, c.change, all.rows);
    }
    if (one.friction < 0 || all.frictions[one.friction].change.isZero(0)) continue;
    FrictionCondition& condition = all.frictions[one.friction];
    condition.impulse += condition.change;
    give(condition, condition.change, all.rows);
  }
  move_all(m, all);
}

void find_work(const Motion& m, Multipliers& all) {
  find_velocities(m, all);
  for (Contactor& one : all.contactors) {
    one.work = 0;
    for (Index i = one.first; i < one.last; ++i) {
      Condition& c = all.conditions[i];
      c.after = rate(c, all);
      one.work += work(c, c.after);
    }
  }
  for (FrictionCondition& condition : all.frictions) {
    condition.after = rate(condition, all);
    condition.work = work(condition, condition.after);
  }
}

}  // namespace nereid::contact
