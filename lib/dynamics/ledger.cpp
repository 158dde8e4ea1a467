#include "dynamics/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace nereid::dynamics {

double stored(const Account& account) {
  double sum = 0;
  for (std::size_t c = 0; c < words_of_stored.size(); ++c) sum += account.stored[static_cast<Stored>(c)];
  return sum;
}
double dissipated(const Account& account) {
  double sum = 0;
  for (std::size_t c = 0; c < words_of_dissipated.size(); ++c) sum += account.dissipated[static_cast<Dissipated>(c)];
  return sum;
}
double overdrawn(const Account& a) {
  double sum = 0;
  const auto held = [&a](Stored channel) { return a.stored[channel] + a.at_start[channel]; };
  for (const Stored channel : {Stored::elastic, Stored::hourglass, Stored::drilling}) sum += std::max(0.0, -held(channel));
  // one spring stores both, and their shares change with the thickness
  return sum + std::max(0.0, -(held(Stored::transverse_shear) + held(Stored::residual_bending)));
}
double created(const Account& a) { return a.work + stored(a) + dissipated(a) + overdrawn(a); }

double initial_stored(const Account& account) {
  double sum = 0;
  for (std::size_t c = 0; c < words_of_stored.size(); ++c) sum += account.at_start[static_cast<Stored>(c)];
  return sum;
}

double initial_stored(const Ledger& ledger) {
  double sum = 0;
  for (const Account& account : ledger.accounts) sum += initial_stored(account);
  return sum;
}

double work_from_loads(const Ledger& ledger) {
  double sum = 0;
  for (const Account& account : ledger.accounts)
    if (account.stored[Stored::external_work] != 0 || account.stored[Stored::potential] != 0) sum += std::max(0.0, account.work);
  return sum;
}

double energy_of_scene(const Ledger& ledger) {
  constexpr double least_available = 1e-6;  // of the kinetic energy: what a scene that only flies by is held against, well above round-off
  const double kinetic = std::max(ledger.initial_available, least_available * ledger.initial_kinetic);
  return std::max({kinetic, initial_stored(ledger), ledger.external_work});
}

double energy_floor(const Ledger& ledger) {
  constexpr double part = 1e-3;  // of the size of a body
  return std::max(part * ledger.size * ledger.largest_force, ledger.round_off);
}

double energy_scale(const Ledger& ledger) {
  const double scene = energy_of_scene(ledger);
  return scene > 0 || ledger.largest_force > 0 ? std::max(scene, energy_floor(ledger)) : 0;
}

double spurious_part(const Ledger& ledger, std::size_t source) {
  const Flow& flow = ledger.flows[source];
  const double scale = energy_scale(ledger);
  if (!(scale > 0 && flow.passed > least_share * scale)) return 0;
  const double excess = created(ledger.accounts[source]), waits = excess > 0 ? std::min(flow.deficit, least_share * scale) : 0;
  return std::copysign(std::max(0.0, std::abs(excess) - flow.recent - waits), excess) / std::max(flow.passed, least_flow * scale);
}

double steady_scale(const Ledger& ledger) {
  double outside = 0;
  for (const Account& account : ledger.accounts)
    if (account.stored[Stored::external_work] != 0) outside += std::max(0.0, account.work);
  return std::max({ledger.initial_available, initial_stored(ledger), outside});
}

double part_of_flow(const Ledger& ledger, std::size_t source, double energy, double scale) {
  const double passed = ledger.flows[source].passed;
  if (!(passed > least_share * scale)) return 0;
  return energy / (scale > 0 ? std::min(passed, scale) : passed);
}

double kept_part(const Ledger& ledger) {
  const double scale = energy_scale(ledger), kept = ledger.integration_kept, now = ledger.integration;
  if (!(scale > 0) || (kept > 0) != (now > 0)) return 0;
  return std::copysign(std::min(std::abs(kept), std::abs(now)), kept) / scale;
}

double swing_part(const Ledger& ledger) {
  const double scale = energy_scale(ledger);
  return scale > 0 ? ledger.most_integration / scale : 0;
}

void update_created(Ledger& ledger) {
  ledger.most_integration = std::max(ledger.most_integration, std::abs(ledger.integration));
  const double scale = energy_scale(ledger);
  if (!(scale > 0)) return;
  for (std::size_t a = 0; a < ledger.accounts.size(); ++a) {
    const double part = created(ledger.accounts[a]) / scale;
    double& worst = ledger.flows[a].worst_of_scene;
    if (std::abs(part) > std::abs(worst)) worst = part;
  }
}

void update_flows(Ledger& ledger) {
  // once a scene is judged, against what loads have done by now: between two rows that can be nearly all
  if (energy_scale(ledger) > 0) ledger.external_work = std::max(ledger.external_work, work_from_loads(ledger));
  const double kept = kept_part(ledger);
  if (std::abs(kept) > std::abs(ledger.worst_kept)) ledger.worst_kept = kept;
  for (std::size_t a = 0; a < ledger.accounts.size(); ++a) {
    Flow& flow = ledger.flows[a];
    const double step = std::abs(ledger.accounts[a].work - flow.work);
    flow.recent = std::max(step, flow.recent / 2);
    flow.passed += step;
    flow.work = ledger.accounts[a].work;
    const double part = spurious_part(ledger, a);
    if (std::abs(part) > std::abs(flow.worst)) flow.worst = part;
    if (!(std::abs(part) > std::abs(flow.told.part))) continue;
    const double energy = created(ledger.accounts[a]);
    if (std::abs(energy) > least_share * energy_scale(ledger)) flow.told = {part, energy, flow.passed};
  }
}

double energy_residual(const Ledger& ledger) {
  double explained = ledger.initial_kinetic + ledger.integration;
  for (const Account& a : ledger.accounts) explained += a.work;
  return ledger.kinetic - explained;
}

Vec3 momentum_residual(const Ledger& ledger) {
  Vec3 explained = ledger.initial_momentum;
  for (const Account& a : ledger.accounts) explained += a.impulse;
  return ledger.momentum - explained;
}

Vec3 angular_momentum_residual(const Ledger& ledger) {
  Vec3 explained = ledger.initial_angular_momentum;
  for (const Account& a : ledger.accounts) explained += a.angular_impulse;
  return ledger.angular_momentum - explained;
}

}  // namespace nereid::dynamics
