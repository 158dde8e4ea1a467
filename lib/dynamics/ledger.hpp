#pragma once
// What a run owes an account of: energy by source, momentum and angular momentum.
//
// The schema is sources(model); the values are here, beside it. Each source posts its own, see base/account.hpp.

#include <vector>

#include "base/account.hpp"

namespace nereid::dynamics {

double stored(const Account&);      ///< [J] sum of the channels
double dissipated(const Account&);  ///< [J] sum of the channels
/// Work that the source can neither take from its store nor has dissipated: nobody can explain it.
double created(const Account&);     ///< [J] work + stored + dissipated

struct Ledger {
  double initial_kinetic = 0;  ///< [J]
  double kinetic = 0;          ///< [J] now
  /// [J] what the two half kicks of central differences add to the kinetic energy beyond the work of
  /// the trapezoid rule: the sum over steps of dt^2/8 (f'.f'/m - f.f/m).
  double integration = 0;
  /// [J] the most that came in from outside at any update of the ledger so far: the positive works of gravity and of
  /// the sources that take their work from outside (loads, planes and nodes that are moved).
  double external_work = 0;
  Vec3 initial_momentum = Vec3::Zero(), momentum = Vec3::Zero();                  ///< [kg m/s]
  Vec3 initial_angular_momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();  ///< [kg m2/s]
  std::vector<Account> accounts;  ///< beside sources(model)
};

/// What all stores held at the start together. [J]
double initial_stored(const Ledger&);

/// Work that gravity and all sources that take it from outside have done, those that took energy out left aside. [J]
double work_from_loads(const Ledger&);

/// What created energy is held against: the largest of the kinetic energy at the start, of what the stores held
/// then, and of the external work since. It never falls during a run. 0 while nothing has moved. [J]
double energy_scale(const Ledger&);

/// Energy that stands in no account: kinetic - initial - integration - sum of work; round-off. [J]
double energy_residual(const Ledger&);
/// Momentum that no impulse explains; round-off. [kg m/s]
Vec3 momentum_residual(const Ledger&);
/// Angular momentum that no impulse explains; round-off. [kg m2/s]
Vec3 angular_momentum_residual(const Ledger&);

}  // namespace nereid::dynamics
