#include "dynamics/step.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "contact/data/meeting.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/penalty/impact_step.hpp"
#include "dynamics/relax.hpp"
#include "dynamics/rigid_step.hpp"
#include "dynamics/section.hpp"
#include "dynamics/thickness.hpp"
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

/// The stable step of elements and springs together, named after the springs where they govern.
Vote with_springs(const load::SpringRates& springs, int first_load, const Vote& elements) {
  if (springs.stiffest < 0) return elements;
  const double step = load::step_with_springs(elements.step, springs);
  if (step < 0.5 * elements.step) return {step, first_load + springs.stiffest, -1};
  return {step, elements.source, elements.at};
}

/// Brings every source of force to the new positions: memory, forces by source, votes for the next step.
void update(const Model& model, double dt, State& now, Forces& f) {
  Votes votes;
  int source = 0;
  for (std::size_t b = 0; b < model.blocks.size(); ++b, ++source) {
    if (is_rigid_block(model, b)) {
      const double limit = rigid_step_limit(model, now, static_cast<std::size_t>(model.rigid_of_block[b]));
      votes.contact.see({limit, limit < model.longest_step ? -1 : at_largest_step}, source);
      continue;
    }
    const element::Vote vote = element::advance(model.blocks[b], now.x, f.dx, f.rotation, dt, now.blocks[b], now.tiles[b], f.reports[b]);
    votes.elements.see({vote.step, vote.step_element}, source);
    if (vote.volume_ratio < votes.volume_ratio || std::isnan(vote.volume_ratio)) {  // once found, a NaN stays
      votes.volume_ratio = vote.volume_ratio, votes.smallest_block = source, votes.smallest_element = vote.volume_element;
    }
  }
  see_thickness(model, now, f);
  for (std::size_t c = 0; c < model.interfaces.size(); ++c, ++source) {
    if (f.half_growth.size() > 0) contact::follow_thickness(model.interfaces[c], f.half_growth, now.interfaces[c]);
    if (contact::by_multipliers(model.interfaces[c])) continue;
    contact::Memory& memory = now.interfaces[c];
    const double deepest = memory.deepest;
    contact::advance(model.interfaces[c], now.x, now.v, now.omega, dt, memory, f.interfaces[c]);
    if (memory.deepest > deepest) memory.deepest_time = now.t;
    votes.contact.see(contact::stable_step(model.interfaces[c], model.mass, model.inertia, now.interfaces[c], f.interfaces[c], dt), source);
  }
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p, ++source) {
    if (contact::by_multipliers(model.rigid_planes[p])) continue;
    contact::PlaneMemory& memory = now.rigid_planes[p];
    const double deepest = memory.deepest;
    contact::advance(model.rigid_planes[p], now.x, now.v, dt, memory);
    if (memory.deepest > deepest) memory.deepest_time = now.t;
    votes.contact.see(contact::stable_step(model.rigid_planes[p], model.mass, memory.step_factor), source);
  }
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    load::advance(model.loads[l], model.mesh.X, now.x, now.v, now.omega, now.t, dt, now.loads[l]);
  source += static_cast<int>(model.constraints.planes.size());
  votes.elements = with_springs(f.springs, source, votes.elements);
  now.votes = votes;
}

/// Adds the forces of contacts that act by multipliers, or of those that do not.
void add_contact_forces(const Model& model, const State& now, bool by_multipliers, Forces& f) {
  for (std::size_t c = 0; c < model.interfaces.size(); ++c)
    if (contact::by_multipliers(model.interfaces[c]) == by_multipliers)
      contact::add_forces(model.interfaces[c], now.interfaces[c], f.force, f.moment);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p)
    if (contact::by_multipliers(model.rigid_planes[p]) == by_multipliers)
      contact::add_forces(model.rigid_planes[p], now.rigid_planes[p], f.force);
}

