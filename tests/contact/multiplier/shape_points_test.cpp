#include "contact/multiplier/shape_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace nereid::contact::shape_points_test {
namespace {

using geometry::PlacedRound;
using geometry::Round;
using geometry::RoundKind;

const Round sphere{.kind = RoundKind::sphere, .radius = 0.5};
const Round cylinder{.kind = RoundKind::cylinder, .radius = 0.3, .half_length = 0.4};
const Round tube{.kind = RoundKind::tube, .radius = 1, .half_length = 0.8, .half_thickness = 0.05};

/// Axis along y.
PlacedRound lying(const Vec3& centre) { return {.centre = centre, .axis = Vec3::UnitY(), .across = Vec3::UnitX()}; }

double least(const std::vector<Spot>& spots) {
  double gap = infinite;
  for (const Spot& spot : spots) gap = std::min(gap, spot.gap);
  return gap;
}

TEST(ShapePoints, ASphereTouchesAFacetAtTheFootOfItsCentre) {
  const std::array<Vec3, 3> corner{Vec3(-1, -1, 0), Vec3(2, -1, 0), Vec3(-1, 2, 0)};
  std::vector<Spot> spots;
  spots_on_facet(sphere, {.centre = Vec3(0.1, 0.2, 0.6)}, corner, false, false, spots);
  ASSERT_EQ(spots.size(), 1);
  EXPECT_NEAR(spots[0].gap, 0.1, 1e-15);
  EXPECT_LT((spots[0].place - Vec3(0.1, 0.2, 0)).norm(), 1e-15);
  EXPECT_LT((spots[0].normal + Vec3::UnitZ()).norm(), 1e-15);
  Vec3 foot = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i) foot += spots[0].weight[i] * corner[i];
  EXPECT_LT((foot - spots[0].place).norm(), 1e-15);
  spots.clear();
  spots_on_facet(sphere, {.centre = Vec3(3, 3, 0.6)}, corner, false, false, spots);
  EXPECT_TRUE(spots.empty());
  spots_on_facet(sphere, {.centre = Vec3(0, 0, -0.6)}, corner, false, false, spots);  // behind a solid
  EXPECT_TRUE(spots.empty());
  spots_on_facet(sphere, {.centre = Vec3(0, 0, -0.6)}, corner, true, false, spots);
  ASSERT_EQ(spots.size(), 1);
  EXPECT_NEAR(spots[0].gap, 0.1, 1e-15);
}

TEST(ShapePoints, ACylinderTouchesAPlaneAtTheDeepestPointsOfItsRims) {
  std::vector<Spot> spots;
  spots_on_plane(cylinder, lying({0, 0, 0.35}), Vec3::Zero(), Vec3::UnitZ(), spots);
  ASSERT_EQ(spots.size(), 2);
  for (const Spot& spot : spots) {
    EXPECT_NEAR(spot.gap, 0.05, 1e-15);
    EXPECT_NEAR(spot.place.x(), 0, 1e-15);
    EXPECT_NEAR(std::abs(spot.place.y()), 0.4, 1e-15);
  }
  spots.clear();
  spots_on_plane(cylinder, {.centre = Vec3(0, 0, 0.4)}, Vec3::Zero(), Vec3::UnitZ(), spots);  // it stands
  EXPECT_EQ(std::count_if(spots.begin(), spots.end(), [](const Spot& spot) { return std::abs(spot.gap) < 1e-15; }), points_of_rim);
}

TEST(ShapePoints, AnEdgeThatIsCrossedHasTheDistanceOfTheLines) {
  std::vector<Spot> spots;
  spots_on_edge(cylinder, lying({0, 0, 0}), {Vec3(-1, 0.1, -0.5), Vec3(0.7, 0.2, -0.5)}, spots);
  ASSERT_EQ(spots.size(), 1);
  EXPECT_NEAR(spots[0].gap, 0.2, 1e-15);
  EXPECT_LT((spots[0].normal + Vec3::UnitZ()).norm(), 1e-7);
  spots.clear();
  spots_on_edge(sphere, {.centre = Vec3::Zero()}, {Vec3(-1, 0, 0.7), Vec3(1, 0, 0.7)}, spots);
  ASSERT_EQ(spots.size(), 1);
  EXPECT_NEAR(spots[0].gap, 0.2, 1e-15);
}

