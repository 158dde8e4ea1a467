#include "load/loads.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "base/check.hpp"
#include "mesh/box.hpp"
#include "mesh/skin.hpp"

namespace nereid::load::loads_test {
namespace {

OverTime constant(double value) {
  return [value](double) { return value; };
}
std::array<OverTime, 3> constant(const Vec3& value) { return {constant(value.x()), constant(value.y()), constant(value.z())}; }

/// A box with all its faces as one surface.
mesh::Mesh closed_box() {
  mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.1), {3, 2, 1}});
  mesh::Surface all{"all", {}};
  for (const auto& side : mesh.surfaces) {
    Table<3> both(3, all.facets.cols() + side.facets.cols());
    both << all.facets, side.facets;
    all.facets = both;
  }
  mesh.surfaces.push_back(all);
  return mesh;
}

/// Volume of the hexahedra, whose faces are bilinear.
double volume(mesh::Mesh mesh, const Vectors& x) {
  mesh.X = x;
  return mesh::volumes(mesh, mesh.hexahedra[0]).sum();
}

Vectors random_vectors(Eigen::Index count, double amplitude, int seed) {
  std::mt19937 engine(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> number(-amplitude, amplitude);
  Vectors v(3, count);
  for (Eigen::Index i = 0; i < v.size(); ++i) v.data()[i] = number(engine);
  return v;
}

const Vectors no_turns(3, 0);

TEST(Pressure, OnAFlatSideIsAreaTimesPressureAgainstItsNormal) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.1), {3, 2, 1}});
  const AnyLoad load = pressure_on("p", mesh, mesh::surface(mesh, "box.x_high"), constant(1e3));
  LoadMemory memory = initial_memory(load);
  advance(load, mesh.X, mesh.X, Vectors::Zero(3, mesh.X.cols()), no_turns, 0, 0, memory);
  EXPECT_NEAR((resultant(memory) - Vec3(-1e3 * 0.02, 0, 0)).norm(), 0, 1e-13);  // round-off of a sum of tens
}

TEST(Pressure, OnAClosedSurfaceHasNoResultantAndNoMomentHoweverItIsDeformed) {
  const mesh::Mesh mesh = closed_box();
  const AnyLoad load = pressure_on("p", mesh, mesh::surface(mesh, "all"), constant(1e3));
  const Vectors x = mesh.X + random_vectors(mesh.X.cols(), 0.03, 1);
  LoadMemory memory = initial_memory(load);
  advance(load, mesh.X, x, Vectors::Zero(3, x.cols()), no_turns, 0, 0, memory);
  Vectors force = Vectors::Zero(3, x.cols()), moment(3, 0);
  add_forces(load, memory, force, moment);
  Vec3 torque = Vec3::Zero();
  double size = 0;
  for (Eigen::Index n = 0; n < x.cols(); ++n) torque += x.col(n).cross(force.col(n)), size += force.col(n).norm();
  EXPECT_LT(resultant(memory).norm(), 1e-14 * size);
  EXPECT_LT(torque.norm(), 1e-14 * size);
}

TEST(Pressure, ForceOnAClosedSurfaceIsTheGradientOfPressureTimesVolume) {
  const mesh::Mesh mesh = closed_box();
  const AnyLoad load = pressure_on("p", mesh, mesh::surface(mesh, "all"), constant(1e3));
  const Vectors x = mesh.X + random_vectors(mesh.X.cols(), 0.03, 2);
  LoadMemory memory = initial_memory(load);
  advance(load, mesh.X, x, Vectors::Zero(3, x.cols()), no_turns, 0, 0, memory);
  Vectors force = Vectors::Zero(3, x.cols()), moment(3, 0);
  add_forces(load, memory, force, moment);
  // volume is linear in each single coordinate, so a central difference has no error but round-off
  for (Eigen::Index i = 0; i < x.size(); i += 5) {
    Vectors ahead = x, behind = x;
    ahead.data()[i] += 1e-2, behind.data()[i] -= 1e-2;
    const double slope = (volume(mesh, ahead) - volume(mesh, behind)) / 2e-2;
    EXPECT_NEAR(force.data()[i], -1e3 * slope, 1e-11);
  }
}

