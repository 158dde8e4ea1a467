#include "material/elastic.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

#include "base/dual.hpp"
#include "tests/base/chance.hpp"
#include "tests/material/carried.hpp"

namespace nereid::material::elastic_test {
namespace {

const Elastic steel{7800.0, 2.0e11, 0.3};
Internal<double, Elastic, Symmetric> nothing;
Internal<double, Elastic, Plane> nothing_in_plane;

TEST(Elastic, ModuliSatisfyTheirIdentities) {
  const auto [lambda, mu] = lame(steel);
  EXPECT_DOUBLE_EQ(mu, 2.0e11 / 2.6);
  EXPECT_DOUBLE_EQ(shear_modulus(steel), mu);
  EXPECT_NEAR(bulk_modulus(steel), lambda + 2.0 / 3.0 * mu, 1e-4);
  EXPECT_NEAR(mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu), steel.young, 1e-3);
  EXPECT_NEAR(lambda / (2.0 * (lambda + mu)), steel.poisson, 1e-15);
}

TEST(Elastic, WaveSpeedsAreThoseOfSpaceAndOfAThinPlate) {
  EXPECT_NEAR(wave_speed(steel), std::sqrt(2.0e11 * 0.7 / (1.3 * 0.4 * 7800.0)), 1e-9);
  EXPECT_NEAR(plate_wave_speed(steel), std::sqrt(2.0e11 / (0.91 * 7800.0)), 1e-9);
}

TEST(Elastic, StressOfUniaxialStrainIsTheConstrainedModulusTimesStrain) {
  Symmetric<double> stress{};
  strain_by(steel, Symmetric<double>{1e-3, 0, 0, 0, 0, 0}, stress, nothing);
  const auto [lambda, mu] = lame(steel);
  EXPECT_DOUBLE_EQ(stress.xx, 1e-3 * lambda + 1e-3 * (2.0 * mu));
  EXPECT_DOUBLE_EQ(stress.yy, 1e-3 * lambda);
  EXPECT_DOUBLE_EQ(stress.zz, 1e-3 * lambda);
  EXPECT_EQ(stress.xy, 0.0);
}

TEST(Elastic, ShearComponentsAreTensorComponents) {
  Symmetric<double> space{};
  Plane<double> plane{};
  strain_by(steel, Symmetric<double>{0, 0, 0, 1e-3, 2e-3, 3e-3}, space, nothing);
  strain_by(steel, Plane<double>{0, 0, 1e-3}, plane, nothing_in_plane);
  const double twice_mu = 2.0 * shear_modulus(steel);
  EXPECT_DOUBLE_EQ(space.xy, 1e-3 * twice_mu);
  EXPECT_DOUBLE_EQ(space.yz, 2e-3 * twice_mu);
  EXPECT_DOUBLE_EQ(space.xz, 3e-3 * twice_mu);
  EXPECT_DOUBLE_EQ(plane.xy, 1e-3 * twice_mu);
}

TEST(Elastic, EqualStrainInAPlateGivesTheBiaxialModulus) {
  Plane<double> stress{};
  strain_by(steel, Plane<double>{1e-3, 1e-3, 0}, stress, nothing_in_plane);
  EXPECT_NEAR(stress.xx, 1e-3 * steel.young / 0.7, 1e-7);
  EXPECT_EQ(stress.xx, stress.yy);
}

TEST(Elastic, StoredWorkIsTheChangeOfHalfStressOverYoungSquared) {
  Plane<double> stress{};
  const Plane<double> stretch{1e-3, -0.3e-3, 0};  // uniaxial stress
  const Work<double> first = strain_by(steel, stretch, stress, nothing_in_plane);
  EXPECT_NEAR(first.stored, 0.5 * 1e-6 * steel.young, 1e-9);
  const Work<double> second = strain_by(steel, stretch, stress, nothing_in_plane);
  EXPECT_NEAR(first.stored + second.stored, 0.5 * 4e-6 * steel.young, 1e-9);
  EXPECT_EQ(first.dissipated, 0.0);
}

TEST(Elastic, VonMisesStressIsUniaxialStressAndRootThreeTimesShear) {
  EXPECT_DOUBLE_EQ(von_mises(Symmetric<double>{-7, 0, 0, 0, 0, 0}), 7.0);
  EXPECT_DOUBLE_EQ(von_mises(Plane<double>{0, -7, 0}), 7.0);
  EXPECT_DOUBLE_EQ(von_mises(Symmetric<double>{5, 5, 5, 0, 2, 0}), 2.0 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(von_mises(Plane<double>{0, 0, 2}), 2.0 * std::sqrt(3.0));
}

TEST(Elastic, PressureIsPositiveInCompression) {
  EXPECT_DOUBLE_EQ(pressure(Symmetric<double>{-1, -2, -6, 4, 5, 6}), 3.0);
}

TEST(Elastic, ShearsByTheLogarithmicRate) {
  // tau = 2 mu h_xy with the logarithmic strain of simple shear; Jaumann's rate has mu sin(angle)
  for (const double angle : {0.3, 1.0, 1.5}) {
    Carried<Elastic> point{steel};
    Mat3 to = Mat3::Identity();
    to(0, 1) = angle;
    carry(point, to, 1000);
    const double h = 2 * std::asinh(0.5 * angle) / std::sqrt(4 + angle * angle), mu = shear_modulus(steel);
    EXPECT_NEAR(point.stress.xy, 2 * mu * h, 2e-3 * mu);
    EXPECT_NEAR(point.stress.xx, mu * h * angle, 2e-3 * mu);
  }
}

TEST(Elastic, HasNoStressAfterACycleOfLargeStrainsThatCloses) {
  Mat3 pressed = Mat3::Identity(), sheared = pressed, turned = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  pressed(2, 2) = 0.6, pressed(0, 0) = pressed(1, 1) = 1.15, sheared = pressed, sheared(0, 2) = 0.6;
  Carried<Elastic> point{steel};
  for (const Mat3& to : {pressed, sheared, Mat3(turned * sheared), turned, Mat3(Mat3::Identity())}) carry(point, to, 1000);
  EXPECT_LT(largest(point.stress), 2e-3 * steel.young);
}

TEST(Elastic, LogarithmicRateDoesNoWorkBesidesThatOfTheStrain) {
  const Symmetric<double> h{0.2, -0.3, 0.1, 0.15, -0.2, 0.05}, d{1e-3, -2e-3, 3e-3, 2e-3, 1e-3, -1e-3};
  EXPECT_NEAR(contract(h, added_by_logarithmic_rate(h, d)), 0, 1e-19);
  const Symmetric<double> along{0.2, -0.3, 0.1, 0, 0, 0}, shear{0, 0, 0, 1e-3, 0, 0};
  EXPECT_NEAR(added_by_logarithmic_rate(along, shear).xy, 1e-3 * (0.5 / std::tanh(0.5) - 1), 2e-7);
  EXPECT_NEAR(added_by_logarithmic_rate(Plane<double>{0.2, -0.3, 0}, Plane<double>{0, 0, 1e-3}).xy, 1e-3 * (0.5 / std::tanh(0.5) - 1),
              2e-7);
}

/// A stress of large elastic strains, and an increment.
struct Large {
  Symmetric<double> stress, strain;
};
Large draw_large(Chance& chance) {
  Large one{};
  std::uniform_real_distribution<double> stress(-0.6, 0.6), strain(-0.02, 0.02);
  for (double* c : components(one.stress)) *c = steel.young * stress(chance);
  for (double* c : components(one.strain)) *c = strain(chance);
  return one;
}

TEST(Elastic, AtLargeStrainsTurnsWithItsFrameAndHasTheTangentOfDifferences) {
  using D = Dual<6>;
  Chance chance(3);
  for (int i = 0; i < 30; ++i) {
    const Large one = draw_large(chance);
    Symmetric<double> straight = one.stress;
    const Work<double> work = strain_by(steel, one.strain, straight, nothing);
    EXPECT_NEAR(work.stored, 0.5 * contract(one.stress + straight, one.strain), 1e-12 * std::abs(work.stored));
    EXPECT_EQ(work.dissipated, 0);

    const Mat3 Q = Eigen::AngleAxisd(1 + i, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const auto turned = [&](const Symmetric<double>& s) { return symmetric(Q * full(s) * Q.transpose()); };
    Symmetric<double> other = turned(one.stress);
    strain_by(steel, turned(one.strain), other, nothing);
    EXPECT_LT(largest(other - turned(straight)), 1e-13 * largest(straight));

    Symmetric<D> stress{one.stress.xx, one.stress.yy, one.stress.zz, one.stress.xy, one.stress.yz, one.stress.xz};
    Symmetric<D> strain{one.strain.xx, one.strain.yy, one.strain.zz, one.strain.xy, one.strain.yz, one.strain.xz};
    for (int k = 0; k < 6; ++k) components(strain)[static_cast<std::size_t>(k)]->by[static_cast<std::size_t>(k)] = 1;
    Internal<D, Elastic, Symmetric> none;
    strain_by(steel, strain, stress, none);
    for (std::size_t k = 0; k < 6; ++k) {
      Large more = one, less = one;
      *components(more.strain)[k] += 1e-5, *components(less.strain)[k] -= 1e-5;
      strain_by(steel, more.strain, more.stress, nothing), strain_by(steel, less.strain, less.stress, nothing);
      Symmetric<double> slope = 0.5e5 * (more.stress - less.stress);
      for (std::size_t c = 0; c < 6; ++c)
        EXPECT_NEAR(components(stress)[c]->by[k], *components(slope)[c], 1e-7 * steel.young);
    }
  }
}

TEST(Elastic, BitsOfALaneDoNotDependOnWhetherItsNeighboursStrainsAreSmall) {
  Chance chance(4);
  Symmetric<Pack> stress, strain;
  std::array<Large, lanes> all;
  for (int lane = 0; lane < lanes; ++lane) {
    Large& one = all[static_cast<std::size_t>(lane)] = draw_large(chance);
    if (lane % 2 == 1) one.stress = 1e-6 * one.stress;
    for (std::size_t c = 0; c < 6; ++c) {
      (*std::array{&stress.xx, &stress.yy, &stress.zz, &stress.xy, &stress.yz, &stress.xz}[c])[lane] = *components(one.stress)[c];
      (*std::array{&strain.xx, &strain.yy, &strain.zz, &strain.xy, &strain.yz, &strain.xz}[c])[lane] = *components(one.strain)[c];
    }
  }
  Internal<Pack, Elastic, Symmetric> none;
  update_stress(steel, Increment<Pack, Symmetric>{strain, Pack(1.0), Pack(1.0)}, stress, none);
  for (int lane = 0; lane < lanes; ++lane) {
    Large one = all[static_cast<std::size_t>(lane)];
    strain_by(steel, one.strain, one.stress, nothing);
    EXPECT_NEAR(stress.xy[lane], one.stress.xy, 1e-14 * largest(one.stress));
    EXPECT_NEAR(stress.xx[lane], one.stress.xx, 1e-14 * largest(one.stress));
  }
}

}  // namespace
}  // namespace nereid::material::elastic_test
