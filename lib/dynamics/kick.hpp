#pragma once
// Kicks and drift of a step: what forces do to velocities, and velocities to positions.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// The first half of a step's kick: v at t becomes that at t + dt/2, within the constraints.
///
/// returns  sum of f.f/m over what the constraints let through and contact by multipliers does not book itself [W/s]
double kick_to_the_middle(const Model&, double dt, State&, Forces&);

/// Moves all nodes and rigid bodies by a step, with the velocities in its middle. The time is then that at its end.
void drift(const Model&, double dt, State&, Forces&);

/// What the second half of the kick leaves to the ledger.
struct Ended {
  double square = 0;    ///< [W/s] as kick_to_the_middle() returns it, at the end of the step
  double rotation = 0;  ///< [J] see finish_rigid_step()
};
/// The second half: v at t + dt/2 becomes that at t + dt.
Ended kick_to_the_end(const Model&, double dt, State&, Forces&);

/// Removes from the velocities what the constraints do not allow, and books the energy that this takes.
///
/// kinetic  [J] before
void constrain_velocities(const Model&, double kinetic, State&, Forces&);

}  // namespace nereid::dynamics
