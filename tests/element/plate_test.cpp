#include "element/plate.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "base/dense.hpp"
#include "base/types.hpp"
#include "material/mixed_control.hpp"
#include "tests/base/chance.hpp"
#include "tests/element/metal.hpp"

namespace nereid::element::plate_test {
namespace {

using material::Elastic;
using material::J2Bilinear;
using material::J2Mixed;
using Point = Vector<double>;
using Corners = std::array<Point, 3>;
using Matrix18 = Eigen::MatrixXd;  // 18 x 18; of a fixed size it compiles far longer

// ------------------------------------------------------------------------------------------------
// Shapes, motions, and one element that remembers

Chance chance(11);
double random(double low = -1.0, double high = 1.0) {
  return std::uniform_real_distribution<double>(low, high)(chance);
}
Point random_point(double size) { return {size * random(), size * random(), size * random()}; }
Corners random_field(double size) {
  return {random_point(size), random_point(size), random_point(size)};
}

Corners sum(const Corners& a, const Corners& b, double factor = 1.0) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double product(const Corners& a, const Corners& b) {
  return dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2]);
}
double largest(const Corners& a) { return std::sqrt(product(a, a)); }

Mat3 random_rotation() {
  return Eigen::AngleAxisd(random(-3.0, 3.0), Vec3(random(), random(), random()).normalized())
      .toRotationMatrix();
}
Point times(const Mat3& A, const Point& p) {
  const Vec3 q = A * Vec3(p.x, p.y, p.z);
  return {q.x(), q.y(), q.z()};
}
Corners times(const Mat3& A, const Corners& x) {
  return {times(A, x[0]), times(A, x[1]), times(A, x[2])};
}

/// A triangle of any tilt, with sides about 1 and no angle near zero.
Corners triangle() {
  const Corners flat{{{0, 0, 0},
                      {1 + random(-0.2, 0.2), random(-0.2, 0.2), 0},
                      {random(0.1, 0.7), random(0.6, 1.1), 0}}};
  return times(random_rotation(), flat);
}
Corners flat_triangle(double x2, double x3, double y3) {
  return {{{0, 0, 0}, {x2, 0, 0}, {x3, y3, 0}}};
}

Plate::Options thick(double thickness,
                     Plate::RotaryInertia inertia = Plate::RotaryInertia::physical) {
  return {.thickness = thickness,
          .layers = 5,
          .rotary_inertia = inertia,
          .viscosity = {.linear = 0, .quadratic = 0},
          .drilling = 0};
}

template <class Law>
struct Element {
  Law law;
  Plate::Options options;
  Corners X;
  Layers layers = gauss_layers(options.layers);
  Plate::Constants<double> constants = element::constants(law, options, X);
  Plate::Memory<double, Law> memory{};
  Corners x = X, force{}, moment{};

  /// displacements du and rotations turn in one step that ends at `to`
  auto step(const Corners& to, const Corners& du, const Corners& turn, double dt = 1.0) {
    x = to;
    return advance(law, options, layers, constants, {1.0}, to, du, turn, dt, memory, force, moment);
  }
  auto move(const Corners& du, const Corners& turn) { return step(sum(x, du), du, turn); }
  void rest() { step(x, Corners{}, Corners{}, 1.0); }
  void randomise(double stress) {
    for (int l = 0; l < options.layers; ++l) {
      memory.layers[l].stress = {stress * random(), stress * random(), stress * random()};
      for (auto& tensor : memory.layers[l].internal.tensor)
        tensor = 0.3 * material::deviator(Plane<double>{stress * random(), stress * random(), stress * random()});
    }
    memory.shear = {stress * random(), stress * random()};
    for (double& each : memory.drilling) each = stress * options.drilling * random();
  }
  double work(const Corners& du, const Corners& turn) const {
    return product(force, du) + product(moment, turn);
  }
};

/// What a step stores by transverse shear: in the shear itself, and in the bending within the element that it makes. [J]
template <class Report>
double of_shear(const Report& report) { return report[Stored::transverse_shear] + report[Stored::residual_bending]; }

/// What an unstressed element answers to a small motion, on the reference shape. Forces are
/// proportional to the increment, so nothing cancels; of motion and counter-motion half the
/// difference is taken, which leaves an error of the third order.
template <class Law>
Element<Law> answer(const Law& law, const Plate::Options& options, const Corners& X,
                    const Corners& du, const Corners& turn) {
  Element<Law> there{law, options, X}, back{law, options, X};
  there.step(X, du, turn);
  back.step(X, sum(Corners{}, du, -1.0), sum(Corners{}, turn, -1.0));
  there.force = sum(there.force, back.force, -1.0),
  there.moment = sum(there.moment, back.moment, -1.0);
  for (int a = 0; a < 3; ++a)
    there.force[a] = 0.5 * there.force[a], there.moment[a] = 0.5 * there.moment[a];
  for (int l = 0; l < options.layers; ++l)
    there.memory.layers[l].stress =
        0.5 * (there.memory.layers[l].stress - back.memory.layers[l].stress);
  there.memory.shear = {0.5 * (there.memory.shear.x - back.memory.shear.x),
                        0.5 * (there.memory.shear.y - back.memory.shear.y)};
  return there;
}

/// Stiffness by node: three displacements, three rotations.
template <class Law>
Matrix18 stiffness(const Law& law, const Plate::Options& options, const Corners& X) {
  constexpr double small = 1e-6;
  Matrix18 K(18, 18);
  for (int j = 0; j < 18; ++j) {
    Corners du{}, turn{};
    (j % 6 < 3 ? du : turn)[j / 6][j % 3] = small;
    const auto e = answer(law, options, X, du, turn);
    for (int i = 0; i < 18; ++i) K(i, j) = -(i % 6 < 3 ? e.force : e.moment)[i / 6][i % 3] / small;
  }
  return 0.5 * (K + K.transpose());
}

Eigen::Matrix2d full(const Plane<double>& p) {
  return (Eigen::Matrix2d() << p.xx, p.xy, p.xy, p.yy).finished();
}

/// Resultants in the global frame.
struct Resultants {
  Mat3 membrane = Mat3::Zero(), bending = Mat3::Zero();  // [Pa] [Pa m]
  Vec3 shear = Vec3::Zero();                             // [N/m]
};
template <class Law>
Resultants resultants(const Element<Law>& e) {
  const auto [e1, e2, e3] = plate_shape(e.x).frame;
  Eigen::Matrix<double, 3, 2> Q;
  Q << e1.x, e2.x, e1.y, e2.y, e1.z, e2.z;
  Resultants r;
  for (int l = 0; l < e.options.layers; ++l) {
    const Mat3 s = Q * full(e.memory.layers[l].stress) * Q.transpose();
    r.membrane += e.layers.weight[l] * s;
    r.bending += e.layers.weight[l] * e.layers.z[l] * e.options.thickness * s;
  }
  r.shear = e.options.thickness * Q * Eigen::Vector2d(e.memory.shear.x, e.memory.shear.y);
  return r;
}

/// The step of a rigid rotation: the increment of position, and Cayley's vector at every node.
struct Turn {
  Corners du, turn;
};
Turn rigid(const Corners& x, const Vec3& axis, double angle) {
  const Mat3 Q = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  const Vec3 w = 2 * std::tan(angle / 2) * axis;
  const Point p{w.x(), w.y(), w.z()};
  return {sum(times(Q, x), x, -1.0), {p, p, p}};
}

// ------------------------------------------------------------------------------------------------
// Motions, over all laws

template <class Law>
class PlateOf : public ::testing::Test {};
TYPED_TEST_SUITE(PlateOf, material::PlateLaws);

TYPED_TEST(PlateOf, RigidRotationByAFiniteAngleTurnsResultantsAndNothingElse) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<TypeParam> e{metal<TypeParam>(), {.thickness = 0.1, .viscosity = {}}, triangle()};
    e.randomise(0.005);
    const auto before = e.memory;
    const auto [du, turn] =
        rigid(e.x, Vec3(random(), random(), random()).normalized(), random(-2.5, 2.5));
    const auto report = e.move(du, turn);
    for (int l = 0; l < e.options.layers; ++l)
      EXPECT_LT((full(e.memory.layers[l].stress) - full(before.layers[l].stress)).norm(), 1e-13);
    EXPECT_NEAR(e.memory.shear.x, before.shear.x, 1e-14);
    EXPECT_NEAR(e.memory.shear.y, before.shear.y, 1e-14);
    EXPECT_NEAR(report.stored[0], 0, 1e-16);
    EXPECT_NEAR(of_shear(report), 0, 1e-16);
    EXPECT_EQ(report[Dissipated::plastic], 0);
    EXPECT_NEAR(report[Dissipated::viscous], 0, 1e-16);
    EXPECT_NEAR(report.volume_ratio, 1, 1e-13);
  }
}

