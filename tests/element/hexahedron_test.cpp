#include "element/hexahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/dual.hpp"
#include "tests/element/solids.hpp"

namespace nereid::element::hexahedron_test {
namespace {

template <class Law>
using Element = OneElement<Hexahedron, Law>;

// ------------------------------------------------------------------------------------------------
// Modes, volume and gradient

TEST(Hexahedron, SumsByModeAndNodalValuesAreTransposes) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners a = random_field(1.0);
    Modes<double> m{random_point(1), random_point(1), random_point(1), {}};
    for (auto& h : m.hourglass) h = random_point(1);
    const Modes<double> s = sums_by_mode(a);
    double by_mode = dot(s.xi, m.xi) + dot(s.eta, m.eta) + dot(s.zeta, m.zeta);
    for (int h = 0; h < 4; ++h) by_mode += dot(s.hourglass[h], m.hourglass[h]);
    EXPECT_NEAR(product(a, nodal_values(m)), by_mode, 1e-13);
  }
}

TEST(Hexahedron, ModesAreOrthogonal) {
  Modes<double> m{random_point(1), random_point(1), random_point(1), {}};
  for (auto& h : m.hourglass) h = random_point(1);
  const Modes<double> back = sums_by_mode(nodal_values(m));
  EXPECT_NEAR(norm(back.xi - 8.0 * m.xi), 0, 1e-14);
  EXPECT_NEAR(norm(back.eta - 8.0 * m.eta), 0, 1e-14);
  EXPECT_NEAR(norm(back.zeta - 8.0 * m.zeta), 0, 1e-14);
  for (int h = 0; h < 4; ++h) EXPECT_NEAR(norm(back.hourglass[h] - 8.0 * m.hourglass[h]), 0, 1e-14);
}

TEST(Hexahedron, VolumeIsThatOfTheTrilinearShape) {
  for (int trial = 0; trial < 100; ++trial) {
    const Corners x = distorted(0.4);
    double exact = 0;
    integrate(x, [&](const auto&, double det) { exact += det; });
    EXPECT_NEAR(volume_gradient(amplitudes(x)).volume, exact, 1e-14 * 10);
  }
}

TEST(Hexahedron, GradientMatchesDualNumbers) {
  using D = Dual<24>;
  for (int trial = 0; trial < 20; ++trial) {
    const Corners x = distorted(0.4);
    std::array<Vector<D>, 8> variable;
    for (int i = 0; i < 24; ++i)
      variable[i / 3][i % 3] = D(0.125) * D::variable(x[i / 3][i % 3], i);
    const D volume = volume_gradient(sums_by_mode(variable)).volume;
    const auto g = volume_gradient(amplitudes(x));
    const Corners by_node = nodal_values(Modes<double>{
        g.xi, g.eta, g.zeta, {g.hourglass[0], g.hourglass[1], g.hourglass[2], Point{}}});
    for (int i = 0; i < 24; ++i) EXPECT_NEAR(by_node[i / 3][i % 3], volume.by[i], 1e-14);
  }
}

TEST(Hexahedron, GradientMatchesDifferences) {
  const Corners x = distorted(0.4), direction = random_field(1.0);
  const double h = 1e-4;
  const auto g = volume_gradient(amplitudes(x));
  const Corners by_node = nodal_values(Modes<double>{
      g.xi, g.eta, g.zeta, {g.hourglass[0], g.hourglass[1], g.hourglass[2], Point{}}});
  const double difference = volume_gradient(amplitudes(sum(x, direction, h))).volume -
                            volume_gradient(amplitudes(sum(x, direction, -h))).volume;
  EXPECT_NEAR(product(by_node, direction), difference / (2 * h), 1e-7);
}

TEST(Hexahedron, MeanGradientIsTheMeanOfTheTrilinearField) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners x = distorted(0.3), u = random_field(1.0);
    Mat3 exact = Mat3::Zero();
    double volume = 0;
    integrate(x, [&](const auto& gradients, double det) {
      volume += det;
      for (int i = 0; i < 8; ++i)
        exact += det * Vec3(u[i].x, u[i].y, u[i].z) * gradients.col(i).transpose();
    });
    exact /= volume;
    const Matrix<double> L = mean_gradient(amplitudes(u), volume_gradient(amplitudes(x)));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(L[i][j], exact(i, j), 1e-13);
  }
}

