#include "element/corners.hpp"

#include <cmath>

#include "element/corner_edges.hpp"

namespace nereid::element {

namespace {

std::array<Vector<double>, 8> corners_of(const Connectivity& nodes, const Vectors& x, Index element) {
  std::array<Vector<double>, 8> corners;
  for (int a = 0; a < 8; ++a) {
    const auto at = x.col(nodes(a, element));
    corners[static_cast<std::size_t>(a)] = {at.x(), at.y(), at.z()};
  }
  return corners;
}

}  // namespace

Corner smallest_corner(const AnyBlock& any, const Vectors& X, const Vectors& x) {
  Corner smallest;
  const Connectivity& all = nodes(any);
  if (all.rows() != 8) return smallest;
  for (Index element = 0; element < all.cols(); ++element) {
    const auto reference = corners_of(all, X, element), now = corners_of(all, x, element);
    for (int corner = 0; corner < 8; ++corner) {
      const double before = volume_of_corner(corner_edges(reference, corner));
      if (!(before > 0)) continue;
      const double ratio = corner_edges(now, corner).jacobian / before;
      if (std::isnan(ratio)) return {ratio, element};
      if (smallest.element < 0 || ratio < smallest.ratio) smallest = {ratio, element};
    }
  }
  return smallest;
}

}  // namespace nereid::element
