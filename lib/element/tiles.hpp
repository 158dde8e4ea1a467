#pragma once
// Tiles: elements that are neighbours in space, cut from a block once.
//
// A tile gathers its nodes, works pack by pack on its elements, and sums into a force array of its
// own; nodes shared between tiles are summed afterwards in a fixed order (gather in dynamics/step.cpp).
// So the working set stays in cache and any number of threads gives the same bits.

#include "base/number.hpp"
#include "base/types.hpp"

namespace nereid::element {

struct Tile {
  Index first_pack, packs;  ///< this tile's packs of elements
  Index first_node, nodes;  ///< this tile's slots in Tiling::node and in the tile forces
};

struct Tiling {
  int nodes_per_element = 0;
  Index elements = 0;
  std::vector<Tile> tiles;
  Subset node;                 ///< node of each slot, tile after tile
  std::vector<Index> slot;     ///< [packs x nodes per element x lanes] slot within the tile
  std::vector<Index> element;  ///< [packs x lanes] element in each lane; a filler repeats the last one
  std::vector<int> filled;     ///< [packs] lanes that hold an element of their own
};

/// Cuts elements into tiles of about `size` elements along a space-filling (Morton) curve.
///
/// nodes  [nodes per element x elements]
/// X      [m] reference positions, [3 x nodes]
Tiling cut_into_tiles(const Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>& nodes,
                      const Vectors& X, Index size = 128);

}  // namespace nereid::element
