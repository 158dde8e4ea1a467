#include "element/corners.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace nereid::element {

namespace {

constexpr double flat = 1e-9;  // [-] of the product of its edges: a corner of the reference that has no volume

/// The three edges at each corner lead to these nodes, right-handed: mesh/mesh.hpp numbers the lower face first.
constexpr std::array<std::array<int, 3>, 8> ends{{{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

double jacobian(const Connectivity& nodes, const Vectors& x, Index element, int corner, double& edges) {
  const Vec3 at = x.col(nodes(corner, element));
  std::array<Vec3, 3> edge;
  for (int e = 0; e < 3; ++e) edge[e] = x.col(nodes(ends[corner][e], element)) - at;
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
