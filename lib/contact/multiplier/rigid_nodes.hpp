#pragma once
// Nodes of rigid bodies in the iterations of multipliers.
//
// In the iteration a body is two movers (rows.hpp): its motion and its turn, whose velocities change by C times the impulses that its nodes
// get and their moments. Afterwards push() gives it these impulses, and its nodes exactly the velocities of the step to come. Responses and
// bounds are those of bodies: with g = (sum of w n, sum of w r x n) of a row and a body, and q^2 = g . C g,
//
//     A = sum over bodies of q^2,      |A_kl| <= q_k q_l:   a bound as of a node that all conditions share, docs/theory/multipliers.md

#include "contact/multiplier/condition.hpp"
#include "rigid/body.hpp"

namespace nereid::contact {

/// A rigid body in the step to come.
struct MovingBody {
  const rigid::Body* body = nullptr;
  Subset nodes;                  ///< on which contacts by multipliers act, ascending
  Vec3 centre = Vec3::Zero();    ///< [m] at t
  Mat3 shift, turn;              ///< [1/kg] [1/(kg m2)] what impulses do to its velocity and spin; zero if it is driven
  rigid::State state;            ///< at t, with the momenta that all impulses so far lead to
  double next = 0;               ///< [s] of the step to come, along which nodes go straight; 0: velocities are those of this instant
  rigid::Twist twist;            ///< what follows from them for that step
  bool driven = false;           ///< nothing changes its twist
};

struct RigidNodes {
  std::vector<MovingBody> bodies;  ///< beside those of the model
  std::vector<Index> of_node;      ///< [nodes of the mesh] the body, or -1
};

RigidNodes make_rigid_nodes(std::span<const AnyContact>, std::span<const RigidPlane>, std::span<const rigid::Body>,
                            const std::vector<Index>& of_node);

/// Begins a body in the step to come: what impulses do to it, and its twist.
///
/// state  at t, with the momenta that all forces but multipliers lead to;  next  [s] of the step, or 0 for velocities of this instant
void begin(const rigid::Body&, const rigid::State&, double next, MovingBody&);
/// The same of a body whose twist is prescribed.
void begin_driven(const rigid::Body&, const rigid::State&, const rigid::Twist&, double next, MovingBody&);

/// Sets the velocities of the nodes in the step to come, and where they will be.
void look_ahead(RigidNodes&, const Motion&, Multipliers&);

/// Gives a body an impulse [N s] and a moment of impulses about its centre [N m s], and its nodes the velocities that follow.
void push(MovingBody&, const Vec3& impulse, const Vec3& angular, const Motion&, Vectors& velocity);

/// What a condition's impulse does to its own rate. [1/kg]
double per_mass(const RigidNodes&, const Motion&, const ConditionList&, const Condition&);

/// The part of rigid bodies in what the friction b does to the slip rate along a. [m/s]
double product_of_bodies(const RigidNodes&, const FrictionShares& a, const FrictionShares& b, const Vectors& x);

/// Takes the nodes of rigid bodies out of Multipliers::shared.
void leave_out(const RigidNodes&, Multipliers&);
/// Adds to the bounds of the iteration what rigid bodies add. Those of friction are made anew. After make_rows().
void add_bounds(const RigidNodes&, const Motion&, Multipliers&);

}  // namespace nereid::contact