TEST(ShapePoints, AnEdgeUnderAnEndTouchesWhereItPassesTheRim) {
  std::vector<Spot> spots;
  spots_on_edge(cylinder, {.centre = Vec3(0, 0, 0.45)}, {Vec3(-1, 0.1, 0), Vec3(1, 0.1, 0)}, spots);
  const double half = std::sqrt(0.09 - 0.01);
  std::vector<double> places;
  for (const Spot& spot : spots)
    if (std::abs(spot.gap - 0.05) < 1e-9) places.push_back(spot.place.x());
  std::sort(places.begin(), places.end());
  ASSERT_GE(places.size(), 2);
  EXPECT_NEAR(places.front(), -half, 1e-12);
  EXPECT_NEAR(places.back(), half, 1e-12);
}

TEST(ShapePoints, AnEdgeAlongTheAxisTouchesAtTheEndsOfTheSide) {
  std::vector<Spot> spots;
  spots_on_edge(cylinder, lying({0, 0, 0.31}), {Vec3(0, -1, 0), Vec3(0, 1, 0)}, spots);
  ASSERT_EQ(spots.size(), 2);
  for (const Spot& spot : spots) EXPECT_NEAR(spot.gap, 0.01, 1e-9);
}

TEST(ShapePoints, SpheresAndShapesTouchAlongTheLineFromTheCentre) {
  std::vector<Spot> spots;
  spots_between(sphere, {.centre = Vec3(0, 0, 0)}, sphere, {.centre = Vec3(0, 1.2, 0)}, spots);
  ASSERT_EQ(spots.size(), 1);
  EXPECT_NEAR(spots[0].gap, 0.2, 1e-15);
  EXPECT_LT((spots[0].normal - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((spots[0].place - Vec3(0, 0.6, 0)).norm(), 1e-15);
  spots.clear();
  spots_between(sphere, {.centre = Vec3(0, 0.1, -0.4)}, tube, lying({0, 0, 0}), spots);  // in the bore
  EXPECT_NEAR(spots[0].gap, 0.95 - 0.4 - 0.5, 1e-15);
  EXPECT_LT((spots[0].normal + Vec3::UnitZ()).norm(), 1e-15);
  spots.clear();
  spots_between(tube, lying({0, 0, 0}), sphere, {.centre = Vec3(0, 0.1, -0.4)}, spots);
  EXPECT_LT((spots[0].normal - Vec3::UnitZ()).norm(), 1e-15);
}

TEST(ShapePoints, ACylinderInATubeTouchesAtBothEndsOfWhatTheyHaveTogether) {
  std::vector<Spot> spots;
  spots_between(cylinder, lying({0, 0.1, -0.6}), tube, lying({0, 0, 0}), spots);
  std::vector<Spot> touching;
  for (const Spot& spot : spots)
    if (spot.gap < 0.2) touching.push_back(spot);
  ASSERT_EQ(touching.size(), 2);
  for (const Spot& spot : touching) {
    EXPECT_NEAR(spot.gap, 0.05, 1e-15);
    EXPECT_LT((spot.normal + Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(spot.place.x(), 0, 1e-12);
  }
  EXPECT_NEAR(std::abs(touching[0].place.y() - touching[1].place.y()), 0.8, 1e-12);
}

TEST(ShapePoints, TiltedCylindersInATubeTouchWithTheExactLeastDistance) {
  const Vec3 axis = Vec3(0.02, 1, 0.05).normalized();
  const PlacedRound at{.centre = Vec3(0.01, 0, -0.6), .axis = axis, .across = axis.unitOrthogonal()};
  std::vector<Spot> spots;
  spots_between(cylinder, at, tube, lying({0, 0, 0}), spots);
  double sampled = infinite;  // by points of both rims
  for (const geometry::Rim& rim : geometry::rims(cylinder))
    for (int i = 0; i < 100000; ++i)
      sampled = std::min(sampled, geometry::over_round(tube, lying({0, 0, 0}), geometry::rim_point(rim, at, 2 * pi * i / 100000)).distance);
  EXPECT_NEAR(least(spots), sampled, 1e-9);
  EXPECT_LE(least(spots), sampled + 1e-15);
}

TEST(ShapePoints, CylindersBesideEachOtherTouchAtEndsAndCrossedOnesBetween) {
  std::vector<Spot> spots;
  spots_between(cylinder, lying({0, 0, 0}), cylinder, lying({0.65, 0.1, 0}), spots);
  EXPECT_NEAR(least(spots), 0.05, 1e-14);
  EXPECT_GE(std::count_if(spots.begin(), spots.end(), [](const Spot& spot) { return spot.gap < 0.0500001; }), 2);
  spots.clear();
  const PlacedRound across{.centre = Vec3(0.1, 0.1, 0.7), .axis = Vec3::UnitX(), .across = Vec3::UnitY()};
  spots_between(cylinder, lying({0, 0, 0}), cylinder, across, spots);
  EXPECT_NEAR(least(spots), 0.1, 1e-15);
}

TEST(ShapePoints, CrossedCylindersOfUnlikeLengthHaveTheExactLeastDistanceInBothOrders) {
  const Round lengthy{.kind = RoundKind::cylinder, .radius = 0.2, .half_length = 2};
  for (const double y : {0.1, 0.6})           // where the axes cross: along the short one, whose half length is 0.4
    for (const double x : {0.1, 1.5, 2.2}) {  // and along the long one
      const PlacedRound at = lying({0, 0, 0}), there{.centre = Vec3(-x, y, 0.7), .axis = Vec3::UnitX(), .across = Vec3::UnitY()};
      const bool crosses = y < cylinder.half_length && x < lengthy.half_length;
      double exact = crosses ? 0.7 - cylinder.radius - lengthy.radius : infinite;
      for (int i = 0; i < 100000; ++i) {
        const double angle = 2 * pi * i / 100000;
        for (const geometry::Rim& rim : geometry::rims(cylinder))
          exact = std::min(exact, geometry::over_round(lengthy, there, geometry::rim_point(rim, at, angle)).distance);
        for (const geometry::Rim& rim : geometry::rims(lengthy))
          exact = std::min(exact, geometry::over_round(cylinder, at, geometry::rim_point(rim, there, angle)).distance);
      }
      std::vector<Spot> one, other;
      spots_between(cylinder, at, lengthy, there, one);
      spots_between(lengthy, there, cylinder, at, other);
      EXPECT_NEAR(least(one), exact, 1e-9) << y << " " << x;
      EXPECT_NEAR(least(other), exact, 1e-9) << y << " " << x;
    }
}

TEST(ShapePoints, StackedCylindersHaveAllOfARim) {
  std::vector<Spot> spots;
  spots_between(cylinder, {.centre = Vec3::Zero()}, cylinder, {.centre = Vec3(0, 0, 0.81)}, spots);
  int flat = 0;
  for (const Spot& spot : spots) {
    if (std::abs(spot.gap - 0.01) > 1e-12) continue;
    ++flat;
    EXPECT_LT((spot.normal - Vec3::UnitZ()).norm(), 1e-7);
  }
  EXPECT_GE(flat, points_of_rim);
}

TEST(ShapePoints, FrictionOfAPointActsWithTheMomentOfItsPlace) {
  ShapePoint point;
  point.nodes = 2, point.node = {0, 1}, point.weight = point.rub_weight = {1, -1}, point.normal = Vec3::UnitZ();
  const Touch touch = touch_of(point);
  Vectors v(3, 2);
  v.col(0) = Vec3(1, 2, 3), v.col(1) = Vec3(0.5, 0, 0);
  EXPECT_EQ(slip_rate(touch, v, Vectors(3, 0), {}), Vec3(0.5, 2, 0));
  const FrictionShares shares = share_friction(touch, Vec3(4, 5, 0));
  ASSERT_EQ(shares.count, 2);
  EXPECT_EQ(shares.force[0], Vec3(4, 5, 0));
  EXPECT_EQ(shares.force[1], Vec3(-4, -5, 0));
  EXPECT_EQ(relative(point, v), Vec3(0.5, 2, 3));
}

}  // namespace
}  // namespace nereid::contact::shape_points_test
