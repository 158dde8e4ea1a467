#pragma once
// Constraints: planes in whose normal direction nodes do not move.
//
// A plane holds its nodes from the start (held components, symmetry planes) or from first touch on
// (the paper's floor). A node on several planes moves along what all of them allow. Constraints act
// on velocities by impulses, which are booked to the planes.

#include <array>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::load {

enum class PlaneKind {
  held,      ///< displacement along the normal is held
  symmetry,  ///< held, and plates turn only about the normal
  floor,     ///< free above the plane, held in the normal direction after first touch
};

struct Plane {
  std::string name;
  PlaneKind kind = PlaneKind::held;
  Vec3 point = Vec3::Zero();    ///< [m] on the plane; of a floor only
  Vec3 normal = Vec3::UnitZ();  ///< unit vector; of a floor, to the side where the nodes are
  Subset nodes;                 ///< ascending
};

/// What a plane gave to the nodes since the start.
struct PlaneAccount {
  Vec3 impulse = Vec3::Zero();          ///< [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< [N m s] about the origin
  double caught = 0;                    ///< [J] kinetic energy of nodes that the plane caught
};

/// A node with the planes that hold it now.
struct HeldNode {
  static constexpr int most_planes = 4;
  Index node = -1;
  int turn = -1;                        ///< column of its angular velocity, or -1
  int count = 0;
  std::array<int, most_planes> plane{};
  std::array<Vec3, most_planes> share;  ///< component of a reaction that belongs to each plane
  Mat3 allowed = Mat3::Identity();      ///< projector onto the velocities all planes allow
  Mat3 allowed_turn = Mat3::Identity(); ///< projector onto the angular velocities they allow
};

struct Constraints {
  std::vector<Plane> planes;
};

/// What constraints remember: which nodes hold where, and the planes' accounts.
struct Memory {
  std::vector<HeldNode> held;           ///< every node of every plane, ascending, also while free
  std::vector<Index> held_of_node;      ///< [nodes] place in `held`, or -1
  std::vector<PlaneAccount> account;    ///< beside Constraints::planes
  std::vector<std::vector<char>> caught;  ///< [planes][nodes of the plane] whether a floor holds it
  std::vector<Index> active;            ///< places in `held` of nodes that a plane holds now
  std::vector<Index> landing;           ///< places in `held` of nodes about to be caught; scratch
};

/// Prepares the constraints; a floor's nodes are free until they touch it.
///
/// Throws InternalError if a node lies on more than HeldNode::most_planes planes.
Memory prepare(const Constraints&, Index nodes, const std::vector<Index>& turn_of_node);

/// Lets `plane` hold this node from now on.
void hold(const Constraints&, HeldNode&, int plane);

/// Removes from v what the planes do not allow; the impulse goes to the planes' accounts.
///
/// x [m], v [m/s], mass [kg] of the node
void restrain(const Constraints&, const HeldNode&, const Vec3& x, double mass, Vec3& v, std::vector<PlaneAccount>&);

/// The same for the angular velocity of a plate node; the impulse goes to the node's first plane.
void restrain_turn(const HeldNode&, double inertia, Vec3& w, std::vector<PlaneAccount>&);

}  // namespace nereid::load
