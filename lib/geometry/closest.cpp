#include "geometry/closest.hpp"

namespace nereid::geometry {

Closest closest_on_triangle(const std::array<Vector<double>, 3>& x, const Vector<double>& p) {
  const auto found = [&](Kind kind, int local, std::array<double, 3> w) {
    const Vector<double> foot = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
    const Vector<double> away = p - foot;
    return Closest{kind, local, w, dot(away, away)};
  };
  const Vector<double> ab = x[1] - x[0], ac = x[2] - x[0];
  const Vector<double> pa = p - x[0], pb = p - x[1], pc = p - x[2];
  const double d1 = dot(ab, pa), d2 = dot(ac, pa);
  if (d1 <= 0 && d2 <= 0) return found(Kind::vertex, 0, {1, 0, 0});
  const double d3 = dot(ab, pb), d4 = dot(ac, pb);
  if (d3 >= 0 && d4 <= d3) return found(Kind::vertex, 1, {0, 1, 0});
  const double d5 = dot(ab, pc), d6 = dot(ac, pc);
  if (d6 >= 0 && d5 <= d6) return found(Kind::vertex, 2, {0, 0, 1});
  const double area_c = d1 * d4 - d3 * d2;
  if (area_c <= 0 && d1 >= 0 && d3 <= 0) {
    const double s = d1 / (d1 - d3);
    return found(Kind::edge, 0, {1 - s, s, 0});
  }
  const double area_a = d3 * d6 - d5 * d4;
  if (area_a <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return found(Kind::edge, 1, {0, 1 - s, s});
  }
  const double area_b = d5 * d2 - d1 * d6;
  if (area_b <= 0 && d2 >= 0 && d6 <= 0) {
    const double s = d2 / (d2 - d6);
    return found(Kind::edge, 2, {1 - s, 0, s});
  }
  const double total = area_a + area_b + area_c;
  return found(Kind::facet, 0, {area_a / total, area_b / total, area_c / total});
}

}  // namespace nereid::geometry
