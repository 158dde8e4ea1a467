// What is special about flow stresses that are curves: their formulas, their rates, and how far they follow them.

#include "material/j2_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "material/j2_bilinear.hpp"
#include "tests/base/chance.hpp"
#include "tests/material/point.hpp"

namespace nereid::material::j2_curve_test {
namespace {

using Kind = HardeningCurve::Kind;

const MeasuredCurve slow{1e-3, {0, 0.02, 0.1, 0.5}, {200e6, 260e6, 330e6, 400e6}};
const MeasuredCurve fast{1e3, {0, 0.05, 0.4}, {400e6, 500e6, 520e6}};

J2Curve steel(HardeningCurve flow) { return {7800, 200e9, 0.3, std::move(flow)}; }

/// One of each kind, with and without an effect of the rate.
std::vector<J2Curve> all_kinds() {
  std::vector<J2Curve> laws{steel({.kind = Kind::measured, .curves = {slow}}),
                            steel({.kind = Kind::measured, .curves = {slow, fast}}),
                            steel({.kind = Kind::voce, .yield = 200e6, .growth = 150e6, .exponent = 12}),
                            steel({.kind = Kind::ludwik, .yield = 200e6, .growth = 300e6, .exponent = 0.4}),
                            steel({.kind = Kind::swift, .growth = 500e6, .exponent = 0.2, .offset = 0.01})};
  const std::size_t count = laws.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (laws[i].flow.curves.size() > 1) continue;
    laws.push_back(laws[i]);
    laws.back().flow.cowper_rate = 40.4, laws.back().flow.cowper_exponent = 5;
  }
  return laws;
}

/// The formulas as they stand in docs/theory/hardening_curves.md, written once more.
double formula(const HardeningCurve& f, double p, double rate) {
  const auto table = [](const MeasuredCurve& c, double at) {
    for (std::size_t i = 1; i < c.strain.size(); ++i)
      if (at <= c.strain[i])
        return c.stress[i - 1] + (c.stress[i] - c.stress[i - 1]) * (at - c.strain[i - 1]) / (c.strain[i] - c.strain[i - 1]);
    return c.stress.back();
  };
  double value = 0;
  if (f.kind == Kind::voce) value = f.yield + f.growth * (1 - std::exp(-f.exponent * p));
  if (f.kind == Kind::ludwik) value = f.yield + f.growth * std::pow(p, f.exponent);
  if (f.kind == Kind::swift) value = f.growth * std::pow(f.offset + p, f.exponent);
  if (f.kind == Kind::measured) {
    value = table(f.curves[0], p);
    if (f.curves.size() == 2) {
      const double part = std::log(std::clamp(rate, f.curves[0].rate, f.curves[1].rate) / f.curves[0].rate) /
                          std::log(f.curves[1].rate / f.curves[0].rate);
      value += part * (table(f.curves[1], p) - value);
    }
  }
  return value * (f.cowper_rate > 0 ? 1 + std::pow(rate / f.cowper_rate, 1 / f.cowper_exponent) : 1);
}

Chance64 chance(23);
double draw(double low, double high) { return std::uniform_real_distribution<double>(low, high)(chance); }
template <class S>
S draw_strain(double size) {
  S strain{};
  for (double* c : components(strain)) *c = draw(-size, size);
  return strain;
}

TEST(HardeningCurve, IsItsFormula) {
  for (const J2Curve& law : all_kinds())
    for (const double p : {0.0, 1e-4, 0.02, 0.07, 0.3, 0.5, 2.0})
      for (const double rate : {0.0, 1e-5, 1e-3, 3.0, 1e3, 1e6})
        EXPECT_NEAR(value_at(law.flow, p, rate).value / formula(law.flow, p, rate), 1, 1e-14) << p << " " << rate;
}

TEST(HardeningCurve, HasTheSlopesOfItsFiniteDifferences) {
  for (const J2Curve& law : all_kinds())
    for (const double p : {1e-3, 0.03, 0.2, 0.45})
      for (const double rate : {1e-2, 3.0, 500.0}) {
        const Tangent<double> at = value_at(law.flow, p, rate);
        const double h = 1e-6 * p, k = 1e-6 * rate, size = at.value;
        EXPECT_NEAR(at.by_first, (formula(law.flow, p + h, rate) - formula(law.flow, p - h, rate)) / (2 * h), 1e-7 * size / p);
        EXPECT_NEAR(at.by_second, (formula(law.flow, p, rate + k) - formula(law.flow, p, rate - k)) / (2 * k), 1e-7 * size / rate);
      }
}

TEST(J2Curve, StressAfterFlowIsTheFlowStressOfItsStrainAndRateForIncrementsOfAnySize) {
  int flowed = 0;
  const auto run = [&flowed](const J2Curve& law, auto stress) {
    using S = decltype(stress);
    auto internal = fresh<J2Curve>(stress);
    for (int i = 0; i < 20; ++i) {
      const double before = internal.scalar[0], dt = std::pow(10.0, draw(-9, 4));
      strain_by(law, draw_strain<S>(std::pow(10.0, draw(-6, -0.5))), stress, internal, dt);
      const double flow = internal.scalar[0] - before;
      if (flow > 0) {
        ++flowed;
        const double digits = 1e-15 * internal.scalar[0] / flow;  // what the difference of two plastic strains has lost
        ASSERT_NEAR(von_mises(stress) / formula(law.flow, internal.scalar[0], flow / dt), 1.0, 1e-9 + digits);
      } else {
        const double lost = 2e-16 * before;  // a flow that the digits of the plastic strain do not hold
        ASSERT_LE(von_mises(stress), formula(law.flow, before, lost / dt) * (1 + 1e-12));
      }
    }
  };
  for (const J2Curve& law : all_kinds())
    for (int history = 0; history < 100; ++history) run(law, Symmetric<double>{}), run(law, Plane<double>{});
  EXPECT_GT(flowed, 10000);
}

TEST(J2Curve, FollowsAJumpOfTheRate) {
  // Uniaxial stress at 1/s, then at 1000/s: the flow stress jumps by the ratio of the factors of Cowper and Symonds.
  J2Curve law = steel({.kind = Kind::voce, .yield = 200e6, .growth = 0, .exponent = 1, .cowper_rate = 40.4, .cowper_exponent = 5});
  const auto factor = [&](double rate) { return 1 + std::pow(rate / 40.4, 0.2); };
  Plane<double> stress{};
  auto internal = fresh<J2Curve>(stress);
  const double step = 1e-5;
  const auto pull = [&](double rate, int steps) {
    double before = 0;
    for (int i = 0; i < steps; ++i) {
      before = internal.scalar[0];
      const double lateral = internal.scalar[0] > 0 ? -0.5 * step : -law.poisson * step;
      strain_by(law, Plane<double>{step, lateral, 0}, stress, internal, step / rate);
    }
    return (internal.scalar[0] - before) * rate / step;  // of plastic strain
  };
  const double slow_rate = pull(1, 2000), slow_stress = von_mises(stress), fast_rate = pull(1000, 2000), fast_stress = von_mises(stress);
  EXPECT_NEAR(slow_stress, 200e6 * factor(slow_rate), 1e-6 * slow_stress);
  EXPECT_NEAR(fast_stress, 200e6 * factor(fast_rate), 1e-6 * fast_stress);
  EXPECT_NEAR(fast_rate, 1000, 1);
  EXPECT_NEAR(slow_rate, 1, 1e-3);
}

TEST(J2Curve, ThatIsBilinearIsJ2BilinearToRoundOff) {
  const double H = 2e9, yield = 250e6;
  const J2Curve curve = steel({.kind = Kind::measured, .curves = {{0, {0, 10}, {yield, yield + 10 * H}}}});
  const J2Bilinear same{curve.density, curve.young, curve.poisson, {yield, curve.young * H / (curve.young + H)}};
  const auto run = [&](auto a) {
    auto b = a;
    auto of_curve = fresh<J2Curve>(a);
    auto of_same = fresh<J2Bilinear>(b);
    for (int i = 0; i < 20; ++i) {
      const auto strain = draw_strain<decltype(a)>(3e-3);
      strain_by(curve, strain, a, of_curve), strain_by(same, strain, b, of_same);
      ASSERT_LT(largest(a - b), 1e-10 * yield);
      ASSERT_NEAR(of_curve.scalar[0], of_same.scalar[0], 1e-13);
    }
  };
  for (int history = 0; history < 100; ++history) run(Symmetric<double>{}), run(Plane<double>{});
}

}  // namespace
}  // namespace nereid::material::j2_curve_test
