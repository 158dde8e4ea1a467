#include "contact/surface/broad_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/height.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact::search_test {
namespace {

using namespace surfaces;

double flat_sheet(double, double) { return 0; }

void agrees_with_trying_all(const Shape& shape, double size) {
  const BaseSurface base = base_of(shape);
  BroadSearch broad(static_cast<Index>(base.facets.cols()));
  broad.sort(base, shape.x);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> unit(-1, 1);
  int none = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vector<double> p{size * unit(random), size * unit(random), size * unit(random)};
    const double reach = size * std::pow(10.0, unit(random)), least = nearest_of_all(base, shape.x, p);
    const Index found = broad.nearest(base, shape.x, p, reach);
    if (least >= reach) {
      EXPECT_EQ(found, -1);
      ++none;
      continue;
    }
    ASSERT_GE(found, 0);
    EXPECT_NEAR(std::sqrt(geometry::closest_on_triangle(corners(base, shape.x, found), p).distance_squared), least, 1e-12);
  }
  EXPECT_GT(none, 10);
}

TEST(BroadSearch, AgreesWithTryingAllOnAPlain) {
  agrees_with_trying_all(sheet(12, 9, [](double, double) { return 0.0; }), 20);
}
TEST(BroadSearch, AgreesWithTryingAllAroundABall) { agrees_with_trying_all(ball(4), 2); }
TEST(BroadSearch, AgreesWithTryingAllInATube) {
  const mesh::Mesh tube = mesh::tube("tube", {1, 6, mesh::Revolution::full, 4, 20});
  agrees_with_trying_all({tube.X, mesh::surface(tube, "tube.inside").facets}, 8);
}
TEST(BroadSearch, AgreesWithTryingAllOverOneFacet) {
  Shape one{Vectors(3, 3), Table<3>(Eigen::Vector3i(0, 1, 2))};
  one.x << 0, 1, 0,
           0, 0, 1,
           0, 0, 0;
  agrees_with_trying_all(one, 3);
}

TEST(BroadSearch, SeesNewPositionsOnlyAfterSorting) {
  Shape shape = sheet(4, 4, [](double, double) { return 0.0; });
  const BaseSurface base = base_of(shape);
  BroadSearch broad(static_cast<Index>(base.facets.cols()));
  broad.sort(base, shape.x);
  EXPECT_GE(broad.nearest(base, shape.x, {2, 2, 0.1}, 1), 0);
  shape.x.row(2).array() += 100;
  broad.sort(base, shape.x);
  EXPECT_EQ(broad.nearest(base, shape.x, {2, 2, 0.1}, 1), -1);
  EXPECT_GE(broad.nearest(base, shape.x, {2, 2, 100.1}, 1), 0);
}

/// Places that no search can make sense of.
std::vector<double> places_without_sense() {
  const double inf = std::numeric_limits<double>::infinity();
  return {std::nan(""), inf, -inf, 1e300, -1e300, 1.1 * farthest_place};
}

TEST(BroadSearch, FindsNothingOnASurfaceWithPositionsThatAreNotFiniteOrTooFar) {
  const Shape shape = sheet(6, 5, flat_sheet);
  const BaseSurface base = base_of(shape);
  for (const double place : places_without_sense()) {
    for (int axis = 0; axis < 3; ++axis) {
      Vectors x = shape.x;
      x(axis, 17) = place;
      BroadSearch broad(static_cast<Index>(base.facets.cols()));
      EXPECT_FALSE(broad.sort(base, x));
      EXPECT_EQ(broad.nearest(base, x, {1, 1, 0.1}, 1e300), -1);
      EXPECT_TRUE(broad.sort(base, shape.x));  // and again where all is well
      EXPECT_GE(broad.nearest(base, shape.x, {1, 1, 0.1}, 1), 0);
      EXPECT_FALSE(broad.sort(base, Vectors::Constant(3, x.cols(), place)));
    }
  }
}

TEST(BroadSearch, FindsNothingForAPointThatIsNotFiniteOrTooFar) {
  const Shape shape = sheet(6, 5, flat_sheet);
  const BaseSurface base = base_of(shape);
  BroadSearch broad(static_cast<Index>(base.facets.cols()));
  broad.sort(base, shape.x);
  for (const double place : places_without_sense()) {
    for (const double reach : {1.0, 1e300, std::numeric_limits<double>::infinity()}) {
      EXPECT_EQ(broad.nearest(base, shape.x, {place, 1, 1}, reach), -1);
      EXPECT_EQ(broad.nearest(base, shape.x, {1, place, 1}, reach), -1);
      EXPECT_EQ(broad.nearest(base, shape.x, {place, place, place}, reach), -1);
    }
  }
}

TEST(BroadSearch, FindsFacetsUpToTheFarthestPlace) {
  Shape shape = sheet(3, 3, flat_sheet);
  shape.x *= farthest_place / 3;
  const BaseSurface base = base_of(shape);
  BroadSearch broad(static_cast<Index>(base.facets.cols()));
  ASSERT_TRUE(broad.sort(base, shape.x));
  EXPECT_GE(broad.nearest(base, shape.x, {1, 1, 1}, 1e300), 0);
  EXPECT_EQ(broad.nearest(base, shape.x, {1, 1, 1}, 0.5), -1);
  shape.x(0, 3) = 1e-200;  // and one facet very much smaller than the way to the others
  ASSERT_TRUE(broad.sort(base, shape.x));
  EXPECT_GE(broad.nearest(base, shape.x, {1, 1, 1}, 1e300), 0);
}

TEST(BroadSearch, EndsOnASurfaceThatHasShrunkToAPoint) {
  const Shape shape = sheet(3, 3, flat_sheet);
  const BaseSurface base = base_of(shape);
  BroadSearch broad(static_cast<Index>(base.facets.cols()));
  const Vectors x = Vectors::Constant(3, shape.x.cols(), 1.0);
  ASSERT_TRUE(broad.sort(base, x));
  EXPECT_GE(broad.nearest(base, x, {9, 1, 1}, 10), 0);
  EXPECT_EQ(broad.nearest(base, x, {9, 1, 1}, 7), -1);
}

}  // namespace
}  // namespace nereid::contact::search_test
