#include "contact/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/check.hpp"
#include "contact/stand.hpp"
#include "geometry/height.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact {
namespace {

using geometry::Kind;
using namespace surfaces;

TEST(BaseSurface, KnowsTheNeighbourAcrossEachEdge) {
  const Shape shape = sheet(4, 3, [](double, double) { return 0.0; });
  const BaseSurface base = base_of(shape);
  int border = 0;
  for (Index f = 0; f < base.facets.cols(); ++f) {
    for (int e = 0; e < 3; ++e) {
      const Index other = base.neighbour(e, f);
      border += other < 0;
      if (other < 0) continue;
      int shared = 0;
      for (int g = 0; g < 3; ++g)
        shared += base.facets(g, other) == base.facets((e + 1) % 3, f) && base.facets((g + 1) % 3, other) == base.facets(e, f);
      EXPECT_EQ(shared, 1);
    }
  }
  EXPECT_EQ(border, 2 * (4 + 3));
}

TEST(BaseSurface, ListsTheFacetsAroundEachNodeInOrder) {
  const Shape shape = ball(2);
  const BaseSurface base = base_of(shape);
  EXPECT_EQ(static_cast<Index>(base.ring.size()), 3 * base.facets.cols());
  for (Index n = 0; n + 1 < static_cast<Index>(base.ring_begin.size()); ++n) {
    EXPECT_TRUE(std::is_sorted(base.ring.begin() + base.ring_begin[n], base.ring.begin() + base.ring_begin[n + 1]));
    for (Index r = base.ring_begin[n]; r < base.ring_begin[n + 1]; ++r)
      EXPECT_TRUE((base.facets.col(base.ring[r]).array() == n).any());
  }
}

TEST(BaseSurface, OfAClosedBodyHasNoBorder) {
  EXPECT_GE(base_of(ball(2)).neighbour.minCoeff(), 0);
}

TEST(BaseSurface, OfOneFacetIsAllBorder) {
  const BaseSurface base = base_surface({"one", Table<3>(Eigen::Vector3i(0, 1, 2))}, Mat3::Identity());
  EXPECT_EQ(base.neighbour.maxCoeff(), -1);
}

TEST(BaseSurface, RefusesAnEdgeWithThreeFacets) {
  Table<3> facets(3, 3);
  facets << 0, 1, 0,
            1, 0, 1,
            2, 3, 4;
  EXPECT_THROW(base_surface({"book", facets}, Vectors::Random(3, 5)), InternalError);
}

TEST(BaseSurface, RefusesNeighboursThatDisagreeAboutTheirSide) {
  Table<3> facets(3, 2);
  facets << 0, 0,
            1, 1,
            2, 3;
  EXPECT_THROW(base_surface({"fold", facets}, Vectors::Random(3, 4)), InternalError);
}

/// Distance to the nearest facet, by looking at all.
double nearest_of_all(const BaseSurface& base, const Vectors& x, const Vector<double>& p) {
  double least = 1e300;
  for (Index f = 0; f < base.facets.cols(); ++f)
    least = std::min(least, geometry::closest_on_triangle(corners(base, x, f), p).distance_squared);
  return std::sqrt(least);
}

/// The distance from where a walk ends.
double distance_of(const Stand& end) { return std::hypot(end.over.height, end.past); }

/// From every facet that faces the point, for points about `off` away from random places of the
/// surface. On the back of a faceted ball a walk may end: seen from there the facet opposite is the
/// nearest around, as it is no sphere.
void walks_to_the_closest(const Shape& shape, double off, double low_side, double in_valleys = 0) {
  const BaseSurface base = base_of(shape);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  int walked = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto c = corners(base, shape.x, static_cast<Index>(unit(random) * base.facets.cols()));
    const double a = unit(random), b = (1 - a) * unit(random);
    const Vector<double> n = cross(c[1] - c[0], c[2] - c[0]);
    const double h = off * (low_side + (1 - low_side) * unit(random));
    const Vector<double> p = (1 - a - b) * c[0] + a * c[1] + b * c[2] + (h / norm(n)) * n;
    const double least = nearest_of_all(base, shape.x, p);
    for (Index from = 0; from < base.facets.cols(); ++from) {
      if (geometry::facet_height(corners(base, shape.x, from), p).height < 0 && low_side == 0) continue;
      const Stand end = stand(base, shape.x, {p.x, p.y, p.z}, from);
      const bool on_a_flank = in_valleys > 0 && end.feature.kind == Kind::facet;
      EXPECT_NEAR(std::abs(distance_of(end)), least, on_a_flank ? in_valleys * least : 1e-9);
      walked += end.feature.facet != from;
    }
  }
  EXPECT_GT(walked, 200);
}

