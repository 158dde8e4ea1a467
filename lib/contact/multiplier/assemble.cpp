#include "contact/multiplier/assemble.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "contact/multiplier/over_facet.hpp"
#include "contact/multiplier/over_points.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "contact/multiplier/stick.hpp"
#include "contact/search/body_ways.hpp"
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
  if (near.friction->acts || memory.restitution[near.apex].held != 0 || stencil.kind != geometry::Kind::facet) return false;
  const Between& pair = between(interface, near.apex, stencil.facet);
  if (pair.heights != Heights::guards || std::isnan(stencil.level)) return false;
  FeatureHeight over;
  const Index facet = facet_below(interface.base, x, x.col(interface.apexes[near.apex]), stencil.facet, over);
  if (facet < 0) return false;
  const OverPlane plane = over_plane(interface, x, near.apex, facet, stencil.level);
  Vec3 speed = velocity.col(interface.apexes[near.apex]);
  for (int I = 0; I < 3; ++I) speed -= plane.over.weight[I] * velocity.col(interface.base.facets(I, facet));
  const double gap = plane.over.height - stencil.level, closing = times * steps_to_touch * m.next * std::abs(plane.over.normal.dot(speed));
  const bool is_idle = gap < pair.release_height && moved.now + in_a_step(moved) - gap < near.safe_distance &&
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
  if (!(moved.now + in_a_step(moved) + element.depth < near.safe_distance)) return Kept::nothing;
  if (near.by_points) return Kept::points;
  return moved.now < tracks.owned ? Kept::stencil : Kept::nothing;
}

/// Finds which apexes are in contact, or near to it, where the nodes would be.
///
/// returns  how far they can have gone against each other by the end of the step
Moved find(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const bool automatic = interface.bodies.count() > 0;  // which has been searched for
  // ahead  [m] way of the step to come; of an automatic contact, whose bodies each have their own, its length [s]
  const auto look = [&](const Vectors& x, const Vectors& way, double dt, double ahead) {
    if (!automatic) search_where_due(interface, x, way, memory, workspace);
    const Moved of_all = along_way(memory.way, ahead);
    parallel_for(static_cast<Index>(memory.near.size()), 64, [&](Index i) {
      Near& near = memory.near[i];
      const Moved moved = automatic ? moved_of_body(memory, workspace, interface.bodies.of_apex[near.apex], ahead) : of_all;
      if (!m.again) near.earlier = near.pressed, near.pressed = near.element.closed && m.dt > 0 ? near.element.apex.norm() : 0;
      if (near.is_idle && moved.now < near.safe_distance) return;
      near.kept = kept_of(interface, m, x, all.velocity, memory, moved, near);
      if (near.kept != Kept::nothing) {
        near.element.moved = false;
        near.element.lost = 0;
        return;
      }
      const Feature before = memory.feature[near.apex];
      find_contact(interface, x, way, dt, moved, near, memory);
      near.element.moved = near.pressed > 0 && !same(memory.feature[near.apex], before);
      near.is_idle = near.tracks.count == 0 && near.element.count == 0;
    });
    return of_all;
  };
  const auto apart = [&](const Vectors& v) { return speed_apart(v, {interface.apexes, interface.base_nodes}); };
  if (automatic) find_speeds_apart(interface, all.velocity, workspace);
  else if (!m.again) memory.way += m.dt * apart(m.v);
  if (!(m.dt > 0)) look(m.x, m.v, 0, 0);  // at the start apexes may stand behind the surface
  return look(all.ahead, all.way, m.dt + m.next, automatic ? m.next : m.next * apart(all.velocity));
}

/// Whether an apex cannot have come so near since it was last looked at that it has a condition.
bool has_no_condition(const Interface& interface, Moved moved, const Near& near) {
  if (near.pressed > 0 || near.element.count != 1 || !(near.no_condition_until > moved.now)) return false;
  const double reach = reach_of(between(interface, near.apex, near.element.stencil[0].facet), 0.5 * (moved.now - moved.from));
  return moved.now + reach < near.no_condition_until;
}

/// A range of near apexes, whose conditions are found one after the other.
struct Range {
  Index first, last;
  Ahead ahead;
};