TYPED_TEST(PlateOf, TenTurnsAboutAnyAxisKeepResultantsAndTheStoredEnergy) {
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.36, -0.48, 0.8)}) {
    Element<TypeParam> e{metal<TypeParam>(), thick(0.1), triangle()};
    e.move(random_field(1e-3), random_field(1e-3));
    const auto start = e.memory;
    double size = 0, stored = 0, drift = 0;
    for (int l = 0; l < 5; ++l) size = std::max(size, full(start.layers[l].stress).norm());
    for (int step = 0; step < 1000; ++step) {
      const auto [du, turn] = rigid(e.x, axis, 2 * pi / 100);
      const auto report = e.move(du, turn);
      stored += std::abs(report.stored[0]) + std::abs(of_shear(report));
    }
    for (int l = 0; l < 5; ++l)
      drift = std::max(
          drift, (full(e.memory.layers[l].stress) - full(start.layers[l].stress)).norm() / size);
    drift = std::max(
        drift, std::hypot(e.memory.shear.x - start.shear.x, e.memory.shear.y - start.shear.y) /
                   (0.1 * size));
    ::testing::Test::RecordProperty("drift", std::to_string(drift * 1e12) + "e-12");
    EXPECT_LT(drift, 1e-9);
    EXPECT_LT(stored, 1e-8 * size * size / e.law.young * 0.1);
  }
}

TEST(PlateThatHardens, CarriesItsBackStressAlongThroughTenTurnsAndAnswersTheNextLoadAsIfItHadNotTurned) {
  for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0.36, -0.48, 0.8)}) {
    Element<J2Mixed> e{metal<J2Mixed>(), thick(0.1), triangle()};
    const Point along = (1.0 / norm(e.X[1] - e.X[0])) * (e.X[1] - e.X[0]);
    Corners stretch;  // yield strain is 1 %: 6 % out and, after the turns, 5 % back
    for (int a = 0; a < 3; ++a) stretch[a] = dot(e.X[a] - e.X[0], along) * along;
    EXPECT_GT(e.move(sum(random_field(0.005), stretch, 0.06), random_field(0.005))[Dissipated::plastic], 0);
    const auto start = e.memory;
    const Corners at_start = e.x, du = sum(random_field(0.005), stretch, -0.05), turns = random_field(0.005);
    Element<J2Mixed> still = e;
    double size = 0, drift = 0, plastic = 0;
    for (int step = 0; step < 1017; ++step) {  // ten turns and a bit
      const auto [by, turn] = rigid(e.x, axis, 2 * pi / 100);
      plastic += e.move(by, turn)[Dissipated::plastic];
    }
    for (int l = 0; l < 5; ++l) {
      const auto& back = start.layers[l].internal.tensor[0];
      size = std::max(size, full(back).norm());
      drift = std::max(drift, (full(e.memory.layers[l].internal.tensor[0]) - full(back)).norm());
    }
    EXPECT_GT(size, 0.1 * e.law.yield);
    ::testing::Test::RecordProperty("drift_of_back_stress", std::to_string(drift / size * 1e12) + "e-12");
    EXPECT_LT(drift, 1e-9 * size);  // that of the stress
    EXPECT_LT(plastic, 1e-12 * e.law.yield);  // round-off of a stress on the surface
    const Mat3 R = Eigen::AngleAxisd(2 * pi * 1017 / 100, axis).toRotationMatrix();
    const auto report = e.step(sum(e.x, times(R, du)), times(R, du), times(R, turns)),
                         expected = still.step(sum(at_start, du), du, turns);
    EXPECT_GT(expected[Dissipated::plastic], 0);
    EXPECT_NEAR(report[Dissipated::plastic], expected[Dissipated::plastic], 1e-9 * expected[Dissipated::plastic]);
    EXPECT_LT(largest(sum(e.force, times(R, still.force), -1.0)), 1e-9 * largest(still.force));
    EXPECT_LT(largest(sum(e.moment, times(R, still.moment), -1.0)), 1e-9 * largest(still.force));
  }
}

TEST(PlateThatHardens, TurnsItsBackStressAgainstTheElementsAxesAsItTurnsTheStress) {
  // Stress and back stress start alike. A strain that shears makes the material spin against side 1-2;
  // taking off the stress that it adds leaves both turned alike.
  Element<J2Mixed> e{metal<J2Mixed>(), thick(0.1), triangle()};
  e.law.yield = 1e3;  // no flow
  const Plane<double> prestress{0.01, -0.02, 0.013};
  Element<J2Mixed> bare = e;
  for (int l = 0; l < 5; ++l) e.memory.layers[l].stress = e.memory.layers[l].internal.tensor[0] = prestress;
  const auto [e1, e2, e3] = plate_shape(e.X).frame;
  const Point oblique = std::sqrt(0.5) * (e1 + e2);
  Corners du = random_field(0.01);
  for (int a = 0; a < 3; ++a) du[a] = du[a] + 0.1 * dot(e.X[a] - e.X[0], oblique) * oblique;
  e.move(du, Corners{});
  bare.move(du, Corners{});
  EXPECT_GT((full(e.memory.layers[0].internal.tensor[0]) - full(prestress)).norm(), 1e-4);
  for (int l = 0; l < 5; ++l) {
    const Plane<double> turned = e.memory.layers[l].stress - bare.memory.layers[l].stress;
    EXPECT_LT((full(e.memory.layers[l].internal.tensor[0]) - full(turned)).norm(), 1e-15);
  }
}

TYPED_TEST(PlateOf, ForcesAndMomentsHaveNoNetForceAndNoNetMoment) {
  for (int trial = 0; trial < 50; ++trial) {
    Element<TypeParam> e{metal<TypeParam>(), {.thickness = 0.1, .viscosity = {}}, triangle()};
    e.randomise(0.01);
    e.step(sum(e.X, random_field(0.1)), random_field(1e-2), random_field(1e-2), 0.1);
    Point force{}, moment{};
    for (int a = 0; a < 3; ++a)
      force = force + e.force[a], moment = moment + e.moment[a] + cross(e.x[a], e.force[a]);
    EXPECT_LT(norm(force), 1e-14 * 10 * largest(e.force));
    EXPECT_LT(norm(moment), 1e-14 * 10 * largest(e.force));
  }
}

TYPED_TEST(PlateOf, ForceAndMomentAreTheGradientOfTheStoredEnergy) {
  for (int trial = 0; trial < 10; ++trial) {
    const Corners X = triangle(), u = random_field(1e-5), t = random_field(1e-5);
    const Corners du = random_field(1e-6), turn = random_field(1e-6);
    const auto stored = [&](double s) {
      Element<TypeParam> e{metal<TypeParam>(), thick(0.3), X};
      const auto report = e.move(sum(u, du, s), sum(t, turn, s));
      EXPECT_GT(report.stored[0], 0);
      EXPECT_GT(of_shear(report), 0);
      return report.stored[0] + of_shear(report);
    };
    Element<TypeParam> e{metal<TypeParam>(), thick(0.3), X};
    e.move(u, t);
    EXPECT_NEAR(-2 * e.work(du, turn), stored(1) - stored(-1),
                1e-4 * 2 * largest(e.force) * largest(du));
  }
}

TYPED_TEST(PlateOf, WorkAndStoredEnergyDifferInTheThirdOrderOfTheStep) {
  Element<TypeParam> start{metal<TypeParam>(), thick(0.2), triangle()};
  start.randomise(0.003);
  start.rest();
  const Corners u = random_field(1.0), t = random_field(1.0);
  const auto error = [&](double s) {
    Element<TypeParam> e = start;
    const Corners du = sum(Corners{}, u, s), turn = sum(Corners{}, t, s);
    const auto report = e.move(du, turn);
    return 0.5 * (start.work(du, turn) + e.work(du, turn)) + report.stored[0] + of_shear(report) +
           report[Dissipated::plastic];
  };
  EXPECT_NEAR(error(1e-3) / error(5e-4), 8.0, 0.3);
}

TYPED_TEST(PlateOf, AdvanceIsFrameIndifferent) {
  for (int trial = 0; trial < 20; ++trial) {
    Element<TypeParam> e{metal<TypeParam>(), {.thickness = 0.1, .viscosity = {}}, triangle()};
    e.randomise(0.02);
    const Mat3 R = random_rotation();
    Element<TypeParam> turned = e;  // memory is in the element's own axes
    const Corners to = sum(e.X, random_field(0.05)), du = random_field(0.05),
                  turn = random_field(0.05);
    const auto report = e.step(to, du, turn, 0.1);
    const auto same = turned.step(times(R, to), times(R, du), times(R, turn), 0.1);
    EXPECT_LT(largest(sum(turned.force, times(R, e.force), -1.0)), 1e-12 * largest(e.force));
    EXPECT_LT(largest(sum(turned.moment, times(R, e.moment), -1.0)), 1e-12 * largest(e.force));
    for (int l = 0; l < e.options.layers; ++l)
      EXPECT_LT((full(turned.memory.layers[l].stress) - full(e.memory.layers[l].stress)).norm(),
                1e-13);
    EXPECT_NEAR(same.stored[0], report.stored[0], 1e-14);
    EXPECT_NEAR(of_shear(same), of_shear(report), 1e-14);
    EXPECT_NEAR(same[Dissipated::plastic], report[Dissipated::plastic], 1e-14);
    EXPECT_NEAR(same[Dissipated::viscous], report[Dissipated::viscous], 1e-14);
    EXPECT_NEAR(same.step, report.step, 1e-12 * report.step);
  }
}

