#include "dynamics/footing.hpp"

#include <algorithm>
#include <numeric>

#include "dynamics/measure.hpp"

namespace nereid::dynamics {

namespace {

constexpr double more = 1.05;  // [-] of the largest force so far: what is looked at again

/// The body of each node, as a place in Model::blocks of one of its regions; -1 of rigid bodies.
std::vector<int> deformable_block_of_node(const Model& model) {
  std::vector<int> block(static_cast<std::size_t>(model.mesh.X.cols()), -1);
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (is_rigid_block(model, b)) continue;
    for (const Index node : element::nodes(model.blocks[b]).reshaped()) block[static_cast<std::size_t>(node)] = static_cast<int>(b);
  }
  return block;
}

/// The nodes of the bodies that carry a contact.
double nodes_of(const Model& model, const std::vector<contact::NodeForce>& forces) {
  const std::vector<int> block_of_node = deformable_block_of_node(model);
  std::vector<std::vector<double>> of_blocks(model.blocks.size());
  for (const contact::NodeForce& one : forces)
    if (const int block = block_of_node[static_cast<std::size_t>(one.node)]; block >= 0)
      of_blocks[static_cast<std::size_t>(block)].push_back((one.push + one.friction).norm());
  const auto sum = [](const std::vector<double>& sizes) { return std::accumulate(sizes.begin(), sizes.end(), 0.0); };
  double largest = 0, least = 0;
  for (const std::vector<double>& sizes : of_blocks) largest = std::max(largest, sum(sizes));
  for (const std::vector<double>& sizes : of_blocks) {
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
    const std::vector<double>& forces = now.rigid_planes[p].force;
    const double force = std::accumulate(forces.begin(), forces.end(), 0.0);
    Footing& seen = now.footings[model.contacts.size() + p];
    if (force > more * seen.force) seen = {force, effective_nodes(forces)};
  }
}

}  // namespace nereid::dynamics
