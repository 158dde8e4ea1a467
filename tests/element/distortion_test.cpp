#include "element/distortion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "base/dual.hpp"
#include "tests/element/corners.hpp"

namespace nereid::element::distortion_test {
namespace {

constexpr double young = 3.0, density = 2.0;
constexpr Distortion usual;

/// A hexahedron that distortion control acts on.
struct OneElement {
  double start, volume, mass;
  explicit OneElement(const Corners& X)
      : start(start_of_control(X)), volume(volume_gradient(amplitudes(X)).volume), mass(density * volume) {}
  template <class T>
  Controlled<T> act(const std::array<Vector<T>, 8>& x, T& energy, std::array<Vector<T>, 8>& force) const {
    return control_distortion(usual, young, density, T(start), T(1 / mass), x, energy, force);
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
    const OneElement control(X);
    if (control.energy(x) > 0) return x;
  }
}

TEST(DistortionControl, ActsNowhereAboveItsStartAndNotAtAllThere) {
  const Corners X = brick(1.0, 0.8, 1.2);
  const OneElement control(X);
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
    const OneElement control(X);
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
    const OneElement control(X);
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
double frequency_squared(const OneElement& control, const Corners& x) {
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
    const OneElement control(X);
    double energy = 0;
    Corners force{};
    const double bound = control.act(x, energy, force).omega_squared, exact = frequency_squared(control, x);
    EXPECT_LE(exact, bound * (1 + 1e-9)) << i;
    nearest = std::max(nearest, exact / bound);
  }
  EXPECT_GT(nearest, 0.25);
}

TEST(DistortionControl, HasTheExactFrequencyOfAFlatElementThatBecomesUneven) {
  double last = 1;
  for (const double h : {0.1, 0.01, 0.001}) {
    const Corners X = brick(1, 1, h);
    const OneElement control(X);
    Corners x = X;
    for (const int c : {4, 6}) x[c].z -= 0.6001 * h;  // two corners that face each other have just closed to `start`
    double energy = 0;
    Corners force{};
    const double more = control.act(x, energy, force).omega_squared / frequency_squared(control, x) - 1;
    EXPECT_GE(more, 0);
    EXPECT_LT(more, 0.3 * last) << h;
    last = more;
  }
  EXPECT_LT(last, 5e-3);
}

TEST(DistortionControl, PushesBackTheHarderTheMoreACornerClosesAndAlsoWhereItInverted) {
  const Corners X = brick(1, 1, 1);
  const OneElement control(X);
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

TEST(DistortionControl, IsContinuousWhereACornerIsExactlyFlat) {
  const Corners X = brick(1, 1, 1);
  const OneElement control(X);
  const auto at = [&](double height) {
    Corners x = X;
    x[4] = X[0] + Point{0.3, 0.3, height};  // the volume of its edges is the height
    return x;
  };
  for (const double height : {1e-12, -1e-12}) {
    EXPECT_NEAR(control.energy(at(0)) / control.energy(at(height)), 1, 1e-9);
    EXPECT_NEAR(control.force(at(0))[4].z / control.force(at(height))[4].z, 1, 1e-9);
  }
}

TEST(DistortionControl, StoresWhatItsEnergyGrowsBy) {
  const Corners X = distorted(0.1);
  const OneElement control(X);
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
  const OneElement control(X);
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
  EXPECT_EQ(OneElement(dented).energy(dented), 0);
  Corners flat = X;
  for (Point& at : flat) at.z = 0;
  EXPECT_LT(start_of_control(flat), 0);
}

TEST(DistortionControl, OfAPackIsThatOfEachOfItsElements) {
  // lanes that act, that are near, that do nothing, that came from a closed state, and that have no control
  std::vector<Corners> X, x;
  for (int lane = 0; lane < lanes; ++lane) {
    Corners reference = brick(1, 1, 1);
    if (lane % 4 == 3) reference[4].z = -1;  // inverted: none
    Corners now = reference;
    if (lane % 4 == 0) now[4].z -= 0.7;
    if (lane % 4 == 1) now[4].z -= 0.59;
    X.push_back(reference), x.push_back(now);
  }
  std::array<Vector<Pack>, 8> xs, forces{};
  Pack start, per_mass, energy;
  const auto kept = [](int lane) { return lane % 4 == 2 ? 0.25 : 0.0; };
  for (int lane = 0; lane < lanes; ++lane) {
    const OneElement one(X[static_cast<std::size_t>(lane)]);
    start[lane] = one.start, per_mass[lane] = 1 / one.mass, energy[lane] = kept(lane);
    for (int c = 0; c < 8; ++c) {
      const Point& at = x[static_cast<std::size_t>(lane)][c];
      xs[c].x[lane] = at.x, xs[c].y[lane] = at.y, xs[c].z[lane] = at.z;
      forces[c].x[lane] = forces[c].y[lane] = forces[c].z[lane] = 0;
    }
  }
  const auto all = control_distortion(usual, young, density, start, per_mass, xs, energy, forces);
  for (int lane = 0; lane < lanes; ++lane) {
    double alone = kept(lane);
    Corners force{};
    const auto one = OneElement(X[static_cast<std::size_t>(lane)]).act(x[static_cast<std::size_t>(lane)], alone, force);
    EXPECT_EQ(all.stored[lane], one.stored);
    EXPECT_EQ(all.omega_squared[lane], one.omega_squared);
    EXPECT_EQ(energy[lane], alone);
    for (int c = 0; c < 8; ++c) EXPECT_EQ(forces[c].z[lane], force[c].z);
  }
}

TEST(DistortionControl, IsNoneWithoutStiffness) {
  Corners x = brick(1, 1, 1), force{};
  const OneElement one(x);
  x[4].z -= 0.9;
  double energy = 0;
  const auto off = control_distortion(Distortion{0}, young, density, one.start, 1 / one.mass, x, energy, force);
  EXPECT_EQ(off.stored, 0);
  EXPECT_EQ(off.omega_squared, 0);
  EXPECT_EQ(largest(force), 0);
}

}  // namespace
}  // namespace nereid::element::distortion_test
