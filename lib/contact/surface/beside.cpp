#include "contact/surface/beside.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <utility>

namespace nereid::contact {

namespace {

using Ways = std::vector<std::map<Index, double>>;  // [m] from each node along an edge to others

/// Nodes to which the way from one is no longer than a reach.
std::map<Index, double> reached(const Ways& ways, Index from, double reach) {
  std::map<Index, double> found;
  using Step = std::pair<double, Index>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> next;
  next.push({0, from});
  while (!next.empty()) {
    const auto [way, node] = next.top();
    next.pop();
    if (!found.try_emplace(node, way).second) continue;
    for (const auto& [other, length] : ways[static_cast<std::size_t>(node)])
      if (way + length <= reach) next.push({way + length, other});
  }
  return found;
}

}  // namespace

Beside find_beside(const Table<3>& facets, const Vectors& X, const Scalars& reach) {
  const auto nodes = static_cast<std::size_t>(X.cols());
  Ways ways(nodes);
  for (const auto& facet : facets.colwise())
    for (int e = 0; e < 3; ++e) {
      const Index a = facet(e), b = facet((e + 1) % 3);
      ways[static_cast<std::size_t>(a)][b] = ways[static_cast<std::size_t>(b)][a] = (X.col(a) - X.col(b)).norm();
    }
  std::vector<Index> begin{0};
  Subset all;
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto here = static_cast<Index>(node);
    if (!ways[node].empty()) {
      std::set<Index> beside;
      for (const auto& [near, way] : reached(ways, here, reach(here))) {
        beside.insert(near);
        for (const auto& [other, length] : ways[static_cast<std::size_t>(near)]) beside.insert(other);
      }
      all.insert(all.end(), beside.begin(), beside.end());
    }
    begin.push_back(static_cast<Index>(all.size()));
  }
  return {std::move(begin), std::move(all)};
}

bool is_beside(const Beside& beside, Index node, Index other) {
  if (beside.begin.empty()) return false;
  const auto first = beside.nodes.begin() + beside.begin[static_cast<std::size_t>(node)];
  return std::binary_search(first, beside.nodes.begin() + beside.begin[static_cast<std::size_t>(node) + 1], other);
}

}  // namespace nereid::contact
