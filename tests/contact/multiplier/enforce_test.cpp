#include "contact/multiplier/enforce.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/report/forces.hpp"

namespace nereid::contact::multiplier_test {
namespace {

/// A node of unit mass over the plane z = 0, moved by leapfrog as a run does it.
struct Setting {
  Vectors x, v, force, none{3, 0};
  Scalars mass = Scalars::Ones(1), no_inertia;
  std::vector<Index> turns{-1};
  std::vector<const Mat3*> allowed{nullptr}, no_rotations;
  RigidPlane plane;
  PlaneMemory memory;
  Multipliers all;
  double dt = 1e-3, next = 1e-3, t = 0;

  explicit Setting(double height, const Vec3& velocity, double friction = 0, double restitution = 1) {
    x = v = force = Vectors::Zero(3, 1);
    x(2, 0) = height;
    v.col(0) = velocity;
    plane.name = "plane", plane.point = Vec3::Zero(), plane.normal = Vec3::UnitZ(), plane.nodes = {0};
    plane.area = Scalars::Ones(1), plane.method = Method::multiplier;
    plane.impedance = 1, plane.restitution = restitution, plane.friction.coefficient = friction;
    memory = initial_memory(plane);
    all = make_multipliers({}, {&plane, 1}, 1, 0);
  }
  Motion motion() const { return {x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, dt, next}; }
  void step() {  // v is that of the step that led to x
    enforce({}, {&plane, 1}, motion(), t, {}, {&memory, 1}, {}, INFINITY, false, all);
    Vectors sum = force;
    add_forces(plane, memory, sum);
    v += 0.5 * (dt + next) * sum;
    x += next * v;
    t += dt = next;
  }
};

TEST(Multiplier, ClosesAGapExactlyAndNoMore) {
  Setting at(2.5e-3, {0, 0, -1}, 0, 0);
  for (int i = 0; i < 2; ++i) at.step();
  EXPECT_NEAR(at.x(2, 0), 0.5e-3, 1e-15);
  EXPECT_EQ(at.memory.force[0], 0);
  at.step();
  EXPECT_NEAR(at.x(2, 0), 0, 1e-16);
  EXPECT_NEAR(at.v(2, 0), -0.5, 1e-12);
}

TEST(Multiplier, GivesBackAllButNotMoreAndTheLossStandsWhereItBelongs) {
  for (const double restitution : {1.0, 0.6, 0.0}) {
    Setting at(2.5e-3, {0, 0, -1}, 0, restitution);
    for (int i = 0; i < 10; ++i) at.step();
    EXPECT_NEAR(at.v(2, 0), restitution, 1e-12);
    EXPECT_NEAR(at.memory.impact, 0.5 * (1 - restitution * restitution), 1e-12);
    EXPECT_NEAR(at.memory.work, 0.5 * (restitution * restitution - 1), 1e-12);
  }
}

TEST(Multiplier, AsksForAShorterStepBeforeItStopsANode) {
  Setting at(0.5e-3, {0, 0, -1});
  at.plane.impedance = 1e3;  // the node's mass takes a wave 1 ms
  const double energy = 0.5, taken = 0.5 * 0.5 * 1.5;
  const auto act = [&](double of_scene, bool again) {
    Motion m = at.motion();
    m.again = again;
    return enforce({}, {&at.plane, 1}, m, at.t, {}, {&at.memory, 1}, {}, of_scene, false, at.all);
  };
  const BlowLimit asks = act(energy, false);
  EXPECT_NEAR(asks.step / (2e-3 * std::sqrt(most_ringing * energy / taken)), 1, 1e-12);
  EXPECT_EQ(asks.of, 0U);
  EXPECT_EQ(asks.node, 0);
  EXPECT_NEAR(act(0, false).energy, taken, 1e-12) << "no less than what is taken";
  EXPECT_EQ(at.memory.force[0], 0) << "nothing is done yet";
  EXPECT_EQ(at.memory.restitution[0].held, 0);
  at.next = asks.step;
  EXPECT_EQ(act(energy, true).step, 1e300) << "in so short a step it does not get there";
  EXPECT_EQ(at.memory.force[0], 0);
  at.next = 1e-3;
  EXPECT_LT(act(energy, true).step, at.next);
  EXPECT_GT(at.memory.force[0], 0) << "once more it does not ask";
  EXPECT_NEAR(at.memory.restitution[0].held, taken, 1e-12);
  Setting none(0.5e-3, {0, 0, -1});
  none.plane.impedance = 1e3;
  none.step();
  EXPECT_GT(none.memory.force[0], 0) << "of an infinite energy nothing is too much";
}

TEST(Multiplier, CarriesAWeightWithoutAChatter) {
  Setting at(0, {0, 0, 0});
  at.force(2, 0) = -10;
  for (int i = 0; i < 1000; ++i) {
    at.step();
    EXPECT_NEAR(at.memory.force[0], 10, 1e-9);
    EXPECT_NEAR(at.x(2, 0), 0, 1e-15);
  }
}

TEST(Multiplier, CorrectsAPenetrationByAFifthInAStepAndOnlyWithWhatItHolds) {
  Setting at(-1e-3, {0, 0, -1});
  at.step();
  EXPECT_NEAR(at.v(2, 0), 0.2, 1e-12);
  EXPECT_NEAR(at.x(2, 0), -0.8e-3, 1e-15);
  Setting deep(-1e-3, {0, 0, 0});
  deep.force(2, 0) = -10;
  deep.step();
  EXPECT_NEAR(deep.v(2, 0), 0, 1e-12);  // nothing is held: it goes no deeper
}

TEST(Multiplier, GivesBackNoMoreThanItHoldsWhereTheStepFalls) {
  for (const double falls : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 12.0, 30.0, 1000.0}) {
    Setting at(-1e-2, {0, 0, -1});
    at.next = at.dt / falls;
    for (int i = 0; i < 200; ++i) {
      at.step();
      EXPECT_LE(std::abs(at.v(2, 0)), 1 + 1e-9) << falls << " in step " << i;
    }
  }
}

TEST(Multiplier, APenetrationThatCannotBePaidForDoesNotChatter) {
  Setting at(-1e-3, {0, 0, -0.2});
  at.force(2, 0) = -1000;
  for (int i = 0; i < 20; ++i) at.step();
  const double rests = at.x(2, 0);
  for (int i = 0; i < 20; ++i) {
    at.step();
    EXPECT_NEAR(at.x(2, 0), rests, 1e-6);
    EXPECT_NEAR(at.memory.force[0], 1000, 1);
  }
}

TEST(Multiplier, FrictionHoldsBelowItsLimitAndSlidesAtIt) {
  Setting sticks(0, {0, 0, 0}, 0.5), slides(0, {0, 0, 0}, 0.5);
  sticks.force.col(0) = Vec3(3, -3, -10);
  slides.force.col(0) = Vec3(6, 0, -10);
  for (int i = 0; i < 100; ++i) sticks.step(), slides.step();
  EXPECT_LT(sticks.v.col(0).norm(), 1e-12);
  EXPECT_NEAR(sticks.memory.friction[0].x(), -3, 1e-9);
  EXPECT_NEAR(slides.memory.friction[0].x(), -5, 1e-9);
  EXPECT_NEAR(slides.v(0, 0), 0.1, 1e-9);
  EXPECT_GT(slides.memory.friction_dissipated, 0);
}

TEST(Multiplier, FrictionAndPushSettleWhereConstraintsSlantToTheNormal) {
  for (const double slope : {0.1, 0.4, 1.0, 3.0}) {  // the node moves along z alone, so both impulses act along one way
    Setting at(0, {0, 0, 0}, 0.8);
    const Mat3 along_z = Vec3(0, 0, 1).asDiagonal();
    at.allowed[0] = &along_z;
    at.plane.normal = Vec3(0, slope, 1).normalized();
    for (int i = 0; i < 200; ++i) {
      at.force(2, 0) = -0.1 * i;
      enforce({}, {&at.plane, 1}, at.motion(), at.t, {}, {&at.memory, 1}, {}, INFINITY, false, at.all);
      Vectors sum = at.force;
      add_forces(at.plane, at.memory, sum);
      at.v += at.dt * along_z * sum, at.x += at.dt * at.v;
      EXPECT_NEAR(at.v(2, 0), 0, 2e-7) << slope << " in step " << i;  // of 0.02 that an impulse does, iterations leave 1e-6 at a time
    }
    EXPECT_LT(at.all.spent.iterations, 20 * at.all.spent.steps) << slope;
  }
}

TEST(Multiplier, FrictionHoldsByTheStaticAndSlidesByTheKineticCoefficient) {
  Setting sticks(0, {0, 0, 0}, 0.5), slides(0, {0, 0, 0}, 0.5), stops(0, {2, 0, 0}, 0.5);
  for (Setting* at : {&sticks, &slides, &stops}) at->plane.friction.kinetic = 0.2, at->plane.friction.decay = 1e3, at->dt = at->next = 1e-2;
  sticks.force.col(0) = Vec3(4.9, 0, -10);
  slides.force.col(0) = Vec3(5.1, 0, -10);
  stops.force.col(0) = Vec3(0, 0, -10);
  for (int i = 0; i < 50; ++i) sticks.step(), slides.step(), stops.step();
  EXPECT_LT(sticks.v.col(0).norm(), 1e-12);
  EXPECT_NEAR(slides.memory.friction[0].x(), -2, 1e-9);
  EXPECT_NEAR(stops.memory.friction[0].x(), -2, 1e-9);
  EXPECT_NEAR(stops.v(0, 0), 1, 0.01);
  for (int i = 0; i < 100; ++i) stops.step();
  EXPECT_LT(stops.v.col(0).norm(), 1e-12);
  EXPECT_NEAR(stops.memory.friction_dissipated, 2, 0.01);  // all that it had, but for what the stick of the first step took
}

TEST(Multiplier, WhatOthersLeaveOfTheSlipRateOfAStickIsNoSliding) {
  Setting sticks(0, {0, 0, 0}, 0.5), lands(1e-3, {5, 0, -2}, 0.5, 0);
  for (Setting* at : {&sticks, &lands}) at->plane.friction.kinetic = 0.2, at->plane.friction.decay = 1e12;
  sticks.force.col(0) = Vec3(4, 0, -10);
  for (int i = 0; i < 100; ++i) {
    sticks.step();
    EXPECT_NEAR(sticks.memory.friction[0].x(), -4, 1e-5);
    sticks.v(0, 0) += 1e-9;  // as unfinished iterations do
  }
  sticks.force(0, 0) = 6;
  for (int i = 0; i < 3; ++i) sticks.step();
  EXPECT_NEAR(sticks.memory.friction[0].x(), -2, 1e-9);  // beyond the static limit it slides
  while (lands.memory.force[0] == 0) lands.step();
  EXPECT_NEAR(lands.memory.friction[0].x() / lands.memory.force[0], -0.2, 1e-12);  // what comes down slides already
}

}  // namespace
}  // namespace nereid::contact::multiplier_test
