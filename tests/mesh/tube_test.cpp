#include <gtest/gtest.h>

#include "base/check.hpp"
#include "mesh/cylinder.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::tube_test {
namespace {

using namespace measures;

constexpr double radius = 0.35, length = 0.7;
constexpr int cells_core = 3, cells_along = 4;

Mesh sample(Revolution turn) { return tube("skin", {radius, length, turn, cells_core, cells_along}); }

TEST(Tube, HasNormalsToTheSideNamed) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    const Mesh mesh = sample(turn);
    const auto to_axis = [](const Vec3& point) -> Vec3 { return -from_axis(point); };
    const double half_angle = std::cos(pi / (8 * cells_core));  // a flat facet turns by this
    EXPECT_GT(worst_normal(mesh, triangles(mesh, "skin").nodes, from_axis), half_angle);
    EXPECT_GT(worst_normal(mesh, surface(mesh, "skin.outside").facets, from_axis), half_angle);
    EXPECT_GT(worst_normal(mesh, surface(mesh, "skin.inside").facets, to_axis), half_angle);
  }
}

TEST(Tube, HasItsNodesAtTheAnglesAndHeightsOfACylinder) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    const Mesh skin = sample(turn);
    const Mesh lead = cylinder("lead", {radius, length, turn, cells_core, 2, cells_along});
    const Places at = nodes_by_place(skin);
    const Subset& side = node_set(lead, "lead.side");
    EXPECT_EQ(side.size(), at.size());
    for (const Index node : side) {
      EXPECT_TRUE(at.count({lead.X(0, node), lead.X(1, node), lead.X(2, node)}));
    }
  }
}

TEST(Tube, HasCompleteNodeSets) {
  const Mesh mesh = sample(Revolution::quarter);
  EXPECT_EQ(node_set(mesh, "skin").size(), 7u * 5u);
  EXPECT_EQ(node_set(mesh, "skin.bottom").size(), 7u);
  EXPECT_EQ(node_set(mesh, "skin.top").size(), 7u);
  EXPECT_EQ(node_set(mesh, "skin.x_plane").size(), 5u);
  EXPECT_EQ(node_set(mesh, "skin.y_plane").size(), 5u);
  for (const Index node : node_set(mesh, "skin.x_plane")) EXPECT_EQ(mesh.X(0, node), 0.0);
  for (const Index node : node_set(mesh, "skin.y_plane")) EXPECT_EQ(mesh.X(1, node), 0.0);
  for (const Index node : node_set(mesh, "skin.top")) EXPECT_EQ(mesh.X(2, node), length);
  EXPECT_THROW(node_set(sample(Revolution::full), "skin.x_plane"), InternalError);
}

TEST(Tube, FullIsFourQuartersMirroredBitForBitWithFirstSidesReversed) {
  const Mesh quarter = sample(Revolution::quarter), full = sample(Revolution::full);
  EXPECT_EQ(triangles(full, "skin").nodes.cols(), 4 * triangles(quarter, "skin").nodes.cols());
  EXPECT_EQ(full.X.cols(), 8 * cells_core * (cells_along + 1));
  EXPECT_EQ(nodes_by_place(full).size(), static_cast<std::size_t>(full.X.cols()));
  for (const int axis : {0, 1}) {
    EXPECT_TRUE(is_mirrored<3>(full, triangles(full, "skin").nodes, {1, 0, 2}, axis));
    EXPECT_TRUE(is_mirrored<3>(full, surface(full, "skin.inside").facets, {1, 0, 2}, axis));
  }
}

TEST(Tube, HasFirstSidesThatRunAround) {
  const Mesh full = sample(Revolution::full);
  const Table<3>& nodes = triangles(full, "skin").nodes;
  for (Index element = 0; element < nodes.cols(); ++element) {
    EXPECT_EQ(full.X(2, nodes(0, element)), full.X(2, nodes(1, element)));
  }
}

TEST(Tube, HasSixTrianglesAtEachInnerNodeOfTheFullTurn) {
  const Mesh full = sample(Revolution::full);
  const Table<3>& nodes = triangles(full, "skin").nodes;
  std::vector<int> meeting(static_cast<std::size_t>(full.X.cols()), 0);
  for (const Index node : nodes.reshaped()) ++meeting[node];
  for (Index node = 0; node < full.X.cols(); ++node) {
    if (full.X(2, node) == 0 || full.X(2, node) == length) continue;
    EXPECT_EQ(meeting[node], 6);
  }
}

TEST(Tube, IsOpenAtItsRimsOnly) {
  const Mesh full = sample(Revolution::full);
  Sides sides;
  add_sides(surface(full, "skin.outside").facets, sides);
  EXPECT_EQ(open_sides(sides), 2 * 8 * cells_core);
  EXPECT_EQ(euler_characteristic(surface(full, "skin.outside").facets), 0);
}

TEST(Tube, HasTributaryAreasThatSumToTheArea) {
  const Mesh full = sample(Revolution::full);
  const double around = 8 * cells_core;
  const double exact = 2 * around * std::sin(pi / around) * radius * length;
  for (const Surface& surface : full.surfaces) {
    EXPECT_NEAR(sum(tributary_areas(full, surface, node_set(full, "skin"))), exact, 1e-13);
  }
}

TEST(Tube, RefusesEmptyShapes) {
  EXPECT_THROW(tube("skin", {0, 1, Revolution::full, 1, 1}), InternalError);
  EXPECT_THROW(tube("skin", {1, 1, Revolution::full, 0, 1}), InternalError);
}

}  // namespace
}  // namespace nereid::mesh::tube_test
