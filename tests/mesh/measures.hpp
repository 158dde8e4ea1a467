#pragma once
// What the tests of meshes measure: volumes, shapes, and how facets hang together.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "mesh/mesh.hpp"

namespace nereid::mesh::measures {

using Corner = std::array<int, 4>;  // a node and its neighbours, right-handed
constexpr std::array<Corner, 8> corners{Corner{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6},
                                        {3, 0, 2, 7},       {4, 7, 5, 0}, {5, 4, 6, 1},
                                        {6, 5, 7, 2},       {7, 6, 4, 3}};

inline Mat3 edges_at(const Mesh& mesh, const Table<8>& nodes, Index element, const Corner& corner) {
  Mat3 edges;
  for (int a = 0; a < 3; ++a) {
    edges.col(a) =
        mesh.X.col(nodes(corner[a + 1], element)) - mesh.X.col(nodes(corner[0], element));
  }
  return edges;
}

/// Mean of the corner Jacobians: exact for the prisms that the generators make.
inline double volume(const Mesh& mesh, const Table<8>& nodes, Index element) {
  double sum = 0;
  for (const Corner& corner : corners) sum += edges_at(mesh, nodes, element, corner).determinant();
  return sum / 8;
}

inline double volume(const Mesh& mesh, const Table<8>& nodes) {
  double sum = 0;
  for (Index element = 0; element < nodes.cols(); ++element) sum += volume(mesh, nodes, element);
  return sum;
}

/// Volume of trilinear hexahedra, exact by two points of Gauss along each axis: the Jacobian is of second degree in each.
inline double trilinear_volume(const Mesh& mesh, const Table<8>& nodes) {
  constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  double sum = 0;
  for (Index element = 0; element < nodes.cols(); ++element) {
    for (const auto& at : sign) {
      Mat3 jacobian = Mat3::Zero();
      for (int a = 0; a < 8; ++a) {
        double factor[3];
        for (int i = 0; i < 3; ++i) factor[i] = 0.5 * (1 + sign[a][i] * at[i] / std::sqrt(3.0));
        for (int i = 0; i < 3; ++i)
          jacobian.col(i) += 0.5 * sign[a][i] * factor[(i + 1) % 3] * factor[(i + 2) % 3] * mesh.X.col(nodes(a, element));
      }
      sum += jacobian.determinant();
    }
  }
  return sum;
}

inline double smallest_volume(const Mesh& mesh, const Table<8>& nodes) {
  double smallest = volume(mesh, nodes, 0);
  for (Index element = 1; element < nodes.cols(); ++element) {
    smallest = std::min(smallest, volume(mesh, nodes, element));
  }
  return smallest;
}

inline double scaled_jacobian(const Mesh& mesh, const Table<8>& nodes) {
  double smallest = 1;
  for (Index element = 0; element < nodes.cols(); ++element) {
    for (const Corner& corner : corners) {
      const Mat3 edges = edges_at(mesh, nodes, element, corner);
      smallest = std::min(smallest, edges.colwise().normalized().determinant());
    }
  }
  return smallest;
}

inline Vec3 centre(const Mesh& mesh, const Table<3>& facets, Index facet) {
  return (mesh.X.col(facets(0, facet)) + mesh.X.col(facets(1, facet)) +
          mesh.X.col(facets(2, facet))) /
         3;
}

inline Vec3 normal(const Mesh& mesh, const Table<3>& facets, Index facet) {
  const Vec3 first = mesh.X.col(facets(0, facet));
  const Vec3 second = mesh.X.col(facets(1, facet)), third = mesh.X.col(facets(2, facet));
  return (second - first).cross(third - first).normalized();
}

/// Of all facets, the smallest product of unit normal and the direction that should be outwards.
template <class Outwards>
double worst_normal(const Mesh& mesh, const Table<3>& facets, Outwards outwards) {
  double worst = 1;
  for (Index facet = 0; facet < facets.cols(); ++facet) {
    const Vec3 wanted = outwards(centre(mesh, facets, facet)).normalized();
    worst = std::min(worst, normal(mesh, facets, facet).dot(wanted));
  }
  return worst;
}

inline double sum(const Scalars& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Largest deviation of any value from the one expected, of that one.
inline double unevenness(const Scalars& values, double expected) {
  double worst = 0;
  for (const double value : values) worst = std::max(worst, std::abs(value / expected - 1));
  return worst;
}

inline Vec3 from_axis(const Vec3& point) { return {point.x(), point.y(), 0}; }

/// Facets at each side, counted once in each direction.
using Sides = std::map<std::pair<Index, Index>, int>;

inline void add_sides(const Table<3>& facets, Sides& sides) {
  for (Index facet = 0; facet < facets.cols(); ++facet) {
    for (int a = 0; a < 3; ++a) ++sides[{facets(a, facet), facets((a + 1) % 3, facet)}];
  }
}

/// Number of sides without a partner in the opposite direction, or -1 if a side is used twice in
/// the same direction.
inline int open_sides(const Sides& sides) {
  int open = 0;
  for (const auto& [side, count] : sides) {
    if (count != 1) return -1;
    if (!sides.count({side.second, side.first})) ++open;
  }
  return open;
}

/// Vertices minus edges plus facets.
inline int euler_characteristic(const Table<3>& facets) {
  Sides sides;
  add_sides(facets, sides);
  const int directed = static_cast<int>(sides.size());
  const int edges = (directed + open_sides(sides)) / 2;
  const int vertices = static_cast<int>(surface_nodes({"", facets}).size());
  return vertices - edges + static_cast<int>(facets.cols());
}

inline Table<3> together(const std::vector<Surface>& surfaces) {
  Table<3> all(3, 0);
  for (const Surface& surface : surfaces) {
    const Eigen::Index before = all.cols();
    all.conservativeResize(3, before + surface.facets.cols());
    all.rightCols(surface.facets.cols()) = surface.facets;
  }
  return all;
}

/// Nodes by their exact position.
using Places = std::map<std::tuple<double, double, double>, Index>;

inline Places nodes_by_place(const Mesh& mesh) {
  Places result;
  for (Index node = 0; node < mesh.X.cols(); ++node) {
    result[{mesh.X(0, node), mesh.X(1, node), mesh.X(2, node)}] = node;
  }
  return result;
}

/// The node at the exact image of `node` across `axis`, or -1.
inline Index image(const Mesh& mesh, const Places& places, Index node, int axis) {
  Vec3 at = mesh.X.col(node);
  if (at(axis) != 0) at(axis) = -at(axis);
  const auto found = places.find({at.x(), at.y(), at.z()});
  return found == places.end() ? -1 : found->second;
}

/// Whether the table holds the image of each of its columns, local nodes in the order given.
template <int rows>
bool is_mirrored(const Mesh& mesh, const Table<rows>& nodes, const std::array<int, rows>& order,
                 int axis) {
  const Places at = nodes_by_place(mesh);
  std::map<std::array<Index, rows>, int> columns;
  std::array<Index, rows> column;
  for (Index one = 0; one < nodes.cols(); ++one) {
    for (int a = 0; a < rows; ++a) column[a] = nodes(a, one);
    ++columns[column];
  }
  for (Index one = 0; one < nodes.cols(); ++one) {
    for (int a = 0; a < rows; ++a) column[a] = image(mesh, at, nodes(order[a], one), axis);
    if (!columns.count(column)) return false;
  }
  return true;
}

/// Nodes at which `holds` is true of the position.
template <class Condition>
Subset nodes_where(const Mesh& mesh, Condition holds) {
  Subset nodes;
  for (Index node = 0; node < mesh.X.cols(); ++node) {
    if (holds(Vec3(mesh.X.col(node)))) nodes.push_back(node);
  }
  return nodes;
}

}  // namespace nereid::mesh::measures
