#include "contact/multiplier/rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/parallel.hpp"
#include "contact/multiplier/condition.hpp"
#include "contact/multiplier/solve.hpp"

namespace nereid::contact::rows_test {
namespace {

/// Free nodes in a line with conditions between neighbours, in directions at random; every third node is held along x.
struct Setting {
  Vectors x, v, none{3, 0};
  Scalars mass, no_inertia;
  std::vector<Index> turns;
  Mat3 held = Vec3(0, 1, 1).asDiagonal();
  std::vector<const Mat3*> allowed, no_rotations;
  Multipliers all;

  explicit Setting(Index nodes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> one(-1, 1);
    x = v = Vectors::NullaryExpr(3, nodes, [&] { return one(random); });
    mass = Scalars::NullaryExpr(nodes, [&] { return 1.5 + one(random); });
    turns.assign(static_cast<std::size_t>(nodes), -1), allowed.assign(static_cast<std::size_t>(nodes), nullptr);
    for (std::size_t i = 0; i < allowed.size(); i += 3) allowed[i] = &held;
    all = make_multipliers({}, {}, nodes, 0);
    all.velocity = v, all.mobility = mass.cwiseInverse();
    for (Index i = 0; i + 1 < nodes; ++i) {
      Condition& c = begin_condition(all);
      c.normal = Vec3(one(random), one(random), one(random)).normalized();
      add_member(i, 1, all, c), add_member(i + 1, -1, all, c);
      all.contactors.push_back({.memory = nullptr, .first = i, .last = i + 1, .friction = -1, .area = 1, .depth = 0, .impedance = 0,
                                .square = 1});
    }
    make_rows(motion(), all);
  }
  Motion motion() const { return {x, v, none, none, none, mass, no_inertia, turns, allowed, no_rotations, 1e-3, 1e-3}; }

  void give_to_all() {
    for (Index i = 0; i < static_cast<Index>(all.conditions.size()); ++i)
      give(all.conditions[static_cast<std::size_t>(i)].row, 0.1 * (i % 7), all.rows);
    move(all.rows);
    find_velocities(motion(), all);
  }
};

TEST(Rows, MoveNodesAsTheirImpulsesDoAcrossRanges) {
  Setting at(3 * contactors_of_a_range);  // three ranges share nodes
  at.give_to_all();
  Vectors expected = at.v;
  for (Index i = 0; i + 1 < static_cast<Index>(at.x.cols()); ++i)
    for (const Member& one : members_of(at.all.conditions[static_cast<std::size_t>(i)], at.all))
      expected.col(one.node) += 0.1 * (i % 7) / at.mass(one.node) * let_through(at.motion(), one);
  EXPECT_LT((at.all.velocity - expected).cwiseAbs().maxCoeff(), 1e-14);
  for (const Condition& c : at.all.conditions) EXPECT_NEAR(rate(c, at.all), relative(c, at.all, expected), 1e-13);
}

TEST(Rows, HaveTheSameBitsOnAnyNumberOfThreads) {
  Vectors one;
  for (const int threads : {1, 2, 3}) {
    use_threads(threads);
    Setting at(20 * contactors_of_a_range);
    for (int k = 0; k < 3; ++k) at.give_to_all();
    if (threads == 1) one = at.all.velocity;
    EXPECT_TRUE((at.all.velocity.array() == one.array()).all()) << threads;
  }
  use_threads(1);
}

TEST(Rows, AreMadeAnewWithoutWhatWasGivenBefore) {
  Setting at(10);
  at.give_to_all();
  at.all.velocity = at.v;
  make_rows(at.motion(), at.all);
  for (const Condition& c : at.all.conditions) EXPECT_NEAR(rate(c, at.all), relative(c, at.all, at.v), 1e-15);
}

}  // namespace
}  // namespace nereid::contact::rows_test
