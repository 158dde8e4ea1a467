#include "mesh/disc.hpp"

#include <gtest/gtest.h>

#include "base/check.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::disc_test {
namespace {

using namespace measures;

constexpr double radius = 0.3;

Vec3 up(const Vec3&) { return Vec3::UnitZ(); }
Vec3 down(const Vec3&) { return -Vec3::UnitZ(); }

/// Facets that meet at each node off the border.
std::map<int, int> facets_inside(const Mesh& mesh, const std::string& name) {
  Sides sides;
  add_sides(surface(mesh, name + ".top").facets, sides);
  std::map<Index, int> at;
  for (const Index node : surface(mesh, name + ".top").facets.reshaped()) ++at[node];
  for (const auto& [side, count] : sides)
    if (!sides.count({side.second, side.first})) at.erase(side.first), at.erase(side.second);
  std::map<int, int> nodes_with;
  for (const auto& [node, count] : at) ++nodes_with[count];
  return nodes_with;
}

TEST(Disc, HasTheAreaOfItsPolygonAndBothSides) {
  for (const Revolution turn : {Revolution::quarter, Revolution::full}) {
    const Mesh mesh = disc("plate", {radius, turn, 3, 2});
    const double around = 8 * 3, polygon = around / 2 * std::sin(2 * pi / around) * radius * radius;
    for (const char* side : {"plate.top", "plate.bottom"})
      EXPECT_NEAR(sum(facet_areas(mesh, surface(mesh, side))), turn == Revolution::full ? polygon : polygon / 4, 1e-15);
    EXPECT_EQ(worst_normal(mesh, surface(mesh, "plate.top").facets, up), 1);
    EXPECT_EQ(worst_normal(mesh, surface(mesh, "plate.bottom").facets, down), 1);
    EXPECT_EQ(worst_normal(mesh, triangles(mesh, "plate").nodes, up), 1);
    EXPECT_EQ(mesh.X.row(2), Scalars::Zero(mesh.X.cols()).transpose());
  }
}

TEST(Disc, HasCompleteNodeSets) {
  const Mesh whole = disc("plate", {radius, Revolution::full, 3, 2}), quarter = disc("plate", {radius, Revolution::quarter, 3, 2});
  EXPECT_EQ(node_set(whole, "plate.rim"), nodes_where(whole, [](const Vec3& at) { return at.norm() > radius * (1 - 1e-12); }));
  EXPECT_EQ(node_set(whole, "plate.rim").size(), 24U);
  for (const Mesh* mesh : {&whole, &quarter}) {
    EXPECT_EQ(node_set(*mesh, "plate").size(), static_cast<std::size_t>(mesh->X.cols()));
    ASSERT_EQ(node_set(*mesh, "plate.centre").size(), 1U);
    EXPECT_EQ(mesh->X.col(node_set(*mesh, "plate.centre")[0]), Vec3::Zero());
  }
  EXPECT_EQ(node_set(quarter, "plate.x_plane"), nodes_where(quarter, [](const Vec3& at) { return at.x() == 0; }));
  EXPECT_EQ(node_set(quarter, "plate.y_plane"), nodes_where(quarter, [](const Vec3& at) { return at.y() == 0; }));
}

TEST(Disc, IsOneSheetWithoutHoles) {
  const Mesh mesh = disc("plate", {radius, Revolution::full, 3, 2});
  Sides sides;
  add_sides(surface(mesh, "plate.top").facets, sides);
  EXPECT_EQ(open_sides(sides), 24);
  EXPECT_EQ(euler_characteristic(surface(mesh, "plate.top").facets), 1);
}

TEST(WedgeDisc, HasTheAreaOfItsPolygonAtAnyAngleWithAndWithoutAHole) {
  for (const auto& [angle, around] : {std::pair(0.05, 1), {1.0, 2}, {6.0, 9}}) {
    for (const double inner : {0.0, 0.1}) {
      const Mesh mesh = wedge_disc("plate", {radius, angle, around, 4, inner});
      const double a = angle / around;
      EXPECT_NEAR(sum(facet_areas(mesh, surface(mesh, "plate.top"))),
                  around * std::sin(a) / 2 * (radius * radius - inner * inner), 1e-15);
      EXPECT_EQ(worst_normal(mesh, surface(mesh, "plate.bottom").facets, down), 1);
      EXPECT_EQ(node_set(mesh, "plate.rim").size(), static_cast<std::size_t>(around + 1));
      EXPECT_EQ(node_set(mesh, "plate.first_plane").size(), 5U);
      EXPECT_EQ(node_set(mesh, "plate.second_plane").size(), 5U);
      EXPECT_EQ(node_set(mesh, inner > 0 ? "plate.inner_rim" : "plate.centre").size(),
                static_cast<std::size_t>(inner > 0 ? around + 1 : 1));
    }
  }
}

TEST(Sheet, IsItsRectangleWithFourSides) {
  const Mesh mesh = sheet("s", {0.4, 0.3, 4, 2});
  EXPECT_NEAR(sum(facet_areas(mesh, surface(mesh, "s.top"))), 0.12, 1e-16);
  EXPECT_EQ(worst_normal(mesh, surface(mesh, "s.top").facets, up), 1);
  EXPECT_EQ(worst_normal(mesh, surface(mesh, "s.bottom").facets, down), 1);
  EXPECT_EQ(node_set(mesh, "s.x_low"), nodes_where(mesh, [](const Vec3& at) { return at.x() == 0; }));
  EXPECT_EQ(node_set(mesh, "s.x_high"), nodes_where(mesh, [](const Vec3& at) { return at.x() == 0.4; }));
  EXPECT_EQ(node_set(mesh, "s.y_low"), nodes_where(mesh, [](const Vec3& at) { return at.y() == 0; }));
  EXPECT_EQ(node_set(mesh, "s.y_high"), nodes_where(mesh, [](const Vec3& at) { return at.y() == 0.3; }));
}

TEST(Sheet, HasItsFirstSidesAlongX) {
  for (const Cuts cuts : {Cuts::columns, Cuts::crossed}) {
    const Mesh mesh = sheet("s", {0.4, 0.3, 4, 2, cuts});
    const Table<3>& nodes = triangles(mesh, "s").nodes;
    for (Index e = 0; e < nodes.cols(); ++e) EXPECT_EQ(mesh.X(1, nodes(0, e)), mesh.X(1, nodes(1, e)));
  }
}

TEST(Sheet, HasSixFacetsAtEachInnerNodeOrIsCrossed) {
  EXPECT_EQ(facets_inside(sheet("s", {1, 1, 6, 4}), "s"), (std::map<int, int>{{6, 15}}));
  EXPECT_EQ(facets_inside(sheet("s", {1, 1, 6, 4, Cuts::crossed}), "s"), (std::map<int, int>{{4, 7}, {8, 8}}));
}

TEST(Sheet, CrossedIsItsOwnImageInBothMiddles) {
  Mesh mesh = sheet("s", {2, 2, 4, 2, Cuts::crossed});
  mesh.X.colwise() -= Vec3(1, 1, 0);
  for (const int axis : {0, 1}) EXPECT_TRUE(is_mirrored<3>(mesh, triangles(mesh, "s").nodes, {1, 0, 2}, axis));
}

TEST(Flat, RefusesEmptyShapes) {
  EXPECT_THROW(disc("a", {0, Revolution::full, 1, 1}), InternalError);
  EXPECT_THROW(sheet("a", {1, 0, 1, 1}), InternalError);
  EXPECT_THROW(sheet("a", {1, 1, 1, 0}), InternalError);
}

}  // namespace
}  // namespace nereid::mesh::disc_test
