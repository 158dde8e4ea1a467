#include "element/corners.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "mesh/box.hpp"
#include "mesh/disc.hpp"
#include "mesh/wedge.hpp"

namespace nereid::element::corners_test {
namespace {

const material::Elastic rubber{1000, 1e6, 0.3};

AnyBlock solid(const mesh::Mesh& mesh) { return hexahedra(mesh, "a", rubber, {}); }

TEST(SmallestCorner, IsOneAtRestAndTheDeterminantOfAnAffineMotion) {
  const mesh::Mesh mesh = mesh::box("a", {Vec3::Zero(), Vec3(3, 2, 1), {3, 2, 2}});
  EXPECT_NEAR(smallest_corner(solid(mesh), mesh.X, mesh.X).ratio, 1, 1e-14);
  Mat3 F;
  F << 1.2, 0.3, -0.1, 0.2, 0.7, 0.4, 0, -0.2, 0.9;
  EXPECT_NEAR(smallest_corner(solid(mesh), mesh.X, F * mesh.X).ratio, F.determinant(), 1e-14);
}

TEST(SmallestCorner, TurnsNegativeWhereTheVolumeDoesNot) {
  const mesh::Mesh mesh = mesh::box("a", {Vec3::Zero(), Vec3(3, 1, 1), {3, 1, 1}});
  Vectors x = mesh.X;
  const AnyBlock block = solid(mesh);
  const Connectivity& nodes = element::nodes(block);
  const Index node = nodes(6, 2);  // pushed through the three faces opposite to it, by a fifth of an edge
  x.col(node) = mesh.X.col(nodes(0, 2)) - 0.2 * Vec3(1, 1, 1);
  const Corner corner = smallest_corner(block, mesh.X, x);
  EXPECT_EQ(corner.element, 2);
  EXPECT_LT(corner.ratio, -0.9);
}

TEST(SmallestCorner, OfEachCornerIsSeen) {
  const mesh::Mesh mesh = mesh::box("a", {Vec3::Zero(), Vec3(1, 1, 1), {1, 1, 1}});
  for (Index node = 0; node < 8; ++node) {
    Vectors x = mesh.X;
    x.col(node) += 0.25 * (Vec3::Constant(0.5) - mesh.X.col(node));  // an eighth of the diagonal inwards
    // J = det(e_i - s (1, 1, 1)) with s = 1/8 of the edges that meet there
    EXPECT_NEAR(smallest_corner(solid(mesh), mesh.X, x).ratio, 1 - 3 * 0.125, 1e-14) << node;
  }
}

TEST(SmallestCorner, PassesOverTheAxisOfAWedgeAndPlates) {
  const mesh::Mesh wedge = mesh::wedge("a", {0.2, 0.3, 0.7, 2, 3, 3});
  EXPECT_NEAR(smallest_corner(solid(wedge), wedge.X, wedge.X).ratio, 1, 1e-13);
  const mesh::Mesh sheet = mesh::sheet("a", {1, 1, 2, 2});
  EXPECT_EQ(smallest_corner(plates(sheet, "a", rubber, {.thickness = 0.1, .viscosity = {}}), sheet.X, sheet.X).element, -1);
}

TEST(SmallestCorner, OfPositionsThatAreNoNumberIsNone) {
  const mesh::Mesh mesh = mesh::box("a", {Vec3::Zero(), Vec3(1, 1, 1), {1, 1, 1}});
  Vectors x = mesh.X;
  x(1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(smallest_corner(solid(mesh), mesh.X, x).ratio));
}

}  // namespace
}  // namespace nereid::element::corners_test
