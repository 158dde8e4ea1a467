#pragma once
// Heights of the paper's three contact elements, and their gradients.
//
// An apex stands at height h over the closest feature of a base surface:
//     tetrahedral element   apex over facet 1-2-3    h signed by the facet's normal
//     triangular element    apex over edge 1-2       h the distance to the edge's line
//     line element          apex over vertex 1       h the distance to the vertex
// In all three  h_dot = n . (v_apex - sum of w_I v_I)  with n from the foot towards the apex and w_I
// the weights of the foot, so one gradient serves the family: docs/theory/height.md.

#include <array>
#include <cmath>

#include "base/tensor.hpp"

namespace nereid::geometry {

/// Height of an apex over a feature with `nodes` base nodes.
template <class T, int nodes>
struct Height {
  T height;                     ///< [m]
  Vector<T> normal;             ///< unit vector from the base to the side of the apex
  std::array<T, nodes> weight;  ///< of the foot of the apex; they sum to one
};

/// Signed height of an apex over the plane of a facet.
///
///     h = 3 V / A = n . (x_4 - x_1),   n = (x_2 - x_1) x (x_3 - x_1) / |...|
///
/// weight  barycentric coordinates of the projection, any sign; Kulak & Fiala Eq. 7.
/// Needs   a facet with an area
template <class T>
NEREID_HOT Height<T, 3> facet_height(const std::array<Vector<T>, 3>& base, const Vector<T>& apex) {
  const Vector<T> a = base[1] - base[0], b = base[2] - base[0], p = apex - base[0];
  const Vector<T> N = cross(a, b);
  const T per_length = T(1.0) / root(dot(N, N));  // one division: walks ask for many heights
  const Vector<T> n = per_length * N;
  const T w2 = per_length * dot(cross(p, b), n), w3 = per_length * dot(cross(a, p), n);
  return {dot(n, p), n, {T(1.0) - w2 - w3, w2, w3}};
}

/// Squares of a height and of a level, both times the square of twice the area of the facet.
struct HeightSquared {
  double height;  ///< with the sign of the height
  double level;   ///< with room for round-off
};
/// Those of an apex over a facet: without the root of facet_height(), for walks that pass most facets by.
NEREID_HOT HeightSquared height_squared(const std::array<Vector<double>, 3>& base, const Vector<double>& apex, double level) {
  constexpr double round_off = 1e-9;  // of the height
  const Vector<double> N = cross(base[1] - base[0], base[2] - base[0]);
  const double height = dot(N, apex - base[0]);
  return {height * std::abs(height), (1 + round_off) * (level * level) * dot(N, N)};
}

/// Whether facet_height() is more than `level` [m], not negative: by more than round-off, but at 0, where the sign alone tells. False where
/// it is not known without a root.
NEREID_HOT bool is_well_above(const std::array<Vector<double>, 3>& base, const Vector<double>& apex, double level) {
  const HeightSquared squared = height_squared(base, apex, level);
  return squared.height > squared.level;
}
/// Whether it is less than -level, the same.
NEREID_HOT bool is_well_below(const std::array<Vector<double>, 3>& base, const Vector<double>& apex, double level) {
  const HeightSquared squared = height_squared(base, apex, level);
  return squared.height < -squared.level;
}

/// Distance of an apex from the line of an edge.
///
///     s = (x_3 - x_1) . L / L . L,  L = x_2 - x_1,   h = |x_3 - x_1 - s L|,   weight (1 - s, s)
///
/// Needs   an apex that is not on the line, an edge with a length
template <class T>
Height<T, 2> edge_height(const std::array<Vector<T>, 2>& base, const Vector<T>& apex) {
  const Vector<T> L = base[1] - base[0], p = apex - base[0];
  const T s = dot(p, L) / dot(L, L);
  const Vector<T> r = p - s * L;
  const T h = norm(r);
  return {h, (T(1.0) / h) * r, {T(1.0) - s, s}};
}

/// Distance of an apex from a vertex:  h = |x_2 - x_1|.  Needs two different points.
template <class T>
Height<T, 1> vertex_height(const std::array<Vector<T>, 1>& base, const Vector<T>& apex) {
  const Vector<T> r = apex - base[0];
  const T h = norm(r);
  return {h, (T(1.0) / h) * r, {T(1.0)}};
}

/// Gradient of a height by the base nodes and, last, the apex.
///
///     dh/dx_I = -w_I n,   dh/dx_apex = n
///
/// Invariants  the columns sum to zero (no net force); sum of x_I cross B_I is zero (no net moment),
///             also where the foot lies outside the feature.
template <class T, int nodes>
std::array<Vector<T>, nodes + 1> height_gradient(const Height<T, nodes>& at) {
  std::array<Vector<T>, nodes + 1> B;
  for (int I = 0; I < nodes; ++I) B[I] = -(at.weight[I] * at.normal);
  B[nodes] = at.normal;
  return B;
}

/// A row of the paper's Eq. 8a, for base node I of the tetrahedral element.
enum class Printing {
  as_printed,  ///< middle term x_jK x_k4J, second factor 1.5 V/A
  corrected,   ///< middle term x_jK x_kJ4, second factor 1.5 V/A^3: the gradient of h = 3V/A
};

/// Eq. 8 of Kulak & Fiala, term by term, with J and K from their Table I; kept to be compared.
///
/// x_kKJ = x_k(K) - x_k(J); A_j is the area projected along j. Only Printing::corrected equals
/// height_gradient(facet_height(...)).
///
/// returns  B, [4] vectors, the apex last
std::array<Vector<double>, 4> paper_gradient(const std::array<Vector<double>, 3>& base,
                                             const Vector<double>& apex, Printing);

}  // namespace nereid::geometry