TEST(Hexahedron, LargestEigenvalueBoundIsNeverBelowAndExactIfTheSmallerOnesAreEqual) {
  for (int trial = 0; trial < 200; ++trial) {
    const Mat3 A = Mat3::Random(), Q = random_rotation();
    const Mat3 G = A * A.transpose();
    const double exact = eigenvalues(G).maxCoeff();
    EXPECT_GE(largest_eigenvalue_bound(symmetric(G)), exact * (1 - 1e-14));
    EXPECT_NEAR(largest_eigenvalue_bound(symmetric(Q * G * Q.transpose())),
                largest_eigenvalue_bound(symmetric(G)), 1e-13);
    const Mat3 two_equal = Q * Vec3(0.3, 2.0, 0.3).asDiagonal() * Q.transpose();
    EXPECT_NEAR(largest_eigenvalue_bound(symmetric(two_equal)), 2.0, 1e-14);
  }
}

// ------------------------------------------------------------------------------------------------
// Motions, over all laws

using OnePoint = WithEachLaw<Hexahedron, Laws>::type;
INSTANTIATE_TYPED_TEST_SUITE_P(OfOnePoint, EverySolid, OnePoint);
using ByAssumedStrain = WithEachLaw<AssumedStrain, Laws>::type;
INSTANTIATE_TYPED_TEST_SUITE_P(OfAssumedStrain, EverySolid, ByAssumedStrain);

template <class Law>
class HexahedronOf : public ::testing::Test {};
TYPED_TEST_SUITE(HexahedronOf, Laws);

TEST(HexahedronThatHardens, CarriesItsBackStressAlongThroughTenTurnsAndAnswersTheNextLoadAsIfItHadNotTurned) {
  Element<J2Mixed> e{metal<J2Mixed>(), {}, distorted(0.2)};
  Corners stretch{};  // yield strain is 1 %: 6 % out and, after the turns, 5 % back
  for (int i = 0; i < 8; ++i) stretch[i].x = e.X[i].x;
  EXPECT_GT(e.move(sum(e.X, sum(random_field(0.005), stretch, 0.06)))[Dissipated::plastic], 0);
  for (int step = 0; step < 100; ++step) e.move(e.x);  // at yield it keeps no moment along the flow
  const auto start = e.memory;
  const Corners at_start = e.x, load = sum(random_field(0.005), stretch, -0.05);
  const double size = full(start.internal.tensor[0]).norm();
  EXPECT_GT(size, 0.1 * e.law.yield);
  Element<J2Mixed> still = e;
  const Vec3 axis = Vec3(0.3, -0.5, 0.8).normalized();
  Mat3 R;
  double plastic = 0;
  for (int step = 1; step <= 1017; ++step) {  // ten turns and a bit
    R = Eigen::AngleAxisd(2 * pi * step / 100, axis).toRotationMatrix();
    plastic += e.move(times(R, at_start))[Dissipated::plastic];
  }
  const double drift = (full(e.memory.internal.tensor[0]) - R * full(start.internal.tensor[0]) * R.transpose()).norm() / size;
  ::testing::Test::RecordProperty("drift_of_back_stress", std::to_string(drift * 1e12) + "e-12");
  EXPECT_LT(drift, 1e-9);  // that of the stress
  EXPECT_LT(plastic, 1e-12 * e.law.yield);  // round-off of a stress on the surface
  const auto report = e.step(times(R, sum(at_start, load)), times(R, load), 1.0),
                       expected = still.step(sum(at_start, load), load, 1.0);
  EXPECT_GT(expected[Dissipated::plastic], 0);
  EXPECT_NEAR(report[Dissipated::plastic], expected[Dissipated::plastic], 1e-9 * expected[Dissipated::plastic]);
  EXPECT_LT(largest(sum(e.force, times(R, still.force), -1.0)), 1e-9 * largest(still.force));
}

// ------------------------------------------------------------------------------------------------
// Hourglass modes, patch test, large shear

