#include "element/full_hexahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "base/dual.hpp"
#include "tests/element/solids.hpp"

namespace nereid::element {
namespace {

template <class Law>
using Element = OneElement<FullHexahedron, Law>;

const FullHexahedron::Options inviscid{.viscosity = no_viscosity};

// ------------------------------------------------------------------------------------------------
// Tangents, cofactors and the bound on the Laplacian

/// Gradients of the shape functions and the determinant at each point, in the order of the points.
struct AtPoint {
  Eigen::Matrix<double, 3, 8> gradients;
  double volume;
};
std::vector<AtPoint> at_points(const Corners& x) {
  std::vector<AtPoint> all;
  integrate(x, [&](const auto& gradients, double det) { all.push_back({gradients, det}); });
  return all;
}
Mat3 gradient_of(const Corners& u, const AtPoint& at) {
  Mat3 L = Mat3::Zero();
  for (int i = 0; i < 8; ++i) L += Vec3(u[i].x, u[i].y, u[i].z) * at.gradients.col(i).transpose();
  return L;
}

TEST(FullHexahedron, GradientsAtThePointsAreThoseOfTheTrilinearField) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners x = distorted(0.3), u = random_field(1.0);
    const auto shape = tangents(amplitudes(x)), field = tangents(amplitudes(u));
    const auto exact = at_points(x);
    for (int p = 0; p < 8; ++p) {
      const auto c = cofactors(shape, p);
      Matrix<double> L{};
      add_outer(field.xi[xi_at[p]], c.xi, L);
      add_outer(field.eta[eta_at[p]], c.eta, L);
      add_outer(field.zeta[zeta_at[p]], c.zeta, L);
      const Mat3 expected = gradient_of(u, exact[p]);
      EXPECT_NEAR(c.volume, exact[p].volume, 1e-15);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(L[i][j] / c.volume, expected(i, j), 1e-13);
    }
  }
}

TEST(FullHexahedron, PullsByModeAreTheTransposeOfTangents) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners u = random_field(1.0);
    const Modes<double> modes = amplitudes(u);
    const auto field = tangents(modes);
    Tangents<double> pull{};
    double at_points = 0;
    for (int i = 0; i < 4; ++i) {
      pull.xi[i] = random_point(1), pull.eta[i] = random_point(1), pull.zeta[i] = random_point(1);
      at_points += dot(pull.xi[i], field.xi[i]) + dot(pull.eta[i], field.eta[i]) + dot(pull.zeta[i], field.zeta[i]);
    }
    const Modes<double> m = pulls_by_mode(pull);
    double by_mode = dot(m.xi, modes.xi) + dot(m.eta, modes.eta) + dot(m.zeta, modes.zeta);
    for (int h = 0; h < 4; ++h) by_mode += dot(m.hourglass[h], modes.hourglass[h]);
    EXPECT_NEAR(by_mode, at_points, 1e-13);
  }
}

TEST(FullHexahedron, VolumesOfThePointsAndTheirGradientsSumToThoseOfTheElement) {
  using D = Dual<24>;
  const Corners x = distorted(0.4);
  std::array<Vector<D>, 8> variable;
  for (int i = 0; i < 24; ++i) variable[i / 3][i % 3] = D(0.125) * D::variable(x[i / 3][i % 3], i);
  const auto modes = sums_by_mode(variable);
  const auto shape = tangents(modes);
  D sum(0.0);
  for (int p = 0; p < 8; ++p) sum = sum + cofactors(shape, p).volume;
  const D volume = volume_gradient(modes).volume;
  EXPECT_NEAR(sum.value, volume.value, 1e-14);
  for (int i = 0; i < 24; ++i) EXPECT_NEAR(sum.by[i], volume.by[i], 1e-14);
}

Metric<double> metric_of(const Corners& x) {
  const auto shape = tangents(amplitudes(x));
  Metric<double> metric;
  for (int p = 0; p < 8; ++p) {
    const auto c = cofactors(shape, p);
    metric.equal[p] = (1 / c.volume) * Point{dot(c.xi, c.xi), dot(c.eta, c.eta), dot(c.zeta, c.zeta)};
    metric.mixed[p] = (1 / c.volume) * Point{dot(c.xi, c.eta), dot(c.eta, c.zeta), dot(c.zeta, c.xi)};
  }
  return metric;
}

