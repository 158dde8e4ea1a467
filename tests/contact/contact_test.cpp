#include "contact/contact.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <new>
#include <random>

#include "base/dense.hpp"
#include "base/parallel.hpp"
#include "contact/penalty/impact_step.hpp"
#include "contact/surface/projection.hpp"
#include "mesh/cylinder.hpp"
#include "tests/contact/pressed.hpp"

// The sanitizers have operators of their own.
#ifndef NEREID_SANITIZED
namespace {
std::atomic<long> allocations{0};
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* at = std::malloc(size)) return at;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* at) noexcept { std::free(at); }
[[gnu::noinline]] void operator delete(void* at, std::size_t) noexcept { std::free(at); }
#endif

namespace nereid::contact::contact_test {
namespace {

using geometry::Kind;
using namespace pressed;

// ------------------------------------------------------------------ momentum

TEST(Force, OfConsistentWeightsBooksNoAngularImpulse) {
  Scene scene = press(sheet(4, 4, flat, 0.2), {{1.33, 1.21, 0.07}}, 0.1);
  scene.update(0.01);
  EXPECT_TRUE(scene.memory.angular_impulse.isZero(0));
}

// ------------------------------------------------------------------ friction

/// An apex pressed on a sheet with jittered nodes, with friction, and the velocities of all nodes.
struct Rubbing {
  Scene scene;
  Vectors v;
  Rubbing(double coefficient, double stick, Weights weights = Weights::consistent, const Vec3& at = {1.33, 1.21, -0.03})
      : scene(press(sheet(6, 4, flat, 0.2), {at}, 0)), v(Vectors::Zero(3, scene.x.cols())) {
    scene.interface.friction = {coefficient, stick};
    scene.interface.weights = weights;
    scene.workspace = Workspace(scene.interface);
    scene.memory.slip.assign(1, Vec3::Zero());
    scene.memory.tangential_stored.assign(1, 0.0);
    scene.update();
  }
  const FrictionForces& friction() const { return *scene.near().friction; }
  void drag(const Vec3& velocity, double dt, int steps) {
    v.col(scene.apex()) = velocity;
    for (int step = 0; step < steps; ++step) {
      scene.x += dt * v;
      advance(scene.interface, scene.x, v, none, dt, scene.memory, scene.workspace);
    }
  }
  double created() const {
    return scene.memory.work + stored(scene.memory) + tangential_stored(scene.memory) + scene.memory.damped +
           scene.memory.friction_dissipated;
  }
};

TEST(Friction, SticksElasticallyAndThenSlidesAtItsLimit) {
  Rubbing r(0.4, 0.5);
  const double start = r.created();
  r.drag({1e-3, 0, 0}, 1, 10);  // 0.01 m against a limit of 0.4 * 0.03 / 0.5 = 0.024 m
  EXPECT_LT((r.friction().force - Vec3(-0.5 * penalty * 0.01, 0, 0)).norm(), 1e-10);
  EXPECT_EQ(r.scene.memory.friction_dissipated, 0);
  r.drag({1e-3, 1e-3, 0}, 1, 90);
  EXPECT_NEAR(r.friction().force.norm(), 0.4 * penalty * 0.03, 1e-10);
  EXPECT_GT(r.scene.memory.friction_dissipated, 0);
  EXPECT_NEAR(r.created(), start, 1e-12);
  const ElementView seen = view(r.scene.interface, r.scene.x, r.scene.memory, 0);
  EXPECT_TRUE(seen.slides);
  EXPECT_NEAR(seen.shear_traction, 0.4 * penalty * 0.03, 1e-9);
}

TEST(Friction, GivesBackWhatTheStickStoredWhenItDoesNotSlide) {
  Rubbing r(5, 1);
  const double start = r.created();
  r.drag({1e-3, 2e-3, 0}, 1, 10);
  EXPECT_GT(tangential_stored(r.scene.memory), 0.1);
  r.drag({-1e-3, -2e-3, 0}, 1, 10);
  EXPECT_NEAR(tangential_stored(r.scene.memory), 0, 1e-20);
  EXPECT_EQ(r.scene.memory.friction_dissipated, 0);
  EXPECT_NEAR(r.created(), start, 1e-13);
}

TEST(Friction, GoesOnOverFacetEdgesWithoutAJump) {
  for (const Weights weights : {Weights::consistent, Weights::paper}) {
    Rubbing r(0.4, 1, weights);
    r.drag({0.01, 0.004, 0}, 1, 10);  // now it slides
    Vectors before = r.scene.forces();
    double force_jump = 0;
    for (int step = 0; step < 200; ++step) {
      r.drag({0.01, 0.004, 0}, 1, 1);
      const Vectors now = r.scene.forces();
      EXPECT_NEAR(r.friction().force.norm(), 0.4 * penalty * 0.03, 1e-9);
      force_jump = std::max(force_jump, (now - before).topRows<2>().colwise().norm().maxCoeff());
      before = now;
    }
    EXPECT_GT(r.scene.memory.walks, 2);
    // in a step the weights change by 0.02 at most; the paper's jump by a third at hand-over
    const double friction = 0.4 * penalty * 0.03;
    if (weights == Weights::consistent) {
      EXPECT_LT(force_jump, 0.03 * friction);
    } else {
      EXPECT_GT(force_jump, 0.3 * friction);
    }
  }
}

TEST(Friction, PastAWallMakesNoEnergy) {
  Rubbing r(5, 1, Weights::consistent, {1.33, 0.02, -0.03});
  const double start = r.created();
  r.drag({0, -1e-4, 0}, 1, 1000);  // past the border its push fades, and its spring is steeper
  EXPECT_EQ(r.scene.memory.status[0], Status::closed);
  EXPECT_GT(r.scene.near().element.stiffness, 1.2 * r.scene.near().element.penalty);
  EXPECT_GT(tangential_stored(r.scene.memory), 0.1);
  EXPECT_LT(std::abs(r.created() - start), 1e-3 * tangential_stored(r.scene.memory));
}

TEST(Friction, OfThePapersWeightsLosesTheAngularMomentumThatIsBooked) {
  Rubbing r(0.4, 1, Weights::paper);
  r.drag({0.01, 0.004, 0}, 1, 10);
  r.scene.memory.angular_impulse.setZero();
  r.v.setZero();
  advance(r.scene.interface, r.scene.x, r.v, none, 0.01, r.scene.memory, r.scene.workspace);
  const Vectors f = r.scene.forces();
  EXPECT_LT(f.rowwise().sum().norm(), 1e-12);
  Vec3 moment = Vec3::Zero();
  for (Index n = 0; n < r.scene.x.cols(); ++n) moment += Vec3(r.scene.x.col(n)).cross(Vec3(f.col(n)));
  EXPECT_GT(moment.norm(), 0.1);
  EXPECT_LT((r.scene.memory.angular_impulse - 0.01 * moment).norm(), 1e-12);
}

TEST(Friction, OfConsistentWeightsKeepsAngularMomentum) {
  Rubbing r(0.4, 1);
  r.drag({0.01, 0.004, 0}, 1, 10);
  const Vectors f = r.scene.forces();
  Vec3 moment = Vec3::Zero();
  for (Index n = 0; n < r.scene.x.cols(); ++n) moment += Vec3(r.scene.x.col(n)).cross(Vec3(f.col(n)));
  EXPECT_GT(r.friction().force.norm(), 10);
  EXPECT_LT(moment.norm(), 1e-12);
  EXPECT_TRUE(r.scene.memory.angular_impulse.isZero(0));
}

TEST(Friction, ASlipTurnsWithItsBaseAndItsNormal) {
  Rubbing r(5, 1);
  r.drag({1e-3, 2e-3, 0}, 1, 10);
  const Vec3 slip = r.scene.memory.slip[0];
  const double start = r.created(), rate = 0.01;
  const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized();
  for (int step = 0; step < 100; ++step) {  // one radian rigidly, each node along its chord
    const Vectors before = r.scene.x;
    r.scene.x = Eigen::AngleAxisd(rate, axis).toRotationMatrix() * before;
    r.v = r.scene.x - before;
    advance(r.scene.interface, r.scene.x, r.v, none, 1, r.scene.memory, r.scene.workspace);
  }
  EXPECT_LT((r.scene.memory.slip[0] - Eigen::AngleAxisd(1, axis) * slip).norm(), 1e-12 * slip.norm());
  EXPECT_EQ(r.scene.memory.friction_dissipated, 0);
  EXPECT_LT(std::abs(r.created() - start), 1e-12 * tangential_stored(r.scene.memory));
}

TEST(Friction, LetsGoOfItsSlipWhereTheApexLeaves) {
  Rubbing r(5, 1);
  r.drag({1e-3, 2e-3, 0}, 1, 10);
  const double held = tangential_stored(r.scene.memory);
  r.drag({0, 0, 0.1}, 1, 1);
  EXPECT_EQ(r.scene.memory.status[0], Status::open);
  EXPECT_TRUE(r.scene.memory.slip[0].isZero(0));
  EXPECT_NEAR(r.scene.memory.friction_dissipated, held, 1e-12);
  r.drag({0, 0, -0.1}, 1, 1);
  EXPECT_TRUE(r.friction().force.isZero(0));
}

// ------------------------------------------------------------------ ties

Scene tie(const std::vector<Vec3>& apexes) {
  const Shape shape = sheet(4, 4, [](double x, double y) { return 0.1 * x + 0.05 * y * y; }, 0.2);
  Vectors x(3, shape.x.cols() + static_cast<Index>(apexes.size()));
  x.leftCols(shape.x.cols()) = shape.x;
  for (std::size_t a = 0; a < apexes.size(); ++a) x.col(shape.x.cols() + static_cast<Index>(a)) = apexes[a];
  Interface in = interface_over(shape, static_cast<Index>(apexes.size()));
  in.kind = InterfaceKind::tied;
  Scene scene = scene_of(std::move(x), std::move(in), {true, 0, 0});
  scene.update();
  return scene;
}

TEST(Tie, HoldsNothingAtTheStartAndThenPullsAndPushesAlongTheGradientOfItsEnergy) {
  Scene scene = tie({{1.3, 1.6, 0.4}});
  EXPECT_LT(scene.forces().norm(), 1e-12 * penalty);
  scene.move(Vec3(scene.x.col(scene.apex())) + Vec3(0.02, -0.03, 0.05));
  scene.x.col(6) += Vec3(0.01, 0.02, -0.03);
  scene.update();
  EXPECT_GT(scene.memory.gap[0], 0);
  EXPECT_LT(view(scene.interface, scene.x, scene.memory, 0).traction, 0);
  has_a_potential(scene, by_differences);
}

TEST(Tie, StoresNothingInARigidMotion) {
  Scene scene = tie({{1.3, 1.6, 0.4}, {2.2, 2.9, 0.7}});
  scene.x = Eigen::AngleAxisd(1.1, Vec3(1, -2, 0.5).normalized()).toRotationMatrix() * scene.x;
  scene.x.colwise() += Vec3(3, 2, 1);
  scene.update();
  EXPECT_LT(stored(scene.memory), 1e-24 * penalty);
  EXPECT_EQ(scene.memory.walks, 0);
}

TEST(Tie, AsksForNoSmallStepsBecauseItNeverOpens) {
  Scene scene = tie({{1.3, 1.6, 0.4}});
  const Scalars mass = Scalars::Ones(scene.x.cols());
  const double step = stable_step(scene.interface, mass, no_inertia, scene.memory, scene.workspace).step;
  EXPECT_LT(step, linear_step / std::sqrt(penalty * 1.2));
  EXPECT_GT(step, linear_step / std::sqrt(penalty * 3.0));
}

// ------------------------------------------------------------------ walking

struct Drag {
  double largest_jump = 0;   ///< of the force on the apex between two steps
  double least = 1e300, most = 0;  ///< force along z
  int missed = 0;            ///< steps without contact
};
Drag drag(Scene& scene, int steps, const std::function<Vec3(double)>& path) {
  Drag seen;
  Vec3 before;
  scene.move(path(0));
  scene.update();
  scene.memory.created_by_reconnection = 0;
  for (int step = 0; step <= steps; ++step) {
    scene.move(path(static_cast<double>(step) / steps));
    scene.update();
    const Vec3 f = scene.forces().col(scene.apex());
    if (step > 0) seen.largest_jump = std::max(seen.largest_jump, (f - before).norm());
    before = f;
    seen.missed += scene.memory.status[0] != Status::closed;
    seen.least = std::min(seen.least, f.z()), seen.most = std::max(seen.most, f.z());
  }
  return seen;
}

TEST(Drag, OverAPlainOfIrregularFacetsKeepsTheForceToRoundOff) {
  Scene scene = press(sheet(8, 8, flat, 0.3), {{1, 1, 0.07}}, 0.1);
  const Drag seen = drag(scene, 1000, [](double s) { return Vec3(1 + 6 * s, 1.1 + 5.3 * s, 0.07); });
  EXPECT_EQ(seen.missed, 0);
  EXPECT_NEAR(seen.least, penalty * 0.03, 1e-9);
  EXPECT_NEAR(seen.most, penalty * 0.03, 1e-9);
  EXPECT_GE(scene.memory.walks, 8);
  EXPECT_EQ(scene.memory.walks, scene.memory.reconnections[0]);
  EXPECT_EQ(scene.memory.lost, 0);
  EXPECT_NEAR(scene.memory.created_by_reconnection, 0, 1e-12);
}

TEST(Drag, WithTheAreaOfTheBaseJumpsByTheRatioOfFacetAreas) {
  Scene scene = press(sheet(8, 8, flat, 0.3), {{1, 1, 0.07}}, 0.1);
  scene.interface.area_kind = Area::base;
  const Drag seen = drag(scene, 1000, [](double s) { return Vec3(1 + 6 * s, 1.1 + 5.3 * s, 0.07); });
  EXPECT_EQ(seen.missed, 0);
  EXPECT_GT(seen.most / seen.least, 1.3);
  EXPECT_LE(seen.most / seen.least, scene.interface.facet_area.maxCoeff() / scene.interface.facet_area.minCoeff() + 1e-9);
}

TEST(Drag, OverARidgeLosesNoStepAndDoesNotJump) {
  for (const double turn : {10.0, 45.0, 90.0}) {
    const double slope = std::tan(turn / 2 * pi / 180), cosine = 1 / std::sqrt(1 + slope * slope);
    Scene scene = press(sheet(4, 4, fold(-slope), 0), {{1, 1.3, 1}}, 0.1);
    constexpr int steps = 2000;
    // 0.08 above the surface, around the edge on an arc: height 0.08 all the way
    const Drag seen = drag(scene, steps, [&](double s) {
      const double sine = slope * cosine, x = 1.2 * (s - 0.5), reach = 0.08 * sine;
      const double side = x < 0 ? -1 : 1, along = std::abs(x) < reach ? reach : std::abs(x);
      if (std::abs(x) < reach) return Vec3(2 + x, 1.3 + 0.1 * s, std::sqrt(0.0064 - x * x));
      const double down = along - reach;
      return Vec3(2 + side * along, 1.3 + 0.1 * s, 0.08 * cosine - slope * down);
    });
    EXPECT_EQ(seen.missed, 0) << turn;
    EXPECT_LT(seen.largest_jump, 2 * penalty * 1.2 / steps) << turn;
    EXPECT_GE(scene.memory.walks, 2);
    EXPECT_NEAR(scene.memory.created_by_reconnection, 0, 1e-2) << turn;
  }
}

TEST(Drag, ThroughAValleyLosesNoStepAndDoesNotJump) {
  for (const double turn : {0.2, 10.0, 45.0, 90.0}) {
    const double slope = std::tan(turn / 2 * pi / 180), cosine = 1 / std::sqrt(1 + slope * slope);
    Scene scene = press(sheet(4, 4, fold(slope), 0), {{1, 1.3, 1 * slope + 0.08 / cosine}}, 0.1);
    constexpr int steps = 2000;
    const Drag seen = drag(scene, steps, [&](double s) {
      const double x = 1.2 * (s - 0.5);
      return Vec3(2 + x, 1.3 + 0.1 * s, slope * std::abs(x) + 0.08 / cosine);
    });
    EXPECT_EQ(seen.missed, 0) << turn;
    // along the flanks the path itself is longer than the step by 1/cosine
    EXPECT_LT(seen.largest_jump, 1.01 * penalty * 1.21 / cosine / steps) << turn;
  }
}

TEST(Drag, AroundABallLosesNoStepAndDoesNotJump) {
  Scene scene = press(ball(2), {{1.03, 0, 0}}, 0.1);
  constexpr int steps = 6000;
  const Drag seen = drag(scene, steps, [](double s) {
    const double angle = 2 * pi * s, tilt = 0.4 * std::sin(3 * angle);
    return Vec3(1.03 * std::cos(angle) * std::cos(tilt), 1.03 * std::sin(angle) * std::cos(tilt), 1.03 * std::sin(tilt));
  });
  EXPECT_EQ(seen.missed, 0);
  EXPECT_LT(seen.largest_jump, 3 * penalty * 2 * pi * 1.6 / steps);
  EXPECT_GT(scene.memory.walks, 10);
  EXPECT_EQ(scene.memory.lost, 0);
}

TEST(Drag, AroundTheInsideOfATubeLosesNoStepAndDoesNotJump) {
  const mesh::Mesh tube = mesh::tube("tube", {1, 1, mesh::Revolution::full, 4, 4});
  Scene scene = press({tube.X, mesh::surface(tube, "tube.inside").facets}, {{0.93, 0, 0.5}}, 0.1);
  constexpr int steps = 6000;
  const Drag seen = drag(scene, steps, [](double s) {
    const double angle = 2 * pi * s;
    return Vec3(0.92 * std::cos(angle), 0.92 * std::sin(angle), 0.5 + 0.3 * std::sin(angle));
  });
  EXPECT_EQ(seen.missed, 0);
  EXPECT_LT(seen.largest_jump, 1.01 * penalty * 2 * pi * 1 / steps);
  EXPECT_GE(scene.memory.walks, 32);
}

TEST(Drag, OverAVertexLosesNoStepAndDoesNotJump) {
  for (const double way : {0.0, 0.3, 0.78539816, 1.1}) {  // exactly over the vertex, in four directions
    Scene scene = press(sheet(4, 4, [](double x, double y) { return -0.3 * std::max(std::abs(x - 2), std::abs(y - 2)); }, 0),
                        {{2, 2, 0.07}}, 0.1);
    constexpr int steps = 2000;
    const Drag seen = drag(scene, steps, [&](double s) {
      const double r = s - 0.5, c = r * std::cos(way), d = r * std::sin(way);
      return Vec3(2 + c, 2 + d, 0.08 - 0.3 * std::max(std::abs(c), std::abs(d)));
    });
    EXPECT_EQ(seen.missed, 0);
    EXPECT_LT(seen.largest_jump, 2 * penalty / steps);
  }
}

// ------------------------------------------------------------------ contact damping

/// A mass that falls on a fixed plain at unit speed and leaves it again, by central differences.
struct Bounce {
  double speed = 0;        ///< after the bounce
  double least_force = 0;  ///< on the apex, upwards
  Memory memory;
};
Bounce bounce(double damping_time) {
  Scene scene = press(sheet(4, 4, flat), {{1.3, 2.6, 0.11}}, 0.1);
  scene.interface.damping_time = damping_time;
  const double mass = 1, dt = 0.02 / std::sqrt(penalty / mass);
  Vectors v = Vectors::Zero(3, scene.x.cols());
  v(2, scene.apex()) = -1;
  Bounce seen;
  bool touched = false;
  for (int step = 0; step < 100000; ++step) {
    scene.x += dt * v;
    advance(scene.interface, scene.x, v, none, dt, scene.memory, scene.workspace);
    const double force = scene.forces()(2, scene.apex());
    seen.least_force = std::min(seen.least_force, force);
    touched = touched || scene.memory.status[0] == Status::closed;
    if (touched && scene.memory.status[0] == Status::open) break;
    v(2, scene.apex()) += dt / mass * force;
  }
  seen.speed = v(2, scene.apex());
  seen.memory = scene.memory;
  return seen;
}

TEST(Retardation, TakesEnergyThatItBooksAndNeverPulls) {
  const double omega = std::sqrt(penalty);
  double speed = 1.001;
  for (const double zeta : {0.0, 0.1, 0.3, 0.7}) {
    const Bounce seen = bounce(2 * zeta / omega);
    EXPECT_LT(seen.speed, speed) << zeta;  // the more it is damped, the slower it leaves
    EXPECT_GE(seen.least_force, 0);
    EXPECT_NEAR(seen.memory.damped, 0.5 * (1 - seen.speed * seen.speed), 0.02) << zeta;
    // on and off at samples: dt^2 k / (4 m) of the impact's energy at most
    EXPECT_LT(std::abs(seen.memory.work + seen.memory.damped + stored(seen.memory)), 0.5 * 0.02 * 0.02 / 4 * 1.01);
    speed = seen.speed;
  }
}

TEST(Retardation, ScalesAllForcesOfAnElementSoThatNoneIsLeftOver) {
  Scene scene = press(sheet(4, 4, fold(0.4)), {{2.01, 2.4, 0.07}}, 0.1);
  scene.interface.damping_time = 1e-3;
  Vectors v = Vectors::Zero(3, scene.x.cols());
  v.col(scene.apex()) = Vec3(3, -2, -7);
  advance(scene.interface, scene.x, v, none, 1e-6, scene.memory, scene.workspace);
  EXPECT_GT(scene.element().scale, 1);
  const Vectors f = scene.forces();
  EXPECT_LT(f.rowwise().sum().norm(), 1e-12 * f.norm());
}

// ------------------------------------------------------------------ being lost

TEST(Lost, AnApexOutOfReachIsFoundAgainByTheSearch) {
  Scene scene = press(sheet(4, 4, flat), {{1.4, 1.2, 0.07}}, 0.1);
  scene.interface.margin = scene.memory.margin = 0.5;
  scene.move({1.4, 1.2, 2});
  scene.update();  // opens
  scene.update();
  EXPECT_EQ(scene.memory.status[0], Status::unpaired);
  EXPECT_TRUE(std::isnan(scene.memory.gap[0]));
  EXPECT_EQ(scene.memory.lost, 0) << "counts walks that did not end, and not apexes that are far";
  EXPECT_TRUE(scene.forces().isZero(0));
  scene.move({3.4, 3.2, 0.06});
  int steps = 0;
  while (scene.memory.status[0] == Status::unpaired && steps < 20) scene.update(), ++steps;
  EXPECT_LE(steps, 10);
  EXPECT_EQ(scene.memory.recovered, 1);
  EXPECT_EQ(scene.memory.status[0], Status::closed);
  const std::int64_t walks = scene.memory.walks;
  scene.update();
  EXPECT_EQ(scene.memory.walks, walks);  // an apex that rests is not found anew at every step
  EXPECT_NEAR(scene.forces()(2, scene.apex()), penalty * 0.04, 1e-9);
}

TEST(Lost, ASearchWithPositionsThatAreNotFiniteLeavesAllAsItIs) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double place : {std::nan(""), inf, -inf, 1e300}) {
    Scene scene = press(sheet(4, 4, flat), {{1.4, 1.2, 0.07}, {2.4, 2.2, 0.07}, {9, 9, 900}}, 0.1);
    ASSERT_EQ(scene.memory.status[2], Status::unpaired);
    Scene with_apex = scene, with_base = scene;
    with_apex.move({place, 1, 1}, 2);
    with_apex.update();
    EXPECT_EQ(with_apex.memory.status[0], Status::closed);
    EXPECT_EQ(with_apex.memory.status[2], Status::unpaired);
    with_base.x(1, 3) = place;  // far from the apexes
    with_base.move({3.4, 3.2, 0.06}, 2);
    with_base.update();
    EXPECT_EQ(with_base.memory.recovered, 0);
    EXPECT_EQ(with_base.memory.status[0], Status::closed);
    scene.x.setConstant(place);
    scene.update();
    EXPECT_EQ(scene.memory.recovered, 0);
  }
}

