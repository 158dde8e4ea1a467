#include "element/full_hexahedron.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "base/dense.hpp"
#include "base/dual.hpp"
#include "tests/element/solids.hpp"

namespace nereid::element::full_hexahedron_test {
namespace {

template <class Law>
using Element = OneElement<FullHexahedron, Law>;

const FullHexahedron::Options inviscid{.viscosity = no_viscosity};

// ------------------------------------------------------------------------------------------------
// Fields at the points

TEST(FullHexahedron, FieldsAtThePointsAreSumsOfSignsAndTheirTransposeSumsThem) {
  PointField<double> field{.mean = random_tensor(1), .linear = {}, .product = {}};
  for (int k = 0; k < 3; ++k) field.linear[k] = random_tensor(1), field.product[k] = random_tensor(1);
  std::array<Symmetric<double>, 8> pull;
  const auto at = at_points(field);
  const Corners signs = brick(2, 2, 2);
  double at_the_points = 0;
  for (int p = 0; p < 8; ++p) {
    const Point& s = signs[p];
    Symmetric<double> expected = field.mean + s.y * s.z * field.product[0] + s.z * s.x * field.product[1] + s.x * s.y * field.product[2];
    for (int k = 0; k < 3; ++k) expected = expected + s[k] * field.linear[k];
    EXPECT_LT(contract(at[p] - expected, at[p] - expected), 1e-28);
    pull[p] = random_tensor(1);
    at_the_points += contract(pull[p], at[p]);
  }
  const auto sums = sums_over_points(pull);
  double by_part = contract(sums.mean, field.mean);
  for (int k = 0; k < 3; ++k) by_part += contract(sums.linear[k], field.linear[k]) + contract(sums.product[k], field.product[k]);
  EXPECT_NEAR(by_part, at_the_points, 1e-13);
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
    const auto X = amplitudes(e.x), w = amplitudes(random_field(1.0));
    const auto gradient = volume_gradient(X);
    const Matrix<double> L = mean_gradient(w, gradient);
    std::array<Point, 4> q;
    for (int a = 0; a < 4; ++a) q[a] = w.hourglass[a] - L * X.hourglass[a];
    const Symmetric<double> mean{L.x.x, L.y.y, L.z.z, (L.x.y + L.y.x) / 2, (L.y.z + L.z.y) / 2, (L.x.z + L.z.x) / 2};
    std::array<double, 3> across;  // without stiffness across the planes nothing strains there
    const auto rates = at_points(assumed_strains(centre_frame<double>({X.xi, X.eta, X.zeta}), mean, q, 0.0, 1.0, {0.0, 0.0, 0.0}, across));
    double power = 0;
    for (int p = 0; p < 8; ++p) power += gradient.volume / 8 * contract(e.memory.points[p].stress, rates[p]);
    EXPECT_NEAR(-product(e.force, nodal_values(w)), power, 1e-14 * 10 * largest(e.force));
  }
}

// ------------------------------------------------------------------------------------------------
// Patch test, stiffness, locking, compression

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
    const auto values = stiffness_eigenvalues(e);
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
    const auto values = stiffness_eigenvalues(e);
    const double mu = material::shear_modulus(e.law);
    int stiff = 0;
    for (int i = 0; i < 24; ++i) stiff += values(i) > 100 * mu;
    EXPECT_EQ(stiff, 1);
  }
}

TEST(FullHexahedron, ElasticBendsAsWithOnePointAndAssumedStrains) {
  // but for xi eta zeta, which takes no volume here and a uniaxial stress there
  for (int trial = 0; trial < 20; ++trial) {
    const double poisson = random(-0.4, 0.49);
    const Corners X = distorted(0.3);
    Element<Elastic> eight{metal<Elastic>(poisson), inviscid, X};
    OneElement<Hexahedron, Elastic> one{eight.law, {.viscosity = no_viscosity}, X};
    Modes<double> u = amplitudes(random_field(1e-7));
    u.hourglass[3] = mean_gradient(u, volume_gradient(amplitudes(X))) * amplitudes(X).hourglass[3];
    const Corners to = sum(X, nodal_values(u));
    eight.move(to), one.move(to);
    EXPECT_LT(largest(sum(eight.force, one.force, -1.0)), 1e-6 * largest(one.force));
    for (const double left : eight.memory.across) EXPECT_LT(std::abs(left), 1e-6 * largest(one.force));
  }
}

