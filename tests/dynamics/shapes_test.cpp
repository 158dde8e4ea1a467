#include "dynamics/shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/box.hpp"

namespace nereid::dynamics::shapes_test {
namespace {

/// A rigid cylinder over an elastic block.
Model scene() {
  const mesh::Cylinder bar{.radius = 0.1, .length = 0.4, .turn = mesh::Revolution::full, .cells_core = 2, .cells_ring = 1,
                           .cells_along = 2};
  const mesh::Mesh roller = mesh::cylinder("roller", bar);
  mesh::Box box;
  box.low = Vec3(-1, -1, -1), box.high = Vec3(1, 1, -0.2), box.cells = Eigen::Vector3i(2, 2, 1);
  Model model;
  model.mesh = mesh::join(roller, mesh::box("block", box));
  const material::Elastic steel{7850, 210e9, 0.3};
  model.blocks.push_back(element::solids(model.mesh, "roller", steel, {}));
  model.blocks.push_back(element::solids(model.mesh, "block", steel, {}));
  const Subset nodes = mesh::node_set(model.mesh, "roller");
  model.rigid_of_block = {0, -1};
  model.rigid_bodies.push_back(rigid::make_body("roller", {1, Vec3(0, 0, 0.2), Mat3::Identity()}, model.mesh.X, nodes));
  model.rigid_bodies[0].round = mesh::tied(*mesh::round_of(bar), {.centre = mesh::centre_of(bar)}, model.mesh.X, nodes);
  model.held_bodies.resize(1);
  model.longest_step = 1e-3;
  finalize(model);
  return model;
}

InterfaceOptions usual() {
  InterfaceOptions options;
  options.height.from_initial_height = false, options.height.from_thickness = true;
  return options;
}

TEST(Shapes, ASurfaceWithAllOfTheRoundSideIsOfTheShapeAndAFlatEndIsNot) {
  const Model model = scene();
  EXPECT_NE(round_body_of(model, mesh::surface(model.mesh, "roller.side")), nullptr);
  EXPECT_EQ(round_body_of(model, mesh::surface(model.mesh, "roller.top")), nullptr);
  EXPECT_EQ(round_body_of(model, mesh::surface(model.mesh, "block.z_high")), nullptr);
}

TEST(Shapes, APairHasTheShapeOnItsSideAndFacetsEdgesAndNodesOnTheOther) {
  const Model model = scene();
  const mesh::Surface &side = mesh::surface(model.mesh, "roller.side"), &top = mesh::surface(model.mesh, "block.z_high");
  const auto shapes = shapes_of_pair(model, top, side, usual(), {});
  ASSERT_TRUE(shapes);
  ASSERT_EQ(shapes->pairs.size(), 1);
  EXPECT_EQ(shapes->pairs[0].side, -1);
  EXPECT_EQ(shapes->faceted[0].nodes.size(), 9);
  EXPECT_EQ(shapes->faceted[0].facets.cols(), 8);
  EXPECT_EQ(shapes->faceted[0].edges.cols(), 16);
  EXPECT_EQ((shapes->faceted[0].across.array() < 0).count(), 8);  // at the border
  EXPECT_EQ(shapes->faceted[0].beside.size(), 32);
  EXPECT_NEAR(shapes->faceted[0].area.sum(), 4, 1e-12);
  EXPECT_EQ(shapes_of_pair(model, side, top, usual(), {})->pairs[0].side, 1);
}

TEST(Shapes, PenaltiesTiesAndGivenHeightsHaveFacets) {
  const Model model = scene();
  const mesh::Surface &side = mesh::surface(model.mesh, "roller.side"), &top = mesh::surface(model.mesh, "block.z_high");
  InterfaceOptions penalty = usual(), tie = usual(), height = usual();
  penalty.method = contact::Method::penalty;
  tie.kind = contact::InterfaceKind::tied;
  height.height = {.from_initial_height = false, .clearance = 0, .given = 0.1};
  for (const InterfaceOptions& options : {penalty, tie, height}) EXPECT_FALSE(shapes_of_pair(model, top, side, options, {}));
}

}  // namespace
}  // namespace nereid::dynamics::shapes_test