TEST(InitialGaps, OfPositionsThatAreNotFiniteFindNoBase) {
  const Shape shape = sheet(2, 2, flat);
  Shape torn = shape;
  torn.x(0, 4) = std::nan("");
  EXPECT_EQ(press(torn, {{0.4, 0.2, 0.2}}, 0.1).gaps.without_base, 1);
  EXPECT_EQ(press(shape, {{0.4, 1e300, 0.2}, {0.4, 0.2, 0.2}}, 0.1).gaps.without_base, 1);
}

TEST(Lost, EnergyOfAnApexThatJumpsAwayIsBookedAsReconnection) {
  // two sheets apart; the apex jumps from contact with one into contact with the other
  Shape two = sheet(2, 2, flat);
  const Shape other = sheet(2, 2, flat);
  const auto nodes = static_cast<Index>(two.x.cols());
  const auto facets = two.facets.cols();
  two.x.conservativeResize(3, 2 * nodes);
  two.x.rightCols(nodes) = other.x.colwise() + Vec3(10, 0, 0);
  two.facets.conservativeResize(3, 2 * facets);
  two.facets.rightCols(facets) = other.facets.array() + nodes;
  Scene scene = press(two, {{1.2, 1.3, 0.07}}, 0.1);
  scene.interface.margin = scene.memory.margin = 1;
  const double before = stored(scene.memory);
  scene.move({11.3, 1.2, 0.05});
  scene.update();
  scene.update();
  EXPECT_EQ(scene.memory.status[0], Status::closed);
  EXPECT_NEAR(scene.memory.created_by_reconnection, -before, 1e-15);
}