/// Finds the condition of a stencil; false if there is none.
bool find(const Interface& interface, const Motion& m, const Memory& memory, Near& near, int s, Moved moved, Range& range,
          const PointWork& work, const Multipliers& all, FoundInRange& found, Condition& c) {
  Stencil& stencil = near.element.stencil[s];
  stencil.over_points = false, stencil.shares = 0;
  const Heights heights = between(interface, near.apex, stencil.facet).heights;
  bool made = interface.heights == Heights::nodes && make_ahead(interface, m.x, memory, near, range.last, range.ahead, found.list, c);
  if (!made && (std::isnan(stencil.level) || is_same_face(interface.base, near.element, s))) return false;
  if (!made && heights == Heights::points) made = find_over_points(interface, m, memory, near, s, moved, work, found, all, c);
  else if (!made) made = make(interface, m, memory, near, stencil, near.element.has_moment, all, found.list, c);
  if (made && heights == Heights::guards) made = guard_acts(interface, m, near, stencil.facet, all, found.list, c);
  return made && complete(m, near.pressed, memory.restitution[near.apex].held, all, found.list, c);
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

/// Finds the conditions of a range of near apexes; m, memory and all are read, but for what is of these apexes alone.
template <class MovedOf>
void find_in_range(const Interface& interface, const Motion& m, MovedOf&& moved_of, const PointWork& work, const Multipliers& all,
                   Range& range, Memory& memory, FoundInRange& found) {
  const double h = 0.5 * (m.dt + m.next);
  found.list.conditions.clear(), found.list.members.clear(), found.frictions.clear(), found.contactors.clear(), found.ended.clear();
  begin_range(found.points);
  for (Index i = range.first; i < range.last; ++i) {
    Near& near = memory.near[static_cast<std::size_t>(i)];
    if (near.kept == Kept::guard) continue;
    const Moved moved = moved_of(near);
    const auto first = static_cast<Index>(found.list.conditions.size());
    if (near.kept == Kept::points) follow_facet(interface, m.x, memory, near);
    near.by_points = false;
    const bool has_none = has_no_condition(interface, moved, near);
    if (!has_none) near.no_condition_until = -infinite;
    join_on_ridge(interface.base, m.x, m.x.col(interface.apexes[near.apex]), near.element);
    for (int s = 0; s < near.element.count; ++s) {
      Stencil& stencil = near.element.stencil[s];
      Condition& c = begin_condition(found.list);
      if (has_none || !find(interface, m, memory, near, s, moved, range, work, all, found, c)) {
        stencil.apex = 0, stencil.over_points = false, stencil.weight = {}, stencil.fourth = 0, stencil.push.setZero();
        take_back(found.list);
        continue;
      }
      c.impulse = c.met = near.element.count == 1 ? (memory.has_trend ? trend(near) : near.pressed) * h : 0;
      stencil.push = c.normal;
    }
    const auto last = static_cast<Index>(found.list.conditions.size());
    Restitution& restitution = memory.restitution[near.apex];
    if (last == first) {
      if (near.kept == Kept::points) memory.status[near.apex] = Status::open;
      if (restitution.held > 0) found.ended.push_back(i);
      else restitution = {};
      continue;
    }
    const Rubbing rubbing = rubbing_of(interface, near);
    const Index foot = first + rubbing.place, facet = rubbing.foot->facet;
    const Vec3 normal = found.list.conditions[static_cast<std::size_t>(foot)].normal;
    const bool has_just_touched = near.pressed > 0 && near.earlier == 0;
    if (!(near.area > 0) || has_just_touched)  // it keeps it while it is pressed
      near.area = mesh::tributary_area_loaded(interface.faces, m.x, near.apex, normal, interface.area(near.apex));
    Index friction = -1;
    if (interface.friction.coefficient > 0 && m.dt > 0) {
      const Feature on{facet, geometry::Kind::facet, 0};
      const Touch touch = touch_of(interface, m.x, near.apex, on, normal, rubbing.foot);
      const Vec3 force = near.friction->acts ? near.friction->force : Vec3(Vec3::Zero());
      friction = add_friction(touch, interface.friction, force, near.friction->stuck, m, found.frictions);
    }
    const Between& pair = between(interface, near.apex, facet);
    const double part = pair.heights != Heights::nodes ? 1 : interface.pass_factor;
    found.contactors.push_back({.memory = &restitution, .first = first, .last = last, .friction = friction, .foot = foot,
                                .rubs = rubbing.conditions, .area = interface.area(near.apex), .depth = pair.depth,
                                .impedance = part * pair.impedance * near.area,
                                .square = interface.restitution * interface.restitution});
  }
}

/// Appends the conditions of a range.
void append(const FoundInRange& found, Multipliers& all) {
  const auto first = static_cast<Index>(all.conditions.size()), first_friction = static_cast<Index>(all.frictions.size());
  const auto first_member = static_cast<Index>(all.members.size());
  all.conditions.insert(all.conditions.end(), found.list.conditions.begin(), found.list.conditions.end());
  all.members.insert(all.members.end(), found.list.members.begin(), found.list.members.end());
  all.frictions.insert(all.frictions.end(), found.frictions.begin(), found.frictions.end());
  for (auto c = all.conditions.begin() + first; c != all.conditions.end(); ++c) c->first += first_member;
  for (Contactor one : found.contactors) {
    one.first += first, one.last += first, one.foot += first;
    if (one.friction >= 0) one.friction += first_friction;
    add(one, all);
  }
}

}  // namespace

