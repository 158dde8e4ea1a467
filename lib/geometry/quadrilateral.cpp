#include "geometry/quadrilateral.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace nereid::geometry {

bool bilinear_weights(const std::array<Vec3, 4>& corner, const Vec3& p, const Vec3& n, double a, double b, std::array<double, 4>& weight) {
  constexpr int most_rounds = 12;
  constexpr double round_off = 1e-14;  // of a side
  constexpr double beyond = 0.25;      // of a side
  const Vec3 along = corner[1] - corner[0], across = corner[3] - corner[0], twist = corner[2] - corner[1] - across;
  const Vec3 start = corner[0] - p;  // first, so that places far from the origin lose no digits
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3 by_a = along + b * twist, by_b = across + a * twist, left = start + a * by_a + b * across;
    const double area = n.dot(by_a.cross(by_b));
    const double da = -n.dot(left.cross(by_b)) / area, db = -n.dot(by_a.cross(left)) / area;
    if (!(std::abs(da) + std::abs(db) < 1e6)) return false;
    a += da, b += db;
    if (std::abs(da) + std::abs(db) > round_off && da * db * twist.squaredNorm() != 0) continue;
    if (!(std::max(std::abs(a - 0.5), std::abs(b - 0.5)) < 0.5 + beyond)) return false;
    weight = {(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b};
    return true;
  }
  return false;
}

}  // namespace nereid::geometry
