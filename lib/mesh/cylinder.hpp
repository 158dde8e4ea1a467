#pragma once
#include <string>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// How much of the revolution is meshed. `quarter` is x >= 0, y >= 0; `full` is the quarter and its
/// mirror images, node for node, so that both give the same answer to a symmetric question.
enum class Revolution { full, quarter };

/// A solid cylinder about the z axis, from z = 0 to z = length.
struct Cylinder {
  double radius, length;  ///< [m]
  Revolution turn;
  int cells_core;   ///< along the edge of the quarter's square core; 2 * cells_core around a quarter
  int cells_ring;   ///< radially from the core to the surface
  int cells_along;  ///< along z
};

/// An O-grid of hexahedra, region `name`: a square core with rounded edges within rings. Node sets
/// and surfaces `name.bottom`, `name.top`, `name.side`; node sets `name` (all) and, where turn is
/// quarter, `name.x_plane` (nodes with x = 0) and `name.y_plane` (nodes with y = 0), exactly on the
/// planes. Nodes and elements are numbered layer by layer along z, around the axis within a layer.
///
/// Facets are cut so that six meet at each node inside the side, as those of the tube around it do.
///
/// Invariants  scaled Jacobian of each element > 0.8 and edges of a section within a factor of two,
///             for cells_core = cells_ring; nodes of `full` are exact images of each other, with
///             elements and facets that have their first side reversed.
Mesh cylinder(const std::string& name, const Cylinder&);

/// A tube of plates about the z axis whose mid-surface lies at `radius`, its nodes at the same
/// angles and heights as those of the side of a cylinder with the same turn, cells_core and
/// cells_along.
struct Tube {
  double radius, length;  ///< [m]
  Revolution turn;
  int cells_core, cells_along;
};

/// Triangles, region `name`, each quadrilateral cut in two; cuts alternate around, so that six
/// triangles meet at each inner node, and those of the full tube are mirrored like its nodes. Normals
/// of the region point outwards and the first side of each triangle runs around, none is a cut.
/// Surfaces `name.inside` (normals towards the axis) and `name.outside`; node sets `name` (all),
/// `name.bottom`, `name.top` and, where turn is quarter, `name.x_plane`, `name.y_plane`.
Mesh tube(const std::string& name, const Tube&);

}  // namespace nereid::mesh
