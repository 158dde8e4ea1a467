#include "mesh/facets.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace nereid::mesh {
namespace {

constexpr double equal = 1e-4;  // [-] of the larger: far above round-off, far below a difference that matters

/// Whether the halves on both sides of the diagonal from a to c face the same way, so that it lies inside the face.
bool inside(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 one = (b - a).cross(c - a), other = (c - a).cross(d - a);
  return one.dot(other) > equal * std::max(one.squaredNorm(), other.squaredNorm());
}

bool differ(double a, double b, double scale) { return std::abs(a - b) > equal * scale; }

}  // namespace

Cut cut_of_face(const Vectors& X, const Quadrilateral& corner, const Vec3& middle) {
  const Vec3 a = X.col(corner[0]), b = X.col(corner[1]), c = X.col(corner[2]), d = X.col(corner[3]);
  const Vec3 first = c - a, second = d - b;
  const auto chosen = [](bool is_first) { return is_first ? Cut::first_to_third : Cut::second_to_fourth; };
  const bool first_inside = inside(a, b, c, d), second_inside = inside(b, c, d, a);
  if (first_inside != second_inside) return chosen(first_inside);
  const double lengths[] = {first.norm(), second.norm()}, longer = std::max(lengths[0], lengths[1]);
  if (differ(lengths[0], lengths[1], longer)) return chosen(lengths[0] < lengths[1]);
  // Along fixed directions: generic ones, so that no face of a body along the axes, or at 45 degrees to them, leaves both equal.
  const Vec3 ways[] = {0.25 * (a + b + c + d) - middle, Vec3(1, 0.7549, 0.5698), Vec3(0.5698, 1, -0.7549), Vec3(-0.7549, 0.5698, 1)};
  for (const Vec3& way : ways) {
    const double parts[] = {std::abs(first.dot(way)), std::abs(second.dot(way))};
    if (differ(parts[0], parts[1], longer * way.norm())) return chosen(parts[0] > parts[1]);
  }
  return Cut::first_to_third;
}

}  // namespace nereid::mesh
