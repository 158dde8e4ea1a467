#include "material/neo_hookean.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "base/dual.hpp"
#include "base/types.hpp"
#include "tests/base/chance.hpp"
#include "tests/material/carried.hpp"

namespace nereid::material::neo_hookean_test {
namespace {

const NeoHookean rubber{1000.0, 1.0e9, 0.3};

Chance chance(5);
double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(chance); }
Mat3 random_gradient(double size) {
  Mat3 F = Mat3::Identity();
  for (int i = 0; i < 9; ++i) F(i / 3, i % 3) += random(-size, size);
  return F;
}

double potential(const Mat3& F, const NeoHookean& law = rubber) {
  const auto [lambda, mu] = lame(law);
  const double log_J = std::log(F.determinant());
  return 0.5 * mu * ((F * F.transpose()).trace() - 3 - 2 * log_J) + 0.5 * lambda * log_J * log_J;
}
Mat3 stress_of(const Mat3& F) {
  const auto [lambda, mu] = lame(rubber);
  const double J = F.determinant();
  return (mu * (F * F.transpose() - Mat3::Identity()) + lambda * std::log(J) * Mat3::Identity()) / J;
}

TEST(NeoHookean, HasTheStressOfItsPotentialOnAnyPath) {
  for (int i = 0; i < 20; ++i) {
    const Mat3 to = random_gradient(0.4);
    if (!(to.determinant() > 0.2)) continue;
    double error[2];
    for (const int n : {0, 1}) {
      Carried<NeoHookean> point{rubber};
      carry(point, to, 200 << n);
      error[n] = (full(point.stress) - stress_of(to)).norm() / stress_of(to).norm();
    }
    EXPECT_LT(error[1], 1e-5);
    EXPECT_LT(error[1], 0.3 * error[0] + 1e-9) << "of second order";
  }
}

TEST(NeoHookean, HasTheClosedFormsOfShearAndStretch) {
  const auto [lambda, mu] = lame(rubber);
  Carried<NeoHookean> sheared{rubber}, pressed{rubber};
  Mat3 shear = Mat3::Identity(), press = Mat3::Identity();
  shear(0, 1) = 1.5, press(2, 2) = 0.4;
  carry(sheared, shear, 1000), carry(pressed, press, 1000);
  EXPECT_NEAR(sheared.stress.xy, 1.5 * mu, 1e-5 * mu);
  EXPECT_NEAR(sheared.stress.xx, 2.25 * mu, 1e-5 * mu);
  EXPECT_NEAR(sheared.stress.yy, 0, 1e-5 * mu);
  EXPECT_NEAR(pressed.stress.zz, (mu * (0.16 - 1) + lambda * std::log(0.4)) / 0.4, 1e-5 * mu);
  EXPECT_NEAR(pressed.stress.xx, lambda * std::log(0.4) / 0.4, 1e-5 * mu);
}

TEST(NeoHookean, HasTheStretchOfAStepHoweverLongItIs) {
  for (const double e : {-1.6, -0.5, 0.5, 1.2}) {
    Symmetric<double> stress{};
    auto internal = fresh<NeoHookean>(stress);
    update_stress(rubber, Increment<double, Symmetric>{{0, 0, e, 0, 0, 0}, 1, 1}, stress, internal);
    const double stretch = (1 + 0.5 * e) / (1 - 0.5 * e);
    const Mat3 exact = stress_of(Vec3(1, 1, stretch).asDiagonal());
    EXPECT_LT((full(stress) - exact).norm(), 1e-12 * exact.norm()) << e;
  }
}

TEST(NeoHookean, GivesBackAllWorkOfACycleThatCloses) {
  for (int i = 0; i < 10; ++i) {
    const Mat3 one = random_gradient(0.3), other = random_gradient(0.3);
    double left[2], most = 0;
    for (const int n : {0, 1}) {
      Carried<NeoHookean> point{rubber};
      for (const Mat3& to : {one, other, Mat3(Mat3::Identity())}) carry(point, to, 100 << n), most = std::max(most, point.stored);
      left[n] = std::abs(point.stored) / most;
      EXPECT_LT(largest(point.stress), 1e-3 * rubber.young);
    }
    EXPECT_LT(left[1], 1e-4);
    EXPECT_LT(left[1], 0.3 * left[0] + 1e-8) << "of second order";
  }
}

TEST(NeoHookean, StoresItsPotential) {
  for (int i = 0; i < 10; ++i) {
    const Mat3 to = random_gradient(0.3);
    Carried<NeoHookean> point{rubber};
    carry(point, to, 400);
    EXPECT_NEAR(point.stored, potential(to), 1e-4 * potential(to));
  }
}

TEST(NeoHookean, IsHookesLawAtSmallStrains) {
  const Symmetric<double> strain{3e-7, -2e-7, 1e-7, 2e-7, -1e-7, 3e-7};
  Symmetric<double> stress{};
  auto internal = fresh<NeoHookean>(stress);
  const auto response = update_stress(rubber, Increment<double, Symmetric>{strain, 1, 1}, stress, internal);
  EXPECT_LT(largest(stress - hooke(rubber, strain)), 2e-6 * largest(stress));
  EXPECT_NEAR(response.moduli.lambda, lame(rubber).lambda, 1e-5 * rubber.young);
  EXPECT_NEAR(response.moduli.mu, lame(rubber).mu, 1e-5 * rubber.young);
}

TEST(NeoHookean, TangentIsThatOfDifferences) {
  using D = Dual<6>;
  for (int i = 0; i < 20; ++i) {
    Carried<NeoHookean> point{rubber};
    carry(point, random_gradient(0.3), 50);
    Symmetric<D> stress{point.stress.xx, point.stress.yy, point.stress.zz, point.stress.xy, point.stress.yz, point.stress.xz}, strain{};
    const auto parts = components(strain);
    for (int k = 0; k < 6; ++k) *parts[static_cast<std::size_t>(k)] = D::variable(random(-0.01, 0.01), k);
    auto memory = as_dual<6>(point.internal);
    update_stress(rubber, Increment<D, Symmetric>{strain, D(1.0), D(1.0)}, stress, memory);
    for (int k = 0; k < 6; ++k) {
      Symmetric<double> sides[2];
      for (const int side : {0, 1}) {
        Symmetric<double> e{strain.xx.value, strain.yy.value, strain.zz.value, strain.xy.value, strain.yz.value, strain.xz.value};
        *components(e)[static_cast<std::size_t>(k)] += (side == 0 ? -1 : 1) * 1e-6;
        auto again = point.internal;
        sides[side] = point.stress;
        update_stress(rubber, Increment<double, Symmetric>{e, 1, 1}, sides[side], again);
      }
      Symmetric<double> slope = 0.5e6 * (sides[1] - sides[0]);
      for (int c = 0; c < 6; ++c)
        EXPECT_NEAR(components(stress)[static_cast<std::size_t>(c)]->by[static_cast<std::size_t>(k)],
                    *components(slope)[static_cast<std::size_t>(c)], 1e-6 * rubber.young);
    }
  }
}

TEST(NeoHookean, ModuliBoundItsTangent) {
  double nearest = 0;
  for (int i = 0; i < 600; ++i) {
    const NeoHookean law{1000, 1e9, random(-0.4, 0.48)};
    const Mat3 F = random_gradient(0.5) * random(0.7, 1.4), draw = random_gradient(1) - Mat3::Identity();
    const Mat3 H = i % 3 == 0 ? Mat3(draw - draw.transpose()) : draw;  // a spin, too
    if (!(F.determinant() > 0.1)) continue;
    Carried<NeoHookean> point{law};
    carry(point, F, 400);
    Symmetric<double> stress = point.stress;
    auto internal = point.internal;
    const auto moduli = update_stress(law, Increment<double, Symmetric>{{}, 1, 1}, stress, internal).moduli;
    const double h = 1e-4;
    const auto along = [&](double s) { return potential((Mat3::Identity() + s * H) * F, law); };
    const double second = (along(h) + along(-h) - 2 * along(0)) / (h * h) / F.determinant();
    const double bound = std::max(0.0, moduli.lambda) * H.trace() * H.trace() + 2 * moduli.mu * H.squaredNorm();
    EXPECT_LE(second, bound * (1 + 1e-3)) << law.poisson << " " << F.determinant();
    nearest = std::max(nearest, second / bound);
  }
  EXPECT_GT(nearest, 0.7);
}

TEST(NeoHookean, OfAPackIsThatOfEachOfItsLanes) {
  Symmetric<Pack> stress{}, strain{};
  Internal<Pack, NeoHookean, Symmetric> memory{};
  std::vector<Carried<NeoHookean>> points;
  std::vector<Symmetric<double>> strains;
  const auto put = [](const Symmetric<double>& from, int lane, Symmetric<Pack>& to) {
    to.xx[lane] = from.xx, to.yy[lane] = from.yy, to.zz[lane] = from.zz;
    to.xy[lane] = from.xy, to.yz[lane] = from.yz, to.xz[lane] = from.xz;
  };
  for (int lane = 0; lane < lanes; ++lane) {
    points.push_back({rubber});
    carry(points.back(), random_gradient(0.3), 20);
    strains.push_back({random(-0.01, 0.01), random(-0.01, 0.01), random(-0.01, 0.01), random(-0.01, 0.01), 0, 0});
    put(points.back().stress, lane, stress), put(points.back().internal.tensor[0], lane, memory.tensor[0]);
    put(strains.back(), lane, strain);
  }
  const auto all = update_stress(rubber, Increment<Pack, Symmetric>{strain, Pack(1.0), Pack(1.0)}, stress, memory);
  for (int lane = 0; lane < lanes; ++lane) {
    auto& point = points[static_cast<std::size_t>(lane)];
    const auto one = update_stress(rubber, Increment<double, Symmetric>{strains[static_cast<std::size_t>(lane)], 1, 1}, point.stress,
                                   point.internal);
    EXPECT_NEAR(stress.xx[lane], point.stress.xx, 1e-13 * largest(point.stress));
    EXPECT_NEAR(stress.xy[lane], point.stress.xy, 1e-13 * largest(point.stress));
    EXPECT_NEAR(all.work.stored[lane], one.work.stored, 1e-13 * std::abs(one.work.stored));
    EXPECT_NEAR(all.moduli.mu[lane], one.moduli.mu, 1e-13 * one.moduli.mu);
  }
}

TEST(NeoHookean, TurnsWithItsFrame) {
  const Mat3 F = random_gradient(0.3);
  const Mat3 Q = Eigen::AngleAxisd(1.1, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Carried<NeoHookean> one{rubber}, other{rubber};
  carry(one, F, 300), carry(other, Q * F * Q.transpose(), 300);
  EXPECT_LT((Q * full(one.stress) * Q.transpose() - full(other.stress)).norm(), 1e-10 * full(one.stress).norm());
  carry(one, Q * F, 300);  // then a rotation
  EXPECT_LT((full(one.stress) - Q * stress_of(F) * Q.transpose()).norm(), 1e-4 * full(one.stress).norm());
}

}  // namespace
}  // namespace nereid::material::neo_hookean_test
