// Bits are compared below: without this the compiler is free to fuse one product here and another there.
#pragma GCC optimize("fp-contract=off")

#include "material/j2_bilinear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/dual.hpp"
#include "material/elastic.hpp"
#include "tests/base/chance.hpp"
#include "tests/material/point.hpp"

namespace nereid::material::j2_bilinear_test {
namespace {

constexpr double kgf_per_mm2 = 9.80665e6;  // [Pa]
J2Bilinear table_ii(double density, double young, double poisson, double yield, double tangent) {
  return {density, young * kgf_per_mm2, poisson, yield * kgf_per_mm2, tangent * kgf_per_mm2};
}
const J2Bilinear lead = table_ii(11340.0, 19.5, 0.42, 3.02, 1.85);
const J2Bilinear steel = table_ii(7800.0, 1.96e4, 0.33, 31.6, 195.0);
const J2Bilinear perfect = table_ii(7800.0, 1.96e4, 0.33, 31.6, 0.0);

Chance64 random_source(7);
double draw(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_source);
}
/// A strain of random direction, its largest component near `size`.
void draw(double size, Symmetric<double>& e) {
  e = {draw(-size, size), draw(-size, size), draw(-size, size),
       draw(-size, size), draw(-size, size), draw(-size, size)};
}
void draw(double size, Plane<double>& e) {
  e = {draw(-size, size), draw(-size, size), draw(-size, size)};
}

/// In space and in the plane alike.
template <class Tensor>
class J2BilinearIn : public ::testing::Test {};
using Tensors = ::testing::Types<Symmetric<double>, Plane<double>>;
TYPED_TEST_SUITE(J2BilinearIn, Tensors);

TEST(J2Bilinear, HardeningModulusFollowsFromTheSlopeOfTheUniaxialCurve) {
  EXPECT_NEAR(hardening_modulus(lead) / kgf_per_mm2, 2.04391, 5e-6);
  // Rounded twice it is often given as 196.9596.
  EXPECT_NEAR(hardening_modulus(steel) / kgf_per_mm2, 196.95955, 5e-6);
  EXPECT_EQ(hardening_modulus(perfect), 0.0);
}

TEST(J2Bilinear, YieldStressGrowsWithPlasticStrain) {
  EXPECT_DOUBLE_EQ(yield_stress(steel, 0.0), steel.flow.yield);
  EXPECT_DOUBLE_EQ(yield_stress(steel, 0.5), steel.flow.yield + 0.5 * hardening_modulus(steel));
}

TYPED_TEST(J2BilinearIn, StressStaysOnTheYieldSurfaceForIncrementsOfAnySize) {
  double worst = 0.0;
  for (const J2Bilinear& law : {lead, steel, perfect})
    for (int history = 0; history < 300; ++history) {
      TypeParam stress{}, strain{};
      auto internal = fresh<J2Bilinear>(stress);
      for (int step = 0; step < 30; ++step) {
        draw(std::pow(10.0, draw(-8.0, 1.0)) * law.flow.yield / law.young, strain);
        const double before = internal.scalar[0];
        strain_by(law, strain, stress, internal);
        const double now = yield_stress(law, internal.scalar[0]), error = von_mises(stress) / now - 1.0;
        ASSERT_GE(internal.scalar[0], before);
        if (internal.scalar[0] > before)
          worst = std::max(worst, std::abs(error));
        else
          worst = std::max(worst, error);
      }
    }
  EXPECT_LT(worst, 1e-12);
}

TYPED_TEST(J2BilinearIn, AStepBeyondYieldOfAnySizeSatisfiesTheYieldFunction) {
  // From the yield surface on: the increments that only just yield are the delicate ones.
  double worst = 0.0;
  for (const J2Bilinear& law : {lead, steel, perfect})
    for (double size = 1e-8; size < 11.0; size *= 10.0)
      for (int sample = 0; sample < 100; ++sample) {
        TypeParam stress{}, strain{};
        auto internal = fresh<J2Bilinear>(stress);
        draw(1.0, strain);
        strain_by(law, (100.0 * law.flow.yield / law.young) * strain, stress, internal);
        const double before = internal.scalar[0];
        strain_by(law, (size * law.flow.yield / law.young) * strain, stress, internal);
        ASSERT_GT(internal.scalar[0], before);
        worst = std::max(worst, std::abs(von_mises(stress) / yield_stress(law, internal.scalar[0]) - 1.0));
      }
  EXPECT_LT(worst, 1e-13);
}

TYPED_TEST(J2BilinearIn, AStepWithoutFlowIsThatOfElasticToTheLastBit) {
  const Elastic elastic{steel.density, steel.young, steel.poisson};
  auto nothing = fresh<Elastic>(TypeParam{});
  for (int sample = 0; sample < 1000; ++sample) {
    TypeParam strain{}, stress{}, reference{};
    auto internal = fresh<J2Bilinear>(stress);
    internal.scalar[0] = draw(0.0, 1.0);
    const double before = internal.scalar[0];
    for (int step = 0; step < 3; ++step) {
      draw(0.05 * steel.flow.yield / steel.young, strain);
      const Work<double> work = strain_by(steel, strain, stress, internal);
      const Work<double> expected = strain_by(elastic, strain, reference, nothing);
      ASSERT_EQ(internal.scalar[0], before);
      ASSERT_EQ(work.dissipated, 0.0);
      ASSERT_EQ(work.stored, expected.stored);
      ASSERT_EQ(stress.xx, reference.xx);
      ASSERT_EQ(stress.yy, reference.yy);
      ASSERT_EQ(stress.xy, reference.xy);
    }
  }
}

TYPED_TEST(J2BilinearIn, NoStrainAtNoStressGivesNoStressAndNoNaN) {
  TypeParam stress{};
  auto internal = fresh<J2Bilinear>(stress);
  const Work<double> work = strain_by(perfect, TypeParam{}, stress, internal);
  EXPECT_EQ(von_mises(stress), 0.0);
  EXPECT_EQ(internal.scalar[0], 0.0);
  EXPECT_EQ(work.stored, 0.0);
  EXPECT_EQ(work.dissipated, 0.0);
}

TEST(J2Bilinear, DerivativeAtNoStressIsHookes) {
  const auto e = Dual<1>::variable(0.0, 0);
  Symmetric<Dual<1>> space{};
  auto internal = fresh<J2Bilinear>(space);
  strain_by(steel, Symmetric<Dual<1>>{e, 0, 0, 0, 0, 0}, space, internal);
  const auto [lambda, mu] = lame(steel);
  EXPECT_DOUBLE_EQ(space.xx.by[0], lambda + 2.0 * mu);
  EXPECT_DOUBLE_EQ(space.zz.by[0], lambda);
  Plane<Dual<1>> plane{};
  auto internal_in_plane = fresh<J2Bilinear>(plane);
  strain_by(steel, Plane<Dual<1>>{e, 0, 0}, plane, internal_in_plane);
  EXPECT_DOUBLE_EQ(plane.xx.by[0], steel.young / (1.0 - steel.poisson * steel.poisson));
}

TYPED_TEST(J2BilinearIn, NaNStrainReturnsNaNStressInsteadOfHanging) {
  TypeParam stress{}, strain{};
  auto internal = fresh<J2Bilinear>(stress);
  strain.xx = std::numeric_limits<double>::quiet_NaN();
  strain_by(steel, strain, stress, internal);
  EXPECT_TRUE(std::isnan(stress.xx));
}

TEST(J2Bilinear, LanesAtRestAndLanesThatFlowDoNotDisturbEachOther) {
  // Each lane has its own size, from nothing to ten yield strains.
  const double unit = steel.flow.yield / steel.young;
  for (int turn = 0; turn < lanes; ++turn) {
    Plane<Pack> strain{}, stress{};
    auto internal = fresh<J2Bilinear>(stress);
    for (int lane = 0; lane < lanes; ++lane) {
      const double size = lane == turn ? 0.0 : std::pow(10.0, -1.0 + 2.0 * lane / (lanes - 1));
      strain.xx[lane] = size * unit;
      strain.yy[lane] = -0.4 * size * unit;
      strain.xy[lane] = 0.3 * size * unit;
    }
    strain_by(steel, strain, stress, internal);
    EXPECT_EQ(stress.xx[turn], 0.0);
    EXPECT_EQ(internal.scalar[0][turn], 0.0);
    for (int lane = 0; lane < lanes; ++lane) EXPECT_TRUE(std::isfinite(stress.xy[lane]));
  }
}

TYPED_TEST(J2BilinearIn, RadialPathsDoNotDependOnTheSizeOfTheStep) {
  // Strains whose stress keeps its direction in elasticity and in flow: shear, and with it pressure
  // in space. Both ways of the path, 20 steps against 1 and 1000.
  const auto run = [](const J2Bilinear& law, int steps) {
    TypeParam stress{}, strain{};
    auto internal = fresh<J2Bilinear>(stress);
    double dissipated = 0.0;
    const double unit = law.flow.yield / law.young;
    for (const double amplitude : {5.0 * unit, -8.0 * unit}) {
      strain.xx = 0.7 * amplitude / steps;
      strain.yy = -0.7 * amplitude / steps;
      strain.xy = amplitude / steps;
      for (int step = 0; step < steps; ++step)
        dissipated += strain_by(law, strain, stress, internal).dissipated;
    }
    return std::array<double, 4>{stress.xx / law.flow.yield, stress.xy / law.flow.yield, internal.scalar[0] / unit,
                                 dissipated};
  };
  for (const J2Bilinear& law : {lead, steel, perfect}) {
    const auto reference = run(law, 20);
    for (const int steps : {1, 1000})
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(run(law, steps)[i], reference[i], 1e-11) << i;
  }
}

TEST(J2Bilinear, UniaxialStrainKeepsVolumeElasticInASingleStepOrMany) {
  for (const int steps : {1, 7, 500}) {
    Symmetric<double> stress{};
    auto internal = fresh<J2Bilinear>(stress);
    const double total = -6.0 * steel.flow.yield / steel.young;
    for (int step = 0; step < steps; ++step)
      strain_by(steel, Symmetric<double>{total / steps, 0, 0, 0, 0, 0}, stress, internal);
    EXPECT_NEAR(pressure(stress) / (-bulk_modulus(steel) * total), 1.0, 1e-13);
    EXPECT_NEAR((stress.zz - stress.xx) / yield_stress(steel, internal.scalar[0]), 1.0, 1e-13);
  }
}

TEST(J2Bilinear, DissipationOfMonotonicShearIsTheAreaUnderTheYieldCurve) {
  // Steps within flow only: dissipated = integral of Y d(plastic strain), whatever the step.
  Symmetric<double> stress{};
  auto internal = fresh<J2Bilinear>(stress);
  const double at_yield = lead.flow.yield / std::sqrt(3.0) / (2.0 * shear_modulus(lead));
  double dissipated = 0.0;
  for (int step = 0; step < 5; ++step)
    dissipated += strain_by(lead, Symmetric<double>{0, 0, 0, at_yield, 0, 0}, stress, internal)
                      .dissipated;
  const double p = internal.scalar[0];
  const double expected = lead.flow.yield * p + 0.5 * hardening_modulus(lead) * p * p;
  EXPECT_NEAR(dissipated / expected, 1.0, 1e-12);
}

}  // namespace
}  // namespace nereid::material::j2_bilinear_test
