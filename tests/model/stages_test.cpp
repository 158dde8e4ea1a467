#include "model/stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dynamics/ledger.hpp"
#include "tests/model/scenes.hpp"

namespace nereid::model::stages_test {
namespace {

using load::PlaneKind;

/// A bar that is pulled until it is at rest, while a block is held; then the block is let go with a velocity and the bar is not pulled.
Scene staged() {
  Body block{.name = "block", .mesh = mesh::Box{Vec3(3, 0, 0), Vec3(4, 1, 1), {1, 1, 1}}, .law = steel};
  Scene scene = with({bar(), block});
  scene.planes = {{.name = "foot", .kind = PlaneKind::fixed, .nodes = {"bar.x_low"}},
                  {.name = "hold", .kind = PlaneKind::fixed, .nodes = {"block"}}};
  scene.loads = {{.name = "pull", .kind = LoadKind::force, .on = "bar.x_high",
                  .value = {[](double, double, double, double t) { return 1e6 * std::min(1.0, t / 1e-3); }, constant(0), constant(0)}},
                 {.name = "late", .kind = LoadKind::force, .on = "block.x_high",
                  .value = {[](double, double, double, double t) { return 1e6 * t; }, constant(0), constant(0)}}};
  const dynamics::Relaxation relaxation{.residual = 1e-4, .after = 1e-3};
  scene.stages = {{.name = "preload", .duration = 0.2, .relaxation = relaxation, .off = {"late"}},
                  {.name = "go", .duration = 1e-3, .off = {"hold", "pull"}, .initial = {{.body = "block", .value = uniform({2, 0, 0})}}}};
  scene.time.end = 0.201;
  return scene;
}

TEST(Stages, RunOneAfterTheOtherInOneLedger) {
  Simulation simulation = build(staged());
  double at_rest = 0, start = 0;
  const std::vector<dynamics::Observer> observers{[&](const dynamics::View& view) {
    const Index tip = mesh::node_set(view.model.mesh, "bar.x_high").front();
    if (view.now.progress.stages.size() == 1) at_rest = view.now.x(0, tip) - view.model.mesh.X(0, tip), start = view.now.t;
  }};
  const dynamics::Outcome outcome = run(simulation, observers);
  EXPECT_EQ(outcome.ending, dynamics::Ending::reached_end);
  const dynamics::State& end = simulation.state;
  ASSERT_EQ(end.progress.stages.size(), 2U);
  EXPECT_EQ(end.progress.stages[1], start);
  EXPECT_LT(start, 0.2);
  EXPECT_DOUBLE_EQ(end.t, start + 1e-3);
  EXPECT_NEAR(at_rest, 1e6 * 2 / 200e9, 0.2 * 1e6 * 2 / 200e9) << "the foot holds the bar from becoming thinner";
  // the block: 8000 kg at 2 m/s, and a force that grows from the beginning of its stage
  const Index node = mesh::node_set(simulation.model.mesh, "block.x_low").front();
  EXPECT_NEAR(end.x(0, node) - simulation.model.mesh.X(0, node), 2e-3, 1e-5);
  EXPECT_NEAR(end.loads[1].impulse.x(), 0.5 * 1e6 * 1e-6, 1e-3);
  const dynamics::Ledger& ledger = end.ledger;
  EXPECT_NEAR(ledger.initial_kinetic, 0.5 * 8000 * 4, 1e-9 * 16000);
  EXPECT_NEAR(ledger.initial_momentum.x(), 16000, 1e-9 * 16000);
  EXPECT_LT(std::abs(dynamics::energy_residual(ledger)), 1e-10 * 16000);
  EXPECT_LT(dynamics::momentum_residual(ledger).norm(), 1e-10 * 16000);
  EXPECT_LT(dynamics::angular_momentum_residual(ledger).norm(), 1e-10 * 16000);
}

TEST(Stages, RelaxForAsLongAsTheySayAfterTheirOwnBeginning) {
  const auto relaxed_at = [](double first) {  // nothing happens in the first stage
    Scene scene = staged();
    scene.stages[0].duration = first, scene.stages[0].relaxation.reset(), scene.stages[0].off = {"pull", "late"};
    scene.stages[1].duration = 0.2, scene.stages[1].off = {"late"}, scene.stages[1].initial.clear();
    scene.stages[1].relaxation = dynamics::Relaxation{.residual = 0.5, .after = 20e-3};
    scene.time.end = first + 0.2;
    Simulation simulation = build(scene);
    EXPECT_EQ(run(simulation).ending, dynamics::Ending::relaxed);
    return simulation.state.t;
  };
  const double early = relaxed_at(1e-3), late = relaxed_at(9e-3);
  EXPECT_GE(early, 21e-3);
  EXPECT_NEAR(late - early, 8e-3, 2e-3) << "steps are long";
}

TEST(Stages, APlaneThatComesLateBooksWhatItStops) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "wall", .kind = PlaneKind::constrained, .nodes = {"bar"}, .normal = Vec3::UnitX()}};
  scene.initial = {{.body = "bar", .value = uniform({3, 1, 0})}};
  scene.stages = {{.name = "free", .duration = 5e-4, .off = {"wall"}}, {.name = "held", .duration = 5e-4}};
  Simulation simulation = build(scene);
  run(simulation);
  const dynamics::Ledger& ledger = simulation.state.ledger;
  EXPECT_NEAR(ledger.kinetic, 0.5 * 16000 * 1, 1e-6);
  EXPECT_NEAR(simulation.state.constraints.account[0].stopped, 0.5 * 16000 * 9, 1e-6);
  EXPECT_LT(std::abs(dynamics::energy_residual(ledger)), 1e-10 * 80000);
  EXPECT_LT(dynamics::momentum_residual(ledger).norm(), 1e-10 * 48000);
}

