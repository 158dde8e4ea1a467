#pragma once
// Distortion control of hexahedra: a barrier against corners that close. docs/theory/hexahedron.md.
//
// An element that flows resists no change of its shape along the flow: its thickness may become uneven, at no cost, until a corner
// inverts. Hourglass control cannot help, since a stress along the deviator would be one beyond the yield stress.

#include <array>

#include "base/tensor.hpp"

namespace nereid::element {

/// Distortion control; zero stiffness switches it off.
struct Distortion {
  double stiffness = 0.1;  ///< [-] over Young's modulus, where the control begins
};

/// Whether there is any.
constexpr bool acts(const Distortion& control) { return control.stiffness > 0; }

/// The three edges at each corner lead to these nodes, right-handed: mesh/mesh.hpp numbers the lower face first.
inline constexpr std::array<std::array<int, 3>, 8> corner_ends{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

/// One corner of a hexahedron.
template <class T>
struct Corner3 {
  std::array<Vector<T>, 3> edge, area;  ///< [m], and [m2] the products of the two others
  T jacobian;                           ///< [m3]
};
template <class T>
NEREID_HOT Corner3<T> corner_of(const std::array<Vector<T>, 8>& x, int corner) {
  const auto& end = corner_ends[corner];
  const Vector<T> a = x[end[0]] - x[corner], b = x[end[1]] - x[corner], c = x[end[2]] - x[corner];
  const Vector<T> bc = cross(b, c);
  return {{a, b, c}, {bc, cross(c, a), cross(a, b)}, dot(a, bc)};
}

constexpr double control_starts = 0.4;  ///< [-] of the smallest corner of the reference, where distortion control begins
constexpr double control_is_near = 1.05;  ///< [-] of that: from here on the step counts it, before it acts

constexpr double control_floor = 0.05;  ///< [-] of start, below which the force grows linearly

/// Where distortion control begins: at a part of the smallest corner of the reference. [m3]
///
/// Corners two of whose nodes are one are left out: collapsed hexahedra.
/// returns  -1e300 where another corner is flat or inverted: it would be pushed from the start
template <class T>
NEREID_HOT T start_of_control(const std::array<Vector<T>, 8>& X) {
  const T flat(1e-18), never(1e300), zero(0.0);  // flat: of the square of the product of the edges
  T smallest = never;
  for (int c = 0; c < 8; ++c) {
    const Corner3<T> corner = corner_of(X, c);
    const auto& [a, b, d] = corner.edge;
    const T J = larger(corner.jacobian, zero), edges = dot(a, a) * dot(b, b) * dot(d, d);
    const T here = select(J * J > flat * edges, J, zero);
    smallest = select(edges > zero, smaller(smallest, here), smallest);
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
///     W = K/V0 sum over corners of start (start - J)^2 / (2 J),      f = -dW/dx
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
/// exact for a flat element whose thickness becomes uneven. Corners count from 1.05 `start` on, so that the step is short enough before
/// the control acts.
///
/// stiffness  [Pa] K;  start  [m3];  per_volume  [1/m3] of the reference;  per_mass  [1/kg]
/// x  [m];  energy  [J] W before, then now;  force  [N] by which the element pulls its nodes
template <class T>
NEREID_HOT Controlled<T> control_distortion(T stiffness, T start, T per_volume, T per_mass, const std::array<Vector<T>, 8>& x, T& energy,
                                            std::array<Vector<T>, 8>& force) {
  const T zero(0.0), near = T(control_is_near) * start;
  std::array<T, 8> J;
  T smallest(1e300);
  for (int c = 0; c < 8; ++c) {
    const auto& end = corner_ends[c];
    J[c] = dot(x[end[0]] - x[c], cross(x[end[1]] - x[c], x[end[2]] - x[c]));
    smallest = smaller(smallest, J[c]);
  }
  if (!any(smallest < near) && !any(energy > zero)) return {zero, zero};

  T now = zero;
  std::array<T, 8> at_node{zero, zero, zero, zero, zero, zero, zero, zero};  // [m], times K
  for (int c = 0; c < 8; ++c) {
    const auto is_near = J[c] < near && larger(J[c], -J[c]) > zero;
    if (!any(is_near)) continue;
    const Corner3<T> corner = corner_of(x, c);
    const T in_time = larger(J[c], T(control_floor) * start), deeper = in_time - J[c], closer = start / in_time;
    const T stiff = closer * closer * closer, at = T(0.5) * start * (closer * closer - T(1.0)), gap = start - in_time;
    const auto acts_here = is_near && J[c] < start;
    const T push = select(acts_here, at + stiff * deeper, zero), pressure = stiffness * per_volume * push;
    now = now + select(acts_here, stiffness * per_volume * (T(0.5) * closer * gap * gap + (at + T(0.5) * stiff * deeper) * deeper), zero);
    std::array<T, 3> area, edge;
    Vector<T> sum{zero, zero, zero};
    for (int i = 0; i < 3; ++i) {
      const int end = corner_ends[c][i];
      const Vector<T> f = pressure * corner.area[i];
      force[end] = force[end] + f, sum = sum + f;
      area[i] = root(dot(corner.area[i], corner.area[i])), edge[i] = root(dot(corner.edge[i], corner.edge[i]));
    }
    force[c] = force[c] - sum;
    const T areas = area[0] + area[1] + area[2], edges = edge[0] + edge[1] + edge[2];
    for (int i = 0; i < 3; ++i) {
      const int end = corner_ends[c][i];
      const T k = select(is_near, per_volume * (stiff * area[i] * areas + push * (edges - edge[i])), zero);
      at_node[c] = at_node[c] + k, at_node[end] = at_node[end] + k;
    }
  }
  T largest = zero;
  for (const T& k : at_node) largest = larger(largest, k);
  const T stored = now - energy;
  energy = now;
  return {stored, T(16.0) * per_mass * stiffness * largest};
}

}  // namespace nereid::element