// ------------------------------------------------------------------ odd surfaces

TEST(OddSurface, OfSliversPushesLikeAPlain) {
  Shape shape = sheet(6, 6, flat, 0.2);
  shape.x.row(0) *= 1e-3;  // a thousand times longer than wide; far narrower than h_c
  Scene scene = press(shape, {{1e-3, 1, 0.07}}, 0.1);
  const Drag seen = drag(scene, 500, [](double s) { return Vec3(1e-3 * (1 + 4 * s), 1 + 3.3 * s, 0.07); });
  EXPECT_EQ(seen.missed, 0);
  EXPECT_NEAR(seen.least, penalty * 0.03, 1e-8);
  EXPECT_NEAR(seen.most, penalty * 0.03, 1e-8);
}

// ------------------------------------------------------------------ the interface of the cask

struct Cask {
  Scene scene;
  double side;  ///< [m2] area of the lead's side
};
Cask cask(mesh::Revolution turn, int core, int along, double clearance) {
  constexpr double radius = 0.1525, thickness = 0.00635, length = 0.914;
  const mesh::Mesh joined = mesh::join(mesh::cylinder("lead", {radius, length, turn, core, 2, along}),
                                       mesh::tube("skin", {radius + thickness / 2, length, turn, core, along}));
  const mesh::Surface& side = mesh::surface(joined, "lead.side");
  const mesh::Surface& inside = mesh::surface(joined, "skin.inside");
  Interface in;
  in.base = base_surface(inside, joined.X);
  in.apexes = mesh::surface_nodes(side);
  in.area = mesh::tributary_areas(joined, side, in.apexes);
  in.facet_area = mesh::facet_areas(joined, inside);
  in.penalty = 1e12;
  in.margin = 1;
  if (turn == mesh::Revolution::quarter) {
    in.allowed.assign(in.apexes.size(), Mat3::Identity());
    for (std::size_t a = 0; a < in.apexes.size(); ++a)
      for (int axis = 0; axis < 2; ++axis)
        if (joined.X(axis, in.apexes[a]) == 0) in.allowed[a](axis, axis) = 0;
    for (int axis = 0; axis < 2; ++axis) goes_on_behind(in.base, nodes_at_zero(joined.X, axis));
  }
  return {scene_of(joined.X, std::move(in), {true, clearance, 0}), mesh::facet_areas(joined, side).sum()};
}

