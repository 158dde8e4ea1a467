#include "element/fluid.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/dense.hpp"
#include "base/dual.hpp"
#include "material/laws.hpp"
#include "tests/element/corners.hpp"

namespace nereid::element::fluid_test {
namespace {

using material::IdealGas;
using material::LinearFluid;
using material::MieGruneisen;

/// One element of fluid that remembers. Sizes are about one.
template <class Law>
struct One {
  Law law;
  Fluid::Options options;
  Corners X;
  Fluid::Constants<double> constants = element::constants(law, options, X);
  Fluid::Memory<double, Law> memory = at_start(law, start_of(law, options, X));
  Corners x = X, force{};

  auto step(const Corners& to, const Corners& du, double dt) {
    x = to;
    return advance(law, options, constants, {1.0, 1.0, 1.0}, to, du, dt, memory, force);
  }
  auto move(const Corners& to, double dt = 1.0) { return step(to, sum(to, x, -1.0), dt); }
};

const LinearFluid liquid{2, 3};
const MieGruneisen shocked{2, 1.2, 1.75, 0.28};
const IdealGas gas{2, 1.4, 0.3};
const Fluid::Options inviscid{.hourglass = 0, .viscosity = no_viscosity};

LinearFluid of(LinearFluid*) { return liquid; }
MieGruneisen of(MieGruneisen*) { return shocked; }
IdealGas of(IdealGas*) { return gas; }
/// The pressure that they start with.
Fluid::Options with_pressure(Fluid::Options options) { return options.pressure = 0.3, options; }
Fluid::Options with_gravity(Fluid::Options options) { return options.gravity = {0.3, -0.2, 0.7}, options; }

/// All channels, without their signs.
template <class R>
double total_of(const R& report) {
  double sum = 0;
  for (const double channel : report.stored) sum += std::abs(channel);
  for (const double channel : report.dissipated) sum += std::abs(channel);
  return sum;
}

/// Integrates f(place, det J) by the 2 x 2 x 2 rule of Gauss.
template <class F>
void integrate_places(const Corners& x, F&& f) {
  std::size_t point = 0;
  integrate(x, [&](const auto&, double det) {
    const double g = 1.0 / std::sqrt(3.0);
    Point place{};
    for (int i = 0; i < 8; ++i) {
      double weight = 0.125;
      for (int axis = 0; axis < 3; ++axis) weight *= 1 + g * sign[i][axis] * sign[point][axis];
      place = place + weight * x[i];
    }
    f(place, det);
    ++point;
  });
}

template <class Law>
class FluidOf : public ::testing::Test {
 protected:
  static One<Law> usual(const Corners& X, Fluid::Options options = {}) {
    return {of(static_cast<Law*>(nullptr)), with_pressure(options), X};
  }
};
using Each = ::testing::Types<LinearFluid, MieGruneisen, IdealGas>;
TYPED_TEST_SUITE(FluidOf, Each);

TYPED_TEST(FluidOf, StartsWithItsPressureAndPushesByTheGradientOfItsVolume) {
  const Corners X = distorted(0.2);
  auto e = this->usual(X);
  e.step(X, Corners{}, 1.0);
  const auto g = volume_gradient(amplitudes(X));
  const Corners gradient =
      nodal_values(Modes<double>{g.xi, g.eta, g.zeta, {g.hourglass[0], g.hourglass[1], g.hourglass[2], Point{}}});
  EXPECT_LT(largest(sum(e.force, gradient, -0.3)), 1e-13);
  EXPECT_NEAR(e.constants.mass, 2 * g.volume, 1e-13);
}

TYPED_TEST(FluidOf, RigidRotationByAFiniteAngleChangesNothing) {
  for (int trial = 0; trial < 20; ++trial) {
    auto e = this->usual(distorted(0.2));
    e.move(sum(e.X, random_field(0.01)));
    e.step(e.x, Corners{}, 1.0);  // what the dashpots took has heated it
    const double pressure = e.memory.state.pressure;
    e.memory.viscous = 0, e.memory.hourglass = {};  // rates of the step before
    const auto report = e.move(times(random_rotation(2.0), e.x));
    EXPECT_NEAR(e.memory.state.pressure, pressure, 1e-13);
    EXPECT_LT(total_of(report), 1e-13);
    for (const Point& q : e.memory.hourglass) EXPECT_LT(norm(q), 1e-13);
  }
}

TYPED_TEST(FluidOf, ForcesHaveNoNetForceAndNoNetMoment) {
  for (int trial = 0; trial < 20; ++trial) {
    auto e = this->usual(distorted(0.2));
    e.move(sum(e.X, random_field(0.05)), 0.05);
    Point force{}, moment{};
    for (int i = 0; i < 8; ++i) force = force + e.force[i], moment = moment + cross(e.x[i], e.force[i]);
    EXPECT_LT(norm(force), 1e-13 * largest(e.force));
    EXPECT_LT(norm(moment), 1e-13 * largest(e.force));
  }
}

TYPED_TEST(FluidOf, ForceIsTheGradientOfWhatItStores) {
  for (int trial = 0; trial < 10; ++trial) {
    const Corners X = distorted(0.2), u = random_field(1e-3), direction = random_field(1e-5);
    const auto stored = [&](const Corners& displacement) {
      auto e = this->usual(X, with_gravity(inviscid));
      e.step(X, Corners{}, 1.0);
      const auto report = e.move(sum(X, displacement));
      return report[Stored::compression] + report[Stored::weight];
    };
    auto e = this->usual(X, with_gravity(inviscid));
    e.step(X, Corners{}, 1.0);
    e.move(sum(X, u));
    const double change = stored(sum(u, direction)) - stored(sum(u, direction, -1.0));
    EXPECT_NEAR(-2.0 * product(e.force, direction), change,
                1e-3 * 2 * std::sqrt(product(e.force, e.force) * product(direction, direction)));
  }
}

TYPED_TEST(FluidOf, IsFrameIndifferent) {
  for (int trial = 0; trial < 20; ++trial) {
    auto e = this->usual(distorted(0.2));
    e.move(sum(e.X, random_field(0.02)), 0.1);
    const Mat3 R = random_rotation();
    auto turned = e;
    for (Point& q : turned.memory.hourglass) q = times(R, q);
    const Corners to = sum(e.x, random_field(0.05)), du = sum(to, e.x, -1.0);
    const auto report = e.step(to, du, 0.1), same = turned.step(times(R, to), times(R, du), 0.1);
    EXPECT_LT(largest(sum(turned.force, times(R, e.force), -1.0)), 1e-12 * largest(e.force));
    for (std::size_t c = 0; c < report.stored.size(); ++c) EXPECT_NEAR(same.stored[c], report.stored[c], 1e-13);
    for (std::size_t c = 0; c < report.dissipated.size(); ++c) EXPECT_NEAR(same.dissipated[c], report.dissipated[c], 1e-13);
    EXPECT_NEAR(same.step, report.step, 1e-12 * report.step);
    EXPECT_NEAR(same.volume_ratio, report.volume_ratio, 1e-13);
  }
}

/// The order in the step to which the work of all forces is stored or dissipated, over some elements that move at random.
template <class Law>
double order_of_work(const std::vector<One<Law>>& elements) {
  double squares[2] = {0, 0};
  for (const One<Law>& start : elements) {
    const Corners direction = random_field(1.0);
    const auto error = [&](double dt) {
      auto e = start;
      e.step(e.X, Corners{}, 1.0);
      e.memory.viscous = 0;
      double all = 0;
      for (int i = 0; i < 2; ++i) {  // forces of viscosity and dashpots jump in the first
        const Corners before = e.force, du = sum(Corners{}, direction, dt);
        const auto report = e.step(sum(e.x, du), du, dt);
        all = 0.5 * (product(before, du) + product(e.force, du)) + report[Stored::compression] + report[Stored::weight] +
              report[Dissipated::viscous] + report[Dissipated::hourglass];
      }
      return all;
    };
    squares[0] += error(1e-3) * error(1e-3);
    squares[1] += error(5e-4) * error(5e-4);
  }
  return std::log2(std::sqrt(squares[0] / squares[1]));
}

TYPED_TEST(FluidOf, WorkOfPressureAndWeightIsStoredToTheThirdOrderOfTheStep) {
  std::vector<One<TypeParam>> elements;
  for (int i = 0; i < 20; ++i) elements.push_back(this->usual(distorted(0.2), with_gravity(inviscid)));
  EXPECT_NEAR(order_of_work(elements), 3, 0.05);
}

TYPED_TEST(FluidOf, WorkOfViscosityAndDashpotsIsDissipatedToTheSecondOrderOfTheStep) {
  std::vector<One<TypeParam>> elements;
  for (int i = 0; i < 20; ++i) elements.push_back(this->usual(distorted(0.2), with_gravity({})));
  EXPECT_GT(order_of_work(elements), 1.95) << "forces of dashpots are those of the middle of the step";
}

TYPED_TEST(FluidOf, PacksAndDoublesAgree) {
  std::vector<One<TypeParam>> one;
  std::array<Corners, lanes> to, dx;
  std::array<Vector<Pack>, 8> xs, dxs, fs;
  Fluid::Constants<Pack> constants;
  Fluid::Memory<Pack, TypeParam> memory;
  const auto rows_of = [](auto& kept, const auto&... options) {
    std::vector<double> rows;
    kept.each_row([&](double& row) { rows.push_back(row); }, options...);
    return rows;
  };
  for (int l = 0; l < lanes; ++l) {
    one.push_back(this->usual(distorted(0.2), with_gravity({})));
    one[l].move(sum(one[l].X, random_field(0.02)), 0.1);
    to[l] = sum(one[l].X, random_field(0.1)), dx[l] = random_field(0.05);
    for (int i = 0; i < 24; ++i) {
      (&xs[i / 3].x)[i % 3][l] = to[l][i / 3][i % 3];
      (&dxs[i / 3].x)[i % 3][l] = dx[l][i / 3][i % 3];
    }
    const auto of_constants = rows_of(one[l].constants), of_memory = rows_of(one[l].memory, one[l].options);
    std::size_t c = 0, r = 0;
    constants.each_row([&](Pack& row) { row[l] = of_constants[c++]; });
    memory.each_row([&](Pack& row) { row[l] = of_memory[r++]; }, one[l].options);
    EXPECT_EQ(c, (Fluid::Constants<double>::rows));
    EXPECT_EQ(static_cast<int>(r), (Fluid::Memory<double, TypeParam>::rows(one[l].options)));
  }
  const auto all = advance(one[0].law, one[0].options, constants, {Pack(1.0), Pack(1.0), Pack(1.0)}, xs, dxs, Pack(0.1), memory, fs);
  for (int l = 0; l < lanes; ++l) {
    auto& e = one[l];
    const auto report = e.step(to[l], dx[l], 0.1);
    for (int i = 0; i < 24; ++i) EXPECT_NEAR((&fs[i / 3].x)[i % 3][l], e.force[i / 3][i % 3], 1e-13 * largest(e.force));
    EXPECT_NEAR(all.step[l], report.step, 1e-13 * report.step);
    for (std::size_t c = 0; c < report.stored.size(); ++c) EXPECT_NEAR(all.stored[c][l], report.stored[c], 1e-13);
    for (std::size_t c = 0; c < report.dissipated.size(); ++c) EXPECT_NEAR(all.dissipated[c][l], report.dissipated[c], 1e-13);
  }
}

TYPED_TEST(FluidOf, HasTheStableStepOfItsLargestFrequencyAmidItsOwnPressure) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners X = distorted(0.2);
    const auto start = this->usual(X, inviscid);
    // 24 x 24 by central differences of the forces, less those of an even pressure around, over masses by volume
    const auto out_of_balance = [&](int i, double by) {
      auto e = start;
      e.step(X, Corners{}, 1.0);
      Corners u{};
      u[i / 3][i % 3] = by;
      const double around = e.memory.state.pressure;
      e.move(sum(X, u));
      return sum(e.force, nodal_gradient(volume_gradient(amplitudes(e.x))), -around);
    };
    const std::array<double, 8> share = volume_shares(amplitudes(X));
    const double h = 1e-5, density = 2;
    Eigen::Matrix<double, 24, 24> scaled;
    for (int i = 0; i < 24; ++i) {
      const Corners change = sum(out_of_balance(i, h), out_of_balance(i, -h), -1.0);
      for (int j = 0; j < 24; ++j) scaled(j, i) = -change[j / 3][j % 3] / (2 * h * density * std::sqrt(share[i / 3] * share[j / 3]));
    }
    const Eigen::Matrix<double, 24, 24> symmetric = 0.5 * (scaled + scaled.transpose());
    const auto squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 24, 24>>(symmetric).eigenvalues();
    auto e = start;
    const double step = e.step(X, Corners{}, 1.0).step;
    EXPECT_NEAR(step, 2 / std::sqrt(squares(23)), 1e-6 * step);
    EXPECT_LT(squares.head(23).cwiseAbs().maxCoeff(), 1e-6 * squares(23)) << "one mode alone has stiffness";
  }
}

