#include "model/advice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/model/scenes.hpp"

namespace nereid::model::advice_test {
namespace {

/// As a run finds it before its first step.
Simulation started(const Scene& scene) {
  Simulation simulation = build(scene);
  dynamics::start(simulation.model, simulation.state, simulation.forces);
  return simulation;
}

/// Twenty cubes in a row, of which the first is a tenth as long.
Scene sliver(double left) {
  Scene scene = with({{.name = "bar", .mesh = mesh::Box{Vec3(0, 0, 0), Vec3(20, 1, 1), {20, 1, 1}}, .law = steel}});
  scene.bodies[0].map = {[left](double x, double, double, double) { return x == 0 ? left : x; },
                         [](double, double y, double, double) { return y; }, [](double, double, double z, double) { return z; }};
  return scene;
}

/// A bar that falls on another one, with a penalty.
Scene fall(double gap) {
  Scene scene = with({bar(), wall()});
  scene.bodies[1].place.move = Vec3(gap, 0, 0);
  scene.contacts = {{.name = "skin", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.contacts[0].interface.method = contact::Method::penalty;
  scene.initial = {{.body = "bar", .value = uniform(Vec3(10, 0, 0))}};
  return scene;
}

TEST(ExpectedSteps, AreThoseOfARunOfElements) {
  Simulation simulation = started(sliver(0));
  const ExpectedSteps expected = expected_steps(simulation);
  EXPECT_EQ(expected.dt, expected.first.dt);
  EXPECT_EQ(expected.dt, expected.elements);
  simulation = build(sliver(0));
  run(simulation);
  EXPECT_NEAR(count(expected, 1e-3), static_cast<double>(simulation.state.step), 1);
}

TEST(ExpectedSteps, KnowTheContactThatIsStillOpen) {
  const Simulation open = started(fall(0.9)), touching = started(fall(0));
  const ExpectedSteps before = expected_steps(open), in_touch = expected_steps(touching);
  EXPECT_EQ(before.first.dt, before.elements) << "nothing touches in the first step";
  EXPECT_NEAR(before.dt, in_touch.first.dt, 1e-6 * in_touch.first.dt);
  EXPECT_LT(before.dt, 0.5 * before.elements);
}

TEST(StepAdvice, NamesTheContactAndByHowMuch) {
  Scene scene = fall(0);
  const auto advice = [&scene] {
    const Simulation simulation = started(scene);
    return step_advice(simulation, expected_steps(simulation));
  };
  const ExpectedSteps expected = expected_steps(started(scene));
  char times[40];
  std::snprintf(times, sizeof times, "%.3g", expected.elements / expected.dt);
  ASSERT_EQ(advice().size(), 1U);
  EXPECT_EQ(advice()[0], "contact 'skin' limits the step: this run has " + std::string(times) +
                             " times as many steps; 'method: multiplier' has no step limit of its own");
  scene.contacts[0].interface.method = contact::Method::multiplier;
  EXPECT_TRUE(advice().empty());
  EXPECT_EQ(expected_steps(started(scene)).dt, expected.elements) << "it is true";
}

TEST(StepAdvice, NamesTheRigidPlane) {
  Scene scene = with({bar()});
  scene.rigid_planes = {{.name = "ground", .surface = "bar.z_low", .method = contact::Method::penalty, .penalty = 1e15}};
  const Simulation simulation = started(scene);
  const auto advice = step_advice(simulation, expected_steps(simulation));
  ASSERT_EQ(advice.size(), 1U);
  EXPECT_TRUE(says(advice[0], "rigid plane 'ground' limits the step: this run has ")) << advice[0];
}

TEST(StepAdvice, SaysOfEachSourceWhatItAloneMakesOfTheSteps) {
  Scene all = fall(0);
  all.rigid_planes = {{.name = "ground", .surface = "bar.z_low", .method = contact::Method::penalty, .penalty = 1e15},
                      {.name = "roof", .surface = "bar.z_high", .method = contact::Method::penalty, .penalty = 4e15}};
  const auto advice = [](const Scene& scene) {
    const Simulation simulation = started(scene);
    return step_advice(simulation, expected_steps(simulation));
  };
  std::vector<std::string> alone;
  for (int source = 0; source < 3; ++source) {
    Scene one = all;
    if (source > 0) one.contacts.clear(), one.rigid_planes = {all.rigid_planes[static_cast<std::size_t>(source - 1)]};
    else one.rigid_planes.clear();
    for (const std::string& line : advice(one)) alone.push_back(line);
  }
  ASSERT_EQ(alone.size(), 3U);
  EXPECT_EQ(advice(all), alone);
  const std::string begins = "this run has ";
  const auto times = [&](const std::string& line) { return std::stod(line.substr(line.find(begins) + begins.size())); };
  EXPECT_NEAR(times(alone[2]) / times(alone[1]), 2, 0.02) << "a spring of four times the stiffness has half the step";
}

TEST(StepAdvice, NamesTheElementAndWhatTheStepIsWithoutIt) {
  const Simulation thin = started(sliver(0.9)), without = started(sliver(0));
  const ExpectedSteps expected = expected_steps(thin);
  const auto advice = step_advice(thin, expected);
  ASSERT_EQ(advice.size(), 1U);
  const std::string said = "element 0 of 'bar' limits the step; a mesh without such elements allows longer steps, about ";
  ASSERT_TRUE(says(advice[0], said)) << advice[0];
  const double times = std::stod(advice[0].substr(said.size())), true_times = expected_steps(without).dt / expected.dt;
  EXPECT_NEAR(times / true_times, 1, 0.07);  // of elements whose bending is left out: element/width.hpp
  EXPECT_TRUE(step_advice(without, expected_steps(without)).empty());
  const Simulation little = started(sliver(0.2));
  EXPECT_TRUE(step_advice(little, expected_steps(little)).empty()) << "less than half as many steps again";
}

TEST(StrainNotes, SayThatElementsWillBeDeformed) {
  Scene scene = with({bar()});
  scene.bodies[0].law = material::J2Bilinear{8000, 200e9, 0.25, {400e6, 0}};
  scene.initial = {{.body = "bar", .value = uniform(Vec3(0, 0, -50))}};
  scene.rigid_planes = {{.name = "ground", .surface = "bar.z_low"}};
  EXPECT_TRUE(strain_notes(started(scene)).empty()) << "1/2 8000 50^2 = 10 MPa of 400 MPa";
  scene.initial = {{.body = "bar", .value = uniform(Vec3(0, 0, -200))}};
  const auto notes = strain_notes(started(scene));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(says(notes[0], "the kinetic energy at the start is 0.4 of yield stress times volume")) << notes[0];
  scene.bodies[0].law = steel;
  EXPECT_TRUE(strain_notes(started(scene)).empty()) << "what is elastic is not squashed for good";
}

}  // namespace
}  // namespace nereid::model::advice_test
