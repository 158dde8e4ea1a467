#pragma once
// How the generators collect quadrilaterals, cut in two.

#include <array>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

using Quadrilateral = std::array<Index, 4>;  ///< counter-clockwise seen from outside

/// Which corners the cut joins.
enum class Cut { first_to_third, second_to_fourth };

/// The cut of a face of a cell around an axis: alternately from cell to cell, the same along the axis and the radius, so that six triangles
/// meet at each node inside a surface and lumped masses are even. With an even number of cells around it runs on across mirror planes.
///
/// around  number of the cell, from 0
inline Cut cut_at_cell(int around) { return around % 2 == 0 ? Cut::first_to_third : Cut::second_to_fourth; }

/// How to cut a face of a hexahedron: by its shape and place alone, whatever the numbers of its nodes.
///
///     d1, d2  the diagonals,  m  the middle of the face,  n_k  fixed directions
///     a cut whose halves face away from each other is none;  else the shorter diagonal;
///     of equal ones that with the larger |d . (m - middle)|;  of equal ones that with the larger |d . n_k|
///
/// X       [m] positions
/// middle  [m] of the body; the cuts of a regular face run outwards from it
/// Lengths and parts that differ by less than 1e-4 are equal, so that round-off, also that of single precision, decides nothing.
/// Invariants  moved, turned, mirrored and scaled bodies are cut alike, but for faces that only n_k can tell
Cut cut_of_face(const Vectors& X, const Quadrilateral&, const Vec3& middle);

/// Triangles in the making. Of both halves of a quadrilateral the first side is a side of the
/// quadrilateral (0-1 and 2-3), never the cut, so that frames along it are aligned with the mesh.
class Facets {
 public:
  void add(const Quadrilateral& corner, Cut cut) {
    const bool third = cut == Cut::first_to_third;
    triangles_.push_back({corner[0], corner[1], third ? corner[2] : corner[3]});
    triangles_.push_back({corner[2], corner[3], third ? corner[0] : corner[1]});
  }

  /// A face of a hexahedron of a body with that middle.
  void add(const Vectors& X, const Quadrilateral& corner, const Vec3& middle) { add(corner, cut_of_face(X, corner, middle)); }

  /// A facet that was never a quadrilateral.
  void add(Index first, Index second, Index third) { triangles_.push_back({first, second, third}); }

  Table<3> table() const {
    return Eigen::Map<const Table<3>>(triangles_.empty() ? nullptr : triangles_[0].data(), 3,
                                      static_cast<Eigen::Index>(triangles_.size()));
  }

 private:
  std::vector<std::array<Index, 3>> triangles_;
};

/// The same facets seen from their other side; the first side of each stays the same, reversed.
inline Table<3> reversed(const Table<3>& facets) {
  Table<3> result = facets;
  if (facets.cols() > 0) result.row(0).swap(result.row(1));
  return result;
}

/// Gives every surface of the mesh a node set of the same name.
inline void add_surface_node_sets(Mesh& mesh) {
  for (const Surface& surface : mesh.surfaces) {
    mesh.node_sets.push_back({surface.name, surface_nodes(surface)});
  }
}

/// Adds the node set `name` of all nodes.
inline void add_set_of_all(Mesh& mesh, const std::string& name) {
  Subset all(static_cast<std::size_t>(mesh.X.cols()));
  for (std::size_t node = 0; node < all.size(); ++node) all[node] = static_cast<Index>(node);
  mesh.node_sets.push_back({name, all});
}

}  // namespace nereid::mesh
