#pragma once
// Dynamic relaxation: a run that is damped until it stands still finds the static equilibrium.
//
// Between two steps velocities are scaled by exp(-2 omega dt), critical for a mode of frequency omega,
// a Rayleigh quotient of what has moved lately (after Underwood 1983). The kinetic energy that this
// takes is booked. See docs/theory/loads.md.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Begins to look for an equilibrium from a state that has moved: forgets all samples and takes the state as reference of the frequency.
void begin_relaxation(const Model&, State&, Forces&);

/// Damps the state after a step and samples its balance every tenth step.
///
///     omega^2 = sum df . df / m / (- sum dx . df)             over the last 1/omega, plates' turns too
///     residual = |sum of all forces| / |forces by source|,    |f|^2 = sum f.f/m + sum M.M/I
///
/// df leaves out loads that are functions of time. The sum of all forces is taken in the directions that planes allow; the forces by source
/// are those of each block, of each load and of gravity, the largest sample so far.
///
/// next     [s] length of the step to come
/// returns  whether the last `samples` samples were balanced and the kinetic energy of displacements is below
///          residual times its largest sample
bool relax(const Model&, double next, State&, Forces&);

}  // namespace nereid::dynamics
