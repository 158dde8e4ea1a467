#include "contact/crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/box.hpp"
#include "mesh/placement.hpp"
#include "mesh/skin.hpp"

namespace nereid::contact {
namespace {

/// Two square bars, 1 x 1 x 6 m, the upper one along x and the lower one turned by `degrees` from it; both stand on their ridges, `gap`
/// apart.
struct Bars {
  mesh::Mesh mesh;
  Interface interface;
  Memory memory;

  Bars(double degrees, double gap, int cells = 3) {
    const double turn = std::acos(-1.0) / 180;
    const auto bar = [&](const char* name) {
      mesh::Mesh one = mesh::box(name, {{-3, -0.5, -0.5}, {3, 0.5, 0.5}, {cells, 1, 1}});
      one.surfaces.push_back({std::string(name) + ".skin", mesh::skin(one.X, one.hexahedra).facets});
      return mesh::rotated_about(std::move(one), Vec3::UnitX(), 45 * turn, Vec3::Zero());
    };
    mesh::Mesh lower = mesh::rotated_about(bar("lower"), Vec3::UnitZ(), degrees * turn, Vec3::Zero());
    mesh = mesh::join(mesh::moved(bar("upper"), {0, 0, std::sqrt(2.0) + gap}), lower);
    interface.kind = InterfaceKind::edges;
    interface.method = Method::multiplier;
    interface.edges = edges_of(mesh, mesh::surface(mesh, "upper.skin"), {});
    interface.base_edges = edges_of(mesh, mesh::surface(mesh, "lower.skin"), {});
    interface.margin = 0.3;
    interface.depth = 0.5;
    interface.apexes = nodes_of(interface.edges), interface.base_nodes = nodes_of(interface.base_edges);
  }

  /// The pair of edges that are over each other, of all that a search lists.
  Over only() {
    Workspace workspace(interface);
    const InitialGaps gaps = connect_edges(interface, mesh.X, memory, workspace);
    EXPECT_GT(gaps.pairs, 0);
    Over found;
    int count = 0;
    for (const Crossing& crossing : memory.crossings) {
      const Over at = over(interface, mesh.X, crossing.edge, crossing.base_edge, 0);
      if (at.is && at.normal.z() > 0.99) found = at, ++count;  // and not at the ends of the bars
    }
    EXPECT_EQ(count, 1);
    return found;
  }
};

TEST(Over, RidgesThatCrossTouchAtOnePointAtAnyAngle) {
  for (const double degrees : {90.0, 45.0, 5.0, 1.0, 0.1}) {
    for (const double gap : {0.01, 0.0, -0.01}) {
      const Over at = Bars(degrees, gap).only();
      EXPECT_NEAR(at.height, gap, 1e-10) << degrees;
      EXPECT_NEAR(at.normal.z(), 1, 1e-12);
      EXPECT_NEAR(at.first, 0.5, 1e-9);
      EXPECT_NEAR(at.second, 0.5, 1e-9);
    }
  }
}

TEST(Over, ParallelRidgesAreLeftToTheirNodes) {
  Bars bars(0, 0.01);
  Workspace workspace(bars.interface);
  connect_edges(bars.interface, bars.mesh.X, bars.memory, workspace);
  EXPECT_FALSE(bars.memory.crossings.empty());
  for (const Crossing& crossing : bars.memory.crossings)
    EXPECT_FALSE(over(bars.interface, bars.mesh.X, crossing.edge, crossing.base_edge, 0).is);
}

TEST(Over, EndsWhereTheNextEdgeBegins) {
  for (const double along : {0.0, 0.4, 0.999, 1.001, 1.7}) {  // the upper bar has a node at 1 m
    Bars bars(90, 0.01);
    for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(0, node) -= along;
    const Over at = bars.only();
    const double place = std::fmod(along + 1, 2.0) / 2;  // from one end or the other
    EXPECT_NEAR(std::abs(at.first - 0.5), std::abs(place - 0.5), 1e-9) << along;
  }
}

TEST(ConnectEdges, SeesRidgesThatStartInEachOther) {
  Bars apart(90, 0.01), in_each_other(90, -0.01), through(90, -1.3);
  const auto gaps = [](Bars& bars) {
    Workspace workspace(bars.interface);
    return connect_edges(bars.interface, bars.mesh.X, bars.memory, workspace);
  };
  EXPECT_EQ(gaps(apart).penetrating, 0);
  EXPECT_EQ(gaps(in_each_other).penetrating, 1);
  EXPECT_NEAR(gaps(in_each_other).deepest, 0.01, 1e-12);
  for (const Crossing& crossing : in_each_other.memory.crossings) {
    if (crossing.side == 0) continue;
    EXPECT_NEAR(crossing.level, -0.01, 1e-12);  // what is accepted makes no force
  }
  EXPECT_EQ(gaps(through).penetrating, 0);  // the ridges behind are far behind: the audit sees that overlap
}

TEST(SearchCrossings, LeavesOutEdgesThatAreNowhere) {
  Bars bars(90, 0.01);
  Workspace workspace(bars.interface);
  connect_edges(bars.interface, bars.mesh.X, bars.memory, workspace);
  EXPECT_FALSE(bars.memory.crossings.empty());
  for (const double nowhere : {std::nan(""), HUGE_VAL, 1e200}) {
    for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(node % 3, node) = nowhere;
    search_crossings(bars.interface, bars.mesh.X, bars.memory, workspace);
    EXPECT_TRUE(bars.memory.crossings.empty());
  }
}

TEST(SearchCrossings, KeepsWhatPairsRemember) {
  Bars bars(90, 0.01);
  Workspace workspace(bars.interface);
  connect_edges(bars.interface, bars.mesh.X, bars.memory, workspace);
  const auto touching = [&] {
    return std::find_if(bars.memory.crossings.begin(), bars.memory.crossings.end(), [&](const Crossing& crossing) {
      return over(bars.interface, bars.mesh.X, crossing.edge, crossing.base_edge, 0).is;
    });
  };
  touching()->restitution.held = 3;
  search_crossings(bars.interface, bars.mesh.X, bars.memory, workspace);
  ASSERT_NE(touching(), bars.memory.crossings.end());
  EXPECT_EQ(touching()->restitution.held, 3);
  for (const Index node : mesh::node_set(bars.mesh, "upper")) bars.mesh.X(2, node) += 5;
  search_crossings(bars.interface, bars.mesh.X, bars.memory, workspace);
  EXPECT_TRUE(bars.memory.crossings.empty());
  EXPECT_EQ(bars.memory.impact, 3);  // what is let go is lost
}

}  // namespace
}  // namespace nereid::contact
