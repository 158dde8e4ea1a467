#include "contact/surface/nearer.hpp"

#include <limits>

#include "contact/search/near.hpp"
#include "tests/contact/pressed.hpp"

namespace nereid::contact::nearer_test {
namespace {

using namespace pressed;

/// Two flanks of a ridge along y, the left one steeper: its normal leads to the left.
Shape roof(bool left_first) {
  Shape shape{Vectors(3, 4), Table<3>(3, 2)};
  shape.x.col(0) = Vec3(0, -1, 0), shape.x.col(1) = Vec3(0, 1, 0), shape.x.col(2) = Vec3(-0.5, 0, -2), shape.x.col(3) = Vec3(2, 0, -1);
  const Eigen::Vector3i left(0, 1, 2), right(0, 3, 1);
  shape.facets.col(0) = left_first ? left : right, shape.facets.col(1) = left_first ? right : left;
  return shape;
}

/// The normal along x of the facet that is nearest to a point.
double side_of(const Vec3& point, bool left_first) {
  const Shape shape = roof(left_first);
  const Interface interface = interface_over(shape, 1);
  Vectors x(3, 5);
  x.leftCols(4) = shape.x, x.col(4) = point;
  const Subset all{0, 1};
  const Nearest nearest = nearest_of(interface, x, 0, all);
  EXPECT_NEAR(nearest.distance(), Vec3(point.x(), 0, point.z()).norm(), 1e-15);
  return facet_normal(interface.base, x, nearest.feature.facet).x();
}

TEST(IsNearer, GoesByDistanceAndOfFacetsThatAreAsNearByWhichFacesThePoint) {
  const Shape shape = roof(true);
  const Interface interface = interface_over(shape, 1);
  const auto is = [&](Index facet, double gap, Index other, double other_gap) {
    return is_nearer(interface.base, shape.x, {-0.1, 0.2, 0.2}, facet, gap, other, other_gap);
  };
  EXPECT_TRUE(is(1, 5, -1, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(is(1, 0.1, 0, 0.2));
  EXPECT_FALSE(is(0, 0.2, 1, 0.1));
  EXPECT_TRUE(is(0, 0.1 + 1e-12, 1, 0.1));  // the left one faces it
  EXPECT_FALSE(is(1, 0.1 - 1e-12, 0, 0.1));
}

TEST(IsNearer, AnApexOverARidgeBelongsToTheSideThatFacesItWhateverTheNumbers) {
  for (const double x : {-0.3, -0.1, 0.15}) {
    const double here = side_of({x, 0.2, 0.4}, true);
    EXPECT_EQ(here, side_of({x, 0.2, 0.4}, false)) << x;
    for (const double nudge : {1e-12, -1e-12}) EXPECT_NEAR(here, side_of({x + nudge, 0.2 + nudge, 0.4 - nudge}, true), 1e-9) << x;
  }
  EXPECT_LT(side_of({-0.3, 0.2, 0.2}, true), 0);
  EXPECT_GT(side_of({0.15, 0.2, 0.4}, true), 0);
}

}  // namespace
}  // namespace nereid::contact::nearer_test
