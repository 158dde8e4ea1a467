#include "model/advice.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/words.hpp"
#include "element/width.hpp"
#include "model/remedies.hpp"

namespace nereid::model {

namespace {

constexpr double worth_saying = 1.5;  // [-] times as many steps

/// The largest step of an interface by a penalty: its step limit, or what that is once the lowest apexes touch. [s]
double step_in_touch(const Simulation& simulation, std::size_t c) {
  const dynamics::Model& model = simulation.model;
  const contact::Interface* given = contact::interface_of(model.contacts[c]);
  if (given == nullptr) return 1e300;
  const contact::Interface& interface = *given;
  const contact::InitialGaps& gaps = simulation.gaps[c];
  const bool none = gaps.apexes == gaps.without_base + gaps.behind;
  if (contact::by_multipliers(interface) || none || interface.contact_height.size() == 0) return 1e300;
  contact::Workspace workspace(interface);
  const auto& memory = std::get<contact::Memory>(simulation.state.contacts[c]);
  const double limit = contact::stable_step(interface, model.mass, model.inertia, memory, workspace).step;
  if (limit < 1e299) return limit;
  const double reach = std::max(gaps.least, 0.0) + interface.contact_height.maxCoeff() + interface.depth;
  const contact::Memory touching = contact::tried_out(interface, simulation.state.x, reach, workspace);
  return contact::stable_step(interface, model.mass, model.inertia, touching, workspace).step;
}

/// One element and its stable step.
struct Sized {
  double step;  // [s]
  std::size_t block;
  Index element;
};

/// The elements of all blocks that set steps, smallest steps first.
std::vector<Sized> by_step(const Simulation& simulation) {
  std::vector<Sized> all;
  for (std::size_t b = 0; b < simulation.model.blocks.size(); ++b) {
    if (dynamics::is_rigid_block(simulation.model, b)) continue;
    double smallest = 1e300;
    for (const element::TileReport& tile : simulation.forces.reports[b].tile) smallest = std::min(smallest, tile.step);
    const Scalars relative = element::relative_steps(simulation.model.blocks[b], simulation.state.x);
    for (Index e = 0; e < static_cast<Index>(relative.size()); ++e) all.push_back({smallest * relative(e), b, e});
  }
  std::sort(all.begin(), all.end(), [](const Sized& one, const Sized& other) {
    return std::tie(one.step, one.block, one.element) < std::tie(other.step, other.block, other.element);
  });
  return all;
}

/// How many of the elements are few and much smaller than the others; zero: none.
std::size_t few(const std::vector<Sized>& all) {
  const std::size_t most = all.size() / 20;
  std::size_t found = 0;
  double widest = 1;
  for (std::size_t n = 1; n <= most; ++n)
    if (all[n].step > widest * all[n - 1].step) widest = all[n].step / all[n - 1].step, found = n;
  return found > 0 && all[found].step > worth_saying * all[0].step ? found : 0;
}

std::vector<std::string> element_advice(const Simulation& simulation, const ExpectedSteps& expected) {
  const dynamics::StepLimits& limits = simulation.state.step_limits;
  if (expected.dt < expected.elements || limits.elements.source >= static_cast<int>(simulation.model.blocks.size())) return {};
  const std::vector<Sized> all = by_step(simulation);
  const std::size_t n = few(all);
  if (n == 0) return {};
  const double then = std::min(simulation.time.safety * all[n].step, limits.contact.step) / expected.dt;
  if (!(then > worth_saying)) return {};
  const char* body = element::name(simulation.model.blocks[all[0].block]).c_str();
  const std::string what = n == 1 ? formatted("element %d of '%s' limits the step; ", all[0].element, body)
                                  : formatted("element %d of '%s' and %zu more of %zu limit the step; ", all[0].element, body, n - 1,
                                              all.size());
  return {what + said(Remedy::wider_elements) + formatted(", about %.2g times", then)};
}

/// Stress at which a block begins to flow, times its volume; zero of what is elastic. [J]
double plastic_capacity(const element::AnyBlock& any) {
  return std::visit(
      [&any]<class Kind, class Law>(const element::Block<Kind, Law>& block) {
        if constexpr (material::flows<Law>) {
          const auto fresh = material::fresh<double, Symmetric>(block.law);
          return yield_stress(block.law, fresh.scalar) * element::element_masses(any).sum() / block.law.density;
        }
        return 0.0;
      },
      any);
}

}  // namespace

ExpectedSteps expected_steps(const Simulation& simulation) {
  const dynamics::Model& model = simulation.model;
  const dynamics::State& now = simulation.state;
  ExpectedSteps expected;
  dynamics::StepLimits limits = now.step_limits;
  if (limits.blows.source >= 0 && limits.contact.source == limits.blows.source) limits.contact = {};  // shorter for a while alone
  expected.first = dynamics::choose_step(limits, simulation.time.safety);
  expected.elements = simulation.time.safety * now.step_limits.elements.step;
  expected.elements = std::min(expected.elements, model.longest_step);
  expected.dt = std::min(expected.first.dt, expected.elements);
  for (std::size_t c = 0; c < model.contacts.size(); ++c) expected.contacts.push_back(step_in_touch(simulation, c));
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) {
    const contact::RigidPlane& plane = model.rigid_planes[p];
    const bool none = contact::by_multipliers(plane);
    expected.rigid_planes.push_back(none ? 1e300 : contact::stable_step(plane, model.mass, now.rigid_planes[p].step_factor).step);
  }
  for (const double step : expected.contacts) expected.dt = std::min(expected.dt, step);
  return expected;
}

