#include "element/node_sums.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/box.hpp"

namespace nereid::element::node_sums_test {
namespace {

TEST(NodeSums, AddEverySlotToItsNodeOnce) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3::Ones(), {4, 3, 2}});
  const Tiling tiling = cut_into_tiles(mesh.hexahedra[0].nodes, mesh.X, 5);  // many slots of some nodes
  const NodeSums sums = node_sums(tiling);
  Vectors of_slot(3, static_cast<Eigen::Index>(tiling.node.size()));
  for (Eigen::Index s = 0; s < of_slot.cols(); ++s) of_slot.col(s) = Vec3(1, s, mesh.X(0, tiling.node[s]));
  Vectors sum = Vectors::Constant(3, mesh.X.cols(), 100);  // added to what is there
  add_by_node(sums, of_slot, sum);
  Vectors expected = Vectors::Constant(3, mesh.X.cols(), 100);
  for (Eigen::Index s = 0; s < of_slot.cols(); ++s) expected.col(tiling.node[s]) += of_slot.col(s);
  EXPECT_EQ(sum, expected);
}

TEST(NodeSums, HaveEverySlotOnceTileByTile) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3::Ones(), {6, 5, 7}});
  const Tiling tiling = cut_into_tiles(mesh.hexahedra[0].nodes, mesh.X);
  ASSERT_GT(tiling.tiles.size(), 1u);
  const NodeSums sums = node_sums(tiling);
  EXPECT_TRUE(std::is_sorted(sums.node.begin(), sums.node.end()));
  std::vector<int> seen(tiling.node.size(), 0);
  for (std::size_t i = 0; i < sums.node.size(); ++i) {
    EXPECT_LT(sums.begin[i], sums.begin[i + 1]);
    for (Index s = sums.begin[i]; s < sums.begin[i + 1]; ++s) {
      ++seen[sums.slot[s]];
      EXPECT_EQ(tiling.node[sums.slot[s]], sums.node[i]);
      if (s > sums.begin[i]) {
        EXPECT_LT(sums.slot[s - 1], sums.slot[s]);
      }
    }
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
}

TEST(NodeSums, AddToTheColumnsThatNodesHave) {
  const mesh::Mesh mesh = mesh::box("box", {Vec3::Zero(), Vec3::Ones(), {1, 1, 1}});
  const Tiling tiling = cut_into_tiles(mesh.hexahedra[0].nodes, mesh.X);
  std::vector<Index> column(8);
  for (int n = 0; n < 8; ++n) column[n] = 7 - n;
  Vectors of_slot(3, 8), sum = Vectors::Zero(3, 8);
  for (int s = 0; s < 8; ++s) of_slot.col(s).setConstant(tiling.node[s]);
  add_by_node(node_sums(tiling), of_slot, column, sum);
  for (int n = 0; n < 8; ++n) EXPECT_EQ(sum(0, 7 - n), n);
}

}  // namespace
}  // namespace nereid::element::node_sums_test
