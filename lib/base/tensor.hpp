#pragma once
// Vectors and tensors of three dimensions over any number type (base/number.hpp).

#include <array>

#include "base/number.hpp"

namespace nereid {

template <class T>
struct Vector {
  T x, y, z;
  T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const T& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

template <class T>
NEREID_HOT Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T>
NEREID_HOT Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T>
NEREID_HOT Vector<T> operator-(const Vector<T>& a) { return {-a.x, -a.y, -a.z}; }
template <class T>
NEREID_HOT Vector<T> operator*(const T& s, const Vector<T>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <class T>
NEREID_HOT T dot(const Vector<T>& a, const Vector<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T>
NEREID_HOT Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
NEREID_HOT T norm(const Vector<T>& a) { return root(dot(a, a)); }

/// A 3 x 3 matrix by rows.
template <class T>
struct Matrix {
  Vector<T> x, y, z;
  Vector<T>& operator[](int row) { return row == 0 ? x : row == 1 ? y : z; }
  const Vector<T>& operator[](int row) const { return row == 0 ? x : row == 1 ? y : z; }
};

template <class T>
NEREID_HOT Vector<T> operator*(const Matrix<T>& a, const Vector<T>& v) { return {dot(a.x, v), dot(a.y, v), dot(a.z, v)}; }

/// A symmetric tensor in the order of ParaView: xx yy zz xy yz xz; shear components are tensor
/// components, not engineering strains.
template <class T>
struct Symmetric {
  T xx, yy, zz, xy, yz, xz;
  template <class F>
  void each_row(F&& f) { f(xx), f(yy), f(zz), f(xy), f(yz), f(xz); }
  static constexpr int rows = 6;
};

template <class T>
NEREID_HOT Symmetric<T> operator+(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.xz + b.xz};
}
template <class T>
NEREID_HOT Symmetric<T> operator-(const Symmetric<T>& a, const Symmetric<T>& b) {
  return {a.xx - b.xx, a.yy - b.yy, a.zz - b.zz, a.xy - b.xy, a.yz - b.yz, a.xz - b.xz};
}
template <class T>
NEREID_HOT Symmetric<T> operator*(const T& s, const Symmetric<T>& a) {
  return {s * a.xx, s * a.yy, s * a.zz, s * a.xy, s * a.yz, s * a.xz};
}
template <class T>
NEREID_HOT T trace(const Symmetric<T>& a) { return a.xx + a.yy + a.zz; }
/// The double contraction a : b.
template <class T>
NEREID_HOT T contract(const Symmetric<T>& a, const Symmetric<T>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + T(2.0) * (a.xy * b.xy + a.yz * b.yz + a.xz * b.xz);
}
/// The adjugate of a tensor: a adj a = det a 1.
template <class T>
NEREID_HOT Symmetric<T> adjugate(const Symmetric<T>& a) {
  return {a.yy * a.zz - a.yz * a.yz, a.xx * a.zz - a.xz * a.xz, a.xx * a.yy - a.xy * a.xy,
          a.xz * a.yz - a.xy * a.zz, a.xy * a.xz - a.yz * a.xx, a.xy * a.yz - a.xz * a.yy};
}
template <class T>
NEREID_HOT Vector<T> operator*(const Symmetric<T>& a, const Vector<T>& v) {
  return {a.xx * v.x + a.xy * v.y + a.xz * v.z, a.xy * v.x + a.yy * v.y + a.yz * v.z,
          a.xz * v.x + a.yz * v.y + a.zz * v.z};
}

/// A symmetric tensor in the plane of a plate: xx yy xy.
template <class T>
struct Plane {
  T xx, yy, xy;
  template <class F>
  void each_row(F&& f) { f(xx), f(yy), f(xy); }
  static constexpr int rows = 3;
};

template <class T>
NEREID_HOT Plane<T> operator+(const Plane<T>& a, const Plane<T>& b) { return {a.xx + b.xx, a.yy + b.yy, a.xy + b.xy}; }
template <class T>
NEREID_HOT Plane<T> operator-(const Plane<T>& a, const Plane<T>& b) { return {a.xx - b.xx, a.yy - b.yy, a.xy - b.xy}; }
template <class T>
NEREID_HOT Plane<T> operator*(const T& s, const Plane<T>& a) { return {s * a.xx, s * a.yy, s * a.xy}; }
template <class T>
NEREID_HOT T contract(const Plane<T>& a, const Plane<T>& b) { return a.xx * b.xx + a.yy * b.yy + T(2.0) * a.xy * b.xy; }

/// The rotation that the skew part of a displacement gradient stands for, by the Cayley transform
/// (Hughes & Winget 1980):  Q = (1 - W/2)^-1 (1 + W/2),  W v = w x v.
///
/// w  axial vector of the increment [rad]; |w| = 2 tan(angle/2) for a finite rotation whose
///    gradient was taken in the middle configuration, so a rigid rotation is recovered exactly.
template <class T>
NEREID_HOT Matrix<T> cayley_rotation(const Vector<T>& w) {
  const T half(0.5);
  const T s = T(1.0) / (T(1.0) + T(0.25) * dot(w, w));
  const T ww = half * dot(w, w);
  const T xy = half * w.x * w.y, yz = half * w.y * w.z, xz = half * w.x * w.z;
  return {{T(1.0) + s * (half * w.x * w.x - ww), s * (xy - w.z), s * (xz + w.y)},
          {s * (xy + w.z), T(1.0) + s * (half * w.y * w.y - ww), s * (yz - w.x)},
          {s * (xz - w.y), s * (yz + w.x), T(1.0) + s * (half * w.z * w.z - ww)}};
}

/// Q a Q^T.
template <class T>
NEREID_HOT Symmetric<T> rotate(const Matrix<T>& Q, const Symmetric<T>& a) {
  const Vector<T> rx = a * Q.x, ry = a * Q.y, rz = a * Q.z;
  return {dot(Q.x, rx), dot(Q.y, ry), dot(Q.z, rz), dot(Q.x, ry), dot(Q.y, rz), dot(Q.x, rz)};
}

}  // namespace nereid
