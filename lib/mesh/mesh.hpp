#pragma once
// A mesh: positions, elements by region, and the named node sets and surfaces that scenes speak of.
// It knows no physics.

#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"

namespace nereid::mesh {

/// Hexahedra of one body, nodes in the order of VTK: 0-3 around one face, 4-7 the face opposite to
/// it, positive volume.
struct Hexahedra {
  std::string name;
  Table<8> nodes;
};

/// Triangles of one body; the normal follows from the order of the nodes by the right-hand rule.
struct Triangles {
  std::string name;
  Table<3> nodes;
};

/// A surface cut into triangles; normals point away from the body (for a plate: to the side named).
struct Surface {
  std::string name;
  Table<3> facets;
};

struct NodeSet {
  std::string name;
  Subset nodes;
};

struct Mesh {
  Vectors X;  ///< [m] reference positions, [3 x nodes]
  std::vector<Hexahedra> hexahedra;
  std::vector<Triangles> triangles;
  std::vector<Surface> surfaces;
  std::vector<NodeSet> node_sets;
};

/// The region, surface or node set of that name; throws InternalError if there is none.
const Hexahedra& hexahedra(const Mesh&, std::string_view name);
const Triangles& triangles(const Mesh&, std::string_view name);
const Surface& surface(const Mesh&, std::string_view name);
const Subset& node_set(const Mesh&, std::string_view name);

/// Both meshes as one; nodes of b are numbered after those of a and none are merged. Throws
/// InternalError if two regions, two surfaces or two node sets have the same name.
Mesh join(const Mesh& a, const Mesh& b);

/// The nodes of a surface, ascending, each once.
Subset surface_nodes(const Surface&);

/// Area of each facet in the reference positions. [m2] [facets]
Scalars facet_areas(const Mesh&, const Surface&);

/// The faces a surface is made of: two facets that cut one face of a hexahedron are that face again.
///
/// returns  nodes around each face, seen as its facets are; the fourth is -1 where a facet is a face of its own
Table<4> faces(const Mesh&, const Surface&);

/// Tributary area of each node of `nodes`: what a uniform pressure on the surface gives to it, zero where there
/// is none. [m2] [nodes]
///
///     facet  A/3,      face of a hexahedron  (A + T)/6,  T the area of the triangle at that corner
///
/// The latter is the integral of the node's bilinear shape function over a flat face: a quarter on a
/// parallelogram, and it does not know along which diagonal the face was cut.
/// The sum over the nodes of the surface is its area; of a warped face, the mean of its two cuts. Of a sheet with both sides one counts.
Scalars tributary_areas(const Mesh&, const Surface&, const Subset& nodes);

/// The faces of a surface at each of some nodes, and what each gives to the tributary area of the node.
struct FacesAround {
  struct Share {
    Index face;   ///< column of `faces`
    double area;  ///< [m2] of the reference
  };
  Table<4> faces;             ///< nodes around each face, as faces() has them
  std::vector<Share> shares;  ///< node after node
  std::vector<Index> begin;   ///< [nodes + 1] the shares of node i are begin[i] to begin[i + 1]
};
FacesAround faces_around(const Mesh&, const Surface&, const Subset& nodes);

/// Tributary area of a node on those faces at it whose normals at positions x are within 60 degrees of the opposite of a direction. [m2]
///
/// place      of the node among the nodes of faces_around()
double tributary_area_against(const FacesAround&, const Vectors& x, Index place, const Vec3& direction);

/// Tributary area of the sides of a node that a contact along a direction loads: tributary_area_against(), or the whole area where next to
/// no face is against the direction, as of a sole on a steep flank, or where the faces are not known. [m2]
///
/// place      of the node among the nodes of faces_around()
/// direction  d: along it the other side pushes the node, any length
/// whole      [m2] of all faces at the node
/// least      [-] of it that must be against the direction
double tributary_area_loaded(const FacesAround&, const Vectors& x, Index place, const Vec3& direction, double whole, double least = 0);

/// Tributary area of a node across a direction, of those faces at it that face against it. [m2]
///
///     sum of  A_f max(0, -n_f . d),   n_f the normal of the face at positions x,  A_f its share of the tributary area
///
/// On a plane face that is pressed straight this is the tributary area on that face. What lies round an edge, on a side along d or
/// with its back to it, does not count. Continuous in d and x.
///
/// place      of the node among the nodes of faces_around()
/// direction  d: of the force of contact on the node, any length; zero: all faces count whole
double tributary_area_facing(const FacesAround&, const Vectors& x, Index place, const Vec3& direction);

}  // namespace nereid::mesh
