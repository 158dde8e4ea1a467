#include "contact/report/coarseness.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "contact/connect.hpp"
#include "contact/data/workspace.hpp"
#include "mesh/box.hpp"
#include "mesh/sphere.hpp"

namespace nereid::contact::coarseness_test {
namespace {

using Cells = Eigen::Vector3i;

/// What is seen of apexes on one surface over a base on another.
Coarseness seen(const mesh::Mesh& mesh, const char* apexes, const char* base) {
  Interface in;
  const mesh::Surface &own = mesh::surface(mesh, apexes), &other = mesh::surface(mesh, base);
  in.base = base_surface(other, mesh.X);
  in.apexes = mesh::surface_nodes(own);
  in.area = mesh::tributary_areas(mesh, own, in.apexes);
  in.faces = mesh::faces_around(mesh, own, in.apexes);
  in.margin = 1;
  Memory memory;
  Workspace workspace(in);
  connect(in, mesh.X, 100, {}, InitialPenetration::accept, memory, workspace);
  return coarseness(in, mesh::faces_around(mesh, other, in.base_nodes), mesh.X, 100, workspace);
}

/// A block on a wider one, turned about z. [rad]
Coarseness blocks(const Cells& above, const Cells& below, double turned = 0, double gap = 0) {
  mesh::Mesh upper = mesh::box("above", {Vec3(-1, -1, gap), Vec3(1, 1, 1 + gap), above});
  const Mat3 turn = Eigen::AngleAxisd(turned, Vec3::UnitZ()).toRotationMatrix();
  upper.X = (turn * upper.X).eval();
  return seen(mesh::join(upper, mesh::box("below", {Vec3(-2, -2, -1), Vec3(2, 2, 0), below})), "above.z_low", "below.z_high");
}

TEST(Coarseness, IsTheRatioOfTheSpacings) {
  for (const double gap : {0.0, 0.7}) {
    const Coarseness like = blocks({4, 4, 2}, {8, 8, 2}, 0, gap), coarse = blocks({2, 2, 2}, {8, 8, 2}, 0, gap);
    EXPECT_NEAR(like.apexes, 1, 1e-12);
    EXPECT_NEAR(like.base, 1, 1e-12);
    EXPECT_NEAR(coarse.apexes, 2, 1e-12);
    EXPECT_NEAR(coarse.base, 0.5, 1e-12);
  }
}

TEST(Coarseness, IsThatOfTheDirectionInWhichItIsLargest) {
  const Coarseness one = blocks({4, 2, 1}, {8, 10, 1});
  EXPECT_NEAR(one.apexes, 2.5, 1e-12);
  EXPECT_NEAR(one.base, 1, 1e-12);
  const Coarseness both = blocks({6, 2, 1}, {8, 8, 1});
  EXPECT_NEAR(both.apexes, 2, 1e-12);
  EXPECT_NEAR(both.base, 1.5, 1e-12);
}

TEST(Coarseness, TurnsWithTheMesh) {
  for (const double turned : {0.3, 0.25 * std::numbers::pi}) EXPECT_NEAR(blocks({4, 4, 1}, {8, 8, 1}, turned).apexes, 1, 1e-12);
  EXPECT_NEAR(blocks({6, 2, 1}, {8, 8, 1}, 0.5 * std::numbers::pi).apexes, 2, 1e-12);
}

TEST(Coarseness, OfABallIsThatWhereItComesDown) {
  const mesh::Mesh plate = mesh::box("plate", {Vec3(-3, -3, -2.1), Vec3(3, 3, -1.1), {60, 60, 4}});
  const mesh::Mesh ball = mesh::sphere("ball", {1, mesh::SpherePart::full, 4, 2});
  const Coarseness one = seen(mesh::join(ball, plate), "ball.surface", "plate.z_high");
  EXPECT_NEAR(one.apexes, std::numbers::pi / 16 / 0.1, 0.1);  // eight faces along a quarter of a circle
}

TEST(Coarseness, IsZeroWhereNothingFacesTheBase) {
  const mesh::Mesh both = mesh::join(mesh::box("above", {Vec3(-1, -1, 0), Vec3(1, 1, 1), {2, 2, 1}}),
                                     mesh::box("below", {Vec3(-2, -2, -1), Vec3(2, 2, 0), {4, 4, 1}}));
  EXPECT_EQ(seen(both, "above.z_high", "below.z_high").apexes, 0);
  EXPECT_EQ(seen(both, "above.x_low", "below.z_high").apexes, 0);
}

}  // namespace
}  // namespace nereid::contact::coarseness_test
