#pragma once
// Cells of a file that lie on faces of its hexahedra, as programs write them to name parts of a boundary.

#include <array>
#include <compare>
#include <set>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::grid {

/// Three different nodes of a face, in ascending order: all that can be said of a face whatever its cut.
using Corners = std::array<Index, 3>;
Corners corners(Index, Index, Index);

/// A part of the faces of hexahedra.
struct Boundary {
  std::string name;
  std::set<Corners> faces;  ///< any three corners of each
};

/// The faces of hexahedra, to be found by any three of their corners.
class FacesOfSolids {
 public:
  explicit FacesOfSolids(const std::vector<std::array<Index, 8>>& hexahedra);
  bool has(const Corners&) const;
  /// Whether a triangle and others of a part cover a face that has its corners: alone a face of three corners, with the triangle on the
  /// other side of a diagonal a face of four.
  bool is_covered(const Corners&, const std::set<Corners>& part) const;
  /// Adds all triples of the faces that have these corners.
  void add_to(Boundary&, const Corners&) const;

 private:
  struct Triple {
    Corners corners;
    std::array<Index, 4> face;  ///< its nodes in ascending order, the fourth -1 of three
    Corners other_half;         ///< the triangle on the other side of its diagonal; -1 of three
    friend auto operator<=>(const Triple&, const Triple&) = default;
  };
  static Triple first_of(const Corners& one) { return {one, {-1, -1, -1, -1}, {-1, -1, -1}}; }
  std::vector<Triple> triples_;  // in order
};

/// Gives the nodes of a boundary other numbers that keep their order. [nodes]
void renumber(Boundary&, const std::vector<Index>& number);

/// The facets that lie on faces of a boundary.
Table<3> facets_on(const Table<3>& facets, const Boundary&);

/// Nodes of the faces of a boundary, in order.
Subset nodes_on(const Boundary&);

}  // namespace nereid::grid
