#include "contact/multiplier/assemble.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contact/multiplier/over_facet.hpp"
#include "contact/multiplier/over_points.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "contact/multiplier/stick.hpp"
#include "contact/search/near.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

/// By how much nodes go against each other from the start of a step to its end and back: a depth is no larger than it was by that. [m]
double in_a_step(const Moved& moved) { return moved.now - moved.from; }

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

void find_conditions(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const double h = 0.5 * (m.dt + m.next);
  const std::size_t first_friction = all.frictions.size();
  if (by_shapes_alone(interface)) {
    search_where_due(interface, m.x, all.way, memory, workspace);
    find_shape_conditions(interface, m, memory, all);
    let_yield(memory.friction_owed, interface.depth, m, first_friction, all);
    return all.spent.end(Stage::conditions);
  }
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
  find_shape_conditions(interface, m, memory, all);
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
  find_shape_conditions(plane, m, memory, all);
  let_yield(memory.friction_owed, plane.depth, m, first_friction, all);
}

}  // namespace nereid::contact
