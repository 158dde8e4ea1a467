#pragma once
// A round shape that goes with four nodes of a rigid body: the shape that the nodes of a mesh lie on.
//
// Places are affine functions of the positions of these four nodes, which span a tetrahedron, and so are velocities of a rigid motion. A
// point of the shape therefore needs no node: it is a sum of weights times four nodes, also for impulses, whose sum and moment are right.

#include <array>
#include <optional>

#include "geometry/round.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/mesh.hpp"
#include "mesh/revolved.hpp"
#include "mesh/sphere.hpp"

namespace nereid::mesh {

struct RoundBody {
  geometry::Round shape;
  std::array<Index, 4> anchor{};  ///< nodes
  Eigen::Vector4d at_centre;      ///< weights of the anchors at the centre; their sum is one
  Eigen::Matrix<double, 4, 3> along;  ///< [1/m] what a way along axis, across and axis x across adds to them; sums are zero
};

/// The shape that all nodes on the outside of a mesh lie on, where it was made; nothing of a part of one.
std::optional<geometry::Round> round_of(const Sphere&);
std::optional<geometry::Round> round_of(const Cylinder&);
/// thickness  [m] of the plates
std::optional<geometry::Round> round_of(const Tube&, double thickness);
/// Of one rectangle that is turned whole.
std::optional<geometry::Round> round_of(const Revolved&);
/// The centre of these shapes where meshes are made. [m]
Vec3 centre_of(const Sphere&);
Vec3 centre_of(const Cylinder&);
Vec3 centre_of(const Tube&);
Vec3 centre_of(const Revolved&);

/// Ties a shape to the nodes of a body: to four that are far apart. Needs nodes that are not all in a plane.
RoundBody tied(const geometry::Round&, const geometry::PlacedRound&, const Vectors& x, const Subset& nodes);

/// Where a shape stands. [m]
geometry::PlacedRound placed(const RoundBody&, const Vectors& x);

/// Weights of the anchors at a point of the body. [-]
Eigen::Vector4d weights_at(const RoundBody&, const geometry::PlacedRound&, const Vec3& point);

}  // namespace nereid::mesh
