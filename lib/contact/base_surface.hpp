#pragma once
// The base surface of an interface: facets, and the adjacency table along which apexes walk.

#include <array>
#include <vector>

#include "geometry/closest.hpp"
#include "mesh/mesh.hpp"

namespace nereid::contact {

/// A feature of the base surface: a facet, or one of its edges or vertices.
struct Feature {
  Index facet = -1;
  geometry::Kind kind = geometry::Kind::facet;
  int local = 0;  ///< edge 0-1, 1-2, 2-0 or vertex 0, 1, 2 of the facet
};

constexpr Index no_facet = -1;        ///< behind a border edge the surface ends
constexpr Index image_of_facet = -2;  ///< behind a border edge in a symmetry plane it goes on as its image

struct BaseSurface {
  Table<3> facets;                ///< nodes; the normal points to the side of the apexes
  Table<3> neighbour;             ///< facet across the edges 0-1, 1-2, 2-0, or at the border one of the two above, below 0
  std::vector<Index> ring_begin;  ///< [nodes of the mesh + 1] where the facets around a node begin
  Subset ring;                    ///< facets around each node, ascending
};

/// Builds the adjacency table of a surface.
///
/// Throws InternalError if an edge belongs to more than two facets, or if two neighbours disagree
/// about which side is which.
BaseSurface base_surface(const mesh::Surface&, Index nodes_of_mesh);

/// Marks the border edges that lie in a symmetry plane: the surface goes on behind them as its image.
///
/// nodes    on the plane, ascending
void goes_on_behind(BaseSurface&, const Subset& nodes);

inline Vector<double> position(const Vectors& x, Index node) {
  return {x(0, node), x(1, node), x(2, node)};
}
inline std::array<Vector<double>, 3> corners(const BaseSurface& base, const Vectors& x, Index facet) {
  return {position(x, base.facets(0, facet)), position(x, base.facets(1, facet)),
          position(x, base.facets(2, facet))};
}

/// A border nearer to the foot of an apex than this many times its height may hide a nearer facet: the
/// other flank of a valley or the other side of a ridge, of 53 degrees or more between them.
constexpr double look_around = 2.0;

/// The feature closest to a point, by walking downhill from facet to facet (Kulak & Fiala, chapter 4).
///
/// Eq. 14 tells which edge or vertex of a facet was crossed and the adjacency table what lies behind;
/// the walk goes on while the distance falls. On a convex ridge, where Eq. 14 fails on both sides,
/// it ends on the edge or vertex itself; in a valley, where it holds on both, on the nearer flank.
///
/// from     facet to start from
/// hops     facets passed on the way
/// returns  the feature and the closest point; facet -1 if the walk did not end
struct WalkEnd {
  Feature feature;
  geometry::Closest closest;
  int hops = 0;
};
WalkEnd walk(const BaseSurface&, const Vectors& x, const Vector<double>& apex, Index from);

/// [m] The largest coordinate that can be searched for: the square of a distance stays finite.
constexpr double farthest_place = 1e150;

/// Finds the closest facet without knowing where to start: facets sorted into a grid of cells.
///
/// Memory is taken when it is made; sorting again for new positions takes none.
class BroadSearch {
 public:
  explicit BroadSearch(Index facets);
  /// Sorts the facets by where they are; false, and nearest() finds none, where a corner is not finite or farther than farthest_place.
  bool sort(const BaseSurface&, const Vectors& x);
  /// The facet nearest to a point, or -1 if none is nearer than `reach` [m] or the point is not finite or farther than
  /// farthest_place; after sort() at the same x.
  Index nearest(const BaseSurface&, const Vectors& x, const Vector<double>& point, double reach) const;

 private:
  Vec3 low_ = Vec3::Zero();
  double cell_ = 1, radius_ = 1;  // [m] edge of a cell; largest distance from a facet's centre to its corners
  Eigen::Vector3i count_ = Eigen::Vector3i::Ones();
  std::vector<Index> begin_;  // of each cell in facets_
  Subset facets_;
  bool sorted_ = false;
  Index cell_of(int i, int j, int k) const { return (k * count_.y() + j) * count_.x() + i; }
  Index cell_of(const Vec3& point) const;
};

}  // namespace nereid::contact