TEST(Pressure, TurnsWithItsSurface) {
  const mesh::Mesh mesh = closed_box();
  const AnyLoad load = pressure_on("p", mesh, mesh::surface(mesh, "box.z_high"), constant(1e3));
  const Vectors x = mesh.X + random_vectors(mesh.X.cols(), 0.03, 3);
  const Mat3 Q = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  LoadMemory here = initial_memory(load), turned = here;
  advance(load, mesh.X, x, Vectors::Zero(3, x.cols()), no_turns, 0, 0, here);
  advance(load, mesh.X, Q * x, Vectors::Zero(3, x.cols()), no_turns, 0, 0, turned);
  EXPECT_LT((turned.force - Q * here.force).norm(), 1e-14 * here.force.norm());
}

TEST(Radiation, HasThePressureAtRestTwiceThatOfTheWaveThatComesInAndADashpotAlongTheNormal) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.1), {3, 2, 1}});
  const AnyLoad load = radiation_from("r", mesh, mesh::surface(mesh, "box.x_high"), constant(1e3), [](double t) { return 100 * t; }, 50);
  LoadMemory memory = initial_memory(load);
  const Vectors v = Vec3(2, 7, -5).replicate(1, mesh.X.cols());
  advance(load, mesh.X, mesh.X, v, no_turns, 3, 0, memory);
  EXPECT_NEAR((resultant(memory) - Vec3(-(1e3 + 2 * 300 + 50 * 2) * 0.02, 0, 0)).norm(), 0, 1e-12);
}

TEST(Radiation, BooksWhatLeavesAndTakesTheRestFromOutside) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.1), {3, 2, 1}});
  const AnyLoad load = radiation_from("r", mesh, mesh::surface(mesh, "box.x_high"), constant(1e3), constant(100), 50);
  LoadMemory memory = initial_memory(load);
  const Vectors v = Vec3(2, 0, 0).replicate(1, mesh.X.cols());
  advance(load, mesh.X, mesh.X, v, no_turns, 0, 0, memory);
  advance(load, mesh.X, mesh.X + 0.01 * v, v, no_turns, 0.01, 0.01, memory);
  EXPECT_NEAR(memory.dissipated, 50 * 2 * 2 * 0.02 * 0.01, 1e-14);
  Account account;
  post(load, memory, account);
  EXPECT_NEAR(account.work, -(1e3 + 200 + 50 * 2) * 0.02 * 0.02, 1e-12);
  EXPECT_NEAR(account.work + account.stored[Stored::external_work] + account.dissipated[Dissipated::radiated], 0, 1e-14);
  const std::vector<AnyLoad> all{load};
  Scalars mass = Scalars::Constant(mesh.X.cols(), 0.1);
  EXPECT_NEAR(spring_rates(all, mesh.X, mass).damping, 0.5 * 50 * 0.01 / 2 / 0.1, 1e-12) << "two corners of 0.1 by 0.1";
}

TEST(Bubble, HasThePressureOfItsVolumeAndDoesTheWorkOfItsCurve) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.1), {3, 2, 1}});
  const auto curve = [](double v) { return 1e3 / v; };
  double error[2];
  for (const int n : {0, 1}) {
    const AnyLoad load = bubble_under("b", mesh, mesh::surface(mesh, "box.z_low"), curve, 0.01);
    LoadMemory memory = initial_memory(load);
    const int steps = 20 << n;
    const double dt = 1.0 / steps;
    Vectors x = mesh.X;
    const Vectors v = Vec3(0.3, 0, 0.1).replicate(1, x.cols());  // along the surface nothing is swept
    advance(load, mesh.X, x, v, no_turns, 0, 0, memory);
    for (int i = 1; i <= steps; ++i) x += dt * v, advance(load, mesh.X, x, v, no_turns, i * dt, dt, memory);
    EXPECT_NEAR(memory.swept, 0.06 * 0.1, 1e-15);
    EXPECT_NEAR((resultant(memory) - Vec3(0, 0, curve(0.016) * 0.06)).norm(), 0, 1e-9);
    error[n] = std::abs(memory.work - 1e3 * std::log(1.6));
  }
  EXPECT_LT(error[1], 0.3 * error[0]);
  EXPECT_LT(error[1], 0.1);
}

