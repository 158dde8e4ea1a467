#include "dynamics/section.hpp"

#include <Eigen/Geometry>
#include <limits>
#include <utility>

namespace nereid::dynamics {

namespace {

constexpr double within = 1e-9;  // of the radius, or of the size of the body: nodes on the cylinder are within it, on the plane behind it

/// size  [m] of the body that is cut
bool is_ahead(const Cut& cut, const Vec3& place, double size) {
  const Vec3 way = place - cut.point;
  const double along = way.dot(cut.normal);
  return cut.radius > 0 ? (way - along * cut.normal).norm() > cut.radius * (1 + within) : along > size * within;
}

/// Diagonal of the box around some blocks. [m]
double size_of(const Model& model, const std::vector<std::size_t>& blocks) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const std::size_t b : blocks)
    for (const Index node : element::tiling(model.blocks[b]).node)
      low = low.cwiseMin(model.mesh.X.col(node)), high = high.cwiseMax(model.mesh.X.col(node));
  return (high - low).norm();
}

}  // namespace

Section make_section(const Model& model, const std::string& name, const std::vector<std::size_t>& blocks, const Cut& cut) {
  Section section{name, cut.point, {}};
  const double size = size_of(model, blocks);
  for (const std::size_t b : blocks) {
    const element::Tiling& tiling = element::tiling(model.blocks[b]);
    Section::Part part{b, {}, {}};
    for (const element::Tile& tile : tiling.tiles) {
      const std::size_t before = part.slots.size();
      for (Index slot = tile.first_node; slot < tile.first_node + tile.nodes; ++slot) {
        const Index node = tiling.node[static_cast<std::size_t>(slot)];
        if (is_ahead(cut, model.mesh.X.col(node), size)) part.slots.push_back(slot), part.nodes.push_back(node);
      }
      const bool all_ahead = part.slots.size() == before + static_cast<std::size_t>(tile.nodes);
      if (all_ahead) part.slots.resize(before), part.nodes.resize(before);  // their forces sum to nothing
    }
    if (!part.slots.empty()) section.parts.push_back(std::move(part));
  }
  return section;
}

void update_sections(const Model& model, double dt, State& now) {
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const Section& section = model.sections[s];
    SectionMemory& memory = now.sections[s];
    const Vec3 before = memory.force;
    memory.force.setZero(), memory.moment.setZero();
    for (const Section::Part& part : section.parts) {
      const element::TileForces& tiles = now.tiles[part.block];
      for (std::size_t i = 0; i < part.slots.size(); ++i) {
        const Vec3 force = tiles.force.col(part.slots[i]);
        memory.force += force;
        memory.moment += (now.x.col(part.nodes[i]) - section.point).cross(force);
        if (tiles.moment.cols() > 0) memory.moment += tiles.moment.col(part.slots[i]);
      }
    }
    memory.impulse += 0.5 * dt * (before + memory.force);
  }
}

}  // namespace nereid::dynamics