TEST(Cask, StartsWithTheClearanceEverywhere) {
  for (const mesh::Revolution turn : {mesh::Revolution::full, mesh::Revolution::quarter}) {
    for (const double clearance : {0.0, 0.5e-3}) {
      for (const auto& [core, along] : {std::pair(2, 6), std::pair(4, 12), std::pair(6, 30)}) {
        const Cask c = cask(turn, core, along, clearance);
        EXPECT_EQ(c.scene.gaps.without_base, 0);
        EXPECT_EQ(c.scene.gaps.penetrating, 0);
        EXPECT_NEAR(c.scene.gaps.least, clearance, 1e-12 * 0.1525);
        EXPECT_NEAR(c.scene.gaps.largest, clearance, 1e-12 * 0.1525);
        EXPECT_NEAR(c.scene.interface.area.sum(), c.side, 1e-12 * c.side);
        // a chord is nearer than the circle
        EXPECT_LT(c.scene.interface.contact_height.maxCoeff(), 0.00635 / 2 - clearance);
      }
    }
  }
}

TEST(Cask, StartsWithoutForce) {
  Cask c = cask(mesh::Revolution::quarter, 4, 8, 0);
  c.scene.update();
  EXPECT_LT(stored(c.scene.memory), 1e-20);
}

TEST(Cask, PushesEachApexByItsTributaryAreaOnceAlsoOnSymmetryPlanes) {
  for (const mesh::Revolution turn : {mesh::Revolution::full, mesh::Revolution::quarter}) {
    for (const auto& [core, along] : {std::pair(2, 4), std::pair(4, 8)}) {
      Cask c = cask(turn, core, along, 0);
      double worst = 0;
      const auto apexes = static_cast<Index>(c.scene.interface.apexes.size());
      const Vectors start = c.scene.x;
      const auto radial_force = [&](double by) {
        for (Index a = 0; a < apexes; ++a) {
          Vec3 out = start.col(c.scene.apex(a));
          out.z() = 0;
          c.scene.move(start.col(c.scene.apex(a)) + by * out.normalized(), a);
        }
        c.scene.update();
        Scalars f(apexes);
        for (Index a = 0; a < apexes; ++a) {
          Vec3 out = start.col(c.scene.apex(a));
          out.z() = 0;
          f(a) = -c.scene.element(a).apex.dot(out.normalized());
        }
        return f;
      };
      const Scalars slope = (radial_force(2e-6) - radial_force(1e-6)) / 1e-6;
      for (Index a = 0; a < apexes; ++a)
        worst = std::max(worst, std::abs(slope(a) / (c.scene.interface.penalty * c.scene.interface.area(a)) - 1));
      EXPECT_LT(worst, 1e-8) << core << ' ' << along;
    }
  }
}

