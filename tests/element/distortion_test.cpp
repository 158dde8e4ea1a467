#include "element/distortion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "base/dual.hpp"
#include "tests/element/corners.hpp"

namespace nereid::element::distortion_test {
namespace {

constexpr double K = 3.0, density = 2.0;

/// A hexahedron that distortion control acts on.
struct Controlled1 {
  double start, volume, mass;
  explicit Controlled1(const Corners& X)
      : start(start_of_control(X)), volume(volume_gradient(amplitudes(X)).volume), mass(density * volume) {}
  template <class T>
  Controlled<T> act(const std::array<Vector<T>, 8>& x, T& energy, std::array<Vector<T>, 8>& force) const {
    return control_distortion(T(K), T(start), T(1 / volume), T(1 / mass), x, energy, force);
  }
  double energy(const Corners& x) const {
    double sum = 0;
    Corners force{};
    act(x, sum, force);
    return sum;
  }
  Corners force(const Corners& x) const {
    double sum = 0;
    Corners f{};
    act(x, sum, f);
    return f;
  }
};

/// Some corner closed to a part of `start`, the rest at random.
Corners closed(const Corners& X, double amount) {
  for (;;) {
    Corners x = sum(X, random_field(amount));
    const Controlled1 control(X);
    if (control.energy(x) > 0) return x;
  }
}

TEST(DistortionControl, ActsNowhereAboveItsStartAndNotAtAllThere) {
  const Corners X = brick(1.0, 0.8, 1.2);
  const Controlled1 control(X);
  EXPECT_NEAR(control.start, control_starts * control.volume, 1e-15);
  Corners x = X, force = random_field(1);
  const Corners before = force;
  for (const double part : {1.0, 0.5, 0.41}) {
    for (int c = 4; c < 8; ++c) x[c].z = X[0].z + part * 1.2;
    double energy = 0;
    const auto idle = control.act(x, energy, force);
    EXPECT_EQ(idle.stored, 0);
    EXPECT_EQ(energy, 0);
    EXPECT_EQ(idle.omega_squared > 0, part == 0.41) << "it is near, and the step counts it";
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(force[c][axis], before[c][axis]);
  }
  for (int c = 4; c < 8; ++c) x[c].z = X[0].z + 0.39 * 1.2;
  EXPECT_GT(control.energy(x), 0);
}

TEST(DistortionControl, ForcesAreMinusTheGradientOfItsEnergy) {
  using D = Dual<24>;
  for (int i = 0; i < 50; ++i) {
    const Corners X = distorted(0.1), x = closed(X, 0.5);
    const Controlled1 control(X);
    std::array<Vector<D>, 8> dual, force{};
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis) dual[c][axis] = D::variable(x[c][axis], 3 * c + axis);
    D energy(0.0);
    control.act(dual, energy, force);
    const Corners f = control.force(x);
    for (int c = 0; c < 8; ++c)
      for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(f[c][axis], -energy.by[static_cast<std::size_t>(3 * c + axis)], 1e-12 * largest(f));
  }
}

TEST(DistortionControl, ChangesNeitherMomentumNorMomentOfMomentumNorWithTheFrame) {
  for (int i = 0; i < 50; ++i) {
    const Corners X = distorted(0.1), x = closed(X, 0.5);
    const Controlled1 control(X);
    const Corners f = control.force(x);
    Point force{0, 0, 0}, moment{0, 0, 0};
    for (int c = 0; c < 8; ++c) force = force + f[c], moment = moment + cross(x[c], f[c]);
    EXPECT_LT(norm(force), 1e-13 * largest(f));
    EXPECT_LT(norm(moment), 1e-13 * largest(f));
    const Mat3 Q = random_rotation();
    EXPECT_NEAR(control.energy(times(Q, x)), control.energy(x), 1e-12 * control.energy(x));
    EXPECT_LT(largest(sum(control.force(times(Q, x)), times(Q, f), -1)), 1e-12 * largest(f));
  }
}

/// Largest squared frequency of the control alone, an eighth of the mass at each node.
double frequency_squared(const Controlled1& control, const Corners& x) {
  using D = Dual<24>;
  std::array<Vector<D>, 8> dual, force{};
  for (int c = 0; c < 8; ++c)
    for (int axis = 0; axis < 3; ++axis) dual[c][axis] = D::variable(x[c][axis], 3 * c + axis);
  D energy(0.0);
  control.act(dual, energy, force);
  Matrix24 stiffness(24, 24);
  for (int c = 0; c < 8; ++c)
    for (int axis = 0; axis < 3; ++axis)
      for (int j = 0; j < 24; ++j) stiffness(3 * c + axis, j) = -force[c][axis].by[static_cast<std::size_t>(j)];
  return 8 / control.mass * Eigen::SelfAdjointEigenSolver<Matrix24>(0.5 * (stiffness + stiffness.transpose())).eigenvalues().maxCoeff();
}

TEST(DistortionControl, RaisesTheBoundOnFrequenciesByNoLessThanItsOwn) {
  double nearest = 0;
  for (int i = 0; i < 300; ++i) {
    const bool thin = i % 2 == 1;
    const double h = random(0.02, 0.3);
    const Corners X = thin ? sum(brick(1, random(0.5, 2), h), random_field(0.1 * h)) : distorted(0.1), x = closed(X, thin ? h : 0.5);
    const Controlled1 control(X);
    double energy = 0;
    Corners force{};
    const double bound = control.act(x, energy, force).omega_squared, exact = frequency_squared(control, x);
    EXPECT_LE(exact, bound * (1 + 1e-9)) << i;
    nearest = std::max(nearest, exact / bound);
  }
  EXPECT_GT(nearest, 0.25);
}

TEST(DistortionControl, HasTheExactFrequencyOfAThinElementThatBecomesUneven) {
  const double h = 0.01;
  const Corners X = brick(1, 1, h);
  const Controlled1 control(X);
  Corners x = X;
  for (const int c : {4, 6}) x[c].z -= 0.6001 * h;  // the thickness of two corners that face each other: as good as no energy
  double energy = 0;
  Corners force{};
  EXPECT_NEAR(control.act(x, energy, force).omega_squared, frequency_squared(control, x), 0.05 * frequency_squared(control, x));
}

TEST(DistortionControl, PushesBackTheHarderTheMoreACornerClosesAndAlsoWhereItInverted) {
  const Corners X = brick(1, 1, 1);
  const Controlled1 control(X);
  double energy = 0, push = 0;
  for (double height = 0.399; height > -0.3; height -= 0.01) {
    Corners x = X;
    x[4].z = X[0].z + height;
    const double now = control.energy(x), pushed = control.force(x)[4].z;
    EXPECT_GT(now, energy);
    EXPECT_GT(pushed, push);
    energy = now, push = pushed;
  }
}

TEST(DistortionControl, StoresWhatItsEnergyGrowsBy) {
  const Corners X = distorted(0.1);
  const Controlled1 control(X);
  double energy = 0, sum = 0;
  Corners x = X, force{};
  const Corners to = closed(X, 0.5);
  for (int i = 0; i <= 20; ++i) {
    for (int c = 0; c < 8; ++c) x[c] = X[c] + std::sin(0.3 * i) * (to[c] - X[c]);
    sum += control.act(x, energy, force).stored;
    EXPECT_NEAR(sum, control.energy(x), 1e-12);
  }
}

TEST(DistortionControl, KnowsNoCornerOfACollapsedHexahedronThatHasNoVolume) {
  Corners X = brick(1, 1, 1);
  X[3] = X[0], X[7] = X[4];  // a wedge
  const Controlled1 control(X);
  EXPECT_NEAR(control.start, 0.4, 1e-12);
  EXPECT_EQ(control.energy(X), 0);
  Corners x = X;
  for (int c = 4; c < 8; ++c) x[c].z -= 0.7;
  EXPECT_GT(control.energy(x), 0);
  const Corners f = control.force(x);
  for (const Point& at : f) EXPECT_TRUE(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z));
  Corners inverted = brick(1, 1, 1);
  inverted[4].z = -1;
  EXPECT_LT(start_of_control(inverted), 0);
  Corners dented = brick(1, 1, 1);
  dented[6] = {0.5 * (dented[5].x + dented[7].x), 0.5 * (dented[5].y + dented[7].y), dented[6].z};  // its edges lie in a plane
  EXPECT_LT(start_of_control(dented), 0);
  EXPECT_EQ(Controlled1(dented).energy(dented), 0);
  Corners flat = X;
  for (Point& at : flat) at.z = 0;
  EXPECT_LT(start_of_control(flat), 0);
}

}  // namespace
}  // namespace nereid::element::distortion_test