TYPED_TEST(PlateOf, NumberingOfTheNodesChangesResultsInTheThirdOrderOfTheStepOnly) {
  const Corners X = triangle(), u = random_field(1.0), t = random_field(1.0);
  const auto shifted = [](const Corners& a) { return Corners{a[1], a[2], a[0]}; };
  const auto difference = [&](double s) {
    Element<TypeParam> e{metal<TypeParam>(), thick(0.2), X},
        other{metal<TypeParam>(), thick(0.2), shifted(X)};
    for (int step = 0; step < 3; ++step) {
      const Corners du = sum(Corners{}, u, s), turn = sum(Corners{}, t, s);
      e.move(du, turn);
      other.move(shifted(du), shifted(turn));
    }
    return largest(sum(other.force, shifted(e.force), -1.0)) +
           largest(sum(other.moment, shifted(e.moment), -1.0));
  };
  EXPECT_LT(difference(1e-5), 1e-12);
  EXPECT_NEAR(difference(4e-4) / difference(2e-4), 8.0, 0.5);  // so short that nothing flows: a kink has no order
}

TYPED_TEST(PlateOf, PacksAndDoublesAgree) {
  std::array<Element<TypeParam>, lanes> one;
  std::array<Corners, lanes> to, dx, turn;
  std::array<Vector<Pack>, 3> xs, dxs, turns, fs, ms;
  Plate::Constants<Pack> constants;
  Plate::Memory<Pack, TypeParam> memory;
  const Plate::Options options{.thickness = 0.1, .viscosity = {}, .drilling = 0.01};
  for (int l = 0; l < lanes; ++l) {
    one[l] = Element<TypeParam>{metal<TypeParam>(), options, triangle()};
    one[l].randomise(0.02);
    to[l] = sum(one[l].X, random_field(0.05)), dx[l] = random_field(0.03), turn[l] = random_field(0.03);
    for (int i = 0; i < 9; ++i) {
      (&xs[i / 3].x)[i % 3][l] = to[l][i / 3][i % 3];
      (&dxs[i / 3].x)[i % 3][l] = dx[l][i / 3][i % 3];
      (&turns[i / 3].x)[i % 3][l] = turn[l][i / 3][i % 3];
    }
    constants.mass[l] = one[l].constants.mass, constants.gyration[l] = one[l].constants.gyration;
    std::vector<double> rows;
    one[l].memory.each_row([&](double& row) { rows.push_back(row); }, options);
    std::size_t r = 0;
    memory.each_row([&](Pack& row) { row[l] = rows[r++]; }, options);
    EXPECT_EQ(static_cast<int>(r), (Plate::Memory<double, TypeParam>::rows(options)));
  }
  const auto all = advance(one[0].law, one[0].options, one[0].layers, constants, {Pack(1.0)}, xs, dxs, turns,
                                   Pack(0.1), memory, fs, ms);
  for (int l = 0; l < lanes; ++l) {
    Element<TypeParam>& e = one[l];
    const auto report = advance(e.law, e.options, e.layers, e.constants, {1.0}, to[l], dx[l],
                                          turn[l], 0.1, e.memory, e.force, e.moment);
    for (int i = 0; i < 9; ++i) {
      EXPECT_NEAR((&fs[i / 3].x)[i % 3][l], e.force[i / 3][i % 3], 1e-13 * largest(e.force));
      EXPECT_NEAR((&ms[i / 3].x)[i % 3][l], e.moment[i / 3][i % 3], 1e-13 * largest(e.force));
    }
    EXPECT_NEAR(all.step[l], report.step, 1e-13 * report.step);
    EXPECT_NEAR(all.stored[0][l], report.stored[0], 1e-15);
    EXPECT_NEAR(all.stored[1][l], report.stored[1], 1e-15);
    EXPECT_NEAR(all.stored[2][l], report.stored[2], 1e-15);
    EXPECT_NEAR(all.stored[3][l], report.stored[3], 1e-15);
    EXPECT_NEAR(all[Dissipated::plastic][l], report[Dissipated::plastic], 1e-15);
    EXPECT_NEAR(all[Dissipated::viscous][l], report[Dissipated::viscous], 1e-15);
  }
}

TYPED_TEST(PlateOf, MassIsDensityTimesVolumeAndRotaryInertiaIsPositive) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners X = triangle();
    for (const auto inertia : {Plate::RotaryInertia::physical, Plate::RotaryInertia::scaled}) {
      const Element<TypeParam> e{metal<TypeParam>(), thick(0.1, inertia), X};
      const double area = 0.5 * norm(cross(X[1] - X[0], X[2] - X[0]));
      EXPECT_NEAR(e.constants.mass, 2.0 * 0.1 * area, 1e-15);
      EXPECT_GE(e.constants.gyration, 0.01 / 12);  // one number for all axes: isotropic
    }
  }
}

TYPED_TEST(PlateOf, InPlaneCompressionIsDampedByViscosity) {
  Element<TypeParam> e{metal<TypeParam>(), {.thickness = 0.1, .viscosity = {}}, triangle()};
  const Point centre = (1.0 / 3.0) * (e.X[0] + e.X[1] + e.X[2]);
  Corners du;
  for (int a = 0; a < 3; ++a) du[a] = -1e-3 * (e.X[a] - centre);
  for (int step = 0; step < 5; ++step)
    EXPECT_GT(e.step(sum(e.x, du), du, Corners{}, 0.01)[Dissipated::viscous], 0);
}

// ------------------------------------------------------------------------------------------------
// Thickness

/// Stretches an element by strain increments xx and yy of the middle of each step.
template <class Law>
void stretch(Element<Law>& e, double xx, double yy) {
  Corners to;
  for (int a = 0; a < 3; ++a) to[a] = {e.x[a].x * (1 + xx / 2) / (1 - xx / 2), e.x[a].y * (1 + yy / 2) / (1 - yy / 2), 0};
  e.step(to, sum(to, e.x, -1.0), Corners{});
}

/// The metal without the heat of plastic work, which goes by the volume that an element has.
template <class Law>
Law cold_metal() {
  Law law = metal<Law>();
  if constexpr (requires { law.flow.heat_share; }) law.flow.heat_share = 0;
  return law;
}

TYPED_TEST(PlateOf, FollowsTheStrainThatItsLawHasInSpaceWhereTheThicknessIsFree) {
  for (const auto& [xx, yy] : {std::pair{1e-3, -0.4e-3}, {1e-3, 1e-3}, {-0.5e-3, 0.1e-3}}) {
    Plate::Options options = thick(0.1);
    options.thinning = Plate::Thinning::follows_strain;
    Element<TypeParam> e{cold_metal<TypeParam>(), options, flat_triangle(1.0, 0.3, 0.8)};
    auto point = material::point_of<Symmetric>(e.law);
    for (int step = 0; step < 500; ++step) {
      stretch(e, xx, yy);
      material::Goal<Symmetric> goal;
      goal.target[0] = xx * (step + 1), goal.target[1] = yy * (step + 1), goal.strain[2] = false;
      ASSERT_TRUE(advance(e.law, goal, point).found);
    }
    const double theta = point.strain.xx + point.strain.yy + point.strain.zz;
    const double thickness = thickness_left(e.law, e.layers, e.constants, e.x, e.memory);
    // an increment a of the middle's strain is a logarithm of a + a^3/12
    EXPECT_NEAR(std::log(thickness / 0.1), point.strain.zz, 1e-7 + 1.1 * std::pow(std::abs(theta), 5) / 720);
  }
}

