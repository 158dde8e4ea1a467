#include "contact/base_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/check.hpp"
#include "geometry/height.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact {
namespace {

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

}  // namespace
}  // namespace nereid::contact
