#pragma once
// The forces of a step: all but those of contact by multipliers, which need all others.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Brings every source of force to the new positions: memory, forces by source, limits of the next step.
///
/// pace  how long the step after this one will be
void update(const Model&, double dt, const Pace&, State&, Forces&);

/// Adds the forces of contacts that act by multipliers, or of those that do not.
void add_contact_forces(const Model&, const State&, bool by_multipliers, Forces&);

/// Forces on the nodes, summed over sources in a fixed order; without contact by multipliers.
void gather(const Model&, const State&, Forces&);

}  // namespace nereid::dynamics