TEST(Hexahedron, HourglassModesStoreEnergyInTheHourglassAccountOnly) {
  for (int mode = 0; mode < 12; ++mode) {
    Element<Elastic> e{metal<Elastic>(), usual_of(Hexahedron{}), brick(1.0, 0.7, 1.6)};
    Modes<double> m{};
    m.hourglass[mode / 3][mode % 3] = 1e-2;
    const auto report = e.move(sum(e.X, nodal_values(m)));
    EXPECT_NEAR(report.stored[0], 0, 1e-30);
    EXPECT_NEAR(full(e.memory.stress).norm(), 0, 1e-17);
    // k/2 (gamma . u)^2 with gamma . u = 8 amplitude
    EXPECT_NEAR(report.stored[1], 0.5 * e.constants.hourglass * 64 * 1e-4, 1e-16);
  }
}

TEST(Hexahedron, HourglassFieldsOfADistortedElementAreBlindToAffineFields) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<Elastic> e{metal<Elastic>(), {}, distorted(0.3)};
    const Mat3 F = Mat3::Identity() + 0.1 * Mat3::Random();
    const auto report = e.move(times(F, e.X));
    for (const Point& q : e.memory.hourglass) EXPECT_LT(norm(q), 1e-16);
    EXPECT_LT(report.stored[1], 1e-30);
  }
}

TEST(Hexahedron, HourglassStiffnessOneIsTheExactBendingStiffnessOfACubeWithoutPoissonEffect) {
  Element<Elastic> e{
      metal<Elastic>(0.0), {.hourglass = 1.0, .viscosity = no_viscosity, .hourglass_kind = springs}, brick(1, 1, 1)};
  // u_x = a xi eta: strain du_x/dx = 2 a eta of the trilinear field; energy mu times its square
  const double a = 1e-3, h = 1.0, mu = material::shear_modulus(e.law);
  Modes<double> m{};
  m.hourglass[2].x = a;
  const auto report = e.move(sum(e.X, nodal_values(m)));
  const double stretch = mu * 4 * a * a / 3 * h;  // of (2 a eta / h)^2, mean of eta^2 = 1/3
  EXPECT_NEAR(report.stored[1], stretch, 1e-10 * stretch);
}

TEST(Hexahedron, PatchOfSevenDistortedElementsHasConstantStress) {
  const SevenElements patch = seven_elements();
  for (const double size : {1e-3, 0.2}) {
    const Mat3 F = Mat3::Identity() +
                   size * (Mat3() << 0.9, -0.3, 0.2, 0.4, -0.7, 0.1, -0.5, 0.6, 0.3).finished();
    std::array<Point, 16> force{};
    Mat3 stress;
    double volume = 0, largest_force = 0;
    for (std::size_t n = 0; n < patch.nodes.size(); ++n) {
      const Corners corners = patch.corners(n);
      Element<Elastic> e{metal<Elastic>(), {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = springs}, corners};
      EXPECT_GT(e.constants.mass, 0);
      volume += e.constants.mass / e.law.density;
      e.move(times(F, corners));
      if (n == 0) stress = full(e.memory.stress);
      EXPECT_LT((full(e.memory.stress) - stress).norm(), 1e-12 * stress.norm());
      for (int i = 0; i < 8; ++i) force[patch.nodes[n][i]] = force[patch.nodes[n][i]] + e.force[i];
      largest_force = std::max(largest_force, largest(e.force));
    }
    EXPECT_NEAR(volume, 1.0, 1e-14);
    for (int i = 0; i < 8; ++i) EXPECT_LT(norm(force[i]), 1e-12 * largest_force);
  }
}

TEST(Hexahedron, LargeSimpleShearFollowsTheRateOfJaumannWhereALawMayFlow) {
  Element<J2Bilinear> e{{2.0, 3.0, 0.3, {1e9, 0}}, {}, brick(1, 1, 1)};
  const double mu = material::shear_modulus(e.law), increment = 1e-3;
  for (int step = 1; step <= 4000; ++step) {
    Mat3 F = Mat3::Identity();
    const double gamma = F(0, 1) = increment * step;
    e.move(times(F, e.X));
    if (step % 1000 == 0) {
      EXPECT_NEAR(e.memory.stress.xy / mu, std::sin(gamma), 1e-4);
      EXPECT_NEAR(e.memory.stress.xx / mu, 1 - std::cos(gamma), 1e-4);
    }
  }
}

