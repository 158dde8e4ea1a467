#pragma once
// Which edges are near each other.

#include <array>

#include "contact/data/workspace.hpp"

namespace nereid::contact {

inline Vec3 node_of(const Edges& edges, const Vectors& x, int end, Index edge) { return x.col(edges.nodes(end, edge)); }

/// Positions of both edges, less that of the first node, so that differences keep their digits.
inline std::array<Vector<double>, 4> ends_of(const EdgeContact& contact, const Vectors& x, Index edge, Index base_edge) {
  const Vec3 origin = node_of(contact.edges, x, 0, edge);
  std::array<Vector<double>, 4> ends;
  for (int i = 0; i < 4; ++i) {
    const Vec3 at = (i < 2 ? node_of(contact.edges, x, i, edge) : node_of(contact.base_edges, x, i - 2, base_edge)) - origin;
    ends[static_cast<std::size_t>(i)] = {at.x(), at.y(), at.z()};
  }
  return ends;
}

inline bool of_plates(const Edges& edges, Index edge) { return edges.of_plates[static_cast<std::size_t>(edge)] != 0; }

/// Lists the pairs of edges that are nearer than h_c and the margin, of which one at least is a ridge or a rim, or both turn on plates.
void search(const EdgeContact&, const Vectors& x, EdgeMemory&, EdgeWorkspace&);

/// Notes which bodies of an automatic contact have edges near those of another one, or near others of their own.
void keep_active(const EdgeContact&, EdgeMemory&);

inline bool has_near(const EdgeMemory& memory) { return !memory.edge_pairs.empty(); }

}  // namespace nereid::contact
