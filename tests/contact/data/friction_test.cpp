#include "contact/data/friction.hpp"
#include "tests/base/chance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace nereid::contact::friction_test {
namespace {

Vec3 random_vector() {
  static Chance random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  return {unit(random), unit(random), unit(random)};
}

enum class Side { solid, plate };

/// Nodes 0-2 a facet, node 3 an apex over it; plates have columns 0-3 of angular velocity.
struct Pair {
  Vectors x{3, 4};
  Touch touch;
  std::vector<Index> rotation_of_node{0, 1, 2, 3};

  Pair(Side base, Side apex) {
    for (int n = 0; n < 3; ++n) x.col(n) = Vec3::Unit(n) + 0.2 * random_vector();
    touch.node = {0, 1, 2};
    touch.apex = 3;
    touch.weight = {0.5, 0.2, 0.3};
    touch.normal = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
    touch.arm = 0.1 * touch.normal;
    Vec3 foot = Vec3::Zero();
    for (int n = 0; n < 3; ++n) foot += touch.weight[n] * x.col(n);
    x.col(3) = foot + touch.arm;
    const double share = apex == Side::solid ? 0.0 : base == Side::solid ? 1.0 : 0.4;
    touch.apex_arm = share * touch.arm;
    touch.base_arm = touch.arm - touch.apex_arm;
    touch.base_rotates = base == Side::plate;
    const std::array<Vec3, 3> place{x.col(0), x.col(1), x.col(2)};
    const std::array<double, 3> of_moment{1, 0.7, 0.4};
    measure_base(place, of_moment, touch);
  }
};

const std::pair<Side, Side> sides[] = {
    {Side::solid, Side::solid}, {Side::plate, Side::solid}, {Side::solid, Side::plate}, {Side::plate, Side::plate}};

TEST(StickOrSlide, HoldsUpToTheLimitAndSlidesTheRest) {
  const Vec3 trial(3e-3, 4e-3, 0);
  const Slip held = stick_or_slide(trial, 100, 0.5);
  EXPECT_EQ(held.elastic, trial);
  EXPECT_EQ(held.slid, Vec3::Zero());
  const Slip slid = stick_or_slide(trial, 100, 0.25);
  EXPECT_NEAR(100 * slid.elastic.norm(), 0.25, 1e-15);
  EXPECT_LT((slid.elastic + slid.slid - trial).norm(), 1e-18);
  EXPECT_LT(slid.elastic.cross(trial).norm(), 1e-18);
  EXPECT_EQ(stick_or_slide(trial, 100, 0).elastic, Vec3::Zero());
}

TEST(CoefficientAt, FallsFromTheStaticToTheKineticOne) {
  Coulomb friction{.coefficient = 0.5};
  EXPECT_EQ(coefficient_at(friction, 7), 0.5);
  friction.kinetic = 0.2, friction.decay = 3;
  EXPECT_EQ(coefficient_at(friction, 0), 0.5);
  EXPECT_NEAR(coefficient_at(friction, 1 / 3.0), 0.2 + 0.3 / std::exp(1.0), 1e-15);
  EXPECT_NEAR(coefficient_at(friction, 100), 0.2, 1e-15);
}

TEST(SlipRate, IsZeroInARigidMotion) {
  for (const auto& [base, apex] : sides) {
    const Pair pair(base, apex);
    const Vec3 spin = random_vector(), shift = random_vector();
    Vectors v(3, 4), omega(3, 4);
    for (int n = 0; n < 4; ++n) v.col(n) = shift + spin.cross(Vec3(pair.x.col(n)));
    omega.colwise() = spin;
    EXPECT_LT(slip_rate(pair.touch, v, omega, pair.rotation_of_node).norm(), 1e-15);
    EXPECT_LT((spin_of_base(pair.touch, v) - spin).norm(), 1e-14);
  }
}

TEST(Friction, HasThePowerOfItsForceOnTheSlipRateForEveryMotion) {
  for (const auto& [base, apex] : sides) {
    const Pair pair(base, apex);
    Vec3 friction = random_vector();
    friction -= pair.touch.normal.dot(friction) * pair.touch.normal;
    Vectors force = Vectors::Zero(3, 4), moment = force;
    add_friction(pair.touch, friction, pair.rotation_of_node, force, moment);
    for (int trial = 0; trial < 10; ++trial) {
      Vectors v(3, 4), omega(3, 4);
      for (int n = 0; n < 4; ++n) v.col(n) = random_vector(), omega.col(n) = random_vector();
      const double power = force.cwiseProduct(v).sum() + moment.cwiseProduct(omega).sum();
      EXPECT_NEAR(power, friction.dot(slip_rate(pair.touch, v, omega, pair.rotation_of_node)), 1e-14);
    }
  }
}

TEST(Friction, LeavesNoForceAndNoMoment) {
  for (const auto& [base, apex] : sides) {
    const Pair pair(base, apex);
    const Vec3 friction = pair.touch.normal.cross(random_vector());
    Vectors force = Vectors::Zero(3, 4), moments = force;
    add_friction(pair.touch, friction, pair.rotation_of_node, force, moments);
    Vec3 moment = moments.rowwise().sum();
    for (int n = 0; n < 4; ++n) moment += Vec3(pair.x.col(n)).cross(Vec3(force.col(n)));
    EXPECT_LT(force.rowwise().sum().norm(), 1e-15);
    EXPECT_LT(moment.norm(), 1e-15);
    EXPECT_LT((moment_of_friction(pair.touch, friction, pair.x, Vectors::Zero(3, 4), 0) - moment).norm(), 1e-15);
    EXPECT_EQ(!moments.isZero(0), base == Side::plate || apex == Side::plate);
  }
}

TEST(Friction, WithoutArmsLosesTheMomentOfTheApexOverTheFoot) {
  Pair pair(Side::solid, Side::solid);
  pair.touch.weight = {1.0 / 3, 1.0 / 3, 1.0 / 3};  // the paper's Eq. 10
  pair.touch.base_arm.setZero();
  const Vec3 friction = pair.touch.normal.cross(random_vector());
  const Vec3 centroid = pair.x.leftCols(3).rowwise().mean();
  const Vec3 lost = (Vec3(pair.x.col(3)) - centroid).cross(friction);
  EXPECT_GT(lost.norm(), 0.01);
  EXPECT_LT((moment_of_friction(pair.touch, friction, pair.x, Vectors::Zero(3, 4), 0) - lost).norm(), 1e-15);
}

TEST(Carried, VectorsKeepTheirLengthAndTurnWithTheBase) {
  const Vec3 normal = Vec3::UnitZ(), vector(0.3, 0.4, 0);
  // Cayley's rotation by w is one of 2 atan(|w|/2)
  const double angle = 0.2;
  const Vec3 turned = carried(vector, 2 * std::tan(angle / 2) * normal, normal);
  EXPECT_LT((turned - Eigen::AngleAxisd(angle, normal) * vector).norm(), 1e-15);
  const Vec3 tilted = Eigen::AngleAxisd(0.5, Vec3(1, 2, 0).normalized()) * normal;
  const Vec3 laid = carried(vector, Vec3::Zero(), tilted);
  EXPECT_NEAR(laid.norm(), vector.norm(), 1e-15);
  EXPECT_NEAR(laid.dot(tilted), 0, 1e-15);
  EXPECT_EQ(carried(Vec3::Zero(), normal, normal), Vec3::Zero());
}

}  // namespace
}  // namespace nereid::contact::friction_test