/// Work of the nodal forces on a path of stretch and bending far beyond yield, less what was stored and dissipated, over the work.
template <class Law>
double unbooked(int steps) {
  Plate::Options options = thick(0.1);
  options.thinning = Plate::Thinning::follows_strain;
  Element<Law> e{metal<Law>(), options, flat_triangle(1.0, 0.3, 0.8)};
  double work = 0, booked = 0;
  for (int s = 0; s < steps; ++s) {
    const double h = 0.5 / steps;
    Corners to, turn{};
    for (int a = 0; a < 3; ++a) {
      to[a] = {e.x[a].x * (1 + h / 2) / (1 - h / 2), e.x[a].y * (1 - 0.1 * h) / (1 + 0.1 * h), 0};
      turn[a] = {0, 0.4 * h * e.X[a].x, 0};
    }
    const Corners du = sum(to, e.x, -1.0), force = e.force, moment = e.moment;
    const auto report = e.step(to, du, turn);
    work -= 0.5 * (product(force, du) + product(moment, turn) + e.work(du, turn));
    booked += report.stored[0] + of_shear(report) + report.dissipated[0];
  }
  return (work - booked) / work;
}

TYPED_TEST(PlateOf, ThinningDoesTheWorkThatItsLawStoresAndDissipates) {
  const double coarse = unbooked<TypeParam>(500), fine = unbooked<TypeParam>(2000);
  EXPECT_LT(std::abs(coarse), 1e-4);
  EXPECT_LT(std::abs(fine), 0.15 * std::abs(coarse)) << "a trapezoid rule, of second order but at the step that yields first";
}

TYPED_TEST(PlateOf, ThatKeepsItsThicknessHasTheSameStressAndTheForcesOfItsThickness) {
  Plate::Options keeps = thick(0.1), follows = thick(0.1);
  keeps.thinning = Plate::Thinning::constant, follows.thinning = Plate::Thinning::follows_strain;
  Element<TypeParam> one{cold_metal<TypeParam>(), keeps, flat_triangle(1.0, 0.3, 0.8)}, other{cold_metal<TypeParam>(), follows, one.X};
  for (int step = 0; step < 100; ++step) stretch(one, 2e-3, 1e-3), stretch(other, 2e-3, 1e-3);
  const double ratio = thickness_left(other.law, other.layers, other.constants, other.x, other.memory) / 0.1;
  EXPECT_LT(ratio, 0.9);
  EXPECT_EQ(one.memory.layers[0].stress.xx, other.memory.layers[0].stress.xx);
  EXPECT_LT(largest(sum(other.force, one.force, -ratio)), 1e-12 * largest(one.force));
}

TEST(Plate, IsHeatedByTheShareOfItsPlasticWork) {
  using material::J2JohnsonCook;
  Element<J2JohnsonCook> e{metal<J2JohnsonCook>(), thick(0.1), flat_triangle(1.0, 0.3, 0.8)};
  double dissipated = 0, kept = 0;
  const double start = e.memory.layers[0].internal.scalar[1];
  for (int step = 0; step < 100; ++step) {
    Corners to = e.x, turn{};
    for (int a = 0; a < 3; ++a) to[a] = {e.x[a].x * 1.001, e.x[a].y * 0.9995, 0}, turn[a] = {0, 2e-4 * e.X[a].x, 0};
    dissipated += e.step(to, sum(to, e.x, -1.0), turn).dissipated[0];
  }
  for (int l = 0; l < e.layers.count; ++l)
    kept += e.layers.weight[l] * (e.memory.layers[l].internal.scalar[1] - start) * e.law.flow.specific_heat;
  EXPECT_GT(dissipated, 0);
  EXPECT_NEAR(kept * e.constants.mass / (e.law.flow.heat_share * dissipated), 1, 1e-4) << "half of what a step changes in the volume";
}

TEST(Plate, AtAHighRateHasTheStressOfItsLayersAtItsSurfaces) {
  using material::J2Curve;
  Element<J2Curve> e{metal<J2Curve>(), thick(0.1), flat_triangle(1.0, 0.3, 0.8)};
  e.law.flow.cowper_rate = 1e-6;  // far below the rates here
  for (int step = 0; step < 100; ++step) {
    Corners to = e.x, turn{};
    for (int a = 0; a < 3; ++a) to[a] = {e.x[a].x * 1.001, e.x[a].y * 0.9995, 0}, turn[a] = {0, 5e-3 * e.X[a].x, 0};
    e.step(to, sum(to, e.x, -1.0), turn);
  }
  const auto surface = at_place(e.law, e.layers, e.memory, Place::top);
  const auto& outer = e.memory.layers[e.layers.count - 1];
  const double over = material::von_mises(outer.stress) / yield_stress(e.law, outer.internal.scalar);
  EXPECT_GT(over, 3);
  EXPECT_GT(material::von_mises(surface.stress), material::von_mises(outer.stress)) << "it bends: the surface is strained more";
  // the limit: the flow stress of the surface at the rate of the layers beside it, of which the inner one is hardly slower
  const auto& inner = e.memory.layers[e.layers.count - 2];
  const double most = std::max(over, material::von_mises(inner.stress) / yield_stress(e.law, inner.internal.scalar));
  EXPECT_LE(material::von_mises(surface.stress), most * yield_stress(e.law, surface.internal.scalar) * (1 + 1e-12));
}

TEST(Plate, ThinsByItselfWhereItsLawFlows) {
  EXPECT_FALSE(Plate::thins<Elastic>({.viscosity = {}}));
  EXPECT_TRUE(Plate::thins<J2Bilinear>({.viscosity = {}}));
  EXPECT_TRUE(Plate::thins<J2Mixed>({.viscosity = {}}));
  EXPECT_TRUE(Plate::thins<material::J2Curve>({.viscosity = {}}));
  EXPECT_TRUE(Plate::thins<material::J2JohnsonCook>({.viscosity = {}}));
  EXPECT_FALSE(Plate::thins<J2Mixed>({.viscosity = {}, .thinning = Plate::Thinning::constant}));
  EXPECT_TRUE(Plate::thins<Elastic>({.viscosity = {}, .thinning = Plate::Thinning::follows_strain}));
}

/// A plate that keeps its thickness gains volume and no mass: its step is that of the stiffness that it has.
TEST(Plate, StretchedWithItsThicknessKeptHasAStepShorterByTheRootOfItsArea) {
  Plate::Options options = thick(0.1);
  options.thinning = Plate::Thinning::constant;
  Element<J2Bilinear> e{metal<J2Bilinear>(), options, flat_triangle(1.0, 0.3, 0.8)};
  for (int step = 0; step < 200; ++step) stretch(e, 3e-3, 3e-3);
  const auto report = e.step(e.x, Corners{}, Corners{});
  const PlateShape<double> now = plate_shape(e.x), before = plate_shape(e.X);
  const auto bound = largest_frequencies_squared(material::lame(e.law), e.law.density, 0.1, e.constants.gyration, now);
  const double worst = std::max(bound.membrane, bound.bending_and_shear);
  EXPECT_NEAR(report.step, 2 / std::sqrt(worst) * std::sqrt(before.area / now.area), 1e-12 * report.step);
}

// ------------------------------------------------------------------------------------------------
// Patch tests on an irregular patch

struct Patch {
  std::vector<Point> X;
  std::vector<std::array<int, 3>> triangles;
  std::vector<bool> inside;
};

/// A square of 4 x 4 cells with jittered inner nodes and diagonals that alternate.
Patch irregular_patch() {
  Patch p;
  constexpr int n = 4;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double jitter = inside ? 0.3 : 0.0;
      p.X.push_back({(i + jitter * random()) / n, (j + jitter * random()) / n, 0});
      p.inside.push_back(inside);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
      if ((i + j) % 2 == 0)
        p.triangles.insert(p.triangles.end(), {{a, b, c}, {c, d, a}});
      else
        p.triangles.insert(p.triangles.end(), {{b, c, d}, {d, a, b}});
    }
  }
  return p;
}

struct PatchAnswer {
  std::vector<Resultants> elements;
  double force_inside = 0, moment_inside = 0, largest_force = 0, largest_moment = 0;
  Point moment{};
};

/// Gives the patch, turned in space, the fields displacement(x, y) and rotation(x, y); results in
/// the frame of the flat patch.
template <class Field, class Rotation>
PatchAnswer put_on_patch(Field&& displacement, Rotation&& rotation, double thickness = 0.05, const Patch& patch = irregular_patch()) {
  const Mat3 R = random_rotation();
  std::vector<Point> force(patch.X.size()), moment(patch.X.size());
  PatchAnswer result;
  for (const auto& nodes : patch.triangles) {
    Corners X, du, turn;
    for (int a = 0; a < 3; ++a) {
      const Point& at = patch.X[nodes[a]];
      X[a] = times(R, at), du[a] = times(R, 1e-7 * displacement(at.x, at.y)),
      turn[a] = times(R, 1e-7 * rotation(at.x, at.y));
    }
    const auto e = answer(metal<Elastic>(), thick(thickness), X, du, turn);
    Resultants r = resultants(e);
    r.membrane = 1e7 * R.transpose() * r.membrane * R,
    r.bending = 1e7 * R.transpose() * r.bending * R;
    r.shear = 1e7 * R.transpose() * r.shear;
    result.elements.push_back(r);
    for (int a = 0; a < 3; ++a) {
      const Point f = times(1e7 * R.transpose(), e.force[a]),
                  m = times(1e7 * R.transpose(), e.moment[a]);
      force[nodes[a]] = force[nodes[a]] + f, moment[nodes[a]] = moment[nodes[a]] + m;
      result.largest_force = std::max(result.largest_force, norm(f));
      result.largest_moment = std::max(result.largest_moment, norm(m));
      result.moment = result.moment + m;
    }
  }
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (!patch.inside[n]) continue;
    result.force_inside = std::max(result.force_inside, norm(force[n]));
    result.moment_inside = std::max(result.moment_inside, norm(moment[n]));
  }
  return result;
}

