#pragma once
// Contact by multipliers in a step.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Stops what begins in contact; what constraints hold of the impulses goes to their accounts.
void stop_at_start(const Model&, const Pace&, State&, Forces&);

/// Finds the forces of contacts that act by multipliers, which need all others, and adds them.
///
/// dt  [s] of the step that led here, zero at the start
void enforce(const Model&, double dt, const Pace&, State&, Forces&);

}  // namespace nereid::dynamics