TEST(Cask, ApexesOnSymmetryPlanesFeelTheMirrorImages) {
  // a quarter's apex on a plane has half the area of the full turn's: it gets half the force
  Cask quarter = cask(mesh::Revolution::quarter, 3, 4, 0), full = cask(mesh::Revolution::full, 3, 4, 0);
  for (Cask* c : {&quarter, &full}) {
    c->scene.x.topRows(2).leftCols(c->scene.interface.base.facets.minCoeff()) *= 1 + 1e-5;
    c->scene.update();
  }
  const auto at = [](const Cask& c, const Vec3& place) {
    for (Index a = 0; a < static_cast<Index>(c.scene.interface.apexes.size()); ++a)
      if ((c.scene.x.col(c.scene.apex(a)) - place).norm() < 1e-9) return a;
    return Index{-1};
  };
  for (Index a = 0; a < static_cast<Index>(quarter.scene.interface.apexes.size()); ++a) {
    const Vec3 place = quarter.scene.x.col(quarter.scene.apex(a));
    const Index b = at(full, place);
    ASSERT_GE(b, 0);
    const Mat3& allowed = quarter.scene.interface.allowed[a];
    const double part = quarter.scene.interface.area(a) / full.scene.interface.area(b);
    const Vec3 f = full.scene.element(b).apex;
    EXPECT_LT((allowed * quarter.scene.element(a).apex - part * f).norm(), 1e-6 * f.norm());
  }
}