/// How far the stresses xy and xx of simple shear are from those of an exact curve, over the shear modulus, at any step.
template <class Law, class Exact>
double worst_of_shear(const Law& law, int steps, Exact&& exact) {
  const double mu = material::shear_modulus(law), increment = 1e-3;
  double worst = 0;
  for (const double angle : {0.0, 0.7, 2.5}) {  // of the element in its plane: its axes follow one side
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    Element<Law> e{law, thick(0.1), times(R, flat_triangle(1, 0.3, 0.8))};
    for (int step = 1; step <= steps; ++step) {
      Corners du;
      for (int a = 0; a < 3; ++a) du[a] = {increment * e.x[a].y, 0, 0};
      e.move(du, Corners{});
      const Mat3 stress = resultants(e).membrane;
      const auto [xy, xx] = exact(increment * step);
      worst = std::max({worst, std::abs(stress(0, 1) / mu - xy), std::abs(stress(0, 0) / mu - xx)});
    }
  }
  return worst;
}

TEST(Plate, LargeSimpleShearFollowsTheRateOfJaumannWhereALawMayFlow) {
  const material::J2Bilinear never_flows{2.0, 3.0, 0.3, {1e9, 0}};
  const auto exact = [](double gamma) { return std::pair(std::sin(gamma), 1 - std::cos(gamma)); };
  EXPECT_LT(worst_of_shear(never_flows, 4000, exact), 1e-4);  // of catalogues of hypoelastic shear, at this increment
}

TEST(Plate, LargeSimpleShearFollowsTheLogarithmicStrain) {
  const auto exact = [](double gamma) {
    const double h = 2 * std::asinh(0.5 * gamma) / std::sqrt(4 + gamma * gamma);
    return std::pair(2 * h, gamma * h);
  };
  EXPECT_LT(worst_of_shear(metal<Elastic>(), 1800, exact), 1e-3);
}

TEST(Plate, PatchOfConstantMembraneStrainIsPassed) {
  const auto answered = put_on_patch(
      [](double x, double y) {
        return Point{0.3 * x - 0.2 * y, 0.5 * x + 0.7 * y, 0};
      },
      [](double, double) {
        return Point{0, 0, 0};
      });
  const Plane<double> s = material::hooke(metal<Elastic>(), Plane<double>{0.3, 0.7, 0.15});
  Mat3 exact = Mat3::Zero();
  exact.topLeftCorner<2, 2>() = full(s);
  for (const Resultants& r : answered.elements) {
    EXPECT_LT((r.membrane - exact).norm(), 1e-12 * exact.norm());
    EXPECT_LT(r.bending.norm(), 1e-12);
    EXPECT_LT(r.shear.norm(), 1e-12);
  }
  EXPECT_LT(answered.force_inside, 1e-12 * answered.largest_force);
}

TEST(Plate, PatchOfConstantCurvatureIsPassedWithoutAnyShear) {
  // w = (a x^2 + 2 b x y + c y^2)/2 with normals that stay normal: theta = (dw/dy, -dw/dx, 0)
  const double a = 0.4, b = -0.3, c = 0.7, t = 0.05;
  const auto answered = put_on_patch(
      [&](double x, double y) {
        return Point{0, 0, 0.5 * (a * x * x + 2 * b * x * y + c * y * y)};
      },
      [&](double x, double y) {
        return Point{b * x + c * y, -a * x - b * y, 0};
      });
  // curvature is -w''; the five layers integrate z^2 exactly: t^2/12 per thickness
  const Plane<double> s = material::hooke(metal<Elastic>(), Plane<double>{-a, -c, -b});
  Mat3 exact = Mat3::Zero();
  exact.topLeftCorner<2, 2>() = t * t / 12 * full(s);
  for (const Resultants& r : answered.elements) {
    EXPECT_LT((r.bending - exact).norm(), 1e-12 * exact.norm());
    EXPECT_LT(r.membrane.norm(), 1e-12);
    EXPECT_LT(r.shear.norm(), 1e-12);
  }
  EXPECT_LT(answered.force_inside, 1e-12);
  EXPECT_LT(answered.moment_inside, 1e-12 * answered.largest_moment);
}

/// Share of the shear stiffness from its definition: energy of a shear q over that and of the moments q x about the centroid, which
/// balance it, mean of q along both axes. The rule of the sides' middles integrates squares exactly.
double share_by_energies(const Corners& X, double thickness, const Elastic& law) {
  const Point centre = (1.0 / 3.0) * (X[0] + X[1] + X[2]);
  double square = 0;
  for (int a = 0; a < 3; ++a) {
    const Point from = 0.5 * (X[a] + X[(a + 1) % 3]) - centre;
    square += dot(from, from) / 3.0;
  }
  const double bending = law.young * thickness * thickness * thickness / (12 * (1 - law.poisson * law.poisson));
  const double of_shear = 1 / (2 * Plate::shear_factor * material::shear_modulus(law) * thickness), of_moments = square / 2 / (2 * bending);
  return of_shear / (of_shear + of_moments);
}

TEST(Plate, ConstantTransverseShearHasTheStiffnessThatResidualFlexibilityLeaves) {
  // normals stand still: the moments of the nodes add up to resultant times area
  const double mu = material::shear_modulus(metal<Elastic>());
  const Vec3 slope(0.3, -0.8, 0);
  for (const double t : {0.05, 50.0}) {
    const Patch patch = irregular_patch();
    const auto answered = put_on_patch(
        [](double x, double y) {
          return Point{0, 0, 0.3 * x - 0.8 * y};
        },
        [](double, double) {
          return Point{0, 0, 0};
        },
        t, patch);
    const Vec3 whole = Plate::shear_factor * mu * t * slope;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < answered.elements.size(); ++i) {
      Corners X;
      for (int a = 0; a < 3; ++a) X[a] = patch.X[patch.triangles[i][a]];
      const Vec3 exact = share_by_energies(X, t, metal<Elastic>()) * whole;
      const Resultants& r = answered.elements[i];
      EXPECT_LT((r.shear - exact).norm(), 1e-12 * exact.norm());
      EXPECT_LT(r.membrane.norm(), 1e-12);
      EXPECT_LT(r.bending.norm(), 1e-12 * t);
      sum += 0.5 * norm(cross(X[1] - X[0], X[2] - X[0])) * exact;
    }
    EXPECT_NEAR(answered.moment.x, sum.y(), 1e-11 * t);
    EXPECT_NEAR(answered.moment.y, -sum.x(), 1e-11 * t);
    if (t > 1) {  // elements that are small beside the thickness pass the patch
      EXPECT_LT((sum - whole).norm(), 1e-5 * whole.norm());
      EXPECT_LT(answered.force_inside, 1e-5 * answered.largest_force);
    }
  }
}

TEST(Plate, BendingStiffnessOfFiveLayersIsExact) {
  // dtheta_y/dx = 1 makes M_xx = E t^3 / 12 (1 - nu^2)
  for (const double poisson : {0.0, 0.3}) {
    const Elastic law = metal<Elastic>(poisson);
    const Corners X = flat_triangle(1.0, 0.3, 0.8);
    Corners turn;
    for (int a = 0; a < 3; ++a) turn[a] = {0, 1e-7 * X[a].x, 0};
    const auto e = answer(law, thick(0.2), X, Corners{}, turn);
    const double stiffness = law.young * 0.008 / (12 * (1 - poisson * poisson));
    EXPECT_NEAR(0.2 * resultants(e).bending(0, 0), 1e-7 * stiffness, 1e-13 * 1e-7);
    EXPECT_NEAR(0.2 * resultants(e).bending(1, 1), 1e-7 * poisson * stiffness, 1e-13 * 1e-7);
  }
}

TEST(Plate, HasThreeStrainsThreeCurvaturesAndTwoShearsAndNoOtherStiffness) {
  // 18 freedoms less 8: six rigid motions, three drillings and a swirl of the normals
  const Eigen::VectorXd values = eigenvalues(stiffness(metal<Elastic>(), thick(0.3), flat_triangle(1.0, 0.3, 0.8)));
  EXPECT_LT(std::abs(values(9)), 1e-10);
  EXPECT_GT(values(10), 1e-4);
}

