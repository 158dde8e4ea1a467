#pragma once
// Rigid bodies in a step: forces of nodes gathered, kicks and drift of bodies, their nodes set from them; docs/theory/rigid.md.
//
// All of this does nothing in a model without rigid bodies.

#include "dynamics/model.hpp"

namespace nereid::dynamics {

/// Takes the momenta of bodies from the velocities of their nodes, and gives these exactly what the bodies have.
void start_rigid_bodies(const Model&, State&);

/// Begins a sum of forces: gravity on the bodies, and nothing on their nodes.
void begin_rigid_forces(const Model&, Forces&);
/// Adds the forces on their nodes to those on the bodies, and takes them from the nodes.
void gather_rigid_forces(const Model&, Forces&);

/// Kicks all bodies by dt [s], and posts to planes what they hold of it.
///
/// t      [s] to which the new velocities belong
/// first  whether it is the first kick of a step
/// returns  sum of F.F/m + M.J^-1.M of what is free to move, the part of rigid bodies in the ledger's integration term [W/s]
double kick_rigid_bodies(const Model&, double dt, double t, bool first, State&, Forces&);

/// Moves bodies and nodes by a step; the velocities of the nodes are then those with which they went straight from their old places.
void drift_rigid_bodies(const Model&, double dt, State&, Forces&);
/// Puts the nodes of bodies where these are.
void place_rigid_nodes(const Model&, State&);

/// Ends a step: the work of forces at its end, and the velocities of nodes.
///
/// returns  what the kinetic energy grew by beyond the works of all forces and of planes that move, less dt^2/8 of the difference of the
///          kicks' sums: what rotation adds to the integration term. Of a driven body its plane takes that.  [J]
double finish_rigid_step(const Model&, double dt, State&, Forces&);

/// Tells multipliers how bodies go on, by the forces so far; null without bodies.
///
/// h     [s] for which the forces act from the middle of the step that led here; 0 at the start, where velocities are those of t
/// next  [s] of the step to come
contact::RigidNodes* predict_rigid_bodies(const Model&, double h, double next, const State&, Forces&);

/// Gives bodies impulses at their nodes. [N s]
void push_rigid_bodies(const Model&, const Vectors& impulse, State&);

/// The step at which a body turns by little, or the longest that the model allows. [s]
double rigid_step_limit(const Model&, const State&, std::size_t body);

double rigid_kinetic_energy(const Model&, const State&);                        ///< [J]
void add_rigid_momenta(const Model&, const State&, Vec3& linear, Vec3& angular);  ///< angular about the origin

}  // namespace nereid::dynamics
