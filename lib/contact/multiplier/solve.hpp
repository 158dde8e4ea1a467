#pragma once
// Finds the impulses that meet all conditions, by iteration.

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Makes the rows of all conditions and frictions, in the order of the contactors.
void make_rows(const Motion&, Multipliers&);

/// Moves what was given impulses. Ties that they act on follow.
void move_all(const Motion&, Multipliers&);

/// Adds the changes to all impulses, and moves what they act on.
void apply_changes(const Motion&, Multipliers&);

/// Sets the velocities of all nodes that the impulses lead to. Rigid bodies turn by an angle that is not small: rates go on from there.
///
/// returns  by how much any rate differs from that by movers, at most [m/s]
double find_velocities(const Motion&, Multipliers&);

/// Finds the impulses; returns the number of iterations.
int solve(const Motion&, Multipliers&);

}  // namespace nereid::contact
