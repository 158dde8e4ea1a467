#pragma once
// The base surface of an interface: facets, the adjacency table along which apexes walk, and the body behind.

#include <array>
#include <cmath>
#include <vector>

#include "contact/surface/beside.hpp"
#include "geometry/closest.hpp"
#include "mesh/mesh.hpp"

namespace nereid::contact {

/// A feature of the base surface: a facet, or one of its edges or vertices.
struct Feature {
  Index facet = -1;
  geometry::Kind kind = geometry::Kind::facet;
  int local = 0;  ///< edge 0-1, 1-2, 2-0 or vertex 0, 1, 2 of the facet
};

inline bool same(const Feature& a, const Feature& b) {
  return a.facet == b.facet && a.kind == b.kind && (a.kind == geometry::Kind::facet || a.local == b.local);
}

constexpr Index no_facet = -1;        ///< behind a border edge the surface ends
constexpr Index image_of_facet = -2;  ///< behind a border edge in a symmetry plane it goes on as its image

/// Facets and, for each node, those around it.
struct Fans {
  Table<3> facets;                ///< nodes
  std::vector<Index> other_side;  ///< [facets] that on the same nodes, of a sheet with both sides; or -1
  std::vector<Index> ring_begin;  ///< [nodes of the mesh + 1] where the facets around a node begin
  Subset ring;                    ///< facets around each node, ascending
};
Fans fans(const Table<3>& facets, Index nodes_of_mesh);

/// Whether a facet is one side of a sheet that has both.
inline bool is_sheet(const Fans& surface, Index facet) { return surface.other_side[static_cast<std::size_t>(facet)] >= 0; }

/// Whether a facet is half of a face of a hexahedron.
struct Half {
  int cut = -1;       ///< edge 0-1, 1-2 or 2-0 behind which the other half lies; -1: it is a face of its own
  Index fourth = -1;  ///< node of the other half
};

/// Facets of a surface, what lies around them, and what the reference geometry says of the body behind. Constant in time.
///
/// An edge is a *wall* if the surface ends there, or if it turns there by more than 84 degrees to the outside, as to the other side of a
/// sheet. A *patch* is what is
/// connected without crossing a wall: an apex slides within a patch, and its force fades past a wall.
struct BaseSurface : Fans {         // the normal of a facet points to the side of the apexes
  Table<3> neighbour;               ///< facet across the edges 0-1, 1-2, 2-0, or at the border one of the two above, below 0
  std::vector<Half> half;           ///< [facets]
  std::vector<std::array<bool, 3>> wall;  ///< [facets] of the edges 0-1, 1-2, 2-0
  Scalars thickness;  ///< [m] way along -n from the centre of the facet to the first facet that faces back; infinite without one
  Scalars size;       ///< [m] of the face that the facet is half of: the root of twice its area
  Scalars longest;    ///< [m] its longest edge
  Scalars stand_off;  ///< [m] [facets] half the thickness of plates there, which comes to h_c of an apex; empty: h_c has it
  Beside beside;      ///< of bodies that touch themselves
  double sharpest = 0;  ///< [-] the largest lean() of any facet: how far a walk must look in its sharpest valley
};

/// [-] of the size of a face: so far past a wall a facet is still the base, for half of what a border apex stands for is inside.
constexpr double whole_past_wall = 0.05;

constexpr double one_plane = 0.9999;  ///< [-] cosine between normals of what is no ridge
constexpr double far_turn = 0.1;  ///< [-] cosine between sides of a ridge, as at a wall

/// Whether a facet has a node beside an apex that is of the same surface; false for -1, an apex of another one.
inline bool is_beside(const BaseSurface& base, Index self, Index facet) {
  if (self < 0 || base.beside.begin.empty()) return false;
  return is_beside(base.beside, self, base.facets(0, facet)) || is_beside(base.beside, self, base.facets(1, facet)) ||
         is_beside(base.beside, self, base.facets(2, facet));
}

/// Builds the adjacency table of a surface, and what is measured in the reference.
///
/// X              [m] reference positions of all nodes of the mesh
/// body_of_facet  of several bodies, each of which has its own material behind its facets; empty for one
/// Throws InternalError if neighbours disagree about which side is which: mesh::goes_on().
BaseSurface base_surface(const mesh::Surface&, const Vectors& X, const Subset& body_of_facet = {});

/// Marks the border edges that lie in a symmetry plane: the surface goes on behind them as its image, and they are no walls.
///
/// nodes    on the plane, ascending
void goes_on_behind(BaseSurface&, const Subset& nodes);

/// Marks the facets that are halves of faces of hexahedra.
///
/// faces  nodes around each, the fourth -1 where a facet is a face of its own: mesh::faces()
void mark_halves(BaseSurface&, const Table<4>& faces);

/// Whether an edge of a facet is a rim, behind which its sheet goes on as its other side.
inline bool is_rim_of_sheet(const BaseSurface& base, Index facet, int edge) {
  const Index across = base.neighbour(edge, facet);
  return across >= 0 && across == base.other_side[static_cast<std::size_t>(facet)];
}

/// What a facet adds to h_c of an apex. [m]
inline double stand_off(const BaseSurface& base, Index facet) { return base.stand_off.size() > 0 ? base.stand_off(facet) : 0; }

/// Whether a wall ends in a node.
bool at_wall(const BaseSurface&, Index node);

/// Whether the surface ends at an edge or vertex: not where it goes on as its image.
bool ends_at(const BaseSurface&, const Feature&);

/// The normal of a node: that of its facets, weighted by their angles (Baerentzen & Aanaes 2005). Unit vector; zero where all are sheets
/// with both sides, which face everywhere.
Vec3 node_normal(const Fans&, const Vectors& x, Index node);

/// How far the nearest points of the facets around one may be from its own, over the height above it: 1.5 tan of half the largest turn
/// between two of them without a wall, as the surface stands at x; 6 or less. [-]
double lean(const BaseSurface&, const Vectors& x, Index facet);

/// The same over its own edges alone: no more than lean(), and cheaper.
double lean_at_edges(const BaseSurface&, const Vectors& x, Index facet);

/// Twice the area of a facet along its normal. [m2]
inline Vec3 area_vector(const Fans& base, const Vectors& x, Index facet) {
  const Vec3 a = x.col(base.facets(1, facet)) - x.col(base.facets(0, facet));
  const Vec3 b = x.col(base.facets(2, facet)) - x.col(base.facets(0, facet));
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}
inline Vec3 facet_normal(const Fans& base, const Vectors& x, Index facet) { return area_vector(base, x, facet).normalized(); }
/// The mean of the nodes of a facet. [m]
Vec3 centre(const BaseSurface&, const Vectors& x, Index facet);

inline Vec3 eigen(const Vector<double>& a) { return {a.x, a.y, a.z}; }
inline Vector<double> position(const Vectors& x, Index node) {
  return {x(0, node), x(1, node), x(2, node)};
}
inline std::array<Vector<double>, 3> corners(const Fans& base, const Vectors& x, Index facet) {
  return {position(x, base.facets(0, facet)), position(x, base.facets(1, facet)),
          position(x, base.facets(2, facet))};
}

/// The nodes of a feature.
struct FeatureNodes {
  int count;
  std::array<Index, 3> node;
};
FeatureNodes nodes_of(const BaseSurface&, const Feature&);

/// Height of a point over a feature, with the weights of the facet's nodes.
struct FeatureHeight {
  double height = 0;               ///< [m] signed by the facet's side
  Vec3 normal = Vec3::UnitZ();     ///< unit vector to the outside
  std::array<double, 3> weight{};  ///< of the foot on the nodes of the facet; they sum to one
};
FeatureHeight height_over(const BaseSurface&, const Vectors& x, const Feature&, const Vec3& point);

}  // namespace nereid::contact