void find_conditions(const Interface& interface, const Motion& m, Memory& memory, Workspace& workspace, Multipliers& all) {
  const std::size_t first_friction = all.frictions.size();
  if (by_shapes_alone(interface)) {
    search_where_due(interface, m.x, all.way, memory, workspace);
    find_shape_conditions(interface, m, memory, all);
    let_yield(memory.friction_deficit, interface.depth, m, first_friction, all);
    return all.spent.end(Stage::conditions);
  }
  const bool automatic = interface.bodies.count() > 0;
  const Moved moved = find(interface, m, memory, workspace, all);
  const auto moved_of = [&](const Near& near) {
    return automatic ? moved_of_body(memory, workspace, interface.bodies.of_apex[static_cast<std::size_t>(near.apex)], m.next) : moved;
  };
  all.spent.end(Stage::track);
  if (interface.heights != Heights::nodes) begin_points(interface, m.x, workspace.points);
  const auto count = static_cast<Index>(memory.near.size()), ranges = (count + apexes_of_conditions - 1) / apexes_of_conditions;
  if (all.found.size() < static_cast<std::size_t>(ranges)) all.found.resize(static_cast<std::size_t>(ranges));
  parallel_for(ranges, 1, [&](Index r) {
    Range range{r * apexes_of_conditions, std::min(count, (r + 1) * apexes_of_conditions), {}};
    find_in_range(interface, m, moved_of, workspace.points, all, range, memory, all.found[static_cast<std::size_t>(r)]);
  });
  for (Index r = 0; r < ranges; ++r) {
    FoundInRange& found = all.found[static_cast<std::size_t>(r)];
    append(found, all);
    end_range(found.points, workspace.points);
    for (const Index i : found.ended) {
      const Index apex = memory.near[static_cast<std::size_t>(i)].apex;
      end({&interface.apexes[static_cast<std::size_t>(apex)], 1}, interface.restitution, memory.restitution[static_cast<std::size_t>(apex)],
          memory, all);
    }
  }
  find_shape_conditions(interface, m, memory, all);
  let_yield(memory.friction_deficit, interface.depth, m, first_friction, all);
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
    if (far || !complete(m, m.dt > 0 ? memory.force[i] : 0, memory.restitution[i].held, all, all, c)) {
      end({&node, 1}, plane.restitution, memory.restitution[i], memory, all);
      memory.next_force[i] = memory.area[i] = 0;
      if (!memory.next_friction.empty()) memory.next_friction[i].setZero(), memory.stuck[i] = 0;
      take_back(all);
      continue;
    }
    const double whole = plane.area(static_cast<Eigen::Index>(i));
    double& loaded = memory.area[i];
    if (!(loaded > 0) || !(memory.force[i] > 0))  // it keeps it while it is pressed
      loaded = mesh::tributary_area_loaded(plane.faces, m.x, static_cast<Index>(i), plane.normal, whole);
    c.impulse = c.met = memory.force[i] * 0.5 * (m.dt + m.next);
    Index friction = -1;
    if (plane.friction.coefficient > 0 && m.dt > 0) {
      Touch touch;
      touch.normal = plane.normal, touch.apex = node, touch.nodes = 0;
      friction = add_friction(touch, plane.friction, memory.friction[i], memory.stuck[i] != 0, m, all.frictions);
    }
    add({.memory = &memory.restitution[i], .first = first, .last = first + 1, .friction = friction, .area = whole, .depth = plane.depth,
         .impedance = plane.impedance * loaded, .square = plane.restitution * plane.restitution}, all);
  }
  find_shape_conditions(plane, m, memory, all);
  let_yield(memory.friction_deficit, plane.depth, m, first_friction, all);
}

}  // namespace nereid::contact
