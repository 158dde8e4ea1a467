#pragma once
// The corners of one hexahedron: their edges and Jacobians.

#include <array>

#include "base/tensor.hpp"

namespace nereid::element {

/// The three edges at each corner lead to these nodes, right-handed: mesh/mesh.hpp numbers the lower face first.
inline constexpr std::array<std::array<int, 3>, 8> corner_ends{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

/// The edges of a corner, and the volume that they span.
template <class T>
struct CornerEdges {
  std::array<Vector<T>, 3> edge;  ///< [m]
  std::array<Vector<T>, 3> area;  ///< [m2] of each edge the cross product of the two others: the gradient of the Jacobian
  T jacobian;                     ///< [m3]
};
template <class T>
NEREID_HOT CornerEdges<T> corner_edges(const std::array<Vector<T>, 8>& x, int corner) {
  const auto& end = corner_ends[corner];
  const Vector<T> a = x[end[0]] - x[corner], b = x[end[1]] - x[corner], c = x[end[2]] - x[corner];
  const Vector<T> bc = cross(b, c);
  return {{a, b, c}, {bc, cross(c, a), cross(a, b)}, dot(a, bc)};
}

/// Square of the product of the lengths of the edges; zero where two nodes of a corner are one. [m6]
template <class T>
NEREID_HOT T square_of_lengths(const CornerEdges<T>& corner) {
  const auto& [a, b, c] = corner.edge;
  return dot(a, a) * dot(b, b) * dot(c, c);
}

/// The Jacobian of a corner; zero where it is inverted, or so flat that its edges lie in a plane. [m3]
template <class T>
NEREID_HOT T volume_of_corner(const CornerEdges<T>& corner) {
  constexpr double flat = 1e-9;  // [-] of the product of the edges
  const T J = larger(corner.jacobian, T(0.0));
  return select(J * J > T(flat * flat) * square_of_lengths(corner), J, T(0.0));
}

}  // namespace nereid::element