TYPED_TEST(FluidOf, ViscosityAndDashpotsTakeEnergyAndHeatTheFluid) {
  auto e = this->usual(distorted(0.1));
  e.step(e.X, Corners{}, 1.0);
  double taken = 0, compressed = 0;
  const double start = e.memory.state.energy;
  for (int i = 0; i < 20; ++i) {
    const Corners du = random_field(0.01);
    const auto report = e.step(sum(e.x, du), du, 0.02);
    taken += report[Dissipated::viscous] + report[Dissipated::hourglass], compressed += report[Stored::compression];
  }
  EXPECT_GT(taken, 0);
  EXPECT_NEAR((e.memory.state.energy - start) / e.constants.per_reference, taken + compressed, 1e-12);
}

// ------------------------------------------------------------------------------------------------
// Dashpots against hourglass motion

TEST(Fluid, LinearMotionsMeetNoDashpot) {
  One<LinearFluid> e{liquid, {.viscosity = no_viscosity}, distorted(0.2)};
  Mat3 A = Mat3::Random() * 0.1;
  A.diagonal().array() -= A.trace() / 3;
  const auto report = e.move(sum(e.X, times(A, e.X)));
  EXPECT_EQ(report[Dissipated::viscous], 0);
  EXPECT_LT(report[Dissipated::hourglass], 1e-28 + 1e-3 * A.norm() * A.norm() * A.norm());
}

