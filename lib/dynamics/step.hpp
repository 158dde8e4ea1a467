#pragma once
// One step of central differences, in its two-kick form.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Starts a run: removes what the constraints do not allow, computes the first forces and opens the
/// ledger. Velocities must be set before. Returns the votes for the first step.
Votes start(const Model&, State&, Forces&);

/// Advances the state by dt.
///
/// Needs  `forces` as the step or the start before left them
/// returns  votes for the next step
Votes step(const Model&, double dt, State&, Forces&);

/// Brings the ledger's kinetic energy, momenta and accounts up to date; what a step itself keeps are
/// only the sums that cannot be had afterwards.
void settle(const Model&, State&);

}  // namespace nereid::dynamics
