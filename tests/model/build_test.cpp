#include "model/build.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "tests/model/scenes.hpp"

namespace nereid::model::build_test {
namespace {

Contact touch(const std::string& apexes, const std::string& base) { return {.name = "touch", .apexes = apexes, .base = base}; }

TEST(Build, GivesBodiesTheirMassAndKind) {
  const dynamics::Model model = build(with({bar(), sheet()})).model;
  ASSERT_EQ(model.blocks.size(), 2U);
  EXPECT_FALSE(element::rotates(model.blocks[0]));
  EXPECT_TRUE(element::rotates(model.blocks[1]));
  EXPECT_NEAR(model.mass.sum(), 16000 + 32, 1e-9);  // 2 m3 and 2 m2 of 2 mm, of 8000 kg/m3; round-off
}

TEST(Build, NoStepIsLongerThanTheLargestOneWhateverTheBodies) {
  for (const bool rigid : {false, true}) {
    Scene scene = with({bar(), wall()});
    scene.bodies[0].rigid = rigid;
    scene.time.end = 1e-4, scene.time.largest_step = 1e-6;
    Simulation simulation = build(scene);
    const dynamics::Outcome outcome = run(simulation);
    EXPECT_EQ(simulation.state.step, 100) << rigid;
    EXPECT_NEAR(outcome.largest_step, 1e-6, 1e-15) << rigid;
  }
}

TEST(Build, AContactStandsOffHalfTheThicknessOfPlates) {
  Scene scene = with({bar(), sheet()});
  scene.contacts = {touch("bar.z_high", "sheet.bottom")};
  const Simulation built = build(scene);
  ASSERT_EQ(built.gaps.size(), 2U);  // of the apexes, and of the edges
  EXPECT_NEAR(built.gaps[0].least, 0.5 - 1e-3, 1e-15);
  EXPECT_EQ(std::get<contact::Interface>(built.model.contacts[0]).contact_height(0), 1e-3);
}

TEST(Build, SolidsTouchWhereTheyMeet) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {touch("bar.x_high", "wall.x_low")};
  const Simulation built = build(scene);
  EXPECT_EQ(built.gaps[0].least, 0);
  EXPECT_EQ(built.gaps[0].penetrating, 0);
}

TEST(Build, AContactMayHaveTwoPasses) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {touch("bar.x_high", "wall.x_low")};
  scene.contacts[0].interface.two_passes = true;
  const Simulation built = build(scene);
  ASSERT_EQ(built.model.contacts.size(), 3U);
  EXPECT_EQ(built.gaps.size(), 3U);
  EXPECT_EQ(contact::sides(built.model.contacts[1]).name, "touch_back");
  EXPECT_EQ(contact::sides(built.model.contacts[2]).name, "touch_edges");
  scene.contacts[0].interface.edges = false;
  EXPECT_EQ(build(scene).model.contacts.size(), 2U);
}

TEST(Build, RefusesASurfaceThatTouchesItself) {
  Scene scene = with({bar()});
  scene.contacts = {touch("bar.x_high", "bar.y_low")};
  EXPECT_TRUE(says(refusal(scene), "contact 'touch': 'apexes' and 'base' share nodes"));
}

TEST(Build, RefusesAnAutomaticContactThatLeavesNothingToTouch) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {touch("bar.x_high", "wall.x_low")};
  scene.automatic_contacts = {{.name = "all", .self_contact = false}};
  EXPECT_TRUE(says(refusal(scene), "contact 'all': no pair is left for this contact")) << refusal(scene);
  scene.automatic_contacts[0].self_contact = true;
  EXPECT_EQ(refusal(scene), "");
  scene.bodies[0].rigid = scene.bodies[1].rigid = true;
  EXPECT_TRUE(says(refusal(scene), "contact 'all': no pair is left for this contact")) << refusal(scene);
  scene.contacts.clear();
  EXPECT_EQ(refusal(scene), "");
  scene.automatic_contacts[0].bodies = {"bar", "wall", "bar"};
  EXPECT_TRUE(says(refusal(scene), "contact 'all': 'bar' is given twice")) << refusal(scene);
}

