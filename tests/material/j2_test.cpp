// A flow stress of one's own over Hooke's law: three functions, and the return is there.

#include "material/j2.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nereid::material::j2_test {

/// It does not harden, and counts how often it flowed.
struct Counting {
  static constexpr std::array<Variable, 2> internal{{{"plastic_strain", "1"}, {"increments", "1"}}};
  double yield;  // [Pa]
};
using Counted = J2<Counting>;

std::array<double, 2> start_values(const Counted&) { return {0.0, 100.0}; }
template <class T>
T yield_stress(const Counted& law, const std::array<T, 2>&) {
  return T(law.flow.yield);
}
template <class T>
T flow_increment(const Counted& law, const Trial<T>& trial, const T&, const T&, const std::array<T, 2>&) {
  return T(1.0 / (3.0 * shear_modulus(law))) * (trial.mises - trial.yield);
}
template <class T>
void remember(const Counted&, const T& flow, const T&, const T&, std::array<T, 2>& scalar) {
  scalar[0] = scalar[0] + flow;
  scalar[1] = scalar[1] + select(flow > T(0.0), T(1.0), T(0.0));
}

namespace {

const Counted metal{1.0, 3.0, 0.3, {0.01}};

TEST(J2, TakesAFlowStressThatItHasNeverSeen) {
  static_assert(Law<Counted> && !PlateLaw<Counted>);
  Symmetric<double> stress{};
  auto internal = fresh<double, Symmetric>(metal);
  EXPECT_EQ(internal.scalar[1], 100.0) << "scalars start as the law says";
  std::mt19937 chance(3);
  std::uniform_real_distribution<double> draw(-0.01, 0.01);
  int flowed = 0;
  for (int i = 0; i < 1000; ++i) {
    const Symmetric<double> old = stress, strain{draw(chance), draw(chance), draw(chance), draw(chance), draw(chance), draw(chance)};
    const double before = internal.scalar[0];
    const auto [work, moduli] = update_stress(metal, Increment<double, Symmetric>{strain, 1.0, 1.0}, stress, internal);
    ASSERT_LE(von_mises(stress), 0.01 * (1 + 1e-12));
    ASSERT_GE(work.dissipated, 0.0);
    ASSERT_NEAR(work.stored + work.dissipated, 0.5 * contract(old + stress, strain), 1e-15);
    ASSERT_EQ(moduli.mu, shear_modulus(metal));
    flowed += internal.scalar[0] > before;
  }
  EXPECT_GT(flowed, 500);
  EXPECT_EQ(internal.scalar[1], 100.0 + flowed);
}

TEST(J2, TellsItsFlowStressWhatTheOldStressDidAlongTheFlow) {
  // old stress and trial along one line: the work of the flow is the mean of both ends times the flow
  Symmetric<double> stress{};
  auto internal = fresh<double, Symmetric>(metal);
  const Increment<double, Symmetric> pull{{0.01, -0.005, -0.005, 0, 0, 0}, 1.0, 1.0}, push{{-0.03, 0.015, 0.015, 0, 0, 0}, 1.0, 1.0};
  update_stress(metal, pull, stress, internal);
  const double flowed = internal.scalar[0];
  const Work<double> work = update_stress(metal, push, stress, internal).work;
  EXPECT_NEAR(work.dissipated, 0.5 * (-0.01 + 0.01) * (internal.scalar[0] - flowed), 1e-17) << "it starts against the flow";
}

}  // namespace
}  // namespace nereid::material::j2_test