/// Shows multipliers the constraints of the nodes that they can act on.
void see_constraints(const State& now, Forces& f) {
  const load::Memory& constraints = now.constraints;
  for (const Index at : f.multipliers.nodes) {
    const Index row = constraints.row_of_node[at];
    if (row < 0 || constraints.nodes[row].count == 0) continue;
    const load::ConstrainedNode& node = constraints.nodes[row];
    f.allowed[at] = &node.allowed;
    if (node.rotation >= 0) f.allowed_rotation[node.rotation] = &node.allowed_rotation;
  }
}

contact::Motion motion_of(const Model& model, const Vectors& force, double dt, const Pace& pace, const State& now, Forces& f) {
  const double next = next_length(now.votes, pace, now.t, dt);
  return {now.x, now.v, now.omega, force, f.moment, model.mass, model.inertia, model.rotation_of_node, f.allowed, f.allowed_rotation, dt,
          next, nullptr, see_rigid_bodies(model, &force == &f.force ? 0.5 * (dt + next) : 0, next, now, f)};
}

/// Stops what begins in contact; what constraints hold of the impulses goes to their accounts.
void stop_at_start(const Model& model, const Pace& pace, State& now, Forces& f) {
  see_constraints(now, f);
  f.dx.setZero();
  Vectors impulse = Vectors::Zero(3, now.v.cols());
  const contact::Motion motion = motion_of(model, f.dx, 0, pace, now, f);
  contact::stop_at_start(model.interfaces, model.rigid_planes, motion, now.t, now.interfaces, now.rigid_planes, f.interfaces,
                         f.multipliers, impulse);
  for (Eigen::Index node = 0; node < now.v.cols(); ++node) now.v.col(node) += impulse.col(node) / model.mass(node);
  push_rigid_bodies(model, impulse, now);
  const Vectors no_moment = Vectors::Zero(3, now.omega.cols());
  load::constrain(model.constraints, {impulse, no_moment, model.mass, model.inertia, 1, 0}, now.x, now.v, now.omega, now.constraints);
}

