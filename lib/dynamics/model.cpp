#include "dynamics/model.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/check.hpp"
#include "dynamics/overlaps.hpp"

namespace nereid::dynamics {

namespace {

/// The smallest mass with which a rigid body answers an impulse at a node. [kg]
double least_mass_at(const rigid::Body& body, Index place) {
  const Vec3 r = body.arm.col(place);
  const Mat3 inverse = body.inverse;
  double most = 0;  // of r x n . J^-1 (r x n): no more than the sum over three directions
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 turn = r.cross(Vec3::Unit(axis));
    most += turn.dot(inverse * turn);
  }
  return 1 / (1 / body.mass.mass + most);
}

/// Masses that springs pull on: at a rigid body, all ends of springs on it share what it has there.
Scalars masses_of_springs(const Model& model) {
  Scalars mass = model.mass;
  std::vector<Index> ends;
  for (const auto& any : model.loads)
    if (const auto* spring = std::get_if<load::Spring>(&any)) {
      ends.push_back(spring->from);
      if (spring->to >= 0) ends.push_back(spring->to);
    }
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const auto on_body = std::count_if(ends.begin(), ends.end(), [&](Index n) { return model.rigid_of_node[n] == static_cast<Index>(b); });
    const rigid::Body& body = model.rigid_bodies[b];
    for (std::size_t i = 0; on_body > 0 && i < body.nodes.size(); ++i)
      mass(body.nodes[i]) = least_mass_at(body, static_cast<Index>(i)) / static_cast<double>(on_body);
  }
  return mass;
}

/// Tells nodes which rigid body they belong to, and makes bounds of their masses.
void share_out_rigid_mass(Model& model) {
  model.rigid_of_node.clear();
  model.rigid_share = Scalars::Ones(static_cast<Eigen::Index>(model.rigid_bodies.size()));
  if (model.rigid_bodies.empty()) return;
  model.rigid_of_node.assign(static_cast<std::size_t>(model.mesh.X.cols()), -1);
  model.held_bodies.resize(model.rigid_bodies.size());
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Body& body = model.rigid_bodies[b];
    const double share = rigid::safe_share(body, model.mass);
    model.rigid_share(static_cast<Eigen::Index>(b)) = share;
    for (const Index node : body.nodes) model.rigid_of_node[node] = static_cast<Index>(b), model.mass(node) *= share;
  }
}

}  // namespace

load::Constraints constraints_of_nodes(const Model& model) {
  load::Constraints left = model.constraints;
  for (load::Plane& plane : left.planes) std::erase_if(plane.nodes, [&](Index node) { return is_rigid_node(model, node); });
  return left;
}

std::int64_t element_count(const Model& model) {
  std::int64_t sum = 0;
  for (const auto& block : model.blocks) sum += element::tiling(block).elements;
  return sum;
}

double total_mass(const Model& model) {
  if (model.rigid_bodies.empty()) return model.mass.sum();
  double sum = 0;
  for (Eigen::Index n = 0; n < model.mass.size(); ++n)
    if (!is_rigid_node(model, static_cast<Index>(n))) sum += model.mass(n);
  for (const rigid::Body& body : model.rigid_bodies) sum += body.mass.mass;
  return sum;
}

void finalize(Model& model) {
  const auto nodes = static_cast<Index>(model.mesh.X.cols());
  model.mass = Scalars::Zero(nodes);
  model.rotation_of_node.assign(nodes, -1);
  model.node_of_rotation.clear();
  model.node_sums.clear();
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    const auto& block = model.blocks[b];
    element::add_mass(block, model.mass);
    model.node_sums.push_back(element::node_sums(element::tiling(block)));
    if (!element::rotates(block) || is_rigid_block(model, b)) continue;
    for (const Index node : model.node_sums.back().node) {
      if (model.rotation_of_node[node] >= 0) continue;
      model.rotation_of_node[node] = static_cast<Index>(model.node_of_rotation.size());
      model.node_of_rotation.push_back(node);
    }
  }
  for (const load::PointMass& point : model.point_masses)
    for (const Index node : point.nodes) model.mass(node) += point.mass / static_cast<double>(point.nodes.size());
  check((model.mass.array() > 0).all(), "a node has neither an element nor a point mass");
  share_out_rigid_mass(model);
  model.inertia = Scalars::Zero(static_cast<Eigen::Index>(model.node_of_rotation.size()));
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    auto& block = model.blocks[b];
    if (!element::rotates(block) || is_rigid_block(model, b)) continue;
    element::set_rotations(block, model.rotation_of_node);
    element::add_rotary_inertia(block, model.inertia);
  }
}

