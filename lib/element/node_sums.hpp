#pragma once
// Sums by node of what tiles keep slot by slot, in an order that no number of threads changes.

#include "base/types.hpp"
#include "element/tiles.hpp"

namespace nereid::element {

/// Which slots of a block's tiles belong to each node.
struct NodeSums {
  Subset node;               ///< nodes of the block, ascending
  std::vector<Index> begin;  ///< [nodes of the block + 1] in `slot`
  std::vector<Index> slot;
};

NodeSums node_sums(const Tiling&);

/// Adds the values of all slots to their nodes, node by node and slot by slot.
///
/// of_slot  [3 x slots];  to  [3 x nodes], or with `column_of_node` [3 x columns]
void add_by_node(const NodeSums&, const Vectors& of_slot, Vectors& to);
void add_by_node(const NodeSums&, const Vectors& of_slot, const std::vector<Index>& column_of_node, Vectors& to);

}  // namespace nereid::element
