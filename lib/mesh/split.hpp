#pragma once
// Meshes made finer by splitting their elements, whatever made them.

#include <array>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// Parts into which split() cuts an edge.
inline constexpr std::array<int, 3> split_factors{1, 2, 4};

/// A finer mesh, or the elements that cannot be split.
struct Split {
  Mesh mesh;                    ///< empty if any element is refused
  std::vector<Index> parents;   ///< [elements] the element that each is a part of; both counted as in Origin
  std::vector<Index> refused;   ///< ascending
};

/// How many times as many hexahedra and triangles a mesh has that is split. [-]
constexpr double times_hexahedra(int factor) { return 1.0 * factor * factor * factor; }
constexpr double times_triangles(int factor) { return 1.0 * factor * factor; }

/// Cuts every edge of a mesh in two, or in four by doing so twice: 8 hexahedra of each, 4 triangles of each triangle, facets too.
///
///     new nodes   the mean of the two ends of an edge, the four corners of a face, the eight corners of a cell; one of each in the mesh
///     wedges      hexahedra with two parallel edges of no length become eight wedges, whose triangles are quarters
///     plates      a side of a triangle that is the diagonal of a face of a hexahedron is cut at the middle of that face
///     numbers     nodes keep theirs; parts of an element follow each other
///
/// A new node is in a node set if all nodes are that it is the mean of. Exact are sets called like a region, which have its nodes, and sets
/// called like a surface whose nodes they are. Between a corner of plates and the rest, where a triangle has two sides on the rim, a
/// new node is in the set only if the triangle beyond is.
///
/// Edges stay straight: the volume of every hexahedron and the area of every triangle stay, but for plates on warped faces.
///
/// factor   one of split_factors
/// Refused  hexahedra with coincident corners that are no wedge, and those with a face whose diagonal is an edge of another one or the
///          diagonal of another face
/// Throws InternalError for another factor, and for a surface whose facets are no part of elements
Split split(const Mesh&, int factor);

}  // namespace nereid::mesh
