#include "contact/multiplier/blow.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "contact/multiplier/predict.hpp"
#include "contact/multiplier/restitution.hpp"
#include "contact/multiplier/rigid_nodes.hpp"
#include "contact/multiplier/solve.hpp"

namespace nereid::contact::blow_test {
namespace {

/// Rigid bodies in a step so short that they do not turn in it, each with eight nodes around its centre, that touch at some of them.
struct Setting {
  static constexpr int corners = 8;
  Vectors x, v, none{3, 0}, force;
  Scalars mass, no_inertia;
  std::vector<Index> turns;
  std::vector<const Mat3*> allowed, no_rotations;
  std::vector<rigid::Body> bodies;
  std::vector<rigid::State> states;
  RigidNodes rigid;
  std::vector<Restitution> memory;
  Multipliers all;
  std::vector<double> approach, impulse;  ///< [m/s] [N s] [conditions] before the blow, and in its first step
  double next = 1e-9, t = 1, before = 0;

  explicit Setting(const std::vector<double>& masses) {
    const auto count = static_cast<Index>(masses.size()), nodes = corners * count;
    x = v = force = Vectors::Zero(3, nodes);
    turns.assign(nodes, -1), allowed.assign(nodes, nullptr);
    mass = Scalars::Constant(nodes, 0.1);
    rigid.of_node.assign(nodes, -1), rigid.bodies.resize(masses.size());
    states.resize(masses.size()), memory.reserve(64);
    for (Index b = 0; b < count; ++b) {
      Subset own;
      for (Index i = 0; i < corners; ++i) {
        const Index node = corners * b + i;
        x.col(node) = Vec3(2.0 * b + (i & 1 ? 1 : -1), i & 2 ? 0.8 : -0.8, i & 4 ? 0.5 : -0.5);
        own.push_back(node), rigid.of_node[node] = b;
      }
      const double m = masses[static_cast<std::size_t>(b)];
      bodies.push_back(rigid::make_body("b" + std::to_string(b), {m, Vec3(2.0 * b, 0, 0), m * Mat3(Vec3(0.3, 0.5, 0.4).asDiagonal())}, x,
                                        own));
      rigid.bodies[b].nodes = own;
    }
    all = make_multipliers({}, {}, nodes, 0);
  }
  Motion motion() { return {x, v, none, force, none, mass, no_inertia, turns, allowed, no_rotations, next, next, nullptr, &rigid}; }

