#pragma once
// Constraints: planes in whose normal direction nodes do not move, or move as prescribed; nodes that are driven.
//
// A plane constrains its nodes from the start (constrained components, symmetry planes) or from first touch on
// (the paper's floor). A node on several planes moves along what all of them allow. Constraints act
// on velocities by impulses, which are booked to the planes:
//
//     R = sum over planes of c_p n_p     of a node that a fixed or driven plane holds, all of R is that plane's
//
// So the shares do not depend on the direction of the axes. Of planes that constrain the same direction the first one has the impulse.

#include <array>
#include <string>
#include <vector>

#include "base/account.hpp"
#include "load/given.hpp"
#include "mesh/mesh.hpp"

namespace nereid::load {

enum class PlaneKind {
  constrained,  ///< velocity along the normal is zero, or as prescribed
  fixed,        ///< constrained in all directions, and plates do not rotate; the normal does not matter
  symmetry,     ///< constrained, and plates rotate only about the normal
  floor,        ///< free above the plane, constrained in the normal direction after first touch
  driven,       ///< velocity and angular velocity are prescribed in all directions; the normal does not matter
};

struct Plane {
  std::string name;
  PlaneKind kind = PlaneKind::constrained;
  Vec3 point = Vec3::Zero();    ///< [m] on the plane; of a floor only
  Vec3 normal = Vec3::UnitZ();  ///< unit vector; of a floor, to the side where the nodes are
  Subset nodes;                 ///< ascending
  /// [m/s] along the normal, of time [s]; of constrained nodes only. Empty: at rest.
  OverTime velocity = {};
  std::array<OverSpace, 3> field = {};             ///< [m/s] over reference position and time; of driven nodes, which need it
  std::array<OverSpace, 3> angular_velocity = {};  ///< [rad/s] the same, of plate nodes among them; empty: they do not rotate
};

/// What a plane gave to the nodes since the start.
struct PlaneAccount {
  Vec3 impulse = Vec3::Zero();          ///< [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s] about the origin
  double stopped = 0;                   ///< [J] kinetic energy of nodes that the plane stopped
  double driven = 0;                    ///< [J] work of a plane that moves, done on its nodes
};

/// The schema of a plane in the ledger, and its values now.
Source source(const Plane&);
void post(const PlaneAccount&, Account&);

/// Whether the plane prescribes velocities that are not zero.
inline bool moves(const Plane& plane) { return plane.velocity || plane.kind == PlaneKind::driven; }

/// A node with the planes that constrain it now. A fixed node, and a driven one, has three rows of one plane; these are the first rows.
struct ConstrainedNode {
  static constexpr int most_rows = 8;
  Index node = -1;
  int rotation = -1;                  ///< column of its angular velocity, or -1
  int count = 0;                      ///< rows
  bool moves = false;                 ///< one of the planes has a velocity
  bool rotation_constrained = false;  ///< one of the planes is fixed or drives
  int driver = -1;                    ///< plane that drives the node, or -1
  std::array<int, most_rows> plane{};
  std::array<Vec3, most_rows> normal;
  std::array<Vec3, most_rows> reaction;   ///< component of a reaction that belongs to each row
  std::array<double, most_rows> speed{};  ///< [m/s] of each row along its normal, set before each kick
  Vec3 angular_velocity = Vec3::Zero();   ///< [rad/s] of a driven node, set with the speeds
  Mat3 allowed = Mat3::Identity();        ///< projector onto the velocities all planes allow
  Mat3 allowed_rotation = Mat3::Identity(); ///< projector onto the angular velocities they allow
};

struct Constraints {
  std::vector<Plane> planes;
};

/// What constraints remember: which planes constrain which nodes, and the planes' accounts.
struct Memory {
  std::vector<ConstrainedNode> nodes;      ///< every node of every plane, ascending, also while free
  std::vector<Index> row_of_node;          ///< [nodes] row in `nodes`, or -1
  std::vector<PlaneAccount> account;       ///< beside Constraints::planes
  std::vector<std::vector<char>> stopped;  ///< [planes][nodes of the plane] whether a floor stops it
  std::vector<Index> active;               ///< rows in `nodes` of nodes that a plane constrains now
  std::vector<Index> impacting;            ///< rows in `nodes` of nodes about to be stopped; scratch
  std::vector<double> speed;               ///< [m/s] of each plane along its normal; scratch
};

/// Prepares the constraints; a floor's nodes are free until they touch it.
///
/// Throws InternalError if a node needs more than ConstrainedNode::most_rows rows (a fixed or driven one takes three).
Memory prepare(const Constraints&, Index nodes, const std::vector<Index>& rotation_of_node);

/// The memory of constraints that take the place of others, of the same planes with other nodes: planes keep their accounts, and floors the
/// nodes that they have stopped.
Memory in_place_of(const Memory& before, const Constraints&, Index nodes, const std::vector<Index>& rotation_of_node);

/// Adds `plane` to those that constrain this node.
void add_plane(const Constraints&, ConstrainedNode&, int plane);

/// Removes from v what the planes do not allow; the impulse goes to the planes' accounts.
///
/// x [m], v [m/s], mass [kg] of the node
void restrain(const Constraints&, const ConstrainedNode&, const Vec3& x, double mass, Vec3& v, std::vector<PlaneAccount>&);

/// Sets the speeds of moving planes and driven nodes to those at time t [s]; X [m] reference positions.
void set_speeds(const Constraints&, const Vectors& X, double t, Memory&);

/// The same for a node that planes move: along their normals it gets their speeds, and the work of the
/// impulses goes to the accounts.
///
///     W = 1/2 (before + after) . R  +  quarter_step force . (what changed along the normals)
///
/// before [m/s] the kick;  v after it, as the forces would have it;  force [N] of all sources
/// quarter_step  [s] a quarter of the step's length, negative in the first kick of a step
void drive(const Constraints&, const ConstrainedNode&, const Vec3& x, double mass, const Vec3& before, const Vec3& force,
           double quarter_step, Vec3& v, std::vector<PlaneAccount>&);

/// Like restrain for the angular velocity of a plate node; the impulse goes to the plane of the node's first row.
void restrain_rotation(const ConstrainedNode&, double inertia, Vec3& omega, std::vector<PlaneAccount>&);

/// Like drive for the angular velocity of a driven plate node, with the moment [N m] of all sources; impulse and work
/// go to the plane that drives it.
void drive_rotation(const ConstrainedNode&, double inertia, const Vec3& before, const Vec3& moment, double quarter_step, Vec3& omega,
                std::vector<PlaneAccount>&);

/// What a kick changed the velocities with, before the constraints act.
struct Kick {
  const Vectors& force;   ///< [N] [3 x nodes]
  const Vectors& moment;  ///< [N m] [3 x plate nodes]
  const Scalars& mass;    ///< [kg]
  const Scalars& inertia; ///< [kg m2]
  double dt;              ///< [s] force / mass dt was added
  double quarter_step;    ///< [s] a quarter of the step's length, negative in the first kick of a step
};

/// Constrains the velocities of all nodes after a kick: restrain, drive and their companions for every active node.
void constrain(const Constraints&, const Kick&, const Vectors& x, Vectors& v, Vectors& omega, Memory&);

/// Two planes of one node of which one moves it in a direction that the other constrains. Driven nodes are on no other plane but floors.
struct Conflict {
  int moving = -1, other = -1;  ///< places in Constraints::planes; -1: there is none
  Index node = -1;
};
Conflict find_conflict(const Constraints&);

/// The first node that needs more than ConstrainedNode::most_rows rows, or -1.
Index find_overconstrained(const Constraints&);

}  // namespace nereid::load
