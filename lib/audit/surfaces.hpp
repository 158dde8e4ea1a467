#pragma once
// What an audit looks at: the outer surfaces of bodies, made of the connectivity of their elements alone.
//
// It knows nothing of contact: not which surfaces a case names, nor what a contact found on them.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/round_body.hpp"

namespace nereid::audit {

/// A plane of symmetry: its nodes stay on it, and the faces on it are no outside.
struct Symmetry {
  Vec3 normal;   ///< unit vector, to either side
  Subset nodes;  ///< ascending
};

/// Boxes around boxes around triangles: a binary tree whose first child follows its parent.
struct Tree {
  struct Node {
    Index first, last;  ///< its triangles, [first, last)
    Index second;       ///< its second child; 0: none, a leaf
  };
  std::vector<Node> nodes;
};

/// The skin of one connected piece of solids, one connected sheet of plates, or the shell around a sheet. Constant in time.
///
/// The points of a shell are those of one side of its plates, then those of the other in the same order, both with the nodes of the
/// mid-surface. Its faces are the plates as one side shows them, then the other side, then walls.
///
/// Triangles are those of plates, and those of the outer faces of hexahedra: a face of four corners is cut into four around its
/// centre, so that no numbering of nodes decides how a warped face is cut. Their corners are points, or centres: centre f is
/// counted as points + f.
struct Surface {
  bool closed = true;             ///< skin of solids or shell of plates, normals outwards; else an open sheet
  Index piece = 0;                ///< which connected piece of the mesh
  Subset nodes;                   ///< [points] of the mesh; ascending but for shells
  Vectors inward;                 ///< [3 x points] into the body from planes of symmetry on which a point lies, else zero
  Scalars size;                   ///< [m] [points] of the smallest element with a face at the point
  Scalars half;                   ///< [m] [points] half the thickness of the thinnest plate there; zero on solids
  std::vector<Index> region;      ///< [points] place in Surfaces::names
  Table<2> edges;                 ///< [edges] points; each once
  std::vector<Index> owner;       ///< [edges] a triangle that has it
  Table<4> faces;                 ///< [faces] points, seen from outside; the fourth of a triangle is -1
  Table<4> beside;                ///< [faces] the face across each side, in the order of its points; -1: none, or not just one
  Scalars face_size;              ///< [m] [faces] element size, see surfaces()
  std::vector<Index> face_region; ///< [faces] place in Surfaces::names
  std::vector<char> cut;          ///< [faces] whether it is no outside: on a plane of symmetry, or a wall between plates
  Index plates = 0;               ///< faces of one side of a shell; zero of all others
  Table<3> triangles;             ///< [triangles] points or centres, in the order of the tree
  std::vector<Index> face_of;     ///< [triangles]
  std::vector<std::array<bool, 3>> rim;  ///< [triangles] which sides 0-1, 1-2, 2-0 belong to no other triangle; sheets only
  std::vector<char> on_rim;       ///< [points] sheets only
  Table<2> rim_edges;             ///< points; sheets only
  double smallest = 0;            ///< [m] of face_size
  std::optional<mesh::RoundBody> round;  ///< exact shape of a rigid body; depths are measured from it, and not from the faces
  Tree tree;
};

/// All surfaces of a mesh.
struct Surfaces {
  std::vector<std::string> names;      ///< of the regions of the mesh: hexahedra, then triangles
  std::vector<Surface> list;           ///< by their first element
  std::vector<Surface> shells;         ///< beside `list`: around a sheet; empty for skins and where a thickness is not known
  std::vector<Index> piece_of_node;    ///< [nodes] connected piece, -1: of no element
};

/// Finds the surfaces of a mesh: elements that have a node in common belong to one piece, whatever their regions.
///
/// The size of an element behind a face in the reference positions is
///
///     hexahedra  V / A of the largest side,    triangles  min(thickness, sqrt(2 A))
///
/// thickness  [m] beside Mesh::triangles; zero: not known, only the side counts
Surfaces surfaces(const mesh::Mesh&, const std::vector<double>& thickness, const std::vector<Symmetry>& = {});

}  // namespace nereid::audit