TEST(Bubble, OfASurfaceThatGrowsHasTheVolumeThatItSweepsToTheSecondOrder) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3(0.3, 0.2, 0.1), {3, 2, 1}});
  const AnyLoad load = bubble_under("b", mesh, mesh::surface(mesh, "box.z_low"), [](double) { return 0.0; }, 0.01);
  LoadMemory memory = initial_memory(load);
  const int steps = 20;
  const double dt = 1.0 / steps;
  Vectors x = mesh.X, v = 0.5 * mesh.X;
  v.row(2).setConstant(0.1);
  advance(load, mesh.X, x, v, no_turns, 0, 0, memory);
  for (int i = 1; i <= steps; ++i) x += dt * v, advance(load, mesh.X, x, v, no_turns, i * dt, dt, memory);
  const double exact = 0.06 * 0.1 * (1 + 0.5 + 0.25 / 3);  // the integral of the area (1 + t/2)^2
  EXPECT_NEAR(memory.swept, exact, 1e-3 * exact);
}

TEST(NodalForce, IsSharedEquallyAndBooksWorkAndImpulsesByTheTrapezoidRule) {
  const Vectors X = random_vectors(4, 1, 4), v = random_vectors(4, 1, 5);
  const AnyLoad load = NodalForce{"f", {1, 3}, {[](double t) { return 2 * t; }, constant(0), constant(5)}};
  LoadMemory memory = initial_memory(load);
  advance(load, X, X, v, no_turns, 1, 0, memory);
  EXPECT_EQ(memory.work, 0);
  const double dt = 0.5;
  const Vectors x = X + dt * v;
  advance(load, X, x, v, no_turns, 1 + dt, dt, memory);
  EXPECT_EQ(Vec3(memory.force.col(0)), Vec3(1.5, 0, 2.5));
  const Vec3 mean(1.25, 0, 2.5), first(1, 0, 2.5), last(1.5, 0, 2.5);
  EXPECT_NEAR(memory.work, dt * mean.dot(v.col(1) + v.col(3)), 1e-15);
  EXPECT_NEAR((memory.impulse - 2 * dt * mean).norm(), 0, 1e-15);
  Vec3 angular = Vec3::Zero();
  for (const int n : {1, 3}) angular += 0.5 * dt * (X.col(n).cross(first) + x.col(n).cross(last));
  EXPECT_NEAR((memory.angular_impulse - angular).norm(), 0, 1e-15);
}

TEST(Couple, HasItsMomentAndNoResultant) {
  Vectors x(3, 4), still = Vectors::Zero(3, 4), none(3, 0);
  x << 1, 0, 0, 3, 0, 1, 0, 5, 0, 0, 1, 2;
  const AnyLoad load = Couple{"m", {0, 1, 2, 3}, constant(Vec3(3, 4, -2))};
  LoadMemory memory = initial_memory(load);
  advance(load, x, x, still, none, 0, 0, memory);
  Vec3 moment = Vec3::Zero();
  for (int i = 0; i < 4; ++i) moment += Vec3(x.col(i)).cross(Vec3(memory.force.col(i)));
  EXPECT_LT(resultant(memory).norm(), 1e-14);
  EXPECT_LT((moment - Vec3(3, 4, -2)).norm(), 1e-13);
}

