#include "contact/data/meeting.hpp"

#include <algorithm>
#include <utility>

namespace nereid::contact {

namespace {

/// The meeting of two bodies, which is made if they have not met before; `side` is -1 where the first of them is the other one.
Meeting& meeting(Index a, Index b, double t, Memory& memory, double& side) {
  side = a <= b ? 1 : -1;
  const Index one = std::min(a, b), other = std::max(a, b);
  const auto before = [](const Meeting& m, const std::pair<Index, Index>& pair) { return std::pair(m.one, m.other) < pair; };
  const auto at = std::lower_bound(memory.meetings.begin(), memory.meetings.end(), std::pair(one, other), before);
  if (at != memory.meetings.end() && at->one == one && at->other == other) return *at;
  return *memory.meetings.insert(at, {.one = one, .other = other, .first = t, .last = t});
}

/// Adds a force on body a, from body b.
void add(Index a, Index b, const Vec3& force, double t, Memory& memory) {
  double side = 1;
  Meeting& of_pair = meeting(a, b, t, memory, side);
  of_pair.last = t;
  if (a != b) of_pair.now += side * force;
}

bool is_closed(const Memory& memory) {
  return std::any_of(memory.near.begin(), memory.near.end(), [](const Near& near) { return near.element.closed; }) ||
         std::any_of(memory.crossings.begin(), memory.crossings.end(), [](const Crossing& crossing) { return crossing.closed; });
}

}  // namespace

void make_room_for_meetings(const Interface& interface, Memory& memory) {
  const auto bodies = static_cast<std::size_t>(interface.bodies.count());
  memory.meetings.reserve(std::min(bodies * (bodies + 1) / 2, 8 * bodies) + 1);
}

void see_meetings(const Interface& interface, double dt, double t, Memory& memory) {
  if (interface.kind == InterfaceKind::bonded) return;
  const Bodies& bodies = interface.bodies;
  if (bodies.count() == 0) {
    const bool stopped_at_start = memory.meetings.empty() && !memory.impulse.isZero(0);
    if (is_closed(memory) || stopped_at_start) {
      if (memory.meetings.empty()) memory.meetings.push_back({.first = t});
      memory.meetings[0].last = t;
    }
    if (!memory.meetings.empty()) memory.meetings[0].impulse = memory.impulse;
    return;
  }
  for (Meeting& one : memory.meetings) one.before = one.now, one.now.setZero();
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (!element.closed) continue;
    const Index own = bodies.of_apex[near.apex];
    for (int s = 0; s < element.count; ++s) {
      const Stencil& stencil = element.stencil[s];
      const Index other = bodies.of_facet[stencil.facet];
      add(own, other, element.scale * stencil.apex * stencil.push, t, memory);
    }
    if (near.friction.acts) add(own, bodies.of_node[near.friction.touch.node[0]], near.friction.force, t, memory);
  }
  for (const Crossing& crossing : memory.crossings) {
    if (!crossing.closed) continue;
    const Index own = interface.edges.body[crossing.edge], other = interface.base_edges.body[crossing.base_edge];
    add(own, other, crossing.friction.acts ? Vec3(crossing.push + crossing.friction.force) : crossing.push, t, memory);
  }
  for (Meeting& one : memory.meetings) one.impulse += 0.5 * dt * (one.before + one.now);
}

void meet_at_start(const Interface& interface, Index node, Index other_node, const Vec3& impulse, double t, Memory& memory) {
  if (interface.bodies.count() == 0) return;
  const Index a = interface.bodies.of_node[node], b = interface.bodies.of_node[other_node];
  double side = 1;
  Meeting& of_pair = meeting(a, b, t, memory, side);
  if (a != b) of_pair.impulse += side * impulse;
}

}  // namespace nereid::contact