TEST(Fluid, HourglassMotionGoesByALogarithm) {
  Fluid::Options options{.hourglass = 100, .viscosity = no_viscosity};
  One<LinearFluid> e{{2, 1e-12}, options, brick(1, 1, 1)};
  const double w0 = 0.3, dt = 2e-4;
  Corners v{};
  for (int i = 0; i < 8; ++i) v[i].x = w0 * sign[i][1] * sign[i][2];
  e.step(e.X, Corners{}, 1.0);
  for (int step = 0; step < 5000; ++step) {
    Corners du{};
    for (int i = 0; i < 8; ++i) v[i] = v[i] + (dt * 8 / e.constants.mass) * e.force[i], du[i] = dt * v[i];
    e.step(sum(e.x, du), du, dt);
  }
  const double way = norm(amplitudes(sum(e.x, e.X, -1.0)).hourglass[0]);
  EXPECT_NEAR(way, std::log(1 + 100 * w0) / 100, 5e-3 * way) << "of the second order in the way";
}

// ------------------------------------------------------------------------------------------------
// Weight, and where the mass is

TEST(Fluid, MassesOfTheNodesAreWhatAnEvenlyRisingPressureAcceleratesAlike) {
  // a wedge: nodes 0 and 3, 4 and 7 are one each; pressure below and none above
  const Corners wedge{{{0, 0, 0}, {1, 0, 0}, {0.9, 0.4, 0}, {0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {0.9, 0.4, 1}, {0, 0, 1}}};
  const std::array<double, 8> share = volume_shares(amplitudes(wedge));
  double sum = 0;
  for (const double part : share) sum += part;
  const double volume = volume_gradient(amplitudes(wedge)).volume;
  EXPECT_NEAR(sum, volume, 1e-14);
  EXPECT_NEAR(share[0] + share[3], volume / 6, 1e-14);
  const auto gradient = nodal_gradient(volume_gradient(amplitudes(wedge)));
  for (std::size_t node = 4; node < 8; ++node) EXPECT_NEAR(gradient[node].z / share[node], 2, 1e-12);
}

TYPED_TEST(FluidOf, StartsWithTheHydrostaticPressureOfItsCentroid) {
  for (int trial = 0; trial < 20; ++trial) {
    const Corners X = distorted(0.3);
    Fluid::Options options = with_gravity(inviscid);
    options.level = -1;  // so high that all of it is pressed
    double volume = 0, moment = 0;
    integrate_places(X, [&](const Point& place, double det) {
      volume += det, moment += det * dot(gravity_of<double>(options), place);
    });
    auto e = this->usual(X, options);
    e.step(X, Corners{}, 1.0);
    EXPECT_NEAR(e.memory.state.pressure, 0.3 + e.law.density * (moment / volume - options.level), 1e-13);
  }
}

TEST(Fluid, WeightIsTheGradientOfTheHeightOfTheCentroid) {
  using D = Dual<24>;
  for (int trial = 0; trial < 10; ++trial) {
    const Corners x = distorted(0.3);
    const Point g = random_point(2);
    std::array<Vector<D>, 8> variable, none{};
    for (int i = 0; i < 24; ++i) variable[i / 3][i % 3] = D(0.125) * D::variable(x[i / 3][i % 3], i);
    const auto X = sums_by_mode(variable);
    std::array<Vector<D>, 8> whole = variable;
    for (auto& p : whole) p = D(8.0) * p;
    const std::array<double, 8> share = volume_shares(amplitudes(x));
    const double density = 1.7 / volume_gradient(amplitudes(x)).volume;
    std::array<double, 8> per_node;
    std::array<D, 8> per_dual;
    for (std::size_t a = 0; a < 8; ++a) per_node[a] = 1 / (density * share[a]), per_dual[a] = D(per_node[a]);
    const D energy = add_weight<D>(whole, X, volume_gradient(X), D(1.7), per_dual, Vector<D>{D(g.x), D(g.y), D(g.z)}, none).energy;
    Corners force{};
    const auto at = amplitudes(x);
    const auto [value, arm] = add_weight(x, at, volume_gradient(at), 1.7, per_node, g, force);
    Point turning = -cross(arm, g);
    for (int i = 0; i < 8; ++i) turning = turning + cross(x[i], force[i]);
    EXPECT_LT(norm(turning), 1e-12);
    EXPECT_NEAR(value, energy.value, 1e-13);
    for (int i = 0; i < 24; ++i) EXPECT_NEAR(force[i / 3][i % 3], -energy.by[i], 1e-12);
    double volume = 0, moment = 0;
    integrate_places(x, [&](const Point& place, double det) { volume += det, moment += det * dot(g, place); });
    Point mean{};
    for (std::size_t a = 0; a < 8; ++a) mean = mean + (share[a] * density / 1.7) * x[a];
    EXPECT_NEAR(value, -1.7 * (moment / volume - dot(g, mean)), 1e-13);
    Point sum{};
    for (const Point& f : force) sum = sum + f;
    EXPECT_LT(norm(sum), 1e-13);
  }
}

}  // namespace
}  // namespace nereid::element::fluid_test