TEST(Hexahedron, LargeSimpleShearFollowsTheLogarithmicStrain) {
  Element<Elastic> e{metal<Elastic>(), {}, brick(1, 1, 1)};
  const double mu = material::shear_modulus(e.law), increment = 1e-3;
  for (int step = 1; step <= 1800; ++step) {
    Mat3 F = Mat3::Identity();
    const double gamma = F(0, 1) = increment * step;
    e.move(times(F, e.X));
    const double h = logarithmic_shear(gamma);
    EXPECT_NEAR(e.memory.stress.xy / mu, 2 * h, 1e-3);
    EXPECT_NEAR(e.memory.stress.xx / mu, h * gamma, 1e-3);
  }
}

// ------------------------------------------------------------------------------------------------
// Frequencies

const Point shapes[] = {{1, 1, 1}, {1, 2, 3}, {1, 1, 0.2}, {1, 0.3, 0.5}};

TEST(Hexahedron, LargestFrequencyOfABrickIsTheClosedForm) {
  for (const double poisson : {0.3, 0.42, 0.49}) {
    for (const Point& h : shapes) {
      const Element<Elastic> e{metal<Elastic>(poisson),
                               {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = springs},
                               brick(h.x, h.y, h.z)};
      const auto [lambda, mu] = material::lame(e.law);
      Mat3 M;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          M(i, j) = 4 * (lambda + (i == j ? 2 * mu : 0)) / (e.law.density * h[i] * h[j]);
      const double closed = eigenvalues(M).maxCoeff();
      const double exact = largest_eigenvalue_of(e), bound = hot_bound(e);
      EXPECT_NEAR(exact, closed, 1e-10 * closed);
      EXPECT_GE(bound, closed * (1 - 1e-13));
      ::testing::Test::RecordProperty("bound_over_exact_nu" + std::to_string(poisson) + "_h" +
                                          std::to_string(h.x + 10 * h.y + 100 * h.z),
                                      std::to_string(std::sqrt(bound / exact)));
    }
  }
}

TEST(Hexahedron, FrequencyBoundIsExactForACube) {
  for (const double poisson : {0.3, 0.42, 0.49}) {
    const Element<Elastic> e{metal<Elastic>(poisson),
                             {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = springs},
                             brick(0.7, 0.7, 0.7)};
    const double omega =
        2 * material::wave_speed(e.law) / 0.7 * std::sqrt((1 + poisson) / (1 - poisson));
    EXPECT_NEAR(hot_bound(e), omega * omega, 1e-13 * omega * omega);
  }
}

TEST(Hexahedron, FrequencyBoundHoldsForANegativePoissonRatio) {
  for (int trial = 0; trial < 100; ++trial) {
    const Element<Elastic> e{metal<Elastic>(random(-0.9, 0.0)), {.hourglass = 0, .viscosity = no_viscosity, .hourglass_kind = springs},
                             random_shape(0.3)};
    EXPECT_GE(hot_bound(e), largest_eigenvalue_of(e) * (1 - 1e-9));
  }
}

/// Bound over exact frequency of random distorted elements: the smallest and the largest ratio.
std::array<double, 2> bound_over_exact(double hourglass) {
  std::array<double, 2> ratios{1e300, 0};
  for (int trial = 0; trial < 1000; ++trial) {
    const Corners shape = random_shape(0.3);
    const Element<Elastic> e{metal<Elastic>(random(0.0, 0.49)),
                             {.hourglass = hourglass, .viscosity = no_viscosity, .hourglass_kind = springs}, shape};
    const double ratio = std::sqrt(hot_bound(e) / largest_eigenvalue_of(e));
    ratios = {std::min(ratios[0], ratio), std::max(ratios[1], ratio)};
  }
  ::testing::Test::RecordProperty("smallest_" + std::to_string(hourglass),
                                  std::to_string(ratios[0]));
  ::testing::Test::RecordProperty("largest_" + std::to_string(hourglass),
                                  std::to_string(ratios[1]));
  return ratios;
}

TEST(Hexahedron, FrequencyBoundIsNeverBelowTheExactOne) {
  const auto [smallest, largest_ratio] = bound_over_exact(0.0);
  EXPECT_GE(smallest, 1 - 1e-9);
  EXPECT_LT(largest_ratio, 1.2);
}

