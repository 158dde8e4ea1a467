#pragma once
// Energy and momenta of a model, and what each source of force has in the ledger.

#include "dynamics/kick.hpp"

namespace nereid::dynamics {

double kinetic_energy(const Model&, const State&);                         ///< [J]
void momenta(const Model&, const State&, Vec3& linear, Vec3& angular);  ///< angular about the origin

/// Opens the ledger: energy and momenta at the start, before constraints act.
void begin_ledger(const Model&, State&);
/// What the stores hold now counts as held at the start. The forces of the start must be known, but for those by multipliers.
void open_ledger(const Model&, const Pace&, State&);

/// Books a step: what touched, what sections transmit, and the sums that cannot be had afterwards.
///
/// first  [W/s] of kick_to_the_middle()
void book(const Model&, double dt, double first, const Ended&, State&);

/// Brings the ledger up to date: kinetic energy, momenta, and what each source posts. A step itself keeps only the
/// sums that cannot be had afterwards.
void update_ledger(const Model&, State&);

/// Which sides have touched, and what sections transmit, at the end of a step of dt [s].
void update_reports(const Model&, double dt, State&);

}  // namespace nereid::dynamics
