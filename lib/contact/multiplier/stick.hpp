#pragma once
// Friction as conditions: it sticks as far as it can.

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Adds the friction of a contactor, with the force of the step before as a first guess. Where constraints hold or drive all nodes along
/// the plane, no impulse changes the slip rate; it grows to what the normal impulse allows, and they take it.
///
/// stuck    in the step before: what iterations have left of its slip rate is no sliding
/// returns  its place in the list
Index add_friction(const Touch&, const Coulomb&, const Vec3& force, bool stuck, const Motion&, std::vector<FrictionCondition>&);

/// Lets sticks yield against their forces, so that friction takes back its deficit [J].
void let_yield(double deficit, double depth, const Motion&, std::size_t first, Multipliers&);

/// Sets the change with which a friction of some slip rate sticks, or slides where it would take more than its coefficient times the normal
/// impulse [N s].
void find_change(double pressed, const Vec3& rate, FrictionCondition&);

/// Sets the change of each friction, and zero for all conditions, as a release has changed what presses: what the iterations before it have
/// left is left again, so that a release of nothing changes nothing.
void follow_release(Multipliers&);

/// Ends the friction of an apex or of a crossing of edges.
void end_friction(Seldom<FrictionForces>&);

/// Friction of an apex or of a crossing of edges over the step h [s], from what the iterations have found for its contactor.
void book_friction(const Contactor&, bool closed, double h, const Multipliers&, Seldom<FrictionForces>&);

}  // namespace nereid::contact
