#include "contact/bodies.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/contact/surfaces.hpp"

namespace nereid::contact {
namespace {

using namespace surfaces;

Subset beside(const Bodies& bodies, Index node) {
  return {bodies.beside.begin() + bodies.beside_begin[static_cast<std::size_t>(node)],
          bodies.beside.begin() + bodies.beside_begin[static_cast<std::size_t>(node) + 1]};
}

/// A strip of `cells` squares of 1 m, its first node 0 and the last of the first row `cells`.
Shape strip(int cells) {
  return sheet(cells, 1, [](double, double) { return 0.0; });
}

TEST(AddBeside, WithoutAReachAreThoseThatShareAFacet) {
  const Shape shape = strip(10);
  Bodies bodies;
  add_beside(shape.facets, shape.x, Scalars::Zero(shape.x.cols()), bodies);
  for (Index node = 0; node < static_cast<Index>(shape.x.cols()); ++node)
    for (Index other = 0; other < static_cast<Index>(shape.x.cols()); ++other) {
      bool shares = false;
      for (const auto& facet : shape.facets.colwise()) shares = shares || ((facet.array() == node).any() && (facet.array() == other).any());
      EXPECT_EQ(is_beside(bodies, node, other), shares) << node << ' ' << other;
    }
}

TEST(AddBeside, ReachesAlongTheSurfaceAndOneFacetFarther) {
  const Shape shape = strip(10);
  Bodies bodies;
  add_beside(shape.facets, shape.x, Scalars::Constant(shape.x.cols(), 3.0), bodies);
  const Subset near = beside(bodies, 0);
  for (Index node = 0; node <= 10; ++node) EXPECT_EQ(std::binary_search(near.begin(), near.end(), node), node <= 4) << node;
}

TEST(AddBeside, GoesByTheMeshAndNotByTheDistance) {
  Shape shape = strip(20);
  Bodies bodies;
  add_beside(shape.facets, shape.x, Scalars::Constant(shape.x.cols(), 1.2), bodies);
  const Subset flat = bodies.beside;
  const Vectors x = shape.x;
  for (Index node = 0; node < static_cast<Index>(x.cols()); ++node) {  // folded in its middle, both halves 0.1 m apart
    const double way = x(0, node);
    shape.x.col(node) = way < 10 ? Vec3(way, x(1, node), 0) : Vec3(20 - way, x(1, node), 0.1);
  }
  Bodies folded;
  add_beside(shape.facets, shape.x, Scalars::Constant(shape.x.cols(), 1.2), folded);
  EXPECT_EQ(flat, folded.beside);
  EXPECT_FALSE(is_beside(folded, 0, 20));
}

TEST(AddBeside, LeavesOutNodesOfOtherSurfaces) {
  const Shape shape = strip(2);
  Bodies bodies;
  EXPECT_FALSE(is_beside(bodies, 0, 1)) << "no body touches itself";
  Vectors X(3, shape.x.cols() + 1);
  X << shape.x, Vec3::Zero();
  add_beside(shape.facets, X, Scalars::Zero(X.cols()), bodies);
  EXPECT_TRUE(beside(bodies, static_cast<Index>(shape.x.cols())).empty());
}

}  // namespace
}  // namespace nereid::contact