TEST(NodalMoment, ActsOnTurnsAndGivesAngularImpulseOnly) {
  const Vectors X = random_vectors(3, 1, 6), omega = random_vectors(2, 1, 7), v = Vectors::Zero(3, 3);
  const AnyLoad load = NodalMoment{"m", {0, 2}, {1, 0}, constant(Vec3(0, 4, 2))};
  LoadMemory memory = initial_memory(load);
  advance(load, X, X, v, omega, 0, 0, memory);
  advance(load, X, X, v, omega, 0.1, 0.1, memory);
  EXPECT_NEAR(memory.work, 0.1 * Vec3(0, 2, 1).dot(omega.col(0) + omega.col(1)), 1e-15);
  EXPECT_EQ(memory.impulse, Vec3(0, 0, 0));
  EXPECT_NEAR((memory.angular_impulse - Vec3(0, 0.4, 0.2)).norm(), 0, 1e-16);
  EXPECT_EQ(resultant_moment(memory), Vec3(0, 4, 2));
  EXPECT_EQ(resultant(memory), Vec3(0, 0, 0));
}

TEST(BodyForce, IsMassTimesTheFieldAtTheReferencePosition) {
  const Vectors X = random_vectors(3, 1, 8), x = 2 * X;
  const auto field = [](double a, double b, double c, double t) { return a + 2 * b - c * t; };
  const AnyLoad load = BodyForce{"b", {0, 2}, Scalars::Constant(2, 3), {field, field, field}};
  LoadMemory memory = initial_memory(load);
  advance(load, X, x, Vectors::Zero(3, 3), no_turns, 0.5, 0, memory);
  EXPECT_DOUBLE_EQ(memory.force(1, 1), 3 * (X(0, 2) + 2 * X(1, 2) - 0.5 * X(2, 2)));
}

// --- springs -------------------------------------------------------------------------------------

LoadMemory at_rest(const AnyLoad& load, const Vectors& X, const Vectors& x) {
  LoadMemory memory = initial_memory(load);
  advance(load, X, x, Vectors::Zero(3, x.cols()), no_turns, 0, 0, memory);
  return memory;
}

TEST(Spring, ForceIsTheGradientOfItsEnergy) {
  const Vectors X = random_vectors(2, 1, 9), x = X + random_vectors(2, 0.3, 10);
  const double short_length = 0.1;
  for (const AnyLoad& load :
       {AnyLoad(spring_between("s", X, 0, 1, 7, 0)), AnyLoad(spring_between("s", X, 0, 1, 7, 0, &short_length)),
        AnyLoad(spring_to_point("s", X, 0, X.col(0), 7, 0)), AnyLoad(spring_to_point("s", X, 0, Vec3(1, 1, 1), 7, 0))}) {
    Vectors force = Vectors::Zero(3, 2), moment(3, 0);
    add_forces(load, at_rest(load, X, x), force, moment);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double h = 1e-5;  // error h^2 of a length of about one
      Vectors ahead = x, behind = x;
      ahead.data()[i] += h, behind.data()[i] -= h;
      const double slope = (at_rest(load, X, ahead).stored - at_rest(load, X, behind).stored) / (2 * h);
      EXPECT_NEAR(force.data()[i], -slope, 1e-8);
    }
  }
}

TEST(Spring, BetweenNodesHasNoResultantAndNoMomentAndTurnsWithThem) {
  const Vectors X = random_vectors(2, 1, 11), x = X + random_vectors(2, 0.3, 12), v = random_vectors(2, 5, 13);
  const AnyLoad load = spring_between("s", X, 0, 1, 7, 3);
  const Mat3 Q = Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  LoadMemory memory = at_rest(load, X, x), turned = memory;
  advance(load, X, x, v, no_turns, 0.01, 0.01, memory);
  advance(load, X, Q * x, Q * v, no_turns, 0.01, 0.01, turned);
  EXPECT_EQ(resultant(memory), Vec3(0, 0, 0));
  EXPECT_NEAR(Vec3(x.col(1) - x.col(0)).cross(Vec3(memory.force.col(0))).norm(), 0, 1e-14);
  const double stretch = std::abs((x.col(1) - x.col(0)).norm() - (X.col(1) - X.col(0)).norm()) / (X.col(1) - X.col(0)).norm();
  EXPECT_LT((turned.force - Q * memory.force).norm(), 1e-14 / std::min(stretch, 1.0) * memory.force.norm()) << "round-off of a length";
}

