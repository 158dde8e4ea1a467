#pragma once
// Rigid bodies of a scene: mass properties, what planes leave to them, and what they cannot do yet.

#include "model/build.hpp"

namespace nereid::model {

/// Makes the rigid bodies of a model that has its elements, planes and point masses, before it is finished.
void add_rigid_bodies(const Scene&, dynamics::Model&, Faults&);

/// Refuses what rigid bodies cannot do yet, of a model that has its loads and contacts.
void check_rigid_bodies(const Scene&, const dynamics::Model&, const dynamics::State&, Faults&);

}  // namespace nereid::model
