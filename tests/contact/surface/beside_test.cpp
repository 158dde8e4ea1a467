#include "contact/surface/beside.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/contact/surfaces.hpp"

namespace nereid::contact::beside_test {
namespace {

using namespace surfaces;

Subset around(const Beside& beside, Index node) {
  const auto at = static_cast<std::size_t>(node);
  return {beside.nodes.begin() + beside.begin[at], beside.nodes.begin() + beside.begin[at + 1]};
}

/// A strip of `cells` squares of 1 m, its first node 0 and the last of the first row `cells`.
Shape strip(int cells) {
  return sheet(cells, 1, [](double, double) { return 0.0; });
}

TEST(FindBeside, WithoutAReachAreThoseThatShareAFacet) {
  const Shape shape = strip(10);
  const Beside beside = find_beside(shape.facets, shape.x, Scalars::Zero(shape.x.cols()));
  for (Index node = 0; node < static_cast<Index>(shape.x.cols()); ++node)
    for (Index other = 0; other < static_cast<Index>(shape.x.cols()); ++other) {
      bool shares = false;
      for (const auto& facet : shape.facets.colwise()) shares = shares || ((facet.array() == node).any() && (facet.array() == other).any());
      EXPECT_EQ(is_beside(beside, node, other), shares) << node << ' ' << other;
    }
}

TEST(FindBeside, ReachesAlongTheSurfaceAndOneFacetFarther) {
  const Shape shape = strip(10);
  const Subset near = around(find_beside(shape.facets, shape.x, Scalars::Constant(shape.x.cols(), 3.0)), 0);
  for (Index node = 0; node <= 10; ++node) EXPECT_EQ(std::binary_search(near.begin(), near.end(), node), node <= 4) << node;
}

TEST(FindBeside, GoesByTheMeshAndNotByTheDistance) {
  Shape shape = strip(20);
  const Beside flat = find_beside(shape.facets, shape.x, Scalars::Constant(shape.x.cols(), 1.2));
  const Vectors x = shape.x;
  for (Index node = 0; node < static_cast<Index>(x.cols()); ++node) {  // folded in its middle, both halves 0.1 m apart
    const double way = x(0, node);
    shape.x.col(node) = way < 10 ? Vec3(way, x(1, node), 0) : Vec3(20 - way, x(1, node), 0.1);
  }
  const Beside folded = find_beside(shape.facets, shape.x, Scalars::Constant(shape.x.cols(), 1.2));
  EXPECT_EQ(flat.nodes, folded.nodes);
  EXPECT_FALSE(is_beside(folded, 0, 20));
}

TEST(FindBeside, LeavesOutNodesOfOtherSurfaces) {
  const Shape shape = strip(2);
  EXPECT_FALSE(is_beside(Beside{}, 0, 1)) << "no body touches itself";
  Vectors X(3, shape.x.cols() + 1);
  X << shape.x, Vec3::Zero();
  EXPECT_TRUE(around(find_beside(shape.facets, X, Scalars::Zero(X.cols())), static_cast<Index>(shape.x.cols())).empty());
}

}  // namespace
}  // namespace nereid::contact::beside_test
