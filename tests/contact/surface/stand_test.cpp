#include "contact/surface/stand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "geometry/height.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact::stand_test {
namespace {

using geometry::Kind;
using namespace surfaces;

Index facet_below(const BaseSurface& base, const Vectors& x, const Vec3& point, const Vec3& normal) {
  for (Index f = 0; f < base.facets.cols(); ++f) {
    const FeatureHeight over = height_over(base, x, {f, Kind::facet, 0}, point);
    if (over.normal.dot(normal) > 0.9 && *std::min_element(over.weight.begin(), over.weight.end()) >= 0) return f;
  }
  return -1;
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

TEST(Stand, SeesTheOtherFlankOfASharpValleyFromARowAwayFromItsBottom) {
  // flanks of 80 degrees, four rows each: where the other flank is near, no facet around this one turns
  const double slope = 5.67;
  const Shape shape = sheet(8, 6, [&](double x, double) { return slope * std::abs(x - 4); });
  const BaseSurface base = base_of(shape);
  const Vec3 normal = Vec3(-slope, 0, 1).normalized(), foot(5.2, 3.3, slope * 1.2), p = foot + 2.2 * normal;
  const Index from = facet_below(base, shape.x, p, normal);
  ASSERT_GE(from, 0);
  const Stand end = stand(base, shape.x, p, from);
  EXPECT_NEAR(distance_of(end), nearest_of_all(base, shape.x, {p.x(), p.y(), p.z()}), 1e-12);
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

/// Goes around the corner of a warped face, past both of its borders: the height has no jump, and does not depend on the way there.
void turns_around_a_corner(double warp) {
  const Shape shape = sheet(1, 1, [&](double x, double y) { return warp * (x + y - 2 * x * y); });
  const BaseSurface base = base_of(shape);
  double least = 1, largest = -1, before = 0;
  for (int degree = 165; degree <= 285; ++degree) {
    const double angle = degree * std::acos(-1.0) / 180;
    const Vec3 p(0.03 * std::cos(angle), 0.03 * std::sin(angle), -0.001);
    const double height = stand(base, shape.x, p, 0).over.height;
    EXPECT_NEAR(stand(base, shape.x, p, 1).over.height, height, 1e-15);
    if (degree > 165) {
      EXPECT_NEAR(height, before, 1.5 * std::abs(warp) * 0.03 * std::acos(-1.0) / 180) << degree;
    }
    before = height, least = std::min(least, height), largest = std::max(largest, height);
  }
  EXPECT_GT(largest - least, 0.2 * std::abs(warp) * 0.03);
}
TEST(Stand, PastACornerOfAWarpedFaceHasNoJump) {
  turns_around_a_corner(0.1);
  turns_around_a_corner(-0.1);
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

}  // namespace
}  // namespace nereid::contact::stand_test
