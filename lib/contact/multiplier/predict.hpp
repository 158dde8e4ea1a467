#pragma once
// Where the nodes are after a step in which no multiplier acts.

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Sets what the nodes do in the step to come without multipliers.
void look_ahead(const Subset& nodes, const Motion&, Multipliers&);

/// Sets where nodes will be with these velocities.
void predict_positions(const Subset& nodes, const Motion&, Multipliers&);

}  // namespace nereid::contact
