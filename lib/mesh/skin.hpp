#pragma once
// What can be said of hexahedra from wherever they come: their volumes and their outer faces.

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// Corners of each face of a hexahedron, counter-clockwise seen from outside.
inline constexpr int corners_of_faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// Volume of each hexahedron, exact for every trilinear shape, negative if it is turned inside out. [m3] [elements]
///
///     V = sum over the faces of the flux of x/3 through the bilinear patch of each
Scalars volumes(const Mesh&, const Hexahedra&);

/// Outer faces: those that one hexahedron of all regions has and no other.
struct Skin {
  Table<3> facets;           ///< each quadrilateral cut as cut_of_face() says, normals outwards
  std::int64_t crowded = 0;  ///< faces that more than two hexahedra have; they are not in the skin
};

/// Finds the skin of hexahedra, in their order. Faces with two corners in one are triangles, those with less nothing.
/// The middle about which faces are cut is the mean of the skin's nodes.
Skin skin(const Vectors& X, const std::vector<Hexahedra>&);

}  // namespace nereid::mesh
