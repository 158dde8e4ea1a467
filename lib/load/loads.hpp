#pragma once
// Loads: forces that come from outside or from springs, as functions of position and time.
//
// A load computes forces on its own nodes and books what they do: work by the trapezoid rule over the
// step that led here, impulse and angular impulse. It knows no time loop. See docs/theory/loads.md.

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "base/account.hpp"
#include "load/given.hpp"
#include "mesh/mesh.hpp"

namespace nereid::load {

/// Force per mass on a body, f = m a(X, t).
struct BodyForce {
  std::string name;
  Subset nodes;
  Scalars mass;                             ///< [kg] of the body at each node, [nodes]
  std::array<OverSpace, 3> acceleration;    ///< [m/s2]
};

/// Pressure on a surface that follows it. Positive pressure presses against the outward normal.
///
///     facet  f_I = -p A n / 3,      face of a hexahedron  f_I = -p (A n + T_I n_I) / 6
///
/// with current areas and normals, T_I of the triangle at the corner. On hexahedra that is -p times the gradient
/// of the enclosed volume, so a uniform pressure meets a uniform stress without remainder.
struct Pressure {
  std::string name;
  Subset nodes;      ///< of the surface, ascending
  Table<4> corners;  ///< [4 x faces] places in `nodes`; the fourth is -1 on a facet of its own
  OverTime pressure; ///< [Pa]
};

/// Pressure on a surface, of a bubble that grows as the surface gives way.
///
/// The volume of the bubble is that of the start and what the surface has swept since, by the trapezoid rule over the steps. Forces are
/// those of a Pressure.
struct Bubble {
  std::string name;
  Subset nodes;       ///< of the surface, ascending
  Table<4> corners;   ///< as of a Pressure
  OverTime pressure;  ///< [Pa] over the volume [m3]
  double volume;      ///< [m3] at the start
};

/// A surface beyond which a fluid or solid goes on: waves leave through it, and one may come in.
///
/// The pressure on it is  p + 2 p_in + Z v_n,  v_n the velocity along the outward normal and Z = density c. A plane wave along the normal
/// leaves without a reflection; one at an angle a reflects the part  (1 - cos a)/(1 + cos a). The dashpots take what leaves; p and 2 p_in
/// are loads.
struct Radiation {
  std::string name;
  Subset nodes;       ///< of the surface, ascending
  Table<4> corners;   ///< as of a Pressure
  OverTime pressure;  ///< [Pa] at rest
  OverTime incident;  ///< [Pa] of the wave that comes in, p_in
  double impedance;   ///< [kg/(m2 s)] Z
};

/// A force shared equally among nodes.
struct NodalForce {
  std::string name;
  Subset nodes;
  std::array<OverTime, 3> force;  ///< [N] on all nodes together
};

/// A moment shared equally among plate nodes.
struct NodalMoment {
  std::string name;
  Subset nodes;
  Subset rotations;                ///< [nodes] columns of their angular velocities
  std::array<OverTime, 3> moment;  ///< [N m] on all nodes together
};

/// A moment on nodes that do not turn one by one, as those of a rigid body: forces that have it, and no resultant.
///
///     f_I = (T^-1 M) x r_I,   T = sum of |r_I|^2 1 - r_I r_I^T,   r_I from the mean of the nodes
struct Couple {
  std::string name;
  Subset nodes;                    ///< not on one line
  std::array<OverTime, 3> moment;  ///< [N m]
};

/// A spring with a dashpot along the line between two nodes, or between a node and a fixed point.
///
/// Tension k (l - l0) + c dl/dt with the length's rate in the step that led here. To a fixed point
/// with l0 = 0 the force is -k u - c v, whichever way the node moves.
struct Spring {
  std::string name;
  Index from = -1, to = -1;      ///< nodes; no `to`: the other end is `ground`
  Vec3 ground = Vec3::Zero();    ///< [m]
  double stiffness = 0;          ///< [N/m]
  double damping = 0;            ///< [N s/m]
  double length = 0;             ///< [m] without force
};

/// Every load that exists.
using AnyLoad = std::variant<BodyForce, Pressure, NodalForce, NodalMoment, Couple, Spring, Radiation, Bubble>;

/// Mass that belongs to no element, shared equally among nodes.
struct PointMass {
  std::string name;
  Subset nodes;
  double mass = 0;  ///< [kg] of all nodes together
};

/// What a load remembers.
struct LoadMemory {
  Vectors force;                        ///< [N] now, [3 x nodes of the load]; of a spring at its two ends
  Vectors moment;                       ///< [N m] now, [3 x nodes of the load]; of a NodalMoment only
  double work = 0;                      ///< [J] done on the nodes
  Vectors drag;                         ///< [N] the part of `force` that dashpots exert; of Radiation only
  double swept = 0;                     ///< [m3] by which a Bubble has grown
  double stored = 0, dissipated = 0;    ///< [J] of a spring: 1/2 k (l - l0)^2 now; by its dashpot so far. Of Radiation: what left
  Vec3 impulse = Vec3::Zero();          ///< [N s] given to the nodes
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s] about the origin
};

