#include "contact/search/body_ways.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace nereid::contact {

namespace {

constexpr Index bodies_of_a_thread = 4;

/// The diagonal of the box around two boxes.
double diagonal(const BodyBox& one, const BodyBox& other) {
  return (one.high.cwiseMax(other.high) - one.low.cwiseMin(other.low)).norm();
}

/// Lists pairs of bodies: visit(are_near) calls are_near(one, other) for each, more than once if need be.
template <class Visit>
void list_pairs_of_bodies(const Bodies& bodies, SearchWork& workspace, Visit&& visit) {
  const auto count = static_cast<std::size_t>(bodies.count());
  workspace.are_near.assign(count * count, 0);
  visit([&](Index one, Index other) { workspace.are_near[bodies.pair(std::min(one, other), std::max(one, other))] = 1; });
  workspace.near_bodies.clear();
  workspace.has_near.assign(count, 0);
  for (Index one = 0; one < bodies.count(); ++one)
    for (Index other = one; other < bodies.count(); ++other) {
      if (workspace.are_near[bodies.pair(one, other)] == 0) continue;
      workspace.near_bodies.push_back({one, other});
      for (const Index body : {one, other}) workspace.has_near[static_cast<std::size_t>(body)] = 1;
    }
  workspace.knows_near_bodies = true;
}

}  // namespace

void find_near_bodies(const Interface& interface, const Memory& memory, SearchWork& workspace) {
  const Bodies& bodies = interface.bodies;
  list_pairs_of_bodies(bodies, workspace, [&](auto&& are_near) {
    for (const Near& near : memory.near) {
      const Index body = bodies.of_apex[static_cast<std::size_t>(near.apex)];
      for (Index i = near.first_facet; i < near.first_facet + near.facets; ++i)
        are_near(body, bodies.of_facet[static_cast<std::size_t>(memory.near_facets[static_cast<std::size_t>(i)])]);
      for (int i = 0; i < near.tracks.count; ++i)
        are_near(body, bodies.of_facet[static_cast<std::size_t>(near.tracks.track[static_cast<std::size_t>(i)].facet)]);
    }
  });
}

void find_near_bodies(const EdgeContact& contact, const EdgeMemory& memory, SearchWork& workspace) {
  list_pairs_of_bodies(contact.bodies, workspace, [&](auto&& are_near) {
    for (const EdgePair& pair : memory.edge_pairs)
      are_near(contact.edges.body[static_cast<std::size_t>(pair.edge)], contact.base_edges.body[static_cast<std::size_t>(pair.base_edge)]);
  });
}

void find_speeds_apart(const Sides& sides, const Vectors& v, SearchWork& workspace) {
  const Bodies& bodies = sides.bodies;
  workspace.apart.assign(static_cast<std::size_t>(bodies.count()), 0);
  if (workspace.near_bodies.empty()) return;
  workspace.speeds.resize(static_cast<std::size_t>(bodies.count()));
  parallel_for(bodies.count(), bodies_of_a_thread, [&](Index b) {
    const auto body = static_cast<std::size_t>(b);
    if (workspace.has_near[body] == 0) return;
    Vec3 low = Vec3::Constant(infinite), high = -low;
    for (Index i = bodies.first_node[body]; i < bodies.first_node[body + 1]; ++i) {
      const auto speed = v.col(bodies.nodes[static_cast<std::size_t>(i)]);
      low = low.cwiseMin(speed), high = high.cwiseMax(speed);
    }
    workspace.speeds[body] = {low, high};
  });
  for (const auto& [one, other] : workspace.near_bodies) {
    const auto a = static_cast<std::size_t>(one), b = static_cast<std::size_t>(other);
    const double speed = diagonal(workspace.speeds[a], workspace.speeds[b]);
    for (const std::size_t body : {a, b}) workspace.apart[body] = std::max(workspace.apart[body], speed);
  }
}

void add_ways(const Sides& sides, const Vectors& v, double dt, SidesMemory& memory, SearchWork& workspace) {
  if (memory.searches == 0) return;
  memory.way_of_body.resize(static_cast<std::size_t>(sides.bodies.count()), 0);
  find_speeds_apart(sides, v, workspace);
  for (std::size_t b = 0; b < memory.way_of_body.size(); ++b) memory.way_of_body[b] += dt * workspace.apart[b];
}

}  // namespace nereid::contact