  void set_velocity(Index b, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
    rigid::set_velocities(bodies[b], velocity, spin, states[b]);
  }
  /// A contactor of node `apex` on node `base`, or on a rigid plane; its normal goes from the base to the apex.
  void touch(Index apex, Index base, const Vec3& normal, double coefficient = 1) {
    memory.emplace_back();
    Condition& c = begin_condition(all);
    c.normal = normal.normalized(), c.least = 0, c.gap = 0;
    add_member(apex, 1, all, c);
    if (base >= 0) add_member(base, -1, all, c);
    c.impulse = c.change = c.met = c.moved = 0;
    const auto at = static_cast<Index>(all.conditions.size());
    all.contactors.push_back({.memory = &memory.back(), .first = at - 1, .last = at, .friction = -1, .area = 1, .depth = 0,
                              .impedance = std::numeric_limits<double>::infinity(), .square = coefficient * coefficient});
  }
  /// Begins the step, and stops what approaches, by as many iterations as it takes; `part` of the rate is left.
  void stop(double part = 0) {
    for (std::size_t b = 0; b < bodies.size(); ++b) begin(bodies[b], states[b], next, rigid.bodies[b]);
    const Motion m = motion();
    look_ahead(rigid, m, all);
    v = all.velocity;
    for (Condition& c : all.conditions) {
      c.before = c.free = relative(c, all, all.velocity);
      c.per_mass = per_mass(rigid, m, all, c), c.bound = 0;
      c.least = part * std::min(0.0, c.before);
    }
    all.mobility = mass.cwiseInverse();
    make_rows(m, all);
    add_bounds(rigid, m, all);
    for (int iteration = 0; iteration < 20000; ++iteration) {
      for (Condition& c : all.conditions) c.change = std::max(0.0, c.impulse + (c.least - rate(c, all)) / c.bound) - c.impulse;
      apply_changes(m, all);
    }
    find_work(m, all);
  }
  /// Lets a blow take its steps, two if all of the approach is stopped in the first; returns what is lost.
  double strike() {
    stop();
    approach.clear(), impulse.clear();
    for (const Condition& c : all.conditions) approach.push_back(c.before), impulse.push_back(c.impulse);
    before = energy_before();
    double lost = finish();
    if (!all.blows.empty()) return lost;
    for (std::size_t b = 0; b < bodies.size(); ++b) states[b] = rigid.bodies[b].state;
    for (Condition& c : all.conditions) c.impulse = 0;
    stop();
    return lost + finish();
  }
  /// Ends the step as enforce() does.
  double finish() {
    const Motion m = motion();
    release(m, t, all);
    double transferred = 0;
    Pool pool{0, static_cast<Index>(all.contactors.size()), &transferred, 0};
    const double lost = update_restitution(m, t, pool, all);
    share_out_blows({&pool, 1}, all);
    return lost;
  }
  double energy() const {
    double sum = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) sum += rigid::kinetic_energy(bodies[b], rigid.bodies[b].state);
    return sum;
  }
  double energy_before() const {
    double sum = 0;
    for (std::size_t b = 0; b < bodies.size(); ++b) sum += rigid::kinetic_energy(bodies[b], states[b]);
    return sum;
  }
  double speed(Index b) const { return rigid::velocity(bodies[b], rigid.bodies[b].state).x(); }
  double held() const { return contact::held(0, static_cast<Index>(all.contactors.size()), all); }
};

constexpr Index right = 1;  ///< of the nodes of a body those with odd numbers are on its right side, the ones below them on its left
void touch_by_four_corners(Setting& at, Index left_body, double coefficient = 1, double slant = 0) {
  for (Index i = 0; i < Setting::corners; i += 2)
    at.touch(Setting::corners * (left_body + 1) + i, Setting::corners * left_body + i + right,
             Vec3(1, slant * (i == 0 ? 1 : -0.3), slant * (i == 4 ? 0.7 : -0.2)), coefficient);
}

TEST(Blow, OfTwoBodiesIsThatOfTwoMassesWhateverTheirRatioAndRestitution) {
  for (const double ratio : {1e-3, 0.3, 1.0, 7.0, 1e4})
    for (const double e : {0.0, 0.5, 1.0}) {
      Setting at({2, 2 * ratio});
      at.set_velocity(0, Vec3(1, 0, 0)), at.set_velocity(1, Vec3(-0.5, 0, 0));
      touch_by_four_corners(at, 0, e);
      at.strike();
      const double mean = (1 - 0.5 * ratio) / (1 + ratio);
      EXPECT_NEAR(at.speed(0), mean - e * 1.5 * ratio / (1 + ratio), 1e-7)  // round-off of an energy of 1e-16
           << ratio << " " << e;
      EXPECT_NEAR(at.speed(1), mean + e * 1.5 / (1 + ratio), 1e-7) << ratio << " " << e;
      EXPECT_NEAR(at.held(), 0, 1e-8 * at.before);
    }
}

TEST(Blow, OfSeveralContactorsWithSlantedNormalsLeavesEachWithItsOwnRate) {
  for (const double e : {1.0, 0.6}) {
    Setting at({2, 5});
    at.set_velocity(0, Vec3(1, 0.2, -0.1), Vec3(0.1, -0.3, 0.2)), at.set_velocity(1, Vec3(-0.5, 0, 0.1), Vec3(-0.2, 0.1, 0.3));
    touch_by_four_corners(at, 0, e, 0.4);
    const double lost = at.strike();
    double taken = 0;
    for (std::size_t k = 0; k < at.impulse.size(); ++k) taken -= 0.5 * at.impulse[k] * at.approach[k];
    EXPECT_GT(taken, 0.1);
    EXPECT_NEAR(lost, (1 - e * e) * taken, 1e-8);
    EXPECT_NEAR(at.energy(), at.before - lost, 1e-8);
    EXPECT_NEAR(at.held(), 0, 1e-8);
    int pressed = 0;
    for (std::size_t k = 0; k < at.impulse.size(); ++k) {
      if (!(at.impulse[k] > 1e-3)) continue;
      ++pressed;
      EXPECT_NEAR(at.all.conditions[k].after, -e * at.approach[k], 1e-6);
    }
    EXPECT_GE(pressed, 2);
  }
}

TEST(Blow, OfAChainKeepsItsEnergyAndNoPairLeavesFasterThanItCame) {
  Setting at({2, 0.5, 3, 1});
  at.set_velocity(0, Vec3(1, 0, 0));
  for (Index b = 0; b < 3; ++b) touch_by_four_corners(at, b);
  at.strike();
  EXPECT_EQ(at.all.blows.size(), 1U);
  EXPECT_NEAR(at.energy(), 1, 1e-7);
  EXPECT_NEAR(at.held(), 0, 1e-7);
  EXPECT_NEAR(2 * at.speed(0) + 0.5 * at.speed(1) + 3 * at.speed(2) + at.speed(3), 2, 1e-7);
  EXPECT_NEAR(at.speed(1) - at.speed(0), 1, 1e-6);
  EXPECT_GE(at.speed(2) - at.speed(1), -1e-6);
  EXPECT_GE(at.speed(3) - at.speed(2), -1e-6);
}

TEST(Blow, IsNotOverWhileBodiesApproachAndIsAsSoonAsNothingIsTaken) {
  Setting at({2, 5});
  at.set_velocity(0, Vec3(1, 0, 0));
  touch_by_four_corners(at, 0);
  at.stop(0.5);  // half of the way to the gap's end
  at.finish();
  EXPECT_TRUE(at.all.blows.empty());
  EXPECT_GT(at.held(), 0.1);
  EXPECT_GT(at.memory[0].blow, 0);
  for (std::size_t b = 0; b < 2; ++b) at.states[b] = at.rigid.bodies[b].state;
  for (Condition& c : at.all.conditions) c.impulse = 0;
  at.stop(1);  // the gap opens as a body turns: nothing presses
  at.finish();
  EXPECT_EQ(at.all.blows.size(), 1U);
  EXPECT_NEAR(at.energy(), 1, 1e-7);
  EXPECT_NEAR(at.speed(1) - at.speed(0), 1, 1e-6);
  EXPECT_NEAR(at.held(), 0, 1e-8);
  EXPECT_EQ(at.memory[0].blow, 0);
}

TEST(Blow, OnADrivenBodyIsNotSharedWithOthersThatStrikeIt) {
  Setting at({2, 5, 3});
  at.set_velocity(0, Vec3(1, 0, 0)), at.set_velocity(2, Vec3(-2, 0, 0));
  touch_by_four_corners(at, 0, 1), touch_by_four_corners(at, 1, 0.5);
  for (const bool driven : {true, false}) {
    Setting now = at;
    for (std::size_t k = 0; k < now.memory.size(); ++k) now.all.contactors[k].memory = &now.memory[k];
    now.stop();
    now.finish();
    for (Condition& c : now.all.conditions) c.impulse = 0;
    for (std::size_t b = 0; b < now.bodies.size(); ++b) now.states[b] = now.rigid.bodies[b].state;
    now.stop();
    now.rigid.bodies[1].driven = driven;
    find_blows(now.motion(), now.all);
    EXPECT_EQ(now.all.blows.size(), driven ? 2U : 1U);
  }
}

TEST(Blow, IsThatOfAllBodiesOfAChainInWhateverOrderTheyAreNumbered) {
  Setting at({2, 5, 3});
  at.set_velocity(2, Vec3(1, -2, 0));
  at.touch(2 * Setting::corners, 0, -Vec3::UnitX()), at.touch(2 * Setting::corners, Setting::corners, Vec3::UnitY());
  at.strike();
  EXPECT_EQ(at.all.blows.size(), 1U);
  EXPECT_NEAR(at.energy(), at.before, 1e-8 * at.before);
  EXPECT_NEAR(at.held(), 0, 1e-8 * at.before);
}

TEST(Blow, OnARigidPlaneGivesBackAll) {
  Setting at({2});
  at.set_velocity(0, Vec3(1, 0.3, 0), Vec3(0.2, 0.4, -0.1));
  for (Index i = right; i < Setting::corners; i += 2) at.touch(i, -1, -Vec3::UnitX());
  at.strike();
  EXPECT_NEAR(at.energy(), at.before, 1e-8);
  EXPECT_NEAR(at.held(), 0, 1e-8);
  EXPECT_LT(at.speed(0), 0);
}

TEST(Blow, WithoutAnImpulseGivesBackWhatOtherContactsLeft) {
  Setting at({2, 2});
  touch_by_four_corners(at, 0);
  at.stop();
  for (Restitution& one : at.memory) one.held = 0.0625;
  at.finish();
  EXPECT_NEAR(at.energy(), 0.25, 1e-8);
  EXPECT_NEAR(at.held(), 0, 1e-8);
}

TEST(Blow, SharesOutWhatIsLeftByImpulsesAndBooksWhatGoesToOtherContacts) {
  Setting at({2, 2});
  touch_by_four_corners(at, 0);
  at.all.blows.resize(1);
  at.all.blow_impulse = {3, 1, 0, 0};
  for (Contactor& one : at.all.contactors) one.blow = 0;
  at.all.contactors[3].blow = -1;
  at.memory[0].held = -1, at.memory[1].held = 3, at.memory[3].held = 7;
  double transferred[] = {0, 0};
  Pool pools[] = {{0, 1, &transferred[0], 0}, {1, 4, &transferred[1], 0}};
  share_out_blows(pools, at.all);
  EXPECT_DOUBLE_EQ(at.memory[0].held, 1.5);
  EXPECT_DOUBLE_EQ(at.memory[1].held, 0.5);
  EXPECT_EQ(at.memory[2].held, 0);
  EXPECT_EQ(at.memory[3].held, 7);
  EXPECT_DOUBLE_EQ(transferred[0], -2.5);
  EXPECT_DOUBLE_EQ(transferred[1], 2.5);
  EXPECT_DOUBLE_EQ(pools[0].held, 1.5);
  EXPECT_DOUBLE_EQ(pools[1].held, 7.5);
}

}  // namespace
}  // namespace nereid::contact::blow_test
