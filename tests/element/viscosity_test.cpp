#include "element/viscosity.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

#include "base/types.hpp"

namespace nereid::element::viscosity_test {
namespace {

TEST(Viscosity, PartIsNeverNegativeAndQuadraticInCompressionOnly) {
  const Viscosity b{.linear = 0.06, .quadratic = 1.2};
  EXPECT_DOUBLE_EQ(viscous_part(b, 0.3, 0.0), 0.06);
  EXPECT_DOUBLE_EQ(viscous_part(b, 0.3, 7.0), 0.06);
  EXPECT_DOUBLE_EQ(viscous_part(b, 0.3, -7.0), 0.06 + 1.44 * 0.3 * 7.0);
}

TEST(Viscosity, ZeroCoefficientsSwitchTheTermsOff) {
  EXPECT_FALSE(acts(Viscosity{0, 0}));
  EXPECT_EQ(viscous_part(Viscosity{0, 0}, 0.3, -7.0), 0.0);
  EXPECT_EQ(viscous_part(Viscosity{0, 1.2}, 0.3, 7.0), 0.0);
}

constexpr double modulus = 3.0, speed = 5.0, duration = 0.01;

/// A cube of side 2 h that is strained, with its stress after Hooke's law (lambda 1, mu 1).
Motion<double> motion(const Symmetric<double>& strain, double h = 0.5) {
  const double volume = trace(strain);
  const Symmetric<double> change{volume + 2 * strain.xx, volume + 2 * strain.yy, volume + 2 * strain.zz, 2 * strain.xy, 2 * strain.yz,
                                 2 * strain.xz};
  const Vector<double> xi{h, 0, 0}, eta{0, h, 0}, zeta{0, 0, h};
  return {xi, eta, zeta, strain * xi, strain * eta, strain * zeta, strain, change, volume, duration};
}
const Viscosity linear{.linear = 0.06, .quadratic = 0};

TEST(ViscousStress, OfUniaxialStrainLeadsByThePartOfTheTimeThroughTheCell) {
  const double omega2 = 4 * speed * speed;  // so that 2 c/omega is the side
  const auto v = viscous_stress(linear, motion({1e-9, 0, 0, 0, 0, 0}), speed, omega2, {1, 0, 0});
  const double tau = 0.06 * 1.0 / speed;
  EXPECT_NEAR(v.stress.xx, tau * 3e-9 / duration, 1e-17);
  EXPECT_NEAR(v.stress.yy, tau * 1e-9 / duration, 1e-17);
  EXPECT_NEAR(v.damping, 0.5 * tau * omega2, 1e-12);
  EXPECT_NEAR(v.along[0], 1e-9, 1e-17);
}

TEST(ViscousStress, CountsEachAxisByItsWorkAndShearNotAtAll) {
  const double omega2 = 4 * speed * speed, most = 0.06 / speed / duration;
  const Shares<double, 3> all{1, 1, 1};
  const auto sheared = viscous_stress(linear, motion({0, 0, 0, 1e-9, 0, 0}), speed, omega2, all);
  EXPECT_EQ(sheared.stress.xy, 0);
  const auto one_of_three = viscous_stress(linear, motion({1e-9, 1e-9, 1e-9, 0, 0, 0}), speed, omega2, {1, 0, 0});
  EXPECT_NEAR(one_of_three.stress.xx, most * 5e-9 / 3, 1e-17);
  const auto none = viscous_stress(linear, motion({1e-9, 0, 0, 0, 0, 0}), speed, omega2, {0, 1, 1});
  EXPECT_EQ(none.stress.xx, 0);
  const auto still = viscous_stress(linear, motion({0, 0, 0, 0, 0, 0}), speed, omega2, all);
  EXPECT_EQ(still.stress.xx, 0);
  EXPECT_EQ(still.damping, sheared.damping) << "the step is that of all of it, whatever moves";
}

TEST(ViscousStress, ActsOnALengthThatIsNeverMuchLongerThanThatOfAWave) {
  const double omega2 = 4 * speed * speed * 100;  // a slender cell: the wave crosses a tenth of the side
  const auto v = viscous_stress(linear, motion({1e-9, 0, 0, 0, 0, 0}), speed, omega2, {1, 1, 1});
  EXPECT_NEAR(v.stress.xx, 0.06 * std::sqrt(2.0) * 0.1 / speed * 3e-9 / duration, 1e-17);
}

TEST(ViscousStress, TurnsWithTheElement) {
  const Mat3 Q = Eigen::AngleAxisd(0.7, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const Matrix<double> R{{Q(0, 0), Q(0, 1), Q(0, 2)}, {Q(1, 0), Q(1, 1), Q(1, 2)}, {Q(2, 0), Q(2, 1), Q(2, 2)}};
  Motion<double> m = motion({1e-3, -4e-4, 2e-4, 3e-4, -1e-4, 5e-4}), turned = m;
  for (auto* v : {&turned.xi, &turned.eta, &turned.zeta, &turned.moved_xi, &turned.moved_eta, &turned.moved_zeta}) *v = R * *v;
  turned.strain = rotate(R, m.strain), turned.change = rotate(R, m.change);
  const auto v = viscous_stress(Viscosity{}, m, speed, 90.0, {1, 0.3, 0.5});
  const auto w = viscous_stress(Viscosity{}, turned, speed, 90.0, {1, 0.3, 0.5});
  const Symmetric<double> difference = w.stress - rotate(R, v.stress);
  EXPECT_LT(std::sqrt(contract(difference, difference)), 1e-14 * std::sqrt(contract(v.stress, v.stress)));
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(w.along[k], v.along[k], 1e-17);
}

TEST(ViscousStress, IsNoneWhereTheLawSoftensAndWhereTheElementTurns) {
  const double omega2 = 4 * speed * speed;
  Motion<double> m = motion({1e-3, 0, 0, 0, 0, 0});
  m.change = -1.0 * m.change;
  EXPECT_EQ(viscous_stress(linear, m, speed, omega2, {1, 1, 1}).stress.xx, 0);
  const double angle = 0.3, c = std::cos(angle), s = std::sin(angle);
  m.xi = {0.5 * c, 0.5 * s, 0}, m.moved_xi = m.xi - Vector<double>{0.5, 0, 0};
  EXPECT_NEAR(viscous_stress(linear, m, speed, omega2, {1, 1, 1}).along[0], 0, 1e-16);
}

TEST(ViscousStress, OfAFlatCellHasTheDampingOfItsLongestLength) {
  Motion<double> m = motion({1e-3, 0, 0, 0, 0, 0});
  m.zeta = {0, 0, 0.01}, m.moved_zeta = {0, 0, 0};
  const double omega2 = 4 * speed * speed;
  EXPECT_DOUBLE_EQ(viscous_stress(linear, m, speed, omega2, {0, 0, 0}).damping, 0.5 * 0.06 / speed * omega2);
}

TEST(ViscousStress, OfAPlateIsThatOfTheGrowthOfItsArea) {
  const double omega2 = 100, crossing = 0.2;
  const auto stress = [](const Plane<double>& e) {  // plane stress of lambda' 1, mu 1
    return Plane<double>{e.xx + e.yy + 2 * e.xx, e.xx + e.yy + 2 * e.yy, 2 * e.xy};
  };
  const auto of = [&](const Plane<double>& e, double share) {
    return viscous_stress(linear, PlaneMotion<double>{e, stress(e), e.xx + e.yy, duration}, modulus, omega2, {share});
  };
  const auto wave = of({1e-3, 0, 0}, 1);
  EXPECT_NEAR(wave.stress.xx, more_of_triangles * 0.06 * crossing / duration * 3e-3, 1e-15);
  EXPECT_NEAR(wave.damping, 0.5 * more_of_triangles * 0.06 * crossing * omega2, 1e-12);
  EXPECT_EQ(of({1e-3, -1e-3, 2e-3}, 1).stress.xx, 0) << "shear";
  EXPECT_NEAR(of({1e-3, 0, 0}, 0.25).stress.xx, 0.25 * wave.stress.xx, 1e-15);
  EXPECT_EQ(of({0, 0, 0}, 1).stress.xx, 0);
  EXPECT_EQ(of({1e-3, 0, 0}, 0).damping, wave.damping);
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