TEST(Stages, AreTheSameAsARunWithoutWhereNothingChanges) {
  Scene one = with({bar()});
  one.planes = {{.name = "foot", .kind = PlaneKind::fixed, .nodes = {"bar.x_low"}}};
  one.initial = {{.body = "bar", .value = uniform({1, 0, 0})}};
  Scene same = one;
  same.stages = {{.name = "all", .duration = one.time.end}};
  Simulation first = build(one), second = build(same);
  run(first), run(second);
  EXPECT_EQ(first.state.x, second.state.x);
  EXPECT_EQ(first.state.ledger.kinetic, second.state.ledger.kinetic);
}

/// Cubes of 8 t that stand apart, each with a load of its kind that is on in some of three stages of 1 ms.
Scene loaded(const std::vector<std::string>& off_in_stages) {
  Scene scene;
  int place = 0;
  const auto add = [&](const char* name, LoadKind kind, const std::string& on, const Vec3& value) {
    const Vec3 low(10.0 * place++, 0, 0);
    scene.bodies.push_back({.name = name, .mesh = mesh::Box{low, low + Vec3(1, 1, 1), {1, 1, 1}}, .law = steel});
    scene.loads.push_back({.name = std::string("on_") + name, .kind = kind, .on = name + on, .value = uniform(value)});
  };
  add("pulled", LoadKind::force, "", Vec3(8e5, 0, 0));
  add("pressed", LoadKind::pressure, ".x_low", Vec3(8e5, 0, 0));
  add("heavy", LoadKind::body_force, "", Vec3(100, 0, 0));
  for (std::size_t k = 0; k < off_in_stages.size(); ++k) {
    scene.stages.push_back({.name = "stage_" + std::to_string(k), .duration = 1e-3});
    for (const Load& load : scene.loads)
      if (off_in_stages[k] == "off") scene.stages.back().off.push_back(load.name);
  }
  scene.time.end = 1e-3 * static_cast<double>(off_in_stages.size());
  return scene;
}

TEST(Stages, HaveOfALoadItsForceTimesTheTimeInWhichItIsOn) {
  for (const std::vector<std::string>& stages : std::vector<std::vector<std::string>>{
           {"on", "off", "off"}, {"off", "on", "off"}, {"off", "off", "on"}, {"on", "off", "on"}, {"on", "on", "on"}}) {
    Simulation simulation = build(loaded(stages));
    run(simulation);
    const double on = 1e-3 * static_cast<double>(std::count(stages.begin(), stages.end(), "on"));
    for (const char* body : {"pulled", "pressed", "heavy"}) {
      double momentum = 0;
      for (const Index node : mesh::node_set(simulation.model.mesh, body))
        momentum += simulation.model.mass(node) * simulation.state.v(0, node);
      const double round_off = std::string(body) == "pressed" ? 1e-4 : 1e-9;  // a face that is pressed grows a little
      EXPECT_NEAR(momentum, 8e5 * on, round_off * 8e5 * on) << body << " " << stages[0] << " " << stages[1] << " " << stages[2];
    }
  }
}