TEST(Stand, IsOverTheClosestFeatureOfAPlain) {
  walks_to_the_closest(sheet(8, 6, [](double, double) { return 0.0; }), 0.3, -1);
}
TEST(Stand, IsOverTheClosestFeatureOfARidge) {
  walks_to_the_closest(sheet(8, 6, [](double x, double) { return -0.8 * std::abs(x - 4); }), 0.5, 0);
}
TEST(Stand, IsOverTheClosestFeatureOfAShallowValley) {
  walks_to_the_closest(sheet(8, 6, [](double x, double) { return 0.2 * std::abs(x - 4); }), 0.3, 0);
}
TEST(Stand, IsOverTheClosestFeatureOutsideABall) { walks_to_the_closest(ball(3), 1.0, 0); }
TEST(Stand, InsideATubeIsOverAFlankThatOwnsTheApex) {
  // in a valley Eq. 14 holds for both flanks; their heights differ by less than the angle's square
  const mesh::Mesh tube = mesh::tube("tube", {1, 1, mesh::Revolution::quarter, 4, 5});
  walks_to_the_closest({tube.X, mesh::surface(tube, "tube.inside").facets}, 0.02, 0, 0.02);
}
TEST(Stand, IsOverTheClosestFeatureOutsideATube) {
  const mesh::Mesh tube = mesh::tube("tube", {1, 1, mesh::Revolution::full, 3, 5});
  walks_to_the_closest({tube.X, mesh::surface(tube, "tube.outside").facets}, 0.5, 0);
}
TEST(Stand, IsOverTheClosestFeatureOfTheSideOfABox) {
  const mesh::Mesh box = mesh::box("box", {Vec3::Zero(), Vec3(1, 1, 1), {3, 3, 3}});
  walks_to_the_closest({box.X, mesh::surface(box, "box.z_high").facets}, 0.5, 0);
}

/// The skin of a box of 3 x 3 x 1 cells, 0.3 thick.
Shape skin() {
  const mesh::Mesh box = mesh::box("box", {Vec3::Zero(), Vec3(1, 1, 0.3), {3, 3, 1}});
  Shape shape{box.X, Table<3>(3, 0)};
  for (const char* side : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) {
    const Table<3>& facets = mesh::surface(box, std::string("box.") + side).facets;
    shape.facets.conservativeResize(3, shape.facets.cols() + facets.cols());
    shape.facets.rightCols(facets.cols()) = facets;
  }
  return shape;
}
Index facet_below(const BaseSurface& base, const Vectors& x, const Vec3& point, const Vec3& normal) {
  for (Index f = 0; f < base.facets.cols(); ++f) {
    const FeatureHeight over = height_over(base, x, {f, Kind::facet, 0}, point);
    if (over.normal.dot(normal) > 0.9 && *std::min_element(over.weight.begin(), over.weight.end()) >= 0) return f;
  }
  return -1;
}

TEST(BaseSurface, HasWallsAtTheEdgesOfABoxAndNoneElsewhere) {
  const Shape shape = skin();
  const BaseSurface base = base_of(shape);
  int walls = 0;
  for (Index f = 0; f < base.facets.cols(); ++f)
    for (int e = 0; e < 3; ++e) {
      const double cosine = facet_normal(base, shape.x, f).dot(facet_normal(base, shape.x, base.neighbour(e, f)));
      EXPECT_EQ(base.wall[f][e], cosine < 0.5);
      walls += base.wall[f][e];
    }
  EXPECT_EQ(walls, 2 * (8 * 3 + 4));
}

TEST(BaseSurface, KnowsTheMaterialBehindEachFacet) {
  const Shape shape = skin();
  const BaseSurface base = base_of(shape);
  for (Index f = 0; f < base.facets.cols(); ++f)
    EXPECT_NEAR(base.thickness(f), std::abs(facet_normal(base, shape.x, f).z()) > 0.5 ? 0.3 : 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(base_of(sheet(2, 2, [](double, double) { return 0.0; })).thickness(0)));
}

TEST(Stand, PastAWallIsOverThePlaneOfItsFacet) {
  const Shape shape = skin();
  const BaseSurface base = base_of(shape);
  const Index top = facet_below(base, shape.x, {0.9, 0.4, 0.3}, Vec3::UnitZ());
  const Stand end = stand(base, shape.x, {1.02, 0.4, 0.25}, top);
  EXPECT_NEAR(end.over.height, -0.05, 1e-14);
  EXPECT_NEAR(end.past, 0.02, 1e-14);
  EXPECT_NEAR(end.outward.x(), 1, 1e-14);
  EXPECT_NEAR(end.over.normal.z(), 1, 1e-14);
}

TEST(Stand, StaysOnItsSideOfAThinBody) {
  const Shape shape = skin();
  const BaseSurface base = base_of(shape);
  const Index top = facet_below(base, shape.x, {0.5, 0.4, 0.3}, Vec3::UnitZ());
  const Stand end = stand(base, shape.x, {0.52, 0.4, 0.02}, top);  // the bottom is nearer
  EXPECT_NEAR(end.over.height, -0.28, 1e-14);
}

TEST(Stand, OverAPlainKeepsToTheFacetInUseAtItsBorder) {
  const Shape shape = sheet(4, 4, [](double, double) { return 0.0; });
  const BaseSurface base = base_of(shape);
  const Index node = 12;
  for (Index r = base.ring_begin[node]; r < base.ring_begin[node + 1]; ++r)
    EXPECT_EQ(stand(base, shape.x, Vec3(shape.x.col(node)) + Vec3(0, 0, 0.1), base.ring[r]).feature.facet, base.ring[r]);
}

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
}  // namespace nereid::contact
