// What is special about the flow stress of Johnson and Cook: rate, heat, and an implicit return that always ends.

#include "material/johnson_cook.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/base/chance.hpp"
#include "tests/material/point.hpp"

namespace nereid::material::johnson_cook_test {
namespace {

/// Steel 4340 of the paper, Table 1.
const J2JohnsonCook steel{7830.0, 2.0e11, 0.29,
                          {.yield = 792e6, .hardening = 510e6, .hardening_exponent = 0.26, .rate_coefficient = 0.014,
                           .reference_rate = 1, .thermal_exponent = 1.03, .reference_temperature = 293, .melting_temperature = 1793,
                           .specific_heat = 477, .heat_share = 0.9, .temperature = 293}};

Chance64 chance(5);
double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(chance); }
Symmetric<double> draw_strain(double size) {
  Symmetric<double> strain{};
  for (double* c : components(strain)) *c = draw(-size, size);
  return strain;
}

/// The formula of the paper.
double of_the_paper(const JohnsonCook& f, double p, double rate, double temperature) {
  const double hot = (temperature - f.reference_temperature) / (f.melting_temperature - f.reference_temperature);
  return (f.yield + f.hardening * std::pow(p, f.hardening_exponent)) *
         (1 + f.rate_coefficient * std::log(std::max(rate / f.reference_rate, 1.0))) *
         (1 - std::pow(std::clamp(hot, 0.0, 1.0), f.thermal_exponent));
}

TEST(JohnsonCook, StressAfterFlowIsTheFlowStressOfItsStrainRateAndHeatForIncrementsOfAnySize) {
  int flowed = 0;
  for (int history = 0; history < 500; ++history) {
    Symmetric<double> stress{};
    auto internal = fresh<double, Symmetric>(steel);
    for (int i = 0; i < 20; ++i) {
      const double before = internal.scalar[0], dt = std::pow(10.0, draw(-9, 4));
      strain_by(steel, draw_strain(std::pow(10.0, draw(-6, -0.5))), stress, internal, dt);
      const double flow = internal.scalar[0] - before;
      const double expected = of_the_paper(steel.flow, internal.scalar[0], flow / dt, internal.scalar[1]);
      if (internal.scalar[1] > 0.99 * steel.flow.melting_temperature) break;  // melted: see below
      if (flow > 0) {
        ++flowed;
        ASSERT_NEAR(von_mises(stress) / expected, 1.0, 1e-9);
      } else {
        ASSERT_LE(von_mises(stress), expected * (1 + 1e-12));
      }
    }
  }
  EXPECT_GT(flowed, 3000);
}

TEST(JohnsonCook, InAPlateStressAfterFlowIsTheFlowStressForIncrementsOfAnySize) {
  int flowed = 0;
  for (int history = 0; history < 500; ++history) {
    Plane<double> stress{};
    auto internal = fresh<double, Plane>(steel);
    for (int i = 0; i < 20; ++i) {
      const double before = internal.scalar[0], dt = std::pow(10.0, draw(-9, 4));
      Plane<double> strain{};
      const double size = std::pow(10.0, draw(-6, -0.5));
      for (double* c : components(strain)) *c = draw(-size, size);
      const Work<double> work = strain_by(steel, strain, stress, internal, dt);
      ASSERT_GE(work.dissipated, 0.0);
      const double flow = internal.scalar[0] - before;
      if (internal.scalar[1] > 0.99 * steel.flow.melting_temperature) break;  // melted
      const double expected = of_the_paper(steel.flow, internal.scalar[0], flow / dt, internal.scalar[1]);
      if (flow > 0) {
        ++flowed;
        ASSERT_NEAR(von_mises(stress) / expected, 1.0, 1e-9 + 1e-15 * internal.scalar[0] / flow);
      } else {
        ASSERT_LE(von_mises(stress), expected * (1 + 1e-12));
      }
    }
  }
  EXPECT_GT(flowed, 3000);
}

TEST(JohnsonCook, HeatIsTheShareOfWhatIsDissipatedPerMass) {
  Symmetric<double> stress{};
  auto internal = fresh<double, Symmetric>(steel);
  double dissipated = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double volume = draw(0.9, 1.1);
    const Increment<double, Symmetric> increment{draw_strain(3e-3), 1e-6, volume};
    dissipated += volume * update_stress(steel, increment, stress, internal).work.dissipated;
  }
  const double rise = internal.scalar[1] - steel.flow.temperature;
  EXPECT_GT(rise, 20);
  EXPECT_NEAR(rise * steel.density * steel.flow.specific_heat / (0.9 * dissipated), 1.0, 1e-12);
}

TEST(JohnsonCook, RatesBelowTheReferenceHaveNoEffectAndHigherOnesThatOfTheLogarithm) {
  const auto flows_at = [](double rate) {
    J2JohnsonCook cold = steel;
    cold.flow.heat_share = 0, cold.flow.hardening = 0;
    Symmetric<double> stress{};
    auto internal = fresh<double, Symmetric>(cold);
    const double strain = 1e-4;  // a deviator, of equivalent plastic strain `strain` where all of it is plastic
    for (int i = 0; i < 400; ++i)
      strain_by(cold, Symmetric<double>{strain, -0.5 * strain, -0.5 * strain, 0, 0, 0}, stress, internal, strain / rate);
    return von_mises(stress) / cold.flow.yield;
  };
  EXPECT_NEAR(flows_at(1e-6), 1.0, 1e-12);
  EXPECT_NEAR(flows_at(1e-1), 1.0, 1e-12);
  EXPECT_NEAR(flows_at(1e3), 1 + 0.014 * std::log(1e3), 1e-9);
  EXPECT_NEAR(flows_at(1e6), 1 + 0.014 * std::log(1e6), 1e-9);
}

