#include "dynamics/footing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>

#include "dynamics/measure.hpp"

namespace nereid::dynamics {

namespace {

constexpr double more = 1.05;  // [-] of the largest force so far: what is looked at again

/// The deformable body of each node, as the place in Model::blocks of the first of its regions; -1 of rigid bodies.
std::vector<int> deformable_body_of_node(const Model& model) {
  const auto body = [&](std::size_t b) {
    const std::string& region = element::name(model.blocks[b]);
    return std::string_view(region).substr(0, region.find('.'));
  };
  std::vector<int> of_node(static_cast<std::size_t>(model.mesh.X.cols()), -1);
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (is_rigid_block(model, b)) continue;
    std::size_t first = 0;
    while (body(first) != body(b)) ++first;
    for (const Index node : element::nodes(model.blocks[b]).reshaped()) of_node[static_cast<std::size_t>(node)] = static_cast<int>(first);
  }
  return of_node;
}

/// The nodes of the bodies that carry a contact.
double nodes_of(const Model& model, const std::vector<contact::NodeForce>& forces) {
  const std::vector<int> body_of_node = deformable_body_of_node(model);
  std::vector<std::vector<double>> of_bodies(model.blocks.size());
  for (const contact::NodeForce& one : forces)
    if (const int body = body_of_node[static_cast<std::size_t>(one.node)]; body >= 0)
      of_bodies[static_cast<std::size_t>(body)].push_back((one.push + one.friction).norm());
  const auto sum = [](const std::vector<double>& sizes) { return std::accumulate(sizes.begin(), sizes.end(), 0.0); };
  double largest = 0, least = 0;
  for (const std::vector<double>& sizes : of_bodies) largest = std::max(largest, sum(sizes));
  for (const std::vector<double>& sizes : of_bodies) {
    if (!(largest > 0) || sum(sizes) < 0.5 * largest) continue;
    const double nodes = effective_nodes(sizes);
    least = least > 0 ? std::min(least, nodes) : nodes;
  }
  return least;
}

}  // namespace

double effective_nodes(const std::vector<double>& sizes) {
  double largest = 0, sum = 0, squares = 0;
  for (const double size : sizes) largest = std::max(largest, size);
  if (!(largest > 0)) return 0;
  for (const double size : sizes) sum += size / largest, squares += size / largest * (size / largest);
  return sum * sum / squares;
}

void look_at_footings(const Model& model, State& now) {
  now.footings.resize(model.contacts.size() + model.rigid_planes.size());
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (contact::follows(model.contacts[c])) continue;  // counts with the pass before
    const std::vector<contact::NodeForce> forces = forces_of_contact(model, now, c);
    double force = 0;
    for (const contact::NodeForce& one : forces) force += (one.push + one.friction).norm();
    if (force > more * now.footings[c].force) now.footings[c] = {force, nodes_of(model, forces)};
  }
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) {
    const contact::PlaneMemory& memory = now.rigid_planes[p];
    std::vector<double> forces = memory.force;
    for (std::size_t n = 0; n < forces.size(); ++n) {
      if (n < memory.friction.size()) forces[n] = std::hypot(forces[n], memory.friction[n].norm());
      if (is_rigid_node(model, model.rigid_planes[p].nodes[n])) forces[n] = 0;
    }
    const double force = std::accumulate(forces.begin(), forces.end(), 0.0);
    Footing& seen = now.footings[model.contacts.size() + p];
    if (force > more * seen.force) seen = {force, effective_nodes(forces)};
  }
}

}  // namespace nereid::dynamics
