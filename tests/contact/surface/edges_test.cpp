#include "contact/surface/edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/box.hpp"
#include "mesh/skin.hpp"
#include "mesh/cylinder.hpp"

namespace nereid::contact::edges_test {
namespace {

mesh::Mesh box_with_skin(const Eigen::Vector3i& cells) {
  mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), {1, 2, 3}, cells});
  mesh.surfaces.push_back({"box.skin", mesh::skin(mesh.X, mesh.hexahedra).facets});
  return mesh;
}

Index ridges(const Edges& edges, const Vectors& x) {
  Index count = 0;
  for (Index e = 0; e < edges.nodes.cols(); ++e) count += is_ridge(edges, x, e);
  return count;
}

TEST(EdgesOf, ABoxAreThoseOfItsFacesAndNotTheirCuts) {
  const mesh::Mesh mesh = box_with_skin({2, 3, 4});
  const Edges edges = edges_of(mesh, mesh::surface(mesh, "box.skin"), {});
  EXPECT_EQ(edges.nodes.cols(), 2 * (2 * 3 + 3 * 4 + 2 * 4) * 2);  // two for each face
  EXPECT_EQ(ridges(edges, mesh.X), 4 * (2 + 3 + 4));
  EXPECT_EQ(std::count(edges.of_plates.begin(), edges.of_plates.end(), 1), 0);
  EXPECT_GT(edges.area.minCoeff(), 0);
}

TEST(EdgesOf, AFaceAloneHasTheRidgesOfItsBody) {
  const mesh::Mesh mesh = box_with_skin({2, 3, 4});
  const Edges edges = edges_of(mesh, mesh::surface(mesh, "box.z_high"), {});
  EXPECT_EQ(ridges(edges, mesh.X), 2 * (2 + 3));
  EXPECT_EQ((edges.across.row(1).array() < 0).count(), 0);
}

TEST(EdgesOf, ASurfaceLeaveOutThoseInASymmetryPlane) {
  const mesh::Mesh mesh = box_with_skin({2, 3, 4});
  const std::vector<Subset> planes{mesh::node_set(mesh, "box.x_low")};
  const Edges edges = edges_of(mesh, mesh::surface(mesh, "box.skin"), planes);
  EXPECT_EQ(ridges(edges, mesh.X), 4 * (2 + 3 + 4) - 2 * (3 + 4));
}

TEST(AreaLoaded, OfARidgeIsThatOfTheFaceThatIsPressedWhateverTheSurface) {
  const mesh::Mesh mesh = box_with_skin({2, 4, 3});  // cells of 0.5 x 0.5 m at the top
  const auto middle_of_ridge = [&](const Edges& edges) {  // along y on top at x = 0, with no end at a corner
    for (Index e = 0; e < edges.nodes.cols(); ++e) {
      const Vec3 at = 0.5 * (mesh.X.col(edges.nodes(0, e)) + mesh.X.col(edges.nodes(1, e)));
      if (at.x() == 0 && at.z() == 3 && std::abs(at.y() - 0.75) < 1e-9) return e;
    }
    return Index{-1};
  };
  for (const char* surface : {"box.skin", "box.z_high"}) {
    const Edges edges = edges_of(mesh, mesh::surface(mesh, surface), {});
    const Index e = middle_of_ridge(edges);
    ASSERT_GE(e, 0);
    EXPECT_NEAR(area_loaded(edges, mesh.X, e, -Vec3::UnitZ()), 0.125, 1e-15) << surface;
    EXPECT_EQ(area_loaded(edges, mesh.X, e, Vec3::UnitY()), edges.area(e)) << "no face looks that way";
    EXPECT_EQ(area_loaded(edges, mesh.X, e, Vec3(1, 0, -1).normalized()), edges.area(e)) << "both do, or the only one";
  }
  const Edges skin = edges_of(mesh, mesh::surface(mesh, "box.skin"), {});
  const Index e = middle_of_ridge(skin);
  EXPECT_NEAR(area_loaded(skin, mesh.X, e, -Vec3::UnitZ()) + area_loaded(skin, mesh.X, e, Vec3::UnitX()), skin.area(e), 1e-15);
}

