#include "geometry/quadrilateral.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::geometry {

namespace {

constexpr int most_rounds = 12;
constexpr double round_off = 1e-15;  // of a side
constexpr double beyond = 0.25;      // of a side
constexpr double farthest = 1e6;     // steps that lead nowhere

bool is_on(double a, double b) { return std::max(std::abs(a - 0.5), std::abs(b - 0.5)) < 0.5 + beyond; }

}  // namespace

bool closest_on_quadrilateral(const std::array<Vec3, 4>& corner, const Vec3& p, OnQuadrilateral& at) {
  const Vec3 along = corner[1] - corner[0], across = corner[3] - corner[0], twist = corner[2] - corner[1] - across;
  const Vec3 start = p - corner[0];  // first, so that places far from the origin lose no digits
  const double skew2 = twist.squaredNorm() / std::min(along.squaredNorm(), across.squaredNorm());
  const auto look = [&] {
    at.by_a = along + at.b * twist, at.by_b = across + at.a * twist;
    at.way = start - at.a * at.by_a - at.b * across;
  };
  for (int round = 0; round < most_rounds; ++round) {
    look();
    const double aa = at.by_a.squaredNorm(), bb = at.by_b.squaredNorm(), ab = at.by_a.dot(at.by_b) - at.way.dot(twist);
    const double to_a = at.by_a.dot(at.way), to_b = at.by_b.dot(at.way), per = 1 / (aa * bb - ab * ab);
    const double da = per * (bb * to_a - ab * to_b), db = per * (aa * to_b - ab * to_a), step = da * da + db * db;
    if (!(per > 0 && step < farthest)) return false;
    at.a += da, at.b += db;
    if (step * step * skew2 > round_off * round_off) continue;  // a step leaves its square times the twist, and nothing else
    look();
    return is_on(at.a, at.b);
  }
  return false;
}

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
