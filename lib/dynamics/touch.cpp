#include "dynamics/touch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/forces.hpp"
#include "dynamics/rigid_step.hpp"

namespace nereid::dynamics {

namespace {

/// Shows multipliers the constraints of the nodes that they can act on.
void find_constraints(const State& now, Forces& f) {
  const load::Memory& constraints = now.constraints;
  for (const Index at : f.multipliers.nodes) {
    const Index row = constraints.row_of_node[at];
    if (row < 0 || constraints.nodes[row].count == 0) continue;
    const load::ConstrainedNode& node = constraints.nodes[row];
    f.allowed[at] = &node.allowed;
    if (node.rotation >= 0) f.allowed_rotation[node.rotation] = &node.allowed_rotation;
  }
}

/// How the nodes move in the step to come, of length `next` [s].
///
/// force  [N] on the nodes;  dt  [s] of the step that led here;  acts  [s] for which the forces act on rigid bodies
contact::Motion motion_of(const Model& model, const Vectors& force, double dt, double next, double acts, const State& now, Forces& f) {
  return {now.x, now.v, now.omega, force, f.moment, model.mass, model.inertia, model.rotation_of_node, f.allowed, f.allowed_rotation, dt,
          next, nullptr, predict_rigid_bodies(model, acts, next, now, f)};
}

/// What planes that move change in the velocities of their nodes by the time t [s].
void find_driven_speeds(const Model& model, double t, State& now, Forces& f) {
  load::set_speeds(model.constraints, model.mesh.X, t, now.constraints);  // the next kick sets its own
  for (const Index row : now.constraints.active) {
    const load::ConstrainedNode& node = now.constraints.nodes[row];
    if (!node.moves) continue;
    const Vec3 v = now.v.col(node.node);
    Vec3 change = node.allowed * v - v;
    for (int p = 0; p < node.count; ++p) change += node.speed[p] * node.reaction[p];
    f.driven.col(node.node) = change;
  }
}

/// Whether it would make too much energy, with what earlier changes have made, to shorten the step to come while bodies ring.
bool costs_too_much(double step, double next, const State& now) {
  const double made = (next * next - step * step) / 8 * now.step_limits.ringing;
  return made + now.ledger.integration_kept > 0.25 * contact::most_ringing * now.step_limits.energy;
}

}  // namespace

void stop_at_start(const Model& model, const Pace& pace, State& now, Forces& f) {
  find_constraints(now, f);
  f.dx.setZero();
  Vectors impulse = Vectors::Zero(3, now.v.cols());
  const contact::Motion motion = motion_of(model, f.dx, 0, next_length(now.step_limits, pace, now.t, 0), 0, now, f);
  contact::stop_at_start(model.contacts, model.rigid_planes, motion, now.t, now.contacts, now.rigid_planes, f.contacts,
                         f.multipliers, impulse);
  for (Eigen::Index node = 0; node < now.v.cols(); ++node) now.v.col(node) += impulse.col(node) / model.mass(node);
  push_rigid_bodies(model, impulse, now);
  const Vectors no_moment = Vectors::Zero(3, now.omega.cols());
  load::constrain(model.constraints, {impulse, no_moment, model.mass, model.inertia, 1, 0}, now.x, now.v, now.omega, now.constraints);
}

void enforce(const Model& model, double dt, const Pace& pace, State& now, Forces& f) {
  if (f.allowed.empty()) return;
  find_constraints(now, f);
  StepLimits& limits = now.step_limits;
  for (const bool again : {false, true}) {
    const double energy = pace.fixed > 0 ? std::numeric_limits<double>::infinity() : std::max(steady_scale(now.ledger), limits.energy);
    const double next = next_length(now.step_limits, pace, now.t, dt);
    contact::Motion motion = motion_of(model, f.force, dt, next, 0.5 * (dt + next), now, f);
    motion.again = again;
    if (f.driven.cols() > 0) {
      find_driven_speeds(model, now.t + 0.5 * motion.next, now, f);
      motion.driven = &f.driven;
    }
    contact::BlowLimit limit = contact::enforce(model.contacts, model.rigid_planes, motion, now.t, now.contacts, now.rigid_planes,
                                                f.contacts, energy, limits.blows.source >= 0, f.multipliers);
    limits.blows.step = limit.step;
    if (again || !(limit.step < next)) break;
    limits.energy = std::max(limit.energy, kinetic_energy(model, now));  // what gravity has done is known at rows alone
    limit.step *= std::sqrt(limits.energy / limit.energy);
    if (!(limit.step < next) || costs_too_much(limit.step, next, now)) continue;
    limits.blows.source = static_cast<int>(model.blocks.size() + limit.of), limits.blows.at = limit.node;
    limits.contact.lower_to({step_for_blows(pace.safety * limits.elements.step, limit.step), limit.node}, limits.blows.source);
  }
  add_contact_forces(model, now, true, f);
  gather_rigid_forces(model, f);
}

}  // namespace nereid::dynamics