TEST(Hexahedron, HourglassStiffnessRaisesFrequenciesOfDistortedElementsByLessThanAFifthOfAPercent) {
  EXPECT_GE(bound_over_exact(0.1)[0], 0.998);
}

TEST(Hexahedron, IsStableBelowItsExactLimitAndBlowsUpBeyond) {
  const Element<Elastic> e{
      metal<Elastic>(), {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = springs}, brick(1.0, 0.7, 1.3)};
  EXPECT_LT(growth(e, 0.99), 100.0);
  EXPECT_GT(growth(e, 1.02), 1e12);
}

// ------------------------------------------------------------------------------------------------
// Hourglass control by dashpots

constexpr auto dashpots = Hexahedron::Hourglass::viscous;

TEST(ViscousHourglass, OfACubeDiesAsItsFractionOfCriticalSaysAndBooksWhatItLoses) {
  const double fraction = 0.08, h = 0.7;
  Element<Elastic> e{metal<Elastic>(), {.hourglass = fraction, .viscosity = no_viscosity, .hourglass_kind = dashpots}, brick(h, h, h)};
  const double omega = 2 * material::wave_speed(e.law) / h, mass = e.constants.mass / 8, dt = 1e-4 / omega;
  Modes<double> m{};
  m.hourglass[0] = {1e-8, 2e-8, 3e-8}, m.hourglass[3] = {-1e-8, 2e-8, 1e-8};
  Corners v = nodal_values(m);
  const double start = product(v, v);
  double dissipated = 0, stored = 0;
  const int steps = 20000;
  for (int step = 0; step < steps; ++step) {
    Corners du;
    for (int i = 0; i < 8; ++i) v[i] = v[i] + (dt / mass) * e.force[i], du[i] = dt * v[i];
    const auto report = e.move(sum(e.x, du), dt);
    dissipated += report[Dissipated::hourglass], stored += report.stored[0] + report.stored[1];
  }
  const double left = product(v, v) / start;
  EXPECT_NEAR(left, std::exp(-4 * fraction * omega * dt * steps), 1e-4);  // velocities as exp(-2 ...), first order in dt
  EXPECT_NEAR(dissipated, 0.5 * mass * start * (1 - left), 1e-4 * 0.5 * mass * start);
  EXPECT_NEAR(stored, 0, 1e-12 * mass * start);
}

TEST(ViscousHourglass, HoldsNothingAtRest) {
  Element<Elastic> e{metal<Elastic>(), {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = dashpots}, brick(1.0, 0.7, 1.6)};
  Modes<double> m{};
  for (auto& h : m.hourglass) h = random_point(1e-3);
  const auto report = e.move(sum(e.X, nodal_values(m)));
  EXPECT_GT(report[Dissipated::hourglass], 0);
  EXPECT_EQ(report.stored[1], 0);
  const double moving = largest(e.force);
  e.rest();
  EXPECT_LT(largest(e.force), 1e-2 * moving);  // what is left: strain of second order in the hourglass
}

TEST(ViscousHourglass, LayersOfOnePointCarryBendingAsOneMinusOneOverTheirNumberSquared) {
  const double length = 0.3, depth = 1.0, curvature = 1e-6;
  for (const int n : {1, 2, 4, 8}) {
    double stored = 0, moment = 0;
    for (int layer = 0; layer < n; ++layer) {
      const double h = depth / n, middle = (layer + 0.5) * h - 0.5 * depth;
      Corners X = brick(length, h, 1.0), u;
      for (int i = 0; i < 8; ++i) {
        X[i].y += middle;
        u[i] = {curvature * X[i].x * X[i].y, -0.5 * curvature * X[i].x * X[i].x, 0};
      }
      Element<Elastic> e{metal<Elastic>(0.0), {.hourglass = 0.05, .viscosity = no_viscosity, .hourglass_kind = dashpots}, X};
      stored += e.move(sum(X, u)).stored[0];
      e.rest();
      for (int i = 0; i < 8; ++i)
        if (X[i].x > 0) moment -= e.force[i].x * X[i].y;
    }
    const double EI = 3.0 / 12.0, expected = 1 - 1.0 / (n * n);
    EXPECT_NEAR(stored / (0.5 * EI * curvature * curvature * length), expected, 1e-5);  // finite curvature: 1e-6
    EXPECT_NEAR(moment / (EI * curvature), expected, 1e-5);
  }
}

