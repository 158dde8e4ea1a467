#include "contact/penalty/rigid_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "contact/penalty/advance.hpp"
#include "contact/penalty/impact_step.hpp"
#include "contact/report/account.hpp"
#include "contact/report/forces.hpp"

namespace nereid::contact::rigid_plane_test {
namespace {

/// Two nodes over an inclined plane, tributary areas 2 and 3 m2.
RigidPlane inclined() {
  RigidPlane plane;
  plane.name = "floor";
  plane.point = {0.5, 0, 0};
  plane.normal = Vec3(1, 2, 2) / 3;
  plane.nodes = {0, 2};
  plane.area.resize(2);
  plane.area << 2, 3;
  plane.penalty = 100;
  return plane;
}

/// Node 0 below the plane by `depth`, node 2 above it by as much.
Vectors around(const RigidPlane& plane, double depth) {
  Vectors x = Vectors::Zero(3, 3);
  x.col(0) = plane.point - depth * plane.normal + Vec3(0, 1, -1);
  x.col(2) = plane.point + depth * plane.normal + Vec3(2, -1, 0);
  return x;
}

TEST(RigidPlane, PushesByPenaltyTimesAreaTimesDepthAndNeverPulls) {
  const RigidPlane plane = inclined();
  PlaneMemory memory = initial_memory(plane);
  const Vectors x = around(plane, 0.01);
  advance(plane, x, Vectors::Zero(3, 3), 0, memory);
  Vectors force = Vectors::Zero(3, 3);
  add_forces(plane, memory, force);
  EXPECT_LT((force.col(0) - 100 * 2 * 0.01 * plane.normal).norm(), 1e-13);
  EXPECT_TRUE(force.rightCols(2).isZero(0));
  EXPECT_NEAR(memory.stored, 0.5 * 200 * 1e-4, 1e-15);
  EXPECT_EQ(memory.work, 0);
}

TEST(RigidPlane, ForceIsTheGradientOfTheStoredEnergy) {
  const RigidPlane plane = inclined();
  Vectors x = around(plane, 0.01);
  const auto stored = [&] {
    PlaneMemory memory = initial_memory(plane);
    advance(plane, x, Vectors::Zero(3, 3), 0, memory);
    return memory.stored;
  };
  PlaneMemory memory = initial_memory(plane);
  advance(plane, x, Vectors::Zero(3, 3), 0, memory);
  Vectors force = Vectors::Zero(3, 3);
  add_forces(plane, memory, force);
  constexpr double step = 1e-6;
  for (int i = 0; i < 3; ++i) {
    x(i, 0) += step;
    const double ahead = stored();
    x(i, 0) -= 2 * step;
    const double behind = stored();
    x(i, 0) += step;
    EXPECT_NEAR(force(i, 0), -(ahead - behind) / (2 * step), 1e-8);
  }
}

/// A node of mass 1 thrown at the plane with speed 1, leapfrog; returns the rebound speed.
double bounce(const RigidPlane& plane, double start, double dt, PlaneMemory& memory) {
  Vectors x = Vectors::Zero(3, 3), v = Vectors::Zero(3, 3);
  x.col(0) = plane.point + start * plane.normal;
  x.col(2) = plane.point + plane.normal;
  v.col(0) = -plane.normal;
  memory = initial_memory(plane);
  advance(plane, x, v, 0, memory);
  for (int step = 0; step < 4000; ++step) {
    x += dt * v;
    advance(plane, x, v, dt, memory);
    Vectors force = Vectors::Zero(3, 3);
    add_forces(plane, memory, force);
    v += dt * force;
    if (v.col(0).dot(plane.normal) > 0 && memory.stored == 0) break;
  }
  return v.col(0).dot(plane.normal);
}

TEST(RigidPlane, VotesForTheStepThatKeepsTheBoundOfABounce) {
  RigidPlane plane = inclined();
  plane.impact_step_factor = impact_step_factor_for(0.005);
  Scalars mass(3);
  mass << 1, 1e-9, 30;
  EXPECT_DOUBLE_EQ(stable_step(plane, mass, {}).step, plane.impact_step_factor / std::sqrt(200.0));
  const double dt = stable_step(plane, mass, {}).step;
  double worst = 0;
  for (int phase = 0; phase < 50; ++phase) {
    PlaneMemory memory;
    const double speed = bounce(plane, dt * (phase + 0.5) / 50, dt, memory);
    worst = std::max(worst, speed * speed - 1);
    EXPECT_NEAR(memory.work, 0.5 * (speed * speed - 1), 1e-12);
    EXPECT_LT((memory.impulse - (speed + 1) * plane.normal).norm(), 1e-12);
  }
  EXPECT_LE(worst, 0.005);
  EXPECT_GT(worst, 0.002);
}

TEST(RigidPlane, BooksTheAngularImpulseOfItsForces) {
  const RigidPlane plane = inclined();
  PlaneMemory memory;
  bounce(plane, 1e-3, 1e-3, memory);
  EXPECT_LT((memory.angular_impulse - plane.point.cross(memory.impulse)).norm(), 1e-12);
  EXPECT_GT(memory.deepest, 0);
}

TEST(RigidPlane, WithoutNodesVotesForNothing) {
  RigidPlane plane = inclined();
  plane.nodes.clear();
  plane.area.resize(0);
  EXPECT_GT(stable_step(plane, Scalars::Ones(3), {}).step, 1e200);
}

}  // namespace
}  // namespace nereid::contact::rigid_plane_test
