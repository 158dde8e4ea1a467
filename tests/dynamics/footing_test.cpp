#include "dynamics/footing.hpp"

#include <gtest/gtest.h>

#include "dynamics/balance.hpp"
#include "dynamics/connect.hpp"
#include "dynamics/step.hpp"
#include "mesh/box.hpp"

namespace nereid::dynamics::footing_test {
namespace {

TEST(EffectiveNodes, CountEqualForcesAndLittleOfSmallOnes) {
  EXPECT_EQ(effective_nodes({}), 0);
  EXPECT_EQ(effective_nodes({0, 0}), 0);
  EXPECT_NEAR(effective_nodes({3e200, 3e200, 0}) / 2, 1, 1e-12);
  EXPECT_NEAR(effective_nodes({1, 1, 1, 1}), 4, 1e-12);
  EXPECT_NEAR(effective_nodes({1, 1e-3, 1e-3}), 1.004, 1e-4);
  EXPECT_NEAR(effective_nodes({4, 2, 2}), 64.0 / 24, 1e-12);
}

/// Two boxes of one cell that overlap by a depth, on one node of the first alone or on all four of its side.
struct Pressed {
  Model model;
  State state;
  Forces forces;

  explicit Pressed(double depth, int cells_of_base = 1) {
    const material::Elastic rubber{1000, 1e6, 0.25};
    model.mesh = mesh::join(mesh::box("left", {Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1}}),
                            mesh::box("right", {Vec3(1, -0.5, -0.5), Vec3(2, 1.5, 1.5), {1, cells_of_base, cells_of_base}}));
    for (const char* name : {"left", "right"}) model.blocks.push_back(element::hexahedra(model.mesh, name, rubber, {.viscosity = {0, 0}}));
    finalize(model);
    InterfaceOptions options{.method = contact::Method::penalty, .edges = false};
    options.penalty = 1e6;
    options.height = {.from_initial_height = false, .clearance = 0, .given = 0};
    std::vector<contact::AnyMemory> memories;
    for (Connected& connected : connect(model, "touch", "left.x_high", "right.x_low", options)) memories.push_back(connected.memory);
    state = initial_state(model, memories), forces = make_forces(model);
    for (const Index node : mesh::node_set(model.mesh, "left")) state.x(0, node) += depth;
    start(model, state, forces);
  }
};

TEST(Footings, AreThoseOfTheBodyWithFewerNodesWhereTheForceIsLargest) {
  Pressed scene(1e-3);
  look_at_footings(scene.model, scene.state);
  ASSERT_EQ(scene.state.footings.size(), scene.model.contacts.size());
  const Footing first = scene.state.footings[0];
  EXPECT_NEAR(first.force, 2 * 1e6 * 1e-3, 1e-6) << "of both sides";
  EXPECT_NEAR(first.nodes, 3.2, 1e-9) << "of the base, a square of two triangles, of which the nodes of the cut belong to both";
  scene.state.footings[0] = {.force = 2.1e3, .nodes = 7};
  look_at_footings(scene.model, scene.state);
  EXPECT_EQ(scene.state.footings[0].nodes, 7) << "there was more force before";
}

TEST(Footings, OfRigidBodiesDoNotCount) {
  Pressed scene(1e-3);
  scene.model.rigid_of_block = {-1, 0};
  look_at_footings(scene.model, scene.state);
  EXPECT_NEAR(scene.state.footings[0].nodes, 4, 1e-9);
  Pressed rigid(1e-3);
  rigid.model.rigid_of_block = {0, 1};
  look_at_footings(rigid.model, rigid.state);
  EXPECT_EQ(rigid.state.footings[0].nodes, 0);
}

TEST(Footings, OfRegionsOfOneBodyAreOne) {
  Pressed scene(1e-3, 2);
  look_at_footings(scene.model, scene.state);
  const Footing whole = scene.state.footings[0];
  EXPECT_LT(whole.nodes, 4.01);
  const material::Elastic rubber{1000, 1e6, 0.25};
  Pressed parts(1e-3, 2);
  const auto nodes = parts.model.mesh.hexahedra[1].nodes;
  parts.model.mesh.hexahedra.push_back({"right.one", nodes.leftCols(2)});
  parts.model.mesh.hexahedra.push_back({"right.two", nodes.rightCols(2)});
  parts.model.blocks[1] = element::hexahedra(parts.model.mesh, "right.one", rubber, {.viscosity = {0, 0}});
  parts.model.blocks.push_back(element::hexahedra(parts.model.mesh, "right.two", rubber, {.viscosity = {0, 0}}));
  look_at_footings(parts.model, parts.state);
  EXPECT_EQ(parts.state.footings[0].force, whole.force);
  EXPECT_EQ(parts.state.footings[0].nodes, whole.nodes) << "half a body has fewer nodes";
}

TEST(Footings, OfARigidPlaneAreItsNodes) {
  Model model;
  model.rigid_planes.resize(1);
  model.rigid_planes[0].nodes = {0, 1, 2, 3};
  State state;
  state.rigid_planes.resize(1);
  state.rigid_planes[0].force = {0, 2, 0, 2};
  look_at_footings(model, state);
  ASSERT_EQ(state.footings.size(), 1U);
  EXPECT_EQ(state.footings[0].force, 4);
  EXPECT_NEAR(state.footings[0].nodes, 2, 1e-12);
  state.rigid_planes[0].force = {3, 3, 0, 0}, state.rigid_planes[0].friction.assign(4, Vec3::Zero());
  state.rigid_planes[0].friction[1] = Vec3(0, 4, 0);
  look_at_footings(model, state);
  EXPECT_EQ(state.footings[0].force, 8) << "with its friction";
  state.rigid_planes[0].force = {0, 0, 30, 0};
  model.rigid_of_node = {-1, -1, 0, -1};
  look_at_footings(model, state);
  EXPECT_EQ(state.footings[0].force, 8) << "not of a rigid body";
}

}  // namespace
}  // namespace nereid::dynamics::footing_test
