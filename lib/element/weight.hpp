#pragma once
// Where a hexahedron of fluid has its mass: what of it each node has, and its weight at the centroid of its volume.
//
// With pressures that rise by density g from centroid to centroid, a fluid below a level surface is at rest on any mesh: the sum of the
// forces is the gradient of the integral of the hydrostatic pressure over the volume of the body, which no node inside it changes. For the
// same reason no motion that keeps all volumes sets gravity free. Masses at the nodes have neither: docs/theory/fluid.md.

#include <array>

#include "element/hexahedron.hpp"

namespace nereid::element {

/// The integral of g . (x - mean of the nodes) over the volume, and its gradient by the modal amplitudes.
template <class T>
struct FirstMoment {
  T value;        ///< [m5/s2]
  Vector<T> place;  ///< [m4] of x - mean of the nodes alone
  Modes<T> by;    ///< [m4/s2]
};

/// How the place in a hexahedron moves along its own axes, with these amplitudes. [m]
template <class T>
struct Tangents {
  Vector<T> xi, eta, zeta;
};
template <class T>
NEREID_HOT Tangents<T> tangents(const Modes<T>& X, T xi, T eta, T zeta) {
  const auto& [h0, h1, h2, h3] = X.hourglass;
  return {X.xi + zeta * h1 + eta * h2 + eta * zeta * h3, X.eta + zeta * h0 + xi * h2 + zeta * xi * h3,
          X.zeta + eta * h0 + xi * h1 + xi * eta * h3};
}

/// By two Gauss points each way, which is exact.
///
/// X  [m] amplitudes;  g  [m/s2]
template <class T>
NEREID_HOT FirstMoment<T> first_moment(const Modes<T>& X, const Vector<T>& g) {
  constexpr double at = 0.57735026918962576;
  const auto& [h0, h1, h2, h3] = X.hourglass;
  const Vector<T> none{T(0.0), T(0.0), T(0.0)};
  FirstMoment<T> m{T(0.0), none, {none, none, none, {none, none, none, none}}};
  for (int point = 0; point < 8; ++point) {
    const T xi((point & 1) != 0 ? at : -at), eta((point & 2) != 0 ? at : -at), zeta((point & 4) != 0 ? at : -at);
    const T ez = eta * zeta, zx = zeta * xi, xe = xi * eta, xez = xe * zeta;
    const auto [a, b, c] = tangents(X, xi, eta, zeta);
    const Vector<T> A = cross(b, c), B = cross(c, a), C = cross(a, b);
    const T volume = dot(a, A);
    const Vector<T> r = xi * X.xi + eta * X.eta + zeta * X.zeta + ez * h0 + zx * h1 + xe * h2 + xez * h3;
    const T lift = dot(g, r);
    m.value = m.value + lift * volume;
    m.place = m.place + volume * r;
    const Vector<T> by_place = volume * g, by_a = lift * A, by_b = lift * B, by_c = lift * C;
    m.by.xi = m.by.xi + xi * by_place + by_a;
    m.by.eta = m.by.eta + eta * by_place + by_b;
    m.by.zeta = m.by.zeta + zeta * by_place + by_c;
    m.by.hourglass[0] = m.by.hourglass[0] + ez * by_place + zeta * by_b + eta * by_c;
    m.by.hourglass[1] = m.by.hourglass[1] + zx * by_place + zeta * by_a + xi * by_c;
    m.by.hourglass[2] = m.by.hourglass[2] + xe * by_place + eta * by_a + xi * by_b;
    m.by.hourglass[3] = m.by.hourglass[3] + xez * by_place + ez * by_a + zx * by_b + xe * by_c;
  }
  return m;
}

/// The integrals of the shape functions over the volume. [m3]
///
/// Masses of the nodes go with them, as the forces of a pressure that rises evenly do: then it accelerates all nodes alike, also those of
/// wedges, at whose axis two nodes have a third of the volume.
///
/// X  [m] amplitudes
inline std::array<double, 8> volume_shares(const Modes<double>& X) {
  constexpr double at = 0.57735026918962576;
  constexpr int sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  std::array<double, 8> share{};
  for (const auto& point : sign) {
    const double xi = at * point[0], eta = at * point[1], zeta = at * point[2];
    const auto [a, b, c] = tangents(X, xi, eta, zeta);
    const double volume = dot(a, cross(b, c));
    for (std::size_t node = 0; node < 8; ++node)
      share[node] += 0.125 * (1 + sign[node][0] * xi) * (1 + sign[node][1] * eta) * (1 + sign[node][2] * zeta) * volume;
  }
  return share;
}

/// What add_weight() found.
template <class T>
struct Weight {
  T energy;       ///< [J] U
  Vector<T> arm;  ///< [kg m] mass times the way from the centre of the nodes' masses to the centroid; its moment is  arm x g
};

/// Adds to the nodal forces what the weight at the centroid differs from weights at the nodes:
///
///     U = -mass g . centroid + sum over the nodes of m g . x,     f = -dU/dx;  they have no resultant
///
/// x  [m] of the nodes, and their amplitudes;  per_node  [1/kg]
template <class T>
NEREID_HOT Weight<T> add_weight(const std::array<Vector<T>, 8>& x, const Modes<T>& X, const Gradient<T>& gradient, T mass,
                        const std::array<T, 8>& per_node, const Vector<T>& g, std::array<Vector<T>, 8>& force) {
  const FirstMoment<T> m = first_moment(X, g);
  const T way = m.value * gradient.per_volume, eight(8.0), part = T(0.125) * mass * gradient.per_volume;
  Modes<T> F = m.by;
  F.xi = part * (F.xi - eight * way * gradient.xi);
  F.eta = part * (F.eta - eight * way * gradient.eta);
  F.zeta = part * (F.zeta - eight * way * gradient.zeta);
  for (int a = 0; a < 3; ++a) F.hourglass[a] = part * (F.hourglass[a] - eight * way * gradient.hourglass[a]);
  F.hourglass[3] = part * F.hourglass[3];
  const std::array<Vector<T>, 8> more = nodal_values(F);
  Vector<T> at_nodes{T(0.0), T(0.0), T(0.0)};  // sum of m x less that of the mean
  for (int node = 0; node < 8; ++node) {
    const T beyond = T(1.0) / per_node[node] - T(0.125) * mass;
    at_nodes = at_nodes + beyond * x[node];
    force[node] = force[node] + more[node] - beyond * g;
  }
  return {dot(g, at_nodes) - mass * way, mass * gradient.per_volume * m.place - at_nodes};
}

}  // namespace nereid::element
