#include "contact/multiplier/book.hpp"

#include <algorithm>

#include "contact/multiplier/assemble.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/shape_points.hpp"
#include "contact/multiplier/stick.hpp"
#include "contact/tracking/depth.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

constexpr double is_trend = 0.04;  // of the squared changes of impulses: less that their trend left of them, and it is trusted once more

/// Whether the forces of all apexes can have a moment, and not only of those that say so.
bool all_have_moments(const Interface& interface) { return !interface.allowed.empty() || interface.weights == Weights::paper; }

/// Books the moments of one apex in half of a step.
///
/// later  [s] at which positions they count, after t
void book_moments(const Interface& interface, const Motion& m, double later, const Near& near, Memory& memory) {
  const double half = 0.5 * m.dt;
  memory.angular_impulse += half * moment(interface, memory.shares, m.x, m.v, later, near.apex, near.element);
  if (near.friction->acts && all_have_moments(interface))
    memory.angular_impulse += half * moment_of_friction(near.friction->touch, near.friction->force, m.x, m.v, later);
}

}  // namespace

void book_first_half(const Interface& interface, const Motion& m, Memory& memory) {
  const double half = 0.5 * m.dt;
  const bool rubs = interface.friction.coefficient > 0, turns = all_have_moments(interface);
  book_first_half_of_shapes(m, memory);
  for (const Near& near : memory.near) {
    if (!near.element.closed) continue;
    memory.work += half * power(interface, memory.shares, m.v, near.apex, near.element);
    if (rubs && near.friction->acts)
      memory.work += half * near.friction->force.dot(slip_rate(near.friction->touch, m.v, m.omega, m.rotation_of_node));
    if (turns || near.element.has_moment) book_moments(interface, m, -m.dt, near, memory);
  }
}

FrictionLoss friction_loss(const Motion& m, Index first, Index last, const Multipliers& all) {
  const double share = share_to_come(m);
  FrictionLoss sum;
  if (all.frictions.empty()) return sum;
  for (Index k = first; k < last; ++k) {
    if (all.contactors[k].friction < 0) continue;
    const FrictionCondition& friction = all.frictions[all.contactors[k].friction];
    sum.all -= friction.work;
    sum.to_come -= share * friction.impulse.dot(mean_to_come(friction.before, friction.after, share));
  }
  return sum;
}

Doing doing(const Motion& m, Index first, Index last, const Multipliers& all) {
  const double share = share_to_come(m), h = 0.5 * (m.dt + m.next);
  Doing sum;
  for (Index k = first; k < last; ++k) {
    const Contactor& one = all.contactors[k];
    for (Index i = one.first; i < one.last; ++i) {
      const Condition& c = all.conditions[i];
      if (!(c.impulse > 0)) continue;
      sum.work += c.impulse * c.before;
      sum.to_come += c.impulse * mean_to_come(c.before, c.after, share);
      sum.power_rate += c.impulse * (c.after - c.before);
    }
    if (one.friction < 0) continue;
    const FrictionCondition& friction = all.frictions[one.friction];
    sum.work += friction.impulse.dot(friction.before);
    sum.power_rate += friction.impulse.dot(friction.after - friction.before);
  }
  return {0.5 * m.dt / h * sum.work, share * sum.to_come, sum.power_rate / (h * h)};
}

void take_over(const Interface& interface, const Motion& m, double h, double t, Index first, Index last, const Doing& now, Memory& memory,
               const Multipliers& all) {
  const bool rubs = interface.friction.coefficient > 0, turns = all_have_moments(interface);
  Index at = first < last ? all.contactors[first].first : 0, contactor = first;
  double from_trend = 0, from_before = 0;
  memory.deepest_now = 0;
  memory.shares.clear();
  const Vec3 force_before = memory.force;
  memory.force.setZero();
  for (Near& near : memory.near) {
    ElementForces& element = near.element;
    memory.stored[near.apex] = 0;
    element.closed = false;
    element.scale = 1;
    element.apex.setZero();
    element.depth = 0;
    double gap = infinite, most = 0;
    near.pressed_most = -1;
    for (int s = 0; s < element.count; ++s) {
      Stencil& stencil = element.stencil[s];
      if (stencil.apex == 0) continue;
      const Condition& c = all.conditions[at++];
      gap = std::min(gap, c.gap);
      if (c.impulse > most) most = c.impulse, near.pressed_most = stencil.facet;
      element.depth = std::max(element.depth, -c.gap);
      stencil.push *= c.impulse / h;
      if (stencil.over_points) {
        stencil.first_share = static_cast<Index>(memory.shares.size()), stencil.shares = c.nodes;
        for (int j = 0; j < c.nodes; ++j) {
          const Member& member = members_of(c, all)[static_cast<std::size_t>(j)];
          memory.shares.push_back({member.node, member.push, member.weight > 0});
        }
      }
      element.apex += stencil.push;
      element.closed = element.closed || c.impulse > 0;
    }
    if (rubs) end_friction(near.friction);
    if (rubs && gap < infinite) book_friction(all.contactors[contactor++], element.closed, h, all, near.friction);
    if (gap < infinite) memory.gap[near.apex] = gap, memory.status[near.apex] = element.closed ? Status::closed : Status::open;
    memory.deepest_now = std::max(memory.deepest_now, element.depth);
    if (element.depth > memory.deepest) update_deepest(interface, m.x, near, memory), memory.deepest_time = t;
    memory.lost += element.lost;
    if (element.moved && !near.is_idle) ++memory.walks, ++memory.reconnections[near.apex];
    if (element.closed) memory.force += element.apex;
    if (element.count == 1) {
      const double pressed = element.apex.norm(), off_trend = pressed - trend(near), off_before = pressed - near.pressed;
      from_trend += off_trend * off_trend, from_before += off_before * off_before;
    }
    if (element.closed && (turns || element.has_moment)) book_moments(interface, m, 0, near, memory);
    if (rubs && near.friction->acts) memory.force += near.friction->force;
  }
  memory.has_trend = from_trend < is_trend * from_before;
  take_over_shapes(interface, h, t, last, all, memory);
  take_over(m, force_before, first, last, now, memory, all);
}

void take_over(const Motion& m, const Vec3& force_before, Index first, Index last, const Doing& now, SidesMemory& memory,
               const Multipliers& all) {
  memory.work += now.work;
  memory.impulse += 0.5 * m.dt * (force_before + memory.force);
  memory.held = now.to_come + held(first, last, all) + memory.transferred;
}

void take_over(const RigidPlane& plane, const Motion& m, double h, double t, Index first, Index last, const Doing& now, PlaneMemory& memory,
               const Multipliers& all) {
  const double deepest = memory.deepest;
  std::size_t i = 0;
  for (Index k = first; k < last - count_acting(memory.shape_points); ++k) {
    const Condition& c = all.conditions[all.contactors[k].first];
    while (plane.nodes[i] != members_of(c, all)[0].node) ++i;
    memory.next_force[i] = c.impulse / h;
    const Index friction = all.contactors[k].friction;
    if (friction >= 0) memory.next_friction[i] = all.frictions[friction].impulse / h;
    if (!memory.stuck.empty()) memory.stuck[i] = c.impulse > 0 && (friction < 0 || !all.frictions[friction].slides);
  }
  advance(plane, m.x, m.v, m.dt, memory);
  take_over_shapes(plane, m, h, t, last, all, memory);
  if (memory.deepest > deepest) memory.deepest_time = t;
  memory.stored = now.to_come + held(first, last, all) + memory.transferred;
}

}  // namespace nereid::contact
