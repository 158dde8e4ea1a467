#pragma once
// Bulk viscosity: a pressure against the rate of volume change, which spreads a shock over a few
// elements and damps the ringing behind it.

#include "base/number.hpp"

namespace nereid::element {

/// Coefficients of bulk viscosity [-]; zero switches a term off.
struct Viscosity {
  double linear = 0.06;
  double quadratic = 1.2;
};

/// Dynamic bulk viscosity of an element, so that the viscous pressure is -eta * rate:
///
///     eta = rho l (b1 c + b2^2 l max(0, -rate))
///
/// The quadratic term acts in compression only (von Neumann & Richtmyer 1950; Landshoff 1955).
///
/// density  [kg/m3] now;  length  [m] of the element;  speed  [m/s] of dilatational waves
/// rate     [1/s] of volume change, positive in expansion
/// returns  eta [Pa s], not negative
template <class T, class N>
NEREID_HOT T bulk_viscosity(const Viscosity& b, T density, T length, N speed, T rate) {
  const T compression = larger(T(0.0), -rate);
  return density * length * (T(b.linear) * T(speed) + T(b.quadratic * b.quadratic) * length * compression);
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