TEST(Build, RefusesPenetrationUnlessAccepted) {
  Scene scene = with({bar(), wall()});
  scene.bodies[1].place.move = Vec3(-0.1, 0, 0);
  scene.contacts = {touch("bar.x_high", "wall.x_low")};
  EXPECT_TRUE(says(refusal(scene), "4 of 4 apexes start penetrated, by 0.1 m at most: move the bodies apart")) << refusal(scene);
  scene.contacts[0].interface.initial_penetration = contact::InitialPenetration::accept;
  EXPECT_EQ(refusal(scene), "");
  scene.bodies[1].place.move.setZero();
  scene.contacts[0].height_from_thickness = false;
  scene.contacts[0].interface = {};
  scene.contacts[0].interface.height = {.from_initial_height = false, .clearance = 0, .given = 0.01};
  EXPECT_TRUE(says(refusal(scene), "lower 'height'")) << refusal(scene);
}

/// A body that is displaced along x. [m]
Initial moved(const std::string& body, double way) {
  const auto constant = [](double value) { return [value](double, double, double, double) { return value; }; };
  return {.body = body, .displacement = true, .value = {constant(way), constant(0), constant(0)}};
}

TEST(Build, LooksForOverlapsWhereInitialDisplacementsPutTheBodies) {
  for (const bool automatic : {false, true}) {
    Scene scene = with({bar(), wall()});
    scene.bodies[1].mesh = mesh::Box{Vec3(2, -1, -1), Vec3(4, 2, 2), {2, 2, 2}};  // automatic contact has no corners on corners
    if (automatic) scene.automatic_contacts = {{.name = "touch"}};
    else scene.contacts = {touch("bar.x_high", "wall.x_low")};
    scene.bodies[1].place.move = Vec3(-0.1, 0, 0);
    scene.initial = {moved("wall", 0.3)};
    EXPECT_EQ(refusal(scene), "");
    const Simulation simulation = build(scene);
    EXPECT_NEAR(simulation.gaps[0].least, 0.2, 1e-12) << automatic;
    scene.bodies[1].place.move = Vec3(0.1, 0, 0);
    scene.initial = {moved("wall", -0.3)};
    EXPECT_TRUE(says(refusal(scene), "start penetrated, by 0.2 m at most: move the bodies apart, or say 'initial_penetration: accept'"))
        << refusal(scene);
  }
}

TEST(Build, LooksForNodesBehindPlanesWhereInitialDisplacementsPutThem) {
  Scene scene = with({bar()});
  scene.rigid_planes = {{.name = "ground", .surface = "bar.x_low", .point = Vec3(0.1, 0, 0), .normal = Vec3::UnitX()}};
  EXPECT_TRUE(says(refusal(scene), "4 of 4 nodes start behind 'ground', by 0.1 m at most")) << refusal(scene);
  scene.initial = {moved("bar", 0.1)};
  EXPECT_EQ(refusal(scene), "");
  scene.rigid_planes.clear();
  scene.planes = {{.name = "ground", .kind = load::PlaneKind::floor, .nodes = {"bar.x_low"}, .point = Vec3(0.1, 0, 0),
                   .normal = Vec3::UnitX()}};
  EXPECT_EQ(refusal(scene), "");
  scene.initial = {moved("bar", -0.2)};
  EXPECT_TRUE(says(refusal(scene), "4 of 4 nodes start behind 'ground', by 0.3 m at most")) << refusal(scene);
}

TEST(Build, RefusesABaseWhoseNormalsDoNotAgree) {
  mesh::Mesh given = mesh::box("", {Vec3(2, 0, 0), Vec3(4, 1, 1), {2, 1, 1}});
  auto& facets = std::find_if(given.surfaces.begin(), given.surfaces.end(), [](const auto& one) { return one.name == ".x_low"; })->facets;
  std::swap(facets(0, 0), facets(1, 0));
  Scene scene = with({bar(), {.name = "wall", .mesh = given, .law = steel}});
  scene.contacts = {touch("bar.x_high", "wall.x_low")};
  EXPECT_TRUE(says(refusal(scene), "'base' = wall.x_low: an edge belongs to two facets in the same direction")) << refusal(scene);
}

