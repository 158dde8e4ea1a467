#include "base/tensor.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "base/dual.hpp"
#include "base/types.hpp"
#include "tests/base/chance.hpp"

namespace nereid::tensor_test {
namespace {

Chance chance(3);
double random() { return std::uniform_real_distribution<double>(-1.0, 1.0)(chance); }
Vector<double> random_vector() { return {random(), random(), random()}; }
Symmetric<double> random_symmetric() {
  return {random(), random(), random(), random(), random(), random()};
}

Vec3 full(const Vector<double>& a) { return {a.x, a.y, a.z}; }
Mat3 full(const Matrix<double>& a) {
  Mat3 m;
  m << a.x.x, a.x.y, a.x.z, a.y.x, a.y.y, a.y.z, a.z.x, a.z.y, a.z.z;
  return m;
}
Mat3 full(const Symmetric<double>& a) {
  Mat3 m;
  m << a.xx, a.xy, a.xz, a.xy, a.yy, a.yz, a.xz, a.yz, a.zz;
  return m;
}

TEST(Tensor, VectorsFollowTheRulesOfEigen) {
  const auto a = random_vector(), b = random_vector();
  EXPECT_LT((full(a + b) - (full(a) + full(b))).norm(), 1e-15);
  EXPECT_LT((full(a - b) - (full(a) - full(b))).norm(), 1e-15);
  EXPECT_LT((full(-a) + full(a)).norm(), 1e-15);
  EXPECT_LT((full(2.5 * a) - 2.5 * full(a)).norm(), 1e-15);
  EXPECT_LT((full(cross(a, b)) - full(a).cross(full(b))).norm(), 1e-15);
  EXPECT_NEAR(dot(a, b), full(a).dot(full(b)), 1e-15);
  EXPECT_NEAR(norm(a), full(a).norm(), 1e-15);
}

TEST(Tensor, IndicesCountAxesAndRows) {
  Vector<double> a{1, 2, 3};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a[i], i + 1);
  a[1] = 7;
  EXPECT_EQ(a.y, 7);
  const Matrix<double> m{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  EXPECT_EQ(m[1][2], 6);
}

TEST(Tensor, SymmetricTensorsFollowTheRulesOfEigen) {
  const auto a = random_symmetric(), b = random_symmetric();
  const auto v = random_vector();
  EXPECT_LT((full(a + b) - (full(a) + full(b))).norm(), 1e-15);
  EXPECT_LT((full(a - b) - (full(a) - full(b))).norm(), 1e-15);
  EXPECT_LT((full(2.5 * a) - 2.5 * full(a)).norm(), 1e-15);
  EXPECT_LT((full(a * v) - full(a) * full(v)).norm(), 1e-15);
  EXPECT_NEAR(trace(a), full(a).trace(), 1e-15);
  EXPECT_NEAR(contract(a, b), (full(a) * full(b)).trace(), 1e-14);
}

TEST(Tensor, PlaneTensorsAreSymmetricOnesWithoutTheThirdAxis) {
  const Plane<double> a{0.3, -0.7, 0.2}, b{1.1, 0.4, -0.5};
  EXPECT_DOUBLE_EQ(contract(a, b), contract(Symmetric<double>{0.3, -0.7, 0, 0.2, 0, 0},
                                            Symmetric<double>{1.1, 0.4, 0, -0.5, 0, 0}));
  const Plane<double> c = a + 2.0 * b - a;
  EXPECT_NEAR(c.xx, 2.2, 1e-15);
  EXPECT_NEAR(c.yy, 0.8, 1e-15);
  EXPECT_NEAR(c.xy, -1.0, 1e-15);
}

TEST(CayleyRotation, IsOrthogonal) {
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 Q = full(cayley_rotation(3.0 * random_vector()));
    EXPECT_LT((Q * Q.transpose() - Mat3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(Q.determinant(), 1.0, 1e-14);
  }
}

TEST(CayleyRotation, RecoversARotationFromTwiceTheTangentOfHalfItsAngle) {
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 axis = full(random_vector()).normalized();
    const double angle = 2.5 * random();
    const Vec3 w = 2 * std::tan(angle / 2) * axis;
    const Mat3 Q = full(cayley_rotation(Vector<double>{w.x(), w.y(), w.z()}));
    EXPECT_LT((Q - Eigen::AngleAxisd(angle, axis).toRotationMatrix()).norm(), 1e-14);
  }
}

TEST(CayleyRotation, RecoversARigidRotationFromTheGradientInTheMiddle) {
  // of x -> Q x: gradient of the increment by (x + Q x)/2 is (Q - 1) ((Q + 1)/2)^-1
  const Mat3 Q = Eigen::AngleAxisd(1.3, Vec3(0.2, -0.5, 0.7).normalized()).toRotationMatrix();
  const Mat3 L = (Q - Mat3::Identity()) * (0.5 * (Q + Mat3::Identity())).inverse();
  EXPECT_LT((L + L.transpose()).norm(), 1e-14);
  const Vector<double> w{0.5 * (L(2, 1) - L(1, 2)), 0.5 * (L(0, 2) - L(2, 0)),
                         0.5 * (L(1, 0) - L(0, 1))};
  EXPECT_LT((full(cayley_rotation(w)) - Q).norm(), 1e-14);
}

TEST(Rotate, IsTheProductFromBothSides) {
  for (int trial = 0; trial < 20; ++trial) {
    const auto Q = cayley_rotation(random_vector());
    const auto a = random_symmetric();
    EXPECT_LT((full(rotate(Q, a)) - full(Q) * full(a) * full(Q).transpose()).norm(), 1e-14);
    EXPECT_NEAR(contract(rotate(Q, a), rotate(Q, a)), contract(a, a), 1e-14);
  }
}

TEST(Tensor, RunsOnDualNumbersAndPacks) {
  const Vector<Dual<1>> a{Dual<1>::variable(3.0, 0), 0.0, 4.0};
  EXPECT_DOUBLE_EQ(norm(a).value, 5.0);
  EXPECT_DOUBLE_EQ(norm(a).by[0], 0.6);
  const Vector<Pack> b{Pack(3.0), Pack(0.0), Pack(4.0)};
  EXPECT_EQ(norm(b)[lanes - 1], 5.0);
  EXPECT_NEAR(cayley_rotation(b).x.x[0], cayley_rotation(Vector<double>{3.0, 0.0, 4.0}).x.x, 1e-15);
}

}  // namespace
}  // namespace nereid::tensor_test