double count(const ExpectedSteps& expected, double end) { return std::ceil(end / expected.dt - 1e-9); }

bool may_have_multipliers(const dynamics::Model& model, const contact::Interface& interface) {
  if (interface.kind != contact::InterfaceKind::tied) return true;
  const auto is_rigid = [&](const Subset& nodes) {
    return std::any_of(nodes.begin(), nodes.end(), [&](Index node) { return dynamics::is_rigid_node(model, node); });
  };
  return interface.pass == contact::Pass::only && !is_rigid(interface.apexes) && !is_rigid(interface.base_nodes);
}

std::vector<std::string> step_advice(const Simulation& simulation, const ExpectedSteps& expected) {
  std::vector<std::string> advice;
  const auto look = [&](const char* what, const std::string& name, double step, bool may) {
    if (!(step * worth_saying < expected.elements)) return;
    advice.push_back(formatted("%s '%s' limits the step: this run has %.3g times as many steps", what, name.c_str(),
                               expected.elements / step) +
                     (may ? "; " + said(Remedy::multiplier) : ""));
  };
  for (std::size_t c = 0; c < expected.contacts.size(); ++c) {
    const contact::Interface* interface = contact::interface_of(simulation.model.contacts[c]);
    if (interface == nullptr || interface->pass == contact::Pass::back) continue;
    look("contact", interface->name, expected.contacts[c], may_have_multipliers(simulation.model, *interface));
  }
  for (std::size_t p = 0; p < expected.rigid_planes.size(); ++p)
    look("rigid plane", simulation.model.rigid_planes[p].name, expected.rigid_planes[p], true);
  for (const std::string& line : element_advice(simulation, expected)) advice.push_back(line);
  return advice;
}

std::vector<std::string> strain_notes(const Simulation& simulation) {
  constexpr double worth_a_note = 0.05;
  double capacity = 0;
  for (std::size_t b = 0; b < simulation.model.blocks.size(); ++b)
    if (!dynamics::is_rigid_block(simulation.model, b)) capacity += plastic_capacity(simulation.model.blocks[b]);
  const double part = simulation.state.ledger.initial_available / capacity;
  if (!(capacity > 0 && part > worth_a_note)) return {};
  return {formatted("the kinetic energy at the start is %.3g of yield stress times volume: strains of elements may reach this value and "
                    "more, and the forecast does not include how they change the step",
                    part)};
}

}  // namespace nereid::model
