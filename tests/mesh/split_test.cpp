#include "mesh/split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/check.hpp"
#include "mesh/box.hpp"
#include "mesh/cylinder.hpp"
#include "mesh/disc.hpp"
#include "mesh/facets.hpp"
#include "mesh/judge.hpp"
#include "mesh/skin.hpp"
#include "mesh/sphere.hpp"
#include "mesh/wedge.hpp"

namespace nereid::mesh::split_test {
namespace {

Mesh brick(int x = 2, int y = 2, int z = 2) { return box("b", {Vec3::Zero(), Vec3(x, y, z), {x, y, z}}); }

/// A brick whose inner and outer nodes are moved by a smooth field, so that no face is flat.
Mesh warped() {
  Mesh mesh = brick(3, 3, 3);
  for (auto x : mesh.X.colwise()) x += 0.1 * Vec3(std::sin(2 * x.y() + x.z()), std::cos(x.x() * 1.5 + x.z()), std::sin(x.x() + 3 * x.y()));
  return mesh;
}

std::vector<Mesh> solids() {
  return {brick(), warped(), cylinder("b", {0.3, 0.7, Revolution::full, 3, 2, 4}), sphere("b", {1, SpherePart::full, 2, 2}),
          wedge("b", {0.3, 0.5, 0.2, 2, 3, 2})};  // wedges at its axis
}

std::vector<Mesh> plates() {
  return {tube("b", {1, 1, Revolution::full, 2, 2}), disc("b", {1, Revolution::full, 2, 2}), sheet("b", {3, 2, 3, 2, Cuts::crossed})};
}

Eigen::Index elements(const Mesh& mesh) {
  Eigen::Index count = 0;
  for (const auto& region : mesh.hexahedra) count += region.nodes.cols();
  for (const auto& region : mesh.triangles) count += region.nodes.cols();
  return count;
}

TEST(Split, KeepsTheVolumeOfEveryElement) {
  for (const Mesh& mesh : solids()) {
    const Split fine = split(mesh, 2);
    ASSERT_EQ(elements(fine.mesh), 8 * elements(mesh));
    const Scalars before = volumes(mesh, mesh.hexahedra[0]), after = volumes(fine.mesh, fine.mesh.hexahedra[0]);
    Scalars sum = Scalars::Zero(before.size());
    for (Index e = 0; e < after.size(); ++e) sum(fine.parents[static_cast<std::size_t>(e)]) += after(e);
    EXPECT_LT((sum - before).cwiseAbs().maxCoeff(), 1e-13 * before.maxCoeff());
    EXPECT_GT(after.minCoeff(), 0);
  }
}

TEST(Split, KeepsTheAreaOfEveryTriangle) {
  for (const Mesh& mesh : plates()) {
    const Split fine = split(mesh, 4);
    ASSERT_EQ(elements(fine.mesh), 16 * elements(mesh));
    const Scalars before = facet_areas(mesh, {"", mesh.triangles[0].nodes});
    const Scalars after = facet_areas(fine.mesh, {"", fine.mesh.triangles[0].nodes});
    for (Index e = 0; e < after.size(); ++e)
      EXPECT_NEAR(after(e), before(fine.parents[static_cast<std::size_t>(e)]) / 16, 1e-14);
  }
}

TEST(Split, OfABoxIsTheBoxWithTwiceTheCells) {
  const Mesh fine = split(brick(2, 3, 1), 2).mesh, wanted = box("b", {Vec3::Zero(), Vec3(2, 3, 1), {4, 6, 2}});
  EXPECT_EQ(fine.X.cols(), wanted.X.cols());
  ASSERT_EQ(fine.node_sets.size(), wanted.node_sets.size());
  ASSERT_EQ(fine.surfaces.size(), wanted.surfaces.size());
  for (const NodeSet& set : wanted.node_sets) {
    EXPECT_EQ(node_set(fine, set.name).size(), set.nodes.size()) << set.name;
    EXPECT_TRUE(std::is_sorted(node_set(fine, set.name).begin(), node_set(fine, set.name).end()));
  }
  for (const Surface& one : wanted.surfaces) {
    EXPECT_EQ(surface(fine, one.name).facets.cols(), one.facets.cols()) << one.name;
    EXPECT_NEAR(facet_areas(fine, surface(fine, one.name)).sum(), facet_areas(wanted, one).sum(), 1e-12);
    EXPECT_EQ(faces(fine, surface(fine, one.name)).cols(), one.facets.cols() / 2) << "both halves of every face";
  }
}

TEST(Split, HasNoHangingNodesAndNothingThatAJudgeRefuses) {
  for (const Mesh& mesh : solids()) {
    const Mesh fine = split(mesh, 2).mesh;
    const Skin before = skin(mesh.X, mesh.hexahedra), after = skin(fine.X, fine.hexahedra);
    EXPECT_EQ(after.facets.cols(), 4 * before.facets.cols());
    EXPECT_EQ(after.crowded, 0);
    EXPECT_TRUE(judge(fine).empty());
  }
  for (const Mesh& mesh : plates()) EXPECT_TRUE(judge(split(mesh, 4).mesh).empty());
}

TEST(Split, KeepsWhatIsAffine) {
  const Mat3 stretch{{1.3, 0.2, 0.1}, {-0.4, 0.9, 0.3}, {0.2, -0.1, 1.1}};
  for (const Mesh& mesh : solids()) {
    Mesh stretched = mesh;
    stretched.X = stretch * mesh.X;
    EXPECT_LT((split(stretched, 2).mesh.X - stretch * split(mesh, 2).mesh.X).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(Split, ByFourIsTwiceByTwo) {
  for (const Mesh& mesh : solids()) {
    const Split once = split(mesh, 2), twice = split(once.mesh, 2), four = split(mesh, 4);
    EXPECT_EQ(four.mesh.X, twice.mesh.X);
    EXPECT_EQ(four.mesh.hexahedra[0].nodes, twice.mesh.hexahedra[0].nodes);
    for (std::size_t e = 0; e < four.parents.size(); ++e)
      EXPECT_EQ(four.parents[e], once.parents[static_cast<std::size_t>(twice.parents[e])]);
  }
  EXPECT_EQ(split(brick(), 1).mesh.X, brick().X);
  EXPECT_THROW(split(brick(), 3), InternalError);
}

/// Two cubes side by side, each a region of its own, that share the nodes between them.
Mesh two_regions() {
  Mesh mesh = brick(2, 1, 1);
  const Table<8> nodes = mesh.hexahedra[0].nodes;
  mesh.hexahedra = {{"b.left", nodes.col(0)}, {"b.right", nodes.col(1)}};
  for (const auto& region : mesh.hexahedra) {
    Subset used(region.nodes.data(), region.nodes.data() + 8);
    std::sort(used.begin(), used.end());
    mesh.node_sets.push_back({region.name, used});
  }
  return mesh;
}

TEST(Split, RegionsKeepTheNodesThatTheyShareAndHaveTheirOwn) {
  const Mesh fine = split(two_regions(), 2).mesh;
  EXPECT_EQ(fine.X.cols(), 5 * 3 * 3);
  const Subset &left = node_set(fine, "b.left"), &right = node_set(fine, "b.right");
  EXPECT_EQ(left.size(), 27U);
  Subset both;
  std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
  EXPECT_EQ(both.size(), 9U);
}

using Place = std::array<double, 3>;
Place place(const Mesh& mesh, Index node) { return {mesh.X(0, node), mesh.X(1, node), mesh.X(2, node)}; }

/// Elements as sets of places, which numbers do not change.
std::multiset<std::set<Place>> shapes(const Mesh& mesh) {
  std::multiset<std::set<Place>> all;
  for (const auto& nodes : mesh.hexahedra[0].nodes.colwise()) {
    std::set<Place> one;
    for (const Index node : nodes) one.insert(place(mesh, node));
    all.insert(one);
  }
  return all;
}

TEST(Split, DoesNotDependOnNumbers) {
  for (const Mesh& mesh : {brick(), wedge("b", {0.25, 0.5, 0.25, 2, 3, 2})}) {  // coordinates whose sums are exact, or of a few numbers
    std::vector<Index> number(static_cast<std::size_t>(mesh.X.cols()));
    for (std::size_t n = 0; n < number.size(); ++n) number[n] = static_cast<Index>(n);
    std::shuffle(number.begin(), number.end(), std::mt19937(3));
    Mesh other = mesh;
    other.surfaces.clear(), other.node_sets.clear();
    for (std::size_t n = 0; n < number.size(); ++n) other.X.col(number[n]) = mesh.X.col(static_cast<Index>(n));
    Table<8>& nodes = other.hexahedra[0].nodes;
    for (Index& node : nodes.reshaped()) node = number[static_cast<std::size_t>(node)];
    nodes = nodes.rowwise().reverse().eval();
    Mesh a = split(mesh, 2).mesh, b = split(other, 2).mesh;
    for (Mesh* one : {&a, &b}) one->X = (one->X * 1e9).array().round() / 1e9;  // the order of a sum may change its last digit
    EXPECT_EQ(shapes(a), shapes(b));
  }
}

TEST(Split, PlatesOnSolidsKeepTheNodesOfTheirFaces) {
  for (Mesh mesh : solids()) {
    const Eigen::Index alone = split(mesh, 2).mesh.X.cols();
    mesh.triangles.push_back({"b.plates", skin(mesh.X, mesh.hexahedra).facets});
    const Mesh fine = split(mesh, 2).mesh;
    EXPECT_EQ(fine.X.cols(), alone);
    const Skin under = skin(fine.X, fine.hexahedra);
    const Surface over{"", fine.triangles[0].nodes};
    EXPECT_EQ(over.facets.cols(), under.facets.cols());
    EXPECT_EQ(faces(fine, over).cols(), faces(fine, {"", under.facets}).cols());
    EXPECT_TRUE(judge(fine).empty());
  }
}

TEST(Split, TheRimOfAPlateStaysItsRim) {
  Mesh mesh = sheet("b", {3, 2, 3, 2, Cuts::crossed});
  const auto on_rim = [](const auto& x) { return x.x() == 0 || x.x() == 3 || x.y() == 0 || x.y() == 2; };
  const auto rim_of = [&](const Mesh& one) {
    Subset nodes;
    for (Index n = 0; n < one.X.cols(); ++n)
      if (on_rim(one.X.col(n))) nodes.push_back(n);
    return nodes;
  };
  mesh.node_sets.push_back({"b.rim", rim_of(mesh)});
  for (const int factor : {2, 4}) {
    const Mesh fine = split(mesh, factor).mesh;
    EXPECT_EQ(node_set(fine, "b.rim"), rim_of(fine)) << "no corner is cut off";
  }
}

TEST(Split, ASetOfCellsHasWhatIsWithinThem) {
  Mesh mesh = brick(3, 2, 2);
  Subset left;
  for (Index n = 0; n < mesh.X.cols(); ++n)
    if (mesh.X(0, n) < 1.5) left.push_back(n);
  mesh.node_sets.push_back({"b.left", left});
  mesh.node_sets.push_back({"b.one", {5}});
  const Mesh fine = split(mesh, 2).mesh;
  EXPECT_EQ(node_set(fine, "b.left").size(), 3U * 5 * 5);
  EXPECT_EQ(node_set(fine, "b.one"), Subset{5}) << "a point stays one";
}

TEST(Split, RefusesWhatItCannotSplitByNumber) {
  Mesh tetrahedron = brick(2, 1, 1);
  auto corners = tetrahedron.hexahedra[0].nodes.col(1);
  corners(3) = corners(2), corners(5) = corners(6) = corners(7) = corners(4);
  EXPECT_EQ(split(tetrahedron, 2).refused, std::vector<Index>{1});
  EXPECT_EQ(split(tetrahedron, 2).mesh.X.cols(), 0);
  Mesh seven = brick(2, 1, 1);
  seven.hexahedra[0].nodes(3, 0) = seven.hexahedra[0].nodes(2, 0);
  EXPECT_EQ(split(seven, 4).refused, std::vector<Index>{0});
}

TEST(Split, RefusesAFaceWithTheEdgeOfAnotherElementAcross) {
  Mesh mesh = brick(1, 1, 2);  // the upper cell becomes two wedges that part along the diagonal of the face below
  const auto c = Eigen::Matrix<Index, 8, 1>(mesh.hexahedra[0].nodes.col(1));
  Table<8> nodes(8, 3);
  nodes.col(0) = mesh.hexahedra[0].nodes.col(0);
  nodes.col(1) << c(0), c(1), c(2), c(2), c(4), c(5), c(6), c(6);
  nodes.col(2) << c(2), c(3), c(0), c(0), c(6), c(7), c(4), c(4);
  mesh.hexahedra[0].nodes = nodes;
  EXPECT_EQ(split(mesh, 2).refused, std::vector<Index>{0});
}

TEST(Split, WedgesMayBeCountedFromAnyCorner) {
  const Mesh mesh = wedge("b", {0.3, 0.5, 0.2, 2, 3, 2});
  Mesh turned = mesh;
  const int turns[][8] = {{1, 2, 3, 0, 5, 6, 7, 4}, {3, 2, 6, 7, 0, 1, 5, 4}, {4, 7, 6, 5, 0, 3, 2, 1}};
  Table<8>& nodes = turned.hexahedra[0].nodes;
  for (Index e = 0; e < nodes.cols(); ++e) {
    const Eigen::Matrix<Index, 8, 1> before = nodes.col(e);
    for (int a = 0; a < 8; ++a) nodes(a, e) = before(turns[e % 3][a]);
  }
  const Split fine = split(turned, 2);
  EXPECT_EQ(fine.refused, std::vector<Index>{});
  EXPECT_TRUE(judge(fine.mesh).empty());
  EXPECT_EQ(shapes(fine.mesh).size(), shapes(split(mesh, 2).mesh).size());
  EXPECT_NEAR(volumes(fine.mesh, fine.mesh.hexahedra[0]).sum(), volumes(mesh, mesh.hexahedra[0]).sum(), 1e-14);
}

}  // namespace
}  // namespace nereid::mesh::split_test