/// What planes that move change in the velocities of their nodes by the time t [s].
void see_speeds(const Model& model, double t, State& now, Forces& f) {
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

/// Finds the forces of contacts that act by multipliers, which need all others, and adds them.
///
/// dt  [s] of the step that led here, zero at the start
void enforce(const Model& model, double dt, const Pace& pace, State& now, Forces& f) {
  if (f.allowed.empty()) return;
  see_constraints(now, f);
  contact::Motion motion = motion_of(model, f.force, dt, pace, now, f);
  if (f.driven.cols() > 0) {
    see_speeds(model, now.t + 0.5 * motion.next, now, f);
    motion.driven = &f.driven;
  }
  contact::enforce(model.interfaces, model.rigid_planes, motion, now.t, now.interfaces, now.rigid_planes, f.interfaces, f.multipliers);
  add_contact_forces(model, now, true, f);
  gather_rigid_forces(model, f);
}

/// Forces on the nodes, summed over sources in a fixed order; without contact by multipliers.
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

/// What f.f/m has of contacts by multipliers, which book it as their own work. [W/s]
double power_rate_of_multipliers(const State& now) {
  double sum = 0;
  for (const contact::Memory& memory : now.interfaces) sum += memory.power_rate;
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

double kinetic_energy(const Model& model, const State& now) {
  double sum = 0;
  for (Eigen::Index n = 0; n < now.v.cols(); ++n)
    if (!is_rigid_node(model, static_cast<Index>(n))) sum += 0.5 * model.mass(n) * now.v.col(n).squaredNorm();
  for (Eigen::Index n = 0; n < now.omega.cols(); ++n) sum += 0.5 * model.inertia(n) * now.omega.col(n).squaredNorm();
  return sum + rigid_kinetic_energy(model, now);
}

void momenta(const Model& model, const State& now, Vec3& linear, Vec3& angular) {
  linear.setZero();
  angular.setZero();
  for (Eigen::Index n = 0; n < now.v.cols(); ++n) {
    if (is_rigid_node(model, static_cast<Index>(n))) continue;
    const Vec3 p = model.mass(n) * now.v.col(n), at = now.x.col(n);
    linear += p;
    angular += at.cross(p);
  }
  for (Eigen::Index n = 0; n < now.omega.cols(); ++n) angular += model.inertia(n) * now.omega.col(n);
  add_rigid_momenta(model, now, linear, angular);
}

void post_gravity(const Model& model, const State& now, Account& account) {
  Vec3 fallen = Vec3::Zero();
  for (Eigen::Index n = 0; n < now.x.cols(); ++n)
    if (!is_rigid_node(model, static_cast<Index>(n))) fallen += model.mass(n) * (now.x.col(n) - model.mesh.X.col(n));
  for (std::size_t b = 0; b < model.rigid_bodies.size(); ++b) fallen += model.rigid_bodies[b].mass.mass * now.rigid_bodies[b].shift;
  account.hold(Stored::potential, -fallen.dot(model.gravity));
  account.work = -account.stored[Stored::potential];
  account.impulse = total_mass(model) * now.t * model.gravity;
}

void post_relaxation(const RelaxationMemory& memory, Account& account) {
  account.work = -memory.removed;
  account.dissipated[Dissipated::removed] = memory.removed;
  account.impulse = memory.impulse;
  account.angular_impulse = memory.angular_impulse;
}

/// Whether nothing but gravity acts from outside.
bool is_free(const Model& model) {
  return model.rigid_planes.empty() && model.constraints.planes.empty() && model.loads.empty() && !model.relaxation;
}

/// Removes from the velocities what the constraints do not allow, and books the energy that this takes.
///
/// kinetic  [J] before
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

/// Posts what every source of force keeps up to date by itself, in the order of sources(model); gravity and relaxation are left out.
/// returns  the account after them
std::vector<Account>::iterator post_sources(const Model& model, State& now) {
  auto account = now.ledger.accounts.begin();
  for (std::size_t b = 0; b < model.blocks.size(); ++b) element::post(model.blocks[b], now.blocks[b], *account++);
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) contact::post(model.interfaces[c], now.interfaces[c], *account++);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) contact::post(model.rigid_planes[p], now.rigid_planes[p], *account++);
  for (const load::PlaneAccount& plane : now.constraints.account) load::post(plane, *account++);
  for (std::size_t l = 0; l < model.loads.size(); ++l) load::post(model.loads[l], now.loads[l], *account++);
  return account;
}

/// Sees what contacts by multipliers have given and not taken back yet.
void see_debts(const Model& model, State& now) {
  std::size_t source = model.blocks.size();
  const auto look = [&](const auto& contact, const auto& memory) {
    Flow& flow = now.ledger.flows[source];
    flow.owed = contact::by_multipliers(contact) && created(now.ledger.accounts[source]) > 0 ? contact::owed(memory) : 0;
    ++source;
  };
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) look(model.interfaces[c], now.interfaces[c]);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) look(model.rigid_planes[p], now.rigid_planes[p]);
}

/// Lowers the votes of penalties that have created or lost too much, for good. The works of this step must have been seen.
void lower_votes(const Model& model, State& now) {
  std::size_t source = model.blocks.size();
  const double scale = steady_scale(now.ledger);
  const auto look = [&](const auto& contact, contact::StepFactorMemory& memory) {
    const std::size_t at = source++;
    if (!(contact::step_factor(contact, memory) > contact.impact_step_factor)) return;
    const Account& account = now.ledger.accounts[at];
    const double made = created(account), limit = contact::most_created_in_a_bounce(contact.impact_step_factor);
    double spurious = made - memory.least_created - now.ledger.flows[at].recent;
    if (stored(account) == 0) {  // while an apex presses, its release is still to give back what its first touch took
      memory.least_created = std::min(memory.least_created, made), memory.most_created = std::max(memory.most_created, made);
      spurious = std::max(spurious, memory.most_created - made);
    }
    if (part_of_flow(now.ledger, at, spurious, scale) > limit) memory.lowered_at = now.t;
  };
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) look(model.interfaces[c], now.interfaces[c].step_factor);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) look(model.rigid_planes[p], now.rigid_planes[p].step_factor);
}