TEST(Build, TellsAllThatNameNothingWithTheNearest) {
  Scene scene = with({bar(), wall()});
  scene.contacts = {touch("bar.x_hihg", "wal.x_low")};
  scene.probes = {{.name = "tip", .quantity = "displacement", .of = "bar.tip"}, {.name = "u", .quantity = "velocty", .of = "bar"}};
  scene.stops = {{.probe = "tap"}};
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "did you mean 'bar.x_high'?"));
  EXPECT_TRUE(says(said, "did you mean 'wall.x_low'?"));
  EXPECT_TRUE(says(said, "probe 'tip': 'of' = bar.tip is unknown: node sets are bar, "));
  EXPECT_TRUE(says(said, "did you mean 'velocity'?"));
  EXPECT_TRUE(says(said, "condition to stop: 'probe' = tap is unknown: probes are tip, u"));
}

TEST(Build, RefusesASceneWithoutBodies) { EXPECT_TRUE(says(refusal(with({})), "there are no bodies")); }

TEST(Build, RefusesPlatesWithoutThicknessAndNodesWithoutMass) {
  Scene scene = with({sheet()});
  scene.bodies[0].plate.thickness = 0;
  EXPECT_TRUE(says(refusal(scene), "body 'sheet': 'thickness' = 0 is out of range: expected thickness > 0"));
  mesh::Mesh given = mesh::box("", {Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}});
  given.hexahedra.clear();
  EXPECT_TRUE(says(refusal(with({{.name = "bar", .mesh = given, .law = steel}})),
                   "body 'bar': a node has neither an element nor a point mass"));
}

TEST(Run, GoesToTheEndAndProbesRemember) {
  Scene scene = with({bar()});
  scene.initial = {{.body = "bar", .value = uniform(Vec3(1, 2, 2))}};
  scene.probes = {{.name = "speed", .quantity = "velocity", .of = "bar"},
                  {.name = "x", .quantity = "position", .of = "bar", .component = "x"}};
  Simulation simulation = build(scene);
  EXPECT_THROW(probe(simulation, "speed"), InternalError);
  EXPECT_EQ(run(simulation).ending, dynamics::Ending::reached_end);
  EXPECT_EQ(simulation.state.t, 1e-3);
  EXPECT_NEAR(probe(simulation, "speed").largest, 3, 1e-12);
  EXPECT_NEAR(probe(simulation, "x").last, 1 + 1e-3, 1e-12);
  EXPECT_GE(probe(simulation, "x").samples, 2);
}

TEST(Run, StopsWhereAConditionAsksForIt) {
  Scene scene = with({bar()});
  scene.initial = {{.body = "bar", .value = uniform(Vec3(1, 0, 0))}};
  scene.probes = {{.name = "way", .quantity = "displacement", .of = "bar", .component = "x"}};
  scene.stops = {{.probe = "way", .above = true, .value = 2e-4, .after = 5e-4}};
  Simulation simulation = build(scene);
  const dynamics::Outcome outcome = run(simulation);
  EXPECT_EQ(outcome.ending, dynamics::Ending::stopped_by_condition);
  EXPECT_TRUE(says(outcome.reason, "m, above 0.0002 m")) << outcome.reason;
  EXPECT_NEAR(simulation.state.t, 5e-4, 1e-4);
}

TEST(Run, GoesOnWhereItWasLeft) {
  Scene scene = with({bar()});
  scene.initial = {{.body = "bar", .value = uniform(Vec3(1, 0, 0))}};
  Simulation simulation = build(scene);
  simulation.time.end = 5e-4;
  run(simulation);
  simulation.time.end = 1e-3;
  EXPECT_EQ(run(simulation).ending, dynamics::Ending::reached_end);
  EXPECT_EQ(simulation.state.t, 1e-3);
}

}  // namespace
}  // namespace nereid::model::build_test
