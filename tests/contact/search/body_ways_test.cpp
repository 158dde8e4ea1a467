#include "contact/search/body_ways.hpp"

#include <gtest/gtest.h>

namespace nereid::contact::body_ways_test {
namespace {

/// Three bodies of two nodes and one facet each, of which the second apex has the facet of the first body near it.
struct Scene {
  Interface interface;
  Memory memory;
  Vectors v = Vectors::Zero(3, 6);

  Scene() {
    Bodies& bodies = interface.bodies;
    bodies.names = {"one", "other", "far"};
    bodies.of_apex = {0, 0, 1, 1, 2, 2}, bodies.of_facet = {0, 1, 2}, bodies.first_facet = {0, 1, 2, 3};
    bodies.nodes = interface.apexes = {0, 1, 2, 3, 4, 5}, bodies.first_node = {0, 2, 4, 6};
    memory.searches = 1;
    memory.near_facets = {0};
    memory.near.push_back({.apex = 2, .first_facet = 0, .facets = 1, .tracks = {}, .element = {}, .friction = {}});
    v.col(4).x() = 1000;
  }
};

TEST(BodyWays, AreThoseOfBodiesNearEachOther) {
  Scene scene;
  Workspace workspace(scene.interface);
  scene.v.col(0) = Vec3(3, 0, 0), scene.v.col(3) = Vec3(0, -4, 0);
  find_near_bodies(scene.interface, scene.memory, workspace);
  add_ways(scene.interface, scene.v, 0.5, scene.memory, workspace);
  add_ways(scene.interface, scene.v, 0.25, scene.memory, workspace);
  EXPECT_EQ(scene.memory.way_of_body, (std::vector<double>{3.75, 3.75, 0})) << "the diagonal of the box around the velocities of both";
  find_speeds_apart(scene.interface, scene.v, workspace);
  EXPECT_EQ(moved_of_body(scene.memory, workspace, 1, 0.1).now, 4.25);
  EXPECT_EQ(moved_of_body(scene.memory, workspace, 1, 0.1).from, 3.25);
  EXPECT_EQ(moved_of_body(scene.memory, workspace, 2, 0.1).now, 0);
}

TEST(BodyWays, AreNoLessThanThoseOfAnyTwoNodes) {
  Scene scene;
  Workspace workspace(scene.interface);
  for (int round = 0; round < 20; ++round) {
    scene.v = Vectors::Random(3, 6);
    find_near_bodies(scene.interface, scene.memory, workspace);
    find_speeds_apart(scene.interface, scene.v, workspace);
    for (Index i = 0; i < 4; ++i)
      for (Index j = 0; j < i; ++j)
        for (const std::size_t body : {0U, 1U}) EXPECT_GE(workspace.apart[body], (scene.v.col(i) - scene.v.col(j)).norm());
  }
}

TEST(BodyWays, AreThoseAgainstTheFastestNeighbourWhicheverComesLast) {
  Scene scene;
  scene.memory.near.push_back({.apex = 4, .tracks = {}, .element = {}, .friction = {}});
  scene.memory.near.back().tracks.begin(1, 0);
  scene.v.col(0).x() = scene.v.col(1).x() = 10;
  scene.v.col(4) = Vec3(0, 1, 0);
  Workspace workspace(scene.interface);
  find_near_bodies(scene.interface, scene.memory, workspace);
  ASSERT_EQ(workspace.near_bodies, (std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}}));
  find_speeds_apart(scene.interface, scene.v, workspace);
  EXPECT_EQ(workspace.apart, (std::vector<double>{10, 10, 1}));
}

TEST(BodyWays, CountBodiesThatATrackOrEdgesLinkToo) {
  Scene scene;
  scene.memory.near.push_back({.apex = 0, .tracks = {}, .element = {}, .friction = {}});
  scene.memory.near.back().tracks.begin(2, 0);
  Workspace workspace(scene.interface);
  find_near_bodies(scene.interface, scene.memory, workspace);
  EXPECT_EQ(workspace.near_bodies, (std::vector<std::array<Index, 2>>{{0, 1}, {0, 2}}));
  EdgeContact contact;
  contact.bodies = scene.interface.bodies;
  contact.edges.body = contact.base_edges.body = {0, 2, 1};
  EdgeMemory memory;
  memory.edge_pairs = {{.edge = 1, .base_edge = 2}};
  find_near_bodies(contact, memory, workspace);
  EXPECT_EQ(workspace.near_bodies, (std::vector<std::array<Index, 2>>{{1, 2}}));
}

}  // namespace
}  // namespace nereid::contact::body_ways_test
