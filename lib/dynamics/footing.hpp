#pragma once
// On how many nodes the forces of contact act while they are largest: on few of them a peak of the force follows the mesh.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// The effective number of nodes of forces f:  (sum of |f|)^2 / sum of |f|^2;  zero of none. [-]
double effective_nodes(const std::vector<double>& sizes);

/// Notes on how many nodes contacts and rigid planes act where their force is larger than at any look before; where the ledger is current.
///
/// Of two bodies that press each other those with fewer nodes count, of several the ones with at least half the largest force; rigid ones
/// do not.
void look_at_footings(const Model&, State&);

}  // namespace nereid::dynamics
