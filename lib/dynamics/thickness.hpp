#pragma once
// Plates whose thickness follows their strain, as contacts and the audit see them: by node.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// By how much half the thickness of the plates at each node has grown since the start, a mean by mass; left empty where none changes.
void update_thickness(const Model&, const State&, Forces&);

}  // namespace nereid::dynamics
