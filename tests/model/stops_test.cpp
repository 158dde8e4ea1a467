#include "model/stops.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/scenes.hpp"

namespace nereid::model::stops_test {
namespace {

/// When a condition is first met by a function of time that is shown every `row` until `end`; -1: never.
double met(const Stop& stop, double (*value)(double), double end = 10, double row = 1e-2, double scale = 1) {
  dynamics::ConditionMemory memory;
  for (int i = 0; i * row <= end; ++i)
    if (!wanted_stop(stop, i * row, value(i * row), "m", scale, memory).empty()) return i * row;
  return -1;
}

Stop peak(double part, double span) { return {.probe = "p", .kind = StopKind::peak, .part = part, .span = span}; }
Stop steady(double within, double window) { return {.probe = "p", .value = within, .kind = StopKind::steady, .span = window}; }
Stop rest(double part, double span) { return {.kind = StopKind::rest, .part = part, .span = span}; }

double swing(double t) { return 5 + std::sin(pi * t); }  // its first maximum is at 1/2
double climb(double t) { return t; }
double flat(double) { return 3; }
double settle(double t) { return 2 - std::exp(-t) * std::cos(20 * t); }
double dying(double t) { return std::exp(-t) * std::pow(std::cos(10 * t), 2); }  // as the kinetic energy of what rings

TEST(Peak, IsPassedWhereAPartOfTheRiseIsLost) {
  EXPECT_NEAR(met(peak(0.5, 0), swing), 1 - 1.0 / 6, 0.02);  // sin = 1/2
  EXPECT_NEAR(met(peak(1, 0), swing), 1, 0.02);
  EXPECT_EQ(met(peak(0.5, 0), climb), -1) << "what climbs on has no maximum";
  EXPECT_EQ(met(peak(0.5, 0), flat), -1) << "what never rose has none either";
}

TEST(Peak, IsPassedWhereTheValueStaysBelowIt) {
  EXPECT_NEAR(met(peak(0, 0.3), swing), 0.8, 0.02);
  EXPECT_EQ(met(peak(0, 0.3), climb), -1);
  EXPECT_NEAR(met(peak(0.5, 0.6), swing), 1.1, 0.02) << "both must hold";
  EXPECT_NEAR(met(peak(1, 0.3), swing), 1, 0.02) << "both must hold";
}

TEST(Peak, MayBeAMinimum) {
  Stop dip = peak(0.5, 0);
  dip.above = false;
  EXPECT_NEAR(met(dip, swing), 2 - 1.0 / 6, 0.02);  // sin = -1/2, after the minimum at 3/2
  EXPECT_EQ(met(dip, climb), -1);
}

TEST(Peak, BeginsWithTheFirstValueThatCounts) {
  Stop late = peak(0.5, 0);
  late.after = 1.6;  // sin is -0.95 and rises to 1 at 2.5: half of that is lost where it is 0.02
  EXPECT_NEAR(met(late, swing), 3, 0.02);
}

TEST(Steady, ComparesMeansOfWindows) {
  const double at = met(steady(1e-3, pi / 5), settle);  // of two periods: what is left of them dies as exp(-t)
  EXPECT_GT(at, 1);
  EXPECT_LT(at, 6);
  EXPECT_NEAR(met(steady(1e-3, 0.5), flat), 1, 1e-9) << "two windows at least";
  EXPECT_EQ(met(steady(1e-3, 0.5), climb), -1) << "a mean that grows by half a window is not steady";
  EXPECT_NEAR(met(steady(0.51, 0.5), climb), 1, 1e-9) << "but within more than that it is";
}

TEST(Rest, LastsForItsTime) {
  EXPECT_NEAR(met(rest(0.01, 0.5), dying), -std::log(0.01) + 0.5, 0.2) << "a turning point is no rest";
  EXPECT_LT(met(rest(0.01, 0.01), dying), 0.3) << "for so short a time it is";
  EXPECT_EQ(met(rest(0.01, 0.5), flat), -1);
  Stop of_scene = rest(0.01, 0.5);
  of_scene.of_scene = true;
  EXPECT_NEAR(met(of_scene, dying, 10, 1e-2, 0.1), -std::log(0.001) + 0.5, 0.3);
}

TEST(Conditions, RememberNothingTwice) {
  const Stop stop = steady(1e-3, 0.5);
  dynamics::ConditionMemory once, twice;
  for (int i = 0; i < 120; ++i) {
    const double t = 0.01 * i;
    const std::string said = wanted_stop(stop, t, settle(t), "m", 1, once);
    EXPECT_EQ(wanted_stop(stop, t, settle(t), "m", 1, twice), said);
    wanted_stop(stop, t, settle(t), "m", 1, twice);  // as a run that goes on asks
    EXPECT_EQ(once.integral, twice.integral);
  }
}

/// A bar on a spring: it swings and never rests.
Scene swinging() {
  Scene scene = with({bar()});
  scene.bodies[0].points = {{.name = "tip", .near = Vec3(0, 0, 0)}};
  scene.springs = {{.name = "k", .from = "bar.tip", .to = "ground", .stiffness = 16e9}};  // of 16 t: a period of 2 pi ms
  scene.planes = {{.name = "y", .nodes = {"bar"}, .normal = Vec3::UnitY()}, {.name = "z", .nodes = {"bar"}, .normal = Vec3::UnitZ()}};
  scene.initial = {{.body = "bar", .value = uniform(Vec3(1, 0, 0))}};
  scene.probes = {{.name = "way", .quantity = "displacement", .of = "bar", .component = "x"}};
  scene.time.end = 2e-2;
  return scene;
}

TEST(Run, StopsAtTheFirstMaximumAndGoesOnWithTheSameBits) {
  Scene scene = swinging();
  Simulation whole = build(scene);
  EXPECT_EQ(run(whole).ending, dynamics::Ending::reached_end);
  scene.stops = {{.probe = "way", .kind = StopKind::peak, .part = 0.2}};
  Simulation stopped = build(scene);
  const dynamics::Outcome outcome = run(stopped);
  EXPECT_EQ(outcome.ending, dynamics::Ending::stopped_by_condition);
  EXPECT_TRUE(says(outcome.reason, "way passed its largest value, ")) << outcome.reason;
  EXPECT_LT(stopped.state.t, 0.5 * whole.state.t);

  Simulation in_parts = build(scene);  // interrupted before the maximum
  in_parts.time.end = 1e-3;
  run(in_parts);
  in_parts.time.end = scene.time.end;
  EXPECT_EQ(run(in_parts).ending, dynamics::Ending::stopped_by_condition);
  EXPECT_NEAR(in_parts.state.t, stopped.state.t, 1e-4);
}

TEST(Run, RestsOrNot) {
  Scene scene = swinging();
  scene.stops = {{.kind = StopKind::rest, .part = 0.01, .span = 5e-3}};
  Simulation swings = build(scene);
  EXPECT_EQ(run(swings).ending, dynamics::Ending::reached_end) << "it never rests for more than an instant";
  scene.springs[0].damping = 1e6;
  scene.time.end = 1;
  Simulation damped = build(scene);
  EXPECT_EQ(run(damped).ending, dynamics::Ending::stopped_by_condition);
  EXPECT_LT(damped.state.t, 0.2);
}

}  // namespace
}  // namespace nereid::model::stops_test
