#pragma once
// The closest point of a triangle, and whose it is: the facet's, an edge's or a vertex's.

#include <array>

#include "base/tensor.hpp"

namespace nereid::geometry {

/// The three kinds of feature, which are the paper's three contact elements.
enum class Kind : int { vertex = 1, edge = 2, facet = 3 };

struct Closest {
  Kind kind;
  int local;                     ///< edge 0-1, 1-2, 2-0 or vertex 0, 1, 2; 0 for the facet itself
  std::array<double, 3> weight;  ///< barycentric, not negative
  double distance_squared;       ///< [m2]
};

/// Closest point of a triangle to p, by the regions of the triangle's features.
///
/// The facet owns it where the paper's Eq. 14 holds; the region test is that of Ericson, Real-Time
/// Collision Detection (2005), section 5.1.5. Points exactly on a border count as the smaller feature.
Closest closest_on_triangle(const std::array<Vector<double>, 3>& x, const Vector<double>& p);

}  // namespace nereid::geometry
