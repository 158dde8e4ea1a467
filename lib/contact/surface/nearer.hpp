#pragma once
// Which of two facets is nearer to a point. At an edge or a vertex all facets that meet there are as near, but for round-off; which of them
// counts must follow from where they are and not from their numbers.

#include <cmath>

#include "contact/surface/base_surface.hpp"
#include "geometry/height.hpp"

namespace nereid::contact {

constexpr double as_near = 1e-9;  ///< [-] of the longest edge: distances that differ by less are alike

/// Whether a facet is nearer to a point than another one; of two that are as near, whether the point is farther in front of its plane.
///
/// gap         [m] distance of the point less what the facet stands off
/// other       -1: none
inline bool is_nearer(const BaseSurface& base, const Vectors& x, const Vector<double>& point, Index facet, double gap, Index other,
                      double other_gap) {
  if (other < 0 || std::abs(gap - other_gap) > as_near * base.longest(facet)) return gap < other_gap;
  const auto in_front = [&](Index one) { return geometry::facet_height(corners(base, x, one), point).height; };
  return in_front(facet) > in_front(other);
}

}  // namespace nereid::contact