/// Builders; the nodes of a pressure are those of its surface.
Pressure pressure_on(const std::string& name, const mesh::Mesh&, const mesh::Surface&, OverTime);
Bubble bubble_under(const std::string& name, const mesh::Mesh&, const mesh::Surface&, OverTime pressure, double volume);
Radiation radiation_from(const std::string& name, const mesh::Mesh&, const mesh::Surface&, OverTime pressure, OverTime incident,
                         double impedance);
/// Without a length the spring starts without force. Throws InternalError for a node that is not in X.
Spring spring_between(const std::string& name, const Vectors& X, Index from, Index to, double stiffness, double damping,
                      const double* length = nullptr);
Spring spring_to_point(const std::string& name, const Vectors& X, Index from, const Vec3& ground, double stiffness,
                       double damping, const double* length = nullptr);

/// The same load with its time counted from `start` [s]; where it is off, without a force. Springs stay as they are.
AnyLoad in_stage(const AnyLoad&, bool is_on, double start);

const std::string& name(const AnyLoad&);
/// The schema of a load in the ledger, and its values now. What a load does, it takes from outside; a spring stores it.
Source source(const AnyLoad&);
void post(const AnyLoad&, const LoadMemory&, Account&);
bool is_spring(const AnyLoad&);
LoadMemory initial_memory(const AnyLoad&);

/// Forces at x and t; work and impulses are posted by the trapezoid rule over the step v dt, omega dt that
/// led to x, half with the forces found in the memory.
///
/// X reference positions, x [m];  v [m/s], omega [rad/s] of the step;  t [s] now;  dt [s], zero at the start
void advance(const AnyLoad&, const Vectors& X, const Vectors& x, const Vectors& v, const Vectors& omega, double t, double dt,
             LoadMemory&);
void add_forces(const AnyLoad&, const LoadMemory&, Vectors& force, Vectors& moment);

/// The sum of the load's forces on the nodes. [N]
Vec3 resultant(const LoadMemory&);
/// The sum of the load's moments on the nodes, without those of its forces. [N m]
Vec3 resultant_moment(const LoadMemory&);
/// How much is applied, whatever the directions: the sum of the magnitudes of the nodes' forces, moments over a length. [N]
double applied(const LoadMemory&, double length);

/// How hard springs and dashpots pull on the masses of their nodes: bounds over all of them together.
struct SpringRates {
  double omega_squared = 0;  ///< [1/s2] of K relative to M: largest of K1/m1 + K2/m2
  double damping = 0;        ///< [1/s] of C relative to 2 M: largest of (C1/m1 + C2/m2)/2
  int stiffest = -1;         ///< place among the loads, or -1
};

/// K1, K2 (C1, C2) are sums over all springs (dashpots) at the two nodes of a spring.
///
/// X  [m] for the areas of surfaces that radiate
SpringRates spring_rates(const std::vector<AnyLoad>&, const Vectors& X, const Scalars& mass);

/// The step y at which elements with the bound `step` and springs are stable together,
///
///     y/step + y damping + y^2 omega^2/4 = 1.
double step_with_springs(double step, const SpringRates&);

}  // namespace nereid::load
