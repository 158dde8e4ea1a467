#include "mesh/wedge.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/check.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::wedge_test {
namespace {

using namespace measures;

constexpr double radius = 0.3, length = 0.7;

Mesh sample(double angle, int around, double inner = 0) {
  return wedge("core", {radius, length, angle, around, 4, 3, inner});
}
const Table<8>& elements(const Mesh& mesh) { return hexahedra(mesh, "core").nodes; }

/// Angles from a sliver to nearly a whole turn, with cells around.
const std::vector<std::pair<double, int>> sectors{{0.01, 1}, {0.1, 1}, {pi / 6, 1}, {pi / 2, 1}, {pi / 2, 3}, {pi, 4}, {6.0, 9}};

TEST(Wedge, HasTheVolumeOfItsPolygonAtAnyAngle) {
  for (const auto& [angle, around] : sectors) {
    for (const double inner : {0.0, 0.1}) {
      const Mesh mesh = sample(angle, around, inner);
      const double a = angle / around, circle = angle / 2 * (radius * radius - inner * inner) * length;
      EXPECT_NEAR(volume(mesh, elements(mesh)) / circle, std::sin(a) / a, 1e-13) << angle;  // round-off
      EXPECT_GT(smallest_volume(mesh, elements(mesh)), 0);
    }
  }
}

TEST(Wedge, HasAllNodesOnItsPlanesWhereItIsOneElementWide) {
  const Mesh mesh = sample(0.1, 1);
  Subset both = node_set(mesh, "core.first_plane");
  for (const Index node : node_set(mesh, "core.second_plane")) both.push_back(node);
  std::sort(both.begin(), both.end());
  both.erase(std::unique(both.begin(), both.end()), both.end());
  EXPECT_EQ(both, node_set(mesh, "core"));
}

TEST(Wedge, HasItsPlanesAtAnyAngleWithNormalsOutwards) {
  for (const auto& [angle, around] : sectors) {
    const Mesh mesh = sample(angle, around);
    const std::pair<const char*, Vec3> planes[] = {{"core.first_plane", first_plane_normal()},
                                                   {"core.second_plane", second_plane_normal(angle)}};
    for (const auto& [name, normal] : planes) {
      EXPECT_EQ(node_set(mesh, name).size(), 4U * 5U);
      for (const Index node : node_set(mesh, name)) EXPECT_NEAR(normal.dot(mesh.X.col(node)), 0, 1e-16);  // round-off
    }
    if (angle < pi) {  // beyond, a sector lies on both sides of its planes
      const Vec3 middle(radius / 2 * std::cos(angle / 2), radius / 2 * std::sin(angle / 2), 0);
      for (const auto& [name, normal] : planes) EXPECT_LT(normal.dot(middle), 0);
    }
    for (const Index node : node_set(mesh, "core.first_plane")) EXPECT_EQ(mesh.X(1, node), 0);
  }
}

TEST(Wedge, HasTheNodesOfTheAxisOnBothPlanesOnce) {
  const Mesh mesh = sample(pi / 3, 2);
  EXPECT_EQ(node_set(mesh, "core.axis").size(), 4U);
  for (const Index node : node_set(mesh, "core.axis")) {
    EXPECT_EQ(mesh.X.col(node).head<2>(), Eigen::Vector2d::Zero());
    for (const char* plane : {"core.first_plane", "core.second_plane"})
      EXPECT_EQ(std::count(node_set(mesh, plane).begin(), node_set(mesh, plane).end(), node), 1);
  }
  const Mesh ring = sample(pi / 3, 2, 0.1);
  EXPECT_THROW(node_set(ring, "core.axis"), InternalError);
  EXPECT_EQ(node_set(ring, "core.inside").size(), 3U * 4U);
}

TEST(Wedge, HasOutwardNormalsAndNoFacetWithoutArea) {
  for (const double inner : {0.0, 0.1}) {
    const Mesh mesh = sample(pi / 2, 3, inner);
    const auto up = [](const Vec3&) -> Vec3 { return Vec3::UnitZ(); };
    const auto down = [](const Vec3&) -> Vec3 { return -Vec3::UnitZ(); };
    EXPECT_NEAR(worst_normal(mesh, surface(mesh, "core.top").facets, up), 1, 1e-14);
    EXPECT_NEAR(worst_normal(mesh, surface(mesh, "core.bottom").facets, down), 1, 1e-14);
    EXPECT_GT(worst_normal(mesh, surface(mesh, "core.side").facets, from_axis), std::cos(pi / 12));
    if (inner > 0) {
      const auto inwards = [](const Vec3& at) -> Vec3 { return -from_axis(at); };
      EXPECT_GT(worst_normal(mesh, surface(mesh, "core.inside").facets, inwards), std::cos(pi / 12));
    }
    for (const Surface& surface : mesh.surfaces) EXPECT_GT(facet_areas(mesh, surface).minCoeff(), 0) << surface.name;
  }
}

TEST(Wedge, HasEndsThatMeetItsSideAndTheAreaOfThePolygon) {
  const Mesh mesh = sample(pi / 2, 3);
  const double a = pi / 6, polygon = 3 * std::sin(a) / 2 * radius * radius;
  EXPECT_NEAR(sum(facet_areas(mesh, surface(mesh, "core.top"))), polygon, 1e-15);  // round-off
  Sides sides;
  add_sides(together(mesh.surfaces), sides);
  EXPECT_EQ(open_sides(sides), 2 * 4 * 2 + 2 * 3);  // the border: both planes' ends and the side's upright edges
}

TEST(Wedge, HasEqualTributaryAreasAlongTheSideOfAOneWideSector) {
  const Mesh mesh = wedge("core", {radius, length, 0.1, 1, 2, 6});
  Subset inside;
  for (const Index node : node_set(mesh, "core.side"))
    if (mesh.X(2, node) > 0 && mesh.X(2, node) < length) inside.push_back(node);
  const double half_cell = radius * std::sin(0.05) * length / 6;
  EXPECT_LT(unevenness(tributary_areas(mesh, surface(mesh, "core.side"), inside), half_cell), 1e-13);  // round-off
}

TEST(Wedge, RepeatsItsAxisNodesAndNoOthers) {
  const Mesh mesh = sample(0.1, 1);
  for (Index e = 0; e < elements(mesh).cols(); ++e) {
    const bool at_axis = e % 4 == 0;
    EXPECT_EQ(elements(mesh)(0, e) == elements(mesh)(3, e), at_axis);
    EXPECT_EQ(elements(mesh)(4, e) == elements(mesh)(7, e), at_axis);
    EXPECT_EQ(std::set<Index>(elements(mesh).col(e).begin(), elements(mesh).col(e).end()).size(), at_axis ? 6U : 8U);
  }
}

TEST(Wedge, RefusesWhatIsNoSector) {
  EXPECT_THROW(wedge("core", {1, 1, 0, 1, 1, 1}), InternalError);
  EXPECT_THROW(wedge("core", {1, 1, pi, 1, 1, 1}), InternalError);
  EXPECT_THROW(wedge("core", {1, 1, 7, 9, 1, 1}), InternalError);
  EXPECT_THROW(wedge("core", {1, 1, 1, 1, 1, 1, 1}), InternalError);
  EXPECT_THROW(wedge_tube("skin", {1, 1, 1, 0, 1}), InternalError);
}

TEST(WedgeTube, HasTheAreaOfItsPolygonAndTheNodesOfTheSolidsSide) {
  for (const auto& [angle, around] : sectors) {
    const Mesh tube = wedge_tube("skin", {radius, length, angle, around, 3});
    const double a = angle / around;
    EXPECT_NEAR(sum(facet_areas(tube, surface(tube, "skin.outside"))), 2 * around * radius * std::sin(a / 2) * length, 1e-14);
    EXPECT_GT(worst_normal(tube, triangles(tube, "skin").nodes, from_axis), std::cos(a / 2) * (1 - 1e-12));
    const Mesh solid = sample(angle, around);
    const Subset& side = node_set(solid, "core.side");
    ASSERT_EQ(static_cast<std::size_t>(tube.X.cols()), side.size());
    for (Index node = 0; node < tube.X.cols(); ++node) EXPECT_EQ(tube.X.col(node), solid.X.col(side[node]));
  }
}

TEST(WedgeTube, HasCompleteNodeSets) {
  const Mesh tube = wedge_tube("skin", {radius, length, 1.0, 2, 3});
  EXPECT_EQ(node_set(tube, "skin.bottom"), (Subset{0, 1, 2}));
  EXPECT_EQ(node_set(tube, "skin.top"), (Subset{9, 10, 11}));
  EXPECT_EQ(node_set(tube, "skin.first_plane"), (Subset{0, 3, 6, 9}));
  EXPECT_EQ(node_set(tube, "skin.second_plane"), (Subset{2, 5, 8, 11}));
}

}  // namespace
}  // namespace nereid::mesh::wedge_test
