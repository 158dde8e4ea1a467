#include "mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "base/check.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/box.hpp"
#include "mesh/skin.hpp"

namespace nereid::mesh::mesh_test {
namespace {

Mesh block(const std::string& name) { return box(name, {{0, 0, 0}, {1, 2, 3}, {2, 1, 3}}); }

/// Two triangles over the unit square, cut from node 0 to node 2, and a node beside them.
Mesh square() {
  Mesh mesh;
  mesh.X.resize(3, 5);
  mesh.X << 0, 1, 1, 0, 9,  //
      0, 0, 1, 1, 9,        //
      0, 0, 0, 0, 9;
  Table<3> facets(3, 2);
  facets << 0, 2,  //
      1, 3,        //
      2, 0;
  mesh.surfaces = {{"square", facets}};
  mesh.triangles = {{"plate", facets}};
  return mesh;
}

template <int rows>
Table<rows> moved(const Table<rows>& nodes, Index by) {
  return (nodes.array() + by).matrix();
}

TEST(Mesh, FindsWhatItHoldsByName) {
  const Mesh mesh = block("A");
  EXPECT_EQ(hexahedra(mesh, "A").nodes.cols(), 6);
  EXPECT_EQ(surface(mesh, "A.z_high").facets.cols(), 4);
  EXPECT_EQ(node_set(mesh, "A.z_high").size(), 6u);
  EXPECT_EQ(triangles(square(), "plate").nodes.cols(), 2);
}

TEST(Mesh, RefusesUnknownNames) {
  const Mesh mesh = block("A");
  EXPECT_THROW(hexahedra(mesh, "B"), InternalError);
  EXPECT_THROW(triangles(mesh, "A"), InternalError);
  EXPECT_THROW(surface(mesh, "A"), InternalError);
  EXPECT_THROW(node_set(mesh, "A.front"), InternalError);
}

TEST(Mesh, JoinsWithTheNodesOfTheSecondAfterTheFirst) {
  const Mesh a = block("A"), b = join(block("B"), square());
  const Mesh both = join(a, b);
  const Index first = static_cast<Index>(a.X.cols());
  EXPECT_EQ(both.X.leftCols(first), a.X);
  EXPECT_EQ(both.X.rightCols(b.X.cols()), b.X);
  EXPECT_EQ(hexahedra(both, "A").nodes, hexahedra(a, "A").nodes);
  EXPECT_EQ(moved(hexahedra(b, "B").nodes, first), hexahedra(both, "B").nodes);
  EXPECT_EQ(moved(triangles(b, "plate").nodes, first), triangles(both, "plate").nodes);
  EXPECT_EQ(moved(surface(b, "B.x_low").facets, first), surface(both, "B.x_low").facets);
  EXPECT_EQ(surface_nodes(surface(both, "B.x_low")), node_set(both, "B.x_low"));
  EXPECT_EQ(node_set(both, "B").front(), first);
}

TEST(Mesh, RefusesToJoinEqualNames) { EXPECT_THROW(join(block("A"), block("A")), InternalError); }

TEST(Mesh, RefusesToJoinRegionsOfDifferentKindsWithEqualNames) {
  EXPECT_THROW(join(block("plate"), square()), InternalError);
}

TEST(SurfaceNodes, AreAscendingAndEachOnce) {
  EXPECT_EQ(surface_nodes(surface(square(), "square")), (Subset{0, 1, 2, 3}));
}

TEST(FacetAreas, AreHalfOfTheSquareEach) {
  const Mesh mesh = square();
  EXPECT_EQ(facet_areas(mesh, surface(mesh, "square")), Eigen::Vector2d(0.5, 0.5));
}

TEST(Faces, AreThoseOfHexahedraWhereBothFacetsAreThereAndElseTheFacets) {
  const Mesh mesh = block("A");
  Surface side = surface(mesh, "A.x_low");
  const auto facets = side.facets.cols();
  const Table<4> whole = faces(mesh, side);
  EXPECT_EQ(whole.cols(), facets / 2);
  EXPECT_GE(whole.minCoeff(), 0);
  for (Index f = 0; f < whole.cols(); ++f) {  // around the face, as its facets are
    const auto at = [&](int a) { return Vec3(mesh.X.col(whole(a, f))); };
    for (int a = 0; a < 4; ++a) {
      const Vec3 turn = (at((a + 1) % 4) - at(a)).cross(at((a + 2) % 4) - at((a + 1) % 4));
      EXPECT_LT(turn.x(), 0);
    }
  }
  side.facets = Table<3>(side.facets.leftCols(facets - 1));
  const Table<4> part = faces(mesh, side);
  EXPECT_EQ(part.cols(), facets / 2);
  EXPECT_EQ((part.row(3).array() < 0).count(), 1);
  EXPECT_EQ((faces(square(), surface(square(), "square")).row(3).array() < 0).count(), 2);  // plates
}

TEST(TributaryAreas, OfAFaceAreWhatAUniformPressureGivesItsBilinearCorners) {
  Mesh mesh = block("A");
  const Surface& side = surface(mesh, "A.x_low");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.1, 0.1);
  for (const Index node : surface_nodes(side)) mesh.X(1, node) += unit(random), mesh.X(2, node) += unit(random);
  const Subset nodes = surface_nodes(side);
  Scalars exact = Scalars::Zero(mesh.X.cols());
  const Table<4> all = faces(mesh, side);
  const double gauss = std::sqrt(1.0 / 3);
  for (Index f = 0; f < all.cols(); ++f) {
    for (const double xi : {-gauss, gauss}) {
      for (const double eta : {-gauss, gauss}) {
        const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        Vec3 by_xi = Vec3::Zero(), by_eta = by_xi;
        for (int a = 0; a < 4; ++a) {
          by_xi += 0.25 * sign[a][0] * (1 + sign[a][1] * eta) * mesh.X.col(all(a, f));
          by_eta += 0.25 * sign[a][1] * (1 + sign[a][0] * xi) * mesh.X.col(all(a, f));
        }
        for (int a = 0; a < 4; ++a)
          exact(all(a, f)) += 0.25 * (1 + sign[a][0] * xi) * (1 + sign[a][1] * eta) * by_xi.cross(by_eta).norm();
      }
    }
  }
  const Scalars areas = tributary_areas(mesh, side, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_NEAR(areas(static_cast<Eigen::Index>(i)), exact(nodes[i]), 1e-14);
  EXPECT_NEAR(areas.sum(), facet_areas(mesh, side).sum(), 1e-14);
}

TEST(TributaryAreas, AreAThirdOfTheFacetsAtTheNode) {
  const Mesh mesh = square();
  const Scalars areas = tributary_areas(mesh, surface(mesh, "square"), {0, 1, 4});
  EXPECT_DOUBLE_EQ(areas(0), 1.0 / 3);
  EXPECT_DOUBLE_EQ(areas(1), 1.0 / 6);
  EXPECT_EQ(areas(2), 0);
}

TEST(TributaryAreas, OfPlatesCountOneOfTheirTwoSidesAndOfSolidsAll) {
  const Mesh plate = square(), cube = box("A", {Vec3::Zero(), Vec3::Ones(), {2, 3, 1}});
  const Subset nodes{0, 1, 2, 3};
  const Surface &one = surface(plate, "square"), both{"both", both_sides(one.facets)};
  EXPECT_EQ(tributary_areas(plate, both, nodes), tributary_areas(plate, one, nodes));
  const Surface around{"around", skin(cube.X, cube.hexahedra).facets};
  EXPECT_NEAR(tributary_areas(cube, around, surface_nodes(around)).sum(), 6, 1e-14);
}

/// All six sides of a cube of 1 m with four cells along each, in one surface.
Mesh cube_with_skin() {
  Mesh mesh = box("A", {Vec3::Zero(), Vec3::Ones(), {4, 4, 4}});
  Table<3> all(3, 0);
  for (const Surface& side : mesh.surfaces) {
    const Table<3> before = all;
    all.resize(3, before.cols() + side.facets.cols());
    all << before, side.facets;
  }
  mesh.surfaces.push_back({"A.skin", all});
  return mesh;
}

TEST(FacesAround, ShareOutTheTributaryAreas) {
  const Mesh mesh = cube_with_skin();
  const Surface& skin = surface(mesh, "A.skin");
  const Subset nodes = surface_nodes(skin);
  const FacesAround around = faces_around(mesh, skin, nodes);
  const Scalars areas = tributary_areas(mesh, skin, nodes);
  ASSERT_EQ(around.begin.size(), nodes.size() + 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    double sum = 0;
    for (Index s = around.begin[i]; s < around.begin[i + 1]; ++s) sum += around.shares[static_cast<std::size_t>(s)].area;
    EXPECT_NEAR(sum, areas(static_cast<Eigen::Index>(i)), 1e-15);
  }
}

TEST(TributaryAreaFacing, OfASkinIsThatOfTheSideThatIsPressedAlsoAfterATurn) {
  const Mesh mesh = cube_with_skin();
  const Surface &skin = surface(mesh, "A.skin"), &side = surface(mesh, "A.z_low");
  const Subset nodes = surface_nodes(side);
  const FacesAround around = faces_around(mesh, skin, nodes);
  const Scalars of_side = tributary_areas(mesh, side, nodes), of_skin = tributary_areas(mesh, skin, nodes);
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(0.3, -0.4, 0.8).normalized()).toRotationMatrix();
  const Vectors x = turn * mesh.X;
  for (Index i = 0; i < static_cast<Index>(nodes.size()); ++i) {
    EXPECT_NEAR(tributary_area_facing(around, x, i, turn * Vec3(0, 0, 7)), of_side(i), 1e-15);  // pushed up from below
    EXPECT_EQ(tributary_area_facing(around, x, i, Vec3::Zero()), of_skin(i));
    EXPECT_NEAR(tributary_area_facing(around, x, i, turn * Vec3(0, 0, -1)), 0, 1e-15);
  }
  EXPECT_NEAR(of_skin.maxCoeff() / of_side.maxCoeff(), 1, 1e-12);
  EXPECT_NEAR(of_skin(0) / of_side(0), 3, 1e-12);  // the corner has three sides
}

TEST(TributaryAreaLoaded, OfASkinIsThatOfTheSideThatIsPressedOrAllOfItWhereNoneIs) {
  const Mesh mesh = cube_with_skin();
  const Surface &skin = surface(mesh, "A.skin"), &side = surface(mesh, "A.z_low");
  const Subset nodes = surface_nodes(side);
  const FacesAround around = faces_around(mesh, skin, nodes);
  const Scalars of_side = tributary_areas(mesh, side, nodes), of_skin = tributary_areas(mesh, skin, nodes);
  for (Index i = 0; i < static_cast<Index>(nodes.size()); ++i) {
    EXPECT_NEAR(tributary_area_loaded(around, mesh.X, i, {0.1, 0.2, 7}, of_skin(i)), of_side(i), 1e-15);
    EXPECT_EQ(tributary_area_loaded(around, mesh.X, i, {0, 0, -1}, of_skin(i)), of_skin(i));  // no face looks that way
    EXPECT_EQ(tributary_area_loaded({}, mesh.X, i, {0, 0, 1}, of_skin(i)), of_skin(i));
  }
}

TEST(TributaryAreaFacing, TurnsContinuouslyFromOneSideToTheOther) {
  const Mesh mesh = cube_with_skin();
  const Surface& skin = surface(mesh, "A.skin");
  const FacesAround around = faces_around(mesh, skin, {2});  // on the edge between y_low and z_low
  const double share = 1. / 16;
  for (const double angle : {0.0, 0.3, pi / 4, 1.2, pi / 2})
    EXPECT_NEAR(tributary_area_facing(around, mesh.X, 0, {0, std::sin(angle), std::cos(angle)}),
                0.5 * share * (std::sin(angle) + std::cos(angle)), 1e-15);
}

}  // namespace
}  // namespace nereid::mesh::mesh_test
