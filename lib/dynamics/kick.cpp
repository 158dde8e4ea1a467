#include "dynamics/kick.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.hpp"
#include "dynamics/balance.hpp"
#include "dynamics/rigid_step.hpp"
#include "load/floor.hpp"

namespace nereid::dynamics {

namespace {

/// Which half of a step a kick is.
enum class Half { first, second };

/// Changes velocities by the impulses of the forces over dt, within the constraints.
///
/// t  [s] to which the new velocities belong
/// returns  sum of f.f/m over what the constraints let through: the ledger's integration term
double kick(const Model& model, double dt, double t, Half half, State& now, Forces& f) {
  auto& constraints = now.constraints;
  load::set_speeds(model.constraints, model.mesh.X, t, constraints);
  const double nodes = ordered_sum(static_cast<Index>(now.v.cols()), f.partial, [&](Index node) {
    const double mass = model.mass(node);
    const Vec3 force = f.force.col(node);
    const Index row = constraints.row_of_node[node];
    now.v.col(node) += dt / mass * force;  // constrained nodes are restrained below, in order
    if (row < 0 || constraints.nodes[row].count == 0) return force.squaredNorm() / mass;
    return (constraints.nodes[row].allowed * force).squaredNorm() / mass;
  });
  const double rotations = ordered_sum(static_cast<Index>(now.omega.cols()), f.partial, [&](Index rotation) {
    const double inertia = model.inertia(rotation);
    const Vec3 moment = f.moment.col(rotation);
    const Index row = constraints.row_of_node[model.node_of_rotation[rotation]];
    now.omega.col(rotation) += dt / inertia * moment;
    if (row < 0) return moment.squaredNorm() / inertia;
    return (constraints.nodes[row].allowed_rotation * moment).squaredNorm() / inertia;
  });
  const load::Kick given{f.force, f.moment, model.mass, model.inertia, dt, half == Half::first ? -dt / 2 : dt / 2};
  load::constrain(model.constraints, given, now.x, now.v, now.omega, constraints);
  return nodes + rotations + (model.rigid_bodies.empty() ? 0 : kick_rigid_bodies(model, dt, t, half == Half::first, now, f));
}

/// What f.f/m has of contacts by multipliers, which book it as their own work. [W/s]
double power_rate_of_multipliers(const State& now) {
  double sum = 0;
  for (const contact::AnyMemory& memory : now.contacts) sum += contact::sides(memory).power_rate;
  for (const contact::PlaneMemory& memory : now.rigid_planes) sum += memory.power_rate;
  return sum;
}

/// Angular impulse of gravity over a step, by the trapezoid rule: the centre of mass in its middle.
void post_moment_of_gravity(const Model& model, double dt, State& now) {
  if (model.gravity.isZero(0)) return;
  Vec3 middle = Vec3::Zero();
  for (Eigen::Index n = 0; n < now.x.cols(); ++n)
    if (!is_rigid_node(model, static_cast<Index>(n))) middle += model.mass(n) * (now.x.col(n) - 0.5 * dt * now.v.col(n));
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) {
    const rigid::Body& body = model.rigid_bodies[b];
    middle += body.mass.mass * rigid::centre(body, now.rigid_bodies[b]) - 0.5 * dt * now.rigid_bodies[b].momentum;
  }
  now.ledger.accounts.back().angular_impulse += dt * middle.cross(model.gravity);
}

}  // namespace

double kick_to_the_middle(const Model& model, double dt, State& now, Forces& f) {
  const double square = kick(model, dt / 2, now.t + dt / 2, Half::first, now, f) - power_rate_of_multipliers(now);
  load::find_impacts(model.constraints, model.mass, now.x, f.force, dt, now.v, now.constraints);
  return square;
}

void drift(const Model& model, double dt, State& now, Forces& f) {
  drift_rigid_bodies(model, dt, now, f);
  f.dx = dt * now.v;
  f.rotation = dt * now.omega;
  now.x += f.dx;
  place_rigid_nodes(model, now);
  now.t += dt;
  load::put_on_floors(model.constraints, now.constraints, now.x);
  post_moment_of_gravity(model, dt, now);
}

Ended kick_to_the_end(const Model& model, double dt, State& now, Forces& f) {
  load::finish_impacts(model.constraints, model.mass, now.x, f.force, dt, now.v, now.constraints);
  const double square = kick(model, dt / 2, now.t, Half::second, now, f) - power_rate_of_multipliers(now);
  return {square, finish_rigid_step(model, dt, now, f)};
}

void constrain_velocities(const Model& model, double kinetic, State& now, Forces& f) {
  f.force.setZero();
  f.moment.setZero();
  std::fill(f.rigid_bodies.begin(), f.rigid_bodies.end(), RigidForces{});
  const std::vector<load::PlaneAccount> before = now.constraints.account;
  kick(model, 0, now.t, Half::second, now, f);
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) rigid::set_node_velocities(model.rigid_bodies[b], now.rigid_bodies[b], now.v);
  double removed = kinetic - kinetic_energy(model, now);
  std::vector<load::PlaneAccount>& after = now.constraints.account;
  for (std::size_t p = 0; p < after.size(); ++p)  // booked already
    removed += (after[p].driven - before[p].driven) - (after[p].stopped - before[p].stopped);
  if (removed == 0 || after.empty()) return;
  const Vec3 centre = now.x.rowwise().mean();
  const double arm = (now.x.colwise() - centre).colwise().norm().maxCoeff();
  std::size_t main = 0;  // that acted most, since where the axes are oblique all planes act by round-off
  double most = 0;
  for (std::size_t p = 0; p < after.size(); ++p) {
    const Vec3 given = after[p].impulse - before[p].impulse, turning = after[p].angular_impulse - before[p].angular_impulse;
    const double acted = arm * given.norm() + (turning - centre.cross(given)).norm();
    if (acted > most * (1 + 1e-9)) most = acted, main = p;
  }
  if (most > 0) after[main].stopped += removed;
}

}  // namespace nereid::dynamics
