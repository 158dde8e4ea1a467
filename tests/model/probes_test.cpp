#include "model/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/model/scenes.hpp"

namespace nereid::model {
namespace {

TEST(Measurables, HaveTheInternalVariablesOfAllLawsAndNoNameTwice) {
  std::set<std::string> names;
  for (const Measurable& one : measurables()) EXPECT_TRUE(names.insert(one.name).second) << one.name;
  EXPECT_TRUE(names.contains("plastic_strain"));
  EXPECT_EQ(find_measurable("speed"), nullptr);
}

TEST(MakeProbe, MeasuresEveryQuantityOfAScene) {
  Scene scene = with({bar(), wall()});
  scene.bodies[0].law = material::J2JohnsonCook{  // of all laws it has most internal variables
      8000, 200e9, 0.25, {1e8, 1e9, 0.3, 0.01, 1, 1, 293, 1793, 477, 0.9, 293}};
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  for (const Measurable& one : measurables())
    scene.probes.push_back({.name = "p_" + one.name, .quantity = one.name,
                            .of = one.of == Of::contact || one.of == Of::source ? "touch" : "bar",
                            .component = one.required ? one.components.back() : ""});
  scene.time.end = 1e-5;
  Simulation simulation = build(scene);
  run(simulation);
  for (const Measurable& one : measurables()) EXPECT_FALSE(std::isnan(probe(simulation, "p_" + one.name).last)) << one.name;
}

TEST(MakeProbe, TakesTheMeanForceOfAPlaneAlongItsNormal) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "ground", .kind = load::PlaneKind::constrained, .nodes = {"bar"}, .normal = -Vec3::UnitZ()}};
  scene.gravity = Vec3(0, 0, -10);
  scene.probes = {{.name = "f", .quantity = "force", .of = "ground", .component = "normal"}};
  Simulation simulation = build(scene);
  run(simulation);
  EXPECT_NEAR(probe(simulation, "f").last, -160000, 1e-3);  // carries 16 t
}

TEST(MakeProbe, RefusesWhatCannotBeMeasured) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {{.name = "touch", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.probes = {{.name = "a", .quantity = "plastic_strain", .of = "bar"},
                  {.name = "b", .quantity = "force", .of = "touch", .component = "normal"},
                  {.name = "c", .quantity = "stress", .of = "bar"},
                  {.name = "d", .quantity = "velocity", .of = "bar", .component = "xx"}};
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "probe 'a': 'quantity' = plastic_strain: the material of bar has no such variable"));
  EXPECT_TRUE(says(said, "probe 'b': 'component' = normal: touch is no plane and has no normal"));
  EXPECT_TRUE(says(said, "probe 'c': 'component' is missing: one of xx, yy"));
  EXPECT_TRUE(says(said, "probe 'd': 'component' = xx is unknown: components of velocity are magnitude, x, y, z"));
}

}  // namespace
}  // namespace nereid::model