TEST(FullHexahedron, LaplacianBoundIsNeverBelowTheExactOne) {
  double smallest = 1e300, highest = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Corners x = random_shape(0.3);
    Eigen::Matrix<double, 8, 8> laplacian = Eigen::Matrix<double, 8, 8>::Zero();
    for (const auto& at : at_points(x)) laplacian += at.volume * at.gradients.transpose() * at.gradients;
    const double exact = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 8, 8>>(laplacian).eigenvalues().maxCoeff();
    const double ratio = laplacian_bound(metric_of(x)) / exact;
    smallest = std::min(smallest, ratio), highest = std::max(highest, ratio);
  }
  RecordProperty("smallest", std::to_string(smallest));
  RecordProperty("largest", std::to_string(highest));
  EXPECT_GE(smallest, 1 - 1e-12);
  EXPECT_LT(highest, 1.5);  // of the square of a frequency
}

TEST(FullHexahedron, LaplacianBoundOfAParallelepipedIsThatOfTheOnePointElement) {
  for (int trial = 0; trial < 50; ++trial) {
    const Corners x = times(Mat3(Mat3::Identity() + 0.5 * Mat3::Random()), brick(random(0.3, 2), random(0.3, 2), random(0.3, 2)));
    const auto g = volume_gradient(amplitudes(x));
    const double one_point = largest_eigenvalue_bound(gradient_products(g)) / g.volume;
    EXPECT_NEAR(laplacian_bound(metric_of(x)), one_point, 1e-12 * one_point);
  }
}

TEST(FullHexahedron, LaplacianBoundDoesNotDependOnTheNumberingOfTheNodes) {
  const Corners x = distorted(0.3);
  const double bound = laplacian_bound(metric_of(x));
  const int about_z[8] = {1, 2, 3, 0, 5, 6, 7, 4}, about_x[8] = {3, 2, 6, 7, 0, 1, 5, 4};
  for (const auto& order : {about_z, about_x}) {
    Corners y;
    for (int i = 0; i < 8; ++i) y[i] = x[order[i]];
    EXPECT_GT(volume_gradient(amplitudes(y)).volume, 0);
    EXPECT_NEAR(laplacian_bound(metric_of(y)), bound, 1e-13 * bound);
  }
}

// ------------------------------------------------------------------------------------------------
// Motions, over all laws

using EightPoints = WithEachLaw<FullHexahedron, Laws>::type;
INSTANTIATE_TYPED_TEST_SUITE_P(OfEightPoints, EverySolid, EightPoints);

template <class Law>
class FullHexahedronOf : public ::testing::Test {};
TYPED_TEST_SUITE(FullHexahedronOf, Laws);

TYPED_TEST(FullHexahedronOf, ForcesAreTheTransposeOfTheRateOfStrain) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<TypeParam> e{metal<TypeParam>(), inviscid, distorted(0.2)};
    e.randomise(0.01);
    e.rest();
    const Corners w = random_field(1.0);
    const auto points = at_points(e.x);
    double mean = 0, volume = 0;
    for (const auto& at : points) mean += at.volume * gradient_of(w, at).trace(), volume += at.volume;
    mean /= volume;
    double power = 0;
    for (int p = 0; p < 8; ++p) {
      Mat3 L = gradient_of(w, points[p]);
      L += (mean - L.trace()) / 3 * Mat3::Identity();
      power += points[p].volume * (full(e.memory.points[p].stress).array() * L.array()).sum();
    }
    EXPECT_NEAR(-product(e.force, w), power, 1e-14 * 10 * largest(e.force));
  }
}

// ------------------------------------------------------------------------------------------------
// Patch test, stiffness, mean dilatation

TEST(FullHexahedron, PatchOfSevenDistortedElementsHasConstantStress) {
  const SevenElements patch = seven_elements();
  for (const double size : {1e-3, 0.2}) {
    const Mat3 F = Mat3::Identity() + size * (Mat3() << 0.9, -0.3, 0.2, 0.4, -0.7, 0.1, -0.5, 0.6, 0.3).finished();
    std::array<Point, 16> force{};
    Mat3 stress;
    double largest_force = 0;
    for (std::size_t n = 0; n < patch.nodes.size(); ++n) {
      const Corners corners = patch.corners(n);
      Element<Elastic> e{metal<Elastic>(), inviscid, corners};
      e.move(times(F, corners));
      if (n == 0) stress = full(e.memory.points[0].stress);
      for (const auto* s : stresses(e.memory)) EXPECT_LT((full(*s) - stress).norm(), 1e-12 * stress.norm());
      for (int i = 0; i < 8; ++i) force[patch.nodes[n][i]] = force[patch.nodes[n][i]] + e.force[i];
      largest_force = std::max(largest_force, largest(e.force));
    }
    for (int i = 0; i < 8; ++i) EXPECT_LT(norm(force[i]), 1e-12 * largest_force);
  }
}