TEST(FullHexahedron, BendsPlasticallyToTheFullyPlasticMoment) {
  // Points at 1/sqrt(3) of the half depth carry 4/(sqrt(3) 4) of the area's moment at yield: 2/sqrt(3) of the exact one. Held sides add
  // their 2/sqrt(3) of plane strain.
  const double h = 1;
  const Corners X = brick(h, h, h);
  for (const int steps : {500, 2000}) {
    Element<J2Bilinear> e{metal<J2Bilinear>(), inviscid, X};
    e.law.flow.tangent = 0;
    const double yield = e.law.flow.yield;
    double gone = 0, work = 0, left = 0;
    for (int step = 0; step < steps; ++step) {
      Corners u = e.x;
      const double curvature = 10.0 / steps * yield / e.law.young;
      for (int i = 0; i < 8; ++i) u[i].x += curvature * X[i].x * X[i].y;
      const Corners before = e.force, from = e.x;
      const auto report = e.move(u);
      gone += report[Stored::elastic] + report[Dissipated::plastic];
      work -= 0.5 * (product(sum(before, e.force), sum(u, from, -1.0)));
      for (const double at : e.memory.across) left = std::max(left, std::abs(at) / 8 / yield);
    }
    double moment = 0;
    for (int i = 0; i < 8; ++i)
      if (X[i].x > 0) moment -= e.force[i].x * X[i].y;
    std::printf("bent to ten times the yield curvature in %d steps: moment over the plastic one %.4f, most across %.3g of yield\n", steps,
                moment / (yield * h * h * h / 4), left);
    EXPECT_NEAR(moment / (yield * h * h * h / 4), 4.0 / 3, 0.1);
    EXPECT_NEAR(gone, work, 1e-3 * work);
  }
}

/// The smallest stiffness of the inner nodes of 4 x 4 x 4 cubes that were squeezed along z, stresses included, over Young's modulus times
/// their side; sides are held, or move outwards as those of a free bar. The nodes outside stand.
template <class Kind>
double least_stiffness(double squeezed, bool sides_held, const typename Kind::Options& options) {
  using One = OneElement<Kind, Elastic>;
  constexpr int n = 4, inner = n - 1, steps = 200;
  constexpr double small = 1e-6;
  const Elastic law = metal<Elastic>();
  const double wide = sides_held ? 0 : law.poisson;
  const double width = std::pow(squeezed, -wide);
  One squeezed_cube{law, options, brick(1, 1, 1)};
  for (int i = 1; i <= steps; ++i) {
    const double z = 1 - (1 - squeezed) * i / steps, side = std::pow(z, -wide);
    squeezed_cube.move(times(Vec3(side, side, z).asDiagonal().toDenseMatrix(), squeezed_cube.X));
  }
  // all cubes are alike: what one node's motion pulls at the others follows from its eight
  const auto forces = [&](int corner, int axis, double by) {
    One e = squeezed_cube;
    Corners to = e.x;
    to[static_cast<std::size_t>(corner)][axis] += by;
    e.move(to);
    return e.force;
  };
  const auto row = [](int i, int j, int k) { return 3 * ((k * inner + j) * inner + i); };
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * inner * inner * inner, 3 * inner * inner * inner);
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      const Corners pull = sum(forces(corner, axis, small), forces(corner, axis, -small), -1);
      for (int at = 0; at < 8; ++at)
        for (int k = 0; k < n; ++k)
          for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {  // cube i, j, k: its corner of sign + is node i, j, k inside
              const auto inside = [&](int a, std::array<int, 3>& node) {
                const int cube[3] = {i, j, k};
                for (int d = 0; d < 3; ++d) node[static_cast<std::size_t>(d)] = cube[d] - (sign[a][d] < 0);
                return std::ranges::all_of(node, [](int d) { return d >= 0 && d < inner; });
              };
              std::array<int, 3> moved, pulled;
              if (!inside(corner, moved) || !inside(at, pulled)) continue;
              for (int d = 0; d < 3; ++d)
                K(row(pulled[0], pulled[1], pulled[2]) + d, row(moved[0], moved[1], moved[2]) + axis) -=
                    pull[static_cast<std::size_t>(at)][d] / (2 * small);
            }
    }
  const Eigen::MatrixXd both = 0.5 * (K + K.transpose());
  return eigenvalues(both).minCoeff() / law.young / width;
}