TEST(ViscousHourglass, StepIsNeverBeyondTheExactOneOfTheDampedElement) {
  double smallest = 1e300, highest = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Corners X = random_shape(0.3);
    const Elastic law = metal<Elastic>(random(0.0, 0.49));
    const Viscosity viscosity{.linear = trial % 2 ? 0.06 : 0.0, .quadratic = 0};
    const Element<Elastic> soft{law, {.hourglass = 0, .viscosity = no_viscosity, .hourglass_kind = springs}, X};
    Element<Elastic> damped{law, {.hourglass = random(0.01, 0.5), .viscosity = viscosity, .hourglass_kind = dashpots}, X};
    const double per_mass = 8 / damped.constants.mass;
    const Matrix24 K = per_mass * stiffness(soft), C = per_mass * stiffness(damped) - K;  // steps of 1 s
    double low = 0, high = 2 / std::sqrt(hot_bound(soft)) * 1.5;
    for (int halving = 0; halving < 40; ++halving) {  // dt^2 K + 2 dt C reaches 4
      const double dt = 0.5 * (low + high);
      const Matrix24 A = dt * dt * K + 2 * dt * C, symmetrised = 0.5 * (A + A.transpose());
      const double most = eigenvalues(symmetrised).maxCoeff();
      (most < 4 ? low : high) = dt;
    }
    const double ratio = damped.step(X, Corners{}, 1.0).step / low;
    smallest = std::min(smallest, ratio), highest = std::max(highest, ratio);
  }
  std::printf("dashpots: step voted over exact %.3f to %.3f\n", smallest, highest);
  EXPECT_LE(highest, 1);
}

TEST(ViscousHourglass, IsBlindToAffineMotionAndToRigidRotation) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<Elastic> e{metal<Elastic>(), {.hourglass = 0.1, .viscosity = {}, .hourglass_kind = dashpots}, distorted(0.3)};
    e.move(times(Mat3(Mat3::Identity() + 0.1 * Mat3::Random()), e.X));
    for (const Point& q : e.memory.hourglass) EXPECT_LT(norm(q), 1e-15);
    Element<Elastic> spun{e.law, e.options, e.X};
    EXPECT_NEAR(spun.move(times(random_rotation(2.0), e.X))[Dissipated::hourglass], 0, 1e-28);
  }
}

TYPED_TEST(HexahedronOf, WithDashpotsWorkAndEnergyDifferInTheThirdOrderOfTheStep) {
  Element<TypeParam> start{
      metal<TypeParam>(), {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = dashpots}, distorted(0.2)};
  start.randomise(0.003);
  const Corners velocity = random_field(1.0);
  Corners soon;  // so small a step that nothing moves, and dashpots feel the velocity
  for (int i = 0; i < 8; ++i) soon[i] = 1e-100 * velocity[i];
  start.step(start.x, soon, 1e-100);
  const auto error = [&](double dt) {
    Element<TypeParam> e = start;
    Corners du;
    for (int i = 0; i < 8; ++i) du[i] = dt * velocity[i];
    const auto report = e.move(sum(e.x, du), dt);
    EXPECT_GT(report[Dissipated::hourglass], 0);
    const double work = 0.5 * (product(start.force, du) + product(e.force, du));
    return work + report.stored[0] + report[Dissipated::plastic] + report[Dissipated::hourglass];
  };
  EXPECT_NEAR(error(2e-4) / error(1e-4), 8.0, 0.3);
}

// ------------------------------------------------------------------------------------------------
// Hourglass stiffness by assumed strains

const Hexahedron::Options assumed{.viscosity = no_viscosity};