TEST(Cask, TurnedInsideOutFeelsTheMirrorImagesOfARidge) {
  // apexes outside a quarter of a convex tube: at the planes its borders are ridges of the full turn
  const mesh::Mesh tube = mesh::tube("tube", {1, 1, mesh::Revolution::quarter, 4, 4});
  const std::vector<Vec3> apexes{{0, 1.05, 0.5}, {0, 1.05, 0.4}, {1.05, 0, 0.5}, {1.05, 0, 1.05}};
  Scene scene = press({tube.X, mesh::surface(tube, "tube.outside").facets}, apexes, 0.1);
  Mat3 no_x = Mat3::Identity(), no_y = no_x;
  no_x(0, 0) = 0, no_y(1, 1) = 0;
  scene.interface.allowed = {no_x, no_x, no_y, no_y};
  for (int axis = 0; axis < 2; ++axis) goes_on_behind(scene.interface.base, nodes_at_zero(tube.X, axis));
  scene.update();
  for (Index a = 0; a < 3; ++a) {
    Vec3 out = apexes[a];
    out.z() = 0;
    EXPECT_LT((scene.element(a).apex - penalty * 0.05 * out.normalized()).norm(), 1e-9);
  }
  const double reach = whole_past_wall * scene.interface.base.size(scene.near(3).tracks.track[0].facet);
  const Vec3 off_the_end = Vec3(apexes[3]) - Vec3(1, 0, 1 + reach);  // around the border the layer is round; the facet leans by 11 degrees
  EXPECT_LT((scene.element(3).apex - penalty * (0.1 - off_the_end.norm()) * off_the_end.normalized()).norm(), 1);
}

// ------------------------------------------------------------------ the step limit on the time step

TEST(StableStep, OfAnApexOverAVertexIsThatOfTwoMassesOnASpring) {
  const Scene built = press(corner(false), {Vec3(-0.03, -0.04, -0.05)}, 0.1);
  Scene scene = built;
  Scalars mass = Scalars::Constant(5, 1e9);
  mass(0) = 3, mass(4) = 2;
  const double expected = scene.interface.impact_step_factor / std::sqrt(penalty * (1.0 / 2 + 1.0 / 3));
  EXPECT_NEAR(stable_step(scene.interface, mass, no_inertia, scene.memory, scene.workspace).step, expected, 1e-12);
}

TEST(StableStep, AddsUpSpringsThatShareANode) {
  Scene scene = press(corner(false), {Vec3(-0.03, -0.04, -0.05), Vec3(-0.04, -0.03, -0.05)}, 0.1);
  Scalars mass = Scalars::Constant(6, 1e9);
  mass(0) = 3, mass(4) = 2, mass(5) = 2;
  const double expected = scene.interface.impact_step_factor / std::sqrt(penalty * (1.0 / 2 + 2.0 / 3));
  EXPECT_NEAR(stable_step(scene.interface, mass, no_inertia, scene.memory, scene.workspace).step, expected, 1e-12);
}