/// Twice the largest distance of a node from the centre of mass: the diagonal of a box. [m]
double size_of_scene(const Model& model, const Vectors& x) {
  const Vec3 centre = x * model.mass / model.mass.sum();
  return 2 * std::sqrt((x.colwise() - centre).colwise().squaredNorm().maxCoeff());
}

/// Kinetic energy of all bodies that move by a hundred times the round-off of their positions in a step: 1/2 m (100 eps |x| / dt)^2. [J]
double energy_of_round_off(const Model& model, const Vectors& x, double dt) {
  const double way = 100 * 0.5 * std::numeric_limits<double>::epsilon() * x.cwiseAbs().maxCoeff();
  return 0.5 * total_mass(model) * way * way / (dt * dt);
}

/// Brings the largest force of the ledger up to what loads apply now.
void update_largest_force(const Model& model, State& now) {
  Ledger& ledger = now.ledger;
  double applied = 0;
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    if (!load::is_spring(model.loads[l])) applied += load::applied(now.loads[l], ledger.size);
  ledger.largest_force = std::max(ledger.largest_force, applied);
}

/// What the stores hold now counts as held at the start.
void open_ledger(const Model& model, State& now) {
  for (Account& account : now.ledger.accounts) account.at_start = {};
  update_ledger(model, now);
  for (Account& account : now.ledger.accounts) {
    account.at_start = account.stored;
    account.at_start[Stored::external_work] = 0;
  }
  now.ledger.external_work = 0;
  update_ledger(model, now);
  for (std::size_t a = 0; a < now.ledger.accounts.size(); ++a) now.ledger.flows[a] = {.work = now.ledger.accounts[a].work};
}

}  // namespace

const Votes& step(const Model& model, double dt, const Pace& pace, State& now, Forces& f) {
  const double of_multipliers = power_rate_of_multipliers(now);
  const double before = kick(model, dt / 2, now.t + dt / 2, Half::first, now, f) - of_multipliers;  // v at the half step
  load::find_impacts(model.constraints, model.mass, now.x, f.force, dt, now.v, now.constraints);
  drift_rigid_bodies(model, dt, now, f);
  f.dx = dt * now.v;
  f.rotation = dt * now.omega;
  now.x += f.dx;
  place_rigid_nodes(model, now);
  now.t += dt;
  load::put_on_floors(model.constraints, now.constraints, now.x);
  post_moment_of_gravity(model, dt, now);
  const Votes before_it = now.votes;
  update(model, dt, now, f);  // memory: stress, connectivity; forces by source; votes
  const double scale = steady_scale(now.ledger);
  see_growth(before_it, pace, dt, scale > 0 ? now.ledger.integration_kept / scale : 0, now.votes);
  gather(model, now, f);
  enforce(model, dt, pace, now, f);
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) contact::see_meetings(model.interfaces[c], dt, now.t, now.interfaces[c]);
  see_sections(model, dt, now);
  load::finish_impacts(model.constraints, model.mass, now.x, f.force, dt, now.v, now.constraints);
  const double after = kick(model, dt / 2, now.t, Half::second, now, f) - power_rate_of_multipliers(now);  // v at t + dt
  const double of_rotation = finish_rigid_step(model, dt, now, f);
  now.ledger.integration += dt * dt / 8 * (after - before) + of_rotation;
  now.ledger.integration_kept += of_rotation;
  if (now.step > 0) now.ledger.integration_kept -= (dt * dt - now.dt * now.dt) / 8 * before;
  now.dt = dt;
  ++now.step;
  post_sources(model, now);
  update_largest_force(model, now);
  see_debts(model, now);
  see_flows(now.ledger);
  lower_votes(model, now);
  return now.votes;
}

