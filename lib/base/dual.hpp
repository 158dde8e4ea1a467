#pragma once
// Dual numbers: a value with its derivatives by n variables, carried along by every operation.

#include <array>
#include <cmath>

#include "base/number.hpp"

namespace nereid {

template <int n>
struct Dual {
  double value = 0;
  std::array<double, n> by{};  ///< derivatives by each variable

  Dual() = default;
  Dual(double v) : value(v) {}  // NOLINT: a constant is a dual number without derivatives
  /// The variable number i at value v.
  static Dual variable(double v, int i) {
    Dual d(v);
    d.by[i] = 1.0;
    return d;
  }
};

/// value f, and df times the derivatives of a
template <int n>
Dual<n> chain(double f, double df, const Dual<n>& a) {
  Dual<n> r(f);
  for (int i = 0; i < n; ++i) r.by[i] = df * a.by[i];
  return r;
}
template <int n>
Dual<n> operator+(const Dual<n>& a, const Dual<n>& b) {
  Dual<n> r(a.value + b.value);
  for (int i = 0; i < n; ++i) r.by[i] = a.by[i] + b.by[i];
  return r;
}
template <int n>
Dual<n> operator-(const Dual<n>& a, const Dual<n>& b) {
  Dual<n> r(a.value - b.value);
  for (int i = 0; i < n; ++i) r.by[i] = a.by[i] - b.by[i];
  return r;
}
template <int n>
Dual<n> operator-(const Dual<n>& a) { return chain(-a.value, -1.0, a); }
template <int n>
Dual<n> operator*(const Dual<n>& a, const Dual<n>& b) {
  Dual<n> r(a.value * b.value);
  for (int i = 0; i < n; ++i) r.by[i] = a.by[i] * b.value + a.value * b.by[i];
  return r;
}
template <int n>
Dual<n> operator/(const Dual<n>& a, const Dual<n>& b) {
  Dual<n> r(a.value / b.value);
  for (int i = 0; i < n; ++i) r.by[i] = (a.by[i] - r.value * b.by[i]) / b.value;
  return r;
}
template <int n>
Dual<n>& operator+=(Dual<n>& a, const Dual<n>& b) { return a = a + b; }
template <int n>
bool operator<(const Dual<n>& a, const Dual<n>& b) { return a.value < b.value; }
template <int n>
bool operator>(const Dual<n>& a, const Dual<n>& b) { return a.value > b.value; }
template <int n>
Dual<n> select(bool condition, const Dual<n>& yes, const Dual<n>& no) { return condition ? yes : no; }
template <int n>
Dual<n> root(const Dual<n>& a) { return chain(std::sqrt(a.value), 0.5 / std::sqrt(a.value), a); }

template <int n>
Dual<n> logarithm(const Dual<n>& a) { return chain(std::log(a.value), 1.0 / a.value, a); }
/// a^exponent for a >= 0; at zero it counts as constant.
template <int n>
Dual<n> power_of(const Dual<n>& a, double exponent) {
  return chain(std::pow(a.value, exponent), a.value > 0 ? exponent * std::pow(a.value, exponent - 1) : 0.0, a);
}

/// A function at dual numbers; its slopes count as constant.
template <class F, int n>
Tangent<Dual<n>> at_each_lane(const F& function, const Dual<n>& a, const Dual<n>& b) {
  const Tangent<double> at = function(a.value, b.value);
  Dual<n> value(at.value);
  for (int i = 0; i < n; ++i) value.by[i] = at.by_first * a.by[i] + at.by_second * b.by[i];
  return {value, Dual<n>(at.by_first), Dual<n>(at.by_second)};
}

}  // namespace nereid
