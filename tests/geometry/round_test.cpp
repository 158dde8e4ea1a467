#include "geometry/round.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace nereid::geometry::round_test {
namespace {

const std::vector<Round> shapes{{.kind = RoundKind::sphere, .radius = 0.7},
                                {.kind = RoundKind::cylinder, .radius = 0.6, .half_length = 0.4},
                                {.kind = RoundKind::ring, .radius = 0.9, .inner = 0.5, .half_length = 0.3},
                                {.kind = RoundKind::tube, .radius = 0.8, .half_length = 0.4, .half_thickness = 0.05}};

PlacedRound leaning() {
  const Mat3 turn = Eigen::AngleAxisd(0.9, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return {.centre = Vec3(0.3, -0.2, 0.1), .axis = turn.col(2), .across = turn.col(0)};
}

template <class Visit>
void at_random_points(Visit&& visit) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.5, 1.5);
  for (int i = 0; i < 2000; ++i) visit(Vec3(unit(random), unit(random), unit(random)));
}

TEST(Round, TheNormalIsTheGradientOfTheDistanceAndOfUnitLength) {
  for (const Round& shape : shapes)
    at_random_points([&](const Vec3& p) {
      const double step = 1e-6;
      const OverRound here = over_round(shape, leaning(), p);
      EXPECT_NEAR(here.normal.norm(), 1, 1e-14);
      int off = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 way = step * Vec3::Unit(axis);
        const double slope = (over_round(shape, leaning(), p + way).distance - over_round(shape, leaning(), p - way).distance) / (2 * step);
        off += std::abs(slope - here.normal(axis)) > 1e-4;
      }
      const bool has_kink = off > 0;  // inside, where two sides are as near; outside there is none but in bores
      if (has_kink) {
        EXPECT_LT(here.distance, 0.9);
      }
    });
}

TEST(Round, AWayAlongTheNormalLeadsToTheSurface) {
  for (const Round& shape : shapes)
    at_random_points([&](const Vec3& p) {
      const OverRound here = over_round(shape, leaning(), p);
      EXPECT_NEAR(over_round(shape, leaning(), p - here.distance * here.normal).distance, 0, 1e-14);
    });
}

TEST(Round, DistancesAreThoseOfEachSideAndEdge) {
  const PlacedRound at{};
  EXPECT_DOUBLE_EQ(over_round({.kind = RoundKind::sphere, .radius = 2}, at, {0, 3, 0}).distance, 1);
  const Round cylinder{.kind = RoundKind::cylinder, .radius = 2, .half_length = 1};
  EXPECT_DOUBLE_EQ(over_round(cylinder, at, {3, 0, 0.5}).distance, 1);
  EXPECT_DOUBLE_EQ(over_round(cylinder, at, {1, 0, -3}).distance, 2);
  EXPECT_DOUBLE_EQ(over_round(cylinder, at, {5, 0, 5}).distance, 5);
  EXPECT_DOUBLE_EQ(over_round(cylinder, at, {1.9, 0, 0}).distance, 1.9 - 2);
  const Round ring{.kind = RoundKind::ring, .radius = 3, .inner = 2, .half_length = 1};
  EXPECT_DOUBLE_EQ(over_round(ring, at, {0, 1.5, 0}).distance, 0.5);
  EXPECT_EQ(over_round(ring, at, {0, 1.5, 0}).normal, Vec3(0, -1, 0));
  const Round tube{.kind = RoundKind::tube, .radius = 3, .half_length = 1, .half_thickness = 0.25};
  EXPECT_DOUBLE_EQ(over_round(tube, at, {0, 2, 0}).distance, 0.75);
  EXPECT_DOUBLE_EQ(over_round(tube, at, {0, 6, 5}).distance, 4.75);
}

TEST(Round, RimsLieOnTheSurface) {
  for (const Round& shape : shapes)
    for (const Rim& rim : rims(shape))
      for (double angle = 0; angle < 6; angle += 0.5) {
        EXPECT_NEAR(over_round(shape, leaning(), rim_point(rim, leaning(), angle)).distance, -shape.half_thickness, 1e-15);
        EXPECT_NEAR(rim_tangent(leaning(), angle).dot(leaning().axis), 0, 1e-15);
      }
}

TEST(Round, HasARimWhereEachOfItsSidesMeetsEachOfItsEnds) {
  const std::vector<std::vector<double>> radii_of_sides{{}, {0.6}, {0.5, 0.9}, {0.8}};  // of `shapes`
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    std::vector<std::pair<double, double>> expected, found;
    for (const double radius : radii_of_sides[s])
      for (const double end : {-1, 1}) expected.emplace_back(radius, end * shapes[s].half_length);
    for (const Rim& rim : rims(shapes[s])) found.emplace_back(rim.radius, rim.along);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected) << s;
  }
}

TEST(Round, TheAngleOfARimIsThatOfThePointFarthestAlongADirection) {
  const Rim rim{2, 1};
  const Vec3 direction(0.3, -0.7, 0.2);
  const double angle = rim_angle(leaning(), direction), most = rim_point(rim, leaning(), angle).dot(direction);
  for (double other = 0; other < 6.3; other += 0.1) EXPECT_LE(rim_point(rim, leaning(), other).dot(direction), most + 1e-15);
}

TEST(Round, ReachAndRadiiAreThoseOfEachKind) {
  EXPECT_DOUBLE_EQ(reach(shapes[0]), 0.7);
  EXPECT_DOUBLE_EQ(reach({.kind = RoundKind::cylinder, .radius = 3, .half_length = 4}), 5);
  EXPECT_DOUBLE_EQ(outer_radius(shapes[3]), 0.85);
  EXPECT_DOUBLE_EQ(bore_radius(shapes[3]), 0.75);
  EXPECT_DOUBLE_EQ(bore_radius(shapes[2]), 0.5);
  EXPECT_DOUBLE_EQ(bore_radius(shapes[1]), 0);
}

}  // namespace
}  // namespace nereid::geometry::round_test