TEST(FullHexahedron, StiffnessHasSixZeroEigenvaluesAndNoOther) {
  for (int trial = 0; trial < 20; ++trial) {
    const Element<Elastic> e{metal<Elastic>(), inviscid, trial == 0 ? brick(1, 1, 1) : random_shape(0.3)};
    const auto values = eigenvalues(e);
    const double most = values.maxCoeff();
    for (int i = 0; i < 6; ++i) EXPECT_LT(std::abs(values(i)), 1e-9 * most);  // differences leave 1e-10
    EXPECT_GT(values(6), 1e-4 * most);  // sides 1:7 bring the softest to some 1e-3, round-off is at 1e-10
    const Matrix24 K = stiffness(e);
    EXPECT_LT((K - K.transpose()).norm(), 1e-8 * K.norm());
  }
}

TEST(FullHexahedron, OnlyTheChangeOfVolumeFeelsTheBulkModulus) {
  // with strains of their own at each point seven modes would, and lock
  for (const Corners& X : {brick(1, 1, 1), brick(1, 0.4, 2), distorted(0.2)}) {
    const Element<Elastic> e{metal<Elastic>(0.499999), inviscid, X};
    const auto values = eigenvalues(e);
    const double mu = material::shear_modulus(e.law);
    int stiff = 0;
    for (int i = 0; i < 24; ++i) stiff += values(i) > 100 * mu;
    EXPECT_EQ(stiff, 1);
  }
}

TEST(FullHexahedron, PressureIsTheSameAtAllPointsAndFollowsTheExactVolume) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<Elastic> e{metal<Elastic>(), inviscid, distorted(0.2)};
    const Corners to = sum(e.X, random_field(1e-4));
    const double before = volume_gradient(amplitudes(e.X)).volume, after = volume_gradient(amplitudes(to)).volume;
    e.move(to);
    const double expected = 3 * material::bulk_modulus(e.law) * std::log(after / before);
    for (const auto* s : stresses(e.memory))
      EXPECT_NEAR(trace(*s), expected, 1e-10);  // third order in the strain of 1e-4, times the modulus
  }
}

TEST(FullHexahedron, BendingOfABrickHasItsClosedForm) {
  // u_x = a xi eta: stretch 2 a eta/L, whose trace has no mean, and shear 2 a xi/h, which a beam has not
  for (const double L : {0.7, 1.4}) {
    const double a = 1e-4, h = 0.7, width = 0.7;
    Element<Elastic> e{metal<Elastic>(0.0), inviscid, brick(L, h, width)};
    const double beam = material::shear_modulus(e.law) * (4 * a * a / (L * L) / 3) * L * h * width;
    Modes<double> m{};
    m.hourglass[2].x = a;
    EXPECT_NEAR(e.move(sum(e.X, nodal_values(m))).stored[0] / beam, 2.0 / 3 + 0.5 * (L / h) * (L / h), 1e-6);
  }
}

