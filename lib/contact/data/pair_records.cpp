#include "contact/data/pair_records.hpp"

#include <algorithm>
#include <utility>

namespace nereid::contact {

namespace {

/// The record of two bodies, which is made if they have not met before; `side` is -1 where the first of them is the other one.
PairRecord& pair_record(Index a, Index b, double t, SidesMemory& memory, double& side) {
  side = a <= b ? 1 : -1;
  const Index one = std::min(a, b), other = std::max(a, b);
  const auto before = [](const PairRecord& m, const std::pair<Index, Index>& pair) { return std::pair(m.one, m.other) < pair; };
  const auto at = std::lower_bound(memory.pair_records.begin(), memory.pair_records.end(), std::pair(one, other), before);
  if (at != memory.pair_records.end() && at->one == one && at->other == other) return *at;
  return *memory.pair_records.insert(at, {.one = one, .other = other, .first = t, .last = t});
}

/// Adds a force on body a, from body b.
void add(Index a, Index b, const Vec3& force, double t, SidesMemory& memory) {
  double side = 1;
  PairRecord& of_pair = pair_record(a, b, t, memory, side);
  of_pair.last = t;
  if (a != b) of_pair.now += side * force;
}

/// Sees whether both sides of a contact of two surfaces touch.
void update_two_sides(bool is_closed, double t, SidesMemory& memory) {
  const bool stopped_at_start = memory.pair_records.empty() && !memory.impulse.isZero(0);
  if (is_closed || stopped_at_start) {
    if (memory.pair_records.empty()) memory.pair_records.push_back({.first = t});
    memory.pair_records[0].last = t;
  }
  if (!memory.pair_records.empty()) memory.pair_records[0].impulse = memory.impulse;
}

/// Begins and ends the sums of forces between bodies.
void begin_forces(SidesMemory& memory) {
  for (PairRecord& one : memory.pair_records) one.before = one.now, one.now.setZero();
}
void end_forces(double dt, SidesMemory& memory) {
  for (PairRecord& one : memory.pair_records) one.impulse += 0.5 * dt * (one.before + one.now);
}

}  // namespace

void make_room_for_pair_records(const Sides& sides, SidesMemory& memory) {
  const auto bodies = static_cast<std::size_t>(sides.bodies.count());
  memory.pair_records.reserve(std::min(bodies * (bodies + 1) / 2, 8 * bodies) + 1);
}

void update_pair_records(const Interface& interface, double dt, double t, Memory& memory) {
  if (interface.kind == InterfaceKind::tied) return;
  const auto is_closed = [](const Near& near) { return near.element.closed; };
  const Bodies& bodies = interface.bodies;
  const auto touches = [](const ShapePoint& point) { return point.closed; };
  if (bodies.count() == 0)
    return update_two_sides(std::any_of(memory.near.begin(), memory.near.end(), is_closed) ||
                             std::any_of(memory.shape_points.begin(), memory.shape_points.end(), touches), t, memory);
  begin_forces(memory);
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (!element.closed) continue;
    const Index own = bodies.of_apex[near.apex];
    for (int s = 0; s < element.count; ++s) {
      const Stencil& stencil = element.stencil[s];
      const Index other = bodies.of_facet[stencil.facet];
      add(own, other, element.scale * stencil.apex * stencil.push, t, memory);
    }
    if (near.friction->acts) add(own, bodies.of_node[near.friction->touch.node[0]], near.friction->force, t, memory);
  }
  for (const ShapePoint& point : memory.shape_points) {
    if (!point.closed) continue;
    const ShapePair& pair = interface.shapes.pairs[static_cast<std::size_t>(point.pair)];
    const Vec3 force = point.pressed * point.normal + point.friction;
    add(pair.side > 0 ? pair.body : pair.other_body, pair.side > 0 ? pair.other_body : pair.body, force, t, memory);
  }
  end_forces(dt, memory);
}

void update_pair_records(const EdgeContact& contact, double dt, double t, EdgeMemory& memory) {
  const auto& all = memory.crossings;
  const auto is_closed = [](const Crossing& crossing) { return crossing.closed; };
  if (contact.bodies.count() == 0) return update_two_sides(std::any_of(all.begin(), all.end(), is_closed), t, memory);
  begin_forces(memory);
  for (const Crossing& crossing : memory.crossings) {
    if (!crossing.closed) continue;
    const Index own = contact.edges.body[crossing.edge], other = contact.base_edges.body[crossing.base_edge];
    add(own, other, crossing.friction->acts ? Vec3(crossing.push + crossing.friction->force) : crossing.push, t, memory);
  }
  end_forces(dt, memory);
}

void record_at_start(const Sides& sides, Index node, Index other_node, const Vec3& impulse, double t, SidesMemory& memory) {
  if (sides.bodies.count() == 0) return;
  const Index a = sides.bodies.of_node[node], b = sides.bodies.of_node[other_node];
  double side = 1;
  PairRecord& of_pair = pair_record(a, b, t, memory, side);
  if (a != b) of_pair.impulse += side * impulse;
}

}  // namespace nereid::contact
