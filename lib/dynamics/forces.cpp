#include "dynamics/forces.hpp"

#include <cmath>

#include "contact/contact.hpp"
#include "dynamics/ledger.hpp"
#include "dynamics/rigid_step.hpp"
#include "dynamics/thickness.hpp"

namespace nereid::dynamics {

namespace {

/// The stable step of elements, springs and dashpots together, named after the springs where they govern.
SourceLimit with_springs(const load::SpringRates& springs, int first_load, const SourceLimit& elements) {
  if (springs.stiffest < 0 && springs.damping == 0) return elements;
  const double step = load::step_with_springs(elements.step, springs);
  if (springs.stiffest >= 0 && step < 0.5 * elements.step) return {step, first_load + springs.stiffest, -1};
  return {step, elements.source, elements.at};
}

}  // namespace

void update(const Model& model, double dt, const Pace& pace, State& now, Forces& f) {
  const StepLimits before = now.step_limits;
  StepLimits limits;
  int source = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b, ++source) {
    if (is_rigid_block(model, b)) {
      const double limit = rigid_step_limit(model, now, static_cast<std::size_t>(model.rigid_of_block[b]));
      limits.contact.lower_to({limit, limit < model.longest_step ? -1 : at_largest_step}, source);
      continue;
    }
    const element::BlockLimit limit =
        element::advance(model.blocks[b], now.x, f.dx, f.rotation, dt, now.blocks[b], now.tiles[b], f.reports[b]);
    limits.elements.lower_to({limit.step, limit.step_element}, source);
    if (limit.volume_ratio < limits.volume_ratio || std::isnan(limit.volume_ratio)) {  // once found, a NaN stays
      limits.volume_ratio = limit.volume_ratio, limits.smallest_block = source, limits.smallest_element = limit.volume_element;
    }
  }
  limits.contact.lower_to({model.longest_step, at_largest_step}, 0);
  update_thickness(model, now, f);
  for (std::size_t c = 0; c < model.contacts.size(); ++c, ++source) {
    const contact::Interface* interface = contact::interface_of(model.contacts[c]);
    if (interface == nullptr) continue;
    auto& memory = std::get<contact::Memory>(now.contacts[c]);
    if (f.half_growth.size() > 0) contact::follow_thickness(*interface, f.half_growth, memory);
    if (contact::by_multipliers(*interface)) continue;
    auto& workspace = std::get<contact::Workspace>(f.contacts[c]);
    const double deepest = memory.deepest;
    contact::advance(*interface, now.x, now.v, now.omega, dt, memory, workspace);
    if (memory.deepest > deepest) memory.deepest_time = now.t;
    limits.contact.lower_to(contact::stable_step(*interface, model.mass, model.inertia, memory, workspace, dt), source);
  }
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p, ++source) {
    if (contact::by_multipliers(model.rigid_planes[p])) continue;
    contact::PlaneMemory& memory = now.rigid_planes[p];
    const double deepest = memory.deepest;
    contact::advance(model.rigid_planes[p], now.x, now.v, dt, memory);
    if (memory.deepest > deepest) memory.deepest_time = now.t;
    limits.contact.lower_to(contact::stable_step(model.rigid_planes[p], model.mass, memory.step_factor), source);
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    load::advance(model.loads[l], model.mesh.X, now.x, now.v, now.omega, now.t, dt, now.loads[l]);
  source += static_cast<int>(model.constraints.planes.size());
  limits.elements = with_springs(f.springs, source, limits.elements);
  update_ringing(before, pace.safety * limits.elements.step, std::max(steady_scale(now.ledger), before.energy), limits);
  now.step_limits = limits;
  const double scale = steady_scale(now.ledger);
  if (dt > 0) update_growth(before, pace, dt, scale > 0 ? now.ledger.integration_kept / scale : 0, now.step_limits);
}

void add_contact_forces(const Model& model, const State& now, bool by_multipliers, Forces& f) {
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    if (contact::by_multipliers(model.contacts[c]) == by_multipliers)
      contact::with_memory(model.contacts[c], now.contacts[c],
                           [&](const auto& one, const auto& memory) { contact::add_forces(one, memory, f.force, f.moment); });
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p)
    if (contact::by_multipliers(model.rigid_planes[p]) == by_multipliers)
      contact::add_forces(model.rigid_planes[p], now.rigid_planes[p], f.force);
}

void gather(const Model& model, const State& now, Forces& f) {
  for (Eigen::Index node = 0; node < f.force.cols(); ++node) f.force.col(node) = model.mass(node) * model.gravity;
  f.moment.setZero();
  begin_rigid_forces(model, f);
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    if (is_rigid_block(model, b)) continue;
    element::add_by_node(model.node_sums[b], now.tiles[b].force, f.force);
    if (now.tiles[b].moment.cols() > 0) element::add_by_node(model.node_sums[b], now.tiles[b].moment, model.rotation_of_node, f.moment);
  }
  add_contact_forces(model, now, false, f);
  for (std::size_t l = 0; l < model.loads.size(); ++l) load::add_forces(model.loads[l], now.loads[l], f.force, f.moment);
  gather_rigid_forces(model, f);
}

}  // namespace nereid::dynamics
