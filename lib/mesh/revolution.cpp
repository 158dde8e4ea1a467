#include "mesh/revolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/check.hpp"
#include "mesh/facets.hpp"

namespace nereid::mesh {
namespace {

/// The image of an element has its first side reversed, and so its volume or normal right again.
template <int rows>
constexpr std::array<int, rows> image_order();
template <>
constexpr std::array<int, 8> image_order<8>() {
  return {1, 0, 3, 2, 5, 4, 7, 6};
}
template <>
constexpr std::array<int, 3> image_order<3>() {
  return {1, 0, 2};
}

template <int rows>
Table<rows> with_image(const Table<rows>& nodes, const std::vector<Index>& image_of) {
  constexpr auto order = image_order<rows>();
  Table<rows> both(rows, 2 * nodes.cols());
  both.leftCols(nodes.cols()) = nodes;
  for (Index column = 0; column < nodes.cols(); ++column) {
    for (int a = 0; a < rows; ++a) {
      both(a, 2 * nodes.cols() - 1 - column) = image_of[nodes(order[a], column)];
    }
  }
  return both;
}

/// The places 0, 1, ... in ascending order of their keys, equal keys in the order they had.
std::vector<Index> sorted_places(const Scalars& keys) {
  std::vector<Index> places(static_cast<std::size_t>(keys.size()));
  std::iota(places.begin(), places.end(), 0);
  std::stable_sort(places.begin(), places.end(),
                   [&](Index left, Index right) { return keys(left) < keys(right); });
  return places;
}

/// `columns` sorted by their lowest node, with nodes renumbered.
template <int rows>
Table<rows> in_layers(const Table<rows>& columns, const Vectors& X,
                      const std::vector<Index>& new_number) {
  Scalars lowest(columns.cols());
  for (Index column = 0; column < columns.cols(); ++column) {
    lowest(column) = X(2, columns(0, column));
    for (const Index node : columns.col(column))
      lowest(column) = std::min(lowest(column), X(2, node));
  }
  const std::vector<Index> order = sorted_places(lowest);
  Table<rows> sorted(rows, columns.cols());
  for (Index column = 0; column < columns.cols(); ++column) {
    for (int a = 0; a < rows; ++a) sorted(a, column) = new_number[columns(a, order[column])];
  }
  return sorted;
}

}  // namespace

Eigen::Vector2d direction(int around, int cells_core) {
  if (around > cells_core) return direction(2 * cells_core - around, cells_core).reverse();
  if (around == cells_core) return Eigen::Vector2d::Constant(std::sqrt(0.5));
  const double angle = around * pi / (4 * cells_core);
  return {std::cos(angle), std::sin(angle)};
}

double height(int along, int cells_along, double length) {
  return length * (static_cast<double>(along) / cells_along);
}

Mesh with_image(const Mesh& half, int axis) {
  check(half.node_sets.empty(), "with_image: node sets are added afterwards");
  std::vector<Index> image_of(static_cast<std::size_t>(half.X.cols()));
  Index count = static_cast<Index>(half.X.cols());
  Mesh both;
  both.X.resize(3, 2 * half.X.cols());
  both.X.leftCols(half.X.cols()) = half.X;
  for (Index node = static_cast<Index>(half.X.cols()) - 1; node >= 0; --node) {
    image_of[node] = half.X(axis, node) == 0 ? node : count++;
    both.X.col(image_of[node]) = half.X.col(node);
    if (image_of[node] != node) both.X(axis, image_of[node]) = -half.X(axis, node);
  }
  both.X.conservativeResize(3, count);
  for (const auto& [name, nodes] : half.hexahedra)
    both.hexahedra.push_back({name, with_image(nodes, image_of)});
  for (const auto& [name, nodes] : half.triangles)
    both.triangles.push_back({name, with_image(nodes, image_of)});
  for (const auto& [name, facets] : half.surfaces)
    both.surfaces.push_back({name, with_image(facets, image_of)});
  return both;
}

Mesh in_layers(const Mesh& mesh) {
  check(mesh.node_sets.empty(), "in_layers: node sets are added afterwards");
  const std::vector<Index> order = sorted_places(mesh.X.row(2));
  std::vector<Index> new_number(order.size());
  Mesh sorted = mesh;
  for (std::size_t node = 0; node < order.size(); ++node) {
    new_number[order[node]] = static_cast<Index>(node);
    sorted.X.col(static_cast<Index>(node)) = mesh.X.col(order[node]);
  }
  for (auto& [name, nodes] : sorted.hexahedra) nodes = in_layers(nodes, mesh.X, new_number);
  for (auto& [name, nodes] : sorted.triangles) nodes = in_layers(nodes, mesh.X, new_number);
  for (auto& [name, facets] : sorted.surfaces) facets = in_layers(facets, mesh.X, new_number);
  return sorted;
}

void add_plane(Mesh& mesh, const std::string& name, int axis) {
  Subset nodes;
  for (Index node = 0; node < mesh.X.cols(); ++node) {
    if (mesh.X(axis, node) == 0) nodes.push_back(node);  // exact by construction
  }
  mesh.node_sets.push_back({name, nodes});
}

Mesh turned(const Mesh& quarter, Revolution turn, const std::string& name) {
  Mesh mesh = turn == Revolution::full ? in_layers(with_image(with_image(quarter, 0), 1)) : quarter;
  add_set_of_all(mesh, name);
  if (turn == Revolution::quarter) {
    add_plane(mesh, name + ".x_plane", 0);
    add_plane(mesh, name + ".y_plane", 1);
  }
  return mesh;
}

}  // namespace nereid::mesh
