#include "geometry/quadrilateral.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace nereid::geometry::quadrilateral_test {
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

Vector<double> place(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vec3 eigen(const Vector<double>& p) { return {p.x, p.y, p.z}; }
std::array<Vector<double>, 4> places(const std::array<Vec3, 4>& p) { return {place(p[0]), place(p[1]), place(p[2]), place(p[3])}; }

/// A face that is warped and skewed, and a point over it.
struct Warped {
  std::array<Vec3, 4> corner{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(0, 1, 0)};
  double a, b, height;
  Vec3 normal, p;
  explicit Warped(std::mt19937& engine) {
    std::uniform_real_distribution<double> number(0, 1);
    const auto random = [&] { return number(engine) - 0.5; };
    for (Vec3& at : corner) at += 0.4 * Vec3(random(), random(), random());
    a = number(engine), b = number(engine), height = 0.5 * random();
    const Vec3 by_a = (1 - b) * (corner[1] - corner[0]) + b * (corner[2] - corner[3]);
    const Vec3 by_b = (1 - a) * (corner[3] - corner[0]) + a * (corner[2] - corner[1]);
    normal = by_a.cross(by_b).normalized();
    p = point_of(corner, weights_at(a, b)) + height * normal;
  }
};

TEST(Quadrilateral, TheClosestPointIsWhereTheWayIsAlongTheNormal) {
  std::mt19937 engine(8);
  for (int round = 0; round < 1000; ++round) {
    const Warped face(engine);
    OnQuadrilateral<double> at{.a = 0.5, .b = 0.5, .by_a = {}, .by_b = {}, .way = {}};
    ASSERT_TRUE(closest_on_quadrilateral(places(face.corner), place(face.p), at)) << round;
    EXPECT_NEAR(at.a, face.a, 1e-12) << round;
    EXPECT_NEAR(at.b, face.b, 1e-12) << round;
    EXPECT_LT((eigen(at.way) - face.height * face.normal).norm(), 1e-13) << round;
    EXPECT_LT(eigen(cross(at.by_a, at.by_b)).normalized().cross(face.normal).norm(), 1e-12) << round;
  }
}

TEST(Quadrilateral, AllLanesOfAPackHaveClosestPointsOfTheirOwn) {
  std::mt19937 engine(10);
  for (int round = 0; round < 100; ++round) {
    std::vector<Warped> faces;
    for (int lane = 0; lane < lanes; ++lane) faces.emplace_back(engine);
    faces[round % lanes].p.x() += 5;  // far beside its face
    const auto row = [&](auto&& number) { return Pack([&](auto lane) { return number(faces[static_cast<std::size_t>(lane)]); }); };
    std::array<Vector<Pack>, 4> corner;
    Vector<Pack> p;
    for (int axis = 0; axis < 3; ++axis) {
      for (int I = 0; I < 4; ++I) corner[I][axis] = row([&](const Warped& face) { return face.corner[I][axis]; });
      p[axis] = row([&](const Warped& face) { return face.p[axis]; });
    }
    OnQuadrilateral<Pack> all;
    all.a = all.b = Pack(0.5);
    const auto found = closest_on_quadrilateral(corner, p, all);
    for (int lane = 0; lane < lanes; ++lane) {
      EXPECT_EQ(found[lane], lane != round % lanes) << round;
      if (!found[lane]) continue;
      EXPECT_NEAR(all.a[lane], faces[lane].a, 1e-12) << round;
      EXPECT_NEAR(all.b[lane], faces[lane].b, 1e-12) << round;
      EXPECT_NEAR(all.way.x[lane], faces[lane].height * faces[lane].normal.x(), 1e-13) << round;
    }
  }
}

TEST(Quadrilateral, TheHeightOverItChangesByItsNormalAndWeights) {
  std::mt19937 engine(9);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto height = [](const std::array<Vec3, 4>& corner, const Vec3& p, const Warped& face) {
    OnQuadrilateral<double> at{.a = face.a, .b = face.b, .by_a = {}, .by_b = {}, .way = {}};
    EXPECT_TRUE(closest_on_quadrilateral(places(corner), place(p), at));
    return eigen(cross(at.by_a, at.by_b)).normalized().dot(eigen(at.way));
  };
  for (int round = 0; round < 100; ++round) {
    const Warped face(engine);
    const auto any = [&] { return Vec3(number(engine), number(engine), number(engine)); };
    const std::array<Vec3, 4> turn{any(), any(), any(), any()};
    const Vec3 way = any();
    double rate = face.normal.dot(way);
    const auto weight = weights_at(face.a, face.b);
    for (int I = 0; I < 4; ++I) rate -= weight[I] * face.normal.dot(turn[I]);
    constexpr double h = 1e-6;
    const auto moved = [&](double by) {
      std::array<Vec3, 4> corner = face.corner;
      for (int I = 0; I < 4; ++I) corner[I] += by * turn[I];
      return height(corner, face.p + by * way, face);
    };
    EXPECT_NEAR((moved(h) - moved(-h)) / (2 * h), rate, 1e-8) << round;
  }
}

TEST(Quadrilateral, ThereIsNoClosestPointFarBesideAFace) {
  const std::array<Vec3, 4> square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
  for (const double x : {-0.4, 1.4, std::nan("")}) {
    OnQuadrilateral<double> at{.a = 0.5, .b = 0.5, .by_a = {}, .by_b = {}, .way = {}};
    EXPECT_FALSE(closest_on_quadrilateral(places(square), {x, 0.5, 1}, at)) << x;
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
}  // namespace nereid::geometry::quadrilateral_test
