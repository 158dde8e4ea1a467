#pragma once
// A rigid plane that nodes cannot pass and may leave again: by multipliers (the default) or by a unilateral penalty.

#include <string>
#include <vector>

#include "base/account.hpp"
#include "base/step_limit.hpp"
#include "contact/data/friction.hpp"
#include "contact/data/method.hpp"
#include "contact/data/shape.hpp"
#include "contact/data/step_factor.hpp"
#include "mesh/mesh.hpp"

namespace nereid::contact {

struct RigidPlane {
  std::string name;
  Vec3 point, normal;  ///< [m] on the plane, unit vector to the side of the nodes
  Subset nodes;                        ///< none of bodies that touch it as shapes
  Scalars area;                        ///< [m2] tributary area, [nodes]
  mesh::FacesAround faces;             ///< [nodes] what the tributary area lies on; may be empty
  std::vector<mesh::RoundBody> rounds; ///< of these, by multipliers
  double round_area = 0;               ///< [m2] that a point of one stands for, against others
  Method method = Method::penalty;
  double restitution = 1;              ///< [-] speed of a node released by a multiplier over that with which it was stopped
  double impedance = 0;                ///< [Pa s/m] rho c of what is behind the nodes
  double penalty = 0;                  ///< [Pa/m]
  double impact_step_factor = 0.1410;  ///< [-] dt sqrt(k/m) of the step limit, see contact/penalty/impact_step.hpp
  double first_step_factor = 0;        ///< [-] the same until the plane has created too much, where it is larger
  Coulomb friction;
  double depth = 0;    ///< [m] of the flattest element behind the nodes: what a penetration is held against
};

struct PlaneMemory {
  std::vector<ShapePoint> shape_points; ///< of RigidPlane::rounds, one after the other
  std::vector<double> force;            ///< [N] along the normal, [nodes]
  std::vector<Restitution> restitution; ///< [nodes] of multipliers; else empty
  std::vector<double> next_force;       ///< [N] by multipliers, [nodes]: what advance() takes; empty of a penalty
  /// [m2] [nodes] by multipliers, of the sides of a node that faced the plane as it came into contact; zero: the node has no condition
  std::vector<double> area;
  std::vector<Vec3> friction, next_friction;      ///< [N] friction by multipliers, the same
  std::vector<char> stuck;              ///< whether it held them in the last step, the same
  std::vector<Vec3> slip;               ///< [m] elastic part of the slip, [nodes]; empty without friction
  std::vector<double> sliding;          ///< [m/s] how fast they slid in the last step, the same
  double work = 0, stored = 0;          ///< [J] stored by the penalty, or held by multipliers with their work still to come
  double friction_to_come = 0;          ///< [J] part of what friction takes by multipliers, in the half step that begins
  double friction_deficit = 0;             ///< [J] that friction gave, as a stick sways, and has not taken back: created until then
  double tangential_stored = 0, friction_dissipated = 0;  ///< [J] stored by the elastic stick, dissipated by friction
  double transferred = 0;               ///< [J] of what multipliers have taken here, that other contacts hold
  double impact = 0;                    ///< [J] kinetic energy lost as multipliers stopped nodes
  double power_rate = 0;                ///< [W/s] force times acceleration of multipliers, see Memory
  StepFactorMemory step_factor;
  double deepest = 0;                   ///< [m] penetration of any node since the start, not negative
  Index deepest_node = -1;              ///< where that was, -1 before any contact
  double deepest_time = 0;              ///< [s] when; set by the caller of advance()
  Vec3 impulse = Vec3::Zero();          ///< [N s] given to the nodes
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s] about the origin
};

PlaneMemory initial_memory(const RigidPlane&);

/// Forces at x, with the gap g = (x - point) . n and the force -penalty area g for g < 0; work and
/// impulses are posted by the trapezoid rule over the step v dt that led to x. Friction acts at the nodes.
void advance(const RigidPlane&, const Vectors& x, const Vectors& v, double dt, PlaneMemory&);
void add_forces(const RigidPlane&, const PlaneMemory&, Vectors& force);
/// Sum of the forces on all nodes, with friction. [N]
Vec3 force(const RigidPlane&, const PlaneMemory&);

/// The largest step of a plane, and the node that sets it: step_factor() / omega.
StepLimit stable_step(const RigidPlane&, const Scalars& mass, const StepFactorMemory&);

/// The schema of a plane in the ledger, and its values now.
Source source(const RigidPlane&);
void post(const RigidPlane&, const PlaneMemory&, Account&);

}  // namespace nereid::contact
