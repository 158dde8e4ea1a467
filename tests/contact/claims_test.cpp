#include "contact/claims.hpp"

#include <gtest/gtest.h>

#include "tests/contact/surfaces.hpp"

namespace nereid::contact {
namespace {

using geometry::Kind;
using surfaces::sheet;
using surfaces::Shape;

/// Claims on an apex over a shape, from facet 0.
Claims claims(const Shape& shape, const Vec3& apex) {
  const BaseSurface base = base_surface({"base", shape.facets}, static_cast<Index>(shape.x.cols()));
  const Vector<double> p{apex.x(), apex.y(), apex.z()};
  const WalkEnd end = walk(base, shape.x, p, 0);
  return claims_on(base, shape.x, p, end, std::sqrt(end.closest.distance_squared), nullptr);
}

TEST(Claims, OnAPlainAreMadeByOneFacet) {
  const Claims found = claims(sheet(4, 4, [](double, double) { return 0.0; }), {1.3, 2.6, 0.1});
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.feature[0].kind, Kind::facet);
  EXPECT_NEAR(found.at[0].height, 0.1, 1e-15);
}

TEST(Claims, OnARidgeAreMadeByItsEdge) {
  const Claims found = claims(sheet(4, 4, [](double x, double) { return -std::abs(x - 2); }), {2, 2.4, 0.1});
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.feature[0].kind, Kind::edge);
  EXPECT_NEAR(found.at[0].height, 0.1, 1e-15);
}

TEST(Claims, AtAPeakAreMadeByItsVertex) {
  const Claims found = claims(sheet(4, 4, [](double x, double y) { return -std::abs(x - 2) - std::abs(y - 2); }), {2, 2, 0.1});
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.feature[0].kind, Kind::vertex);
}

TEST(Claims, InAValleyAreMadeByBothFlanks) {
  const Claims found = claims(sheet(4, 4, [](double x, double) { return std::abs(x - 2); }), {2.01, 2.4, 0.1});
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(found.at[0].normal.dot(found.at[1].normal), 0, 1e-15);
}

TEST(Claims, BehindTheBorderAreMadeByNone) {
  EXPECT_EQ(claims(sheet(4, 4, [](double, double) { return 0.0; }), {4.2, 2.4, 0.1}).count, 0);
}

TEST(Claims, KeepTheLowestWhenThereAreTooMany) {
  Claims full;
  for (int i = 0; i < most_candidates + 3; ++i) full.add({i, Kind::facet, 0}, {1.0 - 0.01 * i, Vec3::UnitZ(), {1, 0, 0}});
  ASSERT_EQ(full.count, most_candidates);
  for (int i = 0; i < full.count; ++i) EXPECT_GE(full.feature[i].facet, 3);
}

}  // namespace
}  // namespace nereid::contact
