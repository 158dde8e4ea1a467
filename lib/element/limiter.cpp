#include "element/limiter.hpp"

#include <algorithm>
#include <array>

#include "base/parallel.hpp"

namespace nereid::element {

namespace {

using Face = std::array<Index, 4>;  // nodes, ascending; -1 of a side with fewer

/// Local nodes around each side of an element of so many nodes; in the order of VTK.
const std::vector<std::vector<int>>& sides_of(int nodes) {
  static const std::vector<std::vector<int>> hexahedron{{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
  static const std::vector<std::vector<int>> triangle{{0, 1}, {1, 2}, {2, 0}};
  return nodes == 8 ? hexahedron : triangle;
}

/// A side of an element in the order of the tiles.
struct Side {
  Face face;
  Index place;   // of its axis
  Index at;      // in the table of sides
};

/// The face of a side, or all -1 if it has collapsed: no two nodes are left of an edge, or no three of a face.
Face face_of(const std::vector<int>& corners, const Index* element) {
  Face face{-1, -1, -1, -1};
  std::array<Index, 4> own{};
  std::size_t count = 0;
  for (const int corner : corners) own[count++] = element[corner];
  std::sort(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(count));
  const auto end = std::unique(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(count));
  if (end - own.begin() < (corners.size() == 2 ? 2 : 3)) return face;
  std::copy(own.begin(), end, face.begin());
  return face;
}

template <int axes, int sides>
void departures_of(const Tile& tile, const std::vector<Index>& beside, const std::vector<double>& along, std::vector<double>& own) {
  constexpr int of_axis = sides / axes;
  for (auto pack = static_cast<std::size_t>(tile.first_pack); pack < static_cast<std::size_t>(tile.first_pack + tile.packs); ++pack) {
    const Index* at = beside.data() + pack * sides * lanes;
    for (int k = 0; k < axes; ++k) {
      const std::size_t here = (pack * axes + static_cast<std::size_t>(k)) * lanes;
      Pack e;
      read_lanes(along.data() + here, e);
      const Pack sign = select(e < Pack(0.0), Pack(-1.0), Pack(1.0));
      Pack sum(0.0), least(1e300);
      for (int s = k * of_axis; s < (k + 1) * of_axis; ++s) {
        const Pack other = sign * gather_numbers(along.data(), at + s * lanes);
        sum = sum + other, least = smaller(least, other);
      }
      write_lanes(departure(sign * e, Pack(1.0 / of_axis) * sum, least), own.data() + here);
    }
  }
}

}  // namespace

std::vector<Index> places_beside(const Tiling& tiling, const Eigen::Matrix<Index, Eigen::Dynamic, Eigen::Dynamic>& nodes) {
  const auto& corners = sides_of(static_cast<int>(nodes.rows()));
  const auto sides = static_cast<Index>(corners.size()), axes = nodes.rows() == 8 ? Index(3) : Index(1), of_axis = sides / axes;
  std::vector<Index> beside(tiling.filled.size() * static_cast<std::size_t>(sides) * lanes);
  std::vector<Side> all;
  all.reserve(static_cast<std::size_t>(tiling.elements * sides));
  for (Index pack = 0; pack < static_cast<Index>(tiling.filled.size()); ++pack) {
    for (Index lane = 0; lane < lanes; ++lane) {
      const bool is_own = lane < tiling.filled[static_cast<std::size_t>(pack)];
      const Index element = tiling.element[static_cast<std::size_t>(pack * lanes + lane)];
      for (Index s = 0; s < sides; ++s) {
        const Index at = (pack * sides + s) * lanes + lane, place = (pack * axes + s / of_axis) * lanes + lane;
        beside[static_cast<std::size_t>(at)] = place;
        const Face face = face_of(corners[static_cast<std::size_t>(s)], nodes.col(element).data());
        if (is_own && face[0] >= 0) all.push_back({face, place, at});
      }
    }
  }
  std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) { return std::pair(a.face, a.at) < std::pair(b.face, b.at); });
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    while (last < all.size() && all[last].face == all[first].face) ++last;
    if (last - first != 2) continue;
    beside[static_cast<std::size_t>(all[first].at)] = all[first + 1].place;
    beside[static_cast<std::size_t>(all[first + 1].at)] = all[first].place;
  }
  return beside;
}

Departures departures_for(const Tiling& tiling, bool is_viscous) {
  if (!is_viscous) return {};
  const bool is_solid = tiling.nodes_per_element == 8;
  const std::size_t count = tiling.filled.size() * (is_solid ? 3 : 1) * lanes;
  return {.own = std::vector<double>(is_solid ? 0 : count), .spread = std::vector<double>(count)};
}

void find_departures(const Tiling& tiling, const std::vector<Index>& beside, const std::vector<double>& along, Departures& found) {
  const auto each_tile = [&](auto&& visit) {
    parallel_for(static_cast<Index>(tiling.tiles.size()), 8, [&](Index t) { visit(tiling.tiles[static_cast<std::size_t>(t)]); });
  };
  if (tiling.nodes_per_element == 8) {
    each_tile([&](const Tile& tile) { departures_of<3, 6>(tile, beside, along, found.spread); });
    return;
  }
  each_tile([&](const Tile& tile) { departures_of<1, 3>(tile, beside, along, found.own); });
  each_tile([&](const Tile& tile) {
    for (auto pack = static_cast<std::size_t>(tile.first_pack); pack < static_cast<std::size_t>(tile.first_pack + tile.packs); ++pack) {
      const auto most = shares_of<1, 3>(found.own.data(), pack, beside.data() + pack * 3 * lanes);
      write_lanes(most[0], found.spread.data() + pack * lanes);
    }
  });
}

}  // namespace nereid::element