TEST(EdgesOf, PlatesHaveRims) {
  const mesh::Mesh mesh = mesh::tube("tube", {1, 1, mesh::Revolution::full, 8, 5});
  const Edges edges = edges_of(mesh, mesh.surfaces[0], {});
  EXPECT_EQ(edges.of_plates.front(), 1);
  Index rims = 0;
  for (Index e = 0; e < edges.nodes.cols(); ++e) rims += edges.across(1, e) < 0;
  EXPECT_EQ(rims, 2 * 8 * 8);
  EXPECT_EQ(ridges(edges, mesh.X), rims);  // facets of 6 degrees are no ridges
}

TEST(IsRidge, FollowsTheShapeOfToday) {
  const mesh::Mesh mesh = box_with_skin({1, 2, 1});  // 1 x 2 x 3 m: the edge across the middle of its top
  const Edges edges = edges_of(mesh, mesh::surface(mesh, "box.z_high"), {});
  Vectors x = mesh.X;
  Index middle = -1;
  for (Index e = 0; e < edges.nodes.cols(); ++e)
    if (x(1, edges.nodes(0, e)) == 1 && x(1, edges.nodes(1, e)) == 1) middle = e;
  ASSERT_GE(middle, 0);
  const auto raised = [&](double angle) {
    for (int end = 0; end < 2; ++end) x(2, edges.nodes(end, middle)) = 3 + std::tan(angle / 2);
    return is_ridge(edges, x, middle);
  };
  EXPECT_FALSE(raised(0));
  EXPECT_FALSE(raised(0.3));
  EXPECT_TRUE(raised(0.4));
  EXPECT_FALSE(raised(-0.4));  // a valley
}

TEST(Rise, OfARightRidgeIsNoneInTheQuarterBetweenItsNormals) {
  const mesh::Mesh mesh = box_with_skin({1, 1, 1});
  const Edges edges = edges_of(mesh, mesh::surface(mesh, "box.skin"), {});
  Index ridge = -1;  // along y, at x = 1 and z = 3
  for (Index e = 0; e < edges.nodes.cols(); ++e) {
    const Vec3 middle = 0.5 * (mesh.X.col(edges.nodes(0, e)) + mesh.X.col(edges.nodes(1, e)));
    if ((middle - Vec3(1, 1, 3)).norm() < 1e-12) ridge = e;
  }
  ASSERT_GE(ridge, 0);
  const auto front = [&](double degrees, double tolerance) {
    const double a = degrees * std::acos(-1.0) / 180;
    return rise(Flanks(edges, mesh.X, ridge), {std::cos(a), 0, std::sin(a)}) <= tolerance;
  };
  EXPECT_TRUE(front(45, 0));
  EXPECT_TRUE(front(1, 0) && front(89, 0));
  EXPECT_FALSE(front(-1, 0) || front(91, 0) || front(225, 0));
  EXPECT_TRUE(front(-1, 0.05));
  EXPECT_FALSE(front(1, -0.05));
}

TEST(Into, AFaceIsThatOfTheMirrorInAMirror) {  // faces that are warped, which have no plane
  mesh::Mesh mesh = box_with_skin({2, 2, 2});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> aside(-0.2, 0.2);
  for (double& place : mesh.X.reshaped()) place += aside(random);
  mesh::Mesh mirror = mesh;
  mirror.X.row(0) *= -1;
  const auto& nodes = mesh.hexahedra[0].nodes;
  mirror.hexahedra[0].nodes << nodes.bottomRows(4), nodes.topRows(4);
  mirror.surfaces.back().facets = mesh::skin(mirror.X, mirror.hexahedra).facets;
  const Edges one = edges_of(mesh, mesh::surface(mesh, "box.skin"), {}), other = edges_of(mirror, mesh::surface(mirror, "box.skin"), {});
  ASSERT_EQ(one.nodes.cols(), other.nodes.cols());
  for (Index e = 0; e < one.nodes.cols(); ++e)
    for (int side = 0; side < 2; ++side) {
      const Vec3 way = into(one, mesh.X, e, side), there(-way.x(), way.y(), way.z());
      EXPECT_LT(std::min((into(other, mirror.X, e, 0) - there).norm(), (into(other, mirror.X, e, 1) - there).norm()), 1e-14) << e;
    }
}

}  // namespace
}  // namespace nereid::contact::edges_test