TEST(Plate, WithDrillingStiffnessHasThreeMoreStiffnesses) {
  Plate::Options options = thick(0.3);
  options.drilling = 0.5;
  const Eigen::VectorXd values = eigenvalues(stiffness(metal<Elastic>(), options, flat_triangle(1.0, 0.3, 0.8)));
  EXPECT_LT(std::abs(values(6)), 1e-10) << "six rigid motions and the swirl of the normals";
  EXPECT_GT(values(7), 1e-4);
}

/// Nodes that turn by an angle about the normal store mu times the part times volume times half its square, and plates that turn with them
/// nothing.
TEST(Plate, DrillingStoresTheSpinOfNodesBesideThatOfThePlate) {
  Plate::Options options = thick(0.1);
  options.drilling = 0.02;
  Element<Elastic> e{metal<Elastic>(), options, flat_triangle(1.0, 0.3, 0.8)};
  options.thickness = 1;  // thick beside its sides: the part is what is asked for
  e = {metal<Elastic>(), options, e.X};
  ASSERT_EQ(drilling_part(0.02, e.constants.gyration, trace_of_gradients(plate_shape(e.X))), 0.02);
  const Point up{0, 0, 1};
  const auto report = e.step(e.X, Corners{}, {0.01 * up, 0.01 * up, 0.01 * up});
  EXPECT_NEAR(report[Stored::drilling], 0.5 * 0.02 * material::shear_modulus(e.law) * 0.4 * 1e-4, 1e-14);
  const auto before = e.memory.drilling;
  const auto [du, turn] = rigid(e.x, Vec3(0, 0.6, 0.8), 0.01);
  EXPECT_NEAR(e.move(du, turn)[Stored::drilling], 0, 1e-9 * report[Stored::drilling]);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(e.memory.drilling[a], before[a], 1e-9 * before[a]);
}

TYPED_TEST(PlateOf, DrillingHasNoNetForceNorMomentAndIsTheGradientOfItsEnergy) {
  for (int trial = 0; trial < 10; ++trial) {
    Plate::Options options = thick(0.3);
    options.drilling = 0.5;
    const Corners X = triangle(), u = random_field(1e-5), t = random_field(1e-5), du = random_field(1e-6), turn = random_field(1e-6);
    const auto stored = [&](double s) {
      Element<TypeParam> e{metal<TypeParam>(), options, X};
      const auto report = e.move(sum(u, du, s), sum(t, turn, s));
      return report.stored[0] + of_shear(report) + report[Stored::drilling];
    };
    Element<TypeParam> e{metal<TypeParam>(), options, X};
    EXPECT_GT(e.move(u, t)[Stored::drilling], 0);
    EXPECT_NEAR(-2 * e.work(du, turn), stored(1) - stored(-1), 1e-4 * 2 * largest(e.force) * largest(du));
    Point force{}, moment{};
    for (int a = 0; a < 3; ++a) force = force + e.force[a], moment = moment + e.moment[a] + cross(e.x[a], e.force[a]);
    EXPECT_LT(norm(force), 1e-13 * largest(e.force));
    EXPECT_LT(norm(moment), 1e-13 * largest(e.force));
  }
}

// ------------------------------------------------------------------------------------------------
// Shear locking

/// Shear stiffness of a flat triangle over (w, theta_x, theta_y) by node, from a 2 x 9 operator; plain: of one point, without residual
/// flexibility.
Eigen::Matrix<double, 9, 9> shear_stiffness(const PlateShape<double>& s, double thickness, const Elastic& law, bool plain) {
  const double mu = material::shear_modulus(law);
  const double share = plain ? 1.0 : share_of_shear(material::lame(law), Plate::shear_factor, thickness, s);
  Eigen::Matrix<double, 2, 9> B = Eigen::Matrix<double, 2, 9>::Zero();
  const auto by_edge = shear_by_edge(s);
  const auto edge = edges(s);
  for (int a = 0; a < 3; ++a) {
    if (plain) {  // gradient of the deflection and mean rotation
      B(0, 3 * a) = s.gradient_x[a], B(1, 3 * a) = s.gradient_y[a];
      B(0, 3 * a + 2) = 1.0 / 3.0, B(1, 3 * a + 1) = -1.0 / 3.0;
      continue;
    }
    const int b = (a + 1) % 3;
    const Eigen::Vector2d p(by_edge[a].x, by_edge[a].y);
    B.col(3 * a) -= p, B.col(3 * b) += p;
    for (const int n : {a, b})
      B.col(3 * n + 2) += 0.5 * edge[a].x * p, B.col(3 * n + 1) -= 0.5 * edge[a].y * p;
  }
  return share * Plate::shear_factor * mu * thickness * s.area * B.transpose() * B;
}

/// Stiffness of a strip 1 x width over (w, theta_x, theta_y) by node; the last node of a row is
/// last.
Eigen::MatrixXd strip(const Elastic& law, double width, double thickness, int along, int across,
                      bool plain) {
  const int nodes = (along + 1) * (across + 1);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
  const auto add = [&](const std::array<int, 3>& n) {
    Corners X;
    for (int a = 0; a < 3; ++a)
      X[a] = {static_cast<double>(n[a] / (across + 1)) / along,
              width * (n[a] % (across + 1)) / across, 0};
    Matrix18 all = stiffness(law, thick(thickness), X);
    // the element's own axes: e1 along side 1-2, about the same normal
    const PlateShape<double> s = plate_shape(X);
    Eigen::Matrix<double, 9, 9> T = Eigen::Matrix<double, 9, 9>::Identity();
    for (int a = 0; a < 3; ++a)
      T.block<2, 2>(3 * a + 1, 3 * a + 1) << s.frame.e1.x, s.frame.e1.y, s.frame.e2.x, s.frame.e2.y;
    Eigen::Matrix<double, 9, 9> k;
    const auto dof = [](int i) { return 6 * (i / 3) + 2 + i % 3; };  // w, theta_x, theta_y
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j) k(i, j) = all(dof(i), dof(j));
    if (plain)
      k += T.transpose() *
           (shear_stiffness(s, thickness, law, true) - shear_stiffness(s, thickness, law, false)) * T;
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j < 9; ++j) K(3 * n[i / 3] + i % 3, 3 * n[j / 3] + j % 3) += k(i, j);
  };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      const int a = i * (across + 1) + j, b = a + across + 1, c = b + 1, d = a + 1;
      add({a, b, c}), add({c, d, a});
    }
  }
  return K;
}

/// Deflection of the end of a cantilever strip 1 x 0.1 under an end force, over that of a beam.
double tip_deflection(double thickness, int along, int across, bool plain) {
  const Elastic law = metal<Elastic>(0.0);
  const double width = 0.1, mu = material::shear_modulus(law);
  const Eigen::MatrixXd K = strip(law, width, thickness, along, across, plain);
  const int nodes = (along + 1) * (across + 1);
  const int clamped = 3 * (across + 1), freedoms = 3 * nodes - clamped;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(freedoms);
  for (int j = 0; j <= across; ++j)
    load(freedoms - 3 * (j + 1)) = (j % across == 0 ? 0.5 : 1.0) / across;
  const Eigen::VectorXd u = K.bottomRightCorner(freedoms, freedoms).ldlt().solve(load);
  const double tip = u(freedoms - 6);
  return tip / (4.0 / (law.young * width * thickness * thickness * thickness) +
                1.0 / (Plate::shear_factor * mu * width * thickness));
}

TEST(Plate, ShearOperatorOfThisTestIsThatOfTheElement) {
  const Corners X = flat_triangle(1.0, 0.3, 0.8);
  for (const double t : {1e-2, 1.0}) {
    const Matrix18 all = stiffness(metal<Elastic>(), thick(t), X);
    const auto k = shear_stiffness(plate_shape(X), t, metal<Elastic>(), false);
    for (int i = 0; i < 9; i += 3)  // rows of the deflections, which bending does not have
      for (int j = 0; j < 9; ++j)
        EXPECT_NEAR(all(6 * (i / 3) + 2 + i % 3, 6 * (j / 3) + 2 + j % 3), k(i, j), 1e-7 * k(i, i));
  }
}

