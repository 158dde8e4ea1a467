#include "element/tiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "mesh/box.hpp"

namespace nereid::element::tiles_test {
namespace {

struct Cut {
  mesh::Mesh mesh;
  Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic> nodes;
  Tiling tiling;
};

Cut cut(int nx, int ny, int nz, Index size = 128) {
  Cut c{mesh::box("box", {Vec3(0, 0, 0), Vec3(nx, ny, nz), {nx, ny, nz}}), {}, {}};
  c.nodes = c.mesh.hexahedra.front().nodes;
  c.tiling = cut_into_tiles(c.nodes, c.mesh.X, size);
  return c;
}

const std::array<std::array<int, 4>, 4> cases{
    {{1, 1, 1, 128}, {7, 5, 3, 20}, {8, 8, 8, 128}, {5, 5, 6, 128}}};

TEST(Tiles, HoldEachElementOnce) {
  for (const auto& [nx, ny, nz, size] : cases) {
    const Cut c = cut(nx, ny, nz, size);
    std::multiset<Index> seen;
    for (std::size_t pack = 0; pack < c.tiling.filled.size(); ++pack)
      for (int lane = 0; lane < c.tiling.filled[pack]; ++lane)
        seen.insert(c.tiling.element[pack * lanes + lane]);
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(nx * ny * nz));
    EXPECT_EQ((std::set<Index>(seen.begin(), seen.end()).size()), seen.size());
    EXPECT_EQ(c.tiling.elements, nx * ny * nz);
    EXPECT_EQ(c.tiling.nodes_per_element, 8);
  }
}

TEST(Tiles, AreNumberedWithoutGaps) {
  for (const auto& [nx, ny, nz, size] : cases) {
    const Tiling t = cut(nx, ny, nz, size).tiling;
    Index pack = 0, node = 0;
    for (const Tile& tile : t.tiles) {
      EXPECT_EQ(tile.first_pack, pack);
      EXPECT_EQ(tile.first_node, node);
      pack += tile.packs, node += tile.nodes;
      Index elements = 0;
      for (Index p = tile.first_pack; p < tile.first_pack + tile.packs; ++p)
        elements += t.filled[p];
      EXPECT_LE(elements, size);
    }
    EXPECT_EQ(pack, static_cast<Index>(t.filled.size()));
    EXPECT_EQ(node, static_cast<Index>(t.node.size()));
    EXPECT_EQ(t.element.size(), t.filled.size() * lanes);
    EXPECT_EQ(t.slot.size(), t.filled.size() * lanes * 8);
  }
}

TEST(Tiles, PlacesLeadToTheNodesOfTheElements) {
  for (const auto& [nx, ny, nz, size] : cases) {
    const Cut c = cut(nx, ny, nz, size);
    for (const Tile& tile : c.tiling.tiles) {
      std::set<Index> nodes(c.tiling.node.begin() + tile.first_node,
                            c.tiling.node.begin() + tile.first_node + tile.nodes);
      EXPECT_EQ(nodes.size(), static_cast<std::size_t>(tile.nodes))
          << "a node has one slot in a tile";
      for (Index pack = tile.first_pack; pack < tile.first_pack + tile.packs; ++pack) {
        for (int a = 0; a < 8; ++a) {
          for (int lane = 0; lane < lanes; ++lane) {
            const Index slot = c.tiling.slot[(pack * 8 + a) * lanes + lane];
            ASSERT_LT(slot, tile.nodes);
            EXPECT_EQ(c.tiling.node[tile.first_node + slot],
                      c.nodes(a, c.tiling.element[pack * lanes + lane]));
          }
        }
      }
    }
  }
}

TEST(Tiles, FillersRepeatTheLastElementOfTheirTile) {
  const Tiling t = cut(7, 5, 3, 21).tiling;
  for (const Tile& tile : t.tiles) {
    for (Index pack = tile.first_pack; pack < tile.first_pack + tile.packs; ++pack) {
      const int filled = t.filled[pack];
      EXPECT_GE(filled, 1);
      for (int lane = filled; lane < lanes; ++lane)
        EXPECT_EQ(t.element[pack * lanes + lane], t.element[pack * lanes + filled - 1]);
    }
  }
}

TEST(Tiles, AreCompactInSpace) {
  // 64 elements of a cube of 8^3 are one octant: 125 nodes, against 162 and more of a slab
  const Tiling t = cut(8, 8, 8, 64).tiling;
  for (const Tile& tile : t.tiles) EXPECT_EQ(tile.nodes, 125);
}

TEST(Tiles, OfPlacesThatAreNotFiniteHoldEachElementOnce) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double coordinate : {std::nan(""), inf, -inf, 1e308, -1e308}) {
    Cut c = cut(4, 3, 2, 20);
    c.mesh.X(1, 7) = coordinate;
    c.mesh.X(0, 20) = -coordinate;
    const Tiling t = cut_into_tiles(c.nodes, c.mesh.X, 20);
    std::multiset<Index> seen;
    for (std::size_t pack = 0; pack < t.filled.size(); ++pack)
      for (int lane = 0; lane < t.filled[pack]; ++lane) seen.insert(t.element[pack * lanes + lane]);
    EXPECT_EQ(seen.size(), 24U);
    EXPECT_EQ(std::set<Index>(seen.begin(), seen.end()).size(), 24U);
  }
}

}  // namespace
}  // namespace nereid::element::tiles_test
