#include "dynamics/relax.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "contact/multiplier/enforce.hpp"

namespace nereid::dynamics {

namespace {

constexpr int steps_per_sample = 10;

/// Projector onto what the planes of a node leave free.
Mat3 allowed(const State& now, Index node) {
  const Index place = now.constraints.row_of_node[node];
  return place < 0 || now.constraints.nodes[place].count == 0 ? Mat3(Mat3::Identity()) : now.constraints.nodes[place].allowed;
}
Mat3 allowed_rotation(const State& now, Index node) {
  const Index place = now.constraints.row_of_node[node];
  return place < 0 || now.constraints.nodes[place].count == 0 ? Mat3(Mat3::Identity()) : now.constraints.nodes[place].allowed_rotation;
}

/// Leaves in `f.source_*` the forces that depend on the state: blocks, contact, springs, and nothing that
/// is given as a function of time.
void find_resistance(const Model& model, const State& now, Forces& f) {
  Vectors &force = f.source_force, &moment = f.source_moment;
  force.setZero(), moment.setZero();
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    if (!load::is_spring(model.loads[l])) load::add_forces(model.loads[l], now.loads[l], force, moment);
  force = f.force - force;
  moment = f.moment - moment;
}

/// Frequency of what has moved since the reference in the memory: Rayleigh's quotient of the displacement, omega^2 = dx K dx / dx M dx,
/// which is near the lowest. The quotient weighted by energy, df M^-1 df / df dx, is near the highest: the chatter of a contact then damps
/// what is slow far too hard, and it creeps. [1/s]
double frequency(const Model& model, const State& now, const Forces& f) {
  double energy = 0, inertia = 0;
  for (Index n = 0; n < now.x.cols(); ++n) {
    const Vec3 moved = allowed(now, n) * (now.x.col(n) - now.relaxation.x.col(n));
    energy -= moved.dot(f.source_force.col(n) - now.relaxation.force.col(n));
    inertia += model.mass(n) * moved.squaredNorm();
  }
  for (Index rotation = 0; rotation < now.omega.cols(); ++rotation) {
    const Vec3 rotated = allowed_rotation(now, model.node_of_rotation[rotation]) * now.relaxation.rotated.col(rotation);
    energy -= rotated.dot(f.source_moment.col(rotation) - now.relaxation.moment.col(rotation));
    inertia += model.inertia(rotation) * rotated.squaredNorm();
  }
  return energy > 0 && inertia > 0 ? std::sqrt(energy / inertia) : 0;
}

/// Scales the velocities that planes leave free and books what is removed.
///
/// returns  the kinetic energy that is left, without that of turns [J]
double damp(const Model& model, double factor, State& now) {
  RelaxationMemory& memory = now.relaxation;
  double left = 0;
  for (Index n = 0; n < now.v.cols(); ++n) {
    const Vec3 before = now.v.col(n), after = before - (1 - factor) * (allowed(now, n) * before);
    const Vec3 impulse = model.mass(n) * (after - before);
    memory.removed -= 0.5 * impulse.dot(after + before);
    memory.impulse += impulse;
    memory.angular_impulse += now.x.col(n).cross(impulse);
    left += 0.5 * model.mass(n) * after.squaredNorm();
    now.v.col(n) = after;
  }
  for (Index rotation = 0; rotation < now.omega.cols(); ++rotation) {
    const Index place = now.constraints.row_of_node[model.node_of_rotation[rotation]];
    if (place >= 0 && now.constraints.nodes[place].driver >= 0) continue;  // the plane sets it anyway
    const Vec3 before = now.omega.col(rotation);
    const Vec3 impulse = model.inertia(rotation) * (factor - 1) * before;
    memory.removed -= 0.5 * impulse.dot((1 + factor) * before);
    memory.angular_impulse += impulse;
    now.omega.col(rotation) = factor * before;
  }
  return left;
}

/// What moves from now on is held against this state; `f` has the forces that resist.
void take_as_reference(State& now, const Forces& f) {
  RelaxationMemory& memory = now.relaxation;
  memory.x = now.x, memory.rotated = Vectors::Zero(3, now.omega.cols());
  memory.force = f.source_force, memory.moment = f.source_moment;
  memory.since = now.t;
}

double square(const Model& model, const Vectors& force, const Vectors& moment) {
  double sum = 0;
  for (Eigen::Index n = 0; n < force.cols(); ++n) sum += force.col(n).squaredNorm() / model.mass(n);
  for (Eigen::Index rotation = 0; rotation < moment.cols(); ++rotation) sum += moment.col(rotation).squaredNorm() / model.inertia(rotation);
  return sum;
}

/// Squared norms of each source's forces, summed. [N2/kg]
double forces_by_source(const Model& model, const State& now, Forces& f) {
  Vectors &force = f.source_force, &moment = f.source_moment;
  double sum = model.mass.sum() * model.gravity.squaredNorm();
  const auto clear = [&] { force.setZero(), moment.setZero(); };
  for (std::size_t b = 0; b < model.blocks.size(); ++b) {
    clear();
    const element::TileForces& tiles = now.tiles[b];
    element::add_by_node(model.node_sums[b], tiles.force, force);
    if (tiles.moment.cols() > 0) element::add_by_node(model.node_sums[b], tiles.moment, model.rotation_of_node, moment);
    sum += square(model, force, moment);
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l) {
    clear();
    load::add_forces(model.loads[l], now.loads[l], force, moment);
    sum += square(model, force, moment);
  }
  return sum;
}

/// Squared norm of what no plane and no other source balances. [N2/kg]
double unbalanced(const Model& model, const State& now, const Forces& f) {
  double sum = 0;
  for (Index n = 0; n < now.x.cols(); ++n) sum += (allowed(now, n) * f.force.col(n)).squaredNorm() / model.mass(n);
  for (Index rotation = 0; rotation < now.omega.cols(); ++rotation)
    sum += (allowed_rotation(now, model.node_of_rotation[rotation]) * f.moment.col(rotation)).squaredNorm() / model.inertia(rotation);
  return sum;
}

}  // namespace

void begin_relaxation(const Model& model, State& now, Forces& f) {
  RelaxationMemory& memory = now.relaxation;
  memory.residual = 1, memory.kinetic = memory.most_force = memory.most_kinetic = 0, memory.balanced = 0;
  find_resistance(model, now, f);
  take_as_reference(now, f);
  memory.omega = now.omega;
}

bool relax(const Model& model, double next, State& now, Forces& f) {
  RelaxationMemory& memory = now.relaxation;
  find_resistance(model, now, f);
  memory.rotated += 0.5 * now.dt * (memory.omega + now.omega);
  const double omega = now.step > 1 ? frequency(model, now, f) : 0;  // the first step has nothing before it
  f.dx = now.v, f.rotation = now.omega;
  const double kinetic = memory.kinetic = damp(model, std::exp(-2 * omega * now.dt), now);
  f.dx = now.v - f.dx, f.rotation = now.omega - f.rotation;  // the next step sets its own
  contact::change_work_to_come(model.contacts, model.rigid_planes, f.dx, f.rotation, model.rotation_of_node, next, now.contacts,
                               now.rigid_planes);
  memory.omega = now.omega;
  if (omega * (now.t - memory.since) >= 1 || omega == 0) take_as_reference(now, f);  // a radian is enough to know a frequency
  memory.most_kinetic = std::max(memory.most_kinetic, kinetic);
  if (now.step % steps_per_sample != 0) return false;
  memory.most_force = std::max(memory.most_force, std::sqrt(forces_by_source(model, now, f)));
  const double rest = std::sqrt(unbalanced(model, now, f));
  memory.residual = memory.most_force > 0 ? rest / memory.most_force : 0;
  const Relaxation& wanted = *model.relaxation;
  const bool balanced = now.t >= wanted.after && memory.residual <= wanted.residual && kinetic <= wanted.residual * memory.most_kinetic;
  memory.balanced = balanced ? memory.balanced + 1 : 0;
  return memory.balanced >= wanted.samples;
}

}  // namespace nereid::dynamics
