#include "geometry/quadrilateral.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::geometry {

namespace {

constexpr int most_rounds = 12;
constexpr double round_off = 1e-15;  // of a side
constexpr double farthest = 1e6;     // steps that lead nowhere

}  // namespace

bool bilinear_weights(const std::array<Vec3, 4>& corner, const Vec3& p, const Vec3& n, double a, double b, std::array<double, 4>& weight) {
  const Vec3 along = corner[1] - corner[0], across = corner[3] - corner[0], twist = corner[2] - corner[1] - across;
  const Vec3 start = corner[0] - p;  // first, so that places far from the origin lose no digits
  const double skew = std::sqrt(twist.squaredNorm() / std::max(along.squaredNorm(), across.squaredNorm()));
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3 by_a = along + b * twist, by_b = across + a * twist, left = start + a * by_a + b * across;
    const double area = n.dot(by_a.cross(by_b));
    const double da = -n.dot(left.cross(by_b)) / area, db = -n.dot(by_a.cross(left)) / area;
    if (!(std::abs(da) + std::abs(db) < farthest)) return false;
    a += da, b += db;
    if (std::abs(da * db) * skew > round_off) continue;  // a step leaves da db times the twist, and nothing else
    if (!is_on(a, b)) return false;
    weight = weights_at(a, b);
    return true;
  }
  return false;
}

}  // namespace nereid::geometry
