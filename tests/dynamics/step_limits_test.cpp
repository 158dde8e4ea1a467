#include "dynamics/step_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/multiplier/restitution.hpp"

namespace nereid::dynamics::votes_test {
namespace {

const std::vector<Source> sources{{"lead", SourceKind::block, {}, {}}, {"skin", SourceKind::interface, {}, {}},
                                  {"wall", SourceKind::rigid_plane, {}, {}}, {"strut", SourceKind::spring, {}, {}}};

StepLimits limits(double elements, double contact) {
  StepLimits all;
  all.elements.lower_to({elements, 17}, 0);
  all.contact.lower_to({contact, 204}, 1);
  return all;
}

TEST(SourceLimit, IsTheSmallestLimitAndKeepsTheFirstOfEqualOnes) {
  SourceLimit limit;
  limit.lower_to({2, 5}, 0);
  limit.lower_to({1, 6}, 1);
  limit.lower_to({1, 7}, 2);
  limit.lower_to({}, 3);
  EXPECT_EQ(limit.step, 1);
  EXPECT_EQ(limit.source, 1);
  EXPECT_EQ(limit.at, 6);
}

TEST(Step, NamesTheElementThatLimitsItThoughContactAllowsLessThanTheElementsStableStep) {
  // contact between 0.9 and 1 of the elements' limit: the elements with their safety are still the smaller
  const Step step = choose_step(limits(1, 0.95), 0.9);
  EXPECT_EQ(step.dt, 0.9);
  EXPECT_EQ(step.safety, 0.9);
  EXPECT_EQ(limited_by(step, sources), "element 17 of 'lead', 0.9 of its stable step");
}

TEST(Step, NamesTheApexOfTheContactThatLimitsIt) {
  const Step step = choose_step(limits(1, 0.5), 0.9);
  EXPECT_EQ(step.dt, 0.5);
  EXPECT_EQ(step.safety, 1);
  EXPECT_EQ(limited_by(step, sources), "contact 'skin', apex at node 204");
}

TEST(Step, FallsAtOnceAndGrowsByATwentiethOrMore) {
  const Pace pace{.end = 100, .safety = 0.9};
  EXPECT_EQ(next_length(limits(1, 5), pace, 0, 0), 0.9);
  EXPECT_EQ(next_length(limits(1, 5), pace, 0, 1), 0.9);
  EXPECT_EQ(next_length(limits(1, 5), pace, 0, 0.88), 0.88);
  EXPECT_EQ(next_length(limits(1, 5), pace, 0, 0.5), 0.9);
}

TEST(Ringing, AsksForStepsThatRoundOffDoesNotChange) {
  for (const double step : {0.89, 0.6, 0.2, 0.113}) {
    const double found = step_for_blows(0.9, step);
    EXPECT_LE(found, step * (1 + 1e-12));
    EXPECT_GT(found, 0.84 * step);
    EXPECT_NEAR(std::remainder(4 * std::log2(0.9 / found), 1), 0, 1e-9);
    EXPECT_EQ(step_for_blows(0.9, step * (1 + 1e-13)), found);
  }
  EXPECT_NEAR(step_for_blows(0.9, 1e-9), 0.9 / 8, 1e-15) << "and for no shorter one";
}

TEST(Ringing, KeepsAStepThatABlowHasMadeShorterUntilNothingAsksForItAnyMore) {
  const double energy = 2, usual = 0.9;
  StepLimits before;
  before.ringing = 4 * contact::most_ringing * energy / 0.04;  // asks for a step of 0.2
  const auto after = [&](const StepLimits& last) {
    StepLimits now = limits(1, 5);
    update_ringing(last, usual, energy, now);
    return now;
  };
  EXPECT_EQ(after(before).contact.step, 5) << "no blow has asked";
  before.blows = {.step = 0.15, .source = 2, .at = 7};
  EXPECT_EQ(after(before).contact.step, step_for_blows(usual, 0.15));
  EXPECT_EQ(after(before).contact.source, 2);
  EXPECT_EQ(after(before).contact.at, 7);
  before.blows.step = 1e300;  // nothing is held any more
  EXPECT_EQ(after(before).contact.step, step_for_blows(usual, 0.2));
  EXPECT_EQ(after(before).blows.source, 2);
  before.ringing *= 0.01;
  EXPECT_EQ(after(before).contact.step, 5);
  EXPECT_EQ(after(before).blows.source, -1);
}

TEST(Step, ThatHasCostEnergyByItsChangesGrowsOnlyWhereTwentyInARowWouldHaveLetIt) {
  const Pace pace{.end = 1e6, .safety = 1};
  StepLimits now = limits(1, 5);
  double dt = 1;
  int changes = 0;
  for (int step = 0; step < 200; ++step) {  // rings: pressed and free in turn
    const StepLimits before = now;
    now = limits(step % 4 < 2 ? 1 : 0.9, 5);
    update_growth(before, pace, dt, 0.02, now);
    const double next = next_length(now, pace, 0, dt);
    changes += next != dt ? 1 : 0;
    dt = next;
  }
  EXPECT_NEAR(dt, 0.81, 1e-15) << "0.9, and as much again";
  EXPECT_EQ(changes, 1);
  int steps = 0;
  for (; dt < 1 && steps < 100; ++steps) {
    const StepLimits before = now;
    now = limits(1, 5);
    update_growth(before, pace, dt, 0, now);  // it goes on to be costly
    dt = next_length(now, pace, 0, dt);
  }
  EXPECT_GE(steps, 18);
  EXPECT_LE(steps, 20);
  StepLimits cheap = limits(1, 5);
  update_growth(limits(0.9, 5), pace, 0.9, 0.005, cheap);
  EXPECT_EQ(next_length(cheap, pace, 0, 0.9), 1);
}

TEST(Step, CountsOnTheLimitOfTheElementsToFallAsItFell) {
  const Pace pace{.end = 1e6, .safety = 0.9};
  const auto next = [&](double before, double now) {
    StepLimits then = limits(now, 5);
    update_growth(limits(before, 5), pace, 0.9 * before, 0, then);
    return choose_step(then, pace.safety);
  };
  EXPECT_NEAR(next(1, 0.9).dt, 0.925 * 0.9 * 0.9, 1e-15);
  EXPECT_NEAR(next(1, 0.9).safety, 0.925 * 0.9, 1e-15);
  EXPECT_EQ(next(1, 0.98).dt, 0.9 * 0.98) << "small swings take a part of the margin";
  EXPECT_EQ(next(1, 1).dt, 0.9);
  EXPECT_EQ(next(0.9, 1).dt, 0.9) << "not on its growth";
  EXPECT_NEAR(next(1, 0.01).dt, 0.925 * 0.5 * 0.01, 1e-15) << "a jump goes on by half at most";
  EXPECT_EQ(next(1e300, 1e300).source, 1) << "no limit but that of contact";
  EXPECT_EQ(next(1e300, 1e300).dt, 5);
}

TEST(Step, SharesWhatIsLeftEvenly) {
  const Pace pace{.end = 100, .safety = 1};
  EXPECT_EQ(next_length(limits(1, 5), pace, 50, 1), 1);
  int steps = 0;
  for (double t = 90.5, last = 1; t < 100; ++steps) {
    const double next = next_length(limits(1, 5), pace, t, last);
    EXPECT_NEAR(next, 0.95, 1e-12);
    t += last = next;
  }
  EXPECT_EQ(steps, 10);
}

TEST(Step, NamesPlanesAndSpringsAndNothing) {
  EXPECT_EQ(limited_by({1, 2, 5, 1}, sources), "rigid plane 'wall', node 5");
  EXPECT_EQ(limited_by({1, 3, -1, 0.5}, sources), "spring 'strut', 0.5 of its stable step");
  EXPECT_EQ(limited_by({1, 0, -1, 1}, sources), "the turn of 'lead' in a step");
  EXPECT_EQ(limited_by({1, 0, at_largest_step, 1}, sources),
            "'time.largest_step', by default a thousandth of the run where all bodies are rigid");
  EXPECT_EQ(limited_by({}, sources), "nothing");
}

}  // namespace
}  // namespace nereid::dynamics::votes_test
