#pragma once
// Contact without a penalty: in each step the smallest impulses after which no gap is negative at its end.
//
// An apex over a feature of its base is one condition on the relative normal velocity v = n . (v_apex - sum of w_I v_I) of the step to
// come, from t to t + dt', with the gap g at t and v_b the velocity of the step before:
//
//     v >= min(-g / dt', -v_b),   J >= 0,   one of both an equality
//
// so it never goes faster apart than it came, but for what energy it holds; of a penetration a fifth is corrected in a step. The impulses
// J n on the apex and -w_I J n on the base act at t, as forces J / h over the half steps around it, h = (dt + dt') / 2. They are
// found by iterations that do not depend on any order: docs/theory/multipliers.md.

#include <span>

#include "contact/data/any.hpp"
#include "contact/multiplier/condition.hpp"
#include "contact/multiplier/restitution.hpp"

namespace nereid::contact {

/// Whether any contact is by multipliers.
bool any_by_multipliers(std::span<const AnyContact>, std::span<const RigidPlane>);

/// Finds the impulses that stop, at the start, what would close gaps in the first step, and books them.
///
/// m        without forces, its `dt` zero
/// impulse  [N s] on the nodes, added to
void stop_at_start(std::span<const AnyContact>, std::span<const RigidPlane>, const Motion& m, double t, std::span<AnyMemory>,
                   std::span<PlaneMemory>, std::span<AnyWorkspace>, Multipliers&, Vectors& impulse);

/// Finds the impulses of all contacts by multipliers for the step to come, and books the work of the step that led to t.
///
/// Writes the forces into the memories, from where add_forces() takes them.
///
/// t        [s] now, for where the deepest penetrations were
/// energy, goes_on  as of limit_of_blows(); of an infinite energy blows ask for nothing
/// returns  what blows ask of the step to come. If that is shorter, and m not `again`, the step is to be made as short, and this to be
///          called again: nothing is booked and no force is written yet
BlowLimit enforce(std::span<const AnyContact>, std::span<const RigidPlane>, const Motion&, double t, std::span<AnyMemory>,
                  std::span<PlaneMemory>, std::span<AnyWorkspace>, double energy, bool goes_on, Multipliers&);

/// Takes into account that velocities change at t after enforce(), as relaxation changes them. The forces then do another work in the half
/// step that begins than was booked as energy held and as heat of friction:
///
///     next / 2  f . change of the relative velocity
///
/// change, spin  [m/s] [rad/s] of all velocities, and of those of plate nodes;  next  [s] length of the step to come
void change_work_to_come(std::span<const AnyContact>, std::span<const RigidPlane>, const Vectors& change, const Vectors& spin,
                         const std::vector<Index>& rotation_of_node, double next, std::span<AnyMemory>, std::span<PlaneMemory>);

}  // namespace nereid::contact