/// Displacement of the bore of a thick tube under inner pressure in plane strain, over Lame's, by static
/// equilibrium of a quarter cut into n x n elements. b = 2a.
template <class Kind>
double bore(double poisson, int n, const typename Kind::Options& options) {
  const Elastic law = metal<Elastic>(poisson);
  const double a = 1, b = 2, thick = 0.2, pressure = 1e-3;
  const auto node = [n](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
  const int nodes = 2 * (n + 1) * (n + 1);
  std::vector<Point> X(nodes);
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double r = a + (b - a) * i / n, angle = 0.5 * pi * j / n;
        X[node(i, j, k)] = {r * std::cos(angle), r * std::sin(angle), thick * k};
      }
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * nodes);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int at[8] = {node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0),
                         node(i, j, 1), node(i + 1, j, 1), node(i + 1, j + 1, 1), node(i, j + 1, 1)};
      Corners corners;
      for (int c = 0; c < 8; ++c) corners[c] = X[at[c]];
      const Matrix24 Ke = stiffness(OneElement<Kind, Elastic>{law, options, corners});
      for (int p = 0; p < 24; ++p)
        for (int q = 0; q < 24; ++q) K(3 * at[p / 3] + p % 3, 3 * at[q / 3] + q % 3) += Ke(p, q);
    }
  for (int j = 0; j < n; ++j) {  // pressure on the flat facets of the bore
    const Point &low = X[node(0, j, 0)], &high = X[node(0, j + 1, 0)];
    const Vec3 normal(high.y - low.y, low.x - high.x, 0);  // length of the facet, away from the axis
    for (const int at : {node(0, j, 0), node(0, j + 1, 0), node(0, j, 1), node(0, j + 1, 1)})
      f.segment<3>(3 * at) += 0.25 * pressure * thick * normal;
  }
  const auto hold = [&](int row) {
    K.row(row).setZero(), K.col(row).setZero();
    K(row, row) = 1, f(row) = 0;
  };
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i <= n; ++i) hold(3 * node(i, 0, k) + 1), hold(3 * node(i, n, k));
  for (int at = 0; at < nodes; ++at) hold(3 * at + 2);
  const Eigen::VectorXd u = K.ldlt().solve(f);
  const double exact = (1 + poisson) / law.young * pressure * a / (b * b - a * a) * ((1 - 2 * poisson) * a * a + b * b);
  return u(3 * node(0, 0, 0)) / exact;
}

TEST(FullHexahedron, ThickTubeDoesNotLockAsItBecomesIncompressible) {
  for (const double poisson : {0.3, 0.49, 0.4999}) {
    const double eight = bore<FullHexahedron>(poisson, 8, inviscid);
    const double one = bore<Hexahedron>(poisson, 8, {.hourglass = 0.1, .viscosity = no_viscosity});
    std::printf("thick tube, poisson %.4f: bore over Lame's %.5f with eight points, %.5f with one\n", poisson, eight, one);
    EXPECT_NEAR(eight, 1, 0.02);
    EXPECT_NEAR(one, 1, 0.02);
  }
}

TEST(FullHexahedron, LargeSimpleShearFollowsTheRateOfJaumann) {
  const Mat3 skew = (Mat3() << 1, 0.3, -0.2, 0, 0.8, 0.4, 0, 0, 1.2).finished();
  for (const Corners& X : {brick(1, 1, 1), times(skew, brick(1, 1, 1)), distorted(0.2)}) {
    Element<Elastic> e{metal<Elastic>(), {}, X};
    const double mu = material::shear_modulus(e.law), increment = 1e-3;
    double worst = 0;
    for (int step = 1; step <= 4000; ++step) {
      Mat3 F = Mat3::Identity();
      const double gamma = F(0, 1) = increment * step;
      e.move(times(F, e.X));
      for (const auto* s : stresses(e.memory))
        worst = std::max({worst, std::abs(s->xy / mu - std::sin(gamma)), std::abs(s->xx / mu - (1 - std::cos(gamma)))});
    }
    EXPECT_LT(worst, 1e-4);  // of catalogues of hypoelastic shear, at this increment
  }
}

// ------------------------------------------------------------------------------------------------
// Frequencies

TEST(FullHexahedron, LargestFrequencyOfABrickIsTheClosedForm) {
  for (const double poisson : {0.0, 0.3, 0.42, 0.49}) {
    for (const Point& h : {Point{1, 1, 1}, Point{1, 2, 3}, Point{1, 1, 0.2}, Point{1, 0.3, 0.5}}) {
      const Element<Elastic> e{metal<Elastic>(poisson), inviscid, brick(h.x, h.y, h.z)};
      const auto [lambda, mu] = material::lame(e.law);
      Mat3 M;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) M(i, j) = 4 * (lambda + (i == j ? 2 * mu : 0)) / (e.law.density * h[i] * h[j]);
      const double closed = Eigen::SelfAdjointEigenSolver<Mat3>(M).eigenvalues().maxCoeff();
      EXPECT_NEAR(largest_eigenvalue_of(e), closed, 1e-9 * closed);
      EXPECT_GE(hot_bound(e), closed * (1 - 1e-13));
    }
  }
}

