#include "dynamics/ledger.hpp"

#include <algorithm>

namespace nereid::dynamics {

namespace {
double sum(const std::vector<Share>& shares) {
  double total = 0;
  for (const Share& share : shares) total += share.value;
  return total;
}
}  // namespace

double stored(const Account& a) { return sum(a.stored); }
double dissipated(const Account& a) { return sum(a.dissipated); }
double created(const Account& a) { return a.work + stored(a) + dissipated(a); }

double initial_stored(const Ledger& ledger) {
  double total = 0;
  for (const Account& a : ledger.accounts)
    for (const Share& share : a.stored) total += share.at_start;
  return total;
}

double work_from_outside(const Ledger& ledger) {
  double total = 0;
  for (const Account& a : ledger.accounts) {
    const auto outside = [](const Share& share) { return share.name == "outside"; };
    if (a.kind == "gravity" || std::any_of(a.stored.begin(), a.stored.end(), outside)) total += std::max(0.0, a.work);
  }
  return total;
}

double energy_scale(const Ledger& ledger) {
  return std::max({ledger.initial_kinetic, initial_stored(ledger), ledger.brought_in});
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
