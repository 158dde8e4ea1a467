#include "contact/surface/base_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/check.hpp"
#include "geometry/height.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "tests/contact/surfaces.hpp"

namespace nereid::contact::base_surface_test {
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

TEST(BaseSurface, OfASheetWithBothSidesHasAFrontAtAVertexInASymmetryPlaneAndNoneAtARim) {
  Shape shape = sheet(2, 2, [](double, double) { return 0.0; });
  shape.facets = mesh::both_sides(shape.facets);
  BaseSurface base = base_of(shape);
  const auto over_vertex = [&](Index node, double side) {
    for (Index f = 0; f < base.facets.cols(); ++f)
      for (int a = 0; a < 3; ++a)
        if (base.facets(a, f) == node && facet_normal(base, shape.x, f).z() > 0)
          return height_over(base, shape.x, {f, geometry::Kind::vertex, a}, shape.x.col(node) + Vec3(0, 0, 0.1 * side));
    return FeatureHeight{};
  };
  const Index on_edge = 3, inside = 4;  // (0, 1) and (1, 1)
  EXPECT_NEAR(over_vertex(on_edge, -1).height, 0.1, 1e-15);  // around a rim all is in front
  goes_on_behind(base, {0, 3, 6});
  EXPECT_NEAR(over_vertex(on_edge, 1).height, 0.1, 1e-15);
  EXPECT_NEAR(over_vertex(on_edge, -1).height, -0.1, 1e-15);
  EXPECT_NEAR(over_vertex(inside, -1).height, -0.1, 1e-15);
}

TEST(BaseSurface, KnowsTheMaterialBehindEachFacet) {
  const Shape shape = skin();
  const BaseSurface base = base_of(shape);
  for (Index f = 0; f < base.facets.cols(); ++f)
    EXPECT_NEAR(base.thickness(f), std::abs(facet_normal(base, shape.x, f).z()) > 0.5 ? 0.3 : 1.0, 1e-12);
  EXPECT_TRUE(std::isinf(base_of(sheet(2, 2, [](double, double) { return 0.0; })).thickness(0)));
}

TEST(BaseSurface, OfBodiesThatOverlapHasTheMaterialOfEach) {
  const Shape low = block({0, 0, 0}, {2, 2, 2}, {1, 1, 1}), high = block({0, 0, 1.9}, {2, 2, 2.9}, {1, 1, 1});
  Vectors X(3, low.x.cols() + high.x.cols());
  X << low.x, high.x;
  Table<3> facets(3, low.facets.cols() + high.facets.cols());
  facets << low.facets, (high.facets.array() + static_cast<Index>(low.x.cols())).matrix();
  Subset body(static_cast<std::size_t>(low.facets.cols()), 0);
  body.resize(static_cast<std::size_t>(facets.cols()), 1);
  const BaseSurface base = base_surface({"both", facets}, X, body);
  for (Index f = 0; f < facets.cols(); ++f)
    EXPECT_NEAR(base.thickness(f), f >= low.facets.cols() && std::abs(facet_normal(base, X, f).z()) > 0.5 ? 1 : 2, 1e-12);
}

}  // namespace
}  // namespace nereid::contact::base_surface_test
