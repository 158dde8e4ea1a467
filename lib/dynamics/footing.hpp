#pragma once
// On how many nodes the forces of contact act while they are largest: on few of them a peak of the force follows the mesh.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// The effective number of nodes of forces f:  (sum of |f|)^2 / sum of |f|^2;  zero of none. [-]
double effective_nodes(const std::vector<double>& sizes);

/// Keeps in State::footings on how many nodes contacts and rigid planes act while their force is larger than at any look before.
///
/// Of two bodies that press each other the one with fewer nodes counts, of several those with at least half the largest force. Nodes of
/// rigid bodies do not count.
void look_at_footings(const Model&, State&);

}  // namespace nereid::dynamics
