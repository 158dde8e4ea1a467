#include "element/assumed_strain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "material/law.hpp"
#include "tests/element/solids.hpp"

namespace nereid::element::assumed_strain_test {
namespace {

TEST(AssumedStrain, MomentsAndForcesOnModesAreInverses) {
  for (int trial = 0; trial < 20; ++trial) {
    const auto frame = centre_frame<double>({random_point(1), random_point(1), random_point(1)});
    HourglassMoments<double> m;
    for (auto& p : m.plane) p = {random(-1, 1), random(-1, 1), random(-1, 1)};
    for (double& a : m.along) a = random(-1, 1);
    const auto back = moments_of(frame, forces_of(frame, m));
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(back.plane[k].ii, m.plane[k].ii, 1e-10);
      EXPECT_NEAR(back.plane[k].jj, m.plane[k].jj, 1e-10);
      EXPECT_NEAR(back.plane[k].ij, m.plane[k].ij, 1e-10);
      EXPECT_NEAR(back.along[k], m.along[k], 1e-10);
    }
  }
}

TEST(AssumedStrain, EnergyOfTheMomentsIsTheirWork) {
  const double young = 3, poisson = 0.3, mu = young / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson);
  for (int trial = 0; trial < 20; ++trial) {
    const auto frame = centre_frame<double>({random_point(1), random_point(1), random_point(1)});
    const double volume = 8 * std::abs(dot(frame.g[0], cross(frame.g[1], frame.g[2])));
    const std::array<Point, 4> q{random_point(1), random_point(1), random_point(1), random_point(1)};
    const auto m = moments_from(frame, q, volume, lambda, mu);
    const auto Q = forces_of(frame, m);
    double work = 0;
    for (int a = 0; a < 4; ++a) work += 4 * dot(Q[a], q[a]);
    EXPECT_NEAR(energy_of(frame, m, 1 / volume, young, poisson), work, 1e-12 * work);
  }
}

TEST(AssumedStrain, FlowTakesWhatIsAlongItAndTheEnergyFalls) {
  const double young = 3, poisson = 0.3, mu = young / (2 * (1 + poisson)), lambda = 2 * mu * poisson / (1 - 2 * poisson);
  for (int trial = 0; trial < 100; ++trial) {
    const auto frame = centre_frame<double>({random_point(1), random_point(1), random_point(1)});
    const double volume = 8 * std::abs(dot(frame.g[0], cross(frame.g[1], frame.g[2])));
    const std::array<Point, 4> q{random_point(1), random_point(1), random_point(1), random_point(1)};
    auto m = moments_from(frame, q, volume, lambda, mu);
    const Symmetric<double> s = material::deviator(
        Symmetric<double>{random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1)});
    const double before = energy_of(frame, m, 1 / volume, young, poisson);
    take_along(frame, s, 0.5, poisson, m);
    const double half = energy_of(frame, m, 1 / volume, young, poisson);
    take_along(frame, s, 1.0, poisson, m);
    const double after = energy_of(frame, m, 1 / volume, young, poisson);
    EXPECT_LE(half, before * (1 + 1e-12));
    EXPECT_LE(after, half * (1 + 1e-12));
    for (int k = 0; k < 3; ++k) {
      const Point &a = frame.g[(k + 1) % 3], &b = frame.g[(k + 2) % 3];
      const auto& p = m.plane[k];
      const double left = p.ii * dot(a, s * a) + p.jj * dot(b, s * b) + 2 * p.ij * dot(a, s * b);
      EXPECT_NEAR(left, 0, 1e-10 * (std::abs(p.ii) + std::abs(p.jj) + std::abs(p.ij)) + 1e-12) << k;
    }
  }
}

/// Of two deviators, by their double contraction.
double cosine(const Symmetric<double>& a, const Symmetric<double>& b) {
  return contract(a, b) / std::sqrt(contract(a, a) * contract(b, b));
}

TEST(AssumedStrain, FlowLeavesOfAMomentAlongATangentWhatItsUniaxialStressHasAcrossTheFlow) {
  for (int trial = 0; trial < 100; ++trial) {
    const auto frame = centre_frame<double>({random_point(1), random_point(1), random_point(1)});
    const Symmetric<double> s = material::deviator(random_tensor(1));
    const double part = random(0, 1);
    HourglassMoments<double> m{};
    m.along = {1, -2, 3};
    auto left = m;
    take_along(frame, s, part, 0.3, left);
    for (int k = 0; k < 3; ++k) {
      const Point &g = frame.g[k], n = (1 / norm(g)) * g;
      const auto uniaxial = material::deviator(Symmetric<double>{n.x * n.x, n.y * n.y, n.z * n.z, n.x * n.y, n.y * n.z, n.x * n.z});
      EXPECT_NEAR(left.along[k], m.along[k] * (1 - part * std::pow(cosine(uniaxial, s), 2)), 1e-12) << k;
    }
  }
}

TEST(AssumedStrain, FlowInTensionAlongAnAxisTakesAllOfTheMomentAlongItAndAQuarterOfThoseAcross) {
  const auto frame = centre_frame<double>({Point{2, 0, 0}, Point{0, 0.5, 0}, Point{0, 0, 1}});
  HourglassMoments<double> m{};
  m.along = {1, 1, 1};
  take_along(frame, Symmetric<double>{2, -1, -1, 0, 0, 0}, 1.0, 0.3, m);
  EXPECT_NEAR(m.along[0], 0, 1e-15);
  EXPECT_NEAR(m.along[1], 0.75, 1e-15);
  EXPECT_NEAR(m.along[2], 0.75, 1e-15);
}

}  // namespace
}  // namespace nereid::element::assumed_strain_test
