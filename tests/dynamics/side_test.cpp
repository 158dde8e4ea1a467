#include "dynamics/side.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesh/box.hpp"
#include "mesh/disc.hpp"

namespace nereid::dynamics::side_test {
namespace {

const material::Elastic steel{8000, 2e11, 0.25};

Model box_and_plate() {
  Model model;
  model.mesh = mesh::join(mesh::box("box", {{0, 0, 0}, {1, 1, 0.4}, {4, 4, 4}}),
                          mesh::sheet("plate", {.length = 1, .width = 1, .cells_along = 2, .cells_across = 2}));
  model.blocks.push_back(element::hexahedra(model.mesh, "box", steel, {}));
  element::Plate::Options plate;
  plate.thickness = 0.02;
  model.blocks.push_back(element::plates(model.mesh, "plate", steel, plate));
  finalize(model);
  return model;
}

TEST(SideOf, ABoxAndAPlate) {
  const Model model = box_and_plate();
  const mesh::Surface &face = mesh::surface(model.mesh, "box.z_high"), &top = mesh::surface(model.mesh, "plate.top");
  const Side box = side_of(model, face), plate = side_of(model, top);
  EXPECT_EQ(box.stiffness, surface_stiffness(model, face));
  EXPECT_EQ(box.impedance, surface_impedance(model, face));
  EXPECT_EQ(box.depth, surface_depth(model, face));
  EXPECT_EQ(box.half_thickness, 0);
  EXPECT_FALSE(box.turns);
  EXPECT_EQ(plate.half_thickness, 0.01);
  EXPECT_TRUE(plate.turns);
  EXPECT_FALSE(plate.is_rigid);
}

TEST(Between, TakesTheSofterSideUnlessItIsRigid) {
  Side soft{.stiffness = 1, .impedance = 2, .depth = 0.1}, hard{.stiffness = 10, .impedance = 3, .depth = 0.3};
  const InterfaceOptions options{.method = contact::Method::penalty, .penalty_scale = 5};
  EXPECT_DOUBLE_EQ(between(soft, hard, options, 0.5).penalty, 2.5);
  EXPECT_DOUBLE_EQ(between(soft, hard, options, 1).impedance, 1.2);
  EXPECT_EQ(between(soft, hard, options, 1).depth, 0.1);
  EXPECT_EQ(between(soft, hard, options, 1).release_height, 0);
  soft.is_rigid = true;
  EXPECT_DOUBLE_EQ(between(soft, hard, options, 1).penalty, 50);
  hard.is_rigid = true;
  EXPECT_DOUBLE_EQ(between(soft, hard, options, 1).penalty, 5);
  soft.depth = 0;
  EXPECT_EQ(between(soft, hard, options, 1).depth, 0.3);
  EXPECT_EQ(between(soft, hard, {.method = contact::Method::multiplier}, 1).release_height, contact::multipliers_reach * 0.3);
}

TEST(Between, SharesTheArmOfFrictionByThickness) {
  const Side plate{.stiffness = 1, .impedance = std::numeric_limits<double>::infinity(), .depth = 1, .half_thickness = 0.3, .turns = true};
  Side other = plate;
  other.half_thickness = 0.1;
  const Side solid{.stiffness = 1, .impedance = 7, .depth = 1};
  EXPECT_DOUBLE_EQ(between(plate, other, {}, 1).arm_of_apex, 0.75);
  EXPECT_EQ(between(solid, plate, {}, 1).arm_of_apex, 0);
  EXPECT_EQ(between(plate, solid, {}, 1).arm_of_apex, 1);
  other.turns = false;
  EXPECT_EQ(between(other, plate, {}, 1).arm_of_apex, 0) << "a rigid plate has no angular velocities of its nodes";
  EXPECT_DOUBLE_EQ(between(solid, plate, {}, 1).impedance, 7);
}

TEST(SymmetryPlanes, AreThoseOfTheConstraints) {
  Model model = box_and_plate();
  EXPECT_TRUE(symmetry_planes(model).empty());
  EXPECT_TRUE(allowed_directions(model, {0, 1}).empty());
  const Subset& nodes = mesh::node_set(model.mesh, "box.x_low");
  model.constraints.planes.push_back({.name = "s", .kind = load::PlaneKind::symmetry, .normal = Vec3::UnitX(), .nodes = nodes});
  EXPECT_EQ(symmetry_planes(model), (std::vector<Subset>{nodes}));
  const std::vector<Mat3> allowed = allowed_directions(model, {nodes[0]});
  EXPECT_LT((allowed[0] * Vec3(1, 2, 3) - Vec3(0, 2, 3)).norm(), 1e-15);
}

}  // namespace
}  // namespace nereid::dynamics::side_test
