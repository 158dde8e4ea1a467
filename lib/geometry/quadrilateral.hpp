#pragma once
// Points of the bilinear surface of a quadrilateral:  s = sum of w_I x_I,  w = ((1-a)(1-b), a(1-b), a b, (1-a) b).

#include <array>

#include "base/tensor.hpp"
#include "base/types.hpp"

namespace nereid::geometry {

/// A point of a bilinear surface, seen from a point p.
template <class T>
struct OnQuadrilateral {
  T a, b;                ///< [-] 0 to 1 on the face
  Vector<T> by_a, by_b;  ///< [m] ds/da, ds/db
  Vector<T> way;         ///< [m] p - s
};

/// Weights of the corners at (a, b); they sum to one.
template <class T>
NEREID_HOT std::array<T, 4> weights_at(const T& a, const T& b) {
  const T left = T(1.0) - a, below = T(1.0) - b;
  return {left * below, a * below, a * b, left * b};
}

/// Whether (a, b) is on the face or a quarter of its sides beyond.
template <class T>
NEREID_HOT Mask<T> is_on(const T& a, const T& b) {
  constexpr double beyond = 0.25;
  return a > T(-beyond) && a < T(1 + beyond) && b > T(-beyond) && b < T(1 + beyond);
}

/// The point of the bilinear surface that is closest to p: the way from there is along the normal,  (p - s) . ds/da = (p - s) . ds/db = 0.
///
/// corner  around the face
/// at      a, b: where to begin
/// returns whether there is one, on the face or a quarter of its sides beyond
template <class T>
NEREID_HOT Mask<T> closest_on_quadrilateral(const std::array<Vector<T>, 4>& corner, const Vector<T>& p, OnQuadrilateral<T>& at) {
  constexpr int most_rounds = 12;
  constexpr double round_off = 1e-15;  // of a side
  constexpr double farthest = 1e6;     // steps that lead nowhere
  const Vector<T> along = corner[1] - corner[0], across = corner[3] - corner[0], twist = corner[2] - corner[1] - across;
  const Vector<T> start = p - corner[0];  // first, so that places far from the origin lose no digits
  const T skew2 = dot(twist, twist) / smaller(dot(along, along), dot(across, across));
  const auto look = [&] {
    at.by_a = along + at.b * twist, at.by_b = across + at.a * twist;
    at.way = start - at.a * at.by_a - at.b * across;
  };
  Mask<T> goes_on(true), found(false);
  look();
  for (int round = 0; round < most_rounds && any(goes_on); ++round) {
    const T aa = dot(at.by_a, at.by_a), bb = dot(at.by_b, at.by_b), ab = dot(at.by_a, at.by_b) - dot(at.way, twist);
    const T to_a = dot(at.by_a, at.way), to_b = dot(at.by_b, at.way), per = T(1.0) / (aa * bb - ab * ab);
    const T da = per * (bb * to_a - ab * to_b), db = per * (aa * to_b - ab * to_a), step = da * da + db * db;
    goes_on = goes_on && per > T(0.0) && step < T(farthest);
    at.a = select(goes_on, at.a + da, at.a), at.b = select(goes_on, at.b + db, at.b);
    look();
    const Mask<T> there = goes_on && !(step * step * skew2 > T(round_off * round_off));  // a step leaves its square times the twist
    found = found || there;
    goes_on = goes_on && !there;
  }
  return found && is_on(at.a, at.b);
}

/// Weights of the corners at the point of the bilinear surface that lies on the line through p along n.
///
///     s = p - h n
///
/// corner  around the face;  n  unit vector, not in the face
/// a, b    where to begin: at best the place of p on the half of the face that it is over
/// weight  set if there is such a point, on the face or a quarter of its sides beyond; they sum to one
/// returns whether there is one
bool bilinear_weights(const std::array<Vec3, 4>& corner, const Vec3& p, const Vec3& n, double a, double b, std::array<double, 4>& weight);

}  // namespace nereid::geometry
