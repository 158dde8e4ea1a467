#pragma once
// The edges of a surface that another surface's edges can cross: its ridges and rims.

#include <array>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::contact {

/// Edges of a surface, with the facets of its body on both sides. Constant in time.
struct Edges {
  Table<2> nodes;     ///< of each edge; the first facet has it in this order
  Table<2> across;    ///< third nodes of both facets; -1 where a plate ends
  Table<2> opposite;  ///< the same, or of quadrilateral faces their fourth nodes
  Scalars area;       ///< [m2] of half its length: mean of the tributary areas of its nodes on the surface
  Table<2> counts;    ///< 1 of facets of the surface, whose area that is, 0 of facets that only the body has
  std::vector<char> of_plates;  ///< [edges] these have two sides
  // of an automatic contact, else empty
  Scalars half;  ///< [m] [edges] half the thickness of plates
  Subset body;   ///< [edges]
};

/// Adds the edges of a body, whose plates have half a thickness there. [m]
void add_edges(const Edges&, double half, Index body, Edges& all);

/// Finds the edges of a surface, but not the cuts of quadrilateral faces, edges of more than two faces, and edges in symmetry planes.
///
/// What a solid has beside the surface counts too: the border of a named face is a ridge of its body.
Edges edges_of(const mesh::Mesh&, const mesh::Surface&, std::span<const Subset> symmetry_planes);

/// The nodes of all edges and of the facets at them, ascending, each once.
Subset nodes_of(const Edges&);

/// Whether the body turns outward at an edge by more than 20 degrees; plates to either side. A rim does always.
bool is_ridge(const Edges&, const Vectors& x, Index edge);

/// The way from the first node of an edge to the second. [m]
Vec3 along(const Edges&, const Vectors& x, Index edge);

/// The way in a facet from an edge to what is opposite, across the edge; side 0 or 1. [m]
///
/// Of a quadrilateral it leads to the middle of the opposite edge: one of both nodes alone would make a warped face lean by another angle
/// in a mirror.
Vec3 into(const Edges&, const Vectors& x, Index edge, int side);

/// Unit vectors from an edge into its facets, of which a rim has one.
struct Flanks {
  int count = 0;
  std::array<Vec3, 2> into;

  Flanks(const Edges&, const Vectors& x, Index edge);
};

/// The part of Edges::area that a contact along a direction loads: on those facets of the surface at an edge whose normals are within 60
/// degrees of the opposite of the direction. It is all of the area where no facet faces the direction, and of plates. [m2]
///
/// direction  unit vector: along it the other side pushes the edge
double area_loaded(const Edges&, const Vectors& x, Index edge, const Vec3& direction);

/// How far the facets at an edge rise above the plane across a direction, as a sine: the largest of  t . d  with t the unit vector into
/// a facet. What is in front of the edge along d can be touched where none rises.
double rise(const Flanks&, const Vec3& direction);

/// The most by which the facets at an edge turn per way of nodes against each other, as long as that is small. [rad/m]
double turn_of_facets(const Edges&, const Vectors& x, Index edge);

}  // namespace nereid::contact
