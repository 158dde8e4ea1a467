#pragma once
// Base surfaces that the tests of this folder press on.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "contact/surface/base_surface.hpp"
#include "geometry/closest.hpp"
#include "mesh/box.hpp"

namespace nereid::contact::surfaces {

struct Shape {
  Vectors x;        ///< [m]
  Table<3> facets;
};

/// A sheet over [0, cells] x [0, cells] with z = height(x, y), normals upwards; cuts alternate, and
/// with `jitter` the nodes inside stand off their places along y by up to that much.
template <class Height>
Shape sheet(int cells_x, int cells_y, Height&& height, double jitter = 0) {
  Shape shape{Vectors(3, (cells_x + 1) * (cells_y + 1)), Table<3>(3, 2 * cells_x * cells_y)};
  const auto node = [&](int i, int j) { return j * (cells_x + 1) + i; };
  for (int j = 0; j <= cells_y; ++j) {
    for (int i = 0; i <= cells_x; ++i) {
      const bool inside = i > 0 && i < cells_x && j > 0 && j < cells_y;
      const double y = j + (inside ? jitter * std::sin(7.0 * i + 3.0 * j) : 0);
      const double px = i + (inside ? jitter * std::cos(5.0 * i + 11.0 * j) : 0);
      shape.x.col(node(i, j)) = Vec3(px, y, height(px, y));
    }
  }
  Index f = 0;
  for (int j = 0; j < cells_y; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      const Index a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      const bool up = (i + j) % 2 == 0;
      shape.facets.col(f++) = up ? Eigen::Vector3i(a, b, c) : Eigen::Vector3i(a, b, d);
      shape.facets.col(f++) = up ? Eigen::Vector3i(a, c, d) : Eigen::Vector3i(b, c, d);
    }
  }
  return shape;
}

/// Nodes around the faces of hexahedra of which a sheet has the halves.
inline Table<4> faces_of_sheet(int cells_x, int cells_y) {
  Table<4> faces(4, cells_x * cells_y);
  for (Index j = 0, f = 0; j < cells_y; ++j)
    for (Index i = 0; i < cells_x; ++i, ++f) {
      const Index a = j * (cells_x + 1) + i, d = a + cells_x + 1;
      faces.col(f) = Eigen::Matrix<Index, 4, 1>(a, a + 1, d + 1, d);
    }
  return faces;
}

/// The unit sphere: an octahedron whose facets are quartered `times` times, normals outwards.
inline Shape ball(int times) {
  std::vector<Vec3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<Index, 3>> facets{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int t = 0; t < times; ++t) {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto between = [&](Index a, Index b) {
      const auto [at, is_new] = middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<Index>(points.size()));
      if (is_new) points.push_back((points[a] + points[b]).normalized());
      return at->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (const auto& [a, b, c] : facets) {
      const Index ab = between(a, b), bc = between(b, c), ca = between(c, a);
      for (const auto& facet : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
        finer.push_back(facet);
    }
    facets = finer;
  }
  Shape shape{Vectors(3, static_cast<Eigen::Index>(points.size())), Table<3>(3, static_cast<Eigen::Index>(facets.size()))};
  for (std::size_t i = 0; i < points.size(); ++i) shape.x.col(static_cast<Eigen::Index>(i)) = points[i];
  for (std::size_t f = 0; f < facets.size(); ++f)
    shape.facets.col(static_cast<Eigen::Index>(f)) = Eigen::Vector3i(facets[f][0], facets[f][1], facets[f][2]);
  return shape;
}

inline BaseSurface base_of(const Shape& shape) {
  return base_surface({"base", shape.facets}, shape.x);
}

/// The skin of a box.
inline Shape block(const Vec3& low, const Vec3& high, const Eigen::Vector3i& cells) {
  const mesh::Mesh box = mesh::box("box", {low, high, cells});
  Shape shape{box.X, Table<3>(3, 0)};
  for (const char* side : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) {
    const Table<3>& facets = mesh::surface(box, std::string("box.") + side).facets;
    shape.facets.conservativeResize(3, shape.facets.cols() + facets.cols());
    shape.facets.rightCols(facets.cols()) = facets;
  }
  return shape;
}
inline Shape skin() { return block(Vec3::Zero(), Vec3(1, 1, 0.3), {3, 3, 1}); }

/// Distance to the nearest facet, by looking at all.
inline double nearest_of_all(const BaseSurface& base, const Vectors& x, const Vector<double>& p) {
  double least = 1e300;
  for (Index f = 0; f < base.facets.cols(); ++f)
    least = std::min(least, geometry::closest_on_triangle(corners(base, x, f), p).distance_squared);
  return std::sqrt(least);
}

}  // namespace nereid::contact::surfaces
