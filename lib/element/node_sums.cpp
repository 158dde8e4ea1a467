#include "element/node_sums.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace nereid::element {

namespace {

constexpr Index grain = 2000;  // nodes worth a thread of their own

template <class ColumnOf>
void add(const NodeSums& sums, const Vectors& of_slot, Vectors& to, ColumnOf&& column_of) {
  parallel_for(static_cast<Index>(sums.node.size()), grain, [&](Index i) {
    auto column = to.col(column_of(sums.node[i]));
    Vec3 sum = column;
    for (Index s = sums.begin[i]; s < sums.begin[i + 1]; ++s) sum += of_slot.col(sums.slot[s]);
    column = sum;
  });
}

}  // namespace

NodeSums node_sums(const Tiling& tiling) {
  NodeSums sums;
  sums.node = tiling.node;
  std::sort(sums.node.begin(), sums.node.end());
  sums.node.erase(std::unique(sums.node.begin(), sums.node.end()), sums.node.end());
  const auto at = [&](Index node) { return std::lower_bound(sums.node.begin(), sums.node.end(), node) - sums.node.begin(); };
  sums.begin.assign(sums.node.size() + 1, 0);
  for (const Index node : tiling.node) ++sums.begin[at(node) + 1];
  for (std::size_t i = 0; i < sums.node.size(); ++i) sums.begin[i + 1] += sums.begin[i];
  sums.slot.resize(tiling.node.size());
  std::vector<Index> next(sums.begin.begin(), sums.begin.end() - 1);
  for (std::size_t s = 0; s < tiling.node.size(); ++s) sums.slot[next[at(tiling.node[s])]++] = static_cast<Index>(s);
  return sums;
}

void add_by_node(const NodeSums& sums, const Vectors& of_slot, Vectors& to) {
  add(sums, of_slot, to, [](Index node) { return node; });
}

void add_by_node(const NodeSums& sums, const Vectors& of_slot, const std::vector<Index>& column_of_node, Vectors& to) {
  add(sums, of_slot, to, [&](Index node) { return column_of_node[node]; });
}

}  // namespace nereid::element
