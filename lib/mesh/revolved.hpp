#pragma once
// Bodies of revolution with steps: rectangles in a plane through the z axis, turned about it.

#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// A section of rectangles between lines r = radii[i] and z = heights[j], turned from the angle 0 on.
struct Revolved {
  std::vector<double> radii, heights;          ///< [m] ascending, at least two each; the first radius > 0
  std::vector<int> cells_radial, cells_along;  ///< between neighbouring lines
  std::vector<std::string> filled;             ///< from the top down, a letter for each interval of radii: x is material, . is not
  double angle;                                ///< [rad] a whole turn closes
  int cells_around;                            ///< each below half a turn
};

bool is_whole_turn(const Revolved&);

/// Whether two rectangles of material have a corner together and no side, so that the body would hinge there.
bool has_hinge(const Revolved&);

/// Number of hexahedra.
double count(const Revolved&);

/// Hexahedra, region `name`. Surfaces with node sets, normals outwards, of the faces on each line that has any:
///
///     name.out_I, name.in_I     on radii[I], facing away from the axis and towards it
///     name.up_J, name.down_J    on heights[J], facing up and down
///
/// and, unless the turn is whole, node sets `name.first_plane`, `name.second_plane` as of a Wedge. Nodes and elements are numbered layer by
/// layer along z, ray by ray within a layer. Nodes lie on circles, so of the volume there is the part sin(a) / a, a of one cell.
/// Needs  at least one rectangle of material, and no hinge
Mesh revolved(const std::string& name, const Revolved&);

}  // namespace nereid::mesh
