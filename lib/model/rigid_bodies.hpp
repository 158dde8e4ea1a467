#pragma once
// Rigid bodies of a scene: mass properties, what planes leave to them, and what they cannot do yet.

#include "model/build.hpp"

namespace nereid::model {

/// Makes the rigid bodies of a model that has its elements, planes and point masses, before it is finished.
void add_rigid_bodies(const Scene&, dynamics::Model&, Faults&);

/// Sets what planes hold of the rigid bodies of a model, in Body::hold and Model::held_bodies.
void hold_rigid_bodies(const Scene&, const load::Constraints&, dynamics::Model&, Faults&);

/// Refuses to relax a model whose rigid bodies are not held: their velocities are not damped. `part` is what asks for it.
void refuse_to_relax_free_bodies(const Part&, const dynamics::Model&, Faults&);

/// Refuses planes that come to hold a rigid body in a later stage, but for those that hold or drive it in all directions: the body may have
/// turned by then.
void refuse_late_holds(const Scene&, const load::Constraints& before, const load::Constraints& after, const dynamics::Model&, Faults&);

/// Refuses velocities, those at all nodes, that are no motions of rigid bodies.
void refuse_no_rigid_motions(const std::vector<Initial>&, const dynamics::Model&, const Vectors& velocity, Faults&);

/// Refuses what rigid bodies cannot do yet, of a model that has its loads and contacts.
void check_rigid_bodies(const Scene&, const dynamics::Model&, const dynamics::State&, Faults&);

}  // namespace nereid::model
