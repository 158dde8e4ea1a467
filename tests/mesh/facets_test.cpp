#include "mesh/facets.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <set>

#include "mesh/box.hpp"
#include "mesh/skin.hpp"

namespace nereid::mesh::facets_test {
namespace {

using Sorted = std::array<Index, 3>;

/// Facets as sets of nodes, each after `number` of them.
std::set<Sorted> as_sets(const Table<3>& facets, const std::vector<Index>& number) {
  std::set<Sorted> all;
  for (Index f = 0; f < facets.cols(); ++f) {
    Sorted one;
    for (int a = 0; a < 3; ++a) one[static_cast<std::size_t>(a)] = number[static_cast<std::size_t>(facets(a, f))];
    std::sort(one.begin(), one.end());
    all.insert(one);
  }
  return all;
}

std::vector<Index> as_they_are(const Mesh& mesh) {
  std::vector<Index> number(static_cast<std::size_t>(mesh.X.cols()));
  std::iota(number.begin(), number.end(), 0);
  return number;
}

/// The number of the node at each position, those of `images` against those of X.
std::vector<Index> nodes_at(const Vectors& X, const Vectors& images) {
  std::vector<Index> number(static_cast<std::size_t>(images.cols()));
  for (Index node = 0; node < images.cols(); ++node) {
    Eigen::Index nearest;
    (X.colwise() - images.col(node)).colwise().squaredNorm().minCoeff(&nearest);
    number[static_cast<std::size_t>(node)] = static_cast<Index>(nearest);
  }
  return number;
}

Mat3 some_turn() { return Eigen::Quaterniond(0.7, 0.3, -0.5, 0.4).normalized().toRotationMatrix(); }

TEST(CutOfFace, IsTheShorterDiagonalFromWhicheverCornerAndSide) {
  Vectors X(3, 4);
  X << 0, 1, 1.4, 0.1, /**/ 0, 0, 1, 0.9, /**/ 0, 0.2, 0, 0.1;  // 1 and 3 are nearer to one another than 0 and 2
  for (int from = 0; from < 4; ++from) {
    const Quadrilateral turned{(from + 0) % 4, (from + 1) % 4, (from + 2) % 4, (from + 3) % 4};
    const Quadrilateral seen_from_behind{turned[3], turned[2], turned[1], turned[0]};
    for (const Vec3& middle : {Vec3(0, 0, 0), Vec3(5, -3, 1)}) {
      EXPECT_EQ(cut_of_face(X, turned, middle), from % 2 == 0 ? Cut::second_to_fourth : Cut::first_to_third);
      EXPECT_EQ(cut_of_face(X, seen_from_behind, middle), from % 2 == 0 ? Cut::first_to_third : Cut::second_to_fourth);
    }
  }
}

TEST(CutOfFace, LiesInsideAFaceWithAReentrantCorner) {
  Vectors X(3, 4);
  X << 0, 1, 0.3, 0, /**/ 0, 0, 0.3, 1, /**/ 0, 0, 0, 0;
  EXPECT_EQ(cut_of_face(X, {0, 1, 2, 3}, Vec3::Zero()), Cut::first_to_third);
  X.col(2) << -0.1, -0.1, 0;  // the shortest diagonal of all, but for 1 to 3, which would lie outside too
  EXPECT_EQ(cut_of_face(X, {0, 1, 2, 3}, Vec3::Zero()), Cut::first_to_third);
  X.col(2) << 2, 0.05, 0;  // 1 is re-entrant, and 0 to 2 would pass outside
  X.col(1) << 1, 0.2, 0;
  EXPECT_EQ(cut_of_face(X, {0, 1, 2, 3}, Vec3::Zero()), Cut::second_to_fourth);
}

TEST(CutOfFace, DoesNotSeeNumbersOfNodesElementsAndCorners) {
  constexpr int turned[3][8] = {{0, 1, 2, 3, 4, 5, 6, 7}, {1, 2, 3, 0, 5, 6, 7, 4}, {4, 5, 1, 0, 7, 6, 2, 3}};
  std::srand(5);
  for (const double jitter : {0.0, 0.1}) {  // all diagonals alike, all different
    Mesh mesh = box("a", {Vec3(0.1, 0, -3), Vec3(3.1, 3, 0), {3, 3, 3}});
    mesh.X += jitter * Vectors::Random(3, mesh.X.cols());
    const auto before = as_sets(skin(mesh.X, mesh.hexahedra).facets, as_they_are(mesh));
    std::vector<Index> old = as_they_are(mesh);
    for (std::size_t node = 0; node < old.size(); ++node) std::swap(old[node], old[static_cast<std::size_t>(std::rand()) % old.size()]);
    std::vector<Index> now(old.size());
    for (std::size_t node = 0; node < old.size(); ++node) now[static_cast<std::size_t>(old[node])] = static_cast<Index>(node);
    Vectors X(3, mesh.X.cols());
    for (Index node = 0; node < X.cols(); ++node) X.col(node) = mesh.X.col(old[static_cast<std::size_t>(node)]);
    Table<8> nodes = mesh.hexahedra[0].nodes.rowwise().reverse();
    for (Index e = 0; e < nodes.cols(); ++e) {
      const Eigen::Matrix<Index, 8, 1> corners = nodes.col(e);
      for (int a = 0; a < 8; ++a) nodes(a, e) = now[static_cast<std::size_t>(corners(turned[e % 3][a]))];
    }
    EXPECT_EQ(as_sets(skin(X, {{"a", nodes}}).facets, old), before);
  }
}

TEST(CutOfFace, IsSymmetricAsTheBodyIsAndTurnsWithIt) {
  const Mesh mesh = box("a", {Vec3(-1, -1, -2), Vec3(1, 1, 2), {4, 4, 6}});
  const Table<3> all = skin(mesh.X, mesh.hexahedra).facets;
  const auto facets = as_sets(all, as_they_are(mesh));
  for (int axis = 0; axis < 3; ++axis) {
    Vectors image = mesh.X;
    image.row(axis) *= -1;
    EXPECT_EQ(as_sets(all, nodes_at(mesh.X, image)), facets);
  }
  Vectors quarter(3, mesh.X.cols());
  quarter << -mesh.X.row(1), mesh.X.row(0), mesh.X.row(2);
  EXPECT_EQ(as_sets(all, nodes_at(mesh.X, quarter)), facets);
  const Vectors anywhere = (some_turn() * mesh.X).colwise() + Vec3(20, -7, 3);
  EXPECT_EQ(as_sets(skin(anywhere, mesh.hexahedra).facets, as_they_are(mesh)), facets);
}

TEST(CutOfFace, LeavesSixFacetsAtNodesInsideAPlaneFace) {
  const Mesh mesh = box("a", {Vec3::Zero(), Vec3(1, 1, 1), {4, 4, 4}});
  std::vector<int> count(static_cast<std::size_t>(mesh.X.cols()), 0);
  const Table<3> facets = skin(mesh.X, mesh.hexahedra).facets;
  for (Index f = 0; f < facets.cols(); ++f) {
    const Eigen::Matrix<Index, 3, 1> facet = facets.col(f);
    const bool on_top = std::all_of(facet.begin(), facet.end(), [&](Index node) { return mesh.X(2, node) == 1; });
    for (const Index node : facet) count[static_cast<std::size_t>(node)] += on_top;
  }
  for (Index node = 0; node < mesh.X.cols(); ++node) {
    const Vec3 at = mesh.X.col(node);
    if (at.z() < 1 || std::max(std::abs(at.x() - 0.5), std::abs(at.y() - 0.5)) > 0.3) continue;
    const bool centre = at.x() == 0.5 && at.y() == 0.5;
    EXPECT_EQ(count[static_cast<std::size_t>(node)], centre ? 8 : 6);
  }
}

}  // namespace
}  // namespace nereid::mesh::facets_test
