#include "dynamics/rigid_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "mesh/box.hpp"
#include "mesh/placement.hpp"
#include "tests/dynamics/scene.hpp"

namespace nereid::dynamics::rigid_step_test {
namespace {

const material::Elastic steel{7850, 210e9, 0.3};

load::OverTime constant(double value) {
  return [value](double) { return value; };
}

/// Blocks side by side along x, those in `rigid` as rigid bodies.
Scene blocks(const std::vector<Vec3>& low, const std::vector<char>& rigid, const Vec3& size = {0.1, 0.2, 0.05}) {
  Scene s;
  for (std::size_t b = 0; b < low.size(); ++b) {
    const mesh::Mesh one = mesh::box(std::string(1, static_cast<char>('a' + b)), {low[b], low[b] + size, {2, 3, 1}});
    s.model.mesh = b == 0 ? one : mesh::join(s.model.mesh, one);
  }
  for (std::size_t b = 0; b < low.size(); ++b) {
    const std::string name(1, static_cast<char>('a' + b));
    s.model.blocks.push_back(element::hexahedra(s.model.mesh, name, steel, {}));
    s.model.rigid_of_block.push_back(-1);
    if (!rigid[b]) continue;
    rigid::Moments sum;
    rigid::add_hexahedra(s.model.mesh.X, mesh::hexahedra(s.model.mesh, name).nodes, steel.density, low[b], sum);
    s.model.rigid_of_block.back() = static_cast<Index>(s.model.rigid_bodies.size());
    s.model.rigid_bodies.push_back(
        rigid::make_body(name, rigid::properties(sum, low[b]), s.model.mesh.X, mesh::node_set(s.model.mesh, name)));
  }
  s.model.held_bodies.resize(s.model.rigid_bodies.size());
  return s;
}

void spin(Scene& s, const std::string& body, const Vec3& velocity, const Vec3& spin, const Vec3& about) {
  for (const Index node : mesh::node_set(s.model.mesh, body))
    s.state.v.col(node) = velocity + spin.cross(Vec3(s.model.mesh.X.col(node) - about));
}

void expect_balance(const Scene& s, double energy, double momentum) {
  EXPECT_LT(std::abs(energy_residual(s.state.ledger)), 1e-12 * energy);
  EXPECT_LT(momentum_residual(s.state.ledger).norm(), 1e-12 * momentum);
  EXPECT_LT(angular_momentum_residual(s.state.ledger).norm(), 1e-12 * momentum);
}

TEST(RigidStep, FallsExactlyAndSpinsWithoutLoss) {
  Scene s = blocks({{0, 0, 0}}, {1});
  s.model.gravity = Vec3(1, 0, -10);
  s.model.longest_step = 1e-3;
  finalize(s.model);
  s.ready();
  spin(s, "a", {1, 2, 3}, {10, 20, -5}, {0.05, 0.1, 0.025});
  s.run_to(1);
  const Vec3 way = s.state.rigid_bodies[0].shift;
  EXPECT_LT((way - Vec3(1.5, 2, -2)).norm(), 1e-12);
  expect_balance(s, s.state.ledger.initial_kinetic, 100);
  EXPECT_LT(std::abs(s.state.ledger.integration), 1e-12 * s.state.ledger.initial_kinetic);
}

TEST(RigidStep, ElementsOfRigidBodiesAreNotUpdated) {
  Scene s = blocks({{0, 0, 0}, {0.3, 0, 0}}, {1, 0});
  s.model.longest_step = 1e-5;
  finalize(s.model);
  s.ready();
  const Outcome outcome = s.run_to(1e-4);
  EXPECT_EQ(outcome.element_updates, 6 * (s.state.step + 1));
}

TEST(RigidStep, EveryLoadIsInTheLedger) {
  Scene s = blocks({{0, 0, 0}, {0.3, 0, 0}}, {1, 0});
  const mesh::Mesh& mesh = s.model.mesh;
  s.model.gravity = Vec3(0, 0, -10);
  s.model.longest_step = 1e-5;
  s.model.loads.emplace_back(load::NodalForce{"force", {0, 3}, {constant(3000), constant(0), constant(1000)}});
  s.model.loads.emplace_back(load::pressure_on("pressure", mesh, mesh::surface(mesh, "a.y_low"), constant(1e6)));
  s.model.loads.emplace_back(load::Couple{"couple", mesh::node_set(mesh, "a"), {constant(0), constant(50), constant(80)}});
  s.model.loads.emplace_back(load::spring_between("spring", mesh.X, 0, mesh::node_set(mesh, "b")[1], 1e6, 100));
  s.model.loads.emplace_back(load::spring_to_point("anchor", mesh.X, 4, Vec3(0, 0, 1), 1e5, 0));
  finalize(s.model);
  s.ready();
  spin(s, "a", {1, 2, 3}, {100, 200, -50}, {0.05, 0.1, 0.025});
  s.run_to(2e-3);
  expect_balance(s, 3000, 200);
  EXPECT_GT(s.state.rigid_bodies[0].shift.norm(), 5e-3);
  // what rotation adds goes with the square of the step: with ten times as many it is nothing
  EXPECT_LT(std::abs(s.state.ledger.integration_kept), 1e-6 * s.state.ledger.initial_kinetic);
}

TEST(RigidStep, ARunGoesOnWithTheSameBits) {
  const auto scene = [] {
    Scene s = blocks({{0, 0, 0}, {0.1003, 0.05, 0.01}}, {1, 1});
    s.model.longest_step = 1e-5;
    s.model.gravity = Vec3(0, 0, -10);
    finalize(s.model);
    InterfaceOptions options;
    options.friction.coefficient = 0.3;
    options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
    s.joined("touch", "a.x_high", "b.x_low", options);
    s.ready();
    spin(s, "a", {3, 0, 0}, {10, 20, -5}, {0.05, 0.1, 0.025});
    return s;
  };
  Scene whole = scene(), parts = scene();
  const Pace pace{.fixed = 1e-5};
  start(whole.model, pace, whole.state, whole.forces), start(parts.model, pace, parts.state, parts.forces);
  for (int k = 0; k < 40; ++k) {
    step(whole.model, 1e-5, pace, whole.state, whole.forces);
    step(parts.model, 1e-5, pace, parts.state, parts.forces);
    if (k % 7 != 0) continue;
    parts.forces = make_forces(parts.model);
    resume(parts.model, parts.state, parts.forces);
  }
  EXPECT_GT(std::get<contact::Memory>(whole.state.contacts[0]).impulse.norm(), 1);
  for (int b = 0; b < 2; ++b) {
    const rigid::State &one = whole.state.rigid_bodies[b], &other = parts.state.rigid_bodies[b];
    EXPECT_EQ(one.momentum, other.momentum);
    EXPECT_EQ(one.angular_momentum, other.angular_momentum);
    EXPECT_EQ(one.turn.vector, other.turn.vector);
  }
  EXPECT_EQ(whole.state.x, parts.state.x);
}

TEST(RigidStep, BodiesThatCollideKeepMomentumAndEnergy) {
  for (const bool both : {true, false})
    for (const auto method : {contact::Method::multiplier, contact::Method::penalty}) {
      Scene s = blocks({{0, 0, 0}, {0.11, 0.05, 0.01}}, {1, both});
      s.model.longest_step = 5e-6;
      finalize(s.model);
      InterfaceOptions options;
      options.method = method;
      options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
      options.friction.coefficient = 0.2;
      s.joined("touch", "b.x_low", "a.x_high", options);
      s.ready();
      spin(s, "a", {10, 0, 0}, {1, 2, 3}, {0.05, 0.1, 0.025});
      const Outcome outcome = s.run_to(3e-3);
      EXPECT_EQ(outcome.ending, Ending::reached_end) << outcome.reason;
      const Ledger& ledger = s.state.ledger;
      expect_balance(s, ledger.initial_kinetic, ledger.initial_momentum.norm());
      EXPECT_LT((ledger.momentum - ledger.initial_momentum).norm(), 1e-11 * ledger.initial_momentum.norm());
      EXPECT_LT((ledger.angular_momentum - ledger.initial_angular_momentum).norm(), 1e-11 * ledger.initial_momentum.norm());
      EXPECT_GT(s.state.v(0, mesh::node_set(s.model.mesh, "b")[0]), 1);
      EXPECT_LT(std::abs(created(account(s, "touch"))), 1e-3 * ledger.initial_kinetic);
      EXPECT_LT(std::abs(ledger.integration_kept), 1e-3 * ledger.initial_kinetic);
    }
}

TEST(RigidStep, WhatItsTurnStopsAtTheStartIsAccountedFor) {
  for (const bool driven : {false, true}) {
    Scene s = blocks({{0, 0, 0}, {0.1, 0, 0}}, {1, 0});  // they touch
    s.model.longest_step = 5e-6;
    if (driven) {
      load::Plane driver = plane("driver", load::PlaneKind::driven, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "a"));
      driver.field[0] = [](double, double, double, double t) { return 10 + 1e5 * t; };
      driver.angular_velocity[2] = [](double, double, double, double) { return 300.0; };
      s.model.constraints.planes = {driver};
      s.model.held_bodies[0] = {.rows = {}, .first = -1, .driver = 0};
    }
    finalize(s.model);
    InterfaceOptions options;
    options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
    options.method = contact::Method::multiplier;
    options.friction.coefficient = 0.2;
    s.joined("touch", "b.x_low", "a.x_high", options);
    s.ready();
    spin(s, "a", {10, 0, 0}, {0, 50, 300}, {0.05, 0.1, 0.025});
    s.run_to(1e-4);
    EXPECT_GT(std::get<contact::Memory>(s.state.contacts[0]).impulse.norm(), 1);
    expect_balance(s, 100 * s.state.ledger.initial_kinetic, 100 * s.state.ledger.initial_momentum.norm());
  }
}

TEST(RigidStep, EqualBallsOfOneNodeEachExchangeTheirVelocities) {
  // face to face and through the centres: the first stops
  Scene s = blocks({{0, 0, 0}, {0.11, 0, 0}}, {1, 1});
  s.model.longest_step = 1e-4;
  finalize(s.model);
  InterfaceOptions options;
  options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
  s.joined("touch", "b.x_low", "a.x_high", options);
  s.ready();
  spin(s, "a", {1, 0, 0}, Vec3::Zero(), Vec3::Zero());
  s.run_to(0.03);
  EXPECT_NEAR(s.state.rigid_bodies[0].momentum.x(), 0, 1e-5 * s.model.rigid_bodies[0].mass.mass);
  EXPECT_NEAR(s.state.rigid_bodies[1].momentum.x(), s.model.rigid_bodies[1].mass.mass, 1e-5 * s.model.rigid_bodies[1].mass.mass);
}

TEST(RigidStep, BodiesPartWithTheirRestitution) {
  for (const double restitution : {0.3, 0.5, 0.9}) {
    Scene s = blocks({{0, 0, 0}, {0.11, 0, 0}}, {1, 1});
    s.model.longest_step = 1e-4;
    finalize(s.model);
    InterfaceOptions options;
    options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
    options.method = contact::Method::multiplier;
    options.restitution = restitution;
    s.joined("touch", "b.x_low", "a.x_high", options);
    s.ready();
    spin(s, "a", {1, 0, 0}, Vec3::Zero(), Vec3::Zero());
    s.run_to(0.03);
    const double parted = (s.state.rigid_bodies[1].momentum - s.state.rigid_bodies[0].momentum).x() / s.model.rigid_bodies[0].mass.mass;
    EXPECT_NEAR(parted, restitution, 2e-3);  // the step of the first touch ends where they meet, so that a little speed is left
  }
}

TEST(RigidStep, APlaneHoldsAFaceAndTakesItsReaction) {
  Scene s = blocks({{0, 0, 0}}, {1});
  rigid::Body& body = s.model.rigid_bodies[0];
  s.model.constraints.planes = {plane("hold", load::PlaneKind::constrained, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "a.z_low"))};
  body.hold = {.shift = Vec3(1, 1, 0).asDiagonal(), .turns = 1, .axis = Vec3::UnitZ()};
  s.model.held_bodies[0] = {.rows = {{0, Vec3::UnitZ(), Vec3::UnitZ()}}, .first = 0};
  s.model.gravity = Vec3(2, 0, -10);
  s.model.longest_step = 1e-3;
  finalize(s.model);
  s.ready();
  spin(s, "a", {0, 1, 0}, {0, 0, 8}, {0.05, 0.1, 0.025});
  s.run_to(0.5);
  const double mass = body.mass.mass;
  EXPECT_LT((s.state.rigid_bodies[0].shift - Vec3(0.25, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((account(s, "hold").impulse - Vec3(0, 0, 0.5 * 10 * mass)).norm(), 1e-10);
  EXPECT_NEAR(s.state.rigid_bodies[0].angular_momentum.z(), 8 * body.mass.inertia(2, 2), 1e-12);
  expect_balance(s, s.state.ledger.initial_kinetic, 100);
}

TEST(RigidStep, ADriverMovesItAsItSaysAndTakesTheWork) {
  Scene s = blocks({{0, 0, 0}}, {1});
  load::Plane driver = plane("driver", load::PlaneKind::driven, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "a"));
  driver.field[0] = [](double, double, double, double t) { return 3 * t; };
  driver.angular_velocity[1] = [](double, double, double, double) { return 5.0; };
  s.model.constraints.planes = {driver};
  s.model.held_bodies[0] = {.rows = {}, .first = -1, .driver = 0};
  s.model.gravity = Vec3(0, 0, -10);
  s.model.longest_step = 1e-4;
  finalize(s.model);
  s.ready();
  s.run_to(0.2);
  const double mass = s.model.rigid_bodies[0].mass.mass;
  EXPECT_LT((s.state.rigid_bodies[0].shift - Vec3(1.5 * 0.04, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(2 * std::asin(s.state.rigid_bodies[0].turn.vector.y()), 1, 1e-6);
  EXPECT_NEAR(account(s, "driver").impulse.z(), 0.2 * 10 * mass, 1e-9);
  const double turning = s.model.rigid_bodies[0].mass.inertia(1, 1);
  EXPECT_NEAR(account(s, "driver").work, 0.5 * mass * 0.36 + 0.5 * turning * 25, 1e-9);  // the turn begins at once
  expect_balance(s, 0.5 * mass, mass);
}

TEST(RigidStep, ADriverTakesTheMomentOfATurnAboutNoPrincipalAxis) {
  Scene s = blocks({{0, 0, 0}}, {1});
  load::Plane driver = plane("driver", load::PlaneKind::driven, Vec3::UnitZ(), mesh::node_set(s.model.mesh, "a"));
  driver.angular_velocity[0] = driver.angular_velocity[1] = [](double, double, double, double) { return 5.0; };
  s.model.constraints.planes = {driver};
  s.model.held_bodies[0] = {.rows = {}, .first = -1, .driver = 0};
  s.model.longest_step = 1e-4;
  finalize(s.model);
  s.ready();
  s.run_to(0.1);
  const double mass = s.model.rigid_bodies[0].mass.mass;
  EXPECT_GT(s.state.rigid_bodies[0].angular_momentum.cross(Vec3(1, 1, 0)).norm(), 1e-3 * mass) << "it wobbles";
  expect_balance(s, mass, mass);
}

}  // namespace
}  // namespace nereid::dynamics::rigid_step_test
