#include "contact/surface/cone.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace nereid::contact {

namespace {

constexpr double out_of_body = 0.3;  // cosine between n and the normal of the apex's own surface

}  // namespace

double reach_behind(const Fans& own, const Vectors& x, Index node, const Vec3& n) {
  double most = -1;
  const Vec3 here = x.col(node);
  for (Index r = own.ring_begin[node]; r < own.ring_begin[node + 1]; ++r) {
    const Index facet = own.ring[r];
    int corner = 0;
    while (own.facets(corner, facet) != node) ++corner;
    const Vec3 first = Vec3(x.col(own.facets((corner + 1) % 3, facet))) - here;
    const Vec3 second = Vec3(x.col(own.facets((corner + 2) % 3, facet))) - here;
    const Vec3 area = first.cross(second);
    const Vec3 down = n.dot(area) / area.squaredNorm() * area - n;  // the part of -n in the plane of the facet
    const bool inside = first.cross(down).dot(area) >= 0 && down.cross(second).dot(area) >= 0;
    most = std::max(most, inside ? down.norm() : -std::min(n.dot(first) / first.norm(), n.dot(second) / second.norm()));
  }
  return most;
}

double flush_step(const BaseSurface& base, const Vectors& x, Index onto, Index across) {
  const Vec3 normal = facet_normal(base, x, onto), here = x.col(base.facets(0, onto));
  double behind = 0;
  for (int a = 0; a < 3; ++a) behind = std::max(behind, normal.dot(here - Vec3(x.col(base.facets(a, across)))));
  return level_by * std::min(base.longest(onto), behind);
}

bool may_push(const Fans& own, const Vectors& x, Index apex, const Vec3& n, double most, const Mat3* allowed) {
  if (own.facets.cols() == 0) return true;
  Vec3 normal = node_normal(own, x, apex), along = n;  // zero for sheets, which face everywhere
  if (allowed) normal = *allowed * normal, along = *allowed * n;
  const double size = along.norm();
  if (!(size > 0)) return true;
  const bool leads_out = along.dot(normal) > out_of_body * size * normal.norm();
  return !leads_out && reach_behind(own, x, apex, along / size) < most;
}

}  // namespace nereid::contact
