#include "dynamics/model.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "dynamics/overlaps.hpp"

namespace nereid::dynamics {

void finalize(Model& model) {
  const auto nodes = static_cast<Index>(model.mesh.X.cols());
  model.mass = Scalars::Zero(nodes);
  model.rotation_of_node.assign(nodes, -1);
  model.node_of_rotation.clear();
  model.node_sums.clear();
  for (const auto& block : model.blocks) {
    element::add_mass(block, model.mass);
    model.node_sums.push_back(element::node_sums(element::tiling(block)));
    if (!element::rotates(block)) continue;
    for (const Index node : model.node_sums.back().node) {
      if (model.rotation_of_node[node] >= 0) continue;
      model.rotation_of_node[node] = static_cast<Index>(model.node_of_rotation.size());
      model.node_of_rotation.push_back(node);
    }
  }
  for (const load::PointMass& point : model.point_masses)
    for (const Index node : point.nodes) model.mass(node) += point.mass / static_cast<double>(point.nodes.size());
  check((model.mass.array() > 0).all(), "a node has neither an element nor a point mass");
  model.inertia = Scalars::Zero(static_cast<Eigen::Index>(model.node_of_rotation.size()));
  for (auto& block : model.blocks) {
    if (!element::rotates(block)) continue;
    element::set_rotations(block, model.rotation_of_node);
    element::add_rotary_inertia(block, model.inertia);
  }
}

std::vector<Source> sources(const Model& model) {
  std::vector<Source> list;
  for (const auto& block : model.blocks) list.push_back(element::source(block));
  for (const auto& interface : model.interfaces) list.push_back(contact::source(interface));
  for (const auto& plane : model.rigid_planes) list.push_back(contact::source(plane));
  for (const auto& plane : model.constraints.planes) list.push_back(load::source(plane));
  for (const auto& any : model.loads) list.push_back(load::source(any));
  if (model.relaxation) list.push_back({"relaxation", SourceKind::relaxation, {}, {Dissipated::removed}});
  if (!model.gravity.isZero(0)) list.push_back({"gravity", SourceKind::gravity, {Stored::potential}, {}});
  return list;
}

State initial_state(const Model& model, std::vector<contact::Memory> interfaces) {
  check(interfaces.size() == model.interfaces.size(), "every interface must be connected before the start");
  State state;
  state.x = model.mesh.X;
  state.v = Vectors::Zero(3, model.mesh.X.cols());
  state.omega = Vectors::Zero(3, model.inertia.size());
  for (const auto& block : model.blocks) {
    state.blocks.push_back(element::initial_memory(block));
    state.tiles.push_back(element::tile_forces(block));
  }
  state.interfaces = std::move(interfaces);
  for (const auto& plane : model.rigid_planes) state.rigid_planes.push_back(contact::initial_memory(plane));
  state.constraints = load::prepare(model.constraints, static_cast<Index>(model.mesh.X.cols()), model.rotation_of_node);
  for (const auto& any : model.loads) state.loads.push_back(load::initial_memory(any));
  if (model.relaxation) {
    RelaxationMemory& memory = state.relaxation;
    memory.x = state.x;
    memory.force = Vectors::Zero(3, state.x.cols());
    memory.rotated = memory.moment = memory.omega = state.omega;
  }
  state.quality.resize(model.blocks.size());
  state.ledger.accounts.resize(sources(model).size());
  state.ledger.flows.resize(state.ledger.accounts.size());
  return state;
}

Forces make_forces(const Model& model) {
  Forces forces;
  for (const auto& block : model.blocks) forces.reports.push_back(element::tile_reports(block));
  for (const auto& interface : model.interfaces) forces.interfaces.emplace_back(interface);
  forces.dx = Vectors::Zero(3, model.mesh.X.cols());
  forces.rotation = Vectors::Zero(3, model.inertia.size());
  forces.force = Vectors::Zero(3, model.mesh.X.cols());
  forces.moment = Vectors::Zero(3, model.inertia.size());
  forces.partial.reserve(static_cast<std::size_t>(model.mesh.X.cols()));
  forces.springs = load::spring_rates(model.loads, model.mass);
  forces.audit = audit::make_workspace(audited_surfaces(model));
  forces.audit.allowed = allowed_overlaps(model, forces.audit.surfaces);
  if (contact::any_by_multipliers(model.interfaces, model.rigid_planes)) {
    forces.multipliers = contact::make_multipliers(model.interfaces, model.rigid_planes, static_cast<Index>(model.mesh.X.cols()),
                                                   static_cast<Index>(model.inertia.size()));
    forces.allowed_rotation.assign(static_cast<std::size_t>(model.inertia.size()), nullptr);
    forces.allowed.assign(static_cast<std::size_t>(model.mesh.X.cols()), nullptr);
    const auto& planes = model.constraints.planes;
    if (std::any_of(planes.begin(), planes.end(), [](const load::Plane& plane) { return load::moves(plane); }))
      forces.driven = Vectors::Zero(3, model.mesh.X.cols());
  }
  if (model.relaxation) forces.source_force = forces.force, forces.source_moment = forces.moment;
  return forces;
}

}  // namespace nereid::dynamics
