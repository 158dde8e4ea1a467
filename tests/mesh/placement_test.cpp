#include "mesh/placement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "mesh/box.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::placement_test {
namespace {

Mesh brick() { return box("a", {Vec3(1, 2, 3), Vec3(2, 4, 6), {2, 3, 4}}); }

TEST(Placement, AQuarterTurnAboutAnAxisIsExact) {
  const Mesh before = brick(), after = rotated_about(before, 2 * Vec3::UnitZ(), pi / 2, Vec3::Zero());
  for (Index n = 0; n < before.X.cols(); ++n)
    EXPECT_EQ(after.X.col(n), Vec3(-before.X(1, n), before.X(0, n), before.X(2, n)));
}

TEST(Placement, ATurnFollowsTheRightHandRuleAndKeepsItsAxis) {
  const Vec3 axis(1, -2, 0.5), about(0.3, 0.2, -0.1);
  const double angle = 0.7;
  Mesh one = brick();
  one.X.col(0) = about + 3 * axis;
  const Mesh after = rotated_about(one, axis, angle, about);
  EXPECT_LT((after.X.col(0) - one.X.col(0)).norm(), 1e-14);  // rounding of numbers near one
  const Vec3 n = axis.normalized();
  for (Index node = 1; node < one.X.cols(); ++node) {
    const Vec3 r = one.X.col(node) - about, across = r - n * n.dot(r);
    const Vec3 expected = about + n * n.dot(r) + std::cos(angle) * across + std::sin(angle) * n.cross(r);
    EXPECT_LT((after.X.col(node) - expected).norm(), 1e-14);  // rounding of numbers near one
  }
}

TEST(Placement, TurningAndMovingKeepVolumesAndNames) {
  const Mesh before = brick();
  const Mesh after = moved(rotated_about(before, Vec3(1, 1, 1), 0.4, Vec3(5, 0, 0)), Vec3(1, 2, 3));
  EXPECT_NEAR(measures::volume(after, hexahedra(after, "a").nodes), 6, 1e-13);  // rounding of coordinates up to ten
  EXPECT_EQ(after.surfaces.size(), before.surfaces.size());
  EXPECT_EQ(node_set(after, "a.x_low"), node_set(before, "a.x_low"));
}

TEST(Placement, ThereAndBackIsWhereItWas) {
  const Mesh before = brick();
  const Vec3 axis(0.2, 0.5, -1), about(1, 2, 3), by(0.5, 0.25, -2);
  const Mesh back = rotated_about(moved(moved(rotated_about(before, axis, 1.1, about), by), -by), axis, -1.1, about);
  EXPECT_LT((back.X - before.X).cwiseAbs().maxCoeff(), 1e-14);  // rounding of numbers near five
}

TEST(Placement, AnAxisWithoutDirectionIsRefused) {
  EXPECT_THROW(rotated_about(brick(), Vec3::Zero(), 1, Vec3::Zero()), InternalError);
}

}  // namespace
}  // namespace nereid::mesh::placement_test
