#include "contact/report/coarseness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/surface/stand.hpp"

namespace nereid::contact {

namespace {

using Mat2 = Eigen::Matrix2d;
constexpr double in_view = 0.5;  // cosine between the normal of a face and the direction it is looked at from: 60 degrees

/// Mean of the spacing tensors of the faces around a node that look along a direction, in the plane of two vectors across it; zero without
/// any. [m2]
Mat2 spacing(const mesh::FacesAround& around, const Vectors& x, Index place, const Vec3& direction, const std::array<Vec3, 2>& plane) {
  const auto flat = [&](const Vec3& v) { return Eigen::Vector2d(v.dot(plane[0]), v.dot(plane[1])); };
  Mat2 sum = Mat2::Zero();
  double area = 0;
  for (Index s = around.begin[place]; s < around.begin[place + 1]; ++s) {
    const auto nodes = around.faces.col(around.shares[s].face);
    const auto corner = [&](int a) -> Vec3 { return x.col(nodes(a)); };
    const bool triangle = nodes(3) < 0;  // of a plate
    const Vec3 g = triangle ? Vec3(corner(1) - corner(0)) : Vec3(0.5 * (corner(1) + corner(2) - corner(0) - corner(3)));
    const Vec3 h = triangle ? Vec3(corner(2) - corner(0)) : Vec3(0.5 * (corner(2) + corner(3) - corner(0) - corner(1)));
    const Vec3 normal = g.cross(h);  // its length is the area of the face, of a triangle twice that
    if (!(normal.dot(direction) > in_view * normal.norm())) continue;
    const Mat2 square = normal.norm() * Mat2::Identity(), bricks = flat(g) * flat(g).transpose() + flat(h) * flat(h).transpose();
    const double share = around.shares[s].area;
    sum += share * (triangle ? square : bricks);
    area += share;
  }
  return area > 0 ? Mat2(sum / area) : Mat2(Mat2::Zero());
}

/// The largest eigenvalue of b^-1 a. [-]
double largest(const Mat2& a, const Mat2& b) {
  const Mat2 product = b.inverse() * a;
  const double half = 0.5 * product.trace();
  return half + std::sqrt(std::max(0.0, half * half - product.determinant()));
}

struct Facing {
  double height, size, area, apexes, base;
};

double median(std::vector<Facing>& list, double Facing::* value) {
  std::stable_sort(list.begin(), list.end(), [value](const Facing& a, const Facing& b) { return a.*value < b.*value; });
  double all = 0, below = 0;
  for (const Facing& one : list) all += one.area;
  for (const Facing& one : list)
    if (below += one.area; below >= 0.5 * all) return one.*value;
  return 0;
}

}  // namespace

Coarseness coarseness(const Interface& interface, const mesh::FacesAround& base_faces, const Vectors& x, double reach,
                      Workspace& workspace) {
  if (interface.faces.begin.empty() || !workspace.broad[0].sort(interface.base, x)) return {};
  std::vector<Facing> list;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index a = 0; a < static_cast<Index>(interface.apexes.size()); ++a) {
    const Vec3 p = x.col(interface.apexes[a]);
    const Index start = workspace.broad[0].nearest(interface.base, x, position(x, interface.apexes[a]), reach);
    if (start < 0) continue;
    const Stand here = stand(interface.base, x, p, start);
    const Index facet = here.feature.facet;
    if (here.past > whole_past_wall * interface.base.size(facet)) continue;
    const Vec3 normal = facet_normal(interface.base, x, facet);
    const Vec3 along = normal.unitOrthogonal();
    const std::array<Vec3, 2> plane{along, normal.cross(along)};
    const Mat2 own = spacing(interface.faces, x, a, -normal, plane);
    Mat2 below = Mat2::Zero();
    for (int I = 0; I < 3; ++I) {
      const auto& nodes = interface.base_nodes;
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), interface.base.facets(I, facet)) - nodes.begin();
      below += spacing(base_faces, x, static_cast<Index>(place), normal, plane) / 3;
    }
    if (!(own.determinant() > 0) || !(below.determinant() > 0)) continue;
    const double height = std::abs(here.over.height);
    nearest = std::min(nearest, height);
    list.push_back({height, std::sqrt(own.trace()), interface.area(a), std::sqrt(largest(own, below)), std::sqrt(largest(below, own))});
  }
  std::erase_if(list, [&](const Facing& one) { return one.height > nearest + one.size; });
  return {median(list, &Facing::apexes), median(list, &Facing::base)};
}

}  // namespace nereid::contact
