#include "element/viscosity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace nereid::element::viscosity_test {
namespace {

TEST(Viscosity, IsNeverNegativeAndQuadraticInCompressionOnly) {
  const Viscosity b{.linear = 0.06, .quadratic = 1.2};
  const double linear = 2.0 * 0.3 * 0.06 * 5.0;  // rho l b1 c
  EXPECT_DOUBLE_EQ(bulk_viscosity(b, 2.0, 0.3, 5.0, 0.0), linear);
  EXPECT_DOUBLE_EQ(bulk_viscosity(b, 2.0, 0.3, 5.0, 7.0), linear);
  EXPECT_DOUBLE_EQ(bulk_viscosity(b, 2.0, 0.3, 5.0, -7.0), linear + 2.0 * 0.09 * 1.44 * 7.0);
}

TEST(Viscosity, ZeroCoefficientsSwitchTheTermsOff) {
  EXPECT_EQ(bulk_viscosity(Viscosity{0, 0}, 2.0, 0.3, 5.0, -7.0), 0.0);
  EXPECT_DOUBLE_EQ(bulk_viscosity(Viscosity{0, 1.2}, 2.0, 0.3, 5.0, 7.0), 0.0);
}

TEST(StableStep, IsTheFamiliarFormula) {
  for (const double omega : {0.5, 3.0, 1e6}) {
    for (const double zeta : {0.0, 0.01, 0.06, 0.5, 1.0, 20.0}) {
      const double familiar = 2 / omega * (std::sqrt(1 + zeta * zeta) - zeta);
      EXPECT_NEAR(stable_step(omega * omega, zeta * omega), familiar, 1e-12 * familiar);
    }
  }
}

TEST(StableStep, OfAnUndampedOscillatorIsTwoOverOmega) {
  EXPECT_DOUBLE_EQ(stable_step(9.0, 0.0), 2.0 / 3.0);
}

TEST(StableStep, OfPureDampingIsOneOverItsRate) { EXPECT_DOUBLE_EQ(stable_step(0.0, 4.0), 0.25); }

/// Largest amplification of one step of  x'' = -2 s x' - omega^2 x  with the damping force half a
/// step old.
double amplification(double omega, double s, double dt) {
  // v' = (1 - 2 s dt) v - omega^2 dt x,  x' = x + dt v'
  const double trace = 2 - 2 * s * dt - omega * omega * dt * dt, determinant = 1 - 2 * s * dt;
  const std::complex<double> r = std::sqrt(std::complex<double>(trace * trace / 4 - determinant));
  return std::max(std::abs(trace / 2 + r), std::abs(trace / 2 - r));
}

TEST(StableStep, IsTheLimitOfCentralDifferencesWithOldDamping) {
  for (const double zeta : {0.01, 0.06, 0.5, 2.0}) {
    const double dt = stable_step(9.0, 3.0 * zeta);
    EXPECT_LT(amplification(3.0, 3.0 * zeta, 0.999 * dt), 1.0);
    EXPECT_GT(amplification(3.0, 3.0 * zeta, 1.001 * dt), 1.0);
  }
}

}  // namespace
}  // namespace nereid::element::viscosity_test
