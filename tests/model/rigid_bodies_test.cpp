#include "model/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/scenes.hpp"

namespace nereid::model::rigid_bodies_test {
namespace {

Body rigid(Body body) {
  body.rigid = true;
  return body;
}

TEST(RigidBodies, HaveTheMassOfTheirMesh) {
  const dynamics::Model model = build(with({rigid(bar()), wall()})).model;
  ASSERT_EQ(model.rigid_bodies.size(), 1U);
  EXPECT_NEAR(model.rigid_bodies[0].mass.mass, 16000, 1e-8);
  EXPECT_NEAR(dynamics::total_mass(model), 32000, 1e-8);
  EXPECT_LT((model.rigid_bodies[0].mass.centre - Vec3(1, 0.5, 0.5)).norm(), 1e-12);
  EXPECT_EQ(model.rigid_of_block[0], 0);
  EXPECT_EQ(model.rigid_of_block[1], -1);
  EXPECT_EQ(model.longest_step, 1e300);
}

TEST(RigidBodies, HaveTheMassOfAPointMassOnceInEqualSharesOfTheNodesOfItsSet) {
  const double bar_mass = 16000, load = 800;
  for (const bool is_rigid : {true, false}) {
    Scene scene = with({is_rigid ? rigid(bar()) : bar(), wall()});
    scene.point_masses = {{.name = "load", .nodes = "bar.x_high", .mass = load}, {.name = "other", .nodes = "wall.x_high", .mass = 50}};
    const dynamics::Model model = build(scene).model;
    EXPECT_NEAR(dynamics::total_mass(model), 2 * bar_mass + load + 50, 1e-8);
    if (!is_rigid) continue;
    const rigid::MassProperties& mass = model.rigid_bodies[0].mass;
    const double centre = (bar_mass * 1 + load * 2) / (bar_mass + load);  // [m] along x
    EXPECT_NEAR(mass.mass, bar_mass + load, 1e-8);
    EXPECT_LT((mass.centre - Vec3(centre, 0.5, 0.5)).norm(), 1e-12);
    // four corners of a square of 1 m: load/2 about its axis, load/4 about a side's direction
    const double about_x = bar_mass / 6 + load / 2;
    const double about_y = bar_mass * (5.0 / 12 + std::pow(centre - 1, 2)) + load * (0.25 + std::pow(2 - centre, 2));
    EXPECT_LT((mass.inertia - Mat3(Vec3(about_x, about_y, about_y).asDiagonal())).norm(), 1e-8);
  }
}

TEST(RigidBodies, OfRoundMeshesTouchAsTheirShapeWhereverTheyStand) {
  Body ball = rigid(bar());
  ball.mesh =
      mesh::Cylinder{.radius = 0.2, .length = 1, .turn = mesh::Revolution::full, .cells_core = 2, .cells_ring = 1, .cells_along = 2};
  ball.scale = 2;
  ball.place = {.axis = Vec3::UnitX(), .angle = pi / 2, .about = Vec3(0, 0, 1), .move = Vec3(5, 0, 0)};
  const dynamics::Model model = build(with({ball})).model;
  ASSERT_TRUE(model.rigid_bodies[0].round);
  const geometry::Round& shape = model.rigid_bodies[0].round->shape;
  EXPECT_EQ(shape.radius, 0.4);
  EXPECT_EQ(shape.half_length, 1);
  const geometry::PlacedRound at = mesh::placed(*model.rigid_bodies[0].round, model.mesh.X);
  for (const Index node : mesh::surface_nodes(mesh::surface(model.mesh, "bar.skin")))
    EXPECT_NEAR(geometry::over_round(shape, at, model.mesh.X.col(node)).distance, 0, 1e-14);
  ball.surface = TouchesAs::facets;
  EXPECT_FALSE(build(with({ball})).model.rigid_bodies[0].round);
}

TEST(RigidBodies, WithoutARoundMeshHaveNoExactSurface) {
  Body box = rigid(bar());
  EXPECT_FALSE(build(with({box})).model.rigid_bodies[0].round);
  box.surface = TouchesAs::exact;
  EXPECT_TRUE(says(refusal(with({box})), "'bar' has no exact surface"));
  box.surface = TouchesAs::usual;
  box.shape = GivenShape{.shape = {.kind = geometry::RoundKind::sphere, .radius = 1}};
  EXPECT_TRUE(says(refusal(with({box})), "lie beside the 'shape'"));
}

TEST(RigidBodies, TakeMassPropertiesThatAreGiven) {
  Body body = rigid(bar());
  body.given = {.mass = 5, .centre = Vec3(1, 0.5, 0.4), .inertia = Mat3(Vec3(3, 4, 5).asDiagonal())};
  const dynamics::Model model = build(with({body})).model;
  EXPECT_EQ(model.rigid_bodies[0].mass.mass, 5);
  EXPECT_EQ(model.rigid_bodies[0].mass.centre, Vec3(1, 0.5, 0.4));
  EXPECT_EQ(model.rigid_bodies[0].mass.inertia(2, 2), 5);
  EXPECT_EQ(model.longest_step, 1e-6);  // a thousandth of the run: nothing else limits it
  body.given.inertia = Mat3(Vec3(1, 1, 5).asDiagonal());
  EXPECT_TRUE(says(refusal(with({body})), "no body has the inertia of 'bar'"));
}

TEST(RigidBodies, OfAGivenMassAloneHaveTheInertiaOfTheirMaterialInThatProportion) {
  const rigid::MassProperties own = build(with({rigid(bar())})).model.rigid_bodies[0].mass;
  Body body = rigid(bar());
  body.given = {.mass = 3 * own.mass};
  const rigid::MassProperties given = build(with({body})).model.rigid_bodies[0].mass;
  EXPECT_LT((given.inertia - 3 * own.inertia).norm(), 1e-12 * given.inertia.norm());
}

TEST(RigidBodies, OfPlatesHaveNoTurnsOfTheirNodes) {
  const dynamics::Model model = build(with({rigid(sheet())})).model;
  EXPECT_EQ(model.inertia.size(), 0);
  EXPECT_NEAR(model.rigid_bodies[0].mass.mass, 32, 1e-11);
}

TEST(RigidBodies, ThatAreFixedHaveTheirReactionFromTheFixedPlaneWhateverTheOrder) {
  Scene scene = with({rigid(bar()), wall()});
  const Plane fixed{.name = "clamp", .kind = load::PlaneKind::fixed, .nodes = {"bar.x_low"}, .normal = Vec3::UnitZ()},
      side{.name = "side", .kind = load::PlaneKind::symmetry, .nodes = {"bar.y_low"}, .normal = Vec3::UnitY()};
  for (const int at : {0, 1}) {
    scene.planes = at == 0 ? std::vector{fixed, side} : std::vector{side, fixed};
    const dynamics::HeldBody held = build(scene).model.held_bodies[0];
    EXPECT_EQ(held.first, at);
    ASSERT_EQ(held.rows.size(), 3U);
    Mat3 sum = Mat3::Zero();
    for (const dynamics::HeldBody::Row& row : held.rows) {
      EXPECT_EQ(row.plane, at);
      sum += row.normal * row.reaction.transpose();
    }
    EXPECT_LT((sum - Mat3::Identity()).norm(), 1e-14);
  }
}

TEST(RigidBodies, AreRefusedWhatTheyCannotDo) {
  Scene scene = with({rigid(bar()), wall()});
  scene.planes = {{.name = "hinge", .kind = load::PlaneKind::constrained, .nodes = {"bar.x_low"}, .normal = Vec3::UnitX()},
                  {.name = "line", .kind = load::PlaneKind::floor, .nodes = {"bar.z_low"}, .normal = Vec3::UnitZ()}};
  EXPECT_TRUE(says(refusal(scene), "plane 'line': a floor has nodes of the rigid body 'bar'"));
  scene.planes.pop_back();
  EXPECT_EQ(refusal(scene), "");  // a whole face
  scene.bodies[0].points = {{.name = "corner", .near = Vec3(0, 0, 0)}};
  scene.planes[0].nodes = {"bar.corner"};
  EXPECT_TRUE(says(refusal(scene), "not about one axis through its centre"));
  scene.planes = {{.name = "spin", .kind = load::PlaneKind::driven, .nodes = {"bar.x_low"}, .field = uniform(Vec3::UnitX())}};
  EXPECT_TRUE(says(refusal(scene), "plane 'spin': 'spin' drives a part of the rigid body 'bar'"));
  scene.planes[0].nodes = {"bar"};
  scene.planes[0].field[1] = [](double x, double, double, double t) { return x * t; };
  EXPECT_TRUE(says(refusal(scene), "plane 'spin': the velocity of 'spin' differs over the rigid body 'bar'"));
  scene.planes[0].field[1] = [](double, double, double, double t) { return t; };
  EXPECT_EQ(refusal(scene), "");
  scene.planes.clear();
  scene.initial = {{.body = "bar", .value = {[](double x, double, double, double) { return x; }, constant(0), constant(0)}}};
  EXPECT_TRUE(says(refusal(scene), "the velocity is no rigid motion of 'bar'"));
  scene.initial = {{.body = "bar", .displacement = true, .value = uniform(Vec3::UnitX())}};
  EXPECT_TRUE(says(refusal(scene), "has no displacement"));
  scene.initial.clear();
  scene.relaxation = dynamics::Relaxation{};
  EXPECT_TRUE(says(refusal(scene), "relaxation does not damp the rigid body"));
  scene.relaxation.reset();
  scene.contacts = {{.name = "glue", .apexes = "bar.x_high", .base = "wall.x_low"}};
  scene.contacts[0].interface.kind = contact::InterfaceKind::tied;
  EXPECT_TRUE(says(refusal(scene), "contact 'glue': a tie by multipliers to a rigid body is not available"));
}

}  // namespace
}  // namespace nereid::model::rigid_bodies_test
