#include "geometry/crossing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "base/dual.hpp"

namespace nereid::geometry::crossing_test {
namespace {

using Point = Vector<double>;

/// Four random points; the second edge is turned towards the first until the sine between them is `sine`.
std::array<Point, 4> edges(std::mt19937& random, double sine) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Point{unit(random), unit(random), unit(random)}; };
  std::array<Point, 4> x{point(), point(), point(), point()};
  const Point L = x[1] - x[0], aside = cross(L, point());
  const Point way = L + (sine / std::sqrt(1 - sine * sine) * norm(L) / norm(aside)) * aside;
  if (sine < 1) x[3] = x[2] + way;
  return x;
}

TEST(Crossing, ItsGradientMatchesDualNumbers) {
  std::mt19937 random(3);
  for (const double sine : {1.0, 0.7, 0.1, 0.01}) {
    for (int trial = 0; trial < 200; ++trial) {
      const auto x = edges(random, sine);
      using D = Dual<12>;
      std::array<Vector<D>, 4> y;
      for (int I = 0; I < 4; ++I)
        for (int i = 0; i < 3; ++i) y[I][i] = D::variable(x[I][i], 3 * I + i);
      const Crossing<double> at = crossing(x[0], x[1], x[2], x[3]);
      const D h = crossing(y[0], y[1], y[2], y[3]).height;
      const double weight[] = {1 - at.first, at.first, at.second - 1, -at.second};
      const double size = 1 + std::abs(at.first) + std::abs(at.second);
      const double angle = norm(cross(x[1] - x[0], x[3] - x[2])) / (norm(x[1] - x[0]) * norm(x[3] - x[2]));
      for (int I = 0; I < 4; ++I)
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(weight[I] * at.normal[i], h.by[3 * I + i], 1e-13 * size / (angle * angle)) << sine;
    }
  }
}

TEST(Crossing, HasNoNetForceAndNoNetMoment) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const auto x = edges(random, 1);
    const Crossing<double> at = crossing(x[0], x[1], x[2], x[3]);
    const double weight[] = {1 - at.first, at.first, at.second - 1, -at.second};
    Point force{}, moment{};
    for (int I = 0; I < 4; ++I) force = force + weight[I] * at.normal, moment = moment + weight[I] * cross(x[I], at.normal);
    const double size = 1 + std::abs(at.first) + std::abs(at.second);
    EXPECT_LT(norm(force), 1e-15 * size);
    EXPECT_LT(norm(moment), 1e-13 * size * size);
  }
}

TEST(Crossing, ItsHeightIsThatOfTheTetrahedron) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 50; ++trial) {
    const auto x = edges(random, 1);
    const Point L1 = x[1] - x[0], L2 = x[3] - x[2];
    const double six_volumes = dot(cross(L1, L2), x[0] - x[2]);
    const Crossing<double> at = crossing(x[0], x[1], x[2], x[3]);
    EXPECT_NEAR(at.height, six_volumes / norm(cross(L1, L2)), 1e-14);
    const Point between = x[0] + at.first * L1 - x[2] - at.second * L2 - at.height * at.normal;
    EXPECT_LT(norm(between), 1e-12 * (1 + std::abs(at.first) + std::abs(at.second)));
  }
}

TEST(SegmentsSquared, IsTheLeastOfAllPairsOfPoints) {
  std::mt19937 random(6);
  for (const double sine : {1.0, 0.5, 0.0}) {
    for (int trial = 0; trial < 30; ++trial) {
      const auto x = edges(random, sine);
      constexpr int parts = 200;
      double least = 1e300;
      for (int i = 0; i <= parts; ++i)
        for (int j = 0; j <= parts; ++j) {
          const Point d = x[0] + (1.0 * i / parts) * (x[1] - x[0]) - x[2] - (1.0 * j / parts) * (x[3] - x[2]);
          least = std::min(least, dot(d, d));
        }
      const double found = segments_squared(x[0], x[1], x[2], x[3]);
      EXPECT_LE(found, least + 1e-14);
      EXPECT_GT(std::sqrt(found), std::sqrt(least) - 2.0 * norm(x[1] - x[0]) / parts - 2.0 * norm(x[3] - x[2]) / parts);
    }
  }
}

}  // namespace
}  // namespace nereid::geometry::crossing_test
