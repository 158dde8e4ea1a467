#include "geometry/crossing.hpp"

#include <algorithm>
#include <limits>

namespace nereid::geometry {

namespace {

using Point = Vector<double>;

double squared(const Point& a) { return dot(a, a); }

/// Squared distance of a point from a segment. [m2]
double point_squared(const Point& p, const Point& a, const Point& b) {
  const Point L = b - a;
  const double length = squared(L), s = length > 0 ? std::clamp(dot(p - a, L) / length, 0.0, 1.0) : 0;
  return squared(p - a - s * L);
}

}  // namespace

double segments_squared(const Point& x1, const Point& x2, const Point& x3, const Point& x4) {
  // either between the lines, or at an end of one of them
  double least = std::min({point_squared(x1, x3, x4), point_squared(x2, x3, x4), point_squared(x3, x1, x2), point_squared(x4, x1, x2)});
  const Point N = cross(x2 - x1, x4 - x3);
  if (!(squared(N) > std::numeric_limits<double>::min())) return least;
  const Crossing<double> at = crossing(x1, x2, x3, x4);
  if (at.first >= 0 && at.first <= 1 && at.second >= 0 && at.second <= 1) least = std::min(least, at.height * at.height);
  return least;
}

}  // namespace nereid::geometry
