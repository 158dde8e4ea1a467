#pragma once
// What lies around the facets of a surface: their neighbours, and their other sides where the surface has both.

#include <vector>

#include "mesh/mesh.hpp"

namespace nereid::mesh {

/// The same facets seen from both sides: first as they are, then reversed.
Table<3> both_sides(const Table<3>& facets);

/// Whether a surface goes on from facet to facet: each edge belongs to as many facets in one direction as in the other, or to one alone.
bool goes_on(const Table<3>& facets);

/// The facet on the same nodes as each, seen from the other side; -1 without one. [facets]
std::vector<Index> other_sides(const Table<3>& facets);

/// Whether any facet has its other side in the surface too, as on the skin of plates.
bool has_both_sides(const Table<3>& facets);

/// The facets across the edges 0-1, 1-2, 2-0 of each; -1 where the surface ends.
///
/// Where several meet at an edge, it is the first that one comes to around the edge in front of the facet; at the rim of a sheet with both
/// sides that is its own other side.
///
/// X  [m] reference positions
/// Throws InternalError unless the surface goes_on().
Table<3> neighbours(const Vectors& X, const Table<3>& facets);

}  // namespace nereid::mesh
