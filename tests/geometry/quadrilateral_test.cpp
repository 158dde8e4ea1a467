#include "geometry/quadrilateral.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace nereid::geometry {
namespace {

Vec3 point_of(const std::array<Vec3, 4>& corner, const std::array<double, 4>& weight) {
  return weight[0] * corner[0] + weight[1] * corner[1] + weight[2] * corner[2] + weight[3] * corner[3];
}

TEST(Quadrilateral, WeightsLeadToThePointUnderAnApexAlongTheNormal) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(0, 1);
  for (int round = 0; round < 1000; ++round) {
    const auto random = [&] { return number(engine) - 0.5; };
    const auto off = [&](double size) { return Vec3(size * random(), size * random(), size * random()); };
    std::array<Vec3, 4> corner{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(0, 1, 0)};
    for (Vec3& at : corner) at += off(0.4);
    const double a = number(engine), b = number(engine), height = number(engine) - 0.5;
    const std::array<double, 4> wanted{(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b};
    const Vec3 n = (Vec3::UnitZ() + off(0.2)).normalized(), p = point_of(corner, wanted) + height * n;
    std::array<double, 4> weight;
    ASSERT_TRUE(bilinear_weights(corner, p, n, 0.5, 0.5, weight)) << round;
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(weight[i], wanted[i], 1e-13) << round;
  }
}

TEST(Quadrilateral, FarFromTheOriginThereAreWeightsAsWell) {
  const Vec3 far(1e6 / 3, -1e6 / 7, 1e5 / 9);
  std::array<Vec3, 4> corner{Vec3(0, 0, 0), Vec3(2, 0, 0.1), Vec3(2.2, 1, 0), Vec3(0, 1, 0)};
  for (Vec3& at : corner) at += far;
  std::array<double, 4> weight;
  for (double a = 0; a <= 1; a += 0.05)
    for (double b = 0; b <= 1; b += 0.05) {
      const Vec3 p = point_of(corner, {(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b}) + 0.1 * Vec3::UnitZ();
      ASSERT_TRUE(bilinear_weights(corner, p, Vec3::UnitZ(), 0.5, 0.5, weight)) << a << ' ' << b;
      EXPECT_NEAR(weight[2], a * b, 1e-9);
    }
}

TEST(Quadrilateral, ThereAreNoWeightsFarBesideAFaceOrAlongIt) {
  const std::array<Vec3, 4> square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  std::array<double, 4> weight;
  EXPECT_TRUE(bilinear_weights(square, Vec3(1.2, 0.5, 1), Vec3::UnitZ(), 0.5, 0.5, weight));
  EXPECT_FALSE(bilinear_weights(square, Vec3(1.4, 0.5, 1), Vec3::UnitZ(), 0.5, 0.5, weight));
  EXPECT_FALSE(bilinear_weights(square, Vec3(0.5, 0.5, 1), Vec3::UnitX(), 0.5, 0.5, weight));
  EXPECT_FALSE(bilinear_weights(square, Vec3(std::nan(""), 0.5, 1), Vec3::UnitZ(), 0.5, 0.5, weight));
}

}  // namespace
}  // namespace nereid::geometry