TEST(FullHexahedron, FrequencyBoundIsExactForACube) {
  for (const double poisson : {0.0, 0.3, 0.42, 0.49}) {
    const Element<Elastic> e{metal<Elastic>(poisson), inviscid, brick(0.7, 0.7, 0.7)};
    const double omega = 2 * material::wave_speed(e.law) / 0.7 * std::sqrt((1 + poisson) / (1 - poisson));
    EXPECT_NEAR(hot_bound(e), omega * omega, 1e-13 * omega * omega);
  }
}

TEST(FullHexahedron, FrequencyBoundIsNeverBelowTheExactOne) {
  for (const double part : {0.1, 0.3, 0.4}) {
    double smallest = 1e300, highest = 0, of_one_point = 1e300;
    for (int trial = 0; trial < 700; ++trial) {
      const Element<Elastic> e{metal<Elastic>(random(-0.5, 0.499)), inviscid, random_shape(part)};
      if (Element<Elastic>(e).step(e.X, Corners{}, 1.0).volume_ratio <= 0) continue;
      const double exact = largest_eigenvalue_of(e), ratio = std::sqrt(hot_bound(e) / exact);
      smallest = std::min(smallest, ratio), highest = std::max(highest, ratio);
      const OneElement<Hexahedron, Elastic> one{e.law, {.hourglass = 0.1, .viscosity = no_viscosity}, e.X};
      of_one_point = std::min(of_one_point, std::sqrt(hot_bound(one) / exact));
    }
    std::printf("corners moved by up to %.1f of the shortest side: bound over exact frequency %.4f to %.4f; that of one point "
                "would be %.4f\n", part, smallest, highest, of_one_point);
    EXPECT_GE(smallest, 1 - 1e-9);
    EXPECT_LT(highest, 1.3);
  }
}

TEST(FullHexahedron, IsStableBelowItsExactLimitAndBlowsUpBeyond) {
  for (const Corners& X : {brick(1.0, 0.7, 1.3), distorted(0.2)}) {
    const Element<Elastic> e{metal<Elastic>(), inviscid, X};
    EXPECT_LT(growth(e, 0.99), 100.0);
    EXPECT_GT(growth(e, 1.02), 1e8);
  }
}

// ------------------------------------------------------------------------------------------------
// Viscosity and size

TEST(FullHexahedron, BulkViscosityIsThatOfTheOnePointElement) {
  const Corners v = random_field(0.1);
  const Viscosity viscosity{.linear = 0.2, .quadratic = 1.2};
  Element<Elastic> e{metal<Elastic>(), {.viscosity = viscosity}, brick(1, 1, 1)};
  OneElement<Hexahedron, Elastic> one{e.law, {.hourglass = 0.1, .viscosity = viscosity}, e.X};
  for (int step = 0; step < 3; ++step) {
    const auto report = e.step(e.X, v, 1.0);
    const auto same = one.step(e.X, v, 1.0);
    EXPECT_NEAR(report[Dissipated::viscous], same[Dissipated::viscous], 1e-14);
    EXPECT_NEAR(report.step, same.step, 1e-13);
    EXPECT_NEAR(e.memory.viscous, one.memory.viscous, 1e-13);
  }
}

TEST(FullHexahedron, InvertedElementHasNegativeSize) {
  Element<Elastic> e{metal<Elastic>(), {}, brick(1, 1, 1)};
  EXPECT_NEAR(e.step(e.X, Corners{}, 1.0).volume_ratio, 1, 1e-14);
  Corners inside_out = e.X;
  for (Point& p : inside_out) p.z = -p.z;
  EXPECT_LT(e.step(inside_out, Corners{}, 1.0).volume_ratio, 0);
}

TEST(FullHexahedron, OneInvertedPointIsFoundWhereTheVolumeIsStillPositive) {
  Element<Elastic> e{metal<Elastic>(), {}, brick(1, 1, 1)};
  Corners dented = e.X;
  dented[6] = {-0.3, -0.3, -0.3};
  EXPECT_GT(volume_gradient(amplitudes(dented)).volume, 0);
  EXPECT_LT(e.step(dented, Corners{}, 1.0).volume_ratio, 0);
}

}  // namespace
}  // namespace nereid::element
