#include "mesh/revolved.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "mesh/skin.hpp"
#include "mesh/wedge.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::revolved_test {
namespace {

using namespace measures;

/// A plug with a shoulder outside and a ledge in its bore.
Revolved plug(double angle, int around) {
  return {{0.8, 1, 2, 2.2}, {0, 0.3, 0.5}, {2, 3, 1}, {3, 2}, {"xx.", ".xx"}, angle, around};
}

/// Of the circle between two radii.
double sector(double angle, double inner, double outer) { return angle / 2 * (outer * outer - inner * inner); }

double area_of(const Mesh& mesh, const std::string& name) { return facet_areas(mesh, surface(mesh, name)).sum(); }

TEST(Revolved, HasTheVolumeOfItsPolygonAndSoundElements) {
  for (const auto& [angle, around] : {std::pair(0.1, 1), {pi / 2, 3}, {6.0, 9}, {2 * pi, 12}}) {
    const Mesh mesh = revolved("a", plug(angle, around));
    const Table<8>& elements = hexahedra(mesh, "a").nodes;
    const double chord = std::sin(angle / around) / (angle / around);
    const double exact = 0.3 * sector(angle, 1, 2.2) + 0.2 * sector(angle, 0.8, 2);
    EXPECT_EQ(elements.cols(), count(plug(angle, around)));
    EXPECT_NEAR(volume(mesh, elements) / exact, chord, 1e-13);
    EXPECT_GT(smallest_volume(mesh, elements), 0);
  }
}

TEST(Revolved, NamesTheFacesOnEachLine) {
  const Mesh mesh = revolved("a", plug(1, 5));
  const double chord = std::sin(0.2) / 0.2, arc = std::sin(0.1) / 0.1;
  EXPECT_NEAR(area_of(mesh, "a.down_0"), chord * sector(1, 1, 2.2), 1e-14);
  EXPECT_NEAR(area_of(mesh, "a.down_1"), chord * sector(1, 0.8, 1), 1e-14) << "the ledge";
  EXPECT_NEAR(area_of(mesh, "a.up_1"), chord * sector(1, 2, 2.2), 1e-14) << "the shoulder";
  EXPECT_NEAR(area_of(mesh, "a.up_2"), chord * sector(1, 0.8, 2), 1e-14);
  EXPECT_NEAR(area_of(mesh, "a.in_0"), arc * 0.8 * 0.2, 1e-14);
  EXPECT_NEAR(area_of(mesh, "a.in_1"), arc * 1 * 0.3, 1e-14);
  EXPECT_NEAR(area_of(mesh, "a.out_2"), arc * 2 * 0.2, 1e-14);
  EXPECT_NEAR(area_of(mesh, "a.out_3"), arc * 2.2 * 0.3, 1e-14);
  EXPECT_EQ(mesh.surfaces.size(), 8U);
}

TEST(Revolved, HasNormalsOutwards) {
  const Mesh mesh = revolved("a", plug(2 * pi, 8));
  Table<3> all(3, 0);
  for (const Surface& one : mesh.surfaces) {
    const Eigen::Index before = all.cols();
    all.conservativeResize(3, before + one.facets.cols());
    all.rightCols(one.facets.cols()) = one.facets;
  }
  EXPECT_EQ(all.cols(), skin(mesh.X, mesh.hexahedra).facets.cols()) << "a whole turn is closed, without planes";
  double enclosed = 0;
  for (const auto& facet : all.colwise())
    enclosed += Vec3(mesh.X.col(facet[0])).dot(Vec3(mesh.X.col(facet[1])).cross(Vec3(mesh.X.col(facet[2])))) / 6;
  EXPECT_NEAR(enclosed, volume(mesh, hexahedra(mesh, "a").nodes), 1e-13);
  EXPECT_EQ(mesh.node_sets.size(), 1 + mesh.surfaces.size());
}

TEST(Revolved, RefusesAHinge) {
  Revolved body = plug(1, 5);
  EXPECT_FALSE(has_hinge(body));
  body.filled = {"x..", ".xx"};
  EXPECT_TRUE(has_hinge(body));
  EXPECT_THROW(revolved("a", body), InternalError);
}

TEST(Revolved, HasItsPlanes) {
  const Mesh mesh = revolved("a", plug(0.7, 2));
  const std::pair<const char*, Vec3> planes[] = {{"a.first_plane", first_plane_normal()}, {"a.second_plane", second_plane_normal(0.7)}};
  for (const auto& [name, normal] : planes)
    for (const Index node : node_set(mesh, name)) EXPECT_NEAR(normal.dot(mesh.X.col(node)), 0, 1e-15);
  EXPECT_EQ(node_set(mesh, "a.first_plane").size(), node_set(mesh, "a").size() / 3);
}

}  // namespace
}  // namespace nereid::mesh::revolved_test
