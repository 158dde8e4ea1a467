#include "model/names.hpp"

#include <gtest/gtest.h>

#include "tests/model/scenes.hpp"

namespace nereid::model::names_test {
namespace {

TEST(IsName, HasLettersDigitsAndUnderscores) {
  for (const char* name : {"a", "bar_2", "_a", "X"}) EXPECT_TRUE(is_name(name)) << name;
  for (const char* name : {"", "2a", "a.b", "a b", "a[0]", "\"", "a-b", "a\n", "\xC3\xA9"}) EXPECT_FALSE(is_name(name)) << name;
}

TEST(CheckNames, RefusesNamesGivenTwiceAndNamesThatAreNone) {
  Scene scene = with({bar(), bar()});
  scene.planes = {{.name = "gravity", .kind = load::PlaneKind::fixed, .nodes = {"bar"}}, {.name = "a.b", .nodes = {"bar"}},
                  {.name = "a[0]\"x", .nodes = {"bar"}}};
  scene.bodies[1].points = {{.name = "a b", .near = Vec3::Zero()}};
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "body 'bar': 'name' = bar is given twice"));
  EXPECT_TRUE(says(said, "plane 'gravity': 'name' = gravity is given twice"));
  EXPECT_TRUE(says(said, "plane 'a.b': 'name' = a.b is no name"));
  EXPECT_TRUE(says(said, "'name' = a[0]\"x is no name"));
  EXPECT_TRUE(says(said, "point 'a b': 'name' = a b is no name"));
}

TEST(CheckNames, RefusesProbesCalledLikeAColumnOfEveryHistory) {
  Scene scene = with({bar()});
  for (const char* name : {"time", "energy_kinetic", "energy_of_mine"}) {
    scene.probes = {{.name = name, .quantity = "velocity", .of = "bar"}};
    EXPECT_TRUE(says(refusal(scene), "is a column of every history")) << name;
  }
}

TEST(CheckColumns, RefusesNamesThatGiveTheHistoryAColumnTwice) {
  Scene scene = with({bar(), wall()});
  scene.bodies[0].name = "created", scene.bodies[1].name = "elastic";
  EXPECT_EQ(refusal(scene), "body 'elastic': 'name' = elastic and 'created' both give the history a column 'energy_created_elastic': "
                            "choose another");
  scene = with({bar(), wall()});
  scene.contacts = {{.name = "c", .apexes = "bar.x_high", .base = "wall.x_low"},
                    {.name = "c_tangential", .apexes = "wall.x_low", .base = "bar.x_high"}};
  scene.contacts[0].interface.friction.coefficient = 0.1;
  for (Contact& contact : scene.contacts) contact.interface.method = contact::Method::penalty;
  EXPECT_TRUE(says(refusal(scene), "both give the history a column 'energy_c_tangential_penalty'")) << refusal(scene);
}

}  // namespace
}  // namespace nereid::model::names_test
