#include "element/tiles.hpp"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace nereid::element {

namespace {

/// The lowest 21 bits of a, two zero bits after each.
std::uint64_t spread(std::uint64_t a) {
  a &= 0x1fffff;
  a = (a | a << 32) & 0x1f00000000ffff;
  a = (a | a << 16) & 0x1f0000ff0000ff;
  a = (a | a << 8) & 0x100f00f00f00f00f;
  a = (a | a << 4) & 0x10c30c30c30c30c3;
  return (a | a << 2) & 0x1249249249249249;
}

/// A place along one axis, from 0 to 21 bits of ones; NaN, as of infinite positions, counts as 0.
std::uint64_t bits(double slot) {
  constexpr std::uint64_t most = 0x1fffff;
  if (!(slot > 0)) return 0;
  return slot < most ? static_cast<std::uint64_t>(slot) : most;
}

/// Elements in the order of the Morton curve through their centres.
Subset space_filling_order(const Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>& nodes,
                           const Vectors& X) {
  Vectors centre = Vectors::Zero(3, nodes.cols());
  for (Index e = 0; e < nodes.cols(); ++e) {
    for (Index a = 0; a < nodes.rows(); ++a) centre.col(e) += X.col(nodes(a, e));
  }
  centre /= static_cast<double>(nodes.rows());
  const Vec3 low = centre.rowwise().minCoeff(), high = centre.rowwise().maxCoeff();
  const double extent = std::max((high - low).maxCoeff(), 1e-300);
  std::vector<std::uint64_t> key(nodes.cols());
  for (Index e = 0; e < nodes.cols(); ++e) {
    const Vec3 unit = (centre.col(e) - low) / extent * 0x1fffff;
    key[e] = spread(bits(unit.x())) | spread(bits(unit.y())) << 1 | spread(bits(unit.z())) << 2;
  }
  Subset order(nodes.cols());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key[a] < key[b]; });
  return order;
}

}  // namespace

Tiling cut_into_tiles(const Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>& nodes,
                      const Vectors& X, Index size) {
  const auto corners = static_cast<int>(nodes.rows());
  Tiling tiling{.nodes_per_element = corners, .elements = static_cast<Index>(nodes.cols()),
                .tiles = {}, .node = {}, .slot = {}, .element = {}, .filled = {}};
  const Subset order = space_filling_order(nodes, X);
  for (Index first = 0; first < tiling.elements; first += size) {
    const Index last = std::min(first + size, tiling.elements);
    Tile tile{.first_pack = static_cast<Index>(tiling.filled.size()), .packs = 0,
              .first_node = static_cast<Index>(tiling.node.size()), .nodes = 0};
    std::unordered_map<Index, Index> slot_of;
    for (Index begin = first; begin < last; begin += lanes) {
      tiling.filled.push_back(std::min<Index>(lanes, last - begin));
      const std::size_t at = tiling.slot.size();
      tiling.slot.resize(at + static_cast<std::size_t>(corners) * lanes);
      for (int lane = 0; lane < lanes; ++lane) {
        const Index element = order[std::min(begin + lane, last - 1)];
        tiling.element.push_back(element);
        for (int a = 0; a < corners; ++a) {
          const Index node = nodes(a, element);
          const auto [it, is_new] = slot_of.try_emplace(node, tile.nodes);
          if (is_new) {
            tiling.node.push_back(node);
            ++tile.nodes;
          }
          tiling.slot[at + static_cast<std::size_t>(a) * lanes + lane] = it->second;
        }
      }
      ++tile.packs;
    }
    tiling.tiles.push_back(tile);
  }
  return tiling;
}

}  // namespace nereid::element
