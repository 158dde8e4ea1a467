#pragma once
// Coulomb's friction with an elastic stick, and where it acts on a base.

#include <array>
#include <cmath>
#include <span>

#include "base/types.hpp"

namespace nereid::contact {

/// Coulomb's friction: sticks up to the static coefficient times the normal force, then slides.
struct Coulomb {
  double coefficient = 0;         ///< [-] static; zero: frictionless
  double tangential_penalty = 1;  ///< [-] stiffness of the elastic stick over that of the penalty
  double kinetic = 0;             ///< [-] of fast sliding, where there is a decay
  double decay = 0;               ///< [s/m] of the difference of both with the speed; zero: the static coefficient always
};

/// The coefficient of friction at a speed of sliding [m/s], with the exponential decay of LS-DYNA and Abaqus.
///
///     kinetic + (static - kinetic) exp(-decay speed)
inline double coefficient_at(const Coulomb& friction, double speed) {
  if (friction.decay == 0) return friction.coefficient;
  return friction.kinetic + (friction.coefficient - friction.kinetic) * std::exp(-friction.decay * speed);
}

/// The elastic part of a slip and the part that slid.
struct Slip {
  Vec3 elastic;  ///< [m]
  Vec3 slid;     ///< [m]
};

/// Splits a slip into what the stick can hold and what has to slide: radial return.
///
///     elastic = trial min(1, limit / (stiffness |trial|)),   slid = trial - elastic
///
/// stiffness  [N/m] of the stick;  limit  [N] coefficient times the normal force, not negative
inline Slip stick_or_slide(const Vec3& trial, double stiffness, double limit) {
  const double force = stiffness * trial.norm();
  if (!(force > limit)) return {trial, Vec3::Zero()};
  const Vec3 elastic = (limit / force) * trial;
  return {elastic, trial - elastic};
}

/// A point of contact between an apex and the nodes of its base: none of a rigid plane, four of a face of a hexahedron. Where edges cross
/// there is no apex: the nodes are those of the base edge and then, with negative weights, those of the other edge.
///
/// Friction f acts on the apex and -f on the base at one point between them. Forces at nodes alone would
/// turn the pair by arm x f, so each side gets the moment of its part of the arm: plates as moments on
/// their nodes, solids as forces q x s_I r_I on the nodes around the foot that make that moment and no net force, and edges that cross as
/// forces (lift_I . f) n.
struct Touch {
  Vec3 normal = Vec3::UnitZ();     ///< unit vector from the base to the side of the apex
  Vec3 arm = Vec3::Zero();         ///< [m] from the foot to the apex
  Index apex = -1;                 ///< node; -1 where edges cross
  int nodes = 3;
  std::array<Index, 12> node{};     ///< those of the facet first; of a shape (shape.hpp) its four
  std::array<double, 12> weight{};  ///< of the foot; they sum to one, with those of an edge instead of an apex to zero
  std::array<Vec3, 8> lift{};      ///< [-] where edges cross; read where there is no apex
  Vec3 base_arm = Vec3::Zero();    ///< [m] part of the arm whose moment the base takes
  Vec3 apex_arm = Vec3::Zero();    ///< [m] part whose moment the apex takes, a plate
  bool base_rotates = false;       ///< the base is a plate, whose nodes have angular velocities
  std::array<Vec3, 12> offset{};   ///< [m] s_I r_I: r_I of a node from the mean, s_I its share of the moment that the base takes
  Mat3 per_inertia = Mat3::Zero(); ///< [1/m2] inverse of the sum of s_I (|r_I|^2 1 - r_I r_I^T)
};

/// Sets Touch::offset and per_inertia from the positions of the first nodes of the base and the shares that they have of its moment.
void measure_base(std::span<const Vec3> place, std::span<const double> share, Touch&);

/// The angular velocity that fits the velocities of the base best. [rad/s]
///
///     per_inertia . sum of offset_I x v_I;  exact for a rigid motion
Vec3 spin_of_base(const Touch&, const Vectors& v);

/// Velocity with which the apex slides on its base, in the plane across the normal. [m/s]
///
///     (1 - n n^T) (v_apex - w_apex x apex_arm - sum of weight_I v_I - spin x base_arm)
///
/// rotation_of_node  [nodes of the mesh] columns of omega, or -1; read where a side is a plate
/// Invariants    zero in a rigid motion of both sides, where the arm parts add up to the arm
Vec3 slip_rate(const Touch&, const Vectors& v, const Vectors& omega, const std::vector<Index>& rotation_of_node);

/// What a friction on the apex and what balances it are at the nodes: the apex, then those of the base.
struct FrictionShares {
  int count;
  std::array<Index, 13> node;
  std::array<Vec3, 13> force;  ///< [N]
  std::array<bool, 13> turns;  ///< whether there is a moment too
  std::array<Vec3, 13> moment; ///< [N m] of plate nodes
};
FrictionShares share_friction(const Touch&, const Vec3& friction);

/// Adds a friction force on the apex [N], and what balances it, to forces [N] and moments [N m].
///
/// Its power is friction . slip_rate() for every motion.
/// Invariants  no net force; no net moment where the arm parts add up to the arm.
void add_friction(const Touch&, const Vec3& friction, const std::vector<Index>& rotation_of_node, Vectors& force, Vectors& moment);

/// Moment about the origin of the same forces and moments on an apex and its base, at the positions `later` [s] after x. [N m]
Vec3 moment_of_friction(const Touch&, const Vec3& friction, const Vectors& x, const Vectors& v, double later);

/// A vector carried along with the base: turned by its rotation [rad], laid into the plane across the
/// new normal, its length kept.
Vec3 carried(const Vec3& vector, const Vec3& rotation, const Vec3& normal);

}  // namespace nereid::contact