const Votes& start(const Model& model, const Pace& pace, State& now, Forces& f) {
  start_rigid_bodies(model, now);
  now.ledger.initial_kinetic = kinetic_energy(model, now);
  momenta(model, now, now.ledger.initial_momentum, now.ledger.initial_angular_momentum);
  const double of_centre = is_free(model) ? 0.5 * now.ledger.initial_momentum.squaredNorm() / total_mass(model) : 0;
  now.ledger.initial_available = now.ledger.initial_kinetic - of_centre;
  constrain_velocities(model, now.ledger.initial_kinetic, now, f);
  load::find_impacts(model.constraints, model.mass, now.x, f.force, 0, now.v, now.constraints);
  load::finish_impacts(model.constraints, model.mass, now.x, f.force, 0, now.v, now.constraints);
  f.dx.setZero(), f.rotation.setZero();
  update(model, 0, now, f);
  gather(model, now, f);
  now.ledger.size = size_of_scene(model, now.x);
  now.ledger.largest_force = total_mass(model) * model.gravity.norm();
  now.ledger.round_off = energy_of_round_off(model, now.x, next_length(now.votes, pace, now.t, 0));
  update_largest_force(model, now);
  open_ledger(model, now);
  if (!f.allowed.empty()) {
    stop_at_start(model, pace, now, f);
    enforce(model, 0, pace, now, f);
    update_ledger(model, now);
  }
  for (std::size_t c = 0; c < model.interfaces.size(); ++c) contact::see_meetings(model.interfaces[c], 0, now.t, now.interfaces[c]);
  see_sections(model, 0, now);
  return now.votes;
}

void resume(const Model& model, const State& now, Forces& f) {
  gather(model, now, f);
  add_contact_forces(model, now, true, f);
  gather_rigid_forces(model, f);
}

void change(const Model& model, const Vectors& velocity, const Vectors& spin, State& now, Forces& f) {
  const auto nodes = static_cast<Index>(now.x.cols());
  now.constraints = load::in_place_of(now.constraints, constraints_of_nodes(model), nodes, model.rotation_of_node);
  Ledger& ledger = now.ledger;
  const double before = kinetic_energy(model, now);
  Vec3 linear, angular, given, given_angular;
  momenta(model, now, linear, angular);
  if (!velocity.isZero(0) || !spin.isZero(0)) {
    now.v += velocity, now.omega += spin;
    start_rigid_bodies(model, now);
  }
  const double kinetic = kinetic_energy(model, now);
  momenta(model, now, given, given_angular);
  ledger.initial_kinetic += kinetic - before, ledger.initial_available += kinetic - before;
  ledger.initial_momentum += given - linear, ledger.initial_angular_momentum += given_angular - angular;
  constrain_velocities(model, kinetic, now, f);
  for (std::size_t l = 0; l < model.loads.size(); ++l)
    load::advance(model.loads[l], model.mesh.X, now.x, now.v, now.omega, now.t, 0, now.loads[l]);
  update_ledger(model, now);
  if (!model.relaxation || !model.relaxes) return;
  resume(model, now, f);
  begin_relaxation(model, now, f);
}

void update_ledger(const Model& model, State& now) {
  Ledger& ledger = now.ledger;
  ledger.kinetic = kinetic_energy(model, now);
  momenta(model, now, ledger.momentum, ledger.angular_momentum);
  auto account = post_sources(model, now);
  if (model.relaxation) post_relaxation(now.relaxation, *account++);
  if (!model.gravity.isZero(0)) post_gravity(model, now, *account);
  ledger.external_work = std::max(ledger.external_work, work_from_loads(ledger));
  see_created(ledger);
}

}  // namespace nereid::dynamics
