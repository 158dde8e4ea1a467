#include "element/corner_edges.hpp"

#include <gtest/gtest.h>

#include "base/dual.hpp"
#include "tests/element/corners.hpp"

namespace nereid::element::corner_edges_test {
namespace {

TEST(CornerEdges, AreRightHandedAndSpanTheVolumeOfABrick) {
  const Corners x = brick(1.0, 2.0, 3.0);
  for (int c = 0; c < 8; ++c) {
    const auto corner = corner_edges(x, c);
    EXPECT_NEAR(corner.jacobian, 6, 1e-14);
    EXPECT_NEAR(square_of_lengths(corner), 36, 1e-13);
    EXPECT_EQ(volume_of_corner(corner), corner.jacobian);
  }
}

TEST(CornerEdges, AreasAreTheGradientOfTheJacobianByTheEdges) {
  using D = Dual<24>;
  const Corners x = distorted(0.3);
  std::array<Vector<D>, 8> dual;
  for (int n = 0; n < 8; ++n)
    for (int axis = 0; axis < 3; ++axis) dual[n][axis] = D::variable(x[n][axis], 3 * n + axis);
  for (int c = 0; c < 8; ++c) {
    const D J = corner_edges(dual, c).jacobian;
    const auto corner = corner_edges(x, c);
    for (int i = 0; i < 3; ++i)
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(J.by[static_cast<std::size_t>(3 * corner_ends[c][i] + axis)], corner.area[i][axis], 1e-14);
  }
}

TEST(CornerEdges, OfAFlatOrInvertedCornerHaveNoVolume) {
  Corners flat = brick(1, 1, 1), inverted = flat, collapsed = flat;
  flat[6] = {0.5 * (flat[5].x + flat[7].x), 0.5 * (flat[5].y + flat[7].y), flat[6].z};
  inverted[4].z = -1;
  collapsed[3] = collapsed[0];
  EXPECT_EQ(volume_of_corner(corner_edges(flat, 6)), 0);
  EXPECT_GT(square_of_lengths(corner_edges(flat, 6)), 0);
  EXPECT_LT(corner_edges(inverted, 4).jacobian, 0);
  EXPECT_EQ(volume_of_corner(corner_edges(inverted, 4)), 0);
  EXPECT_EQ(square_of_lengths(corner_edges(collapsed, 0)), 0);
}

}  // namespace
}  // namespace nereid::element::corner_edges_test
