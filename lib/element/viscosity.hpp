#pragma once
// Viscosity of shocks: a stress proportional to the rate of the material's own stress, which spreads a shock over a few elements and damps
// the ringing behind it. In smooth motion the limiter (limiter.hpp) reduces it to almost zero. docs/theory/viscosity.md.

#include <array>

#include "base/number.hpp"
#include "base/tensor.hpp"

namespace nereid::element {

/// Coefficients of viscosity [-]; zero switches a term off.
struct Viscosity {
  double linear = 0.06;
  double quadratic = 1.0;
};

/// Whether there is any.
constexpr bool acts(const Viscosity& b) { return b.linear > 0 || b.quadratic > 0; }

/// The share of the viscosity that the motion along each axis of an element gets. [-] from 0 to 1
template <class T, int axes>
using Shares = std::array<T, axes>;

/// The viscous time over l/c, the time in which a wave travels the length l on which viscosity acts. [-]
///
///     b1 + b2^2 2/omega max(0, -rate)
///
/// The quadratic term acts in compression only (von Neumann & Richtmyer 1950; Landshoff 1955).
///
/// crossing  [s] 2/omega, the time in which a wave crosses the element;  rate  [1/s] of volume change, positive in expansion
template <class T>
NEREID_HOT T viscous_part(const Viscosity& b, T crossing, T rate) {
  return T(b.linear) + T(b.quadratic * b.quadratic) * crossing * larger(T(0.0), -rate);
}

/// What the viscosity of a hexahedron needs to know of a step.
template <class T>
struct Motion {
  Vector<T> xi, eta, zeta;                    ///< [m] from the centre to a face of each axis, at the end of the step
  Vector<T> moved_xi, moved_eta, moved_zeta;  ///< [m] how much they changed in it
  Symmetric<T> strain;                        ///< [-] of the step
  Symmetric<T> change;                        ///< [Pa] of the stress by it, both turned to the end of the step
  T growth, dt;                               ///< [-] of the volume, [s]
};

/// The viscous stress of a hexahedron, and the damping rate with all shares at one.
template <class T>
struct ViscousStress {
  Symmetric<T> stress;     ///< [Pa] positive in tension
  T damping;               ///< [1/s] s of stable_step
  std::array<T, 3> along;  ///< [-] strain of the step along each axis
};

/// The part of one axis in the viscous stress of a hexahedron.
template <class T>
struct OfAxis {
  T strain;  ///< [-] of the step
  T work;    ///< [Pa] of its motion, not negative
  T length;  ///< [m] on which viscosity acts
};

/// half, moved  [m] from the centre to a face, and how much it changed in the step;  change  [Pa] of the stress;  most  [m]
template <class T>
NEREID_HOT OfAxis<T> of_axis(const Vector<T>& half, const Vector<T>& moved, const Symmetric<T>& change, T most) {
  const T square = dot(half, half), per_square = T(1.0) / square, strain = per_square * dot(half - T(0.5) * moved, moved);
  const T work = per_square * strain * dot(half, change * half);
  return {strain, larger(work, -work), smaller(T(2.0) * root(square), most)};
}

constexpr double most_crossings = 1.4142135623730951;  ///< [-] longest length on which viscosity acts, over 2 c/omega

/// Viscous stress of a hexahedron, proportional to the rate of its stress:
///
///     s_v = tau ds/dt,     tau = l/c (b1 + b2^2 2/omega max(0, -rate))
///     l   = sum |a_k e_k| share_k l_k / max(sum |a_k e_k|, ds:de),     l_k = min(2 |h_k|, sqrt(2) 2 c/omega)
///
/// with e_k = (h_k - dh_k/2) . dh_k / h_k^2, which no rotation changes, and a_k = n_k . ds n_k along the axes n_k = h_k/|h_k|. So each axis
/// counts by the work of its motion. Shear along the axes strains none of them and has no viscous stress. Where a law softens, ds:de < 0,
/// the viscous stress is zero. The damping has shares of one: a step that depends on the shares amplifies round-off.
///
/// speed  c [m/s] of dilatational waves;  omega_squared  [1/s2] bound on the squared frequencies
template <class T, class N>
NEREID_HOT ViscousStress<T> viscous_stress(const Viscosity& viscosity, const Motion<T>& m, N speed, T omega_squared,
                                           const Shares<T, 3>& share) {
  const T zero(0.0), per_speed = T(N(1.0) / speed);
  const T crossing = T(2.0) / root(omega_squared), most = T(N(most_crossings) * speed) * crossing;
  const T work = contract(m.change, m.strain), part = per_speed * viscous_part(viscosity, crossing, m.growth / m.dt);
  // one by one and not in a loop, which would keep the axes in memory
  const OfAxis<T> xi = of_axis(m.xi, m.moved_xi, m.change, most), eta = of_axis(m.eta, m.moved_eta, m.change, most),
                  zeta = of_axis(m.zeta, m.moved_zeta, m.change, most);
  const T sum = xi.work + eta.work + zeta.work, longest = larger(larger(xi.length, eta.length), zeta.length);
  const T limited = xi.work * share[0] * xi.length + eta.work * share[1] * eta.length + zeta.work * share[2] * zeta.length;
  const T length = select(work > zero, limited / (larger(sum, work) + T(1e-300)), zero);
  return {(part * length / m.dt) * m.change, T(0.5) * part * longest * omega_squared, {xi.strain, eta.strain, zeta.strain}};
}

/// What the viscosity of a plate needs to know of a step.
template <class T>
struct PlaneMotion {
  Plane<T> strain;  ///< [-] of the step
  Plane<T> change;  ///< [Pa] of the membrane's stress by it, both turned to the end of the step
  T growth, dt;     ///< [-] of the area, [s]
};

/// The viscous stress of a plate, and the damping rate with a share of one.
template <class T>
struct ViscousMembrane {
  Plane<T> stress;  ///< [Pa] positive in tension
  T damping;        ///< [1/s] s of stable_step
};

constexpr double more_of_triangles = 2.5;  ///< [-] linear viscosity of a triangle over that of a hexahedron: fronts cross its sides askew

/// Viscous stress of a plate in its plane, proportional to the rate of the membrane's stress:
///
///     s_v = tau ds/dt,     tau = share min(1, M g^2 / ds:de) 2/omega (2.5 b1 + b2^2 2/omega max(0, -rate))
///
/// with the growth g of the area in the step, so that shear in the plane has none; zero where ds:de is not positive.
///
/// modulus  M = lambda' + 2 mu [Pa] of plane stress;  omega_squared  [1/s2] bound on the squared frequencies of the membrane
template <class T, class N>
NEREID_HOT ViscousMembrane<T> viscous_stress(const Viscosity& viscosity, const PlaneMotion<T>& m, N modulus, T omega_squared,
                                             const Shares<T, 1>& share) {
  const T crossing = T(2.0) / root(omega_squared);
  const T part = viscous_part(Viscosity{more_of_triangles * viscosity.linear, viscosity.quadratic}, crossing, m.growth / m.dt);
  const T of_growth = T(modulus) * m.growth * m.growth, work = contract(m.change, m.strain);
  const T volumetric = select(work > T(0.0), of_growth / (larger(of_growth, work) + T(1e-300)), T(0.0));
  return {(share[0] * volumetric * part * crossing / m.dt) * m.change, T(0.5) * part * crossing * omega_squared};
}

/// Largest stable step of central differences with the damping force half a step old:
///
///     dt = 2 / (s + sqrt(s^2 + omega^2)),     s = zeta omega
///
/// which is the familiar 2/omega (sqrt(1 + zeta^2) - zeta).
///
/// omega_squared  [1/s2] upper bound on the element's eigenvalues;  s  [1/s] half the damping rate
template <class T>
NEREID_HOT T stable_step(T omega_squared, T s) {
  return T(2.0) / (s + root(s * s + omega_squared));
}

}  // namespace nereid::element
