#pragma once
// A material point that is carried along by a deformation gradient, as an element carries it.

#include <Eigen/Dense>

#include "base/types.hpp"
#include "tests/material/point.hpp"

namespace nereid::material {

template <class Law>
struct Carried {
  Law law;
  Symmetric<double> stress{};
  Internal<double, Law, Symmetric> internal{};
  Mat3 F = Mat3::Identity();
  double stored = 0;  ///< [J/m3] of the reference
};

inline Mat3 full(const Symmetric<double>& s) {
  Mat3 m;
  m << s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz;
  return m;
}
inline Symmetric<double> symmetric(const Mat3& m) { return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(0, 2)}; }

/// Brings a point to a deformation gradient in even steps: strain and spin of the middle of each, all tensors turned by Hughes & Winget's
/// rotation, the strain by half of it.
template <class Law>
void carry(Carried<Law>& point, const Mat3& to, int steps) {
  const Mat3 from = point.F;
  for (int i = 1; i <= steps; ++i) {
    const Mat3 now = from + (to - from) * (static_cast<double>(i) / steps), middle = 0.5 * (now + point.F);
    const Mat3 L = (now - point.F) * middle.inverse(), d = 0.5 * (L + L.transpose()), w = 0.5 * (L - L.transpose());
    const Mat3 Q = (Mat3::Identity() - 0.5 * w).inverse() * (Mat3::Identity() + 0.5 * w);
    const Mat3 half = (Mat3::Identity() - 0.25 * w).inverse() * (Mat3::Identity() + 0.25 * w);
    const auto turn = [&](Symmetric<double>& tensor) { tensor = symmetric(Q * full(tensor) * Q.transpose()); };
    turn(point.stress);
    for (auto& tensor : point.internal.tensor) turn(tensor);
    const Work<double> work = strain_by(point.law, symmetric(half * d * half.transpose()), point.stress, point.internal);
    point.stored += middle.determinant() * work.stored;
    point.F = now;
  }
}

}  // namespace nereid::material
