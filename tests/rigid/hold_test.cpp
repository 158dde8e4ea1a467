#include "rigid/hold.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace nereid::rigid::hold_test {
namespace {

const Vec3 ex = Vec3::UnitX(), ey = Vec3::UnitY(), ez = Vec3::UnitZ();

std::optional<rigid::Hold> hold(const std::vector<HeldNode>& held) { return rigid::hold_of(held, 1); }

TEST(Hold, OfNothingLeavesAll) {
  const auto found = hold({});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turns, 3);
  EXPECT_EQ(found->shift, Mat3::Identity());
}

TEST(Hold, OfAFaceLeavesMotionInItsPlane) {
  const auto found = hold({{{1, 1, 0.5}, ez}, {{-1, 1, 0.5}, ez}, {{-1, -1, 0.5}, ez}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turns, 1);
  EXPECT_LT((found->axis - ez).norm(), 1e-12);
  EXPECT_LT((found->shift - Mat3(Vec3(1, 1, 0).asDiagonal())).norm(), 1e-12);
}

TEST(Hold, OfTwoFacesLeavesAShift) {
  const auto found = hold({{{1, 1, 0.5}, ez}, {{-1, 1, 0.5}, ez}, {{-1, -1, 0.5}, ez}, {{1, 0.5, 1}, ex}, {{1, -0.5, -1}, ex}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turns, 0);
  EXPECT_LT((found->shift - Mat3(Vec3(0, 1, 0).asDiagonal())).norm(), 1e-12);
}

TEST(Hold, OfAnAxleThroughTheCentreLeavesItsTurn) {
  const auto found = hold({{{0, 0, 1}, ex}, {{0, 0, 1}, ey}, {{0, 0, 1}, ez}, {{0, 0, -1}, ex}, {{0, 0, -1}, ey}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turns, 1);
  EXPECT_LT(found->shift.norm(), 1e-12);
}

TEST(Hold, OfAHingeBesideTheCentreIsNone) {
  EXPECT_FALSE(hold({{{1, 0, 1}, ex}, {{1, 0, 1}, ey}, {{1, 0, 1}, ez}, {{1, 0, -1}, ex}, {{1, 0, -1}, ey}}));
  EXPECT_FALSE(hold({{{1, 0, 0}, ez}}));                 // it turns about two axes
  EXPECT_FALSE(hold({{{1, 0, 0}, ez}, {{-1, 0, 0}, ez}}));  // about z, and about the line of both nodes
}

TEST(Hold, OfTheCentreLeavesAllTurns) {
  const auto found = hold({{{0, 0, 0}, ex}, {{0, 0, 0}, ey}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->turns, 3);
  EXPECT_LT((found->shift - Mat3(Vec3(0, 0, 1).asDiagonal())).norm(), 1e-12);
}

}  // namespace
}  // namespace nereid::rigid::hold_test
