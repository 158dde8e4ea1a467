#pragma once
// What a run owes an account of: energy by source, momentum and angular momentum.

#include <string>
#include <vector>

#include "base/types.hpp"

namespace nereid::dynamics {

/// A named share of energy, such as "elastic" or "plastic". [J]
struct Share {
  std::string name;
  double value = 0;     ///< since the start
  double at_start = 0;  ///< what a store held then: an initial displacement, a spring that starts loaded
};

/// One source of force: what it did to the nodes and where that work came from or went.
struct Account {
  std::string name;               ///< of the block, interface, plane or floor
  /// "block", "interface", "rigid_plane", "floor", "symmetry", "held", "fixed", "driven", a load's kind, "relaxation", "gravity"
  std::string kind;
  double work = 0;                ///< [J] done on the nodes since the start
  /// [J] what the source holds now, less what it held at the start; "outside": where a load takes its work from
  std::vector<Share> stored;
  std::vector<Share> dissipated;  ///< [J] lost since the start
  double created_by_reconnection = 0;  ///< [J] the part of created() that fell in steps of a walk
  Vec3 impulse = Vec3::Zero();         ///< [N s] given to the nodes since the start
  Vec3 angular_impulse = Vec3::Zero(); ///< [N m s] about the origin
};

double stored(const Account&);      ///< [J] sum of the shares
double dissipated(const Account&);  ///< [J] sum of the shares
/// Work that the source can neither take from its store nor has dissipated: nobody can explain it.
double created(const Account&);     ///< [J] work + stored + dissipated

struct Ledger {
  double initial_kinetic = 0;  ///< [J]
  double kinetic = 0;          ///< [J] now
  /// [J] what the two half kicks of central differences add to the kinetic energy beyond the work of
  /// the trapezoid rule: the sum over steps of dt^2/8 (f'.f'/m - f.f/m).
  double integration = 0;
  /// [J] the most that came in from outside at any settled time so far: the positive works of gravity and of
  /// the sources with a store "outside" (loads, planes and nodes that are moved). settle() keeps it.
  double brought_in = 0;
  Vec3 initial_momentum = Vec3::Zero(), momentum = Vec3::Zero();                  ///< [kg m/s]
  Vec3 initial_angular_momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();  ///< [kg m2/s]
  std::vector<Account> accounts;
};

/// What all stores held at the start together. [J]
double initial_stored(const Ledger&);

/// Work that gravity and all sources with a store "outside" have done, those that took energy out left aside. [J]
double work_from_outside(const Ledger&);

/// What created energy is held against: the largest of the kinetic energy at the start, of what the stores held
/// then, and of what was brought in since. It never falls during a run. 0 while nothing has moved. [J]
double energy_scale(const Ledger&);

/// Energy that stands in no account: kinetic - initial - integration - sum of work; round-off. [J]
double energy_residual(const Ledger&);
/// Momentum that no impulse explains; round-off. [kg m/s]
Vec3 momentum_residual(const Ledger&);
/// Angular momentum that no impulse explains; round-off. [kg m2/s]
Vec3 angular_momentum_residual(const Ledger&);

}  // namespace nereid::dynamics
