#include "dynamics/model.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/check.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"

namespace nereid::dynamics::model_test {
namespace {

const material::Elastic lead{11000, 2e8, 0.4};
const material::J2Bilinear steel{7800, 2e11, 0.3, 3e8, 2e9};

/// A box of several tiles and a tube around nothing, far apart.
Model box_and_tube() {
  Model model;
  model.mesh = mesh::join(mesh::box("box", {{1, 1, 0}, {2, 3, 4}, {7, 6, 8}}),
                          mesh::tube("tube", {0.5, 2, mesh::Revolution::full, 2, 6}));
  element::Plate::Options plate;
  plate.thickness = 0.01;
  model.blocks.push_back(element::hexahedra(model.mesh, "box", lead, {}));
  model.blocks.push_back(element::plates(model.mesh, "tube", steel, plate));
  return model;
}

TEST(Model, NodesCarryTheMassOfTheBodies) {
  Model model = box_and_tube();
  finalize(model);
  const Index in_box = static_cast<Index>(mesh::node_set(model.mesh, "box").size());
  EXPECT_NEAR(model.mass.head(in_box).sum(), 11000 * 8.0, 1e-9);
  const double area =
      mesh::facet_areas(model.mesh, mesh::surface(model.mesh, "tube.outside")).sum();
  EXPECT_NEAR(model.mass.tail(model.mass.size() - in_box).sum(), 7800 * 0.01 * area, 1e-10);
  // a corner has an eighth of its element, a node inside a whole one
  const double element = 11000 * 8.0 / (7 * 6 * 8);
  EXPECT_NEAR(model.mass(0), element / 8, 1e-11);
  EXPECT_NEAR(model.mass.head(in_box).maxCoeff(), element, 1e-10);
}

TEST(Model, ANodeWithoutElementNeedsAPointMass) {
  Model model;
  model.mesh.X = Vectors::Zero(3, 2);
  model.point_masses.push_back({"first", {0}, 2.0});
  EXPECT_THROW(finalize(model), InternalError);
  model.point_masses.push_back({"both", {0, 1}, 3.0});
  finalize(model);
  EXPECT_EQ(model.mass(0), 3.5);
  EXPECT_EQ(model.mass(1), 1.5);
}

TEST(Model, OnlyPlatesTurnAndEachOfTheirNodesHasOneColumn) {
  Model model = box_and_tube();
  finalize(model);
  const Subset& box = mesh::node_set(model.mesh, "box");
  const Subset& tube = mesh::node_set(model.mesh, "tube");
  ASSERT_EQ(model.node_of_rotation.size(), tube.size());
  ASSERT_EQ(model.inertia.size(), static_cast<Eigen::Index>(tube.size()));
  for (const Index node : box) EXPECT_EQ(model.rotation_of_node[node], -1);
  for (std::size_t rotation = 0; rotation < model.node_of_rotation.size(); ++rotation)
    EXPECT_EQ(model.rotation_of_node[model.node_of_rotation[rotation]], static_cast<Index>(rotation));
  EXPECT_GT(model.inertia.minCoeff(), 0);
}

TEST(Model, NodesSharedByTwoBlocksOfPlatesTurnAsOne) {
  Model model;
  model.mesh = mesh::tube("tube", {0.5, 2, mesh::Revolution::full, 2, 6});
  const Table<3> all = model.mesh.triangles[0].nodes;
  model.mesh.triangles[0].nodes = all.leftCols(all.cols() / 2);
  model.mesh.triangles.push_back({"rest", all.rightCols(all.cols() - all.cols() / 2)});
  element::Plate::Options plate;
  plate.thickness = 0.01;
  model.blocks.push_back(element::plates(model.mesh, "tube", steel, plate));
  model.blocks.push_back(element::plates(model.mesh, "rest", lead, plate));
  finalize(model);
  EXPECT_EQ(static_cast<Eigen::Index>(model.node_of_rotation.size()), model.mesh.X.cols());
  EXPECT_GT(model.inertia.minCoeff(), 0);
}

TEST(Model, FinishingTwiceChangesNothing) {
  Model model = box_and_tube();
  finalize(model);
  const Model once = model;
  finalize(model);
  EXPECT_EQ(once.mass, model.mass);
  EXPECT_EQ(once.inertia, model.inertia);
  EXPECT_EQ(once.node_of_rotation, model.node_of_rotation);
  EXPECT_EQ(once.node_sums.size(), model.node_sums.size());
}

TEST(Model, ANodeWithoutElementIsRefused) {
  Model model = box_and_tube();
  model.blocks.pop_back();
  EXPECT_THROW(finalize(model), InternalError);
}

TEST(Model, TheInitialStateIsAtRestWithOneAccountForEverySource) {
  Model model = box_and_tube();
  model.gravity = {0, 0, -9.80665};
  load::Plane floor, symmetry, held;
  floor.name = "floor", floor.kind = load::PlaneKind::floor, floor.nodes = {0};
  symmetry.name = "mirror", symmetry.kind = load::PlaneKind::symmetry, symmetry.nodes = {1};
  held.name = "clamp", held.kind = load::PlaneKind::constrained, held.nodes = {2};
  model.constraints.planes = {floor, symmetry, held};
  finalize(model);
  contact::RigidPlane wall;
  wall.name = "wall", wall.point = Vec3::Zero(), wall.normal = Vec3::UnitZ();
  model.rigid_planes.push_back(wall);
  const State state = initial_state(model, {});
  EXPECT_EQ(state.x, model.mesh.X);
  EXPECT_TRUE(state.v.isZero(0) && state.omega.isZero(0));
  EXPECT_EQ(state.omega.cols(), model.inertia.size());
  std::vector<std::string> names;
  const std::vector<Source> all = sources(model);
  for (const Source& source : all) names.push_back(std::string(word(source.kind)) + " " + source.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"block box", "block tube", "rigid_plane wall", "floor floor",
                                      "symmetry mirror", "constrained clamp", "gravity gravity"}));
  EXPECT_EQ(all[0].stored[1], Stored::hourglass);
  EXPECT_EQ(all[1].stored[1], Stored::transverse_shear);
  EXPECT_EQ(state.ledger.accounts.size(), all.size());
}

TEST(Model, AnInterfaceWithoutMemoryIsRefused) {
  Model model = box_and_tube();
  finalize(model);
  model.contacts.emplace_back(contact::Interface());
  EXPECT_THROW(initial_state(model, {}), InternalError);
}

}  // namespace
}  // namespace nereid::dynamics::model_test
