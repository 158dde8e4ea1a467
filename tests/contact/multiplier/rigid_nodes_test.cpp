#include "contact/multiplier/rigid_nodes.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/dense.hpp"
#include "contact/multiplier/enforce.hpp"
#include "contact/multiplier/predict.hpp"
#include "contact/multiplier/solve.hpp"

namespace nereid::contact::rigid_nodes_test {
namespace {

/// A rigid body of eight nodes beside four that are free, in the step to come.
struct Setting {
  Vectors x{3, 12}, v, force, none{3, 0};
  Scalars mass = Scalars::Constant(12, 0.2), no_inertia;
  std::vector<Index> turns = std::vector<Index>(12, -1), of_node = std::vector<Index>(12, -1);
  std::vector<const Mat3*> allowed = std::vector<const Mat3*>(12, nullptr), no_rotations;
  std::vector<rigid::Body> bodies;
  rigid::State state;
  RigidNodes rigid;
  Multipliers all;
  double next = 1e-3;

  Setting() {
    for (int i = 0; i < 8; ++i) x.col(i) = Vec3(i & 1 ? 1 : -1, i & 2 ? 2 : -2, i & 4 ? 0.5 : -0.5), of_node[i] = 0;
    for (int i = 8; i < 12; ++i) x.col(i) = Vec3(i & 1 ? 1 : -1, i & 2 ? 2 : -2, -0.6);
    v = force = Vectors::Zero(3, 12);
    Mat3 inertia = Vec3(3, 1.5, 4).asDiagonal();
    inertia(0, 1) = inertia(1, 0) = 0.2;
    bodies.push_back(rigid::make_body("body", {2, Vec3(0.1, 0, 0.05), inertia}, x, {0, 1, 2, 3, 4, 5, 6, 7}));
    rigid::set_velocities(bodies[0], Vec3(1, 2, 3), Vec3(5, -6, 7), state);
    all.velocity = all.ahead = all.way = Vectors::Zero(3, 12);
    all.spin = Vectors(3, 0);
    all.shared = all.rubbed = Scalars::Zero(12), all.mobility = mass.cwiseInverse();
    rigid.of_node = of_node;
    rigid.bodies.resize(1);
    rigid.bodies[0].nodes = {0, 1, 2, 3};
    begin(bodies[0], state, next, rigid.bodies[0]);
  }
  Motion motion() {
    return {x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, next, next, nullptr, &rigid};
  }
  /// A node of the body over a plane, or over a free node.
  void add(Index node, Index base, const Vec3& normal) {
    Condition& c = begin_condition(all);
    c.normal = normal.normalized();
    add_member(node, 1, all, c);
    if (base >= 0) add_member(base, -1, all, c);
    const auto at = static_cast<Index>(all.conditions.size());
    all.contactors.push_back({.memory = nullptr, .first = at - 1, .last = at, .friction = -1, .area = 1, .depth = 0, .impedance = 0,
                              .square = 0});
  }
};

TEST(RigidNodes, NodesGoWhereTheBodyGoes) {
  Setting at;
  look_ahead(at.rigid, at.motion(), at.all);
  rigid::State end = at.state;
  rigid::drift(at.bodies[0], rigid::twist_of(at.bodies[0], end, at.next), at.next, end);
  Vectors x = at.x;
  rigid::place_nodes(at.bodies[0], end, at.x, x);
  for (const Index node : at.rigid.bodies[0].nodes) EXPECT_LT((at.all.ahead.col(node) - x.col(node)).norm(), 1e-15);
}

TEST(RigidNodes, ImpulsesAtNodesMoveTheWholeBodyExactly) {
  Setting at;
  look_ahead(at.rigid, at.motion(), at.all);
  at.add(0, -1, {1, 2, 3}), at.add(3, 8, {0, 0, 1});
  make_rows(at.motion(), at.all);
  give(at.all.conditions[0].row, 0.3, at.all.rows);
  give(at.all.conditions[1].row, 0.7, at.all.rows);
  move(at.all.rows);
  const std::array<double, 2> by_movers{rate(at.all.conditions[0], at.all), rate(at.all.conditions[1], at.all)};
  const double differs = find_velocities(at.motion(), at.all);
  EXPECT_GT(differs, 1e-4) << "it turns by 0.01 in a step";
  double most = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Condition& c = at.all.conditions[k];
    EXPECT_NEAR(rate(c, at.all), relative(c, at.all, at.all.velocity), 1e-14);
    most = std::max(most, std::abs(rate(c, at.all) - by_movers[k]));
  }
  EXPECT_NEAR(differs, most, 1e-14);
  const Vec3 first = 0.3 * Vec3(1, 2, 3).normalized(), second(0, 0, 0.7), centre(0.1, 0, 0.05);
  rigid::State end = at.state;
  const Vec3 turning = (at.x.col(0) - centre).cross(first) + (at.x.col(3) - centre).cross(second);
  rigid::kick(at.bodies[0], first + second, turning, end);
  const rigid::Twist twist = rigid::twist_of(at.bodies[0], end, at.next);
  for (const Index node : at.rigid.bodies[0].nodes)
    EXPECT_LT((at.all.velocity.col(node) - rigid::velocity_at(twist, at.x.col(node) - centre, at.next)).norm(), 1e-13);
  EXPECT_LT((at.all.velocity.col(8) + second / 0.2).norm(), 1e-14);
}

TEST(RigidNodes, ResponsesAreDifferencesOfRates) {
  Setting at;
  look_ahead(at.rigid, at.motion(), at.all);
  at.add(1, 9, {1, -2, 3});
  make_rows(at.motion(), at.all);
  const Condition& c = at.all.conditions[0];
  const double before = rate(c, at.all), small = 1e-5;
  give(c.row, small, at.all.rows);
  move(at.all.rows);
  EXPECT_NEAR(per_mass(at.rigid, at.motion(), at.all, c), (rate(c, at.all) - before) / small, 1e-9) << "by movers";
  find_velocities(at.motion(), at.all);
  const double found = (rate(c, at.all) - before) / small;
  EXPECT_NEAR(per_mass(at.rigid, at.motion(), at.all, c), found, 0.01 * found);  // the turn of the step, |w| dt = 0.01, is in the rates
}

TEST(RigidNodes, BoundsHoldAndAreExactWhereAllPushAlike) {
  Setting at;
  at.add(0, 8, {0.1, 0, 1}), at.add(1, 9, {0, 0, 1}), at.add(2, -1, {0, 0.3, 1}), at.add(3, -1, {1, 0, 1});
  const Motion m = at.motion();
  Eigen::Matrix4d A;
  at.rigid.bodies[0].state.angular_momentum.setZero();  // no turn: rates are linear
  for (int k = 0; k < 4; ++k) {
    at.all.velocity.setZero();
    at.rigid.bodies[0].state = {};
    at.rigid.bodies[0].twist = {};
    make_rows(m, at.all);
    give(at.all.conditions[k].row, 1e-6, at.all.rows);
    move(at.all.rows);
    find_velocities(m, at.all);
    for (int l = 0; l < 4; ++l) A(l, k) = rate(at.all.conditions[l], at.all) / 1e-6;
  }
  EXPECT_LT((A - A.transpose()).norm(), 1e-6 * A.norm());
  for (int k = 0; k < 4; ++k) {
    Condition& c = at.all.conditions[k];
    EXPECT_NEAR(per_mass(at.rigid, m, at.all, c), A(k, k), 1e-5 * A(k, k));
    c.bound = c.nodes > 1 ? 1 / 0.2 : 0;  // of the free node
  }
  leave_out(at.rigid, at.all);
  add_bounds(at.rigid, m, at.all);
  Eigen::Matrix4d scaled = A;
  for (int k = 0; k < 4; ++k) {
    EXPECT_GE(at.all.conditions[k].bound, A.row(k).cwiseAbs().sum() * (1 - 1e-9));
    for (int l = 0; l < 4; ++l) scaled(k, l) /= std::sqrt(at.all.conditions[k].bound * at.all.conditions[l].bound);
  }
  EXPECT_LE(eigenvalues(scaled)(3), 1);
}

TEST(RigidNodes, BoundsAreNumbersWhereABodyIsHeldAlongAnObliqueNormal) {
  int below_zero = 0;  // by round-off
  for (int k = 1; k <= 200; ++k) {
    Setting at;
    const Vec3 held = Vec3(std::sin(k), std::cos(3.0 * k), std::sin(2.0 * k + 1)).normalized();
    at.rigid.bodies[0].shift = (Mat3::Identity() - held * held.transpose()) / 2;
    at.rigid.bodies[0].turn.setZero();
    at.add(0, -1, held), at.add(1, -1, held.unitOrthogonal());
    below_zero += held.dot(at.rigid.bodies[0].shift * held) < 0;
    make_rows(at.motion(), at.all);
    add_bounds(at.rigid, at.motion(), at.all);
    for (const Condition& c : at.all.conditions) EXPECT_TRUE(std::isfinite(c.bound)) << k;
  }
  EXPECT_GT(below_zero, 0);
}

}  // namespace
}  // namespace nereid::contact::rigid_nodes_test
