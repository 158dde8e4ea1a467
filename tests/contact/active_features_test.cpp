#include "contact/active_features.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/contact/surfaces.hpp"

namespace nereid::contact {
namespace {

using geometry::Kind;
using surfaces::base_of;
using surfaces::sheet;
using surfaces::Shape;

/// ActiveFeatures on an apex over a shape, from facet 0.
ActiveFeatures active(const Shape& shape, const BaseSurface& base, const Vec3& apex, const Mat3* allowed = nullptr) {
  const Vector<double> p{apex.x(), apex.y(), apex.z()};
  const WalkEnd end = walk(base, shape.x, p, 0);
  return active_features_on(base, shape.x, p, end, std::sqrt(end.closest.distance_squared), allowed);
}
ActiveFeatures active(const Shape& shape, const Vec3& apex) { return active(shape, base_of(shape), apex); }

TEST(ActiveFeatures, OnAPlainAreMadeByOneFacet) {
  const ActiveFeatures found = active(sheet(4, 4, [](double, double) { return 0.0; }), {1.3, 2.6, 0.1});
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.feature[0].kind, Kind::facet);
  EXPECT_NEAR(found.at[0].height, 0.1, 1e-15);
}

TEST(ActiveFeatures, OnARidgeAreMadeByItsEdge) {
  const ActiveFeatures found = active(sheet(4, 4, [](double x, double) { return -std::abs(x - 2); }), {2, 2.4, 0.1});
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.feature[0].kind, Kind::edge);
  EXPECT_NEAR(found.at[0].height, 0.1, 1e-15);
}

TEST(ActiveFeatures, AtAPeakAreMadeByItsVertex) {
  const ActiveFeatures found = active(sheet(4, 4, [](double x, double y) { return -std::abs(x - 2) - std::abs(y - 2); }), {2, 2, 0.1});
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.feature[0].kind, Kind::vertex);
}

TEST(ActiveFeatures, InAValleyAreMadeByBothFlanks) {
  const ActiveFeatures found = active(sheet(4, 4, [](double x, double) { return std::abs(x - 2); }), {2.01, 2.4, 0.1});
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(found.at[0].normal.dot(found.at[1].normal), 0, 1e-15);
}

TEST(ActiveFeatures, BehindTheBorderAreMadeByNone) {
  EXPECT_EQ(active(sheet(4, 4, [](double, double) { return 0.0; }), {4.2, 2.4, 0.1}).count, 0);
}

TEST(Border, EndsTheSurfaceWhereItLiesInNoSymmetryPlane) {
  // planes x = 0 and y = 0; the sheet ends at x = 4 and y = 4
  const Shape shape = sheet(4, 4, [](double, double) { return 0.0; });
  BaseSurface base = base_of(shape);
  const auto ends_at = [&](double x, double y, Kind kind) {
    const Vector<double> p{x, y, 1};
    const WalkEnd end = walk(base, shape.x, p, 0);
    EXPECT_EQ(end.closest.kind, kind) << x << ' ' << y;
    EXPECT_TRUE(on_border(base, end.feature.facet, end.closest)) << x << ' ' << y;
    return at_end(base, end.feature.facet, end.closest);
  };
  for (const double y : {0.0, 2.0, 7.0}) EXPECT_TRUE(ends_at(0, y, Kind::vertex)) << y;
  goes_on_behind(base, {0, 5, 10, 15, 20});  // x = 0
  EXPECT_TRUE(ends_at(0, 0, Kind::vertex));
  EXPECT_FALSE(ends_at(0, 1, Kind::vertex));
  EXPECT_FALSE(ends_at(0, 1.7, Kind::edge));
  goes_on_behind(base, {0, 1, 2, 3, 4});  // y = 0
  EXPECT_FALSE(ends_at(0, 0, Kind::vertex));
  EXPECT_TRUE(ends_at(0, 7, Kind::vertex));
  EXPECT_TRUE(ends_at(7, 0, Kind::vertex));
}

TEST(Border, InASymmetryPlaneIsARidgeToTheImageAlsoAtItsVertices) {
  // a dome cut at x = 0, and the whole of it; the apex is past a vertex by 3 % of a facet along the plane
  const auto dome = [](double x, double y) { return -0.2 * (x * x + (y - 2) * (y - 2)); };
  Shape whole = sheet(8, 4, [&](double x, double y) { return dome(x - 4, y); });
  whole.x.row(0).array() -= 4;
  const Shape half = sheet(4, 4, dome);
  BaseSurface base = base_of(half);
  goes_on_behind(base, {0, 5, 10, 15, 20});
  const Mat3 allowed = Vec3(0, 1, 1).asDiagonal();
  const Vec3 apex(0, 2.03, 0.3);
  const ActiveFeatures full = active(whole, apex), cut = active(half, base, apex, &allowed);
  ASSERT_EQ(full.count, 1);
  EXPECT_EQ(full.feature[0].kind, Kind::vertex);
  ASSERT_EQ(cut.count, 1);
  EXPECT_EQ(cut.feature[0].kind, Kind::vertex);
  EXPECT_EQ(cut.at[0].height, full.at[0].height);
}

TEST(ActiveFeatures, KeepTheLowestWhenThereAreTooMany) {
  ActiveFeatures full;
  for (int i = 0; i < most_candidates + 3; ++i) full.add({i, Kind::facet, 0}, {1.0 - 0.01 * i, Vec3::UnitZ(), {1, 0, 0}});
  ASSERT_EQ(full.count, most_candidates);
  for (int i = 0; i < full.count; ++i) EXPECT_GE(full.feature[i].facet, 3);
}

}  // namespace
}  // namespace nereid::contact
