#include "dynamics/side.hpp"

#include <algorithm>
#include <cmath>

namespace nereid::dynamics {

namespace {

/// Whether all nodes of a surface are plate nodes.
bool rotates(const Model& model, const mesh::Surface& surface) {
  const Index node = surface.facets.size() > 0 ? surface.facets(0, 0) : -1;
  return node >= 0 && model.rotation_of_node[node] >= 0;
}

/// Whether a surface is of a rigid body.
bool is_rigid(const Model& model, const mesh::Surface& surface) {
  const Index node = surface.facets.size() > 0 ? surface.facets(0, 0) : -1;
  return std::any_of(model.rigid_bodies.begin(), model.rigid_bodies.end(),
                     [&](const rigid::Body& body) { return std::binary_search(body.nodes.begin(), body.nodes.end(), node); });
}

/// Half the thickness of the plates of a surface. [m]
double half_thickness(const Model& model, const mesh::Surface& surface) {
  for (const auto& block : model.blocks) {
    const bool has = (element::nodes(block).array() == surface.facets(0, 0)).any();
    const double half = has ? element::thickness(block) / 2 : 0;
    if (half > 0) return half;
  }
  return 0;
}

/// Whether a surface has plates whose thickness changes.
bool thins(const Model& model, const mesh::Surface& surface) {
  return std::any_of(model.blocks.begin(), model.blocks.end(), [&](const auto& block) {
    return element::thins(block) && (element::nodes(block).array() == surface.facets(0, 0)).any();
  });
}

}  // namespace

Side side_of(const Model& model, const mesh::Surface& surface) {
  return {.stiffness = surface_stiffness(model, surface),
          .impedance = surface_impedance(model, surface),
          .depth = surface_depth(model, surface),
          .half_thickness = half_thickness(model, surface),
          .is_rigid = is_rigid(model, surface),
          .turns = rotates(model, surface),
          .thins = thins(model, surface)};
}

contact::Between between(const Side& apexes, const Side& base, const InterfaceOptions& options, double share) {
  const double softer = apexes.is_rigid == base.is_rigid ? std::min(apexes.stiffness, base.stiffness)
                        : apexes.is_rigid                ? base.stiffness
                                                         : apexes.stiffness;
  contact::Between pair;
  pair.penalty = share * options.penalty.value_or(options.penalty_scale * softer);
  pair.impedance = 1 / (1 / apexes.impedance + 1 / base.impedance);
  pair.depth = apexes.depth > 0 && base.depth > 0 ? std::min(apexes.depth, base.depth) : std::max(apexes.depth, base.depth);
  const bool multipliers = options.method == contact::Method::multiplier;
  pair.release_height = multipliers ? contact::multipliers_reach * pair.depth : 0;
  if (apexes.turns) pair.arm_of_apex = apexes.half_thickness / (apexes.half_thickness + base.half_thickness);
  return pair;
}

std::vector<Mat3> allowed_directions(const Model& model, const Subset& apexes) {
  const auto& planes = model.constraints.planes;
  const bool any = std::any_of(planes.begin(), planes.end(), [](const auto& p) { return p.kind == load::PlaneKind::symmetry; });
  if (!any) return {};
  load::Constraints symmetry;
  for (const auto& plane : planes)
    if (plane.kind == load::PlaneKind::symmetry) symmetry.planes.push_back(plane);
  const std::vector<Index> no_turns(model.mesh.X.cols(), -1);
  const load::Memory memory = load::prepare(symmetry, static_cast<Index>(model.mesh.X.cols()), no_turns);
  std::vector<Mat3> allowed(apexes.size(), Mat3::Identity());
  for (std::size_t a = 0; a < apexes.size(); ++a) {
    const Index place = memory.row_of_node[apexes[a]];
    if (place >= 0) allowed[a] = memory.nodes[place].allowed;
  }
  return allowed;
}

std::vector<Subset> symmetry_planes(const Model& model) {
  std::vector<Subset> planes;
  for (const load::Plane& plane : model.constraints.planes)
    if (plane.kind == load::PlaneKind::symmetry) planes.push_back(plane.nodes);
  return planes;
}

double element_step(const Model& model) {
  const Vectors rest = Vectors::Zero(3, model.mesh.X.cols()), no_rotation = Vectors::Zero(3, model.inertia.size());
  double step = model.longest_step;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    if (is_rigid_block(model, b)) continue;
    element::Memory memory = element::initial_memory(block);
    element::TileForces tiles = element::tile_forces(block);
    element::TileReports reports = element::tile_reports(block);
    step = std::min(step, element::advance(block, model.mesh.X, rest, no_rotation, 0, memory, tiles, reports).step);
  }
  return step;
}

bool has_ridges(const contact::Edges& edges, const Vectors& X) {
  for (Index e = 0; e < edges.nodes.cols(); ++e)
    if (contact::is_ridge(edges, X, e)) return true;
  return false;
}

}  // namespace nereid::dynamics
