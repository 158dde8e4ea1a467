#pragma once
// A rigid body: six degrees of freedom, and nodes that go with them.
//
//     x_i = X_i + u + (R - 1) A_i,      A_i = X_i - C
//
// with the displacement u of its centre C and its rotation R, so that it stays rigid to round-off. Momentum P and angular momentum L about
// the centre are in the axes of the scene: no force changes neither. A step of central differences is the kick by half of the forces, the
// drift, and the kick by the other half. In the drift L stays and R turns by the implicit midpoint rule of the equation of Euler,
//
//     S' = S + dt S_m x W,   S_m = (S + S')/2,   W = J^-1 S_m,   R' = R cay(dt W),       S = R^T L
//
// whose turn takes S to S', so L is exact; it keeps every quadratic invariant, so S . J^-1 S, twice the energy, is exact too, whatever the
// step (Simo & Wong, Int. J. Numer. Meth. Eng. 31 (1991) 19; Austin, Krishnaprasad & Wang, J. Comput. Phys. 107 (1993) 105). A step has
// three such parts, forth, back and forth, whose lengths make it of fourth order (Yoshida, Phys. Lett. A 150 (1990) 262).
// docs/theory/rigid.md

#include <optional>
#include <string>
#include <vector>

#include "mesh/round_body.hpp"
#include "rigid/mass.hpp"

namespace nereid::rigid {

/// What constraints leave to a body.
struct Hold {
  Mat3 shift = Mat3::Identity();  ///< projector onto the velocities of the centre that they allow
  int turns = 3;                  ///< 3: free to turn; 1: about `axis` through the centre; 0: not at all
  Vec3 axis = Vec3::UnitZ();      ///< unit vector
};

/// Constant in time.
struct Body {
  std::string name;
  MassProperties mass;  ///< in the reference
  Mat3 inverse;         ///< [1/(kg m2)] of the inertia
  Subset nodes;         ///< ascending
  Vectors arm;          ///< [m] [nodes] from the centre in the reference
  Hold hold;
  std::optional<mesh::RoundBody> round = std::nullopt;  ///< the shape as which it touches; nothing: with its facets
};
Body make_body(const std::string& name, const MassProperties&, const Vectors& X, const Subset& nodes);

/// A rotation as a quaternion of unit length.
struct Turn {
  double real = 1;
  Vec3 vector = Vec3::Zero();
};
Vec3 turned(const Turn&, const Vec3&);       ///< R a
Vec3 turned_back(const Turn&, const Vec3&);  ///< R^T a
/// (R - 1) a, to the last digit of the difference.
Vec3 change_by(const Turn&, const Vec3&);
Mat3 matrix(const Turn&);

struct State {
  Vec3 shift = Vec3::Zero();             ///< [m] displacement of the centre
  Turn turn;                             ///< from the reference
  Vec3 momentum = Vec3::Zero();          ///< [kg m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< [kg m2/s] about the centre
};

/// How a body goes on in a step: velocity of the centre, and the vector of Cayley of the turn over the step's length.
struct Twist {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]
};

/// R J R^T. [kg m2]
Mat3 inertia_now(const Body&, const State&);
/// What impulses do to the velocity of the centre [1/kg] and to the spin [1/(kg m2)], with what holds the body.
Mat3 response_of_shift(const Body&);
Mat3 response_of_spin(const Body&, const State&);

Vec3 centre(const Body&, const State&);           ///< [m]
Vec3 velocity(const Body&, const State&);         ///< [m/s] of the centre
Vec3 angular_velocity(const Body&, const State&); ///< [rad/s]
double kinetic_energy(const Body&, const State&); ///< [J]

/// Gives a body impulses, as far as what holds it allows. [N s] [N m s] about the centre
void kick(const Body&, const Vec3& impulse, const Vec3& angular_impulse, State&);
/// Gives it velocities whatever it had. [m/s] [rad/s]
void set_velocities(const Body&, const Vec3& velocity, const Vec3& spin, State&);

/// How a body with these momenta goes on in a step of dt [s].
Twist twist_of(const Body&, const State&, double dt);
/// Moves a body by a step; its momenta stay, but for what a fixed axis takes.
void drift(const Body&, const Twist&, double dt, State&);

/// Mean velocity over a step that begins at t of a point that is `arm` [m] from the centre at t.
///
///     V + (w x r + dt/2 w x (w x r)) / (1 + |dt w|^2/4):    dt times it is exactly the way of the point
Vec3 velocity_at(const Twist&, const Vec3& arm, double dt);

/// R' - R of a step from this rotation, to the last digit of the difference; with the formula above of every point.
Mat3 turn_in_step(const Twist&, const Turn& before, double dt);

/// Positions of the nodes. [m] [3 x nodes of the mesh]
void place_nodes(const Body&, const State&, const Vectors& X, Vectors& x);
/// Their velocities at this instant. [m/s]
void set_node_velocities(const Body&, const State&, Vectors& v);

/// The rigid motion that fits velocities of the nodes best, with equal weights, at a body that stands as in the reference: of the centre,
/// and the spin.
Twist fit(const Body&, const Vectors& v);

/// Shares of the mass at the nodes that have its sum and its centre: shares of a mesh, times a linear function of place. [kg] [nodes]
///
/// mass  [kg] of all nodes of the mesh, as its elements share it out
Scalars shares_of_mass(const Body&, const Scalars& mass);

/// The largest factor s with which masses m_i at nodes answer impulses no less than the body does: s times their mass matrix,
/// of rigid motions, is at most that of the body. What holds the body makes it answer less. [-]
double safe_share(const Body&, const Scalars& mass);

}  // namespace nereid::rigid
