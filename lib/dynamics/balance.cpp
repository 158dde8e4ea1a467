#include "dynamics/balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/contact.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/penalty/impact_step.hpp"
#include "dynamics/ledger.hpp"
#include "dynamics/relax.hpp"
#include "dynamics/rigid_step.hpp"
#include "dynamics/section.hpp"

namespace nereid::dynamics {

namespace {

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

/// Posts what every source of force keeps up to date by itself, in the order of sources(model); gravity and relaxation are left out.
/// returns  the account after them
std::vector<Account>::iterator post_sources(const Model& model, State& now) {
  auto account = now.ledger.accounts.begin();
  for (std::size_t b = 0; b < model.blocks.size(); ++b) element::post(model.blocks[b], now.blocks[b], *account++);
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    contact::with_memory(model.contacts[c], now.contacts[c],
                         [&](const auto& one, const auto& memory) { contact::post(one, memory, *account++); });
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) contact::post(model.rigid_planes[p], now.rigid_planes[p], *account++);
  for (const load::PlaneAccount& plane : now.constraints.account) load::post(plane, *account++);
  for (std::size_t l = 0; l < model.loads.size(); ++l) load::post(model.loads[l], now.loads[l], *account++);
  return account;
}

/// Sees what contacts by multipliers have given and not taken back yet.
void update_deficits(const Model& model, State& now) {
  std::size_t source = model.blocks.size();
  const auto look = [&](const auto& contact, const auto& memory) {
    Flow& flow = now.ledger.flows[source];
    flow.deficit = contact::by_multipliers(contact) && created(now.ledger.accounts[source]) > 0 ? contact::deficit(memory) : 0;
    ++source;
  };
  for (std::size_t c = 0; c < model.contacts.size(); ++c) contact::with_memory(model.contacts[c], now.contacts[c], look);
  for (std::size_t p = 0; p < model.rigid_planes.size(); ++p) look(model.rigid_planes[p], now.rigid_planes[p]);
}

/// Lowers the step limits of penalties that have created or lost too much, for good. The works of this step must have been seen.
void lower_step_limits(const Model& model, State& now) {
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
  for (std::size_t c = 0; c < model.contacts.size(); ++c) {
    if (const contact::Interface* interface = contact::interface_of(model.contacts[c]))
      look(*interface, std::get<contact::Memory>(now.contacts[c]).step_factor);
    else ++source;
  }
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

}  // namespace

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

void begin_ledger(const Model& model, State& now) {
  Ledger& ledger = now.ledger;
  ledger.initial_kinetic = kinetic_energy(model, now);
  momenta(model, now, ledger.initial_momentum, ledger.initial_angular_momentum);
  const double of_centre = is_free(model) ? 0.5 * ledger.initial_momentum.squaredNorm() / total_mass(model) : 0;
  ledger.initial_available = ledger.initial_kinetic - of_centre;
}

void open_ledger(const Model& model, const Pace& pace, State& now) {
  now.ledger.size = size_of_scene(model, now.x);
  now.ledger.largest_force = total_mass(model) * model.gravity.norm();
  now.ledger.round_off = energy_of_round_off(model, now.x, next_length(now.step_limits, pace, now.t, 0));
  update_largest_force(model, now);
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

void update_reports(const Model& model, double dt, State& now) {
  for (std::size_t c = 0; c < model.contacts.size(); ++c)
    contact::with_memory(model.contacts[c], now.contacts[c],
                         [&](const auto& one, auto& memory) { contact::update_pair_records(one, dt, now.t, memory); });
  update_sections(model, dt, now);
}

void book(const Model& model, double dt, double first, const Ended& ended, State& now) {
  update_reports(model, dt, now);
  now.ledger.integration += dt * dt / 8 * (ended.square - first) + ended.rotation;
  now.ledger.integration_kept += ended.rotation;
  if (now.step > 0) now.ledger.integration_kept -= (dt * dt - now.dt * now.dt) / 8 * first;
  now.dt = dt;
  ++now.step;
  constexpr double of_twenty_steps = 0.95;
  now.step_limits.ringing = std::max(ended.square, of_twenty_steps * now.step_limits.ringing);
  post_sources(model, now);
  update_largest_force(model, now);
  update_deficits(model, now);
  update_flows(now.ledger);
  lower_step_limits(model, now);
}

void update_ledger(const Model& model, State& now) {
  Ledger& ledger = now.ledger;
  ledger.kinetic = kinetic_energy(model, now);
  momenta(model, now, ledger.momentum, ledger.angular_momentum);
  auto account = post_sources(model, now);
  if (model.relaxation) post_relaxation(now.relaxation, *account++);
  if (!model.gravity.isZero(0)) post_gravity(model, now, *account);
  ledger.external_work = std::max(ledger.external_work, work_from_loads(ledger));
  update_created(ledger);
}

}  // namespace nereid::dynamics