TEST(Spring, ADashpotDoesNotResistARigidTurnHoweverLong) {
  const Vectors X = random_vectors(2, 1, 14);
  const AnyLoad load = spring_between("s", X, 0, 1, 0, 3);
  const Mat3 Q = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vectors x = Q * X, v = (x - X) / 0.2;
  LoadMemory memory = at_rest(load, X, X);
  advance(load, X, x, v, no_turns, 0.2, 0.2, memory);
  EXPECT_NEAR(memory.force.norm(), 0, 1e-14);
}

TEST(Spring, WithoutALengthStartsWithoutForceAndToGroundPullsBackAnyDisplacement) {
  const Vectors X = random_vectors(2, 1, 15);
  EXPECT_NEAR(at_rest(spring_between("s", X, 0, 1, 7, 0), X, X).force.norm(), 0, 1e-15);
  const AnyLoad ground = spring_to_point("s", X, 1, X.col(1), 7, 0);
  EXPECT_EQ(at_rest(ground, X, X).force.norm(), 0);
  Vectors x = X;
  x.col(1) += Vec3(0.1, -0.2, 0.3);
  EXPECT_NEAR((Vec3(at_rest(ground, X, x).force.col(0)) - 7 * Vec3(-0.1, 0.2, -0.3)).norm(), 0, 1e-15);
}

TEST(Spring, NeedsTwoDifferentNodes) {
  const Vectors X = random_vectors(2, 1, 16);
  EXPECT_THROW(spring_between("s", X, 0, 0, 1, 0), InternalError);
  EXPECT_THROW(spring_between("s", X, 0, 2, 1, 0), InternalError);
}

TEST(SpringRates, OfOneSpringAreItsOwnAndOfManyBoundTheExactFrequency) {
  const Vectors X = random_vectors(4, 1, 17);
  const Scalars mass = (Scalars(4) << 1, 2, 3, 4).finished();
  const std::vector<AnyLoad> one{spring_between("s", X, 0, 1, 6, 2)};
  EXPECT_DOUBLE_EQ(spring_rates(one, X, mass).omega_squared, 6 * (1 / 1.0 + 1 / 2.0));
  EXPECT_DOUBLE_EQ(spring_rates(one, X, mass).damping, 0.5 * 2 * (1 / 1.0 + 1 / 2.0));
  // a chain 0-1-2-3 along a line: the exact frequencies are those of a tridiagonal matrix
  const double k[] = {6, 3, 9};
  std::vector<AnyLoad> chain;
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
  for (Index i = 0; i < 3; ++i) {
    chain.push_back(spring_between("s", X, i, i + 1, k[i], 0));
    K(i, i) += k[i] / mass(i), K(i + 1, i + 1) += k[i] / mass(i + 1);
    K(i, i + 1) = K(i + 1, i) = -k[i] / std::sqrt(mass(i) * mass(i + 1));
  }
  // the largest eigenvalue by powers
  Eigen::Vector4d mode(1, -1, 1, -1);
  for (int i = 0; i < 1000; ++i) mode = (K * mode).normalized();
  const double exact = mode.dot(K * mode), bound = spring_rates(chain, X, mass).omega_squared;
  EXPECT_GE(bound, exact);
  EXPECT_LT(bound, 2 * exact);
}

TEST(StepWithSprings, IsThatOfEitherAloneAndNeverMore) {
  EXPECT_DOUBLE_EQ(step_with_springs(0.3, {}), 0.3);
  EXPECT_NEAR(step_with_springs(1e300, {.omega_squared = 16, .damping = 0, .stiffest = 0}), 0.5, 1e-15);
  EXPECT_NEAR(step_with_springs(1e300, {.omega_squared = 16, .damping = 3, .stiffest = 0}), 2 / (3 + std::sqrt(9 + 16.0)), 1e-15);
  EXPECT_LT(step_with_springs(0.5, {.omega_squared = 16, .damping = 0, .stiffest = 0}), 0.5 / std::sqrt(2));
}

}  // namespace
}  // namespace nereid::load::loads_test
