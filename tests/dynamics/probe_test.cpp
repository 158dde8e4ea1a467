#include "dynamics/probe.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace nereid::dynamics::probe_test {
namespace {

/// Samples a row of values, one every dt.
ProbeMemory sampled(const std::vector<double>& values, double dt) {
  const Model model;
  const Forces forces;
  State state;
  state.dt = dt;
  ProbeMemory memory;
  for (const double value : values) {
    sample({"value", "1", [value](const View&, ProbeMemory&) { return value; }, true}, {model, state, forces, true}, memory);
    state.t += dt;
  }
  return memory;
}

TEST(Probe, RemembersTheLastValueAndTheExtremesWithTheTimesOfTheFirstOfEqualOnes) {
  const ProbeMemory memory = sampled({1, 3, -2, 3, -2, 0}, 0.5);
  EXPECT_EQ(memory.last, 0);
  EXPECT_EQ(memory.largest, 3);
  EXPECT_EQ(memory.time_of_largest, 0.5);
  EXPECT_EQ(memory.smallest, -2);
  EXPECT_EQ(memory.time_of_smallest, 1);
  EXPECT_EQ(memory.samples, 6);
}

TEST(Probe, IntegratesAndKnowsWhenItWasAboveZero) {
  const ProbeMemory memory = sampled({0, 2, -1, 4, 0}, 0.5);
  EXPECT_EQ(memory.integral, 2.5);
  EXPECT_EQ(memory.first_above_zero, 0.5);
  EXPECT_EQ(memory.last_above_zero, 1.5);
  EXPECT_EQ(sampled({0, -1}, 1).first_above_zero, -1);
}

TEST(Probe, PassesOverSamplesThatAreNoNumber) {
  const ProbeMemory memory = sampled({NAN, 2, NAN}, 1);
  EXPECT_TRUE(std::isnan(memory.last));
  EXPECT_EQ(memory.largest, 2);
  EXPECT_EQ(memory.integral, 2);
  EXPECT_TRUE(std::isnan(sampled({NAN}, 1).largest));
}

}  // namespace
}  // namespace nereid::dynamics::probe_test
