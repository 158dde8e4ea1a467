#include "material/mixed_control.hpp"

#include <gtest/gtest.h>

#include "material/elastic.hpp"
#include "material/j2_bilinear.hpp"
#include "material/j2_mixed.hpp"

namespace nereid::material::mixed_control_test {
namespace {

const Elastic elastic{7800.0, 2.0e11, 0.3};
const J2Bilinear metal{7800.0, 2.0e11, 0.3, 3.0e8, 2.0e9};

Goal<Symmetric> pulled_to(double strain) {
  Goal<Symmetric> goal;
  goal.target[0] = strain;
  goal.strain[1] = goal.strain[2] = false;
  return goal;
}

TEST(MixedControl, StrainsThatAreToldGoStraightToTheLaw) {
  Point<J2Bilinear, Symmetric> point;
  Goal<Symmetric> goal;
  goal.target = {1e-3, -2e-3, 0.5e-3, 4e-3, -1e-3, 2e-3};
  const Sought sought = advance(metal, goal, point);
  Symmetric<double> stress{};
  Internal<double, J2Bilinear, Symmetric> internal{};
  const Increment<double, Symmetric> told{tensor_of<Symmetric>(goal.target), 1.0, 1.0};
  const Work<double> work = update_stress(metal, told, stress, internal).work;
  EXPECT_TRUE(sought.found);
  EXPECT_EQ(sought.rounds, 0);
  EXPECT_EQ((components<double, Symmetric>(point.stress)), (components<double, Symmetric>(stress)));
  EXPECT_EQ(point.internal.scalar[0], internal.scalar[0]);
  EXPECT_EQ(point.stored, work.stored);
  EXPECT_EQ(point.dissipated, work.dissipated);
}

TEST(MixedControl, ElasticUniaxialStressIsFoundInOneRound) {
  Point<Elastic, Symmetric> point;
  const Sought sought = advance(elastic, pulled_to(1e-3), point);
  EXPECT_TRUE(sought.found);
  EXPECT_LE(sought.rounds, 2);
  EXPECT_NEAR(point.stress.xx, 2.0e8, 1e-4);
  EXPECT_NEAR(point.strain.yy, -0.3e-3, 1e-16);
  EXPECT_NEAR(point.stress.yy, 0, 1e-5);
}

TEST(MixedControl, UniaxialStressBeyondYieldLiesOnTheCurveForAnyIncrement) {
  const double first = metal.flow.yield / metal.young;
  for (const int increments : {1, 2, 7, 100}) {
    Point<J2Bilinear, Symmetric> point;
    for (int i = 1; i <= increments; ++i) ASSERT_TRUE(advance(metal, pulled_to(20 * first * i / increments), point).found);
    EXPECT_NEAR(point.stress.xx / metal.flow.yield, 1 + metal.flow.tangent * 19 * first / metal.flow.yield, 1e-12) << increments;
    EXPECT_NEAR(point.stress.zz / metal.flow.yield, 0, 1e-12);
    if (increments != 100) continue;  // an increment that passes the kink cuts its corner
    const double area = 0.5 * metal.flow.yield * first + 0.5 * (metal.flow.yield + point.stress.xx) * 19 * first;
    EXPECT_NEAR((point.stored + point.dissipated) / area, 1, 1e-12);
  }
}

TEST(MixedControl, StressThatIsToldIsReachedByTheStrainOfTheCurve) {
  Goal<Symmetric> goal;
  goal.strain = {false, false, false, false, false, false};
  goal.target[0] = 1.1 * metal.flow.yield;
  Point<J2Bilinear, Symmetric> point;
  ASSERT_TRUE(advance(metal, goal, point).found);
  EXPECT_NEAR(point.strain.xx, metal.flow.yield / metal.young + 0.1 * metal.flow.yield / metal.flow.tangent, 1e-14);
  EXPECT_NEAR(point.stress.xx / metal.flow.yield, 1.1, 1e-12);
}

TEST(MixedControl, StressBeyondPerfectPlasticityIsNotFoundAndLeavesThePoint) {
  J2Bilinear perfect = metal;
  perfect.flow.tangent = 0;
  Goal<Symmetric> goal;
  goal.strain = {false, false, false, false, false, false};
  goal.target[0] = 1.1 * metal.flow.yield;
  Point<J2Bilinear, Symmetric> point;
  EXPECT_FALSE(advance(perfect, goal, point).found);
  EXPECT_EQ(point.strain.xx, 0);
  EXPECT_EQ(point.stress.xx, 0);
}

TEST(MixedControl, APlateFreeAtItsSidesIsAPointInSpaceFreeAtItsSides) {
  const J2Mixed law{7800.0, 2.0e11, 0.3, 3.0e8, 2.0e10, 0.3};
  Point<J2Mixed, Plane> plate;
  Point<J2Mixed, Symmetric> space;
  for (const double strain : {0.004, -0.003, 0.005}) {
    Goal<Plane> goal;
    goal.target[0] = strain;
    goal.strain[1] = false;
    goal.target[2] = -0.5 * strain;
    Goal<Symmetric> same = pulled_to(strain);
    same.target[3] = goal.target[2];
    ASSERT_TRUE(advance(law, goal, plate).found);
    ASSERT_TRUE(advance(law, same, space).found);
    EXPECT_NEAR(plate.stress.xx, space.stress.xx, 1e-12 * law.yield);
    EXPECT_NEAR(plate.stress.xy, space.stress.xy, 1e-12 * law.yield);
    EXPECT_NEAR(plate.strain.yy, space.strain.yy, 1e-14);
    EXPECT_NEAR(plate.internal.scalar[0], space.internal.scalar[0], 1e-14);
  }
}

TEST(MixedControl, SmallSystemsAreSolved) {
  std::array<double, 36> A{};
  A[0] = 2, A[1] = 1, A[6] = 1, A[7] = 3;
  const auto x = solved(A, {3, 5}, 2);
  EXPECT_NEAR(x[0], 0.8, 1e-15);
  EXPECT_NEAR(x[1], 1.4, 1e-15);
}

}  // namespace
}  // namespace nereid::material::mixed_control_test