TEST(Stages, CountTheTimeOfAPlaneFromTheFirstOneInWhichItIsOn) {
  const auto grows = [](double rate) { return [rate](double t) { return rate * t; }; };
  const auto in_space = [](double rate) { return [rate](double, double, double, double t) { return rate * t; }; };
  for (const int late : {0, 1, 2}) {  // stages without the planes
    Scene scene;
    for (const char* name : {"pushed", "driven"}) {
      const Vec3 low(std::string(name) == "pushed" ? 0 : 10, 0, 0);
      scene.bodies.push_back({.name = name, .mesh = mesh::Box{low, low + Vec3(1, 1, 1), {1, 1, 1}}, .law = steel});
    }
    scene.planes = {{.name = "piston", .kind = PlaneKind::constrained, .nodes = {"pushed"}, .normal = Vec3::UnitX()},
                    {.name = "drive", .kind = PlaneKind::driven, .nodes = {"driven"}}};
    scene.planes[0].velocity = grows(3), scene.planes[1].field = {in_space(3), in_space(0), in_space(0)};
    for (int k = 0; k < 4; ++k) {
      scene.stages.push_back({.name = "stage_" + std::to_string(k), .duration = 1e-3});
      if (k < late) scene.stages.back().off = {"piston", "drive"};
    }
    scene.time.end = 4e-3;
    Simulation simulation = build(scene);
    run(simulation);
    const double on = 1e-3 * (4 - late);
    for (const char* body : {"pushed", "driven"})
      for (const Index node : mesh::node_set(simulation.model.mesh, body)) {
        EXPECT_NEAR(simulation.state.v(0, node), 3 * on, 1e-12) << body << " " << late;
        EXPECT_NEAR(simulation.state.x(0, node) - simulation.model.mesh.X(0, node), 1.5 * on * on, 1e-12) << body << " " << late;
      }
  }
}

TEST(CheckStages, RefusesWhatCannotBe) {
  EXPECT_EQ(refusal(staged()), "");
  const auto with_change = [](auto change) {
    Scene scene = staged();
    change(scene);
    return refusal(scene);
  };
  EXPECT_TRUE(says(with_change([](Scene& s) { s.initial = {{.body = "bar", .value = uniform({1, 0, 0})}}; }),
                   "'bar' has a velocity, and relaxation would bring it to rest: give the velocity in a later stage"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.stages[0].initial = {{.body = "bar", .value = uniform({1, 0, 0})}}; }),
                   "'bar' has a velocity, and this stage would bring it to rest"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.stages[1].initial[0].displacement = true; }), "a stage gives velocities"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.stages[1].off = {"gravity"}; }), "'gravity' is gravity, which acts in all stages"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.stages[1].off = {"holt"}; }), "'off' = holt is unknown"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.stages[1].name = "preload"; }), "'name' = preload is given twice"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.stages[1].duration = 0; }), "'duration' = 0 is out of range"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.time.end = 1; }), "is not the sum of the stages, 0.201 s"));
  EXPECT_TRUE(says(with_change([](Scene& s) { s.relaxation = dynamics::Relaxation{}; }), "'relaxation' belongs to a stage"));
  Scene relaxed = with({bar()});
  relaxed.relaxation = dynamics::Relaxation{};
  relaxed.initial = {{.body = "bar", .value = uniform({1, 0, 0})}};
  EXPECT_TRUE(says(refusal(relaxed), "'bar' has a velocity"));
}

TEST(CheckStages, AsksRigidBodiesToBeHeldWhereTheyRelax) {
  Scene scene = staged();
  scene.bodies[1].rigid = true;
  EXPECT_EQ(refusal(scene), "");
  Simulation simulation = build(scene);
  EXPECT_EQ(run(simulation).ending, dynamics::Ending::reached_end);
  EXPECT_NEAR(simulation.state.rigid_bodies[0].shift.x(), 2e-3, 1e-5);
  EXPECT_LT(std::abs(dynamics::energy_residual(simulation.state.ledger)), 1e-10 * 16000);
  scene.stages[0].off = {"late", "hold"};
  EXPECT_TRUE(says(refusal(scene), "relaxation does not damp the rigid body 'block': hold it by a fixed plane"));
  scene = staged();
  scene.bodies[1].rigid = true;
  scene.planes.push_back({.name = "rail", .kind = PlaneKind::constrained, .nodes = {"block.y_low"}, .normal = Vec3::UnitY()});
  scene.stages[0].off.push_back("rail");
  EXPECT_TRUE(says(refusal(scene), "'rail' begins to hold the rigid body 'block' in a later stage"));
}

}  // namespace
}  // namespace nereid::model::stages_test