TEST(AssumedStrain, OfABrickHasEighteenStiffnessesAndBendsAsABeamAtAnyPoissonsRatio) {
  for (const double poisson : {-0.5, 0.0, 0.3, 0.4999})
    for (const double length : {0.1, 1.0, 10.0}) {
      const Corners X = brick(length, 1.0, 1.0);
      Element<Elastic> e{metal<Elastic>(poisson), assumed, X};
      const auto values = stiffness_eigenvalues(e);
      EXPECT_LT(std::abs(values(5)), 1e-9 * values(23));
      EXPECT_GT(values(6), 1e-9 * values(23));
      // the nodes of a beam in bending, with the waist that it asks for: u_y has no mode of a hexahedron
      const double curvature = 1e-6;
      Corners u;
      for (int i = 0; i < 8; ++i) u[i] = {curvature * X[i].x * X[i].y, 0, 0};
      const auto report = e.move(sum(X, u));
      const double beam = 0.5 * e.law.young / 12 * curvature * curvature * length;
      // sides are held, so a plane's part 1/(1 - nu^2) is what one mode alone has
      EXPECT_NEAR(report[Stored::hourglass] / beam, 1 / (1 - poisson * poisson), 1e-4) << poisson << ' ' << length;
    }
}

TEST(AssumedStrain, IsBlindToAffineMotion) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<Elastic> e{metal<Elastic>(), assumed, distorted(0.3)};
    e.move(times(Mat3(Mat3::Identity() + 0.1 * Mat3::Random()), e.X));
    for (const Point& q : e.memory.hourglass) EXPECT_LT(norm(q), 1e-14);
  }
}

TEST(AssumedStrain, FrequencyBoundIsNeverBelowTheExactOne) {
  double closest = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Element<Elastic> e{metal<Elastic>(random(0.0, 0.49)), assumed, random_shape(0.4 * random(0, 1))};
    closest = std::max(closest, largest_eigenvalue_of(e) / hot_bound(e));
  }
  EXPECT_LE(closest, 1 + 1e-6);
  EXPECT_GT(closest, 0.9);
}

TEST(AssumedStrain, OfAParallelepipedTakesNoStep) {
  const Mat3 skew = (Mat3() << 1, 0.4, 0.2, 0, 1, -0.3, 0, 0, 1).finished();
  const Corners X = times(skew, brick(1.0, 0.7, 1.3));
  const Element<Elastic> with{metal<Elastic>(), assumed, X};
  const Element<Elastic> without{metal<Elastic>(), {.hourglass = 0, .viscosity = no_viscosity, .hourglass_kind = springs}, X};
  EXPECT_NEAR(hot_bound(with), hot_bound(without), 1e-10 * hot_bound(without));
}

TEST(AssumedStrain, GivesBackNoMoreThanItTookWhereABentElementIsStrained) {
  const Corners X = brick(1, 1, 1);
  for (const double stretch : {0.5, 1.0, 2.0})
    for (int mode = 0; mode < 2; ++mode) {
      Element<Elastic> e{metal<Elastic>(), assumed, X};
      double stored = 0, largest_store = 0, work = 0;
      const auto move = [&](double bent, double along) {  // u_x = xy bends, u_z = xy twists
        Corners to = X;
        for (int i = 0; i < 8; ++i) {
          (mode == 0 ? to[i].x : to[i].z) += bent * X[i].x * X[i].y;
          to[i].x *= along;
        }
        const Corners before = e.force, from = e.x;
        const auto report = e.move(to);
        stored += report[Stored::hourglass], largest_store = std::max(largest_store, stored);
        work -= 0.5 * product(sum(before, e.force), sum(to, from, -1.0)) + report[Stored::elastic];
        // the force of the step before acts for half a step, of 200, that it cannot take back
        EXPECT_GE(stored, -2e-3 * largest_store) << stretch << ' ' << mode;
        EXPECT_NEAR(e.memory.bent, stored, 2e-3 * largest_store) << "what it remembers is what was booked";
      };
      const int steps = 200;
      const auto part = [](int i) { return (i + 1.0) / steps; };
      for (int i = 0; i < steps; ++i) move(0.05 * part(i), 1);
      for (int i = 0; i < steps; ++i) move(0.05, 1 + (stretch - 1) * part(i));
      for (int i = 0; i < steps; ++i) move(0.05 * (1 - part(i)), stretch);
      for (int i = 0; i < steps; ++i) move(0, stretch + (1 - stretch) * part(i));
      EXPECT_GT(largest_store, 0);
      if (stretch != 1) continue;
      EXPECT_NEAR(stored, 0, 1e-5 * largest_store) << mode;
      EXPECT_NEAR(work, stored, 1e-4 * largest_store) << mode;
    }
}

