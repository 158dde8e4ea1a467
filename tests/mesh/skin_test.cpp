#include "mesh/skin.hpp"

#include <gtest/gtest.h>

#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/wedge.hpp"
#include "tests/mesh/measures.hpp"

namespace nereid::mesh::skin_test {
namespace {

using namespace measures;

TEST(Volumes, AreExactForDistortedHexahedraFarFromTheOrigin) {
  std::srand(3);
  Mesh mesh = box("a", {Vec3::Zero(), Vec3(3, 2, 2), {3, 2, 2}});
  mesh.X += 0.2 * Vectors::Random(3, mesh.X.cols());
  mesh.X.colwise() += Vec3(100, -50, 20);
  const Scalars all = volumes(mesh, mesh.hexahedra[0]);
  for (Index e = 0; e < all.size(); ++e) {
    const Table<8> one = mesh.hexahedra[0].nodes.col(e);
    EXPECT_NEAR(all(e) / trilinear_volume(mesh, one), 1, 1e-11);  // coordinates of 100 leave thirteen digits of a cell
  }
}

TEST(Volumes, AreNegativeInsideOut) {
  Mesh mesh = box("a", {Vec3::Zero(), Vec3(1, 2, 3), {1, 1, 1}});
  mesh.hexahedra[0].nodes.topRows(4).swap(mesh.hexahedra[0].nodes.bottomRows(4));
  EXPECT_NEAR(volumes(mesh, mesh.hexahedra[0])(0), -6, 1e-14);
}

TEST(Skin, OfACylinderIsItsThreeSurfaces) {
  const Mesh mesh = cylinder("a", {0.3, 0.7, Revolution::full, 3, 2, 4});
  const Skin found = skin(mesh.X, mesh.hexahedra);
  EXPECT_EQ(found.crowded, 0);
  double area = 0;
  for (const Surface& surface : mesh.surfaces) area += sum(facet_areas(mesh, surface));
  EXPECT_NEAR(sum(facet_areas(mesh, {"", found.facets})) / area, 1, 1e-14);  // round-off
  Sides sides;
  add_sides(found.facets, sides);
  EXPECT_EQ(open_sides(sides), 0);
  EXPECT_EQ(euler_characteristic(found.facets), 2);
  const Vec3 centre(0, 0, 0.35);
  EXPECT_GT(worst_normal(mesh, found.facets, [&](const Vec3& at) -> Vec3 { return at - centre; }), 0);
}

TEST(Skin, OfASectorClosesAtTheAxis) {
  const Mesh mesh = wedge("a", {0.3, 0.7, 0.4, 1, 3, 2});
  const Table<3> facets = skin(mesh.X, mesh.hexahedra).facets;
  Sides sides;
  add_sides(facets, sides);
  EXPECT_EQ(open_sides(sides), 0);
  EXPECT_EQ(euler_characteristic(facets), 2);
  EXPECT_GT(facet_areas(mesh, {"", facets}).minCoeff(), 0);
}

TEST(Skin, LeavesOutWhatRegionsShareAndTellsOfCrowdedFaces) {
  Mesh mesh = box("a", {Vec3::Zero(), Vec3(2, 1, 1), {2, 1, 1}});
  const Table<8> both = mesh.hexahedra[0].nodes;
  mesh.hexahedra = {{"left", both.leftCols(1)}, {"right", both.rightCols(1)}};
  EXPECT_EQ(skin(mesh.X, mesh.hexahedra).facets.cols(), 2 * 10);
  mesh.hexahedra.push_back({"again", both.rightCols(1)});
  EXPECT_EQ(skin(mesh.X, mesh.hexahedra).crowded, 1);  // the face between; those of the pair are inner ones
}

}  // namespace
}  // namespace nereid::mesh::skin_test