std::vector<Source> sources(const Model& model) {
  std::vector<Source> list;
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    list.push_back(element::source(model.blocks[b]));
    if (is_rigid_block(model, b)) list.back().stored.clear(), list.back().dissipated.clear();
  }
  for (const auto& any : model.contacts) list.push_back(std::visit([](const auto& one) { return contact::source(one); }, any));
  for (const auto& plane : model.rigid_planes) list.push_back(contact::source(plane));
  for (const auto& plane : model.constraints.planes) list.push_back(load::source(plane));
  for (const auto& any : model.loads) list.push_back(load::source(any));
  if (model.relaxation) list.push_back({"relaxation", SourceKind::relaxation, {}, {Dissipated::removed}});
  if (!model.gravity.isZero(0)) list.push_back({"gravity", SourceKind::gravity, {Stored::potential}, {}});
  return list;
}

State initial_state(const Model& model, std::vector<contact::AnyMemory> contacts) {
  check(contacts.size() == model.contacts.size(), "every contact must be connected before the start");
  State state;
  state.x = model.mesh.X;
  state.v = Vectors::Zero(3, model.mesh.X.cols());
  state.omega = Vectors::Zero(3, model.inertia.size());
  for (const auto& block : model.blocks) {
    state.blocks.push_back(element::initial_memory(block));
    state.tiles.push_back(element::tile_forces(block));
  }
  state.contacts = std::move(contacts);
  state.sections.resize(model.sections.size());
  for (const auto& plane : model.rigid_planes) state.rigid_planes.push_back(contact::initial_memory(plane));
  state.rigid_bodies.resize(model.rigid_bodies.size());
  state.constraints = load::prepare(constraints_of_nodes(model), static_cast<Index>(model.mesh.X.cols()), model.rotation_of_node);
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
  for (const auto& any : model.contacts) forces.contacts.push_back(contact::make_workspace(any));
  forces.dx = Vectors::Zero(3, model.mesh.X.cols());
  forces.rotation = Vectors::Zero(3, model.inertia.size());
  forces.force = Vectors::Zero(3, model.mesh.X.cols());
  forces.moment = Vectors::Zero(3, model.inertia.size());
  forces.partial.reserve(static_cast<std::size_t>(model.mesh.X.cols()));
  forces.springs = load::spring_rates(model.loads, model.mesh.X, model.rigid_bodies.empty() ? model.mass : masses_of_springs(model));
  if (std::any_of(model.blocks.begin(), model.blocks.end(), element::thins)) {
    forces.half_growth = forces.plate_mass = Scalars::Zero(model.mesh.X.cols());
    for (const auto& block : model.blocks)
      if (element::thickness(block) > 0) element::add_mass(block, forces.plate_mass);
    for (const auto& block : model.blocks)
      forces.element_mass.push_back(element::thins(block) ? element::element_masses(block) : Scalars());
  }
  forces.audit = audit::make_workspace(audited_surfaces(model));
  forces.audit.allowed = allowed_overlaps(model, forces.audit.surfaces);
  if (contact::any_by_multipliers(model.contacts, model.rigid_planes)) {
    forces.multipliers = contact::make_multipliers(model.contacts, model.rigid_planes, static_cast<Index>(model.mesh.X.cols()),
                                                   static_cast<Index>(model.inertia.size()));
    forces.allowed_rotation.assign(static_cast<std::size_t>(model.inertia.size()), nullptr);
    forces.allowed.assign(static_cast<std::size_t>(model.mesh.X.cols()), nullptr);
    const auto& planes = model.constraints.planes;
    const bool any_moves = std::any_of(planes.begin(), planes.end(), [](const load::Plane& plane) { return load::moves(plane); });
    const auto is_tied = [](const contact::AnyContact& any) { return contact::tied_by_multipliers(any); };
    if (any_moves && std::any_of(model.contacts.begin(), model.contacts.end(), is_tied))
      forces.driven = Vectors::Zero(3, model.mesh.X.cols());
  }
  forces.rigid_bodies.resize(model.rigid_bodies.size());
  if (!model.rigid_bodies.empty())
    forces.rigid_nodes = contact::make_rigid_nodes(model.contacts, model.rigid_planes, model.rigid_bodies, model.rigid_of_node);
  if (model.relaxation) forces.source_force = forces.force, forces.source_moment = forces.moment;
  return forces;
}

}  // namespace nereid::dynamics
