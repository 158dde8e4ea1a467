#include "element/corners.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "element/distortion.hpp"

namespace nereid::element {

namespace {

constexpr double flat = 1e-9;  // [-] of the product of its edges: a corner of the reference that has no volume

double jacobian(const Connectivity& nodes, const Vectors& x, Index element, int corner, double& edges) {
  const Vec3 at = x.col(nodes(corner, element));
  std::array<Vec3, 3> edge;
  for (int e = 0; e < 3; ++e) edge[e] = x.col(nodes(corner_ends[corner][e], element)) - at;
  edges = edge[0].norm() * edge[1].norm() * edge[2].norm();
  return edge[0].cross(edge[1]).dot(edge[2]);
}

}  // namespace

Corner smallest_corner(const AnyBlock& any, const Vectors& X, const Vectors& x) {
  Corner smallest;
  const Connectivity& all = nodes(any);
  if (all.rows() != 8) return smallest;
  for (Index element = 0; element < all.cols(); ++element) {
    for (int corner = 0; corner < 8; ++corner) {
      double edges = 0, edges_now = 0;
      const double before = jacobian(all, X, element, corner, edges);
      if (!(before > flat * edges)) continue;
      const double ratio = jacobian(all, x, element, corner, edges_now) / before;
      if (std::isnan(ratio)) return {ratio, element};
      if (smallest.element < 0 || ratio < smallest.ratio) smallest = {ratio, element};
    }
  }
  return smallest;
}

}  // namespace nereid::element