TEST(JohnsonCook, MoltenMetalHasNoStrengthAndStillBearsPressure) {
  J2JohnsonCook molten = steel;
  molten.flow.temperature = 2000;
  Symmetric<double> stress{};
  auto internal = fresh<double, Symmetric>(molten);
  for (int i = 0; i < 10; ++i) {
    const Work<double> work = strain_by(molten, Symmetric<double>{-1e-2, 0, 0, 1e-2, 0, 0}, stress, internal, 1e-6);
    ASSERT_GE(work.dissipated, 0.0);
  }
  EXPECT_LT(von_mises(stress), 1e-5 * molten.flow.yield);
  EXPECT_NEAR(pressure(stress) / (bulk_modulus(molten) * 0.1), 1.0, 1e-12);
}

TEST(JohnsonCook, ConstantsThatNobodyWouldMeasureStillHaveARoot) {
  // hardening that starts upright, softening that would run away, heat that melts within one increment
  for (int sample = 0; sample < 3000; ++sample) {
    J2JohnsonCook law = steel;
    law.flow.yield = std::pow(10.0, draw(3, 11)), law.flow.hardening = std::pow(10.0, draw(3, 13));
    law.flow.hardening_exponent = draw(0.01, 1), law.flow.rate_coefficient = draw(0, 1);
    law.flow.thermal_exponent = draw(0.05, 10), law.flow.specific_heat = std::pow(10.0, draw(-2, 4));
    Symmetric<double> stress{};
    auto internal = fresh<double, Symmetric>(law);
    for (int i = 0; i < 5; ++i) {
      const double before = internal.scalar[0], dt = std::pow(10.0, draw(-12, 6));
      strain_by(law, draw_strain(std::pow(10.0, draw(-8, 1))), stress, internal, dt);
      const double flow = internal.scalar[0] - before;
      ASSERT_TRUE(std::isfinite(von_mises(stress)) && flow >= 0 && std::isfinite(internal.scalar[1]));
    }
  }
}

TEST(JohnsonCook, NaNStrainReturnsNaNStressInsteadOfHanging) {
  Symmetric<double> stress{};
  auto internal = fresh<double, Symmetric>(steel);
  strain_by(steel, Symmetric<double>{std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 0}, stress, internal, 1e-6);
  EXPECT_TRUE(std::isnan(stress.xx));
}

TEST(JohnsonCook, BitsOfALaneDoNotDependOnItsNeighbours) {
  for (int sample = 0; sample < 200; ++sample) {
    const Symmetric<double> strain = draw_strain(std::pow(10.0, draw(-5, -1)));
    std::vector<double> first;
    for (int mixture = 0; mixture < 3; ++mixture) {
      Symmetric<Pack> stress{}, strains{};
      auto internal = fresh<Pack, Symmetric>(steel);
      for (int lane = 0; lane < lanes; ++lane) {
        const Symmetric<double> other = lane == 0 ? strain : draw_strain(mixture == 0 ? 0.0 : std::pow(10.0, draw(-9, 0)));
        auto from = other;
        for (std::size_t c = 0; c < 6; ++c) (*components(strains)[c])[lane] = *components(from)[c];
      }
      update_stress(steel, Increment<Pack, Symmetric>{strains, Pack(1e-6), Pack(1.0)}, stress, internal);
      std::vector<double> here;
      for (Pack* c : components(stress)) here.push_back((*c)[0]);
      internal.each_row([&](Pack& row) { here.push_back(row[0]); });
      if (mixture == 0) first = here;
      EXPECT_EQ(here, first);
    }
  }
}

TEST(JohnsonCook, TangentAtARateAndInHeatIsThatOfDifferences) {
  double worst = 0.0;
  for (int sample = 0; sample < 200; ++sample) {
    Symmetric<double> before{};
    auto memory = fresh<double, Symmetric>(steel);
    const double dt = std::pow(10.0, draw(-8, 0)), unit = steel.flow.yield / steel.young;
    strain_by(steel, draw_strain(10 * unit), before, memory, dt);
    const Symmetric<double> strain = draw_strain(5 * unit);
    Symmetric<Dual<6>> dual_strain{}, dual_stress{};
    auto from = strain;
    for (int i = 0; i < 6; ++i) {
      *components(dual_strain)[i] = Dual<6>::variable(*components(from)[i], i);
      *components(dual_stress)[i] = Dual<6>(*components(before)[i]);
    }
    auto dual_memory = as_dual<6>(memory);
    update_stress(steel, Increment<Dual<6>, Symmetric>{dual_strain, dt, 1.0}, dual_stress, dual_memory);
    const double h = 1e-5 * unit;
    for (int by = 0; by < 6; ++by) {
      Symmetric<double> high = strain, low = strain, high_stress = before, low_stress = before;
      auto high_memory = memory, low_memory = memory;
      *components(high)[by] += h, *components(low)[by] -= h;
      strain_by(steel, high, high_stress, high_memory, dt);
      strain_by(steel, low, low_stress, low_memory, dt);
      if ((rows(high_memory) == rows(memory)) != (rows(low_memory) == rows(memory))) continue;
      for (int i = 0; i < 6; ++i) {
        const double slope = (*components(high_stress)[i] - *components(low_stress)[i]) / (2 * h);
        worst = std::max(worst, std::abs((*components(dual_stress)[i]).by[by] - slope) / steel.young);
      }
    }
  }
  EXPECT_LT(worst, 1e-6);
}

}  // namespace
}  // namespace nereid::material::johnson_cook_test