TEST(FullHexahedron, HoldsASqueezedBlockTogether) {
  // squeezed to 0.3 the law itself gives way: its stress is of the size of its moduli
  for (const bool held : {true, false})
    for (const double to : {1.0, 0.9, 0.7, 0.5, 2.0}) {
      const double eight = least_stiffness<FullHexahedron>(to, held, inviscid);
      const double one = least_stiffness<Hexahedron>(to, held, {.viscosity = no_viscosity});
      std::printf("squeezed to %.1f, sides %s: least stiffness %.3f with eight points, %.3f with one\n", to, held ? "held" : "free",
                  eight, one);
      EXPECT_GT(eight, 0.3);
      EXPECT_GT(one, 0.3);
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

/// How far the stresses xy and xx of simple shear are from those of an exact curve, over the shear modulus, at any point and any step.
template <class Law, class Exact>
double worst_of_shear(const Law& law, int steps, Exact&& exact) {
  const Mat3 skew = (Mat3() << 1, 0.3, -0.2, 0, 0.8, 0.4, 0, 0, 1.2).finished();
  const double mu = material::shear_modulus(law), increment = 1e-3;
  double worst = 0;
  for (const Corners& X : {brick(1, 1, 1), times(skew, brick(1, 1, 1)), distorted(0.2)}) {
    Element<Law> e{law, {}, X};
    for (int step = 1; step <= steps; ++step) {
      Mat3 F = Mat3::Identity();
      F(0, 1) = increment * step;
      e.move(times(F, e.X));
      const auto [xy, xx] = exact(F(0, 1));
      for (const auto* s : stresses(e.memory)) worst = std::max({worst, std::abs(s->xy / mu - xy), std::abs(s->xx / mu - xx)});
    }
  }
  return worst;
}

TEST(FullHexahedron, LargeSimpleShearFollowsTheRateOfJaumannWhereALawMayFlow) {
  const J2Bilinear never_flows{2.0, 3.0, 0.3, {1e9, 0}};
  const auto exact = [](double gamma) { return std::pair(std::sin(gamma), 1 - std::cos(gamma)); };
  EXPECT_LT(worst_of_shear(never_flows, 4000, exact), 1e-4);  // of catalogues of hypoelastic shear, at this increment
}

TEST(FullHexahedron, LargeSimpleShearFollowsTheLogarithmicStrain) {
  const auto exact = [](double gamma) { return std::pair(2 * logarithmic_shear(gamma), gamma * logarithmic_shear(gamma)); };
  EXPECT_LT(worst_of_shear(metal<Elastic>(), 1800, exact), 1e-3);
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
      const double closed = eigenvalues(M).maxCoeff();
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
    double smallest = 1e300, highest = 0;
    for (int trial = 0; trial < 700; ++trial) {
      const Element<Elastic> e{metal<Elastic>(random(-0.5, 0.499)), inviscid, random_shape(part)};
      if (Element<Elastic>(e).step(e.X, Corners{}, 1.0).volume_ratio <= 0) continue;
      const double ratio = std::sqrt(hot_bound(e) / largest_eigenvalue_of(e));
      smallest = std::min(smallest, ratio), highest = std::max(highest, ratio);
    }
    std::printf("corners moved by up to %.1f of the shortest side: bound over exact frequency %.4f to %.4f\n", part, smallest, highest);
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

TEST(FullHexahedron, ViscosityIsThatOfTheOnePointElement) {
  const Corners v = random_field(0.1);
  const Viscosity viscosity{.linear = 0.2, .quadratic = 1.2};
  material::J2Bilinear stiff = metal<material::J2Bilinear>();  // with the logarithmic rate points have rates of their own
  stiff.flow.yield = 1e9;
  Element<material::J2Bilinear> e{stiff, {.viscosity = viscosity}, brick(1, 1, 1)};
  OneElement<Hexahedron, material::J2Bilinear> one{e.law, {.hourglass = 0.1, .viscosity = viscosity}, e.X};
  for (int step = 0; step < 3; ++step) {
    const auto report = e.step(e.X, v, 1.0);
    const auto same = one.step(e.X, v, 1.0);
    EXPECT_NEAR(report[Dissipated::viscous], same[Dissipated::viscous], 1e-14);
    EXPECT_NEAR(report.step, same.step, 1e-13);
    EXPECT_LT((full(e.memory.viscous) - full(one.memory.viscous)).norm(), 1e-13);
  }
}

TEST(FullHexahedron, InvertedElementHasNegativeSize) {
  Element<Elastic> e{metal<Elastic>(), {}, brick(1, 1, 1)};
  EXPECT_NEAR(e.step(e.X, Corners{}, 1.0).volume_ratio, 1, 1e-14);
  Corners inside_out = e.X;
  for (Point& p : inside_out) p.z = -p.z;
  EXPECT_LT(e.step(inside_out, Corners{}, 1.0).volume_ratio, 0);
}

}  // namespace
}  // namespace nereid::element::full_hexahedron_test