TEST(Plate, SwirlOfTheNormalsIsFreeInOneElementAndHeldByItsNeighbours) {
  // out of its plane one element has rank 5 of 6; the seventh motion is beta = (-y, x) about its
  // centre
  const Corners X = flat_triangle(1.0, 0.3, 0.8);
  const Point centre = (1.0 / 3.0) * (X[0] + X[1] + X[2]);
  Corners turn;  // beta = (theta_y, -theta_x)
  for (int a = 0; a < 3; ++a) turn[a] = -1e-7 * (X[a] - centre);
  const auto e = answer(metal<Elastic>(), thick(0.3), X, Corners{}, turn);
  EXPECT_LT(largest(e.force) + largest(e.moment), 1e-12 * 1e-7);
  for (const auto& [along, across] : {std::pair{1, 1}, {2, 1}, {2, 2}, {4, 3}}) {
    const Eigen::MatrixXd K = strip(metal<Elastic>(), 0.8, 0.3, along, across, false);
    const Eigen::VectorXd values = eigenvalues(K);
    EXPECT_LT(std::abs(values(2)), 1e-10);
    EXPECT_GT(values(3), 1e-5);
  }
}

TEST(Plate, ThinCantileverBendsFreelyWhereAPlainOnePointRuleLocks) {
  const double thick_plate = tip_deflection(0.1, 10, 4, false),
               thin = tip_deflection(1e-3, 10, 4, false);
  const double plain = tip_deflection(1e-3, 10, 4, true);
  ::testing::Test::RecordProperty("thick", std::to_string(thick_plate));
  ::testing::Test::RecordProperty("thin", std::to_string(thin));
  ::testing::Test::RecordProperty("plain", std::to_string(plain));
  EXPECT_NEAR(thick_plate, 1.0, 0.01);
  EXPECT_NEAR(thin, 1.0, 0.01);
  EXPECT_LT(plain, 0.01);
}

// ------------------------------------------------------------------------------------------------
// Frequencies

Corners any_triangle() {
  const double scale = random(0.5, 2.0);
  return flat_triangle(scale, scale * random(-0.3, 1.3), scale * random(0.15, 1.2));
}

TEST(Plate, FrequencyBoundsAreNeverBelowTheExactOnes) {
  double closest[2] = {1e300, 1e300}, farthest[2] = {0, 0};
  for (int trial = 0; trial < 400; ++trial) {
    const auto inertia =
        trial % 2 == 0 ? Plate::RotaryInertia::physical : Plate::RotaryInertia::scaled;
    const double thickness = std::pow(10.0, random(-3.0, -0.5));
    const Element<Elastic> e{metal<Elastic>(random(-0.9, 0.49)), thick(thickness, inertia),
                             any_triangle()};
    const Matrix18 K = stiffness(e.law, e.options, e.X);
    Eigen::VectorXd per_root(18);
    for (int i = 0; i < 18; ++i)
      per_root(i) = 1 / std::sqrt(e.constants.mass / 3 * (i % 6 < 3 ? 1.0 : e.constants.gyration));
    Matrix18 membrane = per_root.asDiagonal() * K * per_root.asDiagonal(), bending = membrane;
    for (int i = 0; i < 18; ++i) {
      auto& other = i % 6 < 2 ? bending : membrane;  // u and v against w and the rotations
      other.row(i).setZero(), other.col(i).setZero();
    }
    const auto bound =
        largest_frequencies_squared(material::lame(e.law), e.law.density, thickness, e.constants.gyration, plate_shape(e.X));
    const double exact[2] = {
        eigenvalues(membrane).maxCoeff(),
        eigenvalues(bending).maxCoeff()};
    const double ratio[2] = {std::sqrt(bound.membrane / exact[0]),
                             std::sqrt(bound.bending_and_shear / exact[1])};
    for (int m = 0; m < 2; ++m)
      closest[m] = std::min(closest[m], ratio[m]), farthest[m] = std::max(farthest[m], ratio[m]);
  }
  ::testing::Test::RecordProperty(
      "membrane", std::to_string(closest[0]) + " to " + std::to_string(farthest[0]));
  ::testing::Test::RecordProperty(
      "bending_and_shear", std::to_string(closest[1]) + " to " + std::to_string(farthest[1]));
  for (int m = 0; m < 2; ++m) {
    EXPECT_GE(closest[m], 1 - 1e-9);
    EXPECT_LT(farthest[m], 1.6);
  }
}

/// However thin the plate: the step is no more than 5 % shorter.
TEST(Plate, DrillingHardlyChangesTheStep) {
  for (const auto inertia : {Plate::RotaryInertia::physical, Plate::RotaryInertia::scaled})
    for (int trial = 0; trial < 200; ++trial) {
      Plate::Options options = thick(std::pow(10.0, random(-3.0, 0.5)), inertia);
      Element<Elastic> e{metal<Elastic>(random(0.0, 0.49)), options, any_triangle()};
      const double without = e.step(e.X, Corners{}, Corners{}).step;
      e.options.drilling = 0.1;
      const double with = e.step(e.X, Corners{}, Corners{}).step;
      EXPECT_LE(with, without * (1 + 1e-12));
      EXPECT_GT(with, 0.95 * without);
    }
}

TEST(Plate, FrequencyBoundHoldsWithDrillingStiffness) {
  double farthest = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Plate::Options options = thick(std::pow(10.0, random(-2.0, -0.5)));
    options.drilling = std::pow(10.0, random(-4.0, 0.0));
    Element<Elastic> e{metal<Elastic>(random(-0.9, 0.49)), options, any_triangle()};
    const Matrix18 K = stiffness(e.law, e.options, e.X);
    Eigen::VectorXd per_root(18);
    for (int i = 0; i < 18; ++i)
      per_root(i) = 1 / std::sqrt(e.constants.mass / 3 * (i % 6 < 3 ? 1.0 : e.constants.gyration));
    Matrix18 in_plane = per_root.asDiagonal() * K * per_root.asDiagonal();
    for (int i = 0; i < 18; ++i)
      if (i % 6 >= 2 && i % 6 <= 4) in_plane.row(i).setZero(), in_plane.col(i).setZero();  // u, v and the spin
    const auto bound = largest_frequencies_squared(material::lame(e.law), e.law.density, options.thickness, e.constants.gyration,
                                                   plate_shape(e.X));
    const double exact = eigenvalues(in_plane).maxCoeff();
    const double step = e.step(e.X, Corners{}, Corners{}).step, here = 4 / (step * step);
    EXPECT_GE(here, std::max(exact, bound.bending_and_shear) * (1 - 1e-9));
    if (here > bound.bending_and_shear * (1 + 1e-9)) farthest = std::max(farthest, here / exact);
  }
  EXPECT_LT(farthest, 2);
}

TEST(Plate, WithScaledRotaryInertiaBendingNeverSetsTheStep) {
  for (int trial = 0; trial < 400; ++trial) {
    const double thickness = std::pow(10.0, random(-3.0, 0.5));
    Element<Elastic> e{metal<Elastic>(random(0.0, 0.49)),
                       thick(thickness, Plate::RotaryInertia::scaled), any_triangle()};
    const auto bound =
        largest_frequencies_squared(material::lame(e.law), e.law.density, thickness, e.constants.gyration, plate_shape(e.X));
    EXPECT_LE(bound.bending_and_shear, bound.membrane * (1 + 1e-9));
    EXPECT_GE(e.constants.gyration, thickness * thickness / 12);
    EXPECT_NEAR(e.step(e.X, Corners{}, Corners{}).step, 2 / std::sqrt(bound.membrane),
                1e-9 * 2 / std::sqrt(bound.membrane));
  }
}

/// Powers of two scale a number without rounding, so that any length written into the code would show.
TEST(Plate, ScaledRotaryInertiaScalesWithTheMeshToTheLastBit) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners X = triangle();
    const double thickness = std::pow(10.0, random(-3.0, -0.5));
    const auto of_scale = [&](double scale) {
      const Corners small{scale * X[0], scale * X[1], scale * X[2]};
      return constants(metal<Elastic>(), thick(scale * thickness, Plate::RotaryInertia::scaled), small).gyration / (scale * scale);
    };
    for (const double scale : {0x1p-10, 0x1p-17, 0x1p12}) EXPECT_EQ(of_scale(scale), of_scale(1));
  }
}

TEST(Plate, LargestEigenvalueIsExact) {
  for (int trial = 0; trial < 20; ++trial) {
    const Plane<double> p{random(), random(), random()};
    EXPECT_NEAR(largest_eigenvalue(p),
                eigenvalues(full(p)).maxCoeff(),
                1e-14);
  }
}

TEST(Plate, StoresTheShareOfItsShearAsShearAndTheRestAsResidualBending) {
  for (const double thickness : {0.01, 0.1, 1.0, 10.0}) {
    Element<Elastic> e{{1, 1, 0.3}, thick(thickness), triangle()};
    const auto report = e.move(Corners{}, random_field(1e-4));
    const double shear = report[Stored::transverse_shear], rest = report[Stored::residual_bending];
    const double share = share_of_shear(material::lame(e.law), Plate::shear_factor, thickness, plate_shape(e.X));
    EXPECT_GT(shear + rest, 0);
    EXPECT_NEAR(shear / (shear + rest), share, 1e-12);
  }
  EXPECT_GT(share_of_shear(material::lame(Elastic{1, 1, 0.3}), Plate::shear_factor, 10.0, plate_shape(triangle())), 0.99)
      << "of plates that are thick beside their elements all of it is shear";
}

