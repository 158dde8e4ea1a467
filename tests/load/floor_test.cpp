#include "load/floor.hpp"

#include <gtest/gtest.h>

namespace nereid::load::floor_test {
namespace {

/// One node of 2 kg above a floor that leans.
struct Falling {
  Constraints constraints;
  Memory memory;
  Scalars mass = Scalars::Constant(1, 2);
  Vectors x{3, 1}, v{3, 1}, force = Vectors::Zero(3, 1);
  Vec3 normal = Vec3(1, 0, 2).normalized();

  Falling(double height, double speed) {
    Plane floor;
    floor.name = "floor", floor.kind = PlaneKind::floor, floor.point = Vec3(1, 1, 1), floor.normal = normal, floor.nodes = {0};
    constraints.planes = {floor};
    memory = prepare(constraints, 1, {-1});
    x.col(0) = floor.point + height * normal + Vec3(0, 0.3, 0);
    v.col(0) = speed * normal + Vec3(0, 5, 0);
  }
  double height() const { return (x.col(0) - constraints.planes[0].point).dot(normal); }
  void step(double dt) {
    find_impacts(constraints, mass, x, force, dt, v, memory);
    x += dt * v;
    put_on_floors(constraints, memory, x);
    finish_impacts(constraints, mass, x, force, dt, v, memory);
  }
};

TEST(Floor, ANodeThatWouldPassItLandsOnItAndStaysWhatItSlidesWith) {
  Falling node(0.1, -3);
  node.step(0.01);
  EXPECT_NEAR(node.height(), 0.07, 1e-15);
  EXPECT_TRUE(node.memory.active.empty());
  node.step(0.05);
  EXPECT_NEAR(node.height(), 0, 1e-16);
  EXPECT_NEAR(node.v.col(0).dot(node.normal), 0, 1e-15);
  EXPECT_EQ(node.v(1, 0), 5);
  EXPECT_EQ(node.memory.active.size(), 1U);
}

TEST(Floor, BooksTheMomentumAndTheKineticEnergyOfTheImpact) {
  Falling node(0.01, -3);
  node.step(0.1);
  const PlaneAccount& floor = node.memory.account[0];
  EXPECT_LT((floor.impulse - 6 * node.normal).norm(), 1e-14);
  EXPECT_NEAR(floor.stopped, 9, 1e-13);  // 1/2 2 kg (3 m/s)^2
}

TEST(Floor, LeavesNodesThatMoveAway) {
  Falling node(0, 1);
  node.step(0.1);
  EXPECT_TRUE(node.memory.active.empty());
  EXPECT_NEAR(node.height(), 0.1, 1e-15);
}

}  // namespace
}  // namespace nereid::load::floor_test
