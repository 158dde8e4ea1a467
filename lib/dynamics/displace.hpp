#pragma once
// An initial displacement: bodies that start deformed, with the stress that this takes.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Takes the bodies along a straight path from the reference positions to X + u, without inertia.
///
/// The elements are advanced in `steps` equal parts, so that stress and internal variables are those of a slow
/// deformation; normals of plates follow the material. What the elements store on the way is there at the start
/// of the run; work and dissipation count from the start.
///
/// u         [m] displacement, [3 x nodes]
/// gradient  [-] du/dX at the plate nodes, [plate nodes]
/// Needs     a state as initial_state leaves it
/// returns   where elements became smallest; a volume ratio that is not positive: one is inverted
element::BlockLimit displace(const Model&, State&, const Vectors& u, const std::vector<Mat3>& gradient, int steps = 100);

/// Angular velocities with which the normals of plates follow a velocity field, [3 x plate nodes] [rad/s].
///
///     n x dn/dt + (1/2 curl v . n) n,   dn/dt = -(1 - n n^T) L^T n
///
/// gradient  [1/s] L = dv/dX at the plate nodes;  n  normal in the reference
Vectors angular_velocities_of(const Model&, const std::vector<Mat3>& gradient);

}  // namespace nereid::dynamics
