#pragma once
// Mass, centre and inertia of a rigid body, exact for the shapes of its elements.

#include "mesh/mesh.hpp"

namespace nereid::rigid {

struct MassProperties {
  double mass = 0;              ///< [kg]
  Vec3 centre = Vec3::Zero();   ///< [m]
  Mat3 inertia = Mat3::Zero();  ///< [kg m2] about the centre
};

/// Moments of mass about a point, which add up over the parts of a body.
struct Moments {
  double mass = 0;             ///< [kg]
  Vec3 first = Vec3::Zero();   ///< [kg m]   sum of m r
  Mat3 second = Mat3::Zero();  ///< [kg m2]  sum of m r r^T
};

/// Adds the moments of trilinear hexahedra: 3 x 3 x 3 points of Gauss, exact for the products of two coordinates with the Jacobian, which
/// have the degree four in each natural coordinate.
///
/// nodes  [8 x elements], in the order of VTK;  density  [kg/m3];  about  [m]
void add_hexahedra(const Vectors& X, const Table<8>& nodes, double density, const Vec3& about, Moments&);

/// Adds the moments of flat plates, their thickness half on each side.
///
///     second  rho t A ((sum of r_a r_a^T + s s^T) / 12 + t^2/12 n n^T),   s = sum of r_a of the three nodes
///
/// nodes  [3 x elements];  thickness t  [m]
void add_plates(const Vectors& X, const Table<3>& nodes, double density, double thickness, const Vec3& about, Moments&);

/// Adds a point mass. [kg] [m]
void add_point(const Vec3& X, double mass, const Vec3& about, Moments&);

/// Mass, centre, and the inertia about the centre:  tr(S) 1 - S  with S = second - m d d^T, d from `about` to the centre.
MassProperties properties(const Moments&, const Vec3& about);

/// Whether an inertia can be that of a body: positive, and each principal moment at most the sum of the two others.
bool is_possible(const Mat3& inertia);

}  // namespace nereid::rigid
