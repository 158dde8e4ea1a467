#pragma once
// Distortion control of hexahedra: a barrier against corners that close. docs/theory/hexahedron.md.
//
// An element that flows resists no change of its shape along the flow: its thickness may become uneven, at no cost, until a corner
// inverts. Hourglass control cannot help, since a stress along the deviator would be one beyond the yield stress.

#include <array>

#include "element/corner_edges.hpp"

namespace nereid::element {

/// Distortion control; zero stiffness switches it off.
struct Distortion {
  double stiffness = 0.1;  ///< [-] over Young's modulus, where the control begins
};

/// Whether there is any.
constexpr bool acts(const Distortion& control) { return control.stiffness > 0; }

constexpr double control_starts = 0.4;    ///< [-] of the smallest corner of the reference: below that Jacobian the control acts
constexpr double control_is_near = 1.05;  ///< [-] of that: from here on the bound on the step counts a corner
constexpr double control_floor = 0.05;    ///< [-] of that: below it the force grows linearly

/// Where distortion control begins: at a part of the smallest corner of the reference. [m3]
///
/// Corners two of whose nodes are one are left out: collapsed hexahedra.
/// returns  -1e300 where another corner is flat or inverted: it would be pushed from the start
template <class T>
NEREID_HOT T start_of_control(const std::array<Vector<T>, 8>& X) {
  const T never(1e300), zero(0.0);
  T smallest = never;
  for (int c = 0; c < 8; ++c) {
    const CornerEdges<T> corner = corner_edges(X, c);
    smallest = select(square_of_lengths(corner) > zero, smaller(smallest, volume_of_corner(corner)), smallest);
  }
  return select(smallest < never && smallest > zero, T(control_starts) * smallest, -never);
}

/// What distortion control did in a step.
template <class T>
struct Controlled {
  T stored;         ///< [J] increment
  T omega_squared;  ///< [1/s2] by how much it raises the bound on the squared frequencies
};

/// Adds the forces of distortion control:
///
///     W = K/V0 sum over corners of start (start - J)^2 / (2 J),     K = stiffness E,     f = -dW/dx
///
/// J is the Jacobian of a corner, the volume spanned by its three edges. Below start/20 the force -dW/dJ goes on linearly, so that a corner
/// that inverts within a step comes back. Where all are above `start` no force changes. A corner two of whose nodes are one has no volume,
/// and no control.
///
/// Its frequencies: with a_i the product of the two other edges, Cauchy and Schwarz bound the second variation of one corner by a spring
/// along each edge, and springs of edges k_i that meet at nodes of mass m/8 have squared frequencies of at most twice their largest sum at
/// a node over m/8:
///
///     k_i = W'' |a_i| sum |a_j| + |W'| (sum |e_j| - |e_i|),     W'' = K/V0 (start/J)^3,     omega^2 <= 16/m max over nodes of sum k_i
///
/// exact in the limit of a flat element whose thickness becomes uneven.
///
/// young  [Pa];  density  [kg/m3];  start  [m3];  per_mass  [1/kg] of the element
/// x  [m];  energy  [J] W before, then now;  force  [N] by which the element pulls its nodes
template <class T>
NEREID_HOT Controlled<T> control_distortion(const Distortion& control, double young, double density, T start, T per_mass,
                                            const std::array<Vector<T>, 8>& x, T& energy, std::array<Vector<T>, 8>& force) {
  const T zero(0.0), half(0.5), one(1.0), near = T(control_is_near) * start, lowest = T(control_floor) * start;
  if (!acts(control)) return {zero, zero};
  std::array<T, 8> J;
  T smallest(1e300);
  for (int c = 0; c < 8; ++c) J[c] = corner_edges(x, c).jacobian, smallest = smaller(smallest, J[c]);
  if (!any(smallest < near) && !any(energy > zero)) return {zero, zero};

  const T per_volume = T(density) * per_mass, stiffness = T(control.stiffness * young) * per_volume;  // K/V0
  T now = zero;
  std::array<T, 8> at_node{zero, zero, zero, zero, zero, zero, zero, zero};  // [N/m] sums of k_i
  for (int c = 0; c < 8; ++c) {
    if (!any(J[c] < near)) continue;
    const CornerEdges<T> corner = corner_edges(x, c);
    const auto is_near = J[c] < near && square_of_lengths(corner) > zero, is_closed = is_near && J[c] < start;
    const T above = larger(J[c], lowest), below = above - J[c], gap = start - above, ratio = start / above;
    const T second = stiffness * (ratio * ratio * ratio), push = half * stiffness * start * (ratio * ratio - one);  // W'', -W' at `above`
    const T pressure = select(is_closed, push + second * below, zero);
    now = now + select(is_closed, half * stiffness * ratio * gap * gap + (push + half * second * below) * below, zero);
    std::array<T, 3> area, edge;
    Vector<T> sum{zero, zero, zero};
    for (int i = 0; i < 3; ++i) {
      const int end = corner_ends[c][i];
      const Vector<T> f = pressure * corner.area[i];
      force[end] = force[end] + f, sum = sum + f;
      area[i] = norm(corner.area[i]), edge[i] = norm(corner.edge[i]);
    }
    force[c] = force[c] - sum;
    const T areas = area[0] + area[1] + area[2], edges = edge[0] + edge[1] + edge[2];
    for (int i = 0; i < 3; ++i) {
      const int end = corner_ends[c][i];
      const T k = select(is_near, second * area[i] * areas + pressure * (edges - edge[i]), zero);
      at_node[c] = at_node[c] + k, at_node[end] = at_node[end] + k;
    }
  }
  T largest = zero;
  for (const T& k : at_node) largest = larger(largest, k);
  const T stored = now - energy;
  energy = now;
  return {stored, T(16.0) * per_mass * largest};
}

}  // namespace nereid::element
