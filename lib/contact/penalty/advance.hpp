#pragma once
// Contact by a penalty: springs between apexes and their bases, and the work of a step.

#include "base/step_limit.hpp"
#include "contact/data/workspace.hpp"

namespace nereid::contact {

/// Moves the apexes of an interface to the closest features at x, and computes their forces by the penalty.
///
/// v  [m/s] and omega [rad/s] (of plate nodes) constant over the step that led to x;  dt  [s], zero at the start
/// Work is posted by the trapezoid rule, with the forces found in the memory and the new ones.
void advance(const Interface&, const Vectors& x, const Vectors& v, const Vectors& omega, double dt, Memory&, Workspace&);

/// The largest step of an interface, and the apex that sets it: step_factor() / omega. With the impact step factor a bounce creates no more
/// energy than the interface's bound.
///
/// An apex and its base are a spring,  omega^2 = k (1/m_apex + sum of w_I S_I / (k m_I)),  where S_I
/// sums the stiffness of all springs at base node I: springs that share nodes add up. What never opens
/// (a tie, a stick) creates nothing at any stable step: dt = `linear_step` / omega, with the moments of
/// friction on plate nodes in omega.
///
/// Each of two passes has its `pass_factor` s of the stiffness between the same nodes and limits the step as if for all of it: omega^2 is
/// divided by it. With omega_1^2 <= s omega^2 and omega_2^2 <= (1 - s) omega^2 both together are within omega^2.
///
/// Closed elements limit the step, and those that may close in the next steps: nearer than a quarter of Interface::depth, or than twice
/// the path of the longest step. Where the spring of an open apex allows less than the last step, the step falls to 0.8 of that at a time
/// as long as the apex cannot close within two steps: a step that falls at once makes energy of what rings (docs/theory/contact_energy.md).
///
/// mass [kg] of the nodes;  inertia [kg m2] of the columns of omega;  last [s] step; 0: none, and open apexes limit it as closed ones
StepLimit stable_step(const Interface&, const Scalars& mass, const Scalars& inertia, const Memory&, Workspace&, double last = 0);

/// [-] dt omega of a spring that never opens. The linear bound is 2; a quarter of it lowers the bound of
/// the elements that share its nodes by 3 % at most, which the run's safety of 0.9 covers.
constexpr double linear_step = 0.5;

}  // namespace nereid::contact
