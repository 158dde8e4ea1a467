#pragma once
// Two edges that cross: the fourth element of the paper's family, a tetrahedron of which they are opposite edges.

#include "base/tensor.hpp"

namespace nereid::geometry {

/// Height of one edge over another where their lines are closest.
template <class T>
struct Crossing {
  T height;          ///< [m] signed by the normal
  Vector<T> normal;  ///< unit vector along L1 x L2
  T first, second;   ///< [-] places along both edges, 0 at their first nodes and 1 at their second ones
};

/// Height of the line 1-2 over the line 3-4.
///
///     L1 = x_2 - x_1,  L2 = x_4 - x_3,  N = L1 x L2,  d = x_1 - x_3
///     h = 6 V / |N| = d . N / |N|,   s = -(d x L2) . N / N . N,   t = -(d x L1) . N / N . N
///
/// Its gradient is  dh/dx = n times (1 - s, s, -(1 - t), -t):  no net force, and no net moment, wherever s and t lie.
/// Needs   lines that are not parallel
template <class T>
Crossing<T> crossing(const Vector<T>& x1, const Vector<T>& x2, const Vector<T>& x3, const Vector<T>& x4) {
  const Vector<T> L1 = x2 - x1, L2 = x4 - x3, d = x1 - x3, N = cross(L1, L2);
  const T per_length = T(1.0) / root(dot(N, N));
  const Vector<T> n = per_length * N;
  return {dot(d, n), n, -(per_length * dot(cross(d, L2), n)), -(per_length * dot(cross(d, L1), n))};
}

/// Squared distance of two line segments 1-2 and 3-4, also of parallel ones. [m2]
double segments_squared(const Vector<double>& x1, const Vector<double>& x2, const Vector<double>& x3, const Vector<double>& x4);

}  // namespace nereid::geometry
