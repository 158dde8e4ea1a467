#include "contact/multiplier/restitution.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/multiplier/solve.hpp"
#include "contact/multiplier/stick.hpp"

namespace nereid::contact::restitution_test {
namespace {

/// Nodes of unit mass over a plane z = 0, one condition each, that move away with unit speed and hold energy.
struct Setting {
  Vectors x, v, none{3, 0};
  Scalars mass, no_inertia;
  std::vector<Index> turns;
  std::vector<const Mat3*> allowed, no_rotations;
  std::vector<Restitution> memory;
  Multipliers all;

  explicit Setting(std::vector<double> held, double square = 1) : memory(held.size()) {
    const Index count = static_cast<Index>(held.size());
    x = v = Vectors::Zero(3, count);
    v.row(2).setOnes();
    mass = Scalars::Ones(count);
    turns.assign(count, -1);
    allowed.assign(count, nullptr);
    all = make_multipliers(count);
    for (Index n = 0; n < count; ++n) {
      memory[n].held = held[n];
      Condition& c = begin_condition(all);
      c.normal = Vec3::UnitZ();
      add_member(n, 1, all, c);
      c.per_mass = c.bound = 1, c.before = c.free = 1, c.least = -1;
      all.contactors.push_back(
          {.memory = &memory[n], .first = n, .last = n + 1, .friction = -1, .area = 1, .depth = 0, .impedance = 1,
           .square = square});
    }
    all.velocity = v, all.mobility = mass;
  }
  Multipliers make_multipliers(Index nodes) const { return contact::make_multipliers({}, {}, nodes, 0); }
  void release() {
    make_rows(motion(), all);
    contact::release(motion(), 1, all);
  }
  Motion motion() const { return {x, v, none, none, none, mass, no_inertia, turns, allowed, no_rotations, 1e-3, 1e-3}; }
};

TEST(Restitution, IsGivenBackToTheLastBitOfEnergyAtRelease) {
  for (const double coefficient : {1.0, 0.5, 0.0}) {
    Setting at({0.375}, coefficient * coefficient);
    at.release();
    const double given = coefficient * coefficient * 0.375, speed = at.all.velocity(2, 0);
    EXPECT_NEAR(0.5 * at.all.conditions[0].impulse * (1 + speed), given, 1e-15);  // the work of the impulse
    double transferred = 0;
    Pool pool{0, 1, &transferred, 0};
    EXPECT_NEAR(update_restitution(at.motion(), 1, pool, at.all), 0.375 - given, 1e-15);
    EXPECT_NEAR(at.memory[0].held, 0, 1e-15);
  }
}

TEST(Restitution, StaysWithANodeThatIsPressedOrOnItsWayIn) {
  Setting pressed({0.375}), entering({0.375});
  pressed.all.conditions[0].impulse = 1;  // over 1e-3 s: a force far above that of what it holds
  entering.all.conditions[0].before = -1, entering.all.conditions[0].free = -1, entering.all.velocity(2, 0) = -1;
  for (Setting* at : {&pressed, &entering}) {
    const Vectors before = at->all.velocity;
    at->release();
    EXPECT_EQ((at->all.velocity - before).norm(), 0);
  }
}

TEST(Restitution, IsGivenBackByANodeThatSweepsLeftGoingInByRoundOff) {
  Setting at({0.375});
  at.all.conditions[0].before = at.all.conditions[0].free = 0, at.all.velocity(2, 0) = -1e-6;
  at.release();
  EXPECT_NEAR(at.all.velocity(2, 0), std::sqrt(2 * 0.375), 1e-5);
}

TEST(Restitution, OfNextToNothingChangesNothingElse) {
  // node 1 has a gap that the iterations have not quite closed, node 2 friction that does not quite hold; node 0 lets go
  for (const double held : {0.375, 1e-13}) {
    Setting at({held, 0, 0});
    Condition& left = at.all.conditions[1];
    left.impulse = 1, left.least = 1.01;
    Condition& pressed = at.all.conditions[2];
    pressed.impulse = 1, pressed.least = 1;
    at.v.col(2) = at.all.velocity.col(2) = Vec3(0.01, 0, 1);
    Touch touch;
    touch.normal = Vec3::UnitZ(), touch.apex = 2, touch.nodes = 0;
    at.all.contactors[2].friction = add_friction(touch, {.coefficient = 0.5}, Vec3::Zero(), true, at.motion(), at.all.frictions);
    FrictionCondition& friction = at.all.frictions[0];
    friction.bound = friction.per_mass = 1, friction.impulse = Vec3(-0.2, 0, 0);
    at.release();
    EXPECT_GT(at.all.conditions[0].impulse, 0);
    EXPECT_EQ(at.all.conditions[1].impulse, 1);
    EXPECT_EQ(at.all.conditions[2].impulse, 1);
    EXPECT_LT((at.all.frictions[0].impulse - Vec3(-0.2, 0, 0)).norm(), 1e-15);
  }
}

TEST(Restitution, OfABlowBeforeStaysWhereAnotherBegins) {
  Setting at({1e-9});
  at.all.contactors[0].work = -1;  // what round-off has left would let this one node give back in the step of the blow
  at.release();
  EXPECT_EQ(at.all.conditions[0].impulse, 0);
}

TEST(Restitution, OfANodeOnARidgeGoesAlongNeitherSide) {
  const double s = std::sqrt(0.5);
  for (const double left_of_both : {0.5, 0.3}) {
    Setting at({0.375});
    Condition other = at.all.conditions[0];
    for (Condition* c : {&at.all.conditions[0], &other}) c->before = c->free = s, c->bound = 2;
    at.all.conditions[0].normal = Vec3(0, -s, s), other.normal = Vec3(0, s, s);
    other.first = 1;
    for (Index k = 0; k < 2; ++k) {
      const Vec3 normal = k == 0 ? at.all.conditions[0].normal : other.normal;
      if (k == 0) at.all.members[0].push = normal;
      else at.all.members.push_back({0, 1, normal});
    }
    at.all.conditions[0].impulse = 1e-9 * left_of_both, other.impulse = 1e-9 * (1 - left_of_both);
    at.all.conditions.push_back(other);
    at.all.contactors[0].last = 2, at.all.contactors[0].impedance = std::numeric_limits<double>::infinity();
    at.release();
    const Vec3 given = at.all.velocity.col(0) - Vec3::UnitZ();
    EXPECT_GT(given.z(), 0.1);
    EXPECT_NEAR(given.y() / given.z(), 1 - 2 * left_of_both, 1e-9) << "as it is pressed";
    EXPECT_LE(0.5 * at.all.velocity.col(0).squaredNorm(), 0.5 + 0.375 + 1e-12);
  }
}

TEST(Restitution, OfRoundOffMakesNoForceAfterARelease) {
  Setting at({1e-18});
  at.release();
  EXPECT_EQ(at.all.conditions[0].impulse, 0);
  EXPECT_EQ(at.memory[0].held, 1e-18);  // it is taken for good where the node is no longer near
}

TEST(Restitution, IsGivenBackWithoutAForceWhateverTheImpedance) {
  for (const double impedance : {0.0, 1.0, std::numeric_limits<double>::infinity()}) {
    Setting at({0.375});
    at.all.contactors[0].impedance = impedance;
    at.release();
    EXPECT_NEAR(at.all.contactors[0].work, 0.375, 1e-15);
  }
}

TEST(Restitution, CoversTheDeficitsOfNeighboursInProportion) {
  Setting at({3, -1, 1});
  double transferred[] = {0, 0};
  Pool pools[] = {{0, 2, &transferred[0], 0, 3, 1}, {2, 3, &transferred[1], 0, 1, 0}};
  balance(pools, at.all);
  EXPECT_NEAR(at.memory[0].held, 2.25, 1e-15);
  EXPECT_EQ(at.memory[1].held, 0);
  EXPECT_NEAR(at.memory[2].held, 0.75, 1e-15);
  EXPECT_NEAR(transferred[0], -0.25, 1e-15);
  EXPECT_NEAR(transferred[1], 0.25, 1e-15);
}

TEST(Restitution, LeavesADeficitThatNothingCovers) {
  Setting at({1, -3});
  double transferred = 0;
  Pool pool{0, 2, &transferred, 0, 1, 3};
  balance({&pool, 1}, at.all);
  EXPECT_NEAR(pool.deficit, 2, 1e-15);
  EXPECT_EQ(at.memory[0].held, 0);
  EXPECT_NEAR(at.memory[1].held, -2, 1e-15);
  EXPECT_EQ(held(0, 2, at.all), 0);
  EXPECT_EQ(transferred, 0);
  double impact = 0;
  discard(at.memory[1], impact);
  EXPECT_EQ(impact, 0);  // it stays created
}

TEST(Restitution, WhatFrictionGaveIsCoveredByWhatOtherFrictionTookThenByWhatIsHeld) {
  Setting at({1, 1, -1});
  double transferred[] = {0, 0};
  Pool pools[] = {{0, 2, &transferred[0], -3}, {2, 3, &transferred[1], 0.5}};
  balance_friction(pools);
  EXPECT_NEAR(pools[0].rubbed, -2.5, 1e-15);
  EXPECT_EQ(pools[1].rubbed, 0);
  EXPECT_NEAR(transferred[0], -0.5, 1e-15);
  EXPECT_NEAR(transferred[1], 0.5, 1e-15);
  pay_for_friction(pools[0], at.all);
  EXPECT_NEAR(pools[0].rubbed, -0.5, 1e-15);  // what nothing covers is owed
  EXPECT_EQ(at.memory[0].held, 0);
  EXPECT_EQ(at.memory[2].held, -1);
}

TEST(Unreleased, GoesToWhatActsAtTheSameNodes) {
  Setting at({1, 2, 4});  // a condition at each of three nodes
  Memory from;
  const std::array<Index, 2> nodes{0, 2};
  Restitution ended{.held = 8};
  end(nodes, 1, ended, from, at.all);
  EXPECT_EQ(ended.held, 0);
  spread_unreleased(at.all);
  double to = 0;
  take_unreleased(0, 3, to, at.all);
  EXPECT_EQ(at.memory[0].held, 5);
  EXPECT_EQ(at.memory[1].held, 2);
  EXPECT_EQ(at.memory[2].held, 8);
  EXPECT_EQ(at.memory[0].kept, 4);
  EXPECT_EQ(from.transferred, 8);
  EXPECT_EQ(to, -8);
  EXPECT_EQ(from.impact, 0);
}

TEST(Unreleased, LosesByItsOwnCoefficientAndNotByThatOfWhatTakesIt) {
  for (const double coefficient : {0.0, 0.5}) {
    Setting at({0}, 0.25);  // moves apart without a force, so that it is released
    Memory from;
    const std::array<Index, 1> nodes{0};
    Restitution ended{.held = 8, .kept = 2};  // 2 of it has had its loss
    end(nodes, coefficient, ended, from, at.all);
    const double lost = (1 - coefficient * coefficient) * 6;
    EXPECT_EQ(from.impact, lost);
    spread_unreleased(at.all);
    double to = 0;
    take_unreleased(0, 1, to, at.all);
    EXPECT_EQ(at.memory[0].held, 8 - lost);
    at.release();
    EXPECT_EQ(at.all.contactors[0].lost, 0);
    EXPECT_NEAR(at.all.contactors[0].work, 8 - lost, 1e-14);
  }
}

TEST(Unreleased, IsSharedByAllThatActAtANode) {
  Setting at({0, 0});
  at.all.members[static_cast<std::size_t>(at.all.conditions[1].first)].node = 0;  // both at one node
  Memory from;
  const std::array<Index, 2> nodes{0, 1};
  Restitution ended{.held = 6};
  end(nodes, 1, ended, from, at.all);
  spread_unreleased(at.all);
  double first = 0, second = 0;
  take_unreleased(0, 1, first, at.all), take_unreleased(1, 2, second, at.all);
  EXPECT_EQ(at.memory[0].held, 3);
  EXPECT_EQ(at.memory[1].held, 3);
  EXPECT_EQ(from.transferred + first + second, 0);
}

TEST(Unreleased, IsLostWhereNothingActsAndADebtIsNotHandedOn) {
  Setting at({1});
  Memory from;
  const std::array<Index, 1> elsewhere{7}, here{0};
  at.all.at_node.resize(8);
  Restitution ended{.held = 3}, debt{.held = -2};
  end(elsewhere, 1, ended, from, at.all);
  end(here, 1, debt, from, at.all);
  spread_unreleased(at.all);
  double to = 0;
  take_unreleased(0, 1, to, at.all);
  EXPECT_EQ(at.memory[0].held, 1);
  EXPECT_EQ(from.impact, 3);
  EXPECT_EQ(from.transferred, 0);
  EXPECT_EQ(debt.held, 0);
}

}  // namespace
}  // namespace nereid::contact::restitution_test
