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
    sample({"value", "1", [value](const View&, Kept&) { return value; }}, {model, state, forces, true}, {}, memory);
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

TEST(Probe, OfAMeanHasTheExtremesOfStepsAndInItsRowTheMeanSinceTheRowBefore) {
  const Model model;
  const Forces forces;
  State state;
  const Probe pull{"pull", "N", [](const View& view, Kept& kept) {
                     const double before = kept.since < 0 ? 0 : kept.since, t = view.now.t, impulse = t * t;
                     const double mean = t > before ? (impulse - kept.integral.x()) / (t - before) : 0;
                     kept.integral.x() = impulse, kept.since = t;
                     return mean;
                   }, true};
  ProbeMemory memory;
  for (int step = 0; step <= 4; ++step, state.t += 1) {
    sample(pull, {model, state, forces, step % 4 == 0}, {}, memory);
    if (step % 4 == 0) sample_row(pull, {model, state, forces, true}, {}, memory);
  }
  EXPECT_EQ(memory.last, 4) << "16 N s in 4 s";
  EXPECT_EQ(memory.largest_row, 4);
  EXPECT_EQ(memory.smallest_row, 0) << "the start";
  EXPECT_EQ(memory.largest, 7) << "the last step: 16 - 9";
  EXPECT_EQ(memory.time_of_largest, 4);
  EXPECT_EQ(memory.smallest, 0);
}

TEST(Probe, OfAFormulaTakesTheStepsOfItsInputsForItsExtremesAndTheirRowsForItsRows) {
  const Model model;
  const Forces forces;
  State state;
  const std::vector<Probe> probes{
      {"speed", "m/s", [](const View& view, Kept&) { return view.now.t; }},
      {"push", "N", [](const View& view, Kept& kept) {  // of the impulse t^2
         const double before = kept.since < 0 ? 0 : kept.since, t = view.now.t;
         const double mean = t > before ? (t * t - kept.integral.x()) / (t - before) : 0;
         kept.integral.x() = t * t, kept.since = t;
         return mean;
       }, true},
      {.name = "power", .unit = "W", .value = {}, .is_mean = true, .inputs = {0, 1},
       .formula = [](const std::vector<double>& in, double t) { return in[0] * in[1] + 100 * t; }}};
  std::vector<ProbeMemory> memories(3);
  for (int step = 0; step <= 4; ++step, state.t += 1)
    for (std::size_t p = 0; p < 3; ++p) {
      sample(probes[p], {model, state, forces, step % 4 == 0}, memories, memories[p]);
      if (step % 4 == 0) sample_row(probes[p], {model, state, forces, true}, memories, memories[p]);
    }
  EXPECT_EQ(memories[2].now, 4 * 7 + 400);
  EXPECT_EQ(memories[2].largest, 428);
  EXPECT_EQ(memories[2].last, 4 * 4 + 400) << "16 N s in the 4 s of the row";
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
