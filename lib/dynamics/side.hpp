#pragma once
// What a surface brings into a contact, and what two of them have together.

#include <vector>

#include "dynamics/connect.hpp"

namespace nereid::dynamics {

/// What a surface brings into a contact.
struct Side {
  double stiffness = 0;       ///< [Pa/m] surface_stiffness()
  double impedance = 0;       ///< [Pa s/m] surface_impedance()
  double depth = 0;           ///< [m] surface_depth()
  double half_thickness = 0;  ///< [m] of its plates
  bool is_rigid = false;
  bool turns = false;         ///< its nodes are those of plates
  bool thins = false;         ///< the thickness of its plates changes
};
Side side_of(const Model&, const mesh::Surface&);

/// Whether heights between two sides may be those of points: not of plates, whose faces bend by more than they are thick, nor of two rigid
/// bodies, which have no stress to share.
inline bool may_have_points(const Side& one, const Side& other) {
  return !(one.half_thickness > 0) && !(other.half_thickness > 0) && !(one.is_rigid && other.is_rigid);
}

/// What two surfaces have together. A penalty that is not given is `penalty_scale` times the stiffness of the softer side; a rigid body
/// gives way nowhere, and only between two of them its modulus counts.
///
/// Apexes that do not turn, as those of rigid plates, take no part of the arm of friction: the base has all of it.
///
/// share  [-] of the penalty: 1, or 1/2 in each of two passes
contact::Between between(const Side& apexes, const Side& base, const InterfaceOptions&, double share);

/// For each apex on a symmetry plane the directions the plane allows; empty without such planes.
std::vector<Mat3> allowed_directions(const Model&, const Subset& apexes);

/// The nodes of each symmetry plane.
std::vector<Subset> symmetry_planes(const Model&);

/// The stable step of the elements as they stand, without safety; of rigid bodies alone the longest of the model. [s]
double element_step(const Model&);

/// Whether one of the edges of a surface is a ridge or a rim.
bool has_ridges(const contact::Edges&, const Vectors& X);

}  // namespace nereid::dynamics
