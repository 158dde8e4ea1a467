#include "model/actions.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/model/scenes.hpp"

namespace nereid::model::actions_test {
namespace {

using load::PlaneKind;

TEST(AddPlanes, HoldTheUnionOfTheirSets) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "side", .kind = PlaneKind::constrained, .nodes = {"bar.x_low", "bar.y_low"}, .normal = Vec3(0, 0.6, 0.8)}};
  const dynamics::Model model = build(scene).model;
  ASSERT_EQ(model.constraints.planes.size(), 1U);
  EXPECT_EQ(model.constraints.planes[0].nodes.size(), 8U);  // four and six, two of them common
  scene.planes[0].normal = Vec3(0, 3, 4);
  EXPECT_TRUE(says(refusal(scene), "plane 'side': 'normal' is no unit vector"));
}

TEST(AddPlanes, RefuseNodesThatStartBehindAFloor) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "ground", .kind = PlaneKind::floor, .nodes = {"bar"}}};
  EXPECT_EQ(refusal(scene), "");
  scene.planes[0].point = Vec3(0, 0, 0.25);
  EXPECT_TRUE(says(refusal(scene), "6 of 12 nodes start behind 'ground', by 0.25 m at most"));
}

TEST(AddPlanes, RefuseASymmetryPlaneWhoseNodesLieOnNone) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "side", .kind = PlaneKind::symmetry, .nodes = {"bar.y_low"}, .normal = Vec3::UnitY()}};
  EXPECT_EQ(refusal(scene), "");
  scene.planes[0].nodes = {"bar"};
  EXPECT_TRUE(says(refusal(scene), "lie on no plane: they are 1 m apart"));
}

TEST(AddPlanes, RefuseAConflictAlsoWhereAProbeMeasuresIt) {
  Scene scene = with({bar()});
  scene.planes = {{.name = "p", .kind = PlaneKind::fixed, .nodes = {"bar.z_low"}},
                  {.name = "q", .kind = PlaneKind::constrained, .nodes = {"bar.x_low"}, .velocity = [](double) { return 1.0; }}};
  scene.probes = {{.name = "f", .quantity = "force", .of = "q", .component = "z"}};
  EXPECT_EQ(refusal(scene), "plane 'q': 'q' moves nodes that 'p' constrains in the same direction");
}

TEST(AddPlanes, RefuseTooManyOnOneNode) {
  Scene scene = with({bar()});
  for (const char* name : {"a", "b", "c"}) scene.planes.push_back({.name = name, .kind = PlaneKind::fixed, .nodes = {"bar.x_low"}});
  EXPECT_TRUE(says(refusal(scene), "plane 'c': too many planes constrain one node")) << refusal(scene);
}

TEST(AddRigidPlanes, AreAsHardAsTheirSurfaceAndKnowItsDepth) {
  Scene scene = with({bar()});
  scene.rigid_planes = {{.name = "wall", .surface = "bar.x_high", .point = Vec3(2.5, 0, 0), .normal = -Vec3::UnitX(), .penalty_scale = 3,
                         .friction = {.coefficient = 0.2}}};
  const contact::RigidPlane chosen = build(scene).model.rigid_planes.at(0);
  EXPECT_NEAR(chosen.penalty, 3 * 240e9, 1e-3);  // lambda + 2 mu over cells of 1 m; round-off
  EXPECT_NEAR(chosen.area.sum(), 1, 1e-14);
  EXPECT_EQ(chosen.friction.coefficient, 0.2);
  EXPECT_NEAR(chosen.depth, 1, 1e-14);
  scene.rigid_planes[0].penalty = 5e9;
  EXPECT_EQ(build(scene).model.rigid_planes[0].penalty, 5e9);
}

TEST(AddRigidPlanes, RefuseNodesThatStartBehindThem) {
  Scene scene = with({bar()});
  scene.rigid_planes = {{.name = "ground", .surface = "bar.z_low", .point = Vec3(0, 0, -0.25)}};
  EXPECT_EQ(refusal(scene), "");
  scene.rigid_planes[0].point = Vec3(0, 0, 0.5);
  EXPECT_TRUE(says(refusal(scene), "6 of 6 nodes start behind 'ground'"));
}

TEST(AddLoads, RefuseMomentsOnSolidsSpringsOnManyNodesAndValuesThatAreNoNumber) {
  const double infinity = std::numeric_limits<double>::infinity();
  Scene scene = with({bar()});
  scene.loads = {{.name = "m", .kind = LoadKind::moment, .on = "bar.x_low", .value = uniform(Vec3(1, 0, 0))},
                 {.name = "p", .kind = LoadKind::pressure, .on = "bar.x_low", .value = uniform(Vec3(infinity, 0, 0))},
                 {.name = "b", .kind = LoadKind::body_force, .on = "bar", .value = uniform(Vec3(0, 0, infinity - infinity))}};
  scene.springs = {{.name = "k", .from = "bar.x_low", .to = "ground", .stiffness = 1}};
  const std::string said = refusal(scene);
  EXPECT_TRUE(says(said, "load 'm': a moment acts on nodes of plates or on rigid bodies only: 'bar.x_low' has others"));
  EXPECT_TRUE(says(said, "load 'p': 'value' is infinite at t = 0"));
  EXPECT_TRUE(says(said, "load 'b': 'value' is no number at x = 0, y = 0, z = 0, t = 0"));
  EXPECT_TRUE(says(said, "spring 'k': the node set 'bar.x_low' has 4 nodes: a spring ends at a single one"));
}

TEST(AddLoads, TurningIsOfPlates) {
  Scene scene = with({bar(), sheet()});
  scene.planes = {{.name = "spin", .kind = PlaneKind::driven, .nodes = {"sheet"}, .field = uniform(Vec3::Zero()),
                   .angular_velocity = uniform(Vec3::UnitZ())}};
  EXPECT_EQ(refusal(scene), "");
  scene.planes[0].nodes = {"bar"};
  EXPECT_TRUE(says(refusal(scene), "'angular_velocity' is of nodes of plates or rigid bodies: 'spin' has none"));
}

TEST(SetInitial, AddsUpVelocitiesAndRefusesDisplacementsThatInvertElements) {
  Scene scene = with({bar()});
  scene.initial = {{.body = "bar", .value = uniform(Vec3(1, 0, 0))}, {.body = "bar", .value = uniform(Vec3(2, 0, 1))}};
  EXPECT_EQ(build(scene).state.v.col(3), Vec3(3, 0, 1));
  scene.initial = {{.body = "bar", .displacement = true,
                    .value = {[](double x, double, double, double) { return -2 * x; }, constant(0), constant(0)}}};
  EXPECT_TRUE(says(refusal(scene), "initial motion of 'bar': 'displacement' turns element 0 inside out")) << refusal(scene);
}

}  // namespace
}  // namespace nereid::model::actions_test
