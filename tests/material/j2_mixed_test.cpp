// Bits are compared below: without this the compiler is free to fuse one product here and another there.
#pragma GCC optimize("fp-contract=off")

#include "material/j2_mixed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "material/elastic.hpp"
#include "tests/base/chance.hpp"
#include "tests/material/point.hpp"

namespace nereid::material::j2_mixed_test {
namespace {

constexpr double kgf_per_mm2 = 9.80665e6;  // [Pa]
J2Mixed lead(double isotropic) {
  return {11340.0, 19.5 * kgf_per_mm2, 0.42, 3.02 * kgf_per_mm2, 1.85 * kgf_per_mm2, isotropic};
}
J2Mixed steel(double isotropic) {
  return {7800.0, 1.96e4 * kgf_per_mm2, 0.33, 31.6 * kgf_per_mm2, 195.0 * kgf_per_mm2, isotropic};
}
const J2Mixed perfect{7800.0, 1.96e4 * kgf_per_mm2, 0.33, 31.6 * kgf_per_mm2, 0.0, 0.5};
const std::vector<J2Mixed> laws{lead(0), lead(0.4), lead(1), steel(0), steel(0.4), steel(1), perfect};

double unit(const J2Mixed& law) { return law.yield / law.young; }

Chance64 random_source(13);
double draw(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_source);
}
template <class S>
S draw_strain(double size) {
  S strain{};
  for (double* c : components(strain)) *c = draw(-size, size);
  return strain;
}

template <class S>
double distance_to_centre(const S& stress, const S& back_stress) {
  return von_mises(stress - surface_centre(back_stress));
}

/// In space and in the plane alike.
template <class Tensor>
class J2MixedIn : public ::testing::Test {};
using Tensors = ::testing::Types<Symmetric<double>, Plane<double>>;
TYPED_TEST_SUITE(J2MixedIn, Tensors);

TEST(J2Mixed, SharesTheHardeningModulusOut) {
  const auto [isotropic, kinematic] = hardening_moduli(lead(0.25));
  EXPECT_NEAR(isotropic / kgf_per_mm2, 0.25 * 2.04391, 2e-6);
  EXPECT_NEAR(kinematic / kgf_per_mm2, 0.75 * 2.04391, 5e-6);
  EXPECT_DOUBLE_EQ(yield_stress(lead(0.25), 0.5), lead(0).yield + 0.5 * isotropic);
}

TEST(J2Mixed, CentreInAPlateHasTheBackStressForItsDeviator) {
  const Plane<double> back{3.0, -1.0, 0.5};
  EXPECT_LT(largest(deviator(surface_centre(back)) - back), 1e-15);
}

TYPED_TEST(J2MixedIn, WithAllOfItIsotropicItIsJ2Bilinear) {
  double worst = 0.0;
  for (const J2Mixed& law : {lead(1), steel(1), perfect}) {
    const J2Bilinear bilinear{law.density, law.young, law.poisson, law.yield, law.tangent};
    for (int history = 0; history < 100; ++history) {
      TypeParam stress{}, expected{};
      auto internal = fresh<J2Mixed>(stress);
      auto plain = fresh<J2Bilinear>(stress);
      for (int step = 0; step < 30; ++step) {
        const auto strain = draw_strain<TypeParam>(std::pow(10.0, draw(-8.0, 1.0)) * unit(law));
        const Work<double> a = strain_by(law, strain, stress, internal);
        const Work<double> b = strain_by(bilinear, strain, expected, plain);
        const double trial = law.yield + law.young * largest(strain);
        worst = std::max(worst, largest(stress - expected) / trial);
        worst = std::max(worst, std::abs(internal.scalar[0] - plain.scalar[0]) / (plain.scalar[0] + unit(law)));
        worst = std::max(worst, std::abs(a.stored - b.stored) / (trial * (largest(strain) + unit(law))));
        worst = std::max(worst, std::abs(a.dissipated - b.dissipated) / (trial * (largest(strain) + unit(law))));
        ASSERT_EQ(largest(internal.tensor[0]), 0.0);
      }
    }
  }
  ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  EXPECT_LT(worst, 1e-13);  // round-off of 30 steps, relative to the trial stress
}

TYPED_TEST(J2MixedIn, StressStaysWithinTheMovedYieldSurfaceForIncrementsOfAnySize) {
  double worst = 0.0, trace_of_back = 0.0;
  for (const J2Mixed& law : laws)
    for (int history = 0; history < 200; ++history) {
      TypeParam stress{};
      auto internal = fresh<J2Mixed>(stress);
      for (int step = 0; step < 30; ++step) {
        const auto strain = draw_strain<TypeParam>(std::pow(10.0, draw(-8.0, 1.0)) * unit(law));
        const double before = internal.scalar[0];
        strain_by(law, strain, stress, internal);
        const double radius = yield_stress(law, internal.scalar[0]);
        const double error = distance_to_centre(stress, internal.tensor[0]) / radius - 1.0;
        ASSERT_GE(internal.scalar[0], before);
        worst = std::max(worst, internal.scalar[0] > before ? std::abs(error) : error);
      }
      if constexpr (std::is_same_v<TypeParam, Symmetric<double>>)
        trace_of_back = std::max(trace_of_back, std::abs(trace(internal.tensor[0])) / law.yield);
    }
  ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  // The centre may be several radii from zero, and its round-off counts in radii.
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(trace_of_back, 1e-13);
}

TYPED_TEST(J2MixedIn, AStepWithoutFlowIsThatOfElasticToTheLastBit) {
  const J2Mixed law = steel(0.4);
  const Elastic elastic{law.density, law.young, law.poisson};
  auto nothing = fresh<Elastic>(TypeParam{});
  for (int sample = 0; sample < 1000; ++sample) {
    TypeParam stress{};
    auto internal = fresh<J2Mixed>(stress);
    internal.scalar[0] = draw(0.0, 1.0);
    for (double* c : components(internal.tensor[0])) *c = 0.1 * law.yield * draw(-1.0, 1.0);
    internal.tensor[0] = deviator(internal.tensor[0]);
    TypeParam reference = stress;
    const auto before = rows(internal);
    for (int step = 0; step < 3; ++step) {
      const auto strain = draw_strain<TypeParam>(0.05 * unit(law));
      const Work<double> work = strain_by(law, strain, stress, internal);
      const Work<double> expected = strain_by(elastic, strain, reference, nothing);
      ASSERT_EQ(rows(internal), before);
      ASSERT_EQ(work.dissipated, 0.0);
      ASSERT_EQ(work.stored, expected.stored);
      ASSERT_EQ(largest(stress - reference), 0.0);
    }
  }
}

/// Stress at the end of a half cycle of uniaxial stress, and the memory that goes with it, in closed form.
struct Cycle {
  double stress = 0, radius, centre = 0;
  explicit Cycle(const J2Mixed& law) : radius(law.yield) {}
  /// Strains by so much: up to the end of the elastic range with E, beyond it with E_t.
  void stretch(const J2Mixed& law, double strain) {
    const auto [isotropic, kinematic] = hardening_moduli(law);
    const double sign = strain < 0 ? -1 : 1, end = centre + sign * radius;
    const double beyond = strain - (end - stress) / law.young;
    if (beyond * sign <= 0) {
      stress += law.young * strain;
      return;
    }
    stress = end + law.tangent * beyond;
    const double plastic = beyond * (1.0 - law.tangent / law.young);
    radius += isotropic * std::abs(plastic);
    centre += kinematic * plastic;
  }
};

TYPED_TEST(J2MixedIn, CyclesOfUniaxialStressFollowTheirClosedForm) {
  // Catalogue M-3: +-3 yield strains; the return is exact for any number of steps.
  double worst = 0.0;
  for (const J2Mixed& law : laws)
    for (const int steps : {1, 7, 300}) {
      TypeParam stress{};
      auto internal = fresh<J2Mixed>(stress);
      Cycle exact(law);
      double at = 0.0;
      for (const double target : {3.0, -3.0, 3.0, -3.0, 3.0}) {
        const double step = (target * unit(law) - at) / steps;
        for (int i = 0; i < steps; ++i) {
          stretch(law, step, stress, internal);
          exact.stretch(law, step);
          worst = std::max(worst, std::abs(stress.xx - exact.stress) / law.yield);
          worst = std::max(worst, std::abs(1.5 * internal.tensor[0].xx - exact.centre) / law.yield);
        }
        at = target * unit(law);
      }
    }
  ::testing::Test::RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  EXPECT_LT(worst, 1e-10);
}

TYPED_TEST(J2MixedIn, ReverseYieldIsWhereTheRuleOfHardeningPutsIt) {
  // Catalogue M-3: isotropic at -s_max, kinematic at s_max - 2 yield, mixed at s_max - 2 (yield + share H p).
  for (const double share : {0.0, 0.5, 1.0})
    for (const J2Mixed& law : {lead(share), steel(share)}) {
      TypeParam stress{};
      auto internal = fresh<J2Mixed>(stress);
      stretch(law, 3.0 * unit(law), stress, internal);
      const double top = law.yield + 2.0 * law.tangent * unit(law), flowed = 2.0 * unit(law) * (1.0 - law.tangent / law.young);
      EXPECT_NEAR(stress.xx / top, 1.0, 1e-12);
      const double H = law.young * law.tangent / (law.young - law.tangent);
      const double expected = share == 0.0   ? top - 2.0 * law.yield
                              : share == 1.0 ? -top
                                             : top - 2.0 * (law.yield + share * H * flowed);
      // Just short of it nothing flows, just beyond it something does.
      const double before = internal.scalar[0];
      const double way = (expected - stress.xx) / law.young;
      stretch(law, way * (1.0 - 1e-10), stress, internal);
      EXPECT_EQ(internal.scalar[0], before);
      EXPECT_NEAR(stress.xx, expected, 1e-9 * law.yield);
      stretch(law, way * 2e-10, stress, internal);
      EXPECT_GT(internal.scalar[0], before);
    }
}

TYPED_TEST(J2MixedIn, LoopsOfKinematicHardeningCloseAndDoNotCreepAlong) {
  // Strain between 1 and 5 yield strains, beside a shear: from the second loop on every loop is the same,
  // the mean stress stays, and each dissipates the same.
  for (const J2Mixed& law : {lead(0), steel(0)}) {
    TypeParam stress{};
    auto internal = fresh<J2Mixed>(stress);
    double last_top = 0.0, last_bottom = 0.0, last_dissipated = 0.0;
    const auto move = [&](double size, Work<double>& sum) {
      for (int i = 0; i < 40; ++i) {
        TypeParam strain{};
        strain.xx = size / 40 * unit(law), strain.xy = 0.3 * strain.xx;
        const Work<double> work = strain_by(law, strain, stress, internal);
        sum.stored += work.stored, sum.dissipated += work.dissipated;
      }
    };
    Work<double> virgin{0, 0};
    move(5.0, virgin);
    for (int cycle = 0; cycle < 60; ++cycle) {
      Work<double> loop{0, 0};
      move(-4.0, loop);
      const double bottom = stress.xx;
      move(4.0, loop);
      if (cycle > 50) {  // the direction of the flow settles geometrically, to round-off
        EXPECT_NEAR(stress.xx, last_top, 1e-12 * law.yield);
        EXPECT_NEAR(bottom, last_bottom, 1e-12 * law.yield);
        EXPECT_NEAR(loop.dissipated, last_dissipated, 1e-12 * last_dissipated);
        EXPECT_NEAR(loop.stored, 0.0, 1e-12 * loop.dissipated);
      }
      last_top = stress.xx, last_bottom = bottom;
      last_dissipated = loop.dissipated;
    }
    EXPECT_GT(last_dissipated, 0.0);
  }
}

TYPED_TEST(J2MixedIn, UniaxialLoopsOfKinematicHardeningCloseAtOnce) {
  double worst = 0.0;
  for (const J2Mixed& law : {lead(0), steel(0)}) {
    TypeParam stress{};
    auto internal = fresh<J2Mixed>(stress);
    stretch(law, 5.0 * unit(law), stress, internal);
    const double top = stress.xx;
    for (int cycle = 0; cycle < 20; ++cycle) {
      for (int i = 0; i < 10; ++i) stretch(law, -0.4 * unit(law), stress, internal);
      for (int i = 0; i < 10; ++i) stretch(law, 0.4 * unit(law), stress, internal);
      worst = std::max(worst, std::abs(stress.xx / top - 1.0));
    }
  }
  EXPECT_LT(worst, 1e-12);
}

TYPED_TEST(J2MixedIn, OfTheWorkOfMonotonicShearWhatMovesTheSurfaceIsStored) {
  // Steps within flow only: dissipated = yield p + 1/2 H_isotropic p^2, stored = elastic + 1/2 H_kinematic p^2.
  for (const J2Mixed& law : laws) {
    const auto [isotropic, kinematic] = hardening_moduli(law);
    TypeParam stress{}, strain{};
    auto internal = fresh<J2Mixed>(stress);
    strain.xy = law.yield / std::sqrt(3.0) / (2.0 * shear_modulus(law));
    double stored = 0.0, dissipated = 0.0;
    for (int step = 0; step < 5; ++step) {
      const Work<double> work = strain_by(law, strain, stress, internal);
      stored += work.stored, dissipated += work.dissipated;
    }
    const double p = internal.scalar[0], elastic = stress.xy * stress.xy / (2.0 * shear_modulus(law));
    EXPECT_NEAR(dissipated / (law.yield * p + 0.5 * isotropic * p * p), 1.0, 1e-12);
    EXPECT_NEAR(stored / (elastic + 0.5 * kinematic * p * p), 1.0, 1e-12);
  }
}

TYPED_TEST(J2MixedIn, RadialPathsDoNotDependOnTheSizeOfTheStep) {
  const auto run = [](const J2Mixed& law, int steps) {
    TypeParam stress{};
    auto internal = fresh<J2Mixed>(stress);
    for (const double amplitude : {5.0 * unit(law), -8.0 * unit(law)}) {
      TypeParam strain{};
      strain.xx = 0.7 * amplitude / steps;
      strain.yy = -0.7 * amplitude / steps;
      strain.xy = amplitude / steps;
      for (int step = 0; step < steps; ++step) strain_by(law, strain, stress, internal);
    }
    return std::array<double, 4>{stress.xx / law.yield, stress.xy / law.yield, internal.tensor[0].xy / law.yield,
                                 internal.scalar[0] / unit(law)};
  };
  for (const J2Mixed& law : laws) {
    const auto reference = run(law, 20);
    for (const int steps : {1, 1000})
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(run(law, steps)[i], reference[i], 1e-11) << i;
  }
}

TYPED_TEST(J2MixedIn, NoStrainAtNoStressGivesNoStressAndNoNaN) {
  TypeParam stress{};
  auto internal = fresh<J2Mixed>(stress);
  const Work<double> work = strain_by(perfect, TypeParam{}, stress, internal);
  EXPECT_EQ(largest(stress), 0.0);
  EXPECT_EQ(rows(internal), rows(fresh<J2Mixed>(stress)));
  EXPECT_EQ(work.stored, 0.0);
  EXPECT_EQ(work.dissipated, 0.0);
}

TYPED_TEST(J2MixedIn, NaNStrainReturnsNaNStressInsteadOfHanging) {
  TypeParam stress{}, strain{};
  auto internal = fresh<J2Mixed>(stress);
  strain.xx = std::numeric_limits<double>::quiet_NaN();
  strain_by(steel(0.4), strain, stress, internal);
  EXPECT_TRUE(std::isnan(stress.xx));
}

TEST(J2Mixed, BitsOfALaneDoNotDependOnItsNeighbours) {
  // The same point in every lane, and then in one lane beside others of all sizes.
  const J2Mixed law = steel(0.4);
  const auto run = [&law](const std::vector<std::array<double, lanes>>& sizes) {
    Plane<Pack> stress{Pack(0.0), Pack(0.0), Pack(0.0)};
    Internal<Pack, J2Mixed, Plane> internal{};
    internal.each_row([](Pack& row) { row = Pack(0.0); });
    for (std::size_t step = 0; step < sizes.size(); ++step) {
      Plane<Pack> strain = stress;
      for (int lane = 0; lane < lanes; ++lane) {
        const double size = sizes[step][lane] * unit(law) * (step % 3 == 2 ? -1.0 : 1.0);
        strain.xx[lane] = size, strain.yy[lane] = (step % 2 == 0 ? -0.4 : 0.8) * size, strain.xy[lane] = 0.3 * size;
      }
      strain_by(law, strain, stress, internal);
    }
    std::vector<Pack> all{stress.xx, stress.yy, stress.xy};
    internal.each_row([&all](Pack& row) { all.push_back(row); });
    return all;
  };
  for (int lane = 0; lane < lanes; ++lane) {
    std::vector<std::array<double, lanes>> alone, among;
    for (int step = 0; step < 30; ++step) {
      const double size = std::pow(10.0, draw(-3.0, 1.0));
      alone.emplace_back().fill(size);
      auto& sizes = among.emplace_back();
      for (double& other : sizes) other = std::pow(10.0, draw(-8.0, 2.0));
      sizes[lane] = size;
    }
    const auto a = run(alone), b = run(among);
    for (std::size_t row = 0; row < a.size(); ++row) EXPECT_EQ(a[row][lane], b[row][lane]) << row;
  }
}

}  // namespace
}  // namespace nereid::material::j2_mixed_test
