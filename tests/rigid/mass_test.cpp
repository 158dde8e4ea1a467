#include "rigid/mass.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "mesh/box.hpp"

namespace nereid::rigid::mass_test {
namespace {

rigid::MassProperties of_hexahedra(const mesh::Mesh& mesh, const Vec3& about) {
  rigid::Moments sum;
  for (const mesh::Hexahedra& region : mesh.hexahedra) rigid::add_hexahedra(mesh.X, region.nodes, 1000, about, sum);
  return rigid::properties(sum, about);
}

mesh::Mesh bricks(int cells) {
  return mesh::box("box", {.low = {1, 2, 3}, .high = {1.2, 2.4, 3.6}, .cells = {cells, cells, cells}});
}

TEST(MassProperties, OfABoxAreExactFromOneElement) {
  const auto found = of_hexahedra(bricks(1), Vec3::Zero());
  const double mass = 1000 * 0.2 * 0.4 * 0.6;
  EXPECT_NEAR(found.mass, mass, 1e-12 * mass);
  EXPECT_LT((found.centre - Vec3(1.1, 2.2, 3.3)).norm(), 1e-12);
  const Vec3 exact = mass / 12 * Vec3(0.16 + 0.36, 0.36 + 0.04, 0.04 + 0.16);
  EXPECT_LT((found.inertia - Mat3(exact.asDiagonal())).norm(), 1e-10);
}

TEST(MassProperties, OfAWarpedHexahedronAreThoseOfItsParts) {
  mesh::Mesh one = bricks(1), parts = bricks(4);
  const auto warp = [](const Vec3& X) {  // trilinear, so that one element has the same shape
    const Vec3 u = (X - Vec3(1, 2, 3)).cwiseQuotient(Vec3(0.2, 0.4, 0.6));
    return Vec3(X.x() + 0.05 * u.y() * u.z(), X.y() + 0.08 * u.x() * u.z(), X.z() + 0.1 * u.x() * u.y() * u.z());
  };
  for (mesh::Mesh* mesh : {&one, &parts})
    for (Eigen::Index n = 0; n < mesh->X.cols(); ++n) mesh->X.col(n) = warp(mesh->X.col(n));
  const auto whole = of_hexahedra(one, Vec3(1, 2, 3)), sum = of_hexahedra(parts, Vec3(0, 1, 0));
  EXPECT_NEAR(whole.mass, sum.mass, 1e-12 * sum.mass);
  EXPECT_LT((whole.centre - sum.centre).norm(), 1e-12);
  EXPECT_LT((whole.inertia - sum.inertia).norm(), 1e-11 * sum.inertia.norm());
}

TEST(MassProperties, OfATurnedBodyTurnWithIt) {
  mesh::Mesh mesh = bricks(2);
  const auto before = of_hexahedra(mesh, Vec3(1, 1, 1));
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  mesh.X = R * mesh.X;
  const auto after = of_hexahedra(mesh, Vec3(1, 1, 1));
  EXPECT_LT((after.centre - R * before.centre).norm(), 1e-12);
  EXPECT_LT((after.inertia - R * before.inertia * R.transpose()).norm(), 1e-10);
}

TEST(MassProperties, OfPlatesHaveTheirThickness) {
  Vectors X(3, 4);
  X << 0, 2, 2, 0, 0, 0, 1, 1, 5, 5, 5, 5;
  Table<3> nodes(3, 2);
  nodes << 0, 0, 1, 2, 2, 3;
  rigid::Moments sum;
  rigid::add_plates(X, nodes, 10, 0.3, Vec3::Zero(), sum);
  const auto found = rigid::properties(sum, Vec3::Zero());
  const double mass = 10 * 2 * 0.3;
  EXPECT_NEAR(found.mass, mass, 1e-12);
  EXPECT_LT((found.centre - Vec3(1, 0.5, 5)).norm(), 1e-12);
  const Vec3 exact = mass / 12 * Vec3(1 + 0.09, 4 + 0.09, 5);
  EXPECT_LT((found.inertia - Mat3(exact.asDiagonal())).norm(), 1e-11);
}

TEST(MassProperties, OfPointsAreSums) {
  rigid::Moments sum;
  rigid::add_point({1, 0, 0}, 2, {0, 0, 7}, sum);
  rigid::add_point({-1, 0, 0}, 2, {0, 0, 7}, sum);
  const auto found = rigid::properties(sum, {0, 0, 7});
  EXPECT_LT(found.centre.norm(), 1e-12);
  EXPECT_LT((found.inertia - Mat3(Vec3(0, 4, 4).asDiagonal())).norm(), 1e-12);
  EXPECT_FALSE(rigid::is_possible(found.inertia));
  EXPECT_TRUE(rigid::is_possible(Mat3(Vec3(1, 2, 3).asDiagonal())));
  EXPECT_FALSE(rigid::is_possible(Mat3(Vec3(1, 1, 3).asDiagonal())));
}

}  // namespace
}  // namespace nereid::rigid::mass_test
