// What every law of a fluid must do, and what is known of each.

#include "material/fluid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/dual.hpp"
#include "material/laws.hpp"

namespace nereid::material::fluid_test {
namespace {

const LinearFluid water{1000, 2.19e9};
const MieGruneisen shocked{1000, 1480, 1.75, 0.28};
const IdealGas air{1.2, 1.4, 1e5};

LinearFluid of(LinearFluid*) { return water; }
MieGruneisen of(MieGruneisen*) { return shocked; }
IdealGas of(IdealGas*) { return air; }

/// Moves to a volume in equal steps; what was taken up, per volume of the reference.
template <class Law>
FluidResponse<double> carry(const Law& law, double ratio, int steps, FluidState<double>& state) {
  FluidResponse<double> sum{0, 0, 0, 0};
  const double from = state.ratio;
  for (int i = 1; i <= steps; ++i) {
    const auto one = update_pressure(law, from + (ratio - from) * i / steps, state);
    sum.compression += one.compression, sum.cavitation += one.cavitation, sum.modulus = one.modulus;
  }
  return sum;
}

template <class Law>
class Fluids : public ::testing::Test {};
using Each = ::testing::Types<LinearFluid, MieGruneisen, IdealGas>;
TYPED_TEST_SUITE(Fluids, Each);

TYPED_TEST(Fluids, StartWithThePressureThatIsAskedFor) {
  const TypeParam law = of(static_cast<TypeParam*>(nullptr));
  for (const double pressure : {2e4, 1e6, 3e8}) {
    FluidState<double> state = start_at(law, pressure);
    EXPECT_EQ(state.pressure, pressure);
    update_pressure(law, state.ratio, state);
    EXPECT_NEAR(state.pressure, pressure, 1e-6 * pressure);  // of a liquid, round-off of its volume
  }
}

TEST(MieGruneisenFluid, StartsWithTheShockOfItsPressureUpToTheHighest) {
  const MieGruneisen laws[]{{1000, 1480, 1.75, 0.28, -1e9}, {856, 2366, 1.24, 5, -1e9}, {1000, 1480, 0, 2, -1e9}};
  for (const MieGruneisen& law : laws)
    for (const double pressure : {-5e8, 0.0, 1e6, 0.5 * highest_start(law), 0.999 * highest_start(law)}) {
      FluidState<double> state = start_at(law, pressure);
      EXPECT_GT(state.ratio, 0);
      EXPECT_NEAR(state.energy, 0.5 * pressure * (1 - state.ratio), 1e-15 * std::abs(pressure)) << "round-off of the volume";
      update_pressure(law, state.ratio, state);
      EXPECT_NEAR(state.pressure, pressure, 1e-6 * std::abs(pressure) + 1e-6);
    }
}

TYPED_TEST(Fluids, TakeUpTheWorkOfTheirPressure) {
  const TypeParam law = of(static_cast<TypeParam*>(nullptr));
  FluidState<double> state = start_at(law, 1e5);
  const double start = state.energy;
  double work = 0;
  for (int i = 1; i <= 100; ++i) {
    const double before = state.pressure, ratio = state.ratio;
    const auto one = update_pressure(law, ratio - 1e-3, state);
    work += one.compression;
    EXPECT_NEAR(one.compression, 0.5e-3 * (before + state.pressure), 1e-9 * std::abs(work));
  }
  EXPECT_NEAR(state.energy - start, work, 1e-12 * work);
}

TYPED_TEST(Fluids, GiveBackAllWorkOfASlowCycle) {
  const TypeParam law = of(static_cast<TypeParam*>(nullptr));
  FluidState<double> state = start_at(law, 1e5);
  const FluidState<double> start = state;
  const double in = carry(law, 0.95 * start.ratio, 1000, state).compression, out = carry(law, start.ratio, 1000, state).compression;
  EXPECT_NEAR(out, -in, 1e-6 * in);
  EXPECT_NEAR(state.pressure, start.pressure, 1e-5 * start.pressure);
}

TYPED_TEST(Fluids, HaveTheModulusOfTheirPressure) {
  const TypeParam law = of(static_cast<TypeParam*>(nullptr));
  for (const double ratio : {0.98, 0.9, 0.8}) {
    FluidState<double> state = start_at(law, 1e5);
    const double modulus = carry(law, ratio * state.ratio, 1000, state).modulus;
    FluidState<double> less = state, more = state;
    const double d = 1e-6;
    update_pressure(law, state.ratio - d, less), update_pressure(law, state.ratio + d, more);
    const double difference = -state.ratio * (more.pressure - less.pressure) / (2 * d);
    EXPECT_NEAR(modulus, difference, 1e-6 * modulus) << ratio;
  }
}

TYPED_TEST(Fluids, AnswerPacksAsNumbers) {
  const TypeParam law = of(static_cast<TypeParam*>(nullptr));
  FluidState<Pack> packed;
  Pack ratio;
  std::array<FluidState<double>, lanes> one;
  for (int l = 0; l < lanes; ++l) {
    one[static_cast<std::size_t>(l)] = start_at(law, 1e5 + 1e4 * l);
    const auto& state = one[static_cast<std::size_t>(l)];
    packed.ratio[l] = state.ratio, packed.pressure[l] = state.pressure, packed.energy[l] = state.energy, ratio[l] = 1.002 - 0.001 * l;
  }
  const FluidResponse<Pack> all = update_pressure(law, ratio, packed);
  for (int l = 0; l < lanes; ++l) {
    auto& state = one[static_cast<std::size_t>(l)];
    const auto response = update_pressure(law, static_cast<double>(ratio[l]), state);
    EXPECT_EQ(packed.pressure[l], state.pressure);
    EXPECT_EQ(packed.energy[l], state.energy);
    EXPECT_EQ(all.modulus[l], response.modulus);
    EXPECT_EQ(all.compression[l], response.compression);
  }
}

TEST(LinearFluid, IsLinearInItsVolume) {
  FluidState<double> state = start_at(water, 0);
  carry(water, 0.97, 7, state);
  EXPECT_NEAR(state.pressure, 0.03 * water.bulk_modulus, 1e-9 * water.bulk_modulus);
  EXPECT_NEAR(state.energy, 0.5 * 0.03 * 0.03 * water.bulk_modulus, 1e-12 * water.bulk_modulus);
}

template <class Law>
void open_and_close(Law law) {
  law.cutoff = -2e6;
  FluidState<double> state = start_at(law, 0);
  const auto opened = carry(law, 1.05, 5000, state);
  EXPECT_NEAR(state.pressure, -2e6, 1);
  EXPECT_NEAR(void_part(law, state), 1 - (1 + 2e6 / bulk_modulus_at_start(law)) / 1.05, 1e-5);
  const double K = bulk_modulus_at_start(law), stretch = 2e6 / K;
  EXPECT_NEAR(opened.compression, 0.5 * 2e6 * stretch, 0.02 * 2e6 * stretch);
  EXPECT_NEAR(opened.cavitation, 2e6 * (0.05 - stretch), 0.02 * 2e6 * stretch);
  const auto closed = carry(law, 0.99, 5000, state);
  EXPECT_NEAR(closed.cavitation, -opened.cavitation, 0.02 * 2e6 * stretch);
  FluidState<double> never = start_at(law, 0);
  carry(law, 0.99, 5000, never);
  EXPECT_NEAR(state.pressure, never.pressure, 1e-5 * never.pressure);
  EXPECT_EQ(void_part(law, state), 0);
}

TEST(LinearFluid, LosesWorkWhereBubblesCloseWithinAStep) {
  FluidState<double> state{1.001, 0, 0};
  const auto closed = update_pressure(water, 0.999, state);
  EXPECT_NEAR(closed.compression, 0.5 * water.bulk_modulus * 1e-6, 1e-6);
  EXPECT_NEAR(closed.compression + closed.lost, 0.5 * state.pressure * 0.002, 1e-6) << "the trapezoid rule of the nodes";
  const auto opened = update_pressure(water, 1.001, state);
  EXPECT_NEAR(opened.lost, -closed.lost, 1e-6) << "at the same speed both are alike";
}

TEST(LinearFluid, HasBubblesThatOpenAndCloseAtTheSameVolume) { open_and_close(water); }
TEST(MieGruneisen, HasBubblesThatOpenAndCloseAtTheSameVolume) { open_and_close(shocked); }

TEST(MieGruneisen, HasTheStatesBehindShocks) {
  // p = density (c + s u) u, V/V0 = 1 - u/Us, e = u^2/2 (Rankine & Hugoniot): F-2 and F-5 of the catalogue
  for (const double u : {1.0, 10.0, 49.0, 100.0}) {
    const double Us = shocked.sound_speed + shocked.slope * u, mu = u / Us;
    const auto [cold, slope] = cold_pressure(shocked, mu);
    EXPECT_NEAR(cold + shocked.gamma * 0.5 * shocked.density * u * u, shocked.density * Us * u, 1e-9 * shocked.density * Us * u);
    const Dual<1> variable = Dual<1>::variable(mu, 0);
    EXPECT_NEAR(cold_pressure(shocked, variable).value.by[0], slope, 1e-9 * slope);
  }
}

TEST(IdealGas, KeepsPVToTheGammaWhereNoHeatIsExchanged) {
  double error[2];
  for (const int n : {0, 1}) {
    FluidState<double> state = start_at(air, air.pressure);
    carry(air, 0.5, 50 << n, state);
    error[n] = std::abs(state.pressure / (air.pressure * std::pow(2.0, air.gamma)) - 1);
  }
  EXPECT_LT(error[1], 1e-4);
  EXPECT_NEAR(error[0] / error[1], 4, 0.1) << "of second order";
}

}  // namespace
}  // namespace nereid::material::fluid_test
