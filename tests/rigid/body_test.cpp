#include "rigid/body.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace nereid::rigid::body_test {
namespace {

/// A body with four nodes that do not lie in a plane.
Body top(const Mat3& inertia = Mat3(Vec3(1, 2, 2.5).asDiagonal())) {
  Vectors X(3, 4);
  X << 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1, -1;
  return rigid::make_body("top", {2, Vec3(0.1, 0.2, 0.3), inertia}, X, {0, 1, 2, 3});
}

Mat3 turn_of(const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(); }

TEST(RigidBody, AFreeAsymmetricTopKeepsItsEnergyOverAHundredTurns) {
  const Body body = top();
  State now;
  rigid::set_velocities(body, Vec3(1, 2, 3), Vec3(0.01, 1, 0.02), now);  // about the middle axis: it tumbles
  const Vec3 L = now.angular_momentum;
  const double energy = rigid::kinetic_energy(body, now), dt = 2 * pi / 100;  // a hundred steps for a turn
  double worst = 0;
  bool tumbled = false;
  for (int step = 0; step < 100 * 100; ++step) {
    rigid::drift(body, rigid::twist_of(body, now, dt), dt, now);
    worst = std::max(worst, std::abs(rigid::kinetic_energy(body, now) / energy - 1));
    tumbled = tumbled || rigid::turned_back(now.turn, rigid::angular_velocity(body, now)).y() < -0.9;
  }
  EXPECT_EQ(now.angular_momentum, L);
  EXPECT_LT(worst, 1e-11);
  EXPECT_TRUE(tumbled);
  EXPECT_NEAR(std::hypot(now.turn.real, now.turn.vector.norm()), 1, 1e-15);
}

TEST(RigidBody, ASymmetricTopPrecessesAsTheExactOneWithFourthOrder) {
  // about its axis L the figure axis goes round with |L|/J1
  const Body body = top(Vec3(2, 2, 1).asDiagonal());
  const auto error = [&](int steps) {
    State now;
    rigid::set_velocities(body, Vec3::Zero(), Vec3(0.5, 0, 2), now);
    const Vec3 L = now.angular_momentum, axis = Vec3::UnitZ();
    const double end = 10, dt = end / steps;
    for (int k = 0; k < steps; ++k) rigid::drift(body, rigid::twist_of(body, now, dt), dt, now);
    return (rigid::turned(now.turn, axis) - turn_of(L, L.norm() / 2 * end) * axis).norm();
  };
  EXPECT_LT(error(1000), 2e-7);  // a part in 1e8 of the angle with 0.02 rad in a step
  EXPECT_NEAR(error(100) / error(200), 16, 0.5);
}

TEST(RigidBody, LargeTurnsOfAStepKeepItsEnergy) {
  const Body body = top();
  for (const double dt : {0.0, 0.3, 0.6, 2.0, 6.0}) {
    State now;
    rigid::set_velocities(body, Vec3::Zero(), Vec3(0.8, 0.5, -0.3), now);
    const double energy = rigid::kinetic_energy(body, now);
    for (int k = 0; k < 100; ++k) rigid::drift(body, rigid::twist_of(body, now, dt), dt, now);
    EXPECT_NEAR(rigid::kinetic_energy(body, now) / energy, 1, 1e-12) << dt;
  }
}

TEST(RigidBody, ATorqueGivesItsAngularImpulseExactly) {
  const Body body = top();
  State now;
  const Vec3 torque(0.3, -0.2, 0.1), force(1, 0, 2);
  const double dt = 0.01;
  for (int k = 0; k < 500; ++k) {
    rigid::kick(body, dt / 2 * force, dt / 2 * torque, now);
    rigid::drift(body, rigid::twist_of(body, now, dt), dt, now);
    rigid::kick(body, dt / 2 * force, dt / 2 * torque, now);
  }
  EXPECT_LT((now.angular_momentum - 5 * torque).norm(), 1e-13);
  EXPECT_LT((now.momentum - 5 * force).norm(), 1e-12);
  EXPECT_LT((now.shift - 0.5 * 25 / body.mass.mass * force).norm(), 1e-10);
}

TEST(RigidBody, MotionTurnsWithItsFrame) {
  const Mat3 Q = turn_of({1, -2, 3}, 1.1);
  const Mat3 J = Vec3(1, 2, 2.5).asDiagonal();
  const Body one = top(J), other = top(Q * J * Q.transpose());
  State a, b;
  rigid::set_velocities(one, Vec3(1, 0, 0), Vec3(0.3, 1, -0.4), a);
  rigid::set_velocities(other, Q * Vec3(1, 0, 0), Q * Vec3(0.3, 1, -0.4), b);
  for (int k = 0; k < 300; ++k) {
    rigid::drift(one, rigid::twist_of(one, a, 0.05), 0.05, a);
    rigid::drift(other, rigid::twist_of(other, b, 0.05), 0.05, b);
  }
  EXPECT_LT((b.shift - Q * a.shift).norm(), 1e-12);
  EXPECT_LT((rigid::matrix(b.turn) - Q * rigid::matrix(a.turn) * Q.transpose()).norm(), 1e-11);
}

TEST(RigidBody, NodesStayWhereTheyAreInIt) {
  const Body body = top();
  Vectors X(3, 4);
  for (int i = 0; i < 4; ++i) X.col(i) = body.mass.centre + body.arm.col(i);
  State now;
  rigid::set_velocities(body, Vec3(10, 0, 1), Vec3(3, 1, 2), now);
  Vectors x = X, before = X;
  const double dt = 0.1;
  for (int k = 0; k < 1000; ++k) {
    before = x;
    const rigid::Twist twist = rigid::twist_of(body, now, dt);
    const Vec3 centre = rigid::centre(body, now);
    const Mat3 R = rigid::matrix(now.turn), turned = rigid::turn_in_step(twist, now.turn, dt);
    rigid::drift(body, twist, dt, now);
    EXPECT_LT((rigid::matrix(now.turn) - R - turned).norm(), 1e-14);
    rigid::place_nodes(body, now, X, x);
    for (int i = 0; i < 4; ++i)
      EXPECT_LT((x.col(i) - before.col(i) - dt * rigid::velocity_at(twist, before.col(i) - centre, dt)).norm(), 1e-11);
  }
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR((x.col(i) - x.col(j)).norm(), (X.col(i) - X.col(j)).norm(), 1e-11);
}

TEST(RigidBody, TurnsAboutAFixedAxisAtConstantSpeed) {
  Body body = top(Mat3(Vec3(1, 2, 2.5).asDiagonal()) + 0.1 * Mat3::Ones());
  body.hold = {.shift = Mat3::Identity() - Vec3::UnitX() * Vec3::UnitX().transpose(), .turns = 1, .axis = Vec3::UnitX()};
  State now;
  rigid::kick(body, Vec3(5, 1, 0), Vec3(2.2, 7, 8), now);
  EXPECT_LT((rigid::angular_velocity(body, now) - Vec3(2, 0, 0)).norm(), 1e-14);  // J_xx = 1.1
  EXPECT_LT((now.momentum - Vec3(0, 1, 0)).norm(), 1e-15);
  const double energy = rigid::kinetic_energy(body, now);
  for (int k = 0; k < 100; ++k) rigid::drift(body, rigid::twist_of(body, now, 0.03), 0.03, now);
  EXPECT_LT((rigid::angular_velocity(body, now) - Vec3(2, 0, 0)).norm(), 1e-13);
  EXPECT_NEAR(rigid::kinetic_energy(body, now), energy, 1e-13 * energy);
}

TEST(RigidBody, MassesThatAreSafeAnswerNoLess) {
  const Body body = top();
  Scalars mass(4);
  mass << 0.4, 0.5, 0.6, 0.5;
  const double share = rigid::safe_share(body, mass);
  double closest = 1;
  for (int k = 0; k < 2000; ++k) {
    Vectors impulse = Vectors::Random(3, 4);
    if (k % 2 == 0)  // those of rigid motions answer most alike
      for (int i = 0; i < 4; ++i) impulse.col(i) = mass(i) * (impulse.col(0) + Vec3(impulse.col(1)).cross(Vec3(body.arm.col(i))));
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    double free = 0;
    for (int i = 0; i < 4; ++i) {
      linear += impulse.col(i), angular += Vec3(body.arm.col(i)).cross(Vec3(impulse.col(i)));
      free += impulse.col(i).squaredNorm() / (share * mass(i));
    }
    const double of_body = linear.squaredNorm() / body.mass.mass + angular.dot(body.inverse * angular);
    EXPECT_LE(of_body, free * (1 + 1e-12));
    closest = std::min(closest, 1 - of_body / free);
  }
  EXPECT_LT(closest, 0.5);  // nor far less than they could
}

TEST(RigidBody, AFitFindsARigidMotion) {
  const Body body = top();
  const Vec3 velocity(1, -2, 3), spin(0.4, 0.5, -0.6);
  Vectors v(3, 4);
  for (int i = 0; i < 4; ++i) v.col(i) = velocity + spin.cross(Vec3(body.arm.col(i)));
  const rigid::Twist found = rigid::fit(body, v);
  EXPECT_LT((found.velocity - velocity).norm(), 1e-14);
  EXPECT_LT((found.spin - spin).norm(), 1e-14);
}

TEST(RigidBody, SharesOfItsMassHaveItsCentre) {
  const Body body = top();
  Scalars mass(4);
  mass << 0.4, 0.5, 0.6, 0.5;
  const Scalars share = rigid::shares_of_mass(body, mass);
  EXPECT_NEAR(share.sum(), body.mass.mass, 1e-14);
  EXPECT_LT((body.arm * share).norm(), 1e-14);
}

}  // namespace
}  // namespace nereid::rigid::body_test
