#pragma once
// Sectors of round bodies about the z axis: all angles around from 0 to `angle`, down to one element wide.

#include <string>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// A sector of a solid cylinder, or of a thick ring where inner_radius > 0, from z = 0 to z = length.
struct Wedge {
  double radius, length;  ///< [m]
  double angle;           ///< [rad] between 0 and a whole turn, less than half a turn for each cell around
  int cells_around, cells_radial, cells_along;
  double inner_radius = 0;  ///< [m]
};

/// A sector of a tube of plates whose mid-surface lies at `radius`.
struct WedgeTube {
  double radius, length;  ///< [m]
  double angle;           ///< [rad] as of Wedge
  int cells_around, cells_along;
};

/// Outward unit normals of the planes of a sector: of the first, y = 0, and of the second, at `angle`.
Vec3 first_plane_normal();
Vec3 second_plane_normal(double angle);

/// Hexahedra, region `name`, in even rings. Surfaces with node sets `name.bottom`, `name.top`, `name.side`
/// and, in a ring, `name.inside`; node sets `name` (all), `name.first_plane`, `name.second_plane` and, where
/// there is no hole, `name.axis`, whose nodes lie on both planes. Nodes and elements are numbered layer by layer
/// along z, ray by ray within a layer.
///
/// At the axis an edge of each hexahedron has no length: its nodes 0 and 3 are one, and so are 4 and 7. The
/// one-point element takes such a wedge as it is, with its exact volume.
///
/// Nodes lie on the circle and edges between them are chords, so of the sector's volume there is the part
///     sin(a) / a,   a = angle / cells_around
///
/// Invariants  the nodes of a one-wide sector all lie on its planes; facets are cut the same way along z and
///             along the radius, alternately around.
Mesh wedge(const std::string& name, const Wedge&);

/// Triangles, region `name`, as those of `tube`: surfaces `name.outside` and `name.inside`, node sets `name`,
/// `name.bottom`, `name.top`, `name.first_plane`, `name.second_plane`. Its area is 2 sin(a/2) / a of the true one.
Mesh wedge_tube(const std::string& name, const WedgeTube&);

}  // namespace nereid::mesh