TEST(AssumedStrain, BendsPlasticallyUpToTheFullyPlasticMoment) {
  const double h = 1;
  const Corners X = brick(h, h, h);
  Element<J2Bilinear> e{metal<J2Bilinear>(), assumed, X};
  const double yield = e.law.flow.yield;
  double stored = 0, dissipated = 0, work = 0;
  for (int step = 0; step < 2000; ++step) {
    Corners u = e.x;
    const double curvature = 5e-3 * yield / e.law.young;
    for (int i = 0; i < 8; ++i) u[i].x += curvature * X[i].x * X[i].y;
    const Corners before = e.force, from = e.x;
    const auto report = e.move(u);
    stored += report[Stored::hourglass], dissipated += report[Dissipated::plastic];
    work -= 0.5 * (product(sum(before, e.force), sum(u, from, -1.0)));
    EXPECT_GE(report[Dissipated::plastic], 0);
  }
  double moment = 0;
  for (int i = 0; i < 8; ++i)
    if (X[i].x > 0) moment -= e.force[i].x * X[i].y;
  EXPECT_NEAR(moment / (yield * h * h * h / 4), 1, 0.15);  // of plane stress between held sides, and a cap of all modes together
  EXPECT_NEAR(stored + dissipated, work, 1e-3 * work);
}

// ------------------------------------------------------------------------------------------------
// Viscosity

TEST(Hexahedron, ViscosityDissipatesAndExplainsTheLossOfEnergy) {
  Element<Elastic> e{metal<Elastic>(),
                     {.hourglass = 0.1, .viscosity = {.linear = 0.2, .quadratic = 1.2}, .hourglass_kind = springs},
                     brick(1, 1, 1)};
  const double dt = 0.05 * 2 /
                    std::sqrt(largest_eigenvalue_of(Element<Elastic>{
                        e.law, {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = springs}, e.X}));
  Corners v{};
  for (int i = 0; i < 8; ++i) v[i] = -1e-3 * e.X[i];
  const double mass = e.constants.mass / 8;
  const double start = 0.5 * mass * product(v, v);
  double stored = 0, viscous = 0;
  for (int step = 0; step < 400; ++step) {
    Corners du;
    for (int i = 0; i < 8; ++i) v[i] = v[i] + (dt / mass) * e.force[i], du[i] = dt * v[i];
    const auto report = e.move(sum(e.x, du), dt);
    if (step < 10) {
      EXPECT_GT(report[Dissipated::viscous], 0) << "still compressing";
    }
    stored += report.stored[0] + report.stored[1];
    viscous += report[Dissipated::viscous];
  }
  EXPECT_GT(viscous, 0.5 * start);
  // kinetic energy now lies half a step behind: close it with the present forces
  for (int i = 0; i < 8; ++i) v[i] = v[i] + (0.5 * dt / mass) * e.force[i];
  EXPECT_NEAR(0.5 * mass * product(v, v) + stored + viscous, start, 0.01 * start);
}

TEST(Hexahedron, ViscosityShortensTheStableStep) {
  Element<Elastic> e{metal<Elastic>(), {}, brick(1, 1, 1)},
      dry{metal<Elastic>(), {.hourglass = 0.1, .viscosity = no_viscosity, .hourglass_kind = springs}, brick(1, 1, 1)};
  // a stress that leads by tau damps a mode of frequency omega by zeta = tau omega / 2
  const double step = e.step(e.X, Corners{}, 1.0).step, undamped = dry.step(dry.X, Corners{}, 1.0).step;
  const double speed = material::wave_speed(e.law), squared = 4 / (undamped * undamped);
  const double tau = 0.06 * std::min(1.0, std::sqrt(2.0) * undamped * speed) / speed;  // a side, and never much more than the wave goes
  EXPECT_NEAR(step, stable_step(squared, 0.5 * tau * squared), 1e-12);
  EXPECT_LT(step, undamped);
}

TEST(Hexahedron, InvertedElementHasNegativeSize) {
  Element<Elastic> e{metal<Elastic>(), {}, brick(1, 1, 1)};
  Corners inside_out = e.X;
  for (Point& p : inside_out) p.z = -p.z;
  EXPECT_LT(e.step(inside_out, Corners{}, 1.0).volume_ratio, 0);
}

}  // namespace
}  // namespace nereid::element::hexahedron_test
