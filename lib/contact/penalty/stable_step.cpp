#include "contact/penalty/advance.hpp"

#include <cmath>

#include "contact/search/near.hpp"
#include "contact/tracking/element.hpp"

namespace nereid::contact {

namespace {

constexpr double falls_to = 0.8;  // [-] of the last step, as long as an apex is open for some steps more

/// The largest squared frequency among the apexes. [1/s2]
struct Fastest {
  double omega_squared = 0;
  Index apex = -1;  // in Interface::apexes
  void see(double value, Index a) {
    if (value > omega_squared) omega_squared = value, apex = a;
  }
};

/// Largest squared frequency of the moments of sticking friction, which turn plate nodes.
Fastest moments_of_friction(const Interface& interface, const Scalars& inertia, const Memory& memory, Workspace& workspace) {
  Fastest fastest;
  if (interface.rotation_of_node.empty()) return fastest;
  Scalars& sum = workspace.rotation_sum;
  const auto arms = [](const FrictionForces& friction, auto&& visit) {  // weights of the turning nodes [m]
    if (!friction.acts) return;
    const Touch& touch = friction.touch;
    if (!touch.apex_arm.isZero(0)) visit(touch.apex, touch.apex_arm.norm());
    for (int I = 0; touch.base_rotates && I < 3; ++I) visit(touch.node[I], touch.weight[I] * touch.base_arm.norm());
  };
  for (const Near& near : memory.near) arms(*near.friction, [&](Index node, double) { sum(node) = 0; });
  for (const Near& near : memory.near)
    arms(*near.friction, [&](Index node, double share) { sum(node) += near.friction->stiffness * share; });
  for (const Near& near : memory.near) {
    double omega_squared = 0;
    arms(*near.friction, [&](Index node, double share) { omega_squared += share * sum(node) / inertia(interface.rotation_of_node[node]); });
    fastest.see(omega_squared, near.apex);
  }
  return fastest;
}

/// Largest squared frequency of the normal springs between apexes and bases; of an open apex no more than lets the step fall bit by bit.
///
/// factor  [-] dt omega of the step limit
Fastest normal_springs(const Interface& interface, const Scalars& mass, const Memory& memory, double factor, double last,
                       Workspace& workspace) {
  Scalars& sum = workspace.spring_sum;
  const auto shares = [&](const ElementForces& element, auto&& visit) {
    for (int i = 0; i < element.count; ++i)
      for_each_node(interface, element.stencil[i], [&](Index node, double, double share) {
        if (share > 0) visit(node, share);
      });
  };
  for (const Near& near : memory.near) shares(near.element, [&](Index node, double) { sum(node) = 0; });
  for (const Near& near : memory.near) {
    const double k = near.element.stiffness;
    shares(near.element, [&](Index node, double share) { sum(node) += k * share; });
  }
  Fastest fastest;
  for (const Near& near : memory.near) {
    const ElementForces& element = near.element;
    if (element.count == 0) continue;
    double omega_squared = element.stiffness / mass(interface.apexes[near.apex]);
    shares(element, [&](Index node, double share) { omega_squared += share * sum(node) / mass(node); });
    const double in_time = std::min(falls_to * last, element.closes_in / steps_ahead);
    if (in_time > 0) omega_squared = std::min(omega_squared, interface.pass_factor * factor * factor / (in_time * in_time));
    fastest.see(omega_squared, near.apex);
  }
  return fastest;
}

}  // namespace

StepLimit stable_step(const Interface& interface, const Scalars& mass, const Scalars& inertia, const Memory& memory,
                      Workspace& workspace, double last) {
  if (by_multipliers(interface)) return {};
  const double factor = step_factor(interface, memory.step_factor);
  const Fastest normal = normal_springs(interface, mass, memory, factor, last, workspace);
  if (normal.apex < 0) return {};
  const double omega_squared = normal.omega_squared / interface.pass_factor;
  const Index apex = interface.apexes[normal.apex];
  if (interface.kind == InterfaceKind::tied) return {linear_step / std::sqrt(omega_squared), apex};
  const StepLimit bounce{factor / std::sqrt(omega_squared), apex};
  if (memory.slip.empty()) return bounce;
  // sticks are parallel to the normal springs, and their moments turn plate nodes besides
  const Fastest turning = moments_of_friction(interface, inertia, memory, workspace);
  const double most = interface.friction.tangential_penalty * omega_squared + turning.omega_squared / interface.pass_factor;
  const StepLimit stick{linear_step / std::sqrt(most), turning.apex >= 0 ? interface.apexes[turning.apex] : apex};
  return stick.step < bounce.step ? stick : bounce;
}

}  // namespace nereid::contact
