#pragma once
// What an apex does not touch on its own body: what is beside it in the mesh.

#include <vector>

#include "base/types.hpp"

namespace nereid::contact {

/// Which nodes of a surface are beside each other in the mesh: an apex touches no facet that has a node beside it, wherever this is now.
/// Empty where no body touches itself.
struct Beside {
  std::vector<Index> begin;  ///< [nodes of the mesh + 1]
  Subset nodes;              ///< beside each node, ascending, with itself
};

/// Finds the nodes beside each node: those to which the way along the edges of facets is no longer than a reach, and all that share a
/// facet with one of these.
///
/// X      [m] reference positions of all nodes of the mesh
/// reach  [m] [nodes]
Beside find_beside(const Table<3>& facets, const Vectors& X, const Scalars& reach);

/// Whether a node is beside another one, or the same.
bool is_beside(const Beside&, Index node, Index other);

}  // namespace nereid::contact