TEST(StableStep, FallsBitByBitAsAnApexComes) {
  Scene scene = press(corner(false), {Vec3(-0.03, -0.04, -0.3)}, 0.1);
  scene.interface.depth = 4;  // it limits the step within 1
  Vectors v = Vectors::Zero(3, scene.x.cols());
  v(2, scene.apex()) = 2;
  const Vec3 away(-0.03, -0.04, -0.95);
  const auto go = [&](const Vec3& to, double dt) {
    scene.move(to);
    advance(scene.interface, scene.x, v, none, dt, scene.memory, scene.workspace);
  };
  Scalars mass = Scalars::Constant(5, 1e9);
  mass(0) = 3, mass(4) = 2;
  const double pressed = scene.interface.impact_step_factor / std::sqrt(penalty * (1.0 / 2 + 1.0 / 3));
  const auto limit = [&](double last) {
    return stable_step(scene.interface, mass, no_inertia, scene.memory, scene.workspace, last).step;
  };
  go(away, 1e-9);
  ASSERT_FALSE(scene.element().closed);
  EXPECT_NEAR(limit(0.03), 0.8 * 0.03, 1e-12);
  EXPECT_NEAR(limit(1), 0.5 * (away.norm() - 0.1) / 2, 1e-9) << "it closes within two steps of this length";
  EXPECT_NEAR(limit(pressed), pressed, 1e-12);
  EXPECT_NEAR(limit(0), pressed, 1e-12);
  const Vec3 nearer(-0.03, -0.04, -0.9);
  go(nearer, 0.025);
  EXPECT_NEAR(limit(1), 0.5 * (nearer.norm() - 0.1) / 2, 1e-9) << "it is looked at in every step, wherever it can close next";
  v(2, scene.apex()) = 8;
  go(nearer, 1e-9);
  EXPECT_NEAR(limit(1), 0.5 * (nearer.norm() - 0.1) / 8, 1e-9) << "also where its speed alone has changed";
  go(Vec3(-0.03, -0.04, -0.05), 0.5);
  ASSERT_TRUE(scene.element().closed);
  EXPECT_NEAR(limit(1), pressed, 1e-12);
}

TEST(StableStep, WithoutBasesVotesForNothing) {
  Scene scene = press(sheet(2, 2, flat), {{500, 50, 50}}, 0.1);
  EXPECT_GT(stable_step(scene.interface, Scalars::Ones(10), no_inertia, scene.memory, scene.workspace).step, 1e200);
}

/// Exact largest frequency squared of the contact springs, by differences of the forces.
double omega_squared(const Scene& scene, const Scalars& mass) {
  const Index n = 3 * static_cast<Index>(scene.x.cols());
  Eigen::MatrixXd K(n, n);
  constexpr double step = 1e-7;
  for (Index j = 0; j < n; ++j) {
    Scene ahead = scene, behind = scene;
    ahead.x(j % 3, j / 3) += step;
    behind.x(j % 3, j / 3) -= step;
    ahead.update();
    behind.update();
    const Vectors f = (behind.forces() - ahead.forces()) / (2 * step);
    K.col(j) = f.reshaped();
  }
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) K(i, j) /= std::sqrt(mass(i / 3) * mass(j / 3));
  return eigenvalues(0.5 * (K + K.transpose())).maxCoeff();
}

/// The frequency of the step limit over the exact one, least and largest over random interfaces on a shape.
std::array<double, 2> vote_over_exact(const std::function<double(double, double)>& ground, double depth, bool even) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(0, 1);
  double least = 1e300, most = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<Vec3> apexes;
    for (int a = 0; a < 6; ++a) {
      const double x = a % 2 == 0 ? 2 + 0.01 * (unit(random) - 0.5) : 1 + 2 * unit(random), y = 1 + 2 * unit(random);
      apexes.push_back({x, y, ground(x, y) + 0.1 - depth});
    }
    Scene scene = press(sheet(4, 4, ground, 0), apexes, 0.1);
    Scalars mass(scene.x.cols());
    for (Index i = 0; i < mass.size(); ++i) mass(i) = even ? 1 : std::pow(10.0, 2 * unit(random));
    const double limit =
        scene.interface.impact_step_factor / stable_step(scene.interface, mass, no_inertia, scene.memory, scene.workspace).step;
    const double ratio = limit / std::sqrt(omega_squared(scene, mass));
    least = std::min(least, ratio), most = std::max(most, ratio);
  }
  return {least, most};
}

TEST(StableStep, VoteIsNeverBelowTheExactFrequency) {
  for (const bool even : {true, false}) {
    for (const double slope : {0.0, -0.5, 0.02, 0.2, 0.5, 1.0}) {
      const auto [least, most] = vote_over_exact(fold(slope), 0.005, even);
      EXPECT_GE(least, 1 - 1e-6) << "slope " << slope << " even " << even;
      EXPECT_LT(most, 1.25) << "slope " << slope << " even " << even;
    }
  }
}

// ------------------------------------------------------------------ threads and memory

/// Many apexes dragged over random ground; a search every 7 steps.
Scene many() {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(0, 1);
  Shape shape = sheet(10, 10, flat, 0.2);
  for (Index n = 0; n < shape.x.cols(); ++n) shape.x(2, n) = 0.15 * unit(random);
  std::vector<Vec3> apexes;
  for (int a = 0; a < 200; ++a) apexes.push_back({10 * unit(random), 10 * unit(random), 0.25 * unit(random)});
  Scene scene = press(shape, apexes, 0.1);
  scene.interface.margin = scene.memory.margin = 0.02;  // many searches
  scene.interface.friction = {0.3, 0.7};
  scene.workspace = Workspace(scene.interface);
  scene.memory.slip.assign(200, Vec3::Zero());
  scene.memory.tangential_stored.assign(200, 0.0);
  scene.update();
  return scene;
}

TEST(Threads, GiveTheSameBits) {
  std::vector<Vectors> forces;
  std::vector<double> work, gap;
  for (const int threads : {1, 2, 4}) {
    use_threads(threads);
    Scene scene = many();
    Vectors v = Vectors::Zero(3, scene.x.cols());
    v.rightCols(200).row(0).setConstant(0.3);
    for (int step = 0; step < 50; ++step) {
      scene.x += 0.05 * v;
      advance(scene.interface, scene.x, v, none, 0.05, scene.memory, scene.workspace);
    }
    forces.push_back(scene.forces());
    work.push_back(scene.memory.work + scene.memory.created_by_reconnection);
    EXPECT_GT(scene.memory.walks, 100);
  }
  use_threads(1);
  for (int i = 1; i < 3; ++i) {
    EXPECT_TRUE((forces[i].array() == forces[0].array()).all());
    EXPECT_EQ(work[i], work[0]);
  }
}

#ifndef NEREID_SANITIZED
/// Of each apex, whether it has friction and whether it has had several stencils.
std::vector<int> parts_of_few(const Scene& scene) {
  std::vector<int> parts(scene.interface.apexes.size(), 0);
  for (const Near& near : scene.memory.near)
    parts[static_cast<std::size_t>(near.apex)] = near.friction.exists() + near.element.stencil.has_others();
  return parts;
}

