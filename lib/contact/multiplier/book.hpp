#pragma once
// What the impulses of a step do: forces into the memories, works and momenta.

#include "contact/multiplier/condition.hpp"

namespace nereid::contact {

/// Books the first half of the step that led to t, in which the forces of the memory have acted.
void book_first_half(const Interface&, const Motion&, Memory&);

/// What friction takes in a step, and how much of that in the half that begins. [J]
struct FrictionLoss {
  double all = 0, to_come = 0;
};
FrictionLoss friction_loss(const Motion&, Index first, Index last, const Multipliers&);

/// What the impulses of some contactors do around t.
struct Doing {
  double work = 0;        ///< [J] in the half step that ends
  double to_come = 0;     ///< [J] of the normal impulses in the half step that begins
  double power_rate = 0;  ///< [W/s] force times acceleration
};
Doing doing(const Motion&, Index first, Index last, const Multipliers&);

/// Writes impulses into the memory of an interface as forces, and books them.
void take_over(const Interface&, const Motion&, double h, double t, Index first, Index last, const Doing&, Memory&,
               const Multipliers&);

/// The part of it that all kinds have: work, momentum, and what is held.
void take_over(const Motion&, const Vec3& force_before, Index first, Index last, const Doing&, SidesMemory&, const Multipliers&);

/// The same for a rigid plane.
void take_over(const RigidPlane&, const Motion&, double h, double t, Index first, Index last, const Doing&, PlaneMemory&,
               const Multipliers&);

}  // namespace nereid::contact
