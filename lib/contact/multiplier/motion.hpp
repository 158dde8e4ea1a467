#pragma once
// How nodes move in a step when no multiplier acts.

#include <vector>

#include "base/types.hpp"

namespace nereid::contact {

struct RigidNodes;

/// How nodes move when no multiplier acts, and how easily an impulse moves them.
struct Motion {
  const Vectors& x;        ///< [m] at t
  const Vectors& v;        ///< [m/s] over the step that led to t
  const Vectors& omega;    ///< [rad/s] of plate nodes, the same
  const Vectors& force;    ///< [N] of all else at t
  const Vectors& moment;   ///< [N m] on plate nodes
  const Scalars& mass;     ///< [kg]
  const Scalars& inertia;  ///< [kg m2] of plate nodes
  const std::vector<Index>& rotation_of_node;         ///< [nodes] column of the angular velocity, or -1
  const std::vector<const Mat3*>& allowed;            ///< [nodes] projector onto the velocities that constraints allow; null: all
  const std::vector<const Mat3*>& allowed_rotation;   ///< [plate nodes] the same of angular velocities
  double dt, next;         ///< [s] of the step that led to t, of that which begins there
  const Vectors* driven = nullptr;  ///< [m/s] for ties: what planes that move add to velocities by the step to come; else null
  RigidNodes* rigid = nullptr;      ///< rigid bodies in the step to come; null: there are none
  bool again = false;               ///< whether impulses have been found at t before, for a longer step to come
};

/// The share of an impulse at t that acts in the half step which begins there. [-]
inline double share_to_come(const Motion& m) { return m.next / (m.dt + m.next); }

/// The mean of a velocity over the half step that begins at t, `before` in the step that ends there and `after` in the next.
template <class Value>
Value mean_to_come(const Value& before, const Value& after, double share) {
  return after - 0.5 * share * (after - before);
}

}  // namespace nereid::contact