TEST(Memory, IsTakenWhereAnApexFirstHasFrictionOrSeveralStencilsAndElseNotInAStep) {
  for (const int threads : {1, 2}) {
    use_threads(threads);
    Scene scene = many();
    Vectors v = Vectors::Zero(3, scene.x.cols()), f = v, no_moment = none;
    v.rightCols(200).row(0).setConstant(0.3);
    const Scalars mass = Scalars::Ones(scene.x.cols());
    advance(scene.interface, scene.x, v, none, 0.05, scene.memory, scene.workspace);  // threads start
    for (int step = 0; step < 20; ++step) {  // with two searches
      const std::vector<int> parts = parts_of_few(scene);
      const long before = allocations;
      scene.x += 0.05 * v;
      advance(scene.interface, scene.x, v, none, 0.05, scene.memory, scene.workspace);
      add_forces(scene.interface, scene.memory, f, no_moment);
      EXPECT_GT(stable_step(scene.interface, mass, no_inertia, scene.memory, scene.workspace).step, 0);
      const long taken = allocations - before;
      const std::vector<int> then = parts_of_few(scene);
      long made = 0;
      for (std::size_t a = 0; a < parts.size(); ++a) made += std::max(0, then[a] - parts[a]);
      EXPECT_EQ(taken, made);
    }
  }
  use_threads(1);
}
#endif

// ------------------------------------------------------------------ the penalty oscillator

struct Impact {
  double duration = 0, peak = 0, deepest = 0, created = 0, momentum = 0, booked = 0;
};
/// Masses 1 and 3, k = 1e6, approach at 2: an apex over a vertex, by leapfrog.
Impact impact(double step_over_limit, double phase) {
  const Shape one = corner(false);
  const Vec3 out = -Vec3::Ones() / std::sqrt(3.0);
  constexpr double k = 1e6, reduced = 0.75, h_c = 0.1;
  const double dt = step_over_limit * std::sqrt(reduced / k);
  Interface in = interface_over(one, 1);
  in.penalty = k;
  Vectors x(3, 5);
  x << one.x, (h_c + 2 * dt * phase) * out;
  Scene scene = scene_of(x, in, {false, 0, h_c});
  scene.update();
  Scalars mass(5);
  mass << 3, 1e300, 1e300, 1e300, 1;
  Vectors v = Vectors::Zero(3, 5);
  v.col(4) = -2 * out;
  Impact seen;
  bool touched = false;
  for (int step = 0; step < 100000; ++step) {
    scene.x += dt * v;
    advance(scene.interface, scene.x, v, none, dt, scene.memory, scene.workspace);
    const Vectors f = scene.forces();
    const bool closed = scene.memory.status[0] == Status::closed;
    touched = touched || closed;
    if (touched && !closed) break;
    if (closed) {
      seen.duration += dt;
      seen.peak = std::max(seen.peak, f.col(4).norm());
      seen.deepest = std::max(seen.deepest, -scene.memory.gap[0]);
    }
    for (Index n = 0; n < 5; ++n) v.col(n) += dt / mass(n) * f.col(n);
  }
  EXPECT_NEAR(scene.memory.deepest, seen.deepest, 1e-16);
  seen.momentum = (3 * v.col(0) + v.col(4)).dot(out);
  seen.created = (0.5 * (3 * v.col(0).squaredNorm() + v.col(4).squaredNorm()) - 2.0) / (0.5 * reduced * 4);
  seen.booked = scene.memory.work / (0.5 * reduced * 4);
  return seen;
}

TEST(Impact, OfTwoMassesTakesHalfAPeriodAndReachesTheExactPeaks) {
  const Impact seen = impact(2e-3, 0.5);
  EXPECT_NEAR(seen.duration, 2.7207e-3, 2e-6);  // one step: 1.7e-6
  EXPECT_NEAR(seen.peak, 1732.05, 0.01);
  EXPECT_NEAR(seen.deepest, 1.73205e-3, 1e-8);
}

TEST(Impact, ConservesMomentumAndBooksWhatItCreates) {
  const Impact seen = impact(0.5, 0.5);
  EXPECT_NEAR(seen.momentum, -2, 1e-12);
  EXPECT_NEAR(seen.booked, seen.created, 1e-12);
}

TEST(Impact, CreatesTheEnergyOfTheCatalogue) {
  const std::array steps{0.05, 0.1, 0.2, 0.5}, rebound{1.0002, 1.0012, 1.0044, 1.0222};
  for (int i = 0; i < 4; ++i) {
    double worst = 0;
    for (int phase = 0; phase < 400; ++phase) worst = std::max(worst, impact(steps[i], (phase + 0.5) / 400).created);
    EXPECT_NEAR(std::sqrt(1 + worst), rebound[i], 1.5e-4) << steps[i];
  }
}

TEST(Impact, AtTheStepOfTheVoteCreatesNoMoreThanItsBound) {
  double worst = 0;
  for (const double part : {1.0, 0.97, 0.9, 0.8, 0.7})
    for (int phase = 0; phase < 50; ++phase)
      worst = std::max(worst, impact(part * Interface{}.impact_step_factor, (phase + 0.5) / 50).created);
  EXPECT_LE(worst, 0.005);
  EXPECT_GT(worst, 0.003);
}

TEST(Impact, IsBoundedBelowTheLinearLimitAndNotAbove) {
  EXPECT_LT(impact(1.9, 0.5).created, 100);
  EXPECT_NEAR(2 * std::sqrt(0.75 / 1e6), 1.7321e-3, 1e-7);
  // two masses held together feel the limit: a linear spring of the same stiffness, never released
  for (const double step : {1.99, 2.01}) {
    double gap = -1e-3, speed = 0;
    for (int i = 0; i < 2000; ++i) speed -= step * gap, gap += step * speed;
    EXPECT_EQ(std::abs(gap) < 1, step < 2);
  }
}

}  // namespace
}  // namespace nereid::contact::contact_test
