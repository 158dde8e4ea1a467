#pragma once
// The broad search: facets near a point, without knowing where to start.

#include <vector>

#include "contact/surface/base_surface.hpp"

namespace nereid::contact {

/// [m] The largest coordinate that can be searched for: the square of a distance stays finite.
constexpr double farthest_place = 1e150;

/// Facets sorted into a grid of cells. Memory is taken when it is made; sorting again for new positions takes none.
class BroadSearch {
 public:
  /// Of all facets of a surface from `first` on, or of so many.
  explicit BroadSearch(Index facets, Index first = 0);
  /// Sorts the facets by where they are; false, and nothing is found, where a corner is not finite or farther than farthest_place.
  bool sort(const BaseSurface& base, const Vectors& x);
  /// The facet nearest to a point, or -1 if none is nearer than `reach` [m] or the point is not finite or farther than
  /// farthest_place; after sort() at the same x.
  Index nearest(const BaseSurface& base, const Vectors& x, const Vector<double>& point, double reach) const;
  /// Calls visit(facet, distance squared) for all facets nearer to a point than `reach` that are wanted(facet), which is asked first;
  /// after sort() at the same x.
  template <class Visit, class Wanted>
  void within(const BaseSurface& base, const Vectors& x, const Vector<double>& point, double reach, Visit&& visit, Wanted&& wanted) const;
  template <class Visit>
  void within(const BaseSurface& base, const Vectors& x, const Vector<double>& point, double reach, Visit&& visit) const {
    within(base, x, point, reach, visit, [](Index) { return true; });
  }

 private:
  static constexpr double round_off = 1e-9;
  struct Box {
    Eigen::Vector3i first, last;
  };
  Vec3 low_ = Vec3::Zero();
  double cell_ = 1, radius_ = 1;  // [m] edge of a cell; largest distance from a facet's centre to its corners
  Eigen::Vector3i count_ = Eigen::Vector3i::Ones();
  std::vector<Index> begin_;  // of each cell in facets_
  Subset facets_;
  Vectors centres_;  // [m] of facets_
  Index first_;
  bool sorted_ = false;
  Index cell_of(int i, int j, int k) const { return (k * count_.y() + j) * count_.x() + i; }
  Index cell_of(const Vec3& point) const;
  bool can_find(const Vector<double>& point) const;
  Box cells_around(const Vector<double>& point, double reach) const;  ///< those with the centres of all facets nearer than reach
};

template <class Visit, class Wanted>
void BroadSearch::within(const BaseSurface& base, const Vectors& x, const Vector<double>& point, double reach, Visit&& visit,
                         Wanted&& wanted) const {
  if (!can_find(point)) return;
  const Box box = cells_around(point, reach);
  const double farther = (1 + round_off) * (reach + radius_);
  for (int k = box.first.z(); k <= box.last.z(); ++k)
    for (int j = box.first.y(); j <= box.last.y(); ++j)
      for (int i = box.first.x(); i <= box.last.x(); ++i)
        for (Index at = begin_[cell_of(i, j, k)]; at < begin_[cell_of(i, j, k) + 1]; ++at) {
          const Vec3 apart = centres_.col(at) - Vec3(point.x, point.y, point.z);
          if (!(apart.squaredNorm() <= farther * farther) || !wanted(facets_[at])) continue;
          const double squared = geometry::closest_on_triangle(corners(base, x, facets_[at]), point).distance_squared;
          if (squared < reach * reach) visit(facets_[at], squared);
        }
}

}  // namespace nereid::contact
