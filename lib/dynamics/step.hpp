#pragma once
// One step of central differences, in its two-kick form.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Starts a run: removes what the constraints do not allow, computes the first forces and opens the
/// ledger. Velocities must be set before. Returns the limits of the first step.
const StepLimits& start(const Model&, const Pace&, State&, Forces&);

inline const StepLimits& start(const Model& model, State& now, Forces& forces) { return start(model, {}, now, forces); }

/// Goes on from a state that a run has left: sums the forces that the state remembers. The steps that follow
/// have the bits of a run that was never interrupted.
void resume(const Model&, const State&, Forces&);

/// Goes on in a model of which planes, loads or relaxation have changed, and with velocities that bodies are given: resume() follows.
///
/// Their energy and momenta count as initial ones; what planes that act now take from all velocities, these book. Loads have their new
/// forces at once.
/// velocity, spin  [m/s] [rad/s] added to nodes and plate nodes
void change(const Model&, const Vectors& velocity, const Vectors& spin, State&, Forces&);

/// Advances the state by dt.
///
/// pace  how long the step after this one will be: contact by multipliers keeps gaps from closing past zero in that step
/// Needs  `forces` as the step, the start or resume() before left them
/// returns  limits of the next step, which the state keeps
const StepLimits& step(const Model&, double dt, const Pace&, State&, Forces&);

/// The same where all steps are as long.
inline const StepLimits& step(const Model& model, double dt, State& now, Forces& forces) {
  return step(model, dt, {.fixed = dt}, now, forces);
}

}  // namespace nereid::dynamics
