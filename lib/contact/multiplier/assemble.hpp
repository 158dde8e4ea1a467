#pragma once
// Finds the conditions of a step: which apexes and nodes may touch, over what, and how far they are.

#include "contact/data/workspace.hpp"
#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// What presses an apex if that goes on as in the last two steps; what does not press in both has no trend. [N]
inline double trend(const Near& near) {
  return near.pressed > 0 && near.earlier > 0 ? std::max(0.0, 2 * near.pressed - near.earlier) : near.pressed;
}

/// Finds the conditions of an interface or of a rigid plane, with the impulses of the step before as a first guess.
///
/// Needs  look_ahead() for its nodes
void find_conditions(const Interface&, const Motion&, Memory&, Workspace&, Multipliers&);
void find_conditions(const RigidPlane&, const Motion&, PlaneMemory&, Multipliers&);

}  // namespace nereid::contact