// ------------------------------------------------------------------------------------------------
// What it shows at its surfaces

/// Turns the normals so that only kappa_xx is left, without a deflection.
template <class Law>
void bend(Element<Law>& e, double kappa) {
  Corners turn{};
  for (int a = 0; a < 3; ++a) turn[a].y = kappa * e.X[a].x;
  e.move(Corners{}, turn);
}

/// The same for kappa_xy.
template <class Law>
void twist(Element<Law>& e, double kappa) {
  Corners turn{};
  for (int a = 0; a < 3; ++a) turn[a] = {-kappa * e.X[a].x, kappa * e.X[a].y, 0};
  e.move(Corners{}, turn);
}

TEST(AtPlace, OfAnElasticPlateLiesOnTheStraightLineThroughItsLayers) {
  for (int layers = 1; layers <= 9; ++layers) {
    Plate::Options options = thick(0.1);
    options.layers = layers;
    Element<Elastic> e{{1, 1, 0.3}, options, flat_triangle(1, 0.2, 0.9)};
    bend(e, 1e-3);
    const double edge = layers == 1 ? 0 : 1 / (1 - 0.3 * 0.3) * 1e-3 * 0.05;
    EXPECT_NEAR(at_place(e.law, e.layers, e.memory, Place::top).stress.xx, edge, 1e-18);
    EXPECT_NEAR(at_place(e.law, e.layers, e.memory, Place::bottom).stress.xx, -edge, 1e-18);
    EXPECT_NEAR(at_place(e.law, e.layers, e.memory, Place::middle).stress.xx, 0, 1e-18);
    EXPECT_NEAR(at_place(e.law, e.layers, e.memory, Place::membrane).stress.xx, 0, 1e-18);
  }
}

TEST(AtPlace, OfAPlateThatHasYieldedIsTheYieldStressAndAfterwardsTheResidualOne) {
  // twist k without hardening: shear stress min(2 mu k z, Y / sqrt(3)), elastic on the way back; Poisson's ratio is zero, 2 mu = E
  constexpr double young = 1e3, yield = 1, thickness = 0.1;
  const double most = yield / std::sqrt(3), elastic = most / young / (thickness / 2);
  Plate::Options options = thick(thickness);
  options.layers = 9;
  Element<J2Bilinear> e{{1, young, 0, {yield, 0}}, options, flat_triangle(1, 0.2, 0.9)};
  for (int step = 0; step < 100; ++step) twist(e, 0.05 * elastic);
  const auto loaded = at_place(e.law, e.layers, e.memory, Place::top);
  EXPECT_LT(material::von_mises(loaded.stress), yield * (1 + 1e-12));
  EXPECT_NEAR(loaded.stress.xy, most, 1e-9);
  const double flowed = loaded.internal.scalar[0];
  EXPECT_NEAR(flowed, 2 / std::sqrt(3) * 4 * most / young, 1e-6);
  for (int step = 0; step < 10; ++step) twist(e, -0.05 * elastic);
  const auto unloaded = at_place(e.law, e.layers, e.memory, Place::top);
  EXPECT_NEAR(unloaded.stress.xy, 0.5 * most, 1e-9);
  EXPECT_NEAR(unloaded.internal.scalar[0], flowed, 1e-15);
  EXPECT_NEAR(at_place(e.law, e.layers, e.memory, Place::bottom).stress.xy, -0.5 * most, 1e-9);
}

TEST(AtPlace, NeverShowsMoreThanTheYieldStressAtItsPlasticStrain) {
  const J2Bilinear plain{1, 1e3, 0.3, {1, 100}};
  const J2Mixed mixed{1, 1e3, 0.3, 1, 100, 0.3};
  for (int i = 0; i < 200; ++i) {
    Element<J2Bilinear> one{plain, thick(0.1), triangle()};
    Element<J2Mixed> other{mixed, thick(0.1), triangle()};
    one.randomise(2), other.randomise(2);
    for (int l = 0; l < 5; ++l) one.memory.layers[l].internal.scalar[0] = other.memory.layers[l].internal.scalar[0] = random(0, 0.1);
    for (const Place place : {Place::top, Place::middle, Place::bottom}) {
      const auto a = at_place(one.law, one.layers, one.memory, place);
      EXPECT_GE(a.internal.scalar[0], 0);
      EXPECT_LE(material::von_mises(a.stress), yield_stress(plain, a.internal.scalar) * (1 + 1e-12));
      const auto b = at_place(other.law, other.layers, other.memory, place);
      const Plane<double> shifted = b.stress - material::surface_centre(b.internal.tensor[0]);
      EXPECT_LE(material::von_mises(shifted), yield_stress(mixed, b.internal.scalar) * (1 + 1e-12));
    }
  }
}

template <class Law>
Symmetric<double> strain(const Element<Law>& e, Place place) {
  const auto stress = at_place(e.law, e.layers, e.memory, place).stress;
  return strain_at_place(e.law, plate_shape(e.X), plate_shape(e.x), e.memory, stress, place);
}

TEST(StrainAtPlace, OfBendingIsCurvatureTimesHalfTheThickness) {
  Element<Elastic> e{{1, 1, 0.25}, thick(0.1), flat_triangle(1, 0.2, 0.9)};
  for (int step = 0; step < 4; ++step) bend(e, 1e-4);
  const Symmetric<double> top = strain(e, Place::top), bottom = strain(e, Place::bottom);
  EXPECT_NEAR(top.xx, 4e-4 * 0.05, 1e-15);
  EXPECT_NEAR(top.zz, -0.25 / 0.75 * top.xx, 1e-15) << "yy is held";
  EXPECT_NEAR(bottom.xx, -top.xx, 1e-15);
  EXPECT_NEAR(strain(e, Place::middle).xx, 0, 1e-15);
  EXPECT_NEAR(top.yy, 0, 1e-15);
  EXPECT_NEAR(top.xy, 0, 1e-15);
}

TEST(StrainAtPlace, OfAStretchIsItsLogarithmAndWhatTheLawLeavesAlongTheNormal) {
  // uniaxial stress by 1.5 in small steps: the width and the thickness follow Poisson's ratio in logarithms
  constexpr double poisson = 0.3;
  Element<Elastic> e{{1, 1, poisson}, thick(0.1), flat_triangle(1, 0.2, 0.9)};
  constexpr int steps = 200;
  for (int step = 1; step <= steps; ++step) {
    const double along = std::log(1.5) * step / steps;
    Corners to = e.X;
    for (Point& p : to) p = {std::exp(along) * p.x, std::exp(-poisson * along) * p.y, 0};
    e.step(to, sum(to, e.x, -1.0), Corners{});
  }
  const Symmetric<double> membrane = strain(e, Place::membrane);
  EXPECT_NEAR(membrane.xx, std::log(1.5), 1e-12);
  EXPECT_NEAR(membrane.yy, -poisson * std::log(1.5), 1e-12);
  EXPECT_NEAR(membrane.zz, -poisson * std::log(1.5), 1e-5);  // by the stress, whose steps have an error of the second order
  EXPECT_NEAR(membrane.xx + membrane.yy + membrane.zz, volume_strain(e.law, e.layers, e.memory), 1e-15);
  EXPECT_NEAR(strain(e, Place::top).xx, membrane.xx, 1e-15);
}

TEST(StrainAtPlace, OfARigidRotationIsThatOfBefore) {
  Element<Elastic> e{{1, 1, 0.3}, thick(0.1), triangle()};
  const Vec3 axis(0.3, -1, 0.5);
  const auto turned = [&](double angle) { return Mat3(Eigen::AngleAxisd(angle, axis.normalized())); };
  e.move(random_field(0.02), random_field(0.1));
  const Corners start = e.x;
  const Symmetric<double> before = strain(e, Place::top);
  constexpr int steps = 24;
  for (int step = 1; step <= steps; ++step) {
    const Corners to = times(turned(2 * pi * step / steps), start);
    const Vec3 turn = 2 * std::tan(pi / steps) * axis.normalized();
    e.step(to, sum(to, e.x, -1.0), {Point{turn.x(), turn.y(), turn.z()}, {turn.x(), turn.y(), turn.z()}, {turn.x(), turn.y(), turn.z()}});
  }
  const Symmetric<double> after = strain(e, Place::top);
  EXPECT_GT(std::abs(before.xx), 1e-4);
  EXPECT_NEAR(after.xx, before.xx, 1e-14);
  EXPECT_NEAR(after.xy, before.xy, 1e-14);
  EXPECT_NEAR(after.zz, before.zz, 1e-14);
}

}  // namespace
}  // namespace nereid::element::plate_test
